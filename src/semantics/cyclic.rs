//! Cyclic sums: `\sum_{i,j,k} (B - C) \omega_2 \omega_3 i` stands for its term and the two that are made of it by taking
//! i for j, j for k, k for i, and likewise all that are declared to go round with them.
//!
//! ```toml
//! cyclic = ['i, j, k', 'A, B, C', '\omega_1, \omega_2, \omega_3']
//! ```
//! A sum is cyclic where one of these triples stands below it, or nothing and no index of the section stands behind it.

use crate::latex::ast::{Kind, Node, Span};

use super::elaborate::{Elaborator, Typed};
use super::error::Result;
use super::juxtaposition::Item;
use super::name::spelling;
use super::scope::Scope;
use super::value;

impl Elaborator<'_> {
    /// The sum, if it is a cyclic one.
    pub(super) fn cyclic_sum(&mut self, sub: Option<&Node>, rest: &[Item], span: &Span) -> Result<Option<Typed>> {
        let cyclic = match sub {
            Some(Node { kind: Kind::List(letters), .. }) => is_triple(self.scope, letters),
            Some(_) => false,
            None => !self.scope.cyclic.is_empty() && self.unbound_indices(rest).is_empty(),
        };
        if !cyclic {
            return Ok(None);
        }
        let mut total = self.items(rest)?;
        for by in 1..3 {
            let turned: Vec<Option<Node>> = rest
                .iter()
                .map(|item| match item {
                    Item::Factor(node) => Some(turned(self.scope, node, by)),
                    Item::Op(..) => None,
                })
                .collect();
            let items: Vec<Item> = rest
                .iter()
                .zip(&turned)
                .map(|(item, turned)| match (item, turned) {
                    (_, Some(node)) => Item::Factor(node),
                    (Item::Factor(node), None) => Item::Factor(node),
                    (Item::Op(op, span), None) => Item::Op(*op, span),
                })
                .collect();
            let term = self.items(&items)?;
            let sum = value::add(&mut self.world.graph, &total.value, &term.value, false, span)?;
            total = Typed::new(sum, total.text);
        }
        Ok(Some(Typed::new(total.value, format!("Σ_cyclic({})", total.text))))
    }
}

fn is_triple(scope: &Scope, letters: &[Node]) -> bool {
    let names: Vec<String> = letters.iter().map(spelling).collect();
    scope.cyclic.iter().any(|triple| triple.iter().map(spelling).eq(names.iter().cloned()))
}

/// A formula with each name of a triple replaced by the one so many places on.
fn turned(scope: &Scope, node: &Node, by: usize) -> Node {
    if let Some(next) = next(scope, node, by) {
        return next;
    }
    if let Kind::Scripts { base, primes, sub: sub @ Some(_), sup: Some(sup) } = &node.kind {
        // In `\omega_1^2` stands `\omega_1`.
        let bare = Kind::Scripts { base: base.clone(), primes: *primes, sub: sub.clone(), sup: None };
        if let Some(next) = next(scope, &Node::new(bare, node.span.clone()), by) {
            let sup = Some(Box::new(turned(scope, sup, by)));
            return Node::new(Kind::Scripts { base: Box::new(next), primes: 0, sub: None, sup }, node.span.clone());
        }
    }
    if let Kind::Scripts { base, primes, sub, sup: None } = &node.kind
        && let Kind::Dots(dots, letter) = &base.kind
    {
        // In `\dot{\omega}_1` as well.
        let bare = Kind::Scripts { base: letter.clone(), primes: *primes, sub: sub.clone(), sup: None };
        if let Some(next) = next(scope, &Node::new(bare, node.span.clone()), by) {
            return Node::new(Kind::Dots(*dots, Box::new(next)), node.span.clone());
        }
    }
    node.map_children(&mut |child| turned(scope, child, by))
}

fn next(scope: &Scope, node: &Node, by: usize) -> Option<Node> {
    let name = spelling(node);
    let (triple, at) = scope.cyclic.iter().find_map(|triple| {
        let at = triple.iter().position(|n| !name.is_empty() && spelling(n) == name)?;
        Some((triple, at))
    })?;
    let mut next = triple[(at + by) % 3].clone();
    next.span = node.span.clone();
    Some(next)
}

#[cfg(test)]
mod tests {
    use std::collections::HashMap;

    use super::super::World;
    use super::super::testing::{scope, value};

    const DECLARED: &str =
        "cyclic = ['a, b, c', 'x_1, x_2, x_3']\n[symbols]\n'a, b, c, d, x_1, x_2, x_3' = { range = [0.5, 2.0] }\n";

    fn same(sum: &str, written: &str) -> bool {
        let (mut world, scope) = (World::new(), scope(DECLARED));
        let difference = value(&mut world, &scope, &format!("{sum} - ({written})")).unwrap();
        let [e] = difference.components()[..] else { panic!("a number") };
        let points = [[2, 3, 5, 7, 11, 13, 17], [1, -4, 9, 2, 6, 5, -3]];
        points.iter().all(|point| {
            let names = ["a", "b", "c", "d", "x_{1}", "x_{2}", "x_{3}"];
            let values = names.iter().zip(point).filter_map(|(name, v)| Some((world.graph.find(name)?, *v)));
            let values: Vec<_> = values.collect();
            let map: HashMap<_, _> = values.into_iter().map(|(s, v)| (s, world.graph.int(v))).collect();
            let at = world.graph.substitute(e, &map);
            world.graph.is_zero(at)
        })
    }

    #[test]
    fn names_go_round_together() {
        let written = "(a - b) d x_3^2 + (b - c) d x_1^2 + (c - a) d x_2^2";
        assert!(same(r"\sum_{a,b,c} (a - b) d x_3^2", written));
        assert!(same(r"\sum (a - b) d x_3^2", written));
        assert!(!same(r"\sum_{a,b,c} (a - b) d x_2^2", written));
    }

    #[test]
    fn other_letters_below_make_no_cyclic_sum() {
        let (mut world, scope) = (World::new(), scope(DECLARED));
        assert!(value(&mut world, &scope, r"\sum_{b,a,c} a").is_err());
        assert!(value(&mut world, &scope, r"\sum_{d} a").is_err());
    }
}
