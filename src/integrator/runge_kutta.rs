//! Explicit Runge-Kutta methods: tableaux and the one stepper that walks them.

use super::{IntegrationError, Method, State, System};
use crate::number::{Df64, Number};

/// A number as it was published: a decimal `"-0.25e1"` or a fraction `"1/6"`.
pub type Coefficient = &'static str;

/// The coefficients of an explicit Runge-Kutta method (Butcher's tableau). Zero coefficients are left out.
#[derive(Debug)]
pub struct Tableau {
    /// The method's name.
    pub name: &'static str,
    /// The order: the error of one unit of time falls with this power of the step.
    pub order: u32,
    /// `c_i`: where in the step each stage is evaluated; each is the sum of its row of `stages`.
    pub nodes: &'static [Coefficient],
    /// `a_ij` as pairs `(j, a_ij)`, a row for each stage; the first row is empty.
    pub stages: &'static [&'static [(usize, Coefficient)]],
    /// `b_j` as pairs `(j, b_j)`.
    pub weights: &'static [(usize, Coefficient)],
}

/// The classical method of order 4 (Kutta 1901).
pub const CLASSICAL_4: Tableau = Tableau {
    name: "Runge-Kutta 4",
    order: 4,
    nodes: &["0", "1/2", "1/2", "1"],
    stages: &[&[], &[(0, "1/2")], &[(1, "1/2")], &[(2, "1")]],
    weights: &[(0, "1/6"), (1, "1/3"), (2, "1/3"), (3, "1/6")],
};

/// A coefficient in a number type: fractions to its own precision, decimals to that of a double-double or to their
/// digits, whichever is less. Not finite where the text is no number.
pub(super) fn coefficient<N: Number>(text: Coefficient, cx: &N::Context) -> N {
    let integer = |text: &str| text.parse::<i64>().ok().map(i128::from);
    if let Some((n, d)) = text.split_once('/') {
        return match (integer(n), integer(d)) {
            (Some(n), Some(d)) => N::from_ratio(n, d, cx),
            _ => N::from_f64(f64::NAN, cx),
        };
    }
    // The nearest machine number first, so that a machine number is rounded once.
    let value = decimal(text).unwrap_or(Df64::NAN);
    N::from_f64(value.hi(), cx).plus(&N::from_f64(value.lo(), cx))
}

/// A decimal of at most 35 digits.
fn decimal(text: &str) -> Option<Df64> {
    let (mantissa, exponent) = text.split_once('e').unwrap_or((text, "0"));
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let digits: i128 = format!("{whole}{fraction}").parse().ok()?;
    let places = i32::try_from(fraction.len()).ok()?.checked_sub(exponent.parse().ok()?)?;
    let power = 10i128.checked_pow(places.unsigned_abs())?;
    let (n, d) = if places < 0 { (digits.checked_mul(power)?, 1) } else { (digits, power) };
    Some(Df64::from_ratio(n, d, &()))
}

/// Coefficients with the indices of the slopes that they belong to.
pub(super) fn row<N: Number>(terms: &[(usize, Coefficient)], cx: &N::Context) -> Vec<(usize, N)> {
    terms.iter().map(|&(j, text)| (j, coefficient(text, cx))).collect()
}

/// Walks a [`Tableau`] for a system; holds the slopes of the stages, so that a step allocates nothing.
#[derive(Debug)]
pub struct RungeKutta<'s, N, S: ?Sized> {
    tableau: &'s Tableau,
    system: &'s S,
    nodes: Vec<N>,
    stages: Vec<Vec<(usize, N)>>,
    weights: Vec<(usize, N)>,
    /// One after another, each as long as the state.
    slopes: Vec<N>,
    probe: Vec<N>,
    time: N,
    factor: N,
}

impl<'s, N: Number, S: System<N> + ?Sized> RungeKutta<'s, N, S> {
    /// A stepper for states of the given length, with coefficients in this context.
    pub fn new(tableau: &'s Tableau, system: &'s S, dimension: usize, cx: &N::Context) -> Self {
        let zero = N::zero(cx);
        RungeKutta {
            tableau,
            system,
            nodes: tableau.nodes.iter().map(|text| coefficient(text, cx)).collect(),
            stages: tableau.stages.iter().map(|terms| row(terms, cx)).collect(),
            weights: row(tableau.weights, cx),
            slopes: vec![zero.clone(); dimension * tableau.stages.len()],
            probe: vec![zero.clone(); dimension],
            time: zero.clone(),
            factor: zero,
        }
    }

    /// The slope at a stage.
    pub(super) fn slope(&self, stage: usize) -> &[N] {
        let n = self.probe.len();
        &self.slopes[stage * n..(stage + 1) * n]
    }

    /// The first slope, which does not depend on the step: a step that is tried again shorter keeps it.
    pub(super) fn begin(&mut self, t: &N, y: &[N]) {
        self.system.derivative(t, y, &mut self.slopes[..y.len()]);
    }

    /// The remaining stages.
    pub(super) fn stages(&mut self, t: &N, y: &[N], h: &N) {
        let n = self.probe.len();
        for (i, row) in self.stages.iter().enumerate().skip(1) {
            for (probe, y) in self.probe.iter_mut().zip(y) {
                probe.set(y);
            }
            add_slopes(&mut self.probe, h, row, &self.slopes, &mut self.factor);
            self.time.set(t);
            self.time.add_product(&self.nodes[i], h);
            self.system.derivative(&self.time, &self.probe, &mut self.slopes[i * n..(i + 1) * n]);
        }
    }

    /// What the step adds to the state, once the stages are done.
    pub(super) fn increment(&mut self, h: &N) -> &[N] {
        let zero = h.like(0.0);
        for increment in &mut self.probe {
            increment.set(&zero);
        }
        add_slopes(&mut self.probe, h, &self.weights, &self.slopes, &mut self.factor);
        &self.probe
    }
}

/// to += h Σ c_j k_j, with the slopes one after another.
#[inline]
fn add_slopes<N: Number>(to: &mut [N], h: &N, terms: &[(usize, N)], slopes: &[N], factor: &mut N) {
    let n = to.len();
    for (j, c) in terms {
        factor.set_mul(c, h);
        for (to, slope) in to.iter_mut().zip(&slopes[j * n..(j + 1) * n]) {
            to.add_product(factor, slope);
        }
    }
}

impl<N: Number, S: System<N> + ?Sized> Method<N> for RungeKutta<'_, N, S> {
    fn name(&self) -> String {
        self.tableau.name.to_owned()
    }

    fn order(&self) -> u32 {
        self.tableau.order
    }

    fn step(&mut self, t: &N, h: &N, state: &mut State<N>) -> Result<(), IntegrationError> {
        self.begin(t, state.value());
        self.stages(t, state.value(), h);
        for (k, term) in self.increment(h).iter().enumerate() {
            state.add(k, term);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::super::DORMAND_PRINCE_8;
    use super::*;

    const TABLEAUX: [&Tableau; 2] = [&CLASSICAL_4, &DORMAND_PRINCE_8];

    fn sum(terms: impl Iterator<Item = Df64>) -> Df64 {
        terms.fold(Df64::ZERO, |a, b| a + b)
    }

    #[test]
    fn coefficients_are_read_to_their_last_digit() {
        for (text, nearest) in [("1/3", 1.0 / 3.0), ("-0.1", -0.1), ("2.5e-2", 0.025), ("12.5e1", 125.0), ("3", 3.0)] {
            assert_eq!(coefficient::<f64>(text, &()), nearest, "{text}");
        }
        let tenth = coefficient::<Df64>("0.1", &()) * Df64::from(10.0) - Df64::ONE;
        assert!(tenth.hi().abs() < 1e-31);
        for wrong in ["", "x", "1/x", "1e", "1.2.3"] {
            assert!(!coefficient::<f64>(wrong, &()).is_finite(), "{wrong}");
        }
    }

    #[test]
    fn rows_add_up_to_nodes_and_weights_to_one() {
        for method in TABLEAUX {
            let numbers = |terms| sum(row::<Df64>(terms, &()).into_iter().map(|(_, a)| a));
            for (terms, node) in method.stages.iter().zip(method.nodes) {
                let error = (numbers(terms) - coefficient::<Df64>(node, &())).hi();
                assert!(error.abs() < 2e-28, "{}: {error:e} at {node}", method.name);
            }
            assert!((numbers(method.weights) - Df64::ONE).hi().abs() < 1e-29, "{}", method.name);
        }
    }

    /// The quadrature conditions of the order: sum of b c^(q-1) = 1/q for q up to the order, and not one further.
    #[test]
    fn quadrature_conditions_hold_up_to_the_order() {
        for method in TABLEAUX {
            let defect = |q: u32| {
                let node = |j: usize| coefficient::<Df64>(method.nodes[j], &());
                let terms = row::<Df64>(method.weights, &()).into_iter();
                let sum = sum(terms.map(|(j, b)| b * node(j).to_the(q as i32 - 1)));
                (sum - Df64::from_ratio(1, i128::from(q), &())).hi().abs()
            };
            for q in 1..=method.order {
                assert!(defect(q) < 1e-28, "{} q = {q}: {}", method.name, defect(q));
            }
            assert!(defect(method.order + 1) > 1e-6, "{}", method.name);
        }
    }
}
