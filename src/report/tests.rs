use super::*;

const UNTIMED: Options = Options { times: false };

/// A new version of Kenzan is no new report.
fn unversioned(report: &str) -> String {
    report.replace(env!("CARGO_PKG_VERSION"), "[version]")
}

#[test]
fn html_snapshot() {
    let page = html::render(&fixture::run(), UNTIMED).unwrap();
    // The style sheet has its own file.
    let (before, rest) = page.split_once("<style>").unwrap();
    let (_, after) = rest.split_once("</style>").unwrap();
    insta::assert_snapshot!(unversioned(&format!("{before}{after}")));
}

#[test]
fn json_snapshot() {
    insta::assert_snapshot!(unversioned(&json::render(&fixture::run(), UNTIMED).unwrap()));
}

#[test]
fn terminal_snapshot() {
    insta::assert_snapshot!(terminal::render(&fixture::run(), false, UNTIMED));
}

#[test]
fn junit_snapshot() {
    insta::assert_snapshot!(annotations::junit(&fixture::run(), false).unwrap());
}

#[test]
fn sarif_snapshot() {
    insta::assert_snapshot!(unversioned(&annotations::sarif(&fixture::run()).unwrap()));
}

#[test]
fn github_snapshot() {
    insta::assert_snapshot!(annotations::github(&fixture::run()));
}

#[test]
fn notes_cannot_add_commands_to_a_workflow() {
    let mut run = fixture::run();
    run.documents[0].path = "a,line=1::x\n::error::b.md".into();
    run.documents[0].equations.iter_mut().for_each(|e| e.as_expected = false);
    run.documents[0].equations[0].label = "1\n::error::c".into();
    run.documents.truncate(1);
    let text = annotations::github(&run);
    assert_eq!(text.lines().count(), run.documents[0].equations.len() + run.documents[0].problems.len());
    let start = "::error file=a%2Cline=1%3A%3Ax%0A%3A%3Aerror%3A%3Ab.md";
    assert!(text.lines().all(|line| line.starts_with(start)), "{text}");
}

#[test]
fn the_terminal_has_colour_only_where_asked_for() {
    let run = fixture::run();
    assert!(terminal::render(&run, true, UNTIMED).contains("\x1b[1;31m✗ (56)\x1b[0m"));
    assert!(!terminal::render(&run, false, UNTIMED).contains('\x1b'));
}

#[test]
fn notes_cannot_steer_the_terminal() {
    let mut run = fixture::run();
    run.documents[0].title = "a\x1b[2Jb".into();
    run.documents[0].equations[3].reason = Some("c\x1b]0;d\u{7}".into());
    assert!(!terminal::render(&run, false, UNTIMED).contains(|c: char| c.is_control() && c != '\n'));
}

/// What differs between two runs of different duration differs only where times are printed.
#[test]
fn without_times_the_same_run_gives_the_same_bytes() {
    let (run, mut slower) = (fixture::run(), fixture::run());
    slower.micros *= 7;
    slower.documents[0].equations.iter_mut().for_each(|e| e.micros *= 3);
    assert_eq!(html::render(&run, UNTIMED).unwrap(), html::render(&slower, UNTIMED).unwrap());
    assert_eq!(json::render(&run, UNTIMED).unwrap(), json::render(&slower, UNTIMED).unwrap());
    assert_eq!(terminal::render(&run, true, UNTIMED), terminal::render(&slower, true, UNTIMED));
    let timed = html::render(&run, Options::default()).unwrap();
    assert!(timed.contains("118 µs") && timed.contains("31.4 ms"));
    assert_ne!(timed, html::render(&slower, Options::default()).unwrap());
    assert!(json::render(&run, Options::default()).unwrap().contains("\"micros\": 118"));
}

/// Every anchor that is linked to exists, and none exists twice.
#[test]
fn anchors_lead_somewhere() {
    let mut run = fixture::run();
    // The same document again, and two equations of one label.
    run.documents.push(run.documents[0].clone());
    let twin = run.documents[0].equations[1].clone();
    run.documents[0].equations.push(twin);
    let page = html::render(&run, UNTIMED).unwrap();
    let values = |key: &str| -> Vec<String> {
        page.split(key).skip(1).filter_map(|rest| Some(rest.split_once('"')?.0.to_owned())).collect()
    };
    let ids = values(" id=\"");
    let unique: std::collections::HashSet<_> = ids.iter().collect();
    assert_eq!(ids.len(), unique.len());
    let targets = values("href=\"#");
    assert!(targets.len() > 40);
    for target in targets.iter().chain(&values("aria-labelledby=\"")) {
        assert!(unique.contains(target), "nothing has the anchor {target}");
    }
}

#[test]
fn the_page_needs_nothing_else() {
    let page = html::render(&fixture::run(), UNTIMED).unwrap();
    for outside in ["<script", "<link", "<img", "@import", "url(", "http:"] {
        assert!(!page.contains(outside), "{outside}");
    }
    assert!(page.contains("gyroscope-56") && page.contains("class=\"changed\""));
    assert!(page.contains("回転 &lt;rotation&gt;"));
}

/// Every text of a run may come from notes that nobody trusts.
#[test]
fn hostile_notes_stay_text() {
    let hostile = "\"><script>alert('x')</script>{{ 7 * 7 }}</style>";
    let mut run = fixture::run();
    let document = &mut run.documents[0];
    for text in [&mut document.name, &mut document.path, &mut document.title] {
        *text = hostile.into();
    }
    document.problems = vec![hostile.into()];
    for judgement in &mut document.equations {
        for text in [&mut judgement.label, &mut judgement.section, &mut judgement.latex, &mut judgement.kind] {
            *text = hostile.into();
        }
        judgement.because = Some(hostile.into());
        judgement.reason = Some(hostile.into());
        judgement.reading = Some(hostile.into());
        judgement.given = vec![hostile.into()];
        judgement.assumptions = vec![hostile.into()];
        for link in &mut judgement.links {
            link.latex = hostile.into();
        }
        if let Some(counterexample) = &mut judgement.counterexample {
            counterexample.lhs = hostile.into();
            counterexample.component = Some(hostile.into());
            counterexample.state[0].symbol = hostile.into();
            counterexample.state[0].value = hostile.into();
        }
        if let Some(correction) = &mut judgement.correction {
            correction.latex = hostile.into();
        }
    }
    let page = html::render(&run, UNTIMED).unwrap();
    assert!(!page.contains("<script") && !page.contains("49"));
    assert_eq!(page.matches("</style>").count(), 1);
    let quoted = |tag: &str| tag.matches('"').count().is_multiple_of(2);
    assert!(page.split('<').skip(1).all(|rest| rest.split_once('>').is_some_and(|(tag, _)| quoted(tag))));
}

#[test]
fn reports_replace_older_ones_and_leave_nothing_beside() {
    let out = std::env::temp_dir().join(format!("kenzan-report-{}", std::process::id())).join("deep");
    let mut run = fixture::run();
    for seed in [1, 2] {
        run.seed = seed;
        let written = write(&run, &out, Options::default()).unwrap();
        let json: serde_json::Value = serde_json::from_str(&std::fs::read_to_string(written.json).unwrap()).unwrap();
        assert_eq!(json["seed"], seed);
        assert!(std::fs::read_to_string(written.html).unwrap().contains(&format!("seed {seed}")));
    }
    assert_eq!(std::fs::read_dir(&out).unwrap().count(), 2);
    std::fs::remove_dir_all(out.parent().unwrap()).unwrap();
}

#[test]
fn a_directory_that_cannot_be_is_an_error_with_its_path() {
    let file = std::env::temp_dir().join(format!("kenzan-file-{}", std::process::id()));
    std::fs::write(&file, "").unwrap();
    let error = write(&fixture::run(), &file, Options::default()).unwrap_err();
    std::fs::remove_file(&file).unwrap();
    assert!(matches!(&error, ReportError::Directory { path, .. } if *path == file), "{error}");
}
