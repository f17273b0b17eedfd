//! The chart of a scene: time against error.

use super::super::charts::{Chart, ChartError, LegendEntry, Table};
use super::super::svg::{Axis, Series, plot};
use super::super::text::number;
use super::Measured;
use crate::scene::speed::{Run, front};

/// The colours for models; with dashes there are twice as many lines.
const COLOURS: usize = 4;
/// The colour of the front.
const FRONT: u8 = 5;

/// The chart of a scene: a line for each model, and the front behind them.
pub(super) fn chart(measured: &Measured) -> Result<Chart, ChartError> {
    let finite: Vec<&Run> = measured.runs.iter().filter(|r| r.error.is_finite()).collect();
    let names = models(&measured.runs);
    let front: Vec<(f64, f64)> = front(&measured.runs).into_iter().map(point).collect();
    let mut series = vec![Series { colour: FRONT, dashed: false, markers: false, points: front }];
    let mut legend = vec![LegendEntry {
        class: format!("line-{FRONT}"),
        marker: None,
        label: "the front: nothing is both faster and better".into(),
    }];
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
    let x = Axis { label: "largest error", range: errors, logarithmic: true };
    let y = Axis { label: "time in ms", range: times, logarithmic: true };
    let scene = measured.scene();
    let title = format!("{}: time against error", scene.name);
    let svg = plot(&title, &x, &y, &series)?;
    let caption = format!(
        "{} values up to t = {} s; a point is a run of a model in a number type, with a tolerance if it is an integrator.",
        measured.sweep.times.len() * measured.sweep.quantities.len(),
        number(measured.until(), 4),
    );
    Ok(Chart { id: format!("speed-{}", scene.name), title, caption, svg, legend, table: table(measured) })
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

fn table(measured: &Measured) -> Table {
    let head = ["model", "numbers", "tolerance", "error", "time in ms", "evaluations", "steps", "on the front"];
    let row = |(run, on_front): (&Run, bool)| {
        vec![
            run.model.name.to_owned(),
            run.arithmetic.name(),
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
