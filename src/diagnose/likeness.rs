//! How unlikely an edit is: what a scan loses or a hand confuses is cheap, what changes the shape of a formula dear.
//!
//! | cost | edit |
//! |---|---|
//! | 2 | a sign, a dot, a prime; letters that look alike (φ ψ, ω Ω, I l 1, O 0, ν v ...); a bracket |
//! | 3 | two dots; an index; sine and cosine; a power by one; a symbol of the same kind and unit; ½ and 2 |
//! | 4 | a dot, a prime, an index or a letter that is gained, where a scan rather loses |
//! | 5 | another number; a factor of 2; a factor left out; dot and cross |
//! | 6 | a factor put in, and 1 for each symbol of it beyond the first |
//! | 7 | a term left out; a term taken from a formula nearby |
//! | 8 | a fraction turned over; a symbol replaced by a product; a term put in, and 1 for each symbol beyond the first |
//!
//! A symbol that no formula nearby has costs 3 more, one that only premises have 1 more; the same edit in every place 2
//! more; a factor before a side that is a symbol alone 1 more; a
//! formula in which a link only introduces a symbol 4 more.

use crate::latex::ast::{Kind, Node};
use crate::semantics::Scope;

use super::mutants::EditKind;
use super::names::{Name, look_alike};

/// What a symbol costs more that no formula nearby has.
pub const FAR: u32 = 3;
/// What a symbol costs more that only the premises of the prose have.
pub const STATED: u32 = 1;
/// What a factor costs more that is put before a side which is a symbol alone.
pub const SUBJECT: u32 = 1;
/// What a formula costs more in which a link only introduces a symbol.
pub const DEFINES: u32 = 4;
/// What a factor costs that is put in.
pub const INSERTED: u32 = 6;
/// What a term costs that stands in a formula nearby.
pub const TERM: u32 = 7;
/// What a term costs that is made up of symbols nearby.
pub const MADE_UP: u32 = 8;
/// What the same edit in every place costs more.
pub const THROUGHOUT: u32 = 2;
/// What each further edit costs beside its own cost: one slip is likelier than two.
pub const FURTHER: u32 = 1;

/// The cost of an edit that puts a node in the place of another.
pub fn cost(scope: &Scope, kind: EditKind, before: &Node, after: &Node) -> u32 {
    let (old, new) = (Name::of(scope, before), Name::of(scope, after));
    match kind {
        EditKind::Sign | EditKind::Bracket => 2,
        EditKind::Dot => old.zip(new).map_or(2, |(a, b)| match b.dots.checked_sub(a.dots) {
            Some(more) if more > 0 => 1 + u32::from(more),
            _ => 4,
        }),
        EditKind::Prime => old.zip(new).map_or(2, |(a, b)| if primes(&b.bare) > primes(&a.bare) { 2 } else { 4 }),
        EditKind::Symbol => old.zip(new).map_or(3, |(a, b)| if look_alike(&a.bare, &b.bare) { 2 } else { 4 }),
        EditKind::Index | EditKind::Function | EditKind::Power => 3,
        EditKind::Number if is_half(after) || is_half(before) => 3,
        EditKind::Number | EditKind::Double | EditKind::DropFactor | EditKind::Operator => 5,
        EditKind::Insert => INSERTED,
        EditKind::DropTerm | EditKind::Term => TERM,
        EditKind::Invert | EditKind::Replace => 8,
    }
}

fn primes(node: &Node) -> u8 {
    match &node.kind {
        Kind::Scripts { primes, .. } => *primes,
        _ => 0,
    }
}

fn is_half(node: &Node) -> bool {
    let is = |n: &Node, digits: &str| matches!(&n.kind, Kind::Number(d) if d == digits);
    matches!(&node.kind, Kind::Frac(a, b) if is(a, "1") && is(b, "2"))
}
