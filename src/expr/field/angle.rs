//! The angles in the arguments of sines, cosines and tangents, made commensurable.
//!
//! Every argument is written as a sum of monomials (θ, ψ, ω't, 1/2 a t²) with rational coefficients. Each monomial is an
//! atom, whose sine and cosine are independent of those of the others; the atom is divided by the common denominator of
//! its coefficients, so that every argument is a sum of integer multiples, and the addition theorems hold by
//! construction. Whole and half multiples of π are exact; other fractions of π are an atom like any other. What is no
//! sum of monomials is an atom as a whole.

use rustc_hash::FxHashMap as HashMap;
use std::collections::BTreeMap;

use crate::expr::graph::{Expr, Graph, Node};
use crate::expr::ratio::{self, Ratio};

/// The most terms of an argument, and the most factors of a term.
const MOST: usize = 16;

/// Powers of expressions that are not taken apart further, in order.
type Monomial = Vec<(Expr, i32)>;

/// Monomials with their coefficients, none of which is zero.
type Sum = BTreeMap<Monomial, Ratio>;

/// An argument: integer multiples of atoms (by their number), and quarter turns.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Turn {
    pub multiples: Vec<(usize, i64)>,
    pub quarters: u8,
}

impl Turn {
    /// The degree of its sine and cosine, where those of an atom count 2: that of the tangent of the half angle.
    pub fn degree(&self) -> u64 {
        self.multiples.iter().fold(0, |d, (_, n)| d.saturating_add(n.unsigned_abs().saturating_mul(2)))
    }
}

/// The arguments, by the expressions that they are.
#[derive(Clone, Debug, Default)]
pub(super) struct Angles {
    pub atoms: usize,
    pub turns: BTreeMap<Expr, Turn>,
    /// Whether an atom is anything but a product of powers of symbols (a fraction of π, the angle 1, a root): it may have
    /// relations that are not seen.
    pub opaque: bool,
}

impl Angles {
    pub fn new(graph: &Graph, arguments: &[Expr]) -> Self {
        let sums = sums(graph, arguments);
        let mut angles = Angles::default();
        let mut parts: Vec<(Expr, Sum, u8)> = Vec::new();
        let mut denominators: BTreeMap<Monomial, i128> = BTreeMap::new();
        for &e in arguments {
            let mut sum = sums.get(&e).cloned().unwrap_or_else(|| alone(e));
            let quarters = take_quarters(graph, &mut sum);
            if sum.iter().any(|(m, (_, d))| lcm(denominators.get(m).copied().unwrap_or(1), *d).is_none()) {
                sum = alone(e);
            }
            for (m, (_, d)) in &sum {
                let common = denominators.entry(m.clone()).or_insert(1);
                *common = lcm(*common, *d).unwrap_or(*common);
                angles.opaque |= m.is_empty() || m.iter().any(|(e, _)| !matches!(graph.node(*e), Node::Symbol(_)));
            }
            parts.push((e, sum, quarters));
        }
        let number: HashMap<&Monomial, usize> = denominators.keys().enumerate().map(|(k, m)| (m, k)).collect();
        angles.atoms = denominators.len();
        for (e, sum, quarters) in &parts {
            let multiples = sum.iter().filter_map(|(m, (n, d))| {
                let multiple = n.checked_mul(denominators.get(m)? / d)?;
                Some((*number.get(m)?, i64::try_from(multiple).ok()?))
            });
            let turn = Turn { multiples: multiples.collect(), quarters: *quarters };
            // What does not fit is an atom of its own.
            if turn.multiples.len() == sum.len() {
                angles.turns.insert(*e, turn);
            } else {
                angles.turns.insert(*e, Turn { multiples: vec![(angles.atoms, 1)], quarters: 0 });
                angles.atoms += 1;
                angles.opaque = true;
            }
        }
        angles
    }
}

/// The least common multiple, below 2^20: beyond it the degrees would be of no use.
fn lcm(a: i128, b: i128) -> Option<i128> {
    let (a, b) = (a.checked_abs()?, b.checked_abs()?);
    let (_, rest) = ratio::reduce(a, b)?;
    Some(a.checked_mul(rest)?).filter(|m| *m < 1 << 20)
}

fn alone(e: Expr) -> Sum {
    Sum::from([(vec![(e, 1)], (1, 1))])
}

/// Takes whole and half multiples of π out of a sum: their number of quarter turns, from 0 to 3.
fn take_quarters(graph: &Graph, sum: &mut Sum) -> u8 {
    let pi = |m: &Monomial| matches!(m[..], [(e, 1)] if *graph.node(e) == Node::Pi);
    let Some((m, (n, d))) = sum.iter().find(|(m, (_, d))| pi(m) && *d <= 2).map(|(m, c)| (m.clone(), *c)) else {
        return 0;
    };
    sum.remove(&m);
    let halves = if d == 1 { n.rem_euclid(4) * 2 } else { n.rem_euclid(4) };
    halves.rem_euclid(4) as u8
}

/// The sums of monomials that the expressions and their parts are.
fn sums(graph: &Graph, es: &[Expr]) -> HashMap<Expr, Sum> {
    let mut sums: HashMap<Expr, Sum> = HashMap::default();
    for e in graph.reachable(es) {
        let of = |a: Expr| sums.get(&a);
        let sum = match *graph.node(e) {
            Node::Rational(n, d) => Some(if n == 0 { Sum::new() } else { Sum::from([(Vec::new(), (n, d))]) }),
            Node::Neg(a) => of(a).and_then(|a| plus(Sum::new(), a, -1)),
            Node::Add(a, b) => of(a).zip(of(b)).and_then(|(a, b)| plus(a.clone(), b, 1)),
            Node::Sub(a, b) => of(a).zip(of(b)).and_then(|(a, b)| plus(a.clone(), b, -1)),
            Node::Mul(a, b) => of(a).zip(of(b)).and_then(|(a, b)| times(a, b)),
            Node::Div(a, b) => of(a).zip(of(b).and_then(|b| power(b, -1))).and_then(|(a, b)| times(a, &b)),
            Node::PowI(a, n) => of(a).and_then(|a| power(a, n)),
            _ => None,
        };
        sums.insert(e, sum.unwrap_or_else(|| alone(e)));
    }
    sums
}

fn add_term(sum: &mut Sum, m: Monomial, c: Ratio) -> Option<()> {
    let old = sum.get(&m).copied().unwrap_or((0, 1));
    match ratio::add(old, c)? {
        (0, _) => sum.remove(&m),
        c => sum.insert(m, c),
    };
    (sum.len() <= MOST).then_some(())
}

fn plus(mut a: Sum, b: &Sum, sign: i128) -> Option<Sum> {
    for (m, c) in b {
        add_term(&mut a, m.clone(), ratio::mul(*c, (sign, 1))?)?;
    }
    Some(a)
}

fn times(a: &Sum, b: &Sum) -> Option<Sum> {
    let mut product = Sum::new();
    for (m, c) in a {
        for (n, d) in b {
            let mut powers: BTreeMap<Expr, i32> = m.iter().copied().collect();
            for (e, k) in n {
                let old = powers.entry(*e).or_insert(0);
                *old = old.checked_add(*k)?;
            }
            powers.retain(|_, k| *k != 0);
            if powers.len() > MOST {
                return None;
            }
            add_term(&mut product, powers.into_iter().collect(), ratio::mul(*c, *d)?)?;
        }
    }
    Some(product)
}

/// A power: of a single term any, of a sum the square and the cube.
fn power(a: &Sum, n: i32) -> Option<Sum> {
    if let (Some((m, c)), 1) = (a.iter().next(), a.len()) {
        let powers: Option<Monomial> = m.iter().map(|(e, k)| Some((*e, k.checked_mul(n)?))).collect();
        return Some(Sum::from([(powers?, ratio::powi(*c, n)?)]));
    }
    match n {
        2 => times(a, a),
        3 => times(&times(a, a)?, a),
        _ => None,
    }
}
