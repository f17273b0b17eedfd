//! Dormand and Prince's 8(5,3) pair with the step chosen by the tolerance.
//!
//! Error estimate, step control and first step after Hairer, Norsett and Wanner, *Solving Ordinary Differential
//! Equations I*, sections II.4 and II.10.

use super::dormand_prince::{ERROR_3, ERROR_5};
use super::{DORMAND_PRINCE_8, IntegrationError, RungeKutta, System};
use nalgebra::DVector;

/// An adaptive integration: each step's estimated error in component i stays below
/// `absolute + relative * |y_i|`, in the root mean square over the components.
#[derive(Clone, Copy, Debug)]
pub struct Adaptive {
    /// The relative tolerance.
    pub relative: f64,
    /// The absolute tolerance, in the units of the state.
    pub absolute: f64,
    /// The most steps to take, refused ones included.
    pub max_steps: usize,
}

/// An accepted step, as an observer sees it.
#[derive(Debug)]
pub struct Step<'a> {
    /// The time at its beginning.
    pub t0: f64,
    /// The state at its beginning.
    pub y0: &'a DVector<f64>,
    /// The time at its end.
    pub t1: f64,
    /// The state at its end.
    pub y1: &'a DVector<f64>,
}

/// Where an integration arrived and what it cost.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// The last state.
    pub y: DVector<f64>,
    /// The accepted steps.
    pub accepted: usize,
    /// The refused steps.
    pub refused: usize,
}

/// By how much a step may shrink or grow at once, and the margin by which it stays below the longest that would do.
const SHRINK: f64 = 1.0 / 3.0;
const GROW: f64 = 6.0;
const MARGIN: f64 = 0.9;

impl Adaptive {
    /// The same tolerance, relative and absolute, and a million steps.
    pub fn with_tolerance(tolerance: f64) -> Self {
        Adaptive { relative: tolerance, absolute: tolerance, max_steps: 1_000_000 }
    }

    /// Integrates from `(t0, y0)` to `t1`, forward or backward, and shows each accepted step to `observe`.
    ///
    /// # Errors
    /// [`IntegrationError`], with the time it came to.
    pub fn integrate(
        &self,
        system: &impl System,
        t0: f64,
        y0: &DVector<f64>,
        t1: f64,
        mut observe: impl FnMut(Step<'_>),
    ) -> Result<Outcome, IntegrationError> {
        let mut stepper = RungeKutta::new(&DORMAND_PRINCE_8, y0.len());
        let (mut t, mut y, mut next) = (t0, y0.clone(), y0.clone());
        let (mut accepted, mut refused, mut just_refused) = (0, 0, false);
        stepper.begin(system, t, &y);
        let mut h = self.first_step(system, t0, y0, t1, &stepper.slopes[0]);
        while t != t1 {
            if accepted + refused >= self.max_steps {
                return Err(IntegrationError::TooManySteps { t, steps: self.max_steps });
            }
            let last = (t1 - t).abs() <= h.abs();
            let step = if last { t1 - t } else { h };
            if t + step == t {
                return Err(IntegrationError::StepTooShort { t, h: step });
            }
            stepper.finish(system, t, &y, step, &mut next);
            let error = self.error(&stepper.slopes, &y, &next, step);
            if error <= 1.0 {
                let end = if last { t1 } else { t + step };
                observe(Step { t0: t, y0: &y, t1: end, y1: &next });
                std::mem::swap(&mut y, &mut next);
                t = end;
                accepted += 1;
                stepper.begin(system, t, &y);
            } else {
                refused += 1;
            }
            // A step that has just been refused does not grow again at once.
            let limit = if just_refused { 1.0 } else { GROW };
            just_refused = error.is_nan() || error > 1.0;
            h = step * next_step_factor(error, limit);
        }
        Ok(Outcome { y, accepted, refused })
    }

    fn scale(&self, size: f64) -> f64 {
        self.absolute + self.relative * size
    }

    /// The error of a step in units of the tolerance. The estimate of order 5 is sharpened by the one of order 3, so that
    /// it falls with the eighth power of the step; a step that left the finite numbers is infinitely bad.
    fn error(&self, slopes: &[DVector<f64>], y: &DVector<f64>, next: &DVector<f64>, h: f64) -> f64 {
        let component = |estimate: &[(usize, f64)], i: usize| -> f64 {
            let sum: f64 = estimate.iter().map(|&(j, e)| e * slopes[j][i]).sum();
            sum / self.scale(y[i].abs().max(next[i].abs()))
        };
        let (mut fifth, mut third) = (0.0, 0.0);
        for i in 0..y.len() {
            fifth += component(ERROR_5, i).powi(2);
            third += component(ERROR_3, i).powi(2);
        }
        let both = fifth + 0.01 * third;
        match both {
            b if b.is_nan() || next.iter().any(|v| !v.is_finite()) => f64::INFINITY,
            0.0 => 0.0,
            b => h.abs() * fifth / (b * y.len() as f64).sqrt(),
        }
    }

    /// A first step of which an Euler step is harmless and whose second derivative matters as much as the tolerance.
    fn first_step(&self, system: &impl System, t0: f64, y0: &DVector<f64>, t1: f64, slope: &DVector<f64>) -> f64 {
        let norm = |v: &DVector<f64>| {
            let sum: f64 = v.iter().zip(y0.iter()).map(|(v, y)| (v / self.scale(y.abs())).powi(2)).sum();
            (sum / y0.len().max(1) as f64).sqrt()
        };
        let (size, speed) = (norm(y0), norm(slope));
        let guess = if size < 1e-5 || speed < 1e-5 { 1e-6 } else { 0.01 * size / speed };
        let guess = guess.min((t1 - t0).abs());
        let direction = (t1 - t0).signum();
        let mut probe = DVector::zeros(y0.len());
        system.derivative(t0 + direction * guess, &(y0 + slope * (direction * guess)), &mut probe);
        let bend = norm(&(&probe - slope)) / guess.max(f64::MIN_POSITIVE);
        let steepest = speed.max(bend);
        let fine = if steepest <= 1e-15 { (guess * 1e-3).max(1e-6) } else { (0.01 / steepest).powf(1.0 / 8.0) };
        // `min` passes over a NaN: a system that is singular beside its start begins with the guess.
        direction * (100.0 * guess).min(fine).min((t1 - t0).abs())
    }
}

fn next_step_factor(error: f64, limit: f64) -> f64 {
    if error == 0.0 { limit } else { (MARGIN * error.powf(-1.0 / 8.0)).clamp(SHRINK, limit) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    fn oscillator(_: f64, y: &DVector<f64>, slope: &mut DVector<f64>) {
        slope[0] = y[1];
        slope[1] = -y[0];
    }

    fn kepler(_: f64, y: &DVector<f64>, slope: &mut DVector<f64>) {
        let cube = (y[0] * y[0] + y[1] * y[1]).powf(1.5);
        slope.copy_from_slice(&[y[2], y[3], -y[0] / cube, -y[1] / cube]);
    }

    /// The error falls with the tolerance: a hundredth of the tolerance gives at most a tenth of the error.
    #[test]
    fn error_follows_the_tolerance() {
        // Perihelion at eccentricity 0.9, where fixed steps are hopeless.
        let start = DVector::from_vec(vec![0.1, 0.0, 0.0, 19f64.sqrt()]);
        let mut before = f64::INFINITY;
        for tolerance in [1e-6, 1e-8, 1e-10, 1e-12] {
            let end = Adaptive::with_tolerance(tolerance).integrate(&kepler, 0.0, &start, TAU, |_| {}).unwrap();
            let error = (&end.y - &start).norm();
            println!("tolerance {tolerance:e}: error {error:e} in {} + {} steps", end.accepted, end.refused);
            assert!(error < before / 10.0, "{error:e} after {before:e}");
            assert!(error < 1e5 * tolerance);
            before = error;
        }
    }

    #[test]
    fn it_runs_backward_to_where_it_began_and_ends_exactly() {
        let start = DVector::from_vec(vec![1.0, 0.5]);
        let driver = Adaptive::with_tolerance(1e-13);
        let mut last = 0.0;
        let there = driver.integrate(&oscillator, 0.0, &start, 20.0, |s| last = s.t1).unwrap();
        assert_eq!(last, 20.0);
        let back = driver.integrate(&oscillator, 20.0, &there.y, 0.0, |s| last = s.t1).unwrap();
        assert_eq!(last, 0.0);
        assert!((back.y - start).norm() < 1e-11);
    }

    #[test]
    fn steps_join_without_gaps() {
        let mut end = (0.0, DVector::from_vec(vec![1.0, 0.0]));
        let start = end.1.clone();
        let driver = Adaptive::with_tolerance(1e-9);
        let join = |s: Step<'_>| {
            assert_eq!((s.t0, s.y0), (end.0, &end.1));
            end = (s.t1, s.y1.clone());
        };
        driver.integrate(&oscillator, 0.0, &start, 10.0, join).unwrap();
    }

    #[test]
    fn a_constant_state_costs_few_steps_and_no_time_costs_none() {
        let still = |_: f64, _: &DVector<f64>, slope: &mut DVector<f64>| slope.fill(0.0);
        let driver = Adaptive::with_tolerance(1e-12);
        let start = DVector::from_element(2, 3.0);
        let end = driver.integrate(&still, 0.0, &start, 1e3, |_| {}).unwrap();
        assert_eq!(end.y, start);
        assert!(end.accepted < 20, "{}", end.accepted);
        assert_eq!(driver.integrate(&still, 1.0, &start, 1.0, |_| {}).unwrap().accepted, 0);
    }

    #[test]
    fn failures_are_errors_with_their_time() {
        let explosion = |_: f64, y: &DVector<f64>, slope: &mut DVector<f64>| slope[0] = y[0] * y[0];
        let one = DVector::from_element(1, 1.0);
        let end = Adaptive::with_tolerance(1e-10).integrate(&explosion, 0.0, &one, 2.0, |_| {});
        let time = match end {
            Err(IntegrationError::StepTooShort { t, .. } | IntegrationError::TooManySteps { t, .. }) => t,
            other => panic!("{other:?}"),
        };
        assert!((time - 1.0).abs() < 1e-6, "y = 1/(1 - t) ends at 1, not at {time}");
        let few = Adaptive { max_steps: 3, ..Adaptive::with_tolerance(1e-10) };
        let end = few.integrate(&oscillator, 0.0, &DVector::from_vec(vec![1.0, 0.0]), 100.0, |_| {});
        assert!(matches!(end, Err(IntegrationError::TooManySteps { steps: 3, .. })));
    }
}
