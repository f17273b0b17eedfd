//! The bits that machine numbers lose: both sides in doubles against double-double, at the sampled states.
//!
//! The symbols' values are doubles in both, so that only the roundings within the formula count. A side of several
//! components is measured by its largest; a side that vanishes has no relative error and is left out.

use crate::expr::Workspace;
use crate::number::{Df64, Number, Tracked};

use super::sampling::Sampler;
use super::system::State;
use super::verdict::LostBits;

/// The bits of a double.
const BITS: f64 = f64::MANTISSA_DIGITS as f64;

/// The bits lost by the side that loses more, over the states; `None` where both vanish at all of them.
pub fn lost_bits(sampler: &Sampler, states: &[State]) -> Option<LostBits> {
    let (mut quick, mut accurate) = (Workspace::default(), Workspace::default());
    let mut lost: Vec<f64> = Vec::new();
    for state in states {
        let inputs: Vec<f64> = sampler.tape.inputs().iter().map(|s| state.values[s.index()]).collect();
        let exact: Vec<Tracked<Df64>> = inputs.iter().map(|x| Tracked::exact(Df64::from(*x))).collect();
        let rough = sampler.tape.eval(&inputs, &(), &mut quick);
        let fine = sampler.tape.eval(&exact, &(), &mut accurate);
        let sides = [1, 2].into_iter().filter_map(|side| lost_by(side, rough, fine));
        lost.extend(sides.reduce(f64::max));
    }
    let worst = lost.iter().copied().reduce(f64::max)?;
    let tenths = |bits: f64| (10.0 * bits).round() / 10.0;
    Some(LostBits { mean: tenths(lost.iter().sum::<f64>() / lost.len() as f64), worst: tenths(worst) })
}

/// The bits that one of the outputs of each pair loses, in all pairs together.
fn lost_by(side: usize, rough: &[f64], fine: &[Tracked<Df64>]) -> Option<f64> {
    let (mut error, mut size) = (0.0_f64, 0.0_f64);
    for (rough, fine) in rough.chunks(4).zip(fine.chunks(4)) {
        let (rough, fine) = (rough[side], &fine[side]);
        if !fine.is_finite() {
            return None;
        }
        // Whatever is not finite in doubles has lost everything.
        let difference = Df64::from(rough).minus(fine.value()).to_f64().abs();
        error = error.max(if difference.is_finite() { difference } else { f64::INFINITY });
        if !fine.is_zero_within() {
            size = size.max(fine.value().to_f64().abs());
        }
    }
    (size > 0.0).then(|| (BITS + (error / size).log2()).clamp(0.0, BITS))
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use crate::check::Options;
    use crate::check::book::Book;
    use crate::check::judge::judge;

    fn lost(equation: &str) -> Option<(f64, f64)> {
        let text = format!(
            "<!-- kenzan\n[symbols]\n'x' = {{ range = [1e-6, 2e-6] }}\n'y' = {{ range = [0.5, 2.0] }}\n-->\n\n$$ {equation} $$\n"
        );
        let book = Book::new(&crate::document::parse(Path::new("lost.md"), &text));
        judge(&book, 0, &Options::default()).lost_bits.map(|l| (l.mean, l.worst))
    }

    #[test]
    fn cancellation_loses_bits_and_products_do_not() {
        // 1 - cos x ≈ x²/2 ≈ 10⁻¹² rests on a number near 1: some 39 bits are lost.
        let (mean, worst) = lost(r"1 - \cos x = 2 \sin^2 \frac{x}{2}").unwrap();
        assert!((38.0..42.0).contains(&worst) && mean <= worst && mean > 30.0, "{mean} {worst}");
        let (mean, worst) = lost("x y^2 = y x y").unwrap();
        assert!(worst <= 2.0 && mean <= 1.0, "{mean} {worst}");
        assert_eq!(lost("x - x = 0"), None);
    }
}
