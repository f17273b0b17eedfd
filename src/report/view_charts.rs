//! A chart as the templates are given it.

use super::charts::{Chart, LegendEntry};
use super::math::Renderer;
use serde::Serialize;

#[derive(Serialize)]
pub(super) struct View {
    id: String,
    title: String,
    caption_html: String,
    svg_html: String,
    legend: Vec<Entry>,
    head_html: Vec<String>,
    rows: Vec<Vec<String>>,
}

#[derive(Serialize)]
struct Entry {
    class: String,
    marker: Option<String>,
    label_html: String,
}

pub(super) fn view(chart: &Chart, renderer: &Renderer) -> View {
    let entry = |e: &LegendEntry| Entry {
        class: e.class.clone(),
        marker: e.marker.clone(),
        label_html: renderer.prose(&e.label),
    };
    View {
        id: chart.id.clone(),
        title: chart.title.clone(),
        caption_html: renderer.prose(&chart.caption),
        svg_html: chart.svg.clone(),
        legend: chart.legend.iter().map(entry).collect(),
        head_html: chart.table.head.iter().map(|h| renderer.prose(h)).collect(),
        rows: chart.table.rows.clone(),
    }
}
