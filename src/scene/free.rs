//! The free body: a rigid body with principal moments A, B, C about its centre of mass, and no torque.
//!
//! Its attitude is the unit quaternion that turns its principal axes into inertial ones; both coincide at t = 0.

mod approximate;
mod closed;
mod equations;
mod start;
mod stepped;

use super::Scene;

/// The scene `free`.
pub static SCENE: Scene = Scene {
    name: "free",
    about: "the free body: principal moments A, B, C, no torque; its axes are the inertial ones at t = 0",
    time: "s",
    parameters: start::PARAMETERS,
    quantities: start::QUANTITIES,
    models: &[
        &approximate::Symmetric,
        &closed::Closed,
        &stepped::Split,
        &stepped::Gauss,
        &stepped::Classical,
        &stepped::Adaptive8,
        &equations::Euler,
    ],
};
