//! What the templates are given of dimensions.

use super::Language;
use super::math::Renderer;
use crate::check::verdict::{DimensionFinding, DimensionStatus, DocumentReport, Judgement};
use serde::Serialize;

/// How an equation's dimensions are shown.
#[derive(Clone, Serialize)]
pub(super) struct View {
    /// `dimensions ok`, nothing where they were not checked.
    fact: Option<&'static str>,
    findings: Vec<Finding>,
}

#[derive(Clone, Serialize)]
struct Finding {
    message_html: String,
    terms: Vec<Term>,
}

#[derive(Clone, Serialize)]
struct Term {
    math_html: String,
    dimension: String,
}

/// How the dimensions of a document's equations are shown.
#[derive(Serialize)]
pub(super) struct Summary {
    ok: usize,
    unchecked: usize,
    mismatches: usize,
    inferred: Vec<Inferred>,
}

#[derive(Serialize)]
struct Inferred {
    symbol_html: String,
    dimension: String,
    from: String,
}

/// The view of an equation's dimensions.
pub(super) fn view(j: &Judgement, renderer: &Renderer, language: Language) -> View {
    let words = language.words();
    let fact = match j.dimension {
        DimensionStatus::Ok => Some(words.dimensions_ok),
        DimensionStatus::Mismatch => Some(words.dimensions_differ),
        DimensionStatus::Unchecked => None,
    };
    let finding = |f: &DimensionFinding| Finding {
        message_html: renderer.prose(&language.say(&f.message)),
        terms: (f.terms.iter())
            .map(|t| Term { math_html: renderer.inline(&t.latex), dimension: t.dimension.clone() })
            .collect(),
    };
    View { fact, findings: j.dimension_findings.iter().map(finding).collect() }
}

/// The summary of a document's dimensions; `None` where none was checked.
pub(super) fn summary(document: &DocumentReport, renderer: &Renderer) -> Option<Summary> {
    let count = |status| document.equations.iter().filter(|e| e.dimension == status).count();
    let (ok, mismatches) = (count(DimensionStatus::Ok), count(DimensionStatus::Mismatch));
    let inferred = document.inferred.iter().map(|i| Inferred {
        symbol_html: renderer.inline(&i.symbol.replace("##", "ik").replace('#', "i")),
        dimension: i.dimension.clone(),
        from: i.from.clone(),
    });
    let summary =
        Summary { ok, mismatches, unchecked: count(DimensionStatus::Unchecked), inferred: inferred.collect() };
    (ok + mismatches > 0).then_some(summary)
}
