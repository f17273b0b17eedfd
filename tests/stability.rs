//! Every hard case of the catalogue by its name: the stable form is the same formula, it loses fewer bits, and its
//! mutants are told from the formula. `cargo test --test stability Mercury` runs those whose names contain "Mercury".

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::path::Path;
use std::sync::Arc;

use kenzan::check::Book;
use kenzan::diagnose::stability::catalogue::{Case, Measured, Ready, bundled};
use kenzan::diagnose::stability::survey::MANY;
use libtest_mimic::{Arguments, Failed, Trial};

fn book(name: &str) -> Book {
    let path = format!("{}/notes/{name}.md", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(&path).unwrap();
    Book::new(&kenzan::document::parse(Path::new(&path), &text))
}

fn check(holds: bool, why: impl FnOnce() -> String) -> Result<(), Failed> {
    if holds { Ok(()) } else { Err(why().into()) }
}

/// It stands where it says, and the stable form is the same formula and loses fewer bits.
fn measured(case: &Case, book: &Book) -> Result<(), Failed> {
    let ready = Ready::new(case, book, 1)?;
    check(ready.printed == case.printed, || format!("a side of ({}): {}", case.equation, ready.printed))?;
    let found: Measured = ready.measured(1, false)?;
    let before = &found.before;
    check(before.at.lost > MANY, || format!("the hard state is not hard: {:?}", before.at))?;
    check(before.found.worst.loss.lost >= before.at.lost - 1.0, || "the search found less".into())?;
    let Some(after) = &found.after else {
        // Nothing to be done: the problem is ill-conditioned.
        return check(before.found.fault.loss.fault() < MANY, || format!("a fault: {:?}", before.found.fault));
    };
    check(after.sameness.holds(), || format!("not the same formula: {:?}", after.sameness))?;
    let form = &after.form;
    check(form.at.lost < before.at.lost - MANY, || format!("{:?} -> {:?}", before.at, form.at))?;
    check(form.found.mean < before.found.mean, || format!("mean {} -> {}", before.found.mean, form.found.mean))?;
    let fault = form.found.fault.loss.fault();
    check(fault < MANY, || format!("the stable form has a fault of {fault} bits: {:?}", form.found.fault))
}

/// The second part of the constant of 1 - 3 cos² I, whose last digit is 2^-106: less than double-double can tell.
const LAST_DIGITS: [&str; 2] = ["7393927799684612", "81129638414606681695789005144065"];

/// No mutant of the stable form passes for the formula.
fn refused(case: &Case, book: &Book) -> Result<(), Failed> {
    let (total, mut survivors) = Ready::new(case, book, 1)?.mutants(1);
    survivors.retain(|latex| !LAST_DIGITS.iter().any(|digits| latex.contains(digits)));
    check(total > 0 || case.stable.is_none(), || "no mutants".into())?;
    check(survivors.is_empty(), || format!("{} of {total}: {survivors:#?}", survivors.len()))
}

fn main() {
    let arguments = Arguments::from_args();
    let books = [
        ("gyroscope", Arc::new(book("gyroscope"))),
        ("celestial-mechanics-3", Arc::new(book("celestial-mechanics-3"))),
    ];
    let mut trials = Vec::new();
    for case in bundled().unwrap() {
        let book = books.iter().find(|(name, _)| *name == case.notes).map(|(_, book)| Arc::clone(book)).unwrap();
        let (again, same_book) = (case.clone(), Arc::clone(&book));
        trials.push(Trial::test(format!("{}::measured", case.name), move || measured(&again, &same_book)));
        trials.push(Trial::test(format!("{}::mutants", case.name), move || refused(&case, &book)));
    }
    libtest_mimic::run(&arguments, trials).exit();
}
