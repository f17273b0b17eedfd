//! The notes in `tests/examples/`, which are the manual, too: what Kenzan prints for each, and its exit code, stand beside it
//! in `NAME.out`. `UPDATE_EXAMPLES=1 cargo test --test examples` writes them anew; look at the differences then.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/examples")
}

/// The notes, in the order in which the manual shows them.
fn notes() -> Vec<PathBuf> {
    let files = |folder: PathBuf| fs::read_dir(folder).unwrap().map(|e| e.unwrap().path());
    let mut found: Vec<PathBuf> = files(folder()).chain(files(folder().join("walkthrough"))).collect();
    let is_note = |p: &PathBuf| {
        let extension = p.extension().unwrap_or_default();
        p.file_name().unwrap() != "README.md" && ["md", "tex", "qmd"].iter().any(|e| extension == *e)
    };
    found.retain(is_note);
    found.sort();
    found
}

/// What a reader of the manual sees: the command, what it prints, and the exit code.
fn session(note: &Path) -> String {
    let name = note.file_name().unwrap().to_str().unwrap();
    let out = Path::new(env!("CARGO_TARGET_TMPDIR")).join("examples").join(name);
    let run = Command::new(env!("CARGO_BIN_EXE_kenzan"))
        .current_dir(note.parent().unwrap())
        .env("NO_COLOR", "1")
        .env("LC_ALL", "C")
        .args(["verify", name, "--no-times", "--jobs", "1", "--out"])
        .arg(out)
        .output()
        .unwrap();
    let printed = String::from_utf8(run.stdout).unwrap();
    // Certificates are there with arbitrary precision only.
    let passed_over = |l: &&str| !l.starts_with("report: ") && !l.trim_start().starts_with("certified:");
    let summary: Vec<&str> = printed.lines().filter(passed_over).collect();
    let details = String::from_utf8(run.stderr).unwrap();
    let code = run.status.code().unwrap();
    let text =
        format!("$ kenzan verify {name}\n{}\n\n{}\n\nexit code {code}\n", summary.join("\n").trim(), details.trim());
    let lines: Vec<&str> = text.lines().map(str::trim_end).collect();
    lines.join("\n").replace("\n\n\n\n", "\n\n").replace("\n\n\n", "\n\n") + "\n"
}

#[test]
fn every_example_prints_what_the_manual_shows() {
    let mut wrong = Vec::new();
    for note in notes() {
        let expected = note.with_extension("out");
        let found = session(&note);
        if std::env::var_os("UPDATE_EXAMPLES").is_some() {
            fs::write(&expected, found).unwrap();
        } else if fs::read_to_string(&expected).unwrap_or_default() != found {
            wrong.push(format!("{}\n{found}", note.display()));
        }
    }
    assert!(wrong.is_empty(), "not what the manual shows:\n\n{}", wrong.join("\n"));
}

#[test]
fn the_readme_of_the_examples_leads_through_all_of_them() {
    for note in notes() {
        let readme = fs::read_to_string(note.with_file_name("README.md")).unwrap();
        let name = note.file_name().unwrap().to_str().unwrap();
        assert!(readme.contains(&format!("({name})")), "README.md does not mention {name}");
    }
}
