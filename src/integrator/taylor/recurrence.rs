//! The recurrences of Taylor coefficients: coefficient k of an operation's result from those of its operands up to k.
//!
//! They are those of Griewank and Walther, *Evaluating Derivatives* (2nd ed. 2008), table 13.2, with k aₖ kept where it is
//! wanted more than once.

use crate::number::{Func, Number};

/// The place of a series among all of a system.
pub(super) type Slot = usize;

/// How the coefficients of a series come from those of others that stand before it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Op {
    /// A component of the state: given at k = 0, later had from the rates.
    State(usize),
    /// The time.
    Time,
    /// A number: the output of this index of the tape of constants.
    Constant(usize),
    /// The number 1.
    One,
    Neg(Slot),
    Add(Slot, Slot),
    Sub(Slot, Slot),
    Mul(Slot, Slot),
    Square(Slot),
    /// A constant series times another.
    Scale(Slot, Slot),
    Div(Slot, Slot),
    Sqrt(Slot),
    /// k aₖ.
    Weighted(Slot),
    /// eᵃ from a and its weighted series.
    Exp(Slot, Slot),
    /// sin a into this slot, cos a into the next, from a and its weighted series.
    SinCos(Slot, Slot),
    /// sinh a into this slot, cosh a into the next.
    SinhCosh(Slot, Slot),
    /// aʳ for a constant r into this slot, its weighted series into the next; from a, its weighted series and r.
    Pow(Slot, Slot, Slot),
    /// f(a), where f' = g(a): from a, its weighted series and g.
    Integral(Func, [Slot; 3]),
    /// The angle of (x, y), from y, x, their weighted series, and x, y over x² + y².
    Angle([Slot; 6]),
    /// |a|.
    Abs(Slot),
    /// The sign of a.
    Sign(Slot),
}

impl Op {
    /// The series that it fills.
    pub fn width(self) -> usize {
        match self {
            Op::SinCos(..) | Op::SinhCosh(..) | Op::Pow(..) => 2,
            _ => 1,
        }
    }
}

/// What a computation of coefficients works with beside them.
#[derive(Clone, Debug)]
pub(super) struct Desk<N> {
    /// 0, 1, 2, ...
    pub integers: Vec<N>,
    sum: N,
    term: N,
    next: N,
}

impl<N: Number> Desk<N> {
    pub fn new(order: usize, cx: &N::Context) -> Self {
        let zero = N::zero(cx);
        let integers = (0..=order).map(|k| N::from_f64(k as f64, cx)).collect();
        Desk { integers, sum: zero.clone(), term: zero.clone(), next: zero }
    }

    fn clear(&mut self) {
        self.sum.set(&self.integers[0]);
    }

    /// Adds Σ aᵢ bₙ₋ᵢ over the range of i to the sum.
    #[inline(always)]
    fn add(&mut self, a: &[N], b: &[N], n: usize, range: std::ops::Range<usize>) {
        for (a, b) in a[range.clone()].iter().zip(b[n + 1 - range.end..=n - range.start].iter().rev()) {
            self.term.set_mul(a, b);
            self.next.set_add(&self.sum, &self.term);
            std::mem::swap(&mut self.sum, &mut self.next);
        }
    }

    /// The same, taken off.
    #[inline(always)]
    fn take(&mut self, a: &[N], b: &[N], n: usize, range: std::ops::Range<usize>) {
        for (a, b) in a[range.clone()].iter().zip(b[n + 1 - range.end..=n - range.start].iter().rev()) {
            self.term.set_mul(a, b);
            self.next.set_sub(&self.sum, &self.term);
            std::mem::swap(&mut self.sum, &mut self.next);
        }
    }

    fn double(&mut self) {
        self.next.set_add(&self.sum, &self.sum);
        std::mem::swap(&mut self.sum, &mut self.next);
    }
}

/// Coefficient 0 of the series in a slot; `known` are the series before it, one after another, each of `stride`.
pub(super) fn begin<N: Number>(op: Op, known: &[N], to: &mut [N], stride: usize, constants: &[N], one: &N) {
    let at = |slot: Slot| &known[slot * stride];
    let (to, next) = to.split_at_mut(stride);
    match op {
        Op::State(_) | Op::Time => {}
        Op::Constant(k) => to[0].set(&constants[k]),
        Op::One => to[0].set(one),
        Op::Neg(a) => to[0].set_neg(at(a)),
        Op::Add(a, b) => to[0].set_add(at(a), at(b)),
        Op::Sub(a, b) => to[0].set_sub(at(a), at(b)),
        Op::Mul(a, b) | Op::Scale(a, b) => to[0].set_mul(at(a), at(b)),
        Op::Square(a) => to[0].set_mul(at(a), at(a)),
        Op::Div(a, b) => to[0].set_div(at(a), at(b)),
        Op::Sqrt(a) => to[0].set_sqrt(at(a)),
        Op::Weighted(a) => to[0] = at(a).like(0.0),
        Op::Exp(a, _) => to[0].set_call(Func::Exp, at(a)),
        Op::SinCos(a, _) => N::set_sin_cos(&mut to[0], &mut next[0], at(a)),
        Op::SinhCosh(a, _) => {
            to[0].set_call(Func::Sinh, at(a));
            next[0].set_call(Func::Cosh, at(a));
        }
        Op::Pow(a, _, r) => {
            to[0].set_pow(at(a), at(r));
            next[0] = at(a).like(0.0);
        }
        Op::Integral(f, [a, ..]) => to[0].set_call(f, at(a)),
        Op::Angle([y, x, ..]) => to[0].set_atan2(at(y), at(x)),
        Op::Abs(a) => to[0].set_call(Func::Abs, at(a)),
        Op::Sign(a) => to[0].set_call(Func::Sign, at(a)),
    }
}

/// Coefficient k > 0 of the series in a slot.
#[inline(always)]
pub(super) fn extend<N: Number>(op: Op, known: &[N], to: &mut [N], stride: usize, k: usize, desk: &mut Desk<N>) {
    let series = |slot: Slot| &known[slot * stride..(slot + 1) * stride];
    let at = |slot: Slot| &known[slot * stride + k];
    let (to, next) = to.split_at_mut(stride);
    match op {
        Op::State(_) => {}
        Op::Time => to[k].set(&desk.integers[usize::from(k == 1)]),
        Op::Constant(_) | Op::One | Op::Sign(_) => to[k].set(&desk.integers[0]),
        Op::Neg(a) => to[k].set_neg(at(a)),
        Op::Add(a, b) => to[k].set_add(at(a), at(b)),
        Op::Sub(a, b) => to[k].set_sub(at(a), at(b)),
        Op::Scale(c, a) => to[k].set_mul(&series(c)[0], at(a)),
        Op::Weighted(a) => to[k].set_mul(&desk.integers[k], at(a)),
        Op::Mul(a, b) => {
            desk.clear();
            desk.add(series(a), series(b), k, 0..k + 1);
            to[k].set(&desk.sum);
        }
        Op::Square(a) => square(series(a), &mut to[k], k, desk),
        Op::Div(a, b) => {
            desk.sum.set(at(a));
            desk.take(to, series(b), k, 0..k);
            to[k].set_div(&desk.sum, &series(b)[0]);
        }
        Op::Sqrt(a) => {
            desk.sum.set(at(a));
            desk.take(to, to, k, 1..k);
            desk.next.set_add(&to[0], &to[0]);
            to[k].set_div(&desk.sum, &desk.next);
        }
        Op::Exp(_, w) => {
            desk.clear();
            desk.add(series(w), to, k, 1..k + 1);
            to[k].set_div(&desk.sum, &desk.integers[k]);
        }
        Op::SinCos(_, w) | Op::SinhCosh(_, w) => {
            desk.clear();
            desk.add(series(w), next, k, 1..k + 1);
            to[k].set_div(&desk.sum, &desk.integers[k]);
            desk.clear();
            let fall = if matches!(op, Op::SinCos(..)) { Desk::take } else { Desk::add };
            fall(desk, series(w), to, k, 1..k + 1);
            next[k].set_div(&desk.sum, &desk.integers[k]);
        }
        Op::Pow(a, w, r) => {
            desk.clear();
            desk.add(series(w), to, k, 1..k + 1);
            desk.next.set_mul(&desk.sum, &series(r)[0]);
            std::mem::swap(&mut desk.sum, &mut desk.next);
            desk.take(next, series(a), k, 1..k);
            next[k].set_div(&desk.sum, &series(a)[0]);
            to[k].set_div(&next[k], &desk.integers[k]);
        }
        Op::Integral(_, [_, w, g]) => {
            desk.clear();
            desk.add(series(w), series(g), k, 1..k + 1);
            to[k].set_div(&desk.sum, &desk.integers[k]);
        }
        Op::Angle([_, _, wy, wx, gx, gy]) => {
            desk.clear();
            desk.add(series(wy), series(gx), k, 1..k + 1);
            desk.take(series(wx), series(gy), k, 1..k + 1);
            to[k].set_div(&desk.sum, &desk.integers[k]);
        }
        Op::Abs(a) => {
            desk.next.set_call(Func::Sign, &series(a)[0]);
            to[k].set_mul(&desk.next, at(a));
        }
    }
}

/// Every product but the middle one comes twice.
fn square<N: Number>(a: &[N], to: &mut N, k: usize, desk: &mut Desk<N>) {
    desk.clear();
    desk.add(a, a, k, 0..k.div_ceil(2));
    desk.double();
    if k.is_multiple_of(2) {
        desk.term.set_mul(&a[k / 2], &a[k / 2]);
        to.set_add(&desk.sum, &desk.term);
    } else {
        to.set(&desk.sum);
    }
}
