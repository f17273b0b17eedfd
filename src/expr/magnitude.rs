//! How large the terms are that an expression is made of.

use super::graph::{Expr, Graph, Node};
use crate::number::Func;

impl Graph {
    /// The sum of the magnitudes of the terms that an expression has when its products are multiplied out: what its
    /// rounding errors and its cancellation are measured by.
    pub fn magnitude(&mut self, e: Expr) -> Expr {
        if self.cut_short().is_some() {
            return e;
        }
        let parts = self.parts(&[e]);
        let mut sizes: Vec<Expr> = Vec::with_capacity(parts.order().len());
        for &x in parts.order() {
            let of = |y: Expr| parts.position(y).map_or(y, |i| sizes[i]);
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
            sizes.push(size);
        }
        sizes.last().copied().unwrap_or(e)
    }
}
