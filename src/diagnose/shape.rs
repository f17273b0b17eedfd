//! Small questions about pieces of formulas, and small changes to them.

use crate::latex::ast::{Delim, Kind, Node, Sign, Span, Term};
use crate::semantics::Scope;

use super::names::Name;

/// The factors of a product in units that are dropped together: a function with its argument, a differential.
pub fn units(scope: &Scope, factors: &[Node]) -> Vec<(usize, usize)> {
    let mut units = Vec::new();
    let mut at = 0;
    while at < factors.len() {
        let mut to = at + 1;
        if is_function(&factors[at]) {
            while let Some(argument) = factors.get(to) {
                let begins_anew = acts(argument) || is_function(argument);
                if begins_anew || to > at + 1 && matches!(argument.kind, Kind::Group { .. }) {
                    break;
                }
                to += 1;
                let angle = Name::of(scope, argument).is_some_and(|n| n.entry.is_angle());
                if angle || matches!(argument.kind, Kind::Group { .. }) {
                    break;
                }
            }
        } else if is_letter(&factors[at], "d") && to < factors.len() {
            to += 1;
        }
        units.push((at, to));
        at = to;
    }
    units
}

/// Whether a factor acts on what follows: a sum, a derivative.
pub fn acts(node: &Node) -> bool {
    match &node.kind {
        Kind::BigOp(_) => true,
        Kind::Scripts { base, .. } => matches!(base.kind, Kind::BigOp(_)),
        Kind::Frac(above, below) => differential(below) && !matches!(above.kind, Kind::Juxt(_)),
        _ => false,
    }
}

pub fn is_function(node: &Node) -> bool {
    match &node.kind {
        Kind::Function(name) => name != "const",
        Kind::Scripts { base, .. } => is_function(base),
        _ => false,
    }
}

/// Whether a denominator is that of a derivative.
pub fn differential(below: &Node) -> bool {
    matches!(&below.kind, Kind::Juxt(factors) if is_letter(&factors[0], "d") || is_letter(&factors[0], "\\partial"))
}

/// Whether a numerator is that of a derivative: d, or d with what is differentiated.
pub fn differential_above(above: &Node) -> bool {
    let is_d = |n: &Node| is_letter(n, "d") || is_letter(n, "\\partial");
    match &above.kind {
        Kind::Juxt(factors) => factors.first().is_some_and(is_d),
        _ => is_d(above),
    }
}

pub fn is_letter(node: &Node, letter: &str) -> bool {
    match &node.kind {
        Kind::Symbol(s) => s == letter,
        Kind::Scripts { base, sub: None, .. } => is_letter(base, letter),
        _ => false,
    }
}

pub fn is_words(node: &Node) -> bool {
    match &node.kind {
        Kind::Text(_) | Kind::Empty => true,
        Kind::Function(name) => name == "const",
        Kind::Juxt(factors) => factors.iter().any(is_words),
        _ => false,
    }
}

/// Whether a side is 0, of any shape.
pub fn is_null(node: &Node) -> bool {
    match &node.kind {
        Kind::Number(n) => n == "0",
        Kind::Styled(_, body) => is_null(body),
        _ => false,
    }
}

pub fn starts_with_number(node: &Node) -> bool {
    match &node.kind {
        Kind::Number(_) => true,
        Kind::Juxt(factors) => factors.first().is_some_and(starts_with_number),
        _ => false,
    }
}

pub fn group(body: Node, span: &Span) -> Node {
    Node::new(Kind::Group { open: Delim::Paren, close: Delim::Paren, body: Box::new(body) }, span.clone())
}

/// Factors side by side; a single one stands alone.
pub fn juxt(factors: &[Node], span: &Span) -> Node {
    match factors {
        [only] => only.clone(),
        _ => Node::new(Kind::Juxt(factors.to_vec()), span.clone()),
    }
}

/// A factor before (or behind) others.
pub fn times(factor: &Node, node: &Node) -> Node {
    let flat = |n: &Node| match &n.kind {
        Kind::Juxt(factors) => factors.clone(),
        Kind::Sum(_) => vec![group(n.clone(), &n.span)],
        _ => vec![n.clone()],
    };
    if let Kind::Product { first, rest } = &node.kind {
        let kind = Kind::Product { first: Box::new(times(factor, first)), rest: rest.clone() };
        return Node::new(kind, node.span.clone());
    }
    // A number stays in front.
    let (mut all, rest) = (flat(factor), flat(node));
    let numbers = rest.iter().take_while(|n| matches!(n.kind, Kind::Number(_))).count();
    if numbers > 0 && !matches!(factor.kind, Kind::Number(_)) {
        all.splice(0..0, rest[..numbers].iter().cloned());
        all.extend_from_slice(&rest[numbers..]);
    } else {
        all.extend(rest);
    }
    Node::new(Kind::Juxt(all), node.span.clone())
}

/// The node without a power; a mark in brackets above a name, `f^{(e)}`, is none.
pub fn without_power(node: &Node) -> Node {
    match &node.kind {
        Kind::Scripts { sup: Some(sup), .. } if matches!(sup.kind, Kind::Group { open: Delim::Paren, .. }) => {
            node.clone()
        }
        Kind::Scripts { base, primes: 0, sub: None, sup: Some(_) } => (**base).clone(),
        Kind::Scripts { base, primes, sub, sup: Some(_) } => {
            let kind = Kind::Scripts { base: base.clone(), primes: *primes, sub: sub.clone(), sup: None };
            Node::new(kind, node.span.clone())
        }
        _ => node.clone(),
    }
}

/// The node with a power in place of its own; 1 is not printed.
pub fn with_power(node: &Node, power: u32) -> Node {
    let bare = without_power(node);
    if power == 1 {
        return bare;
    }
    let sup = Some(Box::new(Node::new(Kind::Number(power.to_string()), node.span.clone())));
    let kind = match bare.kind {
        Kind::Scripts { base, primes, sub, sup: None } => Kind::Scripts { base, primes, sub, sup },
        _ => Kind::Scripts { base: Box::new(bare), primes: 0, sub: None, sup },
    };
    Node::new(kind, node.span.clone())
}

/// The node with a term behind it.
pub fn plus(node: &Node, negative: bool, term: &Node) -> Node {
    let sign = if negative { Sign::Minus } else { Sign::Plus };
    let added = Term { sign, sign_span: Some(node.span.clone()), node: term.clone() };
    let mut terms = match &node.kind {
        Kind::Sum(terms) => terms.clone(),
        _ => vec![Term { sign: Sign::Plus, sign_span: None, node: node.clone() }],
    };
    terms.push(added);
    Node::new(Kind::Sum(terms), node.span.clone())
}
