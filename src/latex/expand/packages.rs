//! Macros of packages in common use, written as the packages' authors would: by a specification of their arguments and
//! what they stand for. What an optional argument or a mark decides is said as in LaTeX, with `\IfNoValueTF`,
//! `\IfValueT` and `\IfBooleanTF`, which are rules here, like what no body can say (`\qty`, units).

use std::collections::HashMap;
use std::sync::LazyLock;

use super::super::error::ParseError;
use super::argument::Argument;
use super::lexer::{Kind, Token};
use super::{Expander, Macro, define, siunitx};

/// What is done for a macro that no body can say.
pub(super) type Rule = for<'a> fn(&mut Expander<'a>, &Token<'a>) -> Result<(), ParseError>;

/// What a package means by a macro.
pub(super) enum Meaning {
    Macro(Macro),
    Rule(Rule),
}

/// A macro of a package.
pub(super) struct Packaged {
    package: &'static str,
    pub(super) meaning: Meaning,
}

impl Packaged {
    /// Whether the macro means this although LaTeX knows it otherwise: its package is loaded, or it is used with an
    /// argument in braces (`\div{..}`) in notes that load no package at all.
    pub(super) fn is_meant(&self, expander: &Expander) -> bool {
        let packages = &expander.macros.all.packages;
        let needs_braces = matches!(&self.meaning, Meaning::Macro(found) if found.takes_braces());
        packages.contains(self.package) || (packages.is_empty() && needs_braces && expander.next_is('{'))
    }
}

/// The macro of a package, by its name without the backslash.
pub(super) fn find(name: &str) -> Option<&'static Packaged> {
    PACKAGED.get(name)
}

static PACKAGED: LazyLock<HashMap<&'static str, Packaged>> = LazyLock::new(|| {
    let mut all = HashMap::new();
    for (package, table) in [("physics", PHYSICS), ("", OTHERS)] {
        for (names, specified, body) in table {
            for name in names.split_whitespace() {
                if let Some(found) = define::of_package(specified, body) {
                    all.insert(name, Packaged { package, meaning: Meaning::Macro(found) });
                }
            }
        }
    }
    for name in FUNCTIONS_WITH_POWERS.split_whitespace() {
        let body = format!("\\{name}\\IfValueT{{#1}}{{^{{#1}}}}");
        if let Some(found) = define::of_package("o", &body) {
            all.insert(name, Packaged { package: "physics", meaning: Meaning::Macro(found) });
        }
    }
    let rules: [(&'static str, &'static str, Rule); 15] = [
        ("IfNoValueTF", "", |expander, token| if_no_value(expander, token, [true, true])),
        ("IfNoValueT", "", |expander, token| if_no_value(expander, token, [true, false])),
        ("IfNoValueF", "", |expander, token| if_no_value(expander, token, [false, true])),
        ("IfValueTF", "", |expander, token| if_value(expander, token, [true, true])),
        ("IfValueT", "", |expander, token| if_value(expander, token, [true, false])),
        ("IfValueF", "", |expander, token| if_value(expander, token, [false, true])),
        ("IfBooleanTF", "", |expander, token| if_true(expander, token, [true, true])),
        ("IfBooleanT", "", |expander, token| if_true(expander, token, [true, false])),
        ("IfBooleanF", "", |expander, token| if_true(expander, token, [false, true])),
        ("qty", "physics", quantity),
        ("SI", "siunitx", siunitx::quantity),
        ("num", "siunitx", siunitx::number),
        ("si", "siunitx", siunitx::unit),
        ("unit", "siunitx", siunitx::unit),
        ("ang", "siunitx", siunitx::angle),
    ];
    all.extend(rules.map(|(name, package, rule)| (name, Packaged { package, meaning: Meaning::Rule(rule) })));
    all
});

const FUNCTIONS_WITH_POWERS: &str = "sin cos tan sec csc cot arcsin arccos arctan sinh cosh tanh sech csch coth log ln";

/// Names, arguments, body.
type Table = &'static [(&'static str, &'static str, &'static str)];

/// The package physics, and what its successors call alike.
const PHYSICS: Table = &[
    ("abs absolutevalue", "s m", r"\left|#2\right|"),
    ("norm", "s m", r"\left\|#2\right\|"),
    ("order", "m", r"\mathcal{O}\left(#1\right)"),
    ("eval evaluated", "s m", r"\left.#2\right|"),
    // Not [a, b], which are two numbers.
    ("comm commutator", "s m m", r"\operatorname{comm}\left(#2,#3\right)"),
    ("acomm anticommutator", "s m m", r"\operatorname{acomm}\left(#2,#3\right)"),
    ("pb poissonbracket", "s m m", r"\left\{#2,#3\right\}"),
    ("vb vectorbold", "s m", r"\mathbf{#2}"),
    ("va vectorarrow", "s m", r"\vec{#2}"),
    ("vu vectorunit", "s m", r"\hat{\mathbf{#2}}"),
    ("vdot dotproduct dp", "", r"\cdot"),
    ("cross crossproduct cp", "", r"\times"),
    ("grad gradient", "g", r"\nabla\IfValueT{#1}{#1}"),
    ("div divergence", "g", r"\nabla\cdot\IfValueT{#1}{#1}"),
    ("curl", "g", r"\nabla\times\IfValueT{#1}{#1}"),
    ("laplacian", "g", r"\nabla^{2}\IfValueT{#1}{#1}"),
    ("Tr trace Trace", "", r"\tr"),
    ("rank", "", r"\operatorname{rank}"),
    ("Res Residue", "", r"\operatorname{Res}"),
    ("erf", "", r"\operatorname{erf}"),
    ("flatfrac", "m m", r"\frac{#1}{#2}"),
    ("dd differential", "o g d()", r"\mathrm{d}\IfValueT{#1}{^{#1}}\IfValueT{#2}{#2}\IfValueT{#3}{(#3)}"),
    ("var variation", "o g d()", r"\delta\IfValueT{#1}{^{#1}}\IfValueT{#2}{#2}\IfValueT{#3}{(#3)}"),
    (
        "dv odv derivative",
        "s o m g d()",
        r"\IfNoValueTF{#4}{\frac{\mathrm{d}\IfValueT{#2}{^{#2}}}{\mathrm{d}#3\IfValueT{#2}{^{#2}}}}{\frac{\mathrm{d}\IfValueT{#2}{^{#2}}#3}{\mathrm{d}#4\IfValueT{#2}{^{#2}}}}\IfValueT{#5}{\left(#5\right)}",
    ),
    (
        "pdv partialderivative pderivative",
        "s o m g g d()",
        r"\IfNoValueTF{#4}{\frac{\partial\IfValueT{#2}{^{#2}}}{\partial#3\IfValueT{#2}{^{#2}}}}{\IfNoValueTF{#5}{\frac{\partial\IfValueT{#2}{^{#2}}#3}{\partial#4\IfValueT{#2}{^{#2}}}}{\frac{\partial^{2}#3}{\partial#4\partial#5}}}\IfValueT{#6}{\left(#6\right)}",
    ),
    ("bra", "s m", r"\left\langle#2\right|"),
    ("ket", "s m", r"\left|#2\right\rangle"),
    ("braket ip innerproduct", "s m g", r"\left\langle#2\IfValueT{#3}{|#3}\right\rangle"),
    ("expval ev expectationvalue", "s m g", r"\left\langle\IfValueT{#3}{#3|}#2\IfValueT{#3}{|#3}\right\rangle"),
    ("qq", "s m", r"\quad\text{#2}\quad"),
    ("qcomma qc", "", r",\quad"),
    ("qif", "", r"\quad\text{if}\quad"),
    ("qthen", "", r"\quad\text{then}\quad"),
    ("qand", "", r"\quad\text{and}\quad"),
    ("qwhere", "", r"\quad\text{where}\quad"),
    ("qfor", "", r"\quad\text{for}\quad"),
    ("qwith", "", r"\quad\text{with}\quad"),
    (
        "mqty matrixquantity",
        "d() g",
        r"\IfValueT{#1}{\begin{pmatrix}#1\end{pmatrix}}\IfValueT{#2}{\begin{matrix}#2\end{matrix}}",
    ),
    ("pmqty", "m", r"\begin{pmatrix}#1\end{pmatrix}"),
    ("bmqty", "m", r"\begin{bmatrix}#1\end{bmatrix}"),
    ("vmqty mdet", "m", r"\begin{vmatrix}#1\end{vmatrix}"),
];

/// Packages whose names mean nothing else, so that it does not matter which is loaded.
const OTHERS: Table = &[
    ("diff", "o m m", r"\frac{\mathrm{d}\IfValueT{#1}{^{#1}}#2}{\mathrm{d}#3\IfValueT{#1}{^{#1}}}"),
    ("diffp", "o m m", r"\frac{\partial\IfValueT{#1}{^{#1}}#2}{\partial#3\IfValueT{#1}{^{#1}}}"),
    ("symbf symbfit mathbfit symbfup", "m", r"\mathbf{#1}"),
    ("symrm symup mathup", "m", r"\mathrm{#1}"),
    ("cancel bcancel xcancel", "m", "#1"),
    ("cancelto", "m m", "{#1}"),
    ("textcolor", "o m m", "{#3}"),
    ("mathclap mathllap mathrlap clap", "m", "#1"),
    ("xspace", "", ""),
    ("dif", "", r"\mathrm{d}"),
    ("uppi", "", r"\pi"),
    ("upmu", "", r"\mu"),
    ("upepsilon", "", r"\epsilon"),
    ("eqdef vcentcolon", "", r"\coloneqq"),
    ("intd", "", r"\int"),
    ("mathds mathbbm", "m", r"\mathbb{#1}"),
];

/// The branch of a condition that is chosen; `written` says which branches the macro takes.
fn branch<'a>(
    expander: &mut Expander<'a>,
    token: &Token<'a>,
    written: [bool; 2],
    condition: fn(&[Token]) -> bool,
) -> Result<(), ParseError> {
    let chosen = usize::from(!condition(&expander.mandatory(token)?));
    for (at, is_written) in written.into_iter().enumerate() {
        if is_written {
            let tokens = expander.mandatory(token)?;
            if at == chosen {
                // What is behind the branches waits behind what the branch holds.
                expander.hold(tokens, written == [true, true] && at == 0, token)?;
                return Ok(());
            }
        }
    }
    Ok(())
}

fn is_missing(tokens: &[Token]) -> bool {
    matches!(tokens, [token] if token.kind == Kind::NoValue)
}

fn if_no_value<'a>(expander: &mut Expander<'a>, token: &Token<'a>, written: [bool; 2]) -> Result<(), ParseError> {
    branch(expander, token, written, is_missing)
}

fn if_value<'a>(expander: &mut Expander<'a>, token: &Token<'a>, written: [bool; 2]) -> Result<(), ParseError> {
    branch(expander, token, written, |tokens| !is_missing(tokens))
}

fn if_true<'a>(expander: &mut Expander<'a>, token: &Token<'a>, written: [bool; 2]) -> Result<(), ParseError> {
    branch(expander, token, written, |tokens| matches!(tokens, [token] if token.kind == Kind::True))
}

impl Macro {
    /// Whether its first argument is a group in braces that may be left out.
    fn takes_braces(&self) -> bool {
        matches!(self.parameters.first(), Some(super::Parameter::Optional('{', ..)))
    }
}

impl<'a> Expander<'a> {
    /// Puts the tokens of a branch in the place of a condition; another branch that follows is passed over first.
    fn hold(&mut self, tokens: Vec<Token<'a>>, another: bool, token: &Token<'a>) -> Result<(), ParseError> {
        if another {
            self.mandatory(token)?;
        }
        self.made += tokens.len().max(1);
        self.waiting.extend(tokens.into_iter().rev());
        Ok(())
    }
}

/// `\qty(..)`, `\qty[..]`, `\qty|..|` and `\qty{..}` of physics; `\qty{3}{\metre}` of siunitx.
fn quantity<'a>(expander: &mut Expander<'a>, token: &Token<'a>) -> Result<(), ParseError> {
    let pairs = [('(', ')', r"\left(#1\right)"), ('[', ']', r"\left[#1\right]"), ('|', '|', r"\left|#1\right|")];
    for (open, close, body) in pairs {
        let is_option = open == '[' && expander.macros.has_package("siunitx");
        if !is_option && let Some(tokens) = expander.delimited(open, close) {
            expander.put(body, &[Argument::Given(tokens)], token, true);
            return Ok(());
        }
    }
    if siunitx::is_quantity(expander) {
        return siunitx::quantity(expander, token);
    }
    let tokens = expander.mandatory(token)?;
    expander.put(r"\left\{#1\right\}", &[Argument::Given(tokens)], token, true);
    Ok(())
}
