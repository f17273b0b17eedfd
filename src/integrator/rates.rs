//! Systems given by expressions, for every method.

use std::cell::RefCell;

use super::System;
use super::taylor::Equations;
use crate::expr::{SymId, Tape, Workspace};
use crate::number::Number;

/// Where a tape's input comes from.
#[derive(Clone, Copy, Debug)]
enum Input {
    State(usize),
    Time,
    Parameter,
}

/// The same equations as the [Taylor series](super::taylor::Series) takes, compiled to a tape.
#[derive(Clone, Debug)]
pub struct Rates<N: Number> {
    tape: Tape,
    inputs: Vec<Input>,
    parameters: Vec<SymId>,
    context: N::Context,
    desk: RefCell<Desk<N>>,
}

/// The values of the inputs, and the room to compute in.
#[derive(Clone, Debug)]
struct Desk<N: Number> {
    inputs: Vec<N>,
    workspace: Workspace<N>,
}

impl<N: Number> Rates<N> {
    /// Compiles equations; `parameter` gives the values of the symbols that are neither state nor time.
    pub fn compile(equations: &Equations, context: &N::Context, parameter: impl Fn(SymId) -> N) -> Self {
        let tape = Tape::compile(equations.graph, equations.rates);
        let (mut inputs, mut values, mut parameters) = (Vec::new(), Vec::new(), Vec::new());
        for &symbol in tape.inputs() {
            let state = equations.state.iter().position(|&s| s == symbol);
            let input = match state {
                Some(k) => Input::State(k),
                None if equations.time == Some(symbol) => Input::Time,
                None => Input::Parameter,
            };
            let given = matches!(input, Input::Parameter);
            parameters.extend(given.then_some(symbol));
            values.push(if given { parameter(symbol) } else { N::zero(context) });
            inputs.push(input);
        }
        let desk = RefCell::new(Desk { inputs: values, workspace: Workspace::new() });
        Rates { tape, inputs, parameters, context: context.clone(), desk }
    }

    /// The symbols that are neither state nor time.
    pub fn parameters(&self) -> &[SymId] {
        &self.parameters
    }
}

impl<N: Number> System<N> for Rates<N> {
    fn derivative(&self, t: &N, y: &[N], slope: &mut [N]) {
        let desk = &mut *self.desk.borrow_mut();
        for (value, input) in desk.inputs.iter_mut().zip(&self.inputs) {
            match *input {
                Input::State(k) => value.set(&y[k]),
                Input::Time => value.set(t),
                Input::Parameter => {}
            }
        }
        let rates = self.tape.eval(&desk.inputs, &self.context, &mut desk.workspace);
        for (slope, rate) in slope.iter_mut().zip(rates) {
            slope.set(rate);
        }
    }
}
