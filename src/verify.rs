//! The pipeline: documents in, judgements out.

use std::path::{Path, PathBuf};
use std::time::Instant;

use rayon::prelude::*;

use crate::breakdown::caught;
use crate::check::dimension::Survey;
use crate::check::verdict::{Assumed, DocumentReport, Judgement, Verdict};
use crate::check::{self, Book, Finding, Fingerprints, Options};
use crate::diagnose::{correct, sensitivity};
use crate::document::{self, Document, ReadError};
use crate::expr::Deadline;
use crate::files;
use crate::incremental::{Judged, Memory};
use crate::infer::{self, Ground, roles};
use crate::report::{Run, charts};

/// The notes that Kenzan brings along, by the path they have in the repository.
const BUNDLED: [(&str, &str); 2] = [
    ("notes/gyroscope.md", include_str!("../notes/gyroscope.md")),
    ("notes/celestial-mechanics-3.md", include_str!("../notes/celestial-mechanics-3.md")),
];

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

/// Reads the documents that are asked for, those in folders included; without any the bundled notes.
///
/// # Errors
/// The first file that cannot be read.
pub fn documents(paths: &[PathBuf]) -> Result<Vec<Document>, ReadError> {
    if !paths.is_empty() {
        return files::read(paths);
    }
    let bundled = BUNDLED.iter().map(|(path, text)| {
        // In the repository the files themselves are read, so that a change to the notes needs no new build.
        let path = Path::new(path);
        if path.exists() { document::read(path) } else { Ok(document::parse(path, text)) }
    });
    bundled.collect()
}

/// The bundled notes, as they are in the binary.
pub fn bundled() -> Vec<Document> {
    BUNDLED.iter().map(|(path, text)| document::parse(Path::new(path), text)).collect()
}

/// Judges a document's equations, each on its own: one that panics costs no other. `judged` is called after each.
pub fn verify(document: Document, request: &Request, judged: &(dyn Fn() + Sync)) -> Verified {
    verify_again(document, request, &mut Memory::default(), judged).0
}

/// As [`verify`], with what is remembered of an earlier state of the document under the same request. Says which
/// equations were judged anew, by their places among all.
pub fn verify_again(
    document: Document,
    request: &Request,
    memory: &mut Memory,
    judged: &(dyn Fn() + Sync),
) -> (Verified, Vec<usize>) {
    let guesses = roles::guess(&document);
    let assumed = guesses.iter().map(|g| assumed(g, &document)).collect();
    let document = if guesses.is_empty() { document } else { roles::declare(&document, &guesses) };
    let mut book = memory.book(&document);
    let ground = (!guesses.is_empty()).then(|| {
        infer::declare_functions(&mut book, &document);
        Ground::new(&book, &document, guesses)
    });
    let prints = Fingerprints::new(&book).with(|k| ground.as_ref().map(|ground| ground.fingerprint(&book, k)));
    let wanted: Vec<usize> = book
        .entries
        .iter()
        .enumerate()
        .filter(|(_, entry)| request.only.is_empty() || request.only.iter().any(|only| entry.equation.is_called(only)))
        .map(|(k, _)| k)
        .collect();
    let judge = |index: usize| {
        let outcome = caught(|| match &ground {
            Some(ground) => ground.judge(&mut book.clone(), index, &request.options),
            None => judged_and_diagnosed(&book, index, request),
        });
        judged();
        outcome.unwrap_or_else(|panic| broken(&book, index, &panic))
    };
    let Judged { judgements: mut equations, anew } = memory.judge(&prints, &wanted, judge);
    let survey = caught(|| Survey::with(&prints, &mut memory.readings)).ok();
    if let Some(survey) = &survey {
        // Dimensions decide no verdict: without them the judgement stands.
        let report = |(index, judgement): (&usize, &mut Judgement)| drop(caught(|| survey.report(*index, judgement)));
        wanted.par_iter().zip(&mut equations).for_each(report);
    }
    let problems: Vec<document::Problem> = document.problems.iter().chain(&book.problems).cloned().collect();
    let report = DocumentReport {
        name: document.name.clone(),
        path: document.path.display().to_string(),
        title: document.title.clone(),
        problems: problems.iter().map(|p| Finding::of(p, &document)).collect(),
        inferred: survey.map(|s| s.inferred()).unwrap_or_default(),
        assumed,
        equations,
    };
    (Verified { document, problems, report }, anew)
}

/// A guessed role for the report.
fn assumed(guess: &roles::Guess, document: &Document) -> Assumed {
    Assumed {
        symbol: guess.name.clone(),
        role: guess.role.words(),
        range: guess.range(),
        moves: guess.moves,
        line: document.files.line(guess.at),
    }
}

/// The judgement on an equation, with the diagnosis that was asked for.
fn judged_and_diagnosed(book: &Book, index: usize, request: &Request) -> Judgement {
    #[cfg(test)]
    assert_ne!(book.entries[index].equation.label, tests::BREAKS, "a test");
    let options = &request.options;
    let mut judgement = check::judge(book, index, options);
    if request.mutants {
        let deadline = Deadline::after(options.budget);
        judgement.sensitivity = sensitivity::sensitivity(book, index, &judgement, options);
        judgement.unfinished = deadline.has_passed().then(|| deadline.used_up("trying the mutants"));
    }
    if request.suggest {
        let deadline = Deadline::after(options.budget);
        judgement.suggestions = correct::suggestions(book, index, &judgement, options);
        if deadline.has_passed() {
            judgement.unfinished = Some(deadline.used_up("searching what was meant"));
        }
    }
    judgement
}

/// The judgement on an equation at which Kenzan itself broke down: the panic's message and place.
fn broken(book: &Book, index: usize, panic: &str) -> Judgement {
    Judgement {
        verdict: Verdict::Unreadable,
        reason: Some(format!("Kenzan broke down at this equation, please report it with the notes: {panic}")),
        ..check::blank(book, index)
    }
}

/// The report's data: the judgements and, where the bundled notes are among them, the charts of their motions.
pub fn run<'v>(verified: impl IntoIterator<Item = &'v Verified>, request: &Request, begin: Instant) -> Run {
    let verified: Vec<&Verified> = verified.into_iter().collect();
    let bundled = verified.iter().any(|v| v.document.name == "gyroscope") && request.only.is_empty();
    Run {
        seed: request.options.seed,
        states: request.options.states,
        precision: request.options.precision,
        documents: verified.iter().map(|v| v.report.clone()).collect(),
        charts: bundled.then_some(charts::heavy_top),
        micros: u64::try_from(begin.elapsed().as_micros()).unwrap_or(u64::MAX),
    }
}

/// Whether every equation is as expected and nothing is wrong with the documents.
pub fn all_as_expected(verified: &[Verified]) -> bool {
    let judgements = verified.iter().all(|v| v.report.equations.iter().all(|e| e.as_expected));
    let problems = verified.iter().all(|v| v.problems.iter().all(|p| p.severity != document::Severity::Error));
    judgements && problems
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The label of an equation at which the judgement panics.
    pub const BREAKS: &str = "13th";

    #[test]
    fn an_equation_that_breaks_kenzan_costs_no_other() {
        let notes = "<!-- kenzan\n[symbols]\n'a' = { range = [1, 2] }\n-->\n$$ a + a = 2 a \\tag{1} $$\n\n\
            $$ a = a \\tag{13th} $$\n\n$$ a a = a^2 \\tag{3} $$\n";
        let document = document::parse(Path::new("notes.md"), notes);
        let verified = verify(document, &Request::default(), &|| ());
        let verdicts: Vec<Verdict> = verified.report.equations.iter().map(|e| e.verdict).collect();
        assert_eq!(verdicts, [Verdict::Holds, Verdict::Unreadable, Verdict::Holds]);
        let reason = verified.report.equations[1].reason.as_deref().unwrap();
        assert!(reason.contains("please report it") && reason.contains("a test"), "{reason}");
        assert!(reason.contains("(src/verify.rs:"), "{reason}");
        assert!(!all_as_expected(&[verified]));
    }
}
