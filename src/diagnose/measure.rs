//! How good the suggestions are: the rank of the annotated correction among them, and of the original among those for
//! its mutants.

use std::collections::HashSet;
use std::time::{Duration, Instant};

use crate::check::verdict::{Judgement, LinkJudgement, Strength, Suggestion, Verdict};
use crate::check::{Book, Options, Outcome, Random, Trial, Version, judge_tree};
use crate::latex::ast::Node;
use crate::latex::{self, to_latex};

use super::correct::{self, meant};
use super::mutants::{EditKind, Mutant, Reach, mutants};
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
    let Some((version, links)) = holding(judgement) else { return Vec::new() };
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

/// What became of mutants with one or two edits under the normal check, and of those that it passes under another one.
#[derive(Clone, Debug, Default)]
pub struct Soundness {
    /// The mutants that were judged.
    pub judged: usize,
    /// Those that fail.
    pub killed: usize,
    /// Those that are undecided, make no sense or only define something.
    pub open: usize,
    /// Those that hold and say the same as the original by a rule that does not rest on the check.
    pub same: usize,
    /// Those that hold otherwise, and are proved in the prime field from other random points.
    pub exact: usize,
    /// Those that hold otherwise, and hold at other states, too; there is no exact test for them.
    pub elsewhere: usize,
    /// Those that hold and at other states do not: false verdicts. The LaTeX.
    pub refuted: Vec<String>,
    /// Those that hold and at other states cannot be judged.
    pub unconfirmed: Vec<String>,
}

/// Judges so many mutants of an equation that holds, all with one edit and then random ones with two. What holds is
/// judged anew with another seed, so at other states, at four times as many, and in the prime field at other points.
pub fn soundness(
    book: &Book,
    index: usize,
    judgement: &Judgement,
    options: &Options,
    most: usize,
) -> Option<Soundness> {
    let (version, links) = holding(judgement)?;
    let entry = &book.entries[index];
    let tree = entry.formula(version).tree.as_ref().ok()?;
    let mut trial = Trial::new(book, index, version, links, options)?;
    let other = Options { seed: options.seed ^ 0x5eed, states: 4 * options.states, ..options.clone() };
    let singles = mutants(tree, &entry.scope, Reach::MUTANTS);
    let mut random = Random::new(options.seed, &format!("{}/soundness", judgement.label));
    let mut result = Soundness::default();
    let mut seen = HashSet::from([to_latex(tree)]);
    let mut tries = 0;
    while result.judged < most && tries < 4 * most {
        let mutant = match singles.get(tries) {
            Some(single) => Some(single.tree.clone()),
            None => pair(&singles, &mut random),
        };
        tries += 1;
        let Some(mutant) = mutant.filter(|m| seen.insert(to_latex(m))) else { continue };
        result.judged += 1;
        match trial.judge(&mutant) {
            Outcome::Fails | Outcome::Misshapen => result.killed += 1,
            Outcome::Definition | Outcome::Undecided | Outcome::Unclear => result.open += 1,
            Outcome::Holds if trial.is_equivalent(&mutant) => result.same += 1,
            Outcome::Holds => {
                let again = judge_tree(book, index, &mutant, &other);
                let worst = again.iter().map(|l| l.verdict).max();
                let exact = |l: &LinkJudgement| l.verdict == Verdict::Definition || l.strength == Some(Strength::Exact);
                match worst {
                    Some(Verdict::Fails) => result.refuted.push(to_latex(&mutant)),
                    Some(Verdict::Undecided | Verdict::Unreadable) | None => result.unconfirmed.push(to_latex(&mutant)),
                    _ if again.iter().all(exact) => result.exact += 1,
                    _ => result.elsewhere += 1,
                }
            }
        }
    }
    Some(result)
}

/// Two random edits of a formula at once.
fn pair(singles: &[Mutant], random: &mut Random) -> Option<Node> {
    let mut any = || singles.get(usize::try_from(random.below(singles.len() as u64)).ok()?);
    let (a, b) = (any()?, any()?);
    a.with(b)
}

/// The version of an equation that holds, with its links: as printed, or else as corrected.
fn holding(judgement: &Judgement) -> Option<(Version, &[LinkJudgement])> {
    match (judgement.verdict, &judgement.correction) {
        (Verdict::Holds | Verdict::Asymptotic, _) => Some((Version::Printed, &judgement.links)),
        (_, Some(c)) if matches!(c.verdict, Verdict::Holds | Verdict::Asymptotic) => {
            Some((Version::Corrected, &c.links))
        }
        _ => None,
    }
}

/// The first of the suggestions that is a formula, or says the same.
fn place(trial: &Trial, formula: &str, suggestions: &[Suggestion]) -> Option<usize> {
    let own: Option<String> = latex::parse(formula).ok().map(|tree: Node| to_latex(&tree));
    suggestions.iter().position(|s| {
        let tree = latex::parse(&s.latex);
        tree.is_ok_and(|tree| own.as_ref() == Some(&to_latex(&tree)) || trial.is_equivalent(&tree))
    })
}
