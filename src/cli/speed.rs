//! `kenzan speed`: what accuracy costs in each scene.

use std::path::PathBuf;

use crate::report;
use crate::speed::speed;

/// The arguments of `kenzan speed`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The scenes; all of them where none is named.
    scenes: Vec<String>,
    /// The directory of speed.html and speed.json.
    #[arg(long, default_value = "out")]
    out: PathBuf,
}

/// Measures, writes the page and the data, prints what each scene takes.
pub fn run(arguments: &Arguments) -> miette::Result<()> {
    let measured = speed(&arguments.scenes)?;
    let written = report::speed::write(&measured, &arguments.out)?;
    let tables: Vec<String> = measured.iter().map(report::speed::table).collect();
    super::print_text(&format!("{}\nreport: {}\n", tables.join("\n"), written.html.display()));
    Ok(())
}
