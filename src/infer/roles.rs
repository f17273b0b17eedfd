//! What the symbols of notes that declare none probably are.
//!
//! The names are found by Kenzan's own reading: whatever it meets that is not declared is declared as the way it is
//! printed suggests (bold is a vector, a dot makes it depend on time, a letter that a sum runs through is an index ...),
//! until every formula can be read or cannot be read for another reason. Where shapes do not meet then, names that may be
//! matrices or columns are tried as such.

use std::collections::BTreeMap;

use crate::check::{Book, Version};
use crate::document::{Arguments, Declarations, Document, Item, Problem, Span, Spanned, SymbolDeclaration};
use crate::latex::ast::Node;
use crate::semantics::{Clause, Error, ErrorKind, Scope, World, understand};

use super::candidates::inline;
use super::evidence::Evidence;
use super::formulas;
use super::letters::{bare_names, first_e, letter_e, may_be_factor};
use super::reshape;

/// The values that an index is tried with.
const INDEX: [i64; 2] = [1, 3];
/// The most symbols of a formula.
const MOST_SYMBOLS: usize = 200;
/// Where the time is drawn from.
const TIMES: [f64; 2] = [0.1, 2.0];
/// Where positive quantities are drawn from.
const POSITIVE: [f64; 2] = [0.3, 2.0];
/// Letters that notes use for what is positive: masses, lengths, densities, constants of nature.
const POSITIVE_LETTERS: [&str; 14] =
    ["m", "M", "l", "\\ell", "r", "R", "c", "g", "G", "\\hbar", "\\rho", "\\epsilon", "\\varepsilon", "\\mu"];
/// Letters that notes use for angles.
const ANGLES: [&str; 8] = ["\\theta", "\\vartheta", "\\phi", "\\varphi", "\\psi", "\\alpha", "\\beta", "\\chi"];

/// What a symbol is guessed to be.
#[derive(Clone, Debug, PartialEq)]
pub enum Role {
    /// The time.
    Time,
    /// A number of either sign.
    Number,
    /// A positive number.
    Positive,
    /// An angle.
    Angle,
    /// A vector of space.
    Vector,
    /// A vector of length 1.
    UnitVector,
    /// An array of rows and columns; a column where there is one.
    Matrix(usize, usize),
    /// The identity matrix of so many rows.
    Identity(usize),
    /// An index that runs from the first to the second value.
    Index(i64, i64),
    /// The imaginary unit.
    ImaginaryUnit,
}

impl Role {
    /// The role in words.
    pub fn words(&self) -> String {
        match self {
            Role::Time => "the time".into(),
            Role::Number => "a number".into(),
            Role::Positive => "a positive number".into(),
            Role::Angle => "an angle".into(),
            Role::Vector => "a vector".into(),
            Role::UnitVector => "a vector of length 1".into(),
            Role::Matrix(rows, 1) => format!("a column of {rows} numbers"),
            Role::Matrix(rows, columns) => format!("a matrix of {rows} × {columns} numbers"),
            Role::Identity(rows) => format!("the identity matrix of {rows} rows"),
            Role::Index(from, to) => format!("an index from {from} to {to}"),
            Role::ImaginaryUnit => "the imaginary unit".into(),
        }
    }
}

/// A symbol with its guessed role.
#[derive(Clone, Debug, PartialEq)]
pub struct Guess {
    /// Its canonical spelling.
    pub name: String,
    /// What it is guessed to be.
    pub role: Role,
    /// Whether it depends on the time.
    pub moves: bool,
    /// What else it is printed as a function of.
    pub of: Vec<String>,
    /// The indices it has one value for each of.
    pub each: Vec<String>,
    /// Where it is first printed, in bytes of the file.
    pub at: usize,
    /// Whether it moves only because it is said to equal something that does: it may be constant elsewhere.
    pub lent: bool,
}

impl Guess {
    /// Where its values are drawn from, where the role says it.
    pub fn range(&self) -> Option<[f64; 2]> {
        match self.role {
            Role::Time => Some(TIMES),
            Role::Positive => Some(POSITIVE),
            _ => None,
        }
    }

    /// The declaration that says it.
    pub fn declaration(&self) -> SymbolDeclaration {
        let text = |value: &str| Spanned::new(value.to_owned(), self.at..self.at + value.len());
        let t = (self.moves && !self.of.iter().any(|of| of == "t")).then_some("t");
        let of: Vec<&str> = self.of.iter().map(String::as_str).chain(t).collect();
        let mut declaration = SymbolDeclaration {
            names: vec![text(&self.name)],
            range: self.range(),
            of: (!of.is_empty()).then(|| text(&of.join(", "))),
            each: self.each.iter().map(|letter| text(letter)).collect(),
            span: self.at..self.at,
            ..SymbolDeclaration::default()
        };
        match &self.role {
            Role::Angle => declaration.unit = Some(text("rad")),
            Role::Vector | Role::UnitVector => declaration.vector = Some(text("")),
            Role::Matrix(rows, columns) => declaration.matrix = Some([*rows, *columns]),
            Role::Identity(rows) => declaration.same = Some(text(&identity(*rows))),
            Role::Index(from, to) => declaration.index = Some([*from, *to]),
            Role::ImaginaryUnit => declaration.same = Some(text("\\operatorname{i}")),
            Role::Time | Role::Number | Role::Positive => {}
        }
        declaration
    }
}

fn identity(rows: usize) -> String {
    let row = |i: usize| (0..rows).map(|j| if i == j { "1" } else { "0" }).collect::<Vec<_>>().join(" & ");
    let rows: Vec<String> = (0..rows).map(row).collect();
    format!("\\begin{{pmatrix}} {} \\end{{pmatrix}}", rows.join(" \\\\ "))
}

/// Whether a document declares its symbols; if so, nothing is guessed.
pub fn declares_symbols(document: &Document) -> bool {
    document.items.iter().any(|item| matches!(item, Item::Declarations(d) if !d.symbols.is_empty()))
}

/// The roles of the symbols of a document, in the order in which they first occur. A document that
/// [declares its symbols](declares_symbols) is left alone: none.
pub fn guess(document: &Document) -> Vec<Guess> {
    if declares_symbols(document) {
        return Vec::new();
    }
    let book = Book::new(document);
    let mut evidence = Evidence::default();
    let inline: Vec<Node> = inline(document).filter_map(|(_, formula)| formula.tree.ok()).collect();
    let displays = book.entries.iter().filter_map(|e| e.formula(Version::Printed).tree.as_ref().ok());
    let trees: Vec<&Node> = displays.chain(&inline).collect();
    trees.iter().for_each(|tree| evidence.look(tree));
    evidence.spread_motion();

    let is_charge = letter_e(&trees);
    let bare = bare_names(&trees);
    evidence.functions.retain(|name, _| !(may_be_factor(name) && bare.contains(name)) || evidence.given.contains(name));
    let mut guesser = Guesser { evidence, scope: Scope::default(), guesses: BTreeMap::new() };
    let mut clauses = Vec::new();
    for (index, entry) in book.entries.iter().enumerate() {
        let Ok(statement) = book.statement(index, Version::Printed) else { continue };
        let place = |span: &Span| {
            let prefix = entry.equation.prefix.len();
            let at = entry.formula(Version::Printed).expanded.place(span).start;
            entry.equation.span.start + at.saturating_sub(prefix)
        };
        for clause in statement.clauses {
            if let Some(span) = is_charge.then(|| first_e(&clause)).flatten() {
                guesser.declare("e", place(&span));
            }
            guesser.read(&clause, &place);
            clauses.push(clause);
        }
    }
    reshape::reshape(&mut guesser.guesses, &guesser.evidence, &clauses);
    let mut guesses: Vec<Guess> = guesser.guesses.into_values().collect();
    guesses.sort_by(|a, b| (a.at, &a.name).cmp(&(b.at, &b.name)));
    guesses
}

/// The document with the guessed declarations before everything else.
pub fn declare(document: &Document, guesses: &[Guess]) -> Document {
    let mut document = document.clone();
    document.items.insert(0, Item::Declarations(declarations(guesses)));
    document
}

fn declarations(guesses: &[Guess]) -> Declarations {
    let unit = guesses.iter().filter(|g| g.role == Role::UnitVector && g.each.is_empty());
    let assume = unit.map(|g| Spanned::new(format!("|{}| = 1", g.name), g.at..g.at)).collect();
    Declarations { symbols: guesses.iter().map(Guess::declaration).collect(), assume, ..Declarations::default() }
}

/// The scope that guesses make.
pub(super) fn scope<'g>(guesses: impl Iterator<Item = &'g Guess>) -> Scope {
    let mut scope = Scope::default();
    let mut problems: Vec<Problem> = Vec::new();
    guesses.for_each(|guess| scope.declare_symbol(&guess.declaration(), &mut problems));
    scope
}

/// Reads a clause by a scope.
pub(super) fn reading(scope: &Scope, clause: &Clause) -> Result<(), Error> {
    understand(&mut World::new(), scope, clause, true).map(drop)
}

struct Guesser {
    evidence: Evidence,
    scope: Scope,
    guesses: BTreeMap<String, Guess>,
}

impl Guesser {
    /// Declares what a clause needs. `place` is where a part of its formula stands in the file.
    fn read(&mut self, clause: &Clause, place: &dyn Fn(&Span) -> usize) {
        for _ in 0..MOST_SYMBOLS {
            let Err(error) = reading(&self.scope, clause) else { return };
            let (ErrorKind::Undeclared, Some(name)) = (error.kind, &error.missing) else { return };
            if name.is_empty() || !self.declare(name, place(&error.span)) {
                return;
            }
        }
    }

    /// Declares a name and the indices it has; `false` where that leads nowhere.
    fn declare(&mut self, name: &str, at: usize) -> bool {
        if name == "\\infty" {
            return false;
        }
        let each = self.indices(name);
        for letter in &each {
            if !self.guesses.contains_key(letter) {
                self.add(Guess {
                    name: letter.clone(),
                    role: Role::Index(INDEX[0], INDEX[1]),
                    moves: false,
                    of: Vec::new(),
                    each: Vec::new(),
                    at,
                    lent: false,
                });
            }
        }
        if self.guesses.contains_key(name) {
            return false;
        }
        let role = self.role(name);
        let moves = self.evidence.moves.contains(name) && !matches!(role, Role::Time | Role::Index(..));
        let scalar = matches!(role, Role::Number | Role::Positive | Role::Angle | Role::Vector);
        let of = if scalar { self.arguments(name) } else { Vec::new() };
        let lent = moves && !self.evidence.rates.contains(name);
        self.add(Guess { name: name.to_owned(), role, moves, of, each, at, lent });
        true
    }

    fn add(&mut self, guess: Guess) {
        self.scope.declare_symbol(&guess.declaration(), &mut Vec::new());
        self.guesses.insert(guess.name.clone(), guess);
    }

    /// The letters among the subscripts of a name that are indices: those that a sum runs through, and i, j, k where the
    /// name has several of them.
    fn indices(&self, name: &str) -> Vec<String> {
        let Some((base, sub)) = subscript(name) else { return Vec::new() };
        let scripts = self.evidence.scripts.get(base);
        let runs = |letter: &str| {
            let others = scripts.is_some_and(|all| {
                all.iter().any(|s| s != letter && (matches!(s.as_str(), "i" | "j" | "k") || s.parse::<u8>().is_ok()))
            });
            self.evidence.runs.contains_key(letter) || matches!(letter, "i" | "j" | "k") && others
        };
        let letters: Vec<String> = letters(sub);
        if !letters.is_empty() && letters.iter().all(|letter| runs(letter)) { letters } else { Vec::new() }
    }

    /// What a name is printed as a function of, or else derived by.
    fn arguments(&self, name: &str) -> Vec<String> {
        match self.evidence.functions.get(name) {
            Some(printed) => printed.clone(),
            None => self.evidence.derived.get(name).into_iter().flatten().filter(|a| *a != name).cloned().collect(),
        }
    }

    fn role(&self, name: &str) -> Role {
        let evidence = &self.evidence;
        let base = subscript(name).map_or(name, |(base, _)| base).trim_end_matches('\'');
        if let Some((rows, columns)) = evidence.arrays.get(name) {
            // A bold letter that equals three components is a vector, whatever its columns are called.
            let vector = is_arrow(base) && (*rows, *columns) == (3, 1);
            return if vector { Role::Vector } else { Role::Matrix(*rows, *columns) };
        }
        match name {
            "t" => return Role::Time,
            "i" if !evidence.moves.contains("i") && evidence.equals.iter().all(|(n, _)| n != "i") => {
                return match evidence.runs.contains_key("i") {
                    true => Role::Index(INDEX[0], INDEX[1]),
                    false => Role::ImaginaryUnit,
                };
            }
            letter if evidence.runs.contains_key(letter) => return Role::Index(INDEX[0], INDEX[1]),
            _ => {}
        }
        if base.starts_with("\\hat") {
            Role::UnitVector
        } else if is_arrow(base) {
            Role::Vector
        } else if ANGLES.contains(&base) && evidence.angles.contains(name) {
            Role::Angle
        } else if POSITIVE_LETTERS.contains(&base) && !evidence.moves.contains(name) {
            Role::Positive
        } else {
            Role::Number
        }
    }
}

/// Whether a letter is printed as vectors are.
fn is_arrow(base: &str) -> bool {
    base.starts_with("\\mathbf") || base.starts_with("\\vec")
}

/// A name's base and its subscript.
pub(super) fn subscript(name: &str) -> Option<(&str, &str)> {
    let (base, rest) = name.split_once("_{")?;
    Some((base, rest.split_once('}').map_or(rest, |(sub, _)| sub)))
}

/// The single letters that a subscript is made of; none where it is a word or a number.
fn letters(sub: &str) -> Vec<String> {
    let mut letters: Vec<String> = Vec::new();
    for part in sub.split([',', ' ']) {
        match part {
            part if part.starts_with('\\') => return Vec::new(),
            part if part.len() <= 2 && part.bytes().all(|b| b.is_ascii_lowercase()) => {
                letters.extend(part.chars().map(String::from));
            }
            _ => return Vec::new(),
        }
    }
    letters.dedup();
    letters
}

/// A text in TOML's quotes: single ones, in which a backslash is a backslash, where these can hold it.
pub fn quoted(text: &str) -> String {
    match text.contains(['\'', '\n']) {
        false => format!("'{text}'"),
        // What JSON escapes TOML does, too, and in the same way.
        true => serde_json::Value::from(text).to_string(),
    }
}

/// A declaration in TOML, as it stands behind the symbol's name.
pub fn toml(declaration: &SymbolDeclaration) -> String {
    let text = |value: &Spanned<String>| quoted(&value.value);
    let list = |values: &[Spanned<String>]| format!("[{}]", values.iter().map(text).collect::<Vec<_>>().join(", "));
    let functions = match &declaration.function {
        Some(Arguments::Names(names)) => Some(list(names)),
        Some(Arguments::Count(count)) => Some(count.to_string()),
        None => None,
    };
    let pairs = [
        ("index", declaration.index.map(|[from, to]| format!("[{from}, {to}]"))),
        ("vector", declaration.vector.as_ref().map(text)),
        ("matrix", declaration.matrix.map(|[rows, columns]| format!("[{rows}, {columns}]"))),
        ("function", functions),
        ("same", declaration.same.as_ref().map(text)),
        ("each", Some(list(&declaration.each)).filter(|_| !declaration.each.is_empty())),
        ("of", declaration.of.as_ref().map(text)),
        ("unit", declaration.unit.as_ref().map(text)),
        ("range", declaration.range.map(|[from, to]| format!("[{from:?}, {to:?}]"))),
    ];
    let pairs: Vec<String> = pairs.into_iter().filter_map(|(k, v)| Some(format!("{k} = {}", v?))).collect();
    if pairs.is_empty() { "{}".into() } else { format!("{{ {} }}", pairs.join(", ")) }
}

/// What is declared in single equations alone, by label: the formula of what is derived there, with its name.
pub fn local_functions(document: &Document, guesses: &[Guess]) -> BTreeMap<String, Vec<(String, String)>> {
    let document = declare(document, guesses);
    let book = Book::new(&document);
    let found = formulas::functions(&book, &document).into_iter();
    let told = found.map(|(index, declarations)| {
        let named = declarations.iter().filter_map(|d| Some((d.names.first()?.value.clone(), toml(d))));
        (book.entries[index].equation.label.clone(), named.collect())
    });
    told.collect()
}
