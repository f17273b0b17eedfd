//! Which candidates may together imply a formula, by what they speak of.
//!
//! Symbols that the formula does not speak of have to be eliminated. So each of them must occur in at least two of the
//! premises (in one, it only makes room for that one), there must be more equations than symbols to eliminate, and the
//! premises must hang together. Derivatives by time say more than what they are taken of: where something moves only
//! the last is asked for.

use std::collections::{BTreeMap, BTreeSet};

use super::candidates::{Candidate, Spoken};

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

/// Whether the symbols that the formula does not speak of can be eliminated. A statement that has as many symbols to itself
/// as it makes equations only makes room for these: it is left out, and none may be left of a premise.
fn eliminate(target: &Spoken, premises: &[&Candidate]) -> bool {
    let statements = premises.iter().enumerate().flat_map(|(k, p)| p.parts.iter().map(move |part| (k, part)));
    let mut statements: Vec<(usize, &(BTreeSet<String>, usize))> = statements.collect();
    loop {
        let mut count: BTreeMap<&str, usize> = BTreeMap::new();
        let strangers = |part: &&(usize, &(BTreeSet<String>, usize))| part.1.0.difference(&target.symbols).count();
        for (_, (symbols, _)) in &statements {
            symbols.difference(&target.symbols).for_each(|s| *count.entry(s).or_insert(0) += 1);
        }
        let own = |symbols: &BTreeSet<String>| symbols.iter().filter(|s| count.get(s.as_str()) == Some(&1)).count();
        let makes_room =
            |part: &(usize, &(BTreeSet<String>, usize))| strangers(&part) > 0 && own(&part.1.0) >= part.1.1;
        match statements.iter().position(makes_room) {
            Some(k) => drop(statements.remove(k)),
            None => {
                let equations: usize = statements.iter().map(|(_, (_, equations))| equations).sum();
                let needed = (0..premises.len()).all(|k| statements.iter().any(|(premise, _)| *premise == k));
                return needed && equations > count.len();
            }
        }
    }
}
