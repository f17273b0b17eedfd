//! The labels that notes print beside their equations.
//!
//! A label looks like `1`, `52`, `12a`, `3.14`, `A.1`. It is found
//!
//! - in `\tag{..}` and `\tag*{..}`, where it may be anything;
//! - in `\label{..}`, the name by which the source calls what LaTeX numbers, if no `\tag` stands in the same row;
//! - in parentheses at the very end of a display, or of a row of an `aligned` or the like, if it stands apart: after
//!   `\quad`, `\qquad`, `~`, `\hfill`, `\hspace{..}`, after `&`, directly after the `\end{..}` of an environment with
//!   rows, or with nothing at all before it;
//! - in parentheses at the very end of a display or row without such a space, as scans have it (`x = y (12)`). This might
//!   be an argument or a factor, `f(2)`. It is a label only if nothing else labels the display *and* it continues the
//!   sequence: it is the label before plus one (`12` after `11`, `3.5` after `3.4`, `12b` after `12a`; `1` if there is
//!   none before).
//!
//! Labels of the first three kinds do not have to continue the sequence. A row label is only looked for in environments
//! whose rows are statements; in a matrix, an `array` or `cases` a `& (2)` is an entry.

use super::layout::{Layout, has_statements};
use super::place::Span;
use std::collections::HashSet;

/// A label as printed; places are bytes of the display's content.
#[derive(Clone, Debug, PartialEq)]
pub struct Printed {
    /// The label without parentheses.
    pub label: String,
    /// What to blank out: the label with its parentheses and the space or `&` before it.
    pub span: Span,
    /// The row it labels, by its number in [`Region::rows`] of the region it stands in; `None` for the display as a whole.
    pub row: Option<(usize, usize)>,
}

/// A part of a display whose rows may carry labels.
#[derive(Clone, Debug, PartialEq)]
pub struct Region {
    /// Its bytes.
    pub span: Span,
    /// Its rows without `\\`.
    pub rows: Vec<Span>,
}

/// The regions of a display: the whole of it if it has rows outside of environments or is an `align` or the like itself
/// (`environment`), else the environments in it whose rows are statements.
pub fn regions(content: &str, layout: &Layout, environment: Option<&str>) -> Vec<Region> {
    let whole = 0..content.len();
    if !layout.breaks.is_empty() || environment.is_some_and(has_statements) {
        let rows = super::layout::split(&whole, &layout.breaks);
        return vec![Region { span: whole, rows }];
    }
    let blocks = layout.blocks.iter().filter(|block| block.has_statements());
    blocks.map(|block| Region { span: block.inner.clone(), rows: block.rows() }).collect()
}

/// The labels printed in a display, in order. `previous` is the last label printed before it.
pub fn find(content: &str, layout: &Layout, regions: &[Region], previous: Option<&str>) -> Vec<Printed> {
    let mut certain: Vec<Printed> = Vec::new();
    let mut possible: Vec<Printed> = Vec::new();
    for (span, label) in &layout.tags {
        if !label.is_empty() {
            let span = space_before(content, span.start).0..span.end;
            certain.push(Printed { label: label.clone(), row: row_at(regions, span.end - 1), span });
        }
    }
    let mut tagged: HashSet<Option<(usize, usize)>> = certain.iter().map(|printed| printed.row).collect();
    for (span, label) in &layout.labels {
        let row = row_at(regions, span.start);
        if !label.is_empty() && tagged.insert(row) {
            certain.push(Printed { label: label.clone(), span: span.clone(), row });
        }
    }
    let rows = regions.iter().enumerate().flat_map(|(region, found)| {
        found.rows.iter().enumerate().map(move |(row, span)| (Some((region, row)), span.clone()))
    });
    let is_region = regions.iter().any(|region| region.span == (0..content.len()));
    let whole = (!is_region).then_some((None, 0..content.len()));
    for (row, span) in rows.chain(whole) {
        let Some(found) = content.get(span.clone()).and_then(trailing) else { continue };
        let place = span.start + found.span.start..span.start + found.span.end;
        let printed = Printed { label: found.label, span: place, row };
        if found.stands_apart { certain.push(printed) } else { possible.push(printed) }
    }
    if certain.is_empty() {
        certain.extend(possible.into_iter().rfind(|printed| follows(previous, &printed.label)));
    }
    certain.sort_by_key(|printed| printed.span.start);
    certain
}

/// The region and the row that hold a byte.
fn row_at(regions: &[Region], offset: usize) -> Option<(usize, usize)> {
    let region = regions.partition_point(|region| region.span.end <= offset);
    let rows = &regions.get(region).filter(|found| found.span.contains(&offset))?.rows;
    let row = rows.partition_point(|row| row.end <= offset);
    rows.get(row).filter(|found| found.contains(&offset)).map(|_| (region, row))
}

struct Trailing {
    label: String,
    span: Span,
    stands_apart: bool,
}

/// The label in parentheses at the end of a text.
fn trailing(text: &str) -> Option<Trailing> {
    let text = text.trim_end();
    let inside = text.strip_suffix(')')?;
    let label_start = inside.rfind(|c: char| !is_label_letter(c) && c != ' ')?;
    let label = inside.get(label_start..)?.strip_prefix('(')?.trim();
    if !is_label(label) {
        return None;
    }
    let (mut start, spaced) = space_before(text, label_start);
    let before = text.get(..start).unwrap_or_default();
    let after_ampersand = before.ends_with('&') && !ends_escaped(before);
    let stands_apart = spaced || after_ampersand || before.trim().is_empty() || ends_with_rows(before);
    if after_ampersand {
        start = space_before(text, start - 1).0;
    }
    Some(Trailing { label: label.to_owned(), span: start..text.len(), stands_apart })
}

fn is_label_letter(c: char) -> bool {
    c.is_ascii_alphanumeric() || matches!(c, '.' | '\'')
}

/// Whether a text looks like a label: parts joined by dots, the first a number or one capital letter, the others
/// numbers, then perhaps a small letter and primes.
fn is_label(text: &str) -> bool {
    let unprimed = text.trim_end_matches('\'');
    let stem = unprimed.strip_suffix(|c: char| c.is_ascii_lowercase()).unwrap_or(unprimed);
    let number = |part: &str| !part.is_empty() && part.len() <= 6 && part.bytes().all(|byte| byte.is_ascii_digit());
    let capital = |part: &str| part.len() == 1 && part.bytes().all(|byte| byte.is_ascii_uppercase());
    let mut parts = stem.split('.');
    let first = parts.next().unwrap_or_default();
    let rest: Vec<&str> = parts.collect();
    (number(first) || capital(first) && !rest.is_empty()) && rest.into_iter().all(number)
}

/// Whether a label continues the sequence after the label before.
fn follows(previous: Option<&str>, label: &str) -> bool {
    let Some(previous) = previous else { return label == "1" };
    successor(previous).is_some_and(|successors| successors.iter().any(|successor| successor == label))
}

/// The labels that may come after a label: `13` after `12`, `12b` and `13` after `12a`.
fn successor(label: &str) -> Option<Vec<String>> {
    let mut found = Vec::new();
    let mut stem = label.trim_end_matches('\'');
    if let Some(letter) = stem.bytes().last().filter(u8::is_ascii_lowercase) {
        stem = stem.get(..stem.len() - 1)?;
        found.push(format!("{stem}{}", char::from(letter + 1)));
    }
    let digits = stem.len() - stem.bytes().rev().take_while(u8::is_ascii_digit).count();
    let number: u64 = stem.get(digits..)?.parse().ok()?;
    found.push(format!("{}{}", stem.get(..digits)?, number.checked_add(1)?));
    Some(found)
}

/// Goes back from a place over blanks and spacing macros: where they begin, and whether there is a wide one.
fn space_before(text: &str, from: usize) -> (usize, bool) {
    let (mut at, mut wide) = (from, false);
    loop {
        let before = text.get(..at).unwrap_or_default().trim_end();
        let blank_escaped = ends_escaped_backslash(before) && before.len() < at;
        if blank_escaped {
            at = before.len() - 1;
            continue;
        }
        at = before.len();
        if let Some(rest) = before.strip_suffix('~').filter(|rest| !ends_escaped_backslash(rest)) {
            (at, wide) = (rest.len(), true);
            continue;
        }
        let Some((start, is_wide)) = spacing_macro_before(before) else { return (at, wide) };
        (at, wide) = (start, wide || is_wide);
    }
}

/// A spacing macro at the end of a text: where it begins and whether it is wide.
fn spacing_macro_before(text: &str) -> Option<(usize, bool)> {
    let start = text.rfind('\\')?;
    if text.len() - start > 30 || ends_escaped_backslash(text.get(..start)?) {
        return None;
    }
    match text.get(start..)? {
        r"\quad" | r"\qquad" | r"\hfill" | r"\enspace" => Some((start, true)),
        r"\," | r"\;" | r"\:" | r"\!" | r"\>" => Some((start, false)),
        other => {
            let (_, length) = super::layout::argument(other.strip_prefix(r"\hspace")?.trim_start_matches('*'), 20)?;
            other.ends_with('}').then_some((start, length > 2))
        }
    }
}

/// Whether a text ends with a backslash that is not itself escaped.
fn ends_escaped_backslash(text: &str) -> bool {
    text.bytes().rev().take_while(|byte| *byte == b'\\').count() % 2 == 1
}

/// Whether the last character of a text is escaped: `\&`.
fn ends_escaped(text: &str) -> bool {
    let mut chars = text.chars();
    chars.next_back();
    ends_escaped_backslash(chars.as_str())
}

/// Whether a text ends with the end of an environment whose rows are statements or cases.
fn ends_with_rows(text: &str) -> bool {
    let Some(start) = text.rfind(r"\end{") else { return false };
    let name = text.get(start + 5..).and_then(|rest| rest.strip_suffix('}')).unwrap_or_default();
    has_statements(name) || matches!(name, "cases" | "array")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels_after(previous: Option<&str>, content: &str) -> Vec<(String, String)> {
        let layout = Layout::of(content);
        let regions = regions(content, &layout, None);
        let found = find(content, &layout, &regions, previous);
        found.into_iter().map(|printed| (printed.label, content[printed.span].to_owned())).collect()
    }

    fn pairs(expected: &[(&str, &str)]) -> Vec<(String, String)> {
        expected.iter().map(|(label, text)| ((*label).to_owned(), (*text).to_owned())).collect()
    }

    #[test]
    fn labels_that_stand_apart() {
        for (content, label, text) in [
            (r"a = b \tag{52}", "52", r" \tag{52}"),
            (r"a = b \tag*{$*$}", "$*$", r" \tag*{$*$}"),
            (r"a = b \quad (52)", "52", r" \quad (52)"),
            (r"a = b,\qquad\quad(12a)", "12a", r"\qquad\quad(12a)"),
            ("a = b~(3.14) ", "3.14", "~(3.14)"),
            (r"a = b \hspace{2cm} (A.1)", "A.1", r" \hspace{2cm} (A.1)"),
            (r"a = b \hfill (7')", "7'", r" \hfill (7')"),
            (r"\begin{aligned} a \end{aligned} (9)", "9", " (9)"),
            (r"\begin{cases} a \end{cases}(9)", "9", "(9)"),
            ("(80)", "80", "(80)"),
            ("\n ( 80 ) \n", "80", "\n ( 80 )"),
        ] {
            assert_eq!(labels_after(None, content).last(), pairs(&[(label, text)]).first(), "{content}");
        }
    }

    #[test]
    fn what_looks_like_a_label_but_is_none() {
        for content in [
            "y = f(2)",
            "n (n-1)",
            r"a \quad (k \to -k)",
            r"a \quad (x)",
            r"\text{if } (3)",
            r"a \& (3)",
            "(A)",
            "()",
            ")",
            r"\begin{pmatrix} 1 & (2) \end{pmatrix}",
            r"\begin{cases} 1 & (2) \\ 3 & (4) \end{cases}",
            r"a \quad (1234567)",
            r"\begin{pmatrix} 1 \\ 2 \end{pmatrix} (5)",
            r"\quad (5) = a",
        ] {
            assert_eq!(labels_after(Some("40"), content), [], "{content}");
        }
    }

    #[test]
    fn an_attached_number_is_a_label_if_it_continues_the_sequence() {
        assert_eq!(labels_after(Some("11"), "x = y (12)"), pairs(&[("12", " (12)")]));
        assert_eq!(labels_after(Some("3.4"), r"x = y\, (3.5)"), pairs(&[("3.5", r"\, (3.5)")]));
        assert_eq!(labels_after(Some("12a"), "x = y (12b)"), pairs(&[("12b", " (12b)")]));
        assert_eq!(labels_after(Some("12a"), "x = y (13)"), pairs(&[("13", " (13)")]));
        assert_eq!(labels_after(None, "x = y (1)"), pairs(&[("1", " (1)")]));
        assert_eq!(labels_after(Some("11"), "x = f(13)"), []);
        assert_eq!(labels_after(None, "x = f(2)"), []);
        assert_eq!(labels_after(Some("11"), r"x = f(12) \quad (13)"), pairs(&[("13", r" \quad (13)")]));
        assert_eq!(labels_after(Some("11"), r"\begin{aligned} x &= f(12) & (13) \end{aligned}").len(), 1);
        assert_eq!(
            labels_after(Some("11"), r"\begin{aligned} x &= y (12) \\ &= z \end{aligned}"),
            pairs(&[("12", " (12)")])
        );
    }

    #[test]
    fn rows_carry_labels_of_their_own() {
        let content = r"\begin{aligned} P &= a & (5) \\ &= b \\ &= c \quad (6) \end{aligned}";
        assert_eq!(labels_after(None, content), pairs(&[("5", " & (5)"), ("6", r" \quad (6)")]));
        let layout = Layout::of(content);
        let regions = regions(content, &layout, None);
        let rows: Vec<_> = find(content, &layout, &regions, None).into_iter().map(|printed| printed.row).collect();
        assert_eq!(rows, [Some((0, 0)), Some((0, 2))]);
    }
}
