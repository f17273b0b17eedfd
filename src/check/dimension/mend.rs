//! Which factor mends a dimension: of the declared symbols, those that the notes use most in that place.

use std::collections::{HashMap, HashSet};

use crate::check::book::{Book, Entry, Version};
use crate::latex::ast::{Kind, Node, ProductOp, Sign};
use crate::semantics::units::Dimension;
use crate::semantics::{self, EntryKind, Scope};

/// How many factors are named.
const NAMED: usize = 3;
/// How many symbols are tried in pairs.
const PAIRED: usize = 40;

/// In how many equations each symbol stands above and below the bar.
#[derive(Debug, Default)]
pub struct Uses(HashMap<(String, bool), usize>);

/// The symbols of an equation, as printed, with the side of the bar that they stand on.
pub type Used = HashSet<(String, bool)>;

/// Those of an equation.
pub fn used(entry: &Entry) -> Used {
    let mut found = Used::new();
    if let Ok(tree) = &entry.formula(Version::Printed).tree {
        collect(&entry.scope, tree, true, &mut found);
    }
    found
}

/// A symbol of a scope with its dimension and uses.
struct Candidate<'s> {
    name: &'s str,
    dimension: Dimension,
    above: usize,
    below: usize,
    /// Whether the equation itself has it.
    here: bool,
}

/// A factor with what speaks for it.
struct Factor {
    latex: String,
    /// How many symbols it has, powers counted.
    length: usize,
    uses: usize,
    /// Whether the equation itself has its symbols.
    here: bool,
}

impl Uses {
    /// Counts another equation's.
    pub fn count(&mut self, used: &Used) {
        for one in used {
            *self.0.entry(one.clone()).or_default() += 1;
        }
    }

    /// The simplest factors of this dimension, in LaTeX, those first whose symbols are most used in that place.
    pub fn factors(&self, book: &Book, index: usize, need: Dimension) -> Vec<String> {
        let entry = &book.entries[index];
        let mut candidates = self.candidates(&entry.scope, &entry.mentions);
        candidates.sort_by(|a, b| (b.above + b.below).cmp(&(a.above + a.below)).then(a.name.cmp(b.name)));
        let mut factors: Vec<Factor> = candidates.iter().flat_map(|c| c.powers(need)).collect();
        if factors.is_empty() {
            let paired = &candidates[..candidates.len().min(PAIRED)];
            for (k, a) in paired.iter().enumerate() {
                factors.extend(paired[k + 1..].iter().flat_map(|b| a.paired(b, need)));
            }
        }
        let shortest = factors.iter().map(|f| f.length).min();
        factors.retain(|f| Some(f.length) == shortest);
        factors.sort_by(|a, b| b.uses.cmp(&a.uses).then(b.here.cmp(&a.here)).then(a.latex.cmp(&b.latex)));
        factors.into_iter().take(NAMED).map(|f| f.latex).collect()
    }

    fn candidates<'s>(&self, scope: &'s Scope, mentions: &HashMap<String, usize>) -> Vec<Candidate<'s>> {
        let count = |name: &str, above: bool| self.0.get(&(name.to_owned(), above)).copied().unwrap_or(0);
        let named = scope.entries().filter(|e| e.kind == EntryKind::Scalar && !e.pattern.contains('#'));
        let used = named.filter_map(|e| {
            let dimension = e.dimension.filter(|d| !d.is_none())?;
            let (above, below) = (count(&e.pattern, true), count(&e.pattern, false));
            // Time itself is no constant of a formula.
            let offered = above + below > 0 && !matches!(e.pattern.as_str(), "t" | "dt");
            offered.then_some(Candidate {
                name: &e.pattern,
                dimension,
                above,
                below,
                here: mentions.contains_key(&e.pattern),
            })
        });
        used.collect()
    }
}

impl Candidate<'_> {
    /// The powers of the symbol that have the dimension.
    fn powers(&self, need: Dimension) -> Vec<Factor> {
        let name = self.name;
        let forms = [
            (1, name.to_owned(), self.above),
            (-1, format!("\\frac{{1}}{{{name}}}"), self.below),
            (2, format!("{}^{{2}}", grouped(name)), self.above),
            (-2, format!("\\frac{{1}}{{{}^{{2}}}}", grouped(name)), self.below),
        ];
        let fitting = forms.into_iter().filter(|(n, ..)| self.dimension.to_the((*n, 1)) == Some(need));
        fitting
            .map(|(n, latex, uses)| Factor { latex, length: n.unsigned_abs() as usize, uses, here: self.here })
            .collect()
    }

    /// The products and quotients of two symbols that have the dimension.
    fn paired(&self, other: &Candidate, need: Dimension) -> Vec<Factor> {
        let (a, b) = (self.name, other.name);
        let product = self.dimension.times(&other.dimension);
        let quotient = self.dimension.over(&other.dimension);
        let inverse = |d: Option<Dimension>| d.and_then(|d| d.to_the((-1, 1)));
        let forms = [
            (product, format!("{a} {b}"), self.above.min(other.above)),
            (quotient, format!("\\frac{{{a}}}{{{b}}}"), self.above.min(other.below)),
            (inverse(quotient), format!("\\frac{{{b}}}{{{a}}}"), other.above.min(self.below)),
            (inverse(product), format!("\\frac{{1}}{{{a} {b}}}"), self.below.min(other.below)),
        ];
        let fitting = forms.into_iter().filter(|(dimension, ..)| *dimension == Some(need));
        fitting.map(|(_, latex, uses)| Factor { latex, length: 2, uses, here: self.here && other.here }).collect()
    }
}

/// A name that takes an exponent.
fn grouped(name: &str) -> String {
    if name.contains('^') || name.contains('\'') { format!("({name})") } else { name.to_owned() }
}

/// The symbols of a formula with the side of the bar that they stand on.
fn collect(scope: &Scope, node: &Node, above: bool, found: &mut Used) {
    let pattern = semantics::pattern_of(scope, node);
    if scope.get(&pattern).is_some() {
        found.insert((pattern, above));
        return;
    }
    match &node.kind {
        Kind::Frac(n, d) => {
            collect(scope, n, above, found);
            collect(scope, d, !above, found);
        }
        Kind::Product { first, rest } => {
            collect(scope, first, above, found);
            for (op, factor) in rest {
                collect(scope, factor, above ^ (*op == ProductOp::Slash), found);
            }
        }
        Kind::Scripts { base, sup: Some(sup), .. } if is_negative(sup) => collect(scope, base, !above, found),
        _ => node.children().into_iter().for_each(|child| collect(scope, child, above, found)),
    }
}

fn is_negative(exponent: &Node) -> bool {
    matches!(&exponent.kind, Kind::Sum(terms) if matches!(terms.as_slice(), [t] if t.sign == Sign::Minus))
}
