//! From syntax to typed values: symbols, scripts, brackets, sums of terms.

use std::cell::Cell;

use crate::expr::{Expr, Func};
use crate::latex::ast::{Delim, Kind, MatrixEnv, Node, Sign, Span, Term};
use crate::latex::to_latex;

use super::complex;
use super::error::{Error, Result};
use super::juxtaposition::Item;
use super::name::spelling;
use super::quaternion;
use super::scope::Scope;
use super::value::{self, Matrix, Value};
use super::world::{Joint, Role, World};

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
        let missing = Some(name.clone());
        let error = Error { missing, ..Error::undeclared(format!("undeclared symbol {name}"), &node.span) };
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
