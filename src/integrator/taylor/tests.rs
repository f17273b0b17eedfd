use super::*;
use crate::expr::{Func, Graph, SymId};
use crate::number::Df64;
use std::f64::consts::TAU;

/// The Kepler problem: x, y and their rates.
struct Kepler {
    graph: Graph,
    state: Vec<SymId>,
    rates: Vec<crate::expr::Expr>,
}

fn kepler() -> Kepler {
    let mut graph = Graph::new();
    let state: Vec<SymId> = ["x", "y", "u", "v"].map(|name| graph.symbol(name)).to_vec();
    let [x, y, u, v] = [0, 1, 2, 3].map(|k| graph.sym(state[k]));
    let (xx, yy) = (graph.powi(x, 2), graph.powi(y, 2));
    let square = graph.add(xx, yy);
    let exponent = graph.ratio(3, 2);
    let cube = graph.pow(square, exponent);
    let (ax, ay) = (graph.div(x, cube), graph.div(y, cube));
    let (ax, ay) = (graph.neg(ax), graph.neg(ay));
    Kepler { graph, state, rates: vec![u, v, ax, ay] }
}

impl Kepler {
    fn series(&self) -> Series {
        let equations = Equations { graph: &self.graph, state: &self.state, rates: &self.rates, time: None };
        Series::compile(&equations).unwrap()
    }
}

/// A perihelion at eccentricity e.
fn perihelion<N: Number>(e: f64, cx: &N::Context) -> Vec<N> {
    let number = |x: f64| N::from_f64(x, cx);
    let speed = number(1.0 + e).over(&number(1.0 - e)).root();
    vec![number(1.0 - e), number(0.0), number(0.0), speed]
}

fn distance<N: Number>(a: &[N], b: &[N]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a.minus(b).log2_abs()).fold(f64::NEG_INFINITY, f64::max)
}

#[test]
fn every_function_has_its_series() {
    let mut graph = Graph::new();
    let x = graph.symbol("x");
    let y = graph.sym(x);
    let (half, three) = (graph.ratio(1, 2), graph.int(3));
    let scaled = graph.mul(half, y);
    let mut rates: Vec<_> = Func::ALL
        .into_iter()
        .map(|f| {
            let argument = if f == Func::Acosh { graph.add(y, three) } else { scaled };
            graph.call(f, argument)
        })
        .collect();
    let square = graph.powi(y, -3);
    let exponent = graph.ratio(7, 5);
    let (power, own, root, angle) =
        (graph.pow(y, exponent), graph.pow(y, scaled), graph.sqrt(y), graph.atan2(scaled, three));
    rates.extend([square, power, own, root, angle]);
    for rate_of in rates {
        let series = Series::compile(&Equations { graph: &graph, state: &[x], rates: &[rate_of], time: None }).unwrap();
        let start = Df64::from_f64(0.625, &());
        let mut expansion = series.prepare(12, &[], &());
        series.expand(&start, &[start], &mut expansion);
        // The rate of the series is f of the series, by Jet's own recurrences.
        let jet = crate::number::Jet::new(start, expansion.of(0)[1..].iter().copied());
        let tape = crate::expr::Tape::compile(&graph, &[rate_of]);
        let of = tape.eval(std::slice::from_ref(&jet), &jet.context(), &mut crate::expr::Workspace::new())[0].clone();
        for k in 0..12 {
            let (rate, f) = (expansion.of(0)[k + 1].times(&start.like(k as f64 + 1.0)), &of.coefficients()[k]);
            let error = rate.minus(f).log2_abs() - f.log2_abs().max(rate.log2_abs()).max(-40.0);
            assert!(error < -85.0, "{:?} at order {k}: 2^{error}", graph.node(rate_of));
        }
    }
}

#[test]
fn the_error_follows_the_tolerance() {
    let kepler = kepler().series();
    let start = perihelion::<f64>(0.9, &());
    let mut before = f64::INFINITY;
    for tolerance in [1e-4, 1e-6, 1e-8, 1e-10, 1e-12] {
        let end = Taylor::with_tolerance(tolerance).integrate(&kepler, &[], (&0.0, &start), &TAU, |_| {}).unwrap();
        let error = distance(&end.y, &start).exp2();
        println!("tolerance {tolerance:e}: error {error:e} in {} steps of order {}", end.steps, end.order);
        assert!(error < before / 10.0 && error < 1e4 * tolerance, "{error:e} after {before:e}");
        before = error;
    }
}

#[test]
fn double_doubles_reach_their_own_precision() {
    let kepler = kepler().series();
    let start = perihelion::<Df64>(0.5, &());
    let turn = Df64::pi(&()).times(&Df64::from_f64(2.0, &()));
    let zero = Df64::from_f64(0.0, &());
    let end = Taylor::with_tolerance(1e-30).integrate(&kepler, &[], (&zero, &start), &turn, |_| {}).unwrap();
    let error = distance(&end.y, &start);
    assert!(error < -90.0, "2^{error} in {} steps of order {}", end.steps, end.order);
}

#[cfg(feature = "rug")]
#[test]
fn any_precision_is_reached() {
    use crate::number::Mpfr;
    let kepler = kepler().series();
    for (bits, tolerance, least) in [(256u32, -225.0, -200.0), (512, -480.0, -450.0)] {
        let start = perihelion::<Mpfr>(0.5, &bits);
        let turn = Mpfr::pi(&bits).times(&Mpfr::from_f64(2.0, &bits));
        let taylor = Taylor { log2_tolerance: tolerance, max_steps: 1000 };
        let zero = Mpfr::zero(&bits);
        let end = taylor.integrate(&kepler, &[], (&zero, &start), &turn, |_| {}).unwrap();
        let error = distance(&end.y, &start);
        println!("{bits} bits: 2^{error} in {} steps of order {}", end.steps, end.order);
        assert!(error < least, "{bits} bits: 2^{error} in {} steps of order {}", end.steps, end.order);
    }
}

#[test]
fn every_time_within_a_step_has_its_state() {
    let kepler = kepler().series();
    let start = perihelion::<f64>(0.3, &());
    let taylor = Taylor::with_tolerance(1e-15);
    let to = |t: f64| taylor.integrate(&kepler, &[], (&0.0, &start), &t, |_| {}).unwrap().y;
    let mut inner = Vec::new();
    let watch = |step: Step<'_, f64>| {
        for share in [0.0, 0.3, 1.0] {
            let s = share * step.h;
            inner.push((step.t0 + s, (0..step.dimension()).map(|i| step.at(i, &s)).collect::<Vec<_>>()));
        }
    };
    taylor.integrate(&kepler, &[], (&0.0, &start), &TAU, watch).unwrap();
    assert!(inner.len() > 15);
    for (t, y) in inner {
        assert!(distance(&y, &to(t)).exp2() < 1e-13, "at {t}");
    }
}

#[test]
fn it_runs_backward_to_where_it_began() {
    let kepler = kepler().series();
    let start = perihelion::<f64>(0.3, &());
    let taylor = Taylor::with_tolerance(1e-16);
    let there = taylor.integrate(&kepler, &[], (&0.0, &start), &20.0, |_| {}).unwrap();
    let back = taylor.integrate(&kepler, &[], (&20.0, &there.y), &0.0, |_| {}).unwrap();
    assert!(distance(&back.y, &start).exp2() < 1e-13);
}

/// y' = a cos t: the time and a parameter reach the recurrences.
#[test]
fn time_and_parameters_are_known() {
    let mut graph = Graph::new();
    let (y, t, a) = (graph.symbol("y"), graph.symbol("t"), graph.symbol("a"));
    let (time, factor) = (graph.sym(t), graph.sym(a));
    let cos = graph.call(Func::Cos, time);
    let rate = graph.mul(factor, cos);
    let series = Series::compile(&Equations { graph: &graph, state: &[y], rates: &[rate], time: Some(t) }).unwrap();
    assert_eq!(series.parameters(), [a]);
    let end = Taylor::with_tolerance(1e-16).integrate(&series, &[3.0], (&1.0, &[0.5]), &9.0, |_| {}).unwrap();
    let exact = 0.5 + 3.0 * (9f64.sin() - 1f64.sin());
    assert!((end.y[0] - exact).abs() < 1e-14, "{} and {exact}", end.y[0]);
}

#[test]
fn a_constant_rate_is_one_step() {
    let mut graph = Graph::new();
    let y = graph.symbol("y");
    let rate = graph.int(2);
    let series = Series::compile(&Equations { graph: &graph, state: &[y], rates: &[rate], time: None }).unwrap();
    let end = Taylor::with_tolerance(1e-16).integrate(&series, &[], (&0.0, &[1.0]), &8.0, |_| {}).unwrap();
    assert_eq!((end.y, end.steps), (vec![17.0], 1));
    let none = Taylor::with_tolerance(1e-16).integrate(&series, &[], (&8.0, &[1.0]), &8.0, |_| {}).unwrap();
    assert_eq!((none.y, none.steps), (vec![1.0], 0));
}

#[test]
fn a_singularity_is_an_error_with_its_time() {
    let mut graph = Graph::new();
    let y = graph.symbol("y");
    let of = graph.sym(y);
    let rate = graph.powi(of, 2);
    let series = Series::compile(&Equations { graph: &graph, state: &[y], rates: &[rate], time: None }).unwrap();
    let end = Taylor::with_tolerance(1e-12).integrate(&series, &[], (&0.0, &[1.0]), &2.0, |_| {});
    let time = match end {
        Err(IntegrationError::StepTooShort { t, .. } | IntegrationError::NotFinite { t }) => t,
        other => panic!("{other:?}"),
    };
    assert!((time - 1.0).abs() < 1e-6, "y = 1/(1 - t) ends at 1, not at {time}");
    let few = Taylor { max_steps: 2, ..Taylor::with_tolerance(1e-12) };
    let kepler = kepler().series();
    let end = few.integrate(&kepler, &[], (&0.0, &perihelion::<f64>(0.5, &())), &TAU, |_| {});
    assert!(matches!(end, Err(IntegrationError::TooManySteps { steps: 2, .. })));
}

#[test]
fn what_has_no_recurrence_is_said() {
    let mut graph = Graph::new();
    let y = graph.symbol("y");
    let (of, k) = (graph.sym(y), graph.ratio(1, 2));
    let rate = graph.elliptic(crate::number::Elliptic::Sn, &[of, k]);
    let error = Series::compile(&Equations { graph: &graph, state: &[y], rates: &[rate], time: None }).unwrap_err();
    assert!(error.to_string().contains("no recurrence"), "{error}");
}
