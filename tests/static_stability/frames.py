"""Random plane frames of straight members under loads at nodes, most of them with slender members."""
import math

KINDS = ("braced", "braced", "truss", "truss", "columns", "shear_legs")
HINGED = {"start": ["rotation"], "end": ["rotation"]}


class Sketch:
    """A model that grows. Bending stiffness of frame members is about 1e4, of rods 1e-1 to 1e2; lengths are 2 to 6."""

    def __init__(self, rng):
        self.rng = rng
        self.model = {"nodes": [], "sections": [], "members": [], "supports": [], "loads": []}

    def node(self, name, x, y):
        self.model["nodes"].append({"id": name, "x": x, "y": y})

    def section(self, name, ei, slenderness):
        """EA such that a length of 4 has EA L^2 / EI = slenderness^2."""
        self.model["sections"].append({"id": name, "EA": ei * slenderness ** 2 / 16, "EI": ei})

    def member(self, name, start, end, section, hinged=False):
        member = {"id": name, "start": start, "end": end, "section": section}
        if hinged:
            member["release"] = HINGED
        self.model["members"].append(member)

    def support(self, node, fixed):
        self.model["supports"].append({"node": node, "fixed": list(fixed)})

    def load(self, node, fx, fy):
        self.model["loads"].append({"type": "point", "at": {"node": node}, "force": [fx, fy]})

    def rod_section(self, name, frame_ei, stocky):
        ei = frame_ei * (10 ** self.rng.uniform(-0.3, 0.5) if stocky else 10 ** self.rng.uniform(-5, -2.5))
        self.section(name, ei, 10 ** (self.rng.uniform(2.0, 2.4) if stocky else self.rng.uniform(2.2, 3)))


def draw_braced(s, stocky):
    """Portals of one to three storeys and one or two bays with crossed rods, beams hinged or rigid, wind and weight.

    Half of the stocky ones have no rods and rigid beams, and sway.
    """
    rng = s.rng
    sway = stocky and rng.random() < 0.5
    bays, storeys = rng.randint(1, 2), rng.randint(1, 3)
    height, span = rng.uniform(2.5, 4), rng.uniform(3, 6)
    s.section("frame", 1e4, rng.uniform(100, 200))
    for i in range(bays + 1):
        for j in range(storeys + 1):
            s.node(f"n{i}{j}", i * span, j * height)
            if j:
                s.member(f"c{i}{j}", f"n{i}{j - 1}", f"n{i}{j}", "frame")
        s.support(f"n{i}0", rng.choice([["x", "y"], ["x", "y"], ["x", "y", "rotation"]]))
    hinged = not sway and rng.random() < 0.6
    wind = 0.0 if sway and rng.random() < 0.5 else rng.choice([-1, 1]) * (0.01 if sway else 1)
    braced = rng.randrange(bays)
    for j in range(1, storeys + 1):
        for i in range(bays):
            s.member(f"g{i}{j}", f"n{i}{j}", f"n{i + 1}{j}", "frame", hinged)
        if not sway:
            s.rod_section(f"rod{j}", 1e4, stocky)
            a, b = f"n{braced}", f"n{braced + 1}"
            s.member(f"x{j}", f"{a}{j - 1}", f"{b}{j}", f"rod{j}", True)
            if rng.random() < 0.7:
                s.member(f"y{j}", f"{b}{j - 1}", f"{a}{j}", f"rod{j}", True)
        s.load(f"n0{j}", wind * rng.uniform(0.5, 1), -1 if sway else 0)
        if sway or rng.random() < 0.5:
            s.load(f"n{bays}{j}", 0, -rng.uniform(0, 3))


def draw_truss(s, stocky):
    """A girder with continuous chords; diagonals and posts are rods with hinges."""
    rng = s.rng
    panels, depth, width = rng.randint(3, 7), rng.uniform(1, 2.5), rng.uniform(1.5, 3)
    s.section("chord", 1e3, rng.uniform(100, 200))
    for i in range(panels + 1):
        s.node(f"b{i}", i * width, 0)
        s.node(f"t{i}", i * width, depth)
    for i in range(panels):
        s.member(f"lower{i}", f"b{i}", f"b{i + 1}", "chord")
        s.member(f"upper{i}", f"t{i}", f"t{i + 1}", "chord")
        s.rod_section(f"d{i}", 1e3, stocky)
        rising = (i < panels / 2) != (rng.random() < 0.5)
        ends = (f"b{i}", f"t{i + 1}") if rising else (f"t{i}", f"b{i + 1}")
        s.member(f"diagonal{i}", *ends, f"d{i}", True)
    for i in range(panels + 1):
        s.rod_section(f"p{i}", 1e3, stocky)
        s.member(f"post{i}", f"b{i}", f"t{i}", f"p{i}", True)
    s.support("b0", ["x", "y"])
    s.support(f"b{panels}", ["y"])
    for i in range(1, panels):
        s.load(f"{rng.choice('bt')}{i}", 0, -rng.uniform(0.2, 1))


def draw_columns(s, stocky):
    """Columns of different sections, stepped ones too, beside each other; beams hinged to their heads carry no moments."""
    rng = s.rng
    count, span = rng.randint(1, 4), rng.uniform(2, 5)
    clamped = rng.randrange(count)
    height = rng.uniform(3, 5)
    for i in range(count):
        s.node(f"f{i}", i * span, 0)
        s.node(f"h{i}", i * span, height)
        s.section(f"s{i}", 1e3 * 10 ** rng.uniform(-2 if not stocky else -0.3, 0), rng.uniform(100, 300))
        s.support(f"f{i}", ["x", "y", "rotation"] if i == clamped or rng.random() < 0.3 else ["x", "y"])
        if rng.random() < 0.4:
            s.node(f"m{i}", i * span, height * rng.uniform(0.3, 0.7))
            s.section(f"u{i}", 1e3 * 10 ** rng.uniform(-1, 0), rng.uniform(100, 300))
            s.member(f"low{i}", f"f{i}", f"m{i}", f"s{i}")
            s.member(f"high{i}", f"m{i}", f"h{i}", f"u{i}")
        else:
            s.member(f"column{i}", f"f{i}", f"h{i}", f"s{i}")
        s.load(f"h{i}", 0, -rng.uniform(0.1, 1))
    s.section("beam", 1e3, 100)
    for i in range(count - 1):
        s.member(f"beam{i}", f"h{i}", f"h{i + 1}", "beam", True)
    if rng.random() < 0.4:
        s.support("h0", ["x"])


def draw_shear_legs(s, stocky):
    """Two or three rods that meet in a point which carries a load; a frame stands beside it that the load does not reach."""
    rng = s.rng
    height = rng.uniform(2, 5)
    s.node("top", 0, height)
    feet = sorted(rng.sample(range(-6, 7), rng.randint(2, 3)))
    for i, x in enumerate(feet):
        s.node(f"f{i}", 0.8 * x, 0)
        s.support(f"f{i}", ["x", "y"])
        s.rod_section(f"rod{i}", 1e3, stocky)
        s.member(f"leg{i}", f"f{i}", "top", f"rod{i}", True)
    a = rng.uniform(-0.3, 0.3) + (math.pi / 2 if rng.random() < 0.2 else 0)
    s.load("top", math.sin(a), -math.cos(a))


def draw(rng):
    """(kind, model without a scale of its loads)"""
    s = Sketch(rng)
    kind = rng.choice(KINDS)
    globals()["draw_" + kind](s, rng.random() < 0.2)
    return kind, s.model
