//! Partial derivatives: with respect to a symbol, to each of a tuple of symbols, or to an expression, `\frac{\partial
//! S}{\partial(\cos I)}`.

use crate::expr::{Expr, Node as Op, SymId, Tape, Workspace};
use crate::latex::ast::{Node, Span};

use super::elaborate::Elaborator;
use super::error::{Error, Result};
use super::name::spelling;
use super::scope::EntryKind;
use super::value::Value;

/// The points at which it is seen whether a function depends on others only by an expression.
const POINTS: usize = 4;

/// How large, against its terms, a minor of two gradients may be that vanishes but for rounding.
const ROUNDING: f64 = 1e-9;

impl Elaborator<'_> {
    /// The partial derivative of a value by a symbol or an expression; by what stands for a tuple, the tuple of them.
    pub(super) fn partial(&mut self, value: &Value, variable: &Node, span: &Span) -> Result<Value> {
        match self.value(variable)?.value {
            Value::Scalar(x) => self.by_scalar(value, x, variable, span),
            Value::Tuple(items) => {
                let by = |item: &Value| match item {
                    Value::Scalar(x) => self.by_scalar(value, *x, variable, span),
                    other => Err(Error::shape(format!("a derivative with respect to {}", other.shape()), span)),
                };
                items.iter().map(by).collect::<Result<_>>().map(Value::Tuple)
            }
            // The gradient.
            Value::Vector(v) if matches!(value, Value::Scalar(_)) => {
                let parts = v.iter().map(|x| self.by_scalar(value, *x, variable, span)).collect::<Result<Vec<_>>>()?;
                match parts.as_slice() {
                    [Value::Scalar(x), Value::Scalar(y), Value::Scalar(z)] => Ok(Value::Vector([*x, *y, *z])),
                    _ => Err(Error::shape("a gradient has three components", span)),
                }
            }
            other => {
                let message = format!("the derivative of {} by {}", value.shape(), other.shape());
                Err(Error::unsupported(format!("{message} is not evaluated yet"), span))
            }
        }
    }

    fn by_scalar(&mut self, value: &Value, x: Expr, variable: &Node, span: &Span) -> Result<Value> {
        let Op::Symbol(id) = *self.world.graph.node(x) else { return self.by_expression(value, x, variable, span) };
        self.depends_by_formulas(value, variable, span)?;
        let mut along = false;
        let derivative = value.map(&mut |e| {
            let derivative = self.world.partial(e, id);
            along |= derivative.is_none();
            derivative.unwrap_or(e)
        });
        match along {
            true => Err(Error::unsupported("a partial derivative of an integral along the motion", span)),
            false => Ok(derivative),
        }
    }

    /// What depends on the variable by no formula has a derivative that is not known, and is not 0.
    fn depends_by_formulas(&mut self, value: &Value, variable: &Node, span: &Span) -> Result<()> {
        let name = spelling(variable);
        let symbols = self.world.graph.symbols(&value.components());
        let unknown = symbols.into_iter().find(|s| self.world.facts(*s).depends.contains(&name));
        match unknown {
            None => Ok(()),
            Some(symbol) => {
                let message = format!("{} depends on {name}, by no formula", self.world.tex(symbol));
                Err(Error::unsupported(message, span).with_help("give it by one: same = '..', function = [..]"))
            }
        }
    }

    /// The derivative of something with respect to an expression x that it depends on by x alone: by any symbol of x,
    /// divided by that of x itself. Whether it does is seen from the gradients, which are parallel then.
    fn by_expression(&mut self, value: &Value, x: Expr, variable: &Node, span: &Span) -> Result<Value> {
        let name = spelling(variable);
        let name = if name.is_empty() { "an expression".to_owned() } else { name };
        let symbols: Vec<SymId> = self.world.graph.symbols(&[x]).into_iter().collect();
        let Some(first) = symbols.first().copied() else {
            return Err(Error::unsupported(format!("a derivative with respect to {name}, which is no variable"), span));
        };
        let mut minors = Vec::new();
        if value.components().into_iter().any(|e| self.world.remembers(e)) {
            return Err(Error::unsupported("a partial derivative of an integral along the motion", span));
        }
        for e in value.components() {
            for s in symbols.iter().skip(1) {
                let graph = &mut self.world.graph;
                let gradients = [graph.diff(e, first), graph.diff(x, *s), graph.diff(e, *s), graph.diff(x, first)];
                let (a, b) = (graph.mul(gradients[0], gradients[1]), graph.mul(gradients[2], gradients[3]));
                minors.extend([a, b]);
            }
        }
        if !self.are_equal(&minors) {
            let message = format!("a derivative with respect to {name} of what depends on its symbols otherwise, too");
            return Err(Error::unsupported(message, span));
        }
        let graph = &mut self.world.graph;
        let rate = graph.diff(x, first);
        Ok(value.map(&mut |e| {
            let derivative = graph.diff(e, first);
            graph.div(derivative, rate)
        }))
    }

    /// Whether each first of two expressions is the second, at some points of the declared ranges.
    fn are_equal(&self, pairs: &[Expr]) -> bool {
        let tape = Tape::compile(&self.world.graph, pairs);
        let mut work = Workspace::default();
        let mut seen = pairs.is_empty();
        for point in 0..POINTS {
            let place = |k: usize| (0.37 + 0.618_034 * (k + 1) as f64 + 0.414_214 * point as f64).fract();
            let inputs: Vec<f64> = tape
                .inputs()
                .iter()
                .enumerate()
                .map(|(k, s)| {
                    let [from, to] = self.world.facts(*s).range.unwrap_or([0.3, 2.0]);
                    from + (to - from) * place(k)
                })
                .collect();
            let values = tape.eval(&inputs, &(), &mut work);
            if values.iter().any(|v| !v.is_finite()) {
                continue;
            }
            seen = true;
            if values.chunks(2).any(|v| (v[0] - v[1]).abs() > ROUNDING * (v[0].abs() + v[1].abs())) {
                return false;
            }
        }
        seen
    }

    /// Whether a symbol is another notation of the time.
    pub(super) fn is_time(&mut self, variable: &Node) -> bool {
        let is_alias = self.entry(variable).is_some_and(|(e, _)| matches!(e.kind, EntryKind::Same(_)));
        let value = if is_alias { self.value(variable).ok() } else { None };
        match value.map(|typed| typed.value) {
            Some(Value::Scalar(e)) => {
                matches!(*self.world.graph.node(e), Op::Symbol(s) if self.world.graph.find("t") == Some(s))
            }
            _ => false,
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::semantics::testing::{scope, value};
    use crate::semantics::{Value, World};

    const SYMBOLS: &str = r"
        [symbols]
        't' = { range = [0.1, 1.0] }
        '\tau' = { same = 't' }
        'x, y, z' = { range = [0.5, 2.0], of = 't' }
        '\vec{q}' = { same = '(x, y)' }
    ";

    fn components(world: &mut World, latex: &str) -> Result<Vec<crate::expr::Expr>, String> {
        value(world, &scope(SYMBOLS), latex).map(|v: Value| v.components()).map_err(|e| e.message)
    }

    #[test]
    fn by_each_of_a_tuple() {
        let mut world = World::new();
        let found = components(&mut world, r"\frac{\partial (x y z)}{\partial(\vec{q}, z)}").unwrap();
        assert_eq!(found.len(), 3);
        assert_eq!(found[2], components(&mut world, "x y").unwrap()[0]);
    }

    #[test]
    fn by_an_expression() {
        let mut world = World::new();
        assert_eq!(components(&mut world, r"\frac{\partial \sin(x/y)}{\partial(x/y)}").unwrap().len(), 1);
        let error = components(&mut world, r"\frac{\partial (x + y)}{\partial(x/y)}").unwrap_err();
        assert!(error.contains("otherwise"), "{error}");
        assert!(components(&mut world, r"\frac{\partial x}{\partial 2}").is_err());
    }

    #[test]
    fn by_another_notation_of_the_time() {
        let mut world = World::new();
        let (found, rate) = (components(&mut world, r"\frac{dx}{d\tau}"), components(&mut world, r"\dot{x}"));
        assert_eq!(found, rate);
    }
}
