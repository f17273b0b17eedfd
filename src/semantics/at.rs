//! Values somewhere else: at the start of the motion, `X|_0`, `X|_0^t`; at a value of a symbol, `X|_{x = a}`,
//! `[X]_{x = a}`; the difference between two values of a symbol, `X|_a^x`.

use std::collections::HashMap;

use crate::expr::{Expr, SymId};
use crate::latex::ast::{Kind, Node, Rel, Span};

use super::elaborate::{Elaborator, Typed};
use super::error::{Error, Result};
use super::motion::is_start;
use super::value;

impl Elaborator<'_> {
    /// What stands before a bar with subscripts and superscripts.
    pub(super) fn evaluated_at(&mut self, body: &Node, at: &Node, span: &Span) -> Result<Typed> {
        let (below, above) = match &at.kind {
            Kind::Scripts { base, primes: 0, sub: Some(sub), sup } if base.kind == Kind::Empty => {
                (sub.as_ref(), sup.as_deref())
            }
            _ if condition(at).is_some() || is_start(at) => (at, None),
            _ => return Err(Error::unsupported("a value at a condition is not evaluated yet", span)),
        };
        if let (Some((name, place)), None) = (condition(below), above) {
            return self.at_value(body, name, place);
        }
        let moves = |node: &Node| !matches!(&node.kind, Kind::Symbol(s) if s == "t");
        if let Some(above) = above.filter(|node| moves(node)) {
            return self.difference(body, below, above, span);
        }
        if !is_start(below) {
            return Err(Error::unsupported("only a value at the start, |_0, is evaluated yet", span));
        }
        let inner = self.value(body)?;
        let start = self.started(&inner);
        if above.is_none() {
            return Ok(start);
        }
        let value = value::add(&mut self.world.graph, &inner.value, &start.value, true, span)?;
        Ok(Typed::new(value, format!("({} - {})", inner.text, start.text)))
    }

    /// A bracket with a condition below it, `[X]_{x = a}`; none where the subscript is no condition.
    pub(super) fn bracket_at(&mut self, base: &Node, sub: &Node) -> Result<Option<Typed>> {
        match condition(sub) {
            Some((name, place)) => self.at_value(base, name, place).map(Some),
            None => Ok(None),
        }
    }

    /// A value with another one in the place of a symbol.
    fn at_value(&mut self, body: &Node, name: &Node, place: &Node) -> Result<Typed> {
        let symbol = self.variable(name)?;
        let inner = self.value(body)?;
        let there = self.value(place)?;
        let there = self.scalar(&there, &place.span)?;
        self.replaced(&inner, symbol, there, &body.span)
    }

    /// `X|_a^x`: the value at the symbol x itself less the one where a stands in its place.
    fn difference(&mut self, body: &Node, from: &Node, to: &Node, span: &Span) -> Result<Typed> {
        let symbol = self.variable(to)?;
        let inner = self.value(body)?;
        let begin = self.value(from)?;
        let begin = self.scalar(&begin, &from.span)?;
        let there = self.replaced(&inner, symbol, begin, &body.span)?;
        let value = value::add(&mut self.world.graph, &inner.value, &there.value, true, span)?;
        Ok(Typed::new(value, format!("({} - {})", inner.text, there.text)))
    }

    /// The symbol that a name means.
    fn variable(&mut self, name: &Node) -> Result<SymId> {
        let value = self.value(name)?;
        let e = self.scalar(&value, &name.span)?;
        match *self.world.graph.node(e) {
            crate::expr::Node::Symbol(symbol) => Ok(symbol),
            _ => Err(Error::unsupported("a value is put in the place of what is no symbol", &name.span)),
        }
    }

    /// A value with another one in the place of a symbol. What else depends on the symbol would have to change with it.
    fn replaced(&mut self, inner: &Typed, symbol: SymId, there: Expr, span: &Span) -> Result<Typed> {
        let graph = &self.world.graph;
        let moves = |s: &SymId| *s != symbol && graph.info(*s).base == symbol;
        let rates = graph.symbols(&inner.value.components()).iter().any(moves);
        if rates || inner.value.components().iter().any(|e| self.world.remembers(*e)) {
            let message = "a value is put in the place of a symbol whose rate or integral stands here";
            return Err(Error::unsupported(message, span));
        }
        let map = HashMap::from([(symbol, there)]);
        let value = inner.value.map(&mut |e| self.world.graph.substitute(e, &map));
        Ok(Typed::new(value, format!("{} at {}", inner.text, self.world.graph.display(there))))
    }
}

/// The name and the value of a condition x = a.
fn condition(node: &Node) -> Option<(&Node, &Node)> {
    match &node.kind {
        Kind::Chain { first: Some(name), links } => match links.as_slice() {
            [link] if link.rel == Rel::Eq => Some((name, &link.rhs)),
            _ => None,
        },
        Kind::Group { body, .. } => condition(body),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{scope, value};
    use super::super::{Value, World};
    use super::*;

    const SYMBOLS: &str = r"
        [symbols]
        'x, y' = { of = 't', range = [0.5, 2.0] }
        'c, t' = { range = [0.5, 2.0] }
    ";

    fn scalar(world: &mut World, latex: &str) -> Expr {
        match value(world, &scope(SYMBOLS), latex).unwrap() {
            Value::Scalar(e) => e,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn a_value_at_a_condition() {
        let mut world = World::new();
        let expected = scalar(&mut world, "c^2 + y");
        for latex in [r"\left[ x^2 + y \right]_{x = c}", r"\left. x^2 + y \right|_{x = c}"] {
            assert_eq!(scalar(&mut world, latex), expected, "{latex}");
        }
    }

    #[test]
    fn a_difference_between_two_values_of_a_symbol() {
        let mut world = World::new();
        let expected = scalar(&mut world, r"\sin(x) - \sin(c)");
        assert_eq!(scalar(&mut world, r"\left. \sin(x) \right|_c^x"), expected);
        let (start, bracket) = (scalar(&mut world, r"\left. x^2 \right|_0"), scalar(&mut world, "(x^2)_0"));
        assert_eq!(start, bracket);
        let rate = scalar(&mut world, r"\left. x^2 \right|_0^t");
        assert!(world.remembers(rate), "up to t it is a difference along the motion");
    }

    #[test]
    fn what_would_change_with_the_symbol_is_refused() {
        for latex in [r"\left. \dot{x} \right|_{x = c}", r"\left[ \int_0^t x dt \right]_{x = c}", r"[x]_{2x = c}"] {
            assert!(value(&mut World::new(), &scope(SYMBOLS), latex).is_err(), "{latex}");
        }
    }
}
