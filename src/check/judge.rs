//! The judgement on an equation: each link of its chain is claimed, evaluated and decided; the worst decides.

use std::collections::HashSet;
use std::time::Instant;

use crate::document::Problem;
use crate::expr::Deadline;
use crate::latex::ast::{Delim, Kind, Node, Rel};
use crate::semantics::{self, Clause, ErrorKind, Scope, Side, Statement};

use super::book::{Book, Entry, Formula, Unclear, Version};
use super::claim::{Claim, Obstacle, Source, obstacle_text, unclear_text};
use super::decide;
use super::general;
use super::law;
use super::options::Options;
use super::order::{self, Measure};
use super::remark;
use super::stateless;
use super::summary::kind;
use super::trouble;
use super::value;
use super::verdict::{Correction, DimensionStatus, Judgement, LinkJudgement, Strength, Verdict};

/// Judges an equation of a book.
pub fn judge(book: &Book, index: usize, options: &Options) -> Judgement {
    let begin = Instant::now();
    let entry = &book.entries[index];
    let mut judgement = blank(book, index);
    let outcome = judge_version(book, index, Version::Printed, options);
    judgement.verdict = outcome.verdict;
    judgement.reason = outcome.reason;
    judgement.links = outcome.links;
    judgement.problem = outcome.problem;
    judgement.summarise();
    if let Some(correction) = &entry.correction {
        let outcome = judge_version(book, index, Version::Corrected, options);
        judgement.correction = Some(Correction {
            latex: correction.latex.clone(),
            verdict: outcome.verdict,
            dimension: DimensionStatus::Unchecked,
            links: outcome.links,
            problem: outcome.problem,
        });
    }
    judgement.as_expected = as_expected(&judgement);
    judgement.micros = u64::try_from(begin.elapsed().as_micros()).unwrap_or(u64::MAX);
    judgement
}

/// The judgement on an equation before anything is judged: what the notes and the annotation say.
pub fn blank(book: &Book, index: usize) -> Judgement {
    let entry = &book.entries[index];
    let equation = &entry.equation;
    let annotation = entry.annotation();
    Judgement {
        label: equation.label.clone(),
        numbered: equation.numbered,
        section: entry.section.clone(),
        numbers: equation.numbers.clone(),
        file: equation.file.as_ref().map(|path| path.display().to_string()),
        line: equation.line,
        latex: entry.printed.latex.trim().to_owned(),
        kind: kind(book, index),
        verdict: Verdict::Undecided,
        strength: None,
        bits: None,
        states: 0,
        as_printed: entry.reading.is_none(),
        reading: entry.reading.as_ref().map(|f| f.latex.clone()),
        given: entry.given(None).into_iter().chain(entry.list(|a| &a.solves)).map(|g| g.value.clone()).collect(),
        assumptions: entry.wheres(None).iter().map(|p| p.value.clone()).collect(),
        because: annotation.and_then(|a| a.because.clone()),
        reason: None,
        links: Vec::new(),
        counterexample: None,
        correction: None,
        dimension: DimensionStatus::Unchecked,
        dimension_findings: Vec::new(),
        expect: annotation.and_then(|a| a.expect.as_ref()).and_then(|e| expected(&e.value)),
        as_expected: false,
        sensitivity: None,
        suggestions: Vec::new(),
        lost_bits: None,
        inferred: None,
        suspect: None,
        unfinished: None,
        micros: 0,
        problem: None,
    }
}

/// A misprint that is expected, and mended by a correction that holds, is no surprise, nor is a blank that is filled by
/// one; anything else that does not hold is.
fn as_expected(judgement: &Judgement) -> bool {
    let correction_holds = judgement.correction.is_none() || judgement.is_mended();
    match judgement.expect {
        Some(expected) => judgement.verdict == expected && correction_holds,
        None => !matches!(judgement.verdict, Verdict::Fails | Verdict::Undecided | Verdict::Unreadable),
    }
}

fn expected(text: &str) -> Option<Verdict> {
    Some(match text {
        "holds" => Verdict::Holds,
        "asymptotic" => Verdict::Asymptotic,
        "definition" => Verdict::Definition,
        "fails" => Verdict::Fails,
        "undecided" => Verdict::Undecided,
        "statement" => Verdict::Statement,
        "unreadable" => Verdict::Unreadable,
        _ => return None,
    })
}

/// The verdict on one version of an equation.
pub(super) struct Outcome {
    pub verdict: Verdict,
    pub reason: Option<String>,
    pub links: Vec<LinkJudgement>,
    pub problem: Option<Problem>,
}

impl Outcome {
    fn of(links: Vec<LinkJudgement>) -> Self {
        Outcome { verdict: worst(&links), reason: None, links, problem: None }
    }

    fn without_links(verdict: Verdict, reason: String, problem: Option<Problem>) -> Self {
        Outcome { verdict, reason: Some(reason), links: Vec::new(), problem }
    }
}

pub(super) fn judge_version(book: &Book, index: usize, version: Version, options: &Options) -> Outcome {
    let entry = &book.entries[index];
    if let Some(circle) = book.circle(index) {
        // The document's own problems say where.
        let reason = format!("the premises go in a circle: {circle}");
        return Outcome::without_links(Verdict::Undecided, reason, None);
    }
    let statement = match book.statement(index, version) {
        Ok(statement) => statement,
        Err(unclear) => {
            let latex = &entry.formula(version).latex;
            let (verdict, reason) = match &unclear {
                Unclear::Latex(e) => (Verdict::Unreadable, place(latex, &e.message, &e.span, e.help.as_deref())),
                Unclear::Meaning(e) => (Verdict::Undecided, place(latex, &e.message, &e.span, e.help.as_deref())),
                Unclear::Before(..) => (Verdict::Undecided, unclear_text(&unclear)),
            };
            return Outcome::without_links(verdict, reason, Some(trouble::unclear(entry, version, &unclear)));
        }
    };
    let source = Source::new(book, index, version).until(Deadline::after(options.budget));
    judge_statement(&source, &statement, options)
}

/// Judges one link (from 0) of an equation as printed; none where it has no such link. The links before it that define
/// something, or that are taken as given where the equation is a law, are known.
pub fn judge_one(book: &Book, index: usize, link: usize, taken: &[usize], options: &Options) -> Option<LinkJudgement> {
    let statement = book.statement(index, Version::Printed).ok()?;
    let clause = statement.clauses.get(link)?;
    let before = statement.clauses.iter().enumerate().take(link);
    let known = before.filter(|(k, c)| taken.contains(k) || defines(book, index, c)).map(|(_, c)| c.clone());
    let known: Vec<Clause> = known.collect();
    let source = Source::new(book, index, Version::Printed).until(Deadline::after(options.budget));
    Some(judge_link(&source.at(link), clause, &book.entries[index].scope, &known, options))
}

/// Judges the links of another formula in the place of an equation; none where it cannot be taken apart.
pub fn judge_tree(book: &Book, index: usize, tree: &Node, options: &Options) -> Vec<LinkJudgement> {
    let options = Options { evidence: false, ..options.clone() };
    let source = Source::new(book, index, Version::Printed).until(Deadline::after(options.budget));
    match book.statement_of(index, tree) {
        Ok(statement) => judge_statement(&source, &statement, &options).links,
        Err(_) => Vec::new(),
    }
}

/// Judges what an equation states, in the words of any version of it.
pub(super) fn judge_statement(source: &Source, statement: &Statement, options: &Options) -> Outcome {
    let (book, index, version) = (source.book, source.index, source.version);
    let entry = &book.entries[index];
    let is_statement = entry.annotation().and_then(|a| a.kind.as_ref()).is_some_and(|k| k.value == "statement");
    if statement.clauses.is_empty() || is_statement && statement.clauses.iter().all(remark::is_remark) {
        return nothing_to_evaluate(entry, version);
    }
    if !entry.list(|a| &a.solves).is_empty() {
        return judge_solution(source, &statement.clauses, options);
    }
    let mut known: Vec<Clause> = Vec::new();
    let mut links = Vec::new();
    for (k, clause) in statement.clauses.iter().enumerate() {
        let source = &source.at(k);
        if defines(book, index, clause) {
            links.push(match source.claim(clause, &entry.scope, &known) {
                Ok(_) => LinkJudgement::definition(clause.latex()),
                Err(obstacle) => obstructed(LinkJudgement::unjudged(clause.latex()), source, clause, &obstacle),
            });
            known.push(clause.clone());
        } else {
            let link = judge_link(source, clause, &entry.scope, &known, options);
            let equality = matches!(clause.rel, Rel::Eq | Rel::Equiv) || semantics::is_geometric(clause.rel);
            if link.verdict == Verdict::Definition {
                known.push(Clause { rel: Rel::Eq, ..clause.clone() });
                links.push(link);
            } else if equality && kind(book, index) == "law" && link.verdict != Verdict::Holds && !says_nothing(clause)
            {
                links.push(law::taken(link, source, clause, &known, options));
                known.push(clause.clone());
            } else {
                links.push(link);
            }
        }
    }
    links.extend(
        statement
            .bare
            .iter()
            .filter(|bare| !stateless::is_remark(&entry.scope, bare))
            .map(|bare| stateless::undecided(source, bare)),
    );
    Outcome::of(links)
}

/// An equation without a relation: a statement, if the annotation says so and why.
fn nothing_to_evaluate(entry: &Entry, version: Version) -> Outcome {
    let annotation = entry.annotation();
    let is_statement = annotation.and_then(|a| a.kind.as_ref()).is_some_and(|k| k.value == "statement");
    match annotation.and_then(|a| a.because.clone()) {
        Some(because) if is_statement => Outcome::without_links(Verdict::Statement, because, None),
        _ => {
            let reason =
                "there is no relation to evaluate; if that is right, say kind = \"statement\" and because = \"...\"";
            let problem = trouble::equation(entry, version, reason);
            Outcome::without_links(Verdict::Undecided, reason.into(), Some(problem))
        }
    }
}

/// A solution is judged by putting it into what it is said to solve.
fn judge_solution(source: &Source, clauses: &[Clause], options: &Options) -> Outcome {
    let solved = match source.solved() {
        Ok(solved) => solved,
        Err(obstacle) => {
            let entry = &source.book.entries[source.index];
            let problem = clauses.first().map(|c| trouble::obstacle(entry, source.version, c, true, &obstacle));
            return Outcome::without_links(Verdict::Undecided, obstacle_text(&obstacle), problem);
        }
    };
    let mut links: Vec<LinkJudgement> = solved
        .iter()
        .map(|(clause, scope)| {
            let mut link = judge_link(source, clause, scope, clauses, options);
            link.reason = link.reason.or(Some("with the solution put in".into()));
            link
        })
        .collect();
    if let (Verdict::Holds, Some(clause)) = (worst(&links), clauses.first()) {
        let generality = match general::defect(source, clauses, &solved) {
            Ok(None) => None,
            Ok(Some(defect)) => {
                let (verdict, strength) = (Verdict::Fails, Some(Strength::Numeric));
                Some(LinkJudgement {
                    verdict,
                    strength,
                    reason: Some(defect),
                    ..LinkJudgement::unjudged(clause.latex())
                })
            }
            Err(obstacle) => Some(obstructed(LinkJudgement::unjudged(clause.latex()), source, clause, &obstacle)),
        };
        links.extend(generality);
    }
    Outcome::of(links)
}

fn worst(links: &[LinkJudgement]) -> Verdict {
    links.iter().map(|l| l.verdict).max().unwrap_or(Verdict::Undecided)
}

/// Whether a clause introduces a symbol: one side is a declared symbol that neither an earlier equation nor a premise
/// mentions.
pub(super) fn defines(book: &Book, index: usize, clause: &Clause) -> bool {
    if !matches!(clause.rel, Rel::Eq | Rel::Equiv) || value::is_value(book, index) {
        return false;
    }
    let entry = &book.entries[index];
    let premises = entry.wheres(None).into_iter().chain(&entry.scope.assume);
    let premises: Vec<Formula> = premises.map(|p| Formula::new(&p.value)).collect();
    let new_name = |node: &Node| {
        let node = without_arguments(&entry.scope, node);
        let pattern = crate::semantics::pattern_of(&entry.scope, node);
        entry.scope.get(&pattern).is_some_and(crate::semantics::Entry::is_free)
            && !book.mentioned_before(index, &pattern)
            && !premises.iter().any(|f| {
                let mut found = HashSet::new();
                if let Ok(tree) = &f.tree {
                    crate::semantics::mentions(&entry.scope, tree, &mut found);
                }
                found.contains(&pattern)
            })
    };
    let fresh = |node: &Node| match &node.kind {
        // A column of new names.
        Kind::Matrix { rows, .. } => rows.iter().flatten().all(new_name),
        _ => new_name(node),
    };
    let Side::Node(rhs) = &clause.rhs else { return false };
    // What is defined must not occur in what defines it.
    let apart = |name: &Node, value: &Node| {
        let (mut names, mut used) = (HashSet::new(), HashSet::new());
        crate::semantics::mentions(&entry.scope, name, &mut names);
        crate::semantics::mentions(&entry.scope, value, &mut used);
        names.retain(|n| entry.scope.get(n).is_some_and(crate::semantics::Entry::is_free));
        names.is_disjoint(&used)
    };
    let approximation = entry.annotation().is_some_and(|a| a.small.is_some());
    !clause.continued && !approximation && (fresh(&clause.lhs) || fresh(rhs)) && apart(&clause.lhs, rhs)
}

/// The name, where it stands before the arguments that it is declared to have: φ(r) is φ.
fn without_arguments<'n>(scope: &Scope, node: &'n Node) -> &'n Node {
    let Kind::Juxt(factors) = &node.kind else { return node };
    let [name, Node { kind: Kind::Group { open: Delim::Paren, body, .. }, .. }] = factors.as_slice() else {
        return node;
    };
    let entry = scope.get(&crate::semantics::pattern_of(scope, name));
    let is_it =
        |e: &crate::semantics::Entry| !e.arguments.is_empty() && e.arguments.join(",") == semantics::spelling(body);
    if entry.is_some_and(is_it) { name } else { node }
}

/// Judges a link, and says where in the file that lies which it lacks.
pub(super) fn judge_link(
    source: &Source,
    clause: &Clause,
    scope: &Scope,
    known: &[Clause],
    options: &Options,
) -> LinkJudgement {
    let mut judgement = link_verdict(source, clause, scope, known, options);
    if let (Verdict::Undecided, None, Some(reason)) = (judgement.verdict, &judgement.problem, &judgement.reason) {
        let entry = &source.book.entries[source.index];
        judgement.problem = Some(match entry.list(|a| &a.solves).is_empty() {
            true => trouble::link(entry, source.version, clause, reason),
            false => trouble::equation(entry, source.version, reason),
        });
    }
    judgement
}

fn link_verdict(source: &Source, clause: &Clause, scope: &Scope, known: &[Clause], options: &Options) -> LinkJudgement {
    let mut judgement = LinkJudgement::unjudged(clause.latex());
    if says_nothing(clause) {
        judgement.reason = Some(SAYS_NOTHING.into());
        return judgement;
    }
    let entry = &source.book.entries[source.index];
    let printed = value::is_value(source.book, source.index).then(|| value::printed(entry, clause)).flatten();
    let small = entry.annotation().is_some_and(|a| a.small.is_some());
    let mapped = match clause.rel {
        _ if printed.is_some() => Clause { rel: Rel::Eq, ..clause.clone() },
        // With a small parameter an arrow leads to the limit, and only what is said to be near is near.
        Rel::To if small && entry.annotation().is_some_and(|a| a.maps.is_none()) => {
            Clause { rel: Rel::Eq, ..clause.clone() }
        }
        Rel::Approx if small => Clause { rel: Rel::Eq, ..clause.clone() },
        Rel::To => match source.mapped(clause) {
            None => {
                judgement.reason =
                    Some("an arrow needs to be told what map it stands for: maps = 'X \\mapsto ...'".into());
                return judgement;
            }
            Some(Err(obstacle)) => return obstructed(judgement, source, clause, &obstacle),
            Some(Ok(clause)) => clause,
        },
        Rel::Eq | Rel::Equiv | Rel::Implies | Rel::Lt | Rel::Le | Rel::Gt | Rel::Ge => clause.clone(),
        rel if semantics::is_geometric(rel) => clause.clone(),
        _ => {
            judgement.reason = Some("relations of this kind are not evaluated yet".into());
            return judgement;
        }
    };
    match source.claim(&mapped, scope, known) {
        Err(obstacle) => obstructed(judgement, source, clause, &obstacle),
        Ok(claim) => match printed.filter(|p| !p.is_arithmetic()) {
            Some(printed) => value::judge(judgement, source, &printed, claim, options),
            None => {
                let restated = claim.restated;
                let judged = by_relation(judgement, claim, clause, source, options);
                LinkJudgement { restated: restated && judged.verdict == Verdict::Holds, ..judged }
            }
        },
    }
}

/// Why a link is not judged whose sides are printed alike.
const SAYS_NOTHING: &str = "both sides are printed alike, so that it says nothing: has one of them lost something?";

/// Whether the sides of a link are printed alike.
pub fn says_nothing(clause: &Clause) -> bool {
    let equality = matches!(clause.rel, Rel::Eq | Rel::Equiv);
    equality
        && matches!(&clause.rhs, Side::Node(rhs) if crate::latex::to_latex(rhs) == crate::latex::to_latex(&clause.lhs))
}

/// Evaluates a claim that is made by a link as `printed`.
fn by_relation(
    judgement: LinkJudgement,
    claim: Claim,
    printed: &Clause,
    source: &Source,
    options: &Options,
) -> LinkJudgement {
    let entry = &source.book.entries[source.index];
    let name = format!("{}/{}", entry.equation.label, judgement.latex);
    let near = |clause: &Clause| matches!(clause.rel, Rel::Approx | Rel::To);
    let told = source.book.statement(source.index, source.version).is_ok_and(|s| s.clauses.iter().any(near));
    match (claim.small, claim.rel) {
        (Some(_), Rel::Eq | Rel::Equiv) if printed.rel != Rel::Eq || !told => {
            let claimed = entry.annotation().and_then(|a| a.order);
            let is_zero =
                |node: &Node| matches!(crate::latex::to_latex(node).as_str(), "0" | "\\mathbf{0}" | "\\vec{0}");
            let zero = is_zero(&printed.lhs) || matches!(&printed.rhs, Side::Node(n) if is_zero(n));
            let measure = match printed.rel {
                Rel::To => Measure::Absolute,
                _ if zero || printed.rhs == Side::Constant => Measure::Terms,
                _ => Measure::Relative,
            };
            order::judge(judgement, claim, measure, claimed, &name, options)
        }
        (_, Rel::Lt | Rel::Le | Rel::Gt | Rel::Ge) => decide::inequality(judgement, claim, &name, options),
        _ => decide::equality(judgement, claim, &name, options),
    }
}

/// A link that could not be claimed: shapes that do not meet are the author's and final; the rest is lacking.
fn obstructed(mut judgement: LinkJudgement, source: &Source, clause: &Clause, obstacle: &Obstacle) -> LinkJudgement {
    let entry = &source.book.entries[source.index];
    // The links of an equation that is solved are printed elsewhere.
    let foreign = !entry.list(|a| &a.solves).is_empty();
    let problem = trouble::obstacle(entry, source.version, clause, foreign, obstacle);
    judgement.reason = Some(match obstacle {
        Obstacle::Link(error) if !foreign && !trouble::is_inherited(clause, &error.span) => {
            place(&entry.formula(source.version).latex, &error.message, &error.span, error.help.as_deref())
        }
        Obstacle::Link(error) => place("", &problem.message, &error.span, error.help.as_deref()),
        Obstacle::Premise(..) => obstacle_text(obstacle),
    });
    judgement.problem = Some(problem);
    if let Obstacle::Link(error) = obstacle
        && error.kind == ErrorKind::Shape
    {
        judgement.verdict = Verdict::Fails;
        judgement.strength = Some(Strength::Shape);
    }
    judgement
}

/// The most of a formula that is quoted in a reason, in bytes.
const LONGEST_PIECE: usize = 120;

/// A message with the piece of LaTeX it is about.
fn place(latex: &str, message: &str, span: &std::ops::Range<usize>, help: Option<&str>) -> String {
    let piece = latex.get(span.clone()).unwrap_or_default().trim();
    let mut text = message.to_owned();
    if !piece.is_empty() && !message.contains(piece) {
        let end = piece.floor_char_boundary(LONGEST_PIECE);
        let more = if end < piece.len() { " …" } else { "" };
        text.push_str(&format!(", at `{}{more}`", &piece[..end]));
    }
    if let Some(help) = help {
        text.push_str(&format!(" ({help})"));
    }
    text
}
