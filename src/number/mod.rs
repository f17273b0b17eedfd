//! The ladder of numbers that a tape is evaluated in.
//!
//! | number | bits | for |
//! |---|---|---|
//! | [`f64`] | 53 | speed |
//! | [`Lanes`] | 53 | many states at once |
//! | [`Df64`] | 104 | the default verdict |
//! | `Mpfr` (feature `rug`) | any | what needs more |
//! | `Interval` (feature `rug`) | any | what is to be proved |
//! | [`Tracked`] over a [`Real`] | its own | a value with a bound of its rounding error |
//! | [`Dual`], [`Jet`] over any | its own | a derivative; a Taylor series |
//!
//! [`F61`], a prime field, stands beside them: it has no size and no order, and so is no [`Number`].
//!
//! What every number promises, and one conformance suite checks of all:
//!
//! - The basic operations and functions are right to [`Real::rounding`] units of the roundoff, as long as the operands
//!   keep within [`Real::reach`]. Undefined ones (1/0, √-1, ln 0) are not finite, and never panic.
//! - Every result is the same on the same machine: nothing depends on threads or the time.

mod decimal;
mod df64;
mod dual;
pub mod elliptic;
mod f61;
mod float;
mod func;
#[cfg(feature = "rug")]
mod interval;
#[cfg(all(test, feature = "rug"))]
mod interval_tests;
mod jet;
mod lanes;
#[cfg(feature = "rug")]
mod mpfr;
pub mod quadrature;
mod reduction;
mod tracked;

pub use dual::Dual;
pub use elliptic::Elliptic;
pub use f61::F61;
pub use func::Func;
#[cfg(feature = "rug")]
pub use interval::Interval;
pub use jet::{Jet, JetContext};
pub use lanes::{LANES, Lanes};
#[cfg(feature = "rug")]
pub use mpfr::Mpfr;
pub use tracked::Tracked;
pub use xprec::Df64;

use std::fmt::Debug;

#[cfg(all(test, feature = "rug"))]
mod accuracy;
#[cfg(test)]
mod conformance;
#[cfg(test)]
mod tracked_tests;

/// A number that a tape can be evaluated in.
///
/// The operations are in place, `x.set_add(&a, &b)` for x = a + b, so that numbers on the heap are not allocated again
/// and again. A result has the larger precision of its operands. Operands are never what is written to.
pub trait Number: Clone + Debug + Send + Sync + 'static {
    /// What a constant must know to be made: nothing for machine numbers, the precision in bits for `Mpfr`.
    type Context: Clone + PartialEq + Debug + Send + Sync + 'static;

    /// Zero.
    fn zero(cx: &Self::Context) -> Self;
    /// The number nearest to a machine number.
    fn from_f64(x: f64, cx: &Self::Context) -> Self;
    /// The number nearest to n/d, to within the rounding of a division. Not finite where d is zero.
    fn from_ratio(n: i128, d: i128, cx: &Self::Context) -> Self;
    /// π.
    fn pi(cx: &Self::Context) -> Self;
    /// e, the base of natural logarithms.
    fn e(cx: &Self::Context) -> Self;
    /// The context that makes constants of this number's kind.
    fn context(&self) -> Self::Context;
    /// The bits of the unit roundoff u = 2^-bits.
    fn precision_bits(cx: &Self::Context) -> u32;

    /// self = a.
    fn set(&mut self, a: &Self);
    /// self = -a.
    fn set_neg(&mut self, a: &Self);
    /// self = a + b.
    fn set_add(&mut self, a: &Self, b: &Self);
    /// self = a - b.
    fn set_sub(&mut self, a: &Self, b: &Self);
    /// self = a b.
    fn set_mul(&mut self, a: &Self, b: &Self);
    /// self = a / b.
    fn set_div(&mut self, a: &Self, b: &Self);
    /// self = aⁿ; one where n is zero.
    fn set_powi(&mut self, a: &Self, n: i32);
    /// self = aᵇ for a positive a.
    fn set_pow(&mut self, a: &Self, b: &Self);
    /// self = √a.
    fn set_sqrt(&mut self, a: &Self);
    /// self = f(a).
    fn set_call(&mut self, f: Func, a: &Self);
    /// self = the angle of the point (x, y), in (-π, π].
    fn set_atan2(&mut self, y: &Self, x: &Self);
    /// self = f(x), an elliptic function or integral of as many operands as it has ([`Elliptic::arity`]): see [`elliptic`]. Not
    /// finite for numbers that have no such functions.
    fn set_elliptic(&mut self, f: Elliptic, x: &[&Self]) {
        let _ = (f, x);
        *self = self.like(f64::NAN);
    }
    /// self = the integral from 0 to 1 of a function that is given x and 1 - x: see [`quadrature`]. Not finite where the
    /// quadrature does not converge, and for numbers that have none.
    fn set_integral(&mut self, f: &mut dyn FnMut(&Self, &Self) -> Self) {
        let _ = f;
        *self = self.like(f64::NAN);
    }
    /// self = self + a b, rounded once or twice.
    fn add_product(&mut self, a: &Self, b: &Self) {
        *self = self.plus(&a.times(b));
    }
    /// self = Σ aᵢ bₙ₋₁₋ᵢ over n terms, the length of the shorter of the two: a coefficient of the product of two power series.
    /// The order of the sum is the type's own.
    fn set_convolution(&mut self, a: &[Self], b: &[Self]) {
        *self = self.like(0.0);
        let n = a.len().min(b.len());
        for (a, b) in a[..n].iter().zip(b[..n].iter().rev()) {
            self.add_product(a, b);
        }
    }
    /// Sine and cosine of the same angle.
    fn set_sin_cos(sin: &mut Self, cos: &mut Self, a: &Self) {
        sin.set_call(Func::Sin, a);
        cos.set_call(Func::Cos, a);
    }

    /// The nearest machine number; the first lane's, or the value of a number that carries more than its value.
    fn to_f64(&self) -> f64;
    /// log₂|x|, to about 50 bits, also beyond the range of a machine number; -∞ for zero, the largest over lanes.
    fn log2_abs(&self) -> f64;
    /// Whether the number, in all its parts, is neither infinite nor undefined.
    fn is_finite(&self) -> bool;
    /// The value in decimal, rounded to this many significant digits, without trailing zeros.
    fn to_decimal(&self, digits: usize) -> String;

    /// a + b.
    fn plus(&self, b: &Self) -> Self {
        made(self, |x| x.set_add(self, b))
    }
    /// a - b.
    fn minus(&self, b: &Self) -> Self {
        made(self, |x| x.set_sub(self, b))
    }
    /// a b.
    fn times(&self, b: &Self) -> Self {
        made(self, |x| x.set_mul(self, b))
    }
    /// a / b.
    fn over(&self, b: &Self) -> Self {
        made(self, |x| x.set_div(self, b))
    }
    /// -a.
    fn negated(&self) -> Self {
        made(self, |x| x.set_neg(self))
    }
    /// √a.
    fn root(&self) -> Self {
        made(self, |x| x.set_sqrt(self))
    }
    /// aⁿ.
    fn to_the(&self, n: i32) -> Self {
        made(self, |x| x.set_powi(self, n))
    }
    /// f(a).
    fn apply(&self, f: Func) -> Self {
        made(self, |x| x.set_call(f, self))
    }
    /// A machine number in this number's context.
    fn like(&self, x: f64) -> Self {
        Self::from_f64(x, &self.context())
    }
}

/// A new number like `model`, made by an operation in place.
fn made<N: Number>(model: &N, make: impl FnOnce(&mut N)) -> N {
    let mut x = model.clone();
    make(&mut x);
    x
}

/// An operation whose rounding error is documented.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operation {
    /// Addition and subtraction.
    Add,
    /// Multiplication.
    Mul,
    /// Division, and making a fraction.
    Div,
    /// The square root.
    Sqrt,
    /// The integer power of this exponent.
    PowI(i32),
    /// A function.
    Call(Func),
    /// The angle of a point.
    Atan2,
    /// The constants π and e.
    Constant,
}

/// A real number with documented roundings: what [`Tracked`] needs to bound errors.
pub trait Real: Number {
    /// The largest relative error of an operation on exact operands, in units of the roundoff 2^-bits.
    fn rounding(operation: Operation) -> f64;
    /// The largest relative error of the power aᵇ, in units of the roundoff, where |b ln a| is at most `exponent`.
    fn pow_rounding(exponent: f64) -> f64;
    /// The relative errors hold for operands whose |log₂| is at most this. Smaller ones have absolute errors below
    /// 2^(-950 - bits).
    fn reach() -> f64;
    /// An elliptic function of as many operands as it has, and how far it can move when they move within these errors,
    /// both in units of the roundoff 2^-bits of the result; infinite where no bound is known. Its own rounding is
    /// [`elliptic::ROUNDING`].
    fn elliptic_within(f: Elliptic, x: &[&Self], errors: &[f64]) -> (Self, f64);
}
