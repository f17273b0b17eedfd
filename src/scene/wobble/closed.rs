//! The equilibrium, and the linear wobble.

use super::super::value::V;
use super::super::{About, Kind, Model, Motion, Precise, SceneError, Task};
use super::start::{Start, product};
use crate::number::Number;

/// The equilibrium nearest to the linear one: the wobble goes round with the deformation.
pub struct Equilibrium;

impl Model for Equilibrium {
    fn about(&self) -> About {
        About {
            name: "equilibrium",
            what: "the wobble that goes round with the deformation, of the amplitude that its frequency asks for",
            source: "equations (533), (534)",
            kind: Kind::Approximation,
            gives: &[],
        }
    }

    fn motion<N: Precise>(&self, task: &Task, cx: &N::Context) -> Result<Motion<N>, SceneError> {
        let s = Start::<N>::read(task, cx)?;
        let amplitude = equilibrium(&s)?;
        let state = |t: &N| s.phase(&V(t.clone())).map(|x| x * &amplitude);
        Ok(task.tabulate(cx, state, |pole, q| s.quantity(q, pole)))
    }
}

/// `p = sin J cos(ell - nu t - beta)` in equilibrium, negative where `ell - nu t - beta` is pi: by Newton's method from the linear
/// solution, `p (sigma l_3 - nu) = epsilon (1 - 2 p^2)` with `l_3 = sqrt(1 - p^2)`, which is (534).
pub(super) fn equilibrium<N: Number>(s: &Start<N>) -> Result<V<N>, SceneError> {
    let [epsilon, sigma] = s.rates();
    let one = epsilon.like(1.0);
    let mut p = &epsilon / (&sigma - &s.nu);
    for _ in 0..60 {
        let along = (&one - p.square()).root();
        let error = &p * (&sigma * &along - &s.nu) - &epsilon * (&one - p.square() * 2.0);
        let slope = &sigma * &along - &s.nu - &sigma * p.square() / along + &epsilon * &p * 4.0;
        let step = error / slope;
        p = p - &step;
        if step.0.log2_abs() < p.0.log2_abs() - f64::from(N::precision_bits(&p.0.context())) + 2.0 {
            break;
        }
    }
    if p.0.is_finite() {
        return Ok(p);
    }
    let why = "the deformation is at the frequency of the free nutation: there is no small equilibrium";
    Err(SceneError::regime(why, "take another nu, or an integrated model"))
}

/// Small wobbles: with `z = l_2 + i l_1`, `z' = i sigma z - i epsilon e^(i (nu t + beta))`.
pub struct Linear;

impl Model for Linear {
    fn about(&self) -> About {
        About {
            name: "linear",
            what: "small wobbles: the free nutation at Euler's frequency and the forced one at that of the deformation",
            source: "equations (531), (532), linear in J",
            kind: Kind::Approximation,
            gives: &[],
        }
    }

    fn motion<N: Precise>(&self, task: &Task, cx: &N::Context) -> Result<Motion<N>, SceneError> {
        let s = Start::<N>::read(task, cx)?;
        let [epsilon, sigma] = s.rates();
        let away = &sigma - &s.nu;
        if away.is_zero() {
            let why = "the deformation is at the frequency of the free nutation: the linear wobble grows without end";
            return Err(SceneError::regime(why, "take another nu, or an integrated model"));
        }
        let forced = epsilon / away;
        let at_start = s.phase(&sigma.like(0.0)).map(|x| x * &forced);
        let free = [&s.pole[0] - &at_start[0], &s.pole[1] - &at_start[1]];
        let state = |t: &N| {
            let t = V(t.clone());
            let angle = &sigma * &t;
            let [x, y] = product(&free, &[angle.cos(), angle.sin()]);
            let [c, d] = s.phase(&t);
            [x + c * &forced, y + d * &forced]
        };
        Ok(task.tabulate(cx, state, |pole, q| s.quantity(q, pole)))
    }
}
