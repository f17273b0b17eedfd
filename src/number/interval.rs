//! Intervals: rigorous enclosures of real numbers, with endpoints in MPFR and outward rounding.
//!
//! An interval is *bounded*, [lo, hi] with finite lo ≤ hi, or *invalid*: it knows nothing and decides nothing. The promises:
//!
//! - **Soundness.** Where the operands contain the exact operands, a bounded result contains the exact result. It is
//!   bounded only where the operation is defined **and continuous** at every point of the operands: a divisor that may be
//!   zero, √ of what may be negative, the tangent across a pole, the sign of what may be zero, an angle across the cut
//!   at ±π, an overflow give an invalid interval, and so does an invalid operand. A bounded value of a whole expression
//!   therefore proves that the expression is defined and continuous on the whole box of its operands.
//! - **Refinement.** Smaller operands never give a larger result, nor do the same operands in a higher precision.
//! - **Tightness.** The endpoints of a single operation are the exact bounds of its range, rounded once outwards; an
//!   extremum ±1 of sine and cosine is also taken where it is nearer to the operand than 2^-(64 + bits) of its size, and
//!   beyond 2^16384 their range is [-1, 1]. Operations in a row lose more: x - x is not zero.
//!
//! As a [`Number`] an interval has its midpoint for a value (`to_f64`, `to_decimal`), and the larger endpoint for a size
//! (`log2_abs`); nothing rigorous rests on these. It is no [`super::Real`]: it needs no bound from outside.

use super::mpfr::{precision, unsigned_zero};
use super::{Func, Number, decimal};
use rug::float::{Constant, Round};
use rug::ops::{AssignRound, Pow};
use rug::{Float, Integer, Rational};
use std::cmp::Ordering;

/// A set of real numbers between two endpoints of one precision. The context is that precision in bits.
#[derive(Clone, Debug)]
pub struct Interval {
    lo: Float,
    hi: Float,
}

/// What is rounded once in a given direction.
trait Rounded: Sized {
    fn into_end(self, end: &mut Float, round: Round);
}

impl<T> Rounded for T
where
    Float: AssignRound<T, Round = Round, Ordering = Ordering>,
{
    fn into_end(self, end: &mut Float, round: Round) {
        end.assign_round(self, round);
    }
}

/// Making and asking.
impl Interval {
    /// All numbers from `lo` to `hi`, in the larger precision of both; invalid where that is nothing or not bounded.
    pub fn new(lo: &Float, hi: &Float) -> Self {
        let mut made = Interval::invalid(lo.prec().max(hi.prec()));
        if lo <= hi {
            made.put(made.bits(), lo, hi);
        }
        made
    }

    /// The narrowest interval of a precision around a fraction.
    pub fn from_rational(x: &Rational, bits: u32) -> Self {
        Interval::around(bits, x, x)
    }

    /// What nothing is known of.
    pub fn invalid(bits: u32) -> Self {
        let nan = || Float::with_val(precision(&bits), f64::NAN);
        Interval { lo: nan(), hi: nan() }
    }

    /// The lower endpoint; not a number where the interval is invalid.
    pub fn lo(&self) -> &Float {
        &self.lo
    }

    /// The upper endpoint; not a number where the interval is invalid.
    pub fn hi(&self) -> &Float {
        &self.hi
    }

    /// Whether the interval is bounded, and so says something.
    pub fn is_bounded(&self) -> bool {
        self.lo.is_finite() && self.hi.is_finite()
    }

    /// Whether the interval is a single number.
    pub fn is_point(&self) -> bool {
        self.is_bounded() && self.lo == self.hi
    }

    /// Whether a number is in the interval. An invalid interval may contain anything.
    pub fn contains(&self, x: &Float) -> bool {
        !self.is_bounded() || (self.lo <= *x && *x <= self.hi)
    }

    /// Whether zero is proved not to be in the interval.
    pub fn excludes_zero(&self) -> bool {
        self.is_bounded() && (self.lo > 0 || self.hi < 0)
    }

    /// The sign that all numbers of the interval are proved to have; zero only for the point zero.
    pub fn sign(&self) -> Option<Ordering> {
        let (low, high) = (self.lo.cmp0()?, self.hi.cmp0()?);
        (low == high).then_some(low)
    }

    /// Whether this interval is proved to lie within another, not touching its endpoints.
    pub fn is_inside(&self, other: &Self) -> bool {
        self.is_bounded() && other.is_bounded() && other.lo < self.lo && self.hi < other.hi
    }

    /// Whether every number of this interval is in another; all are in an invalid one.
    pub fn is_within(&self, other: &Self) -> bool {
        !other.is_bounded() || (self.is_bounded() && other.lo <= self.lo && self.hi <= other.hi)
    }

    /// The numbers that two intervals share; invalid where they share none, the other where one is invalid.
    pub fn meet(&self, other: &Self) -> Self {
        match (self.is_bounded(), other.is_bounded()) {
            (false, _) => other.clone(),
            (_, false) => self.clone(),
            _ => {
                let lo = if self.lo >= other.lo { &self.lo } else { &other.lo };
                let hi = if self.hi <= other.hi { &self.hi } else { &other.hi };
                Interval::new(lo, hi)
            }
        }
    }

    /// The number in the middle, to the nearest, which is in the interval.
    pub fn midpoint(&self) -> Float {
        Float::with_val(self.bits(), &self.lo + &self.hi) >> 1
    }

    /// At least the distance of the endpoints.
    pub fn width(&self) -> Float {
        Float::with_val_round(self.bits(), &self.hi - &self.lo, Round::Up).0
    }

    /// Decimals of so many significant digits that bracket the interval, rounded outwards. A point that such a decimal
    /// writes exactly has two equal ones. `None` where the interval is invalid.
    pub fn bracket(&self, digits: usize) -> Option<(String, String)> {
        let text = |x: &Float, round| {
            let (negative, digits, exponent) = x.to_sign_string_exp_round(10, Some(digits.max(1)), round);
            decimal::layout(negative, &digits, exponent.unwrap_or(0).into())
        };
        self.is_bounded().then(|| (text(&self.lo, Round::Down), text(&self.hi, Round::Up)))
    }

    fn bits(&self) -> u32 {
        self.lo.prec()
    }

    fn around(bits: u32, lo: impl Rounded, hi: impl Rounded) -> Self {
        let mut made = Interval::invalid(bits);
        made.put(precision(&bits), lo, hi);
        made
    }

    /// self = [lo, hi], rounded outwards; invalid where an endpoint is not finite.
    #[inline]
    fn put(&mut self, bits: u32, lo: impl Rounded, hi: impl Rounded) {
        for end in [&mut self.lo, &mut self.hi] {
            if end.prec() != bits {
                end.set_prec(bits);
            }
        }
        lo.into_end(&mut self.lo, Round::Down);
        hi.into_end(&mut self.hi, Round::Up);
        if !self.is_bounded() {
            self.invalidate(bits);
        }
    }

    fn invalidate(&mut self, bits: u32) {
        *self = Interval::invalid(bits);
    }

    /// The precision of a result, where the operands say something.
    fn common(a: &Self, b: &Self) -> Result<u32, u32> {
        let bits = a.bits().max(b.bits());
        if a.is_bounded() && b.is_bounded() { Ok(bits) } else { Err(bits) }
    }
}

/// The sign of all numbers of an interval.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Side {
    /// None is negative.
    Right,
    /// None is positive.
    Left,
    /// Both may be.
    Both,
}

/// Ranges of functions over bounded operands.
impl Interval {
    fn side(&self) -> Side {
        match (self.lo >= 0, self.hi <= 0) {
            (true, _) => Side::Right,
            (_, true) => Side::Left,
            _ => Side::Both,
        }
    }

    /// The range of a function that rises.
    fn rising<'a, T: Rounded>(&mut self, a: &'a Self, f: impl Fn(&'a Float) -> T) {
        self.put(a.bits(), f(&a.lo), f(&a.hi));
    }

    /// The range of a function that falls.
    fn falling<'a, T: Rounded>(&mut self, a: &'a Self, f: impl Fn(&'a Float) -> T) {
        self.put(a.bits(), f(&a.hi), f(&a.lo));
    }

    /// The range of an even function that rises away from zero, where it has a given value.
    fn even<'a, T: Rounded>(&mut self, a: &'a Self, at_zero: u32, f: impl Fn(&'a Float) -> T) {
        match a.side() {
            Side::Right => self.rising(a, f),
            Side::Left => self.falling(a, f),
            Side::Both => self.put(a.bits(), at_zero, f(a.larger())),
        }
    }

    /// The endpoint that is farther from zero.
    fn larger(&self) -> &Float {
        if self.lo.cmp_abs(&self.hi) == Some(Ordering::Greater) { &self.lo } else { &self.hi }
    }

    /// The range of a function of two variables that is monotone in each, whichever way.
    fn corners<'a, T: Rounded>(
        &mut self,
        bits: u32,
        (a, b): (&'a Self, &'a Self),
        f: impl Fn(&'a Float, &'a Float) -> T,
    ) {
        let mut range: Option<(Float, Float)> = None;
        for (x, y) in [(&a.lo, &b.lo), (&a.lo, &b.hi), (&a.hi, &b.lo), (&a.hi, &b.hi)] {
            let (mut low, mut high) = (Float::new(bits), Float::new(bits));
            f(x, y).into_end(&mut low, Round::Down);
            f(x, y).into_end(&mut high, Round::Up);
            // Not a number spreads: the comparisons that keep the old endpoint are false.
            range = Some(match range {
                None => (low, high),
                Some((lo, hi)) => (if lo <= low { lo } else { low }, if hi >= high { hi } else { high }),
            });
            if range.as_ref().is_some_and(|(lo, hi)| lo.is_nan() || hi.is_nan()) {
                return self.invalidate(bits);
            }
        }
        if let Some((lo, hi)) = range {
            self.put(bits, &lo, &hi);
        }
    }

    /// The range of sine or cosine.
    fn wave<'a, T: Rounded>(&mut self, a: &'a Self, first: Half, f: impl Fn(&'a Float) -> T) {
        let bits = a.bits();
        let Some((below, above)) = extrema(a, first) else { return self.put(bits, -1, 1) };
        match (Integer::from(&above - &below).to_u32(), above.is_even()) {
            // From an even extremum, a maximum, to the next.
            (Some(0), true) => self.falling(a, f),
            (Some(0), false) => self.rising(a, f),
            (Some(1), maximum) => {
                let (mut low, mut high) = (Interval::invalid(bits), Interval::invalid(bits));
                low.put(bits, f(&a.lo), f(&a.lo));
                high.put(bits, f(&a.hi), f(&a.hi));
                if maximum {
                    self.put(bits, if low.lo <= high.lo { &low.lo } else { &high.lo }, 1);
                } else {
                    self.put(bits, -1, if low.hi >= high.hi { &low.hi } else { &high.hi });
                }
            }
            _ => self.put(bits, -1, 1),
        }
    }

    fn tangent(&mut self, a: &Self) {
        match extrema(a, Half::Odd) {
            Some((below, above)) if below == above => self.rising(a, Float::tan_ref),
            _ => self.invalidate(a.bits()),
        }
    }
}

/// Where a function of period 2π has its extrema: at which multiples of π/2.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Half {
    /// At kπ: cosine.
    Even,
    /// At kπ + π/2: sine, and the poles of the tangent.
    Odd,
}

/// Beyond this power of two, angles are too large for their quadrant to be found.
const LARGEST_ANGLE: i32 = 16384;

/// The numbers k of the last extrema that are surely before the interval's begin, and not surely after its end. Where they
/// are equal there is none in the interval. `None` where the angles are too large.
fn extrema(a: &Interval, half: Half) -> Option<(Integer, Integer)> {
    Some((extremum_before(&a.lo, half, Round::Down)?, extremum_before(&a.hi, half, Round::Up)?))
}

/// floor(x/π) or floor(x/π - 1/2), or its neighbour in the direction of rounding where that cannot be told.
fn extremum_before(x: &Float, half: Half, round: Round) -> Option<Integer> {
    let exponent = x.get_exp().unwrap_or(0).max(0);
    if exponent > LARGEST_ANGLE {
        return None;
    }
    let bits = x.prec() + exponent.unsigned_abs() + 64;
    // A quotient is rounded down by a divisor that is too large for a positive, too small for a negative number.
    let outward = if x.is_sign_negative() { round } else { round.reverse() };
    let pi = Float::with_val_round(bits, Constant::Pi, outward).0;
    let mut turns = Float::with_val_round(bits, x / &pi, round).0;
    if half == Half::Odd {
        turns = Float::with_val_round(bits, &turns - 0.5_f64, round).0;
    }
    turns.floor().to_integer()
}

impl Number for Interval {
    type Context = u32;

    fn zero(bits: &u32) -> Self {
        Interval { lo: Float::new(precision(bits)), hi: Float::new(precision(bits)) }
    }
    fn from_f64(x: f64, bits: &u32) -> Self {
        Interval::around(*bits, x, x)
    }
    fn from_ratio(n: i128, d: i128, bits: &u32) -> Self {
        if d == 0 { Interval::invalid(*bits) } else { Interval::from_rational(&Rational::from((n, d)), *bits) }
    }
    fn pi(bits: &u32) -> Self {
        Interval::around(*bits, Constant::Pi, Constant::Pi)
    }
    fn e(bits: &u32) -> Self {
        let one = Float::with_val(2, 1);
        Interval::around(*bits, one.exp_ref(), one.exp_ref())
    }
    fn context(&self) -> u32 {
        self.bits()
    }
    /// One bit less than those of the endpoints: a result may be as wide as the spacing of these.
    fn precision_bits(bits: &u32) -> u32 {
        precision(bits) - 1
    }

    fn set(&mut self, a: &Self) {
        self.put(a.bits(), &a.lo, &a.hi);
    }
    fn set_neg(&mut self, a: &Self) {
        self.put(a.bits(), -&a.hi, -&a.lo);
    }
    fn set_add(&mut self, a: &Self, b: &Self) {
        self.put(a.bits().max(b.bits()), &a.lo + &b.lo, &a.hi + &b.hi);
    }
    fn set_sub(&mut self, a: &Self, b: &Self) {
        self.put(a.bits().max(b.bits()), &a.lo - &b.hi, &a.hi - &b.lo);
    }
    fn set_mul(&mut self, a: &Self, b: &Self) {
        let bits = match Interval::common(a, b) {
            Ok(bits) => bits,
            Err(bits) => return self.invalidate(bits),
        };
        match (a.side(), b.side()) {
            (Side::Right, Side::Right) => self.put(bits, &a.lo * &b.lo, &a.hi * &b.hi),
            (Side::Right, Side::Left) => self.put(bits, &a.hi * &b.lo, &a.lo * &b.hi),
            (Side::Left, Side::Right) => self.put(bits, &a.lo * &b.hi, &a.hi * &b.lo),
            (Side::Left, Side::Left) => self.put(bits, &a.hi * &b.hi, &a.lo * &b.lo),
            (Side::Right, Side::Both) => self.put(bits, &a.hi * &b.lo, &a.hi * &b.hi),
            (Side::Left, Side::Both) => self.put(bits, &a.lo * &b.hi, &a.lo * &b.lo),
            (Side::Both, Side::Right) => self.put(bits, &a.lo * &b.hi, &a.hi * &b.hi),
            (Side::Both, Side::Left) => self.put(bits, &a.hi * &b.lo, &a.lo * &b.lo),
            (Side::Both, Side::Both) => self.corners(bits, (a, b), |x, y| x * y),
        }
    }
    fn set_div(&mut self, a: &Self, b: &Self) {
        let bits = match Interval::common(a, b) {
            Ok(bits) if b.excludes_zero() => bits,
            Ok(bits) | Err(bits) => return self.invalidate(bits),
        };
        // The bound of a quotient away from zero has the divisor's smaller end, the bound towards zero the larger.
        let (near, far) = if b.lo > 0 { (&b.lo, &b.hi) } else { (&b.hi, &b.lo) };
        let (low, high) = if b.lo > 0 { (&a.lo, &a.hi) } else { (&a.hi, &a.lo) };
        let falls = (*low < 0) == (b.lo > 0);
        let rises = (*high > 0) == (b.lo > 0);
        self.put(bits, low / if falls { near } else { far }, high / if rises { near } else { far });
    }
    fn set_powi(&mut self, a: &Self, n: i32) {
        let power = |x| Pow::pow(x, n);
        match n {
            _ if !a.is_bounded() => self.invalidate(a.bits()),
            0 => self.put(a.bits(), 1, 1),
            _ if n < 0 && !a.excludes_zero() => self.invalidate(a.bits()),
            _ if n % 2 == 0 && n > 0 => self.even(a, 0, power),
            _ if n > 0 || n % 2 == 0 && a.hi < 0 => self.rising(a, power),
            _ => self.falling(a, power),
        }
    }
    fn set_pow(&mut self, a: &Self, b: &Self) {
        match Interval::common(a, b) {
            // 0⁰ is one, and zero to every positive power zero: continuous only where the exponent stays positive.
            Ok(bits) if a.lo > 0 || a.lo >= 0 && b.lo > 0 => self.corners(bits, (a, b), |x, y| x.pow(y)),
            Ok(bits) | Err(bits) => self.invalidate(bits),
        }
    }
    fn set_sqrt(&mut self, a: &Self) {
        self.rising(a, Float::sqrt_ref);
    }
    fn set_call(&mut self, f: Func, a: &Self) {
        if !a.is_bounded() {
            return self.invalidate(a.bits());
        }
        match f {
            Func::Sin => self.wave(a, Half::Odd, Float::sin_ref),
            Func::Cos => self.wave(a, Half::Even, Float::cos_ref),
            Func::Tan => self.tangent(a),
            Func::Asin => self.rising(a, Float::asin_ref),
            Func::Acos => self.falling(a, Float::acos_ref),
            Func::Atan => self.rising(a, Float::atan_ref),
            Func::Sinh => self.rising(a, Float::sinh_ref),
            Func::Cosh => self.even(a, 1, Float::cosh_ref),
            Func::Tanh => self.rising(a, Float::tanh_ref),
            Func::Asinh => self.rising(a, Float::asinh_ref),
            Func::Acosh => self.rising(a, Float::acosh_ref),
            Func::Atanh => self.rising(a, Float::atanh_ref),
            Func::Exp => self.rising(a, Float::exp_ref),
            Func::Ln => self.rising(a, Float::ln_ref),
            Func::Abs => self.even(a, 0, Float::abs_ref),
            Func::Sign => match a.sign() {
                Some(sign) => self.put(a.bits(), sign as i32, sign as i32),
                None => self.invalidate(a.bits()),
            },
        }
    }
    fn set_atan2(&mut self, y: &Self, x: &Self) {
        let bits = match Interval::common(y, x) {
            Ok(bits) => bits,
            Err(bits) => return self.invalidate(bits),
        };
        let beyond_cut = x.lo > 0 || y.lo >= 0 || y.hi < 0;
        let origin = !x.excludes_zero() && !y.excludes_zero();
        if origin || !beyond_cut {
            return self.invalidate(bits);
        }
        // A zero with a sign would tell on which side of the cut it lies only by chance.
        let plain = |a: &Self| Interval { lo: unsigned_zero(&a.lo), hi: unsigned_zero(&a.hi) };
        let (y, x) = (plain(y), plain(x));
        self.corners(bits, (&y, &x), |y, x| y.atan2_ref(x));
    }

    fn to_f64(&self) -> f64 {
        self.midpoint().to_f64()
    }
    fn log2_abs(&self) -> f64 {
        if self.is_bounded() { super::Mpfr(self.larger().clone()).log2_abs() } else { f64::NAN }
    }
    fn is_finite(&self) -> bool {
        self.is_bounded()
    }
    fn to_decimal(&self, digits: usize) -> String {
        super::Mpfr(self.midpoint()).to_decimal(digits)
    }
}
