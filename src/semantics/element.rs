//! Integrals over the mass of a body, as sums over a handful of particles.
//!
//! A mass element is declared as what has one value for each particle: `'dM_1' = { each = "i", unit = "kg" }`, beside the
//! position of a particle, `'\vec{\rho}_1' = { each = "i", .. }`. Then `\int f\,dM_1` is the sum over the particles of that
//! body, `\int f\,dM_1 dM_2` a sum over pairs, and what stands behind the differential is summed as well: `\int dM_1 [f]`.
//! Whatever is true of every body is true of these.

use crate::latex::ast::{BigOp, Kind, Node};

use super::elaborate::Elaborator;
use super::juxtaposition::{Item, flatten, summed_again};

impl Elaborator<'_> {
    /// The indices of the mass elements that an integral integrates over; none where it is another integral.
    pub(super) fn particles(&self, integrand: &[&Node]) -> Vec<String> {
        let mut found = Vec::new();
        for pair in integrand.windows(2) {
            let name = format!("{}{}", super::name::spelling(pair[0]), super::name::spelling(pair[1]));
            if !matches!(&pair[0].kind, Kind::Symbol(d) if d == "d") {
                continue;
            }
            found.extend(self.scope.get(&name).into_iter().flat_map(|entry| entry.hidden.iter().cloned()));
        }
        // dM_1 dM_2 / Δ
        for node in integrand {
            if let Kind::Frac(numerator, _) = &node.kind {
                found.extend(self.particles(&factors(numerator)));
            }
        }
        found.sort();
        found.dedup();
        found
    }

    /// How many of the items behind a big operator it acts on: all of them, but a mass integral that has had its
    /// differential ends where the next begins, and a sum where its letter is bound anew. `printed` is the operator with
    /// its scripts.
    pub(super) fn reach(&self, operator: &Node, printed: &Node, rest: &[Item]) -> usize {
        let before = |next: usize| {
            let joined = rest[..next].iter().rev().take_while(|item| matches!(item, Item::Op(..))).count();
            next - joined
        };
        let begins = |item: &Item| matches!(item, Item::Factor(n) if is_integral(n));
        match rest.iter().position(begins) {
            Some(next) if is_integral(operator) && !self.particles(&factors_of(&rest[..next])).is_empty() => {
                before(next)
            }
            _ => summed_again(printed, rest).map_or(rest.len(), before),
        }
    }
}

/// The factors of a product.
pub(super) fn factors(node: &Node) -> Vec<&Node> {
    let mut items = Vec::new();
    flatten(node, &mut items);
    factors_of(&items)
}

/// The factors among some items.
pub(super) fn factors_of<'n>(items: &[Item<'n>]) -> Vec<&'n Node> {
    let factors = items.iter().filter_map(|item| match item {
        Item::Factor(n) => Some(*n),
        Item::Op(..) => None,
    });
    factors.collect()
}

/// Whether an operator integrates.
pub(super) fn is_integral(node: &Node) -> bool {
    matches!(node.kind, Kind::BigOp(BigOp::Integral | BigOp::DoubleIntegral))
}

#[cfg(test)]
mod tests {
    use crate::semantics::World;
    use crate::semantics::testing::{same, scope, value};

    const SYMBOLS: &str = r#"
        [symbols]
        'i' = { index = [1, 2] }
        'k' = { index = [1, 3] }
        'a' = {}
        'dM_1' = { each = "i" }
        'dM_2' = { each = "k" }
        '\vec{x}_1' = { each = "i", vector = "" }
        '\vec{x}_2' = { each = "k", vector = "" }
        'm_i' = { same = 'dM_1', each = "i" }
        'n_k' = { same = 'dM_2', each = "k" }
        '\vec{p}_i' = { same = '\vec{x}_1', each = "i" }
        '\vec{q}_k' = { same = '\vec{x}_2', each = "k" }
    "#;

    #[test]
    fn single_and_double_integrals() {
        assert!(same(SYMBOLS, r"\int \vec{x}_1^2 dM_1", r"\sum_i m_i \vec{p}_i^2"));
        assert!(same(SYMBOLS, r"\int dM_1 [a + \vec{x}_1^2]", r"\sum_i m_i (a + \vec{p}_i^2)"));
        let pairs = r"\sum_{i,k} m_i n_k \vec{p}_i \cdot \vec{q}_k";
        assert!(same(SYMBOLS, r"\int \vec{x}_1 \cdot \vec{x}_2 dM_1 dM_2", pairs));
        assert!(same(SYMBOLS, r"\iint \vec{x}_1 \cdot \vec{x}_2 dM_1 dM_2", pairs));
        assert!(same(SYMBOLS, r"\int \vec{x}_1 dM_1 \cdot \int \vec{x}_2 dM_2", pairs));
        assert!(same(SYMBOLS, r"\int \frac{dM_1 dM_2}{a}", r"\frac{1}{a} \int dM_1 \int dM_2"));
        // The sum of a sum: each has particles of its own.
        assert!(same(SYMBOLS, r"\int \vec{x}_1 \cdot (\int \vec{x}_1 dM_1) dM_1", r"(\sum_i m_i \vec{p}_i)^2"));
        assert!(!same(SYMBOLS, r"\int \vec{x}_1^2 dM_1", r"\int \vec{x}_1 dM_1 \cdot \int \vec{x}_1 dM_1"));
    }

    #[test]
    fn what_no_element_carries_stays_free() {
        let error = value(&mut World::new(), &scope(SYMBOLS), r"\int \vec{x}_2 dM_1").unwrap_err();
        assert!(error.message.contains("index k"), "{error:?}");
    }
}
