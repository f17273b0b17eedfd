use std::path::Path;

use crate::check::verdict::{DocumentReport, Judgement, Verdict};
use crate::document;
use crate::verify::{Request, verify};

fn report(notes: &str) -> DocumentReport {
    verify(document::parse(Path::new("notes.md"), notes), &Request::default(), &|| ()).report
}

fn equation<'r>(report: &'r DocumentReport, label: &str) -> &'r Judgement {
    report.equations.iter().find(|e| e.label == label).unwrap()
}

fn role(report: &DocumentReport, symbol: &str) -> String {
    let assumed = report.assumed.iter().find(|a| a.symbol == symbol);
    assumed.map_or_else(|| format!("no {symbol}"), |a| format!("{}{}", a.role, if a.moves { ", moves" } else { "" }))
}

#[test]
fn roles_are_guessed_from_the_way_symbols_are_printed() {
    let report = report(
        r"$$ m \ddot{x} = -k x \tag{1} $$
$$ \mathbf{L} = \sum_i m_i \mathbf{r}_i \times \dot{\mathbf{r}}_i \tag{2} $$
$$ A = \begin{pmatrix} a & b \\ c & d \end{pmatrix} \tag{3} $$
$$ \sin 2\theta = 2 \sin\theta \cos\theta \tag{4} $$
$$ z = e^{i\theta} \tag{5} $$",
    );
    assert_eq!(role(&report, "x"), "a number, moves");
    assert_eq!(role(&report, "m"), "a positive number");
    assert_eq!(role(&report, r"\mathbf{L}"), "a vector, moves");
    assert_eq!(role(&report, r"\mathbf{r}_{i}"), "a vector, moves");
    assert_eq!(role(&report, "i"), "an index from 1 to 3");
    assert_eq!(role(&report, "A"), "a matrix of 2 × 2 numbers");
    assert_eq!(role(&report, r"\theta"), "an angle");
}

#[test]
fn a_document_that_declares_symbols_is_left_alone() {
    let report = report("<!-- kenzan\n[symbols]\n'a' = {}\n-->\n$$ a + b = b + a \\tag{1} $$\n");
    assert!(report.assumed.is_empty());
    assert_eq!(equation(&report, "1").verdict, Verdict::Undecided);
}

/// Falling from a height; the last equation has lost its factor of 2.
const FALL: &str = r"The momentum is $p = m v$.
$$ K = \frac{1}{2} m v^2 = \frac{p^2}{2m} \tag{1} $$
Falling from $h$,
$$ \frac{1}{2} m v^2 = m g h \tag{2} $$
so
$$ v = \sqrt{2 g h} \tag{3} $$
and from (1) and (3)
$$ p = m \sqrt{g h} \tag{4} $$
";

#[test]
fn premises_are_found_among_what_stands_before() {
    let report = report(FALL);
    let first = equation(&report, "1");
    assert_eq!(first.verdict, Verdict::Holds);
    assert_eq!(first.inferred.as_ref().unwrap().formulas, ["p = m v"], "the second link");
    let second = equation(&report, "2");
    assert_eq!((second.verdict, second.inferred.as_ref().unwrap().new), (Verdict::Definition, true));
    let third = equation(&report, "3");
    assert_eq!(third.verdict, Verdict::Holds);
    assert_eq!(third.inferred.as_ref().unwrap().given, ["2"]);
    assert_eq!(third.inferred.as_ref().unwrap().needs, ["v > 0"]);
}

#[test]
fn a_factor_of_both_sides_does_not_matter() {
    let report = report("$$ \\frac{1}{2} m v^2 = m g h \\tag{1} $$\n\n$$ v = \\sqrt{2 g h} \\tag{2} $$\n");
    assert_eq!(equation(&report, "2").given, ["1"]);
}

#[test]
fn what_contradicts_its_premises_and_is_one_edit_away_fails() {
    let report = report(FALL);
    let last = equation(&report, "4");
    assert_eq!(last.verdict, Verdict::Fails, "{:?}", last.reason);
    let suspect = last.suspect.as_ref().unwrap();
    assert_eq!(suspect.latex, r"p = m \sqrt{2 g h}");
    assert!(!last.as_expected);
    // Where the prose does not say what it follows from, the letters may mean something else.
    let unnamed = self::report(&FALL.replace("and from (1) and (3)", "and"));
    assert_eq!(equation(&unnamed, "4").verdict, Verdict::Undecided);
    assert!(equation(&unnamed, "4").suspect.is_some());
    // As it should read it follows, and nothing is suspected.
    let mended = self::report(&FALL.replace(r"\sqrt{g h}", r"\sqrt{2 g h}"));
    assert_eq!(equation(&mended, "4").verdict, Verdict::Holds);
    assert!(mended.equations.iter().all(|e| e.suspect.is_none() && e.as_expected));
}

/// With the wrong (5) the premises leave no gas but one of no temperature, and of that everything holds.
#[test]
fn premises_that_leave_nothing_but_zero_show_nothing() {
    let gas = r"
$$ p V = n R T \tag{1} $$

$$ U = n c_V T \tag{2} $$

$$ H = U + p V \tag{3} $$

$$ c_p = c_V + R \tag{4} $$

$$ H = n c_V T \tag{5} $$

With the adiabatic index $\gamma = c_p / c_V$ both heats can be expressed by $R$:

$$ c_V = \frac{R}{\gamma - 1}, \quad c_p = \frac{\gamma R}{\gamma - 1} \tag{6} $$

so that

$$ U = \frac{2 p V}{\gamma - 1} \tag{7} $$
";
    assert_ne!(equation(&report(gas), "7").verdict, Verdict::Holds);
    let right = gas.replace("H = n c_V T", "H = n c_p T").replace("2 p V", "p V");
    assert_eq!(equation(&report(&right), "7").verdict, Verdict::Holds);
}

#[test]
fn an_identity_with_a_wrong_sign_is_a_suspect_and_no_failure() {
    let report = report(r"$$ (a-b)^2 = a^2 - 2ab - b^2 \tag{1} $$");
    let first = equation(&report, "1");
    assert_eq!(first.verdict, Verdict::Undecided, "it may be a condition on a and b");
    assert_eq!(first.suspect.as_ref().unwrap().latex, "(a - b)^{2} = a^{2} - 2 a b + b^{2}");
}

#[test]
fn what_holds_for_positive_numbers_alone_says_so() {
    let report = report(r"$$ \sqrt{x^2} = x \tag{1} $$");
    let first = equation(&report, "1");
    assert_eq!(first.verdict, Verdict::Undecided);
    assert_eq!(first.inferred.as_ref().unwrap().needs, ["x > 0"]);
    assert!(first.as_expected, "that something is lacking is no surprise");
    // A mass is positive.
    assert_eq!(equation(&self::report(r"$$ \sqrt{m^2} = m \tag{1} $$"), "1").verdict, Verdict::Holds);
}

#[test]
fn a_solution_is_put_into_the_equation_before() {
    let notes = r"$$ m \ddot{x} = - k x \tag{1} $$
With $\omega_0 = \sqrt{k/m}$ it is solved by
$$ x = A \cos(\omega_0 t) + B \sin(\omega_0 t) \tag{2} $$
";
    let report = report(notes);
    let second = equation(&report, "2");
    assert_eq!((second.verdict, second.given.first().map(String::as_str)), (Verdict::Holds, Some("1")));
    let wrong = self::report(&notes.replace(r"\sin(\omega_0 t)", r"\sin(2\omega_0 t)"));
    assert_ne!(equation(&wrong, "2").verdict, Verdict::Holds);
}

#[test]
fn derivatives_of_what_the_notes_give_by_a_formula() {
    let notes = r"$$ \phi(r) = \frac{Q}{r} \tag{1} $$
$$ E = -\frac{d\phi}{dr} = \frac{Q}{r^2} \tag{2} $$
";
    assert_eq!(equation(&report(notes), "2").verdict, Verdict::Holds);
    let wrong = report(&notes.replace(r"\frac{Q}{r^2} \tag{2}", r"\frac{Q}{r^3} \tag{2}"));
    assert_ne!(equation(&wrong, "2").verdict, Verdict::Holds);
    // Without the formula nothing is known of the derivative: it is not 0.
    let unknown = report(r"$$ E = -\frac{d\phi}{dr} = 0 \tag{1} $$");
    assert_eq!(equation(&unknown, "1").verdict, Verdict::Undecided);
}

#[test]
fn shapes_that_do_not_meet_are_no_failure_of_what_is_not_declared() {
    let report = report(r"$$ \mathbf{a} + s = \mathbf{b} \tag{1} $$");
    assert_eq!(equation(&report, "1").verdict, Verdict::Undecided);
}

#[test]
fn matrices_are_found_where_shapes_do_not_meet() {
    let notes = r"$$ A = \begin{pmatrix} a & b \\ c & d \end{pmatrix} \tag{1} $$
$$ \det(A - \lambda I) = \lambda^2 - (a + d) \lambda + a d - b c \tag{2} $$
";
    let report = report(notes);
    assert_eq!(role(&report, "I"), "the identity matrix of 2 rows");
    assert_eq!(equation(&report, "2").verdict, Verdict::Holds, "{:?}", equation(&report, "2").reason);
}
