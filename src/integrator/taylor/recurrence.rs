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
    /// A series over a constant one.
    Over(Slot, Slot),
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
    /// 1/k, with 0 for k = 0: a product is cheaper than a quotient, and a rounding more is little beside those of the sums.
    pub inverses: Vec<N>,
    sum: N,
    other: N,
}

impl<N: Number> Desk<N> {
    pub fn new(order: usize, cx: &N::Context) -> Self {
        let zero = N::zero(cx);
        let integers = (0..=order).map(|k| N::from_f64(k as f64, cx)).collect();
        let inverse = |k: usize| if k == 0 { zero.clone() } else { N::from_ratio(1, k as i128, cx) };
        let inverses = (0..=order).map(inverse).collect();
        Desk { integers, inverses, sum: zero.clone(), other: zero }
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
        Op::Div(a, b) | Op::Over(a, b) => to[0].set_div(at(a), at(b)),
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

/// Coefficient k > 0 of the series in a slot. What has none but the first ones is left as it is.
#[inline(always)]
pub(super) fn extend<N: Number>(op: Op, known: &[N], to: &mut [N], stride: usize, k: usize, desk: &mut Desk<N>) {
    let series = |slot: Slot| &known[slot * stride..][..stride];
    let at = |slot: Slot| &known[slot * stride + k];
    let (to, next) = to.split_at_mut(stride);
    let Desk { integers, inverses, sum, other } = desk;
    match op {
        Op::State(_) | Op::Constant(_) | Op::One | Op::Sign(_) => {}
        Op::Time => to[k].set(&integers[usize::from(k == 1)]),
        Op::Neg(a) => to[k].set_neg(at(a)),
        Op::Add(a, b) => to[k].set_add(at(a), at(b)),
        Op::Sub(a, b) => to[k].set_sub(at(a), at(b)),
        Op::Over(a, c) => to[k].set_div(at(a), &series(c)[0]),
        Op::Scale(c, a) => to[k].set_mul(&series(c)[0], at(a)),
        Op::Weighted(a) => to[k].set_mul(&integers[k], at(a)),
        Op::Mul(a, b) => to[k].set_convolution(&series(a)[..=k], &series(b)[..=k]),
        Op::Square(a) => {
            half_square(series(a), 0, k, sum, other);
            to[k].set_add(sum, other);
        }
        Op::Div(a, b) => {
            sum.set_convolution(&to[..k], &series(b)[1..=k]);
            other.set_sub(at(a), sum);
            to[k].set_div(other, &series(b)[0]);
        }
        Op::Sqrt(a) => {
            // a = r²: 2 r₀ rₖ is aₖ less the products of those between.
            let mut square = sum.clone();
            half_square(to, 1, k, sum, other);
            square.set_add(sum, other);
            sum.set_sub(at(a), &square);
            other.set_add(&to[0], &to[0]);
            to[k].set_div(sum, other);
        }
        Op::Exp(_, w) => {
            sum.set_convolution(&series(w)[1..=k], &to[..k]);
            to[k].set_mul(sum, &inverses[k]);
        }
        Op::SinCos(_, w) => {
            sum.set_convolution(&series(w)[1..=k], &next[..k]);
            other.set_convolution(&series(w)[1..=k], &to[..k]);
            to[k].set_mul(sum, &inverses[k]);
            sum.set_neg(other);
            next[k].set_mul(sum, &inverses[k]);
        }
        Op::SinhCosh(_, w) => {
            sum.set_convolution(&series(w)[1..=k], &next[..k]);
            other.set_convolution(&series(w)[1..=k], &to[..k]);
            to[k].set_mul(sum, &inverses[k]);
            next[k].set_mul(other, &inverses[k]);
        }
        Op::Pow(a, w, r) => {
            // a p' = r a' p.
            other.set_convolution(&series(w)[1..=k], &to[..k]);
            sum.set_mul(other, &series(r)[0]);
            other.set_convolution(&next[1..k], &series(a)[1..k]);
            let term = sum.minus(other);
            next[k].set_div(&term, &series(a)[0]);
            to[k].set_mul(&next[k], &inverses[k]);
        }
        Op::Integral(_, [_, w, g]) => {
            sum.set_convolution(&series(w)[1..=k], &series(g)[..k]);
            to[k].set_mul(sum, &inverses[k]);
        }
        Op::Angle([_, _, wy, wx, gx, gy]) => {
            sum.set_convolution(&series(wy)[1..=k], &series(gx)[..k]);
            other.set_convolution(&series(wx)[1..=k], &series(gy)[..k]);
            let term = sum.minus(other);
            to[k].set_mul(&term, &inverses[k]);
        }
        Op::Abs(a) => {
            other.set_call(Func::Sign, &series(a)[0]);
            to[k].set_mul(other, at(a));
        }
    }
}

/// Σ aᵢ aₖ₋ᵢ for i from `first` to k - `first` is `double` and `middle` together: every product but the middle one comes twice.
#[inline(always)]
fn half_square<N: Number>(a: &[N], first: usize, k: usize, double: &mut N, middle: &mut N) {
    let below = k.div_ceil(2).max(first);
    middle.set_convolution(&a[first..below], &a[k + 1 - below..=k - first]);
    double.set_add(middle, middle);
    if k.is_multiple_of(2) && k / 2 >= first {
        middle.set_mul(&a[k / 2], &a[k / 2]);
    } else {
        middle.set_convolution(&[], &[]);
    }
}
