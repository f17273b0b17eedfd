//! Elliptic functions in graphs: construction and derivatives.

use super::graph::{Expr, Graph, Node};
use crate::number::Func;
use crate::number::elliptic::{Elliptic, MOST_ARGUMENTS, Rules, slope};

/// The positions of a function's own arguments.
const POSITIONS: [usize; MOST_ARGUMENTS] = [0, 1, 2, 3];

impl Graph {
    /// An elliptic function or integral of as many operands as it has; those that are missing are the last one again,
    /// or zero. Folded at the argument 0 and, where elementary functions remain, at the moduli 0 and 1.
    pub fn elliptic(&mut self, f: Elliptic, x: &[Expr]) -> Expr {
        let zero = self.int(0);
        let last = x.get(..f.arity()).unwrap_or(x).last().copied().unwrap_or(zero);
        let operands = POSITIONS.map(|i| if i < f.arity() { x.get(i).copied().unwrap_or(last) } else { last });
        self.elementary(f, &operands).unwrap_or_else(|| self.intern(Node::Elliptic(f, operands)))
    }

    /// The value where it is elementary.
    fn elementary(&mut self, f: Elliptic, x: &[Expr; MOST_ARGUMENTS]) -> Option<Expr> {
        use Elliptic::*;
        let modulus = f.modulus().and_then(|i| self.as_rational(x[i]));
        if f.modulus().is_some() && f.arity() > 1 && f != CompletePi && self.is_zero(x[0]) {
            return Some(self.int(i64::from(matches!(f, Cn | Dn))));
        }
        let u = x[0];
        Some(match (f, modulus?) {
            (Sn, (0, _)) => self.call(Func::Sin, u),
            (Cn, (0, _)) => self.call(Func::Cos, u),
            (Dn, (0, _)) => self.int(1),
            (Am | IncompleteF | IncompleteE, (0, _)) => u,
            (CompleteK | CompleteE, (0, _)) => {
                let (pi, two) = (self.pi(), self.int(2));
                self.div(pi, two)
            }
            (Sn, (1, 1)) => self.call(Func::Tanh, u),
            (Cn | Dn, (1, 1)) => {
                let (one, cosh) = (self.int(1), self.call(Func::Cosh, u));
                self.div(one, cosh)
            }
            (CompleteE, (1, 1)) => self.int(1),
            _ => return None,
        })
    }

    /// The derivative of f(x), whose operands have these derivatives.
    pub(super) fn elliptic_rate(&mut self, f: Elliptic, x: &[Expr; MOST_ARGUMENTS], rates: &[Expr]) -> Expr {
        let mut total = self.int(0);
        for (i, &rate) in rates.iter().enumerate().take(f.arity()) {
            if self.is_zero(rate) {
                continue;
            }
            let slope = slope(&mut OnGraph { graph: self, x }, f, &POSITIONS[..f.arity()], i);
            let term = self.mul(slope, rate);
            total = self.add(total, term);
        }
        total
    }
}

/// Derivatives as expressions.
struct OnGraph<'g> {
    graph: &'g mut Graph,
    x: &'g [Expr; MOST_ARGUMENTS],
}

impl Rules for OnGraph<'_> {
    type Value = Expr;
    fn argument(&mut self, i: usize) -> Expr {
        self.x[i.min(MOST_ARGUMENTS - 1)]
    }
    fn related(&mut self, f: Elliptic, of: &[usize]) -> Expr {
        let x: Vec<Expr> = of.iter().map(|&i| self.argument(i)).collect();
        self.graph.elliptic(f, &x)
    }
    fn int(&mut self, n: i32) -> Expr {
        self.graph.int(n.into())
    }
    fn add(&mut self, a: &Expr, b: &Expr) -> Expr {
        self.graph.add(*a, *b)
    }
    fn sub(&mut self, a: &Expr, b: &Expr) -> Expr {
        self.graph.sub(*a, *b)
    }
    fn mul(&mut self, a: &Expr, b: &Expr) -> Expr {
        self.graph.mul(*a, *b)
    }
    fn div(&mut self, a: &Expr, b: &Expr) -> Expr {
        self.graph.div(*a, *b)
    }
    fn sqrt(&mut self, a: &Expr) -> Expr {
        self.graph.sqrt(*a)
    }
    fn sin_cos(&mut self, a: &Expr) -> (Expr, Expr) {
        (self.graph.call(Func::Sin, *a), self.graph.call(Func::Cos, *a))
    }
}
