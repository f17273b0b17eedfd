//! What is found out about notes that nobody annotated: roles, premises, suspects.

use schemars::JsonSchema;
use serde::Serialize;

/// What was found out about an equation that no annotation says anything of.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct Inferred {
    /// The labels of the equations that it follows from.
    pub given: Vec<String>,
    /// The inline formulas that it follows from, in LaTeX.
    pub formulas: Vec<String>,
    /// The labels of the equations that it solves.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub solves: Vec<String>,
    /// Whether it, or a link of it, follows from nothing before it, and so is new there.
    pub new: bool,
    /// What it holds under and is said nowhere, in LaTeX: `a > 0`.
    pub needs: Vec<String>,
    /// The premises of single links; of an equation that solves others, those of the whole are told as link 0.
    #[serde(skip)]
    pub links: Vec<InferredLink>,
}

/// What one link was found to follow from.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct InferredLink {
    /// The link's number, from 1.
    pub number: usize,
    /// The labels of equations.
    pub given: Vec<String>,
    /// Formulas in LaTeX.
    pub formulas: Vec<String>,
}

/// An equation that does not follow from those before it, but would after one edit of what is printed.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Suspect {
    /// The edit in words, LaTeX between backticks.
    pub edit: String,
    /// The formula with the edit made.
    pub latex: String,
    /// The label of the equation that is edited: this one, or one that it would follow from.
    pub label: String,
    /// What it follows from then: labels of equations, and inline formulas in LaTeX.
    pub premises: Vec<String>,
    /// What is changed, marked.
    pub diff: Option<Difference>,
}

/// A symbol that the notes do not declare, with the role it was guessed to have.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Assumed {
    /// Its LaTeX.
    pub symbol: String,
    /// The role in words: `an angle`.
    pub role: String,
    /// Where its values are drawn from, where the role says it.
    pub range: Option<[f64; 2]>,
    /// Whether it depends on the time.
    pub moves: bool,
    /// The line in which it first occurs.
    pub line: usize,
}

/// Two formulas with what differs marked.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Difference {
    /// The printed one, with `[-...-]` around what goes.
    pub printed: String,
    /// The suggested one, with `{+...+}` around what comes.
    pub suggested: String,
}
