//! Every equation of the bundled notes is a test of its own: `cargo test gyroscope::52`.
//!
//! A test passes where the verdict is the one that the notes' annotation expects, and where an equation is expected to
//! fail, its correction holds. The verdict itself is the checker's: see `verdicts.rs` for tests that it can fail.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::path::Path;
use std::process::ExitCode;
use std::sync::Arc;

use kenzan::check::verdict::Judgement;
use kenzan::check::{self, Book, Options};
use kenzan::document;
use libtest_mimic::{Arguments, Trial};

/// The bundled notes, by their names in `notes/`.
const NOTES: [&str; 2] = ["gyroscope", "celestial-mechanics-3"];

fn main() -> ExitCode {
    let arguments = Arguments::from_args();
    let mut trials = Vec::new();
    for name in NOTES {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("notes").join(format!("{name}.md"));
        match document::read(&path) {
            Ok(document) => trials.extend(equations(name, &document)),
            Err(error) => {
                eprintln!("{error}");
                return ExitCode::FAILURE;
            }
        }
    }
    libtest_mimic::run(&arguments, trials).exit_code()
}

/// One trial for each equation, and one for the document itself.
fn equations(name: &str, document: &document::Document) -> Vec<Trial> {
    let book = Arc::new(Book::new(document));
    let problems: Vec<String> = document.problems.iter().chain(&book.problems).map(|p| p.to_text(document)).collect();
    let mut trials = vec![Trial::test(format!("{name}::document"), move || {
        if problems.is_empty() { Ok(()) } else { Err(problems.join("\n").into()) }
    })];
    for index in 0..book.entries.len() {
        let book = Arc::clone(&book);
        let label = book.entries[index].equation.label.clone();
        trials.push(Trial::test(format!("{name}::{label}"), move || {
            let judgement = check::judge(&book, index, &Options::default());
            if judgement.as_expected { Ok(()) } else { Err(describe(&judgement).into()) }
        }));
    }
    trials
}

/// What is not as expected, for the test's output.
fn describe(judgement: &Judgement) -> String {
    let mut text =
        format!("({}) is {:?}: {}\n", judgement.label, judgement.verdict, judgement.reason.clone().unwrap_or_default());
    for link in &judgement.links {
        text.push_str(&format!("  {:?} {} {}\n", link.verdict, link.latex, link.reason.clone().unwrap_or_default()));
        if let Some(c) = &link.counterexample {
            let state: Vec<String> = c.state.iter().map(|a| format!("{} = {}", a.symbol, a.value)).collect();
            text.push_str(&format!("    at {}: {} against {}\n", state.join(", "), c.lhs, c.rhs));
        }
    }
    if let Some(correction) = &judgement.correction {
        text.push_str(&format!("  the correction is {:?}\n", correction.verdict));
        for link in &correction.links {
            text.push_str(&format!(
                "    {:?} {} {}\n",
                link.verdict,
                link.latex,
                link.reason.clone().unwrap_or_default()
            ));
        }
    }
    text
}
