//! Judging: sampled states, premises, verdicts.

mod book;
#[cfg(feature = "rug")]
mod certify;
mod choice;
mod claim;
mod decide;
pub mod dimension;
mod elimination;
pub mod exact;
pub mod inspect;
mod judge;
mod lost;
mod newton;
mod order;
mod premises;
mod random;
mod sameness;
mod sampling;
mod shrink;
mod system;
mod trial;
mod trouble;
pub mod verdict;

pub use book::{Book, Entry, Formula, Unclear, Version};
pub use judge::{Options, blank, judge};
pub use trial::{Outcome, Trial};
