//! The term of an e-graph that loses fewest bits, measured at given states.
//!
//! Each class of equal terms keeps the best term that has been found for it, with its values in doubles at the
//! states, rounded as they are computed, and with the exact values. A term is made from an operation of the class and
//! the best terms of the classes that it is applied to; it takes the place of the class's best where the mean of the
//! bits that its doubles have lost is less, or as many are lost by a smaller term. That the best terms of parts make
//! the best whole is not always so: rounding errors may cancel. So what is found is good, and not the best of all.

use std::collections::{HashMap, HashSet};

use egg::{EGraph, Id, Language, RecExpr};

use crate::number::{Df64, Number, Tracked};

use super::meter::{BITS, certain};
use super::rules::Constants;
use super::term::{Fraction, Leaf, Term, elliptic, function};

/// What one operation costs, in bits: of two terms that lose as much, the smaller one is better.
const OPERATION: f64 = 0.15;
/// By how many bits a term must be better than another one to take its place.
const BETTER: f64 = 1e-3;
/// How many times all classes are gone through.
const ROUNDS: usize = 12;

/// Values of the leaves at a state.
pub struct Leaves {
    /// As doubles, and as they are exactly.
    pub rough: Vec<f64>,
    /// What they are exactly.
    pub fine: Vec<Tracked<Df64>>,
}

/// A term with its values.
struct Made {
    node: Term,
    operands: Vec<usize>,
    size: usize,
    rough: Vec<f64>,
    fine: Vec<Tracked<Df64>>,
    cost: f64,
}

/// The search for the best terms.
pub struct Extractor<'g> {
    graph: &'g EGraph<Term, Constants>,
    states: &'g [Leaves],
    most: usize,
    made: Vec<Made>,
    best: HashMap<Id, usize>,
}

impl<'g> Extractor<'g> {
    /// For terms of at most so many operations.
    pub fn new(graph: &'g EGraph<Term, Constants>, states: &'g [Leaves], most: usize) -> Self {
        Extractor { graph, states, most, made: Vec::new(), best: HashMap::new() }
    }

    /// The best term of a class.
    pub fn best(mut self, root: Id) -> Option<RecExpr<Term>> {
        let mut seen: HashSet<(Id, Term, Vec<usize>)> = HashSet::new();
        for _ in 0..ROUNDS {
            let mut changed = false;
            for class in self.graph.classes() {
                for node in &class.nodes {
                    let best = |id: &Id| self.best.get(&self.graph.find(*id)).copied();
                    let Some(operands) = node.children().iter().map(best).collect::<Option<Vec<_>>>() else {
                        continue;
                    };
                    if seen.insert((class.id, node.clone(), operands.clone())) {
                        changed |= self.consider(class.id, node, operands);
                    }
                }
            }
            if !changed {
                break;
            }
        }
        let root = self.best.get(&self.graph.find(root)).copied()?;
        Some(self.term(root))
    }

    /// Takes a term for a class's best if it is.
    fn consider(&mut self, class: Id, node: &Term, operands: Vec<usize>) -> bool {
        let size = 1 + operands.iter().map(|k| self.made[*k].size).sum::<usize>();
        if size > self.most {
            return false;
        }
        let (mut rough, mut fine) = (Vec::new(), Vec::new());
        for (s, leaves) in self.states.iter().enumerate() {
            let quick: Vec<f64> = operands.iter().map(|k| self.made[*k].rough[s]).collect();
            let exact: Vec<_> = operands.iter().map(|k| self.made[*k].fine[s].clone()).collect();
            rough.push(value(node, &quick, &leaves.rough, &()));
            fine.push(value(node, &exact, &leaves.fine, &()));
        }
        let known = self.best.get(&class).copied();
        if let Some(known) = known {
            // Of what is equal, the value that is known best tells what the others lose.
            for (new, old) in fine.iter_mut().zip(&self.made[known].fine) {
                if !new.is_finite() || old.is_finite() && old.error_log2() < new.error_log2() {
                    *new = old.clone();
                }
            }
        }
        let lost = rough.iter().zip(&fine).map(|(r, f)| bits(*r, f));
        let cost = lost.sum::<f64>() / self.states.len().max(1) as f64 + OPERATION * size as f64;
        if known.is_some_and(|k| cost >= self.made[k].cost - BETTER) {
            return false;
        }
        self.best.insert(class, self.made.len());
        self.made.push(Made { node: node.clone(), operands, size, rough, fine, cost });
        true
    }

    fn term(&self, root: usize) -> RecExpr<Term> {
        let node = |id: Id| {
            let made = &self.made[usize::from(id)];
            let mut operands = made.operands.iter();
            made.node.clone().map_children(|old| operands.next().map_or(old, |k| Id::from(*k)))
        };
        let top = node(Id::from(root));
        top.build_recexpr(node)
    }
}

/// The bits that a double has lost; all, where nothing is certain.
fn bits(rough: f64, fine: &Tracked<Df64>) -> f64 {
    if rough == 0.0 && fine.is_zero_within() {
        return 0.0;
    }
    certain(&[rough], std::slice::from_ref(fine)).unwrap_or(BITS)
}

/// An operation's value.
fn value<N: Number>(node: &Term, x: &[N], leaves: &[N], cx: &N::Context) -> N {
    let mut out = N::zero(cx);
    match (node, x) {
        (Term::Constant(Fraction(n, d)), _) => out = N::from_ratio((*n).into(), (*d).into(), cx),
        (Term::Leaf(Leaf(k)), _) => {
            if let Some(leaf) = leaves.get(*k as usize) {
                out.set(leaf);
            }
        }
        (Term::Add(_), [a, b]) => out.set_add(a, b),
        (Term::Sub(_), [a, b]) => out.set_sub(a, b),
        (Term::Mul(_), [a, b]) => out.set_mul(a, b),
        (Term::Div(_), [a, b]) => out.set_div(a, b),
        (Term::Neg(_), [a]) => out.set_neg(a),
        (Term::Square(_), [a]) => out.set_powi(a, 2),
        (Term::Sqrt(_), [a]) => out.set_sqrt(a),
        (node, x) => match (function(node), elliptic(node), x) {
            (Some(f), _, [a]) => out.set_call(f, a),
            (_, Some(f), [u, k]) => out.set_elliptic(f, &[u, k]),
            _ => {}
        },
    }
    out
}
