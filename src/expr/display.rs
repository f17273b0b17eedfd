//! Expressions as text for people.

use super::graph::{Expr, Graph, Node};

/// What is still to be written.
enum Piece {
    Of(Expr),
    Text(String),
}

impl Graph {
    /// The expression as plain text, fully parenthesised. Shared parts are written out wherever they occur; past some
    /// thousand characters the text breaks off with `…`.
    pub fn display(&self, e: Expr) -> String {
        const LIMIT: usize = 10_000;
        let mut text = String::new();
        let mut stack = vec![Piece::Of(e)];
        while let Some(piece) = stack.pop() {
            if text.len() > LIMIT {
                text.push('…');
                break;
            }
            match piece {
                Piece::Text(t) => text.push_str(&t),
                Piece::Of(e) => {
                    let mut pieces = self.pieces(e);
                    pieces.reverse();
                    stack.extend(pieces);
                }
            }
        }
        text
    }

    /// An expression's text, with its operands still to be written.
    fn pieces(&self, e: Expr) -> Vec<Piece> {
        let binary = |left: &str, a: Expr, operator: &str, b: Expr| {
            let (left, middle) = (Piece::Text(left.to_owned()), Piece::Text(operator.to_owned()));
            vec![left, Piece::Of(a), middle, Piece::Of(b), Piece::Text(")".to_owned())]
        };
        let unary = |left: &str, a: Expr| vec![Piece::Text(left.to_owned()), Piece::Of(a), Piece::Text(")".to_owned())];
        match *self.node(e) {
            Node::Rational(n, 1) => vec![Piece::Text(n.to_string())],
            Node::Rational(n, d) => vec![Piece::Text(format!("({n}/{d})"))],
            Node::Pi => vec![Piece::Text("π".to_owned())],
            Node::E => vec![Piece::Text("e".to_owned())],
            Node::Symbol(s) => vec![Piece::Text(self.info(s).name.clone())],
            Node::Neg(a) => unary("(-", a),
            Node::Add(a, b) => binary("(", a, " + ", b),
            Node::Sub(a, b) => binary("(", a, " - ", b),
            Node::Mul(a, b) => binary("(", a, " * ", b),
            Node::Div(a, b) => binary("(", a, " / ", b),
            Node::PowI(a, n) => vec![Piece::Of(a), Piece::Text(format!("^{n}"))],
            Node::Pow(a, b) => binary("(", a, "^", b),
            Node::Sqrt(a) => unary("sqrt(", a),
            Node::Call(f, a) => unary(&format!("{}(", f.name()), a),
            Node::Atan2(y, x) => binary("atan2(", y, ", ", x),
            Node::Integral(a) => unary("integral(", a),
            Node::Elliptic(f, x) => {
                let mut pieces = vec![Piece::Text(f.name().to_owned())];
                for (i, a) in x.into_iter().enumerate().take(f.arity()) {
                    pieces.extend([Piece::Text(if i == 0 { "(" } else { ", " }.to_owned()), Piece::Of(a)]);
                }
                pieces.push(Piece::Text(")".to_owned()));
                pieces
            }
        }
    }
}
