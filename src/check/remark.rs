//! Remarks: relations that say nothing which could be evaluated, so that `kind = "statement"` is right for them.

use crate::latex::ast::{Delim, Kind, Node, Rel};
use crate::semantics::{Clause, Side, spelling};

/// Whether a clause says only what becomes of what (`x \to x'`), what is small against what, or what something depends on,
/// `S = S(x, y)`.
pub fn is_remark(clause: &Clause) -> bool {
    match clause.rel {
        Rel::To | Rel::From | Rel::Exchange | Rel::Ll | Rel::Gg | Rel::In => true,
        Rel::Eq | Rel::Equiv => matches!(&clause.rhs, Side::Node(rhs) if names_arguments(&clause.lhs, rhs)),
        _ => false,
    }
}

/// Whether a side is a name with several arguments in brackets behind it.
fn names_arguments(name: &Node, side: &Node) -> bool {
    let Kind::Juxt(factors) = &side.kind else { return false };
    let [head, Node { kind: Kind::Group { open: Delim::Paren, body, .. }, .. }] = factors.as_slice() else {
        return false;
    };
    matches!(body.kind, Kind::List(_)) && !spelling(name).is_empty() && spelling(name) == spelling(head)
}

#[cfg(test)]
mod tests {
    use super::is_remark;

    fn remarks(latex: &str) -> Vec<bool> {
        let tree = crate::latex::parse(latex).unwrap();
        crate::semantics::statement(&tree, None).unwrap().clauses.iter().map(is_remark).collect()
    }

    #[test]
    fn what_can_be_evaluated_is_no_remark() {
        assert_eq!(remarks(r"S_1 = S_1(x', y'; k)"), [true]);
        assert_eq!(remarks(r"a \ll b, \quad a = 2b"), [true, false]);
        assert_eq!(remarks("S = S(x)"), [false]);
        assert_eq!(remarks("S = T(x, y)"), [false]);
    }
}
