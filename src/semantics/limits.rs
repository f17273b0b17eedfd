//! What sums run through: `\sum_i`, `\sum_{i=1}^{3}`, `\sum_{j \neq k}`, `\sum_{\epsilon, \delta = \pm 1}`,
//! `\sum_{p,q,r=0}^n`, and sums that print no limits.

use crate::latex::ast::{Kind, Link, Node, Rel, Sign, Span};

use super::elaborate::Elaborator;
use super::error::{Error, Result};
use super::juxtaposition::Item;
use super::link::{MOST_ASSIGNMENTS, assignments, too_many};
use super::name::spelling;

/// The letters that a range is printed for, and its values.
type Range = (Vec<String>, Vec<i64>);

/// Values of indices.
type Assignment = Vec<(String, i64)>;

impl Elaborator<'_> {
    /// The assignments of indices that a sum runs through.
    pub(super) fn index_values(
        &mut self,
        sub: Option<&Node>,
        sup: Option<&Node>,
        body: &[Item],
        span: &Span,
    ) -> Result<Vec<Assignment>> {
        let parts = match sub {
            None => Vec::new(),
            Some(Node { kind: Kind::List(parts), .. }) => parts.iter().collect(),
            Some(other) => vec![other],
        };
        let Some(ranges) = self.ranges(&parts, sup, span)? else {
            return self.declared_values(sub, body, span);
        };
        let mut all: Vec<Assignment> = vec![Vec::new()];
        for (letters, values) in &ranges {
            for letter in letters {
                let count = all.len() as i128 * values.len() as i128;
                if count > MOST_ASSIGNMENTS {
                    return Err(too_many("a sum", count, span));
                }
                let longer = |a: &Assignment, v: i64| a.iter().cloned().chain([(letter.clone(), v)]).collect();
                all = all.iter().flat_map(|a| values.iter().map(move |v| longer(a, *v))).collect();
            }
        }
        let conditions = parts.iter().filter(|part| range(part, sup).is_none());
        conditions.filter(|part| matches!(part.kind, Kind::Chain { .. })).try_fold(all, |all, c| self.kept(all, c))
    }

    /// The letters that each range is printed for, with its values: `\epsilon, \delta = \pm 1` gives one to both. `None`
    /// where no range is printed.
    fn ranges(&mut self, parts: &[&Node], sup: Option<&Node>, span: &Span) -> Result<Option<Vec<Range>>> {
        let mut ranges = Vec::new();
        let mut letters = Vec::new();
        for part in parts {
            match range(part, sup) {
                Some((letter, from)) => {
                    letters.push(letter);
                    ranges.push((std::mem::take(&mut letters), self.range_values(from, sup, span)?));
                }
                None if matches!(part.kind, Kind::Chain { .. }) => {}
                None => letters.push(spelling(part)),
            }
        }
        Ok((!ranges.is_empty() && letters.is_empty()).then_some(ranges))
    }

    fn range_values(&mut self, from: &Node, sup: Option<&Node>, span: &Span) -> Result<Vec<i64>> {
        if let Some(size) = sign(from) {
            let size = self.integer(size)?;
            return Ok(vec![-size, size]);
        }
        let Some(last) = sup else { return Ok(Vec::new()) };
        let (from, to) = (self.integer(from)?, self.integer(last)?);
        let count = i128::from(to) - i128::from(from) + 1;
        if count > MOST_ASSIGNMENTS {
            return Err(too_many("a sum", count, span));
        }
        Ok((from..=to).collect())
    }

    /// The values of the declared indices below a sum, or behind one that has nothing below it.
    fn declared_values(&mut self, sub: Option<&Node>, body: &[Item], span: &Span) -> Result<Vec<Assignment>> {
        let letters = match sub {
            Some(sub) => self.unbound_indices(&[Item::Factor(sub)]),
            None => self.unbound_indices(body),
        };
        if letters.is_empty() {
            let missing = sub.map(|sub| match &sub.kind {
                Kind::Chain { first: Some(first), .. } => spelling(first),
                _ => spelling(sub),
            });
            let error = Error { missing, ..Error::undeclared("this sum names no declared index", span) };
            return Err(error.with_help("declare the index under [symbols], as in 'i' = { index = [1, 3] }"));
        }
        let all = assignments(self.scope, &letters, span)?;
        match sub {
            Some(condition @ Node { kind: Kind::Chain { first: Some(_), .. }, .. }) => self.kept(all, condition),
            _ => Ok(all),
        }
    }

    /// The assignments for which a condition holds.
    fn kept(&mut self, all: Vec<Assignment>, condition: &Node) -> Result<Vec<Assignment>> {
        let mut kept = Vec::new();
        for assignment in all {
            let depth = self.indices.len();
            self.indices.extend(assignment.iter().cloned());
            let holds = self.holds(condition);
            self.indices.truncate(depth);
            if holds? {
                kept.push(assignment);
            }
        }
        Ok(kept)
    }

    /// Whether a condition on indices holds: a chain of relations between whole numbers. `n - m = \text{odd}` and
    /// `= \text{even}` say what their words say.
    pub(super) fn holds(&mut self, condition: &Node) -> Result<bool> {
        let Kind::Chain { first: Some(first), links } = &condition.kind else {
            return Err(Error::unsupported("a condition on indices is expected here", &condition.span));
        };
        let mut left = self.index_number(first)?;
        for link in links {
            if let (Rel::Eq, Some(odd)) = (link.rel, parity(&link.rhs)) {
                if (left.rem_euclid(2) == 1) != odd {
                    return Ok(false);
                }
                continue;
            }
            let right = self.index_number(&link.rhs)?;
            let holds = match link.rel {
                Rel::Ne => left != right,
                Rel::Lt => left < right,
                Rel::Gt => left > right,
                Rel::Le => left <= right,
                Rel::Ge => left >= right,
                Rel::Eq => left == right,
                _ => return Err(Error::unsupported("an unknown condition on indices", &link.rel_span)),
            };
            if !holds {
                return Ok(false);
            }
            left = right;
        }
        Ok(true)
    }

    /// A whole number in a condition. A letter is an index here, whatever else it may be.
    fn index_number(&mut self, node: &Node) -> Result<i64> {
        let name = spelling(node);
        match self.index_value(&name) {
            Some(v) => Ok(v),
            None if matches!(node.kind, Kind::Symbol(_)) => {
                Err(Error::undeclared(format!("the index {name} has no value here"), &node.span))
            }
            None => self.integer(node),
        }
    }
}

/// The letter of `i = 1` with a last value above the sum, or of `\epsilon = \pm 1`, and what it begins with.
fn range<'n>(part: &'n Node, sup: Option<&Node>) -> Option<(String, &'n Node)> {
    match &part.kind {
        Kind::Chain { first: Some(letter), links } => match links.as_slice() {
            [Link { rel: Rel::Eq, rhs, .. }] if (sup.is_some() || sign(rhs).is_some()) && parity(rhs).is_none() => {
                Some((spelling(letter), rhs))
            }
            _ => None,
        },
        _ => None,
    }
}

/// The number of `\pm 1`.
fn sign(node: &Node) -> Option<&Node> {
    match &node.kind {
        Kind::Sum(terms) => match terms.as_slice() {
            [term] if matches!(term.sign, Sign::PlusMinus | Sign::MinusPlus) => Some(&term.node),
            _ => None,
        },
        _ => None,
    }
}

/// Whether a word says odd (true) or even (false).
fn parity(node: &Node) -> Option<bool> {
    match &node.kind {
        Kind::Text(text) => match text.trim() {
            "odd" | "奇数" => Some(true),
            "even" | "偶数" => Some(false),
            _ => None,
        },
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use crate::semantics::World;
    use crate::semantics::testing::{same, scope, value};

    const SYMBOLS: &str = r"
        [symbols]
        '\epsilon, \delta' = { index = [-1, 1], step = 2 }
        'p, q' = { index = [0, 3] }
        'a, b' = {}
        'm' = { index = [2, 3] }
    ";

    #[test]
    fn signs() {
        assert!(same(SYMBOLS, r"\sum_{\epsilon=\pm 1} \epsilon \sin(a + \epsilon b)", r"2 \cos a \sin b"));
        assert!(same(SYMBOLS, r"\sum_{\epsilon,\delta=\pm 1} (a + \epsilon + \delta b)^2", r"4 (a^2 + b^2 + 1)"));
        assert!(same(SYMBOLS, r"\sum_{\epsilon,\delta} (a + \epsilon + \delta b)^2", r"4 (a^2 + b^2 + 1)"));
        assert!(same(SYMBOLS, r"\sum (a + \epsilon b)^2", r"2 (a^2 + b^2)"));
        assert!(!same(SYMBOLS, r"\sum_{\epsilon=\pm 1} (a + \epsilon b)^2", r"a^2 + b^2"));
    }

    #[test]
    fn one_range_for_several() {
        assert!(same(SYMBOLS, r"\sum_{p,q=0}^2 a^p b^q", r"(1 + a + a^2)(1 + b + b^2)"));
        assert!(same(SYMBOLS, r"\sum_{p=0, q=0}^2 a^p b^q", r"(1 + a + a^2)(1 + b + b^2)"));
        assert!(same(SYMBOLS, r"\sum_{p,q=0, p < q}^2 a^p b^q", r"b + b^2 + a b^2"));
        assert!(same(SYMBOLS, r"\sum_{p \neq 2} a^p", r"1 + a + a^3"));
        assert!(same(SYMBOLS, r"\sum_{p=0, p = \text{odd}}^3 a^p", r"a + a^3"));
        // The letter of a sum is its own, declared or not.
        assert!(same(SYMBOLS, r"\sum_{s=1}^3 s a^s + \sum_{a=1}^2 a b", r"a + 2a^2 + 3a^3 + 3b"));
    }

    #[test]
    fn unknown_letters_are_refused() {
        let error = value(&mut World::new(), &scope(SYMBOLS), r"\sum_{p=0, p < z}^3 a^p").unwrap_err();
        assert!(error.message.contains('z'), "{error:?}");
    }
}
