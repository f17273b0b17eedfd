//! Expressions of a graph as LaTeX that Kenzan reads.

use crate::check::computed::{Variable, expressions};
use crate::check::{Book, Random};
use crate::expr::{Elliptic, Expr, Func, Graph, Node};
use crate::semantics::World;

use super::same::same;

/// How tightly the outermost operation binds.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Binding {
    Sum,
    Product,
    Function,
    Atom,
}

/// The longest LaTeX that is written.
const LONGEST: usize = 2_000;
/// The deepest expression that is written.
const DEEPEST: usize = 40;

/// An expression as LaTeX which, read where an equation stands, is the same formula; `None` where there is none.
pub fn readable(
    world: &mut World,
    e: Expr,
    (book, index): (&Book, usize),
    variables: &[Variable],
    random: &mut Random,
) -> Option<String> {
    let latex = to_latex(world, e)?;
    let again = expressions(world, book, index, &latex).ok()?;
    same(&mut world.graph, &[e], &again, variables, random).holds().then_some(latex)
}

/// An expression as LaTeX; `None` where it has what is never printed, or is too large.
pub fn to_latex(world: &World, e: Expr) -> Option<String> {
    let (latex, _) = written(world, e, 0)?;
    (latex.len() <= LONGEST).then_some(latex)
}

fn bracketed((latex, binding): (String, Binding), least: Binding) -> String {
    if binding >= least { latex } else { format!(r"\left( {latex} \right)") }
}

fn written(world: &World, e: Expr, depth: usize) -> Option<(String, Binding)> {
    if depth > DEEPEST {
        return None;
    }
    let graph: &Graph = &world.graph;
    let of = |a: Expr| written(world, a, depth + 1).filter(|(latex, _)| latex.len() <= LONGEST);
    let at_least = |a: Expr, least: Binding| of(a).map(|w| bracketed(w, least));
    Some(match *graph.node(e) {
        Node::Rational(n, 1) if n >= 0 => (n.to_string(), Binding::Atom),
        Node::Rational(n, 1) => (n.to_string(), Binding::Sum),
        Node::Rational(n, d) if n >= 0 => (format!(r"\frac{{{n}}}{{{d}}}"), Binding::Atom),
        Node::Rational(n, d) => (format!(r"-\frac{{{}}}{{{d}}}", n.unsigned_abs()), Binding::Sum),
        Node::Pi => (r"\pi".into(), Binding::Atom),
        Node::E => ("e".into(), Binding::Atom),
        Node::Symbol(s) => (world.tex(s), Binding::Atom),
        Node::Neg(a) => (format!("-{}", at_least(a, Binding::Product)?), Binding::Sum),
        Node::Add(a, b) if is_negative(graph, a) && !is_negative(graph, b) => sum(of(b)?.0, of(a)?, true),
        Node::Add(a, b) => sum(of(a)?.0, of(b)?, is_negative(graph, b)),
        Node::Sub(a, b) => (format!("{} - {}", of(a)?.0, at_least(b, Binding::Product)?), Binding::Sum),
        Node::Mul(a, b) => {
            // Numbers first, and never two numbers side by side.
            let (a, b) = if graph.as_rational(b).is_some() { (b, a) } else { (a, b) };
            let negative = matches!(graph.node(a), Node::Rational(..)) && is_negative(graph, a);
            let left = if negative { of(a)?.0 } else { at_least(a, Binding::Product)? };
            let right = at_least(b, Binding::Product)?;
            let dot = if right.starts_with(|c: char| c.is_ascii_digit()) { r" \cdot " } else { " " };
            (format!("{left}{dot}{right}"), if negative { Binding::Sum } else { Binding::Product })
        }
        Node::Div(a, b) => (format!(r"\frac{{{}}}{{{}}}", of(a)?.0, of(b)?.0), Binding::Atom),
        Node::PowI(a, n) => match *graph.node(a) {
            Node::Call(f, x) if n > 0 && power_of_name(f) => {
                (format!("{}^{{{n}}} {}", name(f)?, at_least(x, Binding::Atom)?), Binding::Function)
            }
            _ => (format!("{}^{{{n}}}", base(world, a, depth)?), Binding::Atom),
        },
        Node::Pow(a, b) => (format!("{}^{{{}}}", base(world, a, depth)?, of(b)?.0), Binding::Atom),
        Node::Sqrt(a) => (format!(r"\sqrt{{{}}}", of(a)?.0), Binding::Atom),
        Node::Call(Func::Exp, a) => (format!("e^{{{}}}", of(a)?.0), Binding::Atom),
        Node::Call(Func::Abs, a) => (format!(r"\left| {} \right|", of(a)?.0), Binding::Atom),
        Node::Call(f, a) => (format!("{} {}", name(f)?, at_least(a, Binding::Atom)?), Binding::Function),
        Node::Elliptic(f, [u, k, ..]) if f.arity() == 2 => {
            (format!(r"{}({}, {})", elliptic(f)?, of(u)?.0, of(k)?.0), Binding::Function)
        }
        Node::Elliptic(f, [k, ..]) if f.arity() == 1 => (format!("{}({})", elliptic(f)?, of(k)?.0), Binding::Function),
        Node::Elliptic(..) | Node::Atan2(..) | Node::Integral(_) => return None,
    })
}

/// Whether an expression is written with a minus in front.
fn is_negative(graph: &Graph, e: Expr) -> bool {
    let number = |e: Expr| matches!(graph.node(e), Node::Rational(n, _) if *n < 0);
    match *graph.node(e) {
        Node::Neg(_) => true,
        Node::Mul(a, b) => number(a) || number(b),
        _ => number(e),
    }
}

/// a + b, written as a - c where b is -c.
fn sum(left: String, right: (String, Binding), negative: bool) -> (String, Binding) {
    match right.0.strip_prefix('-').filter(|_| negative) {
        Some(rest) => (format!("{left} - {rest}"), Binding::Sum),
        // A sum within a sum keeps its bracket: another order loses other digits.
        None => (format!("{left} + {}", bracketed(right, Binding::Product)), Binding::Sum),
    }
}

/// What a power is taken of.
fn base(world: &World, a: Expr, depth: usize) -> Option<String> {
    let (latex, binding) = written(world, a, depth + 1)?;
    let plain = matches!(world.graph.node(a), Node::Symbol(_) | Node::Pi) && !latex.contains(['^', '\'']);
    let number = matches!(world.graph.node(a), Node::Rational(n, 1) if *n >= 0);
    Some(if plain || number { latex } else { bracketed((latex, binding.min(Binding::Function)), Binding::Atom) })
}

/// Whether a power may stand at the name of a function.
fn power_of_name(f: Func) -> bool {
    !matches!(f, Func::Exp | Func::Abs | Func::Sign | Func::Ln)
}

fn name(f: Func) -> Option<&'static str> {
    Some(match f {
        Func::Sin => r"\sin",
        Func::Cos => r"\cos",
        Func::Tan => r"\tan",
        Func::Asin => r"\arcsin",
        Func::Acos => r"\arccos",
        Func::Atan => r"\arctan",
        Func::Sinh => r"\sinh",
        Func::Cosh => r"\cosh",
        Func::Tanh => r"\tanh",
        Func::Atanh => r"\operatorname{artanh}",
        Func::Ln => r"\ln",
        _ => return None,
    })
}

fn elliptic(f: Elliptic) -> Option<&'static str> {
    Some(match f {
        Elliptic::Sn => r"\operatorname{sn}",
        Elliptic::Cn => r"\operatorname{cn}",
        Elliptic::Dn => r"\operatorname{dn}",
        Elliptic::Am => r"\operatorname{am}",
        Elliptic::CompleteK => r"\operatorname{K}",
        Elliptic::CompleteE | Elliptic::IncompleteE => r"\operatorname{E}",
        Elliptic::IncompleteF => r"\operatorname{F}",
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::computed::computed_from;
    use crate::expr::Deadline;
    use std::path::Path;

    /// What is written is read back as the same formula.
    #[test]
    fn what_is_written_is_read() {
        let notes = "<!-- kenzan\n[symbols]\n\"a, b, x'\" = { range = [0.3, 0.9] }\n'k' = { range = [0.3, 0.9] }\n-->\n\n\
            $$ a = b \\tag{1} $$\n";
        let book = Book::new(&crate::document::parse(Path::new("notes.md"), notes));
        for latex in [
            r"a - (b - k)",
            r"-a b + (-3) \cos^2 b - \frac{1}{8}",
            r"\frac{-a}{b} (a - b)^2 x'^2",
            r"\sin(2 a) \sqrt{1 - \sin^2 (a b)}",
            r"(-3)(-a)(b - 2) + (-k)^3",
            r"2 \arctan \sqrt{\frac{1 - a}{1 + a}} e^{-a} \left| b - k \right|",
            r"\operatorname{sn}^2(a, k) \operatorname{dn}(a b, k)",
            r"3 \cdot \frac{1}{2} \cdot 4^{a}",
        ] {
            let mut formula = computed_from(&book, 0, latex, Deadline::NEVER).unwrap();
            let written = to_latex(&formula.world, formula.outputs[0]).unwrap();
            let again = expressions(&mut formula.world, &book, 0, &written).unwrap();
            let variables = formula.variables(&formula.outputs);
            let outputs = formula.outputs.clone();
            let found = same(&mut formula.world.graph, &outputs, &again, &variables, &mut Random::new(1, latex));
            assert!(found.holds(), "{latex} was written {written}: {found:?}");
        }
    }
}
