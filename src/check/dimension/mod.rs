//! Dimensions: whether the terms of an equation have one.
//!
//! Units are declared for some symbols and inferred for the rest. A [`Survey`] reads every equation of a document (as
//! corrected, where it has a correction) and every premise once; what they say together of an undeclared unit is taken
//! for granted when an equation is checked, except what that equation says itself: an equation whose own unknown units
//! take whatever dimension it needs is unchecked, not right.
//!
//! Promises: a mismatch is one whatever the undeclared units are, by the declared units and the other equations; it
//! decides no verdict. `const.` and 0 have any dimension.

mod affine;
mod finding;
mod mend;
mod reading;
mod readings;

#[cfg(test)]
mod tests;

use std::sync::Arc;

use crate::semantics;

use self::affine::{Affine, Outcome, System};
use self::mend::Uses;
use self::reading::{JointReading, LinkReading, Quantities};
pub use self::readings::Readings;
use super::book::{Book, Version};
use super::fingerprint::Fingerprints;
use super::verdict::{DimensionFinding, DimensionStatus, InferredDimension, Judgement};

/// The dimensions of a whole document.
pub struct Survey<'b> {
    book: &'b Book,
    quantities: Quantities,
    equations: Vec<Arc<Equation>>,
    uses: Uses,
    /// Whether more hold undeclared units than are solved for.
    too_many: bool,
}

/// The most relations with undeclared units of which those units are inferred: each equation is checked by what all others
/// say, so that the time grows with the third power.
const MOST_STATED: usize = 600;

/// What an equation says of dimensions.
#[derive(Clone, Debug, Default)]
struct Equation {
    /// Its links as printed; `None` for one that is not understood.
    printed: Vec<Option<LinkReading>>,
    /// Its links as corrected, where it has a correction.
    corrected: Option<Vec<Option<LinkReading>>>,
    /// Its premises that hold unknown dimensions.
    premises: Vec<LinkReading>,
}

/// Whether an equation's terms have one dimension.
#[derive(Clone, Debug, PartialEq)]
pub struct Dimensions {
    /// In a word.
    pub status: DimensionStatus,
    /// Where they have not.
    pub findings: Vec<DimensionFinding>,
}

impl Equation {
    fn links(&self, version: Version) -> &[Option<LinkReading>] {
        match (version, &self.corrected) {
            (Version::Corrected, Some(corrected)) => corrected,
            _ => &self.printed,
        }
    }

    /// What others may infer from it.
    fn stated(&self) -> impl Iterator<Item = &LinkReading> {
        self.links(Version::Corrected).iter().flatten().filter(|link| link.has_unknowns())
    }
}

impl<'b> Survey<'b> {
    /// Reads the dimensions of every equation and premise of a book.
    pub fn new(book: &'b Book) -> Self {
        Survey::with(&Fingerprints::new(book), &mut Readings::default())
    }

    /// As [`Survey::new`], without reading again what is as it was.
    pub fn with(prints: &Fingerprints<'b>, readings: &mut Readings) -> Self {
        let book = prints.book;
        let (equations, quantities, uses) = readings.equations(prints);
        let too_many = equations.iter().map(|e| e.premises.len() + e.stated().count()).sum::<usize>() > MOST_STATED;
        Survey { book, quantities, equations, uses, too_many }
    }

    /// Enters the finding on an equation, and on its correction, into its judgement.
    pub fn report(&self, index: usize, judgement: &mut Judgement) {
        let Dimensions { status, findings } = self.judge(index, Version::Printed);
        (judgement.dimension, judgement.dimension_findings) = (status, findings);
        if let Some(correction) = &mut judgement.correction {
            correction.dimension = self.judge(index, Version::Corrected).status;
        }
    }

    /// Checks the dimensions of a version of an equation.
    pub fn judge(&self, index: usize, version: Version) -> Dimensions {
        let links = self.equations[index].links(version);
        let unknown = links.iter().flatten().any(LinkReading::has_unknowns);
        let mut system = if unknown { self.knowledge(Some(index)) } else { System::default() };
        let mut findings: Vec<DimensionFinding> = Vec::new();
        let statuses: Vec<DimensionStatus> = links
            .iter()
            .filter_map(|link| match link {
                Some(link) => self.check(index, link, &mut system, &mut findings),
                None => Some(DimensionStatus::Unchecked),
            })
            .collect();
        Dimensions { status: statuses.into_iter().max().unwrap_or(DimensionStatus::Unchecked), findings }
    }

    /// The dimensions that are not declared and follow from the equations.
    pub fn inferred(&self) -> Vec<InferredDimension> {
        let system = self.knowledge(None);
        let found = system.found().map(|(quantity, dimension, origin)| InferredDimension {
            symbol: self.quantities.all[quantity].name.clone(),
            dimension: dimension.to_string(),
            from: self.book.entries[origin].equation.label.clone(),
        });
        found.collect()
    }

    /// What the equations and premises say of undeclared units, without one equation. What contradicts the earlier ones
    /// is passed over: it shows where that equation is checked. Of very many nothing is inferred.
    fn knowledge(&self, except: Option<usize>) -> System {
        let mut system = System::default();
        if self.too_many {
            return system;
        }
        for (origin, equation) in self.equations.iter().enumerate() {
            let stated = equation.stated().filter(|_| except != Some(origin));
            for link in equation.premises.iter().chain(stated) {
                let mut trial = system.clone();
                if state(link, &mut trial, origin) {
                    system = trial;
                }
            }
        }
        system
    }

    /// Checks a link; `None` where there is nothing to compare, as in x = 0.
    fn check(
        &self,
        index: usize,
        link: &LinkReading,
        system: &mut System,
        findings: &mut Vec<DimensionFinding>,
    ) -> Option<DimensionStatus> {
        let mut inner = Comparison::default();
        let mut top = Comparison::default();
        let before = findings.len();
        for (k, joint) in link.joints.iter().enumerate() {
            let comparison = if k + 1 == link.joints.len() { &mut top } else { &mut inner };
            if let Some(groups) = compare(joint, system, index, comparison) {
                let finding = self.finding(index, link, joint, &groups);
                // What two links share is found once, and the sum in an argument tells of the argument.
                let told = joint.role != semantics::Role::Sum && inner.mismatch;
                if !told && !findings.iter().any(|f| f.message == finding.message) {
                    findings.push(finding);
                }
                inner.mismatch = true;
            }
        }
        for (a, b) in &link.implied {
            if system.equate(a, b, index) == Outcome::Contradicts && !inner.mismatch && findings.len() == before {
                findings.push(self.implied(link, &system.reduce(a), &system.reduce(b)));
                inner.mismatch = true;
            }
        }
        match (top.agreed, top.bound, inner.agreed) {
            _ if inner.mismatch => Some(DimensionStatus::Mismatch),
            (0, 0, 0) if !link.units => None,
            (0, 0, _) if !link.units => Some(DimensionStatus::Ok),
            (0, ..) => Some(DimensionStatus::Unchecked),
            _ => Some(DimensionStatus::Ok),
        }
    }
}

/// What comparing dimensions came to.
#[derive(Default)]
struct Comparison {
    /// How often two dimensions agreed that could have differed.
    agreed: usize,
    /// How often they were made to agree by an unknown one.
    bound: usize,
    mismatch: bool,
}

/// Parts of a joint that have the same dimension.
struct Group {
    dimension: Affine,
    parts: Vec<usize>,
}

/// Compares what a joint joins; the groups of different dimension, where there are several whatever is unknown.
fn compare(joint: &JointReading, system: &mut System, origin: usize, count: &mut Comparison) -> Option<Vec<Group>> {
    for component in &joint.components {
        if let Some(agreed) = all_known(joint, component) {
            count.agreed += agreed;
            continue;
        }
        let mut dimensions = component.clone();
        if joint.role != semantics::Role::Sum {
            // An argument is compared with a number.
            dimensions.insert(0, (usize::MAX, Affine::of(semantics::units::Dimension::NONE)));
        }
        let mut bound = 0;
        let groups = loop {
            let groups = grouped(&dimensions, system);
            let Some(most) = groups.iter().max_by_key(|g| (g.dimension.dimension().is_some(), g.parts.len())) else {
                break groups;
            };
            let binds = |g: &Group| system.clone().equate(&most.dimension, &g.dimension, origin) == Outcome::Binds;
            let Some(open) = groups.iter().find(|g| binds(g)) else { break groups };
            system.equate(&most.dimension, &open.dimension, origin);
            bound += 1;
        };
        if groups.len() > 1 {
            return Some(groups);
        }
        count.bound += bound;
        count.agreed += dimensions.len().saturating_sub(1 + bound);
    }
    None
}

/// How often the dimensions of a component agree where all of them are known and the same, as nearly always.
fn all_known(joint: &JointReading, component: &[(usize, Affine)]) -> Option<usize> {
    let mut known = component.iter().map(|(_, a)| a.dimension());
    match joint.role {
        semantics::Role::Sum => {
            let first = known.next()??;
            known.all(|d| d == Some(first)).then(|| component.len() - 1)
        }
        _ => known.all(|d| d.is_some_and(|d| d.is_none())).then_some(component.len()),
    }
}

/// The parts by their dimensions, in the order of printing.
fn grouped(dimensions: &[(usize, Affine)], system: &System) -> Vec<Group> {
    let mut groups: Vec<Group> = Vec::new();
    for (part, dimension) in dimensions {
        let dimension = system.reduce(dimension);
        match groups.iter_mut().find(|g| g.dimension == dimension) {
            Some(group) => group.parts.push(*part),
            None => groups.push(Group { dimension, parts: vec![*part] }),
        }
    }
    groups
}

/// Takes in what a link says; `false` where it contradicts what is known.
fn state(link: &LinkReading, system: &mut System, origin: usize) -> bool {
    let mut count = Comparison::default();
    link.joints.iter().all(|joint| compare(joint, system, origin, &mut count).is_none())
        && link.implied.iter().all(|(a, b)| system.equate(a, b, origin) != Outcome::Contradicts)
}
