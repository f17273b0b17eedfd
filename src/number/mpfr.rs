//! Numbers of any precision: MPFR by the crate `rug`. Every operation is rounded correctly.

use super::{Elliptic, Func, Number, Operation, Real, decimal, elliptic, quadrature};
use rug::float::{Constant, Round};
use rug::ops::{AssignRound, Pow};
use rug::{Assign, Float, Rational};
use std::cmp::Ordering;

/// A number of its own precision, in bits. The context is the precision of constants, at least two bits.
#[derive(Clone, Debug, PartialEq)]
pub struct Mpfr(pub Float);

impl Mpfr {
    /// self = the value, in this precision.
    #[inline]
    fn put<T>(&mut self, bits: u32, value: T)
    where
        Float: AssignRound<T, Round = Round, Ordering = Ordering>,
    {
        if self.0.prec() != bits {
            self.0.set_prec(bits);
        }
        self.0.assign(value);
    }
}

/// A zero loses its sign, which tells on which side of a cut it lies only by chance.
fn is_negative_zero(x: &Float) -> bool {
    x.is_zero() && x.is_sign_negative()
}

pub(super) fn unsigned_zero(x: &Float) -> Float {
    if x.is_zero() { Float::new(x.prec()) } else { x.clone() }
}

/// A precision that MPFR accepts.
pub(super) fn precision(bits: &u32) -> u32 {
    (*bits).clamp(rug::float::prec_min().max(2), rug::float::prec_max())
}

impl Number for Mpfr {
    type Context = u32;

    fn zero(bits: &u32) -> Self {
        Mpfr(Float::new(precision(bits)))
    }
    fn from_f64(x: f64, bits: &u32) -> Self {
        Mpfr(Float::with_val(precision(bits), x))
    }
    fn from_ratio(n: i128, d: i128, bits: &u32) -> Self {
        if d == 0 {
            return Mpfr(Float::with_val(precision(bits), f64::NAN));
        }
        Mpfr(Float::with_val(precision(bits), Rational::from((n, d))))
    }
    fn pi(bits: &u32) -> Self {
        Mpfr(Float::with_val(precision(bits), Constant::Pi))
    }
    fn e(bits: &u32) -> Self {
        let one = Float::with_val(2, 1);
        Mpfr(Float::with_val(precision(bits), one.exp_ref()))
    }
    fn context(&self) -> u32 {
        self.0.prec()
    }
    fn precision_bits(bits: &u32) -> u32 {
        precision(bits)
    }

    fn set(&mut self, a: &Self) {
        self.put(a.0.prec(), &a.0);
    }
    fn set_neg(&mut self, a: &Self) {
        self.put(a.0.prec(), -&a.0);
    }
    fn set_add(&mut self, a: &Self, b: &Self) {
        self.put(a.0.prec().max(b.0.prec()), &a.0 + &b.0);
    }
    fn set_sub(&mut self, a: &Self, b: &Self) {
        self.put(a.0.prec().max(b.0.prec()), &a.0 - &b.0);
    }
    fn set_mul(&mut self, a: &Self, b: &Self) {
        self.put(a.0.prec().max(b.0.prec()), &a.0 * &b.0);
    }
    fn set_div(&mut self, a: &Self, b: &Self) {
        self.put(a.0.prec().max(b.0.prec()), &a.0 / &b.0);
    }
    fn set_powi(&mut self, a: &Self, n: i32) {
        match n {
            2 => self.put(a.0.prec(), a.0.square_ref()),
            -1 => self.put(a.0.prec(), a.0.recip_ref()),
            _ => self.put(a.0.prec(), (&a.0).pow(n)),
        }
    }
    fn set_pow(&mut self, a: &Self, b: &Self) {
        let bits = a.0.prec().max(b.0.prec());
        if a.0 < 0.0 {
            self.put(bits, f64::NAN);
        } else {
            self.put(bits, (&a.0).pow(&b.0));
        }
    }
    fn set_sqrt(&mut self, a: &Self) {
        self.put(a.0.prec(), a.0.sqrt_ref());
    }
    fn set_call(&mut self, f: Func, a: &Self) {
        let (bits, a) = (a.0.prec(), &a.0);
        match f {
            Func::Sin => self.put(bits, a.sin_ref()),
            Func::Cos => self.put(bits, a.cos_ref()),
            Func::Tan => self.put(bits, a.tan_ref()),
            Func::Asin => self.put(bits, a.asin_ref()),
            Func::Acos => self.put(bits, a.acos_ref()),
            Func::Atan => self.put(bits, a.atan_ref()),
            Func::Sinh => self.put(bits, a.sinh_ref()),
            Func::Cosh => self.put(bits, a.cosh_ref()),
            Func::Tanh => self.put(bits, a.tanh_ref()),
            Func::Asinh => self.put(bits, a.asinh_ref()),
            Func::Acosh => self.put(bits, a.acosh_ref()),
            Func::Atanh => self.put(bits, a.atanh_ref()),
            Func::Exp => self.put(bits, a.exp_ref()),
            Func::Ln => self.put(bits, a.ln_ref()),
            Func::Abs => self.put(bits, a.abs_ref()),
            Func::Sign => match a.cmp0() {
                Some(order) => self.put(bits, order as i32),
                None => self.put(bits, f64::NAN),
            },
        }
    }
    fn set_atan2(&mut self, y: &Self, x: &Self) {
        let bits = y.0.prec().max(x.0.prec());
        if is_negative_zero(&y.0) || is_negative_zero(&x.0) {
            let (y, x) = (unsigned_zero(&y.0), unsigned_zero(&x.0));
            self.put(bits, y.atan2_ref(&x));
        } else {
            self.put(bits, y.0.atan2_ref(&x.0));
        }
    }
    fn set_elliptic(&mut self, f: Elliptic, x: &[&Self]) {
        *self = elliptic::any_precision(f, x);
    }
    fn set_integral(&mut self, f: &mut dyn FnMut(&Self, &Self) -> Self) {
        *self = quadrature::over_unit(self, f);
    }
    fn add_product(&mut self, a: &Self, b: &Self) {
        let bits = self.0.prec().max(a.0.prec()).max(b.0.prec());
        if self.0.prec() != bits {
            self.0.set_prec(bits);
        }
        self.0 += &a.0 * &b.0;
    }
    fn set_sin_cos(sin: &mut Self, cos: &mut Self, a: &Self) {
        for x in [&mut *sin, &mut *cos] {
            if x.0.prec() != a.0.prec() {
                x.0.set_prec(a.0.prec());
            }
        }
        (&mut sin.0, &mut cos.0).assign(a.0.sin_cos_ref());
    }

    fn to_f64(&self) -> f64 {
        self.0.to_f64()
    }
    fn log2_abs(&self) -> f64 {
        if self.0.is_zero() {
            return f64::NEG_INFINITY;
        }
        let (mantissa, exponent) = self.0.to_f64_exp();
        mantissa.abs().log2() + f64::from(exponent)
    }
    fn is_finite(&self) -> bool {
        self.0.is_finite()
    }
    fn to_decimal(&self, digits: usize) -> String {
        if let (false, Some(name)) = (self.0.is_finite(), decimal::not_finite(self.0.to_f64())) {
            return name;
        }
        let (negative, digits, exponent) = self.0.to_sign_string_exp(10, Some(digits.max(1)));
        decimal::layout(negative, &digits, exponent.unwrap_or(0).into())
    }
}

impl Real for Mpfr {
    fn rounding(operation: Operation) -> f64 {
        match operation {
            Operation::Call(Func::Abs | Func::Sign) => 0.0,
            _ => 1.0,
        }
    }
    fn pow_rounding(_: f64) -> f64 {
        1.0
    }
    fn reach() -> f64 {
        f64::INFINITY
    }
    fn elliptic_within(f: Elliptic, x: &[&Self], errors: &[f64]) -> (Self, f64) {
        elliptic::any_within(f, x, errors)
    }
}
