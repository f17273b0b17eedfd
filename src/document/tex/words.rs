//! The words of LaTeX that matter to finding equations, and arguments in braces.

use super::super::place::Span;

/// Environments that are displays by themselves, stars aside.
const DISPLAYS: [&str; 9] =
    ["equation", "align", "alignat", "flalign", "gather", "multline", "eqnarray", "displaymath", "dmath"];

/// Environments whose content is not read.
const VERBATIM: [&str; 13] = [
    "verbatim",
    "Verbatim",
    "lstlisting",
    "minted",
    "comment",
    "filecontents",
    "tikzpicture",
    "pgfpicture",
    "picture",
    "forest",
    "asy",
    "alltt",
    "BVerbatim",
];

/// Whether an environment is a display.
pub(super) fn is_display(environment: &str) -> bool {
    DISPLAYS.contains(&environment.strip_suffix('*').unwrap_or(environment))
}

/// Whether the content of an environment is not read.
pub(super) fn is_verbatim(environment: &str) -> bool {
    VERBATIM.contains(&environment.strip_suffix('*').unwrap_or(environment))
}

/// The level of a heading.
pub(super) fn heading(name: &str) -> Option<u8> {
    let names = ["part", "chapter", "section", "subsection", "subsubsection", "paragraph"];
    (1..).zip(names).find(|(_, heading)| *heading == name).map(|(level, _)| level)
}

/// The letters of the macro that a text begins with, behind its backslash.
pub(super) fn macro_name(text: &str) -> &str {
    let rest = text.strip_prefix('\\').unwrap_or_default();
    rest.get(..rest.find(|c: char| !c.is_ascii_alphabetic() && c != '@').unwrap_or(rest.len())).unwrap_or_default()
}

/// The length of a backslash with the character that it escapes.
pub(super) fn escaped(text: &str) -> usize {
    1 + text.chars().nth(1).map_or(0, char::len_utf8)
}

/// The length of the comment that a text begins with, the line break not included.
pub(super) fn comment(text: &str) -> usize {
    text.find('\n').unwrap_or(text.len())
}

/// What stands in the delimiters that stand at a place, blanks and comments before them aside; the longest is 4096 bytes.
pub(super) fn argument(text: &str, from: usize, [open, close]: [char; 2]) -> Option<Span> {
    let mut at = from;
    loop {
        let rest = text.get(at..)?;
        let blanks = rest.len() - rest.trim_start_matches([' ', '\t', '\r', '\n']).len();
        at += blanks;
        let rest = text.get(at..)?;
        if !rest.starts_with('%') {
            break;
        }
        at += comment(rest);
    }
    let inside = text.get(at..)?.strip_prefix(open)?;
    let inside = inside.get(..inside.floor_char_boundary(4096))?;
    let start = at + open.len_utf8();
    let mut depth = 0_usize;
    let mut chars = inside.char_indices();
    while let Some((offset, c)) = chars.next() {
        match c {
            '\\' => {
                chars.next();
            }
            _ if c == close && depth == 0 => return Some(start..start + offset),
            '{' => depth += 1,
            '}' => depth = depth.checked_sub(1)?,
            _ => {}
        }
    }
    None
}

/// What stands in braces at a place.
pub(super) fn group(text: &str, from: usize) -> Option<Span> {
    argument(text, from, ['{', '}'])
}

/// The TOML of the annotation in comment lines that begins at the beginning of a text, and the length of the lines. The
/// TOML has the length of the lines; the `%!` and the word `kenzan` are blank in it. `None` for the magic comments of
/// editors.
pub(super) fn annotation(text: &str) -> Option<(String, usize)> {
    let is_magic = |content: &str| {
        let content = content.trim_start_matches([' ', '\t']);
        ["TEX", "TeX", "tex", "BIB", "LW", "PS"].iter().any(|magic| content.starts_with(magic))
    };
    if text.strip_prefix("%!").is_none_or(is_magic) {
        return None;
    }
    let mut toml = String::new();
    for line in text.split_inclusive('\n') {
        let rest = line.trim_start_matches([' ', '\t']);
        let Some(content) = rest.strip_prefix("%!").filter(|content| !is_magic(content)) else { break };
        toml.extend(std::iter::repeat_n(' ', line.len() - content.len()));
        match content.trim_start().strip_prefix("kenzan") {
            Some(behind)
                if toml.trim().is_empty() && (behind.is_empty() || behind.starts_with(char::is_whitespace)) =>
            {
                toml.extend(std::iter::repeat_n(' ', content.len() - behind.len()));
                toml.push_str(behind);
            }
            _ => toml.push_str(content),
        }
    }
    let length = toml.trim_end().len();
    toml.truncate(length);
    let length = toml.len();
    Some((toml, length))
}
