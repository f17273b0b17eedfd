//! The dimensions of a clause: of its printed terms, and of whatever else its formulas join.
//!
//! They are read off the graph of scalar operations, so that they follow the reading of the formula that is evaluated,
//! and vectors, matrices and sums over particles need no rules of their own.

use std::collections::HashMap;

use crate::expr::{Elliptic, Expr, Func, Node, SymId};
use crate::latex::ast::Rel;
use crate::semantics::units::Dimension;
use crate::semantics::{
    Clause, Elaborator, Joint, PrintedTerm, Quantity, Role, Scope, Value, World, is_geometric, printed_terms,
};

use super::affine::Affine;

/// The quantities without a declared unit, by number.
#[derive(Clone, Debug, Default)]
pub struct Quantities {
    numbers: HashMap<Quantity, usize>,
    /// The quantities in the order in which they were met.
    pub all: Vec<Quantity>,
}

impl Quantities {
    /// The number of a quantity.
    pub fn number(&mut self, quantity: &Quantity) -> usize {
        *self.numbers.entry(quantity.clone()).or_insert_with(|| {
            self.all.push(quantity.clone());
            self.all.len() - 1
        })
    }
}

/// Values that are joined, with their dimensions.
#[derive(Clone, Debug)]
pub struct JointReading {
    /// What joins them.
    pub role: Role,
    /// The LaTeX of each.
    pub parts: Vec<String>,
    /// How many of the parts stand on the left side of a relation; 0 where they stand in one formula.
    pub left: usize,
    /// For each part the function whose argument, without brackets, reaches to its end.
    pub open: Vec<Option<String>>,
    /// For each component the parts that have a dimension there: 0 has none of its own.
    pub components: Vec<Vec<(usize, Affine)>>,
}

/// The dimensions of a clause.
#[derive(Clone, Debug)]
pub struct LinkReading {
    /// The clause's LaTeX.
    pub latex: String,
    /// What is joined within its formulas, inner before outer, and last the terms of its sides.
    pub joints: Vec<JointReading>,
    /// Dimensions that operations imply to be equal beside those that are printed, as in a product of vectors.
    pub implied: Vec<(Affine, Affine)>,
    /// Whether a term has its unit printed, so that it is not compared.
    pub units: bool,
}

impl LinkReading {
    /// Whether an unknown dimension occurs in it.
    pub fn has_unknowns(&self) -> bool {
        let joined = self.joints.iter().flat_map(|j| &j.components).flatten().map(|(_, a)| a);
        let implied = self.implied.iter().flat_map(|(a, b)| [a, b]);
        joined.chain(implied).any(|a| a.dimension().is_none())
    }
}

/// Reads a clause's dimensions; `None` where it cannot be understood or does not compare quantities.
pub fn read(scope: &Scope, clause: &Clause, mapped: bool, quantities: &mut Quantities) -> Option<LinkReading> {
    let geometric = is_geometric(clause.rel);
    if !(compares(clause.rel) || geometric || mapped && clause.rel == Rel::To) {
        return None;
    }
    let mut world = World::with_joints();
    Elaborator::new(&mut world, scope, Vec::new(), true).build_bases();
    let terms = printed_terms(&mut world, scope, clause).ok()?;
    let joints = world.take_joints();
    let units = terms.iter().any(|t| t.unit);
    let terms: Vec<PrintedTerm> = terms.into_iter().filter(|t| !t.unit).collect();
    let left = terms.iter().filter(|t| t.left).count();
    let open = terms.iter().map(|t| t.open.clone()).collect();
    let parts = |terms: Vec<PrintedTerm>| terms.into_iter().map(|t| (t.latex, t.value)).collect();
    // Directions are compared whatever the dimensions: each side is a sum of its own.
    let (apart, together) = terms.into_iter().partition(|t| geometric && t.left);
    let aside = Joint { role: Role::Sum, parts: parts(apart) };
    let top = Joint { role: Role::Sum, parts: parts(together) };

    let mut walk = Walk::new(&world, scope.quaternions, quantities);
    let mut read: Vec<JointReading> = Vec::new();
    for joint in &joints {
        // A sum over particles takes the same terms down for each of them, and an exponent 2 needs no check.
        let number = |(_, v): &(String, Value)| matches!(v, Value::Scalar(e) if world.graph.as_rational(*e).is_some());
        if !joint.parts.iter().all(number)
            && !read
                .iter()
                .any(|r| r.role == joint.role && r.parts.iter().eq(joint.parts.iter().map(|(latex, _)| latex)))
        {
            read.extend(walk.joint(joint));
        }
    }
    read.extend(Some(aside).filter(|aside| aside.parts.len() > 1).and_then(|aside| walk.joint(&aside)));
    let top = walk.joint(&top)?;
    let (left, open) = if geometric { (0, vec![None; top.parts.len()]) } else { (left, open) };
    read.push(JointReading { left, open, ..top });
    Some(LinkReading { latex: clause.latex(), joints: read, implied: walk.implied, units })
}

fn compares(rel: Rel) -> bool {
    use Rel::*;
    matches!(rel, Eq | Equiv | Ne | Lt | Gt | Le | Ge | Ll | Gg | Approx | Sim | Implies)
}

/// Dimensions of the nodes of a graph; `None` is that of 0, which is any.
struct Walk<'w> {
    world: &'w World,
    quantities: &'w mut Quantities,
    time: Affine,
    /// Whether numbers and vectors may be added.
    quaternions: bool,
    known: HashMap<Expr, Option<Affine>>,
    implied: Vec<(Affine, Affine)>,
}

impl<'w> Walk<'w> {
    fn new(world: &'w World, quaternions: bool, quantities: &'w mut Quantities) -> Self {
        let t = world.graph.find("t").and_then(|t| world.facts(t).quantity?.dimension);
        let time = Affine::of(t.unwrap_or(Dimension::TIME));
        Walk { world, quantities, time, quaternions, known: HashMap::new(), implied: Vec::new() }
    }

    /// `None` where the parts have different shapes: that is another finding.
    fn joint(&mut self, joint: &Joint) -> Option<JointReading> {
        let zero = |v: &Value| matches!(v, Value::Scalar(e) if self.world.graph.is_zero(*e));
        let holds = |shape: fn(&Value) -> bool| joint.parts.iter().any(|(_, v)| shape(v) && !zero(v));
        let (numbers, vectors) = (holds(|v| matches!(v, Value::Scalar(_))), holds(|v| matches!(v, Value::Vector(_))));
        if self.quaternions && (numbers && vectors || holds(|v| matches!(v, Value::Quaternion(..)))) {
            return self.quaternions(joint);
        }
        let shapes = joint.parts.iter().filter(|(_, v)| !zero(v)).map(|(_, v)| v.components().len());
        let count = shapes.clone().max().unwrap_or(0);
        if shapes.min().unwrap_or(0) != count {
            return None;
        }
        let mut components = vec![Vec::new(); count];
        for (part, (_, value)) in joint.parts.iter().enumerate() {
            for (component, e) in components.iter_mut().zip(value.components()) {
                component.extend(self.dimension(e).map(|a| (part, a)));
            }
        }
        let parts: Vec<String> = joint.parts.iter().map(|(latex, _)| latex.clone()).collect();
        let open = vec![None; parts.len()];
        Some(JointReading { role: joint.role.clone(), parts, left: 0, open, components })
    }

    /// Numbers and vectors beside quaternions are their scalar and vector parts.
    fn quaternions(&mut self, joint: &Joint) -> Option<JointReading> {
        let mut components = vec![Vec::new(); 4];
        for (part, (_, value)) in joint.parts.iter().enumerate() {
            let from = match value {
                Value::Scalar(_) | Value::Quaternion(..) => 0,
                Value::Vector(_) => 1,
                _ => return None,
            };
            for (component, e) in components[from..].iter_mut().zip(value.components()) {
                component.extend(self.dimension(e).map(|a| (part, a)));
            }
        }
        let parts: Vec<String> = joint.parts.iter().map(|(latex, _)| latex.clone()).collect();
        let open = vec![None; parts.len()];
        Some(JointReading { role: joint.role.clone(), parts, left: 0, open, components })
    }

    /// What an integral along the motion integrates, or what a value at its start is the value of.
    fn within(&self, e: Expr) -> Option<(Expr, bool)> {
        match *self.world.graph.node(e) {
            Node::Symbol(s) => self.world.remembered(self.world.graph.info(s).base),
            _ => None,
        }
    }

    /// Operands before operations, without recursion.
    fn dimension(&mut self, e: Expr) -> Option<Affine> {
        let mut stack = vec![e];
        while let Some(&at) = stack.last() {
            let operands = self.world.graph.node(at).operands().chain(self.within(at).map(|(e, _)| e));
            let missing: Vec<Expr> = operands.filter(|o| !self.known.contains_key(o)).collect();
            if missing.is_empty() || self.known.contains_key(&at) {
                stack.pop();
                if !self.known.contains_key(&at) {
                    let dimension = self.operation(at);
                    self.known.insert(at, dimension);
                }
            } else {
                stack.extend(missing);
            }
        }
        self.of(e)
    }

    fn of(&self, e: Expr) -> Option<Affine> {
        self.known.get(&e).cloned().flatten()
    }

    fn operation(&mut self, e: Expr) -> Option<Affine> {
        let number = Affine::of(Dimension::NONE);
        match *self.world.graph.node(e) {
            Node::Rational(0, _) => None,
            Node::Rational(..) | Node::Pi | Node::E => Some(number),
            Node::Symbol(s) => match self.within(e) {
                None => self.symbol(s),
                Some((rate, integral)) => {
                    let order = i128::from(self.world.graph.info(s).order) - i128::from(integral);
                    self.of(rate)?.over(&self.time.to_the((order, 1))?)
                }
            },
            Node::Neg(a) | Node::Call(Func::Abs, a) | Node::Integral(a) => self.of(a),
            Node::Add(a, b) | Node::Sub(a, b) => {
                self.imply(self.of(a), self.of(b));
                self.of(a).or(self.of(b))
            }
            Node::Mul(a, b) => self.of(a)?.times(&self.of(b)?),
            Node::Div(a, b) => self.of(a)?.over(&self.of(b)?),
            Node::PowI(a, n) => self.of(a)?.to_the((i128::from(n), 1)),
            Node::Sqrt(a) => self.of(a)?.to_the((1, 2)),
            Node::Pow(a, b) => match self.world.graph.as_rational(b) {
                Some(n) => self.of(a)?.to_the(n),
                None => {
                    self.imply(self.of(a), Some(number.clone()));
                    self.imply(self.of(b), Some(number.clone()));
                    Some(number)
                }
            },
            Node::Call(Func::Sign, _) => Some(number),
            Node::Call(_, a) => {
                self.imply(self.of(a), Some(number.clone()));
                Some(number)
            }
            Node::Atan2(a, b) => {
                self.imply(self.of(a), self.of(b));
                Some(number)
            }
            Node::Elliptic(f, x) => {
                // Carlson's integrals are homogeneous functions of their arguments, of degree -1/2 or -3/2.
                if f.modulus().is_none() {
                    x.iter().skip(1).take(f.arity() - 1).for_each(|y| self.imply(self.of(x[0]), self.of(*y)));
                    let degree = if matches!(f, Elliptic::Rc | Elliptic::Rf) { -1 } else { -3 };
                    return self.of(x[0])?.to_the((degree, 2));
                }
                x.iter().take(f.arity()).for_each(|y| self.imply(self.of(*y), Some(number.clone())));
                Some(number)
            }
        }
    }

    fn imply(&mut self, a: Option<Affine>, b: Option<Affine>) {
        if let (Some(a), Some(b)) = (a, b)
            && a != b
        {
            self.implied.push((a, b));
        }
    }

    fn symbol(&mut self, s: SymId) -> Option<Affine> {
        let info = self.world.graph.info(s);
        let quantity = self.world.facts(info.base).quantity?;
        let base = match quantity.dimension {
            Some(dimension) => Affine::of(dimension),
            None => Affine::unknown(self.quantities.number(&quantity)),
        };
        base.over(&self.time.to_the((i128::from(info.order), 1))?)
    }
}
