//! Every formula of the original notes is read.
#![allow(missing_docs)]

use std::path::Path;

use kenzan::latex::{parse, to_latex};

/// The displayed blocks and the inline formulas of a Markdown text.
fn formulas(text: &str) -> (Vec<&str>, Vec<&str>) {
    let (mut displays, mut inlines) = (Vec::new(), Vec::new());
    for (i, part) in text.split("$$").enumerate() {
        if i % 2 == 1 {
            displays.push(part);
        } else {
            inlines.extend(part.split('$').skip(1).step_by(2));
        }
    }
    (displays, inlines)
}

#[test]
fn corpus() {
    let notes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/notes");
    for name in ["gyroscope.md", "celestial-mechanics-3.md"] {
        let Ok(text) = std::fs::read_to_string(notes.join(name)) else {
            println!("skipped: {name} is not there");
            continue;
        };
        let (displays, inlines) = formulas(&text);
        for (what, set) in [("displays", displays), ("inlines", inlines)] {
            let mut refused = 0;
            for (i, latex) in set.iter().enumerate() {
                match parse(latex) {
                    Err(e) => {
                        refused += 1;
                        println!("{name} {what} {i}: {e}\n    {}", latex.trim());
                    }
                    Ok(tree) => {
                        if std::env::var("SHOW").is_ok_and(|s| s == name) {
                            println!("{i} SRC {}\n{i} GOT {}", latex.trim(), to_latex(&tree));
                        }
                    }
                }
            }
            println!("{name}: {} {what}, {refused} refused", set.len());
        }
    }
}
