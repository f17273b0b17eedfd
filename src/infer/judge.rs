//! The judgement on an equation of notes that declare nothing.

use std::collections::BTreeSet;

use crate::check::verdict::{Inferred, Judgement, LinkJudgement, Strength, Verdict};
use crate::check::{self, Book, Options, Version};
use crate::document::{Document, Spanned};
use crate::semantics::Clause;

use super::candidates::{Candidate, Origin, Spoken, candidates};
use super::premises::{self, Premises};
use super::references::named;
use super::roles::{Guess, Role};
use super::suspects;

/// What the equations of a document may follow from.
pub struct Ground {
    /// All formulas that may be premises.
    pub candidates: Vec<Candidate>,
    /// For each equation those that the prose around it names.
    named: Vec<BTreeSet<usize>>,
    /// The guessed roles.
    guesses: Vec<Guess>,
}

impl Ground {
    /// Looks through a document that has been given the guessed declarations.
    pub fn new(book: &Book, document: &Document, guesses: Vec<Guess>) -> Self {
        let named = (0..book.entries.len()).map(|k| named(book, document, k)).collect();
        Ground { candidates: candidates(book, document), named, guesses }
    }

    /// Judges an equation. Where an annotation says what it follows from or what it is, that alone counts. `book` is one's
    /// own: the premises that are found are left in it, at this equation alone.
    pub fn judge(&self, book: &mut Book, index: usize, options: &Options) -> Judgement {
        if book.entries[index].equation.annotation.is_some() {
            return check::judge(book, index, options);
        }
        let own = book.entries[index].equation.clone();
        let judgement = Search { ground: self, book, index, options }.judge();
        book.entries[index].equation = own;
        judgement
    }
}

/// An equation whose premises are searched.
pub(super) struct Search<'s> {
    pub ground: &'s Ground,
    pub book: &'s mut Book,
    pub index: usize,
    pub options: &'s Options,
}

impl Search<'_> {
    fn judge(&mut self) -> Judgement {
        let first = check::judge(self.book, self.index, self.options);
        let clauses = match self.book.statement(self.index, Version::Printed) {
            Ok(statement) => statement.clauses,
            Err(_) => return lacking(first),
        };
        match first.verdict {
            Verdict::Holds => return self.where_signs_are_known(first, true),
            Verdict::Fails => {}
            _ => return lacking(first),
        }
        let open: Vec<usize> = (0..first.links.len()).filter(|k| fails(&first.links[*k])).collect();
        if open.is_empty() {
            return misshapen(first);
        }
        let mut unexplained = Vec::new();
        for link in open {
            let Some(clause) = clauses.get(link) else { continue };
            if self.premises(link, clause).is_none() {
                unexplained.push(link);
            }
        }
        let suspect = unexplained.iter().find_map(|link| suspects::search(self, *link, &clauses[*link], &first.links));
        let is_new = unexplained.iter().all(|k| !clauses[*k].continued);
        if is_new && let Some(annotation) = &mut self.book.entries[self.index].equation.annotation {
            annotation.kind = (!unexplained.is_empty()).then(|| Spanned::new("law".into(), 0..0));
        }
        let mut judgement = check::judge(self.book, self.index, self.options);
        judgement.inferred = Some(self.inferred(&judgement, !unexplained.is_empty()));
        judgement = told(judgement, &unexplained);
        if unexplained.is_empty() && judgement.verdict == Verdict::Holds {
            judgement = self.where_signs_are_known(judgement, false);
        }
        if suspect.is_some() {
            judgement.verdict = Verdict::Undecided;
            judgement.as_expected = false;
            judgement.reason =
                Some("it does not follow from what stands before it, but would with one edit: see the suspect".into());
        }
        judgement.suspect = suspect;
        judgement
    }

    /// What a link follows from.
    fn premises(&mut self, link: usize, clause: &Clause) -> Option<Premises> {
        let sets = self.sets(clause)?;
        premises::search(self.book, self.index, link, &sets, &self.ground.candidates, self.options)
    }

    /// The sets of candidates that may imply a clause.
    pub(super) fn sets(&self, clause: &Clause) -> Option<Vec<Premises>> {
        let scope = self.book.entries[self.index].scope.clone();
        let target = Spoken::of(&scope, std::slice::from_ref(clause))?;
        let all = &self.ground.candidates;
        let nearby = premises::nearby(self.book, self.index, all, &self.ground.named[self.index], &target);
        Some(premises::sets(&nearby, all, &target))
    }

    fn inferred(&self, judgement: &Judgement, new: bool) -> Inferred {
        let annotation = self.book.entries[self.index].annotation();
        let links = annotation.into_iter().flat_map(|a| &a.link);
        let values = |texts: &[Spanned<String>]| texts.iter().map(|t| t.value.clone()).collect::<Vec<String>>();
        let links: Vec<_> = links.map(|l| (l.number, values(&l.given), values(&l.where_))).collect();
        Inferred {
            given: judgement.given.clone(),
            formulas: judgement.assumptions.clone(),
            new,
            needs: Vec::new(),
            links,
        }
    }

    /// What holds for positive values is tried with numbers of either sign, where nothing says that they are positive. An
    /// identity that needs a sign is undecided; what follows from premises says which sign it takes.
    fn where_signs_are_known(&mut self, judgement: Judgement, identity: bool) -> Judgement {
        let numbers: Vec<String> = self.numbers();
        if numbers.is_empty() {
            return judgement;
        }
        let few = Options { states: self.options.states.min(12), evidence: false, ..self.options.clone() };
        let mut fails = |names: &[String], range: [f64; 2]| {
            let ranges = names.iter().map(|n| (Spanned::new(n.clone(), 0..0), range)).collect();
            let annotation = self.book.entries[self.index].equation.annotation.get_or_insert_default();
            annotation.range = ranges;
            let verdict = check::judge(self.book, self.index, &few).verdict;
            if let Some(annotation) = &mut self.book.entries[self.index].equation.annotation {
                annotation.range.clear();
            }
            verdict == Verdict::Fails
        };
        if !fails(&numbers, [-2.0, 2.0]) {
            return judgement;
        }
        let needed: Vec<String> = numbers.iter().filter(|n| fails(std::slice::from_ref(n), [-2.0, -0.3])).cloned().collect();
        let needs: Vec<String> = match needed.is_empty() {
            true => numbers.iter().map(|n| format!("{n} > 0")).collect(),
            false => needed.iter().map(|n| format!("{n} > 0")).collect(),
        };
        let mut judgement = judgement;
        if identity {
            judgement.verdict = Verdict::Undecided;
            judgement.reason = Some(format!("needs ${}$: it holds where this is so, and not elsewhere", needs.join("$, $")));
            judgement.as_expected = true;
        }
        judgement.inferred.get_or_insert_default().needs = needs;
        judgement
    }

    /// The numbers of either sign that the equation mentions.
    fn numbers(&self) -> Vec<String> {
        let mentions = &self.book.entries[self.index].mentions;
        let plain = |g: &&Guess| matches!(g.role, Role::Number | Role::Angle) && g.each.is_empty();
        let guesses = self.ground.guesses.iter().filter(plain);
        guesses.filter(|g| mentions.contains_key(&g.name)).map(|g| g.name.clone()).collect()
    }
}

/// Whether a link fails at states, and not by its shape.
fn fails(link: &LinkJudgement) -> bool {
    link.verdict == Verdict::Fails && link.strength != Some(Strength::Shape)
}

/// What cannot be judged for want of a declaration is no surprise in notes that have none.
fn lacking(mut judgement: Judgement) -> Judgement {
    judgement.as_expected |= judgement.verdict == Verdict::Undecided;
    judgement
}

/// Shapes that do not meet may be those of a wrong guess.
fn misshapen(mut judgement: Judgement) -> Judgement {
    judgement.verdict = Verdict::Undecided;
    judgement.strength = None;
    let reason = judgement.reason.take().unwrap_or_default();
    judgement.reason = Some(format!("with the roles guessed its shapes do not meet: {reason}; declare what its symbols are"));
    for link in judgement.links.iter_mut().filter(|l| l.verdict == Verdict::Fails) {
        link.verdict = Verdict::Undecided;
        link.strength = None;
    }
    judgement.as_expected = true;
    judgement
}

/// In words what is new, and what does not follow.
fn told(mut judgement: Judgement, unexplained: &[usize]) -> Judgement {
    let mut numberless = false;
    for link in unexplained {
        let Some(link) = judgement.links.get_mut(*link) else { continue };
        if link.verdict == Verdict::Definition {
            link.reason = Some("new here: it follows from nothing before it".into());
        } else if link.verdict == Verdict::Fails {
            numberless |= link.counterexample.as_ref().is_some_and(|c| c.state.is_empty());
            if numberless {
                continue;
            }
            link.verdict = Verdict::Undecided;
            link.strength = None;
            link.reason = Some("it does not follow from what stands before it: needs a premise, or has a misprint".into());
            link.counterexample = None;
        }
    }
    judgement.verdict = judgement.links.iter().map(|l| l.verdict).max().unwrap_or(judgement.verdict);
    if !unexplained.is_empty() && !numberless {
        judgement.counterexample = None;
        judgement.strength = None;
        judgement.reason =
            judgement.links.iter().find(|l| l.verdict == judgement.verdict).and_then(|l| l.reason.clone());
    }
    judgement.as_expected = judgement.verdict != Verdict::Fails && judgement.verdict != Verdict::Unreadable;
    judgement
}

/// A premise in words: its label, or its LaTeX.
pub(super) fn premise_name(candidate: &Candidate) -> String {
    match &candidate.source {
        Origin::Display(_, label) => label.clone(),
        Origin::Inline(latex) => format!("${latex}$"),
    }
}
