//! Expressions made anew with other parts.

use super::graph::{Expr, Graph, Node, SymId};

impl Graph {
    /// The expression with symbols replaced, all at once: what is put in is not itself replaced.
    pub fn substitute<S: std::hash::BuildHasher>(
        &mut self,
        e: Expr,
        map: &std::collections::HashMap<SymId, Expr, S>,
    ) -> Expr {
        if self.cut_short().is_some() {
            return e;
        }
        let parts = self.parts(&[e]);
        let mut new: Vec<Expr> = Vec::with_capacity(parts.order().len());
        for &old in parts.order() {
            let replaced = match *self.node(old) {
                Node::Symbol(s) => map.get(&s).copied().unwrap_or(old),
                node => self.rebuild(old, node, |a| parts.position(a).map_or(a, |i| new[i])),
            };
            new.push(replaced);
        }
        new.last().copied().unwrap_or(e)
    }

    /// The node `old` with its operands exchanged.
    fn rebuild(&mut self, old: Expr, node: Node, at: impl Fn(Expr) -> Expr) -> Expr {
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
            Node::Integral(a) => self.integral(at(a)),
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
