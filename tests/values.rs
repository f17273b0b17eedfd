//! Printed values: rounded numerals, orders of magnitude, ratios of whole numbers, data; each with a value that holds and one
//! that fails. And the constructs of canonical perturbation theory: means over angles, Poisson brackets.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use kenzan::check::verdict::{Judgement, Verdict};
use kenzan::check::{self, Book, Options};
use kenzan::diagnose::sensitivity::sensitivity;

const SYMBOLS: &str = r#"<!-- kenzan
canonical = { p = 'q', P = 'Q' }
[symbols]
't' = { unit = "s", range = [0.1, 1.0] }
'\tau' = { same = 't' }
'a, b, c' = { range = [0.5, 2.0] }
'e' = { range = [0.05, 0.2] }
'n, \omega' = { unit = "rad/s", range = [0.5, 2.0] }
'u, v, E' = { unit = "rad", range = [0.3, 1.2] }
'I' = { unit = "rad", range = [0.3, 1.2] }
'p, q, P, Q' = { of = "t", range = [0.5, 2.0] }
'H' = { same = '(a p^2 + b q^2 + c P Q)' }
-->
"#;

fn book(latex: &str, annotation: &str) -> Book {
    common::book(SYMBOLS, latex, annotation)
}

fn one(latex: &str, annotation: &str) -> Judgement {
    check::judge(&book(latex, annotation), 0, &Options::default())
}

/// Formulas that hold, and such that fail, on the same annotation.
fn tells_apart(annotation: &str, good: &[&str], bad: &[&str]) {
    for (formulas, expected) in [(good, Verdict::Holds), (bad, Verdict::Fails)] {
        for latex in formulas {
            let judgement = one(latex, annotation);
            assert_eq!(judgement.verdict, expected, "{latex}: {:?}", judgement.reason);
        }
    }
}

#[test]
fn a_numeral_is_right_to_half_a_unit_of_its_last_digit() {
    tells_apart(
        "kind = 'value'\ndata = { a = '0.0032738' }",
        &[
            "a = 0.0033",
            "a = 0.00327",
            r"a \cong 3.274 \times 10^{-3}",
            r"a \sim \frac{1}{305}",
            r"-a = -\frac{1}{305}",
        ],
        &["a = 0.0032", "a = 0.00328", r"a \cong 3.273 \times 10^{-3}", r"a \sim \frac{1}{306}", r"a = -\frac{1}{305}"],
    );
}

#[test]
fn fewer_digits_may_be_asked_for() {
    tells_apart(
        "kind = 'value'\ndigits = 2\ndata = { a = '0.0032738' }",
        &["a = 0.00330", "1/a = 310"],
        &["a = 0.00340", "1/a = 320"],
    );
}

#[test]
fn a_power_of_ten_is_an_order_of_magnitude() {
    tells_apart(
        "kind = 'value'\ndata = { a = '0.002' }",
        &[r"a \sim 10^{-3}", r"1/a \sim 1000"],
        &[r"a \sim 10^{-2}", r"a \sim -10^{-3}", r"1/a = 1000"],
    );
}

#[test]
fn a_ratio_of_whole_numbers_is_a_convergent() {
    let annotation = "kind = 'value'\ndata = { a = '58.646', b = '87.969' }";
    tells_apart(
        annotation,
        &[r"b : a \sim 3 : 2", r"\frac{b}{a} \sim \frac{3}{2}"],
        &[r"b : a \sim 2 : 3", r"a : b \sim 3 : 4"],
    );
}

#[test]
fn units_of_time_and_of_arc() {
    tells_apart(
        "kind = 'value'\nwhere = ['y = 365.25 d', '\\omega = 2\\pi \\frac{366.25}{y}']\n[symbols]\n'y, d' = { unit = 's', range = [1.0, 2.0] }",
        &[
            r"\omega = 4''747 \times 10^8 / y",
            r"\omega = 1^\circ.32 \times 10^5 / y",
            r"\frac{18.6 y}{27.6 d} \sin 10^\circ 18' = 44.0",
        ],
        &[
            r"\omega = 4''746 \times 10^8 / y",
            r"\frac{18.6 y}{27.6 d} \sin 10^\circ 18' = 44.1",
            r"\omega = 4'747 \times 10^8 / y",
        ],
    );
}

#[test]
fn a_value_without_data_is_a_datum_and_known_behind() {
    let judgement = one(r"a = 0.2, \quad b = 1/a, \quad b = 5.0", "kind = 'value'\nwhere = ['b = 1/a']");
    let verdicts: Vec<Verdict> = judgement.links.iter().map(|l| l.verdict).collect();
    assert_eq!(verdicts, [Verdict::Definition, Verdict::Holds, Verdict::Holds]);
    let judgement = one("a = 0.2", "kind = 'value'\nwhere = ['a = 2 b']");
    assert_eq!(judgement.verdict, Verdict::Undecided);
    let judgement = one("a + b = 0.2", "kind = 'value'");
    assert_eq!(judgement.verdict, Verdict::Undecided);
    assert!(judgement.reason.unwrap().contains("no value is known"));
}

#[test]
fn what_is_left_free_may_cancel() {
    tells_apart("kind = 'value'\nwhere = ['a = 0.9 b']", &[r"\frac{b - a}{b} = 0.1"], &[r"\frac{b - a}{b} = 0.2"]);
}

#[test]
fn every_digit_counts() {
    let annotation = "kind = 'value'\ndata = { a = '17.258', b = '8.3668e-5' }";
    for latex in ["a = 17.3", "b = 8.37 \\times 10^{-5}"] {
        let book = book(latex, annotation);
        let judgement = check::judge(&book, 0, &Options::default());
        let found = sensitivity(&book, 0, &judgement, &Options::default()).unwrap();
        assert!(found.survivors.is_empty() && found.killed >= 3, "{found:?}");
    }
}

#[test]
fn means_over_angles() {
    tells_apart(
        "",
        &[r"\langle a \cos^2(2u + v) + c \rangle_{u} = \frac{a}{2} + c"],
        &[r"\langle a \cos^2(2u + v) \rangle_{u, v} = a"],
    );
    // Hansen's coefficient X^{-3,2}_1 to the third order.
    let hansen = |series: &str| {
        let mean = r"\langle \frac{(2 \left(\frac{\cos E - e}{1 - e \cos E}\right)^2 - 1) \cos(E - e \sin E) + 2 \frac{\sqrt{1 - e^2} \sin E (\cos E - e)}{(1 - e \cos E)^2} \sin(E - e \sin E)}{(1 - e \cos E)^2} \rangle_E";
        one(&format!("{mean} = {series}"), "small = 'e'\norder = 4").verdict
    };
    assert_eq!(hansen(r"-\frac{1}{2} e + \frac{1}{16} e^3"), Verdict::Asymptotic);
    assert_eq!(hansen(r"-\frac{1}{2} e - \frac{1}{16} e^3"), Verdict::Fails);
}

#[test]
fn a_mean_that_does_not_converge_is_undecided() {
    assert_eq!(one(r"\langle u \rangle_u = \pi", "").verdict, Verdict::Undecided);
}

#[test]
fn poisson_brackets_and_canonical_equations() {
    let motion = r"where = ['\frac{d}{dt}(p, P) = \frac{\partial H}{\partial(q, Q)}', '\frac{d}{dt}(q, Q) = -\frac{\partial H}{\partial(p, P)}']";
    tells_apart(motion, &[r"\frac{d}{d\tau} (p q P) = \{p q P, H\}"], &[r"\frac{d}{d\tau} (p q P) = \{H, p q P\}"]);
    tells_apart("", &[r"\{(q, p), H\} = (-2 a p, 2 b q)"], &[r"\{(q, p), H\} = (2 a p, 2 b q)"]);
    tells_apart(
        "",
        &[r"\frac{\partial \sin^2 I}{\partial(\cos I)} = -2 \cos I"],
        &[r"\frac{\partial \sin^2 I}{\partial(\cos I)} = 2 \cos I"],
    );
}

#[test]
fn names_before_const_are_all_constant() {
    let still = r"where = ['\dot{p} = 0', '\dot{q} = n', '\dot{n} = 0']";
    tells_apart(
        still,
        &[r"p, P Q - P Q + p = \text{const.}", r"q = n t + \text{const.}"],
        &[r"q, p = \text{const. for } \tau"],
    );
}

#[test]
fn numbers_in_proportion() {
    let motion = r"where = ['\dot{p} = a \sin q']";
    tells_apart(
        motion,
        &[r"\dot{p} \propto \sin q", r"\dot{p} \propto a \sin q"],
        &[r"\dot{p} \propto \cos q", r"p \propto \sin q"],
    );
}

#[test]
fn only_remarks_are_statements() {
    assert_eq!(one(r"p, q \rightarrow P, Q", "kind = 'statement'").verdict, Verdict::Statement);
    assert_eq!(one(r"a \ll b", "kind = 'statement'").verdict, Verdict::Statement);
    assert_eq!(one("a = a + b", "kind = 'statement'").verdict, Verdict::Fails);
}
