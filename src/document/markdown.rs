//! Notes in Markdown.
//!
//! Three passes: the Markdown parser finds the code, in which nothing is an equation; then the displays and comments are
//! found (`scan`) and masked by filler of the same length; then the Markdown parser, no longer irritated by
//! formulas, finds the headings and the inline formulas. What was found is put together in the order of the file.
//!
//! An equation without a printed label is called by the last printed label before it and a running number (`8+1`). If a
//! label is printed a second time, that is a problem, and the second equation is called as if it had none.

use super::assembly::{Assembly, Part};
use super::files::{Beside, Files};
use super::layout::trimmed;
use super::place::Span;
use super::references::Language;
use super::scan::{Found, scan};
use super::sidecar::Sidecar;
use super::{Document, Section, dialect};
use crate::latex::expand::Macros;
use pulldown_cmark::{Event, Options, Parser, Tag, TagEnd};
use std::path::Path;

/// Reads notes from a Markdown text, with their sidecar.
pub fn parse(path: &Path, source: &str, beside: &dyn Beside) -> Document {
    let code = code(source);
    let (mut found, mut problems) = scan(source, &code);
    found.extend(dialect::fences(source, &code));
    found.sort_by_key(|found| found.span().start);
    dialect::name(source, &mut found);
    let (definitions, places, in_force) = dialect::definitions(source, &code, &found);
    let clean = dialect::blanked(source, &places);
    let mut parts: Vec<Part> = in_force.into_iter().map(|(at, count)| Part::Defined(at, count)).collect();
    parts.extend(structure(source, &found));
    let unread = found
        .iter()
        .map(|found| found.span().clone())
        .chain(code.iter().filter(|span| !is_role(source, span)).cloned());
    let prose = dialect::blanked(source, &unread.collect::<Vec<_>>());
    parts.extend(found.into_iter().filter(|found| !holds_nothing(&clean, found)).map(Part::Found));
    parts.sort_by_key(Part::start);
    let (mut whole, mut files) = (source.to_owned(), Files::single(path, source));
    let macros = Macros::all(&definitions);
    let sidecar = Sidecar::read(path, beside, &mut whole, &mut files, &macros, &mut problems);
    let mut assembly = Assembly::new(&whole, &clean, files, definitions, problems).beside(sidecar);
    for part in parts {
        assembly.add(part);
    }
    assembly.check_references(&prose, Language::Markdown);
    let heading = assembly.highest_heading().filter(|section| section.level == 1).map(|section| section.title.clone());
    assembly.document(path, dialect::title(source).or(heading))
}

/// Whether a code span is the label of one of MyST's references: `` {eq}`foo` ``.
fn is_role(source: &str, code: &Span) -> bool {
    source.get(..code.start).is_some_and(|before| before.ends_with("{eq}"))
}

/// Whether a display holds nothing but definitions.
fn holds_nothing(clean: &str, found: &Found) -> bool {
    let Found::Display { content, .. } = found else { return false };
    clean.get(content.clone()).is_some_and(|content| content.trim().is_empty())
}

/// The code blocks and code spans of a Markdown text, in order.
fn code(source: &str) -> Vec<Span> {
    Parser::new_ext(source, Options::ENABLE_YAML_STYLE_METADATA_BLOCKS)
        .into_offset_iter()
        .filter(|(event, _)| matches!(event, Event::Start(Tag::CodeBlock(_) | Tag::MetadataBlock(_)) | Event::Code(_)))
        .map(|(_, span)| span)
        .collect()
}

/// The headings and inline formulas of a text in which displays and comments have been found.
fn structure(source: &str, found: &[Found]) -> Vec<Part> {
    let masked = mask(source, found);
    let mut parts = Vec::new();
    let mut heading: Option<Section> = None;
    let options = Options::ENABLE_MATH | Options::ENABLE_YAML_STYLE_METADATA_BLOCKS;
    for (event, span) in Parser::new_ext(&masked, options).into_offset_iter() {
        let mut title = |text: &str| {
            if let Some(section) = &mut heading {
                section.title.push_str(text);
            }
        };
        match event {
            Event::Start(Tag::Heading { level, .. }) => {
                heading = Some(Section { title: String::new(), level: level as u8, span: trimmed(source, span) });
            }
            Event::End(TagEnd::Heading(_)) => parts.extend(heading.take().and_then(|section| finished(section, found))),
            Event::InlineMath(formula) => {
                title(&format!("${formula}$"));
                parts.push(Part::Formula(span.clone(), span.start + 1..span.end - 1));
            }
            Event::Text(text) | Event::Code(text) => title(&text),
            Event::SoftBreak | Event::HardBreak => title(" "),
            _ => {}
        }
    }
    parts
}

/// A heading whose events have all been read. A display above a line of `---` is a heading to a Markdown parser, but not
/// to a reader.
fn finished(mut section: Section, found: &[Found]) -> Option<Part> {
    let first = found.partition_point(|found| found.span().end <= section.span.start);
    let mut within = found.iter().skip(first).take_while(|found| found.span().start < section.span.end);
    if within.any(|found| !matches!(found, Found::Comment { .. })) {
        return None;
    }
    section.title = section.title.trim().to_owned();
    Some(Part::Heading(section))
}

/// The text with displays replaced by a word, and comments by comments in one line, each of the same length.
fn mask(source: &str, found: &[Found]) -> String {
    let mut masked = String::with_capacity(source.len());
    let mut at = 0;
    for found in found {
        let span = found.span();
        masked.push_str(source.get(at..span.start).unwrap_or_default());
        match found {
            Found::Comment { content, .. } => {
                masked.push_str("<!--");
                masked.extend(std::iter::repeat_n('x', content.len()));
                masked.push_str("-->");
            }
            _ => masked.extend(std::iter::repeat_n('x', span.len())),
        }
        at = span.end;
    }
    masked.push_str(source.get(at..).unwrap_or_default());
    if let Some(rest) = masked.strip_prefix('\u{feff}') {
        masked = format!("   {rest}");
    }
    masked
}
