//! Laws: equations that notes take as given, as Newton's. Nothing says whether a law is right, but it can be seen whether it
//! can be true at all.

use std::collections::BTreeMap;

use crate::semantics::Clause;

use super::claim::{Obstacle, Source};
use super::judge::Options;
use super::random::Random;
use super::sampling::Sampler;

/// The states that must satisfy a law.
const STATES: usize = 4;

/// The number of states that were found to satisfy a law together with its premises and what is `known` before it.
pub fn satisfying_states(
    source: &Source,
    clause: &Clause,
    known: &[Clause],
    options: &Options,
) -> Result<usize, Obstacle> {
    let scope = &source.book.entries[source.index].scope;
    let known: Vec<Clause> = known.iter().chain([clause]).cloned().collect();
    let mut claim = source.claim(clause, scope, &known)?;
    let mut random = Random::new(options.seed, &clause.latex());
    let sampler = Sampler::new(&mut claim, &mut random, &[]);
    let states = sampler.and_then(|sampler| sampler.states(STATES, &mut random, &BTreeMap::new()));
    Ok(states.map_or(0, |states| states.len()))
}
