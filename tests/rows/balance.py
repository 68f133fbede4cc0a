"""Balance of a state of a result document: actions and reactions sum to zero.

Reads what the document says of supports, springs, foundations and loads, and takes the dead loads from the request.
"""
import math


def dead_force(model, factor):
    """Force (x, y) of all dead loads at a load factor."""
    lengths = {}
    nodes = {node["id"]: (node["x"], node["y"]) for node in model["nodes"]}
    for member in model["members"]:
        (x0, y0), (x1, y1) = nodes[member["start"]], nodes[member["end"]]
        chord = math.hypot(x1 - x0, y1 - y0)
        sweep = math.radians(member.get("curve", {}).get("sweep_degrees", 0.0))
        lengths[member["id"]] = chord * sweep / (2 * math.sin(sweep / 2)) if sweep else chord
    force = [0.0, 0.0]
    size = 0.0
    for load in model["loads"]:
        times = 1.0 if load.get("pattern") == "constant" else factor
        if load["type"] == "distributed":
            times *= lengths[load["member"]]
        for c in range(2):
            force[c] += times * load["force"][c]
            size = max(size, abs(times * load["force"][c]))
    return force, size


def positions(model, state, linear):
    """Places of nodes in the state, from the ends of their members."""
    out = {node["id"]: (node["x"], node["y"]) for node in model["nodes"]}
    if linear:
        return out
    for member in model["members"]:
        of = state["members"][member["id"]]
        for node, i in ((member["start"], 0), (member["end"], -1)):
            out[node] = (of["x"][i], of["y"][i])
    return out


def reactions(model, state, linear=False):
    """(force x, force y, moment about the origin) of each support, spring and foundation."""
    places = positions(model, state, linear)
    out = []
    for node, of in state.get("supports", {}).items():
        x, y = places[node]
        out.append((of["fx"], of["fy"], of["moment"] + x * of["fy"] - y * of["fx"]))
    for key in ("springs", "foundations"):
        for of in state.get(key, {}).values():
            given = of["resultant"]
            out.append((given["fx"], given["fy"], given["moment"]))
    return out


def imbalance(model, state, linear=False):
    """Sums of forces and of moments over the largest of them; 0 where nothing acts."""
    acting = reactions(model, state, linear)
    force, size = dead_force(model, state["load_factor"])
    loads = (force[0], force[1], state["loads"]["moment"])
    xs = [node["x"] for node in model["nodes"]]
    ys = [node["y"] for node in model["nodes"]]
    span = max(max(xs) - min(xs), max(ys) - min(ys))
    largest = max([size] + [abs(one[c]) for one in acting for c in range(2)])
    moment = max([largest * span] + [abs(one[2]) for one in acting])
    left = [sum(one[c] for one in acting) + loads[c] for c in range(3)]
    if largest == 0.0:
        return max(abs(x) for x in left)
    return max(abs(left[0]) / largest, abs(left[1]) / largest, abs(left[2]) / moment)
