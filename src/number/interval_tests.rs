//! Intervals against MPFR at four times the precision, at ordinary and at hard arguments.

use super::conformance::Random;
use super::{Func, Interval, Mpfr, Number};
use rug::float::{Constant, Round};
use rug::{Assign, Float};

/// The largest number that is no more than `x` in a lower precision, and the smallest that is no less.
fn around(x: &Float, bits: u32) -> (Float, Float) {
    (Float::with_val_round(bits, x, Round::Down).0, Float::with_val_round(bits, x, Round::Up).0)
}

/// A number: ordinary, tiny, huge, near a multiple of π/2, near the edge of a domain.
fn number(random: &mut Random, bits: u32) -> Float {
    let x = match random.below(10) {
        0 => return Float::new(bits),
        1 => Float::with_val(bits, random.wide(1000.0)),
        2 | 3 => {
            // A multiple of π/2, rounded: sines and cosines near 0 and 1.
            let binades = [6.0, 6.0, 80.0][random.below(3)];
            let k = random.wide(binades).round();
            Float::with_val(bits, Float::with_val(bits + 200, Constant::Pi) * k / 2)
        }
        4 => {
            let edge = [-1.0, 0.0, 1.0][random.below(3)];
            Float::with_val(bits, edge + random.wide(1.0) * (-random.within(1.0, 100.0)).exp2())
        }
        5 => Float::with_val(bits, random.within(-20.0, 20.0).round() / 2.0),
        _ => Float::with_val(bits, random.wide(5.0)),
    };
    x * Float::with_val(bits, 1.0 + (random.below(3) as f64) * 2_f64.powi(1 - bits.min(1000) as i32))
}

/// An interval: a point, some units wide, of ordinary width, wide.
fn interval(random: &mut Random, bits: u32) -> Interval {
    let x = number(random, bits);
    let mut y = x.clone();
    match random.below(5) {
        0 => {}
        1 => (0..=random.below(3)).for_each(|_| y.next_up()),
        2 => y += random.wide(4.0),
        3 => y = number(random, bits),
        _ => y += Float::with_val(bits, &x * (random.wide(20.0).abs().min(1.0) * 1e-3)),
    }
    if x <= y { Interval::new(&x, &y) } else { Interval::new(&y, &x) }
}

/// A number of the interval, an endpoint as often as not.
fn member(random: &mut Random, a: &Interval, bits: u32) -> Float {
    let mut x = Float::new(bits);
    match random.below(4) {
        0 => x.assign(a.lo()),
        1 => x.assign(a.hi()),
        2 => x.assign(a.midpoint()),
        _ => {
            let share = random.within(0.0, 1.0);
            x.assign(a.lo() + Float::with_val(bits, a.hi() - a.lo()) * share);
            x.clamp_mut(a.lo(), a.hi());
        }
    }
    x
}

const POWERS: [i32; 10] = [-7, -2, -1, 0, 1, 2, 3, 4, 5, 10];

/// One of the operations, the same in any number type.
#[derive(Clone, Copy, Debug)]
enum Step {
    Add,
    Sub,
    Mul,
    Div,
    PowI(i32),
    Pow,
    Sqrt,
    Call(Func),
    Atan2,
    Neg,
}

impl Step {
    fn random(random: &mut Random) -> Self {
        match random.below(28) {
            0 => Step::Add,
            1 => Step::Sub,
            2 | 3 => Step::Mul,
            4 | 5 => Step::Div,
            6 => Step::PowI(POWERS[random.below(POWERS.len())]),
            7 => Step::Pow,
            8 => Step::Sqrt,
            9 | 10 => Step::Atan2,
            11 => Step::Neg,
            k => Step::Call(Func::ALL[k - 12]),
        }
    }

    fn apply<N: Number>(self, a: &N, b: &N) -> N {
        let mut x = a.clone();
        match self {
            Step::Add => x.set_add(a, b),
            Step::Sub => x.set_sub(a, b),
            Step::Mul => x.set_mul(a, b),
            Step::Div => x.set_div(a, b),
            Step::PowI(n) => x.set_powi(a, n),
            Step::Pow => x.set_pow(a, b),
            Step::Sqrt => x.set_sqrt(a),
            Step::Call(f) => x.set_call(f, a),
            Step::Atan2 => x.set_atan2(a, b),
            Step::Neg => x.set_neg(a),
        }
        x
    }
}

/// Single operations: the enclosure contains the value at four times the precision. How many enclosures were bounded.
fn single_operations(count: usize, seed: u8) -> usize {
    let mut random = Random::new(seed);
    let mut bounded = 0;
    for _ in 0..count {
        let bits = [24, 53, 64, 100][random.below(4)];
        let step = Step::random(&mut random);
        let (a, b) = (interval(&mut random, bits), interval(&mut random, bits));
        let enclosure = step.apply(&a, &b);
        if !enclosure.is_bounded() {
            continue;
        }
        bounded += 1;
        let (x, y) = (member(&mut random, &a, 4 * bits), member(&mut random, &b, 4 * bits));
        let value = step.apply(&Mpfr(x.clone()), &Mpfr(y.clone())).0;
        let inside = value.is_finite() && enclosure.contains(&value);
        assert!(inside, "{step:?} of {x} in {a:?} and {y} in {b:?} is {value}, not in {enclosure:?}");
    }
    bounded
}

/// Chains of operations on a handful of values: the same, and a higher precision never loosens. How many operations were
/// bounded.
fn expressions(count: usize, seed: u8) -> usize {
    let mut random = Random::new(seed);
    let mut bounded = 0;
    let mut done = 0;
    while done < count {
        let bits = [24, 53, 80][random.below(3)];
        let mut coarse: Vec<Interval> = (0..4).map(|_| interval(&mut random, bits)).collect();
        let wide = |x: &Float| Float::with_val(2 * bits, x);
        let mut fine: Vec<Interval> = coarse.iter().map(|a| Interval::new(&wide(a.lo()), &wide(a.hi()))).collect();
        let mut values: Vec<Mpfr> = coarse.iter().map(|a| Mpfr(member(&mut random, a, 4 * bits))).collect();
        for _ in 0..12 {
            let step = Step::random(&mut random);
            let (i, j, to) = (random.below(4), random.below(4), random.below(4));
            let (low, high) = (step.apply(&coarse[i], &coarse[j]), step.apply(&fine[i], &fine[j]));
            done += 1;
            assert!(high.is_within(&low), "{step:?}: {high:?} is looser than {low:?}");
            if !low.is_bounded() {
                continue;
            }
            bounded += 1;
            let value = step.apply(&values[i], &values[j]);
            // The reference is itself rounded at each step, some 2^-(4 bits).
            let contained = value.0.is_finite() && low.contains(&value.0) && high.contains(&value.0);
            assert!(contained, "{step:?}: {value:?} is not in {low:?}, of {:?} and {:?}", coarse[i], coarse[j]);
            // Sines of numbers of millions of digits are nobody's business.
            if low.log2_abs() < 2000.0 {
                (coarse[to], fine[to], values[to]) = (low, high, value);
            }
        }
    }
    bounded
}

/// A million operations.
#[test]
fn sound() {
    let (single, chained) = (single_operations(700_000, 21), expressions(300_000, 22));
    // Of what is invalid nothing is tested: most must not be.
    assert!(single > 500_000 && chained > 200_000, "{single} and {chained} bounded");
}

/// What is not defined or not continuous at some point of an operand is not bounded.
#[test]
fn invalid() {
    let at = |lo: f64, hi: f64| Interval::new(&Float::with_val(60, lo), &Float::with_val(60, hi));
    let none = Interval::invalid(60);
    assert!(!at(2.0, 1.0).is_bounded() && !at(f64::NAN, 1.0).is_bounded() && !at(0.0, f64::INFINITY).is_bounded());
    for (f, lo, hi) in [
        (Func::Tan, 1.5, 1.6),
        (Func::Tan, -2.0, 100.0),
        (Func::Asin, 0.5, 1.5),
        (Func::Acos, -1.1, 0.0),
        (Func::Acosh, 0.9, 2.0),
        (Func::Atanh, 0.5, 1.0),
        (Func::Ln, 0.0, 1.0),
        (Func::Ln, -1.0, 1.0),
        (Func::Sign, -1.0, 1.0),
        (Func::Sign, 0.0, 1.0),
        (Func::Exp, 1.0, 1e300),
    ] {
        assert!(!at(lo, hi).apply(f).is_bounded(), "{} of [{lo}, {hi}]", f.name());
    }
    assert!(!at(1.0, 1.0).over(&at(-1.0, 1.0)).is_bounded() && !at(1.0, 2.0).over(&at(0.0, 1.0)).is_bounded());
    assert!(!at(-1e-9, 4.0).root().is_bounded() && !at(-1.0, 2.0).to_the(-2).is_bounded());
    let angle = |y, x| Step::Atan2.apply(&y, &x);
    assert!(!angle(at(-1.0, 0.0), at(-2.0, -1.0)).is_bounded() && !angle(at(-1.0, 1.0), at(-1.0, 1.0)).is_bounded());
    assert!(angle(at(0.0, 1.0), at(-2.0, -1.0)).is_bounded() && angle(at(-1.0, 1.0), at(1.0, 2.0)).is_bounded());
    assert!(!Step::Pow.apply(&at(-1.0, 2.0), &at(0.5, 1.0)).is_bounded());
    assert!(!Step::Pow.apply(&at(0.0, 2.0), &at(0.0, 1.0)).is_bounded());
    assert!(Step::Pow.apply(&at(0.0, 2.0), &at(0.5, 1.0)).is_bounded());
    for f in Func::ALL {
        assert!(!none.apply(f).is_bounded());
    }
    for step in [Step::Add, Step::Sub, Step::Mul, Step::Div, Step::Pow, Step::Atan2, Step::PowI(0), Step::PowI(3)] {
        assert!(!step.apply(&none, &at(1.0, 2.0)).is_bounded());
    }
    assert!(!none.excludes_zero() && none.sign().is_none() && !none.is_inside(&at(0.0, 1.0)));
    assert!(none.contains(&Float::with_val(9, 7)) && none.bracket(3).is_none());
}

/// The image of a point under one operation is no wider than the spacing of the numbers there, and the extrema of sine and
/// cosine are taken only where they are.
#[test]
fn tight() {
    let mut random = Random::new(13);
    for _ in 0..20_000 {
        let bits = [24, 53, 100][random.below(3)];
        let (x, y) = (number(&mut random, bits), number(&mut random, bits));
        let step = Step::random(&mut random);
        let made = step.apply(&Interval::new(&x, &x), &Interval::new(&y, &y));
        if made.is_bounded() {
            let mut next = made.lo().clone();
            next.next_up();
            assert!(next >= *made.hi(), "{step:?} of {x} and {y}: {made:?}");
        }
        let value = step.apply(&Mpfr(Float::with_val(4 * bits, &x)), &Mpfr(Float::with_val(4 * bits, &y))).0;
        // A point at which an operation is defined has a bounded image, the sign at zero among them.
        let origin = matches!(step, Step::Atan2 | Step::Pow) && x.is_zero();
        let huge = origin || value.get_exp().is_some_and(|e| e > 1 << 20);
        assert!(made.is_bounded() || !value.is_finite() || huge, "{step:?} of {x} and {y} is {value}");
    }
    let at = |lo: f64, hi: f64| Interval::new(&Float::with_val(60, lo), &Float::with_val(60, hi));
    let ends = |a: Interval| (a.lo().to_f64(), a.hi().to_f64());
    assert_eq!(ends(at(1.0, 2.0).apply(Func::Sin)), (1_f64.sin(), 1.0));
    assert_eq!(ends(at(1.0, 5.0).apply(Func::Sin)), (-1.0, 1.0));
    assert_eq!(ends(at(-2.0, -1.0).apply(Func::Sin)).0, -1.0);
    assert_eq!(ends(at(0.0, 0.0).apply(Func::Cos)), (1.0, 1.0));
    assert_eq!(ends(at(-1.0, 2.0).to_the(2)), (0.0, 4.0));
    assert_eq!(ends(at(-3.0, 2.0).apply(Func::Abs)), (0.0, 3.0));
    assert_eq!(ends(at(-3.0, 2.0).times(&at(-1.0, 4.0))), (-12.0, 8.0));
    assert_eq!(ends(at(-3.0, 6.0).over(&at(-3.0, -1.5))), (-4.0, 2.0));
}

#[test]
fn brackets_round_outwards() {
    let bracket = |n, d| Interval::from_ratio(n, d, &64).bracket(4).map(|(a, b)| format!("[{a}, {b}]"));
    assert_eq!(bracket(1, 3).as_deref(), Some("[0.3333, 0.3334]"));
    assert_eq!(bracket(-2, 3).as_deref(), Some("[-0.6667, -0.6666]"));
    assert_eq!(bracket(-5, 2).as_deref(), Some("[-2.5, -2.5]"));
    assert_eq!(bracket(0, 1).as_deref(), Some("[0, 0]"));
}

/// The numbers next to π are on either side of it, at every precision.
#[test]
fn constants_contain_their_values() {
    for bits in [2, 10, 53, 200] {
        let (below, above) = around(&Float::with_val(bits + 500, Constant::Pi), bits);
        let pi = Interval::pi(&bits);
        assert!(*pi.lo() == below && *pi.hi() == above && below < above);
        assert!(pi.apply(Func::Sin).sign().is_none(), "sin π may be zero");
        assert!(Interval::e(&bits).apply(Func::Ln).contains(&Float::with_val(bits, 1)));
    }
}
