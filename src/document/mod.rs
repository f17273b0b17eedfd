//! Reading notes: a file becomes its sections, its equations with label, LaTeX and place, and its annotations.
//!
//! What is an equation, how it gets its label, and which annotation belongs to it is explained in [`markdown`],
//! [`label`] and [`annotation`]. Promises:
//!
//! - an equation's [`latex`](Equation::latex) is the file's bytes at its [`span`](Equation::span), unchanged;
//! - [`masked`](Equation::masked) has the same length in bytes, so that a place found in it is a place in the file;
//! - labels are unique within a document;
//! - whatever is wrong becomes a [`Problem`] with its place, and all other equations are still delivered. Only a file
//!   that is not there, is not UTF-8, or holds no equation is a [`ReadError`].

pub mod annotation;
mod assembly;
pub mod declaration;
mod display;
pub mod label;
pub mod layout;
pub mod markdown;
pub mod place;
pub mod problem;
mod read;
mod scan;
mod toml;

#[cfg(test)]
mod tests;

pub use annotation::{EquationAnnotation, LinkPremises};
pub use declaration::{Arguments, BasisDeclaration, Declarations, SymbolDeclaration};
pub use place::{Lines, Span, Spanned};
pub use problem::{Problem, Severity};
pub use read::{ReadError, parse, read};

use std::path::PathBuf;
use std::sync::Arc;

/// Notes that have been read.
#[derive(Clone, Debug)]
pub struct Document {
    /// The file's name without extension.
    pub name: String,
    /// The file's path as it was given.
    pub path: PathBuf,
    /// The first heading of the first level, or else [`name`](Self::name).
    pub title: String,
    /// The whole file.
    pub source: Arc<str>,
    /// What it holds, in the order of the file.
    pub items: Vec<Item>,
    /// What is wrong with it, in the order of the file.
    pub problems: Vec<Problem>,
    /// The inline formulas, without their delimiters, in the order of the file.
    pub formulas: Vec<Span>,
    /// Where its lines begin.
    pub lines: Lines,
}

/// A part of a document.
#[expect(clippy::large_enum_variant, reason = "nearly all items are equations")]
#[derive(Clone, Debug, PartialEq)]
pub enum Item {
    /// A heading.
    Section(Section),
    /// Declarations that hold from here to the end of the section.
    Declarations(Declarations),
    /// An equation.
    Equation(Equation),
}

/// A heading; its section extends to the next heading of the same or a higher level.
#[derive(Clone, Debug, PartialEq)]
pub struct Section {
    /// Its text; inline formulas with their dollars.
    pub title: String,
    /// 1 for `#` to 6 for `######`.
    pub level: u8,
    /// Its line.
    pub span: Span,
}

/// An equation: a display, or some rows of one, or an inline formula that an annotation labels.
#[derive(Clone, Debug, PartialEq)]
pub struct Equation {
    /// The label that the notes print or that an annotation gives (`52`), unique. Without either, the printed label
    /// before it and a running number, `8+1`; before the first label `0+1`.
    pub label: String,
    /// Whether the label is printed in the notes.
    pub numbered: bool,
    /// The line where its LaTeX begins, counted from 1.
    pub line: usize,
    /// The bytes of its LaTeX in the file.
    pub span: Span,
    /// Its LaTeX: the file's bytes at `span`, without the delimiters of the display.
    pub latex: String,
    /// `latex` with the same length in bytes, in which everything that is not mathematics is blank: the printed label
    /// and the space before it, `\label{..}`, `\nonumber`, `\notag`, and the marks `>` of a block quote.
    pub masked: String,
    /// What stands before a block whose rows are equations of their own, and so before each of them: `\dot{\varphi} = `.
    /// Verbatim (but masked); the equation to read is `prefix` and `masked` together. Empty for all others.
    pub prefix: String,
    /// The running number of its display in the document, from 0. The equations of one display share it.
    pub display: usize,
    /// Whether it is an inline formula.
    pub inline: bool,
    /// Its annotation.
    pub annotation: Option<EquationAnnotation>,
}

impl Document {
    /// Its equations in order.
    pub fn equations(&self) -> impl Iterator<Item = &Equation> {
        self.items.iter().filter_map(|item| match item {
            Item::Equation(equation) => Some(equation),
            _ => None,
        })
    }

    /// The line and the column, in characters, of a byte of the file, both counted from 1.
    pub fn line_column(&self, offset: usize) -> (usize, usize) {
        self.lines.line_column(&self.source, offset)
    }
}
