//! The number types that motions are computed in, and values in any of them.

#[cfg(feature = "rug")]
use crate::number::Mpfr;
use crate::number::{Df64, Number};
#[cfg(feature = "rug")]
use rug::Float;

/// A number type, chosen at run time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Arithmetic {
    /// f64.
    Machine,
    /// Double-double, some 31 digits.
    Double,
    /// So many bits.
    #[cfg(feature = "rug")]
    Bits(u32),
}

impl Arithmetic {
    /// The name in plain text.
    pub fn name(self) -> String {
        match self {
            Arithmetic::Machine => "f64".into(),
            Arithmetic::Double => "double-double".into(),
            #[cfg(feature = "rug")]
            Arithmetic::Bits(bits) => format!("{bits} bits"),
        }
    }

    /// The bits of the unit roundoff.
    pub fn bits(self) -> u32 {
        match self {
            Arithmetic::Machine => 53,
            Arithmetic::Double => 104,
            #[cfg(feature = "rug")]
            Arithmetic::Bits(bits) => bits,
        }
    }
}

/// A number that motions are computed in.
///
/// What is computed once for a motion (constants, phases) is computed in the wider type, where it is cheap, so that a
/// value at a late time is as good as one at an early one.
pub trait Precise: Number {
    /// The type for what is computed once: double-double for f64, 64 more bits for `Mpfr`. There is nothing wider than
    /// double-double without the feature `rug`: for it, it is itself.
    type Wide: Number;
    /// The context of wide numbers.
    fn wide(cx: &Self::Context) -> <Self::Wide as Number>::Context;
    /// The nearest number to a wide one.
    fn narrow(wide: &Self::Wide, cx: &Self::Context) -> Self;
    /// Values in a list of their own type.
    fn values(rows: Vec<Vec<Self>>) -> Values;
}

impl Precise for f64 {
    type Wide = Df64;
    fn wide(_: &()) {}
    fn narrow(wide: &Df64, _: &()) -> f64 {
        wide.hi() + wide.lo()
    }
    fn values(rows: Vec<Vec<f64>>) -> Values {
        Values::Machine(rows)
    }
}

impl Precise for Df64 {
    type Wide = Df64;
    fn wide(_: &()) {}
    fn narrow(wide: &Df64, _: &()) -> Df64 {
        *wide
    }
    fn values(rows: Vec<Vec<Df64>>) -> Values {
        Values::Double(rows)
    }
}

#[cfg(feature = "rug")]
impl Precise for Mpfr {
    type Wide = Mpfr;
    fn wide(cx: &u32) -> u32 {
        cx.saturating_add(64)
    }
    fn narrow(wide: &Mpfr, cx: &u32) -> Mpfr {
        Mpfr(Float::with_val(*cx, &wide.0))
    }
    fn values(rows: Vec<Vec<Mpfr>>) -> Values {
        Values::Any(rows)
    }
}

/// Values of several quantities: a row for each, a column for each time.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// In f64.
    Machine(Vec<Vec<f64>>),
    /// In double-double.
    Double(Vec<Vec<Df64>>),
    /// In so many bits.
    #[cfg(feature = "rug")]
    Any(Vec<Vec<Mpfr>>),
}

fn converted<A, B>(rows: &[Vec<A>], convert: impl Fn(&A) -> B) -> Vec<Vec<B>> {
    rows.iter().map(|row| row.iter().map(&convert).collect()).collect()
}

fn largest<N: Number>(a: &[Vec<N>], b: &[Vec<N>]) -> f64 {
    let mut most: f64 = 0.0;
    for (a, b) in a.iter().flatten().zip(b.iter().flatten()) {
        let distance = a.minus(b);
        most = if distance.is_finite() { most.max(distance.log2_abs().exp2()) } else { f64::INFINITY };
        if most == f64::INFINITY {
            break;
        }
    }
    most
}

impl Values {
    /// The values as machine numbers.
    pub fn to_f64(&self) -> Vec<Vec<f64>> {
        match self {
            Values::Machine(rows) => rows.clone(),
            Values::Double(rows) => converted(rows, Number::to_f64),
            #[cfg(feature = "rug")]
            Values::Any(rows) => converted(rows, Number::to_f64),
        }
    }

    /// A value in decimal, to so many significant digits; empty where there is none.
    pub fn to_decimal(&self, quantity: usize, time: usize, digits: usize) -> String {
        fn of<N: Number>(rows: &[Vec<N>], i: usize, j: usize, digits: usize) -> String {
            rows.get(i).and_then(|row| row.get(j)).map_or_else(String::new, |x| x.to_decimal(digits))
        }
        match self {
            Values::Machine(rows) => of(rows, quantity, time, digits),
            Values::Double(rows) => of(rows, quantity, time, digits),
            #[cfg(feature = "rug")]
            Values::Any(rows) => of(rows, quantity, time, digits),
        }
    }

    /// The values at some of the times.
    pub fn at(&self, times: &[usize]) -> Values {
        fn of<N: Clone>(rows: &[Vec<N>], times: &[usize]) -> Vec<Vec<N>> {
            rows.iter().map(|row| times.iter().filter_map(|&j| row.get(j).cloned()).collect()).collect()
        }
        match self {
            Values::Machine(rows) => Values::Machine(of(rows, times)),
            Values::Double(rows) => Values::Double(of(rows, times)),
            #[cfg(feature = "rug")]
            Values::Any(rows) => Values::Any(of(rows, times)),
        }
    }

    /// The values of one quantity.
    pub fn row(&self, quantity: usize) -> Values {
        fn of<N: Clone>(rows: &[Vec<N>], row: usize) -> Vec<Vec<N>> {
            rows.get(row).cloned().into_iter().collect()
        }
        match self {
            Values::Machine(rows) => Values::Machine(of(rows, quantity)),
            Values::Double(rows) => Values::Double(of(rows, quantity)),
            #[cfg(feature = "rug")]
            Values::Any(rows) => Values::Any(of(rows, quantity)),
        }
    }

    fn to_double(&self) -> Option<Vec<Vec<Df64>>> {
        match self {
            Values::Machine(rows) => Some(converted(rows, |x| Df64::from(*x))),
            Values::Double(rows) => Some(rows.clone()),
            #[cfg(feature = "rug")]
            Values::Any(_) => None,
        }
    }

    #[cfg(feature = "rug")]
    fn to_bits(&self, bits: u32) -> Vec<Vec<Mpfr>> {
        match self {
            Values::Machine(rows) => converted(rows, |x| Mpfr(Float::with_val(bits, *x))),
            Values::Double(rows) => converted(rows, |x| Mpfr(Float::with_val(bits, x.hi()) + x.lo())),
            Values::Any(rows) => rows.clone(),
        }
    }

    /// The largest absolute difference to other values of the same shape, in their own units; infinite where a value is
    /// not finite.
    pub fn distance(&self, other: &Values) -> f64 {
        match (self.to_double(), other.to_double()) {
            (Some(a), Some(b)) => largest(&a, &b),
            #[cfg(feature = "rug")]
            _ => largest(&self.to_bits(256), &other.to_bits(256)),
            #[cfg(not(feature = "rug"))]
            _ => f64::INFINITY,
        }
    }
}
