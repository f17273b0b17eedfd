//! How long a formula takes: its tape over many states, in lanes.

use std::time::Instant;

use crate::expr::{Tape, Workspace};
use crate::number::{LANES, Lanes};

/// The states that are computed in one go, and how often; the fastest counts.
const STATES: usize = 2048;
const REPEATS: usize = 9;

/// The nanoseconds for a state, at states that are repeated as often as need be. None where there is no state.
pub fn nanoseconds(tape: &Tape, states: &[Vec<f64>]) -> Option<f64> {
    let first = states.first()?;
    let block = |from: usize| -> Vec<Lanes> {
        let lane = |input: usize| {
            Lanes(std::array::from_fn(|k| states[(from + k) % states.len()].get(input).copied().unwrap_or(f64::NAN)))
        };
        (0..first.len()).map(lane).collect()
    };
    let blocks: Vec<Vec<Lanes>> = (0..STATES).step_by(LANES).map(block).collect();
    let mut work = Workspace::new();
    let mut best = f64::INFINITY;
    for _ in 0..REPEATS {
        let begin = Instant::now();
        for inputs in &blocks {
            std::hint::black_box(tape.eval(std::hint::black_box(inputs), &(), &mut work));
        }
        best = best.min(begin.elapsed().as_secs_f64());
    }
    Some(best * 1e9 / (blocks.len() * LANES) as f64)
}
