use std::path::Path;

use super::*;
use crate::document;
use crate::report::Options;
use crate::report::stability::{html, json};
#[cfg(not(feature = "rug"))]
use crate::report::{Language, stability::table};

/// Notes with a planted cancellation, an ill-conditioned difference and a harmless product.
const NOTES: &str = "<!-- kenzan\n[symbols]\n'x' = { range = [0.0, 1.0] }\n'y, z' = { range = [1.0, 2.0] }\n-->\n\n\
    $$ z = \\frac{1 - \\cos x}{y} \\tag{1} $$\n\n$$ z = x y^2 \\tag{2} $$\n\n$$ z = \\sin x - \\frac{1}{y} \\tag{3} $$\n\n\
    $$ x - \\sin y = 0 \\tag{4} $$\n";

fn found() -> Stability {
    let document = document::parse(Path::new("notes.md"), NOTES);
    let request = Request { seed: 1, only: Vec::new(), times: false };
    Stability { micros: 0, ..stability(&[document], &request, &|| ()).unwrap() }
}

#[test]
fn the_search_finds_a_planted_cancellation() {
    let found = found();
    let items = &found.documents[0].items;
    let labels: Vec<&str> = items.iter().map(|i| i.label.as_str()).collect();
    // (4) is a relation between symbols and no formula.
    assert_eq!(labels, ["1", "2", "3"]);
    assert!(items[0].is_at_fault() && items[0].found.worst.loss.lost > 50.0, "{:?}", items[0].found);
    let proposal = items[0].proposal.as_ref().unwrap();
    assert!(proposal.sameness.holds() && proposal.found.fault.loss.fault() < 4.0, "{proposal:?}");
    assert!(!items[1].loses(), "{:?}", items[1].found);
    assert!(items[2].loses() && !items[2].is_at_fault(), "{:?}", items[2].found);
    let counts = found.counts();
    assert_eq!((counts.equations, counts.formulas, counts.losing), (4, 3, 2));
    assert_eq!((counts.ill_conditioned, counts.unstable, counts.mended), (1, 1, 1));
}

#[test]
fn the_same_seed_gives_the_same_bytes() {
    let options = Options { times: false, ..Options::default() };
    let threads = |n: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(n).build().unwrap();
        pool.install(|| (html(&found(), options).unwrap(), json(&found(), options).unwrap()))
    };
    let first = threads(1);
    assert_eq!(first, threads(3));
    assert!(!first.0.contains("{{") && first.0.contains("own fault"), "{}", first.0);
    assert!(!first.1.contains("micros") && !first.1.contains("nanoseconds"));
}

#[test]
fn a_hard_case_has_its_chart_with_its_numbers() {
    let documents = crate::verify::documents(&[]).unwrap();
    let request = Request { seed: 1, only: vec!["68".into()], times: false };
    let page = html(&stability(&documents, &request, &|| ()).unwrap(), Options::default()).unwrap();
    assert!(page.contains("<figure") && page.contains("<summary>"), "{page}");
}

/// With more than double-double other states are certain, and the search goes other ways.
#[cfg(not(feature = "rug"))]
#[test]
fn the_table_of_hard_cases() {
    let documents = crate::verify::documents(&[]).unwrap();
    let request = Request { seed: 1, only: Vec::new(), times: false };
    insta::assert_snapshot!(table(&measured(&documents, &request).unwrap(), Language::English));
}
