//! What an author notes beside a formula: relations under braces, conditions of cases, terms of higher order.

use crate::latex::ast::{Delim, Font, Kind, Link, MatrixEnv, Node, Rel, Term};

use super::statement::is_constant;

/// The relations that stand at the braces of a formula, each with what its brace spans: `\underbrace{a - b}_{=0}`,
/// `\underbrace{v}_{\text{const.}}`. A note without a sign of equality is a name or a remark.
pub(super) fn at_braces(root: &Node) -> Vec<(Node, Link)> {
    let mut found = Vec::new();
    collect(root, &mut found);
    found
}

fn collect(node: &Node, found: &mut Vec<(Node, Link)>) {
    if let Kind::Annotated { body, note: Some(note), .. } = &node.kind {
        let relation = match &note.kind {
            Kind::Chain { first: None, links } => match links.as_slice() {
                [link] if matches!(link.rel, Rel::Eq | Rel::Equiv) => Some(link.clone()),
                _ => None,
            },
            Kind::Text(_) if is_constant(note) => {
                Some(Link { rel: Rel::Eq, rel_span: note.span.clone(), rhs: note.as_ref().clone() })
            }
            _ => None,
        };
        found.extend(relation.map(|link| (body.as_ref().clone(), link)));
    }
    for child in node.children() {
        collect(child, found);
    }
}

/// A side without the cases behind it, and those, where each row of theirs is a relation that continues the side:
/// `a - b \begin{cases} > 0, & x > 1 \\ < 0, & x < 1 \end{cases}`.
pub(super) fn without_cases(side: &Node) -> Option<(Node, &[Vec<Node>])> {
    let Kind::Juxt(factors) = &side.kind else { return None };
    let (last, rest) = factors.split_last()?;
    let Kind::Matrix { env: MatrixEnv::Cases, rows } = &last.kind else { return None };
    let continues = |row: &Vec<Node>| row.first().is_some_and(|cell| relations_of(cell).is_some());
    if !rows.iter().all(continues) {
        return None;
    }
    let end = rest.last()?.span.end;
    let kind = if rest.len() == 1 { rest[0].kind.clone() } else { Kind::Juxt(rest.to_vec()) };
    Some((Node::new(kind, side.span.start..end), rows))
}

/// The relations of a cell that begins with one, a comma behind them passed over.
pub(super) fn relations_of(cell: &Node) -> Option<&[Link]> {
    match &cell.kind {
        Kind::Chain { first: None, links } => Some(links),
        Kind::List(items) => match items.as_slice() {
            [first] => relations_of(first),
            [first, rest] if rest.kind == Kind::Empty => relations_of(first),
            _ => None,
        },
        _ => None,
    }
}

/// Whether a formula names terms of higher order, `\mathcal{O}(x^2)`, among its own.
pub fn has_order_term(node: &Node) -> bool {
    match &node.kind {
        Kind::Sum(terms) => terms.iter().any(|t| is_order_term(&t.node)),
        _ => is_order_term(node),
    }
}

/// A formula without its terms of higher order; `None` where there are none.
pub(super) fn without_order_terms(node: &Node) -> Option<Node> {
    if !has_order_term(node) {
        return None;
    }
    let kept: Vec<Term> = match &node.kind {
        Kind::Sum(terms) => terms.iter().filter(|t| !is_order_term(&t.node)).cloned().collect(),
        _ => Vec::new(),
    };
    let kind = if kept.is_empty() { Kind::Number("0".into()) } else { Kind::Sum(kept) };
    Some(Node::new(kind, node.span.clone()))
}

fn is_order_term(node: &Node) -> bool {
    let Kind::Juxt(factors) = &node.kind else { return false };
    let [letter, of] = factors.as_slice() else { return false };
    let calligraphic = matches!(&letter.kind, Kind::Styled(Font::Calligraphic, body)
        if matches!(&body.kind, Kind::Symbol(s) if s == "O"));
    calligraphic && matches!(of.kind, Kind::Group { open: Delim::Paren, .. })
}
