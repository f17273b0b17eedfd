//! The reader on the scanned originals, where they are there.

use super::*;

/// The label sequence of an original must be complete from 1 to `last`, but for `lost`.
fn check(name: &str, last: usize, lost: &[usize], displays: usize, equations: usize) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/notes").join(name);
    if !path.exists() {
        println!("skipped: {} is not there", path.display());
        return;
    }
    let document = read(&path).unwrap();
    // What the scan has lost is referred to all the same.
    let of_lost = |problem: &String| lost.iter().any(|k| problem.contains(&format!("there is no equation `{k}`")));
    assert_eq!(problems(&document).into_iter().filter(|p| !of_lost(p)).collect::<Vec<_>>(), Vec::<String>::new());
    check_promises(&document);
    let labels: Vec<_> =
        document.equations().filter(|equation| equation.numbered).map(|equation| equation.label.clone()).collect();
    let expected: Vec<_> =
        (1..=last).filter(|number| !lost.contains(number)).map(|number| number.to_string()).collect();
    assert_eq!(labels, expected);
    assert_eq!(document.equations().last().map(|equation| equation.display + 1), Some(displays));
    assert_eq!(document.equations().count(), equations);
}

#[test]
fn gyroscope() {
    check("gyroscope.md", 85, &[72], 89, 90);
}

#[test]
fn celestial_mechanics() {
    check("celestial-mechanics-3.md", 537, &[411], 565, 565);
}
