//! Certificates for the templates.

use super::math::Renderer;
use crate::check::verdict::{Certificate, Enclosure};
use serde::Serialize;

#[derive(Clone, Serialize)]
pub(super) struct View {
    /// The symbols that play a part.
    state: Vec<Symbol>,
    differences: Vec<String>,
    means: String,
}

#[derive(Clone, Serialize)]
struct Symbol {
    symbol_html: String,
    /// `= 1/2`, `lies in [0.33, 0.34]`
    place: String,
}

pub(super) fn view(c: &Certificate, renderer: &Renderer) -> View {
    let chosen = c.state.iter().filter(|v| !v.idle);
    let chosen = chosen.map(|v| Symbol { symbol_html: renderer.inline(&v.symbol), place: format!("= {}", v.value) });
    let solved = c
        .solved
        .iter()
        .filter(|e| !e.idle)
        .filter_map(|e| Some(Symbol { symbol_html: renderer.inline(e.name.as_ref()?), place: e.place() }));
    View {
        state: chosen.chain(solved).collect(),
        differences: c.differences.iter().map(Enclosure::place).collect(),
        means: c.means(),
    }
}
