//! The promise of `Tracked`: its bound is one. Random operations, one upon the other, beside the same in a reference of
//! much higher precision.

use super::conformance::Random;
use super::*;

/// A reference number, and how a value goes over into it exactly.
trait Reference<N: Real>: Number {
    fn of(x: &N) -> Self;
}

impl Reference<f64> for Df64 {
    fn of(x: &f64) -> Self {
        Df64::from(*x)
    }
}

#[cfg(feature = "rug")]
mod by_mpfr {
    use super::*;
    use rug::Float;

    impl Reference<f64> for Mpfr {
        fn of(x: &f64) -> Self {
            Mpfr(Float::with_val(400, *x))
        }
    }

    impl Reference<Df64> for Mpfr {
        fn of(x: &Df64) -> Self {
            Mpfr(Float::with_val(400, x.hi()) + Float::with_val(400, x.lo()))
        }
    }

    impl Reference<Mpfr> for Mpfr {
        fn of(x: &Mpfr) -> Self {
            Mpfr(Float::with_val(400, &x.0))
        }
    }
}

/// Applies the operation of this index to the operands, in any number type: every one that there is.
fn operate<N: Number>(operation: usize, n: i32, a: &N, b: &N) -> N {
    let mut x = a.clone();
    match operation {
        0..=2 => x.set_add(a, b),
        3..=5 => x.set_sub(a, b),
        6..=9 => x.set_mul(a, b),
        10..=12 => x.set_div(a, b),
        13 => x.set_powi(a, n),
        14 => x.set_pow(&a.apply(Func::Abs), b),
        15 => x.set_sqrt(&a.apply(Func::Abs)),
        16 => x.set_atan2(a, b),
        17 => x.set_neg(a),
        18 => N::set_sin_cos(&mut x, &mut b.clone(), a),
        _ => x.set_call(Func::ALL[(operation - 19) % Func::ALL.len()], a),
    }
    x
}

/// How the bounds fared.
#[derive(Default)]
struct Tally {
    bounded: u64,
    unbounded: u64,
    /// Bits by which each bound exceeds the error, where there is an error.
    excess: Vec<f64>,
}

impl Tally {
    fn see<N: Real, R: Reference<N>>(&mut self, got: &Tracked<N>, exact: &R, own: f64, what: impl Fn() -> String) {
        let bound = got.error_log2();
        if bound == f64::INFINITY || !exact.is_finite() {
            self.unbounded += 1;
            return;
        }
        let error = R::of(got.value()).minus(exact).log2_abs();
        // The reference's own errors, relative to its value.
        let reference = exact.log2_abs() - own;
        assert!(error <= bound || error <= reference, "error 2^{error} beyond the bound 2^{bound}: {}", what());
        self.bounded += 1;
        if error > f64::NEG_INFINITY && error > reference {
            self.excess.push(bound - error);
        }
    }
}

/// Operands of all kinds: ordinary, wide, nearly equal to others, near the ends of domains, small integers.
fn operand<N: Number>(random: &mut Random, cx: &N::Context) -> N {
    let third = N::from_ratio(1, 3, cx);
    let x = match random.below(8) {
        0 => random.wide(40.0),
        1 => random.within(-3.0, 3.0).round(),
        2 => 1.0 - random.wide(20.0) * f64::exp2(-40.0),
        3 => return N::pi(cx).times(&N::from_f64(random.within(-5.0, 5.0).round() / 2.0, cx)),
        _ => random.within(-3.0, 3.0),
    };
    let x = N::from_f64(x, cx);
    if random.below(2) == 0 { x } else { x.times(&third) }
}

/// Random straight-line programs of some operations each.
fn bounds_hold<N: Real, R: Reference<N>>(seed: u8, programs: usize, own: f64, cx: &N::Context) {
    let mut random = Random::new(seed);
    let mut tally = Tally::default();
    for _ in 0..programs {
        // Leaves are exact, or have an error that the reference makes up.
        let mut pool: Vec<(Tracked<N>, R)> = Vec::new();
        for _ in 0..4 {
            let x: N = operand(&mut random, cx);
            let exact = R::of(&x);
            pool.push(match random.below(3) {
                0 => {
                    let log2 = exact.log2_abs().max(-60.0) - random.within(5.0, 60.0);
                    let off = exact.like(log2.exp2() * random.within(-1.0, 1.0));
                    (Tracked::with_error(x, log2), exact.plus(&off))
                }
                _ => (Tracked::exact(x), exact),
            });
        }
        for _ in 0..10 {
            let (i, j) = (random.below(pool.len()), random.below(pool.len()));
            let (operation, n) = (random.below(19 + 2 * Func::ALL.len()), random.below(13) as i32 - 6);
            let (a, b) = (&pool[i], &pool[j]);
            let got = operate(operation, n, &a.0, &b.0);
            let exact = operate(operation, n, &a.1, &b.1);
            tally.see(&got, &exact, own, || {
                format!("operation {operation} ^{n} on {a:?} and {b:?} gave {got:?} for {exact:?}")
            });
            // Only what is bounded, and of ordinary size, goes on: the reference has its own limits.
            if got.error_log2() < 20.0 && exact.is_finite() && exact.log2_abs() < 60.0 {
                pool.push((got, exact));
            }
        }
    }
    let Tally { bounded, unbounded, mut excess } = tally;
    excess.sort_by(f64::total_cmp);
    let at = |share: f64| excess[((excess.len() - 1) as f64 * share) as usize];
    let (least, median, most) = (at(0.0), at(0.5), at(0.95));
    println!(
        "{bounded} bounded, {unbounded} not; too wide by {least:.2e} to {median:.2} (half), {most:.2} bits (95 %)"
    );
    assert!(bounded > 4 * unbounded, "too few results have a bound");
    assert!(median < 6.0 && most < 12.0, "the bounds are too wide to be of use");
    assert!(least < 0.01, "a bound this much too wide everywhere would hide its faults");
}

#[cfg(not(feature = "rug"))]
#[test]
fn machine_numbers_against_double_doubles() {
    bounds_hold::<f64, Df64>(10, 20_000, 85.0, &());
}

#[cfg(feature = "rug")]
#[test]
fn machine_numbers_against_mpfr() {
    bounds_hold::<f64, Mpfr>(11, 40_000, 350.0, &());
}

#[cfg(feature = "rug")]
#[test]
fn double_doubles_against_mpfr() {
    bounds_hold::<Df64, Mpfr>(12, 40_000, 350.0, &());
}

#[cfg(feature = "rug")]
#[test]
fn mpfr_against_itself() {
    for (seed, bits) in [(13, 24), (14, 64), (15, 200)] {
        bounds_hold::<Mpfr, Mpfr>(seed, 10_000, 350.0, &bits);
    }
}

#[test]
fn a_true_zero_is_within_and_a_false_one_is_not() {
    let third = Tracked::<Df64>::from_ratio(1, 3, &());
    let (one, three) = (third.like(1.0), third.like(3.0));
    let residual = third.times(&three).minus(&one);
    assert!(residual.is_zero_within());
    let off = residual.plus(&third.like(1e-28));
    assert!(!off.is_zero_within());
    assert!(third.like(0.0).is_zero_within());
    assert!(!third.like(1e-300).is_zero_within());
    let undefined = one.over(&third.like(0.0));
    assert_eq!(undefined.error_log2(), f64::INFINITY);
    assert!(undefined.is_zero_within());
}

#[test]
fn what_is_exactly_zero_stays_so() {
    let zero = Tracked::<Df64>::from_ratio(0, 7, &());
    let third = Tracked::<Df64>::from_ratio(1, 3, &());
    let (mut sin, mut cos) = (zero.clone(), zero.clone());
    Number::set_sin_cos(&mut sin, &mut cos, &zero);
    let tan = zero.apply(Func::Tan);
    let quotient = zero.over(&third);
    for x in [&sin, &tan, &quotient] {
        assert!(x.error_log2() == f64::NEG_INFINITY && x.to_f64() == 0.0, "{x:?}");
    }
    assert!(cos.error_log2() > f64::NEG_INFINITY);
    assert!(zero.over(&Tracked::with_error(Df64::zero(&()), -40.0)).error_log2() == f64::INFINITY);
}

#[test]
fn a_root_of_what_may_be_zero_moves_by_the_root_of_the_bound() {
    for value in [0.0, 1e-13, -1e-13] {
        let x = Tracked::with_error(Df64::from(value), -40.0).root();
        // The exact operand is at most 2^-40 away.
        for exact in [value, value + 0.9 * f64::exp2(-40.0)] {
            let miss = (x.to_f64() - exact.max(0.0).sqrt()).abs();
            assert!(miss.log2() <= x.error_log2(), "{value}: {miss} {x:?}");
        }
        assert!(x.error_log2() < -19.0);
    }
    assert!(Tracked::with_error(Df64::from(-1.0), -40.0).root().error_log2() == f64::INFINITY);
}

#[test]
fn what_may_be_singular_has_no_bound() {
    let near_zero = Tracked::with_error(1e-20_f64, 1e-10_f64.log2());
    let one = near_zero.like(1.0);
    let mut angle = one.clone();
    angle.set_atan2(&near_zero, &near_zero);
    let beyond = one.plus(&near_zero);
    let results = [
        one.over(&near_zero),
        near_zero.apply(Func::Ln),
        near_zero.apply(Func::Sign),
        near_zero.to_the(-2),
        beyond.apply(Func::Asin),
        beyond.apply(Func::Acosh),
        angle,
    ];
    for (i, x) in results.iter().enumerate() {
        assert_eq!(x.error_log2(), f64::INFINITY, "{i}: {x:?}");
    }
}
