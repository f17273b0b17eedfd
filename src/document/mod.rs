//! Reading notes: files become their sections, their equations with label, LaTeX and place, and their annotations.
//!
//! What is an equation, how it gets its label, and which annotation belongs to it is explained in [`markdown`],
//! [`tex`], [`label`] and [`annotation`]. Notes may be written in several files (`\input`); a place in them is a byte of
//! all of them together, in the order in which they are read, see [`files`]. Promises:
//!
//! - an equation's [`latex`](Equation::latex) is the notes' bytes at its [`span`](Equation::span), unchanged;
//! - [`masked`](Equation::masked) has the same length in bytes, so that a place found in it is a place in the notes;
//! - labels are unique within a document;
//! - whatever is wrong becomes a [`Problem`] with its place, and all other equations are still delivered. Only a file
//!   that is not there, is not UTF-8, or holds no equation is a [`ReadError`].

pub mod annotation;
mod assembly;
pub mod declaration;
mod dialect;
mod display;
pub mod files;
pub mod label;
pub mod layout;
pub mod markdown;
pub mod place;
pub mod problem;
mod read;
mod references;
mod scan;
mod sidecar;
pub mod tex;
mod toml;

#[cfg(test)]
mod tests;

pub use annotation::{EquationAnnotation, LinkPremises};
pub use declaration::{Arguments, BasisDeclaration, Declarations, SymbolDeclaration};
pub use files::{Beside, Files, Nowhere, OnDisk, SourceFile};
pub use place::{Lines, Span, Spanned};
pub use problem::{Problem, Severity};
pub use read::{ReadError, edited, parse, parse_beside, read};

use crate::latex::expand::Macros;
use std::path::{Path, PathBuf};
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
    /// All its files, each in the place where it is included, the sidecar at the end.
    pub source: Arc<str>,
    /// What it holds, in the order in which it is read.
    pub items: Vec<Item>,
    /// What is wrong with it, in that order, too.
    pub problems: Vec<Problem>,
    /// Its files: that at [`path`](Self::path) first, then those it includes, then its sidecar.
    pub files: Files,
    /// The inline formulas, without their delimiters, in the order in which they are read.
    pub formulas: Vec<Span>,
    /// Their LaTeX, comments left out and macros expanded.
    expanded: Vec<String>,
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
    /// The numbers that LaTeX prints beside it: its `label` is what the source calls it, its number what a reader sees.
    pub numbers: Vec<String>,
    /// The file it stands in, where that is another than the document's.
    pub file: Option<PathBuf>,
    /// The line of its file where its LaTeX begins, counted from 1.
    pub line: usize,
    /// The bytes of its LaTeX in the notes.
    pub span: Span,
    /// Its LaTeX: the notes' bytes at `span`, without the delimiters of the display.
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
    /// The macros in force where it stands, with which it is to be expanded.
    pub macros: Macros,
    /// Its annotation.
    pub annotation: Option<EquationAnnotation>,
}

impl Equation {
    /// Whether this is its label or its number.
    pub fn is_called(&self, name: &str) -> bool {
        self.label == name || self.numbers.iter().any(|number| number == name)
    }
}

impl Document {
    /// Its equations in order.
    pub fn equations(&self) -> impl Iterator<Item = &Equation> {
        self.items.iter().filter_map(|item| match item {
            Item::Equation(equation) => Some(equation),
            _ => None,
        })
    }

    /// The line and the column, in characters, of a byte of the notes in the file that holds it, both counted from 1.
    pub fn line_column(&self, offset: usize) -> (usize, usize) {
        self.files.line_column(offset)
    }

    /// The LaTeX of an inline formula, comments left out and macros expanded.
    pub fn formula(&self, span: &Span) -> &str {
        let index = self.formulas.binary_search_by_key(&span.start, |formula| formula.start);
        let expanded = index.ok().and_then(|index| self.expanded.get(index));
        expanded.map_or_else(|| self.source.get(span.clone()).unwrap_or_default(), String::as_str)
    }

    /// The file that holds a byte of the notes.
    pub fn file(&self, offset: usize) -> &Path {
        self.files.at(offset).map_or(&self.path, |file| &file.path)
    }
}
