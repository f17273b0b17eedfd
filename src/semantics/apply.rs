//! Functions that a declaration gives by a formula: `'f' = { same = 'a x^2', function = ["x"] }` makes `f(2b)` of it
//! what the formula is for x = 2b. A family may be given by cases:
//! `'K_k^{nm}' = { each = ["k", "n", "m"], function = ["I"], same = '\begin{cases} .. & n = 2, k = 0 \\ .. \end{cases}' }`.

use crate::latex::ast::{Kind, Node};

use super::elaborate::{Elaborator, Typed};
use super::error::{Error, Result};
use super::juxtaposition::head_and_power;
use super::name::spelling;
use super::scope::EntryKind;

impl Elaborator<'_> {
    /// A function given by a formula before its arguments; `None` where the factors are something else. Arguments that
    /// are printed as declared leave the formula as it is.
    pub(super) fn applied(&mut self, function: &Node, group: &Node) -> Result<Option<Typed>> {
        let (group, power) = head_and_power(group);
        let Kind::Group { body, .. } = &group.kind else { return Ok(None) };
        let (names, given) = match self.entry(function) {
            Some((entry, _)) if matches!(entry.kind, EntryKind::Same(_)) => (entry.arguments.clone(), true),
            Some((entry, _)) if entry.is_free() => (entry.arguments.clone(), false),
            _ => return Ok(None),
        };
        let arguments = match &body.kind {
            Kind::List(items) => items.iter().collect(),
            _ => vec![body.as_ref()],
        };
        if names.is_empty() || names.len() != arguments.len() {
            return Ok(None);
        }
        if names.iter().zip(&arguments).all(|(name, argument)| *name == spelling(argument)) {
            let value = self.value(function)?;
            return self.with_power(value, power, &group.span).map(Some);
        }
        if !given {
            let message = format!("{} depends on {}, by no formula", spelling(function), names.join(", "));
            return Err(Error::unsupported(message, &group.span)
                .with_help("give it by one: same = '..', function = [..]; what it is elsewhere is not known"));
        }
        let values = arguments.iter().map(|argument| self.value(argument)).collect::<Result<Vec<_>>>()?;
        let text = values.iter().map(|v| v.text.as_str()).collect::<Vec<_>>().join(", ");
        let bound = names.into_iter().zip(values).collect();
        let outer = std::mem::replace(&mut self.bound, bound);
        let value = self.value(function);
        self.bound = outer;
        let value = Typed::new(value?.value, format!("{}({text})", spelling(function)));
        self.with_power(value, power, &group.span).map(Some)
    }

    /// The argument that a name stands for within a function's formula.
    pub(super) fn argument(&self, node: &Node) -> Option<Typed> {
        if self.bound.is_empty() {
            return None;
        }
        let name = spelling(node);
        self.bound.iter().find(|(bound, _)| *bound == name).map(|(_, value)| value.clone())
    }

    /// The row of a column of cases whose conditions on indices hold.
    pub(super) fn case(&mut self, rows: &[Vec<Node>], node: &Node) -> Result<Typed> {
        for row in rows {
            let [value, conditions @ ..] = row.as_slice() else { continue };
            let conditions = conditions.iter().flat_map(|cell| match &cell.kind {
                Kind::List(items) => items.iter().collect(),
                _ => vec![cell],
            });
            let mut holds = true;
            let mut any = false;
            for condition in conditions {
                any = true;
                holds = holds && self.holds(condition)?;
            }
            if !any {
                let message = "a row of cases without a condition on indices is not evaluated";
                return Err(Error::unsupported(message, &value.span));
            }
            if holds {
                return self.value(value);
            }
        }
        Err(Error::unsupported("none of these cases holds", &node.span))
    }
}

#[cfg(test)]
mod tests {
    use crate::semantics::World;
    use crate::semantics::testing::{same, scope, value};

    const SYMBOLS: &str = r"
        [symbols]
        'a, b, x, I' = {}
        '\epsilon' = { index = [-1, 1], step = 2 }
        'k, n, m, p' = { index = [0, 3] }
        'f' = { same = '(a x^2 + 1)', function = ['x'] }
        'g' = { same = 'f(x + 1)', function = ['x', 'y'] }
        'K_k^{nm}' = { each = ['k', 'n', 'm'], function = ['I', '\epsilon'], same = '\begin{cases} \sin I & k = 0, n = 2 \\ \epsilon (m + n) \cos I & k \geq 1 \end{cases}' }
    ";

    #[test]
    fn formulas_with_other_arguments() {
        assert!(same(SYMBOLS, "f(2b)", "4 a b^2 + 1"));
        assert!(same(SYMBOLS, "f(x)", "a x^2 + 1"));
        assert!(same(SYMBOLS, "f(b)^2 - f(x)^2", "(a b^2 + 1)^2 - (a x^2 + 1)^2"));
        assert!(same(SYMBOLS, "f(f(b))", "a (a b^2 + 1)^2 + 1"));
        assert!(same(SYMBOLS, "g(b, a)", "a (b + 1)^2 + 1"));
        assert!(!same(SYMBOLS, "f(b)", "a b^2"));
    }

    #[test]
    fn families_by_cases() {
        assert!(same(SYMBOLS, r"\sum_{n=2}^2 \sum_{m=1}^1 \sum_{k=0}^1 K_k^{nm}(b, -1)", r"\sin b - 3 \cos b"));
        assert!(same(
            SYMBOLS,
            r"\sum_{n=2}^2 \sum_{m=1}^1 \sum_{\epsilon = \pm 1} K_{n-2}^{nm}(2b, \epsilon)",
            r"2 \sin 2b"
        ));
        assert!(same(SYMBOLS, r"\sum_{p=1}^2 \sum_{n=2}^2 K_{n-p}^{np}(b, 1)", r"3 \cos b + \sin b"));
        let error = value(&mut World::new(), &scope(SYMBOLS), r"\sum_{n=1}^1 \sum_{m=1}^1 \sum_{k=0}^0 K_k^{nm}(b, 1)");
        assert!(error.unwrap_err().message.contains("none of these cases"));
    }
}
