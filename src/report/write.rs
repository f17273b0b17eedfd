//! Writing the report's files.
//!
//! Promise: whenever the process ends, by whatever means, each file in the directory is a whole report, the new one or
//! the one before. All are made in full, written beside their places and brought to the disk before the first takes
//! its place; the page at which to begin does so after those that it leads to, and the data last. Between the renames
//! some may be one run older than others.

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

use super::html::Page;
use super::names::ENTRY;
use super::{ReportError, Written, gone};

/// After this time a file that was never renamed is no other run's work, but what a killed one left.
const STALE: Duration = Duration::from_secs(3600);

/// Writes the page and the data under a name into a directory, which is created if need be.
pub(super) fn pair(out: &Path, name: &str, html: &str, json: &str) -> Result<Written, ReportError> {
    let (page, data) = (format!("{name}.html"), format!("{name}.json"));
    files(out, &[(&page, html), (&data, json)])?;
    Ok(Written { html: out.join(page), json: out.join(data) })
}

/// Writes a report's pages, of which the last is where to begin, and its data; pages of the report before it that have no
/// document any more are removed afterwards.
pub(super) fn report(out: &Path, pages: &[Page], json: &str) -> Result<Written, ReportError> {
    const DATA: &str = "report.json";
    let all: Vec<(&str, &str)> =
        pages.iter().map(|p| (p.file.as_str(), p.html.as_str())).chain([(DATA, json)]).collect();
    let before = gone::pages(out, DATA);
    files(out, &all)?;
    gone::remove(out, &before, &all.iter().map(|(name, _)| *name).collect::<Vec<_>>());
    Ok(Written { html: out.join(ENTRY), json: out.join(DATA) })
}

/// Writes files into a directory, which is created if need be; they take their places in this order.
fn files(out: &Path, files: &[(&str, &str)]) -> Result<(), ReportError> {
    fs::create_dir_all(out).map_err(|source| ReportError::Directory { path: out.to_owned(), source })?;
    remove_stale(out, files);
    let written: Vec<Beside> =
        files.iter().map(|(name, contents)| Beside::write(out.join(name), contents)).collect::<Result<_, _>>()?;
    written.into_iter().try_for_each(Beside::take_place)?;
    sync_directory(out);
    Ok(())
}

/// A file written beside its place; removed where it does not come to take it.
struct Beside {
    place: PathBuf,
    beside: PathBuf,
}

impl Beside {
    fn write(place: PathBuf, contents: &str) -> Result<Self, ReportError> {
        // The process's number keeps two runs into one directory from writing the same file.
        let mut name = place.file_name().unwrap_or_default().to_owned();
        name.push(format!(".{}.tmp", std::process::id()));
        let beside = place.with_file_name(name);
        let file = Beside { place, beside };
        let written = File::create(&file.beside).and_then(|mut handle| {
            handle.write_all(contents.as_bytes())?;
            handle.sync_all()
        });
        written.map_err(|source| file.error(source))?;
        Ok(file)
    }

    fn take_place(self) -> Result<(), ReportError> {
        fs::rename(&self.beside, &self.place).map_err(|source| self.error(source))
    }

    fn error(&self, source: io::Error) -> ReportError {
        ReportError::Write { path: self.place.clone(), source }
    }
}

impl Drop for Beside {
    fn drop(&mut self) {
        // Where it has taken its place there is nothing to remove; elsewhere that it cannot be removed adds nothing to
        // the error.
        let _ = fs::remove_file(&self.beside);
    }
}

/// Brings the renames to the disk, where the system lets directories be synchronised.
fn sync_directory(out: &Path) {
    let _ = File::open(out).and_then(|directory| directory.sync_all());
}

/// Removes what killed runs left of these files. Where that fails, nothing is lost.
fn remove_stale(out: &Path, files: &[(&str, &str)]) {
    for entry in fs::read_dir(out).into_iter().flatten().flatten() {
        let name = entry.file_name();
        let name = name.to_string_lossy();
        // NAME.NUMBER.tmp
        let whose = name.strip_suffix(".tmp").and_then(|n| n.rsplit_once('.'));
        let ours = whose.is_some_and(|(whose, _)| files.iter().any(|(file, _)| *file == whose));
        let modified = entry.metadata().and_then(|m| m.modified());
        let age = modified.ok().and_then(|at| at.elapsed().ok()).unwrap_or_default();
        if ours && age > STALE {
            let _ = fs::remove_file(entry.path());
        }
    }
}
