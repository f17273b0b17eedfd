//! `kenzan init` and `kenzan symbols`: a scaffold of annotations for notes that have none, and what their symbols are.

use std::path::PathBuf;

use crate::check::Options;
use crate::document::{self, Problem};
use crate::init::scaffold;
use crate::symbols;
use crate::verify::Request;

/// The arguments of `kenzan init`.
#[derive(Debug, clap::Args)]
pub struct Init {
    /// The notes.
    path: PathBuf,
    /// Write annotations into the notes, instead of the sidecar NAME.kenzan.toml beside them.
    #[arg(long)]
    in_place: bool,
    /// Print what would be written, and write nothing.
    #[arg(long)]
    dry_run: bool,
    /// Write over a sidecar that exists.
    #[arg(long)]
    force: bool,
}

/// The arguments of `kenzan symbols`.
#[derive(Debug, clap::Args)]
pub struct Symbols {
    /// The notes.
    path: PathBuf,
}

/// Writes the scaffold.
pub fn init(arguments: &Init) -> miette::Result<()> {
    let document = document::read(&arguments.path)?;
    let request = Request { options: Options::default(), ..Request::default() };
    let Some(scaffold) = scaffold(&document, &request) else {
        return Err(miette::miette!(
            help = "`kenzan symbols` lists what is declared; `kenzan verify` judges by it",
            "{} declares its symbols already",
            arguments.path.display()
        ));
    };
    let (path, text) = match arguments.in_place {
        false => (arguments.path.with_extension("kenzan.toml"), scaffold.sidecar.clone()),
        true => match scaffold.in_place(&document) {
            Some(text) => (arguments.path.clone(), text),
            None => {
                return Err(miette::miette!(
                    help = "leave --in-place out: a sidecar is for all of the files",
                    "{} has several files",
                    arguments.path.display()
                ));
            }
        },
    };
    if arguments.dry_run {
        super::print_text(&text);
        return Ok(());
    }
    if !arguments.in_place && !arguments.force && path.exists() {
        return Err(miette::miette!(
            help = "--force writes over it, --dry-run shows what would be written",
            "{} exists already",
            path.display()
        ));
    }
    std::fs::write(&path, text).map_err(|e| {
        miette::miette!(help = "check that you may write there", "{} could not be written: {e}", path.display())
    })?;
    super::print_text(&format!(
        "{} written: read it, mend what was guessed wrong, and run\n\n    kenzan verify {}\n",
        path.display(),
        arguments.path.display()
    ));
    Ok(())
}

/// Lists the symbols, and what is odd about them.
pub fn symbols(arguments: &Symbols) -> miette::Result<()> {
    let document = document::read(&arguments.path)?;
    let listed = symbols::symbols(&document);
    let width = |text: &dyn Fn(&symbols::Listed) -> usize| listed.iter().map(text).max().unwrap_or(0).min(60);
    let (symbol, role) = (width(&|l| l.symbol.chars().count()), width(&|l| l.role.chars().count()));
    let mut text = String::new();
    for l in &listed {
        let mentioned = match l.mentioned.as_slice() {
            [] => "nowhere".to_owned(),
            [only] => format!("({only})"),
            [first, .., last] => format!("({first}) … ({last}), {} equations", l.mentioned.len()),
        };
        text.push_str(&format!("{:symbol$}  {:role$}  line {:<5} {mentioned}\n", l.symbol, l.role, l.line));
    }
    let guessed = listed.iter().filter(|l| l.guessed).count();
    match guessed {
        0 => text.push_str(&format!("\n{} symbols, declared\n", listed.len())),
        _ => text.push_str(&format!(
            "\n{guessed} symbols, guessed: `kenzan init {}` writes declarations to edit\n",
            arguments.path.display()
        )),
    }
    super::print_text(&text);
    let problems: Vec<Problem> = document.problems.iter().cloned().chain(symbols::lints(&document)).collect();
    for problem in &problems {
        eprintln!("{:?}", problem.to_miette(&document));
    }
    Ok(())
}
