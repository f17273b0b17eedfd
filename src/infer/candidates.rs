//! What an equation may follow from: the displays before it, and the inline formulas around it.

use std::collections::BTreeSet;

use crate::check::{Book, Formula, Version};
use crate::document::{Document, Span};
use crate::expr::{Expr, SymId, Tape, Workspace};
use crate::latex::ast::{Kind, Node, Rel};
use crate::semantics::{self, Clause, Elaborator, Scope, Side, World};

use super::evidence::is_name;

/// A formula that an equation may follow from.
#[derive(Clone, Debug)]
pub struct Candidate {
    /// What it is.
    pub source: Origin,
    /// Where it stands in the file.
    pub span: Span,
    /// The symbols it speaks of, derivatives as what they are derivatives of.
    pub symbols: BTreeSet<String>,
    /// The number of equations between scalars that it makes.
    pub equations: usize,
    /// Whether it has what depends on the time, so that its derivatives say more than it does.
    pub moves: bool,
    /// The symbols of which it has rates.
    pub rates: BTreeSet<String>,
    /// Its statements: the symbols and the number of equations of each.
    pub parts: Vec<(BTreeSet<String>, usize)>,
}

/// Where a candidate comes from.
#[derive(Clone, Debug, PartialEq)]
pub enum Origin {
    /// A display: its number in the book and its label.
    Display(usize, String),
    /// What can be read of a display: its number in the book, its label, and the LaTeX.
    Part(usize, String, String),
    /// An inline formula: its LaTeX.
    Inline(String),
}

/// The candidates of a document, in the order of the file.
pub fn candidates(book: &Book, document: &Document) -> Vec<Candidate> {
    let mut found = Vec::new();
    for (index, entry) in book.entries.iter().enumerate() {
        let Ok(statement) = book.statement(index, Version::Printed) else { continue };
        let (label, span) = (entry.equation.label.clone(), entry.equation.span.clone());
        let origin = Origin::Display(index, label.clone());
        let whole = candidate(origin, span.clone(), &entry.scope, &statement.clauses);
        if whole.is_some() {
            found.extend(whole);
            continue;
        }
        for (latex, clauses) in readable(&entry.scope, &statement.clauses) {
            found.extend(candidate(Origin::Part(index, label.clone(), latex), span.clone(), &entry.scope, &clauses));
        }
    }
    for (span, formula) in inline(document) {
        let Some(scope) = scope_at(book, span.start) else { continue };
        let Ok(tree) = &formula.tree else { continue };
        let Ok(statement) = semantics::statement(tree, None) else { continue };
        found.extend(candidate(Origin::Inline(formula.latex), span, scope, &statement.clauses));
    }
    found.sort_by_key(|c| c.span.start);
    found
}

/// What is said by the sides of a chain of equalities that can be understood, where others cannot: of W = ∫ .. = a = b
/// it is W = a and a = b.
fn readable(scope: &Scope, clauses: &[Clause]) -> Vec<(String, Vec<Clause>)> {
    let mut found = Vec::new();
    let mut last: Option<Node> = None;
    for (k, clause) in clauses.iter().enumerate() {
        let chained = k > 0 && clauses[k - 1].rhs == Side::Node(clause.lhs.clone());
        if !chained {
            last = Some(clause.lhs.clone()).filter(|n| is_readable(scope, n));
        }
        let Side::Node(rhs) = &clause.rhs else { continue };
        if !matches!(clause.rel, Rel::Eq | Rel::Equiv) || !is_readable(scope, rhs) {
            continue;
        }
        if let Some(lhs) = last.replace(rhs.clone()) {
            let clause = Clause { lhs, ..clause.clone() };
            found.push((clause.latex(), vec![clause]));
        }
    }
    found
}

fn is_readable(scope: &Scope, node: &Node) -> bool {
    let mut world = World::new();
    let value = Elaborator::new(&mut world, scope, Vec::new(), true).value(node);
    value.is_ok_and(|typed| !world.graph.has_integrals(&typed.value.components()))
}

/// The inline formulas of a document with their places, their macros expanded.
pub fn inline(document: &Document) -> impl Iterator<Item = (Span, Formula)> {
    document.formulas.iter().map(|span| (span.clone(), Formula::new(document.formula(span))))
}

/// The declarations in force where an inline formula stands: those of the display before it, or of the first one.
fn scope_at(book: &Book, at: usize) -> Option<&Scope> {
    let before = book.entries.iter().rev().find(|e| e.equation.span.start <= at);
    before.or(book.entries.iter().next()).map(|e| e.scope.as_ref())
}

/// A candidate, where all that is stated are equalities that can be understood.
fn candidate(source: Origin, span: Span, scope: &Scope, clauses: &[Clause]) -> Option<Candidate> {
    if clauses.is_empty() || !clauses.iter().all(|c| matches!(c.rel, Rel::Eq | Rel::Equiv)) {
        return None;
    }
    if matches!(source, Origin::Inline(_)) && clauses.iter().any(is_condition) {
        return None;
    }
    let Spoken { symbols, equations, moves, rates, parts, integrals } = Spoken::of(scope, clauses)?;
    // Premises are solved by many steps, at each of which an integral would have to be done; what it is said to equal does.
    if integrals {
        return None;
    }
    Some(Candidate { source, span, symbols, equations, moves, rates, parts })
}

/// Whether an inline formula says for which value something is said, `t = 0`, `x = l`, and not what is so.
fn is_condition(clause: &Clause) -> bool {
    let plain = |n: &Node| is_name(n) || matches!(n.kind, Kind::Number(_));
    is_name(&clause.lhs) && matches!(&clause.rhs, Side::Node(n) if plain(n))
}

/// What clauses speak of.
#[derive(Clone, Debug)]
pub struct Spoken {
    /// The symbols, derivatives as what they are derivatives of.
    pub symbols: BTreeSet<String>,
    /// The number of scalar equations.
    pub equations: usize,
    /// Whether something depends on the time.
    pub moves: bool,
    /// The symbols of which they have rates.
    pub rates: BTreeSet<String>,
    /// The symbols and the number of scalar equations of each clause.
    pub parts: Vec<(BTreeSet<String>, usize)>,
    /// Whether they have definite integrals.
    pub integrals: bool,
}

impl Spoken {
    /// Reads clauses; none where they cannot be understood, or say nothing of any symbol.
    pub fn of(scope: &Scope, clauses: &[Clause]) -> Option<Self> {
        let mut world = World::new();
        let mut all = Vec::new();
        let mut equations = 0;
        let mut clausewise: Vec<(Vec<Expr>, usize)> = Vec::new();
        for clause in clauses {
            let (first, before) = (all.len(), equations);
            let link = semantics::understand(&mut world, scope, clause, true).ok()?;
            for instance in &link.instances {
                all.extend(instance.lhs.components());
                if clause.rhs != Side::Constant {
                    all.extend(instance.rhs.components());
                }
                equations += instance.lhs.components().len();
            }
            clausewise.push((all[first..].to_vec(), equations - before));
        }
        let ids: BTreeSet<SymId> = world.graph.symbols(&all);
        let cancelled = if equations == 1 { cancelled(&mut world, &all) } else { BTreeSet::new() };
        let base = |id: &SymId| world.graph.info(*id).base;
        let spoken = ids.iter().filter(|id| !cancelled.contains(id));
        let symbols: BTreeSet<String> = spoken.map(|id| world.graph.info(base(id)).name.clone()).collect();
        let rates = ids.iter().filter(|id| world.graph.info(**id).order > 0);
        let rates: BTreeSet<String> = rates.map(|id| world.graph.info(base(id)).name.clone()).collect();
        let moves = !rates.is_empty() || symbols.contains("t");
        let names = |sides: &[Expr]| -> BTreeSet<String> {
            let ids = world.graph.symbols(sides).into_iter().map(|id| world.graph.info(base(&id)).name.clone());
            ids.filter(|name| symbols.contains(name)).collect()
        };
        let integrals = world.graph.has_integrals(&all);
        let parts = clausewise.iter().map(|(sides, count)| (names(sides), *count)).collect();
        (!symbols.is_empty()).then_some(Spoken { symbols, equations, moves, rates, parts, integrals })
    }
}

/// The symbols that are a factor of both sides, or of a power of them, as the mass in m v²/2 = m g h: what is said does not
/// depend on them. With such a symbol doubled the difference of the sides grows by the same factor everywhere.
fn cancelled(world: &mut World, sides: &[Expr]) -> BTreeSet<SymId> {
    let [lhs, rhs] = sides else { return BTreeSet::new() };
    let residual = world.graph.sub(*lhs, *rhs);
    let tape = Tape::compile(&world.graph, &[residual]);
    let mut work = Workspace::default();
    let mut at = |values: &[f64]| tape.eval(values, &(), &mut work).first().copied().unwrap_or(f64::NAN);
    let inputs = tape.inputs();
    let state = |n: usize| (0..inputs.len()).map(|k| 1.0 + 0.4 * (1.7 * k as f64 + 2.3 * n as f64).sin()).collect();
    let states: Vec<Vec<f64>> = (0..3).map(state).collect();
    let mut found = BTreeSet::new();
    for (k, symbol) in inputs.iter().enumerate() {
        let mut growth = |values: &Vec<f64>| {
            let mut doubled = values.clone();
            doubled[k] *= 2.0;
            at(&doubled) / at(values)
        };
        let growths: Vec<f64> = states.iter().map(&mut growth).collect();
        let alike = growths.iter().all(|g| (g - growths[0]).abs() < 1e-9 * growths[0].abs());
        if alike && (growths[0] - 1.0).abs() > 1e-3 {
            found.insert(*symbol);
        }
    }
    found
}
