//! What `kenzan scene` prints: lists, tables, the model taken and why, and errors in words. In the snapshots measured errors,
//! which hang on the last bits of a library's functions, are masked.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
#![allow(missing_docs)]

use std::process::Command;

/// What a run printed, the errors after the output, and its exit code.
fn run(arguments: &[&str]) -> String {
    let output = Command::new(env!("CARGO_BIN_EXE_kenzan"))
        .arg("scene")
        .args(arguments)
        .envs([("NO_COLOR", "1"), ("LC_ALL", "C.UTF-8"), ("TERM", "xterm")])
        .env_remove("FORCE_COLOR")
        .env_remove("RUST_BACKTRACE")
        .output()
        .unwrap();
    let (stdout, stderr) = (String::from_utf8(output.stdout).unwrap(), String::from_utf8(output.stderr).unwrap());
    assert!(!stderr.contains("panicked"), "{stderr}");
    format!("{stdout}---\n{stderr}exit {:?}\n", output.status.code())
}

/// Masks what is measured.
fn masked(text: &str) -> String {
    let measured = |line: &str| line.contains("error ") || line.contains("error of") || line.contains("measured_error");
    let mask = |word: &str| {
        let number = word.trim_end_matches(',');
        let is_one = number.contains(['.', 'e']) && number.parse::<f64>().is_ok();
        if is_one { word.replace(number, "#") } else { word.to_owned() }
    };
    let words = |line: &str| line.split(' ').map(mask).collect::<Vec<_>>().join(" ");
    text.lines().map(|line| if measured(line) { words(line) } else { line.to_owned() } + "\n").collect()
}

#[test]
fn the_scenes_are_listed() {
    assert!(run(&[]).contains("the heavy symmetric top"));
    insta::assert_snapshot!("top", run(&["top"]));
    insta::assert_snapshot!("free", run(&["free"]));
}

#[test]
fn a_table_with_the_choice() {
    let arguments =
        ["top", "--quantity", "theta,phi", "--until", "1000", "--error", "1e-10", "--points", "5", "--no-times"];
    insta::assert_snapshot!("table", masked(&run(&arguments)));
}

/// What double-double is measured against, and what comes after it, depends on whether there is something stronger.
#[cfg(not(feature = "rug"))]
#[test]
fn the_strongest_numbers_there_are() {
    let arguments = ["free", "-q", "omega_1,q_0", "--step", "2.5", "--error", "1e-20", "--no-times"];
    insta::assert_snapshot!("double", masked(&run(&arguments)));
    insta::assert_snapshot!("steady", with(&["--model", "steady-slow"]));
}

/// A run with parameters of its own.
fn with(more: &[&str]) -> String {
    let arguments =
        ["top", "-q", "theta", "--set", "omega_zeta=30", "--set", "theta_0=45deg", "--points", "3", "--no-times"];
    masked(&run(&[&arguments[..], more].concat()))
}

#[test]
fn a_model_by_name_with_parameters() {
    insta::assert_snapshot!("euler", with(&["--model", "euler"]));
}

#[test]
fn other_formats() {
    let arguments = ["top", "-q", "u", "--until", "2", "--points", "3", "--error", "1e-8", "--no-times"];
    let with = |format: &str| masked(&run(&[&arguments[..], &["--format", format]].concat()));
    insta::assert_snapshot!("json", with("json"));
    insta::assert_snapshot!("csv", with("csv"));
}

#[test]
fn errors_are_sentences() {
    let cases: [(&str, &[&str]); 9] = [
        ("no_scene", &["spoon"]),
        ("no_quantity", &["top", "-q", "thetta"]),
        ("no_model", &["top", "-q", "theta", "--model", "magic"]),
        ("no_parameter", &["top", "-q", "theta", "--set", "mass=1"]),
        ("no_number", &["top", "-q", "theta", "--set", "I_0=heavy"]),
        ("no_top", &["top", "-q", "theta", "--set", "I_0=-1"]),
        ("no_times", &["top", "-q", "theta", "--points", "0"]),
        ("no_error", &["top", "-q", "theta", "--error", "0"]),
        ("no_phi", &["top", "-q", "phi", "--set", "theta_0=0", "--model", "closed"]),
    ];
    for (name, arguments) in cases {
        let said = run(arguments);
        assert!(said.ends_with("exit Some(2)\n"), "{said}");
        insta::assert_snapshot!(name, said);
    }
}

/// Without the feature `rug` there is nothing beyond double-double, and it says so.
#[test]
#[cfg(not(feature = "rug"))]
fn more_digits_than_there_are() {
    insta::assert_snapshot!("out_of_reach", masked(&run(&["top", "-q", "theta", "--error", "1e-40"])));
}

/// The times are what was asked for, to the last one.
#[test]
fn the_times_end_where_they_are_asked_to() {
    let last = |arguments: &[&str]| {
        let text = run(&[&["top", "-q", "theta", "--format", "csv", "--error", "1"], arguments].concat());
        let table = text.split("---").next().unwrap().to_owned();
        (table.lines().count() - 1, table.lines().last().unwrap().split(',').next().unwrap().parse::<f64>().unwrap())
    };
    assert_eq!(last(&["--until", "0.7", "--step", "0.1"]), (8, 0.7));
    assert_eq!(last(&["--until", "0.75", "--step", "0.1"]).0, 8);
    assert_eq!(last(&["--until", "3.3", "--points", "7"]), (7, 3.3));
    assert_eq!(last(&["--until", "0", "--points", "1"]), (1, 0.0));
}
