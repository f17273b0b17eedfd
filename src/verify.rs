//! The pipeline: documents in, judgements out.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::time::Instant;

use rayon::prelude::*;

use crate::check::dimension::Survey;
use crate::check::verdict::{DocumentReport, Judgement, Verdict};
use crate::check::{self, Book, Options};
use crate::diagnose::{correct, sensitivity};
use crate::document::{self, Document, ReadError};
use crate::report::{Run, charts};

/// The notes that Kenzan brings along, by the path they have in the repository.
const BUNDLED: [(&str, &str); 1] = [("notes/gyroscope.md", include_str!("../notes/gyroscope.md"))];

/// What to verify and how.
#[derive(Clone, Debug, Default)]
pub struct Request {
    /// The files; none for the bundled notes.
    pub paths: Vec<PathBuf>,
    /// How to judge.
    pub options: Options,
    /// The labels to judge; none for all.
    pub only: Vec<String>,
    /// Whether to try the mutants of each equation.
    pub mutants: bool,
    /// Whether to search what was probably meant, for each equation that fails.
    pub suggest: bool,
}

/// A document with what became of it.
pub struct Verified {
    /// The document, which messages quote.
    pub document: Document,
    /// What is wrong with the document beside its equations.
    pub problems: Vec<document::Problem>,
    /// The judgements.
    pub report: DocumentReport,
}

/// Reads the documents that are asked for.
///
/// # Errors
/// The first file that cannot be read.
pub fn documents(paths: &[PathBuf]) -> Result<Vec<Document>, ReadError> {
    if !paths.is_empty() {
        return paths.iter().map(|path| document::read(path)).collect();
    }
    let bundled = BUNDLED.iter().map(|(path, text)| {
        // In the repository the files themselves are read, so that a change to the notes needs no new build.
        let path = Path::new(path);
        if path.exists() { document::read(path) } else { Ok(document::parse(path, text)) }
    });
    bundled.collect()
}

/// Judges a document's equations, each on its own: one that panics costs no other. `judged` is called after each.
pub fn verify(document: Document, request: &Request, judged: &(dyn Fn() + Sync)) -> Verified {
    let book = Book::new(&document);
    let survey = catch_unwind(AssertUnwindSafe(|| Survey::new(&book))).ok();
    let wanted: Vec<usize> = (0..book.entries.len())
        .filter(|k| request.only.is_empty() || request.only.contains(&book.entries[*k].equation.label))
        .collect();
    let judge = |index: &usize| {
        let outcome = catch_unwind(AssertUnwindSafe(|| judged_and_diagnosed(&book, *index, request)));
        let mut judgement = outcome.unwrap_or_else(|_| broken(&book, *index));
        if let Some(survey) = &survey {
            survey.report(*index, &mut judgement);
        }
        judged();
        judgement
    };
    let equations = wanted.par_iter().map(judge).collect();
    let problems: Vec<document::Problem> = document.problems.iter().chain(&book.problems).cloned().collect();
    let report = DocumentReport {
        name: document.name.clone(),
        path: document.path.display().to_string(),
        title: document.title.clone(),
        problems: problems.iter().map(|p| p.to_text(&document)).collect(),
        inferred: survey.map(|s| s.inferred()).unwrap_or_default(),
        equations,
    };
    Verified { document, problems, report }
}

/// The judgement on an equation, with the diagnosis that was asked for.
fn judged_and_diagnosed(book: &Book, index: usize, request: &Request) -> Judgement {
    let mut judgement = check::judge(book, index, &request.options);
    if request.mutants {
        judgement.sensitivity = sensitivity::sensitivity(book, index, &judgement, &request.options);
    }
    if request.suggest {
        judgement.suggestions = correct::suggestions(book, index, &judgement, &request.options);
    }
    judgement
}

/// The judgement on an equation at which Kenzan itself broke down.
fn broken(book: &Book, index: usize) -> Judgement {
    Judgement {
        verdict: Verdict::Unreadable,
        reason: Some("Kenzan broke down at this equation: please report it with the notes".into()),
        ..check::blank(book, index)
    }
}

/// The report's data: the judgements and, where the bundled notes are among them, the charts of their motions.
pub fn run(verified: &[Verified], request: &Request, begin: Instant) -> Run {
    let bundled = verified.iter().any(|v| v.document.name == "gyroscope") && request.only.is_empty();
    Run {
        seed: request.options.seed,
        states: request.options.states,
        precision: request.options.precision,
        documents: verified.iter().map(|v| v.report.clone()).collect(),
        charts: if bundled { charts::heavy_top().unwrap_or_default() } else { Vec::new() },
        micros: u64::try_from(begin.elapsed().as_micros()).unwrap_or(u64::MAX),
    }
}

/// Whether every equation is as expected and nothing is wrong with the documents.
pub fn all_as_expected(verified: &[Verified]) -> bool {
    let judgements = verified.iter().all(|v| v.report.equations.iter().all(|e| e.as_expected));
    let problems = verified.iter().all(|v| v.problems.iter().all(|p| p.severity != document::Severity::Error));
    judgements && problems
}
