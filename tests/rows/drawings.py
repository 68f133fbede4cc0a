"""Random beams, frames and rings over rigid and stiff beds and stops, with gaps, ground that moves, and a list of load factors.

Loads are sized by the linear structure without its beds: load factor 1 moves it by a share of its span, most often through the gap.
"""
import copy
import math

KINDS = ("cantilever", "simple", "fixed", "continuous", "column", "portal", "ring", "arch", "footing")
SOFT = 1e3  # bed stiffness over EI / span^4 of the softer twin


class Drawing:
    """A request with its dead loads: (pattern, fx, fy) in all."""

    def __init__(self, rng):
        self.rng = rng
        self.kind = rng.choice(KINDS)
        self.span = 10 ** rng.uniform(0, 1.3)
        self.EI = 10 ** rng.uniform(0, 5)
        self.EA = self.EI / self.span**2 * 10 ** rng.uniform(3, 8)
        self.rigid = rng.random() < 0.5
        self.over = 10 ** rng.uniform(4, 9)  # stiffness of the beds over EI / span^4
        self.gap = 0.0 if rng.random() < 0.2 else self.span * 10 ** rng.uniform(-9, -1)
        self.moves = rng.choice(["", "", "", "constant", "proportional"])
        self.model = {"nodes": [], "sections": [{"id": "s", "EA": self.EA, "EI": self.EI}], "members": [], "supports": [],
                      "springs": [], "foundations": [], "loads": []}
        getattr(self, "draw_" + self.kind)()
        self.factors = self.draw_factors()
        for key in ("springs", "foundations"):
            if not self.model[key]:
                del self.model[key]

    # ---- parts ----
    def node(self, name, x, y):
        self.model["nodes"].append({"id": name, "x": x, "y": y})

    def member(self, name, start, end, sweep=0.0):
        member = {"id": name, "start": start, "end": end, "section": "s"}
        if sweep:
            member["curve"] = {"type": "arc", "sweep_degrees": sweep}
        self.model["members"].append(member)

    def support(self, node, *fixed):
        self.model["supports"].append({"node": node, "fixed": list(fixed)})

    def stiffness(self, power):
        """Stiffness of a bed (power 4) or of a stop (power 3)."""
        return "rigid" if self.rigid else self.over * self.EI / self.span**power

    def put(self, key, support, power):
        """Adds a bed or a stop with gap and motion of its ground."""
        support.update({"id": f"{key[0]}{len(self.model[key])}", "reaction": "compression_only", "stiffness": self.stiffness(power)})
        if self.gap:
            support["gap"] = self.gap
        if self.moves and self.rng.random() < 0.8:
            size = (self.gap or 1e-4 * self.span) * 10 ** self.rng.uniform(-1, 0.7)
            size = min(size, 0.02 * self.span)
            along = support.pop("moves_along")
            support["displacement"] = {"x": size * along[0], "y": size * along[1], "pattern": self.moves}
        support.pop("moves_along", None)
        self.model[key].append(support)

    def bed(self, member, side, along, part=None):
        support = {"member": member, "side": side, "moves_along": along}
        if part:
            support["range"] = part
        self.put("foundations", support, 4)

    def stop(self, place, direction):
        self.put("springs", {"at": place, "direction": list(direction), "moves_along": (-direction[0], -direction[1])}, 3)

    def load(self, members, horizontal=0.0):
        """Distributed or point load of a size that moves the free structure by 1e-4 to 0.3 of the span at load factor 1."""
        rng = self.rng
        size = 10 ** rng.uniform(-3, 1.2) * self.EI / self.span**3
        pattern = "proportional"
        for member in members:
            if rng.random() < 0.6:
                load = {"type": "distributed", "member": member, "force": [horizontal * size, -size]}
                load["force"] = [x / len(members) for x in load["force"]]
            else:
                load = {"type": "point", "at": {"member": member, "fraction": rng.uniform(0.2, 0.9)},
                        "force": [horizontal * self.span * size / len(members), -self.span * size / len(members)]}
            self.model["loads"].append({**load, "pattern": pattern})
        if rng.random() < 0.25:  # a constant share
            again = copy.deepcopy(self.model["loads"][-1])
            share = 10 ** rng.uniform(-2, 0)
            again["force"] = [share * x for x in again["force"]]
            again["pattern"] = "constant"
            self.model["loads"].append(again)

    def draw_factors(self):
        rng = self.rng
        count = rng.randint(1, 10)
        sign = rng.choice([1, 1, 1, -1, 0])
        factors = {1.0 if sign >= 0 else -1.0}
        while len(factors) < count:
            value = rng.choice([rng.uniform(0, 1), 10 ** rng.uniform(-4, 0)])
            factors.add(value * (sign or rng.choice([1, -1])))
        if rng.random() < 0.2:
            factors.add(0.0)
        factors = list(factors)
        rng.shuffle(factors)
        return factors

    # ---- structures ----
    def line(self, xs):
        for i, x in enumerate(xs):
            self.node(f"n{i}", x, 0.0)
        for i in range(len(xs) - 1):
            self.member(f"m{i}", f"n{i}", f"n{i + 1}")

    def below(self, members):
        """Beds below level members that are drawn from left to right, or a stop."""
        rng = self.rng
        for member in members:
            draw = rng.random()
            if draw < 0.55:
                self.bed(member, "right", (0.0, 1.0))
            elif draw < 0.75:
                a, b = sorted((rng.random(), rng.random()))
                self.bed(member, "right", (0.0, 1.0), [a, b] if b - a > 0.05 else None)
            else:
                turn = rng.choice([0.0, 0.0, rng.uniform(-1, 1)])
                self.stop({"member": member, "fraction": rng.uniform(0.3, 0.95)}, (math.sin(turn), -math.cos(turn)))

    def draw_cantilever(self):
        self.line([0.0, self.span])
        self.support("n0", "x", "y", "rotation")
        self.below(["m0"])
        self.load(["m0"])

    def draw_simple(self):
        self.line([0.0, self.span])
        self.support("n0", "x", "y")
        self.support("n1", "y")
        self.below(["m0"])
        self.load(["m0"])

    def draw_fixed(self):
        self.line([0.0, self.span])
        self.support("n0", "x", "y", "rotation")
        self.support("n1", "y", "rotation")
        self.below(["m0"])
        self.load(["m0"])

    def draw_continuous(self):
        self.line([0.0, 0.4 * self.span, self.span])
        self.support("n0", "x", "y")
        self.support("n1", "y")
        self.support("n2", "y")
        self.below(["m0", "m1"])
        self.load(["m0", "m1"])

    def draw_column(self):
        self.node("n0", 0.0, 0.0)
        self.node("n1", 0.0, self.span)
        self.member("m0", "n0", "n1")
        self.support("n0", "x", "y", "rotation")
        side = self.rng.choice(["left", "right"])
        out = -1.0 if side == "left" else 1.0
        if self.rng.random() < 0.6:
            self.bed("m0", side, (-out, 0.0))
        else:
            self.stop({"node": "n1"}, (out, 0.0))
        self.load(["m0"], horizontal=self.rng.choice([out, out, -out]) * self.rng.uniform(0.5, 5))

    def draw_portal(self):
        height = self.span * self.rng.uniform(0.5, 1.5)
        for name, x, y in (("a", 0.0, 0.0), ("b", 0.0, height), ("c", self.span, height), ("d", self.span, 0.0)):
            self.node(name, x, y)
        self.member("left", "a", "b")
        self.member("beam", "b", "c")
        self.member("right", "c", "d")
        foot = ("x", "y", "rotation") if self.rng.random() < 0.6 else ("x", "y")
        self.support("a", *foot)
        self.support("d", *foot)
        self.below(["beam"])
        if self.rng.random() < 0.5:
            self.bed("right", "left", (-1.0, 0.0))
        self.load(["beam", "left"], horizontal=self.rng.uniform(-1, 1))

    def draw_ring(self):
        radius = 0.5 * self.span
        self.node("bottom", 0.0, -radius)
        self.node("top", 0.0, radius)
        self.member("east", "bottom", "top", 180.0)
        self.member("west", "top", "bottom", 180.0)
        self.support("bottom", "x", "y", "rotation") if self.rng.random() < 0.5 else self.support("bottom", "x", "y")
        if len(self.model["supports"][0]["fixed"]) == 2:
            self.support("top", "x")
        for member, x in (("east", -1.0), ("west", 1.0)):
            self.bed(member, "right", (x, 0.0))
        self.load(["east", "west"])

    def draw_arch(self):
        self.node("a", 0.0, 0.0)
        self.node("b", self.span, 0.0)
        self.member("arch", "b", "a", self.rng.uniform(60.0, 180.0))
        fixed = ("x", "y", "rotation") if self.rng.random() < 0.5 else ("x", "y")
        self.support("a", *fixed)
        self.support("b", *fixed)
        self.bed("arch", self.rng.choice(["right", "left"]), (0.0, 1.0 if self.rng.random() < 0.5 else -1.0))
        self.load(["arch"], horizontal=self.rng.uniform(-1, 1))

    def draw_footing(self):
        """A beam that lies on its bed alone, held sideways."""
        self.line([0.0, self.span])
        self.support("n0", "x")
        self.gap = 0.0 if self.rng.random() < 0.7 else self.gap
        self.bed("m0", "right", (0.0, 1.0))
        if self.rng.random() < 0.3:
            self.stop({"node": "n1"}, (0.0, -1.0))
        self.load(["m0"])
        if self.model["loads"][0]["type"] == "point":
            self.model["loads"][0]["at"]["fraction"] = self.rng.uniform(0.4, 0.6)
        self.factors_up = True

    # ---- requests ----
    def request(self, factors=None, soft=False, geometry="nonlinear"):
        model = self.model
        if soft:
            model = copy.deepcopy(model)
            for key, power in (("springs", 3), ("foundations", 4)):
                for support in model.get(key, []):
                    support["stiffness"] = SOFT * self.EI / self.span**power
        factors = list(factors or self.factors)
        if self.kind == "footing":
            factors = [abs(f) for f in factors]
            factors = [f for i, f in enumerate(factors) if f not in factors[:i]]
        analysis = {"type": "static", "load_factors": factors, "output": {"states": "all", "points_per_member": 17}}
        if geometry != "nonlinear":
            analysis["geometry"] = geometry
        return {"model": model, "analysis": analysis}
