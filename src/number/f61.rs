//! The field of integers modulo the Mersenne prime p = 2^61 - 1, for exact tests of algebraic identities: a polynomial of
//! degree d that is not zero vanishes at a random point with probability at most d/p (Schwartz and Zippel).

use num_traits::{One, Pow, Zero};
use std::ops::{Add, Mul, Neg, Sub};

/// An element of the field, in its least representation.
#[derive(Copy, Clone, Debug, Default, PartialEq, Eq, Hash)]
pub struct F61(u64);

impl F61 {
    /// The number of elements: 2^61 - 1.
    pub const MODULUS: u64 = (1 << 61) - 1;

    /// The element that an integer stands for.
    pub fn new(n: u64) -> Self {
        let folded = (n & Self::MODULUS) + (n >> 61);
        F61(if folded >= Self::MODULUS { folded - Self::MODULUS } else { folded })
    }

    /// The element that a fraction stands for; none where the denominator is a multiple of p.
    pub fn from_ratio(n: i128, d: i128) -> Option<Self> {
        let residue = |x: i128| Self::new(x.rem_euclid(i128::from(Self::MODULUS)) as u64);
        Some(residue(n) * residue(d).inv()?)
    }

    /// The least non-negative integer that stands for the element.
    pub fn residue(self) -> u64 {
        self.0
    }

    /// The inverse; none of zero. By Fermat: a^(p-2).
    pub fn inv(self) -> Option<Self> {
        (!self.is_zero()).then(|| self.pow(Self::MODULUS - 2))
    }

    /// The quotient; none where the divisor is zero.
    pub fn over(self, divisor: Self) -> Option<Self> {
        Some(self * divisor.inv()?)
    }

    /// aⁿ for an integer n; none of zero to a negative power.
    pub fn powi(self, n: i32) -> Option<Self> {
        let power = self.pow(u64::from(n.unsigned_abs()));
        if n < 0 { power.inv() } else { Some(power) }
    }

    /// The square root that is itself a square; none of the half of all elements that have no root. p = 3 (mod 4), so it is
    /// a^((p+1)/4), which is 59 squarings.
    ///
    /// Roots are multiplicative (√a √b = √ab, √a² = ±a), as the positive ones of real numbers are, but know no sign.
    pub fn sqrt(self) -> Option<Self> {
        let root = (0..59).fold(self, |x, _| x * x);
        (root * root == self).then_some(root)
    }

    /// Sine and cosine of the angle whose half has this tangent. There always are: 1 + t² never vanishes, since -1 is no
    /// square.
    pub fn sin_cos(half_tangent: Self) -> Option<(Self, Self)> {
        let square = half_tangent * half_tangent;
        let scale = (Self::one() + square).inv()?;
        Some(((half_tangent + half_tangent) * scale, (Self::one() - square) * scale))
    }
}

impl Add for F61 {
    type Output = F61;
    fn add(self, b: F61) -> F61 {
        F61::new(self.0 + b.0) // below 2^62
    }
}

impl Neg for F61 {
    type Output = F61;
    fn neg(self) -> F61 {
        F61(if self.0 == 0 { 0 } else { F61::MODULUS - self.0 })
    }
}

impl Sub for F61 {
    type Output = F61;
    fn sub(self, b: F61) -> F61 {
        self + -b
    }
}

impl Mul for F61 {
    type Output = F61;
    fn mul(self, b: F61) -> F61 {
        let product = u128::from(self.0) * u128::from(b.0);
        // 2^61 = 1: the upper half is added to the lower one; both are below 2^61.
        F61::new((product as u64 & F61::MODULUS) + (product >> 61) as u64)
    }
}

impl Pow<u64> for F61 {
    type Output = F61;
    fn pow(self, n: u64) -> F61 {
        let bits = (0..u64::BITS - n.leading_zeros()).rev();
        bits.fold(F61(1), |x, bit| if n >> bit & 1 == 1 { x * x * self } else { x * x })
    }
}

impl Zero for F61 {
    fn zero() -> Self {
        F61(0)
    }
    fn is_zero(&self) -> bool {
        self.0 == 0
    }
}

impl One for F61 {
    fn one() -> Self {
        F61(1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const P: u128 = F61::MODULUS as u128;

    fn element() -> impl Strategy<Value = F61> {
        prop_oneof![Just(0), Just(1), Just(F61::MODULUS - 1), Just(F61::MODULUS), any::<u64>()].prop_map(F61::new)
    }

    proptest! {
        #![proptest_config(crate::testing::properties(256))]

        #[test]
        fn arithmetic_is_that_of_remainders(a in element(), b in element(), n in any::<u64>()) {
            let (x, y) = (u128::from(a.residue()), u128::from(b.residue()));
            prop_assert!(x < P && y < P);
            prop_assert_eq!(u128::from((a + b).residue()), (x + y) % P);
            prop_assert_eq!(u128::from((a - b).residue()), (P + x - y) % P);
            prop_assert_eq!(u128::from((a * b).residue()), x * y % P);
            prop_assert_eq!(u128::from((-a).residue()), (P - x) % P);
            prop_assert_eq!(u128::from(F61::new(n).residue()), u128::from(n) % P);
        }

        #[test]
        fn inverses_and_powers(a in element(), n in -50_i32..50) {
            prop_assert_eq!(a.inv().is_none(), a.is_zero());
            if let Some(inverse) = a.inv() {
                prop_assert_eq!(a * inverse, F61::one());
                let by_hand = (0..n.unsigned_abs()).fold(F61::one(), |x, _| x * if n < 0 { inverse } else { a });
                prop_assert_eq!(a.powi(n), Some(by_hand));
            }
        }

        #[test]
        fn roots(a in element(), b in element()) {
            let square = a * a;
            let root = square.sqrt().unwrap();
            prop_assert!(root == a || root == -a);
            prop_assert!(a.is_zero() || (-square).sqrt().is_none(), "-1 is no square");
            let (ra, rb) = ((a * a).sqrt().unwrap(), (b * b).sqrt().unwrap());
            prop_assert_eq!((a * a * b * b).sqrt(), Some(ra * rb));
        }

        #[test]
        fn angles(t in element()) {
            let (s, c) = F61::sin_cos(t).unwrap();
            prop_assert_eq!(s * s + c * c, F61::one());
        }

        #[test]
        fn fractions(n in any::<i64>(), d in 1_i64.., m in any::<i64>()) {
            let element = |n: i64, d: i64| F61::from_ratio(n.into(), d.into()).unwrap();
            prop_assume!(!F61::new(d as u64).is_zero());
            prop_assert_eq!(element(n, d) * element(d, 1), element(n, 1));
            prop_assert_eq!(element(n, d) + element(m, d), F61::from_ratio(i128::from(n) + i128::from(m), d.into()).unwrap());
        }
    }

    #[test]
    fn zero_powers() {
        assert_eq!(F61::zero().powi(-1), None);
        assert_eq!(F61::zero().powi(0), Some(F61::one()));
        assert_eq!(F61::from_ratio(1, 0), None);
        assert_eq!(F61::from_ratio(i128::MIN, -1), F61::from_ratio(4, 1).map(|four| four.pow(63) * F61::new(2)));
    }
}
