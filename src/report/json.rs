//! `report.json`, the contract for other tools.

use super::{Counts, Options, ReportError, Run};
use crate::check::verdict::DocumentReport;
use serde::Serialize;
use serde_json::Value;

/// The version of the contract. It rises when a field changes its meaning or goes; new fields do not raise it.
pub const SCHEMA: u32 = 1;

/// The contract as a JSON schema (draft 2020-12).
pub const SCHEMA_TEXT: &str = include_str!("../../schema/report.schema.json");

#[derive(Serialize)]
struct Report<'a> {
    schema: u32,
    kenzan: &'static str,
    seed: u64,
    states: usize,
    precision: Option<u32>,
    summary: Counts,
    documents: &'a [DocumentReport],
    micros: u64,
}

/// The run as JSON, indented, ending in a line break. Numbers that are not finite become `null`.
///
/// # Errors
/// [`ReportError::Json`]
pub fn render(run: &Run, options: Options) -> Result<String, ReportError> {
    let report = Report {
        schema: SCHEMA,
        kenzan: env!("CARGO_PKG_VERSION"),
        seed: run.seed,
        states: run.states,
        precision: run.precision,
        summary: Counts::of(run.documents.iter().flat_map(|d| &d.equations)),
        documents: &run.documents,
        micros: run.micros,
    };
    let mut text = if options.times {
        serde_json::to_string_pretty(&report)?
    } else {
        serde_json::to_string_pretty(&without_times(serde_json::to_value(&report)?))?
    };
    text.push('\n');
    Ok(text)
}

/// Drops every `micros`, at the top and of each equation: nothing else is named so.
fn without_times(mut report: Value) -> Value {
    let drop = |value: &mut Value| value.as_object_mut().map(|object| object.remove("micros"));
    drop(&mut report);
    let documents = report.get_mut("documents").and_then(Value::as_array_mut).into_iter().flatten();
    for document in documents {
        document.get_mut("equations").and_then(Value::as_array_mut).into_iter().flatten().for_each(|e| {
            drop(e);
        });
    }
    report
}
