//! Counterexamples in fractions, without any rounding.
//!
//! An angle whose half has a rational tangent, such as θ = 2 arctan(1/2), has a rational sine and cosine. Where angles occur
//! in sines, cosines and tangents only, and the premises are affine in what they are solved for, a whole state is made of
//! fractions. There premises that follow from each other are seen to vanish exactly, which no interval that has a width can
//! prove. What is not a fraction (a root, an exponential) is undefined here, and proves nothing.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use rug::Rational;

use super::super::decide::satisfies;
use super::super::random::Decimal;
use super::super::sampling::Sampler;
use super::super::system::{Source, State};
use super::super::verdict::{Certificate, Enclosure, ExactValue};
use super::{Claimed, allowed, bracket};
use crate::expr::{Expr, Graph, Node, SymId};
use crate::number::{Func, Interval, Number};

/// The denominators that are tried for the tangents of half angles, one after another.
const DENOMINATORS: [u32; 6] = [2, 1, 3, 4, 5, 8];

/// The most bits that a fraction may have.
const MOST_BITS: u32 = 20_000;
/// The largest multiple of an angle, and the largest power.
const LARGEST: u32 = 64;
/// The most characters of a fraction that is shown as one.
const LONGEST: usize = 9;
/// The bits of the intervals that longer fractions are shown as.
const BITS: u32 = 64;

/// A certificate in fractions, at a state near a given one.
pub fn certificate(sampler: &Sampler, state: &State, claimed: &Claimed, idle: &[SymId]) -> Option<Certificate> {
    let exact = Exact::new(sampler);
    let time_is_left = |_: &&u32| !sampler.deadline().has_passed();
    DENOMINATORS.iter().take_while(time_is_left).find_map(|d| exact.attempt(state, claimed, idle, *d))
}

/// The value of an expression.
#[derive(Clone, Debug)]
enum Value {
    Number(Rational),
    /// Known by its sine and cosine.
    Angle(Rational, Rational),
}

/// What is to be evaluated.
struct Exact<'s, 'c> {
    sampler: &'s Sampler<'c>,
    /// Everything that the premises are made of, operands first.
    premises: Vec<Expr>,
    /// Everything that the sides are made of.
    sides: Vec<Expr>,
    /// The symbols that occur in sines and cosines.
    angles: BTreeSet<SymId>,
}

type Values = HashMap<Expr, Value>;

impl<'s, 'c> Exact<'s, 'c> {
    fn new(sampler: &'s Sampler<'c>) -> Self {
        let graph = &sampler.claim.world.graph;
        let sides: Vec<Expr> =
            sampler.claim.branches.iter().flatten().flat_map(|p| [p.residual, p.lhs, p.rhs]).collect();
        let (premises, sides) = (graph.reachable(&sampler.claim.premises.residuals), graph.reachable(&sides));
        let turned = premises.iter().chain(&sides).filter_map(|e| match *graph.node(*e) {
            Node::Call(Func::Sin | Func::Cos | Func::Tan, a) => Some(a),
            _ => None,
        });
        let turned: Vec<Expr> = turned.collect();
        Exact { sampler, premises, sides, angles: graph.symbols(&turned) }
    }

    /// The certificate at a state whose half angles have tangents of this denominator.
    fn attempt(&self, state: &State, claimed: &Claimed, idle: &[SymId], denominator: u32) -> Option<Certificate> {
        let world = &self.sampler.claim.world;
        let mut known = BTreeMap::new();
        let mut shown = Vec::new();
        let mut at = vec![Interval::invalid(BITS); self.sampler.system.symbols];
        for (source, value) in self.sampler.system.free.iter().zip(&state.free) {
            let (value, enclosure, text) = match self.angles.contains(&source.symbol) {
                true => angle(source, *value, denominator)?,
                false => number(*value),
            };
            at[source.symbol.index()] = enclosure;
            known.insert(source.symbol, value);
            let (symbol, idle) = (world.tex(source.symbol), idle.contains(&source.symbol));
            shown.push(ExactValue { symbol, value: text, idle });
        }
        let solved = self.solve(&mut known)?;
        for (symbol, value) in &known {
            if let Value::Number(x) = value {
                at[symbol.index()] = Interval::from_rational(x, BITS);
            }
        }
        allowed(self.sampler, &at, BITS).ok()?;
        Some(Certificate { bits: None, state: shown, solved, differences: self.differences(&known, claimed)? })
    }

    /// Solves the premises, all of them, for the unknowns, by elimination.
    fn solve(&self, known: &mut BTreeMap<SymId, Value>) -> Option<Vec<Enclosure>> {
        let unknowns: Vec<SymId> = self.sampler.system.unknowns.iter().map(|u| u.symbol).collect();
        for u in &unknowns {
            known.insert(*u, Value::Number(Rational::new()));
        }
        let origin = self.residuals(known)?;
        let mut rows: Vec<Vec<Rational>> = vec![Vec::new(); origin.len()];
        for u in &unknowns {
            known.insert(*u, Value::Number(Rational::from(1)));
            for ((row, moved), start) in rows.iter_mut().zip(self.residuals(known)?).zip(&origin) {
                row.push(moved - start);
            }
            known.insert(*u, Value::Number(Rational::new()));
        }
        rows.iter_mut().zip(origin).for_each(|(row, start)| row.push(-start));
        let solution = eliminate(rows, unknowns.len())?;
        for (u, x) in unknowns.iter().zip(&solution) {
            known.insert(*u, Value::Number(x.clone()));
        }
        // That the premises are affine was assumed; that they hold is seen here.
        if self.residuals(known)?.iter().any(|r| !r.is_zero()) {
            return None;
        }
        self.sampler.system.unknowns.iter().zip(&solution).map(|(u, x)| self.unknown(u, x)).collect()
    }

    /// An unknown as it is shown, where it has the sign that its range declares.
    fn unknown(&self, source: &Source, x: &Rational) -> Option<Enclosure> {
        let negative = source.range[0] >= 0.0 && *x < 0;
        let positive = source.range[1] <= 0.0 && *x > 0;
        if source.declared && (negative || positive) {
            return None;
        }
        let idle = !self.sampler.tape.inputs().contains(&source.symbol);
        shown(Some(self.sampler.claim.world.tex(source.symbol)), x, idle)
    }

    fn residuals(&self, known: &BTreeMap<SymId, Value>) -> Option<Vec<Rational>> {
        let values = evaluate(&self.sampler.claim.world.graph, &self.premises, known);
        self.sampler.claim.premises.residuals.iter().map(|r| rational(&values, *r).cloned()).collect()
    }

    /// The differences that refute the claim, one for each sign of ±.
    fn differences(&self, known: &BTreeMap<SymId, Value>, claimed: &Claimed) -> Option<Vec<Enclosure>> {
        let values = evaluate(&self.sampler.claim.world.graph, &self.sides, known);
        let mut all = Vec::new();
        for branch in &self.sampler.claim.branches {
            if !branch.iter().all(|p| [p.lhs, p.rhs, p.residual].iter().all(|e| rational(&values, *e).is_some())) {
                return None;
            }
            let refuted = branch.iter().find_map(|pair| {
                let difference = rational(&values, pair.residual)?;
                let refutes = match claimed {
                    Claimed::Equal => !difference.is_zero(),
                    Claimed::Ordered(rel, None) => !satisfies(*rel, difference.cmp0() as i32),
                    Claimed::Ordered(_, Some(_)) => false,
                };
                refutes.then_some((pair, difference))
            });
            let (pair, difference) = refuted?;
            all.push(shown(pair.name.clone(), difference, false)?);
        }
        Some(all)
    }
}

/// A fraction as it is shown: itself where it is short, otherwise between decimals.
fn shown(name: Option<String>, x: &Rational, idle: bool) -> Option<Enclosure> {
    let text = x.to_string();
    if text.len() > LONGEST {
        return bracket(name, &Interval::from_rational(x, BITS), idle);
    }
    Some(Enclosure { name, low: text.clone(), high: text, idle })
}

fn number(value: Decimal) -> (Value, Interval, String) {
    let value = Rational::from((value.num, value.den));
    let (enclosure, text) = (Interval::from_rational(&value, BITS), value.to_string());
    (Value::Number(value), enclosure, text)
}

/// The angle near a given one whose half has a tangent of a given denominator, if it is in its range.
fn angle(source: &Source, near: Decimal, denominator: u32) -> Option<(Value, Interval, String)> {
    let tangent = (near.to_f64() / 2.0).tan() * f64::from(denominator);
    let t = Rational::from((Rational::from_f64(tangent.round())?.numer().clone(), denominator));
    let half = Interval::from_rational(&t, BITS).apply(Func::Atan);
    let whole = half.plus(&half);
    let within = *whole.lo() >= source.range[0] && *whole.hi() <= source.range[1];
    if source.declared && !within || source.integer {
        return None;
    }
    let square = t.clone().square();
    let length = Rational::from(1 + &square);
    let (sin, cos) = (Rational::from(&t * 2) / &length, (1 - square) / length);
    let text = if t.is_zero() { "0".into() } else { format!("2 arctan({t})") };
    Some((Value::Angle(sin, cos), whole, text))
}

fn rational(values: &Values, e: Expr) -> Option<&Rational> {
    match values.get(&e) {
        Some(Value::Number(x)) => Some(x),
        _ => None,
    }
}

/// The values of expressions given operands first; those that are undefined or no fractions are left out.
fn evaluate(graph: &Graph, order: &[Expr], known: &BTreeMap<SymId, Value>) -> Values {
    let mut values = Values::with_capacity(order.len());
    for e in order {
        if let Some(value) = value(graph.node(*e), &values, known).filter(is_small) {
            values.insert(*e, value);
        }
    }
    values
}

fn is_small(value: &Value) -> bool {
    let bits = |x: &Rational| x.numer().significant_bits().max(x.denom().significant_bits());
    match value {
        Value::Number(x) => bits(x) <= MOST_BITS,
        Value::Angle(sin, cos) => bits(sin).max(bits(cos)) <= MOST_BITS,
    }
}

fn value(node: &Node, values: &Values, known: &BTreeMap<SymId, Value>) -> Option<Value> {
    use Value::{Angle, Number};
    let at = |e: Expr| values.get(&e);
    let number = |e: Expr| rational(values, e);
    Some(match *node {
        Node::Rational(n, d) => Number(Rational::from((n, d))),
        Node::Symbol(s) => known.get(&s)?.clone(),
        Node::Neg(a) => match at(a)? {
            Number(x) => Number(Rational::from(-x)),
            Angle(sin, cos) => Angle(Rational::from(-sin), cos.clone()),
        },
        Node::Add(a, b) => match (at(a)?, at(b)?) {
            (Number(x), Number(y)) => Number(Rational::from(x + y)),
            (Angle(s, c), Angle(t, d)) => turned((s, c), (t, d)),
            _ => return None,
        },
        Node::Sub(a, b) => match (at(a)?, at(b)?) {
            (Number(x), Number(y)) => Number(Rational::from(x - y)),
            (Angle(s, c), Angle(t, d)) => turned((s, c), (&Rational::from(-t), d)),
            _ => return None,
        },
        Node::Mul(a, b) => match (at(a)?, at(b)?) {
            (Number(x), Number(y)) => Number(Rational::from(x * y)),
            (Number(n), Angle(s, c)) | (Angle(s, c), Number(n)) => multiple(n, s, c)?,
            _ => return None,
        },
        Node::Div(a, b) => Number(Rational::from(number(a)? / divisor(number(b)?)?)),
        Node::PowI(a, n) if n.unsigned_abs() <= LARGEST => {
            let base = if n < 0 { divisor(number(a)?)? } else { number(a)? };
            Number(rug::ops::Pow::pow(base, n).into())
        }
        Node::Call(Func::Sin, a) => Number(sine_cosine(at(a)?)?.0),
        Node::Call(Func::Cos, a) => Number(sine_cosine(at(a)?)?.1),
        Node::Call(Func::Tan, a) => {
            let (sin, cos) = sine_cosine(at(a)?)?;
            Number(sin / divisor(&cos)?)
        }
        Node::Call(Func::Abs, a) => Number(number(a)?.clone().abs()),
        Node::Call(Func::Sign, a) => Number(Rational::from(number(a)?.cmp0() as i32)),
        _ => return None,
    })
}

/// What may be divided by.
fn divisor(x: &Rational) -> Option<&Rational> {
    (!x.is_zero()).then_some(x)
}

fn sine_cosine(value: &Value) -> Option<(Rational, Rational)> {
    match value {
        Value::Angle(sin, cos) => Some((sin.clone(), cos.clone())),
        Value::Number(x) if x.is_zero() => Some((Rational::new(), Rational::from(1))),
        Value::Number(_) => None,
    }
}

/// The sum of two angles.
fn turned((s, c): (&Rational, &Rational), (t, d): (&Rational, &Rational)) -> Value {
    Value::Angle(Rational::from(s * d) + Rational::from(c * t), Rational::from(c * d) - Rational::from(s * t))
}

/// A whole multiple of an angle.
fn multiple(n: &Rational, s: &Rational, c: &Rational) -> Option<Value> {
    let count = n.numer().clone().abs().to_u32().filter(|k| *k <= LARGEST && n.is_integer())?;
    let s = if *n < 0 { Rational::from(-s) } else { s.clone() };
    let mut sum = (Rational::new(), Rational::from(1));
    for _ in 0..count {
        let Value::Angle(sin, cos) = turned((&sum.0, &sum.1), (&s, c)) else { return None };
        sum = (sin, cos);
    }
    Some(Value::Angle(sum.0, sum.1))
}

/// The solution of linear equations, whose last column is the right side, where it is unique.
fn eliminate(mut rows: Vec<Vec<Rational>>, columns: usize) -> Option<Vec<Rational>> {
    for c in 0..columns {
        let p = (c..rows.len()).find(|r| !rows[*r][c].is_zero())?;
        rows.swap(c, p);
        let pivot = rows[c][c].clone();
        rows[c].iter_mut().for_each(|x| *x /= &pivot);
        let top = rows[c].clone();
        for (_, row) in rows.iter_mut().enumerate().filter(|(r, _)| *r != c) {
            let factor = row[c].clone();
            if !factor.is_zero() {
                row.iter_mut().zip(&top).for_each(|(x, y)| *x -= Rational::from(&factor * y));
            }
        }
    }
    rows.iter().take(columns).map(|row| row.last().cloned()).collect()
}
