//! Certificates for the templates.

use super::math::Renderer;
use super::words::{Words, count, with};
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

pub(super) fn view(c: &Certificate, renderer: &Renderer, words: &Words) -> View {
    let chosen = c.state.iter().filter(|v| !v.idle);
    let chosen = chosen
        .map(|v| Symbol { symbol_html: renderer.inline(&v.symbol), place: with(words.equals, &[("value", &v.value)]) });
    let solved = c
        .solved
        .iter()
        .filter(|e| !e.idle)
        .filter_map(|e| Some(Symbol { symbol_html: renderer.inline(e.name.as_ref()?), place: place(e, words) }));
    View {
        state: chosen.chain(solved).collect(),
        differences: c.differences.iter().map(|e| place(e, words)).collect(),
        means: c.bits.map_or_else(|| words.in_fractions.to_owned(), |bits| count(words.with_bits, bits as usize)),
    }
}

/// `lies in [0.33, 0.34]`, or `is 2` where that is exact.
fn place(e: &Enclosure, words: &Words) -> String {
    if e.low == e.high {
        with(words.is, &[("value", &e.low)])
    } else {
        with(words.lies_in, &[("low", &e.low), ("high", &e.high)])
    }
}
