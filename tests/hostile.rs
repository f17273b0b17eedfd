//! Notes that nobody would write, made to exhaust the stack, the memory or the patience: each gets a message that says
//! what is too much, and the sound equation before it is judged all the same.
//!
//! Every run has two gigabytes of address space (on Linux) and a minute.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
#![allow(missing_docs)]

use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::time::{Duration, Instant};

/// The time that a run may take; on an idle machine the longest takes a fifth of it.
const PATIENCE: Duration = Duration::from_secs(100);
/// The address space that a run may take, in kilobytes.
const SPACE: u32 = 2_500_000;

const HEAD: &str = "# Notes\n\n<!-- kenzan\n[symbols]\n'a, b, x, y' = { range = [0.5, 2.0] }\n\
    'i, j, k' = { index = [1, 3] }\n-->\n\n$$ a + b = b + a \\tag{1} $$\n\n$$ a b y = y b a \\tag{1a} $$\n\n";

fn directory(name: &str) -> PathBuf {
    let at = Path::new(env!("CARGO_TARGET_TMPDIR")).join("hostile").join(name);
    let _ = std::fs::remove_dir_all(&at);
    std::fs::create_dir_all(&at).unwrap();
    at
}

/// Runs the program on what stands in a directory. Two threads: their stacks are address space, too.
fn kenzan(at: &Path, arguments: &[&str]) -> Output {
    let limit = if cfg!(target_os = "linux") { format!("ulimit -v {SPACE}; ") } else { String::new() };
    Command::new("sh")
        .args(["-c", &format!("{limit}exec \"$0\" \"$@\""), env!("CARGO_BIN_EXE_kenzan")])
        .args(["verify", "notes.md", "--jobs", "2"])
        .args(if arguments.contains(&"--budget") { [].as_slice() } else { &["--budget", "4"] })
        .args(arguments)
        .current_dir(at)
        .envs([("NO_COLOR", "1"), ("LC_ALL", "C")])
        .env_remove("RUST_BACKTRACE")
        .output()
        .unwrap()
}

/// Verifies the head followed by something, and gives what is said.
fn said(name: &str, rest: &str, arguments: &[&str]) -> String {
    let at = directory(name);
    std::fs::write(at.join("notes.md"), format!("{HEAD}{rest}")).unwrap();
    let begin = Instant::now();
    let output = kenzan(&at, arguments);
    let took = begin.elapsed();
    let (out, err) = (String::from_utf8(output.stdout).unwrap(), String::from_utf8(output.stderr).unwrap());
    println!("{name}: {took:.1?}");
    assert!(took < PATIENCE, "{name}: {took:?}");
    assert!(matches!(output.status.code(), Some(0 | 1)), "{name}: {:?}\n{err:.1000}", output.status);
    assert!(!err.contains("panicked") && !out.contains("broke down"), "{name}: {err:.1000}{out:.1000}");
    let held = out.lines().find_map(|l| l.trim().strip_prefix("✓ ")?.split(' ').next()?.parse::<usize>().ok());
    assert!(held >= Some(2), "{name}: what is sound holds\n{out:.1000}");
    let page = std::fs::read_to_string(at.join("out/report.html")).unwrap();
    assert!(page.ends_with("</html>\n"), "{name}");
    out
}

/// Verifies notes whose equation (2) is to be answered with these words.
fn answered(name: &str, rest: &str, words: &str) {
    // Time enough for a slow machine: the limits do not depend on the clock.
    answered_within("60", name, rest, words);
}

/// The same with a time budget for each equation, in seconds.
fn answered_within(budget: &str, name: &str, rest: &str, words: &str) {
    let text = said(name, rest, &["--budget", budget]);
    let line = text.lines().find(|l| l.contains("(2)")).unwrap_or_else(|| panic!("{name}: {text:.1000}"));
    assert!(line.contains(words), "{name}: expected `{words}` in `{line:.500}`");
    assert!(line.len() < 1000, "{name}: a line of {} bytes", line.len());
}

fn display(latex: &str) -> String {
    format!("$$ {latex} \\tag{{2}} $$\n")
}

fn declared(symbols: &str, latex: &str) -> String {
    format!("<!-- kenzan\n[symbols]\n{symbols}\n-->\n\n{}", display(latex))
}

fn with_premises(symbols: &str, latex: &str, premises: &[String]) -> String {
    format!("{}<!-- kenzan\nwhere = [{}]\n-->\n", declared(symbols, latex), premises.join(", "))
}

#[test]
fn nesting() {
    let pairs = [
        ("braces", "{", "}"),
        ("fractions", r"\frac{", "}{b}"),
        ("brackets", r"\left(", r"\right)"),
        ("roots", r"\sqrt{", "}"),
        ("bare_roots", r"\sqrt", ""),
        ("superscripts", "a^{", "}"),
        ("subscripts", "a_{", "}"),
        ("matrices", r"\begin{pmatrix}", r"\end{pmatrix}"),
    ];
    for (name, open, close) in pairs {
        let deep = |n: usize| display(&format!("a = {} a {}", open.repeat(n), close.repeat(n)));
        answered(name, &deep(2000), "100");
        answered(&format!("{name}_deep"), &deep(100_000), "bytes; at most 65536 are read");
    }
    let toml =
        format!("{}<!-- kenzan\ngiven = {}{}\n-->\n", display("a = 2 a"), "[".repeat(100_000), "]".repeat(100_000));
    assert!(said("toml", &toml, &[]).contains("not valid TOML"));
}

#[test]
fn size() {
    said("prose", &format!("{}\n\n{}", "words and ".repeat(1_000_000), display("a = 2 a")), &[]);
    answered("display", &display(&format!("a = {} a", "a + ".repeat(2_500_000))), "bytes; at most 65536 are read");
    // As long as is read, in ways that take the square of the length if one is not careful.
    for (name, latex) in [
        ("long_sum", format!("a = {} a", "a + ".repeat(15_000))),
        ("long_product", format!("a = {} a", "a b ".repeat(15_000))),
        ("crosses", format!("a = {} a", r"a \times ".repeat(6_000))),
        ("signs", format!("a = {} a", r"b \pm ".repeat(5_000))),
        ("fractions_side_by_side", format!("a = {} a", r"\frac{a}{b} ".repeat(5_000))),
        ("rows", format!(r"\begin{{aligned}} {} \end{{aligned}}", r"a &= b \\".repeat(5_000))),
    ] {
        answered(name, &display(&latex), "fails");
    }
    answered("primes", &display(&format!("a{} = b", "'".repeat(60_000))), "more than 255 primes");
    answered("digits", &display(&format!("a = {}", "7".repeat(60_000))), "no state was found");
    let mutants = format!("a = {} a", "a + ".repeat(15_000));
    said("long_formula_in_depth", &display(&mutants), &["--deep"]);
    said("many_mutants", &display(&["a b x y"; 150].join(" + ").replacen("a b", "a =", 1)), &["--deep"]);
}

/// The time grows with the number of equations, not with its square.
#[test]
fn many_displays() {
    let time = |count: usize| {
        let displays: String = (2..count).map(|n| format!("$$ a + {n} = {n} + a \\tag{{{n}}} $$\n\n")).collect();
        let begin = Instant::now();
        said(&format!("displays_{count}"), &displays, &["--states", "4"]);
        begin.elapsed().as_secs_f64()
    };
    let (few, many) = (time(3_000), time(30_000));
    assert!(many < 30.0 * few, "3000 displays take {few:.1} s, 30000 take {many:.1} s");
}

#[test]
fn displays_that_refer_to_each_other() {
    let chain = "$$ = a $$\n\n".repeat(5_000);
    let text = said("continued", &format!("{}\n{chain}", display("a = a + 0")), &["--states", "4"]);
    assert!(text.contains("more than 100 equations continue each other"), "{text:.1000}");
    let given = |n: usize, next: usize| format!("$$ a = x \\tag{{{n}}} $$\n<!-- kenzan\ngiven = ['{next}']\n-->\n\n");
    let ring: String = (2..5_002).map(|n| given(n, if n < 5_001 { n + 1 } else { 2 })).collect();
    answered("ring", &ring, "the premises go in a circle: 2 → 3 → 4 → 5 → 6 → 7 → 8 → 9 → … → 2");
    let sections: String = (2..5_000).map(|n| format!("## S\n\n$$ a = a + 0 \\tag{{{n}}} $$\n\n")).collect();
    said("sections", &sections, &["--states", "4"]);
    let label = |n: usize| -> String { (0..12).map(|bit| if n >> bit & 1 == 0 { '!' } else { '?' }).collect() };
    let labels: String = (0..4_000).map(|n| format!("$$ a = a + 0 \\tag{{{}}} $$\n\n", label(n))).collect();
    said("labels", &labels, &["--states", "4"]);
}

#[test]
fn macros_that_expand_without_end() {
    let doubling: String =
        (b'a'..=b'y').map(|c| (c as char, (c + 1) as char)).map(|(a, b)| format!(r"\def\m{a}{{\m{b}\m{b}}}")).collect();
    for (name, latex, words) in [
        ("doubling", format!(r"{doubling} \ma = a"), "does not end"),
        ("endless", r"\def\x{\x\x} \x = a".to_owned(), "does not end"),
        ("newcommand", r"\newcommand{\x}{\x\x} \x = a".to_owned(), "does not end"),
        // \let gives the meaning that \y has there, which is none.
        ("let", r"\let\x=\y \gdef\y{\x} \x = a".to_owned(), "unknown macro"),
    ] {
        answered(name, &display(&latex), words);
    }
}

#[test]
fn numbers() {
    answered("tower", &display("10^{10^{10}} = a"), "no state was found");
    answered("higher_tower", &display("10^{10^{10^{10}}} = 2^{10^{10^{10}}}"), "no state was found");
    // What underflows is not equal for it.
    answered("power", &display("x^{10^9} = x^{10^9 + 1}"), "the rounding errors hide the answer");
    answered("small", &display(r"\exp(-10^6 - x) = \exp(-10^6 - y)"), "the rounding errors hide the answer");
    answered("binomial", &display("(1 + x)^{1000000} = a"), "no state was found");
    answered("root", &display(r"\sqrt[1000000]{x} = a"), "fails");
    said("units", &declared("'u' = { unit = \"kg^999999999999\" }", "u = 2 u"), &[]);
    let brackets = format!("'u' = {{ unit = \"{}\" }}", "(".repeat(100_000));
    said("brackets_in_units", &declared(&brackets, "u = 2 u"), &[]);
}

#[test]
fn sums() {
    let too_many = "at most 10000 are written out";
    let too_large = "written out, this has more than";
    answered("sum", &display(r"a = \sum_{i=1}^{1000000000} i"), too_many);
    answered("sum_i64", &display(r"a = \sum_{i=-9223372036854775807}^{9223372036854775807} i"), too_many);
    let nested = |body: &str| {
        display(&format!(r"a = \sum_{{i=1}}^{{10000}} \sum_{{j=1}}^{{10000}} \sum_{{k=1}}^{{10000}} {body}"))
    };
    answered("nested", &nested("1"), too_large);
    answered("nested_symbols", &nested("x^i y^j b^k"), too_large);
    answered("products", &display(r"a = \prod_{i=1}^{10000} \prod_{j=1}^{10000} (x + i j)"), too_large);
    answered(
        "each",
        &declared("'n' = { index = [1, 1000000000] }\n'm_n' = { each = 'n' }", r"\sum_n m_n = a"),
        too_many,
    );
    answered("instances", &declared("'n, p, q' = { index = [-1000000000, 1000000000] }", "n p q = a"), too_many);
    let operators = r"\frac{d^{12}}{dx^{12}} ".repeat(10);
    answered_within("4", "derivatives", &display(&format!(r"{operators} \left(\sin(\cos(x^2))\right) = a")), "used up");
}

#[test]
fn matrices() {
    let text = said("matrix", &declared("'M' = { matrix = [1000000, 1000000] }", "M = M + 0"), &[]);
    assert!(text.contains("must be a list of two whole numbers"), "{text:.1000}");
    let text = said("vector", &declared("'v' = { matrix = [10000, 1] }", "v = v + 0"), &[]);
    assert!(text.contains("a matrix of 10000 entries; at most 1000 are read"), "{text:.1000}");
    answered("powers", &declared("'M' = { matrix = [31, 31] }", &format!("M = {}", "M ".repeat(500))), "written out");
    answered("determinant", &declared("'M' = { matrix = [31, 31] }", r"\det M = 1"), "at most 6");
    answered("header", &display(r"\begin{array}{*{1000000}{c}} a & b \end{array} = a"), "do not meet");
    answered(
        "cells",
        &display(&format!(r"\begin{{pmatrix}} {} \end{{pmatrix}} = a", "&".repeat(60_000))),
        "missing here",
    );
}

#[test]
fn symbols_and_premises() {
    let symbols =
        |count: usize| -> String { (0..count).map(|n| format!("'s_{{{n}}}' = {{ range = [1, 2] }}\n")).collect() };
    answered("symbols", &declared(&symbols(100_000), "s_{5} + a = a"), "fails");
    let premises = |count: usize, f: fn(usize) -> String| -> Vec<String> { (0..count).map(f).collect() };
    let definitions = premises(10_000, |n| format!("'s_{{{}}} = s_{{{n}}} + 1'", n + 1));
    let rest = with_premises(&symbols(10_001), "s_{10000} = s_{0} + 1", &definitions);
    answered_within("4", "definitions", &rest, "the time budget of 4 s is used up");
    let cubes = |n: usize| format!("'s_{{{}}}^3 + s_{{{n}}}^3 = 3'", n + 1);
    let rest = with_premises(&symbols(10_001), "s_{10000} = s_{0} + 1", &premises(10_000, cubes));
    answered("cubes", &rest, "too many to be solved together");
    let rest = with_premises(&symbols(401), "s_{400} = s_{0} + 1", &premises(400, cubes));
    said("system", &rest, &[]);
}

#[test]
fn circles() {
    for (name, symbols) in [
        ("same", "'p' = { same = 'q' }\n'q' = { same = 'p' }"),
        ("itself", "'p' = { same = 'p' }"),
        ("component", "'p' = { component_of = 'p' }"),
    ] {
        let text = said(name, &declared(symbols, "p = a"), &[]);
        assert!(text.contains("is another notation of itself"), "{text:.1000}");
    }
    let backwards: String = (0..20_000).map(|n| format!("'p_{{{}}}' = {{ same = 'p_{{{n}}}' }}\n", n + 1)).collect();
    answered("chain_backwards", &declared(&backwards, "p_{20000} = a"), "in a circle?");
    let chain: String = (0..20_000).map(|n| format!("'p_{{{n}}}' = {{ same = 'p_{{{}}}' }}\n", n + 1)).collect();
    answered("chain", &declared(&chain, "p_{0} = a"), "in a circle?");
    let premises = ["'a = b'", "'b = a'", "'a = a + 1'"].map(String::from);
    answered("premises", &with_premises("", "a = 2 b", &premises), "contradict");
    said("solves_itself", &format!("{}<!-- kenzan\nsolves = ['2']\n-->\n", display("a = 2 b")), &[]);
}

#[test]
fn time() {
    let at = directory("time");
    std::fs::write(at.join("notes.md"), HEAD).unwrap();
    let output = kenzan(&at, &["--states", "1000000", "--budget", "1"]);
    let text = String::from_utf8(output.stdout).unwrap();
    assert_eq!(output.status.code(), Some(1), "{text:.1000}");
    assert!(text.contains("the time budget of 1 s is used up"), "{text:.1000}");
    assert!(text.contains("--budget SECONDS grants more"));
}

#[test]
fn bytes() {
    let crlf = format!("{HEAD}{}", display("a = 2 a")).replace('\n', "\r\n");
    for (name, notes) in [("crlf", crlf.clone()), ("bom", format!("\u{feff}{crlf}"))] {
        let at = directory(name);
        std::fs::write(at.join("notes.md"), notes).unwrap();
        let text = String::from_utf8(kenzan(&at, &[]).stdout).unwrap();
        assert!(text.contains("✓ 2 holds") && text.contains("(2) notes.md:13 fails"), "{text}");
    }
    answered("nul", &display("a = \0 2 a"), "is not read in a formula");
    for (name, notes, words) in [
        ("binary", (0..=255).collect::<Vec<u8>>(), "the file is not UTF-8"),
        ("utf16", b"\xff\xfe$\0$\0".to_vec(), "the file is not UTF-8"),
        ("blank", b" \n\t\n\xef\xbb\xbf".to_vec(), "is empty"),
        ("huge", vec![b' '; 65 << 20], "is larger than 64 MB"),
    ] {
        let at = directory(name);
        std::fs::write(at.join("notes.md"), notes).unwrap();
        let output = kenzan(&at, &[]);
        assert_eq!(output.status.code(), Some(2), "{name}");
        assert!(String::from_utf8(output.stderr).unwrap().contains(words), "{name}");
    }
    #[cfg(unix)]
    {
        let at = directory("endless_file");
        std::os::unix::fs::symlink("/dev/zero", at.join("notes.md")).unwrap();
        let output = kenzan(&at, &[]);
        assert!(String::from_utf8(output.stderr).unwrap().contains("is larger than 64 MB"));
    }
}

/// Escape sequences in notes must not reach the terminal.
#[test]
fn nothing_steers_the_terminal() {
    let escape = "\u{1b}]0;owned\u{7}\u{1b}[2J\u{9b}31m";
    let rest = format!(
        "## {escape}\n\n$$ a = {escape} \\tag{{2{escape}}} $$\n\n$$ a_{{\\text{{{escape}}}}} = b \\tag{{3}} $$\n\
         <!-- kenzan\ngiven = ['{escape}']\n-->\n\n$$ a = b\n"
    );
    let at = directory("escape");
    std::fs::write(at.join("notes.md"), format!("{HEAD}{rest}")).unwrap();
    let output = kenzan(&at, &[]);
    for text in [output.stdout, output.stderr] {
        let text = String::from_utf8(text).unwrap();
        let steers = |c: &char| c.is_control() && !matches!(c, '\n' | '\t' | '\r');
        assert_eq!(text.chars().find(steers), None, "{:?}", text.lines().find(|l| l.contains(|c: char| steers(&c))));
    }
}
