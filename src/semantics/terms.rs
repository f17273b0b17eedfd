//! The printed terms of a clause's sides, each understood on its own.

use crate::latex::ast::{Kind, Node};
use crate::latex::to_latex;

use super::elaborate::Elaborator;
use super::error::Result;
use super::juxtaposition::Item;
use super::scope::Scope;
use super::statement::{Clause, Side, assignments};
use super::value::Value;
use super::world::World;

/// A term as printed, without its sign.
#[derive(Clone, Debug)]
pub struct PrintedTerm {
    /// Its LaTeX.
    pub latex: String,
    /// Its value, for the first values of the free indices.
    pub value: Value,
    /// Whether it stands on the left side.
    pub left: bool,
    /// Whether words stand in it, such as the name of a unit.
    pub words: bool,
}

/// The terms of both sides in the order of printing; `const.` has none. Vectors beside columns are their components.
///
/// # Errors
/// Those of understanding the terms.
pub fn printed_terms(world: &mut World, scope: &Scope, clause: &Clause) -> Result<Vec<PrintedTerm>> {
    let mut sides = vec![&clause.lhs];
    if let Side::Node(rhs) = &clause.rhs {
        sides.push(rhs);
    }
    let items: Vec<Item> = sides.iter().map(|n| Item::Factor(n)).collect();
    let letters = Elaborator::new(world, scope, Vec::new(), true).unbound_indices(&items);
    let indices = assignments(scope, &letters).into_iter().next().unwrap_or_default();
    let mut elaborator = Elaborator::new(world, scope, indices, true);
    let mut terms = Vec::new();
    for (k, side) in sides.iter().enumerate() {
        for node in terms_of(side) {
            let value = elaborator.value(node)?.value;
            terms.push(PrintedTerm { latex: to_latex(node), value, left: k == 0, words: has_words(node) });
        }
    }
    if terms.iter().any(|t| matches!(t.value, Value::Matrix(_))) {
        for term in &mut terms {
            term.value = elaborator.as_column(&term.value, &clause.lhs.span)?;
        }
    }
    Ok(terms)
}

fn terms_of(side: &Node) -> Vec<&Node> {
    match &side.kind {
        Kind::Sum(terms) => terms.iter().map(|t| &t.node).collect(),
        Kind::Annotated { body, .. } => terms_of(body),
        _ => vec![side],
    }
}

/// Whether words are a factor of a term or of a part of it; words in a subscript belong to a name.
fn has_words(node: &Node) -> bool {
    match &node.kind {
        Kind::Text(_) => true,
        Kind::Scripts { base, .. } => has_words(base),
        Kind::Annotated { body, .. } => has_words(body),
        _ => node.children().into_iter().any(has_words),
    }
}
