//! What the checker says of an equation: the data that every report is made from.

use std::fmt;

use schemars::JsonSchema;
use serde::Serialize;

use super::exact::Exact;
use super::finding::Finding;
pub use super::found::{Assumed, Difference, Inferred, InferredLink, Suspect};
use crate::document::Problem;

/// The verdict on a link or an equation, from best to worst.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Verdict {
    /// Nothing to evaluate, and the reason why is given.
    Statement,
    /// Introduces a symbol: there is nothing yet that it could contradict.
    Definition,
    /// Both sides agree at every state.
    Holds,
    /// The residual falls with the small parameter at the order that was claimed.
    Asymptotic,
    /// Cannot be decided: a declaration, a premise or precision is missing.
    Undecided,
    /// The LaTeX could not be read.
    Unreadable,
    /// The sides differ, at the states shown.
    Fails,
}

/// How sure a verdict is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Strength {
    /// All trials in the prime field vanish.
    Exact,
    /// Decided by values with bounds on their rounding errors.
    Numeric,
    /// An interval excludes zero.
    Certified,
    /// The residual falls with a measured order.
    Asymptotic,
    /// The shapes of the sides do not meet (a vector and a scalar are added): there is no state to evaluate at.
    Shape,
}

impl Strength {
    /// The place in the order from the strongest to the weakest.
    pub fn weakness(self) -> usize {
        match self {
            Strength::Exact => 0,
            Strength::Shape => 1,
            Strength::Certified => 2,
            Strength::Numeric => 3,
            Strength::Asymptotic => 4,
        }
    }
}

/// A symbol's value in a counterexample.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Assignment {
    /// The symbol's LaTeX.
    pub symbol: String,
    /// Its value, in decimal.
    pub value: String,
}

/// A state at which the sides of a link differ.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Counterexample {
    /// The symbols' values at the state.
    pub state: Vec<Assignment>,
    /// The left side's value.
    pub lhs: String,
    /// The right side's value.
    pub rhs: String,
    /// Which component or instance differs (`\xi component`, `i = 2`), where there are several.
    pub component: Option<String>,
    /// The proof that the sides differ there (feature `rug`).
    pub certificate: Option<Certificate>,
    /// Why there is none, where one was tried for.
    pub uncertified: Option<String>,
}

/// A proof that a link fails at a state: what is needed to repeat it.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Certificate {
    /// The precision of the intervals' endpoints, in bits; none where all is computed in fractions.
    pub bits: Option<u32>,
    /// The symbols that may be chosen, with exact values: integers, fractions such as `1/2`, angles such as
    /// `2 arctan(1/2)`.
    pub state: Vec<ExactValue>,
    /// The symbols that the premises determine there.
    pub solved: Vec<Enclosure>,
    /// What left minus right is proved to lie between, zero excluded (for an inequality: values of the wrong sign); one
    /// for each of the two signs of ±.
    pub differences: Vec<Enclosure>,
}

/// A symbol's exact value.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct ExactValue {
    /// The symbol's LaTeX.
    pub symbol: String,
    /// An integer, a fraction in lowest terms, or twice the arc tangent of one.
    pub value: String,
    /// Whether the sides do not depend on it.
    pub idle: bool,
}

/// Decimals between which a number is proved to lie. Where the number is known exactly both are its decimal or fraction.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Enclosure {
    /// The LaTeX of the symbol; the name of the component or instance, or nothing, for a difference.
    pub name: Option<String>,
    /// Not above the number.
    pub low: String,
    /// Not below it.
    pub high: String,
    /// Whether it is a symbol that does not occur in the sides.
    pub idle: bool,
}

impl Certificate {
    /// How it was computed, in a few words.
    pub fn means(&self) -> String {
        self.bits.map_or("in fractions".into(), |bits| format!("with {bits} bits"))
    }
}

/// The certificate in a sentence, without the symbols that play no part.
impl fmt::Display for Certificate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let chosen = self.state.iter().filter(|v| !v.idle).map(|v| format!("{} = {}", v.symbol, v.value));
        let solved = self.solved.iter().filter(|e| !e.idle).map(|e| match &e.name {
            Some(symbol) => format!("{symbol} {}", e.place()),
            None => e.place(),
        });
        let state: Vec<String> = chosen.chain(solved).collect();
        if !state.is_empty() {
            write!(f, "at {} ", state.join(", "))?;
        }
        let places = self.differences.iter().map(|e| match &e.name {
            Some(component) => format!("{} ({component})", e.place()),
            None => e.place(),
        });
        write!(f, "the difference {}, {}", places.collect::<Vec<_>>().join(" or "), self.means())
    }
}

impl Enclosure {
    /// `lies in [0.33, 0.34]`, or `is 2` where that is exact.
    pub fn place(&self) -> String {
        if self.low == self.high {
            format!("is {}", self.low)
        } else {
            format!("lies in [{}, {}]", self.low, self.high)
        }
    }
}

/// The measured order of an approximation.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Order {
    /// The small parameter's LaTeX.
    pub small: String,
    /// The order that was claimed.
    pub claimed: f64,
    /// The measured order: the least slope over the states.
    pub measured: f64,
    /// The residual relative to the sides, for each halving of the small parameter, at the state with the least slope.
    pub residuals: Vec<(f64, f64)>,
}

/// Whether the terms of an equation have one dimension. It is a finding of its own and decides no verdict.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum DimensionStatus {
    /// They have.
    Ok,
    /// Not checked: a unit is not declared and fits whatever it must, or there is nothing to compare.
    Unchecked,
    /// They have not.
    Mismatch,
}

/// Terms that should have one dimension and have not.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct DimensionFinding {
    /// What is found, in a sentence, LaTeX between dollars.
    pub message: String,
    /// The relation in which it is found.
    pub link: String,
    /// The terms with their dimensions, in the order of printing.
    pub terms: Vec<TermDimension>,
    /// The dimension of those that stand out, where there are two.
    pub found: Option<String>,
    /// The dimension of the others.
    pub expected: Option<String>,
    /// Factors of declared symbols that would mend the terms that stand out, the likeliest first.
    pub factors: Vec<String>,
}

/// A term with its dimension.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct TermDimension {
    /// Its LaTeX, without the sign.
    pub latex: String,
    /// Its dimension: `kg m² s⁻¹`.
    pub dimension: String,
}

/// A dimension that no unit declares and the equations determine.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct InferredDimension {
    /// The symbol's LaTeX, `#` for an index.
    pub symbol: String,
    /// Its dimension.
    pub dimension: String,
    /// The label of the equation that determined it.
    pub from: String,
}

/// The bits of a double that rounding in the formula costs, over the states.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct LostBits {
    /// Their mean.
    pub mean: f64,
    /// Those at the worst state.
    pub worst: f64,
}

/// The judgement on one link of a chain.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct LinkJudgement {
    /// The link's LaTeX: left side, relation, right side.
    pub latex: String,
    /// The verdict.
    pub verdict: Verdict,
    /// How sure it is.
    pub strength: Option<Strength>,
    /// Why, in a sentence, where the verdict needs one.
    pub reason: Option<String>,
    /// The largest residual relative to the largest term, over all states.
    pub residual: Option<f64>,
    /// The bits to which the sides agree at the worst state.
    pub bits: Option<u32>,
    /// The number of states at which it was evaluated.
    pub states: usize,
    /// The number of states at which the sides differ.
    pub failing_states: usize,
    /// A state at which they differ.
    pub counterexample: Option<Counterexample>,
    /// For an approximation.
    pub order: Option<Order>,
    /// What stands in the way of a verdict, with its place in the file.
    #[serde(skip)]
    pub problem: Option<Problem>,
    /// For an exact verdict.
    pub exact: Option<Exact>,
    /// Why an equality that holds has no exact verdict.
    pub inexact: Option<String>,
    /// What the side that is worse in doubles loses, for an equality.
    pub lost_bits: Option<LostBits>,
    /// Whether it holds because a premise says the same in as many terms.
    pub restated: bool,
}

impl LinkJudgement {
    /// Of a link, given by its LaTeX, of which nothing is said yet.
    pub fn unjudged(latex: String) -> Self {
        LinkJudgement {
            latex,
            verdict: Verdict::Undecided,
            strength: None,
            reason: None,
            residual: None,
            bits: None,
            states: 0,
            failing_states: 0,
            counterexample: None,
            order: None,
            problem: None,
            exact: None,
            inexact: None,
            lost_bits: None,
            restated: false,
        }
    }

    /// Of a link that gives something its name.
    pub fn definition(latex: String) -> Self {
        LinkJudgement { verdict: Verdict::Definition, ..LinkJudgement::unjudged(latex) }
    }
}

/// The formula that should have been printed, with the judgement on it.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Correction {
    /// The corrected formula.
    pub latex: String,
    /// Its verdict.
    pub verdict: Verdict,
    /// Whether its terms have one dimension.
    pub dimension: DimensionStatus,
    /// Its links.
    pub links: Vec<LinkJudgement>,
    /// What stands in the way of a verdict, where no link says it.
    #[serde(skip)]
    pub problem: Option<Problem>,
}

/// How sensitive a check is: what became of the formula's mutants, each with a single edit, under the same check.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct Sensitivity {
    /// The mutants that fail.
    pub killed: usize,
    /// The mutants that were judged; those that cannot be understood or edit only a definition are not among them.
    pub total: usize,
    /// The mutants among them that say the same as the formula, by a rule that does not rest on the check.
    pub equivalent: usize,
    /// The inequalities among them that follow from the formula by themselves: they are true where it is.
    pub weaker: usize,
    /// The mutants that neither fail nor hold: the premises have no solution at which they can be evaluated.
    pub undecided: usize,
    /// The mutants that pass and say something else: the edit in words and what it gives.
    pub survivors: Vec<String>,
}

/// A formula near a failing one that holds under the same check.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Suggestion {
    /// The formula.
    pub latex: String,
    /// What was changed, in words.
    pub edit: String,
    /// The printed formula in the same spelling.
    pub printed: String,
    /// What was changed, marked.
    pub diff: Option<Difference>,
}

/// The judgement on one equation.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Judgement {
    /// Its label.
    pub label: String,
    /// Whether the label is printed in the notes; otherwise it was given by counting from the label before.
    pub numbered: bool,
    /// The heading it stands under.
    pub section: String,
    /// The numbers that LaTeX prints beside it, where the notes call it by a name.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub numbers: Vec<String>,
    /// The file that it stands in, where that is another than the document's (`\input`).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
    /// The line of the file at which it begins.
    pub line: usize,
    /// The LaTeX as printed, without its label, macros expanded.
    pub latex: String,
    /// `identity`, `definition`, `derived`, `constant`, `approximation`, `inequality`, `solution`, `statement` ...
    pub kind: String,
    /// The verdict: the worst link's.
    pub verdict: Verdict,
    /// The weakest link's strength.
    pub strength: Option<Strength>,
    /// The least number of bits over the links.
    pub bits: Option<u32>,
    /// The number of states.
    pub states: usize,
    /// Whether the formula was judged as printed, without a `reading`.
    pub as_printed: bool,
    /// The reading, where the printed LaTeX is damaged or in a private notation.
    pub reading: Option<String>,
    /// The labels of the equations it is judged on.
    pub given: Vec<String>,
    /// The premises that the prose states, in LaTeX.
    pub assumptions: Vec<String>,
    /// One line for the reader.
    pub because: Option<String>,
    /// Why the verdict is what it is, where no link says it: an error's text, what is lacking.
    pub reason: Option<String>,
    /// Its links.
    pub links: Vec<LinkJudgement>,
    /// The first counterexample of its links.
    pub counterexample: Option<Counterexample>,
    /// What it should read.
    pub correction: Option<Correction>,
    /// Whether its terms have one dimension.
    pub dimension: DimensionStatus,
    /// Where they have not.
    pub dimension_findings: Vec<DimensionFinding>,
    /// What the annotation expects, where it does (`fails`).
    pub expect: Option<Verdict>,
    /// Whether the verdict is as expected.
    pub as_expected: bool,
    /// What became of the mutants of the formula, where they were asked for.
    pub sensitivity: Option<Sensitivity>,
    /// What was probably meant, where the equation fails and suggestions were asked for; the likeliest first.
    pub suggestions: Vec<Suggestion>,
    /// What doubles lose: the mean over the links, and the worst.
    pub lost_bits: Option<LostBits>,
    /// What was found out where nothing is annotated.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub inferred: Option<Inferred>,
    /// The edit after which it would follow, where it does not as printed and nothing is annotated.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub suspect: Option<Suspect>,
    /// Which diagnosis was asked for and cut short, and why; what there is of it is not all.
    pub unfinished: Option<String>,
    /// The time it took, in microseconds.
    pub micros: u64,
    /// What stands in the way of a verdict, with its place in the file, where no link says it.
    #[serde(skip)]
    pub problem: Option<Problem>,
}

impl Judgement {
    /// What stands in the way of a verdict on the equation, its links and its correction, each problem once.
    pub fn problems(&self) -> Vec<&Problem> {
        let links = self.links.iter().filter_map(|link| link.problem.as_ref());
        let correction = self.correction.iter();
        let corrected =
            correction.flat_map(|c| c.problem.iter().chain(c.links.iter().filter_map(|l| l.problem.as_ref())));
        let mut problems: Vec<&Problem> = Vec::new();
        for problem in self.problem.iter().chain(links).chain(corrected) {
            if !problems.iter().any(|p| p.span == problem.span && p.message == problem.message) {
                problems.push(problem);
            }
        }
        problems
    }

    /// Whether all that holds of these links is what a premise says in as many terms: that they hold shows nothing.
    pub fn only_restates(links: &[LinkJudgement]) -> bool {
        let holds = |link: &&LinkJudgement| matches!(link.verdict, Verdict::Holds | Verdict::Asymptotic);
        let mut holding = links.iter().filter(holds).peekable();
        holding.peek().is_some() && holding.all(|link| link.restated)
    }

    /// An equation that fails while its correction holds; or one that the print has lost so much of that it cannot be
    /// judged, where the annotation expects that and gives a correction that holds.
    pub fn is_erratum(&self) -> bool {
        let lost =
            matches!(self.verdict, Verdict::Undecided | Verdict::Unreadable) && self.expect == Some(self.verdict);
        (self.verdict == Verdict::Fails || lost) && self.is_mended()
    }

    /// Whether it has a correction that holds.
    pub fn is_mended(&self) -> bool {
        let holds = |c: &Correction| matches!(c.verdict, Verdict::Holds | Verdict::Asymptotic | Verdict::Definition);
        self.correction.as_ref().is_some_and(holds)
    }
}

/// The judgements on one document.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct DocumentReport {
    /// The file's name without extension.
    pub name: String,
    /// The file's path as it was given.
    pub path: String,
    /// The document's title.
    pub title: String,
    /// Problems of the document that belong to no equation (an unclosed display, a directive that does not parse).
    #[schemars(with = "Vec<String>")]
    pub problems: Vec<Finding>,
    /// The dimensions that were inferred.
    pub inferred: Vec<InferredDimension>,
    /// The symbols that the document does not declare, with the roles they were guessed to have.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub assumed: Vec<Assumed>,
    /// The judgements in order.
    pub equations: Vec<Judgement>,
}

impl DocumentReport {
    /// The path of the file that an equation of it stands in.
    pub fn path_of<'a>(&'a self, judgement: &'a Judgement) -> &'a str {
        judgement.file.as_deref().unwrap_or(&self.path)
    }
}
