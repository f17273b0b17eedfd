//! The graph of one equation together with what is known of its symbols.

use std::collections::HashMap;

use crate::expr::{Cut, Deadline, Expr, Graph, MOST_NODES, SymId};
use crate::latex::ast::Span;

use super::error::{Error, Result};
use super::motion::History;
use super::units::Dimension;
use super::value::Value;

/// The most values that are worked out to write a formula out: about a second.
const MOST_STEPS: usize = 500_000;

/// The most nodes where joints are taken down: dimensions are looked at for every equation, and decide none.
const MOST_NODES_WITH_JOINTS: usize = MOST_NODES / 16;

/// What is known of a symbol of the graph.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Facts {
    /// Its LaTeX for the reader.
    pub tex: String,
    /// The range it is sampled from, where one is declared.
    pub range: Option<[f64; 2]>,
    /// Whether it takes integers only.
    pub integer: bool,
    /// The quantity it is, where it is one.
    pub quantity: Option<Quantity>,
    /// What it depends on beside the time, by no formula: the names.
    pub depends: Vec<String>,
}

/// A physical quantity: what a declaration speaks of, of which vectors and families have many symbols.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Quantity {
    /// The declared name.
    pub name: String,
    /// Where it is declared, in bytes of the file.
    pub declared: usize,
    /// The dimension of the declared unit.
    pub dimension: Option<Dimension>,
}

impl Quantity {
    /// A quantity of this dimension that no declaration speaks of.
    pub(super) fn of(dimension: Dimension) -> Self {
        Quantity { name: String::new(), declared: 0, dimension: Some(dimension) }
    }
}

/// Values that a formula joins, so that they must have one dimension, each with its LaTeX.
#[derive(Clone, Debug)]
pub struct Joint {
    /// What joins them.
    pub role: Role,
    /// The values joined.
    pub parts: Vec<(String, Value)>,
}

/// What joins the values of a [`Joint`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Role {
    /// They are terms of a sum.
    Sum,
    /// It is the argument of a function, and must be a number.
    Argument(String),
    /// It is an exponent, and must be a number.
    Exponent,
}

/// One equation's graph and its symbols. Symbols are identified by their names, so an equation and its premises speak
/// of the same things where they use the same letters.
#[derive(Default)]
pub struct World {
    /// The graph of scalar operations.
    pub graph: Graph,
    facts: HashMap<SymId, Facts>,
    triads: HashMap<String, [[Expr; 3]; 3]>,
    joints: Option<Vec<Joint>>,
    pub(super) history: History,
    /// What is equal at the moment that is spoken of: a symbol and its value there.
    pub moment: Vec<(Expr, Expr)>,
    /// The variables of definite integrals.
    pub(super) integrated: std::collections::BTreeSet<String>,
    /// What is positive where the sums that stand for means are precise.
    pub(super) precise: Vec<Expr>,
    steps: usize,
}

impl World {
    /// What must be positive at a state, so that sums which stand for means are precise there.
    pub fn precise(&self) -> &[Expr] {
        &self.precise
    }

    /// An empty world.
    pub fn new() -> Self {
        World::default()
    }

    /// An empty world in which nothing is built any more when the time is used up.
    pub fn until(deadline: Deadline) -> Self {
        World { graph: Graph::until(deadline), ..World::default() }
    }

    /// Begins a formula: its steps are counted by themselves.
    pub(super) fn begin_steps(&mut self) {
        self.steps = 0;
    }

    /// Counts a step of writing a formula out.
    ///
    /// # Errors
    /// The formula is too large, or the time is used up.
    pub(super) fn step(&mut self, span: &Span) -> Result<()> {
        self.steps += 1;
        if self.steps > MOST_STEPS {
            return Err(too_large("values", MOST_STEPS, span));
        }
        // The clock is slower than a step.
        if self.steps.is_multiple_of(256) { self.check(span) } else { Ok(()) }
    }

    /// Whether all that was built could be taken in.
    ///
    /// # Errors
    /// The formula is too large, or the time is used up.
    pub fn check(&mut self, span: &Span) -> Result<()> {
        match self.graph.cut_short() {
            None => Ok(()),
            Some(Cut::Size) => Err(too_large("operations", MOST_NODES, span)),
            Some(Cut::Time) => Err(Error::limit(self.graph.deadline().used_up("writing the formula out"), span)),
        }
    }

    /// An empty world that takes down which values the formulas join.
    pub fn with_joints() -> Self {
        World { joints: Some(Vec::new()), graph: Graph::with_room(MOST_NODES_WITH_JOINTS), ..World::default() }
    }

    /// The joints taken down since they were last taken, inner ones before those around them.
    pub fn take_joints(&mut self) -> Vec<Joint> {
        self.joints.as_mut().map(std::mem::take).unwrap_or_default()
    }

    /// Takes down a joint, if joints are taken down here.
    pub(super) fn join(&mut self, joint: impl FnOnce() -> Joint) {
        if let Some(joints) = &mut self.joints {
            joints.push(joint());
        }
    }

    /// The symbol of a name. What is known of it is kept from the first time it is met.
    pub fn symbol(&mut self, name: &str, of_t: bool, facts: impl FnOnce() -> Facts) -> SymId {
        let id = if of_t { self.graph.time_symbol(name) } else { self.graph.symbol(name) };
        self.facts.entry(id).or_insert_with(facts);
        id
    }

    /// What is known of a symbol; a derivative has no range of its own.
    pub fn facts(&self, id: SymId) -> Facts {
        match self.facts.get(&id) {
            Some(facts) => facts.clone(),
            None => Facts { tex: self.tex(id), ..Facts::default() },
        }
    }

    /// A symbol's LaTeX.
    pub fn tex(&self, id: SymId) -> String {
        if let Some(facts) = self.facts.get(&id) {
            return facts.tex.clone();
        }
        let info = self.graph.info(id);
        let base =
            self.facts.get(&info.base).map_or_else(|| self.graph.info(info.base).name.clone(), |f| f.tex.clone());
        match info.order {
            0 => base,
            n @ 1..=3 => format!("\\{}ot{{{base}}}", "d".repeat(n as usize)),
            n => format!("{base}^{{({n})}}"),
        }
    }

    /// Declares a symbol's range anew, as an equation's own annotation may.
    pub fn set_range(&mut self, id: SymId, range: [f64; 2]) {
        let mut facts = self.facts(id);
        facts.range = Some(range);
        self.facts.insert(id, facts);
    }

    /// Whether a range is declared for a symbol.
    pub fn has_range(&self, id: SymId) -> bool {
        self.facts.get(&id).is_some_and(|f| f.range.is_some())
    }

    /// The triad of a basis, once it has been built.
    pub(super) fn triad(&self, basis: &str) -> Option<[[Expr; 3]; 3]> {
        self.triads.get(basis).copied()
    }

    /// Remembers the triad of a basis.
    pub(super) fn set_triad(&mut self, basis: &str, triad: [[Expr; 3]; 3]) {
        self.triads.insert(basis.to_owned(), triad);
    }
}

fn too_large(what: &str, most: usize, span: &Span) -> Error {
    Error::limit(format!("written out, this has more than {most} {what}"), span)
        .with_help("let its sums have fewer terms, and its indices fewer values, as in 'i' = { index = [1, 3] }")
}
