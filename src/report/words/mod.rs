//! The words of reports: a typed table for each language, so that none can lack one.
//!
//! A text may have places, `{n}`, and where the language tells one from many two forms with `|` between them. What notes
//! say stays in its language; sentences that other floors compose are translated as far as they are known, by `reasons`.

pub(super) mod charts;
mod en;
mod ja;
mod reasons;
pub(super) mod speed;
pub(super) mod stability;

use crate::check::verdict::{Strength, Verdict};
use crate::document::Problem;
use serde::Serialize;
use std::borrow::Cow;

/// The language of a report's own words.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Language {
    /// English
    #[default]
    #[value(name = "en")]
    English,
    /// 日本語
    #[value(name = "ja")]
    Japanese,
}

impl Language {
    /// The user's, by the locale: Japanese where that is Japanese, English elsewhere. The first of `LC_ALL`,
    /// `LC_MESSAGES`, `LANG` that is set decides; where none is, the system.
    pub fn of_locale() -> Self {
        let set = |name: &&str| std::env::var(name).ok().filter(|locale| !locale.is_empty());
        let named = ["LC_ALL", "LC_MESSAGES", "LANG"].iter().find_map(set);
        named.or_else(sys_locale::get_locale).map_or(Language::English, |locale| Language::of(&locale))
    }

    /// Of a locale's name: `ja_JP.UTF-8`, `ja-JP`, `ja`.
    fn of(locale: &str) -> Self {
        let tongue = locale.split(['-', '_', '.', '@']).next().unwrap_or_default();
        if tongue.eq_ignore_ascii_case("ja") { Language::Japanese } else { Language::English }
    }

    /// The tag of BCP 47, as in HTML's attribute `lang`.
    pub fn tag(self) -> &'static str {
        match self {
            Language::English => "en",
            Language::Japanese => "ja",
        }
    }

    /// A sentence that another floor composed in English, in this language as far as it is known.
    pub(super) fn say(self, english: &str) -> Cow<'_, str> {
        match self {
            Language::English => english.into(),
            Language::Japanese => reasons::japanese(english),
        }
    }

    /// A document's problem with its place in plain text, in this language.
    pub(super) fn say_problem(self, english: &str) -> Cow<'_, str> {
        match self {
            Language::English => english.into(),
            Language::Japanese => reasons::problem(english),
        }
    }

    /// A problem in this language.
    pub fn problem(self, problem: &Problem) -> Problem {
        let say = |text: &String| self.say(text).into_owned();
        Problem {
            message: say(&problem.message),
            label: problem.label.as_ref().map(say),
            other: problem.other.as_ref().map(|(span, label)| (span.clone(), say(label))),
            help: problem.help.as_ref().map(say),
            ..problem.clone()
        }
    }

    pub(super) fn words(self) -> &'static Words {
        match self {
            Language::English => &en::EN,
            Language::Japanese => &ja::JA,
        }
    }
}

/// The last line of the terminal's summary: where the report begins.
pub fn where_to_begin(language: Language, path: &std::path::Path) -> String {
    with(language.words().terminal_report, &[("path", &path.display())])
}

/// That there are more problems than are shown in the source.
pub fn more_problems(language: Language, n: usize) -> String {
    count(language.words().terminal_more, n)
}

/// The form of a text for a number, with the number in its place `{n}`.
pub(super) fn count(text: &str, n: usize) -> String {
    fill(text, n, &[("n", &n)])
}

/// The form of a text for a number, with all its places filled.
pub(super) fn fill(text: &str, n: usize, places: &[(&str, &dyn std::fmt::Display)]) -> String {
    let mut filled = String::new();
    let mut rest = form(text, n);
    // What is filled in is not searched for places: it may come from notes.
    while let Some((before, after)) = rest.split_once('{') {
        let Some((name, after)) = after.split_once('}') else { break };
        filled.push_str(before);
        if let Some((_, value)) = places.iter().find(|(place, _)| *place == name) {
            filled.push_str(&value.to_string());
        }
        rest = after;
    }
    filled + rest
}

/// A text with its places filled, where no number decides the form.
pub(super) fn with(text: &str, places: &[(&str, &dyn std::fmt::Display)]) -> String {
    fill(text, 2, places)
}

fn form(text: &str, n: usize) -> &str {
    match text.split_once('|') {
        Some((one, _)) if n == 1 => one,
        Some((_, many)) => many,
        None => text,
    }
}

/// All the words. Templates have them as `w`.
#[derive(Serialize)]
pub(super) struct Words {
    // Verdicts, strengths, kinds
    pub holds: &'static str,
    pub asymptotic: &'static str,
    pub definition: &'static str,
    pub statement: &'static str,
    pub fails: &'static str,
    pub undecided: &'static str,
    pub unreadable: &'static str,
    pub exact: &'static str,
    pub numeric: &'static str,
    pub certified: &'static str,
    pub measured_order: &'static str,
    pub shape: &'static str,
    pub identity: &'static str,
    pub law: &'static str,
    pub derived: &'static str,
    pub constant: &'static str,
    pub approximation: &'static str,
    pub inequality: &'static str,
    pub solution: &'static str,
    pub value: &'static str,
    pub transformation: &'static str,
    pub equivalence: &'static str,

    // Every page
    pub skip: &'static str,
    pub headline: &'static str,
    pub lead: &'static str,
    pub lead_equations: &'static str,
    pub lead_states: &'static str,
    pub lead_bits: &'static str,
    pub lead_time: &'static str,
    pub in_documents: &'static str,
    pub all_as_expected: &'static str,
    pub not_as_expected_count: &'static str,
    pub contents: &'static str,
    pub overview: &'static str,
    pub to_report: &'static str,
    pub to_errata: &'static str,
    pub to_map: &'static str,
    pub no_documents: &'static str,
    pub numbers: &'static str,

    // The index
    pub documents: &'static str,
    pub document: &'static str,
    pub equations: &'static str,
    pub not_expected_head: &'static str,
    pub errata_head: &'static str,

    // The page of a document
    pub summary: &'static str,
    pub errata: &'static str,
    pub attention: &'static str,
    pub mutants_title: &'static str,
    pub mutants_note: &'static str,
    pub mutants_edits: &'static str,
    pub charts: &'static str,
    pub how_to_read: &'static str,
    pub no_equations: &'static str,
    pub before_first_heading: &'static str,
    pub errata_note: &'static str,
    pub errata_none: &'static str,
    pub share_errata: &'static str,
    pub exact_of: &'static str,
    pub certified_of: &'static str,
    pub restated_count: &'static str,
    pub errata_lost: &'static str,
    pub dimensions_count: &'static str,
    pub dimensions_inferred: &'static str,
    pub inferred_from: &'static str,

    // Finding equations
    pub find: &'static str,
    pub search: &'static str,
    pub search_hint: &'static str,
    pub show_only: &'static str,
    pub section: &'static str,
    pub all_sections: &'static str,
    pub unexpected_only: &'static str,
    pub show_all: &'static str,
    pub shown: &'static str,
    pub copy: &'static str,
    pub copy_corrected: &'static str,
    pub copied: &'static str,
    pub not_copied: &'static str,

    // An equation
    pub erratum: &'static str,
    pub known: &'static str,
    pub not_as_expected: &'static str,
    pub as_expected: &'static str,
    pub unnumbered: &'static str,
    pub line: &'static str,
    pub from: &'static str,
    pub with: &'static str,
    pub list_comma: &'static str,
    pub full_stop: &'static str,
    pub should_read: &'static str,
    pub printed: &'static str,
    pub printed_as_read: &'static str,
    pub should_read_head: &'static str,
    pub links_of_correction: &'static str,
    pub links: &'static str,
    pub read_as: &'static str,
    pub read_as_note: &'static str,
    pub latex: &'static str,
    pub dimensions_ok: &'static str,
    pub dimensions_differ: &'static str,
    pub dimensions: &'static str,
    pub dimension: &'static str,
    pub term: &'static str,
    pub counterexample: &'static str,
    pub left_side: &'static str,
    pub right_side: &'static str,
    pub certified_by: &'static str,
    pub not_certified: &'static str,
    pub at: &'static str,
    pub difference: &'static str,
    pub or: &'static str,
    pub equals: &'static str,
    pub is: &'static str,
    pub lies_in: &'static str,
    pub in_fractions: &'static str,
    pub with_bits: &'static str,
    pub order_caption: &'static str,
    pub residual_head: &'static str,
    pub order_head: &'static str,
    pub perhaps: &'static str,
    pub perhaps_head: &'static str,
    pub mutants_fail: &'static str,
    pub mutants_same: &'static str,
    pub mutants_less: &'static str,
    pub mutants_undecided: &'static str,
    pub mutants_pass: &'static str,
    pub bits: &'static str,
    pub residual: &'static str,
    pub states: &'static str,
    pub differs_at: &'static str,
    pub false_below: &'static str,
    pub not_exact: &'static str,
    pub as_a_premise_says: &'static str,
    pub doubles_lose: &'static str,

    // How to read this
    pub legend_holds: &'static str,
    pub legend_asymptotic: &'static str,
    pub legend_definition: &'static str,
    pub legend_statement: &'static str,
    pub legend_fails: &'static str,
    pub legend_undecided: &'static str,
    pub legend_unreadable: &'static str,
    pub legend_strengths: &'static str,

    // What was found out where nothing is annotated
    pub found: &'static str,
    pub new_here: &'static str,
    pub needs: &'static str,
    pub suspect: &'static str,
    pub suspect_head: &'static str,
    pub assumed_count: &'static str,
    pub assumed_note: &'static str,
    pub assumed_symbol: &'static str,
    pub assumed_role: &'static str,
    pub assumed_range: &'static str,
    pub assumed_line: &'static str,
    pub assumed_moves: &'static str,

    // The errata sheet
    pub sheet_title: &'static str,
    pub sheet_note: &'static str,
    pub sheet_entries: &'static str,
    pub sheet_suspects: &'static str,
    pub sheet_suspects_note: &'static str,
    pub sheet_open: &'static str,
    pub sheet_none: &'static str,
    pub sheet_change: &'static str,
    pub sheet_why: &'static str,
    pub sheet_differ: &'static str,
    pub sheet_certified: &'static str,
    pub sheet_exact: &'static str,
    pub sheet_order: &'static str,
    pub sheet_agree: &'static str,
    pub sheet_premises: &'static str,
    pub sheet_edit_of: &'static str,
    pub sheet_would_follow: &'static str,

    // The derivation map
    pub map_title: &'static str,
    pub map_note: &'static str,
    pub map_summary: &'static str,
    pub map_whole: &'static str,
    pub map_whole_note: &'static str,
    pub map_whole_drawing: &'static str,
    pub map_spoken_section: &'static str,
    pub map_section: &'static str,
    pub map_equations: &'static str,
    pub map_failing: &'static str,
    pub map_danger_count: &'static str,
    pub map_part: &'static str,
    pub map_drawing: &'static str,
    pub map_spoken_rests: &'static str,
    pub map_spoken_danger: &'static str,
    pub map_table: &'static str,
    pub map_equation: &'static str,
    pub map_verdict: &'static str,
    pub map_rests_on: &'static str,
    pub map_used_by: &'static str,
    pub map_danger: &'static str,
    pub map_alone: &'static str,
    pub map_none: &'static str,
    pub map_found: &'static str,

    // The terminal
    pub terminal_expected: &'static str,
    pub terminal_unexpected: &'static str,
    pub terminal_problems: &'static str,
    pub terminal_total: &'static str,
    pub terminal_equations: &'static str,
    pub terminal_time: &'static str,
    pub terminal_none: &'static str,
    pub terminal_restated: &'static str,
    pub terminal_corrected: &'static str,
    pub terminal_errata: &'static str,
    pub terminal_dimensions: &'static str,
    pub terminal_reason: &'static str,
    pub terminal_as_expected: &'static str,
    pub terminal_correction_not: &'static str,
    pub terminal_expected_otherwise: &'static str,
    pub terminal_should_read: &'static str,
    pub terminal_which: &'static str,
    pub terminal_example: &'static str,
    pub terminal_certified: &'static str,
    pub terminal_dimension_finding: &'static str,
    pub terminal_perhaps: &'static str,
    pub terminal_mutants: &'static str,
    pub terminal_passes: &'static str,
    pub terminal_report: &'static str,
    pub terminal_more: &'static str,
    pub phrase_holds: &'static str,
    pub phrase_asymptotic: &'static str,
    pub phrase_definition: &'static str,
    pub phrase_statement: &'static str,
    pub phrase_fails: &'static str,
    pub phrase_undecided: &'static str,
    pub phrase_unreadable: &'static str,
}

impl Words {
    /// A verdict's name.
    pub fn verdict(&self, verdict: Verdict) -> &'static str {
        match verdict {
            Verdict::Holds => self.holds,
            Verdict::Asymptotic => self.asymptotic,
            Verdict::Definition => self.definition,
            Verdict::Statement => self.statement,
            Verdict::Fails => self.fails,
            Verdict::Undecided => self.undecided,
            Verdict::Unreadable => self.unreadable,
        }
    }

    /// A verdict as the end of a sentence.
    pub fn phrase(&self, verdict: Verdict) -> &'static str {
        match verdict {
            Verdict::Holds => self.phrase_holds,
            Verdict::Asymptotic => self.phrase_asymptotic,
            Verdict::Definition => self.phrase_definition,
            Verdict::Statement => self.phrase_statement,
            Verdict::Fails => self.phrase_fails,
            Verdict::Undecided => self.phrase_undecided,
            Verdict::Unreadable => self.phrase_unreadable,
        }
    }

    /// A strength's name.
    pub fn strength(&self, strength: Strength) -> &'static str {
        match strength {
            Strength::Exact => self.exact,
            Strength::Numeric => self.numeric,
            Strength::Certified => self.certified,
            Strength::Asymptotic => self.measured_order,
            Strength::Shape => self.shape,
        }
    }

    /// A kind's name; what is no kind stays as it is.
    pub fn kind<'k>(&self, kind: &'k str) -> &'k str {
        match kind {
            "identity" => self.identity,
            "definition" => self.definition,
            "law" => self.law,
            "derived" => self.derived,
            "constant" => self.constant,
            "approximation" => self.approximation,
            "inequality" => self.inequality,
            "solution" => self.solution,
            "value" => self.value,
            "transformation" => self.transformation,
            "equivalence" => self.equivalence,
            "statement" => self.statement,
            other => other,
        }
    }
}

#[cfg(test)]
mod tests;
