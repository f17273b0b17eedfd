//! How often the search for what was meant finds it: on the errata of the bundled notes, whose corrections it does not
//! see, and on mutants of the equations that hold. Run with `--nocapture` to see the figures.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::path::Path;

use kenzan::check::{self, Book, Options};
use kenzan::diagnose::measure::{self, Rank};
use kenzan::document;

fn notes() -> Book {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("notes/gyroscope.md");
    Book::new(&document::read(&path).expect("the notes can be read"))
}

fn options() -> Options {
    Options { states: 16, ..Options::default() }
}

/// Labels in the environment variable `ONLY`, separated by blanks, restrict a measurement.
fn wanted(label: &str) -> bool {
    std::env::var("ONLY").map_or(true, |only| only.split(' ').any(|l| l == label))
}

fn print(rank: &Rank) {
    let place = rank.place.map_or("-".to_owned(), |p| (p + 1).to_string());
    let edit = rank.edit.iter().map(|(kind, text)| format!(" [{kind:?}: {text}]")).collect::<String>();
    println!("({}) {place} of {} in {:.2?}{edit}", rank.label, rank.suggestions.len(), rank.time);
    if rank.place != Some(0) {
        rank.suggestions.iter().for_each(|s| println!("      {}", s.edit));
    }
}

#[test]
fn errata_are_found() {
    let (book, options) = (notes(), options());
    let (mut found, mut first, mut total) = (0, 0, 0);
    for index in (0..book.entries.len()).filter(|k| wanted(&book.entries[*k].equation.label)) {
        let judgement = check::judge(&book, index, &options);
        let Some(rank) = measure::rank_of_correction(&book, index, &judgement, &options) else { continue };
        total += 1;
        found += usize::from(rank.place.is_some());
        first += usize::from(rank.place == Some(0));
        print(&rank);
    }
    println!("{first} of {total} corrections come first, {found} are among the first three");
    assert!(std::env::var("ONLY").is_ok() || total == 23 && found >= 14, "{found} of {total}");
}
