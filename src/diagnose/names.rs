//! Declared symbols as they stand in a formula, and the other declared ones that may be confused with them.

use crate::latex;
use crate::latex::ast::{Kind, Node, Span};
use crate::semantics::{Entry, EntryKind, Scope, pattern_of, spelling};

use super::mutants::EditKind;

/// A declared symbol in a formula: `\dot{\varphi}^2` is `\varphi` with one dot and a power.
pub struct Name<'s> {
    /// The number of dots.
    pub dots: u8,
    /// The symbol without dots and power.
    pub bare: Node,
    /// Its declaration.
    pub entry: &'s Entry,
    sup: Option<Box<Node>>,
    span: Span,
}

impl<'s> Name<'s> {
    /// The symbol that a node is, if it is one; indices of sums are none.
    pub fn of(scope: &'s Scope, node: &Node) -> Option<Self> {
        if !matches!(
            node.kind,
            Kind::Symbol(_) | Kind::Styled(..) | Kind::Accent(..) | Kind::Dots(..) | Kind::Scripts { .. }
        ) {
            return None;
        }
        let (powerless, sup) = match &node.kind {
            Kind::Scripts { base, primes, sub, sup: Some(sup) } if scope.get(&pattern_of(scope, node)).is_none() => {
                let kind = match (primes, sub) {
                    (0, None) => base.kind.clone(),
                    _ => Kind::Scripts { base: base.clone(), primes: *primes, sub: sub.clone(), sup: None },
                };
                (Node::new(kind, node.span.clone()), Some(sup.clone()))
            }
            _ => (node.clone(), None),
        };
        let (dots, bare) = undotted(&powerless);
        let entry = scope.get(&pattern_of(scope, &bare))?;
        let is_index = matches!(entry.kind, EntryKind::Index(..) | EntryKind::Function);
        (!is_index).then(|| Name { dots, bare, entry, sup, span: node.span.clone() })
    }

    /// The symbol with its dots, without its power.
    pub fn without_power(&self) -> Node {
        let bare =
            Name { dots: self.dots, bare: self.bare.clone(), entry: self.entry, sup: None, span: self.span.clone() };
        bare.replaced(&self.bare, self.dots)
    }

    /// Another symbol in the place of this one, with so many dots and the same power.
    pub fn replaced(&self, other: &Node, dots: u8) -> Node {
        let mut node = placed(other, &self.span);
        if dots > 0 {
            let dotted = |b: Node| Node::new(Kind::Dots(dots, Box::new(b)), self.span.clone());
            node = match node.kind {
                Kind::Scripts { base, primes, sub, sup } => {
                    Node::new(Kind::Scripts { base: Box::new(dotted(*base)), primes, sub, sup }, node.span)
                }
                _ => dotted(node),
            };
        }
        let Some(power) = &self.sup else { return node };
        let kind = match node.kind {
            Kind::Scripts { base, primes, sub, sup: None } => {
                Kind::Scripts { base, primes, sub, sup: Some(power.clone()) }
            }
            _ => Kind::Scripts { base: Box::new(node), primes: 0, sub: None, sup: Some(power.clone()) },
        };
        Node::new(kind, self.span.clone())
    }
}

/// The dots over a symbol and the symbol without them.
fn undotted(node: &Node) -> (u8, Node) {
    match &node.kind {
        Kind::Dots(n, body) => (*n, (**body).clone()),
        Kind::Scripts { base, primes, sub, sup } => match &base.kind {
            Kind::Dots(n, body) => {
                let kind = Kind::Scripts { base: body.clone(), primes: *primes, sub: sub.clone(), sup: sup.clone() };
                (*n, Node::new(kind, node.span.clone()))
            }
            _ => (0, node.clone()),
        },
        _ => (0, node.clone()),
    }
}

/// The tree with every span that of the place where it is put.
pub fn placed(node: &Node, span: &Span) -> Node {
    let mut node = node.map_children(&mut |child| placed(child, span));
    node.span = span.clone();
    node
}

/// The parts of a symbol that are compared.
struct Parts {
    base: String,
    primes: u8,
    sub: String,
    /// The letter without font: \mathbf{\omega} and \omega look alike.
    letter: String,
}

fn parts(node: &Node) -> Parts {
    let letter = |n: &Node| match &n.kind {
        Kind::Styled(_, body) | Kind::Accent(_, body) => spelling(body),
        _ => spelling(n),
    };
    match &node.kind {
        Kind::Scripts { base, primes, sub, .. } => Parts {
            base: spelling(base),
            primes: *primes,
            sub: sub.as_ref().map(|s| spelling(s)).unwrap_or_default(),
            letter: letter(base),
        },
        _ => Parts { base: spelling(node), primes: 0, sub: String::new(), letter: letter(node) },
    }
}

/// The declared symbols that may be confused with one, with what would be changed; the likeliest of each kind first.
pub fn siblings(scope: &Scope, name: &Name, most: Option<usize>) -> Vec<(EditKind, Node)> {
    let own = parts(&name.bare);
    let mut found: Vec<(EditKind, bool, String, Node)> = Vec::new();
    for entry in scope.entries() {
        if entry.pattern == name.entry.pattern || matches!(entry.kind, EntryKind::Index(..) | EntryKind::Function) {
            continue;
        }
        let Some(node) = instance(scope, &entry.pattern, &name.bare) else { continue };
        let other = parts(&node);
        let same_role = role(entry) == role(name.entry) && entry.of_t == name.entry.of_t;
        let same_unit = entry.unit.is_some() && entry.unit == name.entry.unit;
        let kind = if own.base == other.base && own.primes == other.primes {
            EditKind::Index
        } else if own.base == other.base && own.sub == other.sub && own.primes.abs_diff(other.primes) == 1 {
            EditKind::Prime
        } else if alike(&own.letter, &other.letter)
            || same_role && (same_unit || own.sub == other.sub && !own.sub.is_empty())
        {
            EditKind::Symbol
        } else {
            continue;
        };
        found.push((kind, !same_role, entry.pattern.clone(), node));
    }
    found.sort_by(|a, b| (a.0, a.1, &a.2).cmp(&(b.0, b.1, &b.2)));
    let mut taken: Vec<(EditKind, Node)> = Vec::new();
    for (kind, _, _, node) in found {
        let so_far = taken.iter().filter(|(k, _)| *k == kind).count();
        if most.is_none_or(|most| so_far < most) {
            taken.push((kind, node));
        }
    }
    taken
}

/// What a symbol is used as.
fn role(entry: &Entry) -> (u8, Option<&str>) {
    match &entry.kind {
        EntryKind::Scalar | EntryKind::Same(_) => (0, None),
        EntryKind::Vector | EntryKind::Rate { .. } => (1, None),
        EntryKind::Matrix { .. } => (2, None),
        EntryKind::Component { basis, .. } => (3, Some(basis)),
        EntryKind::BasisVector { basis, .. } => (4, Some(basis)),
        EntryKind::Index(..) | EntryKind::Function => (5, None),
    }
}

/// Whether two symbols differ by letters that look alike, and by nothing else.
pub fn look_alike(a: &Node, b: &Node) -> bool {
    let (a, b) = (parts(a), parts(b));
    a.sub == b.sub && a.primes == b.primes && alike(&a.letter, &b.letter)
}

/// Letters that scans and readers confuse.
fn alike(a: &str, b: &str) -> bool {
    const GROUPS: [&[&str]; 17] = [
        &["\\varphi", "\\phi", "\\psi"],
        &["\\theta", "\\vartheta", "\\Theta", "0"],
        &["0", "o", "O"],
        &["\\alpha", "a"],
        &["\\beta", "B"],
        &["\\gamma", "\\Gamma"],
        &["\\epsilon", "\\varepsilon"],
        &["\\kappa", "k", "K"],
        &["\\lambda", "\\Lambda"],
        &["\\delta", "\\Delta"],
        &["\\omega", "\\Omega", "w"],
        &["\\eta", "n", "\\zeta", "\\xi"],
        &["m", "M"],
        &["v", "\\nu", "u"],
        &["I", "l", "1", "L"],
        &["\\rho", "p", "P"],
        &["r", "R"],
    ];
    a == b || GROUPS.iter().any(|g| g.contains(&a) && g.contains(&b))
}

/// A symbol of a family with the indices of another one: `\eta_#` with those of `\xi_i` is `\eta_i`.
fn instance(scope: &Scope, pattern: &str, like: &Node) -> Option<Node> {
    with_indices(pattern, &indices(scope, like))
}

/// A symbol of a family with these indices: `\eta_#` with `i` is `\eta_i`; `None` where their number differs.
pub fn with_indices(pattern: &str, letters: &[String]) -> Option<Node> {
    let mut letters = letters.iter();
    let mut text = String::new();
    for c in pattern.chars() {
        match c {
            '#' => {
                text.push_str(letters.next()?);
                text.push(' ');
            }
            c => text.push(c),
        }
    }
    letters.next().is_none().then(|| latex::parse(&text).ok()).flatten()
}

/// The index letters in the scripts of a symbol.
pub fn indices(scope: &Scope, node: &Node) -> Vec<String> {
    let mut letters = Vec::new();
    if let Kind::Scripts { sub, sup, .. } = &node.kind {
        for script in [sub, sup].into_iter().flatten() {
            collect(scope, script, &mut letters);
        }
    }
    letters
}

fn collect(scope: &Scope, node: &Node, letters: &mut Vec<String>) {
    match &node.kind {
        Kind::Symbol(s) if scope.index(s).is_some() => letters.push(s.clone()),
        _ => node.children().into_iter().for_each(|child| collect(scope, child, letters)),
    }
}
