//! Misprints that show themselves: an equation that follows from nothing before it, and would with one edit.

use std::collections::BTreeSet;

use crate::check::verdict::{Difference, LinkJudgement, Suspect, Verdict};
use crate::check::{self, Formula, Outcome, Version};
use crate::diagnose::{Edited, slips};
use crate::latex::{diff, to_latex};

use super::desk::{Basis, Desk};
use super::swaps::swaps;

/// How many sets of premises are tried with edits, and how large they are at most.
const BASES: usize = 12;
const LARGEST: usize = 3;
/// The cost up to which an edit is likely enough to be a misprint.
const LIKELY: u32 = 8;
/// How many edits are tried for each set.
const EDITS: usize = 1500;

/// The cost up to which an edit of a premise is likely enough.
const LIKELY_BEFORE: u32 = 5;
/// How many premises a set has at most in which they are edited.
const FEW: usize = 2;
/// How many edits of premises are judged.
const JUDGED: usize = 600;

/// A suspect.
pub struct Found {
    /// The suspect.
    pub suspect: Suspect,
    /// Whether as printed it contradicts the premises that the edited one follows from.
    pub contradicts: bool,
}

/// The likeliest edit of the link on the desk after which it is an identity or follows from few premises. `links` is the
/// judgement on the equation as printed.
pub fn search(desk: &mut Desk, bases: &[Basis], named: &BTreeSet<usize>, links: &[LinkJudgement]) -> Option<Found> {
    let is_small = |b: &&Basis| b.solves.is_some() || (1..=LARGEST).contains(&b.premises.len());
    let few = bases.iter().filter(is_small).take(BASES).cloned();
    let alone = bases.iter().all(|b| b.solves.is_none()).then(Basis::default);
    let mut best: Option<(u32, Basis, Edited)> = None;
    for basis in alone.into_iter().chain(few) {
        desk.lay(&basis);
        let below = best.as_ref().map_or(LIKELY + 1, |(cost, _, _)| *cost);
        let edited = edited(desk, links, below, basis == Basis::default());
        best = edited.map(|edited| (edited.cost, basis, edited)).or(best);
    }
    desk.lay(&Basis::default());
    let (_, basis, edited) = best?;
    // A letter may mean something else elsewhere: a contradiction is certain only where the prose refers to all of them.
    let is_meant = !basis.premises.is_empty() && basis.displays(desk.all, desk.book).iter().all(|k| named.contains(k));
    let contradicts = basis.solves.is_none() && is_meant && contradicts(desk, &basis);
    let entry = &desk.book.entries[desk.index];
    let before = entry.formula(Version::Printed).tree.as_ref().ok().map(to_latex)?;
    let latex = to_latex(&edited.tree);
    let diff = diff::words(&before, &latex).map(|(printed, suggested)| Difference { printed, suggested });
    let (label, premises) = (entry.equation.label.clone(), basis.names(desk.all));
    Some(Found { suspect: Suspect { edit: edited.edit, latex, label, premises, diff }, contradicts })
}

/// The likeliest edit after which the link follows from what is laid beside it, if it is likelier than one known. Where
/// nothing is laid beside it, it is to be an identity, and wider edits are tried.
fn edited(desk: &Desk, links: &[LinkJudgement], below: u32, alone: bool) -> Option<Edited> {
    let tree = desk.book.entries[desk.index].formula(Version::Printed).tree.as_ref().ok()?;
    let clauses = desk.clauses();
    let mut trial = desk.trial(links)?;
    let mut slips: Vec<Edited> = slips(desk.book, desk.index, tree).into_iter().take(EDITS).collect();
    if alone {
        slips.extend(swaps(tree, &desk.book.entries[desk.index].scope));
        slips.sort_by_key(|edited| edited.cost);
    }
    for edited in slips.into_iter().take_while(|edited| edited.cost < below) {
        if trial.deadline().has_passed() {
            break;
        }
        // Links that share a side with this one are edited with it: those that hold are to hold still.
        let changed = desk.changed(&clauses, &edited.tree);
        let holds = |k: &usize| *k != desk.link && links.get(*k).is_some_and(|l| l.verdict <= Verdict::Asymptotic);
        let others: Vec<usize> = changed.iter().copied().filter(holds).collect();
        let follows = changed.contains(&desk.link)
            && desk.outcome(&mut trial, &edited.tree, &[desk.link]) == Outcome::Holds
            && (others.is_empty()
                || matches!(trial.outcome_at(&edited.tree, &others), Outcome::Holds | Outcome::Definition));
        if follows && !trial.says_nothing(&edited.tree) {
            return Some(edited);
        }
    }
    None
}

/// The likeliest edit of an equation that the link on the desk may rest on, after which it follows from it. Where the link
/// itself is one edit away, that is likelier.
pub fn search_premises(desk: &mut Desk, bases: &[Basis]) -> Option<Found> {
    let mut left = JUDGED;
    for basis in bases.iter().filter(|b| b.premises.len() <= FEW).take(BASES) {
        desk.lay(basis);
        for premise in basis.displays(desk.all, desk.book) {
            let entry = &desk.book.entries[premise];
            let Ok(tree) = entry.formula(Version::Printed).tree.clone() else { continue };
            let (label, before) = (entry.equation.label.clone(), to_latex(&tree));
            let likely = slips(desk.book, premise, &tree).into_iter().take_while(|edited| edited.cost <= LIKELY_BEFORE);
            let likely: Vec<Edited> = likely.take(left).collect();
            left -= likely.len();
            for edited in likely {
                let latex = to_latex(&edited.tree);
                desk.book.entries[premise].reading = Some(Formula::made(latex.clone(), edited.tree).into());
                let follows = desk.follows();
                desk.book.entries[premise].reading = None;
                if follows {
                    let premises = basis.names(desk.all);
                    desk.lay(&Basis::default());
                    let diff =
                        diff::words(&before, &latex).map(|(printed, suggested)| Difference { printed, suggested });
                    let suspect = Suspect { edit: edited.edit, latex, label, premises, diff };
                    return Some(Found { suspect, contradicts: false });
                }
            }
        }
    }
    desk.lay(&Basis::default());
    None
}

/// Whether no state satisfies the equation as printed together with premises.
fn contradicts(desk: &mut Desk, basis: &Basis) -> bool {
    desk.lay(basis);
    desk.say_kind(Some("law"));
    let verdict = check::judge(desk.book, desk.index, desk.options).verdict;
    desk.say_kind(None);
    desk.lay(&Basis::default());
    verdict == Verdict::Fails
}
