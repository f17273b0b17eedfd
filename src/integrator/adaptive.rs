//! Dormand and Prince's 8(5,3) pair with the step chosen by the tolerance.
//!
//! Error estimate, step control and first step after Hairer, Norsett and Wanner, *Solving Ordinary Differential
//! Equations I*, sections II.4 and II.10. States and slopes are in any number type, the control in machine numbers.

use super::dormand_prince::{ERROR_5, WEIGHTS, WEIGHTS_3};
use super::runge_kutta::{coefficient, row};
use super::state::Compensated;
use super::{DORMAND_PRINCE_8, IntegrationError, RungeKutta, State, System};
use crate::number::Number;

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
pub struct Step<'a, 's, N, S: ?Sized> {
    /// The time at its beginning.
    pub t0: &'a N,
    /// The state at its beginning.
    pub y0: &'a [N],
    /// The time at its end.
    pub t1: &'a N,
    /// The state at its end.
    pub y1: &'a [N],
    stepper: &'a mut RungeKutta<'s, N, S>,
}

impl<N: Number, S: System<N> + ?Sized> Step<'_, '_, N, S> {
    /// Writes the state at the time `t0 + s` into `y`, for s from 0 to `t1 - t0`: by a shorter step of the same method from the same
    /// state, and so as accurate as the step, for eleven evaluations of the system.
    pub fn at(&mut self, s: &N, y: &mut [N]) {
        self.stepper.stages(self.t0, self.y0, s);
        for ((y, y0), term) in y.iter_mut().zip(self.y0).zip(self.stepper.increment(s)) {
            y.set_add(y0, term);
        }
    }
}

/// Where an integration arrived and what it cost.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome<N> {
    /// The last state.
    pub y: Vec<N>,
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
    pub fn integrate<'s, N: Number, S: System<N> + ?Sized>(
        &self,
        system: &'s S,
        (t0, y0): (&N, &[N]),
        t1: &N,
        mut observe: impl FnMut(Step<'_, 's, N, S>),
    ) -> Result<Outcome<N>, IntegrationError> {
        let mut stepper = RungeKutta::new(&DORMAND_PRINCE_8, system, y0.len(), &t0.context());
        let estimate = Estimate::new(&t0.context());
        let (mut time, mut state, mut next) = (Compensated::new(t0.clone()), State::new(y0), State::new(y0));
        let (mut accepted, mut refused, mut just_refused) = (0, 0, false);
        stepper.begin(t0, y0);
        let mut h = self.first_step(system, (t0, y0), t1, stepper.slope(0));
        loop {
            let left = time.until(t1);
            if left.log2_abs() == f64::NEG_INFINITY {
                return Ok(Outcome { y: state.value().to_vec(), accepted, refused });
            }
            let t = time.value.to_f64();
            if accepted + refused >= self.max_steps {
                return Err(IntegrationError::TooManySteps { t, steps: self.max_steps });
            }
            let last = left.to_f64().abs() <= h.abs();
            let step = if last { left } else { left.like(h) };
            if !last && time.value.plus(&step).minus(&time.value).log2_abs() == f64::NEG_INFINITY {
                return Err(IntegrationError::StepTooShort { t, h });
            }
            stepper.stages(&time.value, state.value(), &step);
            next.set(&state);
            for (k, term) in stepper.increment(&step).iter().enumerate() {
                next.add(k, term);
            }
            let error = self.error(&estimate, &stepper, state.value(), &next, &step);
            if error <= 1.0 {
                let before = time.value.clone();
                if last {
                    time = Compensated::new(t1.clone());
                } else {
                    time.add(&step);
                }
                let (y0, y1) = (state.value(), next.value());
                observe(Step { t0: &before, y0, t1: &time.value, y1, stepper: &mut stepper });
                std::mem::swap(&mut state, &mut next);
                accepted += 1;
                stepper.begin(&time.value, state.value());
            } else {
                refused += 1;
            }
            // A step that has just been refused does not grow again at once.
            let limit = if just_refused { 1.0 } else { GROW };
            just_refused = error.is_nan() || error > 1.0;
            h = step.to_f64() * next_step_factor(error, limit);
        }
    }

    fn scale(&self, size: f64) -> f64 {
        self.absolute + self.relative * size
    }

    /// The error of a step in units of the tolerance. The estimate of order 5 is sharpened by the one of order 3, so that
    /// it falls with the eighth power of the step; a step that left the finite numbers is infinitely bad.
    fn error<N: Number, S: System<N> + ?Sized>(
        &self,
        estimate: &Estimate<N>,
        stepper: &RungeKutta<'_, N, S>,
        y: &[N],
        next: &State<N>,
        h: &N,
    ) -> f64 {
        let component = |terms: &[(usize, N)], i: usize| {
            let mut sum = estimate.zero.clone();
            for (j, e) in terms {
                sum.add_product(e, &stepper.slope(*j)[i]);
            }
            sum.to_f64()
        };
        let (mut fifth, mut third) = (0.0, 0.0);
        for (i, (y, next)) in y.iter().zip(next.value()).enumerate() {
            let scale = self.scale(y.to_f64().abs().max(next.to_f64().abs()));
            fifth += (component(&estimate.fifth, i) / scale).powi(2);
            third += (component(&estimate.third, i) / scale).powi(2);
        }
        let both = fifth + 0.01 * third;
        match both {
            b if b.is_nan() || !next.is_finite() => f64::INFINITY,
            0.0 => 0.0,
            b => h.to_f64().abs() * fifth / (b * y.len() as f64).sqrt(),
        }
    }

    /// A first step of which an Euler step is harmless and whose second derivative matters as much as the tolerance.
    fn first_step<N: Number, S: System<N> + ?Sized>(
        &self,
        system: &S,
        (t0, y0): (&N, &[N]),
        t1: &N,
        slope: &[N],
    ) -> f64 {
        let norm = |v: &mut dyn Iterator<Item = f64>| {
            let sum: f64 = v.zip(y0).map(|(v, y)| (v / self.scale(y.to_f64().abs())).powi(2)).sum();
            (sum / y0.len().max(1) as f64).sqrt()
        };
        let length = t1.minus(t0).to_f64();
        let (size, speed) = (norm(&mut y0.iter().map(N::to_f64)), norm(&mut slope.iter().map(N::to_f64)));
        let guess = if size < 1e-5 || speed < 1e-5 { 1e-6 } else { 0.01 * size / speed };
        let guess = guess.min(length.abs());
        let step = t0.like(guess.copysign(length));
        let there: Vec<N> = y0.iter().zip(slope).map(|(y, slope)| y.plus(&slope.times(&step))).collect();
        let mut probe = there.clone();
        system.derivative(&t0.plus(&step), &there, &mut probe);
        let bend = norm(&mut probe.iter().zip(slope).map(|(a, b)| a.minus(b).to_f64()));
        let steepest = speed.max(bend / guess.max(f64::MIN_POSITIVE));
        let fine = if steepest <= 1e-15 { (guess * 1e-3).max(1e-6) } else { (0.01 / steepest).powf(1.0 / 8.0) };
        // `min` passes over a NaN: a system that is singular beside its start begins with the guess.
        (100.0 * guess).min(fine).min(length.abs()).copysign(length)
    }
}

/// The coefficients of the error estimates of order 5 and 3.
struct Estimate<N> {
    fifth: Vec<(usize, N)>,
    third: Vec<(usize, N)>,
    zero: N,
}

impl<N: Number> Estimate<N> {
    fn new(cx: &N::Context) -> Self {
        let mut third = row::<N>(WEIGHTS, cx);
        for &(j, text) in WEIGHTS_3 {
            if let Some((_, weight)) = third.iter_mut().find(|(k, _)| *k == j) {
                *weight = weight.minus(&coefficient(text, cx));
            }
        }
        Estimate { fifth: row(ERROR_5, cx), third, zero: N::zero(cx) }
    }
}

fn next_step_factor(error: f64, limit: f64) -> f64 {
    if error == 0.0 { limit } else { (MARGIN * error.powf(-1.0 / 8.0)).clamp(SHRINK, limit) }
}
