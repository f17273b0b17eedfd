//! Poisson brackets `\{F, G\}` of the canonical variables that a section declares, `canonical = { 'p' = 'q' }`:
//! {F, G} = Σ (∂F/∂p ∂G/∂q - ∂F/∂q ∂G/∂p), so that {p, G} = ∂G/∂q and {q, G} = -∂G/∂p as in the equations of motion
//! dp/dt = ∂F/∂q, dq/dt = -∂F/∂p.

use crate::expr::{Expr, SymId};
use crate::latex::ast::{Delim, Kind, Node, Span};

use super::elaborate::{Elaborator, Typed};
use super::error::Result;

impl Elaborator<'_> {
    /// The Poisson bracket that a pair in braces is, where canonical variables are declared.
    pub(super) fn poisson(&mut self, open: Delim, body: &Node, span: &Span) -> Result<Option<Typed>> {
        let (Delim::Brace, Kind::List(items), false) = (open, &body.kind, self.scope.canonical.is_empty()) else {
            return Ok(None);
        };
        let [f, g] = items.as_slice() else { return Ok(None) };
        let mut pairs = Vec::new();
        for (momentum, coordinate) in self.scope.canonical.clone() {
            pairs.push((self.variable(&momentum, span)?, self.variable(&coordinate, span)?));
        }
        let (f, g) = (self.value(f)?, self.value(g)?);
        let g_value = self.scalar(&g, span)?;
        let value = f.value.map(&mut |e| self.bracket(e, g_value, &pairs));
        Ok(Some(Typed::new(value, format!("{{{}, {}}}", f.text, g.text))))
    }
    fn bracket(&mut self, f: Expr, g: Expr, pairs: &[(SymId, SymId)]) -> Expr {
        let graph = &mut self.world.graph;
        let mut terms = Vec::new();
        for (p, q) in pairs {
            let (fp, fq, gp, gq) = (graph.diff(f, *p), graph.diff(f, *q), graph.diff(g, *p), graph.diff(g, *q));
            let (first, second) = (graph.mul(fp, gq), graph.mul(fq, gp));
            terms.push(graph.sub(first, second));
        }
        graph.sum(terms)
    }
}

#[cfg(test)]
mod tests {
    use crate::semantics::testing::{scope, value};
    use crate::semantics::{Value, World};

    const SYMBOLS: &str = "canonical = { p = 'q' }\n[symbols]\n'p, q, a' = { range = [0.5, 2.0] }";

    fn scalar(world: &mut World, latex: &str) -> crate::expr::Expr {
        match value(world, &scope(SYMBOLS), latex).unwrap() {
            Value::Scalar(e) => e,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn brackets_of_the_variables() {
        let mut world = World::new();
        for (bracket, expected) in
            [(r"\{p, q\}", "1"), (r"\{q, p\}", "-1"), (r"\{a, q\}", "0"), (r"\{p, a q^2\}", "a(2q)")]
        {
            let (found, expected) = (scalar(&mut world, bracket), scalar(&mut world, expected));
            assert_eq!(found, expected, "{bracket}");
        }
    }

    #[test]
    fn a_tuple_is_bracketed_item_by_item() {
        let mut world = World::new();
        let tuple = value(&mut world, &scope(SYMBOLS), r"\{(p, q), p\}").unwrap();
        let (zero, minus) = (world.graph.int(0), world.graph.int(-1));
        assert_eq!(tuple.components(), [zero, minus]);
    }
}
