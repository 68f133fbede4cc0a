#!/usr/bin/env python3
"""Head displacements of laterally loaded piles on nonlinear soil, by collocation of EI w'''' + p(s, w) = 0 with a
free tip (scipy.integrate.solve_bvp, whose residuals are below 1e-10 on thousands of nodes).

  piles.py        prints one line for each law of tests/verification/law_test.cpp

Length 1, EI 1, force 6 at the head s = 0. Needs python3-scipy; shares no code with the solver.
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


def head(p):
    nodes = np.linspace(0.0, 1.0, 4001)
    guess = np.zeros((4, nodes.size))
    guess[0] = 0.01 * np.exp(-5.0 * nodes)
    found = solve_bvp(lambda s, y: np.vstack([y[1], y[2], y[3], -p(s, y[0])]),
                      lambda a, b: np.array([a[2], a[3] - FORCE, b[2], b[3]]), nodes, guess, tol=1e-10,
                      max_nodes=400000)
    assert found.status == 0
    return found.y[0, 0]


if __name__ == "__main__":
    for name, law in LAWS.items():
        print(f"{name}: {head(law):.12f}")
