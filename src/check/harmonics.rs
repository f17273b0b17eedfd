//! Fourier series of which some terms are printed: `P_2(\sin\beta) = a + b \cos f + \dots`, with `harmonics = ['f']`.
//!
//! What the dots leave out is no smaller than what is printed, so that nothing can be said of the sum. But each printed
//! harmonic has a coefficient of its own, in which no other term has a part. So the two sides are compared by their
//! coefficients, for those harmonics in the named angles that the right side has; everything else on the left is left to
//! the dots. Angles that are not named are parameters, of which coefficients may depend.
//!
//! Which harmonics the sides have is seen, in doubles and at one state of the parameters, on a grid of n points in each
//! angle, that tells those below n/2 apart; that there are no others is tried at a point that is none of the grid's. The
//! coefficients themselves are means over a few points only, the multiples of one vector (a rank-1 lattice, I. H. Sloan and
//! S. Joe, *Lattice Methods for Multiple Integration*, 1994), so chosen that each printed harmonic is told apart from all
//! others that the sides have.

use std::collections::HashMap;

use crate::expr::{Expr, Func, Graph, SymId, Tape, Workspace};
use crate::semantics::World;

use super::claim::{Branch, Pair};

/// The points in each angle that are tried one after another.
const POINTS: [i64; 4] = [3, 5, 7, 9];
/// The most points of a grid.
const MOST_POINTS: usize = 2500;
/// The vectors that are tried for each number of points.
const MOST_VECTORS: i64 = 64;
/// How large a harmonic must be to count, and how well a sum must be met, relative to the largest.
const NOTICED: f64 = 1e-9;

/// Replaces the pairs of a claim by their Fourier coefficients.
///
/// # Errors
/// The sides are no trigonometric sums of a low degree in these angles, or the right one has no harmonics.
pub(super) fn project(world: &mut World, branches: &mut [Branch], angles: &[SymId]) -> Result<(), String> {
    for branch in branches {
        let mut coefficients = Branch::new();
        for pair in std::mem::take(branch) {
            let found = harmonics(world, &pair, angles)?;
            let lattice = Lattice::telling_apart(&found).ok_or("the harmonics of the sides are too many")?;
            let values = Values::new(world, &pair, angles, lattice);
            coefficients.extend(values.coefficients(world, &pair, angles, &found.printed));
        }
        *branch = coefficients;
    }
    Ok(())
}

/// Harmonics, as whole numbers for each angle; one of each pair k and -k.
struct Harmonics {
    /// Those of the right side.
    printed: Vec<Vec<i64>>,
    /// Those of either side.
    all: Vec<Vec<i64>>,
}

/// The harmonics of both sides.
fn harmonics(world: &World, pair: &Pair, angles: &[SymId]) -> Result<Harmonics, String> {
    let sides = Sides::new(world, pair, angles);
    for points in POINTS {
        if points.checked_pow(angles.len() as u32).is_none_or(|n| n as usize > MOST_POINTS) {
            break;
        }
        if let Some(found) = sides.harmonics(points) {
            return match found.printed.is_empty() {
                true => Err("the right side has no harmonics in these angles".into()),
                false => Ok(found),
            };
        }
    }
    Err("the sides are no trigonometric sums of a low degree in these angles, as far as the premises say".into())
}

/// Both sides as functions of the angles alone, in doubles.
struct Sides {
    tape: Tape,
    inputs: Vec<f64>,
    places: Vec<Option<usize>>,
}

impl Sides {
    fn new(world: &World, pair: &Pair, angles: &[SymId]) -> Self {
        let tape = Tape::compile(&world.graph, &[pair.lhs, pair.rhs]);
        let symbols: Vec<SymId> = tape.inputs().to_vec();
        let value = |(k, s): (usize, &SymId)| {
            let [low, high] = world.facts(*s).range.unwrap_or([0.5, 1.5]);
            low + (high - low) * (0.37 + 0.618 * k as f64).fract()
        };
        let inputs = symbols.iter().enumerate().map(value).collect();
        let places = angles.iter().map(|a| symbols.iter().position(|s| s == a)).collect();
        Sides { tape, inputs, places }
    }

    fn at(&self, angles: &[f64], work: &mut Workspace<f64>) -> [f64; 2] {
        let mut inputs = self.inputs.clone();
        for (place, angle) in self.places.iter().zip(angles) {
            if let Some(place) = place {
                inputs[*place] = *angle;
            }
        }
        let values = self.tape.eval(&inputs, &(), work);
        [values[0], values[1]]
    }

    /// The harmonics, if a grid of so many points in each angle determines both sides.
    fn harmonics(&self, points: i64) -> Option<Harmonics> {
        let mut work = Workspace::default();
        let grid = tuples(self.places.len(), 0, points - 1);
        let turn = |j: i64| std::f64::consts::TAU * j as f64 / points as f64;
        let circle: Vec<(f64, f64)> = (0..points).map(|j| turn(j).sin_cos()).collect();
        let samples = grid.iter().map(|j| self.at(&j.iter().map(|j| turn(*j)).collect::<Vec<_>>(), &mut work));
        let samples: Vec<[f64; 2]> = samples.collect();
        let elsewhere: Vec<f64> = (0..self.places.len()).map(|k| 0.7 + 1.3 * k as f64).collect();
        let (mut sum, mut largest, mut sizes) = ([0.0; 2], 0.0_f64, Vec::new());
        for harmonic in half_space(self.places.len(), points) {
            let phase: f64 = harmonic.iter().zip(&elsewhere).map(|(k, x)| *k as f64 * x).sum();
            let factor = if harmonic.iter().all(|k| *k == 0) { 1.0 } else { 2.0 } / samples.len() as f64;
            let (mut cos, mut sin) = ([0.0; 2], [0.0; 2]);
            for (j, sample) in grid.iter().zip(&samples) {
                let (s, c) = circle[dot(&harmonic, j).rem_euclid(points) as usize];
                for side in 0..2 {
                    cos[side] += factor * c * sample[side];
                    sin[side] += factor * s * sample[side];
                }
            }
            for side in 0..2 {
                sum[side] += cos[side] * phase.cos() + sin[side] * phase.sin();
                largest = largest.max(cos[side].hypot(sin[side]));
            }
            sizes.push((harmonic, [0, 1].map(|side| cos[side].hypot(sin[side]))));
        }
        let there = self.at(&elsewhere, &mut work);
        let met = (0..2).all(|side| (sum[side] - there[side]).abs() <= NOTICED * largest);
        let above = |least: &dyn Fn(&[f64; 2]) -> f64| {
            let noticed = sizes.iter().filter(|(_, size)| least(size) > NOTICED * largest);
            noticed.map(|(k, _)| k.clone()).collect()
        };
        met.then(|| Harmonics { printed: above(&|size| size[1]), all: above(&|size| size[0].max(size[1])) })
    }
}

/// The multiples of a vector of whole numbers, each a point: so many parts of a whole turn in each angle.
struct Lattice {
    points: i64,
    vector: Vec<i64>,
}

impl Lattice {
    /// The lattice of the fewest points found that tells the printed harmonics apart from all others.
    fn telling_apart(harmonics: &Harmonics) -> Option<Self> {
        let length = harmonics.printed.first()?.len();
        let apart = |lattice: &Lattice| {
            let seen = |k: &[i64]| dot(k, &lattice.vector).rem_euclid(lattice.points);
            harmonics.printed.iter().all(|printed| {
                let minus: Vec<i64> = printed.iter().map(|k| -k).collect();
                let constant = *printed == minus;
                (constant || seen(printed) != seen(&minus))
                    && harmonics.all.iter().filter(|k| *k != printed).all(|k| {
                        let own = seen(k);
                        own != seen(printed) && own != seen(&minus)
                    })
            })
        };
        for points in 2..=MOST_POINTS as i64 {
            for step in 1..points.min(MOST_VECTORS) {
                // Korobov's vectors: 1, a, a², ..
                let powers = std::iter::successors(Some(1), |p| Some(p * step % points));
                let lattice = Lattice { points, vector: powers.take(length).collect() };
                if apart(&lattice) {
                    return Some(lattice);
                }
            }
        }
        None
    }
}

/// Both sides at the points of a lattice, as expressions in all that is no angle.
struct Values {
    lattice: Lattice,
    sides: Vec<(Expr, Expr)>,
}

impl Values {
    fn new(world: &mut World, pair: &Pair, angles: &[SymId], lattice: Lattice) -> Self {
        let graph = &mut world.graph;
        let mut sides = Vec::new();
        for j in 0..lattice.points {
            if graph.cut_short().is_some() {
                break;
            }
            let at = |k: &i64| turn(graph, (j * k).rem_euclid(lattice.points), lattice.points);
            let angle: Vec<Expr> = lattice.vector.iter().map(at).collect();
            let map: HashMap<SymId, Expr> = angles.iter().copied().zip(angle).collect();
            sides.push((graph.substitute(pair.lhs, &map), graph.substitute(pair.rhs, &map)));
        }
        Values { lattice, sides }
    }

    fn coefficients(&self, world: &mut World, pair: &Pair, angles: &[SymId], harmonics: &[Vec<i64>]) -> Branch {
        let mut branch = Branch::new();
        for harmonic in harmonics {
            let constant = harmonic.iter().all(|k| *k == 0);
            let functions = if constant { &[Func::Cos][..] } else { &[Func::Cos, Func::Sin] };
            for function in functions {
                let (lhs, rhs) = self.coefficient(&mut world.graph, harmonic, *function);
                let phase = phase_latex(world, angles, harmonic);
                let own = match (constant, function) {
                    (true, _) => "mean".to_owned(),
                    (_, Func::Sin) => format!("coefficient of \\sin({phase})"),
                    _ => format!("coefficient of \\cos({phase})"),
                };
                let name = pair.name.iter().cloned().chain([own]).collect::<Vec<_>>().join(", ");
                let residual = world.graph.sub(lhs, rhs);
                branch.push(Pair { name: Some(name), lhs, rhs, residual, start: pair.start });
            }
        }
        branch
    }

    fn coefficient(&self, graph: &mut Graph, harmonic: &[i64], function: Func) -> (Expr, Expr) {
        let double = harmonic.iter().any(|k| *k != 0);
        let factor = graph.ratio(if double { 2 } else { 1 }, self.sides.len().max(1) as i128);
        let (mut left, mut right) = (graph.int(0), graph.int(0));
        let step = dot(harmonic, &self.lattice.vector);
        for (j, (lhs, rhs)) in (0..).zip(&self.sides) {
            let angle = turn(graph, (step * j).rem_euclid(self.lattice.points), self.lattice.points);
            let value = graph.call(function, angle);
            let weight = graph.mul(factor, value);
            let (l, r) = (graph.mul(weight, *lhs), graph.mul(weight, *rhs));
            (left, right) = (graph.add(left, l), graph.add(right, r));
        }
        (left, right)
    }
}

/// The angle of j of so many parts of a whole turn.
fn turn(graph: &mut Graph, j: i64, points: i64) -> Expr {
    let (part, pi) = (graph.ratio(2 * i128::from(j), i128::from(points)), graph.pi());
    graph.mul(part, pi)
}

fn dot(a: &[i64], b: &[i64]) -> i64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// All tuples of whole numbers between two bounds.
fn tuples(length: usize, from: i64, to: i64) -> Vec<Vec<i64>> {
    (0..length).fold(vec![Vec::new()], |all, _| {
        all.iter().flat_map(|t: &Vec<i64>| (from..=to).map(move |v| t.iter().copied().chain([v]).collect())).collect()
    })
}

/// The harmonics that so many points in each angle tell apart, one of each pair k and -k.
fn half_space(length: usize, points: i64) -> Vec<Vec<i64>> {
    let highest = (points - 1) / 2;
    let all = tuples(length, -highest, highest);
    all.into_iter().filter(|k| k.iter().find(|k| **k != 0).is_none_or(|first| *first > 0)).collect()
}

fn phase_latex(world: &World, angles: &[SymId], harmonic: &[i64]) -> String {
    let mut text = String::new();
    for (angle, k) in angles.iter().zip(harmonic).filter(|(_, k)| **k != 0) {
        let sign = match (*k < 0, text.is_empty()) {
            (true, _) => " - ",
            (false, true) => "",
            (false, false) => " + ",
        };
        let factor = if k.abs() == 1 { String::new() } else { k.abs().to_string() };
        text += &format!("{sign}{factor}{}", world.tex(*angle));
    }
    text.trim_start().to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lattice_tells_harmonics_apart() {
        let all = half_space(3, 5);
        let printed = vec![vec![0, 0, 0], vec![1, 0, -2], vec![0, 2, 1]];
        let Lattice { points, vector } =
            Lattice::telling_apart(&Harmonics { printed: printed.clone(), all: all.clone() }).unwrap();
        let mean = |k: &[i64], l: &[i64]| -> f64 {
            let turn = |h: &[i64], j: i64| std::f64::consts::TAU * (dot(h, &vector) * j) as f64 / points as f64;
            (0..points).map(|j| turn(k, j).cos() * turn(l, j).cos()).sum::<f64>() / points as f64
        };
        for k in &printed {
            for l in all.iter().filter(|l| *l != k) {
                assert!(mean(k, l).abs() < 1e-12, "{k:?} {l:?}");
            }
            assert!(mean(k, k) > 0.49, "{k:?}");
        }
        assert!(points < 125, "{points}");
    }

    #[test]
    fn half_of_the_harmonics() {
        let found = half_space(2, 3);
        assert_eq!(found, vec![vec![0, 0], vec![0, 1], vec![1, -1], vec![1, 0], vec![1, 1]]);
        assert_eq!(half_space(1, 5), vec![vec![0], vec![1], vec![2]]);
    }
}
