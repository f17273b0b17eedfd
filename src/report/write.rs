//! Writing the report's files.
//!
//! Promise: whenever the process ends, by whatever means, each file in the directory is a whole report, the new one or
//! the one before. Both are made in full, written beside their places and brought to the disk before the first takes
//! its place. Between the two renames the data may be one run older than the page.

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

use super::{ReportError, Written};

/// After this time a file that was never renamed is no other run's work, but what a killed one left.
const STALE: Duration = Duration::from_secs(3600);

/// Writes the page and the data under a name into a directory, which is created if need be.
pub(super) fn pair(out: &Path, name: &str, html: &str, json: &str) -> Result<Written, ReportError> {
    fs::create_dir_all(out).map_err(|source| ReportError::Directory { path: out.to_owned(), source })?;
    remove_stale(out, name);
    let written = Written { html: out.join(format!("{name}.html")), json: out.join(format!("{name}.json")) };
    let page = Beside::write(&written.html, html)?;
    let data = Beside::write(&written.json, json)?;
    page.take_place()?;
    data.take_place()?;
    sync_directory(out);
    Ok(written)
}

/// A file written beside its place; removed where it does not come to take it.
struct Beside<'p> {
    place: &'p Path,
    beside: PathBuf,
}

impl<'p> Beside<'p> {
    fn write(place: &'p Path, contents: &str) -> Result<Self, ReportError> {
        // The process's number keeps two runs into one directory from writing the same file.
        let mut name = place.file_name().unwrap_or_default().to_owned();
        name.push(format!(".{}.tmp", std::process::id()));
        let file = Beside { place, beside: place.with_file_name(name) };
        let written = File::create(&file.beside).and_then(|mut handle| {
            handle.write_all(contents.as_bytes())?;
            handle.sync_all()
        });
        written.map_err(|source| file.error(source))?;
        Ok(file)
    }

    fn take_place(self) -> Result<(), ReportError> {
        fs::rename(&self.beside, self.place).map_err(|source| self.error(source))
    }

    fn error(&self, source: io::Error) -> ReportError {
        ReportError::Write { path: self.place.to_owned(), source }
    }
}

impl Drop for Beside<'_> {
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

/// Removes what killed runs left. Where that fails, nothing is lost.
fn remove_stale(out: &Path, stem: &str) {
    for entry in fs::read_dir(out).into_iter().flatten().flatten() {
        let name = entry.file_name();
        let name = name.to_string_lossy();
        let ours = name.starts_with(&format!("{stem}.")) && name.ends_with(".tmp");
        let modified = entry.metadata().and_then(|m| m.modified());
        let age = modified.ok().and_then(|at| at.elapsed().ok()).unwrap_or_default();
        if ours && age > STALE {
            let _ = fs::remove_file(entry.path());
        }
    }
}
