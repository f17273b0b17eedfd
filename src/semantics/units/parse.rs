//! From text to dimension: `kg m^2/s`, `J/(kg K)`, `m s⁻²`, `rad/s`, `1`.
//!
//! Factors are joined by a blank, `·`, `*` or `⋅`; a slash divides by the one factor behind it, which may be a bracket, and
//! several slashes divide by several. A factor that follows a divisor is an error, since `J/kg K` is read in two ways.

use std::ops::Range;

use super::dimension::{Dimension, SUPERSCRIPTS};
use super::table;
use crate::expr::ratio::{self, Ratio};

/// Why a unit cannot be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnitError {
    /// What was found.
    pub message: String,
    /// Where, in bytes of the text.
    pub span: Range<usize>,
    /// What to do.
    pub help: Option<String>,
}

/// The largest exponent, and its largest denominator: far beyond any that a formula has.
const LARGEST: i128 = 99;
/// How deep brackets may nest.
const DEEPEST: usize = 20;

/// Reads a unit as its dimension.
///
/// # Errors
/// An unknown unit, an exponent that is no small number, a bracket that is not closed, or a product behind a slash.
pub fn parse(text: &str) -> Result<Dimension, UnitError> {
    let mut parser = Parser { text, at: 0, depth: 0 };
    let dimension = parser.product()?;
    parser.blanks();
    if parser.at < text.len() {
        return Err(parser.error_here("an unexpected sign"));
    }
    Ok(dimension)
}

struct Parser<'t> {
    text: &'t str,
    at: usize,
    depth: usize,
}

impl Parser<'_> {
    fn peek(&self) -> Option<char> {
        self.text.get(self.at..)?.chars().next()
    }

    fn next_if(&mut self, accepted: impl Fn(char) -> bool) -> Option<char> {
        let c = self.peek().filter(|c| accepted(*c))?;
        self.at += c.len_utf8();
        Some(c)
    }

    fn blanks(&mut self) {
        while self.next_if(char::is_whitespace).is_some() {}
    }

    /// Blanks, and at most one visible sign of a product.
    fn joint(&mut self) {
        self.blanks();
        if self.next_if(|c| matches!(c, '·' | '⋅' | '*')).is_some() {
            self.blanks();
        }
    }

    fn error(&self, message: impl Into<String>, span: Range<usize>) -> UnitError {
        UnitError { message: message.into(), span, help: None }
    }

    fn error_here(&self, message: &str) -> UnitError {
        let width = self.peek().map_or(0, char::len_utf8);
        self.error(message, self.at..self.at + width)
    }

    /// Factors up to the end or a closing bracket.
    fn product(&mut self) -> Result<Dimension, UnitError> {
        self.blanks();
        let begin = self.at;
        let mut product = self.factor()?;
        let mut divided = false;
        loop {
            self.joint();
            let divides = self.next_if(|c| c == '/').is_some();
            self.blanks();
            if !divides && matches!(self.peek(), None | Some(')')) {
                return Ok(product);
            }
            let at = self.at;
            let factor = self.factor()?;
            if divided && !divides {
                let mut error = self.error("a factor behind a divisor can be read in two ways", at..self.at);
                error.help = Some("write J/(kg K), or put the divisors last as in J K/kg".into());
                return Err(error);
            }
            divided |= divides;
            let combined = if divides { product.over(&factor) } else { product.times(&factor) };
            product = combined.ok_or_else(|| self.error("the exponents are too large", begin..self.at))?;
        }
    }

    fn factor(&mut self) -> Result<Dimension, UnitError> {
        let begin = self.at;
        let base = match self.peek() {
            Some('(') => self.bracket()?,
            Some('1') => {
                self.at += 1;
                return Ok(Dimension::NONE);
            }
            _ => self.name()?,
        };
        let exponent = self.exponent()?;
        base.to_the(exponent).ok_or_else(|| self.error("the exponents are too large", begin..self.at))
    }

    fn bracket(&mut self) -> Result<Dimension, UnitError> {
        let begin = self.at;
        self.at += 1;
        self.depth += 1;
        if self.depth > DEEPEST {
            return Err(self.error("brackets nested too deep", begin..self.at));
        }
        let inner = self.product()?;
        self.depth -= 1;
        match self.next_if(|c| c == ')') {
            Some(_) => Ok(inner),
            None => Err(self.error("this bracket is not closed", begin..begin + 1)),
        }
    }

    fn name(&mut self) -> Result<Dimension, UnitError> {
        let begin = self.at;
        while self.next_if(|c| c.is_alphabetic() || matches!(c, '%' | '°')).is_some() {}
        let name = &self.text[begin..self.at];
        if name.is_empty() {
            let mut error = self.error_here("a unit is missing here");
            error.help = Some("a number has the unit 1".into());
            return Err(error);
        }
        table::dimension(name).ok_or_else(|| {
            let mut error = self.error(format!("unknown unit {name}"), begin..self.at);
            error.help = table::nearest(name).map(|near| format!("did you mean {near}?"));
            error
        })
    }

    /// `^2`, `^-2`, `^{2}`, `^(1/2)`, `²`, `2`, `-2`, or nothing for 1.
    fn exponent(&mut self) -> Result<Ratio, UnitError> {
        let begin = self.at;
        let raised: String = std::iter::from_fn(|| self.next_if(|c| SUPERSCRIPTS.contains(&c))).collect();
        if !raised.is_empty() {
            let plain = |c| SUPERSCRIPTS.iter().position(|s| *s == c).filter(|k| *k < 10);
            let digits = raised.chars().map(|c| plain(c).map_or("-".to_owned(), |k| k.to_string()));
            return self.number(&digits.collect::<String>(), begin).map(|n| (n, 1));
        }
        if self.next_if(|c| c == '^').is_none() {
            let signed = matches!(self.peek(), Some('-' | '−' | '0'..='9'));
            return if signed { self.integer().map(|n| (n, 1)) } else { Ok((1, 1)) };
        }
        let close = match self.next_if(|c| matches!(c, '(' | '{')) {
            Some('(') => ')',
            Some(_) => '}',
            None => return self.integer().map(|n| (n, 1)),
        };
        let n = self.integer()?;
        let d = if self.next_if(|c| c == '/').is_some() { self.integer()? } else { 1 };
        if self.next_if(|c| c == close).is_none() {
            return Err(self.error("this exponent is not closed", begin..self.at));
        }
        ratio::reduce(n, d).ok_or_else(|| self.error("an exponent with the denominator 0", begin..self.at))
    }

    fn integer(&mut self) -> Result<i128, UnitError> {
        let begin = self.at;
        let sign = if self.next_if(|c| matches!(c, '-' | '−')).is_some() { "-" } else { "" };
        let digits: String = std::iter::from_fn(|| self.next_if(|c| c.is_ascii_digit())).collect();
        self.number(&format!("{sign}{digits}"), begin)
    }

    fn number(&self, digits: &str, begin: usize) -> Result<i128, UnitError> {
        let number = digits.parse().ok().filter(|n| (-LARGEST..=LARGEST).contains(n));
        number.ok_or_else(|| self.error(format!("an exponent must be a whole number up to {LARGEST}"), begin..self.at))
    }
}
