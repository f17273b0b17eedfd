//! Judging: sampled states, premises, verdicts.

mod book;
#[cfg(feature = "rug")]
mod certify;
mod choice;
mod circle;
mod claim;
pub mod computed;
mod decide;
pub mod dimension;
mod elimination;
pub mod exact;
mod general;
mod harmonics;
pub mod inspect;
mod judge;
mod law;
mod lost;
mod newton;
mod options;
mod order;
mod premises;
mod proportion;
mod random;
mod remark;
mod sameness;
mod sampling;
mod screen;
mod shrink;
mod stated;
mod stateless;
mod system;
mod trial;
mod trouble;
mod value;
pub mod verdict;

pub use book::{Book, Entry, Formula, Unclear, Version};
pub use judge::{blank, judge, judge_one, judge_tree};
pub use options::Options;
pub(crate) use random::Random;
pub use screen::{STATES, Screen, Sight};
pub use trial::{Outcome, Trial};
