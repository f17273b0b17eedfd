//! Telling: a finished run as self-contained HTML pages, as JSON for other tools, and as text for the terminal.
//!
//! The same run gives the same bytes, times apart: [`Options::times`] leaves those out.

pub mod annotations;
pub mod charts;
mod counts;
mod dumbbells;
mod gone;
mod graph;
pub mod html;
pub mod json;
mod layers;
mod math;
mod mathml;
mod names;
pub mod speed;
pub mod stability;
mod svg;
pub mod terminal;
mod text;
mod view;
mod view_certificate;
mod view_charts;
mod view_diagnosis;
mod view_dimensions;
mod view_equation;
mod view_errata;
mod view_inferred;
mod view_map;
mod view_overview;
pub mod words;
mod write;

pub use charts::Chart;
pub use counts::Counts;
pub use words::Language;

use crate::check::verdict::DocumentReport;
use std::path::{Path, PathBuf};

/// Everything that a report is made from.
#[derive(Clone, Debug)]
pub struct Run {
    /// The seed of the sampled states.
    pub seed: u64,
    /// The states at which each equation was evaluated, where it has no reason for another number.
    pub states: usize,
    /// The precision in bits that was asked for; `None` for the default.
    pub precision: Option<u32>,
    /// The documents in the order in which they were given.
    pub documents: Vec<DocumentReport>,
    /// What draws the charts, in the language of the report; none where there are no charts.
    pub charts: Option<Draw>,
    /// The time that the whole run took, in microseconds.
    pub micros: u64,
}

/// Draws charts in a language.
pub type Draw = fn(Language) -> Result<Vec<Chart>, charts::ChartError>;

/// What a report may leave out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// Whether times are printed. Without them the same seed gives the same bytes.
    pub times: bool,
    /// The language of the pages and of the summary for the terminal.
    pub language: Language,
}

/// With times, in English: what the user's language is, the command line decides.
impl Default for Options {
    fn default() -> Self {
        Options { times: true, language: Language::English }
    }
}

/// The files that were written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Written {
    /// The HTML page at which to begin.
    pub html: PathBuf,
    /// The JSON file.
    pub json: PathBuf,
}

/// Why a report could not be made.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
pub enum ReportError {
    /// The directory does not exist and could not be created.
    #[error("cannot create the report's directory `{}`", path.display())]
    #[diagnostic(help("name another directory, or remove the file that stands in its place"))]
    Directory {
        /// The directory.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// A file could not be written; what stood there before is untouched.
    #[error("cannot write `{}`", path.display())]
    #[diagnostic(help("is the disk full, or the directory not writable? An older report there is left as it was"))]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// A template does not fit the data: a defect of Kenzan.
    #[error("the report's template failed")]
    #[diagnostic(help("this is a defect of Kenzan: please report it with the notes that caused it"))]
    Template(#[from] tera::Error),
    /// The data could not be written as XML: a defect of Kenzan.
    #[error("the report could not be written as JUnit's XML")]
    #[diagnostic(help("this is a defect of Kenzan: please report it with the notes that caused it"))]
    Junit(#[from] quick_junit::SerializeError),
    /// The data could not be written as JSON: a defect of Kenzan.
    #[error("the report could not be written as JSON")]
    #[diagnostic(help("this is a defect of Kenzan: please report it with the notes that caused it"))]
    Json(#[from] serde_json::Error),
}

/// Writes the pages and `report.json` into the directory `out`, which is created if need be. `report.html` is where to
/// begin.
///
/// Whenever the process ends, each of them is whole: the new one or the one before.
///
/// # Errors
/// [`ReportError`]
pub fn write(run: &Run, out: &Path, options: Options) -> Result<Written, ReportError> {
    let (pages, json) = (html::pages(run, options)?, json::render(run, options)?);
    write::report(out, &pages, &json)
}

#[cfg(test)]
mod fixture;
#[cfg(test)]
mod tests;
