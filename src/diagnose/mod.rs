//! Diagnosis: how sensitive a check is, and what was probably meant.
//!
//! [`mutants`] makes the formulas that differ from a given one by a single edit; [`sensitivity`] tries the mutants of a
//! formula that holds, [`correct`] searches the neighbours of one that fails. Both are judged by
//! [`Trial`](crate::check::Trial), which is the check itself.

pub mod correct;
mod edits;
pub mod mutants;
mod names;
pub mod sensitivity;

#[cfg(test)]
mod tests;
