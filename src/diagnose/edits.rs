//! The edits at each node of a formula.

use crate::latex::ast::{Kind, Node, ProductOp, Sign, Span, Term};
use crate::latex::to_latex;
use crate::semantics::{EntryKind, Scope, is_remainder, spelling};

use super::mutants::{Edit, EditKind, Reach};
use super::names::{Name, siblings};
use super::shape::{
    acts, differential, differential_above, group, is_function, is_letter, is_null, is_words, juxt, starts_with_number,
    times, units, with_power, without_power,
};

/// An edit with the node that it puts at a path.
pub struct Found {
    pub path: Vec<usize>,
    pub node: Node,
    pub edit: Edit,
}

/// A walk over a formula that collects edits.
pub struct Walk<'s> {
    scope: &'s Scope,
    reach: Reach<'s>,
    path: Vec<usize>,
    pub found: Vec<Found>,
}

impl<'s> Walk<'s> {
    pub fn new(scope: &'s Scope, reach: Reach<'s>) -> Self {
        Walk { scope, reach, path: Vec::new(), found: Vec::new() }
    }

    fn edit(&mut self, kind: EditKind, node: Node, span: &Span, text: String) {
        self.found.push(Found { path: self.path.clone(), node, edit: Edit { kind, text, span: span.clone() } });
    }

    /// Visits a node; the depth is bounded by the parser's.
    pub fn visit(&mut self, node: &Node) {
        if let Some(name) = Name::of(self.scope, node) {
            self.name(node, &name);
            self.powers(node);
            return;
        }
        match &node.kind {
            Kind::Chain { .. } => self.sides(node),
            Kind::Matrix { .. } => self.sides(node),
            Kind::Sum(terms) => self.sum(node, terms),
            Kind::Juxt(_) if is_remainder(node) => {}
            Kind::Juxt(factors) => self.product(node, factors),
            Kind::Product { .. } => self.operators(node),
            Kind::Frac(above, below) => self.fraction(node, above, below),
            Kind::Scripts { .. } => self.scripts(node),
            Kind::Sqrt { index: None, body } => {
                let bare = group((**body).clone(), &node.span);
                self.edit(EditKind::Power, bare, &node.span, format!("the root of `{}` dropped", to_latex(body)));
                self.children(node);
            }
            Kind::Group { body, .. } if matches!(body.kind, Kind::Chain { .. }) => {}
            Kind::Number(digits) => self.number(node, digits),
            Kind::Function(name) => self.function(node, name),
            _ => self.children(node),
        }
    }

    fn children(&mut self, node: &Node) {
        for (k, child) in node.children().into_iter().enumerate() {
            self.child(k, child);
        }
    }

    fn child(&mut self, k: usize, child: &Node) {
        self.path.push(k);
        self.visit(child);
        self.path.pop();
    }

    /// The sides of relations and the cells of matrices: signs, factors of 2, and what stands in them.
    fn sides(&mut self, node: &Node) {
        for (k, side) in node.children().into_iter().enumerate() {
            self.path.push(k);
            if !is_null(side)
                && !matches!(side.kind, Kind::Sum(_) | Kind::Chain { .. } | Kind::Matrix { .. })
                && !is_words(side)
            {
                let term = Term { sign: Sign::Minus, sign_span: None, node: side.clone() };
                let negative = Node::new(Kind::Sum(vec![term]), side.span.clone());
                self.edit(EditKind::Sign, negative, &side.span, format!("the sign of `{}` flipped", to_latex(side)));
                self.double(side);
            }
            self.visit(side);
            self.path.pop();
        }
    }

    fn sum(&mut self, node: &Node, terms: &[Term]) {
        for (k, term) in terms.iter().enumerate().filter(|(_, term)| !is_remainder(&term.node)) {
            let latex = to_latex(&term.node);
            if let Some(sign) = flipped(term.sign) {
                let mut flipped = terms.to_vec();
                flipped[k].sign = sign;
                let text = format!("the sign of `{latex}` flipped");
                self.edit(EditKind::Sign, Node::new(Kind::Sum(flipped), node.span.clone()), &term.node.span, text);
            }
            if terms.len() > 1 {
                let mut rest = terms.to_vec();
                rest.remove(k);
                let kind = match rest.as_slice() {
                    [only] if only.sign == Sign::Plus => only.node.kind.clone(),
                    _ => Kind::Sum(rest),
                };
                let text = format!("the term `{latex}` dropped");
                self.edit(EditKind::DropTerm, Node::new(kind, node.span.clone()), &term.node.span, text);
            }
            self.path.push(k);
            self.double(&term.node);
            self.visit(&term.node);
            self.path.pop();
        }
    }

    /// Puts a factor of 2, or another one, before the node at hand.
    fn double(&mut self, node: &Node) {
        let two = Node::new(Kind::Number("2".into()), node.span.clone());
        if !matches!(node.kind, Kind::Number(_)) && !starts_with_number(node) {
            let text = format!("`{}` doubled", to_latex(node));
            self.edit(EditKind::Double, times(&two, node), &node.span, text);
        }
        for factor in self.reach.factors {
            let text = format!("the factor `{}` put before `{}`", to_latex(factor), to_latex(node));
            self.edit(EditKind::Insert, times(factor, node), &node.span, text);
        }
    }

    /// Factors side by side; a function or operator goes with its argument.
    fn product(&mut self, node: &Node, factors: &[Node]) {
        let units = units(self.scope, factors);
        for (from, to) in &units {
            let unit = &factors[*from..*to];
            if units.len() > 1 && !acts(&unit[0]) && !is_words(&unit[0]) && !states(&unit[0]) {
                let rest: Vec<Node> = factors[..*from].iter().chain(&factors[*to..]).cloned().collect();
                let text = format!("the factor `{}` dropped", to_latex(&juxt(unit, &node.span)));
                let span = unit[0].span.start..unit[unit.len() - 1].span.end;
                self.edit(EditKind::DropFactor, juxt(&rest, &node.span), &span, text);
            }
            if unit.len() > 1 && is_function(&unit[0]) && !starts_with_number(&unit[1]) {
                let mut doubled = factors.to_vec();
                doubled.insert(from + 1, Node::new(Kind::Number("2".into()), unit[1].span.clone()));
                let text = format!("the argument `{}` doubled", to_latex(&unit[1]));
                self.edit(EditKind::Double, Node::new(Kind::Juxt(doubled), node.span.clone()), &unit[1].span, text);
                self.raise(node, factors, *from);
            }
        }
        self.without_differentials(node, factors);
        self.close_elsewhere(node, factors);
        self.part_squares(node, factors);
        for (k, factor) in factors.iter().enumerate() {
            if !is_letter(factor, "d") {
                self.child(k, factor);
            }
        }
    }

    /// A function squared, `\sin \theta` to `\sin^2 \theta`; only where factors may be put in.
    fn raise(&mut self, node: &Node, factors: &[Node], k: usize) {
        if self.reach.factors.is_empty() || !matches!(factors[k].kind, Kind::Function(_)) {
            return;
        }
        let mut raised = factors.to_vec();
        raised[k] = with_power(&factors[k], 2);
        let text = format!("`{}` squared", to_latex(&factors[k]));
        self.edit(EditKind::Power, Node::new(Kind::Juxt(raised), node.span.clone()), &factors[k].span, text);
    }

    /// A bracket that closes after the next factor, or a function's argument that is bracketed: only where factors may
    /// be put in, as these edits mostly misshape.
    fn close_elsewhere(&mut self, node: &Node, factors: &[Node]) {
        if self.reach.factors.is_empty() {
            return;
        }
        for k in 0..factors.len().saturating_sub(1) {
            let Kind::Group { open, close, body } = &factors[k].kind else { continue };
            let Kind::Sum(terms) = &body.kind else { continue };
            let mut longer = terms.clone();
            if let Some(last) = longer.last_mut() {
                last.node = times(&last.node, &factors[k + 1]);
            }
            let body = Box::new(Node::new(Kind::Sum(longer), body.span.clone()));
            let bracket = Node::new(Kind::Group { open: *open, close: *close, body }, factors[k].span.clone());
            let all: Vec<Node> = factors[..k].iter().chain([&bracket]).chain(&factors[k + 2..]).cloned().collect();
            let text = format!("the bracket closed after `{}`", to_latex(&factors[k + 1]));
            self.edit(EditKind::Bracket, juxt(&all, &node.span), &factors[k + 1].span, text);
        }
    }

    /// A letter d that should not stand before a factor; only where factors may be put in.
    fn without_differentials(&mut self, node: &Node, factors: &[Node]) {
        for k in (0..factors.len()).filter(|k| is_letter(&factors[*k], "d") && !self.reach.factors.is_empty()) {
            let rest: Vec<Node> = factors[..k].iter().chain(&factors[k + 1..]).cloned().collect();
            if !rest.is_empty() {
                let text = format!("the letter d dropped from `{}`", to_latex(node));
                self.edit(EditKind::DropFactor, juxt(&rest, &node.span), &factors[k].span, text);
            }
        }
    }

    /// A square that should be the product with another symbol; only where factors may be put in.
    fn part_squares(&mut self, node: &Node, factors: &[Node]) {
        if self.reach.factors.is_empty() {
            return;
        }
        for (k, factor) in factors.iter().enumerate() {
            let Kind::Scripts { sup: Some(sup), .. } = &factor.kind else { continue };
            if !matches!(&sup.kind, Kind::Number(n) if n == "2") {
                continue;
            }
            let bare = without_power(factor);
            let Some(name) = Name::of(self.scope, &bare) else { continue };
            for (kind, other) in siblings(self.scope, &name, self.reach.siblings) {
                let other = name.replaced(&other, name.dots);
                let text = format!("`{}` changed to `{} {}`", to_latex(factor), to_latex(&bare), to_latex(&other));
                let mut parted = factors.to_vec();
                parted.splice(k..=k, [bare.clone(), other]);
                self.edit(kind, Node::new(Kind::Juxt(parted), node.span.clone()), &factor.span, text);
            }
        }
    }

    fn operators(&mut self, node: &Node) {
        if let Kind::Product { first, rest } = &node.kind
            && let [(ProductOp::Slash, below)] = rest.as_slice()
        {
            let kind =
                Kind::Product { first: Box::new(below.clone()), rest: vec![(ProductOp::Slash, (**first).clone())] };
            let text = format!("`{}` turned over", to_latex(node));
            self.edit(EditKind::Invert, Node::new(kind, node.span.clone()), &node.span, text);
        }
        self.children(node);
    }

    fn fraction(&mut self, node: &Node, above: &Node, below: &Node) {
        // Something left over when the d is dropped is no derivative: d I_0 without an operand above.
        if differential(below) && differential_above(above) {
            // Only what is differentiated is edited.
            if let Kind::Juxt(factors) = &above.kind {
                self.path.push(0);
                factors.iter().enumerate().skip(1).for_each(|(k, f)| self.child(k, f));
                self.path.pop();
            }
            return;
        }
        let frac = |a: Node, b: Node| Node::new(Kind::Frac(Box::new(a), Box::new(b)), node.span.clone());
        let one = |at: &Node| Node::new(Kind::Number("1".into()), at.span.clone());
        let text = format!("`{}` turned over", to_latex(node));
        self.edit(EditKind::Invert, frac(below.clone(), above.clone()), &node.span, text);
        for (part, bare) in [(above, frac(one(above), below.clone())), (below, frac(above.clone(), one(below)))] {
            let text = format!("the factor `{}` dropped from `{}`", to_latex(part), to_latex(node));
            self.edit(EditKind::DropFactor, bare, &part.span, text);
        }
        for (k, part) in [above, below].into_iter().enumerate() {
            self.path.push(k);
            if !self.reach.factors.is_empty() && !matches!(part.kind, Kind::Sum(_)) {
                self.double(part);
            }
            self.visit(part);
            self.path.pop();
        }
    }

    /// A base with scripts that is no declared symbol: powers of brackets and functions, components of brackets.
    fn scripts(&mut self, node: &Node) {
        let Kind::Scripts { base, primes, sub, sup } = &node.kind else { return };
        if matches!(base.kind, Kind::BigOp(_)) || is_letter(base, "d") {
            return;
        }
        self.powers(node);
        if let Some(sub) = sub
            && let Some((basis, axis)) = self.scope.axis(&spelling(sub))
        {
            for other in (0..3).filter(|k| *k != axis) {
                let Ok(letter) = crate::latex::parse(&basis.axes[other]) else { continue };
                let letter = Box::new(super::names::placed(&letter, &sub.span));
                let text = format!("the index `{}` of a bracket changed to `{}`", to_latex(sub), to_latex(&letter));
                let kind = Kind::Scripts { base: base.clone(), primes: *primes, sub: Some(letter), sup: sup.clone() };
                self.edit(EditKind::Index, Node::new(kind, node.span.clone()), &sub.span, text);
            }
        }
        self.child(0, base);
        if let Some(sup) = sup
            && !matches!(sup.kind, Kind::Number(_) | Kind::Symbol(_) | Kind::Text(_))
            && to_latex(sup) != "-1"
        {
            self.child(1 + usize::from(sub.is_some()), sup);
        }
    }

    /// A power raised, lowered, left out.
    fn powers(&mut self, node: &Node) {
        let (power, span) = match &node.kind {
            Kind::Scripts { sup: Some(sup), .. } => match &sup.kind {
                Kind::Number(n) => match n.parse::<u32>() {
                    Ok(n) if (2..100).contains(&n) => (n, sup.span.clone()),
                    _ => return,
                },
                _ => return,
            },
            _ if self.reach.factors.is_empty() => return,
            _ => (1, node.span.clone()),
        };
        for other in [power - 1, power + 1, 1] {
            if other >= 1 && other != power {
                let text = format!("the power {power} of `{}` changed to {other}", to_latex(&without_power(node)));
                self.edit(EditKind::Power, with_power(node, other), &span, text);
            }
        }
    }

    fn number(&mut self, node: &Node, digits: &str) {
        let number = |n: String| Node::new(Kind::Number(n), node.span.clone());
        let mut others = Vec::new();
        if let Ok(n) = digits.parse::<u32>() {
            others.push(number(n.saturating_add(1).to_string()));
            if n > 1 {
                others.push(number((n - 1).to_string()));
                others.push(number("1".into()));
                others.push(Node::new(
                    Kind::Frac(Box::new(number("1".into())), Box::new(number(n.to_string()))),
                    node.span.clone(),
                ));
            }
        } else {
            let two = number("2".into());
            others.push(Node::new(Kind::Frac(Box::new(node.clone()), Box::new(two)), node.span.clone()));
            others.extend(next_digit(digits).map(number));
        }
        for other in others {
            let text = format!("the number {digits} changed to `{}`", to_latex(&other));
            self.edit(EditKind::Number, other, &node.span, text);
        }
    }

    fn function(&mut self, node: &Node, name: &str) {
        let other = match name {
            "sin" => "cos",
            "cos" => "sin",
            "sinh" => "cosh",
            "cosh" => "sinh",
            _ => return,
        };
        let text = format!("`\\{name}` changed to `\\{other}`");
        self.edit(EditKind::Function, Node::new(Kind::Function(other.into()), node.span.clone()), &node.span, text);
    }

    fn name(&mut self, node: &Node, name: &Name) {
        let shown = to_latex(&without_power(node));
        for (kind, other) in siblings(self.scope, name, self.reach.siblings) {
            let new = name.replaced(&other, name.dots);
            let text = format!("`{shown}` changed to `{}`", to_latex(&without_power(&new)));
            self.edit(kind, new, &node.span, text);
        }
        // Another notation of a symbol that depends on time has dots, too.
        let renamed = matches!(name.entry.kind, EntryKind::Same(_)) && !self.reach.factors.is_empty();
        if name.entry.of_t || name.dots > 0 || renamed {
            // A scan loses both dots of an acceleration.
            let both = (!self.reach.factors.is_empty()).then_some(name.dots + 2);
            for dots in [name.dots.wrapping_sub(1), name.dots + 1].into_iter().chain(both) {
                if dots <= 3 {
                    let new = name.replaced(&name.bare, dots);
                    let text = format!("`{shown}` changed to `{}`", to_latex(&without_power(&new)));
                    self.edit(EditKind::Dot, new, &node.span, text);
                }
            }
        }
    }
}

/// A decimal with its last digit one up; from 9 it goes one down.
fn next_digit(digits: &str) -> Option<String> {
    let last = digits.chars().last()?.to_digit(10)?;
    let next = if last == 9 { 8 } else { last + 1 };
    Some(format!("{}{next}", &digits[..digits.len() - 1]))
}

/// Whether a bracket or a block beside others is a statement and no factor: `f (= g)`.
fn states(node: &Node) -> bool {
    match &node.kind {
        Kind::Chain { .. } => true,
        Kind::Rows(nodes) | Kind::List(nodes) => nodes.iter().any(states),
        Kind::Group { body, .. } => states(body),
        Kind::Matrix { rows, .. } => rows.iter().flatten().any(states),
        _ => false,
    }
}

fn flipped(sign: Sign) -> Option<Sign> {
    match sign {
        Sign::Plus => Some(Sign::Minus),
        Sign::Minus => Some(Sign::Plus),
        Sign::PlusMinus | Sign::MinusPlus => None,
    }
}
