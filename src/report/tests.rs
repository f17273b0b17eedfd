use super::*;

const UNTIMED: Options = Options { times: false };

#[test]
fn html_snapshot() {
    insta::assert_snapshot!(html::render(&fixture::run(), UNTIMED).unwrap());
}

#[test]
fn json_snapshot() {
    insta::assert_snapshot!(json::render(&fixture::run(), UNTIMED).unwrap());
}

#[test]
fn terminal_snapshot() {
    insta::assert_snapshot!(terminal::render(&fixture::run(), false, UNTIMED));
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

#[test]
fn reports_replace_older_ones_and_leave_nothing_beside() {
    let out = std::env::temp_dir().join(format!("kenzan-report-{}", std::process::id())).join("deep");
    let mut run = fixture::run();
    for seed in [1, 2] {
        run.seed = seed;
        let written = write(&run, &out).unwrap();
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
    let error = write(&fixture::run(), &file).unwrap_err();
    std::fs::remove_file(&file).unwrap();
    assert!(matches!(&error, ReportError::Directory { path, .. } if *path == file), "{error}");
}
