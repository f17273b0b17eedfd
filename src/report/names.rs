//! The names of a report's files: a page for each document, its errata sheet and its map, no two alike.

use serde::Serialize;
use std::collections::HashSet;

/// The page at which a report begins.
pub(super) const ENTRY: &str = "report.html";

/// What other commands write into the same directory.
const TAKEN: [&str; 3] = ["report", "speed", "stability"];
/// The longest stem in bytes: file systems take 255, and endings come to it.
const LONGEST: usize = 180;

/// The files of one document, within one directory.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub(super) struct Files {
    /// The document's page.
    pub page: String,
    /// The errata sheet.
    pub errata: String,
    /// The derivation map.
    pub map: String,
}

impl Files {
    fn of(stem: &str) -> Self {
        Files { page: format!("{stem}.html"), errata: format!("{stem}-errata.html"), map: format!("{stem}-map.html") }
    }

    /// As a file system sees them that does not tell upper from lower case.
    fn folded(&self) -> [String; 3] {
        [&self.page, &self.errata, &self.map].map(|name| name.to_lowercase())
    }
}

/// The files of documents with these names, in the same order.
pub(super) fn files<'a>(documents: impl IntoIterator<Item = &'a str>) -> Vec<Files> {
    let mut taken: HashSet<String> = TAKEN.iter().flat_map(|stem| Files::of(stem).folded()).collect();
    let mut free = |stem: &str| {
        let numbered = (2..).map(|n| Files::of(&format!("{stem}-{n}")));
        let found =
            std::iter::once(Files::of(stem)).chain(numbered).find(|f| f.folded().iter().all(|n| !taken.contains(n)));
        // The numbers do not end.
        let files = found.unwrap_or_else(|| Files::of(stem));
        taken.extend(files.folded());
        files
    };
    documents.into_iter().map(|name| free(&stem(name))).collect()
}

/// A name made fit for a file and a link: letters of any script, digits and `-._`, not beginning with a dot.
fn stem(name: &str) -> String {
    let sign = |c: char| if c.is_alphanumeric() || matches!(c, '-' | '.' | '_') { c } else { '-' };
    let stem: String = name.chars().map(sign).collect();
    let stem = stem.trim_start_matches('.');
    let stem = &stem[..stem.floor_char_boundary(LONGEST)];
    if stem.is_empty() { "notes".to_owned() } else { stem.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pages(names: &[&str]) -> Vec<String> {
        files(names.iter().copied()).into_iter().map(|f| f.page).collect()
    }

    #[test]
    fn names_are_unique() {
        assert_eq!(pages(&["a", "b", "a", "A"]), ["a.html", "b.html", "a-2.html", "A-3.html"]);
        // An errata sheet is in nobody's way.
        assert_eq!(pages(&["a", "a-errata", "a-map"]), ["a.html", "a-errata-2.html", "a-map-2.html"]);
        assert_eq!(pages(&["report", "Speed"]), ["report-2.html", "Speed-2.html"]);
    }

    #[test]
    fn names_are_files_and_links() {
        assert_eq!(
            pages(&["../../etc/x", "", "講義 1", "a\"b<c>#d?e%41"]),
            ["-..-etc-x.html", "notes.html", "講義-1.html", "a-b-c--d-e-41.html"]
        );
        let long = "式".repeat(500);
        assert!(pages(&[&long, &long]).iter().all(|name| name.len() < 255));
    }
}
