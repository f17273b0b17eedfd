//! What the program says of notes and arguments that are wrong: the message, its place, the exit code; and that it never
//! panics, still judges the other equations, and leaves an older report alone.
//!
//! The notes are in `tests/bad`; the messages are snapshots, in which no path of the machine and no time stands.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
#![allow(missing_docs)]

use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::{Duration, Instant};

/// A directory of the test's own, with nothing in it but some files of `tests/bad`.
fn scratch(name: &str, files: &[&str]) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("bad_input").join(name);
    let _ = std::fs::remove_dir_all(&path);
    std::fs::create_dir_all(&path).unwrap();
    for file in files {
        std::fs::copy(Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/bad").join(file), path.join(file)).unwrap();
    }
    path
}

/// What a run said.
struct Said {
    code: Option<i32>,
    text: String,
}

/// Runs the program in a directory. All paths are relative to it, since long ones would break lines elsewhere.
fn run(arguments: &[&str], directory: &Path) -> Said {
    let output = Command::new(env!("CARGO_BIN_EXE_kenzan"))
        .current_dir(directory)
        .args(arguments)
        .envs([("NO_COLOR", "1"), ("LC_ALL", "C.UTF-8"), ("TERM", "xterm")])
        .env_remove("FORCE_COLOR")
        .env_remove("RUST_BACKTRACE")
        .output()
        .unwrap();
    let (stdout, stderr) = (String::from_utf8(output.stdout).unwrap(), String::from_utf8(output.stderr).unwrap());
    let text = format!("{stderr}---\n{stdout}exit {:?}\n", output.status.code());
    assert!(!text.contains("panicked"), "{text}");
    Said { code: output.status.code(), text: without_times(&text) }
}

/// `2 equations in 594 µs, seed 1` without the time.
fn without_times(text: &str) -> String {
    let line = |line: &str| match (line.find(" equation"), line.find(" in "), line.find(", seed ")) {
        (Some(_), Some(from), Some(to)) if from < to => format!("{}{}\n", &line[..from], &line[to..]),
        _ => format!("{line}\n"),
    };
    text.lines().map(line).collect()
}

/// Verifies a file of `tests/bad`.
fn verify(file: &str) -> String {
    run(&["verify", file], &scratch(file, &[file])).text
}

macro_rules! notes {
    ($($name:ident)*) => { $(
        #[test]
        fn $name() {
            let said = verify(concat!(stringify!($name), ".md"));
            // Certificates are there with arbitrary precision only.
            let lines = said.lines().filter(|l| !l.trim_start().starts_with("certified:"));
            insta::assert_snapshot!(stringify!($name), lines.collect::<Vec<_>>().join("\n"));
        }
    )* };
}

notes! {
    broken_latex broken_toml continued contradiction duplicate_label empty given_circle given_missing latin1 no_solution
    not_evaluated premise_undeclared range_reversed reading_broken shapes unclosed_display undeclared undeclared_index
    unknown_key unknown_macro
}

#[test]
fn no_file_and_no_notes() {
    let at = scratch("no_file", &[]);
    insta::assert_snapshot!("no_such_file", run(&["verify", "nosuch.md"], &at).text);
    insta::assert_snapshot!("directory", run(&["verify", "."], &at).text);
    assert!(!at.join("out").exists(), "nothing is written");
}

#[test]
fn one_file_that_cannot_be_read_stops_before_anything_is_written() {
    let at = scratch("second", &["undeclared.md"]);
    let said = run(&["verify", "undeclared.md", "nosuch.md"], &at);
    assert_eq!(said.code, Some(2), "{}", said.text);
    assert!(!at.join("out").exists());
}

#[test]
fn arguments() {
    let at = scratch("arguments", &["shapes.md"]);
    insta::assert_snapshot!("only", run(&["verify", "shapes.md", "--only", "9"], &at).text);
    insta::assert_snapshot!("explain", run(&["explain", "shapes.md", "9"], &at).text);
    for wrong in [["--states", "0"], ["--jobs", "0"], ["--jobs", "100000"], ["--precision", "x"], ["--format", "xml"]] {
        let said = run(&["verify", "shapes.md", wrong[0], wrong[1]], &at);
        assert_eq!(said.code, Some(2), "{}", said.text);
        assert!(said.text.contains(wrong[0]) && said.text.contains(wrong[1]), "{}", said.text);
    }
    assert!(!at.join("out").exists(), "nothing is written");
}

#[cfg(not(feature = "rug"))]
#[test]
fn precision_without_the_feature() {
    let at = scratch("precision", &["shapes.md"]);
    insta::assert_snapshot!("precision", run(&["verify", "shapes.md", "--precision", "256"], &at).text);
}

#[test]
fn a_file_stands_where_the_report_should_go() {
    let at = scratch("file", &["shapes.md"]);
    std::fs::write(at.join("out"), "mine").unwrap();
    insta::assert_snapshot!("out_is_a_file", run(&["verify", "shapes.md"], &at).text);
    assert_eq!(std::fs::read_to_string(at.join("out")).unwrap(), "mine");
}

/// A directory in the place of report.html cannot be written to, even by root.
#[test]
fn an_older_report_is_left_alone() {
    let at = scratch("older", &["shapes.md"]);
    let out = at.join("out");
    std::fs::create_dir_all(out.join("report.html")).unwrap();
    std::fs::write(out.join("report.json"), "older").unwrap();
    insta::assert_snapshot!("out_not_writable", run(&["verify", "shapes.md"], &at).text);
    assert_eq!(std::fs::read_to_string(out.join("report.json")).unwrap(), "older");
    // The pages of the document have taken their places before the entry could not.
    assert_eq!(std::fs::read_dir(&out).unwrap().count(), 5, "nothing is left lying about");
}

const HEAD: &str =
    "# Notes\n\n<!-- kenzan\n[symbols]\n'a, b' = { range = [0.5, 2.0] }\n-->\n\n$$ a + b = b + a \\tag{1} $$\n\n";

/// Verifies notes that are too large for the repository: their first equation, which is sound, must hold all the same.
fn large(name: &str, rest: &str) -> String {
    let at = scratch(name, &[]);
    std::fs::write(at.join("notes.md"), format!("{HEAD}{rest}")).unwrap();
    let begin = Instant::now();
    let said = run(&["verify", "notes.md"], &at);
    assert!(begin.elapsed() < Duration::from_secs(60), "{:?}", begin.elapsed());
    assert_eq!(said.code, Some(1), "{:.2000}", said.text);
    assert!(said.text.contains("✓ 1 holds"), "{:.2000}", said.text);
    said.text
}

#[test]
fn a_formula_of_ten_megabytes() {
    let formula = format!("$$ a = {}b \\tag{{2}} $$\n", "a + ".repeat(2_500_000));
    insta::assert_snapshot!("long_line", large("long_line", &formula));
}

#[test]
fn a_hundred_thousand_braces() {
    let (open, close) = ("{".repeat(100_000), "}".repeat(100_000));
    insta::assert_snapshot!("braces", large("braces", &format!("$$ a = {open}a{close} \\tag{{2}} $$\n")));
    insta::assert_snapshot!("open_braces", large("open_braces", &format!("$$ a = {open}a \\tag{{2}} $$\n")));
}

#[test]
fn two_thousand_undeclared_symbols() {
    let equations: String = (0..2000).map(|n| format!("$$ a + x_{{{n}}} = 0 \\tag{{{}}} $$\n\n", n + 2)).collect();
    let text = large("undeclared_equations", &equations);
    assert_eq!(text.matches("kenzan::undeclared").count(), 20, "the terminal is not flooded");
    assert!(text.contains("... and 1980 more"), "{:.2000}", text);
    assert!(text.contains("? 2000 undecided") && text.contains("undeclared symbol x_{1999}"));
    let sum: Vec<String> = (0..2000).map(|n| format!("x_{{{n}}}")).collect();
    let text = large("undeclared_sum", &format!("$$ a = {} \\tag{{2}} $$\n", sum.join(" + ")));
    assert!(text.contains("undeclared symbol x_{0}"), "{:.2000}", text);
}
