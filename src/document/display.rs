//! From a display to the equations in it: which rows belong to which label, and what is blanked out.
//!
//! A display with one label, or none, is one equation: its whole content. Where several rows carry labels, the equation
//! of a label is what stands after the previous label's row, up to and including its own row; rows after the last label
//! go to the last.

use super::label::{self, Printed, Region};
use super::layout::{Block, Layout, first_ampersand, has_statements, trimmed};
use super::place::{Span, Spanned};
use super::problem::Problem;
use super::tex::number::{self, Counter, has_numbered_rows};

/// A display that has been taken apart. Places in it are bytes of the file.
pub(super) struct Display<'a> {
    source: &'a str,
    content: Span,
    layout: Layout,
    regions: Vec<Region>,
    /// The labels printed in it; their places are bytes of its content.
    pub(super) printed: Vec<Printed>,
    /// What is blanked out, in order.
    noise: Vec<Span>,
}

/// The part of a display that is one equation.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Part {
    /// Its LaTeX in the file.
    pub(super) span: Span,
    /// Its printed label and the label's place in the file.
    pub(super) label: Option<(String, Span)>,
    /// Other names of it: what `\label` calls it beside a `\tag`.
    pub(super) names: Vec<String>,
    /// The bytes of the display's content that belong to it.
    pub(super) rows: Span,
}

/// A block whose rows are to be equations of their own.
pub(super) struct BlockRows {
    /// What stands before the block, masked.
    pub(super) prefix: String,
    /// The rows, or their first cells.
    pub(super) rows: Vec<Span>,
    /// Whether rows can be joined: not where they are cells.
    joinable: bool,
}

impl BlockRows {
    /// Whether each row has a label, or is a row that can belong to the label below.
    pub(super) fn accepts(&self, labels: &[Spanned<String>]) -> bool {
        let given = |label: &Spanned<String>| !label.value.is_empty();
        labels.iter().all(given) || (self.joinable && labels.last().is_some_and(given))
    }

    /// The labels with their rows. Rows with an empty label belong to the next label below.
    pub(super) fn labelled<'l>(&self, labels: &'l [Spanned<String>]) -> Vec<(&'l Spanned<String>, Span)> {
        let mut start = None;
        let mut found = Vec::new();
        for (label, row) in labels.iter().zip(&self.rows) {
            let from = *start.get_or_insert(row.start);
            if !label.value.is_empty() {
                found.push((label, from..row.end));
                start = None;
            }
        }
        found
    }
}

impl<'a> Display<'a> {
    /// Takes the display at `content` apart. `line` is where the line begins that it is opened in; `previous` is the last
    /// label printed before it.
    pub(super) fn new(
        source: &'a str,
        content: Span,
        line: usize,
        environment: Option<&str>,
        previous: Option<&str>,
    ) -> Self {
        let quote_marks = quote_marks(source, line, &content);
        let content = without_quote_marks(source, content, &quote_marks);
        let text = source.get(content.clone()).unwrap_or_default();
        let layout = Layout::of(text);
        let regions = label::regions(text, &layout, environment);
        let printed = label::find(text, &layout, &regions, previous);
        let mut noise: Vec<Span> = printed.iter().map(|printed| printed.span.clone()).collect();
        noise.extend(layout.silent.iter().cloned());
        noise.iter_mut().for_each(|span| *span = content.start + span.start..content.start + span.end);
        noise.extend(quote_marks);
        noise.sort_by_key(|span| span.start);
        Display { source, content, layout, regions, printed, noise }
    }

    fn text(&self) -> &'a str {
        self.source.get(self.content.clone()).unwrap_or_default()
    }

    /// The place in the file of a range of the content, without the blanks at its ends.
    fn place(&self, range: Span) -> Span {
        let range = trimmed(self.text(), range);
        self.content.start + range.start..self.content.start + range.end
    }

    fn label_of(&self, printed: &Printed) -> (String, Span) {
        let place = |at: usize| self.content.start + at;
        (printed.label.clone(), place(printed.span.start)..place(printed.span.end))
    }

    /// The bytes of the file at a range of it, with everything blank that is not mathematics.
    pub(super) fn masked(&self, span: Span) -> String {
        let latex = self.source.get(span.clone()).unwrap_or_default();
        let mut bytes = latex.as_bytes().to_vec();
        let first = self.noise.partition_point(|noise| noise.end <= span.start);
        for noise in self.noise.iter().skip(first).take_while(|noise| noise.start < span.end) {
            let range = noise.start.saturating_sub(span.start)..noise.end.min(span.end) - span.start;
            if let Some(part) = bytes.get_mut(range) {
                part.fill(b' ');
            }
        }
        String::from_utf8(bytes).unwrap_or_else(|_| latex.to_owned())
    }

    /// Its equations.
    pub(super) fn parts(&self, problems: &mut Vec<Problem>) -> Vec<Part> {
        if self.printed.len() > 1 {
            if let Some(parts) = self.labelled_rows() {
                return parts;
            }
            let (first, second) = (self.label_of(&self.printed[0]), self.label_of(&self.printed[1]));
            let problem = Problem::error("document::several_labels", "this display has several labels", first.1);
            problems.push(
                problem
                    .label(format!("taken to be its label: {}", first.0))
                    .other(second.1, format!("passed over: {}", second.0))
                    .help("give each row of one `aligned` at most one label"),
            );
        }
        let label = self.printed.first().map(|printed| self.label_of(printed));
        vec![self.part(0..self.content.len(), label)]
    }

    fn part(&self, rows: Span, label: Option<(String, Span)>) -> Part {
        let inside = within(&self.layout.labels, &rows);
        let other = |name: &&String| label.as_ref().is_none_or(|(label, _)| *label != **name);
        let names = inside.iter().map(|(_, name)| name).filter(other).cloned().collect();
        Part { span: self.place(rows.clone()), label, names, rows }
    }

    /// The numbers that LaTeX prints beside its rows, with the bytes of the content where the rows begin.
    pub(super) fn numbers(&self, environment: Option<&str>, counter: &mut Counter) -> Vec<(usize, String)> {
        let Some(environment) = environment.filter(|name| number::is_numbered(name)) else { return Vec::new() };
        let rows = match self.regions.as_slice() {
            [region] if has_numbered_rows(environment) => region.rows.clone(),
            _ => std::iter::once(0..self.content.len()).collect(),
        };
        let unnumbered = |span: &&Span| self.text().get((*span).clone()).is_some_and(|text| text.starts_with(r"\no"));
        let silent: Vec<(Span, ())> = self.layout.silent.iter().filter(unnumbered).map(|s| (s.clone(), ())).collect();
        let own = |row: &Span| within(&silent, row).is_empty() && within(&self.layout.tags, row).is_empty();
        rows.into_iter().filter(own).map(|row| (row.start, counter.next_number())).collect()
    }

    /// One equation for each label, if all of them label different rows of one region.
    fn labelled_rows(&self) -> Option<Vec<Part>> {
        let number = self.printed.iter().find_map(|printed| printed.row)?.0;
        let region = self.regions.get(number)?;
        let mut parts = Vec::new();
        let (mut start, mut next_row) = (region.span.start, 0);
        for printed in &self.printed {
            let row = match printed.row {
                Some((other, _)) if other != number => return None,
                Some((_, row)) => row,
                None if printed.span.start >= region.span.end => region.rows.len().checked_sub(1)?,
                None => return None,
            };
            if row < next_row {
                return None;
            }
            let end = region.rows.get(row)?.end;
            parts.push((start..end, self.label_of(printed)));
            next_row = row + 1;
            start = region.rows.get(next_row).map_or(region.span.end, |row| row.start);
        }
        parts.last_mut()?.0.end = region.span.end;
        Some(parts.into_iter().map(|(span, label)| self.part(span, Some(label))).collect())
    }

    /// The rows of its outermost block: of `cases` and the like the first cells, of `aligned` and the like the rows.
    pub(super) fn block_rows(&self) -> Option<BlockRows> {
        if let [region] = self.regions.as_slice()
            && region.span == (0..self.content.len())
        {
            let rows = self.written_rows(&region.rows);
            return Some(BlockRows { prefix: String::new(), rows, joinable: true });
        }
        let block: &Block = match self.layout.blocks.as_slice() {
            [block] => block,
            _ => return None,
        };
        let start = self.place(0..self.content.len()).start;
        let prefix = self.masked(start..self.content.start + block.span.start);
        let braces = [r"\left\{", r"\left\lbrace", r"\left.", r"\{", r"\lbrace"];
        let blank = prefix.trim_end();
        let prefix = braces.iter().find_map(|brace| blank.strip_suffix(brace)).unwrap_or(&prefix).to_owned();
        let mut rows = block.rows();
        if !has_statements(&block.name) {
            rows.iter_mut().for_each(|row| row.end = self.first_cell_end(row));
        }
        Some(BlockRows { prefix, rows: self.written_rows(&rows), joinable: has_statements(&block.name) })
    }

    /// The places in the file of the rows that hold something.
    fn written_rows(&self, rows: &[Span]) -> Vec<Span> {
        rows.iter().map(|row| self.place(row.clone())).filter(|row| !row.is_empty()).collect()
    }

    /// Where a row's first cell ends, the comma before the `&` not included.
    fn first_cell_end(&self, row: &Span) -> usize {
        let text = self.text().get(row.clone()).unwrap_or_default();
        let cell = text.get(..first_ampersand(text).unwrap_or(text.len())).unwrap_or_default();
        row.start + cell.trim_end().trim_end_matches([',', ';']).len()
    }
}

/// Those of some places, in order, that begin in a range.
fn within<'s, T>(places: &'s [(Span, T)], range: &Span) -> &'s [(Span, T)] {
    let first = places.partition_point(|(place, _)| place.start < range.start);
    let behind = places.partition_point(|(place, _)| place.start < range.end);
    places.get(first..behind).unwrap_or_default()
}

/// A display's content without the blanks and quote marks at its ends.
fn without_quote_marks(source: &str, content: Span, marks: &[Span]) -> Span {
    let mut content = trimmed(source, content);
    for mark in marks {
        if mark.start != content.start || content.is_empty() {
            break;
        }
        content = trimmed(source, mark.end.min(content.end)..content.end);
    }
    for mark in marks.iter().rev() {
        if mark.end != content.end || content.is_empty() {
            break;
        }
        content = trimmed(source, content.start..mark.start);
    }
    content
}

/// The `>` at the beginning of the lines of a display that stands in a block quote, if `line`, where it is opened, begins
/// with such marks. Only the first 100 characters of a line are marks.
fn quote_marks(source: &str, line: usize, content: &Span) -> Vec<Span> {
    let line = source.get(line..content.start).unwrap_or_default();
    let is_mark = |c: &char| matches!(c, ' ' | '\t' | '>');
    let depth = line.chars().take(100).take_while(is_mark).filter(|c| *c == '>').count();
    let mut marks = Vec::new();
    if depth == 0 {
        return marks;
    }
    let text = source.get(content.clone()).unwrap_or_default();
    for (at, _) in text.match_indices('\n') {
        let line = text.get(at + 1..).unwrap_or_default();
        let prefix = line.char_indices().take(100).take_while(|(_, c)| is_mark(c)).filter(|(_, c)| *c == '>');
        marks.extend(prefix.take(depth).map(|(mark, _)| {
            let mark = content.start + at + 1 + mark;
            mark..mark + 1
        }));
    }
    marks
}
