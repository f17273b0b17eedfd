//! The layout of a display: its rows, its environments, and what in it is not mathematics.
//!
//! This is not the reading of the mathematics (that is `latex/`), only as much of TeX's surface as is needed to find the
//! rows and the labels, also in a display that is too damaged to be read. One pass, no recursion.

use super::place::Span;

/// Environments whose rows are statements of their own, as far as their rows may carry labels.
const ROW_ENVIRONMENTS: [&str; 12] = [
    "aligned",
    "alignedat",
    "align",
    "alignat",
    "flalign",
    "gathered",
    "gather",
    "split",
    "eqnarray",
    "multline",
    "multlined",
    "dgroup",
];

/// The layout of a display's content; all places are bytes of that content.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Layout {
    /// The environments that stand in no other and in no braces.
    pub blocks: Vec<Block>,
    /// The `\\` that stand in no environment and in no braces.
    pub breaks: Vec<Span>,
    /// The `\tag{..}`, at any depth, with their labels.
    pub tags: Vec<(Span, String)>,
    /// The `\label{..}`, at any depth, with their names.
    pub labels: Vec<(Span, String)>,
    /// What prints nothing: `\label{..}`, `\nonumber`, `\notag`.
    pub silent: Vec<Span>,
}

/// An environment.
#[derive(Clone, Debug, PartialEq)]
pub struct Block {
    /// Its name without star.
    pub name: String,
    /// From `\begin` to the end of `\end{..}`.
    pub span: Span,
    /// What stands between `\begin{..}` with its arguments and `\end{..}`.
    pub inner: Span,
    /// Its own `\\`, those of inner environments and braces not included.
    pub breaks: Vec<Span>,
}

/// An environment that has begun.
struct Open<'a> {
    name: &'a str,
    start: usize,
    inner: usize,
    depth: usize,
    breaks: Vec<Span>,
}

impl Layout {
    /// Finds the layout of a display's content.
    pub fn of(content: &str) -> Layout {
        let mut layout = Layout::default();
        let mut open: Vec<Open> = Vec::new();
        let mut depth = 0_usize;
        for (token, span) in Tokens::new(content) {
            match token {
                Token::Open => depth += 1,
                Token::Close => depth = depth.saturating_sub(1),
                Token::Ampersand => {}
                Token::Break => match open.as_mut_slice() {
                    [] if depth == 0 => layout.breaks.push(span),
                    [only] if only.depth == depth => only.breaks.push(span),
                    _ => {}
                },
                Token::Begin(name) => {
                    open.push(Open { name, start: span.start, inner: span.end, depth, breaks: Vec::new() });
                }
                Token::End(name) => {
                    let Some(top) = open.pop_if(|top| top.name == name) else { continue };
                    depth = top.depth;
                    if open.is_empty() && depth == 0 {
                        layout.blocks.push(Block {
                            name: name.trim_end_matches('*').to_owned(),
                            span: top.start..span.end,
                            inner: top.inner..span.start,
                            breaks: top.breaks,
                        });
                    }
                }
                Token::Tag(label) => layout.tags.push((span, label.trim().to_owned())),
                Token::Label(name) => {
                    layout.labels.push((span.clone(), name.trim().to_owned()));
                    layout.silent.push(span);
                }
                Token::Silent => layout.silent.push(span),
            }
        }
        layout
    }
}

impl Block {
    /// Whether its rows are statements that may carry labels of their own (`aligned` and the like).
    pub fn has_statements(&self) -> bool {
        has_statements(&self.name)
    }

    /// Its rows without the `\\`.
    pub fn rows(&self) -> Vec<Span> {
        split(&self.inner, &self.breaks)
    }
}

/// Whether the rows of an environment are statements that may carry labels of their own; a star does not matter.
pub fn has_statements(environment: &str) -> bool {
    ROW_ENVIRONMENTS.contains(&environment.trim_end_matches('*'))
}

/// The parts of a range between breaks. An empty last part (after a closing `\\`) is dropped.
pub fn split(range: &Span, breaks: &[Span]) -> Vec<Span> {
    let starts = std::iter::once(range.start).chain(breaks.iter().map(|at| at.end));
    let ends = breaks.iter().map(|at| at.start).chain(std::iter::once(range.end));
    starts.zip(ends).map(|(start, end)| start..end).filter(|row| row.start < row.end).collect()
}

/// The place of the first `&` of a row that stands in no environment and in no braces.
pub fn first_ampersand(row: &str) -> Option<usize> {
    let (mut depth, mut environments) = (0_usize, 0_usize);
    for (token, span) in Tokens::new(row) {
        match token {
            Token::Open => depth += 1,
            Token::Close => depth = depth.saturating_sub(1),
            Token::Begin(_) => environments += 1,
            Token::End(_) => environments = environments.saturating_sub(1),
            Token::Ampersand if depth == 0 && environments == 0 => return Some(span.start),
            _ => {}
        }
    }
    None
}

/// The part of a text without the blanks at both ends, as a range within `range`.
pub fn trimmed(text: &str, range: Span) -> Span {
    let part = text.get(range.clone()).unwrap_or_default();
    let start = range.start + (part.len() - part.trim_start().len());
    start..start + part.trim().len()
}

enum Token<'a> {
    Open,
    Close,
    Ampersand,
    Break,
    Begin(&'a str),
    End(&'a str),
    Tag(&'a str),
    Label(&'a str),
    Silent,
}

/// Those tokens of a display that make its layout, with their places.
struct Tokens<'a> {
    text: &'a str,
    at: usize,
}

impl<'a> Tokens<'a> {
    fn new(text: &'a str) -> Self {
        Tokens { text, at: 0 }
    }

    fn rest(&self) -> &'a str {
        self.text.get(self.at..).unwrap_or_default()
    }

    /// `{name}` directly after the current place, if it is short and plain: the name.
    fn argument(&mut self, longest: usize) -> Option<&'a str> {
        let (name, length) = argument(self.rest(), longest)?;
        self.at += length;
        Some(name)
    }

    /// A macro; the current place is behind its backslash.
    fn command(&mut self) -> Option<Token<'a>> {
        let rest = self.rest();
        let name = letters(rest);
        if name.is_empty() {
            self.at += rest.chars().next().map_or(0, char::len_utf8);
            if !rest.starts_with('\\') {
                return None;
            }
            self.at += usize::from(self.rest().starts_with('*'));
            self.at += row_gap(self.rest());
            return Some(Token::Break);
        }
        self.at += name.len();
        match name {
            "begin" => {
                let name = self.argument(40)?;
                self.at += environment_arguments(name, self.rest());
                Some(Token::Begin(name))
            }
            "end" => self.argument(40).map(Token::End),
            "tag" => {
                self.at += usize::from(self.rest().starts_with('*'));
                self.argument(60).map(Token::Tag)
            }
            "label" => self.argument(200).map(Token::Label),
            "nonumber" | "notag" => Some(Token::Silent),
            // A matrix of the package physics: its rows are no rows of the display.
            "mqty" | "matrixquantity" | "pmqty" | "bmqty" | "vmqty" => {
                self.at += parenthesized(self.rest());
                None
            }
            _ => None,
        }
    }
}

impl<'a> Iterator for Tokens<'a> {
    type Item = (Token<'a>, Span);

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            let ahead = self.rest().find(['\\', '{', '}', '&'])?;
            let start = self.at + ahead;
            self.at = start + 1;
            let token = match self.text.as_bytes().get(start)? {
                b'{' => Some(Token::Open),
                b'}' => Some(Token::Close),
                b'&' => Some(Token::Ampersand),
                _ => self.command(),
            };
            if let Some(token) = token {
                return Some((token, start..self.at));
            }
        }
    }
}

/// The length of `(..)` that a text begins with; longer ones than a matrix are not looked for.
fn parenthesized(text: &str) -> usize {
    let mut depth = 0_usize;
    for (at, byte) in text.bytes().take(2000).enumerate() {
        match byte {
            b'(' => depth += 1,
            b')' => depth = depth.saturating_sub(1),
            _ => {}
        }
        if depth == 0 {
            return if byte == b')' { at + 1 } else { 0 };
        }
    }
    0
}

/// The letters that a text begins with.
fn letters(text: &str) -> &str {
    let end = text.bytes().position(|byte| !byte.is_ascii_alphabetic()).unwrap_or(text.len());
    text.get(..end).unwrap_or_default()
}

/// `{..}` that a text begins with, without braces or line breaks inside: what stands inside, and the length of it all.
pub(super) fn argument(text: &str, longest: usize) -> Option<(&str, usize)> {
    let inside = text.strip_prefix('{')?;
    let length = inside.bytes().take(longest + 1).position(|byte| matches!(byte, b'{' | b'}' | b'\n'))?;
    let found = inside.get(..length)?;
    inside.get(length..)?.starts_with('}').then_some((found, length + 2))
}

/// The length of `[2pt]` after a row break; a bracket that holds no length belongs to the next row.
fn row_gap(text: &str) -> usize {
    let Some(inside) = text.strip_prefix('[') else { return 0 };
    let length = inside.bytes().take(20).position(|byte| byte == b']').unwrap_or(0);
    let gap = inside.get(..length).unwrap_or_default().trim();
    let unit = gap.trim_start_matches(|c: char| c.is_ascii_digit() || matches!(c, '.' | '-' | ' '));
    let is_length = unit.len() < gap.len() && matches!(unit, "pt" | "em" | "ex" | "mm" | "cm" | "in" | "mu" | "px");
    if is_length { length + 2 } else { 0 }
}

/// The length of the arguments of an environment: `[t]` of `aligned`, `{2}` of `alignedat`, `{c|cc}` of `array`.
pub(super) fn environment_arguments(environment: &str, text: &str) -> usize {
    let position = ["[t]", "[c]", "[b]"].iter().find(|position| text.starts_with(**position)).map_or(0, |p| p.len());
    let takes_columns = matches!(environment.trim_end_matches('*'), "alignedat" | "alignat" | "array" | "subarray");
    let columns = text.get(position..).filter(|_| takes_columns).and_then(|rest| argument(rest, 60));
    position + columns.map_or(0, |(_, length)| length)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows_of(content: &str) -> Vec<String> {
        let layout = Layout::of(content);
        layout.blocks[0].rows().into_iter().map(|row| content[trimmed(content, row)].to_owned()).collect()
    }

    #[test]
    fn rows_are_those_of_the_outermost_environment() {
        let content = r"\begin{aligned} a &= \begin{pmatrix} 1 \\ 2 \end{pmatrix} \\[2pt] \sum_{\substack{i \\ j}} b \\ c \end{aligned}";
        assert_eq!(
            rows_of(content),
            [r"a &= \begin{pmatrix} 1 \\ 2 \end{pmatrix}", r"\sum_{\substack{i \\ j}} b", "c"]
        );
        assert!(Layout::of(content).breaks.is_empty());
    }

    #[test]
    fn the_rows_of_a_matrix_in_parentheses_are_its_own() {
        assert_eq!(rows_of(r"\begin{aligned} \mqty(a \\ (b)) \\ c \mqty( \\ d \end{aligned}").len(), 3);
    }

    #[test]
    fn a_bracket_after_a_row_break_is_kept_unless_it_is_a_length() {
        assert_eq!(rows_of(r"\begin{aligned} a \\[x] b \\* c \\[-1.5em] d \end{aligned}"), ["a", "[x] b", "c", "d"]);
    }

    #[test]
    fn arguments_of_environments_are_no_content() {
        assert_eq!(rows_of(r"\begin{alignedat}[t]{2} a \\ b \end{alignedat}"), ["a", "b"]);
        assert_eq!(rows_of(r"\begin{array}{c|cc} a & b \\ \hline c \end{array}"), ["a & b", r"\hline c"]);
    }

    #[test]
    fn bare_rows_tags_and_silent_macros_are_found() {
        let content = r"a \tag{1} \\ \{b\} \tag*{A} \label{eq:b} \nonumber";
        let layout = Layout::of(content);
        assert_eq!(layout.breaks.len(), 1);
        let labels: Vec<_> = layout.tags.iter().map(|(span, label)| (&content[span.clone()], label.as_str())).collect();
        assert_eq!(labels, [(r"\tag{1}", "1"), (r"\tag*{A}", "A")]);
        assert_eq!(layout.silent.len(), 2);
    }

    #[test]
    fn the_first_ampersand_outside_of_environments_separates_the_cells() {
        assert_eq!(first_ampersand(r"\begin{pmatrix} 1 & 2 \end{pmatrix} & x"), Some(36));
        assert_eq!(first_ampersand(r"{a & b} \& c"), None);
    }

    #[test]
    fn damaged_layout_is_survived() {
        for content in
            [r"\end{aligned} } {", r"\begin{aligned} a \\ b", r"\begin{", r"\tag{", "\\", r"\begin{a}\end{b}\end{a}"]
        {
            Layout::of(content);
        }
    }
}
