//! Elliptic functions in notes: what holds, what fails, how strongly.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::path::Path;

use kenzan::check::verdict::{Judgement, Strength, Verdict};
use kenzan::check::{self, Book, Options};
use kenzan::document;

const SYMBOLS: &str = r#"<!-- kenzan
modulus = 'k'
[symbols]
'k' = { range = [0.1, 0.9] }
'n' = { range = [-1.5, 0.8] }
'u' = { of = "t", range = [0.1, 3.0] }
'\varphi' = { unit = "rad", range = [0.1, 2.5] }
'A, B' = { range = [0.5, 2.0] }
'K' = { same = '\operatorname{K}' }
'E' = { same = '\operatorname{E}' }
-->
"#;

fn judge(latex: &str) -> Judgement {
    let source = format!("# Notes\n\n{SYMBOLS}\n$$ {latex} \\tag{{1}} $$\n");
    let document = document::parse(Path::new("notes.md"), &source);
    assert!(document.problems.is_empty(), "{:?}", document.problems);
    let book = Book::new(&document);
    check::judge(&book, 0, &Options::default())
}

#[test]
fn algebraic_identities_hold_exactly() {
    for latex in [
        r"\text{sn}^2 u + \text{cn}^2 u = 1",
        r"\operatorname{dn}^2 u = 1 - k^2 \operatorname{sn}^2 u",
        r"\frac{d}{du} \operatorname{sn} u = \operatorname{cn} u \operatorname{dn} u",
        r"\frac{d}{dt} \operatorname{dn} u = -k^2 \operatorname{sn} u \operatorname{cn} u \dot{u}",
        r"\text{tn}u = \frac{\text{sn}u}{\text{cn}u}",
        r"A^2 - B^2 \operatorname{nd}^2 u = A^2 - \frac{B^2}{1 - k^2 \operatorname{sn}^2 u}",
    ] {
        let judged = judge(latex);
        assert_eq!(judged.verdict, Verdict::Holds, "{latex}: {judged:?}");
        assert_eq!(judged.strength, Some(Strength::Exact), "{latex}: {judged:?}");
    }
}

#[test]
fn transcendental_identities_hold() {
    for latex in [
        r"\operatorname{sn}(u + 4K) = \operatorname{sn} u",
        r"\operatorname{dn} u = \sqrt{1 - k^2 \operatorname{sn}^2 u}",
        r"\operatorname{F}(\text{am}u) = u",
        r"\sin(\text{am} u) = \text{sn}u",
        r"\frac{dK}{dk} = \frac{E - (1 - k^2) K}{k (1 - k^2)}",
        r"\frac{\partial}{\partial \varphi} \operatorname{Pi}(\varphi, n, k) = \frac{1}{(1 - n \sin^2 \varphi) \sqrt{1 - k^2 \sin^2 \varphi}}",
        r"\operatorname{cn}(u, 1) = \frac{1}{\cosh u}",
    ] {
        let judged = judge(latex);
        assert_eq!(judged.verdict, Verdict::Holds, "{latex}: {judged:?}");
    }
}

#[test]
fn mistakes_fail() {
    for latex in [
        r"\text{sn}^2 u + \text{dn}^2 u = 1",
        r"\frac{d}{du} \operatorname{dn} u = -k \operatorname{sn} u \operatorname{cn} u",
        r"\operatorname{sn}(u + 2K) = \operatorname{sn} u",
        r"\frac{dK}{dk} = \frac{E - K}{k}",
        r"\operatorname{sn} u = \sin u",
    ] {
        let judged = judge(latex);
        assert_eq!(judged.verdict, Verdict::Fails, "{latex}: {judged:?}");
    }
}
