//! Pairing what opens with what closes.
//!
//! First braces, environments and `\left` with `\right`, of which every formula has as many of one as of the other; a
//! `\left[ .. \right.` that a row break forced its author to close and reopen is put together again. Then brackets and
//! bars, which LaTeX does not pair at all.

use super::ast::{Delim, Span};
use super::error::ParseError;
use super::token::{Environment, Side, Token, TokenKind};

/// How deep braces, brackets and environments may be nested.
pub(super) const DEEPEST: usize = 100;

/// Pairs braces, environments, `\left` and `\right`.
///
/// # Errors
/// One of them is not closed, or closes nothing.
pub(super) fn match_delimiters(source: &str, tokens: Vec<Token>) -> Result<Vec<Token>, ParseError> {
    let mut scopes = vec![Scope::default()];
    let mut open: Vec<usize> = vec![0];
    for (i, token) in tokens.iter().enumerate() {
        let inner = open.last().copied().unwrap_or(0);
        match token.kind {
            TokenKind::BraceOpen | TokenKind::Left(_) | TokenKind::Begin(_) => {
                if open.len() > DEEPEST {
                    return Err(too_deep(token.span.clone()));
                }
                open.push(scopes.len());
                scopes.push(Scope { open: i, ..Scope::default() });
            }
            TokenKind::BraceClose | TokenKind::Right(_) | TokenKind::End(_) => {
                let opener = (inner != 0).then(|| &tokens[scopes[inner].open]);
                check_pair(source, opener, token)?;
                open.pop();
                scopes[inner].close = i;
                let outer = open.last().copied().unwrap_or(0);
                scopes[outer].content.push(Content::Scope(inner));
            }
            TokenKind::Row => scopes[inner].content.push(Content::Row),
            _ => {}
        }
    }
    if let Some(&inner) = open.last().filter(|&&inner| inner != 0) {
        return Err(unclosed(source, &tokens[scopes[inner].open]));
    }
    Ok(without(&broken_pairs(&tokens, scopes), tokens))
}

/// What stands between a delimiter and its mate.
#[derive(Default)]
struct Scope {
    open: usize,
    close: usize,
    content: Vec<Content>,
}

#[derive(Clone, Copy)]
enum Content {
    Scope(usize),
    Row,
}

/// A `\left[ .. \right.` that waits for its `\left. .. \right]`.
struct Waiting {
    scopes: Vec<usize>,
    delim: Delim,
    rows: usize,
}

/// The tokens `\right.` and `\left.` that are there only because a row breaks between them.
fn broken_pairs(tokens: &[Token], mut scopes: Vec<Scope>) -> Vec<usize> {
    let mut superfluous = Vec::new();
    for outer in 0..scopes.len() {
        let mut waiting: Vec<Waiting> = Vec::new();
        let mut rows = 0;
        for content in std::mem::take(&mut scopes[outer].content) {
            let Content::Scope(inner) = content else {
                rows += 1;
                continue;
            };
            let (open, close) = (scopes[inner].open, scopes[inner].close);
            let last = waiting.last_mut().filter(|w| w.rows < rows);
            match (&tokens[open].kind, &tokens[close].kind) {
                (TokenKind::Left(Delim::None), TokenKind::Right(Delim::None)) => {
                    if let Some(last) = last {
                        last.scopes.push(inner);
                        last.rows = rows;
                    }
                }
                (TokenKind::Left(Delim::None), TokenKind::Right(delim)) => {
                    if last.is_some_and(|w| w.delim == *delim)
                        && let Some(mut whole) = waiting.pop()
                    {
                        whole.scopes.push(inner);
                        superfluous.extend(join(&mut scopes, &whole.scopes));
                    }
                }
                (TokenKind::Left(delim), TokenKind::Right(Delim::None)) if !ends_environment(tokens, close) => {
                    waiting.push(Waiting { scopes: vec![inner], delim: *delim, rows });
                }
                _ => {}
            }
        }
    }
    superfluous.sort_unstable();
    superfluous
}

/// Whether an environment ends right before the token: a brace before an array needs no mate.
fn ends_environment(tokens: &[Token], i: usize) -> bool {
    i.checked_sub(1).is_some_and(|before| matches!(tokens[before].kind, TokenKind::End(_)))
}

/// Makes one scope of several; gives the tokens between them.
fn join(scopes: &mut [Scope], parts: &[usize]) -> Vec<usize> {
    let Some((&first, others)) = parts.split_first() else { return Vec::new() };
    let mut between = Vec::new();
    for &part in others {
        let content = std::mem::take(&mut scopes[part].content);
        between.extend([scopes[first].close, scopes[part].open]);
        scopes[first].close = scopes[part].close;
        scopes[first].content.push(Content::Row);
        scopes[first].content.extend(content);
    }
    between
}

/// The tokens without those at the given places, which are in order.
fn without(places: &[usize], tokens: Vec<Token>) -> Vec<Token> {
    let mut places = places.iter().copied().peekable();
    let keep = |(i, token)| if places.next_if_eq(&i).is_some() { None } else { Some(token) };
    tokens.into_iter().enumerate().filter_map(keep).collect()
}

/// Checks that a closing token closes what is open.
fn check_pair(source: &str, opener: Option<&Token>, closer: &Token) -> Result<(), ParseError> {
    let found = &source[closer.span.clone()];
    let Some(opener) = opener else {
        let error = ParseError::new(format!("`{found}` closes nothing"), closer.span.clone());
        return Err(error.help(format!("remove it, or open it with {}", opening(closer.kind))));
    };
    let paired = match (opener.kind, closer.kind) {
        (TokenKind::Begin(_), TokenKind::End(_)) => {
            environment_name(source, opener) == environment_name(source, closer)
        }
        (TokenKind::BraceOpen, TokenKind::BraceClose) | (TokenKind::Left(_), TokenKind::Right(_)) => true,
        _ => false,
    };
    if paired {
        return Ok(());
    }
    let opened = &source[opener.span.clone()];
    let message = format!("`{opened}` (byte {}) is not closed before `{found}`", opener.span.start);
    Err(ParseError::new(message, closer.span.clone()).help(format!("close it with {}", closing(source, opener))))
}

/// The name of an environment, `aligned` in `\begin{aligned}[t]`.
fn environment_name<'a>(source: &'a str, token: &Token) -> &'a str {
    let text = &source[token.span.clone()];
    text.split_once('{').and_then(|(_, rest)| rest.split_once('}')).map_or("", |(name, _)| name.trim())
}

fn unclosed(source: &str, opener: &Token) -> ParseError {
    let opened = &source[opener.span.clone()];
    ParseError::new(format!("`{opened}` is never closed"), opener.span.clone())
        .help(format!("close it with {}", closing(source, opener)))
}

fn too_deep(span: Span) -> ParseError {
    ParseError::new(format!("nested more than {DEEPEST} deep"), span).help("split the formula")
}

fn opening(kind: TokenKind) -> &'static str {
    match kind {
        TokenKind::BraceClose => "`{`",
        TokenKind::Right(_) => "`\\left(` or `\\left.`",
        TokenKind::End(_) => "`\\begin{..}`",
        _ => "its mate",
    }
}

fn closing(source: &str, opener: &Token) -> String {
    match opener.kind {
        TokenKind::BraceOpen => "`}`".to_owned(),
        TokenKind::Left(_) => "`\\right)` or `\\right.`".to_owned(),
        TokenKind::Begin(_) => format!("`\\end{{{}}}`", environment_name(source, opener)),
        _ => "its mate".to_owned(),
    }
}

/// Pairs brackets, and gives every bar its part: it opens, closes, separates, or evaluates what stands before it.
///
/// # Errors
/// A bracket is not closed, or closes nothing.
pub(super) fn match_brackets(source: &str, mut tokens: Vec<Token>) -> Result<Vec<Token>, ParseError> {
    let mut open: Vec<usize> = Vec::new();
    for i in 0..tokens.len() {
        match tokens[i].kind {
            TokenKind::BraceOpen | TokenKind::Left(_) | TokenKind::Begin(_) | TokenKind::Open(_) => {
                if open.len() > DEEPEST {
                    return Err(too_deep(tokens[i].span.clone()));
                }
                open.push(i);
            }
            TokenKind::BraceClose | TokenKind::Right(_) | TokenKind::End(_) => {
                abandon_bars(source, &mut tokens, &mut open)?;
                if let Some(&bracket) = open.last().filter(|&&o| matches!(tokens[o].kind, TokenKind::Open(_))) {
                    return Err(unclosed_bracket(source, &tokens[bracket]));
                }
                open.pop();
            }
            TokenKind::Close(delim) => {
                abandon_bars(source, &mut tokens, &mut open)?;
                match open.last().map(|&o| tokens[o].kind) {
                    Some(TokenKind::Open(opener)) if compatible(opener, delim) => open.pop(),
                    _ => return Err(stray_bracket(source, &tokens[i])),
                };
            }
            TokenKind::Cell | TokenKind::Row => {
                abandon_bars(source, &mut tokens, &mut open)?;
                check_cell(source, &tokens, &open)?;
            }
            TokenKind::Bar { delim, side, sized } => place_bar(&mut tokens, &mut open, i, (delim, side, sized))?,
            _ => {}
        }
    }
    abandon_bars(source, &mut tokens, &mut open)?;
    match open.last() {
        Some(&bracket) => Err(unclosed_bracket(source, &tokens[bracket])),
        None => Ok(tokens),
    }
}

/// Whether the brackets make a pair: intervals may mix round and square ones.
fn compatible(open: Delim, close: Delim) -> bool {
    open == close || matches!((open, close), (Delim::Paren, Delim::Bracket) | (Delim::Bracket, Delim::Paren))
}

/// In a matrix a bracket ends with its cell.
fn check_cell(source: &str, tokens: &[Token], open: &[usize]) -> Result<(), ParseError> {
    let bracket = open.last().filter(|&&o| matches!(tokens[o].kind, TokenKind::Open(_)));
    let enclosing = open.iter().rev().map(|&o| tokens[o].kind).find(|kind| !matches!(kind, TokenKind::Open(_)));
    match (bracket, enclosing) {
        (Some(&bracket), Some(TokenKind::Begin(Environment::Matrix(_)))) => {
            Err(unclosed_bracket(source, &tokens[bracket]))
        }
        _ => Ok(()),
    }
}

/// Decides what a bar is by what stands around it.
fn place_bar(
    tokens: &mut [Token],
    open: &mut Vec<usize>,
    i: usize,
    (delim, side, sized): (Delim, Side, bool),
) -> Result<(), ParseError> {
    let after_operand = i > 0 && tokens[i - 1].kind.ends_operand();
    let before_script = matches!(tokens.get(i + 1), Some(t) if matches!(t.kind, TokenKind::Sub | TokenKind::Sup));
    let inner = open.last().map(|&o| tokens[o].kind);
    let (closes, inner_sized) = match inner {
        Some(TokenKind::Bar { delim: d, sized, .. }) => (d == delim, sized),
        _ => (false, false),
    };
    let evaluates = after_operand && before_script && delim == Delim::Bar;
    tokens[i].kind = match side {
        Side::Middle => TokenKind::Comma,
        Side::Close | Side::Either
            if closes && (after_operand || side == Side::Close) && (inner_sized || !(sized && evaluates)) =>
        {
            if let Some(opener) = open.pop() {
                tokens[opener].kind = TokenKind::Open(delim);
            }
            TokenKind::Close(delim)
        }
        Side::Close | Side::Either if evaluates => TokenKind::Evaluate,
        _ if open.len() > DEEPEST => return Err(too_deep(tokens[i].span.clone())),
        _ => {
            open.push(i);
            return Ok(());
        }
    };
    Ok(())
}

/// Bars that found no mate separate (`\langle a | b \rangle`) where they stand after an operand.
fn abandon_bars(source: &str, tokens: &mut [Token], open: &mut Vec<usize>) -> Result<(), ParseError> {
    while let Some(&bar) = open.last().filter(|&&o| matches!(tokens[o].kind, TokenKind::Bar { .. })) {
        open.pop();
        if bar == 0 || !tokens[bar - 1].kind.ends_operand() {
            return Err(unclosed_bracket(source, &tokens[bar]));
        }
        tokens[bar].kind = TokenKind::Comma;
    }
    Ok(())
}

fn unclosed_bracket(source: &str, opener: &Token) -> ParseError {
    let opened = &source[opener.span.clone()];
    ParseError::new(format!("`{opened}` is never closed"), opener.span.clone()).help("close it, or remove it")
}

fn stray_bracket(source: &str, closer: &Token) -> ParseError {
    let found = &source[closer.span.clone()];
    ParseError::new(format!("`{found}` closes nothing"), closer.span.clone()).help("open it, or remove it")
}
