//! Leading-order models of the top: steady precession, and small nutation about it.

use super::super::{About, Kind, Model, Motion, Precise, SceneError, Task};
use super::start::{ENERGY, L_Z, PHI, PSI, Start, THETA};
use crate::number::{Func, Number};

/// A motion of constant inclination.
pub(super) fn steady<N: Number>(task: &Task, cx: &N::Context, start: &Start<N>, rate: &N) -> Motion<N> {
    let psi_rate = start.spin.minus(&rate.times(&start.cos));
    let steady = Start { phi_rate: rate.clone(), theta_rate: rate.like(0.0), ..start.clone() };
    task.tabulate(cx, N::clone, |t, q| match q {
        THETA => start.theta.clone(),
        PHI => start.phi.plus(&rate.times(t)),
        PSI => start.psi.plus(&psi_rate.times(t)),
        L_Z => steady.momentum(&steady.vertical()),
        ENERGY => steady.energy(task, &steady.axis_square(), &steady.cos),
        _ => start.cos.clone(),
    })
}

/// The two roots of `p^2 cos(theta) - a p + mgl/I_0 = 0` (67): the larger one without cancellation, the smaller one from
/// their product.
fn roots<N: Number>(start: &Start<N>) -> Result<[N; 2], SceneError> {
    let discriminant = start.a.to_the(2).minus(&start.cos.times(&start.pull).times(&start.a.like(4.0)));
    if discriminant.to_f64() < 0.0 {
        return Err(SceneError::regime(
            "the spin is too slow for steady precession at this inclination (69)",
            "spin the top faster, or incline it further; the model `closed` needs no steady precession",
        ));
    }
    let root = discriminant.root();
    let root = if start.a.to_f64() < 0.0 { root.negated() } else { root };
    let larger = start.a.plus(&root).times(&root.like(0.5));
    Ok([start.pull.over(&larger), larger.over(&start.cos)])
}

/// Steady precession at the slow root.
pub struct Slow;

impl Model for Slow {
    fn about(&self) -> About {
        About {
            name: "steady-slow",
            what: "steady precession, the slow root",
            source: "equation (67)",
            kind: Kind::Approximation,
            gives: &[],
        }
    }

    fn motion<N: Precise>(&self, task: &Task, cx: &N::Context) -> Result<Motion<N>, SceneError> {
        let start = Start::<N>::read(task, cx)?;
        let [slow, _] = roots(&start)?;
        Ok(steady(task, cx, &start, &slow))
    }
}

/// Steady precession at the fast root.
pub struct Fast;

impl Model for Fast {
    fn about(&self) -> About {
        About {
            name: "steady-fast",
            what: "steady precession, the fast root",
            source: "equation (67)",
            kind: Kind::Approximation,
            gives: &[],
        }
    }

    fn motion<N: Precise>(&self, task: &Task, cx: &N::Context) -> Result<Motion<N>, SceneError> {
        let start = Start::<N>::read(task, cx)?;
        let [_, fast] = roots(&start)?;
        Ok(steady(task, cx, &start, &fast))
    }
}

/// Nutation of first order in its amplitude, about the initial inclination.
///
/// With `h = p^2 cos(theta) - a p + mgl/I_0`, `theta'' = sin(theta) h`; (52) makes `p = phi'` a function of `theta` with
/// `dp/dtheta = (a - 2 p cos(theta)) / sin(theta)`. So `delta = theta - theta_0` obeys `delta'' = sin(theta_0) h -
/// omega^2 delta` with `omega^2 = (a - 2 p cos)^2 + p^2 sin^2 - h cos`, and the rates of `phi` and `psi` are linear in
/// `delta`.
pub struct Nutation;

impl Model for Nutation {
    fn about(&self) -> About {
        About {
            name: "nutation",
            what: "small nutation, first order in its amplitude",
            source: "equations (39)-(41) and (52), linearized",
            kind: Kind::Approximation,
            gives: &[THETA, PHI, PSI, super::start::U],
        }
    }

    fn motion<N: Precise>(&self, task: &Task, cx: &N::Context) -> Result<Motion<N>, SceneError> {
        let s = Start::<N>::read(task, cx)?;
        let int = |n: f64| N::from_f64(n, cx);
        let (p, sin, cos) = (&s.phi_rate, &s.sin, &s.cos);
        let h = p.to_the(2).times(cos).minus(&s.a.times(p)).plus(&s.pull);
        let bent = s.a.minus(&p.times(cos).times(&int(2.0)));
        let square = bent.to_the(2).plus(&p.times(sin).to_the(2)).minus(&h.times(cos));
        if !(square.to_f64() > 0.0 && s.sin.to_f64() > 0.0) {
            return Err(SceneError::regime(
                "there is no small nutation about this inclination",
                "use the model `closed` or an integrated one",
            ));
        }
        let omega = square.root();
        let offset = sin.times(&h).over(&square);
        let swing = s.theta_rate.over(&omega);
        let phi_slope = bent.over(sin);
        // psi' = Omega - p cos(theta)
        let psi_slope = p.times(sin).minus(&phi_slope.times(cos));
        let psi_rate = s.spin.minus(&p.times(cos));
        let delta = |t: &N| {
            let angle = omega.times(t);
            let (sin, cos) = (angle.apply(Func::Sin), angle.apply(Func::Cos));
            let delta = offset.times(&int(1.0).minus(&cos)).plus(&swing.times(&sin));
            let integral =
                offset.times(&t.minus(&sin.over(&omega))).plus(&swing.over(&omega).times(&int(1.0).minus(&cos)));
            (t.clone(), delta, integral)
        };
        Ok(task.tabulate(cx, delta, |(t, delta, integral), q| match q {
            THETA => s.theta.plus(delta),
            PHI => s.phi.plus(&p.times(t)).plus(&phi_slope.times(integral)),
            PSI => s.psi.plus(&psi_rate.times(t)).plus(&psi_slope.times(integral)),
            _ => s.theta.plus(delta).apply(Func::Cos),
        }))
    }
}
