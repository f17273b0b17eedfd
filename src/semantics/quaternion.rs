//! Hamilton's quaternions: vectors side by side are multiplied, and a number may be added to a vector.
//!
//! Notes use them where a symbol is declared as one of the operators that take a quaternion apart:
//! ```toml
//! 'S' = { same = '\operatorname{Sc}' }     # its scalar part
//! 'V' = { same = '\operatorname{Vec}' }    # its vector part
//! 'U' = { same = '\operatorname{Unit}' }   # the vector divided by its length
//! ```
//! An operator acts on all that follows it in its product, up to a visible dot or cross: S ω r V r g is S(ω r V(r g)).
//! Products of vectors are ab = −a·b + a×b, so that the square of a unit vector is −1; a power of a unit vector a is the
//! rotation aᵗ = cos πt/2 + a sin πt/2.

use crate::expr::{Expr, Func, Graph};
use crate::latex::ast::{Kind, Node, Span};

use super::elaborate::{Elaborator, Typed};
use super::error::{Error, Result};
use super::juxtaposition::Item;
use super::scope::{Entry, EntryKind};
use super::value::{self, Value};

/// A number and a vector, by its components in the inertial frame.
pub(super) type Parts = (Expr, [Expr; 3]);

/// Whether a declared symbol is an operator on quaternions.
pub(super) fn is_operator(entry: &Entry) -> bool {
    matches!(&entry.kind, EntryKind::Same(Node { kind: Kind::Function(name), .. }) if part(name).is_some())
}

#[derive(Clone, Copy)]
enum Part {
    Scalar,
    Vector,
    Versor,
}

fn part(name: &str) -> Option<Part> {
    match name {
        "Sc" => Some(Part::Scalar),
        "Vec" => Some(Part::Vector),
        "Unit" => Some(Part::Versor),
        _ => None,
    }
}

impl Elaborator<'_> {
    /// An operator and what follows it; `None` where the first factor is no operator.
    pub(super) fn taken_apart(&mut self, items: &[Item]) -> Result<Option<(Typed, usize)>> {
        let Some(Item::Factor(node)) = items.first() else { return Ok(None) };
        let part = match self.entry(node) {
            Some((Entry { kind: EntryKind::Same(Node { kind: Kind::Function(name), .. }), .. }, _)) => part(name),
            _ => None,
        };
        let Some(part) = part else { return Ok(None) };
        let rest = items[1..].iter().take_while(|item| matches!(item, Item::Factor(_))).count();
        if rest == 0 {
            return Err(Error::unsupported("this operator has nothing to act on", &node.span));
        }
        let inner = self.items(&items[1..=rest])?;
        let Some((scalar, vector)) = parts(&mut self.world.graph, &inner.value) else {
            return Err(Error::shape(format!("{} is no quaternion", inner.value.shape()), &node.span));
        };
        let graph = &mut self.world.graph;
        let (value, name) = match part {
            Part::Scalar => (Value::Scalar(scalar), "S"),
            Part::Vector => (Value::Vector(vector), "V"),
            Part::Versor => {
                let square = value::dot3(graph, &vector, &vector);
                let length = graph.sqrt(square);
                (Value::Vector(vector.map(|c| graph.div(c, length))), "U")
            }
        };
        Ok(Some((Typed::new(value, format!("{name}({})", inner.text)), rest + 1)))
    }
}

/// The parts of a number, a vector or a quaternion.
pub(super) fn parts(graph: &mut Graph, value: &Value) -> Option<Parts> {
    let zero = graph.int(0);
    match value {
        Value::Scalar(e) => Some((*e, [zero; 3])),
        Value::Vector(v) => Some((zero, *v)),
        Value::Quaternion(s, v) => Some((*s, *v)),
        _ => None,
    }
}

/// Both values as quaternions, where one is and the other may be, or where a number meets a vector.
pub(super) fn met(graph: &mut Graph, a: &Value, b: &Value) -> Option<(Value, Value)> {
    if std::mem::discriminant(a) == std::mem::discriminant(b) {
        return None;
    }
    let ((s, v), (t, w)) = (parts(graph, a)?, parts(graph, b)?);
    Some((Value::Quaternion(s, v), Value::Quaternion(t, w)))
}

/// The product of quaternions.
pub(super) fn product(graph: &mut Graph, a: &Parts, b: &Parts) -> Value {
    let ((s, v), (t, w)) = (a, b);
    let (st, vw) = (graph.mul(*s, *t), value::dot3(graph, v, w));
    let scalar = graph.sub(st, vw);
    let cross = value::cross3(graph, v, w);
    let vector = [0, 1, 2].map(|k| {
        let (p, q) = (graph.mul(*s, w[k]), graph.mul(*t, v[k]));
        let sum = graph.add(p, q);
        graph.add(sum, cross[k])
    });
    Value::Quaternion(scalar, vector)
}

/// A power of a vector or quaternion: whole ones of any, others of unit vectors.
pub(super) fn power(graph: &mut Graph, base: &Parts, n: Expr, span: &Span) -> Result<Value> {
    match graph.as_rational(n) {
        Some((-1, 1)) => Ok(inverse(graph, base)),
        Some((2, 1)) => Ok(product(graph, base, base)),
        _ if graph.is_zero(base.0) => {
            let (pi, two) = (graph.pi(), graph.int(2));
            let turns = graph.mul(pi, n);
            let angle = graph.div(turns, two);
            let (sin, cos) = (graph.call(Func::Sin, angle), graph.call(Func::Cos, angle));
            Ok(Value::Quaternion(cos, base.1.map(|c| graph.mul(c, sin))))
        }
        _ => Err(Error::unsupported("this power of a quaternion is not evaluated yet", span)),
    }
}

/// The inverse of a quaternion: its conjugate divided by its norm.
pub(super) fn inverse(graph: &mut Graph, (s, v): &Parts) -> Value {
    let (square, length) = (graph.mul(*s, *s), value::dot3(graph, v, v));
    let norm = graph.add(square, length);
    let vector = v.map(|c| {
        let minus = graph.neg(c);
        graph.div(minus, norm)
    });
    Value::Quaternion(graph.div(*s, norm), vector)
}

#[cfg(test)]
mod tests {
    use crate::semantics::testing;

    const SYMBOLS: &str = r"
        [symbols]
        'S' = { same = '\operatorname{Sc}' }
        'V' = { same = '\operatorname{Vec}' }
        '\vec{a}, \vec{b}, \vec{c}' = { vector = '' }
        'q' = { same = '(2 + \vec{a})' }
    ";

    fn same(left: &str, right: &str) -> bool {
        testing::same(SYMBOLS, left, right)
    }

    #[test]
    fn vectors_side_by_side_are_multiplied() {
        assert!(same(r"S\vec{a}\vec{b}", r"-\vec{a} \cdot \vec{b}"));
        assert!(same(r"V\vec{a}\vec{b}", r"\vec{a} \times \vec{b}"));
        assert!(same(r"\vec{a}\vec{b} - \vec{b}\vec{a}", r"2 V\vec{a}\vec{b} + 0 \vec{a}\vec{b}"));
        assert!(same(r"S\vec{a}V\vec{b}\vec{c}", r"-\vec{a} \cdot (\vec{b} \times \vec{c})"));
        assert!(!same(r"V\vec{a}\vec{b}", r"V\vec{b}\vec{a}"));
    }

    #[test]
    fn a_quaternion_times_its_inverse_is_one() {
        assert!(same(r"q q^{-1}", r"1 + 0 \vec{a}"));
        assert!(same(r"q \vec{b} q^{-1} q", r"q \vec{b} + 0"));
    }
}
