//! A link of an equation with premises laid beside it, and taken away again.

use std::cell::Cell;
use std::collections::BTreeSet;

use crate::check::exact::Inexact;
use crate::check::verdict::{LinkJudgement, Verdict};
use crate::check::{self, Book, Options, Outcome, Screen, Sight, Trial, Version, judge_one};
use crate::diagnose::is_null;
use crate::diagnose::mutants::{Reach, mutants};
use crate::document::{EquationAnnotation, LinkPremises, Spanned};
use crate::latex::ast::Node;
use crate::semantics::{Clause, Side};

use super::candidates::{Candidate, Origin};

/// The states at which premises are tried first.
const FEW: usize = 2;
/// How many mutants show that what follows could have failed.
const MUTANTS: usize = 12;

/// How many of them must be no solutions.
const SOLUTION_FAILS: usize = 2;

/// What a link is judged on.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Basis {
    /// The premises, by their places in the document's list of candidates.
    pub premises: Vec<usize>,
    /// The label of the equation that it solves, where it is a solution.
    pub solves: Option<String>,
}

impl Basis {
    /// Premises alone.
    pub fn of(premises: &[usize]) -> Self {
        Basis { premises: premises.to_vec(), solves: None }
    }

    /// The displays among them, by their numbers in the book, what is solved first.
    pub fn displays(&self, all: &[Candidate], book: &Book) -> Vec<usize> {
        let solved = self.solves.iter().filter_map(|label| Some(book.find(label)?.0));
        let premises = self.premises.iter().filter_map(|k| match all[*k].source {
            Origin::Display(index, _) => Some(index),
            _ => None,
        });
        solved.chain(premises).collect()
    }

    /// The basis in words: labels, and inline formulas between dollars.
    pub fn names(&self, all: &[Candidate]) -> Vec<String> {
        let name = |k: &usize| match &all[*k].source {
            Origin::Display(_, label) | Origin::Part(_, label, _) => label.clone(),
            Origin::Inline(latex) => format!("${latex}$"),
        };
        self.solves.iter().cloned().chain(self.premises.iter().map(name)).collect()
    }
}

/// A link at which premises are tried. The book is changed at this equation's annotation alone.
pub struct Desk<'d> {
    /// The book, one's own.
    pub book: &'d mut Book,
    /// The equation.
    pub index: usize,
    /// Which of its links, from 0.
    pub link: usize,
    /// The links before it that are taken as given, for they follow from nothing.
    pub taken: Vec<usize>,
    /// All candidates of the document.
    pub all: &'d [Candidate],
    /// How to judge.
    pub options: &'d Options,
    /// Whether on some premises the numbers did not tell whether the link at hand holds: then nobody is accused.
    pub blurred: Cell<bool>,
}

impl Desk<'_> {
    /// The equation's links as printed.
    pub fn clauses(&self) -> Vec<Clause> {
        self.book.statement(self.index, Version::Printed).map_or_else(|_| Vec::new(), |s| s.clauses)
    }

    /// Lays premises beside the link, in the place of others.
    pub fn lay(&mut self, basis: &Basis) {
        let annotation =
            self.book.entries[self.index].equation.annotation.get_or_insert_with(EquationAnnotation::default);
        let text = |value: &str, at: usize| Spanned::new(value.to_owned(), at..at + value.len());
        let mut premises = LinkPremises { number: self.link + 1, ..LinkPremises::default() };
        for candidate in basis.premises.iter().map(|k| &self.all[*k]) {
            match &candidate.source {
                Origin::Display(_, label) => premises.given.push(text(label, candidate.span.start)),
                Origin::Part(_, _, latex) | Origin::Inline(latex) => {
                    premises.where_.push(text(latex, candidate.span.start))
                }
            }
        }
        annotation.link.retain(|l| l.number != self.link + 1);
        annotation.solves = basis.solves.iter().map(|label| text(label, 0)).collect();
        if annotation.solves.is_empty() {
            (annotation.given, annotation.where_) = (Vec::new(), Vec::new());
            if !basis.premises.is_empty() {
                annotation.link.push(premises);
            }
        } else {
            // A solution is put as a whole into what it solves.
            (annotation.given, annotation.where_) = (premises.given, premises.where_);
        }
    }

    /// Says of what kind the equation is.
    pub fn say_kind(&mut self, kind: Option<&str>) {
        let annotation = self.book.entries[self.index].equation.annotation.get_or_insert_default();
        annotation.kind = kind.map(|k| Spanned::new(k.to_owned(), 0..0));
    }

    /// Whether the link follows from what is laid beside it: at few states first, then at all, and so that it could have
    /// failed.
    pub fn follows(&self) -> bool {
        let few = Options { states: FEW.min(self.options.states), evidence: false, ..self.options.clone() };
        self.holds(&few)
            && !self.vanishes()
            && self.holds(&Options { evidence: false, ..self.options.clone() })
            && !self.is_trivial(&few)
            && self.could_fail()
    }

    /// Whether both sides are 0 on the premises though none is printed as 0: premises that do not belong together often
    /// leave nothing else.
    fn vanishes(&self) -> bool {
        let clauses = self.clauses();
        let Some(clause) = clauses.get(self.link).filter(|_| !self.is_solution()) else { return false };
        let Side::Node(rhs) = &clause.rhs else { return false };
        if is_null(&clause.lhs) || is_null(rhs) {
            return false;
        }
        let known: Vec<Clause> = self.taken.iter().filter_map(|k| clauses.get(*k)).cloned().collect();
        let own = std::slice::from_ref(clause);
        let screen = Screen::new(self.book, self.index, Version::Printed, own, &known, self.options);
        let Some(mut screen) = screen else { return false };
        match (screen.side(&clause.lhs, &clause.rhs, true), screen.size(&clause.lhs, &clause.rhs, false)) {
            (Sight::Values(values), Some(size)) => values.iter().all(|v| v.abs() <= 1e-9 * size.max(1e-300)),
            _ => false,
        }
    }

    /// Whether every term is 0 by itself on the premises, even where their solutions, near a double root, are not sharp
    /// enough to show it: what contradicts itself but for a gas of no temperature is no premise.
    fn is_trivial(&self, few: &Options) -> bool {
        let clauses = self.clauses();
        let Some(clause) = clauses.get(self.link).filter(|_| !self.is_solution()) else { return false };
        if is_null(&clause.lhs) || matches!(&clause.rhs, Side::Node(rhs) if is_null(rhs)) {
            return false;
        }
        let options = Options { evidence: true, ..few.clone() };
        let judged = judge_one(self.book, self.index, self.link, &self.taken, &options);
        judged.and_then(|link| link.inexact).is_some_and(|why| why == Inexact::Trivial.to_string())
    }

    fn is_solution(&self) -> bool {
        self.book.entries[self.index].annotation().is_some_and(|a| !a.solves.is_empty())
    }

    fn holds(&self, options: &Options) -> bool {
        let verdict = match self.is_solution() {
            true => Some(check::judge(self.book, self.index, options).verdict),
            false => judge_one(self.book, self.index, self.link, &self.taken, options).map(|l| {
                if l.verdict == Verdict::Undecided && l.states > 0 {
                    self.blurred.set(true);
                }
                l.verdict
            }),
        };
        matches!(verdict, Some(Verdict::Holds | Verdict::Asymptotic))
    }

    /// Ready to try other formulas in the place of this one; links that are taken as given count as such.
    pub fn trial(&self, links: &[LinkJudgement]) -> Option<Trial<'_>> {
        let mut links = links.to_vec();
        for k in &self.taken {
            links[*k].verdict = Verdict::Definition;
        }
        Trial::new(self.book, self.index, Version::Printed, &links, self.options)
    }

    /// What becomes of the link, and of others, in another formula.
    pub fn outcome(&self, trial: &mut Trial, tree: &Node, links: &[usize]) -> Outcome {
        if self.is_solution() { trial.judge(tree) } else { trial.outcome_at(tree, links) }
    }

    /// The links that another formula changes; none where it has not as many.
    pub fn changed(&self, clauses: &[Clause], tree: &Node) -> BTreeSet<usize> {
        match self.book.statement_of(self.index, tree) {
            Ok(other) if other.clauses.len() == clauses.len() => {
                (0..clauses.len()).filter(|k| other.clauses[*k] != clauses[*k]).collect()
            }
            _ => BTreeSet::new(),
        }
    }

    /// Whether most mutants of the link fail on the same basis: otherwise that it holds shows nothing. Beside 0 a factor or
    /// a sign changes nothing, and so shows nothing either.
    fn could_fail(&self) -> bool {
        let clauses = self.clauses();
        let Some(clause) = clauses.get(self.link) else { return false };
        if is_null(&clause.lhs) || matches!(&clause.rhs, Side::Node(n) if is_null(n)) {
            return true;
        }
        let entry = &self.book.entries[self.index];
        let Ok(tree) = &entry.formula(Version::Printed).tree else { return false };
        let held = |c: &Clause| LinkJudgement { verdict: Verdict::Holds, ..LinkJudgement::unjudged(c.latex()) };
        let links: Vec<LinkJudgement> = clauses.iter().map(held).collect();
        let Some(mut trial) = self.trial(&links) else { return false };
        let (mut pass, mut fail) = (0, 0);
        let all = mutants(tree, &entry.scope, Reach::MUTANTS);
        let step = all.len().div_ceil(4 * MUTANTS).max(1);
        let changing = all.iter().step_by(step).filter(|m| self.changed(&clauses, &m.tree).contains(&self.link));
        for mutant in changing.take(MUTANTS) {
            match self.outcome(&mut trial, &mutant.tree, &[self.link]) {
                Outcome::Holds if !trial.is_equivalent(&mutant.tree) => pass += 1,
                Outcome::Fails | Outcome::Misshapen => fail += 1,
                _ => {}
            }
        }
        // A solution has constants of its own, which may be anything.
        if self.is_solution() { fail >= SOLUTION_FAILS } else { 2 * pass <= fail }
    }

    /// Whether the link holds on premises, be it that others in its place would, too.
    pub fn stands(&mut self, basis: &Basis) -> bool {
        self.lay(basis);
        self.holds(&Options { evidence: false, ..self.options.clone() }) && !self.vanishes()
    }

    /// The first basis from which the link follows, made as small as it can be and left on the desk.
    pub fn search(&mut self, bases: &[Basis]) -> Option<Basis> {
        self.blurred.set(false);
        for basis in bases {
            self.lay(basis);
            if self.follows() {
                let basis = self.smallest(basis.clone());
                self.lay(&basis);
                return Some(basis);
            }
        }
        self.lay(&Basis::default());
        None
    }

    /// Leaves out the premises that are not needed, the farthest first.
    fn smallest(&mut self, basis: Basis) -> Basis {
        let mut kept = basis;
        for k in (0..kept.premises.len()).rev() {
            let mut fewer = kept.clone();
            fewer.premises.remove(k);
            self.lay(&fewer);
            if self.follows() {
                kept = fewer;
            }
        }
        kept
    }
}
