"""Random parts, and structures of 2 to 12 copies of a part that carry no forces from one copy to another.

A part is a model of its own. A copy of it may have its loads and its masses multiplied: its buckling loads are then divided by the
factor of the loads, its squared frequencies by that of the masses. Copies stand side by side, in any position and turned, mirrored
and drawn backwards, or they are joined so that the loads of the whole still are those of the parts:

  row     spans that share a fixed support with the next one; at pinned supports they have hinges
  star    members that are clamped or pinned at one fixed node
  braced  columns with pinned ends whose heads are held by a row of hinged girders
"""
import copy
import math
import pathlib
import sys

sys.path[:0] = [str(pathlib.Path(__file__).resolve().parent.parent / "variations")]
import oracle  # noqa: E402
import variations  # noqa: E402

LISTS = ("nodes", "sections", "members", "supports", "springs", "foundations", "loads", "masses")
GIRDER = 1e8  # EA of a girder that braces columns, in EI / length^2 of a column: such a row sways far above its 20th load
CLAMP = ("x", "y", "rotation")
ENDS = {"pinned": (("x", "y"), ("x",)), "cantilever": (CLAMP, ()), "clamped": (CLAMP, ("x", "rotation")), "propped": (CLAMP, ("x",))}


class Part:
    """A model, what it can be asked, and how its copies may be joined."""

    def __init__(self, kind, model, uses, joints=()):
        self.kind = kind
        self.model = model
        self.uses = uses
        self.joints = joints
        self.exact_loads = None    # count -> so many buckling loads of an inextensible axis, in closed form
        self.exact_squares = None  # count -> so many squared frequencies without load

    def extent(self):
        xs, ys = [n["x"] for n in self.model["nodes"]], [n["y"] for n in self.model["nodes"]]
        return math.hypot(max(xs) - min(xs), max(ys) - min(ys))


def model_of(nodes, section, members, supports, loads, **more):
    """nodes {id: (x, y)}, members [(id, start, end)] or with fields, supports {node: components}."""
    drawn = [{**dict(zip(("id", "start", "end"), m[:3])), "section": "s", **(m[3] if len(m) > 3 else {})} for m in members]
    return {"nodes": [{"id": name, "x": x, "y": y} for name, (x, y) in nodes.items()], "sections": [{"id": "s", **section}],
            "members": drawn, "supports": [{"node": name, "fixed": list(fixed)} for name, fixed in supports.items()],
            "loads": loads, **more}


def slender(rng, length, mass=True):
    """EI of 0.1 to 1e4 and an EA with which axial strains at the buckling load are 1e-6 to 1e-3."""
    EI = 10 ** rng.uniform(-1, 4)
    section = {"EA": EI * 10 ** rng.uniform(4, 7) / length ** 2, "EI": EI}
    if mass:
        section["mass"] = 10 ** rng.uniform(-2, 2)
    return section


def force_at(place, fx, fy):
    at = {"node": place} if isinstance(place, str) else {"member": place[0], "fraction": place[1]}
    return {"type": "point", "at": at, "force": [fx, fy]}


def column(rng, ends=None):
    """A column of one or two members under a force at its head."""
    ends = ends or rng.choice(list(ENDS))
    length = 10 ** rng.uniform(-0.3, 1.2)
    foot, head = ENDS[ends]
    nodes, members = {"foot": (0, 0), "head": (0, length)}, [("m", "foot", "head")]
    if rng.random() < 0.3:
        nodes["between"] = (0, length * rng.uniform(0.2, 0.8))
        members = [("m", "foot", "between"), ("n", "between", "head")]
    supports = {"foot": foot, **({"head": head} if head else {})}
    model = model_of(nodes, slender(rng, length), members, supports, [force_at("head", 0, -1)])
    uses = ("buckling", "critical", "vibration", "path", "static", "mode")
    joints = {"pinned": ("braced",), "cantilever": ("star",)}.get(ends, ()) if len(members) == 1 else ()
    part = Part(f"column {ends}", model, uses, joints)
    section = model["sections"][0]
    part.exact_loads = lambda count: oracle.buckling_loads(ends, section["EI"], length, count)
    part.exact_squares = lambda count: oracle.squared_frequencies(ends, section, length, count, axially_fixed=False)
    return part


def pile(rng):
    """A pinned column in soil; on half of the piles two buckling loads are equal."""
    part = column(rng, "pinned")
    length, EI = part.extent(), part.model["sections"][0]["EI"]
    n = rng.randint(1, 3)
    beta = (math.pi / length) ** 4 * EI * (n * (n + 1)) ** 2
    stiffness = beta if rng.random() < 0.5 else beta * 10 ** rng.uniform(-1.5, 0.5)
    part.model["foundations"] = [{"id": f"soil {m['id']}", "member": m["id"], "stiffness": stiffness} for m in part.model["members"]]
    return Part("pile", part.model, part.uses)


def pushed_and_pulled(rng):
    """A column between fixed ends with a force within its length; it buckles under the opposite force, too."""
    part = column(rng, "pinned")
    model = part.model
    head = next(s for s in model["supports"] if s["node"] == "head")
    head["fixed"] = ["x", "y"] if rng.random() < 0.5 else ["x", "y", "rotation"]
    model["loads"] = [force_at((model["members"][0]["id"], rng.uniform(0.3, 0.7)), 0, -1)]
    return Part("pushed and pulled", model, ("buckling", "reversed", "vibration", "static"))


def span(rng):
    """A span between fixed supports, hinged or clamped, that a temperature compresses."""
    length = 10 ** rng.uniform(-0.3, 1.5)
    clamped = rng.random() < 0.5
    section = {**slender(rng, length), "expansion": 1e-5}
    fixed = ("x", "y", "rotation") if clamped else ("x", "y")
    release = {} if clamped else {"release": {"start": ["rotation"], "end": ["rotation"]}}
    strain = math.pi ** 2 * section["EI"] / (section["EA"] * length ** 2)
    heat = {"type": "temperature", "member": "m", "change": rng.choice([1.0, 10.0]) * strain / 1e-5}
    model = model_of({"foot": (0, 0), "head": (length, 0)}, section, [("m", "foot", "head", release)],
                     {"foot": fixed, "head": fixed}, [heat])
    kind = "clamped" if clamped else "pinned"
    part = Part(f"span {kind}", model, ("buckling", "vibration", "vibration", "static"), ("row", "star"))
    force = section["EA"] * 1e-5 * heat["change"]
    part.exact_loads = lambda count: [load / force for load in oracle.buckling_loads(kind, section["EI"], length, count)]
    part.exact_squares = lambda count: oracle.squared_frequencies(kind, section, length, count, axially_fixed=True)
    return part


def bay(rng):
    """A portal with loads at its corners."""
    height, width = 10 ** rng.uniform(0, 1), 10 ** rng.uniform(0, 1)
    nodes = {"a": (0, 0), "b": (0, height), "c": (width, height), "d": (width, 0)}
    fixed = rng.choice([("x", "y"), ("x", "y", "rotation")])
    second = rng.choice([1.0, rng.uniform(0.2, 1)])
    model = model_of(nodes, slender(rng, height), [("left", "a", "b"), ("beam", "b", "c"), ("right", "c", "d")],
                     {"a": fixed, "d": fixed}, [force_at("b", 0, -1), force_at("c", 0, -second)])
    return Part("bay", model, ("buckling", "vibration", "path", "static"))


def ring(rng):
    """A ring under outer pressure, in soil on both of its sides or none."""
    radius = 10 ** rng.uniform(-0.3, 0.7)
    half = {"curve": {"type": "arc", "sweep_degrees": 180}}
    section = slender(rng, radius)
    soil = rng.choice([0.0, 10 ** rng.uniform(0, 3)]) * section["EI"] / radius ** 4
    loads = [{"type": "pressure", "member": name, "value": 1, "side": "right"} for name in ("m", "n")]
    more = {"foundations": [{"id": f"soil {name}", "member": name, "stiffness": soil, "side": "right"} for name in "mn"]} if soil else {}
    model = model_of({"bottom": (0, -radius), "top": (0, radius)}, section, [("m", "bottom", "top", half), ("n", "top", "bottom", half)],
                     {"bottom": ("x",) if soil else ("x", "y", "rotation")}, loads, **more)
    return Part("ring", model, ("buckling", "vibration"))


def lumped(rng):
    """A cantilever without mass that carries masses: it has few natural motions."""
    part = column(rng, "cantilever")
    for section in part.model["sections"]:
        del section["mass"]
    places = rng.choice([[{"node": "head"}], [{"node": "head"}, {"member": "m", "fraction": 0.5}]])
    part.model["masses"] = [{"at": at, "mass": 10 ** rng.uniform(-1, 1)} for at in places]
    if rng.random() < 0.5:
        part.model["masses"][0]["inertia"] = 10 ** rng.uniform(-3, -1) * part.extent() ** 2
    return Part("lumped", part.model, ("vibration", "path", "static"))


PARTS = (column, column, column, pile, pushed_and_pulled, span, span, bay, ring, lumped)


# Copies.

def factored(model, loads, masses):
    """A copy of a model whose loads and masses are multiplied."""
    model = copy.deepcopy(model)
    for load in model["loads"]:
        for field in ("value", "change"):
            if field in load:
                load[field] *= loads
        if "force" in load:
            load["force"] = [loads * component for component in load["force"]]
    for item in model["sections"] + model.get("masses", []):
        for field in ("mass", "inertia"):
            if field in item:
                item[field] *= masses
    return model


def prefixed(model, prefix):
    """A model with other ids."""
    def renamed(item):
        new = dict(item)
        for field in ("id", "start", "end", "section", "node", "member"):
            if field in new:
                new[field] = prefix + new[field]
        if "at" in new:
            new["at"] = {field: value if field == "fraction" else prefix + value for field, value in new["at"].items()}
        return new
    return {key: [renamed(item) for item in model[key]] for key in LISTS if key in model}


def shifted(model, dx, dy):
    for node in model["nodes"]:
        node["x"] += dx
        node["y"] += dy
    return model


def placed(part, model, join, number, count, rng):
    """Copy `number` of `count` in its place."""
    request = {"model": model}
    if join == "star":
        variations.move(request, 360.0 * number / count, False)
        return request["model"]
    if join == "" and rng.random() < 0.5:
        variations.move(request, rng.choice([0, 0, 37, 90, 211]), rng.random() < 0.5)
    if join == "" and rng.random() < 0.3:
        variations.reverse_all(request)
    if join == "row":
        dx, dy = number * part.model["nodes"][1]["x"], 0.0
    else:
        dx, dy = 2.5 * part.extent() * number, rng.choice([0.0, 0.3 * part.extent() * number]) if join == "" else 0.0
    return shifted(request["model"], dx, dy)


def merged_nodes(model, size):
    """Makes one node of nodes in one place, which have the same supports."""
    kept, names = [], {}
    for node in model["nodes"]:
        same = next((k for k in kept if math.hypot(k["x"] - node["x"], k["y"] - node["y"]) < 1e-9 * size), None)
        names[node["id"]] = same["id"] if same else node["id"]
        if not same:
            kept.append(node)
    gone = {old for old, new in names.items() if old != new}
    model["nodes"] = kept
    model["supports"] = [s for s in model["supports"] if s["node"] not in gone]
    for member in model["members"]:
        member["start"], member["end"] = names[member["start"]], names[member["end"]]
    return model


def brace(model, count, part):
    """Girders between the heads; the first head is held."""
    EI, length = part.model["sections"][0]["EI"], part.extent()
    model["sections"].append({"id": "girder", "EA": GIRDER * EI / length ** 2, "EI": EI})
    hinges = {"start": ["rotation"], "end": ["rotation"]}
    for number in range(count - 1):
        model["members"].append({"id": f"girder {number}", "start": f"{number} head", "end": f"{number + 1} head", "section": "girder",
                                 "release": hinges})
    model["supports"] = [s for s in model["supports"] if not s["node"].endswith(" head") or s["node"] == "0 head"]
    return model


class Whole:
    """Copies of a part: groups [(count, factor of loads, factor of masses)], their join, and the model of all of them."""

    def __init__(self, part, groups, join, model):
        self.part = part
        self.groups = groups
        self.join = join
        self.model = model

    def describe(self):
        groups = " + ".join(f"{count} x (loads {loads:.9g}, masses {masses:.9g})" for count, loads, masses in self.groups)
        return f"{self.part.kind}{', ' + self.join if self.join else ''}: {groups}"


def draw_groups(rng, count):
    """One to three groups; factors that differ by a tenth or more, by 1e-2 to 1e-9, or not at all."""
    left, groups = count, []
    while left:
        size = left if len(groups) == 2 or rng.random() < 0.5 else rng.randint(1, left)
        near = 1 + rng.choice([0.0, 10 ** rng.uniform(-9, -2)])
        loads, masses = (rng.choice([1.0, near, rng.uniform(0.3, 1.0)]) if groups else 1.0 for _ in range(2))
        groups.append((size, loads, masses))
        left -= size
    return groups


def draw(rng, part):
    """A structure of copies of a part."""
    count = rng.randint(2, 12)
    groups = draw_groups(rng, count)
    join = rng.choice(["", *part.joints])
    factors = [(loads, masses) for size, loads, masses in groups for _ in range(size)]
    model = {key: [] for key in LISTS if key in part.model}
    for number, (loads, masses) in enumerate(factors):
        one = prefixed(placed(part, factored(part.model, loads, masses), join, number, count, rng), f"{number} ")
        for key, items in one.items():
            model[key] += items
    if join in ("row", "star"):
        model = merged_nodes(model, part.extent())
    if join == "braced":
        model = brace(model, count, part)
    if rng.random() < 0.3:
        for items in model.values():
            rng.shuffle(items)
    return Whole(part, groups, join, model)
