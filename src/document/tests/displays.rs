//! Which displays are found, and how they become equations.

use super::*;

#[test]
fn displays_of_all_kinds_are_found() {
    let source = r"
$$ a = 1 \tag{1} $$ and in the text $$a = 2 \tag{2}$$ too.

\[ a = 3 \tag{3} \] and in the text \[a = 4 \tag{4}\].

\begin{equation} a = 5 \tag{5} \end{equation}
\begin{align*}
a &= 6 \tag{6}
\end{align*}
\begin{alignat}{2} a &= 7 \tag{7} \end{alignat}
";
    let expected = [
        ("1", "a = 1"),
        ("2", "a = 2"),
        ("3", "a = 3"),
        ("4", "a = 4"),
        ("5", "a = 5"),
        ("6", "a &= 6"),
        ("7", "a &= 7"),
    ];
    assert_eq!(equations(source), pairs(&expected));
}

#[test]
fn a_display_may_hold_what_markdown_takes_for_its_own() {
    let source = "# T\n\n$$\na\n\n= b\n+ c\n- d\n# e\n\n    f * g _h_\n$$\n\n## U\n";
    let document = parse(source);
    assert_eq!(problems(&document), Vec::<String>::new());
    assert_eq!(document.equations().next().unwrap().latex, "a\n\n= b\n+ c\n- d\n# e\n\n    f * g _h_");
    let titles: Vec<_> = document
        .items
        .iter()
        .filter_map(|item| match item {
            Item::Section(section) => Some((section.title.as_str(), section.level)),
            _ => None,
        })
        .collect();
    assert_eq!(titles, [("T", 1), ("U", 2)]);
}

#[test]
fn words_in_text_do_not_make_a_display_prose() {
    let source = "$$ a = b \\text{ where the $x$ is small}\n\n \\text{and so on} \\mathrm{for all} c $$";
    assert_eq!(equations(source).len(), 1);
}

#[test]
fn code_holds_no_equations() {
    let source = "Write `$$ a $$` or ``\\begin{equation} ` ``:\n\n```latex\n$$ b $$\n<!-- kenzan\ngiven = 1 -->\n```\n\n    $$ c $$\n\n~~~\n\\[ d \\]\n~~~\n\n$$ e $$\n";
    assert_eq!(equations(source), pairs(&[("0+1", "e")]));
}

#[test]
fn comments_hold_no_equations_and_escaped_dollars_open_none() {
    assert_eq!(equations("<!-- $$ a $$ -->\n\n\\$\\$ 5 \\[not a link\\] $$ b $$"), pairs(&[("0+1", "b")]));
}

#[test]
fn displays_in_lists_and_quotes_are_found() {
    assert_eq!(equations("- item\n\n    $$ a = b $$\n\n1. $$c$$\n"), pairs(&[("0+1", "a = b"), ("0+2", "c")]));
    let document = parse("> $$\n> a > b\n> > c\n> $$\n");
    let equation = document.equations().next().unwrap();
    assert_eq!(equation.latex, "a > b\n> > c");
    assert_eq!(equation.masked, "a > b\n  > c");
}

#[test]
fn equations_without_label_are_counted_from_the_label_before() {
    let source = "$$a$$ $$b$$ $$c \\tag{8}$$ $$d$$ $$e$$ $$f \\quad (9)$$ $$g$$";
    let labels: Vec<_> = equations(source).into_iter().map(|(label, _)| label).collect();
    assert_eq!(labels, ["0+1", "0+2", "8", "8+1", "8+2", "9", "9+1"]);
    let numbered: Vec<_> = parse(source).equations().map(|equation| equation.numbered).collect();
    assert_eq!(numbered, [false, false, true, false, false, true, false]);
}

#[test]
fn the_label_is_blank_and_the_latex_is_not() {
    let document = parse("前置き\n\n$$ E = mc^2 \\quad (1) $$\n");
    let equation = document.equations().next().unwrap();
    assert_eq!(equation.latex, r"E = mc^2 \quad (1)");
    assert_eq!(equation.masked, format!("E = mc^2{}", " ".repeat(r" \quad (1)".len())));
    assert_eq!((equation.line, equation.span.clone()), (3, 14..32));
}

#[test]
fn a_display_that_is_only_a_label_is_an_equation() {
    assert_eq!(equations("$$(80)$$"), pairs(&[("80", "")]));
}

#[test]
fn silent_macros_are_blank() {
    assert_eq!(
        equations(r"$$ a \label{eq:a} = b \nonumber $$"),
        pairs(&[("eq:a", &format!("a{}= b", " ".repeat(r" \label{eq:a} ".len())))])
    );
}

#[test]
fn rows_go_to_the_label_that_follows_them() {
    let source = r"
$$\begin{aligned}
P &= a & (5) \\
&= b \begin{pmatrix} 1 \\ 2 \end{pmatrix} \\
&= c \quad (6) \\
&= d
\end{aligned}$$";
    let document = parse(source);
    let found: Vec<_> =
        document.equations().map(|equation| (equation.label.as_str(), equation.latex.as_str())).collect();
    let expected = [
        ("5", r"P &= a & (5)"),
        ("6", "&= b \\begin{pmatrix} 1 \\\\ 2 \\end{pmatrix} \\\\\n&= c \\quad (6) \\\\\n&= d"),
    ];
    assert_eq!(found, expected);
    assert!(document.equations().all(|equation| equation.display == 0 && equation.numbered));
    check_promises(&document);
}

#[test]
fn a_label_behind_the_block_belongs_to_its_last_row() {
    let source = r"$$\begin{aligned} a & (5) \\ b \\ c \end{aligned} \quad (6)$$ \begin{align} d \tag{7} \\ e \tag{8} \end{align}";
    assert_eq!(equations(source), pairs(&[("5", "a"), ("6", r"b \\ c"), ("7", "d"), ("8", "e")]));
}

#[test]
fn one_label_in_a_row_labels_the_whole_display() {
    let source = r"$$\begin{aligned} a \\ b \quad (57) \end{aligned}$$";
    assert_eq!(
        equations(source),
        pairs(&[("57", &format!(r"\begin{{aligned}} a \\ b{}\end{{aligned}}", " ".repeat(r" \quad (57) ".len())))])
    );
}

#[test]
fn a_damaged_display_keeps_its_label() {
    assert_eq!(equations(r"$$ \frac{a}{b = \left( c \quad (7) $$"), pairs(&[("7", r"\frac{a}{b = \left( c")]));
}

#[test]
fn labels_that_are_only_attached_must_continue_the_sequence() {
    let source = "$$a \\tag{11}$$ $$y = f(2)$$ $$b = c (12)$$ $$d (13)$$ $$y = f(13)$$";
    let expected = [("11", "a"), ("11+1", "y = f(2)"), ("12", "b = c"), ("13", "d"), ("13+1", "y = f(13)")];
    assert_eq!(equations(source), pairs(&expected));
}

#[test]
fn the_title_is_the_first_heading_of_the_first_level() {
    assert_eq!(parse("## Sub\n\n# On $x$ and *y* `z`<!-- a -->\n\n# Other").title, "On $x$ and y z");
    assert_eq!(parse("\u{feff}# BOM\n").title, "BOM");
    assert_eq!(parse("---\ntitle: x\n---\n\ntext").title, "x");
    assert_eq!(parse("$$a$$\n---\n").items.len(), 1, "a display over a rule is no heading");
}

#[test]
fn line_endings_of_windows_are_read() {
    let source = "# T\r\n\r\n$$\r\na = b \\quad (1)\r\n$$\r\n<!-- kenzan\r\ngiven = ['2']\r\n-->\r\n";
    assert_eq!(equations(source), pairs(&[("1", "a = b")]));
    let document = parse(source);
    let annotation = document.equations().next().unwrap().annotation.clone().unwrap();
    assert_eq!(&source[annotation.given[0].span.clone()], "2");
}

#[test]
fn dollars_first_in_a_line_close_if_prose_follows_them() {
    assert_eq!(equations("$$ a\n$$ and then $x$, $$b\n$$\n"), pairs(&[("0+1", "a"), ("0+2", "b")]));
    assert_eq!(equations("$$\na\n\n$$\nwhere $x = 1$ holds.\n\n$$\nb\n$$\n$$\nc\n$$ $$d$$\n").len(), 4);
    assert_eq!(equations("$$\na\n\n$$\n<!-- kenzan\ngiven = ['1'] -->\n\n$$ b $$").len(), 2);
}

#[test]
fn dollars_below_a_blank_line_open_if_mathematics_follows_them() {
    let document = parse("$$\na = b\n\n$$\nc = d\n$$\n\nText.\n\n$$ e $$");
    let latex: Vec<_> = document.equations().map(|equation| equation.latex.as_str()).collect();
    assert_eq!((latex, document.problems.len()), (vec!["c = d", "e"], 1));
}
