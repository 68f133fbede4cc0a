#!/usr/bin/env python3
"""Head displacements of laterally loaded piles in sand and in soft clay (API RP 2GEO), by collocation of
EI w'''' + p(X, w) = 0 with a free tip (scipy.integrate.solve_bvp of order 4, with relative residuals below 1e-7).

  soil_piles.py        prints one line for each pile of tests/verification/soil_pile_test.cpp

Resistance and stiffness are taken at the depths of POINTS and are linear in between, as the laws of the test; "exact"
is the head displacement with the formulas at every depth. Units kN and m. Needs python3-scipy; shares no code with the
solver.
"""
import numpy as np
from scipy.integrate import solve_bvp

D = 0.6
POINTS = 81


def sand_resistance(X):
    """A Pmax of API sand: angle of friction 33 degrees, submerged weight 9 kN/m3."""
    pmax = 9.0 * X * np.minimum(2.46 * X + 3.25 * D, 43.0 * D)
    return np.maximum(0.9, 3.0 - 0.8 * X / D) * pmax


def clay_resistance(X):
    """Pmax of Matlock's soft clay: Su = 15 + 1.5 X, submerged weight 6 kN/m3, J = 0.5."""
    Su = 15.0 + 1.5 * X
    return np.minimum((3.0 * Su + 6.0 * X) * D + 0.5 * Su * X, 9.0 * Su * D)


def sand(resistance):
    def p(X, y):
        P = resistance(X) + 1e-300
        return P * np.tanh(22000.0 * X * y / P)
    return p


def clay(resistance):
    y50 = 2.5 * 0.01 * D

    def p(X, y):
        t = np.abs(y) / y50
        return resistance(X) * np.sign(y) * np.minimum(np.minimum(0.5 * 0.1 ** (1 / 3) / 0.1 * t, 0.5 * np.cbrt(t)), 1.0)
    return p


def head(p, length, EI, force):
    """Head displacement over 1 m: integrated over s = X / length in y = w and the derivatives of w by s."""
    unit = length ** 4 / EI
    found = None
    for share in (0.1, 0.3, 0.6, 1.0):
        shear = share * force * length ** 3 / EI
        if found is None:
            nodes = np.linspace(0.0, 1.0, 40 * (POINTS - 1) + 1) ** 2
            guess = np.zeros((4, nodes.size))
            guess[0] = 0.01 * np.exp(-5.0 * nodes)
        else:
            nodes, guess = found.x, found.y
        last = share == 1.0
        found = solve_bvp(lambda s, y: np.vstack([y[1], y[2], y[3], -unit * p(length * s, y[0])]),
                          lambda a, b: np.array([a[2], a[3] - shear, b[2], b[3]]), nodes, guess,
                          tol=1e-7 if last else 1e-5, max_nodes=400000)
        assert found.status == 0, found.message
    return found.y[0, 0]


if __name__ == "__main__":
    for name, law, resistance, length, EI, force in (
            ("sand", sand, sand_resistance, 15.0, 1.2e5, 400.0),
            ("clay", clay, clay_resistance, 20.0, 1.2e5, 150.0)):
        depths = length * np.linspace(0.0, 1.0, POINTS) ** 2
        table = resistance(depths)
        print(f"{name}: {head(law(lambda X: np.interp(X, depths, table)), length, EI, force):.12f}, "
              f"exact {head(law(resistance), length, EI, force):.12f}")
