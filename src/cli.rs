//! The command line: arguments, progress, exit codes.

mod explain;
mod init;
mod lsp;
mod options;
mod scene;
mod shell;
mod speed;
mod stability;
mod verify;
mod watch;

use std::io::{IsTerminal, Write};
use std::process::ExitCode;

use clap::{Parser, Subcommand};
use indicatif::{ProgressBar, ProgressStyle};

use options::precision;

/// Exit code: everything is as expected.
const AS_EXPECTED: u8 = 0;
/// Exit code: some equation is not as expected.
const NOT_AS_EXPECTED: u8 = 1;
/// Exit code: the input could not be read, or the arguments are wrong.
const UNUSABLE: u8 = 2;

/// What stands at the end of the help: what scripts need to know.
const EXIT_CODES: &str = "Exit codes: 0 every equation is as expected; 1 some equation is not, or an annotation is \
faulty; 2 a file could not be read or written, or the arguments are wrong.";

/// A doctest for the equations of lecture notes.
#[derive(Debug, Parser)]
#[command(name = "kenzan", version, about, after_help = EXIT_CODES)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Judge every equation of the notes and write the report.
    #[command(after_help = EXIT_CODES)]
    Verify(verify::Arguments),
    /// Verify again whenever a file is saved, only what changed, and show the report in the browser.
    Watch(watch::Arguments),
    /// The language server, for editors: speaks the Language Server Protocol on standard input and output.
    Lsp(lsp::Arguments),
    /// Show how one equation is read and what it is at three states.
    Explain(explain::Arguments),
    /// Write a scaffold of annotations for notes that have none.
    Init(init::Init),
    /// List the symbols of notes, and what is odd about them.
    Symbols(init::Symbols),
    /// Search where the formulas of the notes lose their digits, and forms that do not.
    Stability(stability::Arguments),
    /// Measure what accuracy costs in each scene, model by model.
    Speed(speed::Arguments),
    /// Move a body: the values of a quantity by the cheapest model that meets an error, and why it is that one.
    Scene(scene::Arguments),
    /// Print the JSON schema of report.json.
    Schema,
    /// Print the completions for a shell.
    Completions(shell::Completions),
    /// Print the manual page.
    Man(shell::Man),
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
    let done = |outcome: miette::Result<()>| outcome.map(|()| AS_EXPECTED);
    let outcome = match arguments.command {
        Command::Verify(arguments) => verify::run(&arguments),
        Command::Watch(arguments) => watch::run(&arguments),
        Command::Lsp(arguments) => done(lsp::run(&arguments)),
        Command::Explain(arguments) => explain::run(&arguments),
        Command::Stability(arguments) => in_pool(arguments.jobs, || done(stability::run(&arguments))),
        Command::Speed(arguments) => in_pool(None, || done(speed::run(&arguments))),
        Command::Init(arguments) => in_pool(None, || done(init::init(&arguments))),
        Command::Symbols(arguments) => in_pool(None, || done(init::symbols(&arguments))),
        Command::Scene(arguments) => scene::run(&arguments),
        Command::Schema => done(schema()),
        Command::Completions(arguments) => done(shell::completions(&arguments)),
        Command::Man(arguments) => done(shell::man(&arguments)),
    };
    match outcome {
        Ok(code) => ExitCode::from(code),
        Err(error) => {
            eprintln!("{error:?}");
            ExitCode::from(UNUSABLE)
        }
    }
}

fn schema() -> miette::Result<()> {
    print_text(&crate::report::json::schema()?);
    Ok(())
}

/// Runs with the number of threads that is asked for. A deep formula needs more stack than threads usually have.
fn in_pool(jobs: Option<u16>, work: impl FnOnce() -> miette::Result<u8> + Send) -> miette::Result<u8> {
    let builder = rayon::ThreadPoolBuilder::new().num_threads(jobs.map_or(0, usize::from)).stack_size(32 << 20);
    let pool = builder.build().map_err(|e| miette::miette!("no threads could be started: {e}"))?;
    pool.install(work)
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
