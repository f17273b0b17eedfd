//! A verification with a memory says what one without says, whatever was edited in between.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use std::path::Path;
use std::time::Instant;

use common::edits::{Edits, edited};
use kenzan::check::Options;
use kenzan::document::{self, Document, Problem};
use kenzan::incremental::Memory;
use kenzan::report::{self, html, json};
use kenzan::verify::{self, Request, Verified};

/// All that is told of a document: the page, the data, and the problems with their places.
fn told(verified: Verified, request: &Request) -> (String, String, Vec<Problem>) {
    let problems = verified.report.equations.iter().flat_map(|e| e.problems()).chain(&verified.problems).cloned();
    let problems = problems.collect();
    let run = verify::run(&[verified], request, Instant::now());
    let without_times = report::Options { times: false, ..report::Options::default() };
    let pages = html::pages(&run, without_times).unwrap();
    let page = pages.into_iter().map(|page| page.html).collect();
    (page, json::render(&run, without_times).unwrap(), problems)
}

/// A pool whose threads have the stack that deep formulas need.
fn in_pool<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    rayon::ThreadPoolBuilder::new().num_threads(2).stack_size(32 << 20).build().unwrap().install(work)
}

/// Verifies the document with the memory and without, and compares; how many equations were judged anew.
fn compare(document: &Document, request: &Request, memory: &mut Memory, edit: &str) -> usize {
    let (verified, anew) = verify::verify_again(document.clone(), request, memory, &|| ());
    let (page, data, problems) = told(verified, request);
    let (fresh_page, fresh, fresh_problems) = told(verify::verify(document.clone(), request, &|| ()), request);
    for (k, (a, b)) in data.lines().zip(fresh.lines()).enumerate() {
        assert_eq!(a, b, "report.json differs in line {} after {edit}", k + 1);
    }
    assert_eq!(data.len(), fresh.len(), "report.json has another length after {edit}");
    assert!(page == fresh_page, "report.html differs after {edit}");
    assert_eq!(problems, fresh_problems, "after {edit}");
    anew.len()
}

/// So many random edits of notes, each on top of the last ones; now and then the notes are as they were.
fn edit_and_compare(name: &str, request: &Request, seed: u64, count: usize) {
    in_pool(|| {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(name);
        let original = std::fs::read_to_string(&path).unwrap();
        let mut edits = Edits::new(seed);
        let mut text = original.clone();
        let mut memory = Memory::default();
        let (mut anew, mut all) = (0, 0);
        compare(&document::parse(&path, &text), request, &mut memory, "nothing");
        for k in 0..count {
            let edit = if k % 7 == 6 {
                text.clone_from(&original);
                "undoing all".to_owned()
            } else {
                edited(&mut text, &mut edits)
            };
            let document = document::parse(&path, &text);
            all += document.equations().count();
            anew += compare(&document, request, &mut memory, &format!("edit {k}: {edit}"));
        }
        assert!(anew < all * 2 / 3, "{anew} of {all} equations were judged anew: what is a memory for?");
    });
}

fn request() -> Request {
    Request { options: Options { states: 3, ..Options::default() }, ..Request::default() }
}

/// How many edits the tests make: more where one asks for it.
fn count(usual: usize) -> usize {
    std::env::var("KENZAN_EDITS").ok().and_then(|n| n.parse().ok()).unwrap_or(usual)
}

#[test]
fn a_memory_changes_nothing_on_the_gyroscope() {
    edit_and_compare("notes/gyroscope.md", &request(), 1, count(14));
}

#[test]
fn a_memory_changes_nothing_on_the_celestial_mechanics() {
    edit_and_compare("notes/celestial-mechanics-3.md", &request(), 2, count(2));
}

/// Notes that declare nothing: roles are guessed and premises searched.
#[test]
fn a_memory_changes_nothing_on_notes_that_declare_nothing() {
    edit_and_compare("tests/incremental/undeclared.md", &request(), 4, count(5));
}

#[test]
fn a_memory_changes_nothing_on_the_diagnosis() {
    let only = ["1", "21", "46", "56", "57", "78"].map(String::from).to_vec();
    let request = Request { only, mutants: true, suggest: true, ..request() };
    in_pool(|| {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("notes/gyroscope.md");
        let mut text = std::fs::read_to_string(&path).unwrap();
        let mut memory = Memory::default();
        let mut edits = Edits::new(3);
        compare(&document::parse(&path, &text), &request, &mut memory, "nothing");
        for k in 0..count(3) {
            let edit = edited(&mut text, &mut edits);
            compare(&document::parse(&path, &text), &request, &mut memory, &format!("edit {k}: {edit}"));
        }
    });
}

/// Notes in which each equation rests on something else.
const NOTES: &str = r#"# Notes

<!-- kenzan
assume = ['c < d']
[symbols]
'a, b, c' = { range = [1.0, 2.0] }
'd' = { range = [1.0, 2.0] }
-->

$$ a = 2 b \tag{1} $$

$$ a^2 = 4 b^2 \tag{2} $$
<!-- kenzan
given = ["1"]
-->

$$ (b + c)^2 = b^2 + 2 b c + c^2 \tag{3} $$

$$ (b + d)^2 = b^2 + 2 b d + d^2 $$

$$ \kappa = b \tag{4} $$
"#;

/// Which equations are judged anew after a change, by their labels.
fn anew(change: &dyn Fn(&str) -> String) -> Vec<String> {
    let path = Path::new("notes.md");
    let request = request();
    let mut memory = Memory::default();
    let (before, _) = verify::verify_again(document::parse(path, NOTES), &request, &mut memory, &|| ());
    assert!(before.problems.is_empty(), "{:?}", before.problems);
    let text = change(NOTES);
    assert_ne!(text, NOTES, "the change changes something");
    let (verified, anew) = verify::verify_again(document::parse(path, &text), &request, &mut memory, &|| ());
    anew.iter().map(|k| verified.report.equations[*k].label.clone()).collect()
}

#[test]
fn only_what_a_change_concerns_is_judged_anew() {
    let replaced = |from: &'static str, to: &'static str| anew(&move |text| text.replacen(from, to, 1));
    assert_eq!(
        replaced("# Notes\n", "# Notes of mine\n\nwith a longer beginning.\n"),
        [""; 0],
        "text concerns nothing"
    );
    assert_eq!(replaced("b^2 + 2 b c", "b^2 + 3 b c"), ["3"], "only itself");
    assert_eq!(replaced("a = 2 b", "a = 3 b"), ["1", "2"], "what rests on it");
    assert_eq!(replaced("\\tag{3}", "\\tag{3a}"), ["3a", "3a+1"], "a label draws states of its own");
    assert_eq!(
        replaced("'d' = { range = [1.0, 2.0] }", "'d' = { range = [1.0, 3.0] }"),
        ["1", "2", "3", "3+1", "4"],
        "an assumption speaks of d"
    );
    assert_eq!(replaced("given = [\"1\"]", "given = [\"1\"]\nexpect = \"holds\""), ["2"], "its annotation");
    assert_eq!(
        replaced("$$ a = 2 b \\tag{1} $$\n", "$$ a = 2 b \\tag{1} $$\n\n$$ b + b = 2 b \\tag{9} $$\n"),
        ["9"],
        "what is new"
    );
    assert_eq!(replaced("'a, b, c'", "'a, b, c, \\kappa'"), ["4"], "a name that was not declared");
}

#[test]
fn a_symbol_concerns_what_mentions_it() {
    let notes = NOTES.replace("assume = ['c < d']\n", "");
    let path = Path::new("notes.md");
    let request = request();
    let mut memory = Memory::default();
    verify::verify_again(document::parse(path, &notes), &request, &mut memory, &|| ());
    let text = notes.replace("'d' = { range = [1.0, 2.0] }", "'d' = { range = [1.0, 3.0] }");
    let (verified, anew) = verify::verify_again(document::parse(path, &text), &request, &mut memory, &|| ());
    let labels: Vec<&str> = anew.iter().map(|k| verified.report.equations[*k].label.as_str()).collect();
    assert_eq!(labels, ["3+1", "4"], "(4) is asked for all names, as \\kappa is none of them");
}
