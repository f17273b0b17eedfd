//! Newton's method in doubles, for square systems and, with steps of least length, for others.

use nalgebra::{DMatrix, DVector};

/// The most steps that are taken.
const MOST_STEPS: usize = 60;
/// How often a step is halved before the iteration gives up.
const MOST_HALVINGS: usize = 12;

/// A system at a point: its residuals and their Jacobian.
type Values = (DVector<f64>, DMatrix<f64>);

/// Solves J s = F for the step s, from F and J.
type Step<'a> = &'a dyn Fn(&DVector<f64>, &DMatrix<f64>) -> Option<DVector<f64>>;

/// Descends from a start to a point where steps no longer change anything: the point, the residuals and the Jacobian
/// there. Steps are halved until the residuals become smaller. `at` evaluates the system, `step` solves J s = F.
pub fn descend(
    start: DVector<f64>,
    at: &mut dyn FnMut(&DVector<f64>) -> Option<Values>,
    step: Step,
) -> Option<(DVector<f64>, DVector<f64>, DMatrix<f64>)> {
    let mut x = start;
    let (mut residual, mut jacobian) = finite(at(&x))?;
    for _ in 0..MOST_STEPS {
        let full = step(&residual, &jacobian).filter(|s| s.iter().all(|s| s.is_finite()))?;
        let size = relative_size(&full, &x);
        if size < 1e-14 {
            return Some((x, residual, jacobian));
        }
        let mut next = None;
        let mut factor = 1.0;
        for _ in 0..MOST_HALVINGS {
            let trial = &x - &full * factor;
            if let Some((r, j)) = finite(at(&trial))
                && r.norm() < residual.norm()
            {
                next = Some((trial, r, j));
                break;
            }
            factor *= 0.5;
        }
        match next {
            Some((point, r, j)) => (x, residual, jacobian) = (point, r, j),
            // As good as doubles allow; the last evaluation was elsewhere.
            None if size < 1e-9 => {
                let (residual, jacobian) = finite(at(&x))?;
                return Some((x, residual, jacobian));
            }
            None => return None,
        }
    }
    None
}

fn finite(values: Option<Values>) -> Option<Values> {
    values.filter(|(r, j)| r.iter().chain(j.iter()).all(|x| x.is_finite()))
}

/// The largest change of a component relative to its size.
fn relative_size(step: &DVector<f64>, x: &DVector<f64>) -> f64 {
    step.iter().zip(x.iter()).map(|(s, x)| s.abs() / (1e-3 + x.abs())).fold(0.0, f64::max)
}
