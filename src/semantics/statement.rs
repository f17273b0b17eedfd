//! From a parsed equation to its links: what is said to equal what.

use crate::latex::ast::{Delim, Kind, Link, MatrixEnv, Node, Rel, Sign, Term};
use crate::latex::to_latex;

use super::error::{Error, Result};
use super::geometric::is_geometric;
use super::notes::at_braces;
use super::ratio;
use super::scope::Scope;

/// One side of a link.
#[derive(Clone, Debug, PartialEq)]
pub enum Side {
    /// An expression.
    Node(Node),
    /// The word `const.`
    Constant,
}

/// What one relation says: the link of a chain before it is understood.
#[derive(Clone, Debug, PartialEq)]
pub struct Clause {
    /// The left side.
    pub lhs: Node,
    /// The relation.
    pub rel: Rel,
    /// The right side.
    pub rhs: Side,
    /// The statement of the equation it belongs to, counted from 1: rows and list items that begin anew.
    pub part: usize,
    /// Whether the left side is the last side of the equation before.
    pub continued: bool,
    /// The conditions that stand beside it, as in a row of cases.
    pub when: Vec<Clause>,
}

impl Clause {
    /// The link's LaTeX.
    pub fn latex(&self) -> String {
        let rhs = match &self.rhs {
            Side::Node(n) => to_latex(n),
            Side::Constant => "\\text{const.}".to_owned(),
        };
        let when: Vec<String> = self.when.iter().map(Clause::latex).collect();
        let when = if when.is_empty() { String::new() } else { format!(" \\quad ({})", when.join(", ")) };
        format!("{} {} {rhs}{when}", to_latex(&self.lhs), relation_latex(self.rel))
    }
}

/// An equation's clauses, with what a following equation may continue.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Statement {
    /// The clauses in order.
    pub clauses: Vec<Clause>,
    /// The formulas that no relation stands beside: nothing is said about them.
    pub bare: Vec<Node>,
    /// The last side, which a following equation that begins with `=` continues.
    pub last: Option<Node>,
    /// The first side of the chain that the last side belongs to.
    pub head: Option<Node>,
}

/// Takes an equation apart. `previous` is the statement before, for an equation that begins with a relation.
pub fn statement(root: &Node, previous: Option<&Statement>) -> Result<Statement> {
    let mut builder = Builder { out: Statement::default(), part: 0, continued: false };
    if let Some(previous) = previous {
        builder.out.last = previous.last.clone();
        builder.out.head = previous.head.clone();
        builder.continued = true;
    }
    builder.add(root)?;
    builder.braces(root);
    Ok(builder.out)
}

struct Builder {
    out: Statement,
    part: usize,
    /// Whether the side at hand stems from the equation before.
    continued: bool,
}

impl Builder {
    fn add(&mut self, node: &Node) -> Result<()> {
        if let (side, Some(cases @ Node { kind: Kind::Matrix { .. }, .. })) = without_aside(node) {
            self.begin(&side);
            return self.aside(cases);
        }
        match &node.kind {
            Kind::Rows(rows) => rows.iter().try_for_each(|row| self.add(row)),
            Kind::List(items) => items.iter().enumerate().try_for_each(|(k, item)| {
                self.add(item)?;
                match ratio::shared_constant(&items[k..]) {
                    Some(link) => self.link(link),
                    None => Ok(()),
                }
            }),
            Kind::Marked(_, body) => self.add(body),
            Kind::Annotated { body, .. } if holds_relation(body) => self.add(body),
            Kind::Matrix { env: MatrixEnv::Cases | MatrixEnv::Array, rows }
                if rows.iter().flatten().any(holds_relation) =>
            {
                self.rows(rows)
            }
            Kind::Group { open: Delim::None | Delim::Brace, body, .. } if holds_relation(body) => self.add(body),
            Kind::Group { open: Delim::Paren, body, .. } if holds_relation(body) => self.aside(body),
            Kind::Juxt(factors) if factors.iter().any(holds_relation) => {
                factors.iter().filter(|f| holds_relation(f)).try_for_each(|f| self.add(f))
            }
            Kind::Chain { first, links } => self.chain(first.as_deref(), links, node),
            Kind::Text(_) | Kind::Empty => Ok(()),
            _ => {
                self.begin(node);
                self.out.bare.push(node.clone());
                Ok(())
            }
        }
    }

    /// A row of an array: the cells behind the first continue it, or say when it is so.
    fn row(&mut self, cells: &[Node]) -> Result<()> {
        let before = self.out.clauses.len();
        let mut open = None;
        for (k, cell) in cells.iter().enumerate() {
            if let Some(link) = open.take() {
                self.link(&Link { rhs: cell.clone(), ..link })?;
            } else if let (1.., Some(condition)) = (k, condition(cell)) {
                let conditions = statement(condition, None)?.clauses;
                self.out.clauses[before..].iter_mut().for_each(|clause| clause.when.extend(conditions.clone()));
            } else {
                self.add(cell)?;
            }
            open = open_relation(cell);
        }
        Ok(())
    }

    /// The rows of an array: statements of their own; or cases of one that stands before them, `f \begin{cases} > 0 ...`.
    fn rows(&mut self, rows: &[Vec<Node>]) -> Result<()> {
        let (last, head) = (self.out.last.clone(), self.out.head.clone());
        let cases = last.is_some() && rows.iter().all(|row| begins(row));
        for row in rows {
            if cases {
                (self.out.last, self.out.head) = (last.clone(), head.clone());
            }
            self.row(row)?;
        }
        Ok(())
    }

    /// What stands at braces is said of what they span.
    fn braces(&mut self, root: &Node) {
        for (lhs, link) in at_braces(root) {
            let rhs = if is_constant(&link.rhs) { Side::Constant } else { Side::Node(link.rhs) };
            let (part, continued, when) = (self.part, false, Vec::new());
            self.out.clauses.push(Clause { lhs, rel: link.rel, rhs, part, continued, when });
        }
    }

    /// What is said in brackets: a statement of its own, or a last link, `f (= g)`. What follows does not continue it.
    fn aside(&mut self, body: &Node) -> Result<()> {
        let (last, head) = (self.out.last.clone(), self.out.head.clone());
        self.add(body)?;
        self.out.last = last.or(self.out.last.take());
        self.out.head = head.or(self.out.head.take());
        Ok(())
    }

    fn begin(&mut self, node: &Node) {
        self.part += 1;
        self.continued = false;
        self.out.last = Some(node.clone());
        self.out.head = Some(node.clone());
    }

    fn chain(&mut self, first: Option<&Node>, links: &[Link], node: &Node) -> Result<()> {
        let folded = ratio::folded(first, links);
        let (first, links) = folded.as_ref().map_or((first, links), |(f, l)| (f.as_ref(), l.as_slice()));
        match first {
            Some(first) if holds_relation(first) => self.add(first)?,
            Some(first) if !is_words(first) => self.begin(first),
            _ if self.out.last.is_none() => {
                return Err(Error::unsupported("a relation with nothing before it", &node.span)
                    .with_help("only the equation directly before can be continued"));
            }
            _ if self.part == 0 => self.part = 1,
            _ => {}
        }
        for (k, link) in links.iter().enumerate() {
            let statements = k == 0 && first.is_some_and(holds_relation);
            if separates(links, k) || statements && matches!(link.rel, Rel::Implies | Rel::Iff | Rel::ImpliedBy) {
                self.add(&link.rhs)?;
                continue;
            }
            if link.rel == Rel::Ratio && holds_words(&link.rhs) && !is_constant(&link.rhs) {
                // What a symbol means, behind a colon.
                continue;
            }
            if matches!(link.rhs.kind, Kind::Empty) || is_words(&link.rhs) && !is_constant(&link.rhs) {
                continue;
            }
            let (side, aside) = without_aside(&link.rhs);
            self.link(&Link { rhs: side, ..link.clone() })?;
            if let Some(body) = aside {
                self.aside(body)?;
            }
        }
        Ok(())
    }

    fn link(&mut self, link: &Link) -> Result<()> {
        let Some(mut lhs) = self.out.last.clone() else { return Ok(()) };
        // A row that the next one continues.
        self.out.bare.retain(|bare| bare.span != lhs.span);
        let mut constant = is_constant(&link.rhs);
        if let Some(difference) = ratio::without_constant(&lhs, &link.rhs) {
            (lhs, constant) = (difference, true);
        }
        let rhs = if constant { Side::Constant } else { Side::Node(link.rhs.clone()) };
        self.out.clauses.push(Clause {
            lhs,
            rel: link.rel,
            rhs,
            part: self.part,
            continued: self.continued,
            when: Vec::new(),
        });
        if !constant {
            self.out.last = Some(link.rhs.clone());
            self.continued = false;
        }
        Ok(())
    }
}

/// The condition that a cell behind others states, in brackets or not; none where it continues them.
fn condition(cell: &Node) -> Option<&Node> {
    match &cell.kind {
        Kind::Group { open: Delim::Paren, body, .. } => condition(body),
        _ => (holds_relation(cell) && !begins_with_relation(cell)).then_some(cell),
    }
}

/// The relation that a cell ends with: its right side is the next cell.
fn open_relation(cell: &Node) -> Option<Link> {
    match &cell.kind {
        Kind::Chain { links, .. } => links.last().filter(|link| matches!(link.rhs.kind, Kind::Empty)).cloned(),
        _ => None,
    }
}

/// Whether an equation continues the one before it.
pub fn begins_with_relation(node: &Node) -> bool {
    match &node.kind {
        Kind::Chain { first, .. } => first.as_deref().is_none_or(is_words),
        Kind::Rows(nodes) | Kind::List(nodes) => nodes.first().is_some_and(begins_with_relation),
        Kind::Juxt(nodes) => nodes.iter().find(|n| !is_words(n)).is_some_and(begins_with_relation),
        Kind::Marked(_, body) | Kind::Annotated { body, .. } => begins_with_relation(body),
        Kind::Group { open: Delim::None, body, .. } => begins_with_relation(body),
        _ => false,
    }
}

/// Collects the patterns of the declared symbols that a formula mentions; the letters within a name are none.
pub fn mentions(scope: &Scope, node: &Node, found: &mut std::collections::HashSet<String>) {
    let pattern = super::scope::pattern_of(scope, node);
    if scope.get(&pattern).is_some() {
        found.insert(pattern);
        return;
    }
    // In `I_1^2` stands `I_1`.
    if let Kind::Scripts { base, primes, sub: Some(sub), sup: Some(_) } = &node.kind {
        let kind = Kind::Scripts { base: base.clone(), primes: *primes, sub: Some(sub.clone()), sup: None };
        mentions(scope, &Node::new(kind, node.span.clone()), found);
    }
    for child in node.children() {
        mentions(scope, child, found);
    }
}

/// Whether a link of a chain does not relate its sides but the statements before and behind it. An arrow does where
/// both are statements; where one of them is not, it leads to a limit or an image.
fn separates(links: &[Link], k: usize) -> bool {
    let states = |links: &[Link]| links.iter().any(|l| compares(l.rel));
    let (before, behind) = (states(&links[..k]), states(&links[k + 1..]));
    match links[k].rel {
        Rel::Implies | Rel::Iff | Rel::ImpliedBy => before || behind,
        Rel::To => before && behind,
        _ => false,
    }
}

fn compares(rel: Rel) -> bool {
    matches!(rel, Rel::Eq | Rel::Equiv | Rel::Lt | Rel::Gt | Rel::Le | Rel::Ge) || is_geometric(rel)
}

/// Whether a node is or holds a relation, not counting those within ordinary brackets.
pub(super) fn holds_relation(node: &Node) -> bool {
    match &node.kind {
        Kind::Chain { .. } => true,
        Kind::Rows(nodes) | Kind::List(nodes) | Kind::Juxt(nodes) => nodes.iter().any(holds_relation),
        Kind::Marked(_, body) | Kind::Annotated { body, .. } => holds_relation(body),
        Kind::Group { open: Delim::None | Delim::Brace, body, .. } => holds_relation(body),
        Kind::Matrix { env: MatrixEnv::Cases | MatrixEnv::Array, rows } => rows.iter().flatten().any(holds_relation),
        _ => false,
    }
}

/// A side without the statement behind it, and that statement: `f (= g)`, `0 (a \parallel b)`, `f \begin{cases} > 0 ...`.
fn without_aside(side: &Node) -> (Node, Option<&Node>) {
    match &side.kind {
        Kind::Juxt(factors) => match factors.split_last() {
            Some((last, rest)) if aside_of(last).is_some() && !rest.is_empty() => {
                let kind = if rest.len() == 1 { rest[0].kind.clone() } else { Kind::Juxt(rest.to_vec()) };
                let end = rest.last().map_or(side.span.end, |n| n.span.end);
                (Node::new(kind, side.span.start..end), aside_of(last))
            }
            _ => (side.clone(), None),
        },
        // Behind the last term of a sum, the last factor of a product.
        Kind::Sum(terms) => match terms.split_last() {
            Some((last, rest)) => {
                let (node, aside) = without_aside(&last.node);
                let terms = rest.iter().cloned().chain([Term { node, ..last.clone() }]).collect();
                (Node::new(Kind::Sum(terms), side.span.clone()), aside)
            }
            None => (side.clone(), None),
        },
        Kind::Product { first, rest } => match rest.split_last() {
            Some(((op, last), before)) => {
                let (node, aside) = without_aside(last);
                let rest = before.iter().cloned().chain([(*op, node)]).collect();
                (Node::new(Kind::Product { first: first.clone(), rest }, side.span.clone()), aside)
            }
            None => (side.clone(), None),
        },
        _ => (side.clone(), None),
    }
}

/// The statement that a last factor is: one in brackets, or cases that begin with relations.
fn aside_of(factor: &Node) -> Option<&Node> {
    match &factor.kind {
        Kind::Group { open: Delim::Paren, body, .. } if holds_relation(body) => Some(body),
        Kind::Matrix { env: MatrixEnv::Cases | MatrixEnv::Array, rows } if rows.iter().all(|row| begins(row)) => {
            Some(factor)
        }
        _ => None,
    }
}

/// Whether a row of an array begins with a relation.
fn begins(row: &[Node]) -> bool {
    row.first().is_some_and(begins_with_relation)
}

/// Whether a side consists of words only.
pub(super) fn is_words(node: &Node) -> bool {
    match &node.kind {
        Kind::Text(_) => true,
        Kind::Juxt(factors) => factors.iter().all(is_words),
        _ => false,
    }
}

/// Whether words stand beside the mathematics of a side.
fn holds_words(node: &Node) -> bool {
    match &node.kind {
        Kind::Text(_) => true,
        Kind::Juxt(factors) => factors.iter().any(holds_words),
        _ => false,
    }
}

/// Whether a side is the word const., perhaps with a name given to it in brackets behind.
pub(super) fn is_constant(node: &Node) -> bool {
    match &node.kind {
        Kind::Text(text) => {
            let first = text.split_whitespace().next().unwrap_or_default();
            first.trim_end_matches('.').eq_ignore_ascii_case("const") || first == "一定"
        }
        Kind::Function(name) => name == "const",
        Kind::Styled(_, body) => is_constant(body),
        Kind::Juxt(factors) => factors.first().is_some_and(is_constant),
        _ => false,
    }
}

/// Whether a formula has branches by ±.
pub fn has_branches(node: &Node) -> bool {
    let here = match &node.kind {
        Kind::Sum(terms) => terms.iter().any(|t| matches!(t.sign, Sign::PlusMinus | Sign::MinusPlus)),
        _ => false,
    };
    here || node.children().into_iter().any(has_branches)
}

/// The LaTeX of a relation.
pub fn relation_latex(rel: Rel) -> &'static str {
    match rel {
        Rel::Eq => "=",
        Rel::Equiv => "\\equiv",
        Rel::Ne => "\\neq",
        Rel::Lt => "<",
        Rel::Gt => ">",
        Rel::Le => "\\leq",
        Rel::Ge => "\\geq",
        Rel::Ll => "\\ll",
        Rel::Gg => "\\gg",
        Rel::Approx => "\\approx",
        Rel::Sim => "\\sim",
        Rel::Cong => "\\cong",
        Rel::Propto => "\\propto",
        Rel::To => "\\to",
        Rel::From => "\\leftarrow",
        Rel::Exchange => "\\leftrightarrow",
        Rel::Implies => "\\Rightarrow",
        Rel::ImpliedBy => "\\Leftarrow",
        Rel::Iff => "\\Leftrightarrow",
        Rel::Parallel => "\\parallel",
        Rel::Perp => "\\perp",
        Rel::In => "\\in",
        Rel::Ratio => ":",
    }
}
