//! Scopes and values for the tests of this folder.

use std::collections::HashMap;
use std::path::Path;

use super::error::Result;
use super::{Elaborator, Scope, Value, World};
use crate::document::{self, Item};
use crate::expr::{Expr, Tape, Workspace};

/// The scope of some declarations in TOML.
pub(super) fn scope(declarations: &str) -> Scope {
    let source = format!("<!-- kenzan\n{declarations}\n-->\n\n$$x = x$$\n");
    let document = document::parse(Path::new("test.md"), &source);
    let mut scope = Scope::default();
    for item in &document.items {
        if let Item::Declarations(block) = item {
            assert_eq!(scope.declare(block), Vec::new());
        }
    }
    assert!(scope.entries().next().is_some(), "{:?}", document.problems);
    scope
}

/// The value of a formula.
pub(super) fn value(world: &mut World, scope: &Scope, latex: &str) -> Result<Value> {
    let tree = crate::latex::parse(latex).unwrap();
    Elaborator::new(world, scope, Vec::new(), true).value(&tree).map(|typed| typed.value)
}

/// Whether two formulas have the same value, at one state of the symbols that they mention.
pub(super) fn same(declarations: &str, left: &str, right: &str) -> bool {
    let (mut world, scope) = (World::new(), scope(declarations));
    let (a, b) = (value(&mut world, &scope, left).unwrap(), value(&mut world, &scope, right).unwrap());
    let (a, b) = (a.components(), b.components());
    let symbols = world.graph.symbols(&[a.clone(), b.clone()].concat());
    let state = symbols.iter().enumerate().map(|(k, s)| (*s, 0.3 + 0.7 * (k as f64 * 1.7).sin()));
    let state: HashMap<_, _> = state.collect();
    let at = |es: &[Expr]| -> Vec<f64> {
        let tape = Tape::compile(&world.graph, es);
        let inputs: Vec<f64> = tape.inputs().iter().map(|s| state[s]).collect();
        tape.eval(&inputs, &(), &mut Workspace::default()).to_vec()
    };
    let (x, y) = (at(&a), at(&b));
    x.len() == y.len() && x.iter().zip(&y).all(|(p, q)| (p - q).abs() < 1e-12)
}
