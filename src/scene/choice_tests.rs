//! What the choice takes, and why.

use super::*;

fn request(name: &str, quantities: &[&str], error: f64) -> Request {
    let scene = scene(name).unwrap();
    Request {
        scene,
        parameters: scene.defaults(),
        quantities: quantities.iter().map(|q| scene.quantity(q).unwrap()).collect(),
        times: (0..=200).map(|i| f64::from(i) / 10.0).collect(),
        error,
        model: None,
        bits: None,
    }
}

fn set(request: &mut Request, name: &str, value: f64) {
    let position = request.scene.parameter(name).unwrap();
    request.parameters[position] = value;
}

/// A wide error is met by steady precession, a smaller one by small nutation, the smallest by the closed form.
#[test]
fn the_cheapest_model_is_taken() {
    let taken = |error: f64| {
        let mut request = request("top", &["theta"], error);
        set(&mut request, "omega_zeta", 60.0);
        let outcome = choose(&request).unwrap();
        assert!(outcome.met && outcome.measured <= error);
        outcome
    };
    assert_eq!(taken(1e-1).model.name, "steady-slow");
    assert_eq!(taken(1e-3).model.name, "nutation");
    let exact = taken(1e-12);
    assert_eq!((exact.model.name, exact.arithmetic), ("closed", Arithmetic::Machine));
    // Each of the cheaper ones was measured, and told why not.
    assert_eq!(exact.refused.len(), 3);
    assert!(exact.refused.iter().all(|r| r.measured.is_some_and(|e| e > 1e-12)));
    assert!(exact.probes < 100, "{}", exact.probes);
}

#[test]
fn more_digits_than_machine_numbers_have_are_double() {
    let outcome = choose(&request("top", &["theta", "psi"], 1e-22)).unwrap();
    assert_eq!((outcome.model.name, outcome.arithmetic), ("closed", Arithmetic::Double));
    assert!(matches!(outcome.values, Values::Double(_)));
}

#[test]
fn more_digits_than_there_are_take_rug() {
    let outcome = choose(&request("top", &["theta"], 1e-45));
    if cfg!(feature = "rug") {
        assert!(outcome.unwrap().met);
    } else {
        let error = outcome.unwrap_err();
        assert!(matches!(error, SceneError::OutOfReach { .. }), "{error:?}");
        assert!(error.to_string().contains("closed"), "{error}");
    }
}

/// A model that is asked for by name is taken, and told to miss.
#[test]
fn a_model_asked_for_by_name_may_miss() {
    let mut request = request("top", &["theta"], 1e-9);
    request.model = Some("steady-slow".into());
    let outcome = choose(&request).unwrap();
    assert!(!outcome.met && outcome.measured > 1e-9 && outcome.values.to_f64()[0].len() == 201);
    request.model = Some("nonsense".into());
    assert!(matches!(choose(&request), Err(SceneError::Unknown { .. })));
}

/// Where the axis passes through the vertical the closed form gives no phi: the equations without singular states do.
#[test]
fn through_the_vertical_the_closed_form_gives_theta_only() {
    let mut request = request("top", &["theta"], 1e-10);
    set(&mut request, "omega_zeta", 0.0);
    set(&mut request, "theta_rate", 3.0);
    assert_eq!(choose(&request).unwrap().model.name, "closed");
    request.quantities = vec![request.scene.quantity("phi").unwrap()];
    let outcome = choose(&request).unwrap();
    assert!(outcome.met && outcome.model.kind == Kind::Integrated, "{}", outcome.model.name);
    let why = outcome.refused.iter().find(|r| r.model == "closed").unwrap();
    assert!(why.why.contains("vertical"), "{}", why.why);
}

/// An upright top that spins fast enough sleeps; one that is let go at rest in it stays, exactly.
#[test]
fn a_sleeping_top_sleeps() {
    for spin in [10.0, 0.5] {
        let mut request = request("top", &["theta", "u"], 1e-12);
        set(&mut request, "omega_zeta", spin);
        set(&mut request, "theta_0", 0.0);
        request.model = Some("closed".into());
        let values = choose(&request).unwrap().values.to_f64();
        assert!(values[0].iter().all(|theta| *theta == 0.0) && values[1].iter().all(|u| *u == 1.0));
    }
}

/// The error of small nutation falls with the square of the amplitude, that of the body with the mean of A and B with
/// their difference.
#[test]
fn approximations_have_their_order() {
    let error = |name: &str, model: &str, quantity: &str, parameters: &[(&str, f64)]| {
        let mut request = request(name, &[quantity], 1e-9);
        request.model = Some(model.into());
        request.times.truncate(60);
        for (name, value) in parameters {
            set(&mut request, name, *value);
        }
        choose(&request).unwrap().measured
    };
    let nutation = |rate: f64| error("top", "nutation", "theta", &[("theta_rate", rate), ("phi_rate", steady())]);
    let order = (nutation(2e-3) / nutation(1e-3)).log2();
    assert!((order - 2.0).abs() < 0.1, "{order}");
    let symmetric = |by: f64| error("free", "symmetric", "omega_1", &[("A", 2.0 - by), ("B", 2.0 + by)]);
    let order = (symmetric(2e-3) / symmetric(1e-3)).log2();
    assert!((order - 1.0).abs() < 0.1, "{order}");
}

/// The slow steady precession of the default top.
fn steady() -> f64 {
    let top = top::HeavyTop { transverse: 1.0, axial: 0.5, torque: 1.0 };
    top.steady_precession(std::f64::consts::FRAC_PI_3, 5.0).unwrap().slow
}

/// The nearer to the separatrix, the longer the body lingers: 1 - k = 1e-12 on both sides, to eleven digits.
#[test]
fn next_to_the_separatrix_no_digits_are_lost() {
    for side in [-1.0, 1.0] {
        let mut request = request("free", &["omega_1", "omega_2", "omega_3", "q_0", "q_3"], 1e-11);
        // A (B - A) omega_1^2 = C (C - B) omega_3^2 on the separatrix; k'^2 is about 2e-12.
        let on = 3f64.sqrt();
        for (name, value) in [("omega_1", on * (1.0 + side * 1e-12)), ("omega_2", 0.4), ("omega_3", 1.0)] {
            set(&mut request, name, value);
        }
        let outcome = choose(&request).unwrap();
        assert_eq!((outcome.model.name, outcome.arithmetic), ("closed", Arithmetic::Machine));
        let mut euler = request.clone();
        euler.model = Some("euler".into());
        euler.error = 1e-20;
        let reference = choose(&euler).unwrap();
        assert!(outcome.values.distance(&reference.values) < 1e-11);
    }
}
