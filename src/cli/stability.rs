//! `kenzan stability`: where the formulas of notes lose their digits.

use std::path::PathBuf;

use super::options::{self, Words};
use crate::report;
use crate::stability::{Request, stability};
use crate::verify;

/// The arguments of `kenzan stability`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The notes in Markdown; without any, the bundled ones.
    paths: Vec<PathBuf>,
    /// The directory of stability.html and stability.json.
    #[arg(long, default_value = "out")]
    out: PathBuf,
    /// Survey only the equation of this label, and its hard cases; may be repeated.
    #[arg(long, value_name = "LABEL")]
    only: Vec<String>,
    /// The seed of the states.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Measure no times: the same notes and the same seed then give the same bytes.
    #[arg(long)]
    no_times: bool,
    /// The number of threads; one for each core otherwise.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=256))]
    pub jobs: Option<u16>,
    #[command(flatten)]
    words: Words,
}

/// Surveys, writes the page and the data, prints a summary.
pub fn run(arguments: &Arguments) -> miette::Result<()> {
    let language = arguments.words.language(&options::config()?)?;
    let documents = verify::documents(&arguments.paths)?;
    for label in &arguments.only {
        if !documents.iter().any(|d| d.equations().any(|e| e.label == *label)) {
            return Err(miette::miette!(help = "labels are as printed", "there is no equation {label}"));
        }
    }
    let bar = super::progress(documents.iter().map(|d| d.equations().count()).sum());
    let times = !arguments.no_times;
    let request = Request { seed: arguments.seed, only: arguments.only.clone(), times };
    let found = stability(&documents, &request, &|| bar.inc(1))?;
    bar.finish_and_clear();
    let options = report::Options { times, language };
    let written = report::stability::write(&found, &arguments.out, options)?;
    let place = report::words::where_to_begin(language, &written.html);
    super::print_text(&format!("{}\n{place}\n", report::stability::summary(&found, options)));
    Ok(())
}
