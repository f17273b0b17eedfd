//! The search on a row of sides a = b = c that should be equal and are not: each side is edited by itself and evaluated
//! at solved states, and formulas are found as values that every side can be given.
//!
//! Two edits of one side in different terms change it by the sum of their changes, so pairs of edits are looked up and
//! not tried; what a factor or term that is missing must be is solved for and looked up in a [`Lexicon`]. What is found
//! is only a guess: the sides agree at a handful of states.

use std::collections::HashSet;

use crate::check::{STATES, Screen, Sight};
use crate::latex::ast::{Kind, Node, Sign, Term};
use crate::latex::to_latex;
use crate::semantics::{Clause, Side};

use super::change::{Change, Path, at, find, flat};
use super::lexicon::{Lexicon, slots};
use super::likeness;
use super::mutants::replaced_at;
use super::shape::{group, plus};

/// How near two values must be, relative to the largest of the sides.
const NEAR: f64 = 1e-9;
/// How many variants of a side are continued by filling holes in them.
const CONTINUED: usize = 80;
/// How many pairs of edits in one product are tried.
const PAIRS: usize = 1500;
/// How many of the edits that make sense of a side are continued.
const MAKING_SENSE: usize = 4;
/// The most pairs of edits that are looked at for each side.
const MOST_PAIRS: usize = 200_000;
/// How many of the variants of one value are kept for each side, where several sides are edited.
const KEPT: usize = 4;
/// How many are kept where one side is edited.
const MANY: usize = 64;

/// A side as printed.
struct Printed {
    /// Where it stands in the formula; `None` where it belongs to the equation before.
    path: Option<Path>,
    node: Node,
    /// The clause it is evaluated with, and whether it is its left side.
    clause: usize,
    left: bool,
    /// `None` where it makes no sense as it stands.
    values: Option<Vec<f64>>,
}

/// A side with edits.
struct Variant {
    side: usize,
    change: Change,
    node: Node,
    values: Vec<f64>,
    /// A random projection of the values, by which equal ones are found.
    key: f64,
}

/// A row of sides.
pub struct Row<'s, 'b> {
    screen: &'s mut Screen<'b>,
    clauses: Vec<Clause>,
    sides: Vec<Printed>,
    variants: Vec<Variant>,
    /// The size of the sides' terms.
    scale: f64,
    /// How many values each side has.
    length: usize,
    seen: HashSet<(usize, String)>,
    /// Changes whose sides the states do not cover.
    pub elsewhere: Vec<Change>,
}

impl<'s, 'b> Row<'s, 'b> {
    /// Evaluates the sides of linked clauses as they stand in a formula; `None` where that is not possible.
    pub fn new(screen: &'s mut Screen<'b>, clauses: &[Clause], tree: &Node) -> Option<Self> {
        let mut row = Row {
            screen,
            clauses: clauses.to_vec(),
            sides: Vec::new(),
            variants: Vec::new(),
            scale: 0.0,
            length: 0,
            seen: HashSet::new(),
            elsewhere: Vec::new(),
        };
        let first = clauses.first()?;
        let mut nodes = vec![(first.lhs.clone(), 0, true)];
        nodes.extend(clauses.iter().enumerate().filter_map(|(k, c)| match &c.rhs {
            Side::Node(n) => Some((n.clone(), k, false)),
            Side::Constant => None,
        }));
        let mut from = Vec::new();
        for (node, clause, left) in nodes {
            let path = (!(left && first.continued)).then(|| find(tree, &node, &mut from)).flatten();
            let values = match row.evaluate(clause, left, &node) {
                Sight::Values(values) if values.iter().all(|x| x.is_finite()) => Some(values),
                Sight::Values(_) | Sight::Senseless => None,
                Sight::Elsewhere => return None,
            };
            row.sides.push(Printed { path, node, clause, left, values });
        }
        let known = row.sides.iter().filter_map(|s| s.values.as_ref());
        let lengths: HashSet<usize> = known.map(Vec::len).collect();
        if lengths.len() != 1 {
            return None;
        }
        row.length = lengths.into_iter().next()?;
        if first.rhs == Side::Constant {
            // What is constant has the derivative 0.
            let values = Some(vec![0.0; row.length]);
            row.sides.push(Printed { path: None, node: first.lhs.clone(), clause: 0, left: true, values });
        }
        for k in 0..row.sides.len() {
            if let Some(values) = row.sides[k].values.clone() {
                row.measure(k, &row.sides[k].node.clone());
                row.add(k, Change::default(), row.sides[k].node.clone(), values);
            }
        }
        Some(row)
    }

    fn evaluate(&mut self, clause: usize, left: bool, node: &Node) -> Sight {
        let clause = &self.clauses[clause];
        match (&clause.rhs, left) {
            (rhs, true) => self.screen.side(node, rhs, true),
            (_, false) => self.screen.side(&clause.lhs, &Side::Node(node.clone()), false),
        }
    }

    /// Takes the size of a side's terms into account.
    fn measure(&mut self, side: usize, node: &Node) {
        let Printed { clause, left, .. } = self.sides[side];
        let clause = &self.clauses[clause];
        let size = match left {
            true => self.screen.size(node, &clause.rhs, true),
            false => self.screen.size(&clause.lhs, &Side::Node(node.clone()), false),
        };
        self.scale = self.scale.max(size.unwrap_or(0.0));
    }

    fn add(&mut self, side: usize, change: Change, node: Node, values: Vec<f64>) {
        if self.scale == 0.0 {
            // Where 0 is all that is printed, the first formula that is not shows the size.
            self.measure(side, &node);
        }
        let key = key(&values);
        if key.is_finite() {
            self.variants.push(Variant { side, change, node, values, key });
        }
    }

    /// Evaluates a variant of a side and keeps it, if it is new.
    fn try_variant(&mut self, side: usize, change: Change, node: Node) {
        let node = flat(node);
        if !self.seen.insert((side, to_latex(&node))) {
            return;
        }
        let (clause, left) = (self.sides[side].clause, self.sides[side].left);
        match self.evaluate(clause, left, &node) {
            Sight::Values(values) if values.len() == self.length => {
                self.add(side, change, node, values);
            }
            Sight::Elsewhere => self.elsewhere.push(change),
            _ => {}
        }
    }

    /// Enters changes of the formula that lie within one side.
    pub fn enter(&mut self, changes: &[Change]) {
        let deadline = self.screen.deadline();
        for change in changes.iter().take_while(|_| !deadline.has_passed()) {
            let Some(side) = self.side_of(change) else { continue };
            let Some(prefix) = self.sides[side].path.clone() else { continue };
            let places = change.places.iter();
            let node =
                places.fold(self.sides[side].node.clone(), |n, (p, new)| replaced_at(&n, &p[prefix.len()..], new));
            self.try_variant(side, change.clone(), node);
        }
    }

    /// Where a side makes no sense as printed: enters second edits on top of the likeliest that make sense of it.
    pub fn enter_on_sense(&mut self, changes: &[Change]) {
        for side in (0..self.sides.len()).filter(|k| self.sides[*k].values.is_none()).collect::<Vec<_>>() {
            let sensible = self.variants.iter().filter(|v| v.side == side);
            let mut sensible: Vec<Change> = sensible.map(|v| v.change.clone()).collect();
            sensible.sort_by_key(|c| c.cost);
            for first in sensible.into_iter().take(MAKING_SENSE) {
                let both = changes.iter().filter_map(|second| joint(&first, second));
                self.enter(&both.collect::<Vec<_>>());
            }
        }
    }

    /// The one side that a change lies in.
    fn side_of(&self, change: &Change) -> Option<usize> {
        let within = |s: &Printed, p: &Path| s.path.as_ref().is_some_and(|prefix| p.starts_with(prefix));
        (0..self.sides.len()).find(|k| change.places.iter().all(|(p, _)| within(&self.sides[*k], p)))
    }

    /// The values that the printed sides have, each once.
    fn targets(&self) -> Vec<Vec<f64>> {
        let mut targets: Vec<Vec<f64>> = Vec::new();
        for values in self.sides.iter().filter_map(|s| s.values.as_ref()) {
            if targets.iter().all(|t| !self.equal(t, values)) {
                targets.push(values.clone());
            }
        }
        targets
    }

    fn equal(&self, a: &[f64], b: &[f64]) -> bool {
        let near = |(x, y): (&f64, &f64)| (x - y).abs() <= NEAR * (self.scale + x.abs());
        a.len() == b.len() && a.iter().zip(b).all(near)
    }

    /// Fills holes in the printed sides: what factor or term is missing.
    pub fn fill(&mut self, lexicon: &Lexicon) {
        for k in 0..self.sides.len() {
            if let Some(values) = self.sides[k].values.clone() {
                self.fill_side(lexicon, k, &Change::default(), &self.sides[k].node.clone(), &values);
            }
        }
    }

    /// Fills holes in sides that have one likely edit already.
    pub fn fill_edited(&mut self, lexicon: &Lexicon) {
        let mut order: Vec<usize> = (0..self.variants.len()).filter(|k| !self.variants[*k].change.is_none()).collect();
        order.retain(|k| self.variants[*k].change.cost < likeness::INSERTED);
        order.sort_by_key(|k| self.variants[*k].change.cost);
        for k in order.into_iter().take(CONTINUED) {
            let v = &self.variants[k];
            let (side, change, node, values) = (v.side, v.change.clone(), v.node.clone(), v.values.clone());
            self.fill_side(lexicon, side, &change, &node, &values);
        }
    }

    fn fill_side(&mut self, lexicon: &Lexicon, side: usize, change: &Change, node: &Node, values: &[f64]) {
        let Some(place) = self.sides[side].path.clone() else { return };
        let targets: Vec<Vec<f64>> = self.targets().into_iter().filter(|t| !self.equal(t, values)).collect();
        let deadline = self.screen.deadline();
        for slot in slots(node).into_iter().take_while(|_| !deadline.has_passed()) {
            let Some(old) = at(node, &slot.path).cloned() else { continue };
            let mut found: Vec<(Node, String, u32)> = Vec::new();
            for wanted in self.solved(side, node, &slot.path, values, &targets, &doubled(&old)) {
                // Twice the node is the node and once the unit, which is the node itself.
                let factor = wanted.map(|x| 1.0 + x);
                for filling in lexicon.fillings(&factor).into_iter().take(KEPT).filter(|f| !f.is_one()) {
                    let new = signed(filling.negative, filling.applied(&old));
                    let sign = if filling.negative { "-" } else { "" };
                    let text =
                        format!("the factor `{sign}{}` put before `{}`", to_latex(&filling.node()), to_latex(&old));
                    let subject = if slot.path.is_empty() && is_name(&old) { likeness::SUBJECT } else { 0 };
                    found.push((new, text, filling.factor_cost() + subject));
                }
            }
            let one = Node::new(Kind::Number("1".into()), old.span.clone());
            let mut terms: Vec<(bool, Node, u32)> = Vec::new();
            if slot.sum {
                for wanted in self.solved(side, node, &slot.path, values, &targets, &plus(&old, false, &one)) {
                    let fillings = lexicon.fillings(&wanted).into_iter().take(KEPT);
                    terms.extend(fillings.map(|f| (f.negative, f.node(), f.term_cost())));
                }
            }
            if slot.path.is_empty() && values.len() > STATES {
                for target in &targets {
                    let wanted: Vec<f64> = target.iter().zip(values).map(|(t, v)| t - v).collect();
                    let arrows = lexicon.arrows(&wanted).into_iter().take(KEPT);
                    terms.extend(arrows.map(|(f, v)| (f.negative, f.applied(&v), f.term_cost())));
                }
            }
            for (negative, term, cost) in terms {
                let sign = if negative { "-" } else { "+" };
                let text = format!("the term `{sign} {}` added to `{}`", to_latex(&term), to_latex(&old));
                found.push((plus(&old, negative, &term), text, cost));
            }
            for (new, text, cost) in found {
                let whole = replaced_at(node, &slot.path, &new);
                let mut change = change.clone();
                change.places = vec![(place.clone(), whole.clone())];
                change.cost += cost + if change.edits.is_empty() { 0 } else { likeness::FURTHER };
                change.edits.push(text);
                self.try_variant(side, change, whole);
            }
        }
    }

    /// How often a unit must be put into a slot for the side to have one of the targets' values, at each state; where
    /// the side depends on it linearly, that is right. `trial` is what stands in the slot with the unit put in once.
    fn solved(
        &mut self,
        side: usize,
        node: &Node,
        slot: &Path,
        values: &[f64],
        targets: &[Vec<f64>],
        trial: &Node,
    ) -> Vec<[f64; STATES]> {
        let (clause, left) = (self.sides[side].clause, self.sides[side].left);
        let Sight::Values(moved) = self.evaluate(clause, left, &replaced_at(node, slot, trial)) else {
            return Vec::new();
        };
        if moved.len() != values.len() {
            return Vec::new();
        }
        let size = NEAR * self.scale;
        let solve = |target: &Vec<f64>| {
            let mut wanted = [f64::NAN; STATES];
            for (k, x) in wanted.iter_mut().enumerate() {
                // All components must want the same; the one that moves most decides.
                let component = (k..values.len()).step_by(STATES);
                let best = component
                    .clone()
                    .max_by(|a, b| (moved[*a] - values[*a]).abs().total_cmp(&(moved[*b] - values[*b]).abs()))?;
                *x = (target[best] - values[best]) / (moved[best] - values[best]);
                let agrees = |c: usize| {
                    let change = *x * (moved[c] - values[c]);
                    (values[c] + change - target[c]).abs() <= 100.0 * (size + NEAR * change.abs())
                };
                if !x.is_finite() || !component.clone().all(agrees) {
                    return None;
                }
            }
            Some(wanted)
        };
        targets.iter().filter_map(solve).collect()
    }

    /// Adds the pairs of edits of one side that give it the value of a printed side: those in different terms by the sum
    /// of their changes, those in one product by trying them.
    pub fn pair(&mut self) {
        let targets = self.targets();
        for side in 0..self.sides.len() {
            let (Some(prefix), Some(values)) = (self.sides[side].path.clone(), self.sides[side].values.clone()) else {
                continue;
            };
            let mut order: Vec<usize> = (0..self.variants.len()).filter(|k| self.variants[*k].side == side).collect();
            order.retain(|k| {
                self.variants[*k].change.places.iter().all(|(p, _)| *p != prefix) && !self.variants[*k].change.is_none()
            });
            order.sort_by(|a, b| self.variants[*a].key.total_cmp(&self.variants[*b].key));
            let own = key(&values);
            let mut pairs: Vec<(usize, usize)> = Vec::new();
            for target in targets.iter().filter(|t| !self.equal(t, &values)) {
                let wanted = key(target);
                for (n, a) in order.iter().enumerate() {
                    let rest = wanted + own - self.variants[*a].key;
                    let tolerance = 10.0 * NEAR * (self.scale + rest.abs());
                    let from = order.partition_point(|b| self.variants[*b].key < rest - tolerance).max(n + 1);
                    let hits = order[from.min(order.len())..]
                        .iter()
                        .take_while(|b| self.variants[**b].key <= rest + tolerance);
                    // Where very many edits change a side alike, they say little.
                    let room = MOST_PAIRS.saturating_sub(pairs.len());
                    pairs.extend(hits.map(|b| (*a, *b)).take(room));
                }
            }
            pairs.extend(self.close_pairs(side, &order));
            let deadline = self.screen.deadline();
            for (a, b) in pairs.into_iter().take_while(|_| !deadline.has_passed()) {
                let Some(mut both) = self.variants[a].change.and(&self.variants[b].change) else { continue };
                both.cost += likeness::FURTHER;
                let places = both.places.iter();
                let node =
                    places.fold(self.sides[side].node.clone(), |n, (p, new)| replaced_at(&n, &p[prefix.len()..], new));
                self.try_variant(side, both, node);
            }
        }
    }

    /// The likeliest pairs of edits in one term.
    fn close_pairs(&self, side: usize, order: &[usize]) -> Vec<(usize, usize)> {
        let root = &self.sides[side];
        let Some(prefix) = &root.path else { return Vec::new() };
        let mut pairs: Vec<(u32, usize, usize)> = Vec::new();
        let deadline = self.screen.deadline();
        for (n, a) in order.iter().enumerate().take_while(|_| !deadline.has_passed()) {
            for b in &order[n + 1..] {
                let (x, y) = (&self.variants[*a].change, &self.variants[*b].change);
                let Some(((p, _), (q, _))) = x.places.first().zip(y.places.first()) else { continue };
                let shared = p.iter().zip(q).take_while(|(i, j)| i == j).count();
                let joint = p.get(prefix.len()..shared).and_then(|p| at(&root.node, p));
                if shared >= p.len().min(q.len()) || joint.is_none_or(|j| matches!(j.kind, Kind::Sum(_))) {
                    continue;
                }
                pairs.push((x.cost + y.cost, *a, *b));
            }
        }
        pairs.sort_unstable();
        pairs.into_iter().take(PAIRS).map(|(_, a, b)| (a, b)).collect()
    }

    /// The changes that give all sides one value, the likeliest first.
    pub fn matches(&self) -> Vec<Change> {
        let mut order: Vec<usize> = (0..self.variants.len()).collect();
        order.sort_by(|a, b| self.variants[*a].key.total_cmp(&self.variants[*b].key));
        let mut found: Vec<Change> = Vec::new();
        let mut from = 0;
        while from < order.len() {
            let start = self.variants[order[from]].key;
            let tolerance = 10.0 * NEAR * (self.scale + start.abs());
            let length = order[from..].iter().take_while(|k| self.variants[**k].key <= start + tolerance).count();
            found.extend(self.joined(&order[from..from + length]));
            from += length;
        }
        found.retain(|c| !c.is_none());
        found.sort_by_key(|c| c.cost);
        found
    }

    /// The changes of formulas whose sides are among variants of nearly one key.
    fn joined(&self, variants: &[usize]) -> Vec<Change> {
        let mut found = Vec::new();
        let mut left = variants.to_vec();
        while let Some(first) = left.first().copied() {
            let equal = |k: &usize| self.equal(&self.variants[*k].values, &self.variants[first].values);
            let (class, rest): (Vec<usize>, Vec<usize>) = left.into_iter().partition(|k| *k == first || equal(k));
            left = rest;
            found.extend(self.of_one_value(&class));
        }
        found
    }

    /// The changes of formulas whose sides are among variants with one value.
    fn of_one_value(&self, class: &[usize]) -> Vec<Change> {
        let mut joined = vec![Change::default()];
        for side in 0..self.sides.len() {
            let own = class.iter().map(|k| &self.variants[*k]).filter(|v| v.side == side);
            let mut own: Vec<&Change> = own.map(|v| &v.change).collect();
            own.sort_by_key(|c| c.cost);
            // A side that needs no edit is not edited.
            let most = match own.first() {
                Some(cheapest) if cheapest.is_none() => 1,
                _ if joined.len() == 1 => MANY,
                _ => KEPT,
            };
            own.truncate(most);
            joined = joined.iter().flat_map(|a| own.iter().filter_map(|b| joint(a, b))).collect();
        }
        joined
    }
}

/// Both changes, as edits of different sides.
fn joint(a: &Change, b: &Change) -> Option<Change> {
    let mut both = a.and(b)?;
    if !a.is_none() && !b.is_none() {
        both.cost += likeness::FURTHER;
    }
    Some(both)
}

/// A fixed random projection.
fn key(values: &[f64]) -> f64 {
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    let mut sum = 0.0;
    for x in values {
        state = state.wrapping_mul(0x5851_f42d_4c95_7f2d).wrapping_add(0x1405_7b7e_f767_814f);
        sum += x * ((state >> 11) as f64 / (1u64 << 52) as f64 - 1.0);
    }
    sum
}

fn is_name(node: &Node) -> bool {
    matches!(node.kind, Kind::Symbol(_) | Kind::Styled(..) | Kind::Accent(..) | Kind::Dots(..) | Kind::Scripts { .. })
}

fn doubled(node: &Node) -> Node {
    let two = Node::new(Kind::Number("2".into()), node.span.clone());
    super::shape::times(&two, node)
}

fn signed(negative: bool, node: Node) -> Node {
    if !negative {
        return node;
    }
    let span = node.span.clone();
    let term = Term { sign: Sign::Minus, sign_span: Some(span.clone()), node };
    group(Node::new(Kind::Sum(vec![term]), span.clone()), &span)
}
