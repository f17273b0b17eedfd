//! Random graphs: the tape against plain evaluation, symbolic derivatives against dual numbers, central differences and
//! jets.

use super::tape_tests::evaluate;
use super::*;
use crate::number::{Df64, Dual, Func, Jet, JetContext, Number, Tracked};
use proptest::prelude::*;
use std::collections::HashMap;

/// A recipe for one node: which operation, on which earlier nodes.
type Step = (u8, u8, u8, i8);

const SYMBOLS: [&str; 3] = ["x", "y", "z"];

/// Builds the expression. Arguments of functions with a limited domain are brought into it, so that most values are
/// finite. `abs` and `sign` are left out: they have no derivative at zero.
fn build(g: &mut Graph, steps: &[Step]) -> Expr {
    let mut pool: Vec<Expr> = SYMBOLS.map(|name| g.time_symbol(name)).map(|s| g.sym(s)).into();
    pool.extend([g.ratio(2, 3), g.pi(), g.int(-3)]);
    for &(operation, i, j, n) in steps {
        let (a, b) = (pool[i as usize % pool.len()], pool[j as usize % pool.len()]);
        let one = g.int(1);
        let tame = g.call(Func::Sin, a); // within [-1, 1]
        let half = g.ratio(1, 2);
        let inner = g.mul(half, tame);
        let square = g.powi(a, 2);
        let positive = g.add(one, square);
        let node = match operation % 24 {
            0 | 1 => g.add(a, b),
            2 | 3 => g.sub(a, b),
            4 | 5 => g.mul(a, b),
            6 => g.div(a, b),
            7 => g.powi(a, i32::from(n % 5)),
            8 => g.pow(positive, inner),
            9 => g.sqrt(positive),
            10 => g.neg(a),
            11 => g.atan2(a, b),
            12 => g.call(Func::Cos, a),
            13 => g.call(Func::Tan, inner),
            14 => g.call(Func::Asin, inner),
            15 => g.call(Func::Acos, inner),
            16 => g.call(Func::Atan, a),
            17 => g.call(Func::Sinh, inner),
            18 => g.call(Func::Cosh, inner),
            19 => g.call(Func::Tanh, a),
            20 => g.call(Func::Asinh, a),
            21 => g.call(Func::Acosh, positive),
            22 => g.call(Func::Atanh, inner),
            _ => {
                let ln = g.call(Func::Ln, positive);
                let exp = g.call(Func::Exp, inner);
                g.mul(ln, exp)
            }
        };
        pool.push(node);
    }
    pool[pool.len() - 1]
}

fn steps(most: usize) -> impl Strategy<Value = Vec<Step>> {
    prop::collection::vec(any::<Step>(), 1..most)
}

fn state() -> impl Strategy<Value = [f64; 3]> {
    prop::array::uniform3(0.2..1.7_f64)
}

/// The state as values of the graph's symbols.
fn values<N: Clone>(g: &Graph, at: &[N; 3]) -> HashMap<SymId, N> {
    SYMBOLS.iter().zip(at).filter_map(|(name, x)| Some((g.find(name)?, x.clone()))).collect()
}

fn run<N: Number>(g: &Graph, outputs: &[Expr], values: &HashMap<SymId, N>, cx: &N::Context) -> Vec<N> {
    let tape = Tape::compile(g, outputs);
    let inputs: Vec<_> = tape.inputs().iter().map(|s| values[s].clone()).collect();
    tape.eval(&inputs, cx, &mut Workspace::new()).to_vec()
}

/// Whether two bounded values can be the same number.
fn agree(a: &Tracked<Df64>, b: &Tracked<Df64>) -> bool {
    a.minus(b).is_zero_within()
}

proptest! {
    #![proptest_config(crate::testing::properties(400))]

    /// Bit for bit, in machine numbers (sine and cosine together are the same as apart).
    #[test]
    fn the_tape_is_the_graph(steps in steps(40), at in state()) {
        let mut g = Graph::new();
        let e = build(&mut g, &steps);
        let values = values(&g, &at);
        let expect = evaluate(&g, e, &values, &());
        let got = run(&g, &[e], &values, &())[0];
        prop_assert!(got.to_bits() == expect.to_bits() || (got.is_nan() && expect.is_nan()), "{} {got} {expect}", g.display(e));
    }

    /// The symbolic derivative and that of dual numbers, within the bounds of both.
    #[test]
    fn derivatives_are_those_of_dual_numbers(steps in steps(14), at in state()) {
        let mut g = Graph::new();
        let e = build(&mut g, &steps);
        let exact = at.map(|x| Tracked::exact(Df64::from(x)));
        let x = g.find("x").unwrap();
        let d = g.diff(e, x);
        let symbolic = run(&g, &[d], &values(&g, &exact), &())[0].clone();
        let mut dual = exact.clone().map(Dual::constant);
        dual[0].derivative = exact[0].like(1.0);
        let forward = run(&g, &[e], &values(&g, &dual), &())[0].derivative.clone();
        prop_assert!(agree(&symbolic, &forward), "d/dx of {} is {symbolic:?} or {forward:?}", g.display(e));
    }

    /// The symbolic derivative and the slope between two near points, where the function is smooth there.
    #[test]
    fn derivatives_are_slopes(steps in steps(10), at in state()) {
        let mut g = Graph::new();
        let e = build(&mut g, &steps);
        let x = g.find("x").unwrap();
        let mut orders = vec![e];
        for _ in 0..3 {
            let d = g.diff(orders[orders.len() - 1], x);
            orders.push(d);
        }
        let shifted = |h: f64| {
            let mut at = at.map(|x| Tracked::exact(Df64::from(x)));
            at[0] = at[0].plus(&at[0].like(h));
            run(&g, &orders, &values(&g, &at), &())
        };
        let h = f64::exp2(-30.0);
        let (left, here, right) = (shifted(-h), shifted(0.0), shifted(h));
        prop_assume!([&left, &here, &right].iter().all(|v| v.iter().all(|v| v.error_log2() < -60.0)));
        // (f(x + h) - f(x - h)) / 2h = f' + h² f'''/6 + ..., where f''' hardly changes within h.
        let (third, before, after) = (here[3].to_f64(), left[3].to_f64(), right[3].to_f64());
        prop_assume!((before - after).abs() <= 1e-3 * third.abs() + 1e-3);
        let slope = right[0].minus(&left[0]).over(&here[0].like(2.0 * h));
        let off = slope.minus(&here[1]).to_f64().abs();
        let bound = h * h / 6.0 * (third.abs() * 1.01 + 0.01) + slope.error_log2().exp2() + here[1].error_log2().exp2();
        prop_assert!(off <= bound, "{off} beyond {bound} for {}", g.display(e));
    }

    /// Taylor coefficients of a motion against repeated symbolic time derivatives.
    #[test]
    fn jets_are_time_derivatives(steps in steps(6), at in state(), rates in prop::array::uniform9(-1.0..1.0_f64)) {
        const ORDER: usize = 3;
        let mut g = Graph::new();
        let e = build(&mut g, &steps);
        let mut orders = vec![e];
        for _ in 0..ORDER {
            let d = g.time_derivative(orders[orders.len() - 1], None);
            orders.push(d);
        }
        let exact = |x: f64| Tracked::exact(Df64::from(x));
        let mut at_once = HashMap::new();
        let mut jets = HashMap::new();
        for (i, name) in SYMBOLS.iter().enumerate() {
            let s = g.find(name).unwrap();
            let derivatives = [at[i], rates[3 * i], rates[3 * i + 1], rates[3 * i + 2]].map(exact);
            for (order, value) in derivatives.iter().enumerate() {
                at_once.insert(g.nth_derivative_symbol(s, order as u32), value.clone());
            }
            let factorials = [1.0, 1.0, 2.0, 6.0];
            let coefficients = derivatives.iter().zip(factorials).map(|(d, f)| d.over(&d.like(f)));
            let mut coefficients = coefficients.collect::<Vec<_>>().into_iter();
            jets.insert(s, Jet::new(coefficients.next().unwrap(), coefficients));
        }
        let symbolic = run(&g, &orders, &at_once, &());
        let series = run(&g, &[e], &jets, &JetContext { order: ORDER, inner: () })[0].clone();
        for (order, expect) in symbolic.iter().enumerate() {
            let got = series.derivative(order).unwrap();
            prop_assert!(agree(&got, expect), "order {order} of {}: {got:?} {expect:?}", g.display(e));
        }
    }

    /// Substituting constants and evaluating is evaluating there.
    #[test]
    fn substitution_is_evaluation(steps in steps(20), n in prop::array::uniform3(1_i64..9)) {
        let mut g = Graph::new();
        let e = build(&mut g, &steps);
        let map: HashMap<SymId, Expr> = SYMBOLS.iter().zip(n).map(|(name, n)| (g.find(name).unwrap(), g.ratio(n.into(), 4))).collect();
        let replaced = g.substitute(e, &map);
        prop_assert!(g.symbols(&[replaced]).is_empty());
        let at = n.map(|n| Tracked::exact(Df64::from(n as f64 / 4.0)));
        let expect = run(&g, &[e], &values(&g, &at), &())[0].clone();
        let got = run::<Tracked<Df64>>(&g, &[replaced], &HashMap::new(), &())[0].clone();
        prop_assert!(agree(&got, &expect), "{}: {got:?} {expect:?}", g.display(e));
    }
}
