#!/usr/bin/env python3
"""Elastic catenaries for examples/gallery/pages/ropeway.toml: a rope of 202 m unstressed length over 200 m, and a carriage.

  ropeway.py        prints horizontal force, depth of the carriage and force at the left support

A piece of the unstressed length h that begins with the forces H and V (upwards on it) ends at
  x = H h / EA + H/w (asinh(V/H) - asinh((V - w h)/H)),
  z = h/EA (V - w h/2) + H/w (sqrt(1 + (V/H)^2) - sqrt(1 + ((V - w h)/H)^2)), downwards
(H. M. Irvine, Cable Structures, 1981). Both pieces beside the carriage together end at the right support. Units kN and m.
"""
from math import asinh, hypot

from scipy.optimize import fsolve

WEIGHT, EA, LENGTH, SPAN = 0.0033 * 9.81, 44000.0, 202.0, 200.0


def end(h, H, V):
    """(x, z) of the end of a piece from its beginning"""
    last = V - WEIGHT * h
    x = H * h / EA + H / WEIGHT * (asinh(V / H) - asinh(last / H))
    return x, h / EA * (V - WEIGHT * h / 2) + H / WEIGHT * (hypot(1, V / H) - hypot(1, last / H))


def ropeway(at, load):
    """(H, depth of the carriage, force at the left support) with a carriage at this unstressed length"""
    def missing(forces):
        H, V = forces
        left, right = end(at, H, V), end(LENGTH - at, H, V - WEIGHT * at - load)
        return left[0] + right[0] - SPAN, left[1] + right[1]

    H, V = fsolve(missing, (13.0 + 3 * load, (WEIGHT * LENGTH + load) / 2), xtol=1e-13)
    return H, end(at, H, V)[1], hypot(H, V)


if __name__ == "__main__":
    for place, force in ((LENGTH / 2, 0.0), (LENGTH / 2, 10.0), (LENGTH / 4, 10.0)):
        print(f"{force:g} kN at {place:g} m: H {{:.9f}} kN, depth {{:.9f}} m, force {{:.9f}} kN".format(*ropeway(place, force)))
