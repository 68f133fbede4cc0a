#!/usr/bin/env python3
"""Deflections and moments of examples/pile_in_layers.json by finite differences of the beam on p-y curves.

  pile_in_layers.py   prints the deflection of the head and the largest moment at each load factor

EI y'''' + p(X, y) = 0 with p of the formulas of API RP 2GEO as they stand: soft clay with its first straight line, and
sand. Newton's method on the five-point differences, with Richardson's extrapolation over three grids. Needs the
standard library alone; shares no code with the program.
"""
import math

E, D, T = 2.1e8, 1.0, 0.02
EI = E * math.pi / 64.0 * (D**4 - (D - 2.0 * T) ** 4)
HEAD, TIP, LAYER = -1.0, 18.0, 5.0  # depths
LOAD, FACTORS = 250.0, (0.2, 1.0, 2.0)


def clay(X, y):
    """p and dp/dy of soft clay; y >= 0."""
    Su, s = 15.0 + 3.0 * X, 7.0 * X
    P = min((3.0 * Su + s) * D + 0.5 * Su * X, 9.0 * Su * D)
    t = y / (2.5 * 0.015 * D)
    if t <= 0.1:
        k = 0.5 * 0.1 ** (1.0 / 3.0) / 0.1
        return P * k * t, P * k * t / y if y else P * k / (2.5 * 0.015 * D)
    if t >= 8.0:
        return P, 0.0
    p = 0.5 * P * t ** (1.0 / 3.0)
    return p, p / (3.0 * y)


def coefficients(phi):
    a, b = phi / 2.0, math.pi / 4.0 + phi / 2.0
    K0, Ka = 0.4, math.tan(math.pi / 4.0 - phi / 2.0) ** 2
    C1 = (K0 * math.tan(phi) * math.sin(b) / (math.tan(b - phi) * math.cos(a))
          + math.tan(b) ** 2 * math.tan(a) / math.tan(b - phi) + K0 * math.tan(b) * (math.tan(phi) * math.sin(b) - math.tan(a)))
    return C1, math.tan(b) / math.tan(b - phi) - Ka, Ka * (math.tan(b) ** 8 - 1.0) + K0 * math.tan(phi) * math.tan(b) ** 4


C1, C2, C3 = coefficients(math.radians(33.0))


def sand(X, y):
    """p and dp/dy of sand; y >= 0."""
    s = 35.0 + 10.0 * (X - 5.0)
    P = max(0.9, 3.0 - 0.8 * X / D) * min((C1 * X + C2 * D) * s, C3 * D * s)
    k = 15000.0 * X
    p = P * math.tanh(k * y / P)
    return p, k * (1.0 - (p / P) ** 2)


def reaction(X, y):
    """p and dp/dy; the mean of both layers at their common face, half at the surface."""
    sign, y = math.copysign(1.0, y), abs(y)
    laws = ([(0.5, clay), (0.5, sand)] if abs(X - LAYER) < 1e-9 else [(0.5, clay)] if abs(X) < 1e-9
            else [] if X < 0.0 else [(1.0, clay)] if X < LAYER else [(1.0, sand)])
    p = sum(share * law(X, y)[0] for share, law in laws)
    return sign * p, sum(share * law(X, y)[1] for share, law in laws)


def solve_band(A, b):
    """Solves a banded system by elimination; A[i] maps columns within two of the diagonal to values."""
    n = len(b)
    for i in range(n):
        right = [(c, value) for c, value in A[i].items() if c > i]
        for j in range(i + 1, min(i + 3, n)):
            m = A[j].get(i, 0.0) / A[i][i]
            A[j].update((c, A[j].get(c, 0.0) - m * value) for c, value in right)
            b[j] -= m * b[i]
    x = [0.0] * n
    for i in reversed(range(n)):
        x[i] = (b[i] - sum(value * x[c] for c, value in A[i].items() if c > i)) / A[i][i]
    return x


def bending(n, h):
    """Rows of EI y'''' h at the nodes, as the second differences of the curvature, which is zero at both ends."""
    rows = []
    for i in range(n + 1):
        row = {}
        for j, weight in ((i - 1, 1.0), (i, -2.0), (i + 1, 1.0)):
            if not 0 < j < n:
                continue
            scale = weight if 0 < i < n or j != i else 0.0
            for c, value in ((j - 1, 1.0), (j, -2.0), (j + 1, 1.0)):
                row[c] = row.get(c, 0.0) + scale * value * EI / h**3
        rows.append(row)
    return rows


def pile(n, factor):
    """Deflection of the head and largest moment on a grid of n parts."""
    h = (TIP - HEAD) / n
    depths = [HEAD + i * h for i in range(n + 1)]
    rows = bending(n, h)
    y = [0.0] * (n + 1)
    for step in range(1, 11):  # the load in steps
        for _ in range(60):
            residual, tangent = [], []
            for i in range(n + 1):
                width = h if 0 < i < n else 0.5 * h
                p, k = reaction(depths[i], y[i])
                row = dict(rows[i])
                residual.append(-sum(v * y[c] for c, v in row.items()) - width * p
                                + (0.1 * step * factor * LOAD if i == 0 else 0.0))
                row[i] = row.get(i, 0.0) + width * k
                tangent.append(row)
            change = solve_band(tangent, residual)
            y = [a + b for a, b in zip(y, change)]
            if max(map(abs, change)) < 1e-13 * max(map(abs, y)):
                break
    moments = [EI * (y[i - 1] - 2.0 * y[i] + y[i + 1]) / h**2 for i in range(1, n)]
    at = max(range(len(moments)), key=lambda i: abs(moments[i]))
    # the parabola through the largest and its neighbours
    a, b, c = moments[at - 1 : at + 2]
    return y[0], b - (c - a) ** 2 / (8.0 * (a - 2.0 * b + c))


for factor in FACTORS:
    coarse, middle, fine = (pile(n, factor) for n in (190, 380, 760))
    for name, a, b, c in zip(("deflection", "moment"), coarse, middle, fine):
        print(f"{factor:4} {name:10} {c + (c - b) / 3.0:.9g}  (without the coarsest grid's part {b + (b - a) / 3.0:.9g})")
