//! Writing a tree as LaTeX again.

use crate::latex::{parse, to_latex};

#[test]
fn normalised() {
    let cases = [
        ("x_1^2+\\frac12", "x_{1}^{2} + \\frac{1}{2}"),
        ("-a=b", "-a = b"),
        ("\\left(a\\right)", "(a)"),
        ("|a|", "\\left|a\\right|"),
        ("\\mathbf\\omega", "\\boldsymbol{\\omega}"),
        ("\\overline{OQ}", "\\overline{O Q}"),
        ("{a+b}c", "{a + b} c"),
        ("\\begin{align}a&=b\\\\-c&=d\\end{align}", "\\begin{aligned} a = b \\\\ {-c = d} \\end{aligned}"),
        ("F\\Big|_0^1", "\\left. F \\right|_{0}^{1}"),
    ];
    for (source, latex) in cases {
        assert_eq!(parse(source).map(|tree| to_latex(&tree)), Ok(latex.to_owned()), "{source}");
    }
}
