//! A link understood: both sides as typed values of one shape, for every assignment of its free indices.

use crate::expr::Expr;
use crate::latex::ast::{Node, Rel, Span};

use super::elaborate::Elaborator;
use super::error::{Error, Result};
use super::geometric::{as_equation, is_geometric};
use super::juxtaposition::Item;
use super::quaternion;
use super::scope::Scope;
use super::statement::{Clause, Side};
use super::value::{Matrix, Value};
use super::world::World;

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
        Value::Complex(..) => ["real part", "imaginary part"][k % 2].to_owned(),
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
        // Integrals along the motion are in proportion along it.
        if let (Rel::Propto, Value::Scalar(a), Value::Scalar(b)) = (clause.rel, &left, &right)
            && !elaborator.world.remembers(*a)
            && !elaborator.world.remembers(*b)
        {
            link.rel = Rel::Propto;
        } else if is_geometric(clause.rel) {
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
        Some(met)
            if elaborator.scope.quaternions
                && !is_geometric(clause.rel)
                && !is_null(elaborator, &lhs)
                && !is_null(elaborator, &rhs) =>
        {
            met
        }
        _ => (lhs, rhs),
    };
    let span = match &clause.rhs {
        Side::Node(n) => n.span.clone(),
        Side::Constant => clause.lhs.span.clone(),
    };
    Ok(match (lhs, rhs) {
        (lhs, Value::Constant) => (lhs, Value::Constant),
        (Value::Scalar(a), Value::Scalar(b)) => (Value::Scalar(a), Value::Scalar(b)),
        (Value::Scalar(a), Value::Complex(re, im)) => (Value::Complex(a, zero), Value::Complex(re, im)),
        (Value::Complex(re, im), Value::Scalar(b)) => (Value::Complex(re, im), Value::Complex(b, zero)),
        // A row times a column is a number.
        (lhs @ Value::Scalar(_), Value::Matrix(m)) if m.data.len() == 1 => (lhs, Value::Scalar(m.data[0])),
        (Value::Matrix(m), rhs @ Value::Scalar(_)) if m.data.len() == 1 => (Value::Scalar(m.data[0]), rhs),
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
        let step = scope.get(letter).map_or(1, |entry| entry.step);
        let count = ((i128::from(to) - i128::from(from)) / step as i128 + 1) * all.len() as i128;
        if count > MOST_ASSIGNMENTS {
            return Err(too_many(&format!("what runs over {}", letters.join(", ")), count, span));
        }
        let mut next = Vec::new();
        for assignment in &all {
            for v in (from..=to).step_by(step) {
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
