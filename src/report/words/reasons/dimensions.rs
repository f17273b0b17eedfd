//! What is said of dimensions.

/// Patterns and what they say in Japanese.
pub(super) const PATTERNS: &[(&str, &str)] = &[
    (
        "the term {a} is a number and would fit into the argument of {b} before it: are brackets missing? Without it, {why}",
        "項 {a} は無次元で、直前の {b} の引数に入りそうです。括弧が抜けていませんか。これを除くと、{why}",
    ),
    (
        "the term {a} is a number and would fit into the argument of {b} before it: are brackets missing?",
        "項 {a} は無次元で、直前の {b} の引数に入りそうです。括弧が抜けていませんか",
    ),
    ("{why}; a factor {choices} would mend it", "{why}。係数 {choices} を掛ければ合います"),
    ("the terms have different dimensions: {a}", "項の次元が異なります: {a}"),
    (
        "the argument {a} of {b} has the dimension {c} and must be a number",
        "{b} の引数 {a} の次元は {c} ですが、無次元でなければなりません",
    ),
    (
        "the exponent {a} has the dimension {c} and must be a number",
        "指数 {a} の次元は {c} ですが、無次元でなければなりません",
    ),
    ("{what} has the dimension {a}, the left side {b}", "{what}の次元は {a}、左辺の次元は {b} です"),
    ("{what} has the dimension {a}, the right side {b}", "{what}の次元は {a}、右辺の次元は {b} です"),
    ("{what} has the dimension {a}, the others {b}", "{what}の次元は {a}、他の項の次元は {b} です"),
    ("{what} has the dimension {a}, the other {b}", "{what}の次元は {a}、もう一方の次元は {b} です"),
    ("{what} have the dimension {a}, the left side {b}", "{what}の次元は {a}、左辺の次元は {b} です"),
    ("{what} have the dimension {a}, the right side {b}", "{what}の次元は {a}、右辺の次元は {b} です"),
    ("{what} have the dimension {a}, the others {b}", "{what}の次元は {a}、他の項の次元は {b} です"),
    ("{what} have the dimension {a}, the other {b}", "{what}の次元は {a}、もう一方の次元は {b} です"),
    ("within {a} the dimensions {b} and {c} meet", "{a} の中で、次元 {b} と {c} の量が足されているか比べられています"),
    ("the left side", "左辺"),
    ("the right side", "右辺"),
    ("the term ${a}$", "項 ${a}$ "),
    ("the terms ${a}", "項 ${a} "),
    // Units
    ("unknown unit {a}", "単位 {a} は未知です"),
    ("an unexpected sign", "ここにこの文字は置けません"),
    ("a factor behind a divisor can be read in two ways", "割り算の後の因子は二通りに読めます"),
    (
        "write J/(kg K), or put the divisors last as in J K/kg",
        "J/(kg K) と書くか、J K/kg のように割る単位を最後に置いてください",
    ),
    ("the exponents are too large", "指数が大きすぎます"),
    ("brackets nested too deep", "括弧の入れ子が深すぎます"),
    ("this bracket is not closed", "この括弧が閉じていません"),
    ("a unit is missing here", "ここに単位がありません"),
    ("a number has the unit 1", "無次元量の単位は 1 です"),
    ("this exponent is not closed", "この指数が閉じていません"),
    ("an exponent with the denominator 0", "指数の分母が 0 です"),
    ("an exponent must be a whole number up to {n}", "指数は {n} 以下の整数でなければなりません"),
];
