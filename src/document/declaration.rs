//! Declarations: what the symbols of a section are, its bases, and what is assumed throughout.
//!
//! ```toml
//! assume = ['\theta > 0']          # LaTeX premises that hold in the section
//! natural_units = true            # no constant has a dimension here: dimensions are not checked
//! modulus = 'k'                   # of elliptic functions that are printed without one
//! cyclic = ['i, j, k', 'A, B, C']    # what goes round together in a cyclic sum
//! canonical = { L = '\ell', G = 'g' }    # Poisson brackets: each momentum with its coordinate
//! [symbols]
//! 'I_0, I_1' = { unit = "kg m^2", range = [0.3, 3.0] }
//! '\theta'   = { unit = "rad", of = "t", range = [0.2, 1.4] }
//! '\mathbf{r}_i' = { vector = "inertial", unit = "m", each = "i" }
//! i = { index = [1, 4] }
//! [basis.body]
//! vectors = ['\mathbf{e}_\xi', '\mathbf{e}_\eta', '\mathbf{e}_\zeta']
//! axes = ['\xi', '\eta', '\zeta']
//! euler = ['\varphi', '\theta', '\psi']
//! order = "zxz"
//! rotating = true
//! ```

use super::place::{Span, Spanned};
use super::problem::Problem;
use super::toml::{Reader, Table, Value};

/// Declarations that hold from where they stand to the end of the section.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Declarations {
    /// The comment.
    pub span: Span,
    /// The symbols.
    pub symbols: Vec<SymbolDeclaration>,
    /// The bases.
    pub bases: Vec<BasisDeclaration>,
    /// LaTeX premises.
    pub assume: Vec<Spanned<String>>,
    /// Whether the section is written in natural units (c = 1, or g = l = 1), where dimensions say nothing.
    pub natural_units: Option<bool>,
    /// The LaTeX of the modulus k of elliptic functions that are printed without one.
    pub modulus: Option<Spanned<String>>,
    /// The LaTeX of the triples that go round together in cyclic sums.
    pub cyclic: Vec<[Spanned<String>; 3]>,
    /// The LaTeX of the canonical variables of Poisson brackets: each momentum with its coordinate.
    pub canonical: Vec<(Spanned<String>, Spanned<String>)>,
}

/// What one or several symbols are.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SymbolDeclaration {
    /// The symbols' LaTeX: the key, split at the commas that stand in no brackets.
    pub names: Vec<Spanned<String>>,
    /// The unit, `kg m^2`.
    pub unit: Option<Spanned<String>>,
    /// Where values are drawn from, in the unit declared. `value = 9.81` is the range from 9.81 to 9.81.
    pub range: Option<[f64; 2]>,
    /// The variable it is a function of along the motion: `t`.
    pub of: Option<Spanned<String>>,
    /// A vector: the name of the basis its components are drawn in, or `""`.
    pub vector: Option<Spanned<String>>,
    /// A matrix: rows and columns.
    pub matrix: Option<[usize; 2]>,
    /// The name of the basis a matrix is written in.
    pub basis: Option<Spanned<String>>,
    /// The indices it has one value for each of.
    pub each: Vec<Spanned<String>>,
    /// It is an index, and runs from the first to the second number.
    pub index: Option<[i64; 2]>,
    /// The distance between the values of an index: 2 for a sign, from -1 to 1.
    pub step: Option<usize>,
    /// It is a function, with these arguments.
    pub function: Option<Arguments>,
    /// It is another notation for this symbol.
    pub same: Option<Spanned<String>>,
    /// It is the component of this vector that its index names.
    pub component_of: Option<Spanned<String>>,
    /// Its values are whole numbers.
    pub integer: bool,
    /// The key and the value.
    pub span: Span,
}

/// The arguments of a symbol that is a function.
#[derive(Clone, Debug, PartialEq)]
pub enum Arguments {
    /// So many: `function = 2`.
    Count(usize),
    /// These: `function = ["x", "y"]`.
    Names(Vec<Spanned<String>>),
}

/// A right-handed orthonormal basis.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BasisDeclaration {
    /// Its name, as `vector = ".."` refers to it.
    pub name: Spanned<String>,
    /// The LaTeX of its vectors; three empty texts if they have none.
    pub vectors: [Spanned<String>; 3],
    /// The LaTeX of its axes, as they stand in the indices of components.
    pub axes: Option<[Spanned<String>; 3]>,
    /// The LaTeX of the three Euler angles, in the order of the rotations, that lead from the inertial basis to it.
    pub euler: Option<[Spanned<String>; 3]>,
    /// The axes of the rotations: `zxz`.
    pub order: Option<Spanned<String>>,
    /// Whether it moves.
    pub rotating: bool,
    /// The symbol of its angular velocity.
    pub rate: Option<Spanned<String>>,
    /// Whether a column of components without a basis of its own is in this basis.
    pub columns: bool,
    /// The table.
    pub span: Span,
}

pub(super) const KEYS: [&str; 7] = ["symbols", "basis", "assume", "natural_units", "modulus", "cyclic", "canonical"];

const SYMBOL_KEYS: [&str; 14] = [
    "unit",
    "range",
    "of",
    "vector",
    "matrix",
    "basis",
    "each",
    "index",
    "step",
    "function",
    "same",
    "component_of",
    "integer",
    "value",
];

const BASIS_KEYS: [&str; 7] = ["vectors", "axes", "euler", "order", "rotating", "rate", "columns"];

/// Reads an annotation that holds declarations only.
pub(super) fn declarations(table: &Table, span: Span, reader: &mut Reader) -> Declarations {
    let mut found = Declarations { span, ..Declarations::default() };
    for (key, value) in table {
        match key.as_str() {
            "symbols" => found.symbols = symbols(key, value, reader),
            "basis" => found.bases = bases(key, value, reader),
            "assume" => found.assume = reader.texts(key, value),
            "natural_units" => found.natural_units = Some(reader.bool(key, value)),
            "modulus" => found.modulus = reader.text(key, value),
            "cyclic" => {
                let triples = reader.texts(key, value);
                found.cyclic = triples.iter().filter_map(|text| triple(text, reader)).collect();
            }
            "canonical" => {
                let pairs = reader.table(key, value, r"canonical = { L = '\ell' }");
                found.canonical = pairs.iter().filter_map(|(p, q)| Some((p.clone(), reader.text(p, q)?))).collect();
            }
            _ => {}
        }
    }
    found
}

/// Three names, split at commas.
fn triple(text: &Spanned<String>, reader: &mut Reader) -> Option<[Spanned<String>; 3]> {
    let names = split_at_commas(text);
    let count = names.len();
    let triple = names.try_into().ok();
    if triple.is_none() {
        let message = format!("three names go round, and not {count}");
        let problem = Problem::error("document::cyclic", message, text.span.clone());
        reader.problems.push(problem.help("for example: cyclic = ['i, j, k', 'A, B, C']"));
    }
    triple
}

/// Reads `[symbols]`.
pub(super) fn symbols(key: &Spanned<String>, value: &Value, reader: &mut Reader) -> Vec<SymbolDeclaration> {
    let example = r#"[symbols], and below it '\theta' = { unit = "rad", range = [0.2, 1.4] }"#;
    reader.table(key, value, example).iter().map(|(key, value)| symbol(key, value, reader)).collect()
}

fn symbol(name: &Spanned<String>, value: &Value, reader: &mut Reader) -> SymbolDeclaration {
    let span = name.span.start..value.span.end.max(name.span.end);
    let mut symbol = SymbolDeclaration { names: split_at_commas(name), span, ..SymbolDeclaration::default() };
    if symbol.names.is_empty() {
        let problem = Problem::error("document::symbol", "a symbol without a name", name.span.clone());
        reader.problems.push(problem.help(r"the key is the symbol's LaTeX: '\theta' = { .. }"));
    }
    for (key, value) in reader.table(name, value, r#"{ unit = "rad", range = [0.2, 1.4] }"#) {
        match key.as_str() {
            "unit" => symbol.unit = reader.text(key, value),
            "range" => symbol.range = reader.range(key, value),
            "value" => symbol.range = reader.number(key, value).map(|value| [value, value]),
            "of" => symbol.of = reader.text(key, value),
            "vector" => symbol.vector = reader.text(key, value),
            "matrix" => symbol.matrix = reader.shape(key, value),
            "basis" => symbol.basis = reader.text(key, value),
            "each" => symbol.each = reader.texts(key, value),
            "index" => symbol.index = reader.index_range(key, value),
            "step" => symbol.step = reader.count(key, value),
            "function" => symbol.function = arguments(key, value, reader),
            "same" => symbol.same = reader.text(key, value),
            "component_of" => symbol.component_of = reader.text(key, value),
            "integer" => symbol.integer = reader.bool(key, value),
            _ => reader.unknown(key, "a symbol", &SYMBOL_KEYS),
        }
    }
    symbol
}

fn arguments(key: &Spanned<String>, value: &Value, reader: &mut Reader) -> Option<Arguments> {
    if matches!(value.kind, super::toml::Kind::Number(..)) {
        return reader.count(key, value).map(Arguments::Count);
    }
    Some(Arguments::Names(reader.texts(key, value))).filter(|names| *names != Arguments::Names(Vec::new()))
}

fn bases(key: &Spanned<String>, value: &Value, reader: &mut Reader) -> Vec<BasisDeclaration> {
    let example = r"[basis.body], and below it vectors = ['\mathbf{e}_x', '\mathbf{e}_y', '\mathbf{e}_z']";
    reader.table(key, value, example).iter().map(|(name, value)| basis(name, value, reader)).collect()
}

fn basis(name: &Spanned<String>, value: &Value, reader: &mut Reader) -> BasisDeclaration {
    let table = reader.table(name, value, r"{ vectors = ['\mathbf{e}_x', '\mathbf{e}_y', '\mathbf{e}_z'] }");
    let end = table.iter().map(|(_, value)| value.span.end).max().unwrap_or(0);
    let span = name.span.start..end.max(value.span.end).max(name.span.end);
    let mut basis = BasisDeclaration { name: name.clone(), span, ..BasisDeclaration::default() };
    for (key, value) in table {
        match key.as_str() {
            "vectors" => basis.vectors = reader.three(key, value).unwrap_or_default(),
            "axes" => basis.axes = reader.three(key, value),
            "euler" => basis.euler = reader.three(key, value),
            "order" => basis.order = reader.text(key, value),
            "rotating" => basis.rotating = reader.bool(key, value),
            "rate" => basis.rate = reader.text(key, value),
            "columns" => basis.columns = reader.bool(key, value),
            _ => reader.unknown(key, "a basis", &BASIS_KEYS),
        }
    }
    basis
}

/// Splits `I_0, I_1` at the commas that stand in no brackets, each name with its place. `\,` is a space, not a comma.
fn split_at_commas(names: &Spanned<String>) -> Vec<Spanned<String>> {
    let text = names.as_str();
    let (mut depth, mut start, mut escaped) = (0_usize, 0, false);
    let mut parts = Vec::new();
    for (at, c) in text.char_indices() {
        match c {
            _ if escaped => escaped = false,
            '\\' => escaped = true,
            '{' | '(' | '[' => depth += 1,
            '}' | ')' | ']' => depth = depth.saturating_sub(1),
            ',' if depth == 0 => {
                parts.push(start..at);
                start = at + 1;
            }
            _ => {}
        }
    }
    parts.push(start..text.len());
    let parts = parts.into_iter().map(|part| super::layout::trimmed(text, part)).filter(|part| !part.is_empty());
    parts.map(|part| Spanned::new(text[part.clone()].to_owned(), names.place(part))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_split_at_outer_commas() {
        let names = Spanned::new(r"I_{0,1}, f(x, y),\, a\,b".to_owned(), 10..34);
        let split = split_at_commas(&names);
        let found: Vec<_> = split.iter().map(|name| (name.as_str(), name.span.clone())).collect();
        assert_eq!(found, [("I_{0,1}", 10..17), ("f(x, y)", 19..26), (r"\, a\,b", 27..34)]);
    }
}
