//! Counting: the number of ways to choose, `{}_n C_k`.

use crate::expr::Expr;
use crate::latex::ast::{Kind, Node};

use super::elaborate::{Elaborator, Typed};
use super::error::{Error, Result};
use super::value::Value;

/// The most that are chosen: each is a factor.
const MOST_CHOSEN: i64 = 100;

impl Elaborator<'_> {
    /// `{}_n C_k`, the number of ways to choose k of n; `None` where the factors are something else.
    pub(super) fn choices(&mut self, first: &Node, second: &Node) -> Result<Option<Typed>> {
        let (Some(n), Some(k)) = (before(first), of_c(second)) else { return Ok(None) };
        let from = self.value(n)?;
        let from = self.scalar(&from, &n.span)?;
        let k_span = k.span.clone();
        let k = self.integer(k)?;
        if !(0..=MOST_CHOSEN).contains(&k) {
            let message = format!("{k} of so many are not chosen: only 0 to {MOST_CHOSEN}");
            return Err(Error::limit(message, &k_span));
        }
        let graph = &mut self.world.graph;
        let mut ways = graph.int(1);
        for j in 0..k {
            // n (n - 1) .. (n - k + 1) / k!, for any n.
            let (j, next): (Expr, Expr) = (graph.int(j), graph.int(j + 1));
            let left = graph.sub(from, j);
            let product = graph.mul(ways, left);
            ways = graph.div(product, next);
        }
        Ok(Some(Typed::new(Value::Scalar(ways), format!("choose({k})"))))
    }
}

/// The n of `{}_n`.
fn before(node: &Node) -> Option<&Node> {
    match &node.kind {
        Kind::Scripts { base, primes: 0, sub: Some(sub), sup: None } if base.kind == Kind::Empty => Some(sub),
        _ => None,
    }
}

/// The k of `C_k`.
fn of_c(node: &Node) -> Option<&Node> {
    match &node.kind {
        Kind::Scripts { base, primes: 0, sub: Some(sub), sup: None } => {
            matches!(&base.kind, Kind::Symbol(s) if s == "C").then_some(sub)
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use crate::semantics::testing::{scope, value};
    use crate::semantics::{Value, World};

    #[test]
    fn six_choose_two() {
        let mut world = World::new();
        let Value::Scalar(e) = value(&mut world, &scope("[symbols]\n'x' = {}"), "{}_6 C_2").unwrap() else { panic!() };
        assert_eq!(world.graph.as_rational(e), Some((15, 1)));
    }
}
