#!/usr/bin/env python3
"""Pile D1 of PISA in stiff glacial clay till, and the tower of examples/monopile.json on it.

  monopile.py        prints displacement and rotation of the head, its initial stiffness, and natural frequencies

Straight finite elements that bend and shear, with one quadrature point each, where the conics of Byrne et al. (2020) act;
small displacements; two meshes are extrapolated. Frequencies are those about the state at rest, with and without the
axial force of the weight. Units kN, m, t. Needs python3-scipy; shares no code with the solver.
"""
import numpy as np
from scipy.linalg import eigh

E, NU, DENSITY, GRAVITY = 2.1e8, 0.3, 7.85, 9.81
D, L, ARM = 7.5, 22.5, 37.5
TOP_MASS = 480.0
PILE = (L, 7.5, 0.068)  # length, diameter, wall
ABOVE = [(ARM, 7.5, 0.068), (25.0, 6.0, 0.036), (25.0, 5.0, 0.03), (25.0, 4.0, 0.025)]


def tube(diameter, wall):
    """(A, I, G times the shear area by Cowper for Poisson's ratio 0)"""
    inner = diameter - 2 * wall
    area, inertia = np.pi / 4 * (diameter**2 - inner**2), np.pi / 64 * (diameter**4 - inner**4)
    square = (1 + (inner / diameter) ** 2) ** 2
    return area, inertia, E / (2 * (1 + NU)) * area * 6 * square / (7 * square + 20 * (inner / diameter) ** 2)


def conic(x, k, n, last, most):
    """y of -n (y/most - x/last)^2 + (1 - n) (y/most - k x/most) (y/most - 1) = 0, constant beyond last."""
    s = np.minimum(np.abs(x) / last, 1.0)
    slope = k * last / most * s
    a, b, c = 1 - 2 * n, 2 * n * s - (1 - n) * (1 + slope), (1 - n) * slope - n * s**2
    return np.sign(x) * most * 2 * c / (-b + np.sqrt(b * b - 4 * a * c))


class Ground:
    """Reactions at depths X to displacements v and rotations t."""

    def __init__(self, X):
        self.X, self.Su, self.G0 = X, np.interp(X, [0, 11, 35], [80, 140, 200]), np.interp(X, [0, 11, 35], [2e4, 2e5, 4e5])

    def along(self, v, t):
        """(force, moment) per length"""
        ratio, most = self.X / D, 0.2899 - 0.04775 * self.X / D
        force = conic(v * self.G0 / (self.Su * D), 10.6 - 1.65 * ratio, 0.939 - 0.03345 * ratio, 241.4,
                      10.7 - 7.101 * np.exp(-0.3085 * ratio))
        return self.Su * D * force, self.Su * D**2 * np.clip((1.42 - 0.09643 * ratio) * t * self.G0 / self.Su, -most, most)

    def base(self, v, t):
        """(force, moment)"""
        ratio = self.X / D
        force = conic(v * self.G0 / (self.Su * D), 2.717 - 0.3575 * ratio, 0.8793 - 0.0315 * ratio, 235.7,
                      0.4038 + 0.04812 * ratio)
        moment = conic(t * self.G0 / self.Su, 0.2146 - 0.002132 * ratio, 1.079 - 0.1087 * ratio, 173.1,
                       0.8192 - 0.08588 * ratio)
        return self.Su * D**2 * force, self.Su * D**3 * moment

    def stiffness(self, reactions, v, t):
        """Slopes of the two reactions, by central differences."""
        dv, dt = 1e-7, 1e-8
        return ((reactions(v + dv, t)[0] - reactions(v - dv, t)[0]) / (2 * dv),
                (reactions(v, t + dt)[1] - reactions(v, t - dt)[1]) / (2 * dt))


class Beam:
    """Elements upwards from the pile's tip; unknowns (v to the left, t counter-clockwise) of each node."""

    def __init__(self, pieces, size):
        counts = [round(length / size) for length, _, _ in pieces]
        self.h = np.concatenate([np.full(n, p[0] / n) for n, p in zip(counts, pieces)])
        properties = [tube(d, w) for _, d, w in pieces]
        self.A, self.I, self.GA = (np.repeat([p[i] for p in properties], counts) for i in range(3))
        self.in_ground = counts[0]
        self.middle = Ground(L - self.h[0] * (np.arange(counts[0]) + 0.5))
        self.tip = Ground(np.array(L))
        self.unknowns = 2 * (len(self.h) + 1)

    def assemble(self, parts):
        """Sum over elements of h c r r' for each (c of the elements, r by their length)."""
        out = np.zeros((self.unknowns, self.unknowns))
        for e, h in enumerate(self.h):
            rows = slice(2 * e, 2 * e + 4)
            for c, r in parts:
                out[rows, rows] += h * c[e] * np.outer(r(h), r(h))
        return out

    def elastic(self):
        return self.assemble([(E * self.I, lambda h: np.array([0, -1, 0, 1]) / h),
                              (self.GA, lambda h: np.array([-1 / h, -0.5, 1 / h, -0.5]))])

    def springs(self, u):
        """(reactions, their stiffness) of the ground"""
        n, force, K = self.in_ground, np.zeros(self.unknowns), np.zeros((self.unknowns, self.unknowns))
        v, t = u[::2], u[1::2]
        places = [(self.middle, self.middle.along, (v[:n] + v[1:n + 1]) / 2, (t[:n] + t[1:n + 1]) / 2)]
        reactions, slopes = places[0][1](*places[0][2:]), self.middle.stiffness(*places[0][1:])
        for i in range(2):
            for e in range(n):
                at = [2 * e + i, 2 * e + 2 + i]
                force[at] += self.h[e] * reactions[i][e] / 2
                K[np.ix_(at, at)] += self.h[e] * slopes[i][e] / 4
        base, slope = self.tip.base(v[0], t[0]), self.tip.stiffness(self.tip.base, v[0], t[0])
        force[:2] += base
        K[[0, 1], [0, 1]] += slope
        return force, K


def heads(size, loads):
    """(v to the right, rotation) of the mudline under each force at the height ARM above it."""
    beam, found = Beam([PILE], size), []
    elastic, u = beam.elastic(), np.zeros(beam.unknowns)
    for load in loads:
        given = np.zeros(beam.unknowns)
        given[-2:] = -load, -load * ARM
        for attempt in range(200):
            reaction, K = beam.springs(u)
            step = np.linalg.solve(elastic + K, given - elastic @ u - reaction)
            u += step if attempt < 20 else step / 2
            if np.abs(step).max() < 1e-11:
                break
        else:
            raise RuntimeError(f"{load}: no equilibrium")
        found.append((-u[-2], u[-1]))
    return np.array(found)


def head_stiffness(size):
    """Force to the right and moment by displacement to the right and rotation of the unloaded mudline, alone."""
    beam = Beam([PILE], size)
    flexible = np.linalg.inv(beam.elastic() + beam.springs(np.zeros(beam.unknowns))[1])[-2:, -2:]
    return np.linalg.inv(flexible) * [[1, -1], [-1, 1]]


def frequencies(size, gravity):
    """The two lowest, in Hz."""
    beam = Beam([PILE, *ABOVE], size)
    masses = DENSITY * beam.A * beam.h
    carried = TOP_MASS + np.cumsum(masses[::-1])[::-1] - masses / 2
    mean, turn = np.array([0.5, 0, 0.5, 0]), np.array([0, 0.5, 0, 0.5])
    K = beam.elastic() + beam.springs(np.zeros(beam.unknowns))[1]
    K += beam.assemble([(-gravity * carried, lambda h: np.array([-1, 0, 1, 0]) / h)])
    M = beam.assemble([(DENSITY * beam.A, lambda h: mean), (DENSITY * beam.I, lambda h: turn)])
    M[-2, -2] += TOP_MASS
    last = beam.unknowns - 1
    inverse = eigh(M, K, eigvals_only=True, subset_by_index=[last - 1, last])  # M has modes without mass
    return 1 / np.sqrt(inverse[::-1]) / (2 * np.pi)


def extrapolated(what, size, *arguments):
    """Of a quantity whose error falls with the square of the elements' length."""
    coarse, fine = what(size, *arguments), what(size / 2, *arguments)
    return fine + (fine - coarse) / 3


if __name__ == "__main__":
    LOADS = [1e3, 2.5e3, 5e3, 7.5e3, 1e4, 1.2e4, 1.25e4, 1.4e4, 1.45e4]
    for load, (v, t) in zip(LOADS, extrapolated(heads, 0.1, LOADS)):
        print(f"H = {load / 1e3:g} MN: displacement {v:.9f} m, rotation {t:.9f}")
    print("stiffness of the head, kN/m, kN, kN m:", extrapolated(head_stiffness, 0.1).tolist())
    print("without weight:", extrapolated(frequencies, 0.5, 0.0).tolist(), "Hz")
    print("with weight:", extrapolated(frequencies, 0.5, GRAVITY).tolist(), "Hz")
