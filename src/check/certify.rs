//! Certified counterexamples: proofs by intervals that a link fails at a state.
//!
//! The state's free symbols are exact decimals, and so exact fractions. The symbols that the premises determine are
//! enclosed in a box in which Krawczyk's operator proves that the premises have exactly one solution. There both sides
//! are evaluated, in rising precision, until zero is excluded from their difference.
//!
//! The promise: a certificate is given only where it is proved by the intervals alone that (a) the free symbols are exact
//! and in their declared ranges, (b) the premises have a solution in the box given, with the signs that their ranges
//! declare, and those that say what is greater hold there, (c) both sides are defined, and (d) differ: for an inequality,
//! that their difference has the sign it must not have. What was seen in doubles before is a place to look at, and
//! decides nothing.
//!
//! Premises that the state was not solved for, because they follow from the others, must be proved as well: their
//! residual must be the point zero. Intervals cannot prove that where they have a width; then a state near by is looked
//! for at which all is a fraction and nothing is rounded.

mod fractions;
mod krawczyk;

use std::cmp::Ordering;

use rug::{Float, Rational};

use crate::expr::{SymId, Tape, Workspace};
use crate::latex::ast::Rel;
use crate::number::{Interval, Number};

use super::decide::satisfies;
use super::sampling::Sampler;
use super::system::State;
use super::verdict::{Certificate, Enclosure, ExactValue, LinkJudgement, Strength};
use krawczyk::{Equations, Unproved, evaluate};

/// The precisions that are tried, in bits.
const PRECISIONS: [u32; 5] = [64, 128, 256, 512, 1024];

/// The significant digits of brackets.
const DIGITS: usize = 6;

/// Why a counterexample is not certified.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Uncertified {
    /// A free symbol is where it must not be.
    #[error("{0} lies outside its range at the state that was found")]
    OutOfRange(String),
    /// An unknown may have the wrong sign.
    #[error("{0} is not proved to have the sign that its range declares")]
    Sign(String),
    /// A premise may not hold.
    #[error("a premise that says what is greater is not proved to hold there")]
    Order,
    /// The solution of the premises is not unique, or nearly not.
    #[error("the premises do not determine the solved symbols uniquely there: their Jacobian is singular")]
    Singular,
    /// Something has no bounded interval.
    #[error("it cannot be proved that everything is defined there")]
    Undefined,
    /// Krawczyk's operator is no contraction.
    #[error("it cannot be proved that the premises have a solution there")]
    NoSolution,
    /// Premises beyond those that are solved.
    #[error(
        "{0} of the premises hold there as far as intervals can tell, but are not proved to follow from the others"
    )]
    Dependent(usize),
    /// Premises that do not hold.
    #[error("the premises contradict each other there")]
    Contradiction,
    /// None is left.
    #[error("the time is used up")]
    Time,
    /// The sides may be equal.
    #[error("their difference cannot be told from zero with {0} bits")]
    Open(u32),
}

impl From<Unproved> for Uncertified {
    fn from(why: Unproved) -> Self {
        match why {
            Unproved::Singular => Uncertified::Singular,
            Unproved::Undefined => Uncertified::Undefined,
            Unproved::NotContracted => Uncertified::NoSolution,
        }
    }
}

/// What a state must be proved to violate.
pub enum Claimed<'t> {
    /// An equality.
    Equal,
    /// An inequality, and the condition that it is to be equivalent to: the relation of its difference to zero.
    Ordered(Rel, Option<(Rel, &'t Tape)>),
}

/// Proves that a claim fails at a state, and writes into its judgement that it is certified, or why it is not. `idle` are
/// the symbols that a reader need not be shown.
pub fn certify(judgement: &mut LinkJudgement, sampler: &Sampler, state: &State, claimed: &Claimed, idle: &[SymId]) {
    let outcome = proved(sampler, state, claimed, idle);
    let Some(counterexample) = &mut judgement.counterexample else { return };
    match outcome {
        Ok(certificate) => {
            counterexample.certificate = Some(certificate);
            judgement.strength = Some(Strength::Certified);
        }
        Err(why) => counterexample.uncertified = Some(why.to_string()),
    }
}

fn proved(sampler: &Sampler, state: &State, claimed: &Claimed, idle: &[SymId]) -> Result<Certificate, Uncertified> {
    in_ranges(sampler, state)?;
    by_intervals(sampler, state, claimed, idle)
        .or_else(|why| fractions::certificate(sampler, state, claimed, idle).ok_or(why))
}

/// The certificate at the lowest precision that gives one.
fn by_intervals(
    sampler: &Sampler,
    state: &State,
    claimed: &Claimed,
    idle: &[SymId],
) -> Result<Certificate, Uncertified> {
    let mut why = Uncertified::Time;
    for bits in PRECISIONS {
        if sampler.deadline().has_passed() {
            break;
        }
        match attempt(sampler, state, claimed, idle, bits) {
            // A higher precision changes nothing of these.
            Err(e @ (Uncertified::Singular | Uncertified::Contradiction | Uncertified::Dependent(_))) => return Err(e),
            Err(e) => why = e,
            done => return done,
        }
    }
    Err(why)
}

fn attempt(
    sampler: &Sampler,
    state: &State,
    claimed: &Claimed,
    idle: &[SymId],
    bits: u32,
) -> Result<Certificate, Uncertified> {
    let at = enclosed(sampler, state, bits)?;
    let differences = differences(sampler, &at, claimed, bits)?;
    let world = &sampler.claim.world;
    let exact = |(source, value): (&super::system::Source, &super::random::Decimal)| ExactValue {
        symbol: world.tex(source.symbol),
        value: Rational::from((value.num, value.den)).to_string(),
        idle: idle.contains(&source.symbol),
    };
    let mentioned = sampler.tape.inputs();
    let solved = sampler.system.unknowns.iter().filter_map(|u| {
        let idle = !mentioned.contains(&u.symbol);
        bracket(Some(world.tex(u.symbol)), &at[u.symbol.index()], idle)
    });
    Ok(Certificate {
        bits: Some(bits),
        state: sampler.system.free.iter().zip(&state.free).map(exact).collect(),
        solved: solved.collect(),
        differences,
    })
}

fn bracket(name: Option<String>, value: &Interval, idle: bool) -> Option<Enclosure> {
    value.bracket(DIGITS).map(|(low, high)| Enclosure { name, low, high, idle })
}

/// Whether the free symbols are where they are declared to be.
fn in_ranges(sampler: &Sampler, state: &State) -> Result<(), Uncertified> {
    for (source, value) in sampler.system.free.iter().zip(&state.free) {
        let value = Rational::from((value.num, value.den));
        let within = source.range[0] <= value && value <= source.range[1];
        if source.declared && !within || source.integer && !value.is_integer() {
            return Err(Uncertified::OutOfRange(sampler.claim.world.tex(source.symbol)));
        }
    }
    Ok(())
}

/// Enclosures of all symbols by their numbers: the free ones by their exact values, the others by the box in which the
/// premises are proved to have exactly one solution.
fn enclosed(sampler: &Sampler, state: &State, bits: u32) -> Result<Vec<Interval>, Uncertified> {
    let system = &sampler.system;
    let mut at = vec![Interval::invalid(bits); system.symbols];
    for (source, value) in system.free.iter().zip(&state.free) {
        at[source.symbol.index()] = Interval::from_ratio(value.num.into(), value.den.into(), &bits);
    }
    if !system.unknowns.is_empty() {
        let unknowns: Vec<SymId> = system.unknowns.iter().map(|u| u.symbol).collect();
        // As near as doubles are: narrowing does the rest.
        let centre: Vec<Float> = unknowns.iter().map(|u| Float::with_val(bits, state.values[u.index()])).collect();
        let equations = Equations { values: &system.values, jacobian: &system.jacobian, unknowns: &unknowns };
        equations.enclose(&mut at, &centre, bits)?;
    }
    signs(sampler, &at)?;
    allowed(sampler, &at, bits)?;
    dependent(sampler, &at, bits)?;
    Ok(at)
}

/// Whether the solved symbols have the signs that their ranges declare.
fn signs(sampler: &Sampler, at: &[Interval]) -> Result<(), Uncertified> {
    for u in sampler.system.unknowns.iter().filter(|u| u.declared) {
        let value = &at[u.symbol.index()];
        let (never_negative, never_positive) = (*value.lo() >= 0, *value.hi() <= 0);
        if u.range[0] >= 0.0 && !never_negative || u.range[1] <= 0.0 && !never_positive {
            return Err(Uncertified::Sign(sampler.claim.world.tex(u.symbol)));
        }
    }
    Ok(())
}

/// Whether the premises that say what is greater are proved to hold.
fn allowed(sampler: &Sampler, at: &[Interval], bits: u32) -> Result<(), Uncertified> {
    let values = evaluate(&sampler.ordered, at, bits, &mut Workspace::default());
    let positive = values.iter().all(|x| x.sign() == Some(Ordering::Greater));
    if positive { Ok(()) } else { Err(Uncertified::Order) }
}

/// Whether the premises that were not solved for are proved to vanish.
fn dependent(sampler: &Sampler, at: &[Interval], bits: u32) -> Result<(), Uncertified> {
    let values = evaluate(&sampler.system.rest, at, bits, &mut Workspace::default());
    let residuals: Vec<&Interval> = values.iter().step_by(2).collect();
    if residuals.iter().any(|r| r.excludes_zero()) {
        return Err(Uncertified::Contradiction);
    }
    match residuals.iter().filter(|r| r.sign() != Some(Ordering::Equal)).count() {
        0 => Ok(()),
        n => Err(Uncertified::Dependent(n)),
    }
}

/// The enclosures of left minus right which prove that the claim fails: of the two branches of ± both must.
fn differences(
    sampler: &Sampler,
    at: &[Interval],
    claimed: &Claimed,
    bits: u32,
) -> Result<Vec<Enclosure>, Uncertified> {
    let values = evaluate(&sampler.tape, at, bits, &mut Workspace::default());
    let wanted = wanted(claimed, at, bits)?;
    let mut quadruples = values.chunks(4);
    let mut all = Vec::new();
    for branch in &sampler.claim.branches {
        let sides: Vec<&[Interval]> = quadruples.by_ref().take(branch.len()).collect();
        if !sides.iter().all(|q| q[..3].iter().all(Interval::is_bounded)) {
            return Err(Uncertified::Undefined);
        }
        let refutes = |difference: &Interval| match claimed {
            Claimed::Equal => difference.excludes_zero(),
            Claimed::Ordered(rel, _) => difference.sign().is_some_and(|s| satisfies(*rel, s as i32) != wanted),
        };
        let place = sides.iter().position(|q| refutes(&q[0])).ok_or(Uncertified::Open(bits))?;
        all.extend(bracket(branch[place].name.clone(), &sides[place][0], false));
    }
    Ok(all)
}

/// Whether the condition of an inequality is proved to hold, or not to; without a condition the inequality must hold.
fn wanted(claimed: &Claimed, at: &[Interval], bits: u32) -> Result<bool, Uncertified> {
    let Claimed::Ordered(_, Some((rel, tape))) = claimed else { return Ok(true) };
    let values = evaluate(tape, at, bits, &mut Workspace::default());
    let sign = values.first().and_then(Interval::sign).ok_or(Uncertified::Open(bits))?;
    Ok(satisfies(*rel, sign as i32))
}

#[cfg(test)]
mod tests;
