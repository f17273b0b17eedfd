//! The equations of the wobble, integrated.

use super::super::flow::{Flow, Term};
use super::super::path::follow;
use super::super::value::V;
use super::super::walk::{dormand_prince, least_tolerance};
use super::super::{About, Kind, Model, Motion, Precise, SceneError, Task};
use super::start::{Start, product};
use crate::number::Number;

/// (531) and (532), regular where J = 0: with `p + i q = sin J e^(i (l - nu t - beta))`.
pub struct Averaged;

impl Model for Averaged {
    fn about(&self) -> About {
        About {
            name: "averaged",
            what: "the resonant term alone, by Taylor series; all of it where A = B and nothing goes round the other way",
            source: "equations (530)-(532)",
            kind: Kind::Approximation,
            gives: &[],
        }
    }

    fn motion<N: Precise>(&self, task: &Task, cx: &N::Context) -> Result<Motion<N>, SceneError> {
        let s = Start::<N>::read(task, cx)?;
        let flow = Flow::new(["p", "q"], |[p, q]| {
            let [epsilon, sigma, nu, scale] = ["epsilon", "sigma", "nu", "scale"].map(|name| p.symbol(name));
            let square = scale.square();
            let along = (p.int(1) - square * (p.square() + q.square())).sqrt();
            let (turn, push) = (sigma * along - nu, epsilon / scale);
            let pull = push * square;
            [-(q * turn) - pull * p * q, p * turn - push * along.square() + pull * p.square()]
        })?;
        let [epsilon, sigma] = s.rates();
        let named = [("epsilon", epsilon), ("sigma", sigma), ("nu", s.nu.clone()), ("scale", s.scale.clone())];
        let parameters = flow.parameters(&named.map(|(name, value)| (name, value.0)));
        let [c, d] = s.phase(&s.nu.like(0.0));
        let start = product(&s.pole, &[c, -d]).map(|x| (x / &s.scale).0);
        let mut motion = Motion::begin(task);
        let tolerance = task.tolerance.min(1e-9);
        let cost = follow(&flow.series, &parameters, &start, task.times, (tolerance, false), |stop| {
            let [p, q] = stop.y else { return };
            let turning = [p, q].map(|x| V(x.clone()) * &s.scale);
            let pole = product(&turning, &s.phase(&V(stop.t.clone())));
            motion.push(task, |q| s.quantity(q, &pole));
        })?;
        Ok(Motion { cost, ..motion })
    }
}

/// The rates of `l_2` and `l_1` in units of `scale`, and of cos and sin of the phase of the deformation:
/// `l' = l x omega`, `omega = dT/dl` with T as in (511).
fn full<'g>([x, y, c, s]: [Term<'g>; 4]) -> [Term<'g>; 4] {
    let [a, b, cos_part, sin_part, nu, omega, scale] =
        ["a", "b", "cos_part", "sin_part", "nu", "omega", "scale"].map(|name| x.symbol(name));
    let square = scale.square();
    let along = (x.int(1) - square * (x.square() + y.square())).sqrt();
    // D/B and E/A, in units of scale.
    let (d, e) = (cos_part * c, sin_part * s);
    let turn_x = a * y * along + e * (along.square() - square * y.square()) - d * square * x * y;
    let turn_y = d * (square * x.square() - along.square()) + e * square * x * y - b * x * along;
    [omega * turn_x, omega * turn_y, -(nu * s), nu * c]
}

/// The values of the parameters of [`full`], and the state at t = 0.
fn prepared<N: Number>(s: &Start<N>) -> ([(&'static str, N); 7], [N; 4]) {
    let one = s.alpha.like(1.0);
    let alpha = &s.alpha / &s.scale;
    let [a, b] = s.flattening.clone();
    let named = [
        ("a", a),
        ("b", b),
        ("cos_part", &alpha * (&one + &s.counter)),
        ("sin_part", &alpha * (&one - &s.counter)),
        ("nu", s.nu.clone()),
        ("omega", s.omega.clone()),
        ("scale", s.scale.clone()),
    ];
    let [c, d] = s.phase(&s.nu.like(0.0));
    let [x, y] = s.pole.each_ref().map(|x| x / &s.scale);
    (named.map(|(name, value)| (name, value.0)), [x.0, y.0, c.0, d.0])
}

/// All of the kinetic energy (511), by Taylor series.
pub struct Full;

impl Model for Full {
    fn about(&self) -> About {
        About {
            name: "full",
            what: "the rotation of the deforming body, by Taylor series",
            source: "equations (511)-(513), with F = 0",
            kind: Kind::Integrated,
            gives: &[],
        }
    }

    fn motion<N: Precise>(&self, task: &Task, cx: &N::Context) -> Result<Motion<N>, SceneError> {
        let s = Start::<N>::read(task, cx)?;
        let (named, start) = prepared(&s);
        let flow = Flow::new(["x", "y", "c", "s"], full)?;
        let parameters = flow.parameters(&named);
        let mut motion = Motion::begin(task);
        let cost = follow(&flow.series, &parameters, &start, task.times, (task.tolerance, false), |stop| {
            let [x, y, ..] = stop.y else { return };
            let pole = [x, y].map(|x| V(x.clone()) * &s.scale);
            motion.push(task, |q| s.quantity(q, &pole));
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
            what: "the rotation of the deforming body, by Dormand and Prince's method of order 8",
            source: "equations (511)-(513), with F = 0",
            kind: Kind::Integrated,
            gives: &[],
        }
    }

    fn motion<N: Precise>(&self, task: &Task, cx: &N::Context) -> Result<Motion<N>, SceneError> {
        least_tolerance(task, "dormand-prince", 1e-18)?;
        let s = Start::<N>::read(task, cx)?;
        let (named, start) = prepared(&s);
        let rates = Flow::rates(["x", "y", "c", "s"], full, &named, cx);
        let mut motion = Motion::begin(task);
        let cost = dormand_prince(&rates, start.to_vec(), task, |_, state| {
            let [x, y, ..] = state else { return };
            let pole = [x, y].map(|x| V(x.clone()) * &s.scale);
            motion.push(task, |q| s.quantity(q, &pole));
        })?;
        Ok(Motion { cost, ..motion })
    }
}
