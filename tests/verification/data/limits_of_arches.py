#!/usr/bin/env python3
"""Makes arches_and_rings_limits.csv: first limit points of arches and rings, most of them on one-sided foundations.

Units R = EI = 1. The axis is the boundary value problem of an extensible, shear-rigid beam (Reissner 1972),

  x' = (1 + e) cos t,  y' = (1 + e) sin t,  t' = t0' + M,  e = (H cos t + V sin t) / EA,
  H' = -fx,  V' = -fy,  M' = y' H - x' V,

(H, V) the force of the later part of the axis on the earlier one. A foundation acts with f = -k p n along the fixed
normal n of the unloaded axis, p = u.n - gap, where p > 0. The axis is cut at loads, at ends of foundations and at the
ends of contact, which are unknown; in each piece the fields are polynomials in Chebyshev points, and p = 0 holds at each
end of contact. The drop of the crown is prescribed. Load against drop is interpolated near its first maximum.

  1. crude(): 24 pieces of low degree with the sign of p taken at each point; the drop grows until the load falls.
  2. refined(): pieces between the ends of contact that were found, of high degree; load against drop in a small window.
  3. The value is taken again with another degree and window. The last column but one of what goes to standard error is
     the difference of both. The signs of p in all pieces are checked.

The program shares no code with the solver. Needs numpy and scipy; takes some minutes.
Run: python3 limits_of_arches.py > arches_and_rings_limits.csv
"""
import functools
import sys

import numpy as np
import scipy.sparse as sparse
import scipy.sparse.linalg
from numpy.polynomial import chebyshev as cheb

TINY = 1e-30  # step of a derivative in the complex plane
X, Y, T, H, V, M = range(6)


@functools.lru_cache(None)
def rule(n):
    """Chebyshev-Lobatto points on [0, 1] and the matrix of integrals from 0 to each of them."""
    points = -np.cos(np.pi * np.arange(n + 1) / n)
    columns = []
    for i in range(n + 1):
        values = np.zeros(n + 1)
        values[i] = 1.0
        columns.append(cheb.chebval(points, cheb.chebint(cheb.chebfit(points, values, n), lbnd=-1.0)) / 2)
    return (points + 1) / 2, np.array(columns).T


class Structure:
    """A circular axis of unit radius that begins at an angle and turns left (1) or right (-1), with its actions.

    ends: "pinned", "clamped" or "symmetric", where the axis crosses a line of symmetry with no force along the line but
    `pull`. point: arc length of a load down. dead: load down by length. ranges: where the foundation is. side: 1 where
    it reacts to movement to the left. relative: the drop is that of the end against the start, which is free.
    """

    def __init__(self, length, angle, turn, ends, EA, pull=0.0, point=None, dead=0.0, k=0.0, side=1.0, gap=0.0,
                 ranges=(), relative=False):
        self.length, self.angle, self.turn, self.ends, self.EA = length, angle, turn, ends, EA
        self.pull, self.point, self.dead = pull, point, dead
        self.k, self.side, self.gap, self.relative = k, side, gap, relative
        self.ranges = ranges if k else ()
        self.marks = sorted({0.0, length, *(end for r in self.ranges for end in r), *([point] if point else [])})
        self.monitor = point or length

    def axis(self, s):
        t = self.angle + self.turn * s
        start = 0.0 if self.relative else -np.sin(self.angle)
        return (start + (np.sin(t) - np.sin(self.angle)) / self.turn, -(np.cos(t) - np.cos(self.angle)) / self.turn, t)

    def penetration(self, fields, s):
        x, y, t = self.axis(s)
        return self.side * ((fields[Y] - y) * np.cos(t) - (fields[X] - x) * np.sin(t)) - self.gap

    def has_foundation(self, s):
        return any(a <= s <= b for a, b in self.ranges)

    def derivatives(self, fields, s, load, contact):
        """contact: "on", "off", or "sign" to take the sign of the penetration."""
        _, _, t, h, v, m = fields
        c, sn = np.cos(t), np.sin(t)
        e = (h * c + v * sn) / self.EA
        x1, y1 = (1 + e) * c, (1 + e) * sn
        fx, fy = 0 * t, -load * self.dead + 0 * t
        if contact != "off":
            p = self.penetration(fields, s)
            if contact == "sign":
                p = np.where(p.real > 0, p, 0)
            t0 = self.axis(s)[2]
            fx, fy = fx + self.side * self.k * p * np.sin(t0), fy - self.side * self.k * p * np.cos(t0)
        return np.array([x1, y1, self.turn + m, -fx, -fy, y1 * h - x1 * v])

    def end_conditions(self, fields, which, load):
        x, y, t = self.axis(0.0 if which == 0 else self.length)
        kind = self.ends[which]
        if kind == "pinned":
            return np.array([fields[X] - x, fields[Y] - y, fields[M]])
        if kind == "clamped":
            return np.array([fields[X] - x, fields[Y] - y, fields[T] - t])
        return np.array([fields[X] - x, fields[T] - t, fields[V] - load * self.pull])


class Pieces:
    """Collocation on pieces (start, end, contact); a start or end is a number, or "i" for the end of contact i."""

    def __init__(self, structure, pieces, n, free):
        self.structure, self.pieces, self.n, self.free = structure, pieces, n, np.array(free, float)
        self.block = 6 * (n + 1)
        self.size = len(pieces) * self.block + len(free) + 1

    def split(self, z):
        fields = z[:len(self.pieces) * self.block].reshape(len(self.pieces), 6, self.n + 1)
        return fields, z[len(self.pieces) * self.block:-1], z[-1]

    def bounds(self, free):
        return [tuple(free[int(e)] if isinstance(e, str) else e for e in piece[:2]) for piece in self.pieces]

    def unloaded(self):
        z = np.zeros(self.size)
        fields, free, _ = self.split(z)
        free[:] = self.free
        for f, (a, b) in zip(fields, self.bounds(self.free)):
            f[X], f[Y], f[T] = self.structure.axis(a + rule(self.n)[0] * (b - a))
        return z

    def inner_rows(self, z):
        """Residuals of the integrated equations of each piece."""
        tau, Q = rule(self.n)
        fields, free, load = self.split(z)
        out = []
        for f, (a, b), piece in zip(fields, self.bounds(free), self.pieces):
            d = self.structure.derivatives(f, a + tau * (b - a), load, piece[2])
            out.append((f - f[:, :1] - (b - a) * d @ Q.T)[:, 1:].ravel())
        return np.concatenate(out)

    def outer_rows(self, z, drop):
        """Residuals at the ends of the axis and of its pieces, at ends of contact, and of the drop."""
        s = self.structure
        fields, free, load = self.split(z)
        out = [s.end_conditions(fields[0][:, 0], 0, load), s.end_conditions(fields[-1][:, -1], 1, load)]
        for left, right, piece in zip(fields[:-1], fields[1:], self.pieces):
            jump = np.zeros(6, dtype=z.dtype)
            if s.point and piece[1] == s.point:
                jump[V] = -load
            out.append(left[:, -1] - right[:, 0] - jump)
        for f, piece in zip(fields, self.pieces):
            if isinstance(piece[1], str):
                out.append([s.penetration(f[:, -1], free[int(piece[1])])])
        at = next(i for i, piece in enumerate(self.pieces) if piece[1] == s.monitor)
        rest = s.axis(s.monitor)[1]
        moved = fields[at][Y, -1] - rest - ((fields[0][Y, 0] - s.axis(0.0)[1]) if s.relative else 0.0)
        return np.concatenate(out + [[moved + drop]])

    def matrix(self, z, drop):
        """Derivative of all residuals, by steps in the complex plane."""
        tau, Q = rule(self.n)
        fields, free, load = self.split(z)
        inner = len(self.pieces) * 6 * self.n
        blocks = []
        for f, (a, b), piece in zip(fields, self.bounds(free), self.pieces):
            block = np.zeros((6, self.n, 6, self.n + 1))
            for j in range(6):
                moved = f.astype(complex)
                moved[j] += TINY * 1j
                d = self.structure.derivatives(moved, a + tau * (b - a), load, piece[2]).imag / TINY
                block[:, :, j, :] = -(b - a) * Q[None, 1:, :] * d[:, None, :]
                block[j, :, j, :] += np.eye(self.n + 1)[1:]
                block[j, :, j, 0] -= 1.0
            blocks.append(block.reshape(6 * self.n, self.block))
        columns = {}
        ends = [i * self.block + f * (self.n + 1) + node for i in range(len(self.pieces)) for f in range(6)
                for node in (0, self.n)]
        scalars = list(range(len(self.pieces) * self.block, self.size))
        for j in ends + scalars:
            moved = z.astype(complex)
            moved[j] += TINY * 1j
            outer = self.outer_rows(moved, drop).imag / TINY
            of_inner = self.inner_rows(moved).imag / TINY if j in scalars else np.zeros(inner)
            columns[j] = np.concatenate([of_inner, outer])
        J = sparse.lil_matrix((self.size, self.size))
        J[:inner, :len(self.pieces) * self.block] = sparse.block_diag(blocks)
        for j, column in columns.items():
            rows = np.nonzero(column)[0]
            J[rows, j] = column[rows, None]
        return J.tocsc()

    def solve(self, z, drop, tolerance):
        for _ in range(200):
            residual = np.concatenate([self.inner_rows(z), self.outer_rows(z, drop)])
            step = sparse.linalg.splu(self.matrix(z, drop)).solve(residual)
            z = z - step
            change = np.abs(step).max() / (1 + abs(z[-1]))
            if change < tolerance:
                return z
            if not change < 1e6:
                break
        raise RuntimeError(f"Newton's method does not converge: {change:.1e}")


def crude(structure, step):
    """Collocation with signs by point, and (drop, solution) before, at and after the first largest load."""
    pieces = []
    for a, b in zip(structure.marks[:-1], structure.marks[1:]):
        parts = max(1, round(24 * (b - a) / structure.length))
        cuts = np.linspace(a, b, parts + 1)
        contact = "sign" if structure.has_foundation(0.5 * (a + b)) else "off"
        pieces += [(float(lo), float(hi), contact) for lo, hi in zip(cuts[:-1], cuts[1:])]
    mesh = Pieces(structure, pieces, 5, [])
    z = mesh.unloaded()
    if structure.relative:
        mesh.split(z)[0][:, Y, :] -= 1e-3  # contact at the bottom, so that something holds the ring
    found = []
    while len(found) < 3 or found[-2][1][-1] <= found[-1][1][-1]:
        if len(found) > 400:
            raise RuntimeError("no limit point")
        drop = step * (len(found) + 1)
        last = found[-1][1] if found else z
        try:
            following = mesh.solve(2 * last - found[-2][1] if len(found) > 1 else last, drop, 1e-8)
        except RuntimeError:
            following = mesh.solve(last, drop, 1e-8)
        found.append((drop, following))
    return mesh, found[-3:]


def refined(structure, mesh, z, n):
    """Pieces between the ends of contact of a crude solution, and its fields there."""
    fields, _, load = mesh.split(z)
    s = np.concatenate([a + rule(mesh.n)[0] * (b - a) for a, b, _ in mesh.pieces])
    values = np.concatenate(list(fields), axis=1)
    p = np.concatenate([structure.penetration(f, a + rule(mesh.n)[0] * (b - a))
                        for f, (a, b, _) in zip(fields, mesh.pieces)])
    free = [s[i] + (s[i + 1] - s[i]) * p[i] / (p[i] - p[i + 1]) for i in range(len(s) - 1)
            if (p[i] > 0) != (p[i + 1] > 0) and structure.has_foundation(0.5 * (s[i] + s[i + 1]))]
    free = [e for e in free if min(abs(e - mark) for mark in structure.marks) > 1e-7]
    cuts = sorted([(mark, mark) for mark in structure.marks] + [(e, str(i)) for i, e in enumerate(free)],
                  key=lambda cut: cut[0])
    pieces = []
    for (a, start), (b, end) in zip(cuts[:-1], cuts[1:]):
        middle = 0.5 * (a + b)
        touches = structure.has_foundation(middle) and np.interp(middle, s, p) > 0
        pieces.append((start, end, "on" if touches else "off"))
    out = Pieces(structure, pieces, n, free)
    guess = out.unloaded()
    for f, (a, b) in zip(out.split(guess)[0], out.bounds(free)):
        at = a + rule(n)[0] * (b - a)
        inside = (s >= a - 1e-9) & (s <= b + 1e-9)
        for i in range(6):
            f[i] = np.interp(at, s[inside], values[i][inside])
    guess[-1] = load
    return out, guess


def largest_load(structure, mesh, around, n, window, degree):
    """Maximum of the load over the drop, in a window of that part of the crude step to both sides."""
    (w0, z0), (w1, z1), (w2, z2) = around
    bend = z0[-1] - 2 * z1[-1] + z2[-1]
    top = w1 - 0.5 * (w1 - w0) * (z2[-1] - z0[-1]) / bend
    fine, z = refined(structure, mesh, mesh.solve(z1, top, 1e-8), n)
    z = fine.solve(z, top, 1e-11)
    points = np.sort(np.cos(np.pi * (np.arange(degree + 1) + 0.5) / (degree + 1)))
    for _ in range(3):
        loads = []
        for x in points:
            z = fine.solve(z, top + window * (w1 - w0) * x, 1e-11)
            loads.append(z[-1])
        series = cheb.chebfit(points, loads, degree)
        roots = [r.real for r in cheb.chebroots(cheb.chebder(series)) if abs(r.imag) < 1e-9 and abs(r.real) <= 1.0]
        if roots:
            best = min(roots, key=abs)
            check_signs(fine, fine.solve(z, top + window * (w1 - w0) * best, 1e-11))
            return cheb.chebval(best, series)
        top += window * (w1 - w0) * (1.0 if loads[-1] > loads[0] else -1.0)
    raise RuntimeError("no maximum in the window")


def check_signs(fine, z):
    fields, free, _ = fine.split(z)
    for f, (a, b), piece in zip(fields, fine.bounds(free), fine.pieces):
        if not fine.structure.has_foundation(0.5 * (a + b)):
            continue
        p = fine.structure.penetration(f, a + rule(fine.n)[0] * (b - a))[1:-1]
        if b <= a or (p < -1e-13 if piece[2] == "on" else p > 1e-13).any():
            raise RuntimeError("contact has another pattern")


def first_limit(structure, step):
    mesh, around = crude(structure, step)
    more = int(0.7 * structure.k ** 0.25 * structure.length)  # boundary layers of the foundation
    first = largest_load(structure, mesh, around, 24 + more, 0.25, 10)
    second = largest_load(structure, mesh, around, 34 + more, 0.18, 8)
    return second, abs(first / second - 1.0)


def arch(half_angle, ends, load, EA, k, side, gap, part):
    """Half of a symmetric arch, or all of one that is clamped at its left end only."""
    half = np.radians(half_angle)
    common = dict(k=k, side=-1.0 if side == "in" else 1.0, gap=gap)
    if ends == "clamped-pinned":
        return Structure(2 * half, half, -1.0, ("clamped", "pinned"), EA, point=half, ranges=[(0.0, 2 * half)],
                         **common), 0.02
    pull, dead = (-0.5, 0.0) if load == "crown" else (0.0, 1.0)
    ranges = [(part[0] * 2 * half, min(part[1] * 2 * half, half))]
    return Structure(half, half, -1.0, (ends, "symmetric"), EA, pull=pull, dead=dead, ranges=ranges,
                     **common), 0.03 * (1 - np.cos(half))


def ring(EA, k):
    return Structure(np.pi, 0.0, 1.0, ("symmetric", "symmetric"), EA, dead=1.0, k=k, side=-1.0, ranges=[(0.0, np.pi)],
                     relative=True), 0.01


WHOLE = (0.0, 1.0)
ARCHES = [  # half angle, ends, load, EA, k, side, gap, part of the arch from its end (and the same from its other end)
    (10, "clamped", "crown", 3e6, 0, "", 0, WHOLE),
    (10, "clamped", "crown", 3e6, 1e6, "out", 0, WHOLE),
    (10, "clamped", "crown", 3e6, 1e8, "out", 0, WHOLE),
    (10, "pinned", "crown", 3e6, 1e6, "out", 0, WHOLE),
    (10, "pinned", "crown", 3e6, 1e8, "out", 0, WHOLE),
    (10, "pinned", "crown", 3e6, 5000, "in", 0, WHOLE),
    (10, "pinned", "crown", 3e6, 15000, "in", 0, WHOLE),
    (10, "clamped", "weight", 3e6, 0, "", 0, WHOLE),
    (10, "pinned", "weight", 3e6, 0, "", 0, WHOLE),
    (10, "pinned", "weight", 3e6, 1e6, "out", 0, WHOLE),
    (20, "pinned", "crown", 100000, 0, "", 0, WHOLE),
    (20, "clamped", "crown", 100000, 0, "", 0, WHOLE),
    (20, "pinned", "crown", 100000, 10000, "out", 0, WHOLE),
    (20, "clamped", "crown", 100000, 30000, "out", 0, WHOLE),
    (20, "pinned", "crown", 100000, 1000, "in", 0, WHOLE),
    (20, "pinned", "crown", 100000, 100000, "out", 0.0002, WHOLE),
    (30, "pinned", "crown", 1e6, 0, "", 0, WHOLE),
    (30, "clamped", "crown", 1e6, 0, "", 0, WHOLE),
    (30, "pinned", "crown", 1e6, 1000, "out", 0, WHOLE),
    (30, "pinned", "crown", 1e6, 100000, "out", 0, WHOLE),
    (30, "clamped", "crown", 1e6, 10000, "out", 0.001, WHOLE),
    (45, "pinned", "crown", 100000, 0, "", 0, WHOLE),
    (45, "clamped", "crown", 100000, 0, "", 0, WHOLE),
    (45, "pinned", "crown", 100000, 1000, "out", 0, WHOLE),
    (45, "clamped", "crown", 100000, 10000, "out", 0, WHOLE),
    (45, "pinned", "crown", 100000, 10000, "out", 0.001, WHOLE),
    (90, "pinned", "crown", 100000, 0, "", 0, WHOLE),
    (90, "clamped", "crown", 100000, 0, "", 0, WHOLE),
    (90, "pinned", "crown", 100000, 300, "out", 0, WHOLE),
    (90, "pinned", "crown", 100000, 3000, "out", 0, WHOLE),
    (90, "clamped", "crown", 100000, 1000, "out", 0, WHOLE),
    (10, "pinned", "crown", 3e6, 1e7, "out", 0, (0, 0.3)),
    (30, "pinned", "crown", 1e6, 10000, "out", 0, (0, 0.25)),
    (30, "clamped", "crown", 1e6, 100000, "out", 0, (0.1, 0.4)),
    (10, "clamped", "weight", 3e6, 1e6, "out", 0, WHOLE),
    (20, "pinned", "weight", 100000, 10000, "out", 0, WHOLE),
    (30, "clamped", "weight", 1e6, 0, "", 0, WHOLE),
    (80, "clamped-pinned", "crown", 100000, 0, "", 0, WHOLE),
    (90, "clamped-pinned", "crown", 100000, 0, "", 0, WHOLE),
    (100, "clamped-pinned", "crown", 100000, 0, "", 0, WHOLE),
    (90, "clamped-pinned", "crown", 100000, 300, "out", 0, WHOLE),
    (90, "clamped-pinned", "crown", 100000, 3000, "out", 0, WHOLE),
    (100, "clamped-pinned", "crown", 100000, 300, "out", 0, WHOLE),
    (100, "clamped-pinned", "crown", 100000, 3000, "out", 0, WHOLE),
    (107.5, "clamped-pinned", "crown", 120000, 300, "out", 0, WHOLE),
    (117.5, "clamped-pinned", "crown", 120000, 3000, "out", 0, WHOLE),
    (100, "clamped-pinned", "crown", 100000, 1000, "out", 0.01, WHOLE),
]
RINGS = [(120000, 300), (120000, 600), (120000, 2500), (2000, 2500), (120000, 5000), (120000, 20000), (2000, 20000), (120000, 100000), (120000, 400000)]  # EA, k


def main():
    print("# First limit points of circular arches and of half rings, R = EI = 1, no shear; half angle in degrees. load: "
          "crown = point load down at the crown; weight = load down by length of the unloaded axis. One-sided foundation "
          "k along the fixed normals outside or inside, with a gap, on the part [from, to] of the arch and on the part as "
          "far from its other end. A ring is symmetric about the vertical and held by its foundation alone. Chebyshev "
          "collocation with free ends of contact (limits_of_arches.py), 11 digits.")
    print("shape,half_angle,ends,load,EA,k,side,gap,from,to,limit")
    cases = [("arch", *row, arch(*row)) for row in ARCHES]
    cases += [("ring", 180, "symmetric", "weight", EA, k, "out", 0.0, WHOLE, ring(EA, k)) for EA, k in RINGS]
    for shape, half_angle, ends, load, EA, k, side, gap, part, (structure, step) in cases:
        limit, difference = first_limit(structure, step)
        cells = [shape, f"{half_angle:g}", ends, load, f"{EA:g}", f"{k:g}", side, f"{gap:g}", *(f"{p:g}" for p in part)]
        print(",".join(cells) + f",{limit:.12g}", flush=True)
        print(*cells, f"{difference:.0e}", limit, file=sys.stderr)


main()
