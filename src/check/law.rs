//! Laws: equations that notes take as given, as Newton's. Nothing says whether a law is right, but it can be seen whether it
//! can be true at all.

use std::collections::BTreeMap;

use crate::semantics::Clause;

use super::claim::{Obstacle, Source};
use super::options::Options;
use super::random::Random;
use super::sampling::Sampler;
use super::verdict::LinkJudgement;

/// The states that must satisfy a law.
const STATES: usize = 4;

/// A law that does not follow from its premises is taken as given, if any state satisfies it together with them.
pub fn taken(
    link: LinkJudgement,
    source: &Source,
    clause: &Clause,
    known: &[Clause],
    options: &Options,
) -> LinkJudgement {
    match satisfying_states(source, clause, known, options) {
        Ok(0) => LinkJudgement { reason: Some("a law that no state satisfies".into()), ..link },
        Ok(states) => {
            let reason = Some("a law: taken as given, and there are states that satisfy it".into());
            LinkJudgement { states, reason, ..LinkJudgement::definition(clause.latex()) }
        }
        Err(_) => link,
    }
}

/// The number of states that were found to satisfy a law together with its premises and what is `known` before it.
fn satisfying_states(source: &Source, clause: &Clause, known: &[Clause], options: &Options) -> Result<usize, Obstacle> {
    let scope = &source.book.entries[source.index].scope;
    let known: Vec<Clause> = known.iter().chain([clause]).cloned().collect();
    let mut claim = source.claim(clause, scope, &known)?;
    let mut random = Random::new(options.seed, &clause.latex());
    let sampler = Sampler::new(&mut claim, &mut random, &[]);
    let states = sampler.and_then(|sampler| sampler.states(STATES, &mut random, &BTreeMap::new()));
    Ok(states.map_or(0, |states| states.len()))
}
