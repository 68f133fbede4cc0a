#!/usr/bin/python3
"""Natural frequencies of arches under load and on a Winkler base, by Chebyshev collocation, 10 digits.

  arch_frequencies.py        prints the rows of tests/verification/vibration_test.cpp

A slender arch of radius 1, bending stiffness 1, mass 1 per length and axial stiffness EA, clamped or hinged at its
ends, under a force P downwards at its crown. Geometrically exact:

  x' = (1 + N / EA) cos t    X' = K d n_x - omega^2 u    N = X cos t + Y sin t
  y' = (1 + N / EA) sin t    Y' = K d n_y - omega^2 v    t' = k + M / EI
                            M' = (1 + N / EA) (X sin t - Y cos t)

with the force (X, Y) and the moment M on a section, the displacement d = u n_x + v n_y along the normal (n_x, n_y) of
the undeformed axis, and K the stiffness of the base. Newton's method finds the state; the same equations, linearised
there, are the eigenproblem. Each half of the arch is one interval. Needs python3-numpy and python3-scipy; shares no
code with the solver.
"""
import numpy as np
from scipy.linalg import eig


def chebyshev(n):
    """Places on [0, 1] and the matrix of derivatives there."""
    x = np.cos(np.pi * np.arange(n + 1) / n)
    c = np.ones(n + 1)
    c[0] = c[-1] = 2
    c *= (-1.0) ** np.arange(n + 1)
    X = np.tile(x, (n + 1, 1)).T
    D = np.outer(c, 1 / c) / (X - X.T + np.eye(n + 1))
    D -= np.diag(D.sum(axis=1))
    return (1 - x) / 2, -2 * D


class Arch:
    """Rows: both halves, each with the fields u, v, turn, X, Y, M at the places of one interval."""

    def __init__(self, degrees, EA, clamped, n, base=0.0, load=0.0):
        self.EA, self.base, self.load, self.clamped, self.n = EA, base, load, clamped, n
        self.half = np.radians(degrees) / 2
        self.s, D = chebyshev(n)
        self.D = D / self.half

    def axis(self, part):
        """Direction of the undeformed axis from left to right, curved clockwise."""
        return self.half - self.half * (self.s + part)

    def fields(self, z, part):
        return z.reshape(2, 6, self.n + 1)[part]

    def residual(self, z):
        """Left side minus right side without inertia, and conditions in the place of one row per field."""
        out = np.zeros((2, 6, self.n + 1), dtype=z.dtype)
        ends = []
        for part in (0, 1):
            u, v, b, X, Y, M = self.fields(z, part)
            a = self.axis(part)
            t = a + b
            N = X * np.cos(t) + Y * np.sin(t)
            stretch = 1 + N / self.EA
            nx, ny = -np.sin(a), np.cos(a)
            d = u * nx + v * ny
            out[part] = [self.D @ u - (stretch * np.cos(t) - np.cos(a)), self.D @ v - (stretch * np.sin(t) - np.sin(a)),
                         self.D @ b - M, self.D @ X - self.base * d * nx, self.D @ Y - self.base * d * ny,
                         self.D @ M - stretch * (X * np.sin(t) - Y * np.cos(t))]
            ends.append((np.array([u, v, b, X, Y, M])[:, 0], np.array([u, v, b, X, Y, M])[:, -1]))
        (left, before), (after, right) = ends
        jump = after - before - np.array([0, 0, 0, 0, self.load, 0])
        out[0, :, 0] = [left[0], left[1], left[2] if self.clamped[0] else left[5], jump[0], jump[1], jump[2]]
        out[1, :, 0] = [jump[3], jump[4], jump[5], right[0], right[1], right[2] if self.clamped[1] else right[5]]
        return out.ravel()

    def tangent(self, z):
        """By complex steps: exact."""
        size = z.size
        out = np.empty((size, size))
        for j in range(size):
            moved = z.astype(complex)
            moved[j] += 1e-30j
            out[:, j] = self.residual(moved).imag / 1e-30
        return out

    def inertia(self):
        """Matrix of omega^2: X' + omega^2 u = 0 and Y' + omega^2 v = 0, without the rows of conditions."""
        m = self.n + 1
        out = np.zeros((12 * m, 12 * m))
        for part in (0, 1):
            for field in (0, 1):
                for i in range(1, m):
                    out[(6 * part + 3 + field) * m + i, (6 * part + field) * m + i] = -1.0
        return out

    def state(self, steps=10):
        z = np.zeros(12 * (self.n + 1))
        load = self.load
        for step in range(1, steps + 1 if load else 1):
            self.load = load * step / steps
            for _ in range(30):
                change = np.linalg.solve(self.tangent(z), -self.residual(z))
                z += change
                if np.abs(change).max() < 1e-12 * max(1.0, np.abs(z).max()):
                    break
        return z

    def squares(self, count):
        mu = eig(self.tangent(self.state()), self.inertia(), right=False)
        mu = mu[np.isfinite(mu) & (np.abs(mu) < 1e8)]
        mu = np.sort(mu[np.abs(mu.imag) < 1e-6 * np.abs(mu)].real)
        return mu[:count]


def row(name, **arch):
    values = [Arch(n=n, **arch).squares(4) for n in (32, 44)]
    change = np.abs(values[1] / values[0] - 1).max()
    print(f"{name}: {', '.join(f'{v:.10g}' for v in values[1])}   (digits lost to the number of places: {change:.0e})")


if __name__ == "__main__":
    for base in (0.0, 100.0):
        row(f"120 degrees, hinged, base {base:g}", degrees=120, EA=1e4, clamped=(False, False), base=base)
    for load in (0.0, 3.0, 6.0, 8.5):
        row(f"215 degrees, clamped and hinged, P = {load:g}", degrees=215, EA=1e6, clamped=(True, False), load=load)
