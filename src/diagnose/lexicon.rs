//! What may fill a hole in a formula: products of the symbols nearby, and the terms of the formulas nearby, looked up by
//! the values that the hole wants at the states of a [`Screen`].

use crate::check::{STATES, Screen, Sight};
use crate::latex::ast::{Kind, Node};
use crate::latex::{self, to_latex};
use crate::semantics::Scope;

use super::change::Path;
use super::likeness;
use super::names::Name;
use super::near::Near;
use super::shape::times;

/// How many symbols, and sines and cosines of angles, products are made of.
const ATOMS: usize = 22;
/// How many of them stand in a product, above and below the bar.
const LONGEST: usize = 3;
/// How many stand in a product of the nearest atoms alone, and how many those are.
const LONGEST_NEAR: (usize, usize) = (4, 12);
/// The numbers that may stand before a product.
const NUMBERS: [(u32, u32); 8] = [(1, 1), (2, 1), (1, 2), (3, 1), (1, 3), (4, 1), (1, 4), (3, 2)];
/// How near two values must be, relative to their size.
const NEAR: f64 = 1e-8;

type Row = [f64; STATES];

/// A symbol, or a function of one, with its values.
struct Atom {
    node: Node,
    row: Row,
    far: bool,
}

/// A product of atoms and their reciprocals.
struct Product {
    above: Vec<usize>,
    below: Vec<usize>,
    row: Row,
}

/// What fills a hole.
#[derive(Clone, Debug)]
pub struct Filling {
    /// Whether it is negative.
    pub negative: bool,
    /// The number before it, a fraction.
    pub number: (u32, u32),
    /// The factors above the bar.
    pub above: Vec<Node>,
    /// The factors below the bar.
    pub below: Vec<Node>,
    /// How many symbols it has beyond the first, with what those cost that stand far away.
    pub length: u32,
    /// Whether it is a piece of a formula nearby.
    pub copied: bool,
}

/// The words of a formula's surroundings with their values.
pub struct Lexicon {
    atoms: Vec<Atom>,
    /// In the order of the size at the first state.
    products: Vec<Product>,
    /// Terms, roots, brackets and fractions nearby, alone and with an atom (times it, or over it); in the same order.
    terms: Vec<Known>,
    /// The vectors nearby with their values.
    arrows: Vec<(Node, Vec<f64>)>,
}

/// A piece of a formula nearby.
struct Known {
    node: Node,
    with: Option<(usize, bool)>,
    row: Row,
}

impl Lexicon {
    /// Collects and evaluates.
    pub fn new(screen: &mut Screen, scope: &Scope, near: &Near, tree: &Node) -> Self {
        let mut lexicon = Lexicon { atoms: Vec::new(), products: Vec::new(), terms: Vec::new(), arrows: Vec::new() };
        let own = to_latex(tree);
        let mut nodes: Vec<Node> = Vec::new();
        for symbol in near.scalars(scope) {
            nodes.push(symbol.clone());
            let angle = Name::of(scope, symbol).is_some_and(|n| n.entry.is_angle() && n.dots == 0);
            if angle {
                let turned = ["\\sin", "\\cos"].map(|f| latex::parse(&format!("{f} {}", to_latex(symbol))));
                nodes.extend(turned.into_iter().filter_map(Result::ok));
            }
        }
        for node in nodes.into_iter().take(ATOMS) {
            if let Some(row) = row(screen, &node) {
                let far = !own.contains(&to_latex(&node));
                lexicon.atoms.push(Atom { node, row, far });
            }
        }
        let mut at = Vec::new();
        lexicon.grow(&mut at, 0, [1.0; STATES]);
        lexicon.products.sort_by(|a, b| a.row[0].abs().total_cmp(&b.row[0].abs()));
        lexicon.collect(screen, near.terms());
        for arrow in near.arrows(scope) {
            if let Sight::Values(values) = screen.value(arrow)
                && values.iter().all(|x| x.is_finite())
            {
                lexicon.arrows.push((arrow.clone(), values));
            }
        }
        lexicon
    }

    fn collect(&mut self, screen: &mut Screen, pieces: Vec<Node>) {
        for node in pieces {
            let Some(own) = row(screen, &node) else { continue };
            self.terms.push(Known { node: node.clone(), with: None, row: own });
            for (k, atom) in self.atoms.iter().enumerate() {
                for below in [false, true] {
                    let both = |n: usize| if below { own[n] / atom.row[n] } else { own[n] * atom.row[n] };
                    self.terms.push(Known {
                        node: node.clone(),
                        with: Some((k, below)),
                        row: std::array::from_fn(both),
                    });
                }
            }
        }
        self.terms.sort_by(|a, b| a.row[0].abs().total_cmp(&b.row[0].abs()));
    }

    /// Adds all products that begin with these literals: atom k above the bar is 2k, below it 2k + 1.
    fn grow(&mut self, literals: &mut Vec<usize>, from: usize, row: Row) {
        let part = |below: bool| literals.iter().filter(|l| (*l % 2 == 1) == below).map(|l| l / 2).collect();
        self.products.push(Product { above: part(false), below: part(true), row });
        let near = literals.iter().all(|l| l / 2 < LONGEST_NEAR.1);
        let last = match literals.len() {
            0..LONGEST => self.atoms.len(),
            n if n < LONGEST_NEAR.0 && near => LONGEST_NEAR.1.min(self.atoms.len()),
            _ => return,
        };
        for literal in from..2 * last {
            // No atom above and below the bar.
            if literal % 2 == 1 && literals.contains(&(literal - 1)) {
                continue;
            }
            let atom = self.atoms[literal / 2].row;
            let next = std::array::from_fn(|k| if literal % 2 == 0 { row[k] * atom[k] } else { row[k] / atom[k] });
            literals.push(literal);
            self.grow(literals, literal, next);
            literals.pop();
        }
    }

    /// What has these values: products with a number, and pieces of formulas nearby with a number and an atom; the
    /// shortest first.
    pub fn fillings(&self, wanted: &Row) -> Vec<Filling> {
        let mut found: Vec<Filling> = Vec::new();
        if !wanted.iter().all(|x| x.is_finite() && x.abs() > 1e-12) {
            return found;
        }
        for number in NUMBERS {
            let scale = f64::from(number.0) / f64::from(number.1);
            let target: Row = wanted.map(|x| x / scale);
            let counted = u32::from(number != (1, 1));
            for (product, negative) in hits(&self.products, |p| &p.row, &target) {
                let nodes = |of: &[usize]| of.iter().map(|k| self.atoms[*k].node.clone()).collect::<Vec<_>>();
                let parts = || product.above.iter().chain(&product.below);
                let far = parts().filter(|k| self.atoms[**k].far).count();
                let length = small(parts().count()).saturating_sub(1) + counted + small(far);
                let (above, below) = (nodes(&product.above), nodes(&product.below));
                found.push(Filling { negative, number, above, below, length, copied: false });
            }
            for (known, negative) in hits(&self.terms, |k| &k.row, &target) {
                let mut filling =
                    Filling { negative, number, above: Vec::new(), below: Vec::new(), length: counted, copied: true };
                filling.above.push(known.node.clone());
                if let Some((k, below)) = known.with {
                    let atom = self.atoms[k].node.clone();
                    filling.length += 1;
                    if below { filling.below.push(atom) } else { filling.above.insert(0, atom) }
                }
                found.push(filling);
            }
        }
        found.sort_by_key(|f| f.length);
        found
    }

    /// The vectors that have these values, up to a scalar factor.
    pub fn arrows(&self, wanted: &[f64]) -> Vec<(Filling, Node)> {
        let mut found = Vec::new();
        for (arrow, values) in self.arrows.iter().filter(|(_, v)| v.len() == wanted.len()) {
            let Some(factor) = ratio(wanted, values) else { continue };
            found.extend(self.fillings(&factor).into_iter().take(2).map(|f| (f, arrow.clone())));
        }
        found.sort_by_key(|(f, _)| f.length);
        found
    }
}

/// The entries of a list in the order of size that have these values, up to the sign.
fn hits<'l, T>(list: &'l [T], row: fn(&T) -> &Row, target: &Row) -> Vec<(&'l T, bool)> {
    let size = target[0].abs();
    let first = list.partition_point(|t| row(t)[0].abs() < size * (1.0 - NEAR));
    let near = list[first..].iter().take_while(|t| row(t)[0].abs() <= size * (1.0 + NEAR));
    near.filter_map(|t| equal(target, row(t)).map(|negative| (t, negative))).collect()
}

/// The scalar, at each state, by which one vector is another.
fn ratio(a: &[f64], b: &[f64]) -> Option<Row> {
    let mut factors = [f64::NAN; STATES];
    for (k, x) in factors.iter_mut().enumerate() {
        let components = (k..b.len()).step_by(STATES);
        let largest = components.clone().max_by(|i, j| b[*i].abs().total_cmp(&b[*j].abs()))?;
        *x = a[largest] / b[largest];
        let size = a[largest].abs();
        if !x.is_finite() || !components.clone().all(|i| (a[i] - *x * b[i]).abs() <= 10.0 * NEAR * size) {
            return None;
        }
    }
    Some(factors)
}

fn small(n: usize) -> u32 {
    u32::try_from(n).unwrap_or(u32::MAX)
}

/// Whether two rows are equal up to a common sign, and whether that is minus.
fn equal(a: &Row, b: &Row) -> Option<bool> {
    let same = |sign: f64| a.iter().zip(b).all(|(x, y)| (x - sign * y).abs() <= NEAR * x.abs().max(y.abs()));
    if same(1.0) {
        Some(false)
    } else if same(-1.0) {
        Some(true)
    } else {
        None
    }
}

fn row(screen: &mut Screen, node: &Node) -> Option<Row> {
    match screen.value(node) {
        Sight::Values(values) => Row::try_from(values).ok().filter(|r| r.iter().all(|x| x.is_finite() && *x != 0.0)),
        _ => None,
    }
}

impl Filling {
    /// What it costs where a factor is put in.
    pub fn factor_cost(&self) -> u32 {
        likeness::INSERTED + self.length + u32::from(self.negative)
    }

    /// What it costs where a term is put in.
    pub fn term_cost(&self) -> u32 {
        self.length + if self.copied { likeness::TERM } else { likeness::MADE_UP }
    }

    /// Whether it is the number 1.
    pub fn is_one(&self) -> bool {
        !self.negative && self.number == (1, 1) && self.above.is_empty() && self.below.is_empty()
    }

    /// The product by itself, without its sign.
    pub fn node(&self) -> Node {
        let number = |n: u32| Node::new(Kind::Number(n.to_string()), 0..0);
        let product = |n: u32, factors: &[Node]| {
            let (mut all, ones): (Vec<Node>, _) = (factors.to_vec(), n == 1);
            if !ones || all.is_empty() {
                all.insert(0, number(n));
            }
            all.into_iter().rev().reduce(|rest, first| times(&first, &rest)).unwrap_or_else(|| number(n))
        };
        let (above, below) = (product(self.number.0, &self.above), product(self.number.1, &self.below));
        if self.number.1 == 1 && self.below.is_empty() {
            return above;
        }
        Node::new(Kind::Frac(Box::new(above), Box::new(below)), 0..0)
    }

    /// A node multiplied by it, the sign aside: factors of the node that stand below the bar are left out.
    pub fn applied(&self, node: &Node) -> Node {
        let mut rest = self.clone();
        let mut node = node.clone();
        rest.below.retain(|factor| match without_factor(&node, factor) {
            Some(shorter) => {
                node = shorter;
                false
            }
            None => true,
        });
        if let (Kind::Frac(a, b), false) = (&node.kind, rest.below.is_empty() && rest.number.1 == 1) {
            let above = Filling { below: Vec::new(), number: (rest.number.0, 1), ..rest.clone() };
            let below = Filling { above: rest.below.clone(), below: Vec::new(), number: (rest.number.1, 1), ..rest };
            let part = |f: Filling, n: &Node| if f.is_trivial() { n.clone() } else { product(&f.node(), n) };
            return Node::new(Kind::Frac(Box::new(part(above, a)), Box::new(part(below, b))), node.span.clone());
        }
        if rest.is_trivial() { node } else { product(&rest.node(), &node) }
    }

    fn is_trivial(&self) -> bool {
        self.number == (1, 1) && self.above.is_empty() && self.below.is_empty()
    }
}

/// A product of two; 1 is left out.
fn product(factor: &Node, node: &Node) -> Node {
    match &node.kind {
        Kind::Number(n) if n == "1" => factor.clone(),
        _ => times(factor, node),
    }
}

/// A product without one of its factors; 1 where nothing is left.
fn without_factor(node: &Node, factor: &Node) -> Option<Node> {
    let latex = to_latex(factor);
    if to_latex(node) == latex {
        return Some(Node::new(Kind::Number("1".into()), node.span.clone()));
    }
    let Kind::Juxt(factors) = &node.kind else { return None };
    let length = if let Kind::Juxt(parts) = &factor.kind { parts.len() } else { 1 };
    let at = (0..factors.len().saturating_sub(length - 1)).find(|k| {
        let run = super::shape::juxt(&factors[*k..k + length], &node.span);
        let argument = *k > 0 && super::shape::is_function(&factors[k - 1]);
        to_latex(&run) == latex && !argument
    })?;
    let rest: Vec<Node> = factors[..at].iter().chain(&factors[at + length..]).cloned().collect();
    (!rest.is_empty()).then(|| super::shape::juxt(&rest, &node.span))
}

/// A place for a factor or a term in a side.
pub struct Slot {
    /// Where in the side.
    pub path: Path,
    /// Whether a term may be put there, too.
    pub sum: bool,
}

/// The places of a side at which a factor or a term may be missing.
pub fn slots(side: &Node) -> Vec<Slot> {
    let mut found = Vec::new();
    visit(side, &mut Vec::new(), true, &mut found);
    found
}

fn visit(node: &Node, path: &mut Path, whole: bool, found: &mut Vec<Slot>) {
    if whole {
        found.push(Slot { path: path.clone(), sum: true });
    }
    let child = |k: usize, n: &Node, whole: bool, path: &mut Path, found: &mut Vec<Slot>| {
        path.push(k);
        visit(n, path, whole, found);
        path.pop();
    };
    match &node.kind {
        Kind::Sum(terms) => {
            for (k, term) in terms.iter().enumerate() {
                path.push(k);
                if terms.len() > 1 || term.sign_span.is_some() {
                    found.push(Slot { path: path.clone(), sum: false });
                }
                visit(&term.node, path, false, found);
                path.pop();
            }
        }
        Kind::Juxt(factors) => {
            for (k, factor) in factors.iter().enumerate() {
                child(k, factor, false, path, found);
            }
        }
        Kind::Product { .. } => {
            for (k, factor) in node.children().into_iter().enumerate() {
                child(k, factor, false, path, found);
            }
        }
        Kind::Frac(above, _) => child(0, above, matches!(above.kind, Kind::Sum(_)), path, found),
        Kind::Group { body, .. } if !matches!(body.kind, Kind::Chain { .. }) => {
            child(0, body, matches!(body.kind, Kind::Sum(_)) || path.is_empty(), path, found);
        }
        Kind::Scripts { base, .. } if matches!(base.kind, Kind::Group { .. }) => child(0, base, false, path, found),
        _ => {}
    }
}
