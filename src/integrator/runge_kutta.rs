//! Explicit Runge-Kutta methods: tableaux and the one stepper that walks them.

use super::{IntegrationError, System};
use nalgebra::DVector;

/// The coefficients of an explicit Runge-Kutta method (Butcher's tableau). Zero coefficients are left out.
#[derive(Debug)]
pub struct Tableau {
    /// The method's name.
    pub name: &'static str,
    /// The order: the error of one unit of time falls with this power of the step.
    pub order: u32,
    /// `c_i`: where in the step each stage is evaluated; each is the sum of its row of `stages`.
    pub nodes: &'static [f64],
    /// `a_ij` as pairs `(j, a_ij)`, a row for each stage; the first row is empty.
    pub stages: &'static [&'static [(usize, f64)]],
    /// `b_j` as pairs `(j, b_j)`.
    pub weights: &'static [(usize, f64)],
}

/// The classical method of order 4 (Kutta 1901).
pub const CLASSICAL_4: Tableau = Tableau {
    name: "Runge-Kutta 4",
    order: 4,
    nodes: &[0.0, 0.5, 0.5, 1.0],
    stages: &[&[], &[(0, 0.5)], &[(1, 0.5)], &[(2, 1.0)]],
    weights: &[(0, 1.0 / 6.0), (1, 1.0 / 3.0), (2, 1.0 / 3.0), (3, 1.0 / 6.0)],
};

/// Walks a [`Tableau`]; holds the slopes of the stages, so that a step allocates nothing.
#[derive(Debug)]
pub struct RungeKutta<'t> {
    tableau: &'t Tableau,
    pub(super) slopes: Vec<DVector<f64>>,
    probe: DVector<f64>,
}

impl<'t> RungeKutta<'t> {
    /// A stepper for states of the given length.
    pub fn new(tableau: &'t Tableau, dimension: usize) -> Self {
        let zero = DVector::zeros(dimension);
        RungeKutta { tableau, slopes: vec![zero.clone(); tableau.stages.len()], probe: zero }
    }

    /// One step: `next` becomes the state at `t + h`.
    pub fn step(&mut self, system: &impl System, t: f64, y: &DVector<f64>, h: f64, next: &mut DVector<f64>) {
        self.begin(system, t, y);
        self.finish(system, t, y, h, next);
    }

    /// The first slope, which does not depend on the step: a step that is tried again shorter keeps it.
    pub(super) fn begin(&mut self, system: &impl System, t: f64, y: &DVector<f64>) {
        system.derivative(t, y, &mut self.slopes[0]);
    }

    /// The remaining stages and the new state.
    pub(super) fn finish(&mut self, system: &impl System, t: f64, y: &DVector<f64>, h: f64, next: &mut DVector<f64>) {
        for (i, row) in self.tableau.stages.iter().enumerate().skip(1) {
            self.probe.copy_from(y);
            for &(j, a) in *row {
                self.probe.axpy(h * a, &self.slopes[j], 1.0);
            }
            system.derivative(t + self.tableau.nodes[i] * h, &self.probe, &mut self.slopes[i]);
        }
        next.fill(0.0);
        for &(j, b) in self.tableau.weights {
            next.axpy(h * b, &self.slopes[j], 1.0);
        }
        *next += y;
    }
}

/// Integrates with `steps` steps of length `h` from `(t0, y0)`, and shows each new time and state to `observe`.
///
/// Returns the last state, or [`IntegrationError::NotFinite`].
pub fn integrate_fixed(
    tableau: &Tableau,
    system: &impl System,
    t0: f64,
    y0: &DVector<f64>,
    h: f64,
    steps: usize,
    mut observe: impl FnMut(f64, &DVector<f64>),
) -> Result<DVector<f64>, IntegrationError> {
    let mut stepper = RungeKutta::new(tableau, y0.len());
    let mut y = y0.clone();
    let mut next = y0.clone();
    for i in 0..steps {
        // The time is multiplied, not added up, so that it carries one rounding error and not a growing sum of them.
        let t = t0 + i as f64 * h;
        stepper.step(system, t, &y, h, &mut next);
        if next.iter().any(|v| !v.is_finite()) {
            return Err(IntegrationError::NotFinite { t });
        }
        std::mem::swap(&mut y, &mut next);
        observe(t0 + (i + 1) as f64 * h, &y);
    }
    Ok(y)
}

#[cfg(test)]
mod conformance {
    //! What every method has to pass: consistency, its order measured, an oscillator, a Kepler orbit and its invariants.

    use super::super::DORMAND_PRINCE_8;
    use super::*;
    use std::f64::consts::TAU;

    const METHODS: [&Tableau; 2] = [&CLASSICAL_4, &DORMAND_PRINCE_8];

    fn oscillator(_: f64, y: &DVector<f64>, slope: &mut DVector<f64>) {
        slope[0] = y[1];
        slope[1] = -y[0];
    }

    /// The plane two-body problem with unit gravitational parameter.
    fn kepler(_: f64, y: &DVector<f64>, slope: &mut DVector<f64>) {
        let cube = (y[0] * y[0] + y[1] * y[1]).powf(1.5);
        slope.copy_from_slice(&[y[2], y[3], -y[0] / cube, -y[1] / cube]);
    }

    /// Perihelion of the orbit with unit semi-major axis; its period is 2 pi.
    fn perihelion(eccentricity: f64) -> DVector<f64> {
        let speed = ((1.0 + eccentricity) / (1.0 - eccentricity)).sqrt();
        DVector::from_vec(vec![1.0 - eccentricity, 0.0, 0.0, speed])
    }

    /// The order that the errors over one period show, between `steps` and twice as many.
    fn measured_order(method: &Tableau, system: &impl System, start: &DVector<f64>, steps: usize) -> f64 {
        let error = |n: usize| {
            let end = integrate_fixed(method, system, 0.0, start, TAU / n as f64, n, |_, _| {}).unwrap();
            (end - start).norm()
        };
        (error(steps) / error(2 * steps)).log2()
    }

    #[test]
    fn rows_add_up_to_nodes_and_weights_to_one() {
        for method in METHODS {
            for (row, node) in method.stages.iter().zip(method.nodes) {
                let sum: f64 = row.iter().map(|(_, a)| a).sum();
                assert!((sum - node).abs() < 4e-14, "{}: {sum} is not {node}", method.name);
            }
            let sum: f64 = method.weights.iter().map(|(_, b)| b).sum();
            assert!((sum - 1.0).abs() < 1e-15, "{}", method.name);
        }
    }

    /// The quadrature conditions of the order: sum of b c^(q-1) = 1/q for q up to the order, and not one further.
    #[test]
    fn quadrature_conditions_hold_up_to_the_order() {
        for method in METHODS {
            let defect = |q: u32| {
                let sum: f64 = method.weights.iter().map(|&(j, b)| b * method.nodes[j].powi(q as i32 - 1)).sum();
                (sum - 1.0 / f64::from(q)).abs()
            };
            for q in 1..=method.order {
                assert!(defect(q) < 4e-15, "{} q = {q}: {}", method.name, defect(q));
            }
            assert!(defect(method.order + 1) > 1e-6, "{}", method.name);
        }
    }

    /// Halving the step divides the error by 2 to the order. The oscillator is linear and even: its phase error falls
    /// with the order itself, its amplitude error one faster.
    #[test]
    fn order_is_measured_on_the_oscillator() {
        let start = DVector::from_vec(vec![1.0, 0.0]);
        for (method, steps) in [(&CLASSICAL_4, 64), (&DORMAND_PRINCE_8, 8)] {
            let order = measured_order(method, &oscillator, &start, steps);
            println!("{}: order {order:.3} on the oscillator", method.name);
            assert!((order - f64::from(method.order)).abs() < 0.3, "{}: {order}", method.name);
        }
    }

    #[test]
    fn order_is_measured_on_a_kepler_orbit() {
        // Nearly circular, so that the errors fall with the order well before they reach the rounding errors.
        let start = perihelion(0.1);
        for (method, steps) in [(&CLASSICAL_4, 400), (&DORMAND_PRINCE_8, 32)] {
            let order = measured_order(method, &kepler, &start, steps);
            println!("{}: order {order:.3} on the Kepler orbit", method.name);
            assert!((order - f64::from(method.order)).abs() < 0.5, "{}: {order}", method.name);
        }
    }

    #[test]
    fn kepler_orbit_closes_and_keeps_energy_and_area() {
        let energy = |y: &DVector<f64>| (y[2] * y[2] + y[3] * y[3]) / 2.0 - 1.0 / y[0].hypot(y[1]);
        let area = |y: &DVector<f64>| y[0] * y[3] - y[1] * y[2];
        let start = perihelion(0.3);
        for (method, steps, bound) in [(&CLASSICAL_4, 20_000, 1e-11), (&DORMAND_PRINCE_8, 800, 1e-11)] {
            let end = integrate_fixed(method, &kepler, 0.0, &start, TAU / steps as f64, steps, |_, _| {}).unwrap();
            assert!((&end - &start).norm() < bound, "{}: {}", method.name, (&end - &start).norm());
            assert!((energy(&end) - energy(&start)).abs() < bound);
            assert!((area(&end) - area(&start)).abs() < bound);
        }
    }

    /// `y' = 5 t^4` is integrated from the nodes alone: it fails if the time is handed to the stages wrongly.
    #[test]
    fn time_reaches_the_stages() {
        for method in METHODS {
            let power = method.order as i32 - 1;
            let system = |t: f64, _: &DVector<f64>, slope: &mut DVector<f64>| {
                slope[0] = f64::from(power + 1) * t.powi(power);
            };
            let end = integrate_fixed(method, &system, 0.0, &DVector::zeros(1), 0.5, 4, |_, _| {}).unwrap();
            let exact = 2f64.powi(power + 1);
            assert!((end[0] / exact - 1.0).abs() < 1e-14, "{}: {}", method.name, end[0]);
        }
    }

    #[test]
    fn an_explosion_is_an_error_with_its_time() {
        let system = |_: f64, y: &DVector<f64>, slope: &mut DVector<f64>| slope[0] = y[0] * y[0];
        for method in METHODS {
            let end = integrate_fixed(method, &system, 0.0, &DVector::from_element(1, 1.0), 0.1, 1000, |_, _| {});
            assert!(matches!(end, Err(IntegrationError::NotFinite { t }) if t > 0.5 && t < 3.0), "{end:?}");
        }
    }
}
