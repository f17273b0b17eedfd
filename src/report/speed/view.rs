//! What the page's template is given.

use serde::Serialize;

use super::super::math::Renderer;
use super::super::text::number;
use super::super::view_charts;
use super::{Language, Measured, Speed, chart};
use crate::scene::speed::Pick;

#[derive(Serialize)]
pub(super) struct Page {
    version: &'static str,
    scenes: Vec<Section>,
    drifts: Vec<view_charts::View>,
}

#[derive(Serialize)]
struct Section {
    name: &'static str,
    about: String,
    quantities: String,
    parameters: Vec<Setting>,
    models: Vec<Model>,
    chart: Option<view_charts::View>,
    trouble: Option<String>,
    picks: Vec<Row>,
}

#[derive(Serialize)]
struct Setting {
    name: &'static str,
    value: String,
    unit: &'static str,
    about: &'static str,
}

#[derive(Serialize)]
struct Model {
    name: &'static str,
    what: String,
    source: &'static str,
}

#[derive(Serialize)]
struct Row {
    asked: String,
    model: String,
    numbers: String,
    error: String,
    time: String,
    with_choice: String,
}

pub(super) fn page(speed: &Speed, language: Language) -> Page {
    let renderer = Renderer::new();
    let scenes = speed.scenes.iter().map(|m| section(m, &renderer, language)).collect();
    let drifts = chart::drifts(&speed.drifts, language).into_iter().filter_map(Result::ok);
    let drifts = drifts.map(|c| view_charts::view(&c, &renderer)).collect();
    Page { version: env!("CARGO_PKG_VERSION"), scenes, drifts }
}

fn section(measured: &Measured, renderer: &Renderer, language: Language) -> Section {
    let scene = measured.scene();
    let chart = chart::chart(measured, language);
    let values = scene.parameters.iter().zip(&measured.sweep.parameters);
    let names = measured.sweep.quantities.iter().filter_map(|q| scene.quantities.get(*q)).map(|q| q.name);
    Section {
        name: scene.name,
        about: language.say(scene.about).into_owned(),
        quantities: names.collect::<Vec<_>>().join(", "),
        parameters: values
            .map(|(p, v)| Setting { name: p.name, value: short(*v), unit: p.unit, about: p.about })
            .collect(),
        models: scene
            .models
            .iter()
            .map(|m| m.about())
            .map(|a| Model { name: a.name, what: language.say(a.what).into_owned(), source: a.source })
            .collect(),
        trouble: chart.as_ref().err().map(ToString::to_string),
        chart: chart.ok().map(|c| view_charts::view(&c, renderer)),
        picks: measured.picks.iter().map(|p| row(p, language)).collect(),
    }
}

/// A number without the zeros at its end.
fn short(value: f64) -> String {
    let text = number(value, 6);
    match text.contains('.') && !text.contains(['e', '⁰']) {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}

fn row(pick: &Pick, language: Language) -> Row {
    let (asked, with_choice) = (format!("{:.0e}", pick.asked), number(pick.seconds * 1e3, 3));
    match &pick.taken {
        Ok(taken) => Row {
            asked,
            model: taken.model.name.to_owned(),
            numbers: language.say(&taken.arithmetic.name()).into_owned(),
            error: format!("{:.1e}", taken.error),
            time: number(taken.seconds * 1e3, 3),
            with_choice,
        },
        Err(why) => Row {
            asked,
            model: language.say(why).into_owned(),
            numbers: String::new(),
            error: String::new(),
            time: String::new(),
            with_choice,
        },
    }
}
