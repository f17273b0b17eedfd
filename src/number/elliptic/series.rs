//! Derivatives and Taylor series of elliptic functions of moving arguments.

use super::super::{Dual, Func, Jet, Number};
use super::{Elliptic, MOST_ARGUMENTS, Rules, slope};
use std::collections::HashMap;

const POSITIONS: [usize; MOST_ARGUMENTS] = [0, 1, 2, 3];

/// f of numbers.
fn value<N: Number>(f: Elliptic, x: &[&N]) -> Option<N> {
    let mut value = (*x.first()?).clone();
    value.set_elliptic(f, x);
    Some(value)
}

fn is_zero<N: Number>(x: &N) -> bool {
    x.log2_abs() == f64::NEG_INFINITY
}

/// Derivatives in plain numbers.
struct Plain<'x, N> {
    x: &'x [&'x N],
    like: N,
}

macro_rules! arithmetic {
    () => {
        fn add(&mut self, a: &Self::Value, b: &Self::Value) -> Self::Value {
            a.plus(b)
        }
        fn sub(&mut self, a: &Self::Value, b: &Self::Value) -> Self::Value {
            a.minus(b)
        }
        fn mul(&mut self, a: &Self::Value, b: &Self::Value) -> Self::Value {
            a.times(b)
        }
        fn div(&mut self, a: &Self::Value, b: &Self::Value) -> Self::Value {
            a.over(b)
        }
        fn sqrt(&mut self, a: &Self::Value) -> Self::Value {
            a.root()
        }
        fn sin_cos(&mut self, a: &Self::Value) -> (Self::Value, Self::Value) {
            (a.apply(Func::Sin), a.apply(Func::Cos))
        }
    };
}

impl<N: Number> Rules for Plain<'_, N> {
    type Value = N;
    fn argument(&mut self, i: usize) -> N {
        self.x.get(i).map_or_else(|| self.like.like(f64::NAN), |x| (*x).clone())
    }
    fn related(&mut self, f: Elliptic, of: &[usize]) -> N {
        let x: Vec<&N> = of.iter().filter_map(|i| self.x.get(*i).copied()).collect();
        value(f, &x).unwrap_or_else(|| self.like.like(f64::NAN))
    }
    fn int(&mut self, n: i32) -> N {
        self.like.like(n.into())
    }
    arithmetic!();
}

/// f of dual numbers. Arguments that do not move cost nothing, also where f is not smooth in them.
pub(in crate::number) fn dual<N: Number>(f: Elliptic, x: &[&Dual<N>]) -> Option<Dual<N>> {
    let values: Vec<&N> = x.iter().map(|x| &x.value).collect();
    let value = value(f, &values)?;
    let mut rules = Plain { like: value.clone(), x: &values };
    let mut derivative = value.like(0.0);
    for (i, x) in x.iter().enumerate().filter(|(_, x)| !is_zero(&x.derivative)) {
        let slope = slope(&mut rules, f, &POSITIONS[..f.arity()], i);
        derivative = derivative.plus(&slope.times(&x.derivative));
    }
    Some(Dual { value, derivative })
}

/// Derivatives in Taylor series that are known up to an order: functions that derivatives lead to are expanded with
/// them.
struct Expansion<'x, N> {
    x: &'x [&'x Jet<N>],
    known: HashMap<(Elliptic, Vec<usize>), Vec<N>>,
    order: usize,
    like: N,
}

impl<N: Number> Expansion<'_, N> {
    /// The first coefficients of a function, up to an order.
    fn coefficients(&mut self, f: Elliptic, of: &[usize], order: usize) -> Vec<N> {
        let key = (f, of.to_vec());
        let mut known = self.known.get(&key).cloned().unwrap_or_default();
        while known.len() <= order {
            let next = match known.len() {
                0 => self.start(f, of),
                k => self.rate(f, of, k - 1).over(&self.like.like(k as f64)),
            };
            known.push(next);
            self.known.insert(key.clone(), known.clone());
        }
        known.truncate(order + 1);
        known
    }

    fn start(&self, f: Elliptic, of: &[usize]) -> N {
        let x: Vec<&N> = of.iter().filter_map(|i| self.x.get(*i)?.coefficients().first()).collect();
        value(f, &x).unwrap_or_else(|| self.like.like(f64::NAN))
    }

    /// The coefficient of this order of Σ ∂f/∂xᵢ xᵢ'.
    fn rate(&mut self, f: Elliptic, of: &[usize], order: usize) -> N {
        let mut sum = self.like.like(0.0);
        for (i, &position) in of.iter().enumerate() {
            let moved = self.x.get(position).map_or(Vec::new(), |x| derivative(x, order));
            if moved.iter().all(is_zero) {
                continue;
            }
            let before = std::mem::replace(&mut self.order, order);
            let slope = slope(self, f, of, i);
            self.order = before;
            let product = slope.times(&jet_of(moved, &self.like));
            sum = product.coefficients().get(order).map_or(sum.clone(), |c| sum.plus(c));
        }
        sum
    }
}

/// The coefficients of the derivative up to an order.
fn derivative<N: Number>(x: &Jet<N>, order: usize) -> Vec<N> {
    let rest = x.coefficients().iter().enumerate().skip(1).take(order + 1);
    rest.map(|(k, c)| c.times(&c.like(k as f64))).collect()
}

fn jet_of<N: Number>(coefficients: Vec<N>, like: &N) -> Jet<N> {
    let mut coefficients = coefficients.into_iter();
    let first = coefficients.next().unwrap_or_else(|| like.like(0.0));
    Jet::new(first, coefficients)
}

impl<N: Number> Rules for Expansion<'_, N> {
    type Value = Jet<N>;
    fn argument(&mut self, i: usize) -> Jet<N> {
        let x = self.x.get(i).map_or(Vec::new(), |x| x.coefficients().iter().take(self.order + 1).cloned().collect());
        jet_of(x, &self.like)
    }
    fn related(&mut self, f: Elliptic, of: &[usize]) -> Jet<N> {
        let coefficients = self.coefficients(f, of, self.order);
        jet_of(coefficients, &self.like)
    }
    fn int(&mut self, n: i32) -> Jet<N> {
        Jet::constant(self.like.like(n.into()), self.order)
    }
    arithmetic!();
}

/// f of Taylor series, to the lowest of their orders.
pub(in crate::number) fn jet<N: Number>(f: Elliptic, x: &[&Jet<N>]) -> Option<Jet<N>> {
    let order = x.iter().map(|x| x.coefficients().len()).min()?.checked_sub(1)?;
    let like = x.first()?.coefficients().first()?.clone();
    let mut expansion = Expansion { x, known: HashMap::new(), order, like: like.clone() };
    let coefficients = expansion.coefficients(f, &POSITIONS[..f.arity()], order);
    Some(jet_of(coefficients, &like))
}
