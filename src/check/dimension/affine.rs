//! Dimensions known up to those of some quantities, and what equations between them say.
//!
//! The exponents of a product add and those of a power multiply, so a dimension is linear in the unknown ones, and
//! equations are solved by elimination over the rationals.

use std::collections::BTreeMap;

use crate::expr::ratio::{self, Ratio};
use crate::semantics::units::Dimension;

/// A known dimension times powers of the unknown dimensions of some quantities, by their numbers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Affine {
    /// The known factor.
    pub known: Dimension,
    /// The exponents of the unknown dimensions, none of them zero.
    pub unknown: BTreeMap<usize, Ratio>,
}

impl Affine {
    /// A known dimension.
    pub fn of(known: Dimension) -> Self {
        Affine { known, unknown: BTreeMap::new() }
    }

    /// The dimension of a quantity of which nothing is known.
    pub fn unknown(quantity: usize) -> Self {
        Affine { known: Dimension::NONE, unknown: BTreeMap::from([(quantity, (1, 1))]) }
    }

    /// The dimension, where nothing in it is unknown.
    pub fn dimension(&self) -> Option<Dimension> {
        self.unknown.is_empty().then_some(self.known)
    }

    /// That of a product. `None` where an exponent does not fit.
    pub fn times(&self, other: &Affine) -> Option<Affine> {
        let mut unknown = self.unknown.clone();
        for (quantity, exponent) in &other.unknown {
            let sum = ratio::add(unknown.get(quantity).copied().unwrap_or((0, 1)), *exponent)?;
            match sum {
                (0, _) => unknown.remove(quantity),
                sum => unknown.insert(*quantity, sum),
            };
        }
        Some(Affine { known: self.known.times(&other.known)?, unknown })
    }

    /// That of a power. `None` where an exponent does not fit.
    pub fn to_the(&self, n: Ratio) -> Option<Affine> {
        if n.0 == 0 {
            return Some(Affine::of(Dimension::NONE));
        }
        let power = |(quantity, exponent): (&usize, &Ratio)| Some((*quantity, ratio::mul(*exponent, n)?));
        let unknown = self.unknown.iter().map(power).collect::<Option<_>>()?;
        Some(Affine { known: self.known.to_the(n)?, unknown })
    }

    /// That of a quotient. `None` where an exponent does not fit.
    pub fn over(&self, other: &Affine) -> Option<Affine> {
        self.times(&other.to_the((-1, 1))?)
    }
}

/// What an equation between dimensions does to a [`System`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// The sides agree, whatever the unknown dimensions are.
    Agrees,
    /// They are made to agree by what this says of an unknown dimension.
    Binds,
    /// They do not agree, whatever the unknown dimensions are.
    Contradicts,
}

/// What is known of unknown dimensions.
#[derive(Clone, Debug, Default)]
pub struct System {
    /// Quantities with their dimensions in terms of those that stand in no row, and who said so.
    rows: BTreeMap<usize, (Affine, usize)>,
}

impl System {
    /// A dimension by what is known. An exponent that does not fit leaves it as it is.
    pub fn reduce(&self, a: &Affine) -> Affine {
        let reduced = a.unknown.iter().try_fold(Affine::of(a.known), |acc, (quantity, exponent)| {
            let of_quantity = match self.rows.get(quantity) {
                Some((row, _)) => row.clone(),
                None => Affine::unknown(*quantity),
            };
            acc.times(&of_quantity.to_the(*exponent)?)
        });
        reduced.unwrap_or_else(|| a.clone())
    }

    /// Takes in that two dimensions are the same, as `origin` says. A contradiction changes nothing.
    pub fn equate(&mut self, a: &Affine, b: &Affine, origin: usize) -> Outcome {
        let Some(ratio) = a.over(b).map(|r| self.reduce(&r)) else { return Outcome::Agrees };
        // The quantity met last is expressed by those met before it.
        let Some((&pivot, &exponent)) = ratio.unknown.last_key_value() else {
            return if ratio.known.is_none() { Outcome::Agrees } else { Outcome::Contradicts };
        };
        let mut rest = ratio;
        rest.unknown.remove(&pivot);
        let row = ratio::recip(exponent).and_then(ratio::neg).and_then(|n| rest.to_the(n));
        let Some(row) = row else { return Outcome::Agrees };
        self.rows.insert(pivot, (row, origin));
        let reduced: Vec<(usize, Affine)> = self.rows.iter().map(|(q, (row, _))| (*q, self.reduce(row))).collect();
        for (quantity, row) in reduced {
            if let Some(old) = self.rows.get_mut(&quantity) {
                old.0 = row;
            }
        }
        Outcome::Binds
    }

    /// The quantities whose dimensions have been found, with who said so.
    pub fn found(&self) -> impl Iterator<Item = (usize, Dimension, usize)> {
        self.rows.iter().filter_map(|(quantity, (row, origin))| Some((*quantity, row.dimension()?, *origin)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::semantics::units;

    fn known(text: &str) -> Affine {
        Affine::of(units::parse(text).unwrap())
    }

    #[test]
    fn unknown_dimensions_follow_from_equations() {
        let mut system = System::default();
        let (x, y) = (Affine::unknown(0), Affine::unknown(1));
        // x² y = kg m, x / y = kg m⁻² : x³ = kg² m⁻¹
        let square = x.to_the((2, 1)).unwrap().times(&y).unwrap();
        assert_eq!(system.equate(&square, &known("kg m"), 7), Outcome::Binds);
        assert_eq!(system.equate(&x.over(&y).unwrap(), &known("kg m^-2"), 8), Outcome::Binds);
        let found: Vec<_> = system.found().map(|(q, d, origin)| (q, d.to_string(), origin)).collect();
        assert_eq!(found, [(0, "kg^(2/3) m^(-1/3)".into(), 8), (1, "kg^(-1/3) m^(5/3)".into(), 7)]);
        assert_eq!(system.equate(&square, &known("kg m"), 9), Outcome::Agrees);
        assert_eq!(system.equate(&x, &known("s"), 9), Outcome::Contradicts);
    }

    #[test]
    fn an_unknown_that_cancels_cannot_mend_a_contradiction() {
        let mut system = System::default();
        let rate = Affine::unknown(0).over(&known("s")).unwrap();
        assert_eq!(system.equate(&rate, &Affine::unknown(0), 0), Outcome::Contradicts);
        assert_eq!(system.equate(&rate, &rate, 0), Outcome::Agrees);
    }
}
