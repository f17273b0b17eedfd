//! `kenzan watch`, driven as an author and a browser do.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::Duration;

const NOTES: &str = "# Notes\n\n<!-- kenzan\n[symbols]\n'a, b' = { range = [1, 2] }\n-->\n\n\
    $$ a + b = b + a \\tag{1} $$\n\n$$ (a + b)^2 = a^2 + 2 a b + b^2 \\tag{2} $$\n";

/// What is waited for comes within this, or not at all.
const LONG: Duration = Duration::from_secs(60);

struct Watch {
    process: Child,
    lines: Receiver<String>,
    port: u16,
    notes: PathBuf,
}

impl Drop for Watch {
    fn drop(&mut self) {
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

impl Watch {
    fn start(name: &str) -> Watch {
        Watch::begin(name, &["notes.md"])
    }

    fn begin(name: &str, watched: &[&str]) -> Watch {
        let folder = std::env::temp_dir().join(format!("kenzan-watch-{}-{name}", std::process::id()));
        std::fs::create_dir_all(folder.join(".git")).unwrap();
        std::fs::write(folder.join("notes.md"), NOTES).unwrap();
        let mut process = Command::new(env!("CARGO_BIN_EXE_kenzan"))
            .args(["watch", "--lang", "en"])
            .args(watched)
            .current_dir(&folder)
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let output = BufReader::new(process.stdout.take().unwrap());
        let (send, lines) = channel();
        std::thread::spawn(move || output.lines().map_while(Result::ok).try_for_each(|line| send.send(line)));
        let mut watch = Watch { process, lines, port: 0, notes: folder.join("notes.md") };
        let first = watch.line();
        assert!(first.starts_with("notes.md: 2 hold, all as expected; 2 judged in "), "{first}");
        let address = watch.line();
        let port = address.strip_prefix("report: http://127.0.0.1:").unwrap().split('/').next().unwrap();
        watch.port = port.parse().unwrap();
        watch
    }

    fn line(&self) -> String {
        self.lines.recv_timeout(LONG).expect("a line within a minute")
    }

    fn save(&self, text: &str) {
        std::fs::write(&self.notes, text).unwrap();
    }

    fn page(&self, path: &str) -> (u16, String, String) {
        get(self.port, path, &format!("127.0.0.1:{}", self.port))
    }
}

/// The status, the headers and the body of an answer.
fn get(port: u16, path: &str, host: &str) -> (u16, String, String) {
    let mut stream = TcpStream::connect(("127.0.0.1", port)).unwrap();
    stream.set_read_timeout(Some(LONG)).unwrap();
    write!(stream, "GET {path} HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\n\r\n").unwrap();
    let mut answer = String::new();
    stream.read_to_string(&mut answer).unwrap();
    let (head, body) = answer.split_once("\r\n\r\n").unwrap();
    (head.split(' ').nth(1).unwrap().parse().unwrap(), head.to_lowercase(), body.to_owned())
}

#[test]
fn what_is_saved_is_judged_and_told() {
    let watch = Watch::start("saved");
    watch.save(&NOTES.replace("2 a b", "3 a b"));
    let line = watch.line();
    assert!(line.starts_with("notes.md: 1 hold, 1 fail, 1 not as expected; (2) holds → fails; 1 judged in "), "{line}");
    let (status, _, data) = watch.page("/report.json");
    let report: serde_json::Value = serde_json::from_str(&data).unwrap();
    assert_eq!((status, report["documents"][0]["equations"][1]["verdict"].as_str()), (200, Some("fails")));
    watch.save("\u{0}");
    let line = watch.line();
    assert!(line.contains("holds no displayed equation") && line.contains("what was there before"), "{line}");
    watch.save(NOTES);
    let line = watch.line();
    assert!(line.contains("2 hold, all as expected; (2) fails → holds; 0 judged in "), "it is remembered: {line}");
}

#[test]
fn options_change_with_kenzan_toml() {
    let watch = Watch::start("options");
    std::fs::write(watch.notes.with_file_name("kenzan.toml"), "states = 0\n").unwrap();
    let mut told = watch.line();
    while !told.contains("expected a number from 1 to 1000000") {
        told = watch.line();
    }
    std::fs::write(watch.notes.with_file_name("kenzan.toml"), "seed = 5\n").unwrap();
    while !told.starts_with("notes.md: 2 hold, all as expected; 2 judged in ") {
        told = watch.line();
    }
    let report: serde_json::Value = serde_json::from_str(&watch.page("/report.json").2).unwrap();
    assert_eq!(report["seed"].as_u64(), Some(5));
}

#[test]
fn the_report_and_nothing_else_is_served_to_this_computer() {
    let watch = Watch::start("served");
    let (status, head, shell) = watch.page("/");
    assert_eq!(status, 200);
    assert!(head.contains("script-src 'self'") && !head.contains("unsafe") && shell.contains("watch.js"), "{head}");
    let (status, head, page) = watch.page("/report.html");
    assert!(status == 200 && page.contains("</html>") && head.contains("frame-ancestors 'self'"), "{head}");
    assert!(!page.contains("watch.js"), "the report's page has no more script than the file");
    assert_eq!(get(watch.port, "/report.html", &format!("localhost:{}", watch.port)).0, 200);
    for host in ["evil.example", "127.0.0.1", "127.0.0.1:1", ""] {
        assert_eq!(get(watch.port, "/report.html", host).0, 403, "{host}");
    }
    for path in ["/notes.md", "/../notes.md", "/%2e%2e/notes.md", "//etc/passwd", "/.git", "/kenzan.toml"] {
        assert_eq!(watch.page(path).0, 404, "{path}");
    }
}

#[test]
fn the_page_is_told_when_there_is_news() {
    let watch = Watch::start("news");
    let number = |body: &str| serde_json::from_str::<serde_json::Value>(body).unwrap()["number"].as_u64().unwrap();
    assert_eq!(number(&watch.page("/changed?after=0").2), 1, "at once, where something is new");
    std::thread::scope(|scope| {
        let port = watch.port;
        let waiting = scope.spawn(move || get(port, "/changed?after=1", &format!("127.0.0.1:{port}")).2);
        std::thread::sleep(Duration::from_millis(200));
        assert!(!waiting.is_finished(), "nothing is new");
        std::fs::write(&watch.notes, NOTES.replace("b + a", "b + b")).unwrap();
        let body = waiting.join().unwrap();
        assert_eq!(number(&body), 2);
        assert!(body.contains("(1) holds → fails"), "{body}");
    });
}

#[test]
fn notes_that_were_missed_are_told_to_be_back_though_nothing_changed() {
    let watch = Watch::start("missed");
    std::fs::remove_file(&watch.notes).unwrap();
    let line = watch.line();
    assert!(line.starts_with("there is no file `notes.md`; the report shows what was there before"), "{line}");
    watch.save(NOTES);
    let mut line = watch.line();
    while line.starts_with("there is no file") {
        line = watch.line();
    }
    assert!(line.starts_with("notes.md: 2 hold, all as expected; 0 judged in "), "{line}");
}

#[test]
fn notes_that_leave_a_folder_leave_the_report() {
    let watch = Watch::begin("folder", &["."]);
    std::fs::write(watch.notes.with_file_name("more.md"), NOTES).unwrap();
    let mut line = watch.line();
    while !line.contains("more.md: 2 hold") {
        line = watch.line();
    }
    std::fs::remove_file(watch.notes.with_file_name("more.md")).unwrap();
    while !line.contains("more.md is gone") {
        line = watch.line();
    }
    let report: serde_json::Value = serde_json::from_str(&watch.page("/report.json").2).unwrap();
    assert_eq!(report["documents"].as_array().unwrap().len(), 1);
}

#[test]
fn what_never_was_is_not_watched() {
    let output = Command::new(env!("CARGO_BIN_EXE_kenzan")).args(["watch", "no-such-notes.md"]).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(said.contains("there is no file `no-such-notes.md`"), "{said}");
}
