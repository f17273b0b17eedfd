//! States that satisfy premises: which symbols are free and which are solved for, Newton's method in doubles, and its
//! refinement in any number type with a bound on what is left of the error.

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::{DMatrix, DVector, Dyn, LU};

use crate::expr::{Cut, Expr, MOST_NODES, SymId, Tape, Workspace};
use crate::number::{Number, Real, Tracked};
use crate::semantics::World;

use super::choice::{choose, preference};
use super::newton::{Equations, descend};
use super::random::{Decimal, Random, draw};

/// The range of a symbol for which none is declared.
const DEFAULT_RANGE: [f64; 2] = [0.3, 2.0];

/// The stage before states are drawn, in words.
pub const DERIVING: &str = "deriving the premises by the symbols to solve for";

/// Premises with the choice of free and solved symbols, compiled.
pub struct System {
    /// The symbols that are drawn at random.
    pub free: Vec<Source>,
    /// The symbols that are solved for.
    pub unknowns: Vec<Source>,
    /// The independent residuals.
    pub(super) values: Tape,
    /// Their Jacobian by the unknowns, row by row.
    pub(super) jacobian: Tape,
    /// The residuals that depend on the others, each with the sum of the magnitudes of its terms.
    pub(super) rest: Tape,
    /// The number of symbols, those of the premises and of what is evaluated among them.
    pub(super) symbols: usize,
}

/// Where a symbol's values come from.
#[derive(Clone, Debug)]
pub struct Source {
    /// The symbol.
    pub symbol: SymId,
    /// The range it is drawn from; for an unknown the start of the iteration.
    pub range: [f64; 2],
    /// Whether it takes integers only.
    pub integer: bool,
    /// Whether a range was declared, and so its sign is known.
    pub declared: bool,
}

/// A state in doubles: the free symbols exactly, the unknowns nearly.
#[derive(Clone, Debug)]
pub struct State {
    /// The free symbols' values, in the order of [`System::free`].
    pub free: Vec<Decimal>,
    /// All values by the symbol's number; NaN where a symbol does not occur.
    pub values: Vec<f64>,
}

/// What a preference among the symbols to solve for looks at.
pub struct Wish<'a> {
    /// Symbols to be solved for first.
    pub solve: &'a [SymId],
    /// Symbols that must stay free.
    pub free: &'a BTreeSet<SymId>,
}

/// Why no state could be found.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NoState {
    /// The premises have no common solution near the declared ranges.
    Unsolvable,
    /// The iteration does not converge from the sampled states.
    Diverges,
    /// The premises contradict each other at the sampled states.
    Contradiction,
    /// The search was cut short: the claim is too large, or the time is used up.
    CutShort(String),
}

impl NoState {
    /// Whether a claim's graph was cut short, or its time is used up.
    pub fn check(world: &mut World, stage: &str) -> Result<(), NoState> {
        match world.graph.cut_short() {
            None => Ok(()),
            Some(Cut::Time) => Err(NoState::CutShort(world.graph.deadline().used_up(stage))),
            Some(Cut::Size) => Err(NoState::CutShort(format!(
                "{stage} takes more than {MOST_NODES} operations: let the sums have fewer terms, and state fewer premises"
            ))),
        }
    }
}

impl System {
    /// Chooses what to solve for and compiles the residuals. `targets` are what will be evaluated at the states.
    pub fn new(
        world: &mut World,
        residuals: &[Expr],
        targets: &[Expr],
        wish: &Wish,
        random: &mut Random,
    ) -> Result<Self, NoState> {
        let mut candidates: Vec<SymId> =
            world.graph.symbols(residuals).into_iter().filter(|s| !wish.free.contains(s)).collect();
        candidates.sort_by_key(|s| preference(&world.graph, wish.solve, *s));
        let (rows, columns) = choose(world, residuals, &candidates, wish, random)?;
        let chosen: Vec<Expr> = rows.iter().map(|r| residuals[*r]).collect();
        let solved: Vec<SymId> = columns.iter().map(|c| candidates[*c]).collect();
        // What is stated twice needs to hold once.
        let mut others: Vec<Expr> = residuals.iter().copied().filter(|r| !chosen.contains(r)).collect();
        others.sort_unstable();
        others.dedup();

        let jacobian = world.graph.jacobian(&chosen, &solved);
        let jacobian: Vec<Expr> = jacobian.into_iter().flatten().collect();
        let rest: Vec<Expr> = others.iter().flat_map(|r| [*r, world.graph.magnitude(*r)]).collect();
        let all: Vec<Expr> = residuals.iter().chain(targets).copied().collect();
        NoState::check(world, DERIVING)?;
        let free = world.graph.symbols(&all).into_iter().filter(|s| !solved.contains(s));
        Ok(System {
            free: free.map(|s| source(world, s)).collect(),
            unknowns: solved.iter().map(|s| source(world, *s)).collect(),
            jacobian: Tape::compile(&world.graph, &jacobian),
            values: Tape::compile(&world.graph, &chosen),
            rest: Tape::compile(&world.graph, &rest),
            symbols: world.graph.symbol_count(),
        })
    }

    /// Draws a state: the free symbols from their ranges, the unknowns by Newton's method from their own.
    pub fn draw(&self, random: &mut Random, hard: bool, fixed: &BTreeMap<SymId, Decimal>) -> (State, Vec<f64>) {
        let mut values = vec![f64::NAN; self.symbols];
        let free: Vec<Decimal> = self
            .free
            .iter()
            .map(|s| fixed.get(&s.symbol).copied().unwrap_or_else(|| draw(random, s.range, s.integer, hard)))
            .collect();
        for (source, value) in self.free.iter().zip(&free) {
            values[source.symbol.index()] = value.to_f64();
        }
        let start = self.unknowns.iter().map(|u| draw(random, u.range, false, false).to_f64()).collect();
        (State { free, values }, start)
    }

    /// Solves for the unknowns in doubles, from a start.
    pub fn solve(&self, state: &mut State, start: &[f64]) -> Result<(), NoState> {
        let mut work = Workspace::default();
        if self.unknowns.is_empty() {
            return self.check(state, &mut work);
        }
        let mut equations = Square { system: self, state, work: &mut work };
        let Some((x, _)) = descend(DVector::from_column_slice(start), &mut equations) else {
            return Err(NoState::Diverges);
        };
        self.place(state, &x);
        self.check(state, &mut work)
    }

    /// Whether the unknowns have the signs their ranges declare, and the premises that were left out hold as well.
    fn check(&self, state: &State, work: &mut Workspace<f64>) -> Result<(), NoState> {
        for u in &self.unknowns {
            let x = state.values[u.symbol.index()];
            if u.declared && (u.range[0] >= 0.0 && x < 0.0 || u.range[1] <= 0.0 && x > 0.0) {
                return Err(NoState::Unsolvable);
            }
        }
        let rest = evaluate(&self.rest, state, work);
        let holds = rest.chunks(2).all(|pair| pair[0].abs() <= 1e-7 * pair[1].max(f64::MIN_POSITIVE));
        if holds { Ok(()) } else { Err(NoState::Contradiction) }
    }

    fn place(&self, state: &mut State, x: &DVector<f64>) {
        for (u, x) in self.unknowns.iter().zip(x.iter()) {
            state.values[u.symbol.index()] = *x;
        }
    }

    fn newton_values(&self, state: &State, work: &mut Workspace<f64>) -> DMatrix<f64> {
        let n = self.unknowns.len();
        DMatrix::from_row_slice(n, n, evaluate(&self.jacobian, state, work))
    }

    /// The state in another number type. The free symbols are exact up to their own rounding; the unknowns are refined
    /// by Newton's method with the Jacobian in doubles, and carry the bound |J⁻¹| (|F| + rounding of F).
    pub fn refine<N: Real>(&self, state: &State, cx: &N::Context) -> Option<Vec<Tracked<N>>> {
        let mut values: Vec<Tracked<N>> = vec![Tracked::zero(cx); self.symbols];
        for (source, value) in self.free.iter().zip(&state.free) {
            values[source.symbol.index()] = Tracked::from_ratio(i128::from(value.num), i128::from(value.den), cx);
        }
        let n = self.unknowns.len();
        if n == 0 {
            return Some(values);
        }
        let jacobian = self.newton_values(state, &mut Workspace::default());
        let lu = jacobian.lu();
        let mut x: Vec<N> = self.unknowns.iter().map(|u| N::from_f64(state.values[u.symbol.index()], cx)).collect();
        let mut work = Workspace::default();
        let bits = f64::from(N::precision_bits(cx));
        let most = 4 + (bits / 20.0) as usize;
        let mut last = f64::INFINITY;
        for _ in 0..most {
            let residual = self.residuals(&mut values, &x, &mut work, cx);
            let (step, scale) = scaled_step(&lu, &residual, cx)?;
            let factor = power_of_two::<N>(scale, cx);
            for (x, step) in x.iter_mut().zip(step.iter()) {
                *x = x.minus(&N::from_f64(*step, cx).times(&factor));
            }
            let size = step.amax().log2() + f64::from(scale);
            if size == f64::NEG_INFINITY || size >= last - 4.0 {
                break;
            }
            last = size;
        }
        let residual = self.residuals(&mut values, &x, &mut work, cx);
        self.bound_errors(&mut values, &x, &lu, &residual);
        Some(values)
    }

    fn residuals<N: Real>(
        &self,
        values: &mut [Tracked<N>],
        x: &[N],
        work: &mut Workspace<Tracked<N>>,
        cx: &N::Context,
    ) -> Vec<Tracked<N>> {
        for (u, x) in self.unknowns.iter().zip(x) {
            values[u.symbol.index()] = Tracked::exact(x.clone());
        }
        let inputs: Vec<Tracked<N>> = self.values.inputs().iter().map(|s| values[s.index()].clone()).collect();
        self.values.eval(&inputs, cx, work).to_vec()
    }

    /// The unknowns with their errors: |J⁻¹| (|F| + bound on F), in powers of two so that nothing underflows.
    fn bound_errors<N: Real>(
        &self,
        values: &mut [Tracked<N>],
        x: &[N],
        lu: &LU<f64, Dyn, Dyn>,
        residual: &[Tracked<N>],
    ) {
        let sizes: Vec<f64> = residual.iter().map(|r| r.value().log2_abs().max(r.error_log2())).collect();
        let scale = sizes.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let n = self.unknowns.len();
        let inverse = lu.try_inverse().unwrap_or_else(|| DMatrix::from_element(n, n, f64::INFINITY));
        for (i, u) in self.unknowns.iter().enumerate() {
            // A factor of two for |F| plus its bound.
            let sum: f64 = (0..n).map(|j| 2.0 * inverse[(i, j)].abs() * (sizes[j] - scale).exp2()).sum();
            let log2 = if scale == f64::NEG_INFINITY { f64::NEG_INFINITY } else { sum.log2() + scale };
            values[u.symbol.index()] = Tracked::with_error(x[i].clone(), log2);
        }
    }
}

/// The premises as a square system in the unknowns.
struct Square<'s> {
    system: &'s System,
    state: &'s mut State,
    work: &'s mut Workspace<f64>,
}

impl Equations for Square<'_> {
    fn residuals(&mut self, x: &DVector<f64>) -> DVector<f64> {
        self.system.place(self.state, x);
        DVector::from_column_slice(evaluate(&self.system.values, self.state, self.work))
    }

    fn jacobian(&mut self, x: &DVector<f64>) -> DMatrix<f64> {
        self.system.place(self.state, x);
        self.system.newton_values(self.state, self.work)
    }

    fn step(&self, residuals: &DVector<f64>, jacobian: &DMatrix<f64>) -> Option<DVector<f64>> {
        jacobian.clone().lu().solve(residuals)
    }
}

/// A tape's outputs at a state in doubles.
fn evaluate<'w>(tape: &Tape, state: &State, work: &'w mut Workspace<f64>) -> &'w [f64] {
    let inputs: Vec<f64> = tape.inputs().iter().map(|s| state.values[s.index()]).collect();
    tape.eval(&inputs, &(), work)
}

/// The step J⁻¹F as doubles times 2^scale, so that residuals below the range of doubles are no obstacle.
fn scaled_step<N: Real>(
    lu: &LU<f64, Dyn, Dyn>,
    residual: &[Tracked<N>],
    cx: &N::Context,
) -> Option<(DVector<f64>, i32)> {
    let largest = residual.iter().map(|r| r.value().log2_abs()).fold(f64::NEG_INFINITY, f64::max);
    if largest == f64::NEG_INFINITY {
        return Some((DVector::zeros(residual.len()), 0));
    }
    let scale = largest.clamp(-1e9, 1e9) as i32;
    let factor = power_of_two::<N>(-scale, cx);
    let scaled = residual.iter().map(|r| r.value().times(&factor).to_f64());
    let step = lu.solve(&DVector::from_iterator(residual.len(), scaled))?;
    step.iter().all(|s| s.is_finite()).then_some((step, scale))
}

fn power_of_two<N: Real>(n: i32, cx: &N::Context) -> N {
    N::from_f64(2.0, cx).to_the(n)
}

/// Where a symbol is drawn from.
pub fn source(world: &World, symbol: SymId) -> Source {
    let facts = world.facts(symbol);
    Source {
        symbol,
        range: facts.range.unwrap_or(DEFAULT_RANGE),
        integer: facts.integer,
        declared: facts.range.is_some(),
    }
}
