//! Quantities of the package siunitx: a number with a unit is its value in the units of the SI.
//!
//! `\SI{3.0e2}{\km\per\hour}` becomes `3.0 \times 10^{5} \times \frac{1}{3600}\,\text{m s$^{-1}$}`: prefixes are powers of
//! ten, which go to the number, and a unit that is no power of ten of the SI's brings its factor. The words at the end
//! are for the reader; a formula with numbers in it is in coherent units. Radian and degree are numbers. Uncertainties,
//! `1.20(3)`, are left out: the digits before them say how sharply the value is known.

use super::super::error::ParseError;
use super::argument::{Argument, lacks};
use super::lexer::{Kind, Token};
use super::{Expander, Macros};

/// A unit: its names, its symbol, exponents of kg, m, s, A, K, mol, cd, the power of ten, and another factor.
struct Unit(&'static str, &'static str, [i8; 7], i32, &'static str);

const NUMBER: [i8; 7] = [0; 7];
const METRE: [i8; 7] = [0, 1, 0, 0, 0, 0, 0];
const SECOND: [i8; 7] = [0, 0, 1, 0, 0, 0, 0];
const JOULE: [i8; 7] = [1, 2, -2, 0, 0, 0, 0];
const HERTZ: [i8; 7] = [0, 0, -1, 0, 0, 0, 0];
const KILOGRAM: [i8; 7] = [1, 0, 0, 0, 0, 0, 0];

/// The units by the names of siunitx. The values of those outside the SI are those of the SI brochure (9th edition).
const UNITS: &[Unit] = &[
    Unit("metre meter", "m", METRE, 0, ""),
    Unit("gram", "g", KILOGRAM, -3, ""),
    Unit("second", "s", SECOND, 0, ""),
    Unit("ampere", "A", [0, 0, 0, 1, 0, 0, 0], 0, ""),
    Unit("kelvin", "K", [0, 0, 0, 0, 1, 0, 0], 0, ""),
    Unit("mole", "mol", [0, 0, 0, 0, 0, 1, 0], 0, ""),
    Unit("candela", "cd", [0, 0, 0, 0, 0, 0, 1], 0, ""),
    Unit("hertz", "Hz", HERTZ, 0, ""),
    Unit("becquerel", "Bq", HERTZ, 0, ""),
    Unit("newton", "N", [1, 1, -2, 0, 0, 0, 0], 0, ""),
    Unit("pascal", "Pa", [1, -1, -2, 0, 0, 0, 0], 0, ""),
    Unit("joule", "J", JOULE, 0, ""),
    Unit("watt", "W", [1, 2, -3, 0, 0, 0, 0], 0, ""),
    Unit("coulomb", "C", [0, 0, 1, 1, 0, 0, 0], 0, ""),
    Unit("volt", "V", [1, 2, -3, -1, 0, 0, 0], 0, ""),
    Unit("farad", "F", [-1, -2, 4, 2, 0, 0, 0], 0, ""),
    Unit("ohm", "Ω", [1, 2, -3, -2, 0, 0, 0], 0, ""),
    Unit("siemens", "S", [-1, -2, 3, 2, 0, 0, 0], 0, ""),
    Unit("weber", "Wb", [1, 2, -2, -1, 0, 0, 0], 0, ""),
    Unit("tesla", "T", [1, 0, -2, -1, 0, 0, 0], 0, ""),
    Unit("henry", "H", [1, 2, -2, -2, 0, 0, 0], 0, ""),
    Unit("lumen", "lm", [0, 0, 0, 0, 0, 0, 1], 0, ""),
    Unit("gray sievert", "Gy", [0, 2, -2, 0, 0, 0, 0], 0, ""),
    Unit("litre liter", "L", [0, 3, 0, 0, 0, 0, 0], -3, ""),
    Unit("bar", "bar", [1, -1, -2, 0, 0, 0, 0], 5, ""),
    Unit("tonne", "t", KILOGRAM, 3, ""),
    Unit("angstrom", "Å", METRE, -10, ""),
    Unit("hectare", "ha", [0, 2, 0, 0, 0, 0, 0], 4, ""),
    Unit("minute", "min", SECOND, 0, "60"),
    Unit("hour", "h", SECOND, 0, "3600"),
    Unit("day", "d", SECOND, 0, "86400"),
    Unit("electronvolt", "eV", JOULE, -19, "1.602176634"),
    Unit("dalton atomicmassunit", "u", KILOGRAM, -27, "1.66053906892"),
    Unit("astronomicalunit", "au", METRE, 0, "149597870700"),
    Unit("parsec", "pc", METRE, 0, r"\frac{648000 \cdot 149597870700}{\pi}"),
    Unit("radian steradian", "rad", NUMBER, 0, ""),
    Unit("percent", "%", NUMBER, -2, ""),
    Unit("degree", "°", NUMBER, 0, r"\frac{\pi}{180}"),
    Unit("arcminute", "arcmin", NUMBER, 0, r"\frac{\pi}{10800}"),
    Unit("arcsecond", "arcsec", NUMBER, 0, r"\frac{\pi}{648000}"),
];

/// Prefixes: name, symbol, power of ten.
const PREFIXES: &[(&str, &str, i32)] = &[
    ("yotta", "Y", 24),
    ("zetta", "Z", 21),
    ("exa", "E", 18),
    ("peta", "P", 15),
    ("tera", "T", 12),
    ("giga", "G", 9),
    ("mega", "M", 6),
    ("kilo", "k", 3),
    ("hecto", "h", 2),
    ("deca deka", "da", 1),
    ("deci", "d", -1),
    ("centi", "c", -2),
    ("milli", "m", -3),
    ("micro", "µ", -6),
    ("micro", "u", -6),
    ("nano", "n", -9),
    ("pico", "p", -12),
    ("femto", "f", -15),
    ("atto", "a", -18),
    ("zepto", "z", -21),
    ("yocto", "y", -24),
];

/// The most factors that a unit may bring, and their length in bytes: units of the notes may be made of each other.
const MOST_FACTORS: usize = 64;
const LONGEST_FACTORS: usize = 4000;

/// The largest power that a unit may have.
const LARGEST_POWER: i32 = 20;

/// The most words that a unit may have, those of the notes' own units in it included.
const MOST_WORDS: usize = 300;

/// What a unit comes to.
#[derive(Clone, Debug, Default)]
struct Size {
    exponents: [i32; 7],
    ten: i32,
    factors: Vec<String>,
}

impl Size {
    fn of(unit: &Unit) -> Self {
        let factors = Some(unit.4).filter(|factor| !factor.is_empty()).map(str::to_owned);
        Size { exponents: unit.2.map(i32::from), ten: unit.3, factors: factors.into_iter().collect() }
    }

    /// Multiplies by a unit behind a prefix, to a power. `None` where the power or the definition is beyond reason.
    fn multiply(&mut self, unit: &Size, prefix: i32, power: i32) -> Option<()> {
        for (sum, exponent) in self.exponents.iter_mut().zip(unit.exponents) {
            *sum = sum.checked_add(exponent.checked_mul(power)?)?;
        }
        self.ten = self.ten.checked_add(unit.ten.checked_add(prefix)?.checked_mul(power)?)?;
        for factor in &unit.factors {
            let raised = if power.abs() == 1 { factor.clone() } else { format!("({factor})^{{{}}}", power.abs()) };
            self.factors.push(if power < 0 { format!("\\frac{{1}}{{{raised}}}") } else { raised });
        }
        (self.factors.len() <= MOST_FACTORS && self.factors.iter().map(String::len).sum::<usize>() <= LONGEST_FACTORS)
            .then_some(())
    }

    /// The base units in words: `kg m$^{2}$ s$^{-1}$`.
    fn words(&self) -> String {
        let names = ["kg", "m", "s", "A", "K", "mol", "cd"];
        let powers = names.iter().zip(self.exponents).filter(|(_, power)| *power != 0);
        let words: Vec<String> = powers
            .map(|(name, power)| if power == 1 { (*name).to_owned() } else { format!("{name}$^{{{power}}}$") })
            .collect();
        words.join(" ")
    }
}

/// Reads a unit: `\kilo\metre\per\second\squared`, `km.s^{-2}`, `km/s^2`; the notes may have units of their own.
fn size(text: &str, macros: &Macros, words_left: &mut usize) -> Option<Size> {
    let mut size = Size::default();
    let (mut per, mut all_per, mut prefix, mut before) = (false, false, 0, None::<i32>);
    let mut last: Option<(Size, i32, i32)> = None;
    let finish = |last: &mut Option<(Size, i32, i32)>, size: &mut Size| match last.take() {
        Some((unit, prefix, power)) => size.multiply(&unit, prefix, power),
        None => Some(()),
    };
    let mut rest = text.trim_start_matches([' ', '~', '.', '*', '{', '}']);
    while !rest.is_empty() {
        *words_left = words_left.checked_sub(1)?;
        let (word, is_macro) = word(rest)?;
        rest = rest.get(usize::from(is_macro) + word.len()..)?;
        let sign = if per || all_per { -1 } else { 1 };
        match word {
            "per" if is_macro => per = true,
            "/" => all_per = true,
            "squared" | "cubed" | "tothe" | "^" if last.is_some() => {
                let power = match word {
                    "squared" => 2,
                    "cubed" => 3,
                    _ => exponent(&mut rest)?,
                };
                let (_, _, own) = last.as_mut()?;
                *own = own.checked_mul(power)?;
            }
            "square" => before = Some(2),
            "cubic" => before = Some(3),
            "raiseto" => before = Some(exponent(&mut rest)?),
            _ => {
                let own = macros.unit(word).filter(|_| is_macro);
                let is_prefix = |p: &&(&str, &str, i32)| is_macro && p.0.split(' ').any(|name| name == word);
                if let (None, Some((_, _, ten))) = (own, PREFIXES.iter().find(is_prefix)) {
                    prefix += ten;
                } else {
                    finish(&mut last, &mut size)?;
                    let (unit, own) = match own {
                        Some(body) => (self::size(body, macros, words_left)?, 0),
                        None => find(word, is_macro).map(|(unit, ten)| (Size::of(unit), ten))?,
                    };
                    last = Some((unit, own + prefix, sign * before.take().unwrap_or(1)));
                    (per, prefix) = (false, 0);
                }
            }
        }
        rest = rest.trim_start_matches([' ', '~', '.', '*', '{', '}', ',']);
    }
    finish(&mut last, &mut size)?;
    (prefix == 0 && size.exponents.iter().all(|power| power.abs() <= LARGEST_POWER)).then_some(size)
}

/// The name of a macro (without its backslash), a run of letters, or a sign that a text begins with.
fn word(text: &str) -> Option<(&str, bool)> {
    let (inside, is_macro) = text.strip_prefix('\\').map_or((text, false), |inside| (inside, true));
    let letter = |c: char| c.is_alphabetic() || matches!(c, '°' | '%');
    let end = inside.find(|c| !letter(c)).unwrap_or(inside.len());
    let end = if end == 0 { inside.chars().next()?.len_utf8() } else { end };
    Some((inside.get(..end)?, is_macro))
}

/// The exponent that a text begins with: `2`, `{-2}`.
fn exponent(rest: &mut &str) -> Option<i32> {
    let inside = rest.trim_start().trim_start_matches('{').trim_start();
    let end = inside.find(|c: char| !c.is_ascii_digit() && c != '-').unwrap_or(inside.len());
    let power: i32 = inside.get(..end)?.parse().ok()?;
    *rest = inside.get(end..)?.trim_start().strip_prefix('}').unwrap_or(inside.get(end..)?);
    (power.abs() <= LARGEST_POWER).then_some(power)
}

/// A unit with the power of ten of its prefix, by its name or by its symbol (`\km` is the macro of the symbol `km`).
fn find(word: &str, is_macro: bool) -> Option<(&'static Unit, i32)> {
    let named = |unit: &&Unit| unit.0.split(' ').any(|name| name == word);
    let symbol = |symbol: &str| UNITS.iter().find(|unit| unit.1 == symbol || (symbol == "l" && unit.1 == "L"));
    if is_macro {
        if let Some(unit) = UNITS.iter().find(named) {
            return Some((unit, 0));
        }
        match word {
            "kilogram" => return symbol("g").map(|gram| (gram, 3)),
            "celsius" | "degreeCelsius" => return symbol("K").map(|kelvin| (kelvin, 0)),
            "amu" => return symbol("u").map(|dalton| (dalton, 0)),
            _ => {}
        }
    }
    symbol(word).map(|unit| (unit, 0)).or_else(|| {
        let prefixed = |(_, prefix, ten): &(&str, &str, i32)| {
            let rest = word.strip_prefix(prefix).filter(|rest| !rest.is_empty())?;
            symbol(rest).map(|unit| (unit, *ten))
        };
        PREFIXES.iter().find_map(prefixed)
    })
}

/// A number as siunitx reads it: its digits with their sign, and its power of ten.
fn digits(text: &str) -> Option<(String, i32)> {
    let text: String = text.chars().filter(|c| !c.is_whitespace() && *c != '~').collect();
    let (mantissa, ten) = match text.split_once(['e', 'E', 'd', 'D']) {
        Some((mantissa, ten)) => (mantissa, ten.parse().ok().filter(|ten: &i32| ten.abs() < 1000)?),
        None => (text.as_str(), 0),
    };
    let mantissa = mantissa.split("+-").next()?.split(r"\pm").next()?.split('±').next()?;
    let mantissa = mantissa.split('(').next()?.replace(',', ".");
    let figures = mantissa.trim_start_matches(['+', '-']);
    let plain = figures.chars().all(|c| c.is_ascii_digit() || c == '.') && figures.matches('.').count() < 2;
    if !plain || (ten == 0 && figures.is_empty()) {
        return None;
    }
    Some((if mantissa.is_empty() { "1".to_owned() } else { mantissa }, ten))
}

/// Takes the arguments of a quantity, options left out.
fn arguments<'a>(expander: &mut Expander<'a>, token: &Token<'a>, count: usize) -> Result<Vec<String>, ParseError> {
    expander.delimited('[', ']');
    let mut found = Vec::new();
    for at in 0..count {
        if at == 1 {
            expander.delimited('[', ']');
        }
        found.push(Argument::Given(expander.mandatory(token)?).text());
    }
    Ok(found)
}

/// Writes a number with a power of ten, factors and words in the place of a macro.
fn write(expander: &mut Expander, token: &Token, number: &str, size: &Size) {
    let mut text = match digits(number) {
        Some((digits, ten)) if ten + size.ten == 0 => digits,
        Some((digits, ten)) => format!("{digits}\\times 10^{{{}}}", ten + size.ten),
        None if size.ten == 0 => format!("{{{number}}}"),
        None => format!("{{{number}}}\\times 10^{{{}}}", size.ten),
    };
    for factor in &size.factors {
        text += &format!("\\times {factor}");
    }
    let words = size.words();
    if !words.is_empty() {
        text += &format!("\\,\\text{{{words}}}");
    }
    expander.write(&text, token);
}

fn sized(expander: &Expander, token: &Token, unit: &str) -> Result<Size, ParseError> {
    let unknown = || {
        let help = match unit.trim().strip_prefix('\\').and_then(|name| expander.macros.unit(name)) {
            Some(own) => format!(r"\DeclareSIUnit says `{own}`: say it in units that are known, as in \km\per\hour"),
            None => r"for example \metre\per\second".to_owned(),
        };
        lacks(token, &format!("the unit `{}` is not known", unit.trim()), &help)
    };
    size(unit, expander.macros, &mut { MOST_WORDS }).ok_or_else(unknown)
}

/// Whether two groups in braces follow, the first perhaps behind options: `\qty{3}{\metre}`.
pub(super) fn is_quantity(expander: &Expander) -> bool {
    if expander.macros.has_package("siunitx") && !expander.macros.has_package("physics") {
        return true;
    }
    let mut depth = 0_usize;
    let mut tokens = expander.waiting.iter().rev().filter(|token| token.kind != Kind::Space);
    for token in tokens.by_ref() {
        match token.kind {
            Kind::Open => depth += 1,
            Kind::Close if depth <= 1 => break,
            Kind::Close => depth -= 1,
            _ if depth == 0 => return false,
            _ => {}
        }
    }
    tokens.next().is_some_and(|token| token.kind == Kind::Open)
}

/// `\SI{3.0}{\metre}`, `\qty{3.0}{\metre}`
pub(super) fn quantity<'a>(expander: &mut Expander<'a>, token: &Token<'a>) -> Result<(), ParseError> {
    let found = arguments(expander, token, 2)?;
    let [number, unit] = found.as_slice() else { return Ok(()) };
    let size = sized(expander, token, unit)?;
    write(expander, token, number, &size);
    Ok(())
}

/// `\num{3.0e8}`
pub(super) fn number<'a>(expander: &mut Expander<'a>, token: &Token<'a>) -> Result<(), ParseError> {
    let found = arguments(expander, token, 1)?;
    write(expander, token, found.first().map_or("", String::as_str), &Size::default());
    Ok(())
}

/// `\si{\metre}`, `\unit{\metre}`: the unit alone is one of it.
pub(super) fn unit<'a>(expander: &mut Expander<'a>, token: &Token<'a>) -> Result<(), ParseError> {
    let found = arguments(expander, token, 1)?;
    let size = sized(expander, token, found.first().map_or("", String::as_str))?;
    if size.ten == 0 && size.factors.is_empty() {
        expander.write(&format!("\\,\\text{{{}}}", size.words()), token);
    } else {
        write(expander, token, "1", &size);
    }
    Ok(())
}

/// `\ang{30}`, `\ang{1;2;3}`: degrees, minutes, seconds.
pub(super) fn angle<'a>(expander: &mut Expander<'a>, token: &Token<'a>) -> Result<(), ParseError> {
    let found = arguments(expander, token, 1)?;
    let parts = found.first().map_or("", String::as_str).split(';');
    let signs = ["^{\\circ}", "'", "''"];
    let written = parts.zip(signs).filter(|(part, _)| !part.trim().is_empty());
    let text: String = written.map(|(part, sign)| format!("{}{sign}", part.trim())).collect();
    expander.write(&text, token);
    Ok(())
}
