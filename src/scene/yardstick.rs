//! What the errors of models are measured against.

use super::SceneError;
use super::model::{AnyModel, Kind, Task};
use super::precise::{Arithmetic, Values};

/// The share of a task's tolerance that integrated equations may be off.
const DOUBT: f64 = 1.0 / 64.0;

/// Values that are better than those that they are compared with.
pub(super) struct Yardstick {
    /// The values.
    pub values: Values,
    /// How far they may be off themselves.
    pub doubt: f64,
    /// How they were computed, in words.
    pub what: String,
}

impl Yardstick {
    /// What values in this number type are measured against: the scene's closed form in a stronger type, or, where
    /// none applies, its fullest equations integrated in a stronger type, to a tolerance far below the task's.
    ///
    /// # Errors
    /// [`SceneError`] where nothing applies.
    pub fn of(task: &Task, arithmetic: Arithmetic) -> Result<Yardstick, SceneError> {
        let stronger = stronger(arithmetic);
        let models = task.scene.models.iter().copied().filter(|m| m.gives(task.quantities));
        let (exact, other): (Vec<_>, Vec<_>) = models.partition(|m| m.about().kind == Kind::Exact);
        let mut why = SceneError::NotGiven { model: "any", what: "these quantities".into() };
        for model in exact {
            match closed(task, model, stronger) {
                Ok(yardstick) => return Ok(yardstick),
                Err(error) => why = error,
            }
        }
        // The closed form does not apply: the fullest equations do.
        for model in other.into_iter().rev().filter(|m| m.about().kind == Kind::Integrated) {
            match integrated(task, model, stronger) {
                Ok(yardstick) => return Ok(yardstick),
                Err(error) => why = error,
            }
        }
        Err(why)
    }
}

/// The number type that decides about another.
fn stronger(arithmetic: Arithmetic) -> Arithmetic {
    match arithmetic {
        Arithmetic::Machine => Arithmetic::Double,
        #[cfg(feature = "rug")]
        Arithmetic::Double => Arithmetic::Bits(256),
        #[cfg(not(feature = "rug"))]
        Arithmetic::Double => Arithmetic::Double,
        #[cfg(feature = "rug")]
        Arithmetic::Bits(bits) => Arithmetic::Bits(bits.saturating_mul(2)),
    }
}

/// A closed form, with how far it moves when the parameters do.
fn closed(task: &Task, model: &dyn AnyModel, arithmetic: Arithmetic) -> Result<Yardstick, SceneError> {
    let (values, _) = model.run(&Task { tolerance: 0.0, ..*task }, arithmetic)?;
    if values.to_f64().iter().flatten().any(|x| !x.is_finite()) {
        let why = format!("the model `{}` gives no finite values here", model.about().name);
        return Err(SceneError::regime(why, "leave the model to be chosen"));
    }
    let by = f64::exp2(-49.0);
    let mut moves: f64 = 0.0;
    for pattern in [0b0110_1001_usize, 0b0101_0011] {
        let sign = |i: usize| if pattern >> (i % 8) & 1 == 1 { by } else { -by };
        let moved: Vec<f64> = task.parameters.iter().enumerate().map(|(i, p)| p * (1.0 + sign(i))).collect();
        // Where the moved motion is one of another kind, nothing is known of how far this one moves.
        let other = model.run(&Task { parameters: &moved, tolerance: 0.0, ..*task }, Arithmetic::Double);
        moves = moves.max(other.map_or(1.0, |(other, _)| values.distance(&other)));
    }
    // Eight units of the roundoff for one of the parameters' change.
    let doubt = moves * f64::exp2(49.0 + 3.0 - f64::from(arithmetic.bits()));
    let what = format!("the model `{}` in {}", model.about().name, arithmetic.name());
    Ok(Yardstick { values, doubt, what })
}

/// Integrated equations, with how far they move for a looser tolerance; ever tighter ones, until that is far below the
/// task's.
fn integrated(task: &Task, model: &dyn AnyModel, arithmetic: Arithmetic) -> Result<Yardstick, SceneError> {
    let least = f64::exp2(6.0 - f64::from(arithmetic.bits()));
    let run = |tolerance: f64| model.run(&Task { tolerance, ..*task }, arithmetic);
    let mut tight = (task.tolerance * 1e-6).max(least);
    let mut loose = run(tight * 64.0)?.0;
    loop {
        let values = run(tight)?.0;
        let doubt = values.distance(&loose);
        if doubt <= task.tolerance * DOUBT || tight <= least {
            let what = format!("the model `{}` in {}, tolerance {tight:.0e}", model.about().name, arithmetic.name());
            return Ok(Yardstick { values, doubt, what });
        }
        loose = values;
        tight = (tight * 1e-4).max(least);
    }
}
