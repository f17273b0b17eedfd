//! What a formula is made of before it is read.

use super::ast::{Accent, BigOp, Delim, Font, Mark, MatrixEnv, ProductOp, Rel, Sign, Span};

/// A token with its place.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Token {
    /// What it is.
    pub kind: TokenKind,
    /// Its bytes in the source.
    pub span: Span,
}

/// On which side of its body a delimiter stands, where that is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    Open,
    Close,
    Middle,
    Either,
}

/// The environments that hold rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Environment {
    /// `aligned` and the like: rows of statements, whose alignment marks mean nothing.
    Rows,
    /// Rows of cells.
    Matrix(MatrixEnv),
}

/// What a [`Token`] is; its letters are read from the source.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum TokenKind {
    /// One letter.
    Letter,
    /// A macro that is a symbol.
    Symbol,
    /// Digits, perhaps with a decimal point.
    Number,
    /// `\text{..}` or a run of Japanese.
    Text,
    /// `\sin`, `\operatorname{..}`
    Function,
    BigOp(BigOp),
    Ellipsis,
    Relation(Rel),
    Sign(Sign),
    Times(ProductOp),
    /// `,` `;`, a bar in the middle, and (after the layout) a wide space that separates statements.
    Comma,
    /// `\quad`, `\qquad`
    Quad,
    Mark(Mark),
    /// `!`
    Bang,
    /// `'`
    Prime,
    /// `_`
    Sub,
    /// `^`
    Sup,
    /// `{`
    BraceOpen,
    /// `}`
    BraceClose,
    /// `(` and the like; after the matching also an opening bar.
    Open(Delim),
    /// `)` and the like; after the matching also a closing bar.
    Close(Delim),
    /// `\left(`
    Left(Delim),
    /// `\right)`
    Right(Delim),
    /// A bar whose part is not known yet.
    Bar {
        delim: Delim,
        side: Side,
        sized: bool,
    },
    /// A bar at which what stands before it is evaluated.
    Evaluate,
    Begin(Environment),
    End(Environment),
    /// `&`
    Cell,
    /// `\\`
    Row,
    Font(Font),
    /// `\rm`, `\bf`: a font until the end of the group.
    Switch(Font),
    Accent(Accent),
    Dots(u8),
    Frac,
    /// `\over`
    Over,
    Sqrt,
    Binom,
    Substack,
    /// `\underbrace`, `\overbrace`
    Brace {
        over: bool,
    },
    /// `\underset`, `\overset`
    Stack {
        over: bool,
    },
    /// A macro that prints its argument as it is.
    Pass,
}

impl TokenKind {
    /// Whether it opens a pair.
    pub(super) fn opens(self) -> bool {
        use TokenKind as T;
        matches!(self, T::BraceOpen | T::Open(_) | T::Left(_) | T::Begin(_))
    }

    /// Whether it closes a pair.
    pub(super) fn closes(self) -> bool {
        use TokenKind as T;
        matches!(self, T::BraceClose | T::Close(_) | T::Right(_) | T::End(_))
    }

    /// Whether an operand may end with it.
    pub(super) fn ends_operand(self) -> bool {
        use TokenKind as T;
        self.closes() || matches!(self, T::Letter | T::Symbol | T::Number | T::Text | T::Ellipsis | T::Bang | T::Prime)
    }

    /// Whether an operand may begin with it.
    pub(super) fn begins_operand(self) -> bool {
        use TokenKind as T;
        let ends = matches!(
            self,
            T::Relation(_)
                | T::Sign(_)
                | T::Times(_)
                | T::Comma
                | T::Quad
                | T::Mark(_)
                | T::Bang
                | T::Evaluate
                | T::Cell
                | T::Row
                | T::Over
                | T::Bar { .. }
        );
        !ends && !self.closes()
    }
}
