//! `kenzan stability`: where the formulas of notes lose their digits.

use std::path::PathBuf;

use crate::diagnose::stability::survey::Counts;
use crate::report::{self, stability::Stability};
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
}

/// Surveys, writes the page and the data, prints a summary.
pub fn run(arguments: &Arguments) -> miette::Result<()> {
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
    let written =
        report::stability::write(&found, &arguments.out, report::Options { times, ..report::Options::default() })?;
    super::print_text(&format!("{}\nreport: {}\n", summary(&found, times), written.html.display()));
    Ok(())
}

fn summary(found: &Stability, times: bool) -> String {
    let mut text = report::stability::table(&found.cases);
    let Counts { equations, formulas, at_random, losing, ill_conditioned, exact_numbers, unstable, mended, .. } =
        found.counts();
    text += &format!(
        "\n{formulas} formulas of {equations} equations: {losing} lose more than 10 bits somewhere in the declared \
         ranges ({at_random} at one of the random states)\n  {ill_conditioned} of them because the problem is \
         ill-conditioned; rewriting found for {exact_numbers} a form that loses at most 10 bits of exact numbers\n  \
         {unstable} by their own fault; rewriting mends {mended}\n",
    );
    if times {
        text += &format!("{:.1} s\n", found.micros as f64 / 1e6);
    }
    text
}
