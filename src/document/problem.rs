//! What is wrong with a document, in words for its author: what was found, what was expected, where, and what to do.

use super::Document;
use super::files::local;
use super::place::Span;
use miette::{LabeledSpan, MietteDiagnostic, NamedSource, Report};

/// How bad a problem is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Severity {
    /// Something was left out or not understood.
    Error,
    /// Everything was understood, but probably not meant.
    Warning,
}

/// A problem of a document that did not prevent reading the rest of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Problem {
    /// Its kind, for other tools: `document::unclosed`.
    pub code: &'static str,
    /// What is wrong, without a full stop.
    pub message: String,
    /// The bytes of the file to underline.
    pub span: Span,
    /// A note at the underline.
    pub label: Option<String>,
    /// Another place that has to do with it, and a note for that one.
    pub other: Option<(Span, String)>,
    /// What to do.
    pub help: Option<String>,
    /// How bad it is.
    pub severity: Severity,
}

/// Lines longer than this, in bytes, are not printed around an underline.
const LONGEST_PRINTED_LINE: usize = 4000;

impl Problem {
    /// An error at a place.
    pub fn error(code: &'static str, message: impl Into<String>, span: Span) -> Self {
        Problem { code, message: message.into(), span, label: None, other: None, help: None, severity: Severity::Error }
    }

    /// A warning at a place.
    pub fn warning(code: &'static str, message: impl Into<String>, span: Span) -> Self {
        Problem { severity: Severity::Warning, ..Problem::error(code, message, span) }
    }

    /// Sets the note at the underline.
    pub fn label(mut self, label: impl Into<String>) -> Self {
        self.label = Some(label.into());
        self
    }

    /// Adds a second place.
    pub fn other(mut self, span: Span, label: impl Into<String>) -> Self {
        self.other = Some((span, label.into()));
        self
    }

    /// Sets what to do.
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// The problem as a report with the underlined source. Where the source's line is too long to be shown (a file
    /// without line breaks), the report gives the place in words instead.
    pub fn to_miette(&self, document: &Document) -> Report {
        let severity = match self.severity {
            Severity::Error => miette::Severity::Error,
            Severity::Warning => miette::Severity::Warning,
        };
        let mut diagnostic =
            MietteDiagnostic::new(harmless(&self.message)).with_code(self.code).with_severity(severity);
        if let Some(help) = &self.help {
            diagnostic = diagnostic.with_help(harmless(help));
        }
        let shown = |span: &Span| printable(&document.source, span);
        if !shown(&self.span) || !self.other.iter().all(|(span, _)| shown(span)) {
            diagnostic.message = harmless(&format!("{} ({})", self.message, self.location(document)));
            return Report::new(diagnostic);
        }
        let (file, span) = local(&document.files, &self.span);
        let mut labels = vec![LabeledSpan::new_primary_with_span(self.label.clone(), span)];
        if let Some((other, label)) = &self.other {
            // A place in another file cannot be shown beside this one: it is told in words.
            match local(&document.files, other) {
                (same, span) if same == file => labels.push(LabeledSpan::new_with_span(Some(label.clone()), span)),
                _ => diagnostic.message += &harmless(&format!("; {label}: {}", place(document, other))),
            }
        }
        let shown = document.files.at(self.span.start);
        let text = shown.map_or("", |file| &file.text);
        let source = NamedSource::new(harmless(&document.file(self.span.start).to_string_lossy()), harmless(text));
        Report::new(diagnostic.with_labels(labels)).with_source_code(source)
    }

    /// The problem in one paragraph of plain text, place first: `notes.md:12:5: the display is not closed ...`.
    pub fn to_text(&self, document: &Document) -> String {
        let mut text = format!("{}: {}", self.location(document), self.message);
        if let Some(label) = &self.label {
            text += &format!(": {label}");
        }
        if let Some((span, label)) = &self.other {
            let (line, column) = document.line_column(span.start);
            let same = document.files.place(span.start).0 == document.files.place(self.span.start).0;
            let file = if same { String::new() } else { format!("{}, ", document.file(span.start).display()) };
            text += &format!("; {label} ({file}line {line}, column {column})");
        }
        if let Some(help) = &self.help {
            text += &format!(". {help}");
        }
        text
    }

    fn location(&self, document: &Document) -> String {
        place(document, &self.span)
    }
}

/// Where a place begins, with its file: `notes.md:12:5`.
fn place(document: &Document, span: &Span) -> String {
    let (line, column) = document.line_column(span.start);
    format!("{}:{line}:{column}", document.file(span.start).display())
}

/// A text in which nothing steers the terminal: control characters become signs of the same length in bytes.
fn harmless(text: &str) -> String {
    let sign = |c: char| match c {
        '\n' | '\t' | '\r' => c,
        '\u{80}'..='\u{9f}' => '¿',
        c if c.is_control() => '?',
        c => c,
    };
    text.chars().map(sign).collect()
}

/// Whether the lines that hold a span are short enough to be printed.
fn printable(source: &str, span: &Span) -> bool {
    let before = source.get(..span.start).unwrap_or_default();
    let after = source.get(span.end..).unwrap_or_default();
    let start = before.rfind('\n').map_or(0, |at| at + 1);
    let end = span.end + after.find('\n').unwrap_or(after.len());
    end.saturating_sub(start) <= LONGEST_PRINTED_LINE
}

/// The candidate nearest to a misspelt word, if one is near enough to be meant.
pub(super) fn nearest<'a>(word: &str, candidates: &[&'a str]) -> Option<&'a str> {
    let limit = (word.chars().count() / 3).max(1);
    candidates
        .iter()
        .map(|candidate| (edits(word, candidate), *candidate))
        .filter(|(distance, _)| *distance <= limit)
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, candidate)| candidate)
}

/// The number of edits between two words (Damerau-Levenshtein, neighbours exchanged counting one); words of more than
/// 40 letters are not compared.
fn edits(a: &str, b: &str) -> usize {
    let (a, b): (Vec<char>, Vec<char>) = (a.chars().take(41).collect(), b.chars().take(41).collect());
    if a.len() > 40 || b.len() > 40 {
        return usize::MAX;
    }
    let mut older: Vec<usize> = Vec::new();
    let mut above: Vec<usize> = (0..=b.len()).collect();
    for i in 0..a.len() {
        let mut row = vec![i + 1];
        for j in 0..b.len() {
            let substituted = above[j] + usize::from(a[i] != b[j]);
            let mut best = substituted.min(above[j + 1] + 1).min(row[j] + 1);
            if i > 0 && j > 0 && a[i] == b[j - 1] && a[i - 1] == b[j] {
                best = best.min(older[j - 1] + 1);
            }
            row.push(best);
        }
        older = std::mem::replace(&mut above, row);
    }
    above[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_word_is_suggested_only_if_near() {
        let keys = ["given", "solve", "symbols", "range"];
        assert_eq!(nearest("givne", &keys), Some("given"));
        assert_eq!(nearest("symbol", &keys), Some("symbols"));
        assert_eq!(nearest("colour", &keys), None);
        assert_eq!(nearest(&"x".repeat(100_000), &keys), None);
    }
}
