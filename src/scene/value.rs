//! Numbers with operators, so that closed forms read like their formulas.

use crate::number::{Func, Number};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A number with operators, on values and on references.
#[derive(Clone, Debug)]
pub(super) struct V<N>(pub N);

impl<N: Number> V<N> {
    /// A machine number of the same kind.
    pub fn like(&self, x: f64) -> V<N> {
        V(self.0.like(x))
    }

    /// The square.
    pub fn square(&self) -> V<N> {
        V(self.0.to_the(2))
    }

    /// The square root.
    pub fn root(&self) -> V<N> {
        V(self.0.root())
    }

    /// The sine.
    pub fn sin(&self) -> V<N> {
        V(self.0.apply(Func::Sin))
    }

    /// The cosine.
    pub fn cos(&self) -> V<N> {
        V(self.0.apply(Func::Cos))
    }

    /// The angle of the point of which this is the ordinate.
    pub fn atan2(&self, x: &V<N>) -> V<N> {
        let mut angle = self.0.clone();
        angle.set_atan2(&self.0, &x.0);
        V(angle)
    }

    /// -1, 0 or 1.
    pub fn sign(&self) -> f64 {
        let x = self.0.to_f64();
        if self.is_zero() { 0.0 } else { x.signum() }
    }

    /// Whether it is zero.
    pub fn is_zero(&self) -> bool {
        self.0.log2_abs() == f64::NEG_INFINITY
    }
}

macro_rules! operator {
    ($trait:ident, $method:ident, $make:ident) => {
        impl<N: Number> $trait<&V<N>> for &V<N> {
            type Output = V<N>;
            fn $method(self, other: &V<N>) -> V<N> {
                V(self.0.$make(&other.0))
            }
        }
        impl<N: Number> $trait<V<N>> for &V<N> {
            type Output = V<N>;
            fn $method(self, other: V<N>) -> V<N> {
                V(self.0.$make(&other.0))
            }
        }
        impl<N: Number> $trait<&V<N>> for V<N> {
            type Output = V<N>;
            fn $method(self, other: &V<N>) -> V<N> {
                V(self.0.$make(&other.0))
            }
        }
        impl<N: Number> $trait<V<N>> for V<N> {
            type Output = V<N>;
            fn $method(self, other: V<N>) -> V<N> {
                V(self.0.$make(&other.0))
            }
        }
        impl<N: Number> $trait<f64> for V<N> {
            type Output = V<N>;
            fn $method(self, other: f64) -> V<N> {
                V(self.0.$make(&self.0.like(other)))
            }
        }
        impl<N: Number> $trait<f64> for &V<N> {
            type Output = V<N>;
            fn $method(self, other: f64) -> V<N> {
                V(self.0.$make(&self.0.like(other)))
            }
        }
    };
}
operator!(Add, add, plus);
operator!(Sub, sub, minus);
operator!(Mul, mul, times);
operator!(Div, div, over);

impl<N: Number> Neg for V<N> {
    type Output = V<N>;
    fn neg(self) -> V<N> {
        V(self.0.negated())
    }
}
