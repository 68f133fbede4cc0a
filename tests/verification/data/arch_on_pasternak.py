#!/usr/bin/python3
"""Limit load of a clamped shallow arch that is pushed by a force at its crown into tensionless Pasternak ground, by
collocation (scipy.integrate.solve_bvp) with the end of contact as an unknown.

  arch_on_pasternak.py        prints the rows of PasternakArch in tests/verification/tensionless_pasternak_test.cpp

Half span 1, opening angle 0.4, EI = 1, EA = 8000, Reissner's equations without shear. The ground resists displacements
downwards, w = -v. In contact the vertical force T = V + G v' of section and ground together has T' = K v. Needs
python3-scipy; shares no code with the solver.
"""
import numpy as np
from scipy.integrate import solve_bvp
from scipy.optimize import minimize_scalar

ANGLE, EA = 0.4, 8000.0
RADIUS = 1.0 / np.sin(ANGLE / 2)
HALF = RADIUS * ANGLE / 2


def derivatives(s, state, K, G):
    """State u, v, rotation, M, H, T."""
    u, v, turn, M, H, T = state
    first = ANGLE / 2 - s / RADIUS
    phi = first + turn
    V = (T - G * ((1 + H * np.cos(phi) / EA) * np.sin(phi) - np.sin(first))) / (1 + G * np.sin(phi) ** 2 / EA)
    stretch = 1 + (H * np.cos(phi) + V * np.sin(phi)) / EA
    return np.array([stretch * np.cos(phi) - np.cos(first), stretch * np.sin(phi) - np.sin(first), M,
                     stretch * (H * np.sin(phi) - V * np.cos(phi)), 0 * H, K * v])


def load(depth, K, G, endless, guess=None):
    """Crown force at a crown displacement, and the solution."""
    k = np.sqrt(K / G)

    def both(x, y, p):
        c = p[0]
        free = c * derivatives(c * x, y[:6], 0.0, 0.0)
        touch = (HALF - c) * derivatives(c + (HALF - c) * x, y[6:], K, G)
        return np.vstack([free, touch])

    def ends(a, b, p):
        c = p[0]
        slope = derivatives(np.array(c), b[:6], 0.0, 0.0)[1]
        decay = k if endless else k * np.tanh(k * c)
        joined = a[6:] - b[:6]
        joined[5] -= G * slope  # T holds the ground's part
        return np.array([a[0], a[1], a[2], *joined, slope - decay * b[1], b[6], b[8], b[7] + depth])

    x = np.linspace(0, 1, 81)
    y = np.zeros((12, x.size))
    y[7] = -depth
    guesses = [guess] if guess else [(x, y, [part * HALF]) for part in (0.66, 0.6, 0.7, 0.5, 0.75, 0.8)]
    for x, y, p in guesses:
        found = solve_bvp(both, ends, x, y, p=p, tol=1e-9, max_nodes=5000)
        if found.status == 0 and 0 < found.p[0] < HALF and np.all(found.y[7] < 0):
            return -2 * found.y[11, -1], found
    raise ArithmeticError(found.message)


def limit(K, G, endless):
    guess = None
    depths, loads, all_found = [], [], []
    for depth in np.arange(0.005, 0.15, 0.0025):
        F, found = load(depth, K, G, endless, guess)
        guess = (found.x, found.y, found.p)
        depths.append(depth), loads.append(F), all_found.append(guess)
        if len(loads) > 2 and loads[-1] < loads[-2]:
            at = minimize_scalar(lambda d: -load(d, K, G, endless, all_found[-2])[0],
                                 bounds=(depths[-3], depths[-1]), method="bounded", options={"xatol": 1e-9})
            F, found = load(at.x, K, G, endless, all_found[-2])
            return F, at.x, found.p[0]
    return np.round(loads, 3), np.round(depths, 4)


if __name__ == "__main__":
    for K, G, endless in ((10.0, 0.5, False), (10.0, 1.0, False), (10.0, 1.0, True)):
        print(K, G, endless, limit(K, G, endless))
