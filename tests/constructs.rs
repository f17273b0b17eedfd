//! Constructs of lecture notes on mechanics, each with a formula that holds and one that fails: integrals along the motion,
//! sums whose index is not printed, directions, statements in brackets, laws, derivatives by several variables.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use std::path::Path;

use kenzan::check::verdict::{Judgement, Verdict};
use kenzan::check::{self, Book, Options};
use kenzan::document;

const SYMBOLS: &str = r#"<!-- kenzan
[symbols]
'j' = { index = [1, 3] }
'n' = { index = [5, 9] }
'p' = { index = [1, 9] }
'a, b' = { range = [0.5, 2.0] }
'x, y' = { of = "t", range = [0.2, 1.2] }
'm' = { each = "j", range = [0.5, 2.0] }
'r' = { each = "j", range = [0.5, 2.0] }
's_j' = { same = '(r_j + a)', each = "j" }
'r_j' = { each = "j", range = [0.5, 2.0] }
'\vec{u}, \vec{v}' = { vector = "", of = "t" }
'\vec{f}_j^{(e)}' = { vector = "", of = "t", each = "j" }
'F' = { same = '(a^2 x + b y)' }
-->
"#;

fn one(latex: &str, annotation: &str) -> Judgement {
    check::judge(&common::book(SYMBOLS, latex, annotation), 0, &Options::default())
}

fn verdict(latex: &str, annotation: &str) -> Verdict {
    one(latex, annotation).verdict
}

/// A formula that holds, and one that fails, on the same annotation.
fn tells_apart(annotation: &str, good: &str, bad: &str) {
    assert_eq!(verdict(good, annotation), Verdict::Holds, "{good}");
    assert_eq!(verdict(bad, annotation), Verdict::Fails, "{bad}");
}

#[test]
fn work_is_the_change_of_the_energy() {
    let newton = r"where = ['a \ddot{x} = y']";
    tells_apart(
        newton,
        r"\frac{1}{2} a \dot{x}^2 - \left(\frac{1}{2} a \dot{x}^2\right)_0 = \int_0^t y\,dx",
        r"\frac{1}{2} a \dot{x}^2 + \left(\frac{1}{2} a \dot{x}^2\right)_0 = \int_0^t y\,dx",
    );
    tells_apart(
        newton,
        r"\left. a \dot{x} \right|_0^t = \int_0^t y\,dt",
        r"\left. a \dot{x} \right|_0^t = \int_0^t x\,dt",
    );
    assert_eq!(verdict(r"a \dot{x} = \int_0^t y\,dt", newton), Verdict::Fails, "the velocity at the start is not zero");
}

#[test]
fn premises_may_be_integrals() {
    let premise = r"where = ['x = \int y\,dt']";
    tells_apart(premise, r"\dot{x} = y", r"\dot{x} = \dot{y}");
    tells_apart(premise, r"2 x = \int 2 y\,dt", r"x + 1 = \int y\,dt");
}

#[test]
fn premises_of_first_order_come_to_an_end() {
    let oscillator = r"where = ['\dot{x} = y', '\dot{y} = -\sin x', 'y^2 - 2 \cos x = (y^2 - 2 \cos x)_0']";
    assert_ne!(verdict(r"\dot{x} y = 3", oscillator), Verdict::Holds);
}

#[test]
fn a_sum_may_keep_its_index_to_itself() {
    tells_apart("", r"\sum m (a + r) = a \sum m + \sum m r", r"\sum m (a + r) = a + \sum m r");
    tells_apart("", r"m (r + 1) = m r + m", r"m (r + 1) = m r + r");
    tells_apart("", r"\sum_j s_j = 3a + \sum_j r_j", r"\sum_j s_j = a + \sum_j r_j");
}

#[test]
fn sums_with_bounds_by_an_index_and_choices() {
    tells_apart("", r"6 + \sum_{p=4}^{n-1} p = {}_n C_2", r"5 + \sum_{p=4}^{n-1} p = {}_n C_2");
}

#[test]
fn directions_are_compared() {
    tells_apart(r"where = ['\vec{u} = a \vec{v}']", r"\vec{u} \parallel \vec{v}", r"\vec{u} \perp \vec{v}");
    tells_apart(r"where = ['\vec{u} \cdot \vec{v} = 0']", r"\vec{u} \perp \vec{v}", r"\vec{u} \propto \vec{v}");
    tells_apart(r"where = ['\vec{u} \propto \vec{v}']", r"\vec{u} \times \vec{v} = 0", r"\vec{u} \cdot \vec{v} = 0");
}

#[test]
fn what_is_said_in_brackets_counts() {
    tells_apart("", r"a + b = b + a \quad (a b = b a)", r"a + b = b + a \quad (a b = b)");
    tells_apart(
        "",
        r"(a + b)^2 = a^2 + 2ab + b^2 \left(= (b + a)^2\right)",
        r"(a + b)^2 = a^2 + 2ab + b^2 (= a^2 + b^2)",
    );
    tells_apart("", r"a + a = 2a \rightarrow a + a + a = 3a", r"a + a = 2a \rightarrow a + a + a = 2a");
    tells_apart("", r"\underbrace{2a = a + a}_{\text{twice}} = 3a - a", r"\underbrace{2a = a + a}_{\text{twice}} = 3a");
}

#[test]
fn dots_stand_over_names_with_superscripts() {
    tells_apart(
        "",
        r"\frac{d}{dt} (x \vec{f}_j^{(e)}) = \dot{x} \vec{f}_j^{(e)} + x \dot{\vec{f}}_j^{(e)}",
        r"\frac{d}{dt} (x \vec{f}_j^{(e)}) = \dot{x} \vec{f}_j^{(e)} + x \vec{f}_j^{(e)}",
    );
}

#[test]
fn derivatives_by_several_variables() {
    tells_apart("", r"\frac{\partial F}{\partial(x, y)} = (a^2, b)", r"\frac{\partial F}{\partial(x, y)} = (b, a^2)");
    tells_apart("", r"\frac{d}{dt}(x, y) = (\dot{x}, \dot{y})", r"\frac{d}{dt}(x, y) = (\dot{y}, \dot{x})");
    tells_apart("", r"\max(a, b) \geq \frac{a + b}{2}", r"\max(a, b) \leq \frac{a + b}{2}");
}

#[test]
fn a_law_is_taken_as_given_if_it_can_be_understood() {
    let law = one(r"a \ddot{x} = y", "kind = \"law\"");
    assert_eq!((law.verdict, law.kind.as_str()), (Verdict::Definition, "law"));
    assert_eq!(verdict(r"a \ddot{x} = q", "kind = \"law\""), Verdict::Undecided, "q is not declared");
    assert_eq!(verdict(r"\vec{u} = a", "kind = \"law\""), Verdict::Fails, "a vector is no number");
}

#[test]
fn names_that_go_in_a_circle_are_refused() {
    let source =
        "<!-- kenzan\n[symbols]\n'a' = { same = 'b + 1' }\n'b' = { same = 'a' }\n-->\n\n$$ a = a \\tag{1} $$\n";
    let document = document::parse(Path::new("notes.md"), source);
    let book = Book::new(&document);
    assert!(book.problems.iter().any(|p| p.message.contains("another notation of itself")), "{:?}", book.problems);
    assert_ne!(check::judge(&book, 0, &Options::default()).verdict, Verdict::Holds);
}

#[test]
fn rows_and_items_without_a_relation_are_not_passed_over() {
    let annotation = "";
    for latex in [
        r"\begin{aligned} a + b &= b + a \\ a b (a &+ b) \end{aligned}",
        r"a + b = b + a, \quad a b",
        r"\left. \begin{array}{l} a + b = b + a \\ a (a + b) \end{array} \right\}",
    ] {
        assert_eq!(verdict(latex, annotation), Verdict::Undecided, "{latex}");
    }
    // What the next row continues is a side; a name is a remark.
    for latex in [r"\begin{aligned} a &+ b \\ &= b + a \end{aligned}", r"a + b = b + a, \quad a; \text{ the first}"] {
        assert_eq!(verdict(latex, annotation), Verdict::Holds, "{latex}");
    }
}

#[test]
fn what_the_print_has_lost_may_be_an_erratum() {
    let correction = r"correction = '\begin{aligned} a + b &= b + a \\ a b &= b a \end{aligned}'";
    let lost = r"\begin{aligned} a + b &= b + a \\ a b & b a \end{aligned}";
    let judged = one(lost, &format!("expect = \"undecided\"\n{correction}"));
    assert!(judged.verdict == Verdict::Undecided && judged.as_expected && judged.is_erratum());
    let judged = one(lost, correction);
    assert!(!judged.as_expected && !judged.is_erratum());
    let wrong = r"correction = '\begin{aligned} a + b &= b + a \\ a b &= b + a \end{aligned}'";
    let judged = one(lost, &format!("expect = \"undecided\"\n{wrong}"));
    assert!(!judged.as_expected && !judged.is_erratum());
}

#[test]
fn the_columns_of_an_array_are_one_row() {
    for (open, eq) in [("{rcl}", "&=&"), ("{rl}", "&="), ("{l}", "=")] {
        let rows = |right: &str| format!(r"\begin{{array}}{open} a + b {eq} b + a \\ a b {eq} {right} \end{{array}}");
        tells_apart("", &rows("b a"), &rows("b a + 1"));
    }
}

#[test]
fn conditions_beside_a_row_restrict_it() {
    tells_apart(
        "",
        r"\begin{cases} |a - b| = a - b & a > b \\ |a - b| = b - a & (a < b) \end{cases}",
        r"\begin{cases} |a - b| = a - b & a < b \\ |a - b| = b - a & (a < b) \end{cases}",
    );
    tells_apart(
        "",
        r"a^2 - b^2 = (a - b)(a + b) \begin{cases} > 0, & a > b \\ < 0, & a < b \end{cases}",
        r"a^2 - b^2 = (a - b)(a + b) \begin{cases} > 0, & a < b \\ < 0, & a > b \end{cases}",
    );
    // The cell behind continues the first.
    tells_apart("", r"\begin{cases} a - a = 0 & = b - b \end{cases}", r"\begin{cases} a - a = 0 & = b + b \end{cases}");
}

#[test]
fn what_only_restates_a_premise_is_told() {
    let restated = |latex: &str, annotation: &str| Judgement::only_restates(&one(latex, annotation).links);
    assert!(restated("x = a + b", "where = ['a + b = x']"));
    assert!(restated(r"\vec{u} = a \vec{v}", r"where = ['\vec{u} = a \vec{v}']"));
    assert!(!restated("x - a = b", "where = ['a + b = x']"));
    assert!(!restated("x = a + b = b + x - b", "where = ['a + b = x']"));
}

#[test]
fn a_rate_at_a_moment_is_that_of_the_motion_then() {
    let law = r"where = ['\dot{x} = x^2']";
    tells_apart(law, r"\left. \frac{dx}{dt} \right|_{x = a} = a^2", r"\left. \frac{dx}{dt} \right|_{x = a} = a^3");
    assert_eq!(verdict(r"\left. \frac{dx}{dt} \right|_{x = a} = 0", law), Verdict::Fails);
}
