//! Gauss and Legendre's implicit Runge-Kutta methods: s stages, order 2s, symplectic and symmetric; every quadratic invariant of
//! the system is one of theirs.
//!
//! For the energy error of long motions to be a random walk of rounding errors (Hairer, McLachlan and Razakarivony,
//! *Achieving Brouwer's law with implicit Runge-Kutta methods*, BIT 48 (2008)) nothing systematic may be left:
//!
//! - The rounded coefficients are those of a symplectic method, too: with Lⱼ = h bⱼ f(Yⱼ) and Yᵢ = y + Σ μᵢⱼ Lⱼ the condition is
//!   μᵢⱼ + μⱼᵢ = 1, which machine numbers can satisfy exactly (Antoñana, Makazaga and Murua, *Reducing and monitoring
//!   round-off error propagation for symplectic implicit Runge-Kutta schemes*, Numerical Algorithms 76 (2017)).
//! - The stages are iterated until no component of them comes nearer any more, not until a tolerance is met.
//! - The step is added with compensation.

use super::{IntegrationError, Method, State, System};
use crate::number::Number;

/// Motions below this, in units of the roundoff, are rounding.
const ROUNDING: f64 = 8.0;
/// Motions above this are not even the system's rounding.
const NOISE: f64 = 1e6;
/// The most iterations beside one for every two bits of the precision.
const ITERATIONS: usize = 50;

/// A stepper of s stages. Differences of stages are compared as machine numbers: precisions beyond some 1000 bits are
/// not reached.
#[derive(Debug)]
pub struct GaussLegendre<'s, N, S: ?Sized> {
    system: &'s S,
    coefficients: Coefficients<N>,
    /// The step that the weighted slopes belong to.
    step: Option<N>,
    /// h bᵢ for it.
    weights: Vec<N>,
    /// Lᵢ, one stage after another, each as long as the state.
    weighted: Vec<N>,
    /// Yᵢ likewise.
    stages: Vec<N>,
    slope: Vec<N>,
    time: N,
    term: N,
    next: N,
    moved: N,
    roundoff: f64,
    iterations: usize,
}

impl<'s, N: Number, S: System<N> + ?Sized> GaussLegendre<'s, N, S> {
    /// A stepper with this many stages, at least one, for states of the given length.
    pub fn new(stages: usize, system: &'s S, dimension: usize, cx: &N::Context) -> Self {
        let (s, zero) = (stages.max(1), N::zero(cx));
        let bits = N::precision_bits(cx);
        GaussLegendre {
            system,
            coefficients: Coefficients::new(s, cx),
            step: None,
            weights: vec![zero.clone(); s],
            weighted: vec![zero.clone(); s * dimension],
            stages: vec![zero.clone(); s * dimension],
            slope: vec![zero.clone(); dimension],
            time: zero.clone(),
            term: zero.clone(),
            next: zero.clone(),
            moved: zero,
            roundoff: (-f64::from(bits)).exp2(),
            iterations: ITERATIONS + bits as usize / 2,
        }
    }

    /// The stages from which the iteration starts: the last step's polynomial goes on, where there is one.
    fn begin(&mut self, h: &N, y: &[N]) {
        let goes_on = self.step.as_ref().is_some_and(|step| step.minus(h).log2_abs() == f64::NEG_INFINITY);
        if goes_on {
            place(&mut self.stages, y, &self.coefficients.onward, &self.weighted);
        } else {
            for stage in self.stages.chunks_mut(y.len().max(1)) {
                for (stage, y) in stage.iter_mut().zip(y) {
                    stage.set(y);
                }
            }
            self.weights = self.coefficients.weights(h);
            self.step = Some(h.clone());
        }
    }

    /// Lᵢ = h bᵢ f(Yᵢ) for all stages.
    fn evaluate(&mut self, t: &N, h: &N) {
        let n = self.slope.len().max(1);
        for (i, (stage, weighted)) in self.stages.chunks(n).zip(self.weighted.chunks_mut(n)).enumerate() {
            self.time.set(t);
            self.time.add_product(&self.coefficients.nodes[i], h);
            self.system.derivative(&self.time, stage, &mut self.slope);
            for (weighted, slope) in weighted.iter_mut().zip(&self.slope) {
                weighted.set_mul(&self.weights[i], slope);
            }
        }
    }

    /// Yᵢ = y + Σ μᵢⱼ Lⱼ. Returns how far the component that moved furthest moved, in units of the roundoff of what it
    /// is a sum of; infinite where one is not finite.
    fn iterate(&mut self, state: &State<N>) -> f64 {
        let mut furthest = 0.0f64;
        let (n, s) = (self.slope.len(), self.weights.len());
        for k in 0..n {
            let y = &state.value()[k];
            let sizes = (0..s).map(|j| self.weighted[j * n + k].to_f64().abs());
            let size = sizes.fold(y.to_f64().abs(), f64::max);
            for (i, row) in self.coefficients.inner.chunks(s).enumerate() {
                self.term.set(&state.rest()[k]);
                for (j, mu) in row.iter().enumerate() {
                    self.term.add_product(mu, &self.weighted[j * n + k]);
                }
                let stage = &mut self.stages[i * n + k];
                self.next.set_add(y, &self.term);
                self.moved.set_sub(&self.next, stage);
                let moved = self.moved.to_f64().abs();
                if moved != 0.0 {
                    // The maximum would pass over a NaN.
                    let moved = moved / size / self.roundoff;
                    furthest = if moved.is_finite() { furthest.max(moved) } else { f64::INFINITY };
                }
                std::mem::swap(stage, &mut self.next);
            }
        }
        furthest
    }

    /// Iterates until nothing moves, or only rounding does: then twice more. Where the system's own rounding is
    /// larger than that of the state, until it comes nearer no more.
    fn solve(&mut self, t: &N, h: &N, state: &State<N>) -> bool {
        let (mut nearest, mut stalls, mut rests) = (f64::INFINITY, 0, 0);
        for _ in 0..self.iterations {
            self.evaluate(t, h);
            let moved = self.iterate(state);
            rests += usize::from(moved <= ROUNDING);
            stalls = if moved < nearest { 0 } else { stalls + 1 };
            if moved == 0.0 || rests > 2 || stalls > 5 && moved <= NOISE {
                return true;
            }
            nearest = nearest.min(moved);
        }
        false
    }
}

impl<N: Number, S: System<N> + ?Sized> Method<N> for GaussLegendre<'_, N, S> {
    fn name(&self) -> String {
        format!("Gauss-Legendre {}", self.order())
    }

    fn order(&self) -> u32 {
        2 * self.weights.len() as u32
    }

    fn is_symmetric(&self) -> bool {
        true
    }

    fn step(&mut self, t: &N, h: &N, state: &mut State<N>) -> Result<(), IntegrationError> {
        self.begin(h, state.value());
        if self.solve(t, h, state) {
            for weighted in self.weighted.chunks(self.slope.len().max(1)) {
                for (k, term) in weighted.iter().enumerate() {
                    state.add(k, term);
                }
            }
            return Ok(());
        }
        self.step = None;
        Err(IntegrationError::NoConvergence { t: t.to_f64(), h: h.to_f64() })
    }
}

/// to[i] = y + Σ cᵢⱼ xⱼ.
fn place<N: Number>(to: &mut [N], y: &[N], coefficients: &[N], x: &[N]) {
    let n = y.len().max(1);
    let s = to.len() / n;
    for (i, to) in to.chunks_mut(n).enumerate() {
        for (k, to) in to.iter_mut().enumerate() {
            to.set(&y[k]);
            for j in 0..s {
                to.add_product(&coefficients[i * s + j], &x[j * n + k]);
            }
        }
    }
}

/// The coefficients, in the working precision.
#[derive(Debug)]
struct Coefficients<N> {
    /// cᵢ, from 0 to 1.
    nodes: Vec<N>,
    /// bᵢ.
    weights: Vec<N>,
    /// μᵢⱼ = aᵢⱼ/bⱼ, row by row.
    inner: Vec<N>,
    /// The same for the nodes of the next step, from this step's end on.
    onward: Vec<N>,
}

impl<N: Number> Coefficients<N> {
    fn new(s: usize, cx: &N::Context) -> Self {
        let one = N::from_f64(1.0, cx);
        let half = N::from_f64(0.5, cx);
        let points: Vec<N> = (0..s).map(|i| root(s, i, cx)).collect();
        let nodes: Vec<N> = points.iter().map(|x| x.plus(&one).times(&half)).collect();
        let weights = points.iter().map(|x| {
            let slope = legendre_slope(s, x);
            one.over(&one.minus(&x.times(x)).times(&slope.times(&slope)))
        });
        let weights = weights.collect();
        let (mut inner, mut onward) = (vec![half; s * s], Vec::with_capacity(s * s));
        for i in 0..s {
            for j in 0..s {
                let mu = integral(s, &points[i], &points[j]);
                // Of μᵢⱼ and μⱼᵢ the larger is between 1/2 and 2, and its difference to one is exact.
                if i != j && mu.to_f64() > 0.5 {
                    inner[j * s + i] = one.minus(&mu);
                    inner[i * s + j] = mu;
                }
                let further = points[i].plus(&N::from_f64(2.0, cx));
                onward.push(integral(s, &further, &points[j]).minus(&one));
            }
        }
        Coefficients { nodes, weights, inner, onward }
    }

    /// h bᵢ: symmetric, and together h.
    fn weights(&self, h: &N) -> Vec<N> {
        let s = self.weights.len();
        let mut weights: Vec<N> = self.weights.iter().map(|b| b.times(h)).collect();
        let outer = weights.iter().take((s - 1) / 2).fold(h.like(0.0), |sum, b| sum.plus(b));
        let (half, middle) = (h.times(&h.like(0.5)), (s - 1) / 2);
        let rest = half.minus(&outer);
        weights[middle] = if s % 2 == 1 { rest.plus(&rest) } else { rest };
        for i in 0..s / 2 {
            weights[s - 1 - i] = weights[i].clone();
        }
        weights
    }
}

/// P₀(x) to Pₙ(x), by Bonnet's recurrence (DLMF 18.9.1).
fn legendre<N: Number>(n: usize, x: &N) -> Vec<N> {
    let mut p = vec![x.like(1.0), x.clone()];
    for k in 1..n {
        let next = x.times(&p[k]).times(&x.like(2.0 * k as f64 + 1.0)).minus(&p[k - 1].times(&x.like(k as f64)));
        p.push(next.over(&x.like(k as f64 + 1.0)));
    }
    p
}

/// Pₙ′(x) inside the interval (DLMF 18.9.17).
fn legendre_slope<N: Number>(n: usize, x: &N) -> N {
    let p = legendre(n, x);
    let above = p[n - 1].minus(&x.times(&p[n])).times(&x.like(n as f64));
    above.over(&x.like(1.0).minus(&x.times(x)))
}

/// Root i of Pₙ, from below: Newton's method from an approximation that lies nearer to it than to any other root.
fn root<N: Number>(n: usize, i: usize, cx: &N::Context) -> N {
    let guess = -(std::f64::consts::PI * (i as f64 + 0.75) / (n as f64 + 0.5)).cos();
    // The middle one is zero, and Newton's method would only approach it.
    if 2 * i + 1 == n {
        return N::zero(cx);
    }
    let mut x = N::from_f64(guess, cx);
    let mut before = f64::INFINITY;
    loop {
        let step = legendre(n, &x)[n].over(&legendre_slope(n, &x));
        let size = step.log2_abs();
        x = x.minus(&step);
        // It converges quadratically until it is rounding that moves it.
        if size.is_nan() || size >= before || size == f64::NEG_INFINITY {
            return x;
        }
        before = size;
    }
}

/// ∫ of the Lagrange polynomial of the node `xj` from -1 to `x`, over its weight, both over [-1, 1]:
/// (1 + x)/2 + Σ Pₘ(xⱼ) (Pₘ₊₁(x) - Pₘ₋₁(x))/2 for m from 1 to n-1, as the nodes integrate what is of degree 2n-1 exactly.
fn integral<N: Number>(n: usize, x: &N, xj: &N) -> N {
    let (p, pj) = (legendre(n, x), legendre(n, xj));
    let mut sum = x.plus(&x.like(1.0));
    for m in 1..n {
        sum.add_product(&pj[m], &p[m + 1].minus(&p[m - 1]));
    }
    sum.times(&x.like(0.5))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::Df64;

    /// Σ bᵢ cᵢᵏ = 1/(k + 1) up to k = 2s - 1, and Σⱼ aᵢⱼ cⱼᵏ = cᵢᵏ⁺¹/(k + 1) up to k = s - 1 (Butcher's B(2s) and C(s)).
    fn satisfies_butchers_conditions<N: Number>(cx: &N::Context) {
        let bits = f64::from(N::precision_bits(cx));
        for s in 1..=8 {
            let Coefficients { nodes, weights, inner, .. } = Coefficients::<N>::new(s, cx);
            let power = |c: &N, k: usize| c.to_the(k as i32);
            let near = |a: &N, b: &N, what: &str| {
                assert!(a.minus(b).log2_abs() < 6.0 - bits, "{what} at {s} stages: {a:?}, {b:?}");
            };
            for k in 0..2 * s {
                let sum = nodes.iter().zip(&weights).map(|(c, b)| b.times(&power(c, k)));
                let sum = sum.fold(N::zero(cx), |a, b| a.plus(&b));
                near(&sum, &N::from_ratio(1, k as i128 + 1, cx), "B");
            }
            for (i, k) in (0..s).flat_map(|i| (0..s).map(move |k| (i, k))) {
                let terms = (0..s).map(|j| inner[i * s + j].times(&weights[j]).times(&power(&nodes[j], k)));
                let sum = terms.fold(N::zero(cx), |a, b| a.plus(&b));
                near(&sum, &power(&nodes[i], k + 1).over(&N::from_f64(k as f64 + 1.0, cx)), "C");
            }
        }
    }

    #[test]
    fn coefficients_satisfy_butchers_conditions() {
        satisfies_butchers_conditions::<f64>(&());
        satisfies_butchers_conditions::<Df64>(&());
        #[cfg(feature = "rug")]
        satisfies_butchers_conditions::<crate::number::Mpfr>(&300);
    }

    /// Machine numbers satisfy the condition of symplecticity without any rounding error.
    #[test]
    fn rounded_coefficients_are_symplectic() {
        for s in 1..=8 {
            let coefficients = Coefficients::<f64>::new(s, &());
            for (i, j) in (0..s).flat_map(|i| (0..s).map(move |j| (i, j))) {
                let (one, other) = (coefficients.inner[i * s + j], coefficients.inner[j * s + i]);
                assert_eq!(one + other, 1.0, "{s} stages, {i} {j}");
                assert!((0.5..=2.0).contains(&one.max(other)), "{s} stages: {one} and {other}");
            }
            let weights = coefficients.weights(&0.1);
            assert!((weights.iter().sum::<f64>() - 0.1).abs() < 2e-17, "{s} stages");
        }
    }
}
