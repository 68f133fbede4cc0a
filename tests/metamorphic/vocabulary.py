"""Random requests that use every word of docs/requests.md; lengths in a unit `size`, forces in `force` = EI / size^2.

What a result depends on must not depend on the drawing. Therefore a support is not turned about a place by its name, loads stand off
the places at which results are sampled (multiples of a twentieth), and worst imperfections and starts with a state are left out: the
first is a choice of the program among equals, the second a part of another result.
"""
import math

PLACES = (0.13, 0.27, 0.38, 0.42, 0.62, 0.77, 0.86)  # off the places where sections are compared
ACCURACIES = (1e-3, 1e-3, 1e-4, 1e-6)
LISTS = ("nodes", "sections", "members", "supports", "springs", "foundations", "loads", "masses", "imperfections", "monitors")
WORDS = ("taper", "shear", "release", "joint", "rod", "spring", "rotational_spring", "joined_spring", "spring_law", "stop",
         "foundation", "one_sided", "gap", "law", "tangent", "layer", "rigid", "outline", "ground", "support_moves", "moment", "follows",
         "fixed_line", "distributed", "pressure", "strain", "temperature", "weight", "constant", "case", "sine", "offsets", "mode", "masses")


class Drawing:
    """Draws one request. `without`: words that are not drawn."""

    def __init__(self, rng, without=()):
        self.rng = rng
        self.words = [word for word in WORDS if word not in without]
        self.size = 10 ** rng.uniform(-0.3, 1.2)
        self.EI = 10 ** rng.uniform(0, 5)
        self.force = self.EI / self.size ** 2
        self.model = {key: [] for key in LISTS}
        self.used = set()

    def chance(self, share):
        return self.rng.random() < share

    def has(self, word, share):
        """Whether a word is used; remembers it."""
        use = word in self.words and self.chance(share)
        if use:
            self.used.add(word)
        return use

    def size_of(self, low, high):
        """A factor of either sign, 10^low to 10^high in size."""
        return self.rng.choice([-1, 1]) * 10 ** self.rng.uniform(low, high)

    def direction(self):
        angle = self.rng.choice([0.0, 0.5 * math.pi, math.pi, 1.5 * math.pi, self.rng.uniform(0, 2 * math.pi)])
        return [math.cos(angle), math.sin(angle)]

    def pattern(self):
        return {"pattern": "constant"} if self.has("constant", 0.3) else {}

    def along(self, make, share=0.25):
        """A value, or one that varies along the member."""
        if not self.chance(share):
            return make()
        places = [0.0, *([self.rng.choice([0.3, 0.55, 0.7])] if self.chance(0.5) else []), 1.0]
        return {"along": [[place, make()] for place in places]}

    # Structure

    def node(self, name, x, y):
        self.model["nodes"].append({"id": name, "x": x * self.size, "y": y * self.size})

    def section(self, name="s"):
        ratio = 10 ** self.rng.uniform(3, 8)
        EI = self.EI * self.rng.choice([1.0, self.rng.uniform(0.3, 3)])
        section = {"id": name, "EA": ratio * EI / self.size ** 2, "EI": EI, "mass": 10 ** self.rng.uniform(-2, 1), "expansion": 1e-5}
        if self.has("shear", 0.2):
            section["GA"] = section["EA"] * self.rng.uniform(0.1, 0.4)
        if self.has("taper", 0.2):
            power = self.rng.choice([1, 2, 3, 4])
            end = self.rng.uniform(0.3, 1.0)
            section["EI"] = {"along": [[0, EI], [1, EI * end]], "power": power}
        if self.chance(0.2):
            section["rotary_inertia"] = section["mass"] * self.size ** 2 * 10 ** self.rng.uniform(-5, -3)
        self.model["sections"].append(section)

    def curve(self, length):
        """Field `curve` of a member between nodes that are `length` apart; none for a straight one."""
        kind = self.rng.choice(["line", "line", "line", "arc", "parabola", "sine"])
        rise = self.size_of(-1.5, -0.6) * length
        if kind == "arc":
            return {"curve": {"type": "arc", "sweep_degrees": self.rng.choice([-1, 1]) * self.rng.uniform(10, 120)}}
        if kind == "parabola":
            return {"curve": {"type": "parabola", "rise": rise}}
        if kind == "sine":
            return {"curve": {"type": "sine", "rise": 0.5 * rise, "half_waves": self.rng.randint(1, 2)}}
        return {}

    def member(self, name, start, end, curve=True, section="s", **more):
        places = {node["id"]: (node["x"], node["y"]) for node in self.model["nodes"]}
        member = {"id": name, "start": start, "end": end, "section": section, **more}
        if curve is True:
            member.update(self.curve(math.dist(places[start], places[end])))
        elif curve:
            member["curve"] = curve
        self.model["members"].append(member)

    def support(self, node, fixed, inclined=0.15):
        support = {"node": node, "fixed": list(fixed)}
        if "x" in fixed and self.chance(inclined):
            support["angle_degrees"] = self.rng.uniform(-90, 90)
        if self.has("support_moves", 0.1):
            component = self.rng.choice(support["fixed"])
            value = self.size_of(-4, -2) * (1 if component == "rotation" else self.size)
            support["displacement"] = {component: value, **self.pattern()}
        self.model["supports"].append(support)

    def spline(self):
        """A beam along a smooth curve through points."""
        heights = [self.rng.uniform(-0.15, 0.15) for _ in range(self.rng.randint(1, 3))]
        points = [[(i + 1) / (len(heights) + 1) * self.size, y * self.size] for i, y in enumerate(heights)]
        self.node("a", 0, 0)
        self.node("b", 1, 0)
        self.member("m0", "a", "b", {"type": "points", "points": points})
        return ["a", "b"]

    def chain(self):
        """One to three members in a row that bends by up to 40 degrees at the nodes."""
        x = y = angle = 0.0
        self.node("a", 0, 0)
        names = ["a"]
        for number in range(self.rng.randint(1, 3)):
            length = self.rng.uniform(0.6, 1.4)
            x, y = x + length * math.cos(angle), y + length * math.sin(angle)
            names.append("bcd"[number])
            self.node(names[-1], x, y)
            self.member(f"m{number}", names[-2], names[-1])
            angle += self.rng.choice([0.0, self.rng.uniform(-0.7, 0.7)])
        return names

    def portal(self):
        self.node("a", 0, 0)
        self.node("b", self.rng.uniform(-0.1, 0.1), 1)
        self.node("c", self.rng.uniform(0.8, 1.5), self.rng.uniform(0.9, 1.2))
        self.node("d", self.rng.uniform(0.9, 1.6), 0)
        for number, (start, end) in enumerate(("ab", "bc", "cd")):
            self.member(f"m{number}", start, end, curve=number == 1)
        return ["a", "b", "c", "d"]

    def column(self):
        self.node("a", 0, 0)
        self.node("b", self.rng.choice([0.0, 0.05]), 1)
        self.member("m0", "a", "b", False)
        return ["a", "b"]

    def ring(self):
        half = {"type": "arc", "sweep_degrees": 180}
        self.node("a", 0, -0.5)
        self.node("b", 0, 0.5)
        self.member("m0", "a", "b", half)
        self.member("m1", "b", "a", half)
        return ["a", "b"]

    def pile(self):
        """An upright member in soil that alone holds it across and along."""
        self.node("a", 0, -1)
        self.node("b", 0, 0)
        self.member("m0", "a", "b", False)
        unit = 10 ** self.rng.uniform(1, 3) * self.force / self.size ** 2
        reach = 10 ** self.rng.uniform(-2.5, -1) * self.size
        for name, more in (("across", {}), ("friction", {"component": "tangent"})):
            law = self.law(lambda: unit * self.rng.uniform(0.5, 1.5), reach) if "law" in self.words else None
            foundation = {"id": name, "member": "m0", **more, **({"law": law} if law else {"stiffness": unit})}
            self.model["foundations"].append(foundation)
        return ["a", "b"]

    def bed(self):
        """A beam that lies on a one-sided bed, in places or everywhere; its end may be held along the axis."""
        self.node("a", 0, 0)
        self.node("b", 1, 0)
        self.member("m0", "a", "b", False)
        stiffness = "rigid" if "rigid" in self.words and self.chance(0.3) else 10 ** self.rng.uniform(1, 6) * self.force / self.size ** 2
        bed = {"id": "bed", "member": "m0", "stiffness": stiffness, "side": "right", "reaction": "compression_only"}
        if self.has("gap", 0.2):
            bed["gap"] = 10 ** self.rng.uniform(-5, -2) * self.size
        self.model["foundations"].append(bed)
        weight = {"type": "distributed", "member": "m0", "force": [0.0, -self.force / self.size * 10 ** self.rng.uniform(-0.5, 1)]}
        self.model["loads"].append({**weight, **self.pattern()})
        return ["a", "b"]

    # What holds it

    def hold(self, kind, names):
        if kind == "ring":
            self.support(names[0], ("x", "y", "rotation"))
        elif kind == "portal":
            for name in ("a", "d"):
                self.support(name, self.rng.choice([("x", "y"), ("x", "y", "rotation")]))
        elif kind == "pile":
            pass
        elif kind == "bed":
            self.support("a", self.rng.choice([("x",), ("x", "y"), ("x", "y", "rotation")]), 0.0)
        elif kind == "column" and self.chance(0.5):
            self.support("a", ("x", "y", "rotation"))
        else:
            self.support(names[0], self.rng.choice([("x", "y"), ("x", "y", "rotation")]))
            far = [("x", "y"), ("x", "y", "rotation")]
            fixed = ("x",) if kind == "column" else self.rng.choice([*far, ("y",)])
            self.support(names[-1], fixed, 0.0 if len(fixed) == 1 else 0.15)

    def release(self, kind):
        """A hinge or a semi-rigid joint where a second member goes on."""
        if kind in ("portal", "chain") and len(self.model["members"]) > 1:
            member = self.rng.choice(self.model["members"][1:])
            if self.has("joint", 0.15):
                member["release"] = {"start": {"rotation": 10 ** self.rng.uniform(-1, 2) * self.EI / self.size}}
            elif kind == "portal" and self.has("release", 0.1):
                member["release"] = {"start": ["rotation"]}

    def rods(self, kind):
        if kind == "portal" and self.has("rod", 0.25):
            self.model["sections"].append({"id": "rod", "EA": 10 ** self.rng.uniform(1, 4) * self.force, "EI": self.EI})
            self.member("brace 1", "a", "c", False, "rod", reaction=self.rng.choice(["tension_only", "compression_only"]))
            if self.chance(0.5):
                self.member("brace 2", "d", "b", False, "rod", reaction="tension_only")

    def place(self):
        member = self.rng.choice([m for m in self.model["members"] if "reaction" not in m])
        return {"member": member["id"], "fraction": self.rng.choice(PLACES)}

    def free_node(self):
        held = {support["node"] for support in self.model["supports"]}
        names = [node["id"] for node in self.model["nodes"] if node["id"] not in held]
        return {"node": self.rng.choice(names)} if names and self.chance(0.5) else self.place()

    def one_sided(self, gap_size):
        out = {"reaction": self.rng.choice(["compression_only", "compression_only", "tension_only"])}
        if self.has("gap", 0.5):
            out["gap"] = gap_size()
        return out

    def law(self, stiffness, reach):
        """A law of stiffness K = `stiffness()` that bends at displacements about `reach`."""
        kind = self.rng.choice(["tanh", "hyperbolic", "power", "table"])
        if kind == "table":
            w, p = abs(self.size_of(-1, 0)) * reach, stiffness() * reach
            return {"type": "table", "points": [[w, p], [3 * w, 1.7 * p], [8 * w, 2.1 * p]]}
        law = {"type": kind, "stiffness": self.along(stiffness), "capacity": self.along(lambda: stiffness() * reach)}
        if kind == "power":
            law.update(reference=reach, exponent=self.rng.uniform(0.3, 0.7))
        return law

    def spring(self, number):
        spring = {"id": f"k{number}", "at": self.free_node(), "direction": self.direction()}
        unit = 10 ** self.rng.uniform(-1, 4)
        if self.has("rotational_spring", 0.2):
            return {**spring, "direction": "rotation", "stiffness": unit * self.EI / self.size}
        if len(self.model["nodes"]) > 2 and self.has("joined_spring", 0.2):
            one, other = self.rng.sample([node["id"] for node in self.model["nodes"]], 2)
            return {**spring, "at": {"node": one}, "to": {"node": other}, "stiffness": unit * self.force / self.size}
        if self.has("spring_law", 0.2):
            law = self.law(lambda: unit * self.force / self.size, 10 ** self.rng.uniform(-3, -1) * self.size)
            spring["law"] = {field: value["along"][0][1] if isinstance(value, dict) else value for field, value in law.items()}
        else:
            spring["stiffness"] = unit * self.force / self.size
        if self.has("one_sided", 0.6):
            spring.update(self.one_sided(lambda: 10 ** self.rng.uniform(-5, -1.5) * self.size))
            if "stiffness" in spring and self.has("stop", 0.4):
                spring["stiffness"] = "rigid"
        if self.has("ground", 0.2):
            spring["displacement"] = {"x": self.size_of(-4, -2) * self.size, "y": self.size_of(-4, -2) * self.size, **self.pattern()}
        return spring

    def outline(self, member):
        """A surface near a straight member, on its right."""
        places = {node["id"]: (node["x"], node["y"]) for node in self.model["nodes"]}
        (x, y), (x1, y1) = places[member["start"]], places[member["end"]]
        length = math.dist((x, y), (x1, y1))
        t = ((x1 - x) / length, (y1 - y) / length)
        n = (t[1], -t[0])  # to the right
        gap = self.rng.choice([0.0, 10 ** self.rng.uniform(-4, -2)]) * length

        def at(along, across):
            return [x + along * length * t[0] + (gap + across * length) * n[0], y + along * length * t[1] + (gap + across * length) * n[1]]

        kind = self.rng.choice(["line", "circle", "spline", "polyline"])
        if kind == "line":
            return {"type": "line", "through": at(0.4, 0), "into": list(n)}
        if kind == "circle":
            radius = self.rng.uniform(1, 5)
            return {"type": "circle", "center": at(0.45, radius), "radius": radius * length, "medium": "inside"}
        ground = [at(u, self.rng.uniform(0, 0.05)) for u in (-0.2, 0.3, 0.8, 1.3)]
        if kind == "spline":
            return {"type": "spline", "points": ground, "medium": "right"}
        return {"type": "polyline", "points": ground, "rounding": 0.05 * length, "medium": "right"}

    def foundation(self, number):
        member = self.rng.choice([m for m in self.model["members"] if "reaction" not in m])
        foundation = {"id": f"f{number}", "member": member["id"]}
        unit = 10 ** self.rng.uniform(-1, 5) * self.force / self.size ** 2

        def stiffness():
            return unit * self.rng.uniform(0.5, 1.5)

        if self.chance(0.3):
            foundation["range"] = sorted(self.rng.sample([0, 0.2, 0.35, 0.55, 0.8, 1], 2))
        if "curve" not in member and self.has("outline", 0.15):
            return {**foundation, "reaction": "compression_only", "stiffness": unit, "outline": self.outline(member)}
        if self.has("law", 0.25):
            foundation["law"] = self.law(stiffness, 10 ** self.rng.uniform(-3, -1) * self.size)
        else:
            foundation["stiffness"] = self.along(stiffness, 0.15)
        if self.has("tangent", 0.15):
            foundation["component"] = "tangent"
        else:
            self.across(foundation, unit)
        if "shear_stiffness" not in foundation and self.has("ground", 0.2):
            ground = {axis: self.along(lambda: self.size_of(-4, -2) * self.size) for axis in "xy"}
            foundation["displacement"] = {**ground, **self.pattern()}
        return foundation

    def across(self, foundation, unit):
        """A foundation across the member: its side or direction, whether it is one-sided, a shear layer, rigid."""
        foundation.update({"direction": self.direction()} if self.chance(0.15) else {"side": self.rng.choice(["left", "right"])})
        if self.has("one_sided", 0.6):
            foundation.update(self.one_sided(lambda: self.along(lambda: 10 ** self.rng.uniform(-5, -1.5) * self.size, 0.2)))
        varies = isinstance(foundation.get("stiffness"), dict) or isinstance(foundation.get("gap"), dict)
        plain = "law" not in foundation and not varies
        if plain and foundation.get("reaction") and self.has("rigid", 0.35):
            foundation["stiffness"] = "rigid"
        elif plain and self.has("layer", 0.25):
            foundation["shear_stiffness"] = unit * self.size ** 2 * 10 ** self.rng.uniform(-3, -1)
            if foundation.get("reaction") and self.chance(0.3):
                foundation["ground_end"] = "endless"

    # Actions

    def load(self, scale):
        """A load whose force is about `scale` in the unit of forces."""
        force = scale * self.force
        member = self.rng.choice([m for m in self.model["members"] if "reaction" not in m])["id"]

        def component():
            return self.rng.uniform(-1, 1) * force

        if self.has("distributed", 0.25):
            out = {"type": "distributed", "member": member, "force": self.along(lambda: [component() / self.size, component() / self.size])}
            out.update(self.rng.choice([{}, {}, {"axes": "member"}, {"per": self.rng.choice(["horizontal", "vertical"])}]))
            if self.chance(0.3):
                out["range"] = sorted(self.rng.sample([0, 0.22, 0.5, 0.81, 1], 2))
            return out
        if self.has("pressure", 0.25):
            return {"type": "pressure", "member": member, "side": self.rng.choice(["left", "right"]),
                    "value": self.along(lambda: abs(component()) / self.size, 0.15)}
        if self.has("strain", 0.1):
            return {"type": "initial_strain", "member": member, "axial": self.along(lambda: self.size_of(-5, -3)),
                    "curvature": self.along(lambda: component() * self.size / self.EI)}
        if self.has("temperature", 0.1):
            return {"type": "temperature", "member": member, "change": self.along(lambda: self.size_of(0, 2)),
                    "gradient": self.along(lambda: 1e5 * component() * self.size / self.EI)}
        if "rod" not in self.used and self.has("weight", 0.1):  # the section of a rod has no mass
            return {"type": "self_weight", "gravity": [x * force / self.size for x in self.direction()]}
        out = {"type": "point", "at": self.free_node(), "force": [component(), component()]}
        if self.has("moment", 0.3):
            out["moment"] = component() * self.size
        for word in ("follows", "fixed_line"):
            if word not in ("fixed_line",) or "follows" not in out:
                out.update({word: True} if self.has(word, 0.12) else {})
        return out

    def loads(self, kind, scale):
        """One to three loads, at least one of them proportional; a load case at times."""
        loads = [self.load(scale) for _ in range(self.rng.randint(1, 3))]
        if kind == "ring":
            value = self.rng.uniform(0.2, 1.5) * scale * self.force / self.size
            loads += [{"type": "pressure", "member": name, "value": value, "side": "right"} for name in ("m0", "m1")]
        if kind in ("column", "pile"):
            loads.append({"type": "point", "at": {"node": "b"}, "force": [0.0, -scale * self.force]})
        self.model["loads"] += [loads[0], *({**load, **self.pattern()} for load in loads[1:])]
        if self.has("case", 0.15):
            self.model["load_cases"] = [{"id": "case", "factor": self.rng.uniform(0.5, 1.5), "grows": self.chance(0.5),
                                         "loads": [self.load(0.5 * scale)]}]

    def imperfections(self):
        straight = [m["id"] for m in self.model["members"] if "reaction" not in m]
        size = 10 ** self.rng.uniform(-4, -2) * self.size
        if self.has("sine", 0.25):
            self.model["imperfections"].append({"type": "sine", "member": self.rng.choice(straight), "half_waves": self.rng.randint(1, 3),
                                                "amplitude": size * self.rng.choice([-1, 1])})
        elif self.has("offsets", 0.1):
            offsets = [[place, size * self.rng.uniform(-1, 1)] for place in (0.2, 0.5, 0.7)]
            self.model["imperfections"].append({"type": "points", "member": self.rng.choice(straight), "offsets": offsets})
        elif self.has("mode", 0.07):
            if not self.used & {"follows", "fixed_line"}:  # whose loads have no linearised buckling
                self.model["imperfections"].append({"type": "mode", "number": 1, "amplitude": size})

    def monitors(self):
        """x and y of a place in a pair, so that they can be turned together; a rotation and a normal displacement."""
        at = self.place()
        self.model["monitors"] = [{"id": component, "at": at, "component": component} for component in ("x", "y", "rotation", "normal")]

    def masses(self):
        if self.has("masses", 0.3):
            mass = {"at": self.free_node(), "mass": 10 ** self.rng.uniform(-1, 1) * self.size}
            if self.chance(0.4) and "member" in mass["at"]:
                mass["inertia"] = 1e-2 * mass["mass"] * self.size ** 2
            self.model["masses"].append(mass)
            if self.chance(0.3):
                self.model["damping"] = {"mass": 0.01}

    # Analysis

    def analysis(self):
        kind = self.rng.choice(["static", "static", "static", "linear", "buckling", "critical", "critical", "path", "path", "vibration"])
        factors = self.rng.choice([[1.0], [1.0], [0.5, 1.0], [1.0, 0.3], [0.0, 0.5, 1.0]])
        if kind in ("static", "linear"):
            out = {"type": "static", "load_factors": factors, "geometry": "linear" if kind == "linear" else "nonlinear"}
            if self.chance(0.2):
                out["output"] = {"frequencies": self.rng.randint(1, 4)}
            return out
        if kind == "vibration" or (kind == "buckling" and self.used & {"follows", "fixed_line"}):
            return {"type": "vibration", "load_factors": factors, "modes": self.rng.randint(1, 5)}
        if kind == "buckling":
            modes = {"modes": self.rng.randint(1, 5)}
            one_sided = any("reaction" in item for key in ("members", "springs", "foundations") for item in self.model[key])
            return {"type": "buckling", **modes, **({"reversed": True} if self.chance(0.3) and not one_sided else {})}
        if kind == "critical":
            return {"type": "critical"}
        return {"type": "path", **self.path_rules()}

    def path_rules(self):
        rules = {"stop": {"load_factor": [-1.0, 1.0], "limit_points": 1, "steps": 400}, "control": self.rng.choice(["arc_length", "arc_length", "load"])}
        if self.chance(0.2):
            rules["stop"]["monitor"] = {"id": "normal", "range": [-0.05 * self.size, 0.05 * self.size]}
        if self.chance(0.5):
            rules["output"] = {"states": {"at_load_factors": sorted(self.rng.uniform(0.05, 0.9) for _ in range(2))}}
        return rules


def draw(rng, without=()):
    """(request, words it uses)"""
    drawing = Drawing(rng, without)
    kind = rng.choice(["chain", "chain", "chain", "portal", "portal", "column", "ring", "spline", "pile", "bed", "bed"])
    drawing.section()
    names = getattr(drawing, kind)()
    drawing.hold(kind, names)
    drawing.release(kind)
    drawing.rods(kind)
    drawing.model["springs"] += [drawing.spring(number) for number in range(2) if drawing.has("spring", 0.45)]
    drawing.model["foundations"] += [drawing.foundation(number) for number in range(2) if drawing.has("foundation", 0.6)]
    drawing.loads(kind, 10 ** rng.uniform(-1, 0.7))
    drawing.imperfections()
    drawing.monitors()
    drawing.masses()
    analysis = drawing.analysis()
    mesh = {"accuracy": rng.choice(ACCURACIES)} if rng.random() < 0.7 else {"elements": rng.choice([8, 12]), "order": rng.choice([3, 4])}
    states = "all" if analysis["type"] == "static" else "none"
    output = {"states": states, "points_per_member": 21, **analysis.get("output", {})}
    if output["states"] == "none":
        del output["points_per_member"]
    return {"model": drawing.model, "analysis": {**analysis, "discretization": mesh, "output": output}}, drawing.used
