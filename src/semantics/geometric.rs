//! Relations between directions: proportional, parallel, perpendicular, as equations between components.

use crate::expr::Expr;
use crate::latex::ast::{Rel, Span};

use super::error::{Error, Result};
use super::value::{self, Value};
use super::world::World;

/// Whether a relation is one between directions.
pub fn is_geometric(rel: Rel) -> bool {
    matches!(rel, Rel::Propto | Rel::Parallel | Rel::Perp)
}

/// The equation that a relation between directions states: for a ∝ b and a ∥ b all aᵢbⱼ = aⱼbᵢ, for a ⊥ b that a·b = 0.
///
/// # Errors
/// Where the sides have not the same number of components, or one only.
pub(super) fn as_equation(world: &mut World, rel: Rel, a: &Value, b: &Value, span: &Span) -> Result<(Value, Value)> {
    let (x, y) = (a.components(), b.components());
    if x.len() != y.len() || x.len() < 2 {
        let message = format!("{} and {} have no directions to compare", a.shape(), b.shape());
        return Err(Error::shape(message, span));
    }
    let graph = &mut world.graph;
    if rel == Rel::Perp {
        let terms: Vec<Expr> = x.iter().zip(&y).map(|(a, b)| graph.mul(*a, *b)).collect();
        return Ok((Value::Scalar(value::sum(graph, &terms)), Value::Scalar(graph.int(0))));
    }
    let (mut left, mut right) = (Vec::new(), Vec::new());
    for i in 0..x.len() {
        for j in i + 1..x.len() {
            left.push(Value::Scalar(graph.mul(x[i], y[j])));
            right.push(Value::Scalar(graph.mul(x[j], y[i])));
        }
    }
    Ok((Value::Tuple(left), Value::Tuple(right)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parallel_vectors_have_equal_ratios() {
        let mut world = World::new();
        let [x, y, z] = ["x", "y", "z"].map(|n| {
            let s = world.graph.symbol(n);
            world.graph.sym(s)
        });
        let two = world.graph.int(2);
        let a = Value::Vector([x, y, z]);
        let b = a.map(&mut |e| world.graph.mul(two, e));
        let (left, right) = as_equation(&mut world, Rel::Parallel, &a, &b, &(0..0)).unwrap();
        assert_eq!((left.components().len(), right.components().len()), (3, 3));
        let turned = Value::Vector([y, x, z]);
        let (p, q) = as_equation(&mut world, Rel::Propto, &a, &turned, &(0..0)).unwrap();
        assert_ne!(p, q);
    }

    #[test]
    fn scalars_have_no_direction() {
        let mut world = World::new();
        let one = Value::Scalar(world.graph.int(1));
        assert!(as_equation(&mut world, Rel::Parallel, &one, &one, &(0..0)).is_err());
    }
}
