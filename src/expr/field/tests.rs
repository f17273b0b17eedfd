//! Identities that hold and near misses in the field, and the soundness of the degrees.

use super::*;
use num_traits::{One, Zero};
use proptest::prelude::*;

/// A source of random bits with a fixed seed.
fn bits(seed: u64) -> impl FnMut() -> u64 {
    let mut state = seed;
    move || {
        state = state.wrapping_mul(0x5851_f42d_4c95_7f2d).wrapping_add(0x1405_7b7e_f767_814f);
        let x = (state ^ (state >> 32)).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        x ^ (x >> 29)
    }
}

/// Whether an expression vanishes with all signs at a point where it is defined; none where no point is found.
fn vanishes(g: &Graph, e: Expr) -> Option<bool> {
    let field = Field::new(g, &[e]);
    let mut random = bits(7);
    let all = 1_u32 << field.roots();
    (0..200).find_map(|_| {
        let point = field.draw(&mut random);
        let values: Option<Vec<Element>> = (0..all).map(|signs| field.eval(&point, signs).at(e)).collect();
        Some(values?.into_iter().all(Element::vanishes))
    })
}

struct Bench {
    g: Graph,
    a: Expr,
    b: Expr,
}

fn angles() -> Bench {
    let mut g = Graph::new();
    let (a, b) = (g.symbol("a"), g.symbol("b"));
    let (a, b) = (g.sym(a), g.sym(b));
    Bench { g, a, b }
}

impl Bench {
    fn sin(&mut self, e: Expr) -> Expr {
        self.g.call(Func::Sin, e)
    }
    fn cos(&mut self, e: Expr) -> Expr {
        self.g.call(Func::Cos, e)
    }
    fn times(&mut self, n: i128, d: i128, e: Expr) -> Expr {
        let n = self.g.ratio(n, d);
        self.g.mul(n, e)
    }
    fn equal(&mut self, x: Expr, y: Expr) -> bool {
        let difference = self.g.sub(x, y);
        vanishes(&self.g, difference).unwrap()
    }
}

#[test]
fn pythagoras() {
    let mut w = angles();
    let (s, c) = (w.sin(w.a), w.cos(w.a));
    let (ss, cc) = (w.g.powi(s, 2), w.g.powi(c, 2));
    let (sum, difference) = (w.g.add(ss, cc), w.g.sub(ss, cc));
    let one = w.g.int(1);
    assert!(w.equal(sum, one));
    assert!(!w.equal(difference, one));
}

#[test]
fn multiples_and_fractions_of_an_angle() {
    let mut w = angles();
    let triple = w.times(3, 1, w.a);
    let sin3 = w.sin(triple);
    let s = w.sin(w.a);
    let cube = w.g.powi(s, 3);
    for (factor, holds) in [(4, true), (3, false), (-4, false)] {
        let (first, last) = (w.times(3, 1, s), w.times(factor, 1, cube));
        let polynomial = w.g.sub(first, last);
        assert_eq!(w.equal(sin3, polynomial), holds, "3 sin a - {factor} sin³ a");
    }
    // sin(2a/3) = 2 sin(a/3) cos(a/3)
    let (third, two_thirds) = (w.times(1, 3, w.a), w.times(2, 3, w.a));
    let (s, c, left) = (w.sin(third), w.cos(third), w.sin(two_thirds));
    let product = w.g.mul(s, c);
    let doubled = w.times(2, 1, product);
    assert!(w.equal(left, doubled));
    assert!(!w.equal(left, product));
}

#[test]
fn sums_of_angles_however_they_are_written() {
    let mut w = angles();
    let two = w.g.int(2);
    let sum = w.g.add(w.a, w.b);
    let mean = w.g.div(sum, two);
    let difference = w.g.sub(w.a, w.b);
    let half_difference = w.times(1, 2, difference);
    // sin a + sin b = 2 sin((a+b)/2) cos((a-b)/2)
    let (sa, sb) = (w.sin(w.a), w.sin(w.b));
    let left = w.g.add(sa, sb);
    let (s, c) = (w.sin(mean), w.cos(half_difference));
    let product = w.g.mul(s, c);
    let right = w.times(2, 1, product);
    assert!(w.equal(left, right));
    let left = w.g.sub(sa, sb);
    assert!(!w.equal(left, right));
    // (ab + a) t and a t + a b t
    let t = w.g.symbol("t");
    let t = w.g.sym(t);
    let ab = w.g.mul(w.a, w.b);
    let (left, one) = (w.g.add(ab, w.a), w.g.mul(w.a, t));
    let (left, other) = (w.g.mul(left, t), w.g.mul(ab, t));
    let right = w.g.add(one, other);
    let (left, right) = (w.sin(left), w.sin(right));
    assert!(w.equal(left, right));
}

#[test]
fn quarter_turns_are_exact_and_other_fractions_of_pi_are_atoms() {
    let mut w = angles();
    let pi = w.g.pi();
    let (half, third) = (w.times(1, 2, pi), w.times(1, 3, pi));
    let (quarter_on, half_back) = (w.g.add(w.a, half), w.g.sub(w.a, pi));
    let (s, c) = (w.sin(w.a), w.cos(w.a));
    let (minus_s, moved) = (w.g.neg(s), w.cos(quarter_on));
    assert!(w.equal(moved, minus_s));
    assert!(!w.equal(moved, s));
    let moved = w.sin(half_back);
    assert!(w.equal(moved, minus_s));
    let moved = w.sin(quarter_on);
    assert!(w.equal(moved, c));
    // sin²(a + π/3) + cos²(a + π/3) = 1 holds; cos(π/3) = 1/2 is not seen, and the field says that it might be so.
    let third_on = w.g.add(w.a, third);
    let (s, c) = (w.sin(third_on), w.cos(third_on));
    let (ss, cc, one) = (w.g.powi(s, 2), w.g.powi(c, 2), w.g.int(1));
    let sum = w.g.add(ss, cc);
    assert!(w.equal(sum, one));
    assert!(!Field::new(&w.g, &[sum]).meaningless().is_empty());
}

#[test]
fn a_symbol_is_independent_of_its_sine() {
    let mut w = angles();
    let s = w.sin(w.a);
    assert!(!w.equal(s, w.a));
    let (product, square) = (w.g.mul(w.a, s), w.g.powi(w.a, 2));
    let (left, right) = (w.g.mul(product, w.a), w.g.mul(square, s));
    assert!(w.equal(left, right));
}

#[test]
fn roots_hold_with_every_sign_or_not_at_all() {
    let mut w = angles();
    let (ra, rb) = (w.g.sqrt(w.a), w.g.sqrt(w.b));
    let (sum, difference) = (w.g.add(ra, rb), w.g.sub(ra, rb));
    let (product, right) = (w.g.mul(sum, difference), w.g.sub(w.a, w.b));
    assert!(w.equal(product, right));
    let wrong = w.g.add(w.a, w.b);
    assert!(!w.equal(product, wrong));
    // √a² = a is no identity: it holds with one sign only.
    let square = w.g.powi(w.a, 2);
    let root = w.g.sqrt(square);
    assert!(!w.equal(root, w.a));
    // √(a+√b) √(a-√b) squared is a² - b.
    let (up, down) = (w.g.add(w.a, rb), w.g.sub(w.a, rb));
    let (up, down) = (w.g.sqrt(up), w.g.sqrt(down));
    let product = w.g.mul(up, down);
    let (left, right) = (w.g.powi(product, 2), w.g.sub(square, w.b));
    assert!(w.equal(left, right));
}

#[test]
fn constants_are_not_taken_for_their_roots_in_the_field() {
    let mut w = angles();
    let two = w.g.int(2);
    let (root, residue) = (w.g.sqrt(two), w.g.int(1 << 31));
    assert!(!w.equal(root, residue), "2^62 = 2 in the field");
}

#[test]
fn what_has_no_meaning_is_named() {
    let mut w = angles();
    let exp = w.g.call(Func::Exp, w.a);
    let (product, right) = (w.g.mul(exp, w.b), w.g.mul(w.b, exp));
    assert!(w.equal(product, right));
    assert!(!w.equal(product, w.b));
    assert_eq!(Field::new(&w.g, &[product]).meaningless(), ["exp"]);
    let angle = w.g.atan2(w.a, w.b);
    let sin = w.sin(angle);
    assert!(!Field::new(&w.g, &[sin]).meaningless().is_empty());
    assert!(Field::new(&w.g, &[w.a]).meaningless().is_empty());
}

#[test]
fn nothing_is_found_where_nothing_is_defined() {
    let mut w = angles();
    let (s, c, one) = (w.sin(w.a), w.cos(w.a), w.g.int(1));
    let (ss, cc) = (w.g.powi(s, 2), w.g.powi(c, 2));
    let sum = w.g.add(ss, cc);
    let zero = w.g.sub(sum, one);
    let quotient = w.g.div(w.b, zero);
    assert_eq!(vanishes(&w.g, quotient), None);
}

#[test]
fn a_deep_expression_overflows_nothing() {
    let mut w = angles();
    let mut e = w.a;
    for _ in 0..20_000 {
        let square = w.g.mul(e, e);
        let quotient = w.g.div(square, w.b);
        e = w.g.add(quotient, w.a);
    }
    let sine = w.sin(e);
    let field = Field::new(&w.g, &[e, sine]);
    let value = field.eval(&field.draw(&mut bits(1)), 0).at(e).unwrap();
    assert_eq!(value.degree.num, u64::MAX);
}

/// A recipe for one node: which operation, on which earlier nodes.
type Step = (u8, u8, u8, i8);

const SYMBOLS: [&str; 3] = ["x", "y", "z"];

fn build(g: &mut Graph, steps: &[Step], trigonometric: bool) -> Expr {
    let mut pool: Vec<Expr> = SYMBOLS.map(|name| g.symbol(name)).map(|s| g.sym(s)).into();
    pool.push(g.ratio(2, 3));
    for &(operation, i, j, n) in steps {
        let (a, b) = (pool[i as usize % pool.len()], pool[j as usize % pool.len()]);
        let node = match operation % 6 {
            0 => g.add(a, b),
            1 => g.sub(a, b),
            2 => g.mul(a, b),
            3 if !trigonometric => g.div(a, b),
            4 if !trigonometric => g.powi(a, i32::from(n % 4)),
            _ => {
                let (one, other) = (pool[i as usize % 3], pool[j as usize % 3]);
                let n = g.ratio(i128::from(n % 3), 2);
                let multiple = g.mul(n, other);
                let argument = g.add(one, multiple);
                match trigonometric {
                    true => g.call(if n == one { Func::Sin } else { Func::Cos }, argument),
                    false => argument,
                }
            }
        };
        pool.push(node);
    }
    pool[pool.len() - 1]
}

fn steps() -> impl Strategy<Value = Vec<Step>> {
    prop::collection::vec(any::<Step>(), 1..8)
}

/// The point number n on a line through the space of all that is drawn, and what was drawn.
fn on_line(field: &Field, n: u64) -> (Point, Vec<F61>) {
    let (mut from, mut along) = (bits(3), bits(4));
    let mut drawn = Vec::new();
    let point = field.draw(&mut || {
        let x = F61::new(from()) + F61::new(along()) * F61::new(n);
        drawn.push(x);
        x.residue() << 3
    });
    (point, drawn)
}

fn rank(mut m: Vec<Vec<F61>>) -> usize {
    let columns = m.first().map_or(0, Vec::len);
    let mut rank = 0;
    for c in 0..columns {
        let Some(p) = (rank..m.len()).find(|r| !m[*r][c].is_zero()) else { continue };
        m.swap(rank, p);
        let (inverse, pivot) = (m[rank][c].inv().unwrap(), m[rank].clone());
        for row in m.iter_mut().skip(rank + 1) {
            let factor = row[c] * inverse;
            row.iter_mut().zip(&pivot).for_each(|(x, y)| *x = *x - factor * *y);
        }
        rank += 1;
    }
    rank
}

/// 1, x, ..., xᵈ times a factor.
fn powers(x: F61, d: u64, factor: F61) -> Vec<F61> {
    std::iter::successors(Some(factor), |p| Some(*p * x)).take(d as usize + 1).collect()
}

proptest! {
    #![proptest_config(crate::testing::properties(200))]

    /// On a line, f = P/Q with P and Q of the degrees that were promised: P - f Q = 0 has a solution, although there
    /// are more points than coefficients.
    #[test]
    fn rational_functions_have_the_degrees_promised(steps in steps()) {
        let mut g = Graph::new();
        let e = build(&mut g, &steps, false);
        let field = Field::new(&g, &[e]);
        let Some(f) = field.eval(&on_line(&field, 1).0, 0).at(e) else { return Ok(()) };
        let Degree { num, den } = f.degree;
        prop_assume!(num + den < 80);
        let mut matrix = Vec::new();
        for n in 1..num + den + 8 {
            let Some(f) = field.eval(&on_line(&field, n).0, 0).at(e) else { continue };
            prop_assert_eq!(f.degree, Degree { num, den });
            let x = F61::new(n);
            matrix.push([powers(x, num, F61::one()), powers(x, den, -f.value)].concat());
        }
        prop_assert!(rank(matrix) < (num + den + 2) as usize);
    }

    /// On a line through the tangents of the half angles, a polynomial in sines and cosines times a power of each 1 + t²
    /// is a polynomial of the total degree (one more for each angle, as half an odd degree is rounded up).
    #[test]
    fn trigonometric_polynomials_have_the_degrees_promised(steps in steps()) {
        let mut g = Graph::new();
        let e = build(&mut g, &steps, true);
        let field = Field::new(&g, &[e]);
        let degree = field.eval(&on_line(&field, 1).0, 0).at(e).unwrap().degree;
        let atoms = field.angles.atoms;
        let total = field.total_degree(degree) + atoms as u64;
        prop_assume!(total < 80);
        let mut matrix = Vec::new();
        for n in 1..total + 8 {
            let (point, drawn) = on_line(&field, n);
            let tangents = &drawn[drawn.len() - atoms..];
            let scale = tangents.iter().fold(F61::one(), |p, t| {
                p * (F61::one() + *t * *t).powi(degree.num.div_ceil(2) as i32).unwrap()
            });
            let f = field.eval(&point, 0).at(e).unwrap().value;
            matrix.push([powers(F61::new(n), total, F61::one()), vec![-f * scale]].concat());
        }
        prop_assert!(rank(matrix) < (total + 2) as usize);
    }
}
