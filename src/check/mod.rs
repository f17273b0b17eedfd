//! Judging: sampled states, premises, verdicts.

pub mod verdict;
