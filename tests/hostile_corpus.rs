//! Every file of the fuzzing corpus, once, through what the fuzz targets call: what has been found stays found.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
#![allow(missing_docs)]

#[path = "../fuzz/survive.rs"]
mod survive;

use std::path::Path;

/// Calls a function for each file of a corpus.
fn all(target: &str, survive: fn(&[u8])) {
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz/corpus").join(target);
    let mut count = 0;
    for file in std::fs::read_dir(&corpus).unwrap() {
        let path = file.unwrap().path();
        // The name is what one wants to know where a file is not survived.
        println!("{}", path.display());
        survive(&std::fs::read(&path).unwrap());
        count += 1;
    }
    assert!(count >= 10, "{target}: only {count} files");
}

#[test]
fn markdown() {
    all("markdown", survive::markdown);
}

#[test]
fn tex() {
    all("tex", survive::tex);
}

#[test]
fn annotation() {
    all("annotation", survive::annotation);
}

#[test]
fn latex() {
    all("latex", survive::latex);
}

#[test]
fn pipeline() {
    // As much stack as the command's threads have.
    std::thread::Builder::new()
        .stack_size(32 << 20)
        .spawn(|| all("pipeline", survive::pipeline))
        .unwrap()
        .join()
        .unwrap();
}
