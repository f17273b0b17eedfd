//! What single characters and delimiters mean.

use super::ast::{Delim, Mark, ProductOp, Rel, Sign};
use super::token::{Side, TokenKind};

/// What prints nothing: blanks, and full stops, which end sentences.
pub(super) fn is_blank(c: char) -> bool {
    c.is_whitespace() || c == '~' || c == '.' || c == '。' || c == '\u{200b}' || c == '\u{feff}'
}

/// The length of a gap followed by exactly three digits.
pub(super) fn group_of_three(rest: &str, gap: &str) -> Option<usize> {
    let digits = rest.strip_prefix(gap)?.bytes().take_while(u8::is_ascii_digit).count();
    (digits == 3).then_some(gap.len() + 3)
}

/// The delimiter at the beginning of a text, with its length.
pub(super) fn delimiter(rest: &str) -> Option<(Delim, usize)> {
    let length = match rest.strip_prefix('\\') {
        None => rest.chars().next()?.len_utf8(),
        Some(name) => match name.bytes().take_while(u8::is_ascii_alphabetic).count() {
            0 => 1 + name.chars().next()?.len_utf8(),
            letters => 1 + letters,
        },
    };
    let delim = match &rest[..length] {
        "." => Delim::None,
        "(" | ")" | "\\lparen" | "\\rparen" => Delim::Paren,
        "[" | "]" | "\\lbrack" | "\\rbrack" => Delim::Bracket,
        "\\{" | "\\}" | "\\lbrace" | "\\rbrace" => Delim::Brace,
        "|" | "\\vert" | "\\lvert" | "\\rvert" => Delim::Bar,
        "\\|" | "\\Vert" | "\\lVert" | "\\rVert" => Delim::DoubleBar,
        "<" | ">" | "\\langle" | "\\rangle" => Delim::Angle,
        "\\lfloor" | "\\rfloor" => Delim::Floor,
        "\\lceil" | "\\rceil" => Delim::Ceil,
        _ => return None,
    };
    Some((delim, length))
}

/// The token that a single character is.
pub(super) fn character(c: char) -> Option<TokenKind> {
    Some(match c {
        '&' => TokenKind::Cell,
        '^' => TokenKind::Sup,
        '_' => TokenKind::Sub,
        '{' => TokenKind::BraceOpen,
        '}' => TokenKind::BraceClose,
        '\'' | '′' | '’' => TokenKind::Prime,
        '!' => TokenKind::Bang,
        ',' | ';' | '，' | '、' | '；' => TokenKind::Comma,
        '+' | '＋' => TokenKind::Sign(Sign::Plus),
        '-' | '−' | '－' => TokenKind::Sign(Sign::Minus),
        '±' => TokenKind::Sign(Sign::PlusMinus),
        '*' | '·' | '⋅' | '∗' => TokenKind::Times(ProductOp::Dot),
        '×' => TokenKind::Times(ProductOp::Cross),
        '/' | '÷' => TokenKind::Times(ProductOp::Slash),
        '=' | '＝' => TokenKind::Relation(Rel::Eq),
        '<' => TokenKind::Relation(Rel::Lt),
        '>' => TokenKind::Relation(Rel::Gt),
        ':' | '：' => TokenKind::Relation(Rel::Ratio),
        '≡' => TokenKind::Relation(Rel::Equiv),
        '≠' => TokenKind::Relation(Rel::Ne),
        '≤' | '≦' => TokenKind::Relation(Rel::Le),
        '≥' | '≧' => TokenKind::Relation(Rel::Ge),
        '≈' | '≃' | '≒' => TokenKind::Relation(Rel::Approx),
        '→' => TokenKind::Relation(Rel::To),
        '⇒' => TokenKind::Relation(Rel::Implies),
        '∈' => TokenKind::Relation(Rel::In),
        '(' | '（' => TokenKind::Open(Delim::Paren),
        ')' | '）' => TokenKind::Close(Delim::Paren),
        '[' => TokenKind::Open(Delim::Bracket),
        ']' => TokenKind::Close(Delim::Bracket),
        '⟨' => TokenKind::Open(Delim::Angle),
        '⟩' => TokenKind::Close(Delim::Angle),
        '|' => TokenKind::Bar { delim: Delim::Bar, side: Side::Either, sized: false },
        '‖' => TokenKind::Bar { delim: Delim::DoubleBar, side: Side::Either, sized: false },
        '…' | '⋯' => TokenKind::Ellipsis,
        '∴' => TokenKind::Mark(Mark::Therefore),
        '∵' => TokenKind::Mark(Mark::Because),
        '∂' | '∇' | '∞' | '°' | '?' | '@' | '"' | '`' => TokenKind::Symbol,
        _ => return None,
    })
}

/// Kana, kanji and the punctuation that stands among them.
pub(super) fn is_japanese(c: char) -> bool {
    matches!(c,
        '\u{3003}'..='\u{30ff}' | '\u{3400}'..='\u{4dbf}' | '\u{4e00}'..='\u{9fff}' | '\u{f900}'..='\u{faff}' | '\u{ff66}'..='\u{ff9f}')
        && !matches!(c, '\u{3000}' | '、' | '。')
}

/// What stands in the braces of `\text{..}`; all of a text that is not in braces.
pub(super) fn words(text: &str) -> &str {
    let inner = text.split_once('{').and_then(|(_, rest)| rest.strip_suffix('}'));
    inner.filter(|_| text.starts_with('\\')).unwrap_or(text)
}
