//! Which symbols are declared where an equation stands.

use std::collections::{HashMap, HashSet};
use std::sync::Arc;

use crate::document::{Arguments, BasisDeclaration, Declarations, Problem, Spanned, SymbolDeclaration};
use crate::latex;
use crate::latex::ast::{Kind, Node};
use crate::trace;

use super::elaborate::MOST_ALIASES;
use super::name::{nearest, spelling, spelling_with};
use super::units::{self, Dimension};

/// What a declared symbol is.
#[derive(Clone, Debug, PartialEq)]
pub enum EntryKind {
    /// A number.
    Scalar,
    /// A vector of space.
    Vector,
    /// An array of numbers.
    Matrix {
        /// The number of rows.
        rows: usize,
        /// The number of columns.
        cols: usize,
    },
    /// An index with its first and last value.
    Index(i64, i64),
    /// A function that is applied to the group behind it.
    Function,
    /// Another notation of something.
    Same(Node),
    /// The component of a vector along an axis of a basis.
    Component {
        /// The vector.
        of: Node,
        /// The basis.
        basis: String,
        /// The axis: 0, 1, 2.
        axis: usize,
    },
    /// A vector of a basis.
    BasisVector {
        /// The basis.
        basis: String,
        /// The axis: 0, 1, 2.
        axis: usize,
    },
    /// The angular velocity of a basis.
    Rate {
        /// The basis.
        basis: String,
    },
}

/// A declared symbol, or a family of them with indices.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// The canonical spelling, with `#` for each index.
    pub pattern: String,
    /// What it is.
    pub kind: EntryKind,
    /// Whether it depends on time.
    pub of_t: bool,
    /// The range it is sampled from.
    pub range: Option<[f64; 2]>,
    /// Its unit.
    pub unit: Option<String>,
    /// The dimension of its unit.
    pub dimension: Option<Dimension>,
    /// Where it is declared, in bytes of the file: tells it from another symbol of the same spelling elsewhere.
    pub declared: usize,
    /// Whether it takes integers only.
    pub integer: bool,
    /// The distance between the values of an index.
    pub step: usize,
    /// The indices it has one value for each of that are not printed: the j of \\sum m r^2.
    pub hidden: Vec<String>,
    /// The indices that its name prints, in their order.
    pub letters: Vec<String>,
    /// The spellings of the arguments that may be printed behind it, in brackets.
    pub arguments: Vec<String>,
}

impl Entry {
    /// Whether it has a value of its own, rather than one that other symbols give it.
    pub fn is_free(&self) -> bool {
        matches!(self.kind, EntryKind::Scalar | EntryKind::Vector | EntryKind::Matrix { .. })
    }

    /// Whether it is an angle.
    pub fn is_angle(&self) -> bool {
        matches!(self.unit.as_deref(), Some("rad" | "deg"))
    }
}

/// A declared basis of space.
#[derive(Clone, Debug, PartialEq)]
pub struct Basis {
    /// Its name.
    pub name: String,
    /// The spelling of its axes, the subscripts that mean components.
    pub axes: [String; 3],
    /// The Euler angles it is turned by, where the notes have symbols for them.
    pub euler: Option<[Node; 3]>,
    /// The axes of the three turns.
    pub order: String,
    /// Whether it rotates against the inertial frame.
    pub rotating: bool,
    /// Whether a column of three numbers means components in this basis.
    pub columns: bool,
}

/// The declarations in force at some place of a document.
#[derive(Clone, Debug, Default)]
pub struct Scope {
    entries: HashMap<String, Arc<Entry>>,
    bases: Vec<Arc<Basis>>,
    /// Premises that hold throughout the section, in LaTeX with their place in the file.
    pub assume: Vec<Spanned<String>>,
    /// Whether vectors side by side are multiplied as quaternions.
    pub quaternions: bool,
    /// Whether the section is written in natural units, so that dimensions say nothing.
    pub natural_units: bool,
    /// The modulus of elliptic functions that are printed without one.
    pub modulus: Option<Node>,
    /// The triples of names that go round together in cyclic sums.
    pub cyclic: Vec<[Node; 3]>,
    /// The canonical variables of Poisson brackets: each momentum with its coordinate.
    pub canonical: Vec<(Node, Node)>,
}

impl Scope {
    /// All entries, in the order of their spelling.
    pub fn entries(&self) -> impl Iterator<Item = &Entry> {
        trace::all_names();
        let mut entries: Vec<&Entry> = self.entries.values().map(Arc::as_ref).collect();
        entries.sort_by(|a, b| a.pattern.cmp(&b.pattern));
        entries.into_iter()
    }

    /// The entry of a canonical spelling.
    pub fn get(&self, pattern: &str) -> Option<&Entry> {
        trace::name(pattern);
        self.entries.get(pattern).map(Arc::as_ref)
    }

    /// The bases, those declared last first.
    pub fn bases(&self) -> impl Iterator<Item = &Basis> {
        self.bases.iter().rev().map(Arc::as_ref)
    }

    /// A basis by its name.
    pub fn basis(&self, name: &str) -> Option<&Basis> {
        self.bases.iter().rev().find(|b| b.name == name).map(Arc::as_ref)
    }

    /// The basis in which columns are components.
    pub fn column_basis(&self) -> Option<&Basis> {
        self.bases.iter().rev().find(|b| b.columns).map(Arc::as_ref)
    }

    /// The basis and axis that a subscript names. Bases declared later come first.
    pub fn axis(&self, spelling: &str) -> Option<(&Basis, usize)> {
        self.bases.iter().rev().find_map(|b| Some((b.as_ref(), b.axes.iter().position(|a| a == spelling)?)))
    }

    /// The first and last value of an index.
    pub fn index(&self, name: &str) -> Option<(i64, i64)> {
        match self.get(name)?.kind {
            EntryKind::Index(from, to) => Some((from, to)),
            _ => None,
        }
    }

    /// The declared name nearest to one that is not declared.
    pub fn suggestion(&self, name: &str) -> Option<&str> {
        trace::all_names();
        let mut names: Vec<&str> = self.entries.keys().map(String::as_str).collect();
        names.sort_unstable();
        nearest(name, names.into_iter())
    }

    /// Takes in a block of declarations; what cannot be taken in is returned with its place.
    pub fn declare(&mut self, block: &Declarations) -> Vec<Problem> {
        let mut problems = Vec::new();
        for basis in &block.bases {
            self.declare_basis(basis, &mut problems);
        }
        for symbol in &block.symbols {
            self.declare_symbol(symbol, &mut problems);
        }
        self.assume.extend(block.assume.iter().cloned());
        self.natural_units = block.natural_units.unwrap_or(self.natural_units);
        if let Some(modulus) = &block.modulus {
            self.modulus = parse_name(modulus, &mut problems);
        }
        if !block.cyclic.is_empty() {
            let mut read = |names: &[Spanned<String>; 3]| -> Option<[Node; 3]> {
                let nodes: Vec<Node> = names.iter().filter_map(|n| parse_name(n, &mut problems)).collect();
                nodes.try_into().ok()
            };
            self.cyclic = block.cyclic.iter().filter_map(&mut read).collect();
        }
        if !block.canonical.is_empty() {
            let pairs = block.canonical.iter();
            let read = pairs.filter_map(|(p, q)| Some((parse_name(p, &mut problems)?, parse_name(q, &mut problems)?)));
            self.canonical = read.collect();
        }
        problems
    }

    fn declare_basis(&mut self, d: &BasisDeclaration, problems: &mut Vec<Problem>) {
        let read = |texts: &[Spanned<String>; 3], problems: &mut Vec<Problem>| -> Option<[Node; 3]> {
            let nodes: Vec<Node> = texts.iter().filter_map(|t| parse_name(t, problems)).collect();
            nodes.try_into().ok()
        };
        let Some(vectors) = read(&d.vectors, problems) else { return };
        let name = d.name.value.clone();
        let axes = match &d.axes {
            Some(axes) => match read(axes, problems) {
                Some(nodes) => nodes.map(|n| spelling(&n)),
                None => return,
            },
            None => vectors.clone().map(|v| subscript(&v).unwrap_or_default()),
        };
        let euler = d.euler.as_ref().and_then(|e| read(e, problems));
        for (axis, vector) in vectors.iter().enumerate() {
            let kind = EntryKind::BasisVector { basis: name.clone(), axis };
            self.insert(spelling(vector), Entry { pattern: spelling(vector), kind, ..Entry::plain() });
        }
        if let Some(rate) = d.rate.as_ref().and_then(|r| parse_name(r, problems)) {
            let kind = EntryKind::Rate { basis: name.clone() };
            self.insert(spelling(&rate), Entry { pattern: spelling(&rate), kind, ..Entry::plain() });
        }
        let rotating = d.rotating || d.rate.is_some() || euler.is_some();
        let order = d.order.as_ref().map_or_else(|| "zxz".to_owned(), |o| o.value.clone());
        self.bases.push(Arc::new(Basis { name, axes, euler, order, rotating, columns: d.columns }));
    }

    /// Takes in one declaration.
    pub fn declare_symbol(&mut self, d: &SymbolDeclaration, problems: &mut Vec<Problem>) {
        let each: Vec<String> =
            d.each.iter().filter_map(|i| parse_name(i, problems)).map(|node| spelling(&node)).collect();
        let mut arguments: Vec<Node> = match &d.function {
            Some(Arguments::Names(names)) => names.iter().filter_map(|n| parse_name(n, problems)).collect(),
            _ => Vec::new(),
        };
        // What it is a function of, by no formula, may be printed behind it as well.
        let of = d.of.as_ref().and_then(|of| parse_name(of, problems)).map_or_else(Vec::new, |of| match of.kind {
            Kind::List(items) => items,
            _ => vec![of],
        });
        let of_t = of.iter().any(|n| spelling(n) == "t");
        if arguments.is_empty() && of.iter().any(|n| spelling(n) != "t") {
            arguments = of;
        }
        let arguments: Vec<String> = arguments.iter().map(spelling).collect();
        let dimension = d.unit.as_ref().and_then(|unit| parse_unit(unit, problems));
        for (position, name) in d.names.iter().enumerate() {
            let Some(node) = parse_name(name, problems) else { continue };
            let pattern = pattern(&node, &|letter| each.iter().any(|e| e == letter));
            let printed = |letter: &String| self::pattern(&node, &|l| l == letter).contains('#');
            let letters = each.iter().filter(|letter| printed(letter)).cloned().collect();
            let hidden = each.iter().filter(|letter| !printed(letter)).cloned().collect();
            let Some(kind) = entry_kind(d, position, problems) else { continue };
            let entry = Entry {
                pattern: pattern.clone(),
                kind,
                of_t,
                range: d.range,
                unit: d.unit.as_ref().map(|u| u.value.clone()),
                dimension,
                declared: name.span.start,
                integer: d.integer,
                step: d.step.unwrap_or(1).max(1),
                hidden,
                letters,
                arguments: arguments.clone(),
            };
            self.insert(pattern.clone(), entry);
            if self.is_circular(&pattern) {
                let message = format!("{} is another notation of itself", name.value);
                problems.push(Problem::error("kenzan::name", message, name.span.clone()));
                self.entries.remove(&pattern);
            }
        }
    }

    /// The declared names in an expression; the letters within a name are none.
    fn collect_names(&self, node: &Node, found: &mut HashSet<String>) {
        let pattern = pattern_of(self, node);
        if self.get(&pattern).is_some() {
            found.insert(pattern);
            return;
        }
        match &node.kind {
            // Names that are not declared yet.
            Kind::Accent(..) | Kind::Styled(..) => {}
            Kind::Scripts { base, sub: Some(sub), .. } => {
                if matches!(base.kind, Kind::Group { .. }) || self.axis(&spelling(sub)).is_some() {
                    self.collect_names(base, found);
                }
            }
            // dM may be a name of its own, that says nothing of M.
            Kind::Juxt(factors) => {
                let mut k = 0;
                while let Some(first) = factors.get(k) {
                    let pair = factors.get(k + 1).map(|second| format!("{}{}", spelling(first), spelling(second)));
                    match pair.filter(|pair| self.get(pair).is_some()) {
                        Some(pair) => {
                            found.insert(pair);
                            k += 2;
                        }
                        None => {
                            self.collect_names(first, found);
                            k += 1;
                        }
                    }
                }
            }
            _ => node.children().into_iter().for_each(|child| self.collect_names(child, found)),
        }
    }

    /// Whether what a name stands for leads back to it.
    fn is_circular(&self, pattern: &str) -> bool {
        let mut found = HashSet::new();
        let mut queue = vec![pattern.to_owned()];
        while let Some(name) = queue.pop() {
            let Some(entry) = self.get(&name) else { continue };
            let (EntryKind::Same(node) | EntryKind::Component { of: node, .. }) = &entry.kind else { continue };
            let mut names = HashSet::new();
            self.collect_names(node, &mut names);
            queue.extend(names.into_iter().filter(|name| found.insert(name.clone())));
            // What goes on for so long is refused where it is used.
            if found.len() > MOST_ALIASES {
                break;
            }
        }
        found.contains(pattern)
    }

    fn insert(&mut self, pattern: String, entry: Entry) {
        self.quaternions |= super::quaternion::is_operator(&entry);
        self.entries.insert(pattern, Arc::new(entry));
    }

    /// A copy with an equation's own declarations added.
    pub fn with_local(&self, symbols: &[SymbolDeclaration], problems: &mut Vec<Problem>) -> Scope {
        let mut scope = self.clone();
        for d in symbols {
            scope.declare_symbol(d, problems);
        }
        scope
    }
}

impl Entry {
    /// A constant scalar of which nothing is known.
    fn plain() -> Entry {
        Entry {
            pattern: String::new(),
            kind: EntryKind::Scalar,
            of_t: false,
            range: None,
            unit: None,
            dimension: None,
            declared: 0,
            integer: false,
            step: 1,
            hidden: Vec::new(),
            letters: Vec::new(),
            arguments: Vec::new(),
        }
    }
}

/// The kind that a declaration gives to the name at a position of its list.
fn entry_kind(d: &SymbolDeclaration, position: usize, problems: &mut Vec<Problem>) -> Option<EntryKind> {
    Some(if let Some([from, to]) = d.index {
        EntryKind::Index(from, to)
    } else if let Some(same) = &d.same {
        EntryKind::Same(parse_name(same, problems)?)
    } else if let Some(of) = &d.component_of {
        let basis = d.basis.as_ref().map_or_else(|| "body".to_owned(), |b| b.value.clone());
        EntryKind::Component { of: parse_name(of, problems)?, basis, axis: position % 3 }
    } else if d.vector.is_some() {
        EntryKind::Vector
    } else if let Some([rows, cols]) = d.matrix {
        EntryKind::Matrix { rows, cols }
    } else if d.function.is_some() {
        EntryKind::Function
    } else {
        EntryKind::Scalar
    })
}

/// The spelling of a name with `#` for the letters that are indices. Only scripts are looked into: an `i` at the base
/// is a letter like any other.
pub fn pattern(node: &Node, is_index: &dyn Fn(&str) -> bool) -> String {
    match &node.kind {
        Kind::Scripts { base, primes, sub, sup } => {
            let leaf = |n: &Node| match &n.kind {
                Kind::Symbol(s) if is_index(s) => Some("#".to_owned()),
                _ => None,
            };
            let mut text = pattern(base, is_index);
            text.push_str(&"'".repeat(usize::from(*primes)));
            if let Some(sub) = sub {
                text.push_str(&format!("_{{{}}}", spelling_with(sub, &leaf)));
            }
            if let Some(sup) = sup {
                text.push_str(&format!("^{{{}}}", spelling_with(sup, &leaf)));
            }
            text
        }
        _ => spelling(node),
    }
}

/// Reads a name written in a declaration.
fn parse_name(text: &Spanned<String>, problems: &mut Vec<Problem>) -> Option<Node> {
    match latex::parse(&text.value) {
        Ok(node) => Some(node),
        Err(error) => {
            let message = format!("this name cannot be read: {}", error.message);
            let problem = Problem::error("kenzan::name", message, text.place(error.span));
            let problem = match error.help {
                Some(help) => problem.help(help),
                None => problem,
            };
            problems.push(problem);
            None
        }
    }
}

/// Reads the unit of a declaration.
fn parse_unit(unit: &Spanned<String>, problems: &mut Vec<Problem>) -> Option<Dimension> {
    match units::parse(&unit.value) {
        Ok(dimension) => Some(dimension),
        Err(error) => {
            let problem = Problem::error("kenzan::unit", error.message, unit.place(error.span));
            problems.push(match error.help {
                Some(help) => problem.help(help),
                None => problem,
            });
            None
        }
    }
}

/// The spelling of a name's subscript.
fn subscript(node: &Node) -> Option<String> {
    match &node.kind {
        Kind::Scripts { sub: Some(sub), .. } => Some(spelling(sub)),
        _ => None,
    }
}

/// The pattern of a name as it is used where a scope holds.
pub fn pattern_of(scope: &Scope, node: &Node) -> String {
    pattern(node, &|letter| scope.index(letter).is_some())
}
