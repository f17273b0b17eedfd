//! Splitting methods for the rigid body, on the free body and on a heavy top.

use super::problems::MOMENTS;
use super::*;
use crate::integrator::{Splitting, State, integrate_fixed};
use crate::number::Df64;

/// m g l: the torque of a weight on the third axis, when that is level.
const WEIGHT: f64 = 0.75;

/// The vertical in the body: the last row of the rotation.
fn vertical<N: Number>(q: &[N]) -> [N; 3] {
    let twice = |x: N| x.plus(&x);
    let [w, x, y, z] = [0, 1, 2, 3].map(|k| &q[k]);
    [
        twice(x.times(z).minus(&w.times(y))),
        twice(y.times(z).plus(&w.times(x))),
        w.times(w).minus(&x.times(x)).minus(&y.times(y)).plus(&z.times(z)),
    ]
}

fn weight<N: Number>(q: &[N], torque: &mut [N]) {
    let [x, y, _] = vertical(q);
    let size = x.like(WEIGHT);
    torque[0].set(&size.times(&y));
    torque[1].set(&size.times(&x).negated());
    torque[2].set(&x.like(0.0));
}

/// The same by its differential equations: L' = L × ω + torque, q' = q ω/2.
fn equations<N: Number>(heavy: bool) -> impl Fn(&N, &[N], &mut [N]) {
    move |_, y, slope| {
        let (l, q) = y.split_at(3);
        let w = [0, 1, 2].map(|k| l[k].over(&l[k].like(MOMENTS[k])));
        let mut torque = [(); 3].map(|()| l[0].like(0.0));
        if heavy {
            weight(q, &mut torque);
        }
        let half = l[0].like(0.5);
        for i in 0..3 {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            slope[i] = l[j].times(&w[k]).minus(&l[k].times(&w[j])).plus(&torque[i]);
            let cross = q[1 + j].times(&w[k]).minus(&q[1 + k].times(&w[j]));
            slope[4 + i] = q[0].times(&w[i]).plus(&cross).times(&half);
        }
        let dot = (0..3).fold(l[0].like(0.0), |sum, k| sum.plus(&q[1 + k].times(&w[k])));
        slope[3] = dot.times(&half).negated();
    }
}

fn splitting<N: Number>(heavy: bool, composition: Composition, cx: &N::Context) -> Box<dyn Method<N>> {
    let moments = MOMENTS.map(|moment| N::from_f64(moment, cx));
    if heavy {
        Box::new(Splitting::new(moments, weight::<N>, composition))
    } else {
        Box::new(Splitting::free(moments, composition))
    }
}

const START: [f64; 7] = [0.5, 0.25, 1.75, 0.8, 0.6, 0.0, 0.0];

fn start<N: Number>(cx: &N::Context) -> Vec<N> {
    let mut start: Vec<N> = START.iter().map(|&x| N::from_f64(x, cx)).collect();
    let size = start[3].times(&start[3]).plus(&start[4].times(&start[4])).root();
    for q in &mut start[3..] {
        *q = q.over(&size);
    }
    start
}

/// Against the differential equations, integrated by Gauss and Legendre's method of order 12.
#[test]
fn orders_are_measured_on_free_and_heavy_bodies() {
    let until = Df64::from(4.0);
    let h = |steps: usize| until.over(&Df64::from(steps as f64));
    for heavy in [false, true] {
        let system = equations::<Df64>(heavy);
        let mut reference = GaussLegendre::new(6, &system, 7, &());
        let zero = Df64::ZERO;
        let exact = integrate_fixed(&mut reference, (&zero, &start(&())), &h(128), 128, |_, _| {}).unwrap();
        for composition in Composition::ALL {
            let error = |steps| {
                let mut method = splitting::<Df64>(heavy, composition, &());
                let end = integrate_fixed(&mut *method, (&zero, &start(&())), &h(steps), steps, |_, _| {}).unwrap();
                distance(&end, &exact)
            };
            let steps = [1024, 256, 64, 32][composition.order() as usize / 2 - 1];
            let order = (error(steps) / error(2 * steps)).log2();
            println!("{composition:?}, heavy {heavy}: order {order:.3}, error {:e}", error(steps));
            assert!((order - f64::from(composition.order())).abs() < 0.35, "{composition:?}: {order}");
        }
    }
}

/// Length of the angular momentum and of the quaternion, and of the heavy body its vertical momentum, through 20 000
/// long steps: they are kept whatever the step.
#[test]
fn lengths_are_kept() {
    let invariants = |y: &[f64]| {
        let momentum: f64 = y[..3].iter().map(|l| l * l).sum();
        let attitude: f64 = y[3..].iter().map(|q| q * q).sum();
        let up: f64 = vertical(&y[3..]).iter().zip(y).map(|(v, l)| v * l).sum();
        [attitude, up, momentum]
    };
    for (heavy, kept) in [(false, 3), (true, 2)] {
        for composition in Composition::ALL {
            let (start, mut worst) = (start::<f64>(&()), [0.0f64; 3]);
            let first = invariants(&start);
            let watch = |_: &f64, y: &State<f64>| {
                let now = invariants(y.value());
                (0..3).for_each(|k| worst[k] = worst[k].max((now[k] / first[k] - 1.0).abs()));
            };
            let mut method = splitting::<f64>(heavy, composition, &());
            integrate_fixed(&mut *method, (&0.0, &start), &0.5, 20_000, watch).unwrap();
            println!("{composition:?}, heavy {heavy}: {worst:?}");
            assert!(worst[..kept].iter().all(|&w| w < 1e-13), "{composition:?}: {worst:?}");
            assert!(kept == 3 || worst[2] > 1e-3, "the weight does not act");
        }
    }
}

#[test]
fn they_are_reversible_and_the_same_in_every_number_type() {
    for composition in Composition::ALL {
        let start = start::<f64>(&());
        let mut method = splitting::<f64>(true, composition, &());
        let there = integrate_fixed(&mut *method, (&0.0, &start), &0.1, 50, |_, _| {}).unwrap();
        let back = integrate_fixed(&mut *method, (&5.0, &there), &-0.1, 50, |_, _| {}).unwrap();
        assert!(distance(&back, &start) < 1e-14, "{composition:?}: {:e}", distance(&back, &start));
        let widened: Vec<Df64> = start.iter().map(|&x| Df64::from(x)).collect();
        let mut fine = splitting::<Df64>(true, composition, &());
        let (zero, h) = (Df64::ZERO, Df64::from(0.1));
        let end = integrate_fixed(&mut *fine, (&zero, &widened), &h, 50, |_, _| {}).unwrap();
        let rounded: Vec<Df64> = there.into_iter().map(Df64::from).collect();
        assert!(distance(&end, &rounded) < 1e-14, "{composition:?}");
    }
}

/// The steps of a composition are the same from both ends and together one.
#[test]
fn compositions_are_symmetric() {
    for composition in Composition::ALL {
        let steps = composition.steps::<Df64>(&());
        let back: Vec<_> = steps.iter().rev().copied().collect();
        assert_eq!(steps, back);
        let sum = steps.iter().fold(Df64::ZERO, |a, &b| a + b);
        assert!((sum - Df64::ONE).hi().abs() < 1e-30);
    }
}
