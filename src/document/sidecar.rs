//! Sidecars: annotations of notes that must not be touched, in `NAME.kenzan.toml` beside `NAME.md` or `NAME.tex`.
//!
//! The keys are those of annotations: declarations at the top hold for all of the notes, those under `[section."Title"]`
//! for that section, and `[equation."52"]` is the annotation of equation 52 (its label, or the number that LaTeX prints).
//! What an annotation in the notes says goes before what the sidecar says of the same equation; where both have the same
//! key, that is a warning.

use super::annotation::{self, EquationAnnotation};
use super::assembly::Assembly;
use super::declaration::{self, Declarations};
use super::files::{Beside, Files};
use super::place::{Span, Spanned, first_line};
use super::problem::{Problem, nearest};
use super::toml::{self, Reader, Table, Value};
use super::{Equation, Item};
use crate::latex::expand::Macros;
use std::path::Path;

/// What a sidecar says that has not yet been put in its place.
pub(super) struct Sidecar {
    /// Where its text begins in the source.
    start: usize,
    /// What holds everywhere.
    pub(super) declarations: Option<Declarations>,
    sections: Vec<(Spanned<String>, Option<Declarations>)>,
    equations: Vec<(Spanned<String>, Option<EquationAnnotation>)>,
}

impl Sidecar {
    /// Reads the sidecar of notes, if there is one; its text is added to the source.
    pub(super) fn read(
        notes: &Path,
        beside: &dyn Beside,
        source: &mut String,
        files: &mut Files,
        macros: &Macros,
        problems: &mut Vec<Problem>,
    ) -> Option<Sidecar> {
        let path = notes.with_extension("kenzan.toml");
        let text = beside.text(&path)?;
        source.push('\n');
        let start = source.len();
        let file = files.add(&path, &text);
        files.piece(start, file, 0);
        source.push_str(&text);
        let table = toml::parse(toml::Source { text: &text, offset: start, macros }, problems)?;
        let mut sidecar = Sidecar { start, declarations: None, sections: Vec::new(), equations: Vec::new() };
        sidecar.take(table, &mut Reader { problems });
        Some(sidecar)
    }

    fn take(&mut self, table: Table, reader: &mut Reader) {
        let mut known = declaration::KEYS.to_vec();
        known.extend(["equation", "section"]);
        let mut declared = Table::new();
        for (key, value) in table {
            match key.as_str() {
                "equation" => {
                    for (label, value) in reader.table(&key, &value, "[equation.\"52\"]") {
                        let span = label.span.clone();
                        let table = annotated(label, value, reader);
                        self.equations.push((label.clone(), Some(annotation::equation(&table, span, reader))));
                    }
                }
                "section" => {
                    for (title, value) in reader.table(&key, &value, "[section.\"Title\"]") {
                        let span = title.span.clone();
                        let table = reader.table(title, value, "[section.\"Title\".symbols]").to_vec();
                        for (key, _) in table.iter().filter(|(key, _)| !declaration::KEYS.contains(&key.as_str())) {
                            reader.unknown(key, "a section", &declaration::KEYS);
                        }
                        let declarations = declaration::declarations(&table, span, reader);
                        self.sections.push((title.clone(), Some(declarations)));
                    }
                }
                name if declaration::KEYS.contains(&name) => declared.push((key, value)),
                _ => reader.unknown(&key, "a sidecar", &known),
            }
        }
        if let (Some(first), Some(last)) = (declared.first(), declared.last()) {
            let span = first.0.span.start..last.0.span.end;
            self.declarations = Some(declaration::declarations(&declared, span, reader));
        }
    }

    /// The declarations for a section, once.
    pub(super) fn section(&mut self, title: &str) -> Option<Declarations> {
        self.sections.iter_mut().find(|(name, _)| name.value == title)?.1.take()
    }

    /// The annotation for an equation, once.
    fn equation(&mut self, equation: &Equation) -> Option<EquationAnnotation> {
        self.equations.iter_mut().find(|(name, _)| equation.is_called(&name.value))?.1.take()
    }

    /// Whether a place in the source is in it.
    pub(super) fn holds(&self, span: &Span) -> bool {
        span.start >= self.start
    }
}

/// The keys of an equation; keys that are not known are reported.
fn annotated(label: &Spanned<String>, value: &Value, reader: &mut Reader) -> Table {
    let mut table = reader.table(label, value, "[equation.\"52\"]").to_vec();
    annotation::about(&table, reader);
    // The key says already which equation is meant.
    if let Some(at) = table.iter().position(|(key, _)| key.as_str() == "for") {
        let (key, _) = table.remove(at);
        let known: Vec<&str> = annotation::KEYS.into_iter().filter(|key| *key != "for").collect();
        reader.unknown(&key, "a sidecar's equation", &known);
    }
    table
}

impl Assembly<'_> {
    /// Whether a place is in the sidecar.
    pub(super) fn is_beside(&self, span: &Span) -> bool {
        self.sidecar.as_ref().is_some_and(|sidecar| sidecar.holds(span))
    }

    /// Gives the equations from an item on what the sidecar says of them.
    pub(super) fn annotate_beside(&mut self, first: usize) {
        let Some(sidecar) = &mut self.sidecar else { return };
        let mut found = Vec::new();
        for item in self.items.iter().skip(first) {
            if let Item::Equation(equation) = item
                && let Some(annotation) = sidecar.equation(equation)
            {
                let label = Spanned::new(equation.label.clone(), annotation.span.clone());
                let for_label = Some(label).filter(|_| annotation.rows.is_empty());
                found.push(EquationAnnotation { for_label, ..annotation });
            }
        }
        for annotation in found {
            self.annotate(annotation);
        }
    }

    /// Keys that the notes and the sidecar both have for an equation; `places` are those of the sidecar and of the notes.
    pub(super) fn said_twice(&mut self, label: &str, keys: &[&str], [beside, here]: [Span; 2]) {
        if keys.is_empty() {
            return;
        }
        let message = format!("the notes say `{}` of equation {label}, too", keys.join("`, `"));
        let problem = Problem::warning("document::said_twice", message, beside);
        let here = first_line(self.source, &here);
        self.problems.push(problem.label("passed over").other(here, "this holds").help("leave out one of them"));
    }

    /// Reports what the sidecar says of equations and sections that do not exist.
    pub(super) fn check_sidecar(&mut self) {
        let Some(sidecar) = self.sidecar.take() else { return };
        let mut labels: Vec<&str> = Vec::new();
        let mut titles: Vec<&str> = Vec::new();
        for item in &self.items {
            match item {
                Item::Section(section) => titles.push(&section.title),
                Item::Equation(equation) => {
                    labels.push(&equation.label);
                    labels.extend(equation.numbers.iter().map(String::as_str));
                }
                Item::Declarations(_) => {}
            }
        }
        let equations = sidecar.equations.iter().filter(|(_, left)| left.is_some());
        let problems = equations.map(|(label, _)| missing("equation", label, &labels));
        let sections = sidecar.sections.iter().filter(|(_, left)| left.is_some());
        let problems = problems.chain(sections.map(|(title, _)| missing("section", title, &titles)));
        self.problems.extend(problems.collect::<Vec<_>>());
    }
}

/// Something that the sidecar speaks of and the notes do not have.
fn missing(what: &str, name: &Spanned<String>, known: &[&str]) -> Problem {
    const SHOWN: usize = 12;
    let message = format!("the notes have no {what} `{}`", name.value);
    let problem = Problem::error("document::sidecar", message, name.span.clone());
    match nearest(&name.value, known) {
        Some(near) => problem.label(format!("did you mean `{near}`?")),
        None if known.is_empty() => problem.label("not found"),
        None => {
            let more = if known.len() > SHOWN { ", ..." } else { "" };
            let shown: Vec<&str> = known.iter().take(SHOWN).copied().collect();
            problem.label("not found").help(format!("they have: {}{more}", shown.join(", ")))
        }
    }
}
