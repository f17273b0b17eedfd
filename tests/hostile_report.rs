//! Notes cannot put anything into the report that runs, links elsewhere or loads: wherever a note's text is shown, it is
//! text. Seen by an HTML parser, and by a browser where there is one.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
#![allow(missing_docs)]

use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

use kenzan::check::Options;
use kenzan::document;
use kenzan::report::html::Page;
use kenzan::report::{self, Language, Run, html, json};
use kenzan::verify::{self, Request};
use scraper::{Html, Node};

/// What would change the page's title if it ran. None may hold `TITLE`, `'` or a line break: they are put into all kinds
/// of places.
const PAYLOADS: &[&str] = &[
    r#"<script>document.title="owned"</script>"#,
    r#"</script><script>document.title="owned"</script>"#,
    r#""><img src=x onerror="document.title=1">"#,
    r#"</title></style><script>document.title="owned"</script>"#,
    r#"<svg onload="document.title=1"><script>document.title=2</script></svg>"#,
    r#"]]></math></svg><script>document.title="owned"</script>"#,
    r#"</code></pre></li></details><iframe srcdoc="<script>parent.document.title=1</script>"></iframe>"#,
    r#"<a href="javascript:document.title=1">x</a><base href="https://example.org/">"#,
    r#"<math href="javascript:document.title=1"><mtext><style><img src=x onerror=document.title=1></style></mtext></math>"#,
    r#"<form action="https://example.org"><input autofocus onfocus="document.title=1"></form>"#,
    r#"&lt;script&gt;document.title=1&lt;/script&gt;&#60;script>"#,
    r"{{ 7 * 7 }}{% raw %}<script>document.title=1</script>",
    r"\href{javascript:document.title=1}{x}",
    r"\url{javascript:document.title=1}",
    r#"\htmlData{onclick=document.title=1}{x}\htmlStyle{background:url(https://example.org)}{x}"#,
    r#"\htmlId{a" onclick="document.title=1}{x}\htmlClass{"><script>}{x}"#,
    r"\includegraphics[width=1em]{https://example.org/x.png}",
    r#"\text{<script>document.title=1</script>}\color{red" onclick="document.title=1}x"#,
    r#"\textcolor{#c0ffee" onmouseover="document.title=1}{x}\operatorname{<script>}"#,
    r#"$\href{javascript:document.title=1}{x}$ `<script>document.title=1</script>` $<script>$"#,
    "\u{1}\u{7f}\u{85}\u{2028}\u{feff}<script\u{0}>document.title=1</script\u{0}>",
];

/// Notes in which a payload stands wherever the report shows something of notes.
fn notes(payload: &str) -> String {
    let toml = payload.replace('\\', "\\\\").replace('"', "\\\"");
    let toml: String = toml.chars().filter(|c| !c.is_control()).collect();
    format!(
        r#"# Title {payload}

## Section {payload}

<!-- kenzan
assume = ["b = {toml}"]
[symbols]
'a, b' = {{ range = [0.5, 2.0], unit = "m" }}
"{toml}" = {{ unit = "{toml}", of = "{toml}", vector = "{toml}" }}
"a_{{{toml}}}" = {{ same = "{toml}" }}
[basis."{toml}"]
vectors = ["{toml}", "x", "y"]
-->

Prose {payload}

$$ a + b = b + a + {payload} \tag{{{payload}}} $$
<!-- kenzan
because = "{toml}"
given = ["{toml}"]
where = ["{toml}", "a = {toml}"]
kind = "{toml}"
-->

$$ a^2 = a b \tag{{2}} $$
<!-- kenzan
because = "{toml}"
correction = "a^2 = a a + 0 \\text{{{toml}}}"
expect = "fails"
-->

$$ a = {payload} \tag{{3}} $$
<!-- kenzan
reading = "a = a \\text{{{toml}}}"
expect = "{toml}"
"{toml}" = 1
-->

$$ a \text{{{payload}}} = b \tag{{4}} $$

$$ \begin{{{payload}}} a \end{{{payload}}} $$

$$ a = b
<!-- kenzan
label = "{toml}"
"#
    )
}

/// The report on all payloads, under names that are payloads themselves.
fn run() -> Run {
    let options = Options { states: 4, ..Options::default() };
    let request = Request { options, mutants: true, suggest: true, ..Request::default() };
    let verified: Vec<_> = PAYLOADS
        .iter()
        .map(|payload| {
            let path = format!("notes/{payload}.md");
            verify::verify(document::parse(Path::new(&path), &notes(payload)), &request, &|| ())
        })
        .collect();
    verify::run(&verified, &request, Instant::now())
}

/// The pages of a run.
fn pages(run: &Run, language: Language) -> Vec<Page> {
    html::pages(run, report::Options { times: false, language }).unwrap()
}

/// The elements that the report is made of. MathML and SVG have none among theirs that run or load.
const ELEMENTS: &str = "html head meta title style script body a header p span h1 h2 h3 h4 main nav section article div \
    ul ol li dl dt dd table caption thead tbody tr th td details summary pre code strong em small footer time abbr sup \
    sub br del ins figure figcaption \
    label input select option fieldset legend button \
    math menclose mfrac mi mn mo mover mpadded mphantom mroot mrow mspace msqrt mstyle msub msubsup msup mtable mtd mtext \
    mtr munder munderover \
    svg g line path circle polyline polygon rect text title desc";

const ATTRIBUTES: &str = "class id href lang style aria-hidden aria-label aria-labelledby aria-describedby role open \
    colspan rowspan scope content charset name http-equiv hidden tabindex title datetime \
    for type value autocomplete spellcheck data-text data-copied data-failed";

/// What is wrong with an element of the report.
fn defect(element: &scraper::node::Element, files: &[&str]) -> Option<String> {
    let name = element.name();
    if !ELEMENTS.split_whitespace().any(|e| e == name) {
        return Some(format!("<{name}>"));
    }
    let drawn = "math menclose mfrac mi mn mo mover mpadded mphantom mroot mrow mspace msqrt mstyle msub msubsup msup \
        mtable mtd mtext mtr munder munderover svg g line path circle polyline polygon rect text"
        .split_whitespace()
        .any(|e| e == name);
    for (key, value) in element.attrs() {
        let known = ATTRIBUTES.split_whitespace().any(|a| a == key) || drawn && !key.contains(':');
        let runs = key.starts_with("on") || ["src", "srcdoc", "action", "formaction", "xlink:href"].contains(&key);
        let page = value.split('#').next().unwrap_or_default();
        let leads_away = key == "href" && !value.starts_with('#') && !files.contains(&page);
        // What only names, describes or is compared is text whatever it says.
        let text = ["id", "content", "value", "aria-label", "title", "alttext"].contains(&key);
        let loads = !text && (value.contains("url(") || value.to_lowercase().contains("javascript:"));
        let typed = key == "type" && !["search", "checkbox", "button"].contains(&value);
        if !known || runs || leads_away || loads || typed || key == "style" {
            return Some(format!("<{name} {key}=\"{value}\">"));
        }
    }
    None
}

/// The one script that is there, if any, is Kenzan's own, and so is the style: whole, and known to the policy.
fn check_policy(page: &Page) {
    let begin = page.html.find("Content-Security-Policy").unwrap();
    assert!(begin < page.html.find("<title>").unwrap(), "before anything of the notes");
    let policy = page.html[begin..].split('>').next().unwrap();
    assert!(
        policy.starts_with("Content-Security-Policy\" content=\"default-src 'none'; style-src 'sha256-"),
        "{policy}"
    );
    assert!(policy.ends_with("base-uri 'none'; form-action 'none'\"") && !policy.contains("unsafe"), "{policy}");
    let script = concat!("<script>\n", include_str!("../templates/report.js"), "</script>");
    let scripts = page.html.matches("<script").count();
    assert_eq!((scripts, page.html.matches(script).count()), (scripts.min(1), scripts), "{}", page.file);
    assert_eq!(policy.contains("script-src 'sha256-"), scripts == 1, "{}: {policy}", page.file);
    assert_eq!(policy.matches("-src").count(), 2 + scripts, "{policy}");
}

#[test]
fn an_html_parser_sees_nothing_that_runs_links_or_loads() {
    let run = run();
    assert!(run.documents.len() == PAYLOADS.len() && run.documents.iter().all(|d| d.equations.len() >= 3));
    for language in [Language::English, Language::Japanese] {
        let pages = pages(&run, language);
        assert!(pages.len() > PAYLOADS.len());
        let files: Vec<&str> = pages.iter().map(|p| p.file.as_str()).collect();
        assert!(files.iter().all(|file| !file.contains(['/', '\\', '<', '"', ':', '#', '?', '%'])), "{files:?}");
        for page in &pages {
            check_policy(page);
            let tree = Html::parse_document(&page.html);
            let elements = tree.tree.values().filter_map(|node| match node {
                Node::Element(element) => Some(element),
                _ => None,
            });
            let defects: Vec<String> = elements.filter_map(|e| defect(e, &files)).collect();
            assert!(defects.is_empty(), "{} defects: {:.2000}", defects.len(), defects.join("\n"));
            // What a parser would have to guess at may be guessed otherwise by another.
            let guessed = |node: &&Node| matches!(node, Node::Comment(_) | Node::ProcessingInstruction(_));
            assert_eq!(tree.tree.values().filter(guessed).count(), 0);
            let titles = tree.tree.values().filter(|n| matches!(n, Node::Element(e) if e.name() == "title")).count();
            assert_eq!(titles, 1, "one title");
        }
        // The payloads are there, as text.
        let text = |page: &Page| Html::parse_document(&page.html).root_element().text().collect::<String>();
        assert!(pages[..3].iter().all(|page| text(page).contains(r#"<script>document.title="owned"</script>"#)));
        assert!(pages.iter().any(|page| text(page).contains("{{ 7 * 7 }}")));
    }
}

/// JSON within a page would end at `</script>`; `report.json` is a file of its own, and says what the notes say.
#[test]
fn the_data_are_json_and_in_no_page() {
    let run = run();
    let data: serde_json::Value =
        serde_json::from_str(&json::render(&run, report::Options::default()).unwrap()).unwrap();
    let latex = data["documents"][0]["equations"][0]["latex"].as_str().unwrap();
    assert!(latex.contains(PAYLOADS[0]), "{latex}");
    assert!(pages(&run, Language::English).iter().all(|page| !page.html.contains("\"documents\":")));
}

fn browser() -> Option<PathBuf> {
    let names = ["chromium", "chromium-browser", "google-chrome", "chrome"];
    let path = std::env::var_os("PATH")?;
    std::env::split_paths(&path).flat_map(|dir| names.map(|name| dir.join(name))).find(|file| file.is_file())
}

/// What a page is once its scripts have run.
fn rendered(browser: &Path, name: &str, page: &str) -> Option<String> {
    let at = Path::new(env!("CARGO_TARGET_TMPDIR")).join("browser").join(name);
    let _ = std::fs::remove_dir_all(&at);
    std::fs::create_dir_all(&at).unwrap();
    let file = at.join("page.html");
    std::fs::write(&file, page).unwrap();
    let mut profile = std::ffi::OsString::from("--user-data-dir=");
    profile.push(at.join("profile"));
    let output = Command::new(browser)
        .args(["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run"])
        .args(["--disable-background-networking", "--dump-dom"])
        .arg(profile)
        .arg(&file)
        .output()
        .ok()?;
    let dom = String::from_utf8_lossy(&output.stdout).into_owned();
    if dom.is_empty() { None } else { Some(dom) }
}

fn title(dom: &str) -> &str {
    dom.split_once("<title>").and_then(|(_, rest)| rest.split_once("</title>")).map_or("", |(title, _)| title)
}

#[test]
fn a_browser_runs_nothing() {
    let control = "<!doctype html><title>before</title><body><script>document.title=\"owned\"</script>";
    let Some(browser) = browser() else { return println!("skipped: no browser was found") };
    let Some(dom) = rendered(&browser, "control", control) else {
        return println!("skipped: the browser does not start");
    };
    assert_eq!(title(&dom), "owned", "the browser runs scripts");
    let mut all = run();
    let several = pages(&all, Language::English);
    // One document that has everything of all; its page, which is the entry, too, its errata sheet and its map.
    let mut rest = all.documents.split_off(1);
    for document in &mut rest {
        all.documents[0].equations.append(&mut document.equations);
        all.documents[0].problems.append(&mut document.problems);
    }
    let mut shown = pages(&all, Language::Japanese);
    shown.pop();
    shown.extend(several.into_iter().next_back());
    for (k, page) in shown.iter().enumerate() {
        // The browser writes the same text with fewer escapes, and NUL as a sign for what it cannot read.
        let expected = title(&page.html).replace("&quot;", "\"").replace("&#39;", "'").replace('\0', "\u{fffd}");
        let dom =
            rendered(&browser, &format!("report-{k}"), &page.html).expect("the browser shows one page as another");
        assert_eq!(title(&dom), expected);
        // Kenzan's own script runs, on the pages that have it.
        let scripts = page.html.matches("<script>").count();
        assert_eq!(dom.contains("with-script\""), scripts == 1, "{}", page.file);
        // Without its policy the page runs nothing else either: the policy is a second wall.
        let (before, rest) = page.html.split_once("<meta http-equiv=").unwrap();
        let (_, after) = rest.split_once('>').unwrap();
        let open = rendered(&browser, &format!("open-{k}"), &format!("{before}{after}")).unwrap();
        assert_eq!(title(&open), expected);
        assert!(!open.contains("<iframe") && !open.contains("<img") && open.matches("<script").count() == scripts);
    }
}
