//! What each construct reads as.

use super::read;

/// Each source with its tree.
fn check(cases: &[(&str, &str)]) {
    for (source, tree) in cases {
        assert_eq!(read(source), *tree, "{source}");
    }
}

#[test]
fn letters_and_numbers() {
    check(&[
        ("", "()"),
        ("  % nothing", "()"),
        ("x", "x"),
        ("\\theta", "\\theta"),
        ("0.0173", "0.0173"),
        ("6\\,378\\,137", "6378137"),
        ("1{,}000", "1000"),
        ("2x", "(j 2 x)"),
        ("2.5x.", "(j 2.5 x)"),
        ("mgl", "(j m g l)"),
        ("const.", "\"const\""),
        ("質量 x", "(j \"質量\" x)"),
        ("0.''2", "(s 0.2'')"),
        ("17''3", "(s 17.3'')"),
        ("23^\\circ.5", "(s 23.5 ^\\circ)"),
        ("30^{\\circ} 5'", "(j (s 30 ^\\circ) (s 5'))"),
    ]);
}

#[test]
fn precedence() {
    check(&[
        ("a + b c \\cdot d", "(+ a Plus:(p (j b c) Dot d))"),
        ("-a - b", "(+ Minus:a Minus:b)"),
        ("a \\pm \\frac{b}{2} \\mp c", "(+ a PlusMinus:(/ b 2) MinusPlus:c)"),
        ("a \\times b \\wedge c / d", "(p a Cross b Wedge c Slash d)"),
        ("a = b < c \\leqq d", "(c a Eq b Lt c Le d)"),
        ("= a", "(c - Eq a)"),
        ("a =", "(c a Eq ())"),
        ("a \\Rightarrow = b", "(c a Implies () Eq b)"),
        ("a, b; c", "(list a b c)"),
        ("a - -b", "(+ a Minus:(+ Minus:b))"),
        ("2 \\times -3", "(p 2 Cross (+ Minus:3))"),
        ("\\therefore x = 1", "(Therefore (c x Eq 1))"),
        ("x = 1 \\because y", "(list (c x Eq 1) (Because y))"),
        ("x \\overset{\\text{def}}{=} y", "(c x Equiv y)"),
        ("x := y", "(c x Equiv y)"),
        ("x \\not= y", "(c x Ne y)"),
        ("n_x : n_\\ell \\sim 2:3", "(c (s n _x) Ratio (s n _\\ell) Sim 2 Ratio 3)"),
    ]);
}

#[test]
fn scripts() {
    check(&[
        ("y''", "(s y'')"),
        ("L'_\\xi", "(s L' _\\xi)"),
        ("\\mathbf{r}_i'^2", "(s (Bold r)' _i ^2)"),
        ("x^{\\prime}", "(s x')"),
        ("x^{\\prime 2}", "(s x' ^2)"),
        ("x^{\\prime\\prime}_a", "(s x'' _a)"),
        ("x^12", "(j (s x ^1) 2)"),
        ("x^{12}", "(s x ^12)"),
        ("F^*_0", "(s F _0 ^*)"),
        ("\\alpha_-", "(s \\alpha _-)"),
        ("x_{0+}", "(s x _(+ 0 Plus:()))"),
        ("{}_nC_2", "(j (s () _n) (s C _2))"),
        ("_nC_2", "(j (s () _n) (s C _2))"),
        ("e_{z\\max}^2", "(s e _(j z @max) ^2)"),
        ("\\sum_{i=1}^n x_i", "(j (s @Sum _(c i Eq 1) ^n) (s x _i))"),
        ("\\sum_{\\substack{i \\\\ j}} x", "(j (s @Sum _(list i j)) x)"),
        ("\\sin^2\\theta", "(j (s @sin ^2) \\theta)"),
        ("n!", "(! n)"),
        ("(n+m-1)!!", "(!! [Paren (+ n Plus:m Minus:1)])"),
        ("e^{i\\lambda}", "(s e ^(j i \\lambda))"),
        ("x^\\frac12", "(s x ^(/ 1 2))"),
        ("\\dot{\\mathbf r}_G", "(s (· (Bold r)) _G)"),
        ("\\ddot{\\vec{r}}", "(·· (Vector r))"),
    ]);
}

#[test]
fn functions_and_fonts() {
    check(&[
        ("\\sin\\theta\\cos\\psi", "(j @sin \\theta @cos \\psi)"),
        ("\\operatorname{sn}^2 u", "(j (s @sn ^2) u)"),
        ("\\mathrm{sn}u", "(j @sn u)"),
        ("\\mathrm{d}x", "(j (Roman d) x)"),
        ("\\mathrm{const}", "@const"),
        ("{\\rm d}x", "(j (Roman d) x)"),
        ("{\\bf r}", "(Bold r)"),
        ("\\mathbf{0}", "(Bold 0)"),
        ("\\mathbf{AB}", "(Bold (j A B))"),
        ("\\text{const.}", "\"const.\""),
        ("\\text{sn}u", "(j \"sn\" u)"),
        ("\\overrightarrow{O_1A}", "(Vector (j (s O _1) A))"),
        ("\\underline{x}", "(Other x)"),
        ("\\binom{n}{k}", "(j @binom [Paren (list n k)])"),
    ]);
}

#[test]
fn fractions_and_roots() {
    check(&[
        ("\\frac12", "(/ 1 2)"),
        ("\\frac{d}{dt}x", "(j (/ d (j d t)) x)"),
        ("\\dfrac{a}{b}", "(/ a b)"),
        ("{a + 1 \\over b}", "(/ (+ a Plus:1) b)"),
        ("\\sqrt[3]{x}", "(root 3 x)"),
        ("\\sqrt 2", "(root 2)"),
        ("\\sqrt{a^2 - b}", "(root (+ (s a ^2) Minus:b))"),
        ("{ab}c", "(j a b c)"),
    ]);
}

#[test]
fn delimiters() {
    check(&[
        ("(a + b)", "[Paren (+ a Plus:b)]"),
        ("\\left\\{a\\right\\}_\\xi", "(s [Brace a] _\\xi)"),
        ("\\langle F\\rangle_\\tau", "(s [Angle F] _\\tau)"),
        ("[0, 1)", "[Bracket-Paren (list 0 1)]"),
        ("(= C)", "[Paren (c - Eq C)]"),
        ("(\\quad)", "[Paren ()]"),
        ("(*)", "[Paren *]"),
        ("\\bigl( a \\bigr)", "[Paren a]"),
        ("|x|", "[Bar x]"),
        ("|a||b|", "(j [Bar a] [Bar b])"),
        ("||a| - |b||", "[Bar (+ [Bar a] Minus:[Bar b])]"),
        ("m|a|^2", "(j m (s [Bar a] ^2))"),
        ("\\left|a\\right|", "[Bar a]"),
        ("\\|a\\|", "[DoubleBar a]"),
        ("\\langle a | b\\rangle", "[Angle (list a b)]"),
        ("\\lfloor x\\rfloor", "[Floor x]"),
        ("\\left. a \\right\\}", "[None-Brace a]"),
    ]);
}

#[test]
fn evaluation() {
    check(&[
        ("F|_{x=0}", "(at F (c x Eq 0))"),
        ("\\left. F \\right|_{x=0}", "(at F (c x Eq 0))"),
        ("\\frac12 v^2 \\Big|_0^t", "(at (j (/ 1 2) (s v ^2)) (s () _0 ^t))"),
        ("a - b c\\Big|_0 d", "(+ a Minus:(j (at (j b c) 0) d))"),
        ("(\\quad)|_{1 \\leftrightarrow 2} \\times c", "(p (at [Paren ()] (c 1 Exchange 2)) Cross c)"),
    ]);
}

#[test]
fn environments() {
    check(&[
        ("\\begin{pmatrix} a & b \\\\ c & \\end{pmatrix}", "(Matrix a b ; c ())"),
        ("\\begin{vmatrix} a \\\\ b \\\\ \\end{vmatrix}", "(Determinant a ; b)"),
        ("\\begin{array}{c|c} a & b \\\\ \\hline c & d \\end{array}", "(Array a b ; c d)"),
        (
            "x = \\begin{cases} 0 & n - m = \\text{odd} \\\\ 1 & \\text{else} \\end{cases}",
            "(c x Eq (Cases 0 (c (+ n Minus:m) Eq \"odd\") ; 1 \"else\"))",
        ),
    ]);
}

#[test]
fn rows() {
    check(&[
        ("a \\\\[2mm] b", "(rows a b)"),
        ("\\begin{aligned} a &= b \\\\ &= c \\end{aligned}", "(rows (c a Eq b) (c - Eq c))"),
        ("\\begin{aligned} a &= b \\end{aligned}", "(c a Eq b)"),
        ("\\begin{align*} a &= b \\nonumber \\\\ \\end{align*}", "(c a Eq b)"),
        ("\\begin{aligned} a &= b \\\\ &\\quad + (c) \\end{aligned}", "(c a Eq (+ b Plus:[Paren c]))"),
        ("\\begin{aligned} a &= b \\\\ &\\times c = d \\end{aligned}", "(c a Eq (p b Cross c) Eq d)"),
        ("\\begin{aligned} a &= b \\\\ -c &= d \\end{aligned}", "(rows (c a Eq b) (c (+ Minus:c) Eq d))"),
        ("\\begin{aligned} a &= b \\\\ - c \\end{aligned}", "(c a Eq (+ b Minus:c))"),
        ("a = b \\\\ \\pm c = 0", "(c a Eq (+ b PlusMinus:c) Eq 0)"),
        ("a = b \\\\ - c = 0", "(rows (c a Eq b) (c (+ Minus:c) Eq 0))"),
        ("a &= b + \\\\ &\\quad c", "(c a Eq (+ b Plus:c))"),
        ("a = \\\\ b", "(c a Eq b)"),
        ("a = F^* \\\\ b = c", "(rows (c a Eq (s F ^*)) (c b Eq c))"),
        ("a \\Rightarrow \\\\ = b", "(rows (c a Implies ()) (c - Eq b))"),
        ("a = ( b \\\\ & = c )", "(c a Eq [Paren (c b Eq c)])"),
        ("\\begin{aligned} a &= b & c &= d \\end{aligned}", "(list (c a Eq b) (c c Eq d))"),
        (
            "\\left. \\begin{aligned} a &= b \\\\ c &= d \\end{aligned} \\right\\}",
            "[None-Brace (rows (c a Eq b) (c c Eq d))]",
        ),
    ]);
}

#[test]
fn delimiters_broken_over_rows() {
    check(&[
        (
            "\\begin{aligned} a &= \\left[ b \\right. \\\\ &\\quad \\left. + c \\right] \\end{aligned}",
            "(c a Eq [Bracket (+ b Plus:c)])",
        ),
        (
            "\\begin{aligned} a &= \\left[ b \\right. \\\\ & - d \\\\ & \\left. + c \\right] + e \\end{aligned}",
            "(c a Eq (+ [Bracket (+ b Minus:d Plus:c)] Plus:e))",
        ),
        (
            "a = \\left\\{ p \\left[ b \\right. \\right. \\\\ \\left. \\left. + c \\right] \\right. \\\\ \\left. + e \\right\\}",
            "(c a Eq [Brace (+ (j p [Bracket (+ b Plus:c)]) Plus:e)])",
        ),
        (
            "\\left\\{ \\begin{array}{l} a \\\\ b \\end{array} \\right. \\\\ \\left. c \\right\\}",
            "(rows [Brace-None (Array a ; b)] [None-Brace c])",
        ),
    ]);
}

#[test]
fn wide_spaces_and_texts() {
    check(&[
        ("x = 1 \\quad y = 2", "(list (c x Eq 1) (c y Eq 2))"),
        ("x = 1, \\quad y = 2", "(list (c x Eq 1) (c y Eq 2))"),
        ("x = 0 \\quad \\text{定義}", "(c x Eq (j 0 \"定義\"))"),
        ("a \\geq b \\quad \\text{i.e.} \\quad c \\geq d", "(list (c a Ge (j b \"i.e.\")) (c c Ge d))"),
        ("a = b \\quad \\Rightarrow \\quad c", "(c a Eq b Implies c)"),
        ("a = b \\quad (52)", "(list (c a Eq b) [Paren 52])"),
        ("\\text{これから, } \\quad a = b", "(c (j \"これから, \" a) Eq b)"),
        ("a = 0 \\text{ for } b = 0", "(list (c a Eq (j 0 \" for \")) (c b Eq 0))"),
        ("a = 0 \\text{ or } b", "(c a Eq (j 0 \" or \" b))"),
        ("(k \\text{だから } a = b)", "[Paren (list (j k \"だから \") (c a Eq b))]"),
        ("\\text{vec}f", "(j \"vec\" f)"),
    ]);
}

#[test]
fn annotations() {
    check(&[
        ("\\underbrace{a + b}_{=0} c", "(j (under (+ a Plus:b) (c - Eq 0)) c)"),
        ("\\overbrace{D}^{n}", "(over D n)"),
        ("\\underbrace{a}_{n}^2", "(s (under a n) ^2)"),
        ("\\underset{x \\to 0}{\\lim} f", "(j (under @lim (c x To 0)) f)"),
        ("a + \\dots + b", "(+ a Plus:... Plus:b)"),
        ("a \\tag{5} \\label{x}", "a"),
        ("a \\, b \\; c \\! \\hspace{1cm} d ~ e", "(j a b c d e)"),
    ]);
}
