//! What was probably meant: the formulas near a failing one that hold under the same check.
//!
//! The search knows the printed formula, the premises, and the symbols of the equations nearby; the annotated correction
//! it does not see, nor may any premise rest on it. First come single edits; where none mends the formula, those that
//! mend some of its links are continued, and then pairs of edits are tried, within a budget that counts formulas and not
//! time, so that the same notes give the same suggestions.

use std::collections::HashSet;

use crate::check::verdict::{Judgement, Suggestion, Verdict};
use crate::check::{Book, Options, Outcome, Trial, Version};
use crate::latex::ast::{Kind, Node};
use crate::latex::{self, to_latex};
use crate::semantics::{EntryKind, Scope};

use super::mutants::{EditKind, Mutant, Reach, mutants};
use super::names::Name;

/// How many suggestions are made.
const MOST: usize = 3;
/// How many formulas are tried in all.
const BUDGET: usize = 12_000;
/// How many edits that mend links one by one are made.
const DEPTH: usize = 4;
/// The cost up to which an edit is likely enough for pairs to be tried.
const LIKELY: u32 = 3;
/// How many factors may be put in.
const FACTORS: usize = 14;

/// A formula some edits away from the printed one, the last of which is kept whole.
#[derive(Clone)]
struct Candidate {
    tree: Node,
    edits: Vec<String>,
    cost: u32,
    failing: usize,
    last: Option<Mutant>,
}

/// The formulas near a failing one that hold, the likeliest first; none where the equation does not fail.
pub fn suggestions(book: &Book, index: usize, judgement: &Judgement, options: &Options) -> Vec<Suggestion> {
    if judgement.verdict != Verdict::Fails {
        return Vec::new();
    }
    let mut blind = book.clone();
    blind.entries[index].correction = None;
    let Some(mut trial) = Trial::new(&blind, index, Version::Printed, &judgement.links, options) else {
        return Vec::new();
    };
    let entry = &blind.entries[index];
    let Ok(tree) = &entry.formula(Version::Printed).tree else { return Vec::new() };
    let factors = factors(&blind, index, tree);
    let reach = Reach { siblings: None, factors: &factors };
    let mut search = Search { trial: &mut trial, scope: &entry.scope, reach, left: BUDGET, seen: HashSet::new() };
    let failing = judgement.links.iter().filter(|l| l.verdict > Verdict::Asymptotic).count().max(1);
    let start = Candidate { tree: tree.clone(), edits: Vec::new(), cost: 0, failing, last: None };
    let found = search.run(start);
    let suggestion = |c: Candidate| Suggestion { latex: to_latex(&c.tree), edit: c.edits.join("; ") };
    found.into_iter().take(MOST).map(suggestion).collect()
}

struct Search<'t, 'b> {
    trial: &'t mut Trial<'b>,
    scope: &'t Scope,
    reach: Reach<'t>,
    left: usize,
    seen: HashSet<String>,
}

impl Search<'_, '_> {
    fn run(&mut self, start: Candidate) -> Vec<Candidate> {
        let mut from = start;
        let mut singles = self.neighbours(&from);
        for _ in 0..DEPTH {
            let found = self.confirmed(&singles);
            if !found.is_empty() {
                return found;
            }
            // The likeliest of the edits that mend most links is kept.
            let better = singles.iter().filter(|c| c.failing < from.failing);
            let Some(best) = better.min_by_key(|c| (c.failing, c.cost)).cloned() else { break };
            singles = self.neighbours(&best);
            from = best;
        }
        let sums = self.sums(&from, &singles);
        if sums.is_empty() { self.pairs(&singles) } else { sums }
    }

    /// Pairs of edits in different terms: they change the residual R by the sum of their changes, so that
    /// R₁ + R₂ - R = 0. These are looked up, not tried, and only what is found is judged.
    fn sums(&mut self, from: &Candidate, singles: &[Candidate]) -> Vec<Candidate> {
        let Some(own) = self.trial.failing_residuals(&from.tree) else { return Vec::new() };
        let mut values: Vec<(Vec<f64>, &Candidate)> = Vec::new();
        for single in singles {
            if let Some(v) = self.trial.failing_residuals(&single.tree).filter(|v| v.len() == own.len()) {
                values.push((v, single));
            }
        }
        let size = own.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        let mut pairs = Vec::new();
        for (k, (v, a)) in values.iter().enumerate() {
            for (w, b) in &values[k + 1..] {
                let meets = |i: usize| (v[i] + w[i] - own[i]).abs() <= 1e-9 * (size + v[i].abs());
                if (0..own.len()).all(meets) {
                    pairs.extend(a.and(b));
                }
            }
        }
        self.confirmed(&pairs)
    }

    /// Pairs of likely edits, the likeliest and nearest to each other first.
    fn pairs(&mut self, singles: &[Candidate]) -> Vec<Candidate> {
        let likely: Vec<&Candidate> =
            singles.iter().filter(|c| c.last.as_ref().is_some_and(|m| cost(m.edit.kind) <= LIKELY)).collect();
        let place = |c: &Candidate| c.last.as_ref().map_or(0, |m| m.edit.span.start);
        let mut order: Vec<(u32, usize, usize, usize)> = Vec::new();
        for (i, a) in likely.iter().enumerate() {
            for (j, b) in likely.iter().enumerate().skip(i + 1) {
                order.push((a.cost + b.cost, place(a).abs_diff(place(b)), i, j));
            }
        }
        order.sort_unstable();
        let mut found = Vec::new();
        for (_, _, i, j) in order {
            if self.left == 0 || found.len() >= MOST {
                break;
            }
            let Some(mut pair) = likely[i].and(likely[j]) else { continue };
            self.left -= 1;
            if self.trial.failing_links(&pair.tree) == Some(0) {
                pair.failing = 0;
                found.extend(self.confirmed(&[pair]));
            }
        }
        found
    }

    /// All formulas one edit further that were not tried before, with the number of links that fail.
    fn neighbours(&mut self, from: &Candidate) -> Vec<Candidate> {
        let mut all = mutants(&from.tree, self.scope, self.reach);
        all.sort_by_key(|m| cost(m.edit.kind));
        let mut found = Vec::new();
        for mutant in all {
            if self.left == 0 {
                break;
            }
            if !self.seen.insert(to_latex(&mutant.tree)) {
                continue;
            }
            self.left -= 1;
            if let Some(failing) = self.trial.failing_links(&mutant.tree) {
                found.push(from.with(mutant, failing));
            }
        }
        found
    }

    /// Those that hold by the whole check.
    fn confirmed(&mut self, candidates: &[Candidate]) -> Vec<Candidate> {
        let mended = candidates.iter().filter(|c| c.failing == 0);
        let mut found: Vec<Candidate> =
            mended.filter(|c| self.trial.judge(&c.tree) == Outcome::Holds).cloned().collect();
        found.sort_by_key(|c| (c.cost, c.tree_size()));
        found
    }
}

impl Candidate {
    fn with(&self, mutant: Mutant, failing: usize) -> Candidate {
        let edits = self.edits.iter().cloned().chain([mutant.edit.text.clone()]).collect();
        let cost = self.cost + cost(mutant.edit.kind);
        Candidate { tree: mutant.tree.clone(), edits, cost, failing, last: Some(mutant) }
    }

    /// Both this one's last edit and that of another neighbour of the same formula; taken to mend everything.
    fn and(&self, other: &Candidate) -> Option<Candidate> {
        let (own, second) = (self.last.as_ref()?, other.last.as_ref()?);
        let tree = own.with(second)?;
        let edits = self.edits.iter().cloned().chain([second.edit.text.clone()]).collect();
        Some(Candidate { tree, edits, cost: self.cost + cost(second.edit.kind), failing: 0, last: None })
    }

    fn tree_size(&self) -> usize {
        to_latex(&self.tree).len()
    }
}

/// How unlikely an edit is: what a scan or a tired hand confuses is cheap, what changes the shape of a formula dear.
fn cost(kind: EditKind) -> u32 {
    match kind {
        EditKind::Index | EditKind::Dot | EditKind::Prime | EditKind::Symbol | EditKind::Power => 2,
        EditKind::Sign | EditKind::Function | EditKind::Number | EditKind::Bracket => 3,
        EditKind::DropFactor | EditKind::Insert => 4,
        EditKind::Double => 5,
        EditKind::DropTerm => 6,
        EditKind::Invert => 7,
    }
}

/// The factors that may have been left out: one half, the scalars of the formula and of its premises, and the sines and
/// cosines of its angles.
fn factors(book: &Book, index: usize, tree: &Node) -> Vec<Node> {
    let entry = &book.entries[index];
    let mut near: Vec<&Node> = vec![tree];
    let given = entry.given(None).into_iter().chain(entry.list(|a| &a.solves));
    let indices = given.filter_map(|g| book.find(&g.value)).map(|(k, _)| k).chain(entry.previous);
    near.extend(indices.filter_map(|k| book.entries[k].formula(Version::Corrected).tree.as_ref().ok()));
    let mut scalars: Vec<Node> = Vec::new();
    near.iter().for_each(|n| collect(&entry.scope, n, &mut scalars));
    let angles =
        scalars.iter().filter(|n| Name::of(&entry.scope, n).is_some_and(|n| n.entry.is_angle() && n.dots == 0));
    let turned = angles.flat_map(|n| ["\\sin", "\\cos"].map(|f| latex::parse(&format!("{f} {}", to_latex(n)))));
    let half = latex::parse("\\frac{1}{2}");
    let mut all: Vec<Node> = turned.chain([half]).filter_map(Result::ok).collect();
    all.extend(scalars);
    all.truncate(FACTORS);
    all
}

/// The scalars of a formula, without powers, each once.
fn collect(scope: &Scope, node: &Node, found: &mut Vec<Node>) {
    if let Some(name) = Name::of(scope, node) {
        let is_scalar = matches!(name.entry.kind, EntryKind::Scalar | EntryKind::Component { .. });
        let bare = name.without_power();
        if is_scalar && found.iter().all(|f| to_latex(f) != to_latex(&bare)) {
            found.push(bare);
        }
    } else if !matches!(node.kind, Kind::Text(_)) {
        node.children().into_iter().for_each(|child| collect(scope, child, found));
    }
}
