//! LaTeX shown as MathML, which browsers draw themselves: no script, no fonts, no network.

use super::mathml::canonical;
use super::text::escape;
use crate::breakdown::caught;
use crate::latex::diff::{DEEPEST, nesting};
use katex::types::{OutputFormat, Settings};
use katex::{KatexContext, render_to_string};

/// The length past which a source is shown as it is, as where it nests deeper than [`DEEPEST`]: katex descends by
/// recursion.
const LONGEST: usize = 40_000;

/// The colour by which a part is marked on its way through katex; it leaves as the class `changed`.
pub(super) const MARK: &str = "#c0ffee";

/// Renders LaTeX.
pub(super) struct Renderer {
    context: KatexContext,
}

impl Renderer {
    pub(super) fn new() -> Self {
        Renderer { context: KatexContext::default() }
    }

    /// A displayed formula: MathML, or the source itself where katex cannot read it.
    pub(super) fn display(&self, latex: &str) -> String {
        self.mathml(latex, latex, true).unwrap_or_else(|| source(latex))
    }

    /// A formula within a line.
    pub(super) fn inline(&self, latex: &str) -> String {
        self.mathml(latex, latex, false).unwrap_or_else(|| source(latex))
    }

    /// A displayed formula, given with and without marks, in which [`marked`] parts have the class `changed`; `None` where
    /// katex cannot read it.
    pub(super) fn marked(&self, marked: &str, latex: &str) -> Option<String> {
        self.mathml(marked, latex, true)
    }

    /// Prose in which `$...$` is mathematics and `` `...` `` is code.
    pub(super) fn prose(&self, text: &str) -> String {
        let mut html = String::new();
        let mut rest = text;
        while let Some(begin) = rest.find(['$', '`']) {
            let fence = if rest[begin..].starts_with('$') { '$' } else { '`' };
            let inner = &rest[begin + 1..];
            let Some(length) = inner.find(fence) else { break };
            html.push_str(&escape(&rest[..begin]));
            let body = &inner[..length];
            html.push_str(&if fence == '$' { self.inline(body) } else { format!("<code>{}</code>", escape(body)) });
            rest = &inner[length + 1..];
        }
        html + &escape(rest)
    }

    /// With the source as `alttext`, for those who hear the page or copy from it.
    fn mathml(&self, latex: &str, source: &str, display: bool) -> Option<String> {
        let html = self.bare_mathml(latex, display)?;
        let (element, rest) = html.split_at_checked("<math".len())?;
        Some(format!("{element} alttext=\"{}\"{rest}", escape(source.trim())))
    }

    fn bare_mathml(&self, latex: &str, display: bool) -> Option<String> {
        if latex.len() > LONGEST || nesting(latex) > DEEPEST {
            return None;
        }
        // Rows without an environment, and a side cut out of an alignment, are read as rows of `aligned`.
        self.try_mathml(latex, display)
            .or_else(|| self.try_mathml(&format!(r"\begin{{aligned}}{latex}\end{{aligned}}"), display))
    }

    fn try_mathml(&self, latex: &str, display: bool) -> Option<String> {
        // Made anew for each formula, so that a `\gdef` in one does not reach the next.
        let settings = Settings::builder().display_mode(display).output(OutputFormat::Mathml).max_size(20.0).build();
        // A panic within katex costs one formula its typography, not the run its report.
        let rendered = caught(|| render_to_string(&self.context, latex, &settings));
        canonical(&rendered.ok()?.ok()?)
    }
}

/// Marks a part of a source to be shown as changed.
pub(super) fn marked(latex: &str) -> String {
    format!(r"{{\textcolor{{{MARK}}}{{{latex}}}}}")
}

/// The class, with a space before it, of a formula that may be wider than its place: it can be scrolled by the keyboard on
/// a screen and is made smaller on paper. By the signs in its longest row; a formula of 60 signs is seldom wider than 45 em.
pub(super) fn length_class(html: &str) -> &'static str {
    let signs = |row: &str| {
        let mut within = false;
        let is_sign = |c: &char| match c {
            '<' | '>' => {
                within = *c == '<';
                false
            }
            c => !within && !c.is_whitespace(),
        };
        row.chars().filter(is_sign).count()
    };
    match html.split("</mtr>").map(signs).max().unwrap_or(0) {
        0..=60 => "",
        61..=80 => " long",
        81..=100 => " long longer",
        101..=130 => " long longest",
        _ => " long endless",
    }
}

fn source(latex: &str) -> String {
    format!("<code class=\"source\">{}</code>", escape(latex))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::latex::diff::mark_by;

    #[test]
    fn formulas_become_mathml_the_same_each_time() {
        let latex = r"\dot{\varphi} = \left( \frac{mgl}{I_1 \Omega} \right)^2 \quad \text{歳差運動が遅い場合}";
        let first = Renderer::new().display(latex);
        let alttext = format!("<math alttext=\"{latex}\" display=\"block\"><mrow>");
        assert!(first.starts_with(&alttext), "{first}");
        assert!(first.ends_with("</mrow></math>"), "{first}");
        assert!(first.contains("歳差運動が遅い場合"));
        assert!(!first.contains("annotation") && !first.contains("xmlns"));
        for _ in 0..20 {
            assert_eq!(Renderer::new().display(latex), first);
        }
    }

    #[test]
    fn unreadable_latex_is_shown_escaped() {
        let html = Renderer::new().display(r"\frac{a}{ <script>alert(1)</script>");
        assert_eq!(html, r#"<code class="source">\frac{a}{ &lt;script&gt;alert(1)&lt;/script&gt;</code>"#);
    }

    #[test]
    fn mathematics_cannot_leave_its_element() {
        for latex in [
            r"\text{<script>alert(1)</script>}",
            r#"\text{"><img src=x onerror=alert(1)>}"#,
            r"\href{javascript:alert(1)}{x}",
            r"\htmlStyle{position:fixed}{x}",
            r"\url{javascript:alert(1)}",
            r"\includegraphics{http://example.org/x.png}",
            r#"\color{red" onclick="alert(1)}x"#,
        ] {
            let html = Renderer::new().display(latex);
            let tags = html.split('<').skip(1).map(|t| t.split('>').next().unwrap_or_default());
            for tag in tags {
                let tag = without_alttext(tag);
                for bad in ["script", "img", "onclick", "onerror", "href=", "src=", "position", " style="] {
                    assert!(!tag.contains(bad), "{latex} gave <{tag}>");
                }
            }
        }
    }

    /// The attribute's value has no quotes, so it ends where it should.
    fn without_alttext(tag: &str) -> String {
        let Some((before, rest)) = tag.split_once(" alttext=\"") else { return tag.to_owned() };
        format!("{before}{}", rest.split_once('"').unwrap().1)
    }

    #[test]
    fn deep_or_long_sources_are_shown_as_they_are() {
        let renderer = Renderer::new();
        for latex in ["{".repeat(5_000) + &"}".repeat(5_000), r"\sqrt".repeat(5_000) + "x", "x^".repeat(50_000)] {
            assert!(renderer.display(&latex).starts_with("<code"));
        }
        // As deep as is let through, in the ways that need the most stack.
        let deep = [(r"\sqrt{", "}"), (r"\left(", r"\right)"), ("x^{", "}"), (r"\frac{1}{", "}")];
        for (open, close) in deep {
            let latex = open.repeat(DEEPEST) + "x" + &close.repeat(DEEPEST);
            assert!(renderer.display(&latex).starts_with("<math"), "{open}");
        }
    }

    #[test]
    fn rows_without_environment_are_aligned() {
        let html = Renderer::new().display(r"a &= b \\ &= c");
        assert!(html.contains("<mtable"), "{html}");
    }

    #[test]
    fn prose_may_hold_mathematics_and_code() {
        let html = Renderer::new().prose("if $a<b$ & `x<y`, not 5$");
        assert!(html.starts_with("if <math alttext=\"a&lt;b\">"), "{html}");
        assert!(html.ends_with(" &amp; <code>x&lt;y</code>, not 5$"), "{html}");
    }

    /// Every display of real lecture notes, damaged ones included, is shown as mathematics.
    #[test]
    fn displays_of_real_notes_are_shown() {
        let notes = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/notes");
        let Ok(files) = std::fs::read_dir(&notes) else { return println!("skipped: no {}", notes.display()) };
        let renderer = Renderer::new();
        for file in files {
            let text = std::fs::read_to_string(file.unwrap().path()).unwrap();
            let displays: Vec<_> = text.split("$$").skip(1).step_by(2).collect();
            let shown = displays.iter().filter(|latex| renderer.display(latex).starts_with("<math")).count();
            assert_eq!(shown, displays.len());
        }
    }

    #[test]
    fn long_formulas_are_known() {
        let display = |latex: &str| Renderer::new().display(latex);
        assert_eq!(length_class(&display(r"a = \frac{b}{c}")), "");
        assert_eq!(length_class(&display(&"a + b = ".repeat(16))), " long");
        // Rows count each for itself.
        assert_eq!(
            length_class(&display(&format!(r"\begin{{aligned}}{}\end{{aligned}}", r"a &= b \\".repeat(40)))),
            ""
        );
        assert_eq!(length_class(&display(&"a + b = ".repeat(90))), " long endless");
    }

    #[test]
    fn marks_become_classes() {
        let html = Renderer::new().marked(&format!("a = b^{}", marked("2")), "a = b^2").unwrap();
        assert!(html.starts_with("<math alttext=\"a = b^2\""), "{html}");
        assert!(html.contains("<mstyle class=\"changed\"><mn>2</mn></mstyle>"), "{html}");
    }

    #[test]
    fn rows_and_cells_stay_outside_of_marks() {
        let printed = r"a &= b \\ &= c";
        let (left, _) = mark_by(printed, r"d", [marked; 2]).unwrap();
        assert!(Renderer::new().marked(&left, printed).is_some_and(|html| html.contains("changed")), "{left}");
    }
}
