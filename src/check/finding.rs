//! What is wrong with a document, and belongs to no equation, as reports tell it.

use std::fmt;

use serde::{Serialize, Serializer};

use crate::document::{Document, Problem, Severity};

/// A problem of a document that belongs to no equation. Reports hold its text.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// In one paragraph, place first: `notes.md:12:5: the display is not closed ...`.
    pub text: String,
    /// Whether the document is not as expected; otherwise a warning, which changes no exit code.
    pub is_error: bool,
    /// The path of the file that it is in, which may be another than the document's.
    pub file: String,
    /// The line in that file, from 1.
    pub line: usize,
    /// The column in characters, from 1.
    pub column: usize,
}

impl Finding {
    /// A problem of a document.
    pub fn of(problem: &Problem, document: &Document) -> Self {
        let (line, column) = document.line_column(problem.span.start);
        Finding {
            text: problem.to_text(document),
            is_error: problem.severity == Severity::Error,
            file: document.file(problem.span.start).display().to_string(),
            line,
            column,
        }
    }

    /// Its text without the place.
    pub fn message(&self) -> &str {
        let place = format!("{}:{}:{}: ", self.file, self.line, self.column);
        self.text.strip_prefix(&place).unwrap_or(&self.text)
    }
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

impl Serialize for Finding {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(&self.text)
    }
}
