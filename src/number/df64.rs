//! Double-double numbers: the crate `xprec`, mended where its functions lose digits, take the wrong branch or panic.
//!
//! xprec 0.2.3 measured against MPFR, in units of 2^-104: exp, ln, atan and the hyperbolic functions and their inverses are
//! right to 2 units. But sine, cosine and tangent are wrong from 3·10⁹ on and panic beyond and on undefined arguments, and lose
//! up to half of their digits (10¹⁶ units) within 10⁻³⁰ of their zeros; asin and acos lose them at ±1, acosh at 1; an
//! integer power, which it takes by the logarithm, loses some 180 units; atan2 loses quotients that overflow.

use super::{Df64, Elliptic, Func, Number, Operation, Real, decimal, elliptic, float, quadrature, reduction};
use num_traits::FloatConst;

const ONE: Df64 = Df64::ONE;

/// Sine and cosine.
fn sin_cos(x: Df64) -> (Df64, Df64) {
    if !x.is_finite() {
        return (Df64::NAN, Df64::NAN);
    }
    // Up to 2^17 the library's reduction is right to 2^-141 absolutely: enough unless the result is small.
    if x.hi().abs() < 131_072.0 {
        let (s, c) = x.sin_cos();
        let least = s.hi().abs().min(c.hi().abs());
        if x.hi().abs() < 0.75 || least > 1e-6 {
            return (s, c);
        }
    }
    let (quadrant, z) = reduction::quadrant(x);
    let (s, c) = z.sin_cos();
    match quadrant {
        0 => (s, c),
        1 => (c, -s),
        2 => (-s, -c),
        _ => (-c, s),
    }
}

/// The natural logarithm.
fn ln(x: Df64) -> Df64 {
    let hi = x.hi();
    if !(hi > 0.0 && x.is_finite()) {
        return Df64::from(hi.ln());
    }
    // The correction needs the low part of x: out of the way of underflow and overflow.
    let shift = 600.0;
    if hi < f64::exp2(-shift) {
        (x * f64::exp2(shift)).ln() - Df64::LN_2() * shift
    } else if hi > f64::exp2(shift) {
        (x * f64::exp2(-shift)).ln() + Df64::LN_2() * shift
    } else {
        x.ln()
    }
}

/// The angle of the point (x, y), with a zero ordinate taken as positive.
fn atan2(y: Df64, x: Df64) -> Df64 {
    if !(y.is_finite() && x.is_finite()) {
        return Df64::NAN;
    }
    if y.hi().abs() <= x.hi().abs() {
        return y.atan2(x);
    }
    // The quotient the other way round cannot overflow.
    let quarter = if y.hi() < 0.0 { -Df64::FRAC_PI_2() } else { Df64::FRAC_PI_2() };
    quarter - (x / y).atan()
}

/// √(1 - x²) without cancellation.
fn cofunction(x: Df64) -> Df64 {
    ((ONE - x) * (ONE + x)).sqrt()
}

fn powi(a: Df64, n: i32) -> Df64 {
    match n {
        2 => a * a,
        -1 => ONE / a,
        _ => float::powi(a, n),
    }
}

fn pow(a: Df64, b: Df64) -> Df64 {
    if a.hi() < 0.0 {
        Df64::NAN
    } else if a.hi() == 0.0 || !a.is_finite() || !b.is_finite() {
        a.powf(b)
    } else {
        (b * ln(a)).exp()
    }
}

fn call(f: Func, a: Df64) -> Df64 {
    if !a.is_finite() {
        return Df64::from(float::call(f, a.hi() + a.lo()));
    }
    match f {
        Func::Sin => sin_cos(a).0,
        Func::Cos => sin_cos(a).1,
        Func::Tan => {
            let (s, c) = sin_cos(a);
            s / c
        }
        Func::Asin => atan2(a, cofunction(a)),
        Func::Acos => atan2(cofunction(a), a),
        Func::Atan => a.atan(),
        Func::Sinh => a.sinh(),
        Func::Cosh => a.cosh(),
        Func::Tanh => a.tanh(),
        Func::Asinh => a.asinh(),
        Func::Acosh if a.hi() < 2.0 => {
            let t = a - ONE;
            (t + (t * (t + ONE + ONE)).sqrt()).ln_1p()
        }
        Func::Acosh => a.acosh(),
        Func::Atanh => a.atanh(),
        Func::Exp => a.exp(),
        Func::Ln => ln(a),
        Func::Abs => a.abs(),
        Func::Sign => Df64::from(float::sign(a.hi())),
    }
}

/// An integer to within 2^-106 of itself.
fn integer(n: i128) -> Df64 {
    let high = n as f64;
    let low = n.wrapping_sub(high as i128) as f64;
    Df64::from(high) + Df64::from(low)
}

impl Number for Df64 {
    type Context = ();

    fn zero(_: &()) -> Self {
        Df64::ZERO
    }
    fn from_f64(x: f64, _: &()) -> Self {
        Df64::from(x)
    }
    fn from_ratio(n: i128, d: i128, _: &()) -> Self {
        if d == 1 { integer(n) } else { integer(n) / integer(d) }
    }
    fn pi(_: &()) -> Self {
        Df64::PI()
    }
    fn e(_: &()) -> Self {
        Df64::E()
    }
    fn context(&self) {}
    fn precision_bits(_: &()) -> u32 {
        104
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
        *self = pow(*a, *b);
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
        *self = elliptic::double(f, x);
    }
    fn set_integral(&mut self, f: &mut dyn FnMut(&Self, &Self) -> Self) {
        *self = quadrature::over_unit(self, f);
    }
    fn add_product(&mut self, a: &Self, b: &Self) {
        *self += *a * *b;
    }
    fn set_sin_cos(sin: &mut Self, cos: &mut Self, a: &Self) {
        (*sin, *cos) = sin_cos(*a);
    }

    fn to_f64(&self) -> f64 {
        self.hi()
    }
    fn log2_abs(&self) -> f64 {
        self.hi().abs().log2()
    }
    fn is_finite(&self) -> bool {
        self.hi().is_finite() && self.lo().is_finite()
    }
    fn to_decimal(&self, digits: usize) -> String {
        decimal::of_sum(self.hi(), self.lo(), digits)
    }
}

/// In units of 2^-104, which is four units of 2^-106 = (2^-53)². The bounds of the basic operations are those of Joldes, Muller and
/// Popescu, ACM Trans. Math. Softw. 44 (2018) 15: sum 3 (2^-53)², product 5, quotient 10. Those of the functions have no proof: they are at least
/// twice the worst seen against MPFR (`accuracy.rs`; what is drawn there does not exhaust the arguments).
impl Real for Df64 {
    fn rounding(operation: Operation) -> f64 {
        match operation {
            Operation::Add | Operation::Constant => 1.0,
            Operation::Mul => 1.5,
            Operation::Div => 3.0,
            Operation::Sqrt => 2.0,
            Operation::PowI(n) => 1.5 * f64::from(n.unsigned_abs()) + 3.0,
            Operation::Call(Func::Abs | Func::Sign) => 0.0,
            Operation::Call(_) | Operation::Atan2 => 4.0,
        }
    }
    fn pow_rounding(exponent: f64) -> f64 {
        4.0 + 6.0 * exponent // aᵇ = exp(b ln a)
    }
    fn reach() -> f64 {
        800.0
    }
    fn elliptic_within(f: Elliptic, x: &[&Self], errors: &[f64]) -> (Self, f64) {
        elliptic::double_within(f, x, errors)
    }
}
