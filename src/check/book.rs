//! A document ready to be judged: every formula parsed, every equation with the declarations in force where it stands.

use std::borrow::Cow;
use std::collections::{HashMap, HashSet};
use std::sync::{Arc, OnceLock};

use rayon::prelude::*;

use crate::document::{Declarations, Document, Equation, EquationAnnotation, Item, LinkPremises, Problem, Spanned};
use crate::latex::ast::{Kind, Node};
use crate::latex::expand::{Expanded, Macros};
use crate::latex::{self, ParseError};
use crate::semantics::{self, Scope, Statement};

use super::circle::{Circle, circles};
use super::entries::Entries;
use super::formulas::Formulas;
use crate::trace::{self, unrecorded};

/// The longest formula that is judged, in bytes: ten pages.
const LONGEST: usize = 1 << 16;

/// The most equations that one after another continue each other.
const LONGEST_CHAIN: usize = 100;

/// A formula in LaTeX with its tree.
#[derive(Clone, Debug)]
pub struct Formula {
    /// The LaTeX that was parsed, its macros expanded.
    pub latex: String,
    /// Where what was parsed comes from.
    pub expanded: Expanded,
    /// Its tree, or why it could not be read.
    pub tree: Result<Node, ParseError>,
}

impl Formula {
    /// Reads LaTeX whose macros have been expanded.
    pub fn new(latex: &str) -> Self {
        Self::read(Expanded::verbatim(latex))
    }

    /// Reads LaTeX with macros. An error of their expansion is placed in the LaTeX as it is written.
    pub fn with_macros(latex: &str, macros: &Macros) -> Self {
        match macros.expand(latex.get(..LONGEST + 1).unwrap_or(latex)) {
            Ok(expanded) => Self::read(expanded),
            Err(error) => Formula { tree: Err(error), ..Self::read(Expanded::verbatim(latex)) },
        }
    }

    /// A formula that has been made and not printed.
    pub fn made(latex: String, tree: Node) -> Self {
        Formula { expanded: Expanded::verbatim(&latex), latex, tree: Ok(tree) }
    }

    fn read(expanded: Expanded) -> Self {
        let latex = expanded.text.clone();
        let tree = if latex.len() <= LONGEST { latex::parse(&latex) } else { Err(too_long(&latex)) };
        Formula { latex, expanded, tree }
    }
}

fn too_long(latex: &str) -> ParseError {
    let message = format!("a formula of {} bytes; at most {LONGEST} are read", latex.len());
    ParseError { message, span: 0..0, help: Some("is a `$$` missing somewhere before?".into()) }
}

/// Which version of an equation is meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Version {
    /// As printed, or as its `reading` restates it.
    Printed,
    /// As corrected, where a correction is given.
    Corrected,
}

/// An equation of a [`Book`].
#[derive(Clone, Debug)]
pub struct Entry {
    /// The equation as it was read.
    pub equation: Equation,
    /// The declarations in force.
    pub scope: Arc<Scope>,
    /// The heading it stands under.
    pub section: String,
    /// The formula as printed, its label blanked out.
    pub printed: Arc<Formula>,
    /// The `reading`.
    pub reading: Option<Arc<Formula>>,
    /// The `correction`.
    pub correction: Option<Arc<Formula>>,
    /// The equation before it, which it continues if it begins with a relation.
    pub previous: Option<usize>,
    /// The declared symbols it mentions: the pattern, and where it is declared, which tells apart the symbols of different
    /// sections that are spelt alike.
    pub mentions: HashMap<String, usize>,
    /// It taken apart as printed and as corrected, once that was asked for.
    pub(super) statements: [OnceLock<Result<Statement, Unclear>>; 2],
}

impl Entry {
    /// The formula of a version.
    pub fn formula(&self, version: Version) -> &Formula {
        match (version, &self.correction, &self.reading) {
            (Version::Corrected, Some(correction), _) => correction,
            (_, _, Some(reading)) => reading,
            _ => &self.printed,
        }
    }

    /// Its annotation.
    pub fn annotation(&self) -> Option<&EquationAnnotation> {
        self.equation.annotation.as_ref()
    }

    /// Its annotation's list under a key.
    pub fn list(&self, key: fn(&EquationAnnotation) -> &Vec<Spanned<String>>) -> &[Spanned<String>] {
        self.annotation().map_or(&[], |a| key(a))
    }

    /// The labels of the equations that a link (from 0) is judged on; without one, that any of its links is.
    pub fn given(&self, link: Option<usize>) -> Vec<&Spanned<String>> {
        self.of_links(link, |a| &a.given, |l| &l.given)
    }

    /// The premises of the prose that a link (from 0) is judged on; without one, that any of its links is.
    pub fn wheres(&self, link: Option<usize>) -> Vec<&Spanned<String>> {
        self.of_links(link, |a| &a.where_, |l| &l.where_)
    }

    fn of_links<'a>(
        &'a self,
        link: Option<usize>,
        own: fn(&EquationAnnotation) -> &Vec<Spanned<String>>,
        of_link: fn(&'a LinkPremises) -> &'a Vec<Spanned<String>>,
    ) -> Vec<&'a Spanned<String>> {
        let links = self.annotation().into_iter().flat_map(|a| &a.link);
        let links = links.filter(|l| link.is_none_or(|k| k + 1 == l.number));
        self.list(own).iter().chain(links.flat_map(of_link)).collect()
    }
}

/// An equation where it stands, its formulas not yet read.
struct Place<'d> {
    equation: &'d Equation,
    scope: Arc<Scope>,
    section: String,
    previous: Option<usize>,
}

impl Place<'_> {
    fn read(self, formulas: &Formulas) -> Entry {
        let Place { equation, scope, section, previous } = self;
        let annotation = equation.annotation.as_ref();
        let printed = formulas.read_with(&format!("{}{}", equation.prefix, equation.masked), &equation.macros);
        let formula = |text: &Option<Spanned<String>>| text.as_ref().map(|t| formulas.read(&t.value));
        let reading = annotation.and_then(|a| formula(&a.reading));
        let correction = annotation.and_then(|a| formula(&a.correction));
        let mut mentions = HashSet::new();
        for f in [Some(&printed), reading.as_ref(), correction.as_ref()].into_iter().flatten() {
            if let Ok(tree) = &f.tree {
                semantics::mentions(&scope, tree, &mut mentions);
            }
        }
        let mentions: HashMap<String, usize> =
            mentions.into_iter().filter_map(|m| scope.get(&m).map(|e| e.declared).map(|d| (m, d))).collect();
        let (equation, statements) = (equation.clone(), Default::default());
        Entry { equation, scope, section, printed, reading, correction, previous, mentions, statements }
    }
}

/// A document ready to be judged.
#[derive(Clone, Debug, Default)]
pub struct Book {
    /// The equations in order.
    pub entries: Entries,
    /// What is wrong with the declarations.
    pub problems: Vec<Problem>,
    labels: HashMap<String, usize>,
    /// The numbers that LaTeX prints beside equations that the notes call by other names.
    numbers: HashMap<String, usize>,
    /// The equations that mention a symbol, in order, by its pattern.
    mentioned: HashMap<String, Vec<usize>>,
    circles: HashMap<usize, Circle>,
}

impl Book {
    /// Parses every formula of a document and works out the scope of every equation.
    pub fn new(document: &Document) -> Self {
        Book::with(document, &Formulas::default())
    }

    /// As [`Book::new`], without parsing again what has been parsed before.
    pub fn with(document: &Document, formulas: &Formulas) -> Self {
        formulas.turn();
        let mut book = Book::default();
        let mut places = Vec::new();
        let mut scopes = Scopes::default();
        let mut section = String::new();
        let mut previous = None;
        for item in &document.items {
            match item {
                Item::Section(s) => {
                    scopes.enter(s.level);
                    section.clone_from(&s.title);
                }
                Item::Declarations(block) => {
                    let problems = scopes.declare(block);
                    book.problems.extend(problems);
                }
                Item::Equation(equation) => {
                    let scope = book.scope(equation, &scopes.current());
                    let after = if equation.inline { previous } else { previous.replace(places.len()) };
                    places.push(Place { equation, scope, section: section.clone(), previous: after });
                }
            }
        }
        let entries: Vec<Entry> = places.into_par_iter().map(|place| place.read(formulas)).collect();
        entries.into_iter().for_each(|entry| book.add(entry));
        book.check_references();
        book
    }

    /// The scope of an equation: that of its section, with what it declares for itself.
    fn scope(&mut self, equation: &Equation, scope: &Arc<Scope>) -> Arc<Scope> {
        match &equation.annotation {
            Some(a) if !a.symbols.is_empty() => Arc::new(scope.with_local(&a.symbols, &mut self.problems)),
            _ => Arc::clone(scope),
        }
    }

    fn add(&mut self, entry: Entry) {
        let (equation, index) = (&entry.equation, self.entries.len());
        self.labels.entry(equation.label.clone()).or_insert(index);
        for number in &equation.numbers {
            self.numbers.entry(number.clone()).or_insert(index);
        }
        for pattern in entry.mentions.keys() {
            self.mentioned.entry(pattern.clone()).or_default().push(index);
        }
        self.entries.push(entry);
    }

    /// The equation that a reference means, with the statement of it, counted from 1, where one is named: `75.2`.
    pub fn find(&self, reference: &str) -> Option<(usize, Option<usize>)> {
        trace::reference(reference);
        if let Some(index) = self.labels.get(reference).or_else(|| self.numbers.get(reference)) {
            return Some((*index, None));
        }
        let (label, part) = reference.rsplit_once('.')?;
        Some((*self.labels.get(label)?, Some(part.parse().ok()?)))
    }

    /// The equation of a label.
    pub(super) fn labelled(&self, label: &str) -> Option<usize> {
        self.labels.get(label).copied()
    }

    /// The equations up to so many places before and behind one, the nearest first.
    pub fn around(&self, index: usize, reach: usize) -> Vec<usize> {
        trace::around(index, reach);
        let mut around: Vec<usize> =
            (index.saturating_sub(reach)..=index + reach).filter(|k| *k != index && *k < self.entries.len()).collect();
        around.sort_by_key(|k| k.abs_diff(index));
        around
    }

    /// References to equations and links that do not exist, and `given`s that go in a circle.
    fn check_references(&mut self) {
        let given = |e: &Entry| {
            e.given(None).iter().filter_map(|g| self.find(&g.value)).map(|(k, _)| k).collect::<Vec<usize>>()
        };
        self.circles = circles(&self.entries.iter().map(given).collect::<Vec<_>>());
        let mut problems = Vec::new();
        for (index, entry) in self.entries.iter().enumerate() {
            problems.extend(self.missing_links(index));
            let references = entry.given(None).into_iter().chain(entry.list(|a| &a.solves));
            for reference in references {
                if self.find(&reference.value).is_none() {
                    let message = format!("there is no equation {}", reference.value);
                    problems.push(Problem::error("kenzan::reference", message, reference.span.clone()).help(
                        "name a printed label, or for a display without a number the label before it with +1, +2 ...",
                    ));
                }
            }
            if let (Some(circle), Some(text)) = (self.circles.get(&index), self.circle(index))
                && circle.is_told_at(index)
                && let Some(first) = entry.given(None).first()
            {
                let message = format!("the premises go in a circle: {text}");
                problems.push(
                    Problem::error("kenzan::circle", message, first.span.clone())
                        .help("an equation cannot be derived from one that is derived from it"),
                );
            }
        }
        self.problems.extend(problems);
    }

    /// Premises for links that an equation has not.
    fn missing_links(&self, index: usize) -> Vec<Problem> {
        let premises = self.entries[index].annotation().into_iter().flat_map(|a| &a.link);
        if premises.clone().next().is_none() {
            return Vec::new();
        }
        let versions = [Version::Printed, Version::Corrected];
        let counts = versions.iter().filter_map(|v| self.statement(index, *v).ok()).map(|s| s.clauses.len());
        let Some(count) = counts.max() else { return Vec::new() };
        let missing = premises.filter(|l| l.number > count);
        missing
            .map(|l| {
                let message = format!("the equation has no link {}", l.number);
                let help = format!("it has {count}: a = b = c has two, a = b and b = c");
                Problem::error("kenzan::link", message, l.span.clone()).label("premises for it").help(help)
            })
            .collect()
    }

    /// The circle of `given`s through an equation, by labels, if there is one: `1 → 2 → 1`.
    pub fn circle(&self, index: usize) -> Option<String> {
        trace::circle(index);
        Some(self.circles.get(&index)?.text(|k| self.entries.quietly(k).equation.label.clone()))
    }

    /// An equation taken apart. One that begins with a relation continues the equation before, as corrected.
    pub fn statement(&self, index: usize, version: Version) -> Result<Statement, Unclear> {
        let entry = &self.entries[index];
        let tree = entry.formula(version).tree.as_ref().map_err(|e| Unclear::Latex(e.clone()))?;
        // What depends on another equation, or on what is declared, is taken apart each time.
        if semantics::begins_with_relation(tree) || matches!(tree.kind, Kind::List(_)) {
            return self.statement_of(index, tree);
        }
        entry.statements[version as usize].get_or_init(|| self.statement_of(index, tree)).clone()
    }

    /// As [`Book::statement`], for a tree that stands in the place of the equation's own.
    pub fn statement_of(&self, index: usize, tree: &Node) -> Result<Statement, Unclear> {
        let before =
            |at: usize, message: &str| Unclear::Before(self.entries[at].equation.label.clone(), message.to_owned());
        // The formulas that are continued, the last first.
        let mut chain = vec![(index, tree)];
        let mut at = index;
        while semantics::begins_with_relation(chain[chain.len() - 1].1) {
            trace::continued(at);
            let Some(previous) = self.entries[at].previous else { break };
            at = previous;
            if chain.len() > LONGEST_CHAIN {
                return Err(before(at, &format!("more than {LONGEST_CHAIN} equations continue each other")));
            }
            let formula = self.entries[at].formula(Version::Corrected);
            chain.push((at, formula.tree.as_ref().map_err(|e| before(at, &e.message))?));
        }
        let mut statement: Option<Statement> = None;
        for (at, tree) in chain.into_iter().rev() {
            // What an approximation leaves out is measured and not read.
            let approximates =
                self.entries[at].annotation().is_some_and(|a| a.small.is_some() || !a.harmonics.is_empty());
            let tree = if approximates { Cow::Owned(semantics::without_remainder(tree)) } else { Cow::Borrowed(tree) };
            let tree = semantics::without_index_ranges(&tree, &self.entries[at].scope);
            statement = Some(semantics::statement(&tree, statement.as_ref()).map_err(|e| match at {
                _ if at == index => Unclear::Meaning(e),
                _ => before(at, &e.message),
            })?);
        }
        statement.ok_or_else(|| Unclear::Meaning(semantics::Error::unsupported("nothing is printed here", &(0..0))))
    }

    /// Whether a symbol is mentioned by an equation before this one that does not rest on this one, or by one that this
    /// one rests on.
    pub fn mentioned_before(&self, index: usize, pattern: &str) -> bool {
        trace::mentioned(index, pattern);
        let entry = |k: usize| self.entries.quietly(k);
        let declared = |k: usize| entry(k).mentions.get(pattern).copied();
        unrecorded(|| {
            let own = entry(index).scope.get(pattern).map(|e| e.declared);
            let rests = |k: usize| self.given_to(k).contains(&index);
            let mut earlier = self.mentioned.get(pattern).into_iter().flatten().take_while(|k| **k < index);
            earlier.any(|k| declared(*k) == own && !rests(*k))
                || self.given_to(index).iter().any(|k| entry(*k).mentions.contains_key(pattern))
        })
    }

    /// The equations that one rests on.
    fn given_to(&self, index: usize) -> Vec<usize> {
        let given = self.entries.quietly(index).given(None);
        given.iter().filter_map(|g| self.find(&g.value)).map(|(k, _)| k).collect()
    }
}

/// Why an equation could not be taken apart.
#[derive(Clone, Debug)]
pub enum Unclear {
    /// Its LaTeX is broken.
    Latex(ParseError),
    /// Its meaning is not clear.
    Meaning(semantics::Error),
    /// It continues the equation of this label, which cannot be understood: the error's text.
    Before(String, String),
}

/// The scopes of the sections that are open, the innermost last.
struct Scopes {
    open: Vec<(u8, Arc<Scope>)>,
}

impl Default for Scopes {
    fn default() -> Self {
        Scopes { open: vec![(0, Arc::default())] }
    }
}

impl Scopes {
    /// Enters a section: those of the same or a deeper level are closed.
    fn enter(&mut self, level: u8) {
        while self.open.len() > 1 && self.open.last().is_some_and(|(l, _)| *l >= level) {
            self.open.pop();
        }
        let scope = self.current();
        self.open.push((level, scope));
    }

    /// Takes in declarations for the innermost section; what cannot be taken in is returned.
    fn declare(&mut self, block: &Declarations) -> Vec<Problem> {
        let last = self.open.len() - 1;
        // Equations and sections share a scope until it changes.
        Arc::make_mut(&mut self.open[last].1).declare(block)
    }

    fn current(&self) -> Arc<Scope> {
        let last = self.open.len() - 1;
        Arc::clone(&self.open[last].1)
    }
}
