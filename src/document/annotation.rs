//! Annotations: what an author says of an equation, in TOML.
//!
//! In Markdown an annotation is an HTML comment that begins with `kenzan`. If it has no key of an equation it holds
//! [declarations](super::declaration). Otherwise it belongs to the equation directly before it: only text may stand
//! between them, no other display and no heading. Where the rows of a display carry labels, `for = "6"` says which of
//! them is meant, otherwise it is the last; several annotations may follow one display, one for each label. `[symbols]` in
//! an equation's annotation is local to that equation.
//!
//! `label = "L_z"` gives a label to an inline formula directly before the annotation (only blanks and punctuation between
//! them), which becomes an equation by that, or else to the display before it, if that has no printed label.
//!
//! `rows = ["71", "72"]`, in the first annotation of a display, makes an equation of each row of its `cases` (or
//! `aligned`, `array` ..) block: the row's first cell, with what stands before the block as its
//! [`prefix`](super::Equation::prefix). Rows of an `aligned` with an empty label belong to the
//! label below, `rows = ["", "", "411", "", "412"]`. An annotation with no other key than `rows` belongs to none of them.
//!
//! `[link.2]` with `given`, `where` or `iff` is about the second link alone (of a chain a = b = c, b = c). What follows from
//! no law should be judged without it: with dω/dt = 0 given, I dω/dt = d(Iω)/dt would hold whatever the factors.

use super::declaration::{KEYS as DECLARATION_KEYS, SymbolDeclaration, symbols};
use super::place::{Span, Spanned};
use super::toml::{Kind, Reader, Table, Value};

/// The annotation of an equation. All texts are LaTeX unless said otherwise; labels are those of [`super::Equation`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct EquationAnnotation {
    /// The comment.
    pub span: Span,
    /// A label for an equation that prints none.
    pub label: Option<Spanned<String>>,
    /// `for`: which of the display's labels it belongs to.
    pub for_label: Option<Spanned<String>>,
    /// What it is, one of [`KINDS`].
    pub kind: Option<Spanned<String>>,
    /// Labels of the equations it follows from.
    pub given: Vec<Spanned<String>>,
    /// The symbols that the given equations are solved for.
    pub solve: Vec<Spanned<String>>,
    /// Labels of the equations that this one is claimed to solve.
    pub solves: Vec<Spanned<String>>,
    /// The arbitrary constants of a solution that is claimed to be general.
    pub general: Vec<Spanned<String>>,
    /// `where`: premises that the prose states.
    pub where_: Vec<Spanned<String>>,
    /// Premises of single links.
    pub link: Vec<LinkPremises>,
    /// Ranges for symbols in this equation, in their units.
    pub range: Vec<(Spanned<String>, [f64; 2])>,
    /// An approximation's small parameter.
    pub small: Option<Spanned<String>>,
    /// The angles of a Fourier series of which some terms are printed.
    pub harmonics: Vec<Spanned<String>>,
    /// The order of an approximation's residual in the small parameter.
    pub order: Option<f64>,
    /// The statement that it is equivalent to.
    pub iff: Option<Spanned<String>>,
    /// The map that a transformation is.
    pub maps: Option<Spanned<String>>,
    /// The formula as it is to be read where its LaTeX is damaged or in a private notation.
    pub reading: Option<Spanned<String>>,
    /// The formula that should have been printed.
    pub correction: Option<Spanned<String>>,
    /// The verdict that is expected, one of [`VERDICTS`].
    pub expect: Option<Spanned<String>>,
    /// One line for the reader, plain text.
    pub because: Option<String>,
    /// Labels for the rows of its block.
    pub rows: Vec<Spanned<String>>,
    /// The number of digits to which printed values agree.
    pub digits: Option<u32>,
    /// Printed values of symbols: the symbol, and the value as it is written.
    pub data: Vec<(Spanned<String>, Spanned<String>)>,
    /// The number of states to evaluate it at.
    pub states: Option<usize>,
    /// Declarations for this equation only.
    pub symbols: Vec<SymbolDeclaration>,
}

/// Premises of one link of a chain, beside those of the equation.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LinkPremises {
    /// Which link, from 1.
    pub number: usize,
    /// Where that number stands.
    pub span: Span,
    /// Labels of the equations it follows from.
    pub given: Vec<Spanned<String>>,
    /// `where`: premises that the prose states.
    pub where_: Vec<Spanned<String>>,
    /// The statement that the link is equivalent to.
    pub iff: Option<Spanned<String>>,
}

/// The keys of an equation's annotation, those of declarations not included.
pub const KEYS: [&str; 23] = [
    "label",
    "for",
    "kind",
    "given",
    "solve",
    "solves",
    "general",
    "where",
    "link",
    "range",
    "small",
    "harmonics",
    "order",
    "iff",
    "maps",
    "reading",
    "correction",
    "expect",
    "because",
    "rows",
    "digits",
    "data",
    "states",
];

/// What `kind` may be.
pub const KINDS: [&str; 12] = [
    "identity",
    "definition",
    "law",
    "derived",
    "constant",
    "approximation",
    "inequality",
    "solution",
    "value",
    "transformation",
    "equivalence",
    "statement",
];

/// What `expect` may be.
pub const VERDICTS: [&str; 7] = ["holds", "asymptotic", "definition", "fails", "undecided", "statement", "unreadable"];

impl EquationAnnotation {
    /// This annotation with what it does not say itself from another one; and the keys that both of them have.
    pub(super) fn over(mut self, mut other: Self) -> (Self, Vec<&'static str>) {
        let mut twice = Vec::new();
        macro_rules! take {
            ($($field:ident: $key:literal),*) => {$(
                let (own, found) = (&mut self.$field, std::mem::take(&mut other.$field));
                if is_blank(own) {
                    *own = found;
                } else if !is_blank(&found) {
                    twice.push($key);
                }
            )*};
        }
        take!(label: "label", kind: "kind", given: "given", solve: "solve", solves: "solves", general: "general");
        take!(where_: "where", link: "link", range: "range", small: "small", harmonics: "harmonics", order: "order");
        take!(iff: "iff", maps: "maps", reading: "reading", correction: "correction", expect: "expect");
        take!(because: "because", rows: "rows", digits: "digits", data: "data", states: "states", symbols: "symbols");
        (self, twice)
    }
}

fn is_blank<T: Default + PartialEq>(value: &T) -> bool {
    *value == T::default()
}

/// What an annotation is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum About {
    Equation,
    Section,
    /// It has no key that is known.
    Nothing,
}

/// What an annotation is about, by its keys. Keys that are not known at all are reported here.
pub(super) fn about(table: &Table, reader: &mut Reader) -> About {
    let mut known: Vec<&str> = KEYS.to_vec();
    known.extend(DECLARATION_KEYS);
    for (key, _) in table.iter().filter(|(key, _)| !known.contains(&key.as_str())) {
        reader.unknown(key, "an annotation", &known);
    }
    let has = |keys: &[&str]| table.iter().any(|(key, _)| keys.contains(&key.as_str()));
    match (has(&KEYS), has(&DECLARATION_KEYS)) {
        (true, _) => About::Equation,
        (false, true) => About::Section,
        (false, false) => About::Nothing,
    }
}

/// Reads an equation's annotation.
pub(super) fn equation(table: &Table, span: Span, reader: &mut Reader) -> EquationAnnotation {
    let mut found = EquationAnnotation { span, ..EquationAnnotation::default() };
    for (key, value) in table {
        match key.as_str() {
            "label" => found.label = label(key, value, reader),
            "for" => found.for_label = label(key, value, reader),
            "kind" => found.kind = reader.word(key, value, &KINDS),
            "given" => found.given = reader.texts(key, value),
            "solve" => found.solve = reader.texts(key, value),
            "solves" => found.solves = reader.texts(key, value),
            "general" => found.general = reader.texts(key, value),
            "where" => found.where_ = reader.texts(key, value),
            "link" => found.link = links(key, value, reader),
            "range" => found.range = ranges(key, value, reader),
            "harmonics" => found.harmonics = reader.texts(key, value),
            "small" => found.small = reader.text(key, value),
            "order" => found.order = reader.number(key, value),
            "iff" => found.iff = reader.text(key, value),
            "maps" => found.maps = reader.text(key, value),
            "reading" => found.reading = reader.text(key, value),
            "correction" => found.correction = reader.text(key, value),
            "expect" => found.expect = reader.word(key, value, &VERDICTS),
            "because" => found.because = reader.text(key, value).map(|text| text.value),
            "rows" => found.rows = reader.texts(key, value),
            "digits" => found.digits = reader.count(key, value).and_then(|digits| u32::try_from(digits).ok()),
            "data" => found.data = data(key, value, reader),
            "states" => found.states = reader.count(key, value),
            "symbols" => found.symbols = symbols(key, value, reader),
            "basis" | "assume" => misplaced(key, reader),
            _ => {}
        }
    }
    found
}

fn label(key: &Spanned<String>, value: &Value, reader: &mut Reader) -> Option<Spanned<String>> {
    let text = reader.text(key, value)?;
    if text.value.trim().is_empty() {
        reader.wrong(key, value, "a label", &format!("{} = '52'", key.value));
        return None;
    }
    Some(text)
}

fn ranges(key: &Spanned<String>, value: &Value, reader: &mut Reader) -> Vec<(Spanned<String>, [f64; 2])> {
    let entries = reader.table(key, value, r"range = { '\theta' = [0.2, 1.4] }");
    entries.iter().filter_map(|(name, value)| Some((name.clone(), reader.range(name, value)?))).collect()
}

fn links(key: &Spanned<String>, value: &Value, reader: &mut Reader) -> Vec<LinkPremises> {
    let example = r"[link.2], and below it given = ['28']";
    let mut found = Vec::new();
    for (name, value) in reader.table(key, value, example) {
        let Some(number) = name.value.parse().ok().filter(|n| *n > 0) else {
            let message = format!("`{}` is not the number of a link", name.value);
            let problem = super::Problem::error("document::link", message, name.span.clone());
            reader.problems.push(problem.label("links are counted from 1").help(format!("for example: {example}")));
            continue;
        };
        let mut premises = LinkPremises { number, span: name.span.clone(), ..LinkPremises::default() };
        for (key, value) in reader.table(name, value, example) {
            match key.value.as_str() {
                "given" => premises.given = reader.texts(key, value),
                "where" => premises.where_ = reader.texts(key, value),
                "iff" => premises.iff = reader.text(key, value),
                _ => reader.unknown(key, "a link", &["given", "where", "iff"]),
            }
        }
        found.push(premises);
    }
    found
}

/// Values keep the digits they are written with.
fn data(key: &Spanned<String>, value: &Value, reader: &mut Reader) -> Vec<(Spanned<String>, Spanned<String>)> {
    let example = r"data = { a = 6378.1, b = '6.4 \times 10^3' }";
    let mut found = Vec::new();
    for (name, value) in reader.table(key, value, example) {
        match &value.kind {
            Kind::Number(_, written) => found.push((name.clone(), Spanned::new(written.clone(), value.span.clone()))),
            Kind::Text(text) => found.push((name.clone(), text.clone())),
            _ => reader.wrong(name, value, "a number or LaTeX", example),
        }
    }
    found
}

fn misplaced(key: &Spanned<String>, reader: &mut Reader) {
    let message = format!("`{}` cannot stand in an equation's annotation", key.value);
    let problem = super::Problem::error("document::misplaced_key", message, key.span.clone());
    reader.problems.push(problem.label("holds for a whole section").help(match key.as_str() {
        "assume" => "write `where` for a premise of this equation, or give `assume` an annotation of its own",
        _ => "give it an annotation of its own",
    }));
}
