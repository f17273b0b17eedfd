//! The equations in Euler angles by methods that go from step to step.

use super::super::flow::Flow;
use super::super::walk::{dormand_prince, least_tolerance, stages, walk};
use super::super::{About, Cost, Kind, Model, Motion, Precise, SceneError, Task};
use super::equations::{ANGLES, in_angles, singular};
use super::start::Start;
use crate::integrator::{CLASSICAL_4, GaussLegendre, Rates, RungeKutta};

/// The rates, the state at the start, and what no rate in the motion exceeds.
struct Prepared<N: Precise> {
    start: Start<N>,
    rates: Rates<N>,
    state: Vec<N>,
    rate: f64,
}

fn prepared<N: Precise>(task: &Task, cx: &N::Context, model: &'static str) -> Result<Prepared<N>, SceneError> {
    let start = Start::<N>::read(task, cx)?;
    if start.sin.log2_abs() == f64::NEG_INFINITY {
        return Err(singular(model));
    }
    let rates = Flow::rates(ANGLES, in_angles, &[("a", start.a.clone()), ("pull", start.pull.clone())], cx);
    let whole = start.axis_square().to_f64() + 4.0 * start.pull.to_f64().abs() + start.a.to_f64().powi(2);
    Ok(Prepared { rates, state: start.in_angles().to_vec(), rate: whole.sqrt(), start })
}

/// Shows the quantities at each time.
fn shown<N: Precise>(
    task: &Task,
    start: &Start<N>,
    run: impl FnOnce(&mut dyn FnMut(&N, &[N])) -> Result<Cost, SceneError>,
) -> Result<Motion<N>, SceneError> {
    let mut motion = Motion::begin(task);
    let cost = run(&mut |_, y| motion.push(task, |q| start.of_angles(task, y, q)))?;
    Ok(Motion { cost, ..motion })
}

const fn about(name: &'static str, what: &'static str) -> About {
    About { name, what, source: "equations (39)-(41)", kind: Kind::Integrated, gives: &[] }
}

/// Dormand and Prince's method.
pub struct Adaptive8;

impl Model for Adaptive8 {
    fn about(&self) -> About {
        about("dormand-prince", "the full equations in Euler angles, by Dormand and Prince's method of order 8")
    }

    fn motion<N: Precise>(&self, task: &Task, cx: &N::Context) -> Result<Motion<N>, SceneError> {
        least_tolerance(task, "dormand-prince", 1e-18)?;
        let Prepared { start, rates, state, .. } = prepared::<N>(task, cx, "dormand-prince")?;
        shown(task, &start, |show| dormand_prince(&rates, state, task, show))
    }
}

/// The classical Runge-Kutta method.
pub struct Classical;

impl Model for Classical {
    fn about(&self) -> About {
        about("runge-kutta", "the full equations in Euler angles, by the classical method of order 4, for comparison")
    }

    fn motion<N: Precise>(&self, task: &Task, cx: &N::Context) -> Result<Motion<N>, SceneError> {
        least_tolerance(task, "runge-kutta", 1e-16)?;
        let Prepared { start, rates, state, rate } = prepared::<N>(task, cx, "runge-kutta")?;
        let mut method = RungeKutta::new(&CLASSICAL_4, &rates, ANGLES.len(), cx);
        shown(task, &start, |show| walk(&mut method, rate, state, task, show))
    }
}

/// Gauss and Legendre's methods.
pub struct Gauss;

impl Model for Gauss {
    fn about(&self) -> About {
        about("gauss-legendre", "the full equations in Euler angles, by Gauss and Legendre's method: symmetric")
    }

    fn motion<N: Precise>(&self, task: &Task, cx: &N::Context) -> Result<Motion<N>, SceneError> {
        let Prepared { start, rates, state, rate } = prepared::<N>(task, cx, "gauss-legendre")?;
        let mut method = GaussLegendre::new(stages(task), &rates, ANGLES.len(), cx);
        shown(task, &start, |show| walk(&mut method, rate, state, task, show))
    }
}
