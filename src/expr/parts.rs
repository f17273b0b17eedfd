//! What expressions are made of.

use super::graph::{Expr, Graph, Node, SymId};
use std::collections::BTreeSet;

/// Everything that some expressions are made of, themselves included, operands before what they are used in.
#[derive(Clone, Debug)]
pub struct Parts {
    order: Vec<Expr>,
    /// A bit for each index of the graph up to the last part.
    marks: Vec<u64>,
    /// How many parts stand before each word of marks.
    before: Vec<u32>,
}

impl Parts {
    /// The parts, in the order of the graph.
    pub fn order(&self) -> &[Expr] {
        &self.order
    }

    /// The position of a part in the order.
    pub fn position(&self, e: Expr) -> Option<usize> {
        let (word, bit) = place(e);
        let marks = *self.marks.get(word)?;
        let below = marks & (bit - 1);
        (marks & bit != 0).then(|| self.before[word] as usize + below.count_ones() as usize)
    }
}

/// The word and the bit of an expression.
fn place(e: Expr) -> (usize, u64) {
    (e.index() / 64, 1 << (e.index() % 64))
}

impl Graph {
    /// Everything the expressions are made of.
    pub fn parts(&self, es: &[Expr]) -> Parts {
        self.parts_by(es, &|e| self.node(e).operands().collect())
    }

    /// As [`Graph::parts`], with the symbols that an integral depends on in the place of its integrand.
    pub(super) fn parts_around_integrals(&self, es: &[Expr]) -> Parts {
        self.parts_by(es, &|e| match *self.node(e) {
            Node::Integral(integrand) => self.parameters(integrand),
            node => node.operands().collect(),
        })
    }

    fn parts_by(&self, es: &[Expr], operands: &dyn Fn(Expr) -> Vec<Expr>) -> Parts {
        let words = es.iter().map(|e| place(*e).0 + 1).max().unwrap_or(0);
        let mut marks = vec![0; words];
        let mut order = Vec::new();
        // Operands have smaller indices than what they are used in, and so lie within the marks.
        let mut reach = |e: Expr, order: &mut Vec<Expr>| {
            let (word, bit) = place(e);
            if marks[word] & bit == 0 {
                marks[word] |= bit;
                order.push(e);
            }
        };
        es.iter().for_each(|e| reach(*e, &mut order));
        let mut next = 0;
        while let Some(&e) = order.get(next) {
            next += 1;
            operands(e).into_iter().for_each(|a| reach(a, &mut order));
        }
        order.sort_unstable();
        let before = marks.iter().scan(0, |count, word| {
            let before = *count;
            *count += word.count_ones();
            Some(before)
        });
        let before = before.collect();
        Parts { order, marks, before }
    }

    /// Everything the expressions are made of, themselves included, operands first.
    pub fn reachable(&self, es: &[Expr]) -> Vec<Expr> {
        self.parts(es).order
    }

    /// The symbols that occur in the expressions, but for those that integrals bind.
    pub fn symbols(&self, es: &[Expr]) -> BTreeSet<SymId> {
        let symbol = |e: Expr| match *self.node(e) {
            Node::Symbol(s) if !self.bound.contains_key(&s) => Some(s),
            _ => None,
        };
        self.reachable(es).into_iter().filter_map(symbol).collect()
    }
}
