//! What stands near an equation: its premises and the displays before and after it, as printed.
//!
//! Of the equation itself only the printed formula is looked at. Premises are taken as they are used, that is, as
//! corrected where they have a correction; all other equations as printed.

use std::collections::HashSet;

use crate::check::{Book, Version};
use crate::latex::ast::{Kind, Node};
use crate::latex::{self, to_latex};
use crate::semantics::{EntryKind, Scope};

use super::names::{Name, indices};

/// How many displays before and after are looked at.
const AROUND: usize = 2;

/// The formulas near an equation, the nearest first: its own, its premises, the displays around.
pub struct Near {
    /// The formulas.
    pub formulas: Vec<Node>,
    /// The patterns of the declared symbols in them.
    patterns: HashSet<String>,
    /// The symbols in them, without powers, each once.
    pub symbols: Vec<Node>,
    /// The letters of the indices of the formula's own symbols.
    pub letters: Vec<String>,
}

impl Near {
    /// Looks around.
    pub fn new(book: &Book, index: usize, tree: &Node) -> Self {
        let entry = &book.entries[index];
        let mut formulas = vec![tree.clone()];
        let given = entry.list(|a| &a.given).iter().chain(entry.list(|a| &a.solves));
        let given: Vec<usize> = given.filter_map(|g| book.find(&g.value)).map(|(k, _)| k).collect();
        let formula = |k: usize, version| book.entries[k].formula(version).tree.as_ref().ok().cloned();
        formulas.extend(given.iter().filter_map(|k| formula(*k, Version::Corrected)));
        let premises = entry.list(|a| &a.where_).iter().chain(&entry.scope.assume);
        formulas.extend(premises.filter_map(|p| latex::parse(&p.value).ok()));
        let mut around: Vec<usize> = (index.saturating_sub(AROUND)..=index + AROUND)
            .filter(|k| *k != index && *k < book.entries.len() && !given.contains(k))
            .collect();
        around.sort_by_key(|k| k.abs_diff(index));
        formulas.extend(around.into_iter().filter_map(|k| formula(k, Version::Printed)));
        let mut near =
            Near { formulas: Vec::new(), patterns: HashSet::new(), symbols: Vec::new(), letters: Vec::new() };
        for formula in &formulas {
            near.collect(&entry.scope, formula);
        }
        let mut own = Vec::new();
        letters(&entry.scope, tree, &mut own);
        near.letters = own;
        near.formulas = formulas;
        near
    }

    /// Whether a symbol occurs near.
    pub fn has(&self, pattern: &str) -> bool {
        self.patterns.contains(pattern)
    }

    fn collect(&mut self, scope: &Scope, node: &Node) {
        if let Some(name) = Name::of(scope, node) {
            let bare = name.without_power();
            self.patterns.insert(name.entry.pattern.clone());
            if self.symbols.iter().all(|s| to_latex(s) != to_latex(&bare)) {
                self.symbols.push(bare);
            }
        } else if !matches!(node.kind, Kind::Text(_)) {
            node.children().into_iter().for_each(|child| self.collect(scope, child));
        }
    }

    /// The scalars, those of the formula itself first.
    pub fn scalars<'n>(&'n self, scope: &'n Scope) -> impl Iterator<Item = &'n Node> {
        let scalar = |n: &&Node| {
            Name::of(scope, n)
                .is_some_and(|n| matches!(n.entry.kind, EntryKind::Scalar | EntryKind::Component { .. }))
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

    /// The terms of all formulas: what stands between signs, relations and brackets, each once.
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
        Kind::Group { body, .. } => terms(body, is_term, found),
        Kind::Number(_) | Kind::Text(_) | Kind::Empty => {}
        _ => {
            if is_term {
                found(node);
            }
            node.children().into_iter().for_each(|c| terms(c, false, found));
        }
    }
}

fn letters(scope: &Scope, node: &Node, found: &mut Vec<String>) {
    for letter in indices(scope, node) {
        if !found.contains(&letter) {
            found.push(letter);
        }
    }
    node.children().into_iter().for_each(|child| letters(scope, child, found));
}
