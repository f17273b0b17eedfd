//! A text that is open in the editor, and the judgements on it.

use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use tower_lsp_server::ls_types::{DocumentSymbol, Position, Range, SymbolKind, TextDocumentContentChangeEvent};

use crate::check::verdict::{Suggestion, Verdict};
use crate::check::{Book, Version, inspect::inspect};
use crate::diagnose::correct;
use crate::document::{self, EquationAnnotation, Item, Span, Spanned};
use crate::incremental::Memory;
use crate::verify::{self, Request, Verified};

use super::fix::{self, Fix};
use super::{show, text};

/// An open text.
pub struct Notes {
    /// Its path.
    pub path: PathBuf,
    now: Mutex<Now>,
    memory: Mutex<Memory>,
    judged: Mutex<Option<Arc<Judged>>>,
}

struct Now {
    text: String,
    version: i32,
}

/// A text with the judgements on it.
pub struct Judged {
    version: i32,
    text: String,
    /// The judgements.
    pub verified: Verified,
    /// What was probably meant, by labels, once it has been searched.
    suggestions: Mutex<HashMap<String, Vec<Suggestion>>>,
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Notes {
    /// A text as the editor opened it.
    pub fn new(path: PathBuf, text: String, version: i32) -> Self {
        let now = Mutex::new(Now { text, version });
        Notes { path, now, memory: Mutex::default(), judged: Mutex::default() }
    }

    /// The version of the text.
    pub fn version(&self) -> i32 {
        lock(&self.now).version
    }

    /// Takes in what was typed.
    pub fn edit(&self, version: i32, changes: &[TextDocumentContentChangeEvent]) {
        let mut now = lock(&self.now);
        changes.iter().for_each(|change| text::edit(&mut now.text, change.range, &change.text));
        now.version = version;
    }

    /// The judgements on the text as it is now.
    pub fn judged(&self) -> Option<Arc<Judged>> {
        let version = self.version();
        lock(&self.judged).clone().filter(|judged| judged.version == version)
    }

    /// Judges what changed. `None` where the text has changed in the meantime.
    pub fn verify(&self, request: &Request) -> Option<Arc<Judged>> {
        let mut memory = lock(&self.memory);
        let (text, version) = {
            let now = lock(&self.now);
            (now.text.clone(), now.version)
        };
        let document = document::edited(&self.path, &text);
        let (verified, _) = verify::verify_again(document, request, &mut memory, &|| ());
        if self.version() != version {
            return None;
        }
        let judged = Arc::new(Judged { version, text, verified, suggestions: Mutex::default() });
        *lock(&self.judged) = Some(Arc::clone(&judged));
        Some(judged)
    }
}

impl Judged {
    /// The place of a span, where it stands in this text.
    pub fn range(&self, span: &Span) -> Option<Range> {
        Some(text::range(&self.text, &show::in_text(&self.verified.document, span)?))
    }

    /// What is to be said of the equation at a place, and the place of all of it.
    pub fn hover(&self, position: Position, request: &Request) -> Option<(String, Range)> {
        let document = &self.verified.document;
        let (index, equation) = show::at(document, text::offset(&self.text, position))?;
        let judgement = self.verified.report.equations.get(index)?;
        let book = Book::new(document);
        let inspections = inspect(&book, index, Version::Printed, &request.options);
        let given = |label: &String| {
            let (k, _) = book.find(label)?;
            Some((label.clone(), book.entries[k].formula(Version::Corrected).latex.trim().to_owned()))
        };
        let premises: Vec<(String, String)> = judgement.given.iter().filter_map(given).collect();
        Some((show::hover(judgement, &inspections, &premises), self.range(&equation.span)?))
    }

    /// The fixes of the equations that touch a range, and the label of each of which more may be found by searching.
    pub fn fixes(&self, range: Range) -> Vec<(Option<String>, Vec<Fix>)> {
        let (start, end) = (text::offset(&self.text, range.start), text::offset(&self.text, range.end));
        let document = &self.verified.document;
        let suggestions = lock(&self.suggestions);
        let equations = document.equations().zip(&self.verified.report.equations);
        let touched = equations.filter(|(e, _)| show::touches(document, &e.span, &(start..end)));
        touched
            .map(|(equation, judgement)| {
                let found =
                    suggestions.get(&judgement.label).or(Some(&judgement.suggestions)).filter(|s| !s.is_empty());
                let fixes = fix::fixes(document, equation, judgement, found.map_or(&[], Vec::as_slice));
                let open = judgement.verdict == Verdict::Fails && !suggestions.contains_key(&judgement.label);
                (open.then(|| judgement.label.clone()), fixes)
            })
            .collect()
    }

    /// Searches what was meant by an equation: how much was found. `None` where there is no such equation.
    pub fn suggest(&self, label: &str, request: &Request) -> Option<usize> {
        let index = self.verified.report.equations.iter().position(|e| e.label == label)?;
        let judgement = &self.verified.report.equations[index];
        let book = Book::new(&self.verified.document);
        let found = correct::suggestions(&book, index, judgement, &request.options);
        let count = found.len();
        lock(&self.suggestions).insert(label.to_owned(), found);
        Some(count)
    }

    /// Where the equation stands whose label is at a place in an annotation.
    pub fn definition(&self, position: Position) -> Option<Range> {
        let offset = text::offset(&self.text, position);
        let document = &self.verified.document;
        let here = |reference: &&Spanned<String>| show::touches(document, &reference.span, &(offset..offset));
        let annotations = document.equations().filter_map(|e| e.annotation.as_ref());
        let reference = annotations.flat_map(references).find(here)?;
        let named = |label: &str| document.equations().find(|e| e.label == label);
        let statement = || reference.value.rsplit_once('.').and_then(|(label, _)| named(label));
        let equation = named(&reference.value).or_else(statement)?;
        self.range(&equation.span)
    }

    /// The sections and the equations, in order.
    pub fn symbols(&self) -> Vec<DocumentSymbol> {
        let mut judgements = self.verified.report.equations.iter();
        let items = self.verified.document.items.iter();
        let mut symbols = Vec::new();
        for item in items {
            let (name, detail, kind, span) = match item {
                Item::Section(section) => (section.title.clone(), None, SymbolKind::NAMESPACE, &section.span),
                Item::Equation(equation) => {
                    let verdict = judgements.next().map(|j| format!("{:?}", j.verdict).to_lowercase());
                    (format!("({})", equation.label), verdict, SymbolKind::CONSTANT, &equation.span)
                }
                Item::Declarations(_) => continue,
            };
            // What stands in another file has no place here.
            let Some(range) = self.range(span).filter(|_| !name.is_empty()) else { continue };
            #[expect(deprecated, reason = "the protocol's type has a field that it gave up")]
            symbols.push(DocumentSymbol {
                name,
                detail,
                kind,
                range,
                selection_range: range,
                tags: None,
                deprecated: None,
                children: None,
            });
        }
        symbols
    }
}

/// The references of an annotation.
fn references(annotation: &EquationAnnotation) -> impl Iterator<Item = &Spanned<String>> {
    let links = annotation.link.iter().flat_map(|link| &link.given);
    annotation.given.iter().chain(&annotation.solves).chain(links)
}
