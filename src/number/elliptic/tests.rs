//! Values against MPFR's arithmetic-geometric mean, against integrals as they are defined, and between functions; undefined arguments.

use super::super::{Df64, Number};
use super::Elliptic::{self, *};
use super::*;
use crate::number::conformance::Random;

fn call<N: Number>(f: Elliptic, x: &[N]) -> N {
    let x: Vec<&N> = x.iter().collect();
    let mut value = x[0].clone();
    value.set_elliptic(f, &x);
    value
}

#[cfg(feature = "rug")]
mod accuracy;
