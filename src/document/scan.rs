//! Finding the displays and the HTML comments of a Markdown text, before its Markdown is read.
//!
//! A Markdown parser takes displays for Markdown: a line of a formula that begins with `+ ` becomes a list. They are
//! therefore found first, in one pass in which whatever opens first wins. Displays are `$$ .. $$`, `\[ .. \]`, and
//! `\begin{equation} .. \end{equation}` and its like, starred or not. A display may hold blank lines as long as
//! mathematics follows them. Where prose follows, or a heading, or an inline formula, or another display opens, the
//! display was not closed: it ends at that blank line, and what comes after it is read as if nothing had happened. A
//! `$$` opens rather than closes if it stands first in its line, mathematics follows it, and it is closed in that line or
//! stands below a blank line.

use super::layout::environment_arguments;
use super::place::Span;
use super::problem::Problem;

/// Environments that are displays by themselves.
const DISPLAY_ENVIRONMENTS: [&str; 9] =
    ["equation", "align", "alignat", "flalign", "gather", "multline", "eqnarray", "displaymath", "dmath"];

/// What was found in the text.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Found {
    /// A display.
    Display {
        /// From delimiter to delimiter.
        span: Span,
        /// What stands between the delimiters.
        content: Span,
        /// The environment, for `\begin{align}` and the like.
        environment: Option<String>,
        /// The label that stands beside it, as in `$$ .. $$ {#eq-foo}`, and its place.
        name: Option<(String, Span)>,
    },
    /// An HTML comment.
    Comment {
        /// From `<!--` to `-->`.
        span: Span,
        /// What stands between them.
        content: Span,
    },
    /// A display or comment that is damaged and has been reported.
    Broken {
        /// As far as it has been passed over.
        span: Span,
    },
}

impl Found {
    pub(super) fn span(&self) -> &Span {
        match self {
            Found::Display { span, .. } | Found::Comment { span, .. } | Found::Broken { span } => span,
        }
    }
}

/// Finds the displays and comments of a text. `code` are the ranges of its code blocks and code spans, in order.
pub(super) fn scan(source: &str, code: &[Span]) -> (Vec<Found>, Vec<Problem>) {
    let mut scanner =
        Scanner { source, last_comment_end: source.rfind("-->"), found: Vec::new(), problems: Vec::new() };
    let mut code = code.iter().peekable();
    let mut at = 0;
    while let Some((opener, start)) = scanner.next_opener(at) {
        while code.next_if(|span| span.end <= start).is_some() {}
        at = match code.peek().filter(|span| span.contains(&start)) {
            Some(inside) => inside.end,
            None => scanner.read(opener, start),
        };
    }
    (scanner.found, scanner.problems)
}

/// What opens a display or comment.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Opener<'a> {
    Dollars,
    Bracket,
    Environment(&'a str),
    Comment,
}

impl Opener<'_> {
    fn text(self) -> String {
        match self {
            Opener::Dollars => "$$".to_owned(),
            Opener::Bracket => r"\[".to_owned(),
            Opener::Environment(name) => format!(r"\begin{{{name}}}"),
            Opener::Comment => "<!--".to_owned(),
        }
    }

    fn closer(self) -> String {
        match self {
            Opener::Dollars => "$$".to_owned(),
            Opener::Bracket => r"\]".to_owned(),
            Opener::Environment(name) => format!(r"\end{{{name}}}"),
            Opener::Comment => "-->".to_owned(),
        }
    }
}

struct Scanner<'a> {
    source: &'a str,
    /// The last `-->`: no comment that opens after it is closed.
    last_comment_end: Option<usize>,
    found: Vec<Found>,
    problems: Vec<Problem>,
}

impl<'a> Scanner<'a> {
    fn from(&self, at: usize) -> &'a str {
        self.source.get(at..).unwrap_or_default()
    }

    /// The next delimiter that opens something, at or after a place. Escaped characters are passed over.
    fn next_opener(&self, mut at: usize) -> Option<(Opener<'a>, usize)> {
        loop {
            at += self.from(at).find(['$', '\\', '<'])?;
            let rest = self.from(at);
            if rest.starts_with("$$") {
                return Some((Opener::Dollars, at));
            } else if rest.starts_with("<!--") {
                return Some((Opener::Comment, at));
            } else if let Some(name) = display_environment(rest, r"\begin{") {
                return Some((Opener::Environment(name), at));
            } else if rest.starts_with(r"\[") && self.is_bracket_display(at) {
                return Some((Opener::Bracket, at));
            }
            at += if rest.starts_with('\\') { escaped(rest) } else { 1 };
        }
    }

    /// `\[` is a display at the beginning of a line. Within a line it may be Markdown for a bracket that is no link: there
    /// it is a display only if it is closed on the same line and holds a macro or a relation.
    fn is_bracket_display(&self, at: usize) -> bool {
        if self.begins_line(at) {
            return true;
        }
        let rest = self.from(at + 2);
        let near = rest.get(..rest.floor_char_boundary(2000)).unwrap_or_default();
        let near = near.split('\n').next().and_then(|line| line.split(r"\[").next()).unwrap_or_default();
        near.split_once(r"\]").is_some_and(|(inside, _)| inside.contains(['\\', '=', '<', '>']))
    }

    /// Whether only blanks and marks of quotes and lists stand before a place in its line.
    fn begins_line(&self, at: usize) -> bool {
        let before = self.source.get(..at).unwrap_or_default();
        let marks = |c: char| matches!(c, ' ' | '\t' | '>' | '-' | '*' | '+' | '\u{feff}');
        matches!(before.trim_end_matches(marks).chars().next_back(), None | Some('\n' | '\r'))
    }

    /// Reads what an opener opens; where to go on.
    fn read(&mut self, opener: Opener<'a>, start: usize) -> usize {
        let inner = start + opener.text().len();
        let inner = match opener {
            Opener::Environment(name) => inner + environment_arguments(name, self.from(inner)),
            _ => inner,
        };
        let Some(close) = self.closing(opener, inner) else { return self.unclosed(opener, start, inner) };
        let span = start..close + opener.closer().len();
        let end = span.end;
        let content = inner..close;
        let blank = self.source.get(content.clone()).is_none_or(|content| content.trim().is_empty());
        self.found.push(match opener {
            Opener::Comment => Found::Comment { span, content },
            _ if blank => {
                let problem = Problem::warning("document::empty_display", "this display is empty", span.clone());
                self.problems.push(problem.help("write the formula, or remove the display"));
                Found::Broken { span }
            }
            Opener::Environment(name) => {
                Found::Display { span, content, environment: Some(name.to_owned()), name: None }
            }
            _ => Found::Display { span, content, environment: None, name: None },
        });
        end
    }

    /// Where the closing delimiter stands, if there is one before something else opens or prose begins.
    fn closing(&self, opener: Opener<'a>, inner: usize) -> Option<usize> {
        if opener == Opener::Comment {
            return self.comment_end(inner);
        }
        let mut at = inner;
        loop {
            at += self.from(at).find(['$', '\\'])?;
            let rest = self.from(at);
            let closes = match opener {
                Opener::Environment(name) => display_environment(rest, r"\end{") == Some(name),
                Opener::Bracket => rest.starts_with(r"\]"),
                _ => rest.starts_with("$$"),
            };
            if closes {
                return (!self.is_left_open(opener, inner, at)).then_some(at);
            }
            let opens_another = match opener {
                Opener::Dollars | Opener::Comment => false,
                Opener::Bracket => rest.starts_with("$$") || rest.starts_with(r"\["),
                Opener::Environment(_) => {
                    rest.starts_with("$$") || rest.starts_with(r"\[") || display_environment(rest, r"\begin{").is_some()
                }
            };
            if opens_another {
                return None;
            }
            at += if rest.starts_with('\\') { escaped(rest) } else { 1 };
        }
    }

    /// Where a comment's `-->` stands. A comment may hold `<!--`, but not an annotation: its own end was forgotten.
    fn comment_end(&self, inner: usize) -> Option<usize> {
        let last = self.last_comment_end.filter(|last| *last >= inner)?;
        let content = self.source.get(inner..last + 3)?;
        let is_directive = directive(content).is_some();
        let mut at = 0;
        loop {
            at += content.get(at..)?.find(['<', '-'])?;
            let rest = content.get(at..)?;
            if rest.starts_with("-->") {
                return Some(inner + at);
            } else if is_directive && rest.starts_with("<!--") {
                return None;
            }
            at += 1;
        }
    }

    /// Whether the closing delimiter at `close` cannot belong to the display that begins at `inner`: prose stands between
    /// them, or it is a `$$` that opens a display itself.
    fn is_left_open(&self, opener: Opener, inner: usize, close: usize) -> bool {
        let content = self.source.get(inner..close).unwrap_or_default();
        let prose = blank_line(content).is_some_and(|(_, after)| is_prose(content.get(after..).unwrap_or_default()));
        let begins_line = content.contains('\n') && self.begins_line(close);
        if prose || opener != Opener::Dollars || !begins_line {
            return prose;
        }
        let rest = self.from(close + 2);
        let line = rest.lines().next().unwrap_or_default();
        let is_closed_in_line = line.matches("$$").count() % 2 == 1 && !line.trim_start().starts_with("$$");
        (is_closed_in_line || ends_with_blank_line(content)) && begins_with_mathematics(rest)
    }

    /// The next blank line or opening of a display or comment.
    fn recovery(&self, inner: usize) -> usize {
        let mut at = inner;
        while let Some(ahead) = self.from(at).find(['\n', '$', '\\', '<']) {
            at += ahead;
            let rest = self.from(at);
            let opens = ["$$", r"\[", "<!--"].iter().any(|opener| rest.starts_with(opener));
            if opens || display_environment(rest, r"\begin{").is_some() || begins_with_blank_line(rest) {
                return at;
            }
            at += if rest.starts_with('\\') { escaped(rest) } else { 1 };
        }
        self.source.len()
    }

    /// Reports what is not closed and passes over it, up to the next blank line or display; where to go on.
    fn unclosed(&mut self, opener: Opener<'a>, start: usize, inner: usize) -> usize {
        let end = self.recovery(inner);
        let content = self.source.get(inner..end).unwrap_or_default();
        let (text, closer) = (opener.text(), opener.closer());
        let what = match opener {
            Opener::Comment if directive(content).is_some() => "this annotation",
            Opener::Comment => "this comment",
            _ => "this display",
        };
        let problem = Problem::error("document::unclosed", format!("{what} is not closed"), start..start + text.len());
        self.problems.push(
            problem.label("opened here").help(format!(
                "close it with `{closer}`; it has been passed over up to the next blank line or display"
            )),
        );
        self.found.push(Found::Broken { span: start..end });
        end
    }
}

/// The name in `\begin{align*}` (or `\end{..}`, by `command`) that a text begins with, if it is a display.
fn display_environment<'a>(text: &'a str, command: &str) -> Option<&'a str> {
    let (name, _) = super::layout::argument(text.strip_prefix(command.trim_end_matches('{'))?, 20)?;
    DISPLAY_ENVIRONMENTS.contains(&name.strip_suffix('*').unwrap_or(name)).then_some(name)
}

/// The length of a backslash with the character that it escapes.
fn escaped(text: &str) -> usize {
    1 + text.chars().nth(1).filter(|c| *c != '\n').map_or(0, char::len_utf8)
}

/// What follows `kenzan` in a comment that is an annotation.
pub(super) fn directive(comment: &str) -> Option<&str> {
    let rest = comment.trim_start().strip_prefix("kenzan")?;
    (rest.is_empty() || rest.starts_with(char::is_whitespace)).then_some(rest)
}

/// The first blank line of a text: where the line before it ends, and where the line after it begins.
fn blank_line(text: &str) -> Option<(usize, usize)> {
    let mut at = 0;
    let mut end_before: Option<usize> = None;
    for line in text.split_inclusive('\n') {
        let blank = line.trim_matches(|c: char| c.is_whitespace() || c == '>').is_empty();
        match end_before {
            Some(end) if blank && line.ends_with('\n') => return Some((end, at + line.len())),
            _ => end_before = line.ends_with('\n').then_some(at + line.len() - 1),
        }
        at += line.len();
    }
    None
}

/// Whether a text begins with a line break and a blank line.
fn begins_with_blank_line(text: &str) -> bool {
    let Some(rest) = text.strip_prefix('\n') else { return false };
    rest.trim_start_matches(|c: char| c == '>' || (c.is_whitespace() && c != '\n')).starts_with('\n')
}

/// Whether the last line but the one that a text ends in is blank.
fn ends_with_blank_line(text: &str) -> bool {
    let mut lines = text.rsplit('\n').skip(1);
    let is_blank = |line: &str| line.trim_matches(|c: char| c.is_whitespace() || c == '>').is_empty();
    lines.next().is_some_and(is_blank) && lines.next().is_some()
}

/// Whether what follows a `$$` looks like the content of a display and not like the text after one.
fn begins_with_mathematics(text: &str) -> bool {
    let content = text.split("$$").next().unwrap_or_default();
    let end =
        if begins_with_blank_line(content) { 0 } else { blank_line(content).map_or(content.len(), |(end, _)| end) };
    let content = content.get(..end).unwrap_or_default();
    let is_empty = content.trim_matches(|c: char| c.is_whitespace() || ",.;:。、，．".contains(c)).is_empty();
    !is_empty && !is_prose(content)
}

/// Whether a text that stands where mathematics is expected is prose: a heading after a blank line, code, a comment, an inline formula, two
/// words side by side, or a run of Japanese, words within `\text{..}` and the like aside.
fn is_prose(text: &str) -> bool {
    let mut after_blank = true;
    let has_marks = text.lines().any(|line| {
        let line = line.trim_start_matches([' ', '\t', '>']);
        let heading = line.trim_start_matches('#');
        let is_heading = after_blank && heading.len() < line.len() && heading.starts_with(' ');
        after_blank = line.trim().is_empty();
        is_heading || ["```", "~~~", "<!--"].iter().any(|mark| line.starts_with(mark))
    });
    has_marks || has_words(text)
}

/// Whether a text holds a dollar, two words of two letters or more side by side, or four letters of a script that is
/// written without spaces, outside of the arguments of macros for text.
fn has_words(text: &str) -> bool {
    let mut at = 0;
    let (mut words, mut letters, mut ideographs) = (0, 0, 0);
    while let Some(c) = text.get(at..).and_then(|rest| rest.chars().next()) {
        if c == '\\' {
            at += macro_with_text(text.get(at..).unwrap_or_default());
            (words, letters, ideographs) = (0, 0, 0);
            continue;
        }
        at += c.len_utf8();
        ideographs = if c >= '\u{3040}' && c.is_alphabetic() { ideographs + 1 } else { 0 };
        if c.is_alphabetic() && c < '\u{3040}' {
            letters += 1;
            continue;
        }
        words = match (letters, c) {
            (2.., ' ' | '\n' | '\r') => words + 1,
            (0, ' ') => words,
            _ => 0,
        };
        letters = 0;
        if words == 2 || ideographs == 4 || c == '$' {
            return true;
        }
    }
    false
}

/// The length of a macro, with its argument if that is text.
fn macro_with_text(text: &str) -> usize {
    let rest = text.get(1..).unwrap_or_default();
    let name = rest.bytes().take_while(u8::is_ascii_alphabetic).count();
    let takes_text = rest.get(..name).is_some_and(|name| {
        name.starts_with("text")
            || matches!(name, "mbox" | "mathrm" | "operatorname" | "begin" | "end" | "tag" | "label")
    });
    if name == 0 {
        return escaped(text);
    }
    let argument = rest.get(name..).unwrap_or_default();
    if !takes_text || !argument.starts_with('{') {
        return 1 + name;
    }
    let mut depth = 0_usize;
    for (at, byte) in argument.bytes().enumerate() {
        depth = match byte {
            b'{' => depth + 1,
            b'}' => depth.saturating_sub(1),
            _ => depth,
        };
        if depth == 0 {
            return 1 + name + at + 1;
        }
    }
    text.len()
}
