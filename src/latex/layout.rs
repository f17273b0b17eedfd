//! Which row breaks, alignment marks and wide spaces mean something.
//!
//! A row break within brackets is passed over, and so is one before a row that continues the row above. Outside
//! matrices an alignment mark is a wide space, and a wide space between two operands separates them like a comma.

use super::error::ParseError;
use super::token::{Environment, Token, TokenKind};

/// Leaves the row breaks, alignment marks and separating spaces (as [`TokenKind::Comma`]) that mean something.
///
/// # Errors
/// An alignment mark stands where there is nothing to align.
pub(super) fn lay_out(source: &str, mut tokens: Vec<Token>) -> Result<Vec<Token>, ParseError> {
    let keep = rows(source, &mut tokens)?;
    let mut kept: Vec<Token> = tokens.into_iter().zip(keep).filter(|(_, keep)| *keep).map(|(token, _)| token).collect();
    let separates = spaces(&kept);
    for (token, separates) in kept.iter_mut().zip(separates) {
        if separates {
            token.kind = TokenKind::Comma;
        }
    }
    kept.retain(|token| token.kind != TokenKind::Quad);
    Ok(kept)
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
    /// Whether an alignment mark stood before its first token.
    first_cell_empty: bool,
    /// Whether a token other than a space was seen, and the first was a binary operator.
    begun: bool,
    begins_with_operator: bool,
    has_relation: bool,
}

impl RowSoFar {
    /// Whether the row continues the one above.
    fn continues(&self) -> bool {
        self.begun && self.begins_with_operator && (self.first_cell_empty || !self.has_relation)
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
                place.row.first_cell_empty |= !place.row.begun;
                continue;
            }
            TokenKind::Row => {
                match place.kind {
                    PlaceKind::Rows => end_row(&mut keep, place, Some(i)),
                    PlaceKind::Cells | PlaceKind::Stack => {}
                    PlaceKind::Inside => keep[i] = false,
                }
                continue;
            }
            TokenKind::Quad => continue,
            _ => {}
        }
        let row = &mut place.row;
        if !row.begun {
            row.begun = true;
            row.begins_with_operator = matches!(kind, TokenKind::Sign(_) | TokenKind::Times(_));
        }
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

/// Decides on the break before the row that ends here, and begins the next.
fn end_row(keep: &mut [bool], place: &mut Place, break_at: Option<usize>) {
    if place.kind == PlaceKind::Rows
        && place.row.continues()
        && let Some(broken_at) = place.row.broken_at
    {
        keep[broken_at] = false;
    }
    place.row = RowSoFar { broken_at: break_at, ..RowSoFar::default() };
}

fn misplaced(source: &str, token: &Token) -> ParseError {
    let found = &source[token.span.clone()];
    ParseError::new(format!("`{found}` stands within braces, where there is nothing to align"), token.span.clone())
        .help("remove it, or write `\\&` for the sign")
}

/// Which wide spaces separate statements: those between two operands, outside brackets, that are not next to a text
/// only.
fn spaces(tokens: &[Token]) -> Vec<bool> {
    let next = next_tokens(tokens);
    let mut separates = vec![false; tokens.len()];
    // For every open delimiter: whether the statement so far holds more than texts, and ends with an operand.
    let mut statements = vec![Statement { open: true, ..Statement::default() }];
    for (i, token) in tokens.iter().enumerate() {
        let Some(statement) = statements.last_mut() else { break };
        match token.kind {
            TokenKind::Quad => {
                separates[i] = statement.open
                    && statement.has_operand
                    && statement.ends_operand
                    && next[i].is_some_and(|next| next.begins_operand() && next != TokenKind::Text);
                if separates[i] {
                    *statement = Statement { open: true, ..Statement::default() };
                }
            }
            TokenKind::Row | TokenKind::Cell | TokenKind::Comma | TokenKind::Mark(_) => {
                *statement = Statement { open: statement.open, ..Statement::default() };
            }
            kind if kind.closes() => {
                statements.pop();
                if let Some(outer) = statements.last_mut() {
                    outer.has_operand = true;
                    outer.ends_operand = true;
                }
            }
            kind => {
                statement.has_operand |= kind != TokenKind::Text;
                statement.ends_operand = kind.ends_operand();
                if kind.opens() {
                    statements.push(Statement { open: matches!(kind, TokenKind::Begin(_)), ..Statement::default() });
                }
            }
        }
    }
    separates
}

#[derive(Default)]
struct Statement {
    /// Whether it stands outside brackets.
    open: bool,
    has_operand: bool,
    ends_operand: bool,
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
