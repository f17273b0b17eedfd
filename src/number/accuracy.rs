//! The documented roundings of every function, measured against MPFR at 400 bits on ordinary and on hard arguments.

use super::conformance::Random;
use super::*;
use rug::Float;

const BITS: u32 = 400;

/// A number whose value MPFR can take over exactly.
pub(super) trait Exact: Real + Copy {
    fn exact(&self) -> Mpfr;
    /// A number near `x` that uses all its bits.
    fn full(x: f64, random: &mut Random) -> Self;
}

impl Exact for f64 {
    fn exact(&self) -> Mpfr {
        Mpfr(Float::with_val(BITS, *self))
    }
    fn full(x: f64, _: &mut Random) -> Self {
        x
    }
}

impl Exact for Df64 {
    fn exact(&self) -> Mpfr {
        Mpfr(Float::with_val(BITS, self.hi()) + Float::with_val(BITS, self.lo()))
    }
    fn full(x: f64, random: &mut Random) -> Self {
        let low = x * f64::EPSILON * 0.49 * random.within(-1.0, 1.0);
        // Some low parts are far below, or none.
        let low = match random.below(8) {
            0 => 0.0,
            1 => low * random.within(-60.0, 0.0).exp2(),
            _ => low,
        };
        Df64::from(x) + Df64::from(low)
    }
}

/// Arguments of all sizes, and those at which functions are hard: multiples of π/2, ±1, what is near them.
fn arguments<N: Exact>(random: &mut Random) -> Vec<N> {
    let mut xs = Vec::new();
    for _ in 0..4000 {
        for x in [random.within(-2.0, 2.0), random.within(-50.0, 50.0), random.wide(60.0), random.wide(700.0)] {
            xs.push(N::full(x, random));
        }
        let near_one = 1.0 + random.wide(30.0) * f64::exp2(-32.0);
        xs.extend([N::full(near_one, random), N::full(-near_one, random)]);
        let tiny = N::full(random.wide(20.0) * f64::exp2(-70.0), random);
        xs.extend([N::from_f64(1.0, &tiny.context()).plus(&tiny), N::from_f64(-1.0, &tiny.context()).plus(&tiny)]);
        let half_pi = N::pi(&tiny.context()).over(&tiny.like(2.0));
        let multiple = random.wide(14.0).round() * if random.below(4) == 0 { 1e6 } else { 1.0 };
        let near = half_pi.times(&tiny.like(multiple));
        xs.extend([near, near.plus(&tiny)]);
    }
    xs
}

/// The error of a result in units of its roundoff, relative to the exact one.
fn units<N: Exact>(got: &N, exact: &Mpfr) -> f64 {
    let error = got.exact().minus(exact).log2_abs() - exact.log2_abs();
    if error == f64::NEG_INFINITY { 0.0 } else { (error + f64::from(N::precision_bits(&got.context()))).exp2() }
}

/// The worst of `f` over the arguments where both results are finite and of ordinary size.
#[derive(Default)]
struct Worst {
    units: f64,
    at: String,
}

impl Worst {
    fn see<N: Exact>(&mut self, got: &N, exact: &Mpfr, at: impl Fn() -> String) {
        let tame = exact.is_finite() && (exact.log2_abs().abs() < N::reach());
        if !tame {
            return;
        }
        let units = if got.is_finite() { units(got, exact) } else { f64::INFINITY };
        if units > self.units || units.is_nan() {
            *self = Worst { units, at: at() };
        }
    }
}

fn roundings<N: Exact>(name: &str, seed: u8) {
    let mut random = Random::new(seed);
    let xs = arguments::<N>(&mut random);
    let mut failures = Vec::new();
    let mut report = |what: String, worst: Worst, bound: f64| {
        println!("{name:5} {what:8} worst {:8.3} of {bound:6.2} units at {}", worst.units, worst.at);
        if worst.units > bound || worst.units.is_nan() {
            failures.push(what);
        }
    };
    for f in Func::ALL {
        let mut worst = Worst::default();
        for x in &xs {
            if f == Func::Ln && x.log2_abs().abs() > N::reach() {
                continue;
            }
            worst.see(&x.apply(f), &x.exact().apply(f), || format!("{x:?}"));
        }
        report(f.name().to_owned(), worst, N::rounding(Operation::Call(f)));
    }
    type Binary<T> = fn(&mut T, &T, &T);
    let binary: [(&str, Binary<N>, Binary<Mpfr>, Operation); 5] = [
        ("+", N::set_add, Mpfr::set_add, Operation::Add),
        ("-", N::set_sub, Mpfr::set_sub, Operation::Add),
        ("*", N::set_mul, Mpfr::set_mul, Operation::Mul),
        ("/", N::set_div, Mpfr::set_div, Operation::Div),
        ("atan2", N::set_atan2, Mpfr::set_atan2, Operation::Atan2),
    ];
    for (what, f, reference, operation) in binary {
        let mut worst = Worst::default();
        for _ in 0..60_000 {
            let (a, mut b) = (xs[random.below(xs.len())], xs[random.below(xs.len())]);
            if random.below(3) == 0 {
                b = a.times(&N::full(1.0, &mut random)); // nearly equal: cancellation
            }
            let (mut got, mut exact) = (a, a.exact());
            f(&mut got, &a, &b);
            reference(&mut exact, &a.exact(), &b.exact());
            worst.see(&got, &exact, || format!("{a:?}, {b:?}"));
        }
        report(what.to_owned(), worst, N::rounding(operation));
    }
    let mut worst = Worst::default();
    for a in &xs {
        worst.see(&a.root(), &a.exact().root(), || format!("{a:?}"));
    }
    report("sqrt".to_owned(), worst, N::rounding(Operation::Sqrt));
    for n in [-40, -7, -2, -1, 1, 2, 3, 5, 17, 100] {
        let mut worst = Worst::default();
        for a in xs.iter().filter(|a| f64::from(n).abs() * a.log2_abs().abs() < N::reach()) {
            worst.see(&a.to_the(n), &a.exact().to_the(n), || format!("{a:?}"));
        }
        report(format!("^{n}"), worst, N::rounding(Operation::PowI(n)));
    }
    for most in [1.0, 10.0, 100.0, 500.0] {
        let mut worst = Worst::default();
        for _ in 0..20_000 {
            let a = xs[random.below(xs.len())].apply(Func::Abs);
            let b = N::full(random.within(-1.0, 1.0) * most / a.to_f64().ln().abs(), &mut random);
            let (mut got, mut exact) = (a, a.exact());
            got.set_pow(&a, &b);
            exact.set_pow(&a.exact(), &b.exact());
            worst.see(&got, &exact, || format!("{a:?}, {b:?}"));
        }
        report(format!("pow {most}"), worst, N::pow_rounding(most));
    }
    assert!(failures.is_empty(), "beyond the documented rounding: {failures:?}");
}

#[test]
fn machine_numbers_round_as_documented() {
    roundings::<f64>("f64", 3);
}

#[test]
fn double_doubles_round_as_documented() {
    roundings::<Df64>("Df64", 4);
}
