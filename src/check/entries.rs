//! The equations of a book, which know that they are looked at.

use std::ops::{Index, IndexMut};
use std::sync::Arc;

use crate::trace;

use super::book::Entry;

/// The equations in order. A copy shares them until one is changed.
///
/// Promise: whoever gets at an equation by its place is [recorded](crate::trace). Going through all of them is not: what
/// does, such as the survey of the dimensions, is no part of a judgement.
#[derive(Clone, Debug, Default)]
pub struct Entries(Vec<Arc<Entry>>);

impl Entries {
    /// How many there are.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// All of them, in order.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &Entry> + DoubleEndedIterator {
        self.0.iter().map(Arc::as_ref)
    }

    /// One of them, without a record of it: for what answers a question that is recorded itself.
    pub(super) fn quietly(&self, index: usize) -> &Entry {
        &self.0[index]
    }

    pub(super) fn push(&mut self, entry: Entry) {
        self.0.push(Arc::new(entry));
    }
}

impl Index<usize> for Entries {
    type Output = Entry;

    fn index(&self, index: usize) -> &Entry {
        trace::equation(index);
        &self.0[index]
    }
}

impl IndexMut<usize> for Entries {
    fn index_mut(&mut self, index: usize) -> &mut Entry {
        trace::equation(index);
        let entry = Arc::make_mut(&mut self.0[index]);
        entry.statements = Default::default();
        entry
    }
}

impl<'e> IntoIterator for &'e Entries {
    type Item = &'e Entry;
    type IntoIter = std::iter::Map<std::slice::Iter<'e, Arc<Entry>>, fn(&'e Arc<Entry>) -> &'e Entry>;

    fn into_iter(self) -> Self::IntoIter {
        self.0.iter().map(Arc::as_ref)
    }
}
