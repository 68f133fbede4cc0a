"""Exact kinematics of statically determinate structures: no forces, so that strains are those imposed.

A structure is a set of bodies. A body is a tree of members that are rigidly joined; imposed strains give it a shape of
its own, which rigid motions of the body alone can move. Supports and hinges between bodies are as many equations as
the bodies have rigid motions, and Newton's method finds these.

A member keeps the intrinsic data of its axis: section angle phi0(s) = start_angle + turn s, turn = sweep / length.
With the axial strain e and the change of curvature k, both per undeformed length, as the solver defines them:

    angle(s) = angle at the start + (turn + k) s,    x'(s) = (1 + e) (cos angle, sin angle)
"""
import math


def chord(angle, turn, stretch, s):
    """Vector from the start to s of an axis that begins at an angle, turns by `turn` a length and is stretched."""
    half = 0.5 * turn * s
    ratio = 1.0 - half * half / 6.0 * (1.0 - half * half / 20.0)  # sin(half) / half, to 1e-19 below 1e-3
    if abs(half) > 1e-3:
        ratio = math.sin(half) / half
    size = stretch * s * ratio
    return size * math.cos(angle + half), size * math.sin(angle + half)


class Member:
    """Axis from node to node. `angle`: of its tangent at the start; `sweep`: by which it turns, radians."""

    def __init__(self, name, start, end, length, angle, sweep):
        self.name = name
        self.start = start
        self.end = end
        self.length = length
        self.angle = angle
        self.sweep = sweep
        self.axial = {"proportional": 0.0, "constant": 0.0}
        self.curvature = {"proportional": 0.0, "constant": 0.0}

    def strains(self, factors):
        """Axial strain and curvature under factors {pattern: factor}."""
        return tuple(sum(factors[pattern] * part[pattern] for pattern in factors)
                     for part in (self.axial, self.curvature))

    def turn(self):
        return self.sweep / self.length


class Body:
    """A tree of members that are rigidly joined, from its root on. Each member begins at a node that is there."""

    def __init__(self, root):
        self.root = root
        self.members = []

    def nodes(self):
        return [self.root] + [member.end for member in self.members]


class Pose:
    """Where a body is: displacement of its root, and its rotation there."""

    def __init__(self, u, v, rotation):
        self.u = u
        self.v = v
        self.rotation = rotation


class LargeShape:
    """A strained body with displacements of any size."""

    def __init__(self, body, factors):
        self.body = body
        self.factors = factors

    def nodes(self, pose):
        """Displacement and rotation (u, v, rotation) of each node of the body."""
        out = {self.body.root: (pose.u, pose.v, pose.rotation)}
        for member in self.body.members:
            out[member.end] = self.point(member, member.length, out[member.start])
        return out

    def point(self, member, s, start):
        """Displacement and rotation at s of a member from those of its start."""
        axial, curvature = member.strains(self.factors)
        u, v, rotation = start
        old = chord(member.angle, member.turn(), 1.0, s)
        new = chord(member.angle + rotation, member.turn() + curvature, 1.0 + axial, s)
        return u + new[0] - old[0], v + new[1] - old[1], rotation + curvature * s


class SmallShape(LargeShape):
    """The same with displacements that are linearised about the undeformed axis."""

    def point(self, member, s, start):
        axial, curvature = member.strains(self.factors)
        u, v, rotation = start
        x, y = chord(member.angle, member.turn(), 1.0, s)
        mx, my = moment_of_chord(member.angle, member.turn(), s)
        # u' = e t + b n with b = rotation + k s: the integral of s n is the moment turned by 90 degrees
        return (u + axial * x - rotation * y - curvature * my, v + axial * y + rotation * x + curvature * mx,
                rotation + curvature * s)


def moment_of_chord(angle, turn, s):
    """Integral of r t(r) over r from 0 to s, t the unit tangent."""
    a = turn * s
    if abs(a) > 0.5:
        # integral of r exp(i (angle + turn r)) in closed form
        c1, s1 = math.cos(a), math.sin(a)
        real = (c1 + a * s1 - 1.0) / turn ** 2
        imaginary = (s1 - a * c1) / turn ** 2
    else:
        real = imaginary = 0.0
        term = s * s  # s^2 (i a)^n / n!, over n + 2
        for n in range(24):
            value = term / (n + 2)
            real += (value, 0.0, -value, 0.0)[n % 4]
            imaginary += (0.0, value, 0.0, -value)[n % 4]
            term *= a / (n + 1)
    c, s_ = math.cos(angle), math.sin(angle)
    return c * real - s_ * imaginary, s_ * real + c * imaginary


class Support:
    """A node's fixed components along axes turned by `angle` (radians), and the displacements imposed on them."""

    def __init__(self, node, fixed, angle):
        self.node = node
        self.fixed = fixed
        self.angle = angle
        self.displacement = {}
        self.pattern = "proportional"

    def gaps(self, motion, factors):
        """What a motion (u, v, rotation) of the node misses of the fixed components."""
        c, s = math.cos(self.angle), math.sin(self.angle)
        local = {"x": c * motion[0] + s * motion[1], "y": -s * motion[0] + c * motion[1], "rotation": motion[2]}
        return [local[name] - factors[self.pattern] * self.displacement.get(name, 0.0) for name in self.fixed]


class Singular(Exception):
    """The equations of the supports have no unique solution: a mechanism, or nearly one."""


def solve(matrix, columns):
    """matrix^-1 columns by elimination with partial pivots; lists of rows."""
    n = len(matrix)
    rows = [list(matrix[i]) + list(columns[i]) for i in range(n)]
    for k in range(n):
        pivot = max(range(k, n), key=lambda i: abs(rows[i][k]))
        if rows[pivot][k] == 0.0:
            raise Singular()
        rows[k], rows[pivot] = rows[pivot], rows[k]
        for i in range(n):
            if i != k and rows[i][k] != 0.0:
                share = rows[i][k] / rows[k][k]
                rows[i] = [a - share * b for a, b in zip(rows[i], rows[k])]
    return [[value / rows[k][k] for value in rows[k][n:]] for k in range(n)]


class Structure:
    """Bodies with as many supports and hinges as they have rigid motions."""

    def __init__(self, bodies, places, supports, hinges, size):
        """
        places: node to (x, y); hinges: pairs of (body, node), (body, node) at one place
        size: extent, the unit of lengths in equations
        """
        self.bodies = bodies
        self.places = places
        self.supports = supports
        self.hinges = hinges
        self.size = size
        self.linear = False

    def members(self):
        return [member for body in self.bodies for member in body.members]

    def shapes(self, factors):
        kind = SmallShape if self.linear else LargeShape
        return [kind(body, factors) for body in self.bodies]

    def body_of(self, node):
        return next(i for i, body in enumerate(self.bodies) if node in body.nodes())

    def gaps(self, motions, factors):
        """What supports and hinges miss, lengths over the size."""
        out = []
        for support in self.supports:
            values = support.gaps(motions[self.body_of(support.node)][support.node], factors)
            out += [value if name == "rotation" else value / self.size for name, value in zip(support.fixed, values)]
        for (a, node_a), (b, node_b) in self.hinges:
            out += [(motions[a][node_a][c] - motions[b][node_b][c]) / self.size for c in range(2)]
        return out

    def jacobian(self, motions):
        """Rates of the gaps with the bodies' rigid motions: translations over the size, rotations about the roots."""
        nothing = {pattern: 0.0 for pattern in ("proportional", "constant")}
        columns = []
        for body in range(len(self.bodies)):
            for component in range(3):
                rates = [{node: (0.0, 0.0, 0.0) for node in one.nodes()} for one in self.bodies]
                for node in self.bodies[body].nodes():
                    rates[body][node] = self.rate(body, component, node, motions[body])
                columns.append(self.gaps(rates, nothing))
        return [list(row) for row in zip(*columns)]

    def rate(self, body, component, node, motions):
        """Motion of a node by a unit rigid motion of its body."""
        if component < 2:
            return (self.size, 0.0, 0.0) if component == 0 else (0.0, self.size, 0.0)
        root = self.bodies[body].root
        arm = [self.places[node][c] - self.places[root][c] for c in range(2)]
        if not self.linear:
            arm = [arm[c] + motions[node][c] - motions[root][c] for c in range(2)]
        return -arm[1], arm[0], 1.0

    def settle(self, poses, factors, worst):
        """Newton's method from poses near the ones sought."""
        shapes = self.shapes(factors)
        last = math.inf
        for _ in range(30):
            motions = [shape.nodes(pose) for shape, pose in zip(shapes, poses)]
            matrix = self.jacobian(motions)
            n = len(matrix)
            if n != 3 * len(self.bodies):
                raise Singular()
            gaps = self.gaps(motions, factors)
            both = solve(matrix, [[-gap] + [float(i == j) for j in range(n)] for i, gap in enumerate(gaps)])
            if max(sum(map(abs, row[1:])) for row in both) > worst:
                raise Singular()
            step = [row[0] for row in both]
            poses = [Pose(pose.u + self.size * step[3 * i], pose.v + self.size * step[3 * i + 1],
                          pose.rotation + step[3 * i + 2]) for i, pose in enumerate(poses)]
            size = max(map(abs, step))
            if size <= 1e-16 or (size < 1e-12 and size > 0.5 * last):
                return poses
            last = size
        raise Singular()

    def poses(self, factor, steps=16, worst=20.0):
        """Poses of the bodies at a load factor, followed from the undeformed structure: constant actions first.

        Raises Singular where a unit gap moves a body by more than `worst`: near to a mechanism.
        """
        poses = [Pose(0.0, 0.0, 0.0) for _ in self.bodies]
        way = [(0.0, (k + 1) / steps) for k in range(steps)]
        way += [(factor * (k + 1) / steps, 1.0) for k in range(steps)]
        for proportional, constant in way:
            poses = self.settle(poses, {"proportional": proportional, "constant": constant}, worst)
        return poses

    def displacements(self, factor, fractions):
        """(u, v, rotation) at fractions of each member's length at a load factor, by the member's name."""
        factors = {"proportional": factor, "constant": 1.0}
        out = {}
        for shape, pose in zip(self.shapes(factors), self.poses(factor)):
            motions = shape.nodes(pose)
            for member in shape.body.members:
                out[member.name] = [shape.point(member, f * member.length, motions[member.start]) for f in fractions]
        return out
