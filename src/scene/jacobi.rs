//! Motions by Jacobi's functions, at any time without steps.
//!
//! An [`Oscillation`] gives sn, cn, dn of `nu t + v_0`; a [`Turning`] the integral of the third kind that a precession
//! angle is. Both are quotients of Jacobi's theta functions of one variable (DLMF 20.2, 22.2), whose series have a handful
//! of terms: with the nome q where k^2 <= 1/2, and after Jacobi's imaginary transformation (DLMF 20.7(viii)), with the
//! nome of k', where k^2 > 1/2, so that the nome is never above e^-pi. Everything that is computed once is computed in
//! the wider number type, and so is the phase: a value at a late time is as good as one at an early one.
//!
//! With `c = sqrt((1 - n)(n - k^2)/n)`, in the circular cases n < 0 and k^2 < n < 1,
//!
//! `Lambda(v) = c int_0^v dv/(1 - n sn^2 v) = c Pi(n, k)/K v + arg theta(z + i eta)`, `z = pi v/(2K)`,
//!
//! theta being theta_4 for n < 0 and theta_3 for n > k^2: Jacobi's own form of the integral of the third kind (DLMF
//! 22.16(iii) and 19.7(iii)), of which every precession of the heavy top and of the free body consists, with the factor
//! one. The argument stays within a quarter turn: Lambda is continuous as it stands.

use super::Precise;
use crate::number::elliptic::bare;
use crate::number::{Func, Number};
use std::f64::consts::LN_2;

/// Beyond this, hyperbolic functions are at their limits in any precision that is of use.
const FAR: f64 = 300.0;

/// The functions sn, cn, dn of a phase that is linear in time.
pub(super) struct Oscillation<N: Precise> {
    regime: Regime,
    /// Half periods (2K) for each unit of time, and at t = 0; where there is no period, nu and v_0.
    frequency: N::Wide,
    phase: N::Wide,
    /// nu.
    pub nu: N::Wide,
    /// K; infinite where k = 1.
    quarter: N::Wide,
    /// K'/K.
    ratio: N::Wide,
    k1: N::Wide,
    /// The coefficients q^(n^2) and q^(n^2 + n) of the even and odd multiples.
    even: Vec<N>,
    odd: Vec<N>,
    /// The factors of sn, cn and dn.
    factors: [N; 3],
    /// What a phase of z is multiplied by for the argument of the series.
    stretch: N,
    pi: N,
    cx: N::Context,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Regime {
    /// k^2 <= 1/2: series of circular functions.
    Circular,
    /// k^2 > 1/2: series of hyperbolic functions.
    Hyperbolic,
    /// k = 1: no period.
    Separatrix,
}

/// A point of an [`Oscillation`].
pub(super) struct Point<N> {
    pub sn: N,
    pub cn: N,
    pub dn: N,
    /// sn and cn of the phase less a whole number of half periods 2K, so that cn is not negative, and that number.
    pub within: [N; 2],
    pub halves: f64,
    z: N,
    /// cos and sin, or cosh and sinh, of the multiples of the argument.
    cos: Vec<N>,
    sin: Vec<N>,
}

/// How many terms leave out less than the roundoff, by -ln of the nome.
fn terms(bits: u32, decay: f64) -> usize {
    let terms = ((f64::from(bits) + 6.0) * LN_2 / decay.max(3.0)).sqrt().ceil();
    (terms as usize).clamp(1, 400) + 1
}

impl<N: Precise> Oscillation<N> {
    /// By k^2 and k'^2, both without cancellation, the rate nu of the phase and its value at t = 0.
    pub fn new(m: &N::Wide, m1: &N::Wide, nu: &N::Wide, v0: &N::Wide, cx: &N::Context) -> Self {
        let one = m.like(1.0);
        let (k, k1) = (m.root(), m1.root());
        let quarter = bare::quarter_period(&k1);
        let other = bare::quarter_period(&k);
        let ratio = other.over(&quarter);
        let regime = match m1.to_f64() {
            0.0 => Regime::Separatrix,
            m1 if m1 < m.to_f64() => Regime::Hyperbolic,
            _ => Regime::Circular,
        };
        let half = quarter.plus(&quarter);
        let (frequency, phase) = match regime {
            Regime::Separatrix => (nu.clone(), v0.clone()),
            _ => (nu.over(&half), v0.over(&half)),
        };
        let pi = <N::Wide as Number>::pi(&m.context());
        // -ln q, of k or of k'.
        let decay = match regime {
            Regime::Circular => pi.times(&ratio),
            Regime::Hyperbolic => pi.over(&ratio),
            Regime::Separatrix => one.like(f64::INFINITY),
        };
        let separatrix = regime == Regime::Separatrix;
        let count = if separatrix { 0 } else { terms(N::precision_bits(cx), decay.to_f64()) };
        let power = |e: usize| -> N {
            match (e, decay.is_finite()) {
                (0, _) => N::from_f64(1.0, cx),
                (_, false) => N::zero(cx),
                _ => N::narrow(&decay.times(&one.like(-(e as f64))).apply(Func::Exp), cx),
            }
        };
        let even: Vec<N> = (0..=count).map(|n| power(n * n)).collect();
        let odd: Vec<N> = (0..=count).map(|n| power(n * n + n)).collect();
        let stretch = if regime == Regime::Hyperbolic { one.over(&ratio) } else { one.clone() };
        let (pi, stretch) = (N::narrow(&pi, cx), N::narrow(&stretch, cx));
        let factors = [pi.like(1.0), pi.like(1.0), pi.like(1.0)];
        let mut made = Oscillation {
            regime,
            frequency,
            phase,
            nu: nu.clone(),
            quarter,
            ratio,
            k1,
            even,
            odd,
            factors,
            stretch,
            pi,
            cx: cx.clone(),
        };
        made.factors = made.limits();
        made
    }

    /// theta_2, theta_3 and theta_4 at zero, theta_2 over 2 q^(1/4).
    fn limits(&self) -> [N; 3] {
        let zero = self.pi.like(0.0);
        let two = self.pi.like(2.0);
        let sum = |terms: &[N], alternating: bool| {
            let signed = |(n, q): (usize, &N)| if alternating && n % 2 == 1 { q.negated() } else { q.clone() };
            terms.iter().enumerate().fold(zero.clone(), |sum, term| sum.plus(&signed(term)))
        };
        let one = self.pi.like(1.0);
        let both = |sum: N| sum.times(&two).minus(&one);
        let (second, third, fourth) =
            (sum(&self.odd, false), both(sum(&self.even, false)), both(sum(&self.even, true)));
        match self.regime {
            Regime::Circular => [third.over(&second), fourth.over(&second), fourth.over(&third)],
            _ => [third.over(&fourth), second.over(&fourth), second.over(&third)],
        }
    }

    /// Room for a point.
    pub fn room(&self) -> Point<N> {
        let zero = N::zero(&self.cx);
        let list = vec![zero.clone(); 2 * self.even.len() + 1];
        let [sn, cn, dn, z, a, b] = [(); 6].map(|()| zero.clone());
        Point { sn, cn, dn, within: [a, b], halves: 0.0, z, cos: list.clone(), sin: list }
    }

    /// The point at the time t.
    pub fn at(&self, t: f64, point: &mut Point<N>) {
        let phase = self.frequency.times(&self.frequency.like(t)).plus(&self.phase);
        let hyperbolic = self.regime != Regime::Circular;
        if self.regime == Regime::Separatrix {
            point.halves = 0.0;
            let far = phase.to_f64().abs() > FAR;
            let phase = if far { phase.like(FAR.copysign(phase.to_f64())) } else { phase };
            point.z = N::narrow(&phase, &self.cx);
        } else {
            let halves = phase.to_f64().round();
            point.halves = halves;
            point.z = N::narrow(&phase.minus(&phase.like(halves)), &self.cx).times(&self.pi);
        }
        let argument = point.z.times(&self.stretch);
        multiples(&argument, hyperbolic, point);
        let sum = |terms: &[N], of: &[N], first: usize, alternating: bool| {
            let mut sum = terms[0].times(&of[first]);
            for (n, q) in terms.iter().enumerate().skip(1) {
                let weight = if first == 0 { q.plus(q) } else { q.clone() };
                let term = weight.times(&of[2 * n + first]);
                sum = if alternating && n % 2 == 1 { sum.minus(&term) } else { sum.plus(&term) };
            }
            sum
        };
        // theta_1 and theta_2 are of the odd multiples, theta_3 and theta_4 of the even ones.
        let first = sum(&self.odd, &point.sin, 1, true);
        let second = sum(&self.odd, &point.cos, 1, false);
        let third = sum(&self.even, &point.cos, 0, false);
        let fourth = sum(&self.even, &point.cos, 0, true);
        let [a, b, c] = &self.factors;
        let (sn, cn, dn) = if hyperbolic {
            (first.over(&second).times(a), fourth.over(&second).times(b), third.over(&second).times(c))
        } else {
            (first.over(&fourth).times(a), second.over(&fourth).times(b), third.over(&fourth).times(c))
        };
        point.within = [sn.clone(), cn.clone()];
        let turned = point.halves.rem_euclid(2.0) == 1.0;
        (point.sn, point.cn, point.dn) = if turned { (sn.negated(), cn.negated(), dn) } else { (sn, cn, dn) };
    }
}

/// Fills in cos and sin, or cosh and sinh, of the multiples of an argument, by the sum of angles.
fn multiples<N: Number>(argument: &N, hyperbolic: bool, point: &mut Point<N>) {
    let one = argument.like(1.0);
    let (sin, cos) = if hyperbolic {
        (argument.apply(Func::Sinh), argument.apply(Func::Cosh))
    } else {
        let (mut sin, mut cos) = (argument.clone(), argument.clone());
        N::set_sin_cos(&mut sin, &mut cos, argument);
        (sin, cos)
    };
    (point.cos[0], point.sin[0]) = (one, argument.like(0.0));
    for k in 1..point.cos.len() {
        let (c, s) = (&point.cos[k - 1], &point.sin[k - 1]);
        let (cc, ss) = (c.times(&cos), s.times(&sin));
        let next = if hyperbolic { cc.plus(&ss) } else { cc.minus(&ss) };
        let sine = s.times(&cos).plus(&c.times(&sin));
        (point.cos[k], point.sin[k]) = (next, sine);
    }
}

/// The characteristic n of an integral of the third kind in a circular case, by numbers that do not cancel: `p = 1 - n`,
/// `r = (n - k^2)/n` and `g = k^2/|n|`, so that r = 1 + g for n < 0 and r = 1 - g for n > k^2. No gravity or symmetry, where
/// n = k = 0, is no exception.
pub(super) struct Characteristic<W> {
    pub negative: bool,
    pub p: W,
    pub r: W,
    pub g: W,
}

/// `Lambda` along an oscillation, less its value at t = 0.
pub(super) struct Turning<N: Precise> {
    /// The mean rate in time.
    rate: N::Wide,
    /// What is added for each unit of z.
    slope: N,
    /// Whether the multiples are the odd ones.
    odd: bool,
    cos: Vec<N>,
    sin: Vec<N>,
    start: N,
}

impl<N: Precise> Turning<N> {
    /// By the oscillation whose phase it goes along with. Where there is no period, n must be negative.
    pub fn new(along: &Oscillation<N>, n: &Characteristic<N::Wide>) -> Self {
        let Characteristic { negative, p, r, g } = n;
        let c = p.times(r).root();
        let m1 = along.k1.to_the(2);
        let y = if *negative {
            bare::rf(g, &g.times(p), r)
        } else {
            bare::rf(&g.times(p), &g.times(&m1), &m1).times(&r.root())
        };
        let pi = <N::Wide as Number>::pi(&g.context());
        let rate = match along.regime {
            Regime::Separatrix => c.over(p),
            _ => bare::complete_third(&along.k1, p).times(&c).over(&along.quarter),
        };
        // pi y/(2K), or pi y/(2K') where the nome is that of k'.
        let eta = match along.regime {
            Regime::Circular => pi.times(&y).over(&along.quarter.plus(&along.quarter)),
            Regime::Hyperbolic => pi.times(&y).over(&along.quarter.times(&along.ratio).times(&y.like(2.0))),
            Regime::Separatrix => y,
        };
        let slope = match along.regime {
            Regime::Hyperbolic => eta.over(&pi).times(&eta.like(-2.0)),
            _ => eta.like(0.0),
        };
        let odd = *negative && along.regime != Regime::Circular;
        let (cos, sin) = coefficients(along, &eta, *negative, odd);
        let slope = N::narrow(&slope, &along.cx);
        let start = N::zero(&along.cx);
        let mut made = Turning { rate: rate.times(&along.nu), slope, odd, cos, sin, start };
        let mut point = along.room();
        along.at(0.0, &mut point);
        made.start = made.periodic(&point);
        made
    }

    fn periodic(&self, point: &Point<N>) -> N {
        let first = usize::from(self.odd);
        let zero = self.slope.like(0.0);
        let sum = |terms: &[N], of: &[N]| {
            terms.iter().enumerate().fold(zero.clone(), |sum, (n, c)| sum.plus(&c.times(&of[2 * n + first])))
        };
        let mut angle = zero.clone();
        angle.set_atan2(&sum(&self.sin, &point.sin), &sum(&self.cos, &point.cos));
        angle.plus(&self.slope.times(&point.z))
    }

    /// The angle at the time t, the point's own: zero at t = 0. `more` is a rate to be added.
    pub fn at(&self, t: f64, point: &Point<N>, cx: &N::Context) -> N {
        let mean = N::narrow(&self.rate.times(&self.rate.like(t)), cx);
        mean.plus(&self.periodic(point).minus(&self.start))
    }
}

/// The coefficients of the cosines and sines of multiples whose sums are the real and imaginary parts of theta(z + i
/// eta), but for a common factor.
fn coefficients<N: Precise>(along: &Oscillation<N>, eta: &N::Wide, negative: bool, odd: bool) -> (Vec<N>, Vec<N>) {
    let cx = &along.cx;
    let (mut cos, mut sin) = (Vec::new(), Vec::new());
    let narrow = |x: &N::Wide| N::narrow(x, cx);
    let pi = <N::Wide as Number>::pi(&eta.context());
    for n in 0..along.even.len() {
        let multiple = eta.times(&eta.like((2 * n + usize::from(odd)) as f64));
        let twice = if n == 0 && !odd { 1.0 } else { 2.0 };
        if along.regime == Regime::Circular {
            // q^(n^2) e^(±2 n eta), the exponents added first.
            if n > 0 && !along.ratio.is_finite() {
                break; // Without a modulus the nome is zero.
            }
            let decay = if n == 0 { eta.like(0.0) } else { pi.times(&along.ratio).times(&eta.like((n * n) as f64)) };
            let [up, down] = [multiple.minus(&decay), multiple.plus(&decay).negated()].map(|e| e.apply(Func::Exp));
            let sign = if negative && n % 2 == 1 { 1.0 } else { -1.0 };
            cos.push(narrow(&up.plus(&down)).times(&N::from_f64(-sign * twice / 2.0, cx)));
            sin.push(narrow(&up.minus(&down)).times(&N::from_f64(sign, cx)));
        } else {
            let q = if odd { &along.odd[n] } else { &along.even[n] };
            let q = q.times(&q.like(twice));
            cos.push(narrow(&multiple.apply(Func::Cos)).times(&q));
            sin.push(narrow(&multiple.apply(Func::Sin)).times(&q));
        }
    }
    (cos, sin)
}

/// The phase from -K to K at which sn^2 : cn^2 is `s : c` and dn^2 is `d`, negative where the motion is backward.
pub(super) fn phase<N: Number>(s: &N, c: &N, d: &N, backward: bool) -> N {
    if s.log2_abs() == f64::NEG_INFINITY {
        return s.like(0.0);
    }
    let whole = s.plus(c);
    let size = s.over(&whole).root().times(&bare::rf(&c.over(&whole), d, &s.like(1.0)));
    if backward { size.negated() } else { size }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::{Df64, Elliptic};

    fn elliptic(f: Elliptic, x: &[f64]) -> Df64 {
        let x: Vec<Df64> = x.iter().map(|x| Df64::from(*x)).collect();
        let mut value = Df64::from(0.0);
        value.set_elliptic(f, &x.iter().collect::<Vec<_>>());
        value
    }

    /// sn, cn, dn and Lambda against the elliptic functions and integrals of the number module, in double-double: moduli
    /// of both regimes and both circular cases, near their ends, too.
    #[test]
    fn theta_functions_agree_with_the_elliptic_functions() {
        let one = Df64::from(1.0);
        for k in [0.01, 0.3, 0.7, 0.72, 0.95, 0.999_999] {
            let m = Df64::from(k) * k;
            let m1 = (one - Df64::from(k)) * (one + k);
            let along = Oscillation::<Df64>::new(&m, &m1, &one, &Df64::from(0.0), &());
            let mut point = along.room();
            let upper = m.hi() + 0.3 * m1.hi();
            for n in [-1e-3, -0.4, -30.0, upper, 1.0 - 0.01 * m1.hi()] {
                let (wide, negative) = (Df64::from(n), n < 0.0);
                let g = if negative { -m / wide } else { m / wide };
                let r = if negative { g + one } else { (wide - m) / wide };
                let c = ((one - wide) * r).root();
                let turning = Turning::new(&along, &Characteristic { negative, p: one - wide, r, g });
                for v in [0.0, 0.2, 1.3, 2.9, 40.7] {
                    along.at(v, &mut point);
                    let parts = [(Elliptic::Sn, &point.sn), (Elliptic::Cn, &point.cn), (Elliptic::Dn, &point.dn)];
                    for (f, value) in parts {
                        let error = (*value - elliptic(f, &[v, k])).hi().abs();
                        assert!(error < 1e-28, "{}({v}, {k}) is off by {error:e}", f.name());
                    }
                    let amplitude = elliptic(Elliptic::Am, &[v, k]);
                    let mut integral = Df64::from(0.0);
                    integral.set_elliptic(Elliptic::IncompletePi, &[&amplitude, &wide, &Df64::from(k)]);
                    let error = (turning.at(v, &point, &()) - c * integral).hi().abs();
                    let scale = 1.0 + (c * integral).hi().abs() + 1.0 / r.hi().sqrt();
                    assert!(error < 1e-26 * scale, "Lambda({v}) for k = {k}, n = {n} is off by {error:e}");
                }
            }
        }
    }

    /// With k = 1 there is no period: sn is a hyperbolic tangent.
    #[test]
    fn the_separatrix_is_hyperbolic() {
        let [zero, one] = [0.0, 1.0].map(Df64::from);
        let along = Oscillation::<f64>::new(&one, &zero, &one, &zero, &());
        let mut point = along.room();
        for v in [0.0, 0.7, -3.0, 50.0, 1e6] {
            along.at(v, &mut point);
            let sech = 1.0 / f64::cosh(v);
            for (value, exact) in [(point.sn, v.tanh()), (point.cn, sech), (point.dn, sech)] {
                assert!((value - exact).abs() < 1e-15, "{value} and {exact} at {v}");
            }
        }
    }
}
