//! The derivation map: a drawing for each section, of its equations and of those from elsewhere that they rest on, and
//! the same in a table.

use super::graph::Graph;
use super::layers::{self, Drawing, Node, Spacing};
use super::text::escape;
use super::view::{Badge, Builder, Section};
use super::view_overview::{Overview, overview};
use super::words::{Words, with};
use crate::check::verdict::{DocumentReport, Verdict};
use serde::Serialize;
use std::fmt::Write;

/// The most equations in one drawing.
const MOST: usize = 60;
/// The most signs of a label that a node shows.
const LONGEST_LABEL: usize = 12;
/// The size of a node, and of the drawing's letters, in pixels.
const HEIGHT: f64 = 28.0;
const LETTER: f64 = 8.5;
const SPACING: Spacing = Spacing { layer: 66.0, gap: 14.0, edge: 8.0 };
/// What is left free around a drawing.
const MARGIN: f64 = 6.0;

/// A document's map.
#[derive(Serialize)]
pub(super) struct Map {
    /// Of all sections, where there are several.
    overview: Option<Overview>,
    figures: Vec<Figure>,
    /// How many fail, and how many are endangered.
    summary: String,
}

#[derive(Serialize)]
struct Figure {
    anchor: String,
    title_html: String,
    lang: Option<&'static str>,
    /// Nothing where no equation of the section rests on another.
    svg_html: Option<String>,
    rows: Vec<Row>,
    /// The equations without a link, which are in no drawing.
    alone: Vec<Link>,
}

/// An equation in the table.
#[derive(Serialize)]
struct Row {
    link: Link,
    badge: Badge,
    premises: Vec<Link>,
    dependents: Vec<Link>,
    threats: Vec<Link>,
}

#[derive(Clone, Serialize)]
struct Link {
    label: String,
    href: String,
    /// Whether Kenzan found that it is a premise.
    found: bool,
}

/// Draws a document's map.
pub(super) struct Mapper<'a> {
    document: &'a DocumentReport,
    graph: Graph,
    hrefs: Vec<String>,
    builder: &'a Builder<'a>,
    w: &'static Words,
}

impl<'a> Mapper<'a> {
    /// `sections` are those of the document's page `page`.
    pub fn new(document: &'a DocumentReport, page: &str, sections: &[Section], builder: &'a Builder<'a>) -> Self {
        let anchors = sections.iter().flat_map(|s| &s.equations).map(|e| format!("{page}#{}", e.anchor));
        Mapper { document, graph: Graph::of(document), hrefs: anchors.collect(), builder, w: builder.words }
    }

    /// The map.
    pub fn map(&self, sections: &[Section]) -> Map {
        let mut figures = Vec::new();
        let mut first = 0;
        for section in sections {
            let all: Vec<usize> = (first..first + section.equations.len()).collect();
            first += section.equations.len();
            let parts = all.len().div_ceil(MOST);
            for (k, part) in all.chunks(MOST).enumerate() {
                figures.push(self.figure(section, part, (parts > 1).then_some((k + 1, parts))));
            }
        }
        let failing = self.document.equations.iter().filter(|e| e.verdict == Verdict::Fails).count();
        let endangered = self.graph.threats.iter().filter(|t| !t.is_empty()).count();
        let overview = overview(self.document, &self.graph, sections, self.w);
        Map {
            overview,
            figures,
            summary: with(self.w.map_summary, &[("failing", &failing), ("endangered", &endangered)]),
        }
    }

    fn figure(&self, section: &Section, part: &[usize], number: Option<(usize, usize)>) -> Figure {
        let linked: Vec<usize> = part.iter().copied().filter(|k| self.graph.is_linked(*k)).collect();
        let part_of = number.map(|(k, n)| with(self.w.map_part, &[("n", &k), ("m", &n)])).unwrap_or_default();
        Figure {
            anchor: match number {
                Some((k, _)) if k > 1 => format!("{}~{k}", section.anchor),
                _ => section.anchor.clone(),
            },
            title_html: format!("{}{part_of}", section.title_html),
            lang: section.lang,
            svg_html: (!linked.is_empty()).then(|| self.svg(&linked, &section.title)),
            rows: linked.iter().map(|k| self.row(*k)).collect(),
            alone: part.iter().filter(|k| !self.graph.is_linked(**k)).map(|k| self.link(*k)).collect(),
        }
    }

    fn link(&self, equation: usize) -> Link {
        let label = self.document.equations[equation].label.clone();
        Link { label, href: self.hrefs[equation].clone(), found: false }
    }

    fn row(&self, equation: usize) -> Row {
        let links = |of: &[usize]| of.iter().map(|k| self.link(*k)).collect::<Vec<_>>();
        let premises = self.graph.premises[equation].iter();
        Row {
            link: self.link(equation),
            badge: self.builder.badge(self.document.equations[equation].verdict),
            premises: premises.map(|p| Link { found: p.found, ..self.link(p.equation) }).collect(),
            dependents: links(&self.graph.dependents[equation]),
            threats: links(&self.graph.threats[equation]),
        }
    }

    /// The drawing of these equations and of what they rest on.
    fn svg(&self, own: &[usize], title: &str) -> String {
        let mut shown = own.to_vec();
        let mut edges = Vec::new();
        let mut places: std::collections::HashMap<usize, usize> =
            own.iter().enumerate().map(|(k, e)| (*e, k)).collect();
        for (k, equation) in own.iter().enumerate() {
            for premise in &self.graph.premises[*equation] {
                let from = *places.entry(premise.equation).or_insert_with(|| {
                    shown.push(premise.equation);
                    shown.len() - 1
                });
                edges.push(Edge { from, to: k, found: premise.found });
            }
        }
        let nodes: Vec<Node> = shown.iter().map(|e| Node { width: self.width(*e) }).collect();
        let ends: Vec<(usize, usize)> = edges.iter().map(|e| (e.from, e.to)).collect();
        let drawing = layers::draw(&nodes, &ends, &SPACING);
        let (width, height) = (
            drawing.width + 2.0 * MARGIN,
            drawing.layers as f64 * SPACING.layer - SPACING.layer + HEIGHT + 2.0 * MARGIN,
        );
        // From the top of the first layer's nodes, not from that of the layer.
        let top = (SPACING.layer - HEIGHT) / 2.0;
        let mut svg = format!(
            "<svg class=\"derivation\" viewBox=\"{} {} {} {}\" width=\"{}\" height=\"{}\" role=\"group\" aria-label=\"{}\">",
            short(-MARGIN),
            short(top - MARGIN),
            short(width),
            short(height),
            short(width),
            short(height),
            escape(&with(self.w.map_drawing, &[("section", &title)])),
        );
        self.draw_edges(&mut svg, &drawing, &edges, &shown);
        for (k, equation) in shown.iter().enumerate() {
            self.draw_node(&mut svg, *equation, drawing.nodes[k], nodes[k].width, k >= own.len());
        }
        svg + "</svg>"
    }

    fn draw_edges(&self, svg: &mut String, drawing: &Drawing, edges: &[Edge], shown: &[usize]) {
        svg.push_str("<g aria-hidden=\"true\">");
        for (k, way) in &drawing.edges {
            let edge = &edges[*k];
            let (from, to) = (shown[edge.from], shown[edge.to]);
            let dangerous = self.fails(from) || !self.graph.threats[from].is_empty();
            let class = match (dangerous && !self.graph.threats[to].is_empty(), edge.found) {
                (true, _) => "edge danger",
                (false, true) => "edge found",
                (false, false) => "edge",
            };
            let _ = write!(svg, "<path class=\"{class}\" d=\"{}\"/>", curve(way));
            if let Some((x, y)) = way.last().map(|(x, y)| (*x, y - HEIGHT / 2.0)) {
                let tip = format!("{} {} l-4 -7 h8 z", short(x), short(y));
                let _ = write!(svg, "<path class=\"{class} tip\" d=\"M{tip}\"/>");
            }
        }
        svg.push_str("</g>");
    }

    fn draw_node(&self, svg: &mut String, equation: usize, (x, y): (f64, f64), width: f64, foreign: bool) {
        let badge = self.builder.badge(self.document.equations[equation].verdict);
        let endangered = !self.graph.threats[equation].is_empty();
        let class = format!(
            "node {}{}{}",
            badge.class,
            if endangered { " endangered" } else { "" },
            if foreign { " foreign" } else { "" }
        );
        let warning = if endangered { " ⚠" } else { "" };
        let _ = write!(
            svg,
            "<a class=\"{class}\" href=\"{}\" aria-label=\"{}\"><rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" rx=\"5\"/><text x=\"{}\" y=\"{}\">{} {}{warning}</text></a>",
            escape(&self.hrefs[equation]),
            escape(&self.spoken(equation, badge)),
            short(x - width / 2.0),
            short(y - HEIGHT / 2.0),
            short(width),
            short(HEIGHT),
            short(x),
            short(y + 4.5),
            badge.symbol,
            escape(&self.shown_label(equation)),
        );
    }

    /// What a node says to who cannot see it.
    fn spoken(&self, equation: usize, badge: Badge) -> String {
        let labels = |of: &mut dyn Iterator<Item = usize>| {
            of.map(|k| format!("({})", self.document.equations[k].label)).collect::<Vec<_>>().join(self.w.list_comma)
        };
        let mut text = format!("({}) {}", self.document.equations[equation].label, badge.word);
        let premises = labels(&mut self.graph.premises[equation].iter().map(|p| p.equation));
        if !premises.is_empty() {
            text.push_str(&with(self.w.map_spoken_rests, &[("labels", &premises)]));
        }
        let threats = labels(&mut self.graph.threats[equation].iter().copied());
        if !threats.is_empty() {
            text.push_str(&with(self.w.map_spoken_danger, &[("labels", &threats)]));
        }
        text
    }

    fn fails(&self, equation: usize) -> bool {
        self.document.equations[equation].verdict == Verdict::Fails
    }

    fn shown_label(&self, equation: usize) -> String {
        let label = &self.document.equations[equation].label;
        let cut: String = label.chars().take(LONGEST_LABEL).collect();
        if cut.len() < label.len() { format!("({cut}…)") } else { format!("({cut})") }
    }

    fn width(&self, equation: usize) -> f64 {
        // Letters of Chinese and Japanese are twice as wide.
        let signs: usize = self.shown_label(equation).chars().map(|c| if c < '\u{1100}' { 1 } else { 2 }).sum();
        let warning = if self.graph.threats[equation].is_empty() { 0.0 } else { 2.0 };
        LETTER * (signs as f64 + 2.0 + warning) + 12.0
    }
}

struct Edge {
    from: usize,
    to: usize,
    found: bool,
}

/// A smooth way through points, from the foot of the first node to the head of the last.
fn curve(way: &[(f64, f64)]) -> String {
    let mut d = String::new();
    let end = way.len().saturating_sub(1);
    let mut before: Option<(f64, f64)> = None;
    for (k, (x, y)) in way.iter().enumerate() {
        let y = match k {
            0 => y + HEIGHT / 2.0,
            k if k == end => y - HEIGHT / 2.0,
            _ => *y,
        };
        let _ = match before {
            None => write!(d, "M{} {}", short(*x), short(y)),
            Some((px, py)) => {
                let middle = (py + y) / 2.0;
                write!(
                    d,
                    " C{} {} {} {} {} {}",
                    short(px),
                    short(middle),
                    short(*x),
                    short(middle),
                    short(*x),
                    short(y)
                )
            }
        };
        before = Some((*x, y));
    }
    d
}

/// A length with one digit after the point: the same on every machine.
pub(super) fn short(value: f64) -> String {
    let text = format!("{value:.1}");
    text.strip_suffix(".0").map_or(text.clone(), str::to_owned)
}
