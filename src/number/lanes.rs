//! Blocks of machine numbers: one instruction of a tape serves many states.

use super::{Elliptic, Func, Number, decimal, elliptic, float};

/// The number of lanes that was the fastest of 4, 8, 16 and 32 in most runs of `benches/tape.rs` on x86-64, by some 10 % before 8.
pub const LANES: usize = 16;

/// `N` machine numbers that are computed with side by side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lanes<const N: usize = LANES>(pub [f64; N]);

impl<const N: usize> Lanes<N> {
    #[inline(always)]
    fn map(&mut self, a: &Self, f: impl Fn(f64) -> f64) {
        for (x, a) in self.0.iter_mut().zip(&a.0) {
            *x = f(*a);
        }
    }

    #[inline(always)]
    fn zip(&mut self, a: &Self, b: &Self, f: impl Fn(f64, f64) -> f64) {
        for ((x, a), b) in self.0.iter_mut().zip(&a.0).zip(&b.0) {
            *x = f(*a, *b);
        }
    }
}

impl<const N: usize> Number for Lanes<N> {
    type Context = ();

    fn zero(_: &()) -> Self {
        Lanes([0.0; N])
    }
    fn from_f64(x: f64, _: &()) -> Self {
        Lanes([x; N])
    }
    fn from_ratio(n: i128, d: i128, _: &()) -> Self {
        Lanes([float::ratio(n, d); N])
    }
    fn pi(_: &()) -> Self {
        Lanes([std::f64::consts::PI; N])
    }
    fn e(_: &()) -> Self {
        Lanes([std::f64::consts::E; N])
    }
    fn context(&self) {}
    fn precision_bits(_: &()) -> u32 {
        53
    }

    fn set(&mut self, a: &Self) {
        *self = *a;
    }
    fn set_neg(&mut self, a: &Self) {
        self.map(a, |a| -a);
    }
    fn set_add(&mut self, a: &Self, b: &Self) {
        self.zip(a, b, |a, b| a + b);
    }
    fn set_sub(&mut self, a: &Self, b: &Self) {
        self.zip(a, b, |a, b| a - b);
    }
    fn set_mul(&mut self, a: &Self, b: &Self) {
        self.zip(a, b, |a, b| a * b);
    }
    fn set_div(&mut self, a: &Self, b: &Self) {
        self.zip(a, b, |a, b| a / b);
    }
    fn set_powi(&mut self, a: &Self, n: i32) {
        match n {
            2 => self.map(a, |a| a * a),
            3 => self.map(a, |a| a * (a * a)),
            -1 => self.map(a, |a| 1.0 / a),
            _ => self.map(a, |a| float::powi(a, n)),
        }
    }
    fn set_pow(&mut self, a: &Self, b: &Self) {
        self.zip(a, b, float::power);
    }
    fn set_sqrt(&mut self, a: &Self) {
        self.map(a, f64::sqrt);
    }
    fn set_call(&mut self, f: Func, a: &Self) {
        match f {
            Func::Sin => self.map(a, f64::sin),
            Func::Cos => self.map(a, f64::cos),
            _ => self.map(a, |a| float::call(f, a)),
        }
    }
    fn set_atan2(&mut self, y: &Self, x: &Self) {
        self.zip(y, x, float::atan2);
    }
    fn set_elliptic(&mut self, f: Elliptic, x: &[&Self]) {
        for (i, lane) in self.0.iter_mut().enumerate() {
            let x: Vec<&f64> = x.iter().filter_map(|x| x.0.get(i)).collect();
            *lane = elliptic::machine(f, &x);
        }
    }

    fn to_f64(&self) -> f64 {
        self.0.first().copied().unwrap_or(f64::NAN)
    }
    fn log2_abs(&self) -> f64 {
        self.0.iter().fold(f64::NEG_INFINITY, |most, x| most.max(x.abs().log2()))
    }
    fn is_finite(&self) -> bool {
        self.0.iter().all(|x| x.is_finite())
    }
    fn to_decimal(&self, digits: usize) -> String {
        let lanes: Vec<_> = self.0.iter().map(|&x| decimal::of_sum(x, 0.0, digits)).collect();
        format!("[{}]", lanes.join(", "))
    }
}
