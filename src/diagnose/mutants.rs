//! All formulas that differ from a given one by a single edit.
//!
//! Edited are signs, terms, factors, numbers, powers, functions, indices, primes, dots, symbols and fractions, on every
//! side of every relation; relations themselves, the limits of sums and the `d/dt` of derivatives are not. Symbols are
//! only replaced by others that are declared where the formula stands.

use std::collections::HashSet;

use crate::latex::ast::{Node, Span};
use crate::latex::to_latex;
use crate::semantics::Scope;

use super::edits::{Found, Walk};

/// What an edit changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum EditKind {
    /// The sign of a term.
    Sign,
    /// The index of a symbol.
    Index,
    /// A dot over a symbol.
    Dot,
    /// A prime of a symbol.
    Prime,
    /// A symbol for one that looks or is used alike.
    Symbol,
    /// A power.
    Power,
    /// Sine for cosine.
    Function,
    /// A number.
    Number,
    /// A factor is left out.
    DropFactor,
    /// A factor of 2.
    Double,
    /// A term is left out.
    DropTerm,
    /// A fraction is turned over.
    Invert,
    /// A bracket is closed elsewhere.
    Bracket,
    /// A factor is put in.
    Insert,
    /// A cross for a dot.
    Operator,
    /// A term is put in.
    Term,
    /// A symbol is replaced by a product.
    Replace,
}

/// A single edit.
#[derive(Clone, Debug, PartialEq)]
pub struct Edit {
    /// What it changes.
    pub kind: EditKind,
    /// The edit in words, with LaTeX between backticks.
    pub text: String,
    /// Where, in bytes of the LaTeX that was parsed.
    pub span: Span,
}

/// A formula with a single edit.
#[derive(Clone, Debug, PartialEq)]
pub struct Mutant {
    /// The formula.
    pub tree: Node,
    /// The edit.
    pub edit: Edit,
    /// Where in the tree, child by child from the root, and what was put there.
    pub(super) path: Vec<usize>,
    pub(super) node: Node,
}

impl Mutant {
    /// The formula with both this edit and another one of the same formula; `None` where one lies within the other.
    pub fn with(&self, other: &Mutant) -> Option<Node> {
        let apart = !self.path.starts_with(&other.path) && !other.path.starts_with(&self.path);
        apart.then(|| replaced_at(&self.tree, &other.path, &other.node))
    }
}

/// How far the edits go.
#[derive(Clone, Copy, Debug, Default)]
pub struct Reach<'n> {
    /// The most siblings that take the place of one symbol, for each kind of edit; without, all.
    pub siblings: Option<usize>,
    /// Factors that may be put in.
    pub factors: &'n [Node],
}

impl Reach<'_> {
    /// What a check's sensitivity is measured by.
    pub const MUTANTS: Reach<'static> = Reach { siblings: Some(2), factors: &[] };
}

/// The longest formula of which mutants are made, in bytes: n places to edit make n formulas of n parts.
pub(super) const LONGEST: usize = 2000;

/// The formulas that are one edit away, no two with the same LaTeX, in the order of writing.
pub fn mutants(tree: &Node, scope: &Scope, reach: Reach) -> Vec<Mutant> {
    let latex = to_latex(tree);
    if latex.len() > LONGEST {
        return Vec::new();
    }
    let mut walk = Walk::new(scope, reach);
    walk.visit(tree);
    let mut seen: HashSet<String> = HashSet::from([latex]);
    let mutated = walk.found.into_iter().map(|Found { path, node, edit }| {
        let tree = replaced_at(tree, &path, &node);
        Mutant { tree, edit, path, node }
    });
    mutated.filter(|m| seen.insert(to_latex(&m.tree))).collect()
}

/// The tree with the node at a path (child by child from the root) replaced.
pub(super) fn replaced_at(node: &Node, path: &[usize], new: &Node) -> Node {
    let Some((first, rest)) = path.split_first() else { return new.clone() };
    let mut k = 0;
    node.map_children(&mut |child| {
        k += 1;
        if k - 1 == *first { replaced_at(child, rest, new) } else { child.clone() }
    })
}
