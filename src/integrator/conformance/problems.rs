//! Motions whose course is known.

use crate::expr::{Expr, Func, Graph, SymId};
use crate::integrator::Rates;
use crate::integrator::taylor::{Equations, Series};
use crate::number::{Elliptic, Number};

/// A system with a start at t = 0, the time up to which it is followed, and its exact solution.
pub(super) struct Problem {
    pub name: &'static str,
    graph: Graph,
    state: Vec<SymId>,
    rates: Vec<Expr>,
    time: Option<SymId>,
    /// The start, as machine numbers.
    pub start: Vec<f64>,
    pub until: f64,
    motion: Motion,
}

#[derive(Clone, Copy)]
enum Motion {
    Kepler,
    Pendulum,
    Euler,
    Driven,
}

/// The eccentricity of the orbit, from a perihelion at x = 1 - e; unit semi-major axis and mean motion.
const ECCENTRICITY: f64 = 0.25;
/// The modulus of the pendulum's motion, sin of half the amplitude.
const MODULUS: f64 = 0.75;
/// The moments of inertia of the free body. It turns mostly about the third axis.
pub(super) const MOMENTS: [f64; 3] = [1.0, 1.5, 2.0];
/// Its momentum about the first and third axes at the start, and none about the second.
const MOMENTUM: [f64; 2] = [0.5, 1.75];

impl Problem {
    pub fn all() -> [Problem; 4] {
        [kepler(), pendulum(), euler(), driven()]
    }

    fn equations(&self) -> Equations<'_> {
        Equations { graph: &self.graph, state: &self.state, rates: &self.rates, time: self.time }
    }

    pub fn rates<N: Number>(&self, cx: &N::Context) -> Rates<N> {
        Rates::compile(&self.equations(), cx, |_| N::zero(cx))
    }

    pub fn series(&self) -> Series {
        Series::compile(&self.equations()).unwrap()
    }

    pub fn start<N: Number>(&self, cx: &N::Context) -> Vec<N> {
        self.at(&N::zero(cx))
    }

    /// The exact state at a time.
    pub fn at<N: Number>(&self, t: &N) -> Vec<N> {
        let number = |x: f64| t.like(x);
        match self.motion {
            Motion::Kepler => kepler_at(t),
            Motion::Pendulum => {
                let k = number(MODULUS);
                let (sn, cn) = (elliptic(Elliptic::Sn, t, &k), elliptic(Elliptic::Cn, t, &k));
                let two = number(2.0);
                let angle = k.times(&sn).apply(Func::Asin).times(&two);
                vec![angle, k.times(&cn).times(&two)]
            }
            Motion::Euler => euler_at(t),
            Motion::Driven => {
                let growth = t.apply(Func::Sin).apply(Func::Exp);
                vec![growth.times(&number(self.start[0])), growth.times(t).plus(&number(self.start[1]).times(&growth))]
            }
        }
    }
}

fn elliptic<N: Number>(f: Elliptic, u: &N, k: &N) -> N {
    let mut value = u.clone();
    value.set_elliptic(f, &[u, k]);
    value
}

/// x'' = -x/r³ in the plane.
fn kepler() -> Problem {
    let mut g = Graph::new();
    let state: Vec<SymId> = ["x", "y", "u", "v"].map(|name| g.symbol(name)).to_vec();
    let [x, y, u, v] = [0, 1, 2, 3].map(|k| g.sym(state[k]));
    let (xx, yy) = (g.powi(x, 2), g.powi(y, 2));
    let (square, exponent) = (g.add(xx, yy), g.ratio(3, 2));
    let cube = g.pow(square, exponent);
    let rates = [x, y].map(|x| {
        let pull = g.div(x, cube);
        g.neg(pull)
    });
    let start = vec![1.0 - ECCENTRICITY, 0.0, 0.0, ((1.0 + ECCENTRICITY) / (1.0 - ECCENTRICITY)).sqrt()];
    let rates = vec![u, v, rates[0], rates[1]];
    Problem { name: "Kepler", graph: g, state, rates, time: None, start, until: 6.5, motion: Motion::Kepler }
}

/// By Kepler's equation t = E - e sin E, solved by Newton's method.
fn kepler_at<N: Number>(t: &N) -> Vec<N> {
    let (e, one) = (t.like(ECCENTRICITY), t.like(1.0));
    let mut anomaly = t.clone();
    for _ in 0..60 {
        let error = anomaly.minus(&e.times(&anomaly.apply(Func::Sin))).minus(t);
        anomaly = anomaly.minus(&error.over(&one.minus(&e.times(&anomaly.apply(Func::Cos)))));
    }
    let (sin, cos) = (anomaly.apply(Func::Sin), anomaly.apply(Func::Cos));
    let (rate, minor) = (one.over(&one.minus(&e.times(&cos))), one.minus(&e.times(&e)).root());
    let (u, v) = (sin.times(&rate).negated(), minor.times(&cos).times(&rate));
    vec![cos.minus(&e), minor.times(&sin), u, v]
}

/// θ'' = -sin θ, from the lowest point: sin θ/2 = k sn(t, k).
fn pendulum() -> Problem {
    let mut g = Graph::new();
    let state: Vec<SymId> = ["a", "w"].map(|name| g.symbol(name)).to_vec();
    let [a, w] = [0, 1].map(|k| g.sym(state[k]));
    let sin = g.call(Func::Sin, a);
    let rates = vec![w, g.neg(sin)];
    let start = vec![0.0, 2.0 * MODULUS];
    Problem { name: "pendulum", graph: g, state, rates, time: None, start, until: 8.0, motion: Motion::Pendulum }
}

/// L' = L × ω about the principal axes.
fn euler() -> Problem {
    let mut g = Graph::new();
    let state: Vec<SymId> = ["p", "q", "r"].map(|name| g.symbol(name)).to_vec();
    let l = [0, 1, 2].map(|k| g.sym(state[k]));
    let rates = (0..3).map(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        // 1/I_k - 1/I_j is a ratio of halves.
        let [ij, ik] = [j, k].map(|n| (2.0 * MOMENTS[n]) as i128);
        let (factor, product) = (g.ratio(2 * (ij - ik), ij * ik), g.mul(l[j], l[k]));
        g.mul(factor, product)
    });
    let rates = rates.collect();
    let start = vec![MOMENTUM[0], 0.0, MOMENTUM[1]];
    Problem { name: "Euler", graph: g, state, rates, time: None, start, until: 12.0, motion: Motion::Euler }
}

/// ω = (a cn, b sn, c dn)(n t, k) with b, n and k from Euler's equations.
fn euler_at<N: Number>(t: &N) -> Vec<N> {
    let [a, b, c] = MOMENTS.map(|moment| t.like(moment));
    let (wa, wc) = (t.like(MOMENTUM[0]).over(&a), t.like(MOMENTUM[1]).over(&c));
    let (ba, ca, cb) = (b.minus(&a), c.minus(&a), c.minus(&b));
    let wb = wa.times(&a.times(&ca).over(&b.times(&cb)).root());
    let n = wc.times(&cb.times(&ca).over(&a.times(&b)).root());
    let k = ba.times(&wa).times(&wb).over(&c.times(&wc).times(&n)).root();
    let u = n.times(t);
    let [sn, cn, dn] = [Elliptic::Sn, Elliptic::Cn, Elliptic::Dn].map(|f| elliptic(f, &u, &k));
    vec![a.times(&wa).times(&cn), b.times(&wb).times(&sn), c.times(&wc).times(&dn)]
}

/// y' = y cos t and z' = z cos t + e^{sin t}, where the time tells twice.
fn driven() -> Problem {
    let mut g = Graph::new();
    let state: Vec<SymId> = ["y", "z"].map(|name| g.symbol(name)).to_vec();
    let time = g.symbol("t");
    let [y, z] = [0, 1].map(|k| g.sym(state[k]));
    let t = g.sym(time);
    let (sin, cos) = (g.call(Func::Sin, t), g.call(Func::Cos, t));
    let (growth, first, second) = (g.call(Func::Exp, sin), g.mul(y, cos), g.mul(z, cos));
    let rates = vec![first, g.add(second, growth)];
    let start = vec![1.0, 0.5];
    Problem { name: "driven", graph: g, state, rates, time: Some(time), start, until: 7.0, motion: Motion::Driven }
}

/// y' = y², which ends at t = 1 from y = 1, and y' = 1/(2 y), which ends at t = 1 with y = 0 backward from y = 1: singular by growth
/// and by division.
pub(super) fn singular() -> [Problem; 2] {
    [1, 2].map(|kind| {
        let mut g = Graph::new();
        let symbol = g.symbol("y");
        let y = g.sym(symbol);
        let rate = if kind == 1 {
            g.powi(y, 2)
        } else {
            let (minus, half) = (g.int(-1), g.ratio(1, 2));
            let inverse = g.div(minus, y);
            g.mul(half, inverse)
        };
        let (state, rates) = (vec![symbol], vec![rate]);
        let name = ["growth", "division"][kind - 1];
        Problem { name, graph: g, state, rates, time: None, start: vec![1.0], until: 2.0, motion: Motion::Driven }
    })
}

#[test]
fn exact_solutions_begin_at_the_start_and_satisfy_the_equations() {
    use crate::integrator::System;
    use crate::number::Df64;
    for problem in Problem::all() {
        let start = problem.start::<f64>(&());
        let near = start.iter().zip(&problem.start).all(|(a, b)| (a - b).abs() < 1e-15);
        assert!(near, "{}: {start:?}", problem.name);
        let rates = problem.rates::<Df64>(&());
        let number = |x: f64| Df64::from(x);
        for t in [0.5, 3.0, 5.5] {
            let mut slope = problem.at(&number(t));
            rates.derivative(&number(t), &problem.at(&number(t)), &mut slope);
            let h = 1e-9;
            let (before, after) = (problem.at(&number(t - h)), problem.at(&number(t + h)));
            for (k, slope) in slope.iter().enumerate() {
                let difference = (after[k] - before[k]) / (number(t + h) - number(t - h));
                assert!((difference - *slope).hi().abs() < 1e-16, "{} at {t}: component {k}", problem.name);
            }
        }
    }
}
