//! Legendre polynomials and functions of whole degree and order, written out as ordinary operations.
//!
//! Notes use them where a letter is declared as them: `'P' = { same = '\operatorname{P}' }`. Then
//! - `P_n(x)` is the Legendre polynomial of degree n (DLMF 18.5.8 and 14.7.1),
//! - `P_n^{(m)}(x)` its m-th derivative,
//! - `P_n^m(x)` is (1 − x²)^{m/2} P_n^{(m)}(x), *without* the phase (−1)^m of Condon and Shortley that the Ferrers function
//!   of DLMF 14.7.8 has: so celestial mechanics has them.
//!
//! Of the sine of a latitude the root is its cosine, of the cosine of a polar distance its sine: then nothing but
//! polynomials in them is left, and they can be compared exactly.

use crate::expr::{Expr, Func, Graph, Node as Op};
use crate::latex::ast::{Delim, Kind, Node, Span};

use super::elaborate::{Elaborator, Typed};
use super::error::{Error, Result};
use super::juxtaposition::{Item, head_and_power, is_bracket};
use super::scope::{Entry, EntryKind};
use super::value::Value;

/// The highest degree: beyond, the coefficients outgrow exact fractions.
const HIGHEST_DEGREE: i64 = 30;

impl Elaborator<'_> {
    /// A Legendre function and its argument; `None` where the first factor is none.
    pub(super) fn legendre(&mut self, items: &[Item]) -> Result<Option<(Typed, usize)>> {
        let [Item::Factor(node), Item::Factor(argument), ..] = items else { return Ok(None) };
        let Kind::Scripts { base, primes: 0, sub: Some(degree), sup } = &node.kind else { return Ok(None) };
        if !self.is_legendre(base) || self.is_declared(node) || !is_bracket(argument) {
            return Ok(None);
        }
        let (order, derivative) = match sup.as_deref() {
            None => (None, false),
            Some(Node { kind: Kind::Group { open: Delim::Paren, body, .. }, .. }) => (Some(body.as_ref()), true),
            Some(order) => (Some(order), false),
        };
        let n = self.integer(degree)?;
        let m = order.map_or(Ok(0), |order| self.integer(order))?;
        if !(0..=HIGHEST_DEGREE).contains(&n) || m < 0 {
            return Err(out_of_reach(n, m, &node.span));
        }
        let (argument, power) = head_and_power(argument);
        let inner = self.value(argument)?;
        let x = self.scalar(&inner, &argument.span)?;
        let graph = &mut self.world.graph;
        let polynomial = derived_polynomial(graph, n, m, x);
        let value = if derivative || m == 0 {
            polynomial
        } else {
            let root = other_coordinate(graph, x);
            let power = graph.powi(root, i32::try_from(m).unwrap_or(i32::MAX));
            graph.mul(power, polynomial)
        };
        let order = match (m, derivative) {
            (0, _) => String::new(),
            (m, true) => format!("^({m})"),
            (m, false) => format!("^{m}"),
        };
        let value = Typed::new(Value::Scalar(value), format!("P_{n}{order}({})", inner.text));
        Ok(Some((self.with_power(value, power, &argument.span)?, 2)))
    }

    fn is_legendre(&self, base: &Node) -> bool {
        let named = |node: &Node| matches!(&node.kind, Kind::Function(name) if name == "P");
        named(base) || matches!(self.entry(base), Some((Entry { kind: EntryKind::Same(other), .. }, _)) if named(other))
    }
}

fn out_of_reach(n: i64, m: i64, span: &Span) -> Error {
    let message = format!("a Legendre function of degree {n} and order {m}");
    Error::limit(message, span)
        .with_help(format!("degrees from 0 to {HIGHEST_DEGREE} and orders from 0 are written out"))
}

/// The m-th derivative of the Legendre polynomial of degree n: 2⁻ⁿ Σ (−1)ᵏ C(n,k) C(2n−2k,n) (d/dx)ᵐ xⁿ⁻²ᵏ.
fn derived_polynomial(graph: &mut Graph, n: i64, m: i64, x: Expr) -> Expr {
    let mut sum = graph.int(0);
    for k in 0..=n / 2 {
        let left = n - 2 * k - m;
        if left < 0 {
            break;
        }
        let falling: i128 = (left + 1..=left + m).map(i128::from).product();
        let size = choose(n, k) * choose(2 * n - 2 * k, n) * falling;
        let factor = graph.ratio(if k % 2 == 0 { size } else { -size }, 1 << n);
        let power = graph.powi(x, i32::try_from(left).unwrap_or(i32::MAX));
        let term = graph.mul(factor, power);
        sum = graph.add(sum, term);
    }
    sum
}

fn choose(n: i64, k: i64) -> i128 {
    (0..k).fold(1, |ways, j| ways * i128::from(n - j) / i128::from(j + 1))
}

/// The root of 1 − x², of a sine the cosine and of a cosine the sine.
fn other_coordinate(graph: &mut Graph, x: Expr) -> Expr {
    match *graph.node(x) {
        Op::Call(Func::Sin, angle) => graph.call(Func::Cos, angle),
        Op::Call(Func::Cos, angle) => graph.call(Func::Sin, angle),
        _ => {
            let (one, square) = (graph.int(1), graph.powi(x, 2));
            let left = graph.sub(one, square);
            graph.sqrt(left)
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::semantics::World;
    use crate::semantics::testing::{same, scope, value};

    const SYMBOLS: &str = r"
        [symbols]
        'P' = { same = '\operatorname{P}' }
        'n' = { index = [1, 4] }
        'x, \beta' = {}
    ";

    #[test]
    fn polynomials() {
        assert!(same(SYMBOLS, "P_2(x)", r"\frac{1}{2}(3x^2 - 1)"));
        assert!(same(SYMBOLS, "P_4(x)", r"\frac{1}{8}(35x^4 - 30x^2 + 3)"));
        assert!(same(SYMBOLS, "6 P_6(x)", "11 x P_5(x) - 5 P_4(x)"));
        assert!(same(SYMBOLS, r"\sum_{n=1}^3 P_n(1)", "3"));
        assert!(!same(SYMBOLS, "P_3(x)", r"\frac{1}{2}(3x^3 - x)"));
    }

    #[test]
    fn derivatives_and_associated_functions() {
        assert!(same(SYMBOLS, "P_3^{(1)}(x)", r"\frac{3}{2}(5x^2 - 1)"));
        assert!(same(SYMBOLS, "P_2^{(3)}(x)", "0"));
        assert!(same(SYMBOLS, r"P_2^1(\sin\beta)", r"3 \sin\beta \cos\beta"));
        assert!(same(SYMBOLS, r"P_2^2(\sin\beta)", r"3 \cos^2\beta"));
        assert!(same(SYMBOLS, r"P_3^1(x)^2", r"\frac{9}{4} (5x^2 - 1)^2 (1 - x^2)"));
    }

    #[test]
    fn what_is_out_of_reach_is_refused() {
        let error = |latex: &str| value(&mut World::new(), &scope(SYMBOLS), latex).unwrap_err().message;
        assert!(error("P_{31}(x)").contains("degree 31"));
        assert!(error("P_{2}^{-1}(x)").contains("order -1"));
        assert!(error("P_{x}(x)").contains("integers"));
    }
}
