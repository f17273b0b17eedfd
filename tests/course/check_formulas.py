#!/usr/bin/env python3
"""Every formula of the three documents, retyped by hand and checked with SymPy: pip install sympy; python3 check_formulas.py

Independent of Kenzan: nothing here reads the documents. Each entry gives the differences (left side minus right side, of
every link) that must vanish once the premises are put in. They are evaluated at random points with 40 digits; what has an
integral or a series is done by SymPy first. What is a law or a definition is consistent with what is derived from it, or
is marked "by hand".
"""
import random

import sympy as sp
from sympy import Matrix, Rational, cos, cosh, diff, exp, integrate, oo, pi, series, sin, sinh, sqrt, tan, tanh

random.seed(1)
BY_HAND = "by hand"


def positive(names):
    return sp.symbols(names, positive=True)


def electromagnetism():
    e0, mu0, q1, q2, r, Q, p, th, A, d, C, U, q = positive("e0 mu0 q1 q2 r Q p theta A d C U q")
    R, t, U0, L, Q0, w, m, v, B, N, l, I, E0, k, z, s = positive("R t U0 L Q0 omega m v B N l I E0 k z sigma")
    c = 1 / sqrt(e0 * mu0)
    ke = 1 / (4 * pi * e0)
    yield 1, BY_HAND
    F = ke * q1 * q2 / r**2
    yield 2, [F / q2 - q1 / (4 * pi * e0 * r**2)]
    yield 3, [4 * pi * r**2 * (ke * Q / r**2) - Q / e0]
    rp = sp.Symbol("rp", positive=True)
    yield 4, [integrate(Q / (4 * pi * e0 * rp**2), (rp, r, oo)) - Q / (4 * pi * e0 * r)]
    # the dipole as the limit of two charges p/h and -p/h at +h/2 and -h/2 on the axis
    h = positive("h")
    two = ke * (p / h) * (1 / sqrt(r**2 - r * h * cos(th) + h**2 / 4) - 1 / sqrt(r**2 + r * h * cos(th) + h**2 / 4))
    dipole = p * cos(th) / (4 * pi * e0 * r**2)
    yield 5, [sp.limit(two, h, 0) - dipole]
    Er, Et = -diff(dipole, r), -diff(dipole, th) / r
    yield 6, [Er - 2 * p * cos(th) / (4 * pi * e0 * r**3), Et - p * sin(th) / (4 * pi * e0 * r**3)]
    yield 7, [Er**2 + Et**2 - (p / (4 * pi * e0 * r**3)) ** 2 * (1 + 3 * cos(th) ** 2)]
    E = Q / A / e0
    yield 8, [E - Q / (e0 * A), E * d - Q * d / (e0 * A)]
    Ucap = E * d
    yield 9, [Q / Ucap - e0 * A / d]
    Wc = integrate(q / C, (q, 0, Q))
    yield 10, [Wc - Q**2 / (2 * C), (Wc - C * U**2 / 2).subs(Q, C * U)]
    yield 11, [Wc.subs(C, e0 * A / d) / (A * d) - e0 * E**2 / 2]
    tau = R * C
    Qt = C * U0 * (1 - exp(-t / tau))
    yield 12, [R * diff(Qt, t) + Qt / C - U0]
    yield 13, [R * diff(Qt, t) + Qt / C - U0, Qt.subs(t, 0)]
    It = U0 / R * exp(-t / tau)
    yield 14, [diff(Qt, t) - It]
    heat = integrate(R * It**2, (t, 0, oo))
    yield 15, [heat - U0**2 / R * integrate(exp(-2 * t / tau), (t, 0, oo)), heat - C * U0**2 / 2]
    w0 = 1 / sqrt(L * C)
    Qo = Q0 * cos(w0 * t)
    yield 16, [L * diff(Qo, t, 2) + Qo / C]
    Io = -w0 * Q0 * sin(w0 * t)
    yield 17, [diff(Qo, t) - Io, Io.subs(t, 0), Qo.subs(t, 0) - Q0]
    yield 18, [L * Io**2 / 2 + Qo**2 / (2 * C) - Q0**2 / (2 * C)]
    g = R / (2 * L)
    wd = sqrt(w0**2 - g**2)
    Qd = exp(-g * t) * cos(wd * t)
    yield 19, [L * diff(Qd, t, 2) + R * diff(Qd, t) + Qd / C, wd - sqrt(1 / (L * C) - R**2 / (4 * L**2))]
    X = w * L - 1 / (w * C)
    z_complex = R + sp.I * w * L + 1 / (sp.I * w * C)
    yield 20, [sqrt(sp.re(z_complex) ** 2 + sp.im(z_complex) ** 2) - sqrt(R**2 + X**2)]
    yield 21, [sp.im(z_complex) / sp.re(z_complex) - X / R, X / R - L / (w * R) * (w**2 - w0**2)]
    yield 22, BY_HAND
    vv, BB, EE = (Matrix(sp.symbols(f"{x}1:4", real=True)) for x in "vBE")
    yield 23, [(q * (EE + vv.cross(BB))).dot(vv) - q * EE.dot(vv)]
    radius = m * v / (q * B)
    yield 24, [m * v**2 / radius - q * v * B, v / radius - q * B / m]
    yield 25, [-diff(B * A * cos(w * t), t) - w * B * A * sin(w * t)]
    Bs = mu0 * N * I / l
    yield 26, [N * Bs * A / I - mu0 * N**2 * A / l]
    yield 27, [(mu0 * N**2 * A / l) * I**2 / (2 * A * l) - Bs**2 / (2 * mu0)]
    kw = w / c
    Ex, By = E0 * cos(kw * z - w * t), E0 / c * cos(kw * z - w * t)
    yield 28, [diff(Ex, z) + diff(By, t), -diff(By, z) - diff(Ex, t) / c**2]
    S = Ex * By / mu0
    yield 29, [S - c * e0 * E0**2 * cos(kw * z - w * t) ** 2, S - c * (e0 * Ex**2 / 2 + By**2 / (2 * mu0))]
    ks = sqrt(mu0 * s * w / 2)
    group = 1 / diff(ks, w)
    kappa = (1 + sp.I) * ks  # E ~ exp(i kappa z - i omega t) in a conductor: kappa^2 = i mu0 sigma omega
    yield 30, [sp.expand(kappa**2) - sp.I * mu0 * s * w, ks - 1 / sqrt(2 / (mu0 * s * w)), group - 4 * ks / (mu0 * s), group - 2 * w / ks]


def relativity():
    c, x, t, m, E1, th, al, M, a = positive("c x t m E1 theta alpha M a")
    b = sp.Symbol("beta", positive=True)  # drawn below 1
    ub = sp.Symbol("ub", positive=True)
    v, up = b * c, ub * c
    gamma = lambda u: 1 / sqrt(1 - u**2 / c**2)
    g = gamma(v)
    yield "eq:gamma", [g - 1 / sqrt(1 - b**2)]
    yield "eq:gammabeta", [g**2 * b**2 - (g**2 - 1), b - sqrt(1 - 1 / g**2)]
    xp, tp = g * (x - v * t), g * (t - v * x / c**2)
    # light in both directions stays light, the origin of S' moves with v, and the determinant is one
    yield "eq:lorentz", [xp.subs(x, c * t) - c * tp.subs(x, c * t), xp.subs(x, -c * t) + c * tp.subs(x, -c * t), xp.subs(x, v * t),
                         Matrix([xp, c * tp]).jacobian([x, t]).det() / c - 1]
    yield "eq:inverse", [g * (xp + v * tp) - x, g * (tp + v * xp / c**2) - t]
    yield "eq:interval", [c**2 * t**2 - x**2 - (c**2 * tp**2 - xp**2)]
    # the rod: ends at x' = 0 and x' = l0, both seen at t = 0
    yield "eq:dilation", [g * (t + 0) - t / sqrt(1 - b**2), xp.subs({t: 0, x: x / g}) - x, x / g - x * sqrt(1 - v**2 / c**2)]
    u = (up + v) / (1 + up * v / c**2)
    yield "eq:addition", [(g * (up * t + v * t)) / (g * (t + v * up * t / c**2)) - u]
    yield "eq:below", [1 - u**2 / c**2 - (1 - up**2 / c**2) * (1 - v**2 / c**2) / (1 + up * v / c**2) ** 2]
    yield "eq:gammas", [gamma(u) - g * gamma(up) * (1 + up * v / c**2)]
    # source: pulses at the proper times 0 and t leave at gamma t, v gamma t, and arrive later by the distance over c
    yield "eq:doppler", [1 / (g * t + v * g * t / c) - sqrt((1 - b) / (1 + b)) / t, 1 / (g * (1 + b)) - sqrt((1 - b) / (1 + b))]
    yield "eq:dopplersmall", [series(sqrt((1 - b) / (1 + b)), b, 0, 3).removeO() - (1 - b + b**2 / 2)]
    # a ray (c cos, c sin) in S: its velocity in S' by the addition of -v
    cx = (c * cos(al) - v) / (1 - v * cos(al) / c) / c
    sx = c * sin(al) / (g * (1 - v * cos(al) / c)) / c
    ca, sa = (cos(al) - b) / (1 - b * cos(al)), sin(al) / (g * (1 - b * cos(al)))
    yield "eq:aberration", [cx - ca, sx - sa, ca**2 + sa**2 - 1]
    yield "eq:halfangle", [tan(sp.acos(ca) / 2) - sa / (1 + ca), sa / (1 + ca) - sqrt((1 + b) / (1 - b)) * tan(al / 2)]
    eta = sp.atanh(b)
    yield "eq:hyperbolic", [cosh(eta) - g, sinh(eta) - g * b, exp(eta) - g * (1 + b), exp(eta) - sqrt((1 + b) / (1 - b))]
    boost = Matrix([[cosh(eta), -sinh(eta)], [-sinh(eta), cosh(eta)]]) * Matrix([c * t, x])
    yield "eq:boost", [boost[0] - c * tp, boost[1] - xp]
    n1, n2 = positive("eta1 eta2")
    yield "eq:tanhsum", [tanh(n1 + n2) - (tanh(n1) + tanh(n2)) / (1 + tanh(n1) * tanh(n2))]
    p, E = g * m * v, g * m * c**2
    yield "eq:momentum", BY_HAND
    yield "eq:shell", [E**2 - p**2 * c**2 - m**2 * c**4]
    P = positive("P")
    yield "eq:velocity", [v - p * c**2 / E, diff(sqrt(P**2 * c**2 + m**2 * c**4), P).subs(P, p) - v]
    T = E - m * c**2
    yield "eq:kinetic", [T - (g - 1) * m * c**2]
    V = positive("V")
    ser = series(1 / sqrt(1 - V**2 / c**2) - 1, V, 0, 6).removeO() * m * c**2
    yield "eq:kineticsmall", [ser - (m * V**2 / 2 + Rational(3, 8) * m * V**4 / c**2)]
    yield "eq:pofT", [p * c - sqrt(E**2 - m**2 * c**4), p * c - sqrt(T**2 + 2 * T * m * c**2)]
    # another particle in S with velocity up; from S' it has the velocity w
    pu, Eu = gamma(up) * m * up, gamma(up) * m * c**2
    w = (up - v) / (1 - up * v / c**2)
    Ep, pp = g * (Eu - v * pu), g * (pu - v * Eu / c**2)
    yield "eq:fourmomentum", [gamma(w) * m * c**2 - Ep, gamma(w) * m * w - pp]
    yield "eq:invariant", [Ep**2 - pp**2 * c**2 - (Eu**2 - pu**2 * c**2)]
    E2 = 1 / (1 / E1 + (1 - cos(th)) / (m * c**2))
    pe2 = (E1 - E2 * cos(th)) ** 2 + (E2 * sin(th)) ** 2
    yield "eq:electron", [pe2 + m**2 * c**4 - (E1**2 + E2**2 - 2 * E1 * E2 * cos(th) + m**2 * c**4), (E1 - E2 + m * c**2) ** 2 - (pe2 + m**2 * c**4)]
    e2 = positive("e2")
    found = sp.solve((E1 - e2 + m * c**2) ** 2 - (E1**2 + e2**2 - 2 * E1 * e2 * cos(th) + m**2 * c**4), e2)
    yield "eq:comptonenergy", [1 / f - 1 / E1 - (1 - cos(th)) / (m * c**2) for f in found]
    h = positive("h")
    shift = h * c / E2 - h * c / E1
    yield "eq:compton", [shift - h / (m * c) * (1 - cos(th)), shift - 2 * h / (m * c) * sin(th / 2) ** 2]
    yield "eq:cms", [(E + m * c**2) ** 2 - p**2 * c**2 - 2 * m * c**2 * (E + m * c**2)]
    Tth = (2 * m + M) ** 2 * c**4 / (2 * m * c**2) - 2 * m * c**2
    yield "eq:threshold", [2 * m * c**2 * (Tth + 2 * m * c**2) - ((2 * m + M) * c**2) ** 2, Tth - 2 * M * c**2 * (1 + M / (4 * m))]
    vr = a * t / sqrt(1 + (a * t / c) ** 2)
    xr = c**2 / a * (sqrt(1 + (a * t / c) ** 2) - 1)
    yield "eq:rocket", [gamma(vr) * m * vr - m * a * t, diff(xr, t) - vr, xr.subs(t, 0)]


def linear_algebra():
    a, b, c, d, lam, p, q, r, x, y, f, al, be = sp.symbols("a b c d lambda p q r x y varphi alpha beta", real=True)
    A = Matrix([[a, b], [c, d]])
    one = sp.eye(2)
    det, tr = a * d - b * c, a + d
    yield "eq-matrix", BY_HAND
    yield "eq-dettr", [A.det() - det, A.trace() - tr]
    yield "eq-inverse", list(A.inv() - Matrix([[d, -b], [-c, a]]) / det)
    yield "eq-product", list(A * Matrix([[d, -b], [-c, a]]) - det * one)
    yield "eq-charpoly", [(A - lam * one).det() - (lam**2 - tr * lam + det)]
    root = sqrt(((a - d) / 2) ** 2 + b * c)
    l1, l2 = tr / 2 + root, tr / 2 - root
    yield "eq-eigenvalues", [(A - l * one).det() for l in (l1, l2)]
    yield "eq-sumproduct", [l1 + l2 - tr, l1 * l2 - det]
    yield "eq-discriminant", [(l1 - l2) ** 2 - (tr**2 - 4 * det), tr**2 - 4 * det - ((a - d) ** 2 + 4 * b * c)]
    yield "eq-cayley", list(A**2 - tr * A + det * one)
    yield "eq-cube", list(A**3 - (tr**2 - det) * A + tr * det * one)
    rot = lambda w: Matrix([[cos(w), -sin(w)], [sin(w), cos(w)]])
    yield "eq-rotation", list(rot(f) * Matrix([1, 0]) - Matrix([cos(f), sin(f)])) + list(rot(f) * Matrix([0, 1]) - Matrix([-sin(f), cos(f)]))
    yield "eq-addition", list(rot(al) * rot(be) - rot(al + be))
    S = Matrix([[p, q], [q, r]])
    X = Matrix([x, y])
    form = (X.T * S * X)[0]
    yield "eq-quadratic", [form - (p * x**2 + 2 * q * x * y + r * y**2)]
    yield "eq-square", [form - (p * (x + q / p * y) ** 2 + (p * r - q**2) / p * y**2)]
    Sn = rot(f).T * S * rot(f)
    new = Matrix([[p * cos(f) ** 2 + 2 * q * sin(f) * cos(f) + r * sin(f) ** 2, q * cos(2 * f) - (p - r) / 2 * sin(2 * f)],
                  [q * cos(2 * f) - (p - r) / 2 * sin(2 * f), p * sin(f) ** 2 - 2 * q * sin(f) * cos(f) + r * cos(f) ** 2]])
    yield "eq-newcoefficients", list(Sn - new)
    yield "eq-invariants", [Sn.trace() - p - r, Sn.det() - (p * r - q**2)]
    main = sp.atan(2 * q / (p - r)) / 2
    yield "eq-axes", [Sn[0, 1].subs(f, main)]
    B = Matrix(3, 3, sp.symbols("a1 b1 c1 a2 b2 c2 a3 b3 c3"))
    (a1, b1, c1, a2, b2, c2, a3, b3, c3) = B
    yield "eq-sarrus", [B.det() - (a1 * b2 * c3 + a2 * b3 * c1 + a3 * b1 * c2 - a1 * b3 * c2 - a2 * b1 * c3 - a3 * b2 * c1)]
    va, vb, vc = (Matrix(sp.symbols(f"{w}1:4", real=True)) for w in "abc")
    yield "eq-triple", [va.dot(vb.cross(vc)) - vb.dot(vc.cross(va)), va.dot(vb.cross(vc)) + vb.dot(va.cross(vc))]
    yield "eq-bac", list(va.cross(vb.cross(vc)) - (va.dot(vc) * vb - va.dot(vb) * vc))
    sq = lambda w: w.dot(w)
    yield "eq-lagrange", [sq(va.cross(vb)) - (sq(va) * sq(vb) - va.dot(vb) ** 2)]
    th = sp.acos(va.dot(vb) / sqrt(sq(va) * sq(vb)))
    yield "eq-cosine", [sqrt(sq(va.cross(vb))) - sqrt(sq(va) * sq(vb)) * sin(th), sq(va - vb) - (sq(va) + sq(vb) - 2 * sqrt(sq(va) * sq(vb)) * cos(th))]
    vn = Matrix([sin(al) * cos(be), sin(al) * sin(be), cos(al)])
    yield "eq-split", list(va - (vn.dot(va) * vn + vn.cross(va.cross(vn)))) + [sq(vn) - 1]
    K = Matrix([[0, -vn[2], vn[1]], [vn[2], 0, -vn[0]], [-vn[1], vn[0], 0]])
    turned = va * cos(f) + vn.cross(va) * sin(f) + vn.dot(va) * (1 - cos(f)) * vn
    yield "eq-rodrigues", list((sp.eye(3) + sin(f) * K + (1 - cos(f)) * K * K) * va - turned)
    yield "eq-length", [sq(turned) - sq(va), vn.dot(turned) - vn.dot(va)]
    u2 = vb - va.dot(vb) / sq(va) * va
    yield "eq-gramschmidt", [va.dot(u2)]
    yield "eq-orthogonal", [va.dot(u2), sq(u2) - (sq(vb) - va.dot(vb) ** 2 / sq(va))]
    xs, ys = sp.symbols("x1:5", real=True), sp.symbols("y1:5", real=True)
    k, h = sp.symbols("k h", real=True)
    n = len(xs)
    sx, sy, sxx = sum(xs), sum(ys), sum(w**2 for w in xs)
    sxy = sum(w * z for w, z in zip(xs, ys))
    error = sum((k * w + h - z) ** 2 for w, z in zip(xs, ys))
    yield "eq-normal", [diff(error, k) / 2 - (k * sxx + h * sx - sxy), diff(error, h) / 2 - (k * sx + n * h - sy)]
    slope = (n * sxy - sx * sy) / (n * sxx - sx**2)
    inter = (sxx * sy - sx * sxy) / (n * sxx - sx**2)
    at = {k: slope, h: inter}
    yield "eq-slope", [diff(error, k).subs(at), diff(error, h).subs(at)]
    yield "eq-intercept", [diff(error, h).subs(at), inter - (sy / n - slope * sx / n)]


def vanishes(residual):
    """At five random points, with 40 digits."""
    residual = sp.sympify(residual)
    free = sorted(residual.free_symbols, key=str)
    for _ in range(5 if free else 1):
        point = dict(zip(free, (Rational(k, 100) for k in random.sample(range(11, 90), len(free)))))
        if abs(sp.N(residual.subs(point), 40)) > sp.Float("1e-30"):
            return False
    return True


def main():
    bad = 0
    for name, document in (("electromagnetism", electromagnetism), ("relativity", relativity), ("linear-algebra", linear_algebra)):
        seen = {"by hand": 0, "checked": 0}
        for label, residuals in document():
            if residuals == BY_HAND:
                seen["by hand"] += 1
                continue
            seen["checked"] += 1
            for i, residual in enumerate(residuals):
                if not vanishes(residual):
                    bad += 1
                    print(f"{name} {label}: difference {i + 1} does not vanish")
        print(f"{name}: {seen['checked']} checked with SymPy, {seen['by hand']} by hand")
    raise SystemExit(1 if bad else 0)


if __name__ == "__main__":
    main()
