//! What `check` and `infer` say of an equation.

/// Patterns and what they say in Japanese.
pub(super) const PATTERNS: &[(&str, &str)] = &[
    // How an equation was judged
    ("with the solution put in", "解を代入して判定しました"),
    ("with the solution put in: {why}", "解を代入したところ、{why}"),
    ("in the equation that this one continues: {why}", "この式が続く前の式で、{why}"),
    ("exact: nothing is left over", "厳密に成り立ち、残差がありません"),
    ("a law that no state satisfies", "どの状態でも満たされない法則です"),
    (
        "a law: taken as given, and there are states that satisfy it",
        "前提として置かれた法則です (満たす状態があることを確かめました)",
    ),
    (
        "a datum of the notes: neither data nor premises say what it is",
        "文書が与える数値です (data にも前提にもありません)",
    ),
    ("nothing is printed but words", "文だけで式がありません"),
    // Approximations, inequalities, values
    ("the residual falls with order {n}, not {m}", "残差の次数は {n} で、{m} ではありません"),
    ("the premises could not be solved along the small parameter", "微小量を小さくしていくと、前提を解けません"),
    ("the {sign} sign never gives a solution", "{sign}の符号では解になりません"),
    ("upper", "上側"),
    ("lower", "下側"),
    (
        "the rounding errors hide the answer at {n} of {m} states",
        "{m} 状態のうち {n} 状態では、丸め誤差のため判定できません",
    ),
    ("{n} states were left out: their rounding errors are too large", "丸め誤差が大きすぎる {n} 状態を除きました"),
    (
        "the states lie all on one side of the condition: widen the ranges",
        "すべての状態が条件の一方の側にあります。値の範囲を広げてください",
    ),
    ("the inequality and the condition are not equivalent", "この不等式と条件は同値ではありません"),
    ("printed {a}, evaluated {b}: {rule}", "印刷された値 {a}、計算した値 {b}。{rule}"),
    ("half a unit of the last digit allows {a} to {b}", "末位の半単位までの差を認めると {a} から {b}"),
    ("a best fraction is near to within {a}", "最良近似分数として許される差は {a}"),
    ("an order of magnitude is right to within a factor of √10", "桁の比較では √10 倍以内の差を認めます"),
    (
        "no value is known for {a}: give it one under data = {b}",
        "{a} の値が分かりません。data = {b} のように値を与えてください",
    ),
    ("a printed value is one number", "印刷された値は一つの数でなければなりません"),
    ("a printed value is rounded", "印刷された値は丸められています"),
    ("a printed value is a number, not {shape}", "印刷された値は数であるべきですが、{shape}です"),
    ("the premises could not be solved precisely", "前提を十分な精度で解けませんでした"),
    ("data give a symbol a number", "data は記号に数を与えるものです"),
    // General solutions, harmonics, maps
    (
        "not general: the orders of the equations sum to {n}, the constants are {m}",
        "一般解ではありません。方程式の階数の和は {n} ですが、任意定数は {m} 個です",
    ),
    ("not general: the constants {a} are not independent", "一般解ではありません。任意定数 {a} は独立ではありません"),
    (
        "the premises bind this angle; declare by `same` what depends on it",
        "この角は前提で決まっています。これに依存する量を `same` で宣言してください",
    ),
    ("an angle of a Fourier series must be a symbol", "フーリエ級数の角は記号でなければなりません"),
    ("the harmonics of the sides are too many", "両辺の調和成分が多すぎます"),
    ("the right side has no harmonics in these angles", "右辺にはこれらの角の調和成分がありません"),
    (
        "the sides are no trigonometric sums of a low degree in these angles, as far as the premises say",
        "前提から分かるかぎり、両辺はこれらの角の低次の三角多項式ではありません",
    ),
    ("a map is written as X \\mapsto ...", "写像は X \\mapsto ... と書きます"),
    (
        "an arrow needs to be told what map it stands for: maps = '{a}'",
        "矢印が表す写像を指定してください: maps = '{a}'",
    ),
    ("a small parameter must be a symbol or 1 divided by one", "微小量は記号か、その逆数でなければなりません"),
    ("a condition is a single relation", "条件は一つの関係式でなければなりません"),
    ("a condition relates two scalars", "条件は二つのスカラーの関係でなければなりません"),
    (
        "there is no relation to evaluate; if that is right, say kind = \"statement\" and because = \"...\"",
        "評価する関係式がありません。それで正しければ kind = \"statement\" と because = \"...\" を書いてください",
    ),
    ("relations of this kind are not evaluated yet", "この種の関係はまだ評価できません"),
    ("no relation stands in this part: nothing is said about it", "この部分には関係記号がなく、何も主張していません"),
    // Premises
    ("the premise {a} cannot be used: {why}", "前提 {a} を使えません: {why}"),
    (
        "it continues ({a}), which cannot be understood: {why}",
        "前の式 ({a}) に続く式ですが、それを解釈できません: {why}",
    ),
    ("the premises go in a circle: {a}", "前提が循環しています: {a}"),
    (
        "an equation cannot be derived from one that is derived from it",
        "ある式から導かれる式を、その式の前提にはできません",
    ),
    ("more than {n} equations continue each other", "{n} 個を超える式が続いています"),
    ("there is no equation {a}", "式 {a} がありません"),
    ("there is no such equation", "そのような式がありません"),
    (
        "name a printed label, or for a display without a number the label before it with +1, +2 ...",
        "印刷された式番号か、番号のない式ではその前の番号に +1、+2、… を付けて指定してください",
    ),
    ("the equation has no link {n}", "この式に {n} 番目の等号はありません"),
    ("it has {n}: a = b = c has two, a = b and b = c", "等号は {n} 個です (a = b = c なら a = b と b = c の 2 個)"),
    ("premises for it", "ここに前提があります"),
    ("this is no formula of declared symbols", "宣言された記号の式ではありません"),
    ("the symbol {s} is not declared", "記号 {s} が宣言されていません"),
    (
        "the premises are {n} equations in {m} symbols, too many to be solved together: state fewer premises, or let the indices run over fewer values",
        "前提は {m} 個の記号についての {n} 個の方程式で、連立して解くには多すぎます。前提を減らすか、添字の範囲を狭めてください",
    ),
    (
        "no state was found at which all premises hold: they contradict each other, or have no solution in the ranges of the symbols",
        "すべての前提が成り立つ状態が見つかりませんでした。前提が互いに矛盾するか、記号の範囲に解がありません",
    ),
    (
        "no state was found at which the premises hold and both sides are numbers; check the premises, and the ranges of the symbols",
        "前提が成り立ち両辺が数値になる状態が見つかりませんでした。前提と記号の範囲を確かめてください",
    ),
    ("the premises contradict each other at the sampled states", "無作為に選んだ状態で、前提が互いに矛盾します"),
    // Time and size
    (
        "the time budget of {n} s is used up ({stage}); --budget SECONDS grants more",
        "制限時間 {n} 秒を使い切りました ({stage})。--budget 秒数 で延ばせます",
    ),
    (
        "{stage} takes more than {n} operations: let the sums have fewer terms, and state fewer premises",
        "{stage}に {n} を超える演算が要ります。和の項や前提を減らしてください",
    ),
    ("at the start", "初期状態"),
    ("evaluating both sides", "両辺の評価"),
    ("evaluating in a prime field", "素体での評価"),
    ("deriving the premises for a prime field", "素体での前提の微分"),
    ("deriving the premises by the symbols to solve for", "解く記号についての前提の微分"),
    ("following the small parameter", "微小量の追跡"),
    ("writing both sides out", "両辺の展開"),
    ("writing the formula out", "式の展開"),
    ("solving the premises", "前提の求解"),
    ("trying the mutants", "書き換えた式の判定"),
    ("searching what was meant", "訂正の探索"),
    (
        "Kenzan broke down at this equation, please report it with the notes: {a}",
        "この式で Kenzan 自身が異常終了しました。文書を添えて報告してください: {a}",
    ),
    // Why there is no exact verdict
    (
        "both sides are printed alike, so that it says nothing: has one of them lost something?",
        "両辺が同じ形で印刷されていて何も述べていません。どちらかに抜けはありませんか",
    ),
    ("an integral", "積分"),
    ("a prime field has no order", "素体には大小がありません"),
    ("its components have the two branches of ±", "成分が ± の両方の符号を含みます"),
    ("{things} has no meaning in a prime field", "{things}は素体では意味をもちません"),
    ("an angle that is no polynomial", "多項式でない角"),
    ("a power with a variable exponent", "指数が変数のべき"),
    ("an elliptic function", "楕円関数"),
    (
        "it depends on the signs of square roots, which a prime field does not know",
        "平方根の符号に依存しますが、素体では符号が定まりません",
    ),
    (
        "it has more square roots than all choices of signs can be tried for",
        "平方根が多く、符号のすべての選び方を試せません",
    ),
    ("the premises are not affine in {a}", "前提が {a} について一次ではありません"),
    (
        "the premises are solved for {a}, of which a function is taken",
        "前提を {a} について解きますが、{a} が関数の引数にあります",
    ),
    (
        "the premises have no unique solution where all other symbols are free",
        "他の記号を自由にとると、前提の解が一意に定まりません",
    ),
    (
        "every term vanishes by itself on the premises, which may say more than is meant",
        "前提のもとで各項がそれぞれ零になります。前提が言いすぎている可能性があります",
    ),
    (
        "no point of the prime field was found at which everything is defined",
        "素体の中に、すべてが定義される点が見つかりませんでした",
    ),
    ("the degree is too large for a useful bound", "次数が大きすぎて、有用な上界が得られません"),
    (
        "contradiction: the sides agree in their values, but not in a prime field",
        "矛盾: 両辺は数値では一致しますが、素体では一致しません",
    ),
    // Why a counterexample is not certified, and the certificate
    ("{a} lies outside its range at the state that was found", "見つかった状態で {a} が範囲の外にあります"),
    (
        "{a} is not proved to have the sign that its range declares",
        "{a} の符号が宣言された範囲のとおりであることを証明できません",
    ),
    (
        "a premise that says what is greater is not proved to hold there",
        "大小についての前提がそこで成り立つことを証明できません",
    ),
    (
        "the premises do not determine the solved symbols uniquely there: their Jacobian is singular",
        "そこでは前提から記号が一意に定まりません (ヤコビ行列が特異です)",
    ),
    ("it cannot be proved that everything is defined there", "そこですべてが定義されることを証明できません"),
    ("it cannot be proved that the premises have a solution there", "そこで前提が解をもつことを証明できません"),
    (
        "{n} of the premises hold there as far as intervals can tell, but are not proved to follow from the others",
        "前提のうち {n} 個は区間の範囲でそこで成り立ちますが、他の前提から従うことを証明できません",
    ),
    ("the premises contradict each other there", "そこで前提が互いに矛盾します"),
    ("the time is used up", "時間を使い切りました"),
    ("their difference cannot be told from zero with {n} bits", "{n} ビットでは、両辺の差を零と区別できません"),
    ("at {places} the difference {enclosure}, in fractions", "{places} のとき、両辺の差 {enclosure} (分数による計算)"),
    (
        "at {places} the difference {enclosure}, with {n} bits",
        "{places} のとき、両辺の差 {enclosure} ({n} ビットの区間演算)",
    ),
    ("the difference {enclosure}, in fractions", "両辺の差 {enclosure} (分数による計算)"),
    ("the difference {enclosure}, with {n} bits", "両辺の差 {enclosure} ({n} ビットの区間演算)"),
    // Components
    ("{a} component (inertial)", "{a} 成分 (慣性系)"),
    ("{a} component", "{a} 成分"),
    ("coefficient of {a}", "{a} の係数"),
    ("scalar part", "スカラー部"),
    ("real part", "実部"),
    ("imaginary part", "虚部"),
    ("change with {a}", "{a} についての変化"),
    // What is inferred
    ("needs {a}: it holds where this is so, and not elsewhere", "{a} が必要です (成り立つのはこのときに限ります)"),
    (
        "with the roles that are guessed its shapes do not meet: {why}; declare what its symbols are",
        "推定した役割では型が合いません ({why})。記号を宣言してください",
    ),
    ("new here: it follows from nothing before it", "前の式からは導かれず、ここで新しく導入される式です"),
    (
        "it does not follow from what stands before it: needs a premise, or has a misprint",
        "前の式からは導かれません。前提が足りないか、誤植があります",
    ),
    (
        "{why}; with one edit of {a} it would be an identity: {edit}",
        "{why}。{a} を一箇所書き換えると恒等式になります: {edit}",
    ),
    (
        "{why}; with one edit of {a} it would follow from {p}: {edit}",
        "{why}。{a} を一箇所書き換えると {p} から導かれます: {edit}",
    ),
    ("{why}; with one edit it would be an identity: {edit}", "{why}。一箇所書き換えると恒等式になります: {edit}"),
    ("{why}; with one edit it would follow from {p}: {edit}", "{why}。一箇所書き換えると {p} から導かれます: {edit}"),
    ("it contradicts {p}: no state satisfies all", "{p} と矛盾します (すべてを満たす状態がありません)"),
    ("it does not follow from what stands before it", "前の式からは導かれません"),
    // Roles of symbols
    ("the time", "時間"),
    ("a number", "実数"),
    ("a positive number", "正の実数"),
    ("an angle", "角"),
    ("a vector of length 1", "単位ベクトル"),
    ("a column of {n} numbers", "{n} 成分の列ベクトル"),
    ("a matrix of {n} × {m} numbers", "{n} 行 {m} 列の行列"),
    ("the identity matrix of {n} rows", "{n} 次の単位行列"),
    ("an index from {n} to {m}", "添字 ({n} から {m} まで)"),
    ("the imaginary unit", "虚数単位"),
];
