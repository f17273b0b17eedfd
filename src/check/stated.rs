//! What the premises of an equation state, as pairs of equal scalars and scalars with a sign.

use crate::document::Spanned;
use crate::expr::Expr;
use crate::latex::ast::Rel;
use crate::semantics::{self, Clause, Error, Scope, Side, World};

use super::book::{Formula, Version};
use super::claim::{Obstacle, Source, broken, in_time, pairs, unclear, unclear_text, with_help};

/// What premises state, of scalars.
#[derive(Clone, Debug, Default)]
pub struct Stated {
    /// What is equal.
    pub equal: Vec<(Expr, Expr)>,
    /// What is greater or less than zero.
    pub ordered: Vec<(Rel, Expr)>,
}

impl<'b> Source<'b> {
    /// What the premises state.
    pub(super) fn given(&self, world: &mut World) -> Result<Stated, Obstacle> {
        let entry = &self.book.entries[self.index];
        let mut stated = Stated::default();
        for text in entry.wheres(self.link) {
            self.add_text(world, text, &mut stated)?;
        }
        for reference in entry.given(self.link) {
            self.add_equation(world, reference, &mut stated)?;
        }
        self.add_data(world, &mut stated)?;
        self.add_assumed(world, &mut stated)?;
        Ok(stated)
    }

    /// The pairs of equal scalars that the section's assumptions state: what symbols are defined as, for the most part.
    pub(super) fn assumed(&self, world: &mut World) -> Result<Vec<(Expr, Expr)>, Obstacle> {
        let mut stated = Stated::default();
        self.add_assumed(world, &mut stated)?;
        Ok(stated.equal)
    }

    fn add_assumed(&self, world: &mut World, stated: &mut Stated) -> Result<(), Obstacle> {
        self.scope().assume.iter().try_for_each(|text| self.add_text(world, text, stated))
    }

    fn add_text(&self, world: &mut World, text: &Spanned<String>, stated: &mut Stated) -> Result<(), Obstacle> {
        let tree = Formula::new(&text.value).tree.map_err(|e| broken(text, &e))?;
        let statement = semantics::statement(&tree, None).map_err(|e| unclear(text, &e))?;
        for clause in &statement.clauses {
            self.add_clause(world, self.scope(), clause, stated).map_err(|e| unclear(text, &e))?;
        }
        Ok(())
    }

    /// Adds what an equation states, as corrected where it has a correction.
    fn add_equation(
        &self,
        world: &mut World,
        reference: &Spanned<String>,
        stated: &mut Stated,
    ) -> Result<(), Obstacle> {
        let obstacle =
            |message: String| Obstacle::Premise(format!("({})", reference.value), message, reference.span.clone());
        let (index, part) =
            self.book.find(&reference.value).ok_or_else(|| obstacle("there is no such equation".into()))?;
        let statement = self.book.statement(index, Version::Corrected).map_err(|u| obstacle(unclear_text(&u)))?;
        let scope = &self.book.entries[index].scope;
        // What continues an earlier chain states its last side to equal the chain's first.
        let head = statement.clauses.first().filter(|c| c.continued).and(statement.head.clone());
        for clause in statement.clauses.iter().filter(|c| part.is_none_or(|p| c.part == p)) {
            let mut clause = clause.clone();
            if let (true, Some(head)) = (clause.continued, &head) {
                clause.lhs = head.clone();
            }
            self.add_clause(world, scope, &clause, stated).map_err(|e| obstacle(with_help(&e)))?;
        }
        Ok(())
    }

    /// Adds what a clause states, where it is an equation or says what is greater.
    pub(super) fn add_clause(
        &self,
        world: &mut World,
        scope: &Scope,
        clause: &Clause,
        stated: &mut Stated,
    ) -> Result<(), Error> {
        // What holds under a condition is given with it.
        clause.when.iter().try_for_each(|condition| self.add_clause(world, scope, condition, stated))?;
        let ordered = matches!(clause.rel, Rel::Lt | Rel::Le | Rel::Gt | Rel::Ge);
        let equal = matches!(clause.rel, Rel::Eq | Rel::Equiv | Rel::Implies) || semantics::is_geometric(clause.rel);
        if !ordered && !equal {
            return Ok(());
        }
        let link = semantics::understand(world, scope, clause, true)?;
        // That numbers are proportional to each other says nothing of their values.
        if link.rel == Rel::Propto {
            return Ok(());
        }
        let constant = clause.rhs == Side::Constant;
        for pair in self::pairs(world, &link, constant) {
            if ordered {
                stated.ordered.push((clause.rel, pair.residual));
                continue;
            }
            let stands = (pair.lhs, pair.rhs);
            stated.equal.push(stands);
            let rates = in_time(world, pair).into_iter().filter(|pair| !pair.start);
            stated.equal.extend(rates.map(|pair| (pair.lhs, pair.rhs)).filter(|rate| *rate != stands));
        }
        Ok(())
    }

    /// The clauses of the equations that this one is said to solve.
    pub fn solved(&self) -> Result<Vec<(Clause, &'b Scope)>, Obstacle> {
        let mut clauses = Vec::new();
        for reference in self.book.entries[self.index].list(|a| &a.solves) {
            let obstacle =
                |message: String| Obstacle::Premise(format!("({})", reference.value), message, reference.span.clone());
            let (index, part) =
                self.book.find(&reference.value).ok_or_else(|| obstacle("there is no such equation".into()))?;
            let statement = self.book.statement(index, Version::Corrected).map_err(|u| obstacle(unclear_text(&u)))?;
            let scope = self.book.entries[index].scope.as_ref();
            let head = statement.head.clone();
            for mut clause in statement.clauses {
                if part.is_some_and(|p| clause.part != p) {
                    continue;
                }
                if let (true, Some(head)) = (clause.continued, &head) {
                    clause.lhs = head.clone();
                }
                clauses.push((clause, scope));
            }
        }
        Ok(clauses)
    }
}
