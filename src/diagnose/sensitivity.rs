//! How sensitive a check is: the mutants of a formula that holds, tried by the same check.

use std::collections::HashMap;

use crate::check::verdict::{Judgement, LinkJudgement, Sensitivity, Verdict};
use crate::check::{Book, Options, Outcome, Trial, Version};
use crate::latex::ast::{Kind, Node};
use crate::latex::{self, to_latex};
use crate::semantics::{Scope, spelling};

use super::mutants::{Mutant, Reach, mutants};

/// A mutant with what became of it.
#[derive(Clone, Debug)]
pub struct Tried {
    /// The mutant.
    pub mutant: Mutant,
    /// What the check says of it.
    pub outcome: Outcome,
    /// Whether it says the same as the formula.
    pub equivalent: bool,
    /// Whether it is an inequality that says less than the formula.
    pub weaker: bool,
}

/// The version of an equation that holds, with its links: as printed, or else as corrected.
fn holding(judgement: &Judgement) -> Option<(Version, &[LinkJudgement])> {
    let holds = |v: Verdict| matches!(v, Verdict::Holds | Verdict::Asymptotic);
    if holds(judgement.verdict) {
        return Some((Version::Printed, &judgement.links));
    }
    let correction = judgement.correction.as_ref().filter(|c| holds(c.verdict))?;
    Some((Version::Corrected, &correction.links))
}

/// Tries every mutant of an equation that holds (of its correction, where it fails); `None` where nothing holds.
pub fn try_mutants(book: &Book, index: usize, judgement: &Judgement, options: &Options) -> Option<Vec<Tried>> {
    let (version, links) = holding(judgement)?;
    let entry = &book.entries[index];
    let tree = entry.formula(version).tree.as_ref().ok()?;
    let mut trial = Trial::new(book, index, version, links, options)?;
    let synonyms = Synonyms::new(book, index);
    let deadline = trial.deadline();
    let all = mutants(tree, &entry.scope, Reach::MUTANTS).into_iter().take_while(|_| !deadline.has_passed());
    let tried = all.map(|mutant| {
        let outcome = trial.judge(&mutant.tree);
        let equivalent = outcome == Outcome::Holds
            && (trial.is_equivalent(&mutant.tree) || synonyms.unify(tree) == synonyms.unify(&mutant.tree));
        let weaker = outcome == Outcome::Holds && !equivalent && trial.is_weaker(&mutant.tree);
        Tried { mutant, outcome, equivalent, weaker }
    });
    Some(tried.collect())
}

/// The sensitivity of an equation's check; `None` where the equation does not hold, nor its correction.
pub fn sensitivity(book: &Book, index: usize, judgement: &Judgement, options: &Options) -> Option<Sensitivity> {
    let mut result = Sensitivity::default();
    for tried in try_mutants(book, index, judgement, options)? {
        match tried.outcome {
            Outcome::Definition | Outcome::Unclear => continue,
            Outcome::Fails | Outcome::Misshapen => result.killed += 1,
            Outcome::Undecided => result.undecided += 1,
            Outcome::Holds if tried.equivalent => result.equivalent += 1,
            Outcome::Holds if tried.weaker => result.weaker += 1,
            Outcome::Holds => result.survivors.push(tried.mutant.edit.text),
        }
        result.total += 1;
    }
    Some(result)
}

/// Symbols that a premise of the prose states to be equal, as in `\mathbf{e}_\varphi = \mathbf{e}_z`: to print one for
/// the other says the same. Only premises in which every side is a symbol alone count.
struct Synonyms {
    /// The spelling of a symbol to that of the first of its class.
    first: HashMap<String, String>,
}

impl Synonyms {
    fn new(book: &Book, index: usize) -> Self {
        let entry = &book.entries[index];
        let mut synonyms = Synonyms { first: HashMap::new() };
        for premise in entry.wheres(None).into_iter().chain(&entry.scope.assume) {
            let Ok(Node { kind: Kind::Chain { first: Some(first), links }, .. }) = latex::parse(&premise.value) else {
                continue;
            };
            let sides: Vec<&Node> = std::iter::once(first.as_ref()).chain(links.iter().map(|l| &l.rhs)).collect();
            if sides.iter().all(|s| is_symbol(&entry.scope, s)) {
                let spellings: Vec<String> = sides.iter().map(|s| spelling(s)).collect();
                spellings.iter().skip(1).for_each(|s| synonyms.join(&spellings[0], s));
            }
        }
        synonyms
    }

    fn join(&mut self, a: &str, b: &str) {
        let (a, b) = (self.class(a), self.class(b));
        if a != b {
            self.first.values_mut().filter(|v| **v == b).for_each(|v| v.clone_from(&a));
            self.first.insert(b, a.clone());
            self.first.insert(a.clone(), a);
        }
    }

    fn class(&self, spelling: &str) -> String {
        self.first.get(spelling).cloned().unwrap_or_else(|| spelling.to_owned())
    }

    /// The LaTeX of a tree with every symbol replaced by the first of its class.
    fn unify(&self, tree: &Node) -> String {
        to_latex(&self.unified(tree))
    }

    fn unified(&self, node: &Node) -> Node {
        match self.first.get(&spelling(node)) {
            Some(first) => Node::new(Kind::Symbol(first.clone()), node.span.clone()),
            None => node.map_children(&mut |child| self.unified(child)),
        }
    }
}

fn is_symbol(scope: &Scope, node: &Node) -> bool {
    scope.get(&crate::semantics::pattern_of(scope, node)).is_some()
}
