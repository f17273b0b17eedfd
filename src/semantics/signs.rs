//! Signs ± within brackets behind a sign ±, `\pm(a \pm b)`: the outer sign is chosen apart from the inner one.

use crate::latex::ast::{Kind, Node, Sign, Term};

use super::statement::{Clause, Side, has_branches};

/// How many signs within each other are chosen apart: there are twice as many formulas for each.
const MOST_LEVELS: usize = 4;

/// The clauses that a clause stands for, in which no ± stands within another one's term. Signs that do not stand within
/// each other are upper ones all, or lower ones.
pub fn independent_signs(clause: &Clause) -> Vec<Clause> {
    let mut clauses = vec![clause.clone()];
    for _ in 0..MOST_LEVELS {
        let nested = |c: &Clause| is_nested(&c.lhs) || matches!(&c.rhs, Side::Node(rhs) if is_nested(rhs));
        if !clauses.iter().any(nested) {
            break;
        }
        clauses = clauses.iter().flat_map(|c| [true, false].map(|upper| with_outer(c, upper))).collect();
    }
    clauses
}

fn with_outer(clause: &Clause, upper: bool) -> Clause {
    let rhs = match &clause.rhs {
        Side::Node(rhs) => Side::Node(outer(rhs, upper)),
        Side::Constant => Side::Constant,
    };
    Clause { lhs: outer(&clause.lhs, upper), rhs, ..clause.clone() }
}

/// Whether a term with ± has a ± within.
fn is_outer(term: &Term) -> bool {
    matches!(term.sign, Sign::PlusMinus | Sign::MinusPlus) && has_branches(&term.node)
}

fn is_nested(node: &Node) -> bool {
    let here = matches!(&node.kind, Kind::Sum(terms) if terms.iter().any(is_outer));
    here || node.children().into_iter().any(is_nested)
}

/// A formula with its outermost nested signs chosen.
fn outer(node: &Node, upper: bool) -> Node {
    let Kind::Sum(terms) = &node.kind else { return node.map_children(&mut |child| outer(child, upper)) };
    let chosen = terms.iter().map(|term| match term.sign {
        Sign::PlusMinus if is_outer(term) => Term { sign: sign(upper), ..term.clone() },
        Sign::MinusPlus if is_outer(term) => Term { sign: sign(!upper), ..term.clone() },
        _ => Term { node: outer(&term.node, upper), ..term.clone() },
    });
    Node::new(Kind::Sum(chosen.collect()), node.span.clone())
}

fn sign(plus: bool) -> Sign {
    if plus { Sign::Plus } else { Sign::Minus }
}

#[cfg(test)]
mod tests {
    use super::super::statement::statement;
    use super::*;

    fn formulas(latex: &str) -> Vec<String> {
        let tree = crate::latex::parse(latex).unwrap();
        let clauses = statement(&tree, None).unwrap().clauses;
        independent_signs(&clauses[0]).iter().map(Clause::latex).collect()
    }

    #[test]
    fn a_sign_around_a_sign_is_chosen_apart() {
        assert_eq!(formulas(r"x = \pm(a \pm b)"), [r"x = +(a \pm b)", r"x = -(a \pm b)"]);
        assert_eq!(formulas(r"x = c \mp(a \pm b)"), [r"x = c - (a \pm b)", r"x = c + (a \pm b)"]);
        assert_eq!(formulas(r"x = \pm a \pm b").len(), 1);
        assert_eq!(formulas(r"x = \pm(a \pm(b \pm c))").len(), 4);
    }

    #[test]
    fn there_is_an_end_to_them() {
        let deep = (0..60).fold("a".to_owned(), |inner, _| format!(r"\pm({inner} + b)"));
        assert_eq!(formulas(&format!("x = {deep}")).len(), 1 << MOST_LEVELS);
    }
}
