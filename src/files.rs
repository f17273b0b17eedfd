//! Which files are notes: those that are named, and those in the folders that are named.

use std::path::{Path, PathBuf};

use crate::document::{self, Document, ReadError};

/// The endings of files that are looked at in a folder.
pub const ENDINGS: [&str; 6] = ["md", "markdown", "qmd", "rmd", "tex", "ltx"];

/// How deep folders are gone into.
const DEEPEST: usize = 32;

/// Reads the notes that are named. Of a folder these are all files with one of the [`ENDINGS`] that hold an equation,
/// sorted; hidden folders and those that begin with `_` are left out, and so is LaTeX that is only a part of a document,
/// where the folder has a document.
///
/// # Errors
/// The first file that cannot be read; a folder without notes.
pub fn read(paths: &[PathBuf]) -> Result<Vec<Document>, ReadError> {
    let mut documents = Vec::new();
    for path in paths {
        if !path.is_dir() {
            documents.push(document::read(path)?);
            continue;
        }
        let before = documents.len();
        for file in within(path) {
            match document::read(&file) {
                Ok(document) => documents.push(document),
                Err(ReadError::NoEquation { .. } | ReadError::Empty { .. }) => {}
                Err(error) => return Err(error),
            }
        }
        if documents.len() == before {
            return Err(ReadError::NoNotes { path: path.clone() });
        }
    }
    Ok(documents)
}

/// As [`read`], without the files that hold no equation.
///
/// # Errors
/// The first file that cannot be read.
pub fn read_any(paths: &[PathBuf]) -> Result<Vec<Document>, ReadError> {
    let mut documents = Vec::new();
    for path in paths {
        match read(std::slice::from_ref(path)) {
            Ok(found) => documents.extend(found),
            Err(ReadError::NoNotes { .. } | ReadError::NoEquation { .. } | ReadError::Empty { .. }) => {}
            Err(error) => return Err(error),
        }
    }
    Ok(documents)
}

/// Paths in which each sidecar, `NAME.kenzan.toml`, is replaced by the notes that it belongs to; each path once.
pub fn with_sidecars(paths: &[PathBuf]) -> Vec<PathBuf> {
    let mut found: Vec<PathBuf> = Vec::new();
    for path in paths {
        let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        let of = |name: &str| {
            let notes = ENDINGS.iter().map(|ending| path.with_file_name(format!("{name}.{ending}")));
            notes.filter(|notes| notes.is_file()).collect()
        };
        let named: Vec<PathBuf> = name.strip_suffix(".kenzan.toml").map_or_else(|| vec![path.clone()], of);
        for path in named {
            if !found.contains(&path) {
                found.push(path);
            }
        }
    }
    found
}

/// The files of a folder that may be notes, sorted.
pub fn within(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    collect(folder, DEEPEST, &mut found);
    // `notes.md`, and not `./notes.md`: other programs look files up by their names.
    for path in &mut found {
        *path = path.strip_prefix(".").map(Path::to_owned).unwrap_or_else(|_| path.clone());
    }
    found.sort();
    let is_latex = |path: &PathBuf| path.extension().is_some_and(|e| e == "tex" || e == "ltx");
    let documents: Vec<bool> = found.iter().map(|path| is_latex(path) && is_whole(path)).collect();
    if documents.contains(&true) {
        let mut whole = documents.into_iter();
        found.retain(|path| whole.next().unwrap_or(true) || !is_latex(path));
    }
    found
}

fn collect(folder: &Path, depth: usize, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
        let (path, name) = (entry.path(), entry.file_name().to_string_lossy().into_owned());
        // A link may lead in a circle.
        let Ok(kind) = entry.file_type() else { continue };
        if kind.is_dir() && depth > 0 && !name.starts_with(['.', '_']) && name != "node_modules" {
            collect(&path, depth - 1, found);
        } else if kind.is_file() && !name.starts_with('.') && is_notes(&path) {
            found.push(path);
        }
    }
}

/// Whether a file's name ends as notes' do.
pub fn is_notes(path: &Path) -> bool {
    let ending = path.extension().map(|e| e.to_string_lossy().to_lowercase());
    ending.is_some_and(|ending| ENDINGS.contains(&ending.as_str()))
}

/// Whether LaTeX is a document of its own, and not a part of one.
fn is_whole(path: &Path) -> bool {
    std::fs::read(path).is_ok_and(|text| String::from_utf8_lossy(&text).contains("\\documentclass"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_a_folder_the_notes_are_read() {
        let folder = std::env::temp_dir().join(format!("kenzan-files-{}", std::process::id()));
        std::fs::create_dir_all(folder.join("b/_site")).unwrap();
        let write = |name: &str, text: &str| std::fs::write(folder.join(name), text).unwrap();
        write("z.md", "$$ a = a $$\n");
        write("b/a.qmd", "$$ a = a $$\n");
        write("b/README.md", "no equation\n");
        write("b/_site/c.md", "$$ a = a $$\n");
        write("b/part.txt", "$$ a = a $$\n");
        let names = |documents: &[Document]| documents.iter().map(|d| d.name.clone()).collect::<Vec<_>>();
        assert_eq!(names(&read(std::slice::from_ref(&folder)).unwrap()), ["a", "z"]);
        write("b/part.tex", "\\[ a = a \\]\n");
        assert_eq!(within(&folder).len(), 4, "a part of a document, where there is no whole one");
        write("b/whole.tex", "\\documentclass{article}\n");
        let found: Vec<_> = within(&folder).iter().filter_map(|p| p.file_name().map(|n| n.to_owned())).collect();
        assert_eq!(found, ["README.md", "a.qmd", "whole.tex", "z.md"]);
        let empty = folder.join("b/_site/none");
        std::fs::create_dir_all(&empty).unwrap();
        assert!(matches!(read(&[empty]), Err(ReadError::NoNotes { .. })));
        let all = ["z.kenzan.toml", "z.md", "gone.kenzan.toml"].map(|name| folder.join(name));
        assert_eq!(with_sidecars(&all), [folder.join("z.md")]);
        std::fs::remove_dir_all(&folder).unwrap();
    }
}
