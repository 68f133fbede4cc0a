#!/usr/bin/env python3
"""Checks limit loads of random structures on supports with a capacity against the upper bound theorem.

  limits.py BINARY [--count 100] [--seed 1]

Draws piles pushed across and along their axis, footings, walls and frames, each one rigid body with members that are stiff by
1e3 to 1e9, on foundations and springs of all kinds of laws. The limit load is the least of (D(v) - C v) / (P v) over the rigid
motions v, by golden sections inside one another: D is the work of the supports at their capacity, integrated exactly along
straight members, C and P the constant and the growing loads. Of each structure it checks that

  - a static analysis with small displacements gives the load factor below the limit, refuses the one beyond with `capacity`,
    and has the limit within 2e-6;
  - static, path and critical analyses with large displacements end with `capacity` at one load, which the limit bounds and
    which is within 10 % of it for hyperbolic laws, which geometry meets before their capacity, within 1 % for others;
  - no row, state or point of a path is beyond the limit.

Prints a line a failure and ends with status 1 if a structure failed. --seed S --count 1 draws the structure of a line again.
"""
import argparse
import json
import math
import random
import subprocess
import sys

KINDS = ("tanh", "hyperbolic", "power", "table")
GOLDEN = 0.5 * (math.sqrt(5.0) - 1.0)
EXACT = 2e-6  # of the golden sections, whose ranges are divided 60 times
SAME = 2e-3   # between analyses: a path ends within 1e-3 of the limit
NEAR = {"hyperbolic": 0.1, "tanh": 0.01, "power": 0.01, "table": 0.01}


def law_of(rng, kind, stiffness, capacity):
    """A law with the capacity; tables bend once or twice before they reach it."""
    if kind == "power":
        return {"type": kind, "stiffness": stiffness, "capacity": capacity, "reference": 5 * capacity / stiffness, "exponent": 0.5}
    if kind != "table":
        return {"type": kind, "stiffness": stiffness, "capacity": capacity}
    w = capacity / stiffness
    return {"type": kind, "points": rng.choice([[[w, capacity]], [[w, 0.7 * capacity], [4 * w, capacity]]])}


def capacity_of(law):
    return law["points"][-1][1] if law["type"] == "table" else law["capacity"]


def body(rng, nodes, members, size, force):
    stiff = 10 ** rng.uniform(3, 9)
    return {"nodes": [{"id": name, "x": x, "y": y} for name, (x, y) in nodes.items()],
            "sections": [{"id": "s", "EA": stiff * force, "EI": stiff * force * size * size}],
            "members": [{"id": a + b, "start": a, "end": b, "section": "s"} for a, b in members],
            "supports": [], "springs": [], "foundations": [], "loads": []}


def point(node, x, y, **more):
    return {"type": "point", "at": {"node": node}, "force": [x, y], **more}


def pile(rng, kind):
    length, c = rng.uniform(3, 20), 10 ** rng.uniform(0, 2.5)
    model = body(rng, {"h": (0, 0), "t": (0, -length)}, ["ht"], length, c * length)
    model["supports"] = [{"node": "t", "fixed": ["y"]}]
    model["foundations"] = [{"id": "soil", "member": "ht", "law": law_of(rng, kind, c / (1e-4 * length), c)}]
    model["loads"] = [point("h", c, 0, moment=c * length * rng.choice([0, rng.uniform(-0.5, 1)]))]
    return model, ("x", "turn")


def axial_pile(rng, kind):
    length, c = rng.uniform(5, 30), 10 ** rng.uniform(0, 2.5)
    model = body(rng, {"h": (0, 0), "t": (0, -length)}, ["ht"], length, c * length)
    model["supports"] = [{"node": n, "fixed": ["x"]} for n in "ht"]
    model["foundations"] = [{"id": "shaft", "member": "ht", "component": "tangent", "law": law_of(rng, kind, c / 1e-3, c)}]
    toe = c * length * rng.uniform(0.1, 1)
    model["springs"] = [{"id": "toe", "at": {"node": "t"}, "direction": [0, -1], "reaction": "compression_only",
                         "law": law_of(rng, kind, toe / 1e-3, toe)}]
    model["loads"] = [point("h", 0, -c * length)]
    return model, ("y",)


def footing(rng, kind):
    b, h, c = rng.uniform(0.5, 3), rng.uniform(0.5, 4), 10 ** rng.uniform(1, 3)
    model = body(rng, {"l": (-b, 0), "c": (0, 0), "r": (b, 0), "t": (0, h)}, ["lc", "cr", "ct"], b, c * b)
    bed = {"side": "right", "law": law_of(rng, kind, c / (3e-4 * b), c)}
    if rng.random() < 0.7:
        bed["reaction"] = "compression_only"
    model["foundations"] = [{"id": m, "member": m, **bed} for m in ("lc", "cr")]
    slide = c * b * rng.uniform(0.2, 2)
    model["springs"] = [{"id": "slide", "at": {"node": "c"}, "direction": [1, 0],
                         "law": law_of(rng, kind, slide / (3e-4 * b), slide)}]
    model["loads"] = [point("c", 0, -2 * b * c * rng.uniform(0.1, 0.8), pattern="constant"),
                      point(rng.choice("tc"), c * b * rng.uniform(0.2, 1), -c * b * rng.choice([0, rng.uniform(0, 1)]))]
    return model, ("x", "y", "turn")


def wall(rng, kind):
    height, c = rng.uniform(3, 12), 10 ** rng.uniform(1, 2.5)
    model = body(rng, {"b": (0, -height), "t": (0, 0)}, ["bt"], height, c * height)
    model["supports"] = [{"node": "b", "fixed": ["y"]}]
    k = c / (2e-4 * height)
    model["foundations"] = [
        {"id": "front", "member": "bt", "side": "left", "reaction": "compression_only", "range": [0, rng.uniform(0.3, 0.8)],
         "law": law_of(rng, kind, k, c)},
        {"id": "back", "member": "bt", "side": "right", "reaction": "compression_only", "law": law_of(rng, kind, k, 0.5 * c)}]
    anchor = c * height * rng.uniform(0.05, 0.5)
    model["springs"] = [{"id": "anchor", "at": {"node": "t"}, "direction": [1, 0],
                         "law": law_of(rng, kind, anchor / (2e-4 * height), anchor)}]
    model["loads"] = [{"type": "distributed", "member": "bt", "force": [-c * rng.uniform(0.3, 1), 0]}]
    return model, ("x", "turn")


def frame(rng, kind):
    b, h, q = rng.uniform(3, 10), rng.uniform(2, 6), 10 ** rng.uniform(1, 3)
    model = body(rng, {"a": (0, 0), "b": (b, 0), "c": (0, h), "d": (b, h)}, ["ac", "cd", "db"], b, q)
    for node in "ab":
        for name, direction in (("x", [1, 0]), ("y", [0, -1])):
            c = q * rng.uniform(0.3, 2)
            model["springs"].append({"id": node + name, "at": {"node": node}, "direction": direction,
                                     "law": law_of(rng, kind, c / (1e-4 * b), c)})
    model["loads"] = [point("c", q * rng.uniform(0.2, 1), 0),
                      {"type": "distributed", "member": "cd", "force": [0, -q / b * rng.uniform(0.2, 1)]}]
    return model, ("x", "y", "turn")


def work(force, at, motion):
    """Work of a force at a place on a motion (x, y, turn about the origin)."""
    x, y, turn = motion
    return force[0] * (x - turn * at[1]) + force[1] * (y + turn * at[0])


def dissipated(model, motion):
    """Work of the supports at their capacity on a motion."""
    place = {node["id"]: (node["x"], node["y"]) for node in model["nodes"]}
    called = lambda support, w: max(w, 0.0) if support.get("reaction") == "compression_only" else abs(w)
    total = 0.0
    for spring in model["springs"]:
        w = work(spring["direction"], place[spring["at"]["node"]], motion)
        total += capacity_of(spring["law"]) * called(spring, w)
    for soil in model["foundations"]:
        a, b = place[soil["member"][0]], place[soil["member"][1]]
        length = math.dist(a, b)
        along = ((b[0] - a[0]) / length, (b[1] - a[1]) / length)
        normal = (-along[1], along[0])
        if soil.get("side") == "right":
            normal = (along[1], -along[0])
        if soil.get("component") == "tangent":
            normal = along
        low, high = soil.get("range", [0, 1])
        at = lambda f: work(normal, (a[0] + f * (b[0] - a[0]), a[1] + f * (b[1] - a[1])), motion)
        first, last = at(low), at(high)
        cuts = [low, high] if first * last >= 0 else [low, low + (high - low) * first / (first - last), high]
        for f, g in zip(cuts, cuts[1:]):  # the displacement is linear and of one sign
            total += capacity_of(soil["law"]) * length * (g - f) * called(soil, 0.5 * (at(f) + at(g)))
    return total


def works_of_loads(model, pattern):
    """Work of the loads of a pattern on the motions x, y and turn of one."""
    place = {node["id"]: (node["x"], node["y"]) for node in model["nodes"]}
    sums = []
    for motion in ((1, 0, 0), (0, 1, 0), (0, 0, 1)):
        total = 0.0
        for load in model["loads"]:
            if load.get("pattern", "proportional") != pattern:
                continue
            if load["type"] == "point":
                total += work(load["force"], place[load["at"]["node"]], motion) + load.get("moment", 0) * motion[2]
            else:
                a, b = place[load["member"][0]], place[load["member"][1]]
                middle = (0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]))
                total += math.dist(a, b) * work(load["force"], middle, motion)
        sums.append(total)
    return sums


def least(function, low, high, steps=60):
    """Least value of a convex function on an interval, by golden sections."""
    a, b = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
    at_a, at_b = function(a), function(b)
    for _ in range(steps):
        if at_a < at_b:
            high, b, at_b = b, a, at_a
            a = high - GOLDEN * (high - low)
            at_a = function(a)
        else:
            low, a, at_a = a, b, at_b
            b = low + GOLDEN * (high - low)
            at_b = function(b)
    return min(at_a, at_b)


def limit_load(model, free):
    """Least of (D - C v) / (P v), with P v = 1; free: components that supports leave to the body."""
    index = {"x": 0, "y": 1, "turn": 2}
    size = max(math.hypot(node["x"], node["y"]) for node in model["nodes"])
    unit = [1.0, 1.0, 1.0 / size]
    constant = [w * u for w, u in zip(works_of_loads(model, "constant"), unit)]
    growing = [w * u for w, u in zip(works_of_loads(model, "proportional"), unit)]
    components = sorted((index[name] for name in free), key=lambda i: -abs(growing[i]))
    main, others = components[0], components[1:]
    span = 50.0 / abs(growing[main])

    def bound(motion):
        motion[main] = (1.0 - sum(growing[i] * motion[i] for i in others)) / growing[main]
        moved = [m * u for m, u in zip(motion, unit)]
        return dissipated(model, moved) - sum(c * m for c, m in zip(constant, motion))

    def search(motion, left):
        if not left:
            return bound(motion)

        def with_component(value):
            motion[left[0]] = value
            return search(motion, left[1:])
        return least(with_component, -span, span)
    return search([0.0, 0.0, 0.0], others)


def run(binary, model, analysis):
    request = json.dumps({"model": model, "analysis": analysis})
    done = subprocess.run([binary, "solve", "-"], input=request, capture_output=True, text=True, check=False)
    return json.loads(done.stdout)


def loads_in(result):
    """Load factors of all rows, states and points of a result."""
    return (result.get("static", {}).get("load_factor", []) + [state["load_factor"] for state in result["states"]]
            + [load for branch in result["branches"] for load in branch["load_factor"]])


def check(binary, seed):
    """Failures of the structure of a seed."""
    rng = random.Random(seed)
    kind = rng.choice(KINDS)
    model, free = rng.choice((pile, axial_pile, footing, wall, frame))(rng, kind)
    limit = limit_load(model, free)
    below, beyond = limit * rng.uniform(0.3, 0.97), limit * rng.choice([1.0005, 1.01, 1.5])
    rows = {"type": "static", "load_factors": [below, beyond], "output": {"states": "all"}}
    failures, found = [], {}
    for name, analysis in (("linear", {**rows, "geometry": "linear"}), ("static", rows), ("critical", {"type": "critical"}),
                           ("path", {"type": "path"})):
        result = run(binary, model, analysis)
        code = result.get("failure", {}).get("code", result["summary"]["termination"])
        if code != "capacity" or len(result.get("capacity", [])) != 1:
            failures.append(f"{name}: {code}: {result['summary']['message'][:120]}")
            continue
        found[name] = result["capacity"][0]["load_factor"]
        if analysis["type"] == "static" and result["static"]["load_factor"] != [below]:
            failures.append(f"{name}: rows {result['static']['load_factor']} for {below}")
        if any(load > limit * (1 + EXACT) for load in loads_in(result)):
            failures.append(f"{name}: a state beyond the limit")
    if "linear" in found and abs(found["linear"] / limit - 1) > EXACT:
        failures.append(f"linear: limit {found['linear']}, right is {limit}")
    large = [load for name, load in found.items() if name != "linear"]
    if large and (max(large) > limit * (1 + EXACT) or min(large) < limit * (1 - NEAR[kind]) or max(large) - min(large) > SAME * limit):
        failures.append(f"limits {found}, of rigid members with small displacements {limit}")
    return [f"seed {seed} {kind}: {failure}" for failure in failures]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("binary")
    parser.add_argument("--count", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    failed = 0
    for seed in range(given.seed, given.seed + given.count):
        failures = check(given.binary, seed)
        failed += bool(failures)
        print(*failures, sep="\n", end="\n" if failures else "", flush=True)
    print(f"{given.count} structures, {failed} of them failed")
    sys.exit(failed > 0)


if __name__ == "__main__":
    main()
