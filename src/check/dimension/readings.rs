//! The readings of a document's equations, kept from one survey to the next.
//!
//! Each equation is read with numbers of its own for the quantities without a declared unit; these become the
//! document's numbers, in the order of the document, when the readings are put together.

use std::collections::HashSet;
use std::sync::Arc;

use rayon::prelude::*;

use crate::check::book::{Book, Entry, Formula, Version};
use crate::check::fingerprint::Fingerprints;
use crate::check::memo::Memo;
use crate::semantics::{self, Clause, Scope};
use crate::trace::{Trace, recorded};

use super::Equation;
use super::affine::Affine;
use super::mend::{self, Used, Uses};
use super::reading::{self, LinkReading, Quantities};

/// What is remembered of earlier surveys.
#[derive(Debug, Default)]
pub struct Readings(Memo<Reading>);

/// What an equation says of dimensions, with numbers of its own for the quantities.
#[derive(Clone, Debug)]
struct Reading {
    /// The premises that are told here and nowhere before.
    premises: Vec<String>,
    quantities: Quantities,
    used: Used,
    equation: Arc<Equation>,
}

impl Readings {
    /// The readings of a book's equations, the quantities in the order in which they are met, and what they use.
    pub(super) fn equations(&mut self, prints: &Fingerprints) -> (Vec<Arc<Equation>>, Quantities, Uses) {
        let book = prints.book;
        self.0.forget_others(prints);
        let premises = premises(book);
        let remembered: Vec<Option<&Reading>> = premises
            .par_iter()
            .enumerate()
            .map(|(k, premises)| self.0.recall(prints, k).map(|known| &known.value).filter(|r| r.premises == *premises))
            .collect();
        let new: Vec<Option<(Reading, Trace)>> = remembered
            .par_iter()
            .zip(&premises)
            .enumerate()
            .map(|(k, (known, premises))| known.is_none().then(|| recorded(|| read(book, k, premises))))
            .collect();
        let (mut quantities, mut uses) = (Quantities::default(), Uses::default());
        let readings = remembered.iter().zip(&new).map(|(known, new)| known.or(new.as_ref().map(|(r, _)| r)));
        readings.clone().flatten().for_each(|reading| uses.count(&reading.used));
        let equations = readings.zip(book.entries.iter());
        let equations = equations
            .map(|(reading, entry)| reading.map(|r| r.entered(&entry.scope, &mut quantities)).unwrap_or_default());
        let equations = equations.collect();
        for (k, (reading, trace)) in new.into_iter().enumerate().filter_map(|(k, new)| Some((k, new?))) {
            self.0.learn(prints, k, trace, reading);
        }
        (equations, quantities, uses)
    }
}

/// The premises that each equation's annotation and its section state, each where it is told first.
fn premises(book: &Book) -> Vec<Vec<String>> {
    let mut seen = HashSet::new();
    let mut new = |entry: &Entry| {
        if entry.scope.natural_units {
            return Vec::new();
        }
        let texts = entry.scope.assume.iter().chain(entry.wheres(None)).filter(|t| seen.insert(t.span.start));
        texts.map(|text| text.value.clone()).collect()
    };
    book.entries.iter().map(&mut new).collect()
}

fn read(book: &Book, index: usize, premises: &[String]) -> Reading {
    let entry = &book.entries[index];
    let mut quantities = Quantities::default();
    let (premises, used) = (premises.to_vec(), mend::used(entry));
    if entry.scope.natural_units {
        return Reading { premises, quantities, used, equation: Arc::default() };
    }
    let mapped = entry.annotation().is_some_and(|a| a.maps.is_some());
    let clauses = |version| book.statement(index, version).map(|s| s.clauses).unwrap_or_default();
    let mut read = |clause: &Clause| reading::read(&entry.scope, clause, mapped, &mut quantities);
    let printed: Vec<Option<LinkReading>> = clauses(Version::Printed).iter().map(&mut read).collect();
    let correction = entry.correction.as_ref().map(|_| clauses(Version::Corrected));
    let corrected = correction.map(|clauses| clauses.iter().map(&mut read).collect());
    let stated = stated(&entry.scope, &premises, &mut quantities);
    let equation = Equation { printed, corrected, premises: stated };
    Reading { premises, quantities, used, equation: Arc::new(equation) }
}

/// What premises say of unknown dimensions.
fn stated(scope: &Scope, premises: &[String], quantities: &mut Quantities) -> Vec<LinkReading> {
    let trees = premises.iter().filter_map(|text| Formula::new(text).tree.ok());
    let statements = trees.filter_map(|tree| semantics::statement(&tree, None).ok());
    let clauses: Vec<Clause> = statements.flat_map(|s| s.clauses).collect();
    let read = clauses.iter().filter_map(|clause| reading::read(scope, clause, false, quantities));
    read.filter(LinkReading::has_unknowns).collect()
}

impl Reading {
    /// With the numbers of the document for the quantities, as they are declared in the scope where it stands.
    fn entered(&self, scope: &Scope, quantities: &mut Quantities) -> Arc<Equation> {
        let numbers: Vec<usize> = self
            .quantities
            .all
            .iter()
            .map(|quantity| {
                let declared = scope.get(&quantity.name).map_or(quantity.declared, |entry| entry.declared);
                quantities.number(&semantics::Quantity { declared, ..quantity.clone() })
            })
            .collect();
        let mut entered = Arc::clone(&self.equation);
        if numbers.is_empty() {
            return entered;
        }
        let Equation { printed, corrected, premises } = Arc::make_mut(&mut entered);
        let links = printed.iter_mut().chain(corrected.iter_mut().flatten()).flatten();
        links.chain(premises).for_each(|link| renumber(link, &numbers));
        entered
    }
}

fn renumber(link: &mut LinkReading, numbers: &[usize]) {
    let joined = link.joints.iter_mut().flat_map(|j| &mut j.components).flatten().map(|(_, affine)| affine);
    let implied = link.implied.iter_mut().flat_map(|(a, b)| [a, b]);
    let number = |k: usize| numbers.get(k).copied().unwrap_or(k);
    joined.chain(implied).for_each(|affine: &mut Affine| {
        affine.unknown = std::mem::take(&mut affine.unknown).into_iter().map(|(k, n)| (number(k), n)).collect();
    });
}
