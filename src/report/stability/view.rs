//! What the template of the page is given.

use serde::Serialize;

use super::Stability;
use crate::diagnose::stability::catalogue::{Form, Measured, Other};
use crate::diagnose::stability::meter::Loss;
use crate::diagnose::stability::same::Sameness;
use crate::diagnose::stability::search::Hard;
use crate::diagnose::stability::survey::{Counts, Item, Survey};
use crate::report::charts::{Chart, LegendEntry, Table};
use crate::report::dumbbells::{Row, draw};
use crate::report::math::Renderer;
use crate::report::text::{duration, number};
use crate::report::{Options, view_charts};

/// The most symbols of a state that are shown.
const MOST_SYMBOLS: usize = 12;
/// The longest LaTeX that is shown in a table, in bytes.
const LONGEST: usize = 700;

#[derive(Serialize)]
pub(super) struct Page {
    version: &'static str,
    seed: u64,
    exact_values: &'static str,
    time: Option<String>,
    counts: Counts,
    documents: Vec<Document>,
    cases: Vec<Case>,
    charts: Vec<view_charts::View>,
    times: bool,
}

#[derive(Serialize)]
struct Document {
    name: String,
    counts: Counts,
    unstable: Vec<Formula>,
    ill_conditioned: Vec<Formula>,
}

/// A formula of a document.
#[derive(Serialize)]
struct Formula {
    label: String,
    line: usize,
    math_html: String,
    mean: String,
    hard: State,
    proposal_html: Option<String>,
    proposal: Option<String>,
}

/// A state with what is lost there.
#[derive(Serialize)]
struct State {
    lost: String,
    condition: String,
    fault: String,
    symbols: Vec<(String, String)>,
    more: usize,
}

/// A hard case.
#[derive(Serialize)]
struct Case {
    number: usize,
    name: String,
    notes: String,
    equation: String,
    printed: bool,
    why_html: String,
    source: Option<String>,
    state: Vec<(String, String)>,
    condition: String,
    before: Column,
    after: Option<Column>,
    rewritten: Option<Column>,
    inherent: bool,
}

/// A form of a case: a column of its table.
#[derive(Serialize)]
struct Column {
    math_html: String,
    at: String,
    mean: String,
    worst: String,
    fault: String,
    nanoseconds: Option<String>,
    sameness: Option<String>,
}

/// Whether two forms are the same, in words.
pub(in crate::report) fn sameness(sameness: Sameness) -> String {
    match sameness {
        Sameness::Exact { .. } => "exactly".into(),
        Sameness::Numeric { bits, .. } => format!("to {bits} bits"),
        Sameness::Different => "different".into(),
        Sameness::Unknown => "not known".into(),
    }
}

fn bits(x: f64) -> String {
    format!("{x:.1}")
}

/// The page of what was found.
pub(super) fn page(stability: &Stability, options: Options) -> Page {
    let renderer = Renderer::new();
    let case = |(k, c): (usize, &Measured)| case(k + 1, c, &renderer);
    let chart = chart(&stability.cases).map(|c| view_charts::view(&c, &renderer));
    Page {
        version: env!("CARGO_PKG_VERSION"),
        seed: stability.seed,
        exact_values: stability.exact_values(),
        time: options.times.then(|| duration(stability.micros)),
        counts: stability.counts(),
        documents: stability.documents.iter().map(|d| document(d, &renderer)).collect(),
        cases: stability.cases.iter().enumerate().map(case).collect(),
        charts: chart.into_iter().collect(),
        times: stability.cases.iter().any(|c| c.before.nanoseconds.is_some()),
    }
}

fn document(survey: &Survey, renderer: &Renderer) -> Document {
    let mut unstable: Vec<&Item> = survey.items.iter().filter(|i| i.is_at_fault()).collect();
    unstable.sort_by(|a, b| b.found.fault.loss.fault().total_cmp(&a.found.fault.loss.fault()));
    let ill = survey.items.iter().filter(|i| i.loses() && !i.is_at_fault());
    Document {
        name: survey.name.clone(),
        counts: survey.counts(),
        unstable: unstable.into_iter().map(|i| formula(i, &i.found.fault, renderer)).collect(),
        ill_conditioned: ill.map(|i| formula(i, &i.found.worst, renderer)).collect(),
    }
}

fn formula(item: &Item, hard: &Hard, renderer: &Renderer) -> Formula {
    let shown = |latex: &str| {
        if latex.len() <= LONGEST { renderer.inline(latex) } else { "a long formula".to_owned() }
    };
    let proposal = item.proposal.as_ref();
    Formula {
        label: item.label.clone(),
        line: item.line,
        math_html: shown(&item.latex),
        mean: bits(item.found.mean),
        hard: state(&item.symbols, hard, renderer),
        proposal_html: proposal.and_then(|p| p.latex.as_deref()).map(shown),
        proposal: proposal.map(|p| {
            let found = &p.found;
            let (mean, worst) = (bits(found.mean), bits(found.worst.loss.lost));
            let fault = bits(found.fault.loss.fault());
            format!("mean {mean}, worst {worst}, beyond the condition {fault}; the same {}", sameness(p.sameness))
        }),
    }
}

fn state(symbols: &[String], hard: &Hard, renderer: &Renderer) -> State {
    let Loss { lost, condition } = hard.loss;
    let assignments = symbols.iter().zip(&hard.state).take(MOST_SYMBOLS);
    State {
        lost: bits(lost),
        condition: bits(condition),
        fault: bits(hard.loss.fault()),
        symbols: assignments.map(|(s, x)| (renderer.inline(s), x.to_string())).collect(),
        more: symbols.len().saturating_sub(MOST_SYMBOLS),
    }
}

fn case(number: usize, case: &Measured, renderer: &Renderer) -> Case {
    let other = |o: &Other| column(&o.form, Some(sameness(o.sameness)), renderer);
    Case {
        number,
        name: case.name.clone(),
        notes: case.notes.clone(),
        equation: case.equation.clone(),
        printed: case.printed,
        why_html: renderer.prose(&case.why),
        source: case.source.clone(),
        state: case.state.iter().map(|(s, x)| (renderer.inline(s), x.to_string())).collect(),
        condition: bits(case.before.at.condition),
        before: column(&case.before, None, renderer),
        after: case.after.as_ref().map(other),
        rewritten: case.rewritten.as_ref().map(other),
        inherent: case.before.found.fault.loss.fault() <= crate::diagnose::stability::survey::MANY,
    }
}

fn column(form: &Form, sameness: Option<String>, renderer: &Renderer) -> Column {
    Column {
        math_html: renderer.display(&form.latex),
        at: bits(form.at.lost),
        mean: bits(form.found.mean),
        worst: bits(form.found.worst.loss.lost),
        fault: bits(form.found.fault.loss.fault()),
        nanoseconds: form.nanoseconds.map(|n| number(n, 2)),
        sameness,
    }
}

/// The chart of all cases at their hard states.
fn chart(cases: &[Measured]) -> Option<Chart> {
    let row = |(k, case): (usize, &Measured)| {
        let after = case.after.as_ref().map(|o| &o.form);
        Row {
            name: format!("{}  {}", k + 1, case.name),
            bits: (case.before.at.lost, after.map(|f| f.at.lost)),
            condition: case.before.at.condition,
            nanoseconds: case.before.nanoseconds.map(|n| (n, after.and_then(|f| f.nanoseconds))),
        }
    };
    let rows: Vec<Row> = cases.iter().enumerate().map(row).collect();
    let title = "Bits lost and time, before and after";
    let svg = draw(title, &rows).ok().filter(|_| !rows.is_empty())?;
    let entry = |class: &str, marker: Option<&str>, label: &str| LegendEntry {
        class: class.to_owned(),
        marker: marker.map(str::to_owned),
        label: label.to_owned(),
    };
    let numbers = |row: &Row| {
        let optional = |x: Option<f64>| x.map_or("–".to_owned(), |x| number(x, 3));
        let mut cells =
            vec![row.name.clone(), bits(row.bits.0), row.bits.1.map_or("–".into(), bits), bits(row.condition)];
        if let Some((before, after)) = row.nanoseconds {
            cells.extend([number(before, 3), optional(after)]);
        }
        cells
    };
    let mut head = vec!["case", "bits before", "after", "condition"];
    if rows.iter().any(|r| r.nanoseconds.is_some()) {
        head.extend(["ns before", "after"]);
    }
    Some(Chart {
        id: "chart-stability".into(),
        title: title.into(),
        caption: "At the hard state of each case. Left of the stroke the problem itself loses as many bits when its numbers are \
                  known to 53 bits; what lies right of it is the formula's fault. A stable form may stay left of it \
                  where the numbers are taken as exact."
            .into(),
        svg,
        legend: vec![
            entry("line-1", Some("fill-2"), "the formula of the notes"),
            entry("line-1", Some("ring-1"), "the stable form"),
            entry("ink", None, "the condition number"),
        ],
        table: Table { head: head.into_iter().map(str::to_owned).collect(), rows: rows.iter().map(numbers).collect() },
    })
}
