//! Whether two clauses say the same, whatever the premises are.
//!
//! The rule: all symbols are drawn at random from their ranges, independently, no premise being used (that a vector has
//! components, and how a basis turns, is what the symbols mean and no premise). Two clauses are the same where at every
//! such state the residual of one is c times that of the other, with one constant c ≠ 0 for all states and components;
//! or where both vanish at every state, being identities. Sound up to chance: the residuals are analytic in the symbols,
//! and two of them that differ agree on a set of measure zero only. A relation of order needs c > 0.
//!
//! That a clause passes its check plays no part in this.

use crate::expr::{Tape, Workspace};
use crate::latex::ast::Rel;
use crate::number::{Df64, Number, Tracked};
use crate::semantics::{Clause, Elaborator, Side, World};

use super::claim::{Source, pairs};
use super::decide::{Finding, findings};
use super::random::{Random, draw};
use super::sampling::PairValue;
use super::system;

/// The number of states at which the residuals are compared.
const STATES: usize = 12;
/// The states that are tried for them: at some the sides may be no numbers.
const TRIES: usize = 4 * STATES;

/// A residual with the sum of the magnitudes of its terms.
type Sized = (Tracked<Df64>, Tracked<Df64>);

/// Whether two clauses in the place of an equation say the same.
pub fn same(source: &Source, a: &Clause, b: &Clause, mut random: Random) -> bool {
    let scope = &source.book.entries[source.index].scope;
    let mut world = World::new();
    Elaborator::new(&mut world, scope, Vec::new(), true).build_bases();
    let mut outputs = Vec::new();
    let mut counts = Vec::new();
    for clause in [a, b] {
        let clause = if clause.rel == Rel::To {
            let Some(Ok(clause)) = source.mapped(clause) else { return false };
            clause
        } else {
            clause.clone()
        };
        let Ok(links) = source.branches(&mut world, scope, &clause) else { return false };
        for link in &links {
            for pair in pairs(&mut world, link, clause.rhs == Side::Constant) {
                outputs.extend([pair.residual, world.graph.magnitude(pair.residual)]);
            }
        }
        counts.push(outputs.len());
    }
    if a.rel != b.rel || counts[1] != 2 * counts[0] {
        return false;
    }
    let half = counts[0];
    if outputs[..half] == outputs[half..] {
        return true;
    }
    let tape = Tape::compile(&world.graph, &outputs);
    let sources: Vec<_> = tape.inputs().iter().map(|s| system::source(&world, *s)).collect();
    let mut work = Workspace::default();
    let mut values: Vec<(Sized, Sized)> = Vec::new();
    let mut states = 0;
    for _ in 0..TRIES {
        let draws = sources.iter().map(|s| draw(&mut random, s.range, s.integer, false));
        let inputs: Vec<Tracked<Df64>> =
            draws.map(|d| Tracked::from_ratio(i128::from(d.num), i128::from(d.den), &())).collect();
        let out = tape.eval(&inputs, &(), &mut work);
        if out.iter().all(Number::is_finite) {
            let sized = |q: &[Tracked<Df64>]| (q[0].clone(), q[1].clone());
            values.extend(out[..half].chunks(2).map(sized).zip(out[half..].chunks(2).map(sized)));
            states += 1;
        }
        if states == STATES {
            break;
        }
    }
    let ordered = matches!(a.rel, Rel::Lt | Rel::Le | Rel::Gt | Rel::Ge);
    states == STATES && (vanish(&values) || proportional(&values, ordered))
}

fn vanish(values: &[(Sized, Sized)]) -> bool {
    values.iter().all(|(a, b)| is_zero(a) && is_zero(b))
}

/// Whether the second residuals are one constant times the first: r' R - r R' = 0 with R, R' those that are largest.
fn proportional(values: &[(Sized, Sized)], ordered: bool) -> bool {
    let size = |v: &(Sized, Sized)| v.0.0.value().log2_abs();
    let Some(reference) = values.iter().max_by(|x, y| size(x).total_cmp(&size(y))) else { return false };
    let (first, second) = reference;
    if is_zero(first) || is_zero(second) || !sure(first) || !sure(second) {
        return false;
    }
    if ordered && (first.0.to_f64() < 0.0) != (second.0.to_f64() < 0.0) {
        return false;
    }
    values.iter().all(|(a, b)| {
        let product = |x: &Sized, y: &Sized| (x.0.times(&y.0), x.1.times(&y.1));
        let (p, q) = (product(b, first), product(a, second));
        is_zero(&(p.0.minus(&q.0), p.1.plus(&q.1)))
    })
}

fn finding(x: &Sized) -> Option<Finding> {
    let (lhs, rhs) = (x.0.value().clone(), Df64::zero(&()));
    let value = PairValue { residual: x.0.clone(), lhs, rhs, scale_log2: x.1.value().log2_abs() };
    findings(&[value]).first().copied()
}

fn is_zero(x: &Sized) -> bool {
    matches!(finding(x), Some(Finding::Agree(_)))
}

fn sure(x: &Sized) -> bool {
    matches!(finding(x), Some(Finding::Differ(_)))
}

