use std::collections::BTreeMap;
use std::path::Path;

use rug::Float;

use super::krawczyk::{Equations, Unproved};
use super::*;
use crate::check::Options;
use crate::check::book::{Book, Version};
use crate::check::claim::{Claim, Source};
use crate::check::judge::{judge, judge_version};
use crate::check::random::Random;
use crate::check::value;
use crate::check::verdict::Verdict;
use crate::expr::Graph;

fn notes() -> Book {
    book(include_str!("../../../notes/gyroscope.md"))
}

fn book(text: &str) -> Book {
    Book::new(&crate::document::parse(Path::new("notes.md"), text))
}

/// Every failing equation that is judged by values is certified.
#[test]
fn failing_equations_of_the_bundled_notes() {
    let book = notes();
    let options = Options { states: 8, ..Options::default() };
    let (mut certified, mut others) = (Vec::new(), Vec::new());
    for index in 0..book.entries.len() {
        let judgement = judge(&book, index, &options);
        if judgement.verdict != Verdict::Fails {
            continue;
        }
        let proofs = judgement.links.iter().filter(|l| l.strength == Some(Strength::Certified)).count();
        let shown = judgement
            .links
            .iter()
            .filter_map(|l| l.counterexample.as_ref()?.certificate.as_ref().map(ToString::to_string));
        assert_eq!(shown.count(), proofs, "({}) is certified with a certificate only", judgement.label);
        match judgement.strength {
            Some(Strength::Certified) => certified.push(judgement.label),
            _ => others.push(judgement.label),
        }
    }
    let expected = [
        "8+1", "8+2", "9", "14+1", "16", "32", "33", "42", "45", "46", "47", "51", "52", "53", "54", "56", "60", "78",
        "81", "83",
    ];
    assert_eq!(certified, expected);
    // Shapes that do not meet; two approximations of the wrong order.
    assert_eq!(others, ["49", "75", "84"]);
}

/// The claims of the links that hold, as printed or as corrected.
fn holding(book: &Book, index: usize, version: Version) -> Vec<Claim> {
    let few = Options { states: 4, ..Options::default() };
    // A printed value holds within its digits.
    if value::is_value(book, index) {
        return Vec::new();
    }
    let outcome = judge_version(book, index, version, &few);
    let Ok(statement) = book.statement(index, version) else { return Vec::new() };
    let source = Source::new(book, index, version);
    let entry = &book.entries[index];
    let solved = if entry.list(|a| &a.solves).is_empty() { None } else { source.solved().ok() };
    let mut known = Vec::new();
    let mut claims = Vec::new();
    for (k, link) in outcome.links.iter().enumerate() {
        let (clause, scope) = match &solved {
            Some(solved) => match solved.get(k) {
                Some((clause, scope)) => (clause.clone(), *scope),
                None => continue, // that the solution is the general one
            },
            None => match statement.clauses.get(k) {
                Some(clause) => (clause.clone(), entry.scope.as_ref()),
                None => continue, // a part without a relation
            },
        };
        let source = if solved.is_some() { source } else { source.at(k) };
        if link.verdict == Verdict::Definition {
            known.push(clause);
        } else if link.verdict == Verdict::Holds {
            let mapped = source.mapped(&clause).and_then(Result::ok).filter(|_| clause.rel == Rel::To);
            let known = if solved.is_some() { &statement.clauses } else { &known };
            claims.extend(source.claim(&mapped.unwrap_or(clause), scope, known));
        }
    }
    claims
}

/// What became of the attempts to certify what holds.
#[derive(Debug, Default)]
struct Refused {
    links: usize,
    states: usize,
    attempts: usize,
    /// Those that were refused for nothing but the sides themselves, or premises that follow from others.
    at_the_sides: usize,
}

fn refuse(book: &Book, states: usize) -> Refused {
    let mut refused = Refused::default();
    for index in 0..book.entries.len() {
        for version in [Version::Printed, Version::Corrected] {
            if version == Version::Printed || book.entries[index].correction.is_some() {
                for claim in holding(book, index, version) {
                    refuse_claim(claim, &book.entries[index].equation.label, states, &mut refused);
                }
            }
        }
    }
    refused
}

fn refuse_claim(mut claim: Claim, label: &str, states: usize, refused: &mut Refused) {
    refused.links += 1;
    let mut random = Random::new(7, label);
    let condition = claim.condition.map(|(rel, a, b)| (rel, claim.world.graph.sub(a, b)));
    let extra: Vec<_> = condition.iter().map(|(_, e)| *e).collect();
    let tape = Tape::compile(&claim.world.graph, &extra);
    let sampler = Sampler::new(&mut claim, &mut random, &extra).unwrap_or_else(|e| panic!("{label}: {e:?}"));
    let claimed = match sampler.claim.rel {
        rel @ (Rel::Lt | Rel::Le | Rel::Gt | Rel::Ge) => Claimed::Ordered(rel, condition.map(|(rel, _)| (rel, &tape))),
        _ => Claimed::Equal,
    };
    for state in sampler.states(states, &mut random, &BTreeMap::new()).unwrap_or_default() {
        refused.states += 1;
        for bits in [64, 300] {
            let outcome = attempt(&sampler, &state, &claimed, &[], bits);
            assert!(outcome.is_err(), "({label}) holds, and is certified to fail: {}", outcome.unwrap());
            refused.attempts += 1;
            let sides = matches!(outcome, Err(Uncertified::Open(_) | Uncertified::Dependent(_)));
            refused.at_the_sides += usize::from(sides);
        }
        let exact = fractions::certificate(&sampler, &state, &claimed, &[]);
        assert!(exact.is_none(), "({label}) holds, and is certified to fail: {}", exact.unwrap());
    }
}

/// No link that holds is ever proved to fail, at whatever state it was sampled.
#[test]
fn what_holds_is_never_certified_to_fail() {
    let first = refuse(&notes(), 6);
    eprintln!("{first:?}");
    assert!(first.links > 90 && first.states > 500 && first.at_the_sides > 800, "{first:?}");
    let second = refuse(&book(include_str!("../../../notes/celestial-mechanics-3.md")), 2);
    eprintln!("{second:?}");
    assert!(second.at_the_sides > second.attempts / 2, "{second:?}");
}

/// The box around a solution of a system in x and y (or x alone), from a start.
fn enclose(residuals: &[&str], start: &[f64], bits: u32) -> Result<Vec<Interval>, Unproved> {
    let mut graph = Graph::new();
    let names = ["x", "y"];
    let unknowns: Vec<SymId> = names.iter().take(start.len()).map(|n| graph.symbol(n)).collect();
    let of: Vec<_> = unknowns.iter().map(|s| graph.sym(*s)).collect();
    let x = of[0];
    let (one, two) = (graph.int(1), graph.int(2));
    let square = graph.powi(x, 2);
    let build = |text: &&str| match *text {
        "x^2 - 2" => graph.sub(square, two),
        "x^2" => square,
        "(x - 1)^2" => {
            let less = graph.sub(x, one);
            graph.powi(less, 2)
        }
        "x^2 + 1" => graph.add(square, one),
        "x^2 - 10^-30" => {
            let ten = graph.int(10);
            let small = graph.powi(ten, -30);
            graph.sub(square, small)
        }
        "abs x" => graph.call(crate::number::Func::Abs, x),
        "sqrt x" => graph.sqrt(x),
        "sin x" => graph.call(crate::number::Func::Sin, x),
        "x^2 + y^2 - 1" => {
            let y = graph.powi(of[1], 2);
            let sum = graph.add(square, y);
            graph.sub(sum, one)
        }
        "x - y" => graph.sub(x, of[1]),
        "y - 1" => graph.sub(of[1], one),
        _ => panic!("{text}"),
    };
    let residuals: Vec<_> = residuals.iter().map(build).collect();
    let jacobian: Vec<_> = graph.jacobian(&residuals, &unknowns).into_iter().flatten().collect();
    let (values, jacobian) = (Tape::compile(&graph, &residuals), Tape::compile(&graph, &jacobian));
    let centre: Vec<Float> = start.iter().map(|x| Float::with_val(bits, *x)).collect();
    let mut at = vec![Interval::invalid(bits); unknowns.len()];
    let equations = Equations { values: &values, jacobian: &jacobian, unknowns: &unknowns };
    equations.enclose(&mut at, &centre, bits).map(|()| at)
}

#[test]
fn solutions_are_enclosed() {
    for bits in [64, 200, 500] {
        let near = |x: f64| x + 1e-12; // Newton's method in doubles comes as near
        let wide = |x: f64| Float::with_val(2 * bits, x);
        let narrow = |box_: &Interval| box_.width() < Float::with_val(bits, 1) >> (bits - 8);
        let root = enclose(&["x^2 - 2"], &[near(2_f64.sqrt())], bits).unwrap();
        assert!(root[0].contains(&wide(2.0).sqrt()) && narrow(&root[0]), "{root:?}");
        let other = enclose(&["x^2 - 2"], &[-2_f64.sqrt()], bits).unwrap();
        assert!(other[0].contains(&-wide(2.0).sqrt()) && !other[0].contains(&wide(2.0).sqrt()));
        let zero = enclose(&["sin x"], &[near(0.0)], bits).unwrap();
        assert!(zero[0].contains(&wide(0.0)) && narrow(&zero[0]), "{zero:?}");
        let crossing =
            enclose(&["x^2 + y^2 - 1", "x - y"], &[near(0.5_f64.sqrt()), near(0.5_f64.sqrt())], bits).unwrap();
        let half = wide(0.5).sqrt();
        assert!(crossing.iter().all(|c| c.contains(&half) && narrow(c)), "{crossing:?}");
    }
    // Two roots 2·10⁻¹⁵ apart: each has a box of its own, at a precision that tells them from each other.
    let close = enclose(&["x^2 - 10^-30"], &[1e-15], 128).unwrap();
    assert!(close[0].contains(&Float::with_val(300, Float::parse("1e-15").unwrap())) && close[0].excludes_zero());
}

/// What is no simple root, or none at all, has no proof, wherever one starts.
#[test]
fn double_roots_are_refused() {
    for bits in [64, 256, 1024] {
        for off in [0.0, 1e-3, 1e-9, -1e-17, 1e-40, 1e-200] {
            for (residual, root) in
                [("x^2", 0.0), ("(x - 1)^2", 1.0), ("x^2 + 1", 0.5), ("abs x", 0.0), ("sqrt x", 0.0)]
            {
                let outcome = enclose(&[residual], &[root + off], bits);
                assert!(outcome.is_err(), "{residual} from {root} + {off}: {outcome:?}");
            }
            // A circle and a tangent of it.
            let touching = enclose(&["x^2 + y^2 - 1", "y - 1"], &[off, 1.0], bits);
            assert!(touching.is_err(), "{off}: {touching:?}");
        }
        // From too far away the box that would have to be taken is no longer mapped into itself.
        assert_eq!(enclose(&["x^2 - 2"], &[0.2], bits).unwrap_err(), Unproved::NotContracted);
    }
    assert_eq!(enclose(&["x^2"], &[0.0], 64).unwrap_err(), Unproved::Singular);
}

fn judged(text: &str) -> crate::check::verdict::Judgement {
    let book = Book::new(&crate::document::parse(Path::new("small.md"), text));
    judge(&book, 0, &Options { states: 16, ..Options::default() })
}

const SYMBOLS: &str = "<!-- kenzan\n[symbols]\n'x' = { range = [0.5, 2.0] }\n'y' = { range = [0.1, 3.0] }\n'\\theta' = { range = [0.2, 1.4] }\n-->\n";

fn certified(equation: &str, annotation: &str) -> Result<String, String> {
    let judgement = judged(&format!("{SYMBOLS}\n$$ {equation} \\tag{{1}} $$\n<!-- kenzan\n{annotation}\n-->\n"));
    assert_eq!(judgement.verdict, Verdict::Fails, "{equation}: {:?}", judgement.reason);
    let counterexample = judgement.counterexample.ok_or("no counterexample")?;
    match counterexample.certificate {
        Some(certificate) => {
            assert_eq!(judgement.strength, Some(Strength::Certified));
            Ok(certificate.to_string())
        }
        None => {
            assert_eq!(judgement.strength, Some(Strength::Numeric));
            Err(counterexample.uncertified.unwrap_or_default())
        }
    }
}

#[test]
fn small_documents() {
    // The sides differ by sin 1 - 1.
    let sine = certified(r"\sin\theta = \theta", "").unwrap();
    assert_eq!(sine, r"at \theta = 1 the difference lies in [-0.15853, -0.158529], with 64 bits");
    // y = √2 for x = 1.
    let root = certified("y = 1", "where = ['y^2 = x + 1']\nsolve = ['y']").unwrap();
    assert_eq!(
        root,
        "at x = 1, y lies in [1.41421, 1.41422] the difference lies in [0.414213, 0.414214], with 64 bits"
    );
    // The second premise follows from the first: at a fraction it is seen to.
    let twice = certified(r"y = x", r"where = ['y = x \cos^2\theta', 'y = x - x \sin^2\theta']").unwrap();
    assert_eq!(twice, r"at x = 1, \theta = 2 arctan(1/2) the difference is -16/25, in fractions");
    // A premise that says what is greater holds at the state, too.
    assert_eq!(
        certified("x = 1", r"where = ['x > \frac{3}{2}']").unwrap(),
        "at x = 2 the difference is 1, with 64 bits"
    );
    // Inequalities by their sign, with and without a condition.
    assert!(certified(r"\sin\theta < \theta - \theta^3 / 6", "").unwrap().starts_with(r"at \theta = "));
    assert!(certified(r"x^2 < 1", r"iff = 'x < \frac{11}{10}'").unwrap().starts_with("at x = "));
}

#[test]
fn what_is_not_certified_says_why() {
    // It follows, but there are no fractions in it.
    let why = certified("y = x", r"where = ['y^2 = e^x', 'y = e^{x/2}']").unwrap_err();
    assert!(why.contains("not proved to follow from the others"), "{why}");
}

/// What certificates cost, and how many there are; not a test of what is right.
#[test]
#[ignore = "measures time"]
fn cost() {
    for text in [include_str!("../../../notes/gyroscope.md"), include_str!("../../../notes/celestial-mechanics-3.md")] {
        let book = book(text);
        for evidence in [false, true, false, true] {
            let options = Options { evidence, ..Options::default() };
            let begin = std::time::Instant::now();
            let judgements: Vec<_> = (0..book.entries.len()).map(|k| judge(&book, k, &options)).collect();
            let time = begin.elapsed();
            let failing: Vec<_> = judgements.iter().filter(|j| j.verdict == Verdict::Fails).collect();
            let certified = failing.iter().filter(|j| j.strength == Some(Strength::Certified)).count();
            eprintln!("evidence {evidence}: {time:?}; {certified} of {} that fail are certified", failing.len());
            for j in failing.iter().filter(|j| evidence && j.strength != Some(Strength::Certified)) {
                let why = j.links.iter().filter_map(|l| l.counterexample.as_ref()?.uncertified.clone());
                eprintln!("  ({}) {:?}: {}", j.label, j.strength, why.collect::<Vec<_>>().join("; "));
            }
        }
    }
}
