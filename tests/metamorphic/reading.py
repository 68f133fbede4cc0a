"""Quantities of a result in the drawing of the first request: {name: (kind, value)}; values of a kind are measured by its largest."""
import math

SECTION_FORCES = ("axial_force", "shear_force", "bending_moment")
SAMPLES = 21  # points of a member in a state; a part of a member that was cut in the middle has those between, too


def sampled(view, state, member, fields):
    """Lists of the fields of a member from its start in the first drawing; those of its two ends only where it was cut elsewhere."""
    parts = [state["members"][name] for name in view.ids["members"][member]]
    if member in view.backwards:
        parts = [{field: part[field][::-1] for field in part} for part in parts][::-1]
    if len(parts) == 1:
        return [parts[0][field] for field in fields]
    lengths = [abs(part["s"][-1] - part["s"][0]) for part in parts]
    if abs(lengths[0] - lengths[1]) > 1e-6 * lengths[0]:
        return [[parts[0][field][0], parts[1][field][-1]] for field in fields]
    return [parts[0][field][0::2] + parts[1][field][2::2] for field in fields]


def member_values(view, state, member):
    """Displacements and section forces at the ends, and the largest along a member that was not cut away from its middle."""
    sign = view.hand() * (-1.0 if member in view.backwards else 1.0)
    factors = {"axial_force": 1.0 / view.force, "shear_force": view.hand() / view.force,
               "bending_moment": sign / view.force / view.length, "rotation": view.hand()}
    u, v, *rest = sampled(view, state, member, ("u", "v", *factors))
    out = {}
    moved = [view.vector(x / view.length, y / view.length) for x, y in zip(u, v)]
    whole = len(u) == SAMPLES
    for end, at in (("start", 0), ("end", -1)):
        out[f"{member} u {end}"], out[f"{member} v {end}"] = (("displacement", value) for value in moved[at])
    if whole:
        out[f"{member} largest displacement"] = ("displacement", max(math.hypot(*pair) for pair in moved))
    for (field, factor), values in zip(factors.items(), rest):
        for end, at in (("start", 0), ("end", -1)):
            out[f"{member} {field} {end}"] = (field, factor * values[at])
        if whole:
            out[f"{member} largest {field}"] = (field, abs(factor) * max(map(abs, values)))
    return out


def resultant(view, items):
    fx, fy = (sum(item[field] for item in items) / view.force for field in ("fx", "fy"))
    return view.vector(fx, fy)


def pair(out, name, kind, values):
    out[f"{name} x"], out[f"{name} y"] = ((kind, value) for value in values)


def state_values(view, request, state):
    out = {}
    for member in view.ids["members"]:
        out.update(member_values(view, state, member))
    for name, ids in view.ids["nodes"].items():
        if ids[0] in state["supports"]:
            reaction = state["supports"][ids[0]]
            pair(out, f"reaction of {name}", "reaction", resultant(view, [reaction]))
            out[f"reaction of {name} moment"] = ("bending_moment", view.hand() * reaction["moment"] / view.force / view.length)
    rotational = {spring["id"] for spring in request["model"].get("springs", []) if spring["direction"] == "rotation"}
    for name, ids in view.ids["springs"].items():
        if name not in rotational:
            pair(out, f"spring {name}", "reaction", resultant(view, [state["springs"][ids[0]]["resultant"]]))
    for name, ids in view.ids["foundations"].items():
        pair(out, f"foundation {name}", "reaction", resultant(view, [state["foundations"][one]["resultant"] for one in ids]))
    pair(out, "loads", "reaction", resultant(view, [state["loads"]]))
    return out


def monitor_values(view, request, monitors, row):
    """Monitors come as x and y of one place, and each other one by itself."""
    if "normal" not in view.ids["monitors"]:
        return {}

    def value(name):
        return monitors[view.ids["monitors"][name][0]][row]

    out = {}
    normal = view.hand()
    at = next(m for m in request["model"]["monitors"] if m["id"] == "normal")["at"]["member"]
    normal *= -1.0 if at in view.backwards else 1.0
    pair(out, "monitor", "displacement", view.vector(value("x") / view.length, value("y") / view.length))
    out["monitor rotation"] = ("rotation", view.hand() * value("rotation"))
    out["monitor normal"] = ("displacement", normal * value("normal") / view.length)
    return out


def rows(view, request, document):
    """[(what the row is, values)] of states and tables. The row of a state has its displacements, too: a monitor is as exact as
    the largest displacement of the structure."""
    found = []
    table = document.get("static")
    states = {state["load_factor"]: state for state in document.get("states", []) if state["branch"] == 0}
    for row, factor in enumerate(table["load_factor"] if table else []):
        values = monitor_values(view, request, table["monitors"], row)
        if values and factor in states:
            moved = state_values(view, request, states[factor]).items()
            values.update({key: value for key, value in moved if value[0] in ("displacement", "rotation")})
        found.append((f"row {row + 1} at load factor {factor:g}", values))
    for number, state in enumerate(document.get("states", [])):
        if state["branch"] == 0:
            found.append((f"state {number + 1} at load factor {state['load_factor']:.6g}", state_values(view, request, state)))
    return found
