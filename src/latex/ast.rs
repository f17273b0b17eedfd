//! The syntax tree of displayed mathematics.
//!
//! The tree is purely syntactic: it does not know which letters are functions, vectors or differentials. What stands
//! side by side is a [`Kind::Juxt`] of factors in which function names (`\sin`), big operators (`\sum`) and derivative
//! fractions (`\frac{d}{dt}`) are factors like any other, *not yet applied*: where an argument ends depends on what the
//! symbols are, and only `semantics/` knows that.

use std::ops::Range;

/// A range of bytes in the source that was parsed.
pub type Span = Range<usize>;

/// A node of the tree with its place.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// What it is.
    pub kind: Kind,
    /// Where it stands, in bytes from the beginning of the parsed source.
    pub span: Span,
}

/// What a [`Node`] is.
#[derive(Clone, Debug, PartialEq)]
pub enum Kind {
    /// Nothing: an empty group `{}`, `(\quad)`, the missing base of `{}_nC_2`.
    Empty,
    /// A decimal literal: `2`, `0.0173`, with no sign or exponent, and without gaps (`6\,378\,137` is `6378137`). The
    /// seconds of arc in `0.''2` are the primes of the number `0.2`.
    Number(String),
    /// A letter (`x`) or a symbol macro with its backslash (`\theta`, `\ell`, `\partial`, `\infty`, `\nabla`); also an
    /// operator that stands alone, as in `F^*`, `\alpha_-` and `(*)`.
    Symbol(String),
    /// A name printed upright that is applied to what follows: `\sin`, `\exp`, `\max`, `\operatorname{dn}`,
    /// `\mathrm{sn}`; without backslash. Powers and indices stand in a surrounding [`Kind::Scripts`].
    Function(String),
    /// A big operator, applied to what follows; its limits stand in a surrounding [`Kind::Scripts`].
    BigOp(BigOp),
    /// A letter in another font: `\mathbf{r}`, `\boldsymbol{\omega}`, `\mathcal{H}`.
    Styled(Font, Box<Node>),
    /// An accent over its body: `\vec{r}`, `\hat{n}`, `\bar{x}`.
    Accent(Accent, Box<Node>),
    /// Time derivatives printed as dots: `\dot{x}` is 1, `\ddot{x}` 2, `\dddot{x}` 3.
    Dots(u8, Box<Node>),
    /// Words: `\text{const.}`, `\mbox`, `\textrm`; also a run of Japanese outside `\text`, and the bare word `const`.
    Text(String),
    /// A base with primes, subscript and superscript in any order of writing; `x^{\prime}` is a prime.
    Scripts {
        /// What carries the scripts; [`Kind::Empty`] in `{}_nC_2`.
        base: Box<Node>,
        /// The number of primes.
        primes: u8,
        /// The subscript.
        sub: Option<Box<Node>>,
        /// The superscript, primes not included.
        sup: Option<Box<Node>>,
    },
    /// Factors side by side, two or more, none of them a `Juxt`; nothing is applied yet. `\binom{n}{k}` is the function
    /// `binom` and a group that holds a list of two.
    Juxt(Vec<Node>),
    /// Factors joined by visible operators, from left to right; binds weaker than [`Kind::Juxt`].
    Product {
        /// The first factor.
        first: Box<Node>,
        /// The operators and what follows them.
        rest: Vec<(ProductOp, Node)>,
    },
    /// Terms with their signs; the first sign is [`Sign::Plus`] with `None` where none is printed.
    Sum(Vec<Term>),
    /// `\frac{a}{b}`, also `\dfrac`, `\tfrac`, `a \over b`. Derivatives are fractions here: `\frac{d}{dt}`.
    Frac(Box<Node>, Box<Node>),
    /// `\sqrt[index]{body}`.
    Sqrt {
        /// The index where one is printed.
        index: Option<Box<Node>>,
        /// What stands under the root.
        body: Box<Node>,
    },
    /// A body within delimiters, with or without `\left`, `\right`; [`Delim::None`] is `\left.` or `\right.`.
    Group {
        /// The opening delimiter.
        open: Delim,
        /// The closing delimiter.
        close: Delim,
        /// What stands between them.
        body: Box<Node>,
    },
    /// What is separated by commas or semicolons: tuples within a group, several statements at the top. Outside brackets
    /// a wide space or an alignment mark between two operands separates too, and everywhere words between two operands
    /// that are no unit or alternative (`0 \text{ for } x = 1`); these words end the item before them.
    List(Vec<Node>),
    /// A chain of relations `a = b < c`.
    Chain {
        /// The first side; `None` where the row begins with the relation and so continues what stood before.
        first: Option<Box<Node>>,
        /// Each relation with its place and the side after it (`Empty` where nothing follows).
        links: Vec<Link>,
    },
    /// A matrix, determinant, array or column of cases, cell by cell.
    Matrix {
        /// Which environment.
        env: MatrixEnv,
        /// The rows of cells.
        rows: Vec<Vec<Node>>,
    },
    /// The rows of `aligned`, `align`, `gathered`, `split` and the like (alignment marks dropped), or of a bare source
    /// that holds `\\`. A row that begins with a binary operator in an empty first cell has been joined to the row
    /// above; a row break within brackets has been passed over. The span does not hold `\begin` and `\end`.
    Rows(Vec<Node>),
    /// A statement marked as `\therefore` or `\because`.
    Marked(Mark, Box<Node>),
    /// `\underbrace{body}_{note}`, `\overbrace{body}^{note}`, `\underset`, `\overset`.
    Annotated {
        /// The mathematics.
        body: Box<Node>,
        /// The note at the brace.
        note: Option<Box<Node>>,
        /// Whether the note stands above.
        over: bool,
    },
    /// `\dots`, `\cdots`, `\ldots`, `…`.
    Ellipsis,
    /// `n!` is 1, `n!!` is 2.
    Factorial(u8, Box<Node>),
    /// A body evaluated at a condition: `F|_{x = 0}`, `\left. F \right|_{x=0}`. The body before a bare bar is all that
    /// stands before it in its term.
    At {
        /// What is evaluated.
        body: Box<Node>,
        /// The condition; for limits, as in `F|_0^t`, the [`Kind::Scripts`] of an empty base.
        at: Box<Node>,
    },
}

/// A big operator.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BigOp {
    /// `\sum`
    Sum,
    /// `\prod`
    Product,
    /// `\int`
    Integral,
    /// `\iint`
    DoubleIntegral,
    /// `\oint`
    LoopIntegral,
}

/// A font that makes another letter of a letter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Font {
    /// `\mathbf`, `\boldsymbol`, `\bm`
    Bold,
    /// `\mathcal`
    Calligraphic,
    /// `\mathrm`, `\rm` around one letter or a word that is no function
    Roman,
    /// `\mathit`
    Italic,
    /// `\mathbb`
    Blackboard,
    /// `\mathfrak`
    Fraktur,
    /// `\mathsf`
    SansSerif,
    /// `\mathtt`
    Typewriter,
}

/// An accent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Accent {
    /// `\vec`, `\overrightarrow`
    Vector,
    /// `\hat`, `\widehat`
    Hat,
    /// `\bar`, `\overline`
    Bar,
    /// `\tilde`, `\widetilde`
    Tilde,
    /// `\check`, `\breve`, `\acute`, `\grave`, `\mathring`, `\underline` and the like
    Other,
}

/// A visible operator between factors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ProductOp {
    /// `\cdot`, `*`
    Dot,
    /// `\times`
    Cross,
    /// `/`, `\div`
    Slash,
    /// `\wedge`
    Wedge,
    /// `\otimes`
    Tensor,
    /// `\circ`, `\pm` in scripts and other rarities
    Other,
}

/// A sign before a term.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sign {
    /// `+`, or nothing before the first term
    Plus,
    /// `-`
    Minus,
    /// `\pm`
    PlusMinus,
    /// `\mp`
    MinusPlus,
}

/// A term of a [`Kind::Sum`].
#[derive(Clone, Debug, PartialEq)]
pub struct Term {
    /// Its sign.
    pub sign: Sign,
    /// Where the sign is printed, if it is.
    pub sign_span: Option<Span>,
    /// The term without the sign.
    pub node: Node,
}

/// One relation of a [`Kind::Chain`] with the side after it.
#[derive(Clone, Debug, PartialEq)]
pub struct Link {
    /// The relation.
    pub rel: Rel,
    /// Where it is printed.
    pub rel_span: Span,
    /// The side after it.
    pub rhs: Node,
}

/// A relation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Rel {
    /// `=`
    Eq,
    /// `\equiv`, `:=`, `\triangleq`
    Equiv,
    /// `\neq`, `\ne`
    Ne,
    /// `<`
    Lt,
    /// `>`
    Gt,
    /// `\le`, `\leq`, `\leqq`, `\leqslant`
    Le,
    /// `\ge`, `\geq`, `\geqq`, `\geqslant`
    Ge,
    /// `\ll`
    Ll,
    /// `\gg`
    Gg,
    /// `\approx`, `\simeq`, `\fallingdotseq`, `\doteq`
    Approx,
    /// `\sim`
    Sim,
    /// `\cong`
    Cong,
    /// `\propto`
    Propto,
    /// `\to`, `\rightarrow`, `\longrightarrow`, `\mapsto`
    To,
    /// `\leftarrow`
    From,
    /// `\leftrightarrow`
    Exchange,
    /// `\Rightarrow`, `\implies`, `\Longrightarrow`
    Implies,
    /// `\Leftarrow`
    ImpliedBy,
    /// `\Leftrightarrow`, `\iff`
    Iff,
    /// `\parallel`
    Parallel,
    /// `\perp`
    Perp,
    /// `\in`
    In,
    /// `:` between two sides, a ratio
    Ratio,
}

/// A delimiter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Delim {
    /// `\left.`, `\right.`
    None,
    /// `(`, `)`
    Paren,
    /// `[`, `]`
    Bracket,
    /// `\{`, `\}`
    Brace,
    /// `|`, `\vert`
    Bar,
    /// `\|`, `\Vert`
    DoubleBar,
    /// `\langle`, `\rangle`
    Angle,
    /// `\lfloor`, `\rfloor`
    Floor,
    /// `\lceil`, `\rceil`
    Ceil,
}

/// The environment of a [`Kind::Matrix`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MatrixEnv {
    /// `pmatrix`, `bmatrix`, `matrix`, `Bmatrix`
    Matrix,
    /// `vmatrix`
    Determinant,
    /// `array`, without delimiters of its own
    Array,
    /// `cases`
    Cases,
}

/// What marks a statement as conclusion or reason.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// `\therefore`
    Therefore,
    /// `\because`
    Because,
}

impl Node {
    /// A node of a kind at a place.
    pub fn new(kind: Kind, span: Span) -> Self {
        Node { kind, span }
    }
}
