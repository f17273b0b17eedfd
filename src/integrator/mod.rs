//! Ordinary differential equations `y' = f(t, y)`, in any [`Number`] type.
//!
//! | method | for | kind |
//! |---|---|---|
//! | [`taylor::Taylor`] | any precision; the series answers for every time in a step | order and step adaptive |
//! | [`Adaptive`] | quick answers in machine numbers and double-doubles | Dormand and Prince 8(5,3), step adaptive |
//! | [`RungeKutta`] | comparison; any explicit [`Tableau`] | step given |
//! | [`GaussLegendre`] | long motions of any system: symplectic, symmetric, keeps quadratic invariants | step given, implicit |
//! | [`Splitting`] | long motions of a rigid body: keeps the length of the angular momentum | step given, explicit |
//!
//! A system is a closure `|t, y, slope|`, a [`System`], or [`Rates`] made of expressions; those serve the Taylor series, too.
//! Methods with a given step implement [`Method`], and [`integrate_fixed`] drives them.
//!
//! Promises, each one a test of the [conformance suite](self) that every method passes: the order is measured, not
//! only claimed; a symmetric method runs back to where it began; states are sums with what their roundings
//! left out ([`State`]), so that rounding grows like a random walk; a motion that runs into a singularity is an
//! [`IntegrationError`] with its time, and nothing hangs.

mod adaptive;
#[cfg(test)]
mod conformance;
mod dormand_prince;
mod fixed;
mod gauss_legendre;
mod rates;
pub mod runge_kutta;
mod splitting;
mod state;
pub mod taylor;

pub use adaptive::{Adaptive, Outcome, Step};
pub use dormand_prince::DORMAND_PRINCE_8;
pub use fixed::{Method, integrate_fixed};
pub use gauss_legendre::GaussLegendre;
pub use rates::Rates;
pub use runge_kutta::{CLASSICAL_4, RungeKutta, Tableau};
pub use splitting::{Composition, Free, Splitting, Torque};
pub use state::State;

use crate::number::Number;

/// A system `y' = f(t, y)`. Any closure `|t, y, slope|` is one.
pub trait System<N> {
    /// Writes `f(t, y)` into `slope`, which has the length of `y`.
    fn derivative(&self, t: &N, y: &[N], slope: &mut [N]);
}

impl<N: Number, F: Fn(&N, &[N], &mut [N])> System<N> for F {
    fn derivative(&self, t: &N, y: &[N], slope: &mut [N]) {
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
    /// The equations of an implicit step were not solved.
    #[error("at t = {t} the equations of an implicit step of {h:e} are not solved by iteration")]
    #[diagnostic(help("take a shorter step: the iteration wants it short beside the fastest time of the system"))]
    NoConvergence {
        /// The time at the step's beginning.
        t: f64,
        /// The step.
        h: f64,
    },
}
