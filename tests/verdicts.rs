//! Small notes whose verdicts are known: every check must be able to hold, to fail, and to be undecided.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::collections::BTreeMap;
use std::path::Path;

use kenzan::check::verdict::{Judgement, Strength, Verdict};
use kenzan::check::{self, Book, Options};
use kenzan::document;

const SYMBOLS: &str = r#"<!-- kenzan
[symbols]
'a, b, c' = { range = [0.5, 2.0] }
'x, y' = { of = "t", range = [0.2, 1.2] }
'\theta' = { unit = "rad", of = "t", range = [0.2, 1.2] }
'\omega' = { unit = "rad/s", range = [1.0, 3.0] }
't' = { unit = "s", range = [0.1, 2.0] }
'\epsilon' = { range = [0.05, 0.2] }
'i' = { index = [1, 3] }
'm_i' = { each = "i", range = [0.5, 2.0] }
'\mathbf{u}, \mathbf{v}, \mathbf{w}' = { vector = "", of = "t" }
'\mathbf{r}_i' = { vector = "", of = "t", each = "i" }
'f' = { function = 1 }
'M, N' = { matrix = [2, 2] }
-->
"#;

/// Judges notes that consist of the symbols above and some equations.
fn judge(equations: &str) -> BTreeMap<String, Judgement> {
    let source = format!("# Notes\n\n{SYMBOLS}\n{equations}\n");
    let document = document::parse(Path::new("notes.md"), &source);
    assert!(document.problems.is_empty(), "{:?}", document.problems);
    let book = Book::new(&document);
    let judged = (0..book.entries.len()).map(|k| check::judge(&book, k, &Options::default()));
    judged.map(|j| (j.label.clone(), j)).collect()
}

/// The verdict on one equation with an annotation.
fn verdict(latex: &str, annotation: &str) -> Verdict {
    one(latex, annotation).verdict
}

fn one(latex: &str, annotation: &str) -> Judgement {
    let all = judge(&format!("$$ {latex} \\tag{{1}} $$\n<!-- kenzan\nbecause = \"a test\"\n{annotation}\n-->\n"));
    all.into_values().next().expect("one equation")
}

#[test]
fn identities_hold_or_fail() {
    for (good, bad) in [
        (r"\sin^2 a + \cos^2 a = 1", r"\sin^2 a + \cos a = 1"),
        (r"(a + b)^2 = a^2 + 2ab + b^2", r"(a + b)^2 = a^2 + ab + b^2"),
        (r"\sin 2a = 2 \sin a \cos a", r"\sin 2a = \sin a \cos a"),
        (r"\frac{d}{dt} (x^2 y) = 2 x \dot{x} y + x^2 \dot{y}", r"\frac{d}{dt} (x^2 y) = 2 x \dot{x} y + x \dot{y}"),
        (
            r"\frac{d}{dt} \sin \theta = \cos \theta \dot{\theta}",
            r"\frac{d}{dt} \sin \theta = -\cos \theta \dot{\theta}",
        ),
        (r"\frac{d}{dt} \sin \omega t = \omega \cos \omega t", r"\frac{d}{dt} \sin \omega t = \cos \omega t"),
        (
            r"\mathbf{u} \times (\mathbf{v} \times \mathbf{w}) = \mathbf{v} (\mathbf{u} \cdot \mathbf{w}) - \mathbf{w} (\mathbf{u} \cdot \mathbf{v})",
            r"\mathbf{u} \times (\mathbf{v} \times \mathbf{w}) = \mathbf{v} (\mathbf{u} \cdot \mathbf{w}) + \mathbf{w} (\mathbf{u} \cdot \mathbf{v})",
        ),
        (
            r"\frac{d}{dt} \sum_i m_i \mathbf{r}_i \times \dot{\mathbf{r}}_i = \sum_i m_i \mathbf{r}_i \times \ddot{\mathbf{r}}_i",
            r"\frac{d}{dt} \sum_i m_i \mathbf{r}_i \times \dot{\mathbf{r}}_i = \sum_i m_i \dot{\mathbf{r}}_i \times \ddot{\mathbf{r}}_i",
        ),
        (r"(M N)^{-1} = N^{-1} M^{-1}", r"(M N)^{-1} = M^{-1} N^{-1}"),
        (r"a + a = 2a = 3a - a", r"a + a = 2a = 3a"),
    ] {
        assert_eq!(verdict(good, ""), Verdict::Holds, "{good}");
        assert_eq!(verdict(bad, ""), Verdict::Fails, "{bad}");
    }
}

#[test]
fn a_tiny_difference_is_a_difference() {
    // Far below what doubles see: the residual exceeds its own rounding bound in double-double.
    assert_eq!(verdict(r"a + 0.00000000000000000001 b = a", ""), Verdict::Fails);
}

#[test]
fn a_letter_before_a_bracket_is_a_factor_unless_it_is_a_function() {
    assert_eq!(verdict(r"a(b + c) = ab + ac", ""), Verdict::Holds);
    let function = one(r"f(b + c) = f(b) + f(c)", "");
    assert_eq!(function.verdict, Verdict::Undecided, "a function without a definition cannot be evaluated");
}

#[test]
fn premises_are_solved_and_matter() {
    let good = r"\ddot{x} = -\omega^2 x";
    assert_eq!(verdict(good, ""), Verdict::Fails, "without premises it is no identity");
    assert_eq!(verdict(good, r"where = ['x = a \cos \omega t']"), Verdict::Holds);
    assert_eq!(verdict(good, r"where = ['x = a \cos 2\omega t']"), Verdict::Fails);
}

#[test]
fn constants_of_the_motion() {
    let oscillator = r"where = ['\ddot{x} + \omega^2 x = 0']";
    assert_eq!(verdict(r"\dot{x}^2 + \omega^2 x^2 = \text{const.}", oscillator), Verdict::Holds);
    assert_eq!(verdict(r"\dot{x}^2 - \omega^2 x^2 = \text{const.}", oscillator), Verdict::Fails);
    assert_eq!(verdict(r"\dot{x}^2 + \omega^2 x^2 = \text{const.}", ""), Verdict::Fails);
}

#[test]
fn derived_equations_use_corrected_premises() {
    let all = judge(
        r#"
$$ y = a x + b \tag{1} $$

$$ \dot{y} = x \dot{x} \tag{2} $$
<!-- kenzan
given = ["1"]
correction = '\dot{y} = a \dot{x}'
expect = "fails"
-->

$$ \ddot{y} = a \ddot{x} \tag{3} $$
<!-- kenzan
given = ["2"]
-->
"#,
    );
    assert_eq!(all["1"].verdict, Verdict::Definition);
    assert_eq!(all["2"].verdict, Verdict::Fails);
    assert!(all["2"].is_erratum() && all["2"].as_expected);
    assert!(all["2"].counterexample.is_some());
    assert_eq!(all["3"].verdict, Verdict::Holds);
}

#[test]
fn a_correction_that_does_not_hold_is_not_as_expected() {
    let judged = one(r"\sin 2a = \sin a \cos a", "correction = '\\sin 2a = 3 \\sin a \\cos a'\nexpect = \"fails\"");
    assert_eq!(judged.verdict, Verdict::Fails);
    assert!(!judged.is_erratum() && !judged.as_expected);
}

#[test]
fn an_expectation_decides_nothing() {
    let judged = one(r"\sin 2a = \sin a \cos a", "expect = \"holds\"");
    assert_eq!(judged.verdict, Verdict::Fails);
    assert!(!judged.as_expected);
    let judged = one(r"\sin 2a = 2 \sin a \cos a", "expect = \"fails\"");
    assert_eq!(judged.verdict, Verdict::Holds);
    assert!(!judged.as_expected, "a mended misprint turns the expectation red");
}

#[test]
fn approximations_have_the_order_that_is_claimed_or_fail() {
    let at = |order: u32| format!("small = '\\epsilon'\norder = {order}");
    assert_eq!(verdict(r"\sin \epsilon = \epsilon", &at(2)), Verdict::Asymptotic);
    assert_eq!(verdict(r"\sin \epsilon = \epsilon", &at(3)), Verdict::Fails);
    assert_eq!(verdict(r"\cos \epsilon = 1 - \frac{\epsilon^2}{2}", &at(4)), Verdict::Asymptotic);
    assert_eq!(verdict(r"\cos \epsilon = 1 + \frac{\epsilon^2}{2}", &at(4)), Verdict::Fails);
    let order = one(r"\cos \epsilon = 1 - \frac{\epsilon^2}{2}", &at(4)).links[0].order.clone().expect("an order");
    assert!((order.measured - 4.0).abs() < 0.01, "measured {}", order.measured);
    assert!(order.residuals.len() > 6, "at least six halvings");
}

#[test]
fn both_roots_of_a_quadratic() {
    let premise = "where = ['a x^2 - b x + c = 0']\nsolve = ['x']\nrange = { 'b' = [5.0, 9.0], 'x' = [0.1, 20.0] }";
    assert_eq!(verdict(r"x = \frac{b \pm \sqrt{b^2 - 4ac}}{2a}", premise), Verdict::Holds);
    assert_eq!(verdict(r"x = \frac{b + \sqrt{b^2 - 4ac}}{2a}", premise), Verdict::Fails);
    assert_eq!(verdict(r"x = \frac{b \pm \sqrt{b^2 - 2ac}}{2a}", premise), Verdict::Fails);
}

#[test]
fn inequalities_and_their_conditions() {
    assert_eq!(verdict(r"a^2 + b^2 \geq 2ab", ""), Verdict::Holds);
    assert_eq!(verdict(r"a^2 + b^2 \geq 3ab", ""), Verdict::Fails);
    let real = r"iff = 'b^2 - 4ac \geq 0'";
    assert_eq!(verdict(r"b \geq 2 \sqrt{ac}", real), Verdict::Holds);
    assert_eq!(verdict(r"b \geq \sqrt{ac}", real), Verdict::Fails);
    assert_eq!(verdict(r"b \geq 3 \sqrt{ac}", real), Verdict::Fails);
    let one_sided = "iff = 'a > 0'";
    assert_eq!(verdict(r"a \geq 0", one_sided), Verdict::Undecided, "states on both sides of the condition are needed");
}

#[test]
fn shapes_that_do_not_meet_are_the_authors() {
    let judged = one(r"\mathbf{u} + a = \mathbf{v}", "");
    assert_eq!((judged.verdict, judged.strength), (Verdict::Fails, Some(Strength::Shape)));
    assert!(judged.reason.expect("a reason").contains("cannot add"));
}

#[test]
fn what_is_lacking_is_undecided() {
    let undeclared = one(r"a = \kappa", "");
    assert_eq!(undeclared.verdict, Verdict::Undecided);
    assert!(undeclared.reason.expect("a reason").contains("undeclared symbol \\kappa"));
    let unsolvable = one(r"x = a", "where = ['x^2 = -1 - a^2']");
    assert_eq!(unsolvable.verdict, Verdict::Undecided);
    let contradiction = one(r"x = a", "where = ['x = a', 'x = a + 1']");
    assert_eq!(contradiction.verdict, Verdict::Undecided, "from contradictory premises nothing follows");
}

#[test]
fn premises_in_a_circle_are_found() {
    let all = judge(
        "$$ x = a \\tag{1} $$\n<!-- kenzan\ngiven = [\"2\"]\n-->\n\n$$ x = a \\tag{2} $$\n<!-- kenzan\ngiven = [\"1\"]\n-->\n",
    );
    assert!(all.values().all(|j| j.verdict == Verdict::Undecided));
    assert!(all["1"].reason.clone().expect("a reason").contains("circle"));
}

#[test]
fn a_statement_needs_a_reason_and_nothing_to_evaluate() {
    let all = judge("$$ \\tag{1} $$\n<!-- kenzan\nkind = \"statement\"\nbecause = \"nothing is printed\"\n-->\n");
    assert_eq!(all["1"].verdict, Verdict::Statement);
    // An annotation cannot wave an equation through.
    assert_eq!(verdict(r"\sin a = a", "kind = \"statement\""), Verdict::Fails);
}

#[test]
fn the_same_seed_gives_the_same_judgement() {
    let equation = "$$ \\sin a = a \\tag{1} $$";
    let strip = |mut j: Judgement| {
        j.micros = 0;
        j
    };
    let (first, second) = (judge(equation), judge(equation));
    assert_eq!(strip(first["1"].clone()), strip(second["1"].clone()));
}

#[test]
fn a_premise_is_not_solved_by_a_common_factor_that_is_zero() {
    // Where \dot x = 0 the premise holds whatever c is, and so would anything multiplied by \dot x.
    let premise = r"where = '\dot{x} \ddot{x} + c x \dot{x} = 0'";
    assert_eq!(verdict(r"\frac{d}{dt} (\dot{x}^2 + c x^2) = 0", premise), Verdict::Holds);
    assert_eq!(verdict(r"\frac{d}{dt} (\dot{x}^2 + 2 c x^2) = 0", premise), Verdict::Fails);
}

#[test]
fn premises_of_one_link_are_not_used_for_another() {
    // With \dot x = 0 given for both, the first link would hold whatever its factors are.
    let formula = r"\frac{d}{dt} x^2 = 2 x \dot{x} = 0";
    let misprint = r"\frac{d}{dt} x^2 = 3 x \dot{x} = 0";
    assert_eq!(verdict(misprint, r"where = '\dot{x} = 0'"), Verdict::Holds);
    assert_eq!(verdict(misprint, "[link.2]\nwhere = '\\dot{x} = 0'"), Verdict::Fails);
    assert_eq!(verdict(formula, "[link.2]\nwhere = '\\dot{x} = 0'"), Verdict::Holds);
}

#[test]
fn a_general_solution_has_all_its_constants() {
    let solve = |formula: &str, general: &str| {
        let all = judge(&format!(
            "$$ \\ddot{{x}} = - \\omega^2 x \\tag{{1}} $$\n\n$$ x = {formula} \\tag{{2}} $$\n\
             <!-- kenzan\nsolves = \"1\"\ngeneral = {general}\n-->\n"
        ));
        all["2"].verdict
    };
    assert_eq!(solve(r"a \cos \omega t + b \sin \omega t", r#"["a", "b"]"#), Verdict::Holds);
    assert_eq!(solve(r"a \cos (\omega t + b)", r#"["a", "b"]"#), Verdict::Holds);
    assert_eq!(solve(r"a \cos \omega t", r#"["a"]"#), Verdict::Fails);
    assert_eq!(solve(r"a \cos \omega t + b \cos \omega t", r#"["a", "b"]"#), Verdict::Fails);
    assert_eq!(solve(r"a \cos \omega t + b \sin 2 \omega t", r#"["a", "b"]"#), Verdict::Fails);
}

#[test]
fn premises_that_say_what_is_greater_restrict_the_states() {
    assert_eq!(verdict(r"\sqrt{(a - b)^2} = a - b", "where = 'a > b'"), Verdict::Holds);
    assert_eq!(verdict(r"\sqrt{(a - b)^2} = a - b", ""), Verdict::Fails);
    assert_eq!(verdict(r"\sqrt{(a - b)^2} = a - b", "where = 'a < b'"), Verdict::Fails);
    assert_eq!(verdict(r"(a - b)(b - c) > 0", "where = 'a > b > c'"), Verdict::Holds);
    assert_eq!(verdict(r"(a - b)(b - c) > 0", "where = 'a > b < c'"), Verdict::Fails);
    assert_eq!(verdict(r"a > b", "where = ['a > 2 c', 'c > 2 a']"), Verdict::Undecided);
}

#[test]
fn a_law_is_taken_as_given_if_a_state_satisfies_it() {
    assert_eq!(verdict(r"a \ddot{x} = - b x", r#"kind = "law""#), Verdict::Definition);
    assert_eq!(verdict(r"a \ddot{x} = - b x", ""), Verdict::Fails);
    assert_eq!(verdict(r"\ddot{x}^2 = - b^2 x^2", r#"kind = "law""#), Verdict::Fails);
    assert_eq!(verdict(r"\ddot{x} = \ddot{x} + a^2", r#"kind = "law""#), Verdict::Fails);
    assert_eq!(verdict(r"\frac{d}{dt} x^2 = 2 x \dot{x}", r#"kind = "law""#), Verdict::Holds);
    assert_eq!(verdict(r"\mathbf{u} = a", r#"kind = "law""#), Verdict::Fails);
}

#[test]
fn where_nothing_moves_a_premise_speaks_of_one_moment() {
    // Differentiated, the first would say t = 0, the second a = 0.
    assert_eq!(verdict("b^4 = (a^2 t^2 + c^2)^2", "where = 'b^2 = a^2 t^2 + c^2'"), Verdict::Holds);
    assert_eq!(verdict("b^6 = a^3 t^3", "where = 'b^2 = a t'"), Verdict::Holds);
    assert_eq!(verdict("b^6 = 2 a^3 t^3", "where = 'b^2 = a t'"), Verdict::Fails);
    // What moves is differentiated as before.
    assert_eq!(verdict(r"\dot{x} = a", "where = 'x = a t'"), Verdict::Holds);
    assert_eq!(verdict(r"2 x \dot{x} = a", "where = 'x^2 = a t'"), Verdict::Holds);
}

#[test]
fn a_row_times_a_column_is_a_number() {
    let form = r"\begin{pmatrix} x & y \end{pmatrix} \begin{pmatrix} a & b \\ b & c \end{pmatrix} \begin{pmatrix} x \\ y \end{pmatrix}";
    assert_eq!(verdict(&format!("{form} = a x^2 + 2 b x y + c y^2"), ""), Verdict::Holds);
    assert_eq!(verdict(&format!("{form} = a x^2 + b x y + c y^2"), ""), Verdict::Fails);
}

#[test]
fn the_trace_of_a_matrix() {
    assert_eq!(verdict(r"\operatorname{tr} (M N) = \operatorname{tr} (N M)", ""), Verdict::Holds);
    assert_eq!(verdict(r"\operatorname{tr} \begin{pmatrix} a & b \\ c & a \end{pmatrix} = 2 a", ""), Verdict::Holds);
    assert_eq!(verdict(r"\operatorname{tr} (M N) = \operatorname{tr} M \operatorname{tr} N", ""), Verdict::Fails);
}

#[test]
fn a_sum_ends_where_its_letter_is_bound_anew() {
    assert_eq!(verdict(r"\sum_i m_i \sum_i m_i = \left( \sum_i m_i \right)^2", ""), Verdict::Holds);
    assert_eq!(verdict(r"a \sum_i m_i^2 \sum_i m_i = a \sum_i m_i \sum_i m_i^2", ""), Verdict::Holds);
    assert_eq!(verdict(r"\sum_i m_i \sum_i m_i = \sum_i m_i^2", ""), Verdict::Fails);
}
