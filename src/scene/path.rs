//! A motion followed by Taylor series, shown at the times asked for.

use super::{Cost, SceneError};
use crate::integrator::taylor::{Series, Taylor};
use crate::number::Number;

/// How often a step is looked at, for angles that are to be followed beyond a turn.
const LOOKS: usize = 4;

/// A state on the way.
pub(super) struct Stop<'a, N> {
    /// The time.
    pub t: &'a N,
    /// The state.
    pub y: &'a [N],
    /// Whether it is one of the times asked for; the others come between, for what must be followed on the way.
    pub asked: bool,
}

/// Follows the motion from `start` at t = 0, shows it at each of the times, and, where `looks` is set, some times within
/// each step.
pub(super) fn follow<N: Number>(
    series: &Series,
    parameters: &[N],
    start: &[N],
    times: &[f64],
    (tolerance, looks): (f64, bool),
    mut show: impl FnMut(Stop<'_, N>),
) -> Result<Cost, SceneError> {
    let Some(like) = start.first() else { return Ok(Cost::default()) };
    let times: Vec<N> = times.iter().map(|t| like.like(*t)).collect();
    let (zero, mut next, mut y) = (like.like(0.0), 0, start.to_vec());
    while next < times.len() && times[next].log2_abs() == f64::NEG_INFINITY {
        show(Stop { t: &zero, y: start, asked: true });
        next += 1;
    }
    let Some(end) = times.last().filter(|_| next < times.len()) else { return Ok(Cost::default()) };
    // The tolerance of a step: a machine number does better than its own roundoff only by chance.
    let bits = f64::from(N::precision_bits(&like.context()));
    let taylor = Taylor { log2_tolerance: tolerance.log2().max(1.0 - bits), max_steps: 10_000_000 };
    let arrival = taylor.integrate(series, parameters, (&zero, start), end, |step| {
        let mut at = |t: &N, s: &N, asked: bool| {
            for (k, y) in y.iter_mut().enumerate() {
                *y = step.at(k, s);
            }
            show(Stop { t, y: &y, asked });
        };
        let mut look = 1;
        loop {
            let look_at = step.h.times(&like.like(look as f64 / LOOKS as f64));
            let due = times.get(next).map(|t| t.minus(step.t0)).filter(|s| s.minus(step.h).to_f64() <= 0.0);
            match due {
                Some(s) if !looks || look > LOOKS || s.minus(&look_at).to_f64() <= 0.0 => {
                    at(&times[next], &s, true);
                    next += 1;
                }
                _ if looks && look <= LOOKS => {
                    at(&step.t0.plus(&look_at), &look_at, false);
                    look += 1;
                }
                _ => break,
            }
        }
    })?;
    // The compensation of the time may leave the last one a rounding beyond the last step.
    for t in &times[next.min(times.len())..] {
        show(Stop { t, y: &arrival.y, asked: true });
    }
    Ok(Cost { evaluations: arrival.steps, steps: arrival.steps, order: arrival.order })
}
