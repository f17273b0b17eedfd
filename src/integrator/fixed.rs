//! Methods whose step is given, and the one loop that drives them.

use super::{IntegrationError, State};
use crate::number::Number;

/// A method that goes one step of given length, forward or backward, and knows its system.
pub trait Method<N: Number> {
    /// Its name.
    fn name(&self) -> String;

    /// The order: the error of one unit of time falls with this power of the step.
    fn order(&self) -> u32;

    /// Whether a step of -h leads back to where a step of h began, but for rounding.
    fn is_symmetric(&self) -> bool {
        false
    }

    /// Moves the state from the time `t` to `t + h`.
    ///
    /// # Errors
    /// [`IntegrationError::NoConvergence`] where the equations of an implicit step are not solved.
    fn step(&mut self, t: &N, h: &N, state: &mut State<N>) -> Result<(), IntegrationError>;
}

/// Integrates with `steps` steps of length `h` from `(t0, y0)`, and shows each new time and state to `observe`. Returns the
/// last state.
///
/// # Errors
/// [`IntegrationError::NotFinite`], and what the method's steps have.
pub fn integrate_fixed<N: Number>(
    method: &mut (impl Method<N> + ?Sized),
    (t0, y0): (&N, &[N]),
    h: &N,
    steps: usize,
    mut observe: impl FnMut(&N, &State<N>),
) -> Result<Vec<N>, IntegrationError> {
    let mut state = State::new(y0);
    // The time is multiplied, not added up, so that it carries one rounding error and not a growing sum of them.
    let (mut t, mut count, mut elapsed) = (t0.clone(), t0.like(0.0), t0.like(0.0));
    for i in 1..=steps {
        method.step(&t, h, &mut state)?;
        if !state.is_finite() {
            return Err(IntegrationError::NotFinite { t: t.to_f64() });
        }
        count.set(&t0.like(i as f64));
        elapsed.set_mul(&count, h);
        t.set_add(t0, &elapsed);
        observe(&t, &state);
    }
    Ok(state.value().to_vec())
}
