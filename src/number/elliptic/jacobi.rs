//! Jacobi's functions from one of them: sc = sn/cn, the tangent of the amplitude, which is an odd function of u that no
//! formula here takes the difference of anything for.
//!
//! u is brought within half a quarter period K of a multiple nK, and halved until a few terms of Taylor's series do;
//! then doubled again (DLMF 22.6.5 to 22.6.7, divided):
//!
//! sc 2u = 2t √((1 + t²)(1 + k'²t²)) / (1 - k'²t⁴), t = sc u.
//!
//! From sc come sn = t/√(1 + t²), cn = 1/√(1 + t²), dn = √(1 + k'²t²)/√(1 + t²), all to their last relative digit also
//! for k → 1, and the values at u + nK (DLMF 22.4.3). With k = 0 the same are sine and cosine, with k = 1 hyperbolic
//! functions.

use super::arithmetic::Arithmetic;
use super::carlson::{rc, rd};
use super::complete::{complete, quarter_period};
use super::{Elliptic, Outcome};

/// Beyond so many quarter periods, arguments are not reduced: machine numbers are coarser than a period there.
const FARTHEST: f64 = (1_u64 << 52) as f64;

/// A modulus that is not negative.
#[derive(Clone, Debug)]
pub(super) struct Modulus<W> {
    /// k.
    pub k: W,
    /// k'² = 1 - k².
    pub m1: W,
}

impl<W: Arithmetic> Modulus<W> {
    /// From k and 1 - k.
    pub fn new(k: &W, complement: &W) -> Self {
        Modulus { k: k.clone(), m1: complement.product(&k.more(1.0)) }
    }

    /// k' of k ≤ 1.
    pub fn complementary(&self) -> W {
        self.m1.square_root()
    }
}

/// sc(u, k) for 0 ≤ u ≤ K/2, but for a few units in the last place, by k'² = `m1` in [0, 1].
pub(super) fn tangent<W: Arithmetic>(u: &W, m1: &W) -> W {
    let bits = f64::from(u.bits());
    let small = (0.8 * bits.sqrt()).ceil();
    let halvings = (u.log2_size().ceil() + small).max(0.0);
    if halvings.is_nan() || halvings > 1000.0 {
        return u.undefined();
    }
    let terms = (bits / (2.0 * small)).ceil() as usize + 1;
    let start = taylor(&u.by(f64::exp2(-halvings)), m1, terms);
    (0..halvings as u32).fold(start, |t, _| doubled(&t, m1))
}

fn doubled<W: Arithmetic>(t: &W, m1: &W) -> W {
    let t2 = t.square();
    let mt2 = m1.product(&t2);
    let root = t2.more(1.0).product(&mt2.more(1.0)).square_root();
    t.by(2.0).product(&root).quotient(&t.constant(1.0).difference(&mt2.product(&t2)))
}

/// Taylor's series of t = sc u from t'' = t (1 + k'² + 2k'²t²).
fn taylor<W: Arithmetic>(u: &W, m1: &W, terms: usize) -> W {
    let zero = u.constant(0.0);
    let (linear, cubic) = (m1.more(1.0), m1.by(2.0));
    let convolved = |a: &[W], b: &[W], j: usize| {
        (0..=j).fold(zero.clone(), |sum, i| match (a.get(i), b.get(j - i)) {
            (Some(a), Some(b)) => sum.sum(&a.product(b)),
            _ => sum,
        })
    };
    let mut t = vec![u.constant(1.0)]; // the coefficients of u, u³, ...
    let mut squares = Vec::new(); // of t²: u², u⁴, ...
    let (mut next, mut cube) = (u.constant(1.0), zero.clone());
    for j in 0..terms {
        squares.push(convolved(&t, &t, j));
        let factor = (2 * j + 2) as f64 * (2 * j + 3) as f64;
        next = linear.product(&next).sum(&cubic.product(&cube)).quotient(&u.constant(factor));
        t.push(next.clone());
        cube = convolved(&squares, &t, j);
    }
    let u2 = u.square();
    let sum = t.iter().rev().fold(zero.clone(), |sum, c| sum.product(&u2).sum(c));
    sum.product(u)
}

/// An argument as a multiple of the quarter period and a rest.
struct Reduced<W> {
    /// u = nK + rest.
    quarters: f64,
    negative: bool,
    /// sc of the rest's magnitude.
    t: W,
    /// log₂ of how far the absolute error of the rest exceeds that of u, and its relative one.
    absolute: f64,
    relative: f64,
}

fn reduced<W: Arithmetic>(u: &W, modulus: &Modulus<W>) -> Reduced<W> {
    let mut rest = u.clone();
    let mut quarters = 0.0;
    // K/2 is at least π/4; there is no period for k = 1.
    if u.approx().abs() > 0.75 && modulus.m1.log2_size() > f64::NEG_INFINITY {
        let quarter = quarter_period(&modulus.complementary());
        quarters = u.quotient(&quarter).approx().round();
        rest = if quarters.abs() < FARTHEST { u.difference(&quarter.by(quarters)) } else { u.undefined() };
    }
    let size = u.log2_size();
    Reduced {
        quarters,
        negative: rest.approx() < 0.0,
        t: tangent(&rest.size(), &modulus.m1),
        absolute: size.max(0.0),
        relative: if quarters == 0.0 { 0.0 } else { (size - rest.log2_size()).max(size) },
    }
}

/// sn, cn and dn.
struct Triple<W> {
    sn: W,
    cn: W,
    dn: W,
}

impl<W: Arithmetic> Reduced<W> {
    fn is_odd(&self) -> bool {
        self.quarters.rem_euclid(2.0) == 1.0
    }

    fn triple(&self, modulus: &Modulus<W>) -> Triple<W> {
        let t2 = self.t.square();
        let cn = t2.constant(1.0).quotient(&t2.more(1.0).square_root());
        let sn = self.t.product(&cn);
        let dn = modulus.m1.product(&t2).more(1.0).square_root().product(&cn);
        let sn = if self.negative { sn.opposite() } else { sn };
        let (sn, cn, dn) = if self.is_odd() {
            let k1 = modulus.complementary();
            (cn.quotient(&dn), k1.product(&sn).quotient(&dn).opposite(), k1.quotient(&dn))
        } else {
            (sn, cn, dn)
        };
        let turned = self.quarters.rem_euclid(4.0) >= 2.0;
        if turned { Triple { sn: sn.opposite(), cn: cn.opposite(), dn } } else { Triple { sn, cn, dn } }
    }

    /// The amplitude.
    fn amplitude(&self, modulus: &Modulus<W>) -> W {
        let tangent = if self.is_odd() { modulus.complementary().product(&self.t) } else { self.t.clone() };
        let angle = arctangent(&tangent);
        let angle = if self.negative { angle.opposite() } else { angle };
        if self.quarters == 0.0 { angle } else { angle.sum(&angle.half_turn().by(0.5).by(self.quarters)) }
    }
}

/// The angle of this tangent: t R_C(1, 1 + t²).
fn arctangent<W: Arithmetic>(t: &W) -> W {
    t.product(&rc(&t.constant(1.0), &t.square().more(1.0)))
}

/// A function of u and k.
pub(super) fn evaluate<W: Arithmetic>(f: Elliptic, u: &W, modulus: &Modulus<W>) -> Outcome<W> {
    if modulus.m1.approx() < 0.0 {
        return reciprocal(f, u, modulus);
    }
    let point = reduced(u, modulus);
    let (mut lost, odd) = (point.absolute, point.is_odd());
    let value = match f {
        Elliptic::Am => {
            lost = 0.0;
            point.amplitude(modulus)
        }
        Elliptic::Sn => {
            lost = if odd { lost } else { point.relative };
            point.triple(modulus).sn
        }
        Elliptic::Cn => {
            lost = if odd { point.relative } else { lost };
            point.triple(modulus).cn
        }
        Elliptic::Dn => point.triple(modulus).dn,
        _ => square_integral(f, &point, modulus),
    };
    Outcome { value, lost }
}

/// ∫ sn² or ∫ sd² from 0 to u: whole half periods, and Carlson's R_D for the rest.
fn square_integral<W: Arithmetic>(f: Elliptic, point: &Reduced<W>, modulus: &Modulus<W>) -> W {
    let Triple { sn, cn, dn } = point.triple(modulus);
    // u = 2jK + r with |r| ≤ K.
    let odd = point.is_odd();
    let step = if point.negative { -1.0 } else { 1.0 };
    let halves = if odd { (point.quarters + step) / 2.0 } else { point.quarters / 2.0 };
    let negative = if odd { step > 0.0 } else { point.negative };
    let (size, one) = (sn.size(), sn.constant(1.0));
    let (cn2, dn2) = (cn.square(), dn.square());
    let third = if f == Elliptic::JacobiD { rd(&cn2, &dn2, &one) } else { rd(&cn2, &one, &dn2) };
    let part = size.product(&size.square()).product(&third).quotient(&sn.constant(3.0));
    let part = if negative { part.opposite() } else { part };
    if halves == 0.0 {
        return part;
    }
    let k1 = modulus.complementary();
    let p = if f == Elliptic::JacobiD { &one } else { &modulus.m1 };
    part.sum(&complete(&k1, p, &sn.constant(0.0), &one).by(2.0 * halves))
}

/// The functions of a modulus greater than one by those of 1/k (DLMF 22.17.2 to 22.17.4).
fn reciprocal<W: Arithmetic>(f: Elliptic, u: &W, modulus: &Modulus<W>) -> Outcome<W> {
    let k = &modulus.k;
    let m1 = modulus.m1.opposite().quotient(&k.square());
    let inverse = Modulus { k: k.constant(1.0).quotient(k), m1 };
    let scaled = u.product(k);
    let of = |f: Elliptic| evaluate(f, &scaled, &inverse);
    match f {
        Elliptic::Sn => of(Elliptic::Sn).map(|sn| sn.quotient(k)),
        Elliptic::Cn => of(Elliptic::Dn),
        Elliptic::Dn => of(Elliptic::Cn),
        Elliptic::Am => {
            let dn = of(Elliptic::Dn);
            let sn = of(Elliptic::Sn);
            let lost = sn.lost.max(dn.lost);
            Outcome { value: arctangent(&sn.value.quotient(k).quotient(&dn.value)), lost }
        }
        Elliptic::JacobiD => of(f).map(|d| d.quotient(&k.square().product(k))),
        // sd for k is sd/cn for 1/k, over k: its integral has a pole that is not reduced.
        _ => Outcome { value: u.undefined(), lost: 0.0 },
    }
}
