//! What every method has to pass. A new method is correct when it is in one of the lists here and the suite passes.

mod adaptive;
mod fixed;
mod problems;
mod rigid;

use super::{CLASSICAL_4, Composition, DORMAND_PRINCE_8, GaussLegendre, Method, Rates, RungeKutta};
use crate::number::Number;
use problems::Problem;

/// The methods with a given step, for a system.
fn methods<'s, N: Number>(rates: &'s Rates<N>, dimension: usize, cx: &N::Context) -> Vec<Box<dyn Method<N> + 's>> {
    let mut methods: Vec<Box<dyn Method<N> + 's>> = Vec::new();
    for tableau in [&CLASSICAL_4, &DORMAND_PRINCE_8] {
        methods.push(Box::new(RungeKutta::new(tableau, rates, dimension, cx)));
    }
    for stages in 1..=4 {
        methods.push(Box::new(GaussLegendre::new(stages, rates, dimension, cx)));
    }
    methods
}

/// The largest difference of components.
fn distance<N: Number>(a: &[N], b: &[N]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a.minus(b).log2_abs()).fold(f64::NEG_INFINITY, f64::max).exp2()
}
