//! Equalities that hold in doubles, tested once more in the prime field: where all trials vanish they hold exactly, but
//! for a chance that is known. See [`crate::expr::field`] for what this rests on.

use std::collections::HashMap;

use schemars::JsonSchema;
use serde::Serialize;

use crate::expr::field::{Element, Field, Point, Values};
use crate::expr::{Expr, SymId};
use crate::number::F61;

use super::claim::Claim;
use super::elimination::{Elimination, Unsolved};
use super::random::{Decimal, Random};
use super::sampling::no_state_text;
use super::system::NoState;

/// log₂ of the chance of a false "holds" that is aimed at.
const AIM: f64 = -100.0;

/// The most trials that are made to reach it.
const MOST_TRIALS: u32 = 8;

/// The number of points that are drawn for a trial at most: some have no square roots, or a division by zero.
const DRAWS: u32 = 256;

/// The most square roots, of which all choices of signs are tried.
const MOST_ROOTS: usize = 6;

/// An exact verdict.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
pub struct Exact {
    /// The number of random points of the field at which the sides are equal.
    pub trials: u32,
    /// log₂ of a bound on the chance that they are and yet the statement is false.
    pub log2_error: i32,
}

/// Why a statement has no exact verdict.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Inexact {
    /// Several components are meant with ±.
    #[error("its components have the two branches of ±")]
    Branches,
    /// What the field knows nothing of.
    #[error("{} has no meaning in a prime field", .0.join(" and "))]
    Meaningless(Vec<&'static str>),
    /// The value depends on the signs of roots.
    #[error("it depends on the signs of square roots, which a prime field does not know")]
    Roots,
    /// Too many roots.
    #[error("it has more square roots than all choices of signs can be tried for")]
    ManyRoots,
    /// The premises are not affine.
    #[error("the premises are not affine in {}", .0.join(", "))]
    NotAffine(Vec<String>),
    /// A solved symbol stands within a sine.
    #[error("the premises are solved for {}, of which a function is taken", .0.join(", "))]
    Bound(Vec<String>),
    /// The premises have no unique solution.
    #[error("the premises have no unique solution where all other symbols are free")]
    Singular,
    /// Nothing is left to be compared.
    #[error("every term vanishes by itself on the premises, which may say more than is meant")]
    Trivial,
    /// No point where everything is defined.
    #[error("no point of the prime field was found at which everything is defined")]
    Undefined,
    /// The graph was cut short.
    #[error("{0}")]
    CutShort(String),
    /// The degree is too large.
    #[error("the degree is too large for a useful bound")]
    Degree,
    /// The field refutes what the values confirm.
    #[error("contradiction: the sides agree in their values, but not in a prime field")]
    Refuted,
}

/// Tests a claim; `unknowns` are what its premises are solved for. An identity needs no premises: it is tried as one
/// first, which says more and is cheaper.
pub fn test(claim: &mut Claim, unknowns: &[SymId], random: &mut Random) -> Result<Exact, Inexact> {
    let targets = targets(claim)?;
    let targets = with_values(claim, &targets, unknowns);
    let outcome = on_premises(claim, &targets, &[], &[], random);
    if outcome.is_ok() || claim.premises.residuals.is_empty() {
        return outcome;
    }
    let premises = claim.premises.residuals.clone();
    let premises = with_values(claim, &premises, unknowns);
    on_premises(claim, &targets, &premises, unknowns, random)
}

/// Expressions in which symbols that are declared to have one value have it. Their derivatives are what they are.
fn with_values(claim: &mut Claim, expressions: &[Expr], unknowns: &[SymId]) -> Vec<Expr> {
    let world = &mut claim.world;
    let mut values = HashMap::new();
    for symbol in world.graph.symbols(expressions).into_iter().filter(|s| !unknowns.contains(s)) {
        if let Some([low, high]) = world.facts(symbol).range
            && low == high
        {
            let value = Decimal::only(low);
            let value = world.graph.ratio(value.num.into(), value.den.into());
            values.insert(symbol, value);
        }
    }
    expressions.iter().map(|e| world.graph.substitute(*e, &values)).collect()
}

/// As many trials as the aim needs.
fn on_premises(
    claim: &mut Claim,
    targets: &[Expr],
    premises: &[Expr],
    unknowns: &[SymId],
    random: &mut Random,
) -> Result<Exact, Inexact> {
    let elimination = Elimination::new(&mut claim.world.graph, premises, unknowns, &mut || random.next());
    let deadline = claim.world.graph.deadline();
    NoState::check(&mut claim.world, "deriving the premises for a prime field").map_err(cut_short)?;
    let trial = Trial::new(claim, &elimination, targets, unknowns)?;
    let mut worst = 1;
    let mut done = 0;
    loop {
        if deadline.has_passed() {
            return Err(Inexact::CutShort(deadline.used_up("evaluating in a prime field")));
        }
        worst = worst.max(trial.run(random)?);
        done += 1;
        let log2_error = f64::from(done) * chance_log2(worst);
        if done >= 2 && log2_error <= AIM {
            return Ok(Exact { trials: done, log2_error: log2_error.ceil() as i32 });
        }
        if done >= MOST_TRIALS {
            return Err(Inexact::Degree);
        }
    }
}

fn cut_short(reason: NoState) -> Inexact {
    Inexact::CutShort(no_state_text(&reason))
}

/// What must vanish. Of the two branches of ± one must hold: the product of the residuals vanishes. That both do occur
/// is known from the values.
fn targets(claim: &mut Claim) -> Result<Vec<Expr>, Inexact> {
    match claim.branches.as_slice() {
        [branch] => Ok(branch.iter().map(|p| p.residual).collect()),
        [upper, lower] => match (upper.as_slice(), lower.as_slice()) {
            ([upper], [lower]) => Ok(vec![claim.world.graph.mul(upper.residual, lower.residual)]),
            _ => Err(Inexact::Branches),
        },
        _ => Err(Inexact::Branches),
    }
}

/// log₂ of a bound on the chance that one of the points drawn for a trial is a zero of a polynomial of this degree.
fn chance_log2(degree: u64) -> f64 {
    ((degree as f64) * f64::from(DRAWS) / F61::MODULUS as f64).log2().min(0.0)
}

/// What is evaluated in each trial.
struct Trial<'c> {
    claim: &'c Claim,
    elimination: &'c Elimination,
    targets: &'c [Expr],
    /// The terms of those that have several.
    terms: Vec<Vec<Expr>>,
    field: Field<'c>,
}

impl<'c> Trial<'c> {
    fn new(
        claim: &'c Claim,
        elimination: &'c Elimination,
        targets: &'c [Expr],
        unknowns: &[SymId],
    ) -> Result<Self, Inexact> {
        let graph = &claim.world.graph;
        let premises = elimination.expressions();
        let meaningless = Field::new(graph, &premises).meaningless();
        if !meaningless.is_empty() {
            return Err(Inexact::Meaningless(meaningless));
        }
        let all: Vec<Expr> = premises.iter().chain(targets).copied().collect();
        let field = Field::new(graph, &all);
        let bound = field.bound_symbols();
        let bound: Vec<String> = unknowns.iter().filter(|s| bound.contains(s)).map(|s| claim.world.tex(*s)).collect();
        if !bound.is_empty() {
            return Err(Inexact::Bound(bound));
        }
        let terms = targets.iter().map(|e| graph.terms(*e).into_iter().map(|(_, term)| term).collect());
        Ok(Trial { claim, elimination, targets, terms: terms.collect(), field })
    }

    /// One trial: draws points until everything is defined with all choices of signs there. The degree of the
    /// residuals, if they all vanish.
    fn run(&self, random: &mut Random) -> Result<u64, Inexact> {
        let deadline = self.claim.world.graph.deadline();
        for _ in 0..DRAWS {
            if deadline.has_passed() {
                return Err(Inexact::CutShort(deadline.used_up("evaluating in a prime field")));
            }
            let point = self.field.draw(&mut || random.next());
            if let Some(degree) = self.all_signs(&point)? {
                return Ok(degree);
            }
        }
        Err(Inexact::Undefined)
    }

    /// The residuals' degree where they vanish with all choices of signs; none where something is not defined.
    fn all_signs(&self, point: &Point) -> Result<Option<u64>, Inexact> {
        let mut worst = 1;
        let mut signs = 0;
        let mut bits = 0;
        while signs < 1 << bits {
            let mut point = point.clone();
            match self.elimination.solve(&self.field, &mut point, signs) {
                Ok(used) if used > MOST_ROOTS => return Err(Inexact::ManyRoots),
                Ok(used) => bits = bits.max(used),
                Err(Unsolved::Unlucky) => return Ok(None),
                Err(Unsolved::Singular) => return Err(Inexact::Singular),
                Err(Unsolved::NotAffine(symbols)) => {
                    return Err(Inexact::NotAffine(symbols.iter().map(|s| self.claim.world.tex(*s)).collect()));
                }
            }
            let values = self.field.eval(&point, signs);
            for e in self.targets {
                let Some(value) = values.at(*e) else { return Ok(None) };
                if !value.vanishes() {
                    return Err(self.nonzero(bits));
                }
                worst = worst.max(self.field.total_degree(value.degree));
            }
            if self.is_trivial(&values) {
                return Err(Inexact::Trivial);
            }
            signs += 1;
        }
        Ok(Some(worst))
    }

    /// Whether premises make every term of every residual vanish by itself: a solution where all particles stand in one
    /// place, or nothing moves, satisfies everything.
    fn is_trivial(&self, values: &Values) -> bool {
        let vanish = |terms: &Vec<Expr>| terms.iter().all(|e| values.at(*e).is_some_and(Element::vanishes));
        let sums = self.terms.iter().any(|terms| terms.len() > 1);
        sums && !self.elimination.is_empty() && self.terms.iter().all(vanish)
    }

    /// What a value other than zero means, where the values of real numbers agree.
    fn nonzero(&self, roots: usize) -> Inexact {
        let meaningless = self.field.meaningless();
        if !meaningless.is_empty() {
            Inexact::Meaningless(meaningless)
        } else if roots > 0 {
            Inexact::Roots
        } else {
            Inexact::Refuted
        }
    }
}

#[cfg(test)]
mod tests;
