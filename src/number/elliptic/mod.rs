//! Elliptic functions and integrals of real arguments.
//!
//! Conventions, those of the DLMF (chapters 19 and 22) but for the order of arguments of Π:
//!
//! - The second argument of Jacobi's functions, and the last one of Legendre's integrals, is the **modulus k**, not the
//!   parameter m = k²: Δ² = 1 - k² sin². All are even in k, and k may be greater than 1 where they stay real.
//! - The first argument of Jacobi's functions is u (not the amplitude); am(u, k) is the amplitude φ, which grows by π/2
//!   with each K.
//! - Π(φ, n, k) = ∫ dθ/((1 - n sin²θ)Δ): DLMF 19.2.7 with α² = n. (Byrd and Friedman write the same α²; others the
//!   opposite sign.) 1 - n sin² must be positive on the way: principal values are not computed.
//! - D = (F - E)/k² = ∫ sin²/Δ and G = ∫ sin²/Δ³ are what derivatives with respect to k consist of: with them nothing
//!   cancels for k → 0 or k → 1.
//!
//! Promises.
//!
//! - A finite value of [`f64`], [`Df64`] or `Mpfr` is right to [`ROUNDING`] units of the roundoff, for whatever finite
//!   arguments of magnitudes within 2^±900: also for k → 0, k → 1, large u and u next to a zero of the function. It is
//!   computed with guard digits, whose loss is estimated on the way; where too many are lost it is computed again with
//!   more, and where even those do not suffice the value is not finite. The exact values are those at the arguments as
//!   they are stored.
//! - Undefined values (k = 1 in K, |k| > 1 in complete integrals, n ≥ 1 in a complete Π, negative arguments of
//!   Carlson's), infinite ones, and u or φ beyond 2^52 quarter periods are not finite, and never panic. Every loop has
//!   a bound.
//! - [`Tracked`](super::Tracked) adds to [`ROUNDING`] a bound of what the errors of the arguments do, by running the
//!   algorithm on [`Spread`]s. [`Dual`](super::Dual) and [`Jet`](super::Jet) are by [`slope`].

mod arithmetic;
pub mod bare;
mod carlson;
mod complete;
mod guard;
mod incomplete;
mod jacobi;
mod series;
mod slope;
#[cfg(test)]
mod tests;
mod wide;

#[cfg(feature = "rug")]
pub(super) use guard::{any_precision, any_within};
pub(super) use guard::{double, double_within, machine, machine_within};
pub(super) use series::{dual, jet};
pub use slope::{Rules, slope};

use arithmetic::Arithmetic;
use jacobi::Modulus;

/// The largest relative error of a finite value at exact arguments, in units of the roundoff.
pub const ROUNDING: f64 = 4.0;

/// The most arguments that a function has.
pub const MOST_ARGUMENTS: usize = 4;

/// An elliptic function or integral. The modulus is k.
#[derive(Copy, Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Elliptic {
    /// sn(u, k).
    Sn,
    /// cn(u, k).
    Cn,
    /// dn(u, k).
    Dn,
    /// am(u, k), the amplitude.
    Am,
    /// ∫ sn²(v, k) dv from 0 to u: (u - ℰ(u, k))/k² with Jacobi's ℰ = ∫ dn² (DLMF 22.16.14).
    JacobiD,
    /// ∫ sd²(v, k) dv from 0 to u, with sd = sn/dn.
    JacobiG,
    /// K(k).
    CompleteK,
    /// E(k).
    CompleteE,
    /// D(k) = (K - E)/k².
    CompleteD,
    /// G(k) = ∫ sin²/Δ³, of which k times is dK/dk.
    CompleteG,
    /// Π(n, k).
    CompletePi,
    /// F(φ, k).
    IncompleteF,
    /// E(φ, k).
    IncompleteE,
    /// D(φ, k) = (F - E)/k².
    IncompleteD,
    /// G(φ, k) = ∫ sin²/Δ³, of which k times is ∂F/∂k.
    IncompleteG,
    /// Π(φ, n, k).
    IncompletePi,
    /// Carlson's R_C(x, y) (DLMF 19.2.17); its principal value where y is negative.
    Rc,
    /// Carlson's R_F(x, y, z) (DLMF 19.16.1).
    Rf,
    /// Carlson's R_D(x, y, z) (DLMF 19.16.5), of which z is the argument apart.
    Rd,
    /// Carlson's R_J(x, y, z, p) (DLMF 19.16.2) for positive p.
    Rj,
}

impl Elliptic {
    /// All of them.
    pub const ALL: [Elliptic; 20] = [
        Elliptic::Sn,
        Elliptic::Cn,
        Elliptic::Dn,
        Elliptic::Am,
        Elliptic::JacobiD,
        Elliptic::JacobiG,
        Elliptic::CompleteK,
        Elliptic::CompleteE,
        Elliptic::CompleteD,
        Elliptic::CompleteG,
        Elliptic::CompletePi,
        Elliptic::IncompleteF,
        Elliptic::IncompleteE,
        Elliptic::IncompleteD,
        Elliptic::IncompleteG,
        Elliptic::IncompletePi,
        Elliptic::Rc,
        Elliptic::Rf,
        Elliptic::Rd,
        Elliptic::Rj,
    ];

    /// The number of arguments.
    pub fn arity(self) -> usize {
        match self {
            Elliptic::CompleteK | Elliptic::CompleteE | Elliptic::CompleteD | Elliptic::CompleteG => 1,
            Elliptic::IncompletePi | Elliptic::Rf | Elliptic::Rd => 3,
            Elliptic::Rj => 4,
            _ => 2,
        }
    }

    /// The name in plain text.
    pub fn name(self) -> &'static str {
        match self {
            Elliptic::Sn => "sn",
            Elliptic::Cn => "cn",
            Elliptic::Dn => "dn",
            Elliptic::Am => "am",
            Elliptic::JacobiD => "∫sn²",
            Elliptic::JacobiG => "∫sd²",
            Elliptic::CompleteK => "K",
            Elliptic::CompleteE | Elliptic::IncompleteE => "E",
            Elliptic::CompleteD | Elliptic::IncompleteD => "D",
            Elliptic::CompleteG | Elliptic::IncompleteG => "G",
            Elliptic::CompletePi | Elliptic::IncompletePi => "Π",
            Elliptic::IncompleteF => "F",
            Elliptic::Rc => "R_C",
            Elliptic::Rf => "R_F",
            Elliptic::Rd => "R_D",
            Elliptic::Rj => "R_J",
        }
    }

    /// Whether it is one of Jacobi's functions, of u and k.
    pub fn is_jacobi(self) -> bool {
        use Elliptic::*;
        matches!(self, Sn | Cn | Dn | Am | JacobiD | JacobiG)
    }

    /// The position of the modulus among the arguments; Carlson's integrals have none.
    pub fn modulus(self) -> Option<usize> {
        let carlson = matches!(self, Elliptic::Rc | Elliptic::Rf | Elliptic::Rd | Elliptic::Rj);
        (!carlson).then(|| self.arity() - 1)
    }
}

/// An argument, with its distance from 1 without cancellation.
#[derive(Clone, Debug)]
struct Argument<W> {
    value: W,
    /// 1 - value.
    complement: W,
}

/// A value, and log₂ of how much of the guard digits' precision has been lost in it.
struct Outcome<W> {
    value: W,
    lost: f64,
}

impl<W> Outcome<W> {
    fn map(self, f: impl FnOnce(W) -> W) -> Self {
        Outcome { value: f(self.value), lost: self.lost }
    }
}

/// The function of arguments of which the modulus is not negative.
fn run<W: Arithmetic>(f: Elliptic, x: &[Argument<W>; MOST_ARGUMENTS]) -> Outcome<W> {
    let exactly = |value: W| Outcome { value, lost: 0.0 };
    let modulus = |i: usize| Modulus::new(&x[i].value, &x[i].complement);
    let [a, b, c, d] = [0, 1, 2, 3].map(|i: usize| &x[i].value);
    match f {
        _ if f.is_jacobi() => jacobi::evaluate(f, a, &modulus(1)),
        _ if f.arity() == 1 => exactly(incomplete::whole(f, None, &modulus(0))),
        Elliptic::CompletePi => exactly(incomplete::whole(f, Some(&x[0].complement), &modulus(1))),
        Elliptic::IncompletePi => incomplete::third(a, b, &x[1].complement, &modulus(2)),
        Elliptic::Rc => exactly(carlson::rc(a, b)),
        Elliptic::Rf => exactly(carlson::rf(a, b, c)),
        Elliptic::Rd => exactly(carlson::rd(a, b, c)),
        Elliptic::Rj => exactly(carlson::rj(a, b, c, d)),
        _ => incomplete::legendre(f, a, &modulus(1)),
    }
}
