//! Input that nobody would write, and input that somebody damaged: no panic, no endless time, and the promises hold.

use super::*;
use proptest::prelude::*;
use std::time::{Duration, Instant};

/// Pieces that mean something to the reader.
const PIECES: &[&str] = &[
    "$$",
    "$",
    "\n",
    "\n\n",
    "\\[",
    "\\]",
    "\\begin{aligned}",
    "\\end{aligned}",
    "\\begin{align}",
    "\\end{align}",
    "\\\\",
    "&",
    "(5)",
    "(6)",
    "\\tag{5}",
    "\\quad",
    "\\begin{cases}",
    "\\end{cases}",
    "{",
    "}",
    "`",
    "```",
    "\n```\n",
    "<!--",
    "-->",
    "<!-- kenzan\n",
    "given = ['1']\n",
    "rows = ['5', '6']\n",
    "for = '6'\n",
    "label = 'x'\n",
    "[symbols]\n",
    "'a, b' = { range = [1, 2] }\n",
    "# ",
    "> ",
    "- ",
    "    ",
    "---\n",
    "日本語",
    "é",
    "\u{feff}",
    "\r\n",
    "some words here",
    "a = b",
    "\\",
    "~",
    " ",
    "\"",
    "\\label{x}",
    "\0",
];

fn check_text(source: &str) {
    let document = parse(source);
    check_promises(&document);
    for problem in &document.problems {
        let _ = (problem.to_text(&document), format!("{:?}", problem.to_miette(&document)));
    }
}

fn bundled() -> String {
    std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("notes/gyroscope.md")).unwrap()
}

proptest! {
    #![proptest_config(crate::testing::properties(400))]

    #[test]
    fn random_text_is_survived(source in any::<String>()) {
        check_text(&source);
    }

    #[test]
    fn random_pieces_are_survived(pieces in prop::collection::vec(prop::sample::select(PIECES), 0..60)) {
        check_text(&pieces.concat());
    }

    #[test]
    fn damaged_notes_are_survived(
        damages in prop::collection::vec((any::<prop::sample::Index>(), 0..40usize, prop::sample::select(PIECES)), 1..6),
    ) {
        let mut source = bundled();
        for (at, length, piece) in damages {
            let start = source.floor_char_boundary(at.index(source.len()));
            let end = source.ceil_char_boundary((start + length).min(source.len()));
            source.replace_range(start..end, piece);
        }
        check_text(&source);
    }
}

#[test]
fn one_damaged_display_does_not_cost_the_others() {
    let source = bundled();
    let all = parse(&source).equations().count();
    let opening: Vec<_> = source.match_indices("\n$$").map(|(at, _)| at + 1).collect();
    for at in opening {
        let close = at + 2 + source[at + 2..].find("$$").unwrap();
        let damaged = format!("{}{}", &source[..close], &source[close + 2..]);
        let document = parse(&damaged);
        assert_eq!(document.problems.first().map(|problem| problem.code), Some("document::unclosed"), "{close}");
        assert_eq!(document.problems[0].span, at..at + 2, "the place where it was opened");
        assert!(document.equations().count() + 3 > all, "{close}: {} of {all}", document.equations().count());
    }
}

/// The reader is linear: half a megabyte takes some tenths of a second here, and would take many minutes if anything were
/// done once more for each repetition. A busy machine is no reason to fail.
#[test]
fn large_input_takes_no_more_than_linear_time() {
    let size = 500_000;
    for unit in [
        "x",
        " ",
        "\\",
        "`",
        "$",
        "$$",
        "$$a$$ ",
        "$$a\n\n",
        "\\[",
        "\n\\[",
        "\\[a\\]",
        "\\begin{equation}",
        "\\begin{aligned}",
        "$$\\begin{a}",
        "\\tag{1}",
        "\\tag{",
        "(1)",
        "<!--",
        "<!-- kenzan\n",
        "<!-- kenzan -->",
        "-->",
        "> ",
        "- ",
        "{",
        "\n\n",
        "``` ",
        "\n```",
        "$x$ ",
        "# a\n",
        "*",
        "_a",
        "[",
        "![",
        "<",
        "&",
        "|",
        "a\n===\n",
        "日",
        "~",
        "\\quad",
        "$$ > \n",
        "\\(",
        "\\(a\\) ",
        "\\label{",
        "\\eqref{a}",
        "\\newcommand{",
        "\\newcommand\\a{b}$$\\a$$ ",
        "\\def\\a#1{",
        "\\input{a}",
        "\\begin{verbatim}",
        "\\verb|a",
        "\\section{",
        "%",
        "%!a=1\n",
        "@eq",
        "Eq. (1",
        "{eq}`",
        "\\begin{align}a\\label{b}\\\\",
        "a\\label{b}\\\\",
        "\\begin{equation}a\\end{equation}",
    ] {
        let source = unit.repeat(size / unit.len());
        let start = Instant::now();
        let document = parse(&source);
        let inside = parse(&format!("$$ {} $$", source.replace("$$", "")));
        let _ = super::super::parse(Path::new("notes.tex"), &format!("\\begin{{align}} {source}"));
        let _ = super::super::parse(Path::new("notes.tex"), &format!("\\begin{{align}} {source} \\end{{align}}"));
        assert!(start.elapsed() < Duration::from_secs(120), "{unit:?} took {:?}", start.elapsed());
        println!("{unit:?}: {:?}, {} and {} items", start.elapsed(), document.items.len(), inside.items.len());
    }
}

#[test]
fn a_line_of_ten_megabytes_is_read() {
    let source = format!("{} $$a = b \\quad (1)$$ {} $$c", "日本語 $x$ ".repeat(300_000), "words ".repeat(1_000_000));
    let document = parse(&source);
    let labels: Vec<_> = document.equations().map(|equation| equation.label.as_str()).collect();
    assert_eq!((labels, document.problems.len()), (vec!["1"], 1));
    check_promises(&document);
}

#[test]
fn deep_nesting_is_survived() {
    let deep = |open: &str, close: &str| open.repeat(100_000) + &close.repeat(100_000);
    for toml in [
        format!("a = {}", deep("[", "]")),
        format!("a = {}", deep("{ a = ", "}")),
        format!("{}a = 1", "a.".repeat(100_000)),
        format!("[{}a]\nb = 1", "a.".repeat(100_000)),
        format!("[[{}a]]\nb = 1", "a.".repeat(100_000)),
        format!("[symbols]\n{}a = 1", "a.".repeat(100_000)),
    ] {
        let document = parse(&format!("$$ a $$\n<!-- kenzan\n{toml}\n-->\n$$ b $$"));
        assert_eq!(document.equations().count(), 2);
        assert!(!document.problems.is_empty(), "{}", &toml[..20]);
    }
    for latex in [deep("{", "}"), deep(r"\begin{aligned}", r"\end{aligned}"), deep(r"\left(", r"\right)")] {
        assert_eq!(equations(&format!("$$ {latex} \\tag{{7}} $$"))[0].0, "7");
    }
}
