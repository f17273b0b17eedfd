//! Sentences that other floors compose in English, in Japanese: what the checker says of an equation, what stands in its
//! way, edits, and what scenes are. What has no translation here stays in English; `tests/japanese.rs` looks for such.

mod dimensions;
mod documents;
mod edits;
mod latex;
mod scenes;
mod understanding;
mod verdicts;

use super::with;
use std::borrow::Cow;
use std::fmt::Display;

/// Patterns with places, and what they say; of all tables the first that fits is taken. What stands in the places of these
/// names is said in Japanese, too:
///
/// | name | holds |
/// |---|---|
/// | `why`, `help`, `edit`, `rule`, `stage`, `what`, `sign` | a sentence or a part of one |
/// | `shape`, `other` | what a value is |
/// | `things`, `choices` | several, with `and` or `or` between them |
/// | `places`, `enclosure` | what numbers are, or what they lie in |
const TABLES: [&[(&str, &str)]; 7] = [
    documents::PATTERNS,
    edits::PATTERNS,
    dimensions::PATTERNS,
    verdicts::PATTERNS,
    understanding::PATTERNS,
    latex::PATTERNS,
    scenes::PATTERNS,
];

/// How a sentence goes on with another that says what to do, or more: the sign between them, that at the end, and both in
/// Japanese. The first two come before patterns, whose last place would take them in.
const JOINTS: [(&str, &str, &str); 4] =
    [(" (", ")", " ({b})"), (". ", "", "。{b}"), ("; ", "", "。{b}"), (": ", "", ": {b}")];

/// The deepest that sentences are taken apart, and the most places at which one is: notes may look like sentences.
const DEEPEST: usize = 5;
const MOST: usize = 3;

/// The sentence in Japanese, or as it is.
pub(super) fn japanese(english: &str) -> Cow<'_, str> {
    translated(english, DEEPEST).map_or(english.into(), Cow::from)
}

/// A problem of a document, place first, in Japanese: `notes.md:12:5: ...`.
pub(super) fn problem(english: &str) -> Cow<'_, str> {
    let Some((place, said)) = english.split_once(": ") else { return english.into() };
    translated(said, DEEPEST).map_or(english.into(), |said| format!("{place}: {said}").into())
}

fn translated(english: &str, depth: usize) -> Option<String> {
    let depth = depth.checked_sub(1)?;
    let (before, after) = JOINTS.split_at(2);
    with_piece(english, depth)
        .or_else(|| joined(english, before, depth))
        .or_else(|| fitting(english, depth))
        .or_else(|| joined(english, after, depth))
}

/// The translation of the first pattern that fits.
fn fitting(english: &str, depth: usize) -> Option<String> {
    let mut patterns = TABLES.iter().flat_map(|table| table.iter());
    patterns.find_map(|(pattern, japanese)| Some(filled(&places(pattern, english)?, japanese, depth)))
}

/// A pattern's translation with what stands in its places.
fn filled(found: &[(&'static str, &str)], japanese: &str, depth: usize) -> String {
    let said: Vec<(&str, Cow<'_, str>)> = found.iter().map(|(name, text)| (*name, said(name, text, depth))).collect();
    let said: Vec<(&str, &dyn Display)> = said.iter().map(|(name, text)| (*name, text as &dyn Display)).collect();
    with(japanese, &said)
}

fn said<'t>(name: &str, text: &'t str, depth: usize) -> Cow<'t, str> {
    let each = |separator: &str, joint: &str| {
        let parts = text.split(separator).map(|part| translated(part, depth).unwrap_or_else(|| part.to_owned()));
        parts.collect::<Vec<_>>().join(joint).into()
    };
    match name {
        "why" | "help" | "edit" | "rule" | "stage" | "what" | "sign" | "shape" | "other" => {
            translated(text, depth).map_or(text.into(), Cow::from)
        }
        "things" => each(" and ", "と"),
        "choices" => each(" or ", " または "),
        "places" | "enclosure" => numbers(text).into(),
        _ => text.into(),
    }
}

/// What numbers are, or what they lie in, in signs.
fn numbers(text: &str) -> String {
    let signs = [
        (" lies in [", " ∈ ["),
        ("lies in [", "∈ ["),
        (" is ", " = "),
        (" or ", " または "),
        (" component (inertial)", " 成分 (慣性系)"),
        (" component", " 成分"),
    ];
    let text = text.strip_prefix("is ").map_or(text.to_owned(), |value| format!("= {value}"));
    signs.iter().fold(text, |text, (english, sign)| text.replace(english, sign))
}

/// A sentence followed by the LaTeX that it is about: `undeclared symbol k, at `k_0``.
fn with_piece(english: &str, depth: usize) -> Option<String> {
    let (before, piece) = english.split_once(", at `")?;
    let end = piece.rfind('`')?;
    let help = &piece[end + 1..];
    let help = match help.strip_prefix(" (").and_then(|h| h.strip_suffix(')')) {
        Some(help) => format!(" ({})", translated(help, depth)?),
        None if help.is_empty() => String::new(),
        None => return None,
    };
    Some(format!("{} (`{}`){help}", translated(before, depth)?, &piece[..end]))
}

/// Two sentences in one, both of which are known.
fn joined(english: &str, joints: &[(&str, &str, &str)], depth: usize) -> Option<String> {
    for (separator, end, joint) in joints {
        let Some(whole) = english.strip_suffix(end) else { continue };
        // The last joint first: what goes before it may have joints of its own.
        for (at, _) in whole.rmatch_indices(separator).take(MOST) {
            let Some(after) = translated(&whole[at + separator.len()..], depth) else { continue };
            if let Some(before) = translated(&whole[..at], depth) {
                return Some(before + &with(joint, &[("b", &after)]));
            }
        }
    }
    None
}

/// What stands in the places of a pattern, where the text fits it.
fn places<'t>(pattern: &'static str, text: &'t str) -> Option<Vec<(&'static str, &'t str)>> {
    let mut pieces = pattern.split('{');
    let mut before = pieces.next()?;
    let mut rest = text.strip_prefix(before)?;
    let mut found = Vec::new();
    for piece in pieces {
        let (name, literal) = piece.split_once('}')?;
        let end = if literal.is_empty() { rest.len() } else { rest.find(literal)? };
        // What is quoted ends where its quotation does.
        let quoted = ['`', '$'].into_iter().find(|q| before.ends_with(*q) && literal.starts_with(*q));
        if quoted.is_some_and(|quote| rest[..end].contains(quote)) {
            return None;
        }
        // A number is one word; what follows it belongs to another sentence.
        if matches!(name, "n" | "m") && rest[..end].contains("; ") {
            return None;
        }
        found.push((name, &rest[..end]));
        (before, rest) = (literal, &rest[end + literal.len()..]);
    }
    rest.is_empty().then_some(found)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashSet;

    #[test]
    fn sentences_are_translated() {
        for (english, expected) in [
            ("a matrix of 2 × 3 numbers", "2 行 3 列の行列"),
            ("the symbol $y$ is not declared", "記号 $y$ が宣言されていません"),
            (
                "it does not follow from what stands before it; with one edit it would follow from (3): the sign of `a` flipped",
                "前の式からは導かれません。一箇所書き換えると (3) から導かれます: `a` の符号を反転",
            ),
            (
                "cannot add a column of 3 to a vector, at `a + b` (check the brackets and the indices, and whether every vector is declared as one)",
                "ベクトルに3 成分の列ベクトルを足せません (`a + b`) (括弧と添字、ベクトルがすべてベクトルとして宣言されているかを確かめてください)",
            ),
            ("`a` doubled; `b` squared throughout", "`a` を 2 倍に。`b` を 2 乗に (全体で)"),
            (
                "an elliptic function and a power with a variable exponent has no meaning in a prime field",
                "楕円関数と指数が変数のべきは素体では意味をもちません",
            ),
            (
                "at x = 1, y lies in [1, 2] the difference is 2, in fractions",
                "x = 1, y ∈ [1, 2] のとき、両辺の差 = 2 (分数による計算)",
            ),
            (
                "the term $a$ has the dimension m, the others s; a factor $g$ or $h$ would mend it",
                "項 $a$ の次元は m、他の項の次元は s です。係数 $g$ または $h$ を掛ければ合います",
            ),
            ("nobody has seen this", "nobody has seen this"),
            ("a vector of length 1 and more", "a vector of length 1 and more"),
        ] {
            assert_eq!(japanese(english), expected);
        }
    }

    #[test]
    fn problems_keep_their_place() {
        assert_eq!(
            problem("notes.md:8:1: an annotation has no key `givn`: did you mean `given`?"),
            "notes.md:8:1: 注釈に `givn` というキーはありません: `given` の間違いではありませんか"
        );
        assert_eq!(problem("no place"), "no place");
    }

    #[test]
    fn what_is_quoted_is_no_pattern() {
        assert_eq!(japanese("the symbol {s} {t} is not declared"), "記号 {s} {t} が宣言されていません");
    }

    /// A sentence that looks like many joined ones ends soon.
    #[test]
    fn hostile_sentences_end() {
        for part in ["; ", ". ", " (", "it does not follow from what stands before it; ", ", at `"] {
            let hostile = part.repeat(5_000);
            assert!(!japanese(&hostile).is_empty());
        }
    }

    #[test]
    fn translations_have_the_places_of_their_patterns() {
        let names = |text: &str| {
            let names = text.split('{').skip(1).filter_map(|p| Some(p.split_once('}')?.0.to_owned()));
            names.collect::<HashSet<_>>()
        };
        let mut seen = HashSet::new();
        for &(english, japanese) in TABLES.iter().flat_map(|table| table.iter()) {
            assert_eq!(names(english), names(japanese), "{english}");
            assert!(seen.insert(english), "twice: {english}");
        }
    }
}
