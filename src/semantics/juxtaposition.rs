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

use crate::latex::ast::{BigOp, Kind, Node, ProductOp, Span};
use crate::latex::to_latex;

use super::calculus::Derivative;
use super::complex;
use super::elaborate::{Elaborator, Typed};
use super::element::factors_of;
use super::elliptic::is_name;
use super::error::{Error, Result};
use super::function::function_name;
use super::link::assignments;
use super::quaternion;
use super::value::{self, Value};

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
                if let Some((integral, used)) = self.definite(node, &items[1..])? {
                    return Ok((integral, used + 1));
                }
                let reach = self.reach(head, node, &items[1..]);
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
            _ => {
                let what = "integrals along lines and over areas are not evaluated yet";
                return Err(Error::unsupported(what, &node.span).with_help(super::motion::UNTIL_THEN));
            }
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
pub(super) fn latex_of(items: &[Item]) -> String {
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

pub(super) fn is_minus_one(term: &crate::latex::ast::Term) -> bool {
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

/// Where a product, after something else, comes to a sum or product over the same letters: they are bound anew, and
/// `\sum_i x_i \sum_i y_i` is a product of two sums.
pub(super) fn summed_again(node: &Node, rest: &[Item]) -> Option<usize> {
    let over = |node: &Node| match &node.kind {
        Kind::Scripts { base, sub: Some(sub), .. } if matches!(base.kind, Kind::BigOp(BigOp::Sum | BigOp::Product)) => {
            Some(super::name::spelling(sub)).filter(|letters| !letters.is_empty())
        }
        _ => None,
    };
    let own = over(node)?;
    let again = |item: &Item| matches!(item, Item::Factor(factor) if over(factor).as_ref() == Some(&own));
    rest.iter().position(again).filter(|k| *k > 0)
}
