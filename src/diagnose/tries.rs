//! The search by trying each formula: for approximations, inequalities and solutions, whose sides have no values that
//! could be compared at a few states.

use crate::check::verdict::{LinkJudgement, Verdict};
use crate::check::{Outcome, Trial};
use crate::latex::ast::Node;
use crate::latex::{self, to_latex};
use crate::semantics::Scope;

use super::change::Change;
use super::likeness;
use super::names::Name;
use super::near::Near;

/// How many formulas are tried in all.
const BUDGET: usize = 600;
/// How many edits that mend links one by one are made.
const DEPTH: usize = 2;
/// The cost up to which an edit is likely enough for pairs to be tried.
const LIKELY: u32 = 3;
/// How many factors may be put in.
const FACTORS: usize = 18;
/// How many formulas that hold are enough.
const ENOUGH: usize = 6;

/// The changes of a formula that hold by the whole check, from its single edits; the likeliest first.
pub fn search(trial: &mut Trial, tree: &Node, singles: &[Change], links: &[LinkJudgement]) -> Vec<Change> {
    let mut left = BUDGET;
    let printed = links.iter().filter(|l| l.verdict > Verdict::Asymptotic).count().max(1);
    let mut from = (Change::default(), printed);
    let mut tried: Vec<(Change, usize)> = Vec::new();
    for _ in 0..DEPTH {
        tried.clear();
        for single in singles {
            let Some(change) = from.0.and(single).filter(|_| left > 0) else { continue };
            left -= 1;
            if let Some(failing) = trial.failing_links(&change.made(tree)) {
                tried.push((change, failing));
            }
        }
        let found = holding(trial, tree, &tried);
        if !found.is_empty() {
            return found;
        }
        // The likeliest of the edits that mend most links is kept.
        let better = tried.iter().filter(|(_, failing)| *failing < from.1);
        match better.min_by_key(|(c, failing)| (*failing, c.cost)).cloned() {
            Some(best) => from = best,
            None => break,
        }
    }
    pairs(trial, tree, &tried, left)
}

/// Pairs of likely edits, the likeliest first.
fn pairs(trial: &mut Trial, tree: &Node, singles: &[(Change, usize)], left: usize) -> Vec<Change> {
    let likely: Vec<&Change> = singles.iter().map(|(c, _)| c).filter(|c| c.cost <= LIKELY).collect();
    let mut order: Vec<(u32, usize, usize)> = Vec::new();
    for (i, a) in likely.iter().enumerate() {
        order.extend(likely.iter().enumerate().skip(i + 1).map(|(j, b)| (a.cost + b.cost, i, j)));
    }
    order.sort_unstable();
    let mut found = Vec::new();
    for (_, i, j) in order.into_iter().take(left) {
        let Some(mut pair) = likely[i].and(likely[j]) else { continue };
        pair.cost += likeness::FURTHER;
        if trial.failing_links(&pair.made(tree)) == Some(0) {
            found.extend(holding(trial, tree, &[(pair, 0)]));
        }
        if found.len() >= ENOUGH {
            break;
        }
    }
    found
}

/// Those that hold by the whole check.
fn holding(trial: &mut Trial, tree: &Node, tried: &[(Change, usize)]) -> Vec<Change> {
    let mended = tried.iter().filter(|(_, failing)| *failing == 0).map(|(c, _)| c);
    mended.filter(|c| trial.judge(&c.made(tree)) == Outcome::Holds).take(2 * ENOUGH).cloned().collect()
}

/// The factors that may have been left out: one half, the scalars of the formula and of those nearby, and the sines and
/// cosines of the first angles.
pub fn factors(near: &Near, scope: &Scope) -> Vec<Node> {
    let scalars: Vec<Node> = near.scalars(scope).cloned().collect();
    let is_angle = |n: &&Node| Name::of(scope, n).is_some_and(|n| n.entry.is_angle() && n.dots == 0);
    let angles = scalars.iter().filter(is_angle);
    let turned = angles.flat_map(|n| ["\\sin", "\\cos"].map(|f| latex::parse(&format!("{f} {}", to_latex(n)))));
    let half = latex::parse("\\frac{1}{2}");
    let turned: Vec<Node> = turned.filter_map(Result::ok).take(FACTORS / 3).collect();
    let rest = FACTORS - turned.len();
    half.into_iter().chain(scalars.iter().take(rest).cloned()).chain(turned).collect()
}
