//! Understanding: from the syntax tree and the declared symbols to statements between typed values.
//!
//! Shapes live here and nowhere else: vectors, matrices, tuples and sums over particles are expanded into scalar
//! expressions of one [`Graph`](crate::expr::Graph). Vectors are kept in the components of one fixed (inertial)
//! frame, and a rotating basis is a triad of such vectors that depends on its angles; so d/dt is always taken
//! component by component.
//!
//! Promises: a value is only ever built from what is declared in the [`Scope`]; what cannot be understood is an
//! [`Error`] with its place, never a guess; a mismatch of shapes is told apart from a missing declaration, because the
//! first is the author's and the second is the annotator's.

mod apply;
mod at;
mod calculus;
mod complex;
mod counting;
mod cyclic;
mod definite;
mod elaborate;
mod element;
mod elliptic;
mod error;
mod function;
mod geometric;
mod index_range;
mod juxtaposition;
mod kronecker;
mod legendre;
mod limits;
mod link;
mod mean;
mod motion;
mod name;
mod notes;
mod partial;
mod poisson;
mod power;
mod quaternion;
mod ratio;
mod remainder;
mod scope;
mod sexagesimal;
mod signs;
mod statement;
mod symbol;
mod terms;
#[cfg(test)]
mod testing;
pub mod units;
mod value;
mod world;

pub use elaborate::{Elaborator, Typed};
pub use error::{Error, ErrorKind};
pub use geometric::is_geometric;
pub use index_range::without_index_ranges;
pub use link::{Instance, TypedLink, every_value, understand};
pub use name::spelling;
pub use remainder::{is_remainder, without_remainder};
pub use scope::{Basis, Entry, EntryKind, Scope, pattern_of};
pub use signs::independent_signs;
pub use statement::{Clause, Side, Statement, begins_with_relation, has_branches, mentions, relation_latex, statement};
pub use terms::{PrintedTerm, printed_terms};
pub use value::{Matrix, Value};
pub use world::{Facts, Joint, Quantity, Role, World};
