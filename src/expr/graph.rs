//! A graph of scalar operations. Equal subexpressions are stored once (hash consing), and operands always stand before
//! the operations that use them, so that the order of the arena is a topological order and no algorithm here recurses.
//!
//! The constructors simplify only what is beyond doubt: constants are folded exactly, neutral elements vanish,
//! operands of sums and products are ordered. They never distribute, factor or cancel quotients, and never fold a
//! division by the constant zero. `0·x` and `x - x` are zero even where `x` itself is singular.
//!
//! A graph that has [`MOST_NODES`] nodes, or whose time is used up, takes in nothing more: it is cut short, for good, and
//! what its constructors return from then on means nothing. Whoever builds something asks [`Graph::cut_short`] before
//! the result is used.

use super::deadline::{Cut, Deadline};
use super::ratio::{self, Ratio};
use crate::number::{Elliptic, Func};
use indexmap::IndexSet;
use rustc_hash::{FxBuildHasher, FxHashMap as HashMap};

/// The most nodes of a graph: some 200 MB, a hundred times what notes need.
pub const MOST_NODES: usize = 1 << 20;

/// How many nodes are added between two looks at the clock.
const NODES_BETWEEN_LOOKS: usize = 1024;

/// An expression: an index into its graph.
#[derive(Copy, Clone, Eq, PartialEq, Hash, Ord, PartialOrd, Debug)]
pub struct Expr(u32);

impl Expr {
    /// The index in the graph. Operands have smaller ones than what they are used in.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// A symbol: an index into its graph's symbols.
#[derive(Copy, Clone, Eq, PartialEq, Hash, Ord, PartialOrd, Debug)]
pub struct SymId(u32);

impl SymId {
    /// The index among the graph's symbols.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// What the graph knows of a symbol.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SymbolInfo {
    /// Its LaTeX, such as `\theta`, `m_{2}`, `\dot{\theta}`.
    pub name: String,
    /// The symbol of which it is a time derivative; itself where `order` is 0.
    pub base: SymId,
    /// The order of the time derivative: 0 for a symbol itself.
    pub order: u32,
    /// Whether it depends on time.
    pub of_t: bool,
}

/// An operation and its operands.
#[derive(Copy, Clone, Debug, PartialEq, Eq, Hash)]
pub enum Node {
    /// A fraction in lowest terms, numerator and positive denominator.
    Rational(i128, i128),
    /// π.
    Pi,
    /// e, the base of natural logarithms.
    E,
    /// A symbol.
    Symbol(SymId),
    /// -a.
    Neg(Expr),
    /// a + b.
    Add(Expr, Expr),
    /// a - b.
    Sub(Expr, Expr),
    /// a b.
    Mul(Expr, Expr),
    /// a / b.
    Div(Expr, Expr),
    /// aⁿ for an integer n; of any a, but zero where n is negative.
    PowI(Expr, i32),
    /// aᵇ for a positive a.
    Pow(Expr, Expr),
    /// The square root that is not negative.
    Sqrt(Expr),
    /// A function of one variable.
    Call(Func, Expr),
    /// `Atan2(y, x)`: the angle of the point (x, y), in (-π, π].
    Atan2(Expr, Expr),
    /// An elliptic function of its operands, the last of which fills the places that it does not have.
    Elliptic(Elliptic, [Expr; 4]),
    /// The integral from 0 to 1 of an expression in the bound symbols: see [`super::integral`].
    Integral(Expr),
}

impl Node {
    /// The operands, in order.
    pub fn operands(&self) -> impl Iterator<Item = Expr> + use<> {
        let none = Expr(0);
        let (count, operands) = match *self {
            Node::Rational(..) | Node::Pi | Node::E | Node::Symbol(_) => (0, [none; 4]),
            Node::Neg(a) | Node::PowI(a, _) | Node::Sqrt(a) | Node::Call(_, a) | Node::Integral(a) => {
                (1, [a, none, none, none])
            }
            Node::Add(a, b)
            | Node::Sub(a, b)
            | Node::Mul(a, b)
            | Node::Div(a, b)
            | Node::Pow(a, b)
            | Node::Atan2(a, b) => (2, [a, b, none, none]),
            Node::Elliptic(f, operands) => (f.arity(), operands),
        };
        operands.into_iter().take(count)
    }
}

/// The arena of expressions and symbols.
#[derive(Clone, Debug, Default)]
pub struct Graph {
    nodes: IndexSet<Node, FxBuildHasher>,
    symbols: Vec<SymbolInfo>,
    names: HashMap<String, SymId>,
    derivatives: HashMap<(SymId, u32), SymId>,
    pub(super) bound: HashMap<SymId, super::integral::Bound>,
    deadline: Deadline,
    /// The most nodes, where that is less than [`MOST_NODES`].
    room: Option<usize>,
    cut: Option<Cut>,
}

/// Symbols.
impl Graph {
    /// An empty graph.
    pub fn new() -> Self {
        Self::default()
    }

    /// An empty graph that is cut short when the time is used up.
    pub fn until(deadline: Deadline) -> Self {
        Graph { deadline, ..Self::default() }
    }

    /// An empty graph that is cut short when it has so many nodes.
    pub fn with_room(nodes: usize) -> Self {
        Graph { room: Some(nodes.min(MOST_NODES)), ..Self::default() }
    }

    /// The moment at which the time is used up.
    pub fn deadline(&self) -> Deadline {
        self.deadline
    }

    /// Whether something could not be taken in, and why: what was built since is not to be used. Looks at the clock.
    pub fn cut_short(&mut self) -> Option<Cut> {
        if self.cut.is_none() && self.deadline.has_passed() {
            self.cut = Some(Cut::Time);
        }
        self.cut
    }

    /// The symbol of this name; a new one is constant in time.
    pub fn symbol(&mut self, name: &str) -> SymId {
        if let Some(&s) = self.names.get(name) {
            return s;
        }
        let s = SymId(self.symbols.len() as u32);
        self.symbols.push(SymbolInfo { name: name.to_owned(), base: s, order: 0, of_t: false });
        self.names.insert(name.to_owned(), s);
        s
    }

    /// The symbol of this name, which depends on time from now on (also where it was a constant before).
    pub fn time_symbol(&mut self, name: &str) -> SymId {
        let s = self.symbol(name);
        self.symbols[s.index()].of_t = true;
        s
    }

    /// The symbol of the time derivative of `s`: `\dot{\theta}` of `\theta`. What has a time derivative depends on
    /// time: a constant `s` becomes a time symbol.
    pub fn derivative_symbol(&mut self, s: SymId) -> SymId {
        let SymbolInfo { base, order, .. } = self.symbols[s.index()];
        self.nth_derivative_symbol(base, order.saturating_add(1))
    }

    /// The symbol of the time derivative of this order of `base`; `base` itself where the order is 0.
    ///
    /// Where its name is already that of an unrelated symbol, [`Graph::find`] goes on to find the latter.
    pub fn nth_derivative_symbol(&mut self, base: SymId, order: u32) -> SymId {
        let info = &self.symbols[base.index()];
        let (base, order) = (info.base, info.order.saturating_add(order));
        if order == 0 {
            return base;
        }
        self.symbols[base.index()].of_t = true;
        if let Some(&s) = self.derivatives.get(&(base, order)) {
            return s;
        }
        let s = SymId(self.symbols.len() as u32);
        let name = derivative_name(&self.symbols[base.index()].name, order);
        self.names.entry(name.clone()).or_insert(s);
        self.symbols.push(SymbolInfo { name, base, order, of_t: true });
        self.derivatives.insert((base, order), s);
        s
    }

    /// The number of symbols, derivatives included: [`SymId::index`] is below it.
    pub fn symbol_count(&self) -> usize {
        self.symbols.len()
    }

    /// What is known of a symbol of this graph.
    pub fn info(&self, s: SymId) -> &SymbolInfo {
        &self.symbols[s.index()]
    }

    /// The symbol of this name, if there is one.
    pub fn find(&self, name: &str) -> Option<SymId> {
        self.names.get(name).copied()
    }
}

/// `\dot{\theta}_{1}` for the first derivative of `\theta_{1}`, `\ddot` for the second, `\theta_{1}^{(3)}` and so on.
fn derivative_name(name: &str, order: u32) -> String {
    let accent = match order {
        1 => "\\dot",
        2 => "\\ddot",
        _ => return format!("{name}^{{({order})}}"),
    };
    let mut depth = 0_i32;
    let head = name.find(|c: char| {
        depth += i32::from(c == '{') - i32::from(c == '}');
        depth == 0 && matches!(c, '_' | '^' | '\'')
    });
    match head {
        Some(at) if at > 0 => format!("{accent}{{{}}}{}", &name[..at], &name[at..]),
        _ => format!("{accent}{{{name}}}"),
    }
}

/// Constructors.
impl Graph {
    pub(super) fn intern(&mut self, node: Node) -> Expr {
        if self.cut.is_some() {
            // Any expression will do for what is new: it is not to be used.
            return Expr(self.nodes.get_index_of(&node).unwrap_or(0) as u32);
        }
        let (index, is_new) = self.nodes.insert_full(node);
        if is_new && self.nodes.len() >= self.room.unwrap_or(MOST_NODES) {
            self.cut = Some(Cut::Size);
        } else if is_new && self.nodes.len().is_multiple_of(NODES_BETWEEN_LOOKS) {
            self.cut_short();
        }
        Expr(index as u32)
    }

    fn exact(&mut self, r: Option<Ratio>) -> Option<Expr> {
        r.map(|(n, d)| self.intern(Node::Rational(n, d)))
    }

    /// A symbol as an expression.
    pub fn sym(&mut self, s: SymId) -> Expr {
        self.intern(Node::Symbol(s))
    }

    /// An integer.
    pub fn int(&mut self, n: i64) -> Expr {
        self.intern(Node::Rational(n.into(), 1))
    }

    /// The fraction n/d; a quotient that no number type can evaluate where d is zero.
    pub fn ratio(&mut self, n: i128, d: i128) -> Expr {
        let folded = self.exact(ratio::reduce(n, d));
        folded.unwrap_or_else(|| {
            let (n, d) = (self.intern(Node::Rational(n, 1)), self.intern(Node::Rational(d, 1)));
            self.intern(Node::Div(n, d))
        })
    }

    /// The exact value of a decimal such as `0.0173`, `-12`, `6.674e-11`: a fraction where it fits one, otherwise an
    /// integer times a power of ten. `None` where the text is not a decimal.
    pub fn decimal(&mut self, text: &str) -> Option<Expr> {
        let (negative, text) = match text.strip_prefix('-') {
            Some(rest) => (true, rest),
            None => (false, text.strip_prefix('+').unwrap_or(text)),
        };
        let (mantissa, exponent) = match text.split_once(['e', 'E']) {
            Some((m, e)) => (m, e.parse::<i32>().ok()?),
            None => (text, 0),
        };
        let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
        let digits = format!("{whole}{fraction}");
        if digits.is_empty() || !digits.bytes().all(|b| b.is_ascii_digit()) {
            return None;
        }
        let significant = digits.trim_end_matches('0');
        let dropped = i32::try_from(digits.len() - significant.len()).ok()?;
        let scale = exponent.checked_sub(i32::try_from(fraction.len()).ok()?)?.checked_add(dropped)?;
        let magnitude = self.integer(significant)?;
        let value = self.scaled(magnitude, scale);
        Some(if negative { self.neg(value) } else { value })
    }

    /// The integer with these decimal digits (none: zero), by Horner's rule over blocks of digits that fit an i128.
    fn integer(&mut self, digits: &str) -> Option<Expr> {
        let mut value = self.int(0);
        for block in digits.as_bytes().chunks(30) {
            let block = std::str::from_utf8(block).ok()?;
            let shift = self.scaled_ten(i32::try_from(block.len()).ok()?);
            let digits = self.ratio(block.parse().ok()?, 1);
            let shifted = self.mul(value, shift);
            value = self.add(shifted, digits);
        }
        Some(value)
    }

    fn scaled_ten(&mut self, n: i32) -> Expr {
        let ten = self.int(10);
        self.powi(ten, n)
    }

    fn scaled(&mut self, mantissa: Expr, exponent: i32) -> Expr {
        let power = self.scaled_ten(exponent);
        self.mul(mantissa, power)
    }

    /// π.
    pub fn pi(&mut self) -> Expr {
        self.intern(Node::Pi)
    }

    /// e, the base of natural logarithms.
    pub fn e(&mut self) -> Expr {
        self.intern(Node::E)
    }

    /// a + b.
    pub fn add(&mut self, a: Expr, b: Expr) -> Expr {
        match (self.as_rational(a), self.as_rational(b)) {
            (Some((0, _)), _) => b,
            (_, Some((0, _))) => a,
            (Some(x), Some(y)) => {
                let folded = self.exact(ratio::add(x, y));
                folded.unwrap_or_else(|| self.intern(Node::Add(a.min(b), a.max(b))))
            }
            _ => self.intern(Node::Add(a.min(b), a.max(b))),
        }
    }

    /// a - b.
    pub fn sub(&mut self, a: Expr, b: Expr) -> Expr {
        if a == b {
            return self.int(0);
        }
        match (self.as_rational(a), self.as_rational(b)) {
            (Some((0, _)), _) => self.neg(b),
            (_, Some((0, _))) => a,
            (Some(x), Some(y)) => {
                let folded = self.exact(ratio::neg(y).and_then(|y| ratio::add(x, y)));
                folded.unwrap_or_else(|| self.intern(Node::Sub(a, b)))
            }
            _ => self.intern(Node::Sub(a, b)),
        }
    }

    /// a b.
    pub fn mul(&mut self, a: Expr, b: Expr) -> Expr {
        match (self.as_rational(a), self.as_rational(b)) {
            (Some((0, _)), _) | (_, Some((1, 1))) => a,
            (_, Some((0, _))) | (Some((1, 1)), _) => b,
            (Some(x), Some(y)) => {
                let folded = self.exact(ratio::mul(x, y));
                folded.unwrap_or_else(|| self.intern(Node::Mul(a.min(b), a.max(b))))
            }
            _ => self.intern(Node::Mul(a.min(b), a.max(b))),
        }
    }

    /// a / b.
    pub fn div(&mut self, a: Expr, b: Expr) -> Expr {
        match (self.as_rational(a), self.as_rational(b)) {
            (_, Some((0, _))) => self.intern(Node::Div(a, b)),
            (Some((0, _)), _) | (_, Some((1, 1))) => a,
            (Some(x), Some(y)) => {
                let folded = self.exact(ratio::recip(y).and_then(|y| ratio::mul(x, y)));
                folded.unwrap_or_else(|| self.intern(Node::Div(a, b)))
            }
            _ => self.intern(Node::Div(a, b)),
        }
    }

    /// -a.
    pub fn neg(&mut self, a: Expr) -> Expr {
        match self.nodes[a.index()] {
            Node::Neg(inner) => inner,
            Node::Rational(n, d) => {
                let folded = self.exact(ratio::neg((n, d)));
                folded.unwrap_or_else(|| self.intern(Node::Neg(a)))
            }
            _ => self.intern(Node::Neg(a)),
        }
    }

    /// aⁿ. `a⁰` is one.
    pub fn powi(&mut self, a: Expr, n: i32) -> Expr {
        match (n, self.nodes[a.index()]) {
            (0, _) => self.int(1),
            (1, _) => a,
            (_, Node::Rational(p, q)) => {
                let folded = self.exact(ratio::powi((p, q), n));
                folded.unwrap_or_else(|| self.intern(Node::PowI(a, n)))
            }
            (_, Node::PowI(base, m)) if !self.is_zero(base) => match m.checked_mul(n) {
                Some(product) => self.powi(base, product), // the base is not a power: this goes one level deep
                None => self.intern(Node::PowI(a, n)),
            },
            _ => self.intern(Node::PowI(a, n)),
        }
    }

    /// aᵇ. Integer and half-integer constant exponents become integer powers and square roots, e to a power the
    /// exponential function.
    pub fn pow(&mut self, a: Expr, b: Expr) -> Expr {
        let exponent = self.as_rational(b).and_then(|(n, d)| Some((i32::try_from(n).ok()?, d)));
        match exponent {
            Some((n, 1)) => self.powi(a, n),
            Some((n, 2)) => {
                let root = self.sqrt(a);
                self.powi(root, n)
            }
            _ if self.nodes[a.index()] == Node::E => self.call(Func::Exp, b),
            _ => self.intern(Node::Pow(a, b)),
        }
    }

    /// √a.
    pub fn sqrt(&mut self, a: Expr) -> Expr {
        let exact = self.as_rational(a).and_then(ratio::sqrt);
        let folded = self.exact(exact);
        folded.unwrap_or_else(|| self.intern(Node::Sqrt(a)))
    }

    /// A function of one variable. Its rational values at 0 and 1 are folded.
    pub fn call(&mut self, f: Func, a: Expr) -> Expr {
        use Func::*;
        let value = match (f, self.as_rational(a)) {
            (Sin | Tan | Asin | Atan | Sinh | Tanh | Asinh | Atanh, Some((0, _))) => Some((0, 1)),
            (Cos | Cosh | Exp, Some((0, _))) => Some((1, 1)),
            (Ln | Acos | Acosh, Some((1, 1))) => Some((0, 1)),
            (Abs, Some((n, d))) => n.checked_abs().map(|n| (n, d)),
            (Sign, Some((n, _))) => Some((n.signum(), 1)),
            _ => None,
        };
        let folded = self.exact(value);
        folded.unwrap_or_else(|| self.intern(Node::Call(f, a)))
    }

    /// The angle of the point (x, y), in (-π, π].
    pub fn atan2(&mut self, y: Expr, x: Expr) -> Expr {
        self.intern(Node::Atan2(y, x))
    }

    /// The sum of expressions; zero where there are none.
    pub fn sum(&mut self, terms: impl IntoIterator<Item = Expr>) -> Expr {
        let zero = self.int(0);
        terms.into_iter().fold(zero, |sum, term| self.add(sum, term))
    }

    /// The product of expressions; one where there are none.
    pub fn product(&mut self, factors: impl IntoIterator<Item = Expr>) -> Expr {
        let one = self.int(1);
        factors.into_iter().fold(one, |product, factor| self.mul(product, factor))
    }
}

/// Queries.
impl Graph {
    /// The operation at the top of an expression of this graph.
    pub fn node(&self, e: Expr) -> &Node {
        &self.nodes[e.index()]
    }

    /// The number of nodes stored.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Whether nothing is stored.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// Numerator and denominator of a rational constant.
    pub fn as_rational(&self, e: Expr) -> Option<(i128, i128)> {
        match *self.node(e) {
            Node::Rational(n, d) => Some((n, d)),
            _ => None,
        }
    }

    /// Whether the expression is the constant zero.
    pub fn is_zero(&self, e: Expr) -> bool {
        matches!(self.node(e), Node::Rational(0, _))
    }
}
