//! How well the constants of a motion are kept over very many periods.
//!
//! What a method does to a constant shows in how its error grows. One with a truncation error of a constant sign lets it
//! grow with the time; one that keeps it but for rounding, and rounds without a preference, lets it wander, and its error
//! grows like the square root of the time (Brouwer's law).

use super::SceneError;
use super::flow::Flow;
use super::top::{HeavyTop, TopState};
use crate::integrator::taylor::Taylor;
use crate::integrator::{
    Composition, DORMAND_PRINCE_8, GaussLegendre, IntegrationError, Method, RungeKutta, Splitting, State,
    integrate_fixed,
};
use crate::number::{Elliptic, Number};
use rayon::prelude::*;
use std::time::Instant;

/// Bins of the time for each decade.
const BINS: f64 = 4.0;
/// The growth is measured from so many periods on: what oscillates within a period has been averaged by then.
const SETTLED: f64 = 30.0;

/// How the error of a constant of the motion grew.
#[derive(Clone, Debug, PartialEq)]
pub struct Drift {
    /// The motion.
    pub scene: &'static str,
    /// The method, with its steps.
    pub method: String,
    /// The constant.
    pub constant: &'static str,
    /// Periods, and the root mean square of the relative error about then, over all members of the ensemble.
    pub points: Vec<(f64, f64)>,
    /// The exponent of the time with which the error grew: the slope of the least-squares line in logarithms.
    pub exponent: Option<f64>,
    /// The time in s that one member took for one period; methods are timed side by side with others.
    pub seconds_per_period: f64,
}

/// A constant of the motion.
type Constant = (&'static str, fn(&[f64]) -> f64);

/// Sums of squared relative errors of each constant, by time.
struct Record {
    constants: &'static [Constant],
    start: Vec<f64>,
    period: f64,
    /// For each bin: how many states, and the sum of squares for each constant.
    bins: Vec<(usize, Vec<f64>)>,
}

impl Record {
    fn new(constants: &'static [Constant], y: &[f64], period: f64) -> Self {
        let start = constants.iter().map(|(_, f)| f(y)).collect();
        Record { constants, start, period, bins: Vec::new() }
    }

    fn look(&mut self, t: f64, y: &[f64]) {
        let periods = t / self.period;
        if periods < 1.0 {
            return;
        }
        let bin = (periods.log10() * BINS) as usize;
        if self.bins.len() <= bin {
            self.bins.resize(bin + 1, (0, vec![0.0; self.constants.len()]));
        }
        let (count, squares) = &mut self.bins[bin];
        *count += 1;
        for ((square, (_, f)), start) in squares.iter_mut().zip(self.constants).zip(&self.start) {
            *square += (f(y) / start - 1.0).powi(2);
        }
    }
}

/// A motion and a way of integrating it: the ensemble's member goes through so many periods.
struct Course {
    scene: &'static str,
    method: &'static str,
    constants: &'static [Constant],
    run: fn(usize, f64) -> Result<Record, SceneError>,
}

const COURSES: [Course; 7] = [
    Course { scene: "free", method: "splitting 8, 16 steps a period", constants: &FREE, run: free_splitting },
    Course { scene: "free", method: "Gauss-Legendre 12, 12 steps a period", constants: &FREE, run: free_gauss },
    Course { scene: "free", method: "Taylor series, tolerance 2^-62", constants: &FREE, run: free_taylor },
    Course { scene: "free", method: "Dormand-Prince 8, 24 steps a period", constants: &FREE, run: free_runge_kutta },
    Course { scene: "top", method: "Gauss-Legendre 12, 16 steps a period", constants: &TOP, run: top_gauss },
    Course { scene: "top", method: "Taylor series, tolerance 2^-62", constants: &TOP, run: top_taylor },
    Course { scene: "top", method: "Dormand-Prince 8, 32 steps a period", constants: &TOP, run: top_runge_kutta },
];

/// Follows the free body A, B, C = 1, 2, 3 and a heavy top in loops, each by several methods with machine numbers,
/// through so many periods, from `members` slightly different states.
///
/// # Errors
/// [`SceneError`] where an integration stopped.
pub fn drifts(periods: f64, members: usize) -> Result<Vec<Drift>, SceneError> {
    let courses: Result<Vec<Vec<Drift>>, SceneError> = COURSES.par_iter().map(|c| drift(c, periods, members)).collect();
    Ok(courses?.into_iter().flatten().collect())
}

fn drift(course: &Course, periods: f64, members: usize) -> Result<Vec<Drift>, SceneError> {
    let begin = Instant::now();
    let records: Result<Vec<Record>, SceneError> = (0..members).map(|m| (course.run)(m, periods)).collect();
    let records = records?;
    let seconds_per_period = begin.elapsed().as_secs_f64() / (periods * members as f64);
    let each = course.constants.iter().enumerate().map(|(k, (constant, _))| {
        let points = together(&records, k, periods);
        let exponent = exponent(&points);
        let (scene, method) = (course.scene, course.method.to_owned());
        Drift { scene, method, constant, points, exponent, seconds_per_period }
    });
    Ok(each.collect())
}

/// The root mean square of a constant's error in each bin that is full, over all records.
fn together(records: &[Record], constant: usize, periods: f64) -> Vec<(f64, f64)> {
    let full = (periods.log10() * BINS + 1e-9).max(0.0) as usize;
    let bins = records.iter().map(|r| r.bins.len()).max().unwrap_or(0).min(full);
    let point = |bin: usize| {
        let of = |r: &Record| r.bins.get(bin).map_or((0, 0.0), |(n, squares)| (*n, squares[constant]));
        let (count, sum) = records.iter().map(of).fold((0, 0.0), |(n, s), (m, t)| (n + m, s + t));
        (count > 0).then(|| (10f64.powf((bin as f64 + 0.5) / BINS), (sum / count as f64).sqrt()))
    };
    (0..bins).filter_map(point).collect()
}

/// The slope of the least-squares line through the logarithms; none where there are too few points.
fn exponent(points: &[(f64, f64)]) -> Option<f64> {
    let settled = points.iter().filter(|(t, e)| *t >= SETTLED && *e > 0.0);
    let logs: Vec<(f64, f64)> = settled.map(|(t, e)| (t.ln(), e.ln())).collect();
    let n = logs.len() as f64;
    let (x, y) = logs.iter().fold((0.0, 0.0), |(x, y), (a, b)| (x + a / n, y + b / n));
    let (xy, xx) = logs.iter().fold((0.0, 0.0), |(p, s), (a, b)| (p + (a - x) * (b - y), s + (a - x).powi(2)));
    (logs.len() >= 4).then(|| xy / xx)
}

/// Principal moments of the free body in kg m^2.
const MOMENTS: [f64; 3] = [1.0, 2.0, 3.0];

fn twice_energy(y: &[f64]) -> f64 {
    y.iter().zip(MOMENTS).map(|(g, moment)| g * g / moment).sum()
}

fn momentum(y: &[f64]) -> f64 {
    y.iter().take(3).map(|g| g * g).sum::<f64>().sqrt()
}

/// The state begins with the angular momentum in body axes.
const FREE: [Constant; 2] = [("T", twice_energy), ("|G|", momentum)];

/// The angular momentum at the start, a little different for each member, and the period of the angular velocity: 4K/n
/// with n² = (C - B)(G² - 2TA)/(ABC), k² = (B - A)(2TC - G²)/((C - B)(G² - 2TA)), for a motion about the axis of C.
fn free_start(member: usize) -> ([f64; 3], f64) {
    let [a, b, c] = MOMENTS;
    let y = [0.4 + 1e-3 * member as f64, 0.6, 3.0];
    let (t2, g2) = (twice_energy(&y), momentum(&y).powi(2));
    let n = ((c - b) * (g2 - t2 * a) / (a * b * c)).sqrt();
    let k = ((b - a) * (t2 * c - g2) / ((c - b) * (g2 - t2 * a))).sqrt();
    let mut quarter = 0.0;
    f64::set_elliptic(&mut quarter, Elliptic::CompleteK, &[&k]);
    (y, 4.0 * quarter / n)
}

/// Euler's equations for the angular momentum.
fn free_rates(_: &f64, y: &[f64], slope: &mut [f64]) {
    let &[x, y, z] = y else { return slope.fill(f64::NAN) };
    let [a, b, c] = MOMENTS.map(|moment| 1.0 / moment);
    slope.copy_from_slice(&[(c - b) * y * z, (a - c) * z * x, (b - a) * x * y]);
}

/// Follows a method of fixed step.
fn fixed(
    method: &mut impl Method<f64>,
    mut record: Record,
    start: &[f64],
    (steps, periods): (usize, f64),
) -> Result<Record, SceneError> {
    let h = record.period / steps as f64;
    let count = (periods * steps as f64) as usize;
    integrate_fixed(method, (&0.0, start), &h, count, |t, y: &State<f64>| record.look(*t, y.value()))?;
    Ok(record)
}

fn free_splitting(member: usize, periods: f64) -> Result<Record, SceneError> {
    let (y, period) = free_start(member);
    let start = [&y[..], &[1.0, 0.0, 0.0, 0.0]].concat();
    let record = Record::new(&FREE, &start, period);
    fixed(&mut Splitting::free(MOMENTS, Composition::KahanLi8), record, &start, (16, periods))
}

fn free_gauss(member: usize, periods: f64) -> Result<Record, SceneError> {
    let (y, period) = free_start(member);
    fixed(&mut GaussLegendre::new(6, &free_rates, 3, &()), Record::new(&FREE, &y, period), &y, (12, periods))
}

fn free_runge_kutta(member: usize, periods: f64) -> Result<Record, SceneError> {
    let (y, period) = free_start(member);
    let mut method = RungeKutta::new(&DORMAND_PRINCE_8, &free_rates, 3, &());
    fixed(&mut method, Record::new(&FREE, &y, period), &y, (24, periods))
}

fn taylor(
    flow: &Flow,
    parameters: &[f64],
    start: &[f64],
    mut record: Record,
    periods: f64,
) -> Result<Record, SceneError> {
    // Far below the rounding, so that the truncation has no say.
    let method = Taylor { log2_tolerance: -62.0, max_steps: usize::MAX };
    let (end, mut y) = (periods * record.period, start.to_vec());
    method.integrate(&flow.series, parameters, (&0.0, start), &end, |step| {
        for (k, y) in y.iter_mut().enumerate() {
            *y = step.at(k, &0.0);
        }
        record.look(*step.t0, &y);
    })?;
    Ok(record)
}

fn free_taylor(member: usize, periods: f64) -> Result<Record, SceneError> {
    let (y, period) = free_start(member);
    let flow = Flow::new(["x", "y", "z"], |[x, y, z]| {
        let [p, q, r] = ["p", "q", "r"].map(|name| x.symbol(name));
        [p * y * z, q * z * x, r * x * y]
    })?;
    let [a, b, c] = MOMENTS.map(|moment| 1.0 / moment);
    let parameters = flow.parameters(&[("p", c - b), ("q", a - c), ("r", b - a)]);
    taylor(&flow, &parameters, &y, Record::new(&FREE, &y, period), periods)
}

/// The top: I_0 = 1, I_1 = 0.5, mgl = 1.
const BODY: HeavyTop = HeavyTop { transverse: 1.0, axial: 0.5, torque: 1.0 };

/// The state is `[theta, phi', theta', psi']`: nothing depends on the other two angles, which grow without end.
fn top_state(y: &[f64]) -> TopState {
    let part = |k: usize| y.get(k).copied().unwrap_or(f64::NAN);
    TopState { phi: 0.0, theta: part(0), psi: 0.0, phi_rate: part(1), theta_rate: part(2), psi_rate: part(3) }
}

const TOP: [Constant; 2] =
    [("L_z", |y| BODY.vertical_momentum(&top_state(y))), ("energy", |y| BODY.energy(&top_state(y)))];

fn top_rates(_: &f64, y: &[f64], slope: &mut [f64]) {
    let state = top_state(y);
    let [phi, theta, psi] = BODY.accelerations(&state);
    slope.copy_from_slice(&[state.theta_rate, phi, theta, psi]);
}

/// The top with a spin of 5 rad/s at rest in nutation, inclined a little differently for each member.
fn top_start(member: usize) -> Result<([f64; 4], f64), SceneError> {
    let theta = std::f64::consts::FRAC_PI_3 + 1e-3 * member as f64;
    let nutation = BODY.nutation(theta, 0.0, 5.0).ok_or(IntegrationError::NotFinite { t: 0.0 })?;
    let start = TopState::turning(theta, 0.0, 5.0);
    Ok(([theta, start.phi_rate, start.theta_rate, start.psi_rate], nutation.period()))
}

fn top_gauss(member: usize, periods: f64) -> Result<Record, SceneError> {
    let (y, period) = top_start(member)?;
    fixed(&mut GaussLegendre::new(6, &top_rates, 4, &()), Record::new(&TOP, &y, period), &y, (16, periods))
}

fn top_runge_kutta(member: usize, periods: f64) -> Result<Record, SceneError> {
    let (y, period) = top_start(member)?;
    let mut method = RungeKutta::new(&DORMAND_PRINCE_8, &top_rates, 4, &());
    fixed(&mut method, Record::new(&TOP, &y, period), &y, (32, periods))
}

fn top_taylor(member: usize, periods: f64) -> Result<Record, SceneError> {
    let (y, period) = top_start(member)?;
    let flow = Flow::new(["theta", "p", "q", "r"], |[theta, p, q, r]| {
        let (sin, cos) = theta.sin_cos();
        let (a, pull, two) = (theta.symbol("a"), theta.symbol("pull"), theta.int(2));
        let spin = a * (p * cos + r);
        let phi = q * (spin - two * p * cos) / sin;
        [q, phi, sin * (p * p * cos - spin * p + pull), p * q * sin - phi * cos]
    })?;
    let parameters = flow.parameters(&[("a", BODY.axial / BODY.transverse), ("pull", BODY.torque / BODY.transverse)]);
    taylor(&flow, &parameters, &y, Record::new(&TOP, &y, period), periods)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_method_keeps_the_constants_for_a_while() {
        for drift in drifts(100.0, 2).unwrap() {
            let (periods, error) = *drift.points.last().unwrap();
            println!("{} {} {}: {error:.1e} after {periods:.0} periods", drift.scene, drift.method, drift.constant);
            assert!(periods > 50.0);
            assert!(error < 1e-8, "{} {} {}: {error:e}", drift.scene, drift.method, drift.constant);
        }
    }

    #[test]
    fn exponents_are_measured() {
        let walk: Vec<(f64, f64)> =
            (4..24).map(|k| 10f64.powf(f64::from(k) / 4.0)).map(|t| (t, 3.0 * t.sqrt())).collect();
        assert!((exponent(&walk).unwrap() - 0.5).abs() < 1e-12);
        assert_eq!(exponent(&walk[..5]), None);
    }

    #[test]
    fn the_period_of_the_free_body_brings_it_back() {
        let (y, period) = free_start(0);
        let mut method = GaussLegendre::new(6, &free_rates, 3, &());
        let end = integrate_fixed(&mut method, (&0.0, &y), &(period / 64.0), 64, |_, _| {}).unwrap();
        assert!(end.iter().zip(y).all(|(a, b)| (a - b).abs() < 1e-13), "{end:?} {y:?}");
    }
}
