//! What stands in a superscript: powers of numbers, vectors, matrices and quaternions, the transposed, degrees.

use crate::latex::ast::{Kind, Node, Span};
use crate::latex::to_latex;

use super::complex;
use super::elaborate::{Elaborator, Typed};
use super::error::{Error, Result};
use super::quaternion;
use super::value::{self, Matrix, Value};
use super::world::{Joint, Role};

impl Elaborator<'_> {
    /// A value raised to what stands in the superscript.
    pub(super) fn with_power(&mut self, base: Typed, sup: Option<&Node>, span: &Span) -> Result<Typed> {
        let Some(sup) = sup else { return Ok(base) };
        if matches!(&sup.kind, Kind::Symbol(s) if s == "\\circ") {
            return self.degrees(base, span);
        }
        if let (Value::Matrix(m), Kind::Symbol(t)) = (&base.value, &sup.kind)
            && t == "T"
        {
            let data = (0..m.rows * m.cols).map(|k| m.at(k % m.rows, k / m.rows)).collect();
            return Ok(Typed::new(
                Value::Matrix(Matrix { rows: m.cols, cols: m.rows, data }),
                format!("{}^T", base.text),
            ));
        }
        let exponent = self.value(sup)?;
        if let Some(value) = complex::power(&mut self.world.graph, &base.value, &exponent.value, span)? {
            return Ok(Typed::new(value, format!("{}^{}", base.text, exponent.text)));
        }
        let n = self.scalar(&exponent, &sup.span)?;
        self.world.join(|| Joint { role: Role::Exponent, parts: vec![(to_latex(sup), exponent.value.clone())] });
        let graph = &mut self.world.graph;
        let integer = graph.as_rational(n).filter(|(_, d)| *d == 1).and_then(|(n, _)| i32::try_from(n).ok());
        let value = match (&base.value, integer) {
            (Value::Vector(_) | Value::Quaternion(..), _) if self.scope.quaternions => {
                match quaternion::parts(graph, &base.value) {
                    Some(parts) => quaternion::power(graph, &parts, n, span)?,
                    None => return Err(Error::shape("no quaternion stands here", span)),
                }
            }
            (Value::Scalar(x), _) => Value::Scalar(graph.pow(*x, n)),
            (Value::Vector(v), Some(2)) => Value::Scalar(value::dot3(graph, v, v)),
            (Value::Matrix(m), Some(-1)) => Value::Matrix(value::inverse(graph, m, span)?),
            (Value::Matrix(_), Some(n)) if (1..=8).contains(&n) => {
                let mut power = base.value.clone();
                for _ in 1..n {
                    power = value::multiply(graph, &power, &base.value, span)?;
                }
                power
            }
            (other, _) => return Err(Error::shape(format!("{} cannot be raised to this power", other.shape()), span)),
        };
        Ok(Typed::new(value, format!("{}^{}", base.text, exponent.text)))
    }

    fn degrees(&mut self, base: Typed, span: &Span) -> Result<Typed> {
        let e = self.scalar(&base, span)?;
        let graph = &mut self.world.graph;
        let (pi, half_turn) = (graph.pi(), graph.int(180));
        let degree = graph.div(pi, half_turn);
        Ok(Typed::new(Value::Scalar(graph.mul(e, degree)), format!("{}°", base.text)))
    }
}
