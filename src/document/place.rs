//! Places in a file: spans of bytes, texts that know where they stand, and lines counted from bytes.

use std::ops::Range;

/// A range of bytes in the file.
pub type Span = Range<usize>;

/// A value with its place in the file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Spanned<T> {
    /// The value.
    pub value: T,
    /// Where it stands.
    pub span: Span,
}

impl<T> Spanned<T> {
    /// A value at a place.
    pub fn new(value: T, span: Span) -> Self {
        Spanned { value, span }
    }
}

impl Spanned<String> {
    /// The text.
    pub fn as_str(&self) -> &str {
        &self.value
    }

    /// Whether the bytes at `span` are the text itself. They are not where the text was written with escapes (`"\\theta"`),
    /// or with macros: then the span is that of the whole value, which has another length than the text.
    pub fn is_verbatim(&self) -> bool {
        self.value.len() == self.span.len()
    }

    /// The place in the file of a part of the text, given in bytes from its beginning: exact where the text is
    /// [verbatim](Self::is_verbatim), otherwise the place of the whole value.
    pub fn place(&self, part: Span) -> Span {
        if self.is_verbatim() {
            let at = |offset: usize| self.span.start + offset.min(self.value.len());
            at(part.start)..at(part.end)
        } else {
            self.span.clone()
        }
    }
}

/// The beginnings of a text's lines, to count lines from bytes.
#[derive(Clone, Debug)]
pub struct Lines {
    starts: Vec<usize>,
}

impl Lines {
    /// Finds the lines of a text.
    pub fn new(source: &str) -> Self {
        let breaks = source.bytes().enumerate().filter(|(_, byte)| *byte == b'\n');
        Lines { starts: std::iter::once(0).chain(breaks.map(|(at, _)| at + 1)).collect() }
    }

    /// The line of a byte, counted from 1.
    pub fn line(&self, offset: usize) -> usize {
        self.starts.partition_point(|start| *start <= offset)
    }

    /// Where the line of a byte begins.
    pub fn start(&self, offset: usize) -> usize {
        self.starts.get(self.line(offset).saturating_sub(1)).copied().unwrap_or(0)
    }

    /// The line of a byte and its column in characters, both counted from 1. `source` is the text the lines are of.
    pub fn line_column(&self, source: &str, offset: usize) -> (usize, usize) {
        let line = self.line(offset);
        let start = self.start(offset);
        let before = source.as_bytes().get(start..offset.min(source.len())).unwrap_or_default();
        (line, String::from_utf8_lossy(before).chars().count() + 1)
    }
}

/// Whether only blanks and punctuation stand between two places.
pub(super) fn is_right_before(source: &str, formula: &Span, comment: &Span) -> bool {
    let between = source.get(formula.end..comment.start).unwrap_or("x");
    between
        .chars()
        .all(|c| c.is_whitespace() || matches!(c, '.' | ',' | ';' | ':' | ')' | '。' | '、' | '，' | '．' | '）'))
}

/// The first line of a range, to underline no more than that.
pub(super) fn first_line(source: &str, span: &Span) -> Span {
    let text = source.get(span.clone()).unwrap_or_default();
    let line = text.lines().next().unwrap_or_default();
    span.start..span.start + line.trim_end().len()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_and_columns_count_from_one_and_in_characters() {
        let source = "検算 x\n\nab";
        let lines = Lines::new(source);
        assert_eq!(lines.line_column(source, 0), (1, 1));
        assert_eq!(lines.line_column(source, 7), (1, 4));
        assert_eq!(lines.line(8), 1, "a line break belongs to the line it ends");
        assert_eq!(lines.line_column(source, 9), (2, 1));
        assert_eq!(lines.line_column(source, 11), (3, 2));
        assert_eq!(lines.line_column(source, 999), (3, 3));
    }

    #[test]
    fn a_part_of_an_escaped_text_has_the_whole_place() {
        let verbatim = Spanned::new("ab".to_owned(), 5..7);
        assert_eq!(verbatim.place(1..2), 6..7);
        let escaped = Spanned::new(r"\theta".to_owned(), 5..14);
        assert_eq!(escaped.place(1..2), 5..14);
    }
}
