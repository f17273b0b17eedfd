//! Elements of the prime field that know how large the rational function is whose value they are.

use num_traits::{One, Zero};

use crate::number::F61;

/// Bounds on the degrees of a rational function's numerator and denominator; they saturate.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Degree {
    /// Of the numerator.
    pub num: u64,
    /// Of the denominator.
    pub den: u64,
}

impl Degree {
    /// Of a polynomial.
    pub fn polynomial(num: u64) -> Self {
        Degree { num, den: 0 }
    }

    fn sum(self, b: Self) -> Self {
        let num = self.num.saturating_add(b.den).max(b.num.saturating_add(self.den));
        Degree { num, den: self.den.saturating_add(b.den) }
    }

    fn product(self, b: Self) -> Self {
        Degree { num: self.num.saturating_add(b.num), den: self.den.saturating_add(b.den) }
    }

    fn inverse(self) -> Self {
        Degree { num: self.den, den: self.num }
    }

    fn power(self, n: u32) -> Self {
        Degree { num: self.num.saturating_mul(n.into()), den: self.den.saturating_mul(n.into()) }
    }

    /// √(a/b) = √(ab)/b, where √(ab) counts as half of what it is the root of.
    fn root(self) -> Self {
        Degree { num: self.num.saturating_add(self.den).div_ceil(2), den: self.den }
    }
}

/// The value of a rational function at a point of the field, with the function's degrees.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Element {
    /// The value.
    pub value: F61,
    /// The degrees.
    pub degree: Degree,
}

impl Element {
    /// A constant.
    pub fn constant(value: F61) -> Self {
        Element { value, degree: Degree::default() }
    }

    /// A variable.
    pub fn variable(value: F61) -> Self {
        Element { value, degree: Degree::polynomial(1) }
    }

    /// An integer.
    pub fn int(n: u32) -> Self {
        Element::constant(F61::new(n.into()))
    }

    /// Whether the value is zero.
    pub fn vanishes(self) -> bool {
        self.value.is_zero()
    }

    /// a + b.
    pub fn plus(self, b: Self) -> Self {
        Element { value: self.value + b.value, degree: self.degree.sum(b.degree) }
    }

    /// a - b.
    pub fn minus(self, b: Self) -> Self {
        Element { value: self.value - b.value, degree: self.degree.sum(b.degree) }
    }

    /// -a.
    pub fn negated(self) -> Self {
        Element { value: -self.value, degree: self.degree }
    }

    /// a b.
    pub fn times(self, b: Self) -> Self {
        Element { value: self.value * b.value, degree: self.degree.product(b.degree) }
    }

    /// a / b; none where b vanishes.
    pub fn over(self, b: Self) -> Option<Self> {
        Some(Element { value: self.value.over(b.value)?, degree: self.degree.product(b.degree.inverse()) })
    }

    /// aⁿ; none of zero to a negative power.
    pub fn powi(self, n: i32) -> Option<Self> {
        let degree = self.degree.power(n.unsigned_abs());
        Some(Element { value: self.value.powi(n)?, degree: if n < 0 { degree.inverse() } else { degree } })
    }

    /// A square root; none where there is none, and none of zero, whose roots are not two.
    pub fn sqrt(self) -> Option<Self> {
        let value = self.value.sqrt().filter(|root| !root.is_zero())?;
        Some(Element { value, degree: self.degree.root() })
    }
}

/// Cosine and sine.
pub(super) type Rotation = (F61, F61);

/// The rotation by the sum of two angles.
pub(super) fn turned((c, s): Rotation, (d, t): Rotation) -> Rotation {
    (c * d - s * t, s * d + c * t)
}

/// The rotation by a multiple of an angle.
pub(super) fn multiple((c, s): Rotation, n: i64) -> Rotation {
    let base = if n < 0 { (c, -s) } else { (c, s) };
    let n = n.unsigned_abs();
    let bits = (0..u64::BITS - n.leading_zeros()).rev();
    bits.fold((F61::one(), F61::zero()), |r, bit| {
        let square = turned(r, r);
        if n >> bit & 1 == 1 { turned(square, base) } else { square }
    })
}

/// The rotation by quarter turns.
pub(super) fn quarters(n: u8) -> Rotation {
    let i = (F61::zero(), F61::one());
    multiple(i, i64::from(n % 4))
}

/// An element of the field drawn with equal chances, from a source of random bits.
pub fn uniform(random: &mut dyn FnMut() -> u64) -> F61 {
    loop {
        let bits = random() >> 3; // 61 of them
        if bits != F61::MODULUS {
            return F61::new(bits);
        }
    }
}
