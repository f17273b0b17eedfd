//! The free body's equations of motion by methods that go from step to step.

use super::super::value::V;
use super::super::{About, Cost, Kind, Model, Motion, Precise, SceneError, Task};
use super::start::{ATTITUDE, Start, momentum};
use crate::integrator::{Adaptive, Composition, GaussLegendre, Method, Splitting, State, integrate_fixed};
use crate::number::Number;

/// The most steps that a method of fixed step may take.
const MOST_STEPS: f64 = 2e7;

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
        least_tolerance(task, "dormand-prince")?;
        let start = Start::<N>::read(task, cx)?;
        let system = system(&start);
        let mut state = initial(&start.omega);
        let tolerance = task.tolerance.max(f64::exp2(3.0 - f64::from(N::precision_bits(cx))));
        let driver = Adaptive { max_steps: MOST_STEPS as usize, ..Adaptive::with_tolerance(tolerance) };
        let (mut motion, mut cost) = (Motion::begin(task), Cost { order: 8, ..Cost::default() });
        let mut now = N::zero(cx);
        for &t in task.times {
            let t = N::from_f64(t, cx);
            let outcome = driver.integrate(&system, (&now, &state), &t, |_| {})?;
            cost.steps += outcome.accepted + outcome.refused;
            (state, now) = (outcome.y, t);
            let [x, y, z, attitude @ ..] = &state[..] else { break };
            push(&mut motion, task, &start, &[x, y, z].map(|x| V(x.clone())), attitude);
        }
        cost.evaluations = 12 * cost.steps;
        Ok(Motion { cost, ..motion })
    }
}

/// Methods of low order reach small tolerances by no number of steps that anybody waits for.
fn least_tolerance(task: &Task, model: &str) -> Result<(), SceneError> {
    if task.tolerance >= 1e-18 {
        return Ok(());
    }
    Err(SceneError::regime(
        format!("the order of the model `{model}` is too low for a tolerance of {:.0e}", task.tolerance),
        "take the model `closed`, or `euler`, whose order rises with the digits asked for",
    ))
}

/// Goes from each of the times asked for to the next in equal steps, short enough for the method's order to meet the
/// tolerance, and gives the state at each.
fn walk<N: Number>(
    method: &mut impl Method<N>,
    start: &Start<N>,
    mut state: Vec<N>,
    task: &Task,
    mut show: impl FnMut(&[N]),
) -> Result<Cost, SceneError> {
    let order = method.order();
    // No rate in the motion exceeds G over the smallest moment.
    let [a, b, c] = start.moments.each_ref().map(|x| x.0.to_f64());
    let whole = momentum(&start.moments, &start.omega).iter().fold(0.0_f64, |g, x| g.hypot(x.0.to_f64()));
    let rate = whole / a.min(b).min(c);
    let longest = task.tolerance.powf(1.0 / f64::from(order)) / rate;
    let like = &start.omega[0].0;
    let (mut now, mut steps) = (0.0, 0);
    for &t in task.times {
        let count = ((t - now) / longest).ceil();
        if count + steps as f64 > MOST_STEPS {
            return Err(SceneError::regime(
                format!("the motion would take more than {MOST_STEPS:.0e} steps of {}", method.name()),
                "take the model `closed`, or a shorter time",
            ));
        }
        if t > now {
            let (from, count) = (like.like(now), count.max(1.0));
            let h = like.like(t).minus(&from).over(&like.like(count));
            state = integrate_fixed(method, (&from, &state), &h, count as usize, |_, _: &State<N>| {})?;
            steps += count as usize;
        }
        show(&state);
        now = t;
    }
    Ok(Cost { evaluations: steps, steps, order: order as usize })
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
        least_tolerance(task, "splitting")?;
        let start = Start::<N>::read(task, cx)?;
        let mut method = Splitting::free(start.moments.each_ref().map(|x| x.0.clone()), Composition::KahanLi8);
        let state = initial(&momentum(&start.moments, &start.omega));
        let mut motion = Motion::begin(task);
        let cost = walk(&mut method, &start, state, task, |state| {
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
        // Some two and a half digits for each stage.
        let stages = (-task.tolerance.log10() / 2.5).ceil().clamp(2.0, 60.0) as usize;
        let mut method = GaussLegendre::new(stages, &system, 7, cx);
        let mut motion = Motion::begin(task);
        let cost = walk(&mut method, &start, initial(&start.omega), task, |state| {
            let [x, y, z, attitude @ ..] = state else { return };
            push(&mut motion, task, &start, &[x, y, z].map(|x| V(x.clone())), attitude);
        })?;
        Ok(Motion { cost, ..motion })
    }
}
