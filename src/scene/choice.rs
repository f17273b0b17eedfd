//! The choice of the cheapest model that meets an error.
//!
//! No model is taken at its word. Each is run at probe times, which are some of the times asked for, and compared with a
//! yardstick: the scene's closed form in a stronger number type, or, where none applies, its fullest equations
//! integrated in a stronger type to a much smaller tolerance. The yardstick's own doubt is counted with the
//! difference. Where there is nothing stronger than double-double, the doubt of a closed form is how far it moves when
//! the parameters move by some units of its roundoff.

use super::model::{About, AnyModel, Cost, Kind, Task};
use super::precise::{Arithmetic, Values};
use super::yardstick::Yardstick;
use super::{Scene, SceneError};

/// The most times at which models are compared.
const PROBES: usize = 64;
/// By how much the measured error of an approximation must stay below what is asked, since between the probes it may be
/// larger.
const MARGIN: f64 = 2.0;
/// The same for rounding errors, which scatter more.
const ROUNDING_MARGIN: f64 = 4.0;
/// How often an integrator is given a smaller tolerance.
const TIGHTER: usize = 3;

/// What is asked of a scene.
#[derive(Clone, Debug)]
pub struct Request {
    /// The scene.
    pub scene: &'static Scene,
    /// The values of its parameters, in its order.
    pub parameters: Vec<f64>,
    /// The quantities, by position in [`Scene::quantities`].
    pub quantities: Vec<usize>,
    /// The times in the scene's unit, not negative and rising.
    pub times: Vec<f64>,
    /// The largest absolute error of a value, in the unit of its quantity.
    pub error: f64,
    /// The model, where it is not to be chosen.
    pub model: Option<String>,
    /// The precision in bits beyond double-double, where it is not to be chosen (feature `rug`; ignored without).
    pub bits: Option<u32>,
}

/// A cheaper model that was not taken.
#[derive(Clone, Debug, PartialEq)]
pub struct Refusal {
    /// The model.
    pub model: &'static str,
    /// The number type.
    pub arithmetic: Arithmetic,
    /// The measured error, where it came to one.
    pub measured: Option<f64>,
    /// Why, in words.
    pub why: String,
}

/// The model taken, and its values.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The model.
    pub model: About,
    /// The number type it ran in.
    pub arithmetic: Arithmetic,
    /// The tolerance that it was given, if it is an integrator; 0 otherwise.
    pub tolerance: f64,
    /// Its largest error at the probe times, the doubt of the yardstick included.
    pub measured: f64,
    /// Whether that meets the error asked for; only a model that was asked for by name may miss it.
    pub met: bool,
    /// The number of probe times.
    pub probes: usize,
    /// What the error was measured against.
    pub yardstick: String,
    /// The cheaper models, and why they were not taken.
    pub refused: Vec<Refusal>,
    /// The values: a row for each quantity, a column for each time.
    pub values: Values,
    /// What they cost.
    pub cost: Cost,
}

/// A run that is measured.
struct Attempt {
    tolerance: f64,
    values: Values,
    cost: Cost,
    measured: f64,
}

struct Chooser<'a> {
    request: &'a Request,
    /// The positions of the probe times among all.
    probes: Vec<usize>,
    probe_times: Vec<f64>,
}

/// The cheapest model that meets the error, with its values.
///
/// # Errors
/// [`SceneError::OutOfReach`] where none does, with what can be reached; [`SceneError`] where names or times are wrong.
pub fn choose(request: &Request) -> Result<Outcome, SceneError> {
    check(request)?;
    let chooser = Chooser::new(request);
    let forced = request.model.as_deref().map(|name| request.scene.model(name)).transpose()?;
    let candidates = forced.map_or_else(|| request.scene.models.to_vec(), |m| vec![m]);
    let mut refused: Vec<Refusal> = Vec::new();
    let mut nearest: Option<Outcome> = None;
    for (step, arithmetic) in chooser.ladder().into_iter().enumerate() {
        let yardstick = match Yardstick::of(&chooser.probed(), arithmetic) {
            Ok(yardstick) => yardstick,
            Err(why) if step == 0 => return Err(why),
            Err(_) => break,
        };
        if let Some(refusal) = too_coarse(arithmetic, &yardstick, request.error) {
            refused.push(refusal);
            continue;
        }
        for &model in &candidates {
            let about = model.about();
            if step > 0 && about.kind == Kind::Approximation && forced.is_none() {
                continue; // No number makes it better.
            }
            let attempt = match chooser.attempt(model, arithmetic, &yardstick) {
                Ok(attempt) => attempt,
                Err(why) if forced.is_some() => return Err(why),
                Err(why) => {
                    let why = why.to_string();
                    refused.push(Refusal { model: about.name, arithmetic, measured: None, why });
                    continue;
                }
            };
            let met = attempt.measured * margin(about.kind) <= request.error;
            if !met {
                refused.push(Refusal {
                    model: about.name,
                    arithmetic,
                    measured: Some(attempt.measured),
                    why: format!("an error of {:.1e}", attempt.measured),
                });
            }
            let better = nearest.as_ref().is_none_or(|n| attempt.measured < n.measured);
            if met || better {
                let attempt = chooser.complete(model, arithmetic, attempt)?;
                let outcome = chooser.outcome(about, arithmetic, &yardstick, attempt, met);
                if met {
                    return Ok(Outcome { refused, ..outcome });
                }
                nearest = Some(outcome);
            }
        }
    }
    match nearest {
        Some(outcome) if forced.is_some() => {
            // What is taken all the same is not refused.
            refused.retain(|r| r.arithmetic != outcome.arithmetic);
            Ok(Outcome { refused, ..outcome })
        }
        nearest => Err(out_of_reach(request, nearest, refused.last())),
    }
}

fn check(request: &Request) -> Result<(), SceneError> {
    let Request { scene, parameters, error, .. } = request;
    if !(*error > 0.0 && error.is_finite()) {
        return Err(SceneError::parameter(
            format!("an error of {error} cannot be met"),
            "ask for a positive error, 1e-9 for nine decimals",
        ));
    }
    let mut named = scene.parameters.iter().zip(parameters);
    match named.find(|(_, value)| !value.is_finite()) {
        Some((parameter, value)) => {
            let what = format!("the parameter {} is {value}", parameter.name);
            Err(SceneError::parameter(what, "give it a finite value"))
        }
        None => Ok(()),
    }
}

/// Values that a number type cannot even hold to the error asked for are not computed in it.
fn too_coarse(arithmetic: Arithmetic, yardstick: &Yardstick, error: f64) -> Option<Refusal> {
    let largest = yardstick.values.to_f64().iter().flatten().fold(0.0_f64, |most, x| most.max(x.abs()));
    let roundoff = largest * f64::exp2(-f64::from(arithmetic.bits()) - 1.0);
    let why = format!("the largest value, {largest:.1e}, is held to {roundoff:.0e} only");
    (roundoff > error).then_some(Refusal { model: "any model", arithmetic, measured: None, why })
}

fn margin(kind: Kind) -> f64 {
    if kind == Kind::Approximation { MARGIN } else { ROUNDING_MARGIN }
}

fn out_of_reach(request: &Request, nearest: Option<Outcome>, last: Option<&Refusal>) -> SceneError {
    let best = match (nearest, last) {
        (Some(n), _) => {
            format!(": the best, `{}` in {}, has one of {:.1e}", n.model.name, n.arithmetic.name(), n.measured)
        }
        (None, Some(refusal)) => format!(": in {}, {}", refusal.arithmetic.name(), refusal.why),
        _ => String::new(),
    };
    let help = if cfg!(feature = "rug") {
        "ask for a larger error, a shorter time or more bits (--precision)"
    } else {
        "ask for a larger error or a shorter time, or build with `--features rug` for more than double-double"
    };
    SceneError::OutOfReach { asked: request.error, best, help: help.into() }
}

impl<'a> Chooser<'a> {
    fn new(request: &'a Request) -> Self {
        let count = request.times.len();
        // Evenly, but never at a fixed interval: a motion may be periodic.
        let spread = |i: usize| {
            let place = (i as f64 * 0.618_033_988_749_894_9).fract();
            ((i as f64 + place) / PROBES as f64 * count as f64) as usize
        };
        let mut probes: Vec<usize> = if count <= PROBES {
            (0..count).collect()
        } else {
            (0..PROBES).map(spread).chain([count - 1]).filter(|i| *i < count).collect()
        };
        probes.dedup();
        let probe_times = probes.iter().filter_map(|i| request.times.get(*i).copied()).collect();
        Chooser { request, probes, probe_times }
    }

    fn task<'t>(&'t self, parameters: &'t [f64], times: &'t [f64], tolerance: f64) -> Task<'t> {
        Task { scene: self.request.scene, parameters, quantities: &self.request.quantities, times, tolerance }
    }

    /// What is compared.
    fn probed(&self) -> Task<'_> {
        self.task(&self.request.parameters, &self.probe_times, self.request.error)
    }

    /// The number types to try, from cheap to strong.
    fn ladder(&self) -> Vec<Arithmetic> {
        #[cfg(feature = "rug")]
        {
            let span = self.request.times.last().copied().unwrap_or(1.0).max(1.0);
            let needed = (64.0 + span.log2() - self.request.error.log2()).clamp(128.0, 100_000.0) as u32;
            let bits = self.request.bits.map_or(vec![needed, 2 * needed], |bits| vec![bits]);
            let cheap = [Arithmetic::Machine, Arithmetic::Double];
            cheap.into_iter().chain(bits.into_iter().map(Arithmetic::Bits)).collect()
        }
        #[cfg(not(feature = "rug"))]
        vec![Arithmetic::Machine, Arithmetic::Double]
    }

    /// Runs a model, an integrator with ever smaller tolerances, and measures it at the probe times.
    fn attempt(
        &self,
        model: &dyn AnyModel,
        arithmetic: Arithmetic,
        yardstick: &Yardstick,
    ) -> Result<Attempt, SceneError> {
        let parameters = &self.request.parameters;
        let integrated = model.about().kind == Kind::Integrated;
        // An integrator goes all the way at once; the others are tried where they are measured.
        let times = if integrated { &self.request.times } else { &self.probe_times };
        let least = f64::exp2(1.0 - f64::from(arithmetic.bits()));
        let mut tolerance = (self.request.error * 1e-2).max(least);
        let mut best: Option<Attempt> = None;
        for _ in 0..if integrated { TIGHTER } else { 1 } {
            let (values, cost) = model.run(&self.task(parameters, times, tolerance), arithmetic)?;
            let probed = if integrated { values.at(&self.probes) } else { values.clone() };
            let measured = probed.distance(&yardstick.values) + yardstick.doubt;
            if best.as_ref().is_none_or(|b| measured < b.measured) {
                best = Some(Attempt { tolerance, values, cost, measured });
            }
            if measured * ROUNDING_MARGIN <= self.request.error || tolerance <= least {
                break;
            }
            tolerance = (tolerance * 1e-3).max(least);
        }
        best.ok_or(SceneError::Times)
    }

    /// The values at all the times, where so far there are only those at the probe times.
    fn complete(&self, model: &dyn AnyModel, arithmetic: Arithmetic, attempt: Attempt) -> Result<Attempt, SceneError> {
        if model.about().kind == Kind::Integrated || self.probes.len() == self.request.times.len() {
            return Ok(attempt);
        }
        let task = self.task(&self.request.parameters, &self.request.times, 0.0);
        let (values, cost) = model.run(&task, arithmetic)?;
        Ok(Attempt { values, cost, ..attempt })
    }

    fn outcome(
        &self,
        model: About,
        arithmetic: Arithmetic,
        yardstick: &Yardstick,
        attempt: Attempt,
        met: bool,
    ) -> Outcome {
        let Attempt { tolerance, values, cost, measured } = attempt;
        let (probes, yardstick) = (self.probes.len(), yardstick.what.clone());
        Outcome { model, arithmetic, tolerance, measured, met, probes, yardstick, refused: Vec::new(), values, cost }
    }
}
