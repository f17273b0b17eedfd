//! What the formulas of a document show of their symbols by the way they are written: dots, sums, brackets, sides.

use std::collections::{BTreeMap, BTreeSet};

use crate::latex::ast::{BigOp, Delim, Font, Kind, MatrixEnv, Node};
use crate::semantics::spelling;

/// What was seen. Names are in their canonical spelling.
#[derive(Clone, Debug, Default)]
pub struct Evidence {
    /// Names with a dot, under d/dt, or before `(t)`.
    pub moves: BTreeSet<String>,
    /// The time itself occurs.
    pub time: bool,
    /// Letters that sums run through, with the last value where it is printed.
    pub runs: BTreeMap<String, Option<i64>>,
    /// The subscripts that each base is printed with.
    pub scripts: BTreeMap<String, BTreeSet<String>>,
    /// Names before a bracket that holds other names alone, `f(x)`, with what it holds.
    pub functions: BTreeMap<String, Vec<String>>,
    /// Names that are given as functions: `f(x)` alone on a side, the other side of which speaks of x.
    pub given: BTreeSet<String>,
    /// Names that stand beside a matrix in a relation, with its rows and columns.
    pub arrays: BTreeMap<String, (usize, usize)>,
    /// The sizes of the square matrices and columns that are printed.
    pub sizes: BTreeSet<usize>,
    /// Names of which derivatives are taken by something else than the time, with what they are taken by.
    pub derived: BTreeMap<String, BTreeSet<String>>,
    /// Names in integrands, with the variables that they are integrated over.
    pub integrated: BTreeMap<String, BTreeSet<String>>,
    /// Names with a dot or under d/dt: what is seen to move itself, and not said to equal what does.
    pub rates: BTreeSet<String>,
    /// Names directly behind sin, cos, tan.
    pub angles: BTreeSet<String>,
    /// Sides beside a name: what it may be defined as.
    pub equals: Vec<(String, Node)>,
}

impl Evidence {
    /// Looks through a formula; the depth is bounded by the parser's.
    pub fn look(&mut self, node: &Node) {
        match &node.kind {
            Kind::Symbol(s) if s == "t" => self.time = true,
            Kind::Dots(_, body) => {
                self.moves.insert(spelling(body));
                self.rates.insert(spelling(body));
                self.time = true;
            }
            Kind::Scripts { base, sub, .. } => self.scripts(base, sub.as_deref()),
            Kind::Frac(above, below) => self.fraction(above, below),
            Kind::Juxt(factors) => self.product(factors),
            Kind::Chain { .. } => self.relation(node),
            Kind::Matrix { env: MatrixEnv::Matrix | MatrixEnv::Determinant, rows } => {
                self.sizes.insert(rows.len());
            }
            _ => {}
        }
        node.children().into_iter().for_each(|child| self.look(child));
    }

    fn scripts(&mut self, base: &Node, sub: Option<&Node>) {
        let Some(sub) = sub else { return };
        if let Kind::Dots(_, body) = &base.kind {
            self.moves.insert(format!("{}_{{{}}}", spelling(body), spelling(sub)));
        }
        match &base.kind {
            Kind::BigOp(BigOp::Sum | BigOp::Product) => self.runs(sub),
            _ => {
                self.scripts.entry(spelling(base)).or_default().insert(spelling(sub));
            }
        }
    }

    /// The letters under a sum: `i`, `i=1`, `i,j`, `i<j`, `i \neq j`.
    fn runs(&mut self, sub: &Node) {
        let letters: Vec<&Node> = match &sub.kind {
            Kind::Chain { first: Some(first), links } => {
                std::iter::once(first.as_ref()).chain(links.iter().map(|l| &l.rhs)).collect()
            }
            Kind::List(items) => items.iter().collect(),
            _ => vec![sub],
        };
        for letter in letters {
            if let Kind::Symbol(s) = &letter.kind {
                self.runs.entry(s.clone()).or_default();
            }
        }
    }

    /// `\frac{d x}{d t}`, `\frac{d}{dt}`.
    fn fraction(&mut self, above: &Node, below: &Node) {
        let variables = differentials(below);
        self.time |= variables.iter().any(|v| v == "t");
        if let Kind::Juxt(factors) = &above.kind
            && let [d, operand @ ..] = factors.as_slice()
            && is_d(without_power(d))
        {
            operand.iter().filter(|n| is_name(n)).for_each(|n| self.derivative(spelling(n), &variables));
        }
    }

    fn derivative(&mut self, name: String, variables: &[String]) {
        for variable in variables {
            if variable == "t" {
                self.moves.insert(name.clone());
                self.rates.insert(name.clone());
            } else {
                self.derived.entry(name.clone()).or_default().insert(variable.clone());
            }
        }
    }

    fn product(&mut self, factors: &[Node]) {
        self.integral(factors);
        for pair in factors.windows(2) {
            let [head, next] = pair else { continue };
            let head = without_power(head);
            match (&head.kind, &next.kind) {
                (Kind::Function(f), _) if matches!(f.as_str(), "sin" | "cos" | "tan" | "cot") => {
                    let argument = match &next.kind {
                        Kind::Group { open: Delim::Paren, body, .. } => body,
                        _ => next,
                    };
                    self.angles.insert(spelling(argument));
                }
                (Kind::Frac(above, below), _) if is_d(without_power(above)) => {
                    let variables = differentials(below);
                    let mut operands = Vec::new();
                    match &next.kind {
                        Kind::Group { body, .. } => names(body, &mut |name| operands.push(name)),
                        _ => operands.push(spelling(next)),
                    }
                    let moving = |name: &String| !variables.iter().any(|v| v == "t") || !is_constant(name);
                    operands.into_iter().filter(moving).for_each(|name| self.derivative(name, &variables));
                }
                (_, Kind::Group { open: Delim::Paren, body, .. }) if is_name(head) => match arguments(body) {
                    Some(arguments) if arguments == ["t"] => {
                        self.moves.insert(spelling(head));
                    }
                    Some(arguments) => {
                        if arguments.iter().any(|a| a == "t") {
                            self.moves.insert(spelling(head));
                        }
                        self.functions.entry(spelling(head)).or_insert(arguments);
                    }
                    None => {}
                },
                _ => {}
            }
        }
    }

    /// `\int_a^b f\, dx`: what f is made of may depend on x; where x does not stand in f, it does.
    fn integral(&mut self, factors: &[Node]) {
        let is_sign = |n: &Node| match &n.kind {
            Kind::Scripts { base, sub: Some(_), sup: Some(_), .. } => matches!(base.kind, Kind::BigOp(BigOp::Integral)),
            _ => false,
        };
        let Some(sign) = factors.iter().position(is_sign) else { return };
        let behind = &factors[sign + 1..];
        let differential = behind.windows(2).rposition(|pair| is_d(&pair[0]) && is_name(&pair[1]));
        let Some(at) = differential else { return };
        let variable = spelling(&behind[at + 1]);
        let mut inner = Vec::new();
        behind[..at].iter().for_each(|factor| names(factor, &mut |name| inner.push(name)));
        let hidden = !inner.contains(&variable);
        for name in inner.into_iter().filter(|n| *n != variable && !is_constant(n)) {
            self.integrated.entry(name.clone()).or_default().insert(variable.clone());
            match variable.as_str() {
                _ if !hidden => {}
                "t" => drop(self.moves.insert(name)),
                _ => drop(self.derived.entry(name).or_default().insert(variable.clone())),
            }
        }
    }

    fn relation(&mut self, node: &Node) {
        let sides = node.children();
        self.given_functions(&sides);
        for (k, side) in sides.iter().enumerate().filter(|(_, side)| is_name(side)) {
            for other in sides.iter().enumerate().filter(|(j, _)| *j != k).map(|(_, other)| other) {
                if let Some(shape) = shape(other) {
                    self.arrays.insert(spelling(side), shape);
                } else {
                    self.equals.push((spelling(side), (*other).clone()));
                }
            }
        }
    }

    fn given_functions(&mut self, sides: &[&Node]) {
        for (k, side) in sides.iter().enumerate() {
            let Kind::Juxt(factors) = &side.kind else { continue };
            let [head, Node { kind: Kind::Group { open: Delim::Paren, body, .. }, .. }] = factors.as_slice() else {
                continue;
            };
            let Some(arguments) = arguments(body).filter(|_| is_name(head)) else { continue };
            let mut others = Vec::new();
            let rest = sides.iter().enumerate().filter(|(j, _)| *j != k);
            rest.for_each(|(_, other)| names(other, &mut |name| others.push(name)));
            if arguments.iter().all(|a| others.contains(a)) {
                self.given.insert(spelling(head));
            }
        }
    }

    /// What depends on time because it is said to equal something that does, added to what is seen to move.
    pub fn spread_motion(&mut self) {
        loop {
            let moves = &self.moves;
            let depends = |node: &Node| {
                let mut found = false;
                names(node, &mut |name| found |= name == "t" || moves.contains(&name));
                found
            };
            let more: Vec<String> = self
                .equals
                .iter()
                .filter(|(name, side)| name != "t" && !is_constant(name) && !moves.contains(name) && depends(side))
                .map(|(name, _)| name.clone())
                .collect();
            if more.is_empty() {
                return;
            }
            self.moves.extend(more);
        }
    }
}

/// The rows and columns of a printed matrix, perhaps with a factor before it.
fn shape(node: &Node) -> Option<(usize, usize)> {
    match &node.kind {
        Kind::Matrix { env: MatrixEnv::Matrix, rows } => Some((rows.len(), rows.first()?.len())),
        Kind::Group { body, .. } => match &body.kind {
            Kind::Matrix { env: MatrixEnv::Array | MatrixEnv::Matrix, rows } => Some((rows.len(), rows.first()?.len())),
            _ => None,
        },
        Kind::Juxt(factors) => match factors.as_slice() {
            [factor, matrix] if shape(factor).is_none() => shape(matrix),
            _ => None,
        },
        _ => None,
    }
}

/// The names in brackets that hold nothing else.
fn arguments(body: &Node) -> Option<Vec<String>> {
    match &body.kind {
        Kind::List(items) => items.iter().map(|n| is_name(n).then(|| spelling(n))).collect(),
        _ => is_name(body).then(|| vec![spelling(body)]),
    }
}

/// Whether a node is a name: a letter, perhaps styled, with an accent, primes or a subscript.
pub fn is_name(node: &Node) -> bool {
    match &node.kind {
        Kind::Symbol(s) => !matches!(s.as_str(), "\\pi" | "\\infty" | "\\partial" | "\\nabla"),
        Kind::Styled(_, body) => matches!(body.kind, Kind::Symbol(_)),
        Kind::Accent(_, body) => is_name(body),
        Kind::Scripts { base, sup: None, .. } => is_name(base),
        _ => false,
    }
}

/// The names in a formula, outermost first: of `\dot{x}_1` it is `x_1`.
pub fn names(node: &Node, found: &mut dyn FnMut(String)) {
    match &node.kind {
        Kind::Scripts { base, primes, sub: Some(sub), sup } => {
            if let Kind::Dots(_, body) = &base.kind {
                let whole = Kind::Scripts { base: body.clone(), primes: *primes, sub: Some(sub.clone()), sup: None };
                found(spelling(&Node::new(whole, node.span.clone())));
            } else {
                let whole = Kind::Scripts { base: base.clone(), primes: *primes, sub: Some(sub.clone()), sup: None };
                let name = spelling(&Node::new(whole, node.span.clone()));
                if name.is_empty() { names(base, found) } else { found(name) }
            }
            sup.iter().for_each(|sup| names(sup, found));
        }
        Kind::Scripts { base, sup: Some(sup), primes, sub: None } => {
            let bare = Kind::Scripts { base: base.clone(), primes: *primes, sub: None, sup: None };
            if *primes > 0 {
                names(&Node::new(bare, node.span.clone()), found)
            } else {
                names(base, found)
            }
            names(sup, found);
        }
        _ if is_name(node) => found(spelling(node)),
        _ => node.children().into_iter().for_each(|child| names(child, found)),
    }
}

fn is_d(node: &Node) -> bool {
    match &node.kind {
        Kind::Symbol(s) => s == "d" || s == "\\partial",
        Kind::Styled(Font::Roman, body) => is_d(body),
        _ => false,
    }
}

/// The variables of `dx`, `dx^2`, `\partial x \partial y`.
fn differentials(below: &Node) -> Vec<String> {
    let Kind::Juxt(factors) = &below.kind else { return Vec::new() };
    let pairs = factors.chunks(2).filter_map(|pair| match pair {
        [d, variable] if is_d(d) => Some(spelling(without_power(variable))),
        _ => None,
    });
    pairs.collect()
}

/// Letters that notes use for what does not change in time: masses, capacities, rates; and whatever has the index 0.
pub fn is_constant(name: &str) -> bool {
    const LETTERS: [&str; 22] = [
        "m",
        "M",
        "k",
        "R",
        "C",
        "L",
        "g",
        "G",
        "c",
        "T",
        "A",
        "N",
        "l",
        "\\ell",
        "\\omega",
        "\\gamma",
        "\\tau",
        "\\lambda",
        "\\mu",
        "\\varepsilon",
        "\\epsilon",
        "\\rho",
    ];
    let base = name.split('_').next().unwrap_or(name);
    LETTERS.contains(&base) || name.ends_with("_{0}")
}

fn without_power(node: &Node) -> &Node {
    match &node.kind {
        Kind::Scripts { base, primes: 0, sub: None, .. } => base,
        _ => node,
    }
}
