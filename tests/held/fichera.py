"""Whether one-sided supports can carry the loads of a request: Fichera's condition, from the drawing alone.

A body is a group of members that are joined without hinges. Its motion is (a, b, w): the point (x, y) moves by
(a - w y, b + w x). V are the motions of all bodies that hinges, supports and bilateral springs and bases allow; the wrench g of
each one-sided support is a row with g.v = motion into it; K = {v in V: g.v <= 0 for all g}. Loads f are held if f.v <= 0 on K, and
f.v = 0 only where -v is in K, too. By Farkas' lemma that says: f lies in the relative interior of the cone of the wrenches g. With
g0 the sum of the unit wrenches, which is an inner point, the margin is the largest e with f - e g0 in the cone, over |f|.

Lines and circular arcs only. A base along the normal of an arc presses with wrenches between those of its ends, or round the
whole plane: samples at most 60 degrees apart span the same cone. In a fixed direction the lever arm is largest at an end or
where the tangent is parallel to the direction.
"""
import math

import small_program as lp

INFINITE = math.inf


class Axis:
    """Axis of a member: a line or a circular arc."""

    def __init__(self, start, end, sweep):
        chord = (end[0] - start[0], end[1] - start[1])
        self.start = start
        self.sweep = sweep
        self.heading = math.atan2(chord[1], chord[0]) - sweep / 2
        half = sweep / 2
        self.length = math.hypot(*chord) * (half / math.sin(half) if sweep else 1.0)

    def angle(self, fraction):
        return self.heading + self.sweep * fraction

    def point(self, fraction):
        if not self.sweep:
            s = self.length * fraction
            return (self.start[0] + s * math.cos(self.heading), self.start[1] + s * math.sin(self.heading))
        radius = self.length / self.sweep
        a0, a1 = self.heading, self.angle(fraction)
        return (self.start[0] + radius * (math.sin(a1) - math.sin(a0)),
                self.start[1] - radius * (math.cos(a1) - math.cos(a0)))

    def normal(self, fraction):
        a = self.angle(fraction)
        return (-math.sin(a), math.cos(a))

    def fractions(self, low, high, direction):
        """Where on a part of the axis the extreme wrenches of a base act."""
        if not self.sweep:
            return [low, high]
        pieces = max(1, math.ceil(abs(self.sweep) * (high - low) / (math.pi / 3)))
        found = [low + (high - low) * i / pieces for i in range(pieces + 1)]
        if direction is not None:
            base = math.atan2(direction[1], direction[0]) - self.heading
            turns = range(-5, 6)
            found += [f for f in ((base + math.pi * k) / self.sweep for k in turns) if low < f < high]
        return found


class Drawing:
    """Bodies, hinges, supports and loads of the model of a request."""

    def __init__(self, model):
        self.model = model
        self.nodes = {node["id"]: (node["x"], node["y"]) for node in model["nodes"]}
        self.size = max(max(abs(p[0] - q[0]), abs(p[1] - q[1])) for p in self.nodes.values() for q in self.nodes.values())
        self.centre = tuple(sum(p[i] for p in self.nodes.values()) / len(self.nodes) for i in (0, 1))
        self.axes = {}
        for member in model["members"]:
            sweep = math.radians(member.get("curve", {}).get("sweep_degrees", 0.0))
            self.axes[member["id"]] = Axis(self.nodes[member["start"]], self.nodes[member["end"]], sweep)
        self.find_bodies()

    def find_bodies(self):
        """body[member]; node_bodies[node]: bodies that meet there; node_rotation[node]: the body that turns the node."""
        parent = {member["id"]: member["id"] for member in self.model["members"]}

        def root(name):
            while parent[name] != name:
                name = parent[name]
            return name

        rigid = {}
        for member in self.model["members"]:
            for end in ("start", "end"):
                if not member.get("release", {}).get(end):
                    node = member[end]
                    if node in rigid:
                        parent[root(member["id"])] = root(rigid[node])
                    rigid[node] = member["id"]
        names = sorted({root(name) for name in parent})
        self.body = {name: names.index(root(name)) for name in parent}
        self.bodies = len(names)
        self.node_rotation = {node: self.body[name] for node, name in rigid.items()}
        self.node_bodies = {}
        for member in self.model["members"]:
            for end in ("start", "end"):
                self.node_bodies.setdefault(member[end], set()).add(self.body[member["id"]])

    def local(self, point):
        return ((point[0] - self.centre[0]) / self.size, (point[1] - self.centre[1]) / self.size)

    def row(self, body, point, direction, moment=0.0):
        """Work of a force (or of a moment, in force times model size) on the motion of a body."""
        x, y = self.local(point)
        row = [0.0] * (3 * self.bodies)
        row[3 * body:3 * body + 3] = [direction[0], direction[1], x * direction[1] - y * direction[0] + moment]
        return row

    def place(self, at):
        """Body, position and left normal at a LOCATION; the body is the one whose rotation the place has."""
        if "node" in at:
            node = at["node"]
            return self.node_rotation.get(node, min(self.node_bodies[node])), self.nodes[node], None
        axis = self.axes[at["member"]]
        return self.body[at["member"]], axis.point(at["fraction"]), axis.normal(at["fraction"])

    def equalities(self):
        rows = []
        for node, bodies in self.node_bodies.items():
            first, *others = sorted(bodies)
            for other in others:
                for direction in ((1, 0), (0, 1)):
                    a = self.row(first, self.nodes[node], direction)
                    b = self.row(other, self.nodes[node], direction)
                    rows.append([x - y for x, y in zip(a, b)])
        for support in self.model.get("supports", []):
            body, point, _ = self.place({"node": support["node"]})
            angle = math.radians(support.get("angle_degrees", 0.0))
            axes = {"x": (math.cos(angle), math.sin(angle)), "y": (-math.sin(angle), math.cos(angle))}
            for fixed in support["fixed"]:
                rows.append(self.row(body, point, axes[fixed]) if fixed in axes else self.row(body, point, (0, 0), 1.0))
        return rows + [row for sign, row in self.springs_and_bases() if sign == 0]

    def wrenches(self):
        """Rows g with g.v > 0 for a motion into a one-sided support."""
        return [[sign * x for x in row] for sign, row in self.springs_and_bases() if sign]

    def springs_and_bases(self):
        signs = {"bilateral": 0, "compression_only": 1, "tension_only": -1}
        for spring in self.model.get("springs", []):
            body, point, _ = self.place(spring["at"])
            sign = signs[spring.get("reaction", "bilateral")]
            direction = spring["direction"]
            if spring["stiffness"] == 0:
                continue
            if direction == "rotation":
                yield sign, self.row(body, point, (0, 0), 1.0)
            else:
                size = math.hypot(*direction)
                yield sign, self.row(body, point, (direction[0] / size, direction[1] / size))
        for base in self.model.get("foundations", []):
            if base["stiffness"] == 0:
                continue
            axis = self.axes[base["member"]]
            fixed = base.get("direction", "normal")
            fixed = None if fixed == "normal" else tuple(x / math.hypot(*fixed) for x in fixed)
            side = -1 if base.get("side", "left") == "right" else 1
            for f in axis.fractions(*base.get("range", [0, 1]), fixed):
                n = fixed or tuple(side * x for x in axis.normal(f))
                yield signs[base.get("reaction", "bilateral")], self.row(self.body[base["member"]], axis.point(f), n)

    def load(self, load):
        """Work of a load on unit motions of all bodies."""
        if load["type"] == "point":
            body, point, _ = self.place(load["at"])
            return self.row(body, point, load["force"], load.get("moment", 0.0) / self.size)
        if load["type"] == "initial_strain":
            return [0.0] * (3 * self.bodies)
        axis = self.axes[load["member"]]
        body = self.body[load["member"]]
        if load["type"] == "pressure":
            side = 1 if load.get("side", "left") == "left" else -1
            return self.pressure(body, axis, side * load["value"])
        return self.distributed(body, axis, load)

    def pressure(self, body, axis, p):
        """p (y', -x') ds along the whole member, in closed form: p (dy, -dx), moment -p/2 [x^2 + y^2]."""
        (x0, y0), (x1, y1) = axis.point(0), axis.point(1)
        (a0, b0), (a1, b1) = self.local((x0, y0)), self.local((x1, y1))
        row = [0.0] * (3 * self.bodies)
        row[3 * body:3 * body + 3] = [p * (y1 - y0), -p * (x1 - x0),
                                      -p * self.size / 2 * (a1 * a1 + b1 * b1 - a0 * a0 - b0 * b0)]
        return row

    def distributed(self, body, axis, load):
        """Gauss' rule of three points on 200 pieces: exact on lines, to rounding on arcs."""
        low, high = load.get("range", [0, 1])
        pieces = 200 if axis.sweep else 1
        row = [0.0] * (3 * self.bodies)
        for i in range(pieces):
            for place, weight in ((0.5 - 0.15 ** 0.5, 5 / 18), (0.5, 4 / 9), (0.5 + 0.15 ** 0.5, 5 / 18)):
                f = low + (high - low) * (i + place) / pieces
                ds = axis.length * (high - low) / pieces * weight
                share = {"length": 1.0, "horizontal": abs(math.cos(axis.angle(f))),
                         "vertical": abs(math.sin(axis.angle(f)))}[load.get("per", "length")]
                part = self.row(body, axis.point(f), [q * ds * share for q in load["force"]])
                row = [a + b for a, b in zip(row, part)]
        return row

    def loads(self, pattern):
        total = [0.0] * (3 * self.bodies)
        for load in self.model.get("loads", []):
            if load.get("pattern", "proportional") == pattern:
                total = [a + b for a, b in zip(total, self.load(load))]
        return total


class Condition:
    """Free motions and contact wrenches of a model, by parts that are not connected."""

    def __init__(self, model):
        self.drawing = Drawing(model)
        self.basis = lp.null_space(self.drawing.equalities(), 3 * self.drawing.bodies)
        self.wrenches = [g for g in self.drawing.wrenches() if lp.norm(self.on(g)) > 1e-9]
        self.parts = self.connected()
        self.set_loads(model.get("loads", []))

    def set_loads(self, loads):
        """Replaces the loads of the model; motions and wrenches stay."""
        self.drawing.model = {**self.drawing.model, "loads": loads}
        self.constant = self.drawing.loads("constant")
        self.proportional = self.drawing.loads("proportional")
        self.size = sum(lp.norm(self.drawing.load(load)) for load in loads)

    def neutral(self):
        """Number of motions that no support resists either way."""
        cone = [self.on(g) for g in self.wrenches]
        return len(self.basis) - (len(lp.orthonormal(cone, len(self.basis))) if cone else 0)

    def on(self, row):
        """A row of work in the coordinates of the free motions."""
        return [lp.dot(row, v) for v in self.basis]

    def connected(self):
        """Sets of bodies that hinges connect."""
        groups = [{b} for b in range(self.drawing.bodies)]
        for bodies in self.drawing.node_bodies.values():
            joined = [g for g in groups if g & bodies]
            groups = [g for g in groups if not g & bodies] + [set().union(*joined)]
        return groups

    def restrict(self, row, part):
        return [x if i // 3 in part else 0.0 for i, x in enumerate(row)]

    def total(self, factor):
        return [c + factor * p for c, p in zip(self.constant, self.proportional)]

    def margin(self, factor):
        """Least relative distance to the limit of all parts: > 0 held, < 0 not; infinite without a limit; None: mechanism."""
        loads = self.total(factor)
        size = self.size * max(1.0, factor)
        least = INFINITE
        for part in self.parts:
            value = self.part_margin(self.restrict(loads, part), part, size)
            if value is None:
                return None
            least = min(least, value)
        return least

    def part_margin(self, loads, part, size):
        f = self.on(loads)
        cone = [self.on(g) for g in self.wrenches if lp.norm(self.restrict(g, part)) > 0]
        span = lp.orthonormal(cone, len(self.basis)) if cone else []
        if lp.norm(lp.without(f, span)) > 1e-9 * size:
            return None
        if not span:
            return INFINITE
        if lp.norm(f) <= 1e-12 * size:
            return 0.0
        f = [lp.dot(f, s) / lp.norm(f) for s in span]
        cone = [[lp.dot(g, s) for s in span] for g in cone]
        cone = [[x / lp.norm(g) for x in g] for g in cone]
        inner = [sum(column) for column in zip(*cone)]
        if lp.norm(inner) < 1e-9:
            inner = cone[0]
        columns = cone + [inner, [-x for x in inner]]
        rows = [list(row) for row in zip(*columns)]
        answer = lp.maximise([0.0] * len(cone) + [1.0, -1.0], rows, f)
        return {"unbounded": INFINITE, "infeasible": None}.get(answer[0], answer[1] if len(answer) > 1 else None)

    def largest_factor(self, bound=1e9):
        """Largest factor up to which constant and proportional loads are held together, from a held start; infinite beyond the bound."""
        def held(factor):
            value = self.margin(factor)
            return value is not None and value > 0

        low, high = 0.0, 1e-6
        while held(high):
            low, high = high, 4 * high
            if high > bound:
                return INFINITE
        for _ in range(60):
            middle = (low + high) / 2
            low, high = (middle, high) if held(middle) else (low, middle)
        return low

    def explains(self, loads, motion, tolerance=1e-3):
        """Whether a motion of one body (or the opposite) belongs to one in K on which the loads do work, or none and one way.

        `motion` is (a, b, w) in local coordinates, of size 1; its figures may be rounded, so motions may enter supports, and the
        loads' work may be less, by `tolerance`.
        """
        size = lp.norm(self.on(loads)) or 1.0
        for part in self.parts:
            on_part = self.restrict(loads, part)
            for body in part:
                works = [self.largest_work(on_part, body, [sign * x for x in motion], tolerance) for sign in (1.0, -1.0)]
                if any(work is not None and work > -tolerance * size for work in works):
                    return True
        return False

    def largest_work(self, loads, body, motion, tolerance):
        """Largest work of the loads on motions in K with the given motion of a body; None if there is none."""
        n = len(self.basis)
        f = self.on(loads)
        cone = [self.on(g) for g in self.wrenches]
        cone = [[x / lp.norm(g) for x in g] for g in cone]
        at = [[v[3 * body + i] for v in self.basis] for i in range(3)]
        rows, right = [], []
        # v = v+ - v-; |at.v - motion| <= tolerance; g.v <= tolerance
        for sign in (1.0, -1.0):
            for i in range(3):
                rows.append([sign * x for x in at[i]] + [-sign * x for x in at[i]])
                right.append(sign * motion[i] + tolerance)
        for g in cone:
            rows.append(list(g) + [-x for x in g])
            right.append(tolerance)
        for i, row in enumerate(rows):
            row += [1.0 if i == j else 0.0 for j in range(len(rows))]
        answer = lp.maximise(list(f) + [-x for x in f] + [0.0] * len(rows), rows, right)
        return {"unbounded": INFINITE, "infeasible": None}.get(answer[0], answer[1] if len(answer) > 1 else None)
