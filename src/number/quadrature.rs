//! Definite integrals by the double exponential rule (tanh-sinh): H. Takahasi and M. Mori, Publ. RIMS 9 (1974) 721-741.
//!
//! With x = tanh(π/2 sinh t) the integrand falls doubly exponentially in t, also where it is singular at an end, and
//! the trapezoidal rule in t doubles its digits with each halving of the step.
//!
//! Promise: the error of a finite result is below its estimate, for integrands that are analytic within the interval
//! (singular at its ends if need be, as long as they can be integrated), that are computed to some units of their last
//! place, and that the coarsest steps see something of: nothing that samples an integrand notices a peak between its
//! samples. The estimate is the sum of
//!
//! - the step's: the last difference between two steps, or what the differences before let expect, if that is more;
//! - the ends': what is left out beyond the last samples;
//! - the roundings'.

use super::{Func, Real};

/// Where an integrand is wanted.
#[derive(Clone, Debug)]
pub struct Sample<N> {
    /// The variable, rounded.
    pub x: N,
    /// x - a for the lower limit a, not rounded to x: for integrands that are singular at a.
    pub above: N,
    /// b - x for the upper limit b, in the same way.
    pub below: N,
}

/// An integral.
#[derive(Clone, Debug)]
pub struct Integral<N> {
    /// The value. Not finite where the integrand is not within the interval.
    pub value: N,
    /// log₂ of the estimated absolute error.
    pub error_log2: f64,
    /// How often the integrand was wanted.
    pub samples: usize,
    /// The integral of the integrand's magnitude, roughly.
    pub size: f64,
}

/// Halvings of the step that are enough for most integrands.
pub const LEVELS: u32 = 10;

/// The coarsest step is 2^-this.
const FIRST_LEVEL: u32 = 2;

/// Halvings of the step for integrals within formulas, which are taken at many states.
pub const UNIT_LEVELS: u32 = 8;

/// The bits to which an integral must be known where it has no bound of its error beside it.
const LEAST_BITS: f64 = 26.0;

/// The integral from 0 to 1 of a function of x and 1 - x; not finite where it is not known to [`LEAST_BITS`].
pub(super) fn over_unit<N: Real>(model: &N, f: &mut dyn FnMut(&N, &N) -> N) -> N {
    let got = integrate(&model.like(0.0), &model.like(1.0), UNIT_LEVELS, |s| f(&s.above, &s.below));
    if got.error_log2 <= got.size.log2() - LEAST_BITS { got.value } else { model.like(f64::NAN) }
}

/// The integral of `f` from `a` to `b`, both finite, with a step halved at most `levels` times.
pub fn integrate<N: Real>(a: &N, b: &N, levels: u32, mut f: impl FnMut(&Sample<N>) -> N) -> Integral<N> {
    integrate_within(a, b, levels, |s| (f(s), 0.0))
}

/// As [`integrate`], of a function that is known within bounds: its values with their absolute errors.
pub fn integrate_within<N: Real>(a: &N, b: &N, levels: u32, mut f: impl FnMut(&Sample<N>) -> (N, f64)) -> Integral<N> {
    let cx = a.context();
    let rule = Rule { a, b, length: b.minus(a), pi: N::pi(&cx), bits: f64::from(N::precision_bits(&cx)) };
    let mut sums = Sums { value: a.like(0.0), size: 0.0, rounding: 0.0, ends: [Side::new(), Side::new()], samples: 0 };
    let mut differences: Vec<f64> = Vec::new();
    let mut value: Option<N> = None;
    let (mut error, mut level, mut size) = (f64::INFINITY, FIRST_LEVEL, 0.0);
    while level <= levels.clamp(FIRST_LEVEL + 2, 24) {
        rule.refine(level, &mut sums, &mut f);
        let h = f64::exp2(-f64::from(level));
        let next = sums.value.times(&a.like(h));
        size = h * sums.size;
        if let Some(before) = &value {
            differences.push(next.minus(before).to_f64().abs());
            error = step_error(&differences) + h * sums.tails() + h * sums.rounding;
        }
        value = Some(next);
        if !sums.value.is_finite() || differences.len() > 2 && error <= 4.0 * h * sums.rounding {
            break;
        }
        level += 1;
    }
    let value = value.unwrap_or_else(|| a.like(f64::NAN));
    let error_log2 = if value.is_finite() && !error.is_nan() { error.log2() } else { f64::INFINITY };
    Integral { value, error_log2, samples: sums.samples, size }
}

/// What the differences between steps let expect of the error of the last one: their last, or that which goes on as the
/// two before it did, if it is more. Agreement by chance does not come twice.
fn step_error(differences: &[f64]) -> f64 {
    match *differences {
        [.., a, b, c] if a > 0.0 => c.max((b / a).min(1.0) * b),
        [.., b, c] => c.max(b),
        _ => f64::INFINITY,
    }
}

/// One end of the interval.
struct Side {
    /// Beyond this t the integrand is not finite, or was not wanted.
    last: f64,
    /// The last two terms that count, with their t, the outermost first.
    outermost: [(f64, f64); 2],
}

impl Side {
    fn new() -> Self {
        Side { last: f64::INFINITY, outermost: [(f64::NEG_INFINITY, f64::INFINITY); 2] }
    }

    fn see(&mut self, t: f64, term: f64) {
        let [first, second] = self.outermost;
        if t > first.0 {
            self.outermost = [(t, term), first];
        } else if t > second.0 {
            self.outermost[1] = (t, term);
        }
    }

    /// The sum of the terms that are left out, as a geometric series of the step between the outermost two.
    fn tail(&self) -> f64 {
        let [(_, last), (_, before)] = self.outermost;
        if last == 0.0 {
            return 0.0;
        }
        let ratio = last / before;
        if ratio < 0.9 { last / (1.0 - ratio) } else { f64::INFINITY }
    }
}

/// What has been summed up.
struct Sums<N> {
    /// Σ w f, to be multiplied by the step.
    value: N,
    /// Σ |w f|.
    size: f64,
    /// The rounding errors of the sum.
    rounding: f64,
    /// The lower and the upper end.
    ends: [Side; 2],
    samples: usize,
}

impl<N> Sums<N> {
    fn tails(&self) -> f64 {
        self.ends.iter().map(Side::tail).sum()
    }
}

struct Rule<'l, N> {
    a: &'l N,
    b: &'l N,
    length: N,
    pi: N,
    bits: f64,
}

impl<N: Real> Rule<'_, N> {
    /// Adds the samples that are new at this level.
    fn refine(&self, level: u32, sums: &mut Sums<N>, f: &mut impl FnMut(&Sample<N>) -> (N, f64)) {
        let h = f64::exp2(-f64::from(level));
        let first = level == FIRST_LEVEL;
        if first {
            self.add(0.0, 0, sums, f);
        }
        for side in 0..2 {
            let stride = if first { 1 } else { 2 };
            for i in (1_u64..).step_by(stride) {
                let t = i as f64 * h;
                if t >= sums.ends[side].last || !self.add(t, side, sums, f) {
                    break;
                }
            }
        }
    }

    /// Adds the term at ±t; whether there may be more beyond it.
    fn add(&self, t: f64, side: usize, sums: &mut Sums<N>, f: &mut impl FnMut(&Sample<N>) -> (N, f64)) -> bool {
        let one = self.a.like(1.0);
        let at = self.a.like(t);
        let exponent = self.pi.times(&at.apply(Func::Sinh));
        let depth = exponent.to_f64();
        // The distance from the end is e^-depth of the length.
        if depth > self.deepest() {
            sums.ends[side].last = sums.ends[side].last.min(t);
            return false;
        }
        let q = exponent.negated().apply(Func::Exp);
        let more = one.plus(&q);
        let (near, far) = (self.length.times(&q).over(&more), self.length.over(&more));
        let weight = near.times(&self.pi).times(&at.apply(Func::Cosh)).over(&more);
        let sample = if side == 0 {
            Sample { x: self.a.plus(&near), above: near, below: far }
        } else {
            Sample { x: self.b.minus(&near), above: far, below: near }
        };
        sums.samples += 1;
        let (value, doubt) = f(&sample);
        let known = value.is_finite() && weight.to_f64().abs() * doubt <= f64::exp2(-self.bits) * sums.size;
        if !known && depth > 0.5 * self.bits {
            // So near to the end that its distance may have been rounded to nothing, or where what is next to nothing is
            // not known: the tail's estimate knows.
            sums.ends[side].last = sums.ends[side].last.min(t);
            return false;
        }
        let term = weight.times(&value);
        let size = term.to_f64().abs();
        sums.value = sums.value.plus(&term);
        sums.size += size;
        // The term's own roundings (e^-depth loses as many units as the depth is large), and the sum's.
        sums.rounding += f64::exp2(-self.bits) * (size * (24.0 + 4.0 * depth) + 2.0 * sums.value.to_f64().abs());
        sums.rounding += weight.to_f64().abs() * doubt;
        sums.ends[side].see(t, size);
        value.is_finite()
    }

    /// e^-this of the length is near enough to an end: 2^-(4 bits), unless numbers underflow before.
    fn deepest(&self) -> f64 {
        (4.0 * self.bits).min(0.9 * N::reach()) * std::f64::consts::LN_2
    }
}

#[cfg(test)]
mod tests {
    use super::super::Df64;
    use super::*;

    /// The true error is below the estimate; log₂ of both.
    fn respected<N: Real>(name: &str, got: &Integral<N>, exact: &N) -> (f64, f64) {
        let error = got.value.minus(exact).log2_abs();
        println!("{name:24} error 2^{error:7.1}, estimated 2^{:7.1}, {} samples", got.error_log2, got.samples);
        assert!(error <= got.error_log2, "{name}: {error} above {}", got.error_log2);
        (error, got.error_log2)
    }

    /// Integrals with known values; `wanted` are the bits below 1 that the estimate must reach.
    fn known<N: Real>(cx: &N::Context, wanted: f64) {
        let n = |x: f64| N::from_f64(x, cx);
        let ratio = |p: i128, q: i128| N::from_ratio(p, q, cx);
        let (zero, one, pi) = (n(0.0), n(1.0), N::pi(cx));
        let check = |name: &str, got: Integral<N>, exact: N, wanted: f64| {
            let (_, estimate) = respected(name, &got, &exact);
            assert!(estimate < -wanted, "{name}: {estimate} of {wanted}");
        };
        let all = |f: &dyn Fn(&Sample<N>) -> N| integrate(&zero, &one, LEVELS, f);
        check("exp x", all(&|s| s.x.apply(Func::Exp)), N::e(cx).minus(&one), wanted);
        check("x^7", all(&|s| s.x.to_the(7)), ratio(1, 8), wanted);
        check("1/(1 + x²)", all(&|s| one.over(&one.plus(&s.x.to_the(2)))), pi.over(&n(4.0)), wanted);
        check("x^-1/2", all(&|s| one.over(&s.above.root())), n(2.0), wanted);
        check("(1 - x)^-1/2", all(&|s| one.over(&s.below.root())), n(2.0), wanted);
        check("ln x", all(&|s| s.above.apply(Func::Ln)), n(-1.0), wanted);
        let root = |s: &Sample<N>| one.over(&s.above.times(&s.below).root());
        check("1/√(x (1 - x))", all(&root), pi.clone(), wanted);
        let logarithm = |s: &Sample<N>| s.above.apply(Func::Ln).times(&s.below.apply(Func::Ln));
        check("ln x ln (1 - x)", all(&logarithm), n(2.0).minus(&pi.times(&pi).over(&n(6.0))), wanted);
        let wave = |s: &Sample<N>| s.x.times(&n(200.0)).apply(Func::Cos);
        check("cos 200x", all(&wave), n(200.0).apply(Func::Sin).over(&n(200.0)), wanted);
        let peak = |s: &Sample<N>| one.over(&s.x.minus(&ratio(3, 10)).to_the(2).plus(&ratio(1, 10_000)));
        let arctan = |x: N| x.apply(Func::Atan).times(&n(100.0));
        // Its width is a hundredth: more halvings are needed for more digits.
        check("a peak", all(&peak), arctan(n(70.0)).plus(&arctan(n(30.0))), 30.0);
        let finer = integrate(&zero, &one, LEVELS + 2, peak);
        check("a peak, finer", finer, arctan(n(70.0)).plus(&arctan(n(30.0))), wanted.min(100.0) - 20.0);
        // Limits in the other order, and an interval far from zero.
        let back = integrate(&n(3.0), &n(1.0), LEVELS, |s| s.x.to_the(-2));
        check("x^-2 from 3 to 1", back, ratio(-2, 3), wanted);
        let far = integrate(&n(1000.0), &n(1001.0), LEVELS, |s| s.x.to_the(-2));
        check("x^-2 far away", far, ratio(1, 1_001_000), wanted);
    }

    #[test]
    fn machine_numbers() {
        known::<f64>(&(), 40.0);
    }

    #[test]
    fn double_doubles() {
        known::<Df64>(&(), 90.0);
    }

    #[cfg(feature = "rug")]
    #[test]
    fn any_precision() {
        known::<super::super::Mpfr>(&300, 284.0);
    }

    #[test]
    fn what_is_too_hard_says_so() {
        // A strong singularity, whose tail counts; a step; a peak that is narrower than the samples; a pole.
        let one = |_: &Sample<f64>| 1.0;
        let strong = integrate(&0.0, &1.0, LEVELS, |s| s.above.powf(-0.98));
        respected("x^-0.98", &strong, &50.0);
        let step = integrate(&0.0, &1.0, LEVELS, |s| f64::from(u8::from(s.x > 0.3)));
        assert!(respected("a step", &step, &0.7).1 > -20.0);
        let narrow = integrate(&0.0, &1.0, LEVELS, |s| 1e-5 / ((s.x - 0.3).powi(2) + 1e-10));
        let exact = (0.7_f64 * 1e5).atan() + (0.3_f64 * 1e5).atan();
        assert!(respected("a narrow peak", &narrow, &exact).1 > -20.0);
        let pole = integrate(&0.0, &1.0, LEVELS, |s| 1.0 / s.above);
        assert!(pole.error_log2 > 0.0, "{pole:?}");
        let undefined = integrate(&0.0, &1.0, LEVELS, |s| (0.5 - s.x).sqrt());
        assert!(!undefined.value.is_finite() && undefined.error_log2 == f64::INFINITY);
        assert!(!integrate(&0.0, &f64::INFINITY, LEVELS, one).value.is_finite());
        assert!(!integrate(&f64::NAN, &1.0, LEVELS, one).value.is_finite());
        assert_eq!(integrate(&1.0, &1.0, LEVELS, one).value, 0.0);
    }
}
