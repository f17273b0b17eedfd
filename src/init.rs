//! The scaffold of annotations for notes that have none: every symbol with its guessed role and where it first occurs, and
//! what each equation was found to follow from. As a sidecar, `NAME.kenzan.toml`, or as annotations in the notes.

use std::collections::BTreeMap;
use std::fmt::Write;

use crate::check::verdict::{Judgement, Verdict};
use crate::document::{Document, Equation};
use crate::infer::roles::{self, Guess, Role, quoted};
use crate::verify::{self, Request};

/// The scaffold of a document.
pub struct Scaffold {
    /// The sidecar.
    pub sidecar: String,
    /// The declarations alone.
    declarations: String,
    /// What is said of single equations, by their labels: TOML, and remarks in comments.
    equations: BTreeMap<String, String>,
}

/// Guesses, judges and writes down what was found; none where the document declares its symbols already.
pub fn scaffold(document: &Document, request: &Request) -> Option<Scaffold> {
    if roles::declares_symbols(document) {
        return None;
    }
    let guesses = roles::guess(document);
    let verified = verify::verify(document.clone(), request, &|| ());
    let declarations = declarations(document, &guesses);
    let local = roles::local_functions(document, &guesses);
    let mut equations = BTreeMap::new();
    let mut sidecar = format!(
        "# What {} is about, as far as the notes show it. Written by `kenzan init`; yours to edit.\n\
         # A symbol without a range is drawn from 0.3 to 2, and may be solved for with any sign.\n\n{declarations}",
        document.title
    );
    for judgement in &verified.report.equations {
        let mut text = said(judgement);
        for (name, toml) in local.get(&judgement.label).into_iter().flatten() {
            let _ = writeln!(text, "symbols.{} = {toml}", quoted(name));
        }
        if text.is_empty() {
            continue;
        }
        let _ = write!(sidecar, "\n[equation.{}]\n{text}", quoted(&judgement.label));
        equations.insert(judgement.label.clone(), text);
    }
    Some(Scaffold { sidecar, declarations, equations })
}

impl Scaffold {
    /// The notes with the scaffold as annotations in them: declarations before the first display, and what is said of an
    /// equation behind it.
    /// None for notes of several files: there is no one text to put it into.
    pub fn in_place(&self, document: &Document) -> Option<String> {
        let latex = document.path.extension().is_some_and(|e| e == "tex" || e == "ltx");
        let mut files = document.files.iter();
        let text = files.next().filter(|_| files.next().is_none())?.text.as_ref();
        let mut inserted: Vec<(usize, String)> = Vec::new();
        let mut equations = document.equations().peekable();
        if let Some(first) = equations.peek() {
            inserted.push((line_before(text, opening(text, first.span.start)), annotation(&self.declarations, latex)));
        }
        let mut groups: Vec<Vec<&Equation>> = Vec::new();
        for equation in equations {
            match groups.last_mut() {
                Some(group) if group[0].display == equation.display => group.push(equation),
                _ => groups.push(vec![equation]),
            }
        }
        for group in groups {
            let end = group.iter().map(|e| e.span.end).max().unwrap_or_default();
            let several = group.len() > 1;
            let said = group.iter().filter_map(|e| self.equations.get(&e.label).map(|toml| (e, toml)));
            let texts = said.map(|(e, toml)| {
                let whose = if several { format!("for = {}\n", quoted(&e.label)) } else { String::new() };
                annotation(&format!("{whose}{toml}"), latex)
            });
            inserted.push((line_after(text, closing(text, end)), texts.collect()));
        }
        let mut out = text.to_owned();
        for (at, annotation) in inserted.into_iter().rev() {
            out.insert_str(at, &annotation);
        }
        Some(out)
    }
}

/// An annotation in the notes.
fn annotation(toml: &str, latex: bool) -> String {
    match latex {
        true => format!("%! kenzan\n{}", toml.lines().map(|line| format!("%! {line}\n")).collect::<String>()),
        // Two hyphens would end the comment.
        false => format!("<!-- kenzan\n{}-->\n", toml.replace("--", "- -")),
    }
}

/// Where the display that holds a place is opened, at the latest: what is inserted before it stands before its line.
fn opening(text: &str, at: usize) -> usize {
    let before = text.get(..at).unwrap_or_default();
    let openers = ["$$", "\\[", "\\begin{"];
    openers.iter().filter_map(|o| before.rfind(o)).max().unwrap_or(at)
}

/// Behind the delimiter that closes the display which ends at a place.
fn closing(text: &str, at: usize) -> usize {
    let behind = text.get(at..).unwrap_or_default();
    let closers = ["$$", "\\]", "\\end{", "```"];
    closers.iter().filter_map(|c| behind.find(c).map(|k| at + k + c.len())).min().unwrap_or(at)
}

fn line_before(text: &str, at: usize) -> usize {
    text.get(..at).and_then(|before| before.rfind('\n')).map_or(0, |k| k + 1)
}

fn line_after(text: &str, at: usize) -> usize {
    text.get(at..).and_then(|behind| behind.find('\n')).map_or(text.len(), |k| at + k + 1)
}

fn declarations(document: &Document, guesses: &[Guess]) -> String {
    let mut text = String::new();
    let unit = guesses.iter().filter(|g| g.role == Role::UnitVector && g.each.is_empty());
    let assume: Vec<String> = unit.map(|g| quoted(&format!("|{}| = 1", g.name))).collect();
    if !assume.is_empty() {
        let _ = writeln!(text, "assume = [{}]\n", assume.join(", "));
    }
    text.push_str("[symbols]\n");
    let lines: Vec<(String, String)> = guesses.iter().map(|g| (declaration(g), remark(document, g))).collect();
    let width = lines.iter().map(|(toml, _)| toml.chars().count()).max().unwrap_or(0).min(48);
    for (toml, remark) in lines {
        let _ = writeln!(text, "{toml:width$}  # {remark}");
    }
    text
}

/// What a symbol is, in TOML.
fn declaration(guess: &Guess) -> String {
    format!("{} = {}", quoted(&guess.name), roles::toml(&guess.declaration()))
}

fn remark(document: &Document, guess: &Guess) -> String {
    let depends = if guess.moves { ", depends on the time" } else { "" };
    format!("line {}: {}{depends}", document.files.line(guess.at), guess.role.words())
}

/// What was found of an equation, in TOML.
fn said(judgement: &Judgement) -> String {
    let mut text = String::new();
    let Some(inferred) = &judgement.inferred else { return remarks(judgement) };
    let list = |key: &str, values: &[String]| match values {
        [] => String::new(),
        values => format!("{key} = [{}]\n", values.iter().map(|v| quoted(v)).collect::<Vec<_>>().join(", ")),
    };
    if judgement.kind == "law" {
        text.push_str("kind = \"law\"\n");
    }
    text.push_str(&list("solves", &inferred.solves));
    let needs = list("where", &inferred.needs);
    let whole = |link: usize| link == 0 || judgement.links.len() == 1;
    for link in inferred.links.iter().filter(|l| whole(l.number)) {
        text.push_str(&list("given", &link.given));
        let formulas: Vec<String> = link.formulas.iter().chain(&inferred.needs).cloned().collect();
        text.push_str(&list("where", &formulas));
    }
    if !inferred.links.iter().any(|l| whole(l.number)) {
        text.push_str(&needs);
    }
    text.push_str(&remarks(judgement));
    for link in inferred.links.iter().filter(|l| !whole(l.number)) {
        let list = |key: &str, values: &[String]| list(&format!("link.{}.{key}", link.number), values);
        text.push_str(&list("given", &link.given));
        text.push_str(&list("where", &link.formulas));
    }
    text
}

/// What an author has to look at, as comments.
fn remarks(judgement: &Judgement) -> String {
    let mut text = String::new();
    if let Some(suspect) = &judgement.suspect {
        let _ = writeln!(text, "# a suspect: {}", one_line(&suspect.edit));
        let (formulas, labels): (Vec<&String>, Vec<&String>) =
            suspect.premises.iter().partition(|p| p.starts_with('$'));
        let list = |values: Vec<String>| values.iter().map(|v| quoted(v)).collect::<Vec<_>>().join(", ");
        if !labels.is_empty() {
            let _ = writeln!(text, "given = [{}]", list(labels.into_iter().cloned().collect()));
        }
        if !formulas.is_empty() {
            let _ =
                writeln!(text, "where = [{}]", list(formulas.iter().map(|f| f.trim_matches('$').to_owned()).collect()));
        }
    } else if matches!(judgement.verdict, Verdict::Undecided | Verdict::Unreadable) {
        let reason = judgement.reason.as_deref().unwrap_or("not judged");
        let _ = writeln!(text, "# not judged: {}", one_line(reason));
    }
    text
}

fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
