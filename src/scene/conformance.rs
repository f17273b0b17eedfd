//! The conformance suite of models: what every model of every scene promises.
//!
//! A new scene is tested as soon as it stands in [`SCENES`]; motions worth a test of their own are added to [`motions`].

use super::*;

/// A motion of a scene: the parameters that differ from their defaults, and how long it is followed.
struct Case {
    name: &'static str,
    set: &'static [(&'static str, f64)],
    until: f64,
}

const fn case(name: &'static str, set: &'static [(&'static str, f64)], until: f64) -> Case {
    Case { name, set, until }
}

/// The motions that a scene is tried at, the default one first.
fn motions(scene: &Scene) -> Vec<Case> {
    let mut cases = vec![case("default", &[], 20.0)];
    match scene.name {
        "top" => cases.extend(top_motions()),
        "free" => cases.extend(free_motions()),
        "wobble" => cases.extend(wobble_motions()),
        "mercury" => cases.extend(mercury_motions()),
        _ => {}
    }
    cases
}

fn top_motions() -> [Case; 10] {
    [
        case("loops", &[("phi_rate", -2.0), ("theta_0", 0.8)], 15.0),
        case("waves", &[("phi_rate", 0.7), ("theta_0", 0.8), ("theta_rate", 0.1)], 15.0),
        case("fast spin", &[("omega_zeta", 80.0), ("theta_rate", 0.5)], 3.0),
        case("backward spin", &[("omega_zeta", -7.0), ("theta_rate", -0.3), ("phi_0", 1.0), ("psi_0", -2.0)], 15.0),
        case("near sleeping", &[("theta_0", 1e-4), ("phi_rate", 1.25), ("omega_zeta", 4.2)], 20.0),
        case("pendulum with a little spin", &[("omega_zeta", 0.1), ("theta_0", 1.5)], 15.0),
        case("inverted, below the fixed point", &[("theta_0", 2.9), ("theta_rate", 0.5)], 15.0),
        case("from the lower turning point", &[("phi_rate", 0.9), ("theta_0", 1.3), ("omega_zeta", 4.0)], 15.0),
        case("near the separatrix", &[("omega_zeta", 2.0), ("phi_rate", 0.577_350_269_189), ("theta_0", 1.1)], 15.0),
        case("flat moment of inertia", &[("I_0", 0.01), ("I_1", 0.012), ("mgl", 0.1), ("omega_zeta", 60.0)], 1.0),
    ]
}

fn free_motions() -> [Case; 9] {
    [
        case("round the smallest moment", &[("omega_1", -1.0), ("omega_3", 0.2)], 20.0),
        case("middle axis, one side", &[("omega_1", 0.1), ("omega_2", -1.0), ("omega_3", 0.1)], 20.0),
        case("middle axis, other side", &[("omega_1", 0.1), ("omega_2", 1.0), ("omega_3", 0.04)], 20.0),
        // With A, B, C = 1, 2, 3 the separatrix is omega_1^2 = 3 omega_3^2.
        case(
            "near the separatrix",
            &[("A", 1.0), ("omega_1", 1.732_050_807_568), ("omega_2", 0.5), ("omega_3", 1.0)],
            12.0,
        ),
        case(
            "beyond the separatrix",
            &[("A", 1.0), ("omega_1", 1.732_050_807_57), ("omega_2", 0.5), ("omega_3", -1.0)],
            12.0,
        ),
        case("prolate, equal moments", &[("A", 2.0), ("C", 0.7)], 20.0),
        case("nearly equal moments", &[("A", 1.999_999_999)], 20.0),
        case("another order", &[("A", 3.0), ("B", 1.0), ("C", 2.0), ("omega_3", -0.6)], 20.0),
        case("yet another order", &[("A", 2.0), ("B", 3.5), ("C", 1.0), ("omega_2", -0.9)], 20.0),
    ]
}

/// In units of Omega, with a deformation that is no small one.
fn wobble_motions() -> [Case; 3] {
    const A: (&str, f64) = ("Omega", 1.0);
    const B: (&str, f64) = ("H", 0.1);
    const C: (&str, f64) = ("alpha", 0.005);
    const D: (&str, f64) = ("nu", -0.06);
    [
        case("wide wobble", &[A, B, C, D, ("J_0", 0.3), ("l_0", 1.0)], 300.0),
        case("from no wobble", &[A, B, C, D, ("J_0", 0.0)], 300.0),
        case("asymmetric", &[A, B, C, D, ("J_0", 0.2), ("asymmetry", 0.03), ("counter", 0.5)], 300.0),
    ]
}

/// In units of n.
fn mercury_motions() -> [Case; 4] {
    [
        case("libration", &[("n", 1.0)], 200.0),
        case("circulation", &[("n", 1.0), ("spin_0", 1.6), ("l_0", 2.0)], 200.0),
        case("eccentric orbit", &[("n", 1.0), ("e", 0.6), ("epsilon", 1e-3)], 100.0),
        case("circular orbit", &[("n", 1.0), ("e", 0.0), ("epsilon", 0.1), ("spin_0", 1.0)], 100.0),
    ]
}

fn parameters(scene: &Scene, case: &Case) -> Vec<f64> {
    let mut values = scene.defaults();
    for (name, value) in case.set {
        values[scene.parameter(name).unwrap()] = *value;
    }
    values
}

fn times(until: f64) -> Vec<f64> {
    // Unevenly, from 0 on.
    (0..=12).map(|i| until * (f64::from(i) / 12.0).powf(1.1)).collect()
}

/// The number types that every model is tried in.
fn ladder() -> Vec<Arithmetic> {
    vec![
        Arithmetic::Machine,
        Arithmetic::Double,
        #[cfg(feature = "rug")]
        Arithmetic::Bits(200),
    ]
}

/// The fullest equations, integrated in double-double.
fn truth(scene: &'static Scene, parameters: &[f64], quantities: &[usize], times: &[f64]) -> Option<Values> {
    integrated(&Task { scene, parameters, quantities, times, tolerance: 1e-28 })
}

fn integrated(task: &Task) -> Option<Values> {
    let integrated = |m: &&&dyn AnyModel| m.about().kind == Kind::Integrated && m.gives(task.quantities);
    task.scene.models.iter().rev().filter(integrated).find_map(|m| Some(m.run(task, Arithmetic::Double).ok()?.0))
}

/// A relative change of a parameter that is small beside every distance from a separatrix, and large beside rounding.
const CHANGE: f64 = 1e-13;

/// How far each quantity moves when the parameters change by a relative 1: the condition of the motion. An error that is
/// made on the way grows as one that is made at the beginning.
fn condition(scene: &'static Scene, parameters: &[f64], quantities: &[usize], times: &[f64]) -> Vec<f64> {
    let run = |parameters: &[f64]| {
        integrated(&Task { scene, parameters, quantities, times, tolerance: 1e-22 })
            .unwrap_or_else(|| panic!("no truth"))
    };
    let here = run(parameters);
    let mut condition = vec![0.0; quantities.len()];
    for (k, value) in parameters.iter().enumerate() {
        let size = if *value == 0.0 { 1.0 } else { value.abs() };
        let mut changed = parameters.to_vec();
        changed[k] += CHANGE * size;
        let change = (changed[k] - value) / size;
        let there = run(&changed);
        for (row, condition) in condition.iter_mut().enumerate() {
            *condition += here.row(row).distance(&there.row(row)) / change;
        }
    }
    condition
}

/// Every model in every number type gives what the fullest equations give: exact and integrated ones to within
/// rounding and tolerance. (Approximations are held to their order by the tests of their scenes.)
#[test]
fn all_models_of_a_scene_agree() {
    for scene in SCENES {
        for case in motions(scene) {
            let all: Vec<usize> = (0..scene.quantities.len()).collect();
            let (parameters, times) = (parameters(scene, &case), times(case.until));
            let truth = truth(scene, &parameters, &all, &times).unwrap();
            let condition = condition(scene, &parameters, &all, &times);
            let exact = Exact { truth, condition };
            for model in scene.models.iter().filter(|m| m.about().kind != Kind::Approximation) {
                let machine = agrees(scene, &case, *model, Arithmetic::Machine, &exact);
                assert!(machine || case.name != "default", "{}: {} gives no numbers", scene.name, model.about().name);
                // In many bits an implicit method takes minutes; the integrators' own suite has it there.
                let implicit = model.about().name == "gauss-legendre";
                for arithmetic in ladder().into_iter().skip(1).filter(|a| !implicit || a.bits() <= 104) {
                    agrees(scene, &case, *model, arithmetic, &exact);
                }
            }
        }
    }
}

/// The errors of one tolerance that a step may make.
const ERRORS: f64 = 10.0;

/// What a motion is, and how it is conditioned.
struct Exact {
    truth: Values,
    condition: Vec<f64>,
}

/// Compares a model with the fullest equations in all quantities that it gives; false where it does not apply. Every model
/// is to apply to its scene's default motion in machine numbers.
fn agrees(scene: &'static Scene, case: &Case, model: &dyn AnyModel, arithmetic: Arithmetic, exact: &Exact) -> bool {
    let (parameters, times) = (parameters(scene, case), times(case.until));
    let what = format!("{}, {}: {} in {}", scene.name, case.name, model.about().name, arithmetic.name());
    let quantities: Vec<usize> = (0..scene.quantities.len()).filter(|q| model.gives(&[*q])).collect();
    let tolerance = (8.0 * f64::exp2(-f64::from(arithmetic.bits().min(104)))).max(1e-26);
    let task = Task { scene, parameters: &parameters, quantities: &quantities, times: &times, tolerance };
    let (values, cost) = match model.run(&task, arithmetic) {
        Ok(run) => run,
        Err(SceneError::Regime { .. } | SceneError::NotGiven { .. }) => return false,
        Err(why) => panic!("{what}: {why}"),
    };
    // Each step may err by the tolerance, and each error grows as the motion's condition says.
    let steps = cost.steps.max(1) as f64;
    let sizes = exact.truth.to_f64();
    for (row, &quantity) in quantities.iter().enumerate() {
        let most = sizes[quantity].iter().fold(1.0_f64, |most, x| most.max(x.abs()));
        let distance = values.row(row).distance(&exact.truth.row(quantity));
        let bound = ERRORS * tolerance * steps * (most + exact.condition[quantity]);
        let name = scene.quantities[quantity].name;
        println!("{what}: {name} {distance:.1e}, bound {bound:.1e}");
        assert!(distance < bound, "{what}: {name} is off by {distance:e}, bound {bound:e}");
    }
    true
}

/// A quantity alone is what it is among others.
#[test]
fn quantities_do_not_depend_on_what_else_is_asked() {
    for scene in SCENES {
        let parameters = scene.defaults();
        let times = times(5.0);
        for model in scene.models {
            let gives: Vec<usize> = (0..scene.quantities.len()).filter(|q| model.gives(&[*q])).collect();
            let run = |quantities: &[usize]| {
                let task = Task { scene, parameters: &parameters, quantities, times: &times, tolerance: 1e-14 };
                model.run(&task, Arithmetic::Machine).map(|(values, _)| values.to_f64())
            };
            let Ok(all) = run(&gives) else { continue };
            for (row, &quantity) in gives.iter().enumerate() {
                let alone = run(&[quantity]).unwrap();
                for (a, b) in alone[0].iter().zip(&all[row]) {
                    assert!((a - b).abs() <= 1e-10 * (1.0 + b.abs()), "{}: {a} and {b}", model.about().name);
                }
            }
        }
    }
}

/// What is wrong with a request is an error in words, not a number.
#[test]
fn bad_requests_are_errors() {
    for scene in SCENES {
        let parameters = scene.defaults();
        for model in scene.models {
            for times in [&[1.0, 0.5][..], &[-1.0], &[f64::NAN], &[f64::INFINITY]] {
                let task = Task { scene, parameters: &parameters, quantities: &[0], times, tolerance: 1e-9 };
                assert_eq!(model.run(&task, Arithmetic::Machine), Err(SceneError::Times));
            }
            let task = Task { scene, parameters: &[], quantities: &[0], times: &[1.0], tolerance: 1e-9 };
            if model.gives(&[0]) {
                let finite = |v: &(Values, Cost)| v.0.to_f64().iter().flatten().all(|x| x.is_finite());
                assert!(!model.run(&task, Arithmetic::Machine).as_ref().is_ok_and(finite), "{}", model.about().name);
            }
        }
        assert!(matches!(scene.quantity("nonsense"), Err(SceneError::Unknown { .. })));
        let names: Vec<&str> = scene.models.iter().map(|m| m.about().name).collect();
        let mut unique = names.clone();
        unique.sort_unstable();
        unique.dedup();
        assert_eq!(unique.len(), names.len(), "two models of {} have one name", scene.name);
    }
}

/// Small numbers that look random.
struct Dice(u64);

impl Dice {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    fn between(&mut self, a: f64, b: f64) -> f64 {
        a + (b - a) * self.next()
    }
}

/// The choice never gives an error larger than asked: at random motions, errors and quantities, against the fullest
/// equations in double-double at all times, not only at those that were probed.
#[test]
fn the_choice_meets_the_error_asked_for() {
    let mut dice = Dice(7);
    let mut taken = std::collections::BTreeSet::new();
    for scene in SCENES {
        for _ in 0..24 {
            let mut parameters = scene.defaults();
            for (value, of) in parameters.iter_mut().zip(scene.parameters) {
                let wide = dice.between(0.6, 1.4);
                *value = if of.default == 0.0 { dice.between(-0.5, 0.5) } else { of.default * wide };
            }
            let quantity = (dice.next() * scene.quantities.len() as f64) as usize;
            let error = 10f64.powf(dice.between(-14.0, 0.5));
            let until = dice.between(0.5, 6.0);
            let times: Vec<f64> = (0..150).map(|i| until * f64::from(i) / 149.0).collect();
            let request =
                Request { scene, parameters, quantities: vec![quantity], times, error, model: None, bits: None };
            let outcome = choose(&request).unwrap_or_else(|why| panic!("{}: {why} in {request:?}", scene.name));
            let truth = truth(scene, &request.parameters, &[quantity], &request.times).unwrap();
            let distance = outcome.values.distance(&truth);
            assert!(outcome.met && distance <= error, "{}: {distance:e} for {error:e}", outcome.model.name);
            taken.insert((scene.name, outcome.model.name, outcome.arithmetic.name()));
        }
    }
    println!("{taken:?}");
    assert!(taken.len() > SCENES.len(), "it is always the same: {taken:?}");
}
