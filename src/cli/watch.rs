//! The command `kenzan watch`.

use crate::config::Config;
use crate::report;
use crate::watch::{self, Settings};

use super::options::{self, Diagnosis, Notes, Sampling, Words};
use super::{AS_EXPECTED, in_pool, print_text};

/// The arguments of `kenzan watch`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    #[command(flatten)]
    notes: Notes,
    /// The port of the report on this computer; a free one otherwise.
    #[arg(long, default_value_t = 0)]
    port: u16,
    /// Open the report in the browser.
    #[arg(long)]
    open: bool,
    #[command(flatten)]
    sampling: Sampling,
    #[command(flatten)]
    diagnosis: Diagnosis,
    #[command(flatten)]
    words: Words,
}

/// Watches until the process is ended.
pub fn run(arguments: &Arguments) -> miette::Result<u8> {
    let config = options::config()?;
    if arguments.notes.bundled || arguments.notes.paths(&config)?.is_empty() {
        return Err(miette::miette!(
            help = "name a file or a folder: kenzan watch notes.md; or write a kenzan.toml",
            "there is nothing to watch"
        ));
    }
    let jobs = arguments.sampling.jobs(&config)?;
    let say = |line: &str| print_text(&format!("{line}\n"));
    in_pool(jobs, || watch::watch(&|| settings(arguments), arguments.port, arguments.open, &say).map(|()| AS_EXPECTED))
}

fn settings(arguments: &Arguments) -> miette::Result<Settings> {
    let config: Config = options::config()?;
    let sampling = arguments.sampling.options(&config)?;
    Ok(Settings {
        paths: arguments.notes.paths(&config)?,
        excluding: if arguments.notes.paths.is_empty() { config.clone() } else { Config::default() },
        request: arguments.diagnosis.request(sampling, Vec::new(), &config),
        options: report::Options { times: true, language: arguments.words.language(&config)? },
        config: (!config.path.as_os_str().is_empty()).then_some(config.path),
    })
}
