//! The summary for the terminal.

use super::text::{duration, reason, symbol, word};
use super::{Counts, Options, Run, counts};
use crate::check::verdict::{DimensionStatus, DocumentReport, Judgement, Sensitivity, Verdict};
use std::fmt::Write;

/// The summary: for each document the counts, then each equation that fails, cannot be decided or read, or is not as
/// expected, with its place and what it should read.
pub fn render(run: &Run, colour: bool, options: Options) -> String {
    let paint = Paint { colour };
    let mut text = String::new();
    for document in &run.documents {
        // Writing to a string cannot fail.
        let _ = summarize(&mut text, document, paint);
    }
    let counts = Counts::of(run.documents.iter().flat_map(|d| &d.equations));
    let problems = match run.documents.iter().map(|d| d.problems.len()).sum::<usize>() {
        0 => String::new(),
        1 => paint.verdict(Verdict::Fails, ", but the notes have 1 problem"),
        n => paint.verdict(Verdict::Fails, &format!(", but the notes have {n} problems")),
    };
    let unexpected = match counts.unexpected {
        0 => paint.verdict(Verdict::Holds, "all as expected") + &problems,
        n => paint.verdict(Verdict::Fails, &format!("{n} not as expected")),
    };
    let time = if options.times { format!(" in {}", duration(run.micros)) } else { String::new() };
    let equations = if counts.total == 1 { "equation" } else { "equations" };
    let _ = writeln!(text, "{} {equations}{time}, seed {}: {unexpected}", counts.total, run.seed);
    text
}

fn summarize(text: &mut String, document: &DocumentReport, paint: Paint) -> std::fmt::Result {
    let counts = Counts::of(&document.equations);
    writeln!(text, "{}", paint.bold(&format!("{}  {}", document.path, document.title)))?;
    let shares: Vec<_> =
        counts::ORDER.into_iter().filter(|v| counts.with(*v) > 0).map(|v| share(counts, v, paint)).collect();
    writeln!(text, "  {}", if shares.is_empty() { "no displayed equations".to_owned() } else { shares.join("   ") })?;
    if counts.holds > 0 {
        writeln!(text, "  exact: {} of {} that hold", counts.exact, counts.holds)?;
    }
    if counts.certified > 0 {
        writeln!(text, "  certified: {} of {} that fail", counts.certified, counts.fails)?;
    }
    if counts.restated > 0 {
        writeln!(
            text,
            "  restated: {} only say what one of their premises says: {}",
            counts.restated,
            restated(document)
        )?;
    }
    if counts.errata_lost > 0 {
        let lost = counts.errata_lost;
        writeln!(
            text,
            "  errata: {} with a correction that holds, {lost} of them not to be judged as printed",
            counts.errata
        )?;
    }
    if let Some(dimensions) = dimensions(document) {
        writeln!(text, "  dimensions: {dimensions}")?;
    }
    for problem in &document.problems {
        writeln!(text, "  {} {}", paint.verdict(Verdict::Unreadable, "!"), one_line(problem))?;
    }
    for judgement in document.equations.iter().filter(|j| is_shown(j)) {
        line(text, document, judgement, paint)?;
    }
    mutants(text, document)?;
    writeln!(text)
}

/// The labels of the equations that only say what a premise says: `(9), (135) corrected`
fn restated(document: &DocumentReport) -> String {
    let label = |j: &Judgement| match &j.correction {
        Some(c) => Judgement::only_restates(&c.links).then(|| format!("({}) corrected", one_line(&j.label))),
        None => Judgement::only_restates(&j.links).then(|| format!("({})", one_line(&j.label))),
    };
    document.equations.iter().filter_map(label).collect::<Vec<_>>().join(", ")
}

/// `71 ok, 8 mismatches, 16 unchecked`
fn dimensions(document: &DocumentReport) -> Option<String> {
    let count = |status| document.equations.iter().filter(|e| e.dimension == status).count();
    let (ok, mismatches) = (count(DimensionStatus::Ok), count(DimensionStatus::Mismatch));
    let plural = if mismatches == 1 { "mismatch" } else { "mismatches" };
    let unchecked = count(DimensionStatus::Unchecked);
    (ok + mismatches > 0).then(|| format!("{ok} ok, {mismatches} {plural}, {unchecked} unchecked"))
}

/// `✗ 3 fails (1 erratum)`
fn share(counts: Counts, verdict: Verdict, paint: Paint) -> String {
    let errata = match (verdict, counts.errata - counts.errata_lost) {
        (Verdict::Fails, 1) => " (1 erratum)".to_owned(),
        (Verdict::Fails, n) if n > 1 => format!(" ({n} errata)"),
        _ => String::new(),
    };
    paint.verdict(verdict, &format!("{} {} {}{errata}", symbol(verdict), counts.with(verdict), word(verdict)))
}

/// What the summary says of one equation, in plain text.
pub(super) fn of_one(document: &DocumentReport, j: &Judgement) -> String {
    let mut text = String::new();
    // Writing to a string cannot fail.
    let _ = line(&mut text, document, j, Paint { colour: false });
    text.lines().map(|line| line.trim_start().to_owned()).collect::<Vec<_>>().join("\n")
}

fn is_shown(j: &Judgement) -> bool {
    matches!(j.verdict, Verdict::Fails | Verdict::Undecided | Verdict::Unreadable)
        || !j.as_expected
        || !j.dimension_findings.is_empty()
}

fn line(text: &mut String, document: &DocumentReport, j: &Judgement, paint: Paint) -> std::fmt::Result {
    let mark = paint.verdict(j.verdict, &format!("{} ({})", symbol(j.verdict), one_line(&j.label)));
    write!(text, "  {mark} {}:{} {}", one_line(document.path_of(j)), j.line, word(j.verdict))?;
    if j.expect == Some(j.verdict) && !j.as_expected {
        write!(text, ", as expected, but its correction {}", j.correction.as_ref().map_or("", |c| phrase(c.verdict)))?;
    } else if let (false, Some(expected)) = (j.as_expected, j.expect) {
        write!(text, ", though it is expected that it {}", phrase(expected))?;
    } else if j.expect == Some(j.verdict) {
        write!(text, ", as expected")?;
    }
    if let Some(reason) = reason(j) {
        write!(text, ": {}", one_line(reason))?;
    }
    writeln!(text)?;
    if let Some(correction) = &j.correction {
        let verdict = format!("which {}", phrase(correction.verdict));
        writeln!(text, "      should read  {}  ({verdict})", one_line(&correction.latex))?;
    } else if let Some(c) = &j.counterexample {
        writeln!(text, "      for example  {}  against  {}", c.lhs, c.rhs)?;
    }
    if let Some(certificate) = j.counterexample.as_ref().and_then(|c| c.certificate.as_ref()) {
        writeln!(text, "      certified: {}", one_line(&certificate.to_string()))?;
    }
    for finding in &j.dimension_findings {
        writeln!(text, "      dimensions: {}", one_line(&finding.message))?;
    }
    for suggestion in &j.suggestions {
        writeln!(text, "      perhaps: {}", one_line(&suggestion.edit))?;
        if let Some(diff) = &suggestion.diff {
            writeln!(text, "        - {}", one_line(&diff.printed))?;
            writeln!(text, "        + {}", one_line(&diff.suggested))?;
        } else {
            writeln!(text, "        + {}", one_line(&suggestion.latex))?;
        }
    }
    Ok(())
}

/// How many mutants the checks let pass, and where.
fn mutants(text: &mut String, document: &DocumentReport) -> std::fmt::Result {
    let all: Vec<_> = document.equations.iter().filter_map(|j| j.sensitivity.as_ref().map(|s| (j, s))).collect();
    if all.is_empty() {
        return Ok(());
    }
    let sum = |count: fn(&Sensitivity) -> usize| all.iter().map(|(_, s)| count(s)).sum::<usize>();
    let (killed, different) = (sum(|s| s.killed), sum(|s| s.total - s.equivalent - s.weaker));
    writeln!(text, "  {killed} of {different} mutants that say something else fail")?;
    for (j, s) in all.iter().filter(|(_, s)| !s.survivors.is_empty()) {
        let edits: Vec<String> = s.survivors.iter().take(3).map(|e| one_line(e)).collect();
        let more = if s.survivors.len() > 3 { " ..." } else { "" };
        writeln!(text, "  ({}) lets {} pass: {}{more}", one_line(&j.label), s.survivors.len(), edits.join("; "))?;
    }
    Ok(())
}

/// A verdict as the end of a sentence.
fn phrase(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Statement => "has nothing to evaluate",
        Verdict::Definition => "is a definition",
        Verdict::Holds => "holds",
        Verdict::Asymptotic => "holds asymptotically",
        Verdict::Undecided => "cannot be decided",
        Verdict::Unreadable => "cannot be read",
        Verdict::Fails => "fails",
    }
}

/// A text with its line breaks and runs of spaces made single spaces, and control characters left out: notes must not
/// steer the terminal.
fn one_line(text: &str) -> String {
    let text: String = text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[derive(Clone, Copy)]
struct Paint {
    colour: bool,
}

impl Paint {
    fn with(self, code: &str, text: &str) -> String {
        if self.colour { format!("\x1b[{code}m{text}\x1b[0m") } else { text.to_owned() }
    }

    fn bold(self, text: &str) -> String {
        self.with("1", &one_line(text))
    }

    fn verdict(self, verdict: Verdict, text: &str) -> String {
        let code = match verdict {
            Verdict::Holds => "32",
            Verdict::Asymptotic => "36",
            Verdict::Definition | Verdict::Statement => "2",
            Verdict::Fails => "1;31",
            Verdict::Undecided => "33",
            Verdict::Unreadable => "35",
        };
        self.with(code, text)
    }
}
