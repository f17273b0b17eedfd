//! Which row breaks, alignment marks and wide spaces mean something.
//!
//! A row break within brackets is passed over, and so is one before a row that continues the row above. Outside
//! matrices an alignment mark is a wide space, and a wide space between two operands separates them like a comma.

use super::ast::Sign;
use super::characters::{is_japanese, words};
use super::error::ParseError;
use super::token::{Environment, Token, TokenKind};

/// Leaves the row breaks and alignment marks that mean something; what separates statements, printed or not, becomes a
/// [`TokenKind::Comma`].
///
/// # Errors
/// An alignment mark stands where there is nothing to align.
pub(super) fn lay_out(source: &str, mut tokens: Vec<Token>) -> Result<Vec<Token>, ParseError> {
    let keep = rows(source, &mut tokens)?;
    let kept: Vec<Token> = tokens.into_iter().zip(keep).filter(|(_, keep)| *keep).map(|(token, _)| token).collect();
    Ok(separated(source, kept))
}

/// Where a token stands.
struct Place {
    kind: PlaceKind,
    /// Whether alignment marks may stand here: not directly within braces.
    aligned: bool,
    row: RowSoFar,
}

#[derive(Clone, Copy, PartialEq)]
enum PlaceKind {
    /// The source itself or `aligned`: rows of statements.
    Rows,
    /// A matrix: rows of cells.
    Cells,
    /// `\substack`: its rows are a list.
    Stack,
    /// Brackets or braces: rows mean nothing.
    Inside,
}

/// What is known of the row that is being read.
#[derive(Default)]
struct RowSoFar {
    /// The row break before it.
    broken_at: Option<usize>,
    /// Whether the row before it ends with an operator or a relation, whose right side is this row.
    awaited: bool,
    /// Whether an alignment mark stood before its first token.
    first_cell_empty: bool,
    /// Its first token other than a space or an alignment mark.
    first: Option<TokenKind>,
    has_mark: bool,
    has_relation: bool,
}

impl RowSoFar {
    /// Whether the row continues the one above: that one waits for an operand, or this one begins with an operator and
    /// states nothing of its own. Where nothing is aligned, only a minus may begin a statement.
    fn continues(&self) -> bool {
        if self.awaited && !matches!(self.first, None | Some(TokenKind::Relation(_))) {
            return true;
        }
        let stays_open = self.first_cell_empty || !self.has_relation;
        match self.first {
            Some(TokenKind::Sign(Sign::Minus)) => stays_open,
            Some(TokenKind::Sign(_) | TokenKind::Times(_)) => stays_open || !self.has_mark,
            _ => false,
        }
    }
}

/// Which tokens stay: all but the row breaks and alignment marks that mean nothing.
fn rows(source: &str, tokens: &mut [Token]) -> Result<Vec<bool>, ParseError> {
    let mut keep = vec![true; tokens.len()];
    let mut places = vec![Place { kind: PlaceKind::Rows, aligned: true, row: RowSoFar::default() }];
    for i in 0..tokens.len() {
        let Some(place) = places.last_mut() else { break };
        let kind = tokens[i].kind;
        match kind {
            TokenKind::Cell if !place.aligned => return Err(misplaced(source, &tokens[i])),
            TokenKind::Cell => {
                if place.kind != PlaceKind::Cells {
                    tokens[i].kind = TokenKind::Quad;
                }
                place.row.first_cell_empty |= place.row.first.is_none();
                place.row.has_mark = true;
                continue;
            }
            TokenKind::Row => {
                match place.kind {
                    PlaceKind::Rows => end_row(&mut keep, place, Some((i, awaits(tokens, i)))),
                    PlaceKind::Cells | PlaceKind::Stack => {}
                    PlaceKind::Inside => keep[i] = false,
                }
                continue;
            }
            TokenKind::Quad => continue,
            _ => {}
        }
        let row = &mut place.row;
        row.first = row.first.or(Some(kind));
        row.has_relation |= matches!(kind, TokenKind::Relation(_));
        let aligned = place.aligned;
        let mut enter = |kind, aligned| places.push(Place { kind, aligned, row: RowSoFar::default() });
        match kind {
            TokenKind::Begin(Environment::Rows) => enter(PlaceKind::Rows, true),
            TokenKind::Begin(Environment::Matrix(_)) => enter(PlaceKind::Cells, true),
            TokenKind::BraceOpen if i > 0 && tokens[i - 1].kind == TokenKind::Substack => {
                enter(PlaceKind::Stack, false)
            }
            TokenKind::BraceOpen => enter(PlaceKind::Inside, false),
            TokenKind::Open(_) | TokenKind::Left(_) => enter(PlaceKind::Inside, aligned),
            kind if kind.closes() => {
                if let Some(mut closed) = places.pop() {
                    end_row(&mut keep, &mut closed, None);
                }
            }
            _ => {}
        }
    }
    while let Some(mut place) = places.pop() {
        end_row(&mut keep, &mut place, None);
    }
    Ok(keep)
}

/// Decides on the break before the row that ends here, and begins the next, after a break at a place and perhaps after
/// an operator.
fn end_row(keep: &mut [bool], place: &mut Place, next: Option<(usize, bool)>) {
    if place.kind == PlaceKind::Rows
        && place.row.continues()
        && let Some(broken_at) = place.row.broken_at
    {
        keep[broken_at] = false;
    }
    place.row = RowSoFar {
        broken_at: next.map(|(at, _)| at),
        awaited: next.is_some_and(|(_, awaited)| awaited),
        ..RowSoFar::default()
    };
}

/// Whether an operator or a relation stands before a row break; one that is a script, as in `F^*`, awaits nothing.
fn awaits(tokens: &[Token], row: usize) -> bool {
    let mut before = tokens[..row].iter().rev().map(|token| token.kind).filter(|kind| *kind != TokenKind::Quad);
    let last = before.next();
    let script = matches!(before.next(), Some(TokenKind::Sub | TokenKind::Sup));
    let open = matches!(last, Some(TokenKind::Sign(_) | TokenKind::Times(_) | TokenKind::Relation(_)));
    open && !script
}

fn misplaced(source: &str, token: &Token) -> ParseError {
    let found = &source[token.span.clone()];
    ParseError::new(format!("`{found}` stands within braces, where there is nothing to align"), token.span.clone())
        .help("remove it, or write `\\&` for the sign")
}

/// A statement so far.
#[derive(Default)]
struct Statement {
    /// Whether it stands outside brackets, where wide spaces separate.
    open: bool,
    /// Whether it holds more than texts.
    has_operand: bool,
    ends_operand: bool,
}

impl Statement {
    /// Whether something that may separate does so: between two operands.
    fn separates(&self, next: Option<TokenKind>) -> bool {
        let begins = next.is_some_and(|next| next.begins_operand() && next != TokenKind::Text);
        self.has_operand && self.ends_operand && begins
    }
}

/// Puts commas where a wide space, a text or the end of aligned rows separates statements, and leaves out the spaces.
fn separated(source: &str, tokens: Vec<Token>) -> Vec<Token> {
    let next = next_tokens(&tokens);
    let mut separated = Vec::with_capacity(tokens.len());
    let mut statements = vec![Statement { open: true, ..Statement::default() }];
    for (token, next) in tokens.into_iter().zip(next) {
        let Some(statement) = statements.last_mut() else { break };
        let Token { kind, span } = token.clone();
        let mut comma = None;
        match kind {
            TokenKind::Quad => comma = (statement.open && statement.separates(next)).then_some(span),
            TokenKind::Row | TokenKind::Cell | TokenKind::Comma | TokenKind::Mark(_) => {
                *statement = Statement { open: statement.open, ..Statement::default() };
            }
            TokenKind::Text => {
                let between = statement.separates(next) && joins_statements(words(&source[span.clone()]));
                comma = between.then_some(span.end..span.end);
                statement.ends_operand = true;
            }
            _ if kind.closes() => {
                statements.pop();
                let Some(outer) = statements.last_mut() else { break };
                outer.has_operand = true;
                outer.ends_operand = true;
                let rows_end = kind == TokenKind::End(Environment::Rows);
                comma = (rows_end && outer.open && outer.separates(next)).then_some(span.end..span.end);
            }
            _ => {
                statement.has_operand = true;
                statement.ends_operand = kind.ends_operand() || kind == TokenKind::Function;
                if kind.opens() {
                    statements.push(Statement { open: matches!(kind, TokenKind::Begin(_)), ..Statement::default() });
                }
            }
        }
        if kind != TokenKind::Quad {
            separated.push(token);
        }
        if let (Some(span), Some(statement)) = (comma, statements.last_mut()) {
            *statement = Statement { open: statement.open, ..Statement::default() };
            separated.push(Token { kind: TokenKind::Comma, span });
        }
    }
    separated
}

/// Whether a text joins two statements rather than naming a unit or an alternative: Japanese words, `for`, `where`.
pub(super) fn joins_statements(text: &str) -> bool {
    let words = text.trim();
    let alternative = ["または", "又は", "あるいは", "もしくは", "の"].contains(&words);
    let conjunction =
        ["for", "if", "when", "where", "and", "i.e.", "since", "because", "so", "then", "with", "as", "thus"];
    words.contains([',', '，', '、'])
        || conjunction.contains(&words.trim_end_matches(':'))
        || (words.chars().any(is_japanese) && !alternative)
}

/// For each token the kind of the next that is no space.
fn next_tokens(tokens: &[Token]) -> Vec<Option<TokenKind>> {
    let mut next = vec![None; tokens.len()];
    let mut last = None;
    for (i, token) in tokens.iter().enumerate().rev() {
        next[i] = last;
        if token.kind != TokenKind::Quad {
            last = Some(token.kind);
        }
    }
    next
}
