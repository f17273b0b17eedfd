//! Reading the arguments of a macro from the tokens that follow it.

use super::super::error::ParseError;
use super::lexer::{Kind, Token};
use super::{Expander, Parameter, lexer::lex};

/// An argument as it was found.
#[derive(Clone, Debug)]
pub(in crate::latex) enum Argument<'a> {
    /// These tokens, without braces or delimiters around them.
    Given(Vec<Token<'a>>),
    /// An optional argument without a default that is not given.
    Missing,
    /// Whether a mark is given.
    Mark(bool),
}

impl<'a> Argument<'a> {
    /// What is put in the place of `#1`.
    pub fn tokens(&self) -> Vec<Token<'a>> {
        match self {
            Argument::Given(tokens) => tokens.clone(),
            Argument::Missing => vec![Token { kind: Kind::NoValue, ..Token::new("") }],
            Argument::Mark(true) => vec![Token { kind: Kind::True, ..Token::new("") }],
            Argument::Mark(false) => Vec::new(),
        }
    }

    /// The text of the tokens.
    pub fn text(&self) -> String {
        self.tokens().iter().map(|token| token.text).collect()
    }
}

impl<'a> Expander<'a> {
    /// Reads the argument for a parameter of the macro `of`.
    pub(in crate::latex) fn argument(
        &mut self,
        parameter: &'a Parameter,
        of: &Token<'a>,
    ) -> Result<Argument<'a>, ParseError> {
        match parameter {
            Parameter::Mandatory => self.mandatory(of).map(Argument::Given),
            Parameter::Mark(mark) => {
                let found = self.next_is(*mark);
                if found {
                    self.take_next();
                }
                Ok(Argument::Mark(found))
            }
            Parameter::Optional(open, close, default) => match self.delimited(*open, *close) {
                Some(tokens) => Ok(Argument::Given(tokens)),
                None => Ok(default.as_deref().map_or(Argument::Missing, |text| default_argument(text, of))),
            },
        }
    }

    /// The next token that is no blank, left where it is.
    pub(in crate::latex) fn peek(&self) -> Option<&Token<'a>> {
        self.waiting.iter().rev().find(|token| !matches!(token.kind, Kind::Space | Kind::Comment))
    }

    /// Whether this character is next, blanks aside.
    pub(in crate::latex) fn next_is(&self, c: char) -> bool {
        self.peek().is_some_and(|token| token.is(c))
    }

    /// Takes the next token that is no blank.
    pub(in crate::latex) fn take_next(&mut self) -> Option<Token<'a>> {
        while let Some(token) = self.waiting.pop() {
            if !matches!(token.kind, Kind::Space | Kind::Comment) {
                return Some(token);
            }
        }
        None
    }

    /// A token, or what stands in braces.
    pub(in crate::latex) fn mandatory(&mut self, of: &Token<'a>) -> Result<Vec<Token<'a>>, ParseError> {
        match self.peek().map(|next| next.kind) {
            Some(Kind::Open) => match self.delimited('{', '}') {
                Some(tokens) => Ok(tokens),
                None => Err(lacks(of, "the brace after it is never closed", "add a `}`")),
            },
            None | Some(Kind::Close) => Err(lacks(of, "an argument is missing", &format!("write `{}{{..}}`", of.text))),
            Some(_) => Ok(self.take_next().into_iter().collect()),
        }
    }

    /// What stands between two delimiters, if the first is next and is closed. Delimiters within braces, or within
    /// delimiters of the same kind, close nothing.
    pub(in crate::latex) fn delimited(&mut self, open: char, close: char) -> Option<Vec<Token<'a>>> {
        if !self.next_is(open) {
            return None;
        }
        let (mut depth, mut braces) = (0_usize, 0_usize);
        let end = self.waiting.iter().rposition(|token| {
            if token.is(open) && braces == 0 && (open != close || depth == 0) {
                depth += 1;
            } else if token.is(close) && braces == 0 {
                depth = depth.saturating_sub(1);
                return depth == 0;
            } else if token.kind == Kind::Open {
                braces += 1;
            } else if token.kind == Kind::Close {
                braces = braces.saturating_sub(1);
            }
            false
        });
        let Some(end) = end else {
            // What is looked for in vain takes time, too.
            self.made += self.waiting.len() / 8;
            return None;
        };
        let mut tokens = self.waiting.split_off(end);
        tokens.reverse();
        let begin = tokens.iter().position(|token| token.is(open))? + 1;
        let count = tokens.len().saturating_sub(1);
        tokens.truncate(count);
        tokens.drain(..begin);
        self.made += tokens.len();
        Some(tokens)
    }
}

/// A macro lacks something.
pub(in crate::latex) fn lacks(of: &Token, what: &str, help: &str) -> ParseError {
    ParseError::new(format!("`{}`: {what}", of.text), of.origin.clone()).help(help)
}

/// The default of an argument that is not given.
fn default_argument<'a>(text: &'a str, of: &Token<'a>) -> Argument<'a> {
    let token = |(kind, span): (Kind, super::super::ast::Span)| Token {
        text: text.get(span).unwrap_or_default(),
        kind,
        origin: of.origin.clone(),
        depth: of.depth + 1,
        from_package: of.from_package,
    };
    Argument::Given(lex(text).into_iter().map(token).collect())
}
