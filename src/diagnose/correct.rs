//! What was probably meant.

use crate::check::verdict::{Judgement, Suggestion};
use crate::check::{Book, Options};

/// The formulas near a failing one.
pub fn suggestions(_book: &Book, _index: usize, _judgement: &Judgement, _options: &Options) -> Vec<Suggestion> {
    Vec::new()
}
