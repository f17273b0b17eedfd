//! Notes in LaTeX.
//!
//! One pass over the files in the order in which TeX reads them: `\input`, `\include`, `\subfile` and `\import` are
//! followed, also local packages (`\usepackage{course}` with a `course.sty` beside), relative to the main file and to the
//! file that includes. What is not read: comments, `verbatim` and the like, pictures, what stands before
//! `\begin{document}` (but for definitions, packages and annotations) and behind `\end{document}`.
//!
//! Displays are `equation`, `align`, `gather`, `multline`, `eqnarray`, `flalign`, `alignat`, `dmath`, starred or not,
//! `\[ .. \]` and `$$ .. $$`, also by a macro of the notes that stands for `\begin{equation}`. An equation is called by
//! its `\tag`, or else its `\label`, or else the number that LaTeX prints beside it; the number finds it in any case.
//!
//! Comment lines that begin with `%!` are annotations: TOML, in consecutive lines, the first perhaps beginning with
//! `kenzan`. The magic comments of editors (`%!TEX`) are none.

mod commands;
pub mod number;
mod reader;
mod words;

use super::assembly::Assembly;
use super::files::Beside;
use super::{Document, Item};
use reader::Reader;
use std::path::Path;
use std::sync::Arc;

/// Reads notes from a LaTeX text, with the files that it includes.
pub fn parse(path: &Path, source: &str, beside: &dyn Beside) -> Document {
    let mut reader = Reader::new(path, beside);
    reader.file(path, source);
    let clean = reader.clean();
    let mut assembly = Assembly::new(&reader.source, &clean, reader.files, reader.definitions, reader.problems)
        .counting(number::Counter::default());
    for part in reader.parts {
        assembly.add(part);
    }
    assembly.problems.sort_by_key(|problem| problem.span.start);
    let name = path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
    let headings = assembly.items.iter().filter_map(|item| match item {
        Item::Section(section) => Some(section),
        _ => None,
    });
    let highest = headings.min_by_key(|section| section.level).map(|section| section.title.clone());
    Document {
        title: reader.title.or(highest).unwrap_or_else(|| name.clone()),
        name,
        path: path.to_owned(),
        items: assembly.items,
        formulas: assembly.formulas,
        problems: assembly.problems,
        files: assembly.files,
        source: Arc::from(reader.source),
    }
}
