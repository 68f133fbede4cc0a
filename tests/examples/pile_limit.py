#!/usr/bin/env python3
"""Limit load of examples/pile_in_soil.json by collocation of the exact rod (scipy.integrate.solve_bvp).

  pile_limit.py       prints the first buckling load factor of the straight pile, and the limit load factor

The rod has the axial stiffness EA, the bending stiffness EI, and p = P tanh(K w / P) across and along the axis of the
straight pile. The offset of its own axis is the first buckling mode of the straight pile, by a sine series. The limit
load is the largest load over the rotation of the head. Needs python3-scipy; shares no code with the solver.
"""
import numpy as np
from scipy.integrate import solve_bvp
from scipy.linalg import eigh
from scipy.optimize import minimize_scalar

LENGTH, EA, EI, LOAD, AMPLITUDE = 10.0, 6e6, 2000.0, 1000.0, 0.005
AT_TIP = {"soil": (800.0, 14.4), "friction": (1000.0, 5.0)}  # stiffness and capacity
HEAD = 0.25  # share of them at the head


def law(name, s, w):
    share = 1.0 + (HEAD - 1.0) * s / LENGTH
    stiffness, capacity = AT_TIP[name]
    return share * capacity * np.tanh(stiffness * w / capacity)


def axial_force(where):
    """Share of the load that the straight pile carries at places, at the reference load: EA v'' = friction."""
    s = np.linspace(0.0, LENGTH, 401)
    found = solve_bvp(lambda s, y: np.vstack([y[1], law("friction", s, y[0]) / EA]),
                      lambda a, b: np.array([a[0], b[1] + LOAD / EA]), s, np.zeros((2, s.size)), tol=1e-9)
    assert found.status == 0, found.message
    return -EA * found.sol(where)[1] / LOAD


def mode(terms=60):
    """Coefficients of the first mode in sin(m pi s / L) with the amplitude, and its load factor."""
    nodes, weights = np.polynomial.legendre.leggauss(400)
    s, weights = 0.5 * LENGTH * (nodes + 1.0), 0.5 * LENGTH * weights
    rates = np.arange(1, terms + 1) * np.pi / LENGTH
    sines = np.sin(np.outer(rates, s))
    stiffness = AT_TIP["soil"][0] * (1.0 + (HEAD - 1.0) * s / LENGTH)
    slopes = np.cos(np.outer(rates, s)) * rates[:, None]
    elastic = np.diag(EI * rates**4 * LENGTH / 2.0) + (sines * (stiffness * weights)) @ sines.T
    loads, shapes = eigh(elastic, LOAD * (slopes * (axial_force(s) * weights)) @ slopes.T)
    fine = np.linspace(0.0, LENGTH, 20001)
    shape = shapes[:, 0] * AMPLITUDE / np.abs(shapes[:, 0] @ np.sin(np.outer(rates, fine))).max()
    return rates, shape, loads[0]


RATES, SHAPE, BUCKLING = mode()


def offset_rate(s, order):
    """Derivative of the offset: order 1 or 2."""
    waves = np.cos(np.outer(RATES, s)) * RATES[:, None] if order == 1 else -np.sin(np.outer(RATES, s)) * RATES[:, None]**2
    return SHAPE @ waves


def load_at(rotation, guess):
    """Load at a rotation of the head. States: displacements u, v; angle from the pile's axis; moment; force (x, y)."""
    def rates(s, y, p):
        u, v, angle, moment, fx, fy = y
        first = np.arctan(offset_rate(s, 1))
        bend = offset_rate(s, 2) / (1.0 + offset_rate(s, 1)**2)
        stretch = 1.0 + (fx * np.sin(angle) + fy * np.cos(angle)) / EA
        return np.vstack([stretch * np.sin(angle) - np.sin(first), stretch * np.cos(angle) - np.cos(first),
                          bend + moment / EI, -stretch * (fx * np.cos(angle) - fy * np.sin(angle)),
                          law("soil", s, u), law("friction", s, v)])

    def ends(a, b, p):
        start = np.arctan(offset_rate(np.array([LENGTH]), 1))[0]
        return np.array([a[0], a[1], a[3], b[0], b[3], b[5] + p[0], b[2] - start - rotation])

    found = solve_bvp(rates, ends, guess[0], guess[1], p=[guess[2]], tol=1e-9, max_nodes=200000)
    assert found.status == 0, found.message
    return found.x, found.y, found.p[0]


def limit_load():
    s = np.linspace(0.0, LENGTH, 401)
    guess = (s, np.zeros((6, s.size)), 1.0)
    guess[1][2] = np.arctan(offset_rate(s, 1))
    sign = np.sign(offset_rate(np.array([LENGTH]), 1)[0])
    path = []
    for rotation in sign * np.linspace(0.0002, 0.02, 100):
        guess = load_at(rotation, guess)
        path.append((rotation, guess))
    top = max(range(len(path)), key=lambda i: path[i][1][2])
    ends = sorted((path[top - 1][0], path[top + 1][0]))
    best = minimize_scalar(lambda r: -load_at(r, path[top][1])[2], bounds=ends, method="bounded", options={"xatol": 1e-7})
    return -best.fun


if __name__ == "__main__":
    print(f"buckling load factor {BUCKLING:.8f}")
    print(f"limit load factor {limit_load() / LOAD:.8f}")
