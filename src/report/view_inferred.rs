//! What was found out where nothing is annotated, as the templates are given it: premises, suspects, assumed roles.

use super::math;
use super::view::Builder;
use super::view_equation::Premise;
use crate::check::verdict::{Assumed, DocumentReport, Inferred, Judgement, Suspect};
use crate::latex::diff::{mark_by, words};
use serde::Serialize;

/// What was found out about an equation beside its premises.
#[derive(Clone, Serialize)]
pub(super) struct Found {
    /// Whether premises were found.
    premises: bool,
    new: bool,
    needs_html: Vec<String>,
}

/// The formula that an equation should perhaps read.
#[derive(Clone, Serialize)]
pub(super) struct SuspectView {
    pub edit_html: String,
    /// The label of another equation that is edited.
    pub other: Option<String>,
    /// The printed formula with what goes marked, where it is this equation's.
    pub printed_html: Option<String>,
    /// The edited formula with what comes marked.
    pub math_html: String,
    pub latex: String,
    pub premises: Vec<Premise>,
}

/// A symbol with the role that it was guessed to have.
#[derive(Serialize)]
pub(super) struct AssumedView {
    symbol_html: String,
    role: String,
    range: Option<String>,
    line: usize,
}

/// Of an equation.
pub(super) fn found(inferred: &Inferred, builder: &Builder<'_>) -> Found {
    Found {
        premises: !inferred.given.is_empty() || !inferred.formulas.is_empty(),
        new: inferred.new,
        needs_html: inferred.needs.iter().map(|n| builder.renderer.inline(n)).collect(),
    }
}

/// Of an equation that one edit would make follow; `premise` finds what a label means.
pub(super) fn suspect(
    j: &Judgement,
    suspect: &Suspect,
    builder: &Builder<'_>,
    premise: impl Fn(&String) -> Premise,
) -> SuspectView {
    let own = suspect.label == j.label;
    let printed = printed(suspect);
    let marked = printed.as_ref().and_then(|printed| mark_by(printed, &suspect.latex, [math::marked; 2]));
    let (before, after) = marked.unzip();
    let show =
        |marked: Option<String>, latex: Option<&String>| builder.renderer.marked(marked.as_deref()?, latex?.as_str());
    SuspectView {
        edit_html: builder.renderer.prose(&builder.options.language.say(&suspect.edit).replace('`', "$")),
        other: (!own).then(|| suspect.label.clone()),
        printed_html: if own { show(before, printed.as_ref()) } else { None },
        math_html: show(after, Some(&suspect.latex)).unwrap_or_else(|| builder.renderer.display(&suspect.latex)),
        latex: suspect.latex.clone(),
        premises: suspect.premises.iter().map(premise).collect(),
    }
}

/// The printed formula in the spelling of the edited one: the difference without its marks, where it is that and the
/// formula itself has nothing that looks like a mark.
pub(super) fn printed(suspect: &Suspect) -> Option<String> {
    let diff = suspect.diff.as_ref()?;
    let printed = diff.printed.replace("[-", "").replace("-]", "");
    let (before, after) = words(&printed, &suspect.latex)?;
    (before == diff.printed && after == diff.suggested).then_some(printed)
}

/// The roles that the symbols of a document were guessed to have.
pub(super) fn assumed(document: &DocumentReport, builder: &Builder<'_>) -> Vec<AssumedView> {
    let view = |a: &Assumed| {
        let role = builder.options.language.say(&a.role);
        let moves = if a.moves {
            format!("{}{}", builder.words.list_comma, builder.words.assumed_moves)
        } else {
            String::new()
        };
        AssumedView {
            symbol_html: builder.renderer.inline(&a.symbol),
            role: format!("{role}{moves}"),
            range: a.range.map(|[low, high]| format!("[{low}, {high}]")),
            line: a.line,
        }
    };
    document.assumed.iter().map(view).collect()
}
