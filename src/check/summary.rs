//! What an equation is, and what its links come to together.

use super::book::Book;
use super::verdict::{Judgement, LostBits, Verdict};

/// The kind of an equation: as annotated, or inferred.
pub(super) fn kind(book: &Book, index: usize) -> String {
    let entry = &book.entries[index];
    let Some(a) = entry.annotation() else { return "identity".into() };
    if let Some(kind) = &a.kind {
        return kind.value.clone();
    }
    let kind = if a.small.is_some() {
        "approximation"
    } else if !a.solves.is_empty() {
        "solution"
    } else if a.iff.is_some() {
        "inequality"
    } else if a.maps.is_some() {
        "transformation"
    } else if !entry.given(None).is_empty() || !entry.wheres(None).is_empty() {
        "derived"
    } else {
        "identity"
    };
    kind.into()
}

impl Judgement {
    /// Draws the equation's figures from its links.
    pub(super) fn summarise(&mut self) {
        self.bits = self.links.iter().filter_map(|l| l.bits).min();
        self.states = self.links.iter().map(|l| l.states).max().unwrap_or(0);
        self.counterexample = self.links.iter().find_map(|l| l.counterexample.clone());
        let decisive = self.links.iter().filter(|l| l.verdict == self.verdict);
        self.strength = decisive.filter_map(|l| l.strength).max_by_key(|s| s.weakness());
        let definition = self.links.iter().all(|l| l.verdict == Verdict::Definition) && !self.links.is_empty();
        if definition && self.kind != "law" {
            self.kind = "definition".into();
        }
        let lost: Vec<LostBits> = self.links.iter().filter_map(|l| l.lost_bits).collect();
        if !lost.is_empty() {
            let mean = lost.iter().map(|l| l.mean).sum::<f64>() / lost.len() as f64;
            let worst = lost.iter().map(|l| l.worst).fold(0.0, f64::max);
            self.lost_bits = Some(LostBits { mean: (10.0 * mean).round() / 10.0, worst });
        }
        if self.reason.is_none() {
            self.reason = self.links.iter().find(|l| l.verdict == self.verdict).and_then(|l| l.reason.clone());
        }
    }
}
