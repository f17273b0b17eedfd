//! Complex numbers, as pairs of a real and an imaginary part.
//!
//! Notes use them where a letter is declared as the imaginary unit:
//! ```toml
//! 'i' = { same = '\operatorname{i}' }
//! ```
//! Sums, products, quotients, whole powers, absolute values, and powers of positive numbers, as in `e^{im\lambda}` and
//! `\exp[im\lambda]`. An equation between complex numbers is two.

use crate::expr::{Expr, Func, Graph};
use crate::latex::ast::{Kind, Node, Span};

use super::error::{Error, Result};
use super::value::Value;

/// A real and an imaginary part.
pub(super) type Pair = (Expr, Expr);

/// The highest whole power that is multiplied out.
const HIGHEST_POWER: i32 = 64;

/// Whether a node is the imaginary unit, `\operatorname{i}`.
pub(super) fn is_unit(node: &Node) -> bool {
    matches!(&node.kind, Kind::Function(name) if name == "i")
}

/// The imaginary unit.
pub(super) fn unit(graph: &mut Graph) -> Value {
    Value::Complex(graph.int(0), graph.int(1))
}

/// The parts of a real or complex number.
pub(super) fn parts(graph: &mut Graph, value: &Value) -> Option<Pair> {
    match value {
        Value::Scalar(e) => Some((*e, graph.int(0))),
        Value::Complex(re, im) => Some((*re, *im)),
        _ => None,
    }
}

/// Both numbers as complex ones, where at least one is and the other may be.
pub(super) fn met(graph: &mut Graph, a: &Value, b: &Value) -> Option<(Pair, Pair)> {
    if !matches!((a, b), (Value::Complex(..), _) | (_, Value::Complex(..))) {
        return None;
    }
    Some((parts(graph, a)?, parts(graph, b)?))
}

/// The product.
pub(super) fn product(graph: &mut Graph, (a, b): Pair, (c, d): Pair) -> Pair {
    let (ac, bd, ad, bc) = (graph.mul(a, c), graph.mul(b, d), graph.mul(a, d), graph.mul(b, c));
    (graph.sub(ac, bd), graph.add(ad, bc))
}

/// The quotient.
pub(super) fn quotient(graph: &mut Graph, a: Pair, (c, d): Pair) -> Pair {
    let minus = graph.neg(d);
    let (re, im) = product(graph, a, (c, minus));
    let square = square(graph, (c, d));
    (graph.div(re, square), graph.div(im, square))
}

/// The square of the absolute value.
pub(super) fn square(graph: &mut Graph, (a, b): Pair) -> Expr {
    let (aa, bb) = (graph.mul(a, a), graph.mul(b, b));
    graph.add(aa, bb)
}

/// The exponential function.
pub(super) fn exp(graph: &mut Graph, (a, b): Pair) -> Value {
    let size = graph.call(Func::Exp, a);
    let (cos, sin) = (graph.call(Func::Cos, b), graph.call(Func::Sin, b));
    Value::Complex(graph.mul(size, cos), graph.mul(size, sin))
}

/// A power: a whole one of any number, and any of a real one, which is taken to be positive; `None` of others.
///
/// # Errors
/// A whole power is too high to be multiplied out.
pub(super) fn power(graph: &mut Graph, base: &Value, exponent: &Value, span: &Span) -> Result<Option<Value>> {
    match (base, exponent) {
        (Value::Scalar(base), Value::Complex(a, b)) => {
            let (one, zero) = (graph.int(1), graph.int(0));
            let log = match *graph.node(*base) {
                crate::expr::Node::E => one,
                _ => graph.call(Func::Ln, *base),
            };
            let exponent = product(graph, (*a, *b), (log, zero));
            Ok(Some(exp(graph, exponent)))
        }
        (Value::Complex(re, im), Value::Scalar(n)) => {
            let Some((n, 1)) = graph.as_rational(*n) else { return Ok(None) };
            match i32::try_from(n) {
                Ok(n) if n.abs() <= HIGHEST_POWER => Ok(Some(whole_power(graph, (*re, *im), n))),
                _ => Err(Error::limit(format!("a whole power above {HIGHEST_POWER} is not multiplied out"), span)),
            }
        }
        _ => Ok(None),
    }
}

fn whole_power(graph: &mut Graph, base: Pair, n: i32) -> Value {
    let one = (graph.int(1), graph.int(0));
    let power = (0..n.abs()).fold(one, |acc, _| product(graph, acc, base));
    let (re, im) = if n < 0 { quotient(graph, one, power) } else { power };
    Value::Complex(re, im)
}

#[cfg(test)]
mod tests {
    use crate::semantics::testing::{same, scope, value};
    use crate::semantics::{Value, World};

    const SYMBOLS: &str = r"
        [symbols]
        'i' = { same = '\operatorname{i}' }
        'a, b' = {}
        'k' = { index = [-2, 2] }
    ";

    #[test]
    fn arithmetic() {
        assert!(same(SYMBOLS, r"(a + ib)(a - ib)", r"a^2 + b^2 + 0i"));
        assert!(same(SYMBOLS, r"\frac{a + ib}{b - ia}", r"i"));
        assert!(same(SYMBOLS, r"(a + ib)^{-2} (a + ib)^3", r"a + ib"));
        assert!(same(SYMBOLS, r"|a + ib|^2", r"a^2 + b^2"));
        assert!(!same(SYMBOLS, r"(a + ib)^2", r"a^2 + b^2 + 2iab"));
    }

    #[test]
    fn exponentials() {
        assert!(same(SYMBOLS, r"e^{i(a + b)}", r"(\cos a + i \sin a)(\cos b + i\sin b)"));
        assert!(same(SYMBOLS, r"\exp[-2ia]", r"e^{-ia} e^{-ia}"));
        assert!(same(SYMBOLS, r"e^{i a + b}", r"e^b e^{ia}"));
        assert!(!same(SYMBOLS, r"e^{ia}", r"\cos a - i \sin a"));
    }

    #[test]
    fn the_unit_squared_is_minus_one() {
        let mut world = World::new();
        let Ok(Value::Complex(re, im)) = value(&mut world, &scope(SYMBOLS), "i^2") else { panic!() };
        assert_eq!((world.graph.as_rational(re), world.graph.as_rational(im)), (Some((-1, 1)), Some((0, 1))));
        assert!(value(&mut world, &scope(SYMBOLS), "i^{99}").is_err());
        assert!(value(&mut world, &scope(SYMBOLS), r"\sin(ia)").is_err());
    }
}
