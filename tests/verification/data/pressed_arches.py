#!/usr/bin/env python3
"""Makes pressed_arches.csv: buckling of inextensible circular arches under follower pressure on bilateral foundations.

With R = EI = 1 and the radial displacement w over the angle, w'''' + 2 w'' + w + q (w'' + w) + k w = C, with the
integral of w zero since both ends keep their distance along the axis (Timoshenko and Gere 1961, 7.6). Its energy

  integral (w'' + w)^2 + k w^2 - q (w'^2 - w^2)

is made stationary over polynomials (1 - x^2)^b P_j(x), b = 1 for pinned and 2 for clamped ends, that integrate to zero.
Two numbers of polynomials are compared. Without foundation a pinned arch has q = (pi / a)^2 - 1, a its half angle.
The program shares no code with the solver. Needs numpy and scipy. Run: python3 pressed_arches.py > pressed_arches.csv
"""
import sys

import numpy as np
import scipy.linalg
from numpy.polynomial import legendre

CASES = [(30, "pinned", 0), (30, "clamped", 0), (60, "pinned", 0), (90, "pinned", 0), (60, "clamped", 0),
         (90, "clamped", 0), (30, "pinned", 500), (30, "clamped", 2000), (60, "pinned", 100), (60, "clamped", 500),
         (90, "pinned", 50), (90, "clamped", 200), (45, "pinned", 3000), (75, "clamped", 2000)]


def pressure(half_angle, ends, k, number):
    a = np.radians(half_angle)
    points, weights = legendre.leggauss(2 * number + 8)
    edge = legendre.poly2leg([1.0, 0.0, -1.0])
    if ends == "clamped":
        edge = legendre.legmul(edge, edge)
    w = []
    for j in range(number):
        series = legendre.legmul(edge, [0.0] * j + [1.0])
        series /= np.sqrt(weights @ legendre.legval(points, legendre.legder(series, 2)) ** 2)
        w.append([legendre.legval(points, legendre.legder(series, d)) / a**d if d else legendre.legval(points, series)
                  for d in range(3)])
    w, w1, w2 = np.array(w).transpose(1, 0, 2)
    product = lambda f, g: (f * weights * a) @ g.T
    stiffness = product(w2 + w, w2 + w) + k * product(w, w)
    geometric = product(w1, w1) - product(w, w)
    Z = scipy.linalg.null_space((w @ weights)[None, :])
    return scipy.linalg.eigh(Z.T @ stiffness @ Z, Z.T @ geometric @ Z, eigvals_only=True)[0]


def main():
    print("# Buckling pressure q R^3 / EI of inextensible circular arches, half angle in degrees, on a bilateral radial "
          "foundation k R^4 / EI. Ritz's method with polynomials of two degrees (pressed_arches.py), 12 digits.")
    print("half_angle,ends,k,q")
    for half_angle, ends, k in CASES:
        less, more = (pressure(half_angle, ends, k, number) for number in (22, 28))
        print(half_angle, ends, k, f"{less / more - 1:.0e}", file=sys.stderr)
        print(f"{half_angle},{ends},{k},{more:.12g}")


main()
