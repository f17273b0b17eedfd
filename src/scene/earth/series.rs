//! Precession at its rate, and the series of the nutation.

use super::super::value::V;
use super::super::{About, Kind, Model, Motion, Precise, SceneError, Task};
use super::start::{Body, Start};
use crate::number::Number;

/// The mean motion of the axis: h at the rate (463), the obliquity constant.
pub struct Precession;

impl Model for Precession {
    fn about(&self) -> About {
        About {
            name: "precession",
            what: "the node at the constant rate of the precession, the obliquity constant",
            source: "equations (463), (465)",
            kind: Kind::Approximation,
            gives: &[],
        }
    }

    fn motion<N: Precise>(&self, task: &Task, cx: &N::Context) -> Result<Motion<N>, SceneError> {
        let s = Start::<N>::read(task, cx)?;
        let rate = s.precession(&s.obliquity);
        let state = |t: &N| {
            let t = V(t.clone());
            let h = &s.h + &rate * &t;
            (t, h)
        };
        Ok(task.tabulate(cx, state, |(t, h), q| s.quantity(q, t, h, &s.obliquity)))
    }
}

/// Precession and the nutation of first order: terms of the Moon's node, of half a month and half a year.
pub struct Nutation;

impl Model for Nutation {
    fn about(&self) -> About {
        About {
            name: "nutation",
            what: "precession and the series of the nutation, of first order in the torque",
            source: "equations (463), (469), (470), (474)",
            kind: Kind::Approximation,
            gives: &[],
        }
    }

    fn motion<N: Precise>(&self, task: &Task, cx: &N::Context) -> Result<Motion<N>, SceneError> {
        let s = Start::<N>::read(task, cx)?;
        let nutation = |t: &V<N>, mean: &[V<N>; 2]| {
            let [moon, sun] = s.bodies.each_ref().map(|body| terms(body, t, mean));
            let ([h, i], [sun_h, sun_i]) = (moon, sun);
            [h + sun_h, i + sun_i]
        };
        // The mean axis is where its own nutation leads to the axis: a fixed point.
        let zero = s.h.like(0.0);
        let mut mean = [s.h.clone(), s.obliquity.clone()];
        for _ in 0..4 {
            let [dh, di] = nutation(&zero, &mean);
            mean = [&s.h - dh, &s.obliquity - di];
        }
        let [first, obliquity] = mean;
        let rate = s.precession(&obliquity);
        let state = |t: &N| {
            let t = V(t.clone());
            let mean = [&first + &rate * &t, obliquity.clone()];
            let [dh, di] = nutation(&t, &mean);
            let [h, i] = mean;
            (t, h + dh, i + di)
        };
        Ok(task.tabulate(cx, state, |(t, h, i), q| s.quantity(q, t, h, i)))
    }
}

/// What a body adds to h and the obliquity: `dh = (1/sin I) dS/dI` and `dI = -(1/sin I) dS/dh` for the generating function S of
/// (469), in units of the angular momentum.
///
/// With `a` and `b` the components of the axis towards the node of the orbit and across, `c` the one along its normal, and F
/// the body's distance from the node, the energy (455) has the slow part `(f/4) c^2`, whose periodic terms are in the
/// angle `delta` from the equator's node to the orbit's, and the fast part
/// `-(f/2) ((a^2 - b^2)/2 cos 2F + a b sin 2F)`.
fn terms<N: Number>(body: &Body<N>, t: &V<N>, [h, obliquity]: &[V<N>; 2]) -> [V<N>; 2] {
    let ([node, argument], [cos_i, sin_i]) = (body.angles(t), &body.inclination);
    let delta = node - h;
    let (sin_delta, cos_delta) = (delta.sin(), delta.cos());
    let (sin, cos) = (obliquity.sin(), obliquity.cos());
    // The fast part; a = -sin I sin delta, b = -sin I cos i cos delta + cos I sin i.
    let double = argument * 2.0;
    let (rise, fall) = (double.sin(), double.cos());
    let a = -(&sin * &sin_delta);
    let b = &cos * sin_i - &sin * cos_i * &cos_delta;
    let slope = |da: V<N>, db: V<N>| {
        let even = &a * &da - &b * &db;
        let odd = &a * &db + &b * &da;
        (even * &rise - odd * &fall) * &body.strength / &body.argument[1] * -0.25
    };
    let of_obliquity = slope(-(&cos * &sin_delta), -(&cos * cos_i * &cos_delta) - &sin * sin_i);
    let of_h = slope(&sin * &cos_delta, -(&sin * cos_i * &sin_delta));
    let fast = [of_obliquity / &sin, -of_h / &sin];
    if body.node[1].is_zero() {
        return fast;
    }
    // The slow part, from dh/dt = (f/4)(sin 2i cos 2I/sin I cos delta + sin^2 i cos I cos 2 delta) and
    // dI/dt = -(f/4)(sin 2i cos I sin delta + sin^2 i sin I sin 2 delta).
    let factor = &body.strength / &body.node[1] * 0.25;
    let (once, twice) = (cos_i * sin_i * 2.0, sin_i.square() * 0.5);
    let cos_2_obliquity = cos.square() - sin.square();
    let (sin_2_delta, cos_2_delta) = (&sin_delta * &cos_delta * 2.0, cos_delta.square() - sin_delta.square());
    let dh = &once * cos_2_obliquity / &sin * &sin_delta + &twice * &cos * sin_2_delta;
    let di = once * cos * &cos_delta + twice * sin * cos_2_delta;
    let [h, i] = fast;
    [h + dh * &factor, i + di * factor]
}
