//! Approximations in notes that declare nothing: `T \\approx \\frac{1}{2} m v^2 + \\frac{3}{8} m v^4/c^2`.
//!
//! What is small is not said. Where the right side is a polynomial in a symbol, and what is left over on some premises falls
//! faster than its last term, the formula is an expansion in that symbol, and right. Where what is left over falls, but
//! not faster than the last term, a coefficient is wrong or a term is missing: one edit is searched for.

use std::cell::Cell;
use std::collections::BTreeSet;

use crate::check::verdict::Judgement;
use crate::check::{Book, Options};
use crate::document::Spanned;
use crate::expr::{Expr, Tape, Workspace};
use crate::latex::ast::{Node, Rel};
use crate::semantics::{Elaborator, Scope, Side, Value, World};

use super::desk::{Basis, Desk};
use super::judge::{Ground, conclude, suspected};
use super::suspects;

/// The highest power of a small parameter.
const HIGHEST: usize = 6;
/// How many symbols are tried as the small one.
const SMALL: usize = 4;
/// How many sets of premises are tried.
const BASES: usize = 24;

/// A symbol that may be small.
struct Small {
    name: String,
    /// The order to which what is printed is right, relative to its first term.
    order: f64,
}

impl Ground {
    /// The judgement on an approximation, where something can be said of it.
    pub(super) fn near(
        &self,
        book: &mut Book,
        index: usize,
        first: &Judgement,
        options: &Options,
    ) -> Option<Judgement> {
        let mut desk =
            Desk { book, index, link: 0, taken: Vec::new(), all: &self.candidates, options, blurred: Cell::new(false) };
        let clauses = desk.clauses();
        let [clause] = clauses.as_slice() else { return None };
        let Side::Node(rhs) = clause.rhs.clone() else { return None };
        if clause.rel != Rel::Approx {
            return None;
        }
        let bases = std::iter::once(Basis::default()).chain(self.bases(&desk, &clauses)).take(BASES);
        let bases: Vec<Basis> = bases.collect();
        let small = small(&desk.book.entries[index].scope, &rhs);
        for Small { name, order } in &small {
            desk.say_small(name, *order);
            if desk.search(&bases).is_some() {
                let mut judgement = conclude(&mut desk, &clauses, &[]);
                judgement.reason = Some(format!("for small ${name}$"));
                return Some(judgement);
            }
        }
        for Small { name, order } in small.iter().filter(|s| s.order > 1.0) {
            desk.say_small(name, 1.0);
            // Beside a wrong coefficient, other wrong ones pass as well.
            let Some(basis) = bases.iter().find(|basis| desk.stands(basis)).cloned() else { continue };
            desk.say_small(name, *order);
            let found = suspects::search(&mut desk, &[basis], &BTreeSet::new(), &first.links)?;
            return Some(suspected(first.clone(), found));
        }
        None
    }
}

impl Desk<'_> {
    /// Says which symbol is small, and to which order the equation claims to be right.
    fn say_small(&mut self, name: &str, order: f64) {
        let annotation = self.book.entries[self.index].equation.annotation.get_or_insert_default();
        annotation.small = Some(Spanned::new(name.to_owned(), 0..0));
        annotation.order = Some(order);
    }
}

/// The symbols in which a formula is a polynomial, those with the most terms first.
fn small(scope: &Scope, formula: &Node) -> Vec<Small> {
    let mut world = World::new();
    let Ok(Value::Scalar(e)) = Elaborator::new(&mut world, scope, Vec::new(), true).value(formula).map(|t| t.value)
    else {
        return Vec::new();
    };
    let symbols = world.graph.symbols(&[e]);
    let mut found: Vec<(usize, Small)> = Vec::new();
    for symbol in symbols {
        let zero = world.graph.int(0);
        let at_zero = std::collections::HashMap::from([(symbol, zero)]);
        let (mut derivative, mut present, mut ends) = (e, Vec::new(), false);
        for power in 0..=HIGHEST {
            if vanishes(&world, derivative) {
                ends = true;
                break;
            }
            let coefficient = world.graph.substitute(derivative, &at_zero);
            if !vanishes(&world, coefficient) {
                present.push(power);
            }
            derivative = world.graph.diff(derivative, symbol);
        }
        if let (true, [first, .., last] | [first @ last]) = (ends, present.as_slice()) {
            let order = (last - first + 1) as f64;
            found.push((last - first, Small { name: world.graph.info(symbol).name.clone(), order }));
        }
    }
    found.sort_by_key(|(span, small)| (std::cmp::Reverse(*span), small.name.clone()));
    found.into_iter().take(SMALL).map(|(_, small)| small).collect()
}

/// Whether an expression is zero at some points.
fn vanishes(world: &World, e: Expr) -> bool {
    let tape = Tape::compile(&world.graph, &[e]);
    let count = tape.inputs().len();
    (0..3).all(|n| {
        let at: Vec<f64> = (0..count).map(|k| 1.0 + 0.4 * (1.7 * k as f64 + 2.3 * f64::from(n)).sin()).collect();
        tape.eval(&at, &(), &mut Workspace::default()).first().is_some_and(|x| x.abs() < 1e-12)
    })
}
