//! The symbols of notes, declared or guessed, and what is odd about them.

use std::collections::{BTreeMap, BTreeSet};

use crate::check::{Book, Version};
use crate::document::{Document, EquationAnnotation, Item, Problem, SymbolDeclaration};
use crate::infer::evidence::{Evidence, names};
use crate::infer::roles::{self, Guess};

/// A symbol of notes.
#[derive(Clone, Debug, PartialEq)]
pub struct Listed {
    /// Its LaTeX.
    pub symbol: String,
    /// What it is: the guessed role in words, or the declaration in TOML.
    pub role: String,
    /// The line in which it is declared, or first occurs.
    pub line: usize,
    /// The labels of the equations that mention it.
    pub mentioned: Vec<String>,
    /// Whether it is guessed.
    pub guessed: bool,
}

/// The symbols of a document, in the order in which they are declared or first occur.
pub fn symbols(document: &Document) -> Vec<Listed> {
    let guesses = roles::guess(document);
    let book = Book::new(&roles::declare(document, &guesses));
    if !guesses.is_empty() {
        return guesses.iter().map(|guess| guessed(guess, &book, document)).collect();
    }
    let mut listed = Vec::new();
    for (name, declaration) in declared(document) {
        let mentioned = mentions(&book, name.span.start);
        listed.push(Listed {
            symbol: name.value.clone(),
            role: roles::toml(declaration),
            line: document.files.line(name.span.start),
            mentioned,
            guessed: false,
        });
    }
    listed
}

fn guessed(guess: &Guess, book: &Book, document: &Document) -> Listed {
    let depends = if guess.moves { ", depends on the time" } else { "" };
    let mentioned = book.entries.iter().filter(|e| e.mentions.keys().any(|name| *name == guess.name));
    let mentioned = mentioned.map(|e| e.equation.label.clone()).collect();
    Listed {
        symbol: guess.name.clone(),
        role: format!("{}{depends}", guess.role.words()),
        line: document.files.line(guess.at),
        mentioned,
        guessed: true,
    }
}

/// The names that a document declares, each with its declaration.
fn declared(document: &Document) -> Vec<(&crate::document::Spanned<String>, &SymbolDeclaration)> {
    let blocks = document.items.iter().filter_map(|item| match item {
        Item::Declarations(block) => Some(&block.symbols),
        Item::Equation(equation) => equation.annotation.as_ref().map(|a| &a.symbols),
        Item::Section(_) => None,
    });
    blocks.flatten().flat_map(|d| d.names.iter().map(move |name| (name, d))).collect()
}

/// The labels of the equations that mention what is declared at a place.
fn mentions(book: &Book, declared: usize) -> Vec<String> {
    let mention = book.entries.iter().filter(|e| e.mentions.values().any(|at| *at == declared));
    mention.map(|e| e.equation.label.clone()).collect()
}

/// What is odd about the symbols of a document, with its place: declared and never used, the same letter in two roles.
pub fn lints(document: &Document) -> Vec<Problem> {
    let mut problems = unused(document);
    problems.extend(two_roles(document));
    problems.sort_by_key(|p| p.span.start);
    problems
}

/// Symbols that neither an equation nor an annotation mentions.
fn unused(document: &Document) -> Vec<Problem> {
    let book = Book::new(document);
    let said: Vec<String> = document.equations().filter_map(|e| e.annotation.as_ref()).flat_map(formulas).collect();
    let assumed = document.items.iter().filter_map(|item| match item {
        Item::Declarations(block) => Some(block),
        _ => None,
    });
    let mut texts = said;
    for block in assumed {
        texts.extend(block.assume.iter().chain(&block.modulus).map(|t| t.value.clone()));
        texts.extend(block.cyclic.iter().flatten().map(|t| t.value.clone()));
        texts.extend(block.canonical.iter().flat_map(|(p, q)| [p.value.clone(), q.value.clone()]));
        texts.extend(block.symbols.iter().filter_map(|d| d.same.as_ref()).map(|t| t.value.clone()));
        texts.extend(block.symbols.iter().filter_map(|d| d.component_of.as_ref()).map(|t| t.value.clone()));
        texts.extend(block.bases.iter().flat_map(|b| b.euler.iter().flatten().chain(&b.rate)).map(|t| t.value.clone()));
    }
    let mentioned: BTreeSet<usize> = book.entries.iter().flat_map(|e| e.mentions.values().copied()).collect();
    let unused = declared(document).into_iter().filter(|(name, d)| {
        let base = name.value.split('_').next().unwrap_or_default().trim();
        d.index.is_none() && !mentioned.contains(&name.span.start) && !texts.iter().any(|text| text.contains(base))
    });
    let lint = |(name, _): (&crate::document::Spanned<String>, _)| {
        let message = format!("{} is declared and never used", name.value);
        Problem::warning("kenzan::unused_symbol", message, name.span.clone())
            .help("leave the declaration out, or look how the notes spell the symbol")
    };
    unused.map(lint).collect()
}

/// The LaTeX in an annotation.
fn formulas(annotation: &EquationAnnotation) -> Vec<String> {
    let one = [&annotation.small, &annotation.iff, &annotation.maps, &annotation.reading, &annotation.correction];
    let mut all: Vec<String> = one.into_iter().flatten().map(|t| t.value.clone()).collect();
    let links = annotation.link.iter();
    let lists = [&annotation.where_, &annotation.solve, &annotation.general, &annotation.harmonics];
    all.extend(lists.into_iter().flatten().map(|t| t.value.clone()));
    all.extend(links.flat_map(|l| l.where_.iter().chain(&l.iff)).map(|t| t.value.clone()));
    all.extend(annotation.range.iter().map(|(name, _)| name.value.clone()));
    all.extend(annotation.data.iter().flat_map(|(name, value)| [name.value.clone(), value.value.clone()]));
    all.extend(annotation.symbols.iter().filter_map(|d| d.same.as_ref()).map(|t| t.value.clone()));
    all
}

/// Letters that are an index here and a quantity there, and `e` as a charge beside the base of the exponential function.
fn two_roles(document: &Document) -> Vec<Problem> {
    let book = Book::new(document);
    let mut runs: BTreeMap<String, usize> = BTreeMap::new();
    let mut quantities: BTreeMap<String, usize> = BTreeMap::new();
    for entry in book.entries.iter() {
        let Ok(tree) = &entry.formula(Version::Printed).tree else { continue };
        let mut evidence = Evidence::default();
        evidence.look(tree);
        let at = entry.equation.span.start;
        for letter in evidence.runs.keys() {
            runs.entry(letter.clone()).or_insert(at);
        }
        // Where a sum runs through the letter, it may stand as a number as well.
        names(tree, &mut |name| {
            if !evidence.runs.contains_key(&name) {
                quantities.entry(name).or_insert(at);
            }
        });
    }
    let both = runs.iter().filter_map(|(letter, sum)| Some((letter, *sum, *quantities.get(letter)?)));
    let lint = |(letter, sum, at): (&String, usize, usize)| {
        let message = format!("{letter} is an index here, and a quantity elsewhere");
        Problem::warning("kenzan::two_roles", message, sum..sum + 1)
            .label("a sum runs through it in this equation")
            .other(at..at + 1, "here it stands by itself")
            .help("give one of them another letter, or declare it where it changes its role")
    };
    both.map(lint).collect()
}
