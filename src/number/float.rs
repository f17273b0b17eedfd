//! Machine numbers, with the functions of the system's mathematical library.

use super::{Elliptic, Func, Number, Operation, Real, decimal, elliptic, quadrature};
use num_traits::{Float, pow::pow};

/// aⁿ by squaring: at most |n| - 1 multiplications' roundings, and one division's where n is negative.
pub(super) fn powi<T: Float>(a: T, n: i32) -> T {
    let power = pow(a, n.unsigned_abs() as usize);
    if n < 0 { power.recip() } else { power }
}

/// f(a), also where the standard library's own version loses digits: acosh near 1, atanh near -1.
pub(super) fn call(f: Func, a: f64) -> f64 {
    match f {
        Func::Sin => a.sin(),
        Func::Cos => a.cos(),
        Func::Tan => a.tan(),
        Func::Asin => a.asin(),
        Func::Acos => a.acos(),
        Func::Atan => a.atan(),
        Func::Sinh => a.sinh(),
        Func::Cosh => a.cosh(),
        Func::Tanh => a.tanh(),
        Func::Asinh => a.asinh(),
        Func::Acosh if a < 2.0 => {
            let t = a - 1.0; // exact
            (t + (t * (t + 2.0)).sqrt()).ln_1p()
        }
        Func::Acosh => a.acosh(),
        Func::Atanh => (0.5 * (2.0 * a.abs() / (1.0 - a.abs())).ln_1p()).copysign(a),
        Func::Exp => a.exp(),
        Func::Ln => a.ln(),
        Func::Abs => a.abs(),
        Func::Sign => sign(a),
    }
}

/// -1, 0 or 1.
pub(super) fn sign(a: f64) -> f64 {
    if a == 0.0 { 0.0 } else { a.signum() }
}

/// n/d to within three roundings.
pub(super) fn ratio(n: i128, d: i128) -> f64 {
    n as f64 / d as f64
}

/// aᵇ, which is undefined for a negative a.
pub(super) fn power(a: f64, b: f64) -> f64 {
    if a < 0.0 { f64::NAN } else { a.powf(b) }
}

/// The angle of the point (x, y), where a zero has no sign: it would tell on which side of the cut it lies only by chance.
pub(super) fn atan2(y: f64, x: f64) -> f64 {
    (y + 0.0).atan2(x + 0.0)
}

impl Number for f64 {
    type Context = ();

    fn zero(_: &()) -> Self {
        0.0
    }
    fn from_f64(x: f64, _: &()) -> Self {
        x
    }
    fn from_ratio(n: i128, d: i128, _: &()) -> Self {
        ratio(n, d)
    }
    fn pi(_: &()) -> Self {
        std::f64::consts::PI
    }
    fn e(_: &()) -> Self {
        std::f64::consts::E
    }
    fn context(&self) {}
    fn precision_bits(_: &()) -> u32 {
        53
    }

    fn set(&mut self, a: &Self) {
        *self = *a;
    }
    fn set_neg(&mut self, a: &Self) {
        *self = -*a;
    }
    fn set_add(&mut self, a: &Self, b: &Self) {
        *self = *a + *b;
    }
    fn set_sub(&mut self, a: &Self, b: &Self) {
        *self = *a - *b;
    }
    fn set_mul(&mut self, a: &Self, b: &Self) {
        *self = *a * *b;
    }
    fn set_div(&mut self, a: &Self, b: &Self) {
        *self = *a / *b;
    }
    fn set_powi(&mut self, a: &Self, n: i32) {
        *self = powi(*a, n);
    }
    fn set_pow(&mut self, a: &Self, b: &Self) {
        *self = power(*a, *b);
    }
    fn set_sqrt(&mut self, a: &Self) {
        *self = a.sqrt();
    }
    fn set_call(&mut self, f: Func, a: &Self) {
        *self = call(f, *a);
    }
    fn set_atan2(&mut self, y: &Self, x: &Self) {
        *self = atan2(*y, *x);
    }
    fn set_elliptic(&mut self, f: Elliptic, x: &[&Self]) {
        *self = elliptic::machine(f, x);
    }
    fn set_integral(&mut self, f: &mut dyn FnMut(&Self, &Self) -> Self) {
        *self = quadrature::over_unit(self, f);
    }
    #[inline]
    fn add_product(&mut self, a: &Self, b: &Self) {
        *self += a * b;
    }
    /// In four sums side by side, which do not wait for each other.
    #[inline]
    fn set_convolution(&mut self, a: &[Self], b: &[Self]) {
        let n = a.len().min(b.len());
        let (a, b) = (&a[..n], &b[..n]);
        let (fours, backward) = (a.chunks_exact(4), b.rchunks_exact(4));
        let rest: f64 = fours.remainder().iter().zip(backward.remainder().iter().rev()).map(|(a, b)| a * b).sum();
        let mut sums = [0.0; 4];
        for (a, b) in fours.zip(backward) {
            for i in 0..4 {
                sums[i] += a[i] * b[3 - i];
            }
        }
        *self = (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest;
    }

    fn to_f64(&self) -> f64 {
        *self
    }
    fn log2_abs(&self) -> f64 {
        self.abs().log2()
    }
    fn is_finite(&self) -> bool {
        f64::is_finite(*self)
    }
    fn to_decimal(&self, digits: usize) -> String {
        decimal::of_sum(*self, 0.0, digits)
    }
}

/// Assumed of the system: the errors of the usual mathematical libraries' functions are below one or two units in the last place, each at most
/// two units of the roundoff; what is composed of several of them here has some more.
impl Real for f64 {
    fn rounding(operation: Operation) -> f64 {
        match operation {
            Operation::Add | Operation::Mul | Operation::Sqrt | Operation::Constant => 1.0,
            Operation::Div => 3.0, // a fraction of large integers rounds three times
            Operation::PowI(n) => f64::from(n.unsigned_abs().max(1)) * (1.0 + f64::from(n).abs() * f64::EPSILON),
            Operation::Call(Func::Abs | Func::Sign) => 0.0,
            Operation::Call(Func::Asinh | Func::Acosh | Func::Atanh) => 16.0,
            Operation::Call(_) | Operation::Atan2 => 8.0,
        }
    }
    fn pow_rounding(_: f64) -> f64 {
        8.0
    }
    fn reach() -> f64 {
        1000.0
    }
    fn elliptic_within(f: Elliptic, x: &[&Self], errors: &[f64]) -> (Self, f64) {
        elliptic::machine_within(f, x, errors)
    }
}
