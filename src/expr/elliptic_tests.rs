//! Elliptic functions in graphs: derivatives against dual numbers, differences and series; identities as values and in the
//! prime field.

use super::field::Field;
use super::*;
use crate::number::{Df64, Dual, Elliptic::*, Jet, JetContext, Number, Tracked};
use proptest::prelude::*;

type T = Tracked<Df64>;

fn exact(x: f64) -> T {
    Tracked::exact(Df64::from(x))
}

fn run<N: Number>(g: &Graph, outputs: &[Expr], values: &[(SymId, N)], cx: &N::Context) -> Vec<N> {
    let tape = Tape::compile(g, outputs);
    let value = |s: &SymId| values.iter().find(|(t, _)| t == s).map(|(_, x)| x.clone()).unwrap();
    let inputs: Vec<N> = tape.inputs().iter().map(value).collect();
    tape.eval(&inputs, cx, &mut Workspace::new()).to_vec()
}

fn agree(a: &T, b: &T) -> bool {
    a.is_finite() && b.is_finite() && a.error_log2() < -60.0 && a.minus(b).is_zero_within()
}

/// Arguments at which f is defined, from numbers in (0, 1).
fn arguments(f: Elliptic, at: [f64; 4]) -> Vec<f64> {
    let [a, b, c, d] = at;
    match f {
        CompleteK | CompleteE | CompleteD | CompleteG => vec![a],
        CompletePi => vec![2.0 * a - 1.05, b],
        IncompletePi => vec![9.0 * (a - 0.5), 2.0 * b - 1.05, c],
        Rc | Rf | Rd | Rj => vec![5.0 * a, 3.0 * b, 4.0 * c + 0.1, d],
        _ => vec![12.0 * (a - 0.5), b],
    }
}

fn bench(f: Elliptic) -> (Graph, Expr, Vec<SymId>) {
    let mut g = Graph::new();
    let symbols: Vec<SymId> = ["w", "x", "y", "z"].iter().take(f.arity()).map(|name| g.time_symbol(name)).collect();
    let x: Vec<Expr> = symbols.iter().map(|s| g.sym(*s)).collect();
    let e = g.elliptic(f, &x);
    (g, e, symbols)
}

fn any_function() -> impl Strategy<Value = Elliptic> {
    (0..Elliptic::ALL.len()).prop_map(|i| Elliptic::ALL[i])
}

proptest! {
    #![proptest_config(crate::testing::properties(600))]

    /// The symbolic derivative, that of dual numbers, and the slope between near points, with respect to every argument.
    #[test]
    fn derivatives(f in any_function(), at in prop::array::uniform4(0.02..0.98_f64)) {
        let (mut g, e, symbols) = bench(f);
        let at = arguments(f, at);
        let values = |i: usize, h: f64| -> Vec<(SymId, T)> {
            let moved = |j: usize| exact(at[j]).plus(&exact(if i == j { h } else { 0.0 }));
            symbols.iter().enumerate().map(|(j, s)| (*s, moved(j))).collect()
        };
        for (i, &s) in symbols.iter().enumerate() {
            let first = g.diff(e, s);
            let second = g.diff(first, s);
            let third = g.diff(second, s);
            let here = run(&g, &[first, third], &values(i, 0.0), &());
            let dual: Vec<(SymId, Dual<T>)> = values(i, 0.0).into_iter().enumerate()
                .map(|(j, (s, x))| (s, Dual::new(x, exact(f64::from(u8::from(i == j)))))).collect();
            let forward = &run(&g, &[e], &dual, &())[0].derivative;
            prop_assert!(agree(&here[0], forward), "{f:?} by {i} at {at:?}: {:?} {forward:?}", here[0]);
            let h = f64::exp2(-24.0);
            let (left, right) = (run(&g, &[e], &values(i, -h), &()), run(&g, &[e], &values(i, h), &()));
            let slope = right[0].minus(&left[0]).over(&exact(2.0 * h));
            // (f(x + h) - f(x - h)) / 2h = f' + h² f'''/6 + ..., where f''' changes little within h.
            let off = slope.minus(&here[0]).to_f64().abs();
            let scale = here[1].to_f64().abs() + here[0].to_f64().abs() + 1.0;
            prop_assert!(off <= 0.3 * h * h * scale, "{f:?} by {i} at {at:?}: {slope:?} {:?}", here[0]);
        }
    }

    /// Series of moving arguments against repeated derivatives with respect to time.
    #[test]
    fn series(f in any_function(), at in prop::array::uniform4(0.1..0.9_f64), rates in prop::array::uniform4(-1.0..1.0_f64)) {
        const ORDER: usize = 3;
        let (mut g, e, symbols) = bench(f);
        let at = arguments(f, at);
        let mut orders = vec![e];
        for _ in 0..ORDER {
            let d = g.time_derivative(orders[orders.len() - 1], None);
            orders.push(d);
        }
        // x(t) = x + v t + v t²/3: derivatives v, 2v/3 and 0.
        let third = exact(1.0).over(&exact(3.0));
        let mut values = Vec::new();
        let mut jets = Vec::new();
        for (i, &s) in symbols.iter().enumerate() {
            let (x, v) = (exact(at[i]), exact(rates[i]));
            let w = v.times(&third);
            for (order, value) in [x.clone(), v.clone(), w.plus(&w), exact(0.0)].into_iter().enumerate() {
                values.push((g.nth_derivative_symbol(s, order as u32), value));
            }
            jets.push((s, Jet::new(x, [v, w, exact(0.0)])));
        }
        let expect = run(&g, &orders, &values, &());
        let series = run(&g, &[e], &jets, &JetContext { order: ORDER, inner: () })[0].clone();
        for (order, expect) in expect.iter().enumerate() {
            let got = series.derivative(order).unwrap();
            let lost = expect.error_log2() > -60.0 || got.error_log2() > -60.0; // divisions by small differences
            prop_assert!(lost || agree(&got, expect), "order {order} of {f:?} at {at:?}: {got:?} {expect:?}");
        }
    }

    /// Identities between the functions, within the bounds of their errors.
    #[test]
    fn identities(a in -20.0..20.0_f64, k in 0.0..1.0_f64, n in -2.0..0.9_f64) {
        let (u, k, n) = (exact(a), exact(k), exact(n));
        let of = |f: Elliptic, x: &[&T]| { let mut y = u.clone(); y.set_elliptic(f, x); y };
        let one = exact(1.0);
        let [s, c, d, am] = [Sn, Cn, Dn, Am].map(|f| of(f, &[&u, &k]));
        let (k2, s2) = (k.times(&k), s.times(&s));
        prop_assert!(agree(&s2.plus(&c.times(&c)), &one));
        prop_assert!(agree(&d.times(&d).plus(&k2.times(&s2)), &one));
        prop_assert!(agree(&am.apply(Func::Sin), &s) && agree(&am.apply(Func::Cos), &c));
        prop_assert!(agree(&of(IncompleteF, &[&am, &k]), &u), "F(am u) = u");
        prop_assert!(agree(&of(JacobiD, &[&u, &k]), &of(IncompleteD, &[&am, &k])), "∫ sn²");
        prop_assert!(agree(&of(JacobiG, &[&u, &k]), &of(IncompleteG, &[&am, &k])), "∫ sd²");
        let [f, e, dd] = [IncompleteF, IncompleteE, IncompleteD].map(|f| of(f, &[&u, &k]));
        prop_assert!(agree(&f.minus(&k2.times(&dd)), &e), "E = F - k²D");
        // Legendre's relation: EK' + E'K - KK' = π/2.
        let k1 = one.minus(&k).times(&one.plus(&k)).root();
        prop_assume!(k1.to_f64() > 1e-6 && k.to_f64() > 1e-6);
        let [kk, ee] = [CompleteK, CompleteE].map(|f| of(f, &[&k]));
        let [kk1, ee1] = [CompleteK, CompleteE].map(|f| of(f, &[&k1]));
        let legendre = ee.times(&kk1).plus(&ee1.times(&kk)).minus(&kk.times(&kk1));
        prop_assert!(agree(&legendre, &T::pi(&()).times(&exact(0.5))));
        // Quasi-periods, and a complete integral as an incomplete one.
        let half_pi = T::pi(&()).times(&exact(0.5));
        for (complete, incomplete) in [(CompleteK, IncompleteF), (CompleteE, IncompleteE), (CompleteD, IncompleteD), (CompleteG, IncompleteG)] {
            prop_assert!(agree(&of(complete, &[&k]), &of(incomplete, &[&half_pi, &k])), "{complete:?}");
        }
        prop_assert!(agree(&of(CompletePi, &[&n, &k]), &of(IncompletePi, &[&half_pi, &n, &k])), "Π");
        let quarter = of(CompleteK, &[&k]);
        prop_assert!(agree(&of(Sn, &[&u.plus(&quarter), &k]).times(&d), &c), "sn(u + K) = cd u");
    }
}

/// Whether an expression vanishes at random points of the field; none where none of them is defined.
fn vanishes(g: &Graph, e: Expr) -> Option<bool> {
    let field = Field::new(g, &[e]);
    let mut state = 7_u64;
    let mut random = move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        state ^ state >> 29
    };
    let values = (0..64).filter_map(|_| field.eval(&field.draw(&mut random), 0).at(e)).map(|x| x.vanishes());
    values.take(4).reduce(|a, b| a && b)
}

#[test]
fn the_field_knows_the_curve() {
    let (mut g, sn, symbols) = bench(Sn);
    let (u, k) = (symbols[0], g.sym(symbols[1]));
    let eu = g.sym(u);
    let [cn, dn] = [Cn, Dn].map(|f| g.elliptic(f, &[eu, k]));
    let one = g.int(1);
    let [s2, c2, d2, k2] = [sn, cn, dn, k].map(|e| g.powi(e, 2));
    let ks = g.mul(k2, s2);
    let (sum, dsum) = (g.add(s2, c2), g.add(d2, ks));
    let wrong = g.add(d2, s2);
    for (e, holds) in [(sum, true), (dsum, true), (wrong, false)] {
        let residual = g.sub(e, one);
        assert_eq!(vanishes(&g, residual), Some(holds), "{}", g.display(residual));
    }
    // (d sn/du)² = (1 - sn²)(1 - k² sn²)
    let rate = g.diff(sn, u);
    let (left, right) = (g.powi(rate, 2), [g.sub(one, s2), g.sub(one, ks)]);
    let right = g.product(right);
    let residual = g.sub(left, right);
    assert_eq!(vanishes(&g, residual), Some(true));
    assert_eq!(Field::new(&g, &[residual]).meaningless(), ["an elliptic function"]);
}

#[test]
fn elementary_cases_and_display() {
    let mut g = Graph::new();
    let s = g.symbol("u");
    let u = g.sym(s);
    let k = g.ratio(1, 3);
    let (zero, one) = (g.int(0), g.int(1));
    let pi = g.elliptic(IncompletePi, &[u, k, k]);
    assert_eq!(g.display(pi), "Π(u, (1/3), (1/3))");
    let period = g.elliptic(CompleteK, &[k]);
    assert_eq!(g.display(period), "K((1/3))");
    let dn = g.elliptic(Dn, &[u, zero]);
    assert_eq!(dn, one);
    let sn = g.elliptic(Sn, &[u, one]);
    assert_eq!(g.display(sn), "tanh(u)");
    let at_zero = g.elliptic(Cn, &[zero, k]);
    assert_eq!(at_zero, one);
    // Too few operands are an error of the caller's that must not panic.
    let none = g.elliptic(Rj, &[]);
    assert!(!run::<f64>(&g, &[none], &[], &())[0].is_finite());
    let map = std::collections::HashMap::from([(s, one)]);
    let replaced = g.substitute(pi, &map);
    assert_eq!(g.display(replaced), "Π(1, (1/3), (1/3))");
}
