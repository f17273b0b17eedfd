//! Counting: the number of ways to choose, `{}_n C_k`, factorials n! and n!!, and the whole numbers next to a fraction.

use crate::expr::Expr;
use crate::latex::ast::{Delim, Kind, Node, Span};

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

impl Elaborator<'_> {
    /// The factorial n! (of `step` 1) or n!! (of 2): n (n - step) (n - 2 step) .., where (-1)!! = 0!! = 0! = 1.
    pub(super) fn factorial(&mut self, step: u8, body: &Node, span: &Span) -> Result<Typed> {
        let inner = self.value(body)?;
        let n = self.integer(body)?;
        if n <= -i64::from(step) || n > MOST_CHOSEN {
            let message = format!("the factorial of {n}: only those up to {MOST_CHOSEN} are written out");
            return Err(Error::limit(message, span));
        }
        let graph = &mut self.world.graph;
        let mut product = graph.int(1);
        for factor in (1..=n).rev().step_by(usize::from(step.max(1))) {
            let factor = graph.int(factor);
            product = graph.mul(product, factor);
        }
        let marks = "!".repeat(usize::from(step));
        Ok(Typed::new(Value::Scalar(product), format!("{}{marks}", inner.text)))
    }

    /// The next whole number below (or above) a fraction that the indices determine.
    pub(super) fn rounded(&mut self, open: Delim, inner: &Typed, span: &Span) -> Result<Typed> {
        let e = self.scalar(inner, span)?;
        let Some((n, d)) = self.world.graph.as_rational(e) else {
            return Err(Error::unsupported("only fractions of whole numbers are rounded to whole ones", span));
        };
        let below = n.div_euclid(d);
        let whole = if open == Delim::Ceil && below * d != n { below + 1 } else { below };
        Ok(Typed::new(Value::Scalar(self.world.graph.ratio(whole, 1)), format!("rounded({})", inner.text)))
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
    use crate::semantics::testing::{same, scope, value};
    use crate::semantics::{Value, World};

    #[test]
    fn six_choose_two() {
        let mut world = World::new();
        let Value::Scalar(e) = value(&mut world, &scope("[symbols]\n'x' = {}"), "{}_6 C_2").unwrap() else { panic!() };
        assert_eq!(world.graph.as_rational(e), Some((15, 1)));
    }

    #[test]
    fn factorials() {
        let symbols = "[symbols]\n'n' = { index = [0, 5] }\n'x' = {}";
        assert!(same(symbols, "5! + 0! + 6!! + 7!! + (-1)!!", "120 + 1 + 48 + 105 + 1"));
        assert!(same(symbols, r"\sum_{n=0}^2 (2n - 1)!!", "1 + 1 + 3"));
        assert!(value(&mut World::new(), &scope(symbols), "x!").is_err());
        assert!(value(&mut World::new(), &scope(symbols), "(-1)!").is_err());
        assert!(value(&mut World::new(), &scope(symbols), "101!").is_err());
    }

    #[test]
    fn next_whole_numbers() {
        let symbols = "[symbols]\n'x' = {}";
        assert!(same(
            symbols,
            r"\lfloor \frac{5}{2} \rfloor - \lfloor \frac{-5}{2} \rfloor + \lceil \frac{5}{2} \rceil",
            "2 + 3 + 3"
        ));
        assert!(value(&mut World::new(), &scope(symbols), r"\lfloor x \rfloor").is_err());
    }
}
