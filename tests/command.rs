//! The command line in a course's repository: kenzan.toml, folders, the bundled notes, completions, the manual page, and
//! what CI is given.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const GOOD: &str = "<!-- kenzan\n[symbols]\n'a, b' = { range = [1, 2] }\n-->\n\n$$ a + b = b + a \\tag{1} $$\n";
const BAD: &str = "<!-- kenzan\n[symbols]\n'a, b' = { range = [1, 2] }\n-->\n\n$$ a + b = b - a \\tag{2} $$\n";

/// A folder of its own with some files in it.
fn folder(name: &str, files: &[(&str, &str)]) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("kenzan-command-{}-{name}", std::process::id()));
    let _ = std::fs::remove_dir_all(&folder);
    for (file, text) in files {
        let path = folder.join(file);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, text).unwrap();
    }
    std::fs::create_dir_all(folder.join(".git")).unwrap();
    folder
}

fn kenzan(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_kenzan"));
    command.args(arguments).current_dir(folder).env("LC_ALL", "C").env("NO_COLOR", "1").output().unwrap()
}

fn out(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned()
}

fn err(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

#[test]
fn kenzan_toml_says_which_files_and_how() {
    let config = "files = ['lectures/*.md']\nexclude = ['lectures/draft*']\nseed = 7\nout = 'report'\nformat = 'json'\ntimes = false\n";
    let files = [("kenzan.toml", config), ("lectures/a.md", GOOD), ("lectures/draft.md", BAD), ("other/b.md", BAD)];
    let root = folder("config", &files);
    let run = kenzan(&root.join("lectures"), &["verify"]);
    assert_eq!(run.status.code(), Some(0), "{}", err(&run));
    let report: serde_json::Value = serde_json::from_str(&out(&run)).unwrap();
    assert_eq!((report["seed"].as_u64(), report["documents"].as_array().unwrap().len()), (Some(7), 1));
    assert!(root.join("report/report.html").is_file(), "next to kenzan.toml");
    let run = kenzan(&root, &["verify", "--seed", "3", "other", "--out", "elsewhere"]);
    assert_eq!(run.status.code(), Some(1), "the command line says another folder: {}", err(&run));
    let report: serde_json::Value = serde_json::from_str(&out(&run)).unwrap();
    assert_eq!((report["seed"].as_u64(), report["states"].as_u64()), (Some(3), Some(64)));
    assert_eq!(report["documents"][0]["path"].as_str().map(|p| p.replace('\\', "/")).as_deref(), Some("other/b.md"));
}

#[test]
fn a_wrong_kenzan_toml_is_told_with_its_place() {
    let root = folder("wrong", &[("kenzan.toml", "files = ['*.md']\nformat = 'yaml'\n"), ("a.md", GOOD)]);
    let run = kenzan(&root, &["verify"]);
    assert_eq!(run.status.code(), Some(2));
    let told = err(&run);
    assert!(told.contains("expected one of human, json, junit, sarif, github") && told.contains("`yaml`"), "{told}");
    assert!(told.contains("kenzan.toml:2:10"), "{told}");
    assert_eq!(kenzan(&root, &["verify", "--format", "human"]).status.code(), Some(0), "not asked for, not wrong");
}

#[test]
fn the_bundled_notes_are_in_the_binary() {
    let root = folder("bundled", &[("kenzan.toml", "nonsense\n"), ("notes/gyroscope.md", "$$ 1 = 2 $$\n")]);
    let run = kenzan(&root, &["verify", "--bundled", "--only", "fn-8", "--states", "2"]);
    assert_eq!(run.status.code(), Some(0), "{}{}", out(&run), err(&run));
    assert!(root.join("out/report.html").is_file());
}

#[test]
fn every_command_is_completed_and_in_the_manual() {
    let root = folder("shell", &[]);
    let commands = ["verify", "watch", "lsp", "explain", "stability", "speed", "scene", "schema", "completions", "man"];
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let run = kenzan(&root, &["completions", shell]);
        assert!(run.status.success() && commands.iter().all(|c| out(&run).contains(c)), "{shell}");
    }
    let manual = out(&kenzan(&root, &["man"]));
    assert!(manual.starts_with(".ie") || manual.contains(".TH kenzan"), "{manual:.200}");
    assert!(commands.iter().all(|command| manual.contains(command)), "{manual}");
    assert!(manual.contains("Exit codes"), "{manual}");
    kenzan(&root, &["man", "--out", "man"]);
    let pages = std::fs::read_dir(root.join("man")).unwrap().count();
    assert!(pages > commands.len(), "a page for each: {pages}");
}

#[test]
fn the_hook_and_the_workflow_call_what_there_is() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let yaml = |path: &str| {
        let text = std::fs::read_to_string(root.join(path)).unwrap();
        serde_yaml_ng::from_str::<serde_json::Value>(&text).unwrap()
    };
    let hooks = yaml(".pre-commit-hooks.yaml");
    let hook = &hooks[0];
    assert_eq!((hook["id"].as_str(), hook["language"].as_str()), (Some("kenzan"), Some("rust")));
    let files = regex_lite::Regex::new(hook["files"].as_str().unwrap()).unwrap();
    assert!(files.is_match("notes/a.md") && files.is_match("b.tex") && !files.is_match("c.txt"));
    let entry: Vec<&str> = hook["entry"].as_str().unwrap().split_whitespace().skip(1).collect();
    let folder = folder("hook", &[("a.md", GOOD), ("b.md", BAD), ("README.md", "no equation\n")]);
    let run = |files: &[&str]| kenzan(&folder, &[entry.as_slice(), files].concat());
    assert_eq!(run(&["a.md"]).status.code(), Some(0));
    assert_eq!(run(&["a.md", "b.md"]).status.code(), Some(1));
    let with_readme = run(&["a.md", "README.md"]);
    assert_eq!(with_readme.status.code(), Some(0), "a hook is given all Markdown: {}", err(&with_readme));
    let workflow = yaml("notes/ci/github.yml");
    let steps = workflow["jobs"]["kenzan"]["steps"].as_array().unwrap();
    let calls = steps.iter().filter_map(|step| step["run"].as_str()).any(|run| run.contains("kenzan verify"));
    assert!(calls, "{workflow:#}");
}

#[test]
fn what_is_excluded_is_neither_verified_nor_hooked_and_a_sidecar_is_that_of_its_notes() {
    let sidecar = "[equation.'2']\nexpect = \"fails\"\n";
    let config = "exclude = [\"old\", \"draft-*\"]\n";
    let files = [("a.md", GOOD), ("b.md", BAD), ("old/c.md", BAD), ("draft-1.md", BAD), ("kenzan.toml", config)];
    let folder = folder("excluded", &files);
    let verified = kenzan(&folder, &["verify", "--format", "json"]);
    let report: serde_json::Value = serde_json::from_str(&out(&verified)).unwrap();
    let paths: Vec<&str> = report["documents"].as_array().unwrap().iter().filter_map(|d| d["path"].as_str()).collect();
    assert_eq!(paths, ["a.md", "b.md"], "as other programs name them, without `./`");
    let hooked = kenzan(&folder, &["verify", "--hook", "a.md", "draft-1.md", "old/c.md"]);
    assert_eq!(hooked.status.code(), Some(0), "{}", err(&hooked));
    assert_eq!(kenzan(&folder, &["verify", "draft-1.md"]).status.code(), Some(1), "who names it means it");
    assert_eq!(kenzan(&folder, &["verify", "--hook", "b.kenzan.toml"]).status.code(), Some(1), "its notes fail");
    std::fs::write(folder.join("b.kenzan.toml"), sidecar).unwrap();
    assert_eq!(kenzan(&folder, &["verify", "--hook", "b.kenzan.toml"]).status.code(), Some(0), "as is expected now");
}

#[test]
fn who_gets_the_bundled_notes_without_asking_is_told() {
    let folder = folder("unasked", &[]);
    let told = |arguments: &[&str]| err(&kenzan(&folder, arguments)).contains("these are the bundled notes");
    assert!(told(&["verify", "--only", "56"]));
    assert!(!told(&["verify", "--only", "56", "--bundled"]));
}
