//! Results of work on equations, kept with what they rest on: as long as that is the same, so is the result.

use std::collections::{HashMap, VecDeque};

use crate::trace::Trace;

use super::fingerprint::{Fingerprint, Fingerprints, Footing};

/// The most results that are kept for a label: what an author undoes is known still.
const KEPT: usize = 4;

/// Results by the labels of the equations.
#[derive(Debug)]
pub struct Memo<T> {
    known: HashMap<String, VecDeque<Known<T>>>,
}

/// A result with what it rests on.
#[derive(Debug)]
pub struct Known<T> {
    /// The result.
    pub value: T,
    /// The questions asked.
    pub footing: Footing,
    print: Fingerprint,
}

impl<T> Default for Memo<T> {
    fn default() -> Self {
        Memo { known: HashMap::new() }
    }
}

impl<T> Memo<T> {
    /// What is known of the equation at a place, where all that it rests on is as it was.
    pub fn recall(&self, prints: &Fingerprints, index: usize) -> Option<&Known<T>> {
        let known = self.known.get(&prints.book.entries.quietly(index).equation.label)?;
        known.iter().find(|known| prints.agree(index, &known.footing, &known.print))
    }

    /// Keeps a result with what the work asked for it.
    pub fn learn(&mut self, prints: &Fingerprints, index: usize, trace: Trace, value: T) {
        let Some(footing) = Footing::new(prints.book, index, trace) else { return };
        let Some(print) = prints.of(index, &footing) else { return };
        let label = &prints.book.entries.quietly(index).equation.label;
        let known = self.known.entry(label.clone()).or_default();
        known.push_front(Known { value, footing, print });
        known.truncate(KEPT);
    }

    /// Forgets what is known of labels that a book does not have.
    pub fn forget_others(&mut self, prints: &Fingerprints) {
        self.known.retain(|label, _| prints.book.labelled(label).is_some());
    }
}
