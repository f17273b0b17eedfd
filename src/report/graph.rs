//! Which equation rests on which, and what failing ones endanger.

use crate::check::verdict::{DocumentReport, Judgement, Verdict};
use std::collections::HashMap;

/// The most failing equations that are named for one that they endanger: the nearest.
const MOST_NAMED: usize = 5;

/// A premise of an equation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Premise {
    /// The place of the equation that it is, in the order of the document.
    pub equation: usize,
    /// Whether Kenzan found it, where the notes name none.
    pub found: bool,
}

/// The equations of a document and what they rest on; all by their places in the document.
pub(super) struct Graph {
    /// What each rests on.
    pub premises: Vec<Vec<Premise>>,
    /// What rests on each.
    pub dependents: Vec<Vec<usize>>,
    /// The failing equations that each rests on, directly or through others; the nearest few.
    pub threats: Vec<Vec<usize>>,
}

impl Graph {
    /// Of a document.
    pub fn of(document: &DocumentReport) -> Self {
        let premises = premises(&document.equations);
        let mut dependents = vec![Vec::new(); premises.len()];
        for (equation, on) in premises.iter().enumerate() {
            on.iter().for_each(|p| dependents[p.equation].push(equation));
        }
        let failing = document.equations.iter().map(|e| e.verdict == Verdict::Fails).collect::<Vec<_>>();
        let threats = threats(&failing, &dependents);
        Graph { premises, dependents, threats }
    }

    /// Whether the equation rests on another or another on it.
    pub fn is_linked(&self, equation: usize) -> bool {
        !self.premises[equation].is_empty() || !self.dependents[equation].is_empty()
    }
}

/// The premises by their labels: of several equations with one label the last before, or else the first.
fn premises(equations: &[Judgement]) -> Vec<Vec<Premise>> {
    let mut labels: HashMap<&str, usize> = HashMap::new();
    for (k, equation) in equations.iter().enumerate() {
        labels.entry(&equation.label).or_insert(k);
    }
    let mut premises = Vec::with_capacity(equations.len());
    for (k, equation) in equations.iter().enumerate() {
        // Where nothing is annotated all premises were found.
        let found = equation.inferred.is_some();
        let mut on: Vec<Premise> = Vec::new();
        for label in equation.given.iter().chain(equation.inferred.iter().flat_map(|i| &i.given)) {
            let Some(&at) = labels.get(label.as_str()) else { continue };
            if at != k && on.iter().all(|p| p.equation != at) {
                on.push(Premise { equation: at, found });
            }
        }
        premises.push(on);
        labels.insert(&equation.label, k);
    }
    premises
}

/// The failing equations that each rests on, by going from all of them in step: the nearest come first.
fn threats(failing: &[bool], dependents: &[Vec<usize>]) -> Vec<Vec<usize>> {
    let mut threats: Vec<Vec<usize>> = vec![Vec::new(); failing.len()];
    let mut front: Vec<(usize, usize)> = (0..failing.len()).filter(|k| failing[*k]).map(|k| (k, k)).collect();
    while !front.is_empty() {
        let mut next = Vec::new();
        for (at, source) in front {
            for &on in &dependents[at] {
                let known = &mut threats[on];
                if on != source && known.len() < MOST_NAMED && !known.contains(&source) {
                    known.push(source);
                    next.push((on, source));
                }
            }
        }
        front = next;
    }
    threats
}

#[cfg(test)]
mod tests {
    use super::super::fixture::{judgement, link};
    use super::*;

    fn document(equations: &[(&str, &[&str], Verdict)]) -> DocumentReport {
        let equation = |(label, given, verdict): &(&str, &[&str], Verdict)| Judgement {
            given: given.iter().map(|g| (*g).to_owned()).collect(),
            ..judgement(label, "derived", link("a = b", *verdict))
        };
        DocumentReport { equations: equations.iter().map(equation).collect(), ..super::super::fixture::empty() }
    }

    #[test]
    fn what_rests_on_a_failing_equation_is_endangered() {
        use Verdict::{Fails, Holds};
        let graph = Graph::of(&document(&[
            ("1", &[], Holds),
            ("2", &["1"], Fails),
            ("3", &["2"], Holds),
            ("4", &["3", "1"], Fails),
            ("5", &["4", "nowhere", "5"], Holds),
            ("6", &["1"], Holds),
        ]));
        assert_eq!(graph.threats, [vec![], vec![], vec![1], vec![1], vec![3, 1], vec![]]);
        assert_eq!(graph.dependents[0], [1, 3, 5]);
        assert!(graph.premises[4] == [Premise { equation: 3, found: false }] && graph.is_linked(4));
    }

    #[test]
    fn circles_endanger_themselves_and_end() {
        let graph = Graph::of(&document(&[("1", &["2"], Verdict::Fails), ("2", &["1"], Verdict::Holds)]));
        assert_eq!(graph.threats, [vec![], vec![0]]);
    }

    #[test]
    fn a_label_means_the_last_before() {
        let none: &[&str] = &[];
        let holds = Verdict::Holds;
        let graph =
            Graph::of(&document(&[("1", none, holds), ("1", none, holds), ("2", &["1"], holds), ("1", none, holds)]));
        assert_eq!(graph.premises[2], [Premise { equation: 1, found: false }]);
    }
}
