//! Factors side by side, scripts, and the macros that take arguments.

use super::{Parser, TokenKind};
use crate::latex::ast::{Accent, Delim, Font, Kind, Node, Span};
use crate::latex::characters::words;
use crate::latex::error::ParseError;

/// The scripts read so far.
#[derive(Default)]
struct Scripts {
    primes: u8,
    sub: Option<Box<Node>>,
    sup: Option<Box<Node>>,
}

impl Scripts {
    fn is_empty(&self) -> bool {
        self.primes == 0 && self.sub.is_none() && self.sup.is_none()
    }
}

impl Parser<'_> {
    /// Factors side by side, at least one.
    pub(super) fn juxtaposition(&mut self) -> Result<Node, ParseError> {
        let start = self.here();
        let mut factors = Vec::new();
        let mut evaluations = 0;
        loop {
            match self.peek() {
                Some(TokenKind::Evaluate) if !factors.is_empty() => {
                    let body = juxtaposed(std::mem::take(&mut factors), self.since(start));
                    self.advance();
                    let scripts = self.scripts()?;
                    evaluations += 1;
                    if evaluations > super::DEEPEST {
                        return Err(self.unexpected("fewer evaluations"));
                    }
                    factors.push(self.evaluated(body, scripts, start));
                }
                Some(kind) if kind.begins_operand() => match self.factor()? {
                    Node { kind: Kind::Juxt(inner), .. } => factors.extend(inner),
                    factor => factors.push(factor),
                },
                _ if factors.is_empty() => return Err(self.unexpected("an operand")),
                _ => return Ok(juxtaposed(factors, self.since(start))),
            }
        }
    }

    /// An operand with its scripts and factorials.
    fn factor(&mut self) -> Result<Node, ParseError> {
        let start = self.here();
        let mut node = match self.peek() {
            Some(TokenKind::Sub | TokenKind::Sup | TokenKind::Prime) => Node::new(Kind::Empty, start..start),
            _ => self.nested(Self::operand)?,
        };
        for _ in 0..super::DEEPEST {
            let scripts = self.scripts()?;
            if !scripts.is_empty() {
                if let Some(number) = self.number_around(&node, &scripts) {
                    node = number;
                }
                node = self.scripted(node, scripts, start);
            }
            let mut factorial = 0_u8;
            while self.peek() == Some(TokenKind::Bang) && factorial < u8::MAX {
                self.advance();
                factorial += 1;
            }
            if factorial == 0 {
                return Ok(node);
            }
            node = Node::new(Kind::Factorial(factorial, Box::new(node)), self.since(start));
        }
        Err(self.unexpected("fewer factorials"))
    }

    /// A base with its scripts; after `\left. .. \right|` they are a condition.
    fn scripted(&self, base: Node, scripts: Scripts, start: usize) -> Node {
        match base.kind {
            Kind::Group { open: Delim::None, close: Delim::Bar, body } => self.evaluated(*body, scripts, start),
            _ => {
                let Scripts { primes, sub, sup } = scripts;
                Node::new(Kind::Scripts { base: Box::new(base), primes, sub, sup }, self.since(start))
            }
        }
    }

    /// The number 5.3 in `5.''3` and `5^\circ.3`: astronomers print the unit at the decimal point. Reads the
    /// digits after the point; the number keeps the place of those before it.
    fn number_around(&mut self, node: &Node, scripts: &Scripts) -> Option<Node> {
        let Kind::Number(whole) = &node.kind else { return None };
        let degrees = matches!(scripts.sup.as_deref(), Some(Node { kind: Kind::Symbol(name), .. }) if name == "\\circ");
        let next = self.token().filter(|token| token.kind == TokenKind::Number && token.span.start == self.end)?;
        let before = self.text(&(node.span.end..next.span.start)).starts_with('.');
        let fraction = digits(self.text(&next.span));
        let (after, fraction) = fraction.strip_prefix('.').map_or((false, &*fraction), |fraction| (true, fraction));
        let point = before || after;
        let unit = (degrees && point && scripts.primes == 0) || (scripts.primes > 0 && scripts.sup.is_none());
        // `5'30''` is two numbers.
        let another_unit = !point && matches!(self.tokens.get(self.pos + 1), Some(t) if t.kind == TokenKind::Prime);
        let two_points = whole.contains('.') || fraction.contains('.') || (before && after);
        if !unit || another_unit || scripts.sub.is_some() || two_points {
            return None;
        }
        let number = format!("{whole}.{fraction}");
        self.advance();
        Some(Node::new(Kind::Number(number), node.span.clone()))
    }

    /// A body evaluated at a condition, or between two limits: these are the scripts of an empty base.
    fn evaluated(&self, body: Node, scripts: Scripts, start: usize) -> Node {
        let Scripts { primes, sub, sup } = scripts;
        let at = match (primes, sub, sup) {
            (0, Some(at), None) => at,
            (primes, sub, sup) => {
                let from = [&sub, &sup].into_iter().flatten().map(|script| script.span.start).min();
                let from = from.unwrap_or(self.end);
                let base = Box::new(Node::new(Kind::Empty, from..from));
                Box::new(Node::new(Kind::Scripts { base, primes, sub, sup }, self.since(from)))
            }
        };
        Node::new(Kind::At { body: Box::new(body), at }, self.since(start))
    }

    /// Primes, subscript and superscript in any order.
    fn scripts(&mut self) -> Result<Scripts, ParseError> {
        let mut scripts = Scripts::default();
        loop {
            match self.peek() {
                Some(TokenKind::Prime) => {
                    let span = self.advance();
                    self.add_primes(&mut scripts, 1, &span)?;
                }
                Some(TokenKind::Sub) => {
                    let span = self.advance();
                    let sub = self.argument("_")?;
                    if scripts.sub.is_some() {
                        return Err(double("subscript", span.start..self.end, "_"));
                    }
                    scripts.sub = Some(Box::new(sub));
                }
                Some(TokenKind::Sup) => {
                    let span = self.advance();
                    let sup = self.argument("^")?;
                    let (primes, rest) = split_primes(sup);
                    self.add_primes(&mut scripts, primes, &span)?;
                    if rest.is_some() && scripts.sup.is_some() {
                        return Err(double("superscript", span.start..self.end, "^"));
                    }
                    if let Some(rest) = rest {
                        scripts.sup = Some(Box::new(rest));
                    }
                }
                _ => return Ok(scripts),
            }
        }
    }

    fn add_primes(&self, scripts: &mut Scripts, primes: u8, span: &Span) -> Result<(), ParseError> {
        let too_many = || ParseError::new("more than 255 primes", span.clone());
        scripts.primes = scripts.primes.checked_add(primes).ok_or_else(too_many)?;
        Ok(())
    }

    /// A token as a symbol.
    pub(super) fn symbol(&mut self) -> Node {
        let span = self.advance();
        Node::new(Kind::Symbol(self.text(&span).to_owned()), span)
    }

    /// An operand without its scripts.
    fn operand(&mut self) -> Result<Node, ParseError> {
        let Some(kind) = self.peek() else { return Err(self.unexpected("an operand")) };
        match kind {
            TokenKind::Letter | TokenKind::Symbol => Ok(self.symbol()),
            TokenKind::Number => Ok(self.number()),
            TokenKind::Text => Ok(self.words()),
            TokenKind::Function => Ok(self.function()),
            TokenKind::BigOp(op) => Ok(Node::new(Kind::BigOp(op), self.advance())),
            TokenKind::Ellipsis => Ok(Node::new(Kind::Ellipsis, self.advance())),
            TokenKind::BraceOpen => self.braces(),
            TokenKind::Open(_) => self.brackets(),
            TokenKind::Left(_) => self.stretched(),
            TokenKind::Begin(environment) => self.environment(environment),
            TokenKind::Switch(font) => self.switched(font),
            _ => self.command(kind),
        }
    }

    /// A macro with arguments.
    fn command(&mut self, kind: TokenKind) -> Result<Node, ParseError> {
        let span = self.token().map(|token| token.span.clone()).unwrap_or_default();
        let name = self.text(&span);
        let start = span.start;
        let kind = match kind {
            TokenKind::Font(font) => return self.styled(font, name),
            TokenKind::Pass => {
                self.advance();
                return self.argument(name);
            }
            TokenKind::Substack => {
                self.advance();
                return self.argument(name);
            }
            TokenKind::Accent(accent) => self.accented(accent, name)?,
            TokenKind::Dots(count) => {
                self.advance();
                Kind::Dots(count, Box::new(self.argument(name)?))
            }
            TokenKind::Frac => {
                self.advance();
                let above = self.argument(name)?;
                Kind::Frac(Box::new(above), Box::new(self.argument(name)?))
            }
            TokenKind::Sqrt => self.root(name)?,
            TokenKind::Binom => self.binomial(name)?,
            TokenKind::Brace { over } => self.braced(over, name)?,
            TokenKind::Stack { over } => {
                self.advance();
                let note = Some(Box::new(self.argument(name)?));
                Kind::Annotated { body: Box::new(self.argument(name)?), note, over }
            }
            _ => return Err(self.unexpected("an operand")),
        };
        Ok(Node::new(kind, self.since(start)))
    }

    fn accented(&mut self, accent: Accent, name: &str) -> Result<Kind, ParseError> {
        self.advance();
        Ok(Kind::Accent(accent, Box::new(self.argument(name)?)))
    }

    fn number(&mut self) -> Node {
        let span = self.advance();
        Node::new(Kind::Number(digits(self.text(&span))), span)
    }

    /// `\text{..}`, or bare words.
    fn words(&mut self) -> Node {
        let span = self.advance();
        Node::new(Kind::Text(words(self.text(&span)).to_owned()), span)
    }

    fn function(&mut self) -> Node {
        let span = self.advance();
        let text = self.text(&span);
        let argument = words(text);
        let name: String = if argument.len() == text.len() {
            text.trim_start_matches('\\').to_owned()
        } else {
            // What else stands in the braces is spacing.
            argument.chars().filter(|c| c.is_alphanumeric() || matches!(c, '*' | '-')).collect()
        };
        Node::new(Kind::Function(name), span)
    }

    /// `\mathbf{r}`; several upright letters are the name of a function.
    fn styled(&mut self, font: Font, name: &str) -> Result<Node, ParseError> {
        let start = self.advance().start;
        let body = self.argument(name)?;
        Ok(Node::new(in_font(font, body), self.since(start)))
    }

    /// What follows `\rm` and the like, until the end of the group.
    fn switched(&mut self, font: Font) -> Result<Node, ParseError> {
        let start = self.advance().start;
        let body = if self.at_end() { self.empty() } else { self.juxtaposition()? };
        Ok(Node::new(in_font(font, body), self.since(start)))
    }

    fn root(&mut self, name: &str) -> Result<Kind, ParseError> {
        self.advance();
        let mut index = None;
        if self.peek() == Some(TokenKind::Open(Delim::Bracket)) {
            self.advance();
            index = Some(Box::new(self.list()?));
            self.close_bracket()?;
        }
        Ok(Kind::Sqrt { index, body: Box::new(self.argument(name)?) })
    }

    /// `\binom{n}{k}` is the function `binom` of a pair.
    fn binomial(&mut self, name: &str) -> Result<Kind, ParseError> {
        let span = self.advance();
        let from = self.here();
        let upper = self.argument(name)?;
        let lower = self.argument(name)?;
        let body = Node::new(Kind::List(vec![upper.clone(), lower.clone()]), upper.span.start..lower.span.end);
        let group = Kind::Group { open: Delim::Paren, close: Delim::Paren, body: Box::new(body) };
        let function = Node::new(Kind::Function("binom".to_owned()), span);
        Ok(Kind::Juxt(vec![function, Node::new(group, self.since(from))]))
    }

    /// `\underbrace{body}_{note}`
    fn braced(&mut self, over: bool, name: &str) -> Result<Kind, ParseError> {
        self.advance();
        let body = Box::new(self.argument(name)?);
        let mark = if over { TokenKind::Sup } else { TokenKind::Sub };
        let mut note = None;
        if self.peek() == Some(mark) {
            self.advance();
            note = Some(Box::new(self.argument(name)?));
        }
        Ok(Kind::Annotated { body, note, over })
    }

    /// The argument of a macro or script: what is in braces, or the next token.
    fn argument(&mut self, name: &str) -> Result<Node, ParseError> {
        match self.peek() {
            Some(TokenKind::BraceOpen) => self.braces(),
            Some(TokenKind::Number) if self.found().starts_with(|c: char| c.is_ascii_digit()) => Ok(self.digit()),
            Some(TokenKind::Sign(_) | TokenKind::Times(_)) => Ok(self.symbol()),
            Some(TokenKind::Open(_) | TokenKind::Left(_) | TokenKind::Begin(_) | TokenKind::Sub | TokenKind::Sup)
            | None => Err(self.lacks_argument(name)),
            Some(kind) if kind.begins_operand() => self.nested(Self::operand),
            Some(_) => Err(self.lacks_argument(name)),
        }
    }

    /// The first digit of a number: an argument without braces is one token to LaTeX, and a digit is a token.
    fn digit(&mut self) -> Node {
        let span = self.token().map(|token| token.span.clone()).unwrap_or_default();
        let digit = span.start..span.start + 1;
        if span.len() == 1 {
            self.advance();
        } else if let Some(token) = self.tokens.get_mut(self.pos) {
            token.span.start += 1;
            self.end = digit.end;
        }
        Node::new(Kind::Number(self.text(&digit).to_owned()), digit)
    }

    fn lacks_argument(&self, name: &str) -> ParseError {
        let found = match self.found() {
            "" => "the end of the formula".to_owned(),
            found => format!("`{found}`"),
        };
        let at = self.token().map_or(self.source.len()..self.source.len(), |token| token.span.clone());
        ParseError::new(format!("`{name}` lacks an argument: found {found}"), at)
            .help(format!("put the argument of `{name}` in braces: `{name}{{..}}`"))
    }
}

/// One factor is itself, several are a [`Kind::Juxt`].
fn juxtaposed(mut factors: Vec<Node>, span: Span) -> Node {
    match (factors.pop(), factors.is_empty()) {
        (Some(only), true) => only,
        (last, _) => {
            factors.extend(last);
            Node::new(Kind::Juxt(factors), span)
        }
    }
}

/// A body in a font; several upright letters side by side are the name of a function.
fn in_font(font: Font, body: Node) -> Kind {
    if font == Font::Roman {
        let letters = match &body.kind {
            Kind::Text(_) => letter(&body).map(str::to_owned),
            Kind::Juxt(factors) => factors.iter().map(letter).collect::<Option<String>>(),
            _ => None,
        };
        if let Some(name) = letters {
            return Kind::Function(name);
        }
    }
    Kind::Styled(font, Box::new(body))
}

fn letter(node: &Node) -> Option<&str> {
    match &node.kind {
        Kind::Symbol(word) | Kind::Text(word) if word.chars().all(char::is_alphabetic) => Some(word),
        _ => None,
    }
}

/// Splits the primes off a superscript: `^{\prime}`, `^{\prime 2}`.
fn split_primes(sup: Node) -> (u8, Option<Node>) {
    let is_prime = |node: &Node| matches!(&node.kind, Kind::Symbol(name) if name == "\\prime");
    match sup.kind {
        Kind::Symbol(ref name) if name == "\\prime" => (1, None),
        Kind::Scripts { ref base, primes, sub: None, sup: None } if base.kind == Kind::Empty => (primes, None),
        Kind::Juxt(mut factors) if factors.first().is_some_and(is_prime) => {
            let primes = factors.iter().take_while(|factor| is_prime(factor)).count().min(255);
            let rest = factors.split_off(primes);
            let start = rest.first().map_or(sup.span.end, |node| node.span.start);
            let rest = (!rest.is_empty()).then(|| juxtaposed(rest, start..sup.span.end));
            (u8::try_from(primes).unwrap_or(u8::MAX), rest)
        }
        _ => (0, Some(sup)),
    }
}

/// A number without the gaps between groups of digits.
fn digits(text: &str) -> String {
    text.chars().filter(|c| c.is_ascii_digit() || *c == '.').collect()
}

fn double(which: &str, span: Span, mark: &str) -> ParseError {
    ParseError::new(format!("a second {which}"), span)
        .help(format!("put the first in braces: `{{x{mark}a}}{mark}b`, or join them: `x{mark}{{a b}}`"))
}
