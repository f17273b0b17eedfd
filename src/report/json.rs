//! `report.json`, the contract for other tools.

use super::{Counts, Options, ReportError, Run};
use crate::check::verdict::DocumentReport;
use schemars::generate::SchemaSettings;
use schemars::transform::RecursiveTransform;
use schemars::{JsonSchema, Schema};
use serde::Serialize;
use serde_json::Value;

/// The version of the contract. It rises when a field changes its meaning or goes; new fields do not raise it.
pub const SCHEMA: u32 = 1;

/// The report of a run of Kenzan: what became of each equation of some notes.
#[derive(Serialize, JsonSchema)]
struct Report<'a> {
    /// The version of this contract: 1.
    schema: u32,
    /// The version of Kenzan.
    kenzan: &'static str,
    /// The seed of the random states.
    seed: u64,
    /// The states at which each link was evaluated, where it has no reason for another number.
    states: usize,
    /// The precision in bits that was asked for; null for double-double.
    precision: Option<u32>,
    /// The counts over all documents.
    summary: Counts,
    /// The documents in the order in which they were given.
    documents: &'a [DocumentReport],
    /// The time that the run took, in microseconds; left out with --no-times.
    micros: u64,
}

/// The contract as a JSON schema (draft 2020-12), indented, ending in a line break: `schema/report.schema.json`.
///
/// # Errors
/// [`ReportError::Json`]
pub fn schema() -> Result<String, ReportError> {
    let settings = SchemaSettings::draft2020_12().for_serialize();
    let settings = settings.with_transform(RecursiveTransform(as_rendered));
    let mut text = serde_json::to_string_pretty(&settings.into_generator().into_root_schema_for::<Report>())?;
    text.push('\n');
    Ok(text)
}

/// What [`render`] does to the data: times may be left out, and numbers that are not finite are null.
fn as_rendered(schema: &mut Schema) {
    if let Some(required) = schema.get_mut("required").and_then(Value::as_array_mut) {
        required.retain(|key| key != "micros");
    }
    if schema.get("type").is_some_and(|kind| kind == "number") {
        schema.insert("type".into(), serde_json::json!(["number", "null"]));
    }
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
