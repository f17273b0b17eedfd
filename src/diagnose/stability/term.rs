//! Formulas as terms of an e-graph, and back.

use std::collections::HashMap;
use std::fmt;
use std::str::FromStr;

use egg::{Id, RecExpr, define_language};

use crate::expr::{Elliptic, Expr, Func, Graph, Node};

/// The largest integer power that is written out as a product.
const MOST_FACTORS: i32 = 6;

define_language! {
    /// An operation of a term.
    pub enum Term {
        "+" = Add([Id; 2]),
        "-" = Sub([Id; 2]),
        "*" = Mul([Id; 2]),
        "/" = Div([Id; 2]),
        "neg" = Neg(Id),
        "sq" = Square(Id),
        "sqrt" = Sqrt(Id),
        "abs" = Abs(Id),
        "sin" = Sin(Id),
        "cos" = Cos(Id),
        "tan" = Tan(Id),
        "arcsin" = Asin(Id),
        "arccos" = Acos(Id),
        "arctan" = Atan(Id),
        "sinh" = Sinh(Id),
        "cosh" = Cosh(Id),
        "tanh" = Tanh(Id),
        "artanh" = Atanh(Id),
        "exp" = Exp(Id),
        "ln" = Ln(Id),
        "sn" = Sn([Id; 2]),
        "cn" = Cn([Id; 2]),
        "dn" = Dn([Id; 2]),
        Constant(Fraction),
        Leaf(Leaf),
    }
}

/// A fraction in lowest terms, with a positive denominator.
#[derive(Copy, Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Fraction(pub i64, pub i64);

impl Fraction {
    /// n/d in lowest terms, if it fits.
    pub fn new(n: i128, d: i128) -> Option<Self> {
        let (n, d) = crate::expr::ratio::reduce(n, d)?;
        Some(Fraction(i64::try_from(n).ok()?, i64::try_from(d).ok()?))
    }

    fn wide(self) -> (i128, i128) {
        (self.0.into(), self.1.into())
    }

    /// The sum.
    pub fn plus(self, other: Self) -> Option<Self> {
        let ((a, b), (c, d)) = (self.wide(), other.wide());
        Fraction::new(a * d + c * b, b * d)
    }

    /// The product.
    pub fn times(self, other: Self) -> Option<Self> {
        let ((a, b), (c, d)) = (self.wide(), other.wide());
        Fraction::new(a * c, b * d)
    }

    /// The reciprocal.
    pub fn reciprocal(self) -> Option<Self> {
        Fraction::new(self.1.into(), self.0.into())
    }

    /// With the other sign.
    pub fn negated(self) -> Option<Self> {
        Some(Fraction(self.0.checked_neg()?, self.1))
    }
}

impl fmt::Display for Fraction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.1 == 1 { write!(f, "{}", self.0) } else { write!(f, "{}/{}", self.0, self.1) }
    }
}

impl FromStr for Fraction {
    type Err = ();

    fn from_str(text: &str) -> Result<Self, ()> {
        let (n, d) = text.split_once('/').unwrap_or((text, "1"));
        let (n, d): (i64, i64) = (n.parse().map_err(|_| ())?, d.parse().map_err(|_| ())?);
        Fraction::new(n.into(), d.into()).ok_or(())
    }
}

/// What the rules do not look into: a symbol, or a function that they know nothing of.
#[derive(Copy, Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Leaf(pub u32);

impl fmt::Display for Leaf {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "leaf{}", self.0)
    }
}

impl FromStr for Leaf {
    type Err = ();

    fn from_str(text: &str) -> Result<Self, ()> {
        text.strip_prefix("leaf").and_then(|n| n.parse().ok()).map(Leaf).ok_or(())
    }
}

/// An expression as a term, with what its leaves are.
pub fn term(graph: &Graph, e: Expr) -> (RecExpr<Term>, Vec<Expr>) {
    let (mut term, mut leaves) = (RecExpr::default(), Vec::new());
    let mut ids: HashMap<Expr, Id> = HashMap::new();
    for x in graph.reachable(&[e]) {
        let id = match known(graph.node(x), &ids, &mut term) {
            Some(id) => id,
            None => {
                leaves.push(x);
                term.add(Term::Leaf(Leaf(leaves.len() as u32 - 1)))
            }
        };
        ids.insert(x, id);
    }
    // What leaves are made of stands in the term as well, but not last.
    (trimmed(&term), leaves)
}

/// The term without what its last node does not need.
fn trimmed(term: &RecExpr<Term>) -> RecExpr<Term> {
    let nodes: &[Term] = term.as_ref();
    match nodes.last() {
        Some(last) => last.build_recexpr(|id| nodes[usize::from(id)].clone()),
        None => term.clone(),
    }
}

use egg::Language;

fn known(node: &Node, ids: &HashMap<Expr, Id>, term: &mut RecExpr<Term>) -> Option<Id> {
    let at = |e: Expr| ids.get(&e).copied();
    let new = match *node {
        Node::Rational(n, d) => Term::Constant(Fraction::new(n, d)?),
        Node::Neg(a) => Term::Neg(at(a)?),
        Node::Add(a, b) => Term::Add([at(a)?, at(b)?]),
        Node::Sub(a, b) => Term::Sub([at(a)?, at(b)?]),
        Node::Mul(a, b) => Term::Mul([at(a)?, at(b)?]),
        Node::Div(a, b) => Term::Div([at(a)?, at(b)?]),
        Node::PowI(a, n) => return power(at(a)?, n, term),
        Node::Sqrt(a) => Term::Sqrt(at(a)?),
        Node::Call(f, a) => call(f, at(a)?)?,
        Node::Elliptic(Elliptic::Sn, [u, k, ..]) => Term::Sn([at(u)?, at(k)?]),
        Node::Elliptic(Elliptic::Cn, [u, k, ..]) => Term::Cn([at(u)?, at(k)?]),
        Node::Elliptic(Elliptic::Dn, [u, k, ..]) => Term::Dn([at(u)?, at(k)?]),
        _ => return None,
    };
    Some(term.add(new))
}

fn power(a: Id, n: i32, term: &mut RecExpr<Term>) -> Option<Id> {
    let count = n.checked_abs().filter(|n| (1..=MOST_FACTORS).contains(n))?;
    let mut product = a;
    let square = if count >= 2 { term.add(Term::Square(a)) } else { a };
    if count >= 2 {
        product = square;
        for k in (2..count).step_by(2) {
            let factor = if k + 2 <= count { square } else { a };
            product = term.add(Term::Mul([product, factor]));
        }
    }
    if n < 0 {
        let one = term.add(Term::Constant(Fraction(1, 1)));
        product = term.add(Term::Div([one, product]));
    }
    Some(product)
}

fn call(f: Func, a: Id) -> Option<Term> {
    Some(match f {
        Func::Sin => Term::Sin(a),
        Func::Cos => Term::Cos(a),
        Func::Tan => Term::Tan(a),
        Func::Asin => Term::Asin(a),
        Func::Acos => Term::Acos(a),
        Func::Atan => Term::Atan(a),
        Func::Sinh => Term::Sinh(a),
        Func::Cosh => Term::Cosh(a),
        Func::Tanh => Term::Tanh(a),
        Func::Atanh => Term::Atanh(a),
        Func::Exp => Term::Exp(a),
        Func::Ln => Term::Ln(a),
        Func::Abs => Term::Abs(a),
        _ => return None,
    })
}

/// The function of a graph that an operation with one operand is.
pub fn function(term: &Term) -> Option<Func> {
    Some(match term {
        Term::Sin(_) => Func::Sin,
        Term::Cos(_) => Func::Cos,
        Term::Tan(_) => Func::Tan,
        Term::Asin(_) => Func::Asin,
        Term::Acos(_) => Func::Acos,
        Term::Atan(_) => Func::Atan,
        Term::Sinh(_) => Func::Sinh,
        Term::Cosh(_) => Func::Cosh,
        Term::Tanh(_) => Func::Tanh,
        Term::Atanh(_) => Func::Atanh,
        Term::Exp(_) => Func::Exp,
        Term::Ln(_) => Func::Ln,
        Term::Abs(_) => Func::Abs,
        _ => return None,
    })
}

/// The elliptic function that an operation is.
pub fn elliptic(term: &Term) -> Option<Elliptic> {
    match term {
        Term::Sn(_) => Some(Elliptic::Sn),
        Term::Cn(_) => Some(Elliptic::Cn),
        Term::Dn(_) => Some(Elliptic::Dn),
        _ => None,
    }
}

/// A term as an expression; none where it is empty or a leaf is unknown.
pub fn expression(graph: &mut Graph, term: &RecExpr<Term>, leaves: &[Expr]) -> Option<Expr> {
    let mut made: Vec<Expr> = Vec::new();
    for node in term.as_ref() {
        let x: Vec<Expr> = node.children().iter().map(|id| made[usize::from(*id)]).collect();
        let e = match (node, x.as_slice()) {
            (Term::Constant(Fraction(n, d)), _) => graph.ratio((*n).into(), (*d).into()),
            (Term::Leaf(Leaf(k)), _) => *leaves.get(*k as usize)?,
            (Term::Add(_), [a, b]) => graph.add(*a, *b),
            (Term::Sub(_), [a, b]) => graph.sub(*a, *b),
            (Term::Mul(_), [a, b]) => graph.mul(*a, *b),
            (Term::Div(_), [a, b]) => graph.div(*a, *b),
            (Term::Neg(_), [a]) => graph.neg(*a),
            (Term::Square(_), [a]) => graph.powi(*a, 2),
            (Term::Sqrt(_), [a]) => graph.sqrt(*a),
            (f, [a]) => graph.call(function(f)?, *a),
            (f, [u, k]) => graph.elliptic(elliptic(f)?, &[*u, *k]),
            _ => return None,
        };
        made.push(e);
    }
    made.last().copied()
}
