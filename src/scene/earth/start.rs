//! The scene's parameters and quantities, read in any number type.

use super::super::value::V;
use super::super::{Parameter, Quantity, SceneError, Task};
use crate::number::Number;

/// The parameters: the mean elements of J2000.0 of Meeus, *Astronomical Algorithms* (2nd ed. 1998), chapters 22 and 47; the
/// flattening of Wahr's Earth, *Geophys. J. R. astr. Soc.* 64 (1981), C/(C - A) = 305.5; times are from J2000.0 on.
pub const PARAMETERS: &[Parameter] = &[
    Parameter::new("omega", "rad/yr", 2301.22, "rate of the Earth's rotation"),
    Parameter::new("H", "1", 0.003_273_8, "(C - A)/C, the dynamical flattening"),
    Parameter::new("moon", "1", 0.012_150_6, "share of the Moon in the mass of Earth and Moon"),
    Parameter::new("n_moon", "rad/yr", 83.9969, "sidereal mean motion of the Moon"),
    Parameter::new("i", "rad", 0.089_804, "inclination of the Moon's orbit"),
    Parameter::new("n_node", "rad/yr", -0.337_571, "rate of its ascending node"),
    Parameter::new("node_0", "rad", 2.182_44, "longitude of the node at t = 0"),
    Parameter::new("moon_0", "rad", 1.627_905, "the Moon's distance from the node at t = 0"),
    Parameter::new("sun", "1", 0.999_997, "share of the Sun in the mass of Sun and Earth"),
    Parameter::new("n_sun", "rad/yr", 6.283_08, "sidereal mean motion of the Sun"),
    Parameter::new("sun_0", "rad", 4.895_06, "longitude of the Sun at t = 0"),
    Parameter::new("obliquity_0", "rad", 0.409_093, "obliquity of the ecliptic at t = 0"),
    Parameter::new("h_0", "rad", 0.0, "longitude of the ascending node of the equator at t = 0"),
];

/// The quantities.
pub const QUANTITIES: &[Quantity] = &[
    Quantity::new("h", "rad", "longitude of the ascending node of the equator on the ecliptic"),
    Quantity::new("obliquity", "rad", "inclination of the equator to the ecliptic"),
    Quantity::new("nutation_longitude", "rad", "h without h_0 and the precession at the rate of (463) at obliquity_0"),
    Quantity::new("nutation_obliquity", "rad", "obliquity less obliquity_0"),
];

/// A body that pulls at the Earth's equator.
#[derive(Clone, Debug)]
pub struct Body<N> {
    /// `f = 3 n^2 m (C - A)/(C omega)`.
    pub strength: V<N>,
    /// cos and sin of the inclination of its orbit.
    pub inclination: [V<N>; 2],
    /// Longitude of its ascending node at t = 0, and its rate.
    pub node: [V<N>; 2],
    /// Its distance from the node at t = 0, and its rate.
    pub argument: [V<N>; 2],
}

/// Moon, Sun and the Earth's axis at t = 0.
#[derive(Clone, Debug)]
pub struct Start<N> {
    pub bodies: [Body<N>; 2],
    pub obliquity: V<N>,
    pub h: V<N>,
}

impl<N: Number> Start<N> {
    /// Reads the parameters.
    ///
    /// # Errors
    /// [`SceneError::Parameter`] where the Earth does not rotate, or its axis is that of the ecliptic.
    pub fn read(task: &Task, cx: &N::Context) -> Result<Self, SceneError> {
        let at = |position: usize| V(task.parameter::<N>(position, cx));
        let (omega, flattening, obliquity) = (at(0), at(1), at(11));
        let (rate, sin) = (omega.0.to_f64(), obliquity.sin().0.to_f64());
        if rate.is_nan() || rate <= 0.0 {
            let what = format!("the rate omega of the rotation is {rate}");
            return Err(SceneError::parameter(what, "give it a positive value"));
        }
        if sin.is_nan() || sin <= 1e-6 {
            let what = format!("the obliquity is {}", obliquity.0.to_f64());
            return Err(SceneError::parameter(what, "give it a value between 0 and pi: else the equator has no node"));
        }
        let strength = |n: &V<N>, share: V<N>| n.square() * share * &flattening * 3.0 / &omega;
        let (zero, one) = (omega.like(0.0), omega.like(1.0));
        let moon = Body {
            strength: strength(&at(3), at(2)),
            inclination: [at(4).cos(), at(4).sin()],
            node: [at(6), at(5)],
            argument: [at(7), at(3) - at(5)],
        };
        let sun = Body {
            strength: strength(&at(9), at(8)),
            inclination: [one, zero.clone()],
            node: [zero.clone(), zero],
            argument: [at(10), at(9)],
        };
        Ok(Start { bodies: [moon, sun], obliquity, h: at(12) })
    }

    /// The rate of the precession at an obliquity: (463) with (465), for both bodies.
    pub fn precession(&self, obliquity: &V<N>) -> V<N> {
        let rate = |b: &Body<N>| {
            let level = b.inclination[0].square() * 3.0 - 1.0;
            &b.strength * level * obliquity.cos() * -0.25
        };
        rate(&self.bodies[0]) + rate(&self.bodies[1])
    }

    /// The quantities, from the time, h and the obliquity.
    pub fn quantity(&self, q: usize, t: &V<N>, h: &V<N>, obliquity: &V<N>) -> N {
        match q {
            0 => h.0.clone(),
            1 => obliquity.0.clone(),
            2 => (h - &self.h - self.precession(&self.obliquity) * t).0,
            3 => (obliquity - &self.obliquity).0,
            _ => t.0.like(f64::NAN),
        }
    }
}

impl<N: Number> Body<N> {
    /// The longitude of the node and the distance from it at a time.
    pub fn angles(&self, t: &V<N>) -> [V<N>; 2] {
        [&self.node, &self.argument].map(|[start, rate]| start + rate * t)
    }
}
