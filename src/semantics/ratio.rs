//! Sides that are written otherwise than they are compared: ratios `a : b` are quotients (`1 : x \sim 1 : 5` compares 1/x
//! with 1/5), and what stands beside the word const. goes to the other side.

use crate::latex::ast::{Kind, Link, Node, Rel, Sign, Term};

use super::statement::{holds_relation, is_constant, is_words};

/// A chain with every ratio of two sides written as their quotient; `None` where it has none. Longer ones, `a : b : c`, are
/// no quotients and stay.
pub(super) fn folded(first: Option<&Node>, links: &[Link]) -> Option<(Option<Node>, Vec<Link>)> {
    // Behind a colon words say what is meant.
    let is_ratio = |k: usize| links.get(k).is_some_and(|l| l.rel == Rel::Ratio && !is_words(&l.rhs));
    let apart = (0..links.len()).all(|k| !is_ratio(k) || !is_ratio(k + 1));
    if !(0..links.len()).any(is_ratio) || !apart || (is_ratio(0) && first.is_none()) {
        return None;
    }
    let quotient = |a: &Node, b: &Node| {
        let span = a.span.start..b.span.end;
        Node::new(Kind::Frac(Box::new(a.clone()), Box::new(b.clone())), span)
    };
    let mut first = first.cloned();
    let mut kept: Vec<Link> = Vec::new();
    for link in links {
        match (link.rel, kept.last_mut()) {
            (Rel::Ratio, Some(before)) => before.rhs = quotient(&before.rhs, &link.rhs),
            (Rel::Ratio, None) => first = first.map(|f| quotient(&f, &link.rhs)),
            _ => kept.push(link.clone()),
        }
    }
    Some((first, kept))
}

/// The left side minus all that is printed beside the word const. on the right, `n t + \text{const.}`.
pub(super) fn without_constant(lhs: &Node, rhs: &Node) -> Option<Node> {
    let Kind::Sum(terms) = &rhs.kind else { return None };
    let (constants, rest): (Vec<&Term>, Vec<&Term>) = terms.iter().partition(|t| is_constant(&t.node));
    let opposite = |sign| match sign {
        Sign::Plus => Sign::Minus,
        Sign::Minus => Sign::Plus,
        Sign::PlusMinus => Sign::MinusPlus,
        Sign::MinusPlus => Sign::PlusMinus,
    };
    if constants.len() != 1 || rest.is_empty() {
        return None;
    }
    let moved = rest.into_iter().map(|t| Term { sign: opposite(t.sign), ..t.clone() });
    let first = Term { sign: Sign::Plus, sign_span: None, node: lhs.clone() };
    Some(Node::new(Kind::Sum(std::iter::once(first).chain(moved).collect()), rhs.span.clone()))
}

/// The relation to the word const. that the first of some items of a list shares with one behind it: `G, H = \text{const.}`.
pub(super) fn shared_constant(items: &[Node]) -> Option<&Link> {
    let (first, behind) = items.split_first()?;
    let is_name = |item: &Node| !holds_relation(item) && !is_words(item) && item.kind != Kind::Empty;
    let last = behind.iter().find(|item| !is_name(item)).filter(|_| is_name(first))?;
    match &last.kind {
        Kind::Chain { first: Some(_), links } => match links.as_slice() {
            [link] if is_constant(&link.rhs) => Some(link),
            _ => None,
        },
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use crate::semantics::statement;

    fn links(latex: &str) -> Vec<String> {
        let tree = crate::latex::parse(latex).unwrap();
        statement(&tree, None).unwrap().clauses.iter().map(|c| c.latex()).collect()
    }

    #[test]
    fn a_ratio_is_a_quotient() {
        assert_eq!(links(r"1 : x \sim 2 : 3"), [r"\frac{1}{x} \sim \frac{2}{3}"]);
        assert_eq!(links(r"z = x : y"), [r"z = \frac{x}{y}"]);
    }

    #[test]
    fn three_in_a_row_are_none() {
        assert_eq!(links("a : b : c = x : y : z").len(), 5);
    }

    #[test]
    fn names_before_const_share_it() {
        assert_eq!(links(r"G, H = \text{const. for } \tau"), [r"G = \text{const.}", r"H = \text{const.}"]);
        assert_eq!(links(r"G, H = K").len(), 1);
    }

    #[test]
    fn what_stands_beside_const_goes_to_the_left() {
        assert_eq!(links(r"\ell = n t + \text{const.}"), [r"\ell - n t = \text{const.}"]);
    }
}
