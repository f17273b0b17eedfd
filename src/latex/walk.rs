//! Walking over the syntax tree.

use super::ast::{Kind, Link, Node, Term};

impl Node {
    /// The nodes directly below this one, in the order of writing.
    pub fn children(&self) -> Vec<&Node> {
        match &self.kind {
            Kind::Styled(_, b) | Kind::Accent(_, b) | Kind::Dots(_, b) | Kind::Factorial(_, b) | Kind::Marked(_, b) => {
                vec![b]
            }
            Kind::Group { body, .. } => vec![body],
            Kind::Annotated { body, note, .. } => std::iter::once(body.as_ref()).chain(note.as_deref()).collect(),
            Kind::Scripts { base, sub, sup, .. } => {
                std::iter::once(base.as_ref()).chain(sub.as_deref()).chain(sup.as_deref()).collect()
            }
            Kind::Product { first, rest } => {
                std::iter::once(first.as_ref()).chain(rest.iter().map(|(_, n)| n)).collect()
            }
            Kind::Juxt(nodes) | Kind::List(nodes) | Kind::Rows(nodes) => nodes.iter().collect(),
            Kind::Sum(terms) => terms.iter().map(|t| &t.node).collect(),
            Kind::Frac(a, b) => vec![a, b],
            Kind::Sqrt { index, body } => index.as_deref().into_iter().chain([body.as_ref()]).collect(),
            Kind::Chain { first, links } => first.as_deref().into_iter().chain(links.iter().map(|l| &l.rhs)).collect(),
            Kind::Matrix { rows, .. } => rows.iter().flatten().collect(),
            Kind::At { body, at } => vec![body, at],
            Kind::Empty
            | Kind::Number(_)
            | Kind::Symbol(_)
            | Kind::Function(_)
            | Kind::BigOp(_)
            | Kind::Text(_)
            | Kind::Ellipsis => Vec::new(),
        }
    }

    /// The same node with each node directly below it replaced.
    pub fn map_children(&self, f: &mut dyn FnMut(&Node) -> Node) -> Node {
        let mut boxed = |n: &Node| Box::new(f(n));
        let kind = match &self.kind {
            Kind::Styled(font, b) => Kind::Styled(*font, boxed(b)),
            Kind::Accent(accent, b) => Kind::Accent(*accent, boxed(b)),
            Kind::Dots(n, b) => Kind::Dots(*n, boxed(b)),
            Kind::Factorial(n, b) => Kind::Factorial(*n, boxed(b)),
            Kind::Marked(mark, b) => Kind::Marked(*mark, boxed(b)),
            Kind::Annotated { body, note, over } => {
                Kind::Annotated { body: boxed(body), note: note.as_deref().map(boxed), over: *over }
            }
            Kind::Group { open, close, body } => Kind::Group { open: *open, close: *close, body: boxed(body) },
            Kind::Scripts { base, primes, sub, sup } => Kind::Scripts {
                base: boxed(base),
                primes: *primes,
                sub: sub.as_deref().map(&mut boxed),
                sup: sup.as_deref().map(&mut boxed),
            },
            Kind::Product { first, rest } => {
                Kind::Product { first: boxed(first), rest: rest.iter().map(|(op, n)| (*op, f(n))).collect() }
            }
            Kind::Juxt(nodes) => Kind::Juxt(nodes.iter().map(f).collect()),
            Kind::List(nodes) => Kind::List(nodes.iter().map(f).collect()),
            Kind::Rows(nodes) => Kind::Rows(nodes.iter().map(f).collect()),
            Kind::Sum(terms) => {
                let term = |t: &Term| Term { sign: t.sign, sign_span: t.sign_span.clone(), node: f(&t.node) };
                Kind::Sum(terms.iter().map(term).collect())
            }
            Kind::Frac(a, b) => Kind::Frac(boxed(a), boxed(b)),
            Kind::Sqrt { index, body } => Kind::Sqrt { index: index.as_deref().map(&mut boxed), body: boxed(body) },
            Kind::Chain { first, links } => {
                let first = first.as_deref().map(&mut boxed);
                let link = |l: &Link| Link { rel: l.rel, rel_span: l.rel_span.clone(), rhs: f(&l.rhs) };
                Kind::Chain { first, links: links.iter().map(link).collect() }
            }
            Kind::Matrix { env, rows } => {
                Kind::Matrix { env: *env, rows: rows.iter().map(|row| row.iter().map(&mut *f).collect()).collect() }
            }
            Kind::At { body, at } => Kind::At { body: boxed(body), at: boxed(at) },
            leaf @ (Kind::Empty
            | Kind::Number(_)
            | Kind::Symbol(_)
            | Kind::Function(_)
            | Kind::BigOp(_)
            | Kind::Text(_)
            | Kind::Ellipsis) => leaf.clone(),
        };
        Node::new(kind, self.span.clone())
    }
}
