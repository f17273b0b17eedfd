//! Places in the file that move with the text around them.

use crate::check::verdict::Judgement;
use crate::check::{Book, Entry};
use crate::document::{Problem, Span};

/// The pieces of the file that a judgement may point into, in an order that does not depend on where they stand.
#[derive(Debug)]
pub struct Anchors(Vec<Span>);

impl Anchors {
    /// Of the equation at a place and of those looked at for it.
    pub fn of(book: &Book, index: usize, looked_at: impl Iterator<Item = usize>) -> Self {
        let label = |k: usize| &book.entries[k].equation.label;
        let mut others: Vec<usize> = looked_at.filter(|k| *k != index).collect();
        others.sort_by_key(|k| label(*k));
        Anchors(std::iter::once(index).chain(others).flat_map(|k| pieces(&book.entries[k])).collect())
    }

    /// The piece that holds a span, and where in it.
    fn find(&self, span: &Span) -> Option<(usize, Span)> {
        let holds = |piece: &Span| piece.start <= span.start && span.end <= piece.end;
        let at = self.0.iter().position(holds)?;
        let start = self.0[at].start;
        Some((at, span.start - start..span.end - start))
    }

    fn place(&self, (at, span): &(usize, Span)) -> Option<Span> {
        let start = self.0.get(*at)?.start;
        Some(start + span.start..start + span.end)
    }
}

/// An equation, its annotation, and what is assumed where it stands.
fn pieces(entry: &Entry) -> Vec<Span> {
    let assumed = entry.scope.assume.iter().map(|text| text.span.clone());
    let annotation = entry.annotation().map_or(0..0, |a| a.span.clone());
    [entry.equation.span.clone(), annotation].into_iter().chain(assumed).collect()
}

/// A judgement whose places are told by anchors.
#[derive(Debug)]
pub struct Placed<T> {
    value: T,
    /// The places in the order in which [`spans`] gives them.
    places: Vec<(usize, Span)>,
}

impl Placed<Judgement> {
    /// `None` where it points to a place that no anchor holds.
    pub fn new(mut judgement: Judgement, anchors: &Anchors) -> Option<Self> {
        let places = spans(&mut judgement).into_iter().map(|span| anchors.find(span)).collect::<Option<_>>()?;
        Some(Placed { value: judgement, places })
    }

    /// The judgement with the places that it has among other anchors.
    pub fn placed(&self, anchors: &Anchors) -> Option<Judgement> {
        let mut judgement = self.value.clone();
        for (span, place) in spans(&mut judgement).into_iter().zip(&self.places) {
            *span = anchors.place(place)?;
        }
        Some(judgement)
    }
}

/// All places that a judgement points to.
fn spans(judgement: &mut Judgement) -> Vec<&mut Span> {
    let correction = judgement.correction.iter_mut();
    let corrected =
        correction.flat_map(|c| c.problem.iter_mut().chain(c.links.iter_mut().flat_map(|l| &mut l.problem)));
    let links = judgement.links.iter_mut().flat_map(|link| &mut link.problem);
    let problems = judgement.problem.iter_mut().chain(links).chain(corrected);
    problems
        .flat_map(|problem: &mut Problem| {
            std::iter::once(&mut problem.span).chain(problem.other.iter_mut().map(|(span, _)| span))
        })
        .collect()
}
