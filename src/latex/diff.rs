//! What differs between a printed formula and its correction, found on the LaTeX's own nesting.

use std::ops::Range;

/// The deepest nesting that is walked.
pub const DEEPEST: usize = 60;
/// The most comparisons that one list of items may cost: past it nothing is marked.
const COSTLIEST: usize = 4_000_000;

/// A piece of LaTeX: a token, or a group, script, command or environment with what it holds.
struct Item<'a> {
    /// The whole piece's bytes.
    span: Range<usize>,
    /// The piece with its tokens set apart by one space: what makes two pieces equal.
    key: String,
    /// What begins it (`{`, `^`, `\frac`, `\begin{aligned}`); the token itself if it holds nothing.
    open: &'a str,
    /// What it holds.
    inner: Vec<Item<'a>>,
}

/// Both sources with what differs marked as by `git diff --word-diff`: `[-removed-]` in the first, `{+inserted+}` in the
/// second. `None` where nothing could be compared.
pub fn words(before: &str, after: &str) -> Option<(String, String)> {
    mark_by(before, after, [|part| format!("[-{part}-]"), |part| format!("{{+{part}+}}")])
}

/// Both sources with what differs marked, each by its own function, or `None` where nothing could be compared: the
/// nesting is broken, or the sources too large.
pub fn mark_by(before: &str, after: &str, by: [fn(&str) -> String; 2]) -> Option<(String, String)> {
    let (left, right) = (items(before)?, items(after)?);
    let mut changes = Changes::default();
    compare(&left, &right, &mut changes)?;
    Some((with_marks(before, changes.left, by[0]), with_marks(after, changes.right, by[1])))
}

/// A changed range of bytes, and the number of the list it stands in: only neighbours in one list are marked as one. A
/// script's content is a list of its own.
type Change = (Range<usize>, usize);

/// The list of a change that is never joined with its neighbours.
const ALONE: usize = 0;

/// The two sides' changes, each in order.
#[derive(Default)]
struct Changes {
    left: Vec<Change>,
    right: Vec<Change>,
    lists: usize,
}

/// Compares two lists: equal items are passed over, items of the same shape are compared within, others are changes.
fn compare(left: &[Item<'_>], right: &[Item<'_>], changes: &mut Changes) -> Option<()> {
    changes.lists += 1;
    let list = changes.lists;
    let mut from = (0, 0);
    for (i, j) in common(left, right, |a, b| a.key == b.key)?.into_iter().chain([(left.len(), right.len())]) {
        let (left_run, right_run) = (&left[from.0..i], &right[from.1..j]);
        let mut begin = (0, 0);
        let same_shape = |a: &Item<'_>, b: &Item<'_>| !a.inner.is_empty() && !b.inner.is_empty() && a.open == b.open;
        let ends = (left_run.len(), right_run.len());
        for (k, l) in common(left_run, right_run, same_shape)?.into_iter().chain([ends]) {
            left_run[begin.0..k].iter().for_each(|item| change(item, list, &mut changes.left));
            right_run[begin.1..l].iter().for_each(|item| change(item, list, &mut changes.right));
            if let (Some(a), Some(b)) = (left_run.get(k), right_run.get(l)) {
                compare(&a.inner, &b.inner, changes)?;
            }
            begin = (k + 1, l + 1);
        }
        from = (i + 1, j + 1);
    }
    Some(())
}

/// Marks an item: a script by what it holds, for a script cannot be taken from its base; row and cell breaks never.
fn change(item: &Item<'_>, list: usize, changes: &mut Vec<Change>) {
    match item.open {
        "&" | r"\\" => {}
        "^" | "_" => item.inner.iter().for_each(|inner| change(inner, ALONE, changes)),
        _ => changes.push((item.span.clone(), list)),
    }
}

/// The longest common subsequence of two lists, as pairs of indices; `None` if it would cost too much.
fn common<T>(left: &[T], right: &[T], equal: impl Fn(&T, &T) -> bool) -> Option<Vec<(usize, usize)>> {
    let (rows, columns) = (left.len(), right.len());
    if (rows + 1) * (columns + 1) > COSTLIEST {
        return None;
    }
    // lengths[i][j]: the length for the tails that begin at i and j.
    let mut lengths = vec![vec![0usize; columns + 1]; rows + 1];
    for i in (0..rows).rev() {
        for j in (0..columns).rev() {
            lengths[i][j] = if equal(&left[i], &right[j]) {
                lengths[i + 1][j + 1] + 1
            } else {
                lengths[i + 1][j].max(lengths[i][j + 1])
            };
        }
    }
    let (mut i, mut j, mut pairs) = (0, 0, Vec::new());
    while i < rows && j < columns {
        if equal(&left[i], &right[j]) {
            pairs.push((i, j));
            (i, j) = (i + 1, j + 1);
        } else if lengths[i + 1][j] >= lengths[i][j + 1] {
            i += 1;
        } else {
            j += 1;
        }
    }
    Some(pairs)
}

fn with_marks(source: &str, changes: Vec<Change>, by: fn(&str) -> String) -> String {
    let mut runs: Vec<Change> = Vec::new();
    for (span, list) in changes {
        match runs.last_mut() {
            Some((run, same)) if *same == list && list != ALONE && source[run.end..span.start].trim().is_empty() => {
                run.end = span.end;
            }
            _ => runs.push((span, list)),
        }
    }
    let (mut marked, mut from) = (String::new(), 0);
    for (run, _) in runs {
        marked.push_str(&source[from..run.start]);
        marked.push_str(&by(&source[run.clone()]));
        from = run.end;
    }
    marked + &source[from..]
}

/// Reads a source into items; `None` where its groups do not match or nest too deeply to walk.
fn items(source: &str) -> Option<Vec<Item<'_>>> {
    if nesting(source) > DEEPEST {
        return None;
    }
    let mut reader = Reader { source, at: 0 };
    let items = reader.list(None)?;
    (reader.at == source.len()).then_some(items)
}

struct Reader<'a> {
    source: &'a str,
    at: usize,
}

impl<'a> Reader<'a> {
    /// The next token without the spaces before it, and where it begins; it is not yet taken.
    fn peek(&mut self) -> Option<&'a str> {
        let rest = &self.source[self.at..];
        let trimmed = rest.trim_start();
        self.at += rest.len() - trimmed.len();
        let first = trimmed.chars().next()?;
        if first != '\\' {
            return Some(&trimmed[..first.len_utf8()]);
        }
        let name = trimmed[1..].find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(trimmed.len() - 1);
        let one = trimmed[1..].chars().next().map_or(0, char::len_utf8);
        Some(&trimmed[..1 + name.max(one)])
    }

    /// Items up to the closing token, which is not taken; up to the end where there is none.
    fn list(&mut self, close: Option<&str>) -> Option<Vec<Item<'a>>> {
        let mut list = Vec::new();
        loop {
            match self.peek() {
                None => return close.is_none().then_some(list),
                Some(token) if Some(token) == close => return Some(list),
                Some(_) => list.push(self.item()?),
            }
        }
    }

    fn item(&mut self) -> Option<Item<'a>> {
        let token = self.peek()?;
        let start = self.at;
        self.at += token.len();
        let (mut open, mut close) = (token, "");
        let inner = match token {
            "{" => self.enclosed("}")?,
            "}" | r"\right" | r"\end" => return None,
            "^" | "_" => vec![self.item()?],
            r"\left" => {
                open = self.with_next(start)?;
                let inner = self.enclosed(r"\right")?;
                close = self.with_next(self.at)?;
                inner
            }
            r"\begin" => {
                self.item()?;
                open = &self.source[start..self.at];
                let inner = self.enclosed(r"\end")?;
                self.item()?;
                inner
            }
            _ => (0..arguments(token)).map(|_| self.item()).collect::<Option<_>>()?,
        };
        let key = inner.iter().fold(open.to_owned(), |key, item| key + " " + &item.key) + close;
        Some(Item { span: start..self.at, key, open, inner })
    }

    /// A list and its closing token.
    fn enclosed(&mut self, close: &str) -> Option<Vec<Item<'a>>> {
        let list = self.list(Some(close))?;
        self.at += close.len();
        Some(list)
    }

    /// From `start` to the end of the next token.
    fn with_next(&mut self, start: usize) -> Option<&'a str> {
        let token = self.peek()?;
        self.at += token.len();
        Some(&self.source[start..self.at])
    }
}

/// How many arguments a command takes; one that is not listed is a token like any other.
fn arguments(command: &str) -> usize {
    match command {
        r"\frac" | r"\dfrac" | r"\tfrac" | r"\binom" => 2,
        r"\sqrt" | r"\dot" | r"\ddot" | r"\dddot" | r"\vec" | r"\hat" | r"\bar" | r"\tilde" | r"\overline" => 1,
        r"\mathbf" | r"\boldsymbol" | r"\bm" | r"\mathrm" | r"\mathcal" | r"\text" | r"\operatorname" => 1,
        _ => 0,
    }
}

/// How deep groups and environments nest, by counting: commands with braceless arguments (`\sqrt\sqrt x`) count, too.
pub fn nesting(latex: &str) -> usize {
    let (mut depth, mut deepest, mut run) = (0usize, 0, 0);
    let mut chars = latex.chars().peekable();
    while let Some(c) = chars.next() {
        match c {
            '{' | '[' => depth += 1,
            '}' | ']' => depth = depth.saturating_sub(1),
            _ => {}
        }
        if c == '\\' {
            let mut name = String::new();
            while let Some(letter) = chars.next_if(char::is_ascii_alphabetic) {
                name.push(letter);
            }
            match name.as_str() {
                "" => drop(chars.next()),
                "begin" | "left" => depth += 1,
                "end" | "right" => depth = depth.saturating_sub(1),
                _ => run += 1,
            }
        } else if !matches!(c, ' ' | '^' | '_') {
            run = 0;
        }
        deepest = deepest.max(depth + run);
    }
    deepest
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mark(before: &str, after: &str) -> Option<(String, String)> {
        mark_by(before, after, [str::to_owned; 2])
    }

    #[test]
    fn the_least_part_is_marked() {
        for (before, after, left, right) in [
            (r"a = \frac{b}{c}", r"a = \frac{b}{c^2}", r"a = \frac{b}{c}", r"a = \frac{b}{c^[2]}"),
            (r"x^2 + y", r"x^3 - y", r"x^[2] [+] y", r"x^[3] [-] y"),
            (r"\sin \theta\cos\psi", r"\sin\theta \sin \psi", r"\sin \theta[\cos]\psi", r"\sin\theta [\sin] \psi"),
            (r"I_0 \dot{x}", r"I_1 \ddot{x}", r"I_[0] [\dot{x}]", r"I_[1] [\ddot{x}]"),
            (r"a + b c d", r"a + e", r"a + [b c d]", r"a + [e]"),
            (r"\frac{mgl}{I_1}", r"\frac{mgl}{I_1 \Omega}", r"\frac{mgl}{I_1}", r"\frac{mgl}{I_1 [\Omega]}"),
        ] {
            let marked = mark_by(before, after, [|part| format!("[{part}]"); 2]).unwrap();
            assert_eq!(marked, (left.into(), right.into()));
        }
    }

    #[test]
    fn words_are_marked_for_the_terminal() {
        let marked = words(r"a = \frac{b}{c} \sin x", r"a = \frac{b}{c^2} \cos x").unwrap();
        assert_eq!(marked, (r"a = \frac{b}{c} [-\sin-] x".into(), r"a = \frac{b}{c^{+2+}} {+\cos+} x".into()));
    }

    #[test]
    fn equal_sources_have_no_marks_and_broken_ones_none_at_all() {
        assert_eq!(mark("a^{2}", "a^{ 2 }").unwrap(), ("a^{2}".to_owned(), "a^{ 2 }".to_owned()));
        for broken in ["{a", "a}", r"\left( a", r"\begin{aligned} a", r"\frac{a}", "^"] {
            assert!(mark(broken, "a").is_none(), "{broken}");
        }
        assert!(mark(&"{".repeat(100_000), "a").is_none());
    }
}
