//! From a parsed equation to its links: what is said to equal what.

use crate::expr::Expr;
use crate::latex::ast::{Delim, Kind, Link, MatrixEnv, Node, Rel, Sign, Span, Term};
use crate::latex::to_latex;

use super::elaborate::Elaborator;
use super::error::{Error, Result};
use super::geometric::{as_equation, is_geometric};
use super::juxtaposition::Item;
use super::quaternion;
use super::ratio;
use super::scope::Scope;
use super::value::{Matrix, Value};
use super::world::World;

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
}

impl Clause {
    /// The link's LaTeX.
    pub fn latex(&self) -> String {
        let rhs = match &self.rhs {
            Side::Node(n) => to_latex(n),
            Side::Constant => "\\text{const.}".to_owned(),
        };
        format!("{} {} {rhs}", to_latex(&self.lhs), relation_latex(self.rel))
    }
}

/// An equation's clauses, with what a following equation may continue.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Statement {
    /// The clauses in order.
    pub clauses: Vec<Clause>,
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
        match &node.kind {
            Kind::Rows(rows) => rows.iter().try_for_each(|row| self.add(row)),
            Kind::List(items) => items.iter().try_for_each(|item| self.add(item)),
            Kind::Marked(_, body) => self.add(body),
            Kind::Annotated { body, .. } if holds_relation(body) => self.add(body),
            Kind::Matrix { env: MatrixEnv::Cases | MatrixEnv::Array, rows }
                if rows.iter().flatten().any(holds_relation) =>
            {
                rows.iter().filter_map(|row| row.first()).try_for_each(|cell| self.add(cell))
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
                Ok(())
            }
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
            Some(first @ Node { kind: Kind::Annotated { .. }, .. }) if holds_relation(first) => self.add(first)?,
            Some(first) if !is_words(first) => self.begin(first),
            _ if self.out.last.is_none() => {
                return Err(Error::unsupported("a relation with nothing before it", &node.span)
                    .with_help("only the equation directly before can be continued"));
            }
            _ if self.part == 0 => self.part = 1,
            _ => {}
        }
        for (k, link) in links.iter().enumerate() {
            if separates(links, k) {
                self.add(&link.rhs)?;
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
        let mut constant = is_constant(&link.rhs);
        if let Some(difference) = without_constant(&lhs, &link.rhs) {
            (lhs, constant) = (difference, true);
        }
        let rhs = if constant { Side::Constant } else { Side::Node(link.rhs.clone()) };
        self.out.clauses.push(Clause { lhs, rel: link.rel, rhs, part: self.part, continued: self.continued });
        if !constant {
            self.out.last = Some(link.rhs.clone());
            self.continued = false;
        }
        Ok(())
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
fn holds_relation(node: &Node) -> bool {
    match &node.kind {
        Kind::Chain { .. } => true,
        Kind::Rows(nodes) | Kind::List(nodes) | Kind::Juxt(nodes) => nodes.iter().any(holds_relation),
        Kind::Marked(_, body) | Kind::Annotated { body, .. } => holds_relation(body),
        Kind::Group { open: Delim::None | Delim::Brace, body, .. } => holds_relation(body),
        Kind::Matrix { env: MatrixEnv::Cases | MatrixEnv::Array, rows } => rows.iter().flatten().any(holds_relation),
        _ => false,
    }
}

/// A side without the statement in brackets behind it, and that statement: `f (= g)`, `0 (a \parallel b)`.
fn without_aside(side: &Node) -> (Node, Option<&Node>) {
    match &side.kind {
        Kind::Juxt(factors) => match factors.split_last() {
            Some((Node { kind: Kind::Group { open: Delim::Paren, body, .. }, .. }, rest)) if holds_relation(body) => {
                let kind = if rest.len() == 1 { rest[0].kind.clone() } else { Kind::Juxt(rest.to_vec()) };
                let end = rest.last().map_or(side.span.end, |n| n.span.end);
                (Node::new(kind, side.span.start..end), Some(body))
            }
            _ => (side.clone(), None),
        },
        // Behind the last term of a sum.
        Kind::Sum(terms) => match terms.split_last() {
            Some((last, rest)) => {
                let (node, aside) = without_aside(&last.node);
                let terms = rest.iter().cloned().chain([Term { node, ..last.clone() }]).collect();
                (Node::new(Kind::Sum(terms), side.span.clone()), aside)
            }
            None => (side.clone(), None),
        },
        _ => (side.clone(), None),
    }
}

/// Whether a side consists of words only.
fn is_words(node: &Node) -> bool {
    match &node.kind {
        Kind::Text(_) => true,
        Kind::Juxt(factors) => factors.iter().all(is_words),
        _ => false,
    }
}

/// Whether a side is the word const., perhaps with a name given to it in brackets behind.
fn is_constant(node: &Node) -> bool {
    match &node.kind {
        Kind::Text(text) => text.trim().trim_end_matches('.').eq_ignore_ascii_case("const") || text.trim() == "一定",
        Kind::Function(name) => name == "const",
        Kind::Styled(_, body) => is_constant(body),
        Kind::Juxt(factors) => factors.first().is_some_and(is_constant),
        _ => false,
    }
}

/// The left side minus all that is printed beside the word const. on the right, `n t + \text{const.}`.
fn without_constant(lhs: &Node, rhs: &Node) -> Option<Node> {
    let Kind::Sum(terms) = &rhs.kind else { return None };
    let (constants, rest): (Vec<&Term>, Vec<&Term>) = terms.iter().partition(|t| is_constant(&t.node));
    let opposite = |sign| match sign {
        Sign::Plus => Sign::Minus,
        Sign::Minus => Sign::Plus,
        Sign::PlusMinus => Sign::MinusPlus,
        Sign::MinusPlus => Sign::PlusMinus,
    };
    if constants.len() != 1 || rest.is_empty() {
        return None;
    }
    let moved = rest.into_iter().map(|t| Term { sign: opposite(t.sign), ..t.clone() });
    let first = Term { sign: Sign::Plus, sign_span: None, node: lhs.clone() };
    Some(Node::new(Kind::Sum(std::iter::once(first).chain(moved).collect()), rhs.span.clone()))
}

/// Whether a formula has branches by ±.
pub fn has_branches(node: &Node) -> bool {
    let here = match &node.kind {
        Kind::Sum(terms) => terms.iter().any(|t| matches!(t.sign, Sign::PlusMinus | Sign::MinusPlus)),
        _ => false,
    };
    here || node.children().into_iter().any(has_branches)
}

/// A link's sides for one assignment of its free indices.
#[derive(Clone, Debug)]
pub struct Instance {
    /// Which one, as in `i = 2`, where there are several.
    pub tag: Option<String>,
    /// The left side.
    pub lhs: Value,
    /// The right side; [`Value::Constant`] for the word const.
    pub rhs: Value,
}

/// A link understood: both sides for every assignment of the free indices.
#[derive(Clone, Debug)]
pub struct TypedLink {
    /// The relation.
    pub rel: Rel,
    /// The sides.
    pub instances: Vec<Instance>,
    /// How the left side was read.
    pub lhs_text: String,
    /// How the right side was read.
    pub rhs_text: String,
}

impl TypedLink {
    /// The pairs of scalars that the link relates, with a name for each where there are several.
    pub fn pairs(&self) -> Vec<(Option<String>, Expr, Expr)> {
        let mut pairs = Vec::new();
        for instance in &self.instances {
            let (a, b) = (instance.lhs.components(), instance.rhs.components());
            let several = a.len() > 1;
            for (k, (a, b)) in a.into_iter().zip(b).enumerate() {
                let component = several.then(|| component_name(&instance.lhs, k));
                let parts: Vec<String> = instance.tag.iter().cloned().chain(component).collect();
                pairs.push(((!parts.is_empty()).then(|| parts.join(", ")), a, b));
            }
        }
        pairs
    }
}

fn component_name(value: &Value, k: usize) -> String {
    match value {
        Value::Vector(_) => format!("{} component (inertial)", ["x", "y", "z"][k % 3]),
        Value::Quaternion(..) => ["scalar part", "x component", "y component", "z component"][k % 4].to_owned(),
        Value::Matrix(m) if m.cols == 1 => format!("row {}", k + 1),
        Value::Matrix(m) => format!("entry {},{}", k / m.cols + 1, k % m.cols + 1),
        _ => format!("part {}", k + 1),
    }
}

/// Understands a clause in a world, by a scope. `upper` chooses the branch of ±.
pub fn understand(world: &mut World, scope: &Scope, clause: &Clause, upper: bool) -> Result<TypedLink> {
    let mut sides = vec![&clause.lhs];
    if let Side::Node(rhs) = &clause.rhs {
        sides.push(rhs);
    }
    world.begin_steps();
    let items: Vec<Item> = sides.iter().map(|n| Item::Factor(n)).collect();
    let letters = Elaborator::new(world, scope, Vec::new(), upper).unbound_indices(&items);
    let rel = if is_geometric(clause.rel) { Rel::Eq } else { clause.rel };
    let mut link = TypedLink { rel, instances: Vec::new(), lhs_text: String::new(), rhs_text: String::new() };
    for assignment in assignments(scope, &letters, &clause.lhs.span)? {
        let tag = assignment.iter().map(|(l, v)| format!("{l} = {v}")).collect::<Vec<_>>().join(", ");
        let mut elaborator = Elaborator::new(world, scope, assignment, upper);
        let lhs = elaborator.value(&clause.lhs)?;
        let (rhs, rhs_text) = match &clause.rhs {
            Side::Constant => (Value::Constant, "const.".to_owned()),
            Side::Node(node) => {
                let rhs = elaborator.value(node)?;
                (rhs.value, rhs.text)
            }
        };
        let (mut left, mut right) = meet(&mut elaborator, lhs.value, rhs, clause)?;
        if is_geometric(clause.rel) {
            (left, right) = as_equation(elaborator.world, clause.rel, &left, &right, &clause.lhs.span)?;
        }
        link.instances.push(Instance { tag: (!tag.is_empty()).then_some(tag), lhs: left, rhs: right });
        (link.lhs_text, link.rhs_text) = (lhs.text, rhs_text);
    }
    world.check(&clause.lhs.span)?;
    Ok(link)
}

/// The value of an expression; where it has free indices, the tuple of its values for all of them.
///
/// # Errors
/// Those of understanding it.
pub fn every_value(world: &mut World, scope: &Scope, node: &Node) -> Result<Value> {
    let letters = Elaborator::new(world, scope, Vec::new(), true).unbound_indices(&[Item::Factor(node)]);
    if letters.is_empty() {
        return Elaborator::new(world, scope, Vec::new(), true).value(node).map(|typed| typed.value);
    }
    let each = assignments(scope, &letters, &node.span)?.into_iter();
    let values = each.map(|indices| Ok(Elaborator::new(world, scope, indices, true).value(node)?.value));
    values.collect::<Result<_>>().map(Value::Tuple)
}

/// Brings the sides of a link to one shape: 0 stands for the null of any shape, a vector beside a column is meant by
/// its components.
fn meet(elaborator: &mut Elaborator, lhs: Value, rhs: Value, clause: &Clause) -> Result<(Value, Value)> {
    let zero = elaborator.world.graph.int(0);
    let (lhs, rhs) = match (&lhs, &rhs) {
        (Value::Tuple(_), Value::Vector(_) | Value::Matrix(_)) => (column_of(&lhs), rhs),
        (Value::Vector(_) | Value::Matrix(_), Value::Tuple(_)) => {
            let column = column_of(&rhs);
            (lhs, column)
        }
        _ => (lhs, rhs),
    };
    let (lhs, rhs) = match quaternion::met(&mut elaborator.world.graph, &lhs, &rhs) {
        Some(met) if elaborator.scope.quaternions && !is_null(elaborator, &lhs) && !is_null(elaborator, &rhs) => met,
        _ => (lhs, rhs),
    };
    let span = match &clause.rhs {
        Side::Node(n) => n.span.clone(),
        Side::Constant => clause.lhs.span.clone(),
    };
    Ok(match (lhs, rhs) {
        (lhs, Value::Constant) => (lhs, Value::Constant),
        (Value::Scalar(a), Value::Scalar(b)) => (Value::Scalar(a), Value::Scalar(b)),
        (lhs, rhs) if rhs.is_zero_scalar(&elaborator.world.graph) => {
            let null = lhs.map(&mut |_| zero);
            (lhs, null)
        }
        (lhs, rhs) if lhs.is_zero_scalar(&elaborator.world.graph) => (rhs.map(&mut |_| zero), rhs),
        (lhs @ Value::Vector(_), rhs @ Value::Matrix(_)) => (elaborator.as_column(&lhs, &span)?, rhs),
        (lhs @ Value::Matrix(_), rhs @ Value::Vector(_)) => {
            let column = elaborator.as_column(&rhs, &span)?;
            (lhs, column)
        }
        (lhs, rhs) => (lhs, rhs),
    })
    .and_then(|(lhs, rhs)| {
        let same = match (&lhs, &rhs) {
            (_, Value::Constant) => true,
            (Value::Matrix(a), Value::Matrix(b)) => (a.rows, a.cols) == (b.rows, b.cols),
            (a, b) => {
                std::mem::discriminant(a) == std::mem::discriminant(b) && a.components().len() == b.components().len()
            }
        };
        if same {
            Ok((lhs, rhs))
        } else {
            Err(Error::shape(
                format!("the sides do not meet: {} on the left, {} on the right", lhs.shape(), rhs.shape()),
                &span,
            ))
        }
    })
}

fn is_null(elaborator: &Elaborator, value: &Value) -> bool {
    value.is_zero_scalar(&elaborator.world.graph)
}

/// The column that a tuple of numbers beside a vector stands for; anything else as it is.
fn column_of(tuple: &Value) -> Value {
    match tuple {
        Value::Tuple(items) if items.iter().all(|item| matches!(item, Value::Scalar(_))) => {
            Value::Matrix(Matrix { rows: items.len(), cols: 1, data: tuple.components() })
        }
        other => other.clone(),
    }
}

/// The most terms of a sum, and instances of an equation: each costs time, and a handful shows what any number does.
pub(super) const MOST_ASSIGNMENTS: i128 = 10_000;

/// All assignments of values to indices; one empty assignment where there are none.
///
/// # Errors
/// There are too many.
pub(super) fn assignments(scope: &Scope, letters: &[String], span: &Span) -> Result<Vec<Vec<(String, i64)>>> {
    let mut all = vec![Vec::new()];
    for letter in letters {
        let Some((from, to)) = scope.index(letter) else { continue };
        let count = (i128::from(to) - i128::from(from) + 1) * all.len() as i128;
        if count > MOST_ASSIGNMENTS {
            return Err(too_many(&format!("what runs over {}", letters.join(", ")), count, span));
        }
        let mut next = Vec::new();
        for assignment in &all {
            for v in from..=to {
                let mut longer: Vec<(String, i64)> = assignment.clone();
                longer.push((letter.clone(), v));
                next.push(longer);
            }
        }
        all = next;
    }
    Ok(all)
}

/// More assignments than are written out.
pub(super) fn too_many(what: &str, count: i128, span: &Span) -> Error {
    Error::limit(format!("{what} has {count} terms; at most {MOST_ASSIGNMENTS} are written out"), span)
        .with_help("let the index run over a handful of values: 'i' = { index = [1, 3] }")
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
