//! References of the prose to equations that do not exist, as warnings.
//!
//! What surely refers to an equation is checked: `\eqref{..}` (in LaTeX also `\ref`, `\cref` and their like, which may
//! name any `\label`), Quarto's and Pandoc's `@eq-foo`, MyST's `` {eq}`foo` ``, and in words "Eq. (12)", "equation (12)",
//! 式 (12), (12) 式, where the notes number equations at all.

use super::Item;
use super::assembly::Assembly;
use super::dialect::near;
use super::place::Span;
use super::problem::{Problem, nearest};
use std::collections::HashSet;

/// Macros that refer to labels; with the first in Markdown, too.
const REFERRING: [&str; 9] = ["eqref", "ref", "cref", "Cref", "autoref", "labelcref", "vref", "subeqref", "crefrange"];

/// Words that make what follows in parentheses the number of an equation.
const WORDS: [&str; 10] = ["Eq.", "Eqs.", "eq.", "eqs.", "Equation", "Equations", "equation", "equations", "Gl.", "式"];

/// In which language notes are written, as far as references go.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Language {
    Markdown,
    /// LaTeX, of which all files have been read, or some are missing and may hold any label.
    Latex {
        complete: bool,
    },
}

/// A reference: the label, and its place.
type Reference = (String, Span);

impl Assembly<'_> {
    /// Checks the references in a text of the length of the source, in which what is no prose is blank.
    pub(super) fn check_references(&mut self, prose: &str, language: Language) {
        let mut known: HashSet<&str> = labels(prose).collect();
        known.extend(labels(self.clean));
        let mut names: Vec<&str> = Vec::new();
        for item in &self.items {
            if let Item::Equation(equation) = item {
                names.push(&equation.label);
                names.extend(equation.numbers.iter().map(String::as_str));
            }
        }
        known.extend(&names);
        let numbered = names.iter().any(|name| is_number(name));
        let mut found = macros(prose, language);
        if language == Language::Markdown {
            found.extend(marked(prose));
        }
        if numbered {
            found.extend(in_words(prose));
        }
        found.retain(|(label, _)| !known.contains(label.as_str()));
        found.sort_by_key(|(_, span)| span.start);
        let problems: Vec<Problem> = found.iter().map(|(label, span)| dangling(label, span, &names)).collect();
        self.problems.extend(problems);
    }
}

fn dangling(label: &str, span: &Span, names: &[&str]) -> Problem {
    let message = format!("there is no equation `{label}`");
    let problem = Problem::warning("document::reference", message, span.clone());
    match nearest(label, names).filter(|_| !is_number(label)) {
        Some(near) => problem.label(format!("did you mean `{near}`?")),
        None => problem.label("referred to here").help("label the equation that is meant, or mend the reference"),
    }
}

/// The names of all `\label{..}` in a text.
fn labels(text: &str) -> impl Iterator<Item = &str> {
    text.match_indices(r"\label{")
        .filter_map(|(at, command)| near(text, at + command.len(), 200).split_once('}').map(|(name, _)| name))
}

/// What macros refer to.
fn macros(text: &str, language: Language) -> Vec<Reference> {
    let referring = match language {
        Language::Markdown => &REFERRING[..1],
        Language::Latex { complete: true } => &REFERRING[..],
        Language::Latex { complete: false } => &[],
    };
    let mut found = Vec::new();
    for (at, _) in text.match_indices('\\') {
        let rest = near(text, at + 1, 1000);
        let name = rest.get(..rest.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(rest.len())).unwrap_or_default();
        let behind = rest.get(name.len()..).unwrap_or_default();
        let Some(inside) = behind.trim_start_matches('*').strip_prefix('{').filter(|_| referring.contains(&name))
        else {
            continue;
        };
        let Some(list) = inside.split_once('}').map(|(list, _)| list) else {
            continue;
        };
        let start = at + 1 + rest.len() - inside.len();
        let mut offset = 0;
        for part in list.split(',') {
            let label = part.trim();
            let begin = start + offset + part.len() - part.trim_start().len();
            // A macro in a label is a parameter of a definition.
            if !label.is_empty() && !label.contains(['#', '\\']) {
                found.push((label.to_owned(), begin..begin + label.len()));
            }
            offset += part.len() + 1;
        }
    }
    found
}

/// `@eq-foo`, `@eq:foo` and `` {eq}`foo` ``.
fn marked(text: &str) -> Vec<Reference> {
    let mut found = Vec::new();
    for (at, _) in text.match_indices("@eq") {
        let before = text.get(..at).and_then(|before| before.chars().next_back());
        let name = near(text, at + 1, 200);
        let end = name.find(|c: char| !(c.is_ascii_alphanumeric() || "-_:.".contains(c))).unwrap_or(name.len());
        let name = name.get(..end).unwrap_or_default().trim_end_matches(['.', ':', '-']);
        let is_label = name.starts_with("eq-") || name.starts_with("eq:");
        if is_label && before.is_none_or(|c| !c.is_ascii_alphanumeric() && c != '\\') {
            found.push((name.to_owned(), at + 1..at + 1 + name.len()));
        }
    }
    for (at, role) in text.match_indices("{eq}`") {
        let start = at + role.len();
        let Some(name) = near(text, start, 200).split(['`', '\n']).next() else { continue };
        if !name.is_empty() && !name.contains(['<', ' ']) {
            found.push((name.to_owned(), start..start + name.len()));
        }
    }
    found
}

/// "Eq. (12)" and its like. "Eq. (12) of [3]" is another's equation.
fn in_words(text: &str) -> Vec<Reference> {
    let mut found = Vec::new();
    for (at, open) in text.match_indices(['(', '（']) {
        let start = at + open.len();
        let Some(end) = near(text, start, 20).find([')', '）']) else { continue };
        let label = text.get(start..start + end).unwrap_or_default();
        let before = text.get(..at).unwrap_or_default().trim_end_matches([' ', '~', '\u{3000}']);
        let behind = text.get(start + end..).unwrap_or_default().trim_start_matches([')', '）']);
        let named = WORDS.iter().any(|word| before.ends_with(word)) || behind.trim_start_matches(' ').starts_with('式');
        let foreign = ["of", "in", r"\cite", "[", "from"]
            .iter()
            .any(|word| behind.trim_start_matches([' ', '~']).starts_with(word));
        if named && !foreign && is_number(label) {
            found.push((label.to_owned(), start..start + label.len()));
        }
    }
    found
}

/// Whether a label is a number, perhaps with a section's before it and a letter behind.
fn is_number(label: &str) -> bool {
    let stem = label.strip_suffix(|c: char| c.is_ascii_lowercase()).unwrap_or(label);
    let number = |part: &str| !part.is_empty() && part.len() < 6 && part.bytes().all(|byte| byte.is_ascii_digit());
    stem.split('.').all(number)
}
