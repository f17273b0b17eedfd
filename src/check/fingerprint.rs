//! Fingerprints of what a judgement rests on: they are equal where the answers to all its questions are.
//!
//! Promises: places in the file play no part, so that text that moves changes no fingerprint; everything else that the
//! work [asked for](crate::trace) does. A field that is added to what is hashed here does not compile until somebody has
//! thought of it.

use std::collections::{BTreeSet, HashMap};
use std::hash::{DefaultHasher, Hash, Hasher};
use std::sync::Arc;

use rayon::prelude::*;

use crate::document::{Arguments, Equation, EquationAnnotation, LinkPremises, Spanned, SymbolDeclaration};
use crate::semantics::{self, Scope};
use crate::trace::{Trace, unrecorded};

use super::book::Book;

/// What some work asked of a book, in terms that outlive it: equations by their labels.
#[derive(Clone, Debug)]
pub struct Footing {
    /// The labels of the equations looked at.
    labels: BTreeSet<String>,
    /// Those of the equations that continue the one before.
    continued: BTreeSet<String>,
    names: Vec<String>,
    all_names: bool,
    references: BTreeSet<String>,
    /// The patterns of which it was asked whether they are mentioned before.
    mentioned: Vec<String>,
    circle: bool,
    around: Option<usize>,
}

impl Footing {
    /// The footing of work on an equation. `None` where it asked on behalf of another equation, which cannot be told
    /// in labels.
    pub fn new(book: &Book, index: usize, trace: Trace) -> Option<Self> {
        let Trace { names, all_names, equations, continued, references, mentioned, circles, around } = trace;
        let label = |k: &usize| book.entries.quietly(*k).equation.label.clone();
        let own = |k: &usize| *k == index;
        let foreign = mentioned.iter().any(|(k, _)| *k != index)
            || !circles.iter().all(own)
            || around.iter().any(|(k, _)| *k != index);
        let mut names: Vec<String> = names.into_iter().collect();
        names.sort_unstable();
        (!foreign).then(|| Footing {
            labels: equations.iter().map(label).collect(),
            continued: continued.iter().map(label).collect(),
            names,
            all_names,
            references,
            mentioned: mentioned.into_iter().map(|(_, pattern)| pattern).collect(),
            circle: circles.contains(&index),
            around: around.iter().map(|(_, reach)| *reach).max(),
        })
    }

    /// The equations looked at, by their places in a book.
    pub fn equations(&self, book: &Book) -> impl Iterator<Item = usize> {
        self.labels.iter().filter_map(|label| book.labelled(label))
    }
}

/// The fingerprint of a footing.
#[derive(Clone, Copy, Debug)]
pub struct Fingerprint {
    /// With all that is declared where the equations stand, whether asked for or not.
    coarse: u64,
    /// With what was asked for.
    fine: u64,
}

/// The parts of a book's fingerprints that many equations share.
pub struct Fingerprints<'b> {
    /// The book.
    pub book: &'b Book,
    contents: Vec<u64>,
    more: Vec<u64>,
    /// By the address of the scope: what is no symbol in it, and all of it.
    scopes: HashMap<usize, (u64, u64)>,
    /// By the address of the declaration.
    symbols: HashMap<usize, u64>,
}

impl<'b> Fingerprints<'b> {
    /// Takes the fingerprints of a book's equations and scopes.
    pub fn new(book: &'b Book) -> Self {
        let mut prints = Fingerprints {
            book,
            contents: Vec::new(),
            more: Vec::new(),
            scopes: HashMap::new(),
            symbols: HashMap::new(),
        };
        book.entries.iter().for_each(|entry| prints.enter(&entry.scope));
        let entries = (0..book.entries.len()).into_par_iter().map(|k| book.entries.quietly(k));
        prints.contents = entries.map(|entry| content(&entry.equation, &entry.printed.latex)).collect();
        prints
    }

    /// With more that the equations' judgements depend on, by their places.
    pub fn with(mut self, more: impl Fn(usize) -> Option<u64> + Sync + Send) -> Self {
        let all: Vec<Option<u64>> = (0..self.contents.len()).into_par_iter().map(more).collect();
        self.more = all.into_iter().map(Option::unwrap_or_default).collect();
        self
    }

    fn enter(&mut self, scope: &Arc<Scope>) {
        let at = Arc::as_ptr(scope).addr();
        if self.scopes.contains_key(&at) {
            return;
        }
        let frame = frame(scope);
        let mut all = DefaultHasher::new();
        frame.hash(&mut all);
        for entry in scope.entries() {
            self.symbols.entry(std::ptr::from_ref(entry).addr()).or_insert_with(|| symbol(entry)).hash(&mut all);
        }
        self.scopes.insert(at, (frame, all.finish()));
    }

    /// The fingerprint that a footing has in this book for the equation at a place. `None` where the book has not all
    /// that it speaks of.
    pub(super) fn of(&self, index: usize, footing: &Footing) -> Option<Fingerprint> {
        unrecorded(|| {
            let (equations, answers) = self.answers(index, footing)?;
            let coarse = self.with_scopes(&equations, answers, |scope| self.scope(scope).1);
            let fine = self.with_scopes(&equations, answers, |scope| self.asked(scope, footing));
            Some(Fingerprint { coarse, fine })
        })
    }

    /// Whether the answers to the questions of a footing are those of a fingerprint.
    pub(super) fn agree(&self, index: usize, footing: &Footing, print: &Fingerprint) -> bool {
        unrecorded(|| {
            let Some((equations, answers)) = self.answers(index, footing) else { return false };
            self.with_scopes(&equations, answers, |scope| self.scope(scope).1) == print.coarse
                || self.with_scopes(&equations, answers, |scope| self.asked(scope, footing)) == print.fine
        })
    }

    /// The equations of a footing, and the fingerprint of all but their scopes.
    fn answers(&self, index: usize, footing: &Footing) -> Option<(Vec<usize>, u64)> {
        let mut hasher = DefaultHasher::new();
        let equations = self.equations(index, footing)?;
        self.questions(index, footing, &mut hasher);
        for k in &equations {
            self.contents[*k].hash(&mut hasher);
        }
        Some((equations, hasher.finish()))
    }

    fn with_scopes(&self, equations: &[usize], answers: u64, print: impl Fn(&Arc<Scope>) -> u64) -> u64 {
        let mut hasher = DefaultHasher::new();
        answers.hash(&mut hasher);
        equations.iter().for_each(|k| print(&self.book.entries.quietly(*k).scope).hash(&mut hasher));
        hasher.finish()
    }

    /// The equations that a footing names, and the one whose it is, in the order of their labels.
    fn equations(&self, index: usize, footing: &Footing) -> Option<Vec<usize>> {
        let own = &self.book.entries.quietly(index).equation.label;
        let labels = footing.labels.iter().chain((!footing.labels.contains(own)).then_some(own));
        labels.map(|label| self.book.labelled(label)).collect()
    }

    fn questions(&self, index: usize, footing: &Footing, hasher: &mut DefaultHasher) {
        let label = |k: usize| &self.book.entries.quietly(k).equation.label;
        (label(index), self.more.get(index)).hash(hasher);
        for continued in &footing.continued {
            let before = self.book.labelled(continued).and_then(|k| self.book.entries.quietly(k).previous);
            before.map(label).hash(hasher);
        }
        for reference in &footing.references {
            self.book.find(reference).map(|(k, part)| (label(k), part)).hash(hasher);
        }
        for pattern in &footing.mentioned {
            self.book.mentioned_before(index, pattern).hash(hasher);
        }
        if footing.circle {
            self.book.circle(index).hash(hasher);
        }
        if let Some(reach) = footing.around {
            let around = self.book.around(index, reach);
            around.iter().for_each(|k| (label(*k), *k < index).hash(hasher));
        }
    }

    fn scope(&self, scope: &Arc<Scope>) -> (u64, u64) {
        self.scopes.get(&Arc::as_ptr(scope).addr()).copied().unwrap_or_default()
    }

    /// What was asked of a scope.
    fn asked(&self, scope: &Arc<Scope>, footing: &Footing) -> u64 {
        let (frame, all) = self.scope(scope);
        if footing.all_names {
            return all;
        }
        let mut hasher = DefaultHasher::new();
        frame.hash(&mut hasher);
        for name in &footing.names {
            let symbol = scope.get(name).and_then(|entry| self.symbols.get(&std::ptr::from_ref(entry).addr()));
            symbol.hash(&mut hasher);
        }
        hasher.finish()
    }
}

/// What a scope holds beside its symbols.
fn frame(scope: &Scope) -> u64 {
    let mut hasher = DefaultHasher::new();
    scope.bases().for_each(|basis| format!("{basis:?}").hash(&mut hasher));
    scope.assume.iter().for_each(|text| (&text.value, text.span.len()).hash(&mut hasher));
    (scope.quaternions, scope.natural_units).hash(&mut hasher);
    format!("{:?} {:?} {:?}", scope.modulus, scope.cyclic, scope.canonical).hash(&mut hasher);
    hasher.finish()
}

/// What is declared of a symbol, but for where.
fn symbol(entry: &semantics::Entry) -> u64 {
    let semantics::Entry {
        pattern,
        kind,
        of_t,
        range,
        unit,
        dimension,
        declared: _,
        integer,
        step,
        hidden,
        letters,
        arguments,
    } = entry;
    let mut hasher = DefaultHasher::new();
    (pattern, format!("{kind:?}"), of_t, range.map(|r| r.map(f64::to_bits))).hash(&mut hasher);
    (unit, dimension, integer, step, hidden, letters, arguments).hash(&mut hasher);
    hasher.finish()
}

/// What an equation prints, the macros expanded, and its annotation says. Where in the file that is plays no part, but
/// places within it are told by messages.
fn content(equation: &Equation, expanded: &str) -> u64 {
    let Equation {
        label,
        numbered,
        numbers,
        file,
        line: _,
        span,
        latex,
        masked,
        prefix,
        display: _,
        inline,
        macros: _,
        annotation,
    } = equation;
    let mut hasher = DefaultHasher::new();
    (label, numbered, numbers, file, span.len()).hash(&mut hasher);
    (latex, masked, expanded, prefix, inline).hash(&mut hasher);
    if let Some(annotation) = annotation {
        said(annotation, &mut hasher);
    }
    hasher.finish()
}

fn said(annotation: &EquationAnnotation, hasher: &mut DefaultHasher) {
    let EquationAnnotation {
        span,
        label,
        for_label,
        kind,
        given,
        solve,
        solves,
        general,
        where_,
        link,
        range,
        small,
        harmonics,
        order,
        iff,
        maps,
        reading,
        correction,
        expect,
        because,
        rows,
        digits,
        data,
        states,
        symbols,
    } = annotation;
    let base = span.start;
    for one in [label, for_label, kind, small, iff, maps, reading, correction, expect] {
        all(one.as_slice(), base, hasher);
    }
    for list in [given, solve, solves, general, where_, harmonics, rows] {
        all(list, base, hasher);
    }
    let (ranged, ranges): (Vec<_>, Vec<_>) = range.iter().map(|(name, r)| (name, r.map(f64::to_bits))).unzip();
    let (named, values): (Vec<_>, Vec<_>) = data.iter().map(|(name, value)| (name, value)).unzip();
    for list in [ranged, named, values] {
        all(list, base, hasher);
    }
    (ranges, order.map(f64::to_bits), because, digits, states).hash(hasher);
    link.iter().for_each(|link| of_link(link, base, hasher));
    symbols.iter().for_each(|symbol| declared(symbol, hasher));
}

fn of_link(link: &LinkPremises, base: usize, hasher: &mut DefaultHasher) {
    let LinkPremises { number, span, given, where_, iff } = link;
    (number, span.start.wrapping_sub(base), span.len()).hash(hasher);
    for list in [given.as_slice(), where_, iff.as_slice()] {
        all(list, base, hasher);
    }
}

/// What a declaration of its own says is in the equation's scope; here is told that it is there.
fn declared(symbol: &SymbolDeclaration, hasher: &mut DefaultHasher) {
    symbol.names.iter().for_each(|name| name.value.hash(hasher));
    if let Some(Arguments::Count(n)) = &symbol.function {
        n.hash(hasher);
    }
}

/// Texts with their places in the annotation that begins at `base`.
fn all<'t>(texts: impl IntoIterator<Item = &'t Spanned<String>>, base: usize, hasher: &mut DefaultHasher) {
    let mut count = 0_usize;
    for text in texts {
        (&text.value, text.span.start.wrapping_sub(base), text.span.len()).hash(hasher);
        count += 1;
    }
    count.hash(hasher);
}
