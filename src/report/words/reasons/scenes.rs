//! What `scene` says of bodies, their models, and why one gives no numbers.

/// Patterns and what they say in Japanese.
pub(super) const PATTERNS: &[(&str, &str)] = &[
    // Scenes
    (
        "the heavy symmetric top: a body with a fixed point on its axis of symmetry, in uniform gravity",
        "重力のもとの対称こま: 対称軸上の一点を固定した、一様な重力の中の剛体",
    ),
    (
        "the free body: principal moments A, B, C, no torque; its axes are the inertial ones at t = 0",
        "自由剛体: 主慣性モーメント A、B、C、トルクなし。t = 0 で主軸は慣性系の軸に一致",
    ),
    (
        "precession and nutation of the Earth's axis under Moon and Sun on circular orbits",
        "円軌道の月と太陽による地球自転軸の歳差と章動",
    ),
    (
        "Mercury's rotation near the 3:2 resonance, its spin axis perpendicular to a Kepler orbit",
        "3:2 共鳴付近の水星の自転 (自転軸はケプラー軌道面に垂直)",
    ),
    (
        "the wobble of the not quite rigid Earth, in resonance with its deformation",
        "完全剛体でない地球の極運動 (変形との共鳴)",
    ),
    // Models
    (
        "the exact motion: theta by Jacobi's functions, phi and psi by integrals of the third kind",
        "厳密解: theta はヤコビの楕円関数、phi と psi は第三種楕円積分",
    ),
    (
        "the reduced equation for u = cos theta, with quadratures for phi and psi, by Taylor series",
        "u = cos(theta) についての一変数の方程式と phi、psi の求積 (テイラー級数法)",
    ),
    ("the full equations in Euler angles, by Taylor series", "オイラー角による運動方程式 (テイラー級数法)"),
    (
        "the full equations of the axis and the angular momentum, by Taylor series",
        "軸と角運動量についての運動方程式 (テイラー級数法)",
    ),
    ("the full equations with a unit quaternion, by Taylor series", "単位四元数による運動方程式 (テイラー級数法)"),
    (
        "the full equations in Euler angles, by Dormand and Prince's method of order 8",
        "オイラー角による運動方程式 (Dormand–Prince の 8 次法)",
    ),
    (
        "the full equations in Euler angles, by Gauss and Legendre's method: symmetric",
        "オイラー角による運動方程式 (Gauss–Legendre 法、対称)",
    ),
    (
        "the full equations in Euler angles, by the classical method of order 4, for comparison",
        "オイラー角による運動方程式 (比較のための古典的な 4 次法)",
    ),
    ("steady precession, the slow root", "定常歳差、遅い根"),
    ("steady precession, the fast root", "定常歳差、速い根"),
    ("small nutation, first order in its amplitude", "微小章動 (振幅の一次)"),
    (
        "the node at the constant rate of the precession, the obliquity constant",
        "一定の速さで歳差する昇交点、一定の黄道傾斜",
    ),
    ("precession and the series of the nutation, of first order in the torque", "歳差と章動の級数 (トルクの一次)"),
    (
        "the equations averaged over the revolutions of Moon and Sun, by Taylor series",
        "月と太陽の公転について平均した方程式 (テイラー級数法)",
    ),
    ("the equations of the axis, not averaged, by Taylor series", "平均しない軸の運動方程式 (テイラー級数法)"),
    (
        "the equations of the axis, not averaged, by Dormand and Prince's method of order 8",
        "平均しない軸の運動方程式 (Dormand–Prince の 8 次法)",
    ),
    (
        "the wobble that goes round with the deformation, of the amplitude that its frequency asks for",
        "変形とともに回る極運動 (振幅は振動数から決まる)",
    ),
    (
        "small wobbles: the free nutation at Euler's frequency and the forced one at that of the deformation",
        "微小な極運動: オイラー振動数の自由章動と、変形の振動数の強制章動",
    ),
    (
        "the resonant term alone, by Taylor series; all of it where A = B and nothing goes round the other way",
        "共鳴項のみ (テイラー級数法)。A = B で逆回りの成分がなければこれがすべて",
    ),
    ("the rotation of the deforming body, by Taylor series", "変形する物体の回転 (テイラー級数法)"),
    (
        "the rotation of the deforming body, by Dormand and Prince's method of order 8",
        "変形する物体の回転 (Dormand–Prince の 8 次法)",
    ),
    (
        "the exact motion: omega by Jacobi's functions, the attitude with an integral of the third kind",
        "厳密解: omega はヤコビの楕円関数、姿勢は第三種楕円積分",
    ),
    (
        "Euler's equations and the attitude's quaternion, by Taylor series",
        "オイラー方程式と姿勢の四元数 (テイラー級数法)",
    ),
    (
        "regular precession, as if A and B were both their mean; exact for A = B",
        "規則歳差 (A と B を両者の平均で置き換える。A = B なら厳密)",
    ),
    (
        "Euler's equations and the attitude's quaternion, by Dormand and Prince's method of order 8",
        "オイラー方程式と姿勢の四元数 (Dormand–Prince の 8 次法)",
    ),
    (
        "turns about the principal axes, composed to order 8: keeps the length of the momentum",
        "主軸まわりの回転を 8 次まで合成した分割法 (角運動量の大きさを保つ)",
    ),
    (
        "Euler's equations and the attitude by Gauss and Legendre's method: keeps energy and momentum",
        "オイラー方程式と姿勢 (Gauss–Legendre 法。エネルギーと角運動量を保つ)",
    ),
    (
        "Euler's equations and the attitude by the classical method of order 4, for comparison",
        "オイラー方程式と姿勢 (比較のための古典的な 4 次法)",
    ),
    (
        "small librations of the averaged motion, at the frequency n sqrt(3 epsilon H)",
        "平均した運動の微小秤動 (振動数 n sqrt(3 epsilon H))",
    ),
    ("the averaged motion, a pendulum, by Jacobi's elliptic functions", "平均した運動 (振り子、ヤコビの楕円関数)"),
    ("the averaged equations of the pendulum, by Taylor series", "平均した振り子の方程式 (テイラー級数法)"),
    (
        "the averaged equations with H to all orders in e and the short-period terms of first order in epsilon",
        "e のすべての次数を含む H による平均した方程式と、epsilon の一次の短周期項",
    ),
    (
        "the rotation on the Kepler orbit, not averaged, by Taylor series",
        "ケプラー軌道上の平均しない回転 (テイラー級数法)",
    ),
    (
        "the rotation on the Kepler orbit, not averaged, by Dormand and Prince's method of order 8",
        "ケプラー軌道上の平均しない回転 (Dormand–Prince の 8 次法)",
    ),
    // Constants, methods, numbers
    ("energy", "エネルギー"),
    ("splitting {n}, {m} steps a period", "{n} 次の分割法、1 周期 {m} ステップ"),
    ("Gauss-Legendre {n}, {m} steps a period", "{n} 次の Gauss–Legendre 法、1 周期 {m} ステップ"),
    ("Taylor series, tolerance {a}", "テイラー級数法、許容誤差 {a}"),
    ("Dormand-Prince {n}, {m} steps a period", "{n} 次の Dormand–Prince 法、1 周期 {m} ステップ"),
    ("double-double", "double-double"),
    ("double-double, or MPFR where that is not enough", "double-double (足りないときは MPFR)"),
    ("{n} bits", "{n} ビット"),
    // Why there are no numbers
    ("an error of {a} cannot be met", "誤差 {a} は達成できません"),
    (
        "no model meets an error of {a}: the best, `{b}` in {c}, has one of {d}",
        "誤差 {a} を満たすモデルがありません (最良は {c} の `{b}` で、誤差 {d})",
    ),
    ("no model meets an error of {a}: in {c}, {why}", "誤差 {a} を満たすモデルがありません ({c} では、{why})"),
    ("no model meets an error of {a}", "誤差 {a} を満たすモデルがありません"),
    ("the largest value, {a}, is held to {b} only", "最大の値 {a} を {b} の精度でしか表せません"),
    ("the model `{a}` gives no finite values here", "モデル `{a}` はここで有限の値を与えません"),
    ("the model `{a}` does not give {b}", "モデル `{a}` は {b} を与えません"),
];
