//! Misprints that show themselves: an equation that follows from nothing before it, and would with one edit.

use crate::check::verdict::{Difference, LinkJudgement, Suspect, Verdict};
use crate::check::{self, Outcome, Version};
use crate::diagnose::{Edited, slips};
use crate::latex::{diff, to_latex};

use super::desk::{Basis, Desk};

/// How many sets of premises are tried with edits, and how large they are at most.
const BASES: usize = 12;
const LARGEST: usize = 3;
/// The cost up to which an edit is likely enough to be a misprint.
const LIKELY: u32 = 8;
/// How many edits are tried for each set.
const EDITS: usize = 1500;

/// A suspect.
pub struct Found {
    /// The suspect.
    pub suspect: Suspect,
    /// Whether as printed it contradicts the premises that the edited one follows from.
    pub contradicts: bool,
}

/// The likeliest edit of the link on the desk after which it is an identity or follows from few premises. `links` is the
/// judgement on the equation as printed.
pub fn search(desk: &mut Desk, bases: &[Basis], links: &[LinkJudgement]) -> Option<Found> {
    let few = bases.iter().filter(|b| (1..=LARGEST).contains(&b.premises.len())).take(BASES).cloned();
    let mut best: Option<(u32, Basis, Edited)> = None;
    for basis in std::iter::once(Basis::default()).chain(few) {
        desk.lay(&basis);
        let edited = edited(desk, links, best.as_ref().map_or(LIKELY + 1, |(cost, _, _)| *cost));
        best = edited.map(|edited| (edited.cost, basis, edited)).or(best);
    }
    desk.lay(&Basis::default());
    let (_, basis, edited) = best?;
    let contradicts = !basis.premises.is_empty() && contradicts(desk, &basis);
    let entry = &desk.book.entries[desk.index];
    let before = entry.formula(Version::Printed).tree.as_ref().ok().map(to_latex)?;
    let latex = to_latex(&edited.tree);
    let diff = diff::words(&before, &latex).map(|(printed, suggested)| Difference { printed, suggested });
    let (label, premises) = (entry.equation.label.clone(), basis.names(desk.all));
    Some(Found { suspect: Suspect { edit: edited.edit, latex, label, premises, diff }, contradicts })
}

/// The likeliest edit after which the link follows from what is laid beside it, if it is likelier than one known.
fn edited(desk: &Desk, links: &[LinkJudgement], below: u32) -> Option<Edited> {
    let tree = desk.book.entries[desk.index].formula(Version::Printed).tree.as_ref().ok()?;
    let clauses = desk.clauses();
    let mut trial = desk.trial(links)?;
    let slips = slips(desk.book, desk.index, tree).into_iter();
    for edited in slips.take(EDITS).take_while(|edited| edited.cost < below) {
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

/// Whether no state satisfies the equation as printed together with premises.
fn contradicts(desk: &mut Desk, basis: &Basis) -> bool {
    desk.lay(basis);
    desk.say_kind(Some("law"));
    let verdict = check::judge(desk.book, desk.index, desk.options).verdict;
    desk.say_kind(None);
    desk.lay(&Basis::default());
    verdict == Verdict::Fails
}
