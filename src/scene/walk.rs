//! Motions followed by methods that go from step to step, shown at the times asked for.

use super::{Cost, SceneError, Task};
use crate::integrator::{Adaptive, Method, State, System, integrate_fixed};
use crate::number::Number;

/// The most steps that a method may take.
const MOST_STEPS: f64 = 2e7;

/// Methods of low order reach small tolerances by no number of steps that anybody waits for.
///
/// # Errors
/// [`SceneError::Regime`] below the least tolerance.
pub(super) fn least_tolerance(task: &Task, model: &str, least: f64) -> Result<(), SceneError> {
    if task.tolerance >= least {
        return Ok(());
    }
    Err(SceneError::regime(
        format!("the order of the model `{model}` is too low for a tolerance of {:.0e}", task.tolerance),
        "take a closed form, or Taylor series, whose order rises with the digits asked for",
    ))
}

/// Dormand and Prince's method, from each of the times asked for to the next; shows the time and the state at each.
pub(super) fn dormand_prince<N: Number>(
    system: &impl System<N>,
    mut state: Vec<N>,
    task: &Task,
    mut show: impl FnMut(&N, &[N]),
) -> Result<Cost, SceneError> {
    let Some(like) = state.first().cloned() else { return Ok(Cost::default()) };
    let tolerance = task.tolerance.max(f64::exp2(3.0 - f64::from(N::precision_bits(&like.context()))));
    let driver = Adaptive { max_steps: MOST_STEPS as usize, ..Adaptive::with_tolerance(tolerance) };
    let (mut now, mut cost) = (like.like(0.0), Cost { order: 8, ..Cost::default() });
    for &t in task.times {
        let t = like.like(t);
        let outcome = driver.integrate(system, (&now, &state), &t, |_| {})?;
        cost.steps += outcome.accepted + outcome.refused;
        (state, now) = (outcome.y, t);
        show(&now, &state);
    }
    cost.evaluations = 12 * cost.steps;
    Ok(cost)
}

/// Goes from each of the times asked for to the next in equal steps, and shows the time and the state at each. Steps are as long as
/// the method's order allows for the tolerance, where nothing in the motion is faster than `rate`, in 1/s.
pub(super) fn walk<N: Number>(
    method: &mut impl Method<N>,
    rate: f64,
    mut state: Vec<N>,
    task: &Task,
    mut show: impl FnMut(&N, &[N]),
) -> Result<Cost, SceneError> {
    let Some(like) = state.first().cloned() else { return Ok(Cost::default()) };
    let order = method.order();
    let longest = task.tolerance.powf(1.0 / f64::from(order)) / rate;
    let (mut now, mut steps) = (0.0, 0);
    for &t in task.times {
        let count = ((t - now) / longest).ceil();
        if count.is_nan() || count + steps as f64 > MOST_STEPS {
            return Err(SceneError::regime(
                format!("the motion would take more than {MOST_STEPS:.0e} steps of {}", method.name()),
                "take a closed form, a larger tolerance or a shorter time",
            ));
        }
        if t > now {
            let (from, count) = (like.like(now), count.max(1.0));
            let h = like.like(t).minus(&from).over(&like.like(count));
            state = integrate_fixed(method, (&from, &state), &h, count as usize, |_, _: &State<N>| {})?;
            steps += count as usize;
        }
        show(&like.like(t), &state);
        now = t;
    }
    Ok(Cost { evaluations: steps, steps, order: order as usize })
}

/// The stages of a Gauss-Legendre method for the task's tolerance: one for some two and a half digits.
pub(super) fn stages(task: &Task) -> usize {
    (-task.tolerance.log10() / 2.5).ceil().clamp(2.0, 60.0) as usize
}
