//! Dialects of Markdown: labels beside displays, fences, macros, front matter, references.

use super::*;

/// Labels and masked LaTeX; there must be no problems.
fn found(source: &str) -> Vec<(String, String)> {
    equations(source)
}

#[test]
fn labels_beside_displays_are_theirs() {
    let source = "---\ntitle: \"線形 $A$\"\nlang: ja\n---\n\n$$\na = b\n$$ {#eq-one}\n\n$$ c = d $$ {#eq:two .class}\n\n$$ e = f $$ (three:x)\n\n\
                  (@four) $$ g = h $$\n\n$$ i $$ (see text)\n\n$$ j \\tag{6} $$ {#eq-six}\n\nBy @eq-one, @eq:two and {eq}`three:x`.\n";
    let expected = [
        ("eq-one", "a = b"),
        ("eq:two", "c = d"),
        ("three:x", "e = f"),
        ("four", "g = h"),
        ("four+1", "i"),
        ("6", "j"),
    ];
    assert_eq!(found(source), pairs(&expected));
    let document = parse(source);
    assert_eq!(document.title, "線形 $A$");
    assert!(document.equations().last().unwrap().is_called("eq-six"));
}

#[test]
fn fences_of_myst_are_displays() {
    let source = "Text\n\n```{math}\n:label: my-eq\n:nowrap:\n\na = b \\\\\nc = d\n```\n\n~~~{math}\ne = f\n~~~\n\n```{math}\n```\n\n```python\n$$ x $$\n```\n\nBy {eq}`my-eq`.";
    assert_eq!(found(source), pairs(&[("my-eq", "a = b \\\\\nc = d"), ("my-eq+1", "e = f")]));
}

#[test]
fn macros_are_read_where_they_stand() {
    let source = "$$\n\\newcommand{\\R}{\\mathbb{R}}\n\\def\\half{\\frac12}\n$$\n\n$\\newcommand{\\vE}{\\mathbf{E}}$\n\n\\newcommand{\\x}[1]{x_{#1}}\n\n\
                  Text `\\newcommand{\\x}{no}` <!-- \\newcommand{\\x}{no} -->\n\n$$ \\x1 = \\half \\vE $$\n\n$$ \\renewcommand{\\x}[1]{y} \\x1 $$\n\n\
                  <!-- kenzan\nwhere = ['\\x{2} = 1']\n-->\n";
    let document = parse(source);
    assert_eq!(problems(&document), Vec::<String>::new());
    let expanded: Vec<_> =
        document.equations().map(|e| e.macros.expand(&e.masked).unwrap().text.trim().to_owned()).collect();
    assert_eq!(expanded, [r"x_{1} = \frac12 \mathbf{E}", "y"]);
    let annotation = document.equations().last().unwrap().annotation.clone().unwrap();
    assert_eq!(annotation.where_[0].value, "y = 1");
    assert_eq!(&source[annotation.where_[0].place(0..1)], "'\\x{2} = 1'".trim_matches('\''));
}

#[test]
fn references_to_nothing_are_warnings() {
    let source = "$$ a = b \\tag{1} $$\n\n$$ c = d $$ {#eq-energy}\n\nBy Eq. (1), Eq. (2), 式 (3)、(4)式, and @eq-enrgy, but not @equal, me@eq-x.org,\n\
                  f(5), item (6), Eq. (7) of [3], `Eq. (8)` or \\eqref{eq:none} and {eq}`nine`.\n";
    insta::assert_snapshot!(super::messages::rendered_all(&parse(source)));
    assert!(parse(source).problems.iter().all(|problem| problem.severity == Severity::Warning));
    assert_eq!(parse("$$ a $$ Eq. (2)").problems, [], "nothing is numbered here");
}
