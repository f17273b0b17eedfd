//! Tests of the whole reader.

use super::*;
#[allow(unused_imports)]
use std::path::Path;

fn parse(source: &str) -> Document {
    super::parse(Path::new("notes.md"), source)
}

#[test]
fn survey_tmp() {
    for name in ["gyroscope", "celestial-mechanics-3"] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/notes").join(format!("{name}.md"));
        let document = read(&path).unwrap();
        let equations: Vec<_> = document.equations().collect();
        println!("{name}: title {}", document.title);
        println!(
            "{} displays {} equations {} numbered",
            equations.last().unwrap().display + 1,
            equations.len(),
            equations.iter().filter(|e| e.numbered).count()
        );
        let mut next = 1;
        for e in &equations {
            if e.numbered {
                let n: usize = e.label.parse().unwrap_or(0);
                if n != next {
                    println!("expected {next} found {} at line {}", e.label, e.line);
                }
                next = n + 1;
            }
        }
        println!("next {next}");
        for p in &document.problems {
            println!("{}", p.to_text(&document));
        }
        for e in &equations {
            assert_eq!(e.latex, document.source[e.span.clone()]);
            assert_eq!(e.masked.len(), e.latex.len());
            if e.masked.trim().is_empty() {
                println!("blank {} line {}", e.label, e.line);
            }
            if e.masked.trim_end().ends_with(')')
                && e.masked.trim_end().trim_end_matches(|c: char| c.is_ascii_digit() || c == ')').ends_with('(')
            {
                println!("doubtful {} {}", e.label, e.masked);
            }
            if !e.numbered {
                println!(
                    "   unnumbered {} line {}: {}",
                    e.label,
                    e.line,
                    e.latex.chars().take(60).collect::<String>().replace('\n', " ")
                );
            }
        }
    }
}
