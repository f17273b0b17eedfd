//! The wobble of the not quite rigid Earth: free nutation in resonance with the deformation (section 4.8 of the notes).
//!
//! The body turns without torque; its products of inertia D and E change slowly at a frequency `nu` near that of the free
//! nutation. With the angular momentum `G (l_1, l_2, l_3)` about the body's axes, `l_1 = sin J sin l`, `l_2 = sin J cos l`,
//! the kinetic energy (511) gives `l' = l x omega`; the resonant term alone, (530), gives (531) and (532), in which
//! `ell - nu t - beta` has two equilibria. Near them the wobble has the period of the deformation, Chandler's, and not
//! Euler's.

mod closed;
mod equations;
mod start;
#[cfg(test)]
mod tests;

use super::Scene;

/// The scene `wobble`.
pub static SCENE: Scene = Scene {
    name: "wobble",
    about: "the wobble of the not quite rigid Earth, in resonance with its deformation",
    time: "yr",
    parameters: start::PARAMETERS,
    quantities: start::QUANTITIES,
    models: &[&closed::Equilibrium, &closed::Linear, &equations::Averaged, &equations::RungeKutta, &equations::Full],
};
