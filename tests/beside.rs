//! What is printed beside a formula: relations at braces, meanings behind colons, values at a condition, statements before
//! an arrow; and what the links of an inequality are equivalent to. Each with a formula that holds and one that fails.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use kenzan::check::verdict::{Judgement, Sensitivity, Verdict};
use kenzan::check::{self, Book, Options};
use kenzan::diagnose::sensitivity;

const SYMBOLS: &str = r#"<!-- kenzan
[symbols]
'a, b' = { range = [0.5, 2.0] }
'c, d' = { range = [-2.0, 2.0] }
'x, y' = { of = "t", range = [0.2, 1.2] }
'\vec{u}, \vec{v}' = { vector = "", of = "t" }
-->
"#;

fn book(latex: &str, annotation: &str) -> Book {
    common::book(SYMBOLS, latex, annotation)
}

fn judged(latex: &str, annotation: &str) -> Judgement {
    check::judge(&book(latex, annotation), 0, &Options::default())
}

fn tells_apart(annotation: &str, good: &str, bad: &str) {
    for (latex, expected) in [(good, Verdict::Holds), (bad, Verdict::Fails)] {
        let judgement = judged(latex, annotation);
        assert_eq!(judgement.verdict, expected, "{latex}: {:?}", judgement.reason);
    }
}

#[test]
fn what_stands_at_a_brace_is_said_of_what_it_spans() {
    tells_apart(
        "where = ['a = b']",
        r"x + \underbrace{(a - b)}_{=0} + \underbrace{c y}_{\text{a name}} = x + c y",
        r"x + (a - b) + \underbrace{c y}_{=0} = x + c y",
    );
    tells_apart(
        r"where = ['\dot{x} = 0']",
        r"2 x = \underbrace{x}_{\text{const.}} + x",
        r"2 y = \underbrace{y}_{\text{const.}} + y",
    );
    let links = judged(r"\overbrace{x}^{= y} = x", "where = ['x = y']").links;
    assert_eq!(links.len(), 2, "{links:?}");
}

#[test]
fn a_colon_tells_what_a_symbol_means() {
    tells_apart(
        "",
        r"(a + b)^2 = a^2 + 2 a b + b^2, \quad a : x \text{ at rest}",
        r"(a + b)^2 = a^2 + b^2, \quad a : x \text{ at rest}",
    );
}

#[test]
fn a_value_is_put_in_at_a_condition() {
    tells_apart("", r"\left. a x^2 \right|_{x = b} = a b^2", r"\left. a x^2 \right|_{x = b} = a x^2");
    tells_apart(
        r"where = ['\vec{u} = a \vec{v}']",
        r"\left. x \frac{d\vec{u}}{dt} \right|_{x = b} = a b \dot{\vec{v}}",
        r"\left. x \frac{d\vec{u}}{dt} \right|_{x = b} = a b \vec{v}",
    );
    assert_eq!(judged(r"\left. a x^2 \right|_{2 x = b} = a b^2", "").verdict, Verdict::Undecided);
    assert_eq!(judged(r"\left. a x^2 \right|_{x = \vec{u}} = a b^2", "").verdict, Verdict::Undecided);
}

#[test]
fn statements_stand_before_an_arrow() {
    tells_apart(
        r"where = ['x = a', 'y = b']",
        r"\left. \begin{array}{l} x = a \\ y = b \end{array} \right\} \Rightarrow x y = a b",
        r"\left. \begin{array}{l} x = a \\ y = a \end{array} \right\} \Rightarrow x y = a b",
    );
}

#[test]
fn each_link_has_its_own_equivalence() {
    tells_apart(
        "[link.1]\niff = 'c > 0'\n[link.2]\niff = 'd < 0'",
        r"a + c > a, \quad a + d < a",
        r"a + c > a, \quad a - d < a",
    );
    // The condition speaks of a symbol that a premise gives.
    tells_apart("where = ['b = a + c']\niff = 'b > a'", "a^2 + a c > a^2", "a^2 - a c > a^2");
}

fn mutants(latex: &str, annotation: &str) -> Sensitivity {
    let book = book(latex, annotation);
    let options = Options::default();
    let judgement = check::judge(&book, 0, &options);
    sensitivity::sensitivity(&book, 0, &judgement, &options).expect("it holds")
}

#[test]
fn a_weaker_inequality_is_no_survivor_and_a_stronger_one_fails() {
    // 2(a + b) > b is weaker; what is wrong fails, and a + b > a is true, but says something else.
    let found = mutants("a + b > b", "");
    assert!(found.weaker > 0 && found.killed > 0, "{found:?}");
    assert!(found.survivors.iter().all(|s| s.contains("`b` changed to `a`")), "{found:?}");
    // An equation says nothing less than another.
    assert_eq!(mutants("(a + b)^2 = a^2 + 2 a b + b^2", "").weaker, 0);
}

#[test]
fn a_statement_in_brackets_is_no_factor_to_drop() {
    let found = mutants("2 a = b (= c)", "where = ['b = 2 a', 'c = b']");
    assert!(found.survivors.is_empty(), "{found:?}");
}
