//! What an equation may follow from, in the order in which it is tried: candidates one by one, in small sets, and at last
//! all that hang together.

use std::collections::BTreeSet;

use crate::check::Book;

use super::candidates::{Candidate, Origin, Spoken};
use super::desk::Basis;
use super::subsets::{LARGEST, hang_together, subsets};

/// How many candidates are combined, the nearest.
const NEAREST: usize = 24;
/// How many sets of each size are judged.
const JUDGED: usize = 40;
/// The sizes of the larger sets that are tried as a whole.
const LADDER: [usize; 3] = [6, 9, 14];
/// How many equations are tried as what a solution solves, and with how many sets each.
const SOLVED: (usize, usize) = (3, 12);

/// The candidates for a link, by their places in the list, the likeliest first: those that the prose names, then the
/// nearest, and only what hangs together with it.
pub fn nearby(book: &Book, index: usize, all: &[Candidate], named: &BTreeSet<usize>, target: &Spoken) -> Vec<usize> {
    let own = &book.entries[index].equation.span;
    let next = book.entries.iter().skip(index + 1).map(|e| e.equation.span.start).find(|start| *start >= own.end);
    let usable = |c: &Candidate| match &c.source {
        Origin::Display(k, _) | Origin::Part(k, _, _) => *k < index,
        Origin::Inline(_) => next.is_none_or(|next| c.span.start < next) && !own.contains(&c.span.start),
    };
    let is_named =
        |c: &Candidate| matches!(&c.source, Origin::Display(k, _) | Origin::Part(k, _, _) if named.contains(k));
    let mut found: Vec<usize> = (0..all.len()).filter(|k| usable(&all[*k])).collect();
    // What speaks of nothing else than the link at hand says most of it, wherever it stands.
    let is_foreign = |c: &Candidate| !c.symbols.is_subset(&target.symbols);
    let distance = |c: &Candidate| c.span.start.abs_diff(own.start);
    found.sort_by_key(|k| (!is_named(&all[*k]), is_foreign(&all[*k]), distance(&all[*k])));
    // What no chain of shared symbols leads to says nothing.
    let mut reached = target.symbols.clone();
    let mut kept = vec![false; found.len()];
    while let Some(k) = (0..found.len()).find(|k| !kept[*k] && !all[found[*k]].symbols.is_disjoint(&reached)) {
        kept[k] = true;
        reached.extend(all[found[k]].symbols.iter().cloned());
    }
    found.into_iter().zip(kept).filter(|(_, kept)| *kept).map(|(k, _)| k).collect()
}

/// The sets of candidates that may imply a link.
pub fn bases(nearby: &[usize], all: &[Candidate], target: &Spoken) -> Vec<Basis> {
    let nearest: Vec<usize> = nearby.iter().copied().take(NEAREST).collect();
    let candidates: Vec<&Candidate> = nearest.iter().map(|k| &all[*k]).collect();
    let small = subsets(target, &candidates, JUDGED).into_iter();
    let mut sets: Vec<Vec<usize>> = small.map(|set| set.into_iter().map(|k| nearest[k]).collect()).collect();
    for size in LADDER {
        let set: Vec<usize> = nearby.iter().copied().take(size).collect();
        let premises: Vec<&Candidate> = set.iter().map(|k| &all[*k]).collect();
        if set.len() > LARGEST && hang_together(target, &premises) && !sets.contains(&set) {
            sets.push(set);
        }
    }
    sets.iter().map(|set| Basis::of(set)).collect()
}

/// The equations that something which is said to equal a function of the time may solve, each alone and with what is said
/// of its constants.
pub fn solutions(nearby: &[usize], all: &[Candidate], unknown: &str, target: &Spoken) -> Vec<Basis> {
    let displays = nearby.iter().filter_map(|k| match &all[*k].source {
        Origin::Display(_, label) if all[*k].rates.contains(unknown) => Some((k, label)),
        _ => None,
    });
    let mut bases = Vec::new();
    for (k, label) in displays.take(SOLVED.0) {
        let mut both = target.clone();
        both.symbols.extend(all[*k].symbols.iter().cloned());
        both.moves = false;
        let still: Vec<usize> = nearby.iter().copied().filter(|j| j != k && !all[*j].moves).take(NEAREST).collect();
        let candidates: Vec<&Candidate> = still.iter().map(|j| &all[*j]).collect();
        let sets = subsets(&both, &candidates, SOLVED.1).into_iter().take(SOLVED.1);
        let sets = std::iter::once(Vec::new()).chain(sets.map(|set| set.into_iter().map(|j| still[j]).collect()));
        bases.extend(sets.map(|premises| Basis { premises, solves: Some(label.clone()) }));
    }
    bases
}
