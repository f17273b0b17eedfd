use super::super::value::V;
use super::super::*;
use super::closed::equilibrium;
use super::start::Start;
use super::*;
use crate::number::Df64;

/// A body with Omega = 1; `size` is that of J_0 and alpha together.
fn parameters(size: f64, counter: f64, asymmetry: f64) -> Vec<f64> {
    vec![1.0, 0.1, asymmetry, 0.02 * size, counter, -0.06, 0.4, size, 2.0]
}

fn run(model: &str, parameters: &[f64], times: &[f64]) -> Values {
    let task = Task { scene: &SCENE, parameters, quantities: &[0, 1, 2], times, tolerance: 1e-20 };
    SCENE.model(model).unwrap().run(&task, Arithmetic::Double).unwrap().0
}

fn times(until: f64) -> Vec<f64> {
    (0..=60).map(|i| until * f64::from(i) / 60.0).collect()
}

/// Where A = B and the deformation goes round one way, nothing is averaged away.
#[test]
fn the_resonant_term_is_all_of_a_symmetric_motion() {
    let (parameters, times) = (parameters(0.3, 0.0, 0.0), times(400.0));
    let error = run("averaged", &parameters, &times).distance(&run("full", &parameters, &times));
    assert!(error < 1e-17, "{error:e}");
}

/// What the averaged and linear motions leave out: the counter-rotating part, the asymmetry, J^3.
#[test]
fn errors_have_their_orders() {
    let error = |model: &str, of: [f64; 3]| {
        let (parameters, times) = (parameters(of[0], of[1], of[2]), times(200.0));
        run(model, &parameters, &times).distance(&run("full", &parameters, &times))
    };
    let cases = [
        ("averaged", [0.1, 2e-3, 0.0], [0.1, 1e-3, 0.0], 1.0),
        ("averaged", [0.1, 0.0, 2e-4], [0.1, 0.0, 1e-4], 1.0),
        ("linear", [2e-2, 0.0, 0.0], [1e-2, 0.0, 0.0], 3.0),
    ];
    for (model, coarse, fine, order) in cases {
        let measured = (error(model, coarse) / error(model, fine)).log2();
        println!("{model} {coarse:?}: order {measured:.3}");
        assert!((measured - order).abs() < 0.1, "{model} {coarse:?}: order {measured}");
    }
}

/// In equilibrium J does not change, in the equations as they are.
#[test]
fn an_equilibrium_stays() {
    for nu in [-0.06, -0.15] {
        let mut parameters = parameters(0.2, 0.0, 0.0);
        parameters[5] = nu;
        let task = Task { scene: &SCENE, parameters: &parameters, quantities: &[], times: &[], tolerance: 1e-9 };
        let p = equilibrium(&Start::<Df64>::read(&task, &()).unwrap()).unwrap().0.hi();
        // Below Euler's frequency, -0.1, the equilibrium is at pi, above it at 0 of the critical angle.
        assert_eq!(p > 0.0, nu < -0.1);
        (parameters[7], parameters[8]) = (p.asin(), parameters[6]);
        let times = times(300.0);
        let error = run("full", &parameters, &times).distance(&run("equilibrium", &parameters, &times));
        assert!(error < 1e-13, "{nu}: {error:e}");
    }
}

/// (537): with alpha = 0.95e-9 and J_0 = 0.2'' the wobble goes round once in 434 turns, as Chandler found, and not in 305.
#[test]
fn the_earth_wobbles_in_chandlers_period() {
    let mut parameters = SCENE.defaults();
    parameters[2] = 0.0;
    let task = Task { scene: &SCENE, parameters: &parameters, quantities: &[], times: &[], tolerance: 1e-9 };
    let start = Start::<f64>::read(&task, &()).unwrap();
    let amplitude = -equilibrium(&start).unwrap().0;
    assert!((amplitude / 9.696e-7 - 1.0).abs() < 0.01, "{amplitude}");
    let [epsilon, sigma] = start.rates().map(|V(x)| x);
    let axis = start.omega.0 * (1.0 + parameters[1]);
    assert!((axis / sigma + 305.0).abs() < 0.1, "{}", axis / sigma);
    let with_deformation = axis / (sigma + epsilon / 9.696e-7);
    assert!((with_deformation + 434.0).abs() < 1.0, "{with_deformation}");
}

#[test]
fn resonance_itself_is_said() {
    let mut parameters = parameters(0.1, 0.0, 0.0);
    (parameters[1], parameters[5]) = (0.125, -0.125);
    let task = Task { scene: &SCENE, parameters: &parameters, quantities: &[0], times: &[1.0], tolerance: 1e-9 };
    let run = |name: &str| SCENE.model(name).unwrap().run(&task, Arithmetic::Machine);
    assert!(matches!(run("linear"), Err(SceneError::Regime { .. })));
    assert!(run("full").is_ok());
}
