//! Derivatives, differentials, bases that rotate, and the values that indices run through.

use crate::expr::{Expr, Graph};
use crate::latex::ast::{BigOp, Font, Kind, Node, Span};

use super::elaborate::{Elaborator, MOST_ALIASES, Typed};
use super::element::is_integral;
use super::error::{Error, Result};
use super::juxtaposition::Item;
use super::name::spelling;
use super::scope::{Basis, EntryKind};
use super::units::Dimension;
use super::value::{self, Matrix, Value};
use super::world::{Facts, Quantity};

/// A derivative written as a fraction.
pub(super) struct Derivative {
    /// The variables, one for each time it is taken; `t` by its name.
    variables: Vec<Node>,
    /// What stands in the numerator behind the `d`; `None` where the fraction is an operator.
    pub(super) operand: Option<Vec<Node>>,
}

impl Elaborator<'_> {
    /// Whether a factor is the d of a differential rather than a quantity d.
    pub(super) fn is_differential_sign(&self, node: &Node) -> bool {
        is_d(node) && !self.is_declared(node)
    }

    /// Reads `\frac{d X}{dt}`, `\frac{d^2}{dt^2}`, `\frac{\partial F}{\partial x}`; `None` for an ordinary quotient.
    pub(super) fn derivative(&self, num: &Node, den: &Node) -> Option<Derivative> {
        if is_d(num) && self.is_declared(num) {
            return None;
        }
        let (order, operand) = numerator(num)?;
        let factors = match &den.kind {
            Kind::Juxt(factors) => factors.as_slice(),
            _ => return None,
        };
        let mut variables = Vec::new();
        for pair in factors.chunks(2) {
            let [d, variable] = pair else { return None };
            if !is_d(d) {
                return None;
            }
            let (variable, times) = variable_and_order(variable);
            variables.extend(std::iter::repeat_n(variable, times));
        }
        (variables.len() == order).then_some(Derivative { variables, operand })
    }

    /// The derivative of a value.
    pub(super) fn derived(&mut self, derivative: &Derivative, inner: Typed, span: &Span) -> Result<Typed> {
        let mut value = inner.value;
        let mut text = inner.text;
        for variable in &derivative.variables {
            let name = spelling(variable);
            if let Some(variables) = several(variable) {
                // By several variables: the tuple of the derivatives by each.
                let each = variables.iter().map(|x| self.partial(&value, x, span)).collect::<Result<_>>()?;
                value = Value::Tuple(each);
            } else if name == "t" || self.is_time(variable) {
                value = self.time_derivative(&value, 1);
            } else {
                value = self.partial(&value, variable, span)?;
            }
            text = format!("d/d{name}({text})");
        }
        Ok(Typed::new(value, text))
    }

    /// The n-th derivative with respect to time.
    pub(super) fn time_derivative(&mut self, value: &Value, n: u32) -> Value {
        let mut value = value.clone();
        for _ in 0..n {
            let t = self.world.graph.find("t");
            value = value.map(&mut |e| match self.world.is_within_integral(e) {
                // Over the time that it is integrated over, and not over this one: not known, so that it has no value.
                true => self.world.graph.ratio(1, 0),
                false => self.world.graph.time_derivative(e, t),
            });
        }
        value
    }

    /// `dx`: the differential of what follows, its time derivative times `dt`.
    pub(super) fn differential(&mut self, operand: &Node) -> Result<Typed> {
        let dt = self.world.symbol("dt", false, || Facts {
            tex: "dt".into(),
            quantity: Some(Quantity::of(Dimension::TIME)),
            ..Facts::default()
        });
        let dt = self.world.graph.sym(dt);
        if spelling(operand) == "t" {
            return Ok(Typed::new(Value::Scalar(dt), "dt"));
        }
        let inner = self.value(operand)?;
        let rate = self.time_derivative(&inner.value, 1);
        let graph = &mut self.world.graph;
        Ok(Typed::new(rate.map(&mut |e| graph.mul(e, dt)), format!("d({})", inner.text)))
    }

    // ---- bases ------------------------------------------------------------------------------------------------

    /// Builds the triads of all declared bases. What is wrong with one shows where it is used.
    pub fn build_bases(&mut self) {
        let names: Vec<String> = self.scope.bases().map(|b| b.name.clone()).collect();
        for name in names {
            let _ = self.triad(&name, &(0..0));
        }
    }

    fn basis(&self, name: &str, span: &Span) -> Result<Basis> {
        self.scope.basis(name).cloned().ok_or_else(|| {
            Error::undeclared(format!("undeclared basis {name}"), span)
                .with_help(format!("declare it under [basis.{name}]"))
        })
    }

    /// The three vectors of a basis, in inertial components. A rotating basis is turned by its Euler angles, or where
    /// the notes have none, by angles of our own: any rotation of space has them.
    pub(super) fn triad(&mut self, name: &str, span: &Span) -> Result<[[Expr; 3]; 3]> {
        if let Some(triad) = self.world.triad(name) {
            return Ok(triad);
        }
        let basis = self.basis(name, span)?;
        let graph = &mut self.world.graph;
        let (zero, one) = (graph.int(0), graph.int(1));
        let mut triad = [[one, zero, zero], [zero, one, zero], [zero, zero, one]];
        if basis.rotating {
            let angles = self.angles(&basis, span)?;
            // r = R1 R2 R3 applied to the unit vectors: the last turn is the innermost.
            for (angle, axis) in angles.iter().zip(basis.order.chars().collect::<Vec<_>>()).rev() {
                triad = triad.map(|v| turned(&mut self.world.graph, &v, *angle, axis));
            }
        }
        self.world.set_triad(name, triad);
        Ok(triad)
    }

    fn angles(&mut self, basis: &Basis, span: &Span) -> Result<[Expr; 3]> {
        let mut angles = Vec::new();
        for k in 0..3 {
            angles.push(match &basis.euler {
                Some(names) => {
                    let angle = self.value(&names[k])?;
                    self.scalar(&angle, span)?
                }
                None => {
                    let tex = format!("\\alpha_{{{}\\text{{ of {}}}}}", k + 1, basis.name);
                    let id = self.world.symbol(&tex.clone(), true, || Facts {
                        tex,
                        range: Some([0.3, 1.2]),
                        quantity: Some(Quantity::of(Dimension::NONE)),
                        ..Facts::default()
                    });
                    self.world.graph.sym(id)
                }
            });
        }
        angles.try_into().map_err(|_| Error::unsupported("a basis has three angles", span))
    }

    /// The angular velocity ω of a basis: the vector with ė = ω × e for each of its vectors, half the sum of e × ė.
    pub(super) fn angular_velocity(&mut self, name: &str, span: &Span) -> Result<[Expr; 3]> {
        let triad = self.triad(name, span)?;
        let graph = &mut self.world.graph;
        let half = graph.ratio(1, 2);
        let mut omega = [graph.int(0); 3];
        for e in &triad {
            let rate = e.map(|c| graph.time_derivative(c, None));
            let cross = value::cross3(graph, e, &rate);
            omega = [0, 1, 2].map(|k| graph.add(omega[k], cross[k]));
        }
        Ok(omega.map(|c| graph.mul(half, c)))
    }

    /// The component of a vector along an axis of a basis; of a column, its entry.
    pub(super) fn component(&mut self, whole: &Typed, basis: &str, axis: usize, span: &Span) -> Result<Typed> {
        let e = match &whole.value {
            Value::Vector(v) => {
                let triad = self.triad(basis, span)?;
                value::dot3(&mut self.world.graph, v, &triad[axis])
            }
            Value::Matrix(m) if m.cols == 1 && axis < m.rows => m.data[axis],
            other => return Err(Error::shape(format!("{} has no component along an axis", other.shape()), span)),
        };
        Ok(Typed::new(Value::Scalar(e), format!("[{}]_{}", whole.text, axis + 1)))
    }

    /// The column of a vector's components in the basis that columns are written in.
    pub(super) fn as_column(&mut self, vector: &Value, span: &Span) -> Result<Value> {
        let Value::Vector(v) = vector else { return Ok(vector.clone()) };
        let Some(basis) = self.scope.column_basis().map(|b| b.name.clone()) else {
            return Err(Error::undeclared(
                "a vector meets a matrix, and no basis says which components are meant",
                span,
            )
            .with_help("set columns = true in the [basis.NAME] that columns are written in"));
        };
        let triad = self.triad(&basis, span)?;
        let data = triad.iter().map(|e| value::dot3(&mut self.world.graph, v, e)).collect();
        Ok(Value::Matrix(Matrix { rows: 3, cols: 1, data }))
    }

    // ---- indices ----------------------------------------------------------------------------------------------

    /// The whole number that stands where only such a number may.
    pub(super) fn integer(&mut self, node: &Node) -> Result<i64> {
        let typed = self.value(node)?;
        let e = self.scalar(&typed, &node.span)?;
        match self.world.graph.as_rational(e) {
            Some((n, 1)) => i64::try_from(n).map_err(|_| Error::unsupported("this bound is too large", &node.span)),
            _ => Err(Error::unsupported("the bounds of a sum must be integers", &node.span)),
        }
    }

    /// The declared indices that occur in some items and have no value yet, in order of occurrence. Sums within bind
    /// their own.
    pub(super) fn unbound_indices(&self, items: &[Item]) -> Vec<String> {
        let mut found = Vec::new();
        let mut bound = Vec::new();
        for item in items {
            if let Item::Factor(node) = item {
                self.collect_indices(node, &mut bound, &mut found);
            }
        }
        found
    }

    /// What stands in the scripts of a name are letters, not quantities.
    fn collect_letters(&self, name: &Node, bound: &[String], found: &mut Vec<String>) {
        letters(name, &mut |s| {
            let open = self.scope.index(s).is_some() && self.index_value(s).is_none();
            if open && !bound.contains(s) && !found.contains(s) {
                found.push(s.clone());
            }
        });
    }

    fn collect_indices(&self, node: &Node, bound: &mut Vec<String>, found: &mut Vec<String>) {
        if let Kind::Symbol(s) = &node.kind
            && self.scope.index(s).is_some()
            && self.index_value(s).is_none()
            && !bound.contains(s)
            && !found.contains(s)
        {
            found.push(s.clone());
        }
        if let Some(entry) = self.scope.get(&super::scope::pattern_of(self.scope, node)) {
            let open = |letter: &&String| self.index_value(letter).is_none() && !bound.contains(letter);
            for letter in entry.hidden.iter().filter(open) {
                if !found.contains(letter) {
                    found.push(letter.clone());
                }
            }
            self.collect_letters(node, bound, found);
            let depth = self.aliases.get();
            if let (EntryKind::Same(other), true) = (&entry.kind, depth < MOST_ALIASES) {
                self.aliases.set(depth + 1);
                // Within the formula, the indices of the name and the arguments have the values that are printed.
                let outer = bound.len();
                bound.extend(entry.letters.iter().chain(&entry.arguments).cloned());
                self.collect_indices(other, bound, found);
                bound.truncate(outer);
                self.aliases.set(depth);
            }
            return;
        }
        if let Kind::Scripts { base, primes, sub: Some(sub), sup } = &node.kind
            && !matches!(base.kind, Kind::BigOp(_))
        {
            match sup {
                Some(sup) => {
                    let (base, sub) = (base.clone(), Some(sub.clone()));
                    let name = Kind::Scripts { base, primes: *primes, sub, sup: None };
                    self.collect_indices(&Node::new(name, node.span.clone()), bound, found);
                    return self.collect_indices(sup, bound, found);
                }
                None => {
                    // A letter with a script is a name of its own, unless the script means a component.
                    if matches!(base.kind, Kind::Group { .. }) || self.scope.axis(&spelling(sub)).is_some() {
                        self.collect_indices(base, bound, found);
                    }
                    return self.collect_letters(sub, bound, found);
                }
            }
        }
        let depth = bound.len();
        let children = children(node);
        for (k, child) in children.iter().enumerate() {
            let mut limits = Vec::new();
            if is_integral(child) {
                let own = children[k + 1..].iter().position(|n| is_integral(n)).map_or(children.len(), |n| k + 1 + n);
                bound.extend(self.particles(&children[k + 1..own]));
                continue;
            }
            if let Kind::Scripts { base, sub, .. } = &child.kind
                && is_sum(base)
            {
                // What follows the operator within this node is bound by it.
                if let Some(sub) = sub {
                    self.collect_indices(sub, &mut Vec::new(), &mut limits);
                }
                bound.extend(limits);
                continue;
            }
            if is_sum(child) {
                // A sum without limits runs over all indices behind it.
                break;
            }
            self.collect_indices(child, bound, found);
        }
        bound.truncate(depth);
    }
}

/// Whether an operator runs through indices.
fn is_sum(node: &Node) -> bool {
    matches!(node.kind, Kind::BigOp(BigOp::Sum | BigOp::Product))
}

/// Visits the letters of a name, those in its scripts included.
fn letters(node: &Node, visit: &mut dyn FnMut(&String)) {
    if let Kind::Symbol(s) = &node.kind {
        visit(s);
    }
    node.children().into_iter().for_each(|child| letters(child, visit));
}

/// The nodes directly below a node, products laid flat so that what follows a big operator stands behind it.
fn children(node: &Node) -> Vec<&Node> {
    if !matches!(node.kind, Kind::Juxt(_) | Kind::Product { .. }) {
        return node.children();
    }
    let mut items = Vec::new();
    super::juxtaposition::flatten(node, &mut items);
    let factors = items.into_iter().filter_map(|item| match item {
        Item::Factor(n) => Some(n),
        Item::Op(..) => None,
    });
    factors.collect()
}

/// A vector turned by an angle about an axis of the inertial frame.
fn turned(graph: &mut Graph, v: &[Expr; 3], angle: Expr, axis: char) -> [Expr; 3] {
    let (sin, cos) = (graph.call(crate::expr::Func::Sin, angle), graph.call(crate::expr::Func::Cos, angle));
    let k = match axis {
        'x' => 0,
        'y' => 1,
        _ => 2,
    };
    let (i, j) = ((k + 1) % 3, (k + 2) % 3);
    let mut out = *v;
    let (ci, sj) = (graph.mul(cos, v[i]), graph.mul(sin, v[j]));
    let (si, cj) = (graph.mul(sin, v[i]), graph.mul(cos, v[j]));
    out[i] = graph.sub(ci, sj);
    out[j] = graph.add(si, cj);
    out
}

fn is_d(node: &Node) -> bool {
    match &node.kind {
        Kind::Symbol(s) => s == "d" || s == "\\partial",
        Kind::Styled(Font::Roman, body) => matches!(&body.kind, Kind::Symbol(s) if s == "d"),
        _ => false,
    }
}

/// The order of the `d` a numerator begins with, and what follows it.
fn numerator(num: &Node) -> Option<(usize, Option<Vec<Node>>)> {
    let power = |n: &Node| match &n.kind {
        Kind::Scripts { base, primes: 0, sub: None, sup: Some(sup) } if is_d(base) => small_integer(sup),
        _ => is_d(n).then_some(1),
    };
    match &num.kind {
        Kind::Juxt(factors) => {
            let (first, rest) = factors.split_first()?;
            Some((power(first)?, Some(rest.to_vec())))
        }
        Kind::Product { first, rest } => {
            let (order, operand) = numerator(first)?;
            let mut operand = operand?;
            let head = operand.pop()?;
            // \frac{d (a \times b)}{dt} without brackets: the product is the operand.
            let span = head.span.start..num.span.end;
            operand.push(Node::new(Kind::Product { first: Box::new(head), rest: rest.clone() }, span));
            Some((order, Some(operand)))
        }
        _ => Some((power(num)?, None)),
    }
}

/// The variables of a derivative by a tuple, `\frac{\partial F}{\partial(x, y)}`.
fn several(variable: &Node) -> Option<&[Node]> {
    match &variable.kind {
        Kind::Group { body, .. } => several(body),
        Kind::List(items) => Some(items),
        _ => None,
    }
}

fn variable_and_order(node: &Node) -> (Node, usize) {
    match &node.kind {
        Kind::Scripts { base, primes, sub, sup: Some(sup) } => match (small_integer(sup), *primes, sub) {
            (Some(n), 0, None) => (base.as_ref().clone(), n),
            // Twice by x' or x_1.
            (Some(n), ..) => {
                let kind = Kind::Scripts { base: base.clone(), primes: *primes, sub: sub.clone(), sup: None };
                (Node::new(kind, node.span.clone()), n)
            }
            (None, ..) => (node.clone(), 1),
        },
        _ => (node.clone(), 1),
    }
}

fn small_integer(node: &Node) -> Option<usize> {
    match &node.kind {
        Kind::Number(n) => n.parse().ok().filter(|n| (1..=12).contains(n)),
        _ => None,
    }
}
