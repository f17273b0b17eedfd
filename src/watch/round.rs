//! One round: the notes are read, what changed is judged, what became of it is told.

use std::collections::{HashMap, HashSet};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use crate::check::verdict::{DocumentReport, Verdict};
use crate::document;
use crate::files;
use crate::incremental::Memory;
use crate::report::Counts;
use crate::verify::{self, Request, Verified};

use super::Settings;
use super::server::Board;

/// The most changed verdicts that a line names.
const NAMED: usize = 6;

/// What is known from round to round.
#[derive(Default)]
pub struct Rounds {
    notes: HashMap<PathBuf, Notes>,
    /// The notes that could not be read in the last round.
    missed: HashSet<PathBuf>,
    /// The request that the memories are of.
    request: String,
}

/// Notes as they were last read.
struct Notes {
    memory: Memory,
    source: Arc<str>,
    verified: Verified,
}

impl Rounds {
    /// Verifies what changed, and puts the report on the board.
    pub fn round(&mut self, settings: &Settings, board: &Board, say: &dyn Fn(&str)) {
        let begin = Instant::now();
        let request = format!("{:?}", settings.request);
        if request != self.request {
            self.notes.clear();
            self.request = request;
        }
        let mut paths = named(&settings.paths);
        paths.retain(|path| !settings.excluding.excludes(path));
        let gone = self.notes.extract_if(|path, _| !paths.contains(path));
        let mut lines: Vec<String> = gone.map(|(_, notes)| format!("{} is gone", notes.verified.report.path)).collect();
        lines.sort();
        for path in &paths {
            let in_folder = !settings.paths.contains(path);
            lines.extend(self.read(path, in_folder, &settings.request));
        }
        let verified: Vec<&Verified> = paths.iter().filter_map(|path| Some(&self.notes.get(path)?.verified)).collect();
        if !lines.is_empty() {
            let run = verify::run(verified, &settings.request, begin);
            board.put(run, settings.options, &lines.join("; "));
        }
        lines.iter().for_each(|line| say(line));
    }

    /// All files that were read.
    pub fn files(&self) -> Vec<PathBuf> {
        self.notes
            .values()
            .flat_map(|notes| notes.verified.document.files.iter().map(|file| file.path.clone()))
            .collect()
    }

    /// Reads notes, and verifies them where they are not as they were: what to say of it.
    fn read(&mut self, path: &Path, in_folder: bool, request: &Request) -> Option<String> {
        let begin = Instant::now();
        let document = match document::read(path) {
            Ok(document) => document,
            Err(document::ReadError::NoEquation { .. } | document::ReadError::Empty { .. }) if in_folder => {
                return None;
            }
            Err(error) => {
                self.missed.insert(path.to_owned());
                let before =
                    if self.notes.contains_key(path) { "; the report shows what was there before" } else { "" };
                return Some(format!("{error}{before}"));
            }
        };
        // What was told to be missing is told to be there, even if it is as it was.
        let was_missed = self.missed.remove(path);
        let known = self.notes.remove(path);
        let source = Arc::clone(&document.source);
        let (mut memory, before) = match known {
            Some(notes) if notes.source == source && !was_missed => {
                self.notes.insert(path.to_owned(), notes);
                return None;
            }
            Some(notes) => (notes.memory, Some(notes.verified)),
            None => (Memory::default(), None),
        };
        let (verified, anew) = verify::verify_again(document, request, &mut memory, &|| ());
        let line = line(&verified, before.as_ref().map(|b| &b.report), anew.len(), begin.elapsed());
        self.notes.insert(path.to_owned(), Notes { memory, source, verified });
        Some(line)
    }
}

/// The files that are meant: those named, and those in the folders named.
fn named(paths: &[PathBuf]) -> Vec<PathBuf> {
    let files = |path: &PathBuf| if path.is_dir() { files::within(path) } else { vec![path.clone()] };
    paths.iter().flat_map(files).collect()
}

/// `notes.md: 93 hold, 2 fail; (56) holds → fails; 3 judged in 41 ms`
fn line(verified: &Verified, before: Option<&DocumentReport>, anew: usize, time: Duration) -> String {
    let report = &verified.report;
    let counts = Counts::of(&report.equations);
    let words = [
        (Verdict::Holds, "hold"),
        (Verdict::Asymptotic, "hold asymptotically"),
        (Verdict::Definition, "define"),
        (Verdict::Statement, "state"),
        (Verdict::Fails, "fail"),
        (Verdict::Undecided, "undecided"),
        (Verdict::Unreadable, "unreadable"),
    ];
    let counted =
        words.iter().filter(|(v, _)| counts.with(*v) > 0).map(|(v, word)| format!("{} {word}", counts.with(*v)));
    let mut text = format!("{}: {}", report.path, counted.collect::<Vec<_>>().join(", "));
    let unexpected = report.equations.iter().filter(|e| !e.as_expected).count()
        + report.problems.iter().filter(|p| p.is_error).count();
    // Writing to a string cannot fail.
    let _ =
        if unexpected > 0 { write!(text, ", {unexpected} not as expected") } else { write!(text, ", all as expected") };
    let changed = before.map(|before| changes(before, report)).unwrap_or_default();
    changed.iter().take(NAMED).for_each(|change| text += &format!("; {change}"));
    if changed.len() > NAMED {
        let _ = write!(text, "; and {} more", changed.len() - NAMED);
    }
    let _ = write!(text, "; {anew} judged in {} ms", time.as_millis());
    text.replace(char::is_control, " ")
}

/// What changed its verdict, came, or went, by labels.
fn changes(before: &DocumentReport, now: &DocumentReport) -> Vec<String> {
    let word = |verdict: Verdict| format!("{verdict:?}").to_lowercase();
    let verdicts = |report: &DocumentReport| -> HashMap<String, Verdict> {
        report.equations.iter().map(|e| (e.label.clone(), e.verdict)).collect()
    };
    let (old, new) = (verdicts(before), verdicts(now));
    let came = now.equations.iter().filter_map(|e| match old.get(&e.label) {
        Some(verdict) if *verdict == e.verdict => None,
        Some(verdict) => Some(format!("({}) {} → {}", e.label, word(*verdict), word(e.verdict))),
        None => Some(format!("({}) is new and {}", e.label, word(e.verdict))),
    });
    let gone =
        before.equations.iter().filter(|e| !new.contains_key(&e.label)).map(|e| format!("({}) is gone", e.label));
    came.chain(gone).collect()
}
