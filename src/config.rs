//! `kenzan.toml` at the root of a course's repository: which files, which options.
//!
//! ```toml
//! files = ["lectures/*.md", "exercises/**/*.tex"]    # globs, from the folder of kenzan.toml; without it all notes there
//! exclude = ["lectures/draft-*"]
//! out = "report"
//! format = "github"
//! seed = 1
//! states = 64
//! budget = 10           # seconds for an equation
//! precision = 256       # bits (feature `rug`)
//! jobs = 2
//! mutants = true
//! suggest = true
//! deep = true           # both
//! times = false         # as --no-times
//! lang = "ja"
//! ```
//!
//! The command line has the last word. The file is looked for in the current folder and upwards, but not beyond the root
//! of the repository.

use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use miette::{Diagnostic, NamedSource};
use serde::Deserialize;
use thiserror::Error;
use toml::Spanned;

/// The file's name.
pub const NAME: &str = "kenzan.toml";

/// What a `kenzan.toml` says.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Config {
    /// The file itself.
    #[serde(skip)]
    pub path: PathBuf,
    /// Its text.
    #[serde(skip)]
    text: String,
    /// Globs of the files to verify.
    files: Option<Vec<Spanned<String>>>,
    /// Globs of files that are not meant.
    exclude: Option<Vec<Spanned<String>>>,
    out: Option<PathBuf>,
    format: Option<Spanned<String>>,
    /// The seed of the random states.
    pub seed: Option<u64>,
    states: Option<Spanned<u32>>,
    budget: Option<Spanned<u32>>,
    precision: Option<Spanned<u32>>,
    jobs: Option<Spanned<u16>>,
    /// Whether to try mutants.
    pub mutants: Option<bool>,
    /// Whether to search what was meant.
    pub suggest: Option<bool>,
    /// Both.
    pub deep: Option<bool>,
    /// Whether reports print times.
    pub times: Option<bool>,
    lang: Option<Spanned<String>>,
}

/// What is wrong with a `kenzan.toml`.
#[derive(Debug, Error, Diagnostic)]
pub enum ConfigError {
    /// The file is there and cannot be read.
    #[error("`{}` could not be read", path.display())]
    #[diagnostic(code(config::unreadable), help("check that you may read it, and that it is UTF-8"))]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// It is not TOML, or has a key that is not known.
    #[error("{message}")]
    #[diagnostic(code(config::toml), help("{help}"))]
    Wrong {
        /// What is wrong.
        message: String,
        /// What to do.
        help: String,
        /// The file.
        #[source_code]
        text: Arc<NamedSource<String>>,
        /// Where.
        #[label("here")]
        place: Range<usize>,
    },
}

impl Config {
    /// The `kenzan.toml` of a folder, or of the nearest one above it in the same repository.
    ///
    /// # Errors
    /// Where there is one and it cannot be used.
    pub fn find(folder: &Path) -> Result<Option<Config>, ConfigError> {
        for folder in folder.ancestors() {
            let path = folder.join(NAME);
            if path.is_file() {
                return Config::read(&path).map(Some);
            }
            if folder.join(".git").exists() {
                break;
            }
        }
        Ok(None)
    }

    /// Reads a `kenzan.toml`.
    ///
    /// # Errors
    /// Where it cannot be used.
    pub fn read(path: &Path) -> Result<Config, ConfigError> {
        let text = std::fs::read_to_string(path)
            .map_err(|source| ConfigError::Unreadable { path: path.to_owned(), source })?;
        Config::parse(path, text)
    }

    /// Reads the text of a `kenzan.toml` that stands at a path.
    ///
    /// # Errors
    /// Where it cannot be used.
    pub fn parse(path: &Path, text: String) -> Result<Config, ConfigError> {
        let config: Config = toml::from_str(&text).map_err(|error| ConfigError::Wrong {
            message: format!("{NAME}: {}", error.message().replace('\n', ", ")),
            help: "the keys are files, exclude, out, format, seed, states, budget, precision, jobs, mutants, suggest, \
                   deep, times, lang; for example: files = [\"lectures/*.md\"]"
                .into(),
            text: Arc::new(NamedSource::new(path.display().to_string(), text.clone())),
            place: error.span().unwrap_or(0..0),
        })?;
        let config = Config { path: path.to_owned(), text, ..config };
        config.globs(config.exclude.as_deref())?;
        config.globs(config.files.as_deref())?;
        Ok(config)
    }

    /// The folder that its paths are taken from.
    pub fn folder(&self) -> &Path {
        self.path.parent().unwrap_or(Path::new(""))
    }

    /// The number of states.
    ///
    /// # Errors
    /// Where it is none that can be.
    pub fn states(&self) -> Result<Option<u32>, ConfigError> {
        self.number(self.states.as_ref(), 1..=1_000_000, "states = 64")
    }

    /// The seconds for an equation.
    ///
    /// # Errors
    /// Where it is none that can be.
    pub fn budget(&self) -> Result<Option<u32>, ConfigError> {
        self.number(self.budget.as_ref(), 1..=86_400, "budget = 10, in seconds")
    }

    /// The bits to decide in, as `read` judges the number.
    ///
    /// # Errors
    /// Where it is none that can be.
    pub fn precision(&self, read: impl Fn(&str) -> Result<u32, String>) -> Result<Option<u32>, ConfigError> {
        self.word(self.precision.as_ref(), |n| read(&n.to_string()))
    }

    /// The number of threads.
    ///
    /// # Errors
    /// Where it is none that can be.
    pub fn jobs(&self) -> Result<Option<u16>, ConfigError> {
        self.number(self.jobs.as_ref(), 1..=256, "jobs = 2")
    }

    /// The format, as `read` understands the word.
    ///
    /// # Errors
    /// Where it is none that is known.
    pub fn format<T>(&self, read: impl Fn(&str) -> Result<T, String>) -> Result<Option<T>, ConfigError> {
        self.word(self.format.as_ref(), |text| read(text))
    }

    /// The language, as `read` understands the word.
    ///
    /// # Errors
    /// Where it is none that is known.
    pub fn lang<T>(&self, read: impl Fn(&str) -> Result<T, String>) -> Result<Option<T>, ConfigError> {
        self.word(self.lang.as_ref(), |text| read(text))
    }

    /// The folder of the report.
    pub fn out(&self) -> Option<PathBuf> {
        self.out.as_ref().map(|out| self.folder().join(out))
    }

    /// The files that are meant, sorted; `None` where it does not say.
    ///
    /// # Errors
    /// A glob that is none, or that no file matches.
    pub fn files(&self) -> Result<Option<Vec<PathBuf>>, ConfigError> {
        let Some(files) = &self.files else { return Ok(None) };
        let mut found = Vec::new();
        for (file, pattern) in files.iter().zip(self.globs(Some(files))?) {
            let matches = glob::glob(pattern.as_str()).map_err(|e| self.wrong(file.span(), e.msg, GLOBS))?;
            let matches: Vec<PathBuf> = matches.flatten().filter(|path| path.is_file()).collect();
            if matches.is_empty() {
                let message = format!("no file matches `{}`", file.get_ref());
                return Err(self.wrong(file.span(), &message, GLOBS));
            }
            found.extend(matches.into_iter().filter(|path| !self.excludes(path)));
        }
        found.sort();
        found.dedup();
        Ok(Some(found))
    }

    /// Whether a file is excluded, or a folder that it is in.
    pub fn excludes(&self, path: &Path) -> bool {
        let globs = self.globs(self.exclude.as_deref()).unwrap_or_default();
        let path = path.strip_prefix(".").unwrap_or(path);
        path.ancestors().any(|part| globs.iter().any(|glob| glob.matches_path(part)))
    }

    /// Globs from its folder, in which no letter of the folder's own name is one.
    fn globs(&self, globs: Option<&[Spanned<String>]>) -> Result<Vec<glob::Pattern>, ConfigError> {
        let folder = glob::Pattern::escape(&self.folder().to_string_lossy());
        let whole = |text: &str| if folder.is_empty() { text.to_owned() } else { format!("{folder}/{text}") };
        let whole = |text: &str| whole(text.trim_end_matches('/'));
        let read = |text: &Spanned<String>| {
            glob::Pattern::new(&whole(text.get_ref())).map_err(|e| self.wrong(text.span(), e.msg, GLOBS))
        };
        globs.unwrap_or_default().iter().map(read).collect()
    }

    fn number<N: Copy + PartialOrd + std::fmt::Display>(
        &self,
        number: Option<&Spanned<N>>,
        range: std::ops::RangeInclusive<N>,
        example: &str,
    ) -> Result<Option<N>, ConfigError> {
        let Some(number) = number else { return Ok(None) };
        let value = *number.get_ref();
        if range.contains(&value) {
            return Ok(Some(value));
        }
        let message = format!("expected a number from {} to {}, found {value}", range.start(), range.end());
        Err(self.wrong(number.span(), &message, &format!("for example: {example}")))
    }

    fn word<W, T>(
        &self,
        word: Option<&Spanned<W>>,
        read: impl Fn(&W) -> Result<T, String>,
    ) -> Result<Option<T>, ConfigError> {
        let Some(word) = word else { return Ok(None) };
        read(word.get_ref()).map(Some).map_err(|message| {
            self.wrong(word.span(), &message, "the options are those of the command line: kenzan help verify")
        })
    }

    fn wrong(&self, place: Range<usize>, message: &str, help: &str) -> ConfigError {
        ConfigError::Wrong {
            message: format!("{NAME}: {message}"),
            help: help.to_owned(),
            text: Arc::new(NamedSource::new(self.path.display().to_string(), self.text.clone())),
            place,
        }
    }
}

const GLOBS: &str =
    "globs are taken from the folder of kenzan.toml: `lectures/*.md`, or `**/*.md` for all folders below";

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(text: &str) -> Result<Config, ConfigError> {
        Config::parse(Path::new("kenzan.toml"), text.to_owned())
    }

    fn place(error: &ConfigError) -> (String, Range<usize>) {
        match error {
            ConfigError::Wrong { message, place, .. } => (message.clone(), place.clone()),
            ConfigError::Unreadable { .. } => panic!("{error}"),
        }
    }

    #[test]
    fn options_are_read() {
        let config =
            parse("files = [\"a/*.md\"]\nseed = 7\nstates = 8\nbudget = 3\njobs = 2\ndeep = true\nout = \"r\"\n")
                .unwrap();
        assert_eq!((config.seed, config.deep, config.mutants), (Some(7), Some(true), None));
        assert_eq!(
            (config.states().unwrap(), config.budget().unwrap(), config.jobs().unwrap()),
            (Some(8), Some(3), Some(2))
        );
        assert_eq!(config.out(), Some(PathBuf::from("r")));
    }

    #[test]
    fn what_is_wrong_is_told_with_its_place() {
        let text = "seed = 1\nstate = 8\n";
        let (message, span) = place(&parse(text).unwrap_err());
        assert!(message.contains("unknown field `state`") && message.contains("`states`"), "{message}");
        assert_eq!(&text[span], "state");
        let text = "seed = 1\nstates = 0\n";
        let (message, span) = place(&parse(text).unwrap().states().unwrap_err());
        assert_eq!(message, "kenzan.toml: expected a number from 1 to 1000000, found 0");
        assert_eq!(&text[span], "0");
        let text = "files = ['a/***.md']\n";
        let (_, span) = place(&parse(text).unwrap_err());
        assert_eq!(&text[span], "'a/***.md'");
        let text = "files = ['nowhere/*.md']\n";
        let (message, _) = place(&parse(text).unwrap().files().unwrap_err());
        assert_eq!(message, "kenzan.toml: no file matches `nowhere/*.md`");
    }

    #[test]
    fn the_file_is_found_upwards_but_not_beyond_the_repository() {
        let folder = std::env::temp_dir().join(format!("kenzan-config-{}", std::process::id()));
        let inner = folder.join("repository/lectures/spring");
        std::fs::create_dir_all(&inner).unwrap();
        std::fs::write(folder.join("kenzan.toml"), "seed = 1\n").unwrap();
        std::fs::create_dir_all(folder.join("repository/.git")).unwrap();
        assert!(Config::find(&inner).unwrap().is_none());
        std::fs::write(folder.join("repository/kenzan.toml"), "files = ['**/*.md']\nexclude = ['**/draft*']\n")
            .unwrap();
        for name in ["lectures/spring/b.md", "lectures/a.md", "lectures/draft.md", "lectures/c.txt"] {
            std::fs::write(folder.join("repository").join(name), "x").unwrap();
        }
        let config = Config::find(&inner).unwrap().unwrap();
        let found = config.files().unwrap().unwrap();
        let names: Vec<_> =
            found.iter().map(|p| p.strip_prefix(config.folder()).unwrap().display().to_string()).collect();
        assert_eq!(names, ["lectures/a.md", "lectures/spring/b.md"]);
        let near =
            Config::parse(Path::new("kenzan.toml"), "exclude = ['old', 'drafts/', 'a/**', 'x*.md']\n".into()).unwrap();
        for path in ["old/a.md", "./old/b/c.md", "drafts/a.md", "./a/b.md", "a/b/c.md", "./x1.md"] {
            assert!(near.excludes(Path::new(path)), "{path}");
        }
        for path in ["older/a.md", "lectures/old/a.md", "./b.md", "b/x1.md"] {
            assert!(!near.excludes(Path::new(path)), "{path}");
        }
        std::fs::remove_dir_all(&folder).unwrap();
    }
}
