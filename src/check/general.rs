//! Whether a solution of differential equations is their general one.
//!
//! A formula that solves an equation may still have lost a constant of integration. What is said to be `general` must have
//! as many constants as the equations have orders (the highest derivative that they contain of each quantity, less the
//! derivative that the formula gives), and these must be independent: the derivatives of the quantities and of their rates
//! by the constants are a matrix of full rank at some state.

use nalgebra::DMatrix;

use crate::expr::{Expr, Node, SymId, Tape, Workspace};
use crate::semantics::{self, Clause, Scope, World};

use super::claim::{Obstacle, Source};
use super::random::{Random, draw};
use super::system;

/// The states at which the rank is looked at.
const STATES: usize = 8;
/// The smallest singular value relative to the largest that counts: far above rounding, far below what a state makes small.
const INDEPENDENT: f64 = 1e-9;

/// Why a solution is not general, in words; `None` where it is, or where nobody says so.
pub fn defect(source: &Source, clauses: &[Clause], solved: &[(Clause, &Scope)]) -> Result<Option<String>, Obstacle> {
    let names = source.book.entries[source.index].list(|a| &a.general);
    if names.is_empty() {
        return Ok(None);
    }
    let mut world = World::new();
    let mut constants = Vec::new();
    for name in names {
        constants.extend(source.symbol(&mut world, name)?.components().into_iter().filter_map(|e| symbol(&world, e)));
    }
    let scope: &Scope = &source.book.entries[source.index].scope;
    let formulas = pairs(&mut world, clauses.iter().map(|c| (c, scope)))?;
    let given: Vec<(SymId, Expr)> =
        formulas.into_iter().filter_map(|(lhs, rhs)| Some((symbol(&world, lhs)?, rhs))).collect();
    let equations = pairs(&mut world, solved.iter().map(|(c, s)| (c, *s)))?;
    let equations: Vec<Expr> = equations.into_iter().flat_map(|(lhs, rhs)| [lhs, rhs]).collect();
    let order = |s: SymId| {
        let info = world.graph.info(s);
        let occurring = world.graph.symbols(&equations).into_iter().map(|x| world.graph.info(x).clone());
        let highest = occurring.filter(|x| x.base == info.base).map(|x| x.order).max().unwrap_or(0);
        highest.saturating_sub(info.order)
    };
    let orders: u32 = given.iter().map(|(s, _)| order(*s)).sum();
    if orders as usize != constants.len() {
        let count = constants.len();
        let message = format!("not general: the orders of the equations sum to {orders}, the constants are {count}");
        return Ok(Some(message));
    }
    let names: Vec<&str> = names.iter().map(|n| n.value.as_str()).collect();
    let independent = independent(&mut world, &given, &constants, source);
    Ok((!independent).then(|| format!("not general: the constants {} are not independent", names.join(", "))))
}

fn symbol(world: &World, e: Expr) -> Option<SymId> {
    match *world.graph.node(e) {
        Node::Symbol(s) => Some(s),
        _ => None,
    }
}

/// The sides of the clauses, component by component.
fn pairs<'c>(
    world: &mut World,
    clauses: impl Iterator<Item = (&'c Clause, &'c Scope)>,
) -> Result<Vec<(Expr, Expr)>, Obstacle> {
    let mut found = Vec::new();
    for (clause, scope) in clauses {
        let link = semantics::understand(world, scope, clause, true).map_err(Obstacle::Link)?;
        found.extend(link.pairs().into_iter().map(|(_, lhs, rhs)| (lhs, rhs)));
    }
    Ok(found)
}

/// Whether the quantities with their rates change in as many directions as there are constants.
fn independent(world: &mut World, given: &[(SymId, Expr)], constants: &[SymId], source: &Source) -> bool {
    let t = world.graph.find("t");
    let mut values: Vec<Expr> = given.iter().map(|(_, e)| *e).collect();
    let mut last = values.clone();
    for _ in 1..constants.len() {
        last = last.into_iter().map(|e| world.graph.time_derivative(e, t)).collect();
        values.extend(&last);
    }
    let jacobian: Vec<Expr> = world.graph.jacobian(&values, constants).into_iter().flatten().collect();
    let tape = Tape::compile(&world.graph, &jacobian);
    let sources: Vec<_> = tape.inputs().iter().map(|s| system::source(world, *s)).collect();
    let mut random = Random::new(0, &source.book.entries[source.index].equation.label);
    let mut work = Workspace::default();
    (0..STATES).any(|_| {
        let inputs: Vec<f64> = sources.iter().map(|s| draw(&mut random, s.range, s.integer, false).to_f64()).collect();
        let entries = tape.eval(&inputs, &(), &mut work);
        if entries.iter().any(|x| !x.is_finite()) {
            return false;
        }
        let sizes = DMatrix::from_row_slice(values.len(), constants.len(), entries).singular_values();
        sizes.len() == constants.len() && sizes.min() > INDEPENDENT * sizes.max()
    })
}
