//! The server of the report: a page that shows the report in a frame and loads it anew when it changes.
//!
//! Promises: it listens on this computer alone, and answers only who asks for this computer by name, so that no page from
//! elsewhere reads the notes through a name of its own; it serves the pages and the data of the report by their names,
//! from memory, and no file. The pages are those that `verify` writes, with their own policies, and hold no more script
//! than these.

use std::collections::HashMap;
use std::io::Cursor;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use tiny_http::{Header, Method, Request, Response};

use crate::report::{self, Run, html, json};

use super::WatchError;

const SHELL: &str = include_str!("../../templates/watch.html");
const SCRIPT: &str = include_str!("../../templates/watch.js");
const STYLE: &str = include_str!("../../templates/watch.css");

/// What the page around the report may do.
const SHELL_POLICY: &str = "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; frame-src 'self'; \
    base-uri 'none'; form-action 'none'; frame-ancestors 'none'";
/// The report's pages say themselves what they may do.
const PAGE_POLICY: &str = "frame-ancestors 'self'";

/// How long the question whether something changed is kept waiting.
const PATIENCE: Duration = Duration::from_secs(25);
/// How many may wait at the same time.
const MOST_WAITING: usize = 16;
/// Formulas in the report may be deep.
const STACK: usize = 32 << 20;

/// The latest report, and who waits for the next.
#[derive(Default)]
pub struct Board {
    latest: Mutex<Latest>,
    news: Condvar,
}

#[derive(Default)]
struct Latest {
    /// Rises with each report.
    number: u64,
    status: String,
    run: Option<(Arc<Run>, report::Options)>,
    /// The report's files by their names, once somebody has asked for one.
    files: Option<Arc<HashMap<String, String>>>,
}

impl Board {
    /// Puts up a report.
    pub fn put(&self, run: Run, options: report::Options, status: &str) {
        let mut latest = self.lock();
        latest.number += 1;
        latest.run = Some((Arc::new(run), options));
        latest.files = None;
        status.clone_into(&mut latest.status);
        self.news.notify_all();
    }

    fn lock(&self) -> MutexGuard<'_, Latest> {
        self.latest.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// A file of the report.
    fn file(&self, name: &str) -> Option<String> {
        let (number, run, files) = {
            let latest = self.lock();
            (latest.number, latest.run.clone(), latest.files.clone())
        };
        let files = match (files, run) {
            (Some(files), _) => files,
            (None, Some((run, options))) => Arc::new(rendered(&run, options)),
            (None, None) => return None,
        };
        let mut latest = self.lock();
        if latest.number == number {
            latest.files = Some(Arc::clone(&files));
        }
        files.get(name).cloned()
    }

    /// Waits until there is another report than one of this number, or for a while: its number and what to say of it.
    fn after(&self, number: u64) -> String {
        let latest = self.news.wait_timeout_while(self.lock(), PATIENCE, |latest| latest.number == number);
        let (latest, _) = latest.unwrap_or_else(PoisonError::into_inner);
        serde_json::json!({ "number": latest.number, "status": latest.status }).to_string()
    }
}

/// The pages and the data. Where one cannot be made it says so.
fn rendered(run: &Run, options: report::Options) -> HashMap<String, String> {
    let mut files: HashMap<String, String> = match html::pages(run, options) {
        Ok(pages) => pages.into_iter().map(|page| (page.file, page.html)).collect(),
        Err(error) => HashMap::from([("report.html".into(), format!("<!doctype html><p>{error}"))]),
    };
    files.extend(json::render(run, options).ok().map(|data| ("report.json".to_owned(), data)));
    files
}

/// A server that has started.
pub struct Server {
    port: u16,
}

impl Server {
    /// Starts to serve what is on the board, on a port of this computer; 0 for a free one.
    pub fn start(port: u16, board: Arc<Board>) -> Result<Self, WatchError> {
        let failed = |reason: String| WatchError::Port { port, reason };
        let server = tiny_http::Server::http(("127.0.0.1", port)).map_err(|e| failed(e.to_string()))?;
        let taken = server.server_addr().to_ip().map_or(port, |address| address.port());
        let serve = move || {
            let waiting = Arc::new(AtomicUsize::new(0));
            for request in server.incoming_requests() {
                answer(request, taken, &board, &waiting);
            }
        };
        let thread = std::thread::Builder::new().name("report".into()).stack_size(STACK);
        thread.spawn(serve).map_err(|e| failed(e.to_string()))?;
        Ok(Server { port: taken })
    }

    /// Where it is.
    pub fn address(&self) -> String {
        format!("http://127.0.0.1:{}/", self.port)
    }
}

fn answer(request: Request, port: u16, board: &Arc<Board>, waiting: &Arc<AtomicUsize>) {
    let host = request.headers().iter().find(|h| h.field.equiv("Host")).map(|h| h.value.as_str().to_owned());
    let ours = [format!("127.0.0.1:{port}"), format!("localhost:{port}")];
    if !host.is_some_and(|host| ours.contains(&host)) {
        return respond(request, 403, "text/plain", "this server is for this computer alone\n", "");
    }
    if !matches!(request.method(), Method::Get | Method::Head) {
        return respond(request, 405, "text/plain", "only GET\n", "");
    }
    let url = request.url().to_owned();
    let (path, query) = url.split_once('?').unwrap_or((&url, ""));
    match path {
        "/" => respond(request, 200, "text/html", SHELL, SHELL_POLICY),
        "/watch.js" => respond(request, 200, "text/javascript", SCRIPT, SHELL_POLICY),
        "/watch.css" => respond(request, 200, "text/css", STYLE, SHELL_POLICY),
        "/changed" => wait(request, query, board, waiting),
        _ => match board.file(path.trim_start_matches('/')) {
            Some(file) => {
                let kind = if path.ends_with(".json") { "application/json" } else { "text/html" };
                respond(request, 200, kind, &file, PAGE_POLICY);
            }
            None => respond(request, 404, "text/plain", "the report has no such page\n", ""),
        },
    }
}

/// Answers when there is something new.
fn wait(request: Request, query: &str, board: &Arc<Board>, waiting: &Arc<AtomicUsize>) {
    let number = query.strip_prefix("after=").and_then(|n| n.parse().ok()).unwrap_or(0);
    if waiting.fetch_add(1, Ordering::SeqCst) >= MOST_WAITING {
        waiting.fetch_sub(1, Ordering::SeqCst);
        return respond(request, 503, "text/plain", "too many pages are waiting\n", "");
    }
    let (board, done) = (Arc::clone(board), Arc::clone(waiting));
    let answer = move || {
        respond(request, 200, "application/json", &board.after(number), "");
        done.fetch_sub(1, Ordering::SeqCst);
    };
    // Where no thread can be had the request is dropped, and the page asks again.
    if std::thread::Builder::new().name("waiting".into()).spawn(answer).is_err() {
        waiting.fetch_sub(1, Ordering::SeqCst);
    }
}

fn respond(request: Request, status: u16, kind: &str, body: &str, policy: &str) {
    let kind = format!("{kind}; charset=utf-8");
    let headers = [
        ("Content-Type", kind.as_str()),
        ("Content-Security-Policy", policy),
        ("Cache-Control", "no-store"),
        ("X-Content-Type-Options", "nosniff"),
        ("Referrer-Policy", "no-referrer"),
        ("Cross-Origin-Resource-Policy", "same-origin"),
    ];
    let headers = headers.iter().filter(|(_, value)| !value.is_empty());
    let headers = headers.filter_map(|(name, value)| Header::from_bytes(name.as_bytes(), value.as_bytes()).ok());
    let body = Cursor::new(body.as_bytes().to_vec());
    let length = body.get_ref().len();
    let response = Response::new(status.into(), headers.collect(), body, Some(length), None);
    // Who has gone away needs no answer.
    let _ = request.respond(response);
}
