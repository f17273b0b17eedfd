//! What is wrong with a formula, where, and what to do about it.

use std::fmt;

use super::ast::Span;

/// Why a formula could not be read.
#[derive(Clone, Debug, PartialEq)]
pub struct ParseError {
    /// What was expected and what was found.
    pub message: String,
    /// The bytes of the source that are at fault; empty at the end of the source where something is missing.
    pub span: Span,
    /// What the author can do.
    pub help: Option<String>,
}

impl ParseError {
    /// An error at a place, without advice.
    pub(crate) fn new(message: impl Into<String>, span: Span) -> Self {
        ParseError { message: message.into(), span, help: None }
    }

    /// The same error with advice.
    pub(crate) fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }
}

impl fmt::Display for ParseError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} (bytes {} to {})", self.message, self.span.start, self.span.end)?;
        match &self.help {
            Some(help) => write!(f, "; {help}"),
            None => Ok(()),
        }
    }
}

impl std::error::Error for ParseError {}
