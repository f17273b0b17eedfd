//! The conformance suite: one generic function that every number type must pass, and the measurement of roundings
//! against MPFR where the feature `rug` is on.

use super::*;
use proptest::test_runner::{RngAlgorithm, TestRng};

/// Reproducible random numbers.
pub(super) struct Random(TestRng);

impl Random {
    pub(super) fn new(seed: u8) -> Self {
        Random(TestRng::from_seed(RngAlgorithm::ChaCha, &[seed; 32]))
    }

    pub(super) fn bits(&mut self) -> u64 {
        use proptest::prelude::Rng;
        self.0.next_u64()
    }

    pub(super) fn below(&mut self, n: usize) -> usize {
        (self.bits() % n as u64) as usize
    }

    /// Uniform in [a, b].
    pub(super) fn within(&mut self, a: f64, b: f64) -> f64 {
        a + (b - a) * (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Either sign, |log₂| at most `binades`.
    pub(super) fn wide(&mut self, binades: f64) -> f64 {
        let size = self.within(-binades, binades).exp2() * self.within(1.0, 2.0);
        if self.bits() & 1 == 0 { size } else { -size }
    }
}

/// |a - b| ≤ 2^-slack-less bits of the larger one.
fn close<N: Spread>(a: &N, b: &N, lost: f64, what: &str) {
    let bits = f64::from(N::precision_bits(&a.context())) - N::BITS;
    let scale = a.log2_abs().max(b.log2_abs());
    let difference = a.minus(b).log2_abs();
    assert!(difference <= scale - bits + lost || difference == f64::NEG_INFINITY, "{what}: {a:?} and {b:?}");
}

/// The bits that a type may lose beside what the laws allow for rounding.
trait Spread: Number {
    const BITS: f64 = 0.0;
}

impl Spread for f64 {}
impl Spread for Df64 {}
impl<N: Real> Spread for Tracked<N> {}
impl<const WIDTH: usize> Spread for Lanes<WIDTH> {}
impl<N: Spread> Spread for Dual<N> {
    const BITS: f64 = N::BITS;
}
impl<N: Spread> Spread for Jet<N> {
    const BITS: f64 = N::BITS;
}
#[cfg(feature = "rug")]
impl Spread for Mpfr {}
/// Enclosures lose more: the widths of their operands add up where the errors of numbers cancel.
#[cfg(feature = "rug")]
impl Spread for Interval {
    const BITS: f64 = 8.0;
}

fn field_laws<N: Spread>(cx: &N::Context) {
    let mut random = Random::new(1);
    let one = N::from_f64(1.0, cx);
    for _ in 0..200 {
        let [a, b, c] = [(); 3].map(|()| N::from_f64(random.wide(20.0), cx).over(&N::from_f64(3.0, cx)));
        close(&a.plus(&b), &b.plus(&a), 0.0, "a + b = b + a");
        close(&a.times(&b), &b.times(&a), 0.0, "ab = ba");
        close(&a.times(&b).times(&c), &a.times(&b.times(&c)), 4.0, "(ab)c = a(bc)");
        close(&a.times(&b).over(&b), &a, 4.0, "ab/b = a");
        close(&a.plus(&b).minus(&b).plus(&b), &a.plus(&b), 4.0, "a + b - b + b = a + b");
        close(&a.times(&one), &a, 1.0, "1a = a");
        close(&a.minus(&b), &b.minus(&a).negated(), 0.0, "a - b = -(b - a)");
        let mut sum = c.clone();
        sum.add_product(&a, &b);
        let product = a.times(&b);
        // Where c and ab cancel, only their own size tells how much the roundings are.
        let size = c.apply(Func::Abs).plus(&product.apply(Func::Abs)).times(&N::from_f64(4.0, cx));
        close(&sum.plus(&size), &c.plus(&product).plus(&size), 2.0, "c + ab");
        let square = a.to_the(2);
        close(&square, &a.times(&a), 3.0, "a² = aa");
        close(&square.root(), &a.apply(Func::Abs), 4.0, "√a² = |a|");
        close(&a.apply(Func::Abs).times(&a.apply(Func::Sign)), &a, 1.0, "|a| sign a = a");
        close(&a.to_the(-3).times(&a.to_the(3)), &one, 6.0, "a⁻³a³ = 1");
        // (a + b)² = a² + 2ab + b² for a and b of one sign
        let (p, q) = (a.apply(Func::Abs), b.apply(Func::Abs));
        let twice = p.times(&q).plus(&p.times(&q));
        close(&p.plus(&q).to_the(2), &p.to_the(2).plus(&twice).plus(&q.to_the(2)), 5.0, "(a + b)²");
    }
}

/// (1 + x)ⁿ by repeated products of power series has the binomial coefficients; the lengths pass every remainder.
fn convolutions<N: Spread>(cx: &N::Context) {
    let n = |x: f64| N::from_f64(x, cx);
    let (factor, mut power) = ([n(1.0), n(1.0)], vec![n(1.0)]);
    for exponent in 1..=13 {
        let mut padded = power.clone();
        padded.push(n(0.0));
        let mut other = factor.to_vec();
        other.resize(padded.len(), n(0.0));
        let coefficient = |k: usize| {
            let mut sum = n(7.0);
            sum.set_convolution(&padded[..=k], &other[..=k]);
            sum
        };
        power = (0..padded.len()).map(coefficient).collect();
        let mut binomial = 1.0;
        for (k, found) in power.iter().enumerate() {
            close(found, &n(binomial), 4.0, "a binomial coefficient");
            binomial = binomial * (exponent - k) as f64 / (k + 1) as f64;
        }
    }
    let mut sum = n(7.0);
    sum.set_convolution(&[n(2.0), n(3.0), n(5.0)], &[n(7.0), n(11.0)]);
    close(&sum, &n(43.0), 1.0, "the shorter one says how many terms");
    sum.set_convolution(&[], &[n(7.0)]);
    assert!(sum.log2_abs() == f64::NEG_INFINITY, "no terms");
}

fn functional_equations<N: Spread>(cx: &N::Context) {
    let mut random = Random::new(2);
    let one = N::from_f64(1.0, cx);
    let two = N::from_f64(2.0, cx);
    for _ in 0..100 {
        let a = N::from_f64(random.within(0.1, 1.5), cx).over(&N::from_f64(1.7, cx));
        let round_trips = [
            (Func::Sin, Func::Asin),
            (Func::Cos, Func::Acos),
            (Func::Tan, Func::Atan),
            (Func::Sinh, Func::Asinh),
            (Func::Cosh, Func::Acosh),
            (Func::Tanh, Func::Atanh),
            (Func::Exp, Func::Ln),
        ];
        for (f, inverse) in round_trips {
            close(&a.apply(f).apply(inverse), &a, 16.0, f.name());
        }
        let (mut s, mut c) = (a.clone(), a.clone());
        N::set_sin_cos(&mut s, &mut c, &a);
        close(&s, &a.apply(Func::Sin), 6.0, "sin");
        close(&c, &a.apply(Func::Cos), 6.0, "cos");
        close(&s.to_the(2).plus(&c.to_the(2)), &one, 6.0, "sin² + cos²");
        close(&s.over(&c), &a.apply(Func::Tan), 8.0, "sin/cos");
        let (sh, ch) = (a.apply(Func::Sinh), a.apply(Func::Cosh));
        close(&ch.to_the(2).minus(&sh.to_the(2)), &one, 12.0, "cosh² - sinh²");
        close(&sh.plus(&ch), &a.apply(Func::Exp), 6.0, "sinh + cosh");
        close(&sh.over(&ch), &a.apply(Func::Tanh), 8.0, "sinh/cosh");
        let mut angle = a.clone();
        angle.set_atan2(&s, &c);
        close(&angle, &a, 8.0, "atan2");
        let mut power = a.clone();
        power.set_pow(&a, &two);
        close(&power, &a.to_the(2), 8.0, "a^2");
        power.set_pow(&a, &one.over(&two));
        close(&power, &a.root(), 8.0, "a^(1/2)");
    }
}

fn special_values<N: Spread>(cx: &N::Context) {
    let n = |x: f64| N::from_f64(x, cx);
    let same = |a: &N, b: f64, what: &str| assert_eq!(a.to_f64(), b, "{what}");
    for (base, exponent, power) in [
        (-2.0, 3, -8.0),
        (-2.0, -2, 0.25),
        (-2.0, -3, -0.125),
        (0.0, 5, 0.0),
        (0.0, 0, 1.0),
        (3.0, 0, 1.0),
        (-1.0, -7, -1.0),
    ] {
        same(&n(base).to_the(exponent), power, "integer power");
    }
    for (f, at, value) in [
        (Func::Sin, 0.0, 0.0),
        (Func::Cos, 0.0, 1.0),
        (Func::Exp, 0.0, 1.0),
        (Func::Ln, 1.0, 0.0),
        (Func::Atan, 0.0, 0.0),
        (Func::Sinh, 0.0, 0.0),
        (Func::Cosh, 0.0, 1.0),
        (Func::Asin, 0.0, 0.0),
        (Func::Abs, -2.5, 2.5),
        (Func::Sign, -2.5, -1.0),
        (Func::Sign, 0.0, 0.0),
    ] {
        same(&n(at).apply(f), value, f.name());
    }
    let undefined = [
        n(1.0).over(&n(0.0)),
        n(0.0).over(&n(0.0)),
        n(0.0).to_the(-1),
        n(-1.0).root(),
        n(0.0).apply(Func::Ln),
        n(-1.0).apply(Func::Ln),
        n(2.0).apply(Func::Asin),
        n(-2.0).apply(Func::Acos),
        n(0.5).apply(Func::Acosh),
        n(1.0).apply(Func::Atanh),
        n(-2.0).apply(Func::Atanh),
        N::from_ratio(1, 0, cx),
    ];
    for (i, x) in undefined.iter().enumerate() {
        assert!(!x.is_finite(), "undefined value {i}: {x:?}");
    }
    let mut power = n(0.0);
    power.set_pow(&n(-2.0), &n(0.5));
    assert!(!power.is_finite(), "a root of a negative number: {power:?}");
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for f in Func::ALL {
            n(bad).apply(f); // must not panic
        }
        assert!(!n(bad).apply(Func::Sin).is_finite());
    }
    close(&N::from_ratio(-1, 3, cx).times(&n(-3.0)), &n(1.0), 3.0, "1/3");
    close(&N::from_ratio(i128::MAX, 1, cx), &n(2.0).to_the(127).minus(&n(1.0)), 2.0, "a large integer");
    close(&N::pi(cx).over(&n(6.0)).apply(Func::Sin), &n(0.5), 3.0, "sin π/6");
    close(&N::e(cx).apply(Func::Ln), &n(1.0), 3.0, "ln e");
    close(&n(1.0).apply(Func::Exp), &N::e(cx), 3.0, "exp 1");
    let angles =
        [(0.0, 1.0, 0.0), (1.0, 0.0, 0.5), (0.0, -1.0, 1.0), (-1.0, 0.0, -0.5), (-0.0, -1.0, 1.0), (1.0, -1.0, 0.75)];
    for (y, x, of_pi) in angles {
        let mut angle = n(0.0);
        angle.set_atan2(&n(y), &n(x));
        close(&angle, &N::pi(cx).times(&n(of_pi)), 4.0, "atan2");
    }
}

/// What every number type must pass.
fn conforms<N: Spread>(cx: &N::Context) {
    field_laws::<N>(cx);
    convolutions::<N>(cx);
    functional_equations::<N>(cx);
    special_values::<N>(cx);
}

#[test]
fn machine_numbers() {
    conforms::<f64>(&());
}

#[test]
fn lanes() {
    conforms::<Lanes<8>>(&());
    conforms::<Lanes<3>>(&());
}

#[test]
fn double_double() {
    conforms::<Df64>(&());
}

/// The first 29 digits of the functions' values, computed with 100, at ordinary and hard machine numbers.
#[test]
fn double_double_values() {
    let values = [
        (Func::Sin, 0.7, "0.64421768723769101970679809028"),
        (Func::Sin, 1e22, "-0.85220084976718880177270589375"),
        (Func::Sin, -355.0, "0.000030144353359488449214330280009"),
        (Func::Sin, 5e9, "0.25187335837990487915672409096"),
        (Func::Cos, 11.0, "0.0044256979880507857483550247239"),
        (Func::Cos, 1e300, "-0.57538611195754904668824427597"),
        (Func::Cos, -0.1, "0.99500416527802576554137519886"),
        (Func::Cos, 5e9, "-0.96776020342770243539616099476"),
        (Func::Tan, 11.0, "-225.9508464541951420257954832"),
        (Func::Tan, -1.5, "-14.101419947171719387646083652"),
        (Func::Tan, 1e22, "-1.6287782256068988785493759369"),
        (Func::Asin, 0.3, "0.30469265401539749633370334029"),
        (Func::Asin, 0.9999999999, "1.5707821846586877076676774494"),
        (Func::Asin, -0.9999999999, "-1.5707821846586877076676774494"),
        (Func::Acos, 0.3, "1.2661036727794991228976183514"),
        (Func::Acos, 0.9999999999, "0.000014142136208911563644242213387"),
        (Func::Acos, -0.9999999999, "3.1415785114535843268989991411"),
        (Func::Atan, 1e-9, "1.0000000000000000619482581244e-9"),
        (Func::Atan, 3.0, "1.2490457723982544258299170773"),
        (Func::Atan, -1e9, "-1.570796325794896619231321692"),
        (Func::Sinh, 1e-9, "1.0000000000000000624482581244e-9"),
        (Func::Sinh, -0.3, "-0.30452029344714260735284639787"),
        (Func::Sinh, 20.0, "242582597.70489513795397660405"),
        (Func::Cosh, 1e-9, "1.0000000000000000005"),
        (Func::Cosh, -3.0, "10.067661995777765841953936035"),
        (Func::Tanh, 1e-9, "1.0000000000000000619482581244e-9"),
        (Func::Tanh, -0.3, "-0.29131261245159089565816001577"),
        (Func::Tanh, 20.0, "0.99999999999999999150329148942"),
        (Func::Asinh, -1e-9, "-1.0000000000000000621149247911e-9"),
        (Func::Asinh, 0.5, "0.48121182505960344749775891342"),
        (Func::Asinh, 1e9, "21.416413017506356465829155214"),
        (Func::Acosh, 1.0000000001, "0.000014142136208675861354593558235"),
        (Func::Acosh, 1.5, "0.96242365011920689499551782685"),
        (Func::Acosh, 1e9, "21.416413017506356465329155214"),
        (Func::Atanh, 1e-9, "1.0000000000000000626149247911e-9"),
        (Func::Atanh, -0.9999999999, "-11.859499013855017284676406161"),
        (Func::Exp, -100.5, "2.2563401359170363132028182824e-44"),
        (Func::Exp, 1e-9, "1.0000000010000000005000000624"),
        (Func::Exp, 700.0, "1.0142320547350045094553295952e304"),
        (Func::Ln, 1.0000000001, "1.000000082690370990819669408e-10"),
        (Func::Ln, 0.9999999999, "-1.0000000827903710073677442925e-10"),
        (Func::Ln, 1e-300, "-690.77552789821370518033834457"),
        (Func::Ln, 3.0, "1.0986122886681096913952452369"),
    ];
    for (f, x, text) in values {
        assert_eq!(Df64::from(x).apply(f).to_decimal(29), text, "{} {x}", f.name());
    }
}

#[test]
fn dual() {
    conforms::<Dual<f64>>(&());
    conforms::<Dual<Df64>>(&());
    conforms::<Dual<Dual<f64>>>(&());
}

#[test]
fn jet() {
    conforms::<Jet<f64>>(&JetContext { order: 3, inner: () });
    conforms::<Jet<Df64>>(&JetContext { order: 0, inner: () });
    conforms::<Jet<Dual<Df64>>>(&JetContext { order: 2, inner: () });
}

#[test]
fn tracked() {
    conforms::<Tracked<f64>>(&());
    conforms::<Tracked<Df64>>(&());
    conforms::<Dual<Tracked<Df64>>>(&());
}

#[cfg(feature = "rug")]
#[test]
fn mpfr() {
    for bits in [53, 64, 256, 1000] {
        conforms::<Mpfr>(&bits);
    }
    conforms::<Dual<Mpfr>>(&200);
    conforms::<Jet<Mpfr>>(&JetContext { order: 2, inner: 200 });
    conforms::<Tracked<Mpfr>>(&200);
}

#[cfg(feature = "rug")]
#[test]
fn interval() {
    for bits in [53, 64, 256, 1000] {
        conforms::<Interval>(&bits);
    }
    conforms::<Dual<Interval>>(&200);
    conforms::<Jet<Interval>>(&JetContext { order: 2, inner: 200 });
}
