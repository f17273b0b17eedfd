//! Guard digits: which numbers the algorithms run on for a result of this or that number.
//!
//! Machine numbers run on double-doubles, and on 256 bits where those lose too much; double-doubles on 128 bits, and on
//! 256 likewise; `Mpfr` on 64 bits more, and on more again.

use super::super::{Df64, Number};
use super::arithmetic::{Arithmetic, Spread};
use super::wide::Wide;
use super::{Argument, Elliptic, MOST_ARGUMENTS, Outcome, run};

/// Bits that the algorithms' own roundings may take, beyond those whose loss is estimated.
const MARGIN: f64 = 12.0;
/// Double-doubles lose precision by underflow in intermediate results of arguments beyond 2^±this.
const DOUBLE_REACH: f64 = 200.0;

type Arguments<W> = [Argument<W>; MOST_ARGUMENTS];

/// The value, if what it lost leaves the bits that are wanted.
fn kept<W: Arithmetic>(outcome: Outcome<W>, bits: u32) -> Option<W> {
    let Outcome { value, lost } = outcome;
    (value.is_known() && lost + MARGIN + f64::from(bits) <= f64::from(value.bits())).then_some(value)
}

/// The arguments of a function, the last one again and again where it has fewer; the modulus without its sign.
fn arguments<N: Number, W>(f: Elliptic, x: &[&N], widen: impl Fn(&N) -> Argument<W>) -> Option<Arguments<W>> {
    let wide = |i: usize| {
        let i = i.min(f.arity() - 1);
        let x = *x.get(i)?;
        Some(if f.modulus() == Some(i) && x.to_f64() < 0.0 { widen(&x.negated()) } else { widen(x) })
    };
    Some([wide(0)?, wide(1)?, wide(2)?, wide(3)?])
}

fn from_machine(x: &f64) -> Argument<Df64> {
    Argument { value: Df64::from(*x), complement: Df64::from(1.0) - Df64::from(*x) }
}

fn from_double<const W: usize>(x: &Df64) -> Argument<Wide<W>> {
    // Without rounding: 1 - hi may be small, and then lo counts.
    let rest = Df64::from(1.0) - Df64::from(x.hi());
    let complement = Wide::from_df64(rest).difference(&Wide::from_df64(Df64::from(x.lo())));
    Argument { value: Wide::from_df64(*x), complement }
}

/// Whether double-doubles are wide enough for these machine numbers.
fn near(x: &[&f64]) -> bool {
    x.iter().all(|x| **x == 0.0 || x.abs().log2().abs() < DOUBLE_REACH)
}

/// f of machine numbers.
pub(in crate::number) fn machine(f: Elliptic, x: &[&f64]) -> f64 {
    let first = arguments(f, x, from_machine).filter(|_| near(x)).and_then(|x| kept(run(f, &x), 53));
    match first {
        Some(value) => value.hi(),
        None => arguments(f, x, |x| from_double::<4>(&Df64::from(*x)))
            .and_then(|x| kept(run(f, &x), 53))
            .map_or(f64::NAN, |value| value.approx()),
    }
}

/// f of double-doubles.
pub(in crate::number) fn double(f: Elliptic, x: &[&Df64]) -> Df64 {
    fn with<const W: usize>(f: Elliptic, x: &[&Df64]) -> Option<Df64> {
        let value = kept(run(f, &arguments(f, x, from_double::<W>)?), 104)?;
        Some(value.to_df64())
    }
    with::<2>(f, x).or_else(|| with::<4>(f, x)).unwrap_or(Df64::from(f64::NAN))
}

/// The arguments with their errors, in units of 2^-`unit`.
fn spreads<W: Arithmetic>(f: Elliptic, x: Arguments<W>, errors: &[f64], unit: u32) -> Arguments<Spread<W>> {
    let mut i = 0;
    x.map(|x| {
        let radius = errors.get(i.min(f.arity() - 1)).copied().unwrap_or(f64::INFINITY);
        i += 1;
        let spread = |value| Spread { value, radius, unit };
        Argument { value: spread(x.value), complement: spread(x.complement) }
    })
}

/// f of machine numbers, and how far it can move when they move within their errors, both in units of 2^-53.
pub(in crate::number) fn machine_within(f: Elliptic, x: &[&f64], errors: &[f64]) -> (f64, f64) {
    let first = arguments(f, x, from_machine).filter(|_| near(x));
    if let Some(Spread { value, radius, .. }) = first.and_then(|x| kept(run(f, &spreads(f, x, errors, 53)), 53)) {
        return (value.hi(), radius);
    }
    arguments(f, x, |x| from_double::<4>(&Df64::from(*x)))
        .and_then(|x| kept(run(f, &spreads(f, x, errors, 53)), 53))
        .map_or((f64::NAN, f64::INFINITY), |Spread { value, radius, .. }| (value.approx(), radius))
}

/// f of double-doubles, and how far it can move when they move within their errors, both in units of 2^-104.
pub(in crate::number) fn double_within(f: Elliptic, x: &[&Df64], errors: &[f64]) -> (Df64, f64) {
    fn with<const W: usize>(f: Elliptic, x: &[&Df64], errors: &[f64]) -> Option<(Df64, f64)> {
        let wide = spreads(f, arguments(f, x, from_double::<W>)?, errors, 104);
        let Spread { value, radius, .. } = kept(run(f, &wide), 104)?;
        Some((value.to_df64(), radius))
    }
    let value = with::<2>(f, x, errors).or_else(|| with::<4>(f, x, errors));
    value.unwrap_or((Df64::from(f64::NAN), f64::INFINITY))
}

#[cfg(feature = "rug")]
mod any {
    use super::super::super::Mpfr;
    use super::super::super::mpfr::precision;
    use super::*;
    use rug::Float;

    /// How often the precision is raised.
    const ATTEMPTS: u32 = 3;

    fn from_mpfr(x: &Mpfr, bits: u32) -> Argument<Mpfr> {
        let bits = precision(&bits);
        let complement = Mpfr(Float::with_val(bits, 1 - &x.0));
        Argument { value: Mpfr(Float::with_val(bits, &x.0)), complement }
    }

    /// The largest precision of the arguments.
    fn largest(x: &[&Mpfr]) -> u32 {
        x.iter().map(|x| x.0.prec()).max().unwrap_or(64)
    }

    /// f, in the largest precision of the arguments.
    pub(in crate::number) fn any_precision(f: Elliptic, x: &[&Mpfr]) -> Mpfr {
        let bits = largest(x);
        let undefined = Mpfr(Float::with_val(bits, f64::NAN));
        let finite = x.iter().all(|x| x.0.is_finite());
        let mut wide = bits.saturating_add(64);
        for _ in 0..ATTEMPTS {
            let Some(x) = arguments(f, x, |x| from_mpfr(x, wide)).filter(|_| finite) else { break };
            let outcome = run(f, &x);
            let lost = outcome.lost;
            if !outcome.value.is_known() && (lost.is_nan() || lost <= 0.0) {
                break;
            }
            if let Some(value) = kept(outcome, bits) {
                return Mpfr(Float::with_val(bits, &value.0));
            }
            let more = if lost.is_finite() { lost.max(0.0) as u32 } else { wide };
            wide = bits.saturating_add(64).saturating_add(more.min(wide.saturating_mul(4))).max(wide);
        }
        undefined
    }

    /// f, and how far it can move when the arguments move within their errors, in units of the roundoff of the result.
    pub(in crate::number) fn any_within(f: Elliptic, x: &[&Mpfr], errors: &[f64]) -> (Mpfr, f64) {
        let bits = largest(x);
        let wide = arguments(f, x, |x| from_mpfr(x, bits.saturating_mul(2)));
        let radius = wide.map_or(f64::INFINITY, |x| run(f, &spreads(f, x, errors, bits)).value.radius);
        (any_precision(f, x), radius)
    }
}
#[cfg(feature = "rug")]
pub(in crate::number) use any::{any_precision, any_within};
