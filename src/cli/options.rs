//! Options that several commands share, and what `kenzan.toml` says of them.

use std::path::PathBuf;
use std::time::Duration;

use clap::ValueEnum;

use crate::check::Options;
use crate::config::{Config, ConfigError};
use crate::document::Document;
use crate::files;
use crate::report::Language;
use crate::verify::{self, Request};

/// Which notes.
#[derive(Clone, Debug, Default, clap::Args)]
pub struct Notes {
    /// The notes, or folders of them; without any, those that kenzan.toml names, or else the bundled ones.
    pub paths: Vec<PathBuf>,
    /// The notes that Kenzan brings along, wherever you are.
    #[arg(long, conflicts_with = "paths")]
    pub bundled: bool,
}

/// How states are drawn and decided.
#[derive(Clone, Debug, Default, clap::Args)]
pub struct Sampling {
    /// The seed of the random states [default: 1].
    #[arg(long)]
    seed: Option<u64>,
    /// The number of states for each link of an equation [default: 64].
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    states: Option<u32>,
    /// Decide in so many bits (needs the feature `rug`); otherwise in double-double.
    #[arg(long, value_name = "BITS", value_parser = precision)]
    precision: Option<u32>,
    /// The time that an equation may take; then it is undecided. Its correction, its mutants and the search for what was
    /// meant have as much each [default: 10].
    #[arg(long, value_name = "SECONDS", value_parser = clap::value_parser!(u32).range(1..=86_400))]
    budget: Option<u32>,
    /// The number of threads; one for each core otherwise.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=256))]
    jobs: Option<u16>,
}

/// What is asked for beside verdicts. In kenzan.toml, too; `--deep=false` then has the last word.
#[derive(Clone, Debug, Default, clap::Args)]
pub struct Diagnosis {
    /// Try the mutants of each equation that holds: does its check notice a wrong sign, index, factor?
    #[arg(long, num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL")]
    mutants: Option<bool>,
    /// Search what was probably meant, for each equation that fails.
    #[arg(long, num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL")]
    suggest: Option<bool>,
    /// All that costs more than a verdict: --mutants and --suggest.
    #[arg(long, num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL")]
    deep: Option<bool>,
}

/// The language.
#[derive(Clone, Copy, Debug, Default, clap::Args)]
pub struct Words {
    /// The language of the report's pages and of the summary; the locale's otherwise.
    #[arg(long, value_enum)]
    lang: Option<Language>,
}

impl Words {
    /// That of the command line, of kenzan.toml, or of the locale.
    pub fn language(self, config: &Config) -> Result<Language, ConfigError> {
        let told = self.lang.map_or_else(|| config.lang(word), |lang| Ok(Some(lang)))?;
        Ok(told.unwrap_or_else(Language::of_locale))
    }
}

/// What `verify` prints.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Format {
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

/// The `kenzan.toml` of the current folder or above; what says nothing where there is none.
pub fn config() -> Result<Config, ConfigError> {
    let folder = std::env::current_dir().unwrap_or_default();
    let mut config = Config::find(&folder)?.unwrap_or_default();
    // Messages and reports name files as seen from here.
    if let Ok(near) = config.path.strip_prefix(&folder) {
        config.path = near.to_owned();
    }
    Ok(config)
}

impl Notes {
    /// The paths that are meant: those named, or those of kenzan.toml; none for the bundled notes.
    pub fn paths(&self, config: &Config) -> Result<Vec<PathBuf>, ConfigError> {
        if !self.paths.is_empty() || config.path.as_os_str().is_empty() {
            return Ok(self.paths.clone());
        }
        let folder = config.folder();
        let folder = if folder.as_os_str().is_empty() { PathBuf::from(".") } else { folder.to_owned() };
        Ok(config.files()?.unwrap_or_else(|| vec![folder]))
    }

    /// The notes themselves; where `lenient`, without those that hold no equation.
    pub fn read(&self, config: &Config, lenient: bool) -> miette::Result<Vec<Document>> {
        if self.bundled {
            return Ok(verify::bundled());
        }
        let mut paths = self.paths(config)?;
        if lenient {
            paths = files::with_sidecars(&paths);
        }
        let read = if lenient && !paths.is_empty() { files::read_any(&paths) } else { verify::documents(&paths) };
        let mut documents = read?;
        if paths.is_empty() {
            eprintln!("no notes are named, and there is no kenzan.toml here or above: these are the bundled notes");
        }
        // Of the files that a hook is given nobody has chosen any.
        if self.paths.is_empty() || lenient {
            documents.retain(|document| !config.excludes(&document.path));
        }
        Ok(documents)
    }
}

impl Sampling {
    /// The options, those of the command line first.
    pub fn options(&self, config: &Config) -> Result<Options, ConfigError> {
        let default = Options::default();
        let states = self.states.map_or_else(|| config.states(), |n| Ok(Some(n)))?;
        let budget = self.budget.map_or_else(|| config.budget(), |n| Ok(Some(n)))?;
        let precision = self.precision.map_or_else(|| config.precision(precision), |bits| Ok(Some(bits)))?;
        Ok(Options {
            seed: self.seed.or(config.seed).unwrap_or(default.seed),
            states: states.map_or(default.states, |n| n as usize),
            precision,
            budget: Some(Duration::from_secs(budget.unwrap_or(10).into())),
            ..default
        })
    }

    /// The number of threads, if one is asked for.
    pub fn jobs(&self, config: &Config) -> Result<Option<u16>, ConfigError> {
        self.jobs.map_or_else(|| config.jobs(), |n| Ok(Some(n)))
    }
}

impl Diagnosis {
    /// The request, with the options that are asked for. A word on the command line is stronger than any in kenzan.toml.
    pub fn request(&self, options: Options, only: Vec<String>, config: &Config) -> Request {
        let chosen =
            |own: Option<bool>, told: Option<bool>| own.or(self.deep).or(told).or(config.deep).unwrap_or(false);
        let (mutants, suggest) = (chosen(self.mutants, config.mutants), chosen(self.suggest, config.suggest));
        Request { paths: Vec::new(), options, only, mutants, suggest }
    }
}

/// A word that is one of those of an option.
pub fn word<T: ValueEnum>(text: &str) -> Result<T, String> {
    T::from_str(text, false).map_err(|_| {
        let words: Vec<String> =
            T::value_variants().iter().filter_map(|v| v.to_possible_value()).map(|v| v.get_name().to_owned()).collect();
        format!("expected one of {}, found `{text}`", words.join(", "))
    })
}

/// Reads a precision; without the feature `rug` there is none to choose.
pub fn precision(text: &str) -> Result<u32, String> {
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
