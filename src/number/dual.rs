//! Dual numbers: a value and its derivative along one direction (forward differentiation).

use super::{Elliptic, Func, Number, elliptic};

/// `value + derivative·ε` with ε² = 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Dual<N> {
    /// The value.
    pub value: N,
    /// The derivative.
    pub derivative: N,
}

impl<N: Number> Dual<N> {
    /// A value that moves at this rate.
    pub fn new(value: N, derivative: N) -> Self {
        Dual { value, derivative }
    }

    /// A value that does not move.
    pub fn constant(value: N) -> Self {
        let derivative = N::zero(&value.context());
        Dual { value, derivative }
    }

    /// self = f(a), whose derivative there is `slope`.
    fn put(&mut self, value: N, slope: &N, a: &Self) {
        self.value = value;
        self.derivative.set_mul(slope, &a.derivative);
    }
}

/// The derivative of `f` at `a`, where its value is `value`.
fn slope<N: Number>(f: Func, a: &N, value: &N) -> N {
    let one = a.like(1.0);
    let square = |x: &N| x.to_the(2);
    match f {
        Func::Sin => a.apply(Func::Cos),
        Func::Cos => a.apply(Func::Sin).negated(),
        Func::Tan => one.plus(&square(value)),
        Func::Asin => one.over(&one.minus(a).times(&one.plus(a)).root()),
        Func::Acos => one.over(&one.minus(a).times(&one.plus(a)).root()).negated(),
        Func::Atan => one.over(&one.plus(&square(a))),
        Func::Sinh => a.apply(Func::Cosh),
        Func::Cosh => a.apply(Func::Sinh),
        Func::Tanh => one.minus(&square(value)),
        Func::Asinh => one.over(&one.plus(&square(a)).root()),
        Func::Acosh => one.over(&a.minus(&one).times(&a.plus(&one)).root()),
        Func::Atanh => one.over(&one.minus(a).times(&one.plus(a))),
        Func::Exp => value.clone(),
        Func::Ln => one.over(a),
        Func::Abs => a.apply(Func::Sign),
        Func::Sign => a.like(0.0),
    }
}

impl<N: Number> Number for Dual<N> {
    type Context = N::Context;

    fn zero(cx: &N::Context) -> Self {
        Dual::constant(N::zero(cx))
    }
    fn from_f64(x: f64, cx: &N::Context) -> Self {
        Dual::constant(N::from_f64(x, cx))
    }
    fn from_ratio(n: i128, d: i128, cx: &N::Context) -> Self {
        Dual::constant(N::from_ratio(n, d, cx))
    }
    fn pi(cx: &N::Context) -> Self {
        Dual::constant(N::pi(cx))
    }
    fn e(cx: &N::Context) -> Self {
        Dual::constant(N::e(cx))
    }
    fn context(&self) -> N::Context {
        self.value.context()
    }
    fn precision_bits(cx: &N::Context) -> u32 {
        N::precision_bits(cx)
    }

    fn set(&mut self, a: &Self) {
        self.value.set(&a.value);
        self.derivative.set(&a.derivative);
    }
    fn set_neg(&mut self, a: &Self) {
        self.value.set_neg(&a.value);
        self.derivative.set_neg(&a.derivative);
    }
    fn set_add(&mut self, a: &Self, b: &Self) {
        self.value.set_add(&a.value, &b.value);
        self.derivative.set_add(&a.derivative, &b.derivative);
    }
    fn set_sub(&mut self, a: &Self, b: &Self) {
        self.value.set_sub(&a.value, &b.value);
        self.derivative.set_sub(&a.derivative, &b.derivative);
    }
    fn set_mul(&mut self, a: &Self, b: &Self) {
        self.value.set_mul(&a.value, &b.value);
        let (left, right) = (a.derivative.times(&b.value), a.value.times(&b.derivative));
        self.derivative.set_add(&left, &right);
    }
    fn set_div(&mut self, a: &Self, b: &Self) {
        self.value.set_div(&a.value, &b.value);
        let numerator = a.derivative.minus(&self.value.times(&b.derivative));
        self.derivative.set_div(&numerator, &b.value);
    }
    fn set_powi(&mut self, a: &Self, n: i32) {
        let slope = match n {
            0 => a.value.like(0.0),
            _ => a.value.to_the(n.saturating_sub(1)).times(&a.value.like(n.into())),
        };
        self.put(a.value.to_the(n), &slope, a);
    }
    fn set_pow(&mut self, a: &Self, b: &Self) {
        // (aᵇ)' = b aᵇ⁻¹ a' + aᵇ ln a b'
        self.value.set_pow(&a.value, &b.value);
        let mut less = a.value.clone();
        less.set_pow(&a.value, &b.value.minus(&b.value.like(1.0)));
        let base = b.value.times(&less).times(&a.derivative);
        if b.derivative.log2_abs() == f64::NEG_INFINITY {
            self.derivative = base;
        } else {
            let exponent = self.value.times(&a.value.apply(Func::Ln)).times(&b.derivative);
            self.derivative.set_add(&base, &exponent);
        }
    }
    fn set_sqrt(&mut self, a: &Self) {
        let value = a.value.root();
        self.derivative.set_div(&a.derivative, &value.plus(&value));
        self.value = value;
    }
    fn set_call(&mut self, f: Func, a: &Self) {
        let value = a.value.apply(f);
        let slope = slope(f, &a.value, &value);
        self.put(value, &slope, a);
    }
    fn set_atan2(&mut self, y: &Self, x: &Self) {
        let turned = x.value.times(&y.derivative).minus(&y.value.times(&x.derivative));
        let square = x.value.to_the(2).plus(&y.value.to_the(2));
        self.value.set_atan2(&y.value, &x.value);
        self.derivative.set_div(&turned, &square);
    }
    fn set_elliptic(&mut self, f: Elliptic, x: &[&Self]) {
        *self = elliptic::dual(f, x).unwrap_or_else(|| self.like(f64::NAN));
    }
    fn set_sin_cos(sin: &mut Self, cos: &mut Self, a: &Self) {
        N::set_sin_cos(&mut sin.value, &mut cos.value, &a.value);
        sin.derivative.set_mul(&cos.value, &a.derivative);
        cos.derivative.set_mul(&sin.value.negated(), &a.derivative);
    }

    fn to_f64(&self) -> f64 {
        self.value.to_f64()
    }
    fn log2_abs(&self) -> f64 {
        self.value.log2_abs()
    }
    fn is_finite(&self) -> bool {
        self.value.is_finite() && self.derivative.is_finite()
    }
    fn to_decimal(&self, digits: usize) -> String {
        self.value.to_decimal(digits)
    }
}
