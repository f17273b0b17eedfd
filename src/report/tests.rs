use super::*;
use crate::check::Finding;
use crate::check::verdict::DocumentReport;

const UNTIMED: Options = Options { times: false, language: Language::English };

/// A new version of Kenzan is no new report.
fn unversioned(report: &str) -> String {
    report.replace(env!("CARGO_PKG_VERSION"), "[version]")
}

/// Some pages without the style sheet and the script, which have their own files.
fn bare(pages: &[html::Page]) -> String {
    let cut = |html: &str, element: &str| {
        let Some((before, rest)) = html.split_once(&format!("<{element}>")) else { return html.to_owned() };
        let (_, after) = rest.split_once(&format!("</{element}>")).unwrap();
        format!("{before}{after}")
    };
    let hashes = |html: String| {
        let mut parts = html.split("'sha256-");
        let first = parts.next().unwrap_or_default().to_owned();
        parts.fold(first, |text, part| text + "'[hash]" + part.split_once('\'').unwrap().1)
    };
    pages.iter().map(|p| format!("{}\n{}\n", p.file, hashes(cut(&cut(&p.html, "style"), "script")))).collect()
}

fn pages(run: &Run, language: Language) -> Vec<html::Page> {
    html::pages(run, Options { language, ..UNTIMED }).unwrap()
}

#[test]
fn html_snapshot() {
    insta::assert_snapshot!(unversioned(&bare(&pages(&fixture::run(), Language::English))));
}

#[test]
fn japanese_html_snapshot() {
    insta::assert_snapshot!(unversioned(&bare(&pages(&fixture::run(), Language::Japanese))));
}

#[test]
fn japanese_terminal_snapshot() {
    let options = Options { language: Language::Japanese, ..UNTIMED };
    insta::assert_snapshot!(terminal::render(&fixture::run(), false, options));
}

/// The names of the pages, the entry last; with one document the entry is its page.
#[test]
fn every_document_has_a_page() {
    let mut run = fixture::run();
    let names = |pages: &[html::Page]| pages.iter().map(|p| p.file.clone()).collect::<Vec<_>>();
    let several = pages(&run, Language::English);
    assert_eq!(
        names(&several),
        [
            "gyroscope-errata.html",
            "gyroscope-map.html",
            "gyroscope.html",
            "empty-errata.html",
            "empty-map.html",
            "empty.html",
            "report.html"
        ]
    );
    let entry = &several.last().unwrap().html;
    assert!(entry.contains("href=\"gyroscope.html\"") && entry.contains("href=\"empty.html\""));
    run.documents.truncate(1);
    let alone = pages(&run, Language::English);
    assert_eq!(names(&alone), ["gyroscope-errata.html", "gyroscope-map.html", "gyroscope.html", "report.html"]);
    assert_eq!(alone[2].html, alone[3].html);
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
    run.documents[0].problems.iter_mut().for_each(|p| p.file = "a,line=1::x\n::error::b.md".into());
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
    assert_eq!(html::pages(&run, UNTIMED).unwrap(), html::pages(&slower, UNTIMED).unwrap());
    assert_eq!(json::render(&run, UNTIMED).unwrap(), json::render(&slower, UNTIMED).unwrap());
    assert_eq!(terminal::render(&run, true, UNTIMED), terminal::render(&slower, true, UNTIMED));
    let timed = html::pages(&run, Options::default()).unwrap();
    assert!(timed[2].html.contains("118 µs") && timed.last().unwrap().html.contains("31.4 ms"));
    assert_ne!(timed, html::pages(&slower, Options::default()).unwrap());
    assert!(json::render(&run, Options::default()).unwrap().contains("\"micros\": 118"));
}

/// Every anchor and page that is linked to exists, and no anchor exists twice on a page.
#[test]
fn anchors_lead_somewhere() {
    let mut run = fixture::run();
    // The same document again, and two equations of one label.
    run.documents.push(run.documents[0].clone());
    let twin = run.documents[0].equations[1].clone();
    run.documents[0].equations.push(twin);
    // Names that meet those of the page's own parts.
    run.documents[1] = DocumentReport { name: "summary".into(), ..run.documents[0].clone() };
    run.documents[1].equations[0].label = "title".into();
    let pages = pages(&run, Language::English);
    let files: Vec<&str> = pages.iter().map(|p| p.file.as_str()).collect();
    for html::Page { file, html } in &pages {
        let values = |key: &str| -> Vec<String> {
            html.split(key).skip(1).filter_map(|rest| Some(rest.split_once('"')?.0.to_owned())).collect()
        };
        let ids = values(" id=\"");
        let unique: std::collections::HashSet<_> = ids.iter().collect();
        assert_eq!(ids.len(), unique.len(), "{file}");
        let links = values("href=\"");
        assert!(links.len() > if file.starts_with("gyroscope.") { 35 } else { 3 }, "{file}: {}", links.len());
        let own = links.iter().filter_map(|link| link.strip_prefix('#').map(str::to_owned));
        let named = ["aria-labelledby=\"", "aria-describedby=\"", " for=\""].into_iter().flat_map(values);
        for target in own.chain(named) {
            assert!(unique.contains(&target), "{file}: nothing has the anchor {target}");
        }
        for link in links.iter().filter(|link| !link.starts_with('#')) {
            let page = link.split('#').next().unwrap();
            assert!(files.contains(&page), "{file}: no page {link}");
        }
    }
}

#[test]
fn the_pages_need_nothing_else() {
    let pages = pages(&fixture::run(), Language::English);
    for html::Page { file, html } in &pages {
        for outside in ["<script ", "<link", "<img", "@import", "url(", "http:", " style=", "unsafe-inline"] {
            assert!(!html.contains(outside), "{file}: {outside}");
        }
    }
    let page = &pages[2].html;
    assert!(page.contains("gyroscope-56") && page.contains("class=\"changed\""));
    assert!(page.contains("回転 &lt;rotation&gt;"));
}

/// Every text of a run may come from notes that nobody trusts.
#[test]
fn hostile_notes_stay_text() {
    let hostile = "\"><script>alert('x')</script>{{ 7 * 8123 }}</style>";
    let mut run = fixture::run();
    let document = &mut run.documents[0];
    for text in [&mut document.name, &mut document.path, &mut document.title] {
        *text = hostile.into();
    }
    document.problems = vec![Finding { text: hostile.into(), file: hostile.into(), ..fixture::unclosed() }];
    (document.assumed[0].symbol, document.assumed[0].role) = (hostile.into(), hostile.into());
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
        if let Some(inferred) = &mut judgement.inferred {
            inferred.formulas = vec![hostile.into()];
            inferred.needs = vec![hostile.into()];
        }
        if let Some(suspect) = &mut judgement.suspect {
            for text in [&mut suspect.edit, &mut suspect.latex, &mut suspect.label] {
                *text = hostile.into();
            }
            suspect.premises = vec![hostile.into(), format!("${hostile}$")];
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
    for language in [Language::English, Language::Japanese] {
        let pages = pages(&run, language);
        for page in &pages {
            assert!(page.html.matches("<script").count() <= 1 && page.html.matches("</style>").count() == 1);
        }
        let text = bare(&pages);
        assert!(!text.contains("<script") && !text.contains("56861"));
        let quoted = |tag: &str| tag.matches('"').count().is_multiple_of(2);
        assert!(text.split('<').skip(1).all(|rest| rest.split_once('>').is_some_and(|(tag, _)| quoted(tag))));
    }
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
    let mut names: Vec<_> =
        std::fs::read_dir(&out).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    assert_eq!(
        names,
        [
            "empty-errata.html",
            "empty-map.html",
            "empty.html",
            "gyroscope-errata.html",
            "gyroscope-map.html",
            "gyroscope.html",
            "report.html",
            "report.json"
        ]
    );
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
