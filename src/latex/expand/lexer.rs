//! TeX's tokens, as far as macros need them.

use super::super::ast::Span;

/// What a token is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::latex) enum Kind {
    /// `\name`
    Word,
    /// A backslash with one character that is no letter: `\,`.
    Escaped,
    /// `{`
    Open,
    /// `}`
    Close,
    /// Blanks.
    Space,
    /// `%` to the end of the line, the line break included.
    Comment,
    /// `#1`
    Parameter,
    /// Any other character.
    Char,
    /// Stands for an optional argument that is not given.
    NoValue,
    /// Stands for a mark that is given.
    True,
}

/// A token on its way through the expansion.
#[derive(Clone, Debug)]
pub(in crate::latex) struct Token<'a> {
    pub text: &'a str,
    pub kind: Kind,
    /// The bytes of the formula that it comes from.
    pub origin: Span,
    /// In how many macros' bodies it stands.
    pub depth: u16,
    /// Whether a package wrote it: then it means what LaTeX means by it, and no macro of the notes.
    pub from_package: bool,
}

impl<'a> Token<'a> {
    pub fn new(text: &'a str) -> Self {
        Token { text, kind: Kind::Char, origin: 0..0, depth: 0, from_package: false }
    }

    /// Whether it is this character.
    pub fn is(&self, c: char) -> bool {
        matches!(self.kind, Kind::Char | Kind::Open | Kind::Close)
            && self.text.starts_with(c)
            && self.text.len() == c.len_utf8()
    }
}

/// Splits a text into tokens; together they are the whole text.
pub(in crate::latex) fn lex(text: &str) -> Vec<(Kind, Span)> {
    let mut tokens = Vec::new();
    let mut at = 0;
    while let Some(c) = text.get(at..).and_then(|rest| rest.chars().next()) {
        let (kind, length) = token(text.get(at..).unwrap_or_default(), c);
        tokens.push((kind, at..at + length));
        at += length;
    }
    tokens
}

/// The token that a text begins with, and its length.
fn token(rest: &str, c: char) -> (Kind, usize) {
    let run = |keep: fn(char) -> bool| rest.find(|c| !keep(c)).unwrap_or(rest.len());
    match c {
        '\\' => {
            let after = rest.get(1..).unwrap_or_default();
            match after.find(|c: char| !c.is_ascii_alphabetic() && c != '@').unwrap_or(after.len()) {
                0 => (Kind::Escaped, 1 + after.chars().next().map_or(0, char::len_utf8)),
                letters => (Kind::Word, 1 + letters),
            }
        }
        '{' => (Kind::Open, 1),
        '}' => (Kind::Close, 1),
        '%' => (Kind::Comment, rest.find('\n').map_or(rest.len(), |end| end + 1)),
        '#' if rest.get(1..2).is_some_and(|digit| matches!(digit.as_bytes(), [b'1'..=b'9'])) => (Kind::Parameter, 2),
        _ if c.is_whitespace() => (Kind::Space, run(char::is_whitespace)),
        _ => (Kind::Char, c.len_utf8()),
    }
}
