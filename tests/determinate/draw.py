"""Random statically determinate structures with imposed strains and settlements, and their requests."""
import math

from kinematics import Body, Member, Singular, Structure, Support, chord

ELEMENTS = 6  # a member; with order 8 what is left of a turn of 2.5 rad is rounding's
ORDER = 8
POINTS = 7  # of a member in a state


def turned(angle):
    return math.cos(angle), math.sin(angle)


class Drawing:
    """Draws one structure; `random` is a random.Random."""

    def __init__(self, random):
        self.random = random
        self.places = {}
        self.members = 0

    def new_node(self, place):
        name = f"n{len(self.places)}"
        self.places[name] = place
        return name

    def add_member(self, body, start):
        """A straight member or an arc from a node of the body to a new one, away from all nodes."""
        while True:
            length = 10 ** self.random.uniform(-0.5, 0.5)
            angle = self.random.uniform(-math.pi, math.pi)
            sweep = self.random.choice([0.0, 0.0, self.random.uniform(-2.5, 2.5)])
            member = Member(f"m{self.members}", start, "", length, angle, sweep)
            x, y = self.end_of(member)
            if min(math.hypot(x - a, y - b) for a, b in self.places.values()) > 0.2:
                break
        self.members += 1
        member.end = self.new_node((x, y))
        body.members.append(member)

    def end_of(self, member):
        dx, dy = chord(member.angle, member.turn(), 1.0, member.length)
        return self.places[member.start][0] + dx, self.places[member.start][1] + dy

    def tree(self, root, members, one_at_root=False):
        body = Body(root)
        for _ in range(members):
            # mostly on from the last node: chains with twigs
            nodes = body.nodes()[1 if one_at_root and body.members else 0:]
            start = nodes[-1] if self.random.random() < 0.6 else self.random.choice(nodes)
            self.add_member(body, start)
        return body

    def angle(self):
        return self.random.choice([0.0, self.random.uniform(-math.pi, math.pi)])

    def supports_of_body(self, body):
        """Three components that hold a body: a clamp, a pin and a roller, three rollers, a sliding clamp and a roller."""
        nodes = self.random.sample(body.nodes(), min(3, len(body.nodes())))
        kinds = ["clamp", "pin", "slide"] + (["rollers"] if len(nodes) > 2 else [])
        kind = self.random.choice(kinds)
        if kind == "clamp":
            return [Support(nodes[0], ["x", "y", "rotation"], self.angle())]
        if kind == "pin":
            return [Support(nodes[0], ["x", "y"], self.angle()), Support(nodes[1], ["y"], self.angle())]
        if kind == "slide":
            return [Support(nodes[0], ["y", "rotation"], self.angle()), Support(nodes[1], ["y"], self.angle())]
        return [Support(node, ["y"], self.angle()) for node in nodes]

    def structure(self):
        count = self.random.randint(2, 12)
        kind = self.random.choice(["tree", "tree", "hinged", "gerber"])
        if count < 4:
            kind = "tree"
        first = self.tree(self.new_node((0.0, 0.0)), count if kind == "tree" else count // 2)
        bodies = [first]
        hinges = []
        if kind == "tree":
            supports = self.supports_of_body(first)
        else:
            joint = self.random.choice(first.nodes()[1:])
            second = self.tree(joint, count - count // 2, one_at_root=True)
            bodies.append(second)
            hinges.append(((0, joint), (1, joint)))
            far = second.nodes()[-1]
            if kind == "hinged":
                supports = [Support(first.root, ["x", "y"], self.angle()), Support(far, ["x", "y"], self.angle())]
            else:
                supports = self.supports_of_body(first)
                used = {support.node for support in supports}
                free = [node for node in second.nodes()[1:] if node not in used]
                supports.append(Support(self.random.choice(free), ["y"], self.angle()))
        xs = [x for x, _ in self.places.values()]
        ys = [y for _, y in self.places.values()]
        return Structure(bodies, self.places, supports, hinges, max(max(xs) - min(xs), max(ys) - min(ys)))


def impose(structure, random):
    """Strains, curvatures and settlements, at least one of them, some constant."""
    kinds = random.choice([("axial",), ("curvature",), ("settlement",), ("axial", "curvature"),
                           ("axial", "curvature", "settlement")])
    pattern = random.choice(["proportional", "proportional", "constant", "mixed"])

    def drawn_pattern():
        return random.choice(["proportional", "constant"]) if pattern == "mixed" else pattern

    def signed(low, high):
        return random.choice([-1, 1]) * 10 ** random.uniform(low, high)

    everywhere = random.random() < 0.5
    members = structure.members()
    size = random.uniform(-5, -1)
    for member in members:
        if not everywhere and random.random() < 0.6:
            continue
        if "axial" in kinds:
            member.axial[drawn_pattern()] = signed(size - 1.5, size - 0.5)
        if "curvature" in kinds:
            member.curvature[drawn_pattern()] = signed(size, size + 1) / member.length
    if "settlement" in kinds:
        for support in structure.supports:
            support.pattern = drawn_pattern()
            for name in support.fixed:
                if random.random() < 0.6:
                    length = 1.0 if name == "rotation" else structure.size
                    support.displacement[name] = length * signed(size, size + 0.5)
    return imposed_gradient(structure)


def imposed_gradient(structure):
    """Largest strain, rotation of a member, rotation or displacement over size that is imposed."""
    values = [0.0]
    for member in structure.members():
        values += [abs(value) for value in member.axial.values()]
        values += [abs(value) * member.length for value in member.curvature.values()]
    for support in structure.supports:
        values += [abs(value) / (1.0 if name == "rotation" else structure.size)
                   for name, value in support.displacement.items()]
    return max(values)


class Case:
    """A structure, what is imposed on it, and the sections of its members."""

    def __init__(self, seed, random):
        self.seed = seed
        while True:
            self.structure = Drawing(random).structure()
            self.gradient = impose(self.structure, random)
            if self.gradient == 0.0:
                continue
            self.structure.linear = random.random() < 0.2
            self.factors = random.choice([[1.0], [1.0], [0.0, 0.25, 1.0], [-1.0, 1.0]])
            self.fractions = [i / (POINTS - 1) for i in range(POINTS)]
            try:
                self.exact = {factor: self.structure.displacements(factor, self.fractions) for factor in self.factors}
            except Singular:
                continue
            break
        self.draw_sections(random)

    def draw_sections(self, random):
        """EA l^2 / EI from 1e2 to 1e10, EI within two decades of each other, some members that shear."""
        unit = 10 ** random.uniform(-3, 6)
        slenderness = random.uniform(2, 10)
        alike = random.random() < 0.5
        self.sections = {}
        for member in self.structure.members():
            EI = unit * (1.0 if alike else 10 ** random.uniform(-1, 1))
            ratio = slenderness if alike else min(10.0, max(2.0, slenderness + random.uniform(-1, 1)))
            section = {"id": f"s {member.name}", "EA": EI * 10 ** ratio / member.length ** 2, "EI": EI}
            if random.random() < 0.2:
                section["GA"] = section["EA"] * random.uniform(0.1, 0.5)
            self.sections[member.name] = section

    def request(self, load=None):
        """Static analysis. load: an extra one, (node, (fx, fy), pattern)."""
        model = {
            "nodes": [{"id": name, "x": x, "y": y} for name, (x, y) in self.structure.places.items()],
            "sections": list(self.sections.values()),
            "members": [self.member(member) for member in self.structure.members()],
            "supports": [self.support(support) for support in self.structure.supports],
            "loads": self.loads(),
        }
        if load is not None:
            model["loads"].append({"type": "point", "at": {"node": load[0]}, "force": list(load[1]),
                                   "pattern": load[2]})
        return {"model": model,
                "analysis": {"type": "static", "load_factors": self.factors,
                             "geometry": "linear" if self.structure.linear else "nonlinear",
                             "discretization": {"elements": ELEMENTS, "order": ORDER},
                             "output": {"states": "all", "points_per_member": POINTS}}}

    def member(self, member):
        out = {"id": member.name, "start": member.start, "end": member.end, "section": f"s {member.name}"}
        if member.sweep != 0.0:
            out["curve"] = {"type": "arc", "sweep_degrees": math.degrees(member.sweep)}
        for _, (body, node) in self.structure.hinges:
            # the one member of the second body at the hinge; the node turns with the first body
            if member in self.structure.bodies[body].members and member.start == node:
                out["release"] = {"start": ["rotation"]}
        return out

    def support(self, support):
        out = {"node": support.node, "fixed": support.fixed, "angle_degrees": math.degrees(support.angle)}
        if support.displacement:
            out["displacement"] = dict(support.displacement, pattern=support.pattern)
        return out

    def loads(self):
        out = []
        for member in self.structure.members():
            for pattern in ("proportional", "constant"):
                parts = {"axial": member.axial[pattern], "curvature": member.curvature[pattern]}
                parts = {name: value for name, value in parts.items() if value != 0.0}
                if parts:
                    out.append({"type": "initial_strain", "member": member.name, "pattern": pattern, **parts})
        return out

    def has_proportional(self):
        return (any(value != 0.0 for member in self.structure.members()
                    for value in (member.axial["proportional"], member.curvature["proportional"]))
                or any(support.displacement and support.pattern == "proportional" for support in self.structure.supports))

    def axial_scale(self):
        """Largest EA times what is imposed."""
        return self.gradient * max(section["EA"] for section in self.sections.values())

    def bending_scale(self):
        """Least EI over the square of the size, times what is imposed."""
        return self.gradient * self.softest()

    def softest(self):
        return min(section["EI"] for section in self.sections.values()) / self.structure.size ** 2
