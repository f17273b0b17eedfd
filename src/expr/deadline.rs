//! Time that runs out, and computations that outgrow every use.

use std::time::{Duration, Instant};

/// The moment at which the time for an equation is used up.
///
/// Once it has passed it stays passed: loops look at it and stop early, with whatever they have, and one look after a
/// stage tells whether the stage's result may be used.
#[derive(Clone, Copy, Debug, Default)]
pub struct Deadline {
    end: Option<Instant>,
    budget: Duration,
}

impl Deadline {
    /// No limit.
    pub const NEVER: Deadline = Deadline { end: None, budget: Duration::ZERO };

    /// So much time from now on; no limit where there is none.
    pub fn after(budget: Option<Duration>) -> Self {
        match budget {
            Some(budget) => Deadline { end: Instant::now().checked_add(budget), budget },
            None => Deadline::NEVER,
        }
    }

    /// Whether the time is used up.
    pub fn has_passed(&self) -> bool {
        self.end.is_some_and(|end| Instant::now() >= end)
    }

    /// That the time is used up, in words. `stage` says what it was used up with.
    pub fn used_up(&self, stage: &str) -> String {
        format!("the time budget of {} s is used up ({stage}); --budget SECONDS grants more", self.budget.as_secs_f64())
    }
}

/// Why a graph takes in nothing more.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cut {
    /// It has the most nodes that a graph may have.
    Size,
    /// The time is used up.
    Time,
}
