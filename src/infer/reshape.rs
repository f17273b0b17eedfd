//! Matrices and columns among guessed symbols: where the shapes of a formula do not meet, names that may be arrays are
//! tried as such, the fewest first.

use std::collections::{BTreeMap, BTreeSet};

use crate::semantics::{Clause, ErrorKind, Side};

use super::evidence::{Evidence, names};
use super::roles::{Guess, Role, reading, scope, subscript};

/// The most readings that are tried for a formula.
const MOST_READINGS: usize = 400;
/// The most names that are tried as something else at once.
const MOST_NAMES: usize = 3;

/// Gives other shapes to symbols, until the formulas whose shapes do not meet can be read, and no other suffers.
pub(super) fn reshape(guesses: &mut BTreeMap<String, Guess>, evidence: &Evidence, clauses: &[Clause]) {
    let mut sizes: Vec<usize> = evidence.sizes.iter().copied().filter(|n| (2..=4).contains(n)).collect();
    sizes.extend([3, 2].into_iter().filter(|n| !evidence.sizes.contains(n)));
    for clause in clauses {
        if !misshapen(guesses, clause) {
            continue;
        }
        unbracket(guesses, evidence, clause, clauses);
        if !misshapen(guesses, clause) {
            continue;
        }
        let names: Vec<String> = names_of(clause).into_iter().filter(|n| guesses.contains_key(n)).collect();
        let others: Vec<&Clause> = clauses.iter().filter(|c| !names_of(c).is_disjoint(&names_of(clause))).collect();
        let before: usize = others.iter().filter(|c| misshapen(guesses, c)).count();
        let mut left = MOST_READINGS;
        for size in &sizes {
            for count in 1..=MOST_NAMES {
                let better = |tried: &BTreeMap<String, Guess>| {
                    !misshapen(tried, clause) && others.iter().filter(|c| misshapen(tried, c)).count() < before
                };
                if let Some(found) = tried(guesses, &names, *size, count, &mut left, &better) {
                    *guesses = found;
                    break;
                }
            }
            if !misshapen(guesses, clause) {
                break;
            }
        }
    }
}

/// Letters before a bracket that are factors and no functions, `q(\mathbf{E})`: where the shapes meet so, the letter is given as
/// a function nowhere, and no other formula suffers.
fn unbracket(guesses: &mut BTreeMap<String, Guess>, evidence: &Evidence, clause: &Clause, clauses: &[Clause]) {
    for name in names_of(clause) {
        let is_function = evidence.given.contains(&name) || evidence.derived.contains_key(&name);
        let Some(guess) = guesses.get(&name).filter(|g| !g.of.is_empty() && !is_function) else { continue };
        let mut tried = guesses.clone();
        tried.insert(name.clone(), Guess { of: Vec::new(), ..guess.clone() });
        let speaks = |c: &&Clause| names_of(c).contains(&name);
        let suffers = |c: &Clause| misshapen(&tried, c) && !misshapen(guesses, c);
        if !misshapen(&tried, clause) && !clauses.iter().filter(speaks).any(suffers) {
            *guesses = tried;
            return;
        }
    }
}

/// The first way to make arrays of so many of the names that is better.
fn tried(
    guesses: &BTreeMap<String, Guess>,
    names: &[String],
    size: usize,
    count: usize,
    left: &mut usize,
    better: &dyn Fn(&BTreeMap<String, Guess>) -> bool,
) -> Option<BTreeMap<String, Guess>> {
    if count == 0 {
        if *left == 0 {
            return None;
        }
        *left -= 1;
        return better(guesses).then(|| guesses.clone());
    }
    for (k, name) in names.iter().enumerate() {
        for role in alternatives(&guesses[name], size) {
            let mut next = guesses.clone();
            if let Some(guess) = next.get_mut(name) {
                guess.role = role;
            }
            if let Some(found) = tried(&next, &names[k + 1..], size, count - 1, left, better) {
                return Some(found);
            }
        }
    }
    None
}

/// What else a symbol may be.
fn alternatives(guess: &Guess, size: usize) -> Vec<Role> {
    let base = subscript(&guess.name).map_or(guess.name.as_str(), |(base, _)| base);
    let letter = base.trim_start_matches("\\mathbf{").trim_start_matches("\\mathrm{").trim_end_matches('}');
    let capital = letter.starts_with(|c: char| c.is_ascii_uppercase())
        || matches!(letter, "\\Lambda" | "\\Sigma" | "\\Phi" | "\\Omega");
    match guess.role {
        Role::Number | Role::Positive if matches!(letter, "I" | "E" | "\\mathbb{1") => {
            vec![Role::Identity(size), Role::Matrix(size, size)]
        }
        Role::Vector if matches!(letter, "I" | "1") => vec![Role::Identity(size), Role::Matrix(size, size)],
        Role::Number | Role::Positive if capital => vec![Role::Matrix(size, size)],
        Role::Vector if capital => vec![Role::Matrix(size, size), Role::Matrix(size, 1)],
        Role::Vector => vec![Role::Matrix(size, 1)],
        Role::Number if letter.len() == 1 => vec![Role::Vector, Role::Matrix(size, 1)],
        _ => Vec::new(),
    }
}

fn misshapen(guesses: &BTreeMap<String, Guess>, clause: &Clause) -> bool {
    let scope = scope(guesses.values());
    reading(&scope, clause).is_err_and(|e| e.kind == ErrorKind::Shape)
}

fn names_of(clause: &Clause) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    names(&clause.lhs, &mut |name| found.extend([name]));
    if let Side::Node(rhs) = &clause.rhs {
        names(rhs, &mut |name| found.extend([name]));
    }
    found
}
