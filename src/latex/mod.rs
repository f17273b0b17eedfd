//! The LaTeX of one equation, read into a syntax tree in which every node knows its bytes.

pub mod ast;
mod stub;
mod walk;
pub use stub::*;
