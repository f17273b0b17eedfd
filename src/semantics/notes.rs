//! What an author notes beside a formula: relations at braces.

use crate::latex::ast::{Kind, Link, Node, Rel};

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
