//! `kenzan speed`: what accuracy costs in each scene.

use std::path::PathBuf;

use super::options::{self, Words};
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
    /// How many periods the constants of motions are followed through, where no scene is named.
    #[arg(long, default_value_t = 10_000, value_parser = clap::value_parser!(u32).range(0..=10_000_000))]
    periods: u32,
    #[command(flatten)]
    words: Words,
}

/// Measures, writes the page and the data, prints what each scene takes.
pub fn run(arguments: &Arguments) -> miette::Result<()> {
    let language = arguments.words.language(&options::config()?)?;
    let measured = speed(&arguments.scenes, arguments.periods)?;
    let written = report::speed::write(&measured, &arguments.out, language)?;
    let tables: Vec<String> = measured.scenes.iter().map(|scene| report::speed::table(scene, language)).collect();
    let growth = report::speed::growth(&measured.drifts, language);
    let place = report::words::where_to_begin(language, &written.html);
    super::print_text(&format!("{}\n{growth}\n{place}\n", tables.join("\n")));
    Ok(())
}
