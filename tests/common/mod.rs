//! What tests of single equations share.

#![allow(dead_code, clippy::unwrap_used, clippy::expect_used, clippy::panic)]

pub mod edits;

use std::path::Path;

use kenzan::check::Book;
use kenzan::document;

/// Notes with one equation, (1), behind declarations and with an annotation of its own.
pub fn book(symbols: &str, latex: &str, annotation: &str) -> Book {
    let equation = format!("$$ {latex} \\tag{{1}} $$\n<!-- kenzan\nbecause = \"a test\"\n{annotation}\n-->\n");
    let document = document::parse(Path::new("notes.md"), &format!("# Notes\n\n{symbols}\n{equation}"));
    assert!(document.problems.is_empty(), "{:?}", document.problems);
    let book = Book::new(&document);
    assert!(book.problems.is_empty(), "{:?}", book.problems);
    book
}
