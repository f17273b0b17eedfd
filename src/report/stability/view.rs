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
use crate::report::words::stability::StabilityWords;
use crate::report::words::with;
use crate::report::{Options, view_charts};

/// The most symbols of a state that are shown.
const MOST_SYMBOLS: usize = 12;
/// The longest LaTeX that is shown in a table, in bytes.
const LONGEST: usize = 700;

#[derive(Serialize)]
pub(super) struct Page {
    seed: u64,
    exact_values: String,
    lead_time: String,
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
pub(in crate::report) fn sameness(sameness: Sameness, t: &StabilityWords) -> String {
    match sameness {
        Sameness::Exact { .. } => t.same_exactly.into(),
        Sameness::Numeric { bits, .. } => with(t.same_bits, &[("n", &bits)]),
        Sameness::Different => t.same_not.into(),
        Sameness::Unknown => t.same_unknown.into(),
    }
}

fn bits(x: f64) -> String {
    format!("{x:.1}")
}

/// What formulas are shown with.
struct Shown {
    renderer: Renderer,
    t: &'static StabilityWords,
}

/// The page of what was found.
pub(super) fn page(stability: &Stability, options: Options) -> Page {
    let shown = Shown { renderer: Renderer::new(), t: options.language.stability_words() };
    let chart = chart(&stability.cases, shown.t).map(|c| view_charts::view(&c, &shown.renderer));
    let time = options.times.then(|| with(shown.t.lead_time, &[("time", &duration(stability.micros))]));
    Page {
        seed: stability.seed,
        exact_values: options.language.say(stability.exact_values()).into_owned(),
        lead_time: time.unwrap_or_default(),
        counts: stability.counts(),
        documents: stability.documents.iter().map(|d| shown.document(d)).collect(),
        cases: stability.cases.iter().enumerate().map(|(k, c)| shown.case(k + 1, c)).collect(),
        charts: chart.into_iter().collect(),
        times: stability.cases.iter().any(|c| c.before.nanoseconds.is_some()),
    }
}

impl Shown {
    fn document(&self, survey: &Survey) -> Document {
        let mut unstable: Vec<&Item> = survey.items.iter().filter(|i| i.is_at_fault()).collect();
        unstable.sort_by(|a, b| b.found.fault.loss.fault().total_cmp(&a.found.fault.loss.fault()));
        let ill = survey.items.iter().filter(|i| i.loses() && !i.is_at_fault());
        Document {
            name: survey.name.clone(),
            counts: survey.counts(),
            unstable: unstable.into_iter().map(|i| self.formula(i, &i.found.fault)).collect(),
            ill_conditioned: ill.map(|i| self.formula(i, &i.found.worst)).collect(),
        }
    }

    fn formula(&self, item: &Item, hard: &Hard) -> Formula {
        let shown = |latex: &str| {
            if latex.len() <= LONGEST { self.renderer.inline(latex) } else { self.t.long_formula.to_owned() }
        };
        let proposal = item.proposal.as_ref();
        Formula {
            label: item.label.clone(),
            line: item.line,
            math_html: shown(&item.latex),
            mean: bits(item.found.mean),
            hard: self.state(&item.symbols, hard),
            proposal_html: proposal.and_then(|p| p.latex.as_deref()).map(shown),
            proposal: proposal.map(|p| {
                let (mean, worst) = (bits(p.found.mean), bits(p.found.worst.loss.lost));
                let beyond = bits(p.found.fault.loss.fault());
                let same = sameness(p.sameness, self.t);
                with(self.t.proposal, &[("mean", &mean), ("worst", &worst), ("beyond", &beyond), ("same", &same)])
            }),
        }
    }

    fn state(&self, symbols: &[String], hard: &Hard) -> State {
        let Loss { lost, condition } = hard.loss;
        let assignments = symbols.iter().zip(&hard.state).take(MOST_SYMBOLS);
        State {
            lost: bits(lost),
            condition: bits(condition),
            fault: bits(hard.loss.fault()),
            symbols: assignments.map(|(s, x)| (self.renderer.inline(s), x.to_string())).collect(),
            more: symbols.len().saturating_sub(MOST_SYMBOLS),
        }
    }

    fn case(&self, number: usize, case: &Measured) -> Case {
        let other = |o: &Other| self.column(&o.form, Some(sameness(o.sameness, self.t)));
        Case {
            number,
            name: case.name.clone(),
            notes: case.notes.clone(),
            equation: case.equation.clone(),
            printed: case.printed,
            why_html: self.renderer.prose(&case.why),
            source: case.source.clone(),
            state: case.state.iter().map(|(s, x)| (self.renderer.inline(s), x.to_string())).collect(),
            condition: bits(case.before.at.condition),
            before: self.column(&case.before, None),
            after: case.after.as_ref().map(other),
            rewritten: case.rewritten.as_ref().map(other),
            inherent: case.before.found.fault.loss.fault() <= crate::diagnose::stability::survey::MANY,
        }
    }

    fn column(&self, form: &Form, sameness: Option<String>) -> Column {
        Column {
            math_html: self.renderer.display(&form.latex),
            at: bits(form.at.lost),
            mean: bits(form.found.mean),
            worst: bits(form.found.worst.loss.lost),
            fault: bits(form.found.fault.loss.fault()),
            nanoseconds: form.nanoseconds.map(|n| number(n, 2)),
            sameness,
        }
    }
}

/// The chart of all cases at their hard states.
fn chart(cases: &[Measured], t: &StabilityWords) -> Option<Chart> {
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
    let title = t.chart_title;
    let svg = draw(title, [t.chart_bits, t.chart_time], &rows).ok().filter(|_| !rows.is_empty())?;
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
    let mut head = vec![t.chart_case, t.chart_before, t.chart_after, t.chart_condition_head];
    if rows.iter().any(|r| r.nanoseconds.is_some()) {
        head.extend([t.chart_time_before, t.chart_after]);
    }
    Some(Chart {
        id: "chart-stability".into(),
        title: title.into(),
        caption: t.chart_caption.into(),
        svg,
        legend: vec![
            entry("line-1", Some("fill-2"), t.chart_formula),
            entry("line-1", Some("ring-1"), t.chart_stable),
            entry("ink", None, t.chart_condition),
        ],
        table: Table { head: head.into_iter().map(str::to_owned).collect(), rows: rows.iter().map(numbers).collect() },
    })
}
