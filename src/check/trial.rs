//! Trying other formulas in the place of an equation's own, by the same check on the same premises.
//!
//! The premises are solved once for each link of the original; a formula that speaks of nothing else than the original
//! and its premises, or of symbols that no premise speaks of, is evaluated at these states. That a formula fails there
//! is final: the states satisfy the premises. That it does not is confirmed by the whole check, which is also what
//! judges everything else (approximations, inequalities, solutions, symbols that the premises bind elsewhere).

use std::collections::{BTreeMap, BTreeSet};

use crate::expr::{Deadline, SymId, Tape, Workspace};
use crate::latex::ast::{Node, Rel};
use crate::number::{Df64, Number, Tracked};
use crate::semantics::{self, Clause, ErrorKind, Side, Statement, World};

use super::book::{Book, Version};
use super::claim::{Claim, Source, pairs};
use super::decide::{Finding, findings};
use super::judge::{defines, judge_link, judge_statement};
use super::options::Options;
use super::random::{Random, draw};
use super::sameness;
use super::sampling::{PairValue, Sampler};
use super::system::source;
use super::value;
use super::verdict::{LinkJudgement, Strength, Verdict};

/// The number of solved states that are kept for each link. A wrong formula mostly fails at the first.
const STATES: usize = 6;
/// The number of states that the whole check begins with.
const FEW: usize = 2;

/// What became of a formula.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// It holds, exactly or asymptotically.
    Holds,
    /// It differs at a state.
    Fails,
    /// The shapes of its sides do not meet.
    Misshapen,
    /// It only changes what a symbol is defined as: there is nothing that it could contradict.
    Definition,
    /// It cannot be evaluated on the premises.
    Undecided,
    /// It makes no sense: a symbol that is not declared, a construction that is not known.
    Unclear,
}

/// An equation ready to be tried with other formulas.
pub struct Trial<'b> {
    source: Source<'b>,
    options: Options,
    statement: Statement,
    links: Vec<Link>,
    solution: bool,
}

/// A link of the original.
struct Link {
    verdict: Verdict,
    bench: Option<Bench>,
}

/// A link's claim with solved states.
struct Bench {
    claim: Claim,
    known: BTreeSet<SymId>,
    states: Vec<Vec<Tracked<Df64>>>,
    work: Workspace<Tracked<Df64>>,
}

/// What the solved states say of a formula.
enum Quick {
    Differs,
    Agrees,
    /// It speaks of symbols that the states do not cover.
    Elsewhere,
    Error(ErrorKind),
}

impl<'b> Trial<'b> {
    /// Prepares a version of an equation. `links` is the judgement on it. `None` where it could not be taken apart.
    pub fn new(
        book: &'b Book,
        index: usize,
        version: Version,
        links: &[LinkJudgement],
        options: &Options,
    ) -> Option<Self> {
        let source = Source::new(book, index, version).until(Deadline::after(options.budget));
        let statement = book.statement(index, version).ok()?;
        let entry = &book.entries[index];
        let solution = !entry.list(|a| &a.solves).is_empty();
        let mut known = Vec::new();
        let mut prepared = Vec::new();
        for (k, clause) in statement.clauses.iter().enumerate().filter(|_| !solution) {
            let verdict = links.get(k).map_or(Verdict::Undecided, |l| l.verdict);
            let bench =
                (verdict != Verdict::Definition).then(|| Bench::new(&source.at(k), clause, &known, options)).flatten();
            if verdict == Verdict::Definition {
                known.push(known_by(clause));
            }
            prepared.push(Link { verdict, bench });
        }
        // Whether another formula fails is asked thousands of times, and needs no proof.
        let options = Options { evidence: false, ..options.clone() };
        Some(Trial { source, options, statement, links: prepared, solution })
    }

    /// When the time for trying formulas is used up.
    pub fn deadline(&self) -> Deadline {
        self.source.deadline
    }

    /// Judges a formula in the place of the original.
    pub fn judge(&mut self, tree: &Node) -> Outcome {
        let Ok(statement) = self.source.book.statement_of(self.source.index, tree) else { return Outcome::Unclear };
        let same_links = statement.clauses.len() == self.statement.clauses.len() && !self.solution;
        let definition = same_links && self.changed(&statement).any(|k| self.links[k].verdict == Verdict::Definition);
        if !same_links || definition {
            let outcome = self.in_full(&statement);
            return if definition && outcome == Outcome::Holds { Outcome::Definition } else { outcome };
        }
        let changed: Vec<usize> = self.changed(&statement).collect();
        let unchanged_fails = |k: usize| self.links[k].verdict > Verdict::Asymptotic && !changed.contains(&k);
        if (0..self.links.len()).any(unchanged_fails) {
            return Outcome::Fails;
        }
        let mut confirm = Vec::new();
        for k in changed {
            match self.quick(k, &statement.clauses[k]) {
                Quick::Differs => return Outcome::Fails,
                Quick::Error(ErrorKind::Shape) => return Outcome::Misshapen,
                Quick::Error(_) => return Outcome::Unclear,
                Quick::Agrees | Quick::Elsewhere => confirm.push(k),
            }
        }
        confirm
            .into_iter()
            .map(|k| self.link_in_full(&statement, k))
            .find(|o| *o != Outcome::Holds)
            .unwrap_or(Outcome::Holds)
    }

    /// What becomes of the links of these numbers in a formula with as many links as the original, whatever the others
    /// do: the worst of them.
    pub fn outcome_at(&mut self, tree: &Node, links: &[usize]) -> Outcome {
        let Ok(statement) = self.source.book.statement_of(self.source.index, tree) else { return Outcome::Unclear };
        if self.solution || statement.clauses.len() != self.links.len() {
            return Outcome::Unclear;
        }
        let mut confirm = Vec::new();
        for k in links.iter().copied() {
            if statement.clauses[k] == self.statement.clauses[k] {
                if self.links[k].verdict > Verdict::Asymptotic {
                    return Outcome::Fails;
                }
                continue;
            }
            match self.quick(k, &statement.clauses[k]) {
                Quick::Agrees | Quick::Elsewhere => confirm.push(k),
                Quick::Differs => return Outcome::Fails,
                Quick::Error(_) => return Outcome::Unclear,
            }
        }
        let outcomes: Vec<Outcome> = confirm.into_iter().map(|k| self.link_in_full(&statement, k)).collect();
        let bad = outcomes.iter().find(|o| !matches!(o, Outcome::Holds | Outcome::Definition));
        let definition = outcomes.iter().find(|o| **o == Outcome::Definition);
        *bad.or(definition).unwrap_or(&Outcome::Holds)
    }

    /// Whether a formula that holds says the same as the original, whatever the premises are: see [`sameness`].
    pub fn is_equivalent(&self, tree: &Node) -> bool {
        let Ok(statement) = self.source.book.statement_of(self.source.index, tree) else { return false };
        // An equation has one general solution, however its constants are named.
        if self.solution && !self.source.book.entries[self.source.index].list(|a| &a.general).is_empty() {
            return true;
        }
        self.same_clauses(&self.statement.clauses, &statement.clauses)
    }

    /// Whether a formula says no more than the original: its clauses are the same, or relations of order that follow from
    /// those of the original.
    pub fn is_weaker(&self, tree: &Node) -> bool {
        let Ok(statement) = self.source.book.statement_of(self.source.index, tree) else { return false };
        let random = self.random();
        let (own, other) = (&self.statement.clauses, &statement.clauses);
        let weaker = |(a, b): (&Clause, &Clause)| {
            a == b || sameness::same(&self.source, a, b, &random) || sameness::follows(&self.source, a, b, &random)
        };
        own.len() == other.len() && own.iter().zip(other).all(weaker)
    }

    /// Whether two formulas in the place of the original say the same as each other.
    pub fn say_the_same(&self, a: &Node, b: &Node) -> bool {
        let clauses = |tree| self.source.book.statement_of(self.source.index, tree).map(|s| s.clauses);
        match (clauses(a), clauses(b)) {
            (Ok(a), Ok(b)) => self.same_clauses(&a, &b),
            _ => false,
        }
    }

    /// Whether a clause of a formula that the original does not have says no more than 0 = 0: a side is 0, and the other
    /// one is whatever the premises are.
    pub fn says_nothing(&self, tree: &Node) -> bool {
        let Ok(statement) = self.source.book.statement_of(self.source.index, tree) else { return false };
        let random = self.random();
        let new = statement.clauses.iter().filter(|c| !self.statement.clauses.contains(c));
        new.into_iter().any(|c| sameness::is_trivial(&self.source, c, &random))
    }

    fn random(&self) -> Random {
        Random::new(self.options.seed, &self.source.book.entries[self.source.index].equation.label)
    }

    fn same_clauses(&self, own: &[Clause], other: &[Clause]) -> bool {
        self.all_same(own, other) || self.all_same(&sameness::split(own), &sameness::split(other))
    }

    fn all_same(&self, own: &[Clause], other: &[Clause]) -> bool {
        let random = self.random();
        let same = |(a, b): (&Clause, &Clause)| a == b || sameness::same(&self.source, a, b, &random);
        own.len() == other.len() && own.iter().zip(other).all(same)
    }

    /// The number of links that fail, of a formula with as many links as the original; `None` where it has others or
    /// makes no sense.
    pub fn failing_links(&mut self, tree: &Node) -> Option<usize> {
        let statement = self.source.book.statement_of(self.source.index, tree).ok()?;
        if self.solution {
            return Some(usize::from(self.in_full(&statement) != Outcome::Holds));
        }
        if statement.clauses.len() != self.links.len() {
            return None;
        }
        // An edit elsewhere mends nothing.
        if !self.changed(&statement).any(|k| self.links[k].verdict > Verdict::Asymptotic) {
            return None;
        }
        let mut failing = 0;
        for k in 0..self.links.len() {
            let fails = if statement.clauses[k] == self.statement.clauses[k] {
                self.links[k].verdict > Verdict::Asymptotic
            } else {
                match self.quick(k, &statement.clauses[k]) {
                    Quick::Agrees => false,
                    Quick::Differs | Quick::Error(ErrorKind::Shape) => true,
                    Quick::Elsewhere => self.link_in_full(&statement, k) != Outcome::Holds,
                    Quick::Error(_) if self.links[k].verdict == Verdict::Undecided => true,
                    Quick::Error(_) => return None,
                }
            };
            failing += usize::from(fails);
        }
        Some(failing)
    }

    /// The residuals of the links that fail in the original, in doubles at the solved states, for a formula with as many
    /// links; `None` where a link or a symbol has no solved states.
    pub fn failing_residuals(&mut self, tree: &Node) -> Option<Vec<f64>> {
        let statement = self.source.book.statement_of(self.source.index, tree).ok()?;
        if statement.clauses.len() != self.links.len() {
            return None;
        }
        let mut all = Vec::new();
        for (clause, link) in statement.clauses.iter().zip(&mut self.links) {
            if link.verdict == Verdict::Fails {
                all.extend(link.bench.as_mut()?.residuals(&self.source, clause, self.options.seed)?);
            }
        }
        Some(all)
    }

    fn changed<'s>(&'s self, statement: &'s Statement) -> impl Iterator<Item = usize> + 's {
        let pairs = self.statement.clauses.iter().zip(&statement.clauses).enumerate();
        pairs.filter(|(_, (a, b))| a != b).map(|(k, _)| k)
    }

    fn quick(&mut self, k: usize, clause: &Clause) -> Quick {
        match &mut self.links[k].bench {
            Some(bench) => bench.judge(&self.source, clause, self.options.seed),
            None => match understood(&self.source, clause) {
                Ok(()) => Quick::Elsewhere,
                Err(kind) => Quick::Error(kind),
            },
        }
    }

    /// The whole check on one link.
    fn link_in_full(&self, statement: &Statement, k: usize) -> Outcome {
        let entry = &self.source.book.entries[self.source.index];
        let clause = &statement.clauses[k];
        if defines(self.source.book, self.source.index, clause) {
            return Outcome::Definition;
        }
        let definitions = self.links.iter().zip(&statement.clauses).take(k);
        let known: Vec<Clause> =
            definitions.filter(|(l, _)| l.verdict == Verdict::Definition).map(|(_, c)| known_by(c)).collect();
        self.with_rising_states(&mut |options| {
            let judged = judge_link(&self.source.at(k), clause, &entry.scope, &known, options);
            (judged.verdict, judged.strength)
        })
    }

    /// The whole check on all links.
    fn in_full(&self, statement: &Statement) -> Outcome {
        for clause in &statement.clauses {
            match understood(&self.source, clause) {
                Ok(()) => {}
                Err(ErrorKind::Shape) => return Outcome::Misshapen,
                Err(_) => return Outcome::Unclear,
            }
        }
        self.with_rising_states(&mut |options| {
            let judged = judge_statement(&self.source, statement, options);
            let strength = judged.links.iter().find(|l| l.verdict == judged.verdict).and_then(|l| l.strength);
            (judged.verdict, strength)
        })
    }

    /// Judges with few states, and with all where it does not fail at these.
    fn with_rising_states(&self, judge: &mut dyn FnMut(&Options) -> (Verdict, Option<Strength>)) -> Outcome {
        let few = Options { states: FEW.min(self.options.states), ..self.options.clone() };
        let mut outcome = outcome(judge(&few));
        if !matches!(outcome, Outcome::Fails | Outcome::Misshapen) {
            outcome = self::outcome(judge(&self.options));
        }
        outcome
    }
}

fn outcome((verdict, strength): (Verdict, Option<Strength>)) -> Outcome {
    match verdict {
        Verdict::Holds | Verdict::Asymptotic => Outcome::Holds,
        Verdict::Fails if strength == Some(Strength::Shape) => Outcome::Misshapen,
        Verdict::Fails => Outcome::Fails,
        Verdict::Definition => Outcome::Definition,
        Verdict::Statement | Verdict::Undecided | Verdict::Unreadable => Outcome::Undecided,
    }
}

/// What a definition lets the links behind it know; of a datum `J \sim 0.''2`, that the sides are equal.
fn known_by(clause: &Clause) -> Clause {
    let rel = if matches!(clause.rel, Rel::Sim | Rel::Approx | Rel::Cong) { Rel::Eq } else { clause.rel };
    Clause { rel, ..clause.clone() }
}

/// Whether a clause makes sense by itself.
fn understood(source: &Source, clause: &Clause) -> Result<(), ErrorKind> {
    let scope = &source.book.entries[source.index].scope;
    semantics::understand(&mut World::until(source.deadline), scope, clause, true).map(|_| ()).map_err(|e| e.kind)
}

impl Bench {
    /// Solves the premises of a link at a few states; `None` where the link is not a plain equality or has none.
    fn new(source: &Source, clause: &Clause, known: &[Clause], options: &Options) -> Option<Bench> {
        let clause = mapped(source, clause)?;
        if !matches!(clause.rel, Rel::Eq | Rel::Equiv | Rel::Implies) || has_branches(&clause) {
            return None;
        }
        // A rounded value agrees without being equal.
        if value::is_value(source.book, source.index) {
            return None;
        }
        let entry = &source.book.entries[source.index];
        let mut claim = source.claim(&clause, &entry.scope, known).ok().filter(|c| c.small.is_none() && !c.partial)?;
        let mut random = Random::new(options.seed, &format!("{}/trial", entry.equation.label));
        let sampler = Sampler::new(&mut claim, &mut random, &[]).ok()?;
        let states = sampler.states(STATES, &mut random, &BTreeMap::new()).ok()?;
        let states: Vec<_> = states.iter().filter_map(|s| sampler.system.refine::<Df64>(s, &())).collect();
        let sources = sampler.system.free.iter().chain(&sampler.system.unknowns);
        let known: BTreeSet<SymId> = sources.map(|s| s.symbol).collect();
        (!states.is_empty()).then_some(Bench { claim, known, states, work: Workspace::default() })
    }

    fn judge(&mut self, source: &Source, clause: &Clause, seed: u64) -> Quick {
        let scope = &source.book.entries[source.index].scope;
        let Some(clause) = mapped(source, clause) else { return Quick::Error(ErrorKind::Unsupported) };
        if has_branches(&clause) {
            return Quick::Elsewhere;
        }
        let world = &mut self.claim.world;
        // Where many formulas have filled the graph, the rest get one of their own each.
        if world.graph.cut_short().is_some() {
            return Quick::Elsewhere;
        }
        let link = match semantics::understand(world, scope, &clause, true) {
            Ok(link) => link,
            Err(error) => return Quick::Error(error.kind),
        };
        let mut outputs = Vec::new();
        for pair in pairs(world, &link, clause.rhs == Side::Constant) {
            let residual = self.claim.premises.resolve(&mut world.graph, pair.residual);
            outputs.extend([residual, world.graph.magnitude(residual)]);
        }
        if world.graph.cut_short().is_some() {
            return Quick::Elsewhere;
        }
        let tape = Tape::compile(&world.graph, &outputs);
        if !self.cover(tape.inputs(), seed) {
            return Quick::Elsewhere;
        }
        let zero = Df64::zero(&());
        for values in &self.states {
            let inputs: Vec<Tracked<Df64>> = tape.inputs().iter().map(|s| values[s.index()].clone()).collect();
            let out = tape.eval(&inputs, &(), &mut self.work);
            let values: Vec<PairValue<Df64>> = out.chunks(2).map(|q| pair_value(&q[0], &q[1], &zero)).collect();
            if findings(&values).iter().any(|f| matches!(f, Finding::Differ(_))) {
                return Quick::Differs;
            }
        }
        Quick::Agrees
    }

    /// The residuals at the solved states in doubles.
    fn residuals(&mut self, source: &Source, clause: &Clause, seed: u64) -> Option<Vec<f64>> {
        let clause = mapped(source, clause).filter(|c| !has_branches(c))?;
        let world = &mut self.claim.world;
        let scope = &source.book.entries[source.index].scope;
        let link = semantics::understand(world, scope, &clause, true).ok()?;
        let pairs = pairs(world, &link, clause.rhs == Side::Constant);
        let outputs: Vec<_> = pairs.iter().map(|p| self.claim.premises.resolve(&mut world.graph, p.residual)).collect();
        let cut_short = world.graph.cut_short().is_some();
        let tape = Tape::compile(&world.graph, &outputs);
        if cut_short || !self.cover(tape.inputs(), seed) {
            return None;
        }
        let mut work = Workspace::default();
        let mut all = Vec::new();
        for values in &self.states {
            let inputs: Vec<f64> = tape.inputs().iter().map(|s| values[s.index()].to_f64()).collect();
            all.extend_from_slice(tape.eval(&inputs, &(), &mut work));
        }
        Some(all)
    }

    /// Whether the states give all these symbols; those that no premise speaks of are drawn.
    fn cover(&mut self, symbols: &[SymId], seed: u64) -> bool {
        for s in symbols {
            if self.known.contains(s) {
                continue;
            }
            let world = &self.claim.world;
            if self.claim.bound.contains(&world.graph.info(*s).base) {
                return false;
            }
            let from = source(world, *s);
            let mut random = Random::new(seed, &world.tex(*s));
            for values in &mut self.states {
                let value = draw(&mut random, from.range, from.integer, false);
                if values.len() <= s.index() {
                    values.resize(s.index() + 1, Tracked::zero(&()));
                }
                values[s.index()] = Tracked::from_ratio(i128::from(value.num), i128::from(value.den), &());
            }
            self.known.insert(*s);
        }
        true
    }
}

fn pair_value(residual: &Tracked<Df64>, size: &Tracked<Df64>, zero: &Df64) -> PairValue<Df64> {
    let (lhs, rhs) = (residual.clone(), Tracked::exact(*zero));
    PairValue { residual: residual.clone(), lhs, rhs, scale_log2: size.value().log2_abs() }
}

/// The clause with an arrow turned into the equality that it stands for.
fn mapped(source: &Source, clause: &Clause) -> Option<Clause> {
    if clause.rel == Rel::To { source.mapped(clause)?.ok() } else { Some(clause.clone()) }
}

fn has_branches(clause: &Clause) -> bool {
    semantics::has_branches(&clause.lhs) || matches!(&clause.rhs, Side::Node(n) if semantics::has_branches(n))
}
