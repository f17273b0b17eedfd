//! Which candidates may together imply a formula, by what they speak of.
//!
//! Symbols that the formula does not speak of have to be eliminated. So each of them must occur in at least two of the
//! premises (in one, it only makes room for that one), there must be more equations than symbols to eliminate, and the
//! premises must hang together. Derivatives by time say more than what they are taken of: where something moves only
//! the last is asked for.

use std::collections::BTreeSet;

use super::candidates::{Candidate, Spoken, occurrences};

/// The most premises of which all combinations are tried.
pub const LARGEST: usize = 4;
/// The most combinations that are looked at for each size.
const MOST_LOOKED_AT: usize = 40_000;

/// The sets of candidates, by their places in the list, that may imply a formula: smaller ones first, and among those of
/// one size the ones that stand first in the list. At most `most` of each size.
pub fn subsets(target: &Spoken, candidates: &[&Candidate], most: usize) -> Vec<Vec<usize>> {
    let mut search = Search { target, candidates, found: Vec::new(), looked_at: 0, most };
    for size in 1..=LARGEST {
        search.looked_at = 0;
        search.most = search.found.len() + most;
        search.extend(&mut Vec::new(), size);
    }
    search.found
}

struct Search<'c> {
    target: &'c Spoken,
    candidates: &'c [&'c Candidate],
    found: Vec<Vec<usize>>,
    looked_at: usize,
    most: usize,
}

impl Search<'_> {
    fn extend(&mut self, chosen: &mut Vec<usize>, size: usize) {
        if chosen.len() == size {
            self.looked_at += 1;
            if self.may_imply(chosen) {
                self.found.push(chosen.clone());
            }
            return;
        }
        let from = chosen.last().map_or(0, |last| last + 1);
        for next in from..self.candidates.len() {
            if self.looked_at >= MOST_LOOKED_AT || self.found.len() >= self.most {
                return;
            }
            chosen.push(next);
            self.extend(chosen, size);
            chosen.pop();
        }
    }

    fn may_imply(&self, chosen: &[usize]) -> bool {
        let premises: Vec<&Candidate> = chosen.iter().map(|k| self.candidates[*k]).collect();
        hang_together(self.target, &premises) && (moves(self.target, &premises) || eliminate(self.target, &premises))
    }
}

fn moves(target: &Spoken, premises: &[&Candidate]) -> bool {
    target.moves || premises.iter().any(|p| p.moves)
}

/// Whether each premise shares a symbol with the formula, directly or by others.
pub fn hang_together(target: &Spoken, premises: &[&Candidate]) -> bool {
    let mut reached: BTreeSet<&str> = target.symbols.iter().map(String::as_str).collect();
    let mut left: Vec<&&Candidate> = premises.iter().collect();
    loop {
        let before = left.len();
        left.retain(|p| {
            let touches = p.symbols.iter().any(|s| reached.contains(s.as_str()));
            if touches {
                reached.extend(p.symbols.iter().map(String::as_str));
            }
            !touches
        });
        if left.is_empty() {
            return true;
        }
        if left.len() == before {
            return false;
        }
    }
}

/// Whether the symbols that the formula does not speak of can be eliminated.
fn eliminate(target: &Spoken, premises: &[&Candidate]) -> bool {
    let count = occurrences(premises.iter().copied());
    let strangers: Vec<&str> = count.keys().filter(|s| !target.symbols.contains(**s)).copied().collect();
    let equations: usize = premises.iter().map(|p| p.equations).sum();
    let private = |p: &&Candidate| {
        p.equations == 1 && p.symbols.iter().any(|s| count[s.as_str()] == 1 && !target.symbols.contains(s))
    };
    equations > strangers.len() && !premises.iter().any(private)
}
