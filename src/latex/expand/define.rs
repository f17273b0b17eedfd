//! Reading definitions: `\newcommand`, `\def`, `\DeclareMathOperator`, `\NewDocumentCommand`, `\DeclarePairedDelimiter`
//! and their like.

use super::super::ast::Span;
use super::super::error::ParseError;
use super::lexer::{Kind, lex};
use super::{Macro, Parameter};

/// The longest definition that is read, in bytes.
const LONGEST: usize = 1 << 12;

/// The length within which most definitions are.
const SHORT: usize = 200;

/// The most damaged definitions of notes that are looked at: beyond that none is read.
pub const MOST_FAULTS: usize = 200;

/// A macro with its name.
#[derive(Clone, Debug, PartialEq)]
pub struct Defined {
    /// Its name without the backslash.
    pub name: String,
    /// What it stands for.
    pub(super) meaning: Macro,
    /// Whether it is left alone where it exists: `\providecommand`.
    pub(super) unless_known: bool,
}

/// How a command defines.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Way {
    Command { unless_known: bool },
    Def,
    Let,
    Operator,
    Document { unless_known: bool },
    Delimiter { extended: bool },
    Unit,
}

fn way(name: &str) -> Option<Way> {
    Some(match name {
        "newcommand" | "renewcommand" | "DeclareRobustCommand" => Way::Command { unless_known: false },
        "providecommand" => Way::Command { unless_known: true },
        "def" | "gdef" | "edef" | "xdef" => Way::Def,
        "let" => Way::Let,
        "DeclareMathOperator" => Way::Operator,
        "NewDocumentCommand" | "RenewDocumentCommand" | "DeclareDocumentCommand" | "NewExpandableDocumentCommand" => {
            Way::Document { unless_known: false }
        }
        "ProvideDocumentCommand" => Way::Document { unless_known: true },
        "DeclarePairedDelimiter" => Way::Delimiter { extended: false },
        "DeclareSIUnit" => Way::Unit,
        "DeclarePairedDelimiterX" => Way::Delimiter { extended: true },
        _ => return None,
    })
}

/// Whether a macro (without its backslash) is one that defines.
pub fn is_definition(name: &str) -> bool {
    way(name).is_some()
}

/// The definition that a text begins with: its length in bytes, and what it defines. `None` where the text begins with
/// no command that defines.
///
/// # Errors
/// The definition is damaged, or of a kind that is not read (`#{` of `\def`); its place is in `text`.
pub fn definition(text: &str) -> Option<(usize, Result<Defined, ParseError>)> {
    // Most definitions are short, and only what is looked at takes time.
    within(text, SHORT).filter(|(_, defined)| defined.is_ok()).or_else(|| within(text, LONGEST))
}

/// The definition that a text begins with, no longer than so many bytes.
fn within(text: &str, longest: usize) -> Option<(usize, Result<Defined, ParseError>)> {
    let near = text.get(..text.floor_char_boundary(longest))?;
    let name: &str = near.strip_prefix('\\')?;
    let name = name.get(..name.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(name.len()))?;
    let way = way(name)?;
    let command = 0..1 + name.len();
    let tokens = lex(near.get(command.end..)?).into_iter();
    let tokens = tokens.map(|(kind, span)| (kind, span.start + command.end..span.end + command.end)).collect();
    let mut reader = Reader { text: near, tokens, at: 0 };
    let defined = reader.read(way);
    let length = reader.end().max(command.end);
    Some((length, defined.map_err(|fault| reader.error(&fault, command))))
}

/// What is wrong with a definition: words, and advice.
struct Fault(&'static str, &'static str);

/// Walks over the tokens of a definition.
struct Reader<'a> {
    text: &'a str,
    tokens: Vec<(Kind, Span)>,
    at: usize,
}

impl<'a> Reader<'a> {
    fn read(&mut self, way: Way) -> Result<Defined, Fault> {
        let starred = self.mark('*');
        if way == Way::Unit {
            self.between('[', ']');
        }
        let mut name = self.name()?;
        let simple = |parameters, body: &str| Macro { parameters, body: body.to_owned(), original: false };
        let (meaning, unless_known) = match way {
            Way::Command { unless_known } => {
                let parameters = self.parameters()?;
                (simple(parameters, self.group()?), unless_known)
            }
            Way::Def => {
                let parameters = self.plain_parameters()?;
                (simple(parameters, self.group()?), false)
            }
            Way::Let => (Macro { original: true, ..simple(Vec::new(), self.equal()?) }, false),
            Way::Operator => {
                let operator = if starred { "operatorname*" } else { "operatorname" };
                let words = self.group()?;
                (simple(Vec::new(), &format!("\\{operator}{{{words}}}")), false)
            }
            Way::Document { unless_known } => {
                let parameters = specification(self.group()?)?;
                (simple(parameters, self.group()?), unless_known)
            }
            Way::Delimiter { extended } => (self.delimiter(extended)?, false),
            Way::Unit => {
                self.between('[', ']');
                name = of_unit(&name);
                (simple(Vec::new(), self.group()?), false)
            }
        };
        Ok(Defined { name, meaning, unless_known })
    }

    /// The next token that is no blank.
    fn peek(&mut self) -> Option<(Kind, &'a str)> {
        while matches!(self.tokens.get(self.at), Some((Kind::Space | Kind::Comment, _))) {
            self.at += 1;
        }
        let (kind, span) = self.tokens.get(self.at)?;
        Some((*kind, self.text.get(span.clone())?))
    }

    fn mark(&mut self, c: char) -> bool {
        let found = self.peek().is_some_and(|(kind, text)| kind == Kind::Char && text.starts_with(c));
        self.at += usize::from(found);
        found
    }

    /// `{\name}` or `\name`.
    fn name(&mut self) -> Result<String, Fault> {
        let fault = Fault("a definition without the name of a macro", r"write \newcommand{\name}{..}");
        let braced = self.peek().is_some_and(|(kind, _)| kind == Kind::Open);
        self.at += usize::from(braced);
        let Some((Kind::Word, word)) = self.peek() else { return Err(fault) };
        self.at += 1;
        if braced {
            let Some((Kind::Close, _)) = self.peek() else { return Err(fault) };
            self.at += 1;
        }
        Ok(word.trim_start_matches('\\').to_owned())
    }

    /// What stands in braces; or a single token.
    fn group(&mut self) -> Result<&'a str, Fault> {
        match self.peek() {
            Some((Kind::Open, _)) => {
                self.between('{', '}').ok_or(Fault("a definition that is not closed", "add a `}`"))
            }
            // A bracket here is a default that is not closed.
            Some((Kind::Close, _) | (Kind::Char, "[")) | None => {
                Err(Fault("a definition that says not what the macro stands for", r"write \newcommand{\name}{..}"))
            }
            Some((_, text)) => {
                self.at += 1;
                Ok(text)
            }
        }
    }

    /// What stands between two delimiters, if the first is next; braces within it match.
    fn between(&mut self, open: char, close: char) -> Option<&'a str> {
        self.peek().filter(|(kind, text)| *kind != Kind::Escaped && text.starts_with(open))?;
        let start = self.tokens.get(self.at)?.1.end;
        let mut depth = 0_usize;
        for (ahead, (kind, span)) in self.tokens.iter().enumerate().skip(self.at + 1) {
            let closes = self.text.get(span.clone()).is_some_and(|text| text.starts_with(close));
            match kind {
                Kind::Char | Kind::Close if depth == 0 && closes => {
                    let inside = self.text.get(start..span.start);
                    self.at = ahead + 1;
                    return inside;
                }
                Kind::Open => depth += 1,
                Kind::Close => depth = depth.checked_sub(1)?,
                _ => {}
            }
        }
        None
    }

    /// `[2][default]` of `\newcommand`.
    fn parameters(&mut self) -> Result<Vec<Parameter>, Fault> {
        let Some(count) = self.between('[', ']') else { return Ok(Vec::new()) };
        let count: usize = count.trim().parse().ok().filter(|count| *count <= 9).ok_or(Fault(
            "a number of arguments from 0 to 9 is expected",
            r"write \newcommand{\name}[2]{.. #1 .. #2}",
        ))?;
        let mut parameters = vec![Parameter::Mandatory; count];
        if let (Some(default), Some(first)) = (self.between('[', ']'), parameters.first_mut()) {
            *first = Parameter::Optional('[', ']', Some(default.to_owned()));
        }
        Ok(parameters)
    }

    /// `#1#2` of `\def`; with signs that set them off, `[#1]` or `#1.`.
    fn plain_parameters(&mut self) -> Result<Vec<Parameter>, Fault> {
        let mut parameters = Vec::new();
        loop {
            let signs = self.signs();
            if !signs.is_empty() {
                let literal = parameters.pop().is_none();
                parameters.push(if literal { Parameter::Literal(signs) } else { Parameter::Until(signs) });
            }
            match self.peek() {
                Some((Kind::Parameter, _)) => parameters.push(Parameter::Mandatory),
                Some((Kind::Open, _)) => return Ok(parameters),
                _ => {
                    return Err(Fault(
                        r"a definition that says not what the macro stands for",
                        r"write \newcommand{\name}{..}",
                    ));
                }
            }
            self.at += 1;
        }
    }

    /// The tokens before the next parameter or brace, blanks left out.
    fn signs(&mut self) -> Vec<String> {
        let mut signs = Vec::new();
        while let Some((Kind::Char | Kind::Word | Kind::Escaped, text)) = self.peek() {
            signs.push(text.to_owned());
            self.at += 1;
        }
        signs
    }

    /// The macro after `\let\name=`.
    fn equal(&mut self) -> Result<&'a str, Fault> {
        self.mark('=');
        let found = self.peek();
        self.at += 1;
        found.map(|(_, text)| text).ok_or(Fault(r"\let without a macro to be equal to", r"write \let\name=\other"))
    }

    /// `{\lvert}{\rvert}` of `\DeclarePairedDelimiter`, `[1]{\lvert}{\rvert}{#1}` of its like with an X.
    fn delimiter(&mut self, extended: bool) -> Result<Macro, Fault> {
        let count = if extended { self.parameters()?.len().min(7) } else { 1 };
        let (open, close) = (self.group()?, self.group()?);
        let mut body = if extended { self.group()?.to_owned() } else { "#1".to_owned() };
        // The star and the size come first, and are of no account: both sides grow with what is between them.
        for number in (1..=count).rev() {
            body = body.replace(&format!("#{number}"), &format!("#{}", number + 2));
        }
        let mut parameters = vec![Parameter::Mark('*'), Parameter::Optional('[', ']', None)];
        parameters.extend(std::iter::repeat_n(Parameter::Mandatory, count));
        Ok(Macro { parameters, body: format!("\\left{open} {body} \\right{close}"), original: false })
    }

    /// Where the tokens end that have been passed.
    fn end(&self) -> usize {
        self.at.checked_sub(1).and_then(|last| self.tokens.get(last)).map_or(0, |(_, span)| span.end)
    }

    fn error(&self, fault: &Fault, command: Span) -> ParseError {
        ParseError::new(fault.0, command).help(fault.1)
    }
}

/// The name that a unit of the notes is kept by: units are no macros elsewhere (`\bar`).
pub(super) fn of_unit(name: &str) -> String {
    format!("unit {name}")
}

/// Reads the specification of a document command: `s o m`, `O{2} d() m`.
fn specification(text: &str) -> Result<Vec<Parameter>, Fault> {
    let fault = Fault("arguments of a kind that is not read", "read are m, o, O{..}, s, t, d, D, g and G");
    let mut parameters = Vec::new();
    let mut rest = text.trim_start();
    while let Some(kind) = rest.chars().next() {
        rest = rest.get(kind.len_utf8()..).unwrap_or_default();
        let mut sign = || {
            let c = rest.chars().next()?;
            rest = rest.get(c.len_utf8()..)?;
            Some(c)
        };
        let (open, close) = match kind {
            'm' | 'v' => {
                parameters.push(Parameter::Mandatory);
                (None, None)
            }
            's' => {
                parameters.push(Parameter::Mark('*'));
                (None, None)
            }
            't' => {
                parameters.push(Parameter::Mark(sign().ok_or(Fault(fault.0, fault.1))?));
                (None, None)
            }
            'o' | 'O' => (Some('['), Some(']')),
            'g' | 'G' => (Some('{'), Some('}')),
            'd' | 'D' => (sign(), sign()),
            '+' | '!' => (None, None),
            _ => return Err(fault),
        };
        if let (Some(open), Some(close)) = (open, close) {
            let default =
                if kind.is_ascii_uppercase() { Some(braced(&mut rest).ok_or(Fault(fault.0, fault.1))?) } else { None };
            parameters.push(Parameter::Optional(open, close, default));
        }
        rest = rest.trim_start();
    }
    if parameters.len() > 9 {
        Err(Fault("a macro takes at most nine arguments", "leave some out"))
    } else {
        Ok(parameters)
    }
}

/// Takes `{..}` from the beginning of a text.
fn braced(rest: &mut &str) -> Option<String> {
    let inside = rest.trim_start().strip_prefix('{')?;
    let mut depth = 0_usize;
    for (at, c) in inside.char_indices() {
        match c {
            '{' => depth += 1,
            '}' if depth == 0 => {
                *rest = inside.get(at + 1..)?;
                return inside.get(..at).map(str::to_owned);
            }
            '}' => depth -= 1,
            _ => {}
        }
    }
    None
}

/// A macro of a package, by its specification and its body.
pub(super) fn of_package(specified: &str, body: &str) -> Option<Macro> {
    let parameters = specification(specified).ok()?;
    Some(Macro { parameters, body: body.to_owned(), original: true })
}
