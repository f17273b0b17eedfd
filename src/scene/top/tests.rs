use super::*;
use crate::integrator::Adaptive;

const TOP: HeavyTop = HeavyTop { transverse: 0.010, axial: 0.012, torque: 0.10 };
const THETA: f64 = 0.6;

/// Euler's equations (39)-(41) as printed, their left sides by differentiating the angular velocity along the motion.
#[test]
fn accelerations_satisfy_eulers_equations() {
    let state = TopState { phi: 0.3, theta: 0.8, psi: 1.1, phi_rate: 2.0, theta_rate: -1.5, psi_rate: 40.0 };
    let omega = |s: &TopState| {
        let (sin, cos) = s.theta.sin_cos();
        let (sin_psi, cos_psi) = s.psi.sin_cos();
        [
            s.phi_rate * sin * sin_psi + s.theta_rate * cos_psi,
            s.phi_rate * sin * cos_psi - s.theta_rate * sin_psi,
            s.phi_rate * cos + s.psi_rate,
        ]
    };
    let after = |dt: f64| {
        let mut y = state.to_vector();
        let mut slope = [0.0; 6];
        TOP.derivative(&0.0, &y, &mut slope);
        y.iter_mut().zip(slope).for_each(|(y, slope)| *y += slope * dt);
        TopState::from_vector(&y).unwrap()
    };
    let dt = 1e-6;
    let (before, later, [x, y, z]) = (omega(&after(-dt)), omega(&after(dt)), omega(&state));
    let rate = |i: usize| (later[i] - before[i]) / (2.0 * dt);
    let turn = TOP.torque * state.theta.sin();
    let (i0, i1) = (TOP.transverse, TOP.axial);
    let residuals = [
        i0 * rate(0) - (i0 - i1) * y * z - turn * state.psi.cos(),
        i0 * rate(1) - (i1 - i0) * z * x + turn * state.psi.sin(),
        i1 * rate(2),
    ];
    for residual in residuals {
        assert!(residual.abs() < 1e-8, "{residuals:?}");
    }
}

#[test]
fn the_constants_are_constant_and_the_angles_are_not() {
    let start = TopState { theta_rate: 0.4, ..TopState::turning(THETA, 1.0, 100.0) };
    let mut turned = 0.0f64;
    let driver = Adaptive::with_tolerance(1e-13);
    let end = driver
        .integrate(&TOP, (&0.0, &start.to_vector()), &2.0, |s| turned = turned.max((s.y1[1] - THETA).abs()))
        .unwrap();
    let end = TopState::from_vector(&end.y).unwrap();
    assert!(turned > 1e-3);
    assert!((TOP.vertical_momentum(&end) / TOP.vertical_momentum(&start) - 1.0).abs() < 1e-11);
    assert!((TOP.energy(&end) / TOP.energy(&start) - 1.0).abs() < 1e-11);
    assert!((end.spin() / start.spin() - 1.0).abs() < 1e-11);
}

#[test]
fn steady_precession_is_steady_at_both_roots() {
    for spin in [5.0, 20.0, 400.0, -60.0] {
        let roots = TOP.steady_precession(THETA, spin).unwrap();
        for rate in [roots.slow, roots.fast.unwrap()] {
            let state = TopState::turning(THETA, rate, spin);
            let scale = TOP.axial * (spin * rate).abs() / TOP.transverse;
            let [phi, theta, _] = TOP.accelerations(&state);
            assert_eq!(phi, 0.0);
            assert!(theta.abs() < 8.0 * f64::EPSILON * scale, "{theta:e} at {spin}");
        }
    }
}

/// The slow root at a spin where the textbook formula has lost every digit.
#[test]
fn slow_root_does_not_cancel() {
    let spin = 1e10;
    let exact = TOP.steady_precession(THETA, spin).unwrap().slow;
    let b = TOP.axial * spin;
    let a = TOP.transverse * THETA.cos();
    let textbook = (b - (b * b - 4.0 * a * TOP.torque).sqrt()) / (2.0 * a);
    assert!((exact / TOP.slow_approximation(spin) - 1.0).abs() < 1e-15);
    assert!((textbook / exact - 1.0).abs() > 0.1);
}

#[test]
fn too_slow_a_spin_names_the_least() {
    let error = TOP.steady_precession(THETA, 1.0).unwrap_err();
    assert!(TOP.steady_precession(THETA, error.least * 1.000001).is_ok());
    assert!(TOP.steady_precession(THETA, error.least * 0.999999).is_err());
    // Below the fixed point any spin will do, and level there is only one root.
    assert!(TOP.steady_precession(2.5, 1.0).is_ok());
    let hanging = TOP.steady_precession(2.5, 1.0).unwrap();
    assert!(hanging.slow > 0.0 && hanging.fast.unwrap() < 0.0);
}

/// The closed form against the motion itself: the time between two visits to a turning point, each located by Newton's
/// method on `theta' = 0` with one step of order 8 from the step's beginning.
#[test]
fn closed_form_nutation_agrees_with_the_integrated_motion() {
    for (theta, precession, spin) in [(0.6, 0.0, 100.0), (0.6, 3.0, 12.0), (1.9, -2.0, 30.0), (0.3, 40.0, 25.0)] {
        let start = TopState::turning(theta, precession, spin);
        let nutation = TOP.nutation(theta, precession, spin).unwrap();
        let turns = turning_points(&start, 20.5 * nutation.period());
        let measured = turns[39].0 / 20.0;
        let error = measured / nutation.period() - 1.0;
        println!("theta {theta}, spin {spin}: period {measured} s, closed form off by {error:e}");
        assert!(error.abs() < 1e-11, "{error:e}");
        assert!((turns[0].1.cos() - nutation.to).abs() < 1e-11);
        assert!((turns[1].1.cos() - nutation.from).abs() < 1e-11);
    }
}

/// The times at which `theta'` vanishes after the start, with the inclinations there.
fn turning_points(start: &TopState, until: f64) -> Vec<(f64, f64)> {
    let mut found = Vec::new();
    let locate = |mut s: crate::integrator::Step<'_, '_, f64, HeavyTop>| {
        if *s.t0 == 0.0 || s.y0[4] * s.y1[4] > 0.0 {
            return;
        }
        let mut h = (s.t1 - s.t0) * s.y0[4] / (s.y0[4] - s.y1[4]);
        let mut y = [0.0; 6];
        for _ in 0..8 {
            s.at(&h, &mut y);
            h -= y[4] / TOP.accelerations(&TopState::from_vector(&y).unwrap())[1];
        }
        found.push((s.t0 + h, y[1]));
    };
    Adaptive::with_tolerance(1e-13).integrate(&TOP, (&0.0, &start.to_vector()), &until, locate).unwrap();
    found
}

/// As the amplitude falls the frequency tends to the linear one, quadratically in the amplitude.
#[test]
fn small_nutations_have_the_linear_frequency() {
    for spin in [6.0, 50.0] {
        let roots = TOP.steady_precession(THETA, spin).unwrap();
        for steady in [roots.slow, roots.fast.unwrap()] {
            let linear = TOP.linear_nutation_frequency(THETA, steady, spin);
            let at_rest = TOP.nutation(THETA, steady, spin).unwrap();
            assert!((at_rest.frequency / linear - 1.0).abs() < 1e-14);
            assert!((at_rest.to - at_rest.from).abs() < 1e-14);
            // Symmetric about the steady rate, the first order in the amplitude drops out of the mean.
            let mean = |e: f64| {
                let at = |f: f64| TOP.nutation(THETA, steady * f, spin).unwrap().frequency;
                ((at(1.0 + e) + at(1.0 - e)) / 2.0 / linear - 1.0).abs()
            };
            let order = (mean(2e-2) / mean(1e-2)).log2();
            assert!((order - 2.0).abs() < 0.1, "{order}");
        }
    }
}

/// Without gravity the axis nutates about the fixed angular momentum: `omega` is its length over `I_0`.
#[test]
fn a_free_top_nutates_at_its_momentum_over_the_transverse_moment() {
    let free = HeavyTop { torque: 0.0, ..TOP };
    let (theta, p, spin) = (0.7f64, 5.0, 30.0);
    let momentum = (free.axial * spin).hypot(free.transverse * p * theta.sin());
    let frequency = free.nutation(theta, p, spin).unwrap().frequency;
    assert!((frequency * free.transverse / momentum - 1.0).abs() < 1e-15);
}

/// A top that neither spins nor precesses, let go level, is a pendulum: it is lowest twice a period, and the period is
/// `4 K(k) sqrt(I_0 / m g l)` with `K(1/sqrt 2) = 1.8540746773013719` (DLMF 19.6, Gauss's lemniscate constant).
#[test]
fn a_top_without_spin_is_a_pendulum() {
    let pendulum = TOP.nutation(std::f64::consts::FRAC_PI_2, 0.0, 0.0).unwrap();
    let period = 4.0 * 1.8540746773013719 * (TOP.transverse / TOP.torque).sqrt();
    assert!((2.0 * pendulum.period() / period - 1.0).abs() < 1e-14);
    assert!((pendulum.to + 1.0).abs() < 1e-14);
}

#[test]
fn an_upright_axis_has_no_nutation() {
    assert_eq!(TOP.nutation(0.0, 1.0, 10.0), None);
}
