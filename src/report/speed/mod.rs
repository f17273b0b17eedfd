//! `speed.html` and `speed.json`: what accuracy costs in each scene, model by model.

mod chart;
#[cfg(test)]
mod tests;
mod view;

use std::fmt::Display;
use std::path::Path;

use serde::Serialize;

use super::text::padded;
use super::words::with;
use super::write::pair;
use super::{Language, ReportError, Written, html};
use crate::scene::Scene;
use crate::scene::drift::Drift;
use crate::scene::speed::{Pick, Run, Sweep, front};

/// The version of `speed.json`. It rises when a field changes its meaning or goes.
pub const SCHEMA: u32 = 1;

const TEMPLATES: [(&str, &str); 1] = [("speed.html", include_str!("../../../templates/speed.html"))];

/// What was measured of a scene.
#[derive(Clone, Debug)]
pub struct Measured {
    /// What was computed.
    pub sweep: Sweep,
    /// Each model at each tolerance.
    pub runs: Vec<Run>,
    /// What the scene picks by itself.
    pub picks: Vec<Pick>,
}

impl Measured {
    fn scene(&self) -> &'static Scene {
        self.sweep.scene
    }

    fn until(&self) -> f64 {
        self.sweep.times.last().copied().unwrap_or(0.0)
    }

    /// Whether no other run is both faster and better.
    fn on_front(&self) -> Vec<bool> {
        let front = front(&self.runs);
        self.runs.iter().map(|run| front.iter().any(|f| std::ptr::eq(*f, run))).collect()
    }
}

/// What the page tells.
#[derive(Clone, Debug)]
pub struct Speed {
    /// The scenes.
    pub scenes: Vec<Measured>,
    /// How constants are kept over many periods.
    pub drifts: Vec<Drift>,
}

#[derive(Serialize)]
struct Data<'a> {
    schema: u32,
    kenzan: &'static str,
    scenes: Vec<SceneData<'a>>,
    drifts: Vec<DriftData<'a>>,
}

#[derive(Serialize)]
struct DriftData<'a> {
    scene: &'static str,
    method: &'a str,
    constant: &'static str,
    periods: Vec<f64>,
    relative_error: Vec<f64>,
    exponent: Option<f64>,
    seconds_per_period: f64,
}

#[derive(Serialize)]
struct SceneData<'a> {
    scene: &'static str,
    quantities: Vec<&'static str>,
    until: f64,
    values: usize,
    runs: Vec<RunData>,
    picks: Vec<PickData<'a>>,
}

#[derive(Serialize)]
struct RunData {
    model: &'static str,
    arithmetic: String,
    tolerance: Option<f64>,
    error: Option<f64>,
    seconds: f64,
    evaluations: usize,
    steps: usize,
    on_front: bool,
}

#[derive(Serialize)]
struct PickData<'a> {
    asked: f64,
    model: Option<&'static str>,
    arithmetic: Option<String>,
    error: Option<f64>,
    seconds: Option<f64>,
    seconds_with_choice: f64,
    why_not: Option<&'a str>,
}

/// The measurements as JSON.
///
/// # Errors
/// [`ReportError::Json`]
pub fn json(speed: &Speed) -> Result<String, ReportError> {
    let drift = |d: &'_ Drift| -> (Vec<f64>, Vec<f64>) { d.points.iter().copied().unzip() };
    let drifts = speed.drifts.iter().map(|d| {
        let (periods, relative_error) = drift(d);
        let Drift { scene, constant, exponent, seconds_per_period, .. } = *d;
        DriftData { scene, method: &d.method, constant, periods, relative_error, exponent, seconds_per_period }
    });
    let data = Data {
        schema: SCHEMA,
        kenzan: env!("CARGO_PKG_VERSION"),
        scenes: speed.scenes.iter().map(data).collect(),
        drifts: drifts.collect(),
    };
    Ok(serde_json::to_string_pretty(&data)? + "\n")
}

fn data(measured: &Measured) -> SceneData<'_> {
    let scene = measured.scene();
    let run = |(run, on_front): (&Run, bool)| RunData {
        model: run.model.name,
        arithmetic: run.arithmetic.name(),
        tolerance: run.tolerance,
        error: run.error.is_finite().then_some(run.error),
        seconds: run.seconds,
        evaluations: run.cost.evaluations,
        steps: run.cost.steps,
        on_front,
    };
    let pick = |pick: &'_ Pick| {
        let taken = pick.taken.as_ref().ok();
        PickData {
            asked: pick.asked,
            model: taken.map(|t| t.model.name),
            arithmetic: taken.map(|t| t.arithmetic.name()),
            error: taken.map(|t| t.error),
            seconds: taken.map(|t| t.seconds),
            seconds_with_choice: pick.seconds,
            why_not: None,
        }
    };
    let mut picks: Vec<PickData> = measured.picks.iter().map(pick).collect();
    for (data, pick) in picks.iter_mut().zip(&measured.picks) {
        data.why_not = pick.taken.as_ref().err().map(String::as_str);
    }
    SceneData {
        scene: scene.name,
        quantities: measured.sweep.quantities.iter().filter_map(|q| scene.quantities.get(*q)).map(|q| q.name).collect(),
        until: measured.until(),
        values: measured.sweep.times.len(),
        runs: measured.runs.iter().zip(measured.on_front()).map(run).collect(),
        picks,
    }
}

/// The page.
///
/// # Errors
/// [`ReportError::Template`]: a template does not fit the data, which is a defect of Kenzan.
pub fn html(speed: &Speed, language: Language) -> Result<String, ReportError> {
    html::measured(language, &TEMPLATES, language.speed_words(), &view::page(speed, language))
}

/// Writes `speed.html` and `speed.json` into the directory `out`, which is created if need be.
///
/// # Errors
/// [`ReportError`]
pub fn write(speed: &Speed, out: &Path, language: Language) -> Result<Written, ReportError> {
    pair(out, "speed", &html(speed, language)?, &json(speed)?)
}

/// How fast the constants' errors grow, in plain text.
pub fn growth(drifts: &[Drift], language: Language) -> String {
    let line = |d: &Drift| {
        let (periods, error) = d.points.last().copied().unwrap_or_default();
        let exponent = d.exponent.map_or_else(|| "?".into(), |e| format!("{e:.2}"));
        let (method, constant) = (language.say(&d.method), language.say(d.constant));
        let places: [(&str, &dyn Display); 3] =
            [("error", &format!("{error:.1e}")), ("periods", &format!("{periods:.0}")), ("exponent", &exponent)];
        let grows = with(language.speed_words().terminal_growth, &places);
        format!("{:<5} {} {} {grows}\n", d.scene, padded(&method, 38), padded(&constant, 7))
    };
    drifts.iter().map(line).collect()
}

/// What a scene takes for each error asked for, in plain text.
pub fn table(measured: &Measured, language: Language) -> String {
    let mut text = format!("{}: {}\n", measured.scene().name, language.say(measured.scene().about));
    for pick in &measured.picks {
        let taken = match &pick.taken {
            Ok(t) => {
                let places: [(&str, &dyn Display); 5] = [
                    ("model", &padded(t.model.name, 16)),
                    ("numbers", &padded(&language.say(&t.arithmetic.name()), 14)),
                    ("error", &format!("{:.1e}", t.error)),
                    ("time", &format!("{:>10.3}", t.seconds * 1e3)),
                    ("all", &format!("{:.3}", pick.seconds * 1e3)),
                ];
                with(language.speed_words().terminal_taken, &places)
            }
            Err(why) => language.say(why).into_owned(),
        };
        text += &format!("  {:>6.0e}  {taken}\n", pick.asked);
    }
    text
}
