//! Diagnosis: how sensitive a check is, and what was probably meant.
//!
//! [`mutants`] makes the formulas that differ from a given one by a single edit; [`sensitivity`] tries the mutants of a
//! formula that holds, [`correct`] searches the neighbours of one that fails. Both are judged by
//! [`Trial`](crate::check::Trial), which is the check itself.

mod change;
pub mod correct;
mod dots;
mod edits;
mod lexicon;
mod likeness;
pub mod measure;
pub mod mutants;
mod names;
mod near;
pub mod sensitivity;
pub use shape::is_null;
pub use singles::{Edited, slips};
mod shape;
mod sides;
mod singles;
pub mod stability;
mod tries;
mod wider;

#[cfg(test)]
mod tests;
