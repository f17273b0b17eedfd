//! Sidecars.

use super::tex::folder;
use super::*;

const TOML: &str = r#"
assume = ['a > 0']
[symbols]
'a, \b' = { unit = "m" }
[section."One".symbols]
c = { range = [1, 2] }
[equation."1"]
given = ["eq-x"]
because = "beside"
[equation.eq-x]
where = ['\b = a']
"#;

#[test]
fn a_sidecar_annotates_notes_that_stay_as_they_are() {
    let notes = "\\newcommand{\\b}{\\beta}\n\n# One\n\n$$ a = b \\tag{1} $$\n<!-- kenzan\nbecause = 'here'\n-->\n\n$$ c $$ {#eq-x}\n";
    let document = folder(&[("notes.md", notes), ("notes.kenzan.toml", TOML)]);
    let warning = "notes.kenzan.toml:7:12: the notes say `because` of equation 1, too: passed over; \
                   this holds (notes.md, line 6, column 1). leave out one of them";
    assert_eq!(problems(&document), [warning]);
    let kinds: Vec<_> = document
        .items
        .iter()
        .map(|item| match item {
            Item::Section(section) => section.title.clone(),
            Item::Declarations(declarations) => format!("{} symbols", declarations.symbols[0].names.len()),
            Item::Equation(equation) => equation.label.clone(),
        })
        .collect();
    assert_eq!(kinds, ["2 symbols", "One", "1 symbols", "1", "eq-x"]);
    let Item::Declarations(declarations) = &document.items[0] else { panic!() };
    assert_eq!(declarations.symbols[0].names[1].value, r"\beta");
    let annotations: Vec<_> = document.equations().map(|e| e.annotation.clone().unwrap()).collect();
    assert_eq!((annotations[0].given[0].as_str(), annotations[0].because.as_deref()), ("eq-x", Some("here")));
    assert_eq!(annotations[1].where_[0].value, r"\beta = a");
}

#[test]
fn numbers_of_latex_find_equations() {
    let notes = "\\begin{align} a &= b \\label{x} \\\\ c &= d \\label{y} \\end{align}";
    let document = folder(&[
        ("notes.tex", notes),
        ("notes.kenzan.toml", "[equation.'2']\nkind = 'law'\n[equation.x]\nkind = 'law'"),
    ]);
    assert_eq!(problems(&document), Vec::<String>::new());
    assert!(document.equations().all(|e| e.annotation.as_ref().unwrap().kind.is_some()));
}

#[test]
fn rows_and_labels_may_be_given_beside() {
    let notes = "$$ a = \\begin{cases} b & x \\\\ c & y \\end{cases} $$\n\n$$ d $$";
    let toml = "[equation.'0+1']\nrows = ['p', 'q']\n[equation.'0+2']\nlabel = 'named'\nkind = 'law'\n";
    let document = folder(&[("notes.md", notes), ("notes.kenzan.toml", toml)]);
    assert_eq!(problems(&document), Vec::<String>::new());
    let labels: Vec<_> = document.equations().map(|e| e.label.as_str()).collect();
    assert_eq!(labels, ["p", "q", "named"]);
}

#[test]
fn errors_are_told_in_the_sidecar() {
    let notes = "# One\n\n$$ a \\tag{10} $$\n\n$$ b $$ {#eq-energy}\n";
    let toml = "# 日本語\nassume = 1\ngivn = 2\n[equation.eq-enrgy]\nkind = 'law'\n[equation.11]\ngivne = ['1']\nfor = '1'\n[section.One]\ngiven = ['1']\n[section.Two]\nassume = []\n";
    let document = folder(&[("notes.md", notes), ("notes.kenzan.toml", toml)]);
    insta::assert_snapshot!(super::messages::rendered_all(&document));
    let broken = folder(&[("notes.md", notes), ("notes.kenzan.toml", "[equation")]);
    assert_eq!(broken.problems.len(), 1);
    assert_eq!(broken.equations().count(), 2);
}
