//! The diagnosis of the bundled notes: how many mutants their checks let pass. Run with `--nocapture` to see the figures.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::path::Path;

use kenzan::check::{self, Book, Options};
use kenzan::diagnose::sensitivity;
use kenzan::document;

fn notes() -> Book {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("notes/gyroscope.md");
    Book::new(&document::read(&path).expect("the notes can be read"))
}

/// Equations whose checks cannot see some terms, and why; looked at one by one. A new one fails the test.
const EXPLAINED: [(&str, &str); 10] = [
    ("6+1", "P = P_G is what is shown"),
    ("7", "the sum of m r' vanishes, and so does anything linear in it"),
    ("10", "the sums over r' vanish, so r and r' are alike there"),
    ("13", "L_G is constant, and so are its derivatives"),
    ("14+1", "the sum is 0, and so are these"),
    ("41", "the term in I_xi - I_eta vanishes by symmetry, whatever its factors"),
    ("51", "the derivative of a horizontal axis is horizontal"),
    ("52", "Omega is the third component"),
    ("62", "a name for the constant is no claim"),
    ("84", "theta is theta_0 to this order"),
];
#[test]
fn mutants_fail() {
    let (book, options) = (notes(), Options { states: 16, ..Options::default() });
    let (mut killed, mut different, mut elsewhere) = (0, 0, [0, 0]);
    for index in 0..book.entries.len() {
        let judgement = check::judge(&book, index, &options);
        let Some(s) = sensitivity::sensitivity(&book, index, &judgement, &options) else { continue };
        killed += s.killed;
        different += s.total - s.equivalent - s.undecided;
        let explained = EXPLAINED.iter().any(|(l, _)| *l == judgement.label);
        if !explained {
            elsewhere[0] += s.killed;
            elsewhere[1] += s.total - s.equivalent - s.undecided;
            assert!(s.survivors.is_empty(), "({}) lets pass: {}", judgement.label, s.survivors.join("; "));
        }
        for survivor in &s.survivors {
            println!("({}) {survivor}", judgement.label);
        }
    }
    println!("{killed} of {different} mutants that say something else fail; without the explained {elsewhere:?}");
    assert!(elsewhere[1] > 4000 && elsewhere[0] == elsewhere[1]);
    assert!(1000 * killed >= 995 * different, "99.5 % of all fail");
}
