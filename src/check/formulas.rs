//! Formulas that have been parsed, so that the next reading of the same notes parses only what is new.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use crate::latex::expand::Macros;

use super::book::Formula;

/// The formulas of the last two readings, by their LaTeX. Several threads may read at once.
#[derive(Debug, Default)]
pub struct Formulas(Mutex<Known>);

#[derive(Debug, Default)]
struct Known {
    recent: HashMap<String, Arc<Formula>>,
    before: HashMap<String, Arc<Formula>>,
}

impl Known {
    fn find(&mut self, latex: &str) -> Option<Arc<Formula>> {
        if let Some(known) = self.recent.get(latex) {
            return Some(Arc::clone(known));
        }
        let formula = self.before.remove(latex)?;
        self.recent.insert(latex.to_owned(), Arc::clone(&formula));
        Some(formula)
    }
}

impl Formulas {
    /// The formula of this LaTeX.
    pub fn read(&self, latex: &str) -> Arc<Formula> {
        let known = self.known().find(latex);
        known.unwrap_or_else(|| {
            let formula = Arc::new(Formula::new(latex));
            Arc::clone(self.known().recent.entry(latex.to_owned()).or_insert(formula))
        })
    }

    fn known(&self) -> MutexGuard<'_, Known> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The formula of LaTeX with macros.
    pub fn read_with(&self, latex: &str, macros: &Macros) -> Arc<Formula> {
        match macros.expand(latex) {
            Ok(expanded) if expanded.is_verbatim() => self.read(latex),
            _ => Arc::new(Formula::with_macros(latex, macros)),
        }
    }

    /// Begins another reading: what the last one did not need is forgotten.
    pub(super) fn turn(&self) {
        let mut known = self.known();
        known.before = std::mem::take(&mut known.recent);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_formula_is_kept_for_one_reading_more() {
        let formulas = Formulas::default();
        let first = formulas.read("a = b");
        formulas.turn();
        assert!(Arc::ptr_eq(&first, &formulas.read("a = b")), "of the last reading");
        assert!(Arc::ptr_eq(&first, &formulas.read("a = b")), "of this reading");
        formulas.turn();
        formulas.turn();
        assert!(!Arc::ptr_eq(&first, &formulas.read("a = b")), "not of one before the last");
    }
}
