#!/usr/bin/env python3
"""First limit load of Lee's frame, programmed from docs/theory.md alone; shares no code with the solver.

  lees_frame.py     prints the load on meshes, and fails if the last is more than 1e-7 off

A column of length L, pinned at its foot, carries a beam of length L, pinned at its far end (Lee, Manuel and Rossow, J.
Eng. Mech. Div. ASCE 94, 1968, 547). The load acts downwards on the beam at L / 5 from the corner. Sections are
unshearable; unknowns are u, v, b at the nodes of Lagrange elements of order P, which the members share at the corner, and
Q at P Gauss points an element. The path is followed until the load turns; the limit point's own equations begin there.
Needs python3-numpy.
"""
import numpy as np

EA, EI, L, ARM = 4320.0, 1440.0, 120.0, 24.0
REFERENCE = 18.55672753757 * EI / L**2  # collocation of the rods' boundary value problem; tests/verification/data
ORDER = 4


def gauss(order):
    """Gauss points and weights on 0..1, with the Lagrange values and derivatives of equidistant nodes there."""
    points, weights = np.polynomial.legendre.leggauss(order)
    points, weights = (points + 1) / 2, weights / 2
    nodes = np.linspace(0, 1, order + 1)
    powers = np.vander(nodes, increasing=True)
    values = np.vander(points, order + 1, increasing=True)
    slopes = np.zeros_like(values)
    slopes[:, 1:] = values[:, :-1] * np.arange(1, order + 1)
    return weights, values @ np.linalg.inv(powers), slopes @ np.linalg.inv(powers)


WEIGHTS, VALUES, SLOPES = gauss(ORDER)


class Frame:
    """Unknowns: u, v, b of all nodes, then Q of all Gauss points; the foot and the right end are pinned."""

    def __init__(self, elements):
        lengths = [L / elements] * elements + [ARM] + [(L - ARM) / elements] * elements
        angles = [np.pi / 2] * elements + [0.0] * (elements + 1)
        self.elements = list(zip(lengths, angles))
        self.nodes = ORDER * len(lengths) + 1
        self.size = 3 * self.nodes + ORDER * len(lengths)
        corner = ORDER * elements
        loaded = corner + ORDER
        self.free = np.setdiff1d(np.arange(self.size), [0, 1, 3 * (self.nodes - 1), 3 * (self.nodes - 1) + 1])
        self.load = np.zeros(self.size)
        self.load[3 * loaded + 1] = -1.0
        self.load = self.load[self.free]

    def system(self, y):
        """Internal forces and their tangent; y may be complex."""
        full = np.zeros(self.size, dtype=y.dtype)
        full[self.free] = y
        force = np.zeros(self.size, dtype=y.dtype)
        tangent = np.zeros((self.size, self.size), dtype=y.dtype)
        for number, (h, phi0) in enumerate(self.elements):
            place = np.concatenate([np.arange(3 * ORDER * number, 3 * (ORDER * number + ORDER + 1)),
                                    3 * self.nodes + ORDER * number + np.arange(ORDER)])
            f, k = self.element(full[place], h, phi0)
            force[place] += f
            tangent[np.ix_(place, place)] += k
        return force[self.free], tangent[np.ix_(self.free, self.free)]

    @staticmethod
    def element(y, h, phi0):
        motion, shear = y[:3 * (ORDER + 1)].reshape(-1, 3), y[3 * (ORDER + 1):]
        force, tangent = np.zeros(len(y), dtype=y.dtype), np.zeros((len(y), len(y)), dtype=y.dtype)
        for q in range(ORDER):
            w, rows = WEIGHTS[q] * h, np.zeros((4, len(y)))  # rows: x', y', th, b' by the unknowns
            for node in range(ORDER + 1):
                rows[0, 3 * node] = rows[1, 3 * node + 1] = rows[3, 3 * node + 2] = SLOPES[q, node] / h
                rows[2, 3 * node + 2] = VALUES[q, node]
            du, dv, b, db = rows @ y
            c, s = np.cos(phi0 + b), np.sin(phi0 + b)
            dx, dy = np.cos(phi0) + du, np.sin(phi0) + dv
            e, g = dx * c + dy * s - 1, dy * c - dx * s
            de, dg = np.array([c, s, g]), np.array([-s, c, -(e + 1)])
            d2e = np.array([[0, 0, -s], [0, 0, c], [-s, c, -(e + 1)]])
            d2g = np.array([[0, 0, -c], [0, 0, -s], [-c, -s, -g]])
            at = rows[:3]
            force += w * (at.T @ (EA * e * de + shear[q] * dg) + EI * db * rows[3])
            tangent += w * (at.T @ (EA * np.outer(de, de) + EA * e * d2e + shear[q] * d2g) @ at
                            + EI * np.outer(rows[3], rows[3]))
            row = 3 * (ORDER + 1) + q
            force[row] += w * g
            tangent[row] += w * (dg @ at)
            tangent[:, row] += w * (at.T @ dg)
        return force, tangent


def step(frame, y, load, tangent, size):
    """One step of the path with the plain norm, the load over 10; returns the point and its tangent."""
    weight = 1 / 10.0 ** 2
    y0, load0 = y + size * tangent[0], load + size * tangent[1]
    y, load = y0, load0
    for _ in range(20):
        force, k = frame.system(y)
        p, q = np.linalg.solve(k, np.column_stack([load * frame.load - force, frame.load])).T
        dload = -(tangent[0] @ (y - y0 + p) + weight * tangent[1] * (load - load0)) / (tangent[0] @ q + weight * tangent[1])
        y, load = y + p + dload * q, load + dload
        if np.linalg.norm(p + dload * q) < 1e-9 * np.linalg.norm(y):
            break
    else:
        raise ArithmeticError("no convergence")
    q = np.linalg.solve(frame.system(y)[1], frame.load)
    rate = 1 / np.sqrt(q @ q + weight)
    if tangent[0] @ q + weight * tangent[1] < 0:
        rate = -rate
    return y, load, (rate * q, rate)


def limit_point(frame, y, load):
    """Newton's method for F = 0, g = 0, as spelled out in the text; W is one. F'' by a complex step."""
    n = np.linalg.solve(frame.system(y)[1], frame.load)
    n /= np.linalg.norm(n)
    for _ in range(12):
        force, k = frame.system(y)
        bordered = np.block([[k, n[:, None]], [n[None, :], np.zeros((1, 1))]])
        right = np.zeros((len(y) + 1, 3))
        right[-1, 0] = 1                                  # v: J v = g n, n.v = 1
        right[:-1, 1] = load * frame.load - force         # p
        right[:-1, 2] = frame.load                        # q
        solution = np.linalg.solve(bordered, right)
        (v, p, q), (g, alpha, beta) = solution[:-1].T, -solution[-1]
        second = lambda along: np.imag(frame.system(y + 1e-30j * along)[1]) / 1e-30 @ v
        by_v = second(v)
        a, dload = np.linalg.solve([[g, beta], [v @ by_v, q @ by_v]], [-alpha, -g - p @ by_v])
        dy = p + dload * q + a * v
        y, load, n = y + dy, load + dload, v / np.linalg.norm(v)
        if abs(dload) < 1e-12 * abs(load) and np.linalg.norm(dy) < 1e-10 * np.linalg.norm(y):
            return load
    raise ArithmeticError("no limit point")


def first_limit(elements):
    frame = Frame(elements)
    y, load = np.zeros(len(frame.free)), 0.0
    q = np.linalg.solve(frame.system(y)[1], frame.load)
    rate = 1 / np.sqrt(q @ q + 0.01)
    tangent = (rate * q, rate)
    for _ in range(400):
        y, load, tangent = step(frame, y, load, tangent, 2.0)
        if tangent[1] < 0:
            return limit_point(frame, y, load)
    raise ArithmeticError("the load does not turn")


def main():
    for elements in (1, 2, 4):
        found = first_limit(elements)
        print(f"{elements} elements of order {ORDER} in each part: {found:.10f}, off by {found / REFERENCE - 1:.1e}")
    if not abs(found / REFERENCE - 1) < 1e-7:
        raise SystemExit("not the limit load")


if __name__ == "__main__":
    main()
