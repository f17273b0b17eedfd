//! Statements judged from their LaTeX: which verdicts are exact, and why the others are not.

use std::path::Path;

use super::super::claim::Source;
use super::super::sampling::Sampler;
use super::super::verdict::{Judgement, LinkJudgement, Strength, Verdict};
use super::super::{Book, Options, Version, judge};
use super::*;

const SYMBOLS: &str = r"<!-- kenzan
[symbols]
'a, b, c, x, y, I_0, \omega' = { range = [0.5, 2.0] }
'u' = { range = [0.5, 2.0] }
'v' = { range = [0.5, 2.0] }
't' = { range = [0.1, 1.0] }
'\theta, \varphi, \psi' = { of = 't', range = [0.2, 1.2] }
'\mathbf{A}, \mathbf{B}, \mathbf{C}, \mathbf{D}' = { vector = '', range = [-2.0, 2.0] }
-->
";

/// The judgement on one equation with its annotation.
fn judged(latex: &str, annotation: &str) -> Judgement {
    let annotation = if annotation.is_empty() { String::new() } else { format!("<!-- kenzan\n{annotation}\n-->\n") };
    let text = format!("# Notes\n\n{SYMBOLS}\n$$ {latex} \\quad (1) $$\n{annotation}");
    let document = crate::document::parse(Path::new("notes.md"), &text);
    let book = Book::new(&document);
    assert!(book.problems.is_empty() && document.problems.is_empty(), "{latex}");
    judge(&book, 0, &Options::default())
}

#[track_caller]
fn assert_exact(latex: &str, annotation: &str) {
    let j = judged(latex, annotation);
    assert_eq!((j.verdict, j.strength), (Verdict::Holds, Some(Strength::Exact)), "{latex}: {:#?}", j.links);
    for exact in j.links.iter().filter_map(|l| l.exact) {
        assert!(exact.log2_error <= -100 && exact.trials >= 2, "{exact:?}");
    }
}

/// That an equation holds, but not exactly, for a reason.
#[track_caller]
fn assert_numeric(latex: &str, annotation: &str, reason: &str) {
    let j = judged(latex, annotation);
    assert_eq!((j.verdict, j.strength), (Verdict::Holds, Some(Strength::Numeric)), "{latex}: {:#?}", j.links);
    let given = j.links[0].inexact.clone().unwrap_or_default();
    assert!(given.contains(reason), "{latex}: {given}");
}

#[track_caller]
fn assert_fails(latex: &str, annotation: &str) {
    let j = judged(latex, annotation);
    assert_eq!(j.verdict, Verdict::Fails, "{latex}");
    assert!(matches!(j.strength, Some(Strength::Numeric | Strength::Certified)), "{latex}: {:?}", j.strength);
    assert!(j.links.iter().all(|l| l.verdict != Verdict::Fails || l.exact.is_none()));
}

#[test]
fn identities() {
    assert_exact(r"\sin^2 x + \cos^2 x = 1", "");
    assert_exact(r"\sin 2x = 2 \sin x \cos x", "");
    assert_exact(r"\cos 3x = 4 \cos^3 x - 3 \cos x", "");
    assert_exact(r"\cos(x + y) = \cos x \cos y - \sin x \sin y", "");
    assert_exact(r"\tan(x + y) = \frac{\tan x + \tan y}{1 - \tan x \tan y}", "");
    assert_exact(
        r"\frac{d}{dt}(\dot{\varphi} \sin^2 \theta) = \ddot{\varphi} \sin^2 \theta + \dot{\varphi} \dot{\theta} \sin 2\theta",
        "",
    );
    assert_exact(
        r"(\mathbf{A} \times \mathbf{B}) \cdot (\mathbf{C} \times \mathbf{D}) = (\mathbf{A} \cdot \mathbf{C})(\mathbf{B} \cdot \mathbf{D}) - (\mathbf{A} \cdot \mathbf{D})(\mathbf{B} \cdot \mathbf{C})",
        "",
    );
    assert_exact(
        r"\mathbf{A} \times (\mathbf{B} \times \mathbf{C}) = (\mathbf{A} \cdot \mathbf{C}) \mathbf{B} - (\mathbf{A} \cdot \mathbf{B}) \mathbf{C}",
        "",
    );
    assert_exact(r"(\sqrt{a} - \sqrt{b})(\sqrt{a} + \sqrt{b}) = a - b", "");
}

#[test]
fn near_misses() {
    assert_fails(r"\sin^2 x - \cos^2 x = 1", "");
    assert_fails(r"\sin 2x = \sin x \cos x", "");
    assert_fails(r"\cos(x + y) = \cos x \cos y + \sin x \sin y", "");
    assert_fails(
        r"\mathbf{A} \times (\mathbf{B} \times \mathbf{C}) = (\mathbf{A} \cdot \mathbf{C}) \mathbf{B} + (\mathbf{A} \cdot \mathbf{B}) \mathbf{C}",
        "",
    );
    assert_fails(r"(\sqrt{a} - \sqrt{b})(\sqrt{a} + \sqrt{b}) = a + b", "");
}

#[test]
fn premises() {
    // Affine, one after the other; a quadratic equation, both of whose roots will do; a unit vector.
    assert_exact(r"u v = a^2 - b^2", r"where = ['u = a + b', 'v + b = a']");
    assert_exact(r"u + v = \frac{2c}{a + b}", r"where = ['a u + b v = c', 'b u + a v = c']");
    assert_exact(r"u^3 = (b^2 + c) u + b c", r"where = ['u^2 = b u + c']");
    assert_exact(
        r"\mathbf{A} \times (\mathbf{A} \times \mathbf{B}) = (\mathbf{A} \cdot \mathbf{B}) \mathbf{A} - \mathbf{B}",
        r"where = ['\mathbf{A} \cdot \mathbf{A} = 1']",
    );
    assert_exact(
        r"I_0 \dot{\theta}^2 - 2 c \cos \theta = \text{const.}",
        r"where = ['I_0 \ddot{\theta} = -c \sin \theta']",
    );
    assert_exact(r"u = \frac{b \pm \sqrt{b^2 + 4 c}}{2}", "where = ['u^2 = b u + c']\nrange = { u = [-4.0, 4.0] }");
    assert_fails(r"u + v = \frac{c}{a + b}", r"where = ['a u + b v = c', 'b u + a v = c']");
    assert_fails(r"u^3 = (b^2 + c) u - b c", r"where = ['u^2 = b u + c']");
}

#[test]
fn what_the_field_cannot_say() {
    assert_numeric(r"e^{x + y} = e^x e^y", "", "exp has no meaning");
    assert_exact(r"e^x (a + b) = a e^x + b e^x", "");
    assert_numeric(r"\sqrt{a^2} + b = a + b", "", "signs of square roots");
    assert_numeric(r"\sqrt{a} \sqrt{b} = \sqrt{a b}", "", "signs of square roots");
    assert_numeric(r"\sin \frac{\pi}{6} = \frac{1}{2}", "", "no polynomial");
    assert_exact(r"\sin(x + \frac{\pi}{2}) = \cos x", "");
    assert_numeric(r"u^5 = 1 - u", r"where = ['u^5 + u = 1']", "not affine in u");
    assert_numeric(
        r"c \sin u = b",
        r"where = ['\sin u = b / c']
solve = ['u']
range = { b = [0.1, 0.4] }",
        "of which a function is taken",
    );
}

/// The strength of an equation is that of its weakest link.
#[test]
fn the_weakest_link_decides() {
    let j = judged(r"(\sin^2 x + \cos^2 x) e^{2x} = e^{2x} = (e^x)^2", "");
    let strengths: Vec<_> = j.links.iter().map(|l| l.strength).collect();
    assert_eq!(strengths, [Some(Strength::Exact), Some(Strength::Numeric)]);
    assert_eq!(j.strength, Some(Strength::Numeric));
}

/// Never does the field refute what the values confirm; and what of the bundled notes is not exact is known.
#[test]
fn the_bundled_notes() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("notes/gyroscope.md");
    let document = crate::document::read(&path).unwrap();
    let book = Book::new(&document);
    let mut inexact = Vec::new();
    for k in 0..book.entries.len() {
        let j = judge(&book, k, &Options::default());
        let corrected = j.correction.iter().flat_map(|c| &c.links);
        let links: Vec<&LinkJudgement> = j.links.iter().chain(corrected).collect();
        for link in links {
            let why = link.inexact.clone().unwrap_or_default();
            assert!(!why.contains("contradiction"), "({}) {}: {why}", j.label, link.latex);
            assert!(link.exact.is_none_or(|e| e.log2_error <= -100), "({}) {}", j.label, link.latex);
        }
        if j.verdict == Verdict::Holds && j.strength != Some(Strength::Exact) {
            inexact.push(j.label);
        }
    }
    // (26) rests on the axes in which the products of inertia vanish, (69) and (70) are inequalities.
    inexact.retain(|label| label != "14"); // which of several solutions is met depends on the states
    assert_eq!(inexact, ["26", "69", "70"]);
}

/// What fails by its values is not exact in the field either.
#[test]
fn the_misprints_of_the_bundled_notes() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("notes/gyroscope.md");
    let book = Book::new(&crate::document::read(&path).unwrap());
    let (mut tested, mut refuted) = (0, 0);
    for index in 0..book.entries.len() {
        let entry = &book.entries[index];
        let approximation = entry.annotation().is_some_and(|a| a.small.is_some() || !a.solves.is_empty());
        let j = judge(&book, index, &Options::default());
        let Ok(statement) = book.statement(index, Version::Printed) else { continue };
        for (clause, link) in statement.clauses.iter().zip(&j.links) {
            if link.verdict != Verdict::Fails || approximation {
                continue;
            }
            let source = Source::new(&book, index, Version::Printed);
            let Ok(mut claim) = source.claim(clause, &entry.scope, &[]) else { continue };
            let mut random = Random::new(1, &link.latex);
            let Ok(sampler) = Sampler::new(&mut claim, &mut random, &[]) else { continue };
            let unknowns: Vec<SymId> = sampler.system.unknowns.iter().map(|u| u.symbol).collect();
            let outcome = test(&mut claim, &unknowns, &mut random);
            assert!(outcome.is_err(), "({}) {}: {outcome:?}", j.label, link.latex);
            tested += 1;
            refuted += usize::from(outcome == Err(Inexact::Refuted));
        }
    }
    assert!(refuted >= 20, "{refuted} of {tested} failing links are refuted by the field");
}

#[test]
fn a_symbol_of_one_value_has_it_in_the_field() {
    assert_exact(r"x^2 + a = 6.25 + a", "range = { 'x' = [2.5, 2.5] }");
    // At an instant: the rate is not that of a constant.
    assert_exact(r"\frac{d}{dt} \sin \theta = \dot{\theta}", r"range = { '\theta' = [0.0, 0.0] }");
    assert_eq!(judged(r"x^2 + a = 6.5 + a", "range = { 'x' = [2.5, 2.5] }").verdict, Verdict::Fails);
}
