//! Edits that only a search for what was meant makes: brackets lost and gained, a side's sign, dot and cross, indices
//! lost and gained, a symbol replaced by a product of its dimension.

use crate::latex::ast::{Delim, Kind, Node, ProductOp, Sign, Term};
use crate::latex::to_latex;
use crate::semantics::Scope;
use crate::semantics::units::Dimension;

use super::change::Path;
use super::edits::Found;
use super::mutants::{Edit, EditKind, replaced_at};
use super::names::{Name, indices, placed, with_indices};
use super::near::Near;
use super::shape::{group, is_words, juxt, starts_with_number, times};

/// How many products take the place of one symbol.
const PRODUCTS: usize = 24;

/// All such edits of a formula.
pub fn wider(tree: &Node, scope: &Scope, near: &Near) -> Vec<Found> {
    let mut walk = Wider { scope, near, path: Vec::new(), alone: true, found: Vec::new() };
    walk.visit(tree);
    walk.found
}

struct Wider<'s> {
    scope: &'s Scope,
    near: &'s Near,
    path: Path,
    /// Whether the node at hand is a side of a relation or a cell of a matrix.
    alone: bool,
    found: Vec<Found>,
}

impl Wider<'_> {
    fn edit(&mut self, kind: EditKind, old: &Node, node: Node, text: String) {
        self.found.push(Found { path: self.path.clone(), node, edit: Edit { kind, text, span: old.span.clone() } });
    }

    /// Visits a node; the depth is bounded by the parser's.
    fn visit(&mut self, node: &Node) {
        if let Some(name) = Name::of(self.scope, node) {
            self.indices(node, &name);
            // A side that is a symbol alone would only be made equal to itself.
            if !self.alone {
                self.definitions(node, &name);
                self.products(node, &name);
            }
            return;
        }
        match &node.kind {
            Kind::Chain { .. } => self.sides(node),
            Kind::Sum(terms) => self.regrouped(node, terms),
            Kind::Juxt(factors) => self.dissolved(node, factors),
            Kind::Product { first, rest } => self.operators(node, first, rest),
            Kind::Function(name) if name == "sin" || name == "cos" => {
                let text = format!("`\\{name}` changed to `\\tan`");
                self.edit(EditKind::Function, node, Node::new(Kind::Function("tan".into()), node.span.clone()), text);
            }
            Kind::Number(n) if n == "1" && self.alone => {
                let null = Node::new(Kind::Number("0".into()), node.span.clone());
                self.edit(EditKind::Number, node, null, "the number 1 changed to `0`".to_owned());
            }
            Kind::Sqrt { index: None, body } => self.under_root(body),
            Kind::Text(_) => return,
            _ => {}
        }
        for (k, child) in node.children().into_iter().enumerate() {
            self.path.push(k);
            self.alone = matches!(node.kind, Kind::Chain { .. } | Kind::Matrix { .. });
            self.visit(child);
            self.path.pop();
        }
    }

    /// A factor of 2 or ½ lost under a root; of a sum it is lost in its terms.
    fn under_root(&mut self, body: &Node) {
        if matches!(body.kind, Kind::Sum(_)) || starts_with_number(body) {
            return;
        }
        let number = |digits: &str| Node::new(Kind::Number(digits.into()), body.span.clone());
        let half = Kind::Frac(Box::new(number("1")), Box::new(number("2")));
        self.path.push(0);
        for (factor, words) in [(number("2"), "doubled"), (Node::new(half, body.span.clone()), "halved")] {
            let text = format!("`{}` {words} under the root", to_latex(body));
            self.edit(EditKind::Double, body, times(&factor, body), text);
        }
        self.path.pop();
    }

    /// The sign of a side that is a sum.
    fn sides(&mut self, node: &Node) {
        for (k, side) in node.children().into_iter().enumerate() {
            let Kind::Sum(terms) = &side.kind else { continue };
            if terms.iter().any(|t| !matches!(t.sign, Sign::Plus | Sign::Minus)) || is_words(side) {
                continue;
            }
            let turned = |t: &Term| {
                let sign = if t.sign == Sign::Plus { Sign::Minus } else { Sign::Plus };
                Term { sign, sign_span: t.sign_span.clone(), node: t.node.clone() }
            };
            let negative = Node::new(Kind::Sum(terms.iter().map(turned).collect()), side.span.clone());
            self.path.push(k);
            self.edit(EditKind::Sign, side, negative, format!("all signs of `{}` flipped", to_latex(side)));
            self.path.pop();
        }
    }

    /// A bracket around the end of one term and the next: `a b - c` to `a (b - c)`, `\sin x + y` to `\sin (x + y)`.
    fn regrouped(&mut self, node: &Node, terms: &[Term]) {
        for k in 0..terms.len().saturating_sub(1) {
            let Kind::Juxt(factors) = &terms[k].node.kind else { continue };
            for at in 1..factors.len() {
                let first = Term { sign: Sign::Plus, sign_span: None, node: juxt(&factors[at..], &node.span) };
                let body = Node::new(Kind::Sum(vec![first, terms[k + 1].clone()]), node.span.clone());
                let bracket = group(body, &node.span);
                let text = format!("a bracket put around `{}`", to_latex(&bracket));
                let joined: Vec<Node> = factors[..at].iter().cloned().chain([bracket]).collect();
                let mut all = terms.to_vec();
                all[k].node = juxt(&joined, &node.span);
                all.remove(k + 1);
                let kind = match all.as_slice() {
                    [only] if only.sign == Sign::Plus => only.node.kind.clone(),
                    _ => Kind::Sum(all),
                };
                self.edit(EditKind::Bracket, &terms[k].node, Node::new(kind, node.span.clone()), text);
            }
        }
    }

    /// A bracket left out: `a (b - c)` to `a b - c`, where the product is no factor or argument itself.
    fn dissolved(&mut self, node: &Node, factors: &[Node]) {
        let Some((last, before)) = factors.split_last() else { return };
        let Kind::Group { open: Delim::Paren | Delim::Bracket | Delim::Brace, body, .. } = &last.kind else { return };
        let Kind::Sum(terms) = &body.kind else { return };
        if before.is_empty() || terms.is_empty() {
            return;
        }
        let mut all = terms.clone();
        let head: Vec<Node> = before.iter().cloned().chain([terms[0].node.clone()]).collect();
        all[0].node = juxt(&head, &node.span);
        let text = format!("the bracket of `{}` left out", to_latex(last));
        self.edit(EditKind::Bracket, last, Node::new(Kind::Sum(all), node.span.clone()), text);
    }

    fn operators(&mut self, node: &Node, first: &Node, rest: &[(ProductOp, Node)]) {
        for (k, (op, _)) in rest.iter().enumerate() {
            let (other, words) = match op {
                ProductOp::Dot => (ProductOp::Cross, "`\\cdot` changed to `\\times`"),
                ProductOp::Cross => (ProductOp::Dot, "`\\times` changed to `\\cdot`"),
                _ => continue,
            };
            let mut rest = rest.to_vec();
            rest[k].0 = other;
            let kind = Kind::Product { first: Box::new(first.clone()), rest };
            self.edit(EditKind::Operator, node, Node::new(kind, node.span.clone()), words.to_owned());
        }
    }

    /// Indices lost or gained: `m` to `m_i`, `m_i` to `m`.
    fn indices(&mut self, node: &Node, name: &Name) {
        for new in self.reindexed(name) {
            let text = format!("`{}` changed to `{}`", to_latex(node), to_latex(&new));
            self.edit(EditKind::Index, node, new, text);
        }
    }

    /// The symbol with an index lost or gained.
    fn reindexed(&self, name: &Name) -> Vec<Node> {
        let own = indices(self.scope, &name.bare).len();
        let head = |pattern: &str| pattern.split(['_', '#', '{']).next().unwrap_or_default().trim().to_owned();
        let letter = head(&name.entry.pattern);
        let mut found = Vec::new();
        for entry in self.scope.entries().filter(|e| e.pattern != name.entry.pattern && head(&e.pattern) == letter) {
            let letters: Vec<Vec<String>> = match entry.pattern.matches('#').count() {
                0 if own > 0 => vec![Vec::new()],
                1 if own == 0 => self.near.letters.iter().map(|l| vec![l.clone()]).collect(),
                _ => continue,
            };
            let others = letters.iter().filter_map(|l| with_indices(&entry.pattern, l));
            found.extend(others.map(|other| name.replaced(&other, name.dots)));
        }
        found
    }

    /// A symbol for what it is said to equal nearby, with at most one index lost or gained there: `\mathbf{P}` for
    /// `m \mathbf{v}` or `m_i \mathbf{v}`.
    fn definitions(&mut self, node: &Node, name: &Name) {
        if name.dots > 0 {
            return;
        }
        let mut seen = Vec::new();
        for side in self.near.definitions(self.scope, &name.entry.pattern) {
            let mut variants = vec![side.clone()];
            variants.extend(self.with_one_reindexed(&side));
            for variant in variants.into_iter().filter(|v| !matches!(v.kind, Kind::Number(_) | Kind::Text(_))) {
                let new = match &variant.kind {
                    Kind::Sum(_) => group(variant, &node.span),
                    _ => variant,
                };
                let latex = to_latex(&new);
                if seen.len() < PRODUCTS && !seen.contains(&latex) {
                    let text = format!("`{}` changed to `{latex}`", to_latex(node));
                    self.edit(EditKind::Replace, node, placed(&new, &node.span), text);
                    seen.push(latex);
                }
            }
        }
    }

    /// The trees in which one symbol has an index lost or gained.
    fn with_one_reindexed(&self, node: &Node) -> Vec<Node> {
        if let Some(name) = Name::of(self.scope, node) {
            return self.reindexed(&name);
        }
        let mut found = Vec::new();
        for (k, child) in node.children().into_iter().enumerate() {
            found.extend(self.with_one_reindexed(child).into_iter().map(|new| replaced_at(node, &[k], &new)));
        }
        found
    }

    /// A vector for a product of its dimension: `\mathbf{P}` for `m \dot{\mathbf{r}}`.
    fn products(&mut self, node: &Node, name: &Name) {
        let is_vector =
            self.near.vectors(self.scope).any(|v| Name::of(self.scope, v).is_some_and(|v| v.entry == name.entry));
        let Some(own) = dimension(name).filter(|_| is_vector) else { return };
        let mut made = 0;
        let scalars: Vec<Node> = self.near.scalars(self.scope).cloned().collect();
        for vector in self.near.vectors(self.scope).cloned().collect::<Vec<_>>() {
            let Some(vector) = Name::of(self.scope, &vector).filter(|v| v.entry != name.entry) else { continue };
            for scalar in &scalars {
                let Some(factor) = Name::of(self.scope, scalar).as_ref().and_then(dimension) else { continue };
                for dots in 0..=2_u8 {
                    let dotted = vector.replaced(&vector.bare, dots);
                    let of = Name::of(self.scope, &dotted).as_ref().and_then(dimension);
                    if made >= PRODUCTS || of.and_then(|d| d.times(&factor)) != Some(own) {
                        continue;
                    }
                    made += 1;
                    let product = Node::new(
                        Kind::Juxt(vec![placed(scalar, &node.span), placed(&dotted, &node.span)]),
                        node.span.clone(),
                    );
                    let text = format!("`{}` changed to `{}`", to_latex(node), to_latex(&product));
                    self.edit(EditKind::Replace, node, product, text);
                }
            }
        }
    }
}

/// The dimension of a symbol with its dots, where its unit is declared.
fn dimension(name: &Name) -> Option<Dimension> {
    let rate = Dimension::TIME.to_the((-i128::from(name.dots), 1))?;
    name.entry.dimension?.times(&rate)
}
