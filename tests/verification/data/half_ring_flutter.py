#!/usr/bin/python3
"""Flutter of half a ring under a pressure that follows it, clamped at one end, by Chebyshev collocation, 7 digits.

  half_ring_flutter.py       prints the value of the test Flutter.OfHalfARingUnderPressure for both sides

A slender half ring of radius 1, bending stiffness 1, mass 1 per length and axial stiffness EA, under a pressure p by
length of the deformed axis, positive towards the centre. With the force (X, Y) and the moment M on a section, and the
direction t of the axis,

  x' = (1 + N / EA) cos t    X' = -(1 + N / EA) p sin t - omega^2 u    N = X cos t + Y sin t
  y' = (1 + N / EA) sin t    Y' =  (1 + N / EA) p cos t - omega^2 v    t' = -1 + M
                            M' = (1 + N / EA) (X sin t - Y cos t)

Newton's method finds the state; the same equations, linearised there, are the eigenproblem. Flutter begins where two
eigenvalues omega^2 become complex. Needs python3-numpy and python3-scipy; shares no code with the solver.
"""
import numpy as np
from scipy.linalg import eig

from arch_frequencies import chebyshev

FIELDS = 6  # u, v, turn, X, Y, M


class HalfRing:
    def __init__(self, EA, n):
        self.EA, self.n = EA, n
        s, D = chebyshev(n)
        self.D = D / np.pi
        self.axis = np.pi / 2 - np.pi * s

    def residual(self, z, p):
        u, v, b, X, Y, M = z.reshape(FIELDS, self.n + 1)
        a, t = self.axis, self.axis + b
        stretch = 1 + (X * np.cos(t) + Y * np.sin(t)) / self.EA
        out = np.array([self.D @ u - stretch * np.cos(t) + np.cos(a), self.D @ v - stretch * np.sin(t) + np.sin(a),
                        self.D @ b - M, self.D @ X + stretch * p * np.sin(t), self.D @ Y - stretch * p * np.cos(t),
                        self.D @ M - stretch * (X * np.sin(t) - Y * np.cos(t))])
        out[:3, 0] = u[0], v[0], b[0]
        out[3:, -1] = X[-1], Y[-1], M[-1]
        return out.ravel()

    def tangent(self, z, p):
        """By complex steps: exact."""
        out = np.empty((z.size, z.size))
        for j in range(z.size):
            moved = z.astype(complex)
            moved[j] += 1e-30j
            out[:, j] = self.residual(moved, p).imag / 1e-30
        return out

    def state(self, z, p):
        for _ in range(30):
            step = np.linalg.solve(self.tangent(z, p), self.residual(z, p))
            z = z - step
            if np.abs(step).max() < 1e-11:
                return z
        raise RuntimeError(f"no equilibrium at {p}")

    def squares(self, z, p):
        """The lowest eigenvalues omega^2: tangent z = omega^2 B z, B = -1 on u and v of the balances of force."""
        B = np.zeros((FIELDS, self.n + 1, FIELDS, self.n + 1))
        for i in range(self.n):
            B[3, i, 0, i] = B[4, i, 1, i] = -1.0
        values = eig(self.tangent(z, p), B.reshape(z.size, z.size), right=False)
        values = values[np.isfinite(values) & (np.abs(values) < 1e5)]
        return values[np.argsort(values.real)][:8]


def closest_pair(squares):
    """Squared half difference of the adjacent eigenvalues that are closest, or complex; smooth where they meet."""
    half = 0.5 * np.diff(squares)
    return (half * half).real.min()


def flutter_load(side, EA, n, step=0.02, most=3.0):
    """First pressure beyond which two eigenvalues are complex; None where none are up to `most`, or it diverges."""
    ring = HalfRing(EA, n)
    points = [(0.0, np.zeros(FIELDS * (n + 1)), np.inf)]
    while points[-1][2] > 0.0:
        p, z, _ = points[-1]
        if p > most:
            return None
        z = ring.state(z, side * (p + step))
        squares = ring.squares(z, side * (p + step))
        if squares.real.min() < 0.0:
            return None
        points.append((p + step, z, closest_pair(squares)))
    (a, z, before), (b, _, after) = points[-2:]
    while abs(b - a) > 1e-11 * b:  # secant
        middle = (a * after - b * before) / (after - before)
        z = ring.state(z, side * middle)
        a, before, b, after = b, after, middle, closest_pair(ring.squares(z, side * middle))
    return b


if __name__ == "__main__":
    for side in (1, -1):
        loads = [flutter_load(side, 1e5, n) for n in (24, 32)]
        print(f"side {side:2d}: {loads[1]:.10g}   (digits lost to the number of places: {abs(loads[1] / loads[0] - 1):.0e})")
