//! Printed values: `x = 0.0032`, `\cong 9''2`, `\sim 10^{-7}`, `= -\frac{1}{434}`, `\sim 3 : 2`.
//!
//! An equation of `kind = "value"` is evaluated with the values that its `data` give to symbols and with its premises. The
//! digits are read off the printed LaTeX. The rules, by what the printed side is:
//! - one numeral, perhaps with a power of ten, a unit, or below a 1: it is rounded, and the other side must lie between the
//!   values of the printed side with half a unit of the last printed digit (with `digits = n`, of the n-th significant digit)
//!   less and more, the ends included;
//! - a power of ten alone, also `\sim 10`: an order of magnitude, right to within a factor of √10 either way;
//! - a ratio p : q of whole numbers (q > 1) beside a relation other than `=`: the other side x must have p/q as a convergent of its
//!   continued fraction, |x - p/q| < 1/(2q²) (Legendre);
//! - anything else is arithmetic with the numbers that were put in, and must be equal to the other side.
//!
//! A value that is printed for a symbol of which neither data nor premises say anything is a datum of the notes: taken as
//! given, and known to the links behind it.

use std::collections::BTreeMap;

use crate::expr::{Expr, Node as Op, Tape, Workspace};
use crate::latex::ast::{Delim, Kind, Node, Rel, Sign, Term};
use crate::number::{Df64, Number};
use crate::semantics::units::Dimension;
use crate::semantics::{self, Clause, Scope, Side, Value};

use super::book::{Book, Entry};
use super::claim::{Claim, Obstacle, Source};
use super::options::Options;
use super::random::Random;
use super::sampling::{Sampler, no_state_text};
use super::stated::Stated;
use super::system::State;
use super::verdict::{LinkJudgement, Strength, Verdict};

/// How far beyond half a unit the arithmetic may lie, relative to it: printed halves are not binary fractions.
const SLACK: f64 = 1e-12;

/// The states at which a value must be the same, where symbols are left free.
const STATES: usize = 3;

/// The letters that are units of time where they are declared as times.
const UNITS_OF_TIME: [&str; 4] = ["y", "d", "h", "s"];

/// What a printed side is.
#[derive(Clone, Debug, PartialEq)]
enum Form {
    /// A numeral: the side with half a unit of its last digit less, and more.
    Rounded([Node; 2]),
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
    let digits = entry.annotation().and_then(|a| a.digits);
    let form = |side: &Node| is_numeric(entry, side).then(|| form(side, clause.rel, digits));
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
    let mut ends = Vec::new();
    if let Form::Rounded(shifted) = &printed.form {
        for side in shifted {
            ends.push(scalar(&mut claim, &entry.scope, side)?);
        }
    }
    let mut random = Random::new(options.seed, &clause.latex());
    let tape = Tape::compile(&claim.world.graph, &ends);
    let sampler = Sampler::new(&mut claim, &mut random, &ends).map_err(|e| Missing::Why(no_state_text(&e)))?;
    let states = sampler.states(STATES, &mut random, &BTreeMap::new()).map_err(|e| Missing::Why(no_state_text(&e)))?;
    let (Some(state), [branch]) = (states.first(), sampler.claim.branches.as_slice()) else {
        return Err(Missing::Why("a printed value is one number".into()));
    };
    if let Some(free) = sampler.system.free.iter().find(|s| sampler.tape.inputs().contains(&s.symbol))
        && !is_one_number(&sampler, &states)
    {
        return Err(Missing::Data(sampler.claim.world.tex(free.symbol)));
    }
    let values = sampler.evaluate::<Df64>(state, &(), &mut Workspace::default());
    let (Some(values), [pair]) = (values, branch.as_slice()) else {
        return Err(Missing::Why("a printed value is one number".into()));
    };
    let value = &values[0][0];
    let (lhs, rhs) = (value.lhs.value().to_f64(), value.rhs.value().to_f64());
    let (shown, other) = if printed.left { (lhs, rhs) } else { (rhs, lhs) };
    let ends = match ends.is_empty() {
        true => [shown; 2],
        false => {
            let Some(refined) = sampler.system.refine::<Df64>(state, &()) else {
                return Err(Missing::Why("the premises could not be solved precisely".into()));
            };
            let inputs: Vec<_> = tape.inputs().iter().map(|s| refined[s.index()].clone()).collect();
            let mut work = Workspace::default();
            let ends = tape.eval(&inputs, &(), &mut work);
            [ends[0].value().to_f64(), ends[1].value().to_f64()]
        }
    };
    let (agrees, rule) = agreement(&printed.form, shown, other, ends);
    let example = (!agrees).then(|| sampler.counterexample(state, &(), pair, value, &[]));
    Ok(LinkJudgement {
        verdict: if agrees { Verdict::Holds } else { Verdict::Fails },
        strength: Some(Strength::Numeric),
        residual: Some((other - shown).abs() / shown.abs()),
        states: 1,
        failing_states: usize::from(!agrees),
        counterexample: example,
        reason: Some(format!("printed {}, evaluated {}: {rule}", decimal(shown), decimal(other))),
        inexact: Some("a printed value is rounded".into()),
        ..judgement.clone()
    })
}

/// Whether the sides are in the same ratio at all states, and so do not depend on what is still free: C - A in units of C, a
/// rate in units of the day.
fn is_one_number(sampler: &Sampler, states: &[State]) -> bool {
    let mut work = Workspace::default();
    let mut ratios = states.iter().map(|state| {
        let values = sampler.evaluate::<Df64>(state, &(), &mut work)?;
        let value = values.first()?.first()?;
        Some(value.lhs.value().to_f64() / value.rhs.value().to_f64())
    });
    let Some(Some(first)) = ratios.next() else { return false };
    states.len() > 1 && ratios.all(|ratio| ratio.is_some_and(|ratio| (ratio - first).abs() <= SLACK * first.abs()))
}

/// Whether the other side agrees with what is shown, and the rule in words. `ends` are the ends of what rounds to it.
fn agreement(form: &Form, shown: f64, other: f64, ends: [f64; 2]) -> (bool, String) {
    match form {
        Form::Rounded(_) | Form::Arithmetic => {
            let [low, high] = [ends[0].min(ends[1]), ends[0].max(ends[1])];
            let slack = SLACK * shown.abs();
            let rule = format!("half a unit of the last digit allows {} to {}", decimal(low), decimal(high));
            ((low - slack..=high + slack).contains(&other), rule)
        }
        Form::Ratio(q) => {
            let allowed = 0.5 / (q * q);
            ((other - shown).abs() < allowed, format!("a best fraction is near to within {}", decimal(allowed)))
        }
        Form::Magnitude => {
            let near = other * shown > 0.0 && (other / shown).log10().abs() <= 0.5;
            (near, "an order of magnitude is right to within a factor of √10".into())
        }
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

/// Whether a side holds numerals, and beside them only operations, words, π and units of time.
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
    (has_power_of_ten(side) || !numerals(side).is_empty()) && only_numbers(entry, side)
}

fn is_unit_of_time(entry: &Entry, letter: &str) -> bool {
    UNITS_OF_TIME.contains(&letter) && entry.scope.get(letter).is_some_and(|e| e.dimension == Some(Dimension::TIME))
}

/// What a numeric side is, beside a relation.
fn form(side: &Node, rel: Rel, digits: Option<u32>) -> Form {
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
        [(_, text)] if rel == Rel::Sim && text.len() > 1 && text.trim_end_matches('0') == "1" => Form::Magnitude,
        [(span, text)] => {
            let half = half_unit(text, digits);
            Form::Rounded([Sign::Minus, Sign::Plus].map(|sign| shifted(side, span, sign, &half)))
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

/// Half a unit of a numeral's last digit, or of the significant digit of that number. Zeros at its end count, as they are
/// printed.
fn half_unit(text: &str, digits: Option<u32>) -> String {
    let decimals = text.split_once('.').map_or(0, |(_, fraction)| fraction.len());
    let significant = text.chars().filter(char::is_ascii_digit).skip_while(|c| *c == '0').count();
    let kept = digits.and_then(|d| usize::try_from(d).ok()).map_or(significant, |d| d.clamp(1, significant.max(1)));
    // The place of the last digit that counts: so many behind the point, or before it.
    match decimals.checked_sub(significant.saturating_sub(kept)) {
        Some(place) => format!("0.{}5", "0".repeat(place)),
        None => format!("5{}", "0".repeat(significant - kept - decimals - 1)),
    }
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
            ten && !is_degree(sup)
        }
        _ => false,
    }
}

fn is_degree(sup: &Node) -> bool {
    matches!(&sup.kind, Kind::Symbol(s) if s == "\\circ")
}

fn has_power_of_ten(node: &Node) -> bool {
    is_power_of_ten(node) || node.children().into_iter().any(has_power_of_ten)
}

fn has_function(node: &Node) -> bool {
    matches!(node.kind, Kind::Function(_)) || node.children().into_iter().any(has_function)
}

/// The side in which something is added to the numeral at a place.
fn shifted(node: &Node, span: &std::ops::Range<usize>, sign: Sign, by: &str) -> Node {
    match &node.kind {
        Kind::Number(_) if node.span == *span => {
            let by = Node::new(Kind::Number(by.to_owned()), span.clone());
            let term = |sign, node| Term { sign, sign_span: None, node };
            let sum = Node::new(Kind::Sum(vec![term(Sign::Plus, node.clone()), term(sign, by)]), span.clone());
            let kind = Kind::Group { open: Delim::Paren, close: Delim::Paren, body: Box::new(sum) };
            Node::new(kind, span.clone())
        }
        // The unit of an angle is that of what is added, too.
        Kind::Scripts { base, primes, sub: None, sup }
            if base.span == *span && (*primes > 0 || matches!(sup.as_deref(), Some(n) if is_degree(n))) =>
        {
            let angle = |text: &str| {
                let base = Box::new(Node::new(Kind::Number(text.to_owned()), span.clone()));
                let kind = Kind::Scripts { base, primes: *primes, sub: None, sup: sup.clone() };
                Node::new(kind, node.span.clone())
            };
            let term = |sign, node| Term { sign, sign_span: None, node };
            let sum = Kind::Sum(vec![term(Sign::Plus, node.clone()), term(sign, angle(by))]);
            let body = Box::new(Node::new(sum, node.span.clone()));
            Node::new(Kind::Group { open: Delim::Paren, close: Delim::Paren, body }, node.span.clone())
        }
        _ => node.map_children(&mut |child| shifted(child, span, sign, by)),
    }
}

impl Source<'_> {
    /// Adds what an equation's `data` say: each symbol is equal to its value.
    pub(super) fn add_data(&self, world: &mut semantics::World, stated: &mut Stated) -> Result<(), Obstacle> {
        let entry = &self.book.entries[self.index];
        let Some(annotation) = entry.annotation() else { return Ok(()) };
        for (name, value) in &annotation.data {
            let symbol = self.symbol(world, name)?;
            // A number of TOML has its exponent behind an e.
            let number = match world.graph.decimal(&value.value) {
                Some(number) => Value::Scalar(number),
                None => self.symbol(world, value)?,
            };
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
