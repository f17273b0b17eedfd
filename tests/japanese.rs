//! Reports in Japanese have no English left but what stands in the notes and data that say that they are English.
//!
//! A sentence that another floor composes and `report/words/reasons` does not know stays in English; here it is found, as far
//! as the examples, the faulty notes, the course documents and the bundled notes make Kenzan say it.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::time::Instant;

use kenzan::check::Options;
use kenzan::document::{self, Document};
use kenzan::report::{self, Language, html, speed, stability, terminal};
use kenzan::scene::SCENES;
use kenzan::scene::speed::Sweep;
use kenzan::verify::{self, Request};
use regex_lite::Regex;
use scraper::{Html, Node};

const JAPANESE: report::Options = report::Options { times: true, language: Language::Japanese };

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The files of a folder of notes.
fn notes(folder: &str) -> Vec<PathBuf> {
    let is_notes = |path: &PathBuf| path.extension().is_some_and(|e| ["md", "tex", "qmd"].iter().any(|n| e == *n));
    let entries = std::fs::read_dir(root().join(folder)).unwrap().map(|entry| entry.unwrap().path());
    let mut paths: Vec<PathBuf> = entries.filter(is_notes).filter(|p| !p.ends_with("README.md")).collect();
    paths.sort();
    assert!(!paths.is_empty(), "{folder}");
    paths
}

/// Documents that can be read, with what stands in their files.
fn read(paths: &[PathBuf]) -> (Vec<Document>, String) {
    let documents: Vec<Document> = paths.iter().filter_map(|path| document::read(path).ok()).collect();
    let sources = paths.iter().filter_map(|path| std::fs::read_to_string(path).ok());
    (documents, normal(&sources.collect::<Vec<_>>().join("\n")))
}

/// With runs of spaces made single ones, without the signs that set mathematics off.
fn normal(text: &str) -> String {
    text.replace(['$', '*', '`'], "").split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Two words of English.
fn english() -> Regex {
    Regex::new(r"[A-Za-z]{2,}:? [a-z]{2,}").unwrap()
}

/// The texts of a page that a reader reads or hears, formulas, code and what is marked as English aside.
fn texts(page: &str) -> Vec<String> {
    let page = Html::parse_document(page);
    let mut texts = Vec::new();
    for node in page.tree.nodes() {
        let foreign = |name: &str| ["math", "code", "pre", "script", "style", "title"].contains(&name);
        let skipped = node
            .ancestors()
            .any(|a| a.value().as_element().is_some_and(|e| foreign(e.name()) || e.attr("lang") == Some("en")));
        match node.value() {
            Node::Text(text) if !skipped => texts.push(text.to_string()),
            Node::Element(element) if !skipped && !foreign(element.name()) => {
                texts.extend(["aria-label", "title", "alt"].iter().filter_map(|a| element.attr(a)).map(str::to_owned));
            }
            _ => {}
        }
    }
    texts
}

/// Of these texts the English ones that stand in no notes.
fn remaining(texts: impl IntoIterator<Item = String>, notes: &str) -> BTreeSet<String> {
    let english = english();
    // What is quoted in a text for the terminal is LaTeX, and so is what begins with a backslash.
    let latex = Regex::new(r"`[^`]*`|\$[^$]*\$|\\text\{[^}]*\}|\\[A-Za-z]+").unwrap();
    let mut found = BTreeSet::new();
    for text in texts {
        let bare = latex.replace_all(&text, " ◦ ").into_owned();
        if english.is_match(&bare) && !notes.contains(&normal(&text)) {
            found.insert(normal(&text));
        }
    }
    found
}

/// What the notes say within other texts, the longest first: titles of documents and sections, why an equation is as it is,
/// and the TOML library's own words on an annotation.
fn said(verified: &[verify::Verified]) -> Vec<String> {
    let reports = verified.iter().map(|v| &v.report);
    let equations = reports.clone().flat_map(|r| &r.equations);
    let own = equations.flat_map(|e| [Some(&e.section), e.because.as_ref()]).flatten();
    let toml = verified.iter().flat_map(|v| &v.problems).filter(|p| p.code == "document::toml");
    let own = own.chain(reports.flat_map(|r| [&r.title, &r.path])).chain(toml.filter_map(|p| p.label.as_ref()));
    let mut said: Vec<String> = own.cloned().filter(|text| !text.is_empty()).collect();
    said.sort_by_key(|text| std::cmp::Reverse(text.len()));
    said.dedup();
    said
}

/// What remains in English in the report on notes.
fn of_notes(paths: &[PathBuf], request: &Request) -> BTreeSet<String> {
    let (documents, notes) = read(paths);
    let verified: Vec<_> = documents.into_iter().map(|d| verify::verify(d, request, &|| ())).collect();
    let run = verify::run(&verified, request, Instant::now());
    let said = said(&verified);
    let notes = format!("{notes}\n{}", normal(&said.join("\n")));
    let without_notes = |text: String| said.iter().fold(text, |text, own| text.replace(own, "◦"));
    let remaining = |texts: Vec<String>| remaining(texts.into_iter().map(without_notes), &notes);
    let pages = html::pages(&run, JAPANESE).unwrap();
    let mut found = remaining(pages.iter().flat_map(|page| texts(&page.html)).collect());
    let summary = terminal::render(&run, false, JAPANESE);
    // A formula's line, and the name of the document, are the notes' own.
    let own =
        |line: &str| line.contains("正しくは") || line.trim_start().starts_with(['+', '-']) || !line.starts_with(' ');
    found.extend(remaining(summary.lines().filter(|line| !own(line)).map(str::to_owned).collect()));
    let problems = verified.iter().flat_map(|v| {
        let judged = v.report.equations.iter().flat_map(|e| e.problems());
        v.problems.iter().chain(judged)
    });
    for problem in problems.map(|p| Language::Japanese.problem(p)) {
        let other = problem.other.map(|(_, label)| label);
        let all = [Some(problem.message), problem.label, problem.help, other];
        found.extend(remaining(all.into_iter().flatten().collect()));
    }
    found
}

fn assert_none(found: BTreeSet<String>) {
    let list: Vec<&String> = found.iter().collect();
    assert!(list.is_empty(), "{} texts remain in English:\n{list:#?}", list.len());
}

fn deep() -> Request {
    let options = Options { states: 8, ..Options::default() };
    Request { options, mutants: true, suggest: true, ..Request::default() }
}

#[test]
fn english_is_seen() {
    let page = "<p>例: <b>the sides differ</b> <code>a few words</code></p><p lang=\"en\">said in English</p><p>words of notes</p>\
        <svg aria-label=\"a chart of it\"></svg><p>Kenzan 0.1, <math>x y</math></p>";
    let found = remaining(texts(page), &normal("words  of\nnotes"));
    assert_eq!(found.into_iter().collect::<Vec<_>>(), ["a chart of it", "the sides differ"]);
}

#[test]
fn the_examples_have_no_english_left() {
    assert_none(of_notes(&notes("tests/examples"), &deep()));
}

#[test]
fn faulty_notes_have_no_english_left() {
    assert_none(of_notes(&notes("tests/bad"), &deep()));
}

#[test]
fn the_course_documents_have_no_english_left() {
    let options = Options { states: 8, ..Options::default() };
    let paths: Vec<PathBuf> =
        notes("tests/course").into_iter().filter(|p| !p.ends_with("relativity-macros.tex")).collect();
    assert_none(of_notes(&paths, &Request { options, ..Request::default() }));
}

#[test]
fn the_bundled_notes_have_no_english_left() {
    let options = Options { states: 8, ..Options::default() };
    assert_none(of_notes(&notes("notes"), &Request { options, ..Request::default() }));
}

/// Every scene and model, and the top measured.
#[test]
fn the_page_on_speed_has_no_english_left() {
    let scenes = SCENES.iter().map(|scene| {
        let times = vec![0.5, 1.0];
        let sweep =
            Sweep { scene, parameters: scene.defaults(), quantities: vec![0], times, tolerances: vec![1e-3, 1e-9] };
        let measured = scene.name == "top";
        let runs = if measured { sweep.run().unwrap() } else { Vec::new() };
        let picks = if measured { sweep.picks(&[1e-6, 0.0]) } else { Vec::new() };
        speed::Measured { sweep, runs, picks }
    });
    let measured = speed::Speed { scenes: scenes.collect(), drifts: kenzan::scene::drift::drifts(100.0, 1).unwrap() };
    let page = speed::html(&measured, Language::Japanese).unwrap();
    let mut found = remaining(texts(&page), "");
    let tables = measured.scenes.iter().map(|scene| speed::table(scene, Language::Japanese));
    let terminal = tables.chain([speed::growth(&measured.drifts, Language::Japanese)]).collect::<String>();
    found.extend(remaining(terminal.lines().map(str::to_owned), ""));
    assert_none(found);
}

#[test]
fn the_page_on_lost_digits_has_no_english_left() {
    let documents = verify::documents(&[]).unwrap();
    let request = kenzan::stability::Request { seed: 1, only: vec!["68".into(), "500".into()], times: true };
    let found = kenzan::stability::stability(&documents, &request, &|| ()).unwrap();
    // The names of the cases are data in English; the page says so.
    let catalogue = normal(&std::fs::read_to_string(root().join("notes/hard-cases.toml")).unwrap());
    let page = stability::html(&found, JAPANESE).unwrap();
    assert!(page.contains("例の名称、説明、出典は英語のデータです"));
    let names: Vec<String> = found.cases.iter().map(|case| case.name.clone()).collect();
    let without_names = |text: String| names.iter().fold(text, |text, name| text.replace(name, ""));
    let mut remain = remaining(texts(&page).into_iter().map(without_names), &catalogue);
    let summary = stability::summary(&found, JAPANESE);
    remain.extend(remaining(summary.lines().map(|line| without_names(line.to_owned())), &catalogue));
    assert_none(remain);
}
