//! From syntax to typed values: symbols, scripts, brackets, sums of terms.

use std::cell::Cell;

use crate::expr::{Expr, Func, SymId};
use crate::latex::ast::{Delim, Kind, MatrixEnv, Node, Sign, Span, Term};
use crate::latex::to_latex;

use super::complex;
use super::error::{Error, Result};
use super::juxtaposition::Item;
use super::name::spelling;
use super::quaternion;
use super::scope::{Entry, EntryKind, Scope, pattern};
use super::value::{self, Matrix, Value};
use super::world::{Facts, Joint, Quantity, Role, World};

/// The most that is told of how a value was read, in bytes: otherwise a sum of n terms takes n² to read.
const LONGEST_TEXT: usize = 4000;

/// How many names may stand for each other one after another.
pub(super) const MOST_ALIASES: usize = 20;

/// A value with the way it was read, every operation in brackets.
#[derive(Clone, Debug)]
pub struct Typed {
    /// The value.
    pub value: Value,
    /// How it was read.
    pub text: String,
}

impl Typed {
    pub(super) fn new(value: Value, text: impl Into<String>) -> Self {
        let mut text = text.into();
        if text.len() > LONGEST_TEXT {
            text.truncate(text.floor_char_boundary(LONGEST_TEXT));
            text.push('…');
        }
        Typed { value, text }
    }
}

/// Builds values in a [`World`] from syntax, by what a [`Scope`] declares.
pub struct Elaborator<'w> {
    /// The graph and its symbols.
    pub world: &'w mut World,
    /// The declarations in force.
    pub scope: &'w Scope,
    /// The indices that have a value here, the innermost last.
    pub(super) indices: Vec<(String, i64)>,
    /// Whether ± means +, for a formula with branches.
    pub(super) upper: bool,
    /// How many names stand for names here.
    pub(super) aliases: Cell<usize>,
    /// The arguments of the function whose formula is being written out.
    pub(super) bound: Vec<(String, Typed)>,
}

impl<'w> Elaborator<'w> {
    /// An elaborator with the given indices fixed, on the upper or lower branch of ±.
    pub fn new(world: &'w mut World, scope: &'w Scope, indices: Vec<(String, i64)>, upper: bool) -> Self {
        Elaborator { world, scope, indices, upper, aliases: Cell::new(0), bound: Vec::new() }
    }

    /// The value of an expression.
    pub fn value(&mut self, node: &Node) -> Result<Typed> {
        self.world.step(&node.span)?;
        if let Some((angle, _)) = self.angle(&[Item::Factor(node)])? {
            return Ok(angle);
        }
        match &node.kind {
            Kind::Number(text) => self.number(text, &node.span),
            Kind::Symbol(_) | Kind::Styled(..) | Kind::Accent(..) | Kind::Scripts { .. } | Kind::Dots(..) => {
                self.atom(node)
            }
            Kind::Juxt(_) | Kind::Product { .. } | Kind::Frac(..) => self.product(node),
            Kind::Sum(terms) => self.terms(terms),
            Kind::Sqrt { index, body } => self.root(index.as_deref(), body, &node.span),
            Kind::Group { open: Delim::Angle | Delim::Paren, .. } if self.is_declared(node) => self.atom(node),
            Kind::Group { open, close, body } => self.group(*open, *close, body, &node.span),
            Kind::List(items) => self.tuple(items),
            Kind::Matrix { env: MatrixEnv::Cases, rows } => self.case(rows, node),
            Kind::Matrix { env, rows } => self.matrix(*env, rows, &node.span),
            Kind::Annotated { body, .. } => self.value(body),
            Kind::Function(_) => self.product(node),
            Kind::BigOp(_) => Err(Error::unsupported("this operator has nothing to act on", &node.span)),
            Kind::Empty => Err(Error::unsupported("an expression is missing here", &node.span)),
            Kind::Text(text) => Err(Error::unsupported(format!("words within a formula: {text}"), &node.span)
                .with_help("give the formula a `reading` without the words")),
            Kind::Ellipsis => Err(Error::unsupported("an ellipsis stands for terms that are not printed", &node.span)
                .with_help("give the formula a `reading` in which the terms are written out or summed")),
            Kind::Factorial(step, body) => self.factorial(*step, body, &node.span),
            Kind::At { body, at } => self.evaluated_at(body, at, &node.span),
            Kind::Chain { .. } | Kind::Rows(_) | Kind::Marked(..) => {
                Err(Error::unsupported("a relation stands where a value is expected", &node.span))
            }
        }
    }

    fn number(&mut self, text: &str, span: &Span) -> Result<Typed> {
        match self.world.graph.decimal(text) {
            Some(e) => Ok(Typed::new(Value::Scalar(e), text)),
            None => Err(Error::unsupported(format!("the number {text} cannot be read"), span)),
        }
    }

    fn terms(&mut self, terms: &[Term]) -> Result<Typed> {
        let mut sum: Option<Typed> = None;
        let mut values = Vec::with_capacity(terms.len());
        for term in terms {
            let next = self.value(&term.node)?;
            values.push(next.value.clone());
            let minus = match term.sign {
                Sign::Plus => false,
                Sign::Minus => true,
                Sign::PlusMinus => !self.upper,
                Sign::MinusPlus => self.upper,
            };
            let sign = if minus { "-" } else { "+" };
            sum = Some(match sum {
                None if minus => {
                    Typed::new(value::negate(&mut self.world.graph, &next.value), format!("-{}", next.text))
                }
                None => next,
                Some(acc) => {
                    let span = term.sign_span.clone().map_or(term.node.span.clone(), |s| s.start..term.node.span.end);
                    let (acc, next) = self.alike(acc, next);
                    let graph = &mut self.world.graph;
                    let value = add_or_zero(graph, &acc.value, &next.value, minus, &span)?;
                    Typed::new(value, format!("{} {sign} {}", acc.text, next.text))
                }
            });
        }
        let sum = sum.ok_or_else(|| Error::unsupported("an empty sum", &(0..0)))?;
        let parts = || terms.iter().map(|t| to_latex(&t.node)).zip(values).collect();
        self.world.join(|| Joint { role: Role::Sum, parts: parts() });
        Ok(if terms.len() > 1 { Typed::new(sum.value, format!("({})", sum.text)) } else { sum })
    }

    /// Terms that are to be added: among quaternions a number may be added to a vector.
    fn alike(&mut self, a: Typed, b: Typed) -> (Typed, Typed) {
        if self.scope.quaternions
            && let Some((x, y)) = quaternion::met(&mut self.world.graph, &a.value, &b.value)
        {
            return (Typed::new(x, a.text), Typed::new(y, b.text));
        }
        (a, b)
    }

    fn tuple(&mut self, items: &[Node]) -> Result<Typed> {
        let items = items.iter().map(|n| self.value(n)).collect::<Result<Vec<_>>>()?;
        let text = items.iter().map(|t| t.text.as_str()).collect::<Vec<_>>().join(", ");
        Ok(Typed::new(Value::Tuple(items.into_iter().map(|t| t.value).collect()), format!("({text})")))
    }

    fn root(&mut self, index: Option<&Node>, body: &Node, span: &Span) -> Result<Typed> {
        let body_value = self.value(body)?;
        let e = self.scalar(&body_value, &body.span)?;
        let graph = &mut self.world.graph;
        match index {
            None => Ok(Typed::new(Value::Scalar(graph.sqrt(e)), format!("sqrt({})", body_value.text))),
            Some(Node { kind: Kind::Number(n), .. }) if n.parse::<i32>().is_ok_and(|n| n > 0) => {
                let third = graph.ratio(1, n.parse::<i128>().unwrap_or(1));
                Ok(Typed::new(Value::Scalar(graph.pow(e, third)), format!("root({n}, {})", body_value.text)))
            }
            Some(_) => Err(Error::unsupported("the index of a root must be a positive integer", span)),
        }
    }

    fn group(&mut self, open: Delim, close: Delim, body: &Node, span: &Span) -> Result<Typed> {
        if let Some(bracket) = self.poisson(open, body, span)? {
            return Ok(bracket);
        }
        let inner = self.value(body)?;
        match (open, close) {
            (Delim::Bar, Delim::Bar) | (Delim::DoubleBar, Delim::DoubleBar) => self.magnitude(&inner, span),
            (Delim::Floor | Delim::Ceil, _) => self.rounded(open, &inner, span),
            (Delim::Angle, _) => {
                Err(Error::unsupported("these brackets have a meaning that is not evaluated yet", span))
            }
            _ => Ok(inner),
        }
    }

    /// |x|: the absolute value, the length of a vector, the determinant of a matrix.
    fn magnitude(&mut self, inner: &Typed, span: &Span) -> Result<Typed> {
        let graph = &mut self.world.graph;
        let e = match &inner.value {
            Value::Scalar(e) => graph.call(Func::Abs, *e),
            Value::Vector(v) => {
                let square = value::dot3(graph, v, v);
                graph.sqrt(square)
            }
            Value::Complex(re, im) => {
                let square = complex::square(graph, (*re, *im));
                graph.sqrt(square)
            }
            Value::Matrix(m) if m.rows == m.cols && m.rows <= value::LARGEST_DETERMINANT => {
                value::determinant(graph, m)
            }
            other => return Err(Error::shape(format!("{} has no magnitude", other.shape()), span)),
        };
        Ok(Typed::new(Value::Scalar(e), format!("|{}|", inner.text)))
    }

    fn matrix(&mut self, env: MatrixEnv, rows: &[Vec<Node>], span: &Span) -> Result<Typed> {
        let cols = rows.iter().map(Vec::len).max().unwrap_or(0);
        let mut data = Vec::new();
        let mut text = Vec::new();
        for row in rows {
            if row.len() != cols {
                return Err(Error::shape(
                    format!("a row of {} entries in a matrix of {cols} columns", row.len()),
                    span,
                ));
            }
            for cell in row {
                let entry = self.value(cell)?;
                data.push(self.scalar(&entry, &cell.span)?);
                text.push(entry.text);
            }
        }
        let matrix = Matrix { rows: rows.len(), cols, data };
        let text = format!("[{}x{cols}: {}]", rows.len(), text.join(", "));
        if env == MatrixEnv::Determinant {
            if matrix.rows != cols || cols > value::LARGEST_DETERMINANT {
                return Err(Error::shape(value::DETERMINANTS, span));
            }
            let det = value::determinant(&mut self.world.graph, &matrix);
            return Ok(Typed::new(Value::Scalar(det), format!("det{text}")));
        }
        Ok(Typed::new(Value::Matrix(matrix), text))
    }

    /// The scalar that is expected here.
    pub(super) fn scalar(&mut self, typed: &Typed, span: &Span) -> Result<Expr> {
        match &typed.value {
            Value::Scalar(e) => Ok(*e),
            other => Err(Error::shape(format!("expected a scalar, found {}", other.shape()), span)),
        }
    }

    // ---- symbols ----------------------------------------------------------------------------------------------

    /// A symbol with its scripts and dots.
    pub(super) fn atom(&mut self, node: &Node) -> Result<Typed> {
        if let Some(found) = self.declared(node)? {
            return Ok(found);
        }
        match &node.kind {
            Kind::Dots(n, body) => {
                let inner = self.value(body)?;
                let value = self.time_derivative(&inner.value, u32::from(*n));
                Ok(Typed::new(value, format!("\\{}ot{{{}}}", "d".repeat(usize::from(*n)), inner.text)))
            }
            Kind::Scripts { base, primes: 0, sub: Some(angles), sup: None }
                if matches!(base.kind, Kind::Group { open: Delim::Angle, close: Delim::Angle, .. }) =>
            {
                match &base.kind {
                    Kind::Group { body, .. } => self.mean(body, angles, &node.span),
                    _ => Err(self.not_declared(node)),
                }
            }
            Kind::Scripts { base, primes, sub, sup } => {
                self.scripts(node, base, *primes, sub.as_deref(), sup.as_deref())
            }
            Kind::Symbol(s) if s == "\\pi" => Ok(Typed::new(Value::Scalar(self.world.graph.pi()), "\\pi")),
            Kind::Styled(_, body) if matches!(&body.kind, Kind::Number(n) if n == "0") => {
                let zero = self.world.graph.int(0);
                Ok(Typed::new(Value::Vector([zero; 3]), "\\mathbf{0}"))
            }
            Kind::Symbol(s) if s == "e" => Ok(Typed::new(Value::Scalar(self.world.graph.e()), "e")),
            _ => Err(self.not_declared(node)),
        }
    }

    fn not_declared(&self, node: &Node) -> Error {
        let name = spelling(node);
        if name.starts_with("\\operatorname{lim}") {
            return Error::unsupported("limits are not evaluated yet", &node.span);
        }
        let error = Error::undeclared(format!("undeclared symbol {name}"), &node.span);
        match self.scope.suggestion(&name) {
            Some(near) => error
                .with_help(format!("did you mean {}? Otherwise declare it under [symbols]", near.replace('#', "i"))),
            None => error.with_help(format!("declare it under [symbols], as in '{name}' = {{ range = [0.5, 2] }}")),
        }
    }

    fn scripts(
        &mut self,
        node: &Node,
        base: &Node,
        primes: u8,
        sub: Option<&Node>,
        sup: Option<&Node>,
    ) -> Result<Typed> {
        // Dots belong to the whole name: \dot{r}_G is the derivative of r_G.
        if let Kind::Dots(n, inner) = &base.kind {
            let whole = Kind::Scripts {
                base: inner.clone(),
                primes,
                sub: sub.cloned().map(Box::new),
                sup: sup.cloned().map(Box::new),
            };
            let whole = Node::new(whole, node.span.clone());
            if sup.is_some() && self.is_declared(&whole) {
                return self.atom(&Node::new(Kind::Dots(*n, Box::new(whole)), node.span.clone()));
            }
            let kind = match (primes, sub) {
                (0, None) => inner.kind.clone(),
                _ => Kind::Scripts { base: inner.clone(), primes, sub: sub.cloned().map(Box::new), sup: None },
            };
            let dotted = Node::new(Kind::Dots(*n, Box::new(Node::new(kind, node.span.clone()))), node.span.clone());
            let plain = self.atom(&dotted)?;
            return self.with_power(plain, sup, &node.span);
        }
        if sup.is_some() {
            let kind = match (primes, sub) {
                (0, None) => base.kind.clone(),
                _ => Kind::Scripts { base: Box::new(base.clone()), primes, sub: sub.cloned().map(Box::new), sup: None },
            };
            let plain = self.value(&Node::new(kind, base.span.start..sub.map_or(base.span.end, |s| s.span.end)))?;
            return self.with_power(plain, sup, &node.span);
        }
        if let (0, Some(sub), Kind::Group { .. }) = (primes, sub, &base.kind)
            && let Some(there) = self.bracket_at(base, sub)?
        {
            return Ok(there);
        }
        if let (0, Some(sub)) = (primes, sub)
            && let Some((basis, axis)) = self.scope.axis(&spelling(sub)).map(|(b, k)| (b.name.clone(), k))
            && (matches!(base.kind, Kind::Group { .. }) || self.is_declared(base))
        {
            let whole = self.value(base)?;
            return self.component(&whole, &basis, axis, &node.span);
        }
        if let (0, Some(sub), Kind::Group { .. }) = (primes, sub, &base.kind)
            && super::motion::is_start(sub)
        {
            let inner = self.value(base)?;
            return Ok(self.started(&inner));
        }
        if let Some(delta) = self.kronecker(base, primes, sub)? {
            return Ok(delta);
        }
        Err(self.not_declared(node))
    }

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
    fn declared(&mut self, node: &Node) -> Result<Option<Typed>> {
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
        let facts = || Facts { tex, range: entry.range, integer: entry.integer, quantity: Some(quantity()) };
        let id: SymId = self.world.symbol(name, entry.of_t, facts);
        self.world.graph.sym(id)
    }
}

/// Sum or difference in which the number 0 also stands for the null vector.
pub(super) fn add_or_zero(
    graph: &mut crate::expr::Graph,
    a: &Value,
    b: &Value,
    minus: bool,
    span: &Span,
) -> Result<Value> {
    if b.is_zero_scalar(graph) {
        return Ok(a.clone());
    }
    value::add(graph, a, b, minus, span)
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
