//! Tests of the whole reader.

mod annotations;
mod dialects;
mod displays;
mod files;
mod hostile;
mod messages;
mod originals;
mod sidecar;
mod tex;

use super::*;
use std::path::Path;

fn parse(source: &str) -> Document {
    super::parse(Path::new("notes.md"), source)
}

/// Labels and masked LaTeX of the equations of a text that must have no problems.
fn equations(source: &str) -> Vec<(String, String)> {
    let document = parse(source);
    assert_eq!(problems(&document), Vec::<String>::new());
    check_promises(&document);
    document.equations().map(|equation| (equation.label.clone(), equation.masked.trim().to_owned())).collect()
}

fn problems(document: &Document) -> Vec<String> {
    document.problems.iter().map(|problem| problem.to_text(document)).collect()
}

fn pairs(expected: &[(&str, &str)]) -> Vec<(String, String)> {
    expected.iter().map(|(label, latex)| ((*label).to_owned(), (*latex).to_owned())).collect()
}

/// What holds of every document, however damaged.
fn check_promises(document: &Document) {
    let mut labels = std::collections::HashSet::new();
    for equation in document.equations() {
        assert_eq!(document.source.get(equation.span.clone()), Some(equation.latex.as_str()));
        assert_eq!(equation.masked.len(), equation.latex.len());
        assert_eq!(document.line_column(equation.span.start).0, equation.line);
        assert!(labels.insert(equation.label.as_str()), "label {} is not unique", equation.label);
    }
    for problem in &document.problems {
        assert!(document.source.get(problem.span.clone()).is_some(), "{problem:?}");
        assert!(problem.other.iter().all(|(span, _)| document.source.get(span.clone()).is_some()), "{problem:?}");
    }
}
