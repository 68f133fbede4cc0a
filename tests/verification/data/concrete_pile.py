#!/usr/bin/env python3
"""Bending law and displacements for examples/gallery/pages/concrete_pile.toml: a bored pile of reinforced concrete in sand.

  concrete_pile.py table     prints the points [curvature, moment] of the request's table, and the ultimate moment
  concrete_pile.py           prints displacement of the head and largest moment of each lateral force, and the limit point,
                             with the section's own curve and with its initial stiffness

Section: plane strains over fibres across the diameter, and bars. Concrete: parabola and rectangle of EN 1992-1-1 in
compression; in tension linear up to FT, beyond it FT/(1 + sqrt(500 strain)) (Collins and Mitchell 1991). Steel: elastic,
perfectly plastic. For each curvature the strain of the axis follows from the axial force.

Pile: boundary value problem of an extensible, shear-rigid beam (Reissner 1972) over the depth X, by scipy's collocation,

  u' = (1 + e) cos t - 1,  w' = (1 + e) sin t,  t' = curvature(M),  e = (H cos t + V sin t) / EA,
  H' = 0,  V' = p(X, w),  M' = (1 + e) (H sin t - V cos t),

(H, V) the force of the later part on the earlier one, p API's curve of sand with its formulas at every depth. The
displacement of the head is prescribed. Beyond the ultimate strain the curve goes on with its last slope. The program shares
no code with the solver. Needs numpy and scipy. Units kN and m.
"""
import sys

import numpy as np
from scipy.integrate import solve_bvp
from scipy.interpolate import CubicSpline, PchipInterpolator
from scipy.optimize import brentq

D, LENGTH, AXIAL = 0.9, 15.0, 1000.0
FC, PEAK_STRAIN, CRUSHED, FT = 30e3, 0.002, 0.0035, 2.9e3
FY, STEEL, BARS, BAR_AREA, BAR_RADIUS = 500e3, 200e6, 16, np.pi * 0.025**2 / 4, 0.36
EA = 2 * FC / PEAK_STRAIN * np.pi * D**2 / 4
POINTS = (1e-4, 2e-4, 3e-4, 3.5e-4, 4e-4, 5e-4, 6e-4, 8e-4, 1.2e-3, 1.8e-3, 2.6e-3, 3.4e-3, 4.2e-3, 5e-3, 5.4e-3, 6e-3, 7e-3, 8.2e-3,
          0.01, 0.0128)
FORCES = (150.0, 300.0, 450.0, 600.0)
# Displacements of the head
HEADS = np.concatenate([np.linspace(0.0005, 0.02, 79), np.linspace(0.021, 0.1, 80), np.linspace(0.102, 0.14, 20)])
LAST = 159  # of them before the limit point

Y = D / 2 * np.cos(np.pi * (np.arange(4000) + 0.5) / 4000)  # fibres, closer at the edges
AREAS = D / 2 * np.sqrt(1 - (2 * Y / D)**2) * 2 * (D / 2) * np.pi / 4000 * np.sqrt(1 - (2 * Y / D)**2)
BAR_Y = BAR_RADIUS * np.cos(2 * np.pi * np.arange(BARS) / BARS)


def concrete(strain):
    """Stress, compression positive"""
    pressed = FC * (1 - (1 - np.clip(strain, 0, PEAK_STRAIN) / PEAK_STRAIN)**2)
    pulled = np.maximum(-strain, 0)
    E = 2 * FC / PEAK_STRAIN
    return np.where(strain >= 0, pressed, -np.where(pulled <= FT / E, E * pulled, FT / (1 + np.sqrt(500 * pulled))))


def forces(axis, curvature):
    """(axial force, moment) of the section"""
    fibres = concrete(axis + curvature * Y) * AREAS
    bars = np.clip(STEEL * (axis + curvature * BAR_Y), -FY, FY) * BAR_AREA
    return fibres.sum() + bars.sum(), fibres @ Y + bars @ BAR_Y


def at_curvature(curvature):
    """(moment, largest compressive strain) under the axial force"""
    axis = brentq(lambda strain: forces(strain, curvature)[0] - AXIAL, -0.05, 0.0035, xtol=1e-14)
    return forces(axis, curvature)[1], axis + curvature * D / 2


def curve():
    """Dense curvatures and moments up to the ultimate compressive strain"""
    ultimate = brentq(lambda curvature: at_curvature(curvature)[1] - CRUSHED, 0.005, 0.1)
    curvatures = np.concatenate([np.linspace(0, 2e-3, 101), np.linspace(2e-3, ultimate, 400)[1:]])
    return curvatures, np.array([at_curvature(k)[0] if k else 0.0 for k in curvatures])


def sand(X, w):
    resistance = np.maximum(0.9, 3 - 0.8 * X / D) * 9.0 * X * np.minimum(2.46 * X + 3.25 * D, 43 * D) + 1e-9
    return resistance * np.tanh(22000.0 * X * w / resistance)


SCALES = np.array([[1e-3], [1e-2], [1e-2], [1000.0], [100.0], [100.0]])  # of u, w, t, H, V, M; fields are divided by them


def pile(curvature_of, moved, start=None):
    """Solution with a displacement of the head; its parameter is the lateral force"""
    def rates(X, fields, force):
        u, w, t, H, V, M = SCALES * fields
        e = (H * np.cos(t) + V * np.sin(t)) / EA
        return np.array([(1 + e) * np.cos(t) - 1, (1 + e) * np.sin(t), curvature_of(M), 0 * u, sand(X, w),
                         (1 + e) * (H * np.sin(t) - V * np.cos(t))]) / SCALES

    def ends(head, tip, force):
        return np.array([head[1] - moved / SCALES[1, 0], head[3] + AXIAL / SCALES[3, 0], head[4] + force[0] / SCALES[4, 0], head[5],
                         tip[0], tip[4], tip[5]])

    X = np.linspace(0, 1, 301)**1.5 * LENGTH if start is None else start.x
    fields = np.zeros((6, X.size)) if start is None else start.y
    force = [100.0] if start is None else start.p
    solution = solve_bvp(rates, ends, X, fields, force, tol=1e-5, max_nodes=100000)
    if solution.status != 0:
        raise SystemExit(solution.message)
    return solution


def followed(curvature_of):
    """Displacements of the head, lateral forces and largest moments"""
    solution, forces_, moments = None, [], []
    for moved in HEADS:
        solution = pile(curvature_of, moved, solution)
        forces_.append(solution.p[0])
        moments.append(np.max(solution.sol(np.linspace(2, 6, 4001))[5]) * SCALES[5, 0])
    return np.array(forces_), np.array(moments)


def main():
    curvatures, moments = curve()
    if np.any(np.diff(moments) <= 0):
        raise SystemExit("the moment falls")
    if sys.argv[1:] == ["table"]:
        for k in (*POINTS, curvatures[-1]):
            print(f"[{k:.6g}, {at_curvature(k)[0]:.6g}],")
        return
    slope = (moments[-1] - moments[-2]) / (curvatures[-1] - curvatures[-2])
    curvatures, moments = np.append(curvatures, curvatures[-1] + 1), np.append(moments, moments[-1] + slope)
    inside = PchipInterpolator(moments, curvatures)
    laws = {"own curve": lambda M: np.sign(M) * inside(np.abs(M)), "initial stiffness": lambda M: M * curvatures[1] / moments[1]}
    for name, law in laws.items():
        found, largest = followed(law)
        for force in FORCES:
            print(f"{name}, {force:g}: head {CubicSpline(found[:LAST], HEADS[:LAST])(force):.7g}, "
                  f"moment {CubicSpline(found[:LAST], largest[:LAST])(force):.7g}")
        i = np.argmax(found)
        if 0 < i < len(HEADS) - 1:
            a, b, c = np.polyfit(HEADS[i - 1:i + 2] - HEADS[i], found[i - 1:i + 2], 2)
            print(f"limit point {c - b * b / (4 * a):.7g} at {HEADS[i] - b / (2 * a):.4g}, moment {largest[i]:.5g}; "
                  f"ultimate moment {moments[-2]:.6g} at {CubicSpline(largest[LAST - 30:], found[LAST - 30:])(moments[-2]):.6g}")


if __name__ == "__main__":
    main()
