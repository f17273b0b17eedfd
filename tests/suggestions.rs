//! How often the search for what was meant finds it: on the errata of the bundled notes, whose corrections it does not
//! see, and on mutants of the equations that hold. Run with `--nocapture` to see the figures.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::path::Path;

use kenzan::check::{self, Book, Options};
use kenzan::diagnose::correct;
use kenzan::diagnose::measure::{self, Rank, Soundness};
use kenzan::document::{self, Item};
use rayon::prelude::*;

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
    assert!(std::env::var("ONLY").is_ok() || total == 23 && first >= 20 && found >= 21, "{first}, {found} of {total}");
}

/// The search must not see the correction it is measured by: without it in the document it finds the same.
#[test]
fn the_correction_is_not_seen() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("notes/gyroscope.md");
    let (document, options) = (document::read(&path).expect("the notes can be read"), options());
    let book = Book::new(&document);
    for label in ["8+1", "42", "45", "60", "83"] {
        let mut without = document.clone();
        for item in &mut without.items {
            if let Item::Equation(e) = item
                && e.label == label
            {
                let annotation = e.annotation.as_mut().expect("it has a correction");
                assert!(annotation.correction.take().is_some());
            }
        }
        let blind = Book::new(&without);
        let suggestions = |book: &Book| {
            let index = book.entries.iter().position(|e| e.equation.label == label).expect("it is in the notes");
            correct::suggestions(book, index, &check::judge(book, index, &options), &options)
        };
        assert_eq!(suggestions(&book), suggestions(&blind), "({label})");
    }
}

/// Prints how many of the originals are found, for each kind of edit and for each equation; returns the counts of all:
/// mutants, originals found first, among the first three.
fn tally(ranks: &[Rank]) -> [usize; 3] {
    let count = |ranks: &[&Rank]| {
        let place = |p: fn(usize) -> bool| ranks.iter().filter(|r| r.place.is_some_and(p)).count();
        [ranks.len(), place(|p| p == 0), place(|_| true)]
    };
    let mut kinds: Vec<_> = ranks.iter().filter_map(|r| r.edit.as_ref().map(|e| e.0)).collect();
    kinds.sort_unstable();
    kinds.dedup();
    for kind in kinds {
        let of: Vec<&Rank> = ranks.iter().filter(|r| r.edit.as_ref().is_some_and(|e| e.0 == kind)).collect();
        println!("{kind:?}: {:?}", count(&of));
    }
    let time: f64 = ranks.iter().map(|r| r.time.as_secs_f64()).sum();
    let all = count(&ranks.iter().collect::<Vec<_>>());
    println!("{all:?} mutants, found first, found among the first three; {:.2} s each", time / ranks.len() as f64);
    all
}

fn originals(most: usize, wanted: impl Fn(&str) -> bool) -> Vec<Rank> {
    let (book, options) = (notes(), options());
    let mut all = Vec::new();
    for index in (0..book.entries.len()).filter(|k| wanted(&book.entries[*k].equation.label)) {
        let judgement = check::judge(&book, index, &options);
        let ranks = measure::ranks_of_original(&book, index, &judgement, &options, most);
        let found = ranks.iter().filter(|r| r.place.is_some()).count();
        let time: f64 = ranks.iter().map(|r| r.time.as_secs_f64()).sum();
        println!("({}) {found} of {} in {time:.2} s", judgement.label, ranks.len());
        ranks.iter().filter(|r| r.place.is_none()).for_each(print);
        all.extend(ranks);
    }
    all
}

/// Ten mutants of every equation that holds are taken for what was printed: minutes.
#[test]
#[ignore = "takes minutes"]
fn originals_of_mutants_are_found() {
    let most = std::env::var("MOST").ok().and_then(|m| m.parse().ok()).unwrap_or(10);
    let [total, first, three] = tally(&originals(most, wanted));
    assert!(10 * three >= 8 * total && 10 * first >= 6 * total, "{first}, {three} of {total}");
}

#[test]
fn originals_of_some_mutants_are_found() {
    let some = ["33", "46a", "56", "64", "70", "74", "78", "79"];
    let [total, first, three] = tally(&originals(2, |label| some.contains(&label)));
    assert!(10 * three >= 8 * total && 10 * first >= 6 * total, "{first}, {three} of {total}");
}

/// A hundred thousand mutants with one or two edits: none may be judged to hold that does not.
#[test]
#[ignore = "takes minutes"]
fn no_mutant_holds_falsely() {
    let each = std::env::var("MOST").ok().and_then(|m| m.parse().ok()).unwrap_or(2500);
    let (book, options) = (notes(), options());
    let begin = std::time::Instant::now();
    let of = |index: &usize| {
        let judgement = check::judge(&book, *index, &options);
        let found = measure::soundness(&book, *index, &judgement, &options, each)?;
        println!("({}) {} of {} hold falsely", judgement.label, found.refuted.len(), found.judged);
        Some((judgement.label, found))
    };
    let indices: Vec<usize> = (0..book.entries.len()).filter(|k| wanted(&book.entries[*k].equation.label)).collect();
    let all: Vec<(String, Soundness)> = indices.par_iter().filter_map(of).collect();
    let mut counts = [0; 8];
    for (label, s) in &all {
        let own = [s.judged, s.killed, s.open, s.same, s.exact, s.elsewhere, s.unconfirmed.len(), s.refuted.len()];
        println!("({label}) {own:?}");
        s.refuted.iter().for_each(|latex| println!("      refuted {latex}"));
        s.unconfirmed.iter().take(3).for_each(|latex| println!("      unconfirmed {latex}"));
        counts.iter_mut().zip(own).for_each(|(sum, n)| *sum += n);
    }
    println!(
        "judged, killed, open, same, exact, elsewhere, unconfirmed, refuted: {counts:?} in {:.2?}",
        begin.elapsed()
    );
    assert!(all.iter().all(|(_, s)| s.refuted.is_empty()));
}
