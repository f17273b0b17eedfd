//! The seeded generator of states: the same seed and label give the same states on every machine.

/// SplitMix64 (Steele, Lea and Flood, 2014): small, fast and good enough to choose states.
#[derive(Clone, Debug)]
pub struct Random {
    state: u64,
}

impl Random {
    /// A generator for a seed and a name, so that every equation has states of its own.
    pub fn new(seed: u64, name: &str) -> Self {
        // FNV-1a of the name.
        let hash =
            name.bytes().fold(0xcbf2_9ce4_8422_2325_u64, |h, b| (h ^ u64::from(b)).wrapping_mul(0x0100_0000_01b3));
        let mut random = Random { state: seed ^ hash };
        random.next();
        random
    }

    /// The next 64 bits.
    pub fn next(&mut self) -> u64 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A number in [0, 1).
    pub fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// A whole number in 0..n, n > 0.
    pub fn below(&mut self, n: u64) -> u64 {
        self.next() % n.max(1)
    }
}

/// A short decimal fraction, exact in every number type.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Decimal {
    /// The numerator.
    pub num: i64,
    /// The denominator, a power of ten.
    pub den: i64,
}

impl Decimal {
    /// The nearest double.
    pub fn to_f64(self) -> f64 {
        self.num as f64 / self.den as f64
    }

    /// The decimal nearest to a number, with some digits after the point.
    pub fn near(x: f64, digits: u32) -> Self {
        let den = 10_i64.pow(digits.min(15));
        Decimal { num: (x * den as f64).round() as i64, den }
    }
}

impl Decimal {
    /// What is drawn where the range is a single number.
    pub fn only(x: f64) -> Self {
        Decimal::near(x, digits([x, x]))
    }
}

impl std::fmt::Display for Decimal {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        // The shortest decimal that is the double nearest to it: short for what is drawn, honest for the rest.
        let text = format!("{}", self.to_f64());
        write!(f, "{text}")
    }
}

/// Draws from a range. A `hard` draw lies near one of the ends, at a hundredth to a ten-thousandth of the width.
pub fn draw(random: &mut Random, range: [f64; 2], integer: bool, hard: bool) -> Decimal {
    let [low, high] = range;
    if integer {
        let (first, last) = (low.ceil() as i64, high.floor() as i64);
        let n = (last - first).max(0) as u64 + 1;
        return Decimal { num: first + random.below(n) as i64, den: 1 };
    }
    let width = high - low;
    let digits = digits(range);
    if !hard {
        return Decimal::near(low + width * random.unit(), digits);
    }
    let distance = width * 10_f64.powf(-2.0 - 2.0 * random.unit());
    let x = if random.below(2) == 0 { low + distance } else { high - distance };
    Decimal::near(x, digits + 3)
}

/// Three significant digits of the width are enough to be generic, and short enough to be read.
fn digits([low, high]: [f64; 2]) -> u32 {
    (3.0 - (high - low).max(1e-12).log10().floor()).clamp(0.0, 12.0) as u32
}
