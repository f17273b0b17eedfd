//! Which equations the prose around an equation names: "from (3) and (5)", `\eqref{eq:gauss}`, `@eq-gauss`.

use std::collections::BTreeSet;

use crate::check::Book;
use crate::document::Document;

/// The longest stretch of prose that is looked through, in bytes.
const LONGEST: usize = 4000;

/// The equations, by their numbers in the book, that the prose before an equation names, back to the display before it,
/// or that the sentence after it names.
pub fn named(book: &Book, document: &Document, index: usize) -> BTreeSet<usize> {
    let own = &book.entries[index].equation.span;
    let before = book.entries.iter().take(index).rev().map(|e| e.equation.span.end).find(|end| *end <= own.start);
    let after = book.entries.iter().skip(index + 1).map(|e| e.equation.span.start).find(|start| *start >= own.end);
    let from = before.unwrap_or(0).max(own.start.saturating_sub(LONGEST));
    let to = after.unwrap_or(document.source.len()).min(own.end + LONGEST);
    let prose = |range: std::ops::Range<usize>| {
        let start = (range.start..=range.end).find(|k| document.source.is_char_boundary(*k)).unwrap_or(range.end);
        document.source.get(start..floor(&document.source, range.end)).unwrap_or_default()
    };
    let behind = prose(own.end..to);
    let sentence = behind.split_inclusive(['.', '。']).next().unwrap_or_default();
    let texts = [prose(from..own.start), sentence];
    let is_named = |label: &str| {
        let spellings = [format!("({label})"), format!("{{{label}}}"), format!("（{label}）"), format!("@{label}")];
        texts.iter().any(|text| spellings.iter().any(|s| text.contains(s)))
    };
    (0..book.entries.len()).filter(|k| *k != index && is_named(&book.entries[*k].equation.label)).collect()
}

fn floor(text: &str, mut at: usize) -> usize {
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    at
}
