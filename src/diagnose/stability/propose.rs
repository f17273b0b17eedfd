//! Stable forms found by rewriting: all forms that the identities lead to, in an e-graph, and of these the one that
//! loses fewest bits at given states.

use std::sync::OnceLock;
use std::time::Duration;

use egg::Runner;

use crate::breakdown::caught;
use crate::check::computed::Variable;
use crate::expr::{Expr, Graph, Tape, Workspace};
use crate::number::{Df64, Tracked};

use super::extract::{Extractor, Leaves};
use super::meter::places;
use super::rules::{Constants, Rule, rules};
use super::term::{Term, expression, term};

/// The largest formula that is rewritten, in operations.
const LARGEST: usize = 60;
/// How often all rules are tried, and the size at which the e-graph is large enough.
const ITERATIONS: usize = 7;
const NODES: usize = 6_000;
/// What ends a run is its size, never the clock: the same formula has the same forms on every machine.
const FOREVER: Duration = Duration::from_secs(3600);

/// The form of an expression that loses fewest bits at these states; `None` where none is better than the expression
/// itself, as far as was searched, or it is too large.
pub fn propose(graph: &mut Graph, e: Expr, variables: &[Variable], states: &[Vec<f64>]) -> Option<Expr> {
    // A panic within egg costs a proposal, and no more.
    caught(|| search(graph, e, variables, states)).ok().flatten()
}

fn search(graph: &mut Graph, e: Expr, variables: &[Variable], states: &[Vec<f64>]) -> Option<Expr> {
    let (begin, leaves) = term(graph, e);
    let size = begin.as_ref().len();
    if size > LARGEST || states.is_empty() {
        return None;
    }
    let values = leaf_values(graph, &leaves, variables, states);
    static RULES: OnceLock<Vec<Rule>> = OnceLock::new();
    let runner: Runner<Term, Constants, ()> = Runner::default()
        .with_expr(&begin)
        .with_iter_limit(ITERATIONS)
        .with_node_limit(NODES)
        .with_time_limit(FOREVER)
        .run(RULES.get_or_init(rules));
    let root = *runner.roots.first()?;
    let best = Extractor::new(&runner.egraph, &values, 2 * size + 20).best(root)?;
    expression(graph, &best, &leaves).filter(|new| *new != e)
}

/// The leaves' values at the states.
fn leaf_values(graph: &Graph, leaves: &[Expr], variables: &[Variable], states: &[Vec<f64>]) -> Vec<Leaves> {
    let tape = Tape::compile(graph, leaves);
    let places = places(&tape, variables);
    let (mut quick, mut fine) = (Workspace::<f64>::new(), Workspace::<Tracked<Df64>>::new());
    let mut values = Vec::new();
    for state in states {
        let inputs: Vec<f64> = places.iter().map(|p| state[*p]).collect();
        let exact: Vec<_> = inputs.iter().map(|x| Tracked::exact(Df64::from(*x))).collect();
        let rough = tape.eval(&inputs, &(), &mut quick).to_vec();
        values.push(Leaves { rough, fine: tape.eval(&exact, &(), &mut fine).to_vec() });
    }
    values
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::Random;
    use crate::diagnose::stability::{same, search as searching};
    use crate::expr::Func;

    /// The bits that an expression of x in (0, 1] and y in [1, 2] and its proposal lose at worst.
    fn before_and_after(build: impl Fn(&mut Graph, Expr, Expr) -> Expr) -> (f64, f64, String) {
        let mut graph = Graph::new();
        let (x, y) = (graph.symbol("x"), graph.symbol("y"));
        let (ex, ey) = (graph.sym(x), graph.sym(y));
        let e = build(&mut graph, ex, ey);
        let variables = [(x, "x", [0.0, 1.0]), (y, "y", [1.0, 2.0])].map(|(symbol, tex, range)| Variable {
            symbol,
            tex: tex.into(),
            range,
            integer: false,
        });
        let effort = searching::Effort { random: 32, steps: 300 };
        let run = |graph: &Graph, e: Expr| {
            searching::search(graph, &[e], &[], &variables, &[], effort, &mut Random::new(1, "test")).unwrap()
        };
        let found = run(&graph, e);
        let new = propose(&mut graph, e, &variables, &[found.worst.state, found.fault.state.clone()]).unwrap();
        assert!(same::same(&mut graph, &[e], &[new], &variables, &mut Random::new(1, "same")).holds());
        (found.fault.loss.fault(), run(&graph, new).fault.loss.fault(), graph.display(new))
    }

    #[test]
    fn planted_cancellations_are_found_and_mended() {
        // 1 - cos x; √(y² + x) - y; 1/y - 1/(x + y).
        let (before, after, form) = before_and_after(|g, x, _| {
            let (one, cos) = (g.int(1), g.call(Func::Cos, x));
            g.sub(one, cos)
        });
        assert!(before > 40.0 && after < 4.0, "{before} {after} {form}");
        let (before, after, form) = before_and_after(|g, x, y| {
            let square = g.powi(y, 2);
            let sum = g.add(square, x);
            let root = g.sqrt(sum);
            g.sub(root, y)
        });
        assert!(before > 40.0 && after < 4.0, "{before} {after} {form}");
        let (before, after, form) = before_and_after(|g, x, y| {
            let (one, sum) = (g.int(1), g.add(x, y));
            let (a, b) = (g.div(one, y), g.div(one, sum));
            g.sub(a, b)
        });
        assert!(before > 40.0 && after < 8.0, "{before} {after} {form}");
    }

    #[test]
    fn a_stable_formula_has_no_fault() {
        let mut graph = Graph::new();
        let x = graph.symbol("x");
        let e = graph.sym(x);
        let (square, two) = (graph.powi(e, 2), graph.int(2));
        let e = graph.mul(square, two);
        let variables = [Variable { symbol: x, tex: "x".into(), range: [0.5, 2.0], integer: false }];
        let effort = searching::Effort { random: 32, steps: 200 };
        let found = searching::search(&graph, &[e], &[], &variables, &[], effort, &mut Random::new(1, "test")).unwrap();
        assert!(found.fault.loss.fault() < 2.0, "{found:?}");
    }
}
