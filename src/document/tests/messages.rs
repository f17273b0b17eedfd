//! The messages for each bad input, as an author sees them. Japanese text before the place must not shift the underline.

use super::*;
use miette::{GraphicalReportHandler, GraphicalTheme};

/// All problems of a text, rendered; and what was still delivered.
fn rendered(source: &str) -> String {
    rendered_all(&parse(source))
}

/// All problems of a document, rendered; and what was still delivered.
pub fn rendered_all(document: &Document) -> String {
    check_promises(document);
    let handler =
        GraphicalReportHandler::new_themed(GraphicalTheme::unicode_nocolor()).with_width(110).with_links(false);
    let mut text = String::new();
    for problem in &document.problems {
        handler.render_report(&mut text, problem.to_miette(document).as_ref()).unwrap();
        text += "\n";
    }
    let equations: Vec<_> =
        document.equations().map(|equation| format!("{}: {}", equation.label, equation.latex)).collect();
    text + "delivered: " + &equations.join(" | ")
}

macro_rules! messages {
    ($($name:ident: $source:expr;)*) => {
        $(#[test]
        fn $name() {
            insta::assert_snapshot!(rendered($source));
        })*
    };
}

messages! {
    dollars_not_closed: "# 検算\n\n歳差運動は $$ a = b\n\nそして次のとおりです。\n\n$$ c = d \\tag{2} $$\n";
    dollars_not_closed_before_another_display: "$$ a = b\n$$ c = d \\tag{2} $$\n";
    dollars_not_closed_at_the_end: "$$ c = d \\tag{2} $$\n\n日本語 $$ a = b";
    bracket_not_closed: "\\[ a = b\n\nSome prose here.\n\n\\[ c = d \\]\n";
    environment_not_closed: "日本\n\\begin{align*} a = b\n\n$$ c = d $$\n";
    environment_closed_by_another: "\\begin{align} a = b \\end{equation}\n\n$$ c = d $$\n";
    annotation_not_closed: "$$ a = b $$\n<!-- kenzan\ngiven = ['1']\n\n$$ c = d $$\n<!-- kenzan\ngiven = ['1'] -->\n";
    comment_not_closed: "$$ a = b $$\n\n<!-- 注意\n\n$$ c = d $$\n";
    empty_display: "日本 $$ $$ and $$ a $$";
    duplicate_label: "日本語 $$ a = b \\quad (52) $$ です\n\n日本語 $$ c = d \\tag{52} $$ です\n";
    several_labels_in_a_row: "$$ a = b \\tag{1} \\tag{2} $$";
    toml_does_not_parse: "$$ a $$ 歳差\n<!-- kenzan\nbecause = \"日本\" given = ['1']\n-->";
    toml_with_an_unescaped_backslash: "$$ a $$\n<!-- kenzan\nreading = \"日本\\theta\"\n-->";
    toml_with_a_key_twice: "$$ a $$\n<!-- kenzan\ngiven = ['1']\ngiven = ['2']\n-->";
    unknown_key: "$$ a $$\n<!-- kenzan\nbecause = '日本'\ngivne = ['1']\ncolour = 1\n-->";
    unknown_key_of_a_symbol: "$$ a $$\n<!-- kenzan\n[symbols]\n'角' = { units = 'rad', rage = [1, 2], colour = 'red' }\n-->";
    unknown_key_of_a_basis: "$$ a $$\n<!-- kenzan\n[basis.body]\nvector = ['a', 'b', 'c']\n-->";
    unknown_kind: "$$ a $$\n<!-- kenzan\nkind = 'derivd'\nexpect = 'wrong'\n-->";
    wrong_types: "$$ a $$\n<!-- kenzan\ngiven = [39]\nbecause = 1\norder = 'two'\ndigits = 1.5\nrange = 3\nsymbols = { a = 1 }\n-->";
    wrong_types_of_declarations: "$$ a $$\n<!-- kenzan\n[symbols]\na = { range = [1], matrix = [0, 3], index = [1.5, 2], integer = 'yes', of = 2000-01-01 }\n[basis]\nb = { axes = ['x', 'y'] }\n-->";
    range_the_wrong_way_round: "$$ a $$\n<!-- kenzan\n[symbols]\n'質量' = { range = [3, 1] }\n-->";
    range_not_finite: "$$ a $$\n<!-- kenzan\nrange = { '質' = [0, inf], b = [nan, 1] }\n-->";
    no_equation_before: "日本\n\n<!-- kenzan\ngiven = ['1']\n-->\n\n$$ a $$\n\n# 節\n\n<!-- kenzan\ngiven = ['1'] -->";
    label_without_a_formula: "日本 $x$ words between <!-- kenzan\nlabel = 'x' -->\n\n$$ a $$";
    no_such_label: "$$\\begin{aligned} a & (5) \\\\ b & (6) \\end{aligned}$$\n<!-- kenzan\nfor = '7' -->";
    second_annotation: "$$ a \\tag{1} $$\n<!-- kenzan\nbecause = 'A' -->\n<!-- kenzan\nbecause = 'B' -->";
    label_given_twice: "$$ a \\tag{1} $$ 日本 $x$\n<!-- kenzan\nlabel = '1' -->";
    label_given_to_a_numbered_equation: "$$ a \\tag{1} $$\n<!-- kenzan\nlabel = 'x' -->";
    misplaced_keys: "$$ a $$\n<!-- kenzan\ngiven = ['1']\nassume = ['b']\n-->";
    empty_annotation: "$$ a $$\n<!-- kenzan -->";
    rows_that_do_not_fit: "$$ a = \\begin{cases} b \\\\ c \\end{cases} $$\n<!-- kenzan\nrows = ['1', '2', '3'] -->";
    rows_too_late: "$$ a = \\begin{cases} b \\\\ c \\end{cases} $$\n<!-- kenzan\nbecause = 'A' -->\n<!-- kenzan\nrows = ['1', '2'] -->";
    rows_without_a_block: "$$ a = b $$\n<!-- kenzan\nrows = ['1', '2'] -->";
    rows_without_a_display: "日本 <!-- kenzan\nrows = ['1', '2'] -->";
    rows_of_cases_without_label: "$$ a = \\begin{cases} b \\\\ c \\end{cases} $$\n<!-- kenzan\nrows = ['', '2'] -->";
    symbol_without_a_name: "$$ a $$\n<!-- kenzan\n[symbols]\n'' = { unit = 'm' }\n-->";
}

#[test]
fn plain_text_says_the_same() {
    let document = parse("日本語 $$ a = b \\quad (52) $$ です\n\n日本語 $$ c = d \\tag{52} $$ です\n");
    let expected = "notes.md:3:14: the label 52 is given twice: here again; first here (line 1, column 14). \
                    give it a label of its own; references to 52 mean the first";
    assert_eq!(problems(&document), [expected]);
}

#[test]
fn a_very_long_line_is_not_printed() {
    let document = parse(&format!("{} $$ a", "日".repeat(5000)));
    let report = document.problems[0].to_miette(&document);
    assert_eq!(report.to_string(), "this display is not closed (notes.md:1:5002)");
}
