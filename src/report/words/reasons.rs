//! Frequent sentences that the checker composes, in Japanese. What has no translation here stays in English.

use super::with;
use std::borrow::Cow;
use std::fmt::Display;

/// Patterns with places, and what they say; the first that fits is taken.
const JAPANESE: &[(&str, &str)] = &[
    // Roles of symbols
    ("the time", "時間"),
    ("a number", "実数"),
    ("a positive number", "正の実数"),
    ("an angle", "角"),
    ("a vector", "ベクトル"),
    ("a vector of length 1", "単位ベクトル"),
    ("a column of {n} numbers", "{n} 成分の列ベクトル"),
    ("a matrix of {n} × {m} numbers", "{n} 行 {m} 列の行列"),
    ("the identity matrix of {n} rows", "{n} 次の単位行列"),
    ("an index from {n} to {m}", "添字 ({n} から {m} まで)"),
    ("the imaginary unit", "虚数単位"),
    // Verdicts
    ("with the solution put in", "解を代入して判定しました"),
    ("the residual falls with order {n}, not {m}", "残差の次数は {n} で、{m} ではありません"),
    ("{n} states were left out: their rounding errors are too large", "丸め誤差が大きすぎる {n} 状態を除きました"),
    ("new here: it follows from nothing before it", "前の式からは導かれず、ここで新しく導入される式です"),
    (
        "it does not follow from what stands before it: needs a premise, or has a misprint",
        "前の式からは導かれません。前提が足りないか、誤植があります",
    ),
    (
        "it does not follow from what stands before it; with one edit it would follow from {p}: {edit}",
        "前の式からは導かれませんが、一箇所書き換えると {p} から導かれます: {edit}",
    ),
    (
        "it does not follow from what stands before it; with one edit it would be an identity: {edit}",
        "前の式からは導かれませんが、一箇所書き換えると恒等式になります: {edit}",
    ),
    (
        "it contradicts {p}: no state satisfies all; with one edit it would follow from {q}: {edit}",
        "{p} と矛盾します (すべてを満たす状態がありません)。一箇所書き換えると {q} から導かれます: {edit}",
    ),
    ("the symbol {s} is not declared", "記号 {s} が宣言されていません"),
    ("a vector and a scalar cannot be equal", "ベクトルとスカラーは等しくなりえません"),
    ("nothing is printed but words", "文だけで式がありません"),
    ("a prime field has no order", "素体には大小がありません"),
    (
        "every term vanishes by itself on the premises, which may say more than is meant",
        "前提のもとで各項がそれぞれ零になります。前提が言いすぎている可能性があります",
    ),
    // Edits
    ("the sign of `{a}` flipped", "`{a}` の符号を反転"),
    ("the term `{a}` dropped", "項 `{a}` を削除"),
    ("the factor `{a}` put before `{b}`", "`{b}` の前に係数 `{a}` を追加"),
    ("the factor `{a}` dropped from `{b}`", "`{b}` から係数 `{a}` を削除"),
    ("the factor `{a}` dropped", "係数 `{a}` を削除"),
    ("the argument `{a}` doubled", "引数 `{a}` を 2 倍に"),
    ("the bracket closed after `{a}`", "括弧を `{a}` の後で閉じる"),
    ("the index `{a}` of a bracket changed to `{b}`", "括弧の添字 `{a}` を `{b}` に変更"),
    ("the power {n} of `{a}` changed to {m}", "`{a}` の指数 {n} を {m} に変更"),
    ("the number {n} changed to {m}", "数 {n} を {m} に変更"),
    ("the root of `{a}` dropped", "`{a}` の根号を削除"),
    ("`{a}` doubled", "`{a}` を 2 倍に"),
    ("`{a}` squared", "`{a}` を 2 乗に"),
    ("`{a}` turned over", "`{a}` の分子と分母を入れ替え"),
    ("`{a}` changed to `{b}`", "`{a}` を `{b}` に変更"),
    // Shapes and states
    ("the sides differ by a sign", "両辺は符号が異なります"),
    (
        "no state was found at which the premises hold and both sides are numbers; {rest}",
        "前提が成り立ち両辺が数値になる状態が見つかりませんでした ({rest})",
    ),
];

/// The sentence in Japanese, or as it is.
pub(super) fn japanese(english: &str) -> Cow<'_, str> {
    for &(pattern, japanese) in JAPANESE {
        if let Some(found) = places(pattern, english) {
            // A sentence may end in an edit.
            let said: Vec<(&str, Cow<'_, str>)> = found
                .iter()
                .map(|(name, text)| (*name, if *name == "edit" { self::japanese(text) } else { Cow::from(*text) }))
                .collect();
            let said: Vec<(&str, &dyn Display)> =
                said.iter().map(|(name, text)| (*name, text as &dyn Display)).collect();
            return with(japanese, &said).into();
        }
    }
    english.into()
}

/// What stands in the places of a pattern, where the text fits it.
fn places<'t>(pattern: &'static str, text: &'t str) -> Option<Vec<(&'static str, &'t str)>> {
    let mut pieces = pattern.split('{');
    let mut rest = text.strip_prefix(pieces.next()?)?;
    let mut found = Vec::new();
    for piece in pieces {
        let (name, literal) = piece.split_once('}')?;
        let end = if literal.is_empty() { rest.len() } else { rest.find(literal)? };
        found.push((name, &rest[..end]));
        rest = &rest[end + literal.len()..];
    }
    rest.is_empty().then_some(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frequent_sentences_are_translated() {
        for (english, expected) in [
            ("a matrix of 2 × 3 numbers", "2 行 3 列の行列"),
            ("the symbol $y$ is not declared", "記号 $y$ が宣言されていません"),
            (
                "it does not follow from what stands before it; with one edit it would follow from (3): the sign of `a` flipped",
                "前の式からは導かれませんが、一箇所書き換えると (3) から導かれます: `a` の符号を反転",
            ),
            ("nobody has seen this", "nobody has seen this"),
            ("a vector of length 1 and more", "a vector of length 1 and more"),
        ] {
            assert_eq!(japanese(english), expected);
        }
    }

    #[test]
    fn what_is_quoted_is_no_pattern() {
        assert_eq!(japanese("the symbol {s} {t} is not declared"), "記号 {s} {t} が宣言されていません");
    }

    #[test]
    fn translations_have_the_places_of_their_patterns() {
        let names = |text: &str| {
            let mut names: Vec<String> =
                text.split('{').skip(1).filter_map(|p| Some(p.split_once('}')?.0.to_owned())).collect();
            names.sort();
            names
        };
        for &(english, japanese) in JAPANESE {
            assert_eq!(names(english), names(japanese), "{english}");
        }
    }
}
