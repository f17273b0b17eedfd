//! `report.html`: one file that needs no network, no script and no other file.

use super::{Options, ReportError, Run, view};
use tera::{Context, Tera};

/// The templates by the names under which they include each other. The names end in `.html`, so what they are given is
/// escaped.
const TEMPLATES: [(&str, &str); 14] = [
    ("report.html", include_str!("../../templates/report.html")),
    ("summary.html", include_str!("../../templates/summary.html")),
    ("map.html", include_str!("../../templates/map.html")),
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

/// The run as a page.
///
/// # Errors
/// [`ReportError::Template`]: a template does not fit the data, which is a defect of Kenzan.
pub fn render(run: &Run, options: Options) -> Result<String, ReportError> {
    let mut tera = Tera::new();
    tera.add_raw_templates(TEMPLATES)?;
    let mut context = Context::from_serialize(&view::page(run, options))?;
    context.insert("style", STYLE);
    Ok(tera.render("report.html", &context)?)
}
