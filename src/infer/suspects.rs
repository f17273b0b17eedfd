//! Misprints that show themselves: an equation that follows from nothing before it, and would with one edit.

use crate::check::verdict::{Difference, LinkJudgement, Suspect, Verdict};
use crate::check::{Outcome, Trial, Version};
use crate::diagnose::single_edits;
use crate::latex::ast::Node;
use crate::latex::{diff, to_latex};
use crate::semantics::Clause;

use super::judge::{Search, premise_name};
use super::premises::{self, Premises};

/// How many sets of premises are tried with edits.
const SETS: usize = 12;
/// The cost up to which an edit is likely enough to be a misprint.
const LIKELY: u32 = 8;
/// How many edits are tried for each set.
const EDITS: usize = 1500;

/// The likeliest edit of a link after which it is an identity or follows from few premises.
pub(super) fn search(search: &mut Search, link: usize, clause: &Clause, links: &[LinkJudgement]) -> Option<Suspect> {
    let mut sets: Vec<Premises> = vec![Vec::new()];
    sets.extend(search.sets(clause).unwrap_or_default().into_iter().filter(|s| s.len() <= 3).take(SETS));
    let mut best: Option<(u32, usize, Suspect)> = None;
    for (rank, set) in sets.iter().enumerate() {
        let Some((cost, suspect)) = edited(search, link, set, links) else { continue };
        if best.as_ref().is_none_or(|(c, r, _)| (cost, rank) < (*c, *r)) {
            best = Some((cost, rank, suspect));
        }
    }
    premises::give(search.book, search.index, link, &[], &search.ground.candidates);
    best.map(|(_, _, suspect)| suspect)
}

/// The likeliest edit after which a link follows from these premises, with its cost.
fn edited(search: &mut Search, link: usize, set: &[usize], links: &[LinkJudgement]) -> Option<(u32, Suspect)> {
    premises::give(search.book, search.index, link, set, &search.ground.candidates);
    let (book, index) = (&*search.book, search.index);
    let tree = book.entries[index].formula(Version::Printed).tree.as_ref().ok()?;
    let statement = book.statement(index, Version::Printed).ok()?;
    let mut trial = Trial::new(book, index, Version::Printed, links, search.options)?;
    // Links that share a side with this one are edited with it: those that hold are to hold still.
    let changed = |edited: &Node| -> Option<Vec<usize>> {
        let clauses = book.statement_of(index, edited).ok()?.clauses;
        let all = 0..statement.clauses.len();
        let changed: Vec<usize> = all.filter(|k| clauses.get(*k) != statement.clauses.get(*k)).collect();
        let holds = |k: &usize| *k == link || links.get(*k).is_some_and(|l| l.verdict <= Verdict::Asymptotic);
        (clauses.len() == statement.clauses.len() && changed.contains(&link))
            .then(|| changed.into_iter().filter(holds).collect())
    };
    for (edited, edit, cost) in single_edits(book, index, tree).into_iter().take(EDITS) {
        if cost > LIKELY || trial.deadline().has_passed() {
            break;
        }
        let Some(changed) = changed(&edited) else { continue };
        let holds = trial.outcome_at(&edited, &[link]) == Outcome::Holds
            && matches!(trial.outcome_at(&edited, &changed), Outcome::Holds | Outcome::Definition);
        if !holds || trial.says_nothing(&edited) {
            continue;
        }
        let (before, latex) = (to_latex(tree), to_latex(&edited));
        let diff = diff::words(&before, &latex).map(|(printed, suggested)| Difference { printed, suggested });
        let premises = set.iter().map(|k| premise_name(&search.ground.candidates[*k])).collect();
        let label = book.entries[index].equation.label.clone();
        return Some((cost, Suspect { edit, latex, label, premises, diff }));
    }
    None
}
