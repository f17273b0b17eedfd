//! Putting together what was found in notes: labels are given, and annotations go to their equations.

use super::annotation::{self, About, EquationAnnotation};
use super::declaration;
use super::display::{BlockRows, Display};
use super::files::Files;
use super::layout::trimmed;
use super::place::{Span, Spanned, first_line, is_right_before};
use super::problem::Problem;
use super::scan::{Found, directive};
use super::sidecar::Sidecar;
use super::tex::number::{Counted, Counter};
use super::toml::{self, Reader};
use super::{Document, Equation, Item, Section};
use crate::latex::expand::{Definitions, Macros};
use std::collections::HashMap;
use std::path::Path;
use std::sync::Arc;

/// A part of the text that matters.
pub(super) enum Part {
    Heading(Section),
    /// An inline formula with its delimiters, and what stands between them.
    Formula(Span, Span),
    Found(Found),
    /// An annotation in comment lines: its place, and its TOML, which begins there.
    Annotation(Span, String),
    /// From here on so many definitions are in force.
    Defined(usize, usize),
    /// Something that LaTeX counts.
    Counted(usize, Counted),
}

impl Part {
    /// Where it begins.
    pub(super) fn start(&self) -> usize {
        match self {
            Part::Heading(section) => section.span.start,
            Part::Formula(span, _) | Part::Annotation(span, _) => span.start,
            Part::Found(found) => found.span().start,
            Part::Defined(start, _) | Part::Counted(start, _) => *start,
        }
    }
}

/// What an annotation may belong to.
enum Target {
    /// No equation stands before it in this section.
    Nothing,
    /// A damaged display, already reported.
    Damaged,
    /// The equations of a display or an inline formula: `count` items from `first` on.
    Equations { first: usize, count: usize, display: Option<LastDisplay> },
}

/// A display as it was found, to take it apart again when an annotation asks for its rows.
#[derive(Clone)]
struct LastDisplay {
    content: Span,
    /// Where the line begins that it is opened in.
    line: usize,
    environment: Option<String>,
    /// The last label printed before it.
    previous: Option<String>,
}

impl LastDisplay {
    fn take_apart<'a>(&self, source: &'a str) -> Display<'a> {
        Display::new(source, self.content.clone(), self.line, self.environment.as_deref(), self.previous.as_deref())
    }
}

/// The document as far as it has been put together.
pub(super) struct Assembly<'a> {
    pub(super) source: &'a str,
    /// The source in which what is no part of the notes (comments, definitions) is blank.
    pub(super) clean: &'a str,
    files: Files,
    pub(super) items: Vec<Item>,
    pub(super) problems: Vec<Problem>,
    /// The inline formulas, without their delimiters.
    formulas: Vec<Span>,
    expanded: Vec<String>,
    /// All labels with the places where they are printed or given.
    pub(super) labels: HashMap<String, Span>,
    /// The last label printed.
    previous: Option<String>,
    /// The number of labels that have been made up since.
    unnumbered: usize,
    displays: usize,
    target: Target,
    /// The last inline formula, with its delimiters, and what stands between them.
    formula: Option<(Span, Span)>,
    definitions: Arc<Definitions>,
    macros: Macros,
    /// What counts equations as LaTeX does.
    counter: Option<Counter>,
    pub(super) sidecar: Option<Sidecar>,
}

impl<'a> Assembly<'a> {
    pub(super) fn new(
        source: &'a str,
        clean: &'a str,
        files: Files,
        definitions: Definitions,
        problems: Vec<Problem>,
    ) -> Self {
        let definitions = Arc::new(definitions);
        Assembly {
            source,
            clean,
            files,
            items: Vec::new(),
            problems,
            formulas: Vec::new(),
            expanded: Vec::new(),
            labels: HashMap::new(),
            previous: None,
            unnumbered: 0,
            displays: 0,
            target: Target::Nothing,
            formula: None,
            macros: Macros::until(&definitions, 0),
            definitions,
            counter: None,
            sidecar: None,
        }
    }

    /// With a sidecar, whose declarations hold for all of the notes.
    pub(super) fn beside(mut self, sidecar: Option<Sidecar>) -> Self {
        self.sidecar = sidecar;
        let declarations = self.sidecar.as_mut().and_then(|sidecar| sidecar.declarations.take());
        self.items.extend(declarations.map(Item::Declarations));
        self
    }

    /// Counts equations as LaTeX does.
    pub(super) fn counting(self, counter: Counter) -> Self {
        Assembly { counter: Some(counter), ..self }
    }

    /// The document, when all parts have been added. Without a title of its own it is called by its highest heading.
    pub(super) fn document(mut self, path: &Path, title: Option<String>) -> Document {
        self.check_sidecar();
        self.problems.sort_by_key(|problem| problem.span.start);
        let name = path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
        Document {
            title: title.unwrap_or_else(|| name.clone()),
            name,
            path: path.to_owned(),
            source: Arc::from(self.source),
            items: self.items,
            problems: self.problems,
            files: self.files,
            formulas: self.formulas,
            expanded: self.expanded,
        }
    }

    /// The title of the first heading that is none higher in the notes.
    pub(super) fn highest_heading(&self) -> Option<&Section> {
        let headings = self.items.iter().filter_map(|item| match item {
            Item::Section(section) => Some(section),
            _ => None,
        });
        headings.min_by_key(|section| section.level)
    }

    /// Adds the next part of the text.
    pub(super) fn add(&mut self, part: Part) {
        match part {
            Part::Heading(section) => {
                self.target = Target::Nothing;
                let declarations = self.sidecar.as_mut().and_then(|sidecar| sidecar.section(&section.title));
                self.items.push(Item::Section(section));
                self.items.extend(declarations.map(Item::Declarations));
            }
            Part::Formula(span, content) => {
                let formula = trimmed(self.source, content.clone());
                let latex = self.clean.get(formula.clone()).unwrap_or_default();
                self.expanded.push(self.macros.expand(latex).map_or_else(|_| latex.to_owned(), |found| found.text));
                self.formulas.push(formula);
                self.formula = Some((span, content));
            }
            Part::Annotation(span, text) => self.annotation(span.clone(), &text, span.start),
            Part::Defined(_, count) => self.macros = Macros::until(&self.definitions, count),
            Part::Counted(_, counted) => {
                if let Some(counter) = &mut self.counter {
                    counter.count(counted);
                }
            }
            Part::Found(Found::Display { span, content, environment, name }) => {
                self.display(span.start, content, environment, name);
            }
            Part::Found(Found::Broken { .. }) => {
                self.target = Target::Damaged;
                self.formula = None;
            }
            Part::Found(Found::Comment { span, content }) => self.comment(span, content),
        }
    }

    fn display(&mut self, start: usize, content: Span, environment: Option<String>, name: Option<(String, Span)>) {
        let line = self.files.line_start(start);
        let last = LastDisplay { content, line, environment, previous: self.previous.clone() };
        let display = last.take_apart(self.clean);
        let counted = self.counter.as_mut().map(|counter| display.numbers(last.environment.as_deref(), counter));
        let mut parts = display.parts(&mut self.problems);
        if let (Some(name), Some(part)) = (name, parts.last_mut()) {
            match part.label {
                Some(_) => part.names.push(name.0),
                None => part.label = Some(name),
            }
        }
        let first = self.items.len();
        let mut counted = counted.into_iter().flatten().peekable();
        for mut part in parts {
            part.names.extend(
                std::iter::from_fn(|| counted.next_if(|(at, _)| *at < part.rows.end)).map(|(_, number)| number),
            );
            if part.label.is_none() {
                let free = part.names.iter().find(|name| !self.labels.contains_key(*name));
                part.label = free.map(|name| (name.clone(), part.span.clone()));
            }
            let numbered = part.label.is_some();
            let label = self.printed_label(part.label);
            let masked = display.masked(part.span.clone());
            let equation = self.equation(label, part.span, masked);
            self.items.push(Item::Equation(Equation { numbered, numbers: part.names, ..equation }));
        }
        self.displays += 1;
        self.target = Target::Equations { first, count: self.items.len() - first, display: Some(last) };
        self.annotate_beside(first);
    }

    fn equation(&self, label: String, span: Span, masked: String) -> Equation {
        Equation {
            label,
            numbered: false,
            numbers: Vec::new(),
            file: Some(&span)
                .filter(|span| self.files.place(span.start).0 > 0)
                .and_then(|span| self.files.at(span.start))
                .map(|file| file.path.clone()),
            line: self.files.line(span.start),
            latex: self.source.get(span.clone()).unwrap_or_default().to_owned(),
            masked,
            span,
            prefix: String::new(),
            display: self.displays,
            inline: false,
            macros: self.macros.clone(),
            annotation: None,
        }
    }

    /// The label of an equation that prints one, or none.
    fn printed_label(&mut self, printed: Option<(String, Span)>) -> String {
        let Some((label, span)) = printed else { return self.made_up_label() };
        if !self.claim(&label, &span) {
            return self.made_up_label();
        }
        self.previous = Some(label.clone());
        self.unnumbered = 0;
        label
    }

    fn made_up_label(&mut self) -> String {
        loop {
            self.unnumbered += 1;
            let label = format!("{}+{}", self.previous.as_deref().unwrap_or("0"), self.unnumbered);
            if !self.labels.contains_key(&label) {
                return label;
            }
        }
    }

    /// Takes a label, if it is still free; otherwise it is a problem.
    fn claim(&mut self, label: &str, span: &Span) -> bool {
        let Some(first) = self.labels.get(label) else {
            self.labels.insert(label.to_owned(), span.clone());
            return true;
        };
        let message = format!("the label {label} is given twice");
        let problem = Problem::error("document::duplicate_label", message, trimmed(self.source, span.clone()));
        let help = format!("give it a label of its own; references to {label} mean the first");
        let first = trimmed(self.source, first.clone());
        self.problems.push(problem.label("here again").other(first, "first here").help(help));
        false
    }

    fn comment(&mut self, span: Span, content: Span) {
        let source = self.source;
        let Some(text) = source.get(content.clone()).and_then(directive) else { return };
        self.annotation(span, text, content.end - text.len());
    }

    /// Reads the TOML of an annotation, which begins at a byte of the source.
    fn annotation(&mut self, span: Span, text: &str, offset: usize) {
        let source = toml::Source { text, offset, macros: &self.macros };
        let Some(table) = toml::parse(source, &mut self.problems) else { return };
        let problems_before = self.problems.len();
        let mut reader = Reader { problems: &mut self.problems };
        match annotation::about(&table, &mut reader) {
            About::Section => {
                let declarations = declaration::declarations(&table, span, &mut reader);
                self.items.push(Item::Declarations(declarations));
            }
            About::Equation => {
                let annotation = annotation::equation(&table, span, &mut reader);
                self.annotate(annotation);
            }
            About::Nothing if self.problems.len() == problems_before => {
                let problem = Problem::warning("document::empty_annotation", "this annotation is empty", span);
                self.problems.push(problem.help("remove it, or write a key: given = ['39']"));
            }
            About::Nothing => {}
        }
    }

    /// Gives an annotation to the equation that it belongs to.
    pub(super) fn annotate(&mut self, annotation: EquationAnnotation) {
        if let Some(label) = &annotation.label
            && !self.is_beside(&annotation.span)
            && let Some((_, formula)) =
                self.formula.take_if(|(formula, _)| is_right_before(self.source, formula, &annotation.span))
        {
            self.inline(formula, label);
        } else if matches!(self.target, Target::Damaged) {
            return;
        }
        if !annotation.rows.is_empty() {
            self.split_rows(&annotation.rows);
            let only_rows = EquationAnnotation {
                span: annotation.span.clone(),
                rows: annotation.rows.clone(),
                ..EquationAnnotation::default()
            };
            if annotation == only_rows {
                return;
            }
        }
        let Some(index) = self.target_of(&annotation) else { return };
        if let Some(label) = &annotation.label {
            self.rename(index, label);
        }
        let Some(Item::Equation(equation)) = self.items.get_mut(index) else { return };
        let label = equation.label.clone();
        match equation.annotation.take() {
            None => equation.annotation = Some(annotation),
            Some(first) if self.sidecar.as_ref().is_some_and(|sidecar| sidecar.holds(&first.span)) => {
                let places = [first.span.clone(), annotation.span.clone()];
                let (merged, twice) = annotation.over(first);
                equation.annotation = Some(merged);
                self.said_twice(&label, &twice, places);
            }
            Some(first) => {
                let place = first.span.clone();
                equation.annotation = Some(first);
                let message = format!("a second annotation for equation {label}");
                let problem =
                    Problem::error("document::second_annotation", message, first_line(self.source, &annotation.span));
                let first = first_line(self.source, &place);
                self.problems.push(problem.label("passed over").other(first, "the first").help(
                    "put all keys of an equation into one annotation, or say with `for = '..'` which label is meant",
                ));
            }
        }
    }

    /// An inline formula becomes an equation, by an annotation that labels it.
    fn inline(&mut self, formula: Span, label: &Spanned<String>) {
        let name = if self.claim(&label.value, &label.span) { label.value.clone() } else { self.made_up_label() };
        let span = trimmed(self.source, formula);
        let masked = self.clean.get(span.clone()).unwrap_or_default().to_owned();
        let equation = self.equation(name, span, masked);
        let first = self.items.len();
        self.items.push(Item::Equation(Equation { inline: true, ..equation }));
        self.displays += 1;
        self.target = Target::Equations { first, count: 1, display: None };
        self.annotate_beside(first);
    }

    /// The item that an annotation belongs to; otherwise that is a problem.
    fn target_of(&mut self, annotation: &EquationAnnotation) -> Option<usize> {
        let Target::Equations { first, count, .. } = self.target else {
            let span = first_line(self.source, &annotation.span);
            let problem =
                Problem::error("document::no_equation_before", "there is no equation before this annotation", span);
            self.problems.push(problem.label("has keys of an equation").help(
                "put it directly after its display; after an inline formula it needs `label = '..'`; \
                 only symbols, basis and assume can stand alone",
            ));
            return None;
        };
        let Some(wanted) = &annotation.for_label else { return (first + count).checked_sub(1) };
        let items = self.items.get(first..first + count).unwrap_or_default();
        let labels: Vec<&str> = items
            .iter()
            .filter_map(|item| match item {
                Item::Equation(equation) => Some(equation.label.as_str()),
                _ => None,
            })
            .collect();
        if let Some(at) = labels.iter().position(|label| *label == wanted.value) {
            return Some(first + at);
        }
        let message = format!("the display before has no label {}", wanted.value);
        let problem = Problem::error("document::no_such_label", message, wanted.span.clone());
        let help = format!("it has: {}", labels.join(", "));
        self.problems.push(problem.label("not found").help(help));
        None
    }

    /// Gives a label to a display that prints none. An inline formula has got its label before.
    fn rename(&mut self, index: usize, label: &Spanned<String>) {
        let Some(Item::Equation(equation)) = self.items.get(index) else { return };
        if equation.inline || equation.label == label.value {
            return;
        }
        if equation.numbered {
            let message = format!("equation {} has a label already", equation.label);
            let problem = Problem::error("document::labelled_twice", message, label.span.clone());
            let help = "leave out `label`; refer to the printed one";
            self.problems.push(problem.label("cannot have another").help(help));
        } else if self.claim(&label.value, &label.span)
            && let Some(Item::Equation(equation)) = self.items.get_mut(index)
        {
            equation.label.clone_from(&label.value);
        }
    }

    /// Makes an equation of each row of the display before, if that can be done; otherwise it is a problem.
    fn split_rows(&mut self, labels: &[Spanned<String>]) {
        let (first, whole, display, block) = match self.rows_to_label(labels) {
            Ok(found) => found,
            Err([message, label, help]) => {
                let start = labels.first().map_or(0, |label| label.span.start);
                let end = labels.last().map_or(start, |label| label.span.end);
                let problem = Problem::error("document::rows", message, start..end);
                return self.problems.push(problem.label(label).help(help));
            }
        };
        let mut rows = Vec::new();
        for (label, span) in block.labelled(labels) {
            let is_own = whole.numbered && whole.label == label.value;
            let free = is_own || self.claim(&label.value, &label.span);
            let name = if free { label.value.clone() } else { self.made_up_label() };
            let equation = self.equation(name, span.clone(), display.masked(span));
            let (prefix, display) = (block.prefix.clone(), whole.display);
            rows.push(Item::Equation(Equation { numbered: is_own, prefix, display, ..equation }));
        }
        if let Some(last) = labels.last().filter(|_| whole.numbered) {
            self.previous = Some(last.value.clone());
            self.unnumbered = 0;
        }
        self.target = Target::Equations { first, count: rows.len(), display: None };
        self.items.splice(first..first + 1, rows);
    }

    /// The display before, if its rows can have these labels: its item, its equation, its parts and its block. Otherwise
    /// why not: message, note and help.
    fn rows_to_label(
        &self,
        labels: &[Spanned<String>],
    ) -> Result<(usize, Equation, Display<'a>, BlockRows), [String; 3]> {
        let because = |message: &str, help: &str| Err([message, "the labels of its rows", help].map(str::to_owned));
        let Target::Equations { first, count, display: Some(last) } = &self.target else {
            return because("`rows` needs a display before it", "put the annotation directly after the display");
        };
        let Some(Item::Equation(whole)) = self.items.get(*first) else {
            return because("`rows` needs a display before it", "put the annotation directly after the display");
        };
        if whole.annotation.is_some() {
            return because("`rows` comes too late", "put it into the first annotation of the display");
        }
        let display = last.take_apart(self.clean);
        let Some(block) = display.block_rows().filter(|_| *count == 1) else {
            return because(
                "the display has no block whose rows could be labelled",
                "it must hold exactly one `cases`, `aligned` or `array`, and its rows no labels of their own",
            );
        };
        if block.rows.len() != labels.len() {
            let message = format!("the block has {} rows, but {} labels are given", block.rows.len(), labels.len());
            return because(&message, "give one label for each row");
        }
        if !block.accepts(labels) {
            let help = "only the rows of `aligned` and the like can belong to the label below them";
            return because("a row without a label", help);
        }
        Ok((*first, whole.clone(), display, block))
    }
}
