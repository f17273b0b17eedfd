//! Kronecker's delta `\delta_{kl}`: a δ with two indices that is not declared as anything else.

use crate::latex::ast::{Kind, Node};

use super::elaborate::{Elaborator, Typed};
use super::error::Result;
use super::value::Value;

impl Elaborator<'_> {
    /// 1 where the indices have one value, 0 where they have two; none where no delta of two indices stands here.
    pub(super) fn kronecker(&mut self, base: &Node, primes: u8, sub: Option<&Node>) -> Result<Option<Typed>> {
        let (0, Kind::Symbol(letter), Some(sub)) = (primes, &base.kind, sub) else { return Ok(None) };
        let [a, b] = pair(sub) else { return Ok(None) };
        let value = |node: &Node| match &node.kind {
            Kind::Symbol(name) => self.index_value(name),
            Kind::Number(digits) => digits.parse().ok(),
            _ => None,
        };
        let (Some(a), Some(b)) = (value(a), value(b)) else { return Ok(None) };
        if letter != "\\delta" {
            return Ok(None);
        }
        let one = self.world.graph.int(i64::from(a == b));
        Ok(Some(Typed::new(Value::Scalar(one), format!("\\delta_{{{a}{b}}}"))))
    }
}

/// The indices side by side, or behind a comma.
fn pair(sub: &Node) -> &[Node] {
    match &sub.kind {
        Kind::Juxt(indices) | Kind::List(indices) => indices,
        _ => &[],
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{scope, value};
    use super::super::{Value, World};

    const SYMBOLS: &str = r"
        [symbols]
        'k, l' = { index = [1, 3] }
        'a_k, b_k' = { range = [0.5, 2.0], each = ['k'] }
    ";

    fn shown(world: &mut World, latex: &str) -> String {
        match value(world, &scope(SYMBOLS), latex) {
            Ok(Value::Scalar(e)) => world.graph.display(e),
            other => format!("{other:?}"),
        }
    }

    #[test]
    fn a_sum_with_a_delta_keeps_the_equal_indices() {
        let mut world = World::new();
        let expected = shown(&mut world, r"\sum_k a_k b_k");
        assert_eq!(shown(&mut world, r"\sum_{k,l} \delta_{kl} a_k b_l"), expected);
        assert_eq!(shown(&mut world, r"\sum_k \delta_{k,k}"), "3");
    }

    #[test]
    fn other_deltas_are_names() {
        for latex in [r"\delta_k", r"\delta_{kx}", r"\epsilon_{kl}", r"\delta"] {
            assert!(shown(&mut World::new(), latex).starts_with("Err"), "{latex}");
        }
    }
}
