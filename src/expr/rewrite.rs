//! What expressions are made of, and expressions made anew with other parts.

use super::graph::{Expr, Graph, Node, SymId};
use rustc_hash::{FxHashMap as HashMap, FxHashSet as HashSet};
use std::collections::BTreeSet;

impl Graph {
    /// Everything the expressions are made of, themselves included, operands first.
    pub fn reachable(&self, es: &[Expr]) -> Vec<Expr> {
        let mut seen: HashSet<Expr> = es.iter().copied().collect();
        let mut order: Vec<Expr> = seen.iter().copied().collect();
        let mut next = 0;
        while let Some(&e) = order.get(next) {
            next += 1;
            order.extend(self.node(e).operands().filter(|&a| seen.insert(a)));
        }
        order.sort_unstable();
        order
    }

    /// The symbols that occur in the expressions.
    pub fn symbols(&self, es: &[Expr]) -> BTreeSet<SymId> {
        let symbol = |e: Expr| match *self.node(e) {
            Node::Symbol(s) => Some(s),
            _ => None,
        };
        self.reachable(es).into_iter().filter_map(symbol).collect()
    }

    /// The expression with symbols replaced, all at once: what is put in is not itself replaced.
    pub fn substitute<S: std::hash::BuildHasher>(
        &mut self,
        e: Expr,
        map: &std::collections::HashMap<SymId, Expr, S>,
    ) -> Expr {
        if self.cut_short().is_some() {
            return e;
        }
        let mut new: HashMap<Expr, Expr> = HashMap::default();
        for old in self.reachable(&[e]) {
            let replaced = match *self.node(old) {
                Node::Symbol(s) => map.get(&s).copied().unwrap_or(old),
                node => self.rebuild(old, node, &new),
            };
            new.insert(old, replaced);
        }
        new.get(&e).copied().unwrap_or(e)
    }

    /// The node `old` with its operands exchanged.
    fn rebuild(&mut self, old: Expr, node: Node, new: &HashMap<Expr, Expr>) -> Expr {
        let at = |a: Expr| new.get(&a).copied().unwrap_or(a);
        if node.operands().all(|a| at(a) == a) {
            return old;
        }
        match node {
            Node::Rational(..) | Node::Pi | Node::E | Node::Symbol(_) => old,
            Node::Neg(a) => self.neg(at(a)),
            Node::Add(a, b) => self.add(at(a), at(b)),
            Node::Sub(a, b) => self.sub(at(a), at(b)),
            Node::Mul(a, b) => self.mul(at(a), at(b)),
            Node::Div(a, b) => self.div(at(a), at(b)),
            Node::PowI(a, n) => self.powi(at(a), n),
            Node::Pow(a, b) => self.pow(at(a), at(b)),
            Node::Sqrt(a) => self.sqrt(at(a)),
            Node::Call(f, a) => self.call(f, at(a)),
            Node::Atan2(a, b) => self.atan2(at(a), at(b)),
            Node::Elliptic(f, x) => self.elliptic(f, &x.map(at)),
        }
    }

    /// The terms of a sum with their signs (`true`: subtracted), through sums, differences and negations, in order.
    ///
    /// A sum that shares its parts can have exponentially many terms: past a million, the rest is left together.
    pub fn terms(&self, e: Expr) -> Vec<(bool, Expr)> {
        const LIMIT: usize = 1 << 20;
        let mut terms = Vec::new();
        let mut stack = vec![(false, e)];
        while let Some((negative, e)) = stack.pop() {
            match *self.node(e) {
                _ if terms.len() >= LIMIT => terms.push((negative, e)),
                Node::Add(a, b) => stack.extend([(negative, b), (negative, a)]),
                Node::Sub(a, b) => stack.extend([(!negative, b), (negative, a)]),
                Node::Neg(a) => stack.push((!negative, a)),
                _ => terms.push((negative, e)),
            }
        }
        terms
    }
}
