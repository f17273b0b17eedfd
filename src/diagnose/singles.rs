//! The single edits of a formula that a search for what was meant begins with.

use std::collections::HashMap;

use crate::check::Book;
use crate::latex;
use crate::latex::ast::{Kind, Node};
use crate::semantics::Scope;

use super::change::{Change, at};
use super::dots;
use super::edits::{Found, Walk};
use super::likeness;
use super::mutants::{EditKind, Reach};
use super::names::Name;
use super::near::Near;
use super::tries;
use super::wider::wider;

/// How many factors with an index are put in.
const INDEXED: usize = 8;

/// A formula with what stands near it.
pub struct Singles<'n> {
    /// What is declared where it stands.
    pub scope: &'n Scope,
    /// The formula.
    pub tree: &'n Node,
    /// What stands near it.
    pub near: &'n Near,
}

impl Singles<'_> {
    /// All single edits, those of a symbol also in every place at once.
    pub fn all(&self) -> Vec<Change> {
        // A factor with an index has no value of its own by which it could be found.
        let half = latex::parse("\\frac{1}{2}").into_iter();
        let indexed = self.near.indexed(self.scope).take(INDEXED).cloned();
        let factors: Vec<Node> = half.chain(indexed).collect();
        let mut walk = Walk::new(self.scope, Reach { siblings: None, factors: &factors });
        walk.visit(self.tree);
        let found = walk.found.into_iter().chain(wider(self.tree, self.scope, self.near));
        let changes: Vec<(EditKind, Change)> = found.map(|f| (f.edit.kind, self.change(f))).collect();
        let mut same: HashMap<&[String], Vec<&Change>> = HashMap::new();
        changes.iter().for_each(|(_, c)| same.entry(&c.edits).or_default().push(c));
        let mut all: Vec<Change> = Vec::new();
        for (kind, change) in &changes {
            // Once for all that say the same, at the first of them.
            if repeats(*kind)
                && let Some(same) = same.remove(change.edits.as_slice())
            {
                let mut everywhere = change.clone();
                everywhere.places = same.iter().flat_map(|c| c.places.clone()).collect();
                if everywhere.places.len() > 1 {
                    everywhere.edits = vec![format!("{} throughout", change.edits.join("; "))];
                    everywhere.cost += likeness::THROUGHOUT;
                    all.push(everywhere);
                }
            }
            all.push(change.clone());
        }
        let dots = changes.iter().filter(|(kind, _)| *kind == EditKind::Dot).map(|(_, change)| change);
        all.extend(dots::shifted(self.scope, self.tree, dots));
        all.sort_by_key(|c| c.cost);
        all
    }

    /// What is tried where there are no values: single edits with factors put in.
    pub fn tried(&self) -> Vec<Change> {
        self.with_factors().into_iter().map(|(_, change)| change).collect()
    }

    /// Single edits with factors put in, the likeliest first.
    fn with_factors(&self) -> Vec<(EditKind, Change)> {
        let factors = tries::factors(self.near, self.scope);
        let mut walk = Walk::new(self.scope, Reach { siblings: None, factors: &factors });
        walk.visit(self.tree);
        let found = walk.found.into_iter().chain(wider(self.tree, self.scope, self.near));
        let mut all: Vec<(EditKind, Change)> = found.map(|f| (f.edit.kind, self.change(f))).collect();
        all.sort_by_key(|(_, change)| change.cost);
        all
    }

    fn change(&self, found: Found) -> Change {
        let Found { path, node, edit } = found;
        let before = at(self.tree, &path).unwrap_or(self.tree);
        let scope = self.scope;
        let mut cost = likeness::cost(scope, edit.kind, before, &node);
        // What a formula is printed for stands by itself: a factor is rather missing elsewhere.
        let is_side =
            path.split_last().and_then(|(_, p)| at(self.tree, p)).is_some_and(|p| matches!(p.kind, Kind::Chain { .. }));
        if is_side && Name::of(scope, before).is_some() && matches!(edit.kind, EditKind::Insert | EditKind::Double) {
            cost += likeness::SUBJECT;
        }
        if let Some(name) = Name::of(scope, &node) {
            cost += self.near.distance(&name.entry.pattern);
        }
        Change::new(path, node, edit.text, cost)
    }
}

/// A formula that is one edit away from another.
pub struct Edited {
    /// The formula.
    pub tree: Node,
    /// The edit in words, LaTeX between backticks.
    pub edit: String,
    /// How unlikely it is: see [`likeness`].
    pub cost: u32,
}

/// The formulas that are one slip away from one that stands in the place of an equation, the likeliest first. That a
/// symbol stands for what it is said to equal is no slip.
pub fn slips(book: &Book, index: usize, tree: &Node) -> Vec<Edited> {
    let near = Near::new(book, index, tree);
    let singles = Singles { scope: &book.entries[index].scope, tree, near: &near };
    let slips = singles.with_factors().into_iter().filter(|(kind, _)| *kind != EditKind::Replace);
    slips.map(|(_, c)| Edited { tree: c.made(tree), edit: c.edits.join("; "), cost: c.cost }).collect()
}

/// Whether an edit is likely to be made in every place at once: what was misread once is misread again.
fn repeats(kind: EditKind) -> bool {
    matches!(
        kind,
        EditKind::Symbol | EditKind::Index | EditKind::Prime | EditKind::Dot | EditKind::Replace | EditKind::DropFactor
    )
}
