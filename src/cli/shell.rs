//! What shells want of a command: completions and a manual page.

use std::path::PathBuf;

use clap::CommandFactory;

use super::print_text;

/// The arguments of `kenzan completions`.
#[derive(Debug, clap::Args)]
pub struct Completions {
    /// The shell.
    #[arg(value_enum)]
    shell: clap_complete::Shell,
}

/// The arguments of `kenzan man`.
#[derive(Debug, clap::Args)]
pub struct Man {
    /// Write a page for each command into this folder, instead of printing that of kenzan.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

/// Prints the completions.
pub fn completions(arguments: &Completions) -> miette::Result<()> {
    let mut script = Vec::new();
    clap_complete::generate(arguments.shell, &mut super::Arguments::command(), "kenzan", &mut script);
    print_text(&String::from_utf8_lossy(&script));
    Ok(())
}

/// Prints the manual page, or writes all of them.
pub fn man(arguments: &Man) -> miette::Result<()> {
    let command = super::Arguments::command();
    let failed = |e: std::io::Error| miette::miette!("the manual page could not be written: {e}");
    if let Some(folder) = &arguments.out {
        std::fs::create_dir_all(folder).map_err(failed)?;
        return clap_mangen::generate_to(command, folder).map_err(failed);
    }
    let mut page = Vec::new();
    clap_mangen::Man::new(command).render(&mut page).map_err(failed)?;
    print_text(&String::from_utf8_lossy(&page));
    Ok(())
}
