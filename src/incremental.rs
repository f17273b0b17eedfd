//! What is remembered from one verification of notes to the next, so that only what changed is judged again.
//!
//! A judgement is kept with all that was asked of the notes for it ([`trace`](crate::trace)): the equation and its
//! annotation, the equations it rests on, the declarations of the symbols in them and of those that turned out to be
//! none, whether a symbol is mentioned before. While the answers are the same, the judgement is, too: the random states
//! depend on the seed, the label and the formula, not on where the equation stands.
//!
//! Promise: a verification with a memory says what one without says, byte for byte, times apart. What is cut short by the
//! clock stays as it was.

mod place;

use rayon::prelude::*;

use crate::check::dimension::Readings;
use crate::check::verdict::Judgement;
use crate::check::{Book, Fingerprints, Formulas, Memo};
use crate::document::Document;
use crate::trace::{Trace, recorded};

use place::{Anchors, Placed};

/// What is remembered of one document under one request.
#[derive(Debug, Default)]
pub struct Memory {
    formulas: Formulas,
    judgements: Memo<Placed<Judgement>>,
    /// What the equations say of dimensions.
    pub readings: Readings,
}

/// The judgements on equations of a book.
pub struct Judged {
    /// In the order in which they were asked for.
    pub judgements: Vec<Judgement>,
    /// The places in the book of those that were not remembered.
    pub anew: Vec<usize>,
}

impl Memory {
    /// A document ready to be judged.
    pub fn book(&mut self, document: &Document) -> Book {
        Book::with(document, &self.formulas)
    }

    /// The judgements on the equations `wanted`: remembered, or else by `judge`.
    pub fn judge(
        &mut self,
        prints: &Fingerprints,
        wanted: &[usize],
        judge: impl Fn(usize) -> Judgement + Sync,
    ) -> Judged {
        self.judgements.forget_others(prints);
        let remembered: Vec<Option<Judgement>> = wanted.par_iter().map(|k| self.remembered(prints, *k)).collect();
        let missing: Vec<usize> =
            wanted.iter().zip(&remembered).filter(|(_, known)| known.is_none()).map(|(k, _)| *k).collect();
        let new: Vec<(Judgement, Trace)> = missing.par_iter().map(|k| recorded(|| judge(*k))).collect();
        for (index, (judgement, trace)) in missing.iter().zip(&new) {
            let anchors = Anchors::of(prints.book, *index, trace.equations.iter().copied());
            if let Some(placed) = Placed::new(judgement.clone(), &anchors) {
                self.judgements.learn(prints, *index, trace.clone(), placed);
            }
        }
        let mut new = new.into_iter().map(|(judgement, _)| judgement);
        let judgements = remembered.into_iter().filter_map(|known| known.or_else(|| new.next())).collect();
        Judged { judgements, anew: missing }
    }

    fn remembered(&self, prints: &Fingerprints, index: usize) -> Option<Judgement> {
        let known = self.judgements.recall(prints, index)?;
        let equations: Vec<usize> = known.footing.equations(prints.book).collect();
        let mut judgement = known.value.placed(&Anchors::of(prints.book, index, equations.into_iter()))?;
        let entry = &prints.book.entries[index];
        // What is told of where it stands.
        judgement.line = entry.equation.line;
        judgement.section.clone_from(&entry.section);
        Some(judgement)
    }
}
