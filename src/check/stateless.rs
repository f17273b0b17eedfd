//! What stands beside an equation without a relation: a remark, or a part that nothing is said about.

use crate::latex::ast::{Kind, Node};
use crate::latex::to_latex;
use crate::semantics::{self, Scope};

use super::claim::Source;
use super::trouble;
use super::verdict::LinkJudgement;

/// Whether a formula beside an equation is a remark: a name or a number, alone or among words.
pub fn is_remark(scope: &Scope, node: &Node) -> bool {
    let remark = |node: &Node| is_remark(scope, node);
    match &node.kind {
        Kind::Text(_) | Kind::Empty | Kind::Number(_) | Kind::Symbol(_) | Kind::Function(_) => true,
        Kind::Styled(_, body) | Kind::Accent(_, body) | Kind::Dots(_, body) => remark(body),
        Kind::Scripts { base: body, .. } | Kind::Group { body, .. } => remark(body),
        Kind::List(items) => items.iter().all(remark),
        Kind::Juxt(factors) => {
            let named = scope.get(&semantics::pattern_of(scope, node)).is_some();
            named || factors.iter().any(|f| matches!(f.kind, Kind::Text(_))) && factors.iter().all(remark)
        }
        _ => false,
    }
}

/// A row or an item of an equation without a relation: either the print has lost one, or it is no part of it.
pub fn undecided(source: &Source, bare: &Node) -> LinkJudgement {
    let entry = &source.book.entries[source.index];
    let reason = "no relation stands in this part: nothing is said about it";
    let problem = trouble::part(entry, source.version, &bare.span, reason);
    LinkJudgement { reason: Some(reason.into()), problem: Some(problem), ..LinkJudgement::unjudged(to_latex(bare)) }
}
