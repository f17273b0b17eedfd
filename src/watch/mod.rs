//! Notes under the author's hands: verified again whenever a file is saved, only what changed, and the report shown by a
//! small server on this computer.
//!
//! Promises: a file that cannot be read is told of and ends nothing; what is served is the report and nothing else, to
//! this computer alone.

mod round;
mod server;

use std::collections::HashSet;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::time::{Duration, Instant};

use notify::{Event, EventKind, RecommendedWatcher, RecursiveMode, Watcher};

use crate::config::Config;
use crate::{document, files, report, verify};

use round::Rounds;
use server::{Board, Server};

/// How long nothing may happen before a change counts as complete: editors save in several steps.
const QUIET: Duration = Duration::from_millis(50);
/// How long a change is waited for to be complete.
const LONGEST: Duration = Duration::from_secs(1);

/// What is watched, and how it is verified.
#[derive(Clone, Debug)]
pub struct Settings {
    /// The notes and the folders of notes.
    pub paths: Vec<PathBuf>,
    /// The `kenzan.toml` in force.
    pub config: Option<PathBuf>,
    /// What says which of them are excluded.
    pub excluding: Config,
    /// How to judge.
    pub request: verify::Request,
    /// What the report looks like.
    pub options: report::Options,
}

/// Why nothing can be watched.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
pub enum WatchError {
    /// The port is taken, or there is none.
    #[error("the report cannot be served on port {port}")]
    #[diagnostic(help("name another with --port, or none for a free one: {reason}"))]
    Port {
        /// The port asked for.
        port: u16,
        /// What the system says.
        reason: String,
    },
    /// The system does not tell of changes.
    #[error("changes of files cannot be watched")]
    #[diagnostic(help(
        "is the folder on this computer, and are there watches left (`sysctl fs.inotify.max_user_watches`)?"
    ))]
    Watcher(#[from] notify::Error),
}

/// Verifies and serves, at first and after each change, until the process is ended. `settings` are asked for each time,
/// as kenzan.toml may have changed; `say` is given a line for each event.
///
/// # Errors
/// Where the settings cannot be used at first, or [`WatchError`].
pub fn watch(
    settings: &dyn Fn() -> miette::Result<Settings>,
    port: u16,
    open: bool,
    say: &dyn Fn(&str),
) -> miette::Result<()> {
    let first = settings()?;
    // Notes that go and come back are waited for; notes that never were are a slip of the pen.
    if let Some(missing) = first.paths.iter().find(|path| !path.exists()) {
        document::read(missing)?;
    }
    let board = Arc::new(Board::default());
    let server = Server::start(port, Arc::clone(&board))?;
    let (send, events) = channel();
    let mut folders =
        Folders { watcher: notify::recommended_watcher(send).map_err(WatchError::from)?, watched: HashSet::new() };
    let mut rounds = Rounds::default();
    rounds.round(&first, &board, say);
    folders.watch(&first, &rounds.files())?;
    say(&format!("report: {}  (Ctrl-C ends)", server.address()));
    if open && let Err(error) = open::that_detached(server.address()) {
        say(&format!("no browser could be opened: {error}"));
    }
    while changed(&events, &rounds.files()) {
        match settings() {
            Ok(settings) => {
                rounds.round(&settings, &board, say);
                if let Err(error) = folders.watch(&settings, &rounds.files()) {
                    say(&error.to_string());
                }
            }
            Err(error) => say(&format!("{error:?}")),
        }
    }
    Ok(())
}

/// The folders that are watched. Files themselves are not: editors put new ones in their places.
struct Folders {
    watcher: RecommendedWatcher,
    watched: HashSet<PathBuf>,
}

impl Folders {
    fn watch(&mut self, settings: &Settings, read: &[PathBuf]) -> Result<(), WatchError> {
        for path in settings.paths.iter().filter(|path| path.is_dir()) {
            self.add(path, RecursiveMode::Recursive)?;
        }
        for file in settings.paths.iter().filter(|path| !path.is_dir()).chain(read).chain(&settings.config) {
            let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
            self.add(folder, RecursiveMode::NonRecursive)?;
        }
        Ok(())
    }

    fn add(&mut self, folder: &Path, mode: RecursiveMode) -> Result<(), WatchError> {
        if folder.is_dir() && !self.watched.contains(folder) {
            self.watcher.watch(folder, mode)?;
            self.watched.insert(folder.to_owned());
        }
        Ok(())
    }
}

/// Waits until something that matters has changed and nothing changes any more. `false` where nobody tells of changes.
fn changed(events: &Receiver<notify::Result<Event>>, read: &[PathBuf]) -> bool {
    loop {
        let Ok(event) = events.recv() else { return false };
        if matters(&event, read) {
            break;
        }
    }
    let begin = Instant::now();
    while begin.elapsed() < LONGEST {
        match events.recv_timeout(QUIET) {
            Ok(_) => {}
            Err(RecvTimeoutError::Timeout) => break,
            Err(RecvTimeoutError::Disconnected) => return false,
        }
    }
    true
}

/// Whether an event is about notes or what belongs to them. What cannot be told may be.
fn matters(event: &notify::Result<Event>, read: &[PathBuf]) -> bool {
    let Ok(event) = event else { return true };
    let is_ours = |path: &PathBuf| {
        let name = path.file_name().unwrap_or_default();
        let belongs = path.extension().is_some_and(|e| e == "toml" || e == "sty" || e == "cls");
        belongs || files::is_notes(path) || read.iter().any(|file| file.file_name() == Some(name))
    };
    !matches!(event.kind, EventKind::Access(_)) && event.paths.iter().any(is_ours)
}
