//! Equations of motion in formulas that read like them, compiled to Taylor series.

use super::SceneError;
use crate::expr::{Expr, Func, Graph, SymId};
use crate::integrator::Rates;
use crate::integrator::taylor::{Equations, Series};
use crate::number::Number;
use std::cell::RefCell;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// An expression that knows its graph, so that formulas can be written with operators.
#[derive(Clone, Copy)]
pub(super) struct Term<'g> {
    graph: &'g RefCell<Graph>,
    expr: Expr,
}

impl<'g> Term<'g> {
    fn with(self, make: impl FnOnce(&mut Graph) -> Expr) -> Term<'g> {
        Term { expr: make(&mut self.graph.borrow_mut()), ..self }
    }

    /// A symbol: a component of the state, or a parameter.
    pub fn symbol(self, name: &str) -> Term<'g> {
        self.with(|g| {
            let symbol = g.symbol(name);
            g.sym(symbol)
        })
    }

    /// A whole number.
    pub fn int(self, n: i64) -> Term<'g> {
        self.with(|g| g.int(n))
    }

    /// The square.
    pub fn square(self) -> Term<'g> {
        self.with(|g| g.powi(self.expr, 2))
    }

    /// The square root.
    pub fn sqrt(self) -> Term<'g> {
        self.with(|g| g.sqrt(self.expr))
    }

    /// The sine and the cosine.
    pub fn sin_cos(self) -> (Term<'g>, Term<'g>) {
        (self.with(|g| g.call(Func::Sin, self.expr)), self.with(|g| g.call(Func::Cos, self.expr)))
    }
}

macro_rules! operator {
    ($trait:ident, $method:ident, $make:ident) => {
        impl<'g> $trait for Term<'g> {
            type Output = Term<'g>;
            fn $method(self, other: Term<'g>) -> Term<'g> {
                self.with(|g| g.$make(self.expr, other.expr))
            }
        }
    };
}
operator!(Add, add, add);
operator!(Sub, sub, sub);
operator!(Mul, mul, mul);
operator!(Div, div, div);

impl<'g> Neg for Term<'g> {
    type Output = Term<'g>;
    fn neg(self) -> Term<'g> {
        self.with(|g| g.neg(self.expr))
    }
}

/// A system of differential equations of first order, and the names of its parameters in the order in which it takes
/// their values.
pub(super) struct Flow {
    pub series: Series,
    names: Vec<String>,
}

impl Flow {
    /// Compiles the system: `rates` makes the rate of each component of the state from these components; other symbols
    /// are parameters.
    pub fn new<const N: usize>(
        state: [&str; N],
        rates: impl for<'g> FnOnce([Term<'g>; N]) -> [Term<'g>; N],
    ) -> Result<Flow, SceneError> {
        let (graph, symbols, rates) = Self::build(state, rates);
        let series = Series::compile(&Equations { graph: &graph, state: &symbols, rates: &rates, time: None })?;
        let names = series.parameters().iter().map(|s| graph.info(*s).name.clone()).collect();
        Ok(Flow { series, names })
    }

    /// The same system for methods that ask for its rates, with its parameters by name.
    pub fn rates<const N: usize, T: Number>(
        state: [&str; N],
        rates: impl for<'g> FnOnce([Term<'g>; N]) -> [Term<'g>; N],
        named: &[(&str, T)],
        cx: &T::Context,
    ) -> Rates<T> {
        let (graph, symbols, rates) = Self::build(state, rates);
        let equations = Equations { graph: &graph, state: &symbols, rates: &rates, time: None };
        let of = |name: &str| named.iter().find(|(known, _)| *known == name).map(|(_, value)| value.clone());
        Rates::compile(&equations, cx, |s| of(&graph.info(s).name).unwrap_or_else(|| T::from_f64(f64::NAN, cx)))
    }

    fn build<const N: usize>(
        state: [&str; N],
        rates: impl for<'g> FnOnce([Term<'g>; N]) -> [Term<'g>; N],
    ) -> (Graph, [SymId; N], [Expr; N]) {
        let graph = RefCell::new(Graph::new());
        let symbols = state.map(|name| graph.borrow_mut().symbol(name));
        let terms = symbols.map(|s| {
            let expr = graph.borrow_mut().sym(s);
            Term { graph: &graph, expr }
        });
        let rates = rates(terms).map(|t| t.expr);
        (graph.into_inner(), symbols, rates)
    }

    /// The values of the parameters in the system's order, from their values by name; the others are not needed.
    pub fn parameters<T: Clone>(&self, named: &[(&str, T)]) -> Vec<T> {
        self.names.iter().filter_map(|n| Some(named.iter().find(|(name, _)| name == n)?.1.clone())).collect()
    }
}
