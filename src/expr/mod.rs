//! Scalar expressions: a graph with shared subexpressions, and calculus on it.

pub mod diff;
mod display;
pub mod graph;
mod ratio;

pub use crate::number::Func;
pub use graph::{Expr, Graph, Node, SymId, SymbolInfo};

#[cfg(test)]
mod tests;
