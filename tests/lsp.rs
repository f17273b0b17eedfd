//! `kenzan lsp`, driven by the protocol as an editor does.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::io::{BufRead, BufReader, Write};
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::Duration;

use serde_json::{Value, json};

const URI: &str = "file:///kenzan-test/notes.md";
const NOTES: &str = "# 検算\n\n<!-- kenzan\n[symbols]\n'a, b' = { range = [1, 2] }\n-->\n\n\
    $$ \\text{𝜃検} (a + b)^2 = a^2 + b^2 \\tag{1} $$\n<!-- kenzan\nkind = \"derived\"\n-->\n\n\
    $$ a + b = b + a \\tag{2} $$\n<!-- kenzan\ngiven = [\"3\"]\n-->\n\n$$ a = b \\tag{3} $$\n<!-- kenzan\nkind = \"law\"\n-->\n\n$$ a + \\kappa = 2 \\tag{4} $$\n";
/// What is waited for comes within this, or not at all.
const LONG: Duration = Duration::from_secs(60);

struct Editor {
    process: Child,
    input: ChildStdin,
    messages: Receiver<Value>,
    number: i64,
}

impl Drop for Editor {
    fn drop(&mut self) {
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

impl Editor {
    fn start() -> (Editor, Value) {
        let mut process = Command::new(env!("CARGO_BIN_EXE_kenzan"))
            .args(["lsp", "--stdio"])
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let (send, messages) = channel();
        let mut output = BufReader::new(process.stdout.take().unwrap());
        std::thread::spawn(move || {
            while let Some(message) = message(&mut output) {
                if send.send(message).is_err() {
                    break;
                }
            }
        });
        let input = process.stdin.take().unwrap();
        let mut editor = Editor { process, input, messages, number: 0 };
        let told = editor.ask("initialize", json!({ "capabilities": {}, "processId": null, "rootUri": null }));
        editor.tell("initialized", json!({}));
        (editor, told)
    }

    fn send(&mut self, message: &Value) {
        let text = message.to_string();
        write!(self.input, "Content-Length: {}\r\n\r\n{text}", text.len()).unwrap();
        self.input.flush().unwrap();
    }

    fn tell(&mut self, method: &str, params: Value) {
        self.send(&json!({ "jsonrpc": "2.0", "method": method, "params": params }));
    }

    fn ask(&mut self, method: &str, params: Value) -> Value {
        self.number += 1;
        let number = self.number;
        self.send(&json!({ "jsonrpc": "2.0", "id": number, "method": method, "params": params }));
        self.until(|message| message["id"] == number && message.get("method").is_none())["result"].clone()
    }

    fn until(&self, is_it: impl Fn(&Value) -> bool) -> Value {
        loop {
            let message = self.messages.recv_timeout(LONG).expect("an answer within a minute");
            if is_it(&message) {
                return message;
            }
        }
    }

    /// The diagnostics of a version.
    fn diagnostics(&self, version: i64) -> Vec<Value> {
        let published =
            self.until(|m| m["method"] == "textDocument/publishDiagnostics" && m["params"]["version"] == version);
        assert_eq!(published["params"]["uri"], URI);
        published["params"]["diagnostics"].as_array().unwrap().clone()
    }

    fn open(&mut self, text: &str) -> Vec<Value> {
        let document = json!({ "uri": URI, "languageId": "markdown", "version": 1, "text": text });
        self.tell("textDocument/didOpen", json!({ "textDocument": document }));
        self.diagnostics(1)
    }

    fn change(&mut self, version: i64, changes: Value) {
        let document = json!({ "uri": URI, "version": version });
        self.tell("textDocument/didChange", json!({ "textDocument": document, "contentChanges": changes }));
    }

    fn at(&mut self, method: &str, line: u64, character: u64) -> Value {
        let place = json!({ "textDocument": { "uri": URI }, "position": { "line": line, "character": character } });
        self.ask(method, place)
    }

    fn actions(&mut self, line: u64) -> Vec<Value> {
        let range = json!({ "start": { "line": line, "character": 4 }, "end": { "line": line, "character": 4 } });
        let params = json!({ "textDocument": { "uri": URI }, "range": range, "context": { "diagnostics": [] } });
        self.ask("textDocument/codeAction", params).as_array().unwrap().clone()
    }
}

fn message(output: &mut impl BufRead) -> Option<Value> {
    let mut length = 0;
    loop {
        let mut line = String::new();
        if output.read_line(&mut line).ok()? == 0 {
            return None;
        }
        if line.trim().is_empty() {
            break;
        }
        length = line.strip_prefix("Content-Length:").map_or(length, |n| n.trim().parse().unwrap());
    }
    let mut text = vec![0; length];
    output.read_exact(&mut text).ok()?;
    serde_json::from_slice(&text).ok()
}

/// The diagnostic with a code, its line, and its first and last column.
fn coded<'d>(diagnostics: &'d [Value], code: &str) -> (&'d Value, [u64; 3]) {
    let found = diagnostics.iter().find(|d| d["code"] == code).unwrap_or_else(|| panic!("{code}: {diagnostics:#?}"));
    let number = |pointer: &str| found.pointer(pointer).unwrap().as_u64().unwrap();
    (found, [number("/range/start/line"), number("/range/start/character"), number("/range/end/character")])
}

#[test]
fn equations_are_judged_as_one_types() {
    let (mut editor, told) = Editor::start();
    assert_eq!(told["serverInfo"]["name"], "kenzan");
    assert_eq!(told["capabilities"]["textDocumentSync"], 2);
    let diagnostics = editor.open(NOTES);

    // The underline is that of the formula, without its label, in units of UTF-16: the letter 𝜃 has two.
    let (fails, place) = coded(&diagnostics, "fails");
    let line = NOTES.lines().nth(7).unwrap();
    let columns = |until: &str| line[..line.find(until).unwrap()].encode_utf16().count() as u64;
    assert_eq!(place, [7, 3, columns(" \\tag")]);
    assert_eq!(fails["severity"], 1);
    assert!(fails["message"].as_str().unwrap().contains("for example"), "{fails}");
    let (undeclared, place) = coded(&diagnostics, "undecided");
    assert_eq!((undeclared["severity"].as_u64(), place), (Some(2), [22, 7, 13]), "{undeclared}");

    let hover = editor.at("textDocument/hover", 7, 20);
    let text = hover["contents"]["value"].as_str().unwrap();
    assert!(text.starts_with("**(1)** fails") && text.contains("counterexample") && text.contains("read as"), "{text}");
    let hover = editor.at("textDocument/hover", 12, 5);
    let text = hover["contents"]["value"].as_str().unwrap();
    assert!(text.contains("**(2)** holds") && text.contains("given (3)"), "{text}");
    assert!(editor.at("textDocument/hover", 0, 0).is_null(), "no equation there");

    let definition = editor.at("textDocument/definition", 14, 10);
    assert_eq!(definition["range"]["start"]["line"], 17, "{definition}");
    let symbols = editor.ask("textDocument/documentSymbol", json!({ "textDocument": { "uri": URI } }));
    let names: Vec<&str> = symbols.as_array().unwrap().iter().map(|s| s["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["検算", "(1)", "(2)", "(3)", "(4)"]);

    // One types `2 a b + ` before `b^2 \tag`.
    let at = columns("b^2 \\tag");
    let place = json!({ "line": 7, "character": at });
    editor.change(2, json!([{ "range": { "start": place, "end": place }, "text": "2 a " }]));
    let place = json!({ "line": 7, "character": at + 4 });
    editor.change(3, json!([{ "range": { "start": place, "end": place }, "text": "b + " }]));
    let diagnostics = editor.diagnostics(3);
    assert!(diagnostics.iter().all(|d| d["code"] != "fails"), "{diagnostics:#?}");

    assert!(editor.ask("shutdown", Value::Null).is_null());
    editor.tell("exit", Value::Null);
    assert!(editor.process.wait().unwrap().success());
}

#[test]
fn a_correction_is_a_quick_fix() {
    let (mut editor, _) = Editor::start();
    let notes =
        NOTES.replace("kind = \"derived\"", "correction = '(a + b)^2 = a^2 + 2 a b + b^2'").replace("\\text{𝜃検} ", "");
    editor.open(&notes);
    let actions = editor.actions(7);
    let fix =
        actions.iter().find(|a| a["title"] == "Print the correction of (1)").unwrap_or_else(|| panic!("{actions:#?}"));
    assert_eq!((fix["kind"].as_str(), fix["isPreferred"].as_bool()), (Some("quickfix"), Some(true)));
    let edit = &fix["edit"]["changes"][URI][0];
    assert_eq!(edit["newText"], "(a + b)^2 = a^2 + 2 a b + b^2");
    editor.change(2, json!([{ "range": edit["range"], "text": edit["newText"] }]));
    let diagnostics = editor.diagnostics(2);
    assert!(diagnostics.iter().all(|d| d["code"] != "fails"), "{diagnostics:#?}");
    assert!(actions.iter().any(|a| a["title"] == "Expect (1) to fail"), "{actions:#?}");
    assert!(editor.actions(12).is_empty(), "nothing is to be mended there");
}

#[test]
fn what_was_meant_is_searched_when_asked_for() {
    let (mut editor, _) = Editor::start();
    editor.open(&NOTES.replace("\\text{𝜃検} ", "").replace("a^2 + b^2", "a^2 - 2 a b + b^2"));
    let actions = editor.actions(7);
    let search = actions.iter().find(|a| a["command"] == "kenzan.suggest").unwrap_or_else(|| panic!("{actions:#?}"));
    let told = editor
        .ask("workspace/executeCommand", json!({ "command": "kenzan.suggest", "arguments": search["arguments"] }));
    assert!(told.as_str().unwrap().contains("see its quick fixes"), "{told}");
    let actions = editor.actions(7);
    let mends = |a: &Value| {
        let text = a["edit"]["changes"][URI][0]["newText"].as_str().unwrap_or_default();
        let text = text.replace([' ', '{', '}'], "");
        text.contains("a^2+2ab+b^2") || text.contains("(a-b)^2")
    };
    assert!(actions.iter().any(mends), "{actions:#?}");
}

#[test]
fn what_an_author_types_in_between_breaks_nothing() {
    let (mut editor, _) = Editor::start();
    editor.open(NOTES);
    for (version, text) in [(2, ""), (3, "$$"), (4, "\u{0}\r\n$$ \\frac{ $$"), (5, "<!-- kenzan\n[[\n-->")] {
        editor.change(version, json!([{ "text": text }]));
        editor.diagnostics(version);
    }
    editor.change(6, json!([{ "text": NOTES }]));
    assert!(!editor.diagnostics(6).is_empty());
    editor.tell("textDocument/didClose", json!({ "textDocument": { "uri": URI } }));
    let cleared = editor.until(|m| m["method"] == "textDocument/publishDiagnostics");
    assert_eq!(cleared["params"]["diagnostics"], json!([]));
}
