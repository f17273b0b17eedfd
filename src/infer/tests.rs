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

#[test]
fn a_formula_whose_sides_are_printed_alike_says_nothing() {
    let notes = r"$$ \mathbf{a}' = \mathbf{a} \cos\varphi + (\mathbf{n} \times \mathbf{a}) \sin\varphi \tag{1} $$
With $\mathbf{n} \cdot \mathbf{n} = 1$ we have
$$ \mathbf{n} \cdot \mathbf{a}' = (\mathbf{n} \cdot \mathbf{a}) \cos\varphi, \qquad \mathbf{n} \cdot \mathbf{a} = \mathbf{n} \cdot \mathbf{a} \tag{2} $$
";
    let report = report(notes);
    let second = equation(&report, "2");
    assert_eq!(second.verdict, Verdict::Undecided, "it does not hold: nothing is said");
    assert!(!second.as_expected);
}

#[test]
fn definite_integrals_are_judged() {
    let notes = r"$$ C = \frac{Q}{U} \tag{1} $$
$$ W = \int_0^Q \frac{q}{C} \, dq = \frac{Q^2}{2C} = \frac{1}{2} C U^2 \tag{2} $$
With $\tau = R C$ the current is
$$ I = \frac{U_0}{R} e^{-t/\tau} \tag{3} $$
$$ \int_0^\infty R I^2 \, dt = \frac{U_0^2}{R} \int_0^\infty e^{-2t/\tau} \, dt = \frac{1}{2} C U_0^2 \tag{4} $$
$$ \int_a^\infty \frac{dx}{x^2} = \frac{1}{a} \tag{5} $$
";
    let right = report(notes);
    for label in ["2", "4"] {
        let links = &equation(&right, label).links;
        let verdicts: Vec<Verdict> = links.iter().map(|l| l.verdict).collect();
        assert!(verdicts.iter().all(|v| matches!(v, Verdict::Holds | Verdict::Definition)), "{label}: {verdicts:?}");
    }
    assert!(right.equations.iter().all(|e| e.suspect.is_none()));
    for (label, printed, wrong) in [
        ("2", r"= \frac{Q^2}{2C} =", r"= \frac{Q^2}{C} ="),
        ("4", r"\frac{1}{2} C U_0^2", r"\frac{1}{3} C U_0^2"),
        ("4", r"\frac{U_0^2}{R} \int", r"\frac{R}{U_0^2} \int"),
        ("5", r"\frac{dx}{x^2}", r"\frac{dx}{x^3}"),
    ] {
        assert_ne!(notes.replace(printed, wrong), notes);
        let found = report(&notes.replace(printed, wrong));
        let judged = equation(&found, label);
        assert!(
            judged.links.iter().any(|l| l.verdict > Verdict::Definition) || judged.suspect.is_some(),
            "{label} {wrong}"
        );
    }
    // Nothing says how F depends on x: it is not constant.
    let hidden = report("$$ W = \\int_0^l F \\, dx = F l \\tag{1} $$\n\n$$ F = k x \\tag{2} $$\n");
    assert_eq!(equation(&hidden, "1").verdict, Verdict::Undecided);
}

#[test]
fn what_a_formula_in_the_prose_speaks_of_is_tried_on_it() {
    let notes = r"$$ 1 - u^2 = \frac{(1 - w^2)(1 - v^2)}{(1 + v w)^2} \tag{1} $$
With $\gamma_u = 1/\sqrt{1 - u^2}$, $\gamma_w = 1/\sqrt{1 - w^2}$ and $\gamma_v = 1/\sqrt{1 - v^2}$ the root of (1) reads
$$ \gamma_u^2 = \gamma_v^2 \gamma_w^2 (1 + v w)^2 \tag{2} $$
$$ \gamma_u \gamma_u = \gamma_v^2 \gamma_w^2 (1 - v w)^2 \tag{3} $$
";
    assert_eq!(equation(&report(notes), "2").verdict, Verdict::Holds);
    assert_ne!(equation(&report(notes), "3").verdict, Verdict::Holds);
    let defined = report(
        r"$$ a = b + c \tag{1} $$
With the ratio $k = b/a$ and $c = 2 b$,
$$ k = \frac{1}{4} \tag{2} $$
",
    );
    assert_ne!(equation(&defined, "2").verdict, Verdict::Holds, "it is a third");
    let other = report("The rim moves with $v = \\omega r$.\n\n$$ v = \\omega R \\tag{1} $$\n");
    assert!(equation(&other, "1").suspect.is_none(), "another radius is no misprint");
}

#[test]
fn approximations_are_expansions_in_what_is_small() {
    let notes = r"$$ f = f_0 \sqrt{\frac{1 - \beta}{1 + \beta}} \tag{1} $$
$$ \frac{f}{f_0} \approx 1 - \beta + \frac{1}{2} \beta^2 \tag{2} $$
$$ \sin\theta \approx \theta \tag{3} $$
";
    let right = report(notes);
    for label in ["2", "3"] {
        assert_eq!(equation(&right, label).verdict, Verdict::Asymptotic, "{:?}", equation(&right, label).reason);
    }
    let wrong = report(&notes.replace(r"\frac{1}{2} \beta^2", r"\beta^2"));
    assert_ne!(equation(&wrong, "2").verdict, Verdict::Asymptotic);
    assert!(equation(&wrong, "2").suspect.is_some());
}

#[test]
fn e_is_a_charge_where_no_exponential_is_printed() {
    let charge = "$$ F = e E \\tag{1} $$\n\n$$ m a = e E \\tag{2} $$\n";
    assert_eq!(role(&report(charge), "e"), "a number");
    let decay = "$$ y = e^{-x} \\tag{1} $$\n\n$$ z = e x \\tag{2} $$\n";
    assert_eq!(role(&report(decay), "e"), "no e");
    assert_eq!(role(&report("$$ y = x / e \\tag{1} $$\n"), "e"), "no e");
}

#[test]
fn a_letter_before_a_bracket_is_a_factor_where_it_is_no_function() {
    let notes = "$$ \\mathbf{F} = q (\\mathbf{E}) \\tag{1} $$\n\n$$ a = q b \\tag{2} $$\n";
    assert_eq!(equation(&report(notes), "1").verdict, Verdict::Definition);
    let function =
        report("$$ \\phi(r) = \\frac{Q}{r} \\tag{1} $$\n\n$$ E = -\\frac{d\\phi}{dr} = \\frac{Q}{r^2} \\tag{2} $$\n");
    assert_eq!(equation(&function, "2").verdict, Verdict::Holds);
}

#[test]
fn a_solution_may_stand_beside_what_follows_from_it() {
    let notes = r"$$ L \frac{d^2 Q}{dt^2} + \frac{Q}{C} = 0 \tag{1} $$
The charge swings with $\omega_0 = 1/\sqrt{L C}$,
$$ Q = Q_0 \cos \omega_0 t, \qquad I = \frac{dQ}{dt} = -\omega_0 Q_0 \sin \omega_0 t \tag{2} $$
";
    assert_eq!(equation(&report(notes), "2").inferred.as_ref().unwrap().solves, ["1"]);
    let wrong = report(&notes.replace(r"+ \frac{Q}{C} = 0", r"- \frac{Q}{C} = 0"));
    assert!(equation(&wrong, "2").suspect.is_some(), "{:?}", equation(&wrong, "2").reason);
}

#[test]
fn an_identity_that_lost_a_symbol_is_a_suspect() {
    let notes = r"$$ \mathbf{a} \times (\mathbf{b} \times \mathbf{c}) = (\mathbf{a} \cdot \mathbf{c}) \mathbf{b} - (\mathbf{a} \cdot \mathbf{b}) \mathbf{c} \tag{1} $$
";
    assert_eq!(equation(&report(notes), "1").verdict, Verdict::Holds);
    for wrong in [r"(\mathbf{a} \cdot \mathbf{c}) \mathbf{c}", r"(\mathbf{a} \cdot \mathbf{c})"] {
        let found = report(&notes.replace(r"(\mathbf{a} \cdot \mathbf{c}) \mathbf{b}", wrong));
        assert!(equation(&found, "1").suspect.is_some(), "{wrong}: {:?}", equation(&found, "1").reason);
    }
}
