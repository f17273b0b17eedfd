//! The same seed gives the same bytes, on any number of threads; another seed does not.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::path::Path;
use std::time::Instant;

use kenzan::check::Options;
use kenzan::report::{self, html, json};
use kenzan::verify::{self, Request};

/// The page and the data of a run on the bundled notes, without times.
fn reports(seed: u64, threads: usize) -> (String, String) {
    let options = Options { seed, states: 8, ..Options::default() };
    reports_of(&Request { options, ..Request::default() }, threads)
}

fn reports_of(request: &Request, threads: usize) -> (String, String) {
    let notes = Path::new(env!("CARGO_MANIFEST_DIR")).join("notes/gyroscope.md");
    let request = Request { paths: vec![notes], ..request.clone() };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).stack_size(32 << 20).build().unwrap();
    pool.install(|| {
        let documents = verify::documents(&request.paths).unwrap();
        let verified: Vec<_> = documents.into_iter().map(|d| verify::verify(d, &request, &|| ())).collect();
        let run = verify::run(&verified, &request, Instant::now());
        let without_times = report::Options { times: false, ..report::Options::default() };
        (pages(&run, without_times), json::render(&run, without_times).unwrap())
    })
}

/// All pages in one text.
fn pages(run: &report::Run, options: report::Options) -> String {
    html::pages(run, options).unwrap().into_iter().map(|page| page.html).collect()
}

/// Both texts from the first line in which they differ, for a message that can be read.
fn assert_same(name: &str, a: &str, b: &str) {
    if let Some((k, (a, b))) = a.lines().zip(b.lines()).enumerate().find(|(_, (a, b))| a != b) {
        panic!("{name} differs in line {}:\n{a:.400}\n{b:.400}", k + 1);
    }
    assert_eq!(a.len(), b.len(), "{name} has another length");
}

#[test]
fn the_same_seed_gives_the_same_bytes_on_any_number_of_threads() {
    let (page, data) = reports(7, 1);
    for threads in [2, 3, 4, 8] {
        let (again, data_again) = reports(7, threads);
        assert_same("report.html", &page, &again);
        assert_same("report.json", &data, &data_again);
    }
    assert!(reports(8, 1).1 != data, "another seed draws other states");
}

/// Mutants and suggestions count formulas and not time.
#[test]
fn the_diagnosis_is_the_same_on_any_number_of_threads() {
    let only = ["1", "21", "46", "56", "78"].map(String::from).to_vec();
    let options = Options { states: 8, ..Options::default() };
    let request = Request { options, only, mutants: true, suggest: true, ..Request::default() };
    let (page, data) = reports_of(&request, 1);
    assert!(data.contains("\"killed\"") && data.contains("\"edit\""), "mutants were tried, and suggestions made");
    for threads in [3, 8] {
        let (again, data_again) = reports_of(&request, threads);
        assert_same("report.html", &page, &again);
        assert_same("report.json", &data, &data_again);
    }
}
