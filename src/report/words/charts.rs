//! The words of the charts of the heavy top.

use super::Language;
use serde::Serialize;

/// All of them; `$...$` is mathematics.
#[derive(Serialize)]
pub(in crate::report) struct ChartWords {
    pub nutations: &'static str,
    pub relative_drift: &'static str,
    pub relative_error: &'static str,
    pub error: &'static str,
    pub energy: &'static str,
    pub drift_title: &'static str,
    pub drift_caption: &'static str,
    pub drift_line: &'static str,
    pub spin_axis: &'static str,
    pub spin: &'static str,
    pub precession_title: &'static str,
    pub precession_caption: &'static str,
    pub slow: &'static str,
    pub fast: &'static str,
    pub slow_root: &'static str,
    pub fast_root: &'static str,
    pub nutation_title: &'static str,
    pub nutation_caption: &'static str,
    pub let_go: &'static str,
    pub infinitesimal: &'static str,
    pub frequency: &'static str,
    pub let_go_head: &'static str,
    pub infinitesimal_head: &'static str,
}

impl Language {
    pub(in crate::report) fn chart_words(self) -> &'static ChartWords {
        match self {
            Language::English => &EN,
            Language::Japanese => &JA,
        }
    }
}

const EN: ChartWords = ChartWords {
    nutations: "nutations",
    relative_drift: "relative drift",
    relative_error: "relative error",
    error: "error",
    energy: "energy",
    drift_title: "Drift of the constants of the motion",
    drift_caption: "The top is set going at $\\theta = {theta}$ rad with a spin of ${spin}$ rad/s and a precession of ${kick}$ rad/s, so that its axis draws loops, and followed through {periods} nutations. $L_z$, the energy and $\\omega_\\zeta$ are constant by (52), (66) and (41); what is drawn is the largest relative drift so far of the numerical motion. Both methods take fixed steps and evaluate the equations of motion {evaluations} times a nutation: at the same cost, the drift of the energy is {drift} for {method} and {drift_2} for {method_2}.",
    drift_line: "{constant}, {method}",
    spin_axis: "spin Ω in rad/s",
    spin: "$\\Omega$ in rad/s",
    precession_title: "Slow and fast precession against the exact roots",
    precession_caption: "Relative error of the approximations (71) and (72), $mgl / (I_1 \\Omega)$ and $I_1 \\Omega / (I_0 \\cos \\theta)$, against the roots of (67) at $\\theta = {theta}$ rad. As the spin grows the errors fall with the measured orders {slow} (slow) and {fast} (fast).",
    slow: "slow, $mgl / (I_1 \\Omega)$",
    fast: "fast, $I_1 \\Omega / (I_0 \\cos \\theta)$",
    slow_root: "slow root",
    fast_root: "fast root",
    nutation_title: "Frequency of nutation against the exact motion",
    nutation_caption: "Relative error of the frequency $I_1 \\Omega / I_0$, (82), against the exact motion of a top let go at $\\theta = {theta}$ rad, and against an infinitesimal nutation about slow steady precession. As the spin grows the errors fall with the measured orders {let_go} and {small}.",
    let_go: "let go from rest",
    infinitesimal: "infinitesimal nutation",
    frequency: "$I_1 \\Omega / I_0$ in rad/s",
    let_go_head: "let go",
    infinitesimal_head: "infinitesimal",
};

const JA: ChartWords = ChartWords {
    nutations: "章動の回数",
    relative_drift: "相対ドリフト",
    relative_error: "相対誤差",
    error: "誤差",
    energy: "エネルギー",
    drift_title: "運動の積分のドリフト",
    drift_caption: "$\\theta = {theta}$ rad、スピン ${spin}$ rad/s、歳差 ${kick}$ rad/s で運動を始めさせ (軸の先は輪を描きます)、章動 {periods} 回分を追いました。$L_z$、エネルギー、$\\omega_\\zeta$ は (52)、(66)、(41) により一定です。図は、数値解の相対ドリフトのそれまでの最大値です。どちらの解法も固定刻みで、運動方程式を章動 1 回あたり {evaluations} 回評価します。同じ計算量で、エネルギーのドリフトは {method} では {drift}、{method_2} では {drift_2} です。",
    drift_line: "{constant}、{method}",
    spin_axis: "スピン Ω (rad/s)",
    spin: "$\\Omega$ (rad/s)",
    precession_title: "遅い歳差と速い歳差: 近似と厳密な根",
    precession_caption: "近似 (71)、(72) すなわち $mgl / (I_1 \\Omega)$ と $I_1 \\Omega / (I_0 \\cos \\theta)$ の、$\\theta = {theta}$ rad における (67) の根に対する相対誤差。スピンが大きくなるにつれて、誤差は実測の次数 {slow} (遅い歳差) と {fast} (速い歳差) で小さくなります。",
    slow: "遅い歳差、$mgl / (I_1 \\Omega)$",
    fast: "速い歳差、$I_1 \\Omega / (I_0 \\cos \\theta)$",
    slow_root: "遅い根",
    fast_root: "速い根",
    nutation_title: "章動の振動数: 近似と厳密な運動",
    nutation_caption: "振動数 $I_1 \\Omega / I_0$ (82) の相対誤差。$\\theta = {theta}$ rad で静かに放したこまの厳密な運動、および遅い定常歳差のまわりの無限小の章動と比べました。スピンが大きくなるにつれて、誤差は実測の次数 {let_go} と {small} で小さくなります。",
    let_go: "静かに放したこま",
    infinitesimal: "無限小の章動",
    frequency: "$I_1 \\Omega / I_0$ (rad/s)",
    let_go_head: "静かに放す",
    infinitesimal_head: "無限小",
};
