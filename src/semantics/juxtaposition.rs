//! What stands side by side: which factor is an argument, which a factor, and where a sum or a derivative ends.
//!
//! The rules, in the order in which they apply to the factors from left to right:
//! - a big operator or a derivative `\frac{d}{dt}` acts on all that follows in the product, but a derivative before a
//!   bracket acts on that bracket alone;
//! - a function takes the bracket behind it, or else the plain factors behind it up to the next function, operator,
//!   bracket or vector; a factor that completes an angle (unit rad) ends the argument: `\sin\theta\dot\theta` is
//!   (sin θ) θ̇, `\sin 2I\cos\theta` is sin(2I) cos θ, `\sin\omega t` is sin(ω t);
//! - a declared function takes the bracket behind it; any other letter before a bracket is a factor;
//! - a symbol that depends on t before `(t)` is that symbol;
//! - `d` before a factor is its differential.
//!
//! Visible operators: cross products first, then dots and slashes from left to right.

use crate::expr::{Expr, Func};
use crate::latex::ast::{BigOp, Kind, Node, ProductOp, Span};
use crate::latex::to_latex;

use super::calculus::Derivative;
use super::complex;
use super::elaborate::{Elaborator, Typed};
use super::element::factors_of;
use super::elliptic::is_name;
use super::error::{Error, Result};
use super::link::assignments;
use super::quaternion;
use super::sexagesimal;
use super::value::{self, Value};
use super::world::{Joint, Role};

/// A product laid flat.
#[derive(Clone, Copy)]
pub(super) enum Item<'n> {
    Factor(&'n Node),
    Op(ProductOp, &'n Span),
}

/// Lays a product flat.
pub(super) fn flatten<'n>(node: &'n Node, items: &mut Vec<Item<'n>>) {
    match &node.kind {
        Kind::Juxt(factors) => factors.iter().for_each(|f| items.push(Item::Factor(f))),
        Kind::Product { first, rest } => {
            flatten(first, items);
            for (op, factor) in rest {
                items.push(Item::Op(*op, &factor.span));
                flatten(factor, items);
            }
        }
        _ => items.push(Item::Factor(node)),
    }
}

fn span_of(items: &[Item]) -> Span {
    let span = |item: &Item| match item {
        Item::Factor(n) => n.span.clone(),
        Item::Op(_, s) => (*s).clone(),
    };
    match (items.first(), items.last()) {
        (Some(a), Some(b)) => span(a).start..span(b).end,
        _ => 0..0,
    }
}

/// The functions of a scalar that are evaluated.
const FUNCTIONS: [&str; 18] = [
    "sin", "cos", "tan", "cot", "sec", "csc", "arcsin", "arccos", "arctan", "sinh", "cosh", "tanh", "coth", "sech",
    "csch", "exp", "ln", "log",
];

/// The name of a function of a scalar, also where it is printed as words: `\text{sech}u`. A second has the name `sec`.
fn function_name(head: &Node) -> Option<&str> {
    match &head.kind {
        Kind::Function(name) => Some(name),
        Kind::Text(name) => Some(name.trim()).filter(|name| *name != "sec" && FUNCTIONS.contains(name)),
        _ => None,
    }
}

/// Whether a factor is nothing but words.
fn is_words(node: &Node) -> bool {
    matches!(node.kind, Kind::Text(_)) && !is_name(node) && function_name(node).is_none()
}

impl Elaborator<'_> {
    /// The value of a product.
    pub(super) fn product(&mut self, node: &Node) -> Result<Typed> {
        let mut items = Vec::new();
        flatten(node, &mut items);
        items.retain(|item| !matches!(item, Item::Factor(n) if is_words(n)));
        self.items(&items)
    }

    /// The value of a product laid flat.
    pub(super) fn items(&mut self, items: &[Item]) -> Result<Typed> {
        let mut segments: Vec<Typed> = Vec::new();
        let mut ops: Vec<(ProductOp, Span)> = Vec::new();
        let mut current: Option<Typed> = None;
        let mut at = 0;
        while let Some(item) = items.get(at) {
            match item {
                Item::Op(op, span) => {
                    let segment = current.take();
                    segments.push(
                        segment.ok_or_else(|| Error::unsupported("a factor is missing before this operator", span))?,
                    );
                    ops.push((*op, (*span).clone()));
                    at += 1;
                }
                Item::Factor(_) => {
                    let (factor, used) = self.factor(&items[at..])?;
                    let span = span_of(&items[at..at + used]);
                    current = Some(match current {
                        None => factor,
                        Some(acc) => self.juxtaposed(acc, factor, &span)?,
                    });
                    at += used;
                }
            }
        }
        segments.push(current.ok_or_else(|| Error::unsupported("a factor is missing here", &span_of(items)))?);
        self.combine(segments, ops)
    }

    fn juxtaposed(&mut self, a: Typed, b: Typed, span: &Span) -> Result<Typed> {
        let (left, right) = self.aligned(&a.value, &b.value, span)?;
        if self.scope.quaternions
            && !matches!((&left, &right), (Value::Scalar(_), _) | (_, Value::Scalar(_)))
            && let Some(x) = quaternion::parts(&mut self.world.graph, &left)
            && let Some(y) = quaternion::parts(&mut self.world.graph, &right)
        {
            let value = quaternion::product(&mut self.world.graph, &x, &y);
            return Ok(Typed::new(value, format!("({} {})", a.text, b.text)));
        }
        let value = value::multiply(&mut self.world.graph, &left, &right, span)?;
        Ok(Typed::new(value, format!("({} {})", a.text, b.text)))
    }

    /// A vector beside a matrix is meant by its components.
    fn aligned(&mut self, a: &Value, b: &Value, span: &Span) -> Result<(Value, Value)> {
        match (a, b) {
            (Value::Matrix(_), Value::Vector(_)) => Ok((a.clone(), self.as_column(b, span)?)),
            _ => Ok((a.clone(), b.clone())),
        }
    }

    /// Joins segments by visible operators: crosses between vectors first, then from left to right.
    fn combine(&mut self, mut segments: Vec<Typed>, mut ops: Vec<(ProductOp, Span)>) -> Result<Typed> {
        let is_vector = |t: &Typed| matches!(t.value, Value::Vector(_));
        let mut k = 0;
        while k < ops.len() {
            if ops[k].0 == ProductOp::Cross && is_vector(&segments[k]) && is_vector(&segments[k + 1]) {
                let b = segments.remove(k + 1);
                let (_, span) = ops.remove(k);
                segments[k] = self.apply_operator(ProductOp::Cross, segments[k].clone(), b, &span)?;
            } else {
                k += 1;
            }
        }
        let mut segments = segments.into_iter();
        let first = segments.next().ok_or_else(|| Error::unsupported("an empty product", &(0..0)))?;
        segments.zip(ops).try_fold(first, |acc, (b, (op, span))| self.apply_operator(op, acc, b, &span))
    }

    fn apply_operator(&mut self, op: ProductOp, a: Typed, b: Typed, span: &Span) -> Result<Typed> {
        let graph = &mut self.world.graph;
        let (value, symbol) = match op {
            ProductOp::Dot => (value::dot(graph, &a.value, &b.value, span)?, "·"),
            ProductOp::Cross => (value::cross(graph, &a.value, &b.value, span)?, "×"),
            ProductOp::Slash => (value::divide(graph, &a.value, &b.value, span)?, "/"),
            ProductOp::Wedge | ProductOp::Tensor | ProductOp::Other => {
                return Err(Error::unsupported("this operator is not evaluated yet", span));
            }
        };
        Ok(Typed::new(value, format!("({} {symbol} {})", a.text, b.text)))
    }

    /// The first factor of some items with the number of items it takes.
    fn factor(&mut self, items: &[Item]) -> Result<(Typed, usize)> {
        let Some(Item::Factor(node)) = items.first() else {
            return Err(Error::unsupported("a factor is missing here", &span_of(items)));
        };
        if self.scope.quaternions
            && let Some(found) = self.taken_apart(items)?
        {
            return Ok(found);
        }
        if let Some(found) = self.elliptic(items)? {
            return Ok(found);
        }
        if let Some(found) = self.legendre(items)? {
            return Ok(found);
        }
        if let Some(found) = self.angle(items)? {
            return Ok(found);
        }
        let (head, sup) = head_and_power(node);
        if complex::is_unit(head) {
            let unit = Typed::new(complex::unit(&mut self.world.graph), "i");
            return self.with_power(unit, sup, &node.span).map(|t| (t, 1));
        }
        if let Some(name) = function_name(head) {
            return self.function(name, sup, node, &items[1..]).map(|(t, n)| (t, n + 1));
        }
        match &head.kind {
            Kind::BigOp(op) => {
                let reach = self.reach(head, &items[1..]);
                return self.big_operator(*op, node, &items[1..=reach]).map(|t| (t, reach + 1));
            }
            Kind::Frac(num, den) => return self.fraction(num, den, node, &items[1..]).map(|(t, n)| (t, n + 1)),
            _ => {}
        }
        if let Some(Item::Factor(next)) = items.get(1) {
            if let Some(found) = self.spelt_together(node, next)? {
                return Ok((found, 2));
            }
            if let Some(found) = self.choices(node, next)? {
                return Ok((found, 2));
            }
            if let Some(found) = self.applied(node, next)? {
                return Ok((found, 2));
            }
            if self.is_differential_sign(node) {
                return self.differential(next).map(|t| (t, 2));
            }
            if is_group_of_t(next) && self.depends_on_t(node) || self.is_argument_of(next, node) {
                return self.value(node).map(|t| (t, 2));
            }
        }
        self.value(node).map(|t| (t, 1))
    }

    /// Two factors that are declared as one name, such as `d\theta`.
    fn spelt_together(&mut self, first: &Node, second: &Node) -> Result<Option<Typed>> {
        if super::name::spelling(first).is_empty() || super::name::spelling(second).is_empty() {
            return Ok(None);
        }
        let pair = Node::new(Kind::Juxt(vec![first.clone(), second.clone()]), first.span.start..second.span.end);
        if self.scope.get(&super::name::spelling(&pair)).is_none() {
            return Ok(None);
        }
        self.atom(&pair).map(Some)
    }

    /// Whether a group names the arguments that a symbol is declared to be a function of, so that the symbol is meant.
    fn is_argument_of(&self, group: &Node, node: &Node) -> bool {
        let Some((entry, _)) = self.entry(node) else { return false };
        !entry.arguments.is_empty()
            && matches!(&group.kind, Kind::Group { body, .. } if super::name::spelling(body) == entry.arguments.join(","))
    }

    fn depends_on_t(&self, node: &Node) -> bool {
        self.entry(node).is_some_and(|(entry, _)| entry.of_t)
    }

    /// A fraction: a derivative, or a quotient.
    fn fraction(&mut self, num: &Node, den: &Node, node: &Node, rest: &[Item]) -> Result<(Typed, usize)> {
        let power = match &node.kind {
            Kind::Scripts { sup, .. } => sup.as_deref(),
            _ => None,
        };
        if let Some(derivative) = self.derivative(num, den) {
            return self.apply_derivative(derivative, node, rest);
        }
        let (n, mut d) = (self.value(num)?, self.value(den)?);
        if self.scope.quaternions && matches!(d.value, Value::Vector(_) | Value::Quaternion(..)) {
            let graph = &mut self.world.graph;
            let parts = quaternion::parts(graph, &d.value);
            d.value = parts.map_or(d.value, |parts| quaternion::inverse(graph, &parts));
            return self.juxtaposed(n, d, &node.span).map(|t| (t, 0));
        }
        let value = value::divide(&mut self.world.graph, &n.value, &d.value, &den.span)?;
        let quotient = Typed::new(value, format!("({} / {})", n.text, d.text));
        self.with_power(quotient, power, &node.span).map(|t| (t, 0))
    }

    fn apply_derivative(&mut self, derivative: Derivative, node: &Node, rest: &[Item]) -> Result<(Typed, usize)> {
        if let Some(operand) = &derivative.operand {
            let inner = self.items(&operand.iter().map(Item::Factor).collect::<Vec<_>>())?;
            return self.derived(&derivative, inner, &node.span).map(|t| (t, 0));
        }
        let bracket = matches!(rest.first(), Some(Item::Factor(n)) if is_bracket(n));
        let used = if bracket { 1 } else { rest.len() };
        if used == 0 {
            return Err(Error::unsupported("this derivative has nothing to act on", &node.span));
        }
        let inner = self.items(&rest[..used])?;
        self.derived(&derivative, inner, &node.span).map(|t| (t, used))
    }

    /// A function with its argument; returns the number of items used by the argument.
    fn function(&mut self, name: &str, sup: Option<&Node>, node: &Node, rest: &[Item]) -> Result<(Typed, usize)> {
        let used = self.argument_length(rest);
        if used == 0 {
            return Err(Error::unsupported(format!("\\{name} has no argument here"), &node.span));
        }
        let argument = self.items(&rest[..used])?;
        if !matches!(name, "max" | "min") {
            self.world.join(|| Joint {
                role: Role::Argument(name.to_owned()),
                parts: vec![(latex_of(&rest[..used]), argument.value.clone())],
            });
        }
        let inverse = matches!(sup.map(|s| &s.kind), Some(Kind::Sum(t)) if t.len() == 1 && is_minus_one(&t[0]));
        let name = if inverse { format!("arc{name}") } else { name.to_owned() };
        let result = self.call(&name, argument, &node.span)?;
        let result = self.with_power(result, sup.filter(|_| !inverse), &node.span)?;
        Ok((result, used))
    }

    /// How many items the argument of a function takes.
    fn argument_length(&self, rest: &[Item]) -> usize {
        if matches!(rest.first(), Some(Item::Factor(n)) if is_bracket(n)) {
            return 1;
        }
        if let angle @ 1.. = sexagesimal::length(rest) {
            return angle;
        }
        let mut used = 0;
        let mut only_numbers = true;
        while let Some(Item::Factor(node)) = rest.get(used) {
            let (head, _) = head_and_power(node);
            let ends = match &head.kind {
                Kind::Function(_) | Kind::BigOp(_) | Kind::Styled(..) | Kind::Accent(..) | Kind::Text(_) => true,
                Kind::Dots(_, body) => matches!(body.kind, Kind::Styled(..) | Kind::Accent(..)),
                Kind::Group { .. } => !only_numbers,
                _ => false,
            };
            if ends && used > 0 {
                break;
            }
            used += 1;
            only_numbers &= matches!(head.kind, Kind::Number(_));
            if self.completes_angle(node) || ends {
                break;
            }
        }
        used
    }

    /// Whether a factor holds a symbol whose unit is the radian, so that an argument is complete with it.
    fn completes_angle(&self, node: &Node) -> bool {
        match &node.kind {
            Kind::Frac(num, den) => self.completes_angle(num) || self.completes_angle(den),
            Kind::Juxt(factors) => factors.iter().any(|f| self.completes_angle(f)),
            Kind::Group { body, .. } => self.completes_angle(body),
            _ => self.entry(node).is_some_and(|(entry, _)| entry.is_angle()),
        }
    }

    fn call(&mut self, name: &str, argument: Typed, span: &Span) -> Result<Typed> {
        if let (Value::Matrix(m), "det") = (&argument.value, name) {
            if m.rows != m.cols || m.rows > value::LARGEST_DETERMINANT {
                let of = argument.value.shape();
                return Err(Error::shape(format!("the determinant of {of}: {}", value::DETERMINANTS), span));
            }
            let det = value::determinant(&mut self.world.graph, m);
            return Ok(Typed::new(Value::Scalar(det), format!("det({})", argument.text)));
        }
        if let (Value::Tuple(items), "max" | "min") = (&argument.value, name) {
            return self.extreme(items, name == "max", span);
        }
        // What Kenzan does not know must not look like a mistake of the author's: the maximum of a tuple, exp of a matrix.
        if !FUNCTIONS.contains(&name) || name == "exp" && matches!(argument.value, Value::Matrix(_)) {
            let of = argument.value.shape();
            return Err(Error::unsupported(format!("the function {name} of {of} is not evaluated yet"), span));
        }
        if let (Value::Complex(re, im), "exp") = (&argument.value, name) {
            let value = complex::exp(&mut self.world.graph, (*re, *im));
            return Ok(Typed::new(value, format!("exp({})", argument.text)));
        }
        if let Value::Complex(..) = argument.value {
            return Err(Error::unsupported(
                format!("the function {name} of a complex number is not evaluated yet"),
                span,
            ));
        }
        let x = self.scalar(&argument, span)?;
        let graph = &mut self.world.graph;
        let one = graph.int(1);
        let reciprocal = |f: Func, graph: &mut crate::expr::Graph| {
            let y = graph.call(f, x);
            graph.div(one, y)
        };
        let value = match name {
            "sin" => graph.call(Func::Sin, x),
            "cos" => graph.call(Func::Cos, x),
            "tan" => graph.call(Func::Tan, x),
            "cot" => reciprocal(Func::Tan, graph),
            "sec" => reciprocal(Func::Cos, graph),
            "csc" => reciprocal(Func::Sin, graph),
            "arcsin" => graph.call(Func::Asin, x),
            "arccos" => graph.call(Func::Acos, x),
            "arctan" => graph.call(Func::Atan, x),
            "sinh" => graph.call(Func::Sinh, x),
            "cosh" => graph.call(Func::Cosh, x),
            "tanh" => graph.call(Func::Tanh, x),
            "coth" => reciprocal(Func::Tanh, graph),
            "sech" => reciprocal(Func::Cosh, graph),
            "csch" => reciprocal(Func::Sinh, graph),
            "exp" => graph.call(Func::Exp, x),
            "ln" | "log" => graph.call(Func::Ln, x),
            _ => {
                return Err(Error::unsupported(format!("the function {name} is not evaluated yet"), span));
            }
        };
        Ok(Typed::new(Value::Scalar(value), format!("{name}({})", argument.text)))
    }

    /// The largest or least of some numbers: of two, half the sum of them and of their distance.
    fn extreme(&mut self, items: &[Value], largest: bool, span: &Span) -> Result<Typed> {
        let mut extreme: Option<Expr> = None;
        for item in items {
            let e = self.scalar(&Typed::new(item.clone(), ""), span)?;
            let graph = &mut self.world.graph;
            extreme = Some(match extreme {
                None => e,
                Some(acc) => {
                    let (sum, difference, two) = (graph.add(acc, e), graph.sub(acc, e), graph.int(2));
                    let distance = graph.call(Func::Abs, difference);
                    let twice = if largest { graph.add(sum, distance) } else { graph.sub(sum, distance) };
                    graph.div(twice, two)
                }
            });
        }
        let e = extreme.ok_or_else(|| Error::unsupported("the largest of nothing", span))?;
        Ok(Typed::new(Value::Scalar(e), if largest { "max" } else { "min" }))
    }

    fn big_operator(&mut self, op: BigOp, node: &Node, rest: &[Item]) -> Result<Typed> {
        let (sub, sup) = match &node.kind {
            Kind::Scripts { sub, sup, .. } => (sub.as_deref(), sup.as_deref()),
            _ => (None, None),
        };
        if rest.is_empty() {
            return Err(Error::unsupported("this operator has nothing to act on", &node.span));
        }
        if let (BigOp::Sum, None) = (op, sup)
            && let Some(sum) = self.cyclic_sum(sub, rest, &node.span)?
        {
            return Ok(sum);
        }
        match op {
            BigOp::Sum | BigOp::Product => {}
            BigOp::Integral | BigOp::DoubleIntegral if !self.particles(&factors_of(rest)).is_empty() => {}
            BigOp::Integral => return self.integral(sub, sup, rest, &node.span),
            _ => return Err(Error::unsupported("integrals over areas are not evaluated yet", &node.span)),
        }
        let ranges = match op {
            BigOp::Sum | BigOp::Product => self.index_values(sub, sup, rest, &node.span)?,
            _ => assignments(self.scope, &self.particles(&factors_of(rest)), &node.span)?,
        };
        let mut total: Option<Typed> = None;
        for assignment in ranges {
            let depth = self.indices.len();
            self.indices.extend(assignment);
            let term = self.items(rest);
            self.indices.truncate(depth);
            let term = term?;
            total = Some(match total {
                None => term,
                Some(acc) => {
                    let graph = &mut self.world.graph;
                    let value = match op {
                        BigOp::Sum | BigOp::Integral | BigOp::DoubleIntegral => {
                            value::add(graph, &acc.value, &term.value, false, &node.span)?
                        }
                        _ => value::multiply(graph, &acc.value, &term.value, &node.span)?,
                    };
                    Typed::new(value, acc.text)
                }
            });
        }
        let symbol = match op {
            BigOp::Sum => "Σ",
            BigOp::Product => "Π",
            _ => "∫",
        };
        match total {
            Some(t) => {
                let over = sub.map(super::name::spelling).unwrap_or_default();
                Ok(Typed::new(t.value, format!("{symbol}_{{{over}}}({})", t.text)))
            }
            None => Err(Error::unsupported("this sum runs over nothing", &node.span)),
        }
    }
}

/// The LaTeX of some factors.
fn latex_of(items: &[Item]) -> String {
    let factors = items.iter().filter_map(|item| match item {
        Item::Factor(n) => Some((*n).clone()),
        Item::Op(..) => None,
    });
    match factors.collect::<Vec<_>>() {
        factors if factors.len() == 1 => to_latex(&factors[0]),
        factors => to_latex(&Node::new(Kind::Juxt(factors), span_of(items))),
    }
}

/// A factor without its power: `\sin^2` is (sin, 2). Subscripted names are heads of their own.
pub(super) fn head_and_power(node: &Node) -> (&Node, Option<&Node>) {
    match &node.kind {
        Kind::Scripts { base, sub: None, sup, primes: 0 } => (base, sup.as_deref()),
        Kind::Scripts { base, .. } if matches!(base.kind, Kind::BigOp(_)) => (base, None),
        _ => (node, None),
    }
}

fn is_minus_one(term: &crate::latex::ast::Term) -> bool {
    term.sign == crate::latex::ast::Sign::Minus && matches!(&term.node.kind, Kind::Number(n) if n == "1")
}

pub(super) fn is_bracket(node: &Node) -> bool {
    matches!(head_and_power(node).0.kind, Kind::Group { .. })
}

fn is_group_of_t(node: &Node) -> bool {
    match &node.kind {
        Kind::Group { body, .. } => matches!(&body.kind, Kind::Symbol(s) if s == "t"),
        _ => false,
    }
}
