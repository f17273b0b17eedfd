//! Terms that an approximation leaves out: `+ \dots` and `+ \mathcal{O}(..)` at the end of a sum.

use crate::latex::ast::{Font, Kind, Node, Term};

/// A formula without the marks of what it leaves out. How small that is, is measured: this is only for formulas that are
/// said to be approximations.
pub fn without_remainder(node: &Node) -> Node {
    let node = node.map_children(&mut without_remainder);
    let Kind::Sum(terms) = &node.kind else { return node };
    let kept = terms.len() - terms.iter().rev().take_while(|term| is_remainder(&term.node)).count();
    match &terms[..kept] {
        _ if kept == terms.len() => node,
        [] => node,
        [Term { sign_span: None, node: only, .. }] => only.clone(),
        kept => Node::new(Kind::Sum(kept.to_vec()), node.span.clone()),
    }
}

/// Whether a term stands for what is left out: `\dots`, `\mathcal{O}(x^2)`.
pub fn is_remainder(node: &Node) -> bool {
    match &node.kind {
        Kind::Ellipsis => true,
        Kind::Juxt(factors) => match factors.as_slice() {
            [Node { kind: Kind::Ellipsis, .. }, rest @ ..] => rest.iter().all(is_note),
            [order, group] => is_order(order) && matches!(group.kind, Kind::Group { .. }),
            _ => false,
        },
        _ => false,
    }
}

/// The letter of Landau's symbol.
fn is_order(node: &Node) -> bool {
    match &node.kind {
        Kind::Styled(Font::Calligraphic, body) => matches!(&body.kind, Kind::Symbol(s) if s == "O"),
        _ => false,
    }
}

/// What is noted behind the dots: how many terms there are.
fn is_note(node: &Node) -> bool {
    match &node.kind {
        Kind::Text(_) => true,
        Kind::Group { body, .. } => match &body.kind {
            Kind::Juxt(factors) => factors.iter().any(is_note),
            _ => is_note(body),
        },
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::latex::{parse, to_latex};

    fn left(latex: &str) -> String {
        to_latex(&without_remainder(&parse(latex).unwrap()))
    }

    #[test]
    fn marks_at_the_end_are_dropped() {
        assert_eq!(left(r"a = b + c + \dots"), "a = b + c");
        assert_eq!(
            left(r"a = \frac{1}{2} \left( b - c + \cdots \right) + \mathcal{O}(x^3)"),
            left(r"a = \frac{1}{2} \left( b - c \right)")
        );
        assert_eq!(left(r"a = b + \dots (39 \text{ terms})"), "a = b");
    }

    #[test]
    fn terms_are_kept() {
        for latex in [r"a = \dots + b", r"a = b + O(c)", r"a = b + \mathcal{O}", r"a + \dots + b = c"] {
            assert_eq!(left(latex), to_latex(&parse(latex).unwrap()), "{latex}");
        }
    }
}
