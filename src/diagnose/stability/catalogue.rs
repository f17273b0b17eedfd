//! The catalogue of hard cases: formulas of the bundled notes at the places where doubles lose their digits, with the
//! stable forms that are known from the literature. Data: `notes/hard-cases.toml`, whose LaTeX is read with the
//! declarations that are in force at the equation that it names.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::check::computed::{Computed, Variable, components, computed, computed_from, expressions};
use crate::check::{Book, Formula, Random};
use crate::diagnose::mutants::{Reach, mutants};
use crate::expr::{Deadline, Expr, Graph, Node, Tape};

use super::meter::{Loss, Meter};
use super::propose::propose;
use super::same::{Sameness, same};
use super::search::{Effort, Found, search};
use super::speed::nanoseconds;
use super::write_latex::readable;

/// The catalogue's data.
const BUNDLED: &str = include_str!("../../../notes/hard-cases.toml");

/// The random states of a case, and the steps of its search.
const EFFORT: Effort = Effort { random: 256, steps: 1500 };
/// The states that a form is searched for, from the hardest on.
const TEACHERS: usize = 12;

/// A hard case.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Case {
    /// What it is.
    pub name: String,
    /// The document.
    pub notes: String,
    /// The label of the equation whose declarations hold, and which it is or follows from.
    pub equation: String,
    /// The formula.
    pub formula: String,
    /// Whether it is a side of that equation, as corrected: this is checked.
    #[serde(default)]
    pub printed: bool,
    /// Ranges, by the LaTeX of the symbol; for others the declared ones.
    #[serde(default)]
    pub range: BTreeMap<String, [f64; 2]>,
    /// What is positive, in LaTeX.
    #[serde(default)]
    pub positive: Vec<String>,
    /// A hard state: the values of the symbols.
    pub state: BTreeMap<String, f64>,
    /// A stable form, where there is one.
    pub stable: Option<String>,
    /// Where the stable form is from.
    pub source: Option<String>,
    /// Why digits are lost.
    pub why: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Cases {
    case: Vec<Case>,
}

/// What is wrong with a case.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error, miette::Diagnostic)]
pub enum CaseError {
    /// The data is no TOML, or has other keys.
    #[error("the catalogue cannot be read: {0}")]
    #[diagnostic(help(
        "each [[case]] has name, notes, equation, formula, state, why, and what else the documentation of `Case` says"
    ))]
    Toml(String),
    /// Its equation does not exist.
    #[error("the case `{0}` names the equation ({1}), which does not exist")]
    #[diagnostic(help("name a label of the notes that it names"))]
    Equation(String, String),
    /// LaTeX that cannot be understood.
    #[error("the case `{0}`: `{1}` cannot be understood: {2}")]
    #[diagnostic(help("only what is declared where the equation stands can be used"))]
    Latex(String, String, String),
    /// A formula that has no value at the state, or nowhere.
    #[error("the case `{0}`: `{1}` has no value at its states")]
    #[diagnostic(help("are the ranges and the state such that it is defined?"))]
    Undefined(String, String),
}

/// A form of a case, measured.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Form {
    /// Its LaTeX.
    pub latex: String,
    /// Over the ranges.
    pub found: Found,
    /// At the case's hard state.
    pub at: Loss,
    /// Nanoseconds for a state, in lanes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub nanoseconds: Option<f64>,
}

/// A form that is claimed to be the same formula, measured.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Other {
    /// Whether it is the same formula.
    pub sameness: Sameness,
    /// The form.
    pub form: Form,
}

/// A case, measured.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Measured {
    /// What it is.
    pub name: String,
    /// The document and the label.
    pub notes: String,
    /// The label.
    pub equation: String,
    /// Whether the formula is a side of that equation.
    pub printed: bool,
    /// Where the stable form is from.
    pub source: Option<String>,
    /// Why digits are lost.
    pub why: String,
    /// The symbols and their values at the hard state.
    pub state: Vec<(String, f64)>,
    /// The formula.
    pub before: Form,
    /// The stable form of the catalogue.
    pub after: Option<Other>,
    /// The form that rewriting found, where it is the same formula and better.
    pub rewritten: Option<Other>,
}

/// The bundled cases.
///
/// # Errors
/// [`CaseError::Toml`]
pub fn bundled() -> Result<Vec<Case>, CaseError> {
    read(BUNDLED)
}

/// Cases from TOML.
///
/// # Errors
/// [`CaseError::Toml`]
pub fn read(text: &str) -> Result<Vec<Case>, CaseError> {
    toml::from_str::<Cases>(text).map(|c| c.case).map_err(|e| CaseError::Toml(e.to_string()))
}

/// How the forms of a case are measured.
struct Setting {
    /// States that are known to be hard; the first is the case's own.
    known: Vec<Vec<f64>>,
    seed: u64,
    times: bool,
}

/// A case ready to be measured: both forms in one graph.
pub struct Ready<'c> {
    case: &'c Case,
    place: (&'c Book, usize),
    /// The graph, the formula and what restricts its states.
    pub computed: Computed,
    /// The stable form.
    pub stable: Option<Vec<Expr>>,
    /// The symbols of both forms.
    pub variables: Vec<Variable>,
    /// Whether the formula is a side of its equation.
    pub printed: bool,
}

impl<'c> Ready<'c> {
    /// Reads a case's LaTeX.
    ///
    /// # Errors
    /// [`CaseError`]
    pub fn new(case: &'c Case, book: &'c Book, seed: u64) -> Result<Self, CaseError> {
        let index = book.find(&case.equation).map(|(index, _)| index);
        let index = index.ok_or_else(|| CaseError::Equation(case.name.clone(), case.equation.clone()))?;
        let unclear =
            |latex: &str, e: crate::semantics::Error| CaseError::Latex(case.name.clone(), latex.to_owned(), e.message);
        let mut of_case =
            computed_from(book, index, &case.formula, Deadline::NEVER).map_err(|e| unclear(&case.formula, e))?;
        let world = &mut of_case.world;
        let mut parsed = |latex: &str| expressions(world, book, index, latex).map_err(|e| unclear(latex, e));
        let stable = case.stable.as_deref().map(&mut parsed).transpose()?;
        let positive = case.positive.iter().map(|p| parsed(p)).collect::<Result<Vec<_>, _>>()?;
        let mut ranges = Vec::new();
        for (name, range) in &case.range {
            ranges.push((parsed(name)?, *range));
        }
        of_case.positive = positive.into_iter().flatten().collect();
        for (symbols, range) in ranges {
            for e in symbols {
                if let Node::Symbol(s) = *of_case.world.graph.node(e) {
                    of_case.world.set_range(s, range);
                }
            }
        }
        let all: Vec<Expr> = of_case.outputs.iter().chain(stable.iter().flatten()).copied().collect();
        let variables = of_case.variables(&all);
        let printed = is_side(book, index, &of_case, &variables, seed);
        Ok(Ready { case, place: (book, index), computed: of_case, stable, variables, printed })
    }

    /// Measures it.
    ///
    /// # Errors
    /// [`CaseError::Undefined`]
    pub fn measured(mut self, seed: u64, times: bool) -> Result<Measured, CaseError> {
        let case = self.case;
        let mut random = Random::new(seed, &case.name);
        let state = self.hard_state();
        let mut setting = Setting { known: vec![state.clone()], seed, times };
        let outputs = self.computed.outputs.clone();
        let before = self.form(&case.formula, &outputs, &setting)?;
        setting.known.extend([before.found.worst.state.clone(), before.found.fault.state.clone()]);
        let after = match (self.stable.clone(), &case.stable) {
            (Some(outputs), Some(latex)) => Some(self.other(latex, &outputs, &setting, &mut random)?),
            _ => None,
        };
        let rewritten = self.rewritten(&before, &setting, &mut random);
        Ok(Measured {
            name: case.name.clone(),
            notes: case.notes.clone(),
            equation: case.equation.clone(),
            printed: self.printed,
            source: case.source.clone(),
            why: case.why.clone(),
            state: self.variables.iter().map(|v| v.tex.clone()).zip(state).collect(),
            before,
            after,
            rewritten,
        })
    }

    /// The mutants of the stable form that make sense, and the LaTeX of those that are not told from the formula.
    pub fn mutants(&mut self, seed: u64) -> (usize, Vec<String>) {
        let Some(tree) = self.case.stable.as_deref().and_then(|s| Formula::new(s).tree.ok()) else {
            return (0, Vec::new());
        };
        let (book, index) = self.place;
        let (mut total, mut survivors) = (0, Vec::new());
        for mutant in mutants(&tree, &book.entries[index].scope, Reach::MUTANTS) {
            let Ok(outputs) = components(&mut self.computed.world, book, index, &mutant.tree) else { continue };
            let all: Vec<Expr> = self.computed.outputs.iter().chain(&outputs).copied().collect();
            let variables = self.computed.variables(&all);
            let latex = crate::latex::to_latex(&mutant.tree);
            let random = &mut Random::new(seed, &latex);
            let graph = &mut self.computed.world.graph;
            total += 1;
            if same(graph, &self.computed.outputs, &outputs, &variables, random) != Sameness::Different {
                survivors.push(latex);
            }
        }
        (total, survivors)
    }

    /// The values of the case's hard state; of symbols that it leaves out, the middle of their ranges.
    fn hard_state(&self) -> Vec<f64> {
        let named =
            |v: &Variable| self.case.state.iter().find(|(name, _)| plain(name) == plain(&v.tex)).map(|(_, x)| *x);
        self.variables.iter().map(|v| named(v).unwrap_or((v.range[0] + v.range[1]) / 2.0)).collect()
    }

    fn form(&self, latex: &str, outputs: &[Expr], setting: &Setting) -> Result<Form, CaseError> {
        let undefined = || CaseError::Undefined(self.case.name.clone(), latex.to_owned());
        let (graph, positive) = (&self.computed.world.graph, &self.computed.positive);
        // All forms are measured at the same random states.
        let mut random = Random::new(setting.seed, &self.case.name);
        let found = search(graph, outputs, positive, &self.variables, &setting.known, EFFORT, &mut random);
        let mut meter = Meter::new(graph, outputs, positive, &self.variables);
        let hard = setting.known.first().ok_or_else(undefined)?;
        let at = meter.loss(hard).ok_or_else(undefined)?;
        let nanoseconds =
            setting.times.then(|| nanoseconds(meter.tape(), &[self.inputs(meter.tape(), hard)])).flatten();
        Ok(Form { latex: latex.to_owned(), found: found.ok_or_else(undefined)?, at, nanoseconds })
    }

    fn inputs(&self, tape: &Tape, state: &[f64]) -> Vec<f64> {
        super::meter::places(tape, &self.variables).iter().map(|p| state[*p]).collect()
    }

    fn other(
        &mut self,
        latex: &str,
        outputs: &[Expr],
        setting: &Setting,
        random: &mut Random,
    ) -> Result<Other, CaseError> {
        let graph = &mut self.computed.world.graph;
        let sameness = same(graph, &self.computed.outputs, outputs, &self.variables, random);
        Ok(Other { sameness, form: self.form(latex, outputs, setting)? })
    }

    /// The form that rewriting finds for the hardest states, where it is the same formula and loses less.
    fn rewritten(&mut self, before: &Form, setting: &Setting, random: &mut Random) -> Option<Other> {
        let [output] = self.computed.outputs[..] else { return None };
        let space = super::space::Space::new(&self.computed.world.graph, &[output], &self.variables);
        let mut states = setting.known.clone();
        let mut meter = Meter::new(&self.computed.world.graph, &[output], &self.computed.positive, &self.variables);
        for _ in 0..20 * TEACHERS {
            let state = space.inside(random);
            if states.len() < TEACHERS && meter.is_allowed(&state) && meter.lost(&state).is_some() {
                states.push(state);
            }
        }
        let new = propose(&mut self.computed.world.graph, output, &self.variables, &states)?;
        let latex = readable(&mut self.computed.world, new, self.place, &self.variables, random)?;
        let other = self.other(&latex, &[new], setting, random).ok()?;
        let (old, new) = (&before.found, &other.form.found);
        let gained =
            [before.at.lost - other.form.at.lost, old.mean - new.mean, old.fault.loss.fault() - new.fault.loss.fault()];
        let better = gained.iter().any(|g| *g > 1.0) && gained.iter().all(|g| *g > -1.0);
        (other.sameness.holds() && better).then_some(other)
    }
}

/// Whether a formula is a side of an equation, as corrected, in any branch of ±.
fn is_side(book: &Book, index: usize, formula: &Computed, variables: &[Variable], seed: u64) -> bool {
    let own = formula.outputs.iter().map(|e| formula.world.graph.display(*e)).collect::<Vec<_>>();
    computed(book, index, Deadline::NEVER).iter_mut().any(|side| {
        let text = side.outputs.iter().map(|e| side.world.graph.display(*e)).collect::<Vec<_>>();
        text == own || is_same(side, formula, book, index, variables, seed)
    })
}

/// Whether a side has the formula's values: its LaTeX is read into the side's graph.
fn is_same(
    side: &mut Computed,
    formula: &Computed,
    book: &Book,
    index: usize,
    variables: &[Variable],
    seed: u64,
) -> bool {
    let Ok(outputs) = expressions(&mut side.world, book, index, &formula.latex) else { return false };
    let all: Vec<Expr> = outputs.iter().chain(&side.outputs).copied().collect();
    let range = |v: &mut Variable| {
        if let Some(own) = variables.iter().find(|own| own.tex == v.tex) {
            v.range = own.range;
        }
    };
    let mut variables = side.variables(&all);
    variables.iter_mut().for_each(range);
    let sides = side.outputs.clone();
    let graph: &mut Graph = &mut side.world.graph;
    same(graph, &sides, &outputs, &variables, &mut Random::new(seed, &formula.latex)).holds()
}

/// A name without the braces and blanks that LaTeX may have or not.
fn plain(name: &str) -> String {
    name.chars().filter(|c| !matches!(c, '{' | '}' | ' ')).collect()
}
