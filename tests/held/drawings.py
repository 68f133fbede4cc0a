"""Random structures on one-sided supports: one to three loose parts in one model, in any position, scale and stiffness.

Each part is drawn upright, with lengths of 1 to 6 and a bending stiffness of 1; `finish` turns, shifts and scales the drawing.
"""
import copy
import math

PARTS = ("footing", "footing", "portal", "portal", "beam", "beam", "block", "wedge", "ring", "rocker", "mast", "gerber", "leaning")


class Sketch:
    """A model that grows; ids of a part begin with its prefix."""

    def __init__(self, rng):
        self.rng = rng
        self.model = {"nodes": [], "sections": [], "members": [], "supports": [], "springs": [], "foundations": [], "loads": []}
        self.prefix = ""
        self.shift = 0.0

    def begin(self, prefix, shift):
        """A new part with a section and stiffnesses of supports of its own."""
        self.prefix, self.shift = prefix, shift
        ratio = 10 ** self.rng.uniform(2, 10)
        self.model["sections"].append({"id": prefix, "EA": ratio, "EI": 1.0})
        self.base = 10 ** self.rng.uniform(-1, 5)
        self.spring_stiffness = 10 ** self.rng.uniform(-1, 5)
        self.soft = min(0.3, self.base, self.spring_stiffness)
        self.gap = self.rng.choice([0.0, 0.0, 0.0, 10 ** self.rng.uniform(-6, -2.5)])

    def node(self, name, x, y):
        self.model["nodes"].append({"id": self.prefix + name, "x": x + self.shift, "y": y})

    def member(self, name, start, end, sweep=0.0, release=()):
        member = {"id": self.prefix + name, "start": self.prefix + start, "end": self.prefix + end, "section": self.prefix}
        if sweep:
            member["curve"] = {"type": "arc", "sweep_degrees": sweep}
        if release:
            member["release"] = {end_: ["rotation"] for end_ in release}
        self.model["members"].append(member)

    def support(self, node, fixed):
        self.model["supports"].append({"node": self.prefix + node, "fixed": list(fixed)})

    def one_sided(self):
        return {"gap": self.gap} if self.gap and self.rng.random() < 0.7 else {}

    def spring(self, at, direction, reaction="compression_only"):
        """A spring at a node or at (member, fraction)."""
        place = {"node": self.prefix + at} if isinstance(at, str) else {"member": self.prefix + at[0], "fraction": at[1]}
        spring = {"id": f"{self.prefix}k{len(self.model['springs'])}", "at": place, "direction": list(direction),
                  "stiffness": self.spring_stiffness * self.rng.uniform(0.5, 2), "reaction": reaction}
        if reaction != "bilateral":
            spring.update(self.one_sided())
        self.model["springs"].append(spring)

    def push(self, at, direction):
        """A one-sided spring that resists motion along the direction, by pressing or by pulling."""
        if self.rng.random() < 0.75:
            self.spring(at, direction)
        else:
            self.spring(at, [-direction[0], -direction[1]], "tension_only")

    def base_along(self, member, side, part=None):
        """A one-sided base along a member; `side` is where it resists. A pulling base lies on the other side."""
        reaction = "compression_only"
        if self.rng.random() < 0.2:
            side, reaction = {"left": "right", "right": "left"}[side], "tension_only"
        base = {"id": f"{self.prefix}b{len(self.model['foundations'])}", "member": self.prefix + member, "stiffness": self.base,
                "reaction": reaction, "side": side, **self.one_sided()}
        if part:
            base["range"] = part
        self.model["foundations"].append(base)

    def base_down(self, member, left_to_right, part=None):
        """A base below a level member, along its normal or in the fixed direction downwards."""
        if self.rng.random() < 0.3:
            base = {"id": f"{self.prefix}b{len(self.model['foundations'])}", "member": self.prefix + member,
                    "stiffness": self.base, "reaction": "compression_only", "direction": [0, -1], **self.one_sided()}
            if part:
                base["range"] = part
            self.model["foundations"].append(base)
        else:
            self.base_along(member, "right" if left_to_right else "left", part)

    def hold_sideways(self, nodes):
        """Holds a part along x: a support, a bilateral spring, springs on both sides of one or of two nodes, or one side only."""
        kind = self.rng.choice(["support", "support", "support", "bilateral", "pair", "walls", "one"])
        first, last = nodes[0], nodes[-1]
        if kind == "support":
            self.support(self.rng.choice(nodes), ["x"])
        elif kind == "bilateral":
            self.spring(self.rng.choice(nodes), [1, 0], "bilateral")
        elif kind == "pair":
            node = self.rng.choice(nodes)
            self.spring(node, [1, 0])
            self.spring(node, [-1, 0])
        elif kind == "walls":
            self.push(first, [-1, 0])
            self.push(last, [1, 0])
        else:
            side = self.rng.choice([1, -1])
            self.push(last if side > 0 else first, [side, 0])

    def level_line(self, name, xs, y=0.0):
        """Members on a level line; returns (member, drawn from left to right) and the nodes."""
        nodes = [f"{name}{i}" for i in range(len(xs))]
        for node, x in zip(nodes, xs):
            self.node(node, x, y)
        members = []
        for i in range(len(xs) - 1):
            forward = self.rng.random() < 0.7
            ends = (nodes[i], nodes[i + 1]) if forward else (nodes[i + 1], nodes[i])
            self.member(f"{name}m{i}", *ends)
            members.append((f"{name}m{i}", forward))
        return members, nodes


def draw_footing(s):
    """A footing, rigid or flexible, on a base below all or a part of it, with one wall or two."""
    count = s.rng.randint(1, 3)
    width = s.rng.uniform(1, 3)
    members, nodes = s.level_line("f", [width * i / count for i in range(count + 1)])
    for name, forward in members:
        if len(members) == 1 or s.rng.random() < 0.85:
            part = sorted([round(s.rng.uniform(0, 0.4), 3), round(s.rng.uniform(0.6, 1), 3)]) if s.rng.random() < 0.3 else None
            s.base_down(name, forward, part)
    if not s.model["foundations"] or not s.model["foundations"][-1]["id"].startswith(s.prefix):
        s.base_down(*members[0])
    for i, foot in enumerate(s.rng.sample(nodes, s.rng.randint(1, min(2, len(nodes))))):
        s.node(f"w{i}", width * int(foot[1:]) / count, s.rng.uniform(1, 5))
        s.member(f"wall{i}", foot, f"w{i}")
    s.hold_sideways(nodes)


def draw_portal(s):
    """A frame of one to three bays whose feet stand on one-sided springs or on pads."""
    bays, height, span = s.rng.randint(1, 3), s.rng.uniform(1, 4), s.rng.uniform(1, 3)
    pads = s.rng.random() < 0.4
    for i in range(bays + 1):
        s.node(f"a{i}", span * i, 0)
        s.node(f"t{i}", span * i, height)
        s.member(f"c{i}", f"a{i}", f"t{i}")
        if pads:
            half = span * s.rng.uniform(0.05, 0.2)
            for side, x in (("l", -half), ("r", half)):
                s.node(f"p{side}{i}", span * i + x, 0)
                s.member(f"p{side}{i}", f"a{i}", f"p{side}{i}")
                s.base_down(f"p{side}{i}", side == "r")
    pinned = s.rng.randrange(bays + 1) if s.rng.random() < 0.2 else None
    for i in range(bays + 1):
        if i == pinned:
            s.support(f"a{i}", ["x", "y"])
        elif not pads:
            s.push(f"a{i}", [0, -1])
    for i in range(bays):
        hinge = s.rng.random() < 0.15 and bays > 1
        s.member(f"g{i}", f"t{i}", f"t{i + 1}", release=[s.rng.choice(["start", "end"])] if hinge else ())
    if pinned is None:
        s.hold_sideways([f"a{i}" for i in range(bays + 1)])


def draw_beam(s):
    """A beam on props, with hangers."""
    count = s.rng.randint(1, 3)
    length = s.rng.uniform(2, 5)
    members, nodes = s.level_line("b", [length * i / count for i in range(count + 1)])
    for _ in range(s.rng.randint(2, 4)):
        place = s.rng.choice(nodes) if s.rng.random() < 0.4 else (s.rng.choice(members)[0], round(s.rng.uniform(0.05, 0.95), 3))
        s.push(place, [0, -1] if s.rng.random() < 0.8 else [0, 1])
    s.hold_sideways(nodes)


def draw_gerber(s):
    """Two or three beams in line, hinged to each other, on props."""
    count = s.rng.randint(2, 3)
    x = 0.0
    s.node("n0", 0, 0)
    for i in range(count):
        length = s.rng.uniform(1, 2)
        x += length
        s.node(f"n{i + 1}", x, 0)
        s.member(f"m{i}", f"n{i}", f"n{i + 1}", release=["start"] if i else ())
        for f in (s.rng.uniform(0.05, 0.3), s.rng.uniform(0.6, 0.95)):
            if s.rng.random() < 0.8:
                s.push((f"m{i}", round(f, 3)), [0, -1])
    s.hold_sideways(["n0"])


def draw_block(s):
    """A rectangle in the corner of two beds: below and at one side; tilted with its loads."""
    w, h = s.rng.uniform(1, 3), s.rng.uniform(1, 4)
    for name, x, y in (("a", 0, 0), ("b", w, 0), ("c", w, h), ("d", 0, h)):
        s.node(name, x, y)
    for i, (start, end) in enumerate(("ab", "bc", "cd", "da")):
        s.member(f"e{i}", start, end)
    s.base_along("e0", "right")
    kind = s.rng.choice(["wall", "stop", "hold"])
    if kind == "wall":
        s.base_along("e1", "right", [0, round(s.rng.uniform(0.2, 1), 3)])
    elif kind == "stop":
        s.push("b", [1, 0])
    else:
        s.hold_sideways(["a", "b"])


def draw_wedge(s):
    """A triangle that stands with its tip down between two inclined beds."""
    left, right = math.radians(s.rng.uniform(20, 70)), math.radians(s.rng.uniform(20, 70))
    a, b = s.rng.uniform(1, 3), s.rng.uniform(1, 3)
    s.node("tip", 0, 0)
    s.node("l", -a * math.cos(left), a * math.sin(left))
    s.node("r", b * math.cos(right), b * math.sin(right))
    s.member("el", "l", "tip")
    s.member("er", "tip", "r")
    s.member("top", "r", "l")
    for name, part in (("el", [0.0, 0.6]), ("er", [0.4, 1.0])):
        s.base_along(name, "right", None if s.rng.random() < 0.6 else part)


def draw_ring(s):
    """A ring in a hole or on a mandrel: all round, or on a part of it; held against turning in its hole, or not."""
    radius, count = s.rng.uniform(0.7, 2), s.rng.randint(2, 4)
    for i in range(count):
        a = -math.pi / 2 + 2 * math.pi * i / count
        s.node(f"n{i}", radius * math.cos(a), radius * math.sin(a))
    for i in range(count):
        s.member(f"r{i}", f"n{i}", f"n{(i + 1) % count}", 360 / count)
    side = "right" if s.rng.random() < 0.8 else "left"
    whole = s.rng.random() < 0.5
    for i in range(count):
        if whole:
            s.base_along(f"r{i}", side)
        elif i in (0, count - 1):
            reach = round(s.rng.uniform(0.1, 0.95), 3)
            s.base_along(f"r{i}", side, [0, reach] if i == 0 else [1 - reach, 1])
    hold = s.rng.choice(["support", "spring", "none"])
    if hold == "support":
        s.support("n0", ["x"])
    elif hold == "spring":
        s.spring("n0", [1, 0], "bilateral")


def draw_rocker(s):
    """An arc that bulges downwards, on a bed along its normal or in a fixed direction, with a deck on posts or without."""
    sweep = s.rng.uniform(40, 170)
    half, radius = math.radians(sweep / 2), s.rng.uniform(1, 3)
    x, y = radius * math.sin(half), -radius * math.cos(half)
    s.node("l", -x, y)
    s.node("r", x, y)
    s.member("arc", "l", "r", sweep)
    part = None if s.rng.random() < 0.6 else [round(s.rng.uniform(0, 0.4), 3), round(s.rng.uniform(0.6, 1), 3)]
    if s.rng.random() < 0.4:
        s.model["foundations"].append({"id": f"{s.prefix}bed", "member": s.prefix + "arc", "stiffness": s.base,
                                       "reaction": "compression_only", "direction": [0, -1], **({"range": part} if part else {})})
    else:
        s.base_along("arc", "right", part)
    if s.rng.random() < 0.5:
        s.node("top", s.rng.uniform(-x, x), y + s.rng.uniform(0.5, 2))
        s.member("tl", "l", "top")
        s.member("tr", "r", "top")
    s.hold_sideways(["l", "r"])


def draw_mast(s):
    """A mast on a pin, or on a spring, with guys that only pull and stays that only push."""
    height = s.rng.uniform(2, 5)
    s.node("foot", 0, 0)
    s.node("mid", 0, height / 2)
    s.node("head", s.rng.uniform(-1, 1), height)
    s.member("low", "foot", "mid")
    s.member("high", "mid", "head")
    if s.rng.random() < 0.6:
        s.support("foot", ["x", "y"])
    else:
        s.support("foot", ["x"])
        s.push("foot", [0, -1])
    for side in s.rng.choice([[1], [-1], [1, -1], [1, -1]]):
        a = math.radians(s.rng.uniform(20, 70))
        s.spring(s.rng.choice(["mid", "head"]), [side * math.cos(a), -math.sin(a)], "tension_only")
    if s.rng.random() < 0.15:
        place = {"node": s.prefix + "foot"}
        s.model["springs"].append({"id": f"{s.prefix}turn", "at": place, "direction": "rotation", "stiffness": 1.0,
                                   "reaction": s.rng.choice(["compression_only", "tension_only"])})


def draw_leaning(s):
    """A frame that leans on a wall: a foot on a bed or spring, its head against a one-sided spring, a second frame hinged to it."""
    s.node("foot", 0, 0)
    s.node("head", s.rng.uniform(0.5, 2), s.rng.uniform(1, 3))
    s.member("ladder", "foot", "head")
    s.push("foot", [0, -1])
    s.push("head", [1, 0])
    s.push("foot", [-1, 0])
    if s.rng.random() < 0.5:
        s.node("end", s.rng.uniform(-3, -1), s.rng.uniform(0.5, 2))
        s.member("arm", "head", "end", release=["start"])
        s.push("end", [s.rng.uniform(-0.5, 0.5), -1])
        s.push(("arm", 0.5), [0, -1] if s.rng.random() < 0.5 else [-1, 0])


def draw_loads(s, prefix, soft):
    """Loads on one part, mostly downwards; of a size that moves it by 1e-5 to 1e-2 of its length."""
    rng = s.rng
    nodes = [n["id"] for n in s.model["nodes"] if n["id"].startswith(prefix)]
    members = [m for m in s.model["members"] if m["id"].startswith(prefix)]
    free = [n for n in nodes if any(n == m[e] and not m.get("release", {}).get(e) for m in members for e in ("start", "end"))]
    size = soft * 10 ** rng.uniform(-5, -2.3)
    loads = []
    for _ in range(rng.randint(1, 3)):
        q = [size * rng.gauss(0, 0.5), -size * rng.choice([1, 1, 1, rng.gauss(0, 1)])]
        kind = rng.choice(["node", "node", "member", "distributed", "distributed", "moment", "pressure"])
        if kind == "node":
            loads.append({"type": "point", "at": {"node": rng.choice(nodes)}, "force": q})
        elif kind == "member":
            place = {"member": rng.choice(members)["id"], "fraction": round(rng.uniform(0.05, 0.95), 3)}
            loads.append({"type": "point", "at": place, "force": q, "moment": rng.choice([0, size * rng.gauss(0, 0.3)])})
        elif kind == "moment":
            loads.append({"type": "point", "at": {"node": rng.choice(free)}, "force": [0, -size], "moment": size * rng.gauss(0, 0.5)})
        elif kind == "distributed":
            load = {"type": "distributed", "member": rng.choice(members)["id"], "force": q}
            if rng.random() < 0.3:
                load["range"] = sorted([round(rng.uniform(0, 0.5), 3), round(rng.uniform(0.55, 1), 3)])
            loads.append(load)
        else:
            member = rng.choice(members)
            loads.append({"type": "pressure", "member": member["id"], "value": size * rng.choice([1, rng.gauss(0, 1)]),
                          "side": rng.choice(["left", "right"])})
    if "r0" in {m["id"][len(prefix):] for m in members} and rng.random() < 0.5:
        loads = ring_loads(rng, members, size)
    return loads


def ring_loads(rng, members, size):
    """Loads that do not turn a ring in its hole: its weight, or a pressure all round."""
    if rng.random() < 0.5:
        q = [size * rng.gauss(0, 0.3), -size]
        return [{"type": "distributed", "member": m["id"], "force": q} for m in members]
    side = rng.choice(["left", "right"])
    return [{"type": "pressure", "member": m["id"], "value": size, "side": side} for m in members]


def sketch(rng):
    """A structure without loads: (sketch, its parts as [(prefix, soft)])."""
    s = Sketch(rng)
    parts = []
    for i in range(rng.choice([1, 1, 1, 2, 2, 3])):
        kind = rng.choice(PARTS)
        prefix = f"{kind}{i}."
        s.begin(prefix, 12.0 * i)
        globals()["draw_" + kind](s)
        parts.append((prefix, s.soft))
    return s, parts


def finish(model, rng):
    """The model turned by any angle, shifted, in other units of length and force."""
    turn = rng.choice([0.0, math.pi / 2, rng.uniform(0, 2 * math.pi), rng.uniform(0, 2 * math.pi)])
    length, force = 10 ** rng.uniform(-1, 3), 10 ** rng.uniform(-2, 6)
    c, s = math.cos(turn), math.sin(turn)
    origin = rng.choice([(0.0, 0.0), (rng.uniform(-5, 5), rng.uniform(-5, 5))])

    def turned(x, y):
        return [c * x - s * y, s * x + c * y]

    model = copy.deepcopy(model)
    for node in model["nodes"]:
        node["x"], node["y"] = (length * x for x in turned(node["x"] + origin[0], node["y"] + origin[1]))
    for section in model["sections"]:
        section["EA"] *= force
        section["EI"] *= force * length ** 2
    for support in model["supports"]:
        if turn and len(support["fixed"]) == 1:
            support["angle_degrees"] = math.degrees(turn)
    for spring in model["springs"]:
        turning = spring["direction"] == "rotation"
        spring["stiffness"] *= force * length if turning else force / length
        if not turning:
            spring["direction"] = turned(*spring["direction"])
            spring.update({"gap": spring["gap"] * length} if "gap" in spring else {})
    for base in model["foundations"]:
        base["stiffness"] *= force / length ** 2
        if "gap" in base:
            base["gap"] *= length
        if "direction" in base:
            base["direction"] = turned(*base["direction"])
    for load in model["loads"]:
        finish_load(load, force, length, turned)
    return model


def finish_load(load, force, length, turned):
    scale = force if load["type"] == "point" else force / length
    if "force" in load:
        load["force"] = [scale * x for x in turned(*load["force"])]
    if "value" in load:
        load["value"] *= scale
    if "moment" in load:
        load["moment"] *= force * length
