//! Recursive descent over the tokens.
//!
//! From weak to strong: rows, lists, marks, chains of relations, sums, products with visible operators, factors side by
//! side, scripts. [`statement`] reads down to products, [`factor`] the factors and what they are made of, [`group`] what
//! stands between delimiters.

mod factor;
mod group;
mod statement;

use super::ast::{Kind, Node, Span};
use super::error::ParseError;
use super::matching::DEEPEST;
use super::token::{Token, TokenKind};

/// Reads all tokens as one formula.
pub(super) fn parse_tokens(source: &str, tokens: Vec<Token>) -> Result<Node, ParseError> {
    let mut parser = Parser { source, tokens, pos: 0, end: 0, depth: 0 };
    let node = parser.rows()?;
    match parser.token() {
        None => Ok(node),
        Some(_) => Err(parser.unexpected("the end of the formula")),
    }
}

struct Parser<'a> {
    source: &'a str,
    tokens: Vec<Token>,
    pos: usize,
    /// Where the last token, or the part of it that was read, ended.
    end: usize,
    depth: usize,
}

impl<'a> Parser<'a> {
    fn token(&self) -> Option<&Token> {
        self.tokens.get(self.pos)
    }

    fn peek(&self) -> Option<TokenKind> {
        self.token().map(|token| token.kind)
    }

    /// Where the next token begins; the end of the source if there is none.
    fn here(&self) -> usize {
        self.token().map_or(self.source.len(), |token| token.span.start)
    }

    /// From a beginning to the end of the last token.
    fn since(&self, start: usize) -> Span {
        start..self.end.max(start)
    }

    /// Passes over the next token and gives its place.
    fn advance(&mut self) -> Span {
        let span = self.token().map_or(self.source.len()..self.source.len(), |token| token.span.clone());
        self.pos += 1;
        self.end = span.end;
        span
    }

    fn text(&self, span: &Span) -> &'a str {
        self.source.get(span.clone()).unwrap_or("")
    }

    /// The text of the next token; nothing at the end.
    fn found(&self) -> &'a str {
        self.token().map_or("", |token| self.text(&token.span))
    }

    /// Nothing, right after the last token.
    fn empty(&self) -> Node {
        let end = self.end;
        Node::new(Kind::Empty, end..end)
    }

    /// Whether nothing more stands in this group, cell, row or list item.
    fn at_end(&self) -> bool {
        match self.peek() {
            None | Some(TokenKind::Row | TokenKind::Cell | TokenKind::Comma | TokenKind::Over) => true,
            Some(kind) => kind.closes(),
        }
    }

    /// The error that something else was expected here.
    fn unexpected(&self, expected: &str) -> ParseError {
        match self.token() {
            None => {
                let end = self.source.len();
                ParseError::new(format!("expected {expected}, found the end of the formula"), end..end)
            }
            Some(token) => {
                let found = self.text(&token.span);
                ParseError::new(format!("expected {expected}, found `{found}`"), token.span.clone())
            }
        }
    }

    /// Reads something one level deeper.
    fn nested<T>(&mut self, read: impl FnOnce(&mut Self) -> Result<T, ParseError>) -> Result<T, ParseError> {
        if self.depth >= DEEPEST {
            return Err(self.unexpected(&format!("at most {DEEPEST} levels")).help("split the formula"));
        }
        self.depth += 1;
        let result = read(self);
        self.depth -= 1;
        result
    }
}
