//! The summary for the terminal.

use super::text::{duration, reason, symbol};
use super::words::{Words, count, fill, with};
use super::{Counts, Language, Options, Run, counts};
use crate::check::verdict::{DimensionStatus, DocumentReport, Judgement, Sensitivity, Verdict};
use std::fmt::{Display, Write};

/// The summary: for each document the counts, then each equation that fails, cannot be decided or read, or is not as
/// expected, with its place and what it should read.
pub fn render(run: &Run, colour: bool, options: Options) -> String {
    let (language, w) = (options.language, options.language.words());
    let paint = Paint { colour };
    let mut text = String::new();
    for document in &run.documents {
        // Writing to a string cannot fail.
        let _ = summarize(&mut text, document, language, paint);
    }
    let counts = Counts::of(run.documents.iter().flat_map(|d| &d.equations));
    let problems = match run.documents.iter().map(|d| d.problems.len()).sum::<usize>() {
        0 => String::new(),
        n => paint.verdict(Verdict::Fails, &count(w.terminal_problems, n)),
    };
    let verdict = match counts.unexpected {
        0 => paint.verdict(Verdict::Holds, w.terminal_expected) + &problems,
        n => paint.verdict(Verdict::Fails, &count(w.terminal_unexpected, n)),
    };
    let time = options.times.then(|| with(w.terminal_time, &[("time", &duration(run.micros))]));
    let total = with(
        w.terminal_total,
        &[
            ("equations", &count(w.terminal_equations, counts.total)),
            ("time", &time.unwrap_or_default()),
            ("seed", &run.seed),
            ("verdict", &verdict),
        ],
    );
    text + &total + "\n"
}

fn summarize(text: &mut String, document: &DocumentReport, language: Language, paint: Paint) -> std::fmt::Result {
    let w = language.words();
    let counts = Counts::of(&document.equations);
    writeln!(text, "{}", paint.bold(&format!("{}  {}", document.path, document.title)))?;
    let shares: Vec<_> =
        counts::ORDER.into_iter().filter(|v| counts.with(*v) > 0).map(|v| share(counts, v, w, paint)).collect();
    writeln!(text, "  {}", if shares.is_empty() { w.terminal_none.to_owned() } else { shares.join("   ") })?;
    for line in facts(document, counts, w) {
        writeln!(text, "  {line}")?;
    }
    for problem in &document.problems {
        writeln!(
            text,
            "  {} {}",
            paint.verdict(Verdict::Unreadable, "!"),
            one_line(&language.say_problem(&problem.text))
        )?;
    }
    for judgement in document.equations.iter().filter(|j| is_shown(j)) {
        line(text, document, judgement, language, paint)?;
    }
    mutants(text, document, language)?;
    writeln!(text)
}

/// What can be counted of a document beside its verdicts, a line each.
fn facts(document: &DocumentReport, counts: Counts, w: &Words) -> Vec<String> {
    let mut facts = Vec::new();
    if counts.holds > 0 {
        facts.push(with(w.exact_of, &[("n", &counts.exact), ("m", &counts.holds)]));
    }
    if counts.certified > 0 {
        facts.push(with(w.certified_of, &[("n", &counts.certified), ("m", &counts.fails)]));
    }
    if counts.restated > 0 {
        facts.push(with(w.terminal_restated, &[("n", &counts.restated), ("labels", &restated(document, w))]));
    }
    if counts.errata_lost > 0 {
        facts.push(with(w.errata_lost, &[("n", &counts.errata), ("m", &counts.errata_lost)]));
    }
    facts.extend(dimensions(document, w));
    facts
}

/// The labels of the equations that only say what a premise says: `(9), (135) corrected`
fn restated(document: &DocumentReport, w: &Words) -> String {
    let label = |j: &Judgement| match &j.correction {
        Some(c) => {
            Judgement::only_restates(&c.links).then(|| with(w.terminal_corrected, &[("label", &one_line(&j.label))]))
        }
        None => Judgement::only_restates(&j.links).then(|| format!("({})", one_line(&j.label))),
    };
    document.equations.iter().filter_map(label).collect::<Vec<_>>().join(w.list_comma)
}

/// `dimensions: 71 ok, 8 mismatches, 16 unchecked`
fn dimensions(document: &DocumentReport, w: &Words) -> Option<String> {
    let count = |status| document.equations.iter().filter(|e| e.dimension == status).count();
    let (ok, differ) = (count(DimensionStatus::Ok), count(DimensionStatus::Mismatch));
    let unchecked = count(DimensionStatus::Unchecked);
    let places: [(&str, &dyn Display); 3] = [("ok", &ok), ("differ", &differ), ("unchecked", &unchecked)];
    (ok + differ > 0).then(|| fill(w.terminal_dimensions, differ, &places))
}

/// `✗ 3 fails (1 erratum)`
fn share(counts: Counts, verdict: Verdict, w: &Words, paint: Paint) -> String {
    let errata = match (verdict, counts.errata - counts.errata_lost) {
        (Verdict::Fails, n) if n > 0 => count(w.terminal_errata, n),
        _ => String::new(),
    };
    paint.verdict(verdict, &format!("{} {} {}{errata}", symbol(verdict), counts.with(verdict), w.verdict(verdict)))
}

/// What the summary says of one equation, in plain text, in English: for tools.
pub(super) fn of_one(document: &DocumentReport, j: &Judgement) -> String {
    let mut text = String::new();
    // Writing to a string cannot fail.
    let _ = line(&mut text, document, j, Language::English, Paint { colour: false });
    text.lines().map(|line| line.trim_start().to_owned()).collect::<Vec<_>>().join("\n")
}

fn is_shown(j: &Judgement) -> bool {
    matches!(j.verdict, Verdict::Fails | Verdict::Undecided | Verdict::Unreadable)
        || !j.as_expected
        || !j.dimension_findings.is_empty()
}

fn line(
    text: &mut String,
    document: &DocumentReport,
    j: &Judgement,
    language: Language,
    paint: Paint,
) -> std::fmt::Result {
    let w = language.words();
    let mark = paint.verdict(j.verdict, &format!("{} ({})", symbol(j.verdict), one_line(&j.label)));
    write!(text, "  {mark} {}:{} {}", one_line(document.path_of(j)), j.line, w.verdict(j.verdict))?;
    let phrase = |verdict| w.phrase(verdict);
    if j.expect == Some(j.verdict) && !j.as_expected {
        let verdict = j.correction.as_ref().map_or("", |c| phrase(c.verdict));
        write!(text, "{}", with(w.terminal_correction_not, &[("verdict", &verdict)]))?;
    } else if let (false, Some(expected)) = (j.as_expected, j.expect) {
        write!(text, "{}", with(w.terminal_expected_otherwise, &[("verdict", &phrase(expected))]))?;
    } else if j.expect == Some(j.verdict) {
        write!(text, "{}", w.terminal_as_expected)?;
    }
    if let Some(reason) = reason(j) {
        write!(text, "{}{}", w.terminal_reason, one_line(&language.say(reason)))?;
    }
    writeln!(text)?;
    if let Some(correction) = &j.correction {
        let verdict = with(w.terminal_which, &[("verdict", &phrase(correction.verdict))]);
        let latex = one_line(&correction.latex);
        writeln!(text, "      {}", with(w.terminal_should_read, &[("latex", &latex), ("verdict", &verdict)]))?;
    } else if let Some(c) = &j.counterexample {
        writeln!(text, "      {}", with(w.terminal_example, &[("left", &c.lhs), ("right", &c.rhs)]))?;
    }
    if let Some(certificate) = j.counterexample.as_ref().and_then(|c| c.certificate.as_ref()) {
        let certificate = one_line(&language.say(&certificate.to_string()));
        writeln!(text, "      {}", with(w.terminal_certified, &[("text", &certificate)]))?;
    }
    for finding in &j.dimension_findings {
        let message = one_line(&language.say(&finding.message));
        writeln!(text, "      {}", with(w.terminal_dimension_finding, &[("text", &message)]))?;
    }
    for suggestion in &j.suggestions {
        writeln!(text, "      {}", with(w.terminal_perhaps, &[("edit", &one_line(&language.say(&suggestion.edit)))]))?;
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
fn mutants(text: &mut String, document: &DocumentReport, language: Language) -> std::fmt::Result {
    let w = language.words();
    let all: Vec<_> = document.equations.iter().filter_map(|j| j.sensitivity.as_ref().map(|s| (j, s))).collect();
    if all.is_empty() {
        return Ok(());
    }
    let sum = |count: fn(&Sensitivity) -> usize| all.iter().map(|(_, s)| count(s)).sum::<usize>();
    let (killed, different) = (sum(|s| s.killed), sum(|s| s.total - s.equivalent - s.weaker));
    writeln!(text, "  {}", with(w.terminal_mutants, &[("n", &killed), ("m", &different)]))?;
    for (j, s) in all.iter().filter(|(_, s)| !s.survivors.is_empty()) {
        let edits: Vec<String> = s.survivors.iter().take(3).map(|e| one_line(&language.say(e))).collect();
        let more = if s.survivors.len() > 3 { " ..." } else { "" };
        let edits = edits.join("; ") + more;
        let places: [(&str, &dyn Display); 3] =
            [("label", &one_line(&j.label)), ("n", &s.survivors.len()), ("edits", &edits)];
        writeln!(text, "  {}", with(w.terminal_passes, &places))?;
    }
    Ok(())
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
