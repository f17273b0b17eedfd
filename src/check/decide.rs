//! Deciding equalities and inequalities from values with bounds on their errors.
//!
//! Promises: a side is said to differ only where the residual exceeds the running bound of its own rounding error, the
//! errors of the solved premises included; it is said to agree only where that bound is small against the terms it
//! is made of. No tolerance is chosen by hand. What neither bound decides is tried in higher precision, and then is
//! `undecided`.

use std::collections::BTreeMap;

use crate::expr::{SymId, Tape, Workspace};
use crate::latex::ast::Rel;
use crate::number::{Df64, Number, Real};

use super::claim::Claim;
use super::exact;
use super::lost::lost_bits;
use super::options::Options;
use super::random::Random;
use super::sampling::{PairValue, Sampler, no_state_text};
use super::shrink::shrink;
use super::system::State;
use super::verdict::{LinkJudgement, Strength, Verdict};

/// The bits to which the sides must be known to agree before a state counts as agreeing: half of a double's, so that
/// no misprint hides beneath.
const LEAST_BITS: f64 = 26.0;

/// What a state says of a pair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Finding {
    /// The sides agree to so many bits.
    Agree(f64),
    /// They differ; the residual relative to the terms.
    Differ(f64),
    /// The error is too large to tell.
    Open,
}

fn finding<N: Real>(value: &PairValue<N>, scale_log2: f64) -> Finding {
    if !value.is_finite() {
        return Finding::Open;
    }
    let size = value.residual.value().log2_abs();
    if !value.residual.is_zero_within() {
        return Finding::Differ((size - scale_log2).exp2());
    }
    let bits = scale_log2 - value.error_log2().max(size);
    // Where nothing is left of the terms they must be zero, not too small for the numbers.
    let zero = scale_log2 == f64::NEG_INFINITY && value.error_log2() == f64::NEG_INFINITY;
    if zero || bits >= LEAST_BITS { Finding::Agree(bits.min(1e6)) } else { Finding::Open }
}

/// The findings of all pairs of a branch; vectors are measured by their largest component.
pub(super) fn findings<N: Real>(pairs: &[PairValue<N>]) -> Vec<Finding> {
    let scale = pairs.iter().map(|p| p.scale_log2).fold(f64::NEG_INFINITY, f64::max);
    pairs.iter().map(|p| finding(p, scale)).collect()
}

/// What all states say.
#[derive(Default)]
struct Tally {
    states: usize,
    failing: usize,
    open: usize,
    bits: Option<f64>,
    residual: f64,
    first_failing: Option<(usize, usize)>,
    branch_hit: Vec<bool>,
}

/// Judges an equality: by values, and where these agree, in the prime field.
pub fn equality(judgement: LinkJudgement, mut claim: Claim, name: &str, options: &Options) -> LinkJudgement {
    let (mut judgement, unknowns) = by_values(judgement, &mut claim, name, options);
    if judgement.verdict == Verdict::Holds {
        match exact::test(&mut claim, &unknowns, &mut Random::new(options.seed, name)) {
            Ok(exact) => {
                judgement.strength = Some(Strength::Exact);
                judgement.exact = Some(exact);
            }
            Err(why) => judgement.inexact = Some(why.to_string()),
        }
    }
    judgement
}

/// The judgement by values at random states, and the symbols that the premises were solved for.
fn by_values(
    judgement: LinkJudgement,
    claim: &mut Claim,
    name: &str,
    options: &Options,
) -> (LinkJudgement, Vec<SymId>) {
    let mut random = Random::new(options.seed, name);
    let sampler = match Sampler::new(claim, &mut random, &[]) {
        Ok(sampler) => sampler,
        Err(e) => return (LinkJudgement { reason: Some(no_state_text(&e)), ..judgement }, Vec::new()),
    };
    let unknowns = sampler.system.unknowns.iter().map(|u| u.symbol).collect();
    let states = match sampler.states(options.states, &mut random, &BTreeMap::new()) {
        Ok(states) => states,
        Err(e) => return (LinkJudgement { reason: Some(no_state_text(&e)), ..judgement }, unknowns),
    };
    let mut judgement = refined(judgement, &sampler, &states, options);
    if options.evidence {
        judgement.lost_bits = lost_bits(&sampler, &states);
    }
    (judgement, unknowns)
}

/// Decides in double-double, and in higher precision where that is not enough.
fn refined(judgement: LinkJudgement, sampler: &Sampler, states: &[State], options: &Options) -> LinkJudgement {
    #[cfg(feature = "rug")]
    {
        use crate::number::Mpfr;
        if let Some(bits) = options.precision {
            return decide::<Mpfr>(judgement, sampler, states, &bits, options);
        }
        let first = decide::<Df64>(judgement.clone(), sampler, states, &(), options);
        if first.verdict == Verdict::Undecided {
            return decide::<Mpfr>(judgement, sampler, states, &256, options);
        }
        first
    }
    #[cfg(not(feature = "rug"))]
    decide::<Df64>(judgement, sampler, states, &(), options)
}

fn decide<N: Real>(
    mut judgement: LinkJudgement,
    sampler: &Sampler,
    states: &[State],
    cx: &N::Context,
    options: &Options,
) -> LinkJudgement {
    let mut tally = Tally { branch_hit: vec![false; sampler.claim.branches.len()], ..Tally::default() };
    let mut work = Workspace::default();
    let deadline = sampler.deadline();
    for (k, state) in states.iter().enumerate() {
        if deadline.has_passed() {
            break;
        }
        match sampler.evaluate::<N>(state, cx, &mut work) {
            Some(branches) => tally.add(k, &branches),
            None => tally.open += 1,
        }
    }
    judgement.states = tally.states;
    judgement.failing_states = tally.failing;
    judgement.residual = Some(tally.residual);
    if let Some((k, pair)) = tally.first_failing {
        judgement.verdict = Verdict::Fails;
        judgement.strength = Some(Strength::Numeric);
        if !options.evidence {
            return judgement;
        }
        let small = shrink(sampler, &states[k], pair);
        if let Some(branches) = sampler.evaluate::<N>(&small.state, cx, &mut work) {
            let (value, pair) = (&branches[0][pair], &sampler.claim.branches[0][pair]);
            judgement.counterexample = Some(sampler.counterexample(&small.state, cx, pair, value, &small.idle));
            proof(&mut judgement, sampler, &small.state, None, &small.idle, options);
        }
    } else if deadline.has_passed() {
        judgement.reason = Some(deadline.used_up("evaluating both sides"));
    } else if let Some(branch) = tally.branch_hit.iter().position(|hit| !hit).filter(|_| tally.open == 0) {
        let sign = if branch == 0 { "upper" } else { "lower" };
        judgement.verdict = Verdict::Fails;
        judgement.strength = Some(Strength::Numeric);
        judgement.reason = Some(format!("the {sign} sign never gives a solution"));
    } else if tally.open * 4 > states.len() || tally.states == 0 {
        judgement.reason =
            Some(format!("the rounding errors hide the answer at {} of {} states", tally.open, states.len()));
    } else {
        judgement.verdict = Verdict::Holds;
        judgement.strength = Some(Strength::Numeric);
        judgement.bits = tally.bits.map(|b| b as u32);
        if tally.open > 0 {
            judgement.reason =
                Some(format!("{} states were left out: their rounding errors are too large", tally.open));
        }
    }
    judgement
}

/// A proof that a claim fails at the state of its counterexample. `condition` is what an inequality is to be equivalent to.
fn proof(
    judgement: &mut LinkJudgement,
    sampler: &Sampler,
    state: &State,
    condition: Option<(Rel, &Tape)>,
    idle: &[SymId],
    options: &Options,
) {
    #[cfg(feature = "rug")]
    if options.evidence {
        use super::certify::{Claimed, certify};
        let claimed = match sampler.claim.rel {
            rel @ (Rel::Lt | Rel::Le | Rel::Gt | Rel::Ge) => Claimed::Ordered(rel, condition),
            _ => Claimed::Equal,
        };
        certify(judgement, sampler, state, &claimed, idle);
    }
    #[cfg(not(feature = "rug"))]
    let _ = (judgement, sampler, state, condition, idle, options);
}

impl Tally {
    /// Takes in a state: with branches by ±, it agrees if one of them does.
    fn add<N: Real>(&mut self, k: usize, branches: &[Vec<PairValue<N>>]) {
        let all: Vec<Vec<Finding>> = branches.iter().map(|pairs| findings(pairs)).collect();
        let agrees = |f: &[Finding]| f.iter().all(|f| matches!(f, Finding::Agree(_)));
        for (hit, found) in self.branch_hit.iter_mut().zip(&all) {
            *hit |= agrees(found);
        }
        if let Some(found) = all.iter().find(|f| agrees(f)) {
            self.states += 1;
            for f in found {
                if let Finding::Agree(bits) = f {
                    self.bits = Some(self.bits.map_or(*bits, |b: f64| b.min(*bits)));
                    self.residual = self.residual.max((-bits).exp2());
                }
            }
            return;
        }
        let differs = |f: &Vec<Finding>| f.iter().position(|f| matches!(f, Finding::Differ(_)));
        let places: Vec<Option<usize>> = all.iter().map(differs).collect();
        if places.iter().any(Option::is_none) {
            self.open += 1;
            return;
        }
        self.states += 1;
        self.failing += 1;
        for f in all.iter().flatten() {
            if let Finding::Differ(r) = f {
                self.residual = self.residual.max(*r);
            }
        }
        if self.first_failing.is_none() {
            self.first_failing = places[0].map(|pair| (k, pair));
        }
    }
}

/// Judges an inequality: that it holds at every state that the premises allow, and where a condition is given, that it
/// holds exactly where the condition does.
pub fn inequality(mut judgement: LinkJudgement, mut claim: Claim, name: &str, options: &Options) -> LinkJudgement {
    let mut random = Random::new(options.seed, name);
    let condition = claim.condition.map(|(rel, a, b)| (rel, claim.world.graph.sub(a, b)));
    let extra: Vec<_> = condition.iter().map(|(_, e)| *e).collect();
    let tape = Tape::compile(&claim.world.graph, &extra);
    let sampled = Sampler::new(&mut claim, &mut random, &extra).and_then(|sampler| {
        // An inequality wants more states: it is its border that matters.
        let states = sampler.states(4 * options.states, &mut random, &BTreeMap::new())?;
        Ok((sampler, states))
    });
    let (sampler, states) = match sampled {
        Ok(found) => found,
        Err(e) => return LinkJudgement { reason: Some(no_state_text(&e)), ..judgement },
    };
    let mut work = Workspace::default();
    let mut condition_work = Workspace::default();
    let mut seen = [0usize; 2];
    let mut example = None;
    let deadline = sampler.deadline();
    for state in &states {
        if deadline.has_passed() {
            break;
        }
        let Some(branches) = sampler.evaluate::<Df64>(state, &(), &mut work) else { continue };
        let Some(values) = sampler.system.refine::<Df64>(state, &()) else { continue };
        let inputs: Vec<_> = tape.inputs().iter().map(|s| values[s.index()].clone()).collect();
        let wanted = match &condition {
            None => Some(true),
            Some((rel, _)) => {
                let value = &tape.eval(&inputs, &(), &mut condition_work)[0];
                sign(value).map(|s| satisfies(*rel, s))
            }
        };
        for (pair, value) in branches[0].iter().enumerate() {
            let holds = sign(&value.residual).map(|s| satisfies(sampler.claim.rel, s));
            let (Some(holds), Some(wanted)) = (holds, wanted) else { continue };
            judgement.states += 1;
            seen[usize::from(wanted)] += 1;
            if holds != wanted {
                judgement.failing_states += 1;
                if judgement.counterexample.is_none() {
                    let pair = &sampler.claim.branches[0][pair];
                    judgement.counterexample = Some(sampler.counterexample(state, &(), pair, value, &[]));
                    example = Some(state);
                }
            }
        }
    }
    judgement.strength = Some(Strength::Numeric);
    judgement.inexact = Some("a prime field has no order".into());
    judgement.verdict = if judgement.failing_states > 0 { Verdict::Fails } else { Verdict::Holds };
    if judgement.failing_states == 0 && deadline.has_passed() {
        judgement.verdict = Verdict::Undecided;
        judgement.strength = None;
        judgement.reason = Some(deadline.used_up("evaluating both sides"));
    } else if judgement.states == 0 || condition.is_some() && seen.contains(&0) {
        judgement.verdict = Verdict::Undecided;
        judgement.strength = None;
        judgement.reason = Some("the states lie all on one side of the condition: widen the ranges".into());
    } else if judgement.failing_states > 0 && condition.is_some() {
        judgement.reason = Some("the inequality and the condition are not equivalent".into());
    }
    if let (Verdict::Fails, Some(state)) = (judgement.verdict, example) {
        let condition = condition.as_ref().map(|(rel, _)| (*rel, &tape));
        proof(&mut judgement, &sampler, state, condition, &[], options);
    }
    judgement
}

/// The sign of a value where it is sure: -1, 0 (exactly zero), 1.
fn sign<N: Real>(value: &crate::number::Tracked<N>) -> Option<i32> {
    if !value.is_finite() {
        None
    } else if value.value().log2_abs() == f64::NEG_INFINITY && value.error_log2() == f64::NEG_INFINITY {
        Some(0)
    } else if value.is_zero_within() {
        None
    } else {
        Some(if value.value().to_f64() < 0.0 { -1 } else { 1 })
    }
}

pub(super) fn satisfies(rel: Rel, sign: i32) -> bool {
    match rel {
        Rel::Lt => sign < 0,
        Rel::Le => sign <= 0,
        Rel::Gt => sign > 0,
        Rel::Ge => sign >= 0,
        _ => sign == 0,
    }
}
