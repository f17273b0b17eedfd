//! The states at which a formula loses most, searched for: random states, states near the edges, and from the worst
//! of them on by steps that are kept where they lose more.
//!
//! Promises: the same seed and name give the same states; what is told of a state is certain ([`Meter::lost`]); the
//! number of evaluations is bounded. Not promised: that no state loses more.

use serde::Serialize;

use crate::check::Random;
use crate::check::computed::Variable;
use crate::expr::{Expr, Graph};

use super::meter::{BITS, Loss, Meter};
use super::space::Space;

/// How long a search is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Effort {
    /// The random states that the mean is taken over.
    pub random: usize,
    /// The steps that are tried for either end: bits lost, and bits lost beyond the condition.
    pub steps: usize,
}

/// States that steps are taken from.
const ELITE: usize = 4;

/// A state with what is lost there.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Hard {
    /// The variables' values.
    pub state: Vec<f64>,
    /// What is lost.
    pub loss: Loss,
}

/// What a search found.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Found {
    /// The mean of the bits lost at random states.
    pub mean: f64,
    /// The number of those.
    pub states: usize,
    /// The most bits lost at one of them.
    pub worst_random: f64,
    /// Where most bits are lost.
    pub worst: Hard,
    /// Where most bits are lost beyond the condition.
    pub fault: Hard,
}

/// What is looked for.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Goal {
    Lost,
    Fault,
}

impl Goal {
    fn of(self, loss: Loss) -> f64 {
        match self {
            Goal::Lost => loss.lost,
            Goal::Fault => loss.fault(),
        }
    }
}

/// Searches the states of a formula. `None` where nothing is certain at any random state: it is undefined, or
/// vanishes. `known` are states from which steps are taken, too: another form of a formula is to be good where that
/// one was bad.
pub fn search(
    graph: &Graph,
    outputs: &[Expr],
    positive: &[Expr],
    variables: &[Variable],
    known: &[Vec<f64>],
    effort: Effort,
    random: &mut Random,
) -> Option<Found> {
    let mut meter = Meter::new(graph, outputs, positive, variables);
    let mut space = Space::new(graph, outputs, variables);
    let mut begin: Vec<Hard> = known.iter().filter_map(|state| measured(&mut meter, state.clone())).collect();
    let mut lost = Vec::new();
    for k in 0..4 * effort.random {
        let inside = lost.len() < effort.random && k < 3 * effort.random;
        let state = if inside { space.inside(random) } else { space.near_edges(random) };
        if let Some(hard) = measured(&mut meter, state) {
            lost.extend(inside.then_some(hard.loss.lost));
            begin.push(hard);
        }
    }
    if lost.is_empty() {
        return None;
    }
    let worst = climb(&mut meter, &mut space, &begin, Goal::Lost, effort.steps, random)?;
    begin.push(worst.clone());
    let fault = climb(&mut meter, &mut space, &begin, Goal::Fault, effort.steps, random)?;
    Some(Found {
        mean: lost.iter().sum::<f64>() / lost.len() as f64,
        states: lost.len(),
        worst_random: lost.iter().copied().fold(0.0, f64::max),
        worst: shortened(&mut meter, variables, worst, Goal::Lost),
        fault: shortened(&mut meter, variables, fault, Goal::Fault),
    })
}

/// What is lost at a state, where it is allowed and certain.
fn measured(meter: &mut Meter, state: Vec<f64>) -> Option<Hard> {
    if !meter.is_allowed(&state) {
        return None;
    }
    let loss = meter.loss(&state)?;
    Some(Hard { state, loss })
}

/// Steps from the best of some states, as long as any.
fn climb(
    meter: &mut Meter,
    space: &mut Space,
    begin: &[Hard],
    goal: Goal,
    steps: usize,
    random: &mut Random,
) -> Option<Hard> {
    let mut elite: Vec<Hard> = begin.to_vec();
    let by_goal = |a: &Hard, b: &Hard| goal.of(b.loss).total_cmp(&goal.of(a.loss));
    elite.sort_by(by_goal);
    elite.truncate(ELITE);
    for _ in 0..steps {
        let best = goal.of(elite.first()?.loss);
        if best >= BITS {
            break;
        }
        let from = &elite[random.below(elite.len() as u64) as usize].state;
        let state = space.moved(random, from);
        let least = goal.of(elite.last()?.loss);
        // The guess is cheap, and the bits lost are a bound for those beyond the condition.
        if !meter.is_allowed(&state) || meter.guess(&state).is_none_or(|lost| lost <= least) {
            continue;
        }
        let Some(hard) = measured(meter, state).filter(|h| goal.of(h.loss) > least) else { continue };
        if elite.iter().all(|e| e.state != hard.state) {
            elite.pop();
            elite.push(hard);
            elite.sort_by(by_goal);
        }
    }
    elite.into_iter().next()
}

/// The state with values of fewer digits, as far as it loses nearly as much there.
fn shortened(meter: &mut Meter, variables: &[Variable], mut hard: Hard, goal: Goal) -> Hard {
    for i in 0..hard.state.len() {
        for digits in [1, 2, 3, 4, 6, 8, 10, 12, 14] {
            let mut state = hard.state.clone();
            state[i] = rounded(state[i], digits);
            let [low, high] = variables[i].range;
            if state[i] < low || state[i] > high {
                continue;
            }
            let found = measured(meter, state);
            if let Some(found) = found.filter(|h| goal.of(h.loss) >= goal.of(hard.loss) - 0.5) {
                hard = found;
                break;
            }
        }
    }
    hard
}

/// A number to this many significant digits.
fn rounded(x: f64, digits: usize) -> f64 {
    format!("{x:.*e}", digits - 1).parse().unwrap_or(x)
}
