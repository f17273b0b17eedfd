//! Jets: Taylor series in one variable, truncated at an order. The recurrences are those of Griewank and Walther,
//! *Evaluating Derivatives* (2nd ed. 2008), table 13.2.

use super::{Elliptic, Func, Number, elliptic};

/// The series c₀ + c₁ t + c₂ t² + …; a result has the lower order of its operands.
#[derive(Clone, Debug, PartialEq)]
pub struct Jet<N> {
    coefficients: Vec<N>, // never empty
}

/// What a constant jet must know.
#[derive(Clone, Debug, PartialEq)]
pub struct JetContext<C> {
    /// The order of the last term that is kept.
    pub order: usize,
    /// The context of the coefficients.
    pub inner: C,
}

impl<N: Number> Jet<N> {
    /// The series that begins with `value` and goes on with `rest`: as many terms as are given.
    pub fn new(value: N, rest: impl IntoIterator<Item = N>) -> Self {
        Jet { coefficients: std::iter::once(value).chain(rest).collect() }
    }

    /// A constant.
    pub fn constant(value: N, order: usize) -> Self {
        let zero = value.like(0.0);
        Jet::new(value, std::iter::repeat_n(zero, order))
    }

    /// The variable itself at a value: value + t.
    pub fn variable(value: N, order: usize) -> Self {
        let one = value.like(1.0);
        let mut jet = Jet::constant(value, order);
        if let Some(slope) = jet.coefficients.get_mut(1) {
            *slope = one;
        }
        jet
    }

    /// The coefficients c₀, c₁, … up to the order.
    pub fn coefficients(&self) -> &[N] {
        &self.coefficients
    }

    /// The derivative of this order at t = 0, k! cₖ, where the series goes that far.
    pub fn derivative(&self, order: usize) -> Option<N> {
        let c = self.coefficients.get(order)?;
        Some((2..=order).fold(c.clone(), |x, k| x.times(&x.like(k as f64))))
    }

    fn order(&self) -> usize {
        self.coefficients.len() - 1
    }

    fn value(&self) -> &N {
        &self.coefficients[0]
    }

    /// The product of every coefficient with a number.
    fn scaled(&self, by: &N) -> Self {
        Jet { coefficients: self.coefficients.iter().map(|c| c.times(by)).collect() }
    }

    /// Σ aᵢ bₖ₋ᵢ for i in the range, each multiplied by i where `weighted`.
    fn convolve(a: &[N], b: &[N], k: usize, range: std::ops::RangeInclusive<usize>, weighted: bool) -> N {
        let mut sum = a[0].like(0.0);
        let mut term = sum.clone();
        for i in range {
            term.set_mul(&a[i], &b[k - i]);
            if weighted && i != 1 {
                term = term.times(&term.like(i as f64));
            }
            sum = sum.plus(&term);
        }
        sum
    }

    /// The series f with f(0) = value and f' = a' g: k fₖ = Σ i aᵢ gₖ₋ᵢ.
    fn integrated(value: N, a: &Self, g: &Self) -> Self {
        let mut f = vec![value];
        for k in 1..=a.order().min(g.order()) {
            let sum = Self::convolve(&a.coefficients, &g.coefficients, k, 1..=k, true);
            f.push(sum.over(&sum.like(k as f64)));
        }
        Jet { coefficients: f }
    }

    /// The exponential of `a`, whose value is known.
    fn exponential(value: N, a: &Self) -> Self {
        let mut e = vec![value];
        for k in 1..=a.order() {
            let sum = Self::convolve(&a.coefficients, &e, k, 1..=k, true);
            e.push(sum.over(&sum.like(k as f64)));
        }
        Jet { coefficients: e }
    }

    /// The pair with s' = a' c and c' = ∓ a' s: sine and cosine, or hyperbolic ones.
    fn pair(s0: N, c0: N, a: &Self, hyperbolic: bool) -> (Self, Self) {
        let (mut s, mut c) = (vec![s0], vec![c0]);
        for k in 1..=a.order() {
            let over_k = |sum: N| sum.over(&sum.like(k as f64));
            let rise = over_k(Self::convolve(&a.coefficients, &c, k, 1..=k, true));
            let fall = over_k(Self::convolve(&a.coefficients, &s, k, 1..=k, true));
            s.push(rise);
            c.push(if hyperbolic { fall } else { fall.negated() });
        }
        (Jet { coefficients: s }, Jet { coefficients: c })
    }

    fn sin_cos(&self) -> (Self, Self) {
        let (mut s, mut c) = (self.value().clone(), self.value().clone());
        N::set_sin_cos(&mut s, &mut c, self.value());
        Self::pair(s, c, self, false)
    }

    fn sinh_cosh(&self) -> (Self, Self) {
        Self::pair(self.value().apply(Func::Sinh), self.value().apply(Func::Cosh), self, true)
    }

    fn logarithm(&self) -> Self {
        let a = &self.coefficients;
        let mut l = vec![a[0].apply(Func::Ln)];
        for k in 1..a.len() {
            let sum = Self::convolve(&l, a, k, 1..=k - 1, true);
            let rest = a[k].minus(&sum.over(&sum.like(k as f64)));
            l.push(rest.over(&a[0]));
        }
        Jet { coefficients: l }
    }

    /// The function as the integral of its derivative, which the argument's series gives.
    fn by_slope(&self, f: Func) -> Self {
        let one = self.like(1.0);
        let square = self.times(self);
        let slope = match f {
            Func::Tan => {
                let (_, cos) = self.sin_cos();
                one.over(&cos.times(&cos))
            }
            Func::Tanh => {
                let (_, cosh) = self.sinh_cosh();
                one.over(&cosh.times(&cosh))
            }
            Func::Atan => one.over(&one.plus(&square)),
            Func::Atanh => one.over(&one.minus(&square)),
            Func::Asinh => one.over(&one.plus(&square).root()),
            Func::Acosh => one.over(&square.minus(&one).root()),
            Func::Acos => one.over(&one.minus(&square).root()).negated(),
            _ => one.over(&one.minus(&square).root()),
        };
        Self::integrated(self.value().apply(f), self, &slope)
    }

    fn binary(&mut self, a: &Self, b: &Self, f: impl Fn(&mut N, &N, &N)) {
        self.coefficients.clone_from(&a.coefficients);
        self.coefficients.truncate(b.coefficients.len());
        for ((x, a), b) in self.coefficients.iter_mut().zip(&a.coefficients).zip(&b.coefficients) {
            f(x, a, b);
        }
    }
}

impl<N: Number> Number for Jet<N> {
    type Context = JetContext<N::Context>;

    fn zero(cx: &Self::Context) -> Self {
        Jet::constant(N::zero(&cx.inner), cx.order)
    }
    fn from_f64(x: f64, cx: &Self::Context) -> Self {
        Jet::constant(N::from_f64(x, &cx.inner), cx.order)
    }
    fn from_ratio(n: i128, d: i128, cx: &Self::Context) -> Self {
        Jet::constant(N::from_ratio(n, d, &cx.inner), cx.order)
    }
    fn pi(cx: &Self::Context) -> Self {
        Jet::constant(N::pi(&cx.inner), cx.order)
    }
    fn e(cx: &Self::Context) -> Self {
        Jet::constant(N::e(&cx.inner), cx.order)
    }
    fn context(&self) -> Self::Context {
        JetContext { order: self.order(), inner: self.value().context() }
    }
    fn precision_bits(cx: &Self::Context) -> u32 {
        N::precision_bits(&cx.inner)
    }

    fn set(&mut self, a: &Self) {
        self.coefficients.clone_from(&a.coefficients);
    }
    fn set_neg(&mut self, a: &Self) {
        self.binary(a, a, |x, a, _| x.set_neg(a));
    }
    fn set_add(&mut self, a: &Self, b: &Self) {
        self.binary(a, b, N::set_add);
    }
    fn set_sub(&mut self, a: &Self, b: &Self) {
        self.binary(a, b, N::set_sub);
    }
    fn set_mul(&mut self, a: &Self, b: &Self) {
        let (a, b) = (&a.coefficients, &b.coefficients);
        let terms = 0..a.len().min(b.len());
        self.coefficients = terms.map(|k| Self::convolve(a, b, k, 0..=k, false)).collect();
    }
    fn set_div(&mut self, a: &Self, b: &Self) {
        let (a, b) = (&a.coefficients, &b.coefficients);
        let mut q = vec![a[0].over(&b[0])];
        for (k, (ak, _)) in a.iter().zip(b).enumerate().skip(1) {
            let known = Self::convolve(&q, b, k, 0..=k - 1, false);
            q.push(ak.minus(&known).over(&b[0]));
        }
        self.coefficients = q;
    }
    fn set_powi(&mut self, a: &Self, n: i32) {
        // By squaring, since the value may be zero; an inverse at the end.
        let mut power = a.like(1.0);
        for bit in (0..u32::BITS - n.unsigned_abs().leading_zeros()).rev() {
            power = power.times(&power);
            if n.unsigned_abs() >> bit & 1 == 1 {
                power = power.times(a);
            }
        }
        *self = if n < 0 { a.like(1.0).over(&power) } else { power };
    }
    fn set_pow(&mut self, a: &Self, b: &Self) {
        let mut value = a.value().clone();
        value.set_pow(a.value(), b.value());
        *self = Self::exponential(value, &b.times(&a.logarithm()));
    }
    fn set_sqrt(&mut self, a: &Self) {
        let a = &a.coefficients;
        let mut r = vec![a[0].root()];
        let twice = r[0].plus(&r[0]);
        for (k, ak) in a.iter().enumerate().skip(1) {
            let known = Self::convolve(&r, &r, k, 1..=k - 1, false);
            r.push(ak.minus(&known).over(&twice));
        }
        self.coefficients = r;
    }
    fn set_call(&mut self, f: Func, a: &Self) {
        *self = match f {
            Func::Sin => a.sin_cos().0,
            Func::Cos => a.sin_cos().1,
            Func::Sinh => a.sinh_cosh().0,
            Func::Cosh => a.sinh_cosh().1,
            Func::Exp => Self::exponential(a.value().apply(Func::Exp), a),
            Func::Ln => a.logarithm(),
            Func::Abs => a.scaled(&a.value().apply(Func::Sign)),
            Func::Sign => Jet::constant(a.value().apply(Func::Sign), a.order()),
            _ => a.by_slope(f),
        };
    }
    fn set_atan2(&mut self, y: &Self, x: &Self) {
        let mut value = y.value().clone();
        value.set_atan2(y.value(), x.value());
        let square = x.times(x).plus(&y.times(y));
        // θ' = (x y' - y x')/r², each product integrated for itself.
        let rise = Self::integrated(value.clone(), y, &x.over(&square));
        let fall = Self::integrated(value.like(0.0), x, &y.over(&square));
        *self = rise.minus(&fall);
    }
    fn set_elliptic(&mut self, f: Elliptic, x: &[&Self]) {
        *self = elliptic::jet(f, x).unwrap_or_else(|| self.like(f64::NAN));
    }
    fn set_sin_cos(sin: &mut Self, cos: &mut Self, a: &Self) {
        (*sin, *cos) = a.sin_cos();
    }

    fn to_f64(&self) -> f64 {
        self.value().to_f64()
    }
    fn log2_abs(&self) -> f64 {
        self.value().log2_abs()
    }
    fn is_finite(&self) -> bool {
        self.coefficients.iter().all(N::is_finite)
    }
    fn to_decimal(&self, digits: usize) -> String {
        self.value().to_decimal(digits)
    }
}
