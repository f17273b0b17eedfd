//! Formulas that have been parsed, so that the next reading of the same notes parses only what is new.

use std::collections::HashMap;
use std::sync::Arc;

use crate::latex::expand::Macros;

use super::book::Formula;

/// The formulas of the last two readings, by their LaTeX.
#[derive(Debug, Default)]
pub struct Formulas {
    recent: HashMap<String, Arc<Formula>>,
    before: HashMap<String, Arc<Formula>>,
}

impl Formulas {
    /// The formula of this LaTeX.
    pub fn read(&mut self, latex: &str) -> Arc<Formula> {
        if let Some(known) = self.recent.get(latex) {
            return Arc::clone(known);
        }
        let formula = self.before.remove(latex).unwrap_or_else(|| Arc::new(Formula::new(latex)));
        self.recent.insert(latex.to_owned(), Arc::clone(&formula));
        formula
    }

    /// The formula of LaTeX with macros.
    pub fn read_with(&mut self, latex: &str, macros: &Macros) -> Arc<Formula> {
        match macros.expand(latex) {
            Ok(expanded) if expanded.is_verbatim() => self.read(latex),
            _ => Arc::new(Formula::with_macros(latex, macros)),
        }
    }

    /// Begins another reading: what the last one did not need is forgotten.
    pub(super) fn turn(&mut self) {
        self.before = std::mem::take(&mut self.recent);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_formula_is_kept_for_one_reading_more() {
        let mut formulas = Formulas::default();
        let first = formulas.read("a = b");
        formulas.turn();
        assert!(Arc::ptr_eq(&first, &formulas.read("a = b")), "of the last reading");
        assert!(Arc::ptr_eq(&first, &formulas.read("a = b")), "of this reading");
        formulas.turn();
        formulas.turn();
        assert!(!Arc::ptr_eq(&first, &formulas.read("a = b")), "not of one before the last");
    }
}
