//! Approximations: the residual, relative to the larger side, must fall with the small parameter at the order
//! that is claimed. Limits: the residual itself must fall. The order is measured over halvings of the parameter, in numbers precise enough that rounding
//! plays no part.

use std::collections::BTreeMap;

use crate::expr::{SymId, Workspace};
use crate::number::{Df64, Number, Real};

use super::claim::Claim;
use super::options::Options;
use super::random::{Decimal, Random};
use super::sampling::{PairValue, Sampler, no_state_text};
use super::system::State;
use super::verdict::{LinkJudgement, Order, Strength, Verdict};

/// The number of times the parameter is halved.
const HALVINGS: usize = 12;
/// The number of states at which the order is measured.
const STATES: usize = 8;
/// How far the measured order may fall short of the claimed one: after so many halvings the next order's share in the
/// slope is of the size of the parameter itself.
const SHORTFALL: f64 = 0.1;

/// The residuals of one state over the halvings: the parameter and the residual relative to its terms.
type Course = Vec<(f64, f64)>;

/// What a residual is compared with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// The larger side: for approximations.
    Relative,
    /// The terms that it is made of: where one side is printed as 0 or constant.
    Terms,
    /// Nothing: for limits, which may be zero.
    Absolute,
}

/// Judges an approximation or a limit. Without a claimed order, any positive one will do.
pub fn judge(
    mut judgement: LinkJudgement,
    mut claim: Claim,
    measure: Measure,
    claimed: Option<f64>,
    name: &str,
    options: &Options,
) -> LinkJudgement {
    let Some((small, reciprocal)) = claim.small else { return judgement };
    let mut random = Random::new(options.seed, name);
    let sampler = match Sampler::new(&mut claim, &mut random, &[]) {
        Ok(sampler) => sampler,
        Err(e) => return LinkJudgement { reason: Some(no_state_text(&e)), ..judgement },
    };
    let deadline = sampler.deadline();
    let mut courses = Vec::new();
    let mut example = None;
    for _ in 0..4 * STATES {
        if courses.len() == STATES || deadline.has_passed() {
            break;
        }
        if let Some((course, last)) = course(&sampler, (small, reciprocal), measure, &mut random) {
            courses.push(course);
            example.get_or_insert(last);
        }
    }
    if deadline.has_passed() {
        judgement.reason = Some(deadline.used_up("following the small parameter"));
        return judgement;
    }
    if courses.is_empty() {
        judgement.reason = Some("the premises could not be solved along the small parameter".into());
        return judgement;
    }
    judgement.states = courses.len();
    if courses.iter().flatten().all(|(_, r)| *r == 0.0) {
        judgement.verdict = Verdict::Holds;
        judgement.strength = Some(Strength::Numeric);
        judgement.reason = Some("exact: nothing is left over".into());
        return judgement;
    }
    let slopes: Vec<f64> = courses.iter().map(|c| slope(c)).collect();
    let least = (0..slopes.len()).min_by(|a, b| slopes[*a].total_cmp(&slopes[*b])).unwrap_or(0);
    let wanted = claimed.unwrap_or(1.0);
    judgement.failing_states = slopes.iter().filter(|s| **s < wanted - SHORTFALL).count();
    judgement.residual = courses[least].last().map(|(_, r)| *r);
    judgement.strength = Some(Strength::Asymptotic);
    judgement.verdict = if judgement.failing_states == 0 { Verdict::Asymptotic } else { Verdict::Fails };
    let tex = sampler.claim.world.tex(small);
    judgement.order = Some(Order {
        small: if reciprocal { format!("1/{tex}") } else { tex },
        claimed: wanted,
        measured: slopes[least],
        residuals: courses[least].clone(),
    });
    if judgement.verdict == Verdict::Fails
        && let Some(state) = example
    {
        judgement.reason = Some(format!("the residual falls with order {:.2}, not {wanted}", slopes[least]));
        let mut work = Workspace::default();
        if let Some(branches) = sampler.evaluate::<Df64>(&state, &(), &mut work) {
            let pair = (0..branches[0].len()).max_by(|a, b| {
                let size = |k: &usize| branches[0][*k].residual.value().log2_abs();
                size(a).total_cmp(&size(b))
            });
            let k = pair.unwrap_or(0);
            let pair = &sampler.claim.branches[0][k];
            judgement.counterexample = Some(sampler.counterexample(&state, &(), pair, &branches[0][k], &[]));
        }
    }
    judgement
}

/// Follows one state while the parameter is halved again and again.
fn course(
    sampler: &Sampler,
    (small, reciprocal): (SymId, bool),
    measure: Measure,
    random: &mut Random,
) -> Option<(Course, State)> {
    let facts = sampler.claim.world.facts(small);
    let largest = facts.range.map_or(if reciprocal { 8.0 } else { 0.25 }, |r| r[1].abs().max(r[0].abs()));
    let first = if reciprocal { 1.0 / largest } else { largest };
    let mut fixed = BTreeMap::new();
    let first_value = if reciprocal { largest } else { first };
    fixed.insert(small, Decimal::near(first_value, 6));
    let (begin, start) = sampler.system.draw(random, false, &fixed);
    let place = sampler.system.free.iter().position(|s| s.symbol == small)?;
    let mut course = Vec::new();
    let mut last_start = start;
    let mut work = Workspace::default();
    let mut state = begin;
    for k in 0..=HALVINGS {
        let factor = 1_i64 << k;
        let base = Decimal::near(first_value, 6);
        let value = if reciprocal {
            Decimal { num: base.num * factor, den: base.den }
        } else {
            Decimal { num: base.num, den: base.den * factor }
        };
        state.free[place] = value;
        state.values[small.index()] = value.to_f64();
        let from = sampler.hinted(&state, last_start.clone());
        sampler.system.solve(&mut state, &from).ok().filter(|()| sampler.is_allowed(&state))?;
        last_start = sampler.system.unknowns.iter().map(|u| state.values[u.symbol.index()]).collect();
        let parameter = if reciprocal { 1.0 / value.to_f64() } else { value.to_f64() };
        course.push((parameter, residual::<Df64>(sampler, &state, measure, &mut work)?));
    }
    Some((course, state))
}

/// The largest residual of the pairs, zero where it is below its own rounding; relative to the largest sum of terms, if
/// it is so measured.
fn residual<N: Real<Context = ()>>(
    sampler: &Sampler,
    state: &State,
    measure: Measure,
    work: &mut Workspace<crate::number::Tracked<N>>,
) -> Option<f64> {
    let branches = sampler.evaluate::<N>(state, &(), work)?;
    let pairs = &branches[0];
    if pairs.iter().any(|p| !p.is_finite()) {
        return None;
    }
    let scale = match measure {
        Measure::Relative => pairs.iter().map(scale).fold(f64::NEG_INFINITY, f64::max),
        Measure::Terms => pairs.iter().map(|p| p.scale_log2).fold(f64::NEG_INFINITY, f64::max),
        Measure::Absolute => 0.0,
    };
    let size = pairs
        .iter()
        .filter(|p| !p.residual.is_zero_within())
        .map(|p| p.residual.value().log2_abs())
        .fold(f64::NEG_INFINITY, f64::max);
    Some(if size == f64::NEG_INFINITY { 0.0 } else { (size - scale).exp2() })
}

/// log₂ of the larger side. What the premises make of a small side, as
/// of T = (γ - 1) m c², may be terms much larger than it, beside which a wrong term of the next order would be nothing.
fn scale<N: Real>(pair: &PairValue<N>) -> f64 {
    pair.lhs.value().log2_abs().max(pair.rhs.value().log2_abs())
}

/// The slope over the last four halvings that are above rounding, by least squares in logarithms.
fn slope(course: &[(f64, f64)]) -> f64 {
    let points: Vec<(f64, f64)> =
        course.iter().filter(|(_, r)| *r > 0.0).map(|(p, r)| (p.abs().log2(), r.log2())).collect();
    let points = &points[points.len().saturating_sub(5)..];
    if points.len() < 3 {
        // All but the first residuals vanish: falls faster than any order.
        return f64::INFINITY;
    }
    let n = points.len() as f64;
    let (mx, my) = (points.iter().map(|p| p.0).sum::<f64>() / n, points.iter().map(|p| p.1).sum::<f64>() / n);
    let covariance: f64 = points.iter().map(|p| (p.0 - mx) * (p.1 - my)).sum();
    let variance: f64 = points.iter().map(|p| (p.0 - mx) * (p.0 - mx)).sum();
    covariance / variance
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use crate::check::verdict::Verdict;
    use crate::check::{Book, Options, judge};
    use crate::document;

    #[test]
    fn the_residual_is_measured_by_the_sides_and_not_by_what_premises_make_of_them() {
        let notes = r"<!-- kenzan
[symbols]
'm, c, v, T' = { range = [0.5, 2.0] }
-->
$$ T \approx \frac{1}{2} m v^2 + \frac{3}{8} \frac{m v^4}{c^2} \tag{1} $$
<!-- kenzan
where = ['T = m c^2 / \sqrt{1 - v^2/c^2} - m c^2']
small = 'v'
order = 4
range = { 'v' = [0.05, 0.25] }
-->
";
        let verdict = |notes: &str| {
            let book = Book::new(&document::parse(Path::new("notes.md"), notes));
            judge(&book, 0, &Options::default()).verdict
        };
        assert_eq!(verdict(notes), Verdict::Asymptotic);
        assert_eq!(verdict(&notes.replace(r"\frac{m v^4}{c^2}", r"\frac{m v^4}{2 c^2}")), Verdict::Fails);
    }
}
