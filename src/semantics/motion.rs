//! Integrals along the motion and values at its start: `\int_0^t F\,dt`, `\int \vec{f} \cdot d\vec{r}`, `(X)_0`.
//!
//! What holds for all times is what holds at the start and has the same rate on both sides ever after. An integral is a
//! symbol of its own that depends on time, of which the world knows the rate, and that is zero at the start; a value at
//! the start is a constant, of which the world knows what it is the value of.
//!
//! An integral up to a symbol, `\int_a^x f\,dx`, is one along the motion in which x moves and the motion starts at
//! x = a; its partial derivatives by x and by other symbols in f and a are those of Leibniz's rule.

use std::collections::HashMap;

use crate::expr::{Expr, SymId};
use crate::latex::ast::{Kind, Node, Span};

use super::elaborate::{Elaborator, Typed};
use super::error::{Error, Result};
use super::juxtaposition::Item;
use super::value::Value;
use super::world::{Facts, World};

/// What is known of the integrals and starting values of a [`World`].
#[derive(Default)]
pub(super) struct History {
    /// The integrals.
    integrals: Vec<Integral>,
    /// The constant that is the value of something at the start.
    starts: Vec<(SymId, Expr)>,
    /// The time of the start; 0 where none is printed.
    begin: Option<Expr>,
}

/// An integral along the motion.
#[derive(Clone, Copy)]
struct Integral {
    /// The symbol that it is.
    symbol: SymId,
    /// What is integrated over time.
    rate: Expr,
    /// Its upper limit, where that is a symbol.
    limits: Option<Limits>,
}

/// The limits of an integral up to a symbol.
#[derive(Clone, Copy, PartialEq)]
struct Limits {
    /// The upper limit, which is also the variable.
    variable: SymId,
    /// The lower limit.
    from: Expr,
    /// What is integrated over the variable.
    integrand: Expr,
}

impl World {
    /// The integral of a rate from the start of the motion on.
    fn integral(&mut self, rate: Expr, limits: Option<Limits>) -> Expr {
        let known = |i: &&Integral| i.rate == rate && i.limits == limits;
        if let Some(found) = self.history.integrals.iter().find(known) {
            return self.graph.sym(found.symbol);
        }
        let name = format!("\\int_{{({})}}", self.history.integrals.len() + 1);
        let symbol = self.symbol(&name, true, || Facts { tex: name.clone(), ..Facts::default() });
        self.history.integrals.push(Integral { symbol, rate, limits });
        self.graph.sym(symbol)
    }

    /// The partial derivative of an expression by a symbol; none where it holds an integral along the motion that
    /// depends on the symbol and has no limit to say how.
    pub(super) fn partial(&mut self, e: Expr, x: SymId) -> Option<Expr> {
        let mut total = self.graph.diff(e, x);
        let symbols = self.graph.symbols(&[e]);
        for integral in self.history.integrals.clone().into_iter().filter(|i| symbols.contains(&i.symbol)) {
            let inner = match integral.limits {
                Some(limits) if limits.variable == x => limits.integrand,
                Some(limits) => self.leibniz(&limits, x),
                None if self.graph.symbols(&[integral.rate]).contains(&x) => return None,
                None => continue,
            };
            let outer = self.graph.diff(e, integral.symbol);
            let term = self.graph.mul(outer, inner);
            total = self.graph.add(total, term);
        }
        Some(total)
    }

    /// The derivative of an integral by a symbol other than its upper limit: ∫ ∂f/∂x - f(a) ∂a/∂x.
    fn leibniz(&mut self, limits: &Limits, x: SymId) -> Expr {
        let Limits { variable, from, integrand } = *limits;
        let slope = self.graph.diff(integrand, x);
        let first = self.graph.substitute(integrand, &HashMap::from([(variable, from)]));
        let shift = self.graph.diff(from, x);
        let boundary = self.graph.mul(first, shift);
        let speed = self.graph.derivative_symbol(variable);
        let speed = self.graph.sym(speed);
        let rate = self.graph.mul(slope, speed);
        let within = match self.graph.is_zero(slope) {
            true => slope,
            false => self.integral(rate, Some(Limits { integrand: slope, ..*limits })),
        };
        self.graph.sub(within, boundary)
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
            self.history.integrals.iter().any(|i| i.symbol == *s) || self.history.starts.iter().any(|(i, _)| i == s)
        };
        self.graph.symbols(&[e]).iter().any(known)
    }

    /// What a symbol is made of, if it is an integral along the motion or a value at its start: what it integrates (then
    /// `true`), or what it is the value of.
    pub fn remembered(&self, symbol: SymId) -> Option<(Expr, bool)> {
        let integral = self.history.integrals.iter().find(|i| i.symbol == symbol).map(|i| (i.rate, true));
        let start = || self.history.starts.iter().find(|(s, _)| *s == symbol).map(|(_, e)| (*e, false));
        integral.or_else(start)
    }

    /// The time derivative of an expression, in which an integral's is what it integrates.
    pub fn rate(&mut self, e: Expr) -> Expr {
        let t = self.graph.find("t");
        let rate = self.graph.time_derivative(e, t);
        let integrals = self.history.integrals.clone();
        let map: HashMap<SymId, Expr> =
            integrals.into_iter().map(|i| (self.graph.derivative_symbol(i.symbol), i.rate)).collect();
        self.graph.substitute(rate, &map)
    }

    /// The derivative of each integral that has been met, and what it integrates.
    pub fn integral_rates(&mut self) -> Vec<(Expr, Expr)> {
        let integrals = self.history.integrals.clone();
        integrals
            .into_iter()
            .map(|i| {
                let derivative = self.graph.derivative_symbol(i.symbol);
                (self.graph.sym(derivative), i.rate)
            })
            .collect()
    }

    /// An expression at the start of the motion: integrals are zero, their upper limits are the lower ones, and a value
    /// at the start is the value itself.
    pub fn start(&mut self, e: Expr) -> Expr {
        let zero = self.graph.int(0);
        let begin = self.history.begin.unwrap_or(zero);
        let values: HashMap<SymId, Expr> = self.history.starts.iter().copied().collect();
        let e = self.graph.substitute(e, &values);
        let integrals = &self.history.integrals;
        let mut map: HashMap<SymId, Expr> = integrals.iter().map(|i| (i.symbol, zero)).collect();
        map.extend(integrals.iter().filter_map(|i| i.limits).map(|l| (l.variable, l.from)));
        map.extend(self.graph.find("t").map(|t| (t, begin)));
        self.graph.substitute(e, &map)
    }

    /// The limits of an integral whose value is `rate` times dt, up to a symbol that moves. None where something else
    /// than this symbol is the variable.
    fn limits(&mut self, rate: Expr, variable: SymId, from: Expr) -> Option<Limits> {
        let speed = self.graph.derivative_symbol(variable);
        let integrand = self.graph.diff(rate, speed);
        let zero = self.graph.int(0);
        let rest = self.graph.substitute(rate, &HashMap::from([(speed, zero)]));
        let alone = self.graph.is_zero(rest) && !self.graph.symbols(&[integrand]).contains(&speed);
        alone.then_some(Limits { variable, from, integrand })
    }
}

/// What to do about an integral that is not evaluated.
pub(super) const UNTIL_THEN: &str =
    "until then say what it comes to under `where` of the equations that rest on it, and here expect = \"undecided\"";

impl Elaborator<'_> {
    /// `\int` before what it integrates, along the motion: `\int_0^t F\,dt`, `\int \vec{f} \cdot d\vec{r}`.
    pub(super) fn integral(
        &mut self,
        from: Option<&Node>,
        to: Option<&Node>,
        rest: &[Item],
        span: &Span,
    ) -> Result<Typed> {
        let limits = self.moving_limit(from, to)?;
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
            let limits = limits.and_then(|(variable, from)| self.world.limits(rate, variable, from));
            self.world.integral(rate, limits)
        });
        self.one_start(span)?;
        let zero = self.world.graph.int(0);
        let nothing = inner.value.components().iter().all(|e| self.world.graph.diff(*e, dt) == zero && *e != zero);
        if failed || nothing {
            Err(without_differential(span))
        } else {
            Ok(Typed::new(value, format!("∫({})", inner.text)))
        }
    }

    /// The upper limit of an integral and the lower one, where the upper is a symbol that moves.
    fn moving_limit(&mut self, from: Option<&Node>, to: Option<&Node>) -> Result<Option<(SymId, Expr)>> {
        let (Some(from), Some(to)) = (from, to) else { return Ok(None) };
        if matches!(&to.kind, Kind::Symbol(s) if s == "t") {
            return Ok(None);
        }
        let end = self.value(to)?.value;
        let Value::Scalar(end) = end else { return Ok(None) };
        let crate::expr::Node::Symbol(variable) = *self.world.graph.node(end) else { return Ok(None) };
        if !self.world.graph.info(variable).of_t {
            return Ok(None);
        }
        let begin = self.value(from)?;
        Ok(Some((variable, self.scalar(&begin, &from.span)?)))
    }

    /// Integrals over one variable begin at one value of it, so that the motion has one start.
    fn one_start(&self, span: &Span) -> Result<()> {
        let limits: Vec<Limits> = self.world.history.integrals.iter().filter_map(|i| i.limits).collect();
        let differ = |a: &Limits| limits.iter().any(|b| a.variable == b.variable && a.from != b.from);
        match limits.iter().any(differ) {
            true => Err(Error::unsupported("integrals over one variable with several lower limits", span)),
            false => Ok(()),
        }
    }

    /// The time at which an integral up to something that depends on time begins: t_0, where the notes have it.
    fn beginning(&mut self, to: Option<&Node>, span: &Span) -> Result<Option<Node>> {
        let end = to.map(|to| self.value(to)).transpose()?;
        let symbols = end.map(|end| self.world.graph.symbols(&end.value.components())).unwrap_or_default();
        if !symbols.iter().any(|s| self.world.graph.info(*s).of_t) {
            let what = "only integrals between limits and along the motion are evaluated yet";
            return Err(Error::unsupported(what, span).with_help(UNTIL_THEN));
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

    #[test]
    fn leibniz_rule() {
        let mut world = World::new();
        let integral = scalar(&mut world, r"\int_c^x c y^2 x dx");
        let c = world.graph.find("c").unwrap();
        let by_parameter = world.partial(integral, c).unwrap();
        let expected = scalar(&mut world, r"\int_c^x y^2 x dx - c y^2 c");
        let difference = world.graph.sub(by_parameter, expected);
        assert!(world.remembers(by_parameter));
        assert!(world.graph.is_zero(difference), "{}", world.graph.display(difference));
        let x = world.graph.find("x").unwrap();
        assert_eq!(world.partial(integral, x), Some(scalar(&mut world, "c y^2 x")));
        let along = scalar(&mut world, r"\int_0^t x y dt");
        assert!(world.partial(along, x).is_none() && world.partial(along, c).is_some());
    }

    #[test]
    fn integrals_over_one_variable_have_one_lower_limit() {
        let mut world = World::new();
        scalar(&mut world, r"\int_c^x x dx");
        let error = value(&mut world, &scope(SYMBOLS), r"\int_0^x x dx").unwrap_err();
        assert!(error.message.contains("lower limits"), "{error:?}");
    }
}
