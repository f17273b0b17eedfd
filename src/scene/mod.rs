//! The bodies that the notes talk about, and their motions: model only what a scene needs.
//!
//! A [`Scene`] is a body and its motion. It has parameters, quantities that may be asked for, and several models of the
//! one motion, from a leading-order formula to the full equations; [`choose`] takes the cheapest that meets the error
//! asked for, and says why. Every model computes only the quantities that are asked, in any number that is
//! [`Precise`]: f64, double-double and (feature `rug`) as many bits as are wanted.
//!
//! Promises, which one conformance suite checks of all scenes and models:
//!
//! - What a model gives agrees with every other model of its scene within the errors measured for the two.
//! - Parameters and times are machine numbers, taken as exact: every number type computes the same problem.
//! - A model that does not apply to a motion says so ([`SceneError::Regime`]) and gives no numbers.
//!
//! A new scene is a `static` [`Scene`] in a file of its own, and a line in [`SCENES`]; a new model a unit struct that is
//! a [`Model`], and a line in its scene's `models`.

mod choice;
#[cfg(test)]
mod choice_tests;
#[cfg(test)]
mod conformance;
pub mod drift;
pub mod earth;
mod error;
mod flow;
pub mod free;
mod jacobi;
pub mod mercury;
mod model;
mod path;
mod precise;
pub mod speed;
pub mod top;
mod value;
mod walk;
pub mod wobble;
mod yardstick;

pub use choice::{Outcome, Refusal, Request, choose};
pub use error::SceneError;
pub use model::{About, AnyModel, Cost, Kind, Model, Motion, Task};
pub use precise::{Arithmetic, Precise, Values};

/// A body and its motion.
pub struct Scene {
    /// The name by which it is asked for.
    pub name: &'static str,
    /// One line.
    pub about: &'static str,
    /// The unit of the times: "s", or "yr" for the Julian year of 365.25 days.
    pub time: &'static str,
    /// The parameters, those of the initial state included.
    pub parameters: &'static [Parameter],
    /// What may be asked for.
    pub quantities: &'static [Quantity],
    /// The models, from cheap to full. At least one of them is exact or integrated, and gives all quantities.
    pub models: &'static [&'static dyn AnyModel],
}

/// A number that a motion depends on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameter {
    /// The name by which it is set.
    pub name: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// Its value where none is set.
    pub default: f64,
    /// One line.
    pub about: &'static str,
}

impl Parameter {
    /// A parameter: its name, unit, default, and one line.
    const fn new(name: &'static str, unit: &'static str, default: f64, about: &'static str) -> Self {
        Parameter { name, unit, default, about }
    }
}

/// A function of time that a scene can be asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Quantity {
    /// The name by which it is asked for.
    pub name: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// One line.
    pub about: &'static str,
}

impl Quantity {
    /// A quantity: its name, unit, and one line.
    const fn new(name: &'static str, unit: &'static str, about: &'static str) -> Self {
        Quantity { name, unit, about }
    }
}

/// All scenes.
pub static SCENES: &[&Scene] = &[&top::SCENE, &free::SCENE, &earth::SCENE, &mercury::SCENE, &wobble::SCENE];

/// The scene of this name.
///
/// # Errors
/// [`SceneError::Unknown`], with the names there are.
pub fn scene(name: &str) -> Result<&'static Scene, SceneError> {
    let found = SCENES.iter().copied().find(|s| s.name == name);
    found.ok_or_else(|| SceneError::unknown("scene", name, SCENES.iter().map(|s| s.name)))
}

impl Scene {
    /// The position of a quantity.
    ///
    /// # Errors
    /// [`SceneError::Unknown`], with the names there are.
    pub fn quantity(&self, name: &str) -> Result<usize, SceneError> {
        let found = self.quantities.iter().position(|q| q.name == name);
        found.ok_or_else(|| SceneError::unknown("quantity", name, self.quantities.iter().map(|q| q.name)))
    }

    /// The position of a parameter.
    ///
    /// # Errors
    /// [`SceneError::Unknown`], with the names there are.
    pub fn parameter(&self, name: &str) -> Result<usize, SceneError> {
        let found = self.parameters.iter().position(|p| p.name == name);
        found.ok_or_else(|| SceneError::unknown("parameter", name, self.parameters.iter().map(|p| p.name)))
    }

    /// The model of this name.
    ///
    /// # Errors
    /// [`SceneError::Unknown`], with the names there are.
    pub fn model(&self, name: &str) -> Result<&'static dyn AnyModel, SceneError> {
        let found = self.models.iter().copied().find(|m| m.about().name == name);
        found.ok_or_else(|| SceneError::unknown("model", name, self.models.iter().map(|m| m.about().name)))
    }

    /// The default values of the parameters.
    pub fn defaults(&self) -> Vec<f64> {
        self.parameters.iter().map(|p| p.default).collect()
    }
}

impl std::fmt::Debug for Scene {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Scene({})", self.name)
    }
}
