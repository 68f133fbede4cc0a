#!/usr/bin/env python3
"""Heads of the piles of tests/howto/lateral_piles.py by finite elements of their own.

  lateral_piles.py [ELEMENTS]   prints displacement, force and moment of each head (default: 400 elements)

EI v'''' + P v'' + p(X, v) = 0 with cubic elements, four points of quadrature each, and Newton's method; p by the formulas
of the papers at every point: soft clay of Matlock (1970) with a straight line up to 0.001 y50, sand of Reese, Cox and Koop
(1974), stiff clay under water of Reese, Cox and Koop (1975). Small displacements. Needs the standard library alone; shares
no code with the solver.
"""
import bisect
import math
import sys

POINTS = [(-0.8611363115940526, 0.3478548451374538), (-0.3399810435848563, 0.6521451548625461),
          (0.3399810435848563, 0.6521451548625461), (0.8611363115940526, 0.3478548451374538)]
FIRST = 0.001  # y/y50 at the end of the line by which a cube root begins
# Figures of Reese, Cox and Koop (1974) for cyclic loads, read at X/D, as docs/howto/soil-curves.md has them.
DEPTHS = [0, 0.5, 1, 1.5, 2, 2.5, 3, 4, 5]
A_CYCLIC = [0.75, 0.91, 1.06, 1.08, 1.01, 0.97, 0.93, 0.88, 0.88]
B_CYCLIC = [0.50, 0.71, 0.84, 0.86, 0.82, 0.78, 0.69, 0.56, 0.55]


def between(x, xs, ys):
    """Piecewise linear, constant outside."""
    i = min(max(bisect.bisect_right(xs, x), 1), len(xs) - 1)
    t = min(max((x - xs[i - 1]) / (xs[i] - xs[i - 1]), 0), 1)
    return ys[i - 1] + t * (ys[i] - ys[i - 1])


class Ground:
    """Layers (top, bottom, effective unit weight, strength at top and bottom or nothing, law)."""

    def __init__(self, layers, factor=1.0):
        self.layers, self.factor = layers, factor

    def law(self, X):
        """y >= 0 to (p, dp/dy) at a depth."""
        s = held = clay = 0.0
        for top, bottom, weight, strength, law in self.layers:
            end = min(X, bottom)
            Su = strength and strength[0] + (strength[1] - strength[0]) * (end - top) / (bottom - top)
            s += weight * (end - top)
            if strength:
                held, clay = held + (strength[0] + Su) / 2 * (end - top), clay + end - top
            if X <= bottom:
                return law(X, s, Su, held / clay if held else Su)
        raise ValueError("the ground does not reach so deep")


def power(y, p, end, exponent):
    """p (y/end)^exponent with its slope"""
    value = p * (y / end) ** exponent
    return value, exponent * value / y


def soft_clay(D, eps50, J, cyclic=False):
    y50 = 2.5 * eps50 * D

    def at(X, s, Su, _):
        most, gain = 9 * Su * D, s * D + J * Su * X
        most, ratio = min(3 * Su * D + gain, most), min(gain / (6 * Su * D), 1)
        first = FIRST * y50, most * 0.5 * FIRST ** (1 / 3)

        def law(y):
            t = y / y50
            if t <= FIRST:
                return first[1] * y / first[0], first[1] / first[0]
            if not cyclic:
                return power(y, most, 8 * y50, 1 / 3) if t < 8 else (most, 0.0)
            if t < 8 * 0.72**3:
                return power(y, most, 8 * y50, 1 / 3)
            fall = 0.72 * most * (1 - ratio) / 12
            t = min(max(t, 3), 15)
            return 0.72 * most - fall * (t - 3), -fall / y50 if 3 < t < 15 else 0.0

        return law

    return at


def sand(D, phi, k):
    """Cyclic loads."""
    f = math.radians(phi)
    a, b, K0, Ka, t = f / 2, math.pi / 4 + f / 2, 0.4, math.tan(math.pi / 4 - f / 2) ** 2, math.tan

    def at(X, s, *_):
        wedge = s * (K0 * X * t(f) * math.sin(b) / (t(b - f) * math.cos(a)) + t(b) / t(b - f) * (D + X * t(b) * t(a))
                     + K0 * X * t(b) * (t(f) * math.sin(b) - t(a)) - Ka * D)
        flow = Ka * D * s * (t(b) ** 8 - 1) + K0 * D * s * t(f) * t(b) ** 4
        pu = between(X / D, DEPTHS, A_CYCLIC) * min(wedge, flow)
        pm = between(X / D, DEPTHS, B_CYCLIC) * min(wedge, flow)
        yu, ym = 3 * D / 80, D / 60
        slope = (pu - pm) / (yu - ym)

        def law(y):
            if y >= yu:
                p = pu, 0.0
            elif y >= ym:
                p = pm + slope * (y - ym), slope
            else:
                p = power(max(y, 1e-12 * D), pm, ym, slope * ym / pm)
            return p if p[0] < k * X * y else (k * X * y, k * X)

        return law

    return at


def stiff_clay_free_water(D, eps50, k):
    """Cyclic loads."""
    y50 = eps50 * D

    def at(X, s, Su, mean):
        pc = min((2 * mean + s) * D + 2.83 * mean * X, 11 * Su * D)
        A = 0.2 + 0.1 * math.tanh(1.5 * X / D)
        yp = 4.1 * A * y50

        def law(y):
            if y <= 0.6 * yp:
                u = y / (0.45 * yp) - 1
                p = A * pc * (1 - abs(u) ** 2.5), -2.5 * A * pc * math.copysign(abs(u) ** 1.5, u) / (0.45 * yp)
            else:
                z = min(y, 1.8 * yp)
                fall = 0.085 * pc / y50
                p = A * pc * (1 - (1 / 3) ** 2.5) - fall * (z - 0.6 * yp), -fall if y < 1.8 * yp else 0.0
            return p if p[0] < k * X * y else (k * X * y, k * X)

        return law

    return at


class Pile:
    """Elements downwards from the head; unknowns (v, v') of each node."""

    def __init__(self, EI, head, tip, ground, breaks=(), axial=0.0, turns=True, elements=400):
        self.EI, self.axial, self.turns = EI, axial, turns
        places, self.nodes = sorted({head, tip, *(b for b in (0.0, *breaks) if head < b < tip)}), [head]
        for a, b in zip(places, places[1:]):
            n = max(round(elements * (b - a) / (tip - head)), 1)
            self.nodes += [a + (b - a) * (i + 1) / n for i in range(n)]
        self.parts = []
        for a, b in zip(self.nodes, self.nodes[1:]):
            points = []
            for g, w in POINTS if a >= 0 else ():
                t = (1 + g) / 2
                shape = 1 - 3 * t**2 + 2 * t**3, (b - a) * t * (1 - t) ** 2, 3 * t**2 - 2 * t**3, (b - a) * (t**3 - t**2)
                points.append((ground.factor * w * (b - a) / 2, shape, ground.law(a + (b - a) * t)))
            self.parts.append((self.elastic(b - a), points))

    def elastic(self, h):
        c, g = self.EI / h**3, self.axial / (30 * h)
        bend = [[12, 6 * h, -12, 6 * h], [6 * h, 4 * h * h, -6 * h, 2 * h * h],
                [-12, -6 * h, 12, -6 * h], [6 * h, 2 * h * h, -6 * h, 4 * h * h]]
        turn = [[36, 3 * h, -36, 3 * h], [3 * h, 4 * h * h, -3 * h, -h * h],
                [-36, -3 * h, 36, -3 * h], [3 * h, -h * h, -3 * h, 4 * h * h]]
        return [[c * bend[i][j] - g * turn[i][j] for j in range(4)] for i in range(4)]

    def assemble(self, u):
        """(internal forces, upper band of their stiffness)"""
        force, band = [0.0] * len(u), [[0.0] * 4 for _ in u]
        for e, (elastic, points) in enumerate(self.parts):
            v = u[2 * e:2 * e + 4]
            K, f = [row[:] for row in elastic], [sum(a * b for a, b in zip(row, v)) for row in elastic]
            for weight, shape, law in points:
                y = sum(a * b for a, b in zip(shape, v))
                p, slope = law(abs(y))
                for i, a in enumerate(shape):
                    f[i] += weight * a * math.copysign(p, y)
                    for j in range(i, 4):
                        K[i][j] += weight * slope * a * shape[j]
            for i in range(4):
                force[2 * e + i] += f[i]
                for j in range(i, 4):
                    band[2 * e + i][j - i] += K[i][j]
        return force, band

    def solve(self, u, load=None, displacement=None):
        """(unknowns, force, moment) of a head under a load or at a displacement, from another equilibrium"""
        u, given = u[:], ([0] if load is None else []) + ([] if self.turns else [1])
        if load is None:
            u[0] = displacement

        def rest(w):
            force, band = self.assemble(w)
            head = force[:2]
            force[0] -= load or 0.0
            for i in given:
                force[i] = 0.0
            return force, band, head

        force, band, head = rest(u)
        for _ in range(200):
            step = self.descend(band, force, given)
            size, t = max(map(abs, force)), 1.0
            if max(map(abs, step[::2])) < 1e-8 * max(map(abs, u[::2])):
                return u, *head
            while True:
                trial = [a + t * b for a, b in zip(u, step)]
                force, band, head = rest(trial)
                if t < 0.02 or max(map(abs, force)) < size:
                    break
                t /= 2
            u = trial
        raise RuntimeError("no equilibrium")

    @staticmethod
    def descend(band, force, given):
        """Solution of band x = -force, x = 0 for what is given."""
        band, x = [row[:] for row in band], [-f for f in force]
        for i in given:
            x[i], band[i] = 0.0, [1.0, 0.0, 0.0, 0.0]
            for j in range(1, min(i, 3) + 1):
                band[i - j][j] = 0.0
        for i, row in enumerate(band):
            for j in range(1, min(4, len(x) - i)):
                factor = row[j] / row[0]
                x[i + j] -= factor * x[i]
                for k in range(j, 4):
                    band[i + j][k - j] -= factor * row[k]
        for i in reversed(range(len(x))):
            x[i] = (x[i] - sum(band[i][j] * x[i + j] for j in range(1, min(4, len(x) - i)))) / band[i][0]
        return x

    def heads(self, loads=(), displacements=()):
        """[(displacement, force, moment)] of the head"""
        u, found, length = [0.0] * (2 * len(self.nodes)), [], self.nodes[-1] - self.nodes[0]
        if displacements:
            slope = -1.3 * displacements[0] / length
            for i, x in enumerate(self.nodes):
                u[2 * i:2 * i + 2] = displacements[0] + slope * (x - self.nodes[0]), slope
        else:
            u[::2] = [1e-6 * length] * len(self.nodes)
        last = 0.0
        for load in loads:
            for i in range(1, 5):
                u, _, moment = self.solve(u, load=last + (load - last) * i / 4)
            last = load
            found.append((u[0], load, moment))
        for displacement in displacements:
            u, force, moment = self.solve(u, displacement=displacement)
            found.append((displacement, force, moment))
        return found


def tube(D, t):
    return math.pi / 64 * (D**4 - (D - 2 * t) ** 4)


def crossing(f, a, b):
    """Where f is zero."""
    for _ in range(80):
        a, b = ((a + b) / 2, b) if f(a) * f((a + b) / 2) > 0 else (a, (a + b) / 2)
    return a


def model_pile(elements):
    """Aluminium tube, 4 in, in clay of 0 to 60 lb/ft2; in, lb."""
    D, strength = 4.0, (0.01 / 144, 60 / 144)
    ground = Ground([(0, 40, 40 / 1728, strength, soft_clay(D, 0.02, 0.5))])
    pile = Pile(69e9 / 6894.757293168 * tube(D, 0.125), -20.0, 32.0, ground, elements=elements)
    return pile.heads(displacements=[0.01, 0.05, 0.125, 0.25, 0.5, 1, 2, 4, 8])


def sabine(elements, E):
    """Steel pipe, 12.75 in, in clay; m, kN; E in kPa."""
    D, g = 12.75 / 39.4, 0.304
    Su = lambda X: 9.58 + (33.52 - 9.58) * X / (15.23 - g)
    deep = crossing(lambda X: (10 * X - 6 * Su(X)) * D + 0.5 * Su(X) * X, 0, 12)
    ground = Ground([(0, 15.23 - g, 10.0, (9.58, 33.52), soft_clay(D, 0.02, 0.5))])
    pile = Pile(E * tube(D, 0.5 / 39.4), -g, 516 / 39.4 - g, ground, [deep], elements=elements)
    return pile.heads(displacements=[0.0254 * y for y in (0.04, 0.13, 0.62, 1.39, 2.80, 4.11, 5.64)])


def sabine_printed(elements):
    """The pile of sabine() on the p-y curves MM-1 of Senanayake (2016) for a smooth pile without a gap; m, kN."""
    D, g, eps50 = 12.75 / 39.4, 0.304, 0.01
    Su = lambda X: 9.58 + (33.52 - 9.58) * X / (15.23 - g)
    shallow = lambda X: 4 * Su(X) + (Su(0.01) + Su(X)) * 2 * math.sqrt(2) * X / D
    clay = soft_clay(D, eps50, 0.0)  # at no depth and stress 9 Su D is not reached: Pmax = 3 Su D
    ground = Ground([(0, 15.23 - g, 0.0, (9.58, 33.52), lambda X, s, *_: clay(X, s, min(shallow(X), 9 * Su(X)) / 3, 0))])
    deep = crossing(lambda X: shallow(X) - 9 * Su(X), 0, 1)
    pile = Pile(2.1e8 * tube(D, 0.5 / 39.4), -g, 516 / 39.4 - g, ground, [deep], elements=elements)
    return pile.heads(displacements=[0.033])


def north_abutment(elements, factor):
    """H-pile in sand; in, lb."""
    D, pcf = 12.2, 1 / 1728
    ground = Ground([(0, 120, 105 * pcf, None, sand(D, 33, 25)), (120, 240, 42.6 * pcf, None, sand(D, 33, 20)),
                     (240, 540, 49.6 * pcf, None, sand(D, 36, 60))], factor)
    pile = Pile(29e6 * 569, 0.0, 540.0, ground, [120, 240, *(D * d for d in DEPTHS)], 323e3, False, elements)
    return pile.heads(loads=[1e3 * V for V in (20, 30, 40, 45, 47, 50, 55, 60)])


SOUTH = [(0, 60, 110, 650, 658), (60, 72, 47.6, 658, 660), (72, 132, 47.6, 660, 680), (132, 192, 47.6, 680, 700),
         (192, 252, 47.6, 700, 720), (252, 300, 47.6, 720, 736)]


def south_abutment(elements, factor, loads):
    """H-pile in clay, its head 60 in below the surface; in, lb."""
    D, top = 12.2, 60.0
    clay = soft_clay(D, 0.01, 0.5, cyclic=True)
    layers = [(a, b, w / 1728, (c / 144, d / 144), clay) for a, b, w, c, d in SOUTH]
    layers.append((300, 540, 61.6 / 1728, (1790 / 144, 2000 / 144), stiff_clay_free_water(D, 0.007, 200)))
    pile = Pile(29e6 * 569, top, 360 + top, Ground(layers, factor), [a for a, *_ in layers[1:]], 238e3, False, elements)
    return pile.heads(loads=[1e3 * V for V in loads])


if __name__ == "__main__":
    N = int(sys.argv[1]) if len(sys.argv) > 1 else 400
    FRONT, REAR = [15, 30, 35, 36, 37, 38, 40, 42, 50], [15, 30, 35, 36, 37, 38, 40, 42]
    for name, heads in (("model pile", model_pile(N)), ("Sabine, 210 GPa", sabine(N, 2.1e8)),
                        ("Sabine, 29e6 psi", sabine(N, 29e6 * 6.894757293168)),
                        ("Sabine, MM-1", sabine_printed(N)),
                        ("north abutment, 0.9", north_abutment(N, 0.9)),
                        ("north abutment, 0.625", north_abutment(N, 0.625)),
                        ("south abutment, 0.9", south_abutment(N, 0.9, FRONT)),
                        ("south abutment, 0.625", south_abutment(N, 0.625, REAR))):
        for displacement, force, moment in heads:
            turning = f", moment {abs(moment):.6g}" if "abutment" in name else ""
            print(f"{name}: displacement {displacement:.6g}, force {force:.6g}{turning}")
