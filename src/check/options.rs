//! What the checker is asked for.

use std::time::Duration;

/// What the checker is asked for.
#[derive(Clone, Debug)]
pub struct Options {
    /// The seed of the states.
    pub seed: u64,
    /// The number of states for each link.
    pub states: usize,
    /// The precision in bits to decide in, where one is asked for (feature `rug`); otherwise double-double.
    pub precision: Option<u32>,
    /// Whether a judgement is to say more than its verdict rests on: small counterexamples, their certificates (feature `rug`), the
    /// bits that doubles lose.
    pub evidence: bool,
    /// The time that each stage may take for an equation: judging it, judging its correction, trying its mutants,
    /// searching what was meant. `None` for no limit.
    pub budget: Option<Duration>,
}

impl Default for Options {
    fn default() -> Self {
        Options { seed: 1, states: 64, precision: None, evidence: true, budget: None }
    }
}
