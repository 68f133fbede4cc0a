"""A request in other units of length and force; the unit of time stays, so that squared frequencies do."""

# Exponents (length, force) of each field. A mass is force times time^2 over length. Fields of a rotational spring or release have
# the moment and the angle in place of the force and the displacement.
FORCE, LENGTH, NONE = (0, 1), (1, 0), (0, 0)
MOMENT, PER_LENGTH, STRESS, MASS = (1, 1), (-1, 1), (-2, 1), (-1, 1)
SECTION = {"EA": FORCE, "EI": (2, 1), "GA": FORCE, "mass": (-2, 1), "rotary_inertia": FORCE, "E": STRESS, "G": STRESS, "A": (2, 0),
           "I": (4, 0), "shear_area": (2, 0), "density": (-4, 1), "shape": dict.fromkeys(
               ("width", "depth", "diameter", "thickness", "web", "flange", "root_radius"), LENGTH)}
CURVE = {"rise": LENGTH, "points": LENGTH}
OUTLINE = {"center": LENGTH, "radius": LENGTH, "through": LENGTH, "points": LENGTH, "rounding": LENGTH}
GROUND = {"x": LENGTH, "y": LENGTH}
FIELDS = {
    "nodes": {"x": LENGTH, "y": LENGTH},
    "sections": SECTION,
    "members": {"curve": CURVE, "release": {"start": {"rotation": MOMENT}, "end": {"rotation": MOMENT}}},
    "supports": {"displacement": GROUND},
    "foundations": {"stiffness": STRESS, "shear_stiffness": FORCE, "gap": LENGTH, "outline": OUTLINE, "displacement": GROUND,
                    "law": {"stiffness": STRESS, "capacity": PER_LENGTH, "reference": LENGTH, "points": (LENGTH, PER_LENGTH)}},
    "masses": {"mass": MASS, "inertia": MOMENT},
    "imperfections": {"amplitude": LENGTH, "offsets": (NONE, LENGTH)},
}
SPRING = {"stiffness": PER_LENGTH, "gap": LENGTH, "displacement": GROUND,
          "law": {"stiffness": PER_LENGTH, "capacity": FORCE, "reference": LENGTH, "points": (LENGTH, FORCE)}}
ROTATIONAL = {"stiffness": MOMENT, "law": {"stiffness": MOMENT, "capacity": MOMENT, "points": (NONE, MOMENT)}}
LOADS = {
    "point": {"force": FORCE, "moment": MOMENT},
    "distributed": {"force": PER_LENGTH},
    "pressure": {"value": PER_LENGTH},
    "initial_strain": {"curvature": (-1, 0)},
    "self_weight": {"gravity": LENGTH},
    "temperature": {"gradient": (-1, 0)},
}


def scaled(value, dimension, length, force):
    """A value, a list, an object or a field along a member. `dimension`: exponents, fields of an object, or a pair for a list of pairs."""
    if isinstance(value, str):
        return value
    if isinstance(dimension, dict):
        return {key: scaled(one, dimension[key], length, force) if key in dimension else one for key, one in value.items()} \
            if isinstance(value, dict) else value
    if isinstance(dimension[0], tuple):
        return [[scaled(one, kind, length, force) for one, kind in zip(pair, dimension)] for pair in value]
    if isinstance(value, dict):
        return {**value, "along": [[place, scaled(one, dimension, length, force)] for place, one in value["along"]]}
    if isinstance(value, list):
        return [scaled(one, dimension, length, force) for one in value]
    return value * length ** dimension[0] * force ** dimension[1]


def convert(request, length, force):
    """The request with lengths and forces multiplied, in place."""
    model = request["model"]
    for key, fields in FIELDS.items():
        model[key] = [scaled(item, fields, length, force) for item in model.get(key, [])]
    model["springs"] = [scaled(item, ROTATIONAL if item["direction"] == "rotation" else SPRING, length, force)
                        for item in model.get("springs", [])]
    for holder in [model, *model.get("load_cases", [])]:
        holder["loads"] = [scaled(item, LOADS[item["type"]], length, force) for item in holder.get("loads", [])]
    rule = request["analysis"].get("stop", {}).get("monitor")
    if rule and next(m for m in model["monitors"] if m["id"] == rule["id"])["component"] != "rotation":
        rule["range"] = [length * value for value in rule["range"]]
    return request
