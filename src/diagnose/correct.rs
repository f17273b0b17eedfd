//! What was probably meant: the formulas near a failing one that hold under the same check.
//!
//! The search knows the printed formula, the premises, and the formulas nearby ([`near`](super::near)); the annotated
//! correction it does not see, nor may any premise rest on it. Each row of sides that should be equal is searched by
//! values ([`sides`](super::sides)): single edits and what fills a single hole first, and only where none of these mends
//! the row, two edits of one side and one edit of each of several. Approximations, inequalities and solutions, which
//! have no such values, are searched by trying ([`tries`](super::tries)). What is found is confirmed by the whole check.
//!
//! Ranked by [`likeness`]: cheap is what a scan loses. A suggestion that holds whatever is made of the edited term says
//! nothing and comes last; of several that say the same the cheapest is kept. All budgets count formulas and not time,
//! so that the same notes give the same suggestions.

use crate::check::verdict::{Difference, Judgement, LinkJudgement, Suggestion, Verdict};
use crate::check::{Book, Options, Outcome, Screen, Trial, Version};
use crate::latex::ast::{Kind, Node};
use crate::latex::diff;
use crate::latex::{self, to_latex};
use crate::semantics::{Clause, Scope, Side};

use super::change::{Change, at};
use super::lexicon::Lexicon;
use super::likeness;
use super::mutants::{LONGEST, replaced_at};
use super::near::Near;
use super::shape::{is_null, times};
use super::sides::Row;
use super::singles::Singles;
use super::tries;

/// How many suggestions are made.
pub const MOST: usize = 3;
/// How many guesses are put to the whole check, for a row of sides.
const CONFIRMED: usize = 48;
/// How many guesses that hold are kept, for a row of sides.
const HOLDING: usize = 12;
/// How many formulas are tried whose sides the solved states do not cover.
const ELSEWHERE: usize = 120;

/// The formulas near a failing one that hold, the likeliest first; none where the equation does not fail.
pub fn suggestions(book: &Book, index: usize, judgement: &Judgement, options: &Options) -> Vec<Suggestion> {
    if judgement.verdict != Verdict::Fails {
        return Vec::new();
    }
    let mut blind = book.clone();
    blind.entries[index].correction = None;
    match &blind.entries[index].formula(Version::Printed).tree {
        Ok(tree) => meant(&blind, index, tree, &judgement.links, options),
        Err(_) => Vec::new(),
    }
}

/// The formulas near one that stands in the place of an equation and fails, the likeliest first. `links` is the
/// judgement on it.
pub fn meant(book: &Book, index: usize, tree: &Node, links: &[LinkJudgement], options: &Options) -> Vec<Suggestion> {
    let latex = to_latex(tree);
    if latex.len() > LONGEST {
        return Vec::new();
    }
    let mut printed = book.clone();
    printed.entries[index].reading = Some(crate::check::Formula::made(latex, tree.clone()).into());
    printed.entries[index].correction = None;
    let Some(trial) = Trial::new(&printed, index, Version::Printed, links, options) else { return Vec::new() };
    let near = Near::new(&printed, index, tree);
    let mut search = Search { book: &printed, index, tree, links, options, trial, near };
    let found = search.run();
    let before = to_latex(tree);
    let suggestion = |(change, tree): (Change, Node)| {
        let latex = to_latex(&tree);
        let diff = diff::words(&before, &latex).map(|(printed, suggested)| Difference { printed, suggested });
        Suggestion { latex, edit: change.edits.join("; "), printed: before.clone(), diff }
    };
    found.into_iter().take(MOST).map(suggestion).collect()
}

struct Search<'b> {
    book: &'b Book,
    index: usize,
    tree: &'b Node,
    links: &'b [LinkJudgement],
    options: &'b Options,
    trial: Trial<'b>,
    near: Near,
}

impl<'b> Search<'b> {
    fn scope(&self) -> &'b Scope {
        &self.book.entries[self.index].scope
    }

    fn edits(&self) -> Singles<'_> {
        Singles { scope: self.scope(), tree: self.tree, near: &self.near }
    }

    fn run(&mut self) -> Vec<(Change, Node)> {
        let Ok(statement) = self.book.statement_of(self.index, self.tree) else { return Vec::new() };
        let singles = self.edits().all();
        let mut joined = vec![Change::default()];
        for row in rows(&statement.clauses, self.links) {
            if !row.iter().any(|k| self.fails(*k)) {
                continue;
            }
            let Some(found) = self.row(&statement.clauses, &row, &singles) else {
                let singles = self.edits().tried();
                joined = tries::search(&mut self.trial, self.tree, &singles, self.links);
                break;
            };
            // What mends another row may mend this one, too.
            if found.is_empty() {
                continue;
            }
            joined = joined.iter().flat_map(|a| found.iter().filter_map(|b| a.and(b))).collect();
            joined.sort_by_key(|c| c.cost);
            joined.truncate(4 * HOLDING);
        }
        joined.retain(|c| !c.is_none());
        self.ranked(joined)
    }

    fn fails(&self, link: usize) -> bool {
        self.links.get(link).is_none_or(|l| l.verdict > Verdict::Asymptotic)
    }

    /// What mends a row of sides, the likeliest first; `None` where it cannot be searched by values.
    fn row(&mut self, clauses: &[Clause], numbers: &[usize], singles: &[Change]) -> Option<Vec<Change>> {
        let known: Vec<Clause> = (0..numbers[0])
            .filter(|k| self.links.get(*k).is_some_and(|l| l.verdict == Verdict::Definition))
            .map(|k| clauses[k].clone())
            .collect();
        let own: Vec<Clause> = numbers.iter().map(|k| clauses[*k].clone()).collect();
        let mut screen = Screen::new(self.book, self.index, Version::Printed, &own, &known, self.options)?;
        let lexicon = Lexicon::new(&mut screen, self.scope(), &self.near, self.tree);
        let mut row = Row::new(&mut screen, &own, self.tree)?;
        row.enter(singles);
        row.enter_on_sense(singles);
        row.fill(&lexicon);
        let mut found = self.confirmed(row.matches(), numbers);
        let elsewhere: Vec<Change> = std::mem::take(&mut row.elsewhere).into_iter().take(ELSEWHERE).collect();
        found.extend(self.confirmed(elsewhere, numbers));
        if found.iter().all(|c| self.is_idle(c)) {
            row.pair();
            row.fill_edited(&lexicon);
            found.extend(self.confirmed(row.matches(), numbers));
        }
        Some(found)
    }

    /// Those that hold by the whole check, in the order in which they come.
    fn confirmed(&mut self, guesses: Vec<Change>, links: &[usize]) -> Vec<Change> {
        let mut found = Vec::new();
        for change in guesses.into_iter().take(CONFIRMED) {
            if found.len() >= HOLDING || self.trial.deadline().has_passed() {
                break;
            }
            match self.trial.outcome_at(&change.made(self.tree), links) {
                Outcome::Holds => found.push(change),
                // What then only introduces a symbol can contradict nothing: it may have been meant, with little reason.
                Outcome::Definition => found.push(Change { cost: change.cost + likeness::DEFINES, ..change }),
                _ => {}
            }
        }
        found
    }

    /// The formulas that hold as a whole; idle ones last, and of those that say the same the first.
    fn ranked(&mut self, mut changes: Vec<Change>) -> Vec<(Change, Node)> {
        changes.sort_by_key(|c| (c.cost, to_latex(&c.made(self.tree)).len()));
        let mut found: Vec<(Change, Node)> = Vec::new();
        let mut idle: Vec<(Change, Node)> = Vec::new();
        for change in changes {
            if found.len() >= MOST || self.trial.deadline().has_passed() {
                break;
            }
            let made = change.made(self.tree);
            // A definition beside what is mended may change with it.
            if !matches!(self.trial.judge(&made), Outcome::Holds | Outcome::Definition) {
                continue;
            }
            // What is suggested is what is read from its LaTeX.
            let tree = match latex::parse(&to_latex(&made)) {
                Ok(tree) if matches!(self.trial.judge(&tree), Outcome::Holds | Outcome::Definition) => tree,
                _ => continue,
            };
            if found.iter().chain(&idle).any(|(_, t)| self.trial.say_the_same(t, &tree)) {
                continue;
            }
            if self.trial.says_nothing(&made) {
                continue;
            }
            let group = if self.is_idle(&change) { &mut idle } else { &mut found };
            group.push((change, tree));
        }
        found.extend(idle);
        found
    }

    /// Whether the formula holds as well with an edited term made seven times as large: then the term vanishes on the
    /// premises, and the edit could have been any other. Where a side is 0 as it stands, nothing is said.
    fn is_idle(&mut self, change: &Change) -> bool {
        let made = change.made(self.tree);
        change.places.iter().any(|(path, _)| {
            let is_sum =
                |k: &usize| at(&made, &path[..*k]).is_some_and(|n| matches!(n.kind, Kind::Sum(_) | Kind::Chain { .. }));
            let Some(length) = (0..path.len()).rev().find(is_sum) else { return false };
            let term = &path[..=length];
            let Some(node) = at(&made, term) else { return false };
            let beside_null = at(&made, &path[..length]).is_some_and(|parent| {
                matches!(parent.kind, Kind::Chain { .. }) && parent.children().into_iter().any(is_null)
            });
            if beside_null {
                return false;
            }
            let seven = Node::new(Kind::Number("7".into()), node.span.clone());
            let scaled = replaced_at(&made, term, &times(&seven, node));
            self.trial.judge(&scaled) == Outcome::Holds
        })
    }
}

/// The links of each row of sides that are linked by equality, definitions aside.
fn rows(clauses: &[Clause], links: &[LinkJudgement]) -> Vec<Vec<usize>> {
    let mut rows: Vec<Vec<usize>> = Vec::new();
    for (k, clause) in clauses.iter().enumerate() {
        if links.get(k).is_some_and(|l| l.verdict == Verdict::Definition) {
            continue;
        }
        let linked = |last: &usize| *last + 1 == k && clauses[*last].rhs == Side::Node(clause.lhs.clone());
        match rows.last_mut() {
            Some(row) if row.last().is_some_and(linked) => row.push(k),
            _ => rows.push(vec![k]),
        }
    }
    rows
}
