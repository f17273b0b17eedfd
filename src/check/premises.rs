//! Premises turned into what a state must satisfy: symbols that are defined are replaced, the rest becomes residuals
//! that must vanish, together with their time derivatives where these say something of the symbols at hand.

use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};

use crate::expr::{Expr, Graph, Node, SymId};

/// The most residuals that are kept; beyond it no further time derivatives are taken.
const MOST_RESIDUALS: usize = 300;

/// Definitions and residuals.
#[derive(Clone, Debug, Default)]
pub struct Premises {
    /// A symbol (or derivative) and what it is: holds for its further derivatives, too.
    definitions: BTreeMap<SymId, Expr>,
    /// Definitions of derivatives that gave way to a definition of the symbol itself.
    demoted: Vec<(Expr, Expr)>,
    /// Expressions that vanish.
    pub residuals: Vec<Expr>,
}

impl Premises {
    /// Sorts pairs of equal scalars into definitions and residuals. Symbols in `kept` are never defined.
    pub fn new(graph: &mut Graph, pairs: &[(Expr, Expr)], kept: &BTreeSet<SymId>) -> Self {
        let mut premises = Premises::default();
        let mut rest = Vec::new();
        for &(a, b) in pairs {
            if graph.cut_short().is_some() {
                return premises;
            }
            if a == b {
                continue;
            }
            if !premises.define(graph, a, b, kept) && !premises.define(graph, b, a, kept) {
                rest.push((a, b));
            }
        }
        rest.append(&mut premises.demoted);
        for (a, b) in rest {
            let residual = graph.sub(a, b);
            let residual = premises.resolve(graph, residual);
            if !graph.is_zero(residual) {
                premises.residuals.push(residual);
            }
        }
        premises
    }

    /// Takes `a = b` as the definition of the symbol `a`, if it is one and that closes no circle. A constant is not
    /// defined by something that depends on time: that it does not change is information of its own.
    fn define(&mut self, graph: &mut Graph, a: Expr, b: Expr, kept: &BTreeSet<SymId>) -> bool {
        let Node::Symbol(s) = *graph.node(a) else { return false };
        if kept.contains(&s) || self.definition(graph, s).is_some() {
            return false;
        }
        let info = graph.info(s).clone();
        if !info.of_t && graph.symbols(&[b]).iter().any(|x| graph.info(*x).of_t) {
            return false;
        }
        let resolved = self.resolve(graph, b);
        let own = |x: &SymId| graph.info(*x).base == info.base && graph.info(*x).order >= info.order;
        if graph.symbols(&[resolved]).iter().any(own) {
            return false;
        }
        // A definition of a higher derivative becomes a condition on this one.
        let higher: Vec<SymId> =
            self.definitions.keys().copied().filter(|d| graph.info(*d).base == info.base).collect();
        for d in higher {
            if let Some(value) = self.definitions.remove(&d) {
                let symbol = graph.sym(d);
                self.demoted.push((symbol, value));
            }
        }
        self.definitions.insert(s, resolved);
        // What was resolved before may mention the symbol.
        let earlier: Vec<(SymId, Expr)> = self.definitions.iter().map(|(k, v)| (*k, *v)).collect();
        for (symbol, value) in earlier {
            let value = self.resolve(graph, value);
            self.definitions.insert(symbol, value);
        }
        true
    }

    /// The definition that covers a symbol: its own, or that of a lower derivative, with the number of derivatives
    /// still to be taken.
    fn definition(&self, graph: &Graph, s: SymId) -> Option<(Expr, u32)> {
        let info = graph.info(s);
        self.definitions.iter().find_map(|(defined, value)| {
            let d = graph.info(*defined);
            (d.base == info.base && d.order <= info.order).then(|| (*value, info.order - d.order))
        })
    }

    /// An expression with every defined symbol replaced.
    pub fn resolve(&self, graph: &mut Graph, e: Expr) -> Expr {
        let mut e = e;
        // Each pass replaces at least one level of definitions; circles are excluded.
        for _ in 0..64 {
            let mut map = HashMap::new();
            for s in graph.symbols(&[e]) {
                if let Some((mut value, times)) = self.definition(graph, s) {
                    let t = graph.find("t");
                    for _ in 0..times {
                        value = graph.time_derivative(value, t);
                    }
                    map.insert(s, value);
                }
            }
            if map.is_empty() {
                break;
            }
            e = graph.substitute(e, &map);
        }
        e
    }

    /// Adds the time derivatives of the residuals, as long as they are of no higher order than what occurs in `targets`
    /// or in the premises themselves, and say something of the symbols that occur there.
    pub fn close_in_time(&mut self, graph: &mut Graph, targets: &[Expr]) {
        let all: Vec<Expr> = targets.iter().chain(&self.residuals).copied().collect();
        let order =
            |graph: &Graph, es: &[Expr]| graph.symbols(es).iter().map(|s| graph.info(*s).order).max().unwrap_or(0);
        let highest = order(graph, &all);
        let known = graph.symbols(&all);
        let t = graph.find("t");
        let mut seen: HashSet<Expr> = self.residuals.iter().copied().collect();
        // Where first derivatives are defined by premises a derivative has no higher order than the residual, and would have
        // one again, for ever.
        // Where nothing moves, t is a number like others, and the equation speaks of one moment.
        let moves = |graph: &Graph, e: Expr| graph.symbols(&[e]).iter().any(|s| Some(*s) != t && graph.info(*s).of_t);
        let moving = self.residuals.iter().filter(|r| moves(graph, **r));
        let mut queue: Vec<(Expr, u32)> = moving.map(|r| (*r, 0)).collect();
        let mut derivatives = Vec::new();
        while let Some((residual, times)) = queue.pop() {
            if times >= highest.max(1) {
                continue;
            }
            if derivatives.len() > MOST_RESIDUALS || graph.cut_short().is_some() {
                break;
            }
            let derivative = graph.time_derivative(residual, t);
            let derivative = self.resolve(graph, derivative);
            let says_something = !graph.symbols(&[derivative]).is_empty();
            if says_something && order(graph, &[derivative]) <= highest && seen.insert(derivative) {
                derivatives.push(derivative);
                queue.push((derivative, times + 1));
            }
        }
        let unknown: Vec<Vec<SymId>> =
            derivatives.iter().map(|d| graph.symbols(&[*d]).difference(&known).copied().collect()).collect();
        let kept = overdetermined(&unknown);
        self.residuals.extend(derivatives.into_iter().zip(kept).filter(|(_, k)| *k).map(|(d, _)| d));
    }

    /// Keeps only the residuals that have to do with `targets` or the symbols `mentioned`: those that share symbols with
    /// them, directly or by other residuals.
    pub fn keep_related(&mut self, graph: &Graph, targets: &[Expr], mentioned: BTreeSet<SymId>) {
        let mut reached = mentioned;
        reached.extend(graph.symbols(targets));
        let symbols: Vec<BTreeSet<SymId>> = self.residuals.iter().map(|r| graph.symbols(&[*r])).collect();
        let mut kept = vec![false; self.residuals.len()];
        loop {
            let mut grown = false;
            for (k, own) in symbols.iter().enumerate() {
                if !kept[k] && (own.is_empty() || own.iter().any(|s| reached.contains(s))) {
                    kept[k] = true;
                    grown = true;
                    reached.extend(own);
                }
            }
            if !grown || graph.deadline().has_passed() {
                break;
            }
        }
        let mut keep = kept.into_iter();
        self.residuals.retain(|_| keep.next().unwrap_or(true));
    }
}

/// Which equations are not there merely to determine symbols of their own: those that no matching of equations with
/// symbols can serve all, by alternating paths from the unmatched ones (the overdetermined part of Dulmage and
/// Mendelsohn's decomposition). `symbols` holds the symbols of each equation.
fn overdetermined(symbols: &[Vec<SymId>]) -> Vec<bool> {
    let mut server: HashMap<SymId, usize> = HashMap::new();
    let unmatched: Vec<usize> =
        (0..symbols.len()).filter(|k| !serve(*k, symbols, &mut server, &mut HashSet::new())).collect();
    let mut kept = vec![false; symbols.len()];
    let mut queue = unmatched;
    while let Some(k) = queue.pop() {
        if !std::mem::replace(&mut kept[k], true) {
            queue.extend(symbols[k].iter().filter_map(|s| server.get(s)));
        }
    }
    kept
}

/// Finds a symbol for an equation, if need be by making others change theirs (Kuhn's algorithm). The depth of the
/// recursion is at most the number of equations, some hundreds.
fn serve(k: usize, symbols: &[Vec<SymId>], server: &mut HashMap<SymId, usize>, tried: &mut HashSet<SymId>) -> bool {
    for s in &symbols[k] {
        if tried.insert(*s) {
            let free = match server.get(s) {
                None => true,
                Some(&other) => serve(other, symbols, server, tried),
            };
            if free {
                server.insert(*s, k);
                return true;
            }
        }
    }
    false
}
