//! Every integral against its definition, by quadrature in double-doubles; Jacobi's functions against their inverse.

use super::*;
use crate::number::quadrature::{LEVELS, Sample, integrate};

fn n(x: f64) -> Df64 {
    Df64::from(x)
}

/// Δ² = 1 - k² sin².
fn delta2(s2: &Df64, k: &Df64) -> Df64 {
    n(1.0) - *k * *k * *s2
}

/// The integral of f as it is defined.
fn by_definition(f: Elliptic, x: &[Df64]) -> (Df64, f64) {
    let half_pi = Df64::pi(&()) * n(0.5);
    let k = x[x.len() - 1];
    let upper = if f.arity() == 1 || f == CompletePi { half_pi } else { x[0] };
    let legendre = |sample: &Sample<Df64>| {
        let s = sample.x.apply(Func::Sin);
        let (s2, d2) = (s * s, delta2(&(s * s), &k));
        let d = d2.root();
        match f {
            CompleteK | IncompleteF => n(1.0) / d,
            CompleteE | IncompleteE => d,
            CompleteD | IncompleteD => s2 / d,
            CompleteG | IncompleteG => s2 / (d * d2),
            _ => n(1.0) / ((n(1.0) - x[x.len() - 2] * s2) * d),
        }
    };
    // From 0 to ∞: t = s/(1 - s).
    let carlson = |sample: &Sample<Df64>| {
        let t = sample.above / sample.below;
        let root = |x: Df64| (t + x).root();
        let jacobian = n(1.0) / (sample.below * sample.below);
        let integrand = match f {
            Rc => n(0.5) / (root(x[0]) * (t + x[1])),
            Rf => n(0.5) / (root(x[0]) * root(x[1]) * root(x[2])),
            Rd => n(1.5) / (root(x[0]) * root(x[1]) * root(x[2]) * (t + x[2])),
            _ => n(1.5) / (root(x[0]) * root(x[1]) * root(x[2]) * (t + x[3])),
        };
        integrand * jacobian
    };
    let integral = match f.modulus() {
        Some(_) => integrate(&n(0.0), &upper, LEVELS, legendre),
        None => integrate(&n(0.0), &n(1.0), LEVELS, carlson),
    };
    (integral.value, integral.error_log2)
}

#[test]
fn integrals_are_as_defined() {
    let mut random = Random::new(21);
    for f in Elliptic::ALL.into_iter().filter(|f| !f.is_jacobi()) {
        let mut worst = f64::NEG_INFINITY;
        for _ in 0..12 {
            let [a, b, c, d] = [(); 4].map(|()| random.within(0.05, 0.95));
            let x = match f {
                _ if f.arity() == 1 => vec![a],
                CompletePi => vec![2.0 * a - 1.2, b],
                IncompletePi => vec![8.0 * a - 4.0, 2.0 * b - 1.2, c],
                _ if f.modulus().is_some() => vec![8.0 * a - 4.0, b],
                _ => vec![3.0 * a, b, 2.0 * c, d],
            };
            let x: Vec<Df64> = x.into_iter().take(f.arity()).map(n).collect();
            let (expect, error) = by_definition(f, &x);
            let off = (call(f, &x) - expect).log2_abs();
            assert!(off <= error && error < -60.0, "{f:?} {x:?}: 2^{off} of 2^{error}");
            worst = worst.max(off);
        }
        println!("{f:?}: within 2^{worst:.1} of its definition");
    }
}

/// ∫₀^u: sn, cn, dn and am from u = F(am), and their integrals.
#[test]
fn jacobi_functions_invert_the_first_kind() {
    let mut random = Random::new(22);
    let close = |a: Df64, b: Df64, what: &str| {
        let off = (a - b).log2_abs() - b.log2_abs().max(0.0);
        assert!(off < -95.0, "{what}: {a:?} {b:?}");
    };
    for _ in 0..200 {
        let (u, k) = (n(random.within(-9.0, 9.0)), n(random.within(0.01, 0.99)));
        let am = call(Am, &[u, k]);
        close(call(IncompleteF, &[am, k]), u, "F(am u)");
        close(call(Sn, &[u, k]), am.apply(Func::Sin), "sn");
        close(call(Cn, &[u, k]), am.apply(Func::Cos), "cn");
        close(call(Dn, &[u, k]), delta2(&am.apply(Func::Sin).to_the(2), &k).root(), "dn");
        close(call(JacobiD, &[u, k]), call(IncompleteD, &[am, k]), "∫sn²");
        close(call(JacobiG, &[u, k]), call(IncompleteG, &[am, k]), "∫sd²");
        // A modulus greater than one, by its definition: sn(u, 1/k) = k sn(u/k, k).
        close(call(Sn, &[u, n(1.0) / k]), k * call(Sn, &[u / k, k]), "reciprocal modulus");
    }
}

#[test]
fn values_of_the_literature() {
    // DLMF and Abramowitz and Stegun, table 17.1: K(m = 1/2) = 1.85407 46773 01371 92, E = 1.35064 38810 47675 50;
    // Γ(1/4)²/(4√π).
    let k = n(0.5).root();
    assert_eq!(call(CompleteK, &[k]).to_decimal(18), "1.85407467730137192");
    assert_eq!(call(CompleteE, &[k]).to_decimal(18), "1.3506438810476755");
    // Carlson 1995, section 3: R_F(1, 2, 0), R_F(2, 3, 4), R_C(0, 1/4), R_C(1/4, -2), R_D(0, 2, 1), R_D(2, 3, 4),
    // R_J(0, 1, 2, 3), R_J(2, 3, 4, 5).
    for (f, x, text) in [
        (Rf, vec![1.0, 2.0, 0.0], "1.3110287771461"),
        (Rf, vec![2.0, 3.0, 4.0], "0.58408284167715"),
        (Rc, vec![0.0, 0.25], "3.1415926535898"),
        (Rc, vec![0.25, -2.0], "0.23104906018665"),
        (Rd, vec![0.0, 2.0, 1.0], "1.7972103521034"),
        (Rd, vec![2.0, 3.0, 4.0], "0.16510527294261"),
        (Rj, vec![0.0, 1.0, 2.0, 3.0], "0.77688623778582"),
        (Rj, vec![2.0, 3.0, 4.0, 5.0], "0.14297579667157"),
    ] {
        let x: Vec<Df64> = x.into_iter().map(n).collect();
        assert_eq!(call(f, &x).to_decimal(14), text, "{f:?} {x:?}");
    }
}

/// MPFR's own arithmetic-geometric mean.
#[cfg(feature = "rug")]
#[test]
fn quarter_periods_by_mpfr() {
    use crate::number::Mpfr;
    use rug::Float;
    let mut random = Random::new(23);
    for bits in [53, 300, 2000] {
        for _ in 0..50 {
            let k = Mpfr(Float::with_val(bits, random.within(0.0, 1.0)));
            let wide = Float::with_val(bits + 100, &k.0);
            let k1 = Float::with_val(bits + 100, 1 - wide.square()).sqrt();
            let expect = Float::with_val(bits + 100, rug::float::Constant::Pi)
                / (Float::with_val(bits + 100, 2) * Float::with_val(bits + 100, 1).agm(&k1));
            let off = Mpfr(Float::with_val(bits + 100, &call(CompleteK, &[k]).0 - &expect)).log2_abs();
            assert!(off < 3.0 - f64::from(bits), "{off} of {bits}");
        }
    }
}
