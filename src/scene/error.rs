//! Why a scene gives no numbers.

use crate::integrator::IntegrationError;
use crate::integrator::taylor::NoRecurrence;

/// Why a scene gives no numbers.
#[derive(Clone, Debug, PartialEq, thiserror::Error, miette::Diagnostic)]
pub enum SceneError {
    /// A name that does not exist.
    #[error("there is no {what} `{name}`")]
    #[diagnostic(help("expected one of: {known}"))]
    Unknown {
        /// What the name was to be of.
        what: &'static str,
        /// The name.
        name: String,
        /// The names there are.
        known: String,
    },
    /// A parameter has a value that no body has.
    #[error("{what}")]
    #[diagnostic(help("{help}"))]
    Parameter {
        /// What is wrong with which parameter.
        what: String,
        /// What to do.
        help: String,
    },
    /// A model does not apply to the motion.
    #[error("{why}")]
    #[diagnostic(help("{help}"))]
    Regime {
        /// Why.
        why: String,
        /// What to use instead.
        help: String,
    },
    /// A model does not give a quantity, or not in this number type.
    #[error("the model `{model}` does not give {what}")]
    #[diagnostic(help("leave the model to be chosen, or take another one"))]
    NotGiven {
        /// The model.
        model: &'static str,
        /// The quantity, or the number type.
        what: String,
    },
    /// The times are not in order.
    #[error("the times must be finite, not negative and in rising order")]
    #[diagnostic(help("sort the times; the motion begins at t = 0"))]
    Times,
    /// The error asked for cannot be met.
    #[error("no model meets an error of {asked:e}{best}")]
    #[diagnostic(help("{help}"))]
    OutOfReach {
        /// The error asked for.
        asked: f64,
        /// What can be reached.
        best: String,
        /// What to do.
        help: String,
    },
    /// An integration stopped before its end.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Integration(#[from] IntegrationError),
    /// Equations of motion without a Taylor series.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Series(#[from] NoRecurrence),
}

impl SceneError {
    /// A name that is not among those there are.
    pub(crate) fn unknown(what: &'static str, name: &str, known: impl Iterator<Item = &'static str>) -> Self {
        let known = known.collect::<Vec<_>>().join(", ");
        SceneError::Unknown { what, name: name.to_owned(), known }
    }

    /// A model that does not apply.
    pub(crate) fn regime(why: impl Into<String>, help: impl Into<String>) -> Self {
        SceneError::Regime { why: why.into(), help: help.into() }
    }

    /// A parameter that no body has.
    pub(crate) fn parameter(what: impl Into<String>, help: impl Into<String>) -> Self {
        SceneError::Parameter { what: what.into(), help: help.into() }
    }
}
