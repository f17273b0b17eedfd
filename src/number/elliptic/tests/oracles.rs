//! Other implementations, in machine numbers: the crates `ellip` and `spec_math`, whose parameter is m = k². The moduli
//! here have squares that are machine numbers. Where one of them differs, `accuracy` and `definitions` say who is
//! right.

use super::*;

/// The worst difference of two implementations, in units in the last place.
#[derive(Default)]
struct Worst {
    units: f64,
    at: String,
}

impl Worst {
    fn see(&mut self, got: f64, other: f64, at: impl FnOnce() -> String) {
        let units = (got - other).abs() / (got.abs() * f64::EPSILON);
        if units > self.units {
            *self = Worst { units, at: at() };
        }
    }
}

fn modulus(random: &mut Random) -> f64 {
    random.within(1.0, 1_048_575.0).round() / 1_048_576.0
}

/// Compares on 4000 arguments; `bound` is what the other implementation may be off, in units in the last place.
fn compare(
    name: &str,
    f: Elliptic,
    bound: f64,
    arguments: impl Fn(&mut Random) -> Vec<f64>,
    other: impl Fn(&[f64]) -> f64,
) {
    let mut random = Random::new(41);
    let mut worst = Worst::default();
    for _ in 0..4000 {
        let x = arguments(&mut random);
        let (got, expect) = (call(f, &x), other(&x));
        worst.see(got, expect, || format!("{x:?}: {got:e}, {expect:e}"));
    }
    println!("{name:9} {f:?}: {:.1} units of {bound} at {}", worst.units, worst.at);
    assert!(worst.units <= bound, "{name} {f:?}: {} at {}", worst.units, worst.at);
}

fn carlson(random: &mut Random) -> Vec<f64> {
    (0..4).map(|_| random.wide(6.0).abs()).collect()
}

fn phi_k(random: &mut Random) -> Vec<f64> {
    vec![random.within(-1.5, 1.5), modulus(random)]
}

#[test]
fn ellip() {
    use ::ellip::*;
    let two = |random: &mut Random| vec![random.within(-2.0, 0.98), modulus(random)];
    let three = |random: &mut Random| vec![random.within(-1.5, 1.5), random.within(-2.0, 0.98), modulus(random)];
    // Its polynomials lose up to some 20 units next to k = 0.949: MPFR's own mean is on our side (`definitions`).
    compare("ellip", CompleteK, 32.0, |r| vec![modulus(r)], |x| ellipk(x[0] * x[0]).unwrap());
    compare("ellip", CompleteE, 8.0, |r| vec![modulus(r)], |x| ellipe(x[0] * x[0]).unwrap());
    compare("ellip", CompleteD, 16.0, |r| vec![modulus(r)], |x| ellipd(x[0] * x[0]).unwrap());
    compare("ellip", CompletePi, 32.0, two, |x| ellippi(x[0], x[1] * x[1]).unwrap());
    compare("ellip", IncompleteF, 64.0, phi_k, |x| ellipf(x[0], x[1] * x[1]).unwrap());
    compare("ellip", IncompleteE, 64.0, phi_k, |x| ellipeinc(x[0], x[1] * x[1]).unwrap());
    compare("ellip", IncompleteD, 64.0, phi_k, |x| ellipdinc(x[0], x[1] * x[1]).unwrap());
    compare("ellip", IncompletePi, 256.0, three, |x| ellippiinc(x[0], x[1], x[2] * x[2]).unwrap());
    compare("ellip", Rc, 16.0, |r| carlson(r)[..2].to_vec(), |x| elliprc(x[0], x[1]).unwrap());
    compare("ellip", Rf, 16.0, |r| carlson(r)[..3].to_vec(), |x| elliprf(x[0], x[1], x[2]).unwrap());
    compare("ellip", Rd, 32.0, |r| carlson(r)[..3].to_vec(), |x| elliprd(x[0], x[1], x[2]).unwrap());
    compare("ellip", Rj, 64.0, carlson, |x| elliprj(x[0], x[1], x[2], x[3]).unwrap());
}

#[test]
fn spec_math() {
    use ::spec_math::cephes64::{ellie, ellik, ellpe, ellpj, ellpk};
    use ::spec_math::misc::{ellippi, elliprc, elliprd, elliprf, elliprj};
    // What Cephes loses is absolute: sn, cn and dn within these units of 1 (its own documentation says 4e-16 to 3e-15).
    let jacobi = |f: Elliptic, take: fn((f64, f64, f64, f64)) -> f64| {
        let mut random = Random::new(42);
        let mut worst = Worst::default();
        for _ in 0..4000 {
            let (u, k) = (random.within(-10.0, 10.0), modulus(&mut random));
            let (got, expect) = (call(f, &[u, k]), take(ellpj(u, k * k)));
            worst.see(1.0, 1.0 + (got - expect), || format!("{u} {k}: {got:e}, {expect:e}"));
        }
        println!("spec_math {f:?}: {:.1} units of 1 at {}", worst.units, worst.at);
        assert!(worst.units < 64.0, "{f:?}: {} at {}", worst.units, worst.at);
    };
    jacobi(Sn, |x| x.0);
    jacobi(Cn, |x| x.1);
    jacobi(Dn, |x| x.2);
    jacobi(Am, |x| x.3);
    compare("spec_math", CompleteK, 16.0, |r| vec![modulus(r)], |x| ellpk(1.0 - x[0] * x[0])); // of m1
    compare("spec_math", CompleteE, 16.0, |r| vec![modulus(r)], |x| ellpe(x[0] * x[0]));
    compare("spec_math", IncompleteF, 64.0, phi_k, |x| ellik(x[0], x[1] * x[1]));
    compare("spec_math", IncompleteE, 64.0, phi_k, |x| ellie(x[0], x[1] * x[1]));
    let two = |random: &mut Random| vec![random.within(-2.0, 0.98), modulus(random)];
    compare("spec_math", CompletePi, 64.0, two, |x| ellippi(x[0], x[1] * x[1]));
    compare("spec_math", Rc, 64.0, |r| carlson(r)[..2].to_vec(), |x| elliprc(x[0], x[1]));
    compare("spec_math", Rf, 64.0, |r| carlson(r)[..3].to_vec(), |x| elliprf(x[0], x[1], x[2]));
    compare("spec_math", Rd, 64.0, |r| carlson(r)[..3].to_vec(), |x| elliprd(x[0], x[1], x[2]));
    compare("spec_math", Rj, 64.0, carlson, |x| elliprj(x[0], x[1], x[2], x[3]));
}
