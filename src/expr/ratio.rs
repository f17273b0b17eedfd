//! Exact fractions in lowest terms with a positive denominator. Every operation is checked: `None` says that the result
//! does not fit, or does not exist.

/// Numerator and denominator.
pub(crate) type Ratio = (i128, i128);

fn gcd(mut a: u128, mut b: u128) -> u128 {
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a
}

/// `n/d` in lowest terms.
pub(crate) fn reduce(n: i128, d: i128) -> Option<Ratio> {
    if d == 0 {
        return None;
    }
    let g = gcd(n.unsigned_abs(), d.unsigned_abs());
    let (n, d) = match i128::try_from(g) {
        Ok(g) => (n / g, d / g),
        Err(_) => (n.signum(), d.signum()), // only i128::MIN has so large a divisor, and then both are i128::MIN or zero
    };
    if d < 0 { Some((n.checked_neg()?, d.checked_neg()?)) } else { Some((n, d)) }
}

pub(crate) fn neg((n, d): Ratio) -> Option<Ratio> {
    Some((n.checked_neg()?, d))
}

pub(crate) fn add((a, b): Ratio, (c, d): Ratio) -> Option<Ratio> {
    let g = i128::try_from(gcd(b.unsigned_abs(), d.unsigned_abs())).ok()?;
    let n = a.checked_mul(d / g)?.checked_add(c.checked_mul(b / g)?)?;
    reduce(n, b.checked_mul(d / g)?)
}

pub(crate) fn mul((a, b): Ratio, (c, d): Ratio) -> Option<Ratio> {
    // Cancelling crosswise first keeps the products as small as they can be.
    let (a, d) = reduce(a, d)?;
    let (c, b) = reduce(c, b)?;
    Some((a.checked_mul(c)?, b.checked_mul(d)?))
}

pub(crate) fn recip((n, d): Ratio) -> Option<Ratio> {
    reduce(d, n)
}

pub(crate) fn powi(x: Ratio, n: i32) -> Option<Ratio> {
    let (a, b) = if n < 0 { recip(x)? } else { x };
    let n = n.unsigned_abs();
    Some((a.checked_pow(n)?, b.checked_pow(n)?))
}

/// The square root where it is rational.
pub(crate) fn sqrt((n, d): Ratio) -> Option<Ratio> {
    let root = |x: i128| {
        let r = u128::try_from(x).ok()?.isqrt();
        (r.checked_mul(r)? == x.unsigned_abs()).then_some(r as i128) // a root of an i128 fits an i128
    };
    Some((root(n)?, root(d)?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lowest_terms() {
        assert_eq!(reduce(6, -4), Some((-3, 2)));
        assert_eq!(reduce(0, -4), Some((0, 1)));
        assert_eq!(reduce(1, 0), None);
        assert_eq!(reduce(i128::MIN, i128::MIN), Some((1, 1)));
        assert_eq!(reduce(i128::MIN, -1), None);
        assert_eq!(reduce(0, i128::MIN), Some((0, 1)));
        assert_eq!(reduce(1, i128::MIN), None);
    }

    #[test]
    fn arithmetic() {
        assert_eq!(add((1, 6), (1, 10)), Some((4, 15)));
        assert_eq!(mul((-2, 3), (9, 4)), Some((-3, 2)));
        assert_eq!(powi((2, 3), -2), Some((9, 4)));
        assert_eq!(powi((0, 1), -1), None);
        assert_eq!(powi((10, 1), 39), None);
        assert_eq!(sqrt((9, 4)), Some((3, 2)));
        assert_eq!(sqrt((2, 1)), None);
        assert_eq!(sqrt((-4, 1)), None);
        assert_eq!(mul((i128::MAX, 1), (2, 1)), None);
        assert_eq!(mul((i128::MAX, 1), (1, i128::MAX)), Some((1, 1)));
    }
}
