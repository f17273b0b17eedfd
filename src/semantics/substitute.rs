//! Values with a symbol replaced: `F|_{x \to a + x}` and `F|_{x = a}`.

use std::collections::HashMap;

use crate::expr;
use crate::latex::ast::{Kind, Link, Node, Rel, Span};

use super::elaborate::{Elaborator, Typed};
use super::error::{Error, Result};

impl Elaborator<'_> {
    /// What stands before the bar, with the symbol below it replaced; `None` where no replacement is printed there.
    ///
    /// # Errors
    /// What is to be replaced is no symbol, or does not occur: then the formula does not say how it depends on it.
    pub(super) fn replaced(&mut self, body: &Node, at: &Node, span: &Span) -> Result<Option<Typed>> {
        let Kind::Chain { first: Some(symbol), links } = &at.kind else { return Ok(None) };
        let [Link { rel: Rel::Eq | Rel::To, rhs, .. }] = links.as_slice() else { return Ok(None) };
        let by = self.value(symbol)?;
        let by = self.scalar(&by, &symbol.span)?;
        let expr::Node::Symbol(id) = *self.world.graph.node(by) else {
            return Err(Error::unsupported("only a symbol can be replaced", &symbol.span));
        };
        let replacement = self.value(rhs)?;
        let replacement = self.scalar(&replacement, &rhs.span)?;
        let inner = self.value(body)?;
        let graph = &mut self.world.graph;
        if !graph.symbols(&inner.value.components()).contains(&id) {
            return Err(Error::unsupported("the formula before the bar does not contain what is replaced", span)
                .with_help("declare its symbols by formulas in it, with `same`"));
        }
        let map = HashMap::from([(id, replacement)]);
        let value = inner.value.map(&mut |e| graph.substitute(e, &map));
        Ok(Some(Typed::new(value, format!("{}|{}", inner.text, super::name::spelling(symbol)))))
    }
}

#[cfg(test)]
mod tests {
    use crate::semantics::World;
    use crate::semantics::testing::{same, scope, value};

    const SYMBOLS: &str = r"
        [symbols]
        'a, b, x' = {}
        'f' = { same = '(a \sin x)' }
    ";

    #[test]
    fn symbols_are_replaced() {
        assert!(same(SYMBOLS, r"f \Big|_{x \rightarrow x + \frac{\pi}{2}}", r"a \cos x"));
        assert!(same(SYMBOLS, r"\left. x^2 + b x \right|_{x = 2}", r"4 + 2b"));
        assert!(!same(SYMBOLS, r"f \Big|_{x \rightarrow x + \pi}", "f"));
    }

    #[test]
    fn what_does_not_occur_is_refused() {
        let error = value(&mut World::new(), &scope(SYMBOLS), r"f \Big|_{b = 2}").unwrap_err();
        assert!(error.message.contains("does not contain"), "{error:?}");
        assert!(value(&mut World::new(), &scope(SYMBOLS), r"f \Big|_{f = 2}").is_err());
    }
}
