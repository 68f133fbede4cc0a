#!/usr/bin/env python3
"""Values of examples/gallery/pages/tunnel_lining.toml: a ring of segments in the ground, whose joints have Janssen's curve.

  jointed_ring.py        prints radial displacements of crown, invert and side, and rotation, moment and hoop force of the
                         joint in the invert, with the curve at the mean hoop force and with that at the joint's own

Small displacements of a ring without joints are a Fourier series in the angle a, with the radial displacement w (outwards)
and the tangential one v: hoop strain (v' + w)/R, curvature (v' - w'')/R^2, ground K w. A joint is a curvature
rotation/R delta(a - a_j) without stress. The series of ground stresses and of seven unknown rotations give the moments at
the joints, which must be those of Janssen's curve. The program shares no code with the solver. Units kN and m, by metre of
tunnel.
"""
import numpy as np
from scipy.optimize import fsolve

R, THICKNESS, CONTACT, E = 4.5, 0.4, 0.2, 35e6
GROUND, MEAN, DIFFERENCE = 5000.0, 400.0, 60.0  # kN/m^3; mean and half the difference of vertical and horizontal stress
EA, EI = E * THICKNESS, E * THICKNESS**3 / 12
JOINTS = -np.pi / 2 + 2 * np.pi * np.arange(7) / 7
PLACES = np.array([np.pi / 2, -np.pi / 2, 0.0])  # crown, invert, side
ORDERS = np.arange(100000)  # w has a kink at a joint, its series falls with the square of the order


def janssen(rotation, N):
    """Moment of two faces that touch over CONTACT and cannot pull, on a zone as long as CONTACT"""
    opens = 2 * N / (E * CONTACT)
    size = np.abs(rotation)
    closed = E * CONTACT**2 / 12 * size
    opened = N * CONTACT / 2 * (1 - np.sqrt(8 * N / (9 * E * CONTACT * np.maximum(size, opens))))
    return np.sign(rotation) * np.where(size <= opens, closed, opened)


def fields(orders, right):
    """(w, curvature, hoop strain) of each order under the forces `right` on (w, v)"""
    strain = np.stack([np.ones_like(orders), orders], -1) / R
    curvature = np.stack([orders**2, orders], -1) / R**2
    A = EA * strain[:, :, None] * strain[:, None] + EI * curvature[:, :, None] * curvature[:, None]
    A[:, 0, 0] += GROUND
    A[orders == 0, 1, 1] = 1.0
    w = np.linalg.solve(A, right(curvature)[:, :, None])[:, :, 0]
    return w[:, 0], np.sum(curvature * w, 1), np.sum(strain * w, 1)


def ring():
    """(w, M, N) under the stresses and by unit rotations, at places and joints"""
    angles = np.concatenate([PLACES, JOINTS])
    w, curvature, strain = fields(np.array([0.0, 2.0]), lambda _: np.array([[-MEAN, 0], [DIFFERENCE, -DIFFERENCE]]))
    waves = np.cos(np.outer(angles, [0, 2]))
    loaded = [waves @ part for part in (w, EI * curvature, EA * strain)]
    share = np.where(ORDERS == 0, 0.5, 1.0) / (np.pi * R)
    w, curvature, strain = fields(ORDERS.astype(float), lambda k: EI * share[:, None] * k)
    parts = (w, EI * (curvature - share), EA * strain)
    turned = np.array([[[np.cos(ORDERS * (a - j)) @ part for j in JOINTS] for a in angles] for part in parts])
    return loaded, turned


def solved(loaded, turned, own):
    """w at the places, then rotation, moment and hoop force of the first joint"""
    joints = slice(len(PLACES), None)

    def hoop(rotations):
        return -(loaded[2][joints] + turned[2][joints] @ rotations)

    def moments(rotations):
        return loaded[1][joints] + turned[1][joints] @ rotations

    def missing(rotations):
        return moments(rotations) - janssen(rotations, hoop(rotations) if own else np.full(len(JOINTS), MEAN * R))

    start = loaded[1][joints] / (E * CONTACT**2 / 6)
    rotations, _, status, message = fsolve(missing, start, full_output=True, xtol=1e-12)
    if status != 1:
        raise SystemExit(message)
    return [*(loaded[0] + turned[0] @ rotations)[:len(PLACES)], rotations[0], moments(rotations)[0], hoop(rotations)[0]]


def main():
    loaded, turned = ring()
    for own in (False, True):
        print(*(f"{value:.7g}" for value in solved(loaded, turned, own)))


if __name__ == "__main__":
    main()
