//! What every input must survive. The fuzz targets call these functions, and `tests/hostile_corpus.rs` calls them once
//! for each file of `fuzz/corpus`.
//!
//! A panic is a finding even where the program would catch it.

#![allow(dead_code, reason = "each fuzz target uses one of these functions")]

use std::path::Path;
use std::time::{Duration, Instant};

use kenzan::check::{Book, Options};
use kenzan::document::{self, Document};
use kenzan::latex;
use kenzan::report::{self, html, json, terminal};
use kenzan::verify::{self, Request};

/// The longest input of the whole pipeline, in bytes: what is large costs time, and finds nothing that small notes hide.
const LONGEST_NOTES: usize = 4096;

/// The time budget of an equation in the whole pipeline.
const BUDGET: Duration = Duration::from_secs(2);

/// The Markdown reader: places lie within the file, and what is wrong can be told.
pub fn markdown(data: &[u8]) {
    notes(Path::new("notes.md"), data);
}

/// The reader of LaTeX documents, with their macros.
pub fn tex(data: &[u8]) {
    notes(Path::new("notes.tex"), data);
}

fn notes(path: &Path, data: &[u8]) {
    let Ok(text) = std::str::from_utf8(data) else { return };
    let document = document::parse(path, text);
    for equation in document.equations() {
        assert_eq!(document.source.get(equation.span.clone()), Some(equation.latex.as_str()), "the bytes at its span");
        assert_eq!(equation.masked.len(), equation.latex.len(), "a place in one is a place in the other");
        match equation.macros.expand(&equation.masked) {
            Ok(expanded) => assert!(expanded.place(&(0..expanded.text.len())).end <= equation.masked.len()),
            Err(error) => assert!(equation.masked.get(error.span).is_some(), "a place in the formula"),
        }
    }
    tell_problems(&document);
}

/// The annotation reader: TOML after an equation, and TOML that declares symbols.
pub fn annotation(data: &[u8]) {
    let Ok(toml) = std::str::from_utf8(data) else { return };
    let after = format!("$$ a = b \\tag{{1}} $$\n<!-- kenzan\n{toml}\n-->\n\n$$ c = d \\tag{{2}} $$\n");
    let before = format!("# Notes\n\n<!-- kenzan\n{toml}\n-->\n\n$$ a = b \\tag{{1}} $$\n");
    for text in [after, before] {
        let document = document::parse(Path::new("notes.md"), &text);
        let book = Book::new(&document);
        tell_problems(&document);
        for problem in &book.problems {
            let _ = problem.to_text(&document);
        }
    }
}

fn tell_problems(document: &Document) {
    for problem in &document.problems {
        let _ = (problem.to_text(document), format!("{:?}", problem.to_miette(document)));
    }
}

/// The LaTeX parser: what was read is printed, and what was printed is read as the same tree.
pub fn latex(data: &[u8]) {
    let Ok(text) = std::str::from_utf8(data) else { return };
    match latex::parse(text) {
        Ok(tree) => {
            let printed = latex::to_latex(&tree);
            let again = latex::parse(&printed).map(|tree| latex::to_latex(&tree));
            // Only the depth and the length are limited, and printing may add braces.
            if let Ok(again) = again {
                assert_eq!(printed, again, "what is printed is read as it was meant");
            }
        }
        Err(error) => {
            let place = error.span.start.min(text.len())..error.span.end.min(text.len());
            assert!(text.get(place).is_some(), "the error's place lies between characters");
        }
    }
}

/// The whole pipeline: notes, judgements, report.
pub fn pipeline(data: &[u8]) {
    let Ok(text) = std::str::from_utf8(data) else { return };
    if text.len() > LONGEST_NOTES {
        return;
    }
    let options = Options { states: 2, budget: Some(BUDGET), ..Options::default() };
    let request = Request { options, ..Request::default() };
    let document = document::parse(Path::new("notes.md"), text);
    if document.equations().count() > 8 {
        return;
    }
    let verified = [verify::verify(document, &request, &|| ())];
    for judgement in &verified[0].report.equations {
        let reason = judgement.reason.as_deref().unwrap_or_default();
        assert!(!reason.contains("Kenzan broke down"), "{reason}");
    }
    let run = verify::run(&verified, &request, Instant::now());
    let options = report::Options { times: false, ..report::Options::default() };
    let pages = html::pages(&run, options).expect("the templates fit all data");
    json::render(&run, options).expect("all data are JSON");
    terminal::render(&run, true, options);
    assert!(pages.iter().all(|page| page.html.ends_with("</html>\n")), "the pages are whole");
}
