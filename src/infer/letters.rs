//! Letters that are read in two ways: e, the number or a charge; a letter before a bracket, a function or a factor.

use std::collections::BTreeSet;

use crate::latex::ast::{Delim, Kind, Node, Sign, Span};
use crate::semantics::{Clause, Side, spelling};

use super::evidence::is_name;

/// Letters that notes use for masses, charges and constants, and hardly ever for functions.
const FACTORS: [&str; 7] = ["m", "M", "g", "G", "c", "q", "e"];

/// Whether a letter before a bracket may be a factor.
pub fn may_be_factor(name: &str) -> bool {
    let base = name.split(['_', '\'']).next().unwrap_or(name);
    FACTORS.contains(&base)
}

/// The names that are printed without a bracket behind them somewhere.
pub fn bare_names(trees: &[&Node]) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    trees.iter().for_each(|tree| bare(tree, &mut found));
    found
}

fn bare(node: &Node, found: &mut BTreeSet<String>) {
    if is_name(node) {
        found.insert(spelling(node));
        return;
    }
    let Kind::Juxt(factors) = &node.kind else {
        return node.children().into_iter().for_each(|child| bare(child, found));
    };
    for (k, factor) in factors.iter().enumerate() {
        let before_bracket =
            matches!(factors.get(k + 1), Some(Node { kind: Kind::Group { open: Delim::Paren, .. }, .. }));
        if !(before_bracket && is_name(factor)) {
            bare(factor, found);
        }
    }
}

/// Whether e is a quantity, as a charge or an eccentricity, in these formulas: it is a factor beside other names, or stands
/// in a whole power there, and nowhere is it what an exponential is taken of, nor a part of numbers alone.
pub fn letter_e(trees: &[&Node]) -> bool {
    let mut uses = Uses::default();
    trees.iter().for_each(|tree| uses.look(tree));
    uses.factor && !uses.number
}

/// How e is used.
#[derive(Default)]
struct Uses {
    factor: bool,
    number: bool,
}

impl Uses {
    /// Looks through a formula; the depth is bounded by the parser's.
    fn look(&mut self, node: &Node) {
        match &node.kind {
            Kind::Scripts { base, sup: Some(sup), primes: 0, sub: None } if is_e(base) => {
                self.number |= !matches!(&sup.kind, Kind::Number(n) if n.bytes().all(|b| b.is_ascii_digit()));
                return self.look(sup);
            }
            // 1/e, \ln e
            Kind::Frac(above, below) => {
                self.number |= is_e(below) && is_number(above) || is_e(above) && is_number(below);
            }
            Kind::Juxt(factors) => {
                let named = factors.iter().any(|f| !is_e(powerless(f)) && has_name(f));
                self.factor |= named && factors.iter().any(|f| is_e(powerless(f)));
                self.number |= factors.windows(2).any(|p| matches!(p[0].kind, Kind::Function(_)) && is_e(&p[1]));
            }
            Kind::Sum(terms) => self.factor |= terms.len() == 1 && terms[0].sign == Sign::Minus && is_e(&terms[0].node),
            _ => {}
        }
        node.children().into_iter().for_each(|child| self.look(child));
    }
}

/// Where e first stands in a clause.
pub fn first_e(clause: &Clause) -> Option<Span> {
    let right = match &clause.rhs {
        Side::Node(rhs) => Some(rhs),
        Side::Constant => None,
    };
    std::iter::once(&clause.lhs).chain(right).find_map(place_of_e)
}

fn place_of_e(node: &Node) -> Option<Span> {
    if is_e(node) { Some(node.span.clone()) } else { node.children().into_iter().find_map(place_of_e) }
}

fn is_e(node: &Node) -> bool {
    matches!(&node.kind, Kind::Symbol(s) if s == "e")
}

fn is_number(node: &Node) -> bool {
    matches!(node.kind, Kind::Number(_))
}

fn has_name(node: &Node) -> bool {
    is_name(node) && !matches!(&node.kind, Kind::Symbol(s) if s == "e" || s == "d")
        || node.children().into_iter().any(has_name)
}

fn powerless(node: &Node) -> &Node {
    match &node.kind {
        Kind::Scripts { base, primes: 0, sub: None, .. } => base,
        _ => node,
    }
}
