//! Premises solved in the prime field, one block after another: what is affine by Gaussian elimination, one quadratic
//! unknown by a square root.
//!
//! Promise: the unknowns are those that the numeric check solves for while all others are drawn freely. A block is
//! solved where, what is known being given, its equations have exactly one solution (or the two roots of a quadratic
//! equation, both of which are tried). So the states of the numeric check are values of the very functions whose values
//! the field has, wherever the pivots do not vanish, and they vanish at no generic state.

use std::collections::{BTreeMap, BTreeSet};

use crate::expr::field::{Degree, Element, Field, Point, Values};
use crate::expr::{Expr, Graph, SymId};

/// Premises and the unknowns to solve them for.
pub struct Elimination {
    residuals: Vec<Expr>,
    unknowns: Vec<SymId>,
    /// For each residual its derivatives by the unknowns that it contains.
    rows: Vec<BTreeMap<usize, Slope>>,
}

/// The derivative of a residual by an unknown.
struct Slope {
    derivative: Expr,
    /// The unknowns that it contains.
    of: BTreeSet<usize>,
    /// The second derivative, where the residual is quadratic in the unknown alone.
    curvature: Option<Expr>,
}

/// Why the premises are not solved at a point.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Unsolved {
    /// The point is to be drawn again: a division by zero, a radicand that is no square.
    Unlucky,
    /// The premises are not affine in these unknowns, even one after another.
    NotAffine(Vec<SymId>),
    /// The premises do not determine the unknowns, or contradict each other.
    Singular,
}

impl Elimination {
    /// Takes the derivatives, and finds out which unknowns they depend on.
    pub fn new(graph: &mut Graph, residuals: &[Expr], unknowns: &[SymId], random: &mut dyn FnMut() -> u64) -> Self {
        let number: BTreeMap<SymId, usize> = unknowns.iter().enumerate().map(|(k, s)| (*s, k)).collect();
        let within = |graph: &Graph, e: Expr| -> BTreeSet<usize> {
            graph.symbols(&[e]).iter().filter_map(|s| number.get(s).copied()).collect()
        };
        let jacobian = graph.jacobian(residuals, unknowns);
        let mut rows: Vec<BTreeMap<usize, Slope>> = Vec::new();
        for row in jacobian {
            let slopes = row.into_iter().enumerate().filter(|(_, d)| !graph.is_zero(*d));
            let slope = |(k, derivative)| (k, Slope { derivative, of: within(graph, derivative), curvature: None });
            rows.push(slopes.map(slope).collect());
        }
        let mut elimination = Elimination { residuals: residuals.to_vec(), unknowns: unknowns.to_vec(), rows };
        elimination.narrow(graph, random);
        for (k, slope) in elimination.rows.iter_mut().flatten().filter(|(k, slope)| slope.of.contains(k)) {
            let curvature = graph.diff(slope.derivative, unknowns[*k]);
            slope.curvature = Some(curvature).filter(|e| !within(graph, *e).contains(k));
        }
        elimination
    }

    /// Drops unknowns that stand in a formula but cancel: derivatives that vanish at a random point, and dependences on
    /// an unknown that may be drawn again without a change. Should chance deceive here, the steps that are taken later
    /// lead to no solution, which is seen.
    fn narrow(&mut self, graph: &Graph, random: &mut dyn FnMut() -> u64) {
        let field = Field::new(graph, &self.expressions());
        let point = field.draw(random);
        let other = field.draw(random);
        let values = field.eval(&point, 0);
        for row in &mut self.rows {
            row.retain(|_, slope| !values.at(slope.derivative).is_some_and(Element::vanishes));
        }
        for (j, s) in self.unknowns.iter().enumerate() {
            let mut moved = point.clone();
            moved.symbols[s.index()] = other.symbols[s.index()];
            let moved = field.eval(&moved, 0);
            for slope in self.rows.iter_mut().flat_map(|row| row.values_mut()).filter(|slope| slope.of.contains(&j)) {
                let (a, b) = (values.at(slope.derivative), moved.at(slope.derivative));
                if a.zip(b).is_some_and(|(a, b)| a.value == b.value) {
                    slope.of.remove(&j);
                }
            }
        }
    }

    /// Whether there are no premises.
    pub fn is_empty(&self) -> bool {
        self.residuals.is_empty()
    }

    /// Everything that has to be evaluated.
    pub fn expressions(&self) -> Vec<Expr> {
        let slopes = self.rows.iter().flat_map(|row| row.values());
        let derivatives = slopes.flat_map(|s| [s.derivative].into_iter().chain(s.curvature));
        self.residuals.iter().copied().chain(derivatives).collect()
    }

    /// Puts the unknowns into a point. The signs of square roots are taken from the bits of `signs`, first for those of
    /// the field, then for those of quadratic equations; returns how many bits were used.
    pub fn solve(&self, field: &Field, point: &mut Point, signs: u32) -> Result<usize, Unsolved> {
        let mut bits = field.roots();
        let mut open: BTreeSet<usize> = (0..self.unknowns.len()).collect();
        // The start of a step is a constant: what is found does not depend on it.
        for s in &self.unknowns {
            if let Some(x) = point.symbols.get_mut(s.index()) {
                x.degree = Degree::default();
            }
        }
        while !open.is_empty() {
            let values = field.eval(point, signs);
            let mut found = self.affine(&values, &open)?;
            if found.is_empty() {
                let negative = signs >> bits.min(31) & 1 == 1;
                found.extend(self.quadratic(&values, &open, negative)?);
                bits += 1;
            }
            if found.is_empty() {
                return Err(self.stuck(&open));
            }
            for (k, step) in found {
                let x = &mut point.symbols[self.unknowns[k].index()];
                *x = x.minus(step);
                open.remove(&k);
            }
        }
        let values = field.eval(point, signs);
        for r in &self.residuals {
            if !values.at(*r).ok_or(Unsolved::Unlucky)?.vanishes() {
                return Err(Unsolved::Singular);
            }
        }
        Ok(bits)
    }

    /// The unknowns that affine residuals determine, with the steps that lead there.
    fn affine(&self, values: &Values, open: &BTreeSet<usize>) -> Result<Vec<(usize, Element)>, Unsolved> {
        let is_affine = |row: &&BTreeMap<usize, Slope>| {
            row.iter().filter(|(k, _)| open.contains(k)).all(|(_, slope)| slope.of.is_disjoint(open))
        };
        let usable = (0..self.rows.len()).filter(|r| is_affine(&&self.rows[*r]));
        let mut found = Vec::new();
        for block in blocks(usable.map(|r| (r, self.open_in(r, open)))) {
            let mut matrix = Vec::new();
            for r in &block.rows {
                let entry = |k: &usize| match self.rows[*r].get(k) {
                    Some(slope) => values.at(slope.derivative),
                    None => Some(Element::int(0)),
                };
                let right = values.at(self.residuals[*r]);
                let row: Option<Vec<Element>> = block.columns.iter().map(entry).chain([right]).collect();
                matrix.push(row.ok_or(Unsolved::Unlucky)?);
            }
            let steps = eliminate(matrix, block.columns.len());
            found.extend(steps.into_iter().map(|(c, step)| (block.columns[c], step)));
        }
        Ok(found)
    }

    fn open_in(&self, row: usize, open: &BTreeSet<usize>) -> Vec<usize> {
        self.rows[row].keys().filter(|k| open.contains(k)).copied().collect()
    }

    /// A root of the first residual that is quadratic in its only open unknown.
    fn quadratic(
        &self,
        values: &Values,
        open: &BTreeSet<usize>,
        negative: bool,
    ) -> Result<Option<(usize, Element)>, Unsolved> {
        for (r, row) in self.rows.iter().enumerate() {
            let [k] = self.open_in(r, open)[..] else { continue };
            let Some(Slope { derivative, curvature: Some(curvature), .. }) = row.get(&k) else { continue };
            let at = |e: Expr| values.at(e).ok_or(Unsolved::Unlucky);
            // f(x - h) = f - f' h + f'' h²/2 = 0
            let (f, slope, curvature) = (at(self.residuals[r])?, at(*derivative)?, at(*curvature)?);
            let discriminant = slope.times(slope).minus(Element::int(2).times(curvature).times(f));
            let root = discriminant.sqrt().ok_or(Unsolved::Unlucky)?;
            let numerator = if negative { slope.minus(root) } else { slope.plus(root) };
            return Ok(Some((k, numerator.over(curvature).ok_or(Unsolved::Unlucky)?)));
        }
        Ok(None)
    }

    /// Whether it is curvature that keeps the unknowns from being found.
    fn stuck(&self, open: &BTreeSet<usize>) -> Unsolved {
        let slopes = self.rows.iter().flat_map(|row| row.iter());
        let curved = slopes.filter(|(k, s)| open.contains(k) && !s.of.is_disjoint(open)).map(|(k, _)| *k);
        let curved: BTreeSet<usize> = curved.collect();
        if curved.is_empty() {
            return Unsolved::Singular;
        }
        Unsolved::NotAffine(curved.into_iter().map(|k| self.unknowns[k]).collect())
    }
}

/// Equations that share unknowns.
struct Block {
    rows: Vec<usize>,
    columns: Vec<usize>,
}

/// Equations with their unknowns, sorted into blocks that have nothing to do with each other.
fn blocks(rows: impl Iterator<Item = (usize, Vec<usize>)>) -> Vec<Block> {
    let mut blocks: Vec<(Vec<usize>, BTreeSet<usize>)> = Vec::new();
    for (row, columns) in rows.filter(|(_, columns)| !columns.is_empty()) {
        let mut merged = (vec![row], BTreeSet::from_iter(columns));
        let (touched, apart): (Vec<_>, Vec<_>) = blocks.into_iter().partition(|b| !b.1.is_disjoint(&merged.1));
        for (rows, columns) in touched {
            merged.0.extend(rows);
            merged.1.extend(columns);
        }
        blocks = apart;
        blocks.push(merged);
    }
    blocks.into_iter().map(|(rows, columns)| Block { rows, columns: columns.into_iter().collect() }).collect()
}

/// The unknowns that linear equations determine. The last column is the right side.
///
/// The degrees are those of Cramer's rule, whichever equations are the independent ones: a determinant has a term from
/// each row, over the common denominator of the row.
fn eliminate(mut m: Vec<Vec<Element>>, columns: usize) -> Vec<(usize, Element)> {
    let mut sizes: Vec<u64> = m.iter().map(|row| row_degree(row)).collect();
    sizes.sort_unstable_by(|a, b| b.cmp(a));
    let size = sizes.iter().take(columns).fold(0_u64, |sum, d| sum.saturating_add(*d));
    let mut pivots: Vec<usize> = Vec::new();
    for c in 0..columns {
        let top = pivots.len();
        let Some(p) = (top..m.len()).find(|r| !m[*r][c].vanishes()) else { continue };
        m.swap(top, p);
        let Some(inverse) = m[top][c].value.inv() else { continue };
        for x in &mut m[top] {
            x.value = x.value * inverse;
        }
        let pivot = m[top].clone();
        for (r, row) in m.iter_mut().enumerate() {
            let factor = row[c].value;
            if r != top && !row[c].vanishes() {
                row.iter_mut().zip(&pivot).for_each(|(x, y)| x.value = x.value - factor * y.value);
            }
        }
        pivots.push(c);
    }
    let determined =
        pivots.iter().zip(&m).filter(|(pivot, row)| (0..columns).all(|c| c == **pivot || row[c].vanishes()));
    let degree = Degree { num: size, den: size };
    determined.map(|(c, row)| (*c, Element { value: row[columns].value, degree })).collect()
}

/// The degree of a row's entries over their common denominator.
fn row_degree(row: &[Element]) -> u64 {
    let denominators = row.iter().fold(0_u64, |sum, x| sum.saturating_add(x.degree.den));
    row.iter().map(|x| x.degree.num).max().unwrap_or(0).saturating_add(denominators)
}
