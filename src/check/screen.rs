//! Sides of an equation evaluated in doubles at states at which the premises hold: what a search looks at before it
//! judges.
//!
//! The premises are solved once. A graph holds everything that was ever evaluated, so another formula costs only what is
//! new in it. What agrees here is no more than a guess; what is claimed of it is claimed by [`Trial`](super::Trial).

use std::collections::{BTreeMap, BTreeSet};

use crate::expr::{Deadline, Expr, Node as Op, SymId};
use crate::latex::ast::{Node, Rel};
use crate::number::{Df64, Number};
use crate::semantics::{self, Clause, Side};

use super::book::{Book, Version};
use super::claim::{Claim, Related, Source};
use super::options::Options;
use super::random::{Random, draw};
use super::sampling::Sampler;
use super::system::source;

/// The number of states.
pub const STATES: usize = 8;

/// An expression's value at each state.
type Row = [f64; STATES];

/// A row of clauses of an equation that share sides, ready for other formulas in their place.
pub struct Screen<'b> {
    source: Source<'b>,
    claim: Claim,
    states: Vec<Vec<f64>>,
    known: BTreeSet<SymId>,
    /// By the number of the expression.
    rows: Vec<Option<Row>>,
    seed: u64,
}

/// What a side comes to.
#[derive(Clone, Debug, PartialEq)]
pub enum Sight {
    /// Its values: for each instance and component, at each state.
    Values(Vec<f64>),
    /// It speaks of symbols that the states do not cover.
    Elsewhere,
    /// It makes no sense, or its shape does not meet that of the other side.
    Senseless,
}

impl<'b> Screen<'b> {
    /// Solves the premises of clauses at some states. `None` where these are no plain equalities or there are no states.
    pub fn new(
        book: &'b Book,
        index: usize,
        version: Version,
        clauses: &[Clause],
        known: &[Clause],
        options: &Options,
    ) -> Option<Self> {
        let plain = |c: &Clause| matches!(c.rel, Rel::Eq | Rel::Equiv | Rel::Implies) && !branches(c);
        if clauses.is_empty() || !clauses.iter().all(plain) || !book.entries[index].list(|a| &a.solves).is_empty() {
            return None;
        }
        // With all premises the states cover more symbols; that they can be solved together is not always so. A side that
        // makes no sense or is no number leaves the other one.
        let attempts = [Kept::Clauses, Kept::Right, Kept::Left].into_iter().flat_map(|kept| {
            let clauses: Vec<Clause> = clauses.iter().filter_map(|c| kept.of(c)).collect();
            [(clauses.clone(), Related::All), (clauses, Related::Only)]
        });
        let attempt = |(clauses, related): (Vec<Clause>, Related)| {
            Screen::with_premises((book, index, version), &clauses, known, options, related)
        };
        attempts.filter(|(clauses, _)| !clauses.is_empty()).find_map(attempt)
    }

    fn with_premises(
        (book, index, version): (&'b Book, usize, Version),
        clauses: &[Clause],
        known: &[Clause],
        options: &Options,
        related: Related,
    ) -> Option<Self> {
        let source = Source::new(book, index, version).until(Deadline::after(options.budget));
        let entry = &book.entries[index];
        let claim = source.claim_of(clauses, &entry.scope, known, related).ok();
        let mut claim = claim.filter(|c| c.small.is_none() && !c.partial && c.condition.is_none())?;
        let mut random = Random::new(options.seed, &format!("{}/screen", entry.equation.label));
        let sampler = Sampler::new(&mut claim, &mut random, &[]).ok()?;
        let states = sampler.states(STATES, &mut random, &BTreeMap::new()).ok()?;
        let refined = states.iter().filter_map(|s| sampler.system.refine::<Df64>(s, &()));
        let states: Vec<Vec<f64>> = refined.map(|s| s.iter().map(Number::to_f64).collect()).collect();
        let known = sampler.system.free.iter().chain(&sampler.system.unknowns).map(|s| s.symbol).collect();
        let screen = Screen { source, claim, states, known, rows: Vec::new(), seed: options.seed };
        (screen.states.len() == STATES).then_some(screen)
    }

    /// When the time for looking at sides is used up.
    pub fn deadline(&self) -> Deadline {
        self.source.deadline
    }

    /// The values of a side of a link, the left one or the right one. The other side decides its shape, where it is 0.
    pub fn side(&mut self, left: &Node, right: &Side, of_left: bool) -> Sight {
        let Some(expressions) = self.expressions(left, right, of_left) else { return Sight::Senseless };
        let mut values = Vec::new();
        for e in expressions {
            match self.row(e) {
                Some(row) => values.extend(row),
                None => return Sight::Elsewhere,
            }
        }
        Sight::Values(values)
    }

    /// The largest sum of the magnitudes of a side's terms.
    pub fn size(&mut self, left: &Node, right: &Side, of_left: bool) -> Option<f64> {
        let mut size = 0.0_f64;
        for e in self.expressions(left, right, of_left)? {
            let magnitude = self.claim.world.graph.magnitude(e);
            let row = self.row(magnitude)?;
            size = row.iter().fold(size, |m, x| m.max(x.abs()));
        }
        Some(size).filter(|s| s.is_finite())
    }

    /// A side's scalars: instance by instance, component by component.
    fn expressions(&mut self, left: &Node, right: &Side, of_left: bool) -> Option<Vec<Expr>> {
        let rhs = right.clone();
        let clause = Clause { lhs: left.clone(), rel: Rel::Eq, rhs, part: 1, continued: false, when: Vec::new() };
        let scope = &self.source.book.entries[self.source.index].scope;
        let world = &mut self.claim.world;
        let link = semantics::understand(world, scope, &clause, true).ok().filter(|_| !branches(&clause))?;
        let sides = link.instances.iter().flat_map(|i| if of_left { i.lhs.components() } else { i.rhs.components() });
        let t = world.graph.find("t");
        let mut rate = |e: Expr| if *right == Side::Constant { world.graph.time_derivative(e, t) } else { e };
        Some(sides.map(&mut rate).collect())
    }

    /// The values of an expression by itself; vectors are given by their components.
    pub fn value(&mut self, node: &Node) -> Sight {
        self.side(node, &Side::Node(node.clone()), true)
    }

    /// An expression's values. Operands are evaluated first; the depth of a formula is no depth of calls.
    fn row(&mut self, e: Expr) -> Option<Row> {
        let mut open = vec![e];
        while let Some(&top) = open.last() {
            if self.rows.len() < self.claim.world.graph.len() {
                self.rows.resize(self.claim.world.graph.len(), None);
            }
            if self.rows[top.index()].is_some() {
                open.pop();
                continue;
            }
            let node = *self.claim.world.graph.node(top);
            let row = match node {
                Op::Symbol(s) => match self.symbol(s, top)? {
                    Symbol::Row(row) => row,
                    Symbol::Is(other) => match self.rows.get(other.index()).copied().flatten() {
                        Some(row) => row,
                        None => {
                            open.push(other);
                            continue;
                        }
                    },
                },
                _ => {
                    let missing: Vec<Expr> = node.operands().filter(|a| self.rows[a.index()].is_none()).collect();
                    if !missing.is_empty() {
                        open.extend(missing);
                        continue;
                    }
                    std::array::from_fn(|k| {
                        operation(&node, &|a: Expr| self.rows[a.index()].map_or(f64::NAN, |r| r[k]))
                    })
                }
            };
            self.rows[top.index()] = Some(row);
            open.pop();
        }
        self.rows[e.index()]
    }

    /// A symbol's values: those of the states, of what a premise defines it as, or, where no premise speaks of it,
    /// drawn. `None` for a symbol that premises speak of and the states do not have.
    fn symbol(&mut self, s: SymId, e: Expr) -> Option<Symbol> {
        if !self.known.contains(&s) {
            let defined = self.claim.premises.resolve(&mut self.claim.world.graph, e);
            if defined != e {
                return Some(Symbol::Is(defined));
            }
            let world = &self.claim.world;
            if self.claim.bound.contains(&world.graph.info(s).base) {
                return None;
            }
            let from = source(world, s);
            let mut random = Random::new(self.seed, &world.tex(s));
            for values in &mut self.states {
                if values.len() <= s.index() {
                    values.resize(s.index() + 1, f64::NAN);
                }
                values[s.index()] = draw(&mut random, from.range, from.integer, false).to_f64();
            }
            self.known.insert(s);
        }
        Some(Symbol::Row(std::array::from_fn(|k| self.states[k].get(s.index()).copied().unwrap_or(f64::NAN))))
    }
}

/// What states are asked to be states of.
#[derive(Clone, Copy)]
enum Kept {
    /// The clauses as they stand.
    Clauses,
    /// Their right sides.
    Right,
    /// Their left sides.
    Left,
}

impl Kept {
    fn of(self, clause: &Clause) -> Option<Clause> {
        let itself = |n: &Node| Clause { lhs: n.clone(), rhs: Side::Node(n.clone()), ..clause.clone() };
        match (self, &clause.rhs) {
            (Kept::Clauses, _) => Some(clause.clone()),
            (Kept::Right, Side::Node(n)) => Some(itself(n)),
            (Kept::Right, Side::Constant) => None,
            (Kept::Left, _) => Some(itself(&clause.lhs)),
        }
    }
}

/// What a symbol is.
enum Symbol {
    Row(Row),
    Is(Expr),
}

fn operation(node: &Op, at: &dyn Fn(Expr) -> f64) -> f64 {
    match *node {
        Op::Rational(n, d) => n as f64 / d as f64,
        Op::Pi => std::f64::consts::PI,
        Op::E => std::f64::consts::E,
        Op::Symbol(_) | Op::Integral(_) => f64::NAN,
        Op::Neg(a) => -at(a),
        Op::Add(a, b) => at(a) + at(b),
        Op::Sub(a, b) => at(a) - at(b),
        Op::Mul(a, b) => at(a) * at(b),
        Op::Div(a, b) => at(a) / at(b),
        Op::PowI(a, n) => at(a).powi(n),
        Op::Pow(a, b) => at(a).powf(at(b)),
        Op::Sqrt(a) => at(a).sqrt(),
        Op::Call(f, a) => at(a).apply(f),
        Op::Atan2(a, b) => at(a).atan2(at(b)),
        Op::Elliptic(f, x) => {
            let (x, mut value) = (x.map(at), f64::NAN);
            value.set_elliptic(f, &x.each_ref()[..f.arity()]);
            value
        }
    }
}

fn branches(clause: &Clause) -> bool {
    semantics::has_branches(&clause.lhs) || matches!(&clause.rhs, Side::Node(n) if semantics::has_branches(n))
}
