//! How good the suggestions are: the rank of the annotated correction among them, and of the original among those for
//! its mutants.

use std::time::{Duration, Instant};

use crate::check::verdict::{Judgement, Suggestion, Verdict};
use crate::check::{Book, Options, Outcome, Random, Trial, Version, judge_tree};
use crate::latex::ast::Node;
use crate::latex::{self, to_latex};

use super::correct::{self, meant};
use super::mutants::EditKind;
use super::sensitivity::try_mutants;

/// Where a formula is among the suggestions for another.
#[derive(Clone, Debug)]
pub struct Rank {
    /// The equation's label.
    pub label: String,
    /// Its place among the suggestions, counted from 0, itself or something that says the same; `None` where it is not
    /// among them.
    pub place: Option<usize>,
    /// The suggestions.
    pub suggestions: Vec<Suggestion>,
    /// For a mutant: what was edited, and in words.
    pub edit: Option<(EditKind, String)>,
    /// How long the search took.
    pub time: Duration,
}

/// The rank of the annotated correction, for an erratum; `None` for other equations. The search does not see it.
pub fn rank_of_correction(book: &Book, index: usize, judgement: &Judgement, options: &Options) -> Option<Rank> {
    let correction = judgement.correction.as_ref().filter(|_| judgement.is_erratum())?;
    let trial = Trial::new(book, index, Version::Corrected, &correction.links, options)?;
    let begin = Instant::now();
    let suggestions = correct::suggestions(book, index, judgement, options);
    let time = begin.elapsed();
    let place = place(&trial, &correction.latex, &suggestions);
    Some(Rank { label: judgement.label.clone(), place, suggestions, edit: None, time })
}

/// The ranks of an equation that holds (its correction, where it fails) among the suggestions for its mutants, for so
/// many of the mutants that fail, drawn by the seed. The mutants are taken for what was printed.
pub fn ranks_of_original(
    book: &Book,
    index: usize,
    judgement: &Judgement,
    options: &Options,
    most: usize,
) -> Vec<Rank> {
    let (version, links) = match (judgement.verdict, &judgement.correction) {
        (Verdict::Holds | Verdict::Asymptotic, _) => (Version::Printed, &judgement.links),
        (_, Some(correction)) => (Version::Corrected, &correction.links),
        _ => return Vec::new(),
    };
    let Some(tried) = try_mutants(book, index, judgement, options) else { return Vec::new() };
    let Some(trial) = Trial::new(book, index, version, links, options) else { return Vec::new() };
    let original = book.entries[index].formula(version).latex.clone();
    let mut killed: Vec<_> = tried.into_iter().filter(|t| t.outcome == Outcome::Fails).collect();
    let mut random = Random::new(options.seed, &format!("{}/misprints", judgement.label));
    let mut ranks = Vec::new();
    while ranks.len() < most && !killed.is_empty() {
        let k = usize::try_from(random.below(killed.len() as u64)).unwrap_or(0);
        let mutant = killed.swap_remove(k).mutant;
        let begin = Instant::now();
        let links = judge_tree(book, index, &mutant.tree, options);
        let suggestions = meant(book, index, &mutant.tree, &links, options);
        ranks.push(Rank {
            label: judgement.label.clone(),
            place: place(&trial, &original, &suggestions),
            suggestions,
            edit: Some((mutant.edit.kind, mutant.edit.text)),
            time: begin.elapsed(),
        });
    }
    ranks
}

/// The first of the suggestions that is a formula, or says the same.
fn place(trial: &Trial, formula: &str, suggestions: &[Suggestion]) -> Option<usize> {
    let own: Option<String> = latex::parse(formula).ok().map(|tree: Node| to_latex(&tree));
    suggestions.iter().position(|s| {
        let tree = latex::parse(&s.latex);
        tree.is_ok_and(|tree| own.as_ref() == Some(&to_latex(&tree)) || trial.is_equivalent(&tree))
    })
}
