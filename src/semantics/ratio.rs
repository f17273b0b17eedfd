//! Ratios `a : b` as quotients: `1 : x \sim 1 : 5` compares 1/x with 1/5.

use crate::latex::ast::{Kind, Link, Node, Rel};

/// A chain with every ratio of two sides written as their quotient; `None` where it has none. Longer ones, `a : b : c`, are
/// no quotients and stay.
pub(super) fn folded(first: Option<&Node>, links: &[Link]) -> Option<(Option<Node>, Vec<Link>)> {
    let is_ratio = |k: usize| links.get(k).is_some_and(|l| l.rel == Rel::Ratio);
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
    fn what_stands_beside_const_goes_to_the_left() {
        assert_eq!(links(r"\ell = n t + \text{const.}"), [r"\ell - n t = \text{const.}"]);
    }
}
