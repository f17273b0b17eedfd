//! Precession and nutation of the Earth's axis under Moon and Sun (section 4.6 of the notes).
//!
//! The Earth is a rigid body with A = B < C whose axis of figure lies along its angular momentum: Andoyer's J, 0.2 arc seconds,
//! is left out, and with it the diurnal terms of (469). Moon and Sun go round on circles at constant rates, the Moon's
//! inclined to the ecliptic, with a node that goes round in 18.6 years; the frame is the ecliptic. By (441) the axis e follows
//! `e' = f (e u)(u x e)` for either body, seen in the direction u, with `f = 3 n^2 m (C - A)/(C omega)`, where n is its mean
//! motion, m its share of the mass of the two, and omega the rate of the Earth's rotation.

mod equations;
mod series;
mod start;
#[cfg(test)]
mod tests;

use super::Scene;

/// The scene `earth`.
pub static SCENE: Scene = Scene {
    name: "earth",
    about: "precession and nutation of the Earth's axis under Moon and Sun on circular orbits",
    time: "yr",
    parameters: start::PARAMETERS,
    quantities: start::QUANTITIES,
    models: &[&series::Precession, &series::Nutation, &equations::Averaged, &equations::RungeKutta, &equations::Full],
};
