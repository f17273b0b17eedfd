//! stub
use super::ast::*;
/// e
#[derive(Clone, Debug, PartialEq)]
pub struct ParseError {
    /// m
    pub message: String,
    /// s
    pub span: Span,
    /// h
    pub help: Option<String>,
}
/// p
pub fn parse(_: &str) -> Result<Node, ParseError> {
    Ok(Node::new(Kind::Empty, 0..0))
}
/// t
pub fn to_latex(_: &Node) -> String {
    String::new()
}
