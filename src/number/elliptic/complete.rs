//! The complete integrals by the arithmetic-geometric mean: R. Bulirsch, "Numerical calculation of elliptic integrals
//! and elliptic functions III", Numer. Math. 13 (1969) 305-315; DLMF 19.8(i). No step subtracts, and each doubles the
//! digits.

use super::arithmetic::Arithmetic;

/// Steps that no arguments of a practical size need.
const MOST_STEPS: u32 = 200;

/// Whether the next step of the mean makes them equal in all bits.
fn is_near<W: Arithmetic>(a: &W, b: &W) -> bool {
    a.difference(b).log2_size() <= a.log2_size() - f64::from(a.bits()) / 2.0 - 2.0
}

/// The arithmetic-geometric mean of positive numbers.
pub(super) fn agm<W: Arithmetic>(a: &W, b: &W) -> W {
    let (mut a, mut b) = (a.clone(), b.clone());
    for _ in 0..MOST_STEPS {
        let near = is_near(&a, &b);
        (a, b) = (a.sum(&b).by(0.5), a.product(&b).square_root());
        if near {
            return a;
        }
    }
    a.undefined()
}

/// K from the complementary modulus k', which is not negative: infinite at k' = 0.
pub(super) fn quarter_period<W: Arithmetic>(k1: &W) -> W {
    if k1.log2_size() == f64::NEG_INFINITY {
        return k1.infinite();
    }
    k1.half_turn().quotient(&agm(&k1.constant(1.0), k1).by(2.0))
}

/// Bulirsch's complete integral: ∫ (α cos² + β sin²) / (cos² + p sin²) dθ/√(cos² + k'² sin²) from 0 to π/2, for
/// positive p and k', and α and β that are not negative.
///
/// K is (p, α, β) = (1, 1, 1), E is (1, 1, k'²), D is (1, 0, 1), Π(n) is (1 - n, 1, 1).
pub(super) fn complete<W: Arithmetic>(k1: &W, p: &W, alpha: &W, beta: &W) -> W {
    if !(k1.log2_size() > f64::NEG_INFINITY && p.approx() > 0.0 && k1.approx() >= 0.0) {
        return k1.undefined();
    }
    // Twice the two means at every step: that saves the halving.
    let (mut arithmetic, mut geometric) = (k1.constant(1.0), k1.clone());
    let mut p = p.square_root();
    let (mut a, mut b) = (alpha.clone(), beta.quotient(&p));
    for _ in 0..MOST_STEPS {
        let product = arithmetic.product(&geometric);
        let over_p = product.quotient(&p);
        (a, b) = (a.sum(&b.quotient(&p)), b.sum(&a.product(&over_p)).by(2.0));
        p = p.sum(&over_p);
        let near = is_near(&arithmetic, &geometric);
        arithmetic = arithmetic.sum(&geometric);
        if near {
            let numerator = b.sum(&a.product(&arithmetic));
            let denominator = arithmetic.product(&arithmetic.sum(&p));
            return k1.half_turn().by(0.5).product(&numerator).quotient(&denominator);
        }
        geometric = product.square_root().by(2.0);
    }
    k1.undefined()
}
