"""Edits of a request that do not change the structure, only its drawing or what is written out.

An edit takes a request and returns another; None where it does not apply.
"""
import copy
import math
import random

PLACE = 0.43  # off every middle and every other place that models name
EXACT = {0: (1, 0), 90: (0, 1), 180: (-1, 0), 270: (0, -1)}
OPPOSITE = {"left": "right", "right": "left"}
PLACED = ("loads", "springs", "monitors", "masses")  # lists of what has a place on a member


def flipped(item):
    """The list item with its medium, or its pressure, on the other side."""
    return {**item, "side": OPPOSITE[item.get("side", "left")]}


def acts_normal(foundation):
    """Whether the foundation has a side of the member."""
    return (not isinstance(foundation.get("direction", "normal"), list) and "outline" not in foundation
            and foundation.get("component", "normal") == "normal")


def listed(model, key):
    return model.get(key, [])


def change(model, key, edit):
    """Replaces each item of the list `key`; loads are those of the load cases, too."""
    for holder in holders(model, key):
        holder[key] = [edit(item) for item in holder[key]]


def holders(model, key):
    """The objects that have the list `key`."""
    owners = [model, *listed(model, "load_cases")] if key == "loads" else [model]
    return [owner for owner in owners if key in owner]


def on_values(value, edit):
    """A value, or each of the values of a field that varies along a member."""
    if isinstance(value, dict) and "along" in value:
        return {**value, "along": [[place, edit(one)] for place, one in value["along"]]}
    return edit(value)


def negated(value):
    return on_values(value, lambda one: -one)


def value_at(points, place, power=1.0):
    """Piecewise linear in value^(1/power), constant beyond the ends; values may be vectors."""
    if isinstance(points[0][1], list):
        return [value_at([[x, value[axis]] for x, value in points], place) for axis in range(len(points[0][1]))]
    if place <= points[0][0]:
        return points[0][1]
    for (x, a), (y, b) in zip(points, points[1:]):
        if place <= y:
            share = (place - x) / (y - x)
            low, high = (math.copysign(abs(value) ** (1 / power), value) if power != 1 else value for value in (a, b))
            mixed = low + share * (high - low)
            return mixed ** power if power != 1 else mixed
    return points[-1][1]


# Turning and mirroring.

def moved_curve(curve, apply, determinant):
    moved = dict(curve)
    for field in ("sweep_degrees", "rise"):
        if field in moved and "direction" not in moved:
            moved[field] *= determinant
    if "direction" in moved:
        moved["direction"] = apply(moved["direction"])
    if "points" in moved:
        moved["points"] = [apply(point) for point in moved["points"]]
    return moved


def moved_load(load, apply, determinant, degrees):
    moved = dict(load)
    if load.get("per", "length") != "length" and degrees % 180:
        raise ValueError("a load per projected length can not be turned")
    if "force" in moved and load.get("axes", "global") == "member":
        moved["force"] = on_values(load["force"], lambda force: [force[0], determinant * force[1]])
    elif "force" in moved:
        moved["force"] = on_values(load["force"], apply)
    if "gravity" in moved:
        moved["gravity"] = apply(load["gravity"])
    if load["type"] == "pressure" and determinant < 0:
        moved = flipped(moved)
    for field in ("moment", "curvature", "gradient"):
        if field in moved and determinant < 0:
            moved[field] = negated(moved[field])
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


def along_both(x, y, apply):
    """The two components of a vector that may vary along a member, moved."""
    lists = [value["along"] for value in (x, y) if isinstance(value, dict)]
    if not lists:
        return apply([x, y])
    places = sorted({place for points in lists for place, _ in points})
    pairs = [(place, apply([value_at(value["along"], place) if isinstance(value, dict) else value for value in (x, y)]))
             for place in places]
    return [{"along": [[place, pair[axis]] for place, pair in pairs]} for axis in (0, 1)]


def moved_ground(ground, apply, determinant):
    """Displacement of the ground at a spring or along a foundation."""
    moved = dict(ground)
    if "rotation" in moved:
        moved["rotation"] *= determinant
        return moved
    moved["x"], moved["y"] = along_both(ground.get("x", 0.0), ground.get("y", 0.0), apply)
    return moved


def moved_outline(outline, apply, determinant):
    moved = dict(outline)
    for field in ("center", "through", "into"):
        if field in moved:
            moved[field] = apply(moved[field])
    if "points" in moved:
        moved["points"] = [apply(point) for point in moved["points"]]
    if determinant < 0 and moved.get("medium") in OPPOSITE:
        moved["medium"] = OPPOSITE[moved["medium"]]
    return moved


def moved_medium(item, apply, determinant):
    moved = dict(item)
    if "displacement" in moved:
        moved["displacement"] = moved_ground(moved["displacement"], apply, determinant)
    if "outline" in moved:
        return {**moved, "outline": moved_outline(moved["outline"], apply, determinant)}
    if moved.get("component") == "tangent":
        return moved
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
    change(model, "loads", lambda item: moved_load(item, apply, determinant, degrees))
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

def reversed_along(value):
    """A value that may vary along a member, or an object of such values, seen from the other end."""
    if isinstance(value, dict) and "along" in value:
        return {**value, "along": [[1 - place, one] for place, one in reversed(value["along"])]}
    if isinstance(value, dict):
        return {field: reversed_along(one) for field, one in value.items()}
    return value


def reversed_range(item):
    """What lies along a member, seen from the other end; an outline lies in the plane."""
    turned = {field: value if field == "outline" else reversed_along(value) for field, value in item.items()}
    if "range" in item:
        start, end = item["range"]
        turned["range"] = [1 - end, 1 - start]
    return turned


def reversed_member(member):
    turned = {**member, "start": member["end"], "end": member["start"]}
    curve = dict(member.get("curve", {"type": "line"}))
    if "sweep_degrees" in curve:
        curve["sweep_degrees"] *= -1
    if "rise" in curve and "direction" not in curve and curve.get("half_waves", 1) % 2 == 1:
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
    if load.get("axes", "global") == "member":
        turned["force"] = on_values(turned["force"], lambda force: [-force[0], -force[1]])
    for field in ("curvature", "gradient"):
        if field in turned:
            turned[field] = negated(turned[field])
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

    reverse_sections(model, names)
    change(model, "members", lambda item: reversed_member(item) if item["id"] in names else item)
    change(model, "foundations", on_member(foundation))
    change(model, "loads", on_member(reversed_load))
    change(model, "imperfections", on_member(reversed_imperfection))
    for key in PLACED:
        change(model, key, placed)
    return request


def reverse_sections(model, names):
    """Gives the members `names` sections that vary from their other end."""
    for section in list(model["sections"]):
        turned = {**section, "id": section["id"] + " reversed"}
        turned = {field: reversed_along(value) for field, value in turned.items()}
        if {**turned, "id": section["id"]} == section:
            continue
        model["sections"].append(turned)
        for member in model["members"]:
            if member["id"] in names and member["section"] == section["id"]:
                member["section"] = turned["id"]


def member_names(request):
    return [member["id"] for member in request["model"]["members"]]


def reverse_all(request):
    return reverse_members(request, set(member_names(request)))


def reverse_first(request):
    return reverse_members(request, {member_names(request)[0]})


# Splitting members.

def point_on(model, member, fraction):
    """Position at a fraction of the length of a line or an arc."""
    start, chord = ends_of(model, member)
    curve = member.get("curve", {"type": "line"})
    if curve["type"] == "line":
        return start + fraction * chord
    if curve["type"] == "parabola":
        share = share_of_chord(chord, offset_of(curve, chord), fraction)
        return start + share * chord + 4 * share * (1 - share) * offset_of(curve, chord)
    if curve["type"] != "arc":
        return None
    half = math.radians(curve["sweep_degrees"]) / 2
    part = half * fraction  # the chord to a point turns by half of the angle that is left out
    turned = complex(math.cos(part - half), math.sin(part - half))
    return start + chord * turned * math.sin(part) / math.sin(half)


def ends_of(model, member):
    """Start and chord of a member, as complex numbers."""
    places = {node["id"]: complex(node["x"], node["y"]) for node in model["nodes"]}
    return places[member["start"]], places[member["end"]] - places[member["start"]]


def offset_of(curve, chord):
    """Offset of a parabola over the middle of its chord, as a complex number."""
    direction = complex(*curve["direction"]) if "direction" in curve else 1j * chord
    return curve["rise"] * direction / abs(direction)


def share_of_chord(chord, offset, fraction):
    """Where along its chord a parabola has a fraction of its length; the length by Gauss' rule of order 5 on 64 pieces."""
    nodes, weights = (-(0.6 ** 0.5), 0.0, 0.6 ** 0.5), (5 / 18, 8 / 18, 5 / 18)

    def speed(share):
        return abs(chord + 4 * (1 - 2 * share) * offset)

    def length(end):
        return sum(end / 64 * weight * speed(end / 64 * (piece + 0.5 + node / 2))
                   for piece in range(64) for node, weight in zip(nodes, weights))

    low, high, whole = 0.0, 1.0, length(1.0)
    for _ in range(52):
        middle = (low + high) / 2
        low, high = (middle, high) if length(middle) < fraction * whole else (low, middle)
    return (low + high) / 2


def parabola_parts(curve, chord, fraction):
    """The two pieces of a parabola: in the direction of its axis each has the same second derivative."""
    offset = offset_of(curve, chord)
    share = share_of_chord(chord, offset, fraction)
    direction = [offset.real / abs(offset), offset.imag / abs(offset)]
    return [{"type": "parabola", "rise": abs(offset) * part ** 2, "direction": direction} for part in (share, 1 - share)]


def member_parts(member, node, fraction, chord):
    """The two members; the first keeps the id."""
    first = {**member, "end": node}
    second = {**member, "id": member["id"] + " beyond", "start": node}
    curve = member.get("curve", {"type": "line"})
    if curve["type"] == "arc":
        first["curve"] = {**curve, "sweep_degrees": curve["sweep_degrees"] * fraction}
        second["curve"] = {**curve, "sweep_degrees": curve["sweep_degrees"] * (1 - fraction)}
    if curve["type"] == "parabola":
        first["curve"], second["curve"] = parabola_parts(curve, chord, fraction)
    release = member.get("release", {})
    first["release"] = {"start": release.get("start", [])}
    second["release"] = {"end": release.get("end", [])}
    return [first, second]


def along_part(value, low, high):
    """A value that may vary along a member, or an object of such values, on the part from `low` to `high` of its length."""
    if isinstance(value, dict) and "along" in value:
        points, power = value["along"], value.get("power", 1.0)
        inside = [[place, one] for place, one in points if low < place < high]
        ends = [[place, value_at(points, place, power)] for place in (low, high)]
        shares = [[(place - low) / (high - low), one] for place, one in [ends[0], *inside, ends[1]]]
        return {**value, "along": shares}
    if isinstance(value, dict):
        return {field: along_part(one, low, high) for field, one in value.items()}
    return value


def on_part(item, low, high):
    return {field: value if field == "outline" else along_part(value, low, high) for field, value in item.items()}


def range_parts(item, member, fraction):
    """What lies along `member`, on each of its parts."""
    start, end = item.get("range", [0, 1])
    parts = []
    if start < fraction:
        parts.append({**on_part(item, 0, fraction), "range": [start / fraction, min(end, fraction) / fraction]})
    if end > fraction:
        second = {**on_part(item, fraction, 1), "member": member + " beyond",
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
    if place == fraction and item.get("component") != "normal":
        return {**item, "at": {"node": node}}
    if place <= fraction:
        return {**item, "at": {"member": name, "fraction": place / fraction}}
    return {**item, "at": {"member": name + " beyond", "fraction": (place - fraction) / (1 - fraction)}}


def split_sections(model, parts, fraction):
    """Sections of the two parts of a member, where they vary along it."""
    section = next(item for item in model["sections"] if item["id"] == parts[0]["section"])
    for part, low, high in zip(parts, (0, fraction), (fraction, 1)):
        on_it = {**on_part(section, low, high), "id": f"{section['id']} of {part['id']}"}
        if {**on_it, "id": section["id"]} != section:
            model["sections"].append(on_it)
            part["section"] = on_it["id"]


def can_be_split(model, member):
    """Imperfections, rods and the free ground of one-sided shear layers are those of whole members."""
    name = member["id"]
    layers = (item.get("shear_stiffness") and (item.get("reaction", "bilateral") != "bilateral" or "ground_end" in item)
              for item in listed(model, "foundations") if item["member"] == name)
    return ("reaction" not in member and not any(layers)
            and not any(item.get("member") == name for item in listed(model, "imperfections")))


def split_member(model, name, fraction):
    """Splits one member; returns the new node's id, or None where its curve can not be split."""
    member = next(item for item in model["members"] if item["id"] == name)
    point = point_on(model, member, fraction)
    if point is None or not can_be_split(model, member):
        return None
    node = f"{name} at {fraction:g}"
    place = model["members"].index(member)
    parts = member_parts(member, node, fraction, ends_of(model, member)[1])
    split_sections(model, parts, fraction)
    model["nodes"].append({"id": node, "x": point.real, "y": point.imag})
    model["members"][place:place + 1] = parts
    for key in ("foundations", "loads"):
        for holder in holders(model, key):
            holder[key] = [part for item in holder[key] for part in (
                range_parts(item, name, fraction) if item.get("member") == name else [item])]
    for key in PLACED:
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
