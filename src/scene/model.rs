//! A model of a scene's motion.

use super::precise::{Arithmetic, Precise, Values};
use super::{Scene, SceneError};
#[cfg(feature = "rug")]
use crate::number::Mpfr;
use crate::number::{Df64, Number};

/// How a model comes by its values, which decides how its error is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A formula that leaves something out: its error does not depend on the number type.
    Approximation,
    /// A closed form: its error is rounding.
    Exact,
    /// Differential equations: its error is that of the tolerance, and rounding.
    Integrated,
}

/// What a model is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct About {
    /// The name by which it is asked for.
    pub name: &'static str,
    /// One line.
    pub what: &'static str,
    /// Equation labels, a section of the DLMF, a paper.
    pub source: &'static str,
    /// How it comes by its values.
    pub kind: Kind,
    /// The quantities that it gives, by position in [`Scene::quantities`]; all of them where it is empty.
    pub gives: &'static [usize],
}

/// What a model is asked to compute.
#[derive(Clone, Copy, Debug)]
pub struct Task<'a> {
    /// The scene.
    pub scene: &'static Scene,
    /// The values of its parameters, in its order.
    pub parameters: &'a [f64],
    /// The quantities, by position in [`Scene::quantities`].
    pub quantities: &'a [usize],
    /// The times in the scene's unit, not negative and rising. The initial state is that at t = 0.
    pub times: &'a [f64],
    /// What an integrator takes for its tolerance; other models need none.
    pub tolerance: f64,
}

impl Task<'_> {
    /// The value of a parameter, by position.
    pub fn parameter<N: Number>(&self, position: usize, cx: &N::Context) -> N {
        N::from_f64(self.parameters.get(position).copied().unwrap_or(f64::NAN), cx)
    }

    /// Whether one of these quantities is asked for.
    pub fn wants(&self, quantities: &[usize]) -> bool {
        self.quantities.iter().any(|q| quantities.contains(q))
    }

    /// Makes the rows of values from a function of time, which gives a state, and one of state and quantity.
    pub fn tabulate<N: Number, S>(
        &self,
        cx: &N::Context,
        mut state: impl FnMut(&N) -> S,
        value: impl Fn(&S, usize) -> N,
    ) -> Motion<N> {
        let mut motion = Motion::begin(self);
        for &t in self.times {
            let state = state(&N::from_f64(t, cx));
            motion.push(self, |q| value(&state, q));
        }
        motion
    }
}

/// What a computation cost.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Cost {
    /// Closed forms: times at which they were evaluated. Integrators: evaluations of the right-hand side, where they
    /// have such.
    pub evaluations: usize,
    /// The steps of an integrator.
    pub steps: usize,
    /// The order of its series or method; 0 where it has none.
    pub order: usize,
}

/// The values of the quantities asked for, and their cost.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion<N> {
    /// A row for each quantity, a column for each time.
    pub rows: Vec<Vec<N>>,
    /// The cost.
    pub cost: Cost,
}

impl<N> Motion<N> {
    /// No times yet.
    pub fn begin(task: &Task) -> Self {
        let row = || Vec::with_capacity(task.times.len());
        Motion { rows: task.quantities.iter().map(|_| row()).collect(), cost: Cost::default() }
    }

    /// Adds the values at the next time.
    pub fn push(&mut self, task: &Task, value: impl Fn(usize) -> N) {
        for (row, &quantity) in self.rows.iter_mut().zip(task.quantities) {
            row.push(value(quantity));
        }
        self.cost.evaluations += 1;
    }
}

/// A model of a motion.
pub trait Model: Sync {
    /// What it is.
    fn about(&self) -> About;

    /// The quantities asked for, at the times asked for, in numbers of this context.
    ///
    /// # Errors
    /// [`SceneError`]: above all [`SceneError::Regime`] where it does not apply to the motion.
    fn motion<N: Precise>(&self, task: &Task, cx: &N::Context) -> Result<Motion<N>, SceneError>;
}

/// A [`Model`] whose number type is chosen at run time.
pub trait AnyModel: Sync {
    /// What it is.
    fn about(&self) -> About;

    /// Whether it gives all these quantities.
    fn gives(&self, quantities: &[usize]) -> bool {
        let about = self.about();
        about.gives.is_empty() || quantities.iter().all(|q| about.gives.contains(q))
    }

    /// The values asked for, in this number type, and their cost.
    ///
    /// # Errors
    /// [`SceneError`]
    fn run(&self, task: &Task, arithmetic: Arithmetic) -> Result<(Values, Cost), SceneError>;
}

impl<M: Model> AnyModel for M {
    fn about(&self) -> About {
        Model::about(self)
    }

    fn run(&self, task: &Task, arithmetic: Arithmetic) -> Result<(Values, Cost), SceneError> {
        let rising = task.times.windows(2).all(|w| matches!(w, [a, b] if a <= b));
        let begun = task.times.first().is_none_or(|t| *t >= 0.0);
        if !(rising && begun && task.times.iter().all(|t| t.is_finite())) {
            return Err(SceneError::Times);
        }
        if let Some(q) = task.quantities.iter().find(|q| !self.gives(&[**q])) {
            let what = task.scene.quantities.get(*q).map_or("it", |q| q.name).to_owned();
            return Err(SceneError::NotGiven { model: Model::about(self).name, what });
        }
        fn wrapped<N: Precise>(motion: Motion<N>) -> (Values, Cost) {
            (N::values(motion.rows), motion.cost)
        }
        Ok(match arithmetic {
            Arithmetic::Machine => wrapped(self.motion::<f64>(task, &())?),
            Arithmetic::Double => wrapped(self.motion::<Df64>(task, &())?),
            #[cfg(feature = "rug")]
            Arithmetic::Bits(bits) => wrapped(self.motion::<Mpfr>(task, &bits)?),
        })
    }
}
