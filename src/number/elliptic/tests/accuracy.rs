//! The promise of [`ROUNDING`], measured against MPFR on ordinary and on hard arguments.

use super::*;
use crate::number::Mpfr;
use crate::number::accuracy::Exact;
use crate::number::elliptic::ROUNDING;

/// Moduli of all kinds: ordinary, small, near one; seldom beyond one.
fn modulus<N: Exact>(random: &mut Random, f: Elliptic) -> N {
    let k = match random.below(6) {
        0 | 1 => random.within(0.0, 1.0),
        2 => random.within(-60.0, 0.0).exp2(),
        3 => 1.0 - random.within(-50.0, 0.0).exp2(),
        4 => 1.0 - 1e-12,
        _ if f.is_jacobi() && f != JacobiG && random.below(3) == 0 => random.within(1.0, 4.0),
        _ => random.within(0.9, 1.0),
    };
    let k = N::full(k, random);
    let inside = k.to_f64() < 1.0 || f.is_jacobi();
    let k = if inside { k } else { k.times(&k.like(0.5)) };
    if random.below(8) == 0 { k.negated() } else { k }
}

/// Arguments of all sizes, and those next to multiples of a quarter period.
fn angle<N: Exact>(random: &mut Random, quarter: &N) -> N {
    let near = |random: &mut Random| {
        let n = random.wide(6.0).round();
        quarter.times(&quarter.like(n))
    };
    match random.below(6) {
        0 => N::full(random.within(-2.0, 2.0), random),
        1 => N::full(random.within(-50.0, 50.0), random),
        2 => N::full(random.wide(30.0), random),
        3 => N::full(random.wide(90.0) * f64::exp2(-90.0), random),
        4 => near(random),
        _ => {
            let (near, off) = (near(random), N::full(random.wide(20.0) * f64::exp2(-20.0), random));
            near.plus(&off)
        }
    }
}

/// n below 1.
fn characteristic<N: Exact>(random: &mut Random) -> N {
    let n = match random.below(4) {
        0 => random.within(-3.0, 0.99),
        1 => -random.wide(40.0).abs(),
        2 => 1.0 - random.within(-45.0, 0.0).exp2(),
        _ => random.wide(20.0) * f64::exp2(-20.5),
    };
    let n = N::full(n, random);
    if n.to_f64() < 1.0 { n } else { n.times(&n.like(0.25)) }
}

fn positive<N: Exact>(random: &mut Random) -> N {
    let x = match random.below(4) {
        0 => random.within(0.0, 3.0),
        1 => 1.0 + random.wide(20.0) * f64::exp2(-21.5),
        2 => random.wide(60.0),
        _ => random.wide(4.0),
    };
    N::full(x.abs(), random)
}

/// Arguments at which f is defined.
fn arguments<N: Exact>(random: &mut Random, f: Elliptic) -> Vec<N> {
    if f.modulus().is_none() {
        let mut x: Vec<N> = (0..f.arity()).map(|_| positive(random)).collect();
        if f != Rc && random.below(8) == 0 {
            x[0] = x[0].like(0.0);
        }
        if f == Rc && random.below(4) == 0 {
            x[1] = x[1].negated();
        }
        return x;
    }
    let k: N = modulus(random, f);
    let inner = if k.to_f64().abs() > 1.0 { k.like(1.0).over(&k) } else { k };
    let quarter = call(CompleteK, &[inner]);
    let half_pi = N::pi(&k.context()).times(&k.like(0.5));
    match f {
        CompleteK | CompleteE | CompleteD | CompleteG => vec![k],
        CompletePi => vec![characteristic(random), k],
        IncompletePi => vec![angle(random, &half_pi), characteristic(random), k],
        _ if f.is_jacobi() => vec![angle(random, &quarter), k],
        _ => vec![angle(random, &half_pi), k],
    }
}

/// The worst error of f in units of the roundoff, over the arguments where it is finite, and how many are not.
fn worst<N: Exact>(f: Elliptic, count: usize, seed: u8) -> (f64, String, usize) {
    let mut random = Random::new(seed);
    let (mut worst, mut at, mut undefined) = (0.0, String::new(), 0);
    for _ in 0..count {
        let x: Vec<N> = arguments(&mut random, f);
        let exact: Vec<Mpfr> = x.iter().map(|x| x.exact()).collect();
        let (got, expect) = (call(f, &x), call(f, &exact));
        if expect.log2_abs() < -900.0 {
            assert!(got.log2_abs() < -890.0, "{f:?} {x:?} is {got:?}");
            continue;
        }
        if !got.is_finite() || !expect.is_finite() || expect.log2_abs() > 900.0 {
            undefined += 1;
            continue;
        }
        let error = got.exact().minus(&expect).log2_abs() - expect.log2_abs();
        let units = (error + f64::from(N::precision_bits(&got.context()))).exp2();
        if units > worst {
            (worst, at) = (units, format!("{x:?}"));
        }
    }
    (worst, at, undefined)
}

fn rounds_as_promised<N: Exact>(name: &str, count: usize) {
    let mut failures = Vec::new();
    for f in Elliptic::ALL {
        let (units, at, undefined) = worst::<N>(f, count, 5);
        println!("{name:5} {:6} {f:?}: worst {units:6.3} units of {count}, {undefined} not finite, at {at}", f.name());
        if units > ROUNDING || undefined * 50 > count {
            failures.push(f);
        }
    }
    assert!(failures.is_empty(), "{failures:?}");
}

#[test]
fn machine_numbers() {
    rounds_as_promised::<f64>("f64", 1000);
}

#[test]
fn double_doubles() {
    rounds_as_promised::<Df64>("Df64", 300);
}

/// 10^5 arguments in all for each number: some minutes.
#[test]
#[ignore = "takes minutes"]
fn many_arguments() {
    rounds_as_promised::<f64>("f64", 8000);
    rounds_as_promised::<Df64>("Df64", 8000);
}

/// A number of 200 bits against one of 500, at the same arguments.
#[test]
fn any_precision() {
    for f in Elliptic::ALL {
        let mut random = Random::new(6);
        let mut worst = 0.0_f64;
        for _ in 0..200 {
            let x: Vec<Df64> = arguments(&mut random, f);
            let at = |bits: u32| {
                let x: Vec<Mpfr> = x.iter().map(|x| Mpfr(rug::Float::with_val(bits, x.exact().0))).collect();
                call(f, &x)
            };
            let (got, expect) = (at(220), at(500));
            assert!(got.is_finite() && expect.is_finite(), "{f:?} {x:?}");
            if expect.log2_abs() > f64::NEG_INFINITY {
                worst = worst.max((got.minus(&expect).log2_abs() - expect.log2_abs() + 220.0).exp2());
            }
        }
        println!("Mpfr  {f:?}: worst {worst:.3} units of 200");
        assert!(worst <= ROUNDING, "{f:?}: {worst}");
    }
}

/// The bound of an error holds when the arguments move within theirs, and is not much too wide.
#[test]
fn errors_of_arguments_are_bounded() {
    use crate::number::Tracked;
    for f in Elliptic::ALL {
        let mut random = Random::new(7);
        let (mut bounded, mut wide) = (0, Vec::new());
        for _ in 0..300 {
            let x: Vec<f64> = arguments(&mut random, f);
            let sizes: Vec<f64> = x.iter().map(|x| x.abs() * random.within(-50.0, -20.0).exp2()).collect();
            let tracked: Vec<_> = x.iter().zip(&sizes).map(|(x, e)| Tracked::with_error(*x, e.log2())).collect();
            let value = call(f, &tracked);
            if value.error_log2() == f64::INFINITY {
                continue;
            }
            bounded += 1;
            let mut most = f64::NEG_INFINITY;
            for _ in 0..4 {
                let sign = |random: &mut Random| if random.below(2) == 0 { -0.999 } else { 0.999 };
                let moved: Vec<Mpfr> =
                    x.iter().zip(&sizes).map(|(x, e)| x.exact().plus(&(e * sign(&mut random)).exact())).collect();
                let exact = call(f, &moved);
                if exact.is_finite() {
                    let off = value.value().exact().minus(&exact).log2_abs();
                    assert!(
                        off <= value.error_log2(),
                        "{f:?} {x:?} ± {sizes:?}: 2^{off} beyond 2^{}",
                        value.error_log2()
                    );
                    most = most.max(off);
                }
            }
            wide.push(value.error_log2() - most);
        }
        wide.sort_by(f64::total_cmp);
        println!(
            "{f:?}: {bounded} of 300 bounded, too wide by {:.1} bits (half), {:.1} (95 %)",
            wide[wide.len() / 2],
            wide[wide.len() * 95 / 100]
        );
        assert!(bounded > 150, "{f:?}: {bounded}");
    }
}
