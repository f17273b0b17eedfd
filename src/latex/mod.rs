//! The LaTeX of one equation, read into a syntax tree in which every node knows its bytes.
//!
//! Macros are expanded first ([`expand`]). The way of a formula then: `tokenizer` splits it into tokens; `matching` pairs `\left` with `\right`, braces and
//! environments, then brackets and bars; `layout` decides which row breaks and wide spaces separate statements and
//! forgets the others; `parser` reads what is left by recursive descent. Each step takes linear time, and the nesting
//! is limited, so that no input overflows the stack.

pub mod ast;
mod characters;
pub mod diff;
mod error;
pub mod expand;
mod layout;
mod macros;
mod matching;
mod parser;
mod token;
mod tokenizer;
mod unparse;
mod walk;

#[cfg(test)]
mod tests;

pub use error::ParseError;
pub use unparse::to_latex;

use ast::Node;

/// The longest formula that is read, in bytes: far beyond any that fits on a page.
const LONGEST: usize = 1 << 20;

/// Reads one formula. The spans of the tree and of the error are bytes of `source`; a blank source is
/// [`ast::Kind::Empty`].
///
/// # Errors
/// The formula is no LaTeX mathematics, is nested more than a hundred deep, or is longer than a mebibyte.
pub fn parse(source: &str) -> Result<Node, ParseError> {
    if source.len() > LONGEST {
        let message = format!("a formula of {} bytes; at most {LONGEST} are read", source.len());
        return Err(ParseError::new(message, 0..0).help("is a `$$` missing somewhere before?"));
    }
    let tokens = tokenizer::tokenize(source)?;
    let tokens = matching::match_delimiters(source, tokens)?;
    let tokens = matching::match_brackets(source, tokens)?;
    let tokens = layout::lay_out(source, tokens)?;
    parser::parse_tokens(source, tokens)
}
