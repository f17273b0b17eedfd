//! The command `kenzan verify`.

use std::collections::HashSet;
use std::io::IsTerminal;
use std::path::{Path, PathBuf};
use std::time::Instant;

use rayon::prelude::*;

use crate::document::{Document, Problem};
use crate::report::{self, Run, terminal};
use crate::verify::{self, Request, Verified};

use super::options::{self, Diagnosis, Format, Notes, Sampling, Words};
use super::{AS_EXPECTED, NOT_AS_EXPECTED, in_pool, print_text, progress};

/// The most problems that are shown in the source for each document.
const MOST_SHOWN: usize = 20;

/// The arguments of `kenzan verify`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    #[command(flatten)]
    notes: Notes,
    /// The directory of report.html and report.json [default: out].
    #[arg(long)]
    out: Option<PathBuf>,
    /// Write no report, and pass over files without an equation instead of refusing them: for hooks, which are given all
    /// files.
    #[arg(long)]
    hook: bool,
    /// What to print: a summary, or the report as JSON, JUnit's XML, SARIF, or GitHub's commands [default: human].
    #[arg(long, value_enum)]
    format: Option<Format>,
    /// Leave times out of the report: the same notes and the same seed then give the same bytes.
    #[arg(long)]
    no_times: bool,
    #[command(flatten)]
    sampling: Sampling,
    /// Judge only the equation of this label; may be repeated.
    #[arg(long, value_name = "LABEL")]
    only: Vec<String>,
    #[command(flatten)]
    diagnosis: Diagnosis,
    #[command(flatten)]
    words: Words,
}

/// What is printed, and what the reports leave out.
#[derive(Clone, Copy)]
struct Printed {
    format: Format,
    options: report::Options,
}

/// Runs `kenzan verify`.
pub fn run(arguments: &Arguments) -> miette::Result<u8> {
    // Of the bundled notes no course's kenzan.toml says anything.
    let config = if arguments.notes.bundled { crate::config::Config::default() } else { options::config()? };
    let documents = arguments.notes.read(&config, arguments.hook)?;
    let request = arguments.diagnosis.request(arguments.sampling.options(&config)?, arguments.only.clone(), &config);
    let format = arguments.format.map_or_else(|| config.format(options::word), |f| Ok(Some(f)))?;
    let times = !arguments.no_times && config.times.unwrap_or(true);
    let printed = Printed {
        format: format.unwrap_or(Format::Human),
        options: report::Options { times, language: arguments.words.language(&config)? },
    };
    let out = arguments.out.clone().or_else(|| config.out()).unwrap_or_else(|| "out".into());
    let out = (!arguments.hook).then_some(out.as_path());
    in_pool(arguments.sampling.jobs(&config)?, || verify_documents(documents, &request, out, printed))
}

fn verify_documents(
    documents: Vec<Document>,
    request: &Request,
    out: Option<&Path>,
    printed: Printed,
) -> miette::Result<u8> {
    let begin = Instant::now();
    let total: usize = documents.iter().map(|d| d.equations().count()).sum();
    let bar = progress(total);
    let verified: Vec<Verified> =
        documents.into_par_iter().map(|document| verify::verify(document, request, &|| bar.inc(1))).collect();
    bar.finish_and_clear();
    check_labels(request, &verified)?;
    for v in &verified {
        show_problems(v, printed.options.language);
    }
    let run = verify::run(&verified, request, begin);
    let written = out.map(|out| report::write(&run, out, printed.options)).transpose()?;
    print(&run, printed, written.as_ref())?;
    Ok(if verify::all_as_expected(&verified) { AS_EXPECTED } else { NOT_AS_EXPECTED })
}

/// Shows what is wrong with the document, and what stands in the way of verdicts that are not expected, in the source.
fn show_problems(verified: &Verified, language: report::Language) {
    let surprising = verified.report.equations.iter().filter(|e| !e.as_expected);
    let mut problems: Vec<&Problem> = verified.problems.iter().collect();
    let told: HashSet<(usize, usize)> = problems.iter().map(|p| (p.span.start, p.span.end)).collect();
    for problem in surprising.flat_map(|e| e.problems()) {
        // A premise that does not exist has been told already.
        if !told.contains(&(problem.span.start, problem.span.end)) {
            problems.push(problem);
        }
    }
    for problem in problems.iter().take(MOST_SHOWN) {
        eprintln!("{:?}", language.problem(problem).to_miette(&verified.document));
    }
    if problems.len() > MOST_SHOWN {
        eprintln!("{}\n", report::words::more_problems(language, problems.len() - MOST_SHOWN));
    }
}

/// A label that is asked for and is nowhere is an error: silence would look like success.
fn check_labels(request: &Request, verified: &[Verified]) -> miette::Result<()> {
    for label in &request.only {
        if !verified.iter().any(|v| v.report.equations.iter().any(|e| e.label == *label || e.numbers.contains(label))) {
            return Err(miette::miette!(
                help = "labels are as printed; see the report for those of displays without a number",
                "there is no equation {label}"
            ));
        }
    }
    Ok(())
}

fn print(run: &Run, printed: Printed, written: Option<&report::Written>) -> miette::Result<()> {
    let text = match printed.format {
        Format::Human => {
            let colour = std::io::stdout().is_terminal() && std::env::var_os("NO_COLOR").is_none();
            let summary = terminal::render(run, colour, printed.options);
            let place = |w: &report::Written| report::words::where_to_begin(printed.options.language, &w.html);
            written.map_or(summary.clone(), |written| format!("{summary}\n{}\n", place(written)))
        }
        Format::Json => report::json::render(run, printed.options)?,
        Format::Junit => report::annotations::junit(run, printed.options.times)?,
        Format::Sarif => report::annotations::sarif(run)?,
        Format::Github => report::annotations::github(run),
    };
    print_text(&text);
    Ok(())
}
