//! Reduction of angles of any size to a quadrant and an angle within π/4, by the method of Payne and Hanek (1983): only
//! those bits of 2/π are multiplied that decide the result.

use num_traits::FloatConst;
use xprec::Df64;

/// 2/π as a binary fraction, in words of 64 bits, the first ones first.
const TWO_OVER_PI: [u64; 24] = [
    0xa2f9836e4e441529,
    0xfc2757d1f534ddc0,
    0xdb6295993c439041,
    0xfe5163abdebbc561,
    0xb7246e3a424dd2e0,
    0x06492eea09d1921c,
    0xfe1deb1cb129a73e,
    0xe88235f52ebb4484,
    0xe99c7026b45f7e41,
    0x3991d639835339f4,
    0x9c845f8bbdf9283b,
    0x1ff897ffde05980f,
    0xef2f118b5a0a6d1f,
    0x6d367ecf27cb09b7,
    0x4f463f669e5fea2d,
    0x7527bac7ebe5f17b,
    0x3d0739f78a5292ea,
    0x6bfb5fb11f8d5d08,
    0x56033046fc7b6bab,
    0xf0cfbc209af4361d,
    0xa9e391615ee61b08,
    0x6599855f14a06840,
    0x8dffd8804d732731,
    0x06061556ca73a8c9,
];

/// Words of a fixed-point number: the first two bits count quadrants, 382 bits are the fraction of one.
const WORDS: usize = 6;
type Quadrants = [u64; WORDS];

/// The quadrant (0 to 3) and the angle in [-π/4, π/4] that together make `x` modulo 2π, to within 2^-320. `x` is finite.
pub(super) fn quadrant(x: Df64) -> (u8, Df64) {
    let mut turns = add(quadrants(x.hi()), quadrants(x.lo()));
    turns = add(turns, [1 << 61, 0, 0, 0, 0, 0]); // half a quadrant, so that truncation rounds to the nearest
    let quadrant = (turns[0] >> 62) as u8;
    turns[0] &= (1 << 62) - 1;
    let negative = turns[0] >> 61 == 0;
    let fraction = add(turns, negated([1 << 61, 0, 0, 0, 0, 0]));
    let fraction = if negative { -value(negated(fraction)) } else { value(fraction) };
    (quadrant, fraction * Df64::FRAC_PI_2())
}

/// x·2/π modulo 4.
fn quadrants(x: f64) -> Quadrants {
    let bits = x.abs().to_bits();
    let (field, fraction) = ((bits >> 52) as i32, bits & ((1 << 52) - 1));
    let (mantissa, exponent) = if field == 0 { (fraction, -1074) } else { (fraction | 1 << 52, field - 1075) };
    // Bits of 2/π above the window only make whole turns.
    let start = exponent - 2;
    let mut product = [0; WORDS];
    let mut carry = 0;
    for (i, word) in product.iter_mut().enumerate().rev() {
        let wide = u128::from(window(start + 64 * i as i32)) * u128::from(mantissa) + carry;
        *word = wide as u64;
        carry = wide >> 64;
    }
    if x < 0.0 { negated(product) } else { product }
}

/// 64 bits of 2/π, from this bit after the point on.
fn window(start: i32) -> u64 {
    let word = |i: i32| usize::try_from(i).ok().and_then(|i| TWO_OVER_PI.get(i)).copied().unwrap_or(0);
    let (index, shift) = (start.div_euclid(64), start.rem_euclid(64));
    let low = if shift == 0 { 0 } else { word(index + 1) >> (64 - shift) };
    word(index) << shift | low
}

fn add(a: Quadrants, b: Quadrants) -> Quadrants {
    let mut sum = [0; WORDS];
    let mut carry = false;
    for i in (0..WORDS).rev() {
        let (partial, first) = a[i].overflowing_add(b[i]);
        let (total, second) = partial.overflowing_add(u64::from(carry));
        (sum[i], carry) = (total, first || second);
    }
    sum
}

fn negated(a: Quadrants) -> Quadrants {
    add(a.map(|word| !word), [0, 0, 0, 0, 0, 1])
}

/// The value in quadrants, from the least word up, so that every addition is small beside the next.
fn value(a: Quadrants) -> Df64 {
    let mut sum = Df64::from(0.0);
    for (i, word) in a.iter().enumerate().rev() {
        let scale = f64::exp2(-62.0 - 64.0 * i as f64);
        let (high, low) = ((word >> 32) as f64 * 4_294_967_296.0, (word & 0xffff_ffff) as f64);
        sum += Df64::from(low * scale);
        sum += Df64::from(high * scale);
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_angles_are_themselves() {
        for x in [0.5, -0.75, 1e-5, -1e-300, 0.0] {
            let (q, z) = quadrant(Df64::from(x));
            assert_eq!(q, 0);
            assert!((z - Df64::from(x)).hi().abs() <= 1e-30 * x.abs() + 1e-96, "{x}: {z}");
        }
    }

    #[test]
    fn quadrants_of_multiples() {
        let half_pi = Df64::FRAC_PI_2();
        for n in -9_i32..=9 {
            let x = half_pi * f64::from(n) + Df64::from(0.3);
            let (q, z) = quadrant(x);
            assert_eq!(i32::from(q), n.rem_euclid(4), "{n}");
            assert!((z - Df64::from(0.3)).hi().abs() < 1e-30, "{n}");
        }
    }

    /// sin 10^22 = -0.85220084976718880... by MPFR.
    #[test]
    fn large_angles() {
        let (q, z) = quadrant(Df64::from(1e22));
        let sine = [z.hi().sin(), z.hi().cos(), -z.hi().sin(), -z.hi().cos()][usize::from(q)];
        assert!((sine + 0.852_200_849_767_188_8).abs() < 1e-15);
    }
}
