use super::super::*;
use super::equations::hansen;
use super::start::{LIBRATION, PSI, SIGMA, SPIN};
use super::*;
use crate::number::Df64;

/// Parameters with an unhurried unit of time: n = 1.
fn parameters(e: f64, epsilon: f64, l: f64, sigma: f64, spin: f64) -> Vec<f64> {
    vec![1.0, e, epsilon, l, sigma, spin]
}

fn run(model: &dyn AnyModel, parameters: &[f64], times: &[f64]) -> Values {
    let task = Task { scene: &SCENE, parameters, quantities: &[SIGMA, LIBRATION, PSI, SPIN], times, tolerance: 1e-20 };
    model.run(&task, Arithmetic::Double).unwrap().0
}

fn times(until: f64) -> Vec<f64> {
    (0..=40).map(|i| until * f64::from(i) / 40.0).collect()
}

/// (7/2) e - (123/16) e^3 + (489/128) e^5 (Cayley 1861), and without eccentricity only cos(2 f - 2 l) is left.
#[test]
fn hansens_coefficients_have_their_series() {
    let series = |e: Df64| e * 3.5 - e * e * e * 7.6875 + e * e * e * e * e * (489.0 / 128.0);
    let rest = |e: f64| (hansen(&super::super::value::V(Df64::from(e)), 3).0 - series(Df64::from(e))).hi().abs();
    let order = (rest(0.02) / rest(0.01)).log2();
    assert!((order - 7.0).abs() < 0.05, "{order}");
    for j in [-3, 0, 1, 2, 3, 5] {
        let value = hansen(&super::super::value::V(0.0f64), j).0;
        assert!((value - f64::from(j == 2)).abs() < 1e-15, "{j}: {value}");
    }
}

/// Jacobi's functions and the integration of the averaged equations are the same motion: libration, circulation either
/// way, near the separatrix, over turns.
#[test]
fn the_pendulum_in_closed_form_is_the_averaged_motion() {
    let cases = [(0.5, 1.5), (-3.0, 1.5), (2.0, 1.504), (7.0, 1.499), (1.0, 1.53), (-0.5, 1.46), (3.1, 1.5001)];
    for (sigma, spin) in cases {
        let parameters = parameters(0.2056, 1e-4, 0.3, sigma, spin);
        let times = times(2000.0);
        let closed = run(SCENE.model("pendulum").unwrap(), &parameters, &times);
        let integrated = run(SCENE.model("averaged").unwrap(), &parameters, &times);
        let error = closed.distance(&integrated);
        println!("sigma {sigma}, spin {spin}: {error:e}");
        assert!(error < 1e-17, "sigma {sigma}, spin {spin}: {error:e}");
    }
}

/// The errors of the averaged models against the rotation as it is, over the same number of librations: that of the pendulum from
/// an osculating start falls with sqrt(epsilon), that of the corrected one with epsilon.
#[test]
fn errors_fall_with_the_asymmetry_at_their_order() {
    // So small an eccentricity that the notes' H is exact enough for the order to show.
    let error = |model: &str, epsilon: f64| {
        let parameters = parameters(0.05, epsilon, 0.7, 0.5, 1.5);
        let times = times(3.0 / epsilon.sqrt());
        run(SCENE.model(model).unwrap(), &parameters, &times).distance(&run(
            SCENE.model("spin-orbit").unwrap(),
            &parameters,
            &times,
        ))
    };
    for (model, order) in [("pendulum", 0.5), ("averaged", 0.5), ("corrected", 1.0)] {
        let (coarse, fine) = (error(model, 1e-5), error(model, 1e-7));
        let measured = (coarse / fine).log10() / 2.0;
        println!("{model}: {coarse:e}, {fine:e}: order {measured:.3}");
        assert!((measured - order).abs() < 0.1, "{model}: order {measured}, {coarse:e} and {fine:e}");
    }
}

/// The error of small librations falls with the cube of their amplitude.
#[test]
fn small_librations_are_linear() {
    let error = |sigma: f64| {
        let parameters = parameters(0.2056, 1e-4, 0.0, sigma, 1.5);
        let times = times(300.0);
        run(SCENE.model("libration").unwrap(), &parameters, &times).distance(&run(
            SCENE.model("pendulum").unwrap(),
            &parameters,
            &times,
        ))
    };
    let order = (error(0.2) / error(0.1)).log2();
    assert!((order - 3.0).abs() < 0.1, "{order}");
}

/// Mercury's librations take some 17 years: 2 pi/(n sqrt(3 epsilon H)); the integrated rotation crosses zero at half of that.
#[test]
fn mercury_librates_in_its_period() {
    let n = 26.088;
    let h = 3.5 * 0.2056 - 7.6875 * 0.2056f64.powi(3);
    let period = std::f64::consts::TAU / (n * (3.0 * 9.8e-5 * h).sqrt());
    assert!((period - 17.4).abs() < 0.2, "{period}");
    let parameters = SCENE.defaults();
    let times: Vec<f64> = (0..2000).map(|i| f64::from(i) * 0.02).collect();
    let values = run(SCENE.model("spin-orbit").unwrap(), &parameters, &times).to_f64();
    let crossing = values[SIGMA].windows(2).position(|w| w[0] > 0.0 && w[1] <= 0.0).unwrap() as f64 * 0.02;
    // A quarter of the period, 1.6 per cent longer at half a radian, with what the fast terms do at the start.
    assert!((crossing / (period / 4.0) - 1.0).abs() < 0.1, "{crossing} of {period}");
}

#[test]
fn an_unstable_resonance_is_said() {
    let task = Task {
        scene: &SCENE,
        parameters: &parameters(0.2, -1e-4, 0.0, 0.1, 1.5),
        quantities: &[SIGMA],
        times: &[1.0],
        tolerance: 1e-9,
    };
    let run = |name: &str| SCENE.model(name).unwrap().run(&task, Arithmetic::Machine);
    assert!(matches!(run("pendulum"), Err(SceneError::Regime { .. })));
    assert!(run("spin-orbit").is_ok());
}
