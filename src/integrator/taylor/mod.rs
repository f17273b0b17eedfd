//! Taylor series of adaptive order and step.
//!
//! The coefficients of the solution's series come by recurrences from the expressions of its rates ([`Series`]), in any
//! number type; order and step follow Jorba and Zou, *A software package for the numerical integration of ODEs by means
//! of high-order Taylor methods*, Experimental Mathematics 14 (2005), section 3: the order is half the digits asked for
//! (in natural logarithms, and one more), and the step keeps the last two terms below the tolerance with a margin.
//!
//! Promises: the sum of steps is compensated, so that rounding grows like a random walk in the last place and no faster;
//! each step's series answers for every time in it ([`Step::at`]); the last step ends exactly where it is asked to.

mod recurrence;
mod series;
#[cfg(test)]
mod tests;

pub use series::{Equations, Expansion, NoRecurrence, Series};

use super::state::Compensated;
use super::{IntegrationError, State};
use crate::number::Number;

/// An integration by Taylor series.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Taylor {
    /// The tolerance of a step, relative to the largest component of the state or one,
    /// whichever is larger, as a power of two: -52 for 2^-52.
    pub log2_tolerance: f64,
    /// The most steps to take.
    pub max_steps: usize,
}

/// A step, as an observer sees it: the series at its beginning.
#[derive(Debug)]
pub struct Step<'a, N> {
    /// The time at its beginning.
    pub t0: &'a N,
    /// Its length.
    pub h: &'a N,
    expansion: &'a Expansion<N>,
    dimension: usize,
}

impl<N: Number> Step<'_, N> {
    /// A component of the state at the time `t0 + s`, for s from 0 to h.
    pub fn at(&self, component: usize, s: &N) -> N {
        let series = self.expansion.of(component);
        series[0].plus(&tail(series, s))
    }

    /// The number of components.
    pub fn dimension(&self) -> usize {
        self.dimension
    }
}

/// Where an integration arrived and what it cost.
#[derive(Clone, Debug, PartialEq)]
pub struct Arrival<N> {
    /// The last state.
    pub y: Vec<N>,
    /// The steps taken.
    pub steps: usize,
    /// The order of the series.
    pub order: usize,
}

impl Taylor {
    /// A tolerance in the numbers' own size, 1e-12 for twelve digits, and a million steps.
    pub fn with_tolerance(tolerance: f64) -> Self {
        Taylor { log2_tolerance: tolerance.log2(), max_steps: 1_000_000 }
    }

    /// The order that costs least for the tolerance, from 4 on.
    pub fn order(&self) -> usize {
        let order = (-self.log2_tolerance * std::f64::consts::LN_2 / 2.0 + 1.0).ceil();
        // A tolerance that is no number asks for nothing.
        if order >= 4.0 { order.min(10_000.0) as usize } else { 4 }
    }

    /// Integrates from `(t0, y0)` to `t1`, forward or backward, and shows each step to `observe`. `parameters` are the
    /// values of [`Series::parameters`].
    ///
    /// # Errors
    /// [`IntegrationError`], with the time it came to.
    pub fn integrate<N: Number>(
        &self,
        series: &Series,
        parameters: &[N],
        (t0, y0): (&N, &[N]),
        t1: &N,
        mut observe: impl FnMut(Step<'_, N>),
    ) -> Result<Arrival<N>, IntegrationError> {
        let order = self.order();
        let mut expansion = series.prepare(order, parameters, &t0.context());
        let mut time = Compensated::new(t0.clone());
        let mut state = State::new(y0);
        let mut steps = 0;
        loop {
            let left = time.until(t1);
            if left.log2_abs() == f64::NEG_INFINITY {
                return Ok(Arrival { y: state.value().to_vec(), steps, order });
            }
            let t = time.value.to_f64();
            if steps >= self.max_steps {
                return Err(IntegrationError::TooManySteps { t, steps });
            }
            series.expand(&time.value, state.value(), &mut expansion);
            let size = self.log2_step(&expansion, y0.len());
            if size.is_nan() {
                return Err(IntegrationError::NotFinite { t });
            }
            let last = left.log2_abs() <= size;
            let h = if last { left.clone() } else { left.like(size.exp2().copysign(left.to_f64())) };
            if !last && time.value.plus(&h).minus(&time.value).log2_abs() == f64::NEG_INFINITY {
                return Err(IntegrationError::StepTooShort { t, h: h.to_f64() });
            }
            observe(Step { t0: &time.value, h: &h, expansion: &expansion, dimension: y0.len() });
            for k in 0..y0.len() {
                state.add(k, &tail(expansion.of(k), &h));
            }
            if last {
                time = Compensated::new(t1.clone());
            } else {
                time.add(&h);
            }
            steps += 1;
        }
    }

    /// log₂ of the step for which the last two terms fall below the tolerance, with Jorba and Zou's margin. Infinite for a
    /// series that ends; not a number where a coefficient is not finite.
    fn log2_step<N: Number>(&self, expansion: &Expansion<N>, dimension: usize) -> f64 {
        let largest = |k: usize| {
            let sizes = (0..dimension).map(|i| &expansion.of(i)[k]);
            // One logarithm for all, where machine numbers hold their sizes.
            let most = sizes.clone().map(|c| c.to_f64().abs()).fold(0.0, fold_max);
            if (1e-290..1e290).contains(&most) {
                return most.log2();
            }
            sizes.map(|c| if c.is_finite() { c.log2_abs() } else { f64::NAN }).fold(f64::NEG_INFINITY, fold_max)
        };
        let order = expansion.order();
        let (size, before, last) = (largest(0), largest(order - 1), largest(order));
        // A state smaller than one is measured against one.
        let unit = fold_max(size, 0.0);
        let radius = fold_min((unit - before) / (order - 1) as f64, (unit - last) / order as f64);
        let e = std::f64::consts::LOG2_E;
        radius - 2.0 * e - 0.7 * e / (order - 1) as f64
    }
}

/// The larger of two; a NaN where one is.
fn fold_max(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) }
}

/// The smaller of two; a NaN where one is.
fn fold_min(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.min(b) }
}

/// Σ cₖ sᵏ without the term of order 0, by Horner's rule.
fn tail<N: Number>(series: &[N], s: &N) -> N {
    let Some((last, rest)) = series.split_last() else { return s.like(0.0) };
    let (mut sum, mut product) = (last.clone(), last.clone());
    for c in rest.iter().skip(1).rev() {
        product.set_mul(&sum, s);
        sum.set_add(&product, c);
    }
    if rest.is_empty() { s.like(0.0) } else { sum.times(s) }
}
