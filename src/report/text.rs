//! Words and numbers that every report shares.

use crate::check::verdict::{Judgement, Verdict};

/// A verdict's name, which is its name in `report.json` and its CSS class, too.
pub(super) fn word(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Holds => "holds",
        Verdict::Asymptotic => "asymptotic",
        Verdict::Definition => "definition",
        Verdict::Statement => "statement",
        Verdict::Fails => "fails",
        Verdict::Undecided => "undecided",
        Verdict::Unreadable => "unreadable",
    }
}

/// A sign for a verdict, so that nobody depends on its colour.
pub(super) fn symbol(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Holds => "✓",
        Verdict::Asymptotic => "≈",
        Verdict::Definition => "≔",
        Verdict::Statement => "–",
        Verdict::Fails => "✗",
        Verdict::Undecided => "?",
        Verdict::Unreadable => "!",
    }
}

/// Why an equation has its verdict: its own reason, or else that of the first link that has the equation's verdict.
pub(super) fn reason(judgement: &Judgement) -> Option<&str> {
    let deciding = || judgement.links.iter().find(|link| link.verdict == judgement.verdict)?.reason.as_deref();
    judgement.reason.as_deref().or_else(deciding)
}

/// A number with `digits` significant digits: `0.125`, `3.1×10⁻¹⁷`.
pub(super) fn number(value: f64, digits: usize) -> String {
    if value == 0.0 || !value.is_finite() {
        return value.to_string();
    }
    let places = digits.saturating_sub(1);
    let scientific = format!("{value:.places$e}");
    let Some((mantissa, Ok(exponent))) = scientific.split_once('e').map(|(m, e)| (m, e.parse::<i32>())) else {
        return scientific;
    };
    match exponent {
        -3..=4 => format!("{value:.*}", usize::try_from(places as i32 - exponent).unwrap_or(0)),
        _ => format!("{mantissa}×10{}", superscript(exponent)),
    }
}

/// An integer in superscript digits.
pub(super) fn superscript(n: i32) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let raise = |c: char| c.to_digit(10).and_then(|d| DIGITS.get(d as usize).copied()).unwrap_or('⁻');
    n.to_string().chars().map(raise).collect()
}

/// A time: `118 µs`, `2.4 ms`, `31 s`.
pub(super) fn duration(micros: u64) -> String {
    let seconds = micros as f64 / 1e6;
    match micros {
        0..1_000 => format!("{micros} µs"),
        1_000..1_000_000 => format!("{} ms", number(seconds * 1e3, 3)),
        _ => format!("{} s", number(seconds, 3)),
    }
}

/// The language that a text is marked up with: Japanese where it has kana or Han characters.
pub(super) fn language(text: &str) -> Option<&'static str> {
    let japanese = |c: char| matches!(c, '\u{3040}'..='\u{30ff}' | '\u{3400}'..='\u{9fff}' | '\u{f900}'..='\u{faff}');
    text.chars().any(japanese).then_some("ja")
}

/// A text filled up with spaces to so many columns; letters of Chinese and Japanese take two.
pub(super) fn padded(text: &str, columns: usize) -> String {
    let taken: usize = text.chars().map(columns_of).sum();
    format!("{text}{}", " ".repeat(columns.saturating_sub(taken)))
}

/// The same, with the spaces before it.
pub(super) fn padded_left(text: &str, columns: usize) -> String {
    let taken: usize = text.chars().map(columns_of).sum();
    format!("{}{text}", " ".repeat(columns.saturating_sub(taken)))
}

/// How many columns a letter takes.
pub(super) fn columns_of(letter: char) -> usize {
    if letter < '\u{1100}' || matches!(letter, '\u{2000}'..='\u{2e7f}') { 1 } else { 2 }
}

/// Escapes a text for HTML, attribute values included.
pub(super) fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\'' => escaped.push_str("&#39;"),
            _ => escaped.push(c),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_right() {
        for (value, digits, text) in [
            (0.125, 3, "0.125"),
            (0.00123456, 3, "0.00123"),
            (3.14159e-17, 2, "3.1×10⁻¹⁷"),
            (-6.02214e23, 4, "-6.022×10²³"),
            (12345.678, 3, "12346"),
            (9.9996, 4, "10.00"),
            (0.0, 3, "0"),
            (f64::NAN, 3, "NaN"),
        ] {
            assert_eq!(number(value, digits), text);
        }
    }

    #[test]
    fn times_have_fitting_units() {
        assert_eq!(
            [0, 118, 2_400, 999_999, 31_000_000].map(duration),
            ["0 µs", "118 µs", "2.40 ms", "1000 ms", "31.0 s"].map(String::from)
        );
    }
}
