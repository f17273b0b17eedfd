//! The page and its data on a small measurement.

use super::*;
use crate::scene::drift::drifts;

fn small() -> Speed {
    let scene = crate::scene::scene("top").unwrap();
    let times = vec![0.5, 1.0, 2.0];
    let (quantities, tolerances) = (vec![0], vec![1e-3, 1e-9]);
    let sweep = Sweep { scene, parameters: scene.defaults(), quantities, times, tolerances };
    let (runs, picks) = (sweep.run().unwrap(), sweep.picks(&[1e-6, 0.0]));
    Speed { scenes: vec![Measured { sweep, runs, picks }], drifts: drifts(100.0, 1).unwrap() }
}

#[test]
fn the_page_shows_each_model_and_its_data_the_numbers() {
    let speed = small();
    let page = html(&speed, Language::English).unwrap();
    for model in crate::scene::scene("top").unwrap().models {
        assert!(page.contains(&format!("<code>{}</code>", model.about().name)), "{}", model.about().name);
    }
    // A chart for the scene, and one for each of two constants of two motions.
    assert_eq!(page.matches("<figure").count(), 5);
    assert!(!page.contains("NaN") && !page.contains("<script"));
    let data: serde_json::Value = serde_json::from_str(&json(&speed).unwrap()).unwrap();
    let runs = data["scenes"][0]["runs"].as_array().unwrap();
    assert_eq!(runs.len(), speed.scenes[0].runs.len());
    assert!(runs.iter().all(|run| run["seconds"].as_f64().unwrap() > 0.0));
    let best = runs.iter().filter_map(|run| run["error"].as_f64()).fold(1.0, f64::min);
    assert!(best < 1e-12, "{best:e}");
    assert!(runs.iter().any(|run| run["on_front"] == true) && runs.iter().any(|run| run["on_front"] == false));
    assert_eq!(data["drifts"].as_array().unwrap().len(), speed.drifts.len());
}

#[test]
fn what_cannot_be_met_is_said_in_words() {
    let speed = small();
    let data: serde_json::Value = serde_json::from_str(&json(&speed).unwrap()).unwrap();
    let picks = &data["scenes"][0]["picks"];
    assert!(picks[0]["error"].as_f64().unwrap() <= 1e-6 && picks[0]["why_not"].is_null());
    let why = picks[1]["why_not"].as_str().unwrap_or_default();
    assert!(picks[1]["model"].is_null() && why.contains("cannot be met"), "{picks}");
    assert!(table(&speed.scenes[0], Language::English).contains("cannot be met"));
}
