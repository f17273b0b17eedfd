//! The bundled notes print what the originals print: every display in order, and every inline formula at its place,
//! blanks aside. The originals are not part of the repository; without them this part is skipped.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use kenzan::document::{Document, read};
use std::path::{Path, PathBuf};

/// Bundled notes, the original's path beside the repository, and the last label: they are numbered from 1 on.
const NOTES: [(&str, &str, usize); 2] = [
    ("notes/gyroscope.md", "../shared/notes/gyroscope.md", 85),
    ("notes/celestial-mechanics-3.md", "../shared/notes/celestial-mechanics-3.md", 537),
];

fn path(relative: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(relative)
}

fn bundled(relative: &str) -> Document {
    read(&path(relative)).unwrap()
}

/// A display, and the inline formulas between it and the next.
#[derive(Default)]
struct Formulas {
    display: String,
    inline: Vec<String>,
}

/// The formulas of a text in order, found by their dollars alone and not by the reader that is tested elsewhere. The first
/// entry has no display.
fn formulas(source: &str) -> Vec<Formulas> {
    let mut text = String::new();
    for (number, part) in source.split("<!--").enumerate() {
        text += if number == 0 { part } else { part.split_once("-->").map_or("", |(_, after)| after) };
    }
    let squeeze = |text: &str| text.chars().filter(|c| !c.is_whitespace()).collect::<String>();
    let mut found = vec![Formulas::default()];
    for (number, part) in text.split("$$").enumerate() {
        if number % 2 == 1 {
            found.push(Formulas { display: squeeze(part), inline: Vec::new() });
        } else if let Some(last) = found.last_mut() {
            last.inline = part.split('$').skip(1).step_by(2).map(squeeze).collect();
        }
    }
    found
}

#[test]
fn formulas_are_those_of_the_original() {
    for (notes, original, _) in NOTES {
        let Ok(original_text) = std::fs::read_to_string(path(original)) else {
            println!("skipped: {original} is not there");
            continue;
        };
        let found = formulas(&bundled(notes).source);
        let expected = formulas(&original_text);
        for (number, (found, expected)) in found.iter().zip(&expected).enumerate() {
            assert_eq!(found.display, expected.display, "{notes}: display {number} differs");
            let mut rest = expected.inline.iter();
            for inline in &found.inline {
                assert!(rest.any(|other| other == inline), "{notes}: not after display {number}: {inline}");
            }
        }
        assert_eq!(found.len(), expected.len(), "{notes}: number of displays");
    }
}

#[test]
fn labels_are_complete_and_in_order() {
    for (notes, _, last) in NOTES {
        let document = bundled(notes);
        let labels = document.equations().map(|equation| equation.label.as_str());
        let labels: Vec<_> = labels.filter(|label| label.bytes().all(|byte| byte.is_ascii_digit())).collect();
        let expected: Vec<_> = (1..=last).map(|number| number.to_string()).collect();
        assert_eq!(labels, expected, "{notes}");
    }
}

#[test]
fn bundled_notes_have_no_problems() {
    for (notes, _, _) in NOTES {
        let document = bundled(notes);
        let problems: Vec<_> = document.problems.iter().map(|problem| problem.to_text(&document)).collect();
        assert_eq!(problems, Vec::<String>::new());
    }
}
