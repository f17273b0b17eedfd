//! The free body as if A and B were equal: exact where they are.

use super::super::value::V;
use super::super::{About, Kind, Model, Motion, Precise, SceneError, Task};
use super::start::{ATTITUDE, Start, momentum, product, turn};

/// Regular precession with the mean of A and B for both: the momentum `G` and the third axis turn about each other at
/// constant rates, `omega = G/A + (1 - C/A) omega_3 e_3`.
pub struct Symmetric;

impl Model for Symmetric {
    fn about(&self) -> About {
        About {
            name: "symmetric",
            what: "regular precession, as if A and B were both their mean; exact for A = B",
            source: "Euler's equations for A = B",
            kind: Kind::Approximation,
            gives: &[],
        }
    }

    fn motion<N: Precise>(&self, task: &Task, cx: &N::Context) -> Result<Motion<N>, SceneError> {
        let mut start = Start::<N>::read(task, cx)?;
        let [a, b, c] = &start.moments;
        let mean = (a + b) * 0.5;
        let [x, y, z] = start.omega.clone();
        let rate = (&mean - c) * &z / &mean;
        start.moments = [mean.clone(), mean.clone(), c.clone()];
        let precession = momentum(&start.moments, &start.omega).map(|g| g / &mean);
        let zero = x.like(0.0);
        let attitude = task.wants(&ATTITUDE);
        let state = |t: &N| {
            let t = V(t.clone());
            let (sin, cos) = ((&rate * &t).sin(), (&rate * &t).cos());
            let omega = [&x * &cos + &y * &sin, &y * &cos - &x * &sin, z.clone()];
            let own = [zero.clone(), zero.clone(), rate.clone()];
            let turned = if attitude {
                product(&turn(&precession, &t), &turn(&own, &t))
            } else {
                [(); 4].map(|()| zero.clone())
            };
            (omega, turned)
        };
        Ok(task.tabulate(cx, state, |(omega, attitude), q| match ATTITUDE.iter().position(|a| *a == q) {
            Some(i) => attitude[i].0.clone(),
            None => start.quantity(q, omega),
        }))
    }
}
