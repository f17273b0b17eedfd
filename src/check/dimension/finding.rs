//! A mismatch of dimensions in words.

use crate::semantics::Role;
use crate::semantics::units::Dimension;

use super::affine::Affine;
use super::reading::{JointReading, LinkReading};
use super::{Group, Survey};
use crate::check::verdict::{DimensionFinding, TermDimension};

impl Survey<'_> {
    /// The finding that the parts of a joint fall into groups of different dimensions.
    pub(super) fn finding(
        &self,
        index: usize,
        link: &LinkReading,
        joint: &JointReading,
        groups: &[Group],
    ) -> DimensionFinding {
        let mut finding = DimensionFinding {
            message: String::new(),
            link: link.latex.clone(),
            terms: self.terms(joint, groups),
            found: None,
            expected: None,
            factors: Vec::new(),
        };
        if let Some((part, function)) = stray(joint, groups) {
            let latex = &joint.parts[part];
            finding.message = format!(
                "the term ${latex}$ is a number and would fit into the argument of {function} before it: are brackets missing?"
            );
            let rest = without(groups, part);
            if rest.len() > 1 {
                let rest = self.finding(index, link, joint, &rest);
                finding.message += &format!(" Without it, {}", rest.message);
                (finding.found, finding.expected, finding.factors) = (rest.found, rest.expected, rest.factors);
            }
            return finding;
        }
        let Some((odd, others)) = two(groups) else {
            let each = finding.terms.iter().map(|t| format!("${}$ {}", t.latex, t.dimension));
            finding.message = format!("the terms have different dimensions: {}", each.collect::<Vec<_>>().join(", "));
            return finding;
        };
        let (found, expected) = (self.shown(&odd.dimension), self.shown(&others.dimension));
        finding.message = match &joint.role {
            Role::Argument(name) => {
                format!("the argument ${}$ of {name} has the dimension {found} and must be a number", joint.parts[0])
            }
            Role::Exponent => {
                format!("the exponent ${}$ has the dimension {found} and must be a number", joint.parts[0])
            }
            Role::Sum => format!("{} {found}, {} {expected}", subject(joint, odd, others), rest(joint, odd, others)),
        };
        let ratio = others.dimension.over(&odd.dimension).and_then(|r| r.dimension());
        finding.factors = ratio.map(|need| self.uses.factors(self.book, index, need)).unwrap_or_default();
        if !finding.factors.is_empty() {
            let factors: Vec<String> = finding.factors.iter().map(|f| format!("${f}$")).collect();
            finding.message += &format!("; a factor {} would mend it", factors.join(" or "));
        }
        (finding.found, finding.expected) = (Some(found), Some(expected));
        finding
    }

    /// The finding that an operation within a formula joins different dimensions.
    pub(super) fn implied(&self, link: &LinkReading, a: &Affine, b: &Affine) -> DimensionFinding {
        let (a, b) = (self.shown(a), self.shown(b));
        DimensionFinding {
            message: format!("within ${}$ the dimensions {a} and {b} meet", link.latex),
            link: link.latex.clone(),
            terms: Vec::new(),
            found: Some(b),
            expected: Some(a),
            factors: Vec::new(),
        }
    }

    fn terms(&self, joint: &JointReading, groups: &[Group]) -> Vec<TermDimension> {
        let of = |part: usize| groups.iter().find(|g| g.parts.contains(&part));
        let parts = joint.parts.iter().enumerate();
        let term = |(part, latex): (usize, &String)| {
            Some(TermDimension { latex: latex.clone(), dimension: self.shown(&of(part)?.dimension) })
        };
        parts.filter_map(term).collect()
    }

    /// A dimension, unknown ones by the name of their symbol.
    fn shown(&self, a: &Affine) -> String {
        let unknown: Vec<String> = a
            .unknown
            .iter()
            .map(|(quantity, (n, d))| {
                let name = &self.quantities.all[*quantity].name;
                let exponent = if *d == 1 { n.to_string() } else { format!("{n}/{d}") };
                if exponent == "1" { format!("[${name}$]") } else { format!("[${name}$]^({exponent})") }
            })
            .collect();
        match (unknown.is_empty(), a.known == Dimension::NONE) {
            (true, _) => a.known.to_string(),
            (false, true) => unknown.join(" "),
            (false, false) => format!("{} {}", unknown.join(" "), a.known),
        }
    }
}

/// A number among terms of another dimension, behind a function whose argument has no brackets.
fn stray<'j>(joint: &'j JointReading, groups: &[Group]) -> Option<(usize, &'j str)> {
    let number = groups.iter().find(|g| g.dimension.dimension().is_some_and(|d| d.is_none()))?;
    let [part] = *number.parts.as_slice() else { return None };
    let before = part.checked_sub(1).filter(|before| joint.left <= *before || part < joint.left)?;
    Some((part, joint.open.get(before)?.as_deref()?))
}

fn without(groups: &[Group], part: usize) -> Vec<Group> {
    let rest = groups.iter().filter(|g| g.parts != [part]);
    rest.map(|g| Group { dimension: g.dimension.clone(), parts: g.parts.clone() }).collect()
}

/// The group that stands out and the other, where there are two: the smaller, or else the one that is printed later.
fn two(groups: &[Group]) -> Option<(&Group, &Group)> {
    match groups {
        [a, b] if a.parts == [usize::MAX] => Some((b, a)),
        [a, b] if a.parts.len() < b.parts.len() => Some((a, b)),
        [a, b] => Some((b, a)),
        _ => None,
    }
}

/// The sides as such, where they differ as a whole.
fn side(joint: &JointReading, group: &Group, other: &Group) -> Option<&'static str> {
    let left = |g: &Group| g.parts.iter().all(|p| *p < joint.left);
    let right = |g: &Group| g.parts.iter().all(|p| *p >= joint.left);
    match joint.left {
        0 => None,
        _ if left(group) && right(other) => Some("the left side"),
        _ if right(group) && left(other) => Some("the right side"),
        _ => None,
    }
}

fn subject(joint: &JointReading, odd: &Group, others: &Group) -> String {
    if let Some(side) = side(joint, odd, others) {
        return format!("{side} has the dimension");
    }
    let mut parts: Vec<String> =
        odd.parts.iter().filter_map(|p| joint.parts.get(*p)).map(|p| format!("${p}$")).collect();
    parts.dedup();
    match parts.as_slice() {
        [part] => format!("the term {part} has the dimension"),
        parts => format!("the terms {} have the dimension", parts.join(", ")),
    }
}

fn rest(joint: &JointReading, odd: &Group, others: &Group) -> &'static str {
    match side(joint, others, odd) {
        Some(side) => side,
        _ if others.parts.len() == 1 => "the other",
        _ => "the others",
    }
}
