//! Newton's method in doubles, for square systems and, with steps of least length, for others.

use nalgebra::{DMatrix, DVector};

/// The most steps that are taken.
const MOST_STEPS: usize = 30;
/// How often a step is halved before the iteration gives up.
const MOST_HALVINGS: usize = 6;

/// A system of equations F(x) = 0.
pub trait Equations {
    /// F at a point.
    fn residuals(&mut self, x: &DVector<f64>) -> DVector<f64>;
    /// The derivatives of F at a point, a row for each residual.
    fn jacobian(&mut self, x: &DVector<f64>) -> DMatrix<f64>;
    /// The step s with J s = F.
    fn step(&self, residuals: &DVector<f64>, jacobian: &DMatrix<f64>) -> Option<DVector<f64>>;
}

/// Descends from a start to a point where steps no longer change anything: the point and the Jacobian there. Steps are
/// halved until the residuals become smaller.
pub fn descend(start: DVector<f64>, equations: &mut dyn Equations) -> Option<(DVector<f64>, DMatrix<f64>)> {
    let mut x = start;
    let mut residuals = finite(equations.residuals(&x))?;
    for _ in 0..MOST_STEPS {
        let jacobian = equations.jacobian(&x);
        let full = finite(equations.step(&residuals, &jacobian)?)?;
        let size = relative_size(&full, &x);
        if size < 1e-14 {
            return Some((x, jacobian));
        }
        let mut factor = 1.0;
        let next = (0..MOST_HALVINGS).find_map(|_| {
            let trial = &x - &full * factor;
            factor *= 0.5;
            let r = finite(equations.residuals(&trial))?;
            (r.norm() < residuals.norm()).then_some((trial, r))
        });
        match next {
            Some((point, r)) => (x, residuals) = (point, r),
            // As good as doubles allow.
            None if size < 1e-9 => return Some((x, jacobian)),
            None => return None,
        }
    }
    None
}

fn finite(v: DVector<f64>) -> Option<DVector<f64>> {
    v.iter().all(|x| x.is_finite()).then_some(v)
}

/// The largest change of a component relative to its size.
fn relative_size(step: &DVector<f64>, x: &DVector<f64>) -> f64 {
    step.iter().zip(x.iter()).map(|(s, x)| s.abs() / (1e-3 + x.abs())).fold(0.0, f64::max)
}
