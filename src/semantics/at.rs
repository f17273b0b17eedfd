//! Values somewhere else: at the start of the motion, `X|_0`, `X|_0^t`; at a value of a symbol, `X|_{x = a}`,
//! `X|_{x \to a + x}`, `[X]_{x = a}`; the difference between two values of a symbol, `X|_a^x`.

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

    /// A value where a symbol, or a vector of them, has another value: that value in its place. Where rates stand, what is
    /// meant is the moment at which the symbol has that value.
    fn at_value(&mut self, body: &Node, name: &Node, place: &Node) -> Result<Typed> {
        let (name, there) = (self.value(name)?, self.value(place)?);
        let (names, values) = (name.value.components(), there.value.components());
        let symbols: Option<Vec<SymId>> = names.iter().map(|e| self.symbol_of(*e)).collect();
        let Some(symbols) = symbols.filter(|symbols| symbols.len() == values.len()) else {
            let message = "a value is put in for a symbol of its own, of the same shape";
            return Err(Error::unsupported(message, &place.span));
        };
        let inner = self.value(body)?;
        let map: HashMap<SymId, Expr> = symbols.into_iter().zip(values.iter().copied()).collect();
        if self.moves_with(&inner, &map) {
            self.world.moment.extend(names.into_iter().zip(values));
            return Ok(Typed::new(inner.value, format!("({} when {} = {})", inner.text, name.text, there.text)));
        }
        self.replaced(&inner, &map, &there.text, &body.span)
    }

    fn symbol_of(&self, e: Expr) -> Option<SymId> {
        match *self.world.graph.node(e) {
            crate::expr::Node::Symbol(symbol) => Some(symbol),
            _ => None,
        }
    }

    /// Whether rates of the symbols stand in a value: they would have to change with the symbols.
    fn moves_with(&self, inner: &Typed, map: &HashMap<SymId, Expr>) -> bool {
        let graph = &self.world.graph;
        let moves = |s: &SymId| !map.contains_key(s) && map.contains_key(&graph.info(*s).base);
        graph.symbols(&inner.value.components()).iter().any(moves)
    }

    /// `X|_a^x`: the value at the symbol x itself less the one where a stands in its place.
    fn difference(&mut self, body: &Node, from: &Node, to: &Node, span: &Span) -> Result<Typed> {
        let symbol = self.variable(to, &to.span)?;
        let inner = self.value(body)?;
        let begin = self.value(from)?;
        let begin_text = begin.text.clone();
        let begin = self.scalar(&begin, &from.span)?;
        let map = HashMap::from([(symbol, begin)]);
        if self.moves_with(&inner, &map) {
            return Err(Error::unsupported("a value is put in the place of a symbol whose rate stands here", span));
        }
        let there = self.replaced(&inner, &map, &begin_text, &body.span)?;
        let value = value::add(&mut self.world.graph, &inner.value, &there.value, true, span)?;
        Ok(Typed::new(value, format!("({} - {})", inner.text, there.text)))
    }

    /// The symbol that a name means.
    pub(super) fn variable(&mut self, name: &Node, span: &Span) -> Result<SymId> {
        let value = self.value(name)?;
        let e = self.scalar(&value, span)?;
        let message = || format!("{} should be a symbol here", value.text);
        self.symbol_of(e).ok_or_else(|| Error::unsupported(message(), span))
    }

    /// A value with others in the place of symbols.
    fn replaced(&mut self, inner: &Typed, map: &HashMap<SymId, Expr>, there: &str, span: &Span) -> Result<Typed> {
        if inner.value.components().iter().any(|e| self.world.remembers(*e)) {
            let message = "a value is put in the place of a symbol whose integral stands here";
            return Err(Error::unsupported(message, span));
        }
        let symbols = self.world.graph.symbols(&inner.value.components());
        if !symbols.iter().any(|s| map.contains_key(s)) {
            return Err(Error::unsupported("the formula before the bar does not contain what is replaced", span)
                .with_help("declare its symbols by formulas in it, with `same`"));
        }
        let value = inner.value.map(&mut |e| self.world.graph.substitute(e, map));
        Ok(Typed::new(value, format!("{} at {there}", inner.text)))
    }
}

/// The name and the value of a condition x = a, or of a replacement x → a.
fn condition(node: &Node) -> Option<(&Node, &Node)> {
    match &node.kind {
        Kind::Chain { first: Some(name), links } => match links.as_slice() {
            [link] if matches!(link.rel, Rel::Eq | Rel::To) => Some((name, &link.rhs)),
            _ => None,
        },
        Kind::Group { body, .. } => condition(body),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{same, scope, value};
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
    fn a_rate_is_meant_at_that_moment() {
        let mut world = World::new();
        let rate = scalar(&mut world, r"\dot{x}");
        assert_eq!(scalar(&mut world, r"\left. \dot{x} \right|_{x = c}"), rate);
        let (x, c) = (scalar(&mut world, "x"), scalar(&mut world, "c"));
        assert_eq!(world.moment, [(x, c)]);
    }

    #[test]
    fn what_would_change_with_the_symbol_is_refused() {
        for latex in [r"\left. \dot{x} \right|_c^x", r"\left[ \int_0^t x dt \right]_{x = c}", r"[x]_{2x = c}"] {
            assert!(value(&mut World::new(), &scope(SYMBOLS), latex).is_err(), "{latex}");
        }
    }

    #[test]
    fn symbols_are_replaced_by_formulas() {
        const FORMULA: &str = "[symbols]\n'a, b, x' = {}\n'f' = { same = '(a \\sin x)' }";
        assert!(same(FORMULA, r"f \Big|_{x \rightarrow x + \frac{\pi}{2}}", r"a \cos x"));
        assert!(same(FORMULA, r"\left. x^2 + b x \right|_{x = 2}", r"4 + 2b"));
        assert!(!same(FORMULA, r"f \Big|_{x \rightarrow x + \pi}", "f"));
        let error = value(&mut World::new(), &scope(FORMULA), r"f \Big|_{b = 2}").unwrap_err();
        assert!(error.message.contains("does not contain"), "{error:?}");
        assert!(value(&mut World::new(), &scope(FORMULA), r"f \Big|_{f = 2}").is_err());
    }
}
