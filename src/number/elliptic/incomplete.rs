//! Legendre's incomplete integrals by Carlson's (DLMF 19.25.5 to 19.25.14), and by the complete ones beyond a quarter
//! turn.

use super::arithmetic::Arithmetic;
use super::carlson::{rd, rf, rj};
use super::complete::complete;
use super::jacobi::{Modulus, tangent};
use super::{Elliptic, Outcome};

/// Beyond so many half turns, amplitudes are not reduced.
const FARTHEST: f64 = (1_u64 << 52) as f64;

/// φ = nπ + an angle within ±π/2, of which sine and cosine are given.
struct Amplitude<W> {
    turns: f64,
    sin: W,
    cos: W,
}

impl<W: Arithmetic> Amplitude<W> {
    fn new(phi: &W) -> Self {
        let pi = phi.half_turn();
        let turns = phi.quotient(&pi).approx().round();
        let rest = match turns {
            0.0 => phi.clone(),
            _ if turns.abs() < FARTHEST => phi.difference(&pi.by(turns)),
            _ => phi.undefined(),
        };
        let negative = rest.approx() < 0.0;
        let (size, one) = (rest.size(), rest.constant(1.0));
        let beyond = size.approx() > std::f64::consts::FRAC_PI_4;
        // With k = 0, sc is the tangent.
        let t = tangent(&if beyond { pi.by(0.5).difference(&size) } else { size }, &one);
        let long = one.quotient(&t.square().more(1.0).square_root());
        let short = t.product(&long);
        let (sin, cos) = if beyond { (long, short) } else { (short, long) };
        Amplitude { turns, sin: if negative { sin.opposite() } else { sin }, cos }
    }
}

/// What all four integrals have in common.
struct Parts<W> {
    amplitude: Amplitude<W>,
    cos2: W,
    /// Δ² = 1 - k² sin².
    delta2: W,
    one: W,
}

impl<W: Arithmetic> Parts<W> {
    fn new(phi: &W, modulus: &Modulus<W>) -> Self {
        let amplitude = Amplitude::new(phi);
        let cos2 = amplitude.cos.square();
        // Without a difference, as long as k is at most 1.
        let delta2 = cos2.sum(&modulus.m1.product(&amplitude.sin.square()));
        Parts { amplitude, cos2, delta2, one: phi.constant(1.0) }
    }

    /// The first kind: sin R_F(cos², Δ², 1).
    fn first(&self) -> W {
        self.amplitude.sin.product(&rf(&self.cos2, &self.delta2, &self.one))
    }

    fn cube(&self) -> W {
        self.amplitude.sin.square().product(&self.amplitude.sin)
    }

    /// ∫ sin²/Δ: sin³ R_D(cos², Δ², 1)/3.
    fn d(&self) -> W {
        self.cube().product(&rd(&self.cos2, &self.delta2, &self.one)).quotient(&self.one.constant(3.0))
    }

    /// ∫ sin²/Δ³: sin³ R_D(cos², 1, Δ²)/3.
    fn g(&self) -> W {
        self.cube().product(&rd(&self.cos2, &self.one, &self.delta2)).quotient(&self.one.constant(3.0))
    }

    /// ∫ sin²/((1 - n sin²)Δ): sin³ R_J(cos², Δ², 1, 1 - n sin²)/3.
    fn j(&self, p: &W) -> W {
        self.cube().product(&rj(&self.cos2, &self.delta2, &self.one, p)).quotient(&self.one.constant(3.0))
    }

    /// log₂ of how much of a divisor that is a difference from cos² is lost.
    fn cancelled(&self, divisor: &W) -> f64 {
        (self.cos2.log2_size() - divisor.log2_size()).max(0.0)
    }
}

/// F, E, D or G of φ and k.
pub(super) fn legendre<W: Arithmetic>(f: Elliptic, phi: &W, modulus: &Modulus<W>) -> Outcome<W> {
    let parts = Parts::new(phi, modulus);
    let (rest, size) = match f {
        Elliptic::IncompleteF => (parts.first(), None),
        Elliptic::IncompleteD => (parts.d(), None),
        Elliptic::IncompleteG => (parts.g(), None),
        _ => {
            let first = parts.first();
            let second = first.difference(&modulus.k.square().product(&parts.d()));
            (second, Some(first))
        }
    };
    let beyond = if modulus.m1.approx() < 0.0 { parts.cancelled(&parts.delta2) } else { 0.0 };
    let cancelled = size.map_or(0.0, |first| subtracted(&first, &rest));
    let value = with_turns(f, &parts, rest, None, modulus);
    // log₂ of the integrand: 1/Δ, Δ, sin²/Δ, sin²/Δ³.
    let (delta, square) = (parts.delta2.log2_size() / 2.0, 2.0 * parts.amplitude.sin.log2_size());
    let integrand = match f {
        Elliptic::IncompleteF => -delta,
        Elliptic::IncompleteE => delta,
        Elliptic::IncompleteD => square - delta,
        _ => square - 3.0 * delta,
    };
    let lost = steepness(phi, &value, integrand) + beyond + cancelled;
    Outcome { value, lost }
}

/// Π of φ, n and k, by n and 1 - n.
pub(super) fn third<W: Arithmetic>(phi: &W, n: &W, complement: &W, modulus: &Modulus<W>) -> Outcome<W> {
    let parts = Parts::new(phi, modulus);
    let p = parts.cos2.sum(&complement.product(&parts.amplitude.sin.square()));
    let first = parts.first();
    let rest = first.sum(&n.product(&parts.j(&p)));
    let beyond = [(&modulus.m1, &parts.delta2), (complement, &p)]
        .map(|(m, divisor)| if m.approx() < 0.0 { parts.cancelled(divisor) } else { 0.0 });
    let cancelled = subtracted(&first, &rest);
    let value = with_turns(Elliptic::IncompletePi, &parts, rest, Some(complement), modulus);
    let integrand = -parts.delta2.log2_size() / 2.0 - p.log2_size();
    Outcome { lost: steepness(phi, &value, integrand) + beyond[0] + beyond[1] + cancelled, value }
}

/// log₂ of how much smaller a difference is than what it is the difference of.
fn subtracted<W: Arithmetic>(first: &W, rest: &W) -> f64 {
    if first.log2_size() == f64::NEG_INFINITY { 0.0 } else { (first.log2_size() - rest.log2_size()).max(0.0) }
}

/// log₂ of how much the relative error of φ grows, by log₂ of the integrand.
fn steepness<W: Arithmetic>(phi: &W, value: &W, integrand: f64) -> f64 {
    let zero = phi.log2_size() == f64::NEG_INFINITY || value.log2_size() == f64::NEG_INFINITY;
    if zero { 0.0 } else { (phi.log2_size() + integrand - value.log2_size()).max(0.0) }
}

/// Adds the complete integral for each quarter turn.
fn with_turns<W: Arithmetic>(f: Elliptic, parts: &Parts<W>, rest: W, p: Option<&W>, modulus: &Modulus<W>) -> W {
    if parts.amplitude.turns == 0.0 {
        return rest;
    }
    let whole = whole(f, p, modulus);
    rest.sum(&whole.by(2.0 * parts.amplitude.turns))
}

/// The complete integral of the same kind; Π by 1 - n = p.
pub(super) fn whole<W: Arithmetic>(f: Elliptic, p: Option<&W>, modulus: &Modulus<W>) -> W {
    let k1 = modulus.complementary();
    let [zero, one] = [0.0, 1.0].map(|x| k1.constant(x));
    match f {
        Elliptic::IncompleteE | Elliptic::CompleteE if k1.log2_size() == f64::NEG_INFINITY => one,
        Elliptic::IncompleteE | Elliptic::CompleteE => complete(&k1, &one, &one, &modulus.m1),
        Elliptic::IncompleteD | Elliptic::CompleteD => complete(&k1, &one, &zero, &one),
        Elliptic::IncompleteG | Elliptic::CompleteG => complete(&k1, &modulus.m1, &zero, &one),
        Elliptic::IncompletePi | Elliptic::CompletePi => complete(&k1, p.unwrap_or(&one), &one, &one),
        _ => super::complete::quarter_period(&k1),
    }
}
