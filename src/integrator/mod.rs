//! Ordinary differential equations `y' = f(t, y)`: explicit Runge-Kutta methods with fixed and with adaptive steps, and
//! [Taylor series](taylor) of any order in any number type.
//!
//! A method is a [`Tableau`] of coefficients, walked by one stepper ([`RungeKutta`]), so that a new method is a table and
//! nothing else; every tableau passes the conformance tests of [`runge_kutta`] (its order measured, not only claimed).
//! [`Adaptive`] drives Dormand and Prince's 8(5,3) pair to a tolerance.

mod adaptive;
mod dormand_prince;
pub mod runge_kutta;
pub mod taylor;

pub use adaptive::{Adaptive, Outcome, Step};
pub use dormand_prince::DORMAND_PRINCE_8;
pub use runge_kutta::{CLASSICAL_4, RungeKutta, Tableau, integrate_fixed};

use nalgebra::DVector;

/// A system `y' = f(t, y)`. Any closure `|t, y, slope|` is one.
pub trait System {
    /// Writes `f(t, y)` into `slope`, which has the length of `y`.
    fn derivative(&self, t: f64, y: &DVector<f64>, slope: &mut DVector<f64>);
}

impl<F: Fn(f64, &DVector<f64>, &mut DVector<f64>)> System for F {
    fn derivative(&self, t: f64, y: &DVector<f64>, slope: &mut DVector<f64>) {
        self(t, y, slope);
    }
}

/// Why an integration stopped before its end.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error, miette::Diagnostic)]
pub enum IntegrationError {
    /// The state is no longer finite: the motion has run into a singularity of the system.
    #[error("the motion stopped being finite at t = {t}")]
    #[diagnostic(help("the system has a singularity there, or the fixed step is too long for it"))]
    NotFinite {
        /// The time at which it was last finite.
        t: f64,
    },
    /// The tolerance cannot be met by any step that still moves the time.
    #[error("at t = {t} a step of {h:e} is still too long for the tolerance")]
    #[diagnostic(help("the tolerance is below the rounding errors, or the system is singular there"))]
    StepTooShort {
        /// The time.
        t: f64,
        /// The step that was refused.
        h: f64,
    },
    /// More steps than allowed.
    #[error("{steps} steps did not reach the end; the motion is at t = {t}")]
    #[diagnostic(help("allow more steps, a wider tolerance or a shorter time"))]
    TooManySteps {
        /// The time reached.
        t: f64,
        /// The steps taken.
        steps: usize,
    },
}
