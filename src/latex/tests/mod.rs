//! Tests of the whole way from a source to its tree.

mod constructs;
mod display;
mod errors;
mod properties;

use super::ast::{Kind, Node, Term};
use super::parse;

/// A tree in a short notation, for comparison: `(= a b)`, `(+ a -b)`, `(j a b)`, `(s base ' _sub ^sup)`.
fn short(node: &Node) -> String {
    let all = |nodes: &[Node]| nodes.iter().map(short).collect::<Vec<_>>().join(" ");
    match &node.kind {
        Kind::Empty => "()".to_owned(),
        Kind::Number(text) | Kind::Symbol(text) => text.clone(),
        Kind::Function(name) => format!("@{name}"),
        Kind::BigOp(op) => format!("@{op:?}"),
        Kind::Ellipsis => "...".to_owned(),
        Kind::Text(text) => format!("{text:?}"),
        Kind::Styled(font, body) => format!("({font:?} {})", short(body)),
        Kind::Accent(accent, body) => format!("({accent:?} {})", short(body)),
        Kind::Dots(count, body) => format!("({} {})", "·".repeat(usize::from(*count)), short(body)),
        Kind::Scripts { base, primes, sub, sup } => {
            let sub = sub.as_ref().map_or(String::new(), |sub| format!(" _{}", short(sub)));
            let sup = sup.as_ref().map_or(String::new(), |sup| format!(" ^{}", short(sup)));
            let primes = "'".repeat(usize::from(*primes));
            format!("(s {}{primes}{sub}{sup})", short(base))
        }
        Kind::Juxt(factors) => format!("(j {})", all(factors)),
        Kind::Product { first, rest } => {
            let rest: String = rest.iter().map(|(op, factor)| format!(" {op:?} {}", short(factor))).collect();
            format!("(p {}{rest})", short(first))
        }
        Kind::Sum(terms) => {
            let term = |t: &Term| {
                let sign = t.sign_span.as_ref().map_or(String::new(), |_| format!("{:?}:", t.sign));
                format!(" {sign}{}", short(&t.node))
            };
            format!("(+{})", terms.iter().map(term).collect::<String>())
        }
        Kind::Frac(above, below) => format!("(/ {} {})", short(above), short(below)),
        Kind::Sqrt { index, body } => match index {
            Some(index) => format!("(root {} {})", short(index), short(body)),
            None => format!("(root {})", short(body)),
        },
        Kind::Group { open, close, body } if open == close => format!("[{open:?} {}]", short(body)),
        Kind::Group { open, close, body } => format!("[{open:?}-{close:?} {}]", short(body)),
        Kind::List(items) => format!("(list {})", all(items)),
        Kind::Chain { first, links } => {
            let links: String = links.iter().map(|link| format!(" {:?} {}", link.rel, short(&link.rhs))).collect();
            format!("(c {}{links})", first.as_ref().map_or("-".to_owned(), |first| short(first)))
        }
        Kind::Matrix { env, rows } => {
            let rows: Vec<String> = rows.iter().map(|row| all(row)).collect();
            format!("({env:?} {})", rows.join(" ; "))
        }
        Kind::Rows(rows) => format!("(rows {})", all(rows)),
        Kind::Marked(mark, body) => format!("({mark:?} {})", short(body)),
        Kind::Annotated { body, note, over } => {
            let note = note.as_ref().map_or(String::new(), |note| format!(" {}", short(note)));
            format!("({} {}{note})", if *over { "over" } else { "under" }, short(body))
        }
        Kind::Factorial(count, body) => format!("({} {})", "!".repeat(usize::from(*count)), short(body)),
        Kind::At { body, at } => format!("(at {} {})", short(body), short(at)),
    }
}

/// The short notation of a source's tree.
fn read(source: &str) -> String {
    match parse(source) {
        Ok(node) => short(&node),
        Err(error) => panic!("{source}: {error}"),
    }
}

/// The parts of a node with their spans, in the order of the source.
fn children(node: &Node) -> Vec<&Node> {
    let mut children: Vec<&Node> = match &node.kind {
        Kind::Empty
        | Kind::Number(_)
        | Kind::Symbol(_)
        | Kind::Function(_)
        | Kind::BigOp(_)
        | Kind::Ellipsis
        | Kind::Text(_) => Vec::new(),
        Kind::Styled(_, body)
        | Kind::Accent(_, body)
        | Kind::Dots(_, body)
        | Kind::Group { body, .. }
        | Kind::Marked(_, body)
        | Kind::Factorial(_, body) => vec![body],
        Kind::Scripts { base, sub, sup, .. } => {
            [Some(base), sub.as_ref(), sup.as_ref()].into_iter().flatten().map(AsRef::as_ref).collect()
        }
        Kind::Juxt(nodes) | Kind::List(nodes) | Kind::Rows(nodes) => nodes.iter().collect(),
        Kind::Product { first, rest } => std::iter::once(&**first).chain(rest.iter().map(|(_, node)| node)).collect(),
        Kind::Sum(terms) => terms.iter().map(|term| &term.node).collect(),
        Kind::Frac(above, below) => vec![above, below],
        Kind::Sqrt { index, body } => index.iter().map(AsRef::as_ref).chain([&**body]).collect(),
        Kind::Chain { first, links } => {
            first.iter().map(AsRef::as_ref).chain(links.iter().map(|link| &link.rhs)).collect()
        }
        Kind::Matrix { rows, .. } => rows.iter().flatten().collect(),
        Kind::Annotated { body, note, .. } => note.iter().map(AsRef::as_ref).chain([&**body]).collect(),
        Kind::At { body, at } => vec![body, at],
    };
    children.sort_by_key(|child| (child.span.start, child.span.end));
    children
}

/// Checks that every node lies within its parent, after its elder sibling, at the bounds of characters, and has no
/// blanks around it.
fn check_spans(node: &Node, source: &str) {
    let text = source.get(node.span.clone()).unwrap_or_else(|| panic!("{source:?}: {node:?} is out of bounds"));
    assert_eq!(text, text.trim(), "blanks around {node:?}");
    let mut end = node.span.start;
    for child in children(node) {
        assert!(end <= child.span.start && child.span.end <= node.span.end, "{source:?}: {child:?} in {node:?}");
        end = child.span.end;
        check_spans(child, source);
    }
    for place in operators(node) {
        let inside = node.span.start <= place.start && place.end <= node.span.end;
        assert!(inside && !source[place.clone()].trim().is_empty(), "{source:?}: {place:?} in {node:?}");
    }
}

/// The places of a node's printed signs and relations.
fn operators(node: &Node) -> Vec<super::ast::Span> {
    match &node.kind {
        Kind::Sum(terms) => terms.iter().filter_map(|term| term.sign_span.clone()).collect(),
        Kind::Chain { links, .. } => links.iter().map(|link| link.rel_span.clone()).collect(),
        _ => Vec::new(),
    }
}
