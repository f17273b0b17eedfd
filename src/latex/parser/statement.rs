//! Rows, lists, marks, chains, sums and products.

use super::{Parser, TokenKind};
use crate::latex::ast::{Kind, Link, Node, ProductOp, Sign, Term};
use crate::latex::error::ParseError;

impl Parser<'_> {
    /// Rows until the end of the environment or the source; a single row is just that row.
    pub(super) fn rows(&mut self) -> Result<Node, ParseError> {
        let mut rows: Vec<Node> = Vec::new();
        let mut span = self.empty().span;
        loop {
            let printed = !matches!(self.peek(), None | Some(TokenKind::Row | TokenKind::End(_)));
            if printed {
                let start = if rows.is_empty() { self.here() } else { span.start };
                rows.push(self.body()?);
                span = self.since(start);
            }
            if self.peek() != Some(TokenKind::Row) {
                break;
            }
            self.advance();
        }
        match (rows.pop(), rows.is_empty()) {
            (None, _) => Ok(Node::new(Kind::Empty, span)),
            (Some(row), true) => Ok(row),
            (Some(last), false) => {
                rows.push(last);
                Ok(Node::new(Kind::Rows(rows), span))
            }
        }
    }

    /// What stands in a group, a cell or a row: a list, or a fraction `a \over b`.
    pub(super) fn body(&mut self) -> Result<Node, ParseError> {
        let start = self.here();
        let above = self.list()?;
        if self.peek() != Some(TokenKind::Over) {
            return Ok(above);
        }
        self.advance();
        // Nothing below stands right after `\over`, not at the cell or row that comes next.
        let nothing = self.at_end() && self.peek() != Some(TokenKind::Comma);
        let below = if nothing { self.empty() } else { self.list()? };
        if self.peek() == Some(TokenKind::Over) {
            return Err(self.unexpected("the end of the fraction").help("put each `\\over` in braces of its own"));
        }
        Ok(Node::new(Kind::Frac(Box::new(above), Box::new(below)), self.since(start)))
    }

    /// Statements separated by commas; a comma at the end separates nothing.
    pub(super) fn list(&mut self) -> Result<Node, ParseError> {
        let start = self.here();
        let mut items = vec![self.marked()?];
        let mut span = self.since(start);
        loop {
            match self.peek() {
                Some(TokenKind::Comma) => {
                    self.advance();
                    if self.at_end() && self.peek() != Some(TokenKind::Comma) {
                        if items.last().is_some_and(|item| item.kind == Kind::Empty) {
                            span = self.since(start);
                        }
                        break;
                    }
                }
                Some(TokenKind::Mark(_)) => {}
                _ => break,
            }
            items.push(self.marked()?);
            span = self.since(start);
        }
        match (items.pop(), items.is_empty()) {
            (Some(only), true) => Ok(only),
            (last, _) => {
                items.extend(last);
                Ok(Node::new(Kind::List(items), span))
            }
        }
    }

    /// A statement, perhaps after `\therefore` or `\because`.
    fn marked(&mut self) -> Result<Node, ParseError> {
        let Some(TokenKind::Mark(mark)) = self.peek() else { return self.chain() };
        let start = self.advance().start;
        let statement = if self.at_end() { self.empty() } else { self.nested(Self::marked)? };
        Ok(Node::new(Kind::Marked(mark, Box::new(statement)), self.since(start)))
    }

    /// Sides and relations in turn.
    fn chain(&mut self) -> Result<Node, ParseError> {
        let start = self.here();
        if self.at_end() {
            // Nothing before a comma stands at the comma, nothing in a group at its opening.
            let closed = self.peek().is_none_or(TokenKind::closes);
            return Ok(if closed { self.empty() } else { Node::new(Kind::Empty, start..start) });
        }
        if let Some(operator) = self.lone_operator() {
            return Ok(operator);
        }
        let first = match self.peek() {
            Some(TokenKind::Relation(_)) => None,
            _ => Some(Box::new(self.sum()?)),
        };
        let mut links = Vec::new();
        while let Some(TokenKind::Relation(rel)) = self.peek() {
            let rel_span = self.advance();
            let nothing = self.at_end() || matches!(self.peek(), Some(TokenKind::Relation(_) | TokenKind::Mark(_)));
            let rhs = if nothing { self.empty() } else { self.sum()? };
            links.push(Link { rel, rel_span, rhs });
        }
        match (first, links.is_empty()) {
            (Some(side), true) => Ok(*side),
            (first, _) => Ok(Node::new(Kind::Chain { first, links }, self.since(start))),
        }
    }

    /// An operator that stands alone, as in `F^*` or `x_{\pm}`, is a symbol.
    fn lone_operator(&mut self) -> Option<Node> {
        let Some(TokenKind::Sign(_) | TokenKind::Times(_)) = self.peek() else { return None };
        self.pos += 1;
        let alone = self.at_end();
        self.pos -= 1;
        alone.then(|| self.symbol())
    }

    /// Terms with their signs.
    fn sum(&mut self) -> Result<Node, ParseError> {
        let start = self.here();
        let mut terms = Vec::new();
        loop {
            let (sign, sign_span) = match self.peek() {
                Some(TokenKind::Sign(sign)) => (sign, Some(self.advance())),
                _ if terms.is_empty() => (Sign::Plus, None),
                _ => break,
            };
            let node = if sign_span.is_some() && self.missing_is_allowed() { self.empty() } else { self.product()? };
            terms.push(Term { sign, sign_span, node });
        }
        match (terms.pop(), terms.is_empty()) {
            (Some(Term { sign_span: None, node, .. }), true) => Ok(node),
            (last, _) => {
                terms.extend(last);
                Ok(Node::new(Kind::Sum(terms), self.since(start)))
            }
        }
    }

    /// After an operator, whether its operand may lack: at the end of a group, as in `x_{0+}`.
    fn missing_is_allowed(&self) -> bool {
        self.peek().is_some_and(TokenKind::closes) || self.peek() == Some(TokenKind::Comma)
    }

    /// Factors joined by visible operators.
    fn product(&mut self) -> Result<Node, ParseError> {
        let start = self.here();
        let first = match self.peek() {
            Some(TokenKind::Times(_)) => Node::new(Kind::Empty, start..start),
            _ => self.signed_factors()?,
        };
        let mut rest: Vec<(ProductOp, Node)> = Vec::new();
        while let Some(TokenKind::Times(op)) = self.peek() {
            self.advance();
            let factor = if self.missing_is_allowed() { self.empty() } else { self.signed_factors()? };
            rest.push((op, factor));
        }
        if rest.is_empty() {
            return Ok(first);
        }
        Ok(Node::new(Kind::Product { first: Box::new(first), rest }, self.since(start)))
    }

    /// Factors side by side, perhaps with a sign of their own after another operator: `a \times -b`.
    fn signed_factors(&mut self) -> Result<Node, ParseError> {
        let Some(TokenKind::Sign(sign)) = self.peek() else { return self.juxtaposition() };
        let sign_span = self.advance();
        let start = sign_span.start;
        let node = self.nested(Self::signed_factors)?;
        let term = Term { sign, sign_span: Some(sign_span), node };
        Ok(Node::new(Kind::Sum(vec![term]), self.since(start)))
    }
}
