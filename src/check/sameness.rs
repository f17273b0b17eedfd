//! Whether two clauses say the same, by a rule that does not rest on the check.
//!
//! All symbols are drawn at random from their ranges, independently: no premise is used (that a vector has components,
//! and how a basis turns, is what the symbols mean and no premise). Two clauses are the same where at every such state
//!
//! 1. both residuals vanish: they are identities; or
//! 2. the residual of one is c f times that of the other, with one constant c ≠ 0 for all states and components, and f a
//!    product of powers of symbols whose declared ranges leave out 0 (so I dω/dt = 0 and dω/dt = 0 are the same); or
//! 3. the second holds once symbols are replaced by what the section assumes them to be (an axis by its components, one
//!    moment of inertia by another), *and* the residual does not vanish then: the edit lies in what cancels. Where the
//!    residual vanishes by the assumptions alone, nothing is said: that would call a mutant the same for passing.
//!
//! A chain a = b = 0 says a = 0 and b = 0 ([`split`]). Sound up to chance: the residuals are analytic in the symbols, and
//! two of them that differ agree on a set of measure zero only. A relation of order needs c > 0 and no f.

use crate::expr::{Expr, SymId, Tape, Workspace};
use crate::latex::ast::{Kind, Node, Rel};
use crate::number::{Df64, Number, Tracked};
use crate::semantics::{Clause, Elaborator, Side, World};

use super::claim::{Source, pairs};
use super::decide::{Finding, findings};
use super::premises::Premises;
use super::random::{Random, draw};
use super::sampling::PairValue;
use super::system;

/// A state's values with the original's and the mutant's residuals there.
type SampledState = (Vec<Tracked<Df64>>, Vec<Sized>, Vec<Sized>);

/// The number of states at which the residuals are compared.
const STATES: usize = 24;
/// The states that are tried for them: at some the sides may be no numbers.
const TRIES: usize = 4 * STATES;
/// The states at which a relation of order has to hold together with the one that it follows from.
const IMPLICATIONS: usize = 4 * STATES;

/// A number with the sum of the magnitudes of the terms it is made of.
type Sized = (Tracked<Df64>, Tracked<Df64>);

/// The clauses, with those of a chain in which one side is 0 replaced by one for each other side, that it is 0.
pub fn split(clauses: &[Clause]) -> Vec<Clause> {
    let mut out = Vec::new();
    let mut rest = clauses;
    while let Some(first) = rest.first() {
        let linked = |pair: &[Clause]| pair[1].part == first.part && pair[0].rhs == Side::Node(pair[1].lhs.clone());
        let length = 1 + rest.windows(2).take_while(|pair| linked(pair)).count();
        let (chain, after) = rest.split_at(length);
        rest = after;
        let rights = chain.iter().filter_map(|c| match &c.rhs {
            Side::Node(n) => Some(n),
            Side::Constant => None,
        });
        let sides: Vec<&Node> = std::iter::once(&first.lhs).chain(rights).collect();
        let equalities = chain.iter().all(|c| c.rel == Rel::Eq) && sides.len() == length + 1;
        match sides.iter().find(|s| is_null(s)).filter(|_| equalities) {
            Some(null) => {
                let others = sides.iter().filter(|s| !is_null(s));
                out.extend(others.map(|s| Clause {
                    lhs: (*s).clone(),
                    rhs: Side::Node((*null).clone()),
                    ..first.clone()
                }));
            }
            None => out.extend_from_slice(chain),
        }
    }
    out
}

fn is_null(node: &Node) -> bool {
    match &node.kind {
        Kind::Number(n) => n == "0",
        Kind::Styled(_, body) => is_null(body),
        _ => false,
    }
}

/// Whether two clauses in the place of an equation say the same.
pub fn same(source: &Source, a: &Clause, b: &Clause, random: &Random) -> bool {
    let scope = &source.book.entries[source.index].scope;
    let mut world = World::until(source.deadline);
    Elaborator::new(&mut world, scope, Vec::new(), true).build_bases();
    let (Some(left), Some(right)) = (residuals(source, &mut world, a), residuals(source, &mut world, b)) else {
        return false;
    };
    if a.rel != b.rel || left.len() != right.len() || world.graph.cut_short().is_some() {
        return false;
    }
    let ordered = matches!(a.rel, Rel::Lt | Rel::Le | Rel::Gt | Rel::Ge);
    if left == right || compare(&mut world, &left, &right, ordered, true, random.clone()) {
        return true;
    }
    let Ok(assumed) = source.assumed(&mut world) else { return false };
    let premises = Premises::new(&mut world.graph, &assumed, &Default::default());
    let mut resolved =
        |es: &[Expr]| -> Vec<Expr> { es.iter().map(|e| premises.resolve(&mut world.graph, *e)).collect() };
    let (left, right) = (resolved(&left), resolved(&right));
    compare(&mut world, &left, &right, ordered, false, random.clone())
}

/// Whether a relation of order follows from another one alone, at whatever values of the symbols in their ranges: `2a > b`
/// from `a > b`. What follows from what is true is true as well, and no check can refuse it.
pub fn follows(source: &Source, a: &Clause, b: &Clause, random: &Random) -> bool {
    if !is_ordered(a.rel) || !is_ordered(b.rel) {
        return false;
    }
    let scope = &source.book.entries[source.index].scope;
    let mut world = World::until(source.deadline);
    Elaborator::new(&mut world, scope, Vec::new(), true).build_bases();
    let (Some(left), Some(right)) = (residuals(source, &mut world, a), residuals(source, &mut world, b)) else {
        return false;
    };
    let mut random = random.clone();
    let mut seen = 0;
    for _ in 0..4 * TRIES {
        let draws = Random::new(random.next(), "implication");
        let Some(sample) = sampled(&mut world, &left, &right, draws) else { return false };
        for (_, own, other) in &sample.states {
            if own.iter().all(|x| satisfied(a.rel, x)) {
                seen += 1;
                if !other.iter().all(|x| satisfied(b.rel, x)) {
                    return false;
                }
            }
        }
        if seen >= IMPLICATIONS {
            return true;
        }
    }
    false
}

fn is_ordered(rel: Rel) -> bool {
    matches!(rel, Rel::Lt | Rel::Le | Rel::Gt | Rel::Ge)
}

/// Whether a residual has the sign that a relation of order asks for, as far as it can be told.
fn satisfied(rel: Rel, x: &Sized) -> bool {
    is_zero(x) && matches!(rel, Rel::Le | Rel::Ge)
        || sure(x) && matches!(rel, Rel::Lt | Rel::Le) == (x.0.to_f64() < 0.0)
}

/// Whether a side of a clause is 0, and the other one as well at random states of independent symbols.
pub fn is_trivial(source: &Source, clause: &Clause, random: &Random) -> bool {
    if !is_null(&clause.lhs) && !matches!(&clause.rhs, Side::Node(n) if is_null(n)) {
        return false;
    }
    let scope = &source.book.entries[source.index].scope;
    let mut world = World::new();
    Elaborator::new(&mut world, scope, Vec::new(), true).build_bases();
    let Some(own) = residuals(source, &mut world, clause) else { return false };
    let Some(sample) = sampled(&mut world, &own, &[], random.clone()) else { return false };
    sample.states.iter().all(|(_, own, _)| own.iter().all(is_zero))
}

/// The residuals of a clause, on both branches of a ±.
fn residuals(source: &Source, world: &mut World, clause: &Clause) -> Option<Vec<Expr>> {
    let scope = &source.book.entries[source.index].scope;
    let clause = if clause.rel == Rel::To { source.mapped(clause)?.ok()? } else { clause.clone() };
    let links = source.branches(world, scope, &clause).ok()?;
    let all = links.iter().flat_map(|link| pairs(world, link, clause.rhs == Side::Constant)).map(|p| p.residual);
    Some(all.collect())
}

/// The values of residuals at states of independent symbols.
struct Sample {
    symbols: Vec<SymId>,
    /// The symbols' values and the residuals on the left and right, state by state.
    states: Vec<SampledState>,
}

fn compare(world: &mut World, left: &[Expr], right: &[Expr], ordered: bool, identities: bool, random: Random) -> bool {
    let Some(sample) = sampled(world, left, right, random) else { return false };
    let vanish = sample.states.iter().all(|(_, l, r)| l.iter().chain(r).all(is_zero));
    if vanish {
        return identities;
    }
    proportional(&sample, ordered, &[])
        || !ordered && powers(world, &sample).is_some_and(|powers| proportional(&sample, false, &powers))
}

fn sampled(world: &mut World, left: &[Expr], right: &[Expr], mut random: Random) -> Option<Sample> {
    let outputs: Vec<Expr> = left.iter().chain(right).flat_map(|e| [*e, world.graph.magnitude(*e)]).collect();
    if world.graph.cut_short().is_some() {
        return None;
    }
    let tape = Tape::compile(&world.graph, &outputs);
    let sources: Vec<_> = tape.inputs().iter().map(|s| system::source(world, *s)).collect();
    let mut work = Workspace::default();
    let mut sample = Sample { symbols: tape.inputs().to_vec(), states: Vec::new() };
    for _ in 0..TRIES {
        let draws = sources.iter().map(|s| draw(&mut random, s.range, s.integer, false));
        let inputs: Vec<Tracked<Df64>> =
            draws.map(|d| Tracked::from_ratio(i128::from(d.num), i128::from(d.den), &())).collect();
        let out = tape.eval(&inputs, &(), &mut work);
        if out.iter().all(Number::is_finite) {
            let sized: Vec<Sized> = out.chunks(2).map(|q| (q[0].clone(), q[1].clone())).collect();
            sample.states.push((inputs, sized[..left.len()].to_vec(), sized[left.len()..].to_vec()));
        }
        if sample.states.len() == STATES {
            return Some(sample);
        }
    }
    None
}

/// The powers of symbols that the ratio of the residuals may be a product of: fitted in doubles to the logarithms of the
/// ratios. Whether it is one is then found by [`proportional`].
fn powers(world: &World, sample: &Sample) -> Option<Vec<(usize, i32)>> {
    let eligible = |s: &SymId| world.facts(*s).range.is_some_and(|[low, high]| low > 0.0 || high < 0.0);
    let places: Vec<usize> = (0..sample.symbols.len()).filter(|k| eligible(&sample.symbols[*k])).collect();
    let rows: Vec<(Vec<f64>, f64)> = sample
        .states
        .iter()
        .filter_map(|(values, left, right)| {
            let k = (0..left.len()).find(|k| sure(&left[*k]) && sure(&right[*k]))?;
            let logs = places.iter().map(|p| values[*p].log2_abs()).chain([1.0]).collect();
            Some((logs, right[k].0.log2_abs() - left[k].0.log2_abs()))
        })
        .collect();
    // With as many unknowns as states any ratio would fit.
    if rows.len() < places.len() + 1 {
        return None;
    }
    let matrix = nalgebra::DMatrix::from_fn(rows.len(), places.len() + 1, |i, j| rows[i].0[j]);
    let ratios = nalgebra::DVector::from_iterator(rows.len(), rows.iter().map(|r| r.1));
    let fit = matrix.svd(true, true).solve(&ratios, 1e-9).ok()?;
    let near = |x: f64| (x - x.round()).abs() < 1e-6 && x.abs() < 4.5;
    if !fit.iter().take(places.len()).all(|x| near(*x)) {
        return None;
    }
    Some(places.into_iter().zip(fit.iter()).map(|(p, x)| (p, x.round() as i32)).filter(|(_, n)| *n != 0).collect())
}

/// Whether the right residuals are c f times the left ones: r' f R - r f' R' = 0, with R, R' the largest.
fn proportional(sample: &Sample, ordered: bool, powers: &[(usize, i32)]) -> bool {
    let mut all: Vec<(Sized, Sized)> = Vec::new();
    for (values, left, right) in &sample.states {
        let factor =
            powers.iter().fold(Tracked::<Df64>::from_ratio(1, 1, &()), |f, (p, n)| f.times(&values[*p].to_the(*n)));
        let size = if factor.to_f64() < 0.0 { Tracked::zero(&()).minus(&factor) } else { factor.clone() };
        let scaled = left.iter().map(|l| (l.0.times(&factor), l.1.times(&size)));
        all.extend(scaled.zip(right.iter().cloned()));
    }
    let size = |v: &(Sized, Sized)| v.0.0.log2_abs();
    let Some((first, second)) = all.iter().max_by(|x, y| size(x).total_cmp(&size(y))) else { return false };
    if !sure(first) || !sure(second) || ordered && (first.0.to_f64() < 0.0) != (second.0.to_f64() < 0.0) {
        return false;
    }
    let times = |x: &Sized, y: &Sized| (x.0.times(&y.0), x.1.times(&y.1));
    all.iter().all(|(a, b)| {
        let (p, q) = (times(b, first), times(a, second));
        is_zero(&(p.0.minus(&q.0), p.1.plus(&q.1)))
    })
}

fn finding(x: &Sized) -> Option<Finding> {
    let (lhs, rhs) = (x.0.clone(), Tracked::exact(Df64::zero(&())));
    let value = PairValue { residual: x.0.clone(), lhs, rhs, scale_log2: x.1.value().log2_abs() };
    findings(&[value]).first().copied()
}

fn is_zero(x: &Sized) -> bool {
    matches!(finding(x), Some(Finding::Agree(_)))
}

fn sure(x: &Sized) -> bool {
    matches!(finding(x), Some(Finding::Differ(_)))
}
