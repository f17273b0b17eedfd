//! Wider edits of what should be an identity: a symbol of the formula in the place of another one, a factor or a term
//! that is lost. That one of them makes an identity of a long formula is no chance; of a short one it may be, and on
//! premises it often is, so that these are tried without any.

use crate::diagnose::Edited;
use crate::latex::ast::{Delim, Kind, Node, Sign, Term};
use crate::latex::to_latex;
use crate::semantics::{Scope, pattern_of};

use super::evidence::is_name;

/// How many symbols a formula has at least.
const SYMBOLS: usize = 8;
/// What these edits cost: see [`crate::diagnose::Edited`].
const COST: u32 = 7;
/// The most formulas that are made.
const MOST: usize = 1200;

/// The formulas that are one wider edit away; none for a short formula.
pub fn swaps(tree: &Node, scope: &Scope) -> Vec<Edited> {
    let mut places = Vec::new();
    visit(tree, scope, &mut Vec::new(), &mut places);
    let names: Vec<&(Vec<usize>, Node)> = places.iter().filter(|(_, node)| is_declared(node, scope)).collect();
    if names.len() < SYMBOLS {
        return Vec::new();
    }
    let mut distinct: Vec<&Node> = Vec::new();
    for (_, name) in &names {
        if distinct.iter().all(|other| to_latex(other) != to_latex(name)) {
            distinct.push(name);
        }
    }
    let mut found = Vec::new();
    for (path, node) in &places {
        for name in &distinct {
            found.extend(edits(node, name, scope).into_iter().map(|(new, edit)| Edited {
                tree: put(tree, path, &new),
                edit,
                cost: COST,
            }));
            if found.len() >= MOST {
                return found;
            }
        }
    }
    found
}

/// What may have stood in the place of a node.
fn edits(node: &Node, name: &Node, scope: &Scope) -> Vec<(Node, String)> {
    let (own, other) = (to_latex(node), to_latex(name));
    if is_declared(node, scope) && own != other {
        return vec![(name.clone(), format!("`{own}` changed to `{other}`"))];
    }
    match &node.kind {
        Kind::Juxt(factors) => {
            let factors = factors.iter().chain([name]).cloned().collect();
            vec![(
                Node::new(Kind::Juxt(factors), node.span.clone()),
                format!("the factor `{other}` put behind `{own}`"),
            )]
        }
        Kind::Group { open: Delim::Paren, close, body } if !matches!(body.kind, Kind::Chain { .. } | Kind::List(_)) => {
            let first = match &body.kind {
                Kind::Sum(terms) => terms.clone(),
                _ => vec![Term { sign: Sign::Plus, sign_span: None, node: (**body).clone() }],
            };
            let with = |sign: Sign, symbol: &str| {
                let mut terms = first.clone();
                terms.push(Term { sign, sign_span: None, node: name.clone() });
                let body = Box::new(Node::new(Kind::Sum(terms), body.span.clone()));
                let kind = Kind::Group { open: Delim::Paren, close: *close, body };
                (Node::new(kind, node.span.clone()), format!("the term `{symbol} {other}` put into `{own}`"))
            };
            let factor = Node::new(Kind::Juxt(vec![node.clone(), name.clone()]), node.span.clone());
            let factor = (factor, format!("the factor `{other}` put behind `{own}`"));
            vec![factor, with(Sign::Plus, "+"), with(Sign::Minus, "-")]
        }
        _ => Vec::new(),
    }
}

fn is_declared(node: &Node, scope: &Scope) -> bool {
    is_name(node) && scope.get(&pattern_of(scope, node)).is_some()
}

/// The symbols, products and brackets of a formula with their places; the depth is bounded by the parser's.
fn visit(node: &Node, scope: &Scope, path: &mut Vec<usize>, found: &mut Vec<(Vec<usize>, Node)>) {
    let declared = is_declared(node, scope);
    if declared || matches!(node.kind, Kind::Juxt(_) | Kind::Group { .. }) {
        found.push((path.clone(), node.clone()));
    }
    if declared {
        return;
    }
    for (k, child) in node.children().into_iter().enumerate() {
        path.push(k);
        visit(child, scope, path, found);
        path.pop();
    }
}

/// The tree with the node at a path exchanged.
fn put(node: &Node, path: &[usize], new: &Node) -> Node {
    let Some((first, rest)) = path.split_first() else { return new.clone() };
    let mut at = 0;
    node.map_children(&mut |child| {
        let here = at == *first;
        at += 1;
        if here { put(child, rest, new) } else { child.clone() }
    })
}
