//! The scene's parameters and quantities, read in any number type.

use super::super::value::V;
use super::super::{Parameter, Quantity, SceneError, Task};
use crate::number::Number;

/// The parameters. The orbit is that of the planetary fact sheet of the NSSDC (a sidereal year of 87.969 days, e = 0.2056);
/// `epsilon` is Margot et al., J. Geophys. Res. 117 (2012) E00L09: (B - A)/C_m = 2.18e-4 for the mantle times C_m/C = 0.45.
pub const PARAMETERS: &[Parameter] = &[
    Parameter::new("n", "rad/yr", 26.088, "mean motion of the orbit"),
    Parameter::new("e", "1", 0.2056, "eccentricity of the orbit"),
    Parameter::new("epsilon", "1", 9.8e-5, "(B - A)/C, the equatorial asymmetry of the moments of inertia"),
    Parameter::new("l_0", "rad", 0.0, "mean anomaly at t = 0"),
    Parameter::new("sigma_0", "rad", 0.5, "critical argument at t = 0"),
    Parameter::new("spin_0", "1", 1.5, "angular velocity of the rotation at t = 0, in units of n"),
];

/// Positions of the quantities.
pub const SIGMA: usize = 0;
pub const LIBRATION: usize = 1;
pub const PSI: usize = 2;
pub const SPIN: usize = 3;

/// The quantities.
pub const QUANTITIES: &[Quantity] = &[
    Quantity::new("sigma", "rad", "critical argument 3 l - 2 psi"),
    Quantity::new("libration", "rad", "psi - (3/2) l, the rotation beside the resonant one"),
    Quantity::new("psi", "rad", "rotation angle of the axis of the least moment from the direction of the perihelion"),
    Quantity::new("spin", "1", "angular velocity of the rotation in units of n; 3/2 at the resonance"),
];

/// The orbit, the body and its rotation at t = 0.
#[derive(Clone, Debug)]
pub struct Start<N> {
    pub n: V<N>,
    pub e: V<N>,
    pub epsilon: V<N>,
    /// Mean anomaly.
    pub mean: V<N>,
    pub sigma: V<N>,
    /// The rotation's rate beside the resonant one, in units of n.
    pub excess: V<N>,
}

impl<N: Number> Start<N> {
    /// Reads the parameters.
    ///
    /// # Errors
    /// [`SceneError::Parameter`] where there is no such orbit.
    pub fn read(task: &Task, cx: &N::Context) -> Result<Self, SceneError> {
        let [n, e, epsilon, mean, sigma, spin] = [0, 1, 2, 3, 4, 5].map(|at| V(task.parameter::<N>(at, cx)));
        let (rate, eccentricity) = (n.0.to_f64(), e.0.to_f64());
        if rate.is_nan() || rate <= 0.0 {
            return Err(SceneError::parameter(format!("the mean motion n is {rate}"), "give it a positive value"));
        }
        if !(0.0..1.0).contains(&eccentricity) {
            let what = format!("the eccentricity e is {eccentricity}");
            return Err(SceneError::parameter(what, "give it a value from 0 to below 1: the orbit is an ellipse"));
        }
        Ok(Start { n, e, epsilon, mean, sigma, excess: spin - 1.5 })
    }

    /// The quantities, from `t`, from `psi - (3/2) l` and its rate in units of n.
    pub fn quantity(&self, q: usize, t: &V<N>, libration: &V<N>, excess: &V<N>) -> N {
        match q {
            SIGMA => libration.0.times(&t.0.like(-2.0)),
            LIBRATION => libration.0.clone(),
            PSI => (self.mean_anomaly(t) * 1.5 + libration).0,
            SPIN => (excess.clone() + 1.5).0,
            _ => t.0.like(f64::NAN),
        }
    }

    /// `l`.
    pub fn mean_anomaly(&self, t: &V<N>) -> V<N> {
        &self.mean + &self.n * t
    }

    /// The eccentric anomaly at t = 0, by Newton's method on Kepler's equation, E - e sin E = l.
    pub fn eccentric_anomaly(&self) -> V<N> {
        // From here it converges for every ellipse (Danby 1987).
        let mut anomaly = &self.mean + &self.e * self.mean.sin().sign() * 0.85;
        let mut before = f64::INFINITY;
        for _ in 0..200 {
            let error = &anomaly - &self.e * anomaly.sin() - &self.mean;
            let step = error / (anomaly.like(1.0) - &self.e * anomaly.cos());
            let size = step.0.log2_abs();
            anomaly = anomaly - step;
            // Far away it may go further before it comes nearer.
            if size == f64::NEG_INFINITY || size < -20.0 && size >= before {
                break;
            }
            before = size;
        }
        anomaly
    }

    /// The frequency of small librations in units of n, `sqrt(3 epsilon H)`.
    ///
    /// # Errors
    /// [`SceneError::Regime`] where `sigma = 0` is not the stable one.
    pub fn frequency(&self, h: &V<N>, model: &str) -> Result<V<N>, SceneError> {
        let square = &self.epsilon * h * 3.0;
        let value = square.0.to_f64();
        if value.is_nan() || value <= 0.0 {
            return Err(SceneError::regime(
                format!("epsilon H is {:e}: sigma = 0 is no stable equilibrium of the model `{model}`", value / 3.0),
                "use the model `spin-orbit`, or epsilon > 0 and e between 0 and 0.67",
            ));
        }
        Ok(square.root())
    }

    /// `H = (7/2) e - (123/16) e^3`, as in (493).
    pub fn strength(&self) -> V<N> {
        &self.e * (self.e.like(3.5) - self.e.square() * 7.6875)
    }
}
