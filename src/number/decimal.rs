//! Decimal digits.

/// Lays out significant digits with the point before the digit at `exponent`, counted from zero as in `0.d₁d₂… ·10^exponent`:
/// positional where that is short, with an exponent otherwise. Trailing zeros are dropped.
pub(super) fn layout(negative: bool, digits: &str, exponent: i64) -> String {
    let sign = if negative { "-" } else { "" };
    let digits = digits.trim_end_matches('0');
    let count = digits.len() as i64;
    if count == 0 {
        return "0".to_owned();
    }
    match exponent {
        -4..=0 => format!("{sign}0.{}{digits}", "0".repeat(exponent.unsigned_abs() as usize)),
        1..=21 if exponent >= count => format!("{sign}{digits}{}", "0".repeat((exponent - count) as usize)),
        1..=21 => {
            let (whole, fraction) = digits.split_at(exponent as usize);
            format!("{sign}{whole}.{fraction}")
        }
        _ => {
            let (first, rest) = digits.split_at(1);
            let point = if rest.is_empty() { "" } else { "." };
            format!("{sign}{first}{point}{rest}e{}", exponent - 1)
        }
    }
}

/// What a number that is not finite is called, if `x` is one.
pub(super) fn not_finite(x: f64) -> Option<String> {
    match x {
        _ if x.is_nan() => Some("undefined".to_owned()),
        f64::INFINITY => Some("∞".to_owned()),
        f64::NEG_INFINITY => Some("-∞".to_owned()),
        _ => None,
    }
}

/// The exact sum hi + lo in decimal, rounded half to even to this many significant digits. |lo| ≤ |hi|.
pub(super) fn of_sum(hi: f64, lo: f64, digits: usize) -> String {
    if let Some(name) = not_finite(hi + lo) {
        return name;
    }
    let negative = hi < 0.0 || (hi == 0.0 && lo < 0.0);
    let (high, low) = (expansion(hi), expansion(lo));
    let sum = if (hi < 0.0) == (lo < 0.0) { add(&high, &low) } else { subtract(&high, &low) };
    let lead = sum.iter().take_while(|&&d| d == 0).count();
    let exponent = WHOLE as i64 - lead as i64;
    let (rounded, carried) = round(&sum[lead..], digits.max(1));
    layout(negative, &rounded, exponent + i64::from(carried))
}

/// Digits before and after the point that write every machine number exactly.
const WHOLE: usize = 310;
const FRACTION: usize = 1074;

/// |x| as decimal digits, exactly.
fn expansion(x: f64) -> Vec<u8> {
    let text = format!("{:0width$.FRACTION$}", x.abs(), width = WHOLE + 1 + FRACTION);
    text.bytes().filter(u8::is_ascii_digit).map(|d| d - b'0').collect()
}

fn add(a: &[u8], b: &[u8]) -> Vec<u8> {
    let mut carry = 0;
    let mut sum: Vec<u8> = Vec::with_capacity(a.len());
    for (x, y) in a.iter().zip(b).rev() {
        let digit = x + y + carry;
        carry = digit / 10;
        sum.push(digit % 10);
    }
    sum.reverse();
    sum
}

/// a - b for a ≥ b.
fn subtract(a: &[u8], b: &[u8]) -> Vec<u8> {
    let mut borrow = 0;
    let mut difference: Vec<u8> = Vec::with_capacity(a.len());
    for (x, y) in a.iter().zip(b).rev() {
        let digit = 10 + x - y - borrow;
        borrow = u8::from(digit < 10);
        difference.push(digit % 10);
    }
    difference.reverse();
    difference
}

/// The first `count` digits, rounded half to even, and whether that carried into a new digit in front.
fn round(digits: &[u8], count: usize) -> (String, bool) {
    let mut kept: Vec<u8> = digits.iter().copied().take(count).collect();
    let rest = digits.get(count..).unwrap_or(&[]);
    let odd = kept.last().is_some_and(|d| d % 2 == 1);
    let up = match rest.split_first() {
        Some((5, tail)) => odd || tail.iter().any(|&d| d != 0),
        Some((d, _)) => *d > 5,
        None => false,
    };
    let mut carry = up;
    for digit in kept.iter_mut().rev() {
        if !carry {
            break;
        }
        carry = *digit == 9;
        *digit = if carry { 0 } else { *digit + 1 };
    }
    let carried = carry && up && !kept.is_empty();
    let front = if carried { "1" } else { "" };
    (front.chars().chain(kept.iter().map(|d| char::from(b'0' + d))).collect(), carried)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimals() {
        for (hi, lo, digits, text) in [
            (0.0, 0.0, 5, "0"),
            (0.5, 0.0, 17, "0.5"),
            (-1250.0, 0.0, 2, "-1200"),
            (-1350.0, 0.0, 2, "-1400"),
            (9.999, 0.0, 2, "10"),
            (0.1, -5.551115123125783e-18, 31, "0.1"),
            (0.1, 0.0, 20, "0.10000000000000000555"),
            (1e22, 0.0, 5, "1e22"),
            (1.5e-9, 0.0, 5, "1.5e-9"),
            (1.0, 1e-20, 21, "1.00000000000000000001"),
            (1.0, -1e-20, 20, "0.99999999999999999999"),
            (1.0, -1e-20, 19, "1"),
            (f64::MAX, 0.0, 3, "1.8e308"),
            (5e-324, 0.0, 3, "4.94e-324"),
            (f64::NAN, 0.0, 3, "undefined"),
            (f64::INFINITY, 0.0, 3, "∞"),
        ] {
            assert_eq!(of_sum(hi, lo, digits), text, "{hi} + {lo} to {digits}");
        }
    }
}
