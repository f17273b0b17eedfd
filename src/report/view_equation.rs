//! An equation as the templates are given it.

use super::math;
use super::text::{self, duration, number};
use super::view::{Badge, Builder};
use super::words::{Words, count, with};
use super::{view_certificate, view_diagnosis, view_dimensions, view_inferred};
use crate::check::verdict::{Correction, Counterexample, Judgement, LinkJudgement, Order, Strength};
use crate::latex::diff::mark_by;
use serde::Serialize;
use std::collections::HashMap;

/// An equation on a document's page.
#[derive(Clone, Serialize)]
pub(super) struct Equation {
    pub anchor: String,
    document: String,
    label: String,
    numbered: bool,
    line: usize,
    badge: Badge,
    pub erratum: bool,
    kind: String,
    facts: Vec<String>,
    time: Option<String>,
    math_html: String,
    pub printed_html: String,
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
    pub correction: Option<CorrectionView>,
    /// Whether the annotation says what is expected.
    expected: bool,
    as_expected: bool,
    pub diagnosis: view_diagnosis::Diagnosis,
    found: Option<view_inferred::Found>,
    pub suspect: Option<view_inferred::SuspectView>,
}

#[derive(Clone, Serialize)]
pub(super) struct Premise {
    /// Its label; of an inline formula the formula itself.
    label: String,
    label_html: String,
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
pub(super) struct CorrectionView {
    badge: Badge,
    pub math_html: String,
    latex: String,
    links: Vec<LinkView>,
}

impl Equation {
    /// Whether somebody has to look at it, beside the errata.
    pub fn needs_attention(&self) -> bool {
        let open = matches!(self.badge.class, "fails" | "undecided" | "unreadable");
        !self.erratum && (open || !self.as_expected)
    }
}

impl Builder<'_> {
    /// An equation under its anchor; `labels` are the anchors of the others.
    pub fn equation(&self, j: &Judgement, document: &str, anchor: &str, labels: &HashMap<&str, &str>) -> Equation {
        let math_html = self.renderer.display(&j.latex);
        let (printed_html, correction) = self.correction(j, &math_html);
        let premise = |label: &String| Premise {
            label: label.clone(),
            label_html: self.premise(label),
            href: labels.get(label.as_str()).map(|anchor| format!("#{anchor}")),
        };
        // A single link repeats the equation: what it knows more is shown with the equation itself.
        let only = if let [link] = j.links.as_slice() { Some(link) } else { None };
        let w = self.words;
        let mut facts = facts(w, j.strength, j.bits, only.and_then(|l| l.residual), j.states);
        facts.extend(only.and_then(|l| failing_states(w, l)));
        facts.extend(self.exactness(j));
        facts.extend(j.lost_bits.map(|l| with(w.doubles_lose, &[("mean", &l.mean), ("worst", &l.worst)])));
        facts.extend(Judgement::only_restates(&j.links).then(|| w.as_a_premise_says.to_owned()));
        let reason = j.reason.as_ref().or_else(|| only.and_then(|l| l.reason.as_ref()));
        Equation {
            anchor: anchor.to_owned(),
            document: document.to_owned(),
            label: j.label.clone(),
            numbered: j.numbered,
            line: j.line,
            badge: self.badge(j.verdict),
            erratum: j.is_erratum(),
            kind: w.kind(&j.kind).to_owned(),
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
            reason_html: reason.map(|r| self.reason(r)),
            why_html: text::reason(j).map(|r| self.reason(r)),
            links: if only.is_some() { Vec::new() } else { j.links.iter().map(|l| self.link(l)).collect() },
            dimensions: view_dimensions::view(j, &self.renderer, self.options.language),
            counterexample: j.counterexample.as_ref().map(|c| self.counterexample(c)),
            order: only.and_then(|l| l.order.as_ref()).map(|o| self.order(o)),
            correction,
            expected: j.expect.is_some(),
            as_expected: j.as_expected,
            diagnosis: view_diagnosis::view(j, &self.renderer, self.options.language),
            found: j.inferred.as_ref().map(|i| view_inferred::found(i, self)),
            suspect: j.suspect.as_ref().map(|s| view_inferred::suspect(j, s, self, premise)),
        }
    }

    /// A reason in the page's language, where it has been translated.
    pub fn reason(&self, reason: &str) -> String {
        self.renderer.prose(&self.options.language.say(reason))
    }

    /// A premise: a label in brackets, or an inline formula between dollars.
    pub fn premise(&self, name: &str) -> String {
        if name.starts_with('$') { self.renderer.prose(name) } else { format!("({})", text::escape(name)) }
    }

    /// The printed formula and its correction with what differs marked.
    fn correction(&self, j: &Judgement, plain: &str) -> (String, Option<CorrectionView>) {
        let Some(Correction { latex, verdict, links, .. }) = &j.correction else { return (plain.to_owned(), None) };
        // A reading stands for the printed formula; the correction is compared with what was judged.
        let judged = j.reading.as_ref().unwrap_or(&j.latex);
        let marks = mark_by(judged, latex, [math::marked; 2]).and_then(|(before, after)| {
            Some((self.renderer.marked(&before, judged)?, self.renderer.marked(&after, latex)?))
        });
        let (printed, corrected) =
            marks.unwrap_or_else(|| (self.renderer.display(judged), self.renderer.display(latex)));
        let links = links.iter().map(|l| self.link(l)).collect();
        (
            printed,
            Some(CorrectionView { badge: self.badge(*verdict), math_html: corrected, latex: latex.clone(), links }),
        )
    }

    fn link(&self, link: &LinkJudgement) -> LinkView {
        let w = self.words;
        let mut facts = facts(w, link.strength, link.bits, link.residual, link.states);
        facts.extend(failing_states(w, link));
        facts.extend(link.exact.map(|e| false_below(w, e.log2_error)));
        facts.extend(self.inexact(link));
        facts.extend(link.restated.then(|| w.as_a_premise_says.to_owned()));
        LinkView {
            badge: self.badge(link.verdict),
            math_html: self.renderer.display(&link.latex),
            facts,
            reason_html: link.reason.as_ref().map(|r| self.reason(r)),
            counterexample: link.counterexample.as_ref().map(|c| self.counterexample(c)),
            order: link.order.as_ref().map(|o| self.order(o)),
        }
    }

    /// The bound on the chance of a false exact verdict, or why a single link has none.
    fn exactness(&self, j: &Judgement) -> Option<String> {
        if j.strength == Some(Strength::Exact) {
            let bounds = j.links.iter().filter_map(|l| l.exact).map(|e| e.log2_error);
            return bounds.max().map(|e| false_below(self.words, e));
        }
        let [link] = j.links.as_slice() else { return None };
        self.inexact(link)
    }

    fn inexact(&self, link: &LinkJudgement) -> Option<String> {
        let why = self.options.language.say(link.inexact.as_ref()?);
        Some(with(self.words.not_exact, &[("why", &why)]))
    }

    fn counterexample(&self, c: &Counterexample) -> CounterexampleView {
        let value = |a: &crate::check::verdict::Assignment| Value {
            symbol_html: self.renderer.inline(&a.symbol),
            value: a.value.clone(),
        };
        CounterexampleView {
            component_html: c.component.as_ref().map(|text| self.component(&self.options.language.say(text))),
            state: c.state.iter().map(value).collect(),
            lhs: c.lhs.clone(),
            rhs: c.rhs.clone(),
            certificate: c.certificate.as_ref().map(|c| view_certificate::view(c, &self.renderer, self.words)),
            uncertified: c.uncertified.as_ref().map(|why| self.options.language.say(why).into_owned()),
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
        let show = |w: &str| if w.contains('\\') { self.renderer.inline(w) } else { text::escape(w) };
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
}

/// Strength, agreement, residual and states in a few words each.
fn facts(w: &Words, s: Option<Strength>, bits: Option<u32>, residual: Option<f64>, states: usize) -> Vec<String> {
    let mut facts: Vec<_> = s.map(|s| w.strength(s).to_owned()).into_iter().collect();
    facts.extend(bits.map(|b| count(w.bits, b as usize)));
    facts.extend(residual.map(|r| with(w.residual, &[("value", &number(r, 2))])));
    facts.extend((states > 0).then(|| count(w.states, states)));
    facts
}

/// The bound on the chance of a false exact verdict: `false with a chance below 2⁻¹⁰²`.
fn false_below(w: &Words, log2_error: i32) -> String {
    with(w.false_below, &[("chance", &format!("2{}", text::superscript(log2_error)))])
}

fn failing_states(w: &Words, link: &LinkJudgement) -> Option<String> {
    (link.failing_states > 0).then(|| with(w.differs_at, &[("n", &link.failing_states), ("m", &link.states)]))
}
