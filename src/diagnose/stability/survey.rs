//! Every formula of a document: where it loses its digits, whether that is the problem's fault, and what rewriting
//! can do.

use rayon::prelude::*;
use serde::Serialize;

use crate::breakdown::caught;
use crate::check::computed::{Computed, Variable, computed};
use crate::check::{Book, Random};
use crate::document::Document;
use crate::expr::{Deadline, Expr, Graph, Node};

use super::meter::Meter;
use super::propose::propose;
use super::same::{Sameness, same};
use super::search::{Effort, Found, search};
use super::space::Space;
use super::write_latex::readable;

/// The bits from which on a loss counts.
pub const MANY: f64 = 10.0;

/// The operations of a formula's search: a larger formula has fewer steps.
const OPERATIONS: usize = 400_000;
/// What an elliptic function counts for.
const ELLIPTIC: usize = 200;
/// The random states of a formula.
const RANDOM: usize = 48;
/// The states that a form is searched for.
const TEACHERS: usize = 10;

/// A stable form that rewriting found.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Proposal {
    /// Its LaTeX; none where it has symbols that are never printed.
    pub latex: Option<String>,
    /// Why it is the same formula.
    pub sameness: Sameness,
    /// What it loses.
    pub found: Found,
}

/// A formula of a document.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Item {
    /// The equation's label.
    pub label: String,
    /// Its line.
    pub line: usize,
    /// The formula.
    pub latex: String,
    /// Its symbols, in the order of a state's values.
    pub symbols: Vec<String>,
    /// What was found.
    pub found: Found,
    /// A form that loses less.
    pub proposal: Option<Proposal>,
}

impl Item {
    /// Whether doubles lose many bits somewhere.
    pub fn loses(&self) -> bool {
        self.found.worst.loss.lost > MANY
    }

    /// Whether they lose many bits beyond the condition somewhere: the formula's fault.
    pub fn is_at_fault(&self) -> bool {
        self.found.fault.loss.fault() > MANY
    }

    /// Whether they lose many bits at one of the random states.
    pub fn loses_at_random(&self) -> bool {
        self.found.worst_random > MANY
    }
}

/// The formulas of a document.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Survey {
    /// The document.
    pub name: String,
    /// Its equations.
    pub equations: usize,
    /// The formulas that could be measured.
    pub items: Vec<Item>,
}

/// How many formulas there are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Counts {
    /// Equations.
    pub equations: usize,
    /// Equations with a formula that could be measured.
    pub with_formula: usize,
    /// Formulas.
    pub formulas: usize,
    /// Those that lose many bits at a random state.
    pub at_random: usize,
    /// Those that lose many bits somewhere.
    pub losing: usize,
    /// Of these, those that lose no more than that beyond the condition: the problem is ill-conditioned.
    pub ill_conditioned: usize,
    /// Of these, those for which rewriting found a form that loses no more than 10 bits anywhere, from numbers that
    /// are taken as exact.
    pub exact_numbers: usize,
    /// The others: the formula is unstable.
    pub unstable: usize,
    /// Of these, those for which rewriting found a form that loses no more than 10 bits beyond the condition.
    pub mended: usize,
}

impl Survey {
    /// Counts the formulas.
    pub fn counts(&self) -> Counts {
        let count = |f: &dyn Fn(&Item) -> bool| self.items.iter().filter(|i| f(i)).count();
        let labels: std::collections::BTreeSet<&str> = self.items.iter().map(|i| i.label.as_str()).collect();
        let mended = |i: &Item| i.proposal.as_ref().is_some_and(|p| p.found.fault.loss.fault() <= MANY);
        let saved = |i: &Item| i.proposal.as_ref().is_some_and(|p| p.found.worst.loss.lost <= MANY);
        let (losing, unstable) = (count(&Item::loses), count(&Item::is_at_fault));
        Counts {
            equations: self.equations,
            with_formula: labels.len(),
            formulas: self.items.len(),
            at_random: count(&Item::loses_at_random),
            losing,
            ill_conditioned: losing - unstable,
            exact_numbers: count(&|i| i.loses() && !i.is_at_fault() && saved(i)),
            unstable,
            mended: count(&|i| i.is_at_fault() && mended(i)),
        }
    }
}

impl Counts {
    /// Of two documents together.
    pub fn and(self, other: Counts) -> Counts {
        Counts {
            equations: self.equations + other.equations,
            with_formula: self.with_formula + other.with_formula,
            formulas: self.formulas + other.formulas,
            at_random: self.at_random + other.at_random,
            losing: self.losing + other.losing,
            ill_conditioned: self.ill_conditioned + other.ill_conditioned,
            unstable: self.unstable + other.unstable,
            exact_numbers: self.exact_numbers + other.exact_numbers,
            mended: self.mended + other.mended,
        }
    }
}

/// Surveys a document, or the equations of some labels. `done` is called after each equation.
pub fn survey(document: &Document, only: &[String], seed: u64, done: &(dyn Fn() + Sync)) -> Survey {
    let book = Book::new(document);
    let wanted: Vec<usize> = (0..book.entries.len())
        .filter(|k| only.is_empty() || only.contains(&book.entries[*k].equation.label))
        .collect();
    let each = |index: &usize| {
        // A panic costs one equation.
        let items = caught(|| of_equation(&book, *index, seed)).unwrap_or_default();
        done();
        items
    };
    let items = wanted.par_iter().flat_map_iter(each).collect();
    Survey { name: document.name.clone(), equations: wanted.len(), items }
}

fn of_equation(book: &Book, index: usize, seed: u64) -> Vec<Item> {
    let equation = &book.entries[index].equation;
    let formulas = computed(book, index, Deadline::NEVER);
    let measured = |(k, mut formula): (usize, Computed)| {
        let mut random = Random::new(seed, &format!("{}/stability/{k}", equation.label));
        let variables = formula.variables(&formula.outputs);
        let effort = effort(&formula.world.graph, &formula.outputs);
        let (graph, outputs) = (&formula.world.graph, formula.outputs.clone());
        let found = search(graph, &outputs, &formula.positive, &variables, &[], effort, &mut random)?;
        let loses = found.worst.loss.lost > MANY;
        let proposal =
            loses.then(|| improved((book, index), &mut formula, &variables, &found, effort, &mut random)).flatten();
        Some(Item {
            label: equation.label.clone(),
            line: equation.line,
            latex: formula.latex,
            symbols: variables.into_iter().map(|v| v.tex).collect(),
            found,
            proposal,
        })
    };
    formulas.into_iter().enumerate().filter_map(measured).collect()
}

/// The same work for all formulas, but for the largest.
fn effort(graph: &Graph, outputs: &[Expr]) -> Effort {
    let weight = |e: &Expr| if matches!(graph.node(*e), Node::Elliptic(..)) { ELLIPTIC } else { 1 };
    let weight: usize = graph.reachable(outputs).iter().map(weight).sum();
    let steps = (OPERATIONS / weight.max(1)).clamp(60, 1000);
    Effort { random: RANDOM.min(steps), steps }
}

/// A form of a formula that loses less, by rewriting.
fn improved(
    place: (&Book, usize),
    formula: &mut Computed,
    variables: &[Variable],
    before: &Found,
    effort: Effort,
    random: &mut Random,
) -> Option<Proposal> {
    let [output] = formula.outputs[..] else { return None };
    let states = teachers(formula, variables, before, random);
    let new = propose(&mut formula.world.graph, output, variables, &states)?;
    let sameness = same(&mut formula.world.graph, &[output], &[new], variables, random);
    let found = search(&formula.world.graph, &[new], &formula.positive, variables, &states, effort, random)?;
    let gains = [
        before.fault.loss.fault() - found.fault.loss.fault(),
        before.worst.loss.lost - found.worst.loss.lost,
        before.mean - found.mean,
    ];
    let better = gains.iter().any(|g| *g > 1.0) && gains.iter().all(|g| *g > -1.0);
    let latex = readable(&mut formula.world, new, place, variables, random);
    (sameness.holds() && better).then_some(Proposal { latex, sameness, found })
}

/// States that a form is to be good at: the hardest, and others.
fn teachers(formula: &Computed, variables: &[Variable], before: &Found, random: &mut Random) -> Vec<Vec<f64>> {
    let graph = &formula.world.graph;
    let mut states = vec![before.fault.state.clone(), before.worst.state.clone()];
    let mut space = Space::new(graph, &formula.outputs, variables);
    let mut meter = Meter::new(graph, &formula.outputs, &formula.positive, variables);
    for k in 0..10 * TEACHERS {
        let state = if k % 2 == 0 { space.inside(random) } else { space.moved(random, &before.fault.state) };
        if states.len() < TEACHERS && meter.is_allowed(&state) && meter.lost(&state).is_some() {
            states.push(state);
        }
    }
    states
}
