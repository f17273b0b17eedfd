//! What macros come to, and that their expansion ends.

use super::*;
use proptest::prelude::*;

/// The macros that these definitions and packages make.
fn macros(packages: &[&str], definitions: &str) -> Macros {
    let mut all = Definitions::default();
    packages.iter().for_each(|package| all.load(package));
    let mut rest = definitions;
    while let Some(at) = rest.find('\\') {
        rest = &rest[at..];
        let (length, defined) = definition(rest).unwrap_or_else(|| panic!("no definition: {rest}"));
        all.define(defined.unwrap());
        rest = &rest[length..];
    }
    let count = all.count();
    Macros::until(&Arc::new(all), count)
}

fn expanded(definitions: &str, formula: &str) -> String {
    macros(&[], definitions).expand(formula).unwrap().text
}

/// With a package of physics loaded.
fn physics(formula: &str) -> String {
    macros(&["physics"], "").expand(formula).unwrap().text
}

fn siunitx(formula: &str) -> String {
    macros(&["siunitx"], "").expand(formula).unwrap().text
}

#[test]
fn definitions_of_all_kinds_are_read() {
    let definitions = r"\newcommand{\half}{\tfrac12} \renewcommand*\vec[1]{\mathbf{#1}} \def\d#1{\mathrm d #1}
        \DeclareMathOperator{\sgn}{sgn} \DeclareMathOperator*{\argmax}{arg\,max}
        \newcommand{\pd}[2][t]{\frac{\partial #2}{\partial #1}} \providecommand{\sin}{x} \let\oldhat\hat
        \renewcommand{\hat}[1]{\oldhat{\vec{#1}}} \DeclarePairedDelimiter{\ceil}{\lceil}{\rceil}
        \DeclarePairedDelimiterX{\scalar}[2]{\langle}{\rangle}{#1, #2}
        \NewDocumentCommand{\diff}{s O{} m g}{\IfBooleanTF{#1}{D}{d}^{#2}#3\IfValueT{#4}{/#4}}";
    let all = macros(&[], definitions);
    let cases = [
        (r"\half x", r"\tfrac12 x"),
        (r"\vec r+\vec{ab}", r"\mathbf{r}+\mathbf{ab}"),
        (r"\d x\d{y}", r"\mathrm d x\mathrm d y"),
        (r"\sgn x \argmax", r"\operatorname{sgn} x \operatorname*{arg\,max}"),
        (r"\pd{f} \pd[x]{\half}", r"\frac{\partial f}{\partial t} \frac{\partial \tfrac12}{\partial x}"),
        (r"\sin x", r"\sin x"),
        (r"\hat{n}", r"\hat{\mathbf{n}}"),
        (r"\ceil*{x} \ceil[\big]{y}", r"\left\lceil x \right\rceil \left\lceil y \right\rceil"),
        (r"\scalar{a}{b}", r"\left\langle a, b \right\rangle"),
        (r"\diff*[2]{x}{y} \diff z", r"D^{2}x/y d^{}z"),
    ];
    for (formula, expected) in cases {
        assert_eq!(all.expand(formula).unwrap().text, expected, "{formula}");
    }
}

#[test]
fn arguments_are_set_off_by_signs_as_tex_does() {
    let definitions =
        r"\def\half#1.{\frac{#1}{2}} \def\vect[#1]{\mathbf{#1}} \def\pair#1 and #2\end{(#1, #2)} \def\dot.{x}";
    let cases = [
        (r"a \half b. = \half{a b}.", r"a \frac{b}{2} = \frac{a b}{2}"),
        (r"\vect[r] + \vect [{a]b}]", r"\mathbf{r} + \mathbf{a]b}"),
        (r"\pair{a}{b} and c \end", r"({a}{b} , c )"),
        (r"\half .", r"\frac{ }{2}"),
        (r"\half \vect[a].", r"\frac{ \mathbf{a}}{2}"),
    ];
    for (formula, wanted) in cases {
        let blank = |text: &str| text.replace(' ', "");
        assert_eq!(blank(&expanded(definitions, formula)), blank(wanted), "{formula}");
    }
    let all = macros(&[], definitions);
    let error = |formula: &str| all.expand(formula).unwrap_err().to_string();
    assert!(error(r"{\half b}.").contains("its argument ends with `.`, which is missing"));
    assert!(error(r"\vect r").contains("`[` has to follow it"));
}

#[test]
fn units_of_the_notes_are_what_they_are_made_of() {
    let own = r"\DeclareSIUnit\kmh{\km\per\hour} \DeclareSIUnit[per-mode=symbol]{\bar}{\kilo\pascal} \DeclareSIUnit\year{yr}
        \DeclareSIUnit\x{\x} \DeclareSIUnit\y{\z\z\z\z\z\z\z\z}\DeclareSIUnit\z{\w\w\w\w\w\w\w\w}\DeclareSIUnit\w{\v\v\v\v\v\v\v\v}";
    let all = macros(&["siunitx"], own);
    let expand = |formula: &str| all.expand(formula).map(|e| e.text);
    assert_eq!(expand(r"\SI{72}{\kmh}").unwrap(), r"72\times 10^{3}\times \frac{1}{3600}\,\text{m s$^{-1}$}");
    assert_eq!(
        expand(r"\SI{2}{\per\kmh\squared}").unwrap(),
        r"2\times 10^{-6}\times \frac{1}{(\frac{1}{3600})^{2}}\,\text{m$^{-2}$ s$^{2}$}"
    );
    assert_eq!(expand(r"\SI{1}{\mega\bar}").unwrap(), r"1\times 10^{9}\,\text{kg m$^{-1}$ s$^{-2}$}");
    assert_eq!(expand(r"\bar{x}").unwrap(), r"\bar{x}", "a unit is no macro elsewhere");
    let unknown = expand(r"\SI{1}{\year}").unwrap_err().to_string();
    assert!(unknown.contains("is not known") && unknown.contains(r"\DeclareSIUnit says `yr`"), "{unknown}");
    assert!(expand(r"\SI{1}{\x}").is_err() && expand(r"\SI{1}{\y}").is_err(), "units without end");
}

#[test]
fn a_formula_without_macros_is_passed_on() {
    let formula = r"\frac{a}{b} % \x
        = \alpha";
    let expanded = macros(&[], r"\newcommand{\x}{y}").expand(formula).unwrap();
    assert!(expanded.is_verbatim());
    assert_eq!((expanded.text.as_str(), expanded.place(&(3..5))), (formula, 3..5));
}

#[test]
fn places_lead_back_to_the_formula() {
    let formula = r"a + \pd{\half xyz} = \qq";
    let all = macros(
        &[],
        r"\newcommand{\half}{\tfrac12} \newcommand{\pd}[1]{\frac{\partial #1}{\partial t}} \newcommand{\qq}{\kappa}",
    );
    let expanded = all.expand(formula).unwrap();
    assert_eq!(expanded.text, r"a + \frac{\partial \tfrac12 xyz}{\partial t} = \kappa");
    let place = |part: &str| {
        let at = expanded.text.find(part).unwrap();
        &formula[expanded.place(&(at..at + part.len()))]
    };
    assert_eq!(place("a"), "a");
    assert_eq!(place("yz"), "yz", "an argument has its own place");
    assert_eq!(place(r"\tfrac12"), r"\half");
    assert_eq!(place("{\\partial t}"), r"\pd", "a body has the place of the use");
    assert_eq!(place(r"\kappa"), r"\qq");
    assert_eq!(expanded.place(&(expanded.text.len()..expanded.text.len())), formula.len()..formula.len());
}

#[test]
fn definitions_hold_from_where_they_stand() {
    let mut all = Definitions::default();
    all.define(definition(r"\newcommand{\x}{a}").unwrap().1.unwrap());
    all.define(definition(r"\renewcommand{\x}{b}").unwrap().1.unwrap());
    let all = Arc::new(all);
    let at = |count| Macros::until(&all, count).expand(r"\x").unwrap().text;
    assert_eq!([at(0), at(1), at(2)], [r"\x", "a", "b"]);
}

#[test]
fn faults_are_told_at_the_use() {
    let all = macros(&[], r"\newcommand{\a}{x\a} \newcommand{\f}[2]{#1#2} \def\z{\z}");
    let error = |formula: &str| all.expand(formula).unwrap_err().to_string();
    let errors = [error(r"1 + \a"), error(r"1 + \f{x}"), error(r"\f{a}{b"), error(r"\z"), error(r"\SI{3}{\foo}")];
    insta::assert_snapshot!(errors.join("\n"));
}

#[test]
fn definitions_that_cannot_be_read_say_so() {
    let texts = [
        r"\newcommand",
        r"\newcommand{\x}",
        r"\newcommand{\x}[x]{y}",
        r"\newcommand{\x}{y",
        r"\def\x#1}",
        r"\NewDocumentCommand\x{q}{y}",
    ];
    let errors: Vec<_> = texts.iter().map(|text| definition(text).unwrap().1.unwrap_err().to_string()).collect();
    insta::assert_snapshot!(errors.join("\n"));
    assert_eq!(definition(r"\newcommandx{\x}{y}"), None);
}

#[test]
fn physics_is_understood() {
    let cases = [
        (r"\dv{x}", r"\frac{\mathrm{d}}{\mathrm{d}x}"),
        (r"\dv{f}{x}", r"\frac{\mathrm{d}f}{\mathrm{d}x}"),
        (r"\dv[2]{f}{x}", r"\frac{\mathrm{d}^{2}f}{\mathrm{d}x^{2}}"),
        (r"\dv{x}(f+g)", r"\frac{\mathrm{d}}{\mathrm{d}x}\left(f+g\right)"),
        (r"\pdv{f}{x}", r"\frac{\partial f}{\partial x}"),
        (r"\pdv{f}{x}{y}", r"\frac{\partial^{2}f}{\partial x\partial y}"),
        (r"\pdv[2]{f}{x}", r"\frac{\partial^{2}f}{\partial x^{2}}"),
        (r"\int f \dd{x} \dd[3]{r} \dd y", r"\int f \mathrm{d} x \mathrm{d}^{3}r \mathrm{d} y"),
        (
            r"\qty(\frac{a}{b}) \qty[x] \qty{y} \qty|z|",
            r"\left(\frac{a}{b}\right) \left[x\right] \left\{y\right\} \left|z\right|",
        ),
        (r"\qty((a)b)", r"\left((a)b\right)"),
        (r"\abs{x}\norm*{\vb{x}}", r"\left|x\right|\left\|\mathbf{x}\right\|"),
        (r"\vb*{r} \va{r} \vu{r}", r"\mathbf{r} \vec{r} \hat{\mathbf{r}}"),
        (r"\vb a\vdot\vb b \cross\vb c", r"\mathbf{a}\cdot\mathbf{b} \times\mathbf{c}"),
        (r"\div{\vb E} \curl\vb{B} \grad\phi", r"\nabla\cdot\mathbf{E} \nabla\times\mathbf{B} \nabla\phi"),
        (r"\sin[2](x) + \sin x", r"\sin^{2}(x) + \sin x"),
        (r"\comm{A}{B} \acomm{A}{B}", r"\operatorname{comm}\left(A,B\right) \operatorname{acomm}\left(A,B\right)"),
        (r"\tr(A) \Tr A \flatfrac{a}{b}", r"\tr(A) \tr A \frac{a}{b}"),
        (r"\eval{f}_0^1 \order{x^2}", r"\left.f\right|_0^1 \mathcal{O}\left(x^2\right)"),
        (r"\pmqty{a & b \\ c & d}", r"\begin{pmatrix}a & b \\ c & d\end{pmatrix}"),
    ];
    let squeezed = |text: &str| text.replace(' ', "");
    for (formula, expected) in cases {
        assert_eq!(squeezed(&physics(formula)), squeezed(expected), "{formula}");
    }
}

#[test]
fn names_that_latex_knows_are_the_packages_only_where_it_is_loaded() {
    assert_eq!(expanded("", r"a \div b"), r"a \div b");
    assert_eq!(expanded("", r"\div{E}"), r"\nabla\cdot E");
    let amsmath = macros(&["amsmath"], "");
    assert_eq!(amsmath.expand(r"a \div{b}").unwrap().text, r"a \div{b}");
    assert_eq!(amsmath.expand(r"\Tr A").unwrap().text, r"\tr A", "unknown otherwise");
    assert_eq!(expanded(r"\newcommand{\dv}{v}", r"\dv{x}"), "v{x}", "what the notes define comes first");
}

#[test]
fn quantities_come_to_units_of_the_si() {
    let cases = [
        (r"\SI{3.0}{\metre\per\second}", r"3.0\,\text{m s$^{-1}$}"),
        (r"\qty{5}{\km}", r"5\times 10^{3}\,\text{m}"),
        (r"\qty{1.20(3)e-2}{\milli\metre}", r"1.20\times 10^{-5}\,\text{m}"),
        (r"\SI{9.81}{m/s^2}", r"9.81\,\text{m s$^{-2}$}"),
        (r"\SI{2}{\hour}", r"2\times 3600\,\text{s}"),
        (r"\SI{72}{\km\per\hour}", r"72\times 10^{3}\times \frac{1}{3600}\,\text{m s$^{-1}$}"),
        (r"\SI{1}{\cubic\centi\metre}", r"1\times 10^{-6}\,\text{m$^{3}$}"),
        (r"\SI{1}{\square\metre\per\kilogram\squared}", r"1\,\text{kg$^{-2}$ m$^{2}$}"),
        (r"\SI{1}{N.m.s^{-1}}", r"1\,\text{kg m$^{2}$ s$^{-3}$}"),
        (r"\SI{1e3}{\kilo\electronvolt}", r"1\times 10^{-13}\times 1.602176634\,\text{kg m$^{2}$ s$^{-2}$}"),
        (r"\num{6.02e23} \num{-1,5}", r"6.02\times 10^{23} -1.5"),
        (r"\ang{30} \ang{1;2;3}", r"30^{\circ} 1^{\circ}2'3''"),
        (r"\si{\metre\per\second}", r"\,\text{m s$^{-1}$}"),
        (r"\SI{50}{\percent}", r"50\times 10^{-2}"),
    ];
    for (formula, expected) in cases {
        assert_eq!(siunitx(formula), expected, "{formula}");
    }
}

/// A source of definitions and uses that is more often well formed than random letters.
fn texts() -> impl Strategy<Value = String> {
    let pieces = prop::sample::select(vec![
        r"\newcommand",
        r"\def",
        r"\a",
        r"\b",
        r"\c",
        "{",
        "}",
        "[",
        "]",
        "1",
        "2",
        "#1",
        "#2",
        "x",
        " ",
        "%",
        "\n",
        "\\",
        "^",
        "&",
        r"\NewDocumentCommand",
        "{s o m g}",
        r"\IfValueTF",
        r"\IfNoValueT",
        r"\let",
        "=",
        r"\qty",
        "(",
        ")",
        "|",
        r"\dv",
        r"\pdv",
        r"\SI",
        r"\metre",
        "e5",
        r"\num",
        r"\DeclareMathOperator",
        r"\DeclarePairedDelimiterX",
        "日",
        r"\left",
        "*",
    ]);
    prop::collection::vec(pieces, 0..60).prop_map(|pieces| pieces.concat())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, ..ProptestConfig::default() })]

    #[test]
    fn no_macros_hang_or_panic(definitions in prop::collection::vec(texts(), 0..4), bodies in prop::collection::vec(texts(), 3), formula in texts()) {
        let mut all = Definitions::default();
        all.load("siunitx");
        for (name, body) in ["\\a", "\\b", "\\c"].iter().zip(&bodies) {
            if let Some((_, Ok(defined))) = definition(&format!("\\newcommand{{{name}}}[1]{{{body}}}")) {
                all.define(defined);
            }
        }
        for text in &definitions {
            for (at, _) in text.match_indices('\\') {
                if let Some((length, defined)) = definition(&text[at..]) {
                    prop_assert!(text.get(at..at + length).is_some());
                    defined.into_iter().for_each(|defined| all.define(defined));
                }
            }
        }
        let count = all.count();
        let macros = Macros::until(&Arc::new(all), count);
        match macros.expand(&formula) {
            Ok(expanded) => {
                prop_assert!(expanded.text.len() <= 64 * MOST_TOKENS);
                for (at, c) in expanded.text.char_indices().take(200) {
                    prop_assert!(formula.get(expanded.place(&(at..at + c.len_utf8()))).is_some());
                }
            }
            Err(error) => prop_assert!(formula.get(error.span).is_some()),
        }
    }
}

#[test]
fn explosions_are_stopped() {
    let mut definitions = String::from(r"\newcommand{\za}{x}");
    for pair in ('a'..='y').zip('b'..='z') {
        definitions += &format!("\\newcommand{{\\z{}}}{{\\z{}\\z{}}}", pair.1, pair.0, pair.0);
    }
    definitions += r"\newcommand{\twice}[1]{#1#1}";
    let all = macros(&[], &definitions);
    let error = all.expand(r"a + \zz").unwrap_err();
    assert!(error.message.contains("does not end"), "{error}");
    assert_eq!(error.span, 4..7);
    let nested = format!("{}x{}", r"\twice{".repeat(40), "}".repeat(40));
    assert!(all.expand(&nested).is_err());
    assert!(all.expand(&r"\newcommand[".repeat(20_000)).is_ok());
    assert!(all.expand(&r"\dv[".repeat(20_000)).is_err());
}
