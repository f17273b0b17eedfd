//! The top's motion in closed form, at any time without steps.
//!
//! `u = cos(theta)` obeys `u'^2 = f(u)`, a cubic with the roots `u_1 <= u_2 <= 1 <= u_3`, and so is
//! `u_1 + (u_2 - u_1) sn^2(nu t + v_0, k)`. In the partial fractions of `phi' = (l - a u)/(1 - u^2)` and of `psi'` the
//! residues at `u = ±1` are such that, with `Lambda` of [`super::super::jacobi`] for `1 + u` and for `1 - u`,
//!
//! `phi = phi_0 ± Lambda_+ ± Lambda_-`, `psi = psi_0 + (Omega - a) t ± Lambda_+ ∓ Lambda_-`,
//!
//! the signs being those of `l + a` and `l - a`. Source: equations (52) and (66); E. T. Whittaker, *Analytical Dynamics*,
//! section 72.

use super::super::jacobi::{Characteristic, Oscillation, Turning, phase};
use super::super::value::V;
use super::super::{About, Kind, Model, Motion, Precise, SceneError, Task};
use super::approximate::steady;
use super::start::{ENERGY, L_Z, PHI, PSI, Start, THETA, U};
use crate::number::Number;

/// The roots of f by distances that do not cancel.
struct Roots<W> {
    /// 1 - u_1, 1 - u_2, u_3 - 1.
    below: [V<W>; 2],
    beyond: V<W>,
    /// 1 + u_1, 1 + u_2.
    above: [V<W>; 2],
    /// u_2 - u_1, u_3 - u_2, u_3 - u_1.
    swing: V<W>,
    gap: V<W>,
    span: V<W>,
    /// u_0 - u_1 and u_2 - u_0.
    risen: V<W>,
    left: V<W>,
}

/// The constants of f: from the initial state, without differences of what may be nearly equal.
struct Cubic<W> {
    /// 2 mgl / I_0.
    b: V<W>,
    /// 1 - u_0 and 1 + u_0.
    d: V<W>,
    e: V<W>,
    /// f, f' and f''/2 at u_0.
    at: [V<W>; 3],
    /// l - a and l + a.
    behind: V<W>,
    ahead: V<W>,
    /// The coefficients of f in 1 - u: -behind^2 + 2 kappa d - slope d^2 - b d^3.
    kappa: V<W>,
    slope: V<W>,
}

impl<W: Number> Cubic<W> {
    fn new(s: &Start<W>) -> Self {
        let [theta, rate, p, a, pull] = [&s.theta, &s.theta_rate, &s.phi_rate, &s.a, &s.pull].map(|x| V(x.clone()));
        let half = theta * 0.5;
        let (d, e) = (half.sin().square() * 2.0, half.cos().square() * 2.0);
        let (u, sin2) = (V(s.cos.clone()), V(s.sin.to_the(2)));
        let b = pull * 2.0;
        let velocity = rate.square() + p.square() * &sin2;
        let f0 = rate.square() * &sin2;
        let f1 = &p * &a * &sin2 * 2.0 - &b * &sin2 - &u * &velocity * 2.0;
        let f2 = &b * &u * 2.0 - &velocity - a.square();
        let behind = &d * (&p * &e - &a);
        let ahead = &e * (&p * &d + &a);
        let above = &velocity - &b * &d;
        let kappa = &above - &a * &behind;
        let slope = above + a.square() - &b * 2.0;
        Cubic { b, d, e, at: [f0, f1, f2], behind, ahead, kappa, slope }
    }

    /// The roots. The one that is far from the other two is found by Newton's method, and those by the coefficients of
    /// the quadratic that is left, whose product is known to be not positive: its discriminant is a sum.
    fn roots(&self) -> Roots<W> {
        let near = self.about_the_start();
        if (&near.swing * 2.0 - &near.span).sign() <= 0.0 { near } else { self.about_the_pole(near) }
    }

    /// By `w = u - u_0`, for which u_3 is the far root: in b w, so that no gravity is no exception.
    fn about_the_start(&self) -> Roots<W> {
        let Cubic { b, d, e, at: [f0, f1, f2], behind, ahead, .. } = self;
        let far = largest_root(f2, &(b * f1), &(b.square() * f0));
        let product = -(f0 / &far);
        let (w1, w2) = split(&((f1 - b * &product) / &far), &product);
        let far = &far / b;
        let lowest = d - &w1;
        let direct = &far - d;
        let (middle, beyond) = if (&direct * 4.0 - &far).sign() > 0.0 {
            (behind.square() / (b * &lowest * &direct), direct)
        } else {
            let middle = d - &w2;
            let beyond = behind.square() / (b * &lowest * &middle);
            (middle, beyond)
        };
        let rise = e + &w2;
        let height = ahead.square() / (b * &rise * (&beyond + 2.0));
        let (swing, gap, span) = (&w2 - &w1, &far - &w2, &far - &w1);
        Roots { below: [lowest, middle], beyond, above: [height, rise], swing, gap, span, risen: -w1, left: w2 }
    }

    /// By `1 - u`, for which u_1 is the far root: where u_2 and u_3 are near each other, they are near 1.
    fn about_the_pole(&self, near: Roots<W>) -> Roots<W> {
        let Cubic { b, behind, ahead, kappa, slope, .. } = self;
        let lowest = largest_root(&(slope / b), &(kappa / b * -2.0), &(behind.square() / b));
        let product = -(behind.square() / (b * &lowest));
        let (far, middle) = split(&((kappa / b * -2.0 - &product) / &lowest), &product);
        let beyond = -far;
        let rise = -(&middle - 2.0);
        let height = ahead.square() / (b * &rise * (&beyond + 2.0));
        let (swing, gap, span) = (&lowest - &middle, &middle + &beyond, &lowest + &beyond);
        Roots { below: [lowest, middle], beyond, above: [height, rise], swing, gap, span, ..near }
    }
}

/// The largest root of x^3 + a x^2 + b x + c with three real ones, by Newton's method from above, where the cubic is
/// convex and the iteration falls.
fn largest_root<W: Number>(a: &V<W>, b: &V<W>, c: &V<W>) -> V<W> {
    let size = |x: &V<W>, root: f64| (x.0.log2_abs() / root).exp2();
    let mut x = a.like(2.0 * size(a, 1.0).max(size(b, 2.0)).max(size(c, 3.0)));
    // A double root halves the distance in each step only.
    for _ in 0..8 * W::precision_bits(&x.0.context()) {
        let value = ((&x + a) * &x + b) * &x + c;
        let slope = (&x * 3.0 + a * 2.0) * &x + b;
        let next = &x - value / slope;
        if !((&x - &next).sign() > 0.0 && next.0.is_finite()) {
            break;
        }
        x = next;
    }
    x
}

/// The roots of x^2 - sum x + product, the product not positive: the negative and the positive one.
fn split<W: Number>(sum: &V<W>, product: &V<W>) -> (V<W>, V<W>) {
    let root = (sum.square() - product * 4.0).root();
    if root.is_zero() {
        (root.clone(), root)
    } else if sum.sign() >= 0.0 {
        let upper = (sum + root) * 0.5;
        (product / &upper, upper)
    } else {
        let lower = (sum - root) * 0.5;
        let upper = product / &lower;
        (lower, upper)
    }
}

/// What of the motion does not change.
struct Solution<N: Precise> {
    oscillation: Oscillation<N>,
    /// Lambda_+ and Lambda_- with their signs; none where they have no part in the motion.
    turnings: [Option<(f64, Turning<N>)>; 2],
    /// 1 - u_2, 1 + u_1 and u_2 - u_1.
    below: V<N>,
    above: V<N>,
    swing: V<N>,
    /// Omega - a.
    spin: V<N::Wide>,
    start: Start<N>,
}

impl<N: Precise> Solution<N> {
    fn new(task: &Task, cx: &N::Context) -> Result<Self, SceneError> {
        let start = Start::<N::Wide>::read(task, &N::wide(cx))?;
        let cubic = Cubic::new(&start);
        if cubic.b.is_zero() {
            return Err(SceneError::regime(
                "there is no gravity, and u has no third root",
                "use the scene `free` with two equal moments, or the model `quaternion`",
            ));
        }
        let roots = cubic.roots();
        let Roots { below: [lowest, middle], beyond, above: [height, rise], swing, gap, span, risen, left } = &roots;
        let (m, m1) = (swing / span, gap / span);
        let nu = (&cubic.b * span).root() * 0.5;
        // u rises where theta falls.
        let falls = start.theta_rate.to_f64() > 0.0;
        let v0 = phase(&risen.0, &left.0, &((gap + left) / span).0, falls);
        let oscillation = Oscillation::new(&m.0, &m1.0, &nu.0, &v0, cx);
        let mut turnings = [None, None];
        if task.wants(&[PHI, PSI]) {
            passes_no_pole(&cubic, &roots)?;
            let whole = beyond + 2.0;
            let upper =
                Characteristic { negative: true, p: (rise / height).0, r: (whole / span).0, g: (height / span).0 };
            let lower =
                Characteristic { negative: false, p: (middle / lowest).0, r: (beyond / span).0, g: (lowest / span).0 };
            let turning =
                |sign: f64, n: &Characteristic<N::Wide>| (sign != 0.0).then(|| (sign, Turning::new(&oscillation, n)));
            turnings = [turning(cubic.ahead.sign(), &upper), turning(cubic.behind.sign(), &lower)];
        }
        let narrow = |x: &V<N::Wide>| V(N::narrow(&x.0, cx));
        let (below, above, swing) = (narrow(middle), narrow(height), narrow(swing));
        let spin = V(start.spin.minus(&start.a));
        Ok(Solution { oscillation, turnings, below, above, swing, spin, start: Start::read(task, cx)? })
    }
}

/// Where the axis passes through the vertical, phi and psi jump by half a turn, and their sum alone has a meaning.
fn passes_no_pole<W: Number>(cubic: &Cubic<W>, roots: &Roots<W>) -> Result<(), SceneError> {
    let upright = cubic.behind.is_zero() && roots.below[1].is_zero() && !roots.gap.is_zero();
    let still = roots.below[0].is_zero() || roots.above[1].is_zero();
    let hanging = cubic.ahead.is_zero();
    if upright || hanging || still {
        return Err(vertical());
    }
    Ok(())
}

fn vertical() -> SceneError {
    SceneError::regime(
        "the axis passes through the vertical, where phi and psi are undefined",
        "ask for theta or u, or take the model `quaternion`, which joins the angles across the passage",
    )
}

/// The motion of an axis that stays where it is: a double root of f at the start, upright or hanging or in steady
/// precession.
fn at_rest<N: Precise>(task: &Task, cx: &N::Context) -> Result<Option<Motion<N>>, SceneError> {
    let wide = Start::<N::Wide>::read(task, &N::wide(cx))?;
    let [value, slope, _] = Cubic::new(&wide).at;
    if !(value.is_zero() && slope.is_zero()) {
        return Ok(None);
    }
    if wide.sin.log2_abs() == f64::NEG_INFINITY && task.wants(&[PHI, PSI]) {
        return Err(vertical());
    }
    let start = Start::<N>::read(task, cx)?;
    Ok(Some(steady(task, cx, &start, &start.phi_rate)))
}

/// The closed form.
pub struct Closed;

impl Model for Closed {
    fn about(&self) -> About {
        About {
            name: "closed",
            what: "the exact motion: theta by Jacobi's functions, phi and psi by integrals of the third kind",
            source: "equations (52) and (66); Whittaker, Analytical Dynamics, section 72; DLMF 20.2, 22.16",
            kind: Kind::Exact,
            gives: &[],
        }
    }

    fn motion<N: Precise>(&self, task: &Task, cx: &N::Context) -> Result<Motion<N>, SceneError> {
        if let Some(rest) = at_rest(task, cx)? {
            return Ok(rest);
        }
        let solution = Solution::<N>::new(task, cx)?;
        let Solution { oscillation, turnings, below, above, swing, spin, start } = &solution;
        let mut point = oscillation.room();
        let mut motion = Motion::begin(task);
        let zero = N::zero(cx);
        for &t in task.times {
            oscillation.at(t, &mut point);
            let down = below + swing * V(point.cn.to_the(2));
            let up = above + swing * V(point.sn.to_the(2));
            let [upper, lower] = turnings.each_ref().map(|turning| match turning {
                Some((sign, turning)) => {
                    let angle = turning.at(t, &point, cx);
                    if *sign < 0.0 { angle.negated() } else { angle }
                }
                None => zero.clone(),
            });
            motion.push(task, |q| match q {
                THETA => (down.root().atan2(&up.root()) * 2.0).0,
                PHI => start.phi.plus(&upper.plus(&lower)),
                PSI => {
                    let steady = N::narrow(&(spin * t).0, cx);
                    start.psi.plus(&steady.plus(&upper.minus(&lower)))
                }
                U => ((&up - &down) * 0.5).0,
                L_Z => start.momentum(&start.vertical()),
                ENERGY => start.energy(task, &start.axis_square(), &start.cos),
                _ => zero.like(f64::NAN),
            });
        }
        Ok(motion)
    }
}
