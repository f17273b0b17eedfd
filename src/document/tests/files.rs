//! Files that cannot be read as notes.

use super::*;
use miette::Diagnostic;

/// The message, code and help of the error that a file with this content gives.
fn error_of(name: &str, content: Option<&[u8]>) -> [String; 3] {
    let folder = std::env::temp_dir().join(format!("kenzan-document-{}-{}", std::process::id(), name.len()));
    std::fs::create_dir_all(&folder).unwrap();
    let path = folder.join(name);
    if let Some(content) = content {
        std::fs::write(&path, content).unwrap();
    }
    let error = read(&path).unwrap_err();
    std::fs::remove_dir_all(&folder).unwrap();
    let text = |part: Option<Box<dyn std::fmt::Display + '_>>| part.map(|part| part.to_string()).unwrap_or_default();
    let parts = [error.to_string(), text(error.code()), text(error.help())];
    parts.map(|part| part.replace(&*folder.to_string_lossy(), "FOLDER"))
}

#[test]
fn errors_say_what_is_wrong_and_what_to_do() {
    let errors = [
        error_of("missing.md", None),
        error_of("", None),
        error_of("latin.md", Some(b"# T\n\n$$a$$\n gr\xfc\xdfe")),
        error_of("empty.md", Some("\u{feff} \n\n".as_bytes())),
        error_of("prose.md", Some(b"# T\n\nNothing but $prose$.\n")),
    ];
    let rendered: Vec<_> = errors.iter().map(|parts| parts.join("\n")).collect();
    insta::assert_snapshot!(rendered.join("\n\n"));
}

#[test]
fn a_file_whose_only_display_is_damaged_is_delivered_with_its_problem() {
    let path = std::env::temp_dir().join(format!("kenzan-damaged-{}.md", std::process::id()));
    std::fs::write(&path, "$$ a\n").unwrap();
    let document = read(&path).unwrap();
    std::fs::remove_file(&path).unwrap();
    assert_eq!((document.equations().count(), document.problems.len()), (0, 1));
}
