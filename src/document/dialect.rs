//! What the dialects of Markdown do differently: labels beside displays, displays in fences, definitions of macros, and
//! a title in the front matter.
//!
//! - Quarto and Pandoc: `$$ .. $$ {#eq-foo}`; Pandoc's numbered examples: `(@foo) $$ .. $$`;
//! - MyST: `$$ .. $$ (foo)`, and a fence ```` ```{math} ```` with a line `:label: foo`;
//! - `\newcommand` and the like, in the text, in displays and in inline formulas, as Pandoc and MathJax read them.

use super::place::Span;
use super::scan::Found;
use crate::latex::ParseError;
use crate::latex::expand::{Defined, Definitions, MOST_FAULTS, definition, is_definition};

/// The displays in fences for mathematics, in order.
pub(super) fn fences(source: &str, code: &[Span]) -> Vec<Found> {
    code.iter().filter_map(|span| fence(source, span)).collect()
}

/// The display in a code block, if its language is `{math}`.
fn fence(source: &str, span: &Span) -> Option<Found> {
    let block = source.get(span.clone())?;
    let opening = block.lines().next()?.trim_start_matches([' ', '`', '~', ':']);
    let argument = opening.strip_prefix("{math}")?.trim();
    let mut name = None;
    let mut at = span.start + block.find('\n')? + 1;
    let body = source.get(at..span.end)?;
    for line in body.split_inclusive('\n') {
        let option = line.trim();
        if let Some(label) = option.strip_prefix(":label:").or_else(|| option.strip_prefix(":name:")) {
            let label = label.trim();
            let start = at + line.find(label).unwrap_or(0);
            name = Some((label.to_owned(), start..start + label.len()));
        } else if !(option.is_empty() || option.starts_with(':') && option.get(1..)?.contains(':')) {
            break;
        }
        at += line.len();
    }
    let end = closing(source, span).max(at);
    let content = at..end;
    let filled = source.get(content.clone()).is_some_and(|content| !content.trim().is_empty());
    (filled && argument.is_empty()).then(|| Found::Display { span: span.clone(), content, environment: None, name })
}

/// Where the line begins that closes a fence; the end where it is not closed.
fn closing(source: &str, span: &Span) -> usize {
    let block = source.get(span.clone()).unwrap_or_default().trim_end();
    let start = block.rfind('\n').map_or(0, |at| at + 1);
    let last = block.get(start..).unwrap_or_default().trim();
    let closes = last.len() >= 3 && last.chars().all(|c| matches!(c, '`' | '~' | ':'));
    span.start + if closes { start } else { block.len() }
}

/// Gives displays the labels that stand beside them; these belong to the display.
pub(super) fn name(source: &str, found: &mut [Found]) {
    for found in found {
        let Found::Display { span, name, .. } = found else { continue };
        if name.is_some() {
            continue;
        }
        if let Some((label, place)) = behind(source, span.end) {
            span.end = place.end + 1;
            *name = Some((label, place));
        } else {
            *name = before(source, span.start);
        }
    }
}

/// The longest label with what stands around it, in bytes.
const LONGEST: usize = 300;

/// The text from a place on, up to so many bytes.
pub(super) fn near(text: &str, from: usize, longest: usize) -> &str {
    let rest = text.get(from..).unwrap_or_default();
    rest.get(..rest.floor_char_boundary(longest)).unwrap_or_default()
}

/// `{#eq-foo}` or `(foo)` behind a display, in its line.
fn behind(source: &str, end: usize) -> Option<(String, Span)> {
    let line = near(source, end, LONGEST).lines().next()?;
    let start = end + (line.len() - line.trim_start().len());
    let rest = line.trim_start();
    if let Some(attributes) = rest.strip_prefix('{') {
        let attributes = attributes.get(..attributes.find('}')?)?;
        let label = attributes.split_whitespace().find_map(|part| part.strip_prefix('#'))?;
        let place = start + 1..start + 1 + attributes.len();
        return is_name(label).then(|| (label.to_owned(), place));
    }
    let label = rest.strip_prefix('(')?.split(')').next()?;
    let ends_line = rest.get(label.len() + 2..).is_some_and(|rest| rest.trim().is_empty());
    let marked = label.contains([':', '-', '_']) || label.bytes().all(|byte| byte.is_ascii_digit());
    (ends_line && marked && is_name(label)).then(|| (label.to_owned(), start + 1..start + 1 + label.len()))
}

/// `(@foo)` before a display, alone in its line.
fn before(source: &str, start: usize) -> Option<(String, Span)> {
    let begin = source.floor_char_boundary(start.saturating_sub(LONGEST));
    let line = source.get(begin..start)?.rsplit('\n').next()?;
    let label = line.trim().strip_prefix("(@")?.strip_suffix(')')?;
    let begin = start - line.len() + line.find("(@")? + 2;
    is_name(label).then(|| (label.to_owned(), begin..begin + label.len()))
}

fn is_name(label: &str) -> bool {
    !label.is_empty()
        && label.len() < 200
        && label.chars().all(|c| c.is_alphanumeric() || matches!(c, ':' | '-' | '_' | '.'))
}

/// The definitions of macros in a text, outside of its code and its comments: their places, and how many are in force
/// from where on. Those in a display hold in all of it.
pub(super) fn definitions(
    source: &str,
    code: &[Span],
    found: &[Found],
) -> (Definitions, Vec<Span>, Vec<(usize, usize)>) {
    let mut all = Definitions::default();
    let (mut places, mut in_force) = (Vec::new(), Vec::new());
    let (mut code, mut found) = (code.iter().peekable(), found.iter().peekable());
    let (mut at, mut faults) = (0, 0);
    while let Some(ahead) = source.get(at..).and_then(|rest| rest.find('\\')) {
        at += ahead;
        while code.next_if(|span| span.end <= at).is_some() {}
        while found.next_if(|found| found.span().end <= at).is_some() {}
        let display = found.peek().filter(|found| found.span().contains(&at));
        if let Some(passed) = code.peek().filter(|span| span.contains(&at) && display.is_none()) {
            at = passed.end;
        } else if let Some(Found::Comment { span, .. }) = display {
            at = span.end;
        } else {
            let rest = source.get(at..).unwrap_or_default();
            let from = display.map_or(at, |display| display.span().start);
            let next = 1 + rest.get(1..).and_then(|rest| rest.chars().next()).map_or(0, char::len_utf8);
            at += match defined(rest).filter(|_| faults < MOST_FAULTS) {
                Some((length, Ok(found))) => {
                    all.define(found);
                    places.push(at..at + length);
                    in_force.push((from, all.count()));
                    length
                }
                Some((_, Err(_))) => {
                    faults += 1;
                    next
                }
                None => next,
            };
        }
    }
    (all, places, in_force)
}

/// The definition that a text begins with, and its length.
fn defined(rest: &str) -> Option<(usize, Result<Defined, ParseError>)> {
    let name = rest.get(1..)?;
    let name = name.get(..name.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(name.len()))?;
    is_definition(name).then(|| definition(rest))?
}

/// A text in which ranges are blank.
pub(super) fn blanked(source: &str, places: &[Span]) -> String {
    let mut bytes = source.as_bytes().to_vec();
    for span in places {
        if let Some(part) = bytes.get_mut(span.clone()) {
            part.iter_mut().filter(|byte| **byte != b'\n').for_each(|byte| *byte = b' ');
        }
    }
    String::from_utf8(bytes).unwrap_or_else(|_| source.to_owned())
}

/// The title that the front matter gives.
pub(super) fn title(source: &str) -> Option<String> {
    let mut lines = source.trim_start_matches('\u{feff}').lines();
    lines.next().filter(|line| line.trim_end() == "---")?;
    let matter = lines.take(200).take_while(|line| !matches!(line.trim_end(), "---" | "..."));
    let title = matter.filter_map(|line| line.strip_prefix("title:")).next()?.trim();
    let quoted = |quote: char| title.strip_prefix(quote).and_then(|title| title.strip_suffix(quote));
    let title = quoted('"').or_else(|| quoted('\'')).unwrap_or(title).trim();
    (!title.is_empty() && !matches!(title.chars().next(), Some('|' | '>' | '{' | '['))).then(|| title.to_owned())
}
