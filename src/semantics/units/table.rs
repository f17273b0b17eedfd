//! The names of units, with and without prefixes.

use super::dimension::Dimension;

/// A unit that has a name of its own.
struct Named {
    names: &'static [&'static str],
    /// Exponents of kg, m, s, A, K, mol, cd.
    exponents: [i8; 7],
    /// Whether it takes prefixes.
    prefixed: bool,
}

const fn named(names: &'static [&'static str], exponents: [i8; 7], prefixed: bool) -> Named {
    Named { names, exponents, prefixed }
}

const NUMBER: [i8; 7] = [0; 7];
const TIME: [i8; 7] = [0, 0, 1, 0, 0, 0, 0];
const LENGTH: [i8; 7] = [0, 1, 0, 0, 0, 0, 0];
const RATE: [i8; 7] = [0, 0, -1, 0, 0, 0, 0];
const ENERGY: [i8; 7] = [1, 2, -2, 0, 0, 0, 0];

const UNITS: [Named; 52] = [
    named(&["g"], [1, 0, 0, 0, 0, 0, 0], true),
    named(&["m"], LENGTH, true),
    named(&["s"], TIME, true),
    named(&["A"], [0, 0, 0, 1, 0, 0, 0], true),
    named(&["K"], [0, 0, 0, 0, 1, 0, 0], true),
    named(&["mol"], [0, 0, 0, 0, 0, 1, 0], true),
    named(&["cd"], [0, 0, 0, 0, 0, 0, 1], true),
    named(&["Hz"], RATE, true),
    named(&["N"], [1, 1, -2, 0, 0, 0, 0], true),
    named(&["Pa"], [1, -1, -2, 0, 0, 0, 0], true),
    named(&["J"], ENERGY, true),
    named(&["W"], [1, 2, -3, 0, 0, 0, 0], true),
    named(&["C"], [0, 0, 1, 1, 0, 0, 0], true),
    named(&["V"], [1, 2, -3, -1, 0, 0, 0], true),
    named(&["F"], [-1, -2, 4, 2, 0, 0, 0], true),
    named(&["ohm", "Ω", "Ω"], [1, 2, -3, -2, 0, 0, 0], true),
    named(&["S"], [-1, -2, 3, 2, 0, 0, 0], true),
    named(&["Wb"], [1, 2, -2, -1, 0, 0, 0], true),
    named(&["T"], [1, 0, -2, -1, 0, 0, 0], true),
    named(&["H"], [1, 2, -2, -2, 0, 0, 0], true),
    named(&["lm"], [0, 0, 0, 0, 0, 0, 1], true),
    named(&["lx"], [0, -2, 0, 0, 0, 0, 1], true),
    named(&["Bq"], RATE, true),
    named(&["Gy", "Sv"], [0, 2, -2, 0, 0, 0, 0], true),
    named(&["kat"], [0, 0, -1, 0, 0, 1, 0], true),
    named(&["L", "l"], [0, 3, 0, 0, 0, 0, 0], true),
    named(&["bar"], [1, -1, -2, 0, 0, 0, 0], true),
    named(&["eV"], ENERGY, true),
    named(&["cal"], ENERGY, true),
    named(&["t"], [1, 0, 0, 0, 0, 0, 0], false),
    named(&["u", "Da"], [1, 0, 0, 0, 0, 0, 0], false),
    named(&["atm"], [1, -1, -2, 0, 0, 0, 0], false),
    named(&["degC", "°C", "℃"], [0, 0, 0, 0, 1, 0, 0], false),
    named(&["G"], [1, 0, -2, -1, 0, 0, 0], false),
    named(&["Gal"], [0, 1, -2, 0, 0, 0, 0], true),
    named(&["min"], TIME, false),
    named(&["h"], TIME, false),
    named(&["d", "day", "days"], TIME, false),
    named(&["week"], TIME, false),
    named(&["yr", "a"], TIME, true),
    named(&["year", "years"], TIME, false),
    named(&["century"], TIME, false),
    named(&["au", "AU"], LENGTH, false),
    named(&["ly"], LENGTH, false),
    named(&["pc"], LENGTH, true),
    named(&["rad"], NUMBER, true),
    named(&["sr"], NUMBER, false),
    named(&["deg", "°"], NUMBER, false),
    named(&["arcmin"], NUMBER, false),
    named(&["arcsec"], NUMBER, true),
    named(&["mas", "turn", "rev", "%", "percent", "ppm"], NUMBER, false),
    named(&["rpm"], RATE, false),
];

const PREFIXES: [&str; 24] = [
    "da", "Q", "R", "Y", "Z", "E", "P", "T", "G", "M", "k", "h", "d", "c", "m", "µ", "μ", "u", "n", "p", "f", "a", "z",
    "y",
];

/// The dimension of a name. A unit's own name goes before a prefix with a shorter name: `min` is the minute, `cd` the
/// candela, `Pa` the pascal.
pub(super) fn dimension(name: &str) -> Option<Dimension> {
    let find = |name: &str, prefixed: bool| {
        let unit = UNITS.iter().find(|u| u.names.contains(&name) && (u.prefixed || !prefixed))?;
        Some(Dimension::of(unit.exponents))
    };
    find(name, false).or_else(|| PREFIXES.iter().find_map(|p| find(name.strip_prefix(p)?, true)))
}

/// The name that was probably meant.
pub(super) fn nearest(name: &str) -> Option<String> {
    const WITH_PREFIX: [&str; 14] =
        ["kg", "mg", "km", "cm", "mm", "ms", "kN", "kPa", "kJ", "kW", "mA", "mV", "MeV", "mrad"];
    let other_case = [name.to_lowercase(), name.to_uppercase()].into_iter().find(|n| dimension(n).is_some());
    let plain = UNITS.iter().flat_map(|u| u.names.iter().copied());
    let candidates = WITH_PREFIX.into_iter().chain(plain).filter(|c| name.len() < 3 * c.len());
    other_case.or_else(|| crate::semantics::name::nearest(name, candidates).map(str::to_owned))
}
