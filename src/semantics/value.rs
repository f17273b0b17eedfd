//! Typed values: scalars, vectors, matrices, tuples, each made of scalar expressions of the graph.

use crate::expr::{Expr, Graph};
use crate::latex::ast::Span;

use super::complex;
use super::error::{Error, Result};

/// A rectangular array of scalars, row by row.
#[derive(Clone, Debug, PartialEq)]
pub struct Matrix {
    /// The number of rows.
    pub rows: usize,
    /// The number of columns.
    pub cols: usize,
    /// The entries, row by row.
    pub data: Vec<Expr>,
}

impl Matrix {
    /// The entry in a row and a column.
    pub fn at(&self, row: usize, col: usize) -> Expr {
        self.data[row * self.cols + col]
    }
}

/// A value of some shape.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A number.
    Scalar(Expr),
    /// A vector of space, by its components in the inertial frame.
    Vector([Expr; 3]),
    /// A quaternion: a number and a vector.
    Quaternion(Expr, [Expr; 3]),
    /// A complex number, by its real and imaginary part.
    Complex(Expr, Expr),
    /// An array of numbers, a column of components among them.
    Matrix(Matrix),
    /// Several values.
    Tuple(Vec<Value>),
    /// The word `const.`
    Constant,
}

impl Value {
    /// The shape in words.
    pub fn shape(&self) -> String {
        match self {
            Value::Scalar(_) => "a scalar".into(),
            Value::Vector(_) => "a vector".into(),
            Value::Quaternion(..) => "a quaternion".into(),
            Value::Complex(..) => "a complex number".into(),
            Value::Matrix(m) if m.cols == 1 => format!("a column of {}", m.rows),
            Value::Matrix(m) => format!("a {}x{} matrix", m.rows, m.cols),
            Value::Tuple(items) => format!("a tuple of {}", items.len()),
            Value::Constant => "the word const.".into(),
        }
    }

    /// The scalar expressions it is made of.
    pub fn components(&self) -> Vec<Expr> {
        match self {
            Value::Scalar(e) => vec![*e],
            Value::Vector(v) => v.to_vec(),
            Value::Quaternion(s, v) => std::iter::once(*s).chain(*v).collect(),
            Value::Complex(re, im) => vec![*re, *im],
            Value::Matrix(m) => m.data.clone(),
            Value::Tuple(items) => items.iter().flat_map(Value::components).collect(),
            Value::Constant => Vec::new(),
        }
    }

    /// The same shape with each component mapped.
    pub fn map(&self, f: &mut dyn FnMut(Expr) -> Expr) -> Value {
        match self {
            Value::Scalar(e) => Value::Scalar(f(*e)),
            Value::Vector(v) => Value::Vector(v.map(f)),
            Value::Quaternion(s, v) => Value::Quaternion(f(*s), v.map(f)),
            Value::Complex(re, im) => Value::Complex(f(*re), f(*im)),
            Value::Matrix(m) => {
                Value::Matrix(Matrix { rows: m.rows, cols: m.cols, data: m.data.iter().map(|e| f(*e)).collect() })
            }
            Value::Tuple(items) => Value::Tuple(items.iter().map(|v| v.map(f)).collect()),
            Value::Constant => Value::Constant,
        }
    }

    /// Whether it is the number 0, which in notes also stands for the null vector and the null matrix.
    pub fn is_zero_scalar(&self, graph: &Graph) -> bool {
        matches!(self, Value::Scalar(e) if graph.as_rational(*e) == Some((0, 1)))
    }
}

/// Sum or difference of two values.
pub fn add(graph: &mut Graph, a: &Value, b: &Value, minus: bool, span: &Span) -> Result<Value> {
    if let Some(((a, b), (c, d))) = complex::met(graph, a, b) {
        let mut op = |x: Expr, y: Expr| if minus { graph.sub(x, y) } else { graph.add(x, y) };
        return Ok(Value::Complex(op(a, c), op(b, d)));
    }
    let mut op = |x: Expr, y: Expr| if minus { graph.sub(x, y) } else { graph.add(x, y) };
    match (a, b) {
        (Value::Scalar(x), Value::Scalar(y)) => Ok(Value::Scalar(op(*x, *y))),
        (Value::Vector(x), Value::Vector(y)) => Ok(Value::Vector([0, 1, 2].map(|k| op(x[k], y[k])))),
        (Value::Quaternion(s, x), Value::Quaternion(t, y)) => {
            Ok(Value::Quaternion(op(*s, *t), [0, 1, 2].map(|k| op(x[k], y[k]))))
        }
        (Value::Matrix(x), Value::Matrix(y)) if (x.rows, x.cols) == (y.rows, y.cols) => {
            let data = x.data.iter().zip(&y.data).map(|(p, q)| op(*p, *q)).collect();
            Ok(Value::Matrix(Matrix { rows: x.rows, cols: x.cols, data }))
        }
        (Value::Tuple(x), Value::Tuple(y)) if x.len() == y.len() => {
            let items = x.iter().zip(y).map(|(p, q)| add(graph, p, q, minus, span)).collect::<Result<_>>()?;
            Ok(Value::Tuple(items))
        }
        _ => {
            let verb = if minus { ("subtract", "from", b, a) } else { ("add", "to", a, b) };
            Err(Error::shape(format!("cannot {} {} {} {}", verb.0, verb.2.shape(), verb.1, verb.3.shape()), span)
                .with_help("check the brackets and the indices, and whether every vector is declared as one"))
        }
    }
}

/// The value with its sign changed.
pub fn negate(graph: &mut Graph, a: &Value) -> Value {
    a.map(&mut |e| graph.neg(e))
}

/// Product of what stands side by side, or is joined by a dot or cross where one factor is a number.
pub fn multiply(graph: &mut Graph, a: &Value, b: &Value, span: &Span) -> Result<Value> {
    match (a, b) {
        (Value::Scalar(x), other) => Ok(other.map(&mut |e| graph.mul(*x, e))),
        (other, Value::Scalar(y)) => Ok(other.map(&mut |e| graph.mul(e, *y))),
        (Value::Complex(a, b), Value::Complex(c, d)) => {
            let (re, im) = complex::product(graph, (*a, *b), (*c, *d));
            Ok(Value::Complex(re, im))
        }
        (Value::Matrix(x), Value::Matrix(y)) if x.cols == y.rows => {
            let product = matrix_product(graph, x, y);
            // A row times a column is a number.
            let number = (x.rows, y.cols) == (1, 1) && x.cols > 1;
            Ok(if number { Value::Scalar(product.at(0, 0)) } else { Value::Matrix(product) })
        }
        (Value::Vector(_), Value::Vector(_)) => Err(Error::shape("two vectors stand side by side", span)
            .with_help("write a dot product with \\cdot or a cross product with \\times")),
        _ => Err(Error::shape(format!("cannot multiply {} by {}", a.shape(), b.shape()), span)),
    }
}

fn matrix_product(graph: &mut Graph, x: &Matrix, y: &Matrix) -> Matrix {
    let mut data = Vec::with_capacity(x.rows * y.cols);
    for i in 0..x.rows {
        for j in 0..y.cols {
            let terms: Vec<Expr> = (0..x.cols).map(|k| graph.mul(x.at(i, k), y.at(k, j))).collect();
            data.push(sum(graph, &terms));
        }
    }
    Matrix { rows: x.rows, cols: y.cols, data }
}

/// The quotient of a value by a number.
pub fn divide(graph: &mut Graph, a: &Value, b: &Value, span: &Span) -> Result<Value> {
    if let (Value::Complex(c, d), Some(a)) = (b, complex::parts(graph, a)) {
        let (re, im) = complex::quotient(graph, a, (*c, *d));
        return Ok(Value::Complex(re, im));
    }
    match b {
        Value::Scalar(y) => Ok(a.map(&mut |e| graph.div(e, *y))),
        _ => Err(Error::shape(format!("cannot divide by {}", b.shape()), span)),
    }
}

/// The dot product; of numbers, their product.
pub fn dot(graph: &mut Graph, a: &Value, b: &Value, span: &Span) -> Result<Value> {
    match (a, b) {
        (Value::Vector(x), Value::Vector(y)) => Ok(Value::Scalar(dot3(graph, x, y))),
        _ => multiply(graph, a, b, span),
    }
}

/// The cross product; where one factor is a number, the product.
pub fn cross(graph: &mut Graph, a: &Value, b: &Value, span: &Span) -> Result<Value> {
    match (a, b) {
        (Value::Vector(x), Value::Vector(y)) => Ok(Value::Vector(cross3(graph, x, y))),
        _ => multiply(graph, a, b, span),
    }
}

/// The dot product of components.
pub fn dot3(graph: &mut Graph, x: &[Expr; 3], y: &[Expr; 3]) -> Expr {
    let terms = [0, 1, 2].map(|k| graph.mul(x[k], y[k]));
    sum(graph, &terms)
}

/// The cross product of components.
pub fn cross3(graph: &mut Graph, x: &[Expr; 3], y: &[Expr; 3]) -> [Expr; 3] {
    [0, 1, 2].map(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        let (p, q) = (graph.mul(x[i], y[j]), graph.mul(x[j], y[i]));
        graph.sub(p, q)
    })
}

/// The sum of scalars, 0 for none.
pub fn sum(graph: &mut Graph, terms: &[Expr]) -> Expr {
    match terms.split_first() {
        None => graph.int(0),
        Some((first, rest)) => rest.iter().fold(*first, |acc, t| graph.add(acc, *t)),
    }
}

/// The most rows of a determinant: an expansion of n rows has n! terms.
pub const LARGEST_DETERMINANT: usize = 6;

/// Which determinants there are, in words.
pub const DETERMINANTS: &str = "a determinant needs as many rows as columns, at most 6";

/// The determinant by expansion along the first row; for the small matrices of lecture notes.
pub fn determinant(graph: &mut Graph, m: &Matrix) -> Expr {
    if m.rows == 1 {
        return m.data[0];
    }
    let mut terms = Vec::new();
    for j in 0..m.cols {
        let minor_determinant = determinant(graph, &minor(m, 0, j));
        let term = graph.mul(m.at(0, j), minor_determinant);
        terms.push(if j % 2 == 0 { term } else { graph.neg(term) });
    }
    sum(graph, &terms)
}

/// The matrix without a row and a column.
fn minor(m: &Matrix, row: usize, col: usize) -> Matrix {
    let kept = (0..m.rows * m.cols).filter(|k| k / m.cols != row && k % m.cols != col);
    Matrix { rows: m.rows - 1, cols: m.cols - 1, data: kept.map(|k| m.data[k]).collect() }
}

/// The inverse by cofactors.
pub fn inverse(graph: &mut Graph, m: &Matrix, span: &Span) -> Result<Matrix> {
    if m.rows != m.cols || m.rows > 5 {
        let what = Value::Matrix(m.clone()).shape();
        return Err(Error::shape(format!("{what} has no inverse here"), span)
            .with_help("only square matrices of at most 5 rows are inverted"));
    }
    let det = determinant(graph, m);
    let n = m.rows;
    let mut data = Vec::with_capacity(n * n);
    for i in 0..n {
        for j in 0..n {
            let one = graph.int(1);
            let cofactor = if n == 1 { one } else { determinant(graph, &minor(m, j, i)) };
            let signed = if (i + j) % 2 == 0 { cofactor } else { graph.neg(cofactor) };
            data.push(graph.div(signed, det));
        }
    }
    Ok(Matrix { rows: n, cols: n, data })
}
