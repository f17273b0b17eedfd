//! What a quantity is as a function: where a derivative of it is taken by something else than the time, or where it is
//! integrated, the notes have said before what it is, `\phi = Q / 4 \pi \varepsilon_0 r`.

use std::sync::Arc;

use crate::check::{Book, Version};
use crate::document::{Arguments, Document, Spanned, SymbolDeclaration};
use crate::latex::ast::{Delim, Kind, Node};
use crate::latex::to_latex;
use crate::semantics::{self, spelling};

use super::candidates::inline;
use super::evidence::{Evidence, names};

/// Declares, for each equation with such a derivative, what is derived.
pub fn declare_functions(book: &mut Book, document: &Document) {
    for (index, declarations) in functions(book, document) {
        let scope = book.entries[index].scope.with_local(&declarations, &mut Vec::new());
        book.entries[index].scope = Arc::new(scope);
    }
}

/// For each equation with such a derivative, by its number, what is derived: by the last formula for it before.
pub fn functions(book: &Book, document: &Document) -> Vec<(usize, Vec<SymbolDeclaration>)> {
    let displays = book.entries.iter().filter_map(|entry| {
        let tree = entry.formula(Version::Printed).tree.as_ref().ok()?;
        Some((entry.equation.span.start, tree.clone()))
    });
    let inline = inline(document).filter_map(|(span, formula)| Some((span.start, formula.tree.ok()?)));
    let mut known: Vec<(usize, Node)> = displays.chain(inline).collect();
    known.sort_by_key(|(at, _)| *at);
    let mut found = Vec::new();
    for (index, entry) in book.entries.iter().enumerate() {
        let Ok(tree) = &entry.formula(Version::Printed).tree else { continue };
        let mut evidence = Evidence::default();
        evidence.look(tree);
        let at = entry.equation.span.start;
        let dependent = evidence.derived.iter().chain(&evidence.integrated);
        let declared = dependent.filter_map(|(name, variables)| {
            let mut before = known.iter().rev().filter(|(place, _)| *place < at);
            let formula = before.find_map(|(_, tree)| formula(tree, name, variables.iter()))?;
            Some(declaration(name, variables.iter(), &formula, at))
        });
        let declarations: Vec<SymbolDeclaration> = declared.collect();
        if !declarations.is_empty() {
            found.push((index, declarations));
        }
    }
    found
}

/// A side beside a name (perhaps with its arguments) that speaks of the variables and not of the name.
fn formula<'v>(tree: &Node, name: &str, variables: impl Iterator<Item = &'v String>) -> Option<Node> {
    let variables: Vec<&String> = variables.collect();
    let statement = semantics::statement(tree, None).ok()?;
    let is_it = |side: &Node| match &side.kind {
        Kind::Juxt(factors) => {
            matches!(factors.as_slice(), [head, Node { kind: Kind::Group { open: Delim::Paren, .. }, .. }] if spelling(head) == name)
        }
        _ => spelling(side) == name,
    };
    let mut is_side = false;
    let mut found = None;
    let mut last: Option<&Node> = None;
    for clause in &statement.clauses {
        // In a = b = c, b = c says what a is, too.
        let goes_on = clause.continued || last == Some(&clause.lhs);
        is_side = if goes_on { is_side } else { is_it(&clause.lhs) };
        let semantics::Side::Node(rhs) = &clause.rhs else { continue };
        last = Some(rhs);
        let mut mentioned = Vec::new();
        names(rhs, &mut |n| mentioned.push(n));
        let fits = variables.iter().all(|v| mentioned.contains(v)) && !mentioned.iter().any(|n| n == name);
        if is_side && fits {
            found = Some(rhs.clone());
        }
    }
    found
}

fn declaration<'v>(
    name: &str,
    variables: impl Iterator<Item = &'v String>,
    formula: &Node,
    at: usize,
) -> SymbolDeclaration {
    let text = |value: &str| Spanned::new(value.to_owned(), at..at + value.len());
    SymbolDeclaration {
        names: vec![text(name)],
        function: Some(Arguments::Names(variables.map(|v| text(v)).collect())),
        same: Some(text(&to_latex(formula))),
        span: at..at,
        ..SymbolDeclaration::default()
    }
}
