//! The canonical spelling of symbols, by which declarations and uses find each other.

use crate::latex::ast::{Accent, Delim, Font, Kind, Node};

/// The canonical LaTeX of a symbol: `\boldsymbol\omega` and `\mathbf{\omega}` are spelt alike, subscripts are always
/// in braces, primes stand before them. Nodes that are no part of a name give an empty string.
pub fn spelling(node: &Node) -> String {
    spelling_with(node, &|_| None)
}

/// As [`spelling`], with some leaves spelt otherwise (indices as `#`).
pub fn spelling_with(node: &Node, leaf: &dyn Fn(&Node) -> Option<String>) -> String {
    if let Some(text) = leaf(node) {
        return text;
    }
    match &node.kind {
        Kind::Symbol(s) => s.clone(),
        Kind::Number(n) => n.clone(),
        Kind::Function(name) => format!("\\operatorname{{{name}}}"),
        Kind::Text(t) => format!("\\text{{{t}}}"),
        Kind::Styled(font, body) => format!("{}{{{}}}", font_macro(*font), spelling_with(body, leaf)),
        Kind::Accent(accent, body) => format!("{}{{{}}}", accent_macro(*accent), spelling_with(body, leaf)),
        Kind::Dots(n, body) => format!("\\{}ot{{{}}}", "d".repeat(usize::from(*n)), spelling_with(body, leaf)),
        Kind::Scripts { base, primes, sub, sup } => {
            let mut text = spelling_with(base, leaf);
            text.push_str(&"'".repeat(usize::from(*primes)));
            if let Some(sub) = sub {
                text.push_str(&format!("_{{{}}}", spelling_with(sub, leaf)));
            }
            if let Some(sup) = sup {
                text.push_str(&format!("^{{{}}}", spelling_with(sup, leaf)));
            }
            text
        }
        Kind::Juxt(factors) => joined(factors, "", leaf),
        Kind::List(items) => joined(items, ",", leaf),
        Kind::Group { open: Delim::Angle, body, .. } => match spelling_with(body, leaf) {
            body if body.is_empty() => body,
            body => format!("\\langle {body}\\rangle"),
        },
        Kind::Group { open: Delim::Paren, body, .. } => format!("({})", spelling_with(body, leaf)),
        _ => String::new(),
    }
}

/// The spellings one after another, with a blank where a macro would swallow the letter behind it.
fn joined(nodes: &[Node], separator: &str, leaf: &dyn Fn(&Node) -> Option<String>) -> String {
    let mut text = String::new();
    for (i, node) in nodes.iter().enumerate() {
        if i > 0 {
            text.push_str(separator);
        }
        let next = spelling_with(node, leaf);
        if next.is_empty() {
            return next; // Something that is no part of a name: the whole is none.
        }
        let macro_at_end = text.rsplit('\\').next().is_some_and(|tail| {
            tail.len() < text.len() && !tail.is_empty() && tail.bytes().all(|b| b.is_ascii_alphabetic())
        });
        if macro_at_end && next.starts_with(|c: char| c.is_ascii_alphabetic()) {
            text.push(' ');
        }
        text.push_str(&next);
    }
    text
}

fn font_macro(font: Font) -> &'static str {
    match font {
        Font::Bold => "\\mathbf",
        Font::Calligraphic => "\\mathcal",
        Font::Roman => "\\mathrm",
        Font::Italic => "\\mathit",
        Font::Blackboard => "\\mathbb",
        Font::Fraktur => "\\mathfrak",
        Font::SansSerif => "\\mathsf",
        Font::Typewriter => "\\mathtt",
    }
}

fn accent_macro(accent: Accent) -> &'static str {
    match accent {
        Accent::Vector => "\\vec",
        Accent::Hat => "\\hat",
        Accent::Bar => "\\bar",
        Accent::Tilde => "\\tilde",
        Accent::Other => "\\check",
    }
}

/// The name among `candidates` nearest to `name`, if one is near enough to be meant.
pub fn nearest<'a>(name: &str, candidates: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    let plain = |s: &str| s.replace(['\\', '{', '}'], "");
    let wanted = plain(name);
    candidates
        .map(|c| (distance(&wanted, &plain(c)), c))
        // A name that shares no letter with the other is no slip of the pen: q for a.
        .filter(|(d, c)| *d <= 1 + c.chars().count() / 4 && *d < plain(c).chars().count().max(wanted.chars().count()))
        .min_by_key(|(d, _)| *d)
        .map(|(_, c)| c)
}

/// Levenshtein's distance in characters, where a common first letter of a macro's name counts as near (`\kappa`, `k`).
fn distance(a: &str, b: &str) -> usize {
    let (a, b): (Vec<char>, Vec<char>) = (a.chars().collect(), b.chars().collect());
    if b.len() == 1 && a.first() == b.first() {
        return 1;
    }
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, ca) in a.iter().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, cb) in b.iter().enumerate() {
            let cost = diagonal + usize::from(ca != cb);
            diagonal = row[j + 1];
            row[j + 1] = cost.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[b.len()]
}
