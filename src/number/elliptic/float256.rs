//! Binary floating point with 256 bits: the guard digits of double-doubles, and of machine numbers where 104 bits are
//! not enough.
//!
//! Every operation truncates: its result is right to 2^-250 relatively. Exponents are so large that nothing of a
//! practical size over- or underflows; what does, and what is undefined, becomes a number that is not finite.

use super::super::Df64;
use super::arithmetic::Arithmetic;

const WORDS: usize = 4;
/// The words of a fraction, the first the most significant.
type Fraction = [u64; WORDS];
/// A fraction with a word of guard bits.
type Guarded = [u64; WORDS + 1];

/// ± 0.fraction · 2^exponent, where the first bit of the fraction is set unless the number is zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::number) struct Float256 {
    negative: bool,
    exponent: i64,
    fraction: Fraction,
}

/// Stands for what is not finite.
const UNDEFINED: Float256 = Float256 { negative: false, exponent: i64::MAX, fraction: [0; WORDS] };
const ZERO: Float256 = Float256 { negative: false, exponent: 0, fraction: [0; WORDS] };
/// π/4 = 0.11001001000011111101…
const PI: Float256 = Float256 {
    negative: false,
    exponent: 2,
    fraction: [0xc90fdaa22168c234, 0xc4c6628b80dc1cd1, 0x29024e088a67cc74, 0x020bbea63b139b22],
};
/// Exponents beyond this are not finite.
const LARGEST: i64 = 1 << 60;

impl Float256 {
    fn is_zero(&self) -> bool {
        self.fraction[0] == 0 && self.exponent == 0
    }

    fn is_undefined(&self) -> bool {
        self.exponent == i64::MAX
    }

    /// The number with this fraction, whose leading zeros are taken off.
    fn normalised(negative: bool, exponent: i64, fraction: Guarded) -> Self {
        let Some(first) = fraction.iter().position(|word| *word != 0) else { return ZERO };
        let shift = 64 * first as u32 + fraction[first].leading_zeros();
        let shifted = shifted_left(fraction, shift);
        let exponent = exponent - i64::from(shift);
        if exponent.abs() > LARGEST {
            return if exponent < 0 { ZERO } else { UNDEFINED };
        }
        Float256 { negative, exponent, fraction: [shifted[0], shifted[1], shifted[2], shifted[3]] }
    }

    fn scaled(self, binades: i64) -> Self {
        if self.is_zero() || self.is_undefined() {
            return self;
        }
        Self::normalised(self.negative, self.exponent + binades, guarded(self.fraction))
    }

    /// The machine number that is the sum's first part, from the first 64 bits.
    fn leading(&self, exponent: i64) -> f64 {
        let size = self.fraction[0] as f64 * f64::exp2(-64.0);
        let size = if exponent.abs() < 900 {
            size * f64::exp2(exponent as f64)
        } else {
            // In two steps, so that what is subnormal is rounded once.
            let half = exponent.clamp(-4000, 4000) / 2;
            size * f64::exp2(half as f64) * f64::exp2((exponent.clamp(-4000, 4000) - half) as f64)
        };
        if self.negative { -size } else { size }
    }

    /// 1/x for a fraction x in [1/4, 1), by Newton's method: 53, 104, 208, 256 bits.
    fn reciprocal(x: &Self) -> Self {
        let one = x.constant(1.0);
        (0..3).fold(x.constant(1.0 / x.approx()), |y, _| y.sum(&y.product(&one.difference(&x.product(&y)))))
    }

    /// 1/√x for a fraction x in [1/4, 1).
    fn reciprocal_root(x: &Self) -> Self {
        let one = x.constant(1.0);
        (0..3).fold(x.constant(1.0 / x.approx().sqrt()), |y, _| {
            let rest = one.difference(&x.product(&y.product(&y)));
            y.sum(&y.product(&rest).scaled(-1))
        })
    }

    /// The nearest double-double, but for a unit of its last place.
    pub fn to_df64(self) -> Df64 {
        let high = self.approx();
        if !high.is_finite() || high.abs() < f64::MIN_POSITIVE {
            return Df64::from(high);
        }
        let low = self.difference(&self.constant(high)).approx();
        Df64::from(high) + Df64::from(low)
    }

    /// A double-double, exactly unless its parts are 200 binades apart.
    pub fn from_df64(x: Df64) -> Self {
        ZERO.constant(x.hi()).sum(&ZERO.constant(x.lo()))
    }
}

fn guarded(x: Fraction) -> Guarded {
    [x[0], x[1], x[2], x[3], 0]
}

fn shifted_left(x: Guarded, bits: u32) -> Guarded {
    let (words, bits) = ((bits / 64) as usize, bits % 64);
    let word = |i: usize| x.get(i).copied().unwrap_or(0);
    std::array::from_fn(|i| {
        let high = word(i + words) << bits;
        if bits == 0 { high } else { high | word(i + words + 1) >> (64 - bits) }
    })
}

fn shifted_right(x: Guarded, bits: u64) -> Guarded {
    let (words, bits) = ((bits / 64).min(8) as usize, (bits % 64) as u32);
    let word = |i: usize, back: usize| i.checked_sub(back).and_then(|i| x.get(i)).copied().unwrap_or(0);
    std::array::from_fn(|i| {
        let low = word(i, words) >> bits;
        if bits == 0 { low } else { low | word(i, words + 1) << (64 - bits) }
    })
}

/// a + b and the carry.
fn added(a: Guarded, b: Guarded) -> (Guarded, bool) {
    let (mut sum, mut carry) = (a, false);
    for i in (0..=WORDS).rev() {
        let (partial, first) = a[i].overflowing_add(b[i]);
        let (total, second) = partial.overflowing_add(u64::from(carry));
        (sum[i], carry) = (total, first || second);
    }
    (sum, carry)
}

/// a - b for a ≥ b.
fn subtracted(a: Guarded, b: Guarded) -> Guarded {
    let (mut rest, mut borrow) = (a, false);
    for i in (0..=WORDS).rev() {
        let (partial, first) = a[i].overflowing_sub(b[i]);
        let (total, second) = partial.overflowing_sub(u64::from(borrow));
        (rest[i], borrow) = (total, first || second);
    }
    rest
}

/// The first words of the product.
fn multiplied(a: Fraction, b: Fraction) -> Guarded {
    let mut words = [0_u64; 2 * WORDS];
    for i in (0..WORDS).rev() {
        let mut carry = 0_u128;
        for j in (0..WORDS).rev() {
            let wide = u128::from(a[i]) * u128::from(b[j]) + u128::from(words[i + j + 1]) + carry;
            words[i + j + 1] = wide as u64;
            carry = wide >> 64;
        }
        words[i] = carry as u64;
    }
    [words[0], words[1], words[2], words[3], words[4]]
}

impl Arithmetic for Float256 {
    fn constant(&self, x: f64) -> Self {
        if !x.is_finite() {
            return UNDEFINED;
        }
        let bits = x.abs().to_bits();
        let (field, rest) = ((bits >> 52) as i64, bits & ((1 << 52) - 1));
        let (mantissa, exponent) = if field == 0 { (rest, -1074) } else { (rest | 1 << 52, field - 1075) };
        Self::normalised(x < 0.0, exponent + 64, [mantissa, 0, 0, 0, 0])
    }
    fn half_turn(&self) -> Self {
        PI
    }
    fn sum(&self, b: &Self) -> Self {
        if self.is_undefined() || b.is_undefined() {
            return UNDEFINED;
        }
        if self.is_zero() || b.is_zero() {
            return if self.is_zero() { *b } else { *self };
        }
        let order = (self.exponent, self.fraction) >= (b.exponent, b.fraction);
        let (large, small) = if order { (self, b) } else { (b, self) };
        let aligned = shifted_right(guarded(small.fraction), large.exponent.abs_diff(small.exponent));
        if large.negative != small.negative {
            let rest = subtracted(guarded(large.fraction), aligned);
            return Self::normalised(large.negative, large.exponent, rest);
        }
        let (mut total, carry) = added(guarded(large.fraction), aligned);
        if carry {
            total = shifted_right(total, 1);
            total[0] |= 1 << 63;
        }
        Self::normalised(large.negative, large.exponent + i64::from(carry), total)
    }
    fn difference(&self, b: &Self) -> Self {
        self.sum(&b.opposite())
    }
    fn product(&self, b: &Self) -> Self {
        if self.is_undefined() || b.is_undefined() {
            return UNDEFINED;
        }
        if self.is_zero() || b.is_zero() {
            return ZERO;
        }
        let product = multiplied(self.fraction, b.fraction);
        Self::normalised(self.negative != b.negative, self.exponent + b.exponent, product)
    }
    fn quotient(&self, b: &Self) -> Self {
        if self.is_undefined() || b.is_undefined() || b.is_zero() {
            return UNDEFINED;
        }
        let divisor = Float256 { exponent: 0, ..*b };
        self.product(&Self::reciprocal(&divisor)).scaled(-b.exponent)
    }
    fn square_root(&self) -> Self {
        if self.is_undefined() || self.negative {
            return UNDEFINED;
        }
        if self.is_zero() {
            return ZERO;
        }
        let odd = self.exponent.rem_euclid(2);
        let x = Float256 { exponent: -odd, ..*self };
        x.product(&Self::reciprocal_root(&x)).scaled((self.exponent + odd) / 2)
    }
    fn opposite(&self) -> Self {
        Float256 { negative: !self.negative && !self.is_zero(), ..*self }
    }
    fn approx(&self) -> f64 {
        if self.is_undefined() { f64::NAN } else { self.leading(self.exponent) }
    }
    fn log2_size(&self) -> f64 {
        match (self.is_undefined(), self.is_zero()) {
            (true, _) => f64::NAN,
            (_, true) => f64::NEG_INFINITY,
            _ => self.leading(0).abs().log2() + self.exponent as f64,
        }
    }
    fn bits(&self) -> u32 {
        250
    }
}

#[cfg(all(test, feature = "rug"))]
mod tests {
    use super::*;
    use crate::number::conformance::Random;
    use rug::Float;

    fn exact(x: &Float256) -> Float {
        let mut value = Float::with_val(400, 0);
        for word in x.fraction.iter().rev() {
            value = (value + *word) >> 64_i32;
        }
        value <<= x.exponent as i32;
        if x.negative { -value } else { value }
    }

    fn random(random: &mut Random) -> Float256 {
        let mut x = ZERO.constant(random.wide(90.0));
        x.fraction = [x.fraction[0], random.bits(), random.bits(), random.bits()];
        x
    }

    #[test]
    fn operations_round_as_promised() {
        let mut source = Random::new(9);
        let mut worst = [0.0_f64; 5];
        for _ in 0..20_000 {
            let (a, mut b) = (random(&mut source), random(&mut source));
            if source.below(3) == 0 {
                // Nearly equal, of one or several binades.
                b = Float256 { negative: !a.negative, exponent: a.exponent - source.below(2) as i64, ..a };
                b.fraction[3 - source.below(4)] ^= 1 << source.below(63);
            }
            let (x, y) = (exact(&a), exact(&b));
            let size = Float256 { negative: false, ..a };
            let cases = [
                (a.sum(&b), Float::with_val(600, &x + &y)),
                (a.difference(&b), Float::with_val(600, &x - &y)),
                (a.product(&b), Float::with_val(600, &x * &y)),
                (a.quotient(&b), Float::with_val(600, &x / &y)),
                (size.square_root(), Float::with_val(600, x.abs().sqrt())),
            ];
            for (worst, (got, expect)) in worst.iter_mut().zip(cases) {
                let error = Float::with_val(600, exact(&got) - &expect) / &expect;
                *worst = worst.max((error.to_f64().abs() * f64::exp2(250.0)).abs());
            }
        }
        println!("Float256 +, -, *, /, √: {worst:?} units of 2^-250");
        assert!(worst.iter().all(|w| *w < 1.0), "{worst:?}");
    }

    #[test]
    fn constants_and_extremes() {
        let pi = Float::with_val(256, rug::float::Constant::Pi);
        assert!((exact(&PI) - pi).abs() < f64::exp2(-253.0));
        for x in [0.0, 1.0, -2.5, f64::MAX, f64::MIN_POSITIVE, 5e-324, -1e-310] {
            assert_eq!(ZERO.constant(x).approx(), x);
        }
        let one = ZERO.constant(1.0);
        assert!(!one.quotient(&ZERO).is_known() && !one.opposite().square_root().is_known());
        assert!(!ZERO.constant(f64::NAN).is_known() && !ZERO.constant(f64::INFINITY).is_known());
        assert_eq!(one.difference(&one), ZERO);
        assert_eq!(one.opposite().sum(&one), ZERO);
        let x = Df64::from(1.0) - Df64::from(1e-25);
        assert_eq!(Float256::from_df64(x).to_df64(), x);
        let huge = (0..70).fold(ZERO.constant(1e300), |x, _| x.product(&x));
        assert!(!huge.is_known());
        assert!(one.quotient(&(0..55).fold(ZERO.constant(2.0), |x, _| x.product(&x))).is_known());
    }
}
