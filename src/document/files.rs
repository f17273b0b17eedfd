//! The files that notes are written in.
//!
//! Their texts stand one behind the other in one source, each with a line break after it: a place in the notes is a byte
//! of that source, and tells the file, its line and its column.

use super::place::{Lines, Span};
use std::io::Read;
use std::path::{Path, PathBuf};

/// A file of the notes.
#[derive(Clone, Debug)]
pub struct SourceFile {
    /// Its path.
    pub path: PathBuf,
    /// Its bytes in the source.
    pub span: Span,
    lines: Lines,
}

/// The files of a document, in the order of the source; there is always one.
#[derive(Clone, Debug, Default)]
pub struct Files {
    files: Vec<SourceFile>,
}

impl Files {
    /// A document of one file.
    pub fn single(path: &Path, source: &str) -> Self {
        let mut files = Files::default();
        files.push(path, 0, source);
        files
    }

    /// Adds a file whose text begins at a byte of the source.
    pub(super) fn push(&mut self, path: &Path, start: usize, text: &str) {
        self.files.push(SourceFile { path: path.to_owned(), span: start..start + text.len(), lines: Lines::new(text) });
    }

    /// The files in order.
    pub fn iter(&self) -> impl Iterator<Item = &SourceFile> {
        self.files.iter()
    }

    /// The number of the file that holds a byte of the source.
    pub fn number(&self, offset: usize) -> usize {
        self.files.partition_point(|file| file.span.start <= offset).saturating_sub(1)
    }

    /// The file that holds a byte of the source.
    pub fn at(&self, offset: usize) -> Option<&SourceFile> {
        self.files.get(self.number(offset))
    }

    /// The line of a byte in its file, counted from 1.
    pub fn line(&self, offset: usize) -> usize {
        self.at(offset).map_or(1, |file| file.lines.line(offset - file.span.start))
    }

    /// Where the line of a byte begins in the source.
    pub fn line_start(&self, offset: usize) -> usize {
        self.at(offset).map_or(0, |file| file.span.start + file.lines.start(offset - file.span.start))
    }

    /// The line of a byte in its file, and its column in characters, both counted from 1.
    pub fn line_column(&self, source: &str, offset: usize) -> (usize, usize) {
        let Some(file) = self.at(offset) else { return (1, 1) };
        let text = source.get(file.span.clone()).unwrap_or_default();
        file.lines.line_column(text, offset - file.span.start)
    }
}

/// Where the files come from that notes include, and their sidecars.
pub trait Beside {
    /// The text of a file; `None` where there is none.
    fn text(&self, path: &Path) -> Option<String>;
}

/// No files: notes that are a text alone.
#[derive(Clone, Copy, Debug)]
pub struct Nowhere;

impl Beside for Nowhere {
    fn text(&self, _: &Path) -> Option<String> {
        None
    }
}

/// The files on the disk, those that are too large or not encoded in UTF-8 excepted.
#[derive(Clone, Copy, Debug)]
pub struct OnDisk;

impl Beside for OnDisk {
    fn text(&self, path: &Path) -> Option<String> {
        let file = std::fs::File::open(path).ok().filter(|file| file.metadata().is_ok_and(|data| data.is_file()))?;
        let mut bytes = Vec::new();
        file.take(super::read::LARGEST + 1).read_to_end(&mut bytes).ok()?;
        String::from_utf8(bytes).ok().filter(|text| text.len() as u64 <= super::read::LARGEST)
    }
}
