//! The command `kenzan lsp`.

use crate::lsp;

use super::options::{self, Diagnosis, Sampling};

/// The arguments of `kenzan lsp`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// What editors add to say how they talk; there is no other way.
    #[arg(long, hide = true)]
    stdio: bool,
    #[command(flatten)]
    sampling: Sampling,
    #[command(flatten)]
    diagnosis: Diagnosis,
}

/// Serves until the editor ends it.
pub fn run(arguments: &Arguments) -> miette::Result<()> {
    let config = options::config()?;
    let options = arguments.sampling.options(&config)?;
    let request = arguments.diagnosis.request(options, Vec::new(), &config);
    let jobs = arguments.sampling.jobs(&config)?.map_or(0, usize::from);
    lsp::serve(request, jobs).map_err(|e| miette::miette!("the language server could not be started: {e}"))
}
