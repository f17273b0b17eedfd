//! Judging: sampled states, premises, verdicts.

mod book;
mod choice;
mod claim;
mod decide;
pub mod dimension;
pub mod inspect;
mod judge;
mod newton;
mod order;
mod premises;
mod random;
mod sampling;
mod system;
pub mod verdict;

pub use book::{Book, Entry, Formula, Unclear, Version};
pub use judge::{Options, blank, judge};
