//! How many equations have which verdict.

use crate::check::verdict::{Judgement, Strength, Verdict};
use schemars::JsonSchema;
use serde::Serialize;

/// All verdicts, in the order in which reports list them.
pub(super) const ORDER: [Verdict; 7] = [
    Verdict::Holds,
    Verdict::Asymptotic,
    Verdict::Definition,
    Verdict::Statement,
    Verdict::Fails,
    Verdict::Undecided,
    Verdict::Unreadable,
];

/// How many equations have which verdict.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, JsonSchema)]
pub struct Counts {
    /// All equations.
    pub total: usize,
    /// `holds`
    pub holds: usize,
    /// Those of them that hold exactly: all trials in a prime field vanish.
    pub exact: usize,
    /// `asymptotic`
    pub asymptotic: usize,
    /// `definition`
    pub definition: usize,
    /// `statement`
    pub statement: usize,
    /// `fails`
    pub fails: usize,
    /// Those of them that are proved to fail, at a state that is known exactly.
    pub certified: usize,
    /// `undecided`
    pub undecided: usize,
    /// `unreadable`
    pub unreadable: usize,
    /// Those that fail, or cannot be judged as printed, while their correction holds.
    pub errata: usize,
    /// Those of them that cannot be judged as printed.
    pub errata_lost: usize,
    /// Those that hold, or whose correction does, as a premise says the same in as many terms.
    pub restated: usize,
    /// Those whose verdict is not as expected.
    pub unexpected: usize,
}

impl Counts {
    /// Counts judgements.
    pub fn of<'a>(judgements: impl IntoIterator<Item = &'a Judgement>) -> Self {
        let mut counts = Counts::default();
        for judgement in judgements {
            counts.total += 1;
            *counts.slot(judgement.verdict) += 1;
            counts.exact +=
                usize::from(judgement.verdict == Verdict::Holds && judgement.strength == Some(Strength::Exact));
            counts.certified +=
                usize::from(judgement.verdict == Verdict::Fails && judgement.strength == Some(Strength::Certified));
            counts.errata += usize::from(judgement.is_erratum());
            counts.errata_lost += usize::from(judgement.is_erratum() && judgement.verdict != Verdict::Fails);
            let links = judgement.correction.as_ref().map_or(&judgement.links, |c| &c.links);
            counts.restated += usize::from(Judgement::only_restates(links));
            counts.unexpected += usize::from(!judgement.as_expected);
        }
        counts
    }

    /// The number with a verdict.
    pub fn with(mut self, verdict: Verdict) -> usize {
        *self.slot(verdict)
    }

    fn slot(&mut self, verdict: Verdict) -> &mut usize {
        match verdict {
            Verdict::Holds => &mut self.holds,
            Verdict::Asymptotic => &mut self.asymptotic,
            Verdict::Definition => &mut self.definition,
            Verdict::Statement => &mut self.statement,
            Verdict::Fails => &mut self.fails,
            Verdict::Undecided => &mut self.undecided,
            Verdict::Unreadable => &mut self.unreadable,
        }
    }
}
