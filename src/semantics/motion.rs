//! Integrals along the motion and values at its start: `\int_0^t F\,dt`, `\int \vec{f} \cdot d\vec{r}`, `(X)_0`,
//! `X|_0^t`, and values where a symbol has another, `X|_{x = y}`.
//!
//! What holds for all times is what holds at the start and has the same rate on both sides ever after. An integral is a
//! symbol of its own that depends on time, of which the world knows the rate, and that is zero at the start; a value at
//! the start is a constant, of which the world knows what it is the value of.

use std::collections::HashMap;

use crate::expr::{self, Expr, SymId};
use crate::latex::ast::{Kind, Link, Node, Rel, Span};

use super::elaborate::{Elaborator, Typed};
use super::error::{Error, Result};
use super::juxtaposition::Item;
use super::value;
use super::world::{Facts, World};

/// What is known of the integrals and starting values of a [`World`].
#[derive(Default)]
pub(super) struct History {
    /// The symbol of each integral and its rate.
    integrals: Vec<(SymId, Expr)>,
    /// The constant that is the value of something at the start.
    starts: Vec<(SymId, Expr)>,
    /// The time of the start; 0 where none is printed.
    begin: Option<Expr>,
}

impl World {
    /// The integral of a rate from the start of the motion on.
    fn integral(&mut self, rate: Expr) -> Expr {
        if let Some((symbol, _)) = self.history.integrals.iter().find(|(_, r)| *r == rate) {
            return self.graph.sym(*symbol);
        }
        let name = format!("\\int_{{({})}}", self.history.integrals.len() + 1);
        let symbol = self.symbol(&name, true, || Facts { tex: name.clone(), ..Facts::default() });
        self.history.integrals.push((symbol, rate));
        self.graph.sym(symbol)
    }

    /// The value of something at the start of the motion.
    fn at_start(&mut self, e: Expr) -> Expr {
        if self.graph.symbols(&[e]).iter().all(|s| !self.graph.info(*s).of_t) {
            return e;
        }
        if let Some((symbol, _)) = self.history.starts.iter().find(|(_, value)| *value == e) {
            return self.graph.sym(*symbol);
        }
        let name = format!("[{}]_0", self.graph.display(e));
        let tex = match *self.graph.node(e) {
            crate::expr::Node::Symbol(s) => format!("({})_0", self.tex(s)),
            _ => format!("(\\cdot)_{{0,{}}}", self.history.starts.len() + 1),
        };
        let symbol = self.symbol(&name, false, || Facts { tex, ..Facts::default() });
        self.history.starts.push((symbol, e));
        self.graph.sym(symbol)
    }

    /// Whether an expression holds an integral along the motion or a value at its start.
    pub fn remembers(&self, e: Expr) -> bool {
        let known = |s: &SymId| {
            self.history.integrals.iter().any(|(i, _)| i == s) || self.history.starts.iter().any(|(i, _)| i == s)
        };
        self.graph.symbols(&[e]).iter().any(known)
    }

    /// What a symbol is made of, if it is an integral along the motion or a value at its start: what it integrates (then
    /// `true`), or what it is the value of.
    pub fn remembered(&self, symbol: SymId) -> Option<(Expr, bool)> {
        let of = |all: &[(SymId, Expr)]| all.iter().find(|(s, _)| *s == symbol).map(|(_, e)| *e);
        let integral = of(&self.history.integrals).map(|rate| (rate, true));
        integral.or_else(|| of(&self.history.starts).map(|e| (e, false)))
    }

    /// The time derivative of an expression, in which an integral's is what it integrates.
    pub fn rate(&mut self, e: Expr) -> Expr {
        let t = self.graph.find("t");
        let rate = self.graph.time_derivative(e, t);
        let integrals = self.history.integrals.clone();
        let map: HashMap<SymId, Expr> =
            integrals.into_iter().map(|(s, rate)| (self.graph.derivative_symbol(s), rate)).collect();
        self.graph.substitute(rate, &map)
    }

    /// The derivative of each integral that has been met, and what it integrates.
    pub fn integral_rates(&mut self) -> Vec<(Expr, Expr)> {
        let integrals = self.history.integrals.clone();
        integrals
            .into_iter()
            .map(|(symbol, rate)| {
                let derivative = self.graph.derivative_symbol(symbol);
                (self.graph.sym(derivative), rate)
            })
            .collect()
    }

    /// An expression at the start of the motion: integrals are zero, and a value at the start is the value itself.
    pub fn start(&mut self, e: Expr) -> Expr {
        let zero = self.graph.int(0);
        let begin = self.history.begin.unwrap_or(zero);
        let mut map: HashMap<SymId, Expr> = self.history.starts.iter().copied().collect();
        map.extend(self.history.integrals.iter().map(|(s, _)| (*s, zero)));
        map.extend(self.graph.find("t").map(|t| (t, begin)));
        self.graph.substitute(e, &map)
    }
}

impl Elaborator<'_> {
    /// `\int` before what it integrates, along the motion: `\int_0^t F\,dt`, `\int \vec{f} \cdot d\vec{r}`.
    pub(super) fn integral(
        &mut self,
        from: Option<&Node>,
        to: Option<&Node>,
        rest: &[Item],
        span: &Span,
    ) -> Result<Typed> {
        let from = match to {
            Some(Node { kind: Kind::Symbol(s), .. }) if s != "t" => self.beginning(to, span)?,
            Some(Node { kind: Kind::Symbol(_), .. }) | None => from.cloned(),
            Some(to) => self.beginning(Some(to), span)?,
        };
        let inner = self.items(rest)?;
        if let Some(from) = from {
            let begin = self.value(&from)?;
            self.world.history.begin = Some(self.scalar(&begin, span)?);
        }
        let Some(dt) = self.world.graph.find("dt") else { return Err(without_differential(span)) };
        let mut failed = false;
        let value = inner.value.map(&mut |e| {
            let rate = self.world.graph.diff(e, dt);
            failed |= self.world.graph.symbols(&[rate]).contains(&dt);
            self.world.integral(rate)
        });
        let zero = self.world.graph.int(0);
        let nothing = inner.value.components().iter().all(|e| self.world.graph.diff(*e, dt) == zero && *e != zero);
        if failed || nothing {
            Err(without_differential(span))
        } else {
            Ok(Typed::new(value, format!("∫({})", inner.text)))
        }
    }

    /// The time at which an integral up to something that depends on time begins: t_0, where the notes have it.
    fn beginning(&mut self, to: Option<&Node>, span: &Span) -> Result<Option<Node>> {
        let end = to.map(|to| self.value(to)).transpose()?;
        let symbols = end.map(|end| self.world.graph.symbols(&end.value.components())).unwrap_or_default();
        if !symbols.iter().any(|s| self.world.graph.info(*s).of_t) {
            return Err(Error::unsupported("only integrals along the motion are evaluated yet", span));
        }
        let node = |kind| Box::new(Node::new(kind, span.clone()));
        let (base, zero) = (node(Kind::Symbol("t".into())), node(Kind::Number("0".into())));
        let kind = Kind::Scripts { base, primes: 0, sub: Some(zero), sup: None };
        let name = Node::new(kind, span.clone());
        Ok(self.is_declared(&name).then_some(name))
    }

    /// The value of something at the start of the motion, `(X)_0`.
    pub(super) fn started(&mut self, inner: &Typed) -> Typed {
        Typed::new(inner.value.map(&mut |e| self.world.at_start(e)), format!("{}_0", inner.text))
    }

    /// `X|_{x = y}`: what X is where x has the value y. Rates of x are not put in: they are those at that moment.
    fn with_value(&mut self, body: &Node, name: &Node, value: &Node, span: &Span) -> Result<Typed> {
        let (inner, name, value) = (self.value(body)?, self.value(name)?, self.value(value)?);
        let (names, values) = (name.value.components(), value.value.components());
        let symbol = |e: &Expr| match *self.world.graph.node(*e) {
            expr::Node::Symbol(s) => Some(s),
            _ => None,
        };
        let symbols: Option<Vec<SymId>> = names.iter().map(symbol).collect();
        let Some(symbols) = symbols.filter(|symbols| symbols.len() == values.len()) else {
            return Err(Error::unsupported("a value is put in for a symbol of its own, of the same shape", span));
        };
        let map = symbols.into_iter().zip(values).collect();
        let put_in = inner.value.map(&mut |e| self.world.graph.substitute(e, &map));
        Ok(Typed::new(put_in, format!("({} at {} = {})", inner.text, name.text, value.text)))
    }

    /// `X|_0` and `X|_0^t`.
    pub(super) fn evaluated_at(&mut self, body: &Node, at: &Node, span: &Span) -> Result<Typed> {
        let limits = match &at.kind {
            Kind::Scripts { base, primes: 0, sub: Some(sub), sup } if base.kind == Kind::Empty => (sub, sup),
            Kind::Chain { first: Some(name), links } => match links.as_slice() {
                [Link { rel: Rel::Eq, rhs, .. }] => return self.with_value(body, name, rhs, span),
                _ => return Err(Error::unsupported("a value at this condition is not evaluated yet", span)),
            },
            _ => return Err(Error::unsupported("a value at a condition is not evaluated yet", span)),
        };
        if !is_start(limits.0) {
            return Err(Error::unsupported("only a value at the start, |_0, is evaluated yet", span));
        }
        let inner = self.value(body)?;
        let start = self.started(&inner);
        match limits.1.as_deref() {
            None => Ok(start),
            Some(Node { kind: Kind::Symbol(s), .. }) if s == "t" => {
                let value = value::add(&mut self.world.graph, &inner.value, &start.value, true, span)?;
                Ok(Typed::new(value, format!("({} - {})", inner.text, start.text)))
            }
            Some(_) => Err(Error::unsupported("only a difference from 0 to t is evaluated yet", span)),
        }
    }
}

/// Whether a subscript means the start of the motion.
pub(super) fn is_start(sub: &Node) -> bool {
    matches!(&sub.kind, Kind::Number(n) if n == "0")
}

fn without_differential(span: &Span) -> Error {
    Error::unsupported("this integral has no differential that depends on time", span)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::semantics::Value;
    use crate::semantics::testing::{scope, value};

    const SYMBOLS: &str = r"
        [symbols]
        'x, y' = { of = 't', range = [0.5, 2.0] }
        'c' = { range = [0.5, 2.0] }
        '\vec{f}, \vec{r}' = { vector = '', of = 't' }
    ";

    fn scalar(world: &mut World, latex: &str) -> Expr {
        match value(world, &scope(SYMBOLS), latex).unwrap() {
            Value::Scalar(e) => e,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn an_integral_has_its_rate_and_starts_at_zero() {
        let mut world = World::new();
        let (work, power) =
            (scalar(&mut world, r"\int \vec{f} \cdot d\vec{r}"), scalar(&mut world, r"\vec{f} \cdot \dot{\vec{r}}"));
        assert!(world.remembers(work) && !world.remembers(power));
        assert_eq!(world.rate(work), power);
        let start = world.start(work);
        assert!(world.graph.is_zero(start));
    }

    #[test]
    fn equal_integrals_are_one_symbol() {
        let mut world = World::new();
        assert_eq!(scalar(&mut world, r"\int_0^t x \dot{y} dt"), scalar(&mut world, r"\int x dy"));
    }

    #[test]
    fn a_value_at_the_start_is_a_constant() {
        let mut world = World::new();
        let difference = scalar(&mut world, r"\left. x^2 \right|_0^t");
        let (rate, start) = (world.rate(difference), world.start(difference));
        assert_eq!(rate, scalar(&mut world, r"2 x \dot{x}"));
        assert!(world.graph.is_zero(start));
        assert_eq!(scalar(&mut world, "(c)_0"), scalar(&mut world, "c"));
    }

    #[test]
    fn an_integral_without_differential_is_refused() {
        let error = value(&mut World::new(), &scope(SYMBOLS), r"\int_0^t x y").unwrap_err();
        assert!(error.message.contains("differential"), "{error:?}");
    }
}
