//! A link laid open: how it was read, which symbols are drawn and which are solved for, and both sides at a few states.

use std::collections::BTreeMap;

use crate::expr::{Deadline, Workspace};
use crate::number::Df64;
use crate::semantics::Clause;

use super::book::{Book, Version};
use super::claim::{Claim, Obstacle, Source, obstacle_text};
use super::options::Options;
use super::random::Random;
use super::sampling::{Sampler, no_state_text, shown};
use super::verdict::Assignment;

/// The number of states that are shown.
const SHOWN: usize = 3;

/// A link laid open.
#[derive(Clone, Debug, Default)]
pub struct Inspection {
    /// The link's LaTeX.
    pub latex: String,
    /// How the left and the right side were read, every operation in brackets.
    pub reading: Option<(String, String)>,
    /// The symbols that are drawn at random, with their ranges.
    pub drawn: Vec<(String, [f64; 2])>,
    /// The symbols that the premises determine.
    pub solved: Vec<String>,
    /// States with the sides' values.
    pub states: Vec<InspectedState>,
    /// Why there are none.
    pub obstacle: Option<String>,
}

/// A state with the sides' values.
#[derive(Clone, Debug)]
pub struct InspectedState {
    /// The symbols' values.
    pub symbols: Vec<Assignment>,
    /// For each component its name, where there are several, and the two sides.
    pub sides: Vec<(Option<String>, String, String)>,
}

/// Lays the links of an equation open.
pub fn inspect(book: &Book, index: usize, version: Version, options: &Options) -> Vec<Inspection> {
    let Ok(statement) = book.statement(index, version) else { return Vec::new() };
    let source = Source::new(book, index, version).until(Deadline::after(options.budget));
    let scope = &book.entries[index].scope;
    if book.entries[index].list(|a| &a.solves).is_empty() {
        let clauses = statement.clauses.iter().enumerate();
        return clauses.map(|(k, c)| link(c, source.at(k).claim(c, scope, &[]), options)).collect();
    }
    match source.solved() {
        Ok(solved) => {
            solved.iter().map(|(c, scope)| link(c, source.claim(c, scope, &statement.clauses), options)).collect()
        }
        Err(obstacle) => vec![Inspection { obstacle: Some(obstacle_text(&obstacle)), ..Inspection::default() }],
    }
}

fn link(clause: &Clause, claim: Result<Claim, Obstacle>, options: &Options) -> Inspection {
    let mut inspection = Inspection { latex: clause.latex(), ..Inspection::default() };
    let mut claim = match claim {
        Ok(claim) => claim,
        Err(obstacle) => {
            inspection.obstacle = Some(obstacle_text(&obstacle));
            return inspection;
        }
    };
    inspection.reading = Some((claim.lhs_text.clone(), claim.rhs_text.clone()));
    let mut random = Random::new(options.seed, &inspection.latex);
    let sampled = Sampler::new(&mut claim, &mut random, &[]).and_then(|sampler| {
        let states = sampler.states(SHOWN, &mut random, &BTreeMap::new())?;
        Ok((sampler, states))
    });
    let (sampler, states) = match sampled {
        Ok(found) => found,
        Err(reason) => {
            inspection.obstacle = Some(no_state_text(&reason));
            return inspection;
        }
    };
    let tex = |s| sampler.claim.world.tex(s);
    inspection.drawn = sampler.system.free.iter().map(|s| (tex(s.symbol), s.range)).collect();
    inspection.solved = sampler.system.unknowns.iter().map(|u| tex(u.symbol)).collect();
    let mut work = Workspace::default();
    for state in &states {
        let Some(branches) = sampler.evaluate::<Df64>(state, &(), &mut work) else { continue };
        let Some((pair, value)) = sampler.claim.branches[0].first().zip(branches[0].first()) else { continue };
        let symbols = sampler.counterexample(state, &(), pair, value, &[]).state;
        let pairs = sampler.claim.branches.iter().flatten().zip(branches.iter().flatten());
        let sides = pairs.map(|(p, v)| (p.name.clone(), shown(&v.lhs, 16), shown(&v.rhs, 16))).collect();
        inspection.states.push(InspectedState { symbols, sides });
    }
    inspection
}
