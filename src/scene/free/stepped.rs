//! The free body's equations of motion by methods that go from step to step.

use super::super::value::V;
use super::super::walk::{dormand_prince, least_tolerance, stages, walk};
use super::super::{About, Kind, Model, Motion, Precise, SceneError, Task};
use super::start::{ATTITUDE, Start, momentum};
use crate::integrator::{CLASSICAL_4, Composition, GaussLegendre, RungeKutta, Splitting};
use crate::number::Number;

/// Pushes the quantities at a state: the angular velocity and the attitude.
fn push<N: Number>(motion: &mut Motion<N>, task: &Task, start: &Start<N>, omega: &[V<N>; 3], attitude: &[N]) {
    motion.push(task, |q| match ATTITUDE.iter().position(|a| *a == q).and_then(|i| attitude.get(i)) {
        Some(q) => q.clone(),
        None => start.quantity(q, omega),
    });
}

/// Euler's equations and `q' = q omega / 2` for the state `[omega_1, omega_2, omega_3, q_0, q_1, q_2, q_3]`.
fn system<N: Number>(start: &Start<N>) -> impl Fn(&N, &[N], &mut [N]) + use<N> {
    let [a, b, c] = &start.moments;
    let [over_a, over_b, over_c] = [(b - c) / a, (c - a) / b, (a - b) / c];
    let half = a.like(0.5);
    move |_, y, slope| {
        let [x, y, z, q0, q1, q2, q3] = y else { return };
        let [x, y, z, q0, q1, q2, q3] = [x, y, z, q0, q1, q2, q3].map(|v| V(v.clone()));
        let rates = [
            &over_a * (&y * &z),
            &over_b * (&z * &x),
            &over_c * (&x * &y),
            -(&q1 * &x + &q2 * &y + &q3 * &z) * &half,
            (&q0 * &x + &q2 * &z - &q3 * &y) * &half,
            (&q0 * &y + &q3 * &x - &q1 * &z) * &half,
            (&q0 * &z + &q1 * &y - &q2 * &x) * &half,
        ];
        for (slope, rate) in slope.iter_mut().zip(rates) {
            *slope = rate.0;
        }
    }
}

/// The state at the start, whose first three components are these.
fn initial<N: Number>(first: &[V<N>; 3]) -> Vec<N> {
    let identity = [1.0, 0.0, 0.0, 0.0].map(|x| first[0].0.like(x));
    first.iter().map(|x| x.0.clone()).chain(identity).collect()
}

/// Dormand and Prince's method, from each of the times asked for to the next.
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
        least_tolerance(task, "dormand-prince", 1e-18)?;
        let start = Start::<N>::read(task, cx)?;
        let mut motion = Motion::begin(task);
        let cost = dormand_prince(&system(&start), initial(&start.omega), task, |_, state| {
            let [x, y, z, attitude @ ..] = state else { return };
            push(&mut motion, task, &start, &[x, y, z].map(|x| V(x.clone())), attitude);
        })?;
        Ok(Motion { cost, ..motion })
    }
}

/// What no rate in the motion exceeds: G over the smallest moment.
fn rate<N: Number>(start: &Start<N>) -> f64 {
    let [a, b, c] = start.moments.each_ref().map(|x| x.0.to_f64());
    let whole = momentum(&start.moments, &start.omega).iter().fold(0.0_f64, |g, x| g.hypot(x.0.to_f64()));
    whole / a.min(b).min(c)
}

/// Exact turns about the principal axes, composed to a method of order 8: the length of the momentum is kept in each.
pub struct Split;

impl Model for Split {
    fn about(&self) -> About {
        About {
            name: "splitting",
            what: "turns about the principal axes, composed to order 8: keeps the length of the momentum",
            source: "McLachlan, Phys. Rev. Lett. 71 (1993); Kahan and Li, Math. Comp. 66 (1997)",
            kind: Kind::Integrated,
            gives: &[],
        }
    }

    fn motion<N: Precise>(&self, task: &Task, cx: &N::Context) -> Result<Motion<N>, SceneError> {
        least_tolerance(task, "splitting", 1e-18)?;
        let start = Start::<N>::read(task, cx)?;
        let mut method = Splitting::free(start.moments.each_ref().map(|x| x.0.clone()), Composition::KahanLi8);
        let state = initial(&momentum(&start.moments, &start.omega));
        let mut motion = Motion::begin(task);
        let cost = walk(&mut method, rate(&start), state, task, |_, state| {
            let [x, y, z, attitude @ ..] = state else { return };
            let [a, b, c] = &start.moments;
            let omega = [(x, a), (y, b), (z, c)].map(|(g, moment)| V(g.clone()) / moment);
            push(&mut motion, task, &start, &omega, attitude);
        })?;
        Ok(Motion { cost, ..motion })
    }
}

/// Gauss and Legendre's methods, which keep energy and momentum, both quadratic, to rounding.
pub struct Gauss;

impl Model for Gauss {
    fn about(&self) -> About {
        About {
            name: "gauss-legendre",
            what: "Euler's equations and the attitude by Gauss and Legendre's method: keeps energy and momentum",
            source: "Hairer, Lubich, Wanner, Geometric Numerical Integration, IV.2 and VIII.6",
            kind: Kind::Integrated,
            gives: &[],
        }
    }

    fn motion<N: Precise>(&self, task: &Task, cx: &N::Context) -> Result<Motion<N>, SceneError> {
        let start = Start::<N>::read(task, cx)?;
        let system = system(&start);
        let mut method = GaussLegendre::new(stages(task), &system, 7, cx);
        let mut motion = Motion::begin(task);
        let cost = walk(&mut method, rate(&start), initial(&start.omega), task, |_, state| {
            let [x, y, z, attitude @ ..] = state else { return };
            push(&mut motion, task, &start, &[x, y, z].map(|x| V(x.clone())), attitude);
        })?;
        Ok(Motion { cost, ..motion })
    }
}

/// The classical Runge-Kutta method, for comparison.
pub struct Classical;

impl Model for Classical {
    fn about(&self) -> About {
        About {
            name: "runge-kutta",
            what: "Euler's equations and the attitude by the classical method of order 4, for comparison",
            source: "Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, II.1",
            kind: Kind::Integrated,
            gives: &[],
        }
    }

    fn motion<N: Precise>(&self, task: &Task, cx: &N::Context) -> Result<Motion<N>, SceneError> {
        least_tolerance(task, "runge-kutta", 1e-16)?;
        let start = Start::<N>::read(task, cx)?;
        let system = system(&start);
        let mut method = RungeKutta::new(&CLASSICAL_4, &system, 7, cx);
        let mut motion = Motion::begin(task);
        let cost = walk(&mut method, rate(&start), initial(&start.omega), task, |_, state| {
            let [x, y, z, attitude @ ..] = state else { return };
            push(&mut motion, task, &start, &[x, y, z].map(|x| V(x.clone())), attitude);
        })?;
        Ok(Motion { cost, ..motion })
    }
}
