//! What can be told of notes that declare nothing: which symbols they have and what these probably are, which equations
//! follow from which, and where one edit of what is printed would make an equation follow.
//!
//! A document that declares no symbols is given declarations, [guessed](roles) from the way the symbols are printed. Its
//! equations are then judged as any other. What is no identity is tried on the equations before it ([`premises`]); what
//! follows from nothing there is new: a law, an assumption, a definition. What would follow after one edit of the
//! printed formula is a [suspect](suspects).
//!
//! Promises: no equation fails because of a guess. What holds only where symbols are positive is undecided and says so;
//! what does not follow is no failure, unless it contradicts equations that the prose around it refers to.

mod candidates;
mod desk;
pub mod evidence;
mod fingerprint;
mod formulas;
mod judge;
mod letters;
mod near;
mod premises;
mod references;
mod reshape;
pub mod roles;
mod subsets;
mod suspects;
mod swaps;

pub use formulas::declare_functions;
pub use judge::Ground;

#[cfg(test)]
mod tests;
