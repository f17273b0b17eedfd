//! States and times as sums that carry what their roundings have left out.

use crate::number::Number;

/// A sum with what its roundings have left out.
#[derive(Clone, Debug)]
pub(super) struct Compensated<N> {
    pub value: N,
    rest: N,
}

impl<N: Number> Compensated<N> {
    pub fn new(value: N) -> Self {
        let rest = value.like(0.0);
        Compensated { value, rest }
    }

    pub fn add(&mut self, term: &N) {
        add(&mut self.value, &mut self.rest, term);
    }

    /// What is left to go to `end`.
    pub fn until(&self, end: &N) -> N {
        end.minus(&self.value).minus(&self.rest)
    }
}

/// value + rest += term. The error of the sum by Knuth's two-sum, which does not ask which of the two is larger.
fn add<N: Number>(value: &mut N, rest: &mut N, term: &N) {
    let term = term.plus(rest);
    let sum = value.plus(&term);
    let of_term = sum.minus(value);
    let of_value = sum.minus(&of_term);
    *rest = value.minus(&of_value).plus(&term.minus(&of_term));
    *value = sum;
}

/// A state of a system: components, each with what its roundings have left out (compensated summation after Kahan).
///
/// The increments of a step are small beside the state, and so are their rounding errors: what is lost in thousands of
/// steps is then not their sum but its square root at worst.
#[derive(Clone, Debug)]
pub struct State<N> {
    value: Vec<N>,
    rest: Vec<N>,
}

impl<N: Number> State<N> {
    /// The state of these components.
    pub fn new(y: &[N]) -> Self {
        State { value: y.to_vec(), rest: y.iter().map(|y| y.like(0.0)).collect() }
    }

    /// The components.
    pub fn value(&self) -> &[N] {
        &self.value
    }

    /// What the roundings have left out of each component: below its last place.
    pub fn rest(&self) -> &[N] {
        &self.rest
    }

    /// Adds to a component.
    pub fn add(&mut self, component: usize, term: &N) {
        if let (Some(value), Some(rest)) = (self.value.get_mut(component), self.rest.get_mut(component)) {
            add(value, rest, term);
        }
    }

    /// Becomes another state, as long as this one.
    pub fn set(&mut self, other: &Self) {
        let pairs = self.value.iter_mut().zip(&other.value).chain(self.rest.iter_mut().zip(&other.rest));
        for (to, from) in pairs {
            to.set(from);
        }
    }

    /// Whether every component is finite.
    pub fn is_finite(&self) -> bool {
        self.value.iter().all(N::is_finite)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 0.1 has no finite binary expansion: plain sums of it drift.
    #[test]
    fn ten_million_tenths_are_a_million() {
        let (mut state, mut plain) = (State::new(&[0.0]), 0.0);
        for _ in 0..10_000_000 {
            state.add(0, &0.1);
            plain += 0.1;
        }
        // 0.1 as a machine number is above a tenth by 5.55e-18.
        assert!((state.value()[0] - 1e6).abs() < 2.0 * 1e6 * f64::EPSILON, "{}", state.value()[0]);
        assert!((plain - 1e6f64).abs() > 1e-5);
    }

    #[test]
    fn a_term_larger_than_the_sum_loses_nothing() {
        let mut state = State::new(&[1e-3]);
        state.add(0, &3.0);
        assert_eq!((state.value()[0] - 3.0) + state.rest()[0], 1e-3);
    }
}
