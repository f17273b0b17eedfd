//! The printed terms of a clause's sides, each understood on its own.

use crate::latex::ast::{Kind, Node};
use crate::latex::to_latex;

use super::elaborate::Elaborator;
use super::error::Result;
use super::juxtaposition::Item;
use super::link::assignments;
use super::scope::Scope;
use super::statement::{Clause, Side};
use super::units;
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
    /// Whether the name of a unit stands in it as words, so that its dimension is not that of its value.
    pub unit: bool,
    /// The function whose argument, without brackets, reaches to the term's end.
    pub open: Option<String>,
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
    let indices = assignments(scope, &letters, &clause.lhs.span)?.into_iter().next().unwrap_or_default();
    let mut elaborator = Elaborator::new(world, scope, indices, true);
    let mut terms = Vec::new();
    for (k, side) in sides.iter().enumerate() {
        for node in terms_of(side) {
            let value = elaborator.value(node)?.value;
            let (unit, open) = (has_unit(node), open_function(node));
            terms.push(PrintedTerm { latex: to_latex(node), value, left: k == 0, unit, open });
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

/// Whether a unit is a factor of a term or of a part of it; words in a subscript belong to a name.
fn has_unit(node: &Node) -> bool {
    match &node.kind {
        // Exponents in words are set in mathematics: `m s$^{-1}$`.
        Kind::Text(text) => units::parse(&text.replace(['$', '{', '}'], "")).is_ok(),
        Kind::Scripts { base, .. } => has_unit(base),
        Kind::Annotated { body, .. } => has_unit(body),
        _ => node.children().into_iter().any(has_unit),
    }
}

/// The last function of a product, where no bracket shows the end of its argument.
fn open_function(node: &Node) -> Option<String> {
    let Kind::Juxt(factors) = &node.kind else { return None };
    let name = |n: &Node| match &n.kind {
        Kind::Function(name) => Some(name.clone()),
        Kind::Scripts { base, .. } => match &base.kind {
            Kind::Function(name) => Some(name.clone()),
            _ => None,
        },
        _ => None,
    };
    let (at, name) = factors.iter().enumerate().rev().find_map(|(k, n)| Some((k, name(n)?)))?;
    let bracketed = factors[at + 1..].iter().any(|n| matches!(n.kind, Kind::Group { .. }));
    (!bracketed).then_some(name)
}
