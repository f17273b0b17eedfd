//! A small run built by hand that has every verdict, strength and oddity: what the snapshots show.

use super::{Chart, Run, charts};
use crate::check::Finding;
use crate::check::exact::Exact;
use crate::check::verdict::{
    Assignment, Assumed, Certificate, Correction, Counterexample, Difference, DimensionFinding, DimensionStatus,
    DocumentReport, Enclosure, ExactValue, Inferred, InferredDimension, Judgement, LinkJudgement, LostBits, Order,
    Strength, Suspect, TermDimension, Verdict,
};

/// A link with a verdict and nothing else.
pub(super) fn link(latex: &str, verdict: Verdict) -> LinkJudgement {
    LinkJudgement { verdict, ..LinkJudgement::unjudged(latex.into()) }
}

/// A link that holds.
pub(super) fn agreeing(latex: &str) -> LinkJudgement {
    LinkJudgement {
        strength: Some(Strength::Numeric),
        residual: Some(3.1e-32),
        bits: Some(104),
        states: 64,
        ..link(latex, Verdict::Holds)
    }
}

/// A judgement of one link.
pub(super) fn judgement(label: &str, kind: &str, link: LinkJudgement) -> Judgement {
    Judgement {
        label: label.into(),
        numbered: true,
        section: "1 回転 <rotation>".into(),
        numbers: Vec::new(),
        file: None,
        line: 10 * label.chars().filter_map(|c| c.to_digit(10)).fold(0, |n, d| 10 * n + d as usize),
        latex: link.latex.clone(),
        kind: kind.into(),
        verdict: link.verdict,
        strength: link.strength,
        bits: link.bits,
        states: link.states,
        as_printed: true,
        reading: None,
        given: Vec::new(),
        assumptions: Vec::new(),
        because: None,
        reason: None,
        counterexample: link.counterexample.clone(),
        links: vec![link],
        correction: None,
        dimension: DimensionStatus::Unchecked,
        dimension_findings: Vec::new(),
        expect: None,
        as_expected: true,
        sensitivity: None,
        suggestions: Vec::new(),
        lost_bits: None,
        inferred: None,
        suspect: None,
        unfinished: None,
        micros: 118,
        problem: None,
    }
}

fn certificate() -> Certificate {
    let exact = |symbol: &str, value: &str, idle| ExactValue { symbol: symbol.into(), value: value.into(), idle };
    let enclosure = |name: Option<&str>, low: &str, high: &str| Enclosure {
        name: name.map(str::to_owned),
        low: low.into(),
        high: high.into(),
        idle: false,
    };
    Certificate {
        bits: Some(64),
        state: vec![exact(r"\theta", "7/10", false), exact("I_0", "5/4", false), exact(r"\psi", "1", true)],
        solved: vec![enclosure(Some(r"\dot{\varphi}"), "-0.500001", "-0.5")],
        differences: vec![enclosure(Some(r"\xi component"), "-0.177892", "-0.177891")],
    }
}

fn erratum() -> Judgement {
    let counterexample = Counterexample {
        state: [(r"\theta", "0.70"), (r"I_0", "1.25"), (r"\dot{\varphi}", "-0.5")]
            .map(|(symbol, value)| Assignment { symbol: symbol.into(), value: value.into() })
            .into(),
        lhs: "-0.5".into(),
        rhs: "-0.32210884361884557".into(),
        component: Some(r"\xi component".into()),
        certificate: Some(certificate()),
        uncertified: None,
    };
    let failing = LinkJudgement {
        strength: Some(Strength::Certified),
        residual: Some(0.36),
        bits: Some(1),
        states: 64,
        failing_states: 64,
        counterexample: Some(counterexample),
        ..link(r"\dot{\varphi} = \frac{L_z - I_1 \Omega \cos \theta}{I_0 \sin \theta}", Verdict::Fails)
    };
    let term = |latex: &str, dimension: &str| TermDimension { latex: latex.into(), dimension: dimension.into() };
    let finding = DimensionFinding {
        message: r"the term $L_z$ has the dimension kg m² s⁻¹, the other s⁻¹; a factor $\frac{1}{I_0}$ would mend it"
            .into(),
        link: failing.latex.clone(),
        terms: vec![term(r"\Omega", "s⁻¹"), term("L_z", "kg m² s⁻¹")],
        found: Some("kg m² s⁻¹".into()),
        expected: Some("s⁻¹".into()),
        factors: vec![r"\frac{1}{I_0}".into()],
    };
    let mended = r"\dot{\varphi} = \frac{L_z - I_1 \Omega \cos \theta}{I_0 \sin^2 \theta}";
    Judgement {
        given: vec!["1".into(), "99".into()],
        assumptions: vec![r"\sin\theta \ne 0".into()],
        reason: Some(r"the square of $\sin\theta$ is missing".into()),
        correction: Some(Correction {
            latex: mended.into(),
            verdict: Verdict::Holds,
            dimension: DimensionStatus::Ok,
            links: vec![agreeing(mended)],
            problem: None,
        }),
        dimension: DimensionStatus::Mismatch,
        dimension_findings: vec![finding],
        expect: Some(Verdict::Fails),
        ..judgement("56", "derived", failing)
    }
}

fn approximation() -> Judgement {
    let order = Order {
        small: r"\varepsilon".into(),
        claimed: 1.0,
        measured: 1.02,
        residuals: vec![(0.1, 0.2), (0.05, 0.098), (0.025, 0.0483)],
    };
    let link = LinkJudgement {
        strength: Some(Strength::Asymptotic),
        order: Some(order),
        states: 8,
        ..link(r"\dot{\varphi} \approx \frac{mgl}{I_1 \Omega} \quad \text{歳差運動が遅い場合}", Verdict::Asymptotic)
    };
    judgement("72", "approximation", link)
}

fn chain() -> Judgement {
    let differing = LinkJudgement {
        strength: Some(Strength::Numeric),
        residual: Some(1.7),
        states: 64,
        failing_states: 63,
        reason: Some("the sides differ by a sign at every state but one".into()),
        lost_bits: Some(LostBits { mean: 0.9, worst: 3.1 }),
        ..link(r"b = -c", Verdict::Fails)
    };
    let links = vec![agreeing("a = b"), differing];
    Judgement {
        latex: r"\begin{aligned} a &= b \\ &= -c \end{aligned}".into(),
        lost_bits: Some(LostBits { mean: 0.9, worst: 3.1 }),
        verdict: Verdict::Fails,
        as_expected: false,
        section: r"2 `code` and $\omega'$".into(),
        links,
        ..judgement("56.1", "identity", agreeing("a = b"))
    }
}

fn others() -> Vec<Judgement> {
    let reasoned = |label: &str, latex: &str, verdict, reason: &str| Judgement {
        reason: Some(reason.into()),
        section: "3 残り".into(),
        ..judgement(label, "derived", link(latex, verdict))
    };
    let mut shape = reasoned("83", r"\mathbf{L} = I_0", Verdict::Fails, "a vector and a scalar cannot be equal");
    shape.strength = Some(Strength::Shape);
    shape.as_expected = false;
    let mut expected_otherwise = reasoned("90", "1 = 1", Verdict::Holds, "the misprint has been mended");
    expected_otherwise.expect = Some(Verdict::Fails);
    expected_otherwise.as_expected = false;
    vec![
        reasoned("80", r"\text{これから}", Verdict::Statement, "nothing is printed but words"),
        reasoned("81", r"x = y", Verdict::Undecided, "the symbol $y$ is not declared"),
        reasoned("82", r"\frac{a}{<b>", Verdict::Unreadable, "expected `}` at byte 11, found the end"),
        shape,
        expected_otherwise,
    ]
}

/// The chart of the fixture: any chart, small.
fn chart() -> Chart {
    Chart {
        id: "chart-fixture".into(),
        title: "A chart".into(),
        caption: "Of $x$ & nothing else.".into(),
        svg: "<svg viewBox=\"0 0 1 1\" role=\"img\" aria-label=\"A chart\"></svg>\n".into(),
        legend: vec![charts::LegendEntry { class: "line-1".into(), marker: None, label: "$L_z$".into() }],
        table: charts::Table { head: vec!["$x$".into(), "y".into()], rows: vec![vec!["1".into(), "2".into()]] },
    }
}

/// The run.
pub(super) fn run() -> Run {
    let mut definition = judgement("1", "definition", link(r"\Omega \equiv \dot\psi", Verdict::Definition));
    definition.because = Some("introduces $\\Omega$".into());
    let mut identity = judgement("2", "identity", agreeing(r"\sin^2\theta + \cos^2\theta = 1"));
    identity.strength = Some(Strength::Exact);
    identity.links[0].strength = Some(Strength::Exact);
    identity.links[0].exact = Some(Exact { trials: 3, log2_error: -147 });
    let mut damaged = judgement("3", "identity", agreeing(r"\frac{d\theta}{dt} = \dot\theta"));
    damaged.latex = r"\frac{d\thetaa}{dt} = \dot\theta".into();
    damaged.as_printed = false;
    damaged.reading = Some(r"\frac{d\theta}{dt} = \dot\theta".into());
    damaged.numbered = false;
    let mut equations = vec![definition, identity, damaged, erratum(), approximation(), chain()];
    equations.extend(others());
    equations.extend(unannotated());
    let first = DocumentReport {
        assumed: vec![assumed()],
        name: "gyroscope".into(),
        path: "notes/gyroscope.md".into(),
        title: "ジャイロスコープ & <tops>".into(),
        inferred: vec![InferredDimension {
            symbol: "L'_{\\xi}".into(),
            dimension: "kg m² s⁻¹".into(),
            from: "16".into(),
        }],
        problems: vec![unclosed()],
        equations,
    };
    Run {
        seed: 42,
        states: 64,
        precision: None,
        documents: vec![first, empty()],
        charts: Some(|_| Ok(vec![chart()])),
        micros: 31_400,
    }
}

/// A problem of a document.
pub(super) fn unclosed() -> Finding {
    let text = "notes/gyroscope.md:7:1: a display is not closed: `$$ a`".into();
    Finding { text, is_error: true, file: "notes/gyroscope.md".into(), line: 7, column: 1 }
}

/// A document without equations.
pub(super) fn empty() -> DocumentReport {
    DocumentReport {
        assumed: Vec::new(),
        name: "empty".into(),
        path: "notes/empty.md".into(),
        title: "Empty".into(),
        problems: Vec::new(),
        inferred: Vec::new(),
        equations: Vec::new(),
    }
}

/// Equations that nothing is annotated of: one whose premises were found, one that would follow after an edit.
fn unannotated() -> Vec<Judgement> {
    let mut found = judgement("91", "derived", agreeing(r"v = r \dot{\varphi}"));
    found.given = vec!["56".into()];
    found.inferred = Some(Inferred {
        given: vec!["56".into()],
        formulas: vec![r"r = l \sin\theta".into()],
        needs: vec!["r > 0".into()],
        ..Inferred::default()
    });
    let mut suspected = judgement("92", "identity", link(r"a = r \dot{\varphi}", Verdict::Undecided));
    suspected.as_expected = false;
    suspected.reason = Some(
        "it does not follow from what stands before it; with one edit it would follow from (91): `r` squared".into(),
    );
    suspected.suspect = Some(Suspect {
        edit: "`r` squared".into(),
        latex: r"a = r^2 \dot{\varphi}".into(),
        label: "92".into(),
        premises: vec!["91".into(), "$k = r^2$".into()],
        diff: Some(Difference {
            printed: r"a = [-r-] \dot{\varphi}".into(),
            suggested: r"a = {+r^2+} \dot{\varphi}".into(),
        }),
    });
    vec![found, suspected]
}

/// A symbol that is declared nowhere.
fn assumed() -> Assumed {
    Assumed { symbol: r"\theta".into(), role: "an angle".into(), range: Some([0.2, 1.4]), moves: true, line: 7 }
}
