//! Whether two forms are the same formula: exactly, at random points of the prime field, or in values at random
//! states.
//!
//! Nothing but the forms decides: no premise is used. Two forms are called different only where that is certain: at
//! some state both have values that differ, or one has no value wherever the other has one.

use serde::Serialize;

use crate::check::Random;
use crate::check::computed::Variable;
use crate::expr::field::Field;
use crate::expr::{Expr, Graph, Tape, Workspace};
use crate::number::{Df64, F61, Number, Tracked};

use super::meter::places;
use super::space::Space;

/// log₂ of the chance of a mistake that is aimed at.
const AIM: f64 = -100.0;
/// The most points that are drawn for a trial.
const DRAWS: u32 = 256;
/// The most trials.
const MOST_TRIALS: u32 = 8;
/// The most square roots of which all signs are tried.
const MOST_ROOTS: usize = 6;
/// The states at which values are compared, and those that must tell something.
const STATES: usize = 96;
const LEAST_STATES: usize = 16;
/// The bits to which values must be known to agree.
const LEAST_BITS: f64 = 40.0;

/// Whether two forms are the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Sameness {
    /// They are equal in the prime field; log₂ of a bound on the chance that they are not the same.
    Exact {
        /// log₂ of the bound.
        log2_error: i32,
    },
    /// Their values agree to at least so many bits at so many states.
    Numeric {
        /// The bits.
        bits: u32,
        /// The states.
        states: usize,
    },
    /// They differ.
    Different,
    /// Too little is defined.
    Unknown,
}

impl Sameness {
    /// Whether they are the same.
    pub fn holds(self) -> bool {
        matches!(self, Sameness::Exact { .. } | Sameness::Numeric { .. })
    }
}

/// Whether two forms in one graph are the same, component by component.
pub fn same(graph: &mut Graph, a: &[Expr], b: &[Expr], variables: &[Variable], random: &mut Random) -> Sameness {
    if a.len() != b.len() {
        return Sameness::Different;
    }
    let residuals: Vec<Expr> = a.iter().zip(b).map(|(a, b)| graph.sub(*a, *b)).collect();
    in_field(graph, &residuals, random).unwrap_or_else(|| in_values(graph, a, b, variables, random))
}

/// The verdict of the field, where it has one: where roots are involved, only that the forms are the same, with all
/// signs.
fn in_field(graph: &Graph, residuals: &[Expr], random: &mut Random) -> Option<Sameness> {
    let field = Field::new(graph, residuals);
    if !field.meaningless().is_empty() || field.roots() > MOST_ROOTS {
        return None;
    }
    let (mut worst, mut trials) = (1, 0);
    while trials < MOST_TRIALS {
        match trial(&field, residuals, random)? {
            Some(degree) => worst = worst.max(degree),
            None => return (field.roots() == 0).then_some(Sameness::Different),
        }
        trials += 1;
        let chance = ((worst as f64) * f64::from(DRAWS) / F61::MODULUS as f64).log2().min(0.0);
        let log2_error = f64::from(trials) * chance;
        if log2_error <= AIM {
            return Some(Sameness::Exact { log2_error: log2_error.ceil() as i32 });
        }
    }
    None
}

/// The degree where all residuals vanish at a point, `Some(None)` where one does not; none where no point is defined.
fn trial(field: &Field, residuals: &[Expr], random: &mut Random) -> Option<Option<u64>> {
    'draw: for _ in 0..DRAWS {
        let point = field.draw(&mut || random.next());
        let mut worst = 1;
        for signs in 0..1_u32 << field.roots() {
            let values = field.eval(&point, signs);
            for e in residuals {
                let Some(value) = values.at(*e) else { continue 'draw };
                if !value.vanishes() {
                    return Some(None);
                }
                worst = worst.max(field.total_degree(value.degree));
            }
        }
        return Some(Some(worst));
    }
    None
}

fn in_values(graph: &Graph, a: &[Expr], b: &[Expr], variables: &[Variable], random: &mut Random) -> Sameness {
    let all: Vec<Expr> = a.iter().zip(b).flat_map(|(a, b)| [*a, *b]).collect();
    let tape = Tape::compile(graph, &all);
    let places = places(&tape, variables);
    let space = Space::new(graph, &all, variables);
    let (mut bits, mut states, mut apart) = (f64::INFINITY, 0, 0);
    let mut work = Workspace::new();
    for _ in 0..STATES {
        let state = space.inside(random);
        let inputs: Vec<_> = places.iter().map(|p| Tracked::exact(Df64::from(state[*p]))).collect();
        let values = tape.eval(&inputs, &(), &mut work);
        apart += usize::from(values.chunks(2).any(|pair| pair[0].is_finite() != pair[1].is_finite()));
        let mut agreed = f64::INFINITY;
        for pair in values.chunks(2) {
            if !pair[0].is_finite() && !pair[1].is_finite() {
                agreed = 0.0;
                continue;
            }
            let difference = pair[0].minus(&pair[1]);
            if !difference.is_finite() || !difference.is_zero_within() {
                // One form may be undefined where the other is not.
                if difference.is_finite() {
                    return Sameness::Different;
                }
                agreed = 0.0;
                continue;
            }
            let size = pair[0].value().log2_abs().max(pair[1].value().log2_abs());
            let error = difference.error_log2().max(difference.value().log2_abs());
            agreed = agreed.min(if error == f64::NEG_INFINITY { 104.0 } else { size - error });
        }
        if agreed >= LEAST_BITS {
            bits = bits.min(agreed);
            states += 1;
        }
    }
    // A form may be undefined at some states; where it is nowhere when the other one is defined, it is another
    // formula.
    if states == 0 && apart >= LEAST_STATES {
        return Sameness::Different;
    }
    if states < LEAST_STATES {
        return Sameness::Unknown;
    }
    Sameness::Numeric { bits: bits as u32, states }
}
