//! Quick fixes: edits of the notes that an editor offers.

use crate::check::verdict::{Judgement, Suggestion, Verdict};
use crate::document::{Document, Equation, Span};

use super::show::math;

/// An edit that is offered.
#[derive(Clone, Debug, PartialEq)]
pub struct Fix {
    /// What it does, in a line.
    pub title: String,
    /// The bytes to be replaced.
    pub span: Span,
    /// By what.
    pub new: String,
    /// Whether it is the one to be taken where several are offered.
    pub preferred: bool,
}

/// What is offered for an equation, the likeliest first.
pub fn fixes(document: &Document, equation: &Equation, judgement: &Judgement, suggestions: &[Suggestion]) -> Vec<Fix> {
    let mut fixes = Vec::new();
    let mut offer = |title: String, latex: &str, preferred: bool| {
        fixes.extend(formula(equation).map(|span| {
            let new = aligned(document.source.get(span.clone()).unwrap_or_default(), latex.trim());
            Fix { title, span, new, preferred }
        }));
    };
    if let Some(correction) = &judgement.correction
        && judgement.is_mended()
        && judgement.verdict != Verdict::Holds
    {
        offer(format!("Print the correction of ({})", judgement.label), &correction.latex, true);
    }
    if let Some(suspect) = judgement.suspect.as_ref().filter(|s| s.label == judgement.label) {
        offer(format!("({}): {}", judgement.label, suspect.edit), &suspect.latex, true);
    }
    for suggestion in suggestions {
        offer(format!("({}): {}", judgement.label, suggestion.edit), &suggestion.latex, false);
    }
    if judgement.verdict == Verdict::Fails && !judgement.as_expected {
        fixes.extend(expect(document, equation));
    }
    fixes
}

/// The bytes of a formula that can be replaced as a whole: nothing but mathematics stands in them.
fn formula(equation: &Equation) -> Option<Span> {
    let span = math(equation);
    let within = span.start - equation.span.start..span.end - equation.span.start;
    let plain = equation.latex.get(within.clone()) == equation.masked.get(within) && equation.prefix.is_empty();
    (plain && !span.is_empty()).then_some(span)
}

/// A formula with the mark of alignment, `&=`, that the printed one has before its sign of equality.
fn aligned(printed: &str, new: &str) -> String {
    let mut marks = printed.match_indices('&');
    let (Some((mark, _)), None) = (marks.next(), marks.next()) else { return new.to_owned() };
    if !printed[mark + 1..].trim_start().starts_with('=') || printed[..mark].ends_with('\\') || new.contains('&') {
        return new.to_owned();
    }
    let mut depth = 0_usize;
    let sign = new.char_indices().find(|(_, c)| {
        match c {
            '{' => depth += 1,
            '}' => depth = depth.saturating_sub(1),
            _ => {}
        }
        *c == '=' && depth == 0
    });
    sign.map_or_else(|| new.to_owned(), |(at, _)| format!("{}&{}", &new[..at], &new[at..]))
}

/// Says that an equation is known to fail.
fn expect(document: &Document, equation: &Equation) -> Option<Fix> {
    let title = format!("Expect ({}) to fail", equation.label);
    let is_latex = document.path.extension().is_some_and(|e| e == "tex" || e == "ltx" || e == "latex");
    let fix = |at: usize, new: String| Some(Fix { title: title.clone(), span: at..at, new, preferred: false });
    let line = "expect = \"fails\"\n";
    if let Some(annotation) = &equation.annotation {
        if annotation.expect.is_some() {
            return None;
        }
        let text = document.source.get(annotation.span.clone())?;
        if is_latex {
            return text.starts_with("%!").then(|| fix(annotation.span.start, format!("%! {line}")))?;
        }
        // Right behind the first line: behind a table it would belong to that.
        let (first, _) = text.split_once('\n')?;
        let at = annotation.span.start + first.len() + 1;
        return (first.trim_end() == "<!-- kenzan").then(|| fix(at, line.to_owned()))?;
    }
    if equation.inline {
        return None;
    }
    let behind = document.source.get(equation.span.end..)?;
    let close = ["$$", "\\]", "\\end{"].iter().filter_map(|close| behind.find(close)).min()?;
    let at = equation.span.end + close + behind.get(close..)?.find('\n').map_or(behind.len() - close, |end| end + 1);
    let shared = document.equations().filter(|e| e.display == equation.display).count() > 1;
    let which = if shared { format!("for = \"{}\"\n", equation.label) } else { String::new() };
    let lines = format!("{which}{line}");
    let new = match is_latex {
        true => lines.lines().map(|line| format!("%! {line}\n")).collect(),
        false => format!("<!-- kenzan\n{lines}-->\n"),
    };
    let begins_line = document.source.get(..at).is_some_and(|before| before.ends_with('\n'));
    fix(at, if begins_line { new } else { format!("\n{new}") })
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::document;
    use crate::verify::{self, Request};

    /// The notes after the fix of this title.
    fn fixed(name: &str, notes: &str, title: &str) -> String {
        let verified = verify::verify(document::parse(Path::new(name), notes), &Request::default(), &|| ());
        let equation = verified.document.equations().next().unwrap();
        let fixes = fixes(&verified.document, equation, &verified.report.equations[0], &[]);
        let fix = fixes.iter().find(|fix| fix.title == title).unwrap_or_else(|| panic!("{fixes:?}"));
        let mut text = notes.to_owned();
        text.replace_range(fix.span.clone(), &fix.new);
        text
    }

    const SYMBOLS: &str = "<!-- kenzan\n[symbols]\n'a, b' = { range = [1, 2] }\n-->\n\n";

    #[test]
    fn the_correction_is_printed_and_the_label_stays() {
        let notes = format!(
            "{SYMBOLS}$$ (a+b)^2 = a^2 + b^2 \\tag{{1}} $$\n<!-- kenzan\ncorrection = '(a+b)^2 = a^2 + 2 a b + b^2'\n-->\n"
        );
        let mended = fixed("n.md", &notes, "Print the correction of (1)");
        assert!(mended.contains("$$ (a+b)^2 = a^2 + 2 a b + b^2 \\tag{1} $$"), "{mended}");
    }

    #[test]
    fn a_correction_keeps_the_alignment() {
        let notes = "\\newcommand{\\twice}[1]{2 #1}\n\\begin{document}\n%! [symbols]\n%! 'a, b' = { range = [1, 2] }\n\
            \\begin{align}\n  a + a &= \\twice{b} \\label{x}\n\\end{align}\n%! correction = 'a + a = \\twice{a}'\n\\end{document}\n";
        let mended = fixed("n.tex", notes, "Print the correction of (x)");
        assert!(mended.contains("  a + a &= 2 a \\label{x}\n"), "{mended}");
        assert_eq!(aligned("a &= b", "x_{a=b} = c"), "x_{a=b} &= c");
        assert_eq!(aligned("a &< b", "c = d"), "c = d");
        assert_eq!(aligned("a = b", "c = d"), "c = d");
    }

    #[test]
    fn a_known_misprint_is_expected() {
        let notes = format!("{SYMBOLS}$$ a + b = a \\tag{{1}} $$\n\nAnd so on.\n");
        let expecting = fixed("n.md", &notes, "Expect (1) to fail");
        assert!(expecting.contains("$$\n<!-- kenzan\nexpect = \"fails\"\n-->\n\nAnd so on."), "{expecting}");
        let verified = verify::verify(document::parse(Path::new("n.md"), &expecting), &Request::default(), &|| ());
        assert!(verify::all_as_expected(&[verified]));
        let notes = format!("{SYMBOLS}$$ a + b = a \\tag{{1}} $$\n<!-- kenzan\nbecause = \"x\"\n-->\n");
        let expecting = fixed("n.md", &notes, "Expect (1) to fail");
        assert!(expecting.contains("<!-- kenzan\nexpect = \"fails\"\nbecause"), "{expecting}");
    }
}
