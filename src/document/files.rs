//! The files that notes are written in.
//!
//! Their texts are put together to one source in the order in which they are read: a file that is included stands in the
//! place of its `\input`. A place in the notes is a byte of that source, and tells the file, its line and its column.

use super::place::{Lines, Span};
use std::io::Read;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A file of the notes.
#[derive(Clone, Debug)]
pub struct SourceFile {
    /// Its path.
    pub path: PathBuf,
    /// Its text.
    pub text: Arc<str>,
    lines: Lines,
}

/// A part of a file that stands in the source as it is.
#[derive(Clone, Debug)]
struct Piece {
    /// Where it begins in the source.
    start: usize,
    /// Its file, and where it begins there.
    file: usize,
    offset: usize,
}

/// The files of a document; that which was asked for is the first.
#[derive(Clone, Debug, Default)]
pub struct Files {
    files: Vec<SourceFile>,
    pieces: Vec<Piece>,
}

impl Files {
    /// A document of one file.
    pub fn single(path: &Path, source: &str) -> Self {
        let mut files = Files::default();
        let file = files.add(path, source);
        files.piece(0, file, 0);
        files
    }

    /// Adds a file: its number.
    pub(super) fn add(&mut self, path: &Path, text: &str) -> usize {
        let (path, text, lines) = (path.to_owned(), Arc::from(text), Lines::new(text));
        self.files.push(SourceFile { path, text, lines });
        self.files.len() - 1
    }

    /// From `start` on the source is a file's text from `offset` on.
    pub(super) fn piece(&mut self, start: usize, file: usize, offset: usize) {
        self.pieces.push(Piece { start, file, offset });
    }

    /// The files, in the order in which they were first read.
    pub fn iter(&self) -> impl Iterator<Item = &SourceFile> {
        self.files.iter()
    }

    fn piece_at(&self, at: usize) -> Option<&Piece> {
        let after = self.pieces.partition_point(|piece| piece.start <= at);
        self.pieces.get(after.saturating_sub(1))
    }

    /// The number of the file that holds a byte of the source, and the byte in it.
    pub fn place(&self, at: usize) -> (usize, usize) {
        self.piece_at(at).map_or((0, 0), |piece| (piece.file, piece.offset + at.saturating_sub(piece.start)))
    }

    /// The file that holds a byte of the source.
    pub fn at(&self, at: usize) -> Option<&SourceFile> {
        self.files.get(self.place(at).0)
    }

    /// The line of a byte in its file, counted from 1.
    pub fn line(&self, at: usize) -> usize {
        let (file, offset) = self.place(at);
        self.files.get(file).map_or(1, |file| file.lines.line(offset))
    }

    /// Where the line of a byte begins in the source, or the piece of the file that it stands in.
    pub fn line_start(&self, at: usize) -> usize {
        let Some(piece) = self.piece_at(at) else { return 0 };
        let offset = piece.offset + at.saturating_sub(piece.start);
        let line = self.files.get(piece.file).map_or(0, |file| file.lines.start(offset));
        piece.start + line.saturating_sub(piece.offset)
    }

    /// The line of a byte in its file, and its column in characters, both counted from 1.
    pub fn line_column(&self, at: usize) -> (usize, usize) {
        let (file, offset) = self.place(at);
        self.files.get(file).map_or((1, 1), |file| file.lines.line_column(&file.text, offset))
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

/// A range of the source as a range of the file that its beginning stands in, cut off at that file's end.
pub(super) fn local(files: &Files, span: &Span) -> (usize, Span) {
    let (file, start) = files.place(span.start);
    let end = files.files.get(file).map_or(0, |file| file.text.len());
    let start = start.min(end);
    (file, start..(start + span.len()).min(end))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_stands_where_it_is_included() {
        // ab\n[cd\ne]f\ng
        let mut files = Files::default();
        let main = files.add(Path::new("main"), "ab\nf\ng");
        let other = files.add(Path::new("other"), "cd\ne");
        files.piece(0, main, 0);
        files.piece(3, other, 0);
        files.piece(7, main, 3);
        let at = |at: usize| (files.at(at).unwrap().path.display().to_string(), files.line_column(at));
        assert_eq!(at(1), ("main".to_owned(), (1, 2)));
        assert_eq!(at(6), ("other".to_owned(), (2, 1)));
        assert_eq!(at(9), ("main".to_owned(), (3, 1)));
        assert_eq!([files.line_start(1), files.line_start(6), files.line_start(8), files.line_start(9)], [0, 6, 7, 9]);
    }
}
