//! Tests of the graph: constructors, decimals, symbols, rewriting, and what must not overflow.

use super::*;
use std::collections::HashMap;
use std::time::Duration;

fn xy(g: &mut Graph) -> (Expr, Expr) {
    let (x, y) = (g.symbol("x"), g.symbol("y"));
    (g.sym(x), g.sym(y))
}

#[test]
fn equal_expressions_are_one() {
    let mut g = Graph::new();
    let (x, y) = xy(&mut g);
    assert_eq!(g.add(x, y), g.add(y, x));
    assert_eq!(g.mul(x, y), g.mul(y, x));
    assert_ne!(g.sub(x, y), g.sub(y, x));
    assert_ne!(g.div(x, y), g.div(y, x));
    assert_ne!(g.atan2(x, y), g.atan2(y, x));
}

#[test]
fn neutral_elements_vanish() {
    let mut g = Graph::new();
    let (x, _) = xy(&mut g);
    let (zero, one) = (g.int(0), g.int(1));
    assert_eq!(g.add(x, zero), x);
    assert_eq!(g.sub(x, zero), x);
    assert_eq!(g.sub(x, x), zero);
    assert_eq!(g.mul(one, x), x);
    assert_eq!(g.mul(x, zero), zero);
    assert_eq!(g.div(x, one), x);
    assert_eq!(g.div(zero, x), zero);
    assert_eq!(g.powi(x, 1), x);
    assert_eq!(g.powi(x, 0), one);
    let minus = g.neg(x);
    assert_eq!(g.sub(zero, x), minus);
    assert_eq!(g.neg(minus), x);
    let quotient = g.div(x, x);
    assert_ne!(quotient, one, "x may be zero");
}

#[test]
fn constants_fold_exactly() {
    let mut g = Graph::new();
    let (a, b) = (g.ratio(1, 3), g.ratio(-2, 5));
    let expect = [(-1, 15), (11, 15), (-2, 15), (-5, 6)];
    let got = [g.add(a, b), g.sub(a, b), g.mul(a, b), g.div(a, b)];
    for (e, r) in got.into_iter().zip(expect) {
        assert_eq!(g.as_rational(e), Some(r));
    }
    let p = g.powi(a, -3);
    assert_eq!(g.as_rational(p), Some((27, 1)));
    let nine = g.int(9);
    let root = g.sqrt(nine);
    assert_eq!(g.as_rational(root), Some((3, 1)));
}

#[test]
fn division_by_zero_stays() {
    let mut g = Graph::new();
    let (zero, one) = (g.int(0), g.int(1));
    for e in [g.div(one, zero), g.div(zero, zero), g.ratio(1, 0)] {
        assert!(matches!(g.node(e), Node::Div(..)));
    }
    let inverse = g.powi(zero, -1);
    assert!(matches!(g.node(inverse), Node::PowI(_, -1)));
    let back = g.powi(inverse, -1);
    assert!(!g.is_zero(back));
}

#[test]
fn overflow_keeps_the_operation() {
    let mut g = Graph::new();
    let (big, two) = (g.ratio(i128::MAX, 1), g.int(2));
    for e in [g.mul(big, two), g.add(big, two), g.powi(two, 127)] {
        assert_eq!(g.as_rational(e), None);
    }
    let least = g.ratio(i128::MIN, 1);
    let negated = g.neg(least);
    assert!(matches!(g.node(negated), Node::Neg(_)));
}

#[test]
fn powers() {
    let mut g = Graph::new();
    let (x, y) = xy(&mut g);
    let square = g.powi(x, 2);
    assert_eq!(g.powi(square, 3), g.powi(x, 6));
    let (half, third, three) = (g.ratio(1, 2), g.ratio(1, 3), g.int(3));
    assert_eq!(g.pow(x, half), g.sqrt(x));
    assert_eq!(g.pow(x, three), g.powi(x, 3));
    let cube_root = g.pow(x, third);
    assert_eq!(*g.node(cube_root), Node::Pow(x, third));
    let e = g.e();
    assert_eq!(g.pow(e, y), g.call(Func::Exp, y));
    let huge = g.powi(x, i32::MAX);
    let huger = g.powi(huge, 2);
    assert_eq!(*g.node(huger), Node::PowI(huge, 2));
}

#[test]
fn decimals() {
    let mut g = Graph::new();
    for (text, n, d) in [
        ("0.0173", 173, 10_000),
        ("-12", -12, 1),
        ("+.5", 1, 2),
        ("3.", 3, 1),
        ("000", 0, 1),
        ("1200", 1200, 1),
        ("6.5e-1", 13, 20),
        ("2.5E3", 2500, 1),
    ] {
        let e = g.decimal(text).unwrap();
        assert_eq!(g.as_rational(e), Some((n, d)), "{text}");
    }
    for text in ["", "-", ".", "e5", "1e", "1.2.3", "1,5", "٣", "0x10", "1e99999999999", "--1"] {
        assert_eq!(g.decimal(text), None, "{text}");
    }
    let e = g.decimal("6.674e-51").unwrap();
    let (m, ten) = (g.int(6674), g.int(10));
    let power = g.powi(ten, -54);
    assert_eq!(e, g.mul(m, power));
    let long = "1234567890".repeat(20);
    let e = g.decimal(&long).unwrap();
    assert_eq!(g.as_rational(e), None);
    assert!(g.decimal(&format!("0.{}1", "0".repeat(100_000))).is_some());
}

#[test]
fn symbols_and_their_derivatives() {
    let mut g = Graph::new();
    let theta = g.time_symbol("\\theta");
    assert_eq!(g.symbol("\\theta"), theta);
    let (dot, ddot) = (g.derivative_symbol(theta), g.nth_derivative_symbol(theta, 2));
    assert_eq!(g.derivative_symbol(dot), ddot);
    assert_eq!(g.find("\\dot{\\theta}"), Some(dot));
    assert_eq!(g.find("\\ddot{\\theta}"), Some(ddot));
    let third = g.derivative_symbol(ddot);
    assert_eq!(*g.info(third), SymbolInfo { name: "\\theta^{(3)}".into(), base: theta, order: 3, of_t: true });
    let indexed = g.time_symbol("x_{1}'");
    let dot = g.derivative_symbol(indexed);
    assert_eq!(g.info(dot).name, "\\dot{x}_{1}'");
    let bold = g.time_symbol("\\mathbf{r_1}");
    let dot = g.derivative_symbol(bold);
    assert_eq!(g.info(dot).name, "\\dot{\\mathbf{r_1}}");
    assert_eq!(g.find("no such"), None);
}

#[test]
fn substitution_is_simultaneous() {
    let mut g = Graph::new();
    let (x, y) = xy(&mut g);
    let (sx, sy) = (g.symbol("x"), g.symbol("y"));
    let difference = g.sub(x, y);
    let swapped = g.substitute(difference, &HashMap::from([(sx, y), (sy, x)]));
    assert_eq!(swapped, g.sub(y, x));
    let same = g.substitute(difference, &HashMap::from([(sx, y)]));
    assert!(g.is_zero(same));
}

#[test]
fn terms_with_signs() {
    let mut g = Graph::new();
    let (x, y) = xy(&mut g);
    let product = g.mul(x, y);
    let inner = g.sub(x, product);
    let e = g.sub(y, inner);
    assert_eq!(g.terms(e), [(false, y), (true, x), (false, product)]);
    let mut doubled = product;
    for _ in 0..100 {
        doubled = g.add(doubled, doubled);
    }
    assert!(g.terms(doubled).len() < 1 << 21);
}

#[test]
fn many_terms_do_not_overflow_the_stack() {
    let mut g = Graph::new();
    let (sx, t) = (g.time_symbol("x"), g.symbol("t"));
    let mut e = g.sym(sx);
    let x = e;
    for n in 2..=100_000 {
        let n = g.int(n);
        let term = g.div(x, n);
        e = g.add(e, term);
    }
    assert_eq!(g.terms(e).len(), 100_000);
    assert_eq!(g.symbols(&[e]).len(), 1);
    let d = g.time_derivative(e, Some(t));
    assert_eq!(g.terms(d).len(), 100_000);
    let y = g.symbol("y");
    let y = g.sym(y);
    let replaced = g.substitute(e, &HashMap::from([(sx, y)]));
    assert_eq!(g.terms(replaced).len(), 100_000);
    assert!(g.display(e).ends_with('…'));
}

#[test]
fn a_graph_that_outgrows_every_use_takes_in_nothing_more() {
    let mut g = Graph::new();
    let x = g.symbol("x");
    let x = g.sym(x);
    for n in 0..10_000_000 {
        let n = g.int(n);
        g.add(x, n);
    }
    assert_eq!((g.len(), g.cut_short()), (MOST_NODES, Some(Cut::Size)));
    // What is in it can still be asked for, and everything else is answered at once.
    assert_eq!(g.symbols(&[x]).len(), 1);
    assert_eq!(g.time_derivative(x, None), g.int(0));
}

#[test]
fn a_graph_whose_time_is_used_up_takes_in_nothing_more() {
    let mut g = Graph::until(Deadline::after(Some(Duration::ZERO)));
    let x = g.symbol("x");
    let x = g.sym(x);
    (0..10_000).for_each(|n| {
        let n = g.int(n);
        g.add(x, n);
    });
    assert_eq!(g.cut_short(), Some(Cut::Time));
    assert!(g.len() < 5000, "the clock is looked at while the graph grows: {}", g.len());
    assert_eq!(Graph::until(Deadline::after(Some(Duration::from_secs(3600)))).cut_short(), None);
    assert_eq!(Graph::until(Deadline::after(None)).cut_short(), None);
}
