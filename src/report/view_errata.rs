//! The errata sheet: what an author is sent.

use super::text::{escape, number};
use super::view::{Builder, Section};
use super::view_equation::Equation;
use super::view_inferred;
use super::words::{count, with};
use crate::check::verdict::{DocumentReport, Judgement, LinkJudgement, Strength, Suspect, Verdict};
use crate::latex::diff::mark_by;
use serde::Serialize;

/// The sheet of a document.
#[derive(Serialize)]
pub(super) struct Sheet {
    /// Equations of which a correction holds.
    errata: Vec<Entry>,
    /// Equations that would follow after one edit, which Kenzan found.
    suspects: Vec<Entry>,
    /// Equations that fail, without anything better.
    open: Vec<Entry>,
}

/// An equation of the sheet.
#[derive(Serialize)]
struct Entry {
    eq: Equation,
    section_html: String,
    section_lang: Option<&'static str>,
    printed_html: String,
    /// What it should read.
    corrected_html: Option<String>,
    corrected_latex: Option<String>,
    /// Both sources in one with what goes and what comes, for print without colour and for reading aloud.
    change_html: Option<String>,
    /// Why it is believed, a sentence each.
    evidence_html: Vec<String>,
}

/// The sheet, by the document's sections.
pub(super) fn sheet(document: &DocumentReport, sections: &[Section], builder: &Builder<'_>) -> Sheet {
    let mut sheet = Sheet { errata: Vec::new(), suspects: Vec::new(), open: Vec::new() };
    let equations = sections.iter().flat_map(|s| s.equations.iter().map(move |e| (s, e)));
    for (j, (section, eq)) in document.equations.iter().zip(equations) {
        if eq.erratum {
            sheet.errata.push(erratum(j, section, eq, builder));
        } else if let Some(suspect) = &j.suspect {
            sheet.suspects.push(suspected(j, suspect, section, eq, builder));
        } else if j.verdict == Verdict::Fails {
            sheet.open.push(open(j, section, eq, builder));
        }
    }
    sheet
}

fn erratum(j: &Judgement, section: &Section, eq: &Equation, builder: &Builder<'_>) -> Entry {
    let judged = j.reading.as_ref().unwrap_or(&j.latex);
    let corrected = j.correction.as_ref().map(|c| c.latex.as_str());
    let mut evidence = differences(j, builder);
    evidence.extend(j.correction.as_ref().and_then(|c| agreement(&c.links, builder)).map(|s| escape(&s)));
    evidence.extend(premises(&j.given, builder));
    evidence.extend(j.because.as_ref().map(|b| builder.renderer.prose(b)));
    Entry {
        printed_html: eq.printed_html.clone(),
        corrected_html: eq.correction.as_ref().map(|c| c.math_html.clone()),
        corrected_latex: corrected.map(str::to_owned),
        change_html: corrected.and_then(|c| change(judged, c)),
        ..entry(section, eq, evidence)
    }
}

fn suspected(j: &Judgement, suspect: &Suspect, section: &Section, eq: &Equation, builder: &Builder<'_>) -> Entry {
    let w = builder.words;
    let view = eq.suspect.as_ref();
    let edit = view.map(|v| v.edit_html.clone()).unwrap_or_default();
    let own = view.is_none_or(|v| v.other.is_none());
    let label = escape(&suspect.label);
    let mut evidence = vec![if own { edit } else { with(w.sheet_edit_of, &[("label", &label), ("edit", &edit)]) }];
    evidence.push(builder.reason(super::text::reason(j).unwrap_or_default()));
    if !suspect.premises.is_empty() {
        let premises: Vec<String> = suspect.premises.iter().map(|p| builder.premise(p)).collect();
        evidence.push(with(w.sheet_would_follow, &[("labels", &premises.join(w.list_comma))]));
    }
    let printed = view_inferred::printed(suspect).filter(|_| own);
    Entry {
        printed_html: view.and_then(|v| v.printed_html.clone()).unwrap_or_else(|| eq.printed_html.clone()),
        corrected_html: view.map(|v| v.math_html.clone()),
        corrected_latex: Some(suspect.latex.clone()),
        change_html: printed.and_then(|printed| change(&printed, &suspect.latex)),
        ..entry(section, eq, evidence)
    }
}

fn open(j: &Judgement, section: &Section, eq: &Equation, builder: &Builder<'_>) -> Entry {
    let mut evidence = differences(j, builder);
    evidence.extend(premises(&j.given, builder));
    evidence.extend(j.because.as_ref().map(|b| builder.renderer.prose(b)));
    entry(section, eq, evidence)
}

fn entry(section: &Section, eq: &Equation, evidence_html: Vec<String>) -> Entry {
    Entry {
        eq: eq.clone(),
        section_html: section.title_html.clone(),
        section_lang: section.lang,
        printed_html: eq.printed_html.clone(),
        corrected_html: None,
        corrected_latex: None,
        change_html: None,
        evidence_html,
    }
}

/// At how many states the sides differ, and the reason that the verdict gives.
fn differences(j: &Judgement, builder: &Builder<'_>) -> Vec<String> {
    let w = builder.words;
    let worst = j.links.iter().filter(|l| l.failing_states > 0).max_by_key(|l| l.failing_states);
    let counted = worst.map(|l| escape(&with(w.sheet_differ, &[("n", &l.failing_states), ("m", &l.states)])));
    let certified = (j.strength == Some(Strength::Certified)).then(|| w.sheet_certified.to_owned());
    let reason = super::text::reason(j).map(|r| builder.reason(r));
    let dimensions = j.dimension_findings.iter().map(|f| with(w.dimensions, &[("text", &builder.reason(&f.message))]));
    counted.into_iter().chain(certified).chain(reason).chain(dimensions).collect()
}

/// How well the corrected formula holds: as well as its weakest link.
fn agreement(links: &[LinkJudgement], builder: &Builder<'_>) -> Option<String> {
    let w = builder.words;
    let weakest = links.iter().filter_map(|l| l.strength).max_by_key(|s| s.weakness())?;
    let states = links.iter().map(|l| l.states).max().unwrap_or(0);
    Some(match weakest {
        Strength::Exact => w.sheet_exact.to_owned(),
        Strength::Asymptotic => {
            let order = links.iter().find_map(|l| l.order.as_ref())?;
            with(w.sheet_order, &[("order", &number(order.measured, 3))])
        }
        _ => {
            let bits = links.iter().filter_map(|l| l.bits).min()?;
            with(w.sheet_agree, &[("states", &count(w.states, states)), ("bits", &count(w.bits, bits as usize))])
        }
    })
}

fn premises(given: &[String], builder: &Builder<'_>) -> Option<String> {
    let w = builder.words;
    let labels: Vec<String> = given.iter().map(|label| format!("({label})")).collect();
    (!labels.is_empty()).then(|| escape(&with(w.sheet_premises, &[("labels", &labels.join(w.list_comma))])))
}

/// Signs that stand around what goes and what comes until the text is escaped; the notes' own ones are taken out.
const SIGNS: [char; 3] = ['\u{f0001}', '\u{f0002}', '\u{f0003}'];

/// The two sources, with what goes as `del` and what comes as `ins`.
fn change(printed: &str, corrected: &str) -> Option<String> {
    let clean = |text: &str| text.replace(SIGNS, "");
    let marks = [
        |part: &str| format!("{}{part}{}", SIGNS[0], SIGNS[2]),
        |part: &str| format!("{}{part}{}", SIGNS[1], SIGNS[2]),
    ];
    let (before, after) = mark_by(&clean(printed), &clean(corrected), marks)?;
    let html = |text: &str, element: &str| {
        let escaped = escape(text.trim());
        escaped.replace([SIGNS[0], SIGNS[1]], &format!("<{element}>")).replace(SIGNS[2], &format!("</{element}>"))
    };
    Some(format!("<code>{}</code> → <code>{}</code>", html(&before, "del"), html(&after, "ins")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn changes_are_marked_and_escaped() {
        let html = change(r"a < \sin x", r"a < \cos x \u{f0001}").unwrap();
        assert!(html.starts_with(r"<code>a &lt; <del>\sin</del> x</code> → <code>a &lt; <ins>\cos</ins> x"), "{html}");
        let hostile = change("a \u{f0001} <b>", "a \u{f0003} <c>").unwrap();
        assert_eq!(hostile.matches("<del>").count(), hostile.matches("</del>").count());
        assert!(!hostile.contains("<b>") && !hostile.contains("<c>"));
    }
}
