//! How long it takes until a change of one equation is judged, on the celestial mechanics notes with their 566 equations:
//! a letter or a sign of a random equation is changed, and the notes are read and verified with what is remembered.
//!
//!     cargo bench --bench edits

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::path::Path;
use std::time::{Duration, Instant};

use kenzan::document;
use kenzan::incremental::Memory;
use kenzan::verify::{self, Request};

/// The number of edits.
const EDITS: usize = 50;

fn main() {
    let pool = rayon::ThreadPoolBuilder::new().stack_size(32 << 20).build().unwrap();
    pool.install(measure);
}

fn measure() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("notes/celestial-mechanics-3.md");
    let original = std::fs::read_to_string(&path).unwrap();
    let (mut memory, request) = (Memory::default(), Request::default());
    let mut verify = |text: &str| {
        let begin = Instant::now();
        let document = document::parse(&path, text);
        let read = begin.elapsed();
        let (verified, anew) = verify::verify_again(document, &request, &mut memory, &|| ());
        let judged: u64 = anew.iter().map(|k| verified.report.equations[*k].micros).sum();
        (begin.elapsed(), read, anew.len(), Duration::from_micros(judged))
    };
    println!("at first: {:?}, and again {:?}", verify(&original).0, verify(&original).0);
    let mut seed = 1_u64;
    let mut times = Vec::new();
    let equations: Vec<_> = document::parse(&path, &original).equations().cloned().collect();
    for _ in 0..EDITS {
        let mut random = |n: usize| {
            seed ^= seed << 13;
            seed ^= seed >> 7;
            seed ^= seed << 17;
            (seed >> 11) as usize % n
        };
        let (equation, place) = loop {
            let equation = &equations[random(equations.len())];
            let places: Vec<usize> =
                equation.latex.char_indices().filter(|(_, c)| "+-123456789".contains(*c)).map(|(at, _)| at).collect();
            if !places.is_empty() {
                break (equation, equation.span.start + places[random(places.len())]);
            }
        };
        let mut text = original.clone();
        let new = match &text[place..=place] {
            "+" => "-",
            "-" => "+",
            "1" => "2",
            _ => "1",
        };
        text.replace_range(place..=place, new);
        let (time, read, anew, judged) = verify(&text);
        println!("({}) {time:.1?}, of which reading {read:.1?}; {anew} judged anew in {judged:.1?}", equation.label);
        times.push(time);
        verify(&original);
    }
    times.sort();
    println!("{EDITS} edits: median {:.1?}, worst {:.1?}", times[EDITS / 2], times[EDITS - 1]);
    println!("below 100 ms: {}", times.iter().filter(|t| **t < Duration::from_millis(100)).count());
}
