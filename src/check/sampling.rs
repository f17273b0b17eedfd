//! Evaluating a claim at states: drawing them, refining them, and the values of the residuals there with bounds on
//! their errors.

use std::collections::{BTreeMap, BTreeSet};

use crate::expr::{Deadline, Expr, Node, SymId, Tape, Workspace};
use crate::latex::ast::Rel;
use crate::number::{Number, Real, Tracked};

use super::claim::{Claim, Pair};
use super::random::{Decimal, Random};
use super::system::{NoState, State, System, Wish};
use super::verdict::{Assignment, Counterexample};

/// How many states are drawn for each that is asked for, before giving up.
const TRIES: usize = 40;

/// The values of one pair at a state.
#[derive(Clone, Debug)]
pub struct PairValue<N: Number> {
    /// Left minus right.
    pub residual: Tracked<N>,
    /// The left side.
    pub lhs: Tracked<N>,
    /// The right side.
    pub rhs: Tracked<N>,
    /// log₂ of the sum of the magnitudes of the residual's terms.
    pub scale_log2: f64,
}

impl<N: Real> PairValue<N> {
    /// log₂ of the bound on the residual's rounding error.
    pub fn error_log2(&self) -> f64 {
        self.residual.error_log2()
    }

    /// Whether every value is a number.
    pub fn is_finite(&self) -> bool {
        self.residual.is_finite() && self.lhs.is_finite() && self.rhs.is_finite()
    }
}

/// A claim compiled.
pub struct Sampler<'c> {
    /// The claim.
    pub claim: &'c Claim,
    /// Its premises compiled.
    pub system: System,
    /// For each pair of each branch: residual, lhs, rhs, sum of magnitudes.
    pub(super) tape: Tape,
    /// The pairs' numbers by branch.
    branches: Vec<usize>,
    /// Starts for unknowns that one side gives: the unknown's place and the tape of the other side.
    hints: Vec<(usize, Tape)>,
    /// What must be positive.
    pub(super) ordered: Tape,
}

impl<'c> Sampler<'c> {
    /// Compiles a claim. `extra` are expressions that are evaluated at the same states (a condition's sides).
    pub fn new(claim: &'c mut Claim, random: &mut Random, extra: &[Expr]) -> Result<Self, NoState> {
        let mut outputs = Vec::new();
        for pair in claim.branches.iter().flatten() {
            let size = claim.world.graph.magnitude(pair.residual);
            outputs.extend([pair.residual, pair.lhs, pair.rhs, size]);
        }
        let mut targets = outputs.clone();
        targets.extend(extra);
        let ordered = restricting(claim, &targets);
        targets.extend(&ordered);
        let kept: BTreeSet<SymId> = claim.small.iter().map(|(s, _)| *s).collect();
        let wish = Wish { solve: &claim.solve, free: &kept };
        let residuals = claim.premises.residuals.clone();
        let system = System::new(&mut claim.world, &residuals, &targets, &wish, random)?;
        NoState::check(&mut claim.world, "writing both sides out")?;
        let hints = hints(claim, &system);
        let tape = Tape::compile(&claim.world.graph, &outputs);
        let branches = claim.branches.iter().map(Vec::len).collect();
        let ordered = Tape::compile(&claim.world.graph, &ordered);
        Ok(Sampler { claim, system, tape, branches, hints, ordered })
    }

    /// When the time is used up.
    pub fn deadline(&self) -> Deadline {
        self.claim.world.graph.deadline()
    }

    /// Draws states until enough satisfy the premises; the last eighth near the ends of the ranges.
    pub fn states(
        &self,
        count: usize,
        random: &mut Random,
        fixed: &BTreeMap<SymId, Decimal>,
    ) -> Result<Vec<State>, NoState> {
        let mut states = Vec::with_capacity(count);
        let mut last = NoState::Diverges;
        let deadline = self.deadline();
        for k in 0..count {
            let hard = k >= count - count / 8 && count >= 8;
            for _ in 0..TRIES {
                if deadline.has_passed() {
                    return Err(NoState::CutShort(deadline.used_up("solving the premises")));
                }
                let (mut state, start) = self.system.draw(random, hard, fixed);
                match self.system.solve(&mut state, &start) {
                    Ok(()) if self.is_defined(&state) && self.is_allowed(&state) => {
                        states.push(state);
                        break;
                    }
                    Ok(()) => last = NoState::Diverges,
                    Err(e) => last = e,
                }
            }
            if states.is_empty() && k >= 3 {
                break;
            }
        }
        if states.is_empty() { Err(last) } else { Ok(states) }
    }

    /// The start of an iteration with what the formula itself says of the unknowns: for approximations, which may be
    /// meant for one root of several. An equality must hold whichever root the premises have.
    pub fn hinted(&self, state: &State, mut start: Vec<f64>) -> Vec<f64> {
        for (unknown, tape) in &self.hints {
            let inputs: Vec<f64> = tape.inputs().iter().map(|s| state.values[s.index()]).collect();
            let value = tape.eval(&inputs, &(), &mut Workspace::default())[0];
            if value.is_finite() {
                start[*unknown] = value;
            }
        }
        start
    }

    /// Whether the premises that say what is greater hold at a state.
    pub fn is_allowed(&self, state: &State) -> bool {
        let inputs: Vec<f64> = self.ordered.inputs().iter().map(|s| state.values[s.index()]).collect();
        self.ordered.eval(&inputs, &(), &mut Workspace::default()).iter().all(|x| *x > 0.0)
    }

    /// Whether all sides are numbers at a state; where no state is, the judgement says so.
    fn is_defined(&self, state: &State) -> bool {
        let inputs: Vec<f64> = self.tape.inputs().iter().map(|s| state.values[s.index()]).collect();
        self.tape.eval(&inputs, &(), &mut Workspace::default()).iter().all(|x| x.is_finite())
    }

    /// The values of all pairs at a state, branch by branch; `None` where the refinement fails.
    pub fn evaluate<N: Real>(
        &self,
        state: &State,
        cx: &N::Context,
        work: &mut Workspace<Tracked<N>>,
    ) -> Option<Vec<Vec<PairValue<N>>>> {
        let values = self.system.refine::<N>(state, cx)?;
        let inputs: Vec<Tracked<N>> = self.tape.inputs().iter().map(|s| values[s.index()].clone()).collect();
        let out = self.tape.eval(&inputs, cx, work);
        let mut quadruples = out.chunks(4);
        let mut branches = Vec::new();
        for n in &self.branches {
            let pairs = quadruples.by_ref().take(*n).map(|q| PairValue {
                residual: q[0].clone(),
                lhs: q[1].clone(),
                rhs: q[2].clone(),
                scale_log2: q[3].value().log2_abs(),
            });
            branches.push(pairs.collect());
        }
        Some(branches)
    }

    /// A state for the reader, with the values of a pair's sides. Symbols that are `idle` are left out.
    pub fn counterexample<N: Real>(
        &self,
        state: &State,
        cx: &N::Context,
        pair: &Pair,
        value: &PairValue<N>,
        idle: &[SymId],
    ) -> Counterexample {
        let world = &self.claim.world;
        let mentioned = self.tape.inputs();
        let mut assignments: Vec<Assignment> = Vec::new();
        for (source, value) in self.system.free.iter().zip(&state.free) {
            if !idle.contains(&source.symbol) {
                assignments.push(Assignment { symbol: world.tex(source.symbol), value: value.to_string() });
            }
        }
        if let Some(values) = self.system.refine::<N>(state, cx) {
            for u in self.system.unknowns.iter().filter(|u| mentioned.contains(&u.symbol)) {
                let value = values[u.symbol.index()].value().to_decimal(8);
                assignments.push(Assignment { symbol: world.tex(u.symbol), value });
            }
        }
        Counterexample {
            state: assignments,
            lhs: shown(&value.lhs, 12),
            rhs: shown(&value.rhs, 12),
            component: pair.name.clone(),
            certificate: None,
            uncertified: None,
        }
    }
}

/// What must be positive at a state, by the premises that say what is greater and speak of the claim's symbols. The
/// border, where both sides are equal, is left out: it has no states to speak of.
fn restricting(claim: &mut Claim, targets: &[Expr]) -> Vec<Expr> {
    let graph = &mut claim.world.graph;
    let all: Vec<Expr> = targets.iter().chain(&claim.premises.residuals).copied().collect();
    let known = graph.symbols(&all);
    let is_related = |e: Expr| {
        let symbols = graph.symbols(&[e]);
        symbols.is_empty() || !symbols.is_disjoint(&known)
    };
    let related: Vec<_> = claim.ordered.iter().filter(|(_, e)| is_related(*e)).copied().collect();
    let positive = |(rel, e)| if matches!(rel, Rel::Lt | Rel::Le) { graph.neg(e) } else { e };
    related.into_iter().map(positive).collect()
}

/// A value in decimal; what cannot be told from zero is shown as zero.
pub fn shown<N: Real>(value: &Tracked<N>, digits: usize) -> String {
    if value.is_finite() && value.is_zero_within() { "0".into() } else { value.value().to_decimal(digits) }
}

/// Where a side is an unknown alone, the other side is where to start: a formula for one of several roots finds its own.
fn hints(claim: &Claim, system: &System) -> Vec<(usize, Tape)> {
    let graph = &claim.world.graph;
    let unknowns: Vec<SymId> = system.unknowns.iter().map(|u| u.symbol).collect();
    let mut hints = Vec::new();
    if claim.branches.len() > 1 {
        return hints;
    }
    for pair in claim.branches.iter().flatten() {
        for (side, other) in [(pair.lhs, pair.rhs), (pair.rhs, pair.lhs)] {
            let Node::Symbol(s) = *graph.node(side) else { continue };
            let Some(place) = unknowns.iter().position(|u| *u == s) else { continue };
            if graph.symbols(&[other]).iter().all(|x| !unknowns.contains(x)) {
                hints.push((place, Tape::compile(graph, &[other])));
            }
        }
    }
    hints
}

/// Why no state was found, in words.
pub fn no_state_text(reason: &NoState) -> String {
    match reason {
        NoState::Unsolvable => "no state was found at which all premises hold: they contradict each other, or have no solution in the ranges of the symbols",
        NoState::Diverges => "no state was found at which the premises hold and both sides are numbers; check the premises, and the ranges of the symbols",
        NoState::Contradiction => "the premises contradict each other at the sampled states",
        NoState::CutShort(why) => why,
    }
    .to_owned()
}
