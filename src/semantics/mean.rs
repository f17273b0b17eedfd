//! Means over angles, `\langle F \rangle_{\ell, g}`: the mean of F while each of the angles runs through a turn.
//!
//! Of a trigonometric polynomial of degree n in an angle the mean over N > n equidistant angles is exact, and that is how it is
//! built: F is written out at each of them. The degree is read off the formula. Of any other F the mean over N equidistant
//! angles is the trapezoidal rule, whose error falls as ρ^N where F is periodic and analytic (Davis 1959; Trefethen and
//! Weideman 2014). It is built with [`POINTS`] angles, and a state is refused unless a quarter and a half as many differ by less
//! than [`DIFFERENCE`] there: then ρ^(N/4) is below it, and the error of the whole below its fourth power, but for a factor of
//! order one. What is not periodic converges as 1/N at best, and is refused at every state.

use std::collections::HashMap;

use crate::expr::{Expr, Func, Graph, Node as Op, SymId};
use crate::latex::ast::{Kind, Node, Span};

use super::elaborate::{Elaborator, Typed};
use super::error::{Error, Result};
use super::value::Value;

/// The highest degree that is averaged: each point writes the formula out once more.
const HIGHEST_DEGREE: u32 = 40;

/// The points of the mean of what is no trigonometric polynomial.
const POINTS: i64 = 96;

/// How far the means over a quarter and over half of the points may differ at a state, against 1 plus their size.
const DIFFERENCE: i128 = 10_000_000_000_000; // as a reciprocal: 1e-13

impl Elaborator<'_> {
    /// `\langle F \rangle_{a, b}`.
    pub(super) fn mean(&mut self, body: &Node, angles: &Node, span: &Span) -> Result<Typed> {
        let names: Vec<&Node> = match &angles.kind {
            Kind::List(items) => items.iter().collect(),
            _ => vec![angles],
        };
        let inner = self.value(body)?;
        let mut e = self.scalar(&inner, span)?;
        for name in names {
            let typed = self.value(name)?;
            let angle = self.scalar(&typed, span)?;
            let Op::Symbol(angle) = *self.world.graph.node(angle) else {
                return Err(Error::unsupported(format!("a mean over {}, which is no symbol", typed.text), span));
            };
            e = match degree(&self.world.graph, e, angle, &mut HashMap::new()) {
                Some(degree) => mean(&mut self.world.graph, e, angle, i64::from(degree) + 1),
                None => self.smooth_mean(e, angle),
            };
            self.world.check(span)?;
        }
        Ok(Typed::new(Value::Scalar(e), format!("mean({})", inner.text)))
    }

    /// The mean of what is no trigonometric polynomial, with the condition under which it is precise.
    fn smooth_mean(&mut self, e: Expr, angle: SymId) -> Expr {
        let graph = &mut self.world.graph;
        let [quarter, half, whole] = [POINTS / 4, POINTS / 2, POINTS].map(|points| mean(graph, e, angle, points));
        let difference = graph.sub(quarter, half);
        let (difference, size) = (graph.call(Func::Abs, difference), graph.call(Func::Abs, half));
        let (one, part) = (graph.int(1), graph.ratio(1, DIFFERENCE));
        let size = graph.add(one, size);
        let allowed = graph.mul(part, size);
        let precise = graph.sub(allowed, difference);
        self.world.precise.push(precise);
        whole
    }
}

/// The mean of an expression over so many equidistant values of an angle.
fn mean(graph: &mut Graph, e: Expr, angle: SymId, points: i64) -> Expr {
    if points <= 1 {
        return e;
    }
    let (pi, count) = (graph.pi(), graph.int(points));
    let mut total = graph.int(0);
    for k in 0..points {
        let turned = graph.ratio(i128::from(2 * k), i128::from(points));
        let value = graph.mul(turned, pi);
        let term = graph.substitute(e, &HashMap::from([(angle, value)]));
        total = graph.add(total, term);
    }
    graph.div(total, count)
}

/// The degree of an expression as a polynomial of sines and cosines of an angle; `None` where it is none.
fn degree(graph: &Graph, e: Expr, angle: SymId, known: &mut HashMap<Expr, Option<u32>>) -> Option<u32> {
    if let Some(found) = known.get(&e) {
        return *found;
    }
    let mut of = |e: &Expr| degree(graph, *e, angle, known);
    let found = match *graph.node(e) {
        Op::Symbol(s) => (s != angle).then_some(0),
        Op::Add(a, b) | Op::Sub(a, b) => of(&a).and_then(|x| Some(x.max(of(&b)?))),
        Op::Mul(a, b) => of(&a).and_then(|x| x.checked_add(of(&b)?)),
        Op::Neg(a) => of(&a),
        Op::Div(a, b) => of(&b).filter(|d| *d == 0).and(of(&a)),
        Op::PowI(a, n) => match (of(&a)?, u32::try_from(n)) {
            (0, _) => Some(0),
            (d, Ok(n)) => d.checked_mul(n),
            _ => None,
        },
        Op::Call(Func::Sin | Func::Cos, a) => of(&a).or_else(|| multiple(graph, a, angle).map(|k| k.unsigned_abs())),
        _ => (!graph.symbols(&[e]).contains(&angle)).then_some(0),
    };
    let found = found.filter(|d| *d <= HIGHEST_DEGREE);
    known.insert(e, found);
    found
}

/// The k of an argument kx + c with an angle x and c without it.
fn multiple(graph: &Graph, e: Expr, angle: SymId) -> Option<i32> {
    if !graph.symbols(&[e]).contains(&angle) {
        return Some(0);
    }
    match *graph.node(e) {
        Op::Symbol(_) => Some(1),
        Op::Neg(a) => multiple(graph, a, angle)?.checked_neg(),
        Op::Add(a, b) => multiple(graph, a, angle)?.checked_add(multiple(graph, b, angle)?),
        Op::Sub(a, b) => multiple(graph, a, angle)?.checked_sub(multiple(graph, b, angle)?),
        Op::Mul(a, b) => {
            let (factor, rest) = if graph.as_rational(a).is_some() { (a, b) } else { (b, a) };
            match graph.as_rational(factor)? {
                (n, 1) => multiple(graph, rest, angle)?.checked_mul(i32::try_from(n).ok()?),
                _ => None,
            }
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use crate::expr::{Tape, Workspace};
    use crate::semantics::testing::{scope, value};
    use crate::semantics::{Value, World};

    const SYMBOLS: &str = "[symbols]\n'x, y' = { unit = 'rad' }\n'a' = { range = [0.5, 2.0] }";

    fn number(latex: &str) -> f64 {
        let mut world = World::new();
        let Value::Scalar(e) = value(&mut world, &scope(SYMBOLS), latex).unwrap() else { panic!("no scalar") };
        let tape = Tape::compile(&world.graph, &[e]);
        assert!(tape.inputs().len() <= 1, "{latex}");
        tape.eval::<f64>(&vec![1.5; tape.inputs().len()], &(), &mut Workspace::default())[0]
    }

    #[test]
    fn means_of_trigonometric_polynomials_are_exact() {
        for (latex, expected) in [
            (r"\langle \sin^2 x \rangle_x", 0.5),
            (r"\langle \cos^4 x \rangle_{x}", 3.0 / 8.0),
            (r"\langle \cos^2(3x + 2y) \cos x \rangle_{x}", 0.0),
            (r"\langle \cos(2x - y) \cos(2x - y + a) \rangle_{x, y}", 0.5 * 1.5_f64.cos()),
            (r"\langle a^2 \rangle_x", 2.25),
        ] {
            assert!((number(latex) - expected).abs() < 1e-14, "{latex}: {}", number(latex));
        }
    }

    /// Whether the mean is precise, and its value.
    fn smooth(latex: &str) -> (bool, f64) {
        let mut world = World::new();
        let Value::Scalar(e) = value(&mut world, &scope(SYMBOLS), latex).unwrap() else { panic!("no scalar") };
        let [precise] = world.precise() else { panic!("{latex}") };
        let tape = Tape::compile(&world.graph, &[*precise, e]);
        let values = tape.eval::<f64>(&[], &(), &mut Workspace::default()).to_vec();
        (values[0] > 0.0, values[1])
    }

    #[test]
    fn other_means_are_precise_or_refused() {
        let (precise, mean) = smooth(r"\langle \frac{1}{4 + \cos x} \rangle_x");
        assert!(precise && (mean - 1.0 / 15.0_f64.sqrt()).abs() < 1e-15, "{mean}");
        let (precise, mean) = smooth(r"\langle \cos(x - \frac{1}{2} \sin x) \rangle_x");
        assert!(precise && (mean - 0.242_268_457_674_873_9).abs() < 1e-14, "J_1(1/2): {mean}");
        for latex in [
            r"\langle x \rangle_x",
            r"\langle \sin^2 \frac{x}{3} \rangle_x",
            r"\langle \frac{1}{\frac{11}{10} + \cos x} \rangle_x",
        ] {
            assert!(!smooth(latex).0, "{latex}");
        }
    }
}
