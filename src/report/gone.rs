//! Pages of documents that a report no longer has: they are removed, so that no link or search finds an old verdict.
//!
//! Promise: only a file is removed that the last `report.json` of the directory says Kenzan wrote there, that is a file and
//! no link, and whose head says that Kenzan generated it. Everything else stays, whatever its name.

use std::fs::{self, File};
use std::io::Read;
use std::path::{Path, PathBuf};

use serde::Deserialize;

use super::names;

/// Where a page says what generated it: within so many bytes of its beginning.
const HEAD: u64 = 2048;
/// How it says so.
const GENERATOR: &str = "<meta name=\"generator\" content=\"Kenzan ";

/// What must be known of the last report.
#[derive(Deserialize)]
struct Last {
    documents: Vec<Named>,
}

#[derive(Deserialize)]
struct Named {
    name: String,
}

/// The pages of the documents of the report that stands in a directory, by its data; none where that is no report.
pub(super) fn pages(out: &Path, data: &str) -> Vec<String> {
    let last = fs::read(out.join(data)).ok().and_then(|text| serde_json::from_slice::<Last>(&text).ok());
    let documents = last.map_or_else(Vec::new, |last| last.documents);
    let files = names::files(documents.iter().map(|d| d.name.as_str()));
    files.into_iter().flat_map(|f| [f.page, f.errata, f.map]).collect()
}

/// Removes those of the pages that Kenzan generated and that are not among the files now written. What cannot be removed
/// stays: the new report is whole without.
pub(super) fn remove(out: &Path, pages: &[String], written: &[&str]) {
    // Where a file system does not tell upper from lower case, a page of another case is the page itself.
    let kept = |page: &str| written.iter().any(|name| name.to_lowercase() == page.to_lowercase());
    for page in pages.iter().filter(|page| !kept(page)) {
        let place = out.join(page);
        if is_generated(&place) {
            let _ = fs::remove_file(place);
        }
    }
}

fn is_generated(place: &PathBuf) -> bool {
    let is_file = fs::symlink_metadata(place).is_ok_and(|meta| meta.is_file());
    let mut head = Vec::new();
    let read = is_file && File::open(place).and_then(|file| file.take(HEAD).read_to_end(&mut head)).is_ok();
    read && String::from_utf8_lossy(&head).contains(GENERATOR)
}

#[cfg(test)]
mod tests {
    use super::super::fixture;
    use super::super::{Options, Run, write};
    use super::*;

    fn report(out: &Path, documents: &[&str]) {
        let mut run = fixture::run();
        let first = run.documents[0].clone();
        let named = |name: &&str| crate::check::verdict::DocumentReport { name: (*name).to_owned(), ..first.clone() };
        run.documents = documents.iter().map(named).collect();
        write(&Run { charts: None, ..run }, out, Options::default()).unwrap();
    }

    fn names(out: &Path) -> Vec<String> {
        let mut names: Vec<String> =
            fs::read_dir(out).unwrap().map(|e| e.unwrap().file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }

    #[test]
    fn pages_of_documents_that_are_gone_go() {
        let out = tempfile::tempdir().unwrap();
        report(out.path(), &["a", "b", "a"]);
        assert_eq!(names(out.path()).len(), 11);
        report(out.path(), &["b"]);
        assert_eq!(names(out.path()), ["b-errata.html", "b-map.html", "b.html", "report.html", "report.json"]);
    }

    #[test]
    fn what_kenzan_did_not_surely_write_stays() {
        let out = tempfile::tempdir().unwrap();
        let file = |name: &str| out.path().join(name);
        report(out.path(), &["a", "b", "c", "speed"]);
        let page = fs::read_to_string(file("a.html")).unwrap();
        // A copy under a name of its own, a page of another command, one that was replaced, a folder, a link.
        fs::write(file("kept.html"), &page).unwrap();
        fs::write(file("speed.html"), &page).unwrap();
        fs::write(file("a.html"), "<!doctype html><title>mine</title>").unwrap();
        fs::remove_file(file("a-map.html")).unwrap();
        fs::create_dir(file("a-map.html")).unwrap();
        #[cfg(unix)]
        {
            fs::remove_file(file("b.html")).unwrap();
            std::os::unix::fs::symlink(file("kept.html"), file("b.html")).unwrap();
        }
        report(out.path(), &["C"]);
        let left = names(out.path());
        for name in ["kept.html", "speed.html", "a.html", "a-map.html", "C.html", "report.html", "report.json"] {
            assert!(left.contains(&name.to_owned()), "{name} of {left:?}");
        }
        assert!(cfg!(not(unix)) || left.contains(&"b.html".to_owned()));
        for name in ["a-errata.html", "b-errata.html", "b-map.html", "speed-2.html"] {
            assert!(!left.contains(&name.to_owned()), "{name} of {left:?}");
        }
    }

    #[test]
    fn without_a_last_report_nothing_is_removed() {
        let out = tempfile::tempdir().unwrap();
        report(out.path(), &["a"]);
        for data in ["", "[]", "{\"documents\": 3}", "{\"documents\": [{\"name\": \"../a\"}]}"] {
            fs::write(out.path().join("report.json"), data).unwrap();
            remove(out.path(), &pages(out.path(), "report.json"), &[]);
            assert!(out.path().join("a.html").exists(), "{data}");
        }
    }
}
