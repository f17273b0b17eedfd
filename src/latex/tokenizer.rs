//! Splitting a formula into tokens.

use super::ast::{Delim, MatrixEnv, Rel, Span};
use super::characters::{character, delimiter, group_of_three, is_blank, is_japanese};
use super::error::ParseError;
use super::macros::{self, Meaning};
use super::token::{Environment, Side, Token, TokenKind};

/// Splits a formula into tokens; blanks, comments, narrow spaces, sizes, labels and full stops are left out.
pub(super) fn tokenize(source: &str) -> Result<Vec<Token>, ParseError> {
    let mut lexer = Lexer { source, pos: 0, tokens: Vec::new() };
    while let Some(c) = lexer.peek() {
        lexer.token(c)?;
    }
    Ok(lexer.tokens)
}

struct Lexer<'a> {
    source: &'a str,
    pos: usize,
    tokens: Vec<Token>,
}

impl<'a> Lexer<'a> {
    fn rest(&self) -> &'a str {
        self.source.get(self.pos..).unwrap_or("")
    }

    fn peek(&self) -> Option<char> {
        self.rest().chars().next()
    }

    fn push(&mut self, kind: TokenKind, start: usize) {
        self.tokens.push(Token { kind, span: start..self.pos });
    }

    fn skip_while(&mut self, keep: impl Fn(char) -> bool) -> &'a str {
        let rest = self.rest();
        let end = rest.find(|c| !keep(c)).unwrap_or(rest.len());
        self.pos += end;
        &rest[..end]
    }

    fn token(&mut self, c: char) -> Result<(), ParseError> {
        let start = self.pos;
        match c {
            '\\' => return self.command(),
            '%' => {
                self.skip_while(|c| c != '\n');
            }
            '0'..='9' => self.number(),
            '.' if self.rest()[1..].starts_with(|c: char| c.is_ascii_digit()) => self.number(),
            'a'..='z' | 'A'..='Z' => self.letter(),
            ':' if self.rest().starts_with(":=") => {
                self.pos += 2;
                self.push(TokenKind::Relation(Rel::Equiv), start);
            }
            _ if is_japanese(c) => {
                self.skip_while(is_japanese);
                self.push(TokenKind::Text, start);
            }
            _ => {
                self.pos += c.len_utf8();
                match character(c) {
                    Some(kind) => self.push(kind, start),
                    None if is_blank(c) => {}
                    None if c.is_alphabetic() => self.push(TokenKind::Letter, start),
                    None => return Err(unexpected_character(c, start)),
                }
            }
        }
        Ok(())
    }

    /// Digits with at most one decimal point, and groups of three digits set off by `\,` or `{,}`.
    fn number(&mut self) {
        let start = self.pos;
        let digit = |c: char| c.is_ascii_digit();
        self.skip_while(digit);
        while let Some(gap) = ["\\,", "{,}"].iter().find_map(|gap| group_of_three(self.rest(), gap)) {
            self.pos += gap;
        }
        if self.rest().strip_prefix('.').is_some_and(|rest| rest.starts_with(digit)) {
            self.pos += 1;
            self.skip_while(digit);
        }
        self.push(TokenKind::Number, start);
    }

    /// A letter; the bare word `const` is no product of five letters.
    fn letter(&mut self) {
        let start = self.pos;
        let word = self.skip_while(|c| c.is_ascii_alphabetic());
        let after_digit_or_letter =
            matches!(self.tokens.last(), Some(t) if t.span.end == start && t.kind == TokenKind::Letter);
        if word == "const" && !after_digit_or_letter {
            return self.push(TokenKind::Text, start);
        }
        self.pos = start;
        for _ in word.bytes() {
            self.pos += 1;
            self.push(TokenKind::Letter, self.pos - 1);
        }
    }

    fn command(&mut self) -> Result<(), ParseError> {
        let start = self.pos;
        self.pos += 1;
        let mut name = self.skip_while(|c| c.is_ascii_alphabetic());
        if name.is_empty() {
            let Some(c) = self.peek() else {
                return Err(ParseError::new("a backslash at the end of the formula", start..self.pos));
            };
            name = &self.rest()[..c.len_utf8()];
            self.pos += c.len_utf8();
            if c.is_whitespace() {
                return Ok(());
            }
        } else if self.rest().starts_with('*') {
            self.star(name, start);
        }
        match macros::meaning(name) {
            Some(meaning) => self.interpret(meaning, start),
            None => Err(unknown_macro(name, start..self.pos)),
        }
    }

    /// Passes over the star of `\tag*` and the like.
    fn star(&mut self, name: &str, start: usize) {
        let starred = &self.source[start + 1..start + 1 + name.len() + 1];
        if macros::meaning(starred).is_some() {
            self.pos += 1;
        }
    }

    fn interpret(&mut self, meaning: Meaning, start: usize) -> Result<(), ParseError> {
        match meaning {
            Meaning::Token(kind) => {
                match kind {
                    TokenKind::Row => self.row_option(),
                    TokenKind::Stack { .. } if self.stacked_relation(start) => return Ok(()),
                    _ => {}
                }
                self.push(kind, start);
            }
            Meaning::Skip => {}
            Meaning::SkipArguments(count) => {
                for _ in 0..count {
                    self.raw_argument(start)?;
                }
            }
            Meaning::Text => {
                self.raw_argument(start)?;
                self.push(TokenKind::Text, start);
            }
            Meaning::OperatorName => {
                self.raw_argument(start)?;
                self.push(TokenKind::Function, start);
            }
            Meaning::Stretch(side) => self.stretch(side, start)?,
            Meaning::Sized(side) => self.sized(side, start),
            Meaning::Begin => self.environment(start, TokenKind::Begin)?,
            Meaning::End => self.environment(start, TokenKind::End)?,
            Meaning::Not => self.negated(start)?,
            Meaning::LabelledRelation(rel) => {
                self.raw_argument(start)?;
                self.push(TokenKind::Relation(rel), start);
            }
        }
        Ok(())
    }

    fn skip_blanks(&mut self) {
        self.skip_while(char::is_whitespace);
    }

    /// The spacing of `\\[2mm]` and the star of `\\*`.
    fn row_option(&mut self) {
        if self.rest().starts_with('*') {
            self.pos += 1;
        }
        let Some(option) = self.rest().strip_prefix('[') else { return };
        let length = option.trim_start_matches('-').starts_with(|c: char| c.is_ascii_digit() || c == '.');
        if let (true, Some(end)) = (length, option.find(']'))
            && end < 16
            && option[..end].ends_with(|c: char| c.is_ascii_alphabetic())
        {
            self.pos += end + 2;
        }
    }

    /// The argument in braces that follows, taken as it stands; gives its bytes without the braces.
    fn raw_argument(&mut self, start: usize) -> Result<&'a str, ParseError> {
        let span = start..self.pos;
        let name = &self.source[span.clone()];
        self.skip_blanks();
        let open = self.pos;
        if !self.rest().starts_with('{') {
            return Err(ParseError::new(format!("`{name}` lacks its argument in braces"), span)
                .help(format!("write `{name}{{..}}`")));
        }
        let Some(length) = braced_length(self.rest()) else {
            let message = format!("the brace after `{name}` is never closed");
            return Err(ParseError::new(message, open..open + 1).help("add a `}`"));
        };
        self.pos = open + length;
        Ok(&self.source[open + 1..self.pos - 1])
    }

    /// `\left` and the like with its delimiter.
    fn stretch(&mut self, side: Side, start: usize) -> Result<(), ParseError> {
        let span = start..self.pos;
        let name = &self.source[span.clone()];
        self.skip_blanks();
        let Some((delim, length)) = delimiter(self.rest()) else {
            let found = self.peek().map_or_else(|| "nothing".to_owned(), |c| format!("`{c}`"));
            return Err(ParseError::new(format!("expected a delimiter after `{name}`, found {found}"), span)
                .help(format!("write `{name}(` or `{name}.`")));
        };
        self.pos += length;
        let kind = match side {
            Side::Open => TokenKind::Left(delim),
            Side::Close => TokenKind::Right(delim),
            Side::Middle | Side::Either => TokenKind::Comma,
        };
        self.push(kind, start);
        Ok(())
    }

    /// `\Big` and the like: forgotten, except before a bar.
    fn sized(&mut self, side: Side, start: usize) {
        self.skip_blanks();
        if let Some((delim @ (Delim::Bar | Delim::DoubleBar), length)) = delimiter(self.rest()) {
            self.pos += length;
            self.push(TokenKind::Bar { delim, side, sized: true }, start);
        } else if self.rest().starts_with('.') {
            self.pos += 1;
        }
    }

    /// `\overset{..}{=}`: a relation. Under `def` an equality is a definition.
    fn stacked_relation(&mut self, start: usize) -> bool {
        let window = &self.rest()[..self.rest().floor_char_boundary(LONGEST_NOTE)];
        let Some((note, below, length)) = two_arguments(window) else { return false };
        let relation = match below.strip_prefix('\\') {
            Some(name) => macros::meaning(name),
            None => {
                below.chars().next().filter(|c| c.len_utf8() == below.len()).and_then(character).map(Meaning::Token)
            }
        };
        let Some(Meaning::Token(TokenKind::Relation(relation))) = relation else { return false };
        let defines = relation == Rel::Eq && note.contains("def");
        self.pos += length;
        self.push(TokenKind::Relation(if defines { Rel::Equiv } else { relation }), start);
        true
    }

    fn environment(&mut self, start: usize, kind: fn(Environment) -> TokenKind) -> Result<(), ParseError> {
        let argument = self.raw_argument(start)?;
        let name_end = self.pos - 1;
        let name = argument.trim().trim_end_matches('*');
        let environment = match name {
            "aligned" | "align" | "alignedat" | "alignat" | "gathered" | "gather" | "split" | "equation"
            | "multline" | "multlined" | "eqnarray" | "IEEEeqnarray" | "flalign" | "displaymath" | "math" => {
                Environment::Rows
            }
            "matrix" | "pmatrix" | "bmatrix" | "Bmatrix" | "smallmatrix" => Environment::Matrix(MatrixEnv::Matrix),
            "vmatrix" | "Vmatrix" => Environment::Matrix(MatrixEnv::Determinant),
            "array" | "subarray" => Environment::Matrix(MatrixEnv::Array),
            "cases" | "dcases" | "rcases" => Environment::Matrix(MatrixEnv::Cases),
            _ => {
                let span = name_end - argument.len()..name_end;
                return Err(ParseError::new(format!("unknown environment `{name}`"), span)
                    .help("use aligned, gathered, cases, array, pmatrix, bmatrix or vmatrix"));
            }
        };
        if matches!(kind(environment), TokenKind::Begin(_)) {
            if self.rest().starts_with('[') {
                self.skip_while(|c| c != ']');
                self.pos += usize::from(self.rest().starts_with(']'));
            }
            if matches!(name, "array" | "subarray" | "alignedat" | "alignat" | "IEEEeqnarray") {
                self.raw_argument(start)?;
            }
        }
        self.push(kind(environment), start);
        Ok(())
    }

    /// `\not=`
    fn negated(&mut self, start: usize) -> Result<(), ParseError> {
        self.skip_blanks();
        let negated = ["=", "\\equiv", "\\in", "\\parallel", "\\perp", "<", ">"];
        match negated.iter().find(|text| self.rest().starts_with(**text)) {
            Some(&text) if text == "=" || text == "\\equiv" => {
                self.pos += text.len();
                self.push(TokenKind::Relation(Rel::Ne), start);
                Ok(())
            }
            _ => Err(ParseError::new("`\\not` is only read before `=`", start..start + 4).help("write `\\neq`")),
        }
    }
}

/// The longest note that may stand above a relation, in bytes.
const LONGEST_NOTE: usize = 200;

/// The length of the braces that the text begins with.
fn braced_length(text: &str) -> Option<usize> {
    let mut depth = 0_usize;
    let mut escaped = false;
    for (i, c) in text.char_indices() {
        match c {
            _ if escaped => escaped = false,
            '\\' => escaped = true,
            '{' => depth += 1,
            '}' => depth = depth.checked_sub(1)?,
            _ => {}
        }
        if depth == 0 {
            return (c == '}').then_some(i + 1);
        }
    }
    None
}

/// The two arguments in braces that the text begins with, and their length.
fn two_arguments(text: &str) -> Option<(&str, &str, usize)> {
    let blanks = |from: usize| text[from..].len() - text[from..].trim_start().len();
    let first = blanks(0);
    let first_end = first + braced_length(&text[first..])?;
    let second = first_end + blanks(first_end);
    let second_end = second + braced_length(&text[second..])?;
    Some((&text[first + 1..first_end - 1], text[second + 1..second_end - 1].trim(), second_end))
}

fn unexpected_character(c: char, start: usize) -> ParseError {
    let error = ParseError::new(format!("`{c}` is not read in a formula"), start..start + c.len_utf8());
    match c {
        '$' => error.help("a `$` ends the formula: remove it"),
        '#' => error.help("write `\\#`"),
        _ => error.help("use the LaTeX macro for it, or put it in `\\text{..}`"),
    }
}

fn unknown_macro(name: &str, span: Span) -> ParseError {
    let error = ParseError::new(format!("unknown macro `\\{name}`"), span);
    if ["input", "include", "import", "subfile"].contains(&name) {
        return error.help("files are not read within a display: write its text here, or the whole display there");
    }
    match macros::suggestion(name) {
        Some(known) => error.help(format!("did you mean `\\{known}`?")),
        None => error.help(format!("write `\\operatorname{{{name}}}` if it is a function")),
    }
}
