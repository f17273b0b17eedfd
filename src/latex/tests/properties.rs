//! Properties of all trees and all sources.

use std::time::{Duration, Instant};

use proptest::prelude::*;

use super::{check_spans, short};
use crate::latex::ast::{Accent, BigOp, Delim, Font, Kind, Link, Mark, MatrixEnv, Node, ProductOp, Rel, Sign, Term};
use crate::latex::{parse, to_latex};

fn node(kind: Kind) -> Node {
    Node::new(kind, 0..0)
}

fn letter() -> Node {
    node(Kind::Symbol("x".to_owned()))
}

fn boxed(node: Node) -> Box<Node> {
    Box::new(node)
}

/// What binds strongest, over arguments of any kind.
fn base(argument: impl Strategy<Value = Node> + Clone + 'static) -> BoxedStrategy<Node> {
    let any = move || argument.clone().prop_map(boxed);
    let optional = prop::option::of(any());
    let same = [Delim::Paren, Delim::Bracket, Delim::Brace, Delim::Bar, Delim::DoubleBar, Delim::Angle, Delim::None];
    let mixed = [(Delim::None, Delim::Brace), (Delim::Paren, Delim::Bracket)];
    let delims = prop::sample::select(same.into_iter().map(|d| (d, d)).chain(mixed).collect::<Vec<_>>());
    prop_oneof![
        4 => leaf(),
        1 => (prop_oneof![Just(Font::Bold), Just(Font::Calligraphic)], any()).prop_map(|(f, b)| node(Kind::Styled(f, b))),
        1 => (prop_oneof![Just(Accent::Vector), Just(Accent::Bar), Just(Accent::Hat)], any())
            .prop_map(|(a, b)| node(Kind::Accent(a, b))),
        1 => (1..4_u8, any()).prop_map(|(n, b)| node(Kind::Dots(n, b))),
        2 => (any(), any()).prop_map(|(a, b)| node(Kind::Frac(a, b))),
        1 => (optional, any()).prop_map(|(index, body)| node(Kind::Sqrt { index, body })),
        2 => (delims, any()).prop_map(|((open, close), body)| node(Kind::Group { open, close, body })),
        1 => matrix(any().prop_map(|cell| *cell).boxed()),
    ]
    .boxed()
}

fn leaf() -> BoxedStrategy<Node> {
    prop_oneof![
        "[a-zA-Z]".prop_map(Kind::Symbol),
        prop::sample::select(vec!["\\theta", "\\ell", "\\partial", "\\infty"]).prop_map(|s| Kind::Symbol(s.to_owned())),
        "[1-9][0-9]{0,4}(\\.[0-9]{1,3})?".prop_map(Kind::Number),
        prop::sample::select(vec!["sin", "max", "sn", "dn"]).prop_map(|s| Kind::Function(s.to_owned())),
        prop_oneof![Just(BigOp::Sum), Just(BigOp::Integral), Just(BigOp::Product)].prop_map(Kind::BigOp),
        Just(Kind::Ellipsis),
        Just(Kind::Empty),
    ]
    .prop_map(node)
    .boxed()
}

fn matrix(cell: BoxedStrategy<Node>) -> BoxedStrategy<Node> {
    let env = prop_oneof![
        Just(MatrixEnv::Matrix),
        Just(MatrixEnv::Determinant),
        Just(MatrixEnv::Array),
        Just(MatrixEnv::Cases)
    ];
    let rows = (1..3_usize).prop_flat_map(move |columns| {
        prop::collection::vec(prop::collection::vec(cell.clone(), columns..=columns), 1..3)
    });
    // A lone empty cell is no row.
    let printed = |mut rows: Vec<Vec<Node>>| {
        rows.iter_mut().filter(|row| row.len() == 1 && row[0].kind == Kind::Empty).for_each(|row| row[0] = letter());
        rows
    };
    (env, rows.prop_map(printed)).prop_map(|(env, rows)| node(Kind::Matrix { env, rows })).boxed()
}

/// What would be read as a prime in a superscript.
fn is_prime(node: &Node) -> bool {
    match &node.kind {
        Kind::Scripts { base, sub: None, sup: None, .. } => base.kind == Kind::Empty,
        kind => *kind == Kind::Empty,
    }
}

/// A base with scripts, factorials, notes or a condition.
fn factor(argument: BoxedStrategy<Node>) -> BoxedStrategy<Node> {
    let any = { move || argument.clone() };
    let script = || prop::option::of(any().prop_map(|n| if is_prime(&n) { letter() } else { n }).prop_map(boxed));
    let not_an_evaluation = |n: &Node| !matches!(n.kind, Kind::Group { open: Delim::None, close: Delim::Bar, .. });
    let scripts = (base(any()).prop_filter("an evaluation", not_an_evaluation), 0..3_u8, script(), script()).prop_map(
        |(base, primes, sub, sup)| {
            let primes = if sub.is_none() && sup.is_none() { primes.max(1) } else { primes };
            Kind::Scripts { base: boxed(base), primes, sub, sup }
        },
    );
    let annotated = (any(), prop::option::of(any()), proptest::bool::ANY)
        .prop_map(|(body, note, over)| Kind::Annotated { body: boxed(body), note: note.map(boxed), over });
    prop_oneof![
        4 => base(any()),
        3 => scripts.prop_map(node),
        1 => (1..3_u8, base(any())).prop_map(|(n, body)| node(Kind::Factorial(n, boxed(body)))),
        1 => annotated.prop_map(node),
        1 => (any(), any()).prop_map(|(body, at)| node(Kind::At { body: boxed(body), at: boxed(at) })),
    ]
    .boxed()
}

/// Statements over arguments.
fn statement(argument: BoxedStrategy<Node>) -> BoxedStrategy<Node> {
    let not_blank = |n: Node| if n.kind == Kind::Empty { letter() } else { n };
    let factors = prop::collection::vec(factor(argument.clone()).prop_map(not_blank), 2..4);
    let juxt = prop_oneof![2 => factor(argument), 1 => factors.prop_map(Kind::Juxt).prop_map(node)].boxed();
    let op = prop_oneof![Just(ProductOp::Dot), Just(ProductOp::Cross), Just(ProductOp::Slash)];
    let product = (juxt.clone(), prop::collection::vec((op, juxt.clone()), 1..3))
        .prop_map(|(first, rest)| node(Kind::Product { first: boxed(first), rest }));
    let product = prop_oneof![3 => juxt, 1 => product].boxed();
    let sign = prop_oneof![Just(Sign::Plus), Just(Sign::Minus), Just(Sign::PlusMinus)];
    let term = (sign, product.clone()).prop_map(|(sign, node)| Term { sign, sign_span: Some(0..0), node });
    let sum = (prop::option::of(product.clone()), prop::collection::vec(term, 1..3)).prop_map(|(first, mut terms)| {
        if let Some(node) = first {
            terms.insert(0, Term { sign: Sign::Plus, sign_span: None, node });
        }
        node(Kind::Sum(terms))
    });
    let side = prop_oneof![2 => product, 1 => sum].boxed();
    let rel = prop_oneof![Just(Rel::Eq), Just(Rel::Lt), Just(Rel::Implies), Just(Rel::Ratio)];
    let link = (rel, side.clone()).prop_map(|(rel, rhs)| Link { rel, rel_span: 0..0, rhs });
    let chain = (prop::option::of(side.clone().prop_map(boxed)), prop::collection::vec(link, 1..3))
        .prop_map(|(first, links)| node(Kind::Chain { first, links }));
    let chain = prop_oneof![2 => side, 1 => chain].boxed();
    let marked = prop_oneof![
        5 => chain.clone(),
        1 => chain.clone().prop_map(|c| node(Kind::Marked(Mark::Therefore, boxed(c)))),
    ];
    prop_oneof![
        4 => marked.clone(),
        1 => prop::collection::vec(chain, 2..4).prop_map(|items| node(Kind::List(items))),
        1 => prop::collection::vec(marked, 2..4)
            .prop_filter("blank", |rows| rows.iter().all(|row| row.kind != Kind::Empty))
            .prop_map(|rows| node(Kind::Rows(rows))),
    ]
    .boxed()
}

/// A tree that shows itself in the short notation.
struct Tree(Node);

impl std::fmt::Debug for Tree {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&short(&self.0))
    }
}

fn tree() -> impl Strategy<Value = Tree> {
    statement(statement(leaf())).prop_map(Tree)
}

/// Pieces of LaTeX that meet in formulas.
fn pieces() -> impl Strategy<Value = String> {
    let pieces = vec![
        "\\frac",
        "{",
        "}",
        "^",
        "_",
        "'",
        "(",
        ")",
        "[",
        "]",
        "|",
        "\\|",
        "\\left(",
        "\\left.",
        "\\right)",
        "\\right.",
        "\\right|",
        "\\Big|",
        "\\{",
        "\\}",
        "&",
        "\\\\",
        "+",
        "-",
        "=",
        "\\pm",
        "\\times",
        "/",
        ",",
        ";",
        ":",
        "!",
        "x",
        "12",
        ".5",
        "\\sin",
        "\\sum",
        "\\mathbf",
        "\\rm",
        "\\mathrm",
        "\\vec",
        "\\dot",
        "\\sqrt",
        "\\binom",
        "\\over",
        "\\underbrace",
        "\\overset",
        "\\substack",
        "\\text{が, }",
        "回転",
        "\\quad",
        "\\therefore",
        "\\Rightarrow",
        "\\begin{aligned}",
        "\\end{aligned}",
        "\\begin{cases}",
        "\\end{cases}",
        "\\begin{array}{cc}",
        "\\end{array}",
        "\\prime",
        "\\circ",
        "*",
        " ",
        "%\n",
        "\\tag{1}",
        "\\operatorname{sn}",
        "\\unknown",
        "質",
        "$",
        "\\",
        "\\not",
        ".",
        "\\langle",
        "\\rangle",
        "\\mid",
        "\\dots",
        "const",
        "1{,}000",
        "0.''2",
    ];
    prop::collection::vec(prop::sample::select(pieces), 0..24).prop_map(|pieces| pieces.concat())
}

/// Real formulas, to be mutated.
const FORMULAS: [&str; 6] = [
    "\\frac{d}{dt} \\left( \\frac{L_z - I_1 \\Omega \\cos \\theta}{I_0 \\sin \\theta} \\right)^2 = \\text{const.} (= C)",
    "\\begin{aligned} &= (\\dot{\\varphi}\\sin\\theta)\\mathbf{e}_\\xi \\\\ &\\quad + (\\dot{\\psi})\\mathbf{e}_\\zeta \\end{aligned}",
    "\\left. \\begin{aligned} A &\\equiv I_x \\\\ B &= \\left[ y \\right. \\\\ &\\left. + 1 \\right] \\end{aligned} \\right\\} \\quad (50)",
    "\\begin{pmatrix} L'_\\Xi \\\\ L'_H \\end{pmatrix} = T \\mathbf{L}' = \\underbrace{T I T^{-1}}_{=0} |\\boldsymbol{\\omega}|",
    "P_n^m(0) = \\begin{cases} 0 & n - m : \\text{odd} \\\\ (-1)^{\\lfloor \\frac{n}{2} \\rfloor} (n-m)!! & \\text{偶数} \\end{cases}",
    "\\frac{\\partial F}{\\partial L'} \\Big|_0^t \\sim 0.''2 \\text{ for } \\sum_{\\epsilon=\\pm 1} S\\vec{a}\\vec{b}, \\quad k^* \\ll 1",
];

/// A formula with a few characters removed, doubled or swapped.
fn mutated() -> impl Strategy<Value = String> {
    let edit = (any::<prop::sample::Index>(), 0..4_u8, any::<prop::sample::Index>());
    (prop::sample::select(FORMULAS.to_vec()), prop::collection::vec(edit, 1..6)).prop_map(|(formula, edits)| {
        let mut chars: Vec<char> = formula.chars().collect();
        for (place, edit, other) in edits {
            let (i, j) = (place.index(chars.len()), other.index(chars.len()));
            match edit {
                0 if chars.len() > 1 => drop(chars.remove(i)),
                1 => chars.insert(i, chars[j]),
                2 => chars.swap(i, j),
                _ => chars.truncate(i.max(1)),
            }
        }
        chars.into_iter().collect()
    })
}

/// Whatever the source, its tree has proper spans and comes back from its LaTeX, or its error has a place.
fn check_source(source: &str) {
    match parse(source) {
        Ok(tree) => {
            check_spans(&tree, source);
            let latex = to_latex(&tree);
            let again = parse(&latex).unwrap_or_else(|error| panic!("{source:?} becomes {latex:?}: {error}"));
            assert_eq!(short(&again), short(&tree), "{source:?} becomes {latex:?}");
        }
        Err(error) => assert!(source.get(error.span.clone()).is_some(), "{source:?}: {error}"),
    }
}

proptest! {
    #![proptest_config(crate::testing::properties(1500))]

    #[test]
    fn trees_come_back_from_their_latex(tree in tree()) {
        let latex = to_latex(&tree.0);
        let again = parse(&latex).map(|again| short(&again));
        prop_assert_eq!(again, Ok(short(&tree.0)), "{}", latex);
    }

    #[test]
    fn mutated_formulas(source in mutated()) {
        check_source(&source);
    }

    #[test]
    fn random_pieces(source in pieces()) {
        check_source(&source);
    }

    #[test]
    fn random_text(source in "\\PC{0,40}") {
        check_source(&source);
    }
}

#[test]
fn formulas_are_read() {
    for formula in FORMULAS {
        assert!(parse(formula).is_ok(), "{formula}");
        check_source(formula);
    }
}

/// What fuzzing found: printed, these were read otherwise.
#[test]
fn printed_formulas_are_read_as_they_were_meant() {
    for formula in [
        r"\mathbf{emu{回転'}} = 1",
        r"{\text{and}}! b",
        r"\operatorname{arg\,max} x",
        r"\operatorname{a%b} x + 1",
        r"t = \begin{pmatrix} a \\ \mu \\ \\ \\ \end{pmatrix}",
        r"\over&\\",
    ] {
        assert!(parse(formula).is_ok(), "{formula}");
        check_source(formula);
    }
    let function = parse(r"\operatorname{arg\,max} x").unwrap();
    assert_eq!(to_latex(&function), r"\operatorname{argmax} x");
}

/// Sources made to exhaust the stack, the memory or the patience.
#[test]
fn hostile_sources_are_answered_quickly() {
    let many = 100_000;
    let deep = |open: &str, close: &str| format!("{}x{}", open.repeat(many), close.repeat(many));
    let sources = [
        deep("{", "}"),
        deep("(", ")"),
        deep("|", "|"),
        deep("\\left(", "\\right)"),
        deep("\\frac1{", "}"),
        deep("x^{", "}"),
        deep("\\begin{aligned}", "\\end{aligned}"),
        "{".repeat(many),
        "}".repeat(many),
        "\\sqrt".repeat(many),
        "\\vec ".repeat(many) + "x",
        "\\frac".repeat(many),
        "-".repeat(many) + "x",
        "\\therefore ".repeat(many),
        "\\rm ".repeat(many) + "x",
        "x!^2".repeat(many),
        "x".to_owned() + &"'".repeat(many),
        "x".to_owned() + &"!".repeat(many),
        "F".to_owned() + &"|_0".repeat(many),
        "a|".repeat(many),
        "\\left[a\\right.\\\\".repeat(many / 2),
        "a\\\\+".repeat(many) + "b",
        "a &= b \\\\".repeat(many),
        "\\quad ".repeat(many),
        "a \\quad ".repeat(many),
        "\\text{".repeat(many),
        "\\overset{a}".repeat(many),
        "\\overset{".repeat(many),
        "x+".repeat(5 << 20),
        "x+".repeat(500_000) + "x",
        "a, ".repeat(300_000),
    ];
    for source in sources {
        let begin = Instant::now();
        let result = parse(&source);
        if let Ok(tree) = &result {
            to_latex(tree);
        }
        drop(result);
        let took = begin.elapsed();
        assert!(took < Duration::from_secs(120), "{took:?} for {:?}...", &source[..20]);
    }
}

/// The deepest formula that is read.
#[test]
fn deep_formulas_do_not_overflow_the_stack() {
    for (open, close) in [
        ("{", "}"),
        ("\\left(", "\\right)"),
        ("\\frac1{a+", "}"),
        ("x^{-", "}"),
        ("|a+", "|"),
        ("\\sqrt{2\\times ", "}"),
    ] {
        let mut read = 0;
        for depth in 1..200 {
            let source = format!("{}x{}", open.repeat(depth), close.repeat(depth));
            match parse(&source) {
                Ok(tree) => {
                    read = depth;
                    let copy = tree.clone();
                    assert_eq!(copy, tree);
                    to_latex(&tree);
                }
                Err(error) => assert!(error.message.contains("100"), "{error}"),
            }
        }
        assert!(read >= 99, "{open}: {read}");
    }
}
