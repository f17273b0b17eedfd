//! Opening a file of notes.

use super::{Beside, Document, Nowhere, OnDisk, markdown, tex};
use miette::Diagnostic;
use std::io::Read;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// The largest file that is read, in bytes.
pub(super) const LARGEST: u64 = 64 << 20;

/// Why a file could not be read as notes.
#[derive(Debug, Error, Diagnostic)]
pub enum ReadError {
    /// There is no such file.
    #[error("there is no file `{}`", path.display())]
    #[diagnostic(code(document::no_such_file), help("check the spelling; paths are taken from the current folder"))]
    NoSuchFile {
        /// The path.
        path: PathBuf,
    },
    /// The path is a folder's.
    #[error("`{}` is a folder, not a file of notes", path.display())]
    #[diagnostic(code(document::directory), help("name the files in it, for example `{}`", path.join("notes.md").display()))]
    Directory {
        /// The path.
        path: PathBuf,
    },
    /// The file is there, but the system would not let it be read.
    #[error("`{}` could not be read", path.display())]
    #[diagnostic(code(document::unreadable), help("check that you may read it"))]
    Unreadable {
        /// The path.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// The file is larger than any notes.
    #[error("`{}` is larger than {} MB", path.display(), LARGEST >> 20)]
    #[diagnostic(code(document::too_large), help("are these notes? If so, verify them in parts"))]
    TooLarge {
        /// The path.
        path: PathBuf,
    },
    /// The file is not encoded in UTF-8.
    #[error("{}:{line}:{column}: the file is not UTF-8: this byte cannot stand here", path.display())]
    #[diagnostic(
        code(document::not_utf8),
        help("save it as UTF-8, or convert it: `iconv -f SHIFT_JIS -t UTF-8 OLD > NEW` (with the encoding it has)")
    )]
    NotUtf8 {
        /// The path.
        path: PathBuf,
        /// The line of the first invalid byte, counted from 1.
        line: usize,
        /// Its column in characters, counted from 1.
        column: usize,
    },
    /// The file holds nothing but blanks.
    #[error("`{}` is empty", path.display())]
    #[diagnostic(code(document::empty), help("is it the file you meant?"))]
    Empty {
        /// The path.
        path: PathBuf,
    },
    /// The folder holds no file of notes.
    #[error("the folder `{}` holds no notes", path.display())]
    #[diagnostic(
        code(document::no_notes),
        help("files that end in .md, .markdown, .qmd, .rmd, .tex or .ltx and hold an equation are notes")
    )]
    NoNotes {
        /// The path.
        path: PathBuf,
    },
    /// The file holds no displayed equation, and nothing that looks like a damaged one.
    #[error("`{}` holds no displayed equation", path.display())]
    #[diagnostic(
        code(document::no_equation),
        help(
            "equations are displays: `$$ E = mc^2 \\tag{{1}} $$`, `\\[ .. \\]` or `\\begin{{equation}} .. \\end{{equation}}`"
        )
    )]
    NoEquation {
        /// The path.
        path: PathBuf,
    },
}

/// Reads a file of notes.
///
/// # Errors
///
/// [`ReadError`], when there is nothing to work on. A file without an equation but with problems (its only display is
/// not closed) is delivered, so that the problems are seen.
pub fn read(path: &Path) -> Result<Document, ReadError> {
    let mut bytes = Vec::new();
    let file = std::fs::File::open(path).map_err(|error| not_read(path, error))?;
    file.take(LARGEST + 1).read_to_end(&mut bytes).map_err(|error| not_read(path, error))?;
    if bytes.len() as u64 > LARGEST {
        return Err(ReadError::TooLarge { path: path.to_owned() });
    }
    let source = String::from_utf8(bytes).map_err(|error| {
        let offset = error.utf8_error().valid_up_to();
        // What stands before the offset is valid.
        let before = String::from_utf8_lossy(error.as_bytes().get(..offset).unwrap_or_default());
        let line = before.matches('\n').count() + 1;
        let column = before.rsplit('\n').next().map_or(0, |rest| rest.chars().count()) + 1;
        ReadError::NotUtf8 { path: path.to_owned(), line, column }
    })?;
    if source.trim_matches(|c: char| c.is_whitespace() || c == '\u{feff}').is_empty() {
        return Err(ReadError::Empty { path: path.to_owned() });
    }
    let document = edited(path, &source);
    if document.equations().next().is_none() && document.problems.is_empty() {
        return Err(ReadError::NoEquation { path: path.to_owned() });
    }
    Ok(document)
}

fn not_read(path: &Path, error: std::io::Error) -> ReadError {
    let path = path.to_owned();
    if path.is_dir() {
        ReadError::Directory { path }
    } else if error.kind() == std::io::ErrorKind::NotFound {
        ReadError::NoSuchFile { path }
    } else {
        ReadError::Unreadable { path, source: error }
    }
}

/// Reads notes from a text alone; `path` is only for messages and the document's name, and says what they are written in.
pub fn parse(path: &Path, source: &str) -> Document {
    parse_beside(path, source, &Nowhere)
}

/// Reads notes from a text, as an editor holds it; files that it includes are read from the disk.
pub fn edited(path: &Path, source: &str) -> Document {
    parse_beside(path, source, &OnDisk)
}

/// Reads notes from a text, with the files that it includes.
pub fn parse_beside(path: &Path, source: &str, beside: &dyn Beside) -> Document {
    let extension = path.extension().map(|extension| extension.to_string_lossy().to_lowercase());
    match extension.as_deref() {
        Some("tex" | "ltx" | "latex") => tex::parse(path, source, beside),
        _ => markdown::parse(path, source, beside),
    }
}
