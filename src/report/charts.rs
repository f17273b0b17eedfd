//! The charts of the report: the approximations of the gyroscope notes against the exact motion of a heavy top, and the
//! constants of the motion against the integrators.

use super::svg::{Axis, Series, plot};
use super::text::number;
use super::words::charts::ChartWords;
use super::words::{Language, with};
use crate::integrator::{CLASSICAL_4, DORMAND_PRINCE_8, IntegrationError, RungeKutta, Tableau, integrate_fixed};
use crate::scene::top::{HeavyTop, TooSlow, TopState};
use serde::Serialize;
use std::fmt::Display;

/// A chart, with its numbers.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Chart {
    /// Its anchor in the page.
    pub id: String,
    /// Its title.
    pub title: String,
    /// What it shows; `$...$` is mathematics.
    pub caption: String,
    /// The drawing: an `svg` element whose colours are classes.
    pub svg: String,
    /// What its lines are.
    pub legend: Vec<LegendEntry>,
    /// The numbers that are drawn.
    pub table: Table,
}

/// A line of a chart.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LegendEntry {
    /// The class of the line: `line-1`, or `dash-1` where it is dashed.
    pub class: String,
    /// The class of its markers: `fill-1`, or `ring-1` where they are rings; none where its points are not marked.
    pub marker: Option<String>,
    /// What it is; `$...$` is mathematics.
    pub label: String,
}

/// Numbers under headings.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Table {
    /// The headings; `$...$` is mathematics.
    pub head: Vec<String>,
    /// The rows, each as long as `head`.
    pub rows: Vec<Vec<String>>,
}

/// Why a chart could not be made.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
pub enum ChartError {
    /// The drawing failed.
    #[error("the chart could not be drawn: {0}")]
    Drawing(String),
    /// The motion could not be integrated.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Integration(#[from] IntegrationError),
    /// The top is too slow for what is drawn.
    #[error(transparent)]
    #[diagnostic(transparent)]
    TooSlow(#[from] TooSlow),
    /// The motion has no nutation.
    #[error("a top at {theta} rad with a spin of {spin} rad/s does not nutate")]
    NoNutation {
        /// The inclination.
        theta: f64,
        /// The spin.
        spin: f64,
    },
}

impl ChartError {
    pub(super) fn drawing(error: impl Display) -> Self {
        ChartError::Drawing(error.to_string())
    }
}

/// A demonstration gyroscope: `I_0` = 0.010 kg m^2, `I_1` = 0.012 kg m^2, an added mass with a torque of 0.10 N m.
const TOP: HeavyTop = HeavyTop { transverse: 0.010, axial: 0.012, torque: 0.10 };
/// The inclination of its axis in rad.
const THETA: f64 = 0.6;
/// Its spin in rad/s where that is fixed.
const SPIN: f64 = 100.0;
/// The precession in rad/s with which the top is set going where its nutation is to be wide: backward, so that the axis
/// draws loops.
const KICK: f64 = -20.0;
/// How many nutations the conserved quantities are followed through.
const PERIODS: usize = 300;
/// Evaluations of the equations of motion for each nutation, for either method.
const EVALUATIONS: usize = 144;

/// The charts of the heavy top: conservation, precession, nutation.
///
/// # Errors
/// [`ChartError`]
pub fn heavy_top(language: Language) -> Result<Vec<Chart>, ChartError> {
    let words = language.chart_words();
    Ok(vec![conservation(words)?, precession(words)?, nutation(words)?])
}

/// A constant of the motion, with its name.
type Constant = (fn(&ChartWords) -> &'static str, fn(&TopState) -> f64);

/// The constants of the motion whose drift is drawn.
const CONSTANTS: [Constant; 3] = [
    (|_| "$L_z$", |state| TOP.vertical_momentum(state)),
    (|words| words.energy, |state| TOP.energy(state)),
    (|_| r"$\omega_\zeta$", TopState::spin),
];

/// For each nutation, the largest relative drift so far of each constant.
fn drifts(method: &Tableau, period: f64) -> Result<Vec<[f64; 3]>, ChartError> {
    let start = TopState::turning(THETA, KICK, SPIN);
    let steps = EVALUATIONS / method.stages.len();
    let initial = CONSTANTS.map(|(_, f)| f(&start));
    let (mut largest, mut rows, mut step) = ([0.0f64; 3], Vec::with_capacity(PERIODS), 0);
    let mut stepper = RungeKutta::new(method, &TOP, 6, &());
    integrate_fixed(&mut stepper, (&0.0, &start.to_vector()), &(period / steps as f64), steps * PERIODS, |_, y| {
        if let Some(state) = TopState::from_vector(y.value()) {
            for ((largest, (_, f)), initial) in largest.iter_mut().zip(CONSTANTS).zip(initial) {
                *largest = largest.max((f(&state) / initial - 1.0).abs());
            }
        }
        step += 1;
        if step % steps == 0 {
            rows.push(largest);
        }
    })?;
    Ok(rows)
}

fn conservation(t: &ChartWords) -> Result<Chart, ChartError> {
    let exact = TOP.nutation(THETA, KICK, SPIN).ok_or(ChartError::NoNutation { theta: THETA, spin: SPIN })?;
    let methods = [&CLASSICAL_4, &DORMAND_PRINCE_8];
    let (mut series, mut legend, mut columns) = (Vec::new(), Vec::new(), Vec::new());
    for method in methods {
        let rows = drifts(method, exact.period())?;
        let dashed = method.order == CLASSICAL_4.order;
        for (i, colour) in (0..CONSTANTS.len()).zip(1..) {
            let points = rows.iter().enumerate().map(|(n, row)| ((n + 1) as f64, row[i])).collect();
            series.push(Series { colour, dashed, markers: false, points });
            legend.push(entry(
                colour,
                dashed,
                false,
                with(t.drift_line, &[("constant", &CONSTANTS[i].0(t)), ("method", &method.name)]),
            ));
        }
        columns.push(rows);
    }
    let x = Axis { label: t.nutations, range: 0.0..PERIODS as f64, logarithmic: false };
    let y = Axis { label: t.relative_drift, range: 1e-16..1e-2, logarithmic: true };
    let title = t.drift_title;
    let places: [(&str, &dyn Display); 9] = [
        ("theta", &THETA),
        ("spin", &SPIN),
        ("kick", &KICK),
        ("periods", &PERIODS),
        ("evaluations", &EVALUATIONS),
        ("drift", &last(&columns[0])),
        ("method", &methods[0].name),
        ("drift_2", &last(&columns[1])),
        ("method_2", &methods[1].name),
    ];
    let caption = with(t.drift_caption, &places);
    let head = std::iter::once(t.nutations.to_owned()).chain(legend.iter().map(|e: &LegendEntry| e.label.clone()));
    let sampled = [1, 3, 10, 30, 100, PERIODS].into_iter().map(|n| {
        let drifts = columns.iter().flat_map(|rows| rows[n - 1].iter().map(|d| number(*d, 3)));
        std::iter::once(n.to_string()).chain(drifts).collect()
    });
    let table = Table { head: head.collect(), rows: sampled.collect() };
    Ok(chart("drift", title, caption, plot(title, &x, &y, &series)?, legend, table))
}

/// The energy's drift at the end.
fn last(rows: &[[f64; 3]]) -> String {
    rows.last().map_or_else(String::new, |row| number(row[1], 2))
}

/// Spins from 10 to 1000 rad/s, eight to a decade.
fn spins() -> impl Iterator<Item = f64> {
    (0..=16).map(|i| 10f64.powf(1.0 + f64::from(i) / 8.0))
}

/// The order with which errors fall as the spin grows: the slope of the least-squares line through the upper decade.
fn order(points: &[(f64, f64)]) -> f64 {
    let upper: Vec<_> = points[points.len() / 2..].iter().map(|(x, y)| (x.ln(), y.ln())).collect();
    let n = upper.len() as f64;
    let (mean_x, mean_y) = upper.iter().fold((0.0, 0.0), |(a, b), (x, y)| (a + x / n, b + y / n));
    let (product, square) =
        upper.iter().fold((0.0, 0.0), |(p, s), (x, y)| (p + (x - mean_x) * (y - mean_y), s + (x - mean_x).powi(2)));
    -product / square
}

fn precession(t: &ChartWords) -> Result<Chart, ChartError> {
    let (mut slow, mut fast, mut rows) = (Vec::new(), Vec::new(), Vec::new());
    for spin in spins() {
        let exact = TOP.steady_precession(THETA, spin)?;
        let error = (TOP.slow_approximation(spin) / exact.slow - 1.0).abs();
        let exact_fast = exact.fast.unwrap_or(f64::INFINITY);
        let fast_error = (TOP.fast_approximation(THETA, spin) / exact_fast - 1.0).abs();
        slow.push((spin, error));
        fast.push((spin, fast_error));
        rows.push([spin, exact.slow, error, exact_fast, fast_error].iter().map(|v| number(*v, 4)).collect());
    }
    let title = t.precession_title;
    let [slow_order, fast_order] = [&slow, &fast].map(|points| format!("{:.3}", order(points)));
    let places: [(&str, &dyn Display); 3] = [("theta", &THETA), ("slow", &slow_order), ("fast", &fast_order)];
    let caption = with(t.precession_caption, &places);
    let legend = vec![entry(1, false, true, t.slow.to_owned()), entry(2, true, true, t.fast.to_owned())];
    let series = [
        Series { colour: 1, dashed: false, markers: true, points: slow },
        Series { colour: 2, dashed: true, markers: true, points: fast },
    ];
    let head = [t.spin, t.slow_root, t.error, t.fast_root, t.error].map(String::from).to_vec();
    let svg = plot(title, &spin_axis(t), &error_axis(t), &series)?;
    Ok(chart("precession", title, caption, svg, legend, Table { head, rows }))
}

fn nutation(t: &ChartWords) -> Result<Chart, ChartError> {
    let (mut let_go, mut small, mut rows) = (Vec::new(), Vec::new(), Vec::new());
    for spin in spins() {
        let exact = TOP.nutation(THETA, 0.0, spin).ok_or(ChartError::NoNutation { theta: THETA, spin })?.frequency;
        let steady = TOP.steady_precession(THETA, spin)?.slow;
        let linear = TOP.linear_nutation_frequency(THETA, steady, spin);
        let approximation = TOP.nutation_approximation(spin);
        let errors = [exact, linear].map(|frequency| (approximation / frequency - 1.0).abs());
        let_go.push((spin, errors[0]));
        small.push((spin, errors[1]));
        let values = [spin, approximation, exact, errors[0], linear, errors[1]];
        rows.push(values.iter().map(|v| number(*v, 4)).collect());
    }
    let title = t.nutation_title;
    let [rest_order, small_order] = [&let_go, &small].map(|points| format!("{:.3}", order(points)));
    let places: [(&str, &dyn Display); 3] = [("theta", &THETA), ("let_go", &rest_order), ("small", &small_order)];
    let caption = with(t.nutation_caption, &places);
    let legend = vec![entry(1, false, true, t.let_go.to_owned()), entry(2, true, true, t.infinitesimal.to_owned())];
    let series = [
        Series { colour: 1, dashed: false, markers: true, points: let_go },
        Series { colour: 2, dashed: true, markers: true, points: small },
    ];
    let head = [t.spin, t.frequency, t.let_go_head, t.error, t.infinitesimal_head, t.error];
    let svg = plot(title, &spin_axis(t), &error_axis(t), &series)?;
    Ok(chart("nutation", title, caption, svg, legend, Table { head: head.map(String::from).to_vec(), rows }))
}

fn spin_axis(t: &ChartWords) -> Axis {
    Axis { label: t.spin_axis, range: 9.5..1050.0, logarithmic: true }
}

fn error_axis(t: &ChartWords) -> Axis {
    Axis { label: t.relative_error, range: 1e-6..1.0, logarithmic: true }
}

fn entry(colour: u8, dashed: bool, markers: bool, label: String) -> LegendEntry {
    let (line, marker) = if dashed { ("dash", "ring") } else { ("line", "fill") };
    LegendEntry { class: format!("{line}-{colour}"), marker: markers.then(|| format!("{marker}-{colour}")), label }
}

fn chart(id: &str, title: &str, caption: String, svg: String, legend: Vec<LegendEntry>, table: Table) -> Chart {
    Chart { id: format!("chart-{id}"), title: title.to_owned(), caption, svg, legend, table }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Series of either method, and the drift at its end.
    #[test]
    fn order_eight_drifts_less_than_order_four_at_the_same_cost() {
        let period = TOP.nutation(THETA, KICK, SPIN).unwrap().period();
        let four = *drifts(&CLASSICAL_4, period).unwrap().last().unwrap();
        let eight = *drifts(&DORMAND_PRINCE_8, period).unwrap().last().unwrap();
        println!("drift after {PERIODS} nutations: {four:?} and {eight:?}");
        for (four, eight) in four.iter().zip(eight) {
            assert!(eight * 100.0 < *four);
            assert!(eight > 0.0, "a constant that has not moved at all was not computed from the motion");
        }
    }

    #[test]
    fn approximations_have_order_two() {
        let t = Language::English.chart_words();
        for chart in [precession(t).unwrap(), nutation(t).unwrap()] {
            println!("{}", chart.caption);
            let spin = |row: &[String]| row[0].parse::<f64>().unwrap();
            assert_eq!(spin(&chart.table.rows[0]), 10.0);
            assert_eq!(chart.caption.matches("2.0").count() + chart.caption.matches("1.9").count(), 2);
        }
    }

    #[test]
    fn slopes_are_measured() {
        let points: Vec<_> = spins().map(|x| (x, 7.0 / x.powi(3))).collect();
        assert!((order(&points) - 3.0).abs() < 1e-12);
    }

    #[test]
    fn charts_are_the_same_each_time_and_have_no_colours_of_their_own() {
        let charts = heavy_top(Language::Japanese).unwrap();
        assert_eq!(charts, heavy_top(Language::Japanese).unwrap());
        for chart in charts {
            assert!(!chart.svg.contains('#'), "{}", chart.svg);
            assert!(chart.table.rows.iter().all(|row| row.len() == chart.table.head.len()));
            assert!(chart.legend.iter().all(|e| chart.svg.contains(&e.class)), "{}", chart.id);
        }
    }
}
