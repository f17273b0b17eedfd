//! Binary floating point with 128 or 256 bits: the guard digits of double-doubles, and of machine numbers where 104 bits
//! are not enough.
//!
//! Every operation truncates: its result is right to 2^-122 or 2^-250 relatively. Exponents are so large that nothing of
//! a practical size over- or underflows; what does, and what is undefined, becomes a number that is not finite.

use super::super::Df64;
use super::arithmetic::Arithmetic;

/// The most words of a fraction.
const MOST: usize = 4;
/// The bits that the roundings of one operation take.
const ROUNDED: u32 = 6;

/// ± 0.fraction · 2^exponent, where the first bit of the fraction is set unless the number is zero. The fraction has
/// `W` words, two or four, of which the first is the most significant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::number) struct Wide<const W: usize> {
    negative: bool,
    exponent: i64,
    fraction: [u64; W],
}

/// The first words of π/4 = 0.11001001000011111101…
const QUARTER: [u64; MOST] = [0xc90fdaa22168c234, 0xc4c6628b80dc1cd1, 0x29024e088a67cc74, 0x020bbea63b139b22];
/// Exponents beyond this are not finite.
const LARGEST: i64 = 1 << 60;

/// A fraction with a word of guard bits.
#[derive(Clone, Copy)]
struct Guarded<const W: usize> {
    fraction: [u64; W],
    guard: u64,
}

impl<const W: usize> Guarded<W> {
    fn new(fraction: [u64; W]) -> Self {
        Guarded { fraction, guard: 0 }
    }

    /// Shifted by fewer than 64 bits.
    fn left(mut self, bits: u32) -> Self {
        if bits > 0 {
            for i in 0..W {
                let next = if i + 1 < W { self.fraction[i + 1] } else { self.guard };
                self.fraction[i] = self.fraction[i] << bits | next >> (64 - bits);
            }
            self.guard <<= bits;
        }
        self
    }

    fn right(mut self, bits: u64) -> Self {
        let words = (bits / 64).min(W as u64 + 1);
        for _ in 0..words {
            self.guard = self.fraction[W - 1];
            self.fraction.copy_within(0..W - 1, 1);
            self.fraction[0] = 0;
        }
        let bits = (bits % 64) as u32;
        if bits > 0 {
            self.guard = self.guard >> bits | self.fraction[W - 1] << (64 - bits);
            for i in (0..W).rev() {
                let above = if i > 0 { self.fraction[i - 1] << (64 - bits) } else { 0 };
                self.fraction[i] = self.fraction[i] >> bits | above;
            }
        }
        self
    }

    /// The sum and its carry.
    fn plus(mut self, b: &Self) -> (Self, bool) {
        let (guard, mut carry) = self.guard.overflowing_add(b.guard);
        self.guard = guard;
        for i in (0..W).rev() {
            let (partial, first) = self.fraction[i].overflowing_add(b.fraction[i]);
            let (total, second) = partial.overflowing_add(u64::from(carry));
            (self.fraction[i], carry) = (total, first || second);
        }
        (self, carry)
    }

    /// The difference from what is not larger.
    fn minus(mut self, b: &Self) -> Self {
        let (guard, mut borrow) = self.guard.overflowing_sub(b.guard);
        self.guard = guard;
        for i in (0..W).rev() {
            let (partial, first) = self.fraction[i].overflowing_sub(b.fraction[i]);
            let (total, second) = partial.overflowing_sub(u64::from(borrow));
            (self.fraction[i], borrow) = (total, first || second);
        }
        self
    }

    /// The first words of the product.
    fn product(a: &[u64; W], b: &[u64; W]) -> Self {
        let mut words = [0_u64; 2 * MOST];
        for i in (0..W).rev() {
            let mut carry = 0_u128;
            for j in (0..W).rev() {
                let wide = u128::from(a[i]) * u128::from(b[j]) + u128::from(words[i + j + 1]) + carry;
                words[i + j + 1] = wide as u64;
                carry = wide >> 64;
            }
            words[i] = carry as u64;
        }
        Guarded { fraction: std::array::from_fn(|i| words[i]), guard: words[W] }
    }
}

impl<const W: usize> Wide<W> {
    const ZERO: Self = Wide { negative: false, exponent: 0, fraction: [0; W] };
    /// Stands for what is not finite.
    const UNDEFINED: Self = Wide { negative: false, exponent: i64::MAX, fraction: [0; W] };
    /// Newton's steps from a machine number to the whole fraction: 53, 104, 208, 256 bits.
    const STEPS: u32 = if W <= 2 { 2 } else { 3 };

    fn is_zero(&self) -> bool {
        self.fraction[0] == 0 && self.exponent == 0
    }

    fn is_undefined(&self) -> bool {
        self.exponent == i64::MAX
    }

    /// The number with this fraction, whose leading zeros are taken off.
    fn normalised(negative: bool, mut exponent: i64, mut x: Guarded<W>) -> Self {
        // Whole words of zeros are what is left where nearly equal numbers are subtracted.
        for _ in 0..=W {
            if x.fraction[0] != 0 {
                break;
            }
            x.fraction.copy_within(1.., 0);
            (x.fraction[W - 1], x.guard) = (x.guard, 0);
            exponent -= 64;
        }
        let shift = x.fraction[0].leading_zeros();
        if shift == 64 {
            return Self::ZERO;
        }
        Self::checked(negative, exponent - i64::from(shift), x.left(shift).fraction)
    }

    /// The number, unless its exponent is out of all bounds.
    fn checked(negative: bool, exponent: i64, fraction: [u64; W]) -> Self {
        match exponent {
            LARGEST.. => Self::UNDEFINED,
            _ if exponent < -LARGEST => Self::ZERO,
            _ => Wide { negative, exponent, fraction },
        }
    }

    fn scaled(self, binades: i64) -> Self {
        if self.is_zero() || self.is_undefined() {
            return self;
        }
        Self::checked(self.negative, self.exponent + binades, self.fraction)
    }

    /// The machine number that is the sum's first part, from the first 64 bits.
    fn leading(&self, exponent: i64) -> f64 {
        let size = self.fraction[0] as f64 * BIT_64;
        let size = match exponent {
            -900..=900 => size * power_of_two(exponent),
            _ => {
                // In two steps, so that what is subnormal is rounded once.
                let half = exponent.clamp(-4000, 4000) / 2;
                size * f64::exp2(half as f64) * f64::exp2((exponent.clamp(-4000, 4000) - half) as f64)
            }
        };
        if self.negative { -size } else { size }
    }

    /// 1/x for a fraction x in [1/4, 1), by Newton's method.
    fn reciprocal(x: &Self) -> Self {
        let one = x.constant(1.0);
        let start = x.constant(1.0 / x.approx());
        (0..Self::STEPS).fold(start, |y, _| y.sum(&y.product(&one.difference(&x.product(&y)))))
    }

    /// 1/√x for a fraction x in [1/4, 1).
    fn reciprocal_root(x: &Self) -> Self {
        let one = x.constant(1.0);
        (0..Self::STEPS).fold(x.constant(1.0 / x.approx().sqrt()), |y, _| {
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

    /// A double-double, exactly unless its parts are farther apart than the fraction is long.
    pub fn from_df64(x: Df64) -> Self {
        Self::ZERO.constant(x.hi()).sum(&Self::ZERO.constant(x.lo()))
    }
}

/// 2^-64.
const BIT_64: f64 = f64::from_bits((1023 - 64) << 52);

/// 2^exponent of an exponent within ±1000.
fn power_of_two(exponent: i64) -> f64 {
    f64::from_bits(((1023 + exponent) as u64) << 52)
}

impl<const W: usize> Arithmetic for Wide<W> {
    fn constant(&self, x: f64) -> Self {
        if !x.is_finite() {
            return Self::UNDEFINED;
        }
        let bits = x.abs().to_bits();
        let (field, rest) = ((bits >> 52) as i64, bits & ((1 << 52) - 1));
        let (mantissa, exponent) = if field == 0 { (rest, -1074) } else { (rest | 1 << 52, field - 1075) };
        let shift = mantissa.leading_zeros();
        if shift == 64 {
            return Self::ZERO;
        }
        let mut fraction = [0; W];
        fraction[0] = mantissa << shift;
        Wide { negative: x < 0.0, exponent: exponent + 64 - i64::from(shift), fraction }
    }
    fn half_turn(&self) -> Self {
        Wide { negative: false, exponent: 2, fraction: std::array::from_fn(|i| QUARTER[i]) }
    }
    fn sum(&self, b: &Self) -> Self {
        if self.is_undefined() || b.is_undefined() {
            return Self::UNDEFINED;
        }
        if self.is_zero() || b.is_zero() {
            return if self.is_zero() { *b } else { *self };
        }
        let order = (self.exponent, self.fraction) >= (b.exponent, b.fraction);
        let (large, small) = if order { (self, b) } else { (b, self) };
        let aligned = Guarded::new(small.fraction).right(large.exponent.abs_diff(small.exponent));
        let first = Guarded::new(large.fraction);
        if large.negative != small.negative {
            return Self::normalised(large.negative, large.exponent, first.minus(&aligned));
        }
        let (mut total, carry) = first.plus(&aligned);
        if carry {
            total = total.right(1);
            total.fraction[0] |= 1 << 63;
        }
        Self::checked(large.negative, large.exponent + i64::from(carry), total.fraction)
    }
    fn difference(&self, b: &Self) -> Self {
        self.sum(&b.opposite())
    }
    fn product(&self, b: &Self) -> Self {
        if self.is_undefined() || b.is_undefined() {
            return Self::UNDEFINED;
        }
        if self.is_zero() || b.is_zero() {
            return Self::ZERO;
        }
        let product = Guarded::product(&self.fraction, &b.fraction);
        Self::normalised(self.negative != b.negative, self.exponent + b.exponent, product)
    }
    fn quotient(&self, b: &Self) -> Self {
        if self.is_undefined() || b.is_undefined() || b.is_zero() {
            return Self::UNDEFINED;
        }
        let divisor = Wide { exponent: 0, ..*b };
        self.product(&Self::reciprocal(&divisor)).scaled(-b.exponent)
    }
    fn square_root(&self) -> Self {
        if self.is_undefined() || self.negative {
            return Self::UNDEFINED;
        }
        if self.is_zero() {
            return Self::ZERO;
        }
        let odd = self.exponent.rem_euclid(2);
        let x = Wide { exponent: -odd, ..*self };
        x.product(&Self::reciprocal_root(&x)).scaled((self.exponent + odd) / 2)
    }
    fn opposite(&self) -> Self {
        Wide { negative: !self.negative && !self.is_zero(), ..*self }
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
        64 * W as u32 - ROUNDED
    }
    fn is_known(&self) -> bool {
        !self.is_undefined()
    }
}

#[cfg(all(test, feature = "rug"))]
mod tests {
    use super::*;
    use crate::number::conformance::Random;
    use rug::Float;

    fn exact<const W: usize>(x: &Wide<W>) -> Float {
        let mut value = Float::with_val(400, 0);
        for word in x.fraction.iter().rev() {
            value = (value + *word) >> 64_i32;
        }
        value <<= x.exponent as i32;
        if x.negative { -value } else { value }
    }

    fn random<const W: usize>(random: &mut Random) -> Wide<W> {
        let mut x = Wide::<W>::ZERO.constant(random.wide(90.0));
        x.fraction.iter_mut().skip(1).for_each(|word| *word = random.bits());
        x
    }

    fn operations_round_as_promised<const W: usize>() {
        let mut source = Random::new(9);
        let mut worst = [0.0_f64; 5];
        for _ in 0..20_000 {
            let (a, mut b) = (random::<W>(&mut source), random::<W>(&mut source));
            if source.below(3) == 0 {
                // Nearly equal, of one or several binades.
                b = Wide { negative: !a.negative, exponent: a.exponent - source.below(2) as i64, ..a };
                b.fraction[W - 1 - source.below(W)] ^= 1 << source.below(63);
            }
            let (x, y) = (exact(&a), exact(&b));
            let size = Wide { negative: false, ..a };
            let cases = [
                (a.sum(&b), Float::with_val(600, &x + &y)),
                (a.difference(&b), Float::with_val(600, &x - &y)),
                (a.product(&b), Float::with_val(600, &x * &y)),
                (a.quotient(&b), Float::with_val(600, &x / &y)),
                (size.square_root(), Float::with_val(600, x.abs().sqrt())),
            ];
            for (worst, (got, expect)) in worst.iter_mut().zip(cases) {
                let error = Float::with_val(600, exact(&got) - &expect) / &expect;
                *worst = worst.max((error.to_f64().abs() * f64::exp2(a.bits().into())).abs());
            }
        }
        println!("{W} words, +, -, *, /, √: {worst:?} units of 2^-{}", Wide::<W>::ZERO.bits());
        assert!(worst.iter().all(|w| *w < 1.0), "{worst:?}");
    }

    #[test]
    fn operations_of_two_words_round_as_promised() {
        operations_round_as_promised::<2>();
    }

    #[test]
    fn operations_of_four_words_round_as_promised() {
        operations_round_as_promised::<4>();
    }

    #[test]
    fn constants_and_extremes() {
        let pi = Float::with_val(256, rug::float::Constant::Pi);
        assert!((exact(&Wide::<4>::ZERO.half_turn()) - pi).abs() < f64::exp2(-253.0));
        for x in [0.0, 1.0, -2.5, f64::MAX, f64::MIN_POSITIVE, 5e-324, -1e-310] {
            assert_eq!(Wide::<4>::ZERO.constant(x).approx(), x);
        }
        let one = Wide::<4>::ZERO.constant(1.0);
        assert!(!one.quotient(&Wide::<4>::ZERO).is_known() && !one.opposite().square_root().is_known());
        assert!(!Wide::<4>::ZERO.constant(f64::NAN).is_known() && !Wide::<4>::ZERO.constant(f64::INFINITY).is_known());
        assert_eq!(one.difference(&one), Wide::<4>::ZERO);
        assert_eq!(one.opposite().sum(&one), Wide::<4>::ZERO);
        let x = Df64::from(1.0) - Df64::from(1e-25);
        assert_eq!(Wide::<4>::from_df64(x).to_df64(), x);
        let huge = (0..70).fold(Wide::<4>::ZERO.constant(1e300), |x, _| x.product(&x));
        assert!(!huge.is_known());
        assert!(one.quotient(&(0..55).fold(Wide::<4>::ZERO.constant(2.0), |x, _| x.product(&x))).is_known());
    }
}
