//! What annotations say, and which equation they belong to.

use super::*;

/// Labels of the equations, each with the `because` of its annotation.
fn reasons(document: &Document) -> Vec<(&str, Option<&str>)> {
    let because = |equation: &'_ Equation| equation.annotation.as_ref().and_then(|found| found.because.clone());
    let reasons = document.equations().map(|equation| (equation.label.as_str(), because(equation)));
    reasons.map(|(label, reason)| (label, reason.map(|reason| &*reason.leak()))).collect()
}

fn declarations(document: &Document) -> Vec<&Declarations> {
    let found = document.items.iter().filter_map(|item| match item {
        Item::Declarations(declarations) => Some(declarations),
        _ => None,
    });
    found.collect()
}

#[test]
fn every_key_of_an_equation_is_read_with_its_place() {
    let source = r#"日本語 $$ a = b \tag{52} $$
<!-- kenzan
kind = "derived"
given = ['39', "40"]
solve = '\ddot{\theta}'
solves = ["7"]
where = ['\theta > 0']
small = '\epsilon'
order = 2
iff = 'a'
maps = 'b'
reading = 'c'
correction = 'd'
expect = "fails"
because = "so"
digits = 3
states = 7
data = { 'a_1' = 6378.10, b = '1 \times 2' }
[range]
'\theta' = [0, 1.5]
[symbols]
'\alpha, \beta' = { unit = "rad" }
-->"#;
    let document = parse(source);
    assert_eq!(problems(&document), Vec::<String>::new());
    let found = document.equations().next().unwrap().annotation.clone().unwrap();
    let text = |text: &Spanned<String>| {
        assert_eq!(&source[text.span.clone()], text.value, "verbatim");
        text.value.clone()
    };
    let texts = |list: &[Spanned<String>]| list.iter().map(text).collect::<Vec<_>>();
    assert!(source[found.span.clone()].starts_with("<!-- kenzan") && source[found.span.clone()].ends_with("-->"));
    assert_eq!(texts(&found.given), ["39", "40"]);
    assert_eq!(texts(&found.solve), [r"\ddot{\theta}"]);
    assert_eq!(texts(&found.solves), ["7"]);
    assert_eq!(texts(&found.where_), [r"\theta > 0"]);
    let single = [found.kind, found.small, found.iff, found.maps, found.reading, found.correction, found.expect];
    let single: Vec<_> = single.iter().map(|found| text(found.as_ref().unwrap())).collect();
    assert_eq!(single, ["derived", r"\epsilon", "a", "b", "c", "d", "fails"]);
    assert_eq!((found.order, found.digits, found.states), (Some(2.0), Some(3), Some(7)));
    assert_eq!(found.because.as_deref(), Some("so"));
    assert_eq!((text(&found.range[0].0).as_str(), found.range[0].1), (r"\theta", [0.0, 1.5]));
    let data: Vec<_> = found.data.iter().map(|(symbol, value)| (text(symbol), text(value))).collect();
    assert_eq!(data, pairs(&[("a_1", "6378.10"), ("b", r"1 \times 2")]));
    assert_eq!(texts(&found.symbols[0].names), [r"\alpha", r"\beta"]);
    assert_eq!(declarations(&document).len(), 0, "symbols of an equation are its own");
}

#[test]
fn every_key_of_declarations_is_read() {
    let source = r#"
<!-- kenzan
assume = ['I_0 > 0']
[symbols]
'I_0, I_1' = { unit = "kg m^2", range = [0.3, 3.0] }
'\theta' = { of = "t", integer = true }
'\mathbf{r}_i' = { vector = "inertial", each = "i" }
T = { matrix = [3, 3], basis = "body" }
i = { index = [1, 4] }
f = { function = 2 }
h = { function = ["x", "y"] }
'\omega_z' = { same = '\omega_\zeta', component_of = '\omega' }
g = { value = 9.81 }
[basis.body]
vectors = ['\mathbf{e}_\xi', '\mathbf{e}_\eta', '\mathbf{e}_\zeta']
axes = ['\xi', '\eta', '\zeta']
euler = ['\varphi', '\theta', '\psi']
order = "zxz"
rotating = true
columns = true
-->"#;
    let document = parse(source);
    assert_eq!(problems(&document), Vec::<String>::new());
    let found = declarations(&document)[0];
    assert_eq!(found.assume[0].value, "I_0 > 0");
    let names: Vec<_> = found.symbols.iter().map(|symbol| symbol.names[0].value.as_str()).collect();
    assert_eq!(
        names,
        ["I_0", r"\theta", r"\mathbf{r}_i", "T", "i", "f", "h", r"\omega_z", "g"],
        "in the order of the file"
    );
    let [inertia, theta, position, matrix, index, two, named, same, constant] = found.symbols.as_slice() else {
        panic!()
    };
    assert_eq!(&source[inertia.names[1].span.clone()], "I_1");
    assert_eq!((inertia.unit.as_ref().unwrap().as_str(), inertia.range), ("kg m^2", Some([0.3, 3.0])));
    assert!(theta.of.as_ref().unwrap().value == "t" && theta.integer);
    assert!(position.vector.as_ref().unwrap().value == "inertial" && position.each[0].value == "i");
    assert!(matrix.matrix == Some([3, 3]) && matrix.basis.as_ref().unwrap().value == "body");
    assert_eq!(index.index, Some([1, 4]));
    assert_eq!(two.function, Some(Arguments::Count(2)));
    assert!(matches!(&named.function, Some(Arguments::Names(names)) if names.len() == 2));
    assert_eq!(same.same.as_ref().unwrap().value, r"\omega_\zeta");
    assert_eq!(same.component_of.as_ref().unwrap().value, r"\omega");
    assert_eq!(constant.range, Some([9.81, 9.81]));
    let basis = &found.bases[0];
    assert_eq!((basis.name.as_str(), basis.vectors[2].as_str()), ("body", r"\mathbf{e}_\zeta"));
    assert_eq!(basis.axes.as_ref().unwrap()[1].value, r"\eta");
    assert_eq!(basis.euler.as_ref().unwrap()[0].value, r"\varphi");
    assert!(basis.order.as_ref().unwrap().value == "zxz" && basis.rotating && basis.columns);
}

#[test]
fn texts_in_every_kind_of_quotes_know_their_place() {
    let source = "$$a$$\n<!-- kenzan\ngiven = ['p', \"q\", '''r''', \"\"\"\ns\"\"\", \"\\u0074\", '']\n-->";
    let document = parse(source);
    let given = document.equations().next().unwrap().annotation.clone().unwrap().given;
    let found: Vec<_> = given.iter().map(|text| (text.value.as_str(), &source[text.span.clone()])).collect();
    assert_eq!(found, [("p", "p"), ("q", "q"), ("r", "r"), ("s", "s"), ("t", "\"\\u0074\""), ("", "")]);
    assert_eq!(given.iter().map(Spanned::is_verbatim).collect::<Vec<_>>(), [true, true, true, true, false, true]);
}

#[test]
fn an_annotation_belongs_to_the_display_before_it() {
    let source = "$$a \\tag{1}$$ text\n\nmore <!-- kenzan\nbecause = 'A' -->\n<!-- kenzan\nassume = ['x'] -->\n$$b \\tag{2}$$\n<!-- a remark -->\n<!-- kenzan\nbecause = 'B' -->";
    let document = parse(source);
    assert_eq!(problems(&document), Vec::<String>::new());
    assert_eq!(reasons(&document), [("1", Some("A")), ("2", Some("B"))]);
    assert!(matches!(document.items.as_slice(), [Item::Equation(_), Item::Declarations(_), Item::Equation(_)]));
}

#[test]
fn rows_are_annotated_by_label_or_the_last_of_them() {
    let rows = "$$\\begin{aligned} a & (5) \\\\ b & (6) \\end{aligned}$$\n";
    let both = parse(&format!("{rows}<!-- kenzan\nbecause = 'B' -->\n<!-- kenzan\nfor = '5'\nbecause = 'A' -->"));
    assert_eq!(problems(&both), Vec::<String>::new());
    assert_eq!(reasons(&both), [("5", Some("A")), ("6", Some("B"))]);
}

#[test]
fn an_inline_formula_is_an_equation_if_it_is_labelled() {
    let source = "$$a \\tag{47}$$\nThen $x$ and $L = \\text{const.} = L_z$.\n<!-- kenzan\nlabel = 'L_z'\nbecause = 'A' -->\nand $y$\n\n$$b$$";
    let document = parse(source);
    assert_eq!(problems(&document), Vec::<String>::new());
    assert_eq!(reasons(&document), [("47", None), ("L_z", Some("A")), ("47+1", None)]);
    let inline = document.equations().nth(1).unwrap();
    assert!(inline.inline && !inline.numbered);
    assert_eq!((inline.latex.as_str(), inline.display), (r"L = \text{const.} = L_z", 1));
    check_promises(&document);
}

#[test]
fn a_label_may_be_given_to_a_display_without_one() {
    let document = parse("$$a \\tag{1}$$ $$b$$\n<!-- kenzan\nlabel = 'weight' -->\n$$c$$");
    assert_eq!(problems(&document), Vec::<String>::new());
    assert_eq!(reasons(&document).iter().map(|found| found.0).collect::<Vec<_>>(), ["1", "weight", "1+2"]);
}

#[test]
fn rows_of_cases_become_equations() {
    let source = "$$\\dot{\\varphi} = \\begin{cases} \\frac{a}{b}, & \\text{fast} \\\\ c & \\text{slow} \\end{cases} \\quad (71)$$\n<!-- kenzan\nrows = ['71', '72'] -->\n<!-- kenzan\nfor = '71'\nbecause = 'A' -->\n<!-- kenzan\nbecause = 'B' -->\n$$ d (73) $$ $$ e $$";
    let document = parse(source);
    assert_eq!(problems(&document), Vec::<String>::new());
    assert_eq!(reasons(&document), [("71", Some("A")), ("72", Some("B")), ("73", None), ("73+1", None)]);
    let rows: Vec<_> = document.equations().take(2).collect();
    assert_eq!((rows[0].prefix.as_str(), rows[0].latex.as_str()), (r"\dot{\varphi} = ", r"\frac{a}{b}"));
    assert_eq!((rows[1].prefix.as_str(), rows[1].latex.as_str()), (r"\dot{\varphi} = ", "c"));
    assert!(rows[0].numbered && !rows[1].numbered && rows[0].display == rows[1].display);
    check_promises(&document);
}

#[test]
fn rows_of_aligned_may_be_joined() {
    let source = "$$\\left. \\begin{aligned} a \\\\ b \\\\ c \\\\ d \\end{aligned} \\right\\} \\quad (412)$$\n<!-- kenzan\nrows = ['', '411', '', '412'] -->";
    assert_eq!(equations(source), pairs(&[("411", r"a \\ b"), ("412", r"c \\ d")]));
    let prefixes: Vec<_> = parse(source).equations().map(|equation| equation.prefix.clone()).collect();
    assert_eq!(prefixes, ["", ""]);
}

#[test]
fn the_last_label_of_a_document_can_be_annotated_after_others() {
    let document = parse("$$a$$\n<!-- kenzan\ngivn = ['1']\nbecause = 'A' -->");
    assert_eq!(reasons(&document), [("0+1", Some("A"))], "the rest of an annotation is kept");
    assert_eq!(document.problems.len(), 1);
}

#[test]
fn an_annotation_of_a_damaged_display_is_not_given_to_another() {
    let document = parse("$$a$$\n\n$$b\n\nSome prose here.\n<!-- kenzan\nbecause = 'B' -->\n$$c$$");
    assert_eq!(reasons(&document), [("0+1", None), ("0+2", None)]);
    assert_eq!(document.problems.len(), 1);
}
