//! Running error analysis: a number that carries a bound of its own rounding error (Higham, *Accuracy and Stability of
//! Numerical Algorithms*, 2nd ed. 2002, section 3.3).
//!
//! The promise: the exact result of the same operations on the exact operands differs from the value by at most the
//! bound. It is not only of first order: slopes are taken at their largest within the operands' bounds, and where they
//! have none (division by what may be zero) the bound is infinite; a root of what may be zero moves by the root of the
//! bound, as long as it has one at all. The bounds themselves are computed
//! in machine numbers, and rounded up.

use super::{Elliptic, Func, Number, Operation, Real, elliptic, quadrature};

/// A value, and a bound of its error in units of its roundoff 2^-bits.
#[derive(Clone, Debug, PartialEq)]
pub struct Tracked<N> {
    value: N,
    error: f64,
}

/// What is added to every rounding, in units of the roundoff: numbers that underflow lose their relative precision.
const UNDERFLOW: f64 = 1.0 / (1_u64 << 50) as f64 * SMALL;
/// 2^-900.
const SMALL: f64 = f64::from_bits((1023 - 900) << 52);
/// Covers the roundings in computing a bound, some tens of operations.
const UP: f64 = 1.0 + 64.0 * f64::EPSILON;

/// At least |x|.
fn magnitude<N: Number>(x: &N) -> f64 {
    let x = x.to_f64().abs();
    if x == 0.0 { f64::MIN_POSITIVE } else { x * (1.0 + 4.0 * f64::EPSILON) + f64::MIN_POSITIVE }
}

/// At most |x|.
fn least<N: Number>(x: &N) -> f64 {
    let x = x.to_f64().abs();
    (x.min(f64::MAX) * (1.0 - 4.0 * f64::EPSILON) - f64::MIN_POSITIVE).max(0.0)
}

/// The product of a slope and an error, where nothing moves if there is no error, however steep the slope.
fn moved(slope: f64, error: f64) -> f64 {
    if error == 0.0 { 0.0 } else { slope * error }
}

impl<N: Real> Tracked<N> {
    /// A value that has no error.
    pub fn exact(value: N) -> Self {
        Tracked { value, error: 0.0 }
    }

    /// A value whose error is at most 2^`log2`; -∞ for none.
    pub fn with_error(value: N, log2: f64) -> Self {
        let error = f64::exp2(log2 + f64::from(bits(&value))) * UP;
        let none = log2 == f64::NEG_INFINITY;
        Tracked { value, error: if none { 0.0 } else { error.max(f64::MIN_POSITIVE) } }
    }

    /// The value as computed.
    pub fn value(&self) -> &N {
        &self.value
    }

    /// log₂ of the bound of the absolute error; -∞ where the value is exact, ∞ where there is no bound.
    pub fn error_log2(&self) -> f64 {
        if self.value.is_finite() { self.error.log2() - f64::from(bits(&self.value)) } else { f64::INFINITY }
    }

    /// Whether zero is within the bound of the value.
    pub fn is_zero_within(&self) -> bool {
        // The margin covers the roundings of the two logarithms.
        let (value, error) = (self.value.log2_abs(), self.error_log2());
        value == f64::NEG_INFINITY || value.is_nan() || value <= error + 1e-9 * (1.0 + error.abs().min(1e9) * 1e-3)
    }

    /// The error's bound in units of this roundoff.
    fn error_in(&self, unit: u32) -> f64 {
        let own = bits(&self.value);
        if own == unit { self.error } else { self.error * f64::exp2(f64::from(unit) - f64::from(own)) * UP }
    }

    /// At least the absolute error's bound, as far as a machine number can be so small.
    fn radius(&self) -> f64 {
        if self.error == 0.0 { 0.0 } else { self.error * f64::exp2(-f64::from(bits(&self.value).min(900))) * UP }
    }

    /// Whether it is zero and has no error.
    fn is_zero(&self) -> bool {
        self.error == 0.0 && self.value.log2_abs() == f64::NEG_INFINITY
    }

    /// The least and the largest that the exact value's magnitude can be.
    fn range(&self) -> (f64, f64) {
        let radius = self.radius();
        let low = (least(&self.value) - radius) * (1.0 - 4.0 * f64::EPSILON);
        (low.max(0.0), (magnitude(&self.value) + radius) * UP)
    }

    /// Whether relative errors hold for this operand.
    fn within_reach(&self) -> bool {
        self.value.log2_abs().abs() <= N::reach()
    }

    /// Takes the propagated errors, adds the operation's own: `rounding` units of the result.
    fn close(&mut self, propagated: f64, rounding: f64) {
        let own = if rounding == 0.0 { 0.0 } else { rounding * magnitude(&self.value) + UNDERFLOW };
        let total = (propagated + own) * UP;
        let known = self.value.is_finite() && !total.is_nan();
        self.error = if known { total } else { f64::INFINITY };
    }

    fn made(value: N, rounding: f64) -> Self {
        let mut made = Tracked::exact(value);
        made.close(0.0, rounding);
        made
    }

    /// The errors of both operands, in the roundoff of the result.
    fn errors(&self, a: &Self, b: &Self) -> (f64, f64) {
        let unit = bits(&self.value);
        (a.error_in(unit), b.error_in(unit))
    }

    /// The largest slope of `f` within the bounds of `a`, where its value has been computed.
    fn slope(f: Func, a: &Self, value: &N) -> f64 {
        let (low, high) = a.range();
        let radius = a.radius();
        let x = a.value.to_f64();
        match f {
            Func::Sin => (x.cos().abs() + x.abs() * 4.0 * f64::EPSILON + 1e-14 + radius).min(1.0),
            Func::Cos => (x.sin().abs() + x.abs() * 4.0 * f64::EPSILON + 1e-14 + radius).min(1.0),
            Func::Tan => tangent_slope(magnitude(value), radius),
            Func::Asin | Func::Acos => {
                gap(a, |one, x| one.minus(x)).map_or(f64::INFINITY, |g| 1.0 / (g * (2.0 - g)).sqrt())
            }
            Func::Atanh => gap(a, |one, x| one.minus(x)).map_or(f64::INFINITY, |g| 1.0 / (g * (2.0 - g))),
            Func::Acosh => gap(a, |one, x| x.minus(one)).map_or(f64::INFINITY, |g| 1.0 / (g * (2.0 + g)).sqrt()),
            Func::Atan => 1.0 / (1.0 + low * low),
            Func::Asinh => 1.0 / (1.0 + low * low).sqrt(),
            Func::Sinh | Func::Cosh => high.cosh() * 1.001,
            Func::Tanh => 1.001 / low.cosh().powi(2),
            Func::Exp => {
                let slope = magnitude(value)
                    * (1.0 + 2.0 * N::rounding(Operation::Call(f)) * f64::EPSILON)
                    * radius.exp()
                    * 1.001;
                // Far below zero the exponential is nothing, however large the operand's error.
                slope.min((x + radius).exp() * 1.001 + f64::MIN_POSITIVE)
            }
            Func::Ln if low > 0.0 => 1.0 / low,
            Func::Abs => 1.0,
            Func::Sign if low > 0.0 => 0.0,
            Func::Ln | Func::Sign => f64::INFINITY,
        }
    }
}

/// Whether a function is zero where its variable is, and is computed so.
fn vanishes_at_zero(f: Func) -> bool {
    use Func::*;
    matches!(f, Sin | Tan | Asin | Atan | Sinh | Tanh | Asinh | Atanh | Abs | Sign)
}

/// The bits of the roundoff.
fn bits<N: Number>(x: &N) -> u32 {
    N::precision_bits(&x.context())
}

/// The largest 1 + tan² within `radius` of an angle whose tangent's magnitude is `tangent`.
fn tangent_slope(tangent: f64, radius: f64) -> f64 {
    let tangent = tangent * 1.001; // the tangent's own rounding
    let step = if radius < 0.5 { radius.tan() * 1.001 } else { f64::INFINITY };
    let product = tangent * step;
    if product < 0.5 {
        let most = (tangent + step) / (1.0 - product);
        1.0 + most * most
    } else {
        f64::INFINITY
    }
}

/// How far the operand keeps from the end of the domain at ±1, at least; `None` where it may reach it.
fn gap<N: Real>(a: &Tracked<N>, distance: impl Fn(&N, &N) -> N) -> Option<f64> {
    let g = distance(&a.value.like(1.0), &a.value.apply(Func::Abs));
    let low = g.to_f64() * (1.0 - 1e-9) - a.radius() * (1.0 + 1e-9);
    (low > 0.0).then(|| low.min(1.0 / f64::EPSILON))
}

impl<N: Real> Number for Tracked<N> {
    type Context = N::Context;

    fn zero(cx: &N::Context) -> Self {
        Tracked::exact(N::zero(cx))
    }
    fn from_f64(x: f64, cx: &N::Context) -> Self {
        let value = N::from_f64(x, cx);
        let exact = value.to_f64() == x;
        Tracked::made(value, if exact { 0.0 } else { 1.0 })
    }
    fn from_ratio(n: i128, d: i128, cx: &N::Context) -> Self {
        let small = n == 0 || d == 1 && n.unsigned_abs() < 1 << N::precision_bits(cx).min(53);
        Tracked::made(N::from_ratio(n, d, cx), if small { 0.0 } else { N::rounding(Operation::Div) })
    }
    fn pi(cx: &N::Context) -> Self {
        Tracked::made(N::pi(cx), N::rounding(Operation::Constant))
    }
    fn e(cx: &N::Context) -> Self {
        Tracked::made(N::e(cx), N::rounding(Operation::Constant))
    }
    fn context(&self) -> N::Context {
        self.value.context()
    }
    fn precision_bits(cx: &N::Context) -> u32 {
        N::precision_bits(cx)
    }

    fn set(&mut self, a: &Self) {
        self.value.set(&a.value);
        self.error = a.error;
    }
    fn set_neg(&mut self, a: &Self) {
        self.value.set_neg(&a.value);
        self.error = a.error;
    }
    fn set_add(&mut self, a: &Self, b: &Self) {
        self.value.set_add(&a.value, &b.value);
        if a.is_zero() && b.is_zero() {
            self.error = 0.0;
            return;
        }
        let (ea, eb) = self.errors(a, b);
        self.close(ea + eb, N::rounding(Operation::Add));
    }
    fn set_sub(&mut self, a: &Self, b: &Self) {
        self.value.set_sub(&a.value, &b.value);
        if a.is_zero() && b.is_zero() {
            self.error = 0.0;
            return;
        }
        let (ea, eb) = self.errors(a, b);
        self.close(ea + eb, N::rounding(Operation::Add));
    }
    fn set_mul(&mut self, a: &Self, b: &Self) {
        self.value.set_mul(&a.value, &b.value);
        let (ea, eb) = self.errors(a, b);
        if a.is_zero() && b.value.is_finite() || b.is_zero() && a.value.is_finite() {
            self.error = 0.0;
            return;
        }
        // |ab - âb̂| ≤ |â| eb + (|b̂| + eb) ea
        let propagated = moved(magnitude(&a.value), eb) + moved(b.range().1, ea);
        self.close(propagated, N::rounding(Operation::Mul));
    }
    fn set_div(&mut self, a: &Self, b: &Self) {
        self.value.set_div(&a.value, &b.value);
        let (ea, eb) = self.errors(a, b);
        let rounding = N::rounding(Operation::Div);
        // |a/b - â/b̂| ≤ (ea + |â/b̂| eb) / (|b̂| - eb)
        let quotient = magnitude(&self.value) * (1.0 + 1e-9) + f64::MIN_POSITIVE;
        let distance = ea + moved(quotient, eb);
        let low = b.range().0;
        if a.is_zero() && low > 0.0 {
            self.error = 0.0;
            return;
        }
        let propagated = if !b.within_reach() || low == 0.0 { f64::INFINITY } else { distance / low };
        self.close(propagated, rounding);
    }
    fn set_powi(&mut self, a: &Self, n: i32) {
        self.value.set_powi(&a.value, n);
        let error = a.error_in(bits(&self.value));
        let (low, high) = a.range();
        let count = f64::from(n).abs() * (1.0 + 8.0 * f64::EPSILON);
        // (1 + ε)ⁿ grows by some n ε relative to its first-order term in each of the powers.
        let slack = 1.0 + 16.0 * count * f64::EPSILON;
        let propagated = match n {
            0 => 0.0,
            1.. => moved(count * high.powi(n - 1) * slack, error),
            _ if low == 0.0 || !a.within_reach() => f64::INFINITY,
            _ => moved(count * low.powi(n.saturating_sub(1)) * slack, error),
        };
        self.close(propagated, if n == 0 { 0.0 } else { N::rounding(Operation::PowI(n)) });
    }
    fn set_pow(&mut self, a: &Self, b: &Self) {
        self.value.set_pow(&a.value, &b.value);
        let (ea, eb) = self.errors(a, b);
        let (low, _) = a.range();
        let logarithm = (a.value.log2_abs().abs() * std::f64::consts::LN_2 + f64::EPSILON) * UP;
        if low == 0.0 || !a.within_reach() {
            self.close(f64::INFINITY, 0.0);
            return;
        }
        // aᵇ = exp(b ln a): the exponent's error, and then the exponential's largest slope.
        let moved_log = ea / low;
        let exponent = moved(b.range().1, moved_log) + moved(logarithm, eb);
        let radius = exponent * f64::exp2(-f64::from(bits(&self.value).min(900)));
        let size = magnitude(&b.value) * logarithm;
        let slope = magnitude(&self.value) * 1.001 * radius.exp();
        self.close(moved(slope, exponent), N::pow_rounding(size));
    }
    fn set_sqrt(&mut self, a: &Self) {
        self.value.set_sqrt(&a.value);
        let radius = a.radius();
        let x = a.value.to_f64();
        if radius > 0.0 && radius.is_finite() && x.abs() <= radius {
            // The exact operand may be zero. As it has a root it is between 0 and x + ea, and |√x - √y| ≤ √|x - y|.
            if x < 0.0 {
                self.value = a.value.like(0.0);
            }
            let error = radius.sqrt() * f64::exp2(f64::from(bits(&self.value).min(900)));
            return self.close(error, N::rounding(Operation::Sqrt));
        }
        let error = a.error_in(bits(&self.value));
        // √ over [a - ea, a + ea] moves by at most ea / (√a + √(a - ea)).
        let (low, _) = a.range();
        let exact_zero = error == 0.0 && a.value.log2_abs() == f64::NEG_INFINITY;
        let propagated = match low > 0.0 && a.within_reach() {
            true => error / (low.sqrt() + least(&a.value).sqrt()) * (1.0 + 8.0 * f64::EPSILON),
            false if exact_zero => 0.0,
            false => f64::INFINITY,
        };
        self.close(propagated, N::rounding(Operation::Sqrt));
    }
    fn set_call(&mut self, f: Func, a: &Self) {
        self.value.set_call(f, &a.value);
        if a.is_zero() && vanishes_at_zero(f) {
            self.error = 0.0;
            return;
        }
        let error = a.error_in(bits(&self.value));
        let lost = f == Func::Ln && !a.within_reach();
        let slope = Self::slope(f, a, &self.value);
        let propagated = if lost { f64::INFINITY } else { moved(slope, error) };
        self.close(propagated, N::rounding(Operation::Call(f)));
    }
    fn set_atan2(&mut self, y: &Self, x: &Self) {
        self.value.set_atan2(&y.value, &x.value);
        let (ey, ex) = self.errors(y, x);
        let (y_low, x_low) = (y.range().0, x.range().0);
        let nearest = y_low.hypot(x_low) * (1.0 - 8.0 * f64::EPSILON);
        // The cut: y may have the other sign while x may be negative.
        let cut = ey > 0.0 && y_low == 0.0 && (x.value.to_f64() < 0.0 || x_low == 0.0);
        let origin = nearest == 0.0;
        let reach = |v: &Self| v.within_reach() || v.value.log2_abs() == f64::NEG_INFINITY;
        let propagated = match cut || origin || !reach(x) || !reach(y) {
            true => f64::INFINITY,
            false => ey.hypot(ex) / nearest,
        };
        self.close(propagated, N::rounding(Operation::Atan2));
    }
    fn set_elliptic(&mut self, f: Elliptic, x: &[&Self]) {
        let values: Vec<&N> = x.iter().map(|x| &x.value).collect();
        // The result has the largest precision of its operands.
        let unit = values.iter().map(|x| bits(*x)).max().unwrap_or_default();
        let errors: Vec<f64> = x.iter().map(|x| x.error_in(unit)).collect();
        if errors.iter().all(|e| *e == 0.0) {
            self.value.set_elliptic(f, &values);
            return self.close(0.0, elliptic::ROUNDING);
        }
        let (value, propagated) = N::elliptic_within(f, &values, &errors);
        self.value = value;
        self.close(propagated, elliptic::ROUNDING);
    }
    fn set_integral(&mut self, f: &mut dyn FnMut(&Self, &Self) -> Self) {
        // The nodes are rounded: e^-depth has lost as many units as the depth is large.
        let node = |x: &N| {
            let depth = -x.log2_abs() * std::f64::consts::LN_2;
            Tracked { value: x.clone(), error: magnitude(x) * (24.0 + 4.0 * depth.max(0.0)) }
        };
        let (from, to) = (self.value.like(0.0), self.value.like(1.0));
        let got = quadrature::integrate_within(&from, &to, quadrature::UNIT_LEVELS, |s| {
            let value = f(&node(&s.above), &node(&s.below));
            let radius = value.radius();
            (value.value, radius)
        });
        *self = Tracked::with_error(got.value, got.error_log2);
    }
    fn set_sin_cos(sin: &mut Self, cos: &mut Self, a: &Self) {
        N::set_sin_cos(&mut sin.value, &mut cos.value, &a.value);
        for (f, x) in [(Func::Sin, sin), (Func::Cos, cos)] {
            if a.is_zero() && vanishes_at_zero(f) {
                x.error = 0.0;
                continue;
            }
            let error = a.error_in(bits(&x.value));
            let slope = Self::slope(f, a, &x.value);
            x.close(moved(slope, error), N::rounding(Operation::Call(f)));
        }
    }

    fn to_f64(&self) -> f64 {
        self.value.to_f64()
    }
    fn log2_abs(&self) -> f64 {
        self.value.log2_abs()
    }
    fn is_finite(&self) -> bool {
        self.value.is_finite()
    }
    fn to_decimal(&self, digits: usize) -> String {
        self.value.to_decimal(digits)
    }
}
