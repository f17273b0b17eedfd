//! The overview at the head of the derivation map: a row for each section in the order of the document, with how many of
//! its equations fail or are endangered, and arcs from sections to those that rest on them.

use super::graph::Graph;
use super::text::{columns_of, escape};
use super::view::Section;
use super::view_map::short;
use super::words::{Words, count, with};
use crate::check::verdict::{DocumentReport, Verdict};
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt::Write;

/// The height of a row, in pixels.
const ROW: f64 = 30.0;
/// How far the arc between neighbours reaches out, and what the square root of the distance in rows adds to it.
const REACH: (f64, f64) = (8.0, 34.0);
/// What is left free beside the arcs, for their numbers.
const MARGIN: f64 = 30.0;
/// Where the columns of a row stand, from the line at which the arcs end: equations, failing, endangered, title.
const COLUMNS: [f64; 4] = [46.0, 96.0, 146.0, 170.0];
/// The width of a title's letter, in pixels, and the most columns of letters that are shown.
const LETTER: f64 = 8.5;
const MOST_COLUMNS: usize = 64;

/// The overview of a document.
#[derive(Serialize)]
pub(super) struct Overview {
    svg_html: String,
    rows: Vec<Row>,
}

/// A section in the table.
#[derive(Serialize)]
struct Row {
    title_html: String,
    lang: Option<&'static str>,
    href: String,
    equations: usize,
    failing: usize,
    endangered: usize,
    rests_on: Vec<Link>,
    used_by: Vec<Link>,
}

/// Another section, with the number of equations.
#[derive(Serialize)]
struct Link {
    title_html: String,
    lang: Option<&'static str>,
    href: String,
    equations: usize,
}

/// How many equations of one section rest on another.
#[derive(Clone, Copy, Default)]
struct Arc {
    equations: usize,
    /// Whether some of them are endangered by what they rest on there.
    danger: bool,
    /// Whether all of these premises were found by Kenzan.
    found: bool,
}

struct Drawn<'a> {
    sections: &'a [Section],
    /// For each section: its equations, and how many of them fail and are endangered.
    counts: Vec<[usize; 3]>,
    /// By the sections from which and to which they lead.
    arcs: BTreeMap<(usize, usize), Arc>,
    w: &'static Words,
}

/// The overview of a document with several sections; `sections` are those of its page.
pub(super) fn overview(
    document: &DocumentReport,
    graph: &Graph,
    sections: &[Section],
    w: &'static Words,
) -> Option<Overview> {
    if sections.len() < 2 {
        return None;
    }
    let of: Vec<usize> =
        sections.iter().enumerate().flat_map(|(k, s)| std::iter::repeat_n(k, s.equations.len())).collect();
    let fails: Vec<bool> = document.equations.iter().map(|e| e.verdict == Verdict::Fails).collect();
    let mut counts = vec![[0; 3]; sections.len()];
    for (equation, section) in of.iter().enumerate() {
        let is = [true, fails[equation], !graph.threats[equation].is_empty()];
        counts[*section].iter_mut().zip(is).for_each(|(count, is)| *count += usize::from(is));
    }
    let drawn = Drawn { sections, counts, arcs: arcs(graph, &of, &fails), w };
    Some(Overview { svg_html: drawn.svg(), rows: (0..sections.len()).map(|k| drawn.row(k)).collect() })
}

/// How many equations of each section rest on which others; `of` tells the section of each equation.
fn arcs(graph: &Graph, of: &[usize], fails: &[bool]) -> BTreeMap<(usize, usize), Arc> {
    let mut arcs: BTreeMap<(usize, usize), Arc> = BTreeMap::new();
    for (equation, to) in of.iter().enumerate() {
        // An equation counts once for each section, however many premises it has there.
        let mut own: BTreeMap<usize, Arc> = BTreeMap::new();
        for premise in &graph.premises[equation] {
            let spreads = fails[premise.equation] || !graph.threats[premise.equation].is_empty();
            let arc = own.entry(of[premise.equation]).or_insert(Arc { equations: 1, danger: false, found: true });
            arc.danger |= spreads && !graph.threats[equation].is_empty();
            arc.found &= premise.found;
        }
        for (from, one) in own.into_iter().filter(|(from, _)| from != to) {
            let arc = arcs.entry((from, *to)).or_insert(Arc { found: true, ..Arc::default() });
            arc.equations += 1;
            arc.danger |= one.danger;
            arc.found &= one.found;
        }
    }
    arcs
}

impl Drawn<'_> {
    fn row(&self, section: usize) -> Row {
        let link = |other: usize, arc: &Arc| {
            let Section { title_html, lang, anchor, .. } = &self.sections[other];
            let href = format!("#{anchor}");
            Link { title_html: title_html.clone(), lang: *lang, href, equations: arc.equations }
        };
        let Section { title_html, lang, anchor, .. } = &self.sections[section];
        let [equations, failing, endangered] = self.counts[section];
        let arcs = || self.arcs.iter();
        Row {
            title_html: title_html.clone(),
            lang: *lang,
            href: format!("#{anchor}"),
            equations,
            failing,
            endangered,
            rests_on: arcs().filter(|((_, to), _)| *to == section).map(|((from, _), a)| link(*from, a)).collect(),
            used_by: arcs().filter(|((from, _), _)| *from == section).map(|((_, to), a)| link(*to, a)).collect(),
        }
    }

    fn svg(&self) -> String {
        let left = self.arcs.keys().map(|ends| reach(*ends)).fold(0.0, f64::max) + MARGIN;
        let columns = self.sections.iter().map(|s| title(&s.title).1).max().unwrap_or(0);
        let width = left + COLUMNS[3] + columns as f64 * LETTER + MARGIN;
        let height = self.sections.len() as f64 * ROW;
        let mut svg = format!(
            "<svg class=\"derivation whole\" viewBox=\"{} 0 {} {}\" width=\"{}\" height=\"{}\" role=\"group\" aria-label=\"{}\">",
            short(-left),
            short(width),
            short(height),
            short(width),
            short(height),
            escape(self.w.map_whole_drawing),
        );
        svg.push_str("<g aria-hidden=\"true\">");
        self.arcs.iter().for_each(|(ends, arc)| draw_arc(&mut svg, *ends, arc));
        svg.push_str("</g>");
        (0..self.sections.len()).for_each(|k| self.draw_row(&mut svg, k, width - left));
        svg + "</svg>"
    }

    fn draw_row(&self, svg: &mut String, k: usize, width: f64) {
        let Section { title: name, anchor, lang, .. } = &self.sections[k];
        let [equations, failing, endangered] = self.counts[k];
        let lang = lang.map_or_else(String::new, |lang| format!(" lang=\"{lang}\""));
        let class = match (failing, endangered) {
            (0, 0) => "row",
            (0, _) => "row endangered",
            _ => "row fails",
        };
        let (y, base) = (k as f64 * ROW, (k as f64 + 0.5) * ROW + 4.5);
        // The numbers stand behind the link: it is named by the title, and says the numbers in words.
        svg.push_str("<g aria-hidden=\"true\">");
        let mut column = |class: &str, x: f64, text: String| {
            // Writing to a string cannot fail.
            let _ = write!(svg, "<text class=\"{class}\" x=\"{}\" y=\"{}\">{text}</text>", short(x), short(base));
        };
        column("number", COLUMNS[0], equations.to_string());
        if failing > 0 {
            column("number failing", COLUMNS[1], format!("✗ {failing}"));
        }
        if endangered > 0 {
            column("number threatened", COLUMNS[2], format!("⚠ {endangered}"));
        }
        let _ = write!(
            svg,
            "</g><a class=\"{class}\" href=\"#{anchor}\" aria-label=\"{}\"><rect x=\"4\" y=\"{}\" width=\"{}\" height=\"{}\" rx=\"5\"/><circle cx=\"0\" cy=\"{}\" r=\"5\"/>",
            escape(&self.spoken(k)),
            short(y + 2.0),
            short(width - 8.0),
            short(ROW - 4.0),
            short(y + ROW / 2.0),
        );
        let _ = write!(
            svg,
            "<text class=\"title\"{lang} x=\"{}\" y=\"{}\">{}</text></a>",
            short(COLUMNS[3]),
            short(base),
            escape(&title(name).0)
        );
    }

    /// What a row says to who cannot see it.
    fn spoken(&self, k: usize) -> String {
        let [equations, failing, endangered] = self.counts[k];
        let mut text = with(
            self.w.map_spoken_section,
            &[
                ("section", &title(&self.sections[k].title).0),
                ("equations", &count(self.w.lead_equations, equations)),
                ("failing", &failing),
                ("endangered", &endangered),
            ],
        );
        let below: Vec<&str> =
            self.arcs.keys().filter(|(_, to)| *to == k).map(|(from, _)| self.sections[*from].title.as_str()).collect();
        if !below.is_empty() {
            text.push_str(&with(self.w.map_spoken_rests, &[("labels", &below.join(self.w.list_comma))]));
        }
        text
    }
}

/// How far an arc reaches out; no two of one middle reach as far.
fn reach((from, to): (usize, usize)) -> f64 {
    // Premises that stand after what rests on them lie a little farther out.
    let back = if from > to { 5.0 } else { 0.0 };
    REACH.0 + REACH.1 * (from.abs_diff(to) as f64).sqrt() + back
}

/// An arc at the left of the rows, with its tip and, where it is more than one, the number of equations.
fn draw_arc(svg: &mut String, (from, to): (usize, usize), arc: &Arc) {
    let middle = |row: usize| (row as f64 + 0.5) * ROW;
    let (begin, end, out) = (middle(from), middle(to), reach((from, to)));
    let weight = match arc.equations {
        1 => "",
        2..=3 => " several",
        4..=7 => " many",
        _ => " most",
    };
    let class = match arc {
        Arc { danger: true, .. } => "edge danger",
        Arc { found: true, .. } => "edge found",
        _ => "edge",
    };
    let sweep = u8::from(from > to);
    let height = (end - begin).abs() / 2.0;
    let _ = write!(
        svg,
        "<path class=\"{class}{weight}\" d=\"M-6 {} A{} {} 0 0 {sweep} -9 {}\"/><path class=\"{class} tip\" d=\"M-6 {} l-8 -4 v8 z\"/>",
        short(begin),
        short(out),
        short(height),
        short(end),
        short(end),
    );
    if arc.equations > 1 {
        let _ = write!(
            svg,
            "<text class=\"weight\" x=\"{}\" y=\"{}\">{}</text>",
            short(-6.0 - out),
            short((begin + end) / 2.0 + 4.0),
            arc.equations
        );
    }
}

/// A title as far as it is shown, without its marks of mathematics, and its columns.
fn title(text: &str) -> (String, usize) {
    let (mut shown, mut columns) = (String::new(), 0);
    for letter in text.chars().filter(|c| *c != '$') {
        columns += columns_of(letter);
        if columns > MOST_COLUMNS {
            return (shown + "…", MOST_COLUMNS + 1);
        }
        shown.push(letter);
    }
    (shown, columns)
}

#[cfg(test)]
mod tests {
    use super::super::fixture::{empty, judgement, link};
    use super::super::words::Language;
    use super::super::{Options, Run, fixture, html};
    use super::*;
    use crate::check::verdict::Judgement;

    /// The map's page of a document of equations: section, label, premises, verdict.
    fn page(equations: &[(&str, &str, &[&str], Verdict)], language: Language) -> String {
        let equation = |(section, label, given, verdict): &(&str, &str, &[&str], Verdict)| Judgement {
            section: (*section).to_owned(),
            given: given.iter().map(|g| (*g).to_owned()).collect(),
            ..judgement(label, "derived", link("a = b", *verdict))
        };
        let document = DocumentReport { equations: equations.iter().map(equation).collect(), ..empty() };
        let run = Run { documents: vec![document], charts: None, ..fixture::run() };
        let pages = html::pages(&run, Options { language, ..Options::default() }).unwrap();
        pages.into_iter().find(|p| p.file.ends_with("-map.html")).unwrap().html
    }

    fn whole(html: &str) -> &str {
        let begin = html.find("<svg class=\"derivation whole\"").unwrap();
        &html[begin..begin + html[begin..].find("</svg>").unwrap()]
    }

    #[test]
    fn sections_rest_on_sections() {
        use Verdict::{Fails, Holds};
        let html = page(
            &[
                ("A", "1", &[], Fails),
                ("A", "2", &["1"], Holds),
                ("B & <b>", "3", &["1", "2"], Holds),
                ("B & <b>", "4", &["1"], Holds),
                ("C", "5", &["6"], Holds),
                ("D", "6", &[], Holds),
            ],
            Language::English,
        );
        let svg = whole(&html);
        // A to B twice, D back to C once; within A none.
        assert_eq!(svg.matches(" tip\"").count(), 2);
        assert_eq!(svg.matches("<text class=\"weight\"").count(), 1);
        assert!(svg.contains("class=\"edge danger several\"") && svg.contains(">2</text>"), "{svg}");
        assert_eq!(svg.matches("class=\"row fails\"").count(), 1);
        assert_eq!(svg.matches("class=\"row endangered\"").count(), 1);
        assert!(svg.contains("B &amp; &lt;b&gt;") && !svg.contains("<b>"), "{svg}");
        assert!(svg.contains("B &amp; &lt;b&gt;: 2 equations, 0 fail, 2 endangered; rests on A"), "{svg}");
        // Each row leads to the section's own map.
        for target in svg.split("href=\"#").skip(1).map(|rest| &rest[..rest.find('"').unwrap()]) {
            assert!(html.contains(&format!("id=\"{target}\"")), "{target}");
        }
    }

    #[test]
    fn one_section_needs_no_overview() {
        let html = page(&[("A", "1", &[], Verdict::Holds)], Language::English);
        assert!(!html.contains("derivation whole"));
    }

    #[test]
    fn long_titles_are_cut() {
        assert_eq!(title("a $x$"), ("a x".to_owned(), 3));
        let (shown, columns) = title(&"節".repeat(100));
        assert_eq!((shown.chars().count(), columns), (33, 65));
    }
}
