//! The identities that stable forms are searched with. Each holds for real numbers wherever both sides are defined;
//! a test puts each of them to the check that also judges the results ([`super::same`]).
//!
//! Where they are from: the conjugate of a difference of roots, the "citardauq" form of the roots of a quadratic and the
//! half angles for 1 - cos are in Higham, *Accuracy and Stability of Numerical Algorithms*, 2nd ed. 2002, sections 1.7 and
//! 1.8; the arc cosine by the arc tangent in Kahan, *Branch cuts for complex elementary functions*, 1987; the squares of
//! sn, cn, dn in DLMF 22.6.1 to 22.6.3. The hyperbolic functions stand for expm1 and log1p, which a tape does not have.

use egg::{Analysis, DidMerge, EGraph, Id, Language, Pattern, Rewrite, Subst, Var};

use super::term::{Fraction, Term};

/// What is known of a class: the constant that it is.
#[derive(Default)]
pub struct Constants;

/// A rewriting rule.
pub type Rule = Rewrite<Term, Constants>;

impl Analysis<Term> for Constants {
    type Data = Option<Fraction>;

    fn make(graph: &mut EGraph<Term, Self>, node: &Term, _: Id) -> Self::Data {
        let at = |id: &Id| graph[*id].data;
        match node {
            Term::Constant(f) => Some(*f),
            Term::Add([a, b]) => at(a)?.plus(at(b)?),
            Term::Sub([a, b]) => at(a)?.plus(at(b)?.negated()?),
            Term::Mul([a, b]) => at(a)?.times(at(b)?),
            Term::Div([a, b]) => at(a)?.times(at(b)?.reciprocal()?),
            Term::Neg(a) => at(a)?.negated(),
            Term::Square(a) => at(a)?.times(at(a)?),
            _ => None,
        }
    }

    fn merge(&mut self, a: &mut Self::Data, b: Self::Data) -> DidMerge {
        egg::merge_option(a, b, |a, b| DidMerge(false, *a != b))
    }

    fn modify(graph: &mut EGraph<Term, Self>, id: Id) {
        if let Some(f) = graph[id].data {
            let constant = graph.add(Term::Constant(f));
            graph.union(id, constant);
        }
    }
}

/// An identity: its name, its sides, and in which direction it is used.
pub struct Identity {
    /// The name.
    pub name: &'static str,
    /// The left side.
    pub left: &'static str,
    /// The right side.
    pub right: &'static str,
    both: bool,
    condition: Condition,
}

/// Where an identity is used.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Condition {
    Anywhere,
    /// Where `?a` is not the constant zero.
    NotZero,
    /// Where `?a` is not itself a half of something: else angles are halved for ever.
    NotHalved,
}

const fn from_left(name: &'static str, left: &'static str, right: &'static str) -> Identity {
    Identity { name, left, right, both: false, condition: Condition::Anywhere }
}

const fn both_ways(name: &'static str, left: &'static str, right: &'static str) -> Identity {
    Identity { name, left, right, both: true, condition: Condition::Anywhere }
}

const fn for_not_zero(name: &'static str, left: &'static str, right: &'static str) -> Identity {
    Identity { name, left, right, both: false, condition: Condition::NotZero }
}

const fn once_halved(name: &'static str, left: &'static str, right: &'static str) -> Identity {
    Identity { name, left, right, both: false, condition: Condition::NotHalved }
}

/// The identities.
pub const IDENTITIES: &[Identity] = &[
    // Sums and products.
    from_left("commute sum", "(+ ?a ?b)", "(+ ?b ?a)"),
    from_left("commute product", "(* ?a ?b)", "(* ?b ?a)"),
    both_ways("associate sum", "(+ ?a (+ ?b ?c))", "(+ (+ ?a ?b) ?c)"),
    both_ways("associate product", "(* ?a (* ?b ?c))", "(* (* ?a ?b) ?c)"),
    both_ways("subtract", "(- ?a ?b)", "(+ ?a (neg ?b))"),
    from_left("negate difference", "(neg (- ?a ?b))", "(- ?b ?a)"),
    from_left("negate twice", "(neg (neg ?a))", "?a"),
    both_ways("negate product", "(neg (* ?a ?b))", "(* (neg ?a) ?b)"),
    both_ways("negate quotient", "(neg (/ ?a ?b))", "(/ (neg ?a) ?b)"),
    from_left("nothing left", "(- ?a ?a)", "0"),
    from_left("term back", "(- (+ ?a ?b) ?a)", "?b"),
    from_left("difference back", "(- ?a (- ?a ?b))", "?b"),
    from_left("add zero", "(+ ?a 0)", "?a"),
    from_left("times one", "(* ?a 1)", "?a"),
    from_left("over one", "(/ ?a 1)", "?a"),
    from_left("twice", "(+ ?a ?a)", "(* 2 ?a)"),
    both_ways("factor sum", "(+ (* ?a ?b) (* ?a ?c))", "(* ?a (+ ?b ?c))"),
    both_ways("factor difference", "(- (* ?a ?b) (* ?a ?c))", "(* ?a (- ?b ?c))"),
    from_left("factor first", "(- ?a (* ?a ?c))", "(* ?a (- 1 ?c))"),
    from_left("factor second", "(- (* ?a ?c) ?a)", "(* ?a (- ?c 1))"),
    from_left("factor term", "(+ ?a (* ?a ?c))", "(* ?a (+ 1 ?c))"),
    from_left("exact differences", "(- (* 3 ?a) (* 2 ?b))", "(+ ?a (* 2 (- ?a ?b)))"),
    from_left("exact difference", "(- (* 2 ?a) ?b)", "(+ ?a (- ?a ?b))"),
    // Quotients.
    both_ways("product of quotient", "(* ?a (/ ?b ?c))", "(/ (* ?a ?b) ?c)"),
    from_left("quotient of quotient", "(/ (/ ?a ?b) ?c)", "(/ ?a (* ?b ?c))"),
    from_left("quotient by quotient", "(/ ?a (/ ?b ?c))", "(/ (* ?a ?c) ?b)"),
    for_not_zero("cancel", "(/ (* ?a ?b) (* ?a ?c))", "(/ ?b ?c)"),
    for_not_zero("cancel below", "(/ (* ?a ?b) ?a)", "?b"),
    for_not_zero("cancel above", "(/ ?a (* ?a ?b))", "(/ 1 ?b)"),
    for_not_zero("cancel all", "(/ ?a ?a)", "1"),
    for_not_zero("cancel square", "(/ ?a (sq ?a))", "(/ 1 ?a)"),
    for_not_zero("cancel in square", "(/ (* ?a ?b) (sq ?a))", "(/ ?b ?a)"),
    from_left("same denominator", "(- (/ ?a ?c) (/ ?b ?c))", "(/ (- ?a ?b) ?c)"),
    from_left("denominators", "(- (/ ?a ?b) (/ ?c ?d))", "(/ (- (* ?a ?d) (* ?c ?b)) (* ?b ?d))"),
    from_left("sum of quotients", "(+ (/ ?a ?b) (/ ?c ?d))", "(/ (+ (* ?a ?d) (* ?c ?b)) (* ?b ?d))"),
    from_left("from whole", "(- ?a (/ ?b ?c))", "(/ (- (* ?a ?c) ?b) ?c)"),
    from_left("less whole", "(- (/ ?b ?c) ?a)", "(/ (- ?b (* ?a ?c)) ?c)"),
    // Squares and roots.
    both_ways("square", "(sq ?a)", "(* ?a ?a)"),
    both_ways("square of product", "(sq (* ?a ?b))", "(* (sq ?a) (sq ?b))"),
    both_ways("square of quotient", "(sq (/ ?a ?b))", "(/ (sq ?a) (sq ?b))"),
    from_left("square of negative", "(sq (neg ?a))", "(sq ?a)"),
    from_left("square of root", "(sq (sqrt ?a))", "?a"),
    from_left("root of square", "(sqrt (sq ?a))", "(abs ?a)"),
    both_ways("difference of squares", "(- (sq ?a) (sq ?b))", "(* (- ?a ?b) (+ ?a ?b))"),
    from_left("one less square", "(- 1 (sq ?a))", "(* (- 1 ?a) (+ 1 ?a))"),
    from_left("conjugate", "(- (sqrt ?a) ?b)", "(/ (- ?a (sq ?b)) (+ (sqrt ?a) ?b))"),
    from_left("conjugate of root", "(- ?b (sqrt ?a))", "(/ (- (sq ?b) ?a) (+ ?b (sqrt ?a)))"),
    from_left("conjugate of sum", "(+ ?b (sqrt ?a))", "(/ (- (sq ?b) ?a) (- ?b (sqrt ?a)))"),
    from_left("product of roots", "(* (sqrt ?a) (sqrt ?b))", "(sqrt (* ?a ?b))"),
    // Angles.
    from_left("1 - cos", "(- 1 (cos ?a))", "(* 2 (sq (sin (/ ?a 2))))"),
    from_left("1 + cos", "(+ 1 (cos ?a))", "(* 2 (sq (cos (/ ?a 2))))"),
    from_left("sine from cosine", "(- 1 (sq (cos ?a)))", "(sq (sin ?a))"),
    from_left("cosine from sine", "(- 1 (sq (sin ?a)))", "(sq (cos ?a))"),
    once_halved("half angles", "(sin ?a)", "(* 2 (* (sin (/ ?a 2)) (cos (/ ?a 2))))"),
    from_left("cos - cos", "(- (cos ?a) (cos ?b))", "(* 2 (* (sin (/ (+ ?a ?b) 2)) (sin (/ (- ?b ?a) 2))))"),
    from_left("sin - sin", "(- (sin ?a) (sin ?b))", "(* 2 (* (cos (/ (+ ?a ?b) 2)) (sin (/ (- ?a ?b) 2))))"),
    from_left("sine of difference", "(- (* (sin ?a) (cos ?b)) (* (cos ?a) (sin ?b)))", "(sin (- ?a ?b))"),
    from_left("cosine of sum", "(- (* (cos ?a) (cos ?b)) (* (sin ?a) (sin ?b)))", "(cos (+ ?a ?b))"),
    from_left("arc cosine", "(arccos ?a)", "(* 2 (arctan (sqrt (/ (- 1 ?a) (+ 1 ?a)))))"),
    from_left("arc sine", "(arcsin ?a)", "(arctan (/ ?a (sqrt (* (- 1 ?a) (+ 1 ?a)))))"),
    // Exponentials.
    from_left("cosh - 1", "(- (cosh ?a) 1)", "(* 2 (sq (sinh (/ ?a 2))))"),
    from_left("exp - 1", "(- (exp ?a) 1)", "(* 2 (* (exp (/ ?a 2)) (sinh (/ ?a 2))))"),
    from_left("logarithm near 1", "(ln (+ 1 ?a))", "(* 2 (artanh (/ ?a (+ 2 ?a))))"),
    from_left("ln - ln", "(- (ln ?a) (ln ?b))", "(* 2 (artanh (/ (- ?a ?b) (+ ?a ?b))))"),
    from_left("1 - tanh", "(- 1 (tanh ?a))", "(/ 2 (+ (exp (* 2 ?a)) 1))"),
    from_left("1 - tanh²", "(- 1 (sq (tanh ?a)))", "(/ 1 (sq (cosh ?a)))"),
    // Jacobi's functions of the modulus k.
    from_left("cn from sn", "(- 1 (sq (sn ?u ?k)))", "(sq (cn ?u ?k))"),
    from_left("sn from cn", "(- 1 (sq (cn ?u ?k)))", "(sq (sn ?u ?k))"),
    from_left("dn from sn", "(- 1 (* (sq ?k) (sq (sn ?u ?k))))", "(sq (dn ?u ?k))"),
    from_left("dn from sn in one square", "(- 1 (sq (* ?k (sn ?u ?k))))", "(sq (dn ?u ?k))"),
    from_left("dn near k = 1", "(sq (dn ?u ?k))", "(+ (sq (cn ?u ?k)) (* (- 1 (sq ?k)) (sq (sn ?u ?k))))"),
];

/// The identities as rewriting rules; those that do not parse, of which a test says that there are none, are left
/// out.
pub fn rules() -> Vec<Rule> {
    let mut rules = Vec::new();
    for identity in IDENTITIES {
        rules.extend(rule(identity, identity.name.to_owned(), identity.left, identity.right));
        if identity.both {
            rules.extend(rule(identity, format!("{}, back", identity.name), identity.right, identity.left));
        }
    }
    rules
}

fn rule(identity: &Identity, name: String, left: &str, right: &str) -> Option<Rule> {
    let (left, right): (Pattern<Term>, Pattern<Term>) = (left.parse().ok()?, right.parse().ok()?);
    let a: Var = "?a".parse().ok()?;
    let zero = move |graph: &EGraph<Term, Constants>, s: &Subst| {
        s.get(a).is_some_and(|id| graph[*id].data.is_some_and(|f| f.0 == 0))
    };
    let halved = move |graph: &EGraph<Term, Constants>, s: &Subst| {
        let two = |id: &Id| graph[*id].data == Some(Fraction(2, 1));
        let half = |n: &Term| n.is_leaf() && matches!(n, Term::Constant(_)) || matches!(n, Term::Div([_, b]) if two(b));
        s.get(a).is_some_and(|id| graph[*id].nodes.iter().any(half))
    };
    match identity.condition {
        Condition::Anywhere => Rewrite::new(name, left, right).ok(),
        Condition::NotZero => {
            let unless = move |g: &mut EGraph<Term, Constants>, _: Id, s: &Subst| !zero(g, s);
            Rewrite::new(name, left, egg::ConditionalApplier { condition: unless, applier: right }).ok()
        }
        Condition::NotHalved => {
            let unless = move |g: &mut EGraph<Term, Constants>, _: Id, s: &Subst| !halved(g, s);
            Rewrite::new(name, left, egg::ConditionalApplier { condition: unless, applier: right }).ok()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::Random;
    use crate::check::computed::Variable;
    use crate::diagnose::stability::same::{Sameness, same};
    use crate::diagnose::stability::term;
    use crate::expr::{Expr, Graph};
    use egg::{ENodeOrVar, RecExpr};

    /// A pattern as an expression: its variables are symbols.
    fn expression(graph: &mut Graph, pattern: &str) -> Expr {
        let pattern: Pattern<Term> = pattern.parse().unwrap();
        let mut leaves = Vec::new();
        let nodes = pattern.ast.as_ref().iter().map(|node| match node {
            ENodeOrVar::ENode(node) => node.clone(),
            ENodeOrVar::Var(v) => {
                let symbol = graph.symbol(&v.to_string());
                leaves.push(graph.sym(symbol));
                Term::Leaf(term::Leaf(leaves.len() as u32 - 1))
            }
        });
        let nodes: RecExpr<Term> = nodes.collect::<Vec<_>>().into();
        term::expression(graph, &nodes, &leaves).unwrap()
    }

    fn sameness(left: &str, right: &str) -> Sameness {
        let mut graph = Graph::new();
        let (a, b) = (expression(&mut graph, left), expression(&mut graph, right));
        let symbols = graph.symbols(&[a, b]);
        // In (0, 1) moduli are moduli, and every function is defined.
        let variable = |s| Variable { symbol: s, tex: graph.info(s).name.clone(), range: [0.05, 0.95], integer: false };
        let variables: Vec<Variable> = symbols.into_iter().map(variable).collect();
        same(&mut graph, &[a], &[b], &variables, &mut Random::new(1, left))
    }

    #[test]
    fn every_rule_is_an_identity() {
        let mut exact = 0;
        for identity in IDENTITIES {
            let found = sameness(identity.left, identity.right);
            assert!(found.holds(), "{}: {found:?}", identity.name);
            exact += usize::from(matches!(found, Sameness::Exact { .. }));
        }
        println!("{exact} of {} are exact", IDENTITIES.len());
        assert!(exact * 2 > IDENTITIES.len());
        let count = IDENTITIES.iter().map(|i| 1 + usize::from(i.both)).sum::<usize>();
        assert_eq!(rules().len(), count, "every rule parses");
    }

    #[test]
    fn what_is_no_identity_is_noticed() {
        for (left, right) in [
            ("(- (sq ?a) (sq ?b))", "(* (- ?a ?b) (- ?a ?b))"),
            ("(- 1 (cos ?a))", "(* 2 (sq (sin ?a)))"),
            ("(- (sqrt ?a) ?b)", "(/ (- ?a ?b) (+ (sqrt ?a) ?b))"),
            ("(arccos ?a)", "(arctan (sqrt (/ (- 1 ?a) (+ 1 ?a))))"),
            ("(sq (dn ?u ?k))", "(+ (sq (cn ?u ?k)) (* (- 1 ?k) (sq (sn ?u ?k))))"),
            ("(ln (+ 1 ?a))", "?a"),
        ] {
            assert_eq!(sameness(left, right), Sameness::Different, "{left} {right}");
        }
    }
}
