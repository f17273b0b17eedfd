//! Numerical stability: where the formulas of notes lose their digits in doubles, whether that is the problem's fault
//! or the formula's, and forms that do not.
//!
//! [`search`](search::search) looks for the states at which a formula loses most, [`meter`] says what is lost there
//! and what the condition number accounts for, `propose` searches a stable form by rewriting, [`same`](same::same)
//! decides whether two forms are the same formula. [`survey`] does all this for every formula of a document,
//! [`catalogue`] for hard cases that are known, with stable forms from the literature.

pub mod catalogue;
mod extract;
pub mod meter;
mod propose;
mod rules;
pub mod same;
pub mod search;
mod space;
mod speed;
pub mod survey;
mod term;
mod write_latex;
