//! The free body's equations of motion, integrated.

use super::super::flow::Flow;
use super::super::path::follow;
use super::super::value::V;
use super::super::{About, Cost, Kind, Model, Motion, Precise, SceneError, Task};
use super::start::{ATTITUDE, Start};
use crate::integrator::Adaptive;

/// Euler's equations, with `q' = q omega / 2` only where the attitude is asked for.
pub struct Euler;

impl Model for Euler {
    fn about(&self) -> About {
        About {
            name: "euler",
            what: "Euler's equations and the attitude's quaternion, by Taylor series",
            source: "A omega_1' = (B - C) omega_2 omega_3, q' = q omega / 2",
            kind: Kind::Integrated,
            gives: &[],
        }
    }

    fn motion<N: Precise>(&self, task: &Task, cx: &N::Context) -> Result<Motion<N>, SceneError> {
        let start = Start::<N>::read(task, cx)?;
        let [a, b, c] = &start.moments;
        // Half the angular velocity, x: q' = q x, A x_1' = 2 (B - C) x_2 x_3.
        let known = [("a", (b - c) * 2.0 / a), ("b", (c - a) * 2.0 / b), ("c", (a - b) * 2.0 / c)];
        let wanted = task.wants(&ATTITUDE);
        let half = start.omega.each_ref().map(|w| (w * 0.5).0);
        let (flow, first) = if wanted {
            let flow = Flow::new(["x", "y", "z", "q0", "q1", "q2", "q3"], |[x, y, z, q0, q1, q2, q3]| {
                [
                    x.symbol("a") * (y * z),
                    x.symbol("b") * (z * x),
                    x.symbol("c") * (x * y),
                    -(q1 * x + q2 * y + q3 * z),
                    q0 * x + q2 * z - q3 * y,
                    q0 * y + q3 * x - q1 * z,
                    q0 * z + q1 * y - q2 * x,
                ]
            })?;
            let identity = [1.0, 0.0, 0.0, 0.0].map(|x| N::from_f64(x, cx));
            (flow, half.into_iter().chain(identity).collect::<Vec<N>>())
        } else {
            let flow = Flow::new(["x", "y", "z"], |[x, y, z]| {
                [x.symbol("a") * (y * z), x.symbol("b") * (z * x), x.symbol("c") * (x * y)]
            })?;
            (flow, half.into_iter().collect())
        };
        let parameters = flow.parameters(&known.map(|(name, value)| (name, value.0)));
        let mut motion = Motion::begin(task);
        let cost = follow(&flow.series, &parameters, &first, task.times, (task.tolerance, false), |stop| {
            let [x, y, z, attitude @ ..] = stop.y else { return };
            let omega = [x, y, z].map(|x| V(x.clone()) * 2.0);
            motion.push(task, |q| match ATTITUDE.iter().position(|a| *a == q).and_then(|i| attitude.get(i)) {
                Some(q) => q.clone(),
                None => start.quantity(q, &omega),
            });
        })?;
        Ok(Motion { cost, ..motion })
    }
}

/// The same by Dormand and Prince's method, from each of the times asked for to the next.
pub struct Adaptive8;

impl Model for Adaptive8 {
    fn about(&self) -> About {
        About {
            name: "dormand-prince",
            what: "Euler's equations and the attitude's quaternion, by Dormand and Prince's method of order 8",
            source: "Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, II.5",
            kind: Kind::Integrated,
            gives: &[],
        }
    }

    fn motion<N: Precise>(&self, task: &Task, cx: &N::Context) -> Result<Motion<N>, SceneError> {
        if N::precision_bits(cx) != 53 {
            return Err(SceneError::NotGiven { model: "dormand-prince", what: "more than f64".into() });
        }
        let start = Start::<f64>::read(task, &())?;
        let [a, b, c] = start.moments.each_ref().map(|x| x.0);
        let system = |_: &f64, y: &[f64], slope: &mut [f64]| {
            let &[x, y, z, q0, q1, q2, q3] = y else { return slope.fill(f64::NAN) };
            let turned = [
                -(q1 * x + q2 * y + q3 * z),
                q0 * x + q2 * z - q3 * y,
                q0 * y + q3 * x - q1 * z,
                q0 * z + q1 * y - q2 * x,
            ];
            let euler = [(b - c) / a * y * z, (c - a) / b * z * x, (a - b) / c * x * y];
            slope.copy_from_slice(&[&euler[..], &turned.map(|x| x / 2.0)].concat());
        };
        let [x, y, z] = start.omega.each_ref().map(|x| x.0);
        let mut state = vec![x, y, z, 1.0, 0.0, 0.0, 0.0];
        let driver = Adaptive { max_steps: 10_000_000, ..Adaptive::with_tolerance(task.tolerance.max(1e-15)) };
        let (mut motion, mut cost, mut now) = (Motion::begin(task), Cost { order: 8, ..Cost::default() }, 0.0);
        for &t in task.times {
            let outcome = driver.integrate(&system, (&now, &state), &t, |_| {})?;
            cost.steps += outcome.accepted + outcome.refused;
            (state, now) = (outcome.y, t);
            let omega = [0, 1, 2].map(|i| V(state[i]));
            let value = |q: usize| match ATTITUDE.iter().position(|a| *a == q) {
                Some(i) => state[3 + i],
                None => start.quantity(q, &omega),
            };
            motion.push(task, |q| N::from_f64(value(q), cx));
        }
        cost.evaluations = 12 * cost.steps;
        Ok(Motion { cost, ..motion })
    }
}
