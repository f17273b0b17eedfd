//! A tree written as LaTeX again.
//!
//! The LaTeX is normalised (one space between factors, braces around every argument) and parses back to a tree that is
//! equal up to spans. Where a part binds weaker than its place asks for, it is put in braces, which print nothing.

use super::ast::{Accent, BigOp, Delim, Font, Kind, Link, Mark, MatrixEnv, Node, ProductOp, Rel, Sign, Term};
use super::characters::character;
use super::layout::joins_statements;
use super::macros::{self, Meaning};
use super::token::TokenKind;

/// Writes a tree as LaTeX.
///
/// For every tree that [`super::parse`] gives, the LaTeX parses to a tree equal up to spans.
pub fn to_latex(node: &Node) -> String {
    let mut latex = String::new();
    write(node, Level::Rows, &mut latex);
    latex
}

/// How strongly a place binds, from weak to strong.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Level {
    Rows,
    List,
    Marked,
    Chain,
    Sum,
    Product,
    Juxt,
    Factor,
    Base,
}

/// How strongly a node binds.
fn level(node: &Node) -> Level {
    match &node.kind {
        Kind::List(_) | Kind::Rows(_) => Level::List,
        Kind::Symbol(text) if is_operator(text) => Level::List,
        Kind::Marked(..) => Level::Marked,
        Kind::Chain { .. } => Level::Chain,
        Kind::Sum(_) => Level::Sum,
        Kind::Product { .. } => Level::Product,
        Kind::Juxt(_) => Level::Juxt,
        // An accent's or macro's own scripts would be taken for notes.
        Kind::Scripts { .. } | Kind::Factorial(..) | Kind::Annotated { .. } => Level::Factor,
        Kind::Styled(Font::Roman, _) | Kind::At { .. } => Level::Factor,
        _ => Level::Base,
    }
}

/// Whether a symbol is an operator that stands alone, as in `F^*`.
fn is_operator(text: &str) -> bool {
    let kind = match text.strip_prefix('\\') {
        Some(name) => match macros::meaning(name) {
            Some(Meaning::Token(kind)) => Some(kind),
            _ => None,
        },
        None => text.chars().next().and_then(character),
    };
    matches!(kind, Some(TokenKind::Sign(_) | TokenKind::Times(_)))
}

/// Writes a node at a place that asks for a level.
fn write(node: &Node, place: Level, out: &mut String) {
    if level(node) < place {
        braced(node, out);
    } else {
        plain(node, out);
    }
}

/// Writes a node in braces.
fn braced(node: &Node, out: &mut String) {
    out.push('{');
    if node.kind != Kind::Empty {
        write(node, Level::List, out);
    }
    out.push('}');
}

/// Writes parts with something between them.
fn joined(nodes: &[Node], place: Level, between: &str, out: &mut String) {
    for (i, node) in nodes.iter().enumerate() {
        if i > 0 {
            out.push_str(between);
        }
        write(node, place, out);
    }
}

fn plain(node: &Node, out: &mut String) {
    match &node.kind {
        Kind::Empty => out.push_str("{}"),
        Kind::Number(text) | Kind::Symbol(text) => out.push_str(text),
        Kind::Function(name) => function(name, out),
        Kind::BigOp(op) => out.push_str(big_op(*op)),
        Kind::Ellipsis => out.push_str("\\dots"),
        Kind::Text(text) => {
            out.push_str("\\text{");
            out.push_str(text);
            out.push('}');
        }
        Kind::Styled(font, body) => applied(font_macro(*font, body), body, out),
        Kind::Accent(accent, body) => applied(accent_macro(*accent, body), body, out),
        Kind::Dots(count, body) => applied(dots_macro(*count), body, out),
        Kind::Scripts { base, primes, sub, sup } => scripts(base, *primes, sub.as_deref(), sup.as_deref(), out),
        Kind::Juxt(factors) => juxtaposed(factors, out),
        Kind::Product { first, rest } => product(first, rest, out),
        Kind::Sum(terms) => sum(terms, out),
        Kind::Frac(above, below) => {
            applied("\\frac", above, out);
            braced(below, out);
        }
        Kind::Sqrt { index, body } => root(index.as_deref(), body, out),
        Kind::Group { open, close, body } => group(*open, *close, body, out),
        Kind::List(items) => list(items, out),
        Kind::Chain { first, links } => chain(first.as_deref(), links, out),
        Kind::Matrix { env, rows } => matrix(*env, rows, out),
        Kind::Rows(rows) => aligned(rows, out),
        Kind::Marked(mark, body) => {
            out.push_str(match mark {
                Mark::Therefore => "\\therefore ",
                Mark::Because => "\\because ",
            });
            write(body, Level::Marked, out);
        }
        Kind::Annotated { body, note, over } => annotated(body, note.as_deref(), *over, out),
        Kind::Factorial(count, body) => {
            marked_base(body, out);
            out.extend(std::iter::repeat_n('!', usize::from(*count)));
        }
        Kind::At { body, at } => evaluated(body, at, out),
    }
}

/// A macro with one argument.
fn applied(name: &str, body: &Node, out: &mut String) {
    out.push_str(name);
    braced(body, out);
}

fn function(name: &str, out: &mut String) {
    if macros::is_function(name) {
        out.push('\\');
        out.push_str(name);
    } else {
        out.push_str("\\operatorname{");
        out.push_str(name);
        out.push('}');
    }
}

fn scripts(base: &Node, primes: u8, sub: Option<&Node>, sup: Option<&Node>, out: &mut String) {
    marked_base(base, out);
    out.extend(std::iter::repeat_n('\'', usize::from(primes)));
    for (mark, script) in [('_', sub), ('^', sup)] {
        if let Some(script) = script {
            out.push(mark);
            braced(script, out);
        }
    }
}

/// What a script, a prime or an exclamation mark is put to.
fn marked_base(base: &Node, out: &mut String) {
    match &base.kind {
        // A condition belongs to the group it stands at; braces keep the group whole.
        Kind::Group { open: Delim::None, close: Delim::Bar, .. } => braced(base, out),
        // Bare words would separate statements, and leave the mark to the one after them.
        Kind::Text(_) => braced(base, out),
        _ => write(base, Level::Base, out),
    }
}

fn juxtaposed(factors: &[Node], out: &mut String) {
    for (i, factor) in factors.iter().enumerate() {
        if i > 0 {
            out.push(' ');
        }
        match &factor.kind {
            // Between two operands the words would separate statements.
            Kind::Text(text) if i > 0 && i + 1 < factors.len() && joins_statements(text) => braced(factor, out),
            _ => write(factor, Level::Factor, out),
        }
    }
}

fn product(first: &Node, rest: &[(ProductOp, Node)], out: &mut String) {
    write(first, Level::Juxt, out);
    for (op, factor) in rest {
        out.push_str(match op {
            ProductOp::Dot => " \\cdot ",
            ProductOp::Cross => " \\times ",
            ProductOp::Slash => " / ",
            ProductOp::Wedge => " \\wedge ",
            ProductOp::Tensor => " \\otimes ",
            ProductOp::Other => " \\circ ",
        });
        write(factor, Level::Juxt, out);
    }
}

fn sum(terms: &[Term], out: &mut String) {
    for (i, term) in terms.iter().enumerate() {
        if i > 0 {
            out.push(' ');
        }
        if term.sign_span.is_some() || i > 0 {
            out.push_str(match term.sign {
                Sign::Plus => "+",
                Sign::Minus => "-",
                Sign::PlusMinus => "\\pm",
                Sign::MinusPlus => "\\mp",
            });
            if i > 0 || matches!(term.sign, Sign::PlusMinus | Sign::MinusPlus) {
                out.push(' ');
            }
        }
        write(&term.node, Level::Product, out);
    }
}

fn root(index: Option<&Node>, body: &Node, out: &mut String) {
    out.push_str("\\sqrt");
    if let Some(index) = index {
        out.push('[');
        braced(index, out);
        out.push(']');
    }
    braced(body, out);
}

fn group(open: Delim, close: Delim, body: &Node, out: &mut String) {
    let (left, right) = (opening(open), closing(close));
    let bare = open == close && !matches!(open, Delim::None | Delim::Bar | Delim::DoubleBar);
    out.push_str(if bare { "" } else { "\\left" });
    out.push_str(left);
    if left.ends_with(|c: char| c.is_ascii_alphabetic()) {
        out.push(' ');
    }
    if body.kind != Kind::Empty {
        write(body, Level::List, out);
    }
    out.push_str(if bare { "" } else { "\\right" });
    out.push_str(right);
}

fn list(items: &[Node], out: &mut String) {
    joined(items, Level::Marked, ", ", out);
}

fn chain(first: Option<&Node>, links: &[Link], out: &mut String) {
    if let Some(first) = first {
        write(first, Level::Sum, out);
        out.push(' ');
    }
    for (i, link) in links.iter().enumerate() {
        if i > 0 {
            out.push(' ');
        }
        out.push_str(relation(link.rel));
        out.push(' ');
        write(&link.rhs, Level::Sum, out);
    }
}

fn matrix(env: MatrixEnv, rows: &[Vec<Node>], out: &mut String) {
    let name = match env {
        MatrixEnv::Matrix => "pmatrix",
        MatrixEnv::Determinant => "vmatrix",
        MatrixEnv::Array => "array",
        MatrixEnv::Cases => "cases",
    };
    out.push_str(&format!("\\begin{{{name}}}"));
    if env == MatrixEnv::Array {
        let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
        out.push_str(&format!("{{{}}}", "c".repeat(columns)));
    }
    for (i, row) in rows.iter().enumerate() {
        out.push_str(if i > 0 { " \\\\ " } else { " " });
        joined(row, Level::List, " & ", out);
    }
    // A blank last row would be taken for the end of the row before.
    if matches!(rows.last().map(Vec::as_slice), Some([Node { kind: Kind::Empty, .. }])) {
        out.push_str(" \\\\");
    }
    out.push_str(&format!(" \\end{{{name}}}"));
}

fn aligned(rows: &[Node], out: &mut String) {
    out.push_str("\\begin{aligned} ");
    for (i, row) in rows.iter().enumerate() {
        if i > 0 {
            out.push_str(" \\\\ ");
        }
        // A row that begins with a sign would continue the row above.
        let place = if begins_with_operator(row) { Level::Base } else { Level::List };
        write(row, place, out);
    }
    out.push_str(" \\end{aligned}");
}

/// Whether the LaTeX of a node begins with a sign or an operator.
fn begins_with_operator(node: &Node) -> bool {
    match &node.kind {
        Kind::Symbol(text) => is_operator(text),
        Kind::Sum(terms) => terms.first().is_some_and(|term| term.sign_span.is_some()),
        Kind::List(items) => items.first().is_some_and(begins_with_operator),
        Kind::Chain { first: Some(first), .. } => begins_with_operator(first),
        _ => false,
    }
}

fn annotated(body: &Node, note: Option<&Node>, over: bool, out: &mut String) {
    applied(if over { "\\overbrace" } else { "\\underbrace" }, body, out);
    if let Some(note) = note {
        out.push(if over { '^' } else { '_' });
        braced(note, out);
    }
}

fn evaluated(body: &Node, at: &Node, out: &mut String) {
    out.push_str("\\left. ");
    write(body, Level::List, out);
    out.push_str(" \\right|");
    match &at.kind {
        Kind::Scripts { base, primes, sub, sup } if base.kind == Kind::Empty && limits(*primes, sub, sup) => {
            out.extend(std::iter::repeat_n('\'', usize::from(*primes)));
            for (mark, script) in [('_', sub), ('^', sup)] {
                if let Some(script) = script {
                    out.push(mark);
                    braced(script, out);
                }
            }
        }
        _ => {
            out.push('_');
            braced(at, out);
        }
    }
}

/// Whether the scripts of an empty base were printed at the bar itself: a lone subscript is the condition.
fn limits(primes: u8, sub: &Option<Box<Node>>, sup: &Option<Box<Node>>) -> bool {
    primes > 0 || sub.is_none() || sup.is_some()
}

fn big_op(op: BigOp) -> &'static str {
    match op {
        BigOp::Sum => "\\sum",
        BigOp::Product => "\\prod",
        BigOp::Integral => "\\int",
        BigOp::DoubleIntegral => "\\iint",
        BigOp::LoopIntegral => "\\oint",
    }
}

fn font_macro(font: Font, body: &Node) -> &'static str {
    match font {
        // `\mathbf` leaves Greek letters as they are.
        Font::Bold if matches!(&body.kind, Kind::Symbol(name) if name.starts_with('\\')) => "\\boldsymbol",
        Font::Bold => "\\mathbf",
        Font::Calligraphic => "\\mathcal",
        Font::Roman => "\\mathrm",
        Font::Italic => "\\mathit",
        Font::Blackboard => "\\mathbb",
        Font::Fraktur => "\\mathfrak",
        Font::SansSerif => "\\mathsf",
        Font::Typewriter => "\\mathtt",
    }
}

fn accent_macro(accent: Accent, body: &Node) -> &'static str {
    let wide = matches!(body.kind, Kind::Juxt(_) | Kind::Sum(_) | Kind::Product { .. });
    match (accent, wide) {
        (Accent::Vector, false) => "\\vec",
        (Accent::Vector, true) => "\\overrightarrow",
        (Accent::Hat, false) => "\\hat",
        (Accent::Hat, true) => "\\widehat",
        (Accent::Bar, false) => "\\bar",
        (Accent::Bar, true) => "\\overline",
        (Accent::Tilde, false) => "\\tilde",
        (Accent::Tilde, true) => "\\widetilde",
        (Accent::Other, _) => "\\check",
    }
}

fn dots_macro(count: u8) -> &'static str {
    match count {
        1 => "\\dot",
        2 => "\\ddot",
        3 => "\\dddot",
        _ => "\\ddddot",
    }
}

fn opening(delim: Delim) -> &'static str {
    match delim {
        Delim::None => ". ",
        Delim::Paren => "(",
        Delim::Bracket => "[",
        Delim::Brace => "\\{",
        Delim::Bar => "|",
        Delim::DoubleBar => "\\|",
        Delim::Angle => "\\langle",
        Delim::Floor => "\\lfloor",
        Delim::Ceil => "\\lceil",
    }
}

fn closing(delim: Delim) -> &'static str {
    match delim {
        Delim::None => ".",
        Delim::Paren => ")",
        Delim::Bracket => "]",
        Delim::Brace => "\\}",
        Delim::Bar => "|",
        Delim::DoubleBar => "\\|",
        Delim::Angle => "\\rangle",
        Delim::Floor => "\\rfloor",
        Delim::Ceil => "\\rceil",
    }
}

fn relation(rel: Rel) -> &'static str {
    match rel {
        Rel::Eq => "=",
        Rel::Equiv => "\\equiv",
        Rel::Ne => "\\neq",
        Rel::Lt => "<",
        Rel::Gt => ">",
        Rel::Le => "\\leq",
        Rel::Ge => "\\geq",
        Rel::Ll => "\\ll",
        Rel::Gg => "\\gg",
        Rel::Approx => "\\approx",
        Rel::Sim => "\\sim",
        Rel::Cong => "\\cong",
        Rel::Propto => "\\propto",
        Rel::To => "\\to",
        Rel::From => "\\leftarrow",
        Rel::Exchange => "\\leftrightarrow",
        Rel::Implies => "\\Rightarrow",
        Rel::ImpliedBy => "\\Leftarrow",
        Rel::Iff => "\\Leftrightarrow",
        Rel::Parallel => "\\parallel",
        Rel::Perp => "\\perp",
        Rel::In => "\\in",
        Rel::Ratio => ":",
    }
}
