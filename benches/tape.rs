//! The tape against the same formulas written by hand: Euler's equation of the symmetric top about the first principal axis, and its
//! energy in two forms (gyroscope notes, equations 39 and 62), at many states.
//!
//!     cargo bench --bench tape --features rug

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use divan::{Bencher, black_box};
use kenzan::expr::{Expr, Func, Graph, SymId, Tape, Workspace};
use kenzan::number::{Df64, Lanes, Number, Tracked};

fn main() {
    divan::main();
}

const STATES: usize = 4096;
const FEW: usize = 64;

/// The symbols, in the order of a state's values.
const NAMES: [&str; 10] = ["I_x", "I_y", "I_z", "mgl", "L_z", "\\Omega", "\\theta", "\\phi", "\\psi", "I_0"];

fn symbols(g: &mut Graph) -> Vec<SymId> {
    let plain: Vec<_> =
        NAMES.iter().map(|n| if n.starts_with('\\') { g.time_symbol(n) } else { g.symbol(n) }).collect();
    let (theta, phi, psi) = (plain[6], plain[7], plain[8]);
    let moving = [(theta, 1), (theta, 2), (phi, 1), (phi, 2), (psi, 1)].map(|(s, n)| g.nth_derivative_symbol(s, n));
    plain.into_iter().chain(moving).collect()
}

/// The residual of (39), and the two forms of (62).
fn formulas(g: &mut Graph, s: &[SymId]) -> [Expr; 3] {
    let x: Vec<Expr> = s.iter().map(|&s| g.sym(s)).collect();
    let [ix, iy, iz, mgl, lz, omega, theta, _, psi, i0, dtheta, _, dphi, _, dpsi] = x[..] else { unreachable!() };
    let (st, ct) = (g.call(Func::Sin, theta), g.call(Func::Cos, theta));
    let (sp, cp) = (g.call(Func::Sin, psi), g.call(Func::Cos, psi));
    let (a, b) = (g.product([dphi, st, sp]), g.mul(dtheta, cp));
    let wx = g.add(a, b);
    let (a, b) = (g.product([dphi, st, cp]), g.mul(dtheta, sp));
    let wy = g.sub(a, b);
    let a = g.mul(dphi, ct);
    let wz = g.add(a, dpsi);
    let rate = g.time_derivative(wx, None);
    let inertial = g.mul(ix, rate);
    let difference = g.sub(iy, iz);
    let gyroscopic = g.product([difference, wy, wz]);
    let torque = g.product([mgl, st, cp]);
    let lhs = g.sub(inertial, gyroscopic);
    let euler = g.sub(lhs, torque);

    let two = g.int(2);
    let half = g.div(i0, two);
    let dtheta2 = g.powi(dtheta, 2);
    let weight = g.mul(mgl, ct);
    let spin = g.product([iz, omega, ct]);
    let numerator = g.sub(lz, spin);
    let denominator = g.mul(i0, st);
    let quotient = g.div(numerator, denominator);
    let precession = g.mul(dphi, st);
    let energy = [quotient, precession].map(|w| {
        let square = g.powi(w, 2);
        let sum = g.add(dtheta2, square);
        let kinetic = g.mul(half, sum);
        g.add(kinetic, weight)
    });
    [euler, energy[0], energy[1]]
}

fn tape() -> Tape {
    let mut g = Graph::new();
    let s = symbols(&mut g);
    let outputs = formulas(&mut g, &s);
    Tape::compile(&g, &outputs)
}

/// Values of the tape's inputs at this state.
fn state(n: usize, inputs: usize) -> Vec<f64> {
    (0..inputs).map(|i| 0.3 + ((n * 31 + i * 17) % 101) as f64 / 103.0).collect()
}

/// One row per input, a state per column.
fn columns(inputs: usize) -> Vec<Vec<f64>> {
    let states: Vec<_> = (0..STATES).map(|n| state(n, inputs)).collect();
    (0..inputs).map(|i| states.iter().map(|s| s[i]).collect()).collect()
}

/// The same by hand. The inputs are in the tape's order, which the symbols' is, without φ and its name's second derivative's base.
#[inline(always)]
fn by_hand(x: [f64; 14]) -> [f64; 3] {
    let [ix, iy, iz, mgl, lz, omega, theta, psi, i0, dt, ddt, dp, ddp, ds] = x;
    let (st, ct, sp, cp) = (theta.sin(), theta.cos(), psi.sin(), psi.cos());
    let rate = ddp * st * sp + dp * (ct * dt * sp + st * cp * ds) + ddt * cp - dt * sp * ds;
    let euler = ix * rate - (iy - iz) * (dp * st * cp - dt * sp) * (dp * ct + ds) - mgl * st * cp;
    let q = (lz - iz * omega * ct) / (i0 * st);
    let p = dp * st;
    let energy = |w: f64| 0.5 * i0 * (dt * dt + w * w) + mgl * ct;
    [euler, energy(q), energy(p)]
}

#[divan::bench]
fn f64_by_hand(bencher: Bencher) {
    let columns = columns(14);
    let mut out = vec![[0.0; 3]; STATES];
    bencher.bench_local(|| {
        let columns = black_box(&columns);
        for (n, out) in out.iter_mut().enumerate() {
            *out = by_hand(std::array::from_fn(|i| columns[i][n]));
        }
        black_box(&out);
    });
}

#[divan::bench(consts = [4, 8, 16, 32])]
fn f64_lanes_tape<const N: usize>(bencher: Bencher) {
    let tape = tape();
    assert_eq!(tape.inputs().len(), 14);
    let columns = columns(14);
    let mut out = vec![[0.0; 3]; STATES];
    let mut inputs = vec![Lanes([0.0; N]); 14];
    let mut workspace = Workspace::new();
    let check = |out: &[[f64; 3]]| {
        let expect = by_hand(std::array::from_fn(|i| columns[i][7]));
        assert!(out[7].iter().zip(expect).all(|(a, b)| (a - b).abs() < 1e-12), "{:?} {expect:?}", out[7]);
    };
    bencher.bench_local(|| {
        let columns = black_box(&columns);
        for (block, out) in out.chunks_exact_mut(N).enumerate() {
            for (input, column) in inputs.iter_mut().zip(columns) {
                input.0.copy_from_slice(&column[block * N..][..N]);
            }
            let values = tape.eval(&inputs, &(), &mut workspace);
            for (lane, out) in out.iter_mut().enumerate() {
                *out = [values[0].0[lane], values[1].0[lane], values[2].0[lane]];
            }
        }
        black_box(&out);
    });
    check(&out);
}

/// The tape at `FEW` states, in any number type.
fn tape_in<N: Number>(bencher: Bencher, cx: &N::Context, of: impl Fn(f64) -> N) {
    let tape = tape();
    let states: Vec<Vec<N>> = (0..FEW).map(|n| state(n, 14).into_iter().map(&of).collect()).collect();
    let mut workspace = Workspace::new();
    bencher.bench_local(|| {
        for state in black_box(&states) {
            black_box(tape.eval(state, cx, &mut workspace));
        }
    });
}

#[divan::bench]
fn few_f64_tape(bencher: Bencher) {
    tape_in(bencher, &(), |x| x);
}

#[divan::bench]
fn few_df64_tape(bencher: Bencher) {
    tape_in(bencher, &(), Df64::from);
}

#[divan::bench]
fn few_tracked_df64_tape(bencher: Bencher) {
    tape_in(bencher, &(), |x| Tracked::exact(Df64::from(x)));
}

#[cfg(feature = "rug")]
mod mpfr {
    use super::*;
    use kenzan::number::Mpfr;
    use rug::{Assign, Float};

    const BITS: [u32; 2] = [256, 1024];

    #[divan::bench(args = BITS)]
    fn few_tape(bencher: Bencher, bits: u32) {
        tape_in(bencher, &bits, |x| Mpfr::from_f64(x, &bits));
    }

    #[divan::bench(args = BITS)]
    fn few_tracked_tape(bencher: Bencher, bits: u32) {
        tape_in(bencher, &bits, |x| Tracked::exact(Mpfr::from_f64(x, &bits)));
    }

    /// By hand in place, with temporaries that are made once.
    #[divan::bench(args = BITS)]
    fn few_by_hand(bencher: Bencher, bits: u32) {
        let float = |x: f64| Float::with_val(bits, x);
        let states: Vec<Vec<Float>> = (0..FEW).map(|n| state(n, 14).into_iter().map(float).collect()).collect();
        let mut temporaries: [Float; 16] = std::array::from_fn(|_| Float::new(bits));
        check(&states[7], &mut temporaries, bits);
        bencher.bench_local(|| {
            for state in black_box(&states) {
                by_hand(state, &mut temporaries);
                black_box(&temporaries);
            }
        });
    }

    /// Both compute the same.
    fn check(state: &[Float], temporaries: &mut [Float; 16], bits: u32) {
        by_hand(state, temporaries);
        let inputs: Vec<_> = state.iter().cloned().map(Mpfr).collect();
        let mut workspace = Workspace::new();
        let values = tape().eval(&inputs, &bits, &mut workspace).to_vec();
        for (value, hand) in values.iter().zip([9, 12, 13]) {
            let difference = Float::with_val(bits, &value.0 - &temporaries[hand]);
            assert!(difference.abs() < f64::exp2(10.0 - f64::from(bits)), "{value:?} {}", temporaries[hand]);
        }
    }

    fn by_hand(x: &[Float], temporaries: &mut [Float; 16]) {
        let [ix, iy, iz, mgl, lz, omega, theta, psi, i0, dt, ddt, dp, ddp, ds] = x else { unreachable!() };
        let [st, ct, sp, cp, a, b, c, wy, wz, euler, q, p, e1, e2, weight, dt2] = temporaries;
        (&mut *st, &mut *ct).assign(theta.sin_cos_ref());
        (&mut *sp, &mut *cp).assign(psi.sin_cos_ref());
        // φ'' sinθ sinψ + φ' (cosθ θ' sinψ + sinθ cosψ ψ') + θ'' cosψ - θ' sinψ ψ'
        a.assign(ddp * &*st);
        *a *= &*sp;
        b.assign(&*ct * dt);
        *b *= &*sp;
        c.assign(&*st * &*cp);
        *c *= ds;
        *b += &*c;
        *b *= dp;
        *a += &*b;
        b.assign(ddt * &*cp);
        *a += &*b;
        b.assign(dt * &*sp);
        c.assign(&*b * ds);
        *a -= &*c;
        *a *= ix;
        // - (I_y - I_z)(φ' sinθ cosψ - θ' sinψ)(φ' cosθ + ψ')
        p.assign(dp * &*st);
        wy.assign(&*p * &*cp);
        *wy -= &*b;
        wz.assign(dp * &*ct);
        *wz += ds;
        c.assign(iy - iz);
        *c *= &*wy;
        *c *= &*wz;
        euler.assign(&*a - &*c);
        a.assign(mgl * &*st);
        *a *= &*cp;
        *euler -= &*a;
        // the energies
        q.assign(iz * omega);
        *q *= &*ct;
        a.assign(lz - &*q);
        b.assign(i0 * &*st);
        q.assign(&*a / &*b);
        weight.assign(mgl * &*ct);
        dt2.assign(dt.square_ref());
        c.assign(i0 / 2_u32);
        for (w, e) in [(&*q, e1), (&*p, e2)] {
            a.assign(w.square_ref());
            *a += &*dt2;
            *a *= &*c;
            e.assign(&*a + &*weight);
        }
    }
}
