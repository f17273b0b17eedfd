//! The scene's parameters and quantities, read in any number type.

use super::super::value::V;
use super::super::{Parameter, Quantity, SceneError, Task};
use crate::number::{Func, Number};

/// The parameters. `H`, `alpha` and `J_0` are those of (536) and (537); `nu` is -1/434 of `G/A`, by (537);
/// the asymmetry is that of the Earth's gravity field, C_22 and S_22 of EGM96.
pub const PARAMETERS: &[Parameter] = &[
    Parameter::new("Omega", "rad/yr", 2301.22, "G/C, the rate of the rotation (366.25 sidereal days a year)"),
    Parameter::new("H", "1", 0.003_289_474, "(C - A)/A, the dynamical flattening"),
    Parameter::new("asymmetry", "1", 2.2e-5, "(B - A)/A, the equatorial asymmetry of the mean figure"),
    Parameter::new("alpha", "1", 0.95e-9, "amplitude of the resonant part of D/B and E/A"),
    Parameter::new("counter", "1", 0.0, "amplitude of the part that goes round the other way, in units of alpha"),
    Parameter::new("nu", "rad/yr", -5.319_86, "frequency of the deformation"),
    Parameter::new("beta", "rad", 0.0, "its phase at t = 0"),
    Parameter::new(
        "J_0",
        "rad",
        9.696e-7,
        "angle from the angular momentum to the axis of figure at t = 0 (0.2 arc seconds)",
    ),
    Parameter::new(
        "l_0",
        "rad",
        std::f64::consts::PI,
        "Andoyer's angle l at t = 0; beta + pi in the stable equilibrium",
    ),
];

/// Positions of the quantities.
pub const J: usize = 2;

/// The quantities.
pub const QUANTITIES: &[Quantity] = &[
    Quantity::new("m_1", "1", "first component of the angular momentum about the body's axes, in units of G"),
    Quantity::new("m_2", "1", "second component"),
    Quantity::new("J", "rad", "angle from the angular momentum to the axis of figure"),
];

/// The body, its deformation and its rotation at t = 0.
#[derive(Clone, Debug)]
pub struct Start<N> {
    pub omega: V<N>,
    /// C/A - 1 and C/B - 1.
    pub flattening: [V<N>; 2],
    pub alpha: V<N>,
    pub counter: V<N>,
    pub nu: V<N>,
    pub beta: V<N>,
    /// `l_2` and `l_1`: cos l and sin l times sin J.
    pub pole: [V<N>; 2],
    /// The size of the wobble: one tolerance serves components in units of it.
    pub scale: V<N>,
}

impl<N: Number> Start<N> {
    /// Reads the parameters.
    ///
    /// # Errors
    /// [`SceneError::Parameter`] where there is no such body, or the axis of figure is not near the angular momentum.
    pub fn read(task: &Task, cx: &N::Context) -> Result<Self, SceneError> {
        let at = |position: usize| V(task.parameter::<N>(position, cx));
        let [omega, h, asymmetry, alpha, counter, nu, beta, j, l] = [0, 1, 2, 3, 4, 5, 6, 7, 8].map(at);
        let one = omega.like(1.0);
        for (what, value) in [("C/A = 1 + H", &one + &h), ("B/A = 1 + asymmetry", &one + &asymmetry)] {
            let value = value.0.to_f64();
            if value.is_nan() || value <= 0.0 {
                let what = format!("{what} is {value}");
                return Err(SceneError::parameter(what, "give it a positive value: moments of inertia are"));
            }
        }
        let inclined = j.0.to_f64();
        if inclined.is_nan() || inclined.abs() >= 1.0 {
            let what = format!("J_0 is {inclined}");
            return Err(SceneError::parameter(what, "give it a value between -1 and 1 rad: the wobble is small"));
        }
        // C/B - 1 = (C - B)/B
        let across = (&h - &asymmetry) / (&one + &asymmetry);
        let sin = j.sin();
        let scale = sin.0.to_f64().abs().max(alpha.0.to_f64().abs());
        let scale = omega.like(if scale > 0.0 { scale } else { 1.0 });
        let pole = [&sin * l.cos(), &sin * l.sin()];
        Ok(Start { omega, flattening: [h, across], alpha, counter, nu, beta, pole, scale })
    }

    /// `epsilon = alpha G/C`, and the frequency of the free nutation `sigma = (2/C - 1/A - 1/B) G/2` of (523), negative for the
    /// Earth.
    pub fn rates(&self) -> [V<N>; 2] {
        let [a, b] = &self.flattening;
        [&self.alpha * &self.omega, (a + b) * -0.5 * &self.omega]
    }

    /// The phase of the deformation, `nu t + beta`, as cos and sin.
    pub fn phase(&self, t: &V<N>) -> [V<N>; 2] {
        let angle = &self.nu * t + &self.beta;
        [angle.cos(), angle.sin()]
    }

    /// The quantities, from `l_2` and `l_1`.
    pub fn quantity(&self, q: usize, [x, y]: &[V<N>; 2]) -> N {
        match q {
            0 => y.0.clone(),
            1 => x.0.clone(),
            J => (x.square() + y.square()).root().0.apply(Func::Asin),
            _ => x.0.like(f64::NAN),
        }
    }
}

/// The product of two complex numbers.
pub fn product<N: Number>([a, b]: &[V<N>; 2], [c, d]: &[V<N>; 2]) -> [V<N>; 2] {
    [a * c - b * d, a * d + b * c]
}
