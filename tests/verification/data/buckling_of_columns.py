#!/usr/bin/env python3
"""Makes columns_on_supports.csv: least loads of straight columns whose supports may react on one side of the axis only.

A column of length 1, EI = 1 and inextensible, under an end load P, has the quotient

  P = min (integral w''^2 + sum of k <w>^2) / integral w'^2

over deflections w that its ends allow, <w> being w where a support reacts and 0 elsewhere. The supports are foundations
(from, to, stiffness, side) and springs (at, stiffness, side); side 1 reacts to w > 0, -1 to w < 0, 0 to both.

  1. least_mode(): cubic finite elements; the modes of the supports that react in the last w, from many starts.
  2. polished(): on pieces between supports and zeros of w the solution is exact, (w, w', w'', w''') at a piece's end is
     exp(A h) times that at its start. The load, the zeros and the ratio of the two free numbers at the start meet the
     conditions at the zeros and at the end (Newton's method, 30 digits).

The program shares no code with the solver. Needs numpy, scipy and mpmath.
Run: python3 buckling_of_columns.py > columns_on_supports.csv
"""
import mpmath as mp
import numpy as np
import scipy.linalg

mp.mp.dps = 30
ELEMENTS = 100
HELD = {"P": (0,), "C": (0, 1), "F": ()}  # of (w, w') at an end: pinned, clamped, free


def marks_of(foundations, springs):
    return sorted({0.0, 1.0, *(x for f in foundations for x in f[:2]), *(s[0] for s in springs)})


def reacts(side, w):
    return side == 0 or side * w > 0


class Elements:
    """Matrices of cubic elements: bending, geometric, and a row of w with its stiffness and side for each support."""

    def __init__(self, ends, foundations, springs):
        marks = marks_of(foundations, springs)
        pieces = [np.linspace(a, b, 2 + round(ELEMENTS * (b - a))) for a, b in zip(marks[:-1], marks[1:])]
        self.x = np.unique(np.concatenate(pieces))
        n = 2 * len(self.x)
        self.bending, self.geometric, self.rows = np.zeros((n, n)), np.zeros((n, n)), []
        points, weights = np.polynomial.legendre.leggauss(4)
        for i, h in enumerate(np.diff(self.x)):
            d = np.arange(2 * i, 2 * i + 4)
            for t, weight in zip((points + 1) / 2, weights * h / 2):
                w = np.array([1 - 3 * t**2 + 2 * t**3, h * (t - 2 * t**2 + t**3), 3 * t**2 - 2 * t**3, h * (t**3 - t**2)])
                w1 = np.array([6 * (t**2 - t) / h, 1 - 4 * t + 3 * t**2, 6 * (t - t**2) / h, 3 * t**2 - 2 * t])
                w2 = np.array([(12 * t - 6) / h**2, (6 * t - 4) / h, (6 - 12 * t) / h**2, (6 * t - 2) / h])
                self.bending[np.ix_(d, d)] += weight * np.outer(w2, w2)
                self.geometric[np.ix_(d, d)] += weight * np.outer(w1, w1)
                for a, b, k, side in foundations:
                    if a <= self.x[i] + t * h <= b:
                        self.rows.append((d, w, weight * k, side))
        for at, k, side in springs:
            self.rows.append((np.array([2 * np.abs(self.x - at).argmin()]), np.array([1.0]), k, side))
        held = [*HELD[ends[0]], *(n - 2 + j for j in HELD[ends[1]])]
        self.free = [i for i in range(n) if i not in held]

    def reacting(self, u):
        return [reacts(side, w @ u[d]) for d, w, _, side in self.rows]

    def stiffness(self, reacting):
        out = self.bending.copy()
        for (d, w, k, _), acts in zip(self.rows, reacting):
            if acts:
                out[np.ix_(d, d)] += k * np.outer(w, w)
        return out

    def modes(self, reacting, number=6):
        grid = np.ix_(self.free, self.free)
        vectors = scipy.linalg.eigh(self.stiffness(reacting)[grid], self.geometric[grid],
                                    subset_by_index=[0, number - 1])[1]
        out = np.zeros((number, len(self.bending)))
        out[:, self.free] = vectors.T
        return [sign * u for u in out for sign in (1.0, -1.0)]

    def load(self, u):
        return u @ self.stiffness(self.reacting(u)) @ u / (u @ self.geometric @ u)


def least_mode(elements):
    every = [True] * len(elements.rows)
    bilateral = [side == 0 for *_, side in elements.rows]
    starts = elements.modes(every) + elements.modes(bilateral)
    random = np.random.default_rng(1)
    starts += [sum(random.normal() * u for u in starts[::2]) for _ in range(6)]
    best = min(starts, key=elements.load)
    for u in starts:
        while True:
            following = min(elements.modes(elements.reacting(u)), key=elements.load)
            if elements.load(following) >= elements.load(u) * (1 - 1e-12):
                break
            u = following
        best = min(best, u, key=elements.load)
    return best


def polished(elements, ends, foundations, springs, u):
    """Load and zeros of w by exact solutions between marks and zeros, from those of the elements."""
    x, w = elements.x, u[::2]
    zeros = [x[i] - w[i] * (x[i + 1] - x[i]) / (w[i + 1] - w[i]) for i in range(1, len(x) - 2) if w[i] * w[i + 1] < 0]
    cuts = sorted([(mark, False) for mark in marks_of(foundations, springs)] + [(zero, True) for zero in zeros])
    plan = []  # of each piece: its stiffness, its end, whether that is a zero, stiffness of springs there
    for (a, _), (b, is_zero) in zip(cuts[:-1], cuts[1:]):
        middle = 0.5 * (a + b)
        k = sum(k for lo, hi, k, side in foundations if lo <= middle <= hi and reacts(side, np.interp(middle, x, w)))
        spring = sum(k for at, k, side in springs if at == b and reacts(side, np.interp(b, x, w)))
        plan.append((k, b, is_zero, spring))
    scale = 40  # of w''' against the other numbers at the start

    def residuals(load, *rest):
        places, ratio = iter(rest[:-1]), rest[-1]
        one, other = mp.cos(ratio), mp.sin(ratio) * scale
        state = {"P": [0, one, 0, other], "C": [0, 0, one, other], "F": [one, other, 0, -load * other]}[ends[0]]
        state, at, out = mp.matrix(state), mp.mpf(0), []
        for k, end, is_zero, spring in plan:
            end = next(places) if is_zero else mp.mpf(end)
            A = mp.matrix([[0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1], [-k, 0, -load, 0]])
            state, at = mp.expm(A * (end - at)) * state, end
            state[3] -= spring * state[0]
            if is_zero:
                out.append(state[0])
        w0, w1, w2, w3 = state
        return out + {"P": [w0, w2], "C": [w0, w1], "F": [w2, w3 + load * w1]}[ends[1]]

    h = x[1]
    third = 6 * (2 * (w[0] - w[1]) / h + u[1] + u[3]) / h**2
    second = 2 * (3 * (w[1] - w[0]) / h - 2 * u[1] - u[3]) / h
    one, other = {"P": (u[1], third), "C": (second, third), "F": (w[0], u[1])}[ends[0]]
    start = [elements.load(u), *zeros, np.arctan2(other / scale, one)]
    return mp.findroot(residuals, [mp.mpf(v) for v in start], tol=1e-36, maxsteps=60)[0]


def both(left, right):
    return [(0, 1, left, 1), (0, 1, right, -1)]


CASES = [  # ends (P pinned, C clamped, F free), foundations, springs
    ("PP", both(100, 400), []), ("PP", both(1000, 3000), []), ("PP", both(500, 750), []),
    ("PP", both(2000, 10000), []), ("PP", both(10000, 30000), []), ("PP", both(50, 5000), []),
    ("CP", both(500, 2000), []), ("CP", both(3000, 5000), []), ("CC", both(2000, 10000), []),
    ("CC", both(5000, 8000), []), ("CF", both(100, 300), []), ("CF", both(1000, 4000), []),
    ("PP", [(0, 0.5, 200, 1), (0.5, 1, 200, -1)], []), ("PP", [(0, 0.5, 2000, 1), (0.5, 1, 2000, -1)], []),
    ("PP", [(0, 0.6, 1000, 1), (0.4, 1, 3000, -1)], []), ("CP", [(0, 0.3, 2000, 0), (0.3, 1, 2000, 1)], []),
    ("PP", [(0, 0.3, 800, 0), (0.3, 1, 800, 1)], []), ("CC", [(0.25, 0.75, 4000, 1), (0.25, 0.75, 9000, -1)], []),
    ("PP", [], [(0.3, 200, 1), (0.6, 300, -1)]), ("PP", [], [(0.25, 500, 1), (0.5, 500, -1), (0.75, 500, 1)]),
    ("CP", [], [(0.4, 400, 1), (0.7, 300, -1)]), ("CF", [], [(1, 30, 1), (0.5, 50, -1)]),
    ("PP", [(0, 1, 100, 1)], [(0.5, 200, -1)]),
    ("CF", [(0, 1, 50, 0)], []), ("CF", [(0, 1, 1000, 0)], []), ("CF", [(0, 1, 20000, 0)], []),
    ("CP", [(0, 1, 200, 0)], []), ("CP", [(0, 1, 3000, 0)], []), ("CP", [(0, 1, 50000, 0)], []),
    ("CC", [(0, 1, 500, 0)], []), ("CC", [(0, 1, 10000, 0)], []), ("CC", [(0, 1, 100000, 0)], []),
    ("PP", [(0, 0.5, 500, 0)], []), ("PP", [(0.2, 0.7, 3000, 0)], [])]


def main():
    print("# Least loads of straight inextensible columns, L = EI = 1. ends: P pinned, C clamped, F free, the second end "
          "loaded and free along the axis. foundations: from, to, stiffness, side; springs: at, stiffness, side; side 1 "
          "reacts to movement to the left, -1 to the right, 0 to both. Exact solution by pieces, 30 digits "
          "(buckling_of_columns.py).")
    print("ends,foundations,springs,P")
    for ends, foundations, springs in CASES:
        elements = Elements(ends, foundations, springs)
        load = polished(elements, ends, foundations, springs, least_mode(elements))
        cells = [" ".join(f"{v:g}" for support in supports for v in support) for supports in (foundations, springs)]
        print(f"{ends},{cells[0]},{cells[1]},{mp.nstr(load, 14)}", flush=True)


main()
