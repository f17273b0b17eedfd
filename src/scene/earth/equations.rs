//! The equations of the axis, averaged over the revolutions of Moon and Sun and as they are, integrated.

use super::super::flow::{Flow, Term};
use super::super::path::follow;
use super::super::value::V;
use super::super::walk::{dormand_prince, least_tolerance};
use super::super::{About, Kind, Model, Motion, Precise, SceneError, Task};
use super::start::{Body, Start};
use crate::number::Number;

/// The axis `(sin h sin I, -cos h sin I, cos I)` at t = 0.
fn axis<N: Number>(s: &Start<N>) -> [V<N>; 3] {
    let sin = s.obliquity.sin();
    [&sin * s.h.sin(), -(&sin * s.h.cos()), s.obliquity.cos()]
}

/// h and the obliquity of an axis; h within half a turn of what the precession alone makes it.
fn angles<N: Number>(s: &Start<N>, t: &V<N>, [x, y, z]: [&N; 3]) -> [V<N>; 2] {
    let [x, y, z] = [x, y, z].map(|x| V(x.clone()));
    let angle = x.atan2(&-y.clone());
    let turn = V(N::pi(&t.0.context())) * 2.0;
    let expected = &s.h + s.precession(&s.obliquity) * t;
    let turns = ((expected - &angle) / &turn).0.to_f64().round();
    [angle + turn * turns, (x.square() + y.square()).root().atan2(&z)]
}

/// Cos and sin of the angles of a body at t = 0.
fn phases<N: Number>(body: &Body<N>) -> [N; 4] {
    let [[node, _], [argument, _]] = [&body.node, &body.argument];
    [node.cos(), node.sin(), argument.cos(), argument.sin()].map(|x| x.0)
}

/// The averaged equations: the torque of two rings, of which the Moon's goes round with its node.
pub struct Averaged;

impl Model for Averaged {
    fn about(&self) -> About {
        About {
            name: "averaged",
            what: "the equations averaged over the revolutions of Moon and Sun, by Taylor series",
            source: "equations (440), (458)",
            kind: Kind::Approximation,
            gives: &[],
        }
    }

    fn motion<N: Precise>(&self, task: &Task, cx: &N::Context) -> Result<Motion<N>, SceneError> {
        let s = Start::<N>::read(task, cx)?;
        let flow = Flow::new(["x", "y", "z", "c", "s"], |[x, y, z, c, s]| {
            let [moon, sun, cos_i, sin_i, n_node] =
                ["moon", "sun", "cos_i", "sin_i", "n_node"].map(|name| x.symbol(name));
            // The mean of (e u)(u x e) on a circle with the normal m is -(e m)(m x e)/2.
            let (mx, my) = (sin_i * s, -(sin_i * c));
            let pull = moon * (x * mx + y * my + z * cos_i);
            let sun = sun * z;
            [
                -pull * (my * z - cos_i * y) + sun * y,
                -pull * (cos_i * x - mx * z) - sun * x,
                -pull * (mx * y - my * x),
                -(n_node * s),
                n_node * c,
            ]
        })?;
        let [moon, sun] = &s.bodies;
        let [cos_i, sin_i] = &moon.inclination;
        let named = [
            ("moon", &moon.strength * 0.5),
            ("sun", &sun.strength * 0.5),
            ("cos_i", cos_i.clone()),
            ("sin_i", sin_i.clone()),
            ("n_node", moon.node[1].clone()),
        ];
        let parameters = flow.parameters(&named.map(|(name, value)| (name, value.0)));
        let [c, d, ..] = phases(moon);
        let [x, y, z] = axis(&s).map(|x| x.0);
        let mut motion = Motion::begin(task);
        let tolerance = task.tolerance.min(1e-12);
        let cost = follow(&flow.series, &parameters, &[x, y, z, c, d], task.times, (tolerance, false), |stop| {
            let [x, y, z, ..] = stop.y else { return };
            let t = V(stop.t.clone());
            let [h, obliquity] = angles(&s, &t, [x, y, z]);
            motion.push(task, |q| s.quantity(q, &t, &h, &obliquity));
        })?;
        Ok(Motion { cost, ..motion })
    }
}

const STATE: [&str; 9] = ["x", "y", "z", "c", "s", "u", "v", "p", "q"];

/// The rates of the axis, of cos and sin of the node and of the Moon's distance from it, and of the Sun's longitude.
fn full<'g>([x, y, z, c, s, u, v, p, q]: [Term<'g>; 9]) -> [Term<'g>; 9] {
    let [moon, sun, cos_i, sin_i, n_node, n_moon, n_sun] =
        ["moon", "sun", "cos_i", "sin_i", "n_node", "n_moon", "n_sun"].map(|name| x.symbol(name));
    let across = cos_i * v;
    let (mx, my, mz) = (c * u - s * across, s * u + c * across, sin_i * v);
    let pull = moon * (x * mx + y * my + z * mz);
    let other = sun * (x * p + y * q);
    [
        pull * (my * z - mz * y) + other * q * z,
        pull * (mz * x - mx * z) - other * p * z,
        pull * (mx * y - my * x) + other * (p * y - q * x),
        -(n_node * s),
        n_node * c,
        -(n_moon * v),
        n_moon * u,
        -(n_sun * q),
        n_sun * p,
    ]
}

/// The values of the parameters of [`full`], and the state at t = 0.
pub(super) fn prepared<N: Number>(s: &Start<N>) -> ([(&'static str, N); 7], [N; 9]) {
    let [moon, sun] = &s.bodies;
    let [cos_i, sin_i] = moon.inclination.clone();
    let named = [
        ("moon", moon.strength.clone()),
        ("sun", sun.strength.clone()),
        ("cos_i", cos_i),
        ("sin_i", sin_i),
        ("n_node", moon.node[1].clone()),
        ("n_moon", moon.argument[1].clone()),
        ("n_sun", sun.argument[1].clone()),
    ];
    let [x, y, z] = axis(s).map(|x| x.0);
    let ([c, d, u, v], [_, _, p, q]) = (phases(moon), phases(sun));
    (named.map(|(name, value)| (name, value.0)), [x, y, z, c, d, u, v, p, q])
}

/// The equations of the axis as they are, by Taylor series.
pub struct Full;

impl Model for Full {
    fn about(&self) -> About {
        About {
            name: "full",
            what: "the equations of the axis, not averaged, by Taylor series",
            source: "equations (440), (441) with J = 0",
            kind: Kind::Integrated,
            gives: &[],
        }
    }

    fn motion<N: Precise>(&self, task: &Task, cx: &N::Context) -> Result<Motion<N>, SceneError> {
        let s = Start::<N>::read(task, cx)?;
        let (named, start) = prepared(&s);
        let flow = Flow::new(STATE, full)?;
        let parameters = flow.parameters(&named);
        let mut motion = Motion::begin(task);
        let cost = follow(&flow.series, &parameters, &start, task.times, (task.tolerance, false), |stop| {
            let [x, y, z, ..] = stop.y else { return };
            let t = V(stop.t.clone());
            let [h, obliquity] = angles(&s, &t, [x, y, z]);
            motion.push(task, |q| s.quantity(q, &t, &h, &obliquity));
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
            what: "the equations of the axis, not averaged, by Dormand and Prince's method of order 8",
            source: "equations (440), (441) with J = 0",
            kind: Kind::Integrated,
            gives: &[],
        }
    }

    fn motion<N: Precise>(&self, task: &Task, cx: &N::Context) -> Result<Motion<N>, SceneError> {
        least_tolerance(task, "dormand-prince", 1e-18)?;
        let s = Start::<N>::read(task, cx)?;
        let (named, start) = prepared(&s);
        let rates = Flow::rates(STATE, full, &named, cx);
        let mut motion = Motion::begin(task);
        let cost = dormand_prince(&rates, start.to_vec(), task, |t, state| {
            let [x, y, z, ..] = state else { return };
            let t = V(t.clone());
            let [h, obliquity] = angles(&s, &t, [x, y, z]);
            motion.push(task, |q| s.quantity(q, &t, &h, &obliquity));
        })?;
        Ok(Motion { cost, ..motion })
    }
}
