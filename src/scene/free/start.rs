//! The scene's parameters and quantities, read in any number type.

use super::super::value::V;
use super::super::{Parameter, Quantity, SceneError, Task};
use crate::number::Number;

/// The parameters.
pub const PARAMETERS: &[Parameter] = &[
    Parameter::new("A", "kg m^2", 1.0, "principal moment of inertia about the first axis"),
    Parameter::new("B", "kg m^2", 2.0, "principal moment of inertia about the second axis"),
    Parameter::new("C", "kg m^2", 3.0, "principal moment of inertia about the third axis"),
    Parameter::new("omega_1", "rad/s", 0.4, "angular velocity about the first axis at t = 0"),
    Parameter::new("omega_2", "rad/s", 0.3, "angular velocity about the second axis at t = 0"),
    Parameter::new("omega_3", "rad/s", 1.0, "angular velocity about the third axis at t = 0"),
];

/// Positions of the quantities, after the angular velocity.
pub const ATTITUDE: [usize; 4] = [3, 4, 5, 6];
pub const THETA: usize = 7;
pub const ENERGY: usize = 8;
pub const MOMENTUM: usize = 9;

/// The quantities.
pub const QUANTITIES: &[Quantity] = &[
    Quantity::new("omega_1", "rad/s", "angular velocity about the first axis"),
    Quantity::new("omega_2", "rad/s", "angular velocity about the second axis"),
    Quantity::new("omega_3", "rad/s", "angular velocity about the third axis"),
    Quantity::new("q_0", "1", "attitude: the scalar part of the quaternion from body axes to inertial axes"),
    Quantity::new("q_1", "1", "attitude: its first component"),
    Quantity::new("q_2", "1", "attitude: its second component"),
    Quantity::new("q_3", "1", "attitude: its third component"),
    Quantity::new("theta", "rad", "inclination of the third axis from the angular momentum"),
    Quantity::new("energy", "J", "kinetic energy, conserved"),
    Quantity::new("G", "kg m^2/s", "length of the angular momentum, conserved"),
];

/// The body and its angular velocity at t = 0, in its principal axes.
#[derive(Clone, Debug)]
pub struct Start<N> {
    /// A, B, C.
    pub moments: [V<N>; 3],
    /// The angular velocity.
    pub omega: [V<N>; 3],
}

impl<N: Number> Start<N> {
    /// Reads the parameters.
    ///
    /// # Errors
    /// [`SceneError::Parameter`] where there is no such body.
    pub fn read(task: &Task, cx: &N::Context) -> Result<Self, SceneError> {
        let at = |position: usize| V(task.parameter::<N>(position, cx));
        let moments = [0, 1, 2].map(at);
        for (moment, named) in moments.iter().zip(PARAMETERS) {
            let value = moment.0.to_f64();
            if value.is_nan() || value <= 0.0 {
                let what = format!("the moment of inertia {} is {value}", named.name);
                return Err(SceneError::parameter(what, "give it a positive value"));
            }
        }
        Ok(Start { moments, omega: [3, 4, 5].map(at) })
    }

    /// The quantities that the angular velocity alone gives, in body axes.
    pub fn quantity(&self, q: usize, omega: &[V<N>; 3]) -> N {
        let momentum = momentum(&self.moments, omega);
        let [x, y, z] = &momentum;
        match q {
            THETA => (x.square() + y.square()).root().atan2(z).0,
            ENERGY => {
                let [x, y, z] = [0, 1, 2].map(|i| &momentum[i] * &omega[i]);
                ((x + y + z) * 0.5).0
            }
            MOMENTUM => length(&momentum).0,
            q => omega.get(q).map_or_else(|| x.0.like(f64::NAN), |w| w.0.clone()),
        }
    }
}

/// The angular momentum in body axes.
pub fn momentum<N: Number>(moments: &[V<N>; 3], omega: &[V<N>; 3]) -> [V<N>; 3] {
    [0, 1, 2].map(|i| &moments[i] * &omega[i])
}

/// The length of a vector.
pub fn length<N: Number>([x, y, z]: &[V<N>; 3]) -> V<N> {
    (x.square() + y.square() + z.square()).root()
}

/// The product of two quaternions.
pub fn product<N: Number>([a, b, c, d]: &[V<N>; 4], [w, x, y, z]: &[V<N>; 4]) -> [V<N>; 4] {
    [
        a * w - b * x - c * y - d * z,
        a * x + b * w + c * z - d * y,
        a * y + c * w + d * x - b * z,
        a * z + d * w + b * y - c * x,
    ]
}

/// The conjugate of a quaternion.
pub fn conjugate<N: Number>([w, x, y, z]: &[V<N>; 4]) -> [V<N>; 4] {
    [w.clone(), -x.clone(), -y.clone(), -z.clone()]
}

/// The quaternion of the turn by the vector `rate * t`.
pub fn turn<N: Number>(rate: &[V<N>; 3], t: &V<N>) -> [V<N>; 4] {
    let speed = length(rate);
    let half = &speed * t * 0.5;
    let sin = half.sin();
    // At rest there is no axis, and no turn.
    let along = |x: &V<N>| if speed.is_zero() { x.like(0.0) } else { x / &speed * &sin };
    let [x, y, z] = rate;
    [half.cos(), along(x), along(y), along(z)]
}
