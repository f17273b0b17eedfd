//! Krawczyk's operator: a proof that a square system of equations has a solution in a box, and only one.
//!
//! For F continuously differentiable on a box X, a point c of X and any matrix Y, let
//! K = c - Y F(c) + (1 - Y F'(X)) (X - c). Every zero of F in X is in K; where K lies in the interior of X there is one, and
//! only one (Krawczyk 1969, Moore 1977; Neumaier, *Interval Methods for Systems of Equations*, 1990, section 5.1). Y is an
//! inverse of the Jacobian in doubles: how good it is decides whether the proof succeeds, never whether it is right.
//!
//! That F is continuously differentiable is seen by evaluating it and its Jacobian on the whole box: a bounded interval
//! is a proof that everything in it is defined and continuous there.

use nalgebra::DMatrix;
use rug::Float;

use crate::expr::{SymId, Tape, Workspace};
use crate::number::{Interval, Number};

/// Equations and what they are to be solved for.
pub struct Equations<'t> {
    /// What is to vanish.
    pub values: &'t Tape,
    /// The derivatives by the unknowns, row by row.
    pub jacobian: &'t Tape,
    /// As many as there are equations.
    pub unknowns: &'t [SymId],
}

/// Why there is no proof.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unproved {
    /// The Jacobian has no inverse in doubles.
    Singular,
    /// The equations or their derivatives are not surely defined around the point.
    Undefined,
    /// No box around the point is mapped into its interior.
    NotContracted,
}

/// How large the boxes are that are tried: 2^-x of the point's size, with x in eighths of the precision. A large box
/// says more of uniqueness, a small one is mapped into itself more easily.
const SHARES: [u32; 4] = [2, 4, 6, 7];

/// The most times that a box which is proved to hold the solution is narrowed.
const MOST_NARROWINGS: usize = 60;

impl Equations<'_> {
    /// The box around a point that is proved to hold exactly one solution. `at` has the values of all other symbols by
    /// their numbers, and is given the box.
    pub fn enclose(&self, at: &mut [Interval], centre: &[Float], bits: u32) -> Result<(), Unproved> {
        let mut work = Workspace::default();
        let points: Vec<Interval> = centre.iter().map(|c| Interval::new(c, c)).collect();
        self.place(at, &points);
        let inverse = self.inverse(at, bits, &mut work)?;
        let operator = Operator { equations: self, inverse, bits };
        let step = operator.step(at, &points, &mut work)?;
        let mut why = Unproved::NotContracted;
        for share in SHARES {
            let around = operator.around(&points, &step, bits * share / 8);
            match operator.image(at, &around, &mut work) {
                Ok(image) if image.iter().zip(&around).all(|(k, x)| k.is_inside(x)) => {
                    let narrowed = operator.narrowed(at, image, &mut work);
                    self.place(at, &narrowed);
                    return Ok(());
                }
                Ok(_) => why = Unproved::NotContracted,
                Err(e) => why = e,
            }
        }
        Err(why)
    }

    fn place(&self, at: &mut [Interval], values: &[Interval]) {
        for (unknown, value) in self.unknowns.iter().zip(values) {
            at[unknown.index()].set(value);
        }
    }

    /// The inverse of the Jacobian at the point, to the precision of doubles, row by row.
    fn inverse(&self, at: &[Interval], bits: u32, work: &mut Workspace<Interval>) -> Result<Vec<Interval>, Unproved> {
        let n = self.unknowns.len();
        let entries = bounded(evaluate(self.jacobian, at, bits, work))?;
        let jacobian = DMatrix::from_row_iterator(n, n, entries.iter().map(Interval::to_f64));
        let inverse = jacobian.try_inverse().filter(|y| y.iter().all(|x| x.is_finite())).ok_or(Unproved::Singular)?;
        Ok(inverse.transpose().iter().map(|x| Interval::from_f64(*x, &bits.max(53))).collect())
    }
}

/// Krawczyk's operator with a given Y. The point c is always the middle of the box: it must be in the box, or the
/// derivatives on the box say nothing of the way from c to the solution.
struct Operator<'e> {
    equations: &'e Equations<'e>,
    /// Y, row by row.
    inverse: Vec<Interval>,
    bits: u32,
}

impl Operator<'_> {
    /// Y F(c)
    fn step(
        &self,
        at: &mut [Interval],
        points: &[Interval],
        work: &mut Workspace<Interval>,
    ) -> Result<Vec<Interval>, Unproved> {
        self.equations.place(at, points);
        let residuals = bounded(evaluate(self.equations.values, at, self.bits, work))?;
        Ok(times(&self.inverse, &residuals, self.bits))
    }

    /// A box around a point: wide enough for four times the step from it, and 2^-shift of its size.
    fn around(&self, points: &[Interval], step: &[Interval], shift: u32) -> Vec<Interval> {
        let one = Interval::from_f64(1.0, &self.bits);
        let both = Interval::new(&Float::with_val(self.bits, -1), &Float::with_val(self.bits, 1));
        let unit = Float::with_val(self.bits, 1) >> shift;
        let unit = Interval::new(&unit, &unit);
        let widened = |(c, d): (&Interval, &Interval)| {
            // A symbol that is zero is as large as others are.
            let size = if c.sign() == Some(std::cmp::Ordering::Equal) { &one } else { c };
            let radius = size.times(&unit).plus(&d.times(&Interval::from_f64(4.0, &self.bits)).times(&both));
            c.plus(&radius.times(&both))
        };
        points.iter().zip(step).map(widened).collect()
    }

    /// K of a box.
    fn image(
        &self,
        at: &mut [Interval],
        around: &[Interval],
        work: &mut Workspace<Interval>,
    ) -> Result<Vec<Interval>, Unproved> {
        let n = around.len();
        let middle = |x: &Interval| {
            let c = x.midpoint();
            Interval::new(&c, &c)
        };
        let points: Vec<Interval> = around.iter().map(middle).collect();
        let step = self.step(at, &points, work)?;
        self.equations.place(at, around);
        bounded(evaluate(self.equations.values, at, self.bits, work))?;
        let jacobian = bounded(evaluate(self.equations.jacobian, at, self.bits, work))?;
        let offsets: Vec<Interval> = around.iter().zip(&points).map(|(x, c)| x.minus(c)).collect();
        let mut image: Vec<Interval> = points.iter().zip(&step).map(|(c, d)| c.minus(d)).collect();
        for (i, k) in image.iter_mut().enumerate() {
            for (j, offset) in offsets.iter().enumerate() {
                let mut defect = Interval::from_f64(if i == j { 1.0 } else { 0.0 }, &self.bits);
                for l in 0..n {
                    defect = defect.minus(&self.inverse[i * n + l].times(&jacobian[l * n + j]));
                }
                *k = k.plus(&defect.times(offset));
            }
        }
        Ok(image)
    }

    /// A box that holds the only solution, narrowed as long as that helps.
    fn narrowed(
        &self,
        at: &mut [Interval],
        mut around: Vec<Interval>,
        work: &mut Workspace<Interval>,
    ) -> Vec<Interval> {
        for _ in 0..MOST_NARROWINGS {
            let Ok(image) = self.image(at, &around, work) else { break };
            let next: Vec<Interval> = image.iter().zip(&around).map(|(k, x)| k.meet(x)).collect();
            let halved =
                |(new, old): (&Interval, &Interval)| Float::with_val(self.bits, new.width() * 2) <= old.width();
            let better = next.iter().zip(&around).any(|pair| !pair.1.is_point() && halved(pair));
            // What does not meet holds no solution: that would be a defect, and ends in an invalid interval.
            around = next;
            if !better {
                break;
            }
        }
        around
    }
}

/// A tape's outputs at the values of symbols by their numbers.
pub fn evaluate(tape: &Tape, at: &[Interval], bits: u32, work: &mut Workspace<Interval>) -> Vec<Interval> {
    let inputs: Vec<Interval> = tape.inputs().iter().map(|s| at[s.index()].clone()).collect();
    tape.eval(&inputs, &bits, work).to_vec()
}

fn bounded(values: Vec<Interval>) -> Result<Vec<Interval>, Unproved> {
    if values.iter().all(Interval::is_bounded) { Ok(values) } else { Err(Unproved::Undefined) }
}

/// The product of a square matrix, given row by row, and a vector.
fn times(matrix: &[Interval], v: &[Interval], bits: u32) -> Vec<Interval> {
    let product = |row: &[Interval]| {
        let terms = row.iter().zip(v).map(|(a, x)| a.times(x));
        terms.fold(Interval::zero(&bits), |sum, term| sum.plus(&term))
    };
    matrix.chunks(v.len().max(1)).map(product).collect()
}
