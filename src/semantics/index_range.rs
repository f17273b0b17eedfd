//! `j = 1, 2` behind an equation: what an index runs through, printed as a list of its values.

use std::borrow::Cow;

use crate::latex::ast::{Kind, Link, Node, Rel};

use super::name::spelling;
use super::scope::Scope;

/// A formula without the lists of index values that agree with what is declared; others are kept, and judged.
pub fn without_index_ranges<'n>(node: &'n Node, scope: &Scope) -> Cow<'n, Node> {
    let Kind::List(items) = &node.kind else { return Cow::Borrowed(node) };
    let mut kept = Vec::new();
    let mut k = 0;
    while let Some(item) = items.get(k) {
        match range(&items[k..], scope) {
            Some(used) if !kept.is_empty() => k += used,
            _ => {
                kept.push(item.clone());
                k += 1;
            }
        }
    }
    match kept.len() {
        n if n == items.len() => Cow::Borrowed(node),
        1 => Cow::Owned(kept.swap_remove(0)),
        _ => Cow::Owned(Node::new(Kind::List(kept), node.span.clone())),
    }
}

/// How many items at the beginning print the values of an index, `j = 1` and `2`, where these are all it is declared to
/// have.
fn range(items: &[Node], scope: &Scope) -> Option<usize> {
    let Kind::Chain { first: Some(letter), links } = &items.first()?.kind else { return None };
    let [Link { rel: Rel::Eq, rhs, .. }] = links.as_slice() else { return None };
    let letter = spelling(letter);
    let (from, to) = scope.index(&letter)?;
    let step = scope.get(&letter)?.step;
    let mut printed = vec![number(rhs)?];
    printed.extend(items[1..].iter().map_while(number));
    (from..=to).step_by(step).eq(printed.iter().copied()).then_some(printed.len())
}

fn number(node: &Node) -> Option<i64> {
    match &node.kind {
        Kind::Number(digits) => digits.parse().ok(),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::latex::{parse, to_latex};
    use crate::semantics::testing::scope;

    fn left(latex: &str) -> String {
        to_latex(&without_index_ranges(
            &parse(latex).unwrap(),
            &scope("[symbols]\n'j' = { index = [1, 2] }\n'x_j' = {}"),
        ))
    }

    #[test]
    fn values_as_declared_are_dropped() {
        assert_eq!(left(r"x_j = a \quad j = 1, 2"), to_latex(&parse("x_j = a").unwrap()));
        assert_eq!(
            left(r"\left. \begin{aligned} x_j &= a \\ y_j &= b \end{aligned} \right\} \quad j = 1, 2, \quad c = d")
                .matches('=')
                .count(),
            3
        );
    }

    #[test]
    fn other_values_are_kept() {
        for latex in [r"x_j = a \quad j = 1, 3", r"x_j = a \quad j = 1", r"x_j = a \quad k = 1, 2", "j = 1, 2"] {
            assert_eq!(left(latex), to_latex(&parse(latex).unwrap()), "{latex}");
        }
    }
}
