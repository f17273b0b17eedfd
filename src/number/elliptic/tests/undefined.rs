//! Arguments at which there is no value, or that nobody would draw: no panic, no endless loop, nothing finite that is
//! wrong.

use super::*;
use crate::number::{Dual, Jet, Lanes, Tracked};

const ODD: [f64; 18] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    2.0,
    -2.0,
    0.5,
    1e-308,
    5e-324,
    -1e-200,
    1e200,
    f64::MAX,
    -f64::MAX,
    1e17,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::NAN,
    1.0 - f64::EPSILON,
];

/// Every combination of up to three odd arguments, and random ones of four.
fn all(mut see: impl FnMut(Elliptic, &[f64])) {
    let mut random = Random::new(31);
    for f in Elliptic::ALL {
        let count = ODD.len().pow(f.arity().min(3) as u32);
        for i in 0..count {
            let mut x: Vec<f64> = (0..f.arity()).map(|j| ODD[i / ODD.len().pow(j as u32) % ODD.len()]).collect();
            if f.arity() == 4 {
                x[3] = ODD[random.below(ODD.len())];
            }
            see(f, &x);
        }
    }
}

#[test]
fn machine_numbers() {
    let mut count = 0;
    all(|f, x| {
        let value = call(f, x);
        count += 1;
        let undefined = x.iter().any(|x| !x.is_finite());
        assert!(!(undefined && value.is_finite()), "{f:?} {x:?} = {value}");
        if f.modulus().is_none() && f != Rc && x.iter().any(|x| *x < 0.0) {
            assert!(!value.is_finite(), "{f:?} {x:?} = {value}");
        }
        let k = f.modulus().map_or(0.0, |i| x[i].abs());
        if (f.arity() == 1 || f == CompletePi) && (k > 1.0 || k == 1.0 && f != CompleteE) {
            assert!(!value.is_finite(), "{f:?} {x:?} = {value}");
        }
    });
    println!("{count} odd arguments");
    assert!(!call(CompletePi, &[1.0, 0.5]).is_finite() && !call(CompletePi, &[1.5, 0.5]).is_finite());
    assert!(!call(IncompletePi, &[1.0, 2.0, 0.5]).is_finite());
    assert!(call(IncompletePi, &[0.5, 2.0, 0.5]).is_finite());
    assert!(!call(Rf, &[0.0, 0.0, 1.0]).is_finite() && !call(Rc, &[1.0, 0.0]).is_finite());
    assert!(!call(IncompleteF, &[1.6, 1.0]).is_finite() && !call(IncompleteF, &[0.7, 2.0]).is_finite());
    assert!(!call(Sn, &[1e17, 0.5]).is_finite(), "beyond 2^52 quarter periods");
    assert_eq!(call(CompleteE, &[1.0]), 1.0);
    assert_eq!(call(Sn, &[800.0, 1.0]), 1.0);
    assert_eq!(call(Cn, &[800.0, 1.0]), 0.0);
}

#[test]
fn other_numbers() {
    all(|f, x| {
        if x.iter().filter(|x| x.abs() == 2.0).count() > 0 {
            return; // fewer of them: these are slower
        }
        let double: Vec<Df64> = x.iter().map(|x| Df64::from(*x)).collect();
        call(f, &double);
        #[cfg(feature = "rug")]
        {
            use crate::number::Mpfr;
            let any: Vec<Mpfr> = x.iter().map(|x| Mpfr::from_f64(*x, &60)).collect();
            let value = call(f, &any);
            let machine = call(f, x);
            let tame = machine != 0.0 && machine.abs() > 1e-290 && machine.is_finite() && value.is_finite();
            assert!(!tame || (value.to_f64() / machine - 1.0).abs() < 1e-15, "{f:?} {x:?}: {value:?} {machine}");
        }
    });
    for f in Elliptic::ALL {
        let x = [0.3, 0.4, 0.5, 0.6];
        let machine = call(f, &x[..f.arity()]);
        let lanes: Vec<Lanes<4>> = x.iter().take(f.arity()).map(|x| Lanes([*x, f64::NAN, *x, -1e300])).collect();
        let got = call(f, &lanes);
        assert!(got.0[0] == machine && got.0[2] == machine && !got.0[1].is_finite());
        let nan: Vec<Tracked<f64>> = x.iter().take(f.arity()).map(|_| Tracked::exact(f64::NAN)).collect();
        assert_eq!(call(f, &nan).error_log2(), f64::INFINITY);
        let dual: Vec<Dual<f64>> = x.iter().take(f.arity()).map(|x| Dual::new(*x, f64::NAN)).collect();
        assert!(!call(f, &dual).is_finite());
        let jet: Vec<Jet<f64>> = x.iter().take(f.arity()).map(|_| Jet::new(f64::NAN, [1.0, 2.0])).collect();
        assert!(!call(f, &jet).is_finite());
    }
}

/// Intervals have no elliptic functions: nothing is known of them.
#[cfg(feature = "rug")]
#[test]
fn intervals_know_nothing() {
    use crate::number::Interval;
    let x = [0.3, 0.4, 0.5, 0.6].map(|x| Interval::from_f64(x, &80));
    for f in Elliptic::ALL {
        assert!(!call(f, &x[..f.arity()]).is_bounded());
    }
}

/// Calls with too few arguments.
#[test]
fn too_few_arguments() {
    let mut value = 1.0;
    for f in Elliptic::ALL {
        value.set_elliptic(f, &[]);
        assert!(!value.is_finite());
        let mut double = Df64::from(1.0);
        double.set_elliptic(f, &[]);
        assert!(!Number::is_finite(&double));
        let mut dual = Dual::constant(1.0);
        dual.set_elliptic(f, &[]);
        assert!(!dual.is_finite());
    }
}
