//! Where states are searched: the ranges of the variables up to their edges, and the places where parts of a formula
//! vanish.

use crate::check::Random;
use crate::check::computed::Variable;
use crate::expr::{Expr, Graph, Node, Tape, Workspace};
use crate::number::Dual;

use super::meter::places;

/// The most differences of a formula whose zeros are looked for.
const MOST_DIFFERENCES: usize = 48;

/// A range whose ends differ by more than this factor is drawn from by its logarithm.
const WIDE: f64 = 100.0;

/// The steps of Newton's method towards the zero of a difference.
const NEWTON: usize = 3;

/// The states that a formula is searched over.
pub struct Space<'v> {
    variables: &'v [Variable],
    /// The sums and differences that the formula is made of.
    differences: Tape,
    places: Vec<usize>,
    count: usize,
    work: Workspace<Dual<f64>>,
}

impl<'v> Space<'v> {
    /// The space of a formula's states.
    pub fn new(graph: &Graph, outputs: &[Expr], variables: &'v [Variable]) -> Self {
        let sums = |e: &Expr| matches!(graph.node(*e), Node::Add(..) | Node::Sub(..));
        let mut differences: Vec<Expr> = graph.reachable(outputs).into_iter().filter(sums).collect();
        differences.retain(|e| !graph.symbols(&[*e]).is_empty());
        let every = differences.len().div_ceil(MOST_DIFFERENCES).max(1);
        let differences: Vec<Expr> = differences.into_iter().step_by(every).collect();
        let tape = Tape::compile(graph, &differences);
        let (places, count) = (places(&tape, variables), differences.len());
        Space { variables, differences: tape, places, count, work: Workspace::new() }
    }

    /// A state from within the ranges.
    pub fn inside(&self, random: &mut Random) -> Vec<f64> {
        self.variables.iter().map(|v| within(v, random)).collect()
    }

    /// A state in which every second variable or so lies near an edge.
    pub fn near_edges(&self, random: &mut Random) -> Vec<f64> {
        let draw = |v: &Variable| if random.below(2) == 0 { within(v, random) } else { near_edge(v, random) };
        self.variables.iter().map(draw).collect()
    }

    /// A state near another one.
    pub fn moved(&mut self, random: &mut Random, state: &[f64]) -> Vec<f64> {
        let mut new = state.to_vec();
        let i = random.below(self.variables.len() as u64) as usize;
        let Some(v) = self.variables.get(i) else { return new };
        new[i] = match random.below(8) {
            0 => within(v, random),
            1 => near_edge(v, random),
            2 => nearer_edge(v, random, new[i]),
            3 | 4 => new[i] + sign(random) * (v.range[1] - v.range[0]) * small(random),
            5 => new[i] * (1.0 + sign(random) * small(random)),
            _ => self.near_zero(random, state, i),
        };
        new[i] = kept(v, new[i]);
        new
    }

    /// The value of a variable for which a difference nearly vanishes.
    fn near_zero(&mut self, random: &mut Random, state: &[f64], i: usize) -> f64 {
        let mut x = state[i];
        if self.count == 0 || !self.places.contains(&i) {
            return x;
        }
        let k = random.below(self.count as u64) as usize;
        for _ in 0..NEWTON {
            let dual = |p: &usize| {
                if *p == i { Dual::new(x, 1.0) } else { Dual::new(state[*p], 0.0) }
            };
            let inputs: Vec<_> = self.places.iter().map(dual).collect();
            let value = &self.differences.eval(&inputs, &(), &mut self.work)[k];
            let step = value.value / value.derivative;
            if !step.is_finite() {
                break;
            }
            x -= step;
        }
        // Exactly at a zero there is nothing to measure, more often than not.
        if random.below(4) == 0 { x } else { x * (1.0 + sign(random) * small(random)) }
    }
}

/// 2^-s for an s between 1 and 50.
fn small(random: &mut Random) -> f64 {
    (-1.0 - 49.0 * random.unit()).exp2()
}

fn sign(random: &mut Random) -> f64 {
    if random.below(2) == 0 { 1.0 } else { -1.0 }
}

/// A value within the range of a variable: what is drawn from integers is one.
fn kept(v: &Variable, x: f64) -> f64 {
    let [low, high] = v.range;
    let x = if x.is_finite() { x.clamp(low, high.max(low)) } else { low };
    if v.integer { x.round() } else { x }
}

fn within(v: &Variable, random: &mut Random) -> f64 {
    let [low, high] = v.range;
    let x = if low > 0.0 && high > WIDE * low {
        low * (high / low).powf(random.unit())
    } else {
        low + (high - low) * random.unit()
    };
    kept(v, x)
}

fn near_edge(v: &Variable, random: &mut Random) -> f64 {
    let [low, high] = v.range;
    let distance = (high - low) * small(random);
    kept(v, if random.below(2) == 0 { low + distance } else { high - distance })
}

/// At another distance from the edge that is nearest.
fn nearer_edge(v: &Variable, random: &mut Random, x: f64) -> f64 {
    let [low, high] = v.range;
    let factor = (8.0 * random.unit() - 5.0).exp2();
    if x - low < high - x { low + (x - low) * factor } else { high - (high - x) * factor }
}
