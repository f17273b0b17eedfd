//! What stands near an equation: its premises and the displays before and after it, as printed.
//!
//! Of the equation itself only the printed formula is looked at. Premises are taken as they are used, that is, as
//! corrected where they have a correction; all other equations as printed.

use std::collections::HashSet;

use crate::check::{Book, Version};
use crate::latex::ast::{Kind, Node};
use crate::latex::{self, to_latex};
use crate::semantics::{EntryKind, Scope};

use super::likeness;
use super::names::{Name, indices};

/// How many displays before and after are looked at.
const AROUND: usize = 2;

/// The formulas near an equation, the nearest first: its own, its premises, the displays around.
pub struct Near {
    /// The formulas.
    pub formulas: Vec<Node>,
    /// The patterns of the declared symbols in displays, and in premises that the prose states.
    displayed: HashSet<String>,
    stated: HashSet<String>,
    /// The symbols in them, without powers, each once.
    pub symbols: Vec<Node>,
    /// The letters of the indices of the formula's own symbols.
    pub letters: Vec<String>,
}

impl Near {
    /// Looks around.
    pub fn new(book: &Book, index: usize, tree: &Node) -> Self {
        let entry = &book.entries[index];
        let given = entry.given(None).into_iter().chain(entry.list(|a| &a.solves));
        let given: Vec<usize> = given.filter_map(|g| book.find(&g.value)).map(|(k, _)| k).collect();
        let formula = |k: usize, version| book.entries[k].formula(version).tree.as_ref().ok().cloned();
        let around = book.around(index, AROUND).into_iter().filter(|k| !given.contains(k));
        let displays = given.iter().filter_map(|k| formula(*k, Version::Corrected));
        let displays: Vec<Node> = std::iter::once(tree.clone())
            .chain(displays)
            .chain(around.filter_map(|k| formula(k, Version::Printed)))
            .collect();
        let premises = entry.list(|a| &a.where_).iter().chain(&entry.scope.assume);
        let premises: Vec<Node> = premises.filter_map(|p| latex::parse(&p.value).ok()).collect();
        let mut near = Near {
            formulas: Vec::new(),
            displayed: HashSet::new(),
            stated: HashSet::new(),
            symbols: Vec::new(),
            letters: Vec::new(),
        };
        displays.iter().for_each(|f| near.collect(&entry.scope, f, true));
        premises.iter().for_each(|f| near.collect(&entry.scope, f, false));
        let formulas = displays.into_iter().chain(premises).collect();
        let mut own = Vec::new();
        letters(&entry.scope, tree, &mut own);
        near.letters = own;
        near.formulas = formulas;
        near
    }

    /// What a symbol costs for standing far away.
    pub fn distance(&self, pattern: &str) -> u32 {
        if self.displayed.contains(pattern) {
            0
        } else if self.stated.contains(pattern) {
            likeness::STATED
        } else {
            likeness::FAR
        }
    }

    /// What a symbol is said to equal in the formulas nearby: the sides beside it.
    pub fn definitions(&self, scope: &Scope, pattern: &str) -> Vec<Node> {
        let mut found = Vec::new();
        self.formulas.iter().for_each(|f| equals(scope, f, pattern, &mut found));
        found
    }

    fn collect(&mut self, scope: &Scope, node: &Node, displayed: bool) {
        if let Some(name) = Name::of(scope, node) {
            let bare = name.without_power();
            let patterns = if displayed { &mut self.displayed } else { &mut self.stated };
            patterns.insert(name.entry.pattern.clone());
            if self.symbols.iter().all(|s| to_latex(s) != to_latex(&bare)) {
                self.symbols.push(bare);
            }
        } else if !matches!(node.kind, Kind::Text(_)) {
            node.children().into_iter().for_each(|child| self.collect(scope, child, displayed));
        }
    }

    /// The scalars, those of the formula itself first.
    pub fn scalars<'n>(&'n self, scope: &'n Scope) -> impl Iterator<Item = &'n Node> {
        let scalar = |n: &&Node| {
            Name::of(scope, n).is_some_and(|n| matches!(n.entry.kind, EntryKind::Scalar | EntryKind::Component { .. }))
        };
        self.symbols.iter().filter(scalar)
    }

    /// The vectors.
    pub fn vectors<'n>(&'n self, scope: &'n Scope) -> impl Iterator<Item = &'n Node> {
        let vector = |n: &&Node| {
            Name::of(scope, n).is_some_and(|n| matches!(n.entry.kind, EntryKind::Vector | EntryKind::Rate { .. }))
        };
        self.symbols.iter().filter(vector)
    }

    /// The scalars with an index that the formula has, too.
    pub fn indexed<'n>(&'n self, scope: &'n Scope) -> impl Iterator<Item = &'n Node> {
        let fits = |n: &&Node| {
            let own = indices(scope, n);
            !own.is_empty() && own.iter().all(|l| self.letters.contains(l))
        };
        self.scalars(scope).filter(fits)
    }

    /// The vectors, those of bases included.
    pub fn arrows<'n>(&'n self, scope: &'n Scope) -> impl Iterator<Item = &'n Node> {
        let arrow = |n: &&Node| {
            Name::of(scope, n).is_some_and(|n| {
                matches!(n.entry.kind, EntryKind::Vector | EntryKind::Rate { .. } | EntryKind::BasisVector { .. })
            })
        };
        self.symbols.iter().filter(arrow)
    }

    /// The terms of all formulas, and what stands in their brackets, roots and fractions, each once.
    pub fn terms(&self) -> Vec<Node> {
        let mut found = Vec::new();
        let mut seen = HashSet::new();
        for formula in &self.formulas {
            terms(formula, true, &mut |n| {
                if seen.insert(to_latex(n)) {
                    found.push(n.clone());
                }
            });
        }
        found
    }
}

fn terms(node: &Node, is_term: bool, found: &mut dyn FnMut(&Node)) {
    match &node.kind {
        Kind::Sum(all) => all.iter().for_each(|t| terms(&t.node, true, found)),
        Kind::Chain { .. } | Kind::Rows(_) | Kind::List(_) | Kind::Marked(..) | Kind::Matrix { .. } => {
            node.children().into_iter().for_each(|c| terms(c, true, found));
        }
        Kind::Group { body, .. } if is_term => terms(body, true, found),
        Kind::Sqrt { body, .. } => {
            found(node);
            terms(body, true, found);
        }
        Kind::Group { .. } | Kind::Frac(..) => {
            found(node);
            node.children().into_iter().for_each(|c| terms(c, true, found));
        }
        Kind::Number(_) | Kind::Text(_) | Kind::Empty => {}
        _ => {
            if is_term {
                found(node);
            }
            node.children().into_iter().for_each(|c| terms(c, false, found));
        }
    }
}

/// The sides of relations beside one that is a symbol alone.
fn equals(scope: &Scope, node: &Node, pattern: &str, found: &mut Vec<Node>) {
    if let Kind::Chain { first: Some(first), links } = &node.kind {
        let sides: Vec<&Node> = std::iter::once(first.as_ref()).chain(links.iter().map(|l| &l.rhs)).collect();
        let is_it = |n: &&&Node| Name::of(scope, n).is_some_and(|n| n.entry.pattern == pattern && n.dots == 0);
        if sides.iter().any(|n| is_it(&n)) {
            found.extend(sides.iter().filter(|n| !is_it(n)).map(|n| (*n).clone()));
        }
        return;
    }
    node.children().into_iter().for_each(|child| equals(scope, child, pattern, found));
}

fn letters(scope: &Scope, node: &Node, found: &mut Vec<String>) {
    for letter in indices(scope, node) {
        if !found.contains(&letter) {
            found.push(letter);
        }
    }
    node.children().into_iter().for_each(|child| letters(scope, child, found));
}
