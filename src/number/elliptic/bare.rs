//! Integrals in a number's own precision, without guard digits: for what is computed in a wider type than its result.
//!
//! Arguments that must not be rounded to a modulus are taken as they are: the complementary modulus k' itself, and
//! 1 - n for Π. What the roundings of some ten operations allow is kept.

use super::super::Number;
use super::{carlson, complete};

/// K by the complementary modulus k' ≥ 0: infinite at k' = 0.
pub fn quarter_period<N: Number>(k1: &N) -> N {
    complete::quarter_period(k1)
}

/// Π(n, k) by k' > 0 and 1 - n > 0.
pub fn complete_third<N: Number>(k1: &N, p: &N) -> N {
    let one = k1.like(1.0);
    complete::complete(k1, p, &one, &one)
}

/// Carlson's R_F(x, y, z) (DLMF 19.16.1).
pub fn rf<N: Number>(x: &N, y: &N, z: &N) -> N {
    carlson::rf(x, y, z)
}
