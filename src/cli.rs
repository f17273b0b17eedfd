//! The command line: arguments, progress, exit codes.

mod init;
mod scene;

use std::collections::HashSet;
use std::io::{IsTerminal, Write};
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::{Duration, Instant};

use clap::{Parser, Subcommand, ValueEnum};
use indicatif::{ProgressBar, ProgressStyle};
use rayon::prelude::*;

use crate::check::Options;
use crate::document::Problem;
use crate::explain;
use crate::report::{self, Run, terminal};
use crate::verify::{self, Request, Verified};

mod speed;
mod stability;

/// Exit code: everything is as expected.
const AS_EXPECTED: u8 = 0;
/// Exit code: some equation is not as expected.
const NOT_AS_EXPECTED: u8 = 1;
/// Exit code: the input could not be read, or the arguments are wrong.
const UNUSABLE: u8 = 2;

/// The most problems that are shown in the source for each document.
const MOST_SHOWN: usize = 20;

/// A doctest for the equations of lecture notes.
#[derive(Debug, Parser)]
#[command(name = "kenzan", version, about)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Judge every equation of the notes and write the report.
    Verify {
        /// The notes in Markdown; without any, the bundled ones.
        paths: Vec<PathBuf>,
        /// The directory of report.html and report.json.
        #[arg(long, default_value = "out")]
        out: PathBuf,
        /// What to print: a summary, or the report as JSON.
        #[arg(long, value_enum, default_value_t = Format::Human)]
        format: Format,
        /// Leave times out of the report: the same notes and the same seed then give the same bytes.
        #[arg(long)]
        no_times: bool,
        #[command(flatten)]
        sampling: Sampling,
        /// Judge only the equation of this label; may be repeated.
        #[arg(long, value_name = "LABEL")]
        only: Vec<String>,
        /// Try the mutants of each equation that holds: does its check notice a wrong sign, index, factor?
        #[arg(long)]
        mutants: bool,
        /// Search what was probably meant, for each equation that fails.
        #[arg(long)]
        suggest: bool,
        /// All that costs more than a verdict: --mutants and --suggest.
        #[arg(long)]
        deep: bool,
        /// The language of the report's pages and of the summary; the locale's otherwise.
        #[arg(long, value_enum)]
        lang: Option<report::Language>,
    },
    /// Write a scaffold of annotations for notes that have none.
    Init(init::Init),
    /// List the symbols of notes, and what is odd about them.
    Symbols(init::Symbols),
    /// Search where the formulas of the notes lose their digits, and forms that do not.
    Stability(stability::Arguments),
    /// Measure what accuracy costs in each scene, model by model.
    Speed(speed::Arguments),
    /// Show how one equation is read and what it is at three states.
    Explain {
        /// The notes.
        path: PathBuf,
        /// The equation's label.
        label: String,
        #[command(flatten)]
        sampling: Sampling,
    },
    /// Move a body: the values of a quantity by the cheapest model that meets an error, and why it is that one.
    Scene(scene::Arguments),
}

/// How states are drawn and decided.
#[derive(Debug, clap::Args)]
struct Sampling {
    /// The seed of the random states.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// The number of states for each link of an equation.
    #[arg(long, default_value_t = 64, value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    states: u32,
    /// Decide in so many bits (needs the feature `rug`); otherwise in double-double.
    #[arg(long, value_name = "BITS", value_parser = precision)]
    precision: Option<u32>,
    /// The time that an equation may take; then it is undecided. Its correction, its mutants and the search for what was
    /// meant have as much each.
    #[arg(long, value_name = "SECONDS", default_value_t = 10, value_parser = clap::value_parser!(u32).range(1..=86_400))]
    budget: u32,
    /// The number of threads; one for each core otherwise.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=256))]
    jobs: Option<u16>,
}

/// What `verify` prints.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    /// A summary.
    Human,
    /// The report as JSON.
    Json,
    /// JUnit's XML: a test for each equation.
    Junit,
    /// SARIF: the equations that are not as expected, and known misprints as notes.
    Sarif,
    /// GitHub's workflow commands, which annotate the lines of the notes.
    Github,
}

/// What is printed, and what the reports leave out.
#[derive(Clone, Copy)]
struct Printed {
    format: Format,
    options: report::Options,
}

/// Reads a precision; without the feature `rug` there is none to choose.
fn precision(text: &str) -> Result<u32, String> {
    let bits: u32 = text.parse().map_err(|_| format!("expected a number of bits, found `{text}`"))?;
    if !cfg!(feature = "rug") {
        return Err("this build has no arbitrary precision; build it with `cargo run --release --features rug -- verify --precision 256` (needs a C compiler, make and m4)".into());
    }
    if (64..=100_000).contains(&bits) {
        Ok(bits)
    } else {
        Err("the precision must be between 64 and 100000 bits".into())
    }
}

impl Sampling {
    fn options(&self) -> Options {
        let (seed, states, precision) = (self.seed, self.states as usize, self.precision);
        let budget = Some(Duration::from_secs(self.budget.into()));
        Options { seed, states, precision, budget, ..Options::default() }
    }
}

/// Runs the command line.
pub fn main() -> ExitCode {
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(error) => {
            let code = if error.use_stderr() { UNUSABLE } else { AS_EXPECTED };
            // Nothing can be done where even the message cannot be written.
            let _ = error.print();
            return ExitCode::from(code);
        }
    };
    let outcome = match arguments.command {
        Command::Verify { paths, out, format, no_times, sampling, only, mutants, suggest, deep, lang } => {
            let (mutants, suggest) = (mutants || deep, suggest || deep);
            let request = Request { paths, options: sampling.options(), only, mutants, suggest };
            let printed = Printed {
                format,
                options: report::Options {
                    times: !no_times,
                    language: lang.unwrap_or_else(report::Language::of_locale),
                },
            };
            in_pool(sampling.jobs, || verify_command(&request, &out, printed))
        }
        Command::Init(arguments) => in_pool(None, || init::init(&arguments).map(|()| AS_EXPECTED)),
        Command::Symbols(arguments) => in_pool(None, || init::symbols(&arguments).map(|()| AS_EXPECTED)),
        Command::Stability(arguments) => in_pool(arguments.jobs, || stability::run(&arguments).map(|()| AS_EXPECTED)),
        Command::Speed(arguments) => in_pool(None, || speed::run(&arguments).map(|()| AS_EXPECTED)),
        Command::Explain { path, label, sampling } => {
            in_pool(sampling.jobs, || explain_command(&path, &label, &sampling))
        }
        Command::Scene(arguments) => scene::run(&arguments),
    };
    match outcome {
        Ok(code) => ExitCode::from(code),
        Err(error) => {
            eprintln!("{error:?}");
            ExitCode::from(UNUSABLE)
        }
    }
}

/// Runs with the number of threads that is asked for. A deep formula needs more stack than threads usually have.
fn in_pool(jobs: Option<u16>, work: impl FnOnce() -> miette::Result<u8> + Send) -> miette::Result<u8> {
    let builder = rayon::ThreadPoolBuilder::new().num_threads(jobs.map_or(0, usize::from)).stack_size(32 << 20);
    let pool = builder.build().map_err(|e| miette::miette!("no threads could be started: {e}"))?;
    pool.install(work)
}

fn verify_command(request: &Request, out: &std::path::Path, printed: Printed) -> miette::Result<u8> {
    let begin = Instant::now();
    let documents = verify::documents(&request.paths)?;
    let total: usize = documents.iter().map(|d| d.equations().count()).sum();
    let bar = progress(total);
    let verified: Vec<Verified> =
        documents.into_par_iter().map(|document| verify::verify(document, request, &|| bar.inc(1))).collect();
    bar.finish_and_clear();
    check_labels(request, &verified)?;
    for v in &verified {
        show_problems(v);
    }
    let run = verify::run(&verified, request, begin);
    let written = report::write(&run, out, printed.options)?;
    print(&run, printed, &written)?;
    Ok(if verify::all_as_expected(&verified) { AS_EXPECTED } else { NOT_AS_EXPECTED })
}

/// Shows what is wrong with the document, and what stands in the way of verdicts that are not expected, in the source.
fn show_problems(verified: &Verified) {
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
        eprintln!("{:?}", problem.to_miette(&verified.document));
    }
    if problems.len() > MOST_SHOWN {
        eprintln!("... and {} more: each is listed in the summary\n", problems.len() - MOST_SHOWN);
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

fn print(run: &Run, printed: Printed, written: &report::Written) -> miette::Result<()> {
    let text = match printed.format {
        Format::Human => {
            let colour = std::io::stdout().is_terminal() && std::env::var_os("NO_COLOR").is_none();
            let summary = terminal::render(run, colour, printed.options);
            format!("{summary}\n{}\n", report::words::where_to_begin(printed.options.language, &written.html))
        }
        Format::Json => report::json::render(run, printed.options)?,
        Format::Junit => report::annotations::junit(run, printed.options.times)?,
        Format::Sarif => report::annotations::sarif(run)?,
        Format::Github => report::annotations::github(run),
    };
    print_text(&text);
    Ok(())
}

/// Prints; a closed pipe is no failure.
fn print_text(text: &str) {
    let _ = std::io::stdout().write_all(text.as_bytes());
}

/// A progress bar, on a terminal only.
fn progress(total: usize) -> ProgressBar {
    if !std::io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::new(total as u64);
    if let Ok(style) = ProgressStyle::with_template("{bar:40} {pos}/{len} equations") {
        bar.set_style(style);
    }
    bar
}

fn explain_command(path: &std::path::Path, label: &str, sampling: &Sampling) -> miette::Result<u8> {
    let document = crate::document::read(path)?;
    match explain::explain(&document, label, &sampling.options()) {
        Some(text) => {
            let _ = std::io::stdout().write_all(text.as_bytes());
            Ok(AS_EXPECTED)
        }
        None => Err(miette::miette!(
            help = "labels are as printed; a display without a number has the label before it with +1, +2 ...",
            "there is no equation {label} in {}",
            path.display()
        )),
    }
}
