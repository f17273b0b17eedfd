//! The command `kenzan scene`: a motion's values by the cheapest model that meets an error, and why it is that one.

use std::fmt::Write as _;
use std::io::Write as _;
use std::time::{Duration, Instant};

use clap::ValueEnum;
use serde::Serialize;

use crate::scene::{self, Kind, Outcome, Request, SCENES, Scene};

/// The most times that a request may have.
const MOST_TIMES: usize = 10_000_000;

/// The arguments of `kenzan scene`.
#[derive(Debug, clap::Args)]
pub(super) struct Arguments {
    /// The scene; without it the scenes are listed.
    name: Option<String>,
    /// A quantity, or several with commas between them; without any, the scene's quantities and models are listed.
    #[arg(long, short, value_name = "NAME", value_delimiter = ',')]
    quantity: Vec<String>,
    /// The last time, in the scene's unit of time.
    #[arg(long, value_name = "T", default_value_t = 10.0)]
    until: f64,
    /// The number of times, from 0 to the last one.
    #[arg(long, value_name = "N", default_value_t = 11)]
    points: usize,
    /// The time from one value to the next, instead of their number.
    #[arg(long, value_name = "H", conflicts_with = "points")]
    step: Option<f64>,
    /// The largest absolute error of a value, in the quantity's unit.
    #[arg(long, value_name = "E", default_value_t = 1e-9)]
    error: f64,
    /// The model, instead of the cheapest that meets the error.
    #[arg(long, value_name = "NAME")]
    model: Option<String>,
    /// A parameter, `theta_0=60deg`; may be repeated.
    #[arg(long, value_name = "NAME=VALUE")]
    set: Vec<String>,
    /// The precision beyond double-double, where that is needed (needs the feature `rug`).
    #[arg(long, value_name = "BITS", value_parser = super::precision)]
    precision: Option<u32>,
    /// What to print: a table and the choice, all of it as JSON, or the table as CSV and the choice as messages.
    #[arg(long, value_enum, default_value_t = Format::Human)]
    format: Format,
    /// Leave out the time that it took.
    #[arg(long)]
    no_times: bool,
}

/// What `scene` prints.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    /// A table, the model taken, and why.
    Human,
    /// The same as JSON; values are strings, which keep all digits.
    Json,
    /// The table as CSV.
    Csv,
}

/// Runs `kenzan scene`.
pub(super) fn run(arguments: &Arguments) -> miette::Result<u8> {
    let Some(name) = &arguments.name else {
        print(&scenes());
        return Ok(super::AS_EXPECTED);
    };
    let scene = scene::scene(name)?;
    if arguments.quantity.is_empty() {
        print(&contents(scene));
        return Ok(super::AS_EXPECTED);
    }
    let request = request(scene, arguments)?;
    let begin = Instant::now();
    let outcome = scene::choose(&request)?;
    let took = (!arguments.no_times).then(|| begin.elapsed());
    match arguments.format {
        Format::Human => print(&format!("{}\n{}", table(&request, &outcome), reasons(&request, &outcome, took))),
        Format::Json => print(&json(&request, &outcome, took)?),
        Format::Csv => {
            print(&csv(&request, &outcome));
            eprint!("{}", reasons(&request, &outcome, took));
        }
    }
    Ok(if outcome.met { super::AS_EXPECTED } else { super::NOT_AS_EXPECTED })
}

/// A closed pipe is no failure.
fn print(text: &str) {
    let _ = std::io::stdout().write_all(text.as_bytes());
}

fn request(scene: &'static Scene, arguments: &Arguments) -> miette::Result<Request> {
    let mut parameters = scene.defaults();
    for set in &arguments.set {
        let (name, value) = set.split_once('=').ok_or_else(|| {
            miette::miette!(help = "write --set I_0=1", "expected NAME=VALUE for a parameter, found `{set}`")
        })?;
        let position = scene.parameter(name.trim())?;
        parameters[position] = number(value.trim())?;
    }
    let quantities = arguments.quantity.iter().map(|q| scene.quantity(q.trim())).collect::<Result<_, _>>()?;
    Ok(Request {
        scene,
        parameters,
        quantities,
        times: times(arguments)?,
        error: arguments.error,
        model: arguments.model.clone(),
        bits: arguments.precision,
    })
}

/// A number, with `deg` for an angle in degrees.
fn number(text: &str) -> miette::Result<f64> {
    let (digits, unit) = text.strip_suffix("deg").map_or((text, 1.0), |digits| (digits, 1f64.to_radians()));
    let value: Result<f64, _> = digits.trim().parse();
    value.map(|x| x * unit).map_err(|_| {
        miette::miette!(help = "write a decimal number, 0.5 or 1e-3, or an angle as 60deg", "`{text}` is no number")
    })
}

fn times(arguments: &Arguments) -> miette::Result<Vec<f64>> {
    let Arguments { until, points, step, .. } = *arguments;
    if !(until.is_finite() && until >= 0.0) {
        return Err(miette::miette!(help = "the motion begins at t = 0", "the last time is {until}"));
    }
    let count = match step {
        Some(h) if h > 0.0 => (until / h * (1.0 + f64::EPSILON)).floor() + 1.0,
        Some(h) => return Err(miette::miette!(help = "give a positive --step", "the step between times is {h}")),
        None => points as f64,
    };
    if !(count >= 1.0 && count <= MOST_TIMES as f64) {
        return Err(miette::miette!(
            help = "ask for fewer with --points or --step",
            "expected from 1 to {MOST_TIMES} times, found {count}"
        ));
    }
    let last = count - 1.0;
    let at = |i: usize| match step {
        Some(h) => (i as f64 * h).min(until),
        None if i as f64 == last => until,
        None => until * (i as f64 / last),
    };
    Ok((0..count as usize).map(at).collect())
}

fn scenes() -> String {
    let mut text = String::from("scenes\n");
    for scene in SCENES {
        let _ = writeln!(text, "  {:<10} {}", scene.name, scene.about);
    }
    text.push_str("\n`kenzan scene NAME` lists the parameters, quantities and models of one\n");
    text
}

fn contents(scene: &Scene) -> String {
    let mut text = format!("{}: {}\n\nparameters (--set NAME=VALUE)\n", scene.name, scene.about);
    for p in scene.parameters {
        let _ = writeln!(text, "  {:<12} {:<10} {:<20} {}", p.name, p.unit, p.default, p.about);
    }
    text.push_str("\nquantities (--quantity NAME)\n");
    for q in scene.quantities {
        let _ = writeln!(text, "  {:<12} {:<10} {}", q.name, q.unit, q.about);
    }
    text.push_str("\nmodels, from cheap to full (--model NAME)\n");
    for model in scene.models {
        let about = model.about();
        let kind = match about.kind {
            Kind::Approximation => "approximation",
            Kind::Exact => "closed form",
            Kind::Integrated => "integrated",
        };
        let _ = writeln!(text, "  {:<15} {:<13} {}", about.name, kind, about.what);
        let _ = writeln!(text, "  {:<15} {:<13} source: {}", "", "", about.source);
    }
    text
}

/// The digits that are worth printing: one beyond the error.
fn digits(value: f64, error: f64) -> usize {
    let size = value.abs().max(error);
    ((size / error).log10().ceil() + 2.0).clamp(1.0, 40_000.0) as usize
}

fn value(outcome: &Outcome, error: f64, machine: &[Vec<f64>], row: usize, column: usize) -> String {
    let size = machine.get(row).and_then(|r| r.get(column)).copied().unwrap_or(0.0);
    outcome.values.to_decimal(row, column, digits(size, error))
}

/// The table's rows: the time and the values.
fn rows(request: &Request, outcome: &Outcome) -> Vec<Vec<String>> {
    let (machine, error) = (outcome.values.to_f64(), request.error.max(outcome.measured.min(1.0) * 0.1));
    let row = |(column, t): (usize, &f64)| {
        let values = (0..request.quantities.len()).map(|row| value(outcome, error, &machine, row, column));
        std::iter::once(t.to_string()).chain(values).collect()
    };
    request.times.iter().enumerate().map(row).collect()
}

fn names(request: &Request) -> Vec<(&'static str, &'static str)> {
    request.quantities.iter().filter_map(|q| request.scene.quantities.get(*q)).map(|q| (q.name, q.unit)).collect()
}

fn table(request: &Request, outcome: &Outcome) -> String {
    let named = names(request);
    let head =
        std::iter::once(format!("t [{}]", request.scene.time)).chain(named.iter().map(|(n, u)| format!("{n} [{u}]")));
    let head: Vec<String> = head.collect();
    let rows = rows(request, outcome);
    let width =
        |k: usize| rows.iter().chain([&head]).filter_map(|r| r.get(k)).map(|c| c.chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..head.len()).map(width).collect();
    let mut text = String::new();
    for row in std::iter::once(&head).chain(&rows) {
        let cells: Vec<String> = row.iter().zip(&widths).map(|(cell, width)| format!("{cell:<width$}")).collect();
        let _ = writeln!(text, "{}", cells.join("  ").trim_end());
    }
    text
}

fn csv(request: &Request, outcome: &Outcome) -> String {
    let mut text = String::from("t");
    for (name, _) in names(request) {
        let _ = write!(text, ",{name}");
    }
    text.push('\n');
    for row in rows(request, outcome) {
        let _ = writeln!(text, "{}", row.join(","));
    }
    text
}

/// The model taken, why, and what it cost.
fn reasons(request: &Request, outcome: &Outcome, took: Option<Duration>) -> String {
    let Outcome { model, arithmetic, measured, met, probes, yardstick, refused, cost, .. } = outcome;
    let mut text = format!("model {} in {}: {}\n", model.name, arithmetic.name(), model.what);
    let verdict = if *met { "which meets" } else { "which MISSES" };
    let _ = writeln!(
        text,
        "  error {measured:.1e}, {verdict} the {:e} asked for; measured at {probes} of {} times against {yardstick}",
        request.error,
        request.times.len()
    );
    for refusal in refused {
        let _ = writeln!(text, "  not {} in {}: {}", refusal.model, refusal.arithmetic.name(), refusal.why);
    }
    let _ = match (cost.steps, cost.order) {
        (0, _) => write!(text, "  cost: {} evaluations", cost.evaluations),
        (steps, order) => write!(text, "  cost: {steps} steps of order {order}"),
    };
    if let Some(took) = took {
        let _ = write!(text, ", {took:.1?} with the choice");
    }
    text.push('\n');
    text
}

#[derive(Serialize)]
struct Report<'a> {
    schema: u32,
    scene: &'a str,
    model: &'a str,
    number: String,
    asked_error: f64,
    measured_error: f64,
    met: bool,
    probes: usize,
    measured_against: &'a str,
    refused: Vec<Refused<'a>>,
    evaluations: usize,
    steps: usize,
    order: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    micros: Option<u64>,
    times: &'a [f64],
    values: serde_json::Map<String, serde_json::Value>,
}

#[derive(Serialize)]
struct Refused<'a> {
    model: &'a str,
    number: String,
    measured_error: Option<f64>,
    why: &'a str,
}

fn json(request: &Request, outcome: &Outcome, took: Option<Duration>) -> miette::Result<String> {
    let rows = rows(request, outcome);
    let mut values = serde_json::Map::new();
    for (k, (name, _)) in names(request).into_iter().enumerate() {
        values.insert(name.into(), rows.iter().filter_map(|r| r.get(k + 1).cloned()).collect());
    }
    let refused = outcome.refused.iter().map(|r| Refused {
        model: r.model,
        number: r.arithmetic.name(),
        measured_error: r.measured,
        why: &r.why,
    });
    let report = Report {
        schema: 1,
        scene: request.scene.name,
        model: outcome.model.name,
        number: outcome.arithmetic.name(),
        asked_error: request.error,
        measured_error: outcome.measured,
        met: outcome.met,
        probes: outcome.probes,
        measured_against: &outcome.yardstick,
        refused: refused.collect(),
        evaluations: outcome.cost.evaluations,
        steps: outcome.cost.steps,
        order: outcome.cost.order,
        micros: took.map(|t| t.as_micros() as u64),
        times: &request.times,
        values,
    };
    let text = serde_json::to_string_pretty(&report);
    text.map(|t| t + "\n").map_err(|e| miette::miette!("the values could not be written as JSON: {e}"))
}
