//! What stands between braces, brackets and in environments.

use super::{Parser, TokenKind};
use crate::latex::ast::{Delim, Kind, MatrixEnv, Node};
use crate::latex::error::ParseError;
use crate::latex::token::Environment;

impl Parser<'_> {
    /// `{..}`: its body; braces print nothing.
    pub(super) fn braces(&mut self) -> Result<Node, ParseError> {
        self.advance();
        let body = self.stacked_body()?;
        self.expect(TokenKind::BraceClose, "`}`")?;
        Ok(body)
    }

    /// A body, or the rows of `\substack`, which are a list.
    fn stacked_body(&mut self) -> Result<Node, ParseError> {
        let start = self.here();
        let first = self.body()?;
        if self.peek() != Some(TokenKind::Row) {
            return Ok(first);
        }
        let mut items = vec![first];
        while self.peek() == Some(TokenKind::Row) {
            self.advance();
            items.push(self.body()?);
        }
        Ok(Node::new(Kind::List(items), self.since(start)))
    }

    /// `(..)`, `|..|` and the like.
    pub(super) fn brackets(&mut self) -> Result<Node, ParseError> {
        let Some(TokenKind::Open(open)) = self.peek() else { return Err(self.unexpected("a bracket")) };
        let start = self.advance().start;
        let body = Box::new(self.body()?);
        let close = self.close_bracket()?;
        Ok(Node::new(Kind::Group { open, close, body }, self.since(start)))
    }

    pub(super) fn close_bracket(&mut self) -> Result<Delim, ParseError> {
        let Some(TokenKind::Close(close)) = self.peek() else { return Err(self.unexpected("a closing bracket")) };
        self.advance();
        Ok(close)
    }

    /// `\left(..\right)`
    pub(super) fn stretched(&mut self) -> Result<Node, ParseError> {
        let Some(TokenKind::Left(open)) = self.peek() else { return Err(self.unexpected("`\\left`")) };
        let start = self.advance().start;
        let body = Box::new(self.body()?);
        let Some(TokenKind::Right(close)) = self.peek() else { return Err(self.unexpected("`\\right`")) };
        self.advance();
        Ok(Node::new(Kind::Group { open, close, body }, self.since(start)))
    }

    /// `\begin{..} .. \end{..}`
    pub(super) fn environment(&mut self, environment: Environment) -> Result<Node, ParseError> {
        let start = self.advance().start;
        let node = match environment {
            Environment::Rows => self.rows()?,
            Environment::Matrix(env) => {
                let rows = self.cells(env)?;
                Node::new(Kind::Matrix { env, rows }, start..start)
            }
        };
        self.expect(TokenKind::End(environment), "`\\end`")?;
        match environment {
            Environment::Rows => Ok(node),
            Environment::Matrix(_) => Ok(Node { span: self.since(start), ..node }),
        }
    }

    /// Rows of cells; an empty row at the end is the trace of a superfluous `\\`.
    fn cells(&mut self, _env: MatrixEnv) -> Result<Vec<Vec<Node>>, ParseError> {
        let mut rows = vec![Vec::new()];
        loop {
            let cell = self.body()?;
            if let Some(row) = rows.last_mut() {
                row.push(cell);
            }
            match self.peek() {
                Some(TokenKind::Cell) => {
                    self.advance();
                }
                Some(TokenKind::Row) => {
                    self.advance();
                    rows.push(Vec::new());
                }
                _ => break,
            }
        }
        if rows.last().is_some_and(|row| row.iter().all(|cell| cell.kind == Kind::Empty) && row.len() < 2) {
            rows.pop();
        }
        Ok(rows)
    }

    fn expect(&mut self, kind: TokenKind, name: &str) -> Result<(), ParseError> {
        if self.peek() == Some(kind) {
            self.advance();
            return Ok(());
        }
        Err(self.unexpected(name))
    }
}
