//! What a formula loses at a state, and how much of that is the problem's own.
//!
//! The state's values are doubles and taken as exact. *Bits lost* are log₂ of the relative error of the formula in
//! doubles in units of 2^-53, between 0 and 53; a formula of several components is measured by the largest of them.
//! The *condition* is log₂ of κ = Σ |xᵢ ∂f/∂xᵢ| / |f|, the relative change of the exact value for relative changes of
//! its variables (Higham, *Accuracy and Stability of Numerical Algorithms*, 2nd ed. 2002, section 1.6): so many bits
//! are lost by whoever knows the variables to 53 bits, in whatever way they compute. What is lost beyond is the
//! formula's fault.
//!
//! A loss is told only where it is certain: the exact value's own error bound is a thousandth of the error that is
//! measured. Where the exact value may be zero there is no relative error, and no loss is told; nor where it lies
//! beyond the range of doubles, which is no matter of digits.

use serde::Serialize;

use crate::check::computed::Variable;
use crate::expr::{Expr, Graph, Tape, Workspace};
use crate::number::{Df64, Dual, Lanes, Number, Real, Tracked};

/// The bits of a double.
pub const BITS: f64 = f64::MANTISSA_DIGITS as f64;

/// Sizes whose |log₂| is larger are too near to the ends of the range of doubles.
const REACH: f64 = 900.0;

/// log₂ of the share of a measured error that the exact value's own error may have.
const MARGIN: f64 = -10.0;

/// The precision in bits for what double-double cannot tell.
#[cfg(feature = "rug")]
const MORE_BITS: u32 = 320;

/// The number of derivatives that are taken at once.
const DIRECTIONS: usize = 8;

/// The bits beyond the condition from which on the condition is looked at more closely.
const DOUBTFUL: f64 = 4.0;

/// What derivatives are taken in.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Slopes {
    /// Doubles.
    Quick,
    /// Double-double.
    Precise,
}

/// What a formula loses at a state, in bits.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Loss {
    /// The bits lost.
    pub lost: f64,
    /// log₂ of the condition number, not below 0.
    pub condition: f64,
}

impl Loss {
    /// The bits lost beyond the condition number: the formula's fault.
    pub fn fault(&self) -> f64 {
        (self.lost - self.condition).max(0.0)
    }
}

/// Measures a formula.
pub struct Meter {
    tape: Tape,
    /// Where the tape's inputs stand in a state.
    places: Vec<usize>,
    /// Whether they are whole numbers, and so exact.
    integer: Vec<bool>,
    positive: Tape,
    positive_places: Vec<usize>,
    quick: Workspace<f64>,
    fine: Workspace<Df64>,
    tracked: Workspace<Tracked<Df64>>,
    slopes: Workspace<Dual<Lanes<DIRECTIONS>>>,
    fine_slopes: Workspace<Dual<Df64>>,
}

/// Where a tape's inputs stand among variables.
pub(super) fn places(tape: &Tape, variables: &[Variable]) -> Vec<usize> {
    let place = |s| variables.iter().position(|v| v.symbol == s).unwrap_or(0);
    tape.inputs().iter().map(|s| place(*s)).collect()
}

fn at(state: &[f64], places: &[usize]) -> Vec<f64> {
    places.iter().map(|p| state.get(*p).copied().unwrap_or(f64::NAN)).collect()
}

impl Meter {
    /// A meter of a formula by its components. States give values to `variables`, which all symbols of the formula
    /// are among, and are allowed where what is `positive` is.
    pub fn new(graph: &Graph, outputs: &[Expr], positive: &[Expr], variables: &[Variable]) -> Self {
        let tape = Tape::compile(graph, outputs);
        let positive = Tape::compile(graph, positive);
        let places = self::places(&tape, variables);
        Meter {
            integer: places.iter().map(|p| variables[*p].integer).collect(),
            positive_places: self::places(&positive, variables),
            places,
            tape,
            positive,
            quick: Workspace::new(),
            fine: Workspace::new(),
            tracked: Workspace::new(),
            slopes: Workspace::new(),
            fine_slopes: Workspace::new(),
        }
    }

    /// The formula's tape.
    pub fn tape(&self) -> &Tape {
        &self.tape
    }

    /// Whether the premises allow a state.
    pub fn is_allowed(&mut self, state: &[f64]) -> bool {
        let inputs = at(state, &self.positive_places);
        self.positive.eval(&inputs, &(), &mut self.quick).iter().all(|x| *x > 0.0)
    }

    /// The bits lost as far as double-double without bounds can tell: for a search.
    pub fn guess(&mut self, state: &[f64]) -> Option<f64> {
        let inputs = at(state, &self.places);
        let rough = self.tape.eval(&inputs, &(), &mut self.quick);
        let exact: Vec<Df64> = inputs.iter().map(|x| Df64::from(*x)).collect();
        let fine = self.tape.eval(&exact, &(), &mut self.fine);
        if !fine.iter().all(Number::is_finite) {
            return None;
        }
        let size = largest(fine.iter().map(Number::log2_abs));
        let error = largest(rough.iter().zip(fine).map(|(r, f)| error_log2(*r, f)));
        (size.abs() < REACH).then(|| (BITS + error - size).clamp(0.0, BITS))
    }

    /// The bits lost, where that is certain.
    pub fn lost(&mut self, state: &[f64]) -> Option<f64> {
        let inputs = at(state, &self.places);
        let rough = self.tape.eval(&inputs, &(), &mut self.quick);
        let exact: Vec<_> = inputs.iter().map(|x| Tracked::exact(Df64::from(*x))).collect();
        let lost = certain(rough, self.tape.eval(&exact, &(), &mut self.tracked));
        #[cfg(feature = "rug")]
        let lost = lost.or_else(|| {
            use crate::number::Mpfr;
            let exact: Vec<_> = inputs.iter().map(|x| Tracked::exact(Mpfr::from_f64(*x, &MORE_BITS))).collect();
            certain(rough, self.tape.eval(&exact, &MORE_BITS, &mut Workspace::new()))
        });
        lost
    }

    /// The bits lost and the condition, where both are certain.
    pub fn loss(&mut self, state: &[f64]) -> Option<Loss> {
        let lost = self.lost(state)?;
        let quick = Loss { lost, condition: self.condition(state, Slopes::Quick) };
        // Slopes in doubles lose digits as well, and a sign of what should not vanish is 0 in them.
        let doubtful = quick.fault() > DOUBTFUL;
        Some(if doubtful { Loss { lost, condition: self.condition(state, Slopes::Precise) } } else { quick })
    }

    /// log₂ of the condition number at a state, not below 0 nor above 53; 53 where a derivative is not finite.
    fn condition(&mut self, state: &[f64], slopes: Slopes) -> f64 {
        let inputs = at(state, &self.places);
        let exact: Vec<Df64> = inputs.iter().map(|x| Df64::from(*x)).collect();
        if self.is_at_border(&inputs, &exact) {
            return BITS;
        }
        let values = self.tape.eval(&exact, &(), &mut self.fine);
        let size = values.iter().map(|x| x.to_f64().abs()).fold(0.0, f64::max);
        let quick = Some(self.quick_slopes(&inputs)).filter(|sum| slopes == Slopes::Quick && sum.is_finite());
        let sum = quick.unwrap_or_else(|| self.precise_slopes(&exact));
        let condition = (sum / size).log2();
        if condition.is_nan() { BITS } else { condition.clamp(0.0, BITS) }
    }

    /// Whether the formula has no value in doubles, nor exactly where a variable moves by its last bit: no derivative
    /// tells how much is lost at the border of where a formula is defined.
    fn is_at_border(&mut self, inputs: &[f64], exact: &[Df64]) -> bool {
        if self.tape.eval(inputs, &(), &mut self.quick).iter().all(|x| x.is_finite()) {
            return false;
        }
        let mut moved = exact.to_vec();
        for i in (0..exact.len()).filter(|i| !self.integer[*i]) {
            for step in [f64::EPSILON, -f64::EPSILON] {
                moved[i] = exact[i] * (1.0 + step);
                if !self.tape.eval(&moved, &(), &mut self.fine).iter().all(Number::is_finite) {
                    return true;
                }
            }
            moved[i] = exact[i];
        }
        false
    }

    /// Σ |xᵢ ∂f/∂xᵢ| in doubles.
    fn quick_slopes(&mut self, inputs: &[f64]) -> f64 {
        let moving: Vec<usize> = (0..inputs.len()).filter(|i| !self.integer[*i]).collect();
        let mut sum = 0.0;
        for block in moving.chunks(DIRECTIONS) {
            let dual = |(i, x): (usize, &f64)| {
                let rate = std::array::from_fn(|k| if block.get(k) == Some(&i) { 1.0 } else { 0.0 });
                Dual::new(Lanes([*x; DIRECTIONS]), Lanes(rate))
            };
            let inputs: Vec<_> = inputs.iter().enumerate().map(dual).collect();
            let out = self.tape.eval(&inputs, &(), &mut self.slopes);
            for (k, i) in block.iter().enumerate() {
                // A comparison would lose what is no number.
                let most = out.iter().map(|o| o.derivative.0[k].abs()).fold(0.0, |a, b| if a >= b { a } else { b });
                sum += inputs[*i].value.0[0].abs() * most;
            }
        }
        sum
    }

    /// Σ |xᵢ ∂f/∂xᵢ| in double-double.
    fn precise_slopes(&mut self, inputs: &[Df64]) -> f64 {
        let mut sum = 0.0;
        for i in (0..inputs.len()).filter(|i| !self.integer[*i]) {
            let rate = |k: usize| if k == i { Df64::from(1.0) } else { Df64::from(0.0) };
            let dual: Vec<_> = inputs.iter().enumerate().map(|(k, x)| Dual::new(*x, rate(k))).collect();
            let out = self.tape.eval(&dual, &(), &mut self.fine_slopes);
            let most = out.iter().map(|o| o.derivative.to_f64().abs()).fold(0.0, |a, b| if a >= b { a } else { b });
            sum += inputs[i].to_f64().abs() * most;
        }
        sum
    }
}

/// log₂ of the distance of a double from an exact value; infinite where it is no number.
fn error_log2<N: Number>(rough: f64, fine: &N) -> f64 {
    if rough.is_finite() { fine.like(rough).minus(fine).log2_abs() } else { f64::INFINITY }
}

fn largest(x: impl Iterator<Item = f64>) -> f64 {
    x.fold(f64::NEG_INFINITY, f64::max)
}

/// The bits lost, where the errors of the exact values do not matter.
pub(super) fn certain<N: Real>(rough: &[f64], fine: &[Tracked<N>]) -> Option<f64> {
    if !fine.iter().all(Number::is_finite) {
        return None;
    }
    let size = largest(fine.iter().map(|x| x.value().log2_abs()));
    let bound = largest(fine.iter().map(Tracked::error_log2));
    let error = largest(rough.iter().zip(fine).map(|(r, f)| error_log2(*r, f.value())));
    let known = bound <= MARGIN + error.min(size).max(size - BITS);
    (known && size.abs() < REACH).then(|| (BITS + error - size).clamp(0.0, BITS))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::expr::Func;

    /// What a function of x loses at x.
    fn loss(build: impl Fn(&mut Graph, Expr) -> Expr, x: f64) -> Option<Loss> {
        let mut graph = Graph::new();
        let symbol = graph.symbol("x");
        let e = graph.sym(symbol);
        let e = build(&mut graph, e);
        let variables = [Variable { symbol, tex: "x".into(), range: [-10.0, 10.0], integer: false }];
        Meter::new(&graph, &[e], &[], &variables).loss(&[x])
    }

    #[test]
    fn a_fault_is_told_from_an_ill_conditioned_problem() {
        // 1 - cos x near 0: the condition is 2, whatever is lost.
        let cosine = |g: &mut Graph, x: Expr| {
            let (one, cos) = (g.int(1), g.call(Func::Cos, x));
            g.sub(one, cos)
        };
        let fault = loss(cosine, 1e-6).unwrap();
        assert!((fault.condition - 1.0).abs() < 1e-3 && fault.lost > 30.0, "{fault:?}");
        // sin x near π: x is a double, and the sine right to the last bit; but the problem is ill-conditioned.
        let ill = loss(|g, x| g.call(Func::Sin, x), std::f64::consts::PI).unwrap();
        assert!(ill.lost < 1.0 && ill.condition > 50.0, "{ill:?}");
        // cos x - 0.75, which is near its zero, loses what the condition accounts for.
        let shifted = |g: &mut Graph, x: Expr| {
            let (cos, c) = (g.call(Func::Cos, x), g.ratio(3, 4));
            g.sub(cos, c)
        };
        let both = loss(shifted, 0.75_f64.acos()).unwrap();
        assert!(both.lost > 40.0 && both.fault() < 4.0, "{both:?}");
    }

    #[test]
    fn an_exact_zero_has_no_relative_error() {
        // x - 2 at 2 is 0 in doubles and exactly; x² - 2 at the double next to √2 is not.
        let less = |n: i64| {
            move |g: &mut Graph, x: Expr| {
                let (x, two) = (g.powi(x, n as i32), g.int(2));
                g.sub(x, two)
            }
        };
        assert_eq!(loss(less(1), 2.0), None);
        assert!(loss(less(2), std::f64::consts::SQRT_2).unwrap().lost > 30.0);
    }

    #[test]
    fn the_border_of_the_domain_is_no_fault() {
        // √(x² - 1/9) just above 1/3: whether doubles give it a value is chance.
        let root = |g: &mut Graph, x: Expr| {
            let (third, square) = (g.ratio(1, 9), g.powi(x, 2));
            let difference = g.sub(square, third);
            g.sqrt(difference)
        };
        let above = f64::from_bits((1.0_f64 / 3.0).to_bits() + 1);
        let loss = loss(root, above).unwrap();
        assert!(loss.fault() < 4.0, "{loss:?}");
    }
}
