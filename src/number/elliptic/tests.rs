//! Values against definitions, against other implementations and against MPFR; undefined arguments; bounds of errors.

use super::super::{Df64, Func, Number};
use super::Elliptic::{self, *};
use crate::number::conformance::Random;

#[cfg(feature = "rug")]
mod accuracy;
mod definitions;
mod oracles;
mod speed;
mod undefined;

fn call<N: Number>(f: Elliptic, x: &[N]) -> N {
    let x: Vec<&N> = x.iter().collect();
    let mut value = x[0].clone();
    value.set_elliptic(f, &x);
    value
}
