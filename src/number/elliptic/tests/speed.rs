//! Times per call.

use super::*;
use std::hint::black_box;
use std::time::Instant;

fn nanoseconds<N: Number>(f: Elliptic, x: &[N], count: u32) -> f64 {
    let x: Vec<&N> = x.iter().collect();
    let mut value = x[0].clone();
    let start = Instant::now();
    for _ in 0..count {
        value.set_elliptic(f, black_box(&x));
        black_box(&value);
    }
    start.elapsed().as_secs_f64() * 1e9 / f64::from(count)
}

#[test]
#[ignore = "a measurement"]
fn times() {
    use crate::number::Tracked;
    for f in Elliptic::ALL {
        let x = match f {
            _ if f.is_jacobi() => vec![5.3, 0.7],
            _ => vec![0.9, 0.4, 0.7, 0.6],
        };
        let x = &x[..f.arity()];
        let double: Vec<Df64> = x.iter().map(|x| Df64::from(*x)).collect();
        let tracked: Vec<_> = double.iter().map(|x| Tracked::with_error(*x, -100.0)).collect();
        print!("{f:?}: f64 {:.1} µs", nanoseconds(f, x, 2000) / 1e3);
        print!(", Df64 {:.1} µs", nanoseconds(f, &double, 500) / 1e3);
        print!(", Tracked<Df64> {:.1} µs", nanoseconds(f, &tracked, 200) / 1e3);
        #[cfg(feature = "rug")]
        {
            use crate::number::Mpfr;
            let any: Vec<Mpfr> = x.iter().map(|x| Mpfr::from_f64(*x, &200)).collect();
            print!(", Mpfr (200 bits) {:.1} µs", nanoseconds(f, &any, 200) / 1e3);
        }
        println!();
    }
}
