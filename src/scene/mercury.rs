//! Mercury's rotation near the 3:2 resonance (section 4.7 of the notes).
//!
//! The spin axis is perpendicular to the orbit, which is Kepler's; the rotation angle `psi` of the axis of the least moment
//! is counted from the direction of the perihelion. By (486), with `epsilon = (B - A)/C`,
//!
//! `psi'' = (3/2) epsilon n^2 (a/r)^3 sin 2(f - psi)`,
//!
//! and of its average near the resonance, (494) and (495), the critical argument `sigma = 3 l - 2 psi` is a pendulum,
//! `sigma'' = -3 epsilon n^2 H sin(sigma)` with `H = (7/2) e - (123/16) e^3`. Mercury's mass beside the Sun's is left out.

mod equations;
mod pendulum;
mod start;
#[cfg(test)]
mod tests;

use super::Scene;

/// The scene `mercury`.
pub static SCENE: Scene = Scene {
    name: "mercury",
    about: "Mercury's rotation near the 3:2 resonance, its spin axis perpendicular to a Kepler orbit",
    time: "yr",
    parameters: start::PARAMETERS,
    quantities: start::QUANTITIES,
    models: &[
        &pendulum::Libration,
        &pendulum::Pendulum,
        &equations::Averaged,
        &equations::Corrected,
        &equations::RungeKutta,
        &equations::SpinOrbit,
    ],
};
