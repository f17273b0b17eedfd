//! The diagnosis for the templates: sensitivity, survivors, suggestions.

use super::math::{self, Renderer};
use super::words::{Language, Words, count, with};
use crate::check::verdict::{Judgement, Sensitivity};
use crate::latex::diff::mark_by;
use serde::Serialize;

/// A formula that was probably meant.
#[derive(Clone, Serialize)]
pub(super) struct SuggestionView {
    /// The printed formula, with what goes marked.
    printed_html: String,
    /// The suggested formula, with what comes marked.
    math_html: String,
    edit_html: String,
    latex: String,
}

/// What an equation's diagnosis says.
#[derive(Clone, Serialize)]
pub(super) struct Diagnosis {
    /// One line on the mutants.
    sensitivity: Option<String>,
    pub(super) survivors_html: Vec<String>,
    suggestions: Vec<SuggestionView>,
}

pub(super) fn view(j: &Judgement, renderer: &Renderer, language: Language) -> Diagnosis {
    let w = language.words();
    let words = |edit: &String| renderer.prose(&language.say(edit).replace('`', "$"));
    let survivors = j.sensitivity.iter().flat_map(|s| &s.survivors);
    let suggestion = |s: &crate::check::verdict::Suggestion| {
        let marks = mark_by(&s.printed, &s.latex, [math::marked; 2]).and_then(|(before, after)| {
            Some((renderer.marked(&before, &s.printed)?, renderer.marked(&after, &s.latex)?))
        });
        let (printed_html, math_html) =
            marks.unwrap_or_else(|| (renderer.display(&s.printed), renderer.display(&s.latex)));
        SuggestionView { printed_html, math_html, edit_html: words(&s.edit), latex: s.latex.clone() }
    };
    Diagnosis {
        sensitivity: j.sensitivity.as_ref().map(|s| sentence(s, w)),
        survivors_html: survivors.map(words).collect(),
        suggestions: j.suggestions.iter().map(suggestion).collect(),
    }
}

/// `41 of 44 mutants fail, 2 say the same, 1 passes`
fn sentence(s: &Sensitivity, w: &Words) -> String {
    let rest = [
        (w.mutants_same, s.equivalent),
        (w.mutants_less, s.weaker),
        (w.mutants_undecided, s.undecided),
        (w.mutants_pass, s.survivors.len()),
    ];
    let rest = rest.into_iter().filter(|(_, n)| *n > 0).map(|(text, n)| count(text, n));
    with(w.mutants_fail, &[("n", &s.killed), ("m", &s.total)]) + &rest.collect::<String>()
}
