//! The sides of equations as they are computed: what somebody who uses the notes puts numbers into.
//!
//! A formula is a side with at least one operation and one symbol: the right one, or the left one where the right one
//! is a mere name or number. A side that is equal to 0 or constant is a relation between its symbols and not a number
//! that is looked for, and an integral along the motion is no function of its symbols' values: neither is a formula
//! here. An equation is taken as corrected. Its symbols are independent of each other, each in its declared range, as
//! far as premises that say what is greater allow; premises that say what is equal are not used: a formula is asked
//! for what it is, whatever its variables come from. Of a formula with free indices the first instance is taken.

use std::collections::BTreeSet;

use crate::expr::{Deadline, Expr, Node as Op, SymId, Tape};
use crate::latex::ast::{Node, Rel};
use crate::semantics::{self, Clause, Elaborator, Error, Side, World};

use super::book::{Book, Formula, Version};
use super::claim::Source;
use super::system;

/// What a formula is computed from.
#[derive(Clone, Debug, PartialEq)]
pub struct Variable {
    /// The symbol.
    pub symbol: SymId,
    /// Its LaTeX.
    pub tex: String,
    /// Its declared range, or the default one.
    pub range: [f64; 2],
    /// Whether it takes whole numbers only, and so is exact.
    pub integer: bool,
}

/// A formula ready to be computed.
pub struct Computed {
    /// The graph that it is in.
    pub world: World,
    /// Its LaTeX.
    pub latex: String,
    /// Its scalar components.
    pub outputs: Vec<Expr>,
    /// What must be positive where it is computed.
    pub positive: Vec<Expr>,
}

impl Computed {
    /// The variables of these expressions, in the order in which a tape of them takes their values.
    pub fn variables(&self, expressions: &[Expr]) -> Vec<Variable> {
        let tape = Tape::compile(&self.world.graph, expressions);
        tape.inputs().iter().map(|s| self.variable(*s)).collect()
    }

    fn variable(&self, symbol: SymId) -> Variable {
        let source = system::source(&self.world, symbol);
        Variable { symbol, tex: self.world.tex(symbol), range: source.range, integer: source.integer }
    }
}

/// The formulas of an equation; none where it cannot be understood.
pub fn computed(book: &Book, index: usize, deadline: Deadline) -> Vec<Computed> {
    let Ok(statement) = book.statement(index, Version::Corrected) else { return Vec::new() };
    let source = Source::new(book, index, Version::Corrected).until(deadline);
    let mut formulas: Vec<Computed> = Vec::new();
    let mut seen: BTreeSet<String> = BTreeSet::new();
    for (k, clause) in statement.clauses.iter().enumerate() {
        for clause in semantics::independent_signs(clause) {
            for of_link in of_clause(&source.at(k), &clause) {
                if seen.insert(of_link.text()) {
                    formulas.push(of_link);
                }
            }
        }
    }
    formulas
}

impl Computed {
    /// What tells it apart from other formulas of the equation.
    fn text(&self) -> String {
        self.outputs.iter().map(|e| self.world.graph.display(*e)).collect::<Vec<_>>().join("; ")
    }
}

/// The formulas of a link: two, where a ± has two branches.
fn of_clause(source: &Source, clause: &Clause) -> Vec<Computed> {
    let approximations = matches!(clause.rel, Rel::Approx | Rel::Sim | Rel::Cong);
    let ordered = matches!(clause.rel, Rel::Lt | Rel::Le | Rel::Gt | Rel::Ge);
    if !(matches!(clause.rel, Rel::Eq | Rel::Equiv) || approximations || ordered) {
        return Vec::new();
    }
    let Side::Node(rhs) = &clause.rhs else { return Vec::new() };
    let Ok(count) = source.branches(&mut World::until(source.deadline), source.scope(), clause).map(|b| b.len()) else {
        return Vec::new();
    };
    let branch = |number: usize| {
        let mut world = begun(source);
        let links = source.branches(&mut world, source.scope(), clause).ok()?;
        let instance = links.get(number)?.instances.first()?;
        let (left, right) = (instance.lhs.components(), instance.rhs.components());
        let (outputs, node) = match (is_formula(&world, &right), is_formula(&world, &left)) {
            _ if right.iter().all(|e| world.graph.is_zero(*e)) || left.iter().all(|e| world.graph.is_zero(*e)) => None,
            (true, _) => Some((right, rhs)),
            (false, true) => Some((left, &clause.lhs)),
            (false, false) => None,
        }?;
        let latex = crate::latex::to_latex(node);
        let latex = match (count, number % 2) {
            (1, _) => latex,
            (_, 0) => format!(r"{latex} \quad \text{{(upper sign)}}"),
            _ => format!(r"{latex} \quad \text{{(lower sign)}}"),
        };
        finished(source, world, outputs, latex)
    };
    (0..count).filter_map(branch).collect()
}

/// A formula that stands in no equation, with the declarations that are in force at one.
///
/// # Errors
/// The LaTeX cannot be read, or not be understood there.
pub fn computed_from(book: &Book, index: usize, latex: &str, deadline: Deadline) -> Result<Computed, Error> {
    let source = Source::new(book, index, Version::Corrected).until(deadline);
    let mut world = begun(&source);
    let outputs = expressions(&mut world, book, index, latex)?;
    finished(&source, world, outputs, latex.to_owned())
        .ok_or_else(|| Error::unsupported("this is no formula of declared symbols", &(0..latex.len())))
}

/// The scalar components of LaTeX, with the declarations that are in force at an equation.
///
/// # Errors
/// The LaTeX cannot be read, or not be understood there.
pub fn expressions(world: &mut World, book: &Book, index: usize, latex: &str) -> Result<Vec<Expr>, Error> {
    let tree = Formula::new(latex).tree.map_err(|e| Error::unsupported(e.message, &e.span))?;
    components(world, book, index, &tree)
}

/// As [`expressions`], of a tree.
///
/// # Errors
/// It cannot be understood there.
pub fn components(world: &mut World, book: &Book, index: usize, tree: &Node) -> Result<Vec<Expr>, Error> {
    let value = Elaborator::new(world, &book.entries[index].scope, Vec::new(), true).value(tree)?.value;
    world.check(&tree.span)?;
    Ok(value.components())
}

/// A world in which the bases of the section are built.
fn begun(source: &Source) -> World {
    let mut world = World::until(source.deadline);
    Elaborator::new(&mut world, source.scope(), Vec::new(), true).build_bases();
    world
}

/// The formula with the premises that restrict it.
fn finished(source: &Source, mut world: World, outputs: Vec<Expr>, latex: String) -> Option<Computed> {
    if !is_formula(&world, &outputs)
        || outputs.iter().any(|e| world.remembers(*e))
        || world.graph.has_integrals(&outputs)
    {
        return None;
    }
    // Where premises cannot be used, the ranges are all that is known.
    let ordered = source.given(&mut world).map(|given| given.ordered).unwrap_or_default();
    let _ = source.ranges(&mut world);
    let known = world.graph.symbols(&outputs);
    let mut positive = Vec::new();
    for (rel, e) in ordered {
        let symbols = world.graph.symbols(&[e]);
        if !symbols.is_empty() && symbols.is_subset(&known) {
            positive.push(if matches!(rel, Rel::Lt | Rel::Le) { world.graph.neg(e) } else { e });
        }
    }
    world.graph.cut_short().is_none().then_some(Computed { world, latex, outputs, positive })
}

/// Whether something is computed from something.
fn is_formula(world: &World, components: &[Expr]) -> bool {
    let operation = |e: &Expr| {
        !matches!(world.graph.node(*e), Op::Rational(..) | Op::Pi | Op::E | Op::Symbol(_))
            && !matches!(world.graph.node(*e), Op::Neg(a) if matches!(world.graph.node(*a), Op::Symbol(_)))
    };
    components.iter().any(operation) && !world.graph.symbols(components).is_empty()
}
