//! Dots that a scan has lost, or moved, over every place of a symbol at once: r · ṙ printed for ṙ · r̈.

use std::collections::BTreeMap;

use crate::latex::ast::Node;
use crate::latex::to_latex;
use crate::semantics::Scope;

use super::change::{Change, at};
use super::likeness::THROUGHOUT;
use super::names::Name;

/// The changes that put the same number of dots more, or less, over every place of a symbol, whatever dots are printed
/// there; none for a symbol that is printed with the same dots everywhere. `single` are the changes of the dots over one
/// place each.
pub fn shifted<'c>(scope: &Scope, tree: &Node, single: impl Iterator<Item = &'c Change>) -> Vec<Change> {
    let mut symbols: BTreeMap<(String, i16), Vec<&Change>> = BTreeMap::new();
    for change in single {
        let [(path, after)] = change.places.as_slice() else { continue };
        let before = at(tree, path).and_then(|before| Name::of(scope, before));
        let (Some(before), Some(after)) = (before, Name::of(scope, after)) else { continue };
        let more = i16::from(after.dots) - i16::from(before.dots);
        symbols.entry((to_latex(&before.bare), more)).or_default().push(change);
    }
    let several = symbols.into_iter().filter(|(_, all)| all.iter().any(|c| c.edits != all[0].edits));
    several
        .map(|((symbol, more), all)| Change {
            places: all.iter().flat_map(|c| c.places.clone()).collect(),
            edits: vec![format!("{} over every `{symbol}`", in_words(more))],
            cost: all.iter().map(|c| c.cost).max().unwrap_or_default() + THROUGHOUT,
        })
        .collect()
}

fn in_words(more: i16) -> String {
    let number = match more.abs() {
        1 => "a dot".to_owned(),
        2 => "two dots".to_owned(),
        n => format!("{n} dots"),
    };
    format!("{number} {}", if more > 0 { "more" } else { "less" })
}
