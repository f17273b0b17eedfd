//! Scopes and values for the tests of this folder.

use std::path::Path;

use super::error::Result;
use super::{Elaborator, Scope, Value, World};
use crate::document::{self, Item};

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
