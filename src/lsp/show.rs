//! What is shown of judgements in an editor: underlines with messages, and what stands under the pointer.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::PathBuf;

use tower_lsp_server::ls_types::{Diagnostic, DiagnosticSeverity, NumberOrString};

use crate::check::inspect::Inspection;
use crate::check::verdict::{Judgement, Verdict};
use crate::document::{Document, Equation, Problem, Severity, Span};
use crate::verify::Verified;

use super::text;

/// The most of a state that is shown, in symbols.
const SYMBOLS: usize = 12;

/// The underlines of all files of notes, by the files' paths.
pub fn diagnostics(verified: &Verified) -> BTreeMap<PathBuf, Vec<Diagnostic>> {
    let document = &verified.document;
    let mut shown: BTreeMap<PathBuf, Vec<Diagnostic>> =
        document.files.iter().map(|file| (file.path.clone(), Vec::new())).collect();
    let mut show = |span: &Span, severity, code: &str, message: String| {
        let Some(file) = document.files.at(span.start) else { return };
        let start = document.files.place(span.start).1;
        let within = start..start + span.len();
        let diagnostic = Diagnostic {
            range: text::range(&file.text, &within),
            severity: Some(severity),
            code: Some(NumberOrString::String(code.to_owned())),
            source: Some("kenzan".into()),
            message,
            ..Diagnostic::default()
        };
        let all = shown.entry(file.path.clone()).or_default();
        if !all.iter().any(|d| d.range == diagnostic.range && d.message == diagnostic.message) {
            all.push(diagnostic);
        }
    };
    for problem in &verified.problems {
        let severity = match problem.severity {
            Severity::Error => DiagnosticSeverity::ERROR,
            Severity::Warning => DiagnosticSeverity::WARNING,
        };
        show(&problem.span, severity, problem.code, with_help(problem));
    }
    for (equation, judgement) in document.equations().zip(&verified.report.equations) {
        of_equation(equation, judgement, &mut show);
    }
    shown
}

fn of_equation(
    equation: &Equation,
    judgement: &Judgement,
    show: &mut dyn FnMut(&Span, DiagnosticSeverity, &str, String),
) {
    let whole = math(equation);
    let label = &judgement.label;
    let severity = match (judgement.as_expected, judgement.verdict) {
        (true, _) => DiagnosticSeverity::INFORMATION,
        (false, Verdict::Undecided) => DiagnosticSeverity::WARNING,
        (false, _) => DiagnosticSeverity::ERROR,
    };
    match judgement.verdict {
        Verdict::Fails => show(&whole, severity, "fails", format!("({label}) fails{}", why(judgement))),
        Verdict::Undecided | Verdict::Unreadable => {
            let (code, word) = match judgement.verdict {
                Verdict::Undecided => ("undecided", "undecided"),
                _ => ("unreadable", "cannot be read"),
            };
            let problems = judgement.problems();
            for problem in &problems {
                show(&problem.span, severity, code, format!("({label}) {word}: {}", with_help(problem)));
            }
            if problems.is_empty() {
                show(&whole, severity, code, format!("({label}) {word}{}", why(judgement)));
            }
        }
        _ if !judgement.as_expected => {
            let message = format!("({label}) is not as expected: it {:?}", judgement.verdict).to_lowercase();
            show(&whole, DiagnosticSeverity::WARNING, "expect", message);
        }
        _ => {}
    }
    for finding in &judgement.dimension_findings {
        show(&whole, DiagnosticSeverity::WARNING, "dimension", format!("({label}) dimensions: {}", finding.message));
    }
}

/// Why, and a state at which the sides differ.
fn why(judgement: &Judgement) -> String {
    let mut text = judgement.reason.as_ref().map(|reason| format!(": {reason}")).unwrap_or_default();
    if let Some(c) = &judgement.counterexample {
        // Writing to a string cannot fail.
        let _ = write!(text, "; for example {} against {}", c.lhs, c.rhs);
        let state: Vec<String> = c.state.iter().take(SYMBOLS).map(|a| format!("{} = {}", a.symbol, a.value)).collect();
        if !state.is_empty() {
            let _ = write!(text, " at {}", state.join(", "));
        }
    }
    text
}

fn with_help(problem: &Problem) -> String {
    let label = problem.label.as_ref().map(|label| format!(": {label}")).unwrap_or_default();
    let help = problem.help.as_ref().map(|help| format!(" ({help})")).unwrap_or_default();
    format!("{}{label}{help}", problem.message)
}

/// The bytes of an equation's mathematics: without the blanks around it, and without a label at its end.
pub fn math(equation: &Equation) -> Span {
    let text = equation.masked.trim_end();
    let start = text.len() - text.trim_start().len();
    equation.span.start + start..equation.span.start + text.len().max(start)
}

/// The bytes of a span in the first file, which is the one in the editor; `None` for what stands in another.
pub fn in_text(document: &Document, span: &Span) -> Option<Span> {
    let (file, start) = document.files.place(span.start);
    (file == 0).then(|| start..start + span.len())
}

/// Whether a span touches some bytes of the first file.
pub fn touches(document: &Document, span: &Span, bytes: &Span) -> bool {
    in_text(document, span).is_some_and(|span| span.start <= bytes.end && bytes.start <= span.end)
}

/// The equation at a byte of the first file, with its place among all.
pub fn at(document: &Document, offset: usize) -> Option<(usize, &Equation)> {
    document.equations().enumerate().find(|(_, e)| touches(document, &e.span, &(offset..offset)))
}

/// What stands under the pointer, in Markdown.
pub fn hover(judgement: &Judgement, inspections: &[Inspection], premises: &[(String, String)]) -> String {
    let mut text = String::new();
    // Writing to a string cannot fail.
    let _ = write_hover(&mut text, judgement, inspections, premises);
    text
}

fn write_hover(
    out: &mut String,
    judgement: &Judgement,
    inspections: &[Inspection],
    premises: &[(String, String)],
) -> std::fmt::Result {
    let word = |v: Verdict| format!("{v:?}").to_lowercase();
    write!(out, "**({})** {}", judgement.label, word(judgement.verdict))?;
    if let Some(strength) = judgement.strength {
        write!(out, ", {}", format!("{strength:?}").to_lowercase())?;
    }
    if let Some(bits) = judgement.bits {
        write!(out, ", to {bits} bits at {} states", judgement.states)?;
    }
    writeln!(out, "{}\n", if judgement.as_expected { "" } else { " (not as expected)" })?;
    if let Some(reason) = &judgement.reason {
        writeln!(out, "{reason}\n")?;
    }
    for link in inspections {
        if let Some((lhs, rhs)) = &link.reading {
            writeln!(out, "read as\n\n```text\n{lhs}\n{rhs}\n```\n")?;
        }
        if let Some(obstacle) = &link.obstacle {
            writeln!(out, "{obstacle}\n")?;
        }
    }
    if let Some(c) = &judgement.counterexample {
        let part = c.component.as_ref().map(|c| format!(" ({c})")).unwrap_or_default();
        writeln!(out, "counterexample{part}\n\n```text\n{}  |  {}", c.lhs, c.rhs)?;
        c.state.iter().take(SYMBOLS).try_for_each(|a| writeln!(out, "{} = {}", a.symbol, a.value))?;
        writeln!(out, "```\n")?;
    }
    if let Some(correction) = &judgement.correction {
        writeln!(
            out,
            "should read, which {}\n\n```latex\n{}\n```\n",
            word(correction.verdict),
            correction.latex.trim()
        )?;
    }
    for (label, latex) in premises {
        writeln!(out, "given ({label})\n\n```latex\n{latex}\n```\n")?;
    }
    for premise in &judgement.assumptions {
        writeln!(out, "where `{premise}`\n")?;
    }
    if let Some(because) = &judgement.because {
        writeln!(out, "{because}")?;
    }
    Ok(())
}
