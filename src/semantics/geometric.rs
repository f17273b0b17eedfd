//! Relations between directions: proportional, parallel, perpendicular, as equations between components; and between
//! numbers that change in proportion along the motion.

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
/// For numbers a ∝ b that depend on time, that a/b is constant.
///
/// # Errors
/// Where the sides have not the same number of components, or one only that is no number in proportion.
pub(super) fn as_equation(world: &mut World, rel: Rel, a: &Value, b: &Value, span: &Span) -> Result<(Value, Value)> {
    if let (Rel::Propto, Value::Scalar(a), Value::Scalar(b)) = (rel, a, b)
        && let Some(rate) = rate_of_ratio(world, *a, *b)
    {
        return Ok((Value::Scalar(rate), Value::Scalar(world.graph.int(0))));
    }
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

/// The rate of a/b for numbers that both depend on time. For integrals along the motion, which both begin at zero, that
/// of the ratio of what is integrated, which is the same one if it is constant. None for what is not of either kind.
fn rate_of_ratio(world: &mut World, a: Expr, b: Expr) -> Option<Expr> {
    let along = world.remembers(a) || world.remembers(b);
    let (mut above, mut below) = (a, b);
    if along {
        let begin = [world.start(a), world.start(b)];
        (above, below) = (world.rate(a), world.rate(b));
        let integrals = [above, below].iter().all(|e| !world.remembers(*e));
        if !begin.iter().all(|e| world.graph.is_zero(*e)) || !integrals {
            return None;
        }
    }
    let t = world.graph.find("t");
    let moves = |e: Expr| world.graph.symbols(&[e]).iter().any(|s| world.graph.info(*s).of_t || Some(*s) == t);
    let together = moves(a) && moves(b);
    if !along && !together {
        return None;
    }
    let ratio = world.graph.div(above, below);
    Some(world.graph.time_derivative(ratio, t))
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

    #[test]
    fn numbers_in_proportion_have_a_constant_ratio() {
        use super::super::testing::{scope, value};
        let symbols = scope("[symbols]\n'x, y' = { of = 't', range = [1, 2] }\n'c' = { range = [1, 2] }");
        let mut world = World::new();
        let mut equation = |a: &str, b: &str| {
            let [a, b] = [a, b].map(|latex| value(&mut world, &symbols, latex).unwrap());
            as_equation(&mut world, Rel::Propto, &a, &b, &(0..0)).map(|(left, _)| match left {
                Value::Scalar(e) => world.graph.display(e),
                other => format!("{other:?}"),
            })
        };
        assert_eq!(equation(r"\int_0^t x dt", r"\int_0^t dt").unwrap(), r"\dot{x}");
        assert!(equation("x", "y").unwrap().contains(r"\dot{y}"));
        assert!(equation("x", "c").is_err() && equation(r"1 + \int_0^t x dt", r"\int_0^t dt").is_err());
    }
}
