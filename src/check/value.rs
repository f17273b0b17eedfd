//! Printed values: `x = 0.0032`, `\cong 9''2`, `\sim 10^{-7}`, `= -\frac{1}{434}`, `\sim 3 : 2`.
//!
//! An equation of `kind = "value"` is evaluated with the values that its `data` give to symbols and with its premises. The
//! digits are read off the printed LaTeX. The rules, by what the printed side is:
//! - one numeral, perhaps with a power of ten, a unit, or below a 1: it is rounded, and the other side must agree to half a
//!   unit of its last printed digit (with `digits = n`, of its n-th significant digit), the end of that interval included;
//! - a power of ten alone: an order of magnitude, right to within a factor of √10 either way;
//! - a ratio p : q of whole numbers (q > 1) beside a relation other than `=`: the other side x must have p/q as a convergent of its
//!   continued fraction, |x - p/q| < 1/(2q²) (Legendre);
//! - anything else is arithmetic with the numbers that were put in, and must be equal to the other side.
//!
//! A value that is printed for a symbol of which neither data nor premises say anything is a datum of the notes: taken as
//! given, and known to the links behind it.

use std::collections::BTreeMap;

use crate::expr::{Expr, Node as Op, Tape, Workspace};
use crate::latex::ast::{Kind, Node, Rel};
use crate::number::{Df64, Number};
use crate::semantics::units::Dimension;
use crate::semantics::{self, Clause, Scope, Side, Value};

use super::book::{Book, Entry};
use super::claim::{Claim, Obstacle, Source, Stated};
use super::judge::Options;
use super::random::Random;
use super::sampling::{Sampler, no_state_text};
use super::verdict::{LinkJudgement, Strength, Verdict};

/// How far beyond half a unit the arithmetic may lie, relative to it: printed halves are not binary fractions.
const SLACK: f64 = 1e-12;

/// What a printed side is.
#[derive(Clone, Debug, PartialEq)]
enum Form {
    /// A numeral, with the side in which half a unit of its last digit is added to it, and its significant digits.
    Rounded(Node, u32),
    /// A power of ten.
    Magnitude,
    /// A ratio of whole numbers, with the second.
    Ratio(f64),
    /// Arithmetic with several numerals.
    Arithmetic,
}

/// A link with a printed value.
#[derive(Clone, Debug)]
pub struct Printed {
    form: Form,
    /// Whether the printed side is the left one.
    left: bool,
}

impl Printed {
    /// Whether the link is arithmetic, and so an equality.
    pub fn is_arithmetic(&self) -> bool {
        self.form == Form::Arithmetic
    }
}

/// Whether an equation is about printed values.
pub fn is_value(book: &Book, index: usize) -> bool {
    let kind = book.entries[index].annotation().and_then(|a| a.kind.as_ref());
    kind.is_some_and(|k| k.value == "value")
}

/// The printed side of a link of an equation about printed values: the right one, where both are.
pub fn printed(entry: &Entry, clause: &Clause) -> Option<Printed> {
    if !matches!(clause.rel, Rel::Eq | Rel::Equiv | Rel::Sim | Rel::Approx | Rel::Cong) {
        return None;
    }
    let Side::Node(rhs) = &clause.rhs else { return None };
    let form = |side: &Node| is_numeric(entry, side).then(|| form(side, clause.rel));
    let (lhs, rhs) = (form(&clause.lhs), form(rhs));
    match (lhs, rhs) {
        (Some(form), None | Some(Form::Arithmetic)) => Some(Printed { form, left: true }),
        (_, Some(form)) => Some(Printed { form, left: false }),
        (None, None) => None,
    }
}

/// Judges a printed value.
pub fn judge(
    judgement: LinkJudgement,
    source: &Source,
    clause: &Clause,
    printed: &Printed,
    claim: Claim,
    options: &Options,
) -> LinkJudgement {
    let entry = &source.book.entries[source.index];
    match compared(&judgement, source, clause, printed, claim, options) {
        Ok(judged) => judged,
        Err(Missing::Data(symbol)) if is_name(entry, other(clause, printed)) => {
            let reason = format!("a datum of the notes: neither data nor premises say what {symbol} is");
            LinkJudgement { verdict: Verdict::Definition, reason: Some(reason), ..judgement }
        }
        Err(Missing::Data(symbol)) => {
            let reason = format!("no value is known for {symbol}: give it one under data = {{ '{symbol}' = ... }}");
            LinkJudgement { reason: Some(reason), ..judgement }
        }
        Err(Missing::Why(reason)) => LinkJudgement { reason: Some(reason), ..judgement },
    }
}

/// Why a printed value could not be compared.
enum Missing {
    /// The value of a symbol.
    Data(String),
    /// Something else.
    Why(String),
}

fn compared(
    judgement: &LinkJudgement,
    source: &Source,
    clause: &Clause,
    printed: &Printed,
    mut claim: Claim,
    options: &Options,
) -> Result<LinkJudgement, Missing> {
    let entry = &source.book.entries[source.index];
    let shifted = match &printed.form {
        Form::Rounded(shifted, _) => Some(scalar(&mut claim, &entry.scope, shifted)?),
        _ => None,
    };
    let mut random = Random::new(options.seed, &clause.latex());
    let extra: Vec<Expr> = shifted.into_iter().collect();
    let tape = Tape::compile(&claim.world.graph, &extra);
    let sampler = Sampler::new(&mut claim, &mut random, &extra).map_err(|e| Missing::Why(no_state_text(&e)))?;
    if let Some(free) = sampler.system.free.iter().find(|s| sampler.tape.inputs().contains(&s.symbol)) {
        return Err(Missing::Data(sampler.claim.world.tex(free.symbol)));
    }
    let states = sampler.states(1, &mut random, &BTreeMap::new()).map_err(|e| Missing::Why(no_state_text(&e)))?;
    let (Some(state), [branch]) = (states.first(), sampler.claim.branches.as_slice()) else {
        return Err(Missing::Why("a printed value is one number".into()));
    };
    let values = sampler.evaluate::<Df64>(state, &(), &mut Workspace::default());
    let (Some(values), [pair]) = (values, branch.as_slice()) else {
        return Err(Missing::Why("a printed value is one number".into()));
    };
    let value = &values[0][0];
    let (lhs, rhs) = (value.lhs.value().to_f64(), value.rhs.value().to_f64());
    let (shown, other) = if printed.left { (lhs, rhs) } else { (rhs, lhs) };
    let difference = value.residual.value().to_f64().abs();
    let half = match extra.is_empty() {
        true => 0.0,
        false => {
            let Some(refined) = sampler.system.refine::<Df64>(state, &()) else {
                return Err(Missing::Why("the premises could not be solved precisely".into()));
            };
            let inputs: Vec<_> = tape.inputs().iter().map(|s| refined[s.index()].clone()).collect();
            (tape.eval(&inputs, &(), &mut Workspace::default())[0].value().to_f64() - shown).abs()
        }
    };
    let (allowed, rule) = allowance(&printed.form, shown, half, entry.annotation().and_then(|a| a.digits));
    let agrees = match &printed.form {
        Form::Magnitude => other * shown > 0.0 && (other / shown).log10().abs() <= 0.5,
        _ => difference <= allowed * (1.0 + SLACK),
    };
    let example = (!agrees).then(|| sampler.counterexample(state, &(), pair, value, &[]));
    Ok(LinkJudgement {
        verdict: if agrees { Verdict::Holds } else { Verdict::Fails },
        strength: Some(Strength::Numeric),
        residual: Some(difference / shown.abs()),
        states: 1,
        failing_states: usize::from(!agrees),
        counterexample: example,
        reason: Some(format!("printed {}, evaluated {}: {rule}", decimal(shown), decimal(other))),
        inexact: Some("a printed value is rounded".into()),
        ..judgement.clone()
    })
}

/// How far the other side may be away, and the rule in words.
fn allowance(form: &Form, shown: f64, half: f64, digits: Option<u32>) -> (f64, String) {
    match form {
        Form::Rounded(_, printed) => {
            let kept = digits.map_or(*printed, |d| d.min(*printed));
            let unit = (*printed).saturating_sub(kept);
            let allowed = half * 10f64.powi(i32::try_from(unit).unwrap_or(i32::MAX));
            let digit = if unit == 0 { "last digit".to_owned() } else { format!("significant digit {kept}") };
            (allowed, format!("half a unit of the {digit} is {}", decimal(allowed)))
        }
        Form::Ratio(q) => (0.5 / (q * q), format!("a best fraction is near to within {}", decimal(0.5 / (q * q)))),
        Form::Magnitude => (shown.abs(), "an order of magnitude is right to within a factor of √10".into()),
        Form::Arithmetic => (0.0, "arithmetic is exact".into()),
    }
}

fn decimal(x: f64) -> String {
    if (1e-3..1e4).contains(&x.abs()) { format!("{x:.6}") } else { format!("{x:.5e}") }
}

/// The value of a side with one numeral changed, with the premises put in.
fn scalar(claim: &mut Claim, scope: &Scope, node: &Node) -> Result<Expr, Missing> {
    match semantics::every_value(&mut claim.world, scope, node) {
        Ok(Value::Scalar(e)) => Ok(claim.premises.resolve(&mut claim.world.graph, e)),
        Ok(other) => Err(Missing::Why(format!("a printed value is a number, not {}", other.shape()))),
        Err(error) => Err(Missing::Why(error.message)),
    }
}

fn other<'c>(clause: &'c Clause, printed: &Printed) -> Option<&'c Node> {
    match &clause.rhs {
        Side::Node(rhs) if printed.left => Some(rhs),
        _ => Some(&clause.lhs).filter(|_| !printed.left),
    }
}

/// Whether a side is a declared symbol alone.
fn is_name(entry: &Entry, side: Option<&Node>) -> bool {
    side.is_some_and(|n| {
        entry.scope.get(&semantics::pattern_of(&entry.scope, n)).is_some_and(semantics::Entry::is_free)
    })
}

/// Whether a side holds numerals, and beside them only operations, words, π and units of time: letters that are declared
/// as a time and have a value among the data.
fn is_numeric(entry: &Entry, side: &Node) -> bool {
    fn only_numbers(entry: &Entry, node: &Node) -> bool {
        match &node.kind {
            Kind::Number(_) | Kind::Text(_) | Kind::Function(_) => true,
            Kind::Symbol(s) => s == "\\pi" || s == "\\circ" || is_unit_of_time(entry, s),
            Kind::Empty | Kind::BigOp(_) | Kind::Ellipsis | Kind::Chain { .. } | Kind::At { .. } => false,
            Kind::Styled(..) | Kind::Accent(..) | Kind::Dots(..) | Kind::Matrix { .. } | Kind::List(_) => false,
            _ => node.children().into_iter().all(|child| only_numbers(entry, child)),
        }
    }
    only_numbers(entry, side) && !(numerals(side).is_empty() && !has_power_of_ten(side))
}

fn is_unit_of_time(entry: &Entry, letter: &str) -> bool {
    let given = entry.annotation().is_some_and(|a| a.data.iter().any(|(name, _)| name.value == letter));
    given && letter.len() == 1 && entry.scope.get(letter).is_some_and(|e| e.dimension == Some(Dimension::TIME))
}

/// What a numeric side is, beside a relation.
fn form(side: &Node, rel: Rel) -> Form {
    let found = numerals(side);
    if found.is_empty() {
        return Form::Magnitude;
    }
    if has_function(side) {
        return Form::Arithmetic;
    }
    if let (Kind::Frac(p, q), false) = (&bare(side).kind, matches!(rel, Rel::Eq | Rel::Equiv))
        && let (Some(_), Some(q)) = (whole(p), whole(q))
        && q > 1.0
        && found.len() == 2
        && found.iter().all(|(_, text)| *text != "1")
    {
        return Form::Ratio(q);
    }
    // The 1 above a numeral, and that of 1 : x.
    let counted: Vec<_> = found.iter().filter(|(_, text)| *text != "1" || found.len() == 1).collect();
    match counted.as_slice() {
        [(span, text)] => {
            let longer = if text.contains('.') { format!("{text}5") } else { format!("{text}.5") };
            Form::Rounded(with_numeral(side, span, &longer), significant(text))
        }
        _ => Form::Arithmetic,
    }
}

/// A side without a sign before it and brackets around it.
fn bare(side: &Node) -> &Node {
    match &side.kind {
        Kind::Sum(terms) if terms.len() == 1 => bare(&terms[0].node),
        Kind::Group { body, .. } => bare(body),
        _ => side,
    }
}

fn whole(node: &Node) -> Option<f64> {
    match &node.kind {
        Kind::Number(text) if !text.contains('.') => text.parse().ok(),
        _ => None,
    }
}

/// The significant digits of a numeral; zeros at its end count, as they are printed.
fn significant(text: &str) -> u32 {
    let digits = text.chars().filter(char::is_ascii_digit).skip_while(|c| *c == '0').count();
    u32::try_from(digits).unwrap_or(u32::MAX)
}

/// The numerals of a side with their places; not exponents, nor the 10 below one.
fn numerals(side: &Node) -> Vec<(std::ops::Range<usize>, &str)> {
    match &side.kind {
        Kind::Number(text) => vec![(side.span.clone(), text.as_str())],
        Kind::Scripts { sup: Some(_), .. } if is_power_of_ten(side) => Vec::new(),
        Kind::Scripts { base, .. } => numerals(base),
        Kind::Annotated { body, .. } => numerals(body),
        _ => side.children().into_iter().flat_map(numerals).collect(),
    }
}

fn is_power_of_ten(node: &Node) -> bool {
    match &node.kind {
        Kind::Scripts { base, sup: Some(sup), .. } => {
            let ten = matches!(&base.kind, Kind::Number(n) if n == "10");
            ten && !matches!(&sup.kind, Kind::Symbol(s) if s == "\\circ")
        }
        _ => false,
    }
}

fn has_power_of_ten(node: &Node) -> bool {
    is_power_of_ten(node) || node.children().into_iter().any(has_power_of_ten)
}

fn has_function(node: &Node) -> bool {
    matches!(node.kind, Kind::Function(_)) || node.children().into_iter().any(has_function)
}

/// The side with another text for the numeral at a place.
fn with_numeral(node: &Node, span: &std::ops::Range<usize>, text: &str) -> Node {
    match &node.kind {
        Kind::Number(_) if node.span == *span => Node::new(Kind::Number(text.to_owned()), node.span.clone()),
        _ => node.map_children(&mut |child| with_numeral(child, span, text)),
    }
}

impl Source<'_> {
    /// Adds what an equation's `data` say: each symbol is equal to its value.
    pub(super) fn add_data(&self, world: &mut semantics::World, stated: &mut Stated) -> Result<(), Obstacle> {
        let entry = &self.book.entries[self.index];
        let Some(annotation) = entry.annotation() else { return Ok(()) };
        for (name, value) in &annotation.data {
            let (symbol, number) = (self.symbol(world, name)?, self.symbol(world, value)?);
            let wrong = |message: &str| Obstacle::Premise(name.value.clone(), message.into(), name.span.clone());
            match (&symbol, &number) {
                (Value::Scalar(s), Value::Scalar(x)) if matches!(world.graph.node(*s), Op::Symbol(_)) => {
                    stated.equal.push((*s, *x));
                }
                _ => return Err(wrong("data give a symbol a number")),
            }
        }
        Ok(())
    }
}
