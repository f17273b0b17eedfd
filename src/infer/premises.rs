//! The search for what an equation follows from: candidates one by one, in small sets, and at last all that hang
//! together.

use std::collections::BTreeSet;

use crate::check::verdict::{LinkJudgement, Verdict};
use crate::check::{Book, Options, Outcome, Trial, Version, judge_one};
use crate::diagnose::mutants::{Reach, mutants};
use crate::document::{EquationAnnotation, LinkPremises, Spanned};

use super::candidates::{Candidate, Origin, Spoken};
use super::subsets::{hang_together, subsets};

/// How many candidates are combined, the nearest.
const NEAREST: usize = 24;
/// How many sets of each size are judged.
const JUDGED: usize = 40;
/// The sizes of the larger sets that are tried as a whole.
const LADDER: [usize; 3] = [6, 9, 14];
/// The states at which a set is tried first.
const FEW: usize = 2;
/// How many mutants show that what follows could have failed.
const MUTANTS: usize = 12;

/// A set of premises, by their places in the document's list of candidates.
pub type Premises = Vec<usize>;

/// The candidates for a link, by their places in the list, the likeliest first: those that the prose names, then the
/// nearest, and only what hangs together with it.
pub fn nearby(book: &Book, index: usize, all: &[Candidate], named: &BTreeSet<usize>, target: &Spoken) -> Vec<usize> {
    let own = &book.entries[index].equation.span;
    let next = book.entries[index + 1..].iter().map(|e| e.equation.span.start).find(|start| *start >= own.end);
    let usable = |c: &Candidate| match &c.source {
        Origin::Display(k, _) => *k < index,
        Origin::Inline(_) => next.is_none_or(|next| c.span.start < next) && !(own.start..own.end).contains(&c.span.start),
    };
    let is_named = |c: &Candidate| matches!(&c.source, Origin::Display(k, _) if named.contains(k));
    let mut found: Vec<usize> = (0..all.len()).filter(|k| usable(&all[*k])).collect();
    found.sort_by_key(|k| (!is_named(&all[*k]), all[*k].span.start.abs_diff(own.start)));
    // What no chain of shared symbols leads to says nothing.
    let mut reached = target.symbols.clone();
    let mut kept = vec![false; found.len()];
    while let Some(k) = (0..found.len()).find(|k| !kept[*k] && !all[found[*k]].symbols.is_disjoint(&reached)) {
        kept[k] = true;
        reached.extend(all[found[k]].symbols.iter().cloned());
    }
    found.into_iter().zip(kept).filter(|(_, kept)| *kept).map(|(k, _)| k).collect()
}

/// The sets of candidates that may imply a link, in the order in which they are tried.
pub fn sets(nearby: &[usize], all: &[Candidate], target: &Spoken) -> Vec<Premises> {
    let nearest: Vec<usize> = nearby.iter().copied().take(NEAREST).collect();
    let candidates: Vec<&Candidate> = nearest.iter().map(|k| &all[*k]).collect();
    let small = subsets(target, &candidates, JUDGED).into_iter();
    let mut sets: Vec<Premises> = small.map(|set| set.into_iter().map(|k| nearest[k]).collect()).collect();
    for size in LADDER {
        let set: Premises = nearby.iter().copied().take(size).collect();
        let premises: Vec<&Candidate> = set.iter().map(|k| &all[*k]).collect();
        if set.len() > super::subsets::LARGEST && hang_together(target, &premises) && !sets.contains(&set) {
            sets.push(set);
        }
    }
    sets
}

/// The first set that a link follows from, made as small as it can be; `book` is left with these premises.
pub fn search(book: &mut Book, index: usize, link: usize, sets: &[Premises], all: &[Candidate], options: &Options) -> Option<Premises> {
    for set in sets {
        give(book, index, link, set, all);
        if follows(book, index, link, options) && could_fail(book, index, link, options) {
            let set = smallest(book, index, link, set.clone(), all, options);
            give(book, index, link, &set, all);
            return Some(set);
        }
    }
    give(book, index, link, &[], all);
    None
}

/// Leaves out what is not needed, the farthest first.
fn smallest(book: &mut Book, index: usize, link: usize, set: Premises, all: &[Candidate], options: &Options) -> Premises {
    let mut kept = set;
    let mut k = kept.len();
    while k > 0 && kept.len() > 1 {
        k -= 1;
        let mut fewer = kept.clone();
        fewer.remove(k);
        give(book, index, link, &fewer, all);
        if follows(book, index, link, options) {
            kept = fewer;
        }
    }
    kept
}

/// Makes candidates the premises of a link.
pub fn give(book: &mut Book, index: usize, link: usize, set: &[usize], all: &[Candidate]) {
    let annotation = book.entries[index].equation.annotation.get_or_insert_with(EquationAnnotation::default);
    annotation.link.retain(|l| l.number != link + 1);
    if set.is_empty() {
        return;
    }
    let text = |value: &str, at: usize| Spanned::new(value.to_owned(), at..at + value.len());
    let mut premises = LinkPremises { number: link + 1, ..LinkPremises::default() };
    for candidate in set.iter().map(|k| &all[*k]) {
        match &candidate.source {
            Origin::Display(_, label) => premises.given.push(text(label, candidate.span.start)),
            Origin::Inline(latex) => premises.where_.push(text(latex, candidate.span.start)),
        }
    }
    annotation.link.push(premises);
}

/// Whether a link holds on the premises that it has: at few states first.
pub fn follows(book: &Book, index: usize, link: usize, options: &Options) -> bool {
    let holds = |options: &Options| judge_one(book, index, link, options).is_some_and(|l| holds(&l));
    let few = Options { states: FEW.min(options.states), evidence: false, ..options.clone() };
    holds(&few) && holds(&Options { evidence: false, ..options.clone() })
}

fn holds(link: &LinkJudgement) -> bool {
    matches!(link.verdict, Verdict::Holds | Verdict::Asymptotic)
}

/// Whether most mutants of a link fail on its premises: otherwise that it holds there shows nothing.
fn could_fail(book: &Book, index: usize, link: usize, options: &Options) -> bool {
    let entry = &book.entries[index];
    let Ok(tree) = &entry.formula(Version::Printed).tree else { return false };
    let Ok(statement) = book.statement(index, Version::Printed) else { return false };
    let links: Vec<LinkJudgement> = (0..statement.clauses.len())
        .map(|k| LinkJudgement { verdict: Verdict::Holds, ..LinkJudgement::unjudged(statement.clauses[k].latex()) })
        .collect();
    let Some(mut trial) = Trial::new(book, index, Version::Printed, &links, options) else { return false };
    let changes = |tree: &crate::latex::ast::Node| {
        book.statement_of(index, tree).is_ok_and(|s| s.clauses.get(link) != statement.clauses.get(link))
    };
    let mut outcomes = [0, 0];
    let all = mutants(tree, &entry.scope, Reach::MUTANTS);
    let step = all.len().div_ceil(4 * MUTANTS).max(1);
    for mutant in all.iter().step_by(step).filter(|m| changes(&m.tree)).take(MUTANTS) {
        match trial.outcome_at(&mutant.tree, &[link]) {
            Outcome::Holds if !trial.is_equivalent(&mutant.tree) => outcomes[0] += 1,
            Outcome::Fails | Outcome::Misshapen => outcomes[1] += 1,
            _ => {}
        }
    }
    2 * outcomes[0] <= outcomes[1]
}
