//! Constructs of lecture notes on canonical transformations and elliptic functions, each with a formula that holds and
//! one that fails: integrals with a variable limit and their derivatives by parameters, values at a condition, limits,
//! numbers in proportion, Kronecker's delta, signs within signs.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use kenzan::check::verdict::{Judgement, Verdict};
use kenzan::check::{self, Options};

const SYMBOLS: &str = r#"<!-- kenzan
[symbols]
'k, l' = { index = [1, 3] }
'r_k' = { each = ["k"], range = [0.5, 2.0] }
'e_l' = { each = ["l"], same = '(\delta_{l1} a + \delta_{l2} b + \delta_{l3} c)' }
'a' = { range = [0.3, 0.6] }
'b' = { range = [1.0, 2.0] }
'x, y, z' = { of = "t", range = [0.8, 1.2] }
'u' = { range = [0.05, 0.1] }
'c' = { range = [0.05, 0.2] }
-->
"#;

fn one(latex: &str, annotation: &str) -> Judgement {
    check::judge(&common::book(SYMBOLS, latex, annotation), 0, &Options::default())
}

fn verdict(latex: &str, annotation: &str) -> Verdict {
    one(latex, annotation).verdict
}

/// A formula that has a verdict, and one that fails, on the same annotation.
fn tells_apart(annotation: &str, verdict_of_good: Verdict, good: &str, bad: &str) {
    assert_eq!(verdict(good, annotation), verdict_of_good, "{good}");
    assert_eq!(verdict(bad, annotation), Verdict::Fails, "{bad}");
}

#[test]
fn integrals_begin_at_their_lower_limit() {
    tells_apart(
        "",
        Verdict::Holds,
        r"\int_a^x b x\,dx = \frac{b}{2} (x^2 - a^2)",
        r"\int_a^x b x\,dx = \frac{b}{2} x^2",
    );
    tells_apart(
        "",
        Verdict::Holds,
        r"\int_0^x \frac{dx}{1 + x^2} = \arctan x",
        r"\int_0^x \frac{dx}{1 - x^2} = \arctan x",
    );
    let two = verdict(r"\int_a^x x\,dx - \int_b^x x\,dx = \frac{1}{2} (b^2 - a^2)", "");
    assert_eq!(two, Verdict::Undecided, "a motion has one start");
}

#[test]
fn derivatives_of_integrals_by_parameters() {
    tells_apart(
        "",
        Verdict::Holds,
        r"\frac{\partial}{\partial b} \left( \int_a^x \sin(b x)\,dx \right) = \int_a^x x \cos(b x)\,dx",
        r"\frac{\partial}{\partial b} \left( \int_a^x \sin(b x)\,dx \right) = \int_a^x b \cos(b x)\,dx",
    );
    tells_apart(
        "",
        Verdict::Holds,
        r"\frac{\partial}{\partial a} \left( \int_a^x a x\,dx \right) = \int_a^x x\,dx - a^2",
        r"\frac{\partial}{\partial a} \left( \int_a^x a x\,dx \right) = \int_a^x x\,dx",
    );
    tells_apart(
        "",
        Verdict::Holds,
        r"\frac{\partial}{\partial x} \left( \int_a^x x^2\,dx \right) = x^2",
        r"\frac{\partial}{\partial x} \left( \int_a^x x^2\,dx \right) = 2 x",
    );
    let along = verdict(r"\frac{\partial}{\partial x} \left( \int_0^t x y\,dt \right) = 0", "");
    assert_eq!(along, Verdict::Undecided, "along a motion it is not said what stays");
}

#[test]
fn values_at_a_condition() {
    tells_apart(
        "",
        Verdict::Holds,
        r"\left[ x^2 + y \right]_{x = b} = b^2 + y",
        r"\left[ x^2 + y \right]_{x = b} = b + y",
    );
    tells_apart(
        "",
        Verdict::Holds,
        r"\int_0^x \cos(x)\,dx = \left. \sin x \right|_0^x",
        r"\int_0^x \cos(x)\,dx = \left. \cos x \right|_0^x",
    );
}

#[test]
fn an_arrow_leads_to_the_limit() {
    let grows = r"small = '\frac{1}{u}'";
    tells_apart(grows, Verdict::Asymptotic, r"\text{sech} u \rightarrow 0", r"\tanh u \rightarrow 0");
    tells_apart(grows, Verdict::Asymptotic, r"b \tanh u \rightarrow b", r"b \tanh u \rightarrow a");
    // What is said to be equal must be so, not only in the limit.
    tells_apart(
        grows,
        Verdict::Asymptotic,
        r"\frac{\sinh u}{\cosh^2 u} = \text{sech} u \tanh u \rightarrow 0",
        r"\frac{1}{\sinh u} = \text{sech} u \rightarrow 0",
    );
    assert_eq!(verdict(r"\tanh u \rightarrow 1", ""), Verdict::Undecided, "where u goes is not said");
}

#[test]
fn only_what_is_said_to_be_near_is_near() {
    let small = "small = 'c'\norder = 1";
    tells_apart(
        small,
        Verdict::Asymptotic,
        r"(b + c)^2 = b^2 + 2bc + c^2 \simeq b^2",
        r"(b + c)^2 = b^2 + 2bc \simeq b^2",
    );
    assert_eq!(verdict(r"(b + c)^2 \simeq b", small), Verdict::Fails);
    assert_eq!(verdict(r"(b + c)^2 \simeq b^2", ""), Verdict::Undecided, "what is small is not said");
}

#[test]
fn numbers_in_proportion_along_the_motion() {
    let motion = r"where = ['\dot{x} = a y^2', '\dot{y} = b']";
    tells_apart(motion, Verdict::Holds, r"\int \frac{dx}{y^2} \propto \int dt", r"\int \frac{dx}{y} \propto \int dt");
    tells_apart(r"where = ['x = a z^2']", Verdict::Holds, r"\sqrt{x} \propto z", r"x \propto z");
}

#[test]
fn deltas_of_two_indices() {
    tells_apart("", Verdict::Holds, r"\sum_l \delta_{kl} r_l = r_k", r"\sum_l \delta_{kl} r_l = 2 r_k");
    // The letter of a family's name is its own: here k is free, and l summed.
    tells_apart("", Verdict::Holds, r"\sum_k e_k = a + b + c", r"\sum_k e_k = 3 (a + b + c)");
}

#[test]
fn signs_within_signs() {
    let roots = r"where = ['(\cos x - \cos(a + b)) (\cos x - \cos(a - b)) = 0', '-\pi < x', 'x < \pi']
range = { 'x' = [-3.0, 3.0] }
solve = ['x']";
    tells_apart(roots, Verdict::Holds, r"x = \pm(a \pm b)", r"x = a \pm b");
}
