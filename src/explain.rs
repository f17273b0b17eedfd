//! One equation in depth, for the terminal.

use std::fmt::Write;

use crate::check::dimension::Survey;
use crate::check::verdict::{DimensionStatus, Judgement};
use crate::check::{self, Book, Options, Version, inspect::Inspection};
use crate::document::Document;
use crate::infer::{self, Ground, roles};

/// Explains the equation of a label or a number: how it was read, what it rests on, its sides at three states, the verdict. `None`
/// where there is no such label.
pub fn explain(document: &Document, label: &str, options: &Options) -> Option<String> {
    let guesses = roles::guess(document);
    let declared = roles::declare(document, &guesses);
    let mut book = Book::new(&declared);
    let (index, _) = book.find(label).filter(|(index, _)| book.entries[*index].equation.is_called(label))?;
    let mut judgement = match guesses.is_empty() {
        true => check::judge(&book, index, options),
        false => {
            infer::declare_functions(&mut book, &declared);
            Ground::new(&book, &declared, guesses.clone()).explained(&mut book, index, options)
        }
    };
    Survey::new(&book).report(index, &mut judgement);
    let mut text = String::new();
    // Writing to a string cannot fail.
    let _ = write(&mut text, &declared, &book, index, &judgement, options);
    for guess in guesses.iter().filter(|g| book.entries[index].mentions.contains_key(&g.name)) {
        let _ = writeln!(text, "guessed: {} is {}", guess.name, guess.role.words());
    }
    Some(text)
}

fn write(
    out: &mut String,
    document: &Document,
    book: &Book,
    index: usize,
    judgement: &Judgement,
    options: &Options,
) -> std::fmt::Result {
    writeln!(
        out,
        "({}) {}:{}  {}",
        judgement.label,
        document.file(book.entries[index].equation.span.start).display(),
        judgement.line,
        judgement.section
    )?;
    writeln!(out, "\n  {}\n", judgement.latex.trim())?;
    if let Some(reading) = &judgement.reading {
        writeln!(out, "read as: {reading}")?;
    }
    for label in &judgement.given {
        if let Some((k, _)) = book.find(label) {
            let entry = &book.entries[k];
            writeln!(out, "given ({label}): {}", entry.formula(Version::Corrected).latex.trim())?;
        }
    }
    for premise in judgement.assumptions.iter().chain(book.entries[index].scope.assume.iter().map(|a| &a.value)) {
        writeln!(out, "where {premise}")?;
    }
    links(out, "as printed", &check::inspect::inspect(book, index, Version::Printed, options))?;
    if judgement.correction.is_some() {
        links(out, "as corrected", &check::inspect::inspect(book, index, Version::Corrected, options))?;
    }
    verdict(out, judgement)
}

fn links(out: &mut String, title: &str, inspections: &[Inspection]) -> std::fmt::Result {
    for (k, link) in inspections.iter().enumerate() {
        writeln!(out, "\n{title}, link {} of {}: {}", k + 1, inspections.len(), link.latex)?;
        if let Some((lhs, rhs)) = &link.reading {
            writeln!(out, "  left:  {lhs}\n  right: {rhs}")?;
        }
        if !link.drawn.is_empty() {
            let drawn: Vec<String> = link.drawn.iter().map(|(s, [a, b])| format!("{s} in [{a}, {b}]")).collect();
            writeln!(out, "  drawn: {}", drawn.join(", "))?;
        }
        if !link.solved.is_empty() {
            writeln!(out, "  solved from the premises: {}", link.solved.join(", "))?;
        }
        for (n, state) in link.states.iter().enumerate() {
            let symbols: Vec<String> = state.symbols.iter().map(|a| format!("{} = {}", a.symbol, a.value)).collect();
            writeln!(out, "  state {}: {}", n + 1, symbols.join(", "))?;
            for (name, lhs, rhs) in &state.sides {
                let name = name.as_ref().map(|n| format!("{n}: ")).unwrap_or_default();
                writeln!(out, "    {name}{lhs}  |  {rhs}")?;
            }
        }
        if let Some(obstacle) = &link.obstacle {
            writeln!(out, "  {obstacle}")?;
        }
    }
    Ok(())
}

fn verdict(out: &mut String, judgement: &Judgement) -> std::fmt::Result {
    let name = |v: crate::check::verdict::Verdict| format!("{v:?}").to_lowercase();
    writeln!(out, "\nverdict: {}", name(judgement.verdict))?;
    if let Some(bits) = judgement.bits {
        writeln!(out, "  both sides agree to {bits} bits at {} states", judgement.states)?;
    }
    if let Some(lost) = judgement.lost_bits {
        writeln!(out, "  doubles lose {} bits, at worst {}", lost.mean, lost.worst)?;
    }
    for link in &judgement.links {
        let reason = link.reason.as_ref().map(|r| format!(": {r}")).unwrap_or_default();
        writeln!(out, "  {}  {}{reason}", name(link.verdict), link.latex)?;
        if let Some(exact) = &link.exact {
            writeln!(out, "    exact: {} trials, false with a chance below 2^{}", exact.trials, exact.log2_error)?;
        }
        if let Some(why) = &link.inexact {
            writeln!(out, "    not exact: {why}")?;
        }
        if let Some(counterexample) = &link.counterexample {
            if let Some(certificate) = &counterexample.certificate {
                writeln!(out, "    certified: {certificate}")?;
            }
            if let Some(why) = &counterexample.uncertified {
                writeln!(out, "    not certified: {why}")?;
            }
        }
        if let Some(order) = &link.order {
            writeln!(out, "    order in {}: {:.3} measured, {} claimed", order.small, order.measured, order.claimed)?;
        }
    }
    if let Some(correction) = &judgement.correction {
        writeln!(out, "  corrected: {}: {}", name(correction.verdict), correction.latex.trim())?;
    }
    let dimension = match judgement.dimension {
        DimensionStatus::Ok => "the terms have one dimension",
        DimensionStatus::Unchecked => "not checked",
        DimensionStatus::Mismatch => "the terms differ",
    };
    writeln!(out, "  dimensions: {dimension}")?;
    for finding in &judgement.dimension_findings {
        writeln!(out, "    {}", finding.message)?;
        for term in &finding.terms {
            writeln!(out, "      {}: {}", term.latex, term.dimension)?;
        }
    }
    if let Some(because) = &judgement.because {
        writeln!(out, "  {because}")?;
    }
    Ok(())
}
