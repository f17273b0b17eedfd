//! Where the formulas of notes lose their digits: the survey of the documents, and the hard cases of the bundled
//! notes.

use std::time::Instant;

use rayon::prelude::*;

use crate::check::Book;
use crate::diagnose::stability::catalogue::{self, Case, CaseError, Measured, Ready};
use crate::diagnose::stability::survey::survey;
use crate::document::Document;
use crate::report::stability::Stability;

/// What is asked for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Request {
    /// The seed of the states.
    pub seed: u64,
    /// Only the equations of these labels; all where there are none. Hard cases are those of these labels, too.
    pub only: Vec<String>,
    /// Whether times are measured.
    pub times: bool,
}

/// Surveys the documents and measures those of the bundled hard cases that they are the notes of. `done` is called
/// after each equation.
///
/// # Errors
/// [`CaseError`]: the catalogue does not fit the notes.
pub fn stability(documents: &[Document], request: &Request, done: &(dyn Fn() + Sync)) -> Result<Stability, CaseError> {
    let begin = Instant::now();
    let surveys = documents.iter().map(|d| survey(d, &request.only, request.seed, done)).collect();
    let cases = measured(documents, request)?;
    let micros = u64::try_from(begin.elapsed().as_micros()).unwrap_or(u64::MAX);
    Ok(Stability { seed: request.seed, documents: surveys, cases, micros })
}

/// The bundled cases of these documents, measured.
///
/// # Errors
/// [`CaseError`]
pub fn measured(documents: &[Document], request: &Request) -> Result<Vec<Measured>, CaseError> {
    let books: Vec<(&str, Book)> = documents.iter().map(|d| (d.name.as_str(), Book::new(d))).collect();
    let book = |case: &Case| books.iter().find(|(name, _)| *name == case.notes).map(|(_, book)| book);
    let wanted = |case: &Case| request.only.is_empty() || request.only.contains(&case.equation);
    let cases = catalogue::bundled()?;
    let cases: Vec<(&Case, &Book)> =
        cases.iter().filter(|c| wanted(c)).filter_map(|c| book(c).map(|b| (c, b))).collect();
    let measure = |(case, book): &(&Case, &Book), times: bool| {
        Ready::new(case, book, request.seed)?.measured(request.seed, times)
    };
    // Times are taken one after another: side by side they would be those of each other.
    let each: Vec<_> = match request.times {
        true => cases.iter().map(|c| measure(c, true)).collect(),
        false => cases.par_iter().map(|c| measure(c, false)).collect(),
    };
    each.into_iter().collect()
}

#[cfg(test)]
mod tests;
