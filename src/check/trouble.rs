//! Where in the file that lies which stands in the way of a verdict.

use crate::document::{Problem, Span};
use crate::latex::ParseError;
use crate::semantics::{Clause, Error, ErrorKind, Side};

use super::book::{Entry, Unclear, Version};
use super::claim::{Obstacle, obstacle_text, unclear_text};

/// The place in the file of a part of a formula, given in the bytes of the LaTeX that was parsed.
fn locate(entry: &Entry, version: Version, part: &Span) -> Span {
    let annotation = entry.annotation();
    let correction = annotation.and_then(|a| a.correction.as_ref()).filter(|_| version == Version::Corrected);
    if let Some(text) = correction.or(annotation.and_then(|a| a.reading.as_ref())) {
        return text.place(part.clone());
    }
    let equation = &entry.equation;
    let part = &entry.printed.expanded.place(part);
    // What stands before the block of a row is printed elsewhere.
    match part.start.checked_sub(equation.prefix.len()) {
        Some(start) => {
            let at = |offset: usize| (equation.span.start + offset).min(equation.span.end);
            at(start)..at(part.end.saturating_sub(equation.prefix.len()).max(start))
        }
        None => whole(entry, version),
    }
}

/// The place of a formula: the first line of it that is not blank.
fn whole(entry: &Entry, version: Version) -> Span {
    let annotation = entry.annotation();
    let correction = annotation.and_then(|a| a.correction.as_ref()).filter(|_| version == Version::Corrected);
    if let Some(text) = correction.or(annotation.and_then(|a| a.reading.as_ref())) {
        return text.span.clone();
    }
    let equation = &entry.equation;
    let start = equation.masked.len() - equation.masked.trim_start().len();
    let line = equation.masked[start..].lines().next().unwrap_or_default().trim_end();
    let start = equation.span.start + start;
    start..start + line.len()
}

/// LaTeX that cannot be read.
fn latex(entry: &Entry, version: Version, error: &ParseError) -> Problem {
    let problem = Problem::error("kenzan::latex", error.message.clone(), locate(entry, version, &error.span));
    Problem { help: error.help.clone(), ..problem }
}

/// A formula that cannot be understood, at a place that is known.
fn meaning(error: &Error, span: Span) -> Problem {
    let code = match error.kind {
        ErrorKind::Shape => "kenzan::shape",
        ErrorKind::Undeclared => "kenzan::undeclared",
        ErrorKind::Unsupported => "kenzan::unsupported",
        ErrorKind::Limit => "kenzan::limit",
    };
    Problem { help: error.help.clone(), ..Problem::error(code, error.message.clone(), span) }
}

/// An equation that cannot be taken apart.
pub fn unclear(entry: &Entry, version: Version, unclear: &Unclear) -> Problem {
    match unclear {
        Unclear::Latex(error) => latex(entry, version, error),
        Unclear::Meaning(error) => meaning(error, locate(entry, version, &error.span)),
        Unclear::Before(..) => equation(entry, version, &unclear_text(unclear)),
    }
}

/// A link that cannot be evaluated. `foreign` says that the link belongs to an equation that this one is said to solve.
pub fn obstacle(entry: &Entry, version: Version, clause: &Clause, foreign: bool, obstacle: &Obstacle) -> Problem {
    match obstacle {
        Obstacle::Premise(_, _, span) => Problem::error("kenzan::premise", obstacle_text(obstacle), span.clone()),
        Obstacle::Link(error) => {
            let of_another = |words: &str| Error { message: format!("{words}: {}", error.message), ..error.clone() };
            match entry.list(|a| &a.solves).first() {
                Some(solves) if foreign => meaning(&of_another("with the solution put in"), solves.span.clone()),
                _ if is_inherited(clause, &error.span) => {
                    meaning(&of_another("in the equation that this one continues"), whole(entry, version))
                }
                _ => meaning(error, locate(entry, version, &error.span)),
            }
        }
    }
}

/// Whether a part may belong to a left side that is taken from the equation before, and is no place in this one.
pub fn is_inherited(clause: &Clause, part: &Span) -> bool {
    clause.continued && clause.lhs.span.start <= part.start && part.end <= clause.lhs.span.end
}

/// A link whose verdict lacks something that has no place of its own.
pub fn link(entry: &Entry, version: Version, clause: &Clause, message: &str) -> Problem {
    let span = match &clause.rhs {
        Side::Node(rhs) if !clause.continued && rhs.span.end >= clause.lhs.span.start => {
            first_line(entry, version, &(clause.lhs.span.start..rhs.span.end))
        }
        _ => whole(entry, version),
    };
    Problem::error("kenzan::undecided", message, span)
}

/// A part of an equation that cannot be judged.
pub fn part(entry: &Entry, version: Version, part: &Span, message: &str) -> Problem {
    Problem::error("kenzan::undecided", message, first_line(entry, version, part))
}

/// An equation whose verdict lacks something that has no place of its own.
pub fn equation(entry: &Entry, version: Version, message: &str) -> Problem {
    Problem::error("kenzan::undecided", message, whole(entry, version))
}

/// The first line of a part: an underline over several lines is hard to read.
fn first_line(entry: &Entry, version: Version, part: &Span) -> Span {
    let latex = &entry.formula(version).latex;
    let line = latex.get(part.clone()).and_then(|text| text.lines().next()).map_or(0, |line| line.trim_end().len());
    locate(entry, version, &(part.start..part.start + line))
}
