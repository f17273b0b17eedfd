use super::*;
use crate::document;
use std::path::Path;

const SYMBOLS: &str = r#"
't' = { unit = "s" }
'm, M' = { unit = "kg" }
'g' = { unit = "m/s^2" }
'l, h' = { unit = "m" }
'v' = { unit = "m/s" }
'x' = { unit = "m", of = "t" }
'\theta' = { unit = "rad", of = "t" }
'\omega' = { unit = "rad/s" }
'I' = { unit = "kg m^2" }
'\mathbf{r}' = { vector = "", unit = "m", of = "t" }
'\mathbf{F}' = { vector = "", unit = "N" }
'i' = { index = [1, 3] }
'm_i' = { unit = "kg", each = "i" }
'p, q, n, s' = { range = [1.0, 2.0] }
"#;

fn book_of(symbols: &str, formulas: &[&str]) -> (Vec<String>, Book) {
    let mut text = format!("<!-- kenzan\n{symbols}-->\n\n");
    for (k, latex) in formulas.iter().enumerate() {
        text += &format!("$${latex} \\tag{{{}}}$$\n\n", k + 1);
    }
    let document = document::parse(Path::new("notes.md"), &text);
    let book = Book::new(&document);
    let problems = document.problems.iter().chain(&book.problems).map(|p| p.to_text(&document)).collect();
    (problems, book)
}

fn book(formulas: &[&str]) -> Book {
    let (problems, book) = book_of(&format!("[symbols]{SYMBOLS}"), formulas);
    assert_eq!(problems, Vec::<String>::new());
    book
}

fn statuses(formulas: &[&str]) -> Vec<DimensionStatus> {
    let book = book(formulas);
    let survey = Survey::new(&book);
    (0..formulas.len()).map(|k| survey.judge(k, Version::Printed).status).collect()
}

fn messages(formulas: &[&str]) -> String {
    let book = book(formulas);
    let survey = Survey::new(&book);
    let mut lines = Vec::new();
    for (k, latex) in formulas.iter().enumerate() {
        let found = survey.judge(k, Version::Printed);
        lines.push(format!("{latex}\n  {:?}", found.status));
        lines.extend(found.findings.iter().map(|f| format!("  {}", f.message)));
    }
    lines.join("\n")
}

#[test]
fn right_formulas_are_right() {
    let formulas = [
        r"\frac{1}{2} m v^2 + m g h = \frac{m}{2} (v^2 + 2 g h)",
        r"v = \sqrt{2 g h}",
        r"\ddot{\theta} = -\frac{g}{l} \sin\theta",
        r"\frac{d}{dt} (\theta^2) = 2 \theta \dot\theta",
        r"x = l \cos(\omega t + \theta)",
        r"\mathbf{r} \times \mathbf{F} = m \frac{d}{dt} (\mathbf{r} \times \dot{\mathbf{r}})",
        r"\dot{\mathbf{r}} \cdot \dot{\mathbf{r}} = v^2",
        r"\sum_i m_i \mathbf{r} = M \mathbf{r}",
        r"|\mathbf{r}| \leq l",
        r"\mathbf{r} = \begin{pmatrix} l \\ 0 \\ h \end{pmatrix}",
        r"e^{-\omega t} = 1",
        r"d x = v dt",
    ];
    for (latex, status) in formulas.iter().zip(statuses(&formulas)) {
        // Columns need a basis: that formula is not understood, and so not checked.
        let expected = if latex.contains("pmatrix") { DimensionStatus::Unchecked } else { DimensionStatus::Ok };
        assert_eq!(status, expected, "{latex}");
    }
}

#[test]
fn mismatches_name_the_terms_and_what_mends_them() {
    insta::assert_snapshot!(messages(&[
        r"v = \sqrt{2 g h} + l",
        r"\frac{1}{2} m v^2 + m g = \frac{m}{2} (v^2 + 2 g h)",
        r"x = l \cos(\omega + \theta)",
        r"x = l \sin \omega t + \theta",
        r"v = l \sin \omega t + \theta",
        r"e^{\omega} = 1",
        r"\mathbf{F} = m \dot{\mathbf{r}}",
        r"\ddot{\theta} = -g \sin\theta",
        r"x = m g",
        r"m (v + g) = m v",
        r"v = h = l",
        r"I \dot\theta + m = v",
    ]));
}

#[test]
fn zero_and_constants_have_any_dimension() {
    use DimensionStatus::{Mismatch, Ok, Unchecked};
    let formulas = [
        r"m \ddot{x} - m g = 0",
        r"m v + m g = 0",
        r"m v = 0",
        r"\frac{1}{2} m v^2 + m g h = \text{const.}",
        r"m v = \text{const.}",
        r"\mathbf{F} = \mathbf{0}",
    ];
    assert_eq!(statuses(&formulas), [Ok, Mismatch, Unchecked, Ok, Unchecked, Unchecked]);
}

/// What an equation says itself of an undeclared unit does not make it right; what the others say does.
#[test]
fn an_equation_does_not_check_itself() {
    use DimensionStatus::{Mismatch, Ok, Unchecked};
    assert_eq!(statuses(&[r"p = m v"]), [Unchecked]);
    assert_eq!(statuses(&[r"p = m v", r"p = 2 m \dot{x}"]), [Ok, Ok]);
    assert_eq!(statuses(&[r"p = m v", r"p = 2 m g"]), [Mismatch, Mismatch]);
    // Whatever p is, both sides have its dimension, or have not.
    assert_eq!(statuses(&[r"\omega p = \dot\theta p"]), [Ok]);
    assert_eq!(statuses(&[r"\omega p = v p"]), [Mismatch]);
}

#[test]
fn units_are_inferred_through_powers_and_products() {
    let book = book(&[r"p q = m v^2", r"\frac{p}{q} = \omega^2", r"n = \sqrt{m s}", r"n + h = v"]);
    let found = Survey::new(&book).inferred();
    let shown: Vec<String> = found.iter().map(|i| format!("{} {} ({})", i.symbol, i.dimension, i.from)).collect();
    // (4) contradicts itself, and so says nothing of n.
    assert_eq!(shown, ["q kg^(1/2) m (2)", "p kg^(1/2) m s⁻² (1)"]);
}

#[test]
fn natural_units_switch_the_check_off() {
    let (problems, book) = book_of(&format!("natural_units = true\n[symbols]{SYMBOLS}"), &[r"v = x"]);
    assert_eq!(problems, Vec::<String>::new());
    assert_eq!(Survey::new(&book).judge(0, Version::Printed).status, DimensionStatus::Unchecked);
}

#[test]
fn an_unknown_unit_is_a_problem_at_its_place() {
    let (problems, book) = book_of("[symbols]\n'a' = { unit = \"kgg m\" }\n'b' = { unit = \"m\" }\n", &["a = b"]);
    assert_eq!(problems, ["notes.md:3:17: unknown unit kgg. did you mean kg?"]);
    assert_eq!(Survey::new(&book).judge(0, Version::Printed).status, DimensionStatus::Unchecked);
}

#[test]
fn exponents_that_do_not_fit_cost_no_verdict() {
    let power = format!("x{}", "^{9}");
    let tower = (0..40).fold(power, |inner, _| format!("({inner})^{{99999}}"));
    let _ = statuses(&[&format!("{tower} = v")]);
}

fn bundled() -> Book {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("notes/gyroscope.md");
    Book::new(&document::read(&path).unwrap())
}

/// The misprints of the bundled notes that dimensions find, with the factors that mend them.
#[test]
fn findings_in_the_bundled_notes() {
    let book = bundled();
    let survey = Survey::new(&book);
    let mut lines = Vec::new();
    for (k, entry) in book.entries.iter().enumerate() {
        let found = survey.judge(k, Version::Printed);
        lines.extend(found.findings.iter().map(|f| format!("({}) {}", entry.equation.label, f.message)));
        assert_eq!(found.status == DimensionStatus::Mismatch, !found.findings.is_empty());
    }
    insta::assert_snapshot!(lines.join("\n"));
}

/// No correction, and no equation that is to hold, has a mismatch.
#[test]
fn what_holds_in_the_bundled_notes_has_no_mismatch() {
    let book = bundled();
    let survey = Survey::new(&book);
    for (k, entry) in book.entries.iter().enumerate() {
        let fails = entry.annotation().is_some_and(|a| a.expect.is_some());
        assert_ne!(survey.judge(k, Version::Corrected).status, DimensionStatus::Mismatch, "{}", entry.equation.label);
        if !fails {
            assert_ne!(survey.judge(k, Version::Printed).status, DimensionStatus::Mismatch, "{}", entry.equation.label);
        }
    }
    let count =
        |status| (0..book.entries.len()).filter(|k| survey.judge(*k, Version::Printed).status == status).count();
    let counts = [DimensionStatus::Ok, DimensionStatus::Mismatch, DimensionStatus::Unchecked].map(count);
    insta::assert_debug_snapshot!(counts);
}

#[test]
fn integrals_along_the_motion_have_the_dimension_of_what_is_integrated_times_the_time() {
    use DimensionStatus::{Mismatch, Ok};
    let formulas = [
        r"m v = \int_0^t m g\,dt",
        r"m v = \int_0^t m v\,dt",
        r"\frac{1}{2} m v^2 - m g (x)_0 = \int \mathbf{F} \cdot d\mathbf{r}",
        r"\frac{1}{2} m v^2 - m g (\dot{x})_0 = \int \mathbf{F} \cdot d\mathbf{r}",
    ];
    assert_eq!(statuses(&formulas), [Ok, Mismatch, Ok, Mismatch]);
}

#[test]
fn directions_are_compared_whatever_the_dimensions() {
    use DimensionStatus::{Mismatch, Ok};
    let formulas =
        [r"\mathbf{F} - m \ddot{\mathbf{r}} \parallel \mathbf{r}", r"\mathbf{r} \perp \mathbf{F} - m \dot{\mathbf{r}}"];
    assert_eq!(statuses(&formulas), [Ok, Mismatch]);
}

#[test]
fn numbers_and_vectors_are_the_parts_of_quaternions() {
    use DimensionStatus::{Mismatch, Ok};
    let formulas =
        [r"h + \mathbf{r} = \mathbf{r} + l", r"v + \mathbf{r} = \mathbf{r} + l", r"h + \mathbf{r} = \mathbf{F} + l"];
    let operators = "'S' = { same = '\\operatorname{Sc}' }\n";
    let (problems, book) = book_of(&format!("[symbols]{SYMBOLS}{operators}"), &formulas);
    assert_eq!(problems, Vec::<String>::new());
    let survey = Survey::new(&book);
    let found: Vec<_> = (0..3).map(|k| survey.judge(k, Version::Printed).status).collect();
    assert_eq!(found, [Ok, Mismatch, Mismatch]);
}
