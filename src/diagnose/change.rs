//! Changes of a formula: what is put where, with the edits in words and what they cost.

use crate::latex::ast::{Kind, Node};

use super::mutants::replaced_at;

/// Where in a tree, child by child from the root.
pub type Path = Vec<usize>;

/// Some edits of one formula, no one within another.
#[derive(Clone, Debug, Default)]
pub struct Change {
    /// What is put where.
    pub places: Vec<(Path, Node)>,
    /// The edits in words, with LaTeX between backticks.
    pub edits: Vec<String>,
    /// How unlikely they are together: see [`super::likeness`].
    pub cost: u32,
}

impl Change {
    /// One edit in one place.
    pub fn new(path: Path, node: Node, edit: String, cost: u32) -> Self {
        Change { places: vec![(path, node)], edits: vec![edit], cost }
    }

    /// The formula with the change made.
    pub fn made(&self, tree: &Node) -> Node {
        let made = self.places.iter().fold(tree.clone(), |tree, (path, node)| replaced_at(&tree, path, node));
        flat(made)
    }

    /// Both changes; `None` where an edit of one lies within one of the other.
    pub fn and(&self, other: &Change) -> Option<Change> {
        let mut both = self.clone();
        let mut new = false;
        for (path, node) in &other.places {
            if both.places.iter().any(|(p, n)| p == path && n == node) {
                continue;
            }
            if both.places.iter().any(|(p, _)| p.starts_with(path) || path.starts_with(p)) {
                return None;
            }
            both.places.push((path.clone(), node.clone()));
            new = true;
        }
        if new {
            both.edits.extend(other.edits.iter().filter(|e| !self.edits.contains(e)).cloned());
            both.cost += other.cost;
        }
        Some(both)
    }

    /// Whether nothing is changed.
    pub fn is_none(&self) -> bool {
        self.places.is_empty()
    }
}

/// The tree with products within products laid flat, and factors of 1 left out.
pub fn flat(node: Node) -> Node {
    let mut node = node.map_children(&mut |child| flat(child.clone()));
    let is_one = |n: &Node| matches!(&n.kind, Kind::Number(n) if n == "1");
    if let Kind::Juxt(factors) = &node.kind
        && factors.iter().any(|f| matches!(f.kind, Kind::Juxt(_)) || is_one(f))
    {
        let parts = factors.iter().flat_map(|f| match &f.kind {
            Kind::Juxt(inner) => inner.clone(),
            _ => vec![f.clone()],
        });
        let (ones, rest): (Vec<Node>, Vec<Node>) = parts.partition(is_one);
        node.kind = match rest.as_slice() {
            [] => return ones.into_iter().next().unwrap_or(node),
            [only] => only.kind.clone(),
            _ => Kind::Juxt(rest),
        };
    }
    node
}

/// The node at a path.
pub fn at<'n>(tree: &'n Node, path: &[usize]) -> Option<&'n Node> {
    path.iter().try_fold(tree, |node, k| node.children().get(*k).copied())
}

/// Where a node stands in a tree, not among the places that were taken before.
pub fn find(tree: &Node, node: &Node, taken: &mut Vec<Path>) -> Option<Path> {
    fn search(tree: &Node, node: &Node, path: &mut Path, taken: &[Path]) -> bool {
        if tree == node && !taken.contains(path) {
            return true;
        }
        for (k, child) in tree.children().into_iter().enumerate() {
            path.push(k);
            if search(child, node, path, taken) {
                return true;
            }
            path.pop();
        }
        false
    }
    let mut path = Vec::new();
    search(tree, node, &mut path, taken).then(|| {
        taken.push(path.clone());
        path
    })
}
