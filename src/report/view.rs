//! What the templates are given: everything rendered and formatted, nothing left to decide.
//!
//! Fields that hold HTML end in `_html` and are the only ones that templates may mark as safe; everything else is
//! escaped by the template engine.

use super::math::Renderer;
use super::names::{self, Files};
use super::text::{duration, language, symbol, word};
use super::view_equation::Equation;
use super::words::{Words, count, with};
use super::{Counts, Options, Run, view_charts, view_dimensions, view_errata, view_inferred, view_map};
use crate::check::verdict::{DocumentReport, Verdict};
use serde::Serialize;
use std::collections::HashMap;

/// All that a run's pages show.
pub(super) struct Site {
    pub index: Index,
    pub documents: Vec<Document>,
}

/// The page at which several documents begin.
#[derive(Serialize)]
pub(super) struct Index {
    lead: String,
    unexpected: String,
    all_as_expected: bool,
    /// The verdicts that occur, the head of the table.
    verdicts: Vec<Badge>,
    rows: Vec<Row>,
    charts: Vec<view_charts::View>,
}

/// A document in the table of all.
#[derive(Serialize)]
struct Row {
    title_html: String,
    lang: Option<&'static str>,
    path: String,
    files: Files,
    counts: Counts,
    problems: usize,
    /// How many have each verdict of the head.
    with: Vec<usize>,
    shares: Vec<Share>,
}

/// A document's page.
#[derive(Serialize)]
pub(super) struct Document {
    anchor: String,
    pub files: Files,
    /// The way to the table of all documents, where there are several.
    overview: Option<&'static str>,
    name: String,
    path: String,
    pub title: String,
    title_html: String,
    lang: Option<&'static str>,
    lead: String,
    unexpected: String,
    problems_html: Vec<String>,
    dimensions: Option<view_dimensions::Summary>,
    counts: Counts,
    shares: Vec<Share>,
    sections: Vec<Section>,
    errata: Vec<Equation>,
    attention: Vec<Equation>,
    /// Those whose checks let a mutant pass.
    insensitive: Vec<Equation>,
    charts: Vec<view_charts::View>,
    assumed: Vec<view_inferred::AssumedView>,
    pub sheet: view_errata::Sheet,
    pub map: view_map::Map,
}

/// A verdict's share of a document: a segment of its bar.
#[derive(Clone, Serialize)]
struct Share {
    badge: Badge,
    count: usize,
    /// Where the segment begins and how long it is, in thousandths of the bar.
    begin: usize,
    length: usize,
}

#[derive(Serialize)]
pub(super) struct Section {
    pub anchor: String,
    pub title: String,
    pub title_html: String,
    pub lang: Option<&'static str>,
    pub equations: Vec<Equation>,
}

/// A verdict as it is shown.
#[derive(Clone, Copy, Serialize)]
pub(super) struct Badge {
    /// Its class: its name in `report.json`.
    pub class: &'static str,
    /// Its name in the page's language.
    pub word: &'static str,
    /// A sign that stands for it.
    pub symbol: &'static str,
}

/// The pages of a run.
pub(super) fn site(run: &Run, options: Options) -> Site {
    let mut builder = Builder::new(run, options);
    let files = names::files(run.documents.iter().map(|d| d.name.as_str()));
    let alone = run.documents.len() == 1;
    // A chart that cannot be drawn costs no report.
    let drawn = run.charts.and_then(|draw| draw(options.language).ok()).unwrap_or_default();
    let charts = |builder: &Builder| drawn.iter().map(|c| view_charts::view(c, &builder.renderer)).collect();
    let mut documents: Vec<_> =
        run.documents.iter().zip(files).map(|(d, files)| builder.document(d, files, alone)).collect();
    if let [only] = documents.as_mut_slice() {
        only.charts = charts(&builder);
    }
    let counts = Counts::of(run.documents.iter().flat_map(|d| &d.equations));
    let verdicts: Vec<Verdict> = super::counts::ORDER.into_iter().filter(|v| counts.with(*v) > 0).collect();
    let index = Index {
        lead: format!("{} {}", builder.lead(counts.total, true), count(builder.words.in_documents, documents.len())),
        unexpected: builder.unexpected(counts),
        all_as_expected: counts.unexpected == 0,
        rows: documents.iter().map(|d| d.row(&verdicts)).collect(),
        verdicts: verdicts.into_iter().map(|v| builder.badge(v)).collect(),
        charts: if alone { Vec::new() } else { charts(&builder) },
    };
    Site { index, documents }
}

impl Document {
    fn row(&self, verdicts: &[Verdict]) -> Row {
        Row {
            title_html: self.title_html.clone(),
            lang: self.lang,
            path: self.path.clone(),
            files: self.files.clone(),
            counts: self.counts,
            problems: self.problems_html.len(),
            with: verdicts.iter().map(|v| self.counts.with(*v)).collect(),
            shares: self.shares.clone(),
        }
    }
}

/// What the views are made with.
pub(super) struct Builder<'r> {
    run: &'r Run,
    pub renderer: Renderer,
    pub options: Options,
    pub words: &'static Words,
    /// The anchors in use on a page, each with the number of those made from it.
    taken: HashMap<String, usize>,
}

/// The anchors that every page has; those within templates have a `~`, which no name keeps.
const RESERVED: [&str; 8] = ["main", "summary", "errata", "attention", "insensitive", "charts", "legend", "find"];

impl<'r> Builder<'r> {
    pub fn new(run: &'r Run, options: Options) -> Self {
        let words = options.language.words();
        Builder { run, renderer: Renderer::new(), options, words, taken: HashMap::new() }
    }

    /// The sentence on how many equations were judged and how; with the time of the run where it is theirs.
    fn lead(&self, equations: usize, timed: bool) -> String {
        let w = self.words;
        let bits = self.run.precision.map(|n| count(w.lead_bits, n as usize)).unwrap_or_default();
        let time = (timed && self.options.times).then(|| with(w.lead_time, &[("time", &duration(self.run.micros))]));
        let places: [(&str, &dyn std::fmt::Display); 5] = [
            ("equations", &count(w.lead_equations, equations)),
            ("states", &count(w.lead_states, self.run.states)),
            ("bits", &bits),
            ("seed", &self.run.seed),
            ("time", &time.unwrap_or_default()),
        ];
        with(w.lead, &places)
    }

    fn unexpected(&self, counts: Counts) -> String {
        match counts.unexpected {
            0 => self.words.all_as_expected.to_owned(),
            n => count(self.words.not_as_expected_count, n),
        }
    }

    pub fn badge(&self, verdict: Verdict) -> Badge {
        Badge { class: word(verdict), word: self.words.verdict(verdict), symbol: symbol(verdict) }
    }

    fn document(&mut self, document: &DocumentReport, files: Files, alone: bool) -> Document {
        self.taken = RESERVED.map(|anchor| (anchor.to_owned(), 1)).into();
        let anchor = self.anchor(&document.name);
        let sections = self.sections(document);
        let counts = Counts::of(&document.equations);
        let chosen = |keep: fn(&&Equation) -> bool| {
            sections.iter().flat_map(|s| &s.equations).filter(keep).cloned().collect::<Vec<_>>()
        };
        let mapper = view_map::Mapper::new(document, &files.page, &sections, self);
        Document {
            map: mapper.map(&sections),
            sheet: view_errata::sheet(document, &sections, self),
            assumed: view_inferred::assumed(document, self),
            anchor,
            files,
            overview: (!alone).then_some(names::ENTRY),
            name: document.name.clone(),
            path: document.path.clone(),
            title: document.title.clone(),
            title_html: self.renderer.prose(&document.title),
            lang: language(&document.title),
            lead: self.lead(counts.total, alone),
            unexpected: self.unexpected(counts),
            problems_html: document
                .problems
                .iter()
                .map(|p| self.renderer.prose(&self.options.language.say_problem(&p.text)))
                .collect(),
            dimensions: view_dimensions::summary(document, &self.renderer),
            counts,
            shares: self.shares(counts),
            errata: chosen(|e| e.erratum),
            attention: chosen(|e| e.needs_attention()),
            insensitive: chosen(|e| !e.diagnosis.survivors_html.is_empty()),
            sections,
            charts: Vec::new(),
        }
    }

    fn shares(&self, counts: Counts) -> Vec<Share> {
        let mut before = 0;
        let mut share = |verdict: Verdict| {
            let count = counts.with(verdict);
            let begin = 1000 * before / counts.total.max(1);
            before += count;
            let length = 1000 * before / counts.total.max(1) - begin;
            Share { badge: self.badge(verdict), count, begin, length }
        };
        super::counts::ORDER.into_iter().map(&mut share).filter(|s| s.count > 0).collect()
    }

    fn sections(&mut self, document: &DocumentReport) -> Vec<Section> {
        let anchors: Vec<_> =
            document.equations.iter().map(|e| self.anchor(&format!("{}-{}", document.name, e.label))).collect();
        let mut sections: Vec<Section> = Vec::new();
        let mut labels = HashMap::new();
        for (judgement, anchor) in document.equations.iter().zip(&anchors) {
            labels.entry(judgement.label.as_str()).or_insert(anchor.as_str());
        }
        let mut before = None;
        for (judgement, anchor) in document.equations.iter().zip(&anchors) {
            if before != Some(&judgement.section) {
                let section = format!("{}-section-{}", document.name, sections.len() + 1);
                sections.push(self.section(&judgement.section, &section));
                before = Some(&judgement.section);
            }
            // Of several equations with one label, a premise means the last one before it, or else the first.
            let equation = self.equation(judgement, &document.name, anchor, &labels);
            labels.insert(&judgement.label, anchor);
            if let Some(section) = sections.last_mut() {
                section.equations.push(equation);
            }
        }
        sections
    }

    fn section(&mut self, title: &str, anchor: &str) -> Section {
        let shown = if title.is_empty() { self.words.before_first_heading } else { title };
        Section {
            anchor: self.anchor(anchor),
            title: shown.to_owned(),
            title_html: self.renderer.prose(shown),
            lang: language(title),
            equations: Vec::new(),
        }
    }

    /// A free anchor for a name: `gyroscope-52`. Letters of any script stay as they are.
    fn anchor(&mut self, name: &str) -> String {
        let sign = |c: char| if c.is_alphanumeric() || matches!(c, '-' | '.' | '_') { c } else { '-' };
        let base: String = name.chars().map(sign).collect();
        let mut anchor = base.clone();
        while self.taken.contains_key(&anchor) {
            // From where the last one of this name was found: many of one name take no longer each.
            let n = self.taken.entry(base.clone()).or_insert(1);
            *n += 1;
            anchor = format!("{base}-{n}");
        }
        self.taken.insert(anchor.clone(), 1);
        anchor
    }
}
