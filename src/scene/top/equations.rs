//! The top's equations of motion, by Taylor series.

use super::super::flow::{Flow, Term};
use super::super::path::{Stop, follow};
use super::super::{About, Kind, Model, Motion, Precise, SceneError, Task};
use super::start::{ENERGY, L_Z, PHI, PSI, Start, THETA, U};
use crate::number::{Func, Number};

/// The axis upright or hanging: its Euler angles say nothing.
pub fn singular(model: &str) -> SceneError {
    SceneError::regime(
        format!("the axis is upright or hanging at the start, where the model `{model}` is singular"),
        "use the model `quaternion`, which has no singular states",
    )
}

/// The angle of (x, y) that follows on from the one before, beyond a turn.
fn onward<N: Number>(before: &N, y: &N, x: &N) -> N {
    let mut angle = y.clone();
    angle.set_atan2(y, x);
    let turn = N::pi(&y.context()).times(&y.like(2.0));
    let turns = before.minus(&angle).over(&turn).to_f64().round();
    if turns == 0.0 { angle } else { angle.plus(&turn.times(&y.like(turns))) }
}

/// `theta` from the squares of sin and cos of its half, without cancellation at either end.
fn inclination<N: Number>(sin2: &N, cos2: &N) -> N {
    let mut half = sin2.clone();
    half.set_atan2(&sin2.root(), &cos2.root());
    half.times(&half.like(2.0))
}

/// The reduced equation for `u = cos(theta)`, with quadratures for the other angles only where they are asked for.
///
/// The state is `d = 1 - u`, which keeps its digits where the axis is nearly upright: from `u'^2 = f(u)` by (52) and (66),
/// `d'' = kappa - (alpha + a^2 - 3 b) d - (3/2) b d^2`.
pub struct Reduced;

impl Model for Reduced {
    fn about(&self) -> About {
        About {
            name: "reduced",
            what: "the reduced equation for u = cos theta, with quadratures for phi and psi, by Taylor series",
            source: "equations (52) and (66)",
            kind: Kind::Integrated,
            gives: &[],
        }
    }

    fn motion<N: Precise>(&self, task: &Task, cx: &N::Context) -> Result<Motion<N>, SceneError> {
        let s = Start::<N>::read(task, cx)?;
        let angles = task.wants(&[PHI, PSI]);
        if s.sin.log2_abs() == f64::NEG_INFINITY && angles {
            return Err(singular("reduced"));
        }
        let reduction = Reduction::new(&s);
        let (d, v) = (reduction.d.clone(), s.sin.times(&s.theta_rate));
        let (flow, start) = if angles {
            let flow = Flow::new(["d", "v", "phi", "psi"], |[d, v, _, _]| {
                let bend = reduced(d);
                let phi = (d.symbol("behind") + d.symbol("a") * d) / (d * (d.int(2) - d));
                [v, bend, phi, phi * (d - d.int(1))]
            })?;
            (flow, vec![d, v, s.phi.clone(), s.psi.clone()])
        } else {
            (Flow::new(["d", "v"], |[d, v]| [v, reduced(d)])?, vec![d, v])
        };
        let parameters = flow.parameters(&reduction.named(&s));
        let mut motion = Motion::begin(task);
        let two = N::from_f64(2.0, cx);
        let cost = follow(&flow.series, &parameters, &start, task.times, (task.tolerance, false), |stop| {
            let below = &stop.y[0];
            let (above, u) = (two.minus(below), below.like(1.0).minus(below));
            motion.push(task, |q| match q {
                THETA => inclination(below, &above),
                PHI => stop.y[2].clone(),
                PSI => stop.y[3].plus(&s.spin.times(stop.t)),
                U => u.clone(),
                L_Z => s.momentum(&s.vertical()),
                _ => {
                    let across = reduction.behind.plus(&s.a.times(below)).to_the(2).plus(&stop.y[1].to_the(2));
                    s.energy(task, &across.over(&below.times(&above)), &u)
                }
            });
        })?;
        Ok(Motion { cost, ..motion })
    }
}

/// The constants of the reduced equation.
struct Reduction<N> {
    /// `1 - u` at the start.
    d: N,
    /// `l - a`.
    behind: N,
    /// `b = 2 mgl / I_0`.
    b: N,
    /// `alpha + a^2 - 3 b`.
    slope: N,
    /// `alpha - b + a (a - l)`.
    kappa: N,
}

impl<N: Number> Reduction<N> {
    fn new(s: &Start<N>) -> Self {
        let two = s.a.like(2.0);
        let half = s.theta.times(&s.a.like(0.5)).apply(Func::Sin);
        let d = half.to_the(2).times(&two);
        let b = s.pull.times(&two);
        let behind = d.times(&s.phi_rate.times(&two.minus(&d)).minus(&s.a));
        let above = s.axis_square().minus(&b.times(&d)); // alpha - b
        let slope = above.plus(&s.a.to_the(2)).minus(&b.times(&two));
        let kappa = above.minus(&s.a.times(&behind));
        Reduction { d, behind, b, slope, kappa }
    }

    fn named(&self, s: &Start<N>) -> [(&'static str, N); 5] {
        let Reduction { behind, b, slope, kappa, .. } = self;
        [("behind", behind), ("b", b), ("slope", slope), ("kappa", kappa), ("a", &s.a)].map(|(n, v)| (n, v.clone()))
    }
}

/// `d''`.
fn reduced(d: Term<'_>) -> Term<'_> {
    let [b, slope, kappa] = ["b", "slope", "kappa"].map(|name| d.symbol(name));
    kappa - slope * d - b * (d.int(3) / d.int(2)) * d.square()
}

/// The state of the equations in Euler angles.
pub const ANGLES: [&str; 6] = ["theta", "phi", "psi", "dtheta", "dphi", "dpsi"];

/// Their rates.
pub fn in_angles([theta, .., dtheta, dphi, dpsi]: [Term<'_>; 6]) -> [Term<'_>; 6] {
    let [a, pull] = ["a", "pull"].map(|name| theta.symbol(name));
    let (sin, cos) = theta.sin_cos();
    let along = dphi * cos;
    let theta_bend = sin * (dphi * (along - a) + pull);
    let phi_bend = dtheta * (a - theta.int(2) * along) / sin;
    [dtheta, dphi, dpsi, theta_bend, phi_bend, dphi * dtheta * sin - phi_bend * cos]
}

impl<N: Number> Start<N> {
    /// The initial state in Euler angles.
    pub fn in_angles(&self) -> [N; 6] {
        let psi_rate = self.spin.minus(&self.phi_rate.times(&self.cos));
        [&self.theta, &self.phi, &self.psi, &self.theta_rate, &self.phi_rate, &psi_rate].map(N::clone)
    }

    /// A quantity of a state in Euler angles.
    pub fn of_angles(&self, task: &Task, y: &[N], q: usize) -> N {
        match q {
            THETA => y[0].clone(),
            PHI => y[1].clone(),
            PSI => y[2].clone(),
            U => y[0].apply(Func::Cos),
            _ => {
                // The spin as it is now: its drift is the integrator's.
                let (sin, cos) = (y[0].apply(Func::Sin), y[0].apply(Func::Cos));
                let spin = y[4].times(&cos).plus(&y[5]);
                let a = self.a.times(&spin).over(&self.spin);
                let a = if a.is_finite() { a } else { self.a.clone() };
                let (theta_rate, phi_rate) = (y[3].clone(), y[4].clone());
                let now = Start { a, spin, sin, cos, theta_rate, phi_rate, ..self.clone() };
                match q {
                    L_Z => now.momentum(&now.vertical()),
                    _ => now.energy(task, &now.axis_square(), &now.cos),
                }
            }
        }
    }
}

/// Euler's equations in Euler angles.
pub struct Euler;

impl Model for Euler {
    fn about(&self) -> About {
        About {
            name: "euler",
            what: "the full equations in Euler angles, by Taylor series",
            source: "equations (39)-(41)",
            kind: Kind::Integrated,
            gives: &[],
        }
    }

    fn motion<N: Precise>(&self, task: &Task, cx: &N::Context) -> Result<Motion<N>, SceneError> {
        let s = Start::<N>::read(task, cx)?;
        if s.sin.log2_abs() == f64::NEG_INFINITY {
            return Err(singular("euler"));
        }
        let flow = Flow::new(ANGLES, in_angles)?;
        let parameters = flow.parameters(&[("a", s.a.clone()), ("pull", s.pull.clone())]);
        let start = s.in_angles();
        let mut motion = Motion::begin(task);
        let cost = follow(&flow.series, &parameters, &start, task.times, (task.tolerance, false), |stop| {
            motion.push(task, |q| s.of_angles(task, stop.y, q));
        })?;
        Ok(Motion { cost, ..motion })
    }
}

/// The motion of the axis alone: `e' = l x e`, `l' = (mgl/I_0) z x e`, with the angular momentum `l` over `I_0`, of which
/// the vertical component is constant. Four products, and nothing is singular.
pub struct Axis;

impl Model for Axis {
    fn about(&self) -> About {
        About {
            name: "axis",
            what: "the full equations of the axis and the angular momentum, by Taylor series",
            source: "dL/dt = torque; polynomial, no singular states",
            kind: Kind::Integrated,
            gives: &[THETA, PHI, U, L_Z, ENERGY],
        }
    }

    fn motion<N: Precise>(&self, task: &Task, cx: &N::Context) -> Result<Motion<N>, SceneError> {
        let s = Start::<N>::read(task, cx)?;
        if s.sin.log2_abs() == f64::NEG_INFINITY && task.wants(&[PHI]) {
            return Err(singular("axis"));
        }
        let flow = Flow::new(["x", "y", "z", "lx", "ly"], |[x, y, z, lx, ly]| {
            let [lz, pull] = ["lz", "pull"].map(|name| x.symbol(name));
            [ly * z - lz * y, lz * x - lx * z, lx * y - ly * x, -(pull * y), pull * x]
        })?;
        let (sin_phi, cos_phi) = (s.phi.apply(Func::Sin), s.phi.apply(Func::Cos));
        let [lx, ly] = s.level_momentum(&sin_phi, &cos_phi);
        let start = [s.sin.times(&sin_phi), s.sin.times(&cos_phi).negated(), s.cos.clone(), lx, ly];
        let lz = s.vertical();
        let parameters = flow.parameters(&[("lz", lz.clone()), ("pull", s.pull.clone())]);
        let mut motion = Motion::begin(task);
        let mut phi = s.phi.clone();
        let looks = task.wants(&[PHI]);
        let cost = follow(&flow.series, &parameters, &start, task.times, (task.tolerance, looks), |stop| {
            let [x, y, z, lx, ly] = stop.y else { return };
            if looks {
                // e = (sin(phi) sin(theta), -cos(phi) sin(theta), cos(theta))
                phi = onward(&phi, x, &y.negated());
            }
            if !stop.asked {
                return;
            }
            motion.push(task, |q| match q {
                THETA => {
                    let mut theta = z.clone();
                    theta.set_atan2(&x.to_the(2).plus(&y.to_the(2)).root(), z);
                    theta
                }
                PHI => phi.clone(),
                U => z.clone(),
                L_Z => s.momentum(&lz),
                _ => {
                    let along = lx.times(x).plus(&ly.times(y)).plus(&lz.times(z));
                    let square = lx.to_the(2).plus(&ly.to_the(2)).plus(&lz.to_the(2));
                    s.energy(task, &square.minus(&along.to_the(2)), z)
                }
            });
        })?;
        Ok(Motion { cost, ..motion })
    }
}

/// The full equations with a unit quaternion, free of singular states.
///
/// The angular velocity is `l + (Omega - a) e` with `l` the angular momentum over `I_0`: the top turns about its axis at
/// the constant rate `Omega - a` against a frame that turns with `l`. Its quaternion `p` is integrated, `p' = l p / 2`,
/// together with the level components of `l`, `l' = (mgl/I_0) z x e`.
pub struct Quaternion;

impl Model for Quaternion {
    fn about(&self) -> About {
        About {
            name: "quaternion",
            what: "the full equations with a unit quaternion, by Taylor series",
            source: "dL/dt = torque, q' = omega q / 2; polynomial, no singular states",
            kind: Kind::Integrated,
            gives: &[],
        }
    }

    fn motion<N: Precise>(&self, task: &Task, cx: &N::Context) -> Result<Motion<N>, SceneError> {
        let s = Start::<N>::read(task, cx)?;
        let flow = Flow::new(["w", "x", "y", "z", "lx", "ly"], |[w, x, y, z, lx, ly]| {
            // lx and ly are kept halved, and so is lz: the rates of p have no factor then.
            let [lz, pull] = ["lz", "pull"].map(|name| w.symbol(name));
            [
                -(lx * x + ly * y + lz * z),
                lx * w + ly * z - lz * y,
                ly * w + lz * x - lx * z,
                lz * w + lx * y - ly * x,
                pull * (w * x - y * z),
                pull * (x * z + w * y),
            ]
        })?;
        let half = N::from_ratio(1, 2, cx);
        let (alpha, beta) = (s.phi.plus(&s.psi).times(&half), s.phi.minus(&s.psi).times(&half));
        let (sin, cos) = (s.theta.times(&half).apply(Func::Sin), s.theta.times(&half).apply(Func::Cos));
        let [lx, ly] = s.level_momentum(&s.phi.apply(Func::Sin), &s.phi.apply(Func::Cos)).map(|l| l.times(&half));
        let start = [
            cos.times(&alpha.apply(Func::Cos)),
            sin.times(&beta.apply(Func::Cos)),
            sin.times(&beta.apply(Func::Sin)),
            cos.times(&alpha.apply(Func::Sin)),
            lx,
            ly,
        ];
        let vertical = s.vertical();
        let parameters = flow.parameters(&[("lz", vertical.times(&half)), ("pull", s.pull.clone())]);
        let looks = task.wants(&[PHI, PSI]);
        let (mut alpha, mut beta) = (alpha, beta);
        let mut motion = Motion::begin(task);
        let cost = follow(&flow.series, &parameters, &start, task.times, (task.tolerance, looks), |stop| {
            let Stop { t, y: [w, x, y, z, lx, ly], asked } = stop else { return };
            if looks {
                (alpha, beta) = (onward(&alpha, z, w), onward(&beta, y, x));
            }
            if !asked {
                return;
            }
            let (sin2, cos2) = (x.to_the(2).plus(&y.to_the(2)), w.to_the(2).plus(&z.to_the(2)));
            let u = cos2.minus(&sin2);
            motion.push(task, |q| match q {
                THETA => inclination(&sin2, &cos2),
                PHI => alpha.plus(&beta),
                PSI => alpha.minus(&beta).plus(&s.spin.minus(&s.a).times(t)),
                U => u.clone(),
                L_Z => s.momentum(&vertical),
                _ => {
                    // e = p z p*
                    let two = u.like(2.0);
                    let (ex, ey) =
                        (x.times(z).plus(&w.times(y)).times(&two), y.times(z).minus(&w.times(x)).times(&two));
                    let (lx, ly) = (lx.times(&two), ly.times(&two));
                    let along = lx.times(&ex).plus(&ly.times(&ey)).plus(&vertical.times(&u));
                    let square = lx.to_the(2).plus(&ly.to_the(2)).plus(&vertical.to_the(2));
                    s.energy(task, &square.minus(&along.to_the(2)), &u)
                }
            });
        })?;
        Ok(Motion { cost, ..motion })
    }
}

impl<N: Number> Start<N> {
    /// The level components of the angular momentum over `I_0`: `theta' n + (a - phi' cos(theta)) e` without its vertical
    /// component, where `n = (cos(phi), sin(phi), 0)` is the line of nodes.
    fn level_momentum(&self, sin_phi: &N, cos_phi: &N) -> [N; 2] {
        let out = self.a.minus(&self.phi_rate.times(&self.cos)).times(&self.sin);
        let lx = self.theta_rate.times(cos_phi).plus(&out.times(sin_phi));
        let ly = self.theta_rate.times(sin_phi).minus(&out.times(cos_phi));
        [lx, ly]
    }
}
