//! The pendulum about the resonance, in closed form.

use super::super::value::V;
use super::super::{About, Kind, Model, Motion, Precise, SceneError, Task};
use super::start::Start;
use crate::number::{Elliptic, Func, Number};

/// Small librations: the linear equation.
pub struct Libration;

impl Model for Libration {
    fn about(&self) -> About {
        About {
            name: "libration",
            what: "small librations of the averaged motion, at the frequency n sqrt(3 epsilon H)",
            source: "equations (494)-(496), linear in sigma",
            kind: Kind::Approximation,
            gives: &[],
        }
    }

    fn motion<N: Precise>(&self, task: &Task, cx: &N::Context) -> Result<Motion<N>, SceneError> {
        let s = Start::<N>::read(task, cx)?;
        let frequency = s.frequency(&s.strength(), "libration")?;
        let (rate, amplitude) = (&frequency * &s.n, &s.excess / &frequency);
        let libration = &s.sigma * -0.5;
        let state = |t: &N| {
            let t = V(t.clone());
            let (sin, cos) = ((&rate * &t).sin(), (&rate * &t).cos());
            let excess = (&amplitude * &cos - &libration * &sin) * &frequency;
            (t, &libration * &cos + &amplitude * &sin, excess)
        };
        Ok(task.tabulate(cx, state, |(t, libration, excess), q| s.quantity(q, t, libration, excess)))
    }
}

/// The pendulum of (494) and (495) by Jacobi's functions: librations and circulations.
///
/// With the frequency w of small librations and `kappa^2 = sin^2(sigma_0/2) + (sigma'_0/2w)^2` the motion is
/// `sin(sigma/2) = kappa sn(w t + u_0, kappa)` where kappa < 1, and `sigma/2 = am(+-kappa w t + u_0, 1/kappa)` where kappa > 1.
pub struct Pendulum;

/// sigma and sigma'/2w.
type Point<N> = (V<N>, V<N>);
/// A motion as a function of w t.
type Course<N> = Box<dyn Fn(&V<N>) -> Point<N>>;

impl Model for Pendulum {
    fn about(&self) -> About {
        About {
            name: "pendulum",
            what: "the averaged motion, a pendulum, by Jacobi's elliptic functions",
            source: "equations (494), (495); DLMF 22.19(i)",
            kind: Kind::Approximation,
            gives: &[],
        }
    }

    fn motion<N: Precise>(&self, task: &Task, cx: &N::Context) -> Result<Motion<N>, SceneError> {
        let s = Start::<N>::read(task, cx)?;
        let frequency = s.frequency(&s.strength(), "pendulum")?;
        let rate = &frequency * &s.n;
        let at = pendulum(&s.sigma, &(&s.excess / &frequency * -1.0))?;
        let state = |t: &N| {
            let t = V(t.clone());
            let (sigma, speed) = at(&(&rate * &t));
            (t, sigma * -0.5, speed * -1.0 * &frequency)
        };
        Ok(task.tabulate(cx, state, |(t, libration, excess), q| s.quantity(q, t, libration, excess)))
    }
}

fn elliptic<N: Number>(f: Elliptic, x: &V<N>, k: &V<N>) -> V<N> {
    let mut value = x.0.clone();
    value.set_elliptic(f, &[&x.0, &k.0]);
    V(value)
}

/// The pendulum's motion as a function of w t, from sigma and sigma'/2w at t = 0.
fn pendulum<N: Number>(sigma: &V<N>, speed: &V<N>) -> Result<Course<N>, SceneError> {
    let cx = sigma.0.context();
    let turn = V(N::pi(&cx)) * 2.0;
    let turns = (sigma.0.to_f64() / std::f64::consts::TAU).round();
    let offset = turn * turns;
    let sin = ((sigma - &offset) * 0.5).sin();
    let kappa = (sin.square() + speed.square()).root();
    if kappa.is_zero() {
        let still = (offset, sigma.like(0.0));
        return Ok(Box::new(move |_| still.clone()));
    }
    let defined = |u: V<N>| {
        let why = "the motion is too near to the separatrix of the pendulum";
        u.0.is_finite().then_some(u).ok_or_else(|| SceneError::regime(why, "use an integrated model"))
    };
    if kappa.0.to_f64() < 1.0 {
        let first = defined(elliptic(Elliptic::IncompleteF, &sin.atan2(speed), &kappa))?;
        return Ok(Box::new(move |phase| {
            let u = phase + &first;
            let sn = elliptic(Elliptic::Sn, &u, &kappa);
            let angle = V((&kappa * sn).0.apply(Func::Asin)) * 2.0;
            (angle + &offset, &kappa * elliptic(Elliptic::Cn, &u, &kappa))
        }));
    }
    let (direction, k) = (speed.sign(), sigma.like(1.0) / &kappa);
    let first = defined(elliptic(Elliptic::IncompleteF, &((sigma - &offset) * 0.5), &k))?;
    Ok(Box::new(move |phase| {
        let u = phase * &kappa * direction + &first;
        (elliptic(Elliptic::Am, &u, &k) * 2.0 + &offset, &kappa * elliptic(Elliptic::Dn, &u, &k) * direction)
    }))
}
