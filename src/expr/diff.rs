//! Calculus on the graph: partial derivatives and the derivative with respect to time.
//!
//! Both are one forward pass over the shared nodes, so that the work and the nodes added are linear in their number.

use super::graph::{Expr, Graph, Node, SymId};
use crate::number::Func;

impl Graph {
    /// The partial derivative with respect to a symbol; all other symbols are held fixed.
    pub fn diff(&mut self, e: Expr, s: SymId) -> Expr {
        self.derivatives(&[e], s)[0]
    }

    /// The partial derivatives of several expressions with respect to one symbol.
    pub fn derivatives(&mut self, es: &[Expr], s: SymId) -> Vec<Expr> {
        self.differentiate(es, |graph, symbol| graph.int(i64::from(symbol == s)))
    }

    /// The partial derivatives of an expression with respect to each symbol.
    pub fn gradient(&mut self, e: Expr, symbols: &[SymId]) -> Vec<Expr> {
        symbols.iter().map(|&s| self.diff(e, s)).collect()
    }

    /// The matrix of partial derivatives: one row for each expression, one column for each symbol.
    pub fn jacobian(&mut self, es: &[Expr], symbols: &[SymId]) -> Vec<Vec<Expr>> {
        let columns: Vec<_> = symbols.iter().map(|&s| self.derivatives(es, s)).collect();
        (0..es.len()).map(|row| columns.iter().map(|column| column[row]).collect()).collect()
    }

    /// The derivative with respect to time: the chain rule over every symbol that depends on time, whose derivatives
    /// are the symbols that [`Graph::derivative_symbol`] gives, and over the symbol `t` of time itself.
    pub fn time_derivative(&mut self, e: Expr, t: Option<SymId>) -> Expr {
        self.differentiate(&[e], |graph, s| {
            if Some(s) == t {
                graph.int(1)
            } else if graph.info(s).of_t {
                let rate = graph.derivative_symbol(s);
                graph.sym(rate)
            } else {
                graph.int(0)
            }
        })[0]
    }

    /// The derivatives along the direction in which each symbol moves by `rate`.
    fn differentiate(&mut self, es: &[Expr], mut rate: impl FnMut(&mut Graph, SymId) -> Expr) -> Vec<Expr> {
        let zero = self.int(0);
        if self.cut_short().is_some() {
            return vec![zero; es.len()];
        }
        let parts = self.parts(es);
        let mut d: Vec<Expr> = Vec::with_capacity(parts.order().len());
        let of = |d: &[Expr], a: Expr| parts.position(a).and_then(|i| d.get(i).copied()).unwrap_or(zero);
        for &e in parts.order() {
            let node = *self.node(e);
            let derivative = match node {
                Node::Symbol(s) => rate(self, s),
                _ if node.operands().all(|a| of(&d, a) == zero) => zero,
                Node::Elliptic(f, x) => {
                    let rates = x.map(|a| of(&d, a));
                    self.elliptic_rate(f, &x, &rates)
                }
                _ => {
                    let mut rates = node.operands().map(|a| of(&d, a));
                    let (da, db) = (rates.next().unwrap_or(zero), rates.next().unwrap_or(zero));
                    self.chain_rule(e, node, da, db)
                }
            };
            d.push(derivative);
        }
        es.iter().map(|e| of(&d, *e)).collect()
    }

    /// The derivative of `e`, whose operands have the derivatives `da` and `db`, not both zero.
    fn chain_rule(&mut self, e: Expr, node: Node, da: Expr, db: Expr) -> Expr {
        match node {
            // Elliptic functions have rules of their own.
            Node::Rational(..) | Node::Pi | Node::E | Node::Symbol(_) | Node::Elliptic(..) => self.int(0),
            Node::Neg(_) => self.neg(da),
            // The limits are within the integrand, so that this is Leibniz's rule.
            Node::Integral(_) => self.integral(da),
            Node::Add(..) => self.add(da, db),
            Node::Sub(..) => self.sub(da, db),
            Node::Mul(a, b) => {
                let (left, right) = (self.mul(da, b), self.mul(a, db));
                self.add(left, right)
            }
            Node::Div(_, b) => {
                // (a/b)' = (a' - (a/b) b') / b
                let moved = self.mul(e, db);
                let numerator = self.sub(da, moved);
                self.div(numerator, b)
            }
            Node::PowI(a, n) => {
                let power = match n.checked_sub(1) {
                    Some(less) => self.powi(a, less),
                    None => self.div(e, a),
                };
                let n = self.int(n.into());
                let outer = self.mul(n, power);
                self.mul(outer, da)
            }
            Node::Pow(a, b) => self.power_rule(e, (a, da), (b, db)),
            Node::Sqrt(_) => {
                let two = self.int(2);
                let twice = self.mul(two, e);
                self.div(da, twice)
            }
            Node::Call(f, a) => self.outer_derivative(f, e, a, da),
            Node::Atan2(y, x) => {
                // (x y' - y x') / (x² + y²)
                let (xx, yy) = (self.powi(x, 2), self.powi(y, 2));
                let (forward, back) = (self.mul(x, da), self.mul(y, db));
                let (numerator, denominator) = (self.sub(forward, back), self.add(xx, yy));
                self.div(numerator, denominator)
            }
        }
    }

    /// (aᵇ)' = b aᵇ⁻¹ a' + aᵇ ln a b'.
    fn power_rule(&mut self, e: Expr, (a, da): (Expr, Expr), (b, db): (Expr, Expr)) -> Expr {
        let base = if self.is_zero(da) {
            da
        } else {
            let one = self.int(1);
            let less = self.sub(b, one);
            let power = self.pow(a, less);
            let outer = self.mul(b, power);
            self.mul(outer, da)
        };
        let exponent = if self.is_zero(db) {
            db
        } else {
            let ln = self.call(Func::Ln, a);
            let outer = self.mul(e, ln);
            self.mul(outer, db)
        };
        self.add(base, exponent)
    }

    /// f'(a) a' for `e` = f(a).
    fn outer_derivative(&mut self, f: Func, e: Expr, a: Expr, da: Expr) -> Expr {
        let one = self.int(1);
        match f {
            Func::Sin => {
                let cos = self.call(Func::Cos, a);
                self.mul(cos, da)
            }
            Func::Cos => {
                let sin = self.call(Func::Sin, a);
                let product = self.mul(sin, da);
                self.neg(product)
            }
            Func::Tan => {
                let square = self.powi(e, 2);
                let outer = self.add(one, square);
                self.mul(outer, da)
            }
            Func::Sinh => {
                let cosh = self.call(Func::Cosh, a);
                self.mul(cosh, da)
            }
            Func::Cosh => {
                let sinh = self.call(Func::Sinh, a);
                self.mul(sinh, da)
            }
            Func::Tanh => {
                let square = self.powi(e, 2);
                let outer = self.sub(one, square);
                self.mul(outer, da)
            }
            Func::Exp => self.mul(e, da),
            Func::Ln => self.div(da, a),
            Func::Abs => {
                let sign = self.call(Func::Sign, a);
                self.mul(sign, da)
            }
            Func::Sign => self.int(0),
            Func::Asin | Func::Acos | Func::Atan | Func::Asinh | Func::Acosh | Func::Atanh => {
                let square = self.powi(a, 2);
                let polynomial = match f {
                    Func::Atan | Func::Asinh => self.add(one, square),
                    Func::Acosh => self.sub(square, one),
                    _ => self.sub(one, square),
                };
                let denominator = match f {
                    Func::Atan | Func::Atanh => polynomial,
                    _ => self.sqrt(polynomial),
                };
                let quotient = self.div(da, denominator);
                if f == Func::Acos { self.neg(quotient) } else { quotient }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rules_by_hand() {
        let mut g = Graph::new();
        let (x, y) = (g.symbol("x"), g.symbol("y"));
        let (ex, ey) = (g.sym(x), g.sym(y));
        let product = g.mul(ex, ey);
        assert_eq!(g.diff(product, x), ey);
        let cube = g.powi(ex, 3);
        let d = g.diff(cube, x);
        assert_eq!(g.display(d), "(x^2 * 3)");
        let sin = g.call(Func::Sin, product);
        let d = g.diff(sin, y);
        assert_eq!(g.display(d), "(x * cos((x * y)))");
        let z = g.symbol("z");
        let d = g.diff(sin, z);
        assert!(g.is_zero(d));
        let jacobian = g.jacobian(&[product, cube], &[x, y]);
        assert_eq!(jacobian.len(), 2);
        assert_eq!(jacobian[0], vec![ey, ex]);
        assert!(g.is_zero(jacobian[1][1]));
    }

    #[test]
    fn time() {
        let mut g = Graph::new();
        let (theta, m, t) = (g.time_symbol("\\theta"), g.symbol("m"), g.symbol("t"));
        let (e, em, et) = (g.sym(theta), g.sym(m), g.sym(t));
        let product = g.product([em, e, et]);
        let d = g.time_derivative(product, Some(t));
        let dot = g.find("\\dot{\\theta}").unwrap();
        assert_eq!(g.info(dot).base, theta);
        assert_eq!(g.symbols(&[d]), [theta, m, t, dot].into());
        let d = g.time_derivative(product, None);
        assert_eq!(g.symbols(&[d]), [m, t, dot].into());
        let d = g.time_derivative(em, Some(t));
        assert!(g.is_zero(d));
    }

    #[test]
    fn shared_nodes_are_differentiated_once() {
        let mut g = Graph::new();
        let x = g.symbol("x");
        let mut e = g.sym(x);
        for _ in 0..1000 {
            let sin = g.call(Func::Sin, e);
            e = g.mul(sin, e); // a tree of 2^1000 leaves
        }
        let before = g.len();
        g.diff(e, x);
        assert!(g.len() < 8 * before, "{} nodes of {before}", g.len());
    }
}
