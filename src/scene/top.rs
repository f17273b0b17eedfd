//! The heavy symmetric top: a rigid body with a fixed point on its axis of symmetry, in uniform gravity.
//!
//! Euler angles are zxz: the precession angle `phi` about the vertical, the inclination `theta` of the axis from the
//! vertical, the rotation `psi` about the axis. The equations of motion are Euler's equations (39)-(41) of the gyroscope
//! notes, solved for the angular accelerations; `Omega` is the spin `omega_zeta = phi' cos(theta) + psi'`, a constant of
//! the motion by (41).

mod approximate;
mod closed;
mod equations;
mod start;
mod stepped;

use super::Scene;
use crate::integrator::System;
use std::f64::consts::TAU;

/// The scene `top`.
pub static SCENE: Scene = Scene {
    name: "top",
    about: "the heavy symmetric top: a body with a fixed point on its axis of symmetry, in uniform gravity",
    time: "s",
    parameters: start::PARAMETERS,
    quantities: start::QUANTITIES,
    models: &[
        &approximate::Slow,
        &approximate::Fast,
        &approximate::Nutation,
        &closed::Closed,
        &equations::Reduced,
        &equations::Axis,
        &equations::Quaternion,
        &stepped::Classical,
        &stepped::Gauss,
        &stepped::Adaptive8,
        &equations::Euler,
    ],
};

/// A heavy symmetric top.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeavyTop {
    /// `I_0`: the moment of inertia about any axis through the fixed point across the axis of symmetry, in kg m^2.
    pub transverse: f64,
    /// `I_1`: the moment of inertia about the axis of symmetry, in kg m^2.
    pub axial: f64,
    /// `m g l`: the torque of gravity when the axis lies level, in N m.
    pub torque: f64,
}

/// A state of the top: Euler angles in rad, their rates in rad/s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TopState {
    /// The precession angle.
    pub phi: f64,
    /// The inclination of the axis from the vertical.
    pub theta: f64,
    /// The rotation about the axis.
    pub psi: f64,
    /// The rate of precession.
    pub phi_rate: f64,
    /// The rate of inclination.
    pub theta_rate: f64,
    /// The rate of rotation relative to the line of nodes.
    pub psi_rate: f64,
}

impl TopState {
    /// The axis inclined by `theta` and momentarily without change of inclination, precessing at `precession`, with
    /// spin `spin` about the axis (`omega_zeta`, from which the rate of `psi` follows).
    pub fn turning(theta: f64, precession: f64, spin: f64) -> Self {
        let psi_rate = spin - precession * theta.cos();
        TopState { phi: 0.0, theta, psi: 0.0, phi_rate: precession, theta_rate: 0.0, psi_rate }
    }

    /// The spin `omega_zeta = phi' cos(theta) + psi'`, equation (42).
    pub fn spin(&self) -> f64 {
        self.phi_rate * self.theta.cos() + self.psi_rate
    }

    /// The state as `[phi, theta, psi, phi', theta', psi']`.
    pub fn to_vector(&self) -> [f64; 6] {
        [self.phi, self.theta, self.psi, self.phi_rate, self.theta_rate, self.psi_rate]
    }

    /// Reads `[phi, theta, psi, phi', theta', psi']`; `None` if there are not six components.
    pub fn from_vector(y: &[f64]) -> Option<Self> {
        let &[phi, theta, psi, phi_rate, theta_rate, psi_rate] = y else { return None };
        Some(TopState { phi, theta, psi, phi_rate, theta_rate, psi_rate })
    }
}

/// The rates at which the top precesses without nutation, in rad/s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SteadyPrecession {
    /// The root that tends to `m g l / (I_1 Omega)` for fast spin.
    pub slow: f64,
    /// The root that tends to `I_1 Omega / (I_0 cos theta)`; none where the axis is level, and the equation linear.
    pub fast: Option<f64>,
}

/// The spin is too slow for steady precession at this inclination: the bound (69) is violated.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error, miette::Diagnostic)]
#[error("a spin of {spin} rad/s is too slow for steady precession at {theta} rad: at least {least} rad/s are needed")]
#[diagnostic(help("spin the top faster, or incline it further"))]
pub struct TooSlow {
    /// The inclination.
    pub theta: f64,
    /// The spin.
    pub spin: f64,
    /// The least spin for which the roots are real, `2 sqrt(I_0 m g l cos theta) / I_1`.
    pub least: f64,
}

/// The nutation of an exact motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nutation {
    /// `cos theta` at the turning point where the motion began.
    pub from: f64,
    /// `cos theta` at the other turning point.
    pub to: f64,
    /// The angular frequency of `theta`, in rad/s.
    pub frequency: f64,
}

impl Nutation {
    /// The time from one visit to a turning point to the next, in s.
    pub fn period(&self) -> f64 {
        TAU / self.frequency
    }
}

impl HeavyTop {
    /// `[phi'', theta'', psi'']` in rad/s^2, from equations (39)-(41).
    ///
    /// Not finite where `sin theta = 0`: there the Euler angles do not determine the motion.
    pub fn accelerations(&self, state: &TopState) -> [f64; 3] {
        let (sin, cos) = state.theta.sin_cos();
        let (phi_rate, theta_rate) = (state.phi_rate, state.theta_rate);
        let axial = self.axial * state.spin();
        let theta =
            sin * (self.transverse * phi_rate * phi_rate * cos - axial * phi_rate + self.torque) / self.transverse;
        let phi = theta_rate * (axial - 2.0 * self.transverse * phi_rate * cos) / (self.transverse * sin);
        let psi = phi_rate * theta_rate * sin - phi * cos;
        [phi, theta, psi]
    }

    /// The vertical component of the angular momentum, in kg m^2/s, equation (52).
    pub fn vertical_momentum(&self, state: &TopState) -> f64 {
        let (sin, cos) = state.theta.sin_cos();
        self.transverse * state.phi_rate * sin * sin + self.axial * state.spin() * cos
    }

    /// The mechanical energy in J, zero potential at the height of the fixed point, equation (66).
    pub fn energy(&self, state: &TopState) -> f64 {
        let (sin, cos) = state.theta.sin_cos();
        let across = state.theta_rate.powi(2) + (state.phi_rate * sin).powi(2);
        self.transverse / 2.0 * across + self.axial / 2.0 * state.spin().powi(2) + self.torque * cos
    }

    /// The roots of `I_0 p^2 cos(theta) - I_1 Omega p + m g l = 0`, equation (67).
    ///
    /// The larger root is computed without cancellation and the smaller one from the product of the two, so that both
    /// are accurate however fast the spin.
    ///
    /// # Errors
    /// [`TooSlow`] where the roots are not real.
    pub fn steady_precession(&self, theta: f64, spin: f64) -> Result<SteadyPrecession, TooSlow> {
        let a = self.transverse * theta.cos();
        let b = self.axial * spin;
        let discriminant = b * b - 4.0 * a * self.torque;
        if discriminant < 0.0 {
            let least = 2.0 * (a * self.torque).sqrt() / self.axial;
            return Err(TooSlow { theta, spin, least });
        }
        let larger = (b + discriminant.sqrt().copysign(b)) / 2.0;
        Ok(SteadyPrecession { slow: self.torque / larger, fast: (a != 0.0).then(|| larger / a) })
    }

    /// The approximation `I_1 Omega / (I_0 cos theta)` of fast precession, equation (71).
    pub fn fast_approximation(&self, theta: f64, spin: f64) -> f64 {
        self.axial * spin / (self.transverse * theta.cos())
    }

    /// The approximation `m g l / (I_1 Omega)` of slow precession, equation (72).
    pub fn slow_approximation(&self, spin: f64) -> f64 {
        self.torque / (self.axial * spin)
    }

    /// The approximation `I_1 Omega / I_0` of the nutation's angular frequency, equation (82).
    pub fn nutation_approximation(&self, spin: f64) -> f64 {
        self.axial * spin / self.transverse
    }

    /// The angular frequency of an infinitesimal nutation about precession at the steady rate `p`.
    ///
    /// With `L_z` and the spin held fixed, `theta'' = sin(theta) h(theta)` where
    /// `h = p^2 cos(theta) - a p + m g l / I_0`, `a = I_1 Omega / I_0`, and (52) makes `p` a function of `theta` with
    /// `dp/dtheta = (a - 2 p cos(theta)) / sin(theta)`. Steady precession is `h = 0`, and there
    ///
    /// `omega^2 = -sin(theta) dh/dtheta = (a - 2 p cos(theta))^2 + p^2 sin^2(theta)`.
    pub fn linear_nutation_frequency(&self, theta: f64, precession: f64, spin: f64) -> f64 {
        let (sin, cos) = theta.sin_cos();
        let a = self.nutation_approximation(spin);
        (a - 2.0 * precession * cos).hypot(precession * sin)
    }

    /// The nutation of the exact motion that begins at [`TopState::turning`]`(theta, precession, spin)`, in closed form.
    ///
    /// With `u = cos(theta)`, (52) and (66) give `u'^2 = f(u)`, a cubic that vanishes at the initial `u_0`. With
    /// `w = u_0 - u`, `a = I_1 Omega / I_0`, `b = 2 m g l / I_0` and `s = sin(theta_0)`,
    ///
    /// `f = w (G - H w - b w^2)`, `G = s^2 (b + 2 p^2 u_0 - 2 p a)`, `H = a^2 + p^2 s^2 - 2 b u_0`,
    ///
    /// so that the other turning point is a root of a quadratic, and the elliptic integral for the period is an
    /// arithmetic-geometric mean: `omega = agm(sqrt(q), sqrt(q + b w_1))`, `q` being the larger root of
    /// `q^2 - H q - b G = 0` and `w_1 = G / q` the turning point. No difference of nearly equal numbers is formed, and a
    /// nutation of no amplitude (`G = 0`) has the linear frequency `sqrt(H)`.
    ///
    /// `None` where the axis stands upright (`sin theta = 0`), or the motion does not return (a top that falls from, or
    /// creeps towards, an unstable upright position).
    pub fn nutation(&self, theta: f64, precession: f64, spin: f64) -> Option<Nutation> {
        let (s, u) = theta.sin_cos();
        let (a, b, p) = (self.nutation_approximation(spin), 2.0 * self.torque / self.transverse, precession);
        let g = s * s * (b + 2.0 * p * p * u - 2.0 * p * a);
        let h = a * a + (p * s).powi(2) - 2.0 * b * u;
        let root = (h * h + 4.0 * b * g).sqrt();
        let q = if h >= 0.0 { (h + root) / 2.0 } else { 2.0 * b * g / (root - h) };
        let w = g / q;
        let frequency = agm(q.sqrt(), (q + b * w).sqrt());
        let moves = s != 0.0 && frequency.is_finite() && frequency > 0.0;
        moves.then_some(Nutation { from: u, to: u - w, frequency })
    }
}

impl System<f64> for HeavyTop {
    fn derivative(&self, _: &f64, y: &[f64], slope: &mut [f64]) {
        // A state of another length is nobody's motion: it has no derivative.
        let Some(state) = TopState::from_vector(y) else { return slope.fill(f64::NAN) };
        let [phi, theta, psi] = self.accelerations(&state);
        slope.copy_from_slice(&[state.phi_rate, state.theta_rate, state.psi_rate, phi, theta, psi]);
    }
}

/// The arithmetic-geometric mean of two positive numbers; NaN otherwise.
fn agm(mut a: f64, mut b: f64) -> f64 {
    // Convergence is quadratic: 40 rounds are more than any ratio of finite numbers needs.
    for _ in 0..40 {
        if (a - b).abs() <= 2.0 * f64::EPSILON * a {
            break;
        }
        (a, b) = ((a + b) / 2.0, (a * b).sqrt());
    }
    (a + b) / 2.0
}

#[cfg(test)]
mod tests;
