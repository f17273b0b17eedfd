//! Declared names: which declaration a name means, with which indices, and the symbol that it is in the world.

use crate::expr::{Expr, SymId};
use crate::latex::ast::{Kind, Node, Sign, Span};

use super::elaborate::{Elaborator, MOST_ALIASES, Typed};
use super::error::{Error, Result};
use super::name::spelling;
use super::scope::{Entry, EntryKind, pattern};
use super::value::{Matrix, Value};
use super::world::{Facts, Quantity};

impl Elaborator<'_> {
    /// Whether a symbol is declared, without building its value.
    pub(super) fn is_declared(&self, node: &Node) -> bool {
        self.entry(node).is_some()
    }

    /// The entry of a symbol, with the values of its indices.
    pub(super) fn entry(&self, node: &Node) -> Option<(&Entry, Vec<i64>)> {
        let exact = spelling(node);
        if exact.is_empty() {
            return None;
        }
        if let Some(entry) = self.scope.get(&exact) {
            return Some((entry, entry.hidden.iter().filter_map(|letter| self.index_value(letter)).collect()));
        }
        let values = std::cell::RefCell::new(Vec::new());
        let is_index = |letter: &str| self.index_value(letter).inspect(|v| values.borrow_mut().push(*v)).is_some();
        let family = pattern(node, &is_index);
        if let Some(entry) = self.scope.get(&family) {
            return Some((entry, values.into_inner()));
        }
        // Numbers as indices: m_1 of the family m_i; or what indices give, K_{n-2p}.
        let (family, indices) = numbered_pattern(node, &|letter| self.index_value(letter))?;
        if let Some(entry) = self.scope.get(&family) {
            return Some((entry, indices));
        }
        // M_j where M_1 and M_2 are declared each by itself.
        let entry = self.scope.get(&instance(&family, &indices))?;
        Some((entry, entry.hidden.iter().filter_map(|letter| self.index_value(letter)).collect()))
    }

    /// The value that an index letter has here.
    pub(super) fn index_value(&self, letter: &str) -> Option<i64> {
        self.indices.iter().rev().find(|(name, _)| name == letter).map(|(_, v)| *v)
    }

    /// The value of a declared symbol, or `None` where the node is no declared name.
    pub(super) fn declared(&mut self, node: &Node) -> Result<Option<Typed>> {
        if let Some(bound) = self.argument(node).or_else(|| self.running(node)) {
            return Ok(Some(bound));
        }
        let Some((entry, indices)) = self.entry(node) else { return Ok(None) };
        let entry = entry.clone();
        let name = instance(&entry.pattern, &indices);
        let name = match entry.hidden.iter().find(|letter| self.index_value(letter).is_none()) {
            Some(letter) => {
                return Err(Error::undeclared(format!("the index {letter} of {name} has no value here"), &node.span));
            }
            None if entry.hidden.is_empty() => name,
            None => format!("{name}_{{{}}}", indices.iter().map(i64::to_string).collect::<Vec<_>>().join(",")),
        };
        let value = match &entry.kind {
            EntryKind::Scalar => Value::Scalar(self.scalar_symbol(&entry, &name, name.clone())),
            EntryKind::Vector => Value::Vector(
                ["x", "y", "z"]
                    .map(|axis| self.scalar_symbol(&entry, &format!("{name}.{axis}"), format!("({name})_{axis}"))),
            ),
            EntryKind::Matrix { rows, cols } => {
                let cells = (0..rows * cols).map(|k| (k / cols + 1, k % cols + 1));
                let data = cells
                    .map(|(i, j)| self.scalar_symbol(&entry, &format!("{name}.{i}{j}"), format!("{name}_{{{i}{j}}}")));
                Value::Matrix(Matrix { rows: *rows, cols: *cols, data: data.collect() })
            }
            EntryKind::Index(..) => match self.index_value(&name) {
                Some(v) => Value::Scalar(self.world.graph.int(v)),
                None => return Err(Error::undeclared(format!("the index {name} has no value here"), &node.span)),
            },
            EntryKind::Same(other) => {
                let depth = self.indices.len();
                self.indices.extend(entry.letters.iter().cloned().zip(indices));
                let value = self.alias(&name, other, &node.span);
                self.indices.truncate(depth);
                return value.map(Some);
            }
            EntryKind::Component { of, basis, axis } => {
                let whole = self.alias(&name, of, &node.span)?;
                let component = self.component(&whole, basis, *axis, &node.span)?;
                return Ok(Some(Typed::new(component.value, name)));
            }
            EntryKind::BasisVector { basis, axis } => Value::Vector(self.triad(basis, &node.span)?[*axis]),
            EntryKind::Rate { basis } => Value::Vector(self.angular_velocity(basis, &node.span)?),
            EntryKind::Function => {
                return Err(Error::unsupported(format!("the function {name} has no argument here"), &node.span));
            }
        };
        Ok(Some(Typed::new(value, shown_name(node))))
    }

    /// The value of the letter that a sum runs through, whatever else it may be outside; but where a declared formula is
    /// written out, its letters are those of the declaration.
    fn running(&mut self, node: &Node) -> Option<Typed> {
        let Kind::Symbol(letter) = &node.kind else { return None };
        if self.aliases.get() > 0 && self.scope.get(letter).is_some() {
            return None;
        }
        let value = self.index_value(letter)?;
        Some(Typed::new(Value::Scalar(self.world.graph.int(value)), letter.clone()))
    }

    /// What a name stands for, which may be a name that stands for something.
    fn alias(&mut self, name: &str, other: &Node, span: &Span) -> Result<Typed> {
        let depth = self.aliases.get();
        if depth >= MOST_ALIASES {
            let message =
                format!("{name} stands for a name that stands for a name, and so on for {MOST_ALIASES} times");
            return Err(Error::unsupported(message, span).with_help("do the declarations with `same` go in a circle?"));
        }
        self.aliases.set(depth + 1);
        let value = self.value(other);
        self.aliases.set(depth);
        value
    }

    fn scalar_symbol(&mut self, entry: &Entry, name: &str, tex: String) -> Expr {
        let quantity =
            || Quantity { name: entry.pattern.clone(), declared: entry.declared, dimension: entry.dimension };
        let depends = entry.arguments.clone();
        let facts = || Facts { tex, range: entry.range, integer: entry.integer, quantity: Some(quantity()), depends };
        let id: SymId = self.world.symbol(name, entry.of_t, facts);
        self.world.graph.sym(id)
    }
}

/// A family's name with its indices filled in.
fn instance(pattern: &str, indices: &[i64]) -> String {
    let mut values = indices.iter();
    pattern
        .chars()
        .map(|c| match c {
            '#' => values.next().map_or_else(|| "#".to_owned(), i64::to_string),
            c => c.to_string(),
        })
        .collect()
}

/// The pattern of a name in which the numbers in the scripts are indices, with their values. So are sums of indices with
/// whole factors.
fn numbered_pattern(node: &Node, index: &dyn Fn(&str) -> Option<i64>) -> Option<(String, Vec<i64>)> {
    let Kind::Scripts { base, primes, sub: Some(sub), sup } = &node.kind else { return None };
    let values = std::cell::RefCell::new(Vec::new());
    let leaf = |n: &Node| {
        let value = match &n.kind {
            Kind::Number(_) | Kind::Sum(_) => whole(n, index),
            Kind::Symbol(letter) => index(letter),
            _ => None,
        };
        value.map(|v| {
            values.borrow_mut().push(v);
            "#".to_owned()
        })
    };
    let mut text = format!("{}{}_{{", spelling(base), "'".repeat(usize::from(*primes)));
    text += &super::name::spelling_with(sub, &leaf);
    text.push('}');
    if let Some(sup) = sup {
        text += &format!("^{{{}}}", super::name::spelling_with(sup, &leaf));
    }
    let values = values.into_inner();
    (!values.is_empty()).then_some((text, values))
}

/// The whole number that a script gives: a number, an index, or a sum of them with whole factors.
fn whole(node: &Node, index: &dyn Fn(&str) -> Option<i64>) -> Option<i64> {
    match &node.kind {
        Kind::Number(digits) => digits.parse().ok(),
        Kind::Symbol(letter) => index(letter),
        Kind::Juxt(factors) => factors.iter().try_fold(1_i64, |acc, f| acc.checked_mul(whole(f, index)?)),
        Kind::Sum(terms) => terms.iter().try_fold(0_i64, |acc, term| {
            let value = whole(&term.node, index)?;
            match term.sign {
                Sign::Plus => acc.checked_add(value),
                Sign::Minus => acc.checked_sub(value),
                Sign::PlusMinus | Sign::MinusPlus => None,
            }
        }),
        _ => None,
    }
}

/// A name as it is shown in a reading.
fn shown_name(node: &Node) -> String {
    spelling(node)
}
