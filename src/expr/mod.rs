//! Scalar expressions: a graph with shared subexpressions, and calculus on it.

mod deadline;
pub mod diff;
mod display;
mod elliptic;
pub mod field;
pub mod graph;
pub mod integral;
mod magnitude;
mod parts;
pub(crate) mod ratio;
mod rewrite;
pub mod tape;

pub use crate::number::{Elliptic, Func};
pub use deadline::{Cut, Deadline};
pub use graph::{Expr, Graph, MOST_NODES, Node, SymId, SymbolInfo};
pub use integral::Bound;
pub use parts::Parts;
pub use tape::{Tape, Workspace};

#[cfg(test)]
mod elliptic_tests;
#[cfg(test)]
mod random_tests;
#[cfg(test)]
mod tape_tests;
#[cfg(test)]
mod tests;
