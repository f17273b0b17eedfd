//! One link of an equation, ready to be evaluated: its residuals, the premises, and how they were understood.

use std::collections::BTreeSet;

use crate::document::{Span, Spanned};
use crate::expr::{Deadline, Expr, Graph, Node, SymId};
use crate::latex::{
    ParseError,
    ast::{self, Rel},
};
use crate::semantics::{self, Clause, Elaborator, Error, Scope, Side, TypedLink, Value, World};

use super::book::{Book, Formula, Unclear, Version};
use super::premises::Premises;
use super::proportion;

/// How deep values at the start of the motion may be made of others.
const MOST_STARTS: usize = 16;

/// A pair of scalars that a link relates.
#[derive(Clone, Debug)]
pub struct Pair {
    /// Which instance and component, where there are several.
    pub name: Option<String>,
    /// The left side.
    pub lhs: Expr,
    /// The right side.
    pub rhs: Expr,
    /// What must vanish (or, for an inequality, have a sign): left minus right.
    pub residual: Expr,
    /// Whether only the values at the start of the motion are meant.
    pub start: bool,
}

impl Pair {
    pub(super) fn new(graph: &mut Graph, name: Option<String>, lhs: Expr, rhs: Expr) -> Self {
        Pair { name, lhs, rhs, residual: graph.sub(lhs, rhs), start: false }
    }
}

/// Whether each pair is one of those that are given as equal, apart from what is nothing but itself.
fn restates(branches: &[Branch], given: &[(Expr, Expr)]) -> bool {
    let said = |pair: &&Pair| given.contains(&(pair.lhs, pair.rhs)) || given.contains(&(pair.rhs, pair.lhs));
    let mut pairs = branches.iter().flatten().filter(|pair| pair.lhs != pair.rhs).peekable();
    pairs.peek().is_some() && pairs.all(|pair| said(&pair))
}

/// The pairs of one branch of a link.
pub type Branch = Vec<Pair>;

/// A link ready to be evaluated.
pub struct Claim {
    /// The graph and its symbols.
    pub world: World,
    /// The relation.
    pub rel: Rel,
    /// The branches of ±: one, or the upper and the lower.
    pub branches: Vec<Branch>,
    /// What the state must satisfy.
    pub premises: Premises,
    /// The symbols to solve for first.
    pub solve: Vec<SymId>,
    /// The small parameter and whether it is the reciprocal of the symbol.
    pub small: Option<(SymId, bool)>,
    /// How the left side was read.
    pub lhs_text: String,
    /// How the right side was read.
    pub rhs_text: String,
    /// The condition that an inequality is to be equivalent to.
    pub condition: Option<(Rel, Expr, Expr)>,
    /// The bases of all symbols that the premises speak of, those left out as unrelated included.
    pub bound: BTreeSet<SymId>,
    /// What must be greater or less than zero at a state.
    pub ordered: Vec<(Rel, Expr)>,
    /// Whether the premises say the same in as many terms: what holds then shows nothing.
    pub restated: bool,
    /// Whether its pairs are coefficients of a Fourier series of which some terms are printed.
    pub partial: bool,
}

/// Why a claim could not be made.
#[derive(Clone, Debug)]
pub enum Obstacle {
    /// The link itself.
    Link(Error),
    /// A premise: its name, the error's text, and the bytes of the file that are at fault in the annotation.
    Premise(String, String, Span),
}

/// Which premises a claim keeps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Related {
    /// Those that have to do with what is claimed.
    Only,
    /// All.
    All,
}

/// What a claim is made from.
#[derive(Clone, Copy)]
pub struct Source<'b> {
    /// The document.
    pub book: &'b Book,
    /// The equation that is judged.
    pub index: usize,
    /// The version of it.
    pub version: Version,
    /// Which of its links (from 0), where it has premises of its own.
    pub link: Option<usize>,
    /// When the time for it is used up.
    pub deadline: Deadline,
}

impl<'b> Source<'b> {
    /// For an equation as a whole.
    pub fn new(book: &'b Book, index: usize, version: Version) -> Self {
        Source { book, index, version, link: None, deadline: Deadline::NEVER }
    }

    /// With a limit of the time for it.
    pub fn until(self, deadline: Deadline) -> Self {
        Source { deadline, ..self }
    }

    /// For one of its links.
    pub fn at(&self, link: usize) -> Self {
        Source { link: Some(link), ..*self }
    }

    pub(super) fn scope(&self) -> &Scope {
        &self.book.entries[self.index].scope
    }

    /// Builds the claim of a clause of the equation. `known` are clauses of the same equation that are definitions.
    pub fn claim(&self, clause: &Clause, scope: &Scope, known: &[Clause]) -> Result<Claim, Obstacle> {
        self.claim_of(std::slice::from_ref(clause), scope, known, Related::Only)
    }

    /// Builds one claim of several clauses with one relation; a ± may stand in the first alone.
    pub(super) fn claim_of(
        &self,
        clauses: &[Clause],
        scope: &Scope,
        known: &[Clause],
        related: Related,
    ) -> Result<Claim, Obstacle> {
        let [clause, more @ ..] = clauses else {
            return Err(Obstacle::Link(Error::unsupported("nothing is printed here", &(0..0))));
        };
        let mut world = World::until(self.deadline);
        // A premise from another section that speaks of the same basis means this one.
        Elaborator::new(&mut world, scope, Vec::new(), true).build_bases();
        let typed = self.branches(&mut world, scope, clause).map_err(Obstacle::Link)?;
        let constant = clause.rhs == Side::Constant;
        let mut branches: Vec<Branch> = typed.iter().map(|link| pairs(&mut world, link, constant)).collect();
        for clause in more {
            let link = semantics::understand(&mut world, scope, clause, true).map_err(Obstacle::Link)?;
            branches[0].extend(pairs(&mut world, &link, clause.rhs == Side::Constant));
        }
        let mut given = self.given(&mut world)?;
        let conditions = clauses.iter().flat_map(|clause| &clause.when);
        for clause in conditions.chain(known) {
            self.add_clause(&mut world, self.scope(), clause, &mut given).map_err(Obstacle::Link)?;
        }
        let sides: Vec<Expr> = given.equal.iter().flat_map(|(a, b)| [*a, *b]).collect();
        if let Some(name) = world.integrated(&sides) {
            let message = format!("the premises speak of {name}, which is the variable of an integral");
            let error = Error::unsupported(message, &clause.lhs.span)
                .with_help("what depends on it must be given by a formula: same = '..', function = [..]");
            return Err(Obstacle::Link(error));
        }
        let restated = restates(&branches, &given.equal);
        given.equal.extend(world.integral_rates());
        given.ordered.extend(world.precise().iter().map(|e| (Rel::Gt, *e)));
        let small = self.small(&mut world)?;
        let condition = self.condition(&mut world)?;
        let solve = self.solve(&mut world)?;
        self.ranges(&mut world)?;

        let kept: BTreeSet<SymId> = small.iter().map(|(s, _)| *s).collect();
        let mut premises = Premises::new(&mut world.graph, &given.equal, &kept);
        let mut targets = Vec::new();
        // What the link speaks of before the premises are put in: these may leave nothing of it, and still contradict
        // each other there.
        let printed: Vec<Expr> = branches.iter().flatten().map(|pair| pair.residual).collect();
        let mentioned = world.graph.symbols(&printed);
        resolve(&mut world, &premises, &mut branches, typed.first().map(|link| link.rel));
        if typed.first().is_some_and(|link| link.rel == Rel::Propto) {
            let each = |branch: &Branch, world: &mut World| {
                branch.iter().flat_map(|pair| proportion::pairs(world, pair)).collect::<Branch>()
            };
            branches = branches.iter().map(|branch| each(branch, &mut world)).collect();
        }
        let partial = self.harmonics(&mut world, &premises, &mut branches)?;
        for pair in branches.iter().flatten() {
            targets.extend([pair.residual, pair.lhs, pair.rhs]);
        }
        targets.extend(small.iter().map(|(s, _)| world.graph.sym(*s)).collect::<Vec<_>>());
        // What it is to be equivalent to speaks of symbols that the premises may give.
        let mut resolved = |e: Expr| premises.resolve(&mut world.graph, e);
        let condition = condition.map(|(rel, a, b)| (rel, resolved(a), resolved(b)));
        targets.extend(condition.iter().flat_map(|(_, a, b)| [*a, *b]));
        let ordered: Vec<(Rel, Expr)> =
            given.ordered.iter().map(|(rel, e)| (*rel, premises.resolve(&mut world.graph, *e))).collect();
        let bound: Vec<Expr> = ordered.iter().map(|(_, e)| *e).chain(premises.residuals.iter().copied()).collect();
        let bound = world.graph.symbols(&bound);
        let bound = bound.into_iter().map(|s| world.graph.info(s).base).collect();
        if related == Related::Only {
            premises.keep_related(&world.graph, &targets, mentioned);
        }
        premises.close_in_time(&mut world.graph, &targets);
        // What is so at one moment only has no rate.
        for (symbol, value) in world.moment.clone() {
            let difference = world.graph.sub(symbol, value);
            let difference = premises.resolve(&mut world.graph, difference);
            premises.residuals.push(difference);
        }
        world.check(&clause.lhs.span).map_err(Obstacle::Link)?;
        let (lhs_text, rhs_text) = typed.first().map(|l| (l.lhs_text.clone(), l.rhs_text.clone())).unwrap_or_default();
        let rel = clause.rel;
        Ok(Claim {
            world,
            rel,
            branches,
            premises,
            solve,
            small,
            lhs_text,
            rhs_text,
            condition,
            bound,
            ordered,
            restated,
            partial,
        })
    }

    pub(super) fn branches(&self, world: &mut World, scope: &Scope, clause: &Clause) -> Result<Vec<TypedLink>, Error> {
        let mut links = Vec::new();
        for clause in semantics::independent_signs(clause) {
            let both = semantics::has_branches(&clause.lhs)
                || matches!(&clause.rhs, Side::Node(n) if semantics::has_branches(n));
            links.push(semantics::understand(world, scope, &clause, true)?);
            if both {
                links.push(semantics::understand(world, scope, &clause, false)?);
            }
        }
        Ok(links)
    }

    /// A symbol named in an annotation; a family's as a tuple.
    pub(super) fn symbol(&self, world: &mut World, text: &Spanned<String>) -> Result<Value, Obstacle> {
        let tree = Formula::new(&text.value).tree.map_err(|e| broken(text, &e))?;
        semantics::every_value(world, self.scope(), &tree).map_err(|e| unclear(text, &e))
    }

    fn solve(&self, world: &mut World) -> Result<Vec<SymId>, Obstacle> {
        let mut symbols = Vec::new();
        for text in self.book.entries[self.index].list(|a| &a.solve) {
            for e in self.symbol(world, text)?.components() {
                if let Node::Symbol(s) = *world.graph.node(e) {
                    symbols.push(s);
                }
            }
        }
        Ok(symbols)
    }

    /// The small parameter: a symbol, or the reciprocal of one that grows.
    fn small(&self, world: &mut World) -> Result<Option<(SymId, bool)>, Obstacle> {
        let Some(text) = self.book.entries[self.index].annotation().and_then(|a| a.small.as_ref()) else {
            return Ok(None);
        };
        let value = self.symbol(world, text)?;
        let symbol = |e: Expr| match *world.graph.node(e) {
            Node::Symbol(s) => Some((s, false)),
            Node::Div(one, e) if world.graph.as_rational(one) == Some((1, 1)) => match *world.graph.node(e) {
                Node::Symbol(s) => Some((s, true)),
                _ => None,
            },
            _ => None,
        };
        let found = match value {
            Value::Scalar(e) => symbol(e),
            _ => None,
        };
        found.map(Some).ok_or_else(|| {
            let message = "a small parameter must be a symbol or 1 divided by one";
            Obstacle::Premise(text.value.clone(), message.into(), text.span.clone())
        })
    }

    fn condition(&self, world: &mut World) -> Result<Option<(Rel, Expr, Expr)>, Obstacle> {
        let Some(annotation) = self.book.entries[self.index].annotation() else { return Ok(None) };
        let of_link = annotation.link.iter().find(|l| self.link.is_some_and(|k| k + 1 == l.number));
        let Some(text) = of_link.and_then(|l| l.iff.as_ref()).or(annotation.iff.as_ref()) else { return Ok(None) };
        let obstacle = |message: String| Obstacle::Premise(text.value.clone(), message, text.span.clone());
        let tree = Formula::new(&text.value).tree.map_err(|e| broken(text, &e))?;
        let statement = semantics::statement(&tree, None).map_err(|e| unclear(text, &e))?;
        let [clause] = statement.clauses.as_slice() else {
            return Err(obstacle("a condition is a single relation".into()));
        };
        let link = semantics::understand(world, self.scope(), clause, true).map_err(|e| unclear(text, &e))?;
        match link.pairs().as_slice() {
            [(_, a, b)] => Ok(Some((clause.rel, *a, *b))),
            _ => Err(obstacle("a condition relates two scalars".into())),
        }
    }

    /// The ranges that the equation's annotation sets.
    pub(super) fn ranges(&self, world: &mut World) -> Result<(), Obstacle> {
        let Some(annotation) = self.book.entries[self.index].annotation() else { return Ok(()) };
        for (name, range) in &annotation.range {
            for e in self.symbol(world, name)?.components() {
                if let Node::Symbol(s) = *world.graph.node(e) {
                    world.set_range(s, *range);
                }
            }
        }
        Ok(())
    }

    /// The image of the left side under the map that an arrow stands for, as the right side to be.
    pub fn mapped(&self, clause: &Clause) -> Option<Result<Clause, Obstacle>> {
        let text = self.book.entries[self.index].annotation().and_then(|a| a.maps.as_ref())?;
        Some(match Formula::new(&text.value).tree {
            Err(e) => Err(broken(text, &e)),
            Ok(tree) => match &tree.kind {
                ast::Kind::Chain { first: Some(variable), links } if links.len() == 1 && links[0].rel == Rel::To => {
                    let image = replaced(&links[0].rhs, variable, &clause.lhs);
                    Ok(Clause { lhs: image, rel: Rel::Eq, ..clause.clone() })
                }
                _ => {
                    let message = "a map is written as X \\mapsto ...";
                    Err(Obstacle::Premise(text.value.clone(), message.into(), text.span.clone()))
                }
            },
        })
    }
}

/// LaTeX in an annotation that cannot be read.
pub(super) fn broken(text: &Spanned<String>, error: &ParseError) -> Obstacle {
    Obstacle::Premise(text.value.clone(), error.message.clone(), text.place(error.span.clone()))
}

/// LaTeX in an annotation that cannot be understood.
pub(super) fn unclear(text: &Spanned<String>, error: &Error) -> Obstacle {
    Obstacle::Premise(text.value.clone(), with_help(error), text.place(error.span.clone()))
}

pub(super) fn with_help(error: &Error) -> String {
    match &error.help {
        Some(help) => format!("{} ({help})", error.message),
        None => error.message.clone(),
    }
}

/// What is unclear, in words.
pub fn unclear_text(unclear: &Unclear) -> String {
    match unclear {
        Unclear::Latex(e) => e.message.clone(),
        Unclear::Meaning(e) => with_help(e),
        Unclear::Before(label, message) => format!("it continues ({label}), which cannot be understood: {message}"),
    }
}

/// Why a claim could not be made, in words.
pub fn obstacle_text(obstacle: &Obstacle) -> String {
    match obstacle {
        Obstacle::Link(error) => with_help(error),
        Obstacle::Premise(name, message, _) => format!("the premise {name} cannot be used: {message}"),
    }
}

pub(super) fn pairs(world: &mut World, link: &TypedLink, constant: bool) -> Branch {
    if constant {
        let zero = world.graph.int(0);
        let sides: Vec<Expr> = link.instances.iter().flat_map(|i| i.lhs.components()).collect();
        return sides
            .into_iter()
            .map(|e| {
                let rate = world.rate(e);
                Pair::new(&mut world.graph, None, rate, zero)
            })
            .collect();
    }
    let mut pairs = Branch::new();
    for (name, lhs, rhs) in link.pairs() {
        pairs.push(Pair::new(&mut world.graph, name, lhs, rhs));
    }
    pairs
}

/// Puts the premises' definitions into the pairs. An equation in time becomes two.
fn resolve(world: &mut World, premises: &Premises, branches: &mut [Branch], rel: Option<Rel>) {
    let each = |pair: &mut Pair, f: &mut dyn FnMut(Expr) -> Expr| {
        for e in [&mut pair.lhs, &mut pair.rhs, &mut pair.residual] {
            *e = f(*e);
        }
    };
    for branch in branches {
        branch.iter_mut().for_each(|pair| each(pair, &mut |e| premises.resolve(&mut world.graph, e)));
        if !matches!(rel, Some(Rel::Eq | Rel::Equiv | Rel::Implies)) {
            continue;
        }
        *branch = std::mem::take(branch).into_iter().flat_map(|pair| in_time(world, pair)).collect();
        for pair in branch {
            each(pair, &mut |e| premises.resolve(&mut world.graph, e));
            // A value at the start may be one of something with values at the start, but not for ever.
            for _ in 0..MOST_STARTS {
                if pair.start && world.remembers(pair.residual) {
                    each(pair, &mut |e| world.start(e));
                    each(pair, &mut |e| premises.resolve(&mut world.graph, e));
                }
            }
        }
    }
}

/// An equation between integrals along the motion, or differences from its start, as two: what holds for all times is what
/// holds at the start and has the same rate ever after.
pub(super) fn in_time(world: &mut World, pair: Pair) -> Vec<Pair> {
    if !world.remembers(pair.lhs) && !world.remembers(pair.rhs) {
        return vec![pair];
    }
    let named = |what: &str| Some(pair.name.iter().map(String::as_str).chain([what]).collect::<Vec<_>>().join(", "));
    let (left, right) = (world.rate(pair.lhs), world.rate(pair.rhs));
    let rate = Pair::new(&mut world.graph, named("rate"), left, right);
    vec![rate, Pair { name: named("at the start"), start: true, ..pair }]
}

/// A tree in which every occurrence of a variable is replaced by something in brackets.
fn replaced(node: &ast::Node, variable: &ast::Node, by: &ast::Node) -> ast::Node {
    if node.kind == variable.kind
        || semantics::spelling(node) == semantics::spelling(variable) && !semantics::spelling(node).is_empty()
    {
        let body = Box::new(by.clone());
        let kind = ast::Kind::Group { open: ast::Delim::Paren, close: ast::Delim::Paren, body };
        return ast::Node::new(kind, node.span.clone());
    }
    node.map_children(&mut |child| replaced(child, variable, by))
}
