//! What accuracy costs: the models of a scene at every tolerance, the time of each run against its error.

use super::choice::{Request, choose};
use super::model::{About, Cost, Kind, Task};
use super::precise::Arithmetic;
use super::yardstick::Yardstick;
use super::{Scene, SceneError};
use std::time::{Duration, Instant};

/// A run is timed again until so much time has been spent on it, and the fastest one counts: what disturbs a run only
/// ever makes it slower.
const TIMED_FOR: Duration = Duration::from_millis(20);
/// The most runs that are timed.
const MOST_RUNS: usize = 50;

/// A model that took longer is not run at smaller tolerances.
const PATIENCE: f64 = 0.5;
/// Below this tolerance only scenes with a closed form are measured: others have nothing to measure against in reasonable
/// time.
const LEAST_WITHOUT_CLOSED: f64 = 1e-31;

/// What is computed, and how exactly.
#[derive(Clone, Debug)]
pub struct Sweep {
    /// The scene.
    pub scene: &'static Scene,
    /// The values of its parameters, in its order.
    pub parameters: Vec<f64>,
    /// The quantities, by position in [`Scene::quantities`].
    pub quantities: Vec<usize>,
    /// The times in the scene's unit, not negative and rising.
    pub times: Vec<f64>,
    /// The tolerances that integrators are given.
    pub tolerances: Vec<f64>,
}

/// A run of a model.
#[derive(Clone, Debug)]
pub struct Run {
    /// The model.
    pub model: About,
    /// The number type.
    pub arithmetic: Arithmetic,
    /// The tolerance, for an integrator.
    pub tolerance: Option<f64>,
    /// The largest absolute error of a value, the doubt of what it was measured against included.
    pub error: f64,
    /// The time of a run in s.
    pub seconds: f64,
    /// What it cost beside time.
    pub cost: Cost,
}

/// The number type that meets a tolerance with some bits to spare.
fn arithmetic(tolerance: f64) -> Option<Arithmetic> {
    let needed = 8.0 - tolerance.log2();
    match needed {
        _ if needed <= 60.0 => Some(Arithmetic::Machine),
        _ if needed <= 108.0 => Some(Arithmetic::Double),
        #[cfg(feature = "rug")]
        _ => Some(Arithmetic::Bits((needed / 64.0).ceil() as u32 * 64)),
        #[cfg(not(feature = "rug"))]
        _ => None,
    }
}

/// What a scene takes by itself for an error.
#[derive(Clone, Debug)]
pub struct Pick {
    /// The error that was asked for.
    pub asked: f64,
    /// What was taken; why nothing, where nothing meets the error.
    pub taken: Result<Taken, String>,
    /// The time of choosing and computing in s.
    pub seconds: f64,
}

/// A model that was taken.
#[derive(Clone, Debug)]
pub struct Taken {
    /// The model.
    pub model: About,
    /// The number type.
    pub arithmetic: Arithmetic,
    /// Its measured error.
    pub error: f64,
    /// The time of a run in s, without the choice.
    pub seconds: f64,
}

impl Sweep {
    /// What the scene takes for these errors.
    pub fn picks(&self, errors: &[f64]) -> Vec<Pick> {
        errors.iter().map(|&asked| self.pick(asked)).collect()
    }

    fn pick(&self, asked: f64) -> Pick {
        let Sweep { scene, parameters, quantities, times, .. } = self.clone();
        let request = Request { scene, parameters, quantities, times, error: asked, model: None, bits: None };
        let begin = Instant::now();
        let outcome = choose(&request);
        let seconds = begin.elapsed().as_secs_f64();
        let taken = outcome.and_then(|o| {
            let model = self.scene.model(o.model.name)?;
            let (_, seconds) = timed(|| model.run(&self.task(o.tolerance), o.arithmetic))?;
            Ok(Taken { model: o.model, arithmetic: o.arithmetic, error: o.measured, seconds })
        });
        Pick { asked, taken: taken.map_err(|e| e.to_string()), seconds }
    }

    /// Runs every model that gives the quantities: an integrator once for each tolerance, the others once for each
    /// number type. Models that do not apply to the motion are left out.
    ///
    /// # Errors
    /// [`SceneError`] where there is nothing to measure errors against.
    pub fn run(&self) -> Result<Vec<Run>, SceneError> {
        let mut runs = Vec::new();
        let mut done: Vec<(&str, Arithmetic)> = Vec::new();
        let mut yardsticks: Vec<(Arithmetic, Yardstick)> = Vec::new();
        let closed = self.scene.models.iter().any(|m| m.about().kind == Kind::Exact);
        for &tolerance in self.tolerances.iter().filter(|t| closed || **t >= LEAST_WITHOUT_CLOSED) {
            let Some(arithmetic) = arithmetic(tolerance) else { continue };
            let known = yardsticks.iter().position(|(of, _)| *of == arithmetic);
            let at = match known {
                Some(at) => at,
                None => {
                    let least = self.tolerances.iter().copied().fold(1.0, f64::min).max(roundoff(arithmetic));
                    yardsticks.push((arithmetic, Yardstick::of(&self.task(least), arithmetic)?));
                    yardsticks.len() - 1
                }
            };
            for model in self.scene.models.iter().filter(|m| m.gives(&self.quantities)) {
                let about = model.about();
                let once = about.kind != Kind::Integrated;
                let rough = about.kind == Kind::Approximation && arithmetic != Arithmetic::Machine;
                let slow = runs.iter().any(|r: &Run| r.model.name == about.name && r.seconds > PATIENCE);
                if rough || slow || once && done.contains(&(about.name, arithmetic)) {
                    continue;
                }
                done.push((about.name, arithmetic));
                let timed = timed(|| model.run(&self.task(tolerance), arithmetic));
                let Ok(((values, cost), seconds)) = timed else { continue };
                let (_, yardstick) = &yardsticks[at];
                let error = values.distance(&yardstick.values) + yardstick.doubt;
                let tolerance = (!once).then_some(tolerance);
                runs.push(Run { model: about, arithmetic, tolerance, error, seconds, cost });
            }
        }
        Ok(runs)
    }

    fn task(&self, tolerance: f64) -> Task<'_> {
        let Sweep { scene, parameters, quantities, times, .. } = self;
        Task { scene, parameters, quantities, times, tolerance }
    }
}

fn roundoff(arithmetic: Arithmetic) -> f64 {
    f64::exp2(-f64::from(arithmetic.bits()))
}

/// The result, and the shortest time in which it was computed.
fn timed<T>(mut work: impl FnMut() -> Result<T, SceneError>) -> Result<(T, f64), SceneError> {
    let begin = Instant::now();
    let (mut shortest, mut runs) = (f64::INFINITY, 0);
    loop {
        let start = Instant::now();
        let result = work()?;
        shortest = shortest.min(start.elapsed().as_secs_f64());
        runs += 1;
        if runs >= MOST_RUNS || begin.elapsed() >= TIMED_FOR {
            return Ok((result, shortest));
        }
    }
}

/// The runs that no other one beats in both error and time, from rough to exact.
pub fn front(runs: &[Run]) -> Vec<&Run> {
    let mut order: Vec<&Run> = runs.iter().filter(|r| r.error.is_finite()).collect();
    order.sort_by(|a, b| a.seconds.total_cmp(&b.seconds).then(a.error.total_cmp(&b.error)));
    let mut least = f64::INFINITY;
    order.retain(|run| {
        let better = run.error < least;
        least = least.min(run.error);
        better
    });
    order
}

#[cfg(test)]
mod tests {
    use super::super::SCENES;
    use super::*;

    #[test]
    fn every_scene_has_a_model_that_meets_nine_digits() {
        for scene in SCENES {
            let sweep = Sweep {
                scene,
                parameters: scene.defaults(),
                quantities: vec![0],
                times: vec![0.5, 1.0, 2.0],
                tolerances: vec![1e-3, 1e-12],
            };
            let runs = sweep.run().unwrap();
            let best = runs.iter().map(|r| r.error).fold(f64::INFINITY, f64::min);
            assert!(best < 1e-9, "{}: {best:e}", scene.name);
            let front = front(&runs);
            assert!(front.windows(2).all(|w| w[0].error > w[1].error && w[0].seconds <= w[1].seconds));
            assert!(runs.iter().any(|r| r.tolerance.is_some()), "{}: nothing was integrated", scene.name);
        }
    }
}
