//! Definite integrals in graphs: the integral from 0 to 1 of an expression in bound symbols.
//!
//! Whoever builds one puts the variable and its differential in by a substitution, so that the limits stand within the
//! integrand: x = a + (b - a) s over a finite interval, x = a + s / (1 - s) from a to infinity. A derivative by anything is
//! then the integral of the integrand's derivative, which is Leibniz's rule; s and 1 - s are symbols of their own, neither
//! rounded to the other, for what is singular at an end.
//!
//! The bound symbols are in no answer of [`Graph::symbols`], and nothing is ever put in their place. An integral within
//! an integral is a quotient by zero, which no number can evaluate: its samples would take the square of the time.
//!
//! A tape evaluates an integral by the quadrature of its number type ([`Number::set_integral`]), which is not finite, or has an
//! error beyond all bounds, where it does not converge.

use super::graph::{Expr, Graph, Node, SymId};
use super::tape::{Tape, Workspace};
use crate::number::Number;

/// What a bound symbol stands for, where s goes from 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bound {
    /// s itself.
    Above,
    /// 1 - s.
    Below,
    /// The number 1, where it has a dimension.
    Unit,
}

impl Graph {
    /// Makes a symbol one that integrals bind.
    pub fn bind(&mut self, symbol: SymId, bound: Bound) {
        self.bound.insert(symbol, bound);
    }

    /// The integral from 0 to 1 of an expression in the bound symbols.
    pub fn integral(&mut self, integrand: Expr) -> Expr {
        let parts = self.parts(&[integrand]);
        let (mut bound, mut nested) = (false, false);
        for e in parts.order() {
            match self.node(*e) {
                Node::Symbol(s) => bound |= self.bound.contains_key(s),
                Node::Integral(_) => nested = true,
                _ => {}
            }
        }
        match (nested, bound) {
            // What is constant is its own mean over an interval of length 1; an integral in it binds its own symbols.
            (_, false) => integrand,
            (true, _) => {
                let zero = self.int(0);
                self.div(integrand, zero)
            }
            (false, true) => self.intern(Node::Integral(integrand)),
        }
    }

    /// Whether expressions have integrals in them.
    pub fn has_integrals(&self, es: &[Expr]) -> bool {
        self.reachable(es).into_iter().any(|e| matches!(self.node(e), Node::Integral(_)))
    }

    /// Whether expressions have bound symbols that stand in no integral: parts of an integrand.
    pub fn has_bound(&self, es: &[Expr]) -> bool {
        let bound = |e: &Expr| matches!(self.node(*e), Node::Symbol(s) if self.bound.contains_key(s));
        !self.bound.is_empty() && self.parts_around_integrals(es).order().iter().any(bound)
    }

    /// The symbols, as expressions, that an integrand depends on beside the bound ones.
    pub(super) fn parameters(&self, integrand: Expr) -> Vec<Expr> {
        let free = |e: &Expr| matches!(self.node(*e), Node::Symbol(s) if !self.bound.contains_key(s));
        self.reachable(&[integrand]).into_iter().filter(free).collect()
    }
}

/// Where an input of the integrand's tape comes from.
#[derive(Clone, Copy, Debug)]
enum Source {
    Slot(usize),
    Bound(Bound),
}

/// A compiled integrand.
#[derive(Debug)]
pub(super) struct Within {
    tape: Tape,
    sources: Vec<Source>,
}

impl Within {
    /// Compiles an integrand; `slot` says where the tape around it has a symbol.
    pub fn compile(graph: &Graph, integrand: Expr, slot: impl Fn(Expr) -> Option<usize>) -> Option<Self> {
        let tape = Tape::compile(graph, &[integrand]);
        let parameters = graph.parameters(integrand);
        let source = |symbol: &SymId| match graph.bound.get(symbol) {
            Some(bound) => Some(Source::Bound(*bound)),
            None => {
                let is_it = |e: &&Expr| matches!(graph.node(**e), Node::Symbol(s) if s == symbol);
                parameters.iter().find(is_it).and_then(|e| slot(*e)).map(Source::Slot)
            }
        };
        let sources = tape.inputs().iter().map(source).collect::<Option<Vec<_>>>()?;
        Some(Within { tape, sources })
    }

    /// Integrates, with what the slots of the tape around it hold.
    pub fn integrate<N: Number>(&self, slots: &[N], to: &mut N) {
        let cx = to.context();
        let value = |source: &Source| match source {
            Source::Slot(k) => slots.get(*k).cloned().unwrap_or_else(|| N::from_f64(f64::NAN, &cx)),
            Source::Bound(_) => N::from_f64(1.0, &cx),
        };
        let mut inputs: Vec<N> = self.sources.iter().map(value).collect();
        let mut work = Workspace::new();
        to.set_integral(&mut |above, below| {
            for (input, source) in inputs.iter_mut().zip(&self.sources) {
                match source {
                    Source::Bound(Bound::Above) => input.set(above),
                    Source::Bound(Bound::Below) => input.set(below),
                    Source::Bound(Bound::Unit) | Source::Slot(_) => {}
                }
            }
            let outputs = self.tape.eval(&inputs, &cx, &mut work);
            outputs.first().cloned().unwrap_or_else(|| N::from_f64(f64::NAN, &cx))
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::{Df64, Func, Tracked};

    /// A graph with s, 1 - s and a parameter.
    fn graph() -> (Graph, Expr, Expr, SymId) {
        let mut g = Graph::new();
        let (s, below, a) = (g.symbol("s"), g.symbol("1 - s"), g.symbol("a"));
        g.bind(s, Bound::Above);
        g.bind(below, Bound::Below);
        (g.clone(), g.sym(s), g.sym(below), a)
    }

    fn value<N: Number<Context = ()>>(g: &Graph, e: Expr, a: f64) -> N {
        let tape = Tape::compile(g, &[e]);
        let inputs: Vec<N> = tape.inputs().iter().map(|_| N::from_f64(a, &())).collect();
        tape.eval(&inputs, &(), &mut Workspace::new())[0].clone()
    }

    /// ∫ e^(-a x) dx from 0 to infinity.
    fn decay() -> (Graph, Expr, SymId) {
        let (mut g, ..) = graph();
        let (s, below, a) = (g.symbol("s"), g.symbol("1 - s"), g.symbol("a"));
        let (s, below, ea) = (g.sym(s), g.sym(below), g.sym(a));
        let x = g.div(s, below);
        let exponent = g.mul(ea, x);
        let exponent = g.neg(exponent);
        let f = g.call(Func::Exp, exponent);
        let square = g.powi(below, 2);
        let integrand = g.div(f, square);
        let e = g.integral(integrand);
        (g, e, a)
    }

    #[test]
    fn a_decay_and_its_derivative_in_numbers_of_all_strengths() {
        let (mut g, e, a) = decay();
        assert_eq!(g.symbols(&[e]), [a].into());
        assert!((value::<f64>(&g, e, 0.5) - 2.0).abs() < 1e-13);
        let precise: Tracked<Df64> = value(&g, e, 0.5);
        let error = precise.value().minus(&Df64::from(2.0)).log2_abs();
        assert!(error <= precise.error_log2() && precise.error_log2() < -80.0, "{error} {}", precise.error_log2());
        // d/da 1/a = -1/a²
        let rate = g.diff(e, a);
        assert!((value::<f64>(&g, rate, 0.5) + 4.0).abs() < 1e-12);
    }

    #[test]
    fn what_does_not_converge_is_no_number() {
        let (mut g, ..) = graph();
        let (s, below) = (g.symbol("s"), g.symbol("1 - s"));
        let (s, below) = (g.sym(s), g.sym(below));
        let x = g.div(s, below);
        let square = g.powi(below, 2);
        let sine = g.call(Func::Sin, x);
        for f in [x, sine] {
            let integrand = g.div(f, square);
            let e = g.integral(integrand);
            assert!(!value::<f64>(&g, e, 1.0).is_finite());
            let precise: Tracked<Df64> = value(&g, e, 1.0);
            assert!(
                !precise.is_finite() || precise.is_zero_within() || precise.error_log2() > precise.log2_abs() - 20.0
            );
        }
        let e = g.div(x, square);
        let e = g.integral(e);
        let product = g.mul(e, s);
        let nested = g.integral(product);
        assert!(!value::<f64>(&g, nested, 1.0).is_finite());
    }

    #[test]
    fn constants_are_their_own_integrals() {
        let (mut g, _, _, a) = graph();
        let e = g.sym(a);
        assert_eq!(g.integral(e), e);
    }
}
