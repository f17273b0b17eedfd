//! Euler's equations by Taylor series.

use super::super::flow::Flow;
use super::super::path::follow;
use super::super::value::V;
use super::super::{About, Kind, Model, Motion, Precise, SceneError, Task};
use super::start::{ATTITUDE, Start};

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
