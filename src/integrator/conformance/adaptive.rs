//! Methods that choose their steps: Dormand and Prince's pair, and Taylor series.

use super::*;
use crate::integrator::taylor::Taylor;
use crate::integrator::{Adaptive, IntegrationError};
use crate::number::Df64;

/// The global error that is allowed for each step, in units of the tolerance. A step's own error is below the tolerance, and the
/// problems here let it grow some times over on the way.
const MULTIPLE: f64 = 3.0;

/// The largest error, at the end or inside a step, for each step taken.
fn by_pair<N: Number>(problem: &Problem, tolerance: f64, cx: &N::Context) -> f64 {
    let (rates, t1) = (problem.rates::<N>(cx), N::from_f64(problem.until, cx));
    let mut worst = 0.0f64;
    let driver = Adaptive::with_tolerance(tolerance);
    let outcome = driver.integrate(&rates, (&N::zero(cx), &problem.start(cx)), &t1, |mut step| {
        let length = step.t1.minus(step.t0);
        let mut inner = step.y0.to_vec();
        for share in [0.0, 0.37, 0.81, 1.0] {
            let s = length.times(&N::from_f64(share, cx));
            step.at(&s, &mut inner);
            worst = worst.max(distance(&inner, &problem.at(&step.t0.plus(&s))));
        }
    });
    let outcome = outcome.unwrap();
    let error = distance(&outcome.y, &problem.at(&t1));
    println!("{} pair {tolerance:e}: {error:e}, inside {worst:e}, {} steps", problem.name, outcome.accepted);
    worst.max(error) / outcome.accepted as f64
}

/// Likewise by Taylor series.
fn by_series<N: Number>(problem: &Problem, tolerance: f64, cx: &N::Context) -> f64 {
    let (series, t1) = (problem.series(), N::from_f64(problem.until, cx));
    let mut worst = 0.0f64;
    let taylor = Taylor::with_tolerance(tolerance);
    let outcome = taylor.integrate(&series, &[], (&N::zero(cx), &problem.start(cx)), &t1, |step| {
        for share in [0.0, 0.37, 0.81, 1.0] {
            let s = step.h.times(&N::from_f64(share, cx));
            let inner: Vec<N> = (0..step.dimension()).map(|i| step.at(i, &s)).collect();
            worst = worst.max(distance(&inner, &problem.at(&step.t0.plus(&s))));
        }
    });
    let outcome = outcome.unwrap();
    let error = distance(&outcome.y, &problem.at(&t1));
    println!("{} series {tolerance:e}: {error:e}, inside {worst:e}, {} steps", problem.name, outcome.steps);
    worst.max(error) / outcome.steps as f64
}

/// The global error of either method is at most three times the tolerance for every step, at the end and inside the steps.
#[test]
fn errors_stay_within_a_multiple_of_the_tolerance() {
    for problem in Problem::all() {
        for tolerance in [1e-5, 1e-8, 1e-11, 1e-13] {
            for error in [by_pair::<f64>(&problem, tolerance, &()), by_series::<f64>(&problem, tolerance, &())] {
                assert!(error < MULTIPLE * tolerance, "{}: {error:e} at {tolerance:e}", problem.name);
            }
        }
        // An order of 8 takes many steps for many digits.
        for tolerance in [1e-16, 1e-19] {
            let error = by_pair::<Df64>(&problem, tolerance, &());
            assert!(error < MULTIPLE * tolerance, "{}: {error:e} at {tolerance:e}", problem.name);
        }
        for tolerance in [1e-20, 1e-28] {
            let error = by_series::<Df64>(&problem, tolerance, &());
            assert!(error < MULTIPLE * tolerance, "{}: {error:e} at {tolerance:e}", problem.name);
        }
    }
}

#[cfg(feature = "rug")]
#[test]
fn series_of_256_bits_reach_sixty_digits() {
    use crate::number::Mpfr;
    for problem in Problem::all() {
        let error = by_series::<Mpfr>(&problem, 1e-65, &256);
        assert!(error < 1e-60, "{}: {error:e}", problem.name);
    }
}

#[test]
fn they_run_backward_to_where_they_began_and_end_exactly() {
    for problem in Problem::all() {
        let (rates, series, start) = (problem.rates::<f64>(&()), problem.series(), problem.start::<f64>(&()));
        let pair = Adaptive::with_tolerance(1e-13);
        let mut last = 0.0;
        let there = pair.integrate(&rates, (&0.0, &start), &problem.until, |s| last = *s.t1).unwrap();
        assert_eq!(last, problem.until);
        let back = pair.integrate(&rates, (&problem.until, &there.y), &0.0, |s| last = *s.t1).unwrap();
        assert_eq!(last, 0.0);
        assert!(distance(&back.y, &start) < 1e-11, "{}", problem.name);
        let taylor = Taylor::with_tolerance(1e-16);
        let there = taylor.integrate(&series, &[], (&0.0, &start), &problem.until, |_| {}).unwrap();
        let back = taylor.integrate(&series, &[], (&problem.until, &there.y), &0.0, |_| {}).unwrap();
        assert!(distance(&back.y, &start) < 1e-14, "{}", problem.name);
    }
}

#[test]
fn steps_join_without_gaps() {
    let [problem, ..] = Problem::all();
    let (rates, start) = (problem.rates::<f64>(&()), problem.start::<f64>(&()));
    let mut end = (0.0, start.clone());
    let driver = Adaptive::with_tolerance(1e-9);
    let outcome = driver.integrate(&rates, (&0.0, &start), &10.0, |s| {
        assert_eq!((*s.t0, s.y0), (end.0, &end.1[..]));
        end = (*s.t1, s.y1.to_vec());
    });
    assert_eq!((10.0, outcome.unwrap().y), end);
}

#[test]
fn a_constant_state_costs_few_steps_and_no_time_costs_none() {
    let still = |_: &f64, _: &[f64], slope: &mut [f64]| slope.fill(0.0);
    let driver = Adaptive::with_tolerance(1e-12);
    let end = driver.integrate(&still, (&0.0, &[3.0, 3.0]), &1e3, |_| {}).unwrap();
    assert_eq!(end.y, [3.0, 3.0]);
    assert!(end.accepted < 20, "{}", end.accepted);
    assert_eq!(driver.integrate(&still, (&1.0, &[3.0]), &1.0, |_| {}).unwrap().accepted, 0);
}

#[test]
fn singularities_are_errors_with_their_time() {
    for problem in problems::singular() {
        let (rates, series) = (problem.rates::<f64>(&()), problem.series());
        let pair = Adaptive::with_tolerance(1e-10).integrate(&rates, (&0.0, &[1.0]), &2.0, |_| {}).map(|_| ());
        let taylor = Taylor::with_tolerance(1e-10).integrate(&series, &[], (&0.0, &[1.0]), &2.0, |_| {}).map(|_| ());
        for end in [pair, taylor] {
            let time = match end {
                Err(
                    IntegrationError::StepTooShort { t, .. }
                    | IntegrationError::TooManySteps { t, .. }
                    | IntegrationError::NotFinite { t },
                ) => t,
                other => panic!("{}: {other:?}", problem.name),
            };
            assert!((time - 1.0).abs() < 1e-4, "{} ends at 1, not at {time}", problem.name);
        }
    }
    let [kepler, ..] = Problem::all();
    let few = Adaptive { max_steps: 3, ..Adaptive::with_tolerance(1e-10) };
    let end = few.integrate(&kepler.rates::<f64>(&()), (&0.0, &kepler.start::<f64>(&())), &100.0, |_| {});
    assert!(matches!(end, Err(IntegrationError::TooManySteps { steps: 3, .. })));
}
