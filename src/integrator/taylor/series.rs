//! A system of differential equations made ready to give the Taylor series of its solution.

use std::collections::HashMap;

use crate::expr::{Expr, Func, Graph, Node, SymId, Tape, Workspace};
use crate::number::Number;

use super::recurrence::{Desk, Op, Slot, begin, extend};

/// The system y' = f(t, y), given by expressions.
#[derive(Clone, Debug)]
pub struct Equations<'g> {
    /// The graph that the rates stand in.
    pub graph: &'g Graph,
    /// The components of y.
    pub state: &'g [SymId],
    /// Their rates, in the same order.
    pub rates: &'g [Expr],
    /// The symbol of the time, where the rates depend on it.
    pub time: Option<SymId>,
}

/// A rate whose series no recurrence gives.
#[derive(Clone, Debug, PartialEq, thiserror::Error, miette::Diagnostic)]
#[error("{what} has no recurrence for its Taylor coefficients")]
#[diagnostic(help(
    "write it as a solution of differential equations of its own, or integrate by a Runge-Kutta method"
))]
pub struct NoRecurrence {
    /// The function.
    pub what: String,
}

/// A system compiled to recurrences. Symbols that are neither state nor time are parameters.
#[derive(Clone, Debug)]
pub struct Series {
    ops: Vec<(Slot, Op)>,
    /// Those of them that are more than a number.
    moving: Vec<(Slot, Op)>,
    slots: usize,
    rates: Vec<Slot>,
    dimension: usize,
    constants: Tape,
}

/// The series of one point of the motion, and the room to compute them.
#[derive(Clone, Debug)]
pub struct Expansion<N> {
    coefficients: Vec<N>,
    constants: Vec<N>,
    desk: Desk<N>,
    order: usize,
}

impl Series {
    /// Compiles a system.
    ///
    /// # Errors
    /// [`NoRecurrence`] for elliptic functions and integrals.
    pub fn compile(equations: &Equations) -> Result<Series, NoRecurrence> {
        let Equations { graph, state, rates, time } = *equations;
        let mut compiler =
            Compiler { graph, ops: Vec::new(), slots: 0, of: HashMap::new(), known: HashMap::new(), order: Vec::new() };
        for (k, &symbol) in state.iter().enumerate() {
            let slot = compiler.push(Op::State(k));
            compiler.known.insert(symbol, slot);
        }
        if let Some(time) = time {
            let slot = compiler.push(Op::Time);
            compiler.known.insert(time, slot);
        }
        let order = graph.reachable(rates);
        let constants = compiler.constants(&order, rates);
        for e in std::mem::take(&mut compiler.order) {
            compiler.node(e)?;
        }
        let rates = rates.iter().filter_map(|e| compiler.of.get(e).copied()).collect();
        let constants = Tape::compile(graph, &constants);
        let still = |op: &Op| matches!(op, Op::State(_) | Op::Constant(_) | Op::One | Op::Sign(_));
        let moving = compiler.ops.iter().copied().filter(|(_, op)| !still(op)).collect();
        Ok(Series { ops: compiler.ops, moving, slots: compiler.slots, rates, dimension: state.len(), constants })
    }

    /// The number of components of the state.
    pub fn dimension(&self) -> usize {
        self.dimension
    }

    /// The parameters, in the order in which [`Series::prepare`] takes their values.
    pub fn parameters(&self) -> &[SymId] {
        self.constants.inputs()
    }

    /// Room for series up to an order, with values for the parameters. A system is at rest where they are too few.
    pub fn prepare<N: Number>(&self, order: usize, parameters: &[N], cx: &N::Context) -> Expansion<N> {
        let mut given = parameters.to_vec();
        given.resize(self.parameters().len(), N::zero(cx));
        let constants = self.constants.eval(&given, cx, &mut Workspace::new()).to_vec();
        let coefficients = vec![N::zero(cx); self.slots * (order + 1)];
        Expansion { coefficients, constants, desk: Desk::new(order, cx), order }
    }

    /// Computes the series of the motion that is at `y` at the time `t`.
    pub fn expand<N: Number>(&self, t: &N, y: &[N], expansion: &mut Expansion<N>) {
        let Expansion { coefficients, constants, desk, order } = expansion;
        let stride = *order + 1;
        for (k, y) in y.iter().take(self.dimension).enumerate() {
            coefficients[k * stride].set(y);
        }
        for k in 0..*order {
            // From the second coefficient on numbers have none.
            for &(slot, op) in if k == 0 { &self.ops } else { &self.moving } {
                let (known, to) = coefficients.split_at_mut(slot * stride);
                match (k, op) {
                    (0, Op::Time) => to[0].set(t),
                    (0, _) => begin(op, known, to, stride, constants, &desk.integers[1]),
                    _ => extend(op, known, to, stride, k, desk),
                }
            }
            for (i, rate) in self.rates.iter().enumerate() {
                // Where the rate is a component itself, its series stands among the state's.
                let next = coefficients[rate * stride + k].times(&desk.inverses[k + 1]);
                coefficients[i * stride + k + 1] = next;
            }
        }
    }
}

impl<N: Number> Expansion<N> {
    /// The order of the last coefficient.
    pub fn order(&self) -> usize {
        self.order
    }

    /// The coefficients of a component of the state, from that of order 0 on.
    pub fn of(&self, component: usize) -> &[N] {
        &self.coefficients[component * (self.order + 1)..(component + 1) * (self.order + 1)]
    }
}

struct Compiler<'g> {
    graph: &'g Graph,
    ops: Vec<(Slot, Op)>,
    slots: usize,
    /// The slots of expressions.
    of: HashMap<Expr, Slot>,
    /// The slots of the state and the time.
    known: HashMap<SymId, Slot>,
    /// What varies, operands first.
    order: Vec<Expr>,
}

impl Compiler<'_> {
    fn push(&mut self, op: Op) -> Slot {
        // What is computed already serves again.
        if let Some(&(slot, _)) = self.ops.iter().find(|(_, known)| *known == op) {
            return slot;
        }
        let slot = self.slots;
        self.slots += op.width();
        self.ops.push((slot, op));
        slot
    }

    /// Gives the numbers that the rates are made of their slots.
    fn constants(&mut self, order: &[Expr], rates: &[Expr]) -> Vec<Expr> {
        let mut varies: HashMap<Expr, bool> = HashMap::new();
        for &e in order {
            let of = match self.graph.node(e) {
                Node::Symbol(s) => self.known.contains_key(s),
                node => node.operands().any(|a| varies.get(&a) == Some(&true)),
            };
            varies.insert(e, of);
        }
        let constant = |e: &Expr| varies.get(e) == Some(&false);
        let varying = order.iter().filter(|e| !constant(e));
        let mut wanted: Vec<Expr> =
            varying.flat_map(|e| self.graph.node(*e).operands()).chain(rates.to_vec()).collect();
        wanted.retain(constant);
        wanted.sort_unstable();
        wanted.dedup();
        for (k, &e) in wanted.iter().enumerate() {
            let slot = self.push(Op::Constant(k));
            self.of.insert(e, slot);
        }
        self.order = order.iter().copied().filter(|e| !constant(e)).collect();
        wanted
    }

    /// Gives a node that varies, whose operands have their slots, a slot of its own.
    fn node(&mut self, e: Expr) -> Result<(), NoRecurrence> {
        let at = |a: Expr| self.of.get(&a).copied().unwrap_or_default();
        let slot = match *self.graph.node(e) {
            Node::Symbol(s) => self.known.get(&s).copied().unwrap_or_default(),
            Node::Neg(a) => self.push(Op::Neg(at(a))),
            Node::Add(a, b) => self.push(Op::Add(at(a), at(b))),
            Node::Sub(a, b) => self.push(Op::Sub(at(a), at(b))),
            Node::Mul(a, b) => self.product(at(a), at(b)),
            Node::Div(a, b) if self.is_constant(at(b)) => self.push(Op::Over(at(a), at(b))),
            Node::Div(a, b) => self.push(Op::Div(at(a), at(b))),
            Node::PowI(a, n) => self.integer_power(at(a), n),
            Node::Pow(a, b) => self.power(at(a), at(b)),
            Node::Sqrt(a) => self.push(Op::Sqrt(at(a))),
            Node::Call(f, a) => self.call(f, at(a)),
            Node::Atan2(y, x) => self.angle(at(y), at(x)),
            Node::Elliptic(f, _) => return Err(NoRecurrence { what: format!("{f:?}") }),
            Node::Integral(_) => return Err(NoRecurrence { what: "an integral".into() }),
            // Constants have their slots.
            Node::Rational(..) | Node::Pi | Node::E => return Ok(()),
        };
        self.of.insert(e, slot);
        Ok(())
    }

    fn is_constant(&self, slot: Slot) -> bool {
        self.ops.iter().any(|&(s, op)| s == slot && matches!(op, Op::Constant(_)))
    }

    fn product(&mut self, a: Slot, b: Slot) -> Slot {
        match (self.is_constant(a), self.is_constant(b)) {
            _ if a == b => self.push(Op::Square(a)),
            (true, _) => self.push(Op::Scale(a, b)),
            (_, true) => self.push(Op::Scale(b, a)),
            _ => self.push(Op::Mul(a.min(b), a.max(b))),
        }
    }

    /// By squaring, since the base may be zero; an inverse at the end.
    fn integer_power(&mut self, a: Slot, n: i32) -> Slot {
        let bits = (0..u32::BITS - n.unsigned_abs().leading_zeros()).rev();
        let power = bits.skip(1).fold(a, |power, bit| {
            let square = self.push(Op::Square(power));
            if n.unsigned_abs() >> bit & 1 == 1 { self.product(square, a) } else { square }
        });
        if n < 0 {
            let one = self.one();
            self.push(Op::Div(one, power))
        } else {
            power
        }
    }

    /// The constant 1, the last of the constants.
    fn one(&mut self) -> Slot {
        self.push(Op::One)
    }

    fn weighted(&mut self, a: Slot) -> Slot {
        self.push(Op::Weighted(a))
    }

    fn power(&mut self, a: Slot, b: Slot) -> Slot {
        if self.is_constant(b) {
            let weighted = self.weighted(a);
            return self.push(Op::Pow(a, weighted, b));
        }
        let log = self.call(Func::Ln, a);
        let exponent = self.product(b, log);
        self.call(Func::Exp, exponent)
    }

    fn call(&mut self, f: Func, a: Slot) -> Slot {
        let w = match f {
            Func::Abs => return self.push(Op::Abs(a)),
            Func::Sign => return self.push(Op::Sign(a)),
            _ => self.weighted(a),
        };
        match f {
            Func::Exp => self.push(Op::Exp(a, w)),
            Func::Sin => self.push(Op::SinCos(a, w)),
            Func::Cos => self.push(Op::SinCos(a, w)) + 1,
            Func::Sinh => self.push(Op::SinhCosh(a, w)),
            Func::Cosh => self.push(Op::SinhCosh(a, w)) + 1,
            Func::Tan => {
                let sine = self.push(Op::SinCos(a, w));
                self.push(Op::Div(sine, sine + 1))
            }
            Func::Tanh => {
                let sine = self.push(Op::SinhCosh(a, w));
                self.push(Op::Div(sine, sine + 1))
            }
            _ => {
                let slope = self.slope(f, a);
                self.push(Op::Integral(f, [a, w, slope]))
            }
        }
    }

    /// The derivative of an inverse function at `a`.
    fn slope(&mut self, f: Func, a: Slot) -> Slot {
        let one = self.one();
        let square = self.push(Op::Square(a));
        let below = match f {
            Func::Ln => a,
            Func::Atan => self.push(Op::Add(one, square)),
            Func::Atanh => self.push(Op::Sub(one, square)),
            _ => {
                let under = match f {
                    Func::Asinh => self.push(Op::Add(one, square)),
                    Func::Acosh => self.push(Op::Sub(square, one)),
                    _ => self.push(Op::Sub(one, square)),
                };
                self.push(Op::Sqrt(under))
            }
        };
        let slope = self.push(Op::Div(one, below));
        if f == Func::Acos { self.push(Op::Neg(slope)) } else { slope }
    }

    fn angle(&mut self, y: Slot, x: Slot) -> Slot {
        let (yy, xx) = (self.push(Op::Square(y)), self.push(Op::Square(x)));
        let square = self.push(Op::Add(xx, yy));
        let (gx, gy) = (self.push(Op::Div(x, square)), self.push(Op::Div(y, square)));
        let (wy, wx) = (self.weighted(y), self.weighted(x));
        self.push(Op::Angle([y, x, wy, wx, gx, gy]))
    }
}
