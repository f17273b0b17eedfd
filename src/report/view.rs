//! What the templates are given: everything rendered and formatted, nothing left to decide.
//!
//! Fields that hold HTML end in `_html` and are the only ones that templates may mark as safe; everything else is
//! escaped by the template engine.

use super::math::{self, Renderer};
use super::text::{duration, language, number, strength, symbol, word};
use super::{Counts, Options, Run, text, view_certificate, view_charts, view_diagnosis, view_dimensions};
use crate::check::verdict::{Correction, Counterexample, DocumentReport, Judgement, LinkJudgement, Order, Verdict};
use crate::latex::diff::mark_by;
use serde::Serialize;
use std::collections::HashMap;

#[derive(Serialize)]
pub(super) struct Page {
    version: &'static str,
    seed: u64,
    states: usize,
    precision: Option<u32>,
    time: Option<String>,
    counts: Counts,
    errata: Vec<Equation>,
    attention: Vec<Equation>,
    /// Those whose checks let a mutant pass.
    insensitive: Vec<Equation>,
    documents: Vec<Document>,
    charts: Vec<view_charts::View>,
}

#[derive(Serialize)]
struct Document {
    anchor: String,
    name: String,
    path: String,
    title_html: String,
    lang: Option<&'static str>,
    problems_html: Vec<String>,
    dimensions: Option<view_dimensions::Summary>,
    counts: Counts,
    shares: Vec<Share>,
    sections: Vec<Section>,
}

/// A verdict's share of a document: a segment of its bar.
#[derive(Serialize)]
struct Share {
    badge: Badge,
    count: usize,
}

#[derive(Serialize)]
struct Section {
    anchor: String,
    title_html: String,
    lang: Option<&'static str>,
    equations: Vec<Equation>,
}

#[derive(Clone, Copy, Serialize)]
struct Badge {
    word: &'static str,
    symbol: &'static str,
}

#[derive(Clone, Serialize)]
struct Equation {
    anchor: String,
    document: String,
    label: String,
    numbered: bool,
    line: usize,
    badge: Badge,
    erratum: bool,
    kind: String,
    facts: Vec<String>,
    time: Option<String>,
    math_html: String,
    printed_html: String,
    latex: String,
    as_printed: bool,
    reading: Option<String>,
    reading_html: Option<String>,
    given: Vec<Premise>,
    assumptions_html: Vec<String>,
    because_html: Option<String>,
    reason_html: Option<String>,
    /// The reason in a list of equations: that of the link that decides, where the equation has none of its own.
    why_html: Option<String>,
    links: Vec<LinkView>,
    dimensions: view_dimensions::View,
    counterexample: Option<CounterexampleView>,
    order: Option<OrderView>,
    correction: Option<CorrectionView>,
    expected: Option<&'static str>,
    as_expected: bool,
    diagnosis: view_diagnosis::Diagnosis,
}

#[derive(Clone, Serialize)]
struct Premise {
    label: String,
    href: Option<String>,
}

#[derive(Clone, Serialize)]
struct LinkView {
    badge: Badge,
    math_html: String,
    facts: Vec<String>,
    reason_html: Option<String>,
    counterexample: Option<CounterexampleView>,
    order: Option<OrderView>,
}

#[derive(Clone, Serialize)]
struct CounterexampleView {
    component_html: Option<String>,
    state: Vec<Value>,
    lhs: String,
    rhs: String,
    certificate: Option<view_certificate::View>,
    uncertified: Option<String>,
}

#[derive(Clone, Serialize)]
struct Value {
    symbol_html: String,
    value: String,
}

#[derive(Clone, Serialize)]
struct OrderView {
    small_html: String,
    claimed: String,
    measured: String,
    residuals: Vec<Residual>,
}

#[derive(Clone, Serialize)]
struct Residual {
    small: String,
    residual: String,
    /// The order between this row and the one before.
    slope: Option<String>,
}

#[derive(Clone, Serialize)]
struct CorrectionView {
    badge: Badge,
    math_html: String,
    latex: String,
    links: Vec<LinkView>,
}

/// The page of a run.
pub(super) fn page(run: &Run, options: Options) -> Page {
    let mut builder = Builder { renderer: Renderer::new(), options, taken: HashMap::new() };
    let documents: Vec<_> = run.documents.iter().map(|d| builder.document(d)).collect();
    let all = || documents.iter().flat_map(|d| &d.sections).flat_map(|s| &s.equations);
    let judged = || run.documents.iter().flat_map(|d| &d.equations);
    let attention = |e: &&Equation| {
        let open = matches!(e.badge.word, "fails" | "undecided" | "unreadable");
        !e.erratum && (open || !e.as_expected)
    };
    Page {
        version: env!("CARGO_PKG_VERSION"),
        seed: run.seed,
        states: run.states,
        precision: run.precision,
        time: options.times.then(|| duration(run.micros)),
        counts: Counts::of(judged()),
        errata: all().filter(|e| e.erratum).cloned().collect(),
        attention: all().filter(attention).cloned().collect(),
        insensitive: all().filter(|e| !e.diagnosis.survivors_html.is_empty()).cloned().collect(),
        charts: run.charts.iter().map(|c| view_charts::view(c, &builder.renderer)).collect(),
        documents,
    }
}

struct Builder {
    renderer: Renderer,
    options: Options,
    /// The anchors in use, each with the number of those made from it.
    taken: HashMap<String, usize>,
}

impl Builder {
    fn document(&mut self, document: &DocumentReport) -> Document {
        let anchor = self.anchor(&document.name);
        let anchors: Vec<_> =
            document.equations.iter().map(|e| self.anchor(&format!("{}-{}", document.name, e.label))).collect();
        let mut sections: Vec<Section> = Vec::new();
        let mut labels = HashMap::new();
        for (judgement, anchor) in document.equations.iter().zip(&anchors) {
            labels.entry(judgement.label.as_str()).or_insert(anchor.as_str());
        }
        let mut before = None;
        for (judgement, anchor) in document.equations.iter().zip(&anchors) {
            if before != Some(&judgement.section) {
                let section = format!("{}-section-{}", document.name, sections.len() + 1);
                sections.push(self.section(&judgement.section, &section));
                before = Some(&judgement.section);
            }
            // Of several equations with one label, a premise means the last one before it, or else the first.
            let equation = self.equation(judgement, &document.name, anchor, &labels);
            labels.insert(&judgement.label, anchor);
            if let Some(section) = sections.last_mut() {
                section.equations.push(equation);
            }
        }
        let counts = Counts::of(&document.equations);
        let shares = super::counts::ORDER.map(|v| Share { badge: badge(v), count: counts.with(v) });
        Document {
            anchor,
            name: document.name.clone(),
            path: document.path.clone(),
            title_html: self.renderer.prose(&document.title),
            lang: language(&document.title),
            problems_html: document.problems.iter().map(|p| self.renderer.prose(p)).collect(),
            dimensions: view_dimensions::summary(document, &self.renderer),
            counts,
            shares: shares.into_iter().filter(|s| s.count > 0).collect(),
            sections,
        }
    }

    fn section(&mut self, title: &str, anchor: &str) -> Section {
        let shown = if title.is_empty() { "(before the first heading)" } else { title };
        Section {
            anchor: self.anchor(anchor),
            title_html: self.renderer.prose(shown),
            lang: language(title),
            equations: Vec::new(),
        }
    }

    fn equation(&self, j: &Judgement, document: &str, anchor: &str, labels: &HashMap<&str, &str>) -> Equation {
        let math_html = self.renderer.display(&j.latex);
        let (printed_html, correction) = self.correction(j, &math_html);
        let premise = |label: &String| Premise {
            label: label.clone(),
            href: labels.get(label.as_str()).map(|anchor| format!("#{anchor}")),
        };
        // A single link repeats the equation: what it knows more is shown with the equation itself.
        let only = if let [link] = j.links.as_slice() { Some(link) } else { None };
        let mut facts = facts(j.strength, j.bits, only.and_then(|l| l.residual), j.states);
        facts.extend(only.and_then(failing_states));
        facts.extend(exactness(j));
        facts.extend(j.lost_bits.map(text::lost_bits));
        facts.extend(Judgement::only_restates(&j.links).then(|| text::RESTATED.to_owned()));
        let reason = j.reason.as_ref().or_else(|| only.and_then(|l| l.reason.as_ref()));
        Equation {
            anchor: anchor.to_owned(),
            document: document.to_owned(),
            label: j.label.clone(),
            numbered: j.numbered,
            line: j.line,
            badge: badge(j.verdict),
            erratum: j.is_erratum(),
            kind: j.kind.clone(),
            facts,
            time: self.options.times.then(|| duration(j.micros)),
            math_html,
            printed_html,
            latex: j.latex.clone(),
            as_printed: j.as_printed,
            reading: j.reading.clone(),
            reading_html: j.reading.as_ref().map(|r| self.renderer.display(r)),
            given: j.given.iter().map(premise).collect(),
            assumptions_html: j.assumptions.iter().map(|a| self.renderer.inline(a)).collect(),
            because_html: j.because.as_ref().map(|b| self.renderer.prose(b)),
            reason_html: reason.map(|r| self.renderer.prose(r)),
            why_html: super::text::reason(j).map(|r| self.renderer.prose(r)),
            links: if only.is_some() { Vec::new() } else { j.links.iter().map(|l| self.link(l)).collect() },
            dimensions: view_dimensions::view(j, &self.renderer),
            counterexample: j.counterexample.as_ref().map(|c| self.counterexample(c)),
            order: only.and_then(|l| l.order.as_ref()).map(|o| self.order(o)),
            correction,
            expected: j.expect.map(word),
            as_expected: j.as_expected,
            diagnosis: view_diagnosis::view(j, &self.renderer),
        }
    }

    /// The printed formula and its correction with what differs marked.
    fn correction(&self, j: &Judgement, plain: &str) -> (String, Option<CorrectionView>) {
        let Some(Correction { latex, verdict, links, .. }) = &j.correction else { return (plain.to_owned(), None) };
        // A reading stands for the printed formula; the correction is compared with what was judged.
        let judged = j.reading.as_ref().unwrap_or(&j.latex);
        let marks = mark_by(judged, latex, [math::marked; 2])
            .and_then(|(before, after)| Some((self.renderer.marked(&before)?, self.renderer.marked(&after)?)));
        let (printed, corrected) =
            marks.unwrap_or_else(|| (self.renderer.display(judged), self.renderer.display(latex)));
        let links = links.iter().map(|l| self.link(l)).collect();
        (printed, Some(CorrectionView { badge: badge(*verdict), math_html: corrected, latex: latex.clone(), links }))
    }

    fn link(&self, link: &LinkJudgement) -> LinkView {
        let mut facts = facts(link.strength, link.bits, link.residual, link.states);
        facts.extend(failing_states(link));
        facts.extend(link.exact.map(|e| text::exactness(e.log2_error)));
        facts.extend(link.inexact.as_ref().map(|why| format!("not exact: {why}")));
        facts.extend(link.restated.then(|| text::RESTATED.to_owned()));
        LinkView {
            badge: badge(link.verdict),
            math_html: self.renderer.display(&link.latex),
            facts,
            reason_html: link.reason.as_ref().map(|r| self.renderer.prose(r)),
            counterexample: link.counterexample.as_ref().map(|c| self.counterexample(c)),
            order: link.order.as_ref().map(|o| self.order(o)),
        }
    }

    fn counterexample(&self, c: &Counterexample) -> CounterexampleView {
        let value = |a: &crate::check::verdict::Assignment| Value {
            symbol_html: self.renderer.inline(&a.symbol),
            value: a.value.clone(),
        };
        CounterexampleView {
            component_html: c.component.as_ref().map(|text| self.component(text)),
            state: c.state.iter().map(value).collect(),
            lhs: c.lhs.clone(),
            rhs: c.rhs.clone(),
            certificate: c.certificate.as_ref().map(|c| view_certificate::view(c, &self.renderer)),
            uncertified: c.uncertified.clone(),
        }
    }

    /// A component's name, `\xi component` or `i = 2`: words are prose, what has a backslash or a sign is mathematics.
    fn component(&self, text: &str) -> String {
        if text.contains('$') {
            return self.renderer.prose(text);
        }
        if text.contains('=') {
            return self.renderer.inline(text);
        }
        let show = |w: &str| if w.contains('\\') { self.renderer.inline(w) } else { super::text::escape(w) };
        text.split(' ').map(show).collect::<Vec<_>>().join(" ")
    }

    fn order(&self, order: &Order) -> OrderView {
        let mut before: Option<(f64, f64)> = None;
        let mut row = |&(small, residual): &(f64, f64)| {
            let slope = before.map(|(s, r)| number((residual / r).ln() / (small / s).ln(), 3));
            before = Some((small, residual));
            Residual { small: number(small, 3), residual: number(residual, 3), slope }
        };
        OrderView {
            small_html: self.renderer.inline(&order.small),
            claimed: order.claimed.to_string(),
            measured: number(order.measured, 3),
            residuals: order.residuals.iter().map(&mut row).collect(),
        }
    }

    /// A free anchor for a name: `gyroscope-52`. Letters of any script stay as they are.
    fn anchor(&mut self, name: &str) -> String {
        let sign = |c: char| if c.is_alphanumeric() || matches!(c, '-' | '.' | '_') { c } else { '-' };
        let base: String = name.chars().map(sign).collect();
        let mut anchor = base.clone();
        while self.taken.contains_key(&anchor) {
            // From where the last one of this name was found: many of one name take no longer each.
            let n = self.taken.entry(base.clone()).or_insert(1);
            *n += 1;
            anchor = format!("{base}-{n}");
        }
        self.taken.insert(anchor.clone(), 1);
        anchor
    }
}

fn badge(verdict: Verdict) -> Badge {
    Badge { word: word(verdict), symbol: symbol(verdict) }
}

/// Strength, agreement, residual and states in a few words each.
fn facts(
    s: Option<crate::check::verdict::Strength>,
    bits: Option<u32>,
    residual: Option<f64>,
    states: usize,
) -> Vec<String> {
    let mut facts: Vec<_> = s.map(|s| strength(s).to_owned()).into_iter().collect();
    facts.extend(bits.map(|b| format!("{b} bit{}", if b == 1 { "" } else { "s" })));
    facts.extend(residual.map(|r| format!("residual {}", number(r, 2))));
    match states {
        0 => {}
        1 => facts.push("1 state".to_owned()),
        n => facts.push(format!("{n} states")),
    }
    facts
}

/// The bound on the chance of a false exact verdict, or why a single link has none.
fn exactness(j: &Judgement) -> Option<String> {
    if j.strength == Some(crate::check::verdict::Strength::Exact) {
        return j.links.iter().filter_map(|l| l.exact).map(|e| e.log2_error).max().map(text::exactness);
    }
    let [link] = j.links.as_slice() else { return None };
    link.inexact.as_ref().map(|why| format!("not exact: {why}"))
}

fn failing_states(link: &LinkJudgement) -> Option<String> {
    (link.failing_states > 0).then(|| format!("differs at {} of {}", link.failing_states, link.states))
}
