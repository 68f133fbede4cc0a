#!/usr/bin/env python3
"""Makes arch_critical_locus.csv: cusp, meeting of fold and bifurcation, and folds of a crown-loaded arch.

The arch is circular and pinned at both ends, with R = 100, half angle 10 degrees and EA = 420; EI is the second
parameter. Its half is the boundary value problem of an extensible, shear-rigid beam (Reissner 1972),

  x' = (1 + e) cos t,  y' = (1 + e) sin t,  t' = -1/R + M / EI,  M' = y' a - x' b,  e = (a cos t + b sin t) / EA,

with the constant section force (a, b), b = -P/2. It is solved by collocation at Chebyshev points of one polynomial
and Newton's method. With the drop of the crown prescribed, P is a smooth function of drop and EI; its polynomial
interpolant in both gives
  cusp: dP/dw = d2P/dw2 = 0;  fold at an EI: dP/dw = 0;
  fold_bifurcation: dP/dw = 0 and a motion that is antisymmetric about the crown without stiffness.
Each quantity is solved with two degrees and two windows; the largest difference is printed.
The program shares no code with the solver. Needs numpy. Run: python3 arch_critical_locus.py > arch_critical_locus.csv
"""
import sys

import numpy as np
from numpy.polynomial import chebyshev as cheb

R, HALF, EA = 100.0, np.radians(10.0), 420.0
S = R * HALF


def integration(n):
    """Chebyshev-Lobatto points on [0, S] and the matrix of integrals from 0 to each point."""
    k = np.arange(n + 1)
    points = -np.cos(np.pi * k / n)
    columns = []
    for i in range(n + 1):
        values = np.zeros(n + 1)
        values[i] = 1.0
        c = cheb.chebint(cheb.chebfit(points, values, n), lbnd=-1.0)
        columns.append(cheb.chebval(points, c) * S / 2)
    return (points + 1) * S / 2, np.array(columns).T


class Half:
    """Half of the arch by collocation: unknowns t and M at the points, and the section force (a, b)."""

    def __init__(self, n):
        self.s, self.Q = integration(n)
        self.n = n + 1
        self.guess = None

    def fields(self, z, EI):
        m = self.n
        t, M, a, b = z[:m], z[m:2 * m], z[2 * m], z[2 * m + 1]
        c, s = np.cos(t), np.sin(t)
        e = (a * c + b * s) / EA
        return t, M, a, b, c, s, e

    def equations(self, z, EI, drop):
        m, Q = self.n, self.Q
        t, M, a, b, c, s, e = self.fields(z, EI)
        x1, y1 = (1 + e) * c, (1 + e) * s
        # derivatives of x' and y' by t, a, b
        et = (-a * s + b * c) / EA
        x1t, y1t = et * c - (1 + e) * s, et * s + (1 + e) * c
        x1a, x1b, y1a, y1b = c * c / EA, s * c / EA, s * c / EA, s * s / EA
        F = np.empty(2 * m + 2)
        J = np.zeros((2 * m + 2, 2 * m + 2))
        eye = np.eye(m)
        # the slope at the crown is zero: t(s) = t(S) + integral from S, with t(S) = 0
        W = Q - Q[-1]
        F[:m] = t - W @ (M / EI - 1 / R)
        J[:m, :m], J[:m, m:2 * m] = eye, -W / EI
        F[m:2 * m] = M - Q @ (y1 * a - x1 * b)
        J[m:2 * m, :m] = -Q * (y1t * a - x1t * b)
        J[m:2 * m, m:2 * m] = eye
        J[m:2 * m, 2 * m] = -Q @ (y1 + y1a * a - x1a * b)
        J[m:2 * m, 2 * m + 1] = -Q @ (y1b * a - x1 - x1b * b)
        q = Q[-1]
        F[2 * m] = q @ x1 - R * np.sin(HALF)
        F[2 * m + 1] = q @ y1 - (R * (1 - np.cos(HALF)) - drop)
        J[2 * m, :m], J[2 * m, 2 * m], J[2 * m, 2 * m + 1] = q * x1t, q @ x1a, q @ x1b
        J[2 * m + 1, :m], J[2 * m + 1, 2 * m], J[2 * m + 1, 2 * m + 1] = q * y1t, q @ y1a, q @ y1b
        return F, J

    def solve(self, EI, drop):
        z, last = self.guess or (np.concatenate([HALF - self.s / R, np.zeros(self.n + 2)]), (EI, 0.0))
        parts = 1 + int(abs(drop - last[1]) / 0.03) + int(abs(EI - last[0]) / (0.05 * EI))
        for i in range(1, parts + 1):
            part = i / parts
            z = self.newton(z, last[0] + part * (EI - last[0]), last[1] + part * (drop - last[1]))
        self.guess = z, (EI, drop)
        return z

    def newton(self, z, EI, drop):
        scale = np.concatenate([np.ones(self.n), np.full(self.n, 0.01 * EI), [EA * 1e-3] * 2])
        for _ in range(60):
            F, J = self.equations(z, EI, drop)
            d = np.linalg.solve(J * scale, F)
            z = z - scale * d
            if np.abs(d).max() < 1e-14:
                return z
        if np.abs(d).max() < 1e-10:
            return z
        raise RuntimeError(f"Newton's method does not converge at {EI}, {drop}: {np.abs(d).max():.1e}")

    def load(self, EI, drop):
        return -2.0 * self.solve(EI, drop)[2 * self.n + 1]

    def antisymmetric(self, EI, drop):
        """Determinant over that of the unloaded arch, for motions with da = 0, dM(S) = 0, dy(S) = 0."""
        loaded = self.antisymmetric_matrix(EI, drop)
        return np.linalg.det(np.linalg.solve(self.antisymmetric_matrix(EI, 0.0), loaded))

    def antisymmetric_matrix(self, EI, drop):
        m, Q = self.n, self.Q
        z = self.solve(EI, drop)
        _, J = self.equations(z, EI, drop)
        A = np.zeros((2 * m + 1, 2 * m + 1))
        # dt = dt(S) + integral from S: the row of the crown frees dt(S) and asks for dM(S) = 0 in its place
        A[:2 * m, :2 * m], A[:2 * m, 2 * m] = J[:2 * m, :2 * m], J[:2 * m, 2 * m + 1]
        A[m - 1, :] = 0.0
        A[m - 1, 2 * m - 1] = 1.0 / EI
        A[:m - 1, m - 1] -= 1.0
        A[2 * m, :2 * m], A[2 * m, 2 * m] = J[2 * m + 1, :2 * m], J[2 * m + 1, 2 * m + 1]
        return A


def interpolant(f, EIs, drops, p, q):
    """Coefficients of the polynomial of degrees p in EI and q in the drop, in coordinates from -1 to 1."""
    u = np.cos(np.pi * (np.arange(p + 1) + 0.5) / (p + 1))
    v = np.cos(np.pi * (np.arange(q + 1) + 0.5) / (q + 1))
    at = lambda x, r: 0.5 * (r[0] + r[1]) + 0.5 * (r[1] - r[0]) * x
    F = np.array([[f(at(a, EIs), at(b, drops)) for b in v] for a in u])
    U, V = cheb.chebvander(u, p), cheb.chebvander(v, q)
    return np.linalg.solve(U, np.linalg.solve(V, F.T).T)


def zero_of(functions, start):
    """Newton's method on two bivariate Chebyshev series."""
    x = np.array(start, float)
    for _ in range(60):
        value = np.array([cheb.chebval2d(x[0], x[1], c) for c in functions])
        slope = np.array([[cheb.chebval2d(x[0], x[1], cheb.chebder(c, axis=i)) for i in (0, 1)] for c in functions])
        d = np.linalg.solve(slope, value)
        x -= np.clip(d, -0.3, 0.3)
        if np.abs(d).max() < 1e-14:
            break
    return x


def special(half, kind, EI0, w0, dEI, dw, p, q):
    EIs, drops = (EI0 - dEI, EI0 + dEI), (w0 - dw, w0 + dw)
    P = interpolant(half.load, EIs, drops, p, q)
    slope = cheb.chebder(P, axis=1)
    other = (cheb.chebder(slope, axis=1) if kind == "cusp"
             else interpolant(half.antisymmetric, EIs, drops, p, q))
    u, v = zero_of([slope, other], [0.0, 0.0])
    return np.array([EI0 + u * dEI, cheb.chebval2d(u, v, P), w0 + v * dw])


def folds(half, EI, top):
    """(drop, P) of the extrema of P over the drop, from pieces of Chebyshev polynomials."""
    found = []
    pieces = np.linspace(1e-3 * top, top, 9)
    for lo, hi in zip(pieces[:-1], pieces[1:]):
        series = cheb.Chebyshev.interpolate(
            lambda w: np.array([half.load(EI, x) for x in np.atleast_1d(w)]), 18, [lo, hi])
        for root in series.deriv().roots():
            if abs(root.imag) < 1e-9 and lo <= root.real < hi:
                found.append((root.real, series(root.real)))
    return found


def main():
    rise = R * (1 - np.cos(HALF))
    rows, worst = [], 0.0
    halves = [Half(24), Half(32)]
    # guesses of the special points: EI and drop, and the half widths of the window around them
    for kind, EI0, w0, dEI, dw in (("cusp", 252.0, 1.6, 8.0, 0.2),
                                   ("fold_bifurcation", 37.0, 0.86, 4.0, 0.1),
                                   ("fold_bifurcation", 45.0, 2.42, 4.0, 0.1)):
        answers = []
        for half, shrink, p, q in ((halves[0], 1.0, 9, 14), (halves[1], 0.7, 8, 12), (halves[1], 0.5, 8, 12)):
            answers.append(special(half, kind, EI0, w0, shrink * dEI, shrink * dw, p, q))
        answers = np.array(answers)
        worst = max(worst, (np.ptp(answers, axis=0)[:2] / np.abs(answers[0, :2])).max())
        print(kind, answers, file=sys.stderr)
        rows.append((kind, *answers[1]))
    for EI in (40.0, 80.0, 120.0, 160.0, 200.0, 240.0):
        first, second = folds(halves[0], EI, 1.75 * rise), folds(halves[1], EI, 1.75 * rise)
        for (w, P), (w2, P2) in zip(first, second):
            worst = max(worst, abs(P - P2) / abs(P))
            rows.append(("fold", EI, P2, w2))
    print("largest relative difference", worst, file=sys.stderr)
    print("# pinned-pinned circular arch, R = 100, half angle 10 degrees, EA = 420, crown point load P: critical "
          "points on the symmetric path; drop is that of the crown. Chebyshev collocation of the beam's differential "
          "equation (arch_critical_locus.py), two degrees and windows agree to %.0e" % worst)
    print("kind,EI,P,drop")
    for kind, EI, P, w in rows:
        print(f"{kind},{EI:.12g},{P:.12g},{w:.12g}")


main()
