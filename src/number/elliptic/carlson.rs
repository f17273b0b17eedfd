//! Carlson's symmetric integrals by duplication: B. C. Carlson, "Numerical computation of real or complex elliptic
//! integrals", Numer. Algorithms 10 (1995) 13-26; DLMF 19.36(i), with the expansions up to the seventh degree.
//!
//! Each duplication brings the arguments four times nearer to each other, and no step subtracts: what the arguments'
//! own precision allows is kept.

use super::arithmetic::Arithmetic;

/// Doublings that no arguments of a practical size need, beyond those that the precision asks for.
const EXTRA_STEPS: u32 = 4000;

/// Whether arguments that were at most `2^spread` from their mean are near enough to it after `step` duplications for
/// an expansion whose error is of the eighth order.
fn is_near<W: Arithmetic>(mean: &W, spread: f64, step: u32) -> bool {
    spread - 2.0 * f64::from(step) <= mean.log2_size() - f64::from(mean.bits()) / 8.0 - 1.0
}

/// The number of duplications after which nothing is to be expected any more.
fn most_steps<W: Arithmetic>(x: &W) -> u32 {
    EXTRA_STEPS + x.bits() / 8
}

/// log₂ of the largest distance from the mean.
fn spread<W: Arithmetic>(mean: &W, xs: &[&W]) -> f64 {
    xs.iter().fold(f64::NEG_INFINITY, |most, x| most.max(mean.difference(x).log2_size()))
}

/// 1 + Σ cᵢ xᵢ / divisor.
fn series<W: Arithmetic, const N: usize>(divisor: f64, terms: [(f64, &W); N], one: &W) -> W {
    let sum = terms.iter().fold(one.constant(0.0), |sum, (c, x)| sum.sum(&x.by(*c)));
    sum.quotient(&one.constant(divisor)).more(1.0)
}

fn sign<W: Arithmetic>(x: &W) -> f64 {
    if x.log2_size() == f64::NEG_INFINITY { 0.0 } else { x.approx() }
}

/// Whether the first three arguments are not negative, and at most one of them is zero.
fn are_defined<W: Arithmetic>(xs: [&W; 3]) -> bool {
    let signs = xs.map(sign);
    signs.iter().all(|s| *s >= 0.0) && signs.iter().filter(|s| **s == 0.0).count() <= 1
}

/// R_F(x, y, z) of arguments that are not negative, at most one of them zero; otherwise not finite.
pub(super) fn rf<W: Arithmetic>(x: &W, y: &W, z: &W) -> W {
    let [mut x, mut y, mut z] = [x.clone(), y.clone(), z.clone()];
    if !are_defined([&x, &y, &z]) {
        return x.undefined();
    }
    let third = x.constant(3.0);
    let mean = |x: &W, y: &W, z: &W| x.sum(y).sum(z).quotient(&third);
    let mut a = mean(&x, &y, &z);
    let spread = spread(&a, &[&x, &y, &z]);
    for step in 0..most_steps(&x) {
        if is_near(&a, spread, step) {
            return expanded_rf(&a, &x, &y);
        }
        let [rx, ry, rz] = [x.square_root(), y.square_root(), z.square_root()];
        let lambda = rx.product(&ry.sum(&rz)).sum(&ry.product(&rz));
        [x, y, z] = [&x, &y, &z].map(|x| x.sum(&lambda).by(0.25));
        a = a.sum(&lambda).by(0.25);
    }
    x.undefined()
}

/// R_F of arguments near their mean `a` (DLMF 19.36.1).
fn expanded_rf<W: Arithmetic>(a: &W, x: &W, y: &W) -> W {
    let [dx, dy] = [x, y].map(|x| a.difference(x).quotient(a));
    let dz = dx.sum(&dy);
    let e2 = dx.product(&dy).difference(&dz.square());
    let e3 = dx.product(&dy).product(&dz).opposite();
    let (e22, e23) = (e2.square(), e2.product(&e3));
    let terms = [
        (-24_024.0, &e2),
        (17_160.0, &e3),
        (10_010.0, &e22),
        (-16_380.0, &e23),
        (-5_775.0, &e22.product(&e2)),
        (6_930.0, &e3.square()),
        (15_015.0, &e22.product(&e3)),
    ];
    series(240_240.0, terms, a).quotient(&a.square_root())
}

/// R_C(x, y) of x ≥ 0 and y ≠ 0; its principal value where y is negative (DLMF 19.2.20).
pub(super) fn rc<W: Arithmetic>(x: &W, y: &W) -> W {
    let defined = sign(x) >= 0.0 && sign(y) != 0.0 && !sign(y).is_nan();
    if !defined {
        return x.undefined();
    }
    if sign(y) < 0.0 {
        let shifted = x.difference(y);
        return x.quotient(&shifted).square_root().product(&rc(&shifted, &y.opposite()));
    }
    let (mut x, mut y) = (x.clone(), y.clone());
    let mut a = x.sum(&y).sum(&y).quotient(&x.constant(3.0));
    let spread = spread(&a, &[&x, &y]);
    for step in 0..most_steps(&x) {
        if is_near(&a, spread, step) {
            return expanded_rc(&a, &y);
        }
        let lambda = x.square_root().product(&y.square_root()).by(2.0).sum(&y);
        [x, y] = [&x, &y].map(|x| x.sum(&lambda).by(0.25));
        a = a.sum(&lambda).by(0.25);
    }
    x.undefined()
}

/// R_C of arguments near their mean `a` (Carlson 1995, (2.17), with two more terms).
fn expanded_rc<W: Arithmetic>(a: &W, y: &W) -> W {
    let s = y.difference(a).quotient(a);
    let (s2, s3) = (s.square(), s.square().product(&s));
    let (s4, s5) = (s2.square(), s2.product(&s3));
    let terms = [
        (24_024.0, &s2),
        (11_440.0, &s3),
        (30_030.0, &s4),
        (32_760.0, &s5),
        (61_215.0, &s3.square()),
        (90_090.0, &s3.product(&s4)),
    ];
    series(80_080.0, terms, a).quotient(&a.square_root())
}

/// R_D(x, y, z) of x and y that are not negative, at most one of them zero, and a positive z; otherwise not finite.
pub(super) fn rd<W: Arithmetic>(x: &W, y: &W, z: &W) -> W {
    third_kind(x, y, z, None)
}

/// R_J(x, y, z, p) of x, y and z that are not negative, at most one of them zero, and a positive p; otherwise not
/// finite.
pub(super) fn rj<W: Arithmetic>(x: &W, y: &W, z: &W, p: &W) -> W {
    third_kind(x, y, z, Some(p))
}

/// R_J(x, y, z, p), or R_D(x, y, z) = R_J(x, y, z, z) where no p is given.
fn third_kind<W: Arithmetic>(x: &W, y: &W, z: &W, p: Option<&W>) -> W {
    let degenerate = p.is_none();
    let [mut x, mut y, mut z, mut p] = [x.clone(), y.clone(), z.clone(), p.unwrap_or(z).clone()];
    let defined = are_defined([&x, &y, &z]) && sign(&p) > 0.0;
    if !defined {
        return x.undefined();
    }
    let mut a = x.sum(&y).sum(&z).sum(&p).sum(&p).quotient(&x.constant(5.0));
    let spread = spread(&a, &[&x, &y, &z, &p]);
    let mut quarter = x.constant(1.0); // 4^-step
    let mut sum = x.constant(0.0);
    for step in 0..most_steps(&x) {
        if is_near(&a, spread, step) {
            let rest = expanded_rj(&a, [&x, &y, &z], &p).product(&quarter);
            return rest.sum(&sum.by(6.0));
        }
        let [rx, ry, rz] = [x.square_root(), y.square_root(), z.square_root()];
        let rp = if degenerate { rz.clone() } else { p.square_root() };
        let lambda = rx.product(&ry.sum(&rz)).sum(&ry.product(&rz));
        let d = rp.sum(&rx).product(&rp.sum(&ry)).product(&rp.sum(&rz));
        let mut term = quarter.quotient(&d);
        if !degenerate {
            // 1 + e = 2√p (p + √x√y + √y√z + √z√x)/d, where Carlson's e itself would cancel.
            let one_more = rp.by(2.0).product(&p.sum(&lambda)).quotient(&d);
            term = term.product(&rc(&x.constant(1.0), &one_more));
        }
        sum = sum.sum(&term);
        quarter = quarter.by(0.25);
        [x, y, z, p] = [&x, &y, &z, &p].map(|x| x.sum(&lambda).by(0.25));
        a = a.sum(&lambda).by(0.25);
    }
    x.undefined()
}

/// R_J of arguments near their mean `a` (DLMF 19.36.2).
fn expanded_rj<W: Arithmetic>(a: &W, x: [&W; 3], p: &W) -> W {
    let [dx, dy, dz] = x.map(|x| a.difference(x).quotient(a));
    let dp = a.difference(p).quotient(a);
    let product = dx.product(&dy).product(&dz);
    let dp2 = dp.square();
    let pairs = dx.product(&dy.sum(&dz)).sum(&dy.product(&dz));
    let e2 = pairs.difference(&dp2.by(3.0));
    let e3 = product.sum(&e2.product(&dp).by(2.0)).sum(&dp2.product(&dp).by(4.0));
    let e4 = product.by(2.0).sum(&e2.product(&dp)).sum(&dp2.product(&dp).by(3.0)).product(&dp);
    let e5 = product.product(&dp2);
    let e22 = e2.square();
    let terms = [
        (-875_160.0, &e2),
        (680_680.0, &e3),
        (417_690.0, &e22),
        (-556_920.0, &e4),
        (-706_860.0, &e2.product(&e3)),
        (471_240.0, &e5),
        (-255_255.0, &e22.product(&e2)),
        (306_306.0, &e3.square()),
        (612_612.0, &e2.product(&e4)),
        (675_675.0, &e22.product(&e3)),
        (-540_540.0, &e3.product(&e4).sum(&e2.product(&e5))),
    ];
    series(4_084_080.0, terms, a).quotient(&a.product(&a.square_root()))
}
