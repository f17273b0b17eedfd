//! What some work looks at: a record of the questions that it asks of notes.
//!
//! A judgement depends on a few lines of the notes only, and which these are is known best by having watched it. The
//! places that answer questions ([`Scope`](crate::semantics::Scope), [`Book`](crate::check::Book)) note each question
//! here; nothing is noted, and next to nothing spent, where nobody records.
//!
//! Promise: work that asks the same questions of other notes and gets the same answers comes to the same end.

use std::cell::{Cell, RefCell};
use std::collections::{BTreeSet, HashSet};

/// The questions that were asked.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Trace {
    /// The spellings whose declaration was looked up, in whichever scope, and whether they were found or not.
    pub names: HashSet<String>,
    /// Whether all that a scope declares was gone through.
    pub all_names: bool,
    /// The equations that were looked at, by their place in the book.
    pub equations: BTreeSet<usize>,
    /// Those of them that continue the equation before, whichever that is.
    pub continued: BTreeSet<usize>,
    /// The references that were looked up: `75`, `75.2`.
    pub references: BTreeSet<String>,
    /// The equations of which it was asked whether a symbol is mentioned before, with the symbol's pattern.
    pub mentioned: BTreeSet<(usize, String)>,
    /// The equations of which it was asked whether their premises go in a circle.
    pub circles: BTreeSet<usize>,
    /// The equations of which it was asked what stands around them, and how far.
    pub around: BTreeSet<(usize, usize)>,
}

impl Trace {
    fn extend(&mut self, other: &Trace) {
        self.names.extend(other.names.iter().cloned());
        self.all_names |= other.all_names;
        self.equations.extend(&other.equations);
        self.continued.extend(&other.continued);
        self.references.extend(other.references.iter().cloned());
        self.mentioned.extend(other.mentioned.iter().cloned());
        self.circles.extend(&other.circles);
        self.around.extend(&other.around);
    }
}

thread_local! {
    /// Whether somebody records on this thread.
    static RECORDED: Cell<bool> = const { Cell::new(false) };
    static TRACE: RefCell<Trace> = RefCell::default();
}

/// What the work gives, with what it asked on this thread. Who records around it is told, too.
pub fn recorded<T>(work: impl FnOnce() -> T) -> (T, Trace) {
    // A panic leaves the records of those around as they are.
    struct Outer(bool, Trace);
    impl Drop for Outer {
        fn drop(&mut self) {
            RECORDED.set(self.0);
            TRACE.set(std::mem::take(&mut self.1));
        }
    }
    let mut outer = Outer(RECORDED.replace(true), TRACE.take());
    let result = work();
    let trace = TRACE.take();
    if outer.0 {
        outer.1.extend(&trace);
    }
    (result, trace)
}

/// What the work gives, without a record of what it asked: it answers a question that has been noted.
pub fn unrecorded<T>(work: impl FnOnce() -> T) -> T {
    struct Outer(bool);
    impl Drop for Outer {
        fn drop(&mut self) {
            RECORDED.set(self.0);
        }
    }
    let _outer = Outer(RECORDED.replace(false));
    work()
}

/// Notes a question, where somebody records.
fn note(question: impl FnOnce(&mut Trace)) {
    if RECORDED.get() {
        TRACE.with_borrow_mut(question);
    }
}

/// A spelling is looked up in a scope.
pub fn name(spelling: &str) {
    note(|trace| {
        if !trace.names.contains(spelling) {
            trace.names.insert(spelling.to_owned());
        }
    });
}

/// All that a scope declares is gone through.
pub fn all_names() {
    note(|trace| trace.all_names = true);
}

/// An equation is looked at.
pub fn equation(index: usize) {
    note(|trace| {
        trace.equations.insert(index);
    });
}

/// It is asked which equation stands before one that continues it.
pub fn continued(index: usize) {
    note(|trace| {
        trace.continued.insert(index);
    });
}

/// A reference is looked up.
pub fn reference(text: &str) {
    note(|trace| {
        if !trace.references.contains(text) {
            trace.references.insert(text.to_owned());
        }
    });
}

/// It is asked whether a symbol is mentioned before an equation.
pub fn mentioned(index: usize, pattern: &str) {
    note(|trace| {
        trace.mentioned.insert((index, pattern.to_owned()));
    });
}

/// It is asked whether an equation's premises go in a circle.
pub fn circle(index: usize) {
    note(|trace| {
        trace.circles.insert(index);
    });
}

/// It is asked what stands around an equation.
pub fn around(index: usize, reach: usize) {
    note(|trace| {
        trace.around.insert((index, reach));
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_asked_is_recorded_for_all_around() {
        name("nobody records");
        let ((inner, length), outer) = recorded(|| {
            name("a");
            let (length, inner) = recorded(|| {
                name("b");
                equation(3);
                unrecorded(|| equation(4));
                7
            });
            reference("75.2");
            (inner, length)
        });
        assert_eq!(length, 7);
        assert_eq!(inner.names, HashSet::from(["b".to_owned()]));
        assert_eq!(outer.names, HashSet::from(["a".to_owned(), "b".to_owned()]));
        assert_eq!((inner.equations.clone(), inner.references.len()), (BTreeSet::from([3]), 0));
        assert_eq!((outer.equations, outer.references.len()), (BTreeSet::from([3]), 1));
        assert!(recorded(|| ()).1 == Trace::default(), "nothing is left from before");
    }

    #[test]
    fn a_panic_ends_only_its_own_record() {
        let (_, outer) = recorded(|| {
            name("before");
            let inner = crate::breakdown::caught(|| recorded(|| -> u8 { panic!("on purpose") }));
            assert!(inner.is_err());
            name("after");
        });
        assert_eq!(outer.names.len(), 2);
        assert_eq!(recorded(|| ()).1, Trace::default());
    }
}
