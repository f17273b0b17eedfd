//! The chart of a scene: time against error.

use super::super::charts::{Chart, ChartError, LegendEntry, Table};
use super::super::svg::{Axis, Series, plot};
use super::super::text::number;
use super::super::words::with;
use super::{Language, Measured};
use crate::scene::drift::Drift;
use crate::scene::speed::{Run, front};

/// The colours for models; with dashes there are twice as many lines.
const COLOURS: usize = 6;
/// The colour of the front.
const FRONT: u8 = 7;

/// The chart of a scene: a line for each model, and the front behind them.
pub(super) fn chart(measured: &Measured, language: Language) -> Result<Chart, ChartError> {
    let t = language.speed_words();
    let finite: Vec<&Run> = measured.runs.iter().filter(|r| r.error.is_finite()).collect();
    let names = models(&measured.runs);
    let front: Vec<(f64, f64)> = front(&measured.runs).into_iter().map(point).collect();
    let mut series = vec![Series { colour: FRONT, dashed: false, markers: false, points: front }];
    let mut legend = vec![LegendEntry { class: format!("line-{FRONT}"), marker: None, label: t.front.into() }];
    for (i, name) in names.iter().enumerate() {
        let (colour, dashed) = ((i % COLOURS + 1) as u8, i / COLOURS % 2 == 1);
        let mut points: Vec<(f64, f64)> = finite.iter().filter(|r| r.model.name == *name).map(|r| point(r)).collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        series.push(Series { colour, dashed, markers: true, points });
        let (line, marker) = if dashed { ("dash", "ring") } else { ("line", "fill") };
        legend.push(LegendEntry {
            class: format!("{line}-{colour}"),
            marker: Some(format!("{marker}-{colour}")),
            label: (*name).to_owned(),
        });
    }
    let errors = decades(finite.iter().map(|r| point(r).0));
    let times = decades(finite.iter().map(|r| point(r).1));
    let x = Axis { label: t.largest_error, range: errors, logarithmic: true };
    let y = Axis { label: t.time, range: times, logarithmic: true };
    let scene = measured.scene();
    let title = with(t.chart_title, &[("scene", &scene.name)]);
    let svg = plot(&title, &x, &y, &series)?;
    let values = measured.sweep.times.len() * measured.sweep.quantities.len();
    let until = number(measured.until(), 4);
    let caption = with(t.chart_caption, &[("n", &values), ("until", &until), ("unit", &scene.time)]);
    Ok(Chart { id: format!("speed-{}", scene.name), title, caption, svg, legend, table: table(measured, language) })
}

/// The models that ran, in the order of the scene.
fn models(runs: &[Run]) -> Vec<&'static str> {
    let mut names: Vec<&str> = Vec::new();
    for run in runs {
        if !names.contains(&run.model.name) {
            names.push(run.model.name);
        }
    }
    names
}

/// The least error that is drawn.
const LEAST: f64 = 1e-80;

fn point(run: &Run) -> (f64, f64) {
    (run.error.max(LEAST), run.seconds * 1e3)
}

/// Whole decades around the values.
fn decades(values: impl Iterator<Item = f64> + Clone) -> std::ops::Range<f64> {
    let least = values.clone().fold(f64::INFINITY, f64::min);
    let most = values.fold(0.0, f64::max);
    if !(least > 0.0 && least <= most) {
        return 0.1..10.0;
    }
    10f64.powf((least * 0.8).log10().floor())..10f64.powf((most * 1.2).log10().ceil())
}

fn table(measured: &Measured, language: Language) -> Table {
    let t = language.speed_words();
    let head = [t.model, t.numbers, t.tolerance, t.error, t.time, t.evaluations, t.steps, t.on_front];
    let row = |(run, on_front): (&Run, bool)| {
        vec![
            run.model.name.to_owned(),
            language.say(&run.arithmetic.name()).into_owned(),
            run.tolerance.map_or_else(|| "–".into(), |t| format!("{t:.0e}")),
            format!("{:.1e}", run.error),
            number(run.seconds * 1e3, 3),
            run.cost.evaluations.to_string(),
            run.cost.steps.to_string(),
            if on_front { "●".into() } else { String::new() },
        ]
    };
    let rows = measured.runs.iter().zip(measured.on_front()).map(row).collect();
    Table { head: head.map(String::from).to_vec(), rows }
}

/// How the constants of each motion are kept: a chart for each scene and constant, a line for each method.
pub(super) fn drifts(drifts: &[Drift], language: Language) -> Vec<Result<Chart, ChartError>> {
    let mut subjects: Vec<(&str, &str)> = drifts.iter().map(|d| (d.scene, d.constant)).collect();
    subjects.dedup();
    let mut unique: Vec<(&str, &str)> = Vec::new();
    for subject in subjects {
        if !unique.contains(&subject) {
            unique.push(subject);
        }
    }
    unique
        .into_iter()
        .map(|(scene, constant)| {
            let of: Vec<&Drift> = drifts.iter().filter(|d| (d.scene, d.constant) == (scene, constant)).collect();
            drift(scene, constant, &of, language)
        })
        .collect()
}

fn drift(scene: &str, constant: &str, methods: &[&Drift], language: Language) -> Result<Chart, ChartError> {
    let t = language.speed_words();
    let all = || methods.iter().flat_map(|d| d.points.iter().copied());
    let x = Axis {
        label: t.periods,
        range: decades(all().map(|p| p.0).collect::<Vec<_>>().into_iter()),
        logarithmic: true,
    };
    let errors: Vec<f64> = all().map(|p| p.1).filter(|e| *e > 0.0).collect();
    let y = Axis { label: t.relative_error, range: decades(errors.into_iter()), logarithmic: true };
    let (mut series, mut legend, mut rows) = (Vec::new(), Vec::new(), Vec::new());
    for (i, drift) in methods.iter().enumerate() {
        let (colour, exponent) = ((i % COLOURS + 1) as u8, drift.exponent.map(|e| format!("{e:.2}")));
        series.push(Series { colour, dashed: false, markers: false, points: drift.points.clone() });
        let power = |e: &String| with(t.grows, &[("power", &format!("$t^{{{e}}}$"))]);
        let grows = exponent.as_ref().map_or_else(String::new, power);
        let method = language.say(&drift.method);
        let label = format!("{method}{grows}");
        legend.push(LegendEntry { class: format!("line-{colour}"), marker: None, label });
        let (periods, error) = drift.points.last().copied().unwrap_or_default();
        rows.push(vec![
            method.into_owned(),
            number(periods.round(), 3),
            format!("{error:.1e}"),
            exponent.unwrap_or_default(),
            number(drift.seconds_per_period * 1e6, 3),
        ]);
    }
    let body = if scene == "free" { t.free_body } else { t.top };
    let title = with(t.kept_title, &[("body", &body), ("constant", &language.say(constant))]);
    let caption = t.kept_caption.to_owned();
    let svg = plot(&title, &x, &y, &series)?;
    let head = [t.method, t.periods, t.error, t.exponent, t.time_of_period].map(String::from).to_vec();
    let id = format!("drift-{scene}-{}", constant.trim_matches('|'));
    Ok(Chart { id, title, caption, svg, legend, table: Table { head, rows } })
}
