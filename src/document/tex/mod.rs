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

use super::Document;
use super::assembly::Assembly;
use super::files::Beside;
use super::references::Language;
use super::sidecar::Sidecar;
use crate::latex::expand::Macros;
use reader::Reader;
use std::path::Path;

/// Reads notes from a LaTeX text, with the files that it includes.
pub fn parse(path: &Path, source: &str, beside: &dyn Beside) -> Document {
    let mut reader = Reader::new(path, beside);
    reader.file(path, source);
    let clean = reader.clean();
    let Reader { mut source, mut files, definitions, mut problems, parts, title, .. } = reader;
    let missing = problems.iter().any(|problem| problem.code == "document::input");
    let macros = Macros::all(&definitions);
    let sidecar = Sidecar::read(path, beside, &mut source, &mut files, &macros, &mut problems);
    let mut assembly = Assembly::new(&source, &clean, files, definitions, problems)
        .counting(number::Counter::default())
        .beside(sidecar);
    for part in parts {
        assembly.add(part);
    }
    assembly.check_references(&clean, Language::Latex { complete: !missing });
    let highest = assembly.highest_heading().map(|section| section.title.clone());
    assembly.document(path, title.or(highest))
}
