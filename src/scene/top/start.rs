//! The scene's parameters and initial state, read in any number type.

use super::super::{Parameter, Quantity, SceneError, Task};
use crate::number::{Func, Number};

/// Positions of the parameters.
const TRANSVERSE: usize = 0;
const AXIAL: usize = 1;
const TORQUE: usize = 2;
const SPIN: usize = 3;
const THETA_0: usize = 4;
const THETA_RATE: usize = 5;
const PHI_RATE: usize = 6;
const PHI_0: usize = 7;
const PSI_0: usize = 8;

/// The parameters.
pub const PARAMETERS: &[Parameter] = &[
    Parameter::new("I_0", "kg m^2", 1.0, "moment of inertia across the axis, about the fixed point"),
    Parameter::new("I_1", "kg m^2", 0.5, "moment of inertia about the axis"),
    Parameter::new("mgl", "N m", 1.0, "torque of gravity when the axis lies level"),
    Parameter::new("omega_zeta", "rad/s", 5.0, "spin: the angular velocity about the axis, a constant"),
    Parameter::new("theta_0", "rad", std::f64::consts::FRAC_PI_3, "inclination of the axis from the vertical at t = 0"),
    Parameter::new("theta_rate", "rad/s", 0.0, "rate of inclination at t = 0"),
    Parameter::new("phi_rate", "rad/s", 0.0, "rate of precession at t = 0"),
    Parameter::new("phi_0", "rad", 0.0, "precession angle at t = 0"),
    Parameter::new("psi_0", "rad", 0.0, "rotation about the axis at t = 0"),
];

/// Positions of the quantities.
pub const THETA: usize = 0;
pub const PHI: usize = 1;
pub const PSI: usize = 2;
pub const U: usize = 3;
pub const L_Z: usize = 4;
pub const ENERGY: usize = 5;

/// The quantities.
pub const QUANTITIES: &[Quantity] = &[
    Quantity::new("theta", "rad", "inclination of the axis from the vertical, from 0 to pi"),
    Quantity::new("phi", "rad", "precession angle, continuous beyond a turn"),
    Quantity::new("psi", "rad", "rotation about the axis, continuous beyond a turn"),
    Quantity::new("u", "1", "cos theta"),
    Quantity::new("L_z", "kg m^2/s", "vertical component of the angular momentum, conserved"),
    Quantity::new("energy", "J", "mechanical energy, zero potential at the fixed point, conserved"),
];

/// The top and its initial state.
#[derive(Clone, Debug)]
pub struct Start<N> {
    /// `I_0`.
    pub transverse: N,
    /// `mgl / I_0`: what acts on the axis.
    pub pull: N,
    /// `a = I_1 Omega / I_0`: the spin's share in the angular momentum, over `I_0`.
    pub a: N,
    /// `Omega`.
    pub spin: N,
    /// The inclination.
    pub theta: N,
    /// Its sine.
    pub sin: N,
    /// Its cosine.
    pub cos: N,
    /// The rate of inclination.
    pub theta_rate: N,
    /// The rate of precession.
    pub phi_rate: N,
    /// The precession angle.
    pub phi: N,
    /// The rotation about the axis.
    pub psi: N,
}

impl<N: Number> Start<N> {
    /// Reads the parameters.
    ///
    /// # Errors
    /// [`SceneError::Parameter`] where there is no such top.
    pub fn read(task: &Task, cx: &N::Context) -> Result<Self, SceneError> {
        let at = |position: usize| task.parameter::<N>(position, cx);
        let [transverse, axial, torque] = [TRANSVERSE, AXIAL, TORQUE].map(at);
        for (position, least) in [(TRANSVERSE, false), (AXIAL, true), (TORQUE, true)] {
            let value = at(position).to_f64();
            if !(value > 0.0 || least && value == 0.0) {
                let name = PARAMETERS[position].name;
                return Err(SceneError::parameter(
                    format!("the parameter {name} is {value}: no top has that"),
                    format!("give {name} a positive value; count theta from below for a mass below the fixed point"),
                ));
            }
        }
        let theta = at(THETA_0);
        if !(0.0..=std::f64::consts::PI).contains(&theta.to_f64()) {
            let what = format!("the inclination theta_0 is {} rad", theta.to_f64());
            return Err(SceneError::parameter(what, "take it from 0 to pi, and turn phi_0 by pi for the other side"));
        }
        let spin = at(SPIN);
        Ok(Start {
            a: axial.times(&spin).over(&transverse),
            pull: torque.over(&transverse),
            sin: theta.apply(Func::Sin),
            cos: theta.apply(Func::Cos),
            theta_rate: at(THETA_RATE),
            phi_rate: at(PHI_RATE),
            phi: at(PHI_0),
            psi: at(PSI_0),
            transverse,
            spin,
            theta,
        })
    }

    /// `L_z` and the energy of a state: `square` is the square of the axis' velocity, `theta'^2 + phi'^2 sin^2 theta`.
    pub fn energy(&self, task: &Task, square: &N, u: &N) -> N {
        let axial = task.parameter::<N>(AXIAL, &u.context());
        let kinetic = square.times(&self.transverse).plus(&axial.times(&self.spin.to_the(2)));
        kinetic.times(&u.like(0.5)).plus(&self.pull.times(&self.transverse).times(u))
    }

    /// `L_z` from `L_z / I_0`.
    pub fn momentum(&self, over_transverse: &N) -> N {
        over_transverse.times(&self.transverse)
    }

    /// `L_z / I_0` of the initial state.
    pub fn vertical(&self) -> N {
        self.phi_rate.times(&self.sin.to_the(2)).plus(&self.a.times(&self.cos))
    }

    /// The square of the axis' velocity in the initial state.
    pub fn axis_square(&self) -> N {
        self.theta_rate.to_the(2).plus(&self.phi_rate.times(&self.sin).to_the(2))
    }
}
