//! Elliptic functions as lecture notes print them.
//!
//! - Jacobi's functions sn, cn, dn, am, and Glaisher's quotients of the first three (nd, sd, tn = sn/cn, ...), in
//!   `\operatorname{sn}`, `\mathrm{sn}`, `\text{sn}` or plain letters, where those are no symbols: `\operatorname{sn}^2
//!   u`, `\text{cn}u`, `\mathrm{sn}(u, k)`.
//! - Legendre's integrals `\operatorname{K}`, `\operatorname{E}`, `\operatorname{F}`, `\operatorname{Pi}`, complete or
//!   incomplete by the number of their arguments. Letters mean them where they are declared to: `'K' = { same =
//!   '\operatorname{K}' }`.
//!
//! Without a bracket, Jacobi's functions take one factor and the numbers before it: `\operatorname{sn} 2u
//! \operatorname{cn} u \dot{u}` is sn(2u) cn(u) u̇. The last argument is the modulus k. Where it is not printed it is
//! what the section declares: `modulus = 'k'`, any formula.

use crate::expr::{Elliptic, Expr};
use crate::latex::ast::{Font, Kind, Node};

use super::elaborate::{Elaborator, Typed};
use super::error::{Error, Result};
use super::juxtaposition::{Item, head_and_power, is_bracket};
use super::scope::EntryKind;
use super::value::Value;

/// What a name means.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Named {
    /// A quotient of two of sn, cn, dn; `None` for one.
    Quotient(Option<Elliptic>, Option<Elliptic>),
    /// The amplitude.
    Amplitude,
    /// Legendre's integrals: complete where there is one, incomplete.
    Legendre(Option<Elliptic>, Elliptic),
}

/// The meaning of a name of letters.
fn named(name: &str) -> Option<Named> {
    let letter = |c: char| match c {
        's' => Some(Some(Elliptic::Sn)),
        'c' => Some(Some(Elliptic::Cn)),
        'd' => Some(Some(Elliptic::Dn)),
        'n' => Some(None),
        _ => None,
    };
    match name {
        "am" => return Some(Named::Amplitude),
        "tn" => return Some(Named::Quotient(Some(Elliptic::Sn), Some(Elliptic::Cn))),
        "K" => return Some(Named::Legendre(Some(Elliptic::CompleteK), Elliptic::IncompleteF)),
        "F" => return Some(Named::Legendre(None, Elliptic::IncompleteF)),
        "E" => return Some(Named::Legendre(Some(Elliptic::CompleteE), Elliptic::IncompleteE)),
        "Pi" => return Some(Named::Legendre(Some(Elliptic::CompletePi), Elliptic::IncompletePi)),
        _ => {}
    }
    let mut letters = name.chars();
    let (over, under) = (letter(letters.next()?)?, letter(letters.next()?)?);
    (letters.next().is_none() && over != under).then_some(Named::Quotient(over, under))
}

/// The letters of an upright name.
fn upright(node: &Node) -> Option<String> {
    match &node.kind {
        Kind::Function(name) | Kind::Text(name) => Some(name.trim().to_owned()),
        Kind::Styled(Font::Roman, body) => match &body.kind {
            Kind::Symbol(s) => Some(s.clone()),
            Kind::Juxt(letters) => letters.iter().map(symbol).collect(),
            _ => None,
        },
        _ => None,
    }
}

fn symbol(node: &Node) -> Option<String> {
    match &node.kind {
        Kind::Symbol(s) => Some(s.clone()),
        _ => None,
    }
}

/// The function that an upright name means; words mean Jacobi's only.
fn meant(node: &Node) -> Option<Named> {
    let found = named(&upright(node)?)?;
    let words = matches!(node.kind, Kind::Text(_)) && matches!(found, Named::Legendre(..));
    (!words).then_some(found)
}

/// Whether a text is the name of a function rather than words.
pub(super) fn is_name(node: &Node) -> bool {
    meant(head_and_power(node).0).is_some()
}

impl Elaborator<'_> {
    /// An elliptic function at the head of these items with its arguments, and how many items they are; none where
    /// there is no such function.
    pub(super) fn elliptic(&mut self, items: &[Item]) -> Result<Option<(Typed, usize)>> {
        let Some((named, power, length)) = self.elliptic_name(items) else { return Ok(None) };
        let rest = &items[length..];
        let Some(Item::Factor(node)) = items.first() else { return Ok(None) };
        let own = argument_length(named, rest);
        if own == 0 && !matches!(named, Named::Legendre(..)) {
            return Err(Error::unsupported("this elliptic function has no argument here", &node.span));
        }
        let arguments = match &rest[..own] {
            [] => Vec::new(),
            rest => {
                let typed = self.items(rest)?;
                match typed.value {
                    Value::Tuple(values) => values.into_iter().map(|v| Typed::new(v, "")).collect(),
                    _ => vec![typed],
                }
            }
        };
        let x = arguments.iter().map(|a| self.scalar(a, &node.span)).collect::<Result<Vec<_>>>()?;
        if power.is_some_and(|p| crate::latex::to_latex(p) == "-1") {
            return Err(Error::unsupported("inverse elliptic functions are not evaluated yet", &node.span)
                .with_help("the inverse of sn(u, k) is \\operatorname{F}(\\arcsin x, k)"));
        }
        let value = self.elliptic_value(named, &x, node)?;
        let shown = self.world.graph.display(value);
        let is_quotient = matches!(self.world.graph.node(value), crate::expr::Node::Div(..));
        let text = if is_quotient { format!("({shown})") } else { shown };
        let result = self.with_power(Typed::new(Value::Scalar(value), text), power, &node.span)?;
        Ok(Some((result, length + own)))
    }

    /// The function that stands first, its power, and the number of items that its name is.
    fn elliptic_name<'n>(&self, items: &[Item<'n>]) -> Option<(Named, Option<&'n Node>, usize)> {
        let Item::Factor(node) = *items.first()? else { return None };
        let (head, power) = head_and_power(node);
        if let Some((entry, _)) = self.entry(head) {
            let EntryKind::Same(other) = &entry.kind else { return None };
            return Some((meant(other)?, power, 1));
        }
        if let Some(found) = meant(head) {
            return Some((found, power, 1));
        }
        // Letters side by side, as long as they are no symbols.
        let Item::Factor(next) = *items.get(1)? else { return None };
        let (second, power) = head_and_power(next);
        let name = format!("{}{}", symbol(node)?, symbol(second)?);
        let free = self.entry(second).is_none() && self.entry(node).is_none();
        let jacobi = named(&name).filter(|found| !matches!(found, Named::Legendre(..)))?;
        (free && items.len() > 2).then_some((jacobi, power, 2))
    }

    /// The value at printed arguments, with the section's modulus where it is not among them.
    fn elliptic_value(&mut self, named: Named, x: &[Expr], node: &Node) -> Result<Expr> {
        match named {
            Named::Quotient(over, under) => {
                let arguments = self.with_modulus(x, 2, node)?;
                let graph = &mut self.world.graph;
                let one = graph.int(1);
                let [over, under] = [over, under].map(|f| f.map_or(one, |f| graph.elliptic(f, &arguments)));
                Ok(graph.div(over, under))
            }
            Named::Amplitude => {
                let arguments = self.with_modulus(x, 2, node)?;
                Ok(self.world.graph.elliptic(Elliptic::Am, &arguments))
            }
            Named::Legendre(complete, incomplete) => {
                // K, K(k) and F(φ, k); Π(n), Π(n, k) and Π(φ, n, k).
                let f = complete.filter(|_| x.len() < incomplete.arity()).unwrap_or(incomplete);
                let arguments = self.with_modulus(x, f.arity(), node)?;
                Ok(self.world.graph.elliptic(f, &arguments))
            }
        }
    }

    /// The arguments, the last of which is the modulus.
    fn with_modulus(&mut self, x: &[Expr], count: usize, node: &Node) -> Result<Vec<Expr>> {
        let mut arguments = x.to_vec();
        if arguments.len() + 1 == count {
            let Some(modulus) = self.scope.modulus.clone() else {
                return Err(Error::undeclared("the modulus of this elliptic function is not printed", &node.span)
                    .with_help("declare it for the section: modulus = 'k'"));
            };
            let modulus = self.value(&modulus)?;
            arguments.push(self.scalar(&modulus, &node.span)?);
        }
        match arguments.len() == count {
            true => Ok(arguments),
            false => Err(Error::shape(format!("an elliptic function of {} arguments", x.len()), &node.span)),
        }
    }
}

/// How many items the arguments are: a bracket, or, of Jacobi's functions, numbers and one more factor.
fn argument_length(named: Named, rest: &[Item]) -> usize {
    fn factor<'n>(item: &Item<'n>) -> Option<&'n Node> {
        match item {
            Item::Factor(n) => Some(*n),
            Item::Op(..) => None,
        }
    }
    let bracket = rest.first().and_then(factor).is_some_and(is_bracket);
    if bracket || matches!(named, Named::Legendre(..)) {
        return usize::from(bracket);
    }
    let factors: Vec<_> = rest.iter().map_while(factor).collect();
    let numbers = factors.iter().take_while(|n| matches!(n.kind, Kind::Number(_))).count();
    (numbers + 1).min(factors.len())
}

#[cfg(test)]
mod tests {
    use super::super::testing::{scope, value};
    use super::super::{Scope, World};
    use super::*;

    const DECLARATIONS: &str = r"
modulus = 'k'
[symbols]
'k, q' = { range = [0.1, 0.9] }
'u, v' = { range = [0.1, 3] }
't' = { range = [0.1, 1] }
'K' = { same = '\operatorname{K}' }
'\Pi' = { same = '\operatorname{Pi}' }
";

    fn shown(scope: &Scope, latex: &str) -> String {
        let mut world = World::new();
        match value(&mut world, scope, latex) {
            Ok(Value::Scalar(e)) => world.graph.display(e),
            other => format!("{other:?}"),
        }
    }

    #[test]
    fn all_spellings() {
        let scope = scope(DECLARATIONS);
        for latex in [
            r"\operatorname{sn} u",
            r"\mathrm{sn}\, u",
            r"\text{sn}u",
            "sn u",
            r"\text{sn}(u)",
            r"\operatorname{sn}(u, k)",
            r"sn(u, k)",
        ] {
            assert_eq!(shown(&scope, latex), "sn(u, k)", "{latex}");
        }
        for (latex, text) in [
            (r"\operatorname{sn}^2 u", "sn(u, k)^2"),
            (r"\text{cn}^2 u", "cn(u, k)^2"),
            (r"\text{cn} 2u t", "(cn((2 * u), k) * t)"),
            (r"\operatorname{dn}(v, q)", "dn(v, q)"),
            (r"t \operatorname{nd} u", "(t * (1 / dn(u, k)))"),
            (r"\operatorname{sd}u", "(sn(u, k) / dn(u, k))"),
            (r"\text{tn}u", "(sn(u, k) / cn(u, k))"),
            (r"\text{am}u", "am(u, k)"),
            (r"\frac{\text{sn}u}{\text{cn}u}", "(sn(u, k) / cn(u, k))"),
            (r"4K", "(4 * K(k))"),
            (r"K(q)", "K(q)"),
            (r"\Pi(u, v, q)", "Π(u, v, q)"),
            (r"\Pi(v)", "Π(v, k)"),
            (r"\operatorname{F}(u, q)", "F(u, q)"),
            (r"\operatorname{F}(u)", "F(u, k)"),
            ("K", "K(k)"),
            (r"\operatorname{E}(k)", "E(k)"),
        ] {
            assert_eq!(shown(&scope, latex), text, "{latex}");
        }
    }

    #[test]
    fn what_cannot_be_meant_is_an_error_with_its_place() {
        let plain = scope("[symbols]\n'u' = { range = [0, 1] }\n's, n' = { range = [0, 1] }");
        let mut world = World::new();
        let error = value(&mut world, &plain, r"1 + \operatorname{sn} u").unwrap_err();
        assert!(error.message.contains("modulus") && error.span.start == 4, "{error:?}");
        assert!(!shown(&plain, "s n u").contains("sn("), "declared letters are symbols");
        let scope = scope(DECLARATIONS);
        assert!(value(&mut world, &scope, r"\operatorname{sn}(u, v, k)").is_err());
        assert!(value(&mut world, &scope, r"\operatorname{sn}").is_err());
        assert!(value(&mut world, &scope, r"\operatorname{sn}^{-1} u").is_err());
        assert!(value(&mut world, &scope, r"\Pi").is_err());
        assert!(value(&mut world, &scope, r"\text{if } u").is_ok(), "words are left out");
    }
}
