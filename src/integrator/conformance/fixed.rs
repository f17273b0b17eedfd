//! Methods with a given step.

use super::*;
use crate::integrator::{IntegrationError, integrate_fixed};
use crate::number::Df64;

/// The end of a motion in so many steps.
fn end<N: Number>(problem: &Problem, method: &mut dyn Method<N>, steps: usize, cx: &N::Context) -> Vec<N> {
    let h = N::from_f64(problem.until, cx).over(&N::from_f64(steps as f64, cx));
    integrate_fixed(method, (&N::zero(cx), &problem.start(cx)), &h, steps, |_, _| {}).unwrap()
}

/// The order that the errors show between some number of steps and twice as many, where they are small enough to show it.
fn measured_order(error: impl Fn(usize) -> f64, order: u32) -> (f64, usize) {
    let small = 10f64.powf(-4.0 - f64::from(order));
    let mut steps = 32;
    while error(steps) > small {
        steps *= 2;
        assert!(steps < 1 << 16, "the error stays above {small:e}");
    }
    ((error(steps) / error(2 * steps)).log2(), steps)
}

/// In double-double, so that rounding is far away.
#[test]
fn orders_are_measured_on_every_problem() {
    for problem in Problem::all() {
        let rates = problem.rates::<Df64>(&());
        let exact = problem.at(&Df64::from(problem.until));
        let count = methods(&rates, problem.start.len(), &()).len();
        for index in 0..count {
            let method = || methods(&rates, problem.start.len(), &()).swap_remove(index);
            let error = |steps| distance(&end(&problem, &mut *method(), steps, &()), &exact);
            let (name, claimed) = (method().name(), method().order());
            let (order, steps) = measured_order(error, claimed);
            println!("{name} on {}: order {order:.3} from {steps} steps on", problem.name);
            assert!((order - f64::from(claimed)).abs() < 0.35, "{name} on {}: {order}", problem.name);
        }
    }
}

/// Machine numbers and double-doubles take the same steps to the same state, to the rounding of the coarser ones.
#[test]
fn every_number_type_gives_the_same_answer() {
    for problem in Problem::all() {
        let (coarse, fine) = (problem.rates::<f64>(&()), problem.rates::<Df64>(&()));
        let n = problem.start.len();
        for (mut coarse, mut fine) in methods(&coarse, n, &()).into_iter().zip(methods(&fine, n, &())) {
            let y: Vec<Df64> = end(&problem, &mut *coarse, 256, &()).into_iter().map(Df64::from).collect();
            let difference = distance(&y, &end(&problem, &mut *fine, 256, &()));
            assert!(difference < 5e-14, "{} on {}: {difference:e}", fine.name(), problem.name);
        }
    }
}

/// Double-doubles and MPFR likewise; coefficients that are published in decimals have no more than 30 digits.
#[cfg(feature = "rug")]
#[test]
fn any_precision_gives_the_same_answer() {
    use crate::number::Mpfr;
    let bits = 160;
    for problem in Problem::all() {
        let (coarse, fine) = (problem.rates::<Df64>(&()), problem.rates::<Mpfr>(&bits));
        let n = problem.start.len();
        for (mut coarse, mut fine) in methods(&coarse, n, &()).into_iter().zip(methods(&fine, n, &bits)) {
            let widened = |x: Df64| Mpfr::from_f64(x.hi(), &bits).plus(&Mpfr::from_f64(x.lo(), &bits));
            let y: Vec<Mpfr> = end(&problem, &mut *coarse, 128, &()).into_iter().map(widened).collect();
            let difference = distance(&y, &end(&problem, &mut *fine, 128, &bits));
            assert!(difference < 1e-28, "{} on {}: {difference:e}", fine.name(), problem.name);
        }
    }
}

/// Forward and back by as many steps: symmetric methods return to the start, the others do not.
#[test]
fn symmetric_methods_are_reversible() {
    for problem in Problem::all() {
        let rates = problem.rates::<f64>(&());
        for mut method in methods(&rates, problem.start.len(), &()) {
            let (start, steps) = (problem.start::<f64>(&()), 20);
            let h = problem.until / 20.0;
            let there = integrate_fixed(&mut *method, (&0.0, &start), &h, steps, |_, _| {}).unwrap();
            let back = integrate_fixed(&mut *method, (&problem.until, &there), &-h, steps, |_, _| {}).unwrap();
            let error = distance(&back, &start);
            println!("{} on {}: back to {error:e}", method.name(), problem.name);
            let (symmetric, name) = (method.is_symmetric(), problem.name);
            assert!(if symmetric { error < 1e-13 } else { error > 1e-12 }, "{} on {name}: {error:e}", method.name());
        }
    }
}

/// The angular momentum of the orbit; length of the angular momentum and energy of the free body.
#[test]
fn gauss_legendre_keeps_quadratic_invariants() {
    type Invariant = fn(&[f64]) -> f64;
    let square = |y: &[f64]| y[0] * y[0] + y[1] * y[1] + y[2] * y[2];
    let energy = |y: &[f64]| y[0] * y[0] / 2.0 + y[1] * y[1] / 3.0 + y[2] * y[2] / 4.0;
    let area = |y: &[f64]| y[0] * y[3] - y[1] * y[2];
    let [kepler, _, euler, _] = Problem::all();
    let cases: [(&Problem, Invariant); 3] = [(&kepler, area), (&euler, square), (&euler, energy)];
    for (problem, invariant) in cases {
        let rates = problem.rates::<f64>(&());
        for (mut method, keeps) in
            methods(&rates, problem.start.len(), &()).into_iter().zip([false, false, true, true, true, true])
        {
            let (start, steps) = (problem.start::<f64>(&()), 2000);
            let (first, mut worst) = (invariant(&start), 0.0f64);
            let watch = |_: &f64, y: &crate::integrator::State<f64>| {
                worst = worst.max((invariant(y.value()) / first - 1.0).abs());
            };
            integrate_fixed(&mut *method, (&0.0, &start), &0.2, steps, watch).unwrap();
            println!("{} on {}: {worst:e}", method.name(), problem.name);
            // A random walk of 2000 steps, each with some units of its increments' last places.
            assert!(if keeps { worst < 5e-15 } else { worst > 1e-14 }, "{}: {worst:e}", method.name());
        }
    }
}

/// Fixed steps into a singularity end in an error, or beyond it: they never hang, and never panic.
#[test]
fn singularities_are_errors() {
    for problem in problems::singular() {
        let rates = problem.rates::<f64>(&());
        for mut method in methods(&rates, 1, &()) {
            let end = integrate_fixed(&mut *method, (&0.0, &[1.0]), &0.01, 200, |_, _| {});
            let implicit = method.name().starts_with("Gauss");
            match end {
                Err(IntegrationError::NotFinite { t } | IntegrationError::NoConvergence { t, .. }) => {
                    assert!((0.7..2.0).contains(&t), "{} on {}: {t}", method.name(), problem.name);
                }
                // What divides by a number near zero jumps over it.
                Ok(_) if problem.name == "division" && !implicit => {}
                other => panic!("{} on {}: {other:?}", method.name(), problem.name),
            }
        }
    }
}

/// The published digits of Dormand and Prince's method, some 30, let it reach 1e-27 and not the end of double-doubles.
#[test]
fn published_coefficients_serve_double_doubles() {
    for problem in Problem::all() {
        let rates = problem.rates::<Df64>(&());
        let exact = problem.at(&Df64::from(problem.until));
        let mut method = RungeKutta::new(&DORMAND_PRINCE_8, &rates, problem.start.len(), &());
        let error = distance(&end(&problem, &mut method, 16384, &()), &exact);
        println!("{} in 16384 steps: {error:e}", problem.name);
        assert!(error < 1e-27, "{}: {error:e}", problem.name);
    }
}
