//! `stability.html` and `stability.json`: where the formulas of notes lose their digits in doubles, and forms that do
//! not.

mod view;

use std::fmt::Display;
use std::path::Path;

use serde::Serialize;

use super::text::{padded, padded_left};
use super::words::stability::StabilityWords;
use super::words::with;
use super::write::pair;
use super::{Language, Options, ReportError, Written, html};
use crate::diagnose::stability::catalogue::Measured;
use crate::diagnose::stability::survey::{Counts, Survey};

/// The version of `stability.json`. It rises when a field changes its meaning or goes.
pub const SCHEMA: u32 = 1;

const TEMPLATES: [(&str, &str); 2] = [
    ("stability.html", include_str!("../../../templates/stability.html")),
    ("form.html", include_str!("../../../templates/form.html")),
];

/// What was found of documents and of the hard cases.
#[derive(Clone, Debug, PartialEq)]
pub struct Stability {
    /// The seed of the states.
    pub seed: u64,
    /// The documents.
    pub documents: Vec<Survey>,
    /// The hard cases.
    pub cases: Vec<Measured>,
    /// The time that it took, in microseconds.
    pub micros: u64,
}

impl Stability {
    /// How many formulas of all documents lose how much.
    pub fn counts(&self) -> Counts {
        self.documents.iter().map(Survey::counts).fold(Counts::default(), Counts::and)
    }

    /// What the exact values are known by.
    pub fn exact_values(&self) -> &'static str {
        if cfg!(feature = "rug") { "double-double, or MPFR where that is not enough" } else { "double-double" }
    }
}

#[derive(Serialize)]
struct Data<'a> {
    schema: u32,
    kenzan: &'static str,
    seed: u64,
    exact_values: &'static str,
    summary: Counts,
    cases: &'a [Measured],
    documents: &'a [Survey],
    #[serde(skip_serializing_if = "Option::is_none")]
    micros: Option<u64>,
}

/// The data as JSON.
///
/// # Errors
/// [`ReportError::Json`]
pub fn json(stability: &Stability, options: Options) -> Result<String, ReportError> {
    let data = Data {
        schema: SCHEMA,
        kenzan: env!("CARGO_PKG_VERSION"),
        seed: stability.seed,
        exact_values: stability.exact_values(),
        summary: stability.counts(),
        cases: &stability.cases,
        documents: &stability.documents,
        micros: options.times.then_some(stability.micros),
    };
    Ok(serde_json::to_string_pretty(&data)? + "\n")
}

/// The page.
///
/// # Errors
/// [`ReportError::Template`]: a template does not fit the data, which is a defect of Kenzan.
pub fn html(stability: &Stability, options: Options) -> Result<String, ReportError> {
    let language = options.language;
    html::measured(language, &TEMPLATES, language.stability_words(), &view::page(stability, options))
}

/// Writes `stability.html` and `stability.json` into the directory `out`, which is created if need be.
///
/// # Errors
/// [`ReportError`]
pub fn write(stability: &Stability, out: &Path, options: Options) -> Result<Written, ReportError> {
    let (html, json) = (html(stability, options)?, json(stability, options)?);
    pair(out, "stability", &html, &json)
}

/// The hard cases as a table in plain text, without times: one line for each.
pub fn table(cases: &[Measured], language: Language) -> String {
    let t = language.stability_words();
    let line = |[name, condition, at, mean, fault, same]: [&str; 6]| {
        let columns = [(condition, 9), (at, 13), (mean, 13), (fault, 13)].map(|(text, n)| padded_left(text, n));
        let [condition, at, mean, fault] = columns;
        format!("{} {condition}  {at}  {mean}  {fault}  {same}\n", padded(name, 66))
    };
    let pair = |before: f64, after: Option<f64>| match after {
        Some(after) => format!("{before:.1} -> {after:.1}"),
        None => format!("{before:.1}"),
    };
    let head = line([t.terminal_case, t.condition, t.at_state, t.mean, t.terminal_fault, t.terminal_same]);
    let row = |case: &Measured| {
        let after = case.after.as_ref().map(|a| &a.form);
        line([
            &format!("{} ({})", case.name, case.equation),
            &format!("{:.1}", case.before.at.condition),
            &pair(case.before.at.lost, after.map(|f| f.at.lost)),
            &pair(case.before.found.mean, after.map(|f| f.found.mean)),
            &pair(case.before.found.fault.loss.fault(), after.map(|f| f.found.fault.loss.fault())),
            &case.after.as_ref().map_or(t.terminal_no_form.to_owned(), |a| view::sameness(a.sameness, t)),
        ])
    };
    head + &cases.iter().map(row).collect::<String>()
}

/// What was found, in plain text, with the time that it took.
pub fn summary(stability: &Stability, options: Options) -> String {
    let t = options.language.stability_words();
    let mut text = table(&stability.cases, options.language);
    for line in counted(&stability.counts(), t) {
        text += &line;
    }
    if options.times {
        text += &format!("{:.1} s\n", stability.micros as f64 / 1e6);
    }
    text
}

/// How many formulas lose digits, in three lines after an empty one.
fn counted(counts: &Counts, t: &StabilityWords) -> [String; 3] {
    let all: [(&str, &dyn Display); 8] = [
        ("formulas", &counts.formulas),
        ("equations", &counts.equations),
        ("losing", &counts.losing),
        ("random", &counts.at_random),
        ("ill", &counts.ill_conditioned),
        ("exact", &counts.exact_numbers),
        ("unstable", &counts.unstable),
        ("mended", &counts.mended),
    ];
    [
        format!("\n{}\n", with(t.terminal_counts, &all)),
        format!("  {}\n", with(t.terminal_ill, &all)),
        format!("  {}\n", with(t.terminal_unstable, &all)),
    ]
}
