//! Definite integrals over a variable of their own: `\int_0^Q \frac{q}{C}\,dq`, `\int_0^\infty e^{-2t/\tau}\,dt`,
//! `\int_{-\infty}^{\infty} \frac{dx}{1 + x^2}`.
//!
//! The variable is bound: within the integrand its name means nothing else, and it needs no declaration. What is
//! integrated is put on the interval from 0 to 1 (see [`crate::expr::integral`]), and evaluated by quadrature; where that does
//! not converge the integral has no value, and what is said of it is undecided. Integrals over something that moves,
//! up to something that moves, are those of [`super::motion`].
//!
//! What depends on the variable by no formula cannot be integrated over it: a symbol that is declared to depend on it; where it
//! is the time, everything that moves; and whatever the premises of an equation relate to a symbol of the same
//! name, which is for whoever puts premises in to see ([`World::integrated`]).

use crate::expr::{Bound, Expr};
use crate::latex::ast::{BigOp, Font, Kind, Node, Sign, Span};

use super::elaborate::{Elaborator, Typed};
use super::element::{factors_of, is_integral};
use super::error::{Error, Result};
use super::juxtaposition::{Item, flatten, head_and_power};
use super::name::spelling;
use super::units::Dimension;
use super::value::{self, Value};
use super::world::{Facts, Quantity, World};

/// What stands behind an integral sign.
struct Integrand {
    /// The variable.
    variable: Node,
    /// The factors, without the differential.
    factors: Vec<Node>,
    /// How many of the items it takes.
    used: usize,
}

/// An end of the interval.
enum Limit {
    Finite(Expr),
    /// Infinity, and whether it is the negative one.
    Infinite(bool),
}

impl Elaborator<'_> {
    /// A definite integral, and how many of the items behind its sign it takes; none where it is another kind of integral.
    pub(super) fn definite(&mut self, sign: &Node, rest: &[Item]) -> Result<Option<(Typed, usize)>> {
        let Kind::Scripts { base, sub: Some(from), sup: Some(to), .. } = &sign.kind else { return Ok(None) };
        if base.kind != Kind::BigOp(BigOp::Integral) {
            return Ok(None);
        }
        let Some(integrand) = integrand(rest) else { return Ok(None) };
        let declared =
            Node::new(Kind::Juxt(vec![letter("d", &sign.span), integrand.variable.clone()]), sign.span.clone());
        if !self.particles(&factors_of(&rest[..integrand.used])).is_empty() || self.is_declared(&declared) {
            return Ok(None);
        }
        // Along the motion t needs no declaration.
        if spelling(to) == "t" && !self.is_declared(to) && self.has_rate(&integrand.variable) {
            return Ok(None);
        }
        let (from, to) = (self.limit(from)?, self.limit(to)?);
        if self.is_along_motion(&integrand.variable, &to) {
            return Ok(None);
        }
        let name = spelling(&integrand.variable);
        let typed = match (from, to) {
            (Limit::Finite(a), Limit::Finite(b)) => self.between(&integrand, a, b)?,
            (Limit::Finite(a), Limit::Infinite(down)) => self.beyond(&integrand, a, down)?,
            (Limit::Infinite(down), Limit::Finite(b)) => {
                let back = self.beyond(&integrand, b, down)?;
                self.negative(back)
            }
            (Limit::Infinite(down), Limit::Infinite(other)) if down != other => {
                let zero = self.world.graph.int(0);
                let (below, above) = (self.beyond(&integrand, zero, down)?, self.beyond(&integrand, zero, other)?);
                let value = value::add(&mut self.world.graph, &above.value, &below.value, true, &sign.span)?;
                Typed::new(value, above.text)
            }
            _ => return Err(Error::unsupported("this integral begins where it ends", &sign.span)),
        };
        self.world.integrated.insert(name);
        Ok(Some((typed, integrand.used)))
    }

    /// ∫ f(x) dx from a to b with x = a (1 - s) + b s.
    fn between(&mut self, integrand: &Integrand, a: Expr, b: Expr) -> Result<Typed> {
        let number = || Quantity::of(Dimension::NONE);
        let above = self.world.bound("\\int s", Bound::Above, number());
        let below = self.world.bound("\\int (1 - s)", Bound::Below, number());
        let graph = &mut self.world.graph;
        let (left, right) = (graph.mul(a, below), graph.mul(b, above));
        let (x, length) = (graph.add(left, right), graph.sub(b, a));
        self.over(integrand, x, length)
    }

    /// ∫ f(x) dx from a to infinity with x = a + s / (1 - s), or from there down to -∞ with x = a - s / (1 - s).
    fn beyond(&mut self, integrand: &Integrand, a: Expr, down: bool) -> Result<Typed> {
        let name = spelling(&integrand.variable);
        let quantity = match self.entry(&integrand.variable) {
            Some((entry, _)) => {
                Quantity { name: entry.pattern.clone(), declared: entry.declared, dimension: entry.dimension }
            }
            None => Quantity { name: name.clone(), declared: 0, dimension: None },
        };
        let above = self.world.bound(&format!("\\int s {name}"), Bound::Above, quantity.clone());
        let unit = self.world.bound(&format!("\\int 1 {name}"), Bound::Unit, quantity);
        let below = self.world.bound("\\int (1 - s)", Bound::Below, Quantity::of(Dimension::NONE));
        let graph = &mut self.world.graph;
        let (way, square) = (graph.div(above, below), graph.powi(below, 2));
        let speed = graph.div(unit, square);
        let (x, speed) = match down {
            false => (graph.add(a, way), speed),
            true => (graph.sub(a, way), graph.neg(speed)),
        };
        self.over(integrand, x, speed)
    }

    /// The integral over s of what is printed, where the variable is `x` and dx is `speed` ds.
    fn over(&mut self, integrand: &Integrand, x: Expr, speed: Expr) -> Result<Typed> {
        let span = &integrand.variable.span;
        let name = spelling(&integrand.variable);
        let items: Vec<Item> = integrand.factors.iter().map(Item::Factor).collect();
        self.bound.push((name.clone(), Typed::new(Value::Scalar(x), name.clone())));
        // The innermost of one name is meant.
        self.bound.rotate_right(1);
        let inner = match items.is_empty() {
            true => Ok(Typed::new(Value::Scalar(self.world.graph.int(1)), "1")),
            false => self.items(&items),
        };
        self.bound.remove(0);
        let inner = inner?;
        self.depends_by_no_formula(&inner.value, &integrand.variable, span)?;
        let graph = &mut self.world.graph;
        let value = inner.value.map(&mut |e| {
            let rate = graph.mul(e, speed);
            graph.integral(rate)
        });
        Ok(Typed::new(value, format!("∫({}) d{name}", inner.text)))
    }

    /// What depends on the variable, and not by a formula, is not known along it.
    fn depends_by_no_formula(&mut self, value: &Value, variable: &Node, span: &Span) -> Result<()> {
        let name = spelling(variable);
        let time = self.is_moment(variable);
        let symbols = self.world.graph.symbols(&value.components());
        let unknown = symbols.into_iter().find(|s| {
            let base = self.world.graph.info(*s).base;
            self.world.facts(base).depends.contains(&name) || time && self.world.graph.info(*s).of_t
        });
        match unknown {
            None => Ok(()),
            Some(symbol) => {
                let message = format!("{} depends on {name}, by no formula", self.world.tex(symbol));
                Err(Error::unsupported(message, span).with_help("give it by one: same = '..', function = [..]"))
            }
        }
    }

    /// Whether a variable is a time: t itself, another notation of it, t', t_1, \tau.
    fn is_moment(&mut self, variable: &Node) -> bool {
        let name = spelling(variable);
        let base = name.split(['_', '\'']).next().unwrap_or_default();
        matches!(base, "t" | "\\tau") || self.is_time(variable)
    }

    fn limit(&mut self, node: &Node) -> Result<Limit> {
        if let Some(down) = infinite(node) {
            return Ok(Limit::Infinite(down));
        }
        let end = self.value(node)?;
        self.scalar(&end, &node.span).map(Limit::Finite)
    }

    /// Whether both the variable and the upper limit move.
    fn is_along_motion(&mut self, variable: &Node, to: &Limit) -> bool {
        let Limit::Finite(end) = to else { return false };
        self.has_rate(variable) && self.world.moves(&[*end])
    }

    /// Whether a variable is the time, or moves.
    fn has_rate(&mut self, variable: &Node) -> bool {
        if spelling(variable) == "t" || self.is_time(variable) {
            return true;
        }
        // A component of a vector that moves moves.
        let components = self.value(variable).map(|v| v.value.components()).unwrap_or_default();
        self.world.moves(&components)
    }

    fn negative(&mut self, typed: Typed) -> Typed {
        let value = typed.value.map(&mut |e| self.world.graph.neg(e));
        Typed::new(value, format!("(-{})", typed.text))
    }
}

impl World {
    /// A symbol that integrals bind.
    fn bound(&mut self, name: &str, bound: Bound, quantity: Quantity) -> Expr {
        let facts = || Facts { tex: name.to_owned(), quantity: Some(quantity), ..Facts::default() };
        let symbol = self.symbol(name, false, facts);
        self.graph.bind(symbol, bound);
        self.graph.sym(symbol)
    }

    fn moves(&self, es: &[Expr]) -> bool {
        let graph = &self.graph;
        graph.symbols(es).iter().any(|s| graph.info(*s).of_t || graph.info(*s).name == "t")
    }

    /// The variable of an integral that some of these expressions speak of as of another quantity, if there is one: what is
    /// said there holds for the variable, too, and is not known along it.
    pub fn integrated(&self, others: &[Expr]) -> Option<&str> {
        let spoken = self.graph.symbols(others);
        let names = spoken.iter().map(|s| &self.graph.info(self.graph.info(*s).base).name);
        names.into_iter().find_map(|name| self.integrated.get(name)).map(String::as_str)
    }

    /// Whether an expression has the variable of an integral that is still being written out.
    pub(super) fn is_within_integral(&self, e: Expr) -> bool {
        self.graph.has_bound(&[e])
    }
}

/// The integrand behind an integral sign: up to the last differential before the next integral sign, or all of it
/// behind a differential that comes first. None where there is none, or where it is a factor of a product of vectors.
fn integrand(rest: &[Item]) -> Option<Integrand> {
    let next = rest.iter().position(|item| matches!(item, Item::Factor(n) if is_integral(head_and_power(n).0)));
    let own = &rest[..next.unwrap_or(rest.len())];
    let is_op = |item: &Item| matches!(item, Item::Op(..));
    let plain = |items: &[Item]| (!items.iter().any(is_op)).then(|| factors_of(items).into_iter().cloned().collect());
    let pair = |at: usize| match (own.get(at), own.get(at + 1)) {
        (Some(Item::Factor(d)), Some(Item::Factor(x))) if is_d(d) && is_variable(x) => Some((*x).clone()),
        _ => None,
    };
    if let Some(variable) = pair(0).filter(|_| (1..own.len()).all(|k| pair(k).is_none())) {
        // `\int_0^1 dx\, f`
        return Some(Integrand { variable, factors: plain(&own[2..])?, used: own.len() });
    }
    if let Some((at, variable)) = (0..own.len()).rev().find_map(|at| Some((at, pair(at)?))) {
        return Some(Integrand { variable, factors: plain(&own[..at])?, used: at + 2 });
    }
    // `\int_0^1 \frac{dx}{x}`
    own.iter().enumerate().rev().find_map(|(at, item)| {
        let Item::Factor(fraction) = item else { return None };
        let Kind::Frac(above, below) = &fraction.kind else { return None };
        let mut items = Vec::new();
        flatten(above, &mut items);
        let inner = if items.len() > 2 || !items.is_empty() { integrand_above(&items)? } else { return None };
        let above = match inner.1.len() {
            0 => Node::new(Kind::Number("1".into()), above.span.clone()),
            _ => Node::new(Kind::Juxt(inner.1), above.span.clone()),
        };
        let kind = Kind::Frac(Box::new(above), below.clone());
        let mut factors: Vec<Node> = plain(&own[..at])?;
        factors.push(Node::new(kind, fraction.span.clone()));
        Some(Integrand { variable: inner.0, factors, used: at + 1 })
    })
}

/// The variable of a differential at the end, or else at the beginning, of a numerator, and the other factors.
fn integrand_above(items: &[Item]) -> Option<(Node, Vec<Node>)> {
    let factors: Vec<Node> = factors_of(items).into_iter().cloned().collect();
    if factors.len() != items.len() {
        return None;
    }
    match factors.as_slice() {
        [others @ .., d, x] if is_d(d) && is_variable(x) => Some((x.clone(), others.to_vec())),
        [d, x, others @ ..] if is_d(d) && is_variable(x) => Some((x.clone(), others.to_vec())),
        _ => None,
    }
}

/// The d of a differential, whatever a letter d may be elsewhere.
fn is_d(node: &Node) -> bool {
    match &node.kind {
        Kind::Symbol(s) => s == "d",
        Kind::Styled(Font::Roman, body) => matches!(&body.kind, Kind::Symbol(s) if s == "d"),
        _ => false,
    }
}

/// Whether something may be the variable of an integral: a letter, with primes or a subscript.
fn is_variable(node: &Node) -> bool {
    match &node.kind {
        Kind::Symbol(s) => !matches!(s.as_str(), "\\pi" | "\\infty" | "d"),
        Kind::Scripts { base, sup: None, .. } => matches!(&base.kind, Kind::Symbol(_)),
        _ => false,
    }
}

/// Whether a limit is infinity, and then whether it is the negative one.
fn infinite(node: &Node) -> Option<bool> {
    match &node.kind {
        Kind::Symbol(s) => (s == "\\infty").then_some(false),
        Kind::Group { body, .. } => infinite(body),
        Kind::Sum(terms) => match terms.as_slice() {
            [term] if term.sign == Sign::Minus => infinite(&term.node).map(|down| !down),
            [term] if term.sign == Sign::Plus => infinite(&term.node),
            _ => None,
        },
        _ => None,
    }
}

fn letter(name: &str, span: &Span) -> Node {
    Node::new(Kind::Symbol(name.into()), span.clone())
}

#[cfg(test)]
mod tests {
    use super::super::testing::{scope, value};
    use super::*;
    use crate::expr::{Tape, Workspace};

    const SYMBOLS: &str = r"
        [symbols]
        'a, b, d, \tau, Q, C' = { range = [0.5, 2.0] }
        'y' = { range = [0.5, 2.0], of = 't' }
        'F' = { range = [0.5, 2.0], of = 'x' }
        'I' = { same = 'a e^{-t/\tau}', function = ['t'] }
    ";

    /// The values of two formulas at a state.
    fn both(left: &str, right: &str) -> [f64; 2] {
        let mut world = World::new();
        let sides = [left, right].map(|latex| match value(&mut world, &scope(SYMBOLS), latex) {
            Ok(Value::Scalar(e)) => e,
            other => panic!("{latex}: {other:?}"),
        });
        let tape = Tape::compile(&world.graph, &sides);
        let inputs: Vec<f64> = (0..tape.inputs().len()).map(|k| 0.7 + 0.31 * k as f64).collect();
        let mut work = Workspace::default();
        let values = tape.eval(&inputs, &(), &mut work);
        [values[0], values[1]]
    }

    fn equal(left: &str, right: &str) -> bool {
        let [a, b] = both(left, right);
        (a - b).abs() < 1e-11 * (1.0 + a.abs())
    }

    #[test]
    fn definite_integrals() {
        for (integral, known) in [
            (r"\int_0^Q \frac{q}{C} \, dq", r"\frac{Q^2}{2C}"),
            (r"\int_a^b x^2 dx", r"\frac{b^3 - a^3}{3}"),
            (r"\int_0^a dx \, x", r"\frac{a^2}{2}"),
            (r"\int_a^b \frac{dx}{x}", r"\ln b - \ln a"),
            (r"\int_0^a \frac{x \, \mathrm{d}x}{1 + x^2}", r"\frac{1}{2} \ln (1 + a^2)"),
            (r"\int_0^\infty e^{-2t/\tau} dt", r"\frac{\tau}{2}"),
            (r"\int_0^\infty b I^2 dt", r"\frac{a^2 b \tau}{2}"),
            (r"\int_a^\infty \frac{C}{r'^2} \, dr'", r"\frac{C}{a}"),
            (r"\int_{-\infty}^{\infty} e^{-a x^2} dx", r"\sqrt{\pi / a}"),
            (r"\int_{-\infty}^a e^{x} dx", r"e^a"),
            (r"\int_\infty^a \frac{1}{x^2} dx", r"-\frac{1}{a}"),
            (r"\int_0^\pi \sin\theta \, d\theta", "2"),
            (r"\int_0^1 x dx \int_0^1 x^2 dx", r"\frac{1}{6}"),
            (r"2 \int_0^1 x dx \, a", "a"),
            // A quantity d beside the d of the differential.
            (r"\int_0^a d x \, dx", r"\frac{d a^2}{2}"),
            (r"\frac{\partial}{\partial a} \int_0^a e^{-a x^2} dx + \int_0^a x^2 e^{-a x^2} dx", r"e^{-a^3}"),
        ] {
            let [a, b] = both(integral, known);
            println!("{integral}: off by {:.1e}", (a - b).abs() / (1.0 + b.abs()));
            assert!(equal(integral, known), "{integral}: {a}, not {b}");
        }
        // Where the integrand is singular at the upper end, doubles lose half their digits in a² - x².
        let [a, b] = both(r"\int_0^a \frac{dx}{\sqrt{a^2 - x^2}}", r"\frac{\pi}{2}");
        assert!((a - b).abs() < f64::EPSILON.sqrt() * 10.0, "{a}, not {b}");
        assert!(!equal(r"\int_0^Q \frac{q}{C} \, dq", r"\frac{Q^2}{C}"));
        assert!(!equal(r"\int_0^\infty e^{-2t/\tau} dt", r"\tau"));
    }

    #[test]
    fn what_has_no_value_has_none() {
        for integral in [
            r"\int_0^\infty x \, dx",
            r"\int_{-\infty}^\infty x \, dx",
            r"\int_0^1 \frac{dx}{x}",
            r"\int_{-1}^2 \frac{dx}{x}",
        ] {
            assert!(!both(integral, "1")[0].is_finite(), "{integral}");
        }
    }

    #[test]
    fn what_depends_on_the_variable_by_no_formula_is_not_known_along_it() {
        for integral in [r"\int_0^a F \, dx", r"\int_0^a y \, dt", r"\int_0^a \frac{dI}{dt} \, dt"] {
            let found = value(&mut World::new(), &scope(SYMBOLS), integral);
            match found {
                Err(error) => assert!(error.message.contains("formula"), "{integral}: {}", error.message),
                Ok(_) => assert!(!both(integral, "1")[0].is_finite(), "{integral}"),
            }
        }
    }
}
