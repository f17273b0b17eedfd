//! Degrees, minutes and seconds of arc: `23^\circ 27'`, `17.''3`, `5^\circ.2`. Their values are in radians.

use crate::expr::Expr;
use crate::latex::ast::{Kind, Node};

use super::elaborate::{Elaborator, Typed};
use super::error::Result;
use super::juxtaposition::Item;
use super::value::Value;

/// The part of a half turn that a numeral counts: degrees, minutes or seconds of arc; `None` for another node.
fn parts_of_half_turn(node: &Node) -> Option<i64> {
    let Kind::Scripts { base, primes, sub: None, sup } = &node.kind else { return None };
    if !matches!(base.kind, Kind::Number(_)) {
        return None;
    }
    match (primes, sup.as_deref()) {
        (0, Some(Node { kind: Kind::Symbol(s), .. })) if s == "\\circ" => Some(180),
        (1, None) => Some(180 * 60),
        (2, None) => Some(180 * 3600),
        _ => None,
    }
}

/// How many of the first items are one angle: numerals whose units get smaller.
pub(super) fn length(items: &[Item]) -> usize {
    let mut last = 0;
    let smaller = |item: &&Item| match item {
        Item::Factor(node) => parts_of_half_turn(node).is_some_and(|parts| parts > std::mem::replace(&mut last, parts)),
        Item::Op(..) => false,
    };
    items.iter().take_while(smaller).count()
}

impl Elaborator<'_> {
    /// The angle at the beginning of some items, with the number of items it takes.
    pub(super) fn angle(&mut self, items: &[Item]) -> Result<Option<(Typed, usize)>> {
        let count = length(items);
        let mut total: Option<Expr> = None;
        for item in &items[..count] {
            let Item::Factor(node) = item else { break };
            let (Kind::Scripts { base, .. }, Some(parts)) = (&node.kind, parts_of_half_turn(node)) else { break };
            let numeral = self.value(base)?;
            let numeral = self.scalar(&numeral, &node.span)?;
            let graph = &mut self.world.graph;
            let (pi, parts) = (graph.pi(), graph.int(parts));
            let unit = graph.div(pi, parts);
            let angle = graph.mul(numeral, unit);
            total = Some(match total {
                Some(sum) => graph.add(sum, angle),
                None => angle,
            });
        }
        Ok(total.map(|e| (Typed::new(Value::Scalar(e), "angle"), count)))
    }
}

#[cfg(test)]
mod tests {
    use crate::expr::Tape;
    use crate::semantics::testing::{scope, value};
    use crate::semantics::{Value, World};

    fn number(latex: &str) -> f64 {
        let mut world = World::new();
        let scope = scope("[symbols]\n'y' = { same = '2' }");
        let Value::Scalar(e) = value(&mut world, &scope, latex).unwrap() else { panic!("no scalar") };
        Tape::compile(&world.graph, &[e]).eval::<f64>(&[], &(), &mut crate::expr::Workspace::default())[0]
    }

    #[test]
    fn angles_are_in_radians() {
        let near = |latex: &str, degrees: f64| {
            let expected = degrees.to_radians();
            assert!((number(latex) - expected).abs() < 1e-14 * expected.abs().max(1.0), "{latex}");
        };
        near(r"23^\circ 27'", 23.45);
        near(r"23^\circ 27' 18''", 23.455);
        near("17''3", 17.3 / 3600.0);
        near("0.''2", 0.2 / 3600.0);
        near("34''6 / y", 17.3 / 3600.0);
        near("3 \\times 10'", 0.5);
    }

    #[test]
    fn a_function_takes_the_whole_angle() {
        assert!((number(r"\sin 23^\circ 27' y") - 2.0 * 23.45_f64.to_radians().sin()).abs() < 1e-14);
    }
}
