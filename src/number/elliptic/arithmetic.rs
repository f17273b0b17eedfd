//! The arithmetic that the algorithms of this folder need: that of algebra, and π. Whatever has it can run them:
//! numbers with guard digits for a value, and [`Spread`]s for how far the errors of operands carry.

use super::super::Number;

/// A number for algebraic computations. Undefined results are not finite.
pub(in crate::number) trait Arithmetic: Clone {
    /// A machine number, of this number's precision.
    fn constant(&self, x: f64) -> Self;
    /// π, of this number's precision.
    fn half_turn(&self) -> Self;
    /// a + b.
    fn sum(&self, b: &Self) -> Self;
    /// a - b.
    fn difference(&self, b: &Self) -> Self;
    /// a b.
    fn product(&self, b: &Self) -> Self;
    /// a / b.
    fn quotient(&self, b: &Self) -> Self;
    /// √a.
    fn square_root(&self) -> Self;
    /// -a.
    fn opposite(&self) -> Self;
    /// The machine number nearest to it, but for some units in the last place.
    fn approx(&self) -> f64;
    /// log₂|a|, also beyond the range of machine numbers.
    fn log2_size(&self) -> f64;
    /// The bits of the unit roundoff.
    fn bits(&self) -> u32;

    /// Whether it is neither infinite nor undefined.
    fn is_known(&self) -> bool {
        !self.log2_size().is_nan() && self.log2_size() < f64::INFINITY
    }
    /// The product with a machine number.
    fn by(&self, x: f64) -> Self {
        self.product(&self.constant(x))
    }
    /// a².
    fn square(&self) -> Self {
        self.product(self)
    }
    /// a + x.
    fn more(&self, x: f64) -> Self {
        self.sum(&self.constant(x))
    }
    /// |a|.
    fn size(&self) -> Self {
        if self.approx() < 0.0 { self.opposite() } else { self.clone() }
    }
    /// Not a number.
    fn undefined(&self) -> Self {
        self.constant(f64::NAN)
    }
    /// ∞, or whatever else is not finite.
    fn infinite(&self) -> Self {
        self.constant(f64::INFINITY)
    }
}

impl<N: Number> Arithmetic for N {
    fn constant(&self, x: f64) -> Self {
        self.like(x)
    }
    fn half_turn(&self) -> Self {
        N::pi(&self.context())
    }
    fn sum(&self, b: &Self) -> Self {
        self.plus(b)
    }
    fn difference(&self, b: &Self) -> Self {
        self.minus(b)
    }
    fn product(&self, b: &Self) -> Self {
        self.times(b)
    }
    fn quotient(&self, b: &Self) -> Self {
        self.over(b)
    }
    fn square_root(&self) -> Self {
        Number::root(self)
    }
    fn opposite(&self) -> Self {
        self.negated()
    }
    fn approx(&self) -> f64 {
        self.to_f64()
    }
    fn log2_size(&self) -> f64 {
        self.log2_abs()
    }
    fn bits(&self) -> u32 {
        N::precision_bits(&self.context())
    }
    fn is_known(&self) -> bool {
        Number::is_finite(self)
    }
}

/// A value and how far it can move when the operands of a computation move within their errors. Roundings are not
/// counted: the value has guard digits.
///
/// Promise: the bound is not only of first order; where an operation has none (division by what may be zero), it is
/// infinite.
#[derive(Clone, Debug)]
pub(in crate::number) struct Spread<W> {
    /// The value.
    pub value: W,
    /// How far it can move, in units of 2^-`unit`.
    pub radius: f64,
    /// What radii are measured in.
    pub unit: u32,
}

/// Covers the roundings in computing a bound.
const UP: f64 = 1.0 + 64.0 * f64::EPSILON;

impl<W: Arithmetic> Spread<W> {
    fn made(&self, value: W, radius: f64) -> Self {
        let known = !radius.is_nan() && value.is_known();
        Spread { value, radius: if known { radius * UP } else { f64::INFINITY }, unit: self.unit }
    }

    /// At least |value|.
    fn most(&self) -> f64 {
        self.value.approx().abs() * UP + f64::MIN_POSITIVE
    }

    /// At least the radius, as far as a machine number can be so small.
    fn absolute(&self) -> f64 {
        if self.radius == 0.0 { 0.0 } else { self.radius * f64::exp2(-f64::from(self.unit.min(900))) * UP }
    }

    /// The least that the magnitude can be.
    fn least(&self) -> f64 {
        (self.value.approx().abs().min(f64::MAX) / UP - self.absolute()).max(0.0)
    }
}

/// The product of a slope and an error, where nothing moves if there is no error, however steep the slope.
fn moved(slope: f64, error: f64) -> f64 {
    if error == 0.0 { 0.0 } else { slope * error }
}

impl<W: Arithmetic> Arithmetic for Spread<W> {
    fn constant(&self, x: f64) -> Self {
        Spread { value: self.value.constant(x), radius: 0.0, unit: self.unit }
    }
    fn half_turn(&self) -> Self {
        Spread { value: self.value.half_turn(), radius: 0.0, unit: self.unit }
    }
    fn sum(&self, b: &Self) -> Self {
        self.made(self.value.sum(&b.value), self.radius + b.radius)
    }
    fn difference(&self, b: &Self) -> Self {
        self.made(self.value.difference(&b.value), self.radius + b.radius)
    }
    fn product(&self, b: &Self) -> Self {
        let radius = moved(self.most(), b.radius) + moved(b.most() + b.absolute(), self.radius);
        self.made(self.value.product(&b.value), radius)
    }
    fn square(&self) -> Self {
        self.made(self.value.square(), moved(2.0 * self.most() + self.absolute(), self.radius))
    }
    fn quotient(&self, b: &Self) -> Self {
        let value = self.value.quotient(&b.value);
        // |a/b - â/b̂| ≤ (ea + |â/b̂| eb) / (|b̂| - eb)
        let size = value.approx().abs() * UP + f64::MIN_POSITIVE;
        let distance = self.radius + moved(size, b.radius);
        let radius = if distance == 0.0 { 0.0 } else { distance / b.least() };
        self.made(value, radius)
    }
    fn square_root(&self) -> Self {
        let low = self.least();
        let radius = match self.radius == 0.0 {
            true => 0.0,
            // √ over [a - ea, a + ea] moves by at most ea / (√a + √(a - ea)).
            false if low > 0.0 => self.radius / (low.sqrt() + (self.value.approx().abs() / UP).sqrt()),
            false => f64::INFINITY,
        };
        self.made(self.value.square_root(), radius)
    }
    fn opposite(&self) -> Self {
        Spread { value: self.value.opposite(), ..*self }
    }
    fn approx(&self) -> f64 {
        self.value.approx()
    }
    fn log2_size(&self) -> f64 {
        self.value.log2_size()
    }
    fn bits(&self) -> u32 {
        self.value.bits()
    }
    fn is_known(&self) -> bool {
        self.value.is_known()
    }
}
