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
            Parameter::Until(signs) => self.until(signs, of).map(Argument::Given),
            Parameter::Literal(_) => Ok(Argument::Mark(false)),
        }
    }

    /// Takes the tokens that have to follow the macro `of`.
    pub(in crate::latex) fn literal(&mut self, signs: &[String], of: &Token<'a>) -> Result<(), ParseError> {
        let Some(after) = self.behind(signs, self.waiting.len()) else {
            let signs = signs.concat();
            return Err(lacks(of, &format!("`{signs}` has to follow it"), &format!("write `{}{signs}`", of.text)));
        };
        self.waiting.truncate(after);
        Ok(())
    }

    /// What stands before these tokens, which are taken, too. Within braces they are sought in vain.
    fn until(&mut self, signs: &[String], of: &Token<'a>) -> Result<Vec<Token<'a>>, ParseError> {
        let (mut depth, mut at) = (0_usize, self.waiting.len());
        loop {
            if depth == 0
                && let Some(after) = self.behind(signs, at)
            {
                let mut tokens = self.waiting.split_off(at);
                self.waiting.truncate(after);
                tokens.reverse();
                self.made += tokens.len();
                return Ok(unbraced(tokens));
            }
            let next = at.checked_sub(1).and_then(|before| self.waiting.get(before));
            match next.map(|token| token.kind) {
                Some(Kind::Open) => depth += 1,
                Some(Kind::Close) if depth > 0 => depth -= 1,
                None | Some(Kind::Close) => {
                    let what = format!("its argument ends with `{}`, which is missing", signs.concat());
                    return Err(lacks(of, &what, "add it behind the argument"));
                }
                _ => {}
            }
            at -= 1;
        }
    }

    /// How many tokens wait behind these, where they are the next of the first `at` that wait, blanks aside.
    fn behind(&self, signs: &[String], at: usize) -> Option<usize> {
        let mut rest = at;
        for sign in signs {
            let is_blank = |token: &Token| matches!(token.kind, Kind::Space | Kind::Comment);
            rest = self.waiting.get(..rest)?.iter().rposition(|token| !is_blank(token))?;
            self.waiting.get(rest).filter(|token| token.text == sign)?;
        }
        Some(rest)
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

/// Tokens without the one pair of braces around all of them, as TeX takes an argument.
fn unbraced(mut tokens: Vec<Token>) -> Vec<Token> {
    let mut depth = 0_usize;
    let closed = tokens.iter().position(|token| {
        match token.kind {
            Kind::Open => depth += 1,
            Kind::Close => depth = depth.saturating_sub(1),
            _ => {}
        }
        depth == 0
    });
    if tokens.len() > 1 && closed == Some(tokens.len() - 1) && tokens[0].kind == Kind::Open {
        tokens.pop();
        tokens.remove(0);
    }
    tokens
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
