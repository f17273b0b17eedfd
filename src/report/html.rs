//! The pages: each is one file that needs no network and no other file, and is readable without its script.
//!
//! The policy of each page lets run nothing but the script that Kenzan puts there, known by its hash, and no style but
//! Kenzan's own.

use super::math;
use super::names::ENTRY;
use super::words::{self, Words};
use super::{Language, Options, ReportError, Run, view};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde::Serialize;
use sha2::{Digest, Sha256};
use tera::{Context, Kwargs, State, Tera};

/// The templates by the names under which they include each other. The names end in `.html`, so what they are given is
/// escaped.
const TEMPLATES: [(&str, &str); 23] = [
    ("page.html", include_str!("../../templates/page.html")),
    ("index.html", include_str!("../../templates/index.html")),
    ("report.html", include_str!("../../templates/report.html")),
    ("errata.html", include_str!("../../templates/errata.html")),
    ("entry.html", include_str!("../../templates/entry.html")),
    ("map.html", include_str!("../../templates/map.html")),
    ("summary.html", include_str!("../../templates/summary.html")),
    ("contents.html", include_str!("../../templates/contents.html")),
    ("find.html", include_str!("../../templates/find.html")),
    ("formula.html", include_str!("../../templates/formula.html")),
    ("latex.html", include_str!("../../templates/latex.html")),
    ("bar.html", include_str!("../../templates/bar.html")),
    ("erratum.html", include_str!("../../templates/erratum.html")),
    ("equation.html", include_str!("../../templates/equation.html")),
    ("link.html", include_str!("../../templates/link.html")),
    ("badge.html", include_str!("../../templates/badge.html")),
    ("counterexample.html", include_str!("../../templates/counterexample.html")),
    ("order.html", include_str!("../../templates/order.html")),
    ("dimensions.html", include_str!("../../templates/dimensions.html")),
    ("chart.html", include_str!("../../templates/chart.html")),
    ("diagnosis.html", include_str!("../../templates/diagnosis.html")),
    ("survivors.html", include_str!("../../templates/survivors.html")),
    ("legend.html", include_str!("../../templates/legend.html")),
];

const STYLE: &str = include_str!("../../templates/style.css");
/// Of the pages on speed and on lost digits.
const MEASURED_STYLE: &str = include_str!("../../templates/measured.css");
/// For filtering, searching and copying only.
const SCRIPT: &str = include_str!("../../templates/report.js");

/// A page of the report.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Page {
    /// The file's name within the report's directory.
    pub file: String,
    /// The whole page.
    pub html: String,
}

/// What every page is given.
#[derive(Serialize)]
struct Common {
    version: &'static str,
    tongue: &'static str,
    w: &'static Words,
    style: String,
    style_policy: String,
}

/// The run as pages: for each document its errata sheet, its derivation map and its page, and the entry, `report.html`,
/// last. With one document the entry is that document's page.
///
/// # Errors
/// [`ReportError::Template`]: a template does not fit the data, which is a defect of Kenzan.
pub fn pages(run: &Run, options: Options) -> Result<Vec<Page>, ReportError> {
    let site = view::site(run, options);
    let press = Press::new(options.language, "")?;
    let mut pages = Vec::new();
    for document in &site.documents {
        let mut page = |file: &str, template: &str| {
            let html = press.print(template, "document", document)?;
            pages.push(Page { file: file.to_owned(), html });
            Ok::<(), ReportError>(())
        };
        let files = &document.files;
        page(&files.errata, "errata.html")?;
        page(&files.map, "map.html")?;
        page(&files.page, "report.html")?;
    }
    let entry = match (site.documents.as_slice(), pages.last()) {
        ([_], Some(page)) => page.html.clone(),
        _ => press.print("index.html", "index", &site.index)?,
    };
    pages.push(Page { file: ENTRY.to_owned(), html: entry });
    Ok(pages)
}

/// The page of another command, from the same base: its template, those that it includes and its style beside that of all
/// pages; `words` are its own, `page` is what it shows.
pub(super) fn measured<W: Serialize, T: Serialize>(
    language: Language,
    templates: &[(&'static str, &'static str)],
    words: &W,
    page: &T,
) -> Result<String, ReportError> {
    let mut press = Press::new(language, MEASURED_STYLE)?;
    press.tera.add_raw_templates(templates.iter().copied())?;
    let mut context = press.common.clone();
    context.extend(Context::from_serialize(page)?);
    context.insert("t", words);
    let name = templates.first().map_or("", |(name, _)| name);
    Ok(press.tera.render(name, &context)?)
}

/// The templates with what all pages share.
struct Press {
    tera: Tera,
    common: Context,
}

impl Press {
    /// `more` is style beside that of all pages.
    fn new(language: Language, more: &str) -> Result<Self, ReportError> {
        let mut tera = Tera::new();
        tera.register_filter("fill", fill);
        tera.register_filter("length_class", |html: &str, _: Kwargs, _: &State| math::length_class(html));
        tera.add_raw_templates(TEMPLATES)?;
        let style = unix_lines(&format!("{STYLE}{more}"));
        let script = unix_lines(SCRIPT);
        let common = Common {
            version: env!("CARGO_PKG_VERSION"),
            tongue: language.tag(),
            w: language.words(),
            style_policy: hash(&style),
            style,
        };
        let mut common = Context::from_serialize(&common)?;
        common.insert("script_policy", &hash(&script));
        common.insert("script", &script);
        Ok(Press { tera, common })
    }

    fn print<T: Serialize>(&self, template: &str, name: &'static str, data: &T) -> Result<String, ReportError> {
        let mut context = self.common.clone();
        context.insert(name, data);
        Ok(self.tera.render(template, &context)?)
    }
}

/// A text as it stands within its element, whatever line ends the file had: what a browser takes the hash of.
fn unix_lines(text: &str) -> String {
    format!("\n{}", text.replace("\r\n", "\n"))
}

/// The source expression of a policy that lets this very text pass.
fn hash(text: &str) -> String {
    format!("'sha256-{}'", STANDARD.encode(Sha256::digest(text)))
}

/// Fills a text's places from the arguments: `{{ w.line | fill(n=eq.line) }}`. The result is escaped like everything else.
fn fill(text: &str, arguments: Kwargs, _: &State) -> tera::TeraResult<String> {
    let names: Vec<&str> = text.split('{').skip(1).filter_map(|rest| Some(rest.split_once('}')?.0)).collect();
    let mut places: Vec<(&str, String)> = Vec::new();
    for name in names {
        if let Some(value) = arguments.get::<tera::Value>(name)? {
            places.push((name, value.to_string()));
        }
    }
    let number = places.iter().find(|(name, _)| *name == "n").and_then(|(_, value)| value.parse().ok()).unwrap_or(2);
    let places: Vec<(&str, &dyn std::fmt::Display)> =
        places.iter().map(|(name, value)| (*name, value as &dyn std::fmt::Display)).collect();
    Ok(words::fill(text, number, &places))
}
