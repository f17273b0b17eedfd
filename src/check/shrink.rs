//! Small counterexamples: short numbers in place of random ones, and only the symbols that matter.

use crate::expr::{SymId, Workspace};
use crate::number::{Df64, Number, Tracked};

use super::random::Decimal;
use super::sampling::Sampler;
use super::system::State;

/// The numbers that are tried for a symbol, the simplest first.
const SIMPLE: [(i64, i64); 10] = [(0, 1), (1, 1), (2, 1), (3, 1), (-1, 1), (1, 2), (4, 1), (5, 1), (10, 1), (3, 2)];

/// A difference between the sides that stays visible in the digits that are shown.
const VISIBLE: f64 = 1e-2;

/// A failing state made small.
pub struct Small {
    /// The state.
    pub state: State,
    /// The free symbols on which the sides do not depend.
    pub idle: Vec<SymId>,
}

/// Makes a state small at which a pair of the first branch differs: each symbol in turn takes the simplest value of its
/// range at which the pair still differs visibly, or as visibly as it did.
pub fn shrink(sampler: &Sampler, state: &State, pair: usize) -> Small {
    let mut shrinker = Shrinker { sampler, pair, work: Workspace::default() };
    let mut best = state.clone();
    let Some(first) = shrinker.sides(&best) else { return Small { state: best, idle: Vec::new() } };
    let wanted = first.difference.min(VISIBLE);
    let deadline = sampler.deadline();
    for k in (0..best.free.len()).take_while(|_| !deadline.has_passed()) {
        for value in shrinker.candidates(k, best.free[k]) {
            if let Some((trial, sides)) = shrinker.with(&best, k, value)
                && sides.difference >= wanted
            {
                best = trial;
                break;
            }
        }
    }
    let idle =
        (0..best.free.len()).filter(|k| !deadline.has_passed() && shrinker.is_idle(&best, *k)).collect::<Vec<_>>();
    Small { state: best, idle: idle.into_iter().map(|k| sampler.system.free[k].symbol).collect() }
}

/// The sides of the pair at a state.
#[derive(Clone, Debug, PartialEq)]
struct Sides {
    lhs: String,
    rhs: String,
    /// The residual relative to the terms; 0 where it is within rounding.
    difference: f64,
}

struct Shrinker<'s, 'c> {
    sampler: &'s Sampler<'c>,
    pair: usize,
    work: Workspace<Tracked<Df64>>,
}

impl Shrinker<'_, '_> {
    /// The simple values within a symbol's range, then its own value with fewer digits.
    fn candidates(&self, k: usize, own: Decimal) -> Vec<Decimal> {
        let source = &self.sampler.system.free[k];
        let within = |v: &Decimal| (source.range[0]..=source.range[1]).contains(&v.to_f64());
        let simple = SIMPLE.iter().map(|(num, den)| Decimal { num: *num, den: *den });
        let rounded = (0..2).map(|digits| Decimal::near(own.to_f64(), digits));
        simple.chain(rounded).filter(|v| within(v) && (!source.integer || v.den == 1)).collect()
    }

    /// The state with another value of a free symbol, the premises solved again.
    fn with(&mut self, state: &State, k: usize, value: Decimal) -> Option<(State, Sides)> {
        let mut trial = state.clone();
        trial.free[k] = value;
        trial.values[self.sampler.system.free[k].symbol.index()] = value.to_f64();
        let start: Vec<f64> = self.sampler.system.unknowns.iter().map(|u| state.values[u.symbol.index()]).collect();
        self.sampler.system.solve(&mut trial, &start).ok().filter(|()| self.sampler.is_allowed(&trial))?;
        let sides = self.sides(&trial)?;
        Some((trial, sides))
    }

    fn sides(&mut self, state: &State) -> Option<Sides> {
        let branches = self.sampler.evaluate::<Df64>(state, &(), &mut self.work)?;
        let values = branches.first()?;
        let scale = values.iter().map(|v| v.scale_log2).fold(f64::NEG_INFINITY, f64::max);
        let value = values.get(self.pair).filter(|v| v.is_finite())?;
        // With several branches each must differ.
        let differ = branches.iter().all(|b| b.iter().any(|v| v.is_finite() && !v.residual.is_zero_within()));
        let visible = differ && !value.residual.is_zero_within();
        let difference = if visible { (value.residual.value().log2_abs() - scale).exp2() } else { 0.0 };
        Some(Sides { lhs: value.lhs.value().to_decimal(20), rhs: value.rhs.value().to_decimal(20), difference })
    }

    /// Whether the sides stay the same, to twenty digits, when a free symbol takes another value.
    fn is_idle(&mut self, state: &State, k: usize) -> bool {
        let source = &self.sampler.system.free[k];
        let middle = Decimal::near(0.5 * (source.range[0] + source.range[1]), 3);
        let other = if middle == state.free[k] { Decimal::near(source.range[0], 3) } else { middle };
        let Some(before) = self.sides(state) else { return false };
        !source.integer && self.with(state, k, other).is_some_and(|(_, after)| after == before)
    }
}
