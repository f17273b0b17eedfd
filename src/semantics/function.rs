//! Functions before their arguments: which factors behind a name are its argument, and what it gives.

use crate::expr::{Expr, Func};
use crate::latex::ast::{Kind, Node, Span};

use super::complex;
use super::elaborate::{Elaborator, Typed};
use super::error::{Error, Result};
use super::juxtaposition::{Item, head_and_power, is_bracket, is_minus_one, latex_of};
use super::sexagesimal;
use super::value::{self, Value};
use super::world::{Joint, Role};

/// The functions of a scalar that are evaluated.
const FUNCTIONS: [&str; 18] = [
    "sin", "cos", "tan", "cot", "sec", "csc", "arcsin", "arccos", "arctan", "sinh", "cosh", "tanh", "coth", "sech",
    "csch", "exp", "ln", "log",
];

/// The name of a function of a scalar, also where it is printed as words: `\text{sech}u`. A second has the name `sec`.
pub(super) fn function_name(head: &Node) -> Option<&str> {
    match &head.kind {
        Kind::Function(name) => Some(name),
        Kind::Text(name) => Some(name.trim()).filter(|name| *name != "sec" && FUNCTIONS.contains(name)),
        _ => None,
    }
}

impl Elaborator<'_> {
    /// A function with its argument; returns the number of items used by the argument.
    pub(super) fn function(
        &mut self,
        name: &str,
        sup: Option<&Node>,
        node: &Node,
        rest: &[Item],
    ) -> Result<(Typed, usize)> {
        let used = self.argument_length(rest);
        if used == 0 {
            return Err(Error::unsupported(format!("\\{name} has no argument here"), &node.span));
        }
        let argument = self.items(&rest[..used])?;
        if !matches!(name, "max" | "min") {
            self.world.join(|| Joint {
                role: Role::Argument(name.to_owned()),
                parts: vec![(latex_of(&rest[..used]), argument.value.clone())],
            });
        }
        let inverse = matches!(sup.map(|s| &s.kind), Some(Kind::Sum(t)) if t.len() == 1 && is_minus_one(&t[0]));
        let name = if inverse { format!("arc{name}") } else { name.to_owned() };
        let result = self.call(&name, argument, &node.span)?;
        let result = self.with_power(result, sup.filter(|_| !inverse), &node.span)?;
        Ok((result, used))
    }

    /// How many items the argument of a function takes.
    fn argument_length(&self, rest: &[Item]) -> usize {
        if matches!(rest.first(), Some(Item::Factor(n)) if is_bracket(n)) {
            return 1;
        }
        if let angle @ 1.. = sexagesimal::length(rest) {
            return angle;
        }
        let mut used = 0;
        let mut only_numbers = true;
        while let Some(Item::Factor(node)) = rest.get(used) {
            let (head, _) = head_and_power(node);
            let ends = match &head.kind {
                Kind::Function(_) | Kind::BigOp(_) | Kind::Styled(..) | Kind::Accent(..) | Kind::Text(_) => true,
                Kind::Dots(_, body) => matches!(body.kind, Kind::Styled(..) | Kind::Accent(..)),
                Kind::Group { .. } => !only_numbers,
                _ => false,
            };
            if ends && used > 0 {
                break;
            }
            used += 1;
            only_numbers &= matches!(head.kind, Kind::Number(_));
            if self.completes_angle(node) || ends {
                break;
            }
        }
        used
    }

    /// Whether a factor holds a symbol whose unit is the radian, so that an argument is complete with it.
    fn completes_angle(&self, node: &Node) -> bool {
        match &node.kind {
            Kind::Frac(num, den) => self.completes_angle(num) || self.completes_angle(den),
            Kind::Juxt(factors) => factors.iter().any(|f| self.completes_angle(f)),
            Kind::Group { body, .. } => self.completes_angle(body),
            _ => self.entry(node).is_some_and(|(entry, _)| entry.is_angle()),
        }
    }

    fn call(&mut self, name: &str, argument: Typed, span: &Span) -> Result<Typed> {
        if let (Value::Matrix(m), "det") = (&argument.value, name) {
            if m.rows != m.cols || m.rows > value::LARGEST_DETERMINANT {
                let of = argument.value.shape();
                return Err(Error::shape(format!("the determinant of {of}: {}", value::DETERMINANTS), span));
            }
            let det = value::determinant(&mut self.world.graph, m);
            return Ok(Typed::new(Value::Scalar(det), format!("det({})", argument.text)));
        }
        if let (Value::Matrix(m), "tr" | "Tr" | "trace") = (&argument.value, name) {
            if m.rows != m.cols {
                return Err(Error::shape(format!("the trace of {}", argument.value.shape()), span));
            }
            let graph = &mut self.world.graph;
            let zero = graph.int(0);
            let sum = (0..m.rows).fold(zero, |sum, k| graph.add(sum, m.data[k * m.cols + k]));
            return Ok(Typed::new(Value::Scalar(sum), format!("tr({})", argument.text)));
        }
        if let (Value::Tuple(items), "max" | "min") = (&argument.value, name) {
            return self.extreme(items, name == "max", span);
        }
        // What Kenzan does not know must not look like a mistake of the author's: the maximum of a tuple, exp of a matrix.
        if !FUNCTIONS.contains(&name) || name == "exp" && matches!(argument.value, Value::Matrix(_)) {
            let of = argument.value.shape();
            return Err(Error::unsupported(format!("the function {name} of {of} is not evaluated yet"), span));
        }
        if let (Value::Complex(re, im), "exp") = (&argument.value, name) {
            let value = complex::exp(&mut self.world.graph, (*re, *im));
            return Ok(Typed::new(value, format!("exp({})", argument.text)));
        }
        if let Value::Complex(..) = argument.value {
            return Err(Error::unsupported(
                format!("the function {name} of a complex number is not evaluated yet"),
                span,
            ));
        }
        let x = self.scalar(&argument, span)?;
        let graph = &mut self.world.graph;
        let one = graph.int(1);
        let reciprocal = |f: Func, graph: &mut crate::expr::Graph| {
            let y = graph.call(f, x);
            graph.div(one, y)
        };
        let value = match name {
            "sin" => graph.call(Func::Sin, x),
            "cos" => graph.call(Func::Cos, x),
            "tan" => graph.call(Func::Tan, x),
            "cot" => reciprocal(Func::Tan, graph),
            "sec" => reciprocal(Func::Cos, graph),
            "csc" => reciprocal(Func::Sin, graph),
            "arcsin" => graph.call(Func::Asin, x),
            "arccos" => graph.call(Func::Acos, x),
            "arctan" => graph.call(Func::Atan, x),
            "sinh" => graph.call(Func::Sinh, x),
            "cosh" => graph.call(Func::Cosh, x),
            "tanh" => graph.call(Func::Tanh, x),
            "coth" => reciprocal(Func::Tanh, graph),
            "sech" => reciprocal(Func::Cosh, graph),
            "csch" => reciprocal(Func::Sinh, graph),
            "exp" => graph.call(Func::Exp, x),
            "ln" | "log" => graph.call(Func::Ln, x),
            _ => {
                return Err(Error::unsupported(format!("the function {name} is not evaluated yet"), span));
            }
        };
        Ok(Typed::new(Value::Scalar(value), format!("{name}({})", argument.text)))
    }

    /// The largest or least of some numbers: of two, half the sum of them and of their distance.
    fn extreme(&mut self, items: &[Value], largest: bool, span: &Span) -> Result<Typed> {
        let mut extreme: Option<Expr> = None;
        for item in items {
            let e = self.scalar(&Typed::new(item.clone(), ""), span)?;
            let graph = &mut self.world.graph;
            extreme = Some(match extreme {
                None => e,
                Some(acc) => {
                    let (sum, difference, two) = (graph.add(acc, e), graph.sub(acc, e), graph.int(2));
                    let distance = graph.call(Func::Abs, difference);
                    let twice = if largest { graph.add(sum, distance) } else { graph.sub(sum, distance) };
                    graph.div(twice, two)
                }
            });
        }
        let e = extreme.ok_or_else(|| Error::unsupported("the largest of nothing", span))?;
        Ok(Typed::new(Value::Scalar(e), if largest { "max" } else { "min" }))
    }
}
