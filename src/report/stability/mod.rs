//! `stability.html` and `stability.json`: where the formulas of notes lose their digits in doubles, and forms that do
//! not.

mod view;

use std::path::Path;

use serde::Serialize;
use tera::{Context, Tera};

use super::write::pair;
use super::{Options, ReportError, Written};
use crate::diagnose::stability::catalogue::Measured;
use crate::diagnose::stability::survey::{Counts, Survey};

/// The version of `stability.json`. It rises when a field changes its meaning or goes.
pub const SCHEMA: u32 = 1;

const STYLE: &str = include_str!("../../../templates/style.css");

const TEMPLATES: [(&str, &str); 3] = [
    ("stability.html", include_str!("../../../templates/stability.html")),
    ("form.html", include_str!("../../../templates/form.html")),
    ("chart.html", include_str!("../../../templates/chart.html")),
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
    let mut tera = Tera::new();
    tera.add_raw_templates(TEMPLATES)?;
    let mut context = Context::from_serialize(&view::page(stability, options))?;
    context.insert("style", STYLE);
    context.insert("w", super::Language::English.words());
    Ok(tera.render("stability.html", &context)?)
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
pub fn table(cases: &[Measured]) -> String {
    let mut text = format!(
        "{:<66} {:>9}  {:>13}  {:>13}  {:>13}  same\n",
        "hard case", "condition", "at the state", "mean", "worst fault"
    );
    let pair = |before: f64, after: Option<f64>| match after {
        Some(after) => format!("{before:.1} -> {after:.1}"),
        None => format!("{before:.1}"),
    };
    for case in cases {
        let after = case.after.as_ref().map(|a| &a.form);
        text += &format!(
            "{:<66} {:>9.1}  {:>13}  {:>13}  {:>13}  {}\n",
            format!("{} ({})", case.name, case.equation),
            case.before.at.condition,
            pair(case.before.at.lost, after.map(|f| f.at.lost)),
            pair(case.before.found.mean, after.map(|f| f.found.mean)),
            pair(case.before.found.fault.loss.fault(), after.map(|f| f.found.fault.loss.fault())),
            case.after.as_ref().map_or("no stable form".to_owned(), |a| view::sameness(a.sameness)),
        );
    }
    text
}
