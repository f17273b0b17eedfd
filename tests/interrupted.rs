//! A run that is killed leaves a whole report: the new one or the one before.

#![cfg(unix)]
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
#![allow(missing_docs)]

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

const NOTES: &str = "# Notes\n\n<!-- kenzan\n[symbols]\n'a, b' = { range = [0.5, 2.0] }\n-->\n\n";

/// Notes large enough that writing the report takes a while.
fn notes() -> PathBuf {
    let at = Path::new(env!("CARGO_TARGET_TMPDIR")).join("interrupted");
    let _ = std::fs::remove_dir_all(&at);
    std::fs::create_dir_all(&at).unwrap();
    let equations: String = (1..200).map(|n| format!("$$ a + {n} b = {n} b + a \\tag{{{n}}} $$\n\n")).collect();
    std::fs::write(at.join("notes.md"), format!("{NOTES}{equations}")).unwrap();
    at
}

fn start(at: &Path, seed: u64) -> std::process::Child {
    let mut command = Command::new(env!("CARGO_BIN_EXE_kenzan"));
    command.current_dir(at).args(["verify", "notes.md", "--states", "8", "--seed", &seed.to_string(), "--lang", "en"]);
    command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap()
}

/// The seeds of the runs that wrote the page and the data, which must be whole.
fn seeds(at: &Path) -> (u64, u64) {
    let page = std::fs::read_to_string(at.join("out/report.html")).unwrap();
    assert!(page.starts_with("<!doctype html>") && page.ends_with("</html>\n"), "the page is whole");
    let (_, rest) = page.split_once(", seed ").unwrap();
    let digits: String = rest.chars().take_while(char::is_ascii_digit).collect();
    let data: serde_json::Value = serde_json::from_slice(&std::fs::read(at.join("out/report.json")).unwrap()).unwrap();
    assert_eq!(data["documents"][0]["equations"].as_array().unwrap().len(), 199);
    (digits.parse().unwrap(), data["seed"].as_u64().unwrap())
}

/// A source of delays that needs no clock.
fn random(state: &mut u64) -> u64 {
    *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    *state >> 33
}

#[test]
fn a_killed_run_leaves_a_whole_report() {
    let at = notes();
    let begin = Instant::now();
    assert_eq!(start(&at, 1).wait().unwrap().code(), Some(0));
    let whole = begin.elapsed();
    let (mut state, mut killed, mut apart, mut replaced) = (7, 0, 0, 0);
    for seed in 2..62 {
        let before = seeds(&at);
        let mut child = start(&at, seed);
        // Half of the kills come in the last tenth of a run, where the files are written.
        let part = random(&mut state) % 1000;
        let part = if seed % 2 == 0 { part } else { 900 + part / 5 };
        std::thread::sleep(Duration::from_micros(whole.as_micros() as u64 * part / 1000));
        child.kill().unwrap();
        killed += u32::from(!child.wait().unwrap().success());
        let (page, data) = seeds(&at);
        assert!([before.0, seed].contains(&page) && [before.1, seed].contains(&data), "seed {seed}: {page}, {data}");
        // Only a kill between the two renames leaves them apart, the page the newer.
        apart += u32::from(page != data);
        replaced += u32::from(page == seed);
    }
    println!("{killed} of 60 runs killed, {replaced} had written, {apart} left page and data of different runs");
    assert!(killed >= 20, "{killed} of 60 runs were killed: the machine is too fast for this test");
    // The next run mends everything.
    assert_eq!(start(&at, 99).wait().unwrap().code(), Some(0));
    assert_eq!(seeds(&at), (99, 99));
}

#[test]
fn what_killed_runs_left_is_removed_in_time() {
    let at = Path::new(env!("CARGO_TARGET_TMPDIR")).join("stale");
    let _ = std::fs::remove_dir_all(&at);
    std::fs::create_dir_all(at.join("out")).unwrap();
    std::fs::write(at.join("notes.md"), format!("{NOTES}$$ a = a + 0 \\tag{{1}} $$\n")).unwrap();
    let file = |name: &str, age: u64| {
        let file = std::fs::File::create(at.join("out").join(name)).unwrap();
        file.set_modified(std::time::SystemTime::now() - Duration::from_secs(age)).unwrap();
    };
    file("report.html.123.tmp", 7200);
    file("report.json.124.tmp", 10);
    file("mine.tmp", 7200);
    assert_eq!(start(&at, 1).wait().unwrap().code(), Some(0));
    let names = std::fs::read_dir(at.join("out")).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap());
    let mut names: Vec<String> = names.collect();
    names.sort();
    assert_eq!(
        names,
        [
            "mine.tmp",
            "notes-errata.html",
            "notes-map.html",
            "notes.html",
            "report.html",
            "report.json",
            "report.json.124.tmp"
        ]
    );
}
