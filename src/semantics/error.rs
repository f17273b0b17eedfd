//! Why an equation could not be understood.

use crate::latex::ast::Span;

/// What sort of obstacle an [`Error`] is: it decides between `fails`, `undecided` and `unreadable`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ErrorKind {
    /// The shapes do not meet, as in the sum of a vector and a scalar.
    Shape,
    /// Something is not declared.
    Undeclared,
    /// Kenzan does not know the construction.
    Unsupported,
    /// It is too large, or takes too long.
    Limit,
}

/// An obstacle with its place in the parsed LaTeX.
#[derive(Clone, Debug, PartialEq)]
pub struct Error {
    /// What sort of obstacle.
    pub kind: ErrorKind,
    /// What was expected and what was found.
    pub message: String,
    /// Where, in bytes of the LaTeX that was parsed.
    pub span: Span,
    /// What to do.
    pub help: Option<String>,
    /// The canonical spelling of the symbol that is not declared, where one is what is lacking.
    pub missing: Option<String>,
}

impl Error {
    /// Shapes that do not meet.
    pub fn shape(message: impl Into<String>, span: &Span) -> Self {
        Error { kind: ErrorKind::Shape, message: message.into(), span: span.clone(), help: None, missing: None }
    }

    /// A missing declaration.
    pub fn undeclared(message: impl Into<String>, span: &Span) -> Self {
        Error { kind: ErrorKind::Undeclared, message: message.into(), span: span.clone(), help: None, missing: None }
    }

    /// A construction that is not known.
    pub fn unsupported(message: impl Into<String>, span: &Span) -> Self {
        Error { kind: ErrorKind::Unsupported, message: message.into(), span: span.clone(), help: None, missing: None }
    }

    /// Something that is too large, or takes too long.
    pub fn limit(message: impl Into<String>, span: &Span) -> Self {
        Error { kind: ErrorKind::Limit, message: message.into(), span: span.clone(), help: None, missing: None }
    }

    /// The same error with advice.
    pub fn with_help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }
}

/// The result of understanding something.
pub type Result<T> = std::result::Result<T, Error>;
