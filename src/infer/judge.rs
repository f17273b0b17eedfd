//! The judgement on an equation of notes that declare nothing.

use std::cell::Cell;
use std::collections::BTreeSet;
use std::sync::Arc;

use crate::check::verdict::{Inferred, InferredLink, Judgement, LinkJudgement, Strength, Verdict};
use crate::check::{self, Book, Options, Version};
use crate::document::{Document, Spanned, SymbolDeclaration};
use crate::latex::ast::Node;
use crate::semantics::{Clause, Side, spelling};

use super::candidates::{Candidate, Origin, Spoken, candidates};
use super::desk::{Basis, Desk};
use super::evidence::Evidence;
use super::premises;
use super::references::named;
use super::roles::{Guess, Role};
use super::suspects::{self, Found};

/// How many premises are tried, one by one, for what says nothing as it is printed.
const NEAREST: usize = 8;

/// What the equations of a document may follow from.
pub struct Ground {
    /// All formulas that may be premises.
    pub candidates: Vec<Candidate>,
    /// For each equation those that the prose around it names.
    pub(super) named: Vec<BTreeSet<usize>>,
    /// The guessed roles.
    pub(super) guesses: Vec<Guess>,
}

impl Ground {
    /// Looks through a document that has been given the guessed declarations.
    pub fn new(book: &Book, document: &Document, guesses: Vec<Guess>) -> Self {
        let named = (0..book.entries.len()).map(|k| named(book, document, k)).collect();
        Ground { candidates: candidates(book, document), named, guesses }
    }

    /// Judges an equation. Where an annotation says what it follows from or what it is, that alone counts. `book` is one's
    /// own: it is changed at this equation, and changed back.
    pub fn judge(&self, book: &mut Book, index: usize, options: &Options) -> Judgement {
        if book.entries[index].equation.annotation.is_some() {
            return check::judge(book, index, options);
        }
        let own = book.entries[index].clone();
        let judgement = self.inferred(book, index, options);
        book.entries[index] = own;
        judgement
    }

    /// As [`Ground::judge`], but what was found to follow from what is left in the book, for whoever looks closer.
    pub fn explained(&self, book: &mut Book, index: usize, options: &Options) -> Judgement {
        match book.entries[index].equation.annotation {
            Some(_) => check::judge(book, index, options),
            None => self.inferred(book, index, options),
        }
    }

    fn inferred(&self, book: &mut Book, index: usize, options: &Options) -> Judgement {
        let first = check::judge(book, index, options);
        let clauses = book.statement(index, Version::Printed).map_or_else(|_| Vec::new(), |s| s.clauses);
        let is_open = |k: &usize| {
            let (link, clause) = (&first.links[*k], clauses.get(*k));
            let spoken =
                || link.verdict == Verdict::Definition && clause.is_some_and(|c| self.is_spoken_of(book, index, c));
            fails(link) || clause.is_some_and(check::says_nothing) || spoken()
        };
        let failing: Vec<usize> = (0..first.links.len()).filter(is_open).collect();
        match first.verdict {
            Verdict::Holds if failing.is_empty() => return self.with_signs(book, index, first, true, options),
            Verdict::Fails if failing.is_empty() => return self.misshapen(book, index, first, options),
            Verdict::Undecided if failing.is_empty() => {
                let near = self.near(book, index, &first, options);
                return near.unwrap_or_else(|| lacking(first));
            }
            Verdict::Holds | Verdict::Definition | Verdict::Fails | Verdict::Undecided if !failing.is_empty() => {}
            _ => return lacking(first),
        }
        let own = book.entries[index].clone();
        let judgement = self.on_premises(book, index, &first, &failing, options);
        let unsettled = judgement.suspect.is_none() && judgement.inferred.as_ref().is_some_and(|i| i.new);
        let resting = if unsettled { self.resting(book, index) } else { Vec::new() };
        if resting.is_empty() {
            return judgement;
        }
        // What moves only because it equals something that does elsewhere may be at rest here.
        let found = book.entries[index].clone();
        book.entries[index] = own;
        let scope = book.entries[index].scope.with_local(&resting, &mut Vec::new());
        book.entries[index].scope = Arc::new(scope);
        let mut again = self.on_premises(book, index, &first, &failing, options);
        if again.verdict != Verdict::Holds && again.suspect.is_none() {
            book.entries[index] = found;
            return judgement;
        }
        let names = resting.iter().flat_map(|d| &d.names).map(|name| format!("\\dot{{{}}} = 0", name.value));
        again.inferred.get_or_insert_default().needs.extend(names);
        again
    }

    /// The judgement on the open links of an equation on what stands before it.
    fn on_premises(
        &self,
        book: &mut Book,
        index: usize,
        first: &Judgement,
        failing: &[usize],
        options: &Options,
    ) -> Judgement {
        let mut desk =
            Desk { book, index, link: 0, taken: Vec::new(), all: &self.candidates, options, blurred: Cell::new(false) };
        let clauses = desk.clauses();
        let (mut open, mut clear) = (Vec::new(), Vec::new());
        for link in failing {
            desk.link = *link;
            if desk.search(&self.bases(&desk, &clauses)).is_none() {
                if !desk.blurred.get() {
                    clear.push(*link);
                }
                if !is_chained(&clauses, *link) {
                    desk.taken.push(*link);
                }
                open.push(*link);
            }
        }
        let solution = self.solution(&mut desk, &clauses, &open);
        let found = match solution {
            true => None,
            false => clear.iter().find_map(|link| {
                let found = self.suspect(&mut desk, *link, &clauses, &first.links)?;
                // What is new but for the prose may differ from a single formula there, with other letters.
                let few = first.links[*link].verdict == Verdict::Definition && found.suspect.premises.len() < 2;
                (!few).then_some(found)
            }),
        };
        let open = if solution { Vec::new() } else { open };
        let judgement = conclude(&mut desk, &clauses, &open);
        match found {
            Some(found) => suspected(judgement, found),
            None if judgement.verdict == Verdict::Holds => self.with_signs(book, index, judgement, false, options),
            None => judgement,
        }
    }

    /// Whether a formula in the prose speaks of what a clause is taken to introduce.
    fn is_spoken_of(&self, book: &Book, index: usize, clause: &Clause) -> bool {
        let own = &book.entries[index].equation.span;
        let next = book.entries.iter().skip(index + 1).map(|e| e.equation.span.start).find(|start| *start >= own.end);
        let usable = |c: &&Candidate| {
            matches!(c.source, Origin::Inline(_))
                && next.is_none_or(|next| c.span.start < next)
                && !own.contains(&c.span.start)
        };
        let is_new =
            |name: &str| book.entries[index].mentions.contains_key(name) && !book.mentioned_before(index, name);
        let names = [Some(&clause.lhs), right(clause)].into_iter().flatten().map(spelling);
        let names: Vec<String> = names.filter(|name| !name.is_empty() && is_new(name)).collect();
        self.candidates.iter().filter(usable).any(|c| names.iter().any(|name| c.symbols.contains(name)))
    }

    /// Declarations of what is at rest, of names in an equation with rates that move only because of what they are said
    /// to equal elsewhere.
    fn resting(&self, book: &Book, index: usize) -> Vec<SymbolDeclaration> {
        let entry = &book.entries[index];
        let Ok(tree) = &entry.formula(Version::Printed).tree else { return Vec::new() };
        let mut evidence = Evidence::default();
        evidence.look(tree);
        if evidence.rates.is_empty() {
            return Vec::new();
        }
        let is_side = |name: &String| evidence.equals.iter().any(|(side, _)| side == name);
        let lent = self.guesses.iter().filter(|g| g.lent && entry.mentions.contains_key(&g.name) && !is_side(&g.name));
        lent.map(|g| Guess { moves: false, ..g.clone() }.declaration()).collect()
    }

    /// Shapes that do not meet: those of a wrong guess, or of an identity that has lost something.
    fn misshapen(&self, book: &mut Book, index: usize, first: Judgement, options: &Options) -> Judgement {
        let mut desk =
            Desk { book, index, link: 0, taken: Vec::new(), all: &self.candidates, options, blurred: Cell::new(false) };
        let shapes = (0..first.links.len()).filter(|k| first.links[*k].strength == Some(Strength::Shape));
        let found = shapes.collect::<Vec<_>>().into_iter().find_map(|link| {
            desk.link = link;
            suspects::search(&mut desk, &[], &BTreeSet::new(), &first.links)
        });
        let judgement = misshapen(first);
        match found {
            Some(found) => suspected(judgement, found),
            None => judgement,
        }
    }

    /// The likeliest misprint that keeps a link from following: in the link itself, or else in what it may rest on.
    fn suspect(&self, desk: &mut Desk, link: usize, clauses: &[Clause], links: &[LinkJudgement]) -> Option<Found> {
        desk.link = link;
        let (bases, solutions) = (self.bases(desk, clauses), self.solutions(desk, clauses));
        let named = &self.named[desk.index];
        suspects::search(desk, &bases, named, links)
            .or_else(|| suspects::search(desk, &solutions, named, links))
            .or_else(|| suspects::search_premises(desk, &solutions))
            .or_else(|| suspects::search_premises(desk, &bases))
    }

    /// What the link at hand may follow from.
    pub(super) fn bases(&self, desk: &Desk, clauses: &[Clause]) -> Vec<Basis> {
        let Some((nearby, target)) = self.nearby(desk, clauses) else { return Vec::new() };
        if clauses.get(desk.link).is_some_and(check::says_nothing) {
            return nearby.iter().take(NEAREST).map(|k| Basis::of(&[*k])).collect();
        }
        let alone = (!desk.taken.is_empty()).then(Basis::default);
        alone.into_iter().chain(premises::bases(&nearby, &self.candidates, &target)).collect()
    }

    /// The candidates for the link at hand, and what it speaks of together with the links that are taken as given.
    fn nearby(&self, desk: &Desk, clauses: &[Clause]) -> Option<(Vec<usize>, Spoken)> {
        let spoken = desk.taken.iter().chain([&desk.link]).filter_map(|k| clauses.get(*k)).cloned();
        let target = Spoken::of(&desk.book.entries[desk.index].scope, &spoken.collect::<Vec<_>>())?;
        let named = &self.named[desk.index];
        Some((premises::nearby(desk.book, desk.index, &self.candidates, named, &target), target))
    }

    /// Whether the equation solves one before it.
    fn solution(&self, desk: &mut Desk, clauses: &[Clause], open: &[usize]) -> bool {
        // Put into what it solves, an equation is not judged by itself: what else it says must follow.
        let &[link] = open else { return false };
        desk.link = link;
        desk.search(&self.solutions(desk, clauses)).is_some()
    }

    /// What the link at hand may solve.
    fn solutions(&self, desk: &Desk, clauses: &[Clause]) -> Vec<Basis> {
        let (Some(clause), Some((nearby, target))) = (clauses.get(desk.link), self.nearby(desk, clauses)) else {
            return Vec::new();
        };
        if is_chained(clauses, desk.link) {
            return Vec::new();
        }
        premises::solutions(&nearby, &self.candidates, &spelling(&clause.lhs), &target)
    }

    /// What holds for positive values is tried with numbers of either sign, where nothing says that they are positive. An
    /// identity that needs a sign is undecided; of what follows from premises it is told.
    fn with_signs(
        &self,
        book: &mut Book,
        index: usize,
        mut judgement: Judgement,
        identity: bool,
        options: &Options,
    ) -> Judgement {
        let numbers = self.numbers(book, index);
        let few = Options { states: options.states.min(12), evidence: false, ..options.clone() };
        let mut fails = |names: &[String], range: [f64; 2]| {
            let ranges = names.iter().map(|n| (Spanned::new(n.clone(), 0..0), range)).collect();
            book.entries[index].equation.annotation.get_or_insert_default().range = ranges;
            check::judge(book, index, &few).verdict == Verdict::Fails
        };
        if numbers.is_empty() || !fails(&numbers, [-2.0, 2.0]) {
            return judgement;
        }
        let alone: Vec<&String> = numbers.iter().filter(|n| fails(std::slice::from_ref(n), [-2.0, -0.3])).collect();
        let needed = if alone.is_empty() { numbers.iter().collect() } else { alone };
        let needs: Vec<String> = needed.iter().map(|n| format!("{n} > 0")).collect();
        if identity {
            let reason = format!("needs ${}$: it holds where this is so, and not elsewhere", needs.join("$, $"));
            judgement.verdict = Verdict::Undecided;
            judgement.reason = Some(reason);
            judgement.as_expected = true;
        }
        judgement.inferred.get_or_insert_default().needs = needs;
        judgement
    }

    /// The numbers of either sign that an equation mentions.
    fn numbers(&self, book: &Book, index: usize) -> Vec<String> {
        let mentions = &book.entries[index].mentions;
        let plain = |g: &&Guess| matches!(g.role, Role::Number | Role::Angle) && g.each.is_empty();
        let guesses = self.guesses.iter().filter(plain);
        guesses.filter(|g| mentions.contains_key(&g.name)).map(|g| g.name.clone()).collect()
    }
}

/// Whether a link goes on where the one before it ends, as b = c in a = b = c.
fn is_chained(clauses: &[Clause], link: usize) -> bool {
    let before = link.checked_sub(1).and_then(|k| clauses.get(k));
    before.is_some_and(|before| before.rhs == Side::Node(clauses[link].lhs.clone())) || clauses[link].continued
}

fn right(clause: &Clause) -> Option<&Node> {
    match &clause.rhs {
        Side::Node(rhs) => Some(rhs),
        Side::Constant => None,
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
    let reason = judgement.reason.take().unwrap_or_default();
    judgement.reason =
        Some(format!("with the roles that are guessed its shapes do not meet: {reason}; declare what its symbols are"));
    for link in judgement.links.iter_mut().filter(|l| l.verdict == Verdict::Fails) {
        (link.verdict, link.strength) = (Verdict::Undecided, None);
    }
    (judgement.verdict, judgement.strength) = (Verdict::Undecided, None);
    judgement.as_expected = true;
    judgement
}

/// The judgement with the premises that were found. What follows from nothing is new; but a link that continues another
/// one was to follow.
pub(super) fn conclude(desk: &mut Desk, clauses: &[Clause], open: &[usize]) -> Judgement {
    let new = !open.is_empty() && open.iter().all(|k| !is_chained(clauses, *k));
    desk.say_kind(new.then_some("law"));
    let mut judgement = check::judge(desk.book, desk.index, desk.options);
    let annotation = desk.book.entries[desk.index].equation.annotation.get_or_insert_default();
    let values = |texts: &[Spanned<String>]| texts.iter().map(|t| t.value.clone()).collect::<Vec<String>>();
    let solves = values(&annotation.solves);
    let whole = (0, values(&annotation.given), values(&annotation.where_));
    let links = annotation.link.iter().map(|l| (l.number, values(&l.given), values(&l.where_)));
    let links = std::iter::once(whole).filter(|_| !solves.is_empty()).chain(links);
    let links = links.map(|(number, given, formulas)| InferredLink { number, given, formulas }).collect();
    let once = |mut names: Vec<String>| {
        let mut seen = BTreeSet::new();
        names.retain(|n| seen.insert(n.clone()));
        names
    };
    judgement.given = once(judgement.given);
    judgement.assumptions = once(judgement.assumptions);
    let (given, formulas) = (judgement.given.clone(), judgement.assumptions.clone());
    judgement.inferred = Some(Inferred { given, formulas, solves, new: !open.is_empty(), needs: Vec::new(), links });
    for k in open {
        let Some(link) = judgement.links.get_mut(*k) else { continue };
        if link.verdict == Verdict::Definition {
            link.reason = Some("new here: it follows from nothing before it".into());
        } else if link.verdict == Verdict::Fails && !without_symbols(link) {
            (link.verdict, link.strength, link.counterexample) = (Verdict::Undecided, None, None);
            link.reason =
                Some("it does not follow from what stands before it: needs a premise, or has a misprint".into());
        }
    }
    if !open.is_empty() {
        // That the rest of it follows does not show that what is new is right.
        let worst = judgement.links.iter().map(|l| l.verdict).max().unwrap_or(judgement.verdict);
        judgement.verdict = if worst == Verdict::Holds { Verdict::Definition } else { worst };
        judgement.reason =
            judgement.links.iter().find(|l| l.verdict == judgement.verdict).and_then(|l| l.reason.clone());
        judgement.counterexample = judgement.links.iter().find_map(|l| l.counterexample.clone());
        judgement.strength = judgement.strength.filter(|_| judgement.verdict == Verdict::Fails);
    }
    let nothing = clauses.iter().any(check::says_nothing);
    judgement.as_expected = !matches!(judgement.verdict, Verdict::Fails | Verdict::Unreadable) && !nothing;
    judgement
}

/// Whether a link speaks of numbers alone, so that no premise could make it true.
fn without_symbols(link: &LinkJudgement) -> bool {
    link.counterexample.as_ref().is_some_and(|c| c.state.is_empty())
}

/// The judgement on an equation that one edit would make follow.
pub(super) fn suspected(mut judgement: Judgement, Found { suspect, contradicts }: Found) -> Judgement {
    let premises = list(&suspect.premises);
    let follows = if premises.is_empty() { "be an identity".into() } else { format!("follow from {premises}") };
    let (verdict, reason) = match contradicts {
        true => (Verdict::Fails, format!("it contradicts {premises}: no state satisfies all")),
        false => (Verdict::Undecided, "it does not follow from what stands before it".to_owned()),
    };
    judgement.verdict = verdict;
    judgement.as_expected = false;
    let of = if suspect.label == judgement.label { String::new() } else { format!(" of ({})", suspect.label) };
    judgement.reason = Some(format!("{reason}; with one edit{of} it would {follows}: {}", suspect.edit));
    judgement.suspect = Some(suspect);
    judgement
}

/// Premises in a sentence: labels in brackets.
fn list(premises: &[String]) -> String {
    let name = |p: &String| if p.starts_with('$') { p.clone() } else { format!("({p})") };
    premises.iter().map(name).collect::<Vec<_>>().join(", ")
}
