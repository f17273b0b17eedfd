//! Splitting methods for a rigid body: every step is made of exact rotations.
//!
//! The energy L₁²/2A + L₂²/2B + L₃²/2C + V(attitude) is a sum of parts that are each solved without error: by a
//! turn about a principal axis, which keeps the length of the angular momentum, and by a torque at rest, which keeps the
//! attitude (McLachlan, *Explicit Lie-Poisson integration and the Euler equations*, Phys. Rev. Lett. 71 (1993); Touma and
//! Wisdom, *Lie-Poisson integrators for rigid body dynamics in the solar system*, Astron. J. 107 (1994)). Their symmetric
//! product is a method of order 2; a [`Composition`] of its steps has a higher order.

use super::runge_kutta::{Coefficient, coefficient};
use super::{IntegrationError, Method, State};
use crate::number::Number;

/// How steps of order 2 are composed to a step of higher order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Composition {
    /// One step, of order 2 (Strang 1968).
    Strang,
    /// Five steps, order 4 (Suzuki, *Fractal decomposition of exponential operators*, Phys. Lett. A 146 (1990)).
    Suzuki4,
    /// Nine steps, order 6 (Kahan and Li, *Composition constants for raising the orders of unconventional schemes for ordinary
    /// differential equations*, Math. Comp. 66 (1997)). Their digits limit it to some 25 digits.
    KahanLi6,
    /// Seventeen steps, order 8, likewise.
    KahanLi8,
}

const KAHAN_LI_6: &[Coefficient] = &[
    "0.39216144400731413927925056",
    "0.33259913678935943859974864",
    "-0.70624617255763935980996482",
    "0.08221359629355080023149045",
];

const KAHAN_LI_8: &[Coefficient] = &[
    "0.13020248308889008087881763",
    "0.56116298177510838456196441",
    "-0.38947496264484728640807860",
    "0.15884190655515560089621075",
    "-0.39590389413323757733623154",
    "0.18453964097831570709183254",
    "0.25837438768632204729397911",
    "0.29501172360931029887096624",
];

impl Composition {
    /// All of them.
    pub const ALL: [Composition; 4] =
        [Composition::Strang, Composition::Suzuki4, Composition::KahanLi6, Composition::KahanLi8];

    /// The order.
    pub fn order(self) -> u32 {
        match self {
            Composition::Strang => 2,
            Composition::Suzuki4 => 4,
            Composition::KahanLi6 => 6,
            Composition::KahanLi8 => 8,
        }
    }

    /// The lengths of the steps in units of the whole: the same from both ends, and together one.
    pub fn steps<N: Number>(self, cx: &N::Context) -> Vec<N> {
        let one = N::from_f64(1.0, cx);
        let mut steps: Vec<N> = match self {
            Composition::Strang => Vec::new(),
            Composition::Suzuki4 => {
                let four = N::from_f64(4.0, cx);
                let mut root = one.clone();
                root.set_pow(&four, &N::from_ratio(1, 3, cx));
                vec![one.over(&four.minus(&root)); 2]
            }
            Composition::KahanLi6 => KAHAN_LI_6.iter().map(|text| coefficient(text, cx)).collect(),
            Composition::KahanLi8 => KAHAN_LI_8.iter().map(|text| coefficient(text, cx)).collect(),
        };
        let half = steps.iter().fold(N::zero(cx), |sum, step| sum.plus(step));
        let back: Vec<N> = steps.iter().rev().cloned().collect();
        steps.push(one.minus(&half).minus(&half));
        steps.extend(back);
        steps
    }
}

/// A torque that depends on the attitude alone.
pub trait Torque<N> {
    /// Whether there is any.
    const ACTS: bool = true;

    /// Writes the components of the torque about the principal axes, for the attitude as a unit quaternion (scalar first) that
    /// leads from the components about the principal axes to the inertial ones: q v q̄.
    fn torque(&self, attitude: &[N], torque: &mut [N]);
}

impl<N: Number, F: Fn(&[N], &mut [N])> Torque<N> for F {
    fn torque(&self, attitude: &[N], torque: &mut [N]) {
        self(attitude, torque);
    }
}

/// No torque: Euler's free rotation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Free;

impl<N: Number> Torque<N> for Free {
    const ACTS: bool = false;

    fn torque(&self, _: &[N], _: &mut [N]) {}
}

/// A part of the energy.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Part {
    Torque,
    /// The turn about a principal axis.
    Turn(usize),
}

/// The rotation of a rigid body about its centre of mass or a fixed point. The state is `[L₁, L₂, L₃, q₀, q₁, q₂, q₃]`: the
/// angular momentum about the principal axes, and the attitude as in [`Torque::torque`].
#[derive(Clone, Debug)]
pub struct Splitting<N, T> {
    moments: [N; 3],
    torque: T,
    composition: Composition,
    /// The parts with the share of the step that each takes.
    parts: Vec<(Part, N)>,
}

impl<N: Number> Splitting<N, Free> {
    /// A body without torque; `moments` are its principal moments of inertia.
    pub fn free(moments: [N; 3], composition: Composition) -> Self {
        Splitting::new(moments, Free, composition)
    }
}

impl<N: Number, T: Torque<N>> Splitting<N, T> {
    /// A body under a torque; `moments` are its principal moments of inertia.
    pub fn new(moments: [N; 3], torque: T, composition: Composition) -> Self {
        let cx = moments[0].context();
        let half = N::from_f64(0.5, &cx);
        let mut parts: Vec<(Part, N)> = Vec::new();
        let [a, b, c] = [0, 1, 2].map(Part::Turn);
        for step in composition.steps::<N>(&cx) {
            let before = step.times(&half);
            for part in [Part::Torque, a, b, c, b, a, Part::Torque] {
                let share = if part == c { step.clone() } else { before.clone() };
                match parts.last_mut() {
                    _ if part == Part::Torque && !T::ACTS => {}
                    // The end of one step and the beginning of the next are one.
                    Some((last, sum)) if *last == part => *sum = sum.plus(&share),
                    _ => parts.push((part, share)),
                }
            }
        }
        Splitting { moments, torque, composition, parts }
    }

    /// Turns the body about a principal axis for a time; its rate there does not change.
    fn turn(&self, axis: usize, time: &N, state: &mut State<N>) {
        let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
        let y = state.value();
        let half_angle = y[axis].over(&self.moments[axis]).times(time).times(&time.like(0.5));
        let (mut sin, mut cos) = (half_angle.clone(), half_angle.clone());
        N::set_sin_cos(&mut sin, &mut cos, &half_angle);
        // Only the increments are computed, which are small where the step is: 1 - cos without cancellation.
        let one = time.like(1.0);
        let square = sin.times(&sin);
        let (shortfall, fall) = (square.over(&one.plus(&cos)).negated(), square.plus(&square).negated());
        let rise = sin.plus(&sin.times(&shortfall));
        let rise = rise.plus(&rise);
        let both = |a: &N, x: &N, b: &N, z: &N| a.times(x).plus(&b.times(z));
        let terms =
            [(next, both(&fall, &y[next], &rise, &y[last])), (last, both(&fall, &y[last], &rise.negated(), &y[next]))];
        // q (cos + e sin) - q for the unit vector e of the axis.
        let (q, back) = (&y[3..], sin.negated());
        let attitude = [
            (3, both(&shortfall, &q[0], &back, &q[1 + axis])),
            (4 + axis, both(&shortfall, &q[1 + axis], &sin, &q[0])),
            (4 + next, both(&shortfall, &q[1 + next], &sin, &q[1 + last])),
            (4 + last, both(&shortfall, &q[1 + last], &back, &q[1 + next])),
        ];
        for (component, term) in terms.into_iter().chain(attitude) {
            state.add(component, &term);
        }
    }

    fn push(&self, time: &N, state: &mut State<N>) {
        let mut torque = [(); 3].map(|()| time.like(0.0));
        self.torque.torque(&state.value()[3..], &mut torque);
        for (component, torque) in torque.iter().enumerate() {
            state.add(component, &torque.times(time));
        }
    }
}

impl<N: Number, T: Torque<N>> Method<N> for Splitting<N, T> {
    fn name(&self) -> String {
        format!("splitting {}", self.order())
    }

    fn order(&self) -> u32 {
        self.composition.order()
    }

    fn is_symmetric(&self) -> bool {
        true
    }

    fn step(&mut self, t: &N, h: &N, state: &mut State<N>) -> Result<(), IntegrationError> {
        if state.value().len() != 7 {
            return Err(IntegrationError::NotFinite { t: t.to_f64() });
        }
        for (part, share) in &self.parts {
            let time = share.times(h);
            match *part {
                Part::Torque => self.push(&time, state),
                Part::Turn(axis) => self.turn(axis, &time, state),
            }
        }
        Ok(())
    }
}
