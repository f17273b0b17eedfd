//! What the tests of all floors share.

use proptest::test_runner::{Config, RngSeed};

/// How properties are tried: on `cases` samples, which are the same in each run, so that a change is judged by what it
/// changes. `PROPTEST_RNG_SEED` draws others, `PROPTEST_CASES` more of them.
pub(crate) fn properties(cases: u32) -> Config {
    let asked = Config::default();
    let cases = if std::env::var_os("PROPTEST_CASES").is_some() { asked.cases } else { cases };
    let rng_seed = if asked.rng_seed == RngSeed::Random { RngSeed::Fixed(1) } else { asked.rng_seed };
    Config { cases, rng_seed, failure_persistence: None, ..asked }
}
