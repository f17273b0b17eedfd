//! The free body in closed form, at any time without steps.
//!
//! The momentum's components in the body are cn, sn and dn, dn about the axis of the largest or the smallest moment that
//! the momentum goes round. The attitude is that of this axis by three Euler angles from the fixed momentum: the
//! inclination and the body's own rotation follow from the components, and the precession is a rate and an integral of
//! the third kind whose factor is one, `phi = G t/I_3 ± Lambda(nu t + v_0)`. In Andoyer's variables the two last are g and
//! l. Source: L. D. Landau and E. M. Lifshitz, *Mechanics*, section 37; C. G. J. Jacobi, J. reine angew. Math. 39 (1850).
//!
//! The axes are renumbered so that 3 is the one that the momentum goes round, 2 the middle one. With `D_3 = |2TI_3 - G^2|`
//! and so on, all by sums, only `D_2` is a difference: it says on which side of the separatrix the motion is, and k'^2 is
//! proportional to it, so that k near 1 costs no digits.

use super::super::jacobi::{Characteristic, Oscillation, Turning, phase};
use super::super::value::V;
use super::super::{About, Kind, Model, Motion, Precise, SceneError, Task};
use super::start::{ATTITUDE, Start, conjugate, length, momentum, product, turn};
use crate::number::Number;

/// Which axis is which, and the signs of the momentum's components.
#[derive(Clone, Copy, Debug)]
struct Order {
    /// The axes of the other extreme moment, the middle one, and the one that is gone round.
    axes: [usize; 3],
    /// Whether they are right-handed in this order.
    even: bool,
    /// The signs of cn, sn and dn.
    signs: [f64; 3],
}

/// What of the motion does not change.
struct Solution<N: Precise> {
    order: Order,
    oscillation: Oscillation<N>,
    /// Lambda, with its sign, where the attitude is asked for.
    turning: Option<(f64, Turning<N>)>,
    /// The largest values of the momentum's components, in the renumbered axes.
    most: [V<N>; 3],
    /// G / I_3.
    rate: V<N::Wide>,
    start: Start<N>,
}

/// The positions of the moments from small to large.
fn ascending<W: Number>(moments: &[V<W>; 3]) -> [usize; 3] {
    let mut order = [0, 1, 2];
    order.sort_by(|&i, &j| (&moments[i] - &moments[j]).sign().total_cmp(&0.0));
    order
}

/// Whether the angular velocity stays along a principal axis.
fn is_steady<W: Number>(start: &Start<W>) -> bool {
    let Start { moments, omega } = start;
    [(0, 1), (1, 2), (2, 0)]
        .iter()
        .all(|&(i, j)| (&moments[i] - &moments[j]).is_zero() || omega[i].is_zero() || omega[j].is_zero())
}

impl<N: Precise> Solution<N> {
    fn new(task: &Task, cx: &N::Context) -> Result<Self, SceneError> {
        let wide = Start::<N::Wide>::read(task, &N::wide(cx))?;
        let Start { moments, omega } = &wide;
        let [low, two, high] = ascending(moments);
        // I_i omega_i^2
        let x: [V<N::Wide>; 3] = [0, 1, 2].map(|i| &moments[i] * omega[i].square());
        let side = (&moments[high] - &moments[two]) * &x[high] - (&moments[two] - &moments[low]) * &x[low];
        let (one, three) = if side.sign() >= 0.0 { (low, high) } else { (high, low) };
        let distance = |i: usize, j: usize| {
            let d = &moments[i] - &moments[j];
            if d.sign() < 0.0 { -d } else { d }
        };
        let (d12, d13, d23) = (distance(one, two), distance(one, three), distance(two, three));
        let d3 = &d13 * &x[one] + &d23 * &x[two];
        let d1 = &d12 * &x[two] + &d13 * &x[three];
        let d2 = if side.sign() < 0.0 { -side } else { side };
        let whole = &d23 * &d1;
        let (m, m1) = (&d12 * &d3 / &whole, &d2 * &d13 / &whole);
        let [i1, i2, i3] = [one, two, three].map(|i| &moments[i]);
        let nu = (&whole / (i1 * i2 * i3)).root();
        let order = Order::new([one, two, three], omega, three == high);
        let backward = omega[two].sign() * order.signs[1] < 0.0;
        let v0 = phase(&(&x[two] * &d23).0, &(&x[one] * &d13).0, &(&x[three] * &d13 / &d1).0, backward);
        let oscillation = Oscillation::new(&m.0, &m1.0, &nu.0, &v0, cx);
        let most = [i1 * &d3 / &d13, i2 * &d3 / &d23, i3 * &d1 / &d13].map(|x| V(N::narrow(&x.root().0, cx)));
        let turning = task.wants(&ATTITUDE).then(|| {
            let g = i1 * &d3 / (i3 * &d1);
            let p = i2 * &d13 / (i1 * &d23);
            let n = Characteristic { negative: true, p: p.0, r: (&g + 1.0).0, g: g.0 };
            (if three == high { 1.0 } else { -1.0 }, Turning::new(&oscillation, &n))
        });
        let rate = length(&momentum(moments, omega)) / i3;
        Ok(Solution { order, oscillation, turning, most, rate, start: Start::read(task, cx)? })
    }
}

impl Order {
    /// The signs are those that Euler's equations need: `I_1 omega_1' = (I_2 - I_3) omega_2 omega_3` in right-handed axes.
    fn new<W: Number>(axes: [usize; 3], omega: &[V<W>; 3], largest: bool) -> Self {
        let [one, two, three] = axes;
        let even = (one + 1) % 3 == two;
        let sign = |i: usize| if omega[i].sign() < 0.0 { -1.0 } else { 1.0 };
        let (first, third) = (sign(one), sign(three));
        let second = first * third * if largest == even { 1.0 } else { -1.0 };
        Order { axes, even, signs: [first, second, third] }
    }

    /// The quaternion from the renumbered axes, in right-handed order with 3 last, to the body's own: a cyclic exchange.
    fn exchange<N: Number>(&self, like: &V<N>) -> [V<N>; 4] {
        let half = match self.axes[2] {
            0 => 0.5,
            1 => -0.5,
            _ => return [1.0, 0.0, 0.0, 0.0].map(|x| like.like(x)),
        };
        [0.5, half, half, half].map(|x| like.like(x))
    }
}

/// The attitude relative to the frame whose third axis is the momentum: Euler angles zxz with `phi` given.
fn attitude<N: Precise>(solution: &Solution<N>, point: &super::super::jacobi::Point<N>, phi: V<N>) -> [V<N>; 4] {
    let Solution { order, most: [first, second, third], .. } = solution;
    let [one, two, three] = order.signs;
    let [sn, cn] = point.within.clone().map(V);
    let pi = V(N::pi(&phi.0.context()));
    // cn is not negative within a half period, but for rounding.
    let cn = if cn.sign() < 0.0 { -cn } else { cn };
    let (along, across) = (first * cn, second * sn * (one * two));
    let turned = across.atan2(&along) + &pi * (point.halves * one * two);
    let psi = if order.even { &pi * 0.5 - turned } else { turned };
    let psi = if one < 0.0 { psi + &pi } else { psi };
    let level = (along.square() + across.square()).root();
    let half = level.atan2(&(third * V(point.dn.clone()) * three)) * 0.5;
    let (sin, cos) = (half.sin(), half.cos());
    let (sum, difference) = ((&phi + &psi) * 0.5, (phi - psi) * 0.5);
    [&cos * sum.cos(), &sin * difference.cos(), &sin * difference.sin(), &cos * sum.sin()]
}

impl<N: Precise> Solution<N> {
    fn rows(&self, task: &Task, cx: &N::Context) -> Motion<N> {
        let Solution { order, oscillation, turning, most, rate, start } = self;
        let mut point = oscillation.room();
        let mut motion = Motion::begin(task);
        let exchange = order.exchange(&most[0]);
        let phi = |t: f64, point: &super::super::jacobi::Point<N>| {
            turning.as_ref().map(|(sign, turning)| {
                let steady = V(N::narrow(&(rate * t).0, cx));
                steady + V(turning.at(t, point, cx)) * *sign
            })
        };
        oscillation.at(0.0, &mut point);
        let first = phi(0.0, &point).map(|phi| product(&exchange, &conjugate(&attitude(self, &point, phi))));
        for &t in task.times {
            oscillation.at(t, &mut point);
            let parts = [&point.cn, &point.sn, &point.dn];
            let mut omega = start.omega.clone();
            for ((&axis, part), (most, sign)) in order.axes.iter().zip(parts).zip(most.iter().zip(order.signs)) {
                omega[axis] = most * V(part.clone()) * sign / &start.moments[axis];
            }
            let attitude = phi(t, &point)
                .zip(first.as_ref())
                .map(|(phi, first)| product(&product(first, &attitude(self, &point, phi)), &conjugate(&exchange)));
            motion.push(task, |q| match ATTITUDE.iter().position(|a| *a == q).zip(attitude.as_ref()) {
                Some((i, attitude)) => attitude[i].0.clone(),
                None => start.quantity(q, &omega),
            });
        }
        motion
    }
}

/// The closed form.
pub struct Closed;

impl Model for Closed {
    fn about(&self) -> About {
        About {
            name: "closed",
            what: "the exact motion: omega by Jacobi's functions, the attitude with an integral of the third kind",
            source: "Landau and Lifshitz, Mechanics, section 37; DLMF 20.2, 22.16",
            kind: Kind::Exact,
            gives: &[],
        }
    }

    fn motion<N: Precise>(&self, task: &Task, cx: &N::Context) -> Result<Motion<N>, SceneError> {
        let start = Start::<N::Wide>::read(task, &N::wide(cx))?;
        if !is_steady(&start) {
            return Ok(Solution::<N>::new(task, cx)?.rows(task, cx));
        }
        let own = Start::<N>::read(task, cx)?;
        let state = |t: &N| {
            let t = V(start.omega[0].0.like(t.to_f64()));
            turn(&start.omega, &t).map(|x| V(N::narrow(&x.0, cx)))
        };
        Ok(task.tabulate(cx, state, |attitude, q| match ATTITUDE.iter().position(|a| *a == q) {
            Some(i) => attitude[i].0.clone(),
            None => own.quantity(q, &own.omega),
        }))
    }
}
