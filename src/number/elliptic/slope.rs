//! The partial derivatives, by arithmetic and related functions: written once, for graphs, dual numbers and Taylor
//! series.
//!
//! Sources: DLMF 19.4 and 22.13 for what they have. Derivatives with respect to the modulus are by D = ∫ sin²/Δ and
//! G = ∫ sin²/Δ³: ∂F/∂k = kG, ∂E/∂k = -kD, ∂D/∂k = (G - D)/k, as one sees under the integral; am(u, k) is the inverse
//! of F; Π by partial fractions. Carlson's by DLMF 19.18.1 and the same; the last argument by Euler's theorem on
//! homogeneous functions.

use super::Elliptic;

/// What derivatives are made with.
pub trait Rules {
    /// A value or expression.
    type Value: Clone;
    /// The argument at this position.
    fn argument(&mut self, i: usize) -> Self::Value;
    /// A function of the arguments at these positions.
    fn related(&mut self, f: Elliptic, of: &[usize]) -> Self::Value;
    /// An integer.
    fn int(&mut self, n: i32) -> Self::Value;
    /// a + b.
    fn add(&mut self, a: &Self::Value, b: &Self::Value) -> Self::Value;
    /// a - b.
    fn sub(&mut self, a: &Self::Value, b: &Self::Value) -> Self::Value;
    /// a b.
    fn mul(&mut self, a: &Self::Value, b: &Self::Value) -> Self::Value;
    /// a / b.
    fn div(&mut self, a: &Self::Value, b: &Self::Value) -> Self::Value;
    /// √a.
    fn sqrt(&mut self, a: &Self::Value) -> Self::Value;
    /// Sine and cosine.
    fn sin_cos(&mut self, a: &Self::Value) -> (Self::Value, Self::Value);

    /// -a.
    fn neg(&mut self, a: &Self::Value) -> Self::Value {
        let zero = self.int(0);
        self.sub(&zero, a)
    }
    /// a b c.
    fn mul3(&mut self, a: &Self::Value, b: &Self::Value, c: &Self::Value) -> Self::Value {
        let ab = self.mul(a, b);
        self.mul(&ab, c)
    }
}

/// The derivative of f, whose arguments are those at the positions `of`, with respect to its argument number `by`.
pub fn slope<R: Rules>(r: &mut R, f: Elliptic, of: &[usize], by: usize) -> R::Value {
    match f {
        _ if f.is_jacobi() => jacobi(r, f, of, by),
        Elliptic::CompleteK | Elliptic::CompleteE | Elliptic::CompleteD | Elliptic::CompleteG => complete(r, f, of),
        Elliptic::CompletePi => {
            let parts = third_parts(r, of, None);
            if by == 0 { third_by_n(r, &parts, None) } else { third_by_k(r, &parts) }
        }
        Elliptic::IncompletePi => incomplete_third(r, of, by),
        Elliptic::Rc | Elliptic::Rf | Elliptic::Rd | Elliptic::Rj => carlson(r, f, of, by),
        _ => incomplete(r, f, of, by),
    }
}

/// (G - D)/k.
fn d_by_k<R: Rules>(r: &mut R, d: &R::Value, g: &R::Value, k: &R::Value) -> R::Value {
    let difference = r.sub(g, d);
    r.div(&difference, k)
}

/// ∂G/∂k = (3kG - ∂D/∂k - k sin³ cos/Δ³)/k'², where the last term is missing in the complete one.
fn g_by_k<R: Rules>(r: &mut R, d: &R::Value, g: &R::Value, k: &R::Value, last: Option<R::Value>) -> R::Value {
    let three = r.int(3);
    let (first, second) = (r.mul3(&three, k, g), d_by_k(r, d, g, k));
    let mut numerator = r.sub(&first, &second);
    if let Some(last) = last {
        let term = r.mul(k, &last);
        numerator = r.sub(&numerator, &term);
    }
    let m1 = complementary(r, k);
    r.div(&numerator, &m1)
}

/// k'² = (1 - k)(1 + k).
fn complementary<R: Rules>(r: &mut R, k: &R::Value) -> R::Value {
    let one = r.int(1);
    let (less, more) = (r.sub(&one, k), r.add(&one, k));
    r.mul(&less, &more)
}

/// Jacobi's functions. ∂am/∂k = -k dn ∫sd².
fn jacobi<R: Rules>(r: &mut R, f: Elliptic, of: &[usize], by: usize) -> R::Value {
    let k = r.argument(of[1]);
    let [sn, cn, dn] = [Elliptic::Sn, Elliptic::Cn, Elliptic::Dn].map(|f| r.related(f, of));
    let s2 = r.mul(&sn, &sn);
    if by == 0 {
        return match f {
            Elliptic::Sn => r.mul(&cn, &dn),
            Elliptic::Cn => {
                let product = r.mul(&sn, &dn);
                r.neg(&product)
            }
            Elliptic::Dn => {
                let (k2, product) = (r.mul(&k, &k), r.mul(&sn, &cn));
                let product = r.mul(&k2, &product);
                r.neg(&product)
            }
            Elliptic::Am => dn,
            Elliptic::JacobiD => s2,
            _ => {
                let d2 = r.mul(&dn, &dn);
                r.div(&s2, &d2)
            }
        };
    }
    let g = r.related(Elliptic::JacobiG, of);
    let am = {
        let product = r.mul3(&k, &dn, &g);
        r.neg(&product)
    };
    match f {
        Elliptic::Sn => r.mul(&cn, &am),
        Elliptic::Cn => {
            let product = r.mul(&sn, &am);
            r.neg(&product)
        }
        Elliptic::Dn => {
            // k³ sn cn G - k sn²/dn
            let (product, k2) = (r.mul3(&sn, &cn, &g), r.mul(&k, &k));
            let product = r.mul(&k2, &product);
            let quotient = r.div(&s2, &dn);
            let difference = r.sub(&product, &quotient);
            r.mul(&k, &difference)
        }
        Elliptic::Am => am,
        Elliptic::JacobiD => {
            let d = r.related(Elliptic::JacobiD, of);
            let (own, moved) = (d_by_k(r, &d, &g, &k), r.mul(&s2, &am));
            let moved = r.div(&moved, &dn);
            r.add(&own, &moved)
        }
        _ => {
            let d = r.related(Elliptic::JacobiD, of);
            let d2 = r.mul(&dn, &dn);
            let d3 = r.mul(&d2, &dn);
            let sc = r.mul(&sn, &cn);
            let last = r.mul(&s2, &sc);
            let last = r.div(&last, &d3);
            let own = g_by_k(r, &d, &g, &k, Some(last));
            let moved = r.mul(&s2, &am);
            let moved = r.div(&moved, &d3);
            r.add(&own, &moved)
        }
    }
}

/// K, E, D and G of k.
fn complete<R: Rules>(r: &mut R, f: Elliptic, of: &[usize]) -> R::Value {
    let k = r.argument(of[0]);
    let d = r.related(Elliptic::CompleteD, of);
    if f == Elliptic::CompleteE {
        let product = r.mul(&k, &d);
        return r.neg(&product);
    }
    let g = r.related(Elliptic::CompleteG, of);
    match f {
        Elliptic::CompleteK => r.mul(&k, &g),
        Elliptic::CompleteD => d_by_k(r, &d, &g, &k),
        _ => g_by_k(r, &d, &g, &k, None),
    }
}

/// sin², sin cos and Δ² = cos² + k'² sin² of an amplitude.
struct Amplitude<V> {
    sin2: V,
    sin_cos: V,
    delta2: V,
}

fn amplitude<R: Rules>(r: &mut R, phi: &R::Value, k: &R::Value) -> Amplitude<R::Value> {
    let (sin, cos) = r.sin_cos(phi);
    let (sin2, cos2) = (r.mul(&sin, &sin), r.mul(&cos, &cos));
    let m1 = complementary(r, k);
    let rest = r.mul(&m1, &sin2);
    Amplitude { sin_cos: r.mul(&sin, &cos), delta2: r.add(&cos2, &rest), sin2 }
}

/// F, E, D and G of φ and k.
fn incomplete<R: Rules>(r: &mut R, f: Elliptic, of: &[usize], by: usize) -> R::Value {
    let (phi, k) = (r.argument(of[0]), r.argument(of[1]));
    if by == 1 && f == Elliptic::IncompleteF {
        let g = r.related(Elliptic::IncompleteG, of);
        return r.mul(&k, &g);
    }
    if by == 1 && f == Elliptic::IncompleteE {
        let d = r.related(Elliptic::IncompleteD, of);
        let product = r.mul(&k, &d);
        return r.neg(&product);
    }
    let Amplitude { sin2, sin_cos, delta2 } = amplitude(r, &phi, &k);
    let delta = r.sqrt(&delta2);
    if by == 0 {
        return match f {
            Elliptic::IncompleteE => delta,
            Elliptic::IncompleteD => r.div(&sin2, &delta),
            Elliptic::IncompleteG => {
                let cube = r.mul(&delta, &delta2);
                r.div(&sin2, &cube)
            }
            _ => {
                let one = r.int(1);
                r.div(&one, &delta)
            }
        };
    }
    let (d, g) = (r.related(Elliptic::IncompleteD, of), r.related(Elliptic::IncompleteG, of));
    if f == Elliptic::IncompleteD {
        return d_by_k(r, &d, &g, &k);
    }
    let (product, cube) = (r.mul(&sin2, &sin_cos), r.mul(&delta, &delta2));
    let last = r.div(&product, &cube);
    g_by_k(r, &d, &g, &k, Some(last))
}

/// What the derivatives of Π consist of.
struct Third<V> {
    n: V,
    k: V,
    f: V,
    d: V,
    g: V,
    pi: V,
}

/// For Π(n, k), or Π(φ, n, k) where φ is at the position `phi`.
fn third_parts<R: Rules>(r: &mut R, of: &[usize], phi: Option<usize>) -> Third<R::Value> {
    use Elliptic::*;
    let (n, k) = (of[of.len() - 2], of[of.len() - 1]);
    let mut both = |complete: Elliptic, incomplete: Elliptic| match phi {
        None => r.related(complete, &[k]),
        Some(phi) => r.related(incomplete, &[phi, k]),
    };
    let (f, d, g) = (both(CompleteK, IncompleteF), both(CompleteD, IncompleteD), both(CompleteG, IncompleteG));
    let pi = r.related(if phi.is_none() { CompletePi } else { IncompletePi }, of);
    Third { n: r.argument(n), k: r.argument(k), f, d, g, pi }
}

/// ∂Π/∂k = k (Π - F - k²G)/(n - k²).
fn third_by_k<R: Rules>(r: &mut R, Third { n, k, f, g, pi, .. }: &Third<R::Value>) -> R::Value {
    let k2 = r.mul(k, k);
    let cube = r.mul(&k2, g);
    let rest = r.sub(pi, f);
    let rest = r.sub(&rest, &cube);
    let numerator = r.mul(k, &rest);
    let denominator = r.sub(n, &k2);
    r.div(&numerator, &denominator)
}

/// ∂Π/∂n = (nΠ - k²D - k²(Π - F)/n - n Δ sin cos/(1 - n sin²)) / (2 (k² - n)(n - 1)), where the last term is missing in
/// the complete one.
fn third_by_n<R: Rules>(r: &mut R, parts: &Third<R::Value>, last: Option<R::Value>) -> R::Value {
    let Third { n, k, f, d, pi, .. } = parts;
    let k2 = r.mul(k, k);
    let difference = r.sub(pi, f);
    let quotient = r.div(&difference, n);
    let sum = r.add(d, &quotient);
    let (first, second) = (r.mul(n, pi), r.mul(&k2, &sum));
    let mut numerator = r.sub(&first, &second);
    if let Some(last) = last {
        let term = r.mul(n, &last);
        numerator = r.sub(&numerator, &term);
    }
    let (one, two) = (r.int(1), r.int(2));
    let (left, right) = (r.sub(&k2, n), r.sub(n, &one));
    let denominator = r.mul3(&two, &left, &right);
    r.div(&numerator, &denominator)
}

fn incomplete_third<R: Rules>(r: &mut R, of: &[usize], by: usize) -> R::Value {
    if by == 2 {
        let parts = third_parts(r, of, Some(of[0]));
        return third_by_k(r, &parts);
    }
    let (phi, n, k) = (r.argument(of[0]), r.argument(of[1]), r.argument(of[2]));
    let Amplitude { sin2, sin_cos, delta2 } = amplitude(r, &phi, &k);
    let delta = r.sqrt(&delta2);
    let (one, product) = (r.int(1), r.mul(&n, &sin2));
    let p = r.sub(&one, &product);
    if by == 0 {
        let denominator = r.mul(&p, &delta);
        return r.div(&one, &denominator);
    }
    let numerator = r.mul(&delta, &sin_cos);
    let last = r.div(&numerator, &p);
    let parts = third_parts(r, of, Some(of[0]));
    third_by_n(r, &parts, Some(last))
}

/// Carlson's integrals. ∂R_F/∂x = -R_D(y, z, x)/6, ∂R_J/∂x = (R_J - R_D(y, z, x))/(2 (p - x)), of which R_D is the case
/// p = z; ∂R_C/∂x = (R_C - 1/√x)/(2 (y - x)).
fn carlson<R: Rules>(r: &mut R, f: Elliptic, of: &[usize], by: usize) -> R::Value {
    let last = f.arity() - 1;
    if by == last && f != Elliptic::Rf {
        return by_homogeneity(r, f, of);
    }
    let x = r.argument(of[by]);
    let steep = match f {
        Elliptic::Rc => {
            let (one, root) = (r.int(1), r.sqrt(&x));
            r.div(&one, &root)
        }
        _ => r.related(Elliptic::Rd, &[of[(by + 1) % 3], of[(by + 2) % 3], of[by]]),
    };
    if f == Elliptic::Rf {
        let six = r.int(-6);
        return r.div(&steep, &six);
    }
    let (value, p, two) = (r.related(f, of), r.argument(of[last]), r.int(2));
    let (numerator, distance) = (r.sub(&value, &steep), r.sub(&p, &x));
    let denominator = r.mul(&two, &distance);
    r.div(&numerator, &denominator)
}

/// Σ xᵢ ∂f/∂xᵢ = -f/2 for R_C, -3f/2 for R_D and R_J.
fn by_homogeneity<R: Rules>(r: &mut R, f: Elliptic, of: &[usize]) -> R::Value {
    let last = f.arity() - 1;
    let (value, degree, two) = (r.related(f, of), r.int(if f == Elliptic::Rc { -1 } else { -3 }), r.int(2));
    let whole = r.mul(&degree, &value);
    let mut rest = r.div(&whole, &two);
    for i in 0..last {
        let (x, partial) = (r.argument(of[i]), carlson(r, f, of, i));
        let term = r.mul(&x, &partial);
        rest = r.sub(&rest, &term);
    }
    let x = r.argument(of[last]);
    r.div(&rest, &x)
}
