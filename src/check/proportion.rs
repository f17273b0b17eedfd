//! Numbers that are proportional, `a \propto b`: a/b stays the same when that changes which b depends on. With the premises
//! put in, a ∂b/∂s = b ∂a/∂s for every symbol s of b. (Vectors are proportional component by component: see the relations
//! between directions.)

use crate::semantics::World;

use super::claim::{Branch, Pair};

/// What a proportion of two numbers says, as equations; none where the right side depends on nothing.
pub(super) fn pairs(world: &mut World, pair: &Pair) -> Branch {
    let symbols = world.graph.symbols(&[pair.rhs]);
    let mut found = Branch::new();
    for s in symbols {
        let name = Some(format!("change with {}", world.tex(s)));
        let graph = &mut world.graph;
        let (of_left, of_right) = (graph.diff(pair.lhs, s), graph.diff(pair.rhs, s));
        let (lhs, rhs) = (graph.mul(pair.lhs, of_right), graph.mul(pair.rhs, of_left));
        found.push(Pair::new(graph, name, lhs, rhs));
    }
    found
}
