//! Expressions at random points of the field of 2^61 - 1 elements: exact tests of algebraic and trigonometric
//! identities.
//!
//! Promises. Where the residual of a statement vanishes as a rational function of what is drawn here, the statement
//! holds for real numbers wherever it is defined, because everything is drawn more freely than it really is:
//!
//! - A symbol is a variable. Sine and cosine of an angle are a random point of the circle, given by the tangent t of
//!   half the angle: cos = (1 - t²)/(1 + t²), sin = 2t/(1 + t²). A symbol that stands within and outside a sine, as in
//!   θ cos θ, is independent of its sine: θ and tan(θ/2) are algebraically independent over the rational numbers, so that
//!   a rational identity in both holds only if it holds with independent variables. The same is true of the monomials
//!   that the arguments consist of (Ax's theorem on exponentials).
//! - A square root has both signs: a statement is tested with every choice of signs, and holds only if it does with all.
//!   Then the coefficients of all products of roots vanish, whichever roots depend on each other.
//! - π is a variable, since it is transcendental, but for the exact rotations by whole and half multiples of it.
//! - sn, cn and dn of the same argument and modulus are a random point of the curve sn² + cn² = 1, dn² = 1 - k² sn²:
//!   again more freely than they are, since sn is independent of u and k. The root dn is the one that is a square; the
//!   other one is its conjugate, so that what vanishes with one does with both.
//! - Anything else (exp, ln, |x|, inverse functions, powers with variable exponents, e) is a variable of its own for each
//!   argument. Identities hold a fortiori, but that they fail says nothing: see [`Field::meaningless`].
//!
//! The chance of a false zero. A polynomial of degree d that is not zero vanishes at a random point with a chance of at
//! most d/p (Schwartz and Zippel); each [`Element`] carries bounds on the degrees of the rational function it is a value
//! of. Sine and cosine count 2 each and no denominator: what the polynomial is multiplied by to be one in the tangents is
//! a power of 1 + t², which never vanishes; of k angles each has at most the whole degree, which makes (k+1)d in all,
//! [`Field::total_degree`]. The prime is fixed: should it divide every coefficient of the residual, nothing is seen. No
//! formula that was not made for the purpose has such coefficients.

mod angle;
mod degree;
#[cfg(test)]
mod tests;

pub use degree::{Degree, Element, uniform};

use super::graph::{Expr, Graph, Node, SymId};
use crate::number::{Elliptic, F61, Func};
use angle::Angles;
use rustc_hash::FxHashMap as HashMap;
use std::collections::BTreeSet;

/// Expressions to be evaluated in the field.
pub struct Field<'g> {
    graph: &'g Graph,
    /// What the expressions are made of, operands first, but for the arguments of functions.
    order: Vec<Expr>,
    angles: Angles,
    /// Square roots, in order.
    roots: Vec<Expr>,
    /// What has no meaning in the field, in order.
    meaningless: Vec<Expr>,
    /// The arguments and moduli of sn, cn and dn, in order.
    curves: Vec<(Expr, Expr)>,
}

/// A point at which to evaluate.
#[derive(Clone, Debug)]
pub struct Point {
    /// The symbols' values, by their numbers.
    pub symbols: Vec<Element>,
    /// Cosine and sine of the arguments.
    rotations: HashMap<Expr, (Element, Element)>,
    /// sn and cn, by argument and modulus.
    curves: HashMap<(Expr, Expr), (Element, Element)>,
    /// π and what has no meaning in the field.
    others: HashMap<Expr, Element>,
}

/// The values of expressions at a point; none where an expression is not defined (division by zero, no square root).
pub struct Values {
    values: Vec<Option<Element>>,
}

impl Values {
    /// The value of an expression.
    pub fn at(&self, e: Expr) -> Option<Element> {
        self.values.get(e.index()).copied().flatten()
    }
}

impl<'g> Field<'g> {
    /// Makes ready to evaluate expressions of a graph.
    pub fn new(graph: &'g Graph, es: &[Expr]) -> Self {
        let order = algebraic_part(graph, es);
        let argument = |e: &Expr| match *graph.node(*e) {
            Node::Call(Func::Sin | Func::Cos | Func::Tan, a) => Some(a),
            _ => None,
        };
        let arguments: BTreeSet<Expr> = order.iter().filter_map(argument).collect();
        let arguments: Vec<Expr> = arguments.into_iter().collect();
        let curves: BTreeSet<_> = order.iter().filter_map(|e| on_curve(graph.node(*e))).map(|(_, at)| at).collect();
        let some = |wanted: fn(&Node) -> bool| order.iter().copied().filter(|e| wanted(graph.node(*e))).collect();
        Field {
            angles: Angles::new(graph, &arguments),
            roots: some(|n| matches!(n, Node::Sqrt(_))),
            meaningless: some(is_meaningless),
            curves: curves.into_iter().collect(),
            graph,
            order,
        }
    }

    /// The number of square roots, each of which has two signs.
    pub fn roots(&self) -> usize {
        self.roots.len()
    }

    /// What has no meaning in the field among what the expressions are made of, in words: `exp`, `a power`.
    pub fn meaningless(&self) -> Vec<&'static str> {
        let mut words: Vec<&str> = self.meaningless.iter().map(|e| word(self.graph.node(*e))).collect();
        if self.angles.opaque {
            words.push("an angle that is no polynomial");
        }
        words.sort_unstable();
        words.dedup();
        words
    }

    /// The symbols within the arguments of sines and cosines and of what has no meaning in the field.
    pub fn bound_symbols(&self) -> BTreeSet<SymId> {
        let within: Vec<Expr> = self.angles.turns.keys().chain(&self.meaningless).copied().collect();
        self.graph.symbols(&within)
    }

    /// The degree to be divided by the number of elements, of an expression with this degree.
    pub fn total_degree(&self, degree: Degree) -> u64 {
        degree.num.saturating_mul(1 + (self.angles.atoms + self.curves.len()) as u64).max(1)
    }

    /// Draws a point from a source of random bits.
    pub fn draw(&self, random: &mut dyn FnMut() -> u64) -> Point {
        let mut variable = || Element::variable(uniform(random));
        let symbols = (0..self.graph.symbol_count()).map(|_| variable()).collect();
        let pi = self.order.iter().filter(|e| *self.graph.node(**e) == Node::Pi);
        let others = self.meaningless.iter().chain(pi).map(|e| (*e, variable())).collect();
        let atoms: Vec<_> = (0..self.angles.atoms).filter_map(|_| F61::sin_cos(uniform(random))).collect();
        let rotation = |turn: &angle::Turn| {
            turn.multiples.iter().fold(degree::quarters(turn.quarters), |r, (atom, n)| {
                let (s, c) = atoms[*atom];
                degree::turned(r, degree::multiple((c, s), *n))
            })
        };
        let rotations = self.angles.turns.iter().map(|(e, turn)| {
            let degree = Degree::polynomial(turn.degree());
            let (c, s) = rotation(turn);
            (*e, (Element { value: c, degree }, Element { value: s, degree }))
        });
        let curves = self.curves.iter().filter_map(|at| {
            let (s, c) = F61::sin_cos(uniform(random))?;
            let degree = Degree::polynomial(2);
            Some((*at, (Element { value: s, degree }, Element { value: c, degree })))
        });
        let rotations = rotations.collect();
        Point { symbols, rotations, curves: curves.collect(), others }
    }

    /// The values at a point. Bit n of `signs` is the sign of the root number n.
    pub fn eval(&self, point: &Point, signs: u32) -> Values {
        let mut values = vec![None; self.graph.len()];
        let mut root = 0;
        for &e in &self.order {
            values[e.index()] = match *self.graph.node(e) {
                Node::Sqrt(a) => {
                    root += 1;
                    let negative = signs.checked_shr(root - 1).is_some_and(|bits| bits & 1 == 1);
                    let value: Option<Element> = values[a.index()].and_then(Element::sqrt);
                    if negative { value.map(Element::negated) } else { value }
                }
                node => self.apply(e, node, point, &values),
            };
        }
        Values { values }
    }

    fn apply(&self, e: Expr, node: Node, point: &Point, values: &[Option<Element>]) -> Option<Element> {
        let of = |a: Expr| values[a.index()];
        match node {
            Node::Rational(n, d) => F61::from_ratio(n, d).map(Element::constant),
            Node::Symbol(s) => point.symbols.get(s.index()).copied(),
            Node::Neg(a) => of(a).map(Element::negated),
            Node::Add(a, b) => Some(of(a)?.plus(of(b)?)),
            Node::Sub(a, b) => Some(of(a)?.minus(of(b)?)),
            Node::Mul(a, b) => Some(of(a)?.times(of(b)?)),
            Node::Div(a, b) => of(a)?.over(of(b)?),
            Node::PowI(a, n) => of(a)?.powi(n),
            Node::Call(Func::Cos, a) => point.rotations.get(&a).map(|(c, _)| *c),
            Node::Call(Func::Sin, a) => point.rotations.get(&a).map(|(_, s)| *s),
            Node::Call(Func::Tan, a) => point.rotations.get(&a).and_then(|(c, s)| s.over(*c)),
            _ => match on_curve(&node) {
                Some((f, at)) => on_point(f, *point.curves.get(&at)?, of(at.1)),
                None => point.others.get(&e).copied(),
            },
        }
    }
}

/// What the expressions are made of, operands first, but for the arguments of functions.
fn algebraic_part(graph: &Graph, es: &[Expr]) -> Vec<Expr> {
    let mut order: BTreeSet<Expr> = es.iter().copied().collect();
    let mut queue: Vec<Expr> = order.iter().copied().collect();
    while let Some(e) = queue.pop() {
        let node = graph.node(e);
        if let Some((_, (_, modulus))) = on_curve(node) {
            queue.extend(Some(modulus).filter(|k| order.insert(*k)));
        } else if !is_meaningless(node) && !matches!(node, Node::Call(..)) {
            queue.extend(node.operands().filter(|a| order.insert(*a)));
        }
    }
    order.into_iter().collect()
}

/// One of sn, cn and dn, with its argument and modulus.
fn on_curve(node: &Node) -> Option<(Elliptic, (Expr, Expr))> {
    match *node {
        Node::Elliptic(f @ (Elliptic::Sn | Elliptic::Cn | Elliptic::Dn), [u, k, ..]) => Some((f, (u, k))),
        _ => None,
    }
}

/// Its value at the point (sn, cn) for the modulus k.
fn on_point(f: Elliptic, (sn, cn): (Element, Element), k: Option<Element>) -> Option<Element> {
    match f {
        Elliptic::Sn => Some(sn),
        Elliptic::Cn => Some(cn),
        _ => Element::int(1).minus(k?.times(sn).powi(2)?).sqrt(),
    }
}

fn is_meaningless(node: &Node) -> bool {
    match node {
        Node::E | Node::Pow(..) | Node::Atan2(..) | Node::Elliptic(..) | Node::Integral(_) => true,
        Node::Call(f, _) => !matches!(f, Func::Sin | Func::Cos | Func::Tan),
        _ => false,
    }
}

fn word(node: &Node) -> &'static str {
    match node {
        Node::Call(f, _) => f.name(),
        Node::Pow(..) => "a power with a variable exponent",
        Node::Atan2(..) => "atan2",
        Node::Elliptic(..) => "an elliptic function",
        Node::Integral(_) => "an integral",
        Node::E => "e",
        _ => "π",
    }
}
