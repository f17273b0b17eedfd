//! The tape: a graph's outputs as a flat list of instructions, for any number type.
//!
//! Every instruction writes a slot of its own, past those it reads. Constants, and whatever is made of constants only,
//! come first and are computed once for a context; then come the inputs, then the rest.

use super::graph::{Expr, Graph, Node, SymId};
use super::integral::Within;
use super::parts::Parts;
use crate::number::{Dual, Elliptic, Func, Number};
use rustc_hash::FxHashMap as HashMap;
use std::sync::Arc;

/// The slot an operand or result is in.
type Slot = u32;

/// How a slot is computed from slots before it.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Op {
    Ratio(i128, i128),
    Pi,
    E,
    Neg(Slot),
    Add(Slot, Slot),
    Sub(Slot, Slot),
    Mul(Slot, Slot),
    Div(Slot, Slot),
    PowI(Slot, i32),
    Pow(Slot, Slot),
    Sqrt(Slot),
    Call(Func, Slot),
    Atan2(Slot, Slot),
    Elliptic(Elliptic, [Slot; 4]),
    /// The integral of this number in the program's list.
    Integral(u32),
    /// Sine into the slot, cosine into the one after it.
    SinCos(Slot),
}

/// An instruction: the slot that is written, and how.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Instruction {
    to: Slot,
    op: Op,
}

/// What a tape and the workspaces prepared for it share.
#[derive(Debug)]
struct Program {
    /// Instructions that need no input; slots from 0 on.
    constants: Vec<Instruction>,
    /// The symbols that are read; `inputs[i]` is in slot `first_input + i`.
    inputs: Vec<SymId>,
    first_input: usize,
    instructions: Vec<Instruction>,
    slots: usize,
    outputs: Vec<Slot>,
    integrals: Vec<Within>,
}

/// Compiled expressions.
#[derive(Clone, Debug)]
pub struct Tape {
    program: Arc<Program>,
}

/// The slots that a tape is evaluated in. One workspace serves any tapes and contexts in turn, and is fastest when they
/// stay the same.
#[derive(Clone, Debug)]
pub struct Workspace<N: Number> {
    prepared: Option<(Arc<Program>, N::Context)>,
    slots: Vec<N>,
    outputs: Vec<N>,
}

impl<N: Number> Default for Workspace<N> {
    fn default() -> Self {
        Workspace { prepared: None, slots: Vec::new(), outputs: Vec::new() }
    }
}

impl<N: Number> Workspace<N> {
    /// An empty workspace, prepared by the first evaluation.
    pub fn new() -> Self {
        Self::default()
    }

    /// Computes the constants, unless this tape's are already there.
    fn prepare(&mut self, program: &Arc<Program>, cx: &N::Context) {
        if self.prepared.as_ref().is_some_and(|(p, c)| Arc::ptr_eq(p, program) && c == cx) {
            return;
        }
        self.slots.clear();
        self.slots.resize(program.slots, N::zero(cx));
        self.outputs.clear();
        self.outputs.resize(program.outputs.len(), N::zero(cx));
        for instruction in &program.constants {
            match instruction.op {
                Op::Ratio(n, d) => self.slots[instruction.to as usize] = N::from_ratio(n, d, cx),
                Op::Pi => self.slots[instruction.to as usize] = N::pi(cx),
                Op::E => self.slots[instruction.to as usize] = N::e(cx),
                _ => run(&mut self.slots, instruction, &program.integrals),
            }
        }
        self.prepared = Some((Arc::clone(program), cx.clone()));
    }
}

impl Tape {
    /// Compiles the expressions; what they do not need is left out.
    pub fn compile(graph: &Graph, outputs: &[Expr]) -> Tape {
        Compiler::new(graph, outputs).compile(outputs)
    }

    /// The symbols that must be given, in the order in which [`Tape::eval`] takes their values.
    pub fn inputs(&self) -> &[SymId] {
        &self.program.inputs
    }

    /// The number of instructions in one evaluation; those on constants alone are not counted.
    pub fn len(&self) -> usize {
        self.program.instructions.len()
    }

    /// Whether an evaluation has nothing to compute.
    pub fn is_empty(&self) -> bool {
        self.program.instructions.is_empty()
    }

    /// The values of the outputs, in order, for the values of [`Tape::inputs`]. What is undefined there (1/0, √-1) is a
    /// value that is not finite.
    ///
    /// # Panics
    ///
    /// Where the number of values is not that of the inputs: an error of the caller, not of its data.
    pub fn eval<'w, N: Number>(&self, inputs: &[N], cx: &N::Context, workspace: &'w mut Workspace<N>) -> &'w [N] {
        let program = &self.program;
        assert_eq!(inputs.len(), program.inputs.len(), "a tape wants one value for each of its inputs");
        workspace.prepare(program, cx);
        for (slot, value) in workspace.slots[program.first_input..].iter_mut().zip(inputs) {
            slot.set(value);
        }
        for instruction in &program.instructions {
            run(&mut workspace.slots, instruction, &program.integrals);
        }
        for (output, &slot) in workspace.outputs.iter_mut().zip(&program.outputs) {
            output.set(&workspace.slots[slot as usize]);
        }
        &workspace.outputs
    }

    /// The values of the outputs and their derivatives along `direction`, given as a rate for each input.
    pub fn eval_along<N: Number>(&self, inputs: &[N], direction: &[N], cx: &N::Context) -> Vec<Dual<N>> {
        let inputs: Vec<_> = inputs.iter().zip(direction).map(|(x, d)| Dual::new(x.clone(), d.clone())).collect();
        self.eval(&inputs, cx, &mut Workspace::new()).to_vec()
    }
}

/// Runs one instruction. Its operands stand before its own slot.
#[inline(always)]
fn run<N: Number>(slots: &mut [N], instruction: &Instruction, integrals: &[Within]) {
    let (known, rest) = slots.split_at_mut(instruction.to as usize);
    let [to, next @ ..] = rest else { return };
    let at = |slot: Slot| &known[slot as usize];
    match instruction.op {
        Op::Ratio(..) | Op::Pi | Op::E => {} // made with a context, when the workspace is prepared
        Op::Neg(a) => to.set_neg(at(a)),
        Op::Add(a, b) => to.set_add(at(a), at(b)),
        Op::Sub(a, b) => to.set_sub(at(a), at(b)),
        Op::Mul(a, b) => to.set_mul(at(a), at(b)),
        Op::Div(a, b) => to.set_div(at(a), at(b)),
        Op::PowI(a, n) => to.set_powi(at(a), n),
        Op::Pow(a, b) => to.set_pow(at(a), at(b)),
        Op::Sqrt(a) => to.set_sqrt(at(a)),
        Op::Call(f, a) => to.set_call(f, at(a)),
        Op::Atan2(a, b) => to.set_atan2(at(a), at(b)),
        Op::Elliptic(f, x) => to.set_elliptic(f, &x.map(at)[..f.arity()]),
        Op::Integral(k) => {
            if let Some(integral) = integrals.get(k as usize) {
                integral.integrate(known, to);
            }
        }
        Op::SinCos(a) => {
            if let Some(cos) = next.first_mut() {
                N::set_sin_cos(to, cos, at(a));
            }
        }
    }
}

/// Gives every expression a slot.
struct Compiler<'g> {
    graph: &'g Graph,
    parts: Parts,
    /// The slot of each part.
    slot: Vec<Option<Slot>>,
    /// The sine and cosine of the same angle, by that angle, where both are wanted.
    both: HashMap<Expr, (Expr, Expr)>,
    next: Slot,
    integrals: Vec<Within>,
}

impl<'g> Compiler<'g> {
    fn new(graph: &'g Graph, outputs: &[Expr]) -> Self {
        let parts = graph.parts_around_integrals(outputs);
        let calls = |f: Func| {
            parts.order().iter().filter_map(move |&e| match *graph.node(e) {
                Node::Call(g, a) if g == f => Some((a, e)),
                _ => None,
            })
        };
        let sines: HashMap<Expr, Expr> = calls(Func::Sin).collect();
        let both = calls(Func::Cos).filter_map(|(a, cos)| Some((a, (*sines.get(&a)?, cos)))).collect();
        let slot = vec![None; parts.order().len()];
        Compiler { graph, parts, slot, both, next: 0, integrals: Vec::new() }
    }

    fn compile(mut self, outputs: &[Expr]) -> Tape {
        let mut constant: Vec<bool> = Vec::with_capacity(self.slot.len());
        let (mut inputs, mut constants, mut variables) = (Vec::new(), Vec::new(), Vec::new());
        for &e in self.parts.order() {
            let node = self.graph.node(e);
            let is_constant = |a: Expr| self.parts.position(a).is_some_and(|i| constant[i]);
            let of_constants = match *node {
                Node::Symbol(_) => false,
                Node::Integral(integrand) => self.graph.parameters(integrand).is_empty(),
                _ => node.operands().all(is_constant),
            };
            if let Node::Symbol(s) = *node {
                inputs.push((s, e));
            }
            constant.push(of_constants);
            if of_constants { constants.push(e) } else { variables.push(e) }
        }
        inputs.sort_unstable();
        let constants = self.instructions(&constants);
        let first_input = self.next as usize;
        for &(_, e) in &inputs {
            let slot = self.take(1);
            self.place(e, slot);
        }
        let instructions = self.instructions(&variables);
        let outputs = outputs.iter().filter_map(|e| self.at(*e)).collect();
        let inputs = inputs.into_iter().map(|(s, _)| s).collect();
        let slots = self.next as usize;
        let integrals = self.integrals;
        Tape { program: Arc::new(Program { constants, inputs, first_input, instructions, slots, outputs, integrals }) }
    }

    /// The slot of an expression, if it has one yet.
    fn at(&self, e: Expr) -> Option<Slot> {
        self.slot[self.parts.position(e)?]
    }

    fn place(&mut self, e: Expr, slot: Slot) {
        if let Some(i) = self.parts.position(e) {
            self.slot[i] = Some(slot);
        }
    }

    fn take(&mut self, count: Slot) -> Slot {
        let slot = self.next;
        self.next += count;
        slot
    }

    fn instructions(&mut self, order: &[Expr]) -> Vec<Instruction> {
        let mut instructions = Vec::with_capacity(order.len());
        for &e in order {
            if self.at(e).is_some() {
                continue; // an input, or the cosine that came with its sine
            }
            let Some(op) = self.op(e) else { continue };
            let to = match op {
                Op::SinCos(_) => self.take(2),
                _ => self.take(1),
            };
            match (op, *self.graph.node(e)) {
                (Op::SinCos(_), Node::Call(_, a)) => {
                    if let Some(&(sin, cos)) = self.both.get(&a) {
                        self.place(sin, to);
                        self.place(cos, to + 1);
                    }
                }
                _ => self.place(e, to),
            }
            instructions.push(Instruction { to, op });
        }
        instructions
    }

    /// The operation of a node, whose operands all have their slots; none for a symbol.
    fn op(&mut self, e: Expr) -> Option<Op> {
        if let Node::Integral(integrand) = *self.graph.node(e) {
            let within = Within::compile(self.graph, integrand, |a| self.at(a).map(|slot| slot as usize))?;
            self.integrals.push(within);
            return Some(Op::Integral(self.integrals.len() as u32 - 1));
        }
        let at = |a: Expr| self.at(a);
        Some(match *self.graph.node(e) {
            Node::Symbol(_) | Node::Integral(_) => return None,
            Node::Rational(n, d) => Op::Ratio(n, d),
            Node::Pi => Op::Pi,
            Node::E => Op::E,
            Node::Neg(a) => Op::Neg(at(a)?),
            Node::Add(a, b) => Op::Add(at(a)?, at(b)?),
            Node::Sub(a, b) => Op::Sub(at(a)?, at(b)?),
            Node::Mul(a, b) => Op::Mul(at(a)?, at(b)?),
            Node::Div(a, b) => Op::Div(at(a)?, at(b)?),
            Node::PowI(a, n) => Op::PowI(at(a)?, n),
            Node::Pow(a, b) => Op::Pow(at(a)?, at(b)?),
            Node::Sqrt(a) => Op::Sqrt(at(a)?),
            Node::Call(Func::Sin | Func::Cos, a) if self.both.contains_key(&a) => Op::SinCos(at(a)?),
            Node::Call(f, a) => Op::Call(f, at(a)?),
            Node::Atan2(y, x) => Op::Atan2(at(y)?, at(x)?),
            Node::Elliptic(f, [a, b, c, d]) => Op::Elliptic(f, [at(a)?, at(b)?, at(c)?, at(d)?]),
        })
    }
}
