//! The command `kenzan explain`.

use std::path::PathBuf;

use crate::explain;

use super::options::{self, Sampling};
use super::{AS_EXPECTED, in_pool, print_text};

/// The arguments of `kenzan explain`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The notes.
    path: PathBuf,
    /// The equation's label.
    label: String,
    #[command(flatten)]
    sampling: Sampling,
}

/// Explains an equation.
pub fn run(arguments: &Arguments) -> miette::Result<u8> {
    let config = options::config()?;
    let (options, jobs) = (arguments.sampling.options(&config)?, arguments.sampling.jobs(&config)?);
    let document = crate::document::read(&arguments.path)?;
    in_pool(jobs, || match explain::explain(&document, &arguments.label, &options) {
        Some(text) => {
            print_text(&text);
            Ok(AS_EXPECTED)
        }
        None => Err(miette::miette!(
            help = "labels are as printed; a display without a number has the label before it with +1, +2 ...",
            "there is no equation {} in {}",
            arguments.label,
            arguments.path.display()
        )),
    })
}
