//! Every formula of the original notes is read, and none is refused that KaTeX would print and a reader understand.
//!
//! The notes are not part of the crate: where they are missing, the tests say so and pass.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
#![allow(missing_docs)]

use std::path::Path;

use kenzan::latex::ast::{Kind, Node};
use kenzan::latex::{parse, to_latex};

/// A document with the number of its displays and of its inline formulas.
const DOCUMENTS: [(&str, usize, usize); 2] = [("gyroscope.md", 89, 159), ("celestial-mechanics-3.md", 565, 209)];

/// The formulas that are refused, although KaTeX prints them, and why.
const REFUSED: [(&str, &str); 1] =
    [("x, y, z \\longrightarrow x', y', z' \\wedge", "a product without its second factor: a scanned hiragana he")];

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

/// Each document's text; those that are missing are named and left out.
fn documents() -> Vec<(&'static str, String, usize, usize)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/notes");
    let read = |&(name, displays, inlines): &(&'static str, usize, usize)| {
        let text = std::fs::read_to_string(folder.join(name));
        text.map_err(|_| println!("skipped: {name} is not there")).ok().map(|text| (name, text, displays, inlines))
    };
    DOCUMENTS.iter().filter_map(read).collect()
}

/// Every formula of the documents.
fn all_formulas(documents: &[(&'static str, String, usize, usize)]) -> Vec<String> {
    let mut all = Vec::new();
    for (_, text, _, _) in documents {
        let (displays, inlines) = formulas(text);
        all.extend(displays.into_iter().chain(inlines).map(str::to_owned));
    }
    all
}

#[test]
fn all_formulas_are_read() {
    for (name, text, displays, inlines) in documents() {
        let (found_displays, found_inlines) = formulas(&text);
        assert_eq!((found_displays.len(), found_inlines.len()), (displays, inlines), "{name}");
        for latex in found_displays.into_iter().chain(found_inlines) {
            let reason = REFUSED.iter().find(|(refused, _)| *refused == latex.trim());
            match (parse(latex), reason) {
                (Ok(_), None) => {}
                (Err(error), Some((_, reason))) => println!("{name}: {}: {error}: {reason}", latex.trim()),
                (Ok(_), Some(_)) => panic!("{name}: {latex} is read after all"),
                (Err(error), None) => panic!("{name}: {latex}: {error}"),
            }
        }
    }
}

#[test]
fn katex_reads_the_same_formulas() {
    let documents = documents();
    let context = katex::KatexContext::default();
    let settings = katex::Settings::builder().display_mode(true).build();
    let mut differing = Vec::new();
    for latex in all_formulas(&documents) {
        let ours = parse(&latex).is_ok();
        if katex::parse(&context, &latex, &settings).is_ok() != ours {
            differing.push((latex.trim().to_owned(), ours));
        }
    }
    for (latex, ours) in &differing {
        println!("{} only: {latex}", if *ours { "Kenzan" } else { "KaTeX" });
        assert!(!ours, "{latex} is refused by KaTeX");
        assert!(REFUSED.iter().any(|(refused, _)| refused == latex), "{latex}");
    }
    assert!(documents.len() < DOCUMENTS.len() || differing.len() == REFUSED.len());
}

/// A tree without its places.
fn shape(node: &Node) -> String {
    let text = format!("{node:?}");
    let mut shape = String::with_capacity(text.len());
    let mut rest = text.as_str();
    while let Some((before, after)) = rest.split_once("pan: ") {
        shape.push_str(before);
        rest = after.trim_start_matches("Some(").trim_start_matches(|c: char| c.is_ascii_digit() || c == '.');
    }
    shape + rest
}

#[test]
fn trees_come_back_from_their_latex() {
    for latex in all_formulas(&documents()) {
        let Ok(tree) = parse(&latex) else { continue };
        let written = to_latex(&tree);
        match parse(&written) {
            Ok(again) => assert_eq!(shape(&again), shape(&tree), "{latex} becomes {written}"),
            Err(error) => panic!("{latex} becomes {written}: {error}"),
        }
    }
}

/// The sides of all chains in a tree that are not within delimiters.
fn sides<'a>(node: &'a Node, found: &mut Vec<&'a Node>) {
    match &node.kind {
        Kind::Chain { first, links } => {
            found.extend(first.iter().map(AsRef::as_ref).chain(links.iter().map(|link| &link.rhs)));
        }
        Kind::List(nodes) | Kind::Rows(nodes) => nodes.iter().for_each(|node| sides(node, found)),
        Kind::Marked(_, body) => sides(body, found),
        Kind::Group { body, .. } => sides(body, found),
        _ => {}
    }
}

/// The bytes of a side, read alone, are that side: reports quote sides by their spans.
#[test]
fn sides_are_read_alone_from_their_bytes() {
    let mut count = 0;
    for latex in all_formulas(&documents()) {
        let Ok(tree) = parse(&latex) else { continue };
        let mut found = Vec::new();
        sides(&tree, &mut found);
        for side in found {
            let bytes = &latex[side.span.clone()];
            match parse(bytes) {
                Ok(alone) => assert_eq!(shape(&alone), shape(side), "{bytes} in {latex}"),
                Err(error) => panic!("{bytes} in {latex}: {error}"),
            }
            count += 1;
        }
    }
    println!("{count} sides");
}
