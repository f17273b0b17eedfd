//! Dimensions: products of powers of the SI's base units.

use std::fmt;

use crate::expr::ratio::{self, Ratio};

/// The base units, in the order in which a dimension is printed.
pub(super) const BASE: [&str; 7] = ["kg", "m", "s", "A", "K", "mol", "cd"];

/// A dimension: the exponents of kg, m, s, A, K, mol and cd, fractions in lowest terms.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Dimension([Ratio; 7]);

impl Dimension {
    /// That of a number.
    pub const NONE: Dimension = Dimension([(0, 1); 7]);
    /// That of a time.
    pub const TIME: Dimension = Dimension::base(2);

    /// That of a base unit, by its place in the order kg, m, s, A, K, mol, cd.
    pub(super) const fn base(k: usize) -> Dimension {
        let mut exponents = [(0, 1); 7];
        exponents[k] = (1, 1);
        Dimension(exponents)
    }

    /// The dimension with integer exponents of kg, m, s, A, K, mol and cd.
    pub(super) const fn of(exponents: [i8; 7]) -> Dimension {
        let mut ratios = [(0, 1); 7];
        let mut k = 0;
        while k < 7 {
            ratios[k] = (exponents[k] as i128, 1);
            k += 1;
        }
        Dimension(ratios)
    }

    /// Whether it is that of a number.
    pub fn is_none(&self) -> bool {
        *self == Dimension::NONE
    }

    /// That of a product. `None` where an exponent does not fit.
    pub fn times(&self, other: &Dimension) -> Option<Dimension> {
        let mut product = [(0, 1); 7];
        for (k, exponent) in product.iter_mut().enumerate() {
            *exponent = ratio::add(self.0[k], other.0[k])?;
        }
        Some(Dimension(product))
    }

    /// That of a power. `None` where an exponent does not fit.
    pub fn to_the(&self, n: Ratio) -> Option<Dimension> {
        let mut power = [(0, 1); 7];
        for (k, exponent) in power.iter_mut().enumerate() {
            *exponent = ratio::mul(self.0[k], n)?;
        }
        Some(Dimension(power))
    }

    /// That of a quotient. `None` where an exponent does not fit.
    pub fn over(&self, other: &Dimension) -> Option<Dimension> {
        self.times(&other.to_the((-1, 1))?)
    }

    /// The same with exponents given; for tests.
    #[cfg(test)]
    pub(super) fn with_exponents(exponents: [Ratio; 7]) -> Dimension {
        Dimension(exponents)
    }
}

/// `kg m² s⁻¹`, `m^(1/2)`, and `1` for that of a number.
impl fmt::Display for Dimension {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut first = true;
        for (name, exponent) in BASE.iter().zip(self.0) {
            if exponent.0 == 0 {
                continue;
            }
            if !std::mem::take(&mut first) {
                f.write_str(" ")?;
            }
            f.write_str(name)?;
            match exponent {
                (1, 1) => {}
                (n, 1) => f.write_str(&superscript(n))?,
                (n, d) => write!(f, "^({n}/{d})")?,
            }
        }
        if first { f.write_str("1") } else { Ok(()) }
    }
}

/// The superscript digits and the superscript minus.
pub(super) const SUPERSCRIPTS: [char; 11] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹', '⁻'];

fn superscript(n: i128) -> String {
    let raised = |c: char| SUPERSCRIPTS[c.to_digit(10).map_or(10, |d| d as usize)];
    n.to_string().chars().map(raised).collect()
}
