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
const EXPLAINED: [(&str, &str); 13] = [
    ("6+1", "P = P_G is what is shown"),
    ("7", "the sum of m r' vanishes, and so does anything linear in it"),
    ("9", "the terms in r_G and its velocity cancel by the centre of mass: mendable, the step needs no such premise"),
    ("10", "the sums over r' vanish, so r and r' are alike there"),
    ("13", "L_G is constant, and so are its derivatives"),
    ("14", "both sides are 0, and so are these"),
    ("14+1", "the sum is 0, and so are these"),
    ("41", "the term in I_xi - I_eta vanishes by symmetry, and then both sides are 0"),
    ("51", "the derivative of a horizontal axis is horizontal"),
    ("52", "Omega is the third component"),
    ("61", "VACUOUS: the premise (59) is solved by a resting inclination, where both sides are 0"),
    ("66+1", "the premise that the inclination rests makes its derivatives 0 in the first link, too"),
    ("84", "theta is theta_0 to this order"),
];
/// Solutions, of which a superposition is one, too.
const SOLUTIONS: [&str; 2] = ["81", "85"];

#[test]
fn mutants_fail() {
    let (book, options) = (notes(), Options { states: 16, ..Options::default() });
    let (mut killed, mut different, mut elsewhere) = (0, 0, [0, 0]);
    for index in 0..book.entries.len() {
        let judgement = check::judge(&book, index, &options);
        let Some(s) = sensitivity::sensitivity(&book, index, &judgement, &options) else { continue };
        killed += s.killed;
        different += s.total - s.equivalent;
        let explained = EXPLAINED.iter().any(|(l, _)| *l == judgement.label) || SOLUTIONS.contains(&&*judgement.label);
        if !explained {
            elsewhere[0] += s.killed;
            elsewhere[1] += s.total - s.equivalent;
            assert!(s.survivors.is_empty(), "({}) lets pass: {}", judgement.label, s.survivors.join("; "));
        }
        for survivor in &s.survivors {
            println!("({}) {survivor}", judgement.label);
        }
    }
    println!("{killed} of {different} mutants that say something else fail; without the explained {elsewhere:?}");
    // Of the equations that are not explained above, at least 99 % of the mutants fail.
    assert!(elsewhere[1] > 4000 && 100 * elsewhere[0] >= 99 * elsewhere[1]);
}
