"""Edits of a request that do not change the structure, only its drawing or what is written out.

An edit takes a request and returns another; None where it does not apply.
"""
import copy
import math
import random

PLACE = 0.43  # off every middle and every other place that models name
EXACT = {0: (1, 0), 90: (0, 1), 180: (-1, 0), 270: (0, -1)}
OPPOSITE = {"left": "right", "right": "left"}


def flipped(item):
    """The list item with its medium, or its pressure, on the other side."""
    return {**item, "side": OPPOSITE[item.get("side", "left")]}


def acts_normal(foundation):
    return not isinstance(foundation.get("direction", "normal"), list)


def listed(model, key):
    return model.get(key, [])


def change(model, key, edit):
    """Replaces each item of the list `key`."""
    if key in model:
        model[key] = [edit(item) for item in model[key]]


# Turning and mirroring.

def moved_curve(curve, apply, determinant):
    moved = dict(curve)
    for field in ("sweep_degrees", "rise"):
        if field in moved:
            moved[field] *= determinant
    if "points" in moved:
        moved["points"] = [apply(point) for point in moved["points"]]
    return moved


def moved_load(load, apply, determinant):
    moved = dict(load)
    if "force" in moved:
        if load.get("per", "length") != "length":
            raise ValueError("a load per projected length can not be turned")
        moved["force"] = apply(load["force"])
    if load["type"] == "pressure" and determinant < 0:
        moved = flipped(moved)
    for field in ("moment", "curvature"):
        if field in moved:
            moved[field] *= determinant
    return moved


def moved_support(support, degrees, determinant):
    """The support's axes turn with the structure; mirrored, its x axis changes sign as well."""
    moved = dict(support)
    angle = determinant * support.get("angle_degrees", 0.0) + degrees
    if angle:
        moved["angle_degrees"] = angle
    if "displacement" in moved and determinant < 0:
        given = moved["displacement"]
        moved["displacement"] = {key: -value if key in ("x", "rotation") else value for key, value in given.items()}
    return moved


def moved_medium(item, apply, determinant):
    moved = dict(item)
    if isinstance(moved.get("direction"), list):
        moved["direction"] = apply(moved["direction"])
    elif moved.get("direction") == "rotation" and determinant < 0:
        other = {"compression_only": "tension_only", "tension_only": "compression_only"}
        reaction = moved.get("reaction", "bilateral")
        moved["reaction"] = other.get(reaction, reaction)
    elif determinant < 0:
        moved = flipped(moved)
    return moved


def moved_imperfection(item, determinant):
    moved = dict(item)
    if "offsets" in moved:
        moved["offsets"] = [[place, offset * determinant] for place, offset in moved["offsets"]]
    if moved["type"] == "sine":
        moved["amplitude"] *= determinant
    return moved


def move(request, degrees, mirrored):
    """Mirrors at the y axis where asked for, then turns counter-clockwise about the origin."""
    exact = EXACT.get(degrees % 360)
    cosine, sine = exact or (math.cos(math.radians(degrees)), math.sin(math.radians(degrees)))
    determinant = -1 if mirrored else 1

    def apply(vector):
        x, y = determinant * vector[0], vector[1]
        return [cosine * x - sine * y, sine * x + cosine * y]

    def moved_node(node):
        x, y = apply((node["x"], node["y"]))
        return {**node, "x": x, "y": y}

    def moved_member(member):
        if "curve" not in member:
            return member
        return {**member, "curve": moved_curve(member["curve"], apply, determinant)}

    model = request["model"]
    change(model, "nodes", moved_node)
    change(model, "members", moved_member)
    change(model, "supports", lambda item: moved_support(item, degrees, determinant))
    change(model, "loads", lambda item: moved_load(item, apply, determinant))
    change(model, "springs", lambda item: moved_medium(item, apply, determinant))
    change(model, "foundations", lambda item: moved_medium(item, apply, determinant))
    change(model, "imperfections", lambda item: moved_imperfection(item, determinant))
    return request


def shift(request):
    """Moves the drawing, so that coordinates round otherwise."""
    for node in request["model"]["nodes"]:
        node["x"] -= 0.37
        node["y"] += 0.81
    for member in request["model"]["members"]:
        if "points" in member.get("curve", {}):
            member["curve"]["points"] = [[x - 0.37, y + 0.81] for x, y in member["curve"]["points"]]
    return request


def mirror(request):
    return move(request, 0, True)


def turn(degrees):
    return lambda request: move(request, degrees, False)


def mirror_and_turn(degrees):
    return lambda request: move(request, degrees, True)


# Reversing members.

def reversed_range(item):
    if "range" not in item:
        return dict(item)
    start, end = item["range"]
    return {**item, "range": [1 - end, 1 - start]}


def reversed_member(member):
    turned = {**member, "start": member["end"], "end": member["start"]}
    curve = dict(member.get("curve", {"type": "line"}))
    if "sweep_degrees" in curve:
        curve["sweep_degrees"] *= -1
    if "rise" in curve and curve.get("half_waves", 1) % 2 == 1:
        curve["rise"] *= -1
    if "points" in curve:
        curve["points"] = curve["points"][::-1]
    if "curve" in member:
        turned["curve"] = curve
    if "release" in member:
        swapped = {"start": "end", "end": "start"}
        turned["release"] = {swapped[end]: parts for end, parts in member["release"].items()}
    return turned


def reversed_load(load):
    turned = reversed_range(load)
    if load["type"] == "pressure":
        turned = flipped(turned)
    if "curvature" in turned:
        turned["curvature"] *= -1
    return turned


def reversed_imperfection(item):
    turned = dict(item)
    if item["type"] == "sine" and item["half_waves"] % 2 == 1:
        turned["amplitude"] *= -1
    if "offsets" in turned:
        turned["offsets"] = [[1 - place, -offset] for place, offset in reversed(turned["offsets"])]
    return turned


def reverse_members(request, names):
    """Draws the members `names` from their end to their start."""
    model = request["model"]

    def on_member(edit):
        return lambda item: edit(item) if item.get("member") in names else item

    def placed(item):
        at = item.get("at", {})
        if at.get("member") not in names:
            return item
        return {**item, "at": {**at, "fraction": 1 - at["fraction"]}}

    def foundation(item):
        turned = reversed_range(item)
        return flipped(turned) if acts_normal(item) else turned

    change(model, "members", lambda item: reversed_member(item) if item["id"] in names else item)
    change(model, "foundations", on_member(foundation))
    change(model, "loads", on_member(reversed_load))
    change(model, "imperfections", on_member(reversed_imperfection))
    for key in ("loads", "springs", "monitors"):
        change(model, key, placed)
    return request


def member_names(request):
    return [member["id"] for member in request["model"]["members"]]


def reverse_all(request):
    return reverse_members(request, set(member_names(request)))


def reverse_first(request):
    return reverse_members(request, {member_names(request)[0]})


# Splitting members.

def point_on(model, member, fraction):
    """Position at a fraction of the length of a line or an arc."""
    places = {node["id"]: complex(node["x"], node["y"]) for node in model["nodes"]}
    start, chord = places[member["start"]], places[member["end"]] - places[member["start"]]
    curve = member.get("curve", {"type": "line"})
    if curve["type"] == "line":
        return start + fraction * chord
    if curve["type"] != "arc":
        return None
    half = math.radians(curve["sweep_degrees"]) / 2
    part = half * fraction  # the chord to a point turns by half of the angle that is left out
    turned = complex(math.cos(part - half), math.sin(part - half))
    return start + chord * turned * math.sin(part) / math.sin(half)


def member_parts(member, node, fraction):
    """The two members; the first keeps the id."""
    first = {**member, "end": node}
    second = {**member, "id": member["id"] + " beyond", "start": node}
    curve = member.get("curve", {"type": "line"})
    if curve["type"] == "arc":
        first["curve"] = {**curve, "sweep_degrees": curve["sweep_degrees"] * fraction}
        second["curve"] = {**curve, "sweep_degrees": curve["sweep_degrees"] * (1 - fraction)}
    release = member.get("release", {})
    first["release"] = {"start": release.get("start", [])}
    second["release"] = {"end": release.get("end", [])}
    return [first, second]


def range_parts(item, member, fraction):
    """What lies along `member`, on each of its parts."""
    start, end = item.get("range", [0, 1])
    parts = []
    if start < fraction:
        parts.append({**item, "range": [start / fraction, min(end, fraction) / fraction]})
    if end > fraction:
        second = {**item, "member": member + " beyond",
                  "range": [(max(start, fraction) - fraction) / (1 - fraction), (end - fraction) / (1 - fraction)]}
        if "id" in item:
            second["id"] = item["id"] + " beyond"
        parts.append(second)
    for part in parts:
        if part["range"] == [0, 1]:
            del part["range"]
        elif part["range"][1] > 1 - 1e-12:
            part["range"][1] = 1
    return parts


def placed_on_part(item, name, node, fraction):
    at = item.get("at", {})
    if at.get("member") != name:
        return item
    place = at["fraction"]
    if place == fraction:
        return {**item, "at": {"node": node}}
    if place < fraction:
        return {**item, "at": {"member": name, "fraction": place / fraction}}
    return {**item, "at": {"member": name + " beyond", "fraction": (place - fraction) / (1 - fraction)}}


def split_member(model, name, fraction):
    """Splits one member; returns the new node's id, or None where its curve can not be split."""
    member = next(item for item in model["members"] if item["id"] == name)
    point = point_on(model, member, fraction)
    if point is None or any(item.get("member") == name for item in listed(model, "imperfections")):
        return None
    node = f"{name} at {fraction:g}"
    model["nodes"].append({"id": node, "x": point.real, "y": point.imag})
    place = model["members"].index(member)
    model["members"][place:place + 1] = member_parts(member, node, fraction)
    for key in ("foundations", "loads"):
        if key in model:
            model[key] = [part for item in model[key] for part in (
                range_parts(item, name, fraction) if item.get("member") == name else [item])]
    for load in listed(model, "loads"):
        if "range" in load and load["type"] in ("pressure", "initial_strain"):
            raise ValueError("pressure acts on whole members")
    for key in ("loads", "springs", "monitors"):
        change(model, key, lambda item: placed_on_part(item, name, node, fraction))
    return node


def split_all(fraction):
    def edit(request):
        for name in member_names(request):
            if split_member(request["model"], name, fraction) is None:
                return None
        return request
    return edit


def split_first(fraction):
    return lambda request: request if split_member(request["model"], member_names(request)[0], fraction) else None


# Names and order.

def reorder(request):
    """Other ids, and every list in another order."""
    model = request["model"]
    order = random.Random(17)
    nodes = {node["id"]: f"n{number}" for number, node in enumerate(model["nodes"][::-1])}
    members = {member["id"]: f"m{number}" for number, member in enumerate(model["members"][::-1])}

    def renamed(item, key):
        new = dict(item)
        names = {"node": nodes, "member": members, "start": nodes, "end": nodes}
        if key in ("nodes", "members"):
            new["id"] = (nodes if key == "nodes" else members)[item["id"]]
        for field in names:
            if field in new:
                new[field] = names[field][new[field]]
        if "at" in new:
            new["at"] = {field: names.get(field, {}).get(value, value) for field, value in new["at"].items()}
        return new

    for key, value in model.items():
        if isinstance(value, list):
            model[key] = [renamed(item, key) for item in value]
            order.shuffle(model[key])
    return request


def reverse_lists(request):
    for value in request["model"].values():
        if isinstance(value, list):
            value.reverse()
    return request


# Additions that do nothing.

def addition(key, make):
    def edit(request):
        place = {"member": member_names(request)[0], "fraction": PLACE}
        request["model"].setdefault(key, []).append(make(place))
        return request
    return edit


def zero_force(place):
    return {"type": "point", "at": place, "force": [0, 0]}


def zero_spring(place):
    return {"id": "none", "at": place, "direction": [0.6, 0.8], "stiffness": 0}


def zero_base(place):
    return {"id": "none", "member": place["member"], "stiffness": 0, "range": [0, place["fraction"]]}


def monitor(place):
    return {"id": "look", "at": place, "component": "normal"}


def cut_bases(cut):
    def edit(request):
        model = request["model"]
        if "foundations" not in model:
            return None
        model["foundations"] = [part for item in model["foundations"] for part in cut(item)]
        return request
    return edit


def halves(item):
    half = {key: value / 2 if key in ("stiffness", "shear_stiffness") else value for key, value in item.items()}
    return [half, {**half, "id": item["id"] + " again"}]


def two_ranges(item):
    start, end = item.get("range", [0, 1])
    middle = start + PLACE * (end - start)
    return [{**item, "range": [start, middle]}, {**item, "id": item["id"] + " beyond", "range": [middle, end]}]


# Offsets of a node.

def span(model):
    xs, ys = [node["x"] for node in model["nodes"]], [node["y"] for node in model["nodes"]]
    return math.hypot(max(xs) - min(xs), max(ys) - min(ys))


def offset(share):
    """Moves a node that is not held, or else a new one in the middle of the first member, by a share of the extent."""
    def edit(request):
        model = request["model"]
        distance = share * span(model)
        held = {item["node"] for item in listed(model, "supports")}
        free = [node["id"] for node in model["nodes"] if node["id"] not in held]
        name = free[0] if free else split_member(model, member_names(request)[0], 0.5)
        for node in model["nodes"]:
            if node["id"] == name:
                node["x"] += 0.6 * distance
                node["y"] += 0.8 * distance
        return request if name else None
    return edit


# What is written out.

def output(**fields):
    def edit(request):
        request["analysis"]["output"] = fields
        return request
    return edit


def as_drawn(request):
    return request


OFFSETS = {f"offset 1e-{exponent}": float(f"1e-{exponent}") for exponent in range(15, 9, -1)}

EDITS = {
    "drawn": as_drawn,
    "mirror": mirror,
    "shift": shift,
    "reverse": reverse_all,
    "reverse first": reverse_first,
    "turn 37": turn(37),
    "turn 90": turn(90),
    "turn 180": turn(180),
    "mirror, turn 37": mirror_and_turn(37),
    "split 0.2": split_first(0.2),
    "split 0.43": split_first(0.43),
    "split 0.5": split_first(0.5),
    "split all 0.2": split_all(0.2),
    "split all 0.43": split_all(0.43),
    "split all 0.5": split_all(0.5),
    "reorder": reorder,
    "reverse lists": reverse_lists,
    "zero force": addition("loads", zero_force),
    "zero spring": addition("springs", zero_spring),
    "zero base": addition("foundations", zero_base),
    "monitor": addition("monitors", monitor),
    "base halves": cut_bases(halves),
    "base ranges": cut_bases(two_ranges),
    **{name: offset(share) for name, share in OFFSETS.items()},
    "states none": output(states="none"),
    "states all": output(states="all"),
    "states every 3": output(states={"every": 3}),
    "path points": output(path_points=64),
    "extremes": output(extremes=True, points_per_member=11),
}


def edited(request, name):
    """A copy of the request with the edit `name`; None where it does not apply."""
    return EDITS[name](copy.deepcopy(request))
