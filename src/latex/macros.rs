//! What each macro means.

use std::collections::HashMap;
use std::sync::LazyLock;

use super::ast::{Accent, BigOp, Delim, Font, Mark, ProductOp, Rel, Sign};
use super::token::{Side, TokenKind};

/// What the tokenizer does with a macro.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Meaning {
    /// It is this token.
    Token(TokenKind),
    /// It prints nothing that matters.
    Skip,
    /// It and its arguments (so many) print nothing that matters.
    SkipArguments(u8),
    /// A text whose argument is taken as it stands.
    Text,
    /// A function whose name is the argument.
    OperatorName,
    /// `\left`, `\right` or `\middle`, followed by a delimiter.
    Stretch(Side),
    /// `\big` and the like, which may be followed by a bar.
    Sized(Side),
    /// `\begin`
    Begin,
    /// `\end`
    End,
    /// `\not`, which negates the relation after it.
    Not,
    /// A relation with an argument printed above it: `\xrightarrow{..}`.
    LabelledRelation(Rel),
}

/// What a macro means; the name has no backslash.
pub(super) fn meaning(name: &str) -> Option<Meaning> {
    MACROS.get(name).copied()
}

/// Whether a macro of that name is a function such as `\sin`.
pub(super) fn is_function(name: &str) -> bool {
    meaning(name) == Some(Meaning::Token(TokenKind::Function))
}

/// The known macro that a misspelt one was probably meant to be: the one fewest edits away, at most a third of its
/// letters.
pub(super) fn suggestion(name: &str) -> Option<&'static str> {
    const LONGEST_NAME: usize = 24;
    if name.len() > LONGEST_NAME {
        return None;
    }
    let near = |known: &str| (edits(&name.to_lowercase(), &known.to_lowercase()), edits(name, known));
    MACROS
        .keys()
        .filter(|known| known.len() > 1)
        .map(|known| (near(known), *known))
        .filter(|((edits, _), known)| *edits * 3 <= known.len().max(name.len()) + 1)
        .min()
        .map(|(_, known)| known)
}

/// The Levenshtein distance of two ASCII names.
fn edits(a: &str, b: &str) -> usize {
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.bytes().enumerate() {
        let mut diagonal = i;
        let mut left = i + 1;
        for (cell, y) in row.iter_mut().skip(1).zip(b.bytes()) {
            let replaced = diagonal + usize::from(x != y);
            diagonal = *cell;
            left = replaced.min(diagonal + 1).min(left + 1);
            *cell = left;
        }
        if let Some(first) = row.first_mut() {
            *first = i + 1;
        }
    }
    row.last().copied().unwrap_or(a.len())
}

const SYMBOLS: &str = "alpha beta gamma delta epsilon varepsilon zeta eta theta vartheta iota kappa varkappa lambda mu nu xi \
    omicron pi varpi rho varrho sigma varsigma tau upsilon phi varphi chi psi omega Gamma Delta Theta Lambda Xi Pi Sigma \
    Upsilon Phi Psi Omega varGamma varDelta varTheta varLambda varXi varPi varSigma varPhi varPsi varOmega ell hbar hslash \
    imath jmath partial nabla infty prime Re Im aleph wp forall exists nexists emptyset varnothing angle measuredangle \
    triangle square Box bullet star ast dagger ddagger degree top bot flat sharp natural clubsuit diamondsuit heartsuit \
    spadesuit odot surd neg lnot S P % # $ & _ AA";

const FUNCTIONS: &str = "sin cos tan cot sec csc arcsin arccos arctan arccot arg sinh cosh tanh coth sech csch exp log ln lg \
    max min sup inf lim limsup liminf det dim deg gcd ker hom Pr tr sgn";

const SKIPPED: &str = "displaystyle textstyle scriptstyle scriptscriptstyle limits nolimits nonumber notag hline hfill \
    , ; : ! > / thinspace medspace thickspace negthinspace negmedspace negthickspace enspace strut mathstrut allowbreak \
    nobreak noindent normalsize small footnotesize large Large LARGE huge tiny nobreakspace relax protect centering qedhere";

const PASSED: &str = "boxed mathop mathord mathbin mathrel mathopen mathclose mathpunct mathinner ensuremath mathnormal \
    smash";

const TEXTS: &str = "text mbox hbox textrm textbf textit textsf texttt textnormal textup textsl textsc intertext \
    shortintertext emph";

static MACROS: LazyLock<HashMap<&'static str, Meaning>> = LazyLock::new(|| {
    use Meaning::{Begin, End, LabelledRelation, Not, OperatorName, Sized, Skip, SkipArguments, Stretch, Text};
    let mut map = HashMap::new();
    let mut all = |names: &'static str, meaning: Meaning| {
        map.extend(names.split_whitespace().map(|name| (name, meaning)));
    };
    all(SYMBOLS, Meaning::Token(TokenKind::Symbol));
    all(FUNCTIONS, Meaning::Token(TokenKind::Function));
    all(SKIPPED, Skip);
    all(PASSED, Meaning::Token(TokenKind::Pass));
    all(TEXTS, Text);
    all("operatorname operatorname*", OperatorName);
    all(
        "tag tag* label hspace hspace* vspace vspace* phantom vphantom hphantom color eqno ref eqref cite",
        SkipArguments(1),
    );
    all("rule", SkipArguments(2));
    all("left", Stretch(Side::Open));
    all("right", Stretch(Side::Close));
    all("middle", Stretch(Side::Middle));
    all("big Big bigg Bigg", Sized(Side::Either));
    all("bigl Bigl biggl Biggl", Sized(Side::Open));
    all("bigr Bigr biggr Biggr", Sized(Side::Close));
    all("bigm Bigm biggm Biggm", Sized(Side::Middle));
    all("begin", Begin);
    all("end", End);
    all("not", Not);
    all("xrightarrow", LabelledRelation(Rel::To));
    all("xleftarrow", LabelledRelation(Rel::From));
    tokens(&mut all);
    map.insert(" ", Skip);
    map.insert("\n", Skip);
    map
});

/// The macros that are tokens of their own.
fn tokens(all: &mut impl FnMut(&'static str, Meaning)) {
    let mut all = |names, kind| all(names, Meaning::Token(kind));
    relations(&mut all);
    all("quad qquad", TokenKind::Quad);
    all("\\ cr newline", TokenKind::Row);
    all("pm", TokenKind::Sign(Sign::PlusMinus));
    all("mp", TokenKind::Sign(Sign::MinusPlus));
    all("cdot", TokenKind::Times(ProductOp::Dot));
    all("times", TokenKind::Times(ProductOp::Cross));
    all("div slash", TokenKind::Times(ProductOp::Slash));
    all("wedge land", TokenKind::Times(ProductOp::Wedge));
    all("otimes", TokenKind::Times(ProductOp::Tensor));
    all("circ bmod oplus ominus vee lor cup cap setminus backslash diamond", TokenKind::Times(ProductOp::Other));
    all("sum", TokenKind::BigOp(BigOp::Sum));
    all("prod", TokenKind::BigOp(BigOp::Product));
    all("int", TokenKind::BigOp(BigOp::Integral));
    all("iint", TokenKind::BigOp(BigOp::DoubleIntegral));
    all("oint", TokenKind::BigOp(BigOp::LoopIntegral));
    all("dots cdots ldots vdots ddots dotsb dotsc dotsi dotsm dotso", TokenKind::Ellipsis);
    all("therefore", TokenKind::Mark(Mark::Therefore));
    all("because", TokenKind::Mark(Mark::Because));
    all("mid", TokenKind::Comma);
    all("frac dfrac tfrac cfrac sfrac nicefrac", TokenKind::Frac);
    all("over", TokenKind::Over);
    all("sqrt", TokenKind::Sqrt);
    all("binom dbinom tbinom", TokenKind::Binom);
    all("substack", TokenKind::Substack);
    all("underbrace", TokenKind::Brace { over: false });
    all("overbrace", TokenKind::Brace { over: true });
    all("underset", TokenKind::Stack { over: false });
    all("overset stackrel", TokenKind::Stack { over: true });
    all("dot", TokenKind::Dots(1));
    all("ddot", TokenKind::Dots(2));
    all("dddot", TokenKind::Dots(3));
    all("ddddot", TokenKind::Dots(4));
    accents_and_fonts(&mut all);
    delimiters(&mut all);
}

fn accents_and_fonts(all: &mut impl FnMut(&'static str, TokenKind)) {
    all("vec overrightarrow", TokenKind::Accent(Accent::Vector));
    all("hat widehat", TokenKind::Accent(Accent::Hat));
    all("bar overline", TokenKind::Accent(Accent::Bar));
    all("tilde widetilde", TokenKind::Accent(Accent::Tilde));
    all(
        "check widecheck breve acute grave mathring underline overleftarrow underrightarrow",
        TokenKind::Accent(Accent::Other),
    );
    all("mathbf boldsymbol bm pmb bold", TokenKind::Font(Font::Bold));
    all("mathcal mathscr", TokenKind::Font(Font::Calligraphic));
    all("mathrm", TokenKind::Font(Font::Roman));
    all("mathit", TokenKind::Font(Font::Italic));
    all("mathbb", TokenKind::Font(Font::Blackboard));
    all("mathfrak", TokenKind::Font(Font::Fraktur));
    all("mathsf", TokenKind::Font(Font::SansSerif));
    all("mathtt", TokenKind::Font(Font::Typewriter));
    all("bf bfseries", TokenKind::Switch(Font::Bold));
    all("cal", TokenKind::Switch(Font::Calligraphic));
    all("rm rmfamily", TokenKind::Switch(Font::Roman));
    all("it itshape", TokenKind::Switch(Font::Italic));
    all("sf", TokenKind::Switch(Font::SansSerif));
    all("tt", TokenKind::Switch(Font::Typewriter));
}

fn delimiters(all: &mut impl FnMut(&'static str, TokenKind)) {
    all("{ lbrace", TokenKind::Open(Delim::Brace));
    all("} rbrace", TokenKind::Close(Delim::Brace));
    all("lbrack", TokenKind::Open(Delim::Bracket));
    all("rbrack", TokenKind::Close(Delim::Bracket));
    all("lparen", TokenKind::Open(Delim::Paren));
    all("rparen", TokenKind::Close(Delim::Paren));
    all("langle", TokenKind::Open(Delim::Angle));
    all("rangle", TokenKind::Close(Delim::Angle));
    all("lfloor", TokenKind::Open(Delim::Floor));
    all("rfloor", TokenKind::Close(Delim::Floor));
    all("lceil", TokenKind::Open(Delim::Ceil));
    all("rceil", TokenKind::Close(Delim::Ceil));
    let bar = |delim, side| TokenKind::Bar { delim, side, sized: false };
    all("vert", bar(Delim::Bar, Side::Either));
    all("lvert", bar(Delim::Bar, Side::Open));
    all("rvert", bar(Delim::Bar, Side::Close));
    all("| Vert", bar(Delim::DoubleBar, Side::Either));
    all("lVert", bar(Delim::DoubleBar, Side::Open));
    all("rVert", bar(Delim::DoubleBar, Side::Close));
}

fn relations(all: &mut impl FnMut(&'static str, TokenKind)) {
    let mut all = |names, rel| all(names, TokenKind::Relation(rel));
    all("equiv triangleq coloneqq coloneq", Rel::Equiv);
    all("ne neq", Rel::Ne);
    all("lt", Rel::Lt);
    all("gt", Rel::Gt);
    all("le leq leqq leqslant", Rel::Le);
    all("ge geq geqq geqslant", Rel::Ge);
    all("ll", Rel::Ll);
    all("gg", Rel::Gg);
    all("approx approxeq simeq fallingdotseq risingdotseq doteq doteqdot asymp", Rel::Approx);
    all("sim thicksim", Rel::Sim);
    all("cong", Rel::Cong);
    all("propto varpropto", Rel::Propto);
    all("to rightarrow longrightarrow mapsto longmapsto nearrow searrow leadsto rightsquigarrow", Rel::To);
    all("leftarrow gets longleftarrow", Rel::From);
    all("leftrightarrow longleftrightarrow rightleftharpoons", Rel::Exchange);
    all("Rightarrow implies Longrightarrow", Rel::Implies);
    all("Leftarrow impliedby Longleftarrow", Rel::ImpliedBy);
    all("Leftrightarrow iff Longleftrightarrow", Rel::Iff);
    all("parallel", Rel::Parallel);
    all("perp", Rel::Perp);
    all("in", Rel::In);
    all("colon", Rel::Ratio);
}
