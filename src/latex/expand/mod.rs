//! Macros: what notes define by `\newcommand` and the like, what packages in common use define, and their expansion.
//!
//! A formula is expanded before it is read, token by token as TeX would, and each token of the expanded text knows the
//! bytes of the formula that it comes from: what stands in an argument its own bytes, what stands in a macro's body the
//! macro's use. Promises:
//!
//! - a formula without macros to expand is passed on byte for byte;
//! - the expansion ends: macros nest at most [`DEEPEST`] deep, and at most [`MOST_TOKENS`] tokens are made; beyond that
//!   the formula is an error at the macro's use.
//!
//! A macro is, in order of precedence, what the notes define, what a package that the notes load makes of a name that
//! LaTeX knows otherwise (`\div`), what LaTeX itself knows (left to the tokenizer), and what a package defines that is
//! not known to be loaded.

mod argument;
mod define;
mod lexer;
mod packages;
mod siunitx;

#[cfg(test)]
mod tests;

pub use define::{Defined, MOST_FAULTS, definition, is_definition};

use std::collections::{HashMap, HashSet};
use std::sync::Arc;

use super::ast::Span;
use super::error::ParseError;
use super::macros;
use argument::Argument;
use lexer::{Kind, Token, lex};

/// The deepest that macros may stand in the bodies of macros.
pub const DEEPEST: u16 = 100;

/// The most tokens that the expansion of one formula may make.
pub const MOST_TOKENS: usize = 1 << 17;

/// What a macro takes before its body is put in its place, in the terms of LaTeX's `\NewDocumentCommand`.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Parameter {
    /// `m`: a token, or a group in braces.
    Mandatory,
    /// `s`, `t+`: whether this character stands there.
    Mark(char),
    /// `o`, `O{..}`, `d()`, `D(){..}`, `g`, `G{..}`: between these delimiters, if the first stands there; otherwise the
    /// default, if there is one.
    Optional(char, char, Option<String>),
    /// `#1.` of `\def`: all that stands before these tokens, which are taken, too.
    Until(Vec<String>),
    /// `[` before the first argument of `\def`: tokens that have to stand there, and are no argument.
    Literal(Vec<String>),
}

/// A macro.
#[derive(Clone, Debug, PartialEq)]
pub struct Macro {
    parameters: Vec<Parameter>,
    /// What it stands for; `#1` is its first argument.
    body: String,
    /// Whether its body means what LaTeX means by it, whatever the notes define.
    original: bool,
}

/// The definitions of notes, in the order in which they stand there.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Definitions {
    /// What each name stands for, from which definition on.
    defined: HashMap<String, Vec<(usize, Arc<Macro>)>>,
    packages: HashSet<String>,
    count: usize,
}

/// The macros in force at some place of the notes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Macros {
    all: Arc<Definitions>,
    /// The number of definitions that stand before that place.
    until: usize,
}

/// A formula with its macros expanded.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Expanded {
    /// The expanded LaTeX.
    pub text: String,
    /// Where each token begins in it, with the bytes of the formula that it comes from; none where nothing was expanded.
    origins: Vec<(usize, Span)>,
}

impl Expanded {
    /// A formula in which nothing was expanded.
    pub fn verbatim(text: &str) -> Self {
        Expanded { text: text.to_owned(), origins: Vec::new() }
    }

    /// Whether nothing was expanded.
    pub fn is_verbatim(&self) -> bool {
        self.origins.is_empty()
    }

    /// The bytes of the formula that a part of the expanded text comes from.
    pub fn place(&self, part: &Span) -> Span {
        let origin = |at: usize| {
            let after = self.origins.partition_point(|(start, _)| *start <= at);
            self.origins.get(after.saturating_sub(1)).map(|(_, origin)| origin.clone())
        };
        let (Some(first), Some(last)) = (origin(part.start), origin(part.end.saturating_sub(1).max(part.start))) else {
            return part.clone();
        };
        if part.start >= self.text.len() {
            return first.end..first.end;
        }
        first.start.min(last.start)..first.end.max(last.end)
    }
}

impl Definitions {
    /// Defines a macro, or defines it anew; `\providecommand` leaves one alone that exists.
    pub fn define(&mut self, defined: Defined) {
        let Defined { name, meaning, unless_known } = defined;
        if unless_known && (self.defined.contains_key(&name) || macros::meaning(&name).is_some()) {
            return;
        }
        // `\let` makes another name for what a macro of the notes stands for now.
        let copied = meaning.body.strip_prefix('\\').filter(|_| meaning.original).and_then(|name| self.latest(name));
        let meaning = copied.map_or_else(|| Arc::new(meaning), Arc::clone);
        self.count += 1;
        self.defined.entry(name).or_default().push((self.count, meaning));
    }

    /// Loads a package: it may give names another meaning than LaTeX's own.
    pub fn load(&mut self, package: &str) {
        self.packages.insert(package.to_owned());
    }

    /// The number of definitions.
    pub fn count(&self) -> usize {
        self.count
    }

    /// What a macro of the notes stands for, if it takes no arguments: `\begin{equation}` for `\beq`.
    pub fn shorthand(&self, name: &str) -> Option<&str> {
        self.latest(name).filter(|found| found.parameters.is_empty()).map(|found| found.body.trim())
    }

    fn latest(&self, name: &str) -> Option<&Arc<Macro>> {
        self.defined.get(name)?.last().map(|(_, found)| found)
    }
}

impl Macros {
    /// Those that the first so many definitions make.
    pub fn until(all: &Arc<Definitions>, until: usize) -> Self {
        Macros { all: Arc::clone(all), until }
    }

    /// Those of all definitions.
    pub fn all(all: &Definitions) -> Self {
        Macros { until: all.count, all: Arc::new(all.clone()) }
    }

    /// What a macro of the notes stands for.
    fn find(&self, name: &str) -> Option<&Macro> {
        let meanings = self.all.defined.get(name)?;
        let count = meanings.partition_point(|(number, _)| *number <= self.until);
        meanings.get(count.checked_sub(1)?).map(|(_, found)| &**found)
    }

    /// What a unit of the notes stands for (`\DeclareSIUnit`), by its name without the backslash.
    fn unit(&self, name: &str) -> Option<&str> {
        self.find(&define::of_unit(name)).map(|found| found.body.as_str())
    }

    /// Whether a package is loaded.
    fn has_package(&self, package: &str) -> bool {
        self.all.packages.contains(package)
    }

    /// Expands the macros of a formula.
    ///
    /// # Errors
    /// A macro lacks an argument, or the expansion does not end or becomes too long. The error's place is in `source`.
    pub fn expand(&self, source: &str) -> Result<Expanded, ParseError> {
        if !self.may_expand(source) {
            return Ok(Expanded::verbatim(source));
        }
        let tokens = lex(source);
        if !tokens.iter().any(|(kind, span)| *kind == Kind::Word && self.expands(&source[span.clone()])) {
            return Ok(Expanded::verbatim(source));
        }
        let mut expander =
            Expander { macros: self, waiting: Vec::new(), made: 0, expanded: Expanded::default(), after_word: false };
        let tokens = tokens.into_iter().rev();
        let token =
            |(kind, origin): (Kind, Span)| Token { text: &source[origin.clone()], kind, origin, ..Token::new("") };
        expander.waiting.extend(tokens.map(token));
        expander.run()?;
        Ok(expander.expanded)
    }

    /// Whether anything behind a backslash may have to be expanded: a first look that costs little.
    fn may_expand(&self, source: &str) -> bool {
        source.match_indices('\\').any(|(at, _)| {
            let rest = &source[at..];
            let end = rest[1..].find(|c: char| !c.is_ascii_alphabetic() && c != '@').map_or(rest.len(), |end| end + 1);
            end > 1 && self.expands(&rest[..end])
        })
    }

    /// Whether a macro (with its backslash) may have to be expanded.
    fn expands(&self, word: &str) -> bool {
        let name = word.get(1..).unwrap_or_default();
        self.find(name).is_some() || packages::find(name).is_some()
    }
}

/// What stands for a macro.
enum Meaning<'a> {
    Macro(&'a Macro),
    Rule(packages::Rule),
}

/// An expansion on its way.
pub(super) struct Expander<'a> {
    macros: &'a Macros,
    /// What is still to be read, the next token last.
    waiting: Vec<Token<'a>>,
    /// The number of tokens that macros' bodies and arguments have made.
    made: usize,
    expanded: Expanded,
    /// Whether the last token written is the name of a macro.
    after_word: bool,
}

impl<'a> Expander<'a> {
    fn run(&mut self) -> Result<(), ParseError> {
        while let Some(token) = self.waiting.pop() {
            match self.meaning(&token) {
                None => self.emit(&token),
                Some(_) if token.depth >= DEEPEST => return Err(endless(&token)),
                Some(Meaning::Macro(found)) => self.apply(found, &token)?,
                Some(Meaning::Rule(rule)) => rule(self, &token)?,
            }
            if self.made > MOST_TOKENS {
                return Err(endless(&token));
            }
        }
        Ok(())
    }

    /// What a macro stands for, where it stands.
    fn meaning(&self, token: &Token<'a>) -> Option<Meaning<'a>> {
        if token.kind != Kind::Word {
            return None;
        }
        let name = token.text.get(1..)?;
        if let Some(found) = self.macros.find(name).filter(|_| !token.from_package) {
            return Some(Meaning::Macro(found));
        }
        let found = packages::find(name)?;
        let own = macros::meaning(name).is_none() || (!token.from_package && found.is_meant(self));
        own.then_some(match &found.meaning {
            packages::Meaning::Macro(found) => Meaning::Macro(found),
            packages::Meaning::Rule(rule) => Meaning::Rule(*rule),
        })
    }

    /// Puts a macro's body in its place.
    fn apply(&mut self, found: &'a Macro, token: &Token<'a>) -> Result<(), ParseError> {
        let mut arguments = Vec::with_capacity(found.parameters.len());
        for parameter in &found.parameters {
            match parameter {
                Parameter::Literal(signs) => self.literal(signs, token)?,
                _ => arguments.push(self.argument(parameter, token)?),
            }
        }
        let of_package = token.from_package || found.original;
        self.put(&found.body, &arguments, token, of_package);
        Ok(())
    }

    /// Puts a body with arguments in the place of a macro.
    pub(super) fn put(&mut self, body: &'a str, arguments: &[Argument<'a>], token: &Token<'a>, from_package: bool) {
        let mut made: Vec<Token<'a>> = Vec::new();
        for (kind, span) in lex(body) {
            let text = &body[span];
            if kind == Kind::Parameter {
                let number = text.bytes().last().map_or(0, |digit| usize::from(digit.wrapping_sub(b'1')));
                made.extend(arguments.get(number).map(Argument::tokens).unwrap_or_default());
            } else if kind != Kind::Comment {
                let (origin, depth) = (token.origin.clone(), token.depth + 1);
                made.push(Token { text, kind, origin, depth, from_package });
            }
            if self.made + made.len() > MOST_TOKENS {
                break;
            }
        }
        self.made += made.len().max(1);
        self.waiting.extend(made.into_iter().rev());
    }

    /// Writes a text in the place of a macro.
    fn write(&mut self, text: &str, token: &Token) {
        self.made += text.len();
        self.emit(&Token { text, kind: Kind::Char, origin: token.origin.clone(), ..Token::new("") });
    }

    /// Writes a token that is not expanded, set off from a macro before it whose name it would prolong.
    fn emit(&mut self, token: &Token) {
        let text = &mut self.expanded.text;
        if matches!(token.kind, Kind::NoValue | Kind::True | Kind::Comment) {
            return;
        }
        if token.text.starts_with(|c: char| c.is_ascii_alphabetic()) && self.after_word {
            text.push(' ');
        }
        self.expanded.origins.push((text.len(), token.origin.clone()));
        text.push_str(token.text);
        self.after_word = token.kind == Kind::Word;
    }
}

fn endless(token: &Token) -> ParseError {
    let message = format!("the expansion of `{}` does not end, or is longer than any formula", token.text);
    ParseError::new(message, token.origin.clone()).help("does the macro use itself? See its definition")
}
