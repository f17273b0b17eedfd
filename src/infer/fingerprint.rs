//! Whether what an equation may follow from is as it was.

use std::hash::{DefaultHasher, Hash, Hasher};

use crate::check::{Book, Version};

use super::candidates::{Origin, Spoken};
use super::judge::Ground;
use super::premises::nearby;

impl Ground {
    /// The fingerprint of what the judgement on an equation takes from the rest of the document: the formulas that it may
    /// follow from, in the order in which they are tried, and the roles of its symbols. What these formulas say in
    /// detail is asked of the book where they are tried.
    pub fn fingerprint(&self, book: &Book, index: usize) -> u64 {
        let mut hasher = DefaultHasher::new();
        let entry = &book.entries[index];
        for guess in self.guesses.iter().filter(|g| entry.mentions.contains_key(&g.name)) {
            (&guess.name, format!("{:?}", guess.role), &guess.each, guess.lent).hash(&mut hasher);
        }
        let clauses = book.statement(index, Version::Printed).map(|s| s.clauses).unwrap_or_default();
        let Some(whole) = Spoken::of(&entry.scope, &clauses) else { return hasher.finish() };
        // What hangs together with a link hangs together with the whole equation, and comes in the same order.
        for k in nearby(book, index, &self.candidates, &self.named[index], &whole) {
            let candidate = &self.candidates[k];
            match &candidate.source {
                Origin::Display(_, label) => (true, label).hash(&mut hasher),
                Origin::Part(_, label, latex) => (label, latex).hash(&mut hasher),
                Origin::Inline(latex) => (false, latex).hash(&mut hasher),
            }
            (&candidate.symbols, candidate.equations, &candidate.parts).hash(&mut hasher);
            (candidate.moves, &candidate.rates).hash(&mut hasher);
        }
        hasher.finish()
    }
}
