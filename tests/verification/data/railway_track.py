#!/usr/bin/env python3
"""Temperatures of examples/gallery/pages/railway_track.toml: a heated track whose ballast has a peak resistance.

  railway_track.py        prints (displacement of the middle, temperature in kelvin) of both limit points, for two tolerances

The track is the boundary value problem of an extensible, shear-rigid beam (Reissner 1972) over the length s of the
straight axis, with the stress-free offset w0(s), its angle t0 and stretch g = sqrt(1 + w0'^2),

  x' = g (1 + e) cos t,  y' = g (1 + e) sin t,  t' = t0' + g M / EI,  e = (H cos t + V sin t) / EA + expansion T,
  H' = along(x - s),  V' = across(y - w0),  M' = y' H - x' V,

(H, V) the force of the later part on the earlier one. The displacement of the middle is prescribed and the temperature T
is found with it, by scipy's collocation; extrema lie on a parabola through the three nearest displacements. The offset is
a spline through points, not-a-knot at both ends, whose small slope in the middle is stress-free. The program shares no
code with the solver. Needs numpy and scipy; takes about 20 s. Units kN and m.
"""
import numpy as np
from scipy.integrate import solve_bvp
from scipy.interpolate import CubicSpline

EA, EI, EXPANSION, LENGTH = 3.23e6, 2150.0, 1.15e-5, 200.0
PEAK, LIMIT, AT_PEAK, AT_LIMIT = 10.0, 5.0, 0.01, 0.1  # of the resistance across: kN/m, m
ALONG, START = 10.0, 2000.0  # capacity and initial stiffness of the resistance along: kN/m, kN/m^2
OFFSETS = np.array([
    (0, 0.01), (0.00625, 0.008535534), (0.0125, 0.005), (0.01875, 0.001464466), (0.025, 0), (0.0275, 0), (0.03125, 0),
    (0.0375, 0), (0.05, 0), (0.075, 0), (0.125, 0), (0.225, 0), (0.425, 0), (1, 0)])
OFFSET = CubicSpline(LENGTH * OFFSETS[:, 0], OFFSETS[:, 1])

SCALES = np.array([[1e-3], [1e-2], [1e-2], [100.0], [10.0], [10.0]])  # of u, w, t, H, V, M; fields are divided by them
RISE = np.concatenate([np.linspace(0.0005, 0.011, 22), np.linspace(0.0112, 0.0128, 17)])  # displacements up to the first limit point
FALL = np.concatenate([np.linspace(0.014, 0.03, 9), np.linspace(0.04, 0.17, 14), np.linspace(0.175, 0.195, 11)])  # up to the second


def across(w):
    return np.interp(np.abs(w), [0, AT_PEAK, AT_LIMIT], [0, PEAK, LIMIT]) * np.sign(w)


def along(u):
    return ALONG * np.tanh(START * u / ALONG)


def rates(s, fields, parameters):
    u, w, t, H, V, M = SCALES * fields
    slope = OFFSET(s, 1)
    g = np.hypot(1, slope)
    e = (H * np.cos(t) + V * np.sin(t)) / EA + EXPANSION * parameters[0]
    x1, y1 = g * (1 + e) * np.cos(t), g * (1 + e) * np.sin(t)
    return np.array([x1 - 1, y1 - slope, OFFSET(s, 2) / g**2 + g * M / EI, along(u), across(w), y1 * H - x1 * V]) / SCALES


def at_ends(middle):
    """No rotation at either end, no shear force in the middle, no displacement at the far end"""
    angles = np.arctan(OFFSET([0.0, LENGTH], 1)) / SCALES[2, 0]

    def missing(first, last, _):
        return np.array([first[0], first[1] - middle / SCALES[1, 0], first[2] - angles[0], first[4], last[0], last[1],
                         last[2] - angles[1]])
    return missing


def path(displacements, tolerance):
    """Temperatures at these displacements of the middle"""
    s = LENGTH * (np.linspace(0, 1, 401) ** 2)
    fields, temperature = np.zeros((6, s.size)), [1.0]
    fields[2] = np.arctan(OFFSET(s, 1)) / SCALES[2, 0]
    found = []
    for middle in displacements:
        solution = solve_bvp(rates, at_ends(middle), s, fields, temperature, tol=tolerance, max_nodes=200000)
        if solution.status != 0:
            raise SystemExit(f"{middle}: {solution.message}")
        s, fields, temperature = solution.x, solution.y, solution.p
        found.append(solution.p[0])
    return np.array(found)


def extremum(displacements, temperatures, sign):
    """(displacement, temperature) at the extremum of a parabola through the largest value and its neighbours"""
    i = int(np.argmax(sign * temperatures))
    a, b, c = np.polyfit(displacements[i - 1:i + 2] - displacements[i], temperatures[i - 1:i + 2], 2)
    return displacements[i] - b / (2 * a), c - b * b / (4 * a)


def main():
    for tolerance in (1e-3, 1e-4):
        temperatures = path([*RISE, *FALL], tolerance)
        print(*extremum(RISE, temperatures[:RISE.size], 1), *extremum(FALL, temperatures[RISE.size:], -1))


if __name__ == "__main__":
    main()
