#!/usr/bin/env python3
"""Head displacements of laterally loaded piles on nonlinear soil, by collocation of EI w'''' + p(s, w) = 0 with a
free tip (scipy.integrate.solve_bvp, whose residuals are below 1e-10 on thousands of nodes).

  piles.py        prints one line for each law of tests/verification/law_test.cpp, and two for each law of
                  tests/convergence/law_order_test.cpp

Length 1, EI 1, force 6 at the head s = 0; in law_order_test EI 0.1, force 2.5, a hinged tip, soil on both sides and on
one. On one side the residuals beside the end of contact stay at 1e-3 on 400 000 nodes. Needs python3-scipy; shares no code with the solver.
"""
import numpy as np
from scipy.integrate import solve_bvp

FORCE = 6.0
LAWS = {
    "tanh that grows with depth": lambda s, w: (5 + 35 * s) * np.tanh((200 + 4800 * s) * w / (5 + 35 * s)),
    "hyperbolic": lambda s, w: w / (1 / 3000 + np.abs(w) / 20),
    # long: its head displacement over FORCE T^3, T = 1e5^(-1/5), is the coefficient A of Reese and Matlock
    "stiffness that grows from zero": lambda s, w: 1e5 * s * w,
    "stiffness that grows with depth": lambda s, w: (100 + 9000 * s) * w,
}


HINGED = {
    "linear": lambda w: 300 * w,
    "tanh": lambda w: 30 * np.tanh(10 * w),
    "hyperbolic": lambda w: w / (1 / 300 + np.abs(w) / 30),
    "power": lambda w: np.sign(w) * np.minimum(np.minimum(300 * np.abs(w), 30 * np.cbrt(np.abs(w) / 0.8)), 30),
}


def displacement(p, stiffness, force, tip):
    """Displacement of the head. tip: what is zero there, of the derivatives 0 to 3."""
    nodes = np.linspace(0.0, 1.0, 4001)
    guess = np.zeros((4, nodes.size))
    guess[0] = 0.01 * np.exp(-5.0 * nodes)
    return solve_bvp(lambda s, y: np.vstack([y[1], y[2], y[3], -p(s, y[0]) / stiffness]),
                     lambda a, b: np.array([a[2], a[3] - force / stiffness, b[tip[0]], b[tip[1]]]), nodes, guess,
                     tol=1e-10, max_nodes=400000)


def head(p):
    found = displacement(p, 1.0, FORCE, (2, 3))
    assert found.status == 0
    return found.y[0, 0]


if __name__ == "__main__":
    for name, law in LAWS.items():
        print(f"{name}: {head(law):.12f}")
    for name, law in HINGED.items():
        both = displacement(lambda s, w: law(w), 0.1, 2.5, (0, 2)).y[0, 0]
        one = displacement(lambda s, w: law(np.maximum(w, 0.0)), 0.1, 2.5, (0, 2)).y[0, 0]
        print(f"{name}, hinged tip: {both:.12f} on both sides, {one:.12f} on one")
