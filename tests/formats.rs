//! What is printed for other programs, of all small notes of the repository: the manual's, the course documents, the bad ones.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::path::{Path, PathBuf};
use std::time::Instant;

use kenzan::document;
use kenzan::report::{self, Run, annotations, json};
use kenzan::verify::{self, Request};
use serde_json::Value;

/// The notes in a folder, those that cannot be read at all left out.
fn notes(folder: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
    let mut notes: Vec<PathBuf> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    notes.retain(|path| path.extension().is_some_and(|e| e == "md" || e == "tex" || e == "qmd"));
    notes.sort();
    notes
}

fn run(document: document::Document) -> Run {
    let request = Request::default();
    let pool = rayon::ThreadPoolBuilder::new().stack_size(32 << 20).build().unwrap();
    let verified = [pool.install(|| verify::verify(document, &request, &|| ()))];
    verify::run(&verified, &request, Instant::now())
}

#[test]
fn the_data_of_all_small_notes_is_what_the_schema_says() {
    let schema: Value = serde_json::from_str(&json::schema().unwrap()).unwrap();
    let validator = jsonschema::validator_for(&schema).unwrap();
    let mut judged = 0;
    for path in ["tests/examples", "tests/course", "tests/bad"].into_iter().flat_map(notes) {
        let Ok(document) = document::read(&path) else { continue };
        let run = run(document);
        let data: Value = serde_json::from_str(&json::render(&run, report::Options::default()).unwrap()).unwrap();
        let errors: Vec<String> = validator.iter_errors(&data).map(|e| format!("{}: {e}", e.instance_path())).collect();
        assert!(errors.is_empty(), "{}: {errors:#?}", path.display());
        judged += run.documents[0].equations.len();
    }
    assert!(judged > 150, "{judged} equations");
}

/// A reference to an equation that does not exist is a warning, and an annotation with a key that does not exist an error.
const WARNED: &str = "By Eq. (7),\n\n$$ a + b = b + a \\tag{1} $$\n";
const FAULTY: &str = "$$ a + b = b + a \\tag{1} $$\n<!-- kenzan\nbecuase = \"x\"\n-->\n";

fn of(text: &str) -> Run {
    run(document::parse(Path::new("a, b.md"), text))
}

#[test]
fn a_warning_turns_nothing_red() {
    let warned = of(WARNED);
    assert!(!warned.documents[0].problems.is_empty() && warned.documents[0].equations[0].as_expected);
    let junit = annotations::junit(&warned, false).unwrap();
    assert!(junit.contains("failures=\"0\" errors=\"0\"") && junit.contains("<system-out>"), "{junit}");
    assert!(junit.contains("testcase name=\"a, b.md:1:"), "{junit}");
    let github = annotations::github(&warned);
    assert!(github.starts_with("::warning file=a%2C b.md,line=1,col="), "{github}");
    let sarif: Value = serde_json::from_str(&annotations::sarif(&warned).unwrap()).unwrap();
    assert_eq!(sarif["runs"][0]["results"][0]["level"], "warning", "{sarif:#}");
}

#[test]
fn a_faulty_annotation_is_an_error_at_its_place() {
    let faulty = of(FAULTY);
    let junit = annotations::junit(&faulty, false).unwrap();
    assert!(junit.contains("errors=\"1\"") && junit.contains("did you mean"), "{junit}");
    assert!(annotations::github(&faulty).starts_with("::error file=a%2C b.md,line=3,col=1::an annotation"));
    let sarif: Value = serde_json::from_str(&annotations::sarif(&faulty).unwrap()).unwrap();
    let result = &sarif["runs"][0]["results"][0];
    assert_eq!(result["level"], "error");
    let place = &result["locations"][0]["physicalLocation"];
    assert_eq!(place["region"]["startLine"], 3, "{place:#}");
    assert_eq!(place["artifactLocation"]["uri"], "a%2C%20b.md");
}

/// The attributes that Jenkins' schema (junit-10.xsd) allows for the root.
#[test]
fn the_root_of_junit_has_the_attributes_that_jenkins_allows() {
    for text in [WARNED, FAULTY] {
        let junit = annotations::junit(&of(text), true).unwrap();
        let root = junit.lines().find(|line| line.starts_with("<testsuites")).unwrap();
        let keys = root.split(' ').filter_map(|word| word.split_once('=')).map(|(key, _)| key);
        assert!(keys.clone().count() >= 4, "{root}");
        keys.for_each(|key| assert!(["name", "time", "tests", "failures", "errors"].contains(&key), "{key} in {root}"));
    }
}
