//! What accuracy costs: the scenes' models, measured at every tolerance.

use crate::report::speed::{Measured, Speed};
use crate::scene::drift::drifts;
use crate::scene::speed::Sweep;
use crate::scene::{SCENES, Scene, SceneError};

/// How many values of each quantity are computed.
const VALUES: usize = 64;
/// The tolerances that integrators are given.
const TOLERANCES: [f64; 5] = [1e-3, 1e-6, 1e-9, 1e-12, 1e-15];
/// Those for more than machine numbers can do.
const TIGHT: [f64; 3] = [1e-22, 1e-30, 1e-60];
/// The errors for which the scene is asked what it takes.
const ASKED: [f64; 5] = [1e-2, 1e-4, 1e-6, 1e-9, 1e-12];

/// The span, in the scene's unit of time, over which a scene's motion is followed, and the quantities: what its users would ask for.
fn span(scene: &Scene) -> (f64, &'static [&'static str]) {
    match scene.name {
        "top" => (1000.0, &["theta"]),
        "free" => (1000.0, &["omega_1", "q_0"]),
        _ => (100.0, &[]),
    }
}

/// What is measured of a scene.
pub fn sweep(scene: &'static Scene) -> Sweep {
    let (until, names) = span(scene);
    let named: Vec<usize> = names.iter().filter_map(|n| scene.quantity(n).ok()).collect();
    let quantities = if named.is_empty() { vec![0] } else { named };
    let times = (1..=VALUES).map(|i| until * i as f64 / VALUES as f64).collect();
    let tolerances = TOLERANCES.into_iter().chain(TIGHT).collect();
    Sweep { scene, parameters: scene.defaults(), quantities, times, tolerances }
}

/// The members of the ensembles that are followed over many periods.
const MEMBERS: usize = 4;

/// Measures scenes; all of them where none is named, and then also how constants are kept over so many periods. Scenes are
/// measured one after another: side by side they would disturb each other.
///
/// # Errors
/// [`SceneError::Unknown`]: a scene that does not exist.
pub fn speed(names: &[String], periods: u32) -> Result<Speed, SceneError> {
    let named: Result<Vec<&'static Scene>, SceneError> = names.iter().map(|n| crate::scene::scene(n)).collect();
    let scenes = if names.is_empty() { SCENES.to_vec() } else { named? };
    let measure = |scene: &'static Scene| {
        let sweep = sweep(scene);
        let (runs, picks) = (sweep.run()?, sweep.picks(&ASKED));
        Ok(Measured { sweep, runs, picks })
    };
    let scenes: Result<Vec<Measured>, SceneError> = scenes.into_iter().map(measure).collect();
    let drifts = if names.is_empty() && periods > 0 { drifts(periods.into(), MEMBERS)? } else { Vec::new() };
    Ok(Speed { scenes: scenes?, drifts })
}
