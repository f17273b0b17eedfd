//! Constructs of celestial mechanics, each with a formula that holds and one that fails: integrals over the mass of bodies,
//! Legendre functions, complex numbers, sums over signs, functions by formula, and series of which some terms are printed.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use kenzan::check::verdict::{Judgement, Verdict};
use kenzan::check::{self, Options};

const SYMBOLS: &str = r#"<!-- kenzan
[symbols]
'u' = { index = [1, 3] }
'v' = { index = [4, 6] }
'j' = { index = [1, 2] }
'n' = { index = [0, 3] }
'm' = { index = [0, 3] }
'\epsilon, \delta' = { index = [-1, 1], step = 2 }
'a, b' = { range = [0.5, 2.0] }
'c_j' = { range = [0.5, 2.0], each = "j" }
'\sigma' = { range = [0.01, 0.1] }
'\alpha, \beta, \lambda' = { unit = "rad", range = [0.2, 1.2] }
'dM_1' = { each = "u", range = [0.5, 2.0] }
'dM_2' = { each = "v", range = [0.5, 2.0] }
'M_1' = { same = '(\int dM_1)' }
'M_2' = { same = '(\int dM_2)' }
'\vec{x}_1' = { each = "u", vector = "", range = [-1.0, 1.0] }
'\vec{x}_2' = { each = "v", vector = "", range = [-1.0, 1.0] }
'\vec{r}' = { vector = "", range = [-1.0, 1.0] }
'r' = { same = '|\vec{r}|' }
'P' = { same = '\operatorname{P}' }
'i' = { same = '\operatorname{i}' }
'f' = { same = '(a x^2 + 1)', function = ['x'] }
-->
"#;

fn one(latex: &str, annotation: &str) -> Judgement {
    check::judge(&common::book(SYMBOLS, latex, annotation), 0, &Options::default())
}

/// A formula that holds, and one that fails, on the same annotation.
fn tells_apart(annotation: &str, good: &str, bad: &str) {
    assert_eq!(one(good, annotation).verdict, Verdict::Holds, "{good}");
    assert_eq!(one(bad, annotation).verdict, Verdict::Fails, "{bad}");
}

#[test]
fn mass_integrals() {
    tells_apart(
        "",
        r"\int (\vec{x}_2 - \vec{x}_1) dM_1 dM_2 = M_1 \int \vec{x}_2 dM_2 - M_2 \int \vec{x}_1 dM_1",
        r"\int (\vec{x}_2 - \vec{x}_1) dM_1 dM_2 = M_2 \int \vec{x}_2 dM_2 - M_1 \int \vec{x}_1 dM_1",
    );
    tells_apart(
        r"where = ['\int \vec{x}_1 dM_1 = 0']",
        r"\int |\vec{x}_1 + \vec{r}|^2 dM_1 = \int \vec{x}_1^2 dM_1 + M_1 r^2",
        r"\int |\vec{x}_1 + \vec{r}|^2 dM_1 = \int \vec{x}_1^2 dM_1 + r^2",
    );
}

#[test]
fn gradients() {
    tells_apart(
        "",
        r"\frac{\partial}{\partial \vec{r}} \frac{a}{r} = -\frac{a \vec{r}}{r^3}",
        r"\frac{\partial}{\partial \vec{r}} \frac{a}{r} = -\frac{a \vec{r}}{r^2}",
    );
}

#[test]
fn legendre_functions_and_factorials() {
    tells_apart(
        "",
        r"P_n^m(\sin\beta) = \cos^m\beta P_n^{(m)}(\sin\beta)",
        r"P_n^m(\sin\beta) = (-1)^m \cos^m\beta P_n^{(m)}(\sin\beta)",
    );
    tells_apart("", r"P_n^n(\cos\alpha) = (2n - 1)!! \sin^n\alpha", r"P_n^n(\cos\alpha) = (2n + 1)!! \sin^n\alpha");
    let zero = |sign: &str| {
        format!(
            r"P_n^m(0) = \begin{{cases}} 0 & n - m = \text{{odd}} \\ (-1)^{{\lfloor \frac{{n {sign} m}}{{2}} \rfloor}} \frac{{(n+m-1)!!}}{{(n-m)!!}} & n - m = \text{{even}} \end{{cases}}"
        )
    };
    let degree = "[symbols]\n'n' = { index = [3, 3] }";
    tells_apart(degree, &zero("-"), &zero("+"));
}

#[test]
fn complex_exponentials_and_signs() {
    tells_apart(
        "",
        r"e^{im\lambda} = (\cos\lambda + i \sin\lambda)^m",
        r"e^{im\lambda} = (\cos\lambda - i \sin\lambda)^m",
    );
    tells_apart(
        "",
        r"\sum_{\epsilon=\pm 1} \epsilon e^{i\epsilon\lambda} = 2i \sin\lambda",
        r"\sum_{\epsilon=\pm 1} e^{i\epsilon\lambda} = 2i \sin\lambda",
    );
    tells_apart(
        "",
        r"\sum_{\epsilon, \delta} \cos(\alpha + \epsilon\beta + \delta\lambda) = 4 \cos\alpha \cos\beta \cos\lambda",
        r"\sum_{\epsilon, \delta} \epsilon \cos(\alpha + \epsilon\beta + \delta\lambda) = 4 \cos\alpha \cos\beta \cos\lambda",
    );
}

#[test]
fn functions_and_replaced_symbols() {
    tells_apart("", "f(a + b) = a (a + b)^2 + 1", "f(a + b) = a b^2 + 1");
    tells_apart(
        "",
        r"\sin\alpha \cos\beta \Big|_{\alpha \rightarrow \alpha + \frac{\pi}{2}} = \cos\alpha \cos\beta",
        r"\sin\alpha \cos\beta \Big|_{\alpha \rightarrow \alpha + \frac{\pi}{2}} = -\cos\alpha \cos\beta",
    );
}

#[test]
fn values_of_an_index_behind_an_equation() {
    tells_apart("", r"c_j + a = a + c_j \quad j = 1, 2", r"c_j + a = a + 2c_j \quad j = 1, 2");
    assert_ne!(one(r"c_j + a = a + c_j \quad j = 1, 3", "").verdict, Verdict::Holds, "j runs to 2");
}

#[test]
fn what_is_left_out_is_measured() {
    let cut = "small = '\\sigma'\norder = 3";
    let series = |linear: &str| {
        format!(r"\frac{{1}}{{1 - \sigma a}} = 1 {linear} \sigma a + \sigma^2 a^2 + \mathcal{{O}}(\sigma^3)")
    };
    assert_eq!(one(&series("+"), cut).verdict, Verdict::Asymptotic);
    assert_eq!(one(&series("-"), cut).verdict, Verdict::Fails);
    assert_eq!(one(r"\frac{1}{1 - \sigma a} = 1 + \sigma a + \dots", "").verdict, Verdict::Undecided);
}

#[test]
fn printed_harmonics_have_their_coefficients() {
    let angles = r"harmonics = ['\alpha', '\lambda']";
    tells_apart(
        angles,
        r"(a + \cos\alpha + b \sin(\lambda + \beta))^2 = a^2 + \frac{1}{2} + \frac{b^2}{2} + 2ab \sin(\lambda + \beta) + \dots",
        r"(a + \cos\alpha + b \sin(\lambda + \beta))^2 = a^2 + \frac{1}{2} + \frac{b^2}{2} + 2ab \cos(\lambda + \beta) + \dots",
    );
    tells_apart(
        angles,
        r"(\cos\alpha + \cos\lambda)^2 = \cos(\alpha - \lambda) + \frac{1}{2} \cos 2\alpha + \dots",
        r"(\cos\alpha + \cos\lambda)^2 = 2 \cos(\alpha - \lambda) + \frac{1}{2} \cos 2\alpha + \dots",
    );
    let undecided = |latex: &str, annotation: &str| {
        let judgement = one(latex, annotation);
        assert_eq!(judgement.verdict, Verdict::Undecided, "{latex}: {judgement:?}");
    };
    undecided(r"e^{\cos\alpha} = a + \dots", angles);
    undecided(r"\cos\alpha = 0 + \dots", angles);
    undecided(
        r"\cos\alpha = \cos\beta + \dots",
        "harmonics = ['\\alpha']\nwhere = ['\\sin\\alpha = \\sin\\beta']\nsolve = ['\\beta']",
    );
}

#[test]
fn a_table_states_nothing() {
    let table = r"\begin{array}{cc} \text{small} & \text{large} \\ \sim 1 & \frac{a}{b} \end{array}";
    assert_eq!(one(table, "kind = \"statement\"").verdict, Verdict::Statement);
    assert_eq!(one(table, "").verdict, Verdict::Undecided);
}
