use super::super::*;
use super::equations::prepared;
use super::start::Start;
use super::*;
use crate::integrator::{GaussLegendre, integrate_fixed};

const ARC_SECOND: f64 = std::f64::consts::PI / 648_000.0;

/// The defaults with some parameters set.
fn parameters(set: &[(&str, f64)]) -> Vec<f64> {
    let mut parameters = SCENE.defaults();
    for (name, value) in set {
        parameters[SCENE.parameter(name).unwrap()] = *value;
    }
    parameters
}

fn run(model: &str, parameters: &[f64], times: &[f64]) -> Vec<Vec<f64>> {
    let task = Task { scene: &SCENE, parameters, quantities: &[0, 1, 2, 3], times, tolerance: 1e-20 };
    SCENE.model(model).unwrap().run(&task, Arithmetic::Double).unwrap().0.to_f64()
}

fn distance(a: &[Vec<f64>], b: &[Vec<f64>]) -> f64 {
    a.iter().flatten().zip(b.iter().flatten()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

fn times(until: f64) -> Vec<f64> {
    (0..=300).map(|i| until * f64::from(i) / 300.0).collect()
}

/// 50.3'' a year, 17.2'' in longitude and 9.2'' in obliquity (IAU 1980), in the equations as they are, to the per cent that
/// circular orbits are good for.
#[test]
fn the_earth_precesses_and_nutates_as_observed() {
    let values = run("full", &SCENE.defaults(), &times(2.0 * 18.613));
    // Over two turns of the node: a mean, and half the range of what is periodic.
    let slope = (values[0][300] - values[0][0]) / (2.0 * 18.613) / ARC_SECOND;
    assert!((slope + 50.3).abs() < 0.6, "{slope}''/yr");
    for (row, amplitude, other) in [(0, 17.2, 2.0), (1, 9.2, 0.9)] {
        let drift = |i: usize| if row == 0 { slope * ARC_SECOND * 2.0 * 18.613 * i as f64 / 300.0 } else { 0.0 };
        let periodic = values[row].iter().enumerate().map(|(i, x)| x - drift(i));
        let (low, high) = periodic.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)));
        let half = (high - low) / 2.0 / ARC_SECOND;
        println!("{amplitude}: {half}");
        // The semiannual and fortnightly terms add up to some 2'' and 0.9''.
        assert!(half > amplitude - 0.3 && half < amplitude + other, "{half}'' and {amplitude}''");
    }
}

/// The errors fall with the torque: that of the precession alone with its first power, that of the series with its second.
#[test]
fn errors_fall_with_the_torque_at_their_order() {
    type Set = &'static [(&'static str, f64)];
    let cases: [(&str, Set, f64); 3] = [
        ("precession", &[], 1.0),
        // The Sun alone: no slow node in the fast terms.
        ("nutation", &[("moon", 0.0)], 2.0),
        // A ring: no fast terms.
        ("nutation", &[("sun", 0.0), ("n_moon", 2e5), ("moon", 2e-9)], 2.0),
    ];
    for (model, set, order) in cases {
        let error = |h: f64| {
            let parameters = parameters(&[set, &[("H", h)]].concat());
            let times = times(10.0);
            distance(
                &run(model, &parameters, &times),
                &run(if set.len() == 3 { "averaged" } else { "full" }, &parameters, &times),
            )
        };
        let (coarse, fine) = (error(2e-2), error(1e-2));
        let measured = (coarse / fine).log2();
        println!("{model} {set:?}: {coarse:e}, {fine:e}: order {measured:.3}");
        assert!((measured - order).abs() < 0.1, "{model} {set:?}: order {measured}, {coarse:e}, {fine:e}");
    }
}

/// The averaged equations leave out the fast terms: their error falls as the Moon goes faster round, with the torque kept.
#[test]
fn the_average_is_the_limit_of_fast_revolutions() {
    let error = |n: f64| {
        let share = 0.012 * (84.0 / n).powi(2);
        let parameters = parameters(&[("sun", 0.0), ("n_moon", n), ("moon", share)]);
        let times = times(5.0);
        distance(&run("averaged", &parameters, &times), &run("full", &parameters, &times))
    };
    let order = (error(84.0) / error(168.0)).log2();
    assert!((order - 1.0).abs() < 0.1, "{order}");
}

/// What the models leave out for the Earth in 20 years: the series terms of second order, some hundredths of an arc second.
#[test]
fn the_series_is_good_to_hundredths_of_an_arc_second() {
    let (parameters, times) = (SCENE.defaults(), times(20.0));
    let full = run("full", &parameters, &times);
    let error = |model: &str| distance(&run(model, &parameters, &times), &full) / ARC_SECOND;
    let (precession, averaged, series) = (error("precession"), error("averaged"), error("nutation"));
    println!("precession {precession:.3}'', averaged {averaged:.3}'', series {series:.6}''");
    assert!(precession > 10.0 && averaged < 3.0 && series < 0.05, "{precession} {averaged} {series}");
}

/// The rotating rigid body itself, L' = torque and e' = (L/A) x e, from J = 0: its axis stays where the model without J
/// has it, to the diurnal terms, of the size f/omega.
#[test]
fn the_rotating_body_follows() {
    let (until, steps) = (0.05, 4000);
    let parameters = SCENE.defaults();
    let task = Task { scene: &SCENE, parameters: &parameters, quantities: &[], times: &[], tolerance: 1e-9 };
    let (named, start) = prepared(&Start::<f64>::read(&task, &()).unwrap());
    let of = |name: &str| named.iter().find(|(n, _)| *n == name).unwrap().1;
    let [moon, sun, cos_i, sin_i] = ["moon", "sun", "cos_i", "sin_i"].map(of);
    let (rates, turn) = (["n_node", "n_moon", "n_sun"].map(of), parameters[0] / (1.0 - parameters[1]));
    let cross =
        |a: [f64; 3], b: [f64; 3]| [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    // l is the angular momentum in units of C omega.
    let system = |t: &f64, y: &[f64], slope: &mut [f64]| {
        let (l, e) = ([y[0], y[1], y[2]], [y[3], y[4], y[5]]);
        let angle = |k: usize| start[4 + 2 * k].atan2(start[3 + 2 * k]) + rates[k] * t;
        let ((s, c), (v, u), (q, p)) = (angle(0).sin_cos(), angle(1).sin_cos(), angle(2).sin_cos());
        let m = [c * u - s * cos_i * v, s * u + c * cos_i * v, sin_i * v];
        let (by_moon, by_sun) = (cross(m, e), cross([p, q, 0.0], e));
        let precession = cross(l, e);
        for k in 0..3 {
            slope[k] = moon * dot(e, m) * by_moon[k] + sun * dot(e, [p, q, 0.0]) * by_sun[k];
            slope[3 + k] = turn * precession[k];
        }
    };
    let axis = [start[0], start[1], start[2]];
    let mut method = GaussLegendre::new(4, &system, 6, &());
    let first = [axis, axis].concat();
    let end = integrate_fixed(&mut method, (&0.0, &first), &(until / f64::from(steps)), steps as usize, |_, _| {});
    let end = end.unwrap();
    let model = run("full", &parameters, &[until]);
    let (h, obliquity) = (end[3].atan2(-end[4]), end[3].hypot(end[4]).atan2(end[5]));
    let size = (moon + sun) / parameters[0];
    let moved = (model[0][0].hypot(model[1][0] - axis[2].acos())) / size;
    let error = (h - model[0][0]).hypot(obliquity - model[1][0]) / size;
    println!("moved by {moved:.1}, off by {error:.3} f/omega");
    assert!(error < 4.0 && moved > 10.0, "{error} and {moved}");
}
