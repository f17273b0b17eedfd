//! How large the terms are that an expression is made of.

use std::collections::BTreeMap;

use super::graph::{Expr, Graph, Node};
use crate::number::Func;

impl Graph {
    /// The sum of the magnitudes of the terms that an expression has when its products are multiplied out: what its
    /// rounding errors and its cancellation are measured by.
    pub fn magnitude(&mut self, e: Expr) -> Expr {
        if self.cut_short().is_some() {
            return e;
        }
        let mut sizes: BTreeMap<Expr, Expr> = BTreeMap::new();
        // Operands stand before what they are used in.
        for x in self.reachable(&[e]) {
            let of = |y: Expr| sizes.get(&y).copied().unwrap_or(y);
            let size = match *self.node(x) {
                Node::Add(a, b) | Node::Sub(a, b) => self.add(of(a), of(b)),
                Node::Mul(a, b) => self.mul(of(a), of(b)),
                Node::Div(a, b) => {
                    let divisor = self.call(Func::Abs, b);
                    self.div(of(a), divisor)
                }
                Node::Neg(a) => of(a),
                _ => self.call(Func::Abs, x),
            };
            sizes.insert(x, size);
        }
        sizes.get(&e).copied().unwrap_or(e)
    }
}
