#!/usr/bin/env python3
"""Limit load of a shallow arch, programmed from docs/theory.md alone; shares no code with the solver.

  shallow_arch.py     prints the load factor P R^2/EI on meshes, and fails if the last is more than 1e-6 off

Half of a pinned arch: R = 100, 20 degrees, EA = 420, EI = 1.4, unshearable, load P at the crown. The unknowns y are u, v, b at
the nodes of Lagrange elements of order P, and the shear force Q at the Gauss points, which keeps g = 0. Equilibrium F = 0 makes

    sum_q h w_q [ EA e^2 / 2 + EI k^2 / 2 + Q g ] - lambda P v_crown

stationary, with P Gauss points in an element. Needs python3-numpy.
"""
import numpy as np
from numpy.polynomial.legendre import leggauss

R, HALF_ANGLE, EA, EI = 100.0, np.radians(10.0), 420.0, 1.4
REFERENCE = 76.149346  # collocation of the rod's boundary value problem; tests/verification/arch_test.cpp


def lagrange(nodes, s):
    """Values and derivatives at s of the polynomials that are one at one node and zero at the others."""
    powers = np.vander(nodes, increasing=True)
    coefficients = np.linalg.inv(powers)  # column j: polynomial j
    at = np.vander(s, nodes.size, increasing=True)
    slopes = np.zeros_like(at)
    slopes[:, 1:] = at[:, :-1] * np.arange(1, nodes.size)
    return at @ coefficients, slopes @ coefficients


class Arch:
    """Discrete arch. State y: (u, v, b) of node 0, of node 1, ..., then Q of all Gauss points."""

    def __init__(self, elements, order):
        length = R * HALF_ANGLE
        self.h = length / elements
        points, weights = leggauss(order)
        self.weights = 0.5 * weights * self.h
        self.values, slopes = lagrange(np.linspace(0.0, 1.0, order + 1), 0.5 * (points + 1.0))
        self.slopes = slopes / self.h
        self.elements, self.order = elements, order
        self.nodes = elements * order + 1
        # tangent of the stress-free axis from the left springing to the crown: d1 = (cos phi, sin phi), phi falls to zero
        s = self.h * (np.arange(elements)[:, None] + 0.5 * (points + 1.0)[None, :])
        self.phi = HALF_ANGLE - s / R
        self.size = 3 * self.nodes + elements * order
        # pinned springing: u = v = 0; crown by symmetry: u = b = 0
        fixed = {0, 1, 3 * (self.nodes - 1), 3 * (self.nodes - 1) + 2}
        self.free = np.array([i for i in range(self.size) if i not in fixed])
        self.crown = 3 * (self.nodes - 1) + 1
        self.load = np.zeros(self.size)
        self.load[self.crown] = -0.5 * EI / R**2  # half of P at lambda = 1
        self.metric = np.where(np.arange(self.size) < 3 * self.nodes, 1.0, 0.0)  # the fixed inner product W of borders

    def forces_and_tangent(self, y):
        """Internal forces (without the load) and their derivative; y may be complex."""
        f = np.zeros(self.size, dtype=y.dtype)
        J = np.zeros((self.size, self.size), dtype=y.dtype)
        for e in range(self.elements):
            places = np.arange(3 * e * self.order, 3 * ((e + 1) * self.order + 1))
            u = y[places].reshape(-1, 3)
            for q in range(self.order):
                N, D = self.values[q], self.slopes[q]
                shear = 3 * self.nodes + e * self.order + q
                phi = self.phi[e, q]
                x = np.cos(phi) + D @ u[:, 0]
                z = np.sin(phi) + D @ u[:, 1]
                th = phi + N @ u[:, 2]
                c, s = np.cos(th), np.sin(th)
                axial, g, k = x * c + z * s - 1.0, z * c - x * s, D @ u[:, 2]
                Q = y[shear]
                # derivatives of e and g by (x', y', th), and second ones; e' = g + ..., g' = -(1 + e) by th
                de = np.array([c, s, g])
                dg = np.array([-s, c, -(1.0 + axial)])
                d2e = np.array([[0, 0, -s], [0, 0, c], [-s, c, -(1.0 + axial)]])
                d2g = np.array([[0, 0, -c], [0, 0, -s], [-c, -s, -g]])
                B = np.zeros((3, places.size))  # of (x', y', th) by the element's unknowns
                B[0, 0::3], B[1, 1::3], B[2, 2::3] = D, D, N
                Bk = np.zeros(places.size)
                Bk[2::3] = D
                w = self.weights[q]
                f[places] += w * (B.T @ (EA * axial * de + Q * dg) + EI * k * Bk)
                f[shear] += w * g
                H = EA * np.outer(de, de) + EA * axial * d2e + Q * d2g
                J[np.ix_(places, places)] += w * (B.T @ H @ B + EI * np.outer(Bk, Bk))
                J[places, shear] += w * (B.T @ dg)
                J[shear, places] += w * (B.T @ dg)
        return f, J

    def second(self, y, v, w):
        """F''[v, w]: derivative of J w along v, by a complex step."""
        return np.imag(self.forces_and_tangent(y + 1e-30j * v)[1] @ w) / 1e-30

    def bordered(self, J, row, column, right, bottom):
        """(solution, multiplier) of [J column; row 0], with what is fixed left out."""
        free = self.free
        matrix = np.block([[J[np.ix_(free, free)], column[free][:, None]], [row[free][None, :], np.zeros((1, 1))]])
        solved = np.linalg.solve(matrix, np.append(right[free], bottom))
        out = np.zeros(self.size)
        out[free] = solved[:-1]
        return out, solved[-1]


def limit_load(arch):
    """Follows the path by the crown's displacement to a falling load, then solves F = 0, g = 0."""
    y, load_factor, before = np.zeros(arch.size), 0.0, -1.0
    crown = np.eye(arch.size)[arch.crown]
    while load_factor > before:
        before, target = load_factor, y[arch.crown] - 0.02
        for _ in range(8):
            f, J = arch.forces_and_tangent(y)
            step, change = arch.bordered(J, crown, -arch.load, load_factor * arch.load - f, target - y[arch.crown])
            y, load_factor = y + step, load_factor + change
    n, zero = arch.metric * np.ones(arch.size), np.zeros(arch.size)
    for _ in range(8):
        f, J = arch.forces_and_tangent(y)
        border = arch.metric * n
        v, g = arch.bordered(J, border, -border, zero, 1.0)  # J v = g W n, n.W v = 1
        p, from_p = arch.bordered(J, border, -border, load_factor * arch.load - f, 0.0)
        q, from_q = arch.bordered(J, border, -border, arch.load, 0.0)
        rate = arch.second(y, v, v)  # g changes by v.F''[v, dy]
        a, change = np.linalg.solve([[g, from_q], [rate @ v, rate @ q]], [-from_p, -g - rate @ p])
        y, load_factor, n = y + p + change * q + a * v, load_factor + change, v / np.sqrt(v @ (arch.metric * v))
    return load_factor


def main():
    for elements, order in ((2, 3), (4, 3), (4, 4), (8, 4)):
        found = limit_load(Arch(elements, order))
        print(f"{elements} elements of order {order}: {found:.8f}, off by {found / REFERENCE - 1:.1e}")
    if not abs(found / REFERENCE - 1) < 1e-6:
        raise SystemExit("not the limit load")


if __name__ == "__main__":
    main()
