//! Tests of the tape: against a plain evaluation of the graph node by node, and of its derivatives.

use super::*;
use crate::number::{Df64, Func, Number};
use std::collections::HashMap;

/// Evaluates node by node in the graph's order, without a tape.
pub(crate) fn evaluate<N: Number>(g: &Graph, e: Expr, values: &HashMap<SymId, N>, cx: &N::Context) -> N {
    let mut known: HashMap<Expr, N> = HashMap::new();
    for x in g.reachable(&[e]) {
        let at = |a: Expr| &known[&a];
        let mut value = N::zero(cx);
        match *g.node(x) {
            Node::Rational(n, d) => value = N::from_ratio(n, d, cx),
            Node::Pi => value = N::pi(cx),
            Node::E => value = N::e(cx),
            Node::Symbol(s) => value = values[&s].clone(),
            Node::Neg(a) => value.set_neg(at(a)),
            Node::Add(a, b) => value.set_add(at(a), at(b)),
            Node::Sub(a, b) => value.set_sub(at(a), at(b)),
            Node::Mul(a, b) => value.set_mul(at(a), at(b)),
            Node::Div(a, b) => value.set_div(at(a), at(b)),
            Node::PowI(a, n) => value.set_powi(at(a), n),
            Node::Pow(a, b) => value.set_pow(at(a), at(b)),
            Node::Sqrt(a) => value.set_sqrt(at(a)),
            Node::Call(f, a) => value.set_call(f, at(a)),
            Node::Atan2(a, b) => value.set_atan2(at(a), at(b)),
            Node::Elliptic(f, x) => value.set_elliptic(f, &x.map(at)[..f.arity()]),
            // Has tests of its own.
            Node::Integral(_) => value = N::from_f64(f64::NAN, cx),
        }
        known.insert(x, value);
    }
    known.remove(&e).unwrap()
}

#[test]
fn a_formula() {
    let mut g = Graph::new();
    let (sx, sy) = (g.symbol("x"), g.symbol("y"));
    let (x, y) = (g.sym(sx), g.sym(sy));
    let (s, c) = (g.call(Func::Sin, x), g.call(Func::Cos, x));
    let (pi, two) = (g.pi(), g.int(2));
    let half_pi = g.div(pi, two);
    let scaled = g.mul(half_pi, y);
    let (ss, cc) = (g.powi(s, 2), g.powi(c, 2));
    let one = g.add(ss, cc);
    let tape = Tape::compile(&g, &[one, scaled, x, two]);
    assert_eq!(tape.inputs(), [sx, sy]);
    assert_eq!(tape.len(), 5, "sine and cosine together, two squares, a sum, a product");
    let mut workspace = Workspace::new();
    let out = tape.eval(&[0.3, 2.0], &(), &mut workspace);
    assert!((out[0] - 1.0).abs() < 1e-15);
    assert_eq!(out[1..], [std::f64::consts::PI, 0.3, 2.0]);
    let other = Tape::compile(&g, &[s]);
    assert_eq!(other.eval(&[0.5], &(), &mut workspace), [0.5_f64.sin()]);
    assert_eq!(tape.eval(&[0.0, 0.0], &(), &mut workspace)[2..], [0.0, 2.0]);
}

#[test]
fn no_inputs_and_no_outputs() {
    let mut g = Graph::new();
    let pi = g.pi();
    let sin = g.call(Func::Sin, pi);
    let tape = Tape::compile(&g, &[sin, pi]);
    assert!(tape.is_empty());
    let out = tape.eval::<Df64>(&[], &(), &mut Workspace::new()).to_vec();
    assert!(out[0].hi().abs() < 1e-31);
    assert!(Tape::compile(&g, &[]).eval::<f64>(&[], &(), &mut Workspace::new()).is_empty());
}

#[test]
fn undefined_values_are_not_finite() {
    let mut g = Graph::new();
    let x = g.symbol("x");
    let x = g.sym(x);
    let zero = g.int(0);
    let outputs = [g.div(x, zero), g.powi(zero, -1), g.sqrt(x), g.call(Func::Ln, x), g.call(Func::Acosh, x)];
    let tape = Tape::compile(&g, &outputs);
    assert!(tape.eval(&[-1.0], &(), &mut Workspace::new()).iter().all(|v| !v.is_finite()));
    let x = Df64::from(-1.0);
    assert!(tape.eval(&[x], &(), &mut Workspace::new()).iter().all(|v| !Number::is_finite(v)));
}

#[test]
fn derivatives_along_a_direction() {
    let mut g = Graph::new();
    let (sx, sy) = (g.symbol("x"), g.symbol("y"));
    let (x, y) = (g.sym(sx), g.sym(sy));
    let e = g.atan2(y, x);
    let gradient = g.gradient(e, &[sx, sy]);
    let tape = Tape::compile(&g, &[e]);
    let slopes = Tape::compile(&g, &gradient);
    let at = [0.6, -1.1];
    let expect = slopes.eval(&at, &(), &mut Workspace::new()).to_vec();
    let along_x = tape.eval_along(&at, &[1.0, 0.0], &())[0].derivative;
    let along_y = tape.eval_along(&at, &[0.0, 1.0], &())[0].derivative;
    assert!((along_x - expect[0]).abs() < 1e-15 && (along_y - expect[1]).abs() < 1e-15);
}
