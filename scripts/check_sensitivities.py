#!/usr/bin/env python3
"""Sensitivities of random models against central differences of whole analyses.

usage: check_sensitivities.py build/release/snapthrough [--models 200] [--first 1]

Each model is a chain of members with curves, sections, supports, springs, foundations, loads and imperfections
that are drawn; at its first critical point some numbers of it, drawn too, are compared. Differences are of two
steps, extrapolated; what the two leave open is their own error, so a comparison counts only where that is small.
Ends with 1 when a sensitivity differs by more than differences can.
"""

import argparse
import copy
import json
import math
import random
import subprocess
import sys

ACCURACY = 1e-10
AGREE = 1e-6  # relative, or of the load by a change of the number by itself
PARAMETERS = 4
COUNTS = ("half_waves", "number")


def solve(program, request):
    """The result of a request; None where there is none."""
    done = subprocess.run([program, "solve", "-"], input=json.dumps(request), capture_output=True, text=True,
                          timeout=600, check=False)
    return json.loads(done.stdout) if done.stdout.startswith("{") else None


def numbers(part, pointer):
    """Every number of a document with its pointer."""
    if isinstance(part, dict):
        for key, value in part.items():
            yield from numbers(value, f"{pointer}/{key}")
    elif isinstance(part, list):
        for i, value in enumerate(part):
            yield from numbers(value, f"{pointer}/{i}")
    elif isinstance(part, (int, float)) and not isinstance(part, bool):
        yield pointer, part


def changed(request, pointer, value):
    """The request with another value there."""
    other = copy.deepcopy(request)
    *above, last = [int(t) if t.isdigit() else t for t in pointer.split("/")[1:]]
    part = other
    for token in above:
        part = part[token]
    part[last] = value
    return other


def draw_section(rng, name):
    if rng.random() < 0.3:
        height = rng.uniform(0.01, 0.05)
        section = {"id": name, "E": 12.0 / height**3, "A": height, "I": height**3 / 12.0}
        if rng.random() < 0.5:
            section.update(nu=0.3, shear_area=height * 5 / 6)
        return section
    section = {"id": name, "EI": rng.uniform(0.5, 2.0), "EA": 10.0 ** rng.uniform(3, 6)}
    if rng.random() < 0.3:
        section["GA"] = 10.0 ** rng.uniform(2, 4)
    return section


def draw_curve(rng):
    kind = rng.choice(["line", "arc", "arc", "sine", "parabola", "points"])
    rise = rng.choice([-1, 1]) * rng.uniform(0.05, 0.25)
    if kind == "arc":
        return {"type": "arc", "sweep_degrees": -rng.uniform(20, 150)}
    if kind == "points":
        return None
    curve = {"type": kind}
    if kind != "line":
        curve["rise"] = rise
    if kind == "sine":
        curve["half_waves"] = rng.choice([1, 2])
    return curve


def draw_foundation(rng, member, name):
    foundation = {"id": name, "member": member, "stiffness": 10.0 ** rng.uniform(0, 4),
                  "reaction": rng.choice(["bilateral", "compression_only", "tension_only"])}
    if rng.random() < 0.3:
        foundation["range"] = [rng.uniform(0.0, 0.4), rng.uniform(0.6, 1.0)]
    if foundation["reaction"] != "bilateral":
        foundation["side"] = rng.choice(["left", "right"])
        foundation["gap"] = rng.choice([0.0, 10.0 ** rng.uniform(-4, -2)])
    elif rng.random() < 0.3:
        foundation["shear_stiffness"] = rng.uniform(0.1, 5.0)
    return foundation


def draw_spring(rng, place, name):
    spring = {"id": name, "at": place, "direction": [rng.uniform(-1, 1), rng.choice([-1, 1])],
              "stiffness": 10.0 ** rng.uniform(0, 3), "reaction": rng.choice(["bilateral", "compression_only"])}
    if spring["reaction"] != "bilateral":
        spring["gap"] = rng.choice([0.0, 10.0 ** rng.uniform(-3, -1.5)])
    elif rng.random() < 0.3:
        spring["direction"] = "rotation"
    return spring


def draw_load(rng, member, pattern):
    kind = rng.choice(["point", "point", "distributed", "pressure", "initial_strain"])
    size = 1.0 if pattern == "proportional" else 0.1
    load = {"type": kind, "pattern": pattern}
    if kind == "point":
        load.update(at={"member": member, "fraction": rng.uniform(0.2, 0.8)},
                    force=[size * rng.uniform(-0.5, 0.5), -size], moment=size * rng.uniform(-0.05, 0.05))
        return load
    load["member"] = member
    if kind == "distributed":
        load.update(force=[size * rng.uniform(-0.3, 0.3), -size], per=rng.choice(["length", "horizontal"]))
    elif kind == "pressure":
        load.update(value=size, side="left")
    else:
        load.update(axial=0.01 * size, curvature=size * rng.uniform(-0.1, 0.1))
    return load


def draw_column(rng):
    """A straight column on what holds it both ways: it bifurcates."""
    section = draw_section(rng, "s")
    pieces = rng.choice([1, 2])
    nodes = [{"id": f"n{i}", "x": float(i), "y": 0.0} for i in range(pieces + 1)]
    members = [{"id": f"m{i}", "start": f"n{i}", "end": f"n{i + 1}", "section": "s"} for i in range(pieces)]
    model = {"nodes": nodes, "sections": [section], "members": members,
             "supports": [{"node": "n0", "fixed": ["x", "y"] + ["rotation"] * (rng.random() < 0.4)},
                          {"node": f"n{pieces}", "fixed": ["y"] + ["rotation"] * (rng.random() < 0.4)}],
             "springs": [{"id": "k", "at": {"member": "m0", "fraction": rng.uniform(0.2, 0.8)}, "direction": [0, 1],
                          "stiffness": 10.0 ** rng.uniform(-1, 2)}],
             "loads": [{"type": "point", "at": {"node": f"n{pieces}"}, "force": [-1.0, 0.0]},
                       {"type": "distributed", "member": "m0", "force": [-rng.uniform(0, 2), 0.0]}]}
    if rng.random() < 0.7:
        model["foundations"] = [{"id": "f", "member": "m0", "stiffness": 10.0 ** rng.uniform(0, 3),
                                 "shear_stiffness": rng.uniform(0.1, 2.0), "range": [rng.uniform(0, 0.4), 1.0]}]
    return model


def draw(seed):
    """A request."""
    rng = random.Random(seed)
    if rng.random() < 0.25:
        return request_of(draw_column(rng))
    count = rng.choice([1, 1, 2, 3])
    nodes = [{"id": f"n{i}", "x": float(i) + (rng.uniform(-0.1, 0.1) if 0 < i < count else 0.0),
              "y": rng.uniform(-0.3, 0.3) if i > 0 else 0.0} for i in range(count + 1)]
    sections = [draw_section(rng, f"s{i}") for i in range(rng.choice([1, 2]))]
    members = []
    for i in range(count):
        member = {"id": f"m{i}", "start": f"n{i}", "end": f"n{i + 1}", "section": rng.choice(sections)["id"]}
        curve = draw_curve(rng)
        a, b = nodes[i], nodes[i + 1]
        member["curve"] = curve or {"type": "points", "points": [
            [a["x"] + f * (b["x"] - a["x"]), a["y"] + f * (b["y"] - a["y"]) + rng.uniform(0.02, 0.2)]
            for f in (0.35, 0.7)]}
        members.append(member)
    supports = [{"node": "n0", "fixed": ["x", "y"] + ["rotation"] * (rng.random() < 0.4)},
                {"node": f"n{count}", "fixed": ["x", "y"] + ["rotation"] * (rng.random() < 0.4)}]
    if rng.random() < 0.3:
        supports[1]["angle_degrees"] = rng.uniform(-30, 30)
    if rng.random() < 0.3:
        supports[1]["displacement"] = {"x": rng.uniform(-0.02, 0.02), "y": rng.uniform(-0.02, 0.02),
                                       "pattern": rng.choice(["proportional", "constant"])}
    pick = lambda: rng.choice(members)["id"]
    model = {"nodes": nodes, "sections": sections, "members": members, "supports": supports,
             "loads": [draw_load(rng, pick(), "proportional") for _ in range(rng.choice([1, 2]))]}
    if rng.random() < 0.3:
        model["loads"].append(draw_load(rng, pick(), "constant"))
    if rng.random() < 0.5:
        model["foundations"] = [draw_foundation(rng, pick(), "f")]
    if rng.random() < 0.4:
        place = {"member": pick(), "fraction": rng.uniform(0.2, 0.8)}
        model["springs"] = [draw_spring(rng, rng.choice([place, {"node": f"n{rng.randrange(count + 1)}"}]), "k")]
    if rng.random() < 0.3:
        model["imperfections"] = [rng.choice([
            {"type": "sine", "member": pick(), "half_waves": rng.choice([1, 2]), "amplitude": 0.01},
            {"type": "points", "member": pick(), "offsets": [[0.3, 0.004], [0.7, -0.003]]},
            {"type": "mode", "number": 1, "amplitude": 0.005}])]
    return request_of(model)


def request_of(model):
    """A search for its first critical point."""
    return {"model": model, "analysis": {"type": "critical", "discretization": {"accuracy": ACCURACY},
                                         "output": {"states": "none"}}}


def first_load(program, request, kind):
    """The first critical load of that type."""
    result = solve(program, request)
    points = result["critical_points"] if result and "failure" not in result else []
    return points[0]["load_factor"] if points and points[0]["type"] == kind else math.nan


def difference(program, request, pointer, value, kind):
    """The derivative by differences of whole analyses, and its error: the best of three pairs of steps."""
    size = 1.0 if "/nodes/" in pointer or "/points/" in pointer else abs(value) or 0.1
    best = (math.nan, math.inf)
    for share in (2e-3, 4e-4, 5e-5):
        rates = []
        for h in (share * size, 0.5 * share * size):
            more = first_load(program, changed(request, pointer, value + h), kind)
            less = first_load(program, changed(request, pointer, value - h), kind)
            rates.append((more - less) / (2.0 * h))
        found = ((4.0 * rates[1] - rates[0]) / 3.0, abs(rates[1] - rates[0]) / 3.0)
        if found[1] < best[1]:
            best = found
        if best[1] <= 0.1 * AGREE * abs(best[0]):
            break
    return best, size


def compare(program, seed, tally):
    """Compares some numbers of one model; returns lines on those that differ."""
    rng = random.Random(-seed)
    request = draw(seed)
    places = [(p, v) for p, v in numbers(request["model"], "/model") if p.split("/")[-1] not in COUNTS]
    some = rng.sample(places, min(PARAMETERS, len(places)))
    asked = copy.deepcopy(request)
    asked["analysis"]["sensitivities"] = [pointer for pointer, _ in some]
    result = solve(program, asked)
    if result is None or "failure" in result or not result["critical_points"]:
        tally["no critical point"] += 1
        return []
    point = result["critical_points"][0]
    load = abs(point["load_factor"])
    tally[point["type"]] = tally.get(point["type"], 0) + 1
    lines = []
    for (pointer, value), one in zip(some, point["sensitivities"]):
        if one["derivative"] is None:
            tally[one["reason"]] = tally.get(one["reason"], 0) + 1
            continue
        (rate, error), size = difference(program, request, pointer, value, point["type"])
        allowed = AGREE * max(abs(rate), 1e-2 * load / size)
        if not error <= allowed:
            tally["no difference"] += 1
            continue
        tally["compared"] += 1
        off = abs(one["derivative"] - rate) / max(abs(rate), 1e-2 * load / size)
        tally["largest"] = max(tally["largest"], off)
        if off > AGREE + error / max(abs(rate), 1e-2 * load / size):
            lines.append(f"{seed} {point['type']} {pointer} {one['derivative']} {rate} {off:.1e}")
    return lines


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--models", type=int, default=200)
    parser.add_argument("--first", type=int, default=1)
    arguments = parser.parse_args()
    tally = {"compared": 0, "no difference": 0, "no critical point": 0, "largest": 0.0}
    wrong = []
    for seed in range(arguments.first, arguments.first + arguments.models):
        lines = compare(arguments.program, seed, tally)
        wrong += lines
        for line in lines:
            print(line, flush=True)
    print(json.dumps(tally))
    print(f"{len(wrong)} differ")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
