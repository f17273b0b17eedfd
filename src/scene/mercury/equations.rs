//! The equations of the rotation, averaged and as they are, integrated.

use super::super::flow::{Flow, Term};
use super::super::path::follow;
use super::super::value::V;
use super::super::walk::{dormand_prince, least_tolerance};
use super::super::{About, Kind, Model, Motion, Precise, SceneError, Task};
use super::start::Start;
use crate::number::Number;

/// The averaged equations (494) and (495) by Taylor series: what the model `pendulum` solves in closed form.
pub struct Averaged;

impl Model for Averaged {
    fn about(&self) -> About {
        About {
            name: "averaged",
            what: "the averaged equations of the pendulum, by Taylor series",
            source: "equations (494), (495)",
            kind: Kind::Approximation,
            gives: &[],
        }
    }

    fn motion<N: Precise>(&self, task: &Task, cx: &N::Context) -> Result<Motion<N>, SceneError> {
        let s = Start::<N>::read(task, cx)?;
        let frequency = s.frequency(&s.strength(), "averaged")?;
        let first = [&s.sigma * -0.5, s.excess.clone()];
        averaged(task, cx, &s, &frequency, first, |_, libration, excess| [libration.clone(), excess.clone()])
    }
}

/// Follows `x'' = -(w^2/2) sin 2 x` for the libration x; `restore` adds what the average leaves out.
fn averaged<N: Precise>(
    task: &Task,
    cx: &N::Context,
    s: &Start<N>,
    frequency: &V<N>,
    first: [V<N>; 2],
    restore: impl Fn(&V<N>, &V<N>, &V<N>) -> [V<N>; 2],
) -> Result<Motion<N>, SceneError> {
    // The rate in units of n w is of the size of the angle: one tolerance serves both.
    let flow = Flow::new(["x", "v"], |[x, v]| {
        let (rate, (sin, cos)) = (x.symbol("rate"), x.sin_cos());
        [rate * v, -(rate * sin * cos)]
    })?;
    let parameters = flow.parameters(&[("rate", (frequency * &s.n).0)]);
    let [libration, excess] = first;
    let start = [libration.0, (excess / frequency).0];
    let mut motion = Motion::begin(task);
    let tolerance = task.tolerance.min(1e-9);
    let cost = follow(&flow.series, &parameters, &start, task.times, (tolerance, false), |stop| {
        let [x, v] = stop.y else { return };
        let (t, x, excess) = (V(stop.t.clone()), V(x.clone()), V(v.clone()) * frequency);
        let [libration, excess] = restore(&t, &x, &excess);
        motion.push(task, |q| s.quantity(q, &t, &libration, &excess));
    })?;
    let _ = cx;
    Ok(Motion { cost, ..motion })
}

/// The averaged equations with the whole of H, from a mean state, with the short-period terms of first order put back.
pub struct Corrected;

/// The harmonics of `(a/r)^3 cos(2 f)` that are kept.
const HARMONICS: std::ops::RangeInclusive<i32> = -10..=16;

impl Model for Corrected {
    fn about(&self) -> About {
        About {
            name: "corrected",
            what: "the averaged equations with H to all orders in e and the short-period terms of first order in epsilon",
            source: "equations (487), (489), (494), (495)",
            kind: Kind::Approximation,
            gives: &[],
        }
    }

    fn motion<N: Precise>(&self, task: &Task, cx: &N::Context) -> Result<Motion<N>, SceneError> {
        let s = Start::<N>::read(task, cx)?;
        let terms: Vec<(f64, V<N>)> = HARMONICS.map(|j| (f64::from(3 - j), hansen(&s.e, j))).collect();
        let resonant = terms.iter().find(|(k, _)| *k == 0.0).map_or_else(|| s.e.like(0.0), |(_, h)| h.clone());
        let frequency = s.frequency(&resonant, "corrected")?;
        // psi'' = -(3/2) epsilon n^2 sum H_j sin(k l + 2 x) with k = 3 - j: twice the integral where k is not 0.
        let factor = &s.epsilon * 1.5;
        let short = |t: &V<N>, x: &V<N>| {
            let (mean, zero) = (s.mean_anomaly(t), s.e.like(0.0));
            let mut sums = [zero.clone(), zero];
            for (k, h) in terms.iter().filter(|(k, _)| *k != 0.0) {
                let angle = &mean * *k + x * 2.0;
                sums[0] = &sums[0] + h * angle.sin() / (k * k);
                sums[1] = &sums[1] + h * angle.cos() / *k;
            }
            sums.map(|sum| sum * &factor)
        };
        let zero = s.e.like(0.0);
        let libration = &s.sigma * -0.5;
        let mut first = [libration.clone(), s.excess.clone()];
        // The mean state is where its own short-period terms lead to the state: a fixed point.
        for _ in 0..4 {
            let [dx, dv] = short(&zero, &first[0]);
            first = [&libration - dx, &s.excess - dv];
        }
        averaged(task, cx, &s, &frequency, first, |t, x, v| {
            let [dx, dv] = short(t, x);
            [x + dx, v + dv]
        })
    }
}

/// `X_j^{-3,2}`: the mean over a revolution of `(a/r)^3 cos(2 f - j l)`, by the trapezoidal rule in the eccentric anomaly,
/// which converges geometrically.
pub(super) fn hansen<N: Number>(e: &V<N>, j: i32) -> V<N> {
    let cx = e.0.context();
    let decay = (1.0 / e.0.to_f64().max(1e-3)).acosh().max(1e-2);
    let digits = f64::from(N::precision_bits(&cx)) * std::f64::consts::LN_2 + 10.0;
    // Beyond some thousand points nothing is gained: the orbit is nearly a parabola.
    let count = ((digits / decay) as usize + 4 * j.unsigned_abs() as usize + 16).min(20_000);
    let (turn, minor) = (V(N::pi(&cx)) * 2.0, (e.like(1.0) - e.square()).root());
    let mut sum = e.like(0.0);
    for i in 0..count {
        let anomaly = &turn * i as f64 / count as f64;
        let (sin, cos) = (anomaly.sin(), anomaly.cos());
        let distance = e.like(1.0) - e * &cos;
        // cos f and sin f times r/a.
        let (x, y) = (cos - e, &minor * &sin);
        let (double_cos, double_sin) = (x.square() - y.square(), x * y * 2.0);
        let mean = (anomaly - e * &sin) * f64::from(j);
        // (a/r)^3 dl = (a/r)^2 dE, and the double angle brings (a/r)^2.
        sum = sum + (double_cos * mean.cos() + double_sin * mean.sin()) / distance.square().square();
    }
    sum / count as f64
}

/// The rates of the eccentric anomaly E, of `x = psi - (3/2) l` and of its rate v in units of n `scale`.
fn spin_orbit<'g>([anomaly, x, v]: [Term<'g>; 3]) -> [Term<'g>; 3] {
    let [n, e, minor, scale, torque] = ["n", "e", "minor", "scale", "torque"].map(|name| x.symbol(name));
    let ((sin_e, cos_e), one) = (anomaly.sin_cos(), x.int(1));
    let distance = one - e * cos_e;
    let rate = n / distance;
    // 2 (f - psi) = 2 f - 3 l - 2 x; a/r cos f and a/r sin f.
    let (c, s) = ((cos_e - e) / distance, minor * sin_e / distance);
    let (cos_2f, sin_2f) = (c.square() - s.square(), x.int(2) * c * s);
    let angle = x.int(3) * (anomaly - e * sin_e) + x.int(2) * x;
    let (sin, cos) = angle.sin_cos();
    let pull = torque * (sin_2f * cos - cos_2f * sin) / (distance * distance.square());
    [rate, n * scale * v, pull]
}

/// The values of the parameters of [`spin_orbit`], and the state at t = 0.
struct Prepared<N> {
    named: [(&'static str, N); 5],
    first: [N; 3],
    scale: V<N>,
}

impl<N: Number> Prepared<N> {
    fn new(s: &Start<N>) -> Self {
        let minor = (s.e.like(1.0) - s.e.square()).root();
        // The size of the rate of a libration, so that one tolerance serves all components.
        let scale = (s.epsilon.square().root() * 3.0).root();
        let scale = if scale.is_zero() { scale.like(1.0) } else { scale };
        let torque = &s.epsilon * &s.n * 1.5 / &scale;
        let named = [
            ("n", s.n.0.clone()),
            ("e", s.e.0.clone()),
            ("minor", minor.0),
            ("scale", scale.0.clone()),
            ("torque", torque.0),
        ];
        let first = [s.eccentric_anomaly().0, (&s.sigma * -0.5).0, (&s.excess / &scale).0];
        Prepared { named, first, scale }
    }
}

/// The equation of the rotation as it is, by Taylor series.
pub struct SpinOrbit;

impl Model for SpinOrbit {
    fn about(&self) -> About {
        About {
            name: "spin-orbit",
            what: "the rotation on the Kepler orbit, not averaged, by Taylor series",
            source: "equations (485), (486)",
            kind: Kind::Integrated,
            gives: &[],
        }
    }

    fn motion<N: Precise>(&self, task: &Task, cx: &N::Context) -> Result<Motion<N>, SceneError> {
        let s = Start::<N>::read(task, cx)?;
        let prepared = Prepared::new(&s);
        let flow = Flow::new(["anomaly", "x", "v"], spin_orbit)?;
        let parameters = flow.parameters(&prepared.named);
        let mut motion = Motion::begin(task);
        let cost = follow(&flow.series, &parameters, &prepared.first, task.times, (task.tolerance, false), |stop| {
            let [_, x, v] = stop.y else { return };
            let (t, x, excess) = (V(stop.t.clone()), V(x.clone()), V(v.clone()) * &prepared.scale);
            motion.push(task, |q| s.quantity(q, &t, &x, &excess));
        })?;
        Ok(Motion { cost, ..motion })
    }
}

/// The same by Dormand and Prince's method.
pub struct RungeKutta;

impl Model for RungeKutta {
    fn about(&self) -> About {
        About {
            name: "dormand-prince",
            what: "the rotation on the Kepler orbit, not averaged, by Dormand and Prince's method of order 8",
            source: "equations (485), (486)",
            kind: Kind::Integrated,
            gives: &[],
        }
    }

    fn motion<N: Precise>(&self, task: &Task, cx: &N::Context) -> Result<Motion<N>, SceneError> {
        least_tolerance(task, "dormand-prince", 1e-18)?;
        let s = Start::<N>::read(task, cx)?;
        let prepared = Prepared::new(&s);
        let rates = Flow::rates(["anomaly", "x", "v"], spin_orbit, &prepared.named, cx);
        let mut motion = Motion::begin(task);
        let cost = dormand_prince(&rates, prepared.first.to_vec(), task, |t, state| {
            let [_, x, v] = state else { return };
            let (t, x, excess) = (V(t.clone()), V(x.clone()), V(v.clone()) * &prepared.scale);
            motion.push(task, |q| s.quantity(q, &t, &x, &excess));
        })?;
        Ok(Motion { cost, ..motion })
    }
}
