//! The report for other people's continuous integration: JUnit, SARIF, and GitHub's annotations.
//!
//! In each of them an equation that is not as expected is an error, and one that fails as expected a note: known misprints keep a
//! build green. Problems of a document are errors or warnings; warnings change nothing.

use super::terminal::of_one;
use super::text::word;
use super::{ReportError, Run};
use crate::check::Finding;
use crate::check::verdict::{DocumentReport, Judgement, Verdict};
use quick_junit::{NonSuccessKind, Report, TestCase, TestCaseStatus, TestSuite};
use serde_json::{Value, json};
use std::time::Duration;

/// As JUnit's XML: a suite for each document, a test for each equation.
///
/// # Errors
/// [`ReportError::Junit`]
pub fn junit(run: &Run, times: bool) -> Result<String, ReportError> {
    let mut report = Report::new("kenzan");
    for document in &run.documents {
        let mut suite = TestSuite::new(&document.path);
        for judgement in &document.equations {
            let mut case = TestCase::new(format!("({})", judgement.label), status(document, judgement));
            case.set_classname(&document.name);
            if times {
                case.set_time(Duration::from_micros(judgement.micros));
            }
            suite.add_test_case(case);
        }
        for problem in &document.problems {
            suite.add_test_case(case_of(problem));
        }
        report.add_test_suite(suite);
    }
    // The schema by which Jenkins judges such files allows this count for suites alone, and a file with it is refused.
    Ok(report.to_string()?.replacen(&format!(" skipped=\"{}\"", report.skipped), "", 1))
}

/// A problem of a document as a test: one that passes, and says so, where it is a warning.
fn case_of(problem: &Finding) -> TestCase {
    let name = format!("{}:{}:{}", problem.file, problem.line, problem.column);
    if problem.is_error {
        let mut failed = TestCaseStatus::non_success(NonSuccessKind::Error);
        failed.set_message(problem.message());
        return TestCase::new(name, failed);
    }
    let mut case = TestCase::new(name, TestCaseStatus::success());
    case.set_system_out(problem.message());
    case
}

fn status(document: &DocumentReport, judgement: &Judgement) -> TestCaseStatus {
    if judgement.as_expected {
        return match judgement.verdict {
            Verdict::Statement => TestCaseStatus::skipped(),
            _ => TestCaseStatus::success(),
        };
    }
    let kind = if judgement.verdict == Verdict::Unreadable { NonSuccessKind::Error } else { NonSuccessKind::Failure };
    let mut status = TestCaseStatus::non_success(kind);
    status.set_message(word(judgement.verdict)).set_description(of_one(document, judgement));
    status
}

/// The equations that are told, and whether they are errors.
fn told(document: &DocumentReport) -> impl Iterator<Item = (&Judgement, bool)> {
    let is_told = |j: &&Judgement| !j.as_expected || j.verdict == Verdict::Fails;
    document.equations.iter().filter(is_told).map(|j| (j, !j.as_expected))
}

/// As GitHub's workflow commands, which annotate the lines of the notes.
pub fn github(run: &Run) -> String {
    let mut text = String::new();
    for document in &run.documents {
        for (judgement, is_error) in told(document) {
            let level = if is_error { "error" } else { "notice" };
            let title = property(&format!("({}) {}", judgement.label, word(judgement.verdict)));
            let message = data(&of_one(document, judgement));
            let file = property(document.path_of(judgement));
            text += &format!("::{level} file={file},line={},title={title}::{message}\n", judgement.line);
        }
        for problem in &document.problems {
            let level = if problem.is_error { "error" } else { "warning" };
            let file = property(&problem.file);
            let (line, column) = (problem.line, problem.column);
            text += &format!("::{level} file={file},line={line},col={column}::{}\n", data(problem.message()));
        }
    }
    text
}

/// The text of a workflow command.
fn data(text: &str) -> String {
    text.replace('%', "%25").replace('\r', "%0D").replace('\n', "%0A")
}

/// A property of a workflow command.
fn property(text: &str) -> String {
    data(text).replace(':', "%3A").replace(',', "%2C")
}

/// As SARIF 2.1.0.
///
/// # Errors
/// [`ReportError::Json`]
pub fn sarif(run: &Run) -> Result<String, ReportError> {
    let verdicts = [Verdict::Fails, Verdict::Undecided, Verdict::Unreadable];
    let rules: Vec<Value> = verdicts.into_iter().map(word).chain(["surprise", "document"]).map(rule).collect();
    let results: Vec<Value> = run.documents.iter().flat_map(results).collect();
    let log = json!({
        "$schema": "https://json.schemastore.org/sarif-2.1.0.json",
        "version": "2.1.0",
        "runs": [{
            "tool": { "driver": { "name": "kenzan", "version": env!("CARGO_PKG_VERSION"), "rules": rules } },
            "columnKind": "unicodeCodePoints",
            "results": results,
        }],
    });
    Ok(serde_json::to_string_pretty(&log)? + "\n")
}

fn rule(id: &str) -> Value {
    let text = match id {
        "fails" => "The equation does not hold",
        "undecided" => "The equation cannot be decided",
        "unreadable" => "The equation cannot be read",
        "document" => "Something is wrong with the document",
        _ => "The equation is not as its annotation expects",
    };
    let name: String = text.split(' ').map(capitalized).collect();
    json!({ "id": id, "name": name, "shortDescription": { "text": text } })
}

/// A word as it stands in the middle of a name.
fn capitalized(word: &str) -> String {
    let mut letters = word.chars();
    letters.next().map(|first| first.to_uppercase().chain(letters).collect()).unwrap_or_default()
}

fn results(document: &DocumentReport) -> Vec<Value> {
    let place = |path: &str, region: Value| json!([{ "physicalLocation": { "artifactLocation": { "uri": uri(path) }, "region": region } }]);
    let equations = told(document).map(|(j, is_error)| {
        let rule = match j.verdict {
            Verdict::Fails | Verdict::Undecided | Verdict::Unreadable => word(j.verdict),
            _ => "surprise",
        };
        json!({
            "ruleId": rule,
            "level": if is_error { "error" } else { "note" },
            "message": { "text": of_one(document, j) },
            "locations": place(document.path_of(j), json!({ "startLine": j.line })),
        })
    });
    let problems = document.problems.iter().map(|problem| {
        let level = if problem.is_error { "error" } else { "warning" };
        let region = json!({ "startLine": problem.line, "startColumn": problem.column });
        json!({
            "ruleId": "document",
            "level": level,
            "message": { "text": problem.message() },
            "locations": place(&problem.file, region),
        })
    });
    equations.chain(problems).collect()
}

/// A path as a relative reference: what has a meaning in addresses is escaped.
fn uri(path: &str) -> String {
    let escaped = |b: u8| match b {
        b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'/' | b'.' | b'-' | b'_' | b'~' => (b as char).to_string(),
        b'\\' => "/".to_owned(),
        _ => format!("%{b:02X}"),
    };
    path.bytes().map(escaped).collect()
}
