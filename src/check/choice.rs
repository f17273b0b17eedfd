//! Which premises are independent, and which symbols to solve them for.

use std::collections::BTreeMap;

use nalgebra::{DMatrix, DVector};

use crate::expr::{Deadline, Expr, Graph, SymId, Tape, Workspace};
use crate::semantics::World;

use super::newton::{Equations, descend};
use super::random::{Random, draw};
use super::system::{DERIVING, NoState, Source, Wish, source};

/// How many starts are tried for a solution of the premises.
const TRIES: usize = 12;

/// How many solutions are looked at, of each stage, for one that is no special case.
const SOLUTIONS: usize = 4;
/// The most entries of the premises' Jacobian: its singular values take seconds.
const LARGEST_SYSTEM: usize = 200_000;

/// What is left of a column of the scaled Jacobian beside those before it, for it to count as independent of them. The
/// point at which the Jacobian is taken is known to some 1e-11.
const INDEPENDENT: f64 = 1e-7;

/// The order in which symbols are tried as unknowns: those asked for, the highest time derivatives, other functions
/// of time, then constants, the rarer the better.
pub fn preference(graph: &Graph, solve: &[SymId], s: SymId) -> (usize, u32, bool, std::cmp::Reverse<usize>) {
    let info = graph.info(s);
    let wished = solve.iter().position(|x| *x == s).unwrap_or(usize::MAX);
    (wished, u32::MAX - info.order, !info.of_t, std::cmp::Reverse(s.index()))
}

/// The places of the residuals that are solved, and of the symbols that they are solved for.
type Choice = (Vec<usize>, Vec<usize>);

/// Chooses independent residuals (rows) and the symbols to solve them for (columns), by the ranks of the Jacobian at a
/// point where all premises hold: elsewhere premises that follow from each other look independent.
///
/// A premise that was multiplied by \dot{\theta} also holds where that factor is zero, whatever the rest of it says, and a
/// check there says nothing. At such a point the premise changes with the factor alone: a solution is looked for at which
/// no premise of several symbols changes with one only.
pub fn choose(
    world: &mut World,
    residuals: &[Expr],
    candidates: &[SymId],
    wish: &Wish,
    random: &mut Random,
) -> Result<Choice, NoState> {
    if residuals.is_empty() {
        return Ok((Vec::new(), Vec::new()));
    }
    if residuals.len() * candidates.len() > LARGEST_SYSTEM {
        return Err(NoState::CutShort(format!(
            "the premises are {} equations in {} symbols, too many to be solved together: state fewer premises, or let the indices run over fewer values",
            residuals.len(),
            candidates.len()
        )));
    }
    let jacobian = world.graph.jacobian(residuals, candidates);
    let magnitudes: Vec<Expr> = residuals.iter().map(|r| world.graph.magnitude(*r)).collect();
    NoState::check(world, DERIVING)?;
    let deadline = world.graph.deadline();
    let sized: Vec<Expr> = residuals.iter().copied().chain(magnitudes).collect();
    let jacobian: Vec<Expr> = jacobian.into_iter().flatten().collect();
    let changes = |row: &[Expr]| row.iter().filter(|e| !world.graph.is_zero(**e)).count();
    let several: Vec<bool> = jacobian.chunks(candidates.len().max(1)).map(|row| changes(row) > 1).collect();
    let (values, jacobian) = (Tape::compile(&world.graph, &sized), Tape::compile(&world.graph, &jacobian));
    let symbols = world.graph.symbols(residuals);
    let sources: BTreeMap<SymId, Source> = symbols.into_iter().map(|s| (s, source(world, s))).collect();
    let mut best: Option<(usize, Choice)> = None;
    // The fewest symbols that will do are moved: what the premises determine, not the constants of the problem.
    for stage in 0..3 {
        let movable: Vec<usize> =
            (0..candidates.len()).filter(|k| moves(&world.graph, wish, candidates[*k]) <= stage).collect();
        let mut solutions = 0;
        for _ in 0..if movable.is_empty() { 0 } else { TRIES } {
            if deadline.has_passed() {
                return Err(NoState::CutShort(deadline.used_up("solving the premises")));
            }
            let drawn = sources.iter().map(|(s, src)| (*s, draw(random, src.range, src.integer, false).to_f64()));
            let mut premises = Underdetermined {
                values: &values,
                jacobian: &jacobian,
                count: residuals.len(),
                moved: movable.iter().map(|k| candidates[*k]).collect(),
                movable: &movable,
                at: drawn.collect(),
                work: Workspace::default(),
                deadline,
            };
            let Some(magnitudes) = premises.solve() else { continue };
            let j = premises.scaled_jacobian(candidates, &magnitudes);
            let special =
                j.row_iter().zip(&several).filter(|(row, several)| **several && changes_with_one(row.iter())).count();
            if best.as_ref().is_none_or(|(least, _)| special < *least) {
                let columns = independent(&j.select_columns(&movable));
                let columns: Vec<usize> = columns.into_iter().map(|c| movable[c]).collect();
                let rows = independent(&j.select_columns(&columns).transpose());
                // Where rounding hides the rank, rows and columns may differ in number: another point shows it.
                if rows.len() == columns.len() {
                    best = Some((special, (rows, columns)));
                }
            }
            solutions += 1;
            if special == 0 || solutions == SOLUTIONS {
                break;
            }
        }
        if best.as_ref().is_some_and(|(special, _)| *special == 0) {
            break;
        }
    }
    best.map(|(_, choice)| choice).ok_or(NoState::Unsolvable)
}

/// Whether a row of the scaled Jacobian has one entry that is not zero.
fn changes_with_one<'a>(row: impl IntoIterator<Item = &'a f64>) -> bool {
    row.into_iter().filter(|x| x.abs() > INDEPENDENT).count() == 1
}

/// The stage at which a symbol may be moved to satisfy the premises: first those asked for and time derivatives, then
/// other functions of time, last the constants.
fn moves(graph: &Graph, wish: &Wish, s: SymId) -> usize {
    let info = graph.info(s);
    match (wish.solve.contains(&s) || info.order > 0, info.of_t) {
        (true, _) => 0,
        (false, true) => 1,
        (false, false) => 2,
    }
}

/// The premises as a system in more symbols than equations: Newton's method with steps of least length.
struct Underdetermined<'t> {
    /// The residuals, then the magnitudes of their terms.
    values: &'t Tape,
    /// The Jacobian by all candidates, row by row.
    jacobian: &'t Tape,
    /// The number of residuals.
    count: usize,
    /// The candidates that are moved, and their places among all.
    moved: Vec<SymId>,
    movable: &'t [usize],
    /// All symbols' values.
    at: BTreeMap<SymId, f64>,
    work: Workspace<f64>,
    deadline: Deadline,
}

impl Underdetermined<'_> {
    /// Moves to a solution: the magnitudes of the residuals' terms there.
    fn solve(&mut self) -> Option<Vec<f64>> {
        let start = DVector::from_iterator(self.moved.len(), self.moved.iter().map(|s| self.at[s]));
        let (x, _) = descend(start, self)?;
        let values = self.evaluate(self.values, &x);
        let (residuals, magnitudes) = values.split_at(self.count);
        // Not every stationary point is a solution.
        let solved = residuals.iter().zip(magnitudes).all(|(r, size)| r.abs() <= 1e-9 * size.max(f64::MIN_POSITIVE));
        solved.then(|| magnitudes.to_vec())
    }

    /// The Jacobian by all candidates where the symbols are, scaled.
    fn scaled_jacobian(&mut self, candidates: &[SymId], magnitudes: &[f64]) -> DMatrix<f64> {
        let sizes: Vec<f64> = candidates.iter().map(|s| self.at[s].abs().max(1e-3)).collect();
        let at = DVector::from_iterator(self.moved.len(), self.moved.iter().map(|s| self.at[s]));
        let values = self.evaluate(self.jacobian, &at);
        scaled(DMatrix::from_row_slice(self.count, candidates.len(), &values), &sizes, magnitudes)
    }

    fn evaluate(&mut self, tape: &Tape, x: &DVector<f64>) -> Vec<f64> {
        for (s, x) in self.moved.iter().zip(x.iter()) {
            self.at.insert(*s, *x);
        }
        let inputs: Vec<f64> = tape.inputs().iter().map(|s| self.at.get(s).copied().unwrap_or(f64::NAN)).collect();
        tape.eval(&inputs, &(), &mut self.work).to_vec()
    }
}

impl Equations for Underdetermined<'_> {
    fn residuals(&mut self, x: &DVector<f64>) -> DVector<f64> {
        let mut values = self.evaluate(self.values, x);
        values.truncate(self.count);
        DVector::from_vec(values)
    }

    fn jacobian(&mut self, x: &DVector<f64>) -> DMatrix<f64> {
        let values = self.evaluate(self.jacobian, x);
        DMatrix::from_row_slice(self.count, values.len() / self.count.max(1), &values).select_columns(self.movable)
    }

    fn step(&self, residuals: &DVector<f64>, jacobian: &DMatrix<f64>) -> Option<DVector<f64>> {
        if self.deadline.has_passed() || jacobian.iter().any(|x| !x.is_finite()) {
            return None;
        }
        let svd = jacobian.clone().svd(true, true);
        let largest = svd.singular_values.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
        svd.solve(residuals, 1e-9 * largest).ok()
    }
}

/// The Jacobian by relative changes of the symbols, each row of length 1, so that units play no part. A premise that
/// holds at every state has a row of rounding errors, which is small against the premise's terms: it becomes zero.
fn scaled(mut j: DMatrix<f64>, sizes: &[f64], magnitudes: &[f64]) -> DMatrix<f64> {
    for (mut column, size) in j.column_iter_mut().zip(sizes) {
        column *= *size;
    }
    for (mut row, magnitude) in j.row_iter_mut().zip(magnitudes) {
        let length = row.norm();
        row /= if length > INDEPENDENT * magnitude { length } else { f64::INFINITY };
    }
    j
}

/// The columns that are independent of those before them, by Gram and Schmidt.
fn independent(j: &DMatrix<f64>) -> Vec<usize> {
    let mut basis: Vec<DVector<f64>> = Vec::new();
    let mut chosen = Vec::new();
    for (k, column) in j.column_iter().enumerate() {
        let mut v: DVector<f64> = column.into_owned();
        // Twice is enough (Kahan, Parlett).
        for _ in 0..2 {
            for b in &basis {
                v -= b * b.dot(&v);
            }
        }
        let left = v.norm();
        if left > INDEPENDENT {
            basis.push(v / left);
            chosen.push(k);
            if basis.len() == j.nrows() {
                break;
            }
        }
    }
    chosen
}
