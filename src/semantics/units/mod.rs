//! Units and dimensions: `kg m^2/s` is read as the dimension kg m² s⁻¹.
//!
//! A [`Dimension`] has a rational exponent for each base unit of the SI. A unit's size is not kept: the ranges of symbols
//! are in the units declared, and what is compared is dimensions. Radian, degree and percent are dimensionless.
//!
//! Promises: a dimension that is printed reads back as itself; a unit that cannot be read is an error with its place,
//! and never dimensionless by default; exponents that do not fit are `None`, never wrong.

mod dimension;
mod parse;
mod table;

#[cfg(test)]
mod tests;

pub use dimension::Dimension;
pub use parse::{UnitError, parse};
